//! A plan from a few words: items times conditions, or a table of trials, and questions.

use std::collections::BTreeMap;

use chereme_sign::Remedy;
use chereme_sign::text::fold;

use super::plan::{
    ChoiceOption, Consent, Design, Exclusion, Hypothesis, PLAN_FORMAT, PLAN_VERSION, Plan,
    Question, QuestionKind, Trial, Viewing, text_in,
};
use super::texts;
use super::trials::{Listed, answer, listed, together, trial};
use crate::error::{Error, Result};

/// A study in a few words.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StudyRequest {
    /// The name of the study.
    pub name: String,
    /// Its title; without one, its name.
    pub title: Option<String>,
    /// The items, one trial for each and each condition.
    pub items: Vec<String>,
    /// The conditions: a name, and a recipe with `{}` for the item.
    pub conditions: Vec<(String, String)>,
    /// A table of trials as text, and the name of its file.
    pub trials: Option<(String, String)>,
    /// The questions: `realism`, `realism=1-7`, `gloss=items`, `place=left right chest`, `place@bowls=left right` for a
    /// part of the study.
    pub questions: Vec<String>,
    /// The highest answer of scales without ends of their own.
    pub scale: i64,
    /// The order of trials.
    pub design: Design,
    /// The hypotheses.
    pub hypotheses: Vec<Hypothesis>,
    /// The rules by which participants are left out.
    pub exclusions: Vec<Exclusion>,
    /// The plan that is changed, if it is not a new one. The request takes from it all that it does not state itself, such
    /// as the texts of questions and the questions about participants.
    pub before: Option<Plan>,
    /// Trials of that plan which neither items and conditions nor a table can state.
    pub others: Vec<Trial>,
}

impl StudyRequest {
    /// Returns the plan.
    ///
    /// # Errors
    /// Fails if a table or a question cannot be understood; the plan itself is checked when it is stored.
    pub fn plan(&self) -> Result<Plan> {
        let mut trials = self.crossed();
        if let Some((text, file)) = &self.trials {
            trials.extend(listed(text, file)?);
        }
        let stated = trials.len();
        trials.extend(self.others.iter().cloned().map(Listed::of));
        if trials.is_empty() {
            return Err(Error::wrong("a study needs trials").advise(Remedy::command(
                "name --items and at least one --condition, or a table of trials with --trials FILE",
            )));
        }
        let mut questions = Vec::new();
        for text in &self.questions {
            questions.push(match self.unstated(text, &trials) {
                Some(kept) => kept.clone(),
                None => self.kept(self.question(text, &trials)?),
            });
        }
        if questions.is_empty() {
            return Err(Error::wrong("a study needs a question")
                .advise(Remedy::command("ask one with --ask realism")));
        }
        let answers = trials[..stated].iter_mut();
        let wrong = answers.filter_map(|it| answer(it, &questions).err());
        together(wrong.collect())?;
        let title = self.title.as_ref().unwrap_or(&self.name);
        let before = self.before.as_ref();
        let kept = before
            .map(|it| &it.title)
            .filter(|it| match text_in(it, "en") {
                Some(text) => text == title,
                None => self.title.is_none(),
            });
        Ok(Plan {
            format: PLAN_FORMAT.to_owned(),
            version: PLAN_VERSION,
            name: self.name.clone(),
            title: kept.map_or_else(|| texts::both(title, title), Clone::clone),
            consent: before.map_or_else(Consent::default, |it| it.consent.clone()),
            trials: trials.into_iter().map(|it| it.trial).collect(),
            questions,
            profile: before.map_or_else(texts::profile, |it| it.profile.clone()),
            design: self.design,
            analysed: before.and_then(|it| it.analysed.clone()),
            hypotheses: self.hypotheses.clone(),
            exclusions: self.exclusions.clone(),
        })
    }

    /// Returns the trials of all items in all conditions.
    fn crossed(&self) -> Vec<Listed> {
        let mut trials = Vec::new();
        for item in &self.items {
            for (condition, recipe) in &self.conditions {
                let clip = recipe.replace("{}", &quoted(item));
                trials.push(Listed::of(trial(item, condition, clip)));
            }
        }
        trials
    }

    /// Reads a question such as `gloss@signs=items LIMACE`.
    pub(super) fn question(&self, text: &str, trials: &[Listed]) -> Result<Question> {
        let (head, answers) = match text.split_once('=') {
            Some((head, answers)) => (head, Some(answers)),
            None => (text, None),
        };
        let (name, parts) = match head.split_once('@') {
            Some((name, parts)) => (name.trim(), parts.split(',').collect()),
            None => (head.trim(), Vec::new()),
        };
        let parts: Vec<String> = parts.into_iter().map(|it| it.trim().to_owned()).collect();
        let wrong = |message: String| {
            Error::wrong(message).at(text).advise(
                "write a name, and for other answers than the usual scale = and the ends of a scale or the options: realism=1-7, gloss=items, place=left right",
            )
        };
        if name.is_empty() {
            return Err(wrong("a question needs a name".to_owned()));
        }
        let scale = |low: i64, high: i64| QuestionKind::Scale {
            low,
            high,
            labels: texts::labels(name, low, high),
        };
        let kind = match answers.map(str::trim) {
            None => scale(1, self.scale),
            Some(answers) => match ends(answers) {
                Some((low, high)) => scale(low, high),
                None => {
                    let asked = |it: &&Listed| parts.is_empty() || parts.contains(&it.trial.part);
                    let items = trials.iter().filter(asked).map(|it| it.trial.item.as_str());
                    choice(answers, items)
                }
            },
        };
        Ok(Question {
            name: name.to_owned(),
            text: texts::question(name),
            kind,
            after: Viewing::First,
            parts,
            cannot_say: false,
        })
    }
}

/// Returns the ends of a scale written as `1-7`.
fn ends(text: &str) -> Option<(i64, i64)> {
    let (low, high) = text.split_once('-')?;
    Some((low.trim().parse().ok()?, high.trim().parse().ok()?))
}

/// Returns a choice of words; the word `items` stands for all items that the question is asked about, which then
/// stand among the others in the order of the alphabet.
fn choice<'a>(text: &str, items: impl Iterator<Item = &'a str>) -> QuestionKind {
    let mut names: Vec<String> = Vec::new();
    let mut add = |name: String| {
        if !names.contains(&name) {
            names.push(name);
        }
    };
    let items: Vec<&str> = items.collect();
    let mut mixed = false;
    for word in words(text) {
        match word.as_str() {
            "items" => {
                mixed = true;
                items.iter().for_each(|item| add((*item).to_owned()));
            }
            _ => add(word),
        }
    }
    if mixed {
        names.sort_by_cached_key(|name| fold(name));
    }
    let options = names.into_iter().map(|name| ChoiceOption {
        name,
        text: BTreeMap::new(),
        picture: None,
    });
    QuestionKind::Choice {
        options: options.collect(),
    }
}

/// Splits a text at blanks; words in double quotes may hold some.
#[must_use]
pub fn words(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (at, piece) in text.split('"').enumerate() {
        match at % 2 {
            0 => words.extend(piece.split_whitespace().map(str::to_owned)),
            _ => words.push(piece.to_owned()),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Returns an item as a recipe names it: in quotes if it holds blanks.
pub(super) fn quoted(item: &str) -> String {
    if item.contains(char::is_whitespace) && !item.contains('"') {
        format!("\"{item}\"")
    } else {
        item.to_owned()
    }
}
