//! Rows of scalar curves: their names, and which block holds which frames of them.

use std::ops::Range;

use rusqlite::{Connection, params};
use sha2::{Digest, Sha256};

use super::motion::{BlockRow, insert_bytes};
use crate::error::Result;

/// Stores the names of a track's curves, in this order.
pub(crate) fn insert_names(connection: &Connection, track: i64, names: &[&str]) -> Result<()> {
    let mut statement = connection
        .prepare_cached("INSERT INTO curve (track_id, position, name) VALUES (?1, ?2, ?3)")?;
    for (position, name) in names.iter().enumerate() {
        statement.execute(params![track, position as i64, name])?;
    }
    Ok(())
}

/// Returns the names of a track's curves in their order.
pub(crate) fn names(connection: &Connection, track: i64) -> Result<Vec<String>> {
    let sql = "SELECT name FROM curve WHERE track_id = ?1 ORDER BY position";
    let mut statement = connection.prepare_cached(sql)?;
    let names = statement
        .query_map([track], |row| row.get(0))?
        .collect::<rusqlite::Result<_>>()?;
    Ok(names)
}

/// Stores `data` as `frames` frames from `first_frame` on of all of a track's curves.
pub(crate) fn insert_block(
    connection: &Connection,
    track: i64,
    first_frame: usize,
    frames: usize,
    data: &[u8],
) -> Result<()> {
    let hash = insert_bytes(connection, data)?;
    connection
        .prepare_cached(
            "INSERT INTO curve_block (track_id, first_frame, frames, hash) VALUES (?1, ?2, ?3, ?4)",
        )?
        .execute(params![track, first_frame as i64, frames as i64, hash])?;
    Ok(())
}

/// Returns the blocks of a track's curves that hold any of `frames`, in order.
pub(crate) fn blocks(
    connection: &Connection,
    track: i64,
    frames: &Range<usize>,
) -> Result<Vec<BlockRow>> {
    let mut statement = connection.prepare_cached(
        "SELECT c.first_frame, c.frames, c.hash, b.data
         FROM curve_block c JOIN block b ON b.hash = c.hash
         WHERE c.track_id = ?1 AND c.first_frame < ?3 AND c.first_frame + c.frames > ?2
         ORDER BY c.first_frame",
    )?;
    let rows = statement
        .query_map(
            params![track, frames.start as i64, frames.end as i64],
            |row| {
                Ok(BlockRow {
                    first_frame: usize::try_from(row.get::<_, i64>(0)?).unwrap_or(usize::MAX),
                    frames: usize::try_from(row.get::<_, i64>(1)?).unwrap_or(usize::MAX),
                    hash: row.get(2)?,
                    data: row.get(3)?,
                })
            },
        )?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}

/// Puts the names of a track's curves and of their blocks into a digest; nothing where it has none.
pub(crate) fn digest(connection: &Connection, track: i64, digest: &mut Sha256) -> Result<()> {
    let names = names(connection, track)?;
    if names.is_empty() {
        return Ok(());
    }
    for name in names {
        digest.update(name.as_bytes());
        digest.update([0]);
    }
    let sql = "SELECT hash FROM curve_block WHERE track_id = ?1 ORDER BY first_frame";
    let mut statement = connection.prepare_cached(sql)?;
    let mut rows = statement.query([track])?;
    while let Some(row) = rows.next()? {
        digest.update(row.get_ref(0)?.as_blob().unwrap_or_default());
    }
    Ok(())
}
