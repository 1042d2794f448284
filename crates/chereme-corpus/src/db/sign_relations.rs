//! Rows of relations between signs. Each is stored once, and read from both ends.

use std::collections::BTreeMap;

use rusqlite::{Connection, params};
use serde::Serialize;

use crate::db::cached_sql::CachedSql;
use crate::error::CorpusResult;

/// The beginning of the name under which queries know the relations of a sign: `related.variant`.
pub(crate) const RELATION_PREFIX: &str = "related.";

/// The relations `r`, read from both ends: a sign, the name of the relation, the other sign, the place among the parts of
/// a compound, and who says so. Signs that were made here are derived from the signs of their recipes.
pub(crate) const RELATIONS_SQL: &str = "(WITH derived AS (
        SELECT DISTINCT made.sign_id AS sign_id, used.sign_id AS related_id
        FROM recipe c JOIN token made ON made.recording_id = c.recording_id
        JOIN recipe_input i ON i.recipe_id = c.id JOIN token used ON used.id = i.token_id
        WHERE made.sign_id <> used.sign_id),
    stored AS (
        SELECT sign_id, kind, related_id, position, source FROM sign_relation
        UNION SELECT sign_id, 'derived-from', related_id, 1, 'recipe' FROM derived)
    SELECT sign_id, kind AS name, related_id, position, source FROM stored
    UNION ALL
    SELECT s.related_id, k.inverse, s.sign_id, s.position, s.source
    FROM stored s JOIN relation_kind k ON k.name = s.kind) r";

/// The label `other.label` of the other sign of a relation, after its lexicon if that is another one.
pub(crate) const RELATED_LABEL_SQL: &str =
    "CASE WHEN other.lexicon_id IS NULL OR other.lexicon_id IS own.lexicon_id THEN other.label
    ELSE (SELECT name FROM lexicon WHERE id = other.lexicon_id) || '/' || other.label END";

/// A relation as it is stored.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct RelationRow {
    pub(crate) sign: i64,
    pub(crate) kind: String,
    pub(crate) related: i64,
    /// The place among the parts of a compound, from 1 on.
    pub(crate) position: i64,
    /// The table that says so; nothing if a person does.
    pub(crate) source: Option<String>,
}

/// A relation of a sign to another one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SignRelation {
    /// The row of the sign.
    pub sign_id: i64,
    /// The sign, by its label.
    pub sign: String,
    /// The name of the relation, such as `variant`, `compound-of` or `part-of`.
    pub relation: String,
    /// The row of the other sign.
    pub related_id: i64,
    /// The other sign, by its label, after the name of its lexicon if that is another one.
    pub related: String,
    /// The place among the parts of a compound, from 1 on.
    pub position: i64,
    /// Who says so: a table of a lexicon, `recipe` or `form`; nothing if a person does.
    pub source: Option<String>,
}

/// Returns the inverse name of each kind of relation.
pub(crate) fn load_relation_kinds(connection: &Connection) -> CorpusResult<BTreeMap<String, String>> {
    connection.read_rows("SELECT name, inverse FROM relation_kind", [], |row| {
        Ok((row.get(0)?, row.get(1)?))
    })
}

/// Stores a relation, and returns whether it is new; of one that is the same from both ends, either end may be stored.
pub(crate) fn insert_relation(connection: &Connection, row: &RelationRow) -> CorpusResult<bool> {
    let sql = "INSERT INTO sign_relation (sign_id, kind, related_id, position, source)
        SELECT ?1, ?2, ?3, ?4, ?5 WHERE NOT EXISTS (
            SELECT 1 FROM sign_relation s JOIN relation_kind k ON k.name = s.kind WHERE s.kind = ?2 AND s.position = ?4
            AND ((s.sign_id = ?1 AND s.related_id = ?3) OR (k.inverse = k.name AND s.sign_id = ?3 AND s.related_id = ?1)))";
    let values = params![row.sign, row.kind, row.related, row.position, row.source];
    Ok(connection.count_changes(sql, values)? > 0)
}

/// Removes the relations of a kind between two signs, from whichever end they are stored, and returns how many.
pub(crate) fn remove_relations(connection: &Connection, sign: i64, kind: &str, related: i64) -> CorpusResult<usize> {
    let sql = "DELETE FROM sign_relation WHERE kind = ?2 AND ((sign_id = ?1 AND related_id = ?3)
        OR (sign_id = ?3 AND related_id = ?1 AND kind IN (SELECT name FROM relation_kind WHERE inverse = name)))";
    connection.count_changes(sql, params![sign, kind, related])
}

/// Returns the relations that a table states.
pub(crate) fn load_relations_of_table(connection: &Connection, source: &str) -> CorpusResult<Vec<RelationRow>> {
    let sql = "SELECT sign_id, kind, related_id, position, source FROM sign_relation WHERE source = ?1";
    connection.read_rows(sql, [source], |row| {
        Ok(RelationRow {
            sign: row.get(0)?,
            kind: row.get(1)?,
            related: row.get(2)?,
            position: row.get(3)?,
            source: row.get(4)?,
        })
    })
}

/// Gives the relations of a sign to another one that takes its place; those that it has already, and those between the two,
/// go.
pub(crate) fn move_relations(connection: &Connection, from: i64, into: i64) -> CorpusResult<()> {
    for sql in [
        "DELETE FROM sign_relation WHERE ?1 IN (sign_id, related_id) AND ?2 IN (sign_id, related_id)",
        "UPDATE OR IGNORE sign_relation SET sign_id = ?2 WHERE sign_id = ?1",
        "UPDATE OR IGNORE sign_relation SET related_id = ?2 WHERE related_id = ?1",
        "DELETE FROM sign_relation WHERE ?1 IN (sign_id, related_id) AND ?1 <> ?2",
    ] {
        connection.change_rows(sql, [from, into])?;
    }
    Ok(())
}

/// Returns the relations of a sign, or of all signs, by sign, name and place; each is there from both ends.
pub(crate) fn load_sign_relations(connection: &Connection, sign: Option<i64>) -> CorpusResult<Vec<SignRelation>> {
    let sql = format!(
        "SELECT own.id, own.label, r.name, other.id, {RELATED_LABEL_SQL}, r.position, r.source
         FROM {RELATIONS_SQL} JOIN sign own ON own.id = r.sign_id JOIN sign other ON other.id = r.related_id
         WHERE ?1 IS NULL OR r.sign_id = ?1 ORDER BY 2, 1, 3, 6, 5"
    );
    connection.read_rows(&sql, [sign], |row| {
        Ok(SignRelation {
            sign_id: row.get(0)?,
            sign: row.get(1)?,
            relation: row.get(2)?,
            related_id: row.get(3)?,
            related: row.get(4)?,
            position: row.get(5)?,
            source: row.get(6)?,
        })
    })
}
