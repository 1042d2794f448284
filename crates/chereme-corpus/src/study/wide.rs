//! Answers from tables of other survey programs: one participant a row, one answer a column.
//!
//! LimeSurvey and Qualtrics export such tables. A second table, the map, gives the meaning of each column. Its own columns are
//!
//! | column | holds |
//! |---|---|
//! | `column` | the title of a column of the answers |
//! | `item`, `condition` | the trial that the column answers |
//! | `part`, `role` | the same, if the plan needs them: `role` is `main` if empty |
//! | `question` | the question that the column answers |
//! | `means` | instead of a trial: `participant`, `language`, `started_day`, `finished`, `profile.NAME` or `consent.NAME` |
//! | `values` | what the codes of the column stand for, as `A1=left; A2=right` |

use std::collections::BTreeMap;

use chereme_sign::Remedy;
use chereme_sign::text::{did_you_mean, fold, nearest};
use serde::Serialize;

use super::answers::{ANSWERS_FORMAT, ANSWERS_VERSION, Answer, Device, Participant};
use super::files::{Findings, FromFile};
use super::fits::short;
use super::plan::{ChoiceOption, Plan, Question, QuestionKind, Role, Texts};
use super::rows::{Table, table};
use super::trials::together;
use crate::error::{Error, Result};

/// The columns of a map.
const TITLES: [&str; 8] = [
    "column",
    "item",
    "condition",
    "part",
    "role",
    "question",
    "means",
    "values",
];

/// The largest number of wrong rows of a map that are reported.
const MOST_WRONG: usize = 100;

/// The beginnings of meanings with a name.
const PROFILE: &str = "profile.";
const CONSENT: &str = "consent.";

/// The answer of a participant who cannot say, in the languages of the questionnaire.
const CANNOT_SAY: [&str; 2] = ["I cannot say", "Je ne sais pas"];

/// The meaning of each column of a table of answers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColumnMap {
    columns: Vec<MappedColumn>,
}

/// A column of a table of answers.
#[derive(Debug, Clone, PartialEq)]
struct MappedColumn {
    title: String,
    means: Means,
    /// The answer for which each code stands, by the code in folded letters.
    values: BTreeMap<String, String>,
}

/// A column of a table of answers, as an import uses it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ColumnUse {
    /// Its title.
    pub column: String,
    /// Its meaning by the map: a word such as `participant`, or the trial and the question; empty if the map does not name
    /// it, so that it is left out.
    pub means: String,
    /// How many of its cells are filled in.
    pub cells: u64,
    /// The first of these cells.
    pub example: String,
    /// The answer for which the example stands, if it is a code.
    pub stands_for: String,
}

/// The meaning of a column.
#[derive(Debug, Clone, PartialEq)]
enum Means {
    Code,
    Language,
    StartedDay,
    Finished,
    Profile(String),
    Consent(String),
    Answer(Place),
}

/// The trial and the question of an answer.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    /// The place of the trial in the map, from 1.
    n: u32,
    part: String,
    item: String,
    condition: String,
    role: Role,
    question: String,
}

impl ColumnMap {
    /// Reads a map. `file` names it in messages.
    ///
    /// # Errors
    /// Fails if it has no column of participants, or names a trial, a question or a meaning that does not exist.
    pub(super) fn read(text: &str, file: &str, plan: &Plan) -> Result<Self> {
        let Table { titles, rows } = table(text, file)?;
        if let Some(odd) = titles.iter().find(|it| !TITLES.contains(&it.as_str())) {
            let message = format!("a map of columns has no column {:?}", short(odd));
            return Err(Error::wrong(message).at(file).advise(
                "its columns are column, item, condition, part, role, question, means and values",
            ));
        }
        let mut columns: Vec<MappedColumn> = Vec::with_capacity(rows.len());
        let mut trials: Vec<[String; 4]> = Vec::new();
        let mut taken = BTreeMap::new();
        let mut wrong = Vec::new();
        for (line, cells) in rows {
            let place = format!("{file}, line {line}");
            let cell = |name: &str| {
                let at = titles.iter().position(|it| it == name);
                at.and_then(|at| cells.get(at)).map_or("", |it| it.trim())
            };
            match MappedColumn::read(plan, &cell, (&mut trials, &mut taken)) {
                Ok(column) => columns.push(column),
                Err(error) if wrong.len() < MOST_WRONG => wrong.push(error.at(place)),
                Err(_) => break,
            }
        }
        together(wrong)?;
        if !columns.iter().any(|it| it.means == Means::Code) {
            return Err(Error::wrong("the map has no column of participants")
                .at(file)
                .advise("add a row with `participant` under `means`"));
        }
        Ok(Self { columns })
    }

    /// Returns whether the map has a column with that meaning.
    fn has(&self, means: &Means) -> bool {
        self.columns.iter().any(|it| it.means == *means)
    }
}

impl MappedColumn {
    /// Reads a row of a map; `taken` holds the answers of the rows before.
    fn read<'a>(
        plan: &Plan,
        cell: &impl Fn(&str) -> &'a str,
        (trials, taken): (&mut Vec<[String; 4]>, &mut BTreeMap<Place, String>),
    ) -> Result<Self> {
        if cell("column").is_empty() {
            return Err(Error::wrong("the row names no column of the answers"));
        }
        let means = match cell("means") {
            "" => Means::Answer(answered(plan, cell, trials)?),
            word => Means::named(plan, word)?,
        };
        if let Means::Answer(answer) = &means
            && let Some(before) = taken.insert(answer.clone(), cell("column").to_owned())
        {
            let message = format!("{before:?} and this column answer the same question");
            return Err(Error::wrong(message));
        }
        Ok(Self {
            title: cell("column").to_owned(),
            means,
            values: codes(cell("values"))?,
        })
    }
}

impl Means {
    /// Returns the meaning in the words of a map.
    fn text(&self) -> String {
        match self {
            Self::Code => "participant".to_owned(),
            Self::Language => "language".to_owned(),
            Self::StartedDay => "started_day".to_owned(),
            Self::Finished => "finished".to_owned(),
            Self::Profile(name) => format!("{PROFILE}{name}"),
            Self::Consent(name) => format!("{CONSENT}{name}"),
            Self::Answer(it) => {
                let words = [&it.part, &it.item, &it.condition, &it.question];
                let words: Vec<&str> = words
                    .into_iter()
                    .map(String::as_str)
                    .filter(|it| !it.is_empty())
                    .collect();
                words.join(" · ")
            }
        }
    }

    fn named(plan: &Plan, word: &str) -> Result<Self> {
        if let Some(name) = word.strip_prefix(PROFILE) {
            let known = plan.profile.iter().map(|it| it.name.as_str());
            let known: Vec<&str> = known.collect();
            if known.contains(&name) {
                return Ok(Self::Profile(name.to_owned()));
            }
            let near = did_you_mean(nearest(name, known));
            let message = format!(
                "no question about participants is called {:?}{near}",
                short(name)
            );
            return Err(Error::wrong(message));
        }
        if let Some(name) = word.strip_prefix(CONSENT) {
            return Ok(Self::Consent(name.to_owned()));
        }
        match word {
            "participant" => Ok(Self::Code),
            "language" => Ok(Self::Language),
            "started_day" => Ok(Self::StartedDay),
            "finished" => Ok(Self::Finished),
            _ => Err(Error::wrong(format!("{:?} is no meaning of a column", short(word))).advise(
                "the meanings are participant, language, started_day, finished, profile.NAME and consent.NAME",
            )),
        }
    }
}

/// Returns the trial and the question that a row of a map names.
fn answered<'a>(
    plan: &Plan,
    cell: &impl Fn(&str) -> &'a str,
    trials: &mut Vec<[String; 4]>,
) -> Result<Place> {
    let role = match cell("role") {
        "" => Role::Main,
        word => Role::named(word).ok_or_else(|| {
            Error::wrong(format!("{:?} is no role of a trial", short(word)))
                .advise("the roles are training, main and check")
        })?,
    };
    let [part, item, condition, question] = ["part", "item", "condition", "question"].map(cell);
    let Some(trial) = plan.trial(part, item, condition, role) else {
        let message = format!(
            "the plan has no trial with {:?} and {:?} ({})",
            short(item),
            short(condition),
            role.name()
        );
        return Err(Error::wrong(message).advise(Remedy::command(
            "`chereme study show CORPUS NAME` lists the trials",
        )));
    };
    if !plan.asked(trial).any(|it| it.name == question) {
        let known = plan.asked(trial).map(|it| it.name.as_str());
        let near = did_you_mean(nearest(question, known));
        let message = format!("the plan does not ask {:?} there{near}", short(question));
        return Err(Error::wrong(message));
    }
    let own = [part, item, condition, role.name()].map(str::to_owned);
    let at = trials.iter().position(|it| *it == own).unwrap_or_else(|| {
        trials.push(own);
        trials.len() - 1
    });
    Ok(Place {
        n: at as u32 + 1,
        part: part.to_owned(),
        item: item.to_owned(),
        condition: condition.to_owned(),
        role,
        question: question.to_owned(),
    })
}

/// Reads what codes stand for.
fn codes(text: &str) -> Result<BTreeMap<String, String>> {
    let pairs = text.split(';').map(str::trim).filter(|it| !it.is_empty());
    let each = pairs.map(|pair| match pair.split_once('=') {
        Some((code, value)) => Ok((fold(code.trim()), value.trim().to_owned())),
        None => Err(
            Error::wrong(format!("{:?} does not say what it stands for", short(pair)))
                .advise("write codes and their values as `A1=left; A2=right`"),
        ),
    });
    each.collect()
}

/// Reads the participants of a table by a map.
pub(super) fn read(
    text: &str,
    file: &str,
    (map, plan, sha256): (&ColumnMap, &Plan, &str),
    findings: &mut Findings,
) -> Result<(Vec<FromFile>, Vec<ColumnUse>)> {
    let Table { titles, mut rows } = table(text, file)?;
    let mut columns = Vec::with_capacity(map.columns.len());
    for column in &map.columns {
        let at = titles.iter().position(|it| *it == column.title);
        let folded = fold(&column.title);
        let at = at.or_else(|| titles.iter().position(|it| fold(it) == folded));
        let Some(at) = at else {
            let near = nearest(&column.title, titles.iter().map(String::as_str));
            let message = format!(
                "the map names a column that the table does not have: {:?}{}",
                short(&column.title),
                did_you_mean(near)
            );
            return Err(Error::wrong(message).at(file));
        };
        columns.push((at, column));
    }
    // Qualtrics repeats the texts of the questions below the titles, and its own names of the columns below these.
    let own = |(_, cells): &(u64, Vec<String>)| {
        let mut cells = cells.iter();
        cells.any(|it| it.trim_start().starts_with("{\"ImportId\""))
    };
    if let Some(last) = rows.iter().take(2).rposition(own) {
        rows.drain(..=last);
    }
    let uses = uses(&titles, &rows, &columns);
    let mut people = Vec::with_capacity(rows.len());
    for (line, cells) in &rows {
        let cell = |at: usize| cells.get(at).map_or("", |it| it.trim());
        let person = person(plan, &columns, *line, &cell, findings);
        let answers = columns
            .iter()
            .filter(|(_, it)| matches!(it.means, Means::Answer(_)));
        let whole = person.answers.len() == answers.count();
        people.push(FromFile {
            lines: vec![*line; person.answers.len()],
            participant: Participant {
                study: plan.name.clone(),
                plan_sha256: sha256.to_owned(),
                finished: if map.has(&Means::Finished) {
                    person.finished
                } else {
                    whole
                },
                ..person
            },
        });
    }
    Ok((people, uses))
}

/// Returns how each column of a table is used.
fn uses(
    titles: &[String],
    rows: &[(u64, Vec<String>)],
    columns: &[(usize, &MappedColumn)],
) -> Vec<ColumnUse> {
    let one = |(at, title): (usize, &String)| {
        let filled = rows.iter().filter_map(|(_, cells)| cells.get(at));
        let mut filled = filled.map(|it| it.trim()).filter(|it| !it.is_empty());
        let example = filled.next();
        let mapped = columns.iter().find(|it| it.0 == at).map(|it| it.1);
        let code = mapped.zip(example);
        let stands_for = code.and_then(|(it, text)| it.values.get(&fold(text)));
        ColumnUse {
            column: title.clone(),
            means: mapped.map(|it| it.means.text()).unwrap_or_default(),
            cells: example.map_or(0, |_| filled.count() as u64 + 1),
            example: example.map(short).unwrap_or_default(),
            stands_for: stands_for.cloned().unwrap_or_default(),
        }
    };
    titles.iter().enumerate().map(one).collect()
}

/// Returns the participant of a row, whose answers are read as far as they can be.
fn person<'a>(
    plan: &Plan,
    columns: &[(usize, &MappedColumn)],
    line: u64,
    cell: &impl Fn(usize) -> &'a str,
    findings: &mut Findings,
) -> Participant {
    let mut person = Participant {
        format: ANSWERS_FORMAT.to_owned(),
        version: ANSWERS_VERSION,
        study: String::new(),
        plan_sha256: String::new(),
        code: String::new(),
        seed: 0,
        started_day: String::new(),
        language: String::new(),
        device: Device::default(),
        consent: BTreeMap::new(),
        profile: BTreeMap::new(),
        finished: false,
        skipped: Vec::new(),
        answers: Vec::new(),
    };
    for &(at, column) in columns {
        let written = cell(at);
        let text = column
            .values
            .get(&fold(written))
            .map_or(written, String::as_str);
        if text.is_empty() {
            continue;
        }
        match &column.means {
            Means::Code => text.clone_into(&mut person.code),
            Means::Language => {
                person.language = text.chars().take(2).collect::<String>().to_lowercase()
            }
            Means::StartedDay => person.started_day = text.chars().take(10).collect(),
            Means::Finished => person.finished = truth(text),
            Means::Consent(name) => {
                person.consent.insert(name.clone(), truth(text));
            }
            Means::Profile(name) => {
                let asked = plan.profile.iter().find(|it| it.name == *name);
                let option = asked.and_then(|it| option(&it.options, text));
                let option = option.map_or(text, |it| it.name.as_str());
                person.profile.insert(name.clone(), option.to_owned());
            }
            Means::Answer(place) => match given(plan, place, text) {
                Some((value, choice)) => person.answers.push(answer(place, value, choice)),
                None => {
                    let message = format!(
                        "{:?} in the column {:?} is no answer to {:?}; it was left out",
                        short(text),
                        short(&column.title),
                        place.question
                    );
                    let remedy =
                        "say in the map what it stands for, under `values`, as `A1=left; A2=right`";
                    findings.add("warning", Some(line), message, Some(remedy.into()));
                }
            },
        }
    }
    person
}

/// Reads an answer: a number of a scale or its label, or an option by its name or its text; nothing for people who
/// cannot say. `None` if no such answer is known.
fn given(plan: &Plan, place: &Place, text: &str) -> Option<(Option<i64>, Option<String>)> {
    let question = plan.questions.iter().find(|it| it.name == place.question)?;
    let Question {
        kind, cannot_say, ..
    } = question;
    if *cannot_say && CANNOT_SAY.iter().any(|it| fold(it) == fold(text)) {
        return Some((None, None));
    }
    match kind {
        QuestionKind::Choice { options } => Some((None, Some(option(options, text)?.name.clone()))),
        QuestionKind::Scale { low, high, labels } => {
            let labelled = labels.iter().find(|(_, texts)| is_one(texts, text));
            let number = text.parse().ok().filter(|it| (low..=high).contains(&it));
            let value = number.or(labelled.map(|(value, _)| *value))?;
            Some((Some(value), None))
        }
    }
}

/// Returns the option with that name or text.
fn option<'a>(options: &'a [ChoiceOption], text: &str) -> Option<&'a ChoiceOption> {
    let named = options.iter().find(|it| it.name == text);
    let named = named.or_else(|| options.iter().find(|it| fold(&it.name) == fold(text)));
    named.or_else(|| options.iter().find(|it| is_one(&it.text, text)))
}

/// Returns whether a text is one of these, in any language.
fn is_one(texts: &Texts, text: &str) -> bool {
    texts.values().any(|it| fold(it) == fold(text))
}

/// Reads a truth value as survey programs write it. LimeSurvey has the day in its column of finished questionnaires.
fn truth(text: &str) -> bool {
    let no = ["false", "0", "no", "n", "faux", "non", "n/a"];
    !no.contains(&text.to_lowercase().as_str())
}

fn answer(place: &Place, value: Option<i64>, choice: Option<String>) -> Answer {
    Answer {
        n: place.n,
        block: 1,
        part: place.part.clone(),
        item: place.item.clone(),
        condition: place.condition.clone(),
        role: place.role,
        question: place.question.clone(),
        scale: None,
        value,
        choice,
        right: None,
        plays: 0,
        ms: 0,
        hidden: 0,
        slow: 0,
    }
}

#[cfg(test)]
mod tests;
