//! Exports of the whole database for people without this program: a compact copy, and single tables as text.

use std::collections::BTreeSet;
use std::path::Path;

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, params};

use super::consents::ConsentAudience;
use super::stored_motion::to_hex_text;
use super::{open, seals, stored_delete, stored_search, token_marks};
use crate::error::{CorpusError, CorpusResult};

/// The tables that a reader of the data needs, each after those it refers to.
pub(crate) const DUMPED_TABLES: [&str; 32] = [
    "meta",
    "lexicon",
    "signer",
    "person_alias",
    "person_attribute",
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
    "relation_kind",
    "sign_relation",
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

/// The rows that a copy for others does without.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OmittedRows<'a> {
    /// Recordings, with everything that belongs to them.
    pub(crate) recordings: &'a BTreeSet<i64>,
    /// Whether the history goes, with all that was deleted.
    pub(crate) history: bool,
    /// The people for whom the copy is, if it is for others: studies with their answers, saved searches, other names of
    /// people, remarks about them, and attributes that fewer may see go.
    pub(crate) audience: Option<ConsentAudience>,
}

/// Writes a compact copy of the database that does without some rows: nothing of them is in its bytes.
pub(crate) fn copy_without(connection: &Connection, to: &Path, omitted: OmittedRows<'_>) -> CorpusResult<()> {
    // Deleted rows stay in free pages of a file, so the copy is emptied first and then copied compactly
    // again.
    let mut whole_name = to.file_name().unwrap_or_default().to_owned();
    whole_name.push(".whole");
    let whole = to.with_file_name(whole_name);
    let copied = copy_database_compactly(connection, &whole).and_then(|()| {
        let mut copy = Connection::open(&whole)?;
        open::configure_connection(&mut copy)?;
        copy.pragma_update(None, "foreign_keys", false)?;
        erase_rows(&copy, omitted)?;
        copy_database_compactly(&copy, to)
    });
    // It lies in a folder that nobody sees yet; what remains is removed with that folder.
    let removed = std::fs::remove_file(&whole);
    copied?;
    removed.map_err(|error| CorpusError::from_file_failure(whole, error))
}

/// Removes rows for good, with what nothing else needs: signs without tokens, signers without recordings, blocks, and
/// the search index, which the next search builds again.
pub(crate) fn erase_rows(connection: &Connection, omitted: OmittedRows<'_>) -> CorpusResult<()> {
    let mut signs = BTreeSet::new();
    for recording in omitted.recordings {
        let mut statement = connection.prepare_cached("SELECT DISTINCT sign_id FROM token WHERE recording_id = ?1")?;
        let ids = statement.query_map([recording], |row| row.get::<_, i64>(0))?;
        signs.extend(ids.collect::<rusqlite::Result<Vec<_>>>()?);
        stored_delete::delete_recording(connection, *recording)?;
    }
    for sign in signs {
        let rest: i64 = connection.query_row("SELECT count(*) FROM token WHERE sign_id = ?1", [sign], |row| {
            row.get(0)
        })?;
        match rest {
            0 => stored_delete::delete_sign(connection, sign)?,
            _ => stored_delete::cite_another(connection, sign)?,
        }
    }
    if omitted.history {
        connection.execute_batch("DELETE FROM changeset; DELETE FROM operation;")?;
    }
    if let Some(audience) = omitted.audience {
        // Another name may be the true one behind a code, and nobody agreed that others read remarks about people.
        connection.execute_batch(
            "DELETE FROM study_answer; DELETE FROM study_participant; DELETE FROM study; DELETE FROM kept_search;
             DELETE FROM meta WHERE key LIKE 'conflict:%';
             DELETE FROM person_alias;
             UPDATE signer SET notes = NULL;",
        )?;
        for narrower in ConsentAudience::ALL_AUDIENCES.into_iter().filter(|one| *one < audience) {
            let sql = "DELETE FROM person_attribute WHERE audience = ?1";
            connection.execute(sql, [narrower.audience_name()])?;
        }
        let is_gone = "NOT IN (SELECT signer_id FROM recording WHERE signer_id IS NOT NULL)";
        connection.execute_batch(&format!(
            "DELETE FROM person_attribute WHERE signer_id {is_gone}; DELETE FROM signer WHERE id {is_gone};"
        ))?;
    }
    if omitted.history || !omitted.recordings.is_empty() {
        connection.execute_batch("DELETE FROM block WHERE hash NOT IN (SELECT hash FROM track_block);")?;
        stored_search::delete_files(connection)?;
    }
    seals::seal_tables(connection, seals::sealed_tables())
}

/// Opens such a copy for reading, which does not change its bytes.
pub(crate) fn read_copy(path: &Path) -> CorpusResult<Connection> {
    let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let mut connection = Connection::open_with_flags(path, flags)?;
    open::configure_connection(&mut connection)?;
    connection.execute_batch("BEGIN")?;
    Ok(connection)
}

/// Returns the names of all tables.
pub(crate) fn all_tables(connection: &Connection) -> CorpusResult<Vec<String>> {
    let mut statement = connection.prepare("SELECT name FROM main.sqlite_schema WHERE type = 'table' ORDER BY name")?;
    let names = statement.query_map([], |row| row.get(0))?;
    Ok(names.collect::<rusqlite::Result<_>>()?)
}

/// Calls `take` with each cell of a table.
pub(crate) fn visit_table_cells(
    connection: &Connection,
    table: &str,
    mut take: impl FnMut(ValueRef<'_>),
) -> CorpusResult<()> {
    let mut statement = connection.prepare(&format!("SELECT * FROM main.{table}"))?;
    let columns = statement.column_count();
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        for column in 0..columns {
            take(row.get_ref(column)?);
        }
    }
    Ok(())
}

/// Calls `take` with the names of a table's columns, then with each row as text. A null is an empty text, bytes are in
/// hexadecimal, and the bytes of stored files are left out. Tokens also have their signers and marks.
pub(crate) fn dump_table_rows(
    connection: &Connection,
    table: &str,
    mut take: impl FnMut(Vec<String>) -> CorpusResult<()>,
) -> CorpusResult<()> {
    let mut statement = connection.prepare(&token_marks::dumped_rows_sql(table))?;
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
