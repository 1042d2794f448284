use super::*;
use crate::consent::tests::corpus;
use crate::{ExportOptions, ExportWhat, ImportOptions, RecordingChange, ignore_progress_step};

fn forget(corpus: &mut Corpus, dry_run: bool) -> CorpusResult<ForgottenSigner> {
    let mut hear = ignore_progress_step;
    let name = RowName::Text("Qzbeazq".into());
    corpus.forget_signer(&name, dry_run, &mut ProgressReceiver::new(&mut hear))
}

/// Returns a corpus in which BOL was recorded from Qzbeazq, and the rest from Ada.
fn two_signers(folder: &std::path::Path) -> Corpus {
    let mut corpus = corpus(folder);
    let bea = RecordingChange {
        name: Some("qzrecordingzq".into()),
        signer: Some(Some("Qzbeazq".into())),
        ..RecordingChange::default()
    };
    corpus
        .change_recording(&RowName::Text("bol".into()), &bea)
        .expect("changed");
    let named = corpus.store.named_operation("test", |connection| {
        connection.execute(
            "UPDATE tier SET participant = 'Qzbeazq' WHERE participant IS NOT NULL AND recording_id =
                 (SELECT id FROM recording WHERE name = 'qzrecordingzq')",
            [],
        )?;
        Ok(((), String::new()))
    });
    named.expect("changed");
    corpus
}

#[test]
fn nothing_of_a_forgotten_person_is_in_the_bytes_and_nothing_brings_them_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = two_signers(folder.path());
    let path = corpus.corpus_file_path().to_owned();
    let older = path.with_file_name("a.version-3.chereme");
    corpus.store.copy_store_file(&older).expect("copied");
    let elsewhere = folder.path().join("elsewhere.chereme");
    corpus.store.copy_store_file(&elsewhere).expect("copied");
    let bytes_say = |text: &str| {
        let bytes = fs::read(&path).expect("read");
        bytes.windows(text.len()).any(|part| part == text.as_bytes())
    };
    let foreseen = forget(&mut corpus, true).expect("foreseen");
    assert_eq!(foreseen.recordings, ["qzrecordingzq"]);
    assert!(older.exists() && foreseen.older_files == [older.clone()]);
    let done = forget(&mut corpus, false).expect("forgotten");
    assert!(done.searched > 20, "{done:?}");
    assert!(!older.exists());
    assert!(!bytes_say("qzrecordingzq") && !bytes_say("Qzbeazq"));
    assert!(corpus.undo_operation().is_err(), "there is no history");
    let names: Vec<String> = stored_recordings::load_recording_rows(corpus.store.read_connection())
        .expect("read")
        .into_iter()
        .map(|row| row.name)
        .collect();
    assert_eq!(names, ["escargot", "LIMACE"]);
    let to = folder.path().join("all");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .export_corpus(&ExportWhat::All, &to, &ExportOptions::default(), progress)
        .expect("what stays is whole");
    // Whoever gets the copy finds it well, too.
    let mut copy = Corpus::open_corpus(&to.join("corpus.chereme"), "test").expect("open");
    let faults = copy.check_corpus(false, progress).expect("checked").faults;
    assert!(faults.is_empty(), "{faults:?}");
    corpus
        .recombine_recipe("ESCARGOT | mirror", "AFTER")
        .expect("work goes on");
    corpus.undo_operation().expect("undone");
    assert!(forget(&mut corpus, false).is_err(), "nobody of this name is left");
    // A copy that somebody else kept brings nobody back either.
    let merged = corpus.merge_corpus(&elsewhere, None, progress).expect("merged");
    assert!(
        merged.notes.iter().any(|note| note.contains("forgotten here")),
        "{merged:?}"
    );
    assert!(!bytes_say("qzrecordingzq") && !bytes_say("Qzbeazq"));
    let fault = corpus.check_corpus(false, progress).expect("checked").faults;
    assert!(fault.is_empty(), "{fault:?}");
}

#[test]
fn what_something_else_needs_is_not_forgotten() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = two_signers(folder.path());
    corpus
        .recombine_recipe("ESCARGOT | configure right from BOL", "LENT")
        .expect("generated");
    let refused = forget(&mut corpus, false).expect_err("LENT needs it");
    assert!(refused.to_string().contains("LENT"), "{refused}");
    corpus.undo_operation().expect("undone");
    assert!(forget(&mut corpus, true).is_ok());
    // A tier of somebody else in one of the recordings.
    let named = corpus.store.named_operation("test", |connection| {
        connection.execute(
            "UPDATE tier SET participant = 'Ada' WHERE recording_id =
                 (SELECT id FROM recording WHERE name = 'qzrecordingzq')",
            [],
        )?;
        Ok(((), String::new()))
    });
    named.expect("changed");
    let refused = forget(&mut corpus, false).expect_err("Ada is in it");
    assert!(refused.to_string().contains("and others: qzrecordingzq"), "{refused}");
}

#[test]
fn a_person_whose_movement_stands_under_another_name_is_not_forgotten() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = two_signers(folder.path());
    let file = folder.path().join("files").join("bol.bvh");
    let copy = folder.path().join("copy.bvh");
    // The same bytes, and the same numbers in other bytes.
    for text in [
        fs::read_to_string(&file).expect("read"),
        fs::read_to_string(&file).expect("read") + "\n\n",
    ] {
        fs::write(&copy, text).expect("written");
        let options = ImportOptions {
            signer: Some("Cem".into()),
            ..ImportOptions::default()
        };
        let mut hear = ignore_progress_step;
        let report = corpus
            .import_paths(
                std::slice::from_ref(&copy),
                &options,
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("imported");
        let messages: Vec<&str> = report.files[0].findings.iter().map(|it| it.message.as_str()).collect();
        let known = "its movement is that of the recording \"qzrecordingzq\" from ";
        assert!(
            messages
                .iter()
                .any(|it| it.starts_with(known) && it.ends_with("of Qzbeazq")),
            "{messages:?}"
        );
        for dry_run in [true, false] {
            let refused = forget(&mut corpus, dry_run).expect_err("Cem's recording shows it");
            assert!(
                refused.to_string().ends_with("the same movement: copy (Cem)"),
                "{refused}"
            );
        }
        corpus.undo_operation().expect("undone");
    }
    assert!(forget(&mut corpus, false).is_ok(), "nothing holds it any more");
}

#[test]
fn nothing_is_erased_while_another_program_has_the_corpus_open_and_searches_that_name_the_person_go() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = two_signers(folder.path());
    let searches = [("hers", "signer=Qzbeazq"), ("chin", "placement=chin")].map(|(name, query)| crate::KeptSearch {
        name: name.into(),
        query: query.into(),
    });
    corpus.keep_searches(&searches).expect("kept");
    let other = rusqlite::Connection::open(corpus.corpus_file_path()).expect("open");
    let reading = other.unchecked_transaction().expect("reading");
    let _: i64 = reading
        .query_row("SELECT count(*) FROM signer", [], |row| row.get(0))
        .expect("read");
    let refused = forget(&mut corpus, false).expect_err("it is open elsewhere");
    assert!(refused.to_string().contains("another program"), "{refused}");
    let names = |corpus: &Corpus| {
        let rows = stored_recordings::load_recording_rows(corpus.store.read_connection()).expect("read");
        rows.len()
    };
    assert_eq!(names(&corpus), 3, "nothing has gone");
    drop(reading);
    drop(other);
    let done = forget(&mut corpus, false).expect("forgotten");
    assert_eq!(done.searches, ["hers"]);
    assert_eq!(names(&corpus), 2);
    let kept: Vec<String> = corpus
        .kept_searches()
        .expect("read")
        .into_iter()
        .map(|kept| kept.name)
        .collect();
    assert_eq!(kept, ["chin"]);
}
