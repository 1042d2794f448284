//! Long tables as Parquet: tokens, annotations, and frames of movement, for pandas, polars and DuckDB.

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::sync::{Arc, Mutex};

use ::parquet::basic::{
    Compression, ConvertedType, Encoding, Repetition, Type as Physical, ZstdLevel,
};
use ::parquet::data_type::{ByteArray, ByteArrayType, DoubleType, FloatType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::{WriterProperties, WriterPropertiesPtr};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::{ColumnPath, Type, TypePtr};
use rusqlite::Connection;

use super::Long;
use crate::db::recordings::{self, RecordingRow};
use crate::db::tiers;
use crate::error::{Error, Result};
use crate::movement::{ChannelGroup, Track};
use crate::progress::{Progress, Step, Unit};

/// So many rows are in a group at most.
const GROUP: usize = 1 << 20;

/// The cells of a column; a gap is null.
#[derive(Debug, Clone, PartialEq)]
enum Cells {
    Text(Vec<Option<String>>),
    Double(Vec<Option<f64>>),
    Float(Vec<f32>),
    Integer(Vec<Option<i64>>),
}

/// Some rows, column by column.
type Table = Vec<(String, Cells)>;

/// Writes the table of tokens that a CSV holds; numbers of times, rows and frequencies as numbers.
///
/// # Errors
/// If `out` fails.
pub(super) fn tokens(csv: &[u8], out: &mut dyn Write) -> Result<()> {
    let fault = |error: csv::Error| Error::wrong(error.to_string());
    let mut reader = csv::Reader::from_reader(csv);
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
    let mut taken = BTreeSet::new();
    let table: Table = titles
        .iter()
        .zip(columns)
        .map(|(title, cells)| {
            let cells = match title.as_str() {
                "start_s" | "end_s" => Cells::Double(parsed(&cells)),
                "token" => Cells::Integer(parsed(&cells)),
                _ => Cells::Text(cells),
            };
            (plain(title, &mut taken), cells)
        })
        .collect();
    let mut writer = Writer::new(&table, out)?;
    writer.group(&table)?;
    writer.finish()
}

fn parsed<T: std::str::FromStr>(cells: &[Option<String>]) -> Vec<Option<T>> {
    cells
        .iter()
        .map(|cell| cell.as_deref()?.parse().ok())
        .collect()
}

/// Returns a title in small letters, digits and underscores, each once.
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
    let name = name.trim_matches('_').to_owned();
    let mut own = name.clone();
    let mut number = 2;
    while !taken.insert(own.clone()) {
        own = format!("{name}_{number}");
        number += 1;
    }
    own
}

/// Writes the annotations or the frames of recordings.
///
/// # Errors
/// If rows or blocks are damaged, or `out` fails.
pub(super) fn recordings(
    connection: &Connection,
    all: &[RecordingRow],
    long: Long,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let empty = match long {
        Long::Frames => frames_table(),
        _ => annotations_table(),
    };
    let mut writer = Writer::new(&empty, out)?;
    for (done, recording) in all.iter().enumerate() {
        if long == Long::Frames {
            frames(connection, recording, &mut writer)?;
        } else {
            writer.group(&annotations(connection, recording)?)?;
        }
        progress.tell(Step {
            task: "recordings",
            done: done as u64 + 1,
            total: Some(all.len() as u64),
            unit: Unit::Items,
        })?;
    }
    writer.finish()
}

fn annotations_table() -> Table {
    let text = |name: &str| (name.to_owned(), Cells::Text(Vec::new()));
    let double = |name: &str| (name.to_owned(), Cells::Double(Vec::new()));
    let integer = |name: &str| (name.to_owned(), Cells::Integer(Vec::new()));
    vec![
        text("recording"),
        text("tier"),
        text("tier_role"),
        text("component"),
        text("hand"),
        text("participant"),
        text("annotator"),
        integer("annotation_id"),
        integer("parent_id"),
        text("file_id"),
        double("begin_s"),
        double("end_s"),
        text("value"),
        text("state"),
        text("origin"),
        double("confidence"),
    ]
}

fn annotations(connection: &Connection, recording: &RecordingRow) -> Result<Table> {
    let mut table = annotations_table();
    for tier in tiers::tiers(connection, recording.id)? {
        for row in tiers::annotations(connection, tier.id)? {
            let seconds = |us: i64| Some(us as f64 / 1e6);
            let texts = [
                (0, Some(recording.name.clone())),
                (1, Some(tier.name.clone())),
                (2, Some(tier.role.clone())),
                (3, tier.component.clone()),
                (4, tier.hand.clone()),
                (5, tier.participant.clone()),
                (6, tier.annotator.clone()),
                (9, row.external_id.clone()),
                (12, Some(row.value.clone()).filter(|_| row.state == "value")),
                (13, Some(row.state.clone())),
                (14, Some(row.origin.clone())),
            ];
            for (at, text) in texts {
                if let Cells::Text(cells) = &mut table[at].1 {
                    cells.push(text);
                }
            }
            for (at, number) in [(7, Some(row.id)), (8, row.parent_id)] {
                if let Cells::Integer(cells) = &mut table[at].1 {
                    cells.push(number);
                }
            }
            for (at, number) in [
                (10, seconds(row.start_us)),
                (11, seconds(row.end_us)),
                (15, row.confidence),
            ] {
                if let Cells::Double(cells) = &mut table[at].1 {
                    cells.push(number);
                }
            }
        }
    }
    Ok(table)
}

const NUMBERS: [&str; 10] = ["tx", "ty", "tz", "qx", "qy", "qz", "qw", "wx", "wy", "wz"];

fn frames_table() -> Table {
    let mut table = vec![
        ("recording".to_owned(), Cells::Text(Vec::new())),
        ("frame".to_owned(), Cells::Integer(Vec::new())),
        ("t_s".to_owned(), Cells::Double(Vec::new())),
        ("joint".to_owned(), Cells::Text(Vec::new())),
    ];
    table.extend(NUMBERS.map(|name| (name.to_owned(), Cells::Float(Vec::new()))));
    table
}

/// Writes movement in metres of model space: each joint's place and turn below its parent, and its place in
/// the room.
fn frames(
    connection: &Connection,
    recording: &RecordingRow,
    writer: &mut Writer<'_>,
) -> Result<()> {
    if recordings::body_track(connection, recording.id)?.is_none() {
        return Ok(());
    }
    let track = Track::of(connection, recording.id)?;
    let mut from = 0;
    while from < track.frames() {
        let joints = track
            .clip(connection, from..from + 1, &ChannelGroup::ALL)?
            .skeleton()
            .len();
        let to = (from + (GROUP / joints.max(1)).max(1)).min(track.frames());
        let clip = track.clip(connection, from..to, &ChannelGroup::ALL)?;
        let mut table = frames_table();
        let mut numbers: Vec<Vec<f32>> = vec![Vec::new(); NUMBERS.len()];
        let (mut rows, mut times, mut names) = (Vec::new(), Vec::new(), Vec::new());
        for at in 0..clip.frames() {
            let (pose, model) = (clip.pose(at), clip.model_pose(at));
            let time = clip.rate().instant(from + at).seconds() + track.row.offset_us as f64 / 1e6;
            for (joint, own) in clip.skeleton().joints().iter().enumerate() {
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
                names.push(Some(own.name.clone()));
            }
        }
        table[0].1 = Cells::Text(vec![Some(recording.name.clone()); rows.len()]);
        table[1].1 = Cells::Integer(rows);
        table[2].1 = Cells::Double(times);
        table[3].1 = Cells::Text(names);
        for (column, values) in table[4..].iter_mut().zip(numbers) {
            column.1 = Cells::Float(values);
        }
        writer.group(&table)?;
        from = to;
    }
    Ok(())
}

/// The bytes of a file under construction, until they go out.
#[derive(Clone, Default)]
struct Held(Arc<Mutex<Vec<u8>>>);

impl Write for Held {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut held = self
            .0
            .lock()
            .map_err(|_| io::Error::other("the writer failed"))?;
        held.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

struct Writer<'o> {
    held: Held,
    out: &'o mut dyn Write,
    file: SerializedFileWriter<Held>,
}

fn fault(error: ParquetError) -> Error {
    Error::wrong(format!("the table cannot be written: {error}"))
}

impl<'o> Writer<'o> {
    /// Begins a file with the columns of a table.
    fn new(table: &Table, out: &'o mut dyn Write) -> Result<Self> {
        let held = Held::default();
        let file = SerializedFileWriter::new(held.clone(), schema(table)?, properties(table)?);
        Ok(Self {
            file: file.map_err(fault)?,
            held,
            out,
        })
    }

    /// Writes the rows of a table as a group.
    fn group(&mut self, table: &Table) -> Result<()> {
        let mut group = self.file.next_row_group().map_err(fault)?;
        for (_, cells) in table {
            let Some(mut column) = group.next_column().map_err(fault)? else {
                break;
            };
            let levels =
                |there: Vec<bool>| -> Vec<i16> { there.into_iter().map(i16::from).collect() };
            match cells {
                Cells::Text(cells) => {
                    let levels = levels(cells.iter().map(Option::is_some).collect());
                    let all = cells.iter().flatten();
                    let all: Vec<ByteArray> =
                        all.map(|cell| ByteArray::from(cell.as_str())).collect();
                    let written =
                        column
                            .typed::<ByteArrayType>()
                            .write_batch(&all, Some(&levels), None);
                    written.map_err(fault)?;
                }
                Cells::Double(cells) => {
                    let levels = levels(cells.iter().map(Option::is_some).collect());
                    let all: Vec<f64> = cells.iter().flatten().copied().collect();
                    let written =
                        column
                            .typed::<DoubleType>()
                            .write_batch(&all, Some(&levels), None);
                    written.map_err(fault)?;
                }
                Cells::Integer(cells) => {
                    let levels = levels(cells.iter().map(Option::is_some).collect());
                    let all: Vec<i64> = cells.iter().flatten().copied().collect();
                    let written =
                        column
                            .typed::<Int64Type>()
                            .write_batch(&all, Some(&levels), None);
                    written.map_err(fault)?;
                }
                Cells::Float(cells) => {
                    let written = column.typed::<FloatType>().write_batch(cells, None, None);
                    written.map_err(fault)?;
                }
            }
            column.close().map_err(fault)?;
        }
        group.close().map_err(fault)?;
        self.drain()
    }

    fn finish(mut self) -> Result<()> {
        self.file.finish().map_err(fault)?;
        self.drain()
    }

    /// Passes on what was written so far.
    fn drain(&mut self) -> Result<()> {
        let fault =
            |error: io::Error| Error::wrong(format!("the table cannot be written: {error}"));
        let taken = self
            .held
            .0
            .lock()
            .map(|mut held| std::mem::take(&mut *held));
        let bytes = taken.map_err(|_| fault(io::Error::other("the writer failed")))?;
        self.out.write_all(&bytes).map_err(fault)
    }
}

fn schema(table: &Table) -> Result<TypePtr> {
    let fields: Result<Vec<TypePtr>> = table
        .iter()
        .map(|(name, cells)| {
            let (physical, repetition) = match cells {
                Cells::Text(_) => (Physical::BYTE_ARRAY, Repetition::OPTIONAL),
                Cells::Double(_) => (Physical::DOUBLE, Repetition::OPTIONAL),
                Cells::Integer(_) => (Physical::INT64, Repetition::OPTIONAL),
                Cells::Float(_) => (Physical::FLOAT, Repetition::REQUIRED),
            };
            let kind = if physical == Physical::BYTE_ARRAY {
                ConvertedType::UTF8
            } else {
                ConvertedType::NONE
            };
            let field = Type::primitive_type_builder(name, physical)
                .with_repetition(repetition)
                .with_converted_type(kind)
                .build();
            Ok(Arc::new(field.map_err(fault)?))
        })
        .collect();
    let whole = Type::group_type_builder("chereme")
        .with_fields(fields?)
        .build();
    Ok(Arc::new(whole.map_err(fault)?))
}

/// Returns how columns are packed: texts by dictionary, movement byte by byte.
fn properties(table: &Table) -> Result<WriterPropertiesPtr> {
    let level = ZstdLevel::try_new(3).map_err(fault)?;
    let mut builder = WriterProperties::builder()
        .set_created_by(format!("Chereme {}", env!("CARGO_PKG_VERSION")))
        .set_compression(Compression::ZSTD(level));
    for (name, cells) in table {
        let path = ColumnPath::from(name.as_str());
        if matches!(cells, Cells::Float(_)) {
            builder = builder
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
        }
    }
    Ok(Arc::new(builder.build()))
}
