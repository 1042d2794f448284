//! Who is analysed, who is left out and why, and who the participants are.

use super::{Excluded, People, ProfileRow, ProfileTable, Reason};
use crate::study::answers::Participant;
use crate::study::plan::{Exclusion, Plan, QuestionKind, Role, Texts};

/// Returns the account of all participants, and those whose answers are analysed.
pub(super) fn sort_out<'a>(
    plan: &Plan,
    sha256: &str,
    participants: &'a [Participant],
) -> (People, Vec<&'a Participant>) {
    let mut excluded: Vec<Excluded> = Vec::new();
    let mut analysed = Vec::new();
    let mut in_order: Vec<&Participant> = participants.iter().collect();
    // The order in which files were imported does not count.
    in_order.sort_by(|a, b| a.code.cmp(&b.code));
    for one in &in_order {
        let Some(reason) = reason_against(plan, one) else {
            analysed.push(*one);
            continue;
        };
        match excluded.iter_mut().find(|it| it.reason == reason) {
            Some(known) => known.count += 1,
            None => excluded.push(Excluded { reason, count: 1 }),
        }
    }
    let place = |it: &Excluded| reasons(plan).position(|reason| reason == it.reason);
    excluded.sort_by_key(place);
    let others = analysed.iter();
    let others = others.filter(|it| !it.plan_sha256.is_empty() && it.plan_sha256 != sha256);
    let people = People {
        recruited: participants.len(),
        excluded,
        analysed: analysed.len(),
        other_plan: others.count(),
        profile: profile(plan, &in_order, &analysed),
    };
    (people, analysed)
}

/// Returns every reason to leave somebody out, in the order in which they are tried.
fn reasons(plan: &Plan) -> impl Iterator<Item = Reason> {
    let filter = plan.analysed.iter().map(|it| Reason::Filter {
        question: it.question.clone(),
    });
    let rules = plan.exclusions.iter().copied().map(Reason::Rule);
    [Reason::NoConsent].into_iter().chain(filter).chain(rules)
}

fn reason_against(plan: &Plan, one: &Participant) -> Option<Reason> {
    reasons(plan).find(|reason| match reason {
        // Answers that came without any agreement, as from tables of other tools, were agreed to there.
        Reason::NoConsent => one.consent.get("analysis") == Some(&false),
        Reason::Filter { question } => {
            let given = one.profile.get(question);
            let wanted = plan.analysed.as_ref();
            !given.is_some_and(|it| wanted.is_some_and(|wanted| wanted.options.contains(it)))
        }
        Reason::Rule(Exclusion::Unfinished) => !one.finished,
        Reason::Rule(Exclusion::ChecksWrong(most)) => wrong_checks(plan, one) > *most as usize,
        Reason::Rule(Exclusion::OneValue) => has_one_value(plan, one),
    })
}

/// Returns how many answers to check trials are wrong; `I cannot say` is wrong, too.
fn wrong_checks(plan: &Plan, one: &Participant) -> usize {
    let checks = one.answers.iter().filter(|it| it.role == Role::Check);
    let wrong = checks.filter(|it| {
        let trial = plan.trial(&it.part, &it.item, &it.condition, it.role);
        let right = trial.and_then(|trial| trial.right.get(&it.question));
        match right {
            Some(right) => it.choice.as_ref() != Some(right),
            None => it.right == Some(false),
        }
    });
    wrong.count()
}

/// Returns whether somebody gave several answers on scales, all with one value.
fn has_one_value(plan: &Plan, one: &Participant) -> bool {
    let on_scale = |name: &str| {
        let question = plan.question(name);
        question.is_some_and(|it| matches!(it.kind, QuestionKind::Scale { .. }))
    };
    let main = one.answers.iter().filter(|it| it.role == Role::Main);
    let mut values = main
        .filter(|it| on_scale(&it.question))
        .filter_map(|it| it.value);
    let Some(first) = values.next() else {
        return false;
    };
    let rest: Vec<i64> = values.collect();
    !rest.is_empty() && rest.iter().all(|it| *it == first)
}

fn profile(plan: &Plan, all: &[&Participant], analysed: &[&Participant]) -> Vec<ProfileTable> {
    let tables = plan.profile.iter().map(|question| {
        let mut options: Vec<(Option<String>, Texts)> = question
            .options
            .iter()
            .map(|it| (Some(it.name.clone()), it.text.clone()))
            .collect();
        let known = |options: &[(Option<String>, Texts)], name: &String| {
            options.iter().any(|it| it.0.as_ref() == Some(name))
        };
        for name in all.iter().filter_map(|it| it.profile.get(&question.name)) {
            if !known(&options, name) {
                options.push((Some(name.clone()), Texts::new()));
            }
        }
        options.push((None, Texts::new()));
        let count = |people: &[&Participant], option: &Option<String>| {
            let same = |it: &&&Participant| it.profile.get(&question.name) == option.as_ref();
            people.iter().filter(same).count()
        };
        let rows = options.into_iter().map(|(option, text)| ProfileRow {
            recruited: count(all, &option),
            analysed: count(analysed, &option),
            option,
            text,
        });
        // Nobody has to be counted who gave no answer.
        let rows = rows.filter(|row| row.option.is_some() || row.recruited > 0);
        ProfileTable {
            question: question.name.clone(),
            text: question.text.clone(),
            rows: rows.collect(),
        }
    });
    tables.collect()
}
