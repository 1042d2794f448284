use super::*;
use crate::{Corpus, KeptSearch, ignore_progress_step};

fn keep_many_searches(corpus: &mut Corpus, name: &str) {
    for at in 0..40 {
        let query = KeptSearch {
            name: format!("{name} {at} {}", "x".repeat(2000)),
            query: "configuration=S".into(),
        };
        corpus.keep_searches(&[query]).expect("kept");
    }
}

fn count_saved_searches(path: &Path) -> usize {
    let corpus = Corpus::open_corpus(path, "A").expect("opened");
    corpus.load_corpus_overview(1).expect("read").searches.len()
}

#[test]
fn a_log_is_used_with_its_own_file_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let place = |name: &str| folder.path().join(name);
    let path = place("c.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    keep_many_searches(&mut corpus, "first");
    drop(corpus);
    fs::copy(&path, place("backup")).expect("copied");
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    keep_many_searches(&mut corpus, "second");
    let checkpoint = "PRAGMA wal_checkpoint(TRUNCATE)";
    let read = |corpus: &Corpus| corpus.store.read_connection().query_row(checkpoint, [], |_| Ok(()));
    read(&corpus).expect("written");
    keep_many_searches(&mut corpus, "third");
    // A killed program leaves these.
    fs::copy(&path, place("killed")).expect("copied");
    fs::copy(companion_path(&path, "-wal"), place("log")).expect("copied");
    drop(corpus);
    for (file, searches, stale) in [("killed", 120, false), ("backup", 40, true)] {
        let path = place(&format!("{file}.chereme"));
        fs::copy(place("log"), companion_path(&path, "-wal")).expect("copied");
        fs::copy(place(file), &path).expect("copied");
        assert_eq!(count_saved_searches(&path), searches, "{file}");
        assert_eq!(companion_path(&path, "-wal.stale").exists(), stale, "{file}");
        let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
        let mut hear = ignore_progress_step;
        let report = corpus.check_corpus(false, &mut crate::ProgressReceiver::new(&mut hear));
        assert_eq!(report.expect("checked").faults, [], "{file}");
    }
}
