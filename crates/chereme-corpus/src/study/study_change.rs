//! A stored plan as the request that makes it, so that it can be changed.

use std::collections::{BTreeMap, BTreeSet};

use super::distances::DISTANCE_MEASURE_NAME;
use super::request::quote_item_name;
use super::study_plan::{QuestionKind, StudyPlan, StudyQuestion, StudyTrial, TrialRole, text_in};
use super::study_trials::{ListedTrial, new_study_trial, write_trial_table};
use super::{StudyRequest, split_quoted_words, study_check};
use crate::Corpus;
use crate::error::CorpusResult;

/// The name of the table of trials in messages.
const TRIAL_TABLE_NAME: &str = "table";
/// The largest distance of two performances that are one.
const MAX_SAME_DISTANCE: f64 = 1e-6;

impl Corpus {
    /// Checks a plan without storing it; clips are not made.
    ///
    /// # Errors
    /// Fails with all faults of the plan, each with its place.
    pub fn check_plan(plan: &StudyPlan) -> CorpusResult<()> {
        study_check::check_study_plan(plan)
    }
}

impl StudyRequest {
    /// Returns the request that makes a stored plan again; its second part is the condition from which distances were
    /// measured, if there is one: the request states no distances. Trials are items and conditions if they can be, else a
    /// table.
    #[must_use]
    pub fn from_stored_plan(plan: &StudyPlan) -> (Self, Option<String>) {
        let from = measured_from(plan);
        let mut plain = plan.clone();
        if from.is_some() {
            for trial in &mut plain.trials {
                trial.measures.remove(DISTANCE_MEASURE_NAME);
            }
        }
        let title = text_in(&plan.title, "en");
        let base = Self {
            name: plan.name.clone(),
            title: title.filter(|text| *text != plan.name).map(str::to_owned),
            scale: usual_end(plan),
            design: plan.design,
            hypotheses: plan.hypotheses.clone(),
            exclusions: plan.exclusions.clone(),
            before: Some(plan.clone()),
            ..Self::default()
        };
        let table = |trials: &[StudyTrial]| {
            let text = write_trial_table(trials);
            (!trials.is_empty()).then(|| (text, TRIAL_TABLE_NAME.to_owned()))
        };
        let mut attempts = Vec::new();
        if let Some((items, conditions)) = crossed_plan_start(&plain) {
            let rest_trials = plain.trials.get(items.len() * conditions.len()..);
            let rest: Vec<StudyTrial> = rest_trials.unwrap_or_default().iter().map(shorten_trial).collect();
            attempts.push(Self {
                items,
                conditions,
                trials: table(&rest),
                ..base.clone()
            });
        }
        let all: Vec<StudyTrial> = plain.trials.iter().map(shorten_trial).collect();
        for trials in [&all, &plain.trials] {
            attempts.push(Self {
                trials: table(trials),
                ..base.clone()
            });
        }
        let others = Self {
            others: plain.trials.clone(),
            ..base
        };
        let listed: Vec<ListedTrial> = plain
            .trials
            .iter()
            .cloned()
            .map(ListedTrial::from_plain_trial)
            .collect();
        for mut request in attempts {
            let questions = plan.questions.iter();
            request.questions = questions.map(|question| request.wording(question, &listed)).collect();
            if request.make_study_plan().is_ok_and(|rebuilt| rebuilt == plain) {
                return (request, from);
            }
        }
        let plan_questions = plan.questions.iter();
        let questions = plan_questions
            .map(|question| others.wording(question, &listed))
            .collect();
        (Self { questions, ..others }, from)
    }

    /// Returns the words of a question: the shortest that state it.
    fn wording(&self, question: &StudyQuestion, trials: &[ListedTrial]) -> String {
        let head = question_head(question);
        let mut candidates = Vec::new();
        match &question.kind {
            QuestionKind::Scale { .. } => candidates.push(head),
            QuestionKind::Choice { options } => {
                candidates.push(format!("{head}=items"));
                let items = |name: &String| trials.iter().any(|listed| listed.trial.item == *name);
                let rest_names = options.iter().map(|option| &option.name).filter(|name| !items(name));
                let rest: Vec<String> = rest_names.map(|name| quote_item_name(name)).collect();
                candidates.push(format!("{head}=items {}", rest.join(" ")));
            }
        }
        let states = |text: &String| self.states(text, question, trials);
        let first_match = candidates.into_iter().find(states);
        first_match.unwrap_or_else(|| question_words(question))
    }

    /// Returns whether the words of a question state its name, parts, and possible answers.
    fn states(&self, text: &str, question: &StudyQuestion, trials: &[ListedTrial]) -> bool {
        let read = self.parse_question_request(text, trials);
        read.is_ok_and(|parsed| {
            (&parsed.name, &parsed.parts) == (&question.name, &question.parts)
                && answer_scale_and_options(&parsed.kind) == answer_scale_and_options(&question.kind)
        })
    }

    /// Returns the question of the plan before that these words stand for, although they do not state it.
    pub(super) fn unstated_question(&self, text: &str, trials: &[ListedTrial]) -> Option<&StudyQuestion> {
        let mut before = self.before.iter().flat_map(|plan| &plan.questions);
        before.find(|question| question_words(question).trim() == text.trim() && !self.states(text, question, trials))
    }

    /// Takes from the plan before what the words of a question do not state.
    pub(super) fn keep_unstated_parts(&self, mut question: StudyQuestion) -> StudyQuestion {
        let before = self.before.as_ref();
        let Some(before) = before.and_then(|plan| plan.find_plan_question(&question.name)) else {
            return question;
        };
        question.text.clone_from(&before.text);
        question.after = before.after;
        question.cannot_say = before.cannot_say;
        let same = answer_scale_and_options(&question.kind) == answer_scale_and_options(&before.kind);
        match (&mut question.kind, &before.kind) {
            (QuestionKind::Scale { .. }, QuestionKind::Scale { .. }) if same => {
                question.kind = before.kind.clone();
            }
            (QuestionKind::Choice { options }, QuestionKind::Choice { options: old }) => {
                for option in options {
                    if let Some(known) = old.iter().find(|other| other.name == option.name) {
                        option.clone_from(known);
                    }
                }
            }
            _ => {}
        }
        question
    }
}

/// Returns the name of a question, with its parts.
fn question_head(question: &StudyQuestion) -> String {
    match question.parts.as_slice() {
        [] => question.name.clone(),
        parts => format!("{}@{}", question.name, parts.join(",")),
    }
}

/// Returns the words of a question with all its answers.
fn question_words(question: &StudyQuestion) -> String {
    let answers = match &question.kind {
        QuestionKind::Scale { low, high, .. } => format!("{low}-{high}"),
        QuestionKind::Choice { options } => {
            let names: Vec<String> = options.iter().map(|option| quote_item_name(&option.name)).collect();
            names.join(" ")
        }
    };
    format!("{}={answers}", question_head(question))
}

/// Returns the ends of a scale, and the names of options.
fn answer_scale_and_options(kind: &QuestionKind) -> (Option<[i64; 2]>, Vec<&str>) {
    match kind {
        QuestionKind::Scale { low, high, .. } => (Some([*low, *high]), Vec::new()),
        QuestionKind::Choice { options } => (None, options.iter().map(|option| option.name.as_str()).collect()),
    }
}

/// Returns the highest answer that most scales from 1 have.
fn usual_end(plan: &StudyPlan) -> i64 {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for question in &plan.questions {
        if let QuestionKind::Scale { low: 1, high, .. } = question.kind {
            *counts.entry(high).or_default() += 1;
        }
    }
    let most = counts.into_iter().max_by_key(|entry| entry.1);
    most.map_or(5, |entry| entry.0)
}

/// Returns the condition from which the distances of a plan were measured: its own clips have none.
fn measured_from(plan: &StudyPlan) -> Option<String> {
    let distance = |trial: &StudyTrial| trial.measures.get(DISTANCE_MEASURE_NAME).copied();
    let fits = |condition: &&str| {
        let condition_trials = || plan.trials.iter().filter(|trial| trial.condition == *condition);
        let items: BTreeSet<&str> = condition_trials().map(|trial| trial.item.as_str()).collect();
        let has = |trial: &StudyTrial| distance(trial).is_some() == items.contains(trial.item.as_str());
        condition_trials().all(|trial| distance(trial).is_some_and(|value| value.abs() < MAX_SAME_DISTANCE))
            && plan.trials.iter().all(has)
    };
    let conditions = plan.main_conditions();
    conditions.into_iter().find(fits).map(str::to_owned)
}

/// Returns a trial without the right answers that a table gives it anyway: its item, if that is an option.
fn shorten_trial(it: &StudyTrial) -> StudyTrial {
    let mut it = it.clone();
    let item = it.item.clone();
    it.right.retain(|_, right| *right != item);
    it
}

/// The items, and the conditions with their recipes.
type CrossedConditions = (Vec<String>, Vec<(String, String)>);

/// Returns the items and conditions with which a plan begins.
fn crossed_plan_start(plan: &StudyPlan) -> Option<CrossedConditions> {
    let simple =
        |trial: &&StudyTrial| trial.role == TrialRole::Main && trial.part.is_empty() && trial.measures.is_empty();
    let trials: Vec<&StudyTrial> = plan.trials.iter().take_while(simple).collect();
    let first = &trials.first()?.item;
    let count = trials.iter().take_while(|trial| trial.item == *first).count();
    let rows = || trials.chunks_exact(count);
    let mut conditions = Vec::with_capacity(count);
    let mut most = rows().count();
    for (at, it) in trials[..count].iter().enumerate() {
        let item = quote_item_name(&it.item);
        let recipes = [it.clip.replace(&item, "{}"), it.clip.replacen(&item, "{}", 1)];
        let reach = |recipe: &String| {
            let fits = |row: &&[&StudyTrial]| {
                let made = new_study_trial(
                    &row[0].item,
                    &it.condition,
                    recipe.replace("{}", &quote_item_name(&row[0].item)),
                );
                let row_trial = row[at];
                (&row_trial.item, &row_trial.condition, &row_trial.clip) == (&made.item, &made.condition, &made.clip)
            };
            rows().take_while(fits).count()
        };
        let recipe = recipes.into_iter().max_by_key(|candidate| reach(candidate))?;
        let plain = |text: &str| !text.is_empty() && text.trim() == text;
        if !recipe.contains("{}") || !plain(&recipe) || !plain(&it.condition) {
            return None;
        }
        most = most.min(reach(&recipe));
        conditions.push((it.condition.clone(), recipe));
    }
    let item_names = rows().take(most).map(|row| row[0].item.clone());
    let items: Vec<String> = item_names
        .take_while(|item| split_quoted_words(&quote_item_name(item)) == [item.as_str()])
        .collect();
    (!items.is_empty()).then_some((items, conditions))
}

#[cfg(test)]
mod tests;
