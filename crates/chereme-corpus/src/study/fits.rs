//! Checks of answers against the plan; answers that do not fit are left out.

use std::collections::{BTreeMap, BTreeSet};

use super::answers::{ANSWERS_FORMAT, ANSWERS_VERSION, Answer, Participant};
use super::files::Findings;
use super::plan::{Plan, QuestionKind, Role};
use crate::consent::is_day;

/// The largest number of answers of a participant.
const MOST_ANSWERS: usize = 100_000;
/// The length of the longest code of a participant.
const LONGEST_CODE: usize = 60;

/// Returns why a participant cannot be imported at all, and what to do.
pub(super) fn refused(
    plan: &Plan,
    sha256: &str,
    person: &Participant,
) -> Option<(String, &'static str)> {
    if person.format != ANSWERS_FORMAT {
        let message = format!(
            "the file is no {ANSWERS_FORMAT}, but {:?}",
            short(&person.format)
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
    if person.plan_sha256 != sha256 {
        let message = format!(
            "the answers of {:?} belong to another plan than that of the study {:?}",
            short(&person.code),
            plan.name
        );
        return Some((
            message,
            "import them into the study that the questionnaire was built from; a plan that changed is another plan",
        ));
    }
    if !is_code(&person.code) {
        let message = format!("{:?} is no code of a participant", short(&person.code));
        return Some((
            message,
            "a code has up to 60 letters, digits, hyphens, dots, underscores and blanks",
        ));
    }
    if person.answers.len() > MOST_ANSWERS {
        let message = format!("the participant has more than {MOST_ANSWERS} answers");
        return Some((message, "import the files that the questionnaire saves"));
    }
    if person.consent.get("analysis") == Some(&false) {
        let message = format!(
            "{:?} did not agree that the answers are analysed",
            person.code
        );
        return Some((message, "delete the file"));
    }
    None
}

/// Leaves out answers about the participant that the plan does not offer.
pub(super) fn profile(plan: &Plan, person: &mut Participant, findings: &mut Findings) {
    let code = person.code.clone();
    person
        .consent
        .retain(|name, _| ["analysis", "publication"].contains(&name.as_str()));
    person.profile.retain(|name, option| {
        let question = plan.profile.iter().find(|it| it.name == *name);
        let known = question.is_some_and(|it| it.options.iter().any(|it| it.name == *option));
        if !known {
            let message = format!(
                "{code}: the plan has no answer {:?} to {:?}; it was left out",
                short(option),
                short(name)
            );
            findings.add("warning", None, message, None);
        }
        known
    });
}

/// Leaves out answers that do not fit the plan, and computes which are right.
pub(super) fn answers(
    plan: &Plan,
    person: &mut Participant,
    lines: &[u64],
    findings: &mut Findings,
) {
    let mut seen = BTreeSet::new();
    let mut given: BTreeMap<[String; 5], u32> = BTreeMap::new();
    let mut at = 0;
    person.answers.retain_mut(|answer| {
        let number = at + 1;
        let line = lines.get(at).copied();
        at += 1;
        let fault = match fits(plan, answer) {
            Err(fault) => Some(fault),
            Ok(()) if !seen.insert((answer.n, answer.question.clone())) => Some(format!(
                "{:?} was answered twice in trial {}",
                short(&answer.question),
                answer.n
            )),
            Ok(()) => {
                // Training and checks are shown once, other trials once in each block.
                let most = match answer.role {
                    Role::Main => plan.design.blocks,
                    Role::Training | Role::Check => 1,
                };
                let times = given.entry(place(answer)).or_default();
                *times += 1;
                (*times > most).then(|| {
                    format!(
                        "{:?} was answered more often than {:?} ({}) is shown",
                        short(&answer.question),
                        short(&answer.item),
                        short(&answer.condition)
                    )
                })
            }
        };
        let Some(fault) = fault else {
            return true;
        };
        let message = format!("answer {number} was left out: {fault}");
        findings.add("warning", line, message, None);
        false
    });
}

/// Reports the trials whose films could not be shown, and leaves them out.
pub(super) fn skipped(person: &mut Participant, findings: &mut Findings) {
    const SHOWN: usize = 12;
    let trials: BTreeSet<u32> = person.skipped.drain(..).collect();
    if trials.is_empty() {
        return;
    }
    let shown = trials.iter().take(SHOWN).map(u32::to_string);
    let more = if trials.len() > SHOWN { ", …" } else { "" };
    let message = format!(
        "{}: the browser could not show films; trials without all answers: {}{more}",
        person.code,
        shown.collect::<Vec<_>>().join(", ")
    );
    let remedy = "look whether the participant had the whole folder `media` and a current browser";
    findings.add("warning", None, message, Some(remedy.into()));
}

/// Returns the trial of an answer, and its question.
fn place(it: &Answer) -> [String; 5] {
    let (part, item, condition) = (it.part.clone(), it.item.clone(), it.condition.clone());
    let role = it.role.name().to_owned();
    [part, item, condition, role, it.question.clone()]
}

/// Checks an answer, and fills in its scale and whether it is right.
fn fits(plan: &Plan, answer: &mut Answer) -> std::result::Result<(), String> {
    let (part, item, condition) = (&answer.part, &answer.item, &answer.condition);
    let trial = plan.trial(part, item, condition, answer.role);
    let trial = trial.ok_or_else(|| {
        format!(
            "the plan has no trial with {:?} and {:?} ({})",
            short(item),
            short(condition),
            answer.role.name()
        )
    })?;
    let name = answer.question.as_str();
    let question = plan.asked(trial).find(|it| it.name == name);
    let question =
        question.ok_or_else(|| format!("the plan does not ask {:?} there", short(name)))?;
    if answer.n == 0 || answer.n as usize > MOST_ANSWERS {
        return Err(format!("{} is no place in an order of trials", answer.n));
    }
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => {
            let ends = [*low, *high];
            if answer.scale.is_some_and(|scale| scale != ends) {
                return Err(format!("the scale of {name:?} goes from {low} to {high}"));
            }
            if let Some(value) = answer.value.filter(|it| !(low..=high).contains(&it)) {
                return Err(format!(
                    "{value} lies outside the scale from {low} to {high}"
                ));
            }
            if answer.choice.is_some() {
                return Err(format!("{name:?} is a scale, which has no options"));
            }
            answer.scale = Some(ends);
            answer.right = None;
        }
        QuestionKind::Choice { options } => {
            if answer.value.is_some() || answer.scale.is_some() {
                return Err(format!("{name:?} is a choice, which has no numbers"));
            }
            let choice = answer.choice.as_ref();
            if let Some(wrong) = choice.filter(|it| !options.iter().any(|one| one.name == **it)) {
                return Err(format!("{name:?} has no option {:?}", short(wrong)));
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
    text.starts_with(char::is_alphanumeric)
        && text.chars().count() <= LONGEST_CODE
        && text.chars().all(plain)
}

/// Returns a day as `2026-11-27`; an empty text if `text` is no day.
pub(super) fn day(text: &str) -> String {
    match is_day(text) {
        true => text.to_owned(),
        false => String::new(),
    }
}

/// Returns the beginning of a text of a file, for a message.
pub(super) fn short(text: &str) -> String {
    const SHOWN: usize = 40;
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
