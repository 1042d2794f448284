//! Seals: checksums of rows, by which damage is found that the database itself cannot see.
//!
//! The rows of a table lie in buckets by their number. The seal of a bucket is the exclusive or of the first 8 bytes of the
//! SHA-256 of its rows, as history writes them; so a changed row takes its old image out of the seal and puts the new one
//! in, and damage to other rows of the bucket stays visible. An operation has two seals: of its row, and of its changeset.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use rusqlite::{Connection, params};
use serde_json::json;
use sha2::{Digest as _, Sha256};

use super::damaged_row_error;
use super::stored_history::tracked::{TRACKED_TABLE_REFERENCES, load_table_columns, row_image};
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

/// Tables with a row for each sign, annotation or block; [`SHARED_BITS`] says how many of their rows share a seal. Each
/// row of the other tables has its own.
const SHARED_SEAL_TABLES: [&str; 10] = [
    "annotation",
    "attribute",
    "channel",
    "sign",
    "sign_relation",
    "sign_text",
    "study_answer",
    "token",
    "token_value",
    "track_block",
];
/// The number of rows that share a seal, as a power of two.
const SHARED_BITS: u32 = 6;
const OPERATION_TABLE_NAME: &str = "operation";
const CHANGESET_TABLE_NAME: &str = "changeset";

/// Rows that are not as the program stored them; one or more of them were changed, added or removed.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct BrokenSeal {
    pub(crate) table: &'static str,
    pub(crate) rows: RangeInclusive<i64>,
}

/// The fault of rows that do not have their seal.
pub(crate) const NOT_AS_STORED: &str = "its content does not match its checksum";

impl BrokenSeal {
    /// Returns the error of work that needs these rows.
    pub(crate) fn broken_seal_error(&self) -> CorpusError {
        damaged_row_error(self.to_string(), NOT_AS_STORED)
    }
}

impl std::fmt::Display for BrokenSeal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (table, first, last) = (self.table, self.rows.start(), self.rows.end());
        match (first == last, table) {
            (_, "meta") => write!(f, "a row of meta"),
            (true, _) => write!(f, "row {first} of {table}"),
            (false, _) => write!(f, "one of the rows {first} to {last} of {table}"),
        }
    }
}

/// Returns the tables whose rows have seals.
pub(crate) fn sealed_tables() -> impl Iterator<Item = &'static str> {
    let tracked = TRACKED_TABLE_REFERENCES.iter().map(|(table, _)| *table);
    tracked.chain([OPERATION_TABLE_NAME, CHANGESET_TABLE_NAME])
}

/// The changes of seals that an operation brings about.
#[derive(Default)]
pub(super) struct SealChanges(BTreeMap<(&'static str, i64), u64>);

impl SealChanges {
    /// Takes a row's image out of its seal, or puts it in.
    pub(super) fn turn_row(&mut self, table: &str, image: &str) {
        if let Some(table) = sealed_tables().find(|name| *name == table) {
            self.toggle_seal_sum(table, bucket_of(table, image), checksum(&[image.as_bytes()]));
        }
    }

    /// Puts a part of a changeset into the operation's seal.
    pub(super) fn turn_part(&mut self, operation: i64, part: i64, data: &[u8]) {
        self.toggle_seal_sum(CHANGESET_TABLE_NAME, operation, part_checksum(part, data));
    }

    fn toggle_seal_sum(&mut self, table: &'static str, bucket: i64, sum: u64) {
        *self.0.entry((table, bucket)).or_default() ^= sum;
    }

    /// Stores the seals as they are with the row of the operation itself.
    pub(super) fn store_seal_changes(mut self, connection: &Connection, operation: i64) -> CorpusResult<()> {
        for (bucket, sum) in row_sums(connection, OPERATION_TABLE_NAME, &(operation..=operation))? {
            self.toggle_seal_sum(OPERATION_TABLE_NAME, bucket, sum);
        }
        for ((table, bucket), change) in self.0 {
            // Exclusive or takes out what it put in, so that the old images vanish and the new ones remain.
            let before = stored_seal(connection, table, bucket)?;
            store_seal(connection, table, bucket, before ^ change)?;
        }
        Ok(())
    }
}

/// Computes the seals of tables from their rows as they are.
pub(crate) fn seal_tables(connection: &Connection, tables: impl IntoIterator<Item = &'static str>) -> CorpusResult<()> {
    for table in tables {
        connection.execute("DELETE FROM row_seal WHERE tbl = ?1", [table])?;
        for (bucket, sum) in row_sums(connection, table, &ALL_ROWS)? {
            store_seal(connection, table, bucket, sum)?;
        }
    }
    Ok(())
}

/// Returns the rows of a table that do not have their seal.
pub(crate) fn broken_seals(connection: &Connection, table: &'static str) -> CorpusResult<Vec<BrokenSeal>> {
    let mut differing = row_sums(connection, table, &ALL_ROWS)?;
    let mut statement = connection.prepare("SELECT bucket, seal FROM row_seal WHERE tbl = ?1")?;
    let mut stored = statement.query([table])?;
    while let Some(row) = stored.next()? {
        *differing.entry(row.get(0)?).or_default() ^= row.get::<_, i64>(1)?.cast_unsigned();
    }
    differing.retain(|_, difference| *difference != 0);
    Ok(differing
        .into_keys()
        .map(|bucket| broken_seal_of_bucket(table, bucket))
        .collect())
}

/// Returns the first rows without their seal among those of a table whose numbers `ids` selects; `?1` in it is `scope`.
fn first_broken(
    connection: &Connection,
    table: &'static str,
    ids: &str,
    scope: &str,
) -> CorpusResult<Option<BrokenSeal>> {
    let sql = format!(
        "SELECT DISTINCT id >> {} FROM ({ids}) WHERE id IS NOT NULL",
        bucket_bits(table)
    );
    let mut statement = connection.prepare_cached(&sql)?;
    let mut buckets = statement.query([scope])?;
    while let Some(row) = buckets.next()? {
        let broken = broken_seal_of_bucket(table, row.get(0)?);
        let sums = row_sums(connection, table, &broken.rows)?;
        let seal = stored_seal(connection, table, row.get(0)?)?;
        // A bucket without rows has no seal, which counts as 0.
        if sums.into_values().next().unwrap_or_default() != seal {
            return Ok(Some(broken));
        }
    }
    Ok(None)
}

const ALL_ROWS: RangeInclusive<i64> = i64::MIN..=i64::MAX;

/// Returns the number of bits of a row's number within its bucket.
fn bucket_bits(table: &str) -> u32 {
    if SHARED_SEAL_TABLES.contains(&table) {
        SHARED_BITS
    } else {
        0
    }
}

fn broken_seal_of_bucket(table: &'static str, bucket: i64) -> BrokenSeal {
    let first = bucket << bucket_bits(table);
    let last = first + (1 << bucket_bits(table)) - 1;
    BrokenSeal {
        table,
        rows: first..=last,
    }
}

/// Returns the bucket of a row by its image, which begins with its number; rows without numbers share one.
fn bucket_of(table: &str, image: &str) -> i64 {
    let number = image.strip_prefix("{\"id\":").unwrap_or_default();
    let end = number.find([',', '}']).unwrap_or_default();
    number[..end].parse::<i64>().unwrap_or_default() >> bucket_bits(table)
}

fn checksum(parts: &[&[u8]]) -> u64 {
    let mut digest = Sha256::new();
    for part in parts {
        digest.update(part);
    }
    let first = digest.finalize().first_chunk().copied();
    u64::from_be_bytes(first.unwrap_or_default())
}

fn part_checksum(part: i64, data: &[u8]) -> u64 {
    checksum(&[&part.to_le_bytes(), data])
}

/// Returns the sums of the buckets of those rows, as their seals should be.
fn row_sums(connection: &Connection, table: &str, rows: &RangeInclusive<i64>) -> CorpusResult<BTreeMap<i64, u64>> {
    let mut sums = BTreeMap::<i64, u64>::new();
    let range = [rows.start(), rows.end()];
    if table == CHANGESET_TABLE_NAME {
        let sql = "SELECT operation_id, part, data FROM changeset WHERE operation_id BETWEEN ?1 AND ?2";
        connection.visit_rows(sql, range, |row| {
            let data = row.get_ref(2)?.as_blob().map_err(rusqlite::Error::from)?;
            *sums.entry(row.get(0)?).or_default() ^= part_checksum(row.get(1)?, data);
            Ok(())
        })?;
        return Ok(sums);
    }
    let columns = load_table_columns(connection, table)?;
    // A table without numbers is read as a whole; the condition only uses up both parameters.
    let wanted = match columns.first() {
        Some(key) if key.name == "id" => "r.id BETWEEN ?1 AND ?2",
        _ => "?1 <= ?2",
    };
    let image = row_image(&columns, "r");
    let sql = format!("SELECT {image} FROM main.{table} AS r WHERE {wanted}");
    connection.visit_rows(&sql, range, |row| {
        let image = row.get_ref(0)?.as_str().map_err(rusqlite::Error::from)?;
        *sums.entry(bucket_of(table, image)).or_default() ^= checksum(&[image.as_bytes()]);
        Ok(())
    })?;
    Ok(sums)
}

pub(super) fn stored_seal(connection: &Connection, table: &str, bucket: i64) -> CorpusResult<u64> {
    let sql = "SELECT seal FROM row_seal WHERE tbl = ?1 AND bucket = ?2";
    let seal: Option<i64> = connection.find_value(sql, params![table, bucket])?;
    Ok(seal.unwrap_or_default().cast_unsigned())
}

pub(super) fn store_seal(connection: &Connection, table: &str, bucket: i64, seal: u64) -> CorpusResult<()> {
    // No rows give the sum 0, and an empty bucket keeps no row of its own.
    let sql = if seal == 0 {
        "DELETE FROM row_seal WHERE tbl = ?1 AND bucket = ?2 AND ?3 = 0"
    } else {
        "INSERT INTO row_seal (tbl, bucket, seal) VALUES (?1, ?2, ?3)
         ON CONFLICT DO UPDATE SET seal = excluded.seal"
    };
    let seal = seal.cast_signed();
    connection.change_rows(sql, params![table, bucket, seal])
}

/// What is written of recordings, by table; `?1` holds their numbers as JSON.
const OF_RECORDINGS: [(&str, &str); 9] = [
    ("recording", "SELECT value AS id FROM json_each(?1)"),
    (
        "signer",
        "SELECT signer_id AS id FROM recording WHERE id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "source_file",
        "SELECT id FROM source_file WHERE recording_id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "track",
        "SELECT id FROM track WHERE recording_id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "skeleton",
        "SELECT skeleton_id AS id FROM track WHERE recording_id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "track_block",
        "SELECT id FROM track_block WHERE track_id IN (
             SELECT id FROM track WHERE recording_id IN (SELECT value FROM json_each(?1)))",
    ),
    (
        "channel",
        "SELECT id FROM channel WHERE track_id IN (
             SELECT id FROM track WHERE recording_id IN (SELECT value FROM json_each(?1)))",
    ),
    (
        "tier",
        "SELECT id FROM tier WHERE recording_id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "annotation",
        "SELECT id FROM annotation WHERE tier_id IN (
             SELECT id FROM tier WHERE recording_id IN (SELECT value FROM json_each(?1)))",
    ),
];

/// What is written of tokens, by table; `?1` holds their numbers as JSON.
const OF_TOKENS: [(&str, &str); 8] = [
    ("token", "SELECT value AS id FROM json_each(?1)"),
    (
        "recording",
        "SELECT recording_id AS id FROM token WHERE id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "sign",
        "SELECT sign_id AS id FROM token WHERE id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "lexicon",
        "SELECT lexicon_id AS id FROM sign WHERE id IN (
             SELECT sign_id FROM token WHERE id IN (SELECT value FROM json_each(?1)))",
    ),
    (
        "sign_text",
        "SELECT id FROM sign_text WHERE sign_id IN (
             SELECT sign_id FROM token WHERE id IN (SELECT value FROM json_each(?1)))",
    ),
    (
        "token_value",
        "SELECT id FROM token_value WHERE token_id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "notation",
        "SELECT id FROM notation WHERE token_id IN (SELECT value FROM json_each(?1))",
    ),
    (
        "attribute",
        "SELECT id FROM attribute WHERE token_id IN (SELECT value FROM json_each(?1))",
    ),
];

/// Returns the tables from which everything is written, or all tokens.
pub(crate) fn tables_of(are_tokens: bool) -> impl Iterator<Item = &'static str> {
    let recordings = (!are_tokens).then_some(OF_RECORDINGS);
    let tables = recordings.into_iter().flatten().chain(OF_TOKENS);
    tables.map(|(table, _)| table)
}

/// Fails at the first row of any recording, token or inventory that does not have its seal.
pub(crate) fn verify_material(connection: &Connection) -> CorpusResult<()> {
    let tables = tables_of(false).chain(["inventory", "inventory_value"]);
    verify_tables(connection, tables)
}

/// Fails at the first row of these recordings, with their tiers and movement, that does not have its seal.
pub(crate) fn verify_recordings(connection: &Connection, recordings: &[i64]) -> CorpusResult<()> {
    verify_scope(connection, &OF_RECORDINGS, recordings)
}

/// Fails at the first row of these tokens, with their signs and values, that does not have its seal.
pub(crate) fn verify_tokens(connection: &Connection, tokens: &[i64]) -> CorpusResult<()> {
    verify_scope(connection, &OF_TOKENS, tokens)
}

/// Fails if the changeset of an operation is not as it was stored.
pub(super) fn verify_changeset(connection: &Connection, operation: i64) -> CorpusResult<()> {
    let itself = [(CHANGESET_TABLE_NAME, "SELECT value AS id FROM json_each(?1)")];
    verify_scope(connection, &itself, &[operation])
}

/// Fails at the first row of these tables that does not have its seal.
pub(crate) fn verify_tables(
    connection: &Connection,
    tables: impl IntoIterator<Item = &'static str>,
) -> CorpusResult<()> {
    for table in tables {
        if let Some(broken) = broken_seals(connection, table)?.first() {
            return Err(broken.broken_seal_error());
        }
    }
    Ok(())
}

fn verify_scope(connection: &Connection, tables: &[(&'static str, &str)], numbers: &[i64]) -> CorpusResult<()> {
    let scope = json!(numbers).to_string();
    for (table, ids) in tables {
        if let Some(broken) = first_broken(connection, table, ids, &scope)? {
            return Err(broken.broken_seal_error());
        }
    }
    Ok(())
}
