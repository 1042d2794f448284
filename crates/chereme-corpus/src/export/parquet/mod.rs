//! Long tables as Parquet for pandas, polars and DuckDB: tokens, their components, annotations, and frames of
//! movement.

mod file;
#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::ops::Range;

use ::parquet::data_type::ByteArray;
use chereme_sign::Component;
use chereme_sign::tier::Hands;
use rusqlite::Connection;

use super::csv;
use super::long::Long;
use crate::address::Stretch;
use crate::db::attributes;
use crate::db::columns::{ValueState, phase_name, phase_place};
use crate::db::recordings;
use crate::db::signs;
use crate::db::tiers::{self, AnnotationRow, TierRow};
use crate::error::{Error, Result};
use crate::hands::usable_take;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::progress::{Progress, Step, Unit};
use file::{Cells, Column, File, Table};

/// The largest number of movement rows in a group.
const GROUP: usize = 1 << 18;

/// Returns a description of a table's columns for the file's metadata.
fn about(long: Long) -> String {
    let (table, columns) = match long {
        Long::Tokens => (
            "tokens",
            "a token a row; columns of components are named as queries spell them, with _ for dots; several values \
             stand in one cell as in lexicons (chin > chest, S + W), n/a is not applicable, ? unclear; start_s and end_s \
             are seconds of the recording",
        ),
        Long::Components => (
            "components",
            "a value of a token a row; state is value, not-applicable or unclear",
        ),
        Long::Annotations => (
            "annotations",
            "an annotation a row; start_s and end_s are seconds of the recording; state is value, unset, \
             not-applicable or unclear",
        ),
        Long::Frames => (
            "frames",
            "a joint of a frame a row; t_s is seconds of the recording; tx ty tz (metres) and qx qy qz qw (unit quaternion) \
             are relative to the parent joint, wx wy wz is the place in the room in metres, Y up, the signer facing +Z; usable is \
             false in bind poses, T-poses and beyond jumps of the body, which measures and pictures leave out",
        ),
    };
    let program = format!("Chereme {}", env!("CARGO_PKG_VERSION"));
    serde_json::json!({ "program": program, "table": table, "columns": columns }).to_string()
}

/// Writes the same table of tokens as the CSV export, with typed numbers.
///
/// # Errors
/// Fails if rows are damaged, or `out` fails.
pub(super) fn tokens(
    connection: &Connection,
    tokens: &[i64],
    out: &mut dyn Write,
    notes: &mut Vec<String>,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let mut text = Vec::new();
    let form = csv::TableForm::new(b',');
    csv::tokens(connection, tokens, form, &mut text, notes, progress)?;
    let fault = |error: ::csv::Error| Error::wrong(error.to_string());
    let mut reader = ::csv::Reader::from_reader(text.as_slice());
    let titles: Vec<String> = reader
        .headers()
        .map_err(fault)?
        .iter()
        .map(str::to_owned)
        .collect();
    let mut columns: Vec<Vec<Option<String>>> = vec![Vec::new(); titles.len()];
    for record in reader.records() {
        let record = record.map_err(fault)?;
        for (column, cell) in columns.iter_mut().zip(&record) {
            column.push(Some(cell.to_owned()).filter(|cell| !cell.is_empty()));
        }
    }
    let numbers = numeric(connection, tokens)?;
    let mut taken = BTreeSet::new();
    let table: Table = titles
        .iter()
        .zip(columns)
        .map(|(title, cells)| {
            let cells = match title.as_str() {
                "start_s" | "end_s" => Cells::Double(parsed(&cells)),
                "token" => Cells::Integer(parsed(&cells)),
                "citation" => {
                    let flags = cells.iter().map(|it| it.as_deref().map(|it| it == "yes"));
                    Cells::Flag(flags.collect())
                }
                name if numbers.contains(name) => Cells::Double(parsed(&cells)),
                _ => Cells::Text(cells.iter().map(|it| Some(it.as_deref()?.into())).collect()),
            };
            Column::new(&plain(title, &mut taken), cells)
        })
        .collect();
    let mut file = File::new(&table, &about(Long::Tokens), out)?;
    file.group(&table)?;
    file.finish()
}

/// Returns the names of attributes that are numbers for every token that has them.
fn numeric(connection: &Connection, tokens: &[i64]) -> Result<BTreeSet<String>> {
    let mut all: BTreeMap<String, bool> = BTreeMap::new();
    for ids in tokens.chunks(signs::AT_ONCE) {
        let rows = attributes::of_tokens(connection, ids)?;
        for row in rows.into_values().flatten() {
            // A number that Rust would read differently stays text.
            let plain = row.number.is_some() && row.text.trim().parse::<f64>().ok() == row.number;
            *all.entry(row.name).or_insert(true) &= plain || row.text.is_empty();
        }
    }
    Ok(all.into_iter().filter(|it| it.1).map(|it| it.0).collect())
}

fn parsed<T: std::str::FromStr>(cells: &[Option<String>]) -> Vec<Option<T>> {
    let cells = cells.iter();
    cells
        .map(|cell| cell.as_deref()?.trim().parse().ok())
        .collect()
}

/// Returns a title in lower-case letters, digits and underscores that is not in `taken`.
fn plain(title: &str, taken: &mut BTreeSet<String>) -> String {
    let mut name = String::new();
    for letter in title.to_lowercase().chars() {
        let letter = if letter.is_alphanumeric() {
            letter
        } else {
            '_'
        };
        if letter != '_' || !name.ends_with('_') {
            name.push(letter);
        }
    }
    let name = match name.trim_matches('_') {
        "" => "column",
        name => name,
    };
    let mut own = name.to_owned();
    let mut number = 2;
    while !taken.insert(own.clone()) {
        own = format!("{name}_{number}");
        number += 1;
    }
    own
}

/// Writes a row for each value of each token.
///
/// # Errors
/// Fails if rows are damaged, or `out` fails.
pub(super) fn components(
    connection: &Connection,
    tokens: &[i64],
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let texts = [
        "gloss",
        "recording",
        "component",
        "feature",
        "hand",
        "phase",
        "state",
        "value",
    ];
    let empty: Table = ["token", "position", "annotation"]
        .map(|name| Column::new(name, Cells::Integer(Vec::new())))
        .into_iter()
        .chain(texts.map(|name| Column::new(name, Cells::Text(Vec::new()))))
        .collect();
    let mut file = File::new(&empty, &about(Long::Components), out)?;
    for (part, ids) in tokens.chunks(signs::AT_ONCE).enumerate() {
        let mut table = empty.clone();
        let rows = signs::tokens(connection, ids)?;
        let values = signs::values_of(connection, ids)?;
        for id in ids {
            let Some(token) = rows.get(id) else { continue };
            for value in values.get(id).map_or(&[][..], Vec::as_slice) {
                let place = phase_place(value.phase);
                let numbers = [Some(*id), Some(place), value.annotation_id];
                let texts = [
                    Some(token.gloss.as_str()),
                    token.recording.as_deref(),
                    Some(value.component.name()),
                    value.feature.as_deref(),
                    value.hand.map(Hands::name),
                    value.phase.map(phase_name),
                    Some(value.state.name()),
                    value.value.as_deref(),
                ];
                let (left, right) = table.split_at_mut(numbers.len());
                for (column, number) in left.iter_mut().zip(numbers) {
                    column.cells.push_integer(number);
                }
                for (column, text) in right.iter_mut().zip(texts) {
                    column.cells.push_text(text);
                }
            }
        }
        file.group(&table)?;
        report(progress, part * signs::AT_ONCE, tokens.len(), "tokens")?;
    }
    file.finish()
}

fn report(progress: &mut Progress<'_>, done: usize, total: usize, task: &str) -> Result<()> {
    progress.report(Step {
        task,
        done: done as u64,
        total: Some(total as u64),
        unit: Unit::Items,
    })
}

/// Writes a row for each annotation of recordings; for tokens, each annotation that overlaps their span.
///
/// # Errors
/// Fails if rows are damaged, or `out` fails.
pub(super) fn annotations(
    connection: &Connection,
    stretches: &[Stretch],
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let mut file = File::new(&annotations_table(), &about(Long::Annotations), out)?;
    // An annotation that two tokens share is written as one row.
    let mut written = BTreeSet::new();
    for (done, stretch) in stretches.iter().enumerate() {
        let mut table = annotations_table();
        for tier in tiers::tiers(connection, stretch.recording.id)? {
            for row in tiers::annotations(connection, tier.id)? {
                let (start, end) = (stretch.span.start().micros(), stretch.span.end().micros());
                let inside = stretch.token.is_none() || (row.start_us < end && start < row.end_us);
                if inside && written.insert(row.id) {
                    annotation(&mut table, stretch, &tier, &row);
                }
            }
        }
        file.group(&table)?;
        report(progress, done + 1, stretches.len(), "recordings")?;
    }
    file.finish()
}

const TEXTS: [&str; 11] = [
    "recording",
    "tier",
    "tier_role",
    "component",
    "feature",
    "hand",
    "participant",
    "annotator",
    "file_id",
    "state",
    "value",
];

fn annotations_table() -> Table {
    let texts = TEXTS.map(|name| Column::new(name, Cells::Text(Vec::new())));
    let integers = ["annotation", "parent"];
    let integers = integers.map(|name| Column::new(name, Cells::Integer(Vec::new())));
    let doubles = ["start_s", "end_s", "confidence"];
    let doubles = doubles.map(|name| Column::new(name, Cells::Double(Vec::new())));
    let mut table: Table = texts.into_iter().chain(integers).chain(doubles).collect();
    table.push(Column::new("origin", Cells::Text(Vec::new())));
    table
}

fn annotation(table: &mut Table, stretch: &Stretch, tier: &TierRow, row: &AnnotationRow) {
    let value = Some(row.value.as_str()).filter(|_| row.state == ValueState::Value);
    let (component, feature) = tier.role.component().unzip();
    let seconds = |micros: i64| Some(micros as f64 / 1e6);
    let texts = [
        Some(stretch.recording.name.as_str()),
        Some(tier.name.as_str()),
        Some(tier.role.kind()),
        component.map(Component::name),
        feature.flatten(),
        tier.hand.map(Hands::name),
        tier.participant.as_deref(),
        tier.annotator.as_deref(),
        row.external_id.as_deref(),
        Some(row.state.name()),
        value,
    ];
    let mut columns = table.iter_mut().map(|column| &mut column.cells);
    for (text, cells) in texts.into_iter().zip(columns.by_ref()) {
        cells.push_text(text);
    }
    let integers = [Some(row.id), row.parent_id];
    for (number, cells) in integers.into_iter().zip(columns.by_ref()) {
        cells.push_integer(number);
    }
    let doubles = [seconds(row.start_us), seconds(row.end_us), row.confidence];
    for (number, cells) in doubles.into_iter().zip(columns.by_ref()) {
        cells.push_double(number);
    }
    if let Some(cells) = columns.next() {
        cells.push_text(Some(row.origin.name()));
    }
}

/// Writes a row for each joint of each frame: its position and rotation relative to its parent, and its position in the
/// room.
///
/// # Errors
/// Fails if blocks are damaged, or `out` fails.
pub(super) fn frames(
    connection: &Connection,
    stretches: &[Stretch],
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let mut file = File::new(&frames_table(), &about(Long::Frames), out)?;
    let takes = RefCell::default();
    for stretch in stretches {
        if recordings::body_track(connection, stretch.recording.id)?.is_some() {
            let usable = usable_take(connection, &takes, &stretch.recording)?.frames;
            movement(connection, (stretch, &usable), &mut file, progress)?;
        }
    }
    file.finish()
}

const NUMBERS: [&str; 10] = ["tx", "ty", "tz", "qx", "qy", "qz", "qw", "wx", "wy", "wz"];

fn frames_table() -> Table {
    let mut table = vec![
        Column::new("recording", Cells::Text(Vec::new())),
        Column::new("token", Cells::Integer(Vec::new())),
        Column::new("frame", Cells::Integer(Vec::new())),
        Column::new("t_s", Cells::Double(Vec::new())),
        Column::new("joint", Cells::Text(Vec::new())),
    ];
    table.extend(NUMBERS.map(|name| Column::new(name, Cells::Float(Vec::new()))));
    table.push(Column::new("usable", Cells::Flag(Vec::new())));
    table
}

fn movement(
    connection: &Connection,
    (stretch, usable): (&Stretch, &Range<usize>),
    file: &mut File<'_>,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let track = MotionTrack::of(connection, stretch.recording.id)?;
    let frames = track.frames_of(stretch);
    let joints = track.hierarchy.joints.len().max(1);
    let at_once = (GROUP / joints).max(1);
    let recording = ByteArray::from(stretch.recording.name.as_str());
    let token = stretch.token.as_ref().map(|it| it.id);
    let offset = track.row.offset_us as f64 / 1e6;
    let mut from = frames.start;
    while from < frames.end {
        let to = (from + at_once).min(frames.end);
        let clip = track.clip(connection, from..to, &ChannelGroup::ALL)?;
        let names: Vec<ByteArray> = clip
            .skeleton()
            .joints()
            .iter()
            .map(|joint| ByteArray::from(joint.name.as_str()))
            .collect();
        let mut numbers: Vec<Vec<f32>> = vec![Vec::new(); NUMBERS.len()];
        let (mut rows, mut times, mut own) = (Vec::new(), Vec::new(), Vec::new());
        for at in 0..clip.frames() {
            let (pose, model) = (clip.pose(at), clip.model_pose(at));
            let time = clip.rate().instant(from + at).seconds() + offset;
            for (joint, name) in names.iter().enumerate() {
                let (place, turn) = (pose.translations[joint], pose.rotations[joint]);
                let room = model.position(joint);
                let all = [
                    place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w, room.x, room.y,
                    room.z,
                ];
                for (column, value) in numbers.iter_mut().zip(all) {
                    column.push(value as f32);
                }
                rows.push(Some((from + at) as i64));
                times.push(Some(time));
                own.push(Some(name.clone()));
            }
        }
        let flags = rows
            .iter()
            .map(|row: &Option<i64>| row.map(|frame| usable.contains(&(frame as usize))));
        let flags = Cells::Flag(flags.collect());
        let mut table = frames_table();
        table[0].cells = Cells::Text(vec![Some(recording.clone()); rows.len()]);
        table[1].cells = Cells::Integer(vec![token; rows.len()]);
        table[2].cells = Cells::Integer(rows);
        table[3].cells = Cells::Double(times);
        table[4].cells = Cells::Text(own);
        let numbers = numbers.into_iter().map(Cells::Float);
        for (column, cells) in table[5..].iter_mut().zip(numbers.chain([flags])) {
            column.cells = cells;
        }
        file.group(&table)?;
        progress.report(Step {
            task: &stretch.recording.name,
            done: (to - frames.start) as u64,
            total: Some(frames.len() as u64),
            unit: Unit::Frames,
        })?;
        from = to;
    }
    Ok(())
}
