//! Rows for display in a window: many at once, with few columns each.

use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};
use rusqlite::Connection;

use super::stored_columns::{ValueState, read_word_column};
use super::stored_recordings::RecordingRow;
use super::stored_tracks::TrackKind;
use crate::db::cached_sql::CachedSql;
use crate::db::stored_rows::{AnnotationColumns, CurvesAlone, RecordingGlance, SignGlance, TokenNeighbours};
use crate::db::upgrade::NONMANUALS_TRACK_NAME;
use crate::error::CorpusResult;

/// Returns the number of the newest operation; 0 if there is no operation.
pub(crate) fn newest_operation_number(connection: &Connection) -> CorpusResult<i64> {
    let sql = "SELECT coalesce(max(id), 0) FROM operation";
    connection.read_value(sql, [])
}

/// Returns whether the database is open for reading only, for example because the file is write-protected.
pub(crate) fn is_read_only(connection: &Connection) -> CorpusResult<bool> {
    Ok(connection.is_readonly("main")?)
}

/// Returns all recordings in the order in which they were stored.
pub(crate) fn load_recording_glances(connection: &Connection) -> CorpusResult<Vec<RecordingGlance>> {
    // The body is the track of that name, otherwise the oldest skeleton.
    let mut statement = connection.prepare_cached(
        "SELECT r.id, r.name, r.signer_id, g.name, r.origin, r.duration_us, r.licence, r.notes,
                coalesce(k.frames, 0), k.rate_frames, k.rate_seconds, coalesce(k.offset_us, 0),
                (SELECT count(*) FROM tier t WHERE t.recording_id = r.id),
                (SELECT count(*) FROM token t WHERE t.recording_id = r.id),
                (SELECT text FROM recipe p WHERE p.recording_id = r.id),
                (SELECT group_concat(DISTINCT kind) FROM track t WHERE t.recording_id = r.id)
         FROM recording r LEFT JOIN signer g ON g.id = r.signer_id
              LEFT JOIN track k ON k.id = (SELECT id FROM track
                  WHERE recording_id = r.id AND kind = 'skeleton' ORDER BY name <> 'body', id LIMIT 1)
         ORDER BY r.id",
    )?;
    let mut rows = statement.query([])?;
    let mut recordings = Vec::new();
    while let Some(row) = rows.next()? {
        let rate: Option<(u32, u32)> = row.get::<_, Option<u32>>(9)?.zip(row.get(10)?);
        recordings.push(RecordingGlance {
            row: RecordingRow {
                id: row.get(0)?,
                name: row.get(1)?,
                signer_id: row.get(2)?,
                signer: row.get(3)?,
                origin: read_word_column(row, 4)?,
                duration_us: row.get(5)?,
                licence: row.get(6)?,
                notes: row.get(7)?,
            },
            frames: unsigned_row_count(row.get(8)?),
            rate: rate.and_then(|(frames, seconds)| FrameRate::new(frames, seconds).ok()),
            offset_us: row.get(11)?,
            tiers: unsigned_row_count(row.get(12)?),
            tokens: unsigned_row_count(row.get(13)?),
            recipe: row.get(14)?,
            kinds: parse_track_kinds(row.get(15)?),
            face_alone: None,
        });
    }
    Ok(recordings)
}

/// Returns the tracks of curves of recordings without a skeleton, by recording.
pub(crate) fn curves_alone(connection: &Connection) -> CorpusResult<Vec<CurvesAlone>> {
    let sql = "SELECT t.recording_id, (SELECT group_concat(name, char(10)) FROM channel c WHERE c.track_id = t.id),
                coalesce(t.frames, 0), t.rate_frames, t.rate_seconds, t.offset_us, r.duration_us
         FROM track t JOIN recording r ON r.id = t.recording_id
         WHERE t.kind = 'curves' AND t.name <> ?1 AND NOT EXISTS
               (SELECT 1 FROM track k WHERE k.recording_id = t.recording_id AND k.kind = 'skeleton')
         ORDER BY t.recording_id, t.id";
    connection.read_rows(sql, [NONMANUALS_TRACK_NAME], |row| {
        let rate: Option<(u32, u32)> = row.get::<_, Option<u32>>(3)?.zip(row.get(4)?);
        Ok(CurvesAlone {
            recording: row.get(0)?,
            names: row.get::<_, Option<String>>(1)?.unwrap_or_default(),
            frames: unsigned_row_count(row.get(2)?),
            rate: rate.and_then(|(frames, seconds)| FrameRate::new(frames, seconds).ok()),
            offset_us: row.get(5)?,
            duration_us: row.get(6)?,
        })
    })
}

/// Returns the kinds of tracks that a list names, in their usual order.
fn parse_track_kinds(list: Option<String>) -> Vec<TrackKind> {
    let list = list.unwrap_or_default();
    let mut kinds: Vec<TrackKind> = list.split(',').filter_map(|word| word.parse().ok()).collect();
    kinds.sort_unstable();
    kinds
}

/// Returns all signs by gloss.
pub(crate) fn load_sign_glances(connection: &Connection) -> CorpusResult<Vec<SignGlance>> {
    let sql = "SELECT s.id, s.label, s.notes, (SELECT count(*) FROM token t WHERE t.sign_id = s.id),
                c.id, c.recording_id, c.start_us, c.end_us,
                EXISTS (SELECT 1 FROM notation n WHERE n.token_id = c.id),
                (SELECT name FROM lexicon l WHERE l.id = s.lexicon_id)
         FROM sign s LEFT JOIN token c ON c.id =
                (SELECT t.id FROM token t WHERE t.sign_id = s.id AND t.citation = 1
                 ORDER BY t.recording_id IS NULL, t.id LIMIT 1)
         ORDER BY s.gloss, s.homonym, s.id";
    connection.read_rows(sql, [], |row| {
        Ok(SignGlance {
            id: row.get(0)?,
            gloss: row.get(1)?,
            notes: row.get(2)?,
            tokens: unsigned_row_count(row.get(3)?),
            citation: row.get(4)?,
            place: place_from_columns(row.get(5)?, row.get(6)?, row.get(7)?),
            notated: row.get(8)?,
            lexicon: row.get(9)?,
        })
    })
}

fn place_from_columns(recording: Option<i64>, start: Option<i64>, end: Option<i64>) -> Option<(i64, TimeSpan)> {
    let micros = RecordingInstant::from_micros;
    Some((recording?, TimeSpan::span_between(micros(start?), micros(end?))))
}

/// Returns the annotations of a tier, by time.
pub(crate) fn load_annotation_columns(connection: &Connection, tier: i64) -> CorpusResult<AnnotationColumns> {
    let mut statement = connection.prepare_cached(
        "SELECT id, start_us, end_us, state, value, parent_id, confidence FROM annotation
         WHERE tier_id = ?1 ORDER BY start_us, position, id",
    )?;
    let mut rows = statement.query([tier])?;
    let mut columns = AnnotationColumns::default();
    while let Some(row) = rows.next()? {
        columns.ids.push(row.get(0)?);
        columns.starts.push(row.get(1)?);
        columns.ends.push(row.get(2)?);
        columns.states.push(read_word_column::<ValueState>(row, 3)?);
        columns.values.push(row.get::<_, Box<str>>(4)?);
        columns.parents.push(row.get(5)?);
        columns.confidences.push(row.get(6)?);
    }
    Ok(columns)
}

/// Returns the annotations before and after a token on its tier, at most `most` on each side.
pub(crate) fn load_annotations_around(
    connection: &Connection,
    token: i64,
    most: usize,
) -> CorpusResult<TokenNeighbours> {
    let mut around = TokenNeighbours {
        token,
        ..TokenNeighbours::default()
    };
    let place = connection.find_row(
        "SELECT a.id, a.tier_id, a.start_us FROM token t
             JOIN annotation a ON a.id = t.annotation_id WHERE t.id = ?1",
        [token],
        |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)),
    )?;
    let Some((annotation, tier, start)) = place else {
        return Ok(around);
    };
    (around.annotation, around.tier) = (Some(annotation), Some(tier));
    let most = i64::try_from(most).unwrap_or(i64::MAX);
    let read = |sql: &str| -> CorpusResult<Vec<String>> {
        let mut statement = connection.prepare_cached(sql)?;
        let here: (i64, i64, i64, i64) = (tier, start, annotation, most);
        let values = statement.query_map(here, |row| row.get(0))?;
        Ok(values.collect::<rusqlite::Result<_>>()?)
    };
    around.before = read(
        "SELECT value FROM annotation WHERE tier_id = ?1 AND state = 'value'
             AND (start_us < ?2 OR (start_us = ?2 AND id < ?3))
         ORDER BY start_us DESC, id DESC LIMIT ?4",
    )?;
    // The nearest ones were read first, and are wanted in the order of time.
    around.before.reverse();
    around.after = read(
        "SELECT value FROM annotation WHERE tier_id = ?1 AND state = 'value'
             AND (start_us > ?2 OR (start_us = ?2 AND id > ?3))
         ORDER BY start_us, id LIMIT ?4",
    )?;
    Ok(around)
}

fn unsigned_row_count(number: i64) -> u64 {
    u64::try_from(number).unwrap_or_default()
}
