//! Exports of the whole database for people without this program: a compact copy, and single tables as text.

use std::path::Path;

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, params};

use super::open;
use super::stored_motion::to_hex_text;
use crate::error::CorpusResult;

/// The tables that a reader of the data needs, each after those it refers to.
pub(crate) const DUMPED_TABLES: [&str; 27] = [
    "meta",
    "signer",
    "skeleton",
    "recording",
    "source_file",
    "track_kind",
    "track",
    "channel_group",
    "track_block",
    "channel",
    "inventory",
    "inventory_value",
    "tier",
    "annotation",
    "sign",
    "sign_text",
    "token",
    "token_value",
    "notation",
    "attribute",
    "recipe",
    "recipe_input",
    "kept_search",
    "study",
    "study_participant",
    "study_answer",
    "operation",
];

/// Writes a compact copy of the database; the same rows always give the same bytes.
pub(crate) fn copy_database_compactly(connection: &Connection, to: &Path) -> CorpusResult<()> {
    connection.execute("VACUUM INTO ?1", params![to.to_string_lossy()])?;
    Ok(())
}

/// Opens such a copy for reading, which does not change its bytes.
pub(crate) fn read_copy(path: &Path) -> CorpusResult<Connection> {
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let mut connection = Connection::open_with_flags(path, flags)?;
    open::configure_connection(&mut connection)?;
    connection.execute_batch("BEGIN")?;
    Ok(connection)
}

/// Calls `take` with the names of a table's columns, then with each row as text. A null is an empty text, bytes are in
/// hexadecimal, and the bytes of stored files are left out.
pub(crate) fn dump_table_rows(
    connection: &Connection,
    table: &str,
    mut take: impl FnMut(Vec<String>) -> CorpusResult<()>,
) -> CorpusResult<()> {
    let mut statement = connection.prepare(&format!("SELECT * FROM {table} ORDER BY 1"))?;
    let names: Vec<String> = statement.column_names().map(str::to_owned).collect();
    let kept: Vec<usize> = (0..names.len()).filter(|&at| names[at] != "data").collect();
    take(kept.iter().map(|&at| names[at].clone()).collect())?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let mut cells = Vec::with_capacity(kept.len());
        for &at in &kept {
            cells.push(match row.get_ref(at)? {
                ValueRef::Null => String::new(),
                ValueRef::Integer(number) => number.to_string(),
                ValueRef::Real(number) => number.to_string(),
                ValueRef::Text(text) => String::from_utf8_lossy(text).into_owned(),
                ValueRef::Blob(bytes) => to_hex_text(bytes),
            });
        }
        take(cells)?;
    }
    Ok(())
}
