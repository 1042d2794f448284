//! Bulk changes to annotations, one per row.
//!
//! ```csv
//! recording,tier,start,end,value,action,id
//! NGT Thanks,Gloss RH,0.5,1.2s,THANKS,,
//! NGT Thanks,RH_config,f60,f144,B,add,
//! NGT Thanks,Gloss RH,,,DANK,set,a12
//! NGT Thanks,Gloss RH,0:01.500,,,remove,
//! ```

mod annotations_columns;
mod annotations_export;
mod moment;

pub use annotations_export::{is_change_table, is_export, read_elan_table, write_elan_table};
pub use moment::{MomentError, TableMoment, TableTimeUnit};

use super::table_cells::{TableCells, TableError, TableRow as RawRow, join_column_names};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use annotations_columns::{ChangeTableColumns, TimeColumn};
use chereme_motion::RecordingInstant;
use chereme_sign::text::{did_you_mean, nearest_candidate};
use serde::Serialize;

/// The change that a row requests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ChangeAction {
    /// Adds an annotation.
    #[default]
    Add,
    /// Removes an annotation.
    Remove,
    /// Changes the value or the time of an annotation.
    Set,
}

/// One change.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ChangeRow {
    /// The line of the table, counted from 1.
    pub line: u64,
    /// The recording's name or address; `None` if the table has no such column or cell.
    pub recording: Option<String>,
    /// The tier's name.
    pub tier: Option<String>,
    /// The start.
    pub start: Option<TableMoment>,
    /// The end.
    pub end: Option<TableMoment>,
    /// The value; `None` for an empty cell.
    pub value: Option<String>,
    /// The change.
    pub action: ChangeAction,
    /// The id of the annotation to change or remove, or of the new one.
    pub id: Option<String>,
    /// The id of the annotation above, on a symbolic tier.
    pub parent: Option<String>,
    /// The person to whom the tier belongs, in ELAN's exports.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub participant: Option<String>,
}

/// A row that cannot be carried out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("line {line}, {column}: {message}")]
pub struct ChangeRowFault {
    /// The line of the table, counted from 1.
    pub line: u64,
    /// The column.
    pub column: &'static str,
    /// The problem, with a correction.
    pub message: String,
}

/// The rows of a table; invalid ones are listed separately.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct AnnotationChangeTable {
    /// The changes in the order of the table.
    pub rows: Vec<ChangeRow>,
    /// The problems of the other rows.
    pub faults: Vec<ChangeRowFault>,
}

/// The columns by name; the titles of times are recognised separately.
const ANNOTATION_COLUMN_NAMES: [&str; 8] = ["recording", "tier", "start", "end", "value", "action", "id", "parent"];

/// Reads a table of changes; columns may stand in any order.
///
/// A time is in seconds (`1.5`, `1.5s`), milliseconds (`1500ms`), minutes (`0:01.500`, `1:02:03.5`) or
/// frames (`f12`); decimal commas are read in clock times, and where commas do not separate cells. Bare numbers are in
/// `unit`, or in the unit in the title of their column (`start_ms`, `start [s]`, ELAN's `Begin Time - msec`), else in
/// seconds. `action` is `add` (the default), `remove` or `set`. An added annotation needs a tier and either both times, a
/// start and a `duration`, or a parent; a changed or removed one its id, or its tier and start.
///
/// Tab-delimited exports of ELAN are such tables, with titles and without, with a row for each annotation
/// or a column for each tier.
///
/// # Errors
/// [`TableError`] if the bytes are not a table, no column names a tier or an id, or bare whole numbers would be
/// implausibly long or late annotations. Faults of single rows are in the result.
pub fn read_change_table(
    bytes: &[u8],
    unit: Option<TableTimeUnit>,
) -> Result<(AnnotationChangeTable, Vec<ImportFinding>), TableError> {
    let mut findings = FindingTally::default();
    let mut table = TableCells::read_table_cells(bytes, &mut findings)?;
    let columns = match ChangeTableColumns::of_export(&table) {
        Some(columns) => {
            let cells = std::mem::take(&mut table.header);
            let line = table.header_line;
            // The row taken for titles is the first annotation.
            table.rows.insert(0, RawRow { line, cells });
            findings.add_limited_note(
                "no titles",
                line,
                || "the table has no titles; it was read as ELAN exports it: tier, begin, end, annotation",
            );
            columns
        }
        None => ChangeTableColumns::of_titles(&table.header, &mut findings),
    };
    if columns.at[1].is_none() && columns.at[6].is_none() && columns.tiers.is_empty() {
        return Err(TableError::Missing {
            found: join_column_names(&table.header),
            needed: "tier or id",
            remedy: "name the columns recording, tier, start, end, value, action, id",
        });
    }
    columns.mend_commas(&mut table);
    let mut annotations = AnnotationChangeTable::default();
    let mut take = |read: Result<ChangeRow, ChangeRowFault>| match read {
        Ok(row) => annotations.rows.push(row),
        Err(fault) => annotations.faults.push(fault),
    };
    for raw in &table.rows {
        // A row is one annotation, or one for each column of a tier.
        if columns.tiers.is_empty() {
            take(read_change_row(raw, &columns, unit, None));
        }
        for (at, tier) in &columns.tiers {
            if raw.cells.get(*at).is_some_and(|cell| !cell.is_empty()) {
                take(read_change_row(raw, &columns, unit, Some((*at, tier))));
            }
        }
    }
    if unit.is_none() {
        columns.check_plausible(&table.rows)?;
    }
    Ok((annotations, findings.finish_finding_tally()))
}

fn read_change_row(
    raw: &RawRow,
    columns: &ChangeTableColumns,
    unit: Option<TableTimeUnit>,
    tier: Option<(usize, &str)>,
) -> Result<ChangeRow, ChangeRowFault> {
    let cell_at = |column: Option<usize>| {
        let text = column.and_then(|column| raw.cells.get(column));
        text.map(|cell| cell.trim()).filter(|text| !text.is_empty())
    };
    let cell = |at: usize| cell_at(columns.at[at]);
    let fault = |at: usize, message: String| ChangeRowFault {
        line: raw.line,
        column: ANNOTATION_COLUMN_NAMES[at],
        message,
    };
    let moment = |at: usize, time: Option<TimeColumn>| {
        let Some(time) = time else { return Ok(None) };
        let unit = time.unit.or(unit).unwrap_or(TableTimeUnit::Seconds);
        let read = |text| TableMoment::parse_table_moment(text, unit).map_err(|error| fault(at, error.to_string()));
        cell_at(Some(time.column)).map(read).transpose()
    };
    let owned = |at: usize| cell(at).map(str::to_owned);
    let value_column = tier.map(|(at, _)| at).or(columns.at[4]);
    let value = value_column
        .and_then(|column| raw.cells.get(column))
        .filter(|text| !text.is_empty());
    let start = moment(2, columns.start)?;
    // A stated end counts more than a duration, which may be rounded.
    let mut end = moment(3, columns.end)?;
    if end.is_none() {
        end = match (start, moment(3, columns.duration)?) {
            (Some(TableMoment::Time(start)), Some(TableMoment::Time(length))) => {
                let end_micros = start.instant_micros().checked_add(length.instant_micros());
                let end =
                    end_micros.ok_or_else(|| fault(3, format!("the duration {length} from {start} is too long")))?;
                Some(TableMoment::Time(RecordingInstant::from_micros(end)))
            }
            (Some(TableMoment::Frame(start)), Some(TableMoment::Frame(length))) => {
                let end = start
                    .checked_add(length)
                    .ok_or_else(|| fault(3, format!("the duration f{length} from f{start} is too long")))?;
                Some(TableMoment::Frame(end))
            }
            _ => None,
        };
    }
    let row = ChangeRow {
        line: raw.line,
        recording: owned(0),
        tier: tier.map(|(_, name)| name.to_owned()).or_else(|| owned(1)),
        start,
        end,
        value: value.cloned(),
        action: cell(5).map_or(Ok(ChangeAction::Add), |text| {
            parse_change_action(text).map_err(|message| fault(5, message))
        })?,
        id: owned(6),
        parent: owned(7),
        participant: cell_at(columns.participant).map(str::to_owned),
    };
    if let (Some(TableMoment::Time(start)), Some(TableMoment::Time(end))) = (row.start, row.end)
        && end <= start
    {
        return Err(fault(3, format!("the end {end} is not after the start {start}")));
    }
    if let (Some(TableMoment::Frame(start)), Some(TableMoment::Frame(end))) = (row.start, row.end)
        && end <= start
    {
        return Err(fault(3, format!("the end f{end} is not after the start f{start}")));
    }
    match row.action {
        ChangeAction::Add if row.tier.is_none() => Err(fault(1, "an added annotation needs a tier".into())),
        ChangeAction::Add if row.parent.is_none() && row.start.is_none() => Err(fault(
            2,
            "an added annotation needs a start, or a parent on a symbolic tier".into(),
        )),
        ChangeAction::Add if row.parent.is_none() && row.end.is_none() => {
            Err(fault(3, "an added annotation needs an end".into()))
        }
        ChangeAction::Remove | ChangeAction::Set if row.id.is_none() && (row.tier.is_none() || row.start.is_none()) => {
            Err(fault(
                6,
                "name the annotation by its id, or by its tier and start".into(),
            ))
        }
        _ => Ok(row),
    }
}

fn parse_change_action(text: &str) -> Result<ChangeAction, String> {
    let names = ["add", "remove", "set"];
    match &*text.to_lowercase() {
        "add" => Ok(ChangeAction::Add),
        "remove" | "delete" => Ok(ChangeAction::Remove),
        "set" | "change" => Ok(ChangeAction::Set),
        _ => Err(format!(
            "{text:?} is no action: add, remove or set{}",
            did_you_mean(nearest_candidate(text, names))
        )),
    }
}
