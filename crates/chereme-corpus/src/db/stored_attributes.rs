//! Rows of attributes: the properties of a sign in a table beyond its components.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use rusqlite::{Connection, params};

use super::people::{SIGNED_TOKENS_SQL, SIGNER_ATTRIBUTE_PREFIX};
use super::sign_relations::{RELATED_LABEL_SQL, RELATION_PREFIX, RELATIONS_SQL};
use super::signs::json_list;
use crate::db::cached_sql::CachedSql;
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

/// The beginning of the name of every attribute that the program measured.
pub(crate) const MEASURE_PREFIX: &str = "measure.";

/// Sets the attributes that the program measured, and leaves those of tables as they are.
pub(crate) fn set_token_measures(connection: &Connection, token: i64, rows: &[AttributeRow]) -> CorpusResult<()> {
    let mut all = of_tokens(connection, &[token])?.remove(&token).unwrap_or_default();
    all.retain(|row| !row.name.starts_with(MEASURE_PREFIX));
    all.extend(rows.iter().cloned());
    set_token_attributes(connection, token, &all)
}

/// Sets the attributes of a token; leaves rows that do not change untouched.
pub(crate) fn set_token_attributes(connection: &Connection, token: i64, rows: &[AttributeRow]) -> CorpusResult<()> {
    if of_tokens(connection, &[token])?.remove(&token).unwrap_or_default() == rows {
        return Ok(());
    }
    connection.change_rows("DELETE FROM attribute WHERE token_id = ?1", [token])?;
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

/// Returns the names of all attributes, in order; those of signers begin with [`SIGNER_ATTRIBUTE_PREFIX`], and relations with
/// [`RELATION_PREFIX`].
pub(crate) fn list_attribute_names(connection: &Connection) -> CorpusResult<Vec<String>> {
    let sql = format!(
        "SELECT name FROM attribute UNION SELECT '{SIGNER_ATTRIBUTE_PREFIX}' || name FROM person_attribute
         UNION SELECT '{RELATION_PREFIX}' || name FROM {RELATIONS_SQL} ORDER BY 1"
    );
    connection.read_values(&sql, [])
}

/// Returns for each token the attributes of these names that count for it.
///
/// A row of a table has its own attributes alone; every other token of a sign has those of the sign's rows. The tokens of
/// a signer have what is said of the signer, and those of a sign its relations, whose text is the label of the other sign.
pub(crate) fn attributes_by_token(
    connection: &Connection,
    names: &[String],
) -> CorpusResult<BTreeMap<i64, Vec<Rc<AttributeRow>>>> {
    let mut by_token: BTreeMap<i64, Vec<Rc<AttributeRow>>> = BTreeMap::new();
    let mut by_sign: BTreeMap<i64, Vec<Rc<AttributeRow>>> = BTreeMap::new();
    let mut statement = connection.prepare_cached(
        "SELECT a.token_id, t.sign_id, a.text, a.number FROM attribute a
         JOIN token t ON t.id = a.token_id WHERE a.name = ?1",
    )?;
    for name in names {
        let mut rows = statement.query([name])?;
        while let Some(row) = rows.next()? {
            let attribute_row = Rc::new(AttributeRow {
                name: name.clone(),
                text: row.get(2)?,
                number: row.get(3)?,
            });
            by_token.entry(row.get(0)?).or_default().push(attribute_row.clone());
            by_sign.entry(row.get(1)?).or_default().push(attribute_row);
        }
    }
    let signs: Vec<i64> = by_sign.keys().copied().collect();
    // A row of a table is known by its cells; it must not take attributes of the sign's other rows.
    let sql = "SELECT id, sign_id FROM token WHERE sign_id IN (SELECT value FROM json_each(?1))
             AND NOT (origin = 'lexicon' AND coalesce(instr(source, '\"cells\":'), 0))";
    connection.visit_rows(sql, [json_list(&signs)], |row| {
        let sign: i64 = row.get(1)?;
        by_token.entry(row.get(0)?).or_insert_with(|| by_sign[&sign].clone());
        Ok(())
    })?;
    let signer_attributes = names
        .iter()
        .filter_map(|name| name.strip_prefix(SIGNER_ATTRIBUTE_PREFIX));
    let mut statement = connection.prepare_cached(&format!(
        "SELECT t.id, v.text, v.number FROM {SIGNED_TOKENS_SQL}
         JOIN person_attribute v ON v.signer_id = coalesce(p.id, r.signer_id) WHERE v.name = ?1"
    ))?;
    for name in signer_attributes {
        let mut rows = statement.query([name])?;
        while let Some(row) = rows.next()? {
            let attribute_row = Rc::new(AttributeRow {
                name: format!("{SIGNER_ATTRIBUTE_PREFIX}{name}"),
                text: row.get(1)?,
                number: row.get(2)?,
            });
            by_token.entry(row.get(0)?).or_default().push(attribute_row);
        }
    }
    let relations = names.iter().filter_map(|name| name.strip_prefix(RELATION_PREFIX));
    let mut statement = connection.prepare_cached(&format!(
        "SELECT t.id, {RELATED_LABEL_SQL} FROM {RELATIONS_SQL} JOIN sign own ON own.id = r.sign_id
         JOIN sign other ON other.id = r.related_id JOIN token t ON t.sign_id = r.sign_id WHERE r.name = ?1
         ORDER BY r.position"
    ))?;
    for name in relations {
        let mut rows = statement.query([name])?;
        while let Some(row) = rows.next()? {
            let attribute_row = Rc::new(AttributeRow {
                name: format!("{RELATION_PREFIX}{name}"),
                text: row.get(1)?,
                number: None,
            });
            by_token.entry(row.get(0)?).or_default().push(attribute_row);
        }
    }
    Ok(by_token)
}

/// Returns the tokens with an attribute of one of these names that passes, and all tokens with such an attribute.
pub(crate) fn tokens_that(
    connection: &Connection,
    names: &[String],
    passes: impl Fn(&AttributeRow) -> bool,
) -> CorpusResult<(BTreeSet<i64>, BTreeSet<i64>)> {
    let by_token = attributes_by_token(connection, names)?;
    let passing = by_token.iter().filter(|(_, rows)| rows.iter().any(|row| passes(row)));
    Ok((
        passing.map(|(token, _)| *token).collect(),
        by_token.into_keys().collect(),
    ))
}

/// Returns the day, in universal time, as `2026-11-29`.
pub(crate) fn current_day(connection: &Connection) -> CorpusResult<String> {
    Ok(connection.query_row("SELECT date('now')", [], |row| row.get(0))?)
}

/// A captured token of a sign: by whom, where and when.
pub(crate) struct SignUse {
    /// The row of the sign.
    pub(crate) sign: i64,
    /// The row of the recording.
    pub(crate) recording: i64,
    /// The row of the signer: the participant of its tier, otherwise that of the recording.
    pub(crate) signer: Option<i64>,
    /// The begin of the token.
    pub(crate) start_us: i64,
    /// The end of the token.
    pub(crate) end_us: i64,
}

/// Returns the captured tokens of all signs, by sign, recording, signer and time.
pub(crate) fn load_sign_uses(connection: &Connection) -> CorpusResult<Vec<SignUse>> {
    let sql = format!(
        "SELECT t.sign_id, t.recording_id, coalesce(p.id, r.signer_id) AS used_by, t.start_us, t.end_us
         FROM {SIGNED_TOKENS_SQL}
         WHERE t.origin = 'captured' ORDER BY t.sign_id, t.recording_id, used_by, t.start_us"
    );
    connection.read_rows(&sql, [], |row| {
        Ok(SignUse {
            sign: row.get(0)?,
            recording: row.get(1)?,
            signer: row.get(2)?,
            start_us: row.get(3)?,
            end_us: row.get(4)?,
        })
    })
}

/// Returns the sign of each of these tokens.
pub(crate) fn signs_of_tokens(connection: &Connection, tokens: &[i64]) -> CorpusResult<BTreeMap<i64, i64>> {
    let sql = "SELECT id, sign_id FROM token WHERE id IN (SELECT value FROM json_each(?1))";
    connection.read_rows(sql, [json_list(tokens)], |row| Ok((row.get(0)?, row.get(1)?)))
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
    let sql = "SELECT name, count(*), count(number), min(number), max(number) FROM attribute
         GROUP BY name ORDER BY min(id)";
    connection.read_rows(sql, [], |row| {
        let (entries, numbers): (i64, i64) = (row.get(1)?, row.get(2)?);
        let least: Option<f64> = row.get(3)?;
        Ok(AttributeSummary {
            name: row.get(0)?,
            entries: entries.unsigned_abs(),
            range: least.zip(row.get(4)?).filter(|_| numbers == entries),
        })
    })
}
