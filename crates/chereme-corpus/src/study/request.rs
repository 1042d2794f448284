//! A plan from a few words: items times conditions, or a table of trials, and questions.

use std::collections::BTreeMap;

use chereme_sign::Remedy;
use chereme_sign::text::fold;

use super::plan::{
    ChoiceOption, Consent, Design, PLAN_FORMAT, PLAN_VERSION, Plan, Question, QuestionKind, Role,
    Trial, Viewing,
};
use super::rows::{Table, table};
use super::texts;
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
        if trials.is_empty() {
            return Err(Error::wrong("a study needs trials").advise(Remedy::command(
                "name --items and at least one --condition, or a table of trials with --trials FILE",
            )));
        }
        let mut questions = Vec::new();
        for text in &self.questions {
            questions.push(self.question(text, &trials)?);
        }
        if questions.is_empty() {
            return Err(Error::wrong("a study needs a question")
                .advise(Remedy::command("ask one with --ask realism")));
        }
        for trial in &mut trials {
            answer(trial, &questions)?;
        }
        let title = self.title.as_ref().unwrap_or(&self.name);
        Ok(Plan {
            format: PLAN_FORMAT.to_owned(),
            version: PLAN_VERSION,
            name: self.name.clone(),
            title: texts::both(title, title),
            consent: Consent::default(),
            trials: trials.into_iter().map(|it| it.trial).collect(),
            questions,
            profile: texts::profile(),
            design: self.design,
            analysed: None,
            hypotheses: Vec::new(),
            exclusions: Vec::new(),
        })
    }

    /// Returns the trials of all items in all conditions.
    fn crossed(&self) -> Vec<Listed> {
        let mut trials = Vec::new();
        for item in &self.items {
            for (condition, recipe) in &self.conditions {
                trials.push(Listed::of(Trial {
                    item: item.clone(),
                    condition: condition.clone(),
                    clip: recipe.replace("{}", &quoted(item)),
                    role: Role::Main,
                    part: String::new(),
                    right: BTreeMap::new(),
                    measures: BTreeMap::new(),
                }));
            }
        }
        trials
    }

    /// Reads a question such as `gloss@signs=items LIMACE`.
    fn question(&self, text: &str, trials: &[Listed]) -> Result<Question> {
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
fn quoted(item: &str) -> String {
    if item.contains(char::is_whitespace) && !item.contains('"') {
        format!("\"{item}\"")
    } else {
        item.to_owned()
    }
}

/// A trial with what its row of the table says about right answers.
struct Listed {
    trial: Trial,
    /// The right answer to whichever question has it as an option.
    answer: Option<String>,
    /// Where it stands.
    place: String,
}

impl Listed {
    fn of(trial: Trial) -> Self {
        Self {
            trial,
            answer: None,
            place: String::new(),
        }
    }
}

/// Fills in the right answers of a trial: those of its row, or else its item if that is an option.
fn answer(listed: &mut Listed, questions: &[Question]) -> Result<()> {
    let part = &listed.trial.part;
    let mut used = false;
    for question in questions {
        let QuestionKind::Choice { options } = &question.kind else {
            continue;
        };
        if !question.parts.is_empty() && !question.parts.contains(part) {
            continue;
        }
        let right = listed.answer.as_ref().unwrap_or(&listed.trial.item);
        if options.iter().any(|it| it.name == *right) {
            used = true;
            let right = right.clone();
            listed
                .trial
                .right
                .entry(question.name.clone())
                .or_insert(right);
        }
    }
    match &listed.answer {
        Some(answer) if !used => Err(Error::wrong(format!(
            "no question has the option {answer:?}, which is to be right"
        ))
        .at(listed.place.clone())
        .advise("name the option in the question, or leave the cell empty")),
        _ => Ok(()),
    }
}

/// Reads a table of trials: `item`, `condition`, `clip`, and if wished `role`, `part`, `answer`; `answer QUESTION` for
/// one of several questions; every other column is a measure.
fn listed(text: &str, file: &str) -> Result<Vec<Listed>> {
    let Table { titles, rows } = table(text, file)?;
    for needed in ["item", "condition", "clip"] {
        if !titles.iter().any(|it| it == needed) {
            let error = Error::wrong(format!("the table has no column {needed:?}")).at(file);
            return Err(error.advise(
                "the columns are item, condition, clip, and if wished role, part, answer, and measures in numbers",
            ));
        }
    }
    let mut trials = Vec::with_capacity(rows.len());
    for (line, cells) in rows {
        let place = format!("{file}, line {line}");
        let mut it = Listed {
            trial: Trial {
                item: String::new(),
                condition: String::new(),
                clip: String::new(),
                role: Role::Main,
                part: String::new(),
                right: BTreeMap::new(),
                measures: BTreeMap::new(),
            },
            answer: None,
            place: place.clone(),
        };
        for (title, cell) in titles.iter().zip(cells) {
            let cell = cell.trim();
            if cell.is_empty() {
                continue;
            }
            match title.as_str() {
                "item" => cell.clone_into(&mut it.trial.item),
                "condition" => cell.clone_into(&mut it.trial.condition),
                "clip" => cell.clone_into(&mut it.trial.clip),
                "part" => cell.clone_into(&mut it.trial.part),
                "role" => {
                    it.trial.role = Role::named(cell).ok_or_else(|| {
                        Error::wrong(format!("{cell:?} is no role of a trial"))
                            .at(&place)
                            .advise("the roles are training, main and check")
                    })?;
                }
                "answer" => it.answer = Some(cell.to_owned()),
                other => match other.strip_prefix("answer ") {
                    Some(question) => {
                        it.trial
                            .right
                            .insert(question.trim().to_owned(), cell.to_owned());
                    }
                    None => {
                        let number: Option<f64> =
                            cell.parse().ok().filter(|it: &f64| it.is_finite());
                        let number = number.ok_or_else(|| {
                            Error::wrong(format!("{cell:?} in the column {other:?} is no number"))
                                .at(&place)
                                .advise("columns beside item, condition, clip, role, part and answer are measures of the clip")
                        })?;
                        it.trial.measures.insert(other.to_owned(), number);
                    }
                },
            }
        }
        trials.push(it);
    }
    Ok(trials)
}
