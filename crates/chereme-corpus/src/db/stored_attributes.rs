//! Rows of attributes: the properties of a sign in a table beyond its components.

use std::collections::{BTreeMap, BTreeSet};

use rusqlite::{Connection, params};

use super::signs::json_list;
use crate::error::CorpusResult;

/// An attribute of an entry of a lexicon.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct AttributeRow {
    /// The title of its column.
    pub(crate) name: String,
    /// The cell, letter by letter.
    pub(crate) text: String,
    /// The number in the cell, if it is one.
    pub(crate) number: Option<f64>,
}

/// Sets the attributes of a token; leaves rows that do not change untouched.
pub(crate) fn set_token_attributes(connection: &Connection, token: i64, rows: &[AttributeRow]) -> CorpusResult<()> {
    if of_tokens(connection, &[token])?.remove(&token).unwrap_or_default() == rows {
        return Ok(());
    }
    connection
        .prepare_cached("DELETE FROM attribute WHERE token_id = ?1")?
        .execute([token])?;
    let mut statement = connection
        .prepare_cached("INSERT OR IGNORE INTO attribute (token_id, name, text, number) VALUES (?1, ?2, ?3, ?4)")?;
    for row in rows {
        statement.execute(params![token, row.name, row.text, row.number])?;
    }
    Ok(())
}

/// Returns the attributes of tokens, in the order in which they were written.
pub(crate) fn of_tokens(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, Vec<AttributeRow>>> {
    let mut statement = connection.prepare_cached(
        "SELECT token_id, name, text, number FROM attribute
         WHERE token_id IN (SELECT value FROM json_each(?1)) ORDER BY token_id, id",
    )?;
    let mut all: BTreeMap<i64, Vec<AttributeRow>> = BTreeMap::new();
    let mut rows = statement.query([json_list(tokens)])?;
    while let Some(row) = rows.next()? {
        all.entry(row.get(0)?).or_default().push(AttributeRow {
            name: row.get(1)?,
            text: row.get(2)?,
            number: row.get(3)?,
        });
    }
    Ok(all)
}

/// Returns the names of all attributes, in order.
pub(crate) fn list_attribute_names(connection: &Connection) -> CorpusResult<Vec<String>> {
    let mut statement = connection.prepare_cached("SELECT DISTINCT name FROM attribute ORDER BY name")?;
    let names = statement
        .query_map([], |row| row.get(0))?
        .collect::<rusqlite::Result<_>>()?;
    Ok(names)
}

/// Returns the tokens with an attribute of one of these names that passes, and all tokens with such an attribute.
///
/// A row of a table has its own attributes alone; every other token of a sign has those of the sign's rows.
pub(crate) fn tokens_that(
    connection: &Connection,
    names: &[String],
    passes: impl Fn(&AttributeRow) -> bool,
) -> CorpusResult<(BTreeSet<i64>, BTreeSet<i64>)> {
    let (mut entries, mut passing) = (BTreeSet::new(), BTreeSet::new());
    let (mut signs, mut passing_signs) = (BTreeSet::new(), BTreeSet::new());
    let mut statement = connection.prepare_cached(
        "SELECT a.token_id, t.sign_id, a.text, a.number FROM attribute a
         JOIN token t ON t.id = a.token_id WHERE a.name = ?1",
    )?;
    for name in names {
        let mut rows = statement.query([name])?;
        while let Some(row) = rows.next()? {
            let (token, sign): (i64, i64) = (row.get(0)?, row.get(1)?);
            let attribute_row = AttributeRow {
                name: name.clone(),
                text: row.get(2)?,
                number: row.get(3)?,
            };
            entries.insert(token);
            signs.insert(sign);
            if passes(&attribute_row) {
                passing.insert(token);
                passing_signs.insert(sign);
            }
        }
    }
    let mut having = entries.clone();
    let signs: Vec<i64> = signs.into_iter().collect();
    let mut statement = connection.prepare_cached(
        "SELECT id, sign_id FROM token WHERE sign_id IN (SELECT value FROM json_each(?1))
             AND NOT (origin = 'lexicon' AND coalesce(instr(source, '\"cells\":'), 0))",
    )?;
    let mut rows = statement.query([json_list(&signs)])?;
    while let Some(row) = rows.next()? {
        let (token, sign): (i64, i64) = (row.get(0)?, row.get(1)?);
        if having.insert(token) && passing_signs.contains(&sign) {
            passing.insert(token);
        }
    }
    Ok((passing, having))
}

/// Summary of an attribute for an overview.
pub(crate) struct AttributeSummary {
    /// Its name.
    pub(crate) name: String,
    /// How many entries have it.
    pub(crate) entries: u64,
    /// The least and the greatest number, if all its values are numbers.
    pub(crate) range: Option<(f64, f64)>,
}

/// Returns every attribute with the number of entries that have it.
pub(crate) fn summarise_attributes(connection: &Connection) -> CorpusResult<Vec<AttributeSummary>> {
    let mut statement = connection.prepare_cached(
        "SELECT name, count(*), count(number), min(number), max(number) FROM attribute
         GROUP BY name ORDER BY min(id)",
    )?;
    let rows = statement.query_map([], |row| {
        let (entries, numbers): (i64, i64) = (row.get(1)?, row.get(2)?);
        let least: Option<f64> = row.get(3)?;
        Ok(AttributeSummary {
            name: row.get(0)?,
            entries: entries.unsigned_abs(),
            range: least.zip(row.get(4)?).filter(|_| numbers == entries),
        })
    })?;
    Ok(rows.collect::<rusqlite::Result<_>>()?)
}
