//! The answers to each question: counts, descriptions, recognition, confusions and models.

use std::collections::BTreeMap;

use chereme_analysis::statistics::{Description, Undefined, ordinal, wilson};

use super::{Confusion, Group, ModelReport, QuestionReport, Share};
use crate::study::answers::{Answer, Participant};
use crate::study::plan::{Plan, Question, QuestionKind, Role, Trial};

/// The level of the intervals of shares.
const LEVEL: f64 = 0.95;

/// Returns the main answers of a participant to a question.
pub(super) fn main_answers<'a>(
    one: &'a Participant,
    question: &'a str,
) -> impl Iterator<Item = &'a Answer> {
    let main = one.answers.iter().filter(|it| it.role == Role::Main);
    main.filter(move |it| it.question == question)
}

/// Returns the right option of an answer, if the plan names one.
fn right_option<'a>(plan: &'a Plan, answer: &Answer) -> Option<&'a String> {
    let trial = plan.trial(&answer.part, &answer.item, &answer.condition, answer.role)?;
    trial.right.get(&answer.question)
}

/// Returns an answer as a number: its place on the scale, or 1 for the right option and 0 for a wrong one.
pub(super) fn number(plan: &Plan, question: &Question, answer: &Answer) -> Option<f64> {
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => {
            let value = answer.value.filter(|it| (low..=high).contains(&it));
            value.map(|it| it as f64)
        }
        QuestionKind::Choice { .. } => {
            let choice = answer.choice.as_ref()?;
            let right = right_option(plan, answer).map(|right| right == choice);
            right
                .or(answer.right)
                .map(|right| f64::from(u8::from(right)))
        }
    }
}

/// Returns the place of an answer among the numbers of the scale or the options.
fn place(question: &Question, answer: &Answer) -> Option<usize> {
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => {
            let value = answer.value.filter(|it| (low..=high).contains(&it))?;
            usize::try_from(value - low).ok()
        }
        QuestionKind::Choice { options } => {
            let choice = answer.choice.as_ref()?;
            options.iter().position(|it| it.name == *choice)
        }
    }
}

/// Returns the number of possible answers.
fn width(question: &Question) -> usize {
    match &question.kind {
        // The plan allows ten numbers; a larger scale of a damaged plan gets no table.
        QuestionKind::Scale { low, high, .. } => {
            usize::try_from(high.saturating_sub(*low)).map_or(0, |it| it.min(99) + 1)
        }
        QuestionKind::Choice { options } => options.len(),
    }
}

/// Returns the main trials in which a question is asked.
pub(super) fn trials_of<'a>(plan: &'a Plan, question: &Question) -> Vec<&'a Trial> {
    let asked = |trial: &&Trial| plan.asked(trial).any(|it| it.name == question.name);
    plan.main().filter(asked).collect()
}

/// Returns the answers to a question, described.
pub(super) fn of_question(
    plan: &Plan,
    question: &Question,
    people: &[&Participant],
) -> QuestionReport {
    let trials = trials_of(plan, question);
    let mut conditions: Vec<(&str, &str)> = Vec::new();
    let mut items: Vec<(&str, &str, &str)> = Vec::new();
    for trial in &trials {
        let (part, item, condition) = (&trial.part, &trial.item, &trial.condition);
        if !conditions.contains(&(part, condition)) {
            conditions.push((part, condition));
        }
        if !items.contains(&(part, item, condition)) {
            items.push((part, item, condition));
        }
    }
    let describe = |part: &str, item: Option<&str>, condition: &str| {
        let wanted = |it: &Answer| {
            it.part == part && it.condition == condition && item.is_none_or(|item| it.item == item)
        };
        group(plan, question, people, (part, item, condition), &wanted)
    };
    let parts = |it: &(&str, &str)| it.0.to_owned();
    let mut names: Vec<String> = conditions.iter().map(parts).collect();
    names.dedup();
    QuestionReport {
        name: question.name.clone(),
        text: question.text.clone(),
        kind: question.kind.clone(),
        confusions: confusions(plan, question, people, &conditions),
        models: names
            .iter()
            .filter_map(|part| model(plan, question, people, part))
            .collect(),
        items: items
            .iter()
            .map(|(part, item, condition)| describe(part, Some(item), condition))
            .collect(),
        conditions: conditions
            .iter()
            .map(|(part, condition)| describe(part, None, condition))
            .collect(),
    }
}

fn group(
    plan: &Plan,
    question: &Question,
    people: &[&Participant],
    (part, item, condition): (&str, Option<&str>, &str),
    wanted: &dyn Fn(&Answer) -> bool,
) -> Group {
    let mut counts = vec![0; width(question)];
    let (mut answered, mut answers, mut cannot_say) = (0, 0, 0);
    let (mut values, mut person_means) = (Vec::new(), Vec::new());
    for one in people {
        let mut own = Vec::new();
        let before = answers;
        for answer in main_answers(one, &question.name).filter(|it| wanted(it)) {
            match place(question, answer) {
                Some(at) if at < counts.len() => {
                    counts[at] += 1;
                    answers += 1;
                }
                _ => cannot_say += 1,
            }
            own.extend(number(plan, question, answer));
        }
        answered += usize::from(answers > before);
        if !own.is_empty() {
            person_means.push(own.iter().sum::<f64>() / own.len() as f64);
        }
        values.append(&mut own);
    }
    person_means.sort_by(f64::total_cmp);
    let scale = matches!(question.kind, QuestionKind::Scale { .. });
    Group {
        part: part.to_owned(),
        item: item.map(str::to_owned),
        condition: condition.to_owned(),
        people: answered,
        answers,
        cannot_say,
        counts,
        recognition: if scale { None } else { share(&values) },
        description: Description::of(&values).ok().filter(|_| scale),
        person_means: if scale { person_means } else { Vec::new() },
    }
}

/// Returns the share of ones among zeros and ones.
fn share(values: &[f64]) -> Option<Share> {
    let right = values.iter().filter(|it| **it == 1.0).count();
    let interval = wilson(right as u64, values.len() as u64, LEVEL).ok()?;
    Some(Share {
        right,
        of: values.len(),
        share: right as f64 / values.len() as f64,
        interval,
    })
}

fn confusions(
    plan: &Plan,
    question: &Question,
    people: &[&Participant],
    conditions: &[(&str, &str)],
) -> Vec<Confusion> {
    let QuestionKind::Choice { options } = &question.kind else {
        return Vec::new();
    };
    let columns: Vec<String> = options.iter().map(|it| it.name.clone()).collect();
    let mut parts: Vec<&str> = conditions.iter().map(|it| it.0).collect();
    parts.dedup();
    let table = |part: &str, condition: Option<&str>| {
        let mut cells: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for answer in people
            .iter()
            .flat_map(|one| main_answers(one, &question.name))
        {
            let own = answer.part == part && condition.is_none_or(|it| answer.condition == it);
            if let Some(at) = place(question, answer).filter(|_| own) {
                let row = right_option(plan, answer).unwrap_or(&answer.item);
                let row = cells
                    .entry(row.clone())
                    .or_insert_with(|| vec![0; columns.len()]);
                row[at] += 1;
            }
        }
        let mut rows: Vec<String> = cells.keys().cloned().collect();
        // Rows come in the order of the options, so that right answers lie on the diagonal.
        rows.sort_by_key(|row| {
            columns
                .iter()
                .position(|it| it == row)
                .unwrap_or(usize::MAX)
        });
        Confusion {
            part: part.to_owned(),
            condition: condition.map(str::to_owned),
            counts: rows.iter().map(|row| cells[row].clone()).collect(),
            rows,
            columns: columns.clone(),
        }
    };
    let mut tables = Vec::new();
    for part in parts {
        let own: Vec<&str> = conditions
            .iter()
            .filter(|it| it.0 == part)
            .map(|it| it.1)
            .collect();
        tables.push(table(part, None));
        if own.len() > 1 {
            tables.extend(
                own.into_iter()
                    .map(|condition| table(part, Some(condition))),
            );
        }
    }
    tables
}

/// Returns the model of a part with several conditions.
fn model(
    plan: &Plan,
    question: &Question,
    people: &[&Participant],
    part: &str,
) -> Option<ModelReport> {
    if !matches!(question.kind, QuestionKind::Scale { .. }) {
        return None;
    }
    let mut conditions: Vec<&str> = Vec::new();
    let mut items: Vec<&str> = Vec::new();
    let trials = trials_of(plan, question);
    for trial in trials.iter().filter(|it| it.part == part) {
        if !conditions.contains(&trial.condition.as_str()) {
            conditions.push(&trial.condition);
        }
        if !items.contains(&trial.item.as_str()) {
            items.push(&trial.item);
        }
    }
    if conditions.len() < 2 {
        return None;
    }
    let fit = |with_items: bool| {
        let items = if with_items { &items[1..] } else { &[] };
        let (mut answers, mut rows) = (Vec::new(), Vec::new());
        for answer in people
            .iter()
            .flat_map(|one| main_answers(one, &question.name))
        {
            let known = answer.part == part && conditions.contains(&answer.condition.as_str());
            let value = number(plan, question, answer).and(answer.value);
            if let Some(value) = value.filter(|_| known) {
                let column = |own: &str, name: &&str| f64::from(u8::from(own == *name));
                let first = conditions[1..]
                    .iter()
                    .map(|it| column(&answer.condition, it));
                let second = items.iter().map(|it| column(&answer.item, it));
                rows.push(first.chain(second).collect());
                answers.push(value);
            }
        }
        ordinal::fit(&answers, &rows)
    };
    let mut with_items = items.len() > 1;
    let mut found = fit(with_items);
    if with_items && found == Err(Undefined::Dependent) {
        with_items = false;
        found = fit(false);
    }
    Some(ModelReport {
        part: part.to_owned(),
        reference: conditions[0].to_owned(),
        conditions: conditions[1..].iter().map(|it| (*it).to_owned()).collect(),
        with_items,
        model: found.into(),
    })
}
