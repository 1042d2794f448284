//! The answers to each question: counts, descriptions, recognition, confusions and models.

use std::collections::BTreeMap;

use chereme_analysis::statistics::{GroupDescription, UndefinedStatistic, ordinal, wilson_interval};

use super::{AnswerGroup, AnswerShare, ConfusionTable, ModelReport, QuestionReport};
use crate::study::study_answers::{StudyAnswer, StudyParticipant};
use crate::study::study_plan::{QuestionKind, StudyPlan, StudyQuestion, StudyTrial, TrialRole};

/// The level of the intervals of shares.
const SHARE_INTERVAL_LEVEL: f64 = 0.95;

/// Returns the main answers of a participant to a question.
pub(super) fn main_answers<'a>(one: &'a StudyParticipant, question: &'a str) -> impl Iterator<Item = &'a StudyAnswer> {
    let main = one.answers.iter().filter(|answer| answer.role == TrialRole::Main);
    main.filter(move |answer| answer.question == question)
}

/// Returns the right option of an answer, if the plan names one.
fn right_option<'a>(plan: &'a StudyPlan, answer: &StudyAnswer) -> Option<&'a String> {
    let trial = plan.find_plan_trial(&answer.part, &answer.item, &answer.condition, answer.role)?;
    trial.right.get(&answer.question)
}

/// Returns an answer as a number: its place on the scale, or 1 for the right option and 0 for a wrong one.
pub(super) fn answer_as_number(plan: &StudyPlan, question: &StudyQuestion, answer: &StudyAnswer) -> Option<f64> {
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => {
            let value = answer.value.filter(|score| (low..=high).contains(&score));
            value.map(|score| score as f64)
        }
        QuestionKind::Choice { .. } => {
            let choice = answer.choice.as_ref()?;
            let right = right_option(plan, answer).map(|right| right == choice);
            right.or(answer.right).map(|right| f64::from(u8::from(right)))
        }
    }
}

/// Returns the place of an answer among the numbers of the scale or the options.
fn answer_option_place(question: &StudyQuestion, answer: &StudyAnswer) -> Option<usize> {
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => {
            let value = answer.value.filter(|score| (low..=high).contains(&score))?;
            usize::try_from(value - low).ok()
        }
        QuestionKind::Choice { options } => {
            let choice = answer.choice.as_ref()?;
            options.iter().position(|option| option.name == *choice)
        }
    }
}

/// Returns the number of possible answers.
fn count_possible_answers(question: &StudyQuestion) -> usize {
    match &question.kind {
        // The plan allows ten numbers; a larger scale of a damaged plan gets no table.
        QuestionKind::Scale { low, high, .. } => {
            usize::try_from(high.saturating_sub(*low)).map_or(0, |steps| steps.min(99) + 1)
        }
        QuestionKind::Choice { options } => options.len(),
    }
}

/// Returns the main trials in which a question is asked.
pub(super) fn trials_of<'a>(plan: &'a StudyPlan, question: &StudyQuestion) -> Vec<&'a StudyTrial> {
    let asked = |trial: &&StudyTrial| plan.questions_of_trial(trial).any(|other| other.name == question.name);
    plan.main().filter(asked).collect()
}

/// Returns the answers to a question, described.
pub(super) fn of_question(plan: &StudyPlan, question: &StudyQuestion, people: &[&StudyParticipant]) -> QuestionReport {
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
        let wanted = |answer: &StudyAnswer| {
            answer.part == part && answer.condition == condition && item.is_none_or(|item| answer.item == item)
        };
        collect_trial_group(plan, question, people, part, item, condition, &wanted)
    };
    let parts = |pair: &(&str, &str)| pair.0.to_owned();
    let mut names: Vec<String> = conditions.iter().map(parts).collect();
    names.dedup();
    QuestionReport {
        name: question.name.clone(),
        text: question.text.clone(),
        kind: question.kind.clone(),
        confusions: confusions(plan, question, people, &conditions),
        models: names
            .iter()
            .filter_map(|part| part_model_report(plan, question, people, part))
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

fn collect_trial_group(
    plan: &StudyPlan,
    question: &StudyQuestion,
    people: &[&StudyParticipant],
    part: &str,
    item: Option<&str>,
    condition: &str,
    wanted: &dyn Fn(&StudyAnswer) -> bool,
) -> AnswerGroup {
    let mut counts = vec![0; count_possible_answers(question)];
    let (mut answered, mut answers, mut cannot_say) = (0, 0, 0);
    let (mut values, mut person_means) = (Vec::new(), Vec::new());
    for one in people {
        let mut person_values = Vec::new();
        let before = answers;
        for answer in main_answers(one, &question.name).filter(|answer| wanted(answer)) {
            match answer_option_place(question, answer) {
                Some(at) if at < counts.len() => {
                    counts[at] += 1;
                    answers += 1;
                }
                // An answer without a place on the scale or among the options is one of not knowing.
                _ => cannot_say += 1,
            }
            person_values.extend(answer_as_number(plan, question, answer));
        }
        answered += usize::from(answers > before);
        if !person_values.is_empty() {
            person_means.push(person_values.iter().sum::<f64>() / person_values.len() as f64);
        }
        values.append(&mut person_values);
    }
    person_means.sort_by(f64::total_cmp);
    let scale = matches!(question.kind, QuestionKind::Scale { .. });
    AnswerGroup {
        part: part.to_owned(),
        item: item.map(str::to_owned),
        condition: condition.to_owned(),
        people: answered,
        answers,
        cannot_say,
        counts,
        recognition: if scale { None } else { share_of_ones(&values) },
        description: GroupDescription::describe_values(&values).ok().filter(|_| scale),
        person_means: if scale { person_means } else { Vec::new() },
    }
}

/// Returns the share of ones among zeros and ones.
fn share_of_ones(values: &[f64]) -> Option<AnswerShare> {
    let right = values.iter().filter(|value| **value == 1.0).count();
    let interval = wilson_interval(right as u64, values.len() as u64, SHARE_INTERVAL_LEVEL).ok()?;
    Some(AnswerShare {
        right,
        of: values.len(),
        share: right as f64 / values.len() as f64,
        interval,
    })
}

fn confusions(
    plan: &StudyPlan,
    question: &StudyQuestion,
    people: &[&StudyParticipant],
    conditions: &[(&str, &str)],
) -> Vec<ConfusionTable> {
    let QuestionKind::Choice { options } = &question.kind else {
        return Vec::new();
    };
    let columns: Vec<String> = options.iter().map(|option| option.name.clone()).collect();
    let mut parts: Vec<&str> = conditions.iter().map(|pair| pair.0).collect();
    parts.dedup();
    let table = |part: &str, condition: Option<&str>| {
        let mut cells: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for answer in people.iter().flat_map(|one| main_answers(one, &question.name)) {
            let is_counted = answer.part == part && condition.is_none_or(|name| answer.condition == name);
            if let Some(at) = answer_option_place(question, answer).filter(|_| is_counted) {
                let right_name = right_option(plan, answer).unwrap_or(&answer.item);
                let row = cells
                    .entry(right_name.clone())
                    .or_insert_with(|| vec![0; columns.len()]);
                row[at] += 1;
            }
        }
        let mut rows: Vec<String> = cells.keys().cloned().collect();
        // Rows come in the order of the options, so that right answers lie on the diagonal.
        rows.sort_by_key(|row| columns.iter().position(|column| column == row).unwrap_or(usize::MAX));
        ConfusionTable {
            part: part.to_owned(),
            condition: condition.map(str::to_owned),
            counts: rows.iter().map(|row| cells[row].clone()).collect(),
            rows,
            columns: columns.clone(),
        }
    };
    let mut tables = Vec::new();
    for part in parts {
        let part_conditions: Vec<&str> = conditions
            .iter()
            .filter(|pair| pair.0 == part)
            .map(|pair| pair.1)
            .collect();
        tables.push(table(part, None));
        if part_conditions.len() > 1 {
            tables.extend(
                part_conditions
                    .into_iter()
                    .map(|condition| table(part, Some(condition))),
            );
        }
    }
    tables
}

/// Returns the model of a part with several conditions.
fn part_model_report(
    plan: &StudyPlan,
    question: &StudyQuestion,
    people: &[&StudyParticipant],
    part: &str,
) -> Option<ModelReport> {
    if !matches!(question.kind, QuestionKind::Scale { .. }) {
        return None;
    }
    let mut conditions: Vec<&str> = Vec::new();
    let mut items: Vec<&str> = Vec::new();
    let trials = trials_of(plan, question);
    for trial in trials.iter().filter(|trial| trial.part == part) {
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
        // The first item is the reference, and gets no column of its own.
        let items = if with_items { &items[1..] } else { &[] };
        let (mut answers, mut rows) = (Vec::new(), Vec::new());
        for answer in people.iter().flat_map(|one| main_answers(one, &question.name)) {
            let is_counted = answer.part == part && conditions.contains(&answer.condition.as_str());
            let value = answer_as_number(plan, question, answer).and(answer.value);
            if let Some(value) = value.filter(|_| is_counted) {
                let column = |own: &str, name: &&str| f64::from(u8::from(own == *name));
                let first = conditions[1..]
                    .iter()
                    .map(|condition| column(&answer.condition, condition));
                let second = items.iter().map(|item| column(&answer.item, item));
                rows.push(first.chain(second).collect());
                answers.push(value);
            }
        }
        ordinal::fit_ordinal_model(&answers, &rows)
    };
    let mut with_items = items.len() > 1;
    let mut fitted = fit(with_items);
    // If each item has one condition, the two cannot be separated, and conditions matter more.
    if with_items && fitted == Err(UndefinedStatistic::Dependent) {
        with_items = false;
        fitted = fit(false);
    }
    Some(ModelReport {
        part: part.to_owned(),
        reference: conditions[0].to_owned(),
        conditions: conditions[1..]
            .iter()
            .map(|condition| (*condition).to_owned())
            .collect(),
        with_items,
        model: fitted.into(),
    })
}
