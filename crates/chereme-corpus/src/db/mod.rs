//! The database layer: the only place that contains SQL.
//!
//! [`Store`] is one open connection. Every change goes through [`Store::operation`], which runs it
//! in one transaction, records the rows before and after, and brings the search index along.

pub(crate) mod attributes;
pub(crate) mod check;
pub(crate) mod columns;
pub(crate) mod consents;
pub(crate) mod contents;
pub(crate) mod delete;
pub(crate) mod dump;
pub(crate) mod edits;
pub(crate) mod file_identity;
pub(crate) mod history;
pub(crate) mod info;
pub(crate) mod inventories;
pub(crate) mod list;
pub(crate) mod merge;
pub(crate) mod motion;
pub(crate) mod notations;
mod open;
pub(crate) mod recipes;
pub(crate) mod recordings;
mod roles;
pub(crate) mod rows;
pub(crate) mod saved_searches;
pub(crate) mod seals;
pub(crate) mod search;
pub(crate) mod signs;
pub(crate) mod spans;
mod stale_log;
pub(crate) mod studies;
pub(crate) mod tiers;
pub(crate) mod tracks;
pub(crate) mod unfinished;
pub(crate) mod upgrade;

use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, TransactionBehavior};

use self::file_identity::FileIdentity;
use self::unfinished::Unfinished;
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit, unheard};
use crate::words::effect::OperationEffect;

pub(crate) use history::log as history_log;
pub use history::{OperationKind, OperationRow};
pub(crate) use open::SCHEMA_VERSION;
pub use open::{Upgrade, on_waiting};

/// Data derived from the rows and written in the same transaction, such as the search index.
pub(crate) trait Derived: Default {
    /// Brings the data up to date before they are read.
    fn refresh(&mut self, connection: &Connection) -> Result<()>;

    /// Updates the data for the rows that the running operation touched, in its transaction.
    fn follow(&mut self, connection: &Connection, progress: &mut Progress<'_>) -> Result<()>;

    /// Derives the data again from all rows, inside the caller's transaction.
    fn rebuild(&mut self, connection: &Connection, progress: &mut Progress<'_>) -> Result<()>;
}

/// An open corpus file: its connection, the data derived from its rows, and the author of changes.
pub(crate) struct Store<D: Derived> {
    connection: Connection,
    path: PathBuf,
    author: String,
    index: D,
    upgrade: Option<Upgrade>,
    /// The file that was opened; it goes after the connection.
    place: OpenPlace,
    /// The copy that stands for a file of an older version; it goes after the connection.
    _copy: Option<Unfinished>,
}

impl<D: Derived> Store<D> {
    /// Creates an empty corpus at `path`, which must not exist yet.
    ///
    /// `fill` writes the initial content of every corpus; that is not an operation and cannot be undone.
    pub(crate) fn create(
        path: &Path,
        author: &str,
        fill: impl FnOnce(&Connection) -> Result<()>,
    ) -> Result<Self> {
        let connection = open::create(path, fill)?;
        Self::ready(connection, path, author)
    }

    /// Opens the corpus at `path`, and upgrades its schema if that is older than this version's.
    pub(crate) fn open(path: &Path, author: &str) -> Result<Self> {
        let (connection, upgrade) = open::open(path)?;
        let mut store = Self::ready(connection, path, author)?;
        store.upgrade = upgrade;
        Ok(store)
    }

    /// Opens the corpus at `path`, whose file stays as it is; if its version is older, a copy beside `own` stands for it.
    pub(crate) fn open_unchanged(path: &Path, own: &Path, author: &str) -> Result<Self> {
        let (connection, copy) = open::open_unchanged(path, own)?;
        let mut store = Self::ready(connection, path, author)?;
        store._copy = copy;
        Ok(store)
    }

    fn ready(connection: Connection, path: &Path, author: &str) -> Result<Self> {
        history::record_changes(&connection)?;
        let (place, author) = (OpenPlace(FileIdentity::of(path)), author.to_owned());
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

    /// Returns what opening the file upgraded.
    pub(crate) fn upgrade(&self) -> Option<&Upgrade> {
        self.upgrade.as_ref()
    }

    /// Returns the path of the file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a copy of the corpus to a new file.
    pub(crate) fn copy(&self, to: &Path) -> Result<()> {
        open::copy(&self.connection, to)
    }

    /// Returns the connection for reading.
    pub(crate) fn read(&self) -> &Connection {
        &self.connection
    }

    /// Returns the connection and the search index brought up to date with it.
    pub(crate) fn searchable(&mut self) -> Result<(&Connection, &D)> {
        self.index.refresh(&self.connection)?;
        Ok((&self.connection, &self.index))
    }

    /// Runs `work` as one operation: all of it is stored, or nothing.
    ///
    /// `work` returns its result and what it did. Work that changes no row leaves no operation.
    pub(crate) fn operation<T>(
        &mut self,
        work: impl FnOnce(&Connection) -> Result<(T, OperationEffect)>,
    ) -> Result<T> {
        let mut hear = unheard;
        let progress = &mut Progress::new(&mut hear);
        self.operation_with_progress(progress, |connection, _| work(connection))
    }

    /// Runs the work of a test as an operation with this name; the work returns its summary.
    #[cfg(test)]
    pub(crate) fn named_operation<T>(
        &mut self,
        name: &str,
        work: impl FnOnce(&Connection) -> Result<(T, String)>,
    ) -> Result<T> {
        self.operation(|connection| {
            let (value, summary) = work(connection)?;
            let name = name.to_owned();
            Ok((value, OperationEffect::SummaryOnly { name, summary }))
        })
    }

    /// Runs `work` as [`operation`](Self::operation) does, with progress reports; it can be stopped until everything is
    /// stored.
    pub(crate) fn operation_with_progress<T>(
        &mut self,
        progress: &mut Progress<'_>,
        work: impl FnOnce(&Connection, &mut Progress<'_>) -> Result<(T, OperationEffect)>,
    ) -> Result<T> {
        self.transact(progress, |connection, author, progress| {
            let operation = history::begin(connection, author)?;
            let (value, effect) = work(connection, progress)?;
            history::finish(connection, operation, &effect, progress)?;
            Ok(value)
        })
    }

    /// Undoes the newest operation that is in effect, and returns the undo.
    pub(crate) fn undo(&mut self, progress: &mut Progress<'_>) -> Result<OperationRow> {
        self.transact(progress, history::undo)
    }

    /// Redoes the operation that was undone last, and returns the redo.
    pub(crate) fn redo(&mut self, progress: &mut Progress<'_>) -> Result<OperationRow> {
        self.transact(progress, history::redo)
    }

    /// Returns the operations, newest first.
    pub(crate) fn log(&self, limit: usize) -> Result<Vec<OperationRow>> {
        history::log(&self.connection, limit)
    }

    /// Reports changesets that cannot be read.
    pub(crate) fn check_history(&self, progress: &mut Progress<'_>) -> Result<Vec<String>> {
        history::check(&self.connection, progress)
    }

    /// Returns the search index as it was loaded last.
    pub(crate) fn index(&self) -> &D {
        &self.index
    }

    /// Computes the seals of tables from their rows as they are now.
    pub(crate) fn seal_again(
        &mut self,
        tables: impl IntoIterator<Item = &'static str>,
    ) -> Result<()> {
        let transaction = search::begin(&self.connection)?;
        seals::seal_tables(&transaction, tables)?;
        Ok(transaction.commit()?)
    }

    /// Builds the search index again from the rows.
    pub(crate) fn reindex(&mut self, progress: &mut Progress<'_>) -> Result<()> {
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)?;
        let done = self
            .index
            .rebuild(&transaction, progress)
            .and_then(|()| Ok(transaction.commit()?));
        if done.is_err() {
            self.index = D::default();
        }
        done
    }

    fn transact<T>(
        &mut self,
        progress: &mut Progress<'_>,
        work: impl FnOnce(&Connection, &str, &mut Progress<'_>) -> Result<T>,
    ) -> Result<T> {
        let not_here = |error: Error| error.of_file(&self.path);
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)
            .map_err(|error| not_here(error.into()))?;
        transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
        let done = work(&transaction, &self.author, progress).and_then(|value| {
            self.index.follow(&transaction, progress)?;
            transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
            // From here on it cannot be stopped.
            progress.report(Step {
                task: "storing",
                done: 0,
                total: None,
                unit: Unit::Items,
            })?;
            transaction.commit()?;
            Ok(value)
        });
        if done.is_err() {
            self.index = D::default();
        }
        let value = done.map_err(|error| error.of_file(&self.path))?;
        if self.place.0.stands() {
            return Ok(value);
        }
        // What is stored lies in a file that the path no longer names.
        Err(Error::Displaced {
            path: self.path.clone(),
            rescued: open::copy_beside(&self.connection, &self.path, "rescued")?,
        })
    }
}

/// The file of an open corpus.
struct OpenPlace(FileIdentity);

impl Drop for OpenPlace {
    /// Removes the emptied companions of a file that is not at its path any more, so that none is taken for one of the
    /// file that is there now.
    fn drop(&mut self) {
        if self.0.stands() {
            return;
        }
        let beside = |ending| stale_log::beside(self.0.path(), ending);
        let log = beside("-wal");
        if log.metadata().is_ok_and(|log| log.len() == 0) {
            // A failure is harmless: an empty log changes nothing.
            drop(std::fs::remove_file(log));
            drop(std::fs::remove_file(beside("-shm")));
        }
    }
}

impl<D: Derived> Drop for Store<D> {
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
pub(crate) fn damaged(place: impl Into<String>, reason: impl Into<String>) -> Error {
    Error::Damaged {
        place: place.into(),
        reason: reason.into(),
    }
}
