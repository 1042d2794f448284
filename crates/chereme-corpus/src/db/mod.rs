//! The database room: the only place that holds SQL.
//!
//! [`Store`] is one open connection. Every change goes through [`Store::operation`], which runs it
//! in one transaction, records the rows before and after, and brings the search index along.

mod history;
pub(crate) mod inventories;
pub(crate) mod motion;
mod open;
pub(crate) mod recordings;
pub(crate) mod search;
pub(crate) mod signs;
pub(crate) mod tiers;

use std::path::{Path, PathBuf};

use rusqlite::{Connection, TransactionBehavior};

use crate::error::{Error, Result};
use crate::search::index::SearchIndex;

pub use history::{OperationKind, OperationRow};
pub(crate) use open::{APPLICATION_ID, SCHEMA_VERSION};

/// An open corpus file: its connection, its search index, and who works with it.
pub(crate) struct Store {
    connection: Connection,
    path: PathBuf,
    author: String,
    index: SearchIndex,
}

impl Store {
    /// Makes an empty corpus at `path`, where nothing may be yet.
    pub(crate) fn create(path: &Path, author: &str) -> Result<Self> {
        let connection = open::create(path)?;
        Self::ready(connection, path, author)
    }

    /// Opens the corpus at `path`, raising its schema to this version's if it is older.
    pub(crate) fn open(path: &Path, author: &str) -> Result<Self> {
        let connection = open::open(path)?;
        Self::ready(connection, path, author)
    }

    fn ready(connection: Connection, path: &Path, author: &str) -> Result<Self> {
        history::record_changes(&connection)?;
        let (path, author) = (path.to_owned(), author.to_owned());
        Ok(Self {
            connection,
            path,
            author,
            index: SearchIndex::default(),
        })
    }

    /// Returns the file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the connection, to read.
    pub(crate) fn read(&self) -> &Connection {
        &self.connection
    }

    /// Returns the connection and the search index brought up to date with it.
    pub(crate) fn searchable(&mut self) -> Result<(&Connection, &SearchIndex)> {
        self.index.refresh(&self.connection)?;
        Ok((&self.connection, &self.index))
    }

    /// Runs `work` as one named operation: all of it happens, or nothing.
    ///
    /// `work` returns its result and a summary for people. Work that changes no row is no operation.
    pub(crate) fn operation<T>(
        &mut self,
        name: &str,
        work: impl FnOnce(&Connection) -> Result<(T, String)>,
    ) -> Result<T> {
        self.transact(|connection, author| {
            let operation = history::begin(connection, author, name)?;
            let (value, summary) = work(connection)?;
            history::finish(connection, operation, &summary)?;
            Ok(value)
        })
    }

    /// Takes the newest operation back that is not taken back yet, and returns it.
    pub(crate) fn undo(&mut self) -> Result<OperationRow> {
        self.transact(history::undo)
    }

    /// Does the operation again that was taken back last, and returns it.
    pub(crate) fn redo(&mut self) -> Result<OperationRow> {
        self.transact(history::redo)
    }

    /// Returns the operations, newest first.
    pub(crate) fn log(&self, limit: usize) -> Result<Vec<OperationRow>> {
        history::log(&self.connection, limit)
    }

    /// Reports changesets that cannot be read.
    pub(crate) fn check_history(&self) -> Result<Vec<String>> {
        history::check(&self.connection)
    }

    /// Makes the search index anew from the rows.
    pub(crate) fn reindex(&mut self) -> Result<()> {
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)?;
        let done = self
            .index
            .rebuild(&transaction)
            .and_then(|()| Ok(transaction.commit()?));
        if done.is_err() {
            self.index = SearchIndex::default();
        }
        done
    }

    fn transact<T>(&mut self, work: impl FnOnce(&Connection, &str) -> Result<T>) -> Result<T> {
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)?;
        transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
        let done = work(&transaction, &self.author).and_then(|value| {
            self.index.follow(&transaction)?;
            transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
            transaction.commit()?;
            Ok(value)
        });
        if done.is_err() {
            self.index = SearchIndex::default();
        }
        done
    }
}

impl Drop for Store {
    fn drop(&mut self) {
        // Closing leaves one true single file; failing to is harmless, the next opening does it.
        let _ = self
            .connection
            .execute_batch("PRAGMA optimize; PRAGMA wal_checkpoint(TRUNCATE);");
    }
}

/// Returns the failure that a stored row is not what it must be.
pub(crate) fn damaged(place: impl Into<String>, reason: impl Into<String>) -> Error {
    Error::Damaged {
        place: place.into(),
        reason: reason.into(),
    }
}
