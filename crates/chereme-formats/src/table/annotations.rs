//! Changes to annotations in bulk, a row each.
//!
//! ```csv
//! recording,tier,start,end,value,action,id
//! NGT Thanks,Gloss RH,0.5,1.2s,THANKS,,
//! NGT Thanks,RH_config,f60,f144,B,add,
//! NGT Thanks,Gloss RH,,,DANK,set,a12
//! NGT Thanks,Gloss RH,0:01.500,,,remove,
//! ```

use super::cells::{Cells, Row as RawRow, TableError};
use crate::finding::Finding;
use crate::roles::normal;
use crate::tally::Findings;
use chereme_motion::Instant;
use chereme_sign::text::{did_you_mean, nearest};
use serde::Serialize;
use std::str::FromStr;

/// What a row asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Action {
    /// A new annotation.
    #[default]
    Add,
    /// An annotation less.
    Remove,
    /// Another value, or another time, for an annotation.
    Set,
}

/// A point in time as a table gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Moment {
    /// A time from the start of the recording.
    Time(Instant),
    /// A frame of the recording, counted from 0.
    Frame(u64),
}

/// A text that is no [`Moment`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} is no time: write 1.5, 1.5s, 1500ms, 0:01.500 or f12{}",
    comma(text)
)]
pub struct MomentError {
    /// The text.
    pub text: String,
}

fn comma(text: &str) -> &'static str {
    if text.contains(',') {
        "; write a point before the decimals"
    } else {
        ""
    }
}

impl FromStr for Moment {
    type Err = MomentError;

    /// Reads seconds (`1.5`, `1.5s`), milliseconds (`1500ms`), minutes (`0:01.500`, `1:02:03.5`) or
    /// a frame (`f12`).
    fn from_str(text: &str) -> Result<Self, MomentError> {
        moment(text).ok_or_else(|| MomentError {
            text: text.to_owned(),
        })
    }
}

/// One change.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Row {
    /// The line of the table, counted from 1.
    pub line: u64,
    /// The recording's name or address; nothing where the table has no such column or cell.
    pub recording: Option<String>,
    /// The tier's name.
    pub tier: Option<String>,
    /// The start.
    pub start: Option<Moment>,
    /// The end.
    pub end: Option<Moment>,
    /// The value; nothing for an empty cell.
    pub value: Option<String>,
    /// What to do.
    pub action: Action,
    /// The id of the annotation to change or remove, or of the new one.
    pub id: Option<String>,
    /// The id of the annotation above, on a symbolic tier.
    pub parent: Option<String>,
}

/// A row that cannot be carried out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("line {line}, {column}: {message}")]
pub struct Fault {
    /// The line of the table, counted from 1.
    pub line: u64,
    /// The column.
    pub column: &'static str,
    /// What is wrong and what would be right.
    pub message: String,
}

/// The rows of a table, those that cannot be carried out apart.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Annotations {
    /// The changes in the order of the table.
    pub rows: Vec<Row>,
    /// What is wrong with the others.
    pub faults: Vec<Fault>,
}

const NAMES: [&str; 8] = [
    "recording",
    "tier",
    "start",
    "end",
    "value",
    "action",
    "id",
    "parent",
];

/// Reads a table of changes; columns may stand in any order.
///
/// A time is in seconds (`1.5`, `1.5s`), milliseconds (`1500ms`), minutes (`0:01.500`, `1:02:03.5`)
/// or frames (`f12`). `action` is `add` (where nothing is said), `remove` or `set`. An added
/// annotation needs a tier and either both times or a parent; a changed or removed one its id, or
/// its tier and start.
///
/// # Errors
/// [`TableError`] where the bytes are no table, or no column names a tier or an id. Faults of
/// single rows are in the result.
pub fn read(bytes: &[u8]) -> Result<(Annotations, Vec<Finding>), TableError> {
    let mut findings = Findings::default();
    let table = Cells::read(bytes, &mut findings)?;
    let columns = columns(&table.header, &mut findings);
    if columns[1].is_none() && columns[6].is_none() {
        return Err(TableError::Missing {
            found: table.header.join(", "),
            needed: "tier or id",
            remedy: "name the columns recording, tier, start, end, value, action, id",
        });
    }
    let mut annotations = Annotations::default();
    for raw in &table.rows {
        match row(raw, &columns) {
            Ok(row) => annotations.rows.push(row),
            Err(fault) => annotations.faults.push(fault),
        }
    }
    Ok((annotations, findings.finish()))
}

fn columns(header: &[String], findings: &mut Findings) -> [Option<usize>; 8] {
    let mut columns = [None; 8];
    for (at, title) in header.iter().enumerate() {
        let name = normal(title);
        let name = match &*name {
            "annotation" | "annotation id" => "id",
            "begin" | "start time" => "start",
            "end time" => "end",
            "gloss" => "value",
            name => name,
        };
        match NAMES.iter().position(|known| *known == name) {
            Some(known) if columns[known].is_none() => columns[known] = Some(at),
            Some(_) => findings.add("columns given twice", || {
                Finding::warning(
                    1,
                    format!("the column {title:?} is there twice; the first counts"),
                )
            }),
            None => findings.add("unknown columns", || {
                let meant = did_you_mean(nearest(name, NAMES));
                Finding::warning(1, format!("the column {title:?} is not used{meant}"))
            }),
        }
    }
    columns
}

fn row(raw: &RawRow, columns: &[Option<usize>; 8]) -> Result<Row, Fault> {
    let cell = |at: usize| {
        let text = columns[at]
            .and_then(|column| raw.cells.get(column))
            .map_or("", |cell| cell.trim());
        (!text.is_empty()).then_some(text)
    };
    let fault = |at: usize, message: String| Fault {
        line: raw.line,
        column: NAMES[at],
        message,
    };
    let time = |at: usize| {
        cell(at)
            .map(|text| {
                text.parse()
                    .map_err(|error: MomentError| fault(at, error.to_string()))
            })
            .transpose()
    };
    let owned = |at: usize| cell(at).map(str::to_owned);
    let value = columns[4]
        .and_then(|column| raw.cells.get(column))
        .filter(|text| !text.is_empty());
    let row = Row {
        line: raw.line,
        recording: owned(0),
        tier: owned(1),
        start: time(2)?,
        end: time(3)?,
        value: value.cloned(),
        action: cell(5).map_or(Ok(Action::Add), |text| {
            action(text).map_err(|message| fault(5, message))
        })?,
        id: owned(6),
        parent: owned(7),
    };
    if let (Some(Moment::Time(start)), Some(Moment::Time(end))) = (row.start, row.end)
        && end <= start
    {
        return Err(fault(
            3,
            format!("the end {end} is not after the start {start}"),
        ));
    }
    if let (Some(Moment::Frame(start)), Some(Moment::Frame(end))) = (row.start, row.end)
        && end <= start
    {
        return Err(fault(
            3,
            format!("the end f{end} is not after the start f{start}"),
        ));
    }
    match row.action {
        Action::Add if row.tier.is_none() => {
            Err(fault(1, "an added annotation needs a tier".into()))
        }
        Action::Add if row.parent.is_none() && row.start.is_none() => Err(fault(
            2,
            "an added annotation needs a start, or a parent on a symbolic tier".into(),
        )),
        Action::Add if row.parent.is_none() && row.end.is_none() => {
            Err(fault(3, "an added annotation needs an end".into()))
        }
        Action::Remove | Action::Set
            if row.id.is_none() && (row.tier.is_none() || row.start.is_none()) =>
        {
            Err(fault(
                6,
                "name the annotation by its id, or by its tier and start".into(),
            ))
        }
        _ => Ok(row),
    }
}

fn action(text: &str) -> Result<Action, String> {
    let names = ["add", "remove", "set"];
    match &*text.to_lowercase() {
        "add" => Ok(Action::Add),
        "remove" | "delete" => Ok(Action::Remove),
        "set" | "change" => Ok(Action::Set),
        _ => Err(format!(
            "{text:?} is no action: add, remove or set{}",
            did_you_mean(nearest(text, names))
        )),
    }
}

fn moment(text: &str) -> Option<Moment> {
    let lower = text.trim().to_lowercase();
    if let Some(frame) = lower.strip_prefix('f') {
        return frame.trim().parse().map(Moment::Frame).ok();
    }
    let micros = if let Some(millis) = lower.strip_suffix("ms") {
        decimal(millis.trim(), 3)
    } else if let Some(seconds) = lower.strip_suffix('s') {
        decimal(seconds.trim(), 6)
    } else {
        clock(&lower)
    };
    Some(Moment::Time(Instant::from_micros(micros?)))
}

/// Reads `S.S`, `M:SS.S` or `H:MM:SS.S` as microseconds.
fn clock(text: &str) -> Option<i64> {
    let (rest, seconds) = text
        .rsplit_once(':')
        .map_or((None, text), |(rest, seconds)| (Some(rest), seconds));
    let micros = decimal(seconds, 6)?;
    let Some(rest) = rest else {
        return Some(micros);
    };
    let (hours, minutes) = rest.split_once(':').unwrap_or(("0", rest));
    let whole = |text: &str| text.parse::<u32>().ok().map(i64::from);
    let minutes = whole(hours)?
        .checked_mul(60)?
        .checked_add(whole(minutes)?)?;
    (0..60_000_000).contains(&micros).then_some(())?;
    minutes.checked_mul(60_000_000)?.checked_add(micros)
}

/// Reads a decimal number times ten to the `shift`, further decimals rounded.
fn decimal(text: &str, shift: usize) -> Option<i64> {
    let (sign, digits) = text
        .strip_prefix('-')
        .map_or((1, text), |digits| (-1, digits));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let plain = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    if (whole.is_empty() && part.is_empty()) || !plain(whole) || !plain(part) || whole.len() > 12 {
        return None;
    }
    let kept: String = part
        .chars()
        .chain(std::iter::repeat('0'))
        .take(shift)
        .collect();
    let up = part.as_bytes().get(shift).is_some_and(|b| *b >= b'5');
    let value: i64 = format!("{whole}{kept}").parse().ok()?;
    Some(sign * (value + i64::from(up)))
}
