//! The database room: the only place that holds SQL.
//!
//! [`Store`] is one open connection. Every change goes through [`Store::operation`], which runs it
//! in one transaction, records the rows before and after, and brings the search index along.

pub(crate) mod attributes;
pub(crate) mod check;
pub(crate) mod columns;
pub(crate) mod contents;
pub(crate) mod dump;
pub(crate) mod edits;
pub(crate) mod history;
pub(crate) mod info;
pub(crate) mod inventories;
pub(crate) mod kept;
pub(crate) mod list;
pub(crate) mod merge;
pub(crate) mod motion;
pub(crate) mod notations;
mod open;
pub(crate) mod recipes;
pub(crate) mod recordings;
pub(crate) mod search;
pub(crate) mod signs;
pub(crate) mod spans;
pub(crate) mod tiers;
pub(crate) mod tracks;
pub(crate) mod upgrade;

use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, TransactionBehavior};

use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit, unheard};
use crate::search::index::SearchIndex;

pub(crate) use history::log as history_log;
pub use history::{OperationKind, OperationRow};
pub(crate) use open::SCHEMA_VERSION;
pub use open::on_waiting;

/// An open corpus file: its connection, its search index, and who works with it.
pub(crate) struct Store {
    connection: Connection,
    path: PathBuf,
    author: String,
    index: SearchIndex,
}

impl Store {
    /// Makes an empty corpus at `path`, where nothing may be yet.
    ///
    /// `fill` writes what every corpus begins with; that is no operation and cannot be undone.
    pub(crate) fn create(
        path: &Path,
        author: &str,
        fill: impl FnOnce(&Connection) -> Result<()>,
    ) -> Result<Self> {
        let connection = open::create(path, fill)?;
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

    /// Writes all of it to a new file.
    pub(crate) fn copy(&self, to: &Path) -> Result<()> {
        open::copy(&self.connection, to)
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
        let mut hear = unheard;
        let progress = &mut Progress::new(&mut hear);
        self.operation_told(name, progress, |connection, _| work(connection))
    }

    /// Does the same with work that reports its progress; it can be stopped until all of it is stored.
    pub(crate) fn operation_told<T>(
        &mut self,
        name: &str,
        progress: &mut Progress<'_>,
        work: impl FnOnce(&Connection, &mut Progress<'_>) -> Result<(T, String)>,
    ) -> Result<T> {
        self.transact(progress, |connection, author, progress| {
            let operation = history::begin(connection, author, name)?;
            let (value, summary) = work(connection, progress)?;
            history::finish(connection, operation, &summary, progress)?;
            Ok(value)
        })
    }

    /// Takes the newest operation back that is not taken back yet, and returns it.
    pub(crate) fn undo(&mut self, progress: &mut Progress<'_>) -> Result<OperationRow> {
        self.transact(progress, history::undo)
    }

    /// Does the operation again that was taken back last, and returns it.
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
            self.index = SearchIndex::default();
        }
        done
    }

    fn transact<T>(
        &mut self,
        progress: &mut Progress<'_>,
        work: impl FnOnce(&Connection, &str, &mut Progress<'_>) -> Result<T>,
    ) -> Result<T> {
        let transaction = self
            .connection
            .transaction_with_behavior(TransactionBehavior::Immediate)?;
        transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
        let done = work(&transaction, &self.author, progress).and_then(|value| {
            self.index.follow(&transaction, progress)?;
            transaction.execute_batch("DELETE FROM temp.change; DELETE FROM temp.touched;")?;
            // From here on it can be stopped no more.
            progress.tell(Step {
                task: "storing",
                done: 0,
                total: None,
                unit: Unit::Items,
            })?;
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
        // Closing leaves one true single file; failing to is harmless, the next opening does it, and so
        // nobody waits for another writer here.
        let _ = self.connection.busy_timeout(Duration::ZERO);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn dump(store: &Store) -> Vec<String> {
        let sql = "SELECT 'sign ' || id || gloss || coalesce(notes, '') FROM sign
                   UNION ALL SELECT 'token ' || id || sign_id || origin FROM token
                   UNION ALL SELECT 'text ' || sign_id || language || text FROM sign_text ORDER BY 1";
        let mut statement = store.read().prepare(sql).expect("sql");
        statement
            .query_map([], |row| row.get(0))
            .and_then(Iterator::collect)
            .expect("rows")
    }

    fn add(store: &mut Store, gloss: &str) {
        store
            .operation("add", |connection| {
                let sign = signs::sign_glossed(connection, gloss)?;
                signs::add_text(connection, sign, "en", "a word")?;
                let origin = columns::Origin::Lexicon;
                let row = signs::TokenRow {
                    sign_id: sign,
                    origin,
                    ..Default::default()
                };
                signs::insert_token(connection, &row)?;
                Ok(((), format!("added {gloss}")))
            })
            .expect("added");
    }

    #[test]
    fn undo_and_redo_walk_the_whole_history_and_survive_reopening() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let mut store = Store::create(&path, "A", |_| Ok(())).expect("made");
        let mut states = vec![dump(&store)];
        for gloss in ["BOL", "CHAT", "CHIEN"] {
            add(&mut store, gloss);
            states.push(dump(&store));
        }
        store
            .operation("rename", |connection| {
                connection.execute(
                    "UPDATE sign SET gloss = 'LION', notes = 'é' WHERE id = 2",
                    [],
                )?;
                connection.execute("DELETE FROM token WHERE sign_id = 1", [])?;
                Ok(((), "changed".into()))
            })
            .expect("changed");
        states.push(dump(&store));
        drop(store);
        let mut store = Store::open(&path, "B").expect("opened");
        for state in states.iter().rev().skip(1) {
            store
                .undo(&mut Progress::new(&mut unheard))
                .expect("undone");
            assert_eq!(dump(&store), *state);
            let (connection, index) = store.searchable().expect("index");
            let rows: i64 = connection
                .query_row("SELECT count(*) FROM token", [], |row| row.get(0))
                .expect("count");
            assert_eq!(index.documents(), rows as u64);
            assert!(!index.was_rebuilt());
        }
        assert!(store.undo(&mut Progress::new(&mut unheard)).is_err());
        drop(store);
        let mut store = Store::open(&path, "C").expect("opened");
        for state in states.iter().skip(1) {
            store
                .redo(&mut Progress::new(&mut unheard))
                .expect("done again");
            assert_eq!(dump(&store), *state);
        }
        assert!(store.redo(&mut Progress::new(&mut unheard)).is_err());
        assert_eq!(store.log(100).expect("log").len(), 12);
        assert_eq!(
            store
                .check_history(&mut Progress::new(&mut unheard))
                .expect("read"),
            Vec::<String>::new()
        );
        store
            .undo(&mut Progress::new(&mut unheard))
            .expect("undone");
        add(&mut store, "OR");
        assert!(
            store.redo(&mut Progress::new(&mut unheard)).is_err(),
            "new work clears what could be done again"
        );
    }

    #[test]
    fn failed_work_changes_nothing_and_empty_work_is_no_operation() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut store =
            Store::create(&folder.path().join("c.chereme"), "A", |_| Ok(())).expect("made");
        add(&mut store, "BOL");
        let before = dump(&store);
        let failed: Result<()> = store.operation("fail", |connection| {
            signs::sign_glossed(connection, "X")?;
            Err(Error::wrong("no"))
        });
        assert!(failed.is_err());
        store
            .operation("nothing", |_| Ok(((), String::new())))
            .expect("nothing");
        assert_eq!(dump(&store), before);
        assert_eq!(store.log(9).expect("log").len(), 1);
    }

    #[test]
    fn rows_changed_behind_the_index_are_noticed() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("c.chereme");
        let mut store = Store::create(&path, "A", |_| Ok(())).expect("made");
        add(&mut store, "BOL");
        drop(store);
        let other = rusqlite::Connection::open(&path).expect("opened");
        other
            .execute("INSERT INTO sign (id, gloss) VALUES (9, 'X')", [])
            .expect("written");
        other
            .execute(
                "INSERT INTO token (sign_id, origin) VALUES (9, 'lexicon')",
                [],
            )
            .expect("written");
        drop(other);
        let mut store = Store::open(&path, "A").expect("opened");
        let (_, index) = store.searchable().expect("index");
        assert!(index.was_rebuilt());
        assert_eq!(index.documents(), 2);
    }

    #[test]
    fn what_is_no_corpus_is_refused_with_advice() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x");
        assert!(Store::open(&path, "A").is_err_and(|e| e.remedy().is_some()));
        std::fs::write(&path, "").expect("written");
        assert!(Store::open(&path, "A").is_err_and(|e| e.to_string().contains("it is empty")));
        assert!(Store::open(folder.path(), "A").is_err_and(|e| e.to_string().contains("a folder")));
        std::fs::write(&path, "rubbish, rubbish, rubbish").expect("written");
        assert!(Store::open(&path, "A").is_err_and(|e| matches!(e, Error::NotACorpus { .. })));
        let other = folder.path().join("other.db");
        rusqlite::Connection::open(&other)
            .and_then(|c| c.execute_batch("CREATE TABLE a (b)"))
            .expect("made");
        assert!(Store::open(&other, "A").is_err_and(|e| e.to_string().contains("another program")));
        let evil = folder.path().join("evil.chereme");
        drop(Store::create(&evil, "A", |_| Ok(())).expect("made"));
        let bytes = std::fs::read(&evil).expect("read");
        std::fs::write(&path, &bytes[..bytes.len() / 2]).expect("written");
        assert!(Store::open(&path, "A").is_err_and(|e| e.to_string().contains("cut short")));
        assert!(Store::create(&evil, "A", |_| Ok(())).is_err());
        rusqlite::Connection::open(&evil)
            .and_then(|c| {
                c.execute_batch(
                    "CREATE TRIGGER t AFTER INSERT ON sign BEGIN DELETE FROM token; END",
                )
            })
            .expect("made");
        assert!(Store::open(&evil, "A").is_err_and(|e| e.to_string().contains("triggers")));
    }
}
