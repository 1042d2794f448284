//! Several processes on one file at once: all of their work is there, once, and in one history.

mod common;

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use chereme_corpus::Corpus;
use chereme_tests::workers::{Worker, small_corpus};

const WORKER: &str = env!("CARGO_BIN_EXE_chereme-worker");

#[test]
fn two_write_and_two_read_the_same_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path(), "shared.chereme").expect("a corpus");
    let start =
        |task: &str, author: &str, count: usize| Worker::start(WORKER, &path, task, author, count).expect("started");
    let workers = [
        ("anna", start("import", "anna", 8)),
        ("ben", start("annotate", "ben", 8)),
        ("reader", start("read", "reader", 60)),
        ("other reader", start("read", "other reader", 60)),
    ];
    let mut reported = BTreeMap::new();
    for (author, worker) in workers {
        let said = worker.hear().expect("heard");
        assert!(said.ended, "{author}: {}", said.errors);
        reported.insert(author.to_owned(), said.done);
    }
    assert_eq!(reported["anna"].len(), 8);
    assert_eq!(reported["ben"].len(), 8);
    common::expect_whole(&path, &reported, common::Check::Everything);
    let mut corpus = Corpus::open_corpus(&path, "checker").expect("opened");
    let log = corpus.operation_log(usize::MAX).expect("log");
    assert_eq!(log.len(), 17, "one of the maker, eight of each writer");
    for _ in 0..17 {
        corpus
            .undo_operation()
            .expect("everything can be taken back, whoever did it");
    }
    assert!(corpus.undo_operation().is_err());
    drop(corpus);
    common::expect_whole(&path, &reported, common::Check::Rows);
}

#[test]
fn a_second_session_sees_the_changes_of_the_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path(), "shared.chereme").expect("a corpus");
    let mut first = Corpus::open_corpus(&path, "first").expect("opened");
    let mut second = Corpus::open_corpus(&path, "second").expect("opened");
    first.undo_operation().expect("undone");
    assert_eq!(second.operation_log(9).expect("log").len(), 2);
    second.redo_operation().expect("done again by the other");
    assert_eq!(first.operation_log(9).expect("log").len(), 3);
    assert!(first.redo_operation().is_err(), "it is done already");
    first.undo_operation().expect("undone");
}

static WAITS: AtomicUsize = AtomicUsize::new(0);

#[test]
fn readers_never_wait_for_a_writer_and_waiting_writers_report_it() {
    chereme_corpus::on_waiting(|| {
        WAITS.fetch_add(1, Ordering::SeqCst);
    });
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path(), "shared.chereme").expect("a corpus");
    let other = rusqlite::Connection::open(&path).expect("opened");
    other.execute_batch("BEGIN IMMEDIATE").expect("locked");
    let reader = Corpus::open_corpus(&path, "reader").expect("opened");
    assert!(!reader.operation_log(9).expect("read").is_empty());
    drop(reader);
    assert_eq!(WAITS.load(Ordering::SeqCst), 0);
    let writer = std::thread::spawn({
        let path = path.clone();
        move || Corpus::open_corpus(&path, "writer").and_then(|mut corpus| corpus.undo_operation())
    });
    while WAITS.load(Ordering::SeqCst) == 0 && !writer.is_finished() {
        std::thread::yield_now();
    }
    other.execute_batch("ROLLBACK").expect("unlocked");
    writer.join().expect("no panic").expect("undone after all");
    assert!(WAITS.load(Ordering::SeqCst) > 0, "it said that it waits");
}

#[test]
fn two_processes_that_create_one_corpus_share_it() {
    for round in 0..5 {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x");
        let start = || Worker::start(WORKER, &path, "create", "made", 3).expect("started");
        let (first, second) = (start(), start());
        let (first, second) = (first.hear().expect("heard"), second.hear().expect("heard"));
        for said in [&first, &second] {
            assert!(said.ended || said.errors.contains("there already"), "{}", said.errors);
        }
        assert!(first.ended || second.ended, "round {round}");
        for step in 0..3 {
            let path = folder.path().join(format!("made-{step}.chereme"));
            assert!(Corpus::open_corpus(&path, "checker").is_ok(), "round {round}, {step}");
        }
        let left = std::fs::read_dir(folder.path()).expect("a folder");
        let left: Vec<_> = left.flatten().map(|entry| entry.file_name()).collect();
        assert!(left.len() == 3, "round {round}: {left:?}");
    }
}
