//! The conditions on a corpus file, whatever happened to the processes that worked on it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use chereme_corpus::{Corpus, ProgressReceiver, ignore_progress_step};
use rusqlite::Connection;

/// How much of a corpus is looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Check {
    /// The database and what rows must agree on.
    Rows,
    /// All that the corpus itself checks: blocks, tokens, tier rules, index and more.
    Everything,
}

/// Expects that the corpus opens, is whole, and holds the operations of `reported`, by author.
pub(crate) fn expect_whole(path: &Path, reported: &BTreeMap<String, BTreeSet<i64>>, how: Check) {
    let mut corpus = Corpus::open_corpus(path, "checker").expect("the corpus opens");
    let log = corpus.operation_log(usize::MAX).expect("the log is read");
    if how == Check::Everything {
        let check = corpus.check_corpus(false, &mut ProgressReceiver::new(&mut ignore_progress_step));
        let check = check.expect("the corpus is checked");
        assert_eq!(check.all_findings().next(), None);
    }
    drop(corpus);
    for (author, done) in reported {
        let logged: BTreeSet<i64> = log
            .iter()
            .filter(|row| row.author == *author)
            .map(|row| row.id)
            .collect();
        let lost: Vec<_> = done.difference(&logged).collect();
        assert!(
            lost.is_empty(),
            "{author}'s operations {lost:?} were reported and are lost"
        );
    }
    let rows = Connection::open(path).expect("the file is a database");
    for (what, sql) in [
        (
            "pages",
            "SELECT * FROM pragma_integrity_check WHERE integrity_check <> 'ok'",
        ),
        (
            "references",
            "SELECT \"table\" || ' ' || rowid FROM pragma_foreign_key_check",
        ),
        (
            "changesets",
            "SELECT o.id || ' has none' FROM operation o
             WHERE NOT EXISTS (SELECT 1 FROM changeset c WHERE c.operation_id = o.id)",
        ),
        (
            "movement",
            "SELECT t.id || ' ' || b.channel_group || ': ' || sum(b.frames) || ' of ' || t.frames
             FROM track t JOIN track_block b ON b.track_id = t.id
             GROUP BY t.id, b.channel_group HAVING sum(b.frames) <> t.frames",
        ),
        (
            "glosses without a token",
            "SELECT a.id || ' ' || a.value FROM annotation a
             JOIN tier i ON i.id = a.tier_id AND i.role = 'gloss'
             WHERE a.state = 'value' AND NOT EXISTS (SELECT 1 FROM token t WHERE t.annotation_id = a.id)",
        ),
    ] {
        let mut statement = rows.prepare(sql).expect(what);
        let faults: Vec<String> = statement
            .query_map([], |row| row.get(0))
            .and_then(Iterator::collect)
            .expect(what);
        assert!(faults.is_empty(), "{what}: {faults:?}");
    }
}
