//! Operations and their changesets: who did what, when, and the rows before and after.
//!
//! Temporary triggers copy every changed row of the tracked tables into `temp.change`; when an
//! operation ends they are packed, in order, into parts of `changeset`: JSON lines under zstd,
//! `[table, kind, before, after, uids of the rows referred to]`. Undo applies the inverse as a new
//! operation, redo the inverse of that.

pub(super) mod tracked;

use std::collections::BTreeMap;

use rusqlite::{Connection, OptionalExtension, Row, params};
use serde::Serialize;
use serde_json::Value;

use super::damaged_row_error;
use super::seals::{self, SealChanges};
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::words::effect::OperationEffect;
use tracked::{TRACKED_TABLE_REFERENCES, column_from_image_sql, load_table_columns, row_image};

pub(super) use tracked::create_change_triggers;
pub(crate) use tracked::{are_image_values_equal, refers_to};

const PART_BYTES: usize = 4 << 20;

/// The kind of an operation in the history.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum OperationKind {
    /// Ordinary work.
    Do,
    /// An undo of another operation.
    Undo,
    /// A redo of an undone operation.
    Redo,
}

impl OperationKind {
    fn operation_kind_name(self) -> &'static str {
        match self {
            Self::Do => "do",
            Self::Undo => "undo",
            Self::Redo => "redo",
        }
    }
}

/// One operation as the log shows it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OperationRow {
    /// Its number, counted up from 1.
    pub id: i64,
    /// The time, as `YYYY-MM-DDTHH:MM:SSZ`.
    pub at: String,
    /// The author.
    pub author: String,
    /// The kind: ordinary work, an undo or a redo.
    pub kind: OperationKind,
    /// The operation that an undo or redo refers to.
    pub target: Option<i64>,
    /// The kind of work, such as `import`.
    pub name: String,
    /// A summary of the operation in English.
    pub summary: String,
    /// What it did, which can be described in every language.
    pub effect: OperationEffect,
    /// The number of changed rows.
    pub changes: i64,
    /// Whether it is in effect, that is, not undone at present.
    pub stands: bool,
}

/// Inserts the operation's row and returns its number, which the changeset will have too.
pub(super) fn begin_operation(connection: &Connection, author: &str) -> CorpusResult<i64> {
    insert_operation(connection, author, OperationKind::Do, None)
}

fn insert_operation(
    connection: &Connection,
    author: &str,
    kind: OperationKind,
    target: Option<i64>,
) -> CorpusResult<i64> {
    connection.execute(
        "INSERT INTO operation (at, author, kind, target, name, summary, changes)
         VALUES (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'), ?1, ?2, ?3, '', '', 0)",
        params![author, kind.operation_kind_name(), target],
    )?;
    Ok(connection.last_insert_rowid())
}

/// Packs the recorded changes into the operation's changeset; deletes the operation if nothing changed.
pub(super) fn finish_operation(
    connection: &Connection,
    operation: i64,
    effect: &OperationEffect,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let mut changes = 0i64;
    let (mut part, mut lines) = (0i64, Vec::new());
    let mut seals = SealChanges::default();
    let sql = "SELECT tbl, kind, before, after, refs FROM temp.change ORDER BY seq";
    connection.visit_rows(sql, [], |row| {
        let text = |i: usize| -> rusqlite::Result<Option<&str>> { Ok(row.get_ref(i)?.as_str_or_null()?) };
        let table = text(0)?.unwrap_or_default();
        let images = [text(2)?, text(3)?];
        for image in images.into_iter().flatten() {
            // The old image leaves the seal in the same way as the new one enters it.
            seals.turn_row(table, image);
        }
        let [before, after] = images.map(|image| image.unwrap_or("null"));
        let (kind, refs) = (text(1)?.unwrap_or_default(), text(4)?.unwrap_or("null"));
        let line = format!("[\"{table}\",\"{kind}\",{before},{after},{refs}]\n");
        lines.extend_from_slice(line.as_bytes());
        changes += 1;
        report_change_progress(progress, "history", changes)?;
        // An import may change millions of rows, which must not lie in memory at once.
        if lines.len() >= PART_BYTES {
            seals.turn_part(
                operation,
                part,
                &store_changeset_part(connection, operation, part, &lines)?,
            );
            part += 1;
            lines.clear();
        }
        Ok(())
    })?;
    if !lines.is_empty() {
        seals.turn_part(
            operation,
            part,
            &store_changeset_part(connection, operation, part, &lines)?,
        );
    }
    // An operation without effect would be a step of undo that does nothing.
    if changes == 0 {
        connection.execute("DELETE FROM operation WHERE id = ?1", [operation])?;
    } else {
        let (name, summary, effect) = effect.stored_texts();
        connection.execute(
            "UPDATE operation SET name = ?2, summary = ?3, effect = ?4, changes = ?5 WHERE id = ?1",
            params![operation, name, summary, effect, changes],
        )?;
        seals.store_seal_changes(connection, operation)?;
    }
    Ok(())
}

/// Reports the progress at every 512th change.
fn report_change_progress(progress: &mut ProgressReceiver<'_>, task: &str, done: i64) -> CorpusResult<()> {
    if done % 512 != 0 {
        return Ok(());
    }
    progress.report_amount(ProgressUnit::Items, task, u64::try_from(done).unwrap_or_default(), None)
}

/// Stores lines as a part of a changeset, and returns its bytes.
fn store_changeset_part(connection: &Connection, operation: i64, part: i64, lines: &[u8]) -> CorpusResult<Vec<u8>> {
    let data = zstd::encode_all(lines, 3)
        .map_err(|error| damaged_row_error(format!("changeset {operation}"), error.to_string()))?;
    connection.execute(
        "INSERT INTO changeset (operation_id, part, data) VALUES (?1, ?2, ?3)",
        params![operation, part, data],
    )?;
    Ok(data)
}

pub(super) fn undo_newest_operation(
    connection: &Connection,
    author: &str,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<OperationRow> {
    let target = load_undo_and_redo_stacks(connection)?.0.pop().ok_or_else(|| {
        CorpusError::from_wrong_message("there is nothing to undo")
            .with_command_advice("`chereme log CORPUS` lists all operations")
    })?;
    apply_inverse_changeset(connection, author, OperationKind::Undo, target, target, progress)
}

pub(super) fn redo_undone_operation(
    connection: &Connection,
    author: &str,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<OperationRow> {
    let target = load_undo_and_redo_stacks(connection)?.1.pop().ok_or_else(|| {
        CorpusError::from_wrong_message("there is nothing to redo")
            .with_advice("only what was undone last, with no other work since, can be done again")
    })?;
    // The same operation may have been undone several times, and the last undo is the one to invert.
    let undone_by = connection.query_row(
        "SELECT max(id) FROM operation WHERE kind = 'undo' AND target = ?1",
        [target],
        |row| row.get(0),
    )?;
    apply_inverse_changeset(connection, author, OperationKind::Redo, target, undone_by, progress)
}

/// Returns the operations that are in effect and can be undone, and those that can be redone, oldest first.
fn load_undo_and_redo_stacks(connection: &Connection) -> CorpusResult<(Vec<i64>, Vec<i64>)> {
    let mut statement = connection.prepare_cached("SELECT id, kind, target FROM operation ORDER BY id")?;
    let mut rows = statement.query([])?;
    let (mut done, mut undone) = (Vec::new(), Vec::new());
    while let Some(row) = rows.next()? {
        let target: Option<i64> = row.get(2)?;
        match (row.get::<_, String>(1)?.as_str(), target) {
            ("undo", Some(target)) => {
                done.retain(|&id| id != target);
                undone.push(target);
            }
            ("redo", Some(target)) => {
                undone.retain(|&id| id != target);
                done.push(target);
            }
            _ => {
                done.push(row.get(0)?);
                // New work may rest on the present rows, so what was undone before cannot return.
                undone.clear();
            }
        }
    }
    Ok((done, undone))
}

/// Applies the inverse of `source`'s changeset as an operation of `kind` on `target`.
fn apply_inverse_changeset(
    connection: &Connection,
    author: &str,
    kind: OperationKind,
    target: i64,
    source: i64,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<OperationRow> {
    let (name, effect) = connection.query_row(
        "SELECT name, summary, effect FROM operation WHERE id = ?1",
        [target],
        |row| Ok((row.get::<_, String>(0)?, read_effect(row, 0)?)),
    )?;
    // A damaged changeset would write wrong rows into the corpus.
    seals::verify_changeset(connection, source)?;
    // Rows return in reverse order, so one may come before the row that it refers to.
    connection.execute_batch("PRAGMA defer_foreign_keys = ON;")?;
    let parts: i64 = connection.query_row(
        "SELECT count(*) FROM changeset WHERE operation_id = ?1",
        [source],
        |row| row.get(0),
    )?;
    let operation = insert_operation(connection, author, kind, Some(target))?;
    let mut statements = BTreeMap::new();
    for (table, _) in TRACKED_TABLE_REFERENCES {
        statements.insert(table, InverseStatements::inverse_for_table(connection, table)?);
    }
    let mut done = 0;
    // Changes of one row build on each other, so the last one is taken back first.
    for part in (0..parts).rev() {
        let part_text = read_part(connection, source, part)?;
        let lines: Vec<&str> = part_text.lines().collect();
        for line in lines.into_iter().rev() {
            invert_change(connection, source, line, &statements)?;
            done += 1;
            report_change_progress(progress, &name, done)?;
        }
    }
    finish_operation(connection, operation, &effect, progress)?;
    load_newest_operations(connection, usize::MAX)?
        .into_iter()
        .find(|row| row.id == operation)
        .ok_or_else(|| damaged_row_error(format!("operation {source}"), "its changeset is empty"))
}

/// Returns the parts of all changesets, as numbers of operation and part, oldest first.
pub(super) fn list_changeset_parts(connection: &Connection) -> CorpusResult<Vec<(i64, i64)>> {
    let sql = "SELECT operation_id, part FROM changeset ORDER BY operation_id, part";
    let mut statement = connection.prepare(sql)?;
    let rows = statement
        .query_map([], |row| Ok((row.get(0)?, row.get(1)?)))?
        .collect::<rusqlite::Result<_>>()?;
    Ok(rows)
}

/// Replaces a part of a changeset by its lines in the format of a newer schema, with `added` more changes.
pub(super) fn replace_part(
    connection: &Connection,
    operation: i64,
    part: i64,
    lines: &str,
    added: i64,
) -> CorpusResult<()> {
    connection.execute(
        "DELETE FROM changeset WHERE operation_id = ?1 AND part = ?2",
        params![operation, part],
    )?;
    store_changeset_part(connection, operation, part, lines.as_bytes())?;
    connection.execute(
        "UPDATE operation SET changes = changes + ?2 WHERE id = ?1",
        params![operation, added],
    )?;
    Ok(())
}

pub(super) fn read_part(connection: &Connection, operation: i64, part: i64) -> CorpusResult<String> {
    let place = || format!("changeset {operation}, part {part}");
    let data: Vec<u8> = connection
        .query_row(
            "SELECT data FROM changeset WHERE operation_id = ?1 AND part = ?2",
            params![operation, part],
            |row| row.get(0),
        )
        .optional()?
        .ok_or_else(|| damaged_row_error(place(), "it is missing"))?;
    let mut lines = Vec::new();
    let reader = zstd::Decoder::new(data.as_slice()).map_err(|e| damaged_row_error(place(), e.to_string()))?;
    // A damaged part could otherwise unpack to any size.
    std::io::Read::read_to_end(&mut std::io::Read::take(reader, 64 * PART_BYTES as u64), &mut lines)
        .map_err(|error| damaged_row_error(place(), error.to_string()))?;
    String::from_utf8(lines).map_err(|_| damaged_row_error(place(), "it is no text"))
}

/// A row that an operation changed, as JSON before and after; null if it did not exist.
pub(crate) struct RowChange {
    pub(crate) table: String,
    pub(crate) before: Value,
    pub(crate) after: Value,
}

/// Calls `take` with the changes of an operation, in order.
pub(crate) fn each_change(
    connection: &Connection,
    operation: i64,
    mut take: impl FnMut(RowChange) -> CorpusResult<()>,
) -> CorpusResult<()> {
    let parts: i64 = connection.query_row(
        "SELECT count(*) FROM changeset WHERE operation_id = ?1",
        [operation],
        |row| row.get(0),
    )?;
    for part in 0..parts {
        for line in read_part(connection, operation, part)?.lines() {
            let (table, _, before, after, _): (String, String, Value, Value, Value) = serde_json::from_str(line)
                .map_err(|error| damaged_row_error(format!("changeset {operation}"), error.to_string()))?;
            take(RowChange { table, before, after })?;
        }
    }
    Ok(())
}

/// Returns the number of operations that can be undone, and of those that can be redone.
pub(crate) fn count_undo_redo_steps(connection: &Connection) -> CorpusResult<(usize, usize)> {
    let (done, undone) = load_undo_and_redo_stacks(connection)?;
    Ok((done.len(), undone.len()))
}

/// Returns the name of a row as the user knows it; `None` if it was removed or has no name.
pub(crate) fn name_of(connection: &Connection, table: &str, id: i64) -> CorpusResult<Option<String>> {
    let sql = match table {
        "recording" => "SELECT name FROM recording WHERE id = ?1",
        "tier" => "SELECT name FROM tier WHERE id = ?1",
        "signer" => "SELECT name FROM signer WHERE id = ?1",
        "lexicon" => "SELECT name FROM lexicon WHERE id = ?1",
        "sign" => "SELECT label FROM sign WHERE id = ?1",
        "inventory" => "SELECT key FROM inventory WHERE id = ?1",
        "annotation" => "SELECT value FROM annotation WHERE id = ?1",
        _ => return Ok(None),
    };
    connection.find_value(sql, [id])
}

/// Returns the row that `column` of a row refers to; `None` if that row was removed.
pub(crate) fn reference_of(connection: &Connection, table: &str, id: i64, column: &str) -> CorpusResult<Option<i64>> {
    if (table, column) != ("tier", "recording_id") {
        return Ok(None);
    }
    connection.find_value("SELECT recording_id FROM tier WHERE id = ?1", [id])
}

/// The statements that undo changes of a table's rows; `?1` and `?2` are rows as JSON.
struct InverseStatements {
    key: String,
    /// Selects the row that has the key of `?1`, as JSON.
    find: String,
    delete: String,
    insert: String,
    /// Writes `?1` over the row that has the key of `?2`.
    update: String,
}

impl InverseStatements {
    fn inverse_for_table(connection: &Connection, table: &str) -> CorpusResult<Self> {
        let columns = load_table_columns(connection, table)?;
        // The first column of every tracked table is its key.
        let key = columns[0].name.clone();
        let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
        let values: Vec<String> = columns.iter().map(column_from_image_sql).collect();
        // A column that the row image of an earlier version lacks keeps its value.
        let settings: Vec<String> = columns
            .iter()
            .map(|column| {
                let (name, value) = (&column.name, column_from_image_sql(column));
                format!("{name} = iif(json_type(?1, '$.{name}') IS NULL, {name}, {value})")
            })
            .collect();
        Ok(Self {
            find: format!(
                "SELECT {} FROM main.{table} AS r WHERE {key} = json_extract(?1, '$.{key}')",
                row_image(&columns, "r")
            ),
            delete: format!("DELETE FROM main.{table} WHERE {key} = json_extract(?1, '$.{key}')"),
            insert: format!(
                "INSERT INTO main.{table} ({}) VALUES ({})",
                names.join(","),
                values.join(",")
            ),
            update: format!(
                "UPDATE main.{table} SET {} WHERE {key} = json_extract(?2, '$.{key}')",
                settings.join(",")
            ),
            key,
        })
    }
}

fn invert_change(
    connection: &Connection,
    operation: i64,
    line: &str,
    statements: &BTreeMap<&str, InverseStatements>,
) -> CorpusResult<()> {
    let place = || format!("changeset {operation}");
    let change: (String, String, Value, Value, Value) =
        serde_json::from_str(line).map_err(|error| damaged_row_error(place(), error.to_string()))?;
    let (table, kind, before, after, _) = change;
    let inverse = statements
        .get(table.as_str())
        .ok_or_else(|| damaged_row_error(place(), format!("it names the unknown table {table:?}")))?;
    match kind.as_str() {
        "i" => {
            let after_text = after.to_string();
            // A row that something else changed since must not be deleted with that change.
            expect_row(connection, &table, inverse, &after, &after_text)?;
            connection.change_rows(&inverse.delete, [after_text])?;
        }
        "d" => {
            connection.change_rows(&inverse.insert, [before.to_string()])?;
        }
        "u" => {
            let after_text = after.to_string();
            expect_row(connection, &table, inverse, &after, &after_text)?;
            connection.change_rows(&inverse.update, [before.to_string(), after_text])?;
        }
        other => {
            return Err(damaged_row_error(
                place(),
                format!("it holds the unknown change {other:?}"),
            ));
        }
    }
    Ok(())
}

/// Fails if a row is no longer in the state in which the operation to be undone left it.
fn expect_row(
    connection: &Connection,
    table: &str,
    inverse: &InverseStatements,
    want: &Value,
    text: &str,
) -> CorpusResult<()> {
    let stored_text: Option<String> = connection.find_value(&inverse.find, [text])?;
    let row_image = stored_text.and_then(|text| serde_json::from_str::<Value>(&text).ok());
    // The row image of an earlier version has fewer columns.
    let same = row_image.zip(want.as_object()).is_some_and(|(found, want)| {
        want.iter()
            .all(|(column, value)| are_image_values_equal(&found[column], value))
    });
    if same {
        return Ok(());
    }
    // The user knows rows by their names, and not by their numbers.
    let named = ["name", "gloss", "value", "key", "text"]
        .into_iter()
        .find_map(|column| want.get(column)?.as_str().filter(|text| !text.is_empty()));
    let row = match named {
        Some(name) => format!("{} {name:?}", table.replace('_', " ")),
        None => {
            let key = want.get(&inverse.key).unwrap_or(&Value::Null);
            format!("row {key} of {table}")
        }
    };
    Err(CorpusError::from_wrong_message(format!(
        "the {row} was changed by something else since, so this cannot be taken back"
    ))
    .with_command_advice("`chereme log CORPUS` lists all operations; `chereme check CORPUS` looks for damage"))
}

/// Returns the number of the newest operation; nothing if there are no operations.
pub(crate) fn find_newest_operation(connection: &Connection) -> CorpusResult<Option<i64>> {
    let sql = "SELECT max(id) FROM operation";
    Ok(connection.query_row(sql, [], |row| row.get(0))?)
}

/// Returns the operations after one, oldest first, with the numbers of their changed rows; `None` if that operation no
/// longer exists.
pub(crate) fn operations_since(connection: &Connection, operation: i64) -> CorpusResult<Option<Vec<(i64, i64)>>> {
    let mut statement = connection.prepare_cached("SELECT id, changes FROM operation WHERE id >= ?1 ORDER BY id")?;
    let row_iterator = statement.query_map([operation], |row| Ok((row.get(0)?, row.get(1)?)))?;
    let mut rows = row_iterator.collect::<rusqlite::Result<Vec<(i64, i64)>>>()?;
    // A caller that knows an operation of another history must read everything again.
    if rows.first().is_none_or(|(id, _)| *id != operation) {
        return Ok(None);
    }
    rows.remove(0);
    Ok(Some(rows))
}

/// Returns the newest operations first.
pub(crate) fn load_newest_operations(connection: &Connection, limit: usize) -> CorpusResult<Vec<OperationRow>> {
    let (done, _) = load_undo_and_redo_stacks(connection)?;
    let sql = "SELECT id, at, author, kind, target, name, summary, effect, changes
         FROM operation ORDER BY id DESC LIMIT ?1";
    connection.read_rows(sql, [i64::try_from(limit).unwrap_or(i64::MAX)], |row| {
        let id = row.get(0)?;
        let kind = match row.get::<_, String>(3)?.as_str() {
            "undo" => OperationKind::Undo,
            "redo" => OperationKind::Redo,
            _ => OperationKind::Do,
        };
        Ok(OperationRow {
            id,
            at: row.get(1)?,
            author: row.get(2)?,
            kind,
            target: row.get(4)?,
            name: row.get(5)?,
            summary: row.get(6)?,
            effect: read_effect(row, 5)?,
            changes: row.get(8)?,
            // A redone operation stands out of order, where the binary search may miss it.
            stands: kind != OperationKind::Do || done.binary_search(&id).is_ok() || done.contains(&id),
        })
    })
}

/// Reads what an operation did from its name, its summary and its effect, the columns from `first` on.
fn read_effect(row: &Row<'_>, first: usize) -> rusqlite::Result<OperationEffect> {
    let (name, summary): (String, String) = (row.get(first)?, row.get(first + 1)?);
    let json: Option<String> = row.get(first + 2)?;
    Ok(OperationEffect::from_stored_texts(&name, &summary, json.as_deref()))
}

/// Reports changesets that are missing or cannot be read.
pub(super) fn check_changesets(
    connection: &Connection,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<Vec<String>> {
    let mut faults = Vec::new();
    let mut statement = connection.prepare(
        "SELECT o.id, o.changes, (SELECT count(*) FROM changeset c WHERE c.operation_id = o.id)
         FROM operation o ORDER BY o.id",
    )?;
    let mut rows = statement.query([])?;
    while let Some(row) = rows.next()? {
        let (id, changes, parts): (i64, i64, i64) = (row.get(0)?, row.get(1)?, row.get(2)?);
        let mut fault_count = 0i64;
        for part in 0..parts {
            progress.report_amount(
                ProgressUnit::Items,
                "history",
                u64::try_from(id).unwrap_or_default(),
                None,
            )?;
            match read_part(connection, id, part) {
                Ok(lines) => fault_count += lines.lines().count() as i64,
                Err(error) => faults.push(error.to_string()),
            }
        }
        // A part that was cut off or lost shows only in the number of its lines.
        if fault_count != changes {
            faults.push(format!("operation {id} holds {fault_count} of its {changes} changes"));
        }
    }
    Ok(faults)
}
