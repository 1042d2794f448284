//! Checks of answers against the plan; answers that do not fit are left out.

use std::collections::{BTreeMap, BTreeSet};

use super::study_answers::{ANSWERS_FORMAT, ANSWERS_VERSION, StudyAnswer, StudyParticipant};
use super::study_files::FileFindings;
use super::study_plan::{QuestionKind, StudyPlan, TrialRole};
use crate::consent::is_day;

/// The largest number of answers of a participant.
const MOST_ANSWERS: usize = 100_000;
/// The length of the longest code of a participant.
const LONGEST_CODE: usize = 60;

/// Returns why a participant cannot be imported at all, and what to do.
pub(super) fn refuse_participant(
    plan: &StudyPlan,
    sha256: &str,
    person: &StudyParticipant,
) -> Option<(String, &'static str)> {
    if person.format != ANSWERS_FORMAT {
        let message = format!(
            "the file is no {ANSWERS_FORMAT}, but {:?}",
            shorten_message_text(&person.format)
        );
        return Some((message, "import the files that the questionnaire saves"));
    }
    if person.version != ANSWERS_VERSION {
        let message = format!(
            "the answers are of version {}; this program reads version {ANSWERS_VERSION}",
            person.version
        );
        return Some((
            message,
            "import them with the version of Chereme that built the questionnaire",
        ));
    }
    // Answers to another plan may name the same trials and mean other films.
    if person.plan_sha256 != sha256 {
        let message = format!(
            "the answers of {:?} belong to another plan than that of the study {:?}",
            shorten_message_text(&person.code),
            plan.name
        );
        return Some((
            message,
            "import them into the study that the questionnaire was built from; a plan that changed is another plan",
        ));
    }
    if !is_code(&person.code) {
        let message = format!("{:?} is no code of a participant", shorten_message_text(&person.code));
        return Some((
            message,
            "a code has up to 60 letters, digits, hyphens, dots, underscores and blanks",
        ));
    }
    if person.answers.len() > MOST_ANSWERS {
        let message = format!("the participant has more than {MOST_ANSWERS} answers");
        return Some((message, "import the files that the questionnaire saves"));
    }
    // Without this consent the answers must not even lie in the corpus.
    if person.consent.get("analysis") == Some(&false) {
        let message = format!("{:?} did not agree that the answers are analysed", person.code);
        return Some((message, "delete the file"));
    }
    None
}

/// Leaves out answers about the participant that the plan does not offer.
pub(super) fn drop_unoffered_profile(plan: &StudyPlan, person: &mut StudyParticipant, findings: &mut FileFindings) {
    let code = person.code.clone();
    person
        .consent
        .retain(|name, _| ["analysis", "publication"].contains(&name.as_str()));
    person.profile.retain(|name, option| {
        let question = plan.profile.iter().find(|question| question.name == *name);
        let is_known =
            question.is_some_and(|question| question.options.iter().any(|candidate| candidate.name == *option));
        if !is_known {
            let message = format!(
                "{code}: the plan has no answer {:?} to {:?}; it was left out",
                shorten_message_text(option),
                shorten_message_text(name)
            );
            findings.add_file_finding("warning", None, message, None);
        }
        is_known
    });
}

/// Leaves out answers that do not fit the plan, and computes which are right.
pub(super) fn drop_unfit_answers(
    plan: &StudyPlan,
    person: &mut StudyParticipant,
    lines: &[u64],
    findings: &mut FileFindings,
) {
    let mut seen = BTreeSet::new();
    let mut given: BTreeMap<[String; 5], u32> = BTreeMap::new();
    let mut answer_index = 0;
    person.answers.retain_mut(|answer| {
        let number = answer_index + 1;
        let line = lines.get(answer_index).copied();
        answer_index += 1;
        let fault = match fit_answer_to_plan(plan, answer) {
            Err(fault) => Some(fault),
            Ok(()) if !seen.insert((answer.n, answer.question.clone())) => Some(format!(
                "{:?} was answered twice in trial {}",
                shorten_message_text(&answer.question),
                answer.n
            )),
            Ok(()) => {
                // Training and checks are shown once, other trials once in each block.
                let most = match answer.role {
                    TrialRole::Main => plan.design.blocks,
                    TrialRole::Training | TrialRole::Check => 1,
                };
                let times = given.entry(answer_place(answer)).or_default();
                *times += 1;
                (*times > most).then(|| {
                    format!(
                        "{:?} was answered more often than {:?} ({}) is shown",
                        shorten_message_text(&answer.question),
                        shorten_message_text(&answer.item),
                        shorten_message_text(&answer.condition)
                    )
                })
            }
        };
        let Some(fault) = fault else {
            return true;
        };
        let message = format!("answer {number} was left out: {fault}");
        findings.add_file_finding("warning", line, message, None);
        false
    });
}

/// Reports the trials whose films could not be shown, and leaves them out.
pub(super) fn drop_skipped_trials(person: &mut StudyParticipant, findings: &mut FileFindings) {
    const MAX_SHOWN_SKIPPED_TRIALS: usize = 12;
    let trials: BTreeSet<u32> = person.skipped.drain(..).collect();
    if trials.is_empty() {
        return;
    }
    let shown = trials.iter().take(MAX_SHOWN_SKIPPED_TRIALS).map(u32::to_string);
    let more = if trials.len() > MAX_SHOWN_SKIPPED_TRIALS {
        ", …"
    } else {
        ""
    };
    let message = format!(
        "{}: the browser could not show films; trials without all answers: {}{more}",
        person.code,
        shown.collect::<Vec<_>>().join(", ")
    );
    let remedy = "look whether the participant had the whole folder `media` and a current browser";
    findings.add_file_finding("warning", None, message, Some(remedy.into()));
}

/// Returns the trial of an answer, and its question.
fn answer_place(it: &StudyAnswer) -> [String; 5] {
    let (part, item, condition) = (it.part.clone(), it.item.clone(), it.condition.clone());
    let role = it.role.trial_role_name().to_owned();
    [part, item, condition, role, it.question.clone()]
}

/// Checks an answer, and fills in its scale and whether it is right.
fn fit_answer_to_plan(plan: &StudyPlan, answer: &mut StudyAnswer) -> std::result::Result<(), String> {
    let (part, item, condition) = (&answer.part, &answer.item, &answer.condition);
    let planned_trial = plan.find_plan_trial(part, item, condition, answer.role);
    let trial = planned_trial.ok_or_else(|| {
        format!(
            "the plan has no trial with {:?} and {:?} ({})",
            shorten_message_text(item),
            shorten_message_text(condition),
            answer.role.trial_role_name()
        )
    })?;
    let name = answer.question.as_str();
    let question = plan.questions_of_trial(trial).find(|candidate| candidate.name == name);
    let question = question.ok_or_else(|| format!("the plan does not ask {:?} there", shorten_message_text(name)))?;
    if answer.n == 0 || answer.n as usize > MOST_ANSWERS {
        return Err(format!("{} is no place in an order of trials", answer.n));
    }
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => {
            let ends = [*low, *high];
            if answer.scale.is_some_and(|scale| scale != ends) {
                return Err(format!("the scale of {name:?} goes from {low} to {high}"));
            }
            if let Some(value) = answer.value.filter(|number| !(low..=high).contains(&number)) {
                return Err(format!("{value} lies outside the scale from {low} to {high}"));
            }
            if answer.choice.is_some() {
                return Err(format!("{name:?} is a scale, which has no options"));
            }
            // Tables of other programs do not state the scale.
            answer.scale = Some(ends);
            answer.right = None;
        }
        QuestionKind::Choice { options } => {
            if answer.value.is_some() || answer.scale.is_some() {
                return Err(format!("{name:?} is a choice, which has no numbers"));
            }
            let choice = answer.choice.as_ref();
            if let Some(wrong) = choice.filter(|chosen| !options.iter().any(|one| one.name == **chosen)) {
                return Err(format!("{name:?} has no option {:?}", shorten_message_text(wrong)));
            }
            let right = trial.right.get(name);
            answer.right = right.map(|right| choice == Some(right));
        }
    }
    if answer.value.is_none() && answer.choice.is_none() {
        if !question.cannot_say {
            return Err(format!("{name:?} has no answer"));
        }
        answer.right = None;
    }
    Ok(())
}

/// Returns whether a text can be the code of a participant.
fn is_code(text: &str) -> bool {
    let plain = |letter: char| letter.is_alphanumeric() || "-_. ".contains(letter);
    // Codes appear in tables and messages, where other letters could do harm.
    text.starts_with(char::is_alphanumeric) && text.chars().count() <= LONGEST_CODE && text.chars().all(plain)
}

/// Returns a day as `2026-11-27`; an empty text if `text` is no day.
pub(super) fn normalize_day(text: &str) -> String {
    match is_day(text) {
        true => text.to_owned(),
        false => String::new(),
    }
}

/// Returns the beginning of a text of a file, for a message.
pub(super) fn shorten_message_text(text: &str) -> String {
    const MAX_QUOTED_TEXT_CHARS: usize = 40;
    // The text is cut between letters, since a byte may lie within one.
    match text.char_indices().nth(MAX_QUOTED_TEXT_CHARS) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
