//! Rows of recipes and their inputs.

use rusqlite::{Connection, params};
use serde::Serialize;

use super::signs::json_list;
use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// The recipe of a generated recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct RecipeRow {
    /// The row.
    pub id: i64,
    /// The generated recording's row.
    pub recording_id: i64,
    /// The recipe as text.
    pub text: String,
    /// The recipe and the choices made for it, as JSON.
    pub document: String,
    /// The report of the evaluation, as JSON.
    pub report: String,
    /// The version of the program that evaluated it.
    pub engine: String,
}

/// Writes a recipe and returns its row; its `id` is not used.
pub(crate) fn insert_recipe_row(connection: &Connection, row: &RecipeRow) -> CorpusResult<i64> {
    let sql = "INSERT INTO recipe (recording_id, text, document, report, engine)
             VALUES (?1, ?2, ?3, ?4, ?5)";
    connection.insert_row(
        sql,
        params![row.recording_id, row.text, row.document, row.report, row.engine],
    )
}

/// Writes the recipe of a recording again, and deletes its earlier inputs.
pub(crate) fn update_recipe_row(connection: &Connection, row: &RecipeRow) -> CorpusResult<()> {
    let sql = "UPDATE recipe SET text = ?2, document = ?3, report = ?4, engine = ?5 WHERE id = ?1";
    connection.change_rows(sql, params![row.id, row.text, row.document, row.report, row.engine])?;
    // An input has no identity of its own; the caller writes the new ones.
    connection.change_rows("DELETE FROM recipe_input WHERE recipe_id = ?1", [row.id])
}

/// Returns the recordings that a recipe takes movement from.
pub(crate) fn input_recordings(connection: &Connection, recipe: i64) -> CorpusResult<Vec<i64>> {
    let sql = "SELECT DISTINCT recording_id FROM recipe_input
         WHERE recipe_id = ?1 AND recording_id IS NOT NULL ORDER BY recording_id";
    connection.read_values(sql, [recipe])
}

/// Returns the recordings, by row and name, that take movement from a recording.
pub(crate) fn made_from_recording(connection: &Connection, recording: i64) -> CorpusResult<Vec<(i64, String)>> {
    let sql = "SELECT DISTINCT r.id, r.name FROM recipe_input i
         JOIN recipe p ON p.id = i.recipe_id JOIN recording r ON r.id = p.recording_id
         WHERE i.recording_id = ?1 ORDER BY r.id";
    connection.read_rows(sql, [recording], |row| Ok((row.get(0)?, row.get(1)?)))
}

/// Records one input of a recipe.
pub(crate) fn insert_input(
    connection: &Connection,
    recipe: i64,
    address: &str,
    recording: Option<i64>,
    token: Option<i64>,
    hash: &str,
) -> CorpusResult<()> {
    let sql = "INSERT INTO recipe_input (recipe_id, address, recording_id, token_id, hash)
             VALUES (?1, ?2, ?3, ?4, ?5)";
    connection.change_rows(sql, params![recipe, address, recording, token, hash])
}

/// Returns the recipe of a recording, if it was generated.
pub(crate) fn find_recording_recipe(connection: &Connection, recording: i64) -> CorpusResult<Option<RecipeRow>> {
    let sql = "SELECT id, recording_id, text, document, report, engine
             FROM recipe WHERE recording_id = ?1";
    connection.find_row(sql, [recording], |row| {
        Ok(RecipeRow {
            id: row.get(0)?,
            recording_id: row.get(1)?,
            text: row.get(2)?,
            document: row.get(3)?,
            report: row.get(4)?,
            engine: row.get(5)?,
        })
    })
}

/// Returns the recording that provided the body of a generated recording: the first of its inputs, direct or indirect,
/// that is not generated itself and has that skeleton.
pub(crate) fn body_of(connection: &Connection, recording: i64, skeleton: i64) -> CorpusResult<Option<i64>> {
    // `UNION` without `ALL` drops rows met before, so that recipes in a circle end.
    let sql = "WITH RECURSIVE source (recording_id, input) AS (
                 VALUES (?1, 0)
                 UNION
                 SELECT i.recording_id, i.id FROM source
                 JOIN recipe r ON r.recording_id = source.recording_id
                 JOIN recipe_input i ON i.recipe_id = r.id
                 WHERE i.recording_id IS NOT NULL
             )
             SELECT source.recording_id FROM source
             JOIN recording ON recording.id = source.recording_id
             JOIN track ON track.recording_id = source.recording_id
             WHERE recording.origin <> 'made' AND track.skeleton_id = ?2
             ORDER BY source.input LIMIT 1";
    connection.find_value(sql, params![recording, skeleton])
}

/// Returns the gloss and the recipe's JSON of generated tokens that are alone in their recording: token, gloss, JSON.
pub(crate) fn of_lone_tokens(connection: &Connection, tokens: &[i64]) -> CorpusResult<Vec<(i64, String, String)>> {
    // Of several tokens in one recording, the recipe does not say which is its own.
    let sql = "SELECT t.id, s.label, r.document FROM token t
         JOIN sign s ON s.id = t.sign_id JOIN recipe r ON r.recording_id = t.recording_id
         WHERE t.id IN (SELECT value FROM json_each(?1)) AND NOT EXISTS
             (SELECT 1 FROM token other WHERE other.recording_id = t.recording_id AND other.id <> t.id)";
    connection.read_rows(sql, [json_list(tokens)], |row| {
        Ok((row.get(0)?, row.get(1)?, row.get(2)?))
    })
}

/// Returns the addresses of a recipe's inputs, in order, each once.
pub(crate) fn list_recipe_inputs(connection: &Connection, recipe: i64) -> CorpusResult<Vec<String>> {
    let sql = "SELECT address FROM recipe_input WHERE recipe_id = ?1 GROUP BY address ORDER BY min(id)";
    connection.read_values(sql, [recipe])
}

/// Returns the recordings, by row and name, that were generated from a token.
pub(crate) fn made_from(connection: &Connection, token: i64) -> CorpusResult<Vec<(i64, String)>> {
    let sql = "SELECT DISTINCT r.id, r.name FROM recipe_input i
         JOIN recipe p ON p.id = i.recipe_id JOIN recording r ON r.id = p.recording_id
         WHERE i.token_id = ?1 ORDER BY r.id";
    connection.read_rows(sql, [token], |row| Ok((row.get(0)?, row.get(1)?)))
}
