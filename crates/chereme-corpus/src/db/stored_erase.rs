//! Rows that are removed for good, and the search for what is left of them in the bytes of the file.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};

use rusqlite::types::ValueRef;
use rusqlite::{Connection, TransactionBehavior};

use super::dump::{self, OmittedRows};
use super::people;
use super::stale_log::companion_path;
use super::stored_merge;
use super::stored_motion::to_hex_text;
use super::{CorpusStore, DerivedData};
use crate::db::cached_sql::CachedSql;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;

/// Shorter texts are searched for in rows alone: numbers of movement hold the same bytes by chance.
const LEAST_TRACE_BYTES: usize = 6;
/// How much of the file is searched at once, in bytes.
const SEARCHED_CHUNK_BYTES: usize = 16 << 20;
/// How many bytes at its beginning find a trace.
const TRACE_HEAD_BYTES: usize = 3;

/// What was in the corpus of a person, to be searched for afterwards.
pub(crate) struct ErasedTraces {
    texts: BTreeSet<String>,
    /// Hashes of blocks and identities of rows.
    bytes: BTreeSet<Vec<u8>>,
}

/// The result of a search for traces.
pub(crate) struct TraceProof {
    /// How many were searched for.
    pub(crate) searched: usize,
    /// Texts that rows of others say, with the table.
    pub(crate) said: BTreeMap<String, String>,
    /// Traces that are in the bytes, and in no row.
    pub(crate) left: Vec<String>,
}

impl ErasedTraces {
    /// Collects names, texts, identities and hashes of blocks that only these recordings have.
    pub(crate) fn collect_traces(
        connection: &Connection,
        signer: i64,
        recordings: &BTreeSet<i64>,
    ) -> CorpusResult<Self> {
        let mut traces = Self {
            texts: BTreeSet::new(),
            bytes: BTreeSet::new(),
        };
        traces.add_traces("SELECT name FROM signer WHERE id = ?1", signer, connection)?;
        traces.add_traces("SELECT uid FROM signer WHERE id = ?1", signer, connection)?;
        traces.add_traces("SELECT name FROM person_alias WHERE signer_id = ?1", signer, connection)?;
        for recording in recordings {
            // A name alone may be common, so identities and hashes are searched for as well.
            for sql in [
                "SELECT name FROM recording WHERE id = ?1 UNION SELECT notes FROM recording WHERE id = ?1",
                "SELECT uid FROM recording WHERE id = ?1",
                "SELECT uid FROM token WHERE recording_id = ?1",
                "SELECT uid FROM track WHERE recording_id = ?1",
                "SELECT uid FROM tier WHERE recording_id = ?1",
                "SELECT name FROM tier WHERE recording_id = ?1 UNION SELECT participant FROM tier WHERE recording_id = ?1",
                "SELECT value FROM annotation a JOIN tier t ON t.id = a.tier_id WHERE t.recording_id = ?1",
                "SELECT s.gloss FROM sign s JOIN token t ON t.sign_id = s.id WHERE t.recording_id = ?1",
                "SELECT name FROM source_file WHERE recording_id = ?1
                 UNION SELECT hash FROM source_file WHERE recording_id = ?1",
                "SELECT text FROM recipe WHERE recording_id = ?1",
                "SELECT b.hash FROM track_block b JOIN track t ON t.id = b.track_id WHERE t.recording_id = ?1",
            ] {
                traces.add_traces(sql, *recording, connection)?;
            }
        }
        Ok(traces)
    }

    fn add_traces(&mut self, sql: &str, id: i64, connection: &Connection) -> CorpusResult<()> {
        connection.visit_rows(sql, [id], |row| {
            match row.get_ref(0)? {
                ValueRef::Text(text) => {
                    let text = String::from_utf8_lossy(text).trim().to_owned();
                    // A shorter text cannot be found by its first bytes, and occurs everywhere by chance.
                    if text.len() >= TRACE_HEAD_BYTES {
                        self.texts.insert(text);
                    }
                }
                ValueRef::Blob(bytes) => drop(self.bytes.insert(bytes.to_owned())),
                _ => {}
            }
            Ok(())
        })
    }

    /// Searches the rows and the bytes of the file and of its log.
    pub(crate) fn search_traces(&self, connection: &Connection, path: &Path) -> CorpusResult<TraceProof> {
        let texts = TraceFinder::from_traces(self.texts.iter().map(String::as_bytes));
        let all_bytes = self.bytes.iter().map(Vec::as_slice);
        let identities = TraceFinder::from_traces(all_bytes.clone());
        let mut said: BTreeMap<String, String> = BTreeMap::new();
        let mut known_bytes: BTreeSet<Vec<u8>> = BTreeSet::new();
        for table in dump::all_tables(connection)? {
            dump::visit_table_cells(connection, &table, |cell| match cell {
                ValueRef::Text(text) => {
                    for trace in texts.traces_in(text) {
                        let text = String::from_utf8_lossy(trace).into_owned();
                        // One table is enough to show the user where the text is still said.
                        said.entry(text).or_insert_with(|| table.clone());
                    }
                }
                // A block that another recording has, too, keeps its hash.
                ValueRef::Blob(bytes) if bytes.len() <= 32 => {
                    known_bytes.extend(identities.traces_in(bytes).into_iter().map(<[u8]>::to_owned));
                }
                _ => {}
            })?;
        }
        let long_texts = self.texts.iter().filter(|text| text.len() >= LEAST_TRACE_BYTES);
        let searched_bytes = long_texts
            // Texts of other rows lie in the bytes rightfully.
            .filter(|text| !said.contains_key(*text))
            .map(String::as_bytes)
            .chain(all_bytes.filter(|bytes| !known_bytes.contains(*bytes)));
        let finder = TraceFinder::from_traces(searched_bytes);
        let mut left = BTreeSet::new();
        // The last changes may still lie in the log beside the file.
        for file in [path.to_owned(), companion_path(path, "-wal")] {
            finder.search_file(&file, &mut left)?;
        }
        let left = left.iter().map(|trace| match std::str::from_utf8(trace) {
            // A hash is no text, and is shown by its digits.
            Ok(text) => text.to_owned(),
            Err(_) => to_hex_text(trace),
        });
        Ok(TraceProof {
            searched: self.texts.len() + self.bytes.len(),
            said,
            left: left.collect(),
        })
    }
}

/// Traces by their first bytes.
struct TraceFinder<'a> {
    by_head: BTreeMap<[u8; TRACE_HEAD_BYTES], Vec<&'a [u8]>>,
    /// Whether a trace begins with two bytes.
    heads: Vec<bool>,
    longest: usize,
}

impl<'a> TraceFinder<'a> {
    fn from_traces(traces: impl Iterator<Item = &'a [u8]>) -> Self {
        let mut finder = Self {
            by_head: BTreeMap::new(),
            heads: vec![false; 1 << 16],
            longest: 0,
        };
        for trace in traces {
            if let Some(head) = trace.first_chunk::<TRACE_HEAD_BYTES>() {
                finder.by_head.entry(*head).or_default().push(trace);
                finder.heads[usize::from(head[0]) << 8 | usize::from(head[1])] = true;
                finder.longest = finder.longest.max(trace.len());
            }
        }
        finder
    }

    fn traces_in(&self, bytes: &[u8]) -> BTreeSet<&'a [u8]> {
        let mut present = BTreeSet::new();
        for start in 0..bytes.len().saturating_sub(TRACE_HEAD_BYTES - 1) {
            let rest = &bytes[start..];
            // This test of two bytes rules out nearly all places at little cost.
            if self.heads[usize::from(rest[0]) << 8 | usize::from(rest[1])]
                && let Some(traces) = rest.first_chunk().and_then(|head| self.by_head.get(head))
            {
                present.extend(traces.iter().copied().filter(|trace| rest.starts_with(trace)));
            }
        }
        present
    }

    /// Adds the traces that a file holds; one that is not there holds none.
    fn search_file(&self, path: &Path, left: &mut BTreeSet<&'a [u8]>) -> CorpusResult<()> {
        let fault = |error| CorpusError::from_file_failure(path, error);
        if !path.exists() {
            return Ok(());
        }
        let mut file = File::open(path).map_err(fault)?;
        let mut chunk = Vec::new();
        loop {
            // The end of a chunk is searched again with the next one.
            let kept = chunk.len().min(self.longest);
            chunk.drain(..chunk.len() - kept);
            let more = (&mut file).take(SEARCHED_CHUNK_BYTES as u64).read_to_end(&mut chunk);
            if more.map_err(fault)? == 0 {
                // Closing the file would take the locks from the connections of this process.
                std::mem::forget(file);
                return Ok(());
            }
            left.extend(self.traces_in(&chunk));
        }
    }
}

/// Returns the older versions of a corpus that the program left beside it, and the logs that belong to them.
pub(crate) fn older_versions(path: &Path) -> Vec<PathBuf> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default();
    let main = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut all = Vec::new();
    for entry in fs::read_dir(folder.unwrap_or(Path::new(".")))
        .into_iter()
        .flatten()
        .flatten()
    {
        let (other, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        let marks = [format!("{stem}.version-"), format!("{stem}.rescued")];
        // Files of others beside the corpus may begin alike.
        let is_copy = other.extension() == Some(extension) && marks.iter().any(|mark| name.starts_with(mark));
        if is_copy || name == format!("{main}-wal.stale") {
            all.push(other);
        }
    }
    all.sort();
    all
}

/// Returns the name of a person and the other ones.
fn person_names(connection: &Connection, person: i64) -> CorpusResult<Vec<String>> {
    let sql = "SELECT name FROM signer WHERE id = ?1 UNION SELECT name FROM person_alias WHERE signer_id = ?1";
    connection.read_values(sql, [person])
}

/// Returns the names of the saved searches whose queries name a person.
pub(crate) fn searches_that_name(connection: &Connection, person: i64) -> CorpusResult<BTreeSet<String>> {
    let mut searches = BTreeSet::new();
    for name in person_names(connection, person)? {
        // One letter stands in every query.
        if name.chars().count() > 1 {
            let sql = "SELECT name FROM kept_search WHERE instr(lower(query), lower(?1)) > 0";
            searches.extend(connection.read_values::<String, Vec<_>>(sql, [name])?);
        }
    }
    Ok(searches)
}

impl<D: DerivedData> CorpusStore<D> {
    /// Removes a signer and recordings for good, with the history, and writes the file again.
    pub(crate) fn erase_signer(
        &mut self,
        signer: i64,
        recordings: &BTreeSet<i64>,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()> {
        self.require_sole_use()?;
        let erased = self.erase_in_transaction(signer, recordings);
        // Erasing is no operation, so that nothing of it may stay in the notes for one.
        self.connection
            .execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
        // The notes are deleted even if erasing failed, so the error is passed on only here.
        erased?;
        // The old index still holds texts of the person.
        self.index = D::default();
        self.rebuild_search_index(progress)?;
        // A statement that is still prepared would keep the file from being written again.
        self.connection.flush_prepared_statement_cache();
        // Deleted rows otherwise stay readable in free pages of the file.
        self.connection.execute_batch("VACUUM")?;
        let is_busy: bool = self
            .connection
            .query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |row| row.get(0))?;
        match is_busy {
            false => Ok(()),
            true => Err(self.shared_use_error()),
        }
    }

    /// Fails if another program has the file open: its log would keep what is removed here.
    fn require_sole_use(&self) -> CorpusResult<()> {
        // Only a program that is alone can leave this mode.
        let mode = self
            .connection
            .pragma_update_and_check(None, "journal_mode", "DELETE", |row| row.get(0));
        let is_alone = mode.is_ok_and(|mode: String| mode == "delete");
        self.connection.pragma_update(None, "journal_mode", "WAL")?;
        is_alone.then_some(()).ok_or_else(|| self.shared_use_error())
    }

    fn shared_use_error(&self) -> CorpusError {
        let message = "another program has the corpus open, so that its file cannot be written again";
        CorpusError::from_wrong_message(message)
            .with_error_place(self.path.display().to_string())
            .with_advice("close every program that has the corpus open, and forget the signer again")
    }

    fn erase_in_transaction(&mut self, signer: i64, recordings: &BTreeSet<i64>) -> CorpusResult<()> {
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)?;
        // Rows that refer to each other are removed one table after the other.
        transaction.execute_batch("PRAGMA defer_foreign_keys = ON")?;
        // The two versions of an undecided row may say something about the person.
        transaction.execute_batch("DELETE FROM meta WHERE key LIKE 'conflict:%'")?;
        for name in person_names(&transaction, signer)? {
            transaction.execute(
                "DELETE FROM meta WHERE key = 'preferred-annotator' AND value = ?1",
                [&name],
            )?;
        }
        for search in searches_that_name(&transaction, signer)? {
            transaction.execute("DELETE FROM kept_search WHERE name = ?1", [search])?;
        }
        let mut uids: Vec<String> = transaction.read_values("SELECT hex(uid) FROM signer WHERE id = ?1", [signer])?;
        for recording in recordings {
            uids.push(transaction.read_value("SELECT hex(uid) FROM recording WHERE id = ?1", [recording])?);
        }
        for uid in uids {
            stored_merge::set_note(&transaction, &stored_merge::forgotten_row_note(&uid), "1")?;
        }
        let omitted = OmittedRows {
            recordings,
            history: true,
            audience: None,
        };
        transaction.execute("UPDATE recording SET signer_id = NULL WHERE signer_id = ?1", [signer])?;
        people::delete_person(&transaction, signer)?;
        dump::erase_rows(&transaction, omitted)?;
        Ok(transaction.commit()?)
    }
}
