//! Long tables as Parquet for pandas, polars and DuckDB: tokens, their components, annotations, and frames of
//! movement.

mod file;
#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use ::parquet::data_type::ByteArray;
use chereme_sign::SignComponent;
use chereme_sign::tier::AnnotatedHands;
use rusqlite::Connection;

use super::export_long::LongTable;
use super::{ExportJob, csv};
use crate::address::RecordingStretch;
use crate::db::signs;
use crate::db::stored_attributes;
use crate::db::stored_columns::{OpinionStanding, ValueState, phase_name, phase_place};
use crate::db::stored_recordings;
use crate::db::stored_search::search_answers;
use crate::db::stored_tiers::{self, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};
use crate::hands::usable_take;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};
use file::{ParquetCells, ParquetColumn, ParquetFileWriter, ParquetTable};

/// The largest number of movement rows in a group.
const MAX_GROUP_ROWS: usize = 1 << 18;

/// Returns a description of a table's columns for the file's metadata.
fn describe_long_table(long: LongTable) -> String {
    let (table, columns) = match long {
        LongTable::Tokens => (
            "tokens",
            "a token a row; columns of components are named as queries spell them, with _ for dots; several values \
             stand in one cell as in lexicons (chin > chest, S + W), n/a is not applicable, ? unclear; start_s and end_s \
             are seconds of the recording",
        ),
        LongTable::Components => (
            "components",
            "a value of a token that counts a row; state is value, not-applicable or unclear; by is the annotator, confidence \
             that of a detector whose proposal was accepted; proposals and values in dispute are rows of annotations only",
        ),
        LongTable::Annotations => (
            "annotations",
            "an annotation a row; start_s and end_s are seconds of the recording; state is value, unset, \
             not-applicable or unclear; standing is coded, proposed or disputed, the last two do not count",
        ),
        LongTable::Frames => (
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
pub(super) fn write_token_parquet(job: &mut ExportJob<'_, '_>, tokens: &[i64]) -> CorpusResult<()> {
    let mut text = Vec::new();
    let form = csv::TableForm {
        audience: job.gate.export_audience().consent_audience(),
        ..csv::TableForm::new(b',')
    };
    // Both formats then have the same columns and cells.
    let mut table_job = ExportJob {
        out: &mut text,
        connection: job.connection,
        gate: job.gate,
        notes: job.notes,
        progress: job.progress,
    };
    csv::write_token_csv(&mut table_job, tokens, form)?;
    let fault = |error: ::csv::Error| CorpusError::from_wrong_message(error.to_string());
    let mut reader = ::csv::Reader::from_reader(text.as_slice());
    let titles: Vec<String> = reader.headers().map_err(fault)?.iter().map(str::to_owned).collect();
    let mut columns: Vec<Vec<Option<String>>> = vec![Vec::new(); titles.len()];
    for record in reader.records() {
        let record = record.map_err(fault)?;
        for (column, cell) in columns.iter_mut().zip(&record) {
            column.push(Some(cell.to_owned()).filter(|cell| !cell.is_empty()));
        }
    }
    let numbers = numeric(job.connection, tokens)?;
    let mut taken = BTreeSet::new();
    let table: ParquetTable = titles
        .iter()
        .zip(columns)
        .map(|(title, cells)| {
            let cells = match title.as_str() {
                "start_s" | "end_s" => ParquetCells::Double(parse_cell_values(&cells)),
                "token" => ParquetCells::Integer(parse_cell_values(&cells)),
                "citation" => {
                    let flags = cells.iter().map(|cell| cell.as_deref().map(|text| text == "yes"));
                    ParquetCells::Flag(flags.collect())
                }
                name if numbers.contains(name) => ParquetCells::Double(parse_cell_values(&cells)),
                _ => ParquetCells::Text(cells.iter().map(|cell| Some(cell.as_deref()?.into())).collect()),
            };
            ParquetColumn::new(&plain_column_title(title, &mut taken), cells)
        })
        .collect();
    let mut file = ParquetFileWriter::new(&table, &describe_long_table(LongTable::Tokens), job.out)?;
    file.write_row_group(&table)?;
    file.finish_parquet_file()
}

/// Returns the names of attributes that are numbers for every token that has them.
fn numeric(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeSet<String>> {
    let mut all: BTreeMap<String, bool> = BTreeMap::new();
    for ids in tokens.chunks(signs::MAX_ROWS_PER_QUERY) {
        let rows = stored_attributes::of_tokens(connection, ids)?;
        for row in rows.into_values().flatten() {
            // A number that Rust would read differently stays text.
            let plain = row.number.is_some() && row.text.trim().parse::<f64>().ok() == row.number;
            // Empty cells do not keep a column from being one of numbers.
            *all.entry(row.name).or_insert(true) &= plain || row.text.is_empty();
        }
    }
    Ok(all.into_iter().filter(|pair| pair.1).map(|pair| pair.0).collect())
}

fn parse_cell_values<T: std::str::FromStr>(cells: &[Option<String>]) -> Vec<Option<T>> {
    let cells = cells.iter();
    cells.map(|cell| cell.as_deref()?.trim().parse().ok()).collect()
}

/// Returns a title in lower-case letters, digits and underscores that is not in `taken`.
fn plain_column_title(title: &str, taken: &mut BTreeSet<String>) -> String {
    let mut name = String::new();
    for letter in title.to_lowercase().chars() {
        let letter = if letter.is_alphanumeric() { letter } else { '_' };
        if letter != '_' || !name.ends_with('_') {
            name.push(letter);
        }
    }
    let name = match name.trim_matches('_') {
        "" => "column",
        name => name,
    };
    let mut unique_name = name.to_owned();
    let mut number = 2;
    // Two titles may become equal when their signs are replaced.
    while !taken.insert(unique_name.clone()) {
        unique_name = format!("{name}_{number}");
        number += 1;
    }
    unique_name
}

/// Writes a row for each value of each token.
///
/// # Errors
/// Fails if rows are damaged, or `out` fails.
pub(super) fn write_component_parquet(job: &mut ExportJob<'_, '_>, tokens: &[i64]) -> CorpusResult<()> {
    let connection = job.connection;
    let texts = [
        "gloss",
        "lexicon",
        "recording",
        "component",
        "feature",
        "hand",
        "phase",
        "state",
        "value",
        "by",
    ];
    let empty: ParquetTable = ["token", "position", "annotation", "homonym"]
        .map(|name| ParquetColumn::new(name, ParquetCells::Integer(Vec::new())))
        .into_iter()
        .chain(texts.map(|name| ParquetColumn::new(name, ParquetCells::Text(Vec::new()))))
        .chain([ParquetColumn::new("confidence", ParquetCells::Double(Vec::new()))])
        .collect();
    let mut file = ParquetFileWriter::new(&empty, &describe_long_table(LongTable::Components), job.out)?;
    for (part, ids) in tokens.chunks(signs::MAX_ROWS_PER_QUERY).enumerate() {
        let mut table = empty.clone();
        let rows = signs::load_token_rows(connection, ids)?;
        let values = signs::values_of(connection, ids)?;
        let authors = search_answers::load_value_authors(connection, ids)?;
        for id in ids {
            let Some(token) = rows.get(id) else { continue };
            for value in values.get(id).map_or(&[][..], Vec::as_slice) {
                let place = phase_place(value.phase);
                let author = value.annotation_id.and_then(|annotation| authors.get(&annotation));
                let numbers = [Some(*id), Some(place), value.annotation_id, token.homonym];
                let texts = [
                    Some(token.plain_gloss()),
                    token.lexicon.as_deref(),
                    token.recording.as_deref(),
                    Some(value.component.component_name()),
                    value.feature.as_deref(),
                    value.hand.map(AnnotatedHands::annotated_hands_name),
                    value.phase.map(phase_name),
                    Some(value.state.value_state_name()),
                    value.value.as_deref(),
                    author.and_then(|author| author.0.as_deref()),
                ];
                let (left, right) = table.split_at_mut(numbers.len());
                for (column, number) in left.iter_mut().zip(numbers) {
                    column.cells.push_integer(number);
                }
                for (column, text) in right.iter_mut().zip(texts) {
                    column.cells.push_text(text);
                }
                if let Some(column) = right.last_mut() {
                    column.cells.push_double(author.and_then(|author| author.1));
                }
            }
        }
        file.write_row_group(&table)?;
        report_parquet_progress(job.progress, part * signs::MAX_ROWS_PER_QUERY, tokens.len(), "tokens")?;
    }
    file.finish_parquet_file()
}

fn report_parquet_progress(
    progress: &mut ProgressReceiver<'_>,
    done: usize,
    total: usize,
    task: &str,
) -> CorpusResult<()> {
    progress.report_items(task, done, total)
}

/// Writes a row for each annotation of recordings; for tokens, each annotation that overlaps their span.
///
/// # Errors
/// Fails if rows are damaged, or `out` fails.
pub(super) fn write_annotation_parquet(
    job: &mut ExportJob<'_, '_>,
    stretches: &[RecordingStretch],
) -> CorpusResult<()> {
    let connection = job.connection;
    let mut file = ParquetFileWriter::new(
        &annotations_table(),
        &describe_long_table(LongTable::Annotations),
        job.out,
    )?;
    // An annotation that two tokens share is written as one row.
    let mut written = BTreeSet::new();
    let opinions = signs::opinion_standings(connection)?;
    for (done, stretch) in stretches.iter().enumerate() {
        let mut table = annotations_table();
        for tier in stored_tiers::load_tier_rows(connection, stretch.recording.id)? {
            for row in stored_tiers::load_tier_annotation_rows(connection, tier.id)? {
                let (start, end) = stretch.span.span_bounds_micros();
                let inside = stretch.token.is_none() || (row.start_us < end && start < row.end_us);
                if inside && written.insert(row.id) {
                    push_annotation_cells(&mut table, stretch, &tier, &row, opinions.get(&row.id).copied());
                }
            }
        }
        file.write_row_group(&table)?;
        report_parquet_progress(job.progress, done + 1, stretches.len(), "recordings")?;
    }
    file.finish_parquet_file()
}

const ANNOTATION_TEXT_COLUMNS: [&str; 11] = [
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

fn annotations_table() -> ParquetTable {
    let texts = ANNOTATION_TEXT_COLUMNS.map(|name| ParquetColumn::new(name, ParquetCells::Text(Vec::new())));
    let integer_names = ["annotation", "parent"];
    let integers = integer_names.map(|name| ParquetColumn::new(name, ParquetCells::Integer(Vec::new())));
    let double_names = ["start_s", "end_s", "confidence"];
    let doubles = double_names.map(|name| ParquetColumn::new(name, ParquetCells::Double(Vec::new())));
    let mut table: ParquetTable = texts.into_iter().chain(integers).chain(doubles).collect();
    let last_names = ["origin", "standing"];
    table.extend(last_names.map(|name| ParquetColumn::new(name, ParquetCells::Text(Vec::new()))));
    table
}

fn push_annotation_cells(
    table: &mut ParquetTable,
    stretch: &RecordingStretch,
    tier: &TierRow,
    row: &AnnotationRow,
    opinion: Option<Option<OpinionStanding>>,
) {
    let value = Some(row.value.as_str()).filter(|_| row.state == ValueState::Value);
    let (component, feature) = tier.role.role_component().unzip();
    let seconds = |micros: i64| Some(micros as f64 / 1e6);
    let texts = [
        Some(stretch.recording.name.as_str()),
        Some(tier.name.as_str()),
        Some(tier.role.role_kind_name()),
        component.map(SignComponent::component_name),
        feature.flatten(),
        tier.hand.map(AnnotatedHands::annotated_hands_name),
        tier.participant.as_deref(),
        tier.annotator.as_deref(),
        row.external_id.as_deref(),
        Some(row.state.value_state_name()),
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
    let standing = match opinion {
        Some(Some(standing)) => standing.standing_name(),
        _ if tier.is_proposal(row) => OpinionStanding::Proposed.standing_name(),
        Some(None) => OpinionStanding::Disputed.standing_name(),
        None => "coded",
    };
    for (cells, text) in columns.zip([row.origin.annotation_origin_name(), standing]) {
        cells.push_text(Some(text));
    }
}

/// Writes a row for each joint of each frame: its position and rotation relative to its parent, and its position in the
/// room.
///
/// # Errors
/// Fails if blocks are damaged, or `out` fails.
pub(super) fn write_frame_parquet(job: &mut ExportJob<'_, '_>, stretches: &[RecordingStretch]) -> CorpusResult<()> {
    let connection = job.connection;
    let mut file = ParquetFileWriter::new(&frames_table(), &describe_long_table(LongTable::Frames), job.out)?;
    let takes = RefCell::default();
    for stretch in stretches {
        if stored_recordings::body_track(connection, stretch.recording.id)?.is_some() {
            let usable = usable_take(connection, &takes, &stretch.recording)?.frames;
            write_movement_groups(connection, stretch, &usable, &mut file, job.progress)?;
        }
    }
    file.finish_parquet_file()
}

const FRAME_NUMBER_COLUMNS: [&str; 10] = ["tx", "ty", "tz", "qx", "qy", "qz", "qw", "wx", "wy", "wz"];

fn frames_table() -> ParquetTable {
    let mut table = vec![
        ParquetColumn::new("recording", ParquetCells::Text(Vec::new())),
        ParquetColumn::new("token", ParquetCells::Integer(Vec::new())),
        ParquetColumn::new("frame", ParquetCells::Integer(Vec::new())),
        ParquetColumn::new("t_s", ParquetCells::Double(Vec::new())),
        ParquetColumn::new("joint", ParquetCells::Text(Vec::new())),
    ];
    table.extend(FRAME_NUMBER_COLUMNS.map(|name| ParquetColumn::new(name, ParquetCells::Float(Vec::new()))));
    table.push(ParquetColumn::new("usable", ParquetCells::Flag(Vec::new())));
    table
}

fn write_movement_groups(
    connection: &Connection,
    stretch: &RecordingStretch,
    usable: &Range<usize>,
    file: &mut ParquetFileWriter<'_>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
    let frames = track.stretch_frames(stretch);
    let joints = track.hierarchy.joints.len().max(1);
    // Skeletons with many joints get fewer frames in a group, so that groups stay alike in size.
    let at_once = (MAX_GROUP_ROWS / joints).max(1);
    let recording = ByteArray::from(stretch.recording.name.as_str());
    let token = stretch.token.as_ref().map(|token_row| token_row.id);
    let offset = track.row.offset_us as f64 / 1e6;
    let mut from = frames.start;
    while from < frames.end {
        let to = (from + at_once).min(frames.end);
        let clip = track.read_motion_clip(connection, from..to, &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let names: Vec<ByteArray> = clip
            .clip_skeleton()
            .skeleton_joints()
            .iter()
            .map(|joint| ByteArray::from(joint.name.as_str()))
            .collect();
        let mut numbers: Vec<Vec<f32>> = vec![Vec::new(); FRAME_NUMBER_COLUMNS.len()];
        let (mut rows, mut times, mut own) = (Vec::new(), Vec::new(), Vec::new());
        for at in 0..clip.clip_frame_count() {
            let (pose, model) = (clip.clip_pose_at(at), clip.model_pose(at));
            let time = clip.clip_frame_rate().frame_start_instant(from + at).instant_seconds() + offset;
            for (joint, name) in names.iter().enumerate() {
                let (place, turn) = (pose.translations[joint], pose.rotations[joint]);
                let room = model.model_joint_position(joint);
                let all = [
                    place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w, room.x, room.y, room.z,
                ];
                for (column, value) in numbers.iter_mut().zip(all) {
                    column.push(value as f32);
                }
                rows.push(Some((from + at) as i64));
                times.push(Some(time));
                own.push(Some(name.clone()));
            }
        }
        let frame_flags = rows
            .iter()
            .map(|row: &Option<i64>| row.map(|frame| usable.contains(&(frame as usize))));
        let flags = ParquetCells::Flag(frame_flags.collect());
        let mut table = frames_table();
        table[0].cells = ParquetCells::Text(vec![Some(recording.clone()); rows.len()]);
        table[1].cells = ParquetCells::Integer(vec![token; rows.len()]);
        table[2].cells = ParquetCells::Integer(rows);
        table[3].cells = ParquetCells::Double(times);
        table[4].cells = ParquetCells::Text(own);
        let numbers = numbers.into_iter().map(ParquetCells::Float);
        for (column, cells) in table[5..].iter_mut().zip(numbers.chain([flags])) {
            column.cells = cells;
        }
        file.write_row_group(&table)?;
        progress.report_step(ProgressStep {
            task: &stretch.recording.name,
            done: (to - frames.start) as u64,
            total: Some(frames.len() as u64),
            unit: ProgressUnit::Frames,
        })?;
        from = to;
    }
    Ok(())
}
