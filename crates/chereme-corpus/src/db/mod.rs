//! The database layer: the only place that contains SQL.
//!
//! [`CorpusStore`] is one open connection. Every change goes through [`CorpusStore::run_store_operation`], which runs it
//! in one transaction, records the rows before and after, and brings the search index along.

mod cached_sql;
pub(crate) mod consents;
pub(crate) mod dump;
pub(crate) mod edits;
pub(crate) mod file_identity;
pub(crate) mod lexicons;
pub(crate) mod notations;
mod open;
pub(crate) mod people;
pub(crate) mod recipes;
pub(crate) mod saved_searches;
pub(crate) mod seals;
pub(crate) mod sign_relations;
pub(crate) mod signs;
mod stale_log;
pub(crate) mod stored_attributes;
pub(crate) mod stored_check;
pub(crate) mod stored_columns;
pub(crate) mod stored_contents;
pub(crate) mod stored_delete;
pub(crate) mod stored_erase;
pub(crate) mod stored_history;
pub(crate) mod stored_info;
pub(crate) mod stored_inventories;
pub(crate) mod stored_list;
pub(crate) mod stored_merge;
pub(crate) mod stored_motion;
pub(crate) mod stored_recordings;
mod stored_roles;
pub(crate) mod stored_rows;
pub(crate) mod stored_search;
pub(crate) mod stored_spans;
pub(crate) mod stored_studies;
pub(crate) mod stored_tiers;
pub(crate) mod stored_tracks;
#[cfg(test)]
mod testing;
pub(crate) mod token_marks;
pub(crate) mod unfinished;
pub(crate) mod upgrade;

use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, TransactionBehavior};

use self::file_identity::FileIdentity;
use self::unfinished::UnfinishedFile;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::words::effect::OperationEffect;

pub(crate) use open::SCHEMA_VERSION;
pub use open::{SchemaUpgrade, on_waiting};
pub(crate) use stored_history::load_newest_operations as history_log;
pub use stored_history::{OperationKind, OperationRow};

/// Data derived from the rows and written in the same transaction, such as the search index.
pub(crate) trait DerivedData: Default {
    /// Brings the data up to date before they are read.
    fn refresh_derived_data(&mut self, connection: &Connection) -> CorpusResult<()>;

    /// Updates the data for the rows that the running operation touched, in its transaction.
    fn follow_operation(&mut self, connection: &Connection, progress: &mut ProgressReceiver<'_>) -> CorpusResult<()>;

    /// Derives the data again from all rows, inside the caller's transaction.
    fn rebuild_derived_data(
        &mut self,
        connection: &Connection,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<()>;
}

/// An open corpus file: its connection, the data derived from its rows, and the author of changes.
pub(crate) struct CorpusStore<D: DerivedData> {
    connection: Connection,
    path: PathBuf,
    author: String,
    index: D,
    upgrade: Option<SchemaUpgrade>,
    /// The file that was opened; it goes after the connection.
    place: OpenPlace,
    /// The copy that stands for a file of an older version; it goes after the connection.
    _copy: Option<UnfinishedFile>,
}

impl<D: DerivedData> CorpusStore<D> {
    /// Creates an empty corpus at `path`, which must not exist yet.
    ///
    /// `fill` writes the initial content of every corpus; that is not an operation and cannot be undone.
    pub(crate) fn create_corpus_store(
        path: &Path,
        author: &str,
        fill: impl FnOnce(&Connection) -> CorpusResult<()>,
    ) -> CorpusResult<Self> {
        let connection = open::create_corpus_file(path, fill)?;
        Self::store_from_connection(connection, path, author)
    }

    /// Opens the corpus at `path`, and upgrades its schema if that is older than this version's.
    pub(crate) fn open_corpus_store(path: &Path, author: &str) -> CorpusResult<Self> {
        let (connection, upgrade) = open::open_corpus_file(path)?;
        // A file that lost the row of its index is opened for `check`, which names that fault.
        let index_state = stored_search::SearchIndexState::read_index_state(&connection);
        let is_older = index_state.is_ok_and(|state| state.format < FIRST_FORMAT_WITH_OPINIONS);
        // A read-only file keeps its old index, which is read as it is.
        if is_older && !connection.is_readonly("main")? {
            upgrade::set_proposals_apart(&connection)?;
        }
        let mut store = Self::store_from_connection(connection, path, author)?;
        store.upgrade = upgrade;
        Ok(store)
    }

    /// Opens the corpus at `path`, whose file stays as it is; if its version is older, a copy beside `own` stands for it.
    pub(crate) fn open_unchanged(path: &Path, own: &Path, author: &str) -> CorpusResult<Self> {
        let (connection, copy) = open::open_unchanged(path, own)?;
        let mut store = Self::store_from_connection(connection, path, author)?;
        store._copy = copy;
        Ok(store)
    }

    fn store_from_connection(connection: Connection, path: &Path, author: &str) -> CorpusResult<Self> {
        // The triggers are temporary, so that each connection needs its own.
        stored_history::create_change_triggers(&connection)?;
        let (place, author) = (OpenPlace(FileIdentity::from_file_path(path)), author.to_owned());
        Ok(Self {
            connection,
            path: path.to_owned(),
            place,
            author,
            index: D::default(),
            upgrade: None,
            _copy: None,
        })
    }

    /// Returns the author of operations.
    pub(crate) fn store_author(&self) -> &str {
        &self.author
    }

    /// Returns what opening the file upgraded.
    pub(crate) fn store_upgrade(&self) -> Option<&SchemaUpgrade> {
        self.upgrade.as_ref()
    }

    /// Returns the path of the file.
    pub(crate) fn store_path(&self) -> &Path {
        &self.path
    }

    /// Writes a copy of the corpus to a new file.
    pub(crate) fn copy_store_file(&self, to: &Path) -> CorpusResult<()> {
        open::copy_corpus_file(&self.connection, to)
    }

    /// Returns the connection for reading.
    pub(crate) fn read_connection(&self) -> &Connection {
        &self.connection
    }

    /// Returns the connection and the search index brought up to date with it.
    pub(crate) fn searchable_connection(&mut self) -> CorpusResult<(&Connection, &D)> {
        self.index.refresh_derived_data(&self.connection)?;
        Ok((&self.connection, &self.index))
    }

    /// Runs `work` as one operation: all of it is stored, or nothing.
    ///
    /// `work` returns its result and what it did. Work that changes no row leaves no operation.
    pub(crate) fn run_store_operation<T>(
        &mut self,
        work: impl FnOnce(&Connection) -> CorpusResult<(T, OperationEffect)>,
    ) -> CorpusResult<T> {
        let progress = &mut ProgressReceiver::silent_progress();
        self.operation_with_progress(progress, |connection, _| work(connection))
    }

    /// Runs `work` as [`operation`](Self::operation) does, with progress reports; it can be stopped until everything is
    /// stored.
    pub(crate) fn operation_with_progress<T>(
        &mut self,
        progress: &mut ProgressReceiver<'_>,
        work: impl FnOnce(&Connection, &mut ProgressReceiver<'_>) -> CorpusResult<(T, OperationEffect)>,
    ) -> CorpusResult<T> {
        self.transact(progress, |connection, author, progress| {
            let operation = stored_history::begin_operation(connection, author)?;
            let (value, effect) = work(connection, progress)?;
            stored_history::finish_operation(connection, operation, &effect, progress)?;
            Ok(value)
        })
    }

    /// Undoes the newest operation that is in effect, and returns the undo.
    pub(crate) fn undo_store_operation(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<OperationRow> {
        self.transact(progress, stored_history::undo_newest_operation)
    }

    /// Redoes the operation that was undone last, and returns the redo.
    pub(crate) fn redo_store_operation(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<OperationRow> {
        self.transact(progress, stored_history::redo_undone_operation)
    }

    /// Returns the operations, newest first.
    pub(crate) fn store_operation_log(&self, limit: usize) -> CorpusResult<Vec<OperationRow>> {
        stored_history::load_newest_operations(&self.connection, limit)
    }

    /// Reports changesets that cannot be read.
    pub(crate) fn check_history(&self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<Vec<String>> {
        stored_history::check_changesets(&self.connection, progress)
    }

    /// Returns the search index as it was loaded last.
    pub(crate) fn index(&self) -> &D {
        &self.index
    }

    /// Computes the seals of tables from their rows as they are now.
    pub(crate) fn seal_again(&mut self, tables: impl IntoIterator<Item = &'static str>) -> CorpusResult<()> {
        let transaction = stored_search::begin_write_transaction(&self.connection)?;
        seals::seal_tables(&transaction, tables)?;
        Ok(transaction.commit()?)
    }

    /// Builds the search index again from the rows.
    pub(crate) fn rebuild_search_index(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<()> {
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)?;
        let done = self
            .index
            .rebuild_derived_data(&transaction, progress)
            .and_then(|()| Ok(transaction.commit()?));
        // The index in memory may have followed rows that were rolled back, so that it is read again.
        if done.is_err() {
            self.index = D::default();
        }
        done
    }

    fn transact<T>(
        &mut self,
        progress: &mut ProgressReceiver<'_>,
        work: impl FnOnce(&Connection, &str, &mut ProgressReceiver<'_>) -> CorpusResult<T>,
    ) -> CorpusResult<T> {
        let not_here = |error: CorpusError| error.of_file(&self.path);
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)
            .map_err(|error| not_here(error.into()))?;
        transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
        let done = work(&transaction, &self.author, progress).and_then(|value| {
            self.index.follow_operation(&transaction, progress)?;
            transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
            // From here on it cannot be stopped.
            progress.report_amount(ProgressUnit::Items, "storing", 0, None)?;
            transaction.commit()?;
            Ok(value)
        });
        if done.is_err() {
            self.index = D::default();
        }
        let value = done.map_err(|error| error.of_file(&self.path))?;
        // The commit succeeds on an open file even if its name is gone or names another file.
        if self.place.0.is_same_file_present() {
            return Ok(value);
        }
        // What is stored lies in a file that the path no longer names.
        Err(CorpusError::Displaced {
            path: self.path.clone(),
            rescued: open::copy_beside(&self.connection, &self.path, "rescued")?,
        })
    }
}

/// The first format of the search index whose tokens keep what does not count apart from their values.
const FIRST_FORMAT_WITH_OPINIONS: i64 = 4;

/// The file of an open corpus.
struct OpenPlace(FileIdentity);

impl Drop for OpenPlace {
    /// Removes the emptied companions of a file that is not at its path any more, so that none is taken for one of the
    /// file that is there now.
    fn drop(&mut self) {
        if self.0.is_same_file_present() {
            return;
        }
        let sibling_path = |ending| stale_log::companion_path(self.0.identity_path(), ending);
        let log = sibling_path("-wal");
        if log.metadata().is_ok_and(|log| log.len() == 0) {
            // A failure is harmless: an empty log changes nothing.
            drop(std::fs::remove_file(log));
            drop(std::fs::remove_file(sibling_path("-shm")));
        }
    }
}

impl<D: DerivedData> Drop for CorpusStore<D> {
    fn drop(&mut self) {
        // Closing leaves one single file without companions. A failure is harmless, since the next opening does it; so
        // this does not wait for another writer.
        let _ = self.connection.busy_timeout(Duration::ZERO);
        let _ = self
            .connection
            .execute_batch("PRAGMA optimize; PRAGMA wal_checkpoint(TRUNCATE);");
    }
}

/// Returns the error for a stored row with invalid content.
pub(crate) fn damaged_row_error(place: impl Into<String>, reason: impl Into<String>) -> CorpusError {
    CorpusError::Damaged {
        place: place.into(),
        reason: reason.into(),
    }
}
