//! The database's own checks for damage.

use rusqlite::Connection;
use sha2::{Digest, Sha256};

use super::motion::hex;
use crate::error::Result;

/// Returns what SQLite finds wrong with the file, at most a hundred lines.
pub(crate) fn integrity(connection: &Connection) -> Result<Vec<String>> {
    let mut statement = connection.prepare("PRAGMA integrity_check(100)")?;
    let lines = statement
        .query_map([], |row| row.get::<_, String>(0))?
        .collect::<rusqlite::Result<Vec<_>>>()?;
    Ok(lines.into_iter().filter(|line| line != "ok").collect())
}

/// Returns the rows with references to missing rows, as table, row and table referred to.
pub(crate) fn broken_references(connection: &Connection) -> Result<Vec<(String, i64, String)>> {
    let mut statement = connection.prepare("PRAGMA foreign_key_check")?;
    let rows = statement
        .query_map([], |row| {
            Ok((
                row.get(0)?,
                row.get::<_, Option<i64>>(1)?.unwrap_or_default(),
                row.get(2)?,
            ))
        })?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}

/// Calls `take` with every block's name, and whether its bytes are those it is named after.
pub(crate) fn blocks(
    connection: &Connection,
    mut take: impl FnMut(String, bool) -> Result<()>,
) -> Result<()> {
    let mut statement = connection.prepare("SELECT hash, data FROM block")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let hash = row.get_ref(0)?.as_blob().map_err(rusqlite::Error::from)?;
        let data = row.get_ref(1)?.as_blob().map_err(rusqlite::Error::from)?;
        take(hex(hash), Sha256::digest(data).as_slice() == hash)?;
    }
    Ok(())
}

/// Returns the row, document and content hash of every skeleton.
pub(crate) fn skeletons(connection: &Connection) -> Result<Vec<(i64, String, String)>> {
    let mut statement =
        connection.prepare("SELECT id, document, hash FROM skeleton ORDER BY id")?;
    let rows = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}

/// Returns how many tokens there are.
pub(crate) fn tokens(connection: &Connection) -> Result<i64> {
    Ok(connection.query_row("SELECT count(*) FROM token", [], |row| row.get(0))?)
}

/// Returns the number of row changes that the running operation has recorded so far.
pub(crate) fn changes(connection: &Connection) -> Result<i64> {
    Ok(connection.query_row("SELECT count(*) FROM temp.change", [], |row| row.get(0))?)
}

/// Runs `work`, rolls its changes back, and returns its result.
pub(crate) fn tried<T>(connection: &Connection, work: impl FnOnce() -> Result<T>) -> Result<T> {
    connection.execute_batch("SAVEPOINT tried")?;
    let done = work();
    connection.execute_batch("ROLLBACK TO tried; RELEASE tried")?;
    done
}
