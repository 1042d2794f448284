//! The database's own checks for damage.

use std::collections::BTreeSet;

use rusqlite::{Connection, ErrorCode, OptionalExtension as _};
use sha2::{Digest, Sha256};

use super::stored_motion::to_hex_text;
use crate::error::CorpusResult;

/// Returns what SQLite finds wrong with the file, at most a hundred lines.
pub(crate) fn check_sqlite_integrity(connection: &Connection) -> CorpusResult<Vec<String>> {
    let mut statement = connection.prepare("PRAGMA integrity_check(100)")?;
    let lines = statement
        .query_map([], |row| row.get::<_, String>(0))?
        .collect::<rusqlite::Result<Vec<_>>>()?;
    Ok(lines.into_iter().filter(|line| line != "ok").collect())
}

/// A row that breaks a rule of its table.
pub(crate) struct BrokenRow {
    pub(crate) table: String,
    pub(crate) row: i64,
    /// The rule, in words of the database.
    pub(crate) rule: String,
}

/// Returns the rows behind those of SQLite's findings that name only the table of a row.
///
/// Each row of such a table is stored again in an empty table with the same rules, which refuses the broken ones.
pub(crate) fn broken_rows(connection: &Connection, findings: &[String]) -> CorpusResult<Vec<BrokenRow>> {
    let named = findings.iter().filter_map(|line| table_of(line));
    let tables: BTreeSet<&str> = named.collect();
    let mut broken = Vec::new();
    if tables.is_empty() {
        return Ok(broken);
    }
    // The empty table refers to tables that it does not stand beside.
    connection.pragma_update(None, "foreign_keys", false)?;
    let outcome = tables
        .into_iter()
        .try_for_each(|table| add_broken_rows(connection, table, &mut broken));
    connection.pragma_update(None, "foreign_keys", true)?;
    outcome.map(|()| broken)
}

/// Returns the table that a finding about the content of a row names.
pub(crate) fn table_of(finding: &str) -> Option<&str> {
    let (what, place) = finding.rsplit_once(" in ")?;
    let is_of_row = what == "CHECK constraint failed" || what.ends_with(" value");
    is_of_row.then(|| place.split('.').next().unwrap_or(place))
}

fn add_broken_rows(connection: &Connection, table: &str, broken: &mut Vec<BrokenRow>) -> CorpusResult<()> {
    let made: Option<String> = connection
        .prepare("SELECT sql FROM main.sqlite_schema WHERE type = 'table' AND name = ?1")?
        .query_row([table], |row| row.get(0))
        .optional()?;
    // Rows without a number cannot be named one by one.
    let has_rowid = made.as_ref().is_some_and(|sql| !sql.contains("WITHOUT ROWID"));
    let Some((_, rules)) = made.as_ref().and_then(|sql| sql.split_once('(')) else {
        return Ok(());
    };
    if !has_rowid {
        return Ok(());
    }
    connection.execute_batch(&format!("CREATE TEMP TABLE tried_row ({rules}"))?;
    let tried = try_rows(connection, table, broken);
    connection.execute_batch("DROP TABLE temp.tried_row")?;
    tried
}

fn try_rows(connection: &Connection, table: &str, broken: &mut Vec<BrokenRow>) -> CorpusResult<()> {
    let rows: Vec<i64> = connection
        .prepare(&format!("SELECT rowid FROM main.\"{table}\" ORDER BY rowid"))?
        .query_map([], |row| row.get(0))?
        .collect::<rusqlite::Result<_>>()?;
    let mut store = connection.prepare(&format!(
        "INSERT INTO temp.tried_row SELECT * FROM main.\"{table}\" WHERE rowid = ?1"
    ))?;
    let mut clear = connection.prepare("DELETE FROM temp.tried_row")?;
    for row in rows {
        match store.execute([row]) {
            Ok(_) => {}
            Err(rusqlite::Error::SqliteFailure(failure, rule)) if failure.code == ErrorCode::ConstraintViolation => {
                let full_rule = rule.unwrap_or_default();
                let rule = full_rule
                    .strip_prefix("CHECK constraint failed: ")
                    .unwrap_or(&full_rule);
                broken.push(BrokenRow {
                    table: table.to_owned(),
                    row,
                    rule: rule.replace("tried_row", table),
                });
            }
            Err(error) => return Err(error.into()),
        }
        // An earlier row must not count against the uniqueness of a later one.
        clear.execute([])?;
    }
    Ok(())
}

/// Returns the rows with references to missing rows, as table, row and table referred to.
pub(crate) fn broken_references(connection: &Connection) -> CorpusResult<Vec<(String, i64, String)>> {
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
pub(crate) fn check_each_block(
    connection: &Connection,
    mut take: impl FnMut(String, bool) -> CorpusResult<()>,
) -> CorpusResult<()> {
    let mut statement = connection.prepare("SELECT hash, data FROM block")?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let hash = row.get_ref(0)?.as_blob().map_err(rusqlite::Error::from)?;
        let data = row.get_ref(1)?.as_blob().map_err(rusqlite::Error::from)?;
        take(to_hex_text(hash), Sha256::digest(data).as_slice() == hash)?;
    }
    Ok(())
}

/// Returns the row, document and content hash of every skeleton.
pub(crate) fn list_skeleton_documents(connection: &Connection) -> CorpusResult<Vec<(i64, String, String)>> {
    let mut statement = connection.prepare("SELECT id, document, hash FROM skeleton ORDER BY id")?;
    let rows = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)))?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}

/// Returns how many tokens there are.
pub(crate) fn count_all_tokens(connection: &Connection) -> CorpusResult<i64> {
    Ok(connection.query_row("SELECT count(*) FROM token", [], |row| row.get(0))?)
}

/// Returns the number of row changes that the running operation has recorded so far.
pub(crate) fn count_recorded_changes(connection: &Connection) -> CorpusResult<i64> {
    Ok(connection.query_row("SELECT count(*) FROM temp.change", [], |row| row.get(0))?)
}

/// Runs `work`, rolls its changes back, and returns its result.
pub(crate) fn run_and_roll_back<T>(connection: &Connection, work: impl FnOnce() -> CorpusResult<T>) -> CorpusResult<T> {
    connection.execute_batch("SAVEPOINT tried")?;
    let done = work();
    // A savepoint works inside a transaction that is already open, and its end leaves that open.
    connection.execute_batch("ROLLBACK TO tried; RELEASE tried")?;
    done
}
