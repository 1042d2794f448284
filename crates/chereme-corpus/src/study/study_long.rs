//! Answers as a table in the long form: one answer a row, under the names of the JSON.

use std::collections::BTreeMap;
use std::io::Write;

use super::study_answers::{ANSWERS_FORMAT, ANSWERS_VERSION, ParticipantDevice, StudyAnswer, StudyParticipant};
use super::study_plan::{StudyPlan, TrialRole};
use super::study_rows::{TextTable, read_text_table};
use crate::error::{CorpusError, CorpusResult};

/// The columns that describe the participant, the same in each row of a participant.
const PARTICIPANT_COLUMNS: [&str; 10] = [
    "participant",
    "study",
    "plan_sha256",
    "seed",
    "started_day",
    "language",
    "finished",
    "device.w",
    "device.h",
    "device.dpr",
];

/// The columns of an answer; they are empty in the row of a participant without answers.
const ANSWER_COLUMNS: [&str; 16] = [
    "n",
    "block",
    "part",
    "item",
    "condition",
    "role",
    "question",
    "low",
    "high",
    "value",
    "choice",
    "right",
    "plays",
    "ms",
    "hidden",
    "slow",
];

/// The beginnings of columns with answers about the participant, and with what the participant agreed to.
const LONG_PROFILE_PREFIX: &str = "profile.";
const LONG_CONSENT_PREFIX: &str = "consent.";

/// Writes all answers as CSV.
pub(super) fn write_long_answers(
    plan: &StudyPlan,
    participants: &[StudyParticipant],
    out: impl Write,
) -> CorpusResult<()> {
    let fault = |error: csv::Error| CorpusError::from_wrong_message(format!("the table cannot be written: {error}"));
    let mut agreed: Vec<&str> = participants
        .iter()
        .flat_map(|person| person.consent.keys().map(String::as_str))
        .collect();
    agreed.sort_unstable();
    agreed.dedup();
    let mut out = csv::Writer::from_writer(out);
    let profile = plan
        .profile
        .iter()
        .map(|question| format!("{LONG_PROFILE_PREFIX}{}", question.name));
    let consent = agreed.iter().map(|name| format!("{LONG_CONSENT_PREFIX}{name}"));
    let head_titles = PARTICIPANT_COLUMNS.map(str::to_owned).into_iter();
    let titles: Vec<String> = head_titles
        .chain(ANSWER_COLUMNS.map(str::to_owned))
        .chain(profile)
        .chain(consent)
        .collect();
    out.write_record(&titles).map_err(fault)?;
    for person in participants {
        let head = [
            person.code.clone(),
            person.study.clone(),
            person.plan_sha256.clone(),
            person.seed.to_string(),
            person.started_day.clone(),
            person.language.clone(),
            person.finished.to_string(),
            person.device.w.to_string(),
            person.device.h.to_string(),
            person.device.dpr.to_string(),
        ];
        let profile = plan.profile.iter().map(|question| person.profile.get(&question.name));
        let tail: Vec<String> = profile
            .map(|value| value.cloned().unwrap_or_default())
            .chain(agreed.iter().map(|name| optional_cell_text(person.consent.get(*name))))
            .collect();
        let mut row = |cells: [String; 16]| {
            let cells = head.iter().chain(&cells).chain(&tail);
            out.write_record(cells).map_err(fault)
        };
        for answer in &person.answers {
            row(answer_cells(answer))?;
        }
        if person.answers.is_empty() {
            row([const { String::new() }; 16])?;
        }
    }
    out.flush()
        .map_err(|error| CorpusError::from_wrong_message(format!("the table cannot be written: {error}")))
}

fn answer_cells(it: &StudyAnswer) -> [String; 16] {
    [
        it.n.to_string(),
        it.block.to_string(),
        it.part.clone(),
        it.item.clone(),
        it.condition.clone(),
        it.role.trial_role_name().to_owned(),
        it.question.clone(),
        optional_cell_text(it.scale.map(|scale| scale[0])),
        optional_cell_text(it.scale.map(|scale| scale[1])),
        optional_cell_text(it.value),
        it.choice.clone().unwrap_or_default(),
        optional_cell_text(it.right),
        it.plays.to_string(),
        it.ms.to_string(),
        it.hidden.to_string(),
        it.slow.to_string(),
    ]
}

fn optional_cell_text(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |content| content.to_string())
}

/// A participant of a table with the lines of the answers, and what could not be read: line and reason.
pub(super) struct ListedParticipant {
    pub(super) participant: StudyParticipant,
    pub(super) lines: Vec<u64>,
    pub(super) unread: Vec<(u64, String)>,
}

/// Reads answers from a table, in the order in which participants first occur; the second result names the columns that
/// are not known.
pub(super) fn read_long_answers(text: &str, file: &str) -> CorpusResult<(Vec<ListedParticipant>, Vec<String>)> {
    let TextTable { titles, rows } = read_text_table(text, file)?;
    let column = |name: &str| titles.iter().position(|title| title == name);
    for needed in ["participant", "plan_sha256", "item", "condition", "question"] {
        if column(needed).is_none() {
            let error =
                CorpusError::from_wrong_message(format!("the table has no column {needed:?}")).with_error_place(file);
            return Err(error.with_command_advice("a table of answers has one answer in each row, under the names of the answers' JSON; one with a participant in each row needs --columns"));
        }
    }
    let is_known = |title: &String| {
        PARTICIPANT_COLUMNS.contains(&title.as_str())
            || ANSWER_COLUMNS.contains(&title.as_str())
            || title.starts_with(LONG_PROFILE_PREFIX)
            || title.starts_with(LONG_CONSENT_PREFIX)
    };
    let unknown = titles.iter().filter(|title| !is_known(title)).cloned().collect();
    let mut participants: Vec<ListedParticipant> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for (line, cells) in &rows {
        let row = TitledRow { titles: &titles, cells };
        let code = row.cell_under_title("participant").to_owned();
        let index = *places.entry(code).or_insert_with(|| {
            participants.push(ListedParticipant {
                participant: participant_from_row(&row),
                lines: Vec::new(),
                unread: Vec::new(),
            });
            participants.len() - 1
        });
        if row.cell_under_title("question").is_empty() && row.cell_under_title("item").is_empty() {
            continue;
        }
        match answer_from_row(&row) {
            Ok(answer) => {
                participants[index].participant.answers.push(answer);
                participants[index].lines.push(*line);
            }
            Err(reason) => participants[index].unread.push((*line, reason)),
        }
    }
    Ok((participants, unknown))
}

/// A row under its titles.
struct TitledRow<'a> {
    titles: &'a [String],
    cells: &'a [String],
}

impl<'a> TitledRow<'a> {
    fn cell_under_title(&self, name: &str) -> &'a str {
        let index = self.titles.iter().position(|title| title == name);
        // A row may have fewer cells than there are titles.
        index.and_then(|at| self.cells.get(at)).map_or("", |text| text.trim())
    }

    /// Returns a value that may be missing.
    fn parse_optional_cell<T: std::str::FromStr>(&self, name: &str) -> std::result::Result<Option<T>, String> {
        match self.cell_under_title(name) {
            "" => Ok(None),
            text => match text.parse() {
                Ok(value) => Ok(Some(value)),
                Err(_) => Err(format!("{text:?} in the column {name:?} cannot be read")),
            },
        }
    }

    /// Returns a value, or that of an empty cell.
    fn parse_number_cell<T: std::str::FromStr + Default>(&self, name: &str) -> std::result::Result<T, String> {
        self.parse_optional_cell(name).map(Option::unwrap_or_default)
    }
}

fn participant_from_row(row: &TitledRow<'_>) -> StudyParticipant {
    let named = |beginning: &'static str| {
        let all = row.titles.iter().zip(row.cells);
        all.filter_map(move |(title, cell)| Some((title.strip_prefix(beginning)?, cell.trim())))
            .filter(|(_, cell)| !cell.is_empty())
            .map(|(name, cell)| (name.to_owned(), cell.to_owned()))
    };
    StudyParticipant {
        format: ANSWERS_FORMAT.to_owned(),
        version: ANSWERS_VERSION,
        study: row.cell_under_title("study").to_owned(),
        plan_sha256: row.cell_under_title("plan_sha256").to_owned(),
        code: row.cell_under_title("participant").to_owned(),
        seed: row.parse_number_cell("seed").unwrap_or_default(),
        started_day: row.cell_under_title("started_day").to_owned(),
        language: row.cell_under_title("language").to_owned(),
        device: ParticipantDevice {
            w: row.parse_number_cell("device.w").unwrap_or_default(),
            h: row.parse_number_cell("device.h").unwrap_or_default(),
            dpr: row.parse_number_cell("device.dpr").unwrap_or_default(),
        },
        consent: named(LONG_CONSENT_PREFIX)
            .map(|(name, cell)| (name, parse_table_truth(&cell)))
            .collect(),
        profile: named(LONG_PROFILE_PREFIX).collect(),
        finished: parse_table_truth(row.cell_under_title("finished")),
        skipped: Vec::new(),
        answers: Vec::new(),
    }
}

/// Reads a truth value as programs for tables write it.
fn parse_table_truth(text: &str) -> bool {
    ["true", "1", "vrai", "wahr", "yes"].contains(&text.to_lowercase().as_str())
}

fn answer_from_row(row: &TitledRow<'_>) -> std::result::Result<StudyAnswer, String> {
    let role = match row.cell_under_title("role") {
        "" => TrialRole::Main,
        text => TrialRole::trial_role_named(text).ok_or_else(|| format!("{text:?} is no role of a trial"))?,
    };
    let choice = row.cell_under_title("choice");
    let ends: (Option<i64>, Option<i64>) = (row.parse_optional_cell("low")?, row.parse_optional_cell("high")?);
    Ok(StudyAnswer {
        n: row.parse_number_cell("n")?,
        block: row.parse_number_cell("block")?,
        part: row.cell_under_title("part").to_owned(),
        item: row.cell_under_title("item").to_owned(),
        condition: row.cell_under_title("condition").to_owned(),
        role,
        question: row.cell_under_title("question").to_owned(),
        scale: ends.0.zip(ends.1).map(|(low, high)| [low, high]),
        value: row.parse_optional_cell("value")?,
        choice: (!choice.is_empty()).then(|| choice.to_owned()),
        right: None,
        plays: row.parse_number_cell("plays")?,
        ms: row.parse_number_cell("ms")?,
        hidden: row.parse_number_cell("hidden")?,
        slow: row.parse_number_cell("slow")?,
    })
}
