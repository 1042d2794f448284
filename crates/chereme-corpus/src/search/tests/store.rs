//! The store with its index: history, failed work, rows changed by others, files that are no corpus.

use crate::IndexedStore;
use crate::db::{signs, stored_columns};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ignore_progress_step};

fn dump(store: &IndexedStore) -> Vec<String> {
    let sql = "SELECT 'sign ' || id || gloss || coalesce(notes, '') FROM sign
               UNION ALL SELECT 'token ' || id || sign_id || origin FROM token
               UNION ALL SELECT 'text ' || sign_id || language || text FROM sign_text ORDER BY 1";
    let mut statement = store.read_connection().prepare(sql).expect("sql");
    statement
        .query_map([], |row| row.get(0))
        .and_then(Iterator::collect)
        .expect("rows")
}

fn add(store: &mut IndexedStore, gloss: &str) {
    store
        .named_operation("add", |connection| {
            let sign = signs::sign_of_annotation(connection, None, gloss)?;
            signs::add_text(connection, sign, "en", "a word")?;
            let origin = stored_columns::RecordOrigin::Lexicon;
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
    let mut store = IndexedStore::create_corpus_store(&path, "A", |_| Ok(())).expect("made");
    let mut states = vec![dump(&store)];
    for gloss in ["BOL", "CHAT", "CHIEN"] {
        add(&mut store, gloss);
        states.push(dump(&store));
    }
    store
        .named_operation("rename", |connection| {
            connection.execute("UPDATE sign SET gloss = 'LION', notes = 'é' WHERE id = 2", [])?;
            connection.execute("DELETE FROM token WHERE sign_id = 1", [])?;
            Ok(((), "changed".into()))
        })
        .expect("changed");
    states.push(dump(&store));
    drop(store);
    let mut store = IndexedStore::open_corpus_store(&path, "B").expect("opened");
    for state in states.iter().rev().skip(1) {
        store
            .undo_store_operation(&mut ProgressReceiver::new(&mut ignore_progress_step))
            .expect("undone");
        assert_eq!(dump(&store), *state);
        let (connection, index) = store.searchable_connection().expect("index");
        let rows: i64 = connection
            .query_row("SELECT count(*) FROM token", [], |row| row.get(0))
            .expect("count");
        assert_eq!(index.indexed_document_count(), rows as u64);
        assert!(!index.was_rebuilt());
    }
    assert!(
        store
            .undo_store_operation(&mut ProgressReceiver::new(&mut ignore_progress_step))
            .is_err()
    );
    drop(store);
    let mut store = IndexedStore::open_corpus_store(&path, "C").expect("opened");
    for state in states.iter().skip(1) {
        store
            .redo_store_operation(&mut ProgressReceiver::new(&mut ignore_progress_step))
            .expect("done again");
        assert_eq!(dump(&store), *state);
    }
    assert!(
        store
            .redo_store_operation(&mut ProgressReceiver::new(&mut ignore_progress_step))
            .is_err()
    );
    assert_eq!(store.store_operation_log(100).expect("log").len(), 12);
    assert_eq!(
        store
            .check_history(&mut ProgressReceiver::new(&mut ignore_progress_step))
            .expect("read"),
        Vec::<String>::new()
    );
    store
        .undo_store_operation(&mut ProgressReceiver::new(&mut ignore_progress_step))
        .expect("undone");
    add(&mut store, "OR");
    assert!(
        store
            .redo_store_operation(&mut ProgressReceiver::new(&mut ignore_progress_step))
            .is_err(),
        "new work clears what could be done again"
    );
}

#[test]
fn a_failed_operation_changes_nothing_and_an_empty_one_is_not_logged() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut store = IndexedStore::create_corpus_store(&folder.path().join("c.chereme"), "A", |_| Ok(())).expect("made");
    add(&mut store, "BOL");
    let before = dump(&store);
    let failed: CorpusResult<()> = store.named_operation("fail", |connection| {
        signs::sign_of_annotation(connection, None, "X")?;
        Err(CorpusError::from_wrong_message("no"))
    });
    assert!(failed.is_err());
    store
        .named_operation("nothing", |_| Ok(((), String::new())))
        .expect("nothing");
    assert_eq!(dump(&store), before);
    assert_eq!(store.store_operation_log(9).expect("log").len(), 1);
}

#[test]
fn rows_changed_without_the_index_are_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("c.chereme");
    let mut store = IndexedStore::create_corpus_store(&path, "A", |_| Ok(())).expect("made");
    add(&mut store, "BOL");
    drop(store);
    let other = rusqlite::Connection::open(&path).expect("opened");
    other
        .execute("INSERT INTO sign (id, gloss) VALUES (9, 'X')", [])
        .expect("written");
    other
        .execute("INSERT INTO token (sign_id, origin) VALUES (9, 'lexicon')", [])
        .expect("written");
    drop(other);
    let mut store = IndexedStore::open_corpus_store(&path, "A").expect("opened");
    let (_, index) = store.searchable_connection().expect("index");
    assert!(index.was_rebuilt());
    assert_eq!(index.indexed_document_count(), 2);
}

#[test]
fn a_file_that_is_no_corpus_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x");
    assert!(IndexedStore::open_corpus_store(&path, "A").is_err_and(|e| e.error_remedy().is_some()));
    std::fs::write(&path, "").expect("written");
    assert!(IndexedStore::open_corpus_store(&path, "A").is_err_and(|e| e.to_string().contains("it is empty")));
    assert!(IndexedStore::open_corpus_store(folder.path(), "A").is_err_and(|e| e.to_string().contains("a folder")));
    std::fs::write(&path, "rubbish, rubbish, rubbish").expect("written");
    assert!(IndexedStore::open_corpus_store(&path, "A").is_err_and(|e| matches!(e, CorpusError::NotACorpus { .. })));
    let other = folder.path().join("other.db");
    rusqlite::Connection::open(&other)
        .and_then(|c| c.execute_batch("CREATE TABLE a (b)"))
        .expect("made");
    assert!(IndexedStore::open_corpus_store(&other, "A").is_err_and(|e| e.to_string().contains("another program")));
    let evil = folder.path().join("evil.chereme");
    drop(IndexedStore::create_corpus_store(&evil, "A", |_| Ok(())).expect("made"));
    let bytes = std::fs::read(&evil).expect("read");
    std::fs::write(&path, &bytes[..bytes.len() / 2]).expect("written");
    assert!(IndexedStore::open_corpus_store(&path, "A").is_err_and(|e| e.to_string().contains("cut short")));
    assert!(IndexedStore::create_corpus_store(&evil, "A", |_| Ok(())).is_err());
    rusqlite::Connection::open(&evil)
        .and_then(|c| c.execute_batch("CREATE TRIGGER t AFTER INSERT ON sign BEGIN DELETE FROM token; END"))
        .expect("made");
    assert!(IndexedStore::open_corpus_store(&evil, "A").is_err_and(|e| e.to_string().contains("triggers")));
}
