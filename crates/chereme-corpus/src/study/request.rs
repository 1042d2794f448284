//! A plan from a few words: items times conditions, or a table of trials, and questions.

use std::collections::BTreeMap;

use chereme_sign::text::fold_text;

use super::study_plan::{
    ChoiceOption, ConsentText, ExclusionRule, PLAN_FORMAT, PLAN_VERSION, QuestionKind, QuestionViewing,
    StudyHypothesis, StudyPlan, StudyQuestion, StudyTrial, TrialDesign, text_in,
};
use super::study_texts;
use super::study_trials::{ListedTrial, fail_with_errors, fill_right_answers, new_study_trial, read_trial_table};
use crate::error::{CorpusError, CorpusResult};

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
    pub design: TrialDesign,
    /// The hypotheses.
    pub hypotheses: Vec<StudyHypothesis>,
    /// The rules by which participants are left out.
    pub exclusions: Vec<ExclusionRule>,
    /// The plan that is changed, if it is not a new one. The request takes from it all that it does not state itself, such
    /// as the texts of questions and the questions about participants.
    pub before: Option<StudyPlan>,
    /// Trials of that plan which neither items and conditions nor a table can state.
    pub others: Vec<StudyTrial>,
}

impl StudyRequest {
    /// Returns the plan.
    ///
    /// # Errors
    /// Fails if a table or a question cannot be understood; the plan itself is checked when it is stored.
    pub fn make_study_plan(&self) -> CorpusResult<StudyPlan> {
        let mut trials = self.crossed_request_trials();
        if let Some((text, file)) = &self.trials {
            trials.extend(read_trial_table(text, file)?);
        }
        let stated = trials.len();
        trials.extend(self.others.iter().cloned().map(ListedTrial::from_plain_trial));
        if trials.is_empty() {
            return Err(
                CorpusError::from_wrong_message("a study needs trials").with_command_advice(
                    "name --items and at least one --condition, or a table of trials with --trials FILE",
                ),
            );
        }
        let mut questions = Vec::new();
        for text in &self.questions {
            questions.push(match self.unstated_question(text, &trials) {
                Some(kept) => kept.clone(),
                None => self.keep_unstated_parts(self.parse_question_request(text, &trials)?),
            });
        }
        if questions.is_empty() {
            return Err(CorpusError::from_wrong_message("a study needs a question")
                .with_command_advice("ask one with --ask realism"));
        }
        let answers = trials[..stated].iter_mut();
        let wrong = answers.filter_map(|listed| fill_right_answers(listed, &questions).err());
        fail_with_errors(wrong.collect())?;
        let title = self.title.as_ref().unwrap_or(&self.name);
        let before = self.before.as_ref();
        let kept = before
            .map(|plan| &plan.title)
            .filter(|texts| match text_in(texts, "en") {
                Some(text) => text == title,
                None => self.title.is_none(),
            });
        Ok(StudyPlan {
            format: PLAN_FORMAT.to_owned(),
            version: PLAN_VERSION,
            name: self.name.clone(),
            title: kept.map_or_else(|| study_texts::text_in_both_languages(title, title), Clone::clone),
            consent: before.map_or_else(ConsentText::default, |plan| plan.consent.clone()),
            trials: trials.into_iter().map(|listed| listed.trial).collect(),
            questions,
            profile: before.map_or_else(study_texts::default_profile_questions, |plan| plan.profile.clone()),
            design: self.design,
            analysed: before.and_then(|plan| plan.analysed.clone()),
            hypotheses: self.hypotheses.clone(),
            exclusions: self.exclusions.clone(),
        })
    }

    /// Returns the trials of all items in all conditions.
    fn crossed_request_trials(&self) -> Vec<ListedTrial> {
        let mut trials = Vec::new();
        for item in &self.items {
            for (condition, recipe) in &self.conditions {
                let clip = recipe.replace("{}", &quote_item_name(item));
                trials.push(ListedTrial::from_plain_trial(new_study_trial(item, condition, clip)));
            }
        }
        trials
    }

    /// Reads a question such as `gloss@signs=items LIMACE`.
    pub(super) fn parse_question_request(&self, text: &str, trials: &[ListedTrial]) -> CorpusResult<StudyQuestion> {
        let (head, answers) = match text.split_once('=') {
            Some((head, answers)) => (head, Some(answers)),
            None => (text, None),
        };
        let (name, parts) = match head.split_once('@') {
            Some((name, parts)) => (name.trim(), parts.split(',').collect()),
            None => (head.trim(), Vec::new()),
        };
        let parts: Vec<String> = parts.into_iter().map(|part| part.trim().to_owned()).collect();
        let wrong = |message: String| {
            CorpusError::from_wrong_message(message).with_error_place(text).with_advice(
                "write a name, and for other answers than the usual scale = and the ends of a scale or the options: realism=1-7, gloss=items, place=left right",
            )
        };
        if name.is_empty() {
            return Err(wrong("a question needs a name".to_owned()));
        }
        let scale = |low: i64, high: i64| QuestionKind::Scale {
            low,
            high,
            labels: study_texts::default_scale_labels(name, low, high),
        };
        let kind = match answers.map(str::trim) {
            None => scale(1, self.scale),
            Some(answers) => match parse_scale_ends(answers) {
                Some((low, high)) => scale(low, high),
                None => {
                    let asked = |listed: &&ListedTrial| parts.is_empty() || parts.contains(&listed.trial.part);
                    let items = trials.iter().filter(asked).map(|listed| listed.trial.item.as_str());
                    parse_choice_question(answers, items)
                }
            },
        };
        Ok(StudyQuestion {
            name: name.to_owned(),
            text: study_texts::default_question_text(name),
            kind,
            after: QuestionViewing::First,
            parts,
            cannot_say: false,
        })
    }
}

/// Returns the ends of a scale written as `1-7`.
fn parse_scale_ends(text: &str) -> Option<(i64, i64)> {
    let (low, high) = text.split_once('-')?;
    Some((low.trim().parse().ok()?, high.trim().parse().ok()?))
}

/// Returns a choice of words; the word `items` stands for all items that the question is asked about, which then
/// stand among the others in the order of the alphabet.
fn parse_choice_question<'a>(text: &str, items: impl Iterator<Item = &'a str>) -> QuestionKind {
    let mut names: Vec<String> = Vec::new();
    let mut add = |name: String| {
        if !names.contains(&name) {
            names.push(name);
        }
    };
    let items: Vec<&str> = items.collect();
    let mut mixed = false;
    for word in split_quoted_words(text) {
        match word.as_str() {
            "items" => {
                mixed = true;
                items.iter().for_each(|item| add((*item).to_owned()));
            }
            _ => add(word),
        }
    }
    if mixed {
        names.sort_by_cached_key(|name| fold_text(name));
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
pub fn split_quoted_words(text: &str) -> Vec<String> {
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
pub(super) fn quote_item_name(item: &str) -> String {
    if item.contains(char::is_whitespace) && !item.contains('"') {
        format!("\"{item}\"")
    } else {
        item.to_owned()
    }
}
