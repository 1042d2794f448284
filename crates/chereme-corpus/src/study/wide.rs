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

use chereme_sign::text::{did_you_mean, fold_text, nearest_candidate};
use serde::Serialize;

use super::fits::shorten_message_text;
use super::study_answers::{ANSWERS_FORMAT, ANSWERS_VERSION, ParticipantDevice, StudyAnswer, StudyParticipant};
use super::study_files::{FileFindings, FromFile};
use super::study_plan::{ChoiceOption, LocalizedTexts, QuestionKind, StudyPlan, StudyQuestion, TrialRole};
use super::study_rows::{TextTable, read_text_table};
use super::study_trials::fail_with_errors;
use crate::error::{CorpusError, CorpusResult};

/// The columns of a map.
const COLUMN_MAP_TITLES: [&str; 8] = [
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
const MAX_WRONG_MAP_ROWS: usize = 100;

/// The beginnings of meanings with a name.
const PROFILE_MEANING_PREFIX: &str = "profile.";
const CONSENT_MEANING_PREFIX: &str = "consent.";

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
    means: ColumnMeaning,
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
enum ColumnMeaning {
    Code,
    Language,
    StartedDay,
    Finished,
    Profile(String),
    Consent(String),
    Answer(AnswerColumnPlace),
}

/// The trial and the question of an answer.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct AnswerColumnPlace {
    /// The place of the trial in the map, from 1.
    n: u32,
    part: String,
    item: String,
    condition: String,
    role: TrialRole,
    question: String,
}

impl ColumnMap {
    /// Reads a map. `file` names it in messages.
    ///
    /// # Errors
    /// Fails if it has no column of participants, or names a trial, a question or a meaning that does not exist.
    pub(super) fn read_column_map(text: &str, file: &str, plan: &StudyPlan) -> CorpusResult<Self> {
        let TextTable { titles, rows } = read_text_table(text, file)?;
        if let Some(odd) = titles.iter().find(|title| !COLUMN_MAP_TITLES.contains(&title.as_str())) {
            let message = format!("a map of columns has no column {:?}", shorten_message_text(odd));
            return Err(CorpusError::from_wrong_message(message)
                .with_error_place(file)
                .with_advice("its columns are column, item, condition, part, role, question, means and values"));
        }
        let mut columns: Vec<MappedColumn> = Vec::with_capacity(rows.len());
        let mut trials: Vec<[String; 4]> = Vec::new();
        let mut taken = BTreeMap::new();
        let mut wrong = Vec::new();
        for (line, cells) in rows {
            let place = format!("{file}, line {line}");
            let cell = |name: &str| {
                let title_index = titles.iter().position(|title| title == name);
                title_index
                    .and_then(|at| cells.get(at))
                    .map_or("", |cell_text| cell_text.trim())
            };
            match MappedColumn::read_mapped_column(plan, &cell, &mut trials, &mut taken) {
                Ok(column) => columns.push(column),
                Err(error) if wrong.len() < MAX_WRONG_MAP_ROWS => wrong.push(error.with_error_place(place)),
                Err(_) => break,
            }
        }
        fail_with_errors(wrong)?;
        if !columns.iter().any(|column| column.means == ColumnMeaning::Code) {
            return Err(CorpusError::from_wrong_message("the map has no column of participants")
                .with_error_place(file)
                .with_advice("add a row with `participant` under `means`"));
        }
        Ok(Self { columns })
    }

    /// Returns whether the map has a column with that meaning.
    fn has_meaning(&self, means: &ColumnMeaning) -> bool {
        self.columns.iter().any(|column| column.means == *means)
    }
}

impl MappedColumn {
    /// Reads a row of a map; `taken` holds the answers of the rows before.
    fn read_mapped_column<'a>(
        plan: &StudyPlan,
        cell: &impl Fn(&str) -> &'a str,
        trials: &mut Vec<[String; 4]>,
        taken: &mut BTreeMap<AnswerColumnPlace, String>,
    ) -> CorpusResult<Self> {
        if cell("column").is_empty() {
            return Err(CorpusError::from_wrong_message(
                "the row names no column of the answers",
            ));
        }
        let means = match cell("means") {
            "" => ColumnMeaning::Answer(answered_trial_place(plan, cell, trials)?),
            word => ColumnMeaning::meaning_named(plan, word)?,
        };
        if let ColumnMeaning::Answer(answer) = &means
            && let Some(before) = taken.insert(answer.clone(), cell("column").to_owned())
        {
            let message = format!("{before:?} and this column answer the same question");
            return Err(CorpusError::from_wrong_message(message));
        }
        Ok(Self {
            title: cell("column").to_owned(),
            means,
            values: parse_answer_codes(cell("values"))?,
        })
    }
}

impl ColumnMeaning {
    /// Returns the meaning in the words of a map.
    fn meaning_text(&self) -> String {
        match self {
            Self::Code => "participant".to_owned(),
            Self::Language => "language".to_owned(),
            Self::StartedDay => "started_day".to_owned(),
            Self::Finished => "finished".to_owned(),
            Self::Profile(name) => format!("{PROFILE_MEANING_PREFIX}{name}"),
            Self::Consent(name) => format!("{CONSENT_MEANING_PREFIX}{name}"),
            Self::Answer(it) => {
                let all_words = [&it.part, &it.item, &it.condition, &it.question];
                let words: Vec<&str> = all_words
                    .into_iter()
                    .map(String::as_str)
                    .filter(|word| !word.is_empty())
                    .collect();
                words.join(" · ")
            }
        }
    }

    fn meaning_named(plan: &StudyPlan, word: &str) -> CorpusResult<Self> {
        if let Some(name) = word.strip_prefix(PROFILE_MEANING_PREFIX) {
            let name_iterator = plan.profile.iter().map(|question| question.name.as_str());
            let profile_names: Vec<&str> = name_iterator.collect();
            if profile_names.contains(&name) {
                return Ok(Self::Profile(name.to_owned()));
            }
            let near = did_you_mean(nearest_candidate(name, profile_names));
            let message = format!(
                "no question about participants is called {:?}{near}",
                shorten_message_text(name)
            );
            return Err(CorpusError::from_wrong_message(message));
        }
        if let Some(name) = word.strip_prefix(CONSENT_MEANING_PREFIX) {
            return Ok(Self::Consent(name.to_owned()));
        }
        match word {
            "participant" => Ok(Self::Code),
            "language" => Ok(Self::Language),
            "started_day" => Ok(Self::StartedDay),
            "finished" => Ok(Self::Finished),
            _ => Err(CorpusError::from_wrong_message(format!(
                "{:?} is no meaning of a column",
                shorten_message_text(word)
            ))
            .with_advice(
                "the meanings are participant, language, started_day, finished, profile.NAME and consent.NAME",
            )),
        }
    }
}

/// Returns the trial and the question that a row of a map names.
fn answered_trial_place<'a>(
    plan: &StudyPlan,
    cell: &impl Fn(&str) -> &'a str,
    trials: &mut Vec<[String; 4]>,
) -> CorpusResult<AnswerColumnPlace> {
    let role = match cell("role") {
        "" => TrialRole::Main,
        word => TrialRole::trial_role_named(word).ok_or_else(|| {
            CorpusError::from_wrong_message(format!("{:?} is no role of a trial", shorten_message_text(word)))
                .with_advice("the roles are training, main and check")
        })?,
    };
    let [part, item, condition, question] = ["part", "item", "condition", "question"].map(cell);
    let Some(trial) = plan.find_plan_trial(part, item, condition, role) else {
        let message = format!(
            "the plan has no trial with {:?} and {:?} ({})",
            shorten_message_text(item),
            shorten_message_text(condition),
            role.trial_role_name()
        );
        return Err(CorpusError::from_wrong_message(message)
            .with_command_advice("`chereme study show CORPUS NAME` lists the trials"));
    };
    if !plan.questions_of_trial(trial).any(|asked| asked.name == question) {
        let asked_names = plan.questions_of_trial(trial).map(|asked| asked.name.as_str());
        let near = did_you_mean(nearest_candidate(question, asked_names));
        let message = format!("the plan does not ask {:?} there{near}", shorten_message_text(question));
        return Err(CorpusError::from_wrong_message(message));
    }
    let trial_key = [part, item, condition, role.trial_role_name()].map(str::to_owned);
    let trial_index = trials.iter().position(|trial| *trial == trial_key).unwrap_or_else(|| {
        trials.push(trial_key);
        trials.len() - 1
    });
    Ok(AnswerColumnPlace {
        n: trial_index as u32 + 1,
        part: part.to_owned(),
        item: item.to_owned(),
        condition: condition.to_owned(),
        role,
        question: question.to_owned(),
    })
}

/// Reads what codes stand for.
fn parse_answer_codes(text: &str) -> CorpusResult<BTreeMap<String, String>> {
    let pairs = text.split(';').map(str::trim).filter(|part| !part.is_empty());
    let each = pairs.map(|pair| match pair.split_once('=') {
        Some((code, value)) => Ok((fold_text(code.trim()), value.trim().to_owned())),
        None => Err(CorpusError::from_wrong_message(format!(
            "{:?} does not say what it stands for",
            shorten_message_text(pair)
        ))
        .with_advice("write codes and their values as `A1=left; A2=right`")),
    });
    each.collect()
}

/// Reads the participants of a table by a map.
pub(super) fn read_wide_answers(
    text: &str,
    file: &str,
    map: &ColumnMap,
    plan: &StudyPlan,
    sha256: &str,
    findings: &mut FileFindings,
) -> CorpusResult<(Vec<FromFile>, Vec<ColumnUse>)> {
    let TextTable { titles, mut rows } = read_text_table(text, file)?;
    let mut columns = Vec::with_capacity(map.columns.len());
    for column in &map.columns {
        let exact_index = titles.iter().position(|title| *title == column.title);
        let folded = fold_text(&column.title);
        let column_index = exact_index.or_else(|| titles.iter().position(|title| fold_text(title) == folded));
        let Some(at) = column_index else {
            let near = nearest_candidate(&column.title, titles.iter().map(String::as_str));
            let message = format!(
                "the map names a column that the table does not have: {:?}{}",
                shorten_message_text(&column.title),
                did_you_mean(near)
            );
            return Err(CorpusError::from_wrong_message(message).with_error_place(file));
        };
        columns.push((at, column));
    }
    // Qualtrics repeats the texts of the questions below the titles, and its own names of the columns below these.
    let is_import_row = |(_, cells): &(u64, Vec<String>)| {
        let mut cells = cells.iter();
        cells.any(|cell| cell.trim_start().starts_with("{\"ImportId\""))
    };
    if let Some(last) = rows.iter().take(2).rposition(is_import_row) {
        rows.drain(..=last);
    }
    let uses = report_column_uses(&titles, &rows, &columns);
    let mut people = Vec::with_capacity(rows.len());
    for (line, cells) in &rows {
        let cell = |at: usize| cells.get(at).map_or("", |text| text.trim());
        let person = participant_from_wide_row(plan, &columns, *line, &cell, findings);
        let answers = columns
            .iter()
            .filter(|(_, it)| matches!(it.means, ColumnMeaning::Answer(_)));
        let is_complete = person.answers.len() == answers.count();
        people.push(FromFile {
            lines: vec![*line; person.answers.len()],
            participant: StudyParticipant {
                study: plan.name.clone(),
                plan_sha256: sha256.to_owned(),
                finished: if map.has_meaning(&ColumnMeaning::Finished) {
                    person.finished
                } else {
                    is_complete
                },
                ..person
            },
        });
    }
    Ok((people, uses))
}

/// Returns how each column of a table is used.
fn report_column_uses(
    titles: &[String],
    rows: &[(u64, Vec<String>)],
    columns: &[(usize, &MappedColumn)],
) -> Vec<ColumnUse> {
    let one = |(at, title): (usize, &String)| {
        let column_cells = rows.iter().filter_map(|(_, cells)| cells.get(at));
        let mut filled = column_cells.map(|cell| cell.trim()).filter(|cell| !cell.is_empty());
        let example = filled.next();
        let mapped = columns.iter().find(|column| column.0 == at).map(|column| column.1);
        let code = mapped.zip(example);
        let stands_for = code.and_then(|(column, text)| column.values.get(&fold_text(text)));
        ColumnUse {
            column: title.clone(),
            means: mapped.map(|column| column.means.meaning_text()).unwrap_or_default(),
            cells: example.map_or(0, |_| filled.count() as u64 + 1),
            example: example.map(shorten_message_text).unwrap_or_default(),
            stands_for: stands_for.cloned().unwrap_or_default(),
        }
    };
    titles.iter().enumerate().map(one).collect()
}

/// Returns the participant of a row, whose answers are read as far as they can be.
fn participant_from_wide_row<'a>(
    plan: &StudyPlan,
    columns: &[(usize, &MappedColumn)],
    line: u64,
    cell: &impl Fn(usize) -> &'a str,
    findings: &mut FileFindings,
) -> StudyParticipant {
    let mut person = StudyParticipant {
        format: ANSWERS_FORMAT.to_owned(),
        version: ANSWERS_VERSION,
        study: String::new(),
        plan_sha256: String::new(),
        code: String::new(),
        seed: 0,
        started_day: String::new(),
        language: String::new(),
        device: ParticipantDevice::default(),
        consent: BTreeMap::new(),
        profile: BTreeMap::new(),
        finished: false,
        skipped: Vec::new(),
        answers: Vec::new(),
    };
    for &(at, column) in columns {
        let written = cell(at);
        let text = column.values.get(&fold_text(written)).map_or(written, String::as_str);
        if text.is_empty() {
            continue;
        }
        match &column.means {
            ColumnMeaning::Code => text.clone_into(&mut person.code),
            ColumnMeaning::Language => person.language = text.chars().take(2).collect::<String>().to_lowercase(),
            ColumnMeaning::StartedDay => person.started_day = text.chars().take(10).collect(),
            ColumnMeaning::Finished => person.finished = parse_survey_truth(text),
            ColumnMeaning::Consent(name) => {
                person.consent.insert(name.clone(), parse_survey_truth(text));
            }
            ColumnMeaning::Profile(name) => {
                let asked = plan.profile.iter().find(|question| question.name == *name);
                let chosen_option = asked.and_then(|question| find_choice_option(&question.options, text));
                let option = chosen_option.map_or(text, |choice| choice.name.as_str());
                person.profile.insert(name.clone(), option.to_owned());
            }
            ColumnMeaning::Answer(place) => match parse_given_answer(plan, place, text) {
                Some((value, choice)) => person.answers.push(answer_at_place(place, value, choice)),
                None => {
                    let message = format!(
                        "{:?} in the column {:?} is no answer to {:?}; it was left out",
                        shorten_message_text(text),
                        shorten_message_text(&column.title),
                        place.question
                    );
                    let remedy = "say in the map what it stands for, under `values`, as `A1=left; A2=right`";
                    findings.add_file_finding("warning", Some(line), message, Some(remedy.into()));
                }
            },
        }
    }
    person
}

/// Reads an answer: a number of a scale or its label, or an option by its name or its text; nothing for people who
/// cannot say. `None` if no such answer is known.
fn parse_given_answer(
    plan: &StudyPlan,
    place: &AnswerColumnPlace,
    text: &str,
) -> Option<(Option<i64>, Option<String>)> {
    let question = plan.questions.iter().find(|question| question.name == place.question)?;
    let StudyQuestion { kind, cannot_say, .. } = question;
    if *cannot_say && CANNOT_SAY.iter().any(|phrase| fold_text(phrase) == fold_text(text)) {
        return Some((None, None));
    }
    match kind {
        QuestionKind::Choice { options } => Some((None, Some(find_choice_option(options, text)?.name.clone()))),
        QuestionKind::Scale { low, high, labels } => {
            let labelled = labels.iter().find(|(_, texts)| is_one(texts, text));
            let number = text.parse().ok().filter(|value| (low..=high).contains(&value));
            let value = number.or(labelled.map(|(value, _)| *value))?;
            Some((Some(value), None))
        }
    }
}

/// Returns the option with that name or text.
fn find_choice_option<'a>(options: &'a [ChoiceOption], text: &str) -> Option<&'a ChoiceOption> {
    let exact_match = options.iter().find(|choice| choice.name == text);
    let named = exact_match.or_else(|| options.iter().find(|choice| fold_text(&choice.name) == fold_text(text)));
    named.or_else(|| options.iter().find(|choice| is_one(&choice.text, text)))
}

/// Returns whether a text is one of these, in any language.
fn is_one(texts: &LocalizedTexts, text: &str) -> bool {
    texts.values().any(|value| fold_text(value) == fold_text(text))
}

/// Reads a truth value as survey programs write it. LimeSurvey has the day in its column of finished questionnaires.
fn parse_survey_truth(text: &str) -> bool {
    let no = ["false", "0", "no", "n", "faux", "non", "n/a"];
    !no.contains(&text.to_lowercase().as_str())
}

fn answer_at_place(place: &AnswerColumnPlace, value: Option<i64>, choice: Option<String>) -> StudyAnswer {
    StudyAnswer {
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
