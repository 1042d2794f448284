//! Answers as a table in the long form: one answer a row, under the names of the JSON.

use std::collections::BTreeMap;
use std::io::Write;

use chereme_sign::Remedy;

use super::answers::{ANSWERS_FORMAT, ANSWERS_VERSION, Answer, Device, Participant};
use super::plan::{Plan, Role};
use super::rows::{Table, table};
use crate::error::{Error, Result};

/// The columns that describe the participant, the same in each row of a participant.
const HEAD: [&str; 10] = [
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
const ANSWER: [&str; 16] = [
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
const PROFILE: &str = "profile.";
const CONSENT: &str = "consent.";

/// Writes all answers as CSV.
pub(super) fn write(plan: &Plan, participants: &[Participant], out: impl Write) -> Result<()> {
    let fault = |error: csv::Error| Error::wrong(format!("the table cannot be written: {error}"));
    let mut agreed: Vec<&str> = participants
        .iter()
        .flat_map(|it| it.consent.keys().map(String::as_str))
        .collect();
    agreed.sort_unstable();
    agreed.dedup();
    let mut out = csv::Writer::from_writer(out);
    let profile = plan
        .profile
        .iter()
        .map(|it| format!("{PROFILE}{}", it.name));
    let consent = agreed.iter().map(|it| format!("{CONSENT}{it}"));
    let titles = HEAD.map(str::to_owned).into_iter();
    let titles: Vec<String> = titles
        .chain(ANSWER.map(str::to_owned))
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
        let profile = plan.profile.iter().map(|it| person.profile.get(&it.name));
        let tail: Vec<String> = profile
            .map(|it| it.cloned().unwrap_or_default())
            .chain(agreed.iter().map(|it| optional(person.consent.get(*it))))
            .collect();
        let mut row = |cells: [String; 16]| {
            let cells = head.iter().chain(&cells).chain(&tail);
            out.write_record(cells).map_err(fault)
        };
        for answer in &person.answers {
            row(cells(answer))?;
        }
        if person.answers.is_empty() {
            row([const { String::new() }; 16])?;
        }
    }
    out.flush()
        .map_err(|error| Error::wrong(format!("the table cannot be written: {error}")))
}

fn cells(it: &Answer) -> [String; 16] {
    [
        it.n.to_string(),
        it.block.to_string(),
        it.part.clone(),
        it.item.clone(),
        it.condition.clone(),
        it.role.name().to_owned(),
        it.question.clone(),
        optional(it.scale.map(|scale| scale[0])),
        optional(it.scale.map(|scale| scale[1])),
        optional(it.value),
        it.choice.clone().unwrap_or_default(),
        optional(it.right),
        it.plays.to_string(),
        it.ms.to_string(),
        it.hidden.to_string(),
        it.slow.to_string(),
    ]
}

fn optional(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |it| it.to_string())
}

/// A participant of a table with the lines of the answers, and what could not be read: line and reason.
pub(super) struct Listed {
    pub(super) participant: Participant,
    pub(super) lines: Vec<u64>,
    pub(super) unread: Vec<(u64, String)>,
}

/// Reads answers from a table, in the order in which participants first occur; the second result names the columns that
/// are not known.
pub(super) fn read(text: &str, file: &str) -> Result<(Vec<Listed>, Vec<String>)> {
    let Table { titles, rows } = table(text, file)?;
    let column = |name: &str| titles.iter().position(|it| it == name);
    for needed in [
        "participant",
        "plan_sha256",
        "item",
        "condition",
        "question",
    ] {
        if column(needed).is_none() {
            let error = Error::wrong(format!("the table has no column {needed:?}")).at(file);
            return Err(error.advise(Remedy::command(
                "a table of answers has one answer in each row, under the names of the answers' JSON; one with a participant in each row needs --columns",
            )));
        }
    }
    let known = |title: &String| {
        HEAD.contains(&title.as_str())
            || ANSWER.contains(&title.as_str())
            || title.starts_with(PROFILE)
            || title.starts_with(CONSENT)
    };
    let unknown = titles.iter().filter(|it| !known(it)).cloned().collect();
    let mut found: Vec<Listed> = Vec::new();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for (line, cells) in &rows {
        let row = Row {
            titles: &titles,
            cells,
        };
        let code = row.cell("participant").to_owned();
        let at = *places.entry(code).or_insert_with(|| {
            found.push(Listed {
                participant: head(&row),
                lines: Vec::new(),
                unread: Vec::new(),
            });
            found.len() - 1
        });
        if row.cell("question").is_empty() && row.cell("item").is_empty() {
            continue;
        }
        match answer(&row) {
            Ok(answer) => {
                found[at].participant.answers.push(answer);
                found[at].lines.push(*line);
            }
            Err(reason) => found[at].unread.push((*line, reason)),
        }
    }
    Ok((found, unknown))
}

/// A row under its titles.
struct Row<'a> {
    titles: &'a [String],
    cells: &'a [String],
}

impl<'a> Row<'a> {
    fn cell(&self, name: &str) -> &'a str {
        let at = self.titles.iter().position(|it| it == name);
        // A row may have fewer cells than there are titles.
        at.and_then(|at| self.cells.get(at))
            .map_or("", |it| it.trim())
    }

    /// Returns a value that may be missing.
    fn value<T: std::str::FromStr>(&self, name: &str) -> std::result::Result<Option<T>, String> {
        match self.cell(name) {
            "" => Ok(None),
            text => match text.parse() {
                Ok(value) => Ok(Some(value)),
                Err(_) => Err(format!("{text:?} in the column {name:?} cannot be read")),
            },
        }
    }

    /// Returns a value, or that of an empty cell.
    fn number<T: std::str::FromStr + Default>(&self, name: &str) -> std::result::Result<T, String> {
        self.value(name).map(Option::unwrap_or_default)
    }
}

fn head(row: &Row<'_>) -> Participant {
    let named = |beginning: &'static str| {
        let all = row.titles.iter().zip(row.cells);
        all.filter_map(move |(title, cell)| Some((title.strip_prefix(beginning)?, cell.trim())))
            .filter(|(_, cell)| !cell.is_empty())
            .map(|(name, cell)| (name.to_owned(), cell.to_owned()))
    };
    Participant {
        format: ANSWERS_FORMAT.to_owned(),
        version: ANSWERS_VERSION,
        study: row.cell("study").to_owned(),
        plan_sha256: row.cell("plan_sha256").to_owned(),
        code: row.cell("participant").to_owned(),
        seed: row.number("seed").unwrap_or_default(),
        started_day: row.cell("started_day").to_owned(),
        language: row.cell("language").to_owned(),
        device: Device {
            w: row.number("device.w").unwrap_or_default(),
            h: row.number("device.h").unwrap_or_default(),
            dpr: row.number("device.dpr").unwrap_or_default(),
        },
        consent: named(CONSENT)
            .map(|(name, cell)| (name, truth(&cell)))
            .collect(),
        profile: named(PROFILE).collect(),
        finished: truth(row.cell("finished")),
        skipped: Vec::new(),
        answers: Vec::new(),
    }
}

/// Reads a truth value as programs for tables write it.
fn truth(text: &str) -> bool {
    ["true", "1", "vrai", "wahr", "yes"].contains(&text.to_lowercase().as_str())
}

fn answer(row: &Row<'_>) -> std::result::Result<Answer, String> {
    let role = match row.cell("role") {
        "" => Role::Main,
        text => Role::named(text).ok_or_else(|| format!("{text:?} is no role of a trial"))?,
    };
    let choice = row.cell("choice");
    let ends: (Option<i64>, Option<i64>) = (row.value("low")?, row.value("high")?);
    Ok(Answer {
        n: row.number("n")?,
        block: row.number("block")?,
        part: row.cell("part").to_owned(),
        item: row.cell("item").to_owned(),
        condition: row.cell("condition").to_owned(),
        role,
        question: row.cell("question").to_owned(),
        scale: ends.0.zip(ends.1).map(|(low, high)| [low, high]),
        value: row.value("value")?,
        choice: (!choice.is_empty()).then(|| choice.to_owned()),
        right: None,
        plays: row.number("plays")?,
        ms: row.number("ms")?,
        hidden: row.number("hidden")?,
        slow: row.number("slow")?,
    })
}
