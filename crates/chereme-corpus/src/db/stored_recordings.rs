//! Rows of signers, skeletons, recordings and their tracks.

use std::collections::BTreeMap;
use std::io::Read;

use chereme_formats::roles::TierMapping;
use rusqlite::{Connection, Row, params};
use serde::Serialize;
use serde_json::json;
use sha2::{Digest as _, Sha256};

use super::damaged_row_error;
use super::people::{self, SIGNER_ROWS_SQL};
use super::stored_columns::{NamedColumn, RecordOrigin, read_word_column};
use super::stored_motion::to_hex_text;
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

const LARGEST_SOURCE: u64 = 1 << 30;

/// A signer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SignerRow {
    /// The row.
    pub id: i64,
    /// The name.
    pub name: String,
    /// `right`, `left`, or `None` if unknown.
    pub handedness: Option<String>,
    /// Remarks.
    pub notes: Option<String>,
}

/// A recording: one take, captured or generated.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct RecordingRow {
    /// The row.
    pub id: i64,
    /// The name, which no other recording of the corpus has.
    pub name: String,
    /// The signer's row.
    pub signer_id: Option<i64>,
    /// The signer's name.
    pub signer: Option<String>,
    /// Its origin.
    pub origin: RecordOrigin,
    /// The length in microseconds.
    pub duration_us: i64,
    /// The terms under which it may be used.
    pub licence: Option<String>,
    /// Remarks.
    pub notes: Option<String>,
}

/// A track of a recording that holds a skeleton's movement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct MotionTrackRow {
    /// The row.
    pub id: i64,
    /// The recording's row.
    pub recording_id: i64,
    /// The name within the recording.
    pub name: String,
    /// Where it starts on the recording's clock, in microseconds.
    pub offset_us: i64,
    /// The skeleton's row.
    pub skeleton_id: i64,
    /// How many frames it has.
    pub frames: i64,
    /// Frames in [`rate_seconds`](Self::rate_seconds).
    pub rate_frames: u32,
    /// Seconds that [`rate_frames`](Self::rate_frames) take.
    pub rate_seconds: u32,
    /// The frame time as written in the file.
    pub frame_time: Option<String>,
    /// The length of one unit of the file in metres.
    pub metres_per_unit: f64,
    /// The file's axes, as `up,left`.
    pub axes: String,
    /// The actual order of the root's columns, if the header states a wrong one.
    pub root_order: Option<String>,
    /// The factor for the root's positions, if their unit differs from that of the bones.
    pub root_scale: Option<f64>,
    /// Joint roles that a person set, as JSON.
    pub roles: Option<String>,
    /// The assignment of joints to channel groups, as JSON.
    pub channel_groups: String,
}

/// A media track of a recording: a file beside the corpus.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MediaTrackRow {
    /// The row.
    pub id: i64,
    /// The recording's row.
    pub recording_id: i64,
    /// The name within the recording.
    pub name: String,
    /// Where it starts on the recording's clock, in microseconds.
    pub offset_us: i64,
    /// The location of the file as the annotation file states it.
    pub url: String,
    /// Its media type.
    pub media_type: Option<String>,
    /// The folders from which films of its recording were imported, relative to the corpus's folder, newest first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub imported: Vec<String>,
}

/// Returns the row of the signer called `name`, and inserts it if it is missing.
pub(crate) fn signer_named(connection: &Connection, name: &str, handedness: Option<&str>) -> CorpusResult<i64> {
    if let Some(signer) = find_signer(connection, name)? {
        return Ok(signer.id);
    }
    let sql = "INSERT INTO signer (name, handedness) VALUES (?1, ?2)";
    connection.insert_row(sql, params![name, handedness])
}

/// Returns the person called `name`, or else the one of whom that is another name.
pub(crate) fn find_signer(connection: &Connection, name: &str) -> CorpusResult<Option<SignerRow>> {
    let sql = "SELECT id, name, handedness, notes FROM signer WHERE name = ?1";
    let person = connection.find_row(sql, [name], signer_row)?;
    match person {
        Some(person) => Ok(Some(person)),
        None => match people::find_person_by_alias(connection, name)? {
            Some(id) => find_signer_row(connection, id),
            None => Ok(None),
        },
    }
}

/// Returns the signer of that row.
pub(crate) fn find_signer_row(connection: &Connection, id: i64) -> CorpusResult<Option<SignerRow>> {
    let sql = "SELECT id, name, handedness, notes FROM signer WHERE id = ?1";
    connection.find_row(sql, [id], signer_row)
}

/// Returns all signers by name, without people who only annotate.
pub(crate) fn load_signer_rows(connection: &Connection) -> CorpusResult<Vec<SignerRow>> {
    let sql = format!("SELECT id, name, handedness, notes FROM {SIGNER_ROWS_SQL} ORDER BY name");
    connection.read_rows(&sql, [], signer_row)
}

fn signer_row(row: &Row<'_>) -> rusqlite::Result<SignerRow> {
    Ok(SignerRow {
        id: row.get(0)?,
        name: row.get(1)?,
        handedness: row.get(2)?,
        notes: row.get(3)?,
    })
}

/// Returns the row of the skeleton with this content hash, and inserts it with `document` if it is missing.
pub(crate) fn skeleton_stored(connection: &Connection, hash: &str, joints: usize, document: &str) -> CorpusResult<i64> {
    let skeleton_id = connection.find_value("SELECT id FROM skeleton WHERE hash = ?1", [hash])?;
    if let Some(id) = skeleton_id {
        return Ok(id);
    }
    let sql = "INSERT INTO skeleton (hash, joints, document) VALUES (?1, ?2, ?3)";
    connection.insert_row(sql, params![hash, joints as i64, document])
}

/// Gives a track another skeleton, and deletes the previous one if no track uses it any more.
pub(crate) fn set_skeleton(connection: &Connection, track: i64, skeleton: i64) -> CorpusResult<()> {
    let former: i64 = connection.read_value("SELECT skeleton_id FROM track WHERE id = ?1", [track])?;
    if former == skeleton {
        return Ok(());
    }
    connection.change_rows("UPDATE track SET skeleton_id = ?2 WHERE id = ?1", [track, skeleton])?;
    let sql = "DELETE FROM skeleton WHERE id = ?1
             AND NOT EXISTS (SELECT 1 FROM track WHERE skeleton_id = ?1)";
    connection.change_rows(sql, [former])
}

/// Returns the document of a skeleton.
pub(crate) fn skeleton_document(connection: &Connection, id: i64) -> CorpusResult<String> {
    connection.read_value("SELECT document FROM skeleton WHERE id = ?1", [id])
}

/// Writes a recording and returns its row; its `id` and `signer` are not used. The glosses of its tiers are looked up in
/// the corpus's lexicon, if there is only one.
pub(crate) fn insert_recording(connection: &Connection, row: &RecordingRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO recording (name, signer_id, origin, duration_us, licence, notes, lexicon_id)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, (SELECT CASE count(*) WHEN 1 THEN min(id) END FROM lexicon))";
    let values = params![
        row.name,
        row.signer_id,
        NamedColumn(row.origin),
        row.duration_us,
        row.licence,
        row.notes
    ];
    connection.insert_row(sql, values)
}

const SELECT_RECORDING_SQL: &str = "
    SELECT r.id, r.name, r.signer_id, s.name, r.origin, r.duration_us,
           r.licence, r.notes
    FROM recording r LEFT JOIN signer s ON s.id = r.signer_id";

fn recording_row(row: &Row<'_>) -> rusqlite::Result<RecordingRow> {
    Ok(RecordingRow {
        id: row.get(0)?,
        name: row.get(1)?,
        signer_id: row.get(2)?,
        signer: row.get(3)?,
        origin: read_word_column(row, 4)?,
        duration_us: row.get(5)?,
        licence: row.get(6)?,
        notes: row.get(7)?,
    })
}

/// Returns the recording of that row.
pub(crate) fn load_recording_row(connection: &Connection, id: i64) -> CorpusResult<RecordingRow> {
    connection
        .find_row(&format!("{SELECT_RECORDING_SQL} WHERE r.id = ?1"), [id], recording_row)?
        .ok_or_else(|| {
            CorpusError::from_wrong_message(format!("there is no recording:{id}"))
                .with_error_place(format!("recording:{id}"))
                .with_command_advice("`chereme list CORPUS recordings` lists them")
        })
}

/// Returns the recording of that name.
pub(crate) fn recording_named(connection: &Connection, name: &str) -> CorpusResult<Option<RecordingRow>> {
    let sql = format!("{SELECT_RECORDING_SQL} WHERE r.name = ?1");
    connection.find_row(&sql, [name], recording_row)
}

/// A file that rows came from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct SourceFileRow {
    /// The row.
    pub id: i64,
    /// The recording that it describes.
    pub recording_id: Option<i64>,
    /// The kind of file, such as `bvh`, `eaf`, `lexicon`, `inventory` or `sigml`.
    pub kind: String,
    /// The file's name, without its folder.
    pub name: String,
    /// Its original path, relative to the folder of the corpus; nothing in corpora of earlier versions.
    pub path: Option<String>,
    /// The SHA-256 of the file, in hexadecimal.
    pub hash: String,
}

/// The kinds of files that hold a capture of any sort: movement, points, curves, a film.
pub(crate) const CAPTURE_FILE_KINDS: [&str; 9] = [
    "bvh",
    "gltf",
    "fbx",
    "c3d",
    "trc",
    "pose",
    "curves",
    "table of points",
    "film",
];

impl SourceFileRow {
    /// Returns whether the file holds a capture.
    pub(crate) fn is_capture(&self) -> bool {
        CAPTURE_FILE_KINDS.contains(&self.kind.as_str())
    }
}

/// Records a file that rows came from, with its bytes if they are to be stored, and returns its row.
pub(crate) fn insert_source_file(
    connection: &Connection,
    row: &SourceFileRow,
    bytes: Option<&[u8]>,
) -> CorpusResult<i64> {
    let encoded = bytes.map(|bytes| zstd::encode_all(bytes, 9)).transpose();
    let data = encoded.map_err(|error| CorpusError::from_file_failure(&row.name, error))?;
    let sql = "INSERT INTO source_file (recording_id, kind, name, path, hash, data)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
    connection.insert_row(
        sql,
        params![row.recording_id, row.kind, row.name, row.path, row.hash, data],
    )
}

/// Returns the files of a recording, oldest first.
pub(crate) fn source_files(connection: &Connection, recording: i64) -> CorpusResult<Vec<SourceFileRow>> {
    source_files_where(connection, "recording_id = ?1", recording)
}

/// Returns the files with these bytes, oldest first.
pub(crate) fn source_files_of_hash(connection: &Connection, hash: &str) -> CorpusResult<Vec<SourceFileRow>> {
    source_files_where(connection, "hash = ?1", hash)
}

/// Returns all files, oldest first.
pub(crate) fn all_source_files(connection: &Connection) -> CorpusResult<Vec<SourceFileRow>> {
    source_files_where(connection, "id > ?1", 0)
}

fn source_files_where(
    connection: &Connection,
    condition: &str,
    value: impl rusqlite::ToSql,
) -> CorpusResult<Vec<SourceFileRow>> {
    let sql = format!(
        "SELECT id, recording_id, kind, name, path, hash FROM source_file
         WHERE {condition} ORDER BY id"
    );
    connection.read_rows(&sql, [value], source_file_row)
}

fn source_file_row(row: &Row<'_>) -> rusqlite::Result<SourceFileRow> {
    Ok(SourceFileRow {
        id: row.get(0)?,
        recording_id: row.get(1)?,
        kind: row.get(2)?,
        name: row.get(3)?,
        path: row.get(4)?,
        hash: row.get(5)?,
    })
}

/// Returns the newest version of each lexicon table whose bytes are stored, oldest first.
pub(crate) fn lexicon_files(connection: &Connection) -> CorpusResult<Vec<SourceFileRow>> {
    let mut rows = source_files_where(connection, "data IS NOT NULL AND kind = ?1", "lexicon")?;
    let place = |row: &SourceFileRow| row.path.clone().unwrap_or_else(|| row.name.clone());
    // Rows come oldest first, so that the newest of each place is the one that remains in the map.
    let newest: BTreeMap<String, i64> = rows.iter().map(|row| (place(row), row.id)).collect();
    rows.retain(|row| newest.get(&place(row)) == Some(&row.id));
    Ok(rows)
}

/// Stores the meanings of a table's columns that a user's mapping named, by title.
pub(crate) fn set_source_mapping(
    connection: &Connection,
    id: i64,
    columns: &BTreeMap<String, String>,
) -> CorpusResult<()> {
    let text = (!columns.is_empty()).then(|| json!({ "columns": columns }).to_string());
    let sql = "UPDATE source_file SET mapping = ?2 WHERE id = ?1 AND mapping IS NOT ?2";
    connection.change_rows(sql, params![id, text])
}

/// Returns the mapping with which a stored table is read, if the user gave one.
pub(crate) fn source_mapping(connection: &Connection, id: i64) -> CorpusResult<Option<TierMapping>> {
    let text: Option<String> = connection.read_value("SELECT mapping FROM source_file WHERE id = ?1", [id])?;
    let read = text.map(|text| TierMapping::from_json(&text)).transpose();
    read.map_err(|error| damaged_row_error(format!("source_file {id}"), error.to_string()))
}

/// Returns the bytes of a stored file, which match its hash.
pub(crate) fn source_bytes(connection: &Connection, id: i64) -> CorpusResult<Option<Vec<u8>>> {
    let (data, name, hash): (Option<Vec<u8>>, String, String) =
        connection.read_row("SELECT data, name, hash FROM source_file WHERE id = ?1", [id], |row| {
            Ok((row.get(0)?, row.get(1)?, row.get(2)?))
        })?;
    let Some(data) = data else { return Ok(None) };
    let fault = |reason: String| damaged_row_error(format!("the stored file {name:?}"), reason);
    let mut bytes = Vec::new();
    // A few damaged bytes could decompress into more than any memory holds.
    let read =
        zstd::Decoder::new(data.as_slice()).and_then(|reader| reader.take(LARGEST_SOURCE).read_to_end(&mut bytes));
    read.map_err(|error| fault(error.to_string()))?;
    if to_hex_text(&Sha256::digest(&bytes)) != hash {
        return Err(fault("its bytes do not match its hash".to_owned()));
    }
    Ok(Some(bytes))
}

/// Returns all recordings, oldest first.
pub(crate) fn load_recording_rows(connection: &Connection) -> CorpusResult<Vec<RecordingRow>> {
    connection.read_rows(&format!("{SELECT_RECORDING_SQL} ORDER BY r.id"), [], recording_row)
}

/// Makes the recording at least `micros` long.
pub(crate) fn lengthen_recording(connection: &Connection, recording: i64, micros: i64) -> CorpusResult<()> {
    let sql = "UPDATE recording SET duration_us = ?2 WHERE id = ?1 AND duration_us < ?2";
    connection.change_rows(sql, [recording, micros])
}

/// Writes a motion track and returns its row; its `id` is not used.
pub(crate) fn insert_motion_track(connection: &Connection, row: &MotionTrackRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO track (recording_id, kind, name, offset_us, skeleton_id, frames,
                 rate_frames, rate_seconds, frame_time, metres_per_unit, axes, root_order, roles,
                 channel_groups, root_scale, duration_us)
             VALUES (?1, 'skeleton', ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14,
                 CAST(round(?5 * 1000000.0 * ?7 / ?6) AS INTEGER))";
    let values = params![
        row.recording_id,
        row.name,
        row.offset_us,
        row.skeleton_id,
        row.frames,
        row.rate_frames,
        row.rate_seconds,
        row.frame_time,
        row.metres_per_unit,
        row.axes,
        row.root_order,
        row.roles,
        row.channel_groups,
        row.root_scale
    ];
    connection.insert_row(sql, values)
}

/// Removes a recording's movement and sets the length and signer of the movement that replaces it; the blocks stay.
pub(crate) fn clear_motion(
    connection: &Connection,
    recording: i64,
    duration_us: i64,
    signer: Option<i64>,
) -> CorpusResult<()> {
    let track_query = "SELECT id FROM track WHERE recording_id = ?1
         AND (kind = 'skeleton' OR (kind = 'curves' AND name = 'nonmanuals'))";
    for sql in [
        format!("DELETE FROM track_block WHERE track_id IN ({track_query})"),
        format!("DELETE FROM channel WHERE track_id IN ({track_query})"),
        format!("DELETE FROM track WHERE id IN ({track_query})"),
    ] {
        connection.change_rows(&sql, [recording])?;
    }
    connection.change_rows(
        "UPDATE recording SET duration_us = ?2, signer_id = ?3 WHERE id = ?1",
        params![recording, duration_us, signer],
    )
}

/// Sets the number of frames of a track, and its length accordingly.
pub(crate) fn set_frames(connection: &Connection, track: i64, frames: i64) -> CorpusResult<()> {
    let sql = "UPDATE track SET frames = ?2, duration_us =
                 CAST(round(?2 * 1000000.0 * rate_seconds / rate_frames) AS INTEGER) WHERE id = ?1";
    connection.change_rows(sql, [track, frames])
}

/// Returns the track of a recording's body: the skeleton track called `body`, otherwise the oldest skeleton track.
pub(crate) fn body_track(connection: &Connection, recording: i64) -> CorpusResult<Option<MotionTrackRow>> {
    let sql =
        format!("{MOTION_TRACK} WHERE recording_id = ?1 AND kind = 'skeleton' ORDER BY name <> 'body', id LIMIT 1");
    connection.find_row(&sql, [recording], motion_track_row)
}

/// Returns the skeleton track of that row.
pub(crate) fn skeleton_track(connection: &Connection, track: i64) -> CorpusResult<Option<MotionTrackRow>> {
    let sql = format!("{MOTION_TRACK} WHERE id = ?1 AND kind = 'skeleton'");
    connection.find_row(&sql, [track], motion_track_row)
}

const MOTION_TRACK: &str = "
    SELECT id, recording_id, name, offset_us, skeleton_id, frames, rate_frames, rate_seconds,
           frame_time, metres_per_unit, axes, root_order, roles, channel_groups, root_scale
    FROM track";

fn motion_track_row(row: &Row<'_>) -> rusqlite::Result<MotionTrackRow> {
    Ok(MotionTrackRow {
        id: row.get(0)?,
        recording_id: row.get(1)?,
        name: row.get(2)?,
        offset_us: row.get(3)?,
        skeleton_id: row.get(4)?,
        frames: row.get(5)?,
        rate_frames: row.get(6)?,
        rate_seconds: row.get(7)?,
        frame_time: row.get(8)?,
        metres_per_unit: row.get(9)?,
        axes: row.get(10)?,
        root_order: row.get(11)?,
        roles: row.get(12)?,
        channel_groups: row.get(13)?,
        root_scale: row.get(14)?,
    })
}

/// Writes a media track and returns its row; the `id` given is not used.
pub(crate) fn insert_media_track(connection: &Connection, row: &MediaTrackRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO track (recording_id, kind, name, offset_us, media_url, media_type)
             VALUES (?1, 'media', ?2, ?3, ?4, ?5)";
    connection.insert_row(
        sql,
        params![row.recording_id, row.name, row.offset_us, row.url, row.media_type],
    )
}

/// Sets the location of a media track's file.
pub(crate) fn move_media_track(connection: &Connection, track: i64, url: &str) -> CorpusResult<()> {
    let sql = "UPDATE track SET media_url = ?2 WHERE id = ?1 AND kind = 'media'";
    connection.change_rows(sql, params![track, url])
}

/// Removes a media track.
pub(crate) fn remove_media_track(connection: &Connection, track: i64) -> CorpusResult<()> {
    connection.change_rows("DELETE FROM track WHERE id = ?1 AND kind = 'media'", [track])
}

/// Returns the media tracks of a recording.
pub(crate) fn media_tracks(connection: &Connection, recording: i64) -> CorpusResult<Vec<MediaTrackRow>> {
    let mut statement = connection.prepare_cached(
        "SELECT id, recording_id, name, offset_us, media_url, media_type
         FROM track WHERE recording_id = ?1 AND kind = 'media' ORDER BY id",
    )?;
    let files = source_files(connection, recording)?.into_iter().rev();
    let films = files.filter(|file| file.kind == "film");
    let imported: Vec<String> = films.filter_map(|film| film.path).collect();
    let rows = statement
        .query_map([recording], |row| {
            Ok(MediaTrackRow {
                imported: imported.clone(),
                id: row.get(0)?,
                recording_id: row.get(1)?,
                name: row.get(2)?,
                offset_us: row.get(3)?,
                url: row.get(4)?,
                media_type: row.get(5)?,
            })
        })?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}

/// Sets signer, origin and licence of a recording; nothing leaves a field unchanged.
pub(crate) fn set_recording_description(
    connection: &Connection,
    recording: i64,
    signer: Option<i64>,
    origin: Option<RecordOrigin>,
    licence: Option<&str>,
) -> CorpusResult<()> {
    let sql = "UPDATE recording SET signer_id = coalesce(?2, signer_id), origin = coalesce(?3, origin),
                 licence = coalesce(?4, licence)
             WHERE id = ?1 AND (signer_id IS NOT coalesce(?2, signer_id)
                 OR origin <> coalesce(?3, origin) OR licence IS NOT coalesce(?4, licence))";
    connection.change_rows(sql, params![recording, signer, origin.map(NamedColumn), licence])
}

/// Sets the actual order of the root's columns of a track, and the factor for their unit.
pub(crate) fn set_root(
    connection: &Connection,
    track: i64,
    order: Option<&str>,
    scale: Option<f64>,
) -> CorpusResult<()> {
    let sql = "UPDATE track SET root_order = ?2, root_scale = ?3 WHERE id = ?1";
    connection.change_rows(sql, params![track, order, scale])
}

/// Writes again how a motion track's numbers are read: unit, axes, root, joint roles and channel groups.
pub(crate) fn update_reading(connection: &Connection, row: &MotionTrackRow) -> CorpusResult<()> {
    let sql = "UPDATE track SET metres_per_unit = ?2, axes = ?3, root_order = ?4, root_scale = ?5, roles = ?6,
                 channel_groups = ?7
             WHERE id = ?1";
    let values = params![
        row.id,
        row.metres_per_unit,
        row.axes,
        row.root_order,
        row.root_scale,
        row.roles,
        row.channel_groups
    ];
    connection.change_rows(sql, values)
}

/// Returns `name`, or the first of `name (2)`, `name (3)` … that no recording has.
pub(crate) fn free_recording_name(connection: &Connection, name: &str) -> CorpusResult<String> {
    let mut free = name.to_owned();
    let mut count = 1;
    while recording_named(connection, &free)?.is_some() {
        count += 1;
        free = format!("{name} ({count})");
    }
    Ok(free)
}
