//! Rows that the search index needs, and the storage of its files in the database.

mod documents;
pub(crate) mod search_answers;
pub(crate) mod search_terms;

use rusqlite::{Connection, Transaction, TransactionBehavior, params};

use super::seals;
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};

pub(crate) use documents::{TokenDocument, visit_token_documents};

/// Returns the tokens that the running operation touched.
pub(crate) fn list_touched_tokens(connection: &Connection) -> CorpusResult<Vec<i64>> {
    connection.read_values("SELECT token_id FROM temp.touched ORDER BY token_id", [])
}

/// Returns the number of row changes of the running operation that the schema's counter has counted.
pub(crate) fn count_token_touches(connection: &Connection) -> CorpusResult<i64> {
    // These are the changes that the triggers of the schema count, which a change of either must keep equal.
    let sql = "SELECT count(*) FROM temp.change
             WHERE tbl IN ('token', 'token_value', 'sign_text', 'annotation')
                OR (kind = 'u' AND tbl IN ('sign', 'tier', 'recording', 'signer', 'lexicon'))
                OR (kind <> 'u' AND tbl = 'source_file'
                    AND coalesce(after, before) ->> '$.recording_id' IS NOT NULL)";
    let count = connection.read_value(sql, [])?;
    Ok(count)
}

/// The two counters that show whether the index is up to date with the rows, and the format that it was built in.
pub(crate) struct SearchIndexState {
    pub(crate) content: i64,
    pub(crate) indexed: i64,
    pub(crate) format: i64,
}

impl SearchIndexState {
    pub(crate) fn read_index_state(connection: &Connection) -> CorpusResult<Self> {
        let sql = "SELECT content, indexed, format FROM search_state WHERE id = 1";
        connection.read_row(sql, [], |row| {
            Ok(Self {
                content: row.get(0)?,
                indexed: row.get(1)?,
                format: row.get(2)?,
            })
        })
    }

    /// Records that an index of `format` includes the first `indexed` changes.
    pub(crate) fn record_indexed_changes(connection: &Connection, indexed: i64, format: i64) -> CorpusResult<()> {
        connection.execute(
            "UPDATE search_state SET indexed = ?1, format = ?2 WHERE id = 1",
            [indexed, format],
        )?;
        Ok(())
    }
}

/// Begins a writing transaction on a connection that is only borrowed.
pub(crate) fn begin_write_transaction(connection: &Connection) -> CorpusResult<Transaction<'_>> {
    Ok(Transaction::new_unchecked(connection, TransactionBehavior::Immediate)?)
}

/// Begins a transaction that reads one state of the rows, on a borrowed connection.
pub(crate) fn begin_reading(connection: &Connection) -> CorpusResult<Transaction<'_>> {
    Ok(Transaction::new_unchecked(connection, TransactionBehavior::Deferred)?)
}

/// Returns the names of the index's files.
pub(crate) fn file_names(connection: &Connection) -> CorpusResult<Vec<String>> {
    // Performances of faces lie beside the index's files, and are no part of it.
    connection.read_values("SELECT path FROM search_file WHERE path NOT LIKE 'faces/%'", [])
}

/// Returns a file of the index as it was stored.
///
/// # Errors
/// [`Error::Index`] if its bytes do not match their checksum.
pub(crate) fn read_index_file(connection: &Connection, path: &str) -> CorpusResult<Vec<u8>> {
    let sql = "SELECT data, checksum FROM search_file WHERE path = ?1";
    let (data, checksum): (Vec<u8>, u32) = connection.read_row(sql, [path], |row| Ok((row.get(0)?, row.get(1)?)))?;
    if crc32fast::hash(&data) != checksum {
        let reason = format!("its file {path:?} is not as it was stored");
        return Err(CorpusError::Index(reason.into()));
    }
    Ok(data)
}

/// The table of the index's files; they share a seal.
const INDEX_FILES: &str = "search_file";

/// Returns the checksum of the names and checksums of the index's files.
fn files_sum(connection: &Connection) -> CorpusResult<u64> {
    let sql = "SELECT path, checksum FROM search_file WHERE path NOT LIKE 'faces/%' ORDER BY path";
    let mut statement = connection.prepare_cached(sql)?;
    let mut rows = statement.query([])?;
    let mut sum = crc32fast::Hasher::new();
    while let Some(row) = rows.next()? {
        sum.update(row.get_ref(0)?.as_bytes().map_err(rusqlite::Error::from)?);
        sum.update(&row.get::<_, i64>(1)?.to_le_bytes());
    }
    Ok(sum.finalize().into())
}

/// Returns whether the index has the files that were stored last, each with the checksum of then.
pub(crate) fn has_stored_files(connection: &Connection) -> CorpusResult<bool> {
    Ok(seals::stored_seal(connection, INDEX_FILES, 0)? == files_sum(connection)?)
}

/// Records the index's files as they are.
pub(crate) fn seal_files(connection: &Connection) -> CorpusResult<()> {
    seals::store_seal(connection, INDEX_FILES, 0, files_sum(connection)?)
}

/// Returns the names of files whose bytes do not match their checksum.
pub(crate) fn damaged_files(connection: &Connection) -> CorpusResult<Vec<String>> {
    let mut statement = connection.prepare("SELECT path, data, checksum FROM search_file")?;
    let mut rows = statement.query([])?;
    let mut damaged = Vec::new();
    while let Some(row) = rows.next()? {
        let data = row.get_ref(1)?.as_blob().map_err(rusqlite::Error::from)?;
        if i64::from(crc32fast::hash(data)) != row.get::<_, i64>(2)? {
            damaged.push(row.get(0)?);
        }
    }
    Ok(damaged)
}

/// Writes a file of the index.
pub(crate) fn write_file(connection: &Connection, path: &str, data: &[u8]) -> CorpusResult<()> {
    let sql = "INSERT INTO search_file (path, data, checksum) VALUES (?1, ?2, ?3)
             ON CONFLICT (path) DO UPDATE SET data = excluded.data, checksum = excluded.checksum";
    connection.change_rows(sql, params![path, data, crc32fast::hash(data)])
}

/// Deletes a file of the index.
pub(crate) fn delete_file(connection: &Connection, path: &str) -> CorpusResult<()> {
    connection.change_rows("DELETE FROM search_file WHERE path = ?1", [path])
}

/// Deletes all files of the index.
pub(crate) fn delete_files(connection: &Connection) -> CorpusResult<()> {
    // A corpus without an index is whole: the next search builds it.
    connection.execute_batch("DELETE FROM search_file; UPDATE search_state SET format = 0;")?;
    Ok(())
}
