//! A stored plan as the request that makes it, so that it can be changed.

use std::collections::{BTreeMap, BTreeSet};

use super::distances::DISTANCE;
use super::plan::{Plan, Question, QuestionKind, Role, Trial, text_in};
use super::request::quoted;
use super::trials::{Listed, trial, written};
use super::{StudyRequest, check, words};
use crate::Corpus;
use crate::error::Result;

/// The name of the table of trials in messages.
const TABLE: &str = "table";
/// The largest distance of two performances that are one.
const SAME: f64 = 1e-6;

impl Corpus {
    /// Checks a plan without storing it; clips are not made.
    ///
    /// # Errors
    /// Fails with all faults of the plan, each with its place.
    pub fn check_plan(plan: &Plan) -> Result<()> {
        check::check(plan)
    }
}

impl StudyRequest {
    /// Returns the request that makes a stored plan again; its second part is the condition from which distances were
    /// measured, if there is one: the request states no distances. Trials are items and conditions if they can be, else a
    /// table.
    #[must_use]
    pub fn of(plan: &Plan) -> (Self, Option<String>) {
        let from = measured_from(plan);
        let mut plain = plan.clone();
        if from.is_some() {
            for trial in &mut plain.trials {
                trial.measures.remove(DISTANCE);
            }
        }
        let title = text_in(&plan.title, "en");
        let base = Self {
            name: plan.name.clone(),
            title: title.filter(|it| *it != plan.name).map(str::to_owned),
            scale: usual_end(plan),
            design: plan.design,
            hypotheses: plan.hypotheses.clone(),
            exclusions: plan.exclusions.clone(),
            before: Some(plan.clone()),
            ..Self::default()
        };
        let table = |trials: &[Trial]| {
            let text = written(trials);
            (!trials.is_empty()).then(|| (text, TABLE.to_owned()))
        };
        let mut attempts = Vec::new();
        if let Some((items, conditions)) = crossed(&plain) {
            let rest = plain.trials.get(items.len() * conditions.len()..);
            let rest: Vec<Trial> = rest.unwrap_or_default().iter().map(short).collect();
            attempts.push(Self {
                items,
                conditions,
                trials: table(&rest),
                ..base.clone()
            });
        }
        let all: Vec<Trial> = plain.trials.iter().map(short).collect();
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
        let listed: Vec<Listed> = plain.trials.iter().cloned().map(Listed::of).collect();
        for mut request in attempts {
            let questions = plan.questions.iter();
            request.questions = questions.map(|it| request.wording(it, &listed)).collect();
            if request.plan().is_ok_and(|it| it == plain) {
                return (request, from);
            }
        }
        let questions = plan.questions.iter();
        let questions = questions.map(|it| others.wording(it, &listed)).collect();
        (
            Self {
                questions,
                ..others
            },
            from,
        )
    }

    /// Returns the words of a question: the shortest that state it.
    fn wording(&self, question: &Question, trials: &[Listed]) -> String {
        let head = head(question);
        let mut candidates = Vec::new();
        match &question.kind {
            QuestionKind::Scale { .. } => candidates.push(head),
            QuestionKind::Choice { options } => {
                candidates.push(format!("{head}=items"));
                let items = |name: &String| trials.iter().any(|it| it.trial.item == *name);
                let rest = options.iter().map(|it| &it.name).filter(|it| !items(it));
                let rest: Vec<String> = rest.map(|it| quoted(it)).collect();
                candidates.push(format!("{head}=items {}", rest.join(" ")));
            }
        }
        let states = |text: &String| self.states(text, question, trials);
        let found = candidates.into_iter().find(states);
        found.unwrap_or_else(|| plain(question))
    }

    /// Returns whether the words of a question state its name, parts, and possible answers.
    fn states(&self, text: &str, question: &Question, trials: &[Listed]) -> bool {
        let read = self.question(text, trials);
        read.is_ok_and(|it| {
            (&it.name, &it.parts) == (&question.name, &question.parts)
                && answers(&it.kind) == answers(&question.kind)
        })
    }

    /// Returns the question of the plan before that these words stand for, although they do not state it.
    pub(super) fn unstated(&self, text: &str, trials: &[Listed]) -> Option<&Question> {
        let mut before = self.before.iter().flat_map(|it| &it.questions);
        before.find(|it| plain(it).trim() == text.trim() && !self.states(text, it, trials))
    }

    /// Takes from the plan before what the words of a question do not state.
    pub(super) fn kept(&self, mut question: Question) -> Question {
        let before = self.before.as_ref();
        let Some(before) = before.and_then(|it| it.question(&question.name)) else {
            return question;
        };
        question.text.clone_from(&before.text);
        question.after = before.after;
        question.cannot_say = before.cannot_say;
        let same = answers(&question.kind) == answers(&before.kind);
        match (&mut question.kind, &before.kind) {
            (QuestionKind::Scale { .. }, QuestionKind::Scale { .. }) if same => {
                question.kind = before.kind.clone();
            }
            (QuestionKind::Choice { options }, QuestionKind::Choice { options: old }) => {
                for option in options {
                    if let Some(known) = old.iter().find(|it| it.name == option.name) {
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
fn head(question: &Question) -> String {
    match question.parts.as_slice() {
        [] => question.name.clone(),
        parts => format!("{}@{}", question.name, parts.join(",")),
    }
}

/// Returns the words of a question with all its answers.
fn plain(question: &Question) -> String {
    let answers = match &question.kind {
        QuestionKind::Scale { low, high, .. } => format!("{low}-{high}"),
        QuestionKind::Choice { options } => {
            let names: Vec<String> = options.iter().map(|it| quoted(&it.name)).collect();
            names.join(" ")
        }
    };
    format!("{}={answers}", head(question))
}

/// Returns the ends of a scale, and the names of options.
fn answers(kind: &QuestionKind) -> (Option<[i64; 2]>, Vec<&str>) {
    match kind {
        QuestionKind::Scale { low, high, .. } => (Some([*low, *high]), Vec::new()),
        QuestionKind::Choice { options } => {
            (None, options.iter().map(|it| it.name.as_str()).collect())
        }
    }
}

/// Returns the highest answer that most scales from 1 have.
fn usual_end(plan: &Plan) -> i64 {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for question in &plan.questions {
        if let QuestionKind::Scale { low: 1, high, .. } = question.kind {
            *counts.entry(high).or_default() += 1;
        }
    }
    let most = counts.into_iter().max_by_key(|it| it.1);
    most.map_or(5, |it| it.0)
}

/// Returns the condition from which the distances of a plan were measured: its own clips have none.
fn measured_from(plan: &Plan) -> Option<String> {
    let distance = |it: &Trial| it.measures.get(DISTANCE).copied();
    let fits = |condition: &&str| {
        let own = || plan.trials.iter().filter(|it| it.condition == *condition);
        let items: BTreeSet<&str> = own().map(|it| it.item.as_str()).collect();
        let has = |it: &Trial| distance(it).is_some() == items.contains(it.item.as_str());
        own().all(|it| distance(it).is_some_and(|it| it.abs() < SAME))
            && plan.trials.iter().all(has)
    };
    let conditions = plan.conditions();
    conditions.into_iter().find(fits).map(str::to_owned)
}

/// Returns a trial without the right answers that a table gives it anyway: its item, if that is an option.
fn short(it: &Trial) -> Trial {
    let mut it = it.clone();
    let item = it.item.clone();
    it.right.retain(|_, right| *right != item);
    it
}

/// The items, and the conditions with their recipes.
type Crossed = (Vec<String>, Vec<(String, String)>);

/// Returns the items and conditions with which a plan begins.
fn crossed(plan: &Plan) -> Option<Crossed> {
    let simple =
        |it: &&Trial| it.role == Role::Main && it.part.is_empty() && it.measures.is_empty();
    let trials: Vec<&Trial> = plan.trials.iter().take_while(simple).collect();
    let first = &trials.first()?.item;
    let count = trials.iter().take_while(|it| it.item == *first).count();
    let rows = || trials.chunks_exact(count);
    let mut conditions = Vec::with_capacity(count);
    let mut most = rows().count();
    for (at, it) in trials[..count].iter().enumerate() {
        let item = quoted(&it.item);
        let recipes = [
            it.clip.replace(&item, "{}"),
            it.clip.replacen(&item, "{}", 1),
        ];
        let reach = |recipe: &String| {
            let fits = |row: &&[&Trial]| {
                let made = trial(
                    &row[0].item,
                    &it.condition,
                    recipe.replace("{}", &quoted(&row[0].item)),
                );
                let own = row[at];
                (&own.item, &own.condition, &own.clip) == (&made.item, &made.condition, &made.clip)
            };
            rows().take_while(fits).count()
        };
        let recipe = recipes.into_iter().max_by_key(|it| reach(it))?;
        let plain = |text: &str| !text.is_empty() && text.trim() == text;
        if !recipe.contains("{}") || !plain(&recipe) || !plain(&it.condition) {
            return None;
        }
        most = most.min(reach(&recipe));
        conditions.push((it.condition.clone(), recipe));
    }
    let items = rows().take(most).map(|row| row[0].item.clone());
    let items: Vec<String> = items
        .take_while(|it| words(&quoted(it)) == [it.as_str()])
        .collect();
    (!items.is_empty()).then_some((items, conditions))
}

#[cfg(test)]
mod tests;
