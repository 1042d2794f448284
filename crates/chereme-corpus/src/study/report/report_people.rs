//! Who is analysed, who is left out and why, and who the participants are.

use super::{ExcludedParticipants, ExclusionReason, ProfileRow, ProfileTable, ReportPeople};
use crate::study::study_answers::StudyParticipant;
use crate::study::study_plan::{ExclusionRule, LocalizedTexts, QuestionKind, StudyPlan, TrialRole};

/// Returns the account of all participants, and those whose answers are analysed.
pub(super) fn sort_out<'a>(
    plan: &StudyPlan,
    sha256: &str,
    participants: &'a [StudyParticipant],
) -> (ReportPeople, Vec<&'a StudyParticipant>) {
    let mut excluded: Vec<ExcludedParticipants> = Vec::new();
    let mut analysed = Vec::new();
    let mut in_order: Vec<&StudyParticipant> = participants.iter().collect();
    // The order in which files were imported does not count.
    in_order.sort_by(|a, b| a.code.cmp(&b.code));
    for one in &in_order {
        let Some(reason) = reason_against(plan, one) else {
            analysed.push(*one);
            continue;
        };
        match excluded.iter_mut().find(|exclusion| exclusion.reason == reason) {
            Some(known) => known.count += 1,
            None => excluded.push(ExcludedParticipants { reason, count: 1 }),
        }
    }
    let place =
        |exclusion: &ExcludedParticipants| exclusion_reasons(plan).position(|reason| reason == exclusion.reason);
    excluded.sort_by_key(place);
    let other_participants = analysed.iter();
    let others = other_participants
        .filter(|participant| !participant.plan_sha256.is_empty() && participant.plan_sha256 != sha256);
    let people = ReportPeople {
        recruited: participants.len(),
        excluded,
        analysed: analysed.len(),
        other_plan: others.count(),
        profile: profile_tables(plan, &in_order, &analysed),
    };
    (people, analysed)
}

/// Returns every reason to leave somebody out, in the order in which they are tried.
fn exclusion_reasons(plan: &StudyPlan) -> impl Iterator<Item = ExclusionReason> {
    let filter = plan.analysed.iter().map(|criterion| ExclusionReason::Filter {
        question: criterion.question.clone(),
    });
    let rules = plan.exclusions.iter().copied().map(ExclusionReason::Rule);
    [ExclusionReason::NoConsent].into_iter().chain(filter).chain(rules)
}

fn reason_against(plan: &StudyPlan, one: &StudyParticipant) -> Option<ExclusionReason> {
    exclusion_reasons(plan).find(|reason| match reason {
        // Answers that came without any agreement, as from tables of other tools, were agreed to there.
        ExclusionReason::NoConsent => one.consent.get("analysis") == Some(&false),
        ExclusionReason::Filter { question } => {
            let given = one.profile.get(question);
            let wanted = plan.analysed.as_ref();
            !given.is_some_and(|answer| wanted.is_some_and(|wanted| wanted.options.contains(answer)))
        }
        ExclusionReason::Rule(ExclusionRule::Unfinished) => !one.finished,
        ExclusionReason::Rule(ExclusionRule::ChecksWrong(most)) => wrong_checks(plan, one) > *most as usize,
        ExclusionReason::Rule(ExclusionRule::OneValue) => has_one_value(plan, one),
    })
}

/// Returns how many answers to check trials are wrong; `I cannot say` is wrong, too.
fn wrong_checks(plan: &StudyPlan, one: &StudyParticipant) -> usize {
    let checks = one.answers.iter().filter(|answer| answer.role == TrialRole::Check);
    let wrong = checks.filter(|answer| {
        let trial = plan.find_plan_trial(&answer.part, &answer.item, &answer.condition, answer.role);
        let right = trial.and_then(|trial| trial.right.get(&answer.question));
        match right {
            Some(right) => answer.choice.as_ref() != Some(right),
            None => answer.right == Some(false),
        }
    });
    wrong.count()
}

/// Returns whether somebody gave several answers on scales, all with one value.
fn has_one_value(plan: &StudyPlan, one: &StudyParticipant) -> bool {
    let on_scale = |name: &str| {
        let question = plan.find_plan_question(name);
        question.is_some_and(|asked| matches!(asked.kind, QuestionKind::Scale { .. }))
    };
    let main = one.answers.iter().filter(|answer| answer.role == TrialRole::Main);
    let mut values = main
        .filter(|answer| on_scale(&answer.question))
        .filter_map(|answer| answer.value);
    let Some(first) = values.next() else {
        return false;
    };
    let rest: Vec<i64> = values.collect();
    !rest.is_empty() && rest.iter().all(|value| *value == first)
}

fn profile_tables(plan: &StudyPlan, all: &[&StudyParticipant], analysed: &[&StudyParticipant]) -> Vec<ProfileTable> {
    let tables = plan.profile.iter().map(|question| {
        let mut options: Vec<(Option<String>, LocalizedTexts)> = question
            .options
            .iter()
            .map(|choice| (Some(choice.name.clone()), choice.text.clone()))
            .collect();
        let is_listed = |options: &[(Option<String>, LocalizedTexts)], name: &String| {
            options.iter().any(|entry| entry.0.as_ref() == Some(name))
        };
        for name in all.iter().filter_map(|person| person.profile.get(&question.name)) {
            if !is_listed(&options, name) {
                options.push((Some(name.clone()), LocalizedTexts::new()));
            }
        }
        options.push((None, LocalizedTexts::new()));
        let count = |people: &[&StudyParticipant], option: &Option<String>| {
            let same = |participant: &&&StudyParticipant| participant.profile.get(&question.name) == option.as_ref();
            people.iter().filter(same).count()
        };
        let profile_rows = options.into_iter().map(|(option, text)| ProfileRow {
            recruited: count(all, &option),
            analysed: count(analysed, &option),
            option,
            text,
        });
        // Nobody has to be counted who gave no answer.
        let rows = profile_rows.filter(|row| row.option.is_some() || row.recruited > 0);
        ProfileTable {
            question: question.name.clone(),
            text: question.text.clone(),
            rows: rows.collect(),
        }
    });
    tables.collect()
}
