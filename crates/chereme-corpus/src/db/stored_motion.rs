//! Rows of motion: blocks named by their content, and the frames and tracks that they hold.

use std::ops::Range;

use rusqlite::{Connection, params};
use sha2::{Digest, Sha256};

use super::stored_tracks::{self, TrackKind};
use super::upgrade::NONMANUALS_TRACK_NAME;
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// One stored block of a track.
pub(crate) struct BlockRow {
    pub(crate) first_frame: usize,
    pub(crate) frames: usize,
    pub(crate) hash: Vec<u8>,
    pub(crate) data: Vec<u8>,
}

/// Stores `data` as one block of a track's channel group, with `frames` frames from `first_frame` on.
pub(crate) fn insert_block(
    connection: &Connection,
    track: i64,
    group: &str,
    first_frame: usize,
    frames: usize,
    data: &[u8],
) -> CorpusResult<()> {
    let hash = insert_bytes(connection, data)?;
    stored_tracks::ensure_group(connection, group)?;
    let sql = "INSERT INTO track_block (track_id, channel_group, first_frame, frames, hash)
             VALUES (?1, ?2, ?3, ?4, ?5)";
    connection.change_rows(sql, params![track, group, first_frame as i64, frames as i64, hash])
}

/// Removes the blocks of a track; their bytes stay.
pub(crate) fn remove_blocks(connection: &Connection, track: i64) -> CorpusResult<()> {
    connection.change_rows("DELETE FROM track_block WHERE track_id = ?1", [track])
}

/// Stores the bytes of a block unless they are stored already, and returns its name.
fn insert_bytes(connection: &Connection, data: &[u8]) -> CorpusResult<Vec<u8>> {
    // Blocks are named by their content, so that equal movement is stored once.
    let hash = Sha256::digest(data).to_vec();
    let sql = "INSERT OR IGNORE INTO block (hash, data) VALUES (?1, ?2)";
    connection.change_rows(sql, params![hash, data])?;
    Ok(hash)
}

/// Calls `take` with the blocks of one channel group that hold any of `frames`, in order.
pub(crate) fn visit_track_blocks(
    connection: &Connection,
    track: i64,
    group: &str,
    frames: &Range<usize>,
    mut take: impl FnMut(BlockRow) -> CorpusResult<()>,
) -> CorpusResult<()> {
    // The block that holds the first frame begins before it: the last one that does not begin after it.
    let sql = "SELECT t.first_frame, t.frames, t.hash, b.data
         FROM track_block t JOIN block b ON b.hash = t.hash
         WHERE t.track_id = ?1 AND t.channel_group = ?2 AND t.first_frame < ?4
           AND t.first_frame >= coalesce((
               SELECT max(first_frame) FROM track_block
               WHERE track_id = ?1 AND channel_group = ?2 AND first_frame <= ?3), 0)
         ORDER BY t.first_frame";
    connection.visit_rows(
        sql,
        params![track, group, frames.start as i64, frames.end as i64],
        |row| {
            take(BlockRow {
                first_frame: usize::try_from(row.get::<_, i64>(0)?).unwrap_or(usize::MAX),
                frames: usize::try_from(row.get::<_, i64>(1)?).unwrap_or(usize::MAX),
                hash: row.get(2)?,
                data: row.get(3)?,
            })?;
            Ok(())
        },
    )
}

/// Returns the SHA-256 of the names of a track's blocks and of its curves, if it has any: the content hash of its
/// movement.
pub(crate) fn content_hash(connection: &Connection, track: i64) -> CorpusResult<String> {
    let mut statement = connection.prepare_cached(
        "SELECT channel_group, first_frame, hash FROM track_block WHERE track_id = ?1
         ORDER BY channel_group, first_frame",
    )?;
    let mut rows = statement.query([track])?;
    let mut digest = Sha256::new();
    while let Some(row) = rows.next()? {
        digest.update(row.get_ref(0)?.as_bytes().unwrap_or_default());
        digest.update(row.get::<_, i64>(1)?.to_le_bytes());
        digest.update(row.get_ref(2)?.as_blob().unwrap_or_default());
    }
    digest_nonmanuals(connection, track, &mut digest)?;
    Ok(to_hex_text(&digest.finalize()))
}

/// Returns the SHA-256 of the names of a track's channels and blocks: the content hash of the track.
pub(crate) fn track_hash(connection: &Connection, track: i64) -> CorpusResult<String> {
    let mut digest = Sha256::new();
    digest_track(connection, track, &mut digest)?;
    Ok(to_hex_text(&digest.finalize()))
}

/// Adds the names of the scalar curves that accompany a movement, and of their blocks, to a digest.
fn digest_nonmanuals(connection: &Connection, track: i64, digest: &mut Sha256) -> CorpusResult<()> {
    if let Some(curves) = find_nonmanual_track(connection, track)? {
        digest_track(connection, curves, digest)?;
    }
    let sql = "SELECT c.id FROM track c JOIN track t ON t.recording_id = c.recording_id
               WHERE t.id = ?1 AND c.kind = 'curves' AND c.name <> ?2 ORDER BY c.id";
    let mut statement = connection.prepare_cached(sql)?;
    let others = statement.query_map(params![track, NONMANUALS_TRACK_NAME], |row| row.get(0))?;
    for other in others.collect::<rusqlite::Result<Vec<i64>>>()? {
        digest_track(connection, other, digest)?;
    }
    Ok(())
}

fn digest_track(connection: &Connection, curves: i64, digest: &mut Sha256) -> CorpusResult<()> {
    for channel in stored_tracks::load_channel_rows(connection, curves)? {
        digest.update(channel.name.as_bytes());
        // A zero ends each name, so that two names cannot run into one.
        digest.update([0]);
    }
    let sql = "SELECT hash FROM track_block WHERE track_id = ?1 ORDER BY channel_group, first_frame";
    connection.visit_rows(sql, [curves], |row| {
        digest.update(row.get_ref(0)?.as_blob().unwrap_or_default());
        Ok(())
    })
}

/// Returns the row of the track of non-manuals that accompanies a movement's track.
pub(crate) fn find_nonmanual_track(connection: &Connection, track: i64) -> CorpusResult<Option<i64>> {
    let sql = "SELECT recording_id FROM track WHERE id = ?1";
    let recording: i64 = connection.read_value(sql, [track])?;
    stored_tracks::find_named_track(connection, recording, TrackKind::Curves, NONMANUALS_TRACK_NAME)
}

/// Returns bytes in hexadecimal.
pub(crate) fn to_hex_text(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
