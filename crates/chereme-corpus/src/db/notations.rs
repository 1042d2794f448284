//! Rows of notations: tokens in HamNoSys or SiGML.

use std::collections::BTreeMap;

use rusqlite::{Connection, Row, params};

use super::signs::json_list;
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// The notation of a token.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct NotationRow {
    /// The row.
    pub(crate) id: i64,
    /// The token.
    pub(crate) token_id: i64,
    /// The gloss of its sign.
    pub(crate) gloss: String,
    /// The file that it came from.
    pub(crate) source_file_id: Option<i64>,
    /// The name of that file.
    pub(crate) file: Option<String>,
    /// The line of the file on which it starts, from 1.
    pub(crate) line: Option<i64>,
    /// `hamnosys` or `sigml`.
    pub(crate) system: String,
    /// The text as it was written, if it is HamNoSys.
    pub(crate) text: Option<String>,
    /// The notation tree with all annotations of its source, as JSON.
    pub(crate) document: String,
}

const SELECT_NOTATION_SQL: &str = "
    SELECT n.id, n.token_id, n.source_file_id, f.name, n.line, n.system, n.text, n.document, s.label
    FROM notation n JOIN token t ON t.id = n.token_id JOIN sign s ON s.id = t.sign_id
    LEFT JOIN source_file f ON f.id = n.source_file_id";

fn notation_row(row: &Row<'_>) -> rusqlite::Result<NotationRow> {
    Ok(NotationRow {
        id: row.get(0)?,
        token_id: row.get(1)?,
        source_file_id: row.get(2)?,
        file: row.get(3)?,
        line: row.get(4)?,
        system: row.get(5)?,
        text: row.get(6)?,
        document: row.get(7)?,
        gloss: row.get(8)?,
    })
}

/// Returns the notation of a token.
pub(crate) fn find_token_notation(connection: &Connection, token: i64) -> CorpusResult<Option<NotationRow>> {
    let sql = format!("{SELECT_NOTATION_SQL} WHERE n.token_id = ?1");
    connection.find_row(&sql, [token], notation_row)
}

/// Returns whether any of these tokens has a notation.
pub(crate) fn has_any_notation(connection: &Connection, tokens: &[i64]) -> CorpusResult<bool> {
    let sql = "SELECT EXISTS (SELECT 1 FROM notation WHERE token_id IN (SELECT value FROM json_each(?1)))";
    connection.read_value(sql, [json_list(tokens)])
}

/// Returns the notations of these tokens, by token.
pub(crate) fn of_tokens(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, NotationRow>> {
    let sql = format!("{SELECT_NOTATION_SQL} WHERE n.token_id IN (SELECT value FROM json_each(?1))");
    connection.read_rows(&sql, [json_list(tokens)], |row| Ok((row.get(1)?, notation_row(row)?)))
}

/// Returns the notations that came from files of this name or path, by line.
pub(crate) fn of_file(connection: &Connection, name: &str) -> CorpusResult<Vec<NotationRow>> {
    let sql = format!("{SELECT_NOTATION_SQL} WHERE f.name = ?1 OR f.path = ?1 ORDER BY n.source_file_id, n.line, n.id");
    connection.read_rows(&sql, [name], notation_row)
}

/// Calls `take` with every notation, in order.
pub(crate) fn visit_each_notation(
    connection: &Connection,
    mut take: impl FnMut(NotationRow) -> CorpusResult<()>,
) -> CorpusResult<()> {
    let mut statement = connection.prepare(&format!("{SELECT_NOTATION_SQL} ORDER BY n.id"))?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        take(notation_row(row)?)?;
    }
    Ok(())
}

/// Sets the notation of its token; leaves an unchanged one untouched. The row's `id`, `gloss` and `file` are not used.
pub(crate) fn set_token_notation(connection: &Connection, row: &NotationRow) -> CorpusResult<()> {
    let sql = match find_token_notation(connection, row.token_id)? {
        None => {
            "INSERT INTO notation (token_id, source_file_id, line, system, text, document)
                 VALUES (?1, ?2, ?3, ?4, ?5, ?6)"
        }
        Some(old) => {
            let new = NotationRow {
                id: old.id,
                file: old.file.clone(),
                gloss: old.gloss.clone(),
                ..row.clone()
            };
            // An update that changes nothing would still be recorded by the triggers as a change.
            if new == old {
                return Ok(());
            }
            "UPDATE notation SET source_file_id = ?2, line = ?3, system = ?4, text = ?5, document = ?6
                 WHERE token_id = ?1"
        }
    };
    let values = params![
        row.token_id,
        row.source_file_id,
        row.line,
        row.system,
        row.text,
        row.document
    ];
    connection.change_rows(sql, values)
}

/// Deletes the notation of a token, if it has one.
pub(crate) fn delete_token_notation(connection: &Connection, token: i64) -> CorpusResult<()> {
    connection.change_rows("DELETE FROM notation WHERE token_id = ?1", [token])
}
