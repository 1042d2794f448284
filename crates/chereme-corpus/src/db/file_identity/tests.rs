use super::*;
use crate::Corpus;

fn create_sample_corpus(folder: &Path) -> Corpus {
    let mut corpus = Corpus::create_corpus(&folder.join("a.chereme"), "A").expect("made");
    let query = crate::KeptSearch {
        name: "mine".into(),
        query: "configuration=U".into(),
    };
    corpus.keep_searches(&[query]).expect("kept");
    corpus
}

#[test]
fn a_corpus_deleted_while_open_is_saved_whole() {
    let folder = tempfile::tempdir().expect("a folder");
    let corpus = create_sample_corpus(folder.path());
    let path = corpus.corpus_file_path().to_owned();
    let place = FileIdentity::from_file_path(&path);
    assert!(place.is_same_file_present());
    let moved = folder.path().join("moved.chereme");
    std::fs::rename(&path, &moved).expect("moved");
    assert!(!place.is_same_file_present());
    std::fs::rename(&moved, &path).expect("moved back");
    assert!(place.is_same_file_present());
    std::fs::remove_file(&path).expect("deleted");
    std::fs::write(&path, "another").expect("written");
    assert!(!place.is_same_file_present(), "it is another file");
    assert!(corpus.save_copy(&path).is_err(), "nothing is written over");
    std::fs::remove_file(&path).expect("deleted");
    assert!(!place.is_same_file_present());
    corpus.save_copy(&path).expect("saved");
    drop(corpus);
    let reopened = Corpus::open_corpus(&path, "A").expect("opened");
    let overview = reopened.load_corpus_overview(10).expect("read");
    assert_eq!(overview.searches.len(), 1);
    assert_eq!(overview.operations.len(), 1);
    assert!(!overview.inventories.is_empty());
}

#[test]
fn work_on_a_file_that_was_moved_or_replaced_is_saved_beside_and_not_called_done() {
    for (trial, replacement) in [None, Some("copy"), Some("gone")].into_iter().enumerate() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = create_sample_corpus(folder.path());
        let path = corpus.corpus_file_path().to_owned();
        let other = folder.path().join("other.chereme");
        drop(Corpus::create_corpus(&other, "B").expect("made"));
        let query = crate::KeptSearch {
            name: "second".into(),
            query: "configuration=S".into(),
        };
        let is_last = |step: &crate::ProgressStep<'_>| step.task == "storing";
        let mut hear = |step: crate::ProgressStep<'_>| {
            if is_last(&step) {
                match replacement {
                    None => std::fs::rename(&path, folder.path().join("moved.chereme")),
                    Some("copy") => std::fs::rename(&other, &path),
                    Some(_) => std::fs::remove_file(&path),
                }
                .expect("displaced");
            }
            std::ops::ControlFlow::Continue(())
        };
        let mut progress = crate::ProgressReceiver::new(&mut hear);
        let done = corpus.store.operation_with_progress(&mut progress, |connection, _| {
            crate::db::saved_searches::insert_saved_search(connection, &query)?;
            Ok(((), crate::words::effect::OperationEffect::Mend {}))
        });
        let Err(crate::CorpusError::Displaced { rescued, .. }) = done else {
            panic!("trial {trial}: {done:?}");
        };
        assert_eq!(rescued, folder.path().join("a.rescued.chereme"));
        drop(corpus);
        let saved = Corpus::open_corpus(&rescued, "A").expect("opened");
        assert_eq!(
            saved.load_corpus_overview(10).expect("read").searches.len(),
            2,
            "trial {trial}"
        );
        for ending in ["-wal", "-shm"] {
            let left = folder.path().join(format!("a.chereme{ending}"));
            assert!(!left.exists(), "trial {trial}: {ending}");
        }
        if replacement == Some("copy") {
            let theirs = Corpus::open_corpus(&path, "A").expect("opened");
            assert_eq!(theirs.load_corpus_overview(10).expect("read").searches.len(), 0);
        }
    }
}
