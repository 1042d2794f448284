//! Rows of tracks of every kind, and of their channels.

use std::collections::BTreeMap;
use std::str::FromStr;

use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};
use rusqlite::{Connection, Row, params};
use serde::Serialize;

use super::damaged_row_error;
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

/// The kind of a track.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TrackKind {
    /// Rotations and places of joints.
    Skeleton,
    /// Named points in a room or on a picture.
    Markers,
    /// Named scalar channels.
    Curves,
    /// A film, sound or picture next to the corpus.
    Media,
}

impl TrackKind {
    /// Every kind.
    pub const ALL_TRACK_KINDS: [Self; 4] = [Self::Skeleton, Self::Markers, Self::Curves, Self::Media];

    /// Returns the name: `skeleton`, `markers`, `curves` or `media`.
    #[must_use]
    pub fn track_kind_name(self) -> &'static str {
        match self {
            Self::Skeleton => "skeleton",
            Self::Markers => "markers",
            Self::Curves => "curves",
            Self::Media => "media",
        }
    }
}

impl FromStr for TrackKind {
    type Err = CorpusError;

    fn from_str(text: &str) -> CorpusResult<Self> {
        let named_kind = Self::ALL_TRACK_KINDS
            .into_iter()
            .find(|kind| kind.track_kind_name() == text);
        named_kind.ok_or_else(|| {
            CorpusError::from_wrong_message(format!("{text:?} is no kind of track"))
                .with_error_place(text)
                .with_advice("the kinds are: skeleton, markers, curves, media")
        })
    }
}

/// One track of a recording at a glance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrackRow {
    /// The row.
    pub id: i64,
    /// The recording's row.
    pub recording_id: i64,
    /// The kind.
    pub kind: TrackKind,
    /// The name, which no other track of the recording has.
    pub name: String,
    /// The time of the track's own time 0 on the recording's clock, in microseconds; may be negative.
    pub offset_us: i64,
    /// Its length in microseconds; `None` for media of unknown length.
    pub duration_us: Option<i64>,
    /// The number of frames; `None` for media.
    pub frames: Option<u64>,
    /// The rate of its frames; `None` for media, and for frames with individual times.
    pub rate: Option<FrameRate>,
    /// The number of joints, points or scalar channels; 0 for media.
    pub channels: u64,
    /// The time of day of the track's own time 0, in microseconds after midnight, if it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clock_us: Option<i64>,
}

impl TrackRow {
    /// Returns the span on the recording's clock, empty if its length is unknown.
    #[must_use]
    pub fn track_clock_span(&self) -> TimeSpan {
        let start = RecordingInstant::from_micros(self.offset_us);
        TimeSpan::span_between(start, start.shifted_instant(self.duration_us.unwrap_or_default()))
    }
}

/// The columns of a track that [`TrackRow`] does not include.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TrackForm {
    /// The length of one unit of positions in metres.
    pub(crate) metres_per_unit: Option<f64>,
    /// The axes of positions, as `up,left`.
    pub(crate) axes: Option<String>,
    /// Further properties needed to read this kind of track, as JSON.
    pub(crate) layout: Option<String>,
}

/// A point or a scalar channel of a track.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ChannelRow {
    /// The group of blocks that hold its numbers.
    pub(crate) group: String,
    /// The part of the file to which it belongs.
    pub(crate) part: String,
    pub(crate) name: String,
    pub(crate) unit: String,
    /// The number of its columns in the blocks.
    pub(crate) columns: usize,
}

const SELECT_TRACK_SQL: &str = "
    SELECT t.id, t.recording_id, t.kind, t.name, t.offset_us,
           coalesce(t.duration_us,
               CAST(round(t.frames * 1000000.0 * t.rate_seconds / t.rate_frames) AS INTEGER)),
           t.frames, t.rate_frames, t.rate_seconds,
           CASE t.kind WHEN 'skeleton' THEN (SELECT joints FROM skeleton s WHERE s.id = t.skeleton_id)
               ELSE (SELECT count(*) FROM channel c WHERE c.track_id = t.id) END, t.clock_us
    FROM track t";

fn track_row(row: &Row<'_>) -> rusqlite::Result<CorpusResult<TrackRow>> {
    let (id, kind): (i64, String) = (row.get(0)?, row.get(2)?);
    let Ok(kind) = kind.parse() else {
        let reason = format!("its kind {kind:?} is unknown to this program");
        return Ok(Err(damaged_row_error(format!("track {id}"), reason)));
    };
    let rate: Option<(u32, u32)> = row.get::<_, Option<u32>>(7)?.zip(row.get(8)?);
    Ok(Ok(TrackRow {
        id,
        recording_id: row.get(1)?,
        kind,
        name: row.get(3)?,
        offset_us: row.get(4)?,
        duration_us: row.get(5)?,
        frames: row.get::<_, Option<i64>>(6)?.map(i64::unsigned_abs),
        rate: rate.and_then(|(frames, seconds)| FrameRate::new(frames, seconds).ok()),
        channels: row.get::<_, Option<i64>>(9)?.unwrap_or_default().unsigned_abs(),
        clock_us: row.get(10)?,
    }))
}

/// Returns the tracks of a recording, oldest first.
pub(crate) fn load_track_rows(connection: &Connection, recording: i64) -> CorpusResult<Vec<TrackRow>> {
    let sql = format!("{SELECT_TRACK_SQL} WHERE t.recording_id = ?1 ORDER BY t.id");
    let rows: Vec<_> = connection.read_rows(&sql, [recording], track_row)?;
    rows.into_iter().collect()
}

/// Returns all tracks that hold numbers, by recording.
pub(crate) fn all_moving(connection: &Connection) -> CorpusResult<Vec<TrackRow>> {
    let sql = format!("{SELECT_TRACK_SQL} WHERE t.kind <> 'media' ORDER BY t.recording_id, t.id");
    let rows: Vec<_> = connection.read_rows(&sql, [], track_row)?;
    rows.into_iter().collect()
}

/// Returns the track of that row.
pub(crate) fn load_track_row(connection: &Connection, id: i64) -> CorpusResult<TrackRow> {
    let stored_track = connection.find_row(&format!("{SELECT_TRACK_SQL} WHERE t.id = ?1"), [id], track_row)?;
    stored_track.unwrap_or_else(|| {
        Err(CorpusError::from_wrong_message(format!("there is no track {id}"))
            .with_error_place(format!("track {id}"))
            .with_command_advice("`chereme list CORPUS tracks` lists them"))
    })
}

/// Returns the columns of a track that [`TrackRow`] does not include.
pub(crate) fn load_track_form(connection: &Connection, id: i64) -> CorpusResult<TrackForm> {
    let sql = "SELECT metres_per_unit, axes, layout FROM track WHERE id = ?1";
    connection.read_row(sql, [id], |row| {
        Ok(TrackForm {
            metres_per_unit: row.get(0)?,
            axes: row.get(1)?,
            layout: row.get(2)?,
        })
    })
}

/// Writes a track of markers or curves and returns its row; `id` and `channels` are not used.
pub(crate) fn insert_track_row(connection: &Connection, row: &TrackRow, form: &TrackForm) -> CorpusResult<i64> {
    let frames = row.frames.map(|frames| i64::try_from(frames).unwrap_or(i64::MAX));
    let sql = "INSERT INTO track (recording_id, kind, name, offset_us, duration_us, frames, rate_frames,
                 rate_seconds, metres_per_unit, axes, layout)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)";
    let values = params![
        row.recording_id,
        row.kind.track_kind_name(),
        row.name,
        row.offset_us,
        row.duration_us,
        frames,
        row.rate.map(FrameRate::rate_numerator),
        row.rate.map(FrameRate::per_seconds),
        form.metres_per_unit,
        form.axes,
        form.layout
    ];
    connection.insert_row(sql, values)
}

/// Writes the channels of a track in their order.
pub(crate) fn insert_channels(connection: &Connection, track: i64, rows: &[ChannelRow]) -> CorpusResult<()> {
    let mut statement = connection.prepare_cached(
        "INSERT INTO channel (track_id, position, channel_group, part, name, unit, columns)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
    )?;
    for (position, row) in rows.iter().enumerate() {
        ensure_group(connection, &row.group)?;
        statement.execute(params![
            track,
            position as i64,
            row.group,
            row.part,
            row.name,
            row.unit,
            row.columns as i64
        ])?;
    }
    Ok(())
}

/// Inserts a row for a group of channels if it is missing; such rows are shared and belong to no operation.
pub(crate) fn ensure_group(connection: &Connection, name: &str) -> CorpusResult<()> {
    let sql = "INSERT OR IGNORE INTO channel_group (name, note) VALUES (?1, ?2)";
    connection.change_rows(sql, [name, "channels of one part of a file"])
}

/// Returns the channels of a track in their order.
pub(crate) fn load_channel_rows(connection: &Connection, track: i64) -> CorpusResult<Vec<ChannelRow>> {
    let sql = "SELECT channel_group, part, name, unit, columns FROM channel
         WHERE track_id = ?1 ORDER BY position";
    connection.read_rows(sql, [track], |row| {
        Ok(ChannelRow {
            group: row.get(0)?,
            part: row.get(1)?,
            name: row.get(2)?,
            unit: row.get(3)?,
            columns: usize::try_from(row.get::<_, i64>(4)?).unwrap_or_default(),
        })
    })
}

/// Returns the row of the track of a recording that has this kind and name.
pub(crate) fn find_named_track(
    connection: &Connection,
    recording: i64,
    kind: TrackKind,
    name: &str,
) -> CorpusResult<Option<i64>> {
    let sql = "SELECT id FROM track WHERE recording_id = ?1 AND kind = ?2 AND name = ?3";
    connection.find_value(sql, params![recording, kind.track_kind_name(), name])
}

/// Returns `name`, or the first of `name 2`, `name 3` … that no track of the recording has.
pub(crate) fn free_track_name(connection: &Connection, recording: i64, name: &str) -> CorpusResult<String> {
    let sql = "SELECT count(*) FROM track WHERE recording_id = ?1 AND name = ?2";
    let mut statement = connection.prepare_cached(sql)?;
    let mut free = name.to_owned();
    let mut count = 1;
    while statement.query_row(params![recording, free], |row| row.get::<_, i64>(0))? > 0 {
        count += 1;
        free = format!("{name} {count}");
    }
    Ok(free)
}

/// Moves a track on the recording's clock.
pub(crate) fn set_offset(connection: &Connection, track: i64, offset_us: i64) -> CorpusResult<()> {
    let sql = "UPDATE track SET offset_us = ?2 WHERE id = ?1 AND offset_us <> ?2";
    connection.change_rows(sql, [track, offset_us])
}

/// Sets the length of a track.
pub(crate) fn set_duration(connection: &Connection, track: i64, duration_us: i64) -> CorpusResult<()> {
    let sql = "UPDATE track SET duration_us = ?2 WHERE id = ?1 AND duration_us IS NOT ?2";
    connection.change_rows(sql, [track, duration_us])
}

/// Sets the time of day of a track's own time 0.
pub(crate) fn set_clock(connection: &Connection, track: i64, clock_us: i64) -> CorpusResult<()> {
    let sql = "UPDATE track SET clock_us = ?2 WHERE id = ?1 AND clock_us IS NOT ?2";
    connection.change_rows(sql, [track, clock_us])
}

/// Gives a track another name.
pub(crate) fn rename_track(connection: &Connection, track: i64, name: &str) -> CorpusResult<()> {
    let sql = "UPDATE track SET name = ?2 WHERE id = ?1 AND name <> ?2";
    connection.change_rows(sql, params![track, name])
}

/// Removes a track with its channels; the blocks stay.
pub(crate) fn remove_track(connection: &Connection, track: i64) -> CorpusResult<()> {
    for sql in [
        "DELETE FROM track_block WHERE track_id = ?1",
        "DELETE FROM channel WHERE track_id = ?1",
        "DELETE FROM track WHERE id = ?1",
    ] {
        connection.change_rows(sql, [track])?;
    }
    Ok(())
}

/// Returns the layouts of tracks of curves with their recording and its signer, oldest first.
pub(crate) fn layouts_of_curves(connection: &Connection) -> CorpusResult<Vec<(i64, Option<i64>, String)>> {
    let sql = "SELECT t.recording_id, r.signer_id, t.layout FROM track t JOIN recording r ON r.id = t.recording_id
         WHERE t.kind = 'curves' AND t.layout IS NOT NULL ORDER BY t.id";
    connection.read_rows(sql, [], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))
}

/// Returns the recording of a track; `None` if the track no longer exists.
pub(crate) fn find_track_recording(connection: &Connection, track: i64) -> CorpusResult<Option<i64>> {
    let mut statement = connection.prepare_cached("SELECT recording_id FROM track WHERE id = ?1")?;
    let mut rows = statement.query_map([track], |row| row.get(0))?;
    Ok(rows.next().transpose()?)
}

/// Returns the signer of each recording that has one.
pub(crate) fn signers_of_recordings(connection: &Connection) -> CorpusResult<BTreeMap<i64, i64>> {
    let sql = "SELECT id, signer_id FROM recording WHERE signer_id IS NOT NULL";
    connection.read_rows(sql, [], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Sets the layout of a skeleton track.
pub(crate) fn set_layout(connection: &Connection, track: i64, layout: &str) -> CorpusResult<()> {
    connection.change_rows("UPDATE track SET layout = ?2 WHERE id = ?1", params![track, layout])
}
