//! The answers to a study one by one, with the trials that somebody was to see and did not answer.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::text::fold_text;
use serde::Serialize;

use super::stored;
use super::study_answers::{StudyAnswer, StudyParticipant};
use super::study_order::{self, ShownTrial};
use super::study_plan::{StudyPlan, StudyTrial, TrialRole};
use super::{StudyWithAnswers, find_stored_study, no_participant};
use crate::Corpus;
use crate::db::stored_search::begin_reading;
use crate::error::CorpusResult;

/// The answers to a study.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct AnswerList {
    /// The study.
    pub study: String,
    /// The participants by code.
    pub participants: Vec<ParticipantSummary>,
    /// The answers and the missing ones, by participant and place in the order.
    pub rows: Vec<AnswerListRow>,
}

/// A participant, and how much was answered.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParticipantSummary {
    /// The code that the participant chose.
    pub code: String,
    /// The day on which the questionnaire was begun; empty if unknown.
    pub started_day: String,
    /// The language of the texts; empty if unknown.
    pub language: String,
    /// Whether the questionnaire was answered to its end.
    pub finished: bool,
    /// The answers about the participant.
    pub profile: BTreeMap<String, String>,
    /// The number of answers.
    pub answers: u64,
    /// The number of questions that were passed over.
    pub skipped: u64,
    /// The number of questions that were not reached.
    pub not_reached: u64,
}

/// An answer to one question about one film, or its absence.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct AnswerListRow {
    /// The code of the participant.
    pub participant: String,
    /// The place of the trial in the participant's order, from 1; none if the order is not known.
    pub n: Option<u32>,
    /// The block, from 1; 0 for training.
    pub block: u32,
    /// The part of the study.
    pub part: String,
    /// The item.
    pub item: String,
    /// The condition.
    pub condition: String,
    /// The use of the answer.
    pub role: TrialRole,
    /// The question.
    pub question: String,
    /// Whether there is an answer.
    pub state: AnswerState,
    /// The number or the option; empty without an answer.
    pub answer: String,
    /// Whether it is right; none if the plan names no right option.
    pub right: Option<bool>,
    /// How often the film was played.
    pub plays: u32,
    /// Milliseconds from the end of the first viewing to the answer.
    pub ms: u32,
}

/// Whether there is an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum AnswerState {
    /// The question was answered.
    Answered,
    /// The participant could not say.
    CannotSay,
    /// The participant went on without an answer, for example because the browser could not show the film.
    Skipped,
    /// The participant ended before.
    NotReached,
}

/// The answers that are wanted; all without any condition.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AnswerFilter {
    /// Those of this participant.
    pub participant: Option<String>,
    /// Those whose item, condition, part or question contains each of these words, whatever their case and accents.
    pub text: String,
    /// The questions without an answer alone.
    pub missing: bool,
}

impl AnswerFilter {
    /// Returns whether a row is wanted.
    #[must_use]
    pub fn holds_answer_row(&self, row: &AnswerListRow) -> bool {
        let by = |code: &String| row.participant == code.trim();
        let raw_fields = [&row.item, &row.condition, &row.part, &row.question];
        let fields = raw_fields.map(|field| fold_text(field));
        let within = |word: &str| fields.iter().any(|field| field.contains(word));
        let gone = [AnswerState::Skipped, AnswerState::NotReached];
        self.participant.as_ref().is_none_or(by)
            && (!self.missing || gone.contains(&row.state))
            && fold_text(&self.text).split_whitespace().all(within)
    }
}

impl AnswerList {
    /// Keeps the rows that a filter holds.
    ///
    /// # Errors
    /// Fails if the filter names a participant who is not in the list.
    pub fn keep_filtered_rows(&mut self, filter: &AnswerFilter) -> CorpusResult<()> {
        let is_known = |code: &str| {
            self.participants
                .iter()
                .any(|participant| participant.code == code.trim())
        };
        match &filter.participant {
            Some(code) if !is_known(code) => Err(no_participant(code)),
            _ => {
                self.rows.retain(|row| filter.holds_answer_row(row));
                Ok(())
            }
        }
    }
}

impl Corpus {
    /// Returns the answers to a study one by one. Trials that a participant was to see by the order of the plan and did
    /// not answer are rows, too.
    ///
    /// # Errors
    /// Fails if there is no study of that name.
    pub fn study_answers(&self, name: &str) -> CorpusResult<AnswerList> {
        let reading = begin_reading(self.store.read_connection())?;
        let stored_study = find_stored_study(&reading, name)?;
        let participants = stored::stored_participants(&reading, &stored_study, None)?;
        Ok(list_study_answers(&StudyWithAnswers {
            plan: stored_study.plan,
            plan_sha256: stored_study.sha256,
            participants,
        }))
    }
}

fn list_study_answers(study: &StudyWithAnswers) -> AnswerList {
    let plan = &study.plan;
    let orders = study_order::trial_order_rows(plan);
    let mut list = AnswerList {
        study: plan.name.clone(),
        ..AnswerList::default()
    };
    for person in &study.participants {
        let drawn_order = orders.get(person.seed as usize % orders.len().max(1));
        // A seed that does not fit the answers says nothing about their order.
        let order = drawn_order.filter(|candidate| is_order_of(plan, candidate, person));
        let mut rows: Vec<AnswerListRow> = person
            .answers
            .iter()
            .map(|answer| given_answer_row(person, answer, order.is_some()))
            .collect();
        rows.extend(match order {
            Some(order) => missing_in(plan, order, person),
            None => missing_of(plan, person),
        });
        // Without a known order the missing ones come last.
        rows.sort_by_key(|row| row.n.unwrap_or(u32::MAX));
        let count = |state| rows.iter().filter(|row| row.state == state).count() as u64;
        list.participants.push(ParticipantSummary {
            code: person.code.clone(),
            started_day: person.started_day.clone(),
            language: person.language.clone(),
            finished: person.finished,
            profile: person.profile.clone(),
            answers: person.answers.len() as u64,
            skipped: count(AnswerState::Skipped),
            not_reached: count(AnswerState::NotReached),
        });
        list.rows.extend(rows);
    }
    list
}

/// Returns whether the answers of a participant lie where this order shows their trials. Tables of other survey programs
/// have no order.
fn is_order_of(plan: &StudyPlan, order: &[ShownTrial], person: &StudyParticipant) -> bool {
    person.answers.iter().all(|answer| {
        let index = (answer.n as usize).checked_sub(1);
        let shown = index.and_then(|at| order.get(at));
        shown.is_some_and(|entry| is_of(&plan.trials[entry.trial], answer))
    })
}

fn is_of(trial: &StudyTrial, answer: &StudyAnswer) -> bool {
    (&trial.part, &trial.item, &trial.condition, trial.role)
        == (&answer.part, &answer.item, &answer.condition, answer.role)
}

fn given_answer_row(person: &StudyParticipant, it: &StudyAnswer, ordered: bool) -> AnswerListRow {
    let value = it.value.map(|number| number.to_string());
    let answer = value.or_else(|| it.choice.clone());
    AnswerListRow {
        participant: person.code.clone(),
        n: ordered.then_some(it.n),
        block: it.block,
        part: it.part.clone(),
        item: it.item.clone(),
        condition: it.condition.clone(),
        role: it.role,
        question: it.question.clone(),
        state: match answer {
            Some(_) => AnswerState::Answered,
            None => AnswerState::CannotSay,
        },
        answer: answer.unwrap_or_default(),
        right: it.right,
        plays: it.plays,
        ms: it.ms,
    }
}

/// Returns the questions of an order without an answer.
fn missing_in(plan: &StudyPlan, order: &[ShownTrial], person: &StudyParticipant) -> Vec<AnswerListRow> {
    let answered: BTreeSet<(u32, &str)> = person
        .answers
        .iter()
        .map(|answer| (answer.n, answer.question.as_str()))
        .collect();
    let last = person.answers.iter().map(|answer| answer.n).max().unwrap_or(0);
    let mut rows = Vec::new();
    for (n, shown) in (1..).zip(order) {
        let trial = &plan.trials[shown.trial];
        // Whoever answered a later trial has seen this one.
        let state = match person.finished || n <= last {
            true => AnswerState::Skipped,
            false => AnswerState::NotReached,
        };
        let question_names = plan.questions_of_trial(trial).map(|question| question.name.as_str());
        let asked = question_names.filter(|name| !answered.contains(&(n, *name)));
        rows.extend(asked.map(|question| AnswerListRow {
            n: Some(n),
            ..absent(person, trial, question, shown.block, state)
        }));
    }
    rows
}

/// Returns the questions of the plan that a participant without a known order never answered. Somebody who sees each item
/// in one condition only misses no other one.
fn missing_of(plan: &StudyPlan, person: &StudyParticipant) -> Vec<AnswerListRow> {
    let state = match person.finished {
        true => AnswerState::Skipped,
        false => AnswerState::NotReached,
    };
    let mut answered: BTreeMap<_, BTreeSet<(&str, &str)>> = BTreeMap::new();
    for it in &person.answers {
        let of_item = answered.entry((&it.item, &it.part, it.role)).or_default();
        of_item.insert((&it.condition, &it.question));
    }
    let none = BTreeSet::new();
    let mut rows = Vec::new();
    for trial in &plan.trials {
        let item_answers = answered.get(&(&trial.item, &trial.part, trial.role));
        let of_item = item_answers.unwrap_or(&none);
        if plan.design.between && of_item.iter().any(|answer| answer.0 != trial.condition) {
            continue;
        }
        for question in plan.questions_of_trial(trial) {
            if !of_item.contains(&(trial.condition.as_str(), question.name.as_str())) {
                let block = u32::from(trial.role != TrialRole::Training);
                rows.push(absent(person, trial, &question.name, block, state));
            }
        }
    }
    rows
}

fn absent(
    person: &StudyParticipant,
    trial: &StudyTrial,
    question: &str,
    block: u32,
    state: AnswerState,
) -> AnswerListRow {
    AnswerListRow {
        participant: person.code.clone(),
        n: None,
        block,
        part: trial.part.clone(),
        item: trial.item.clone(),
        condition: trial.condition.clone(),
        role: trial.role,
        question: question.to_owned(),
        state,
        answer: String::new(),
        right: None,
        plays: 0,
        ms: 0,
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn plan() -> StudyPlan {
        serde_json::from_value(json!({
            "format": "chereme-study", "version": 1, "name": "bowls",
            "trials": [{"item": "BOL", "condition": "captured", "clip": "BOL", "role": "training"},
                       {"item": "BOL", "condition": "captured", "clip": "BOL"},
                       {"item": "BOL", "condition": "made", "clip": "BOL | swap"},
                       {"item": "CHAT", "condition": "made", "clip": "CHAT"}],
            "questions": [{"name": "realism", "cannot_say": true, "kind": {"scale": {"low": 1, "high": 5}}}],
        }))
        .expect("a plan")
    }

    /// Returns a participant who answered the trials at these places of an order.
    fn person(plan: &StudyPlan, row: u32, places: &[u32], finished: bool) -> StudyParticipant {
        let orders = study_order::trial_order_rows(plan);
        let answers: Vec<serde_json::Value> = places
            .iter()
            .map(|&n| {
                let trial = &plan.trials[orders[row as usize][n as usize - 1].trial];
                json!({"n": n, "item": trial.item, "condition": trial.condition, "role": trial.role,
                       "question": "realism", "value": (n != 2).then_some(4)})
            })
            .collect();
        serde_json::from_value(json!({
            "format": "chereme-answers", "version": 1, "study": "bowls", "plan_sha256": "", "participant": "p1",
            "seed": row, "finished": finished, "answers": answers,
        }))
        .expect("a participant")
    }

    fn states(person: StudyParticipant) -> Vec<(Option<u32>, AnswerState)> {
        let study = StudyWithAnswers {
            plan: plan(),
            plan_sha256: String::new(),
            participants: vec![person],
        };
        list_study_answers(&study)
            .rows
            .iter()
            .map(|it| (it.n, it.state))
            .collect()
    }

    #[test]
    fn what_was_passed_over_and_what_was_not_reached_are_rows() {
        use AnswerState::{Answered, CannotSay, NotReached, Skipped};
        let plan = plan();
        assert_eq!(
            states(person(&plan, 3, &[2, 3], false)),
            [
                (Some(1), Skipped),
                (Some(2), CannotSay),
                (Some(3), Answered),
                (Some(4), NotReached)
            ]
        );
        assert_eq!(
            states(person(&plan, 3, &[], true)),
            [
                (Some(1), Skipped),
                (Some(2), Skipped),
                (Some(3), Skipped),
                (Some(4), Skipped)
            ]
        );
        // The answers lie elsewhere than in the order of that number, as those of other survey programs do.
        let mut other = person(&plan, 3, &[2, 3], true);
        other.answers.swap(0, 1);
        other.answers[0].n = 2;
        other.answers[1].n = 3;
        let rows = states(other);
        assert_eq!(rows.len(), 4);
        assert!(rows.iter().all(|it| it.0.is_none()), "{rows:?}");
        assert_eq!(rows.iter().filter(|it| it.1 == Skipped).count(), 2);
    }

    #[test]
    fn a_filter_keeps_what_has_each_word_whatever_its_case() {
        let study = StudyWithAnswers {
            plan: plan(),
            plan_sha256: String::new(),
            participants: vec![person(&plan(), 3, &[2, 3], false)],
        };
        let mut list = list_study_answers(&study);
        let count = |filter: AnswerFilter| list.rows.iter().filter(|it| filter.holds_answer_row(it)).count();
        let of = |text: &str| AnswerFilter {
            text: text.to_owned(),
            ..AnswerFilter::default()
        };
        assert_eq!(count(of("")), 4);
        assert_eq!(count(of("chat  REALISM")), 1);
        assert_eq!(count(of("chat captured")), 0);
        let missing = AnswerFilter {
            missing: true,
            participant: Some("p1".to_owned()),
            ..of("")
        };
        assert_eq!(count(missing), 2);
        let nobody = AnswerFilter {
            participant: Some("p2".to_owned()),
            ..of("")
        };
        assert_eq!(count(nobody.clone()), 0);
        let error = list.keep_filtered_rows(&nobody).expect_err("nobody has that code");
        assert!(error.error_remedy().is_some() && list.rows.len() == 4, "{error}");
        list.keep_filtered_rows(&of("chat")).expect("kept");
        assert_eq!(list.rows.len(), 1);
    }
}
