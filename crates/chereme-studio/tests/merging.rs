//! Conflicts of a merge, decided in the window one by one.

mod common;

use chereme_corpus::{
    AnnotateOptions, AnnotationAction, AnnotationName, Corpus, ProgressReceiver, RecordingChange, RowName,
    SignerChange, ignore_progress_step,
};
use chereme_studio::StudioOptions;
use common::*;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

/// Makes three edits with their own values in a corpus.
fn work(corpus: &mut Corpus, word: &str) {
    let change = AnnotationAction::Set {
        annotation: AnnotationName::Number(1),
        start: None,
        end: None,
        value: Some(word.to_owned()),
    };
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .annotate_corpus(&[change.into()], &AnnotateOptions::default(), progress)
        .expect("annotated");
    let recording = RecordingChange {
        notes: Some(Some(format!("{word} of the take"))),
        ..RecordingChange::default()
    };
    corpus
        .change_recording(&RowName::Number(1), &recording)
        .expect("changed");
    let signer = SignerChange {
        notes: Some(Some(format!("{word} of the signer"))),
        ..SignerChange::default()
    };
    corpus.change_signer(&RowName::Number(1), &signer).expect("changed");
}

fn press(window: &mut Window<'_>, button: &str, left: usize) {
    let first = window.query_all_by_label(button).next();
    first.expect("a button").click();
    window.step();
    let title = format!("Conflicts ({left})");
    until(window, "the decision", |window| left == 0 || has(window, &title));
    idle(window);
}

#[test]
fn three_conflicts_are_decided_and_one_decision_is_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mine = small_corpus(folder.path());
    let theirs = folder.path().join("theirs.chereme");
    std::fs::copy(&mine, &theirs).expect("copied");
    work(&mut Corpus::open_corpus(&theirs, "B").expect("opened"), "THEIRS");
    let mut corpus = Corpus::open_corpus(&mine, "A").expect("opened");
    work(&mut corpus, "MINE");
    let mut hear = ignore_progress_step;
    let report = corpus
        .merge_corpus(&theirs, None, &mut ProgressReceiver::new(&mut hear))
        .expect("merged");
    assert_eq!(report.conflicts.len(), 3, "{:?}", report.conflicts);
    drop(corpus);
    let mut window = window(StudioOptions {
        corpus: Some(mine.clone()),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::H);
    until(&mut window, "the conflicts", |window| has(window, "Conflicts (3)"));
    press(&mut window, "theirs", 2);
    press(&mut window, "mine", 1);
    press(&mut window, "Undo", 2);
    press(&mut window, "theirs", 1);
    press(&mut window, "theirs", 0);
    until(&mut window, "the last decision", |window| !has(window, "Conflicts (1)"));
    idle(&mut window);
    drop(window);
    let corpus = Corpus::open_corpus(&mine, "A").expect("opened");
    assert!(corpus.merge_conflicts(false).expect("listed").is_empty());
    let decided = corpus.merge_conflicts(true).expect("listed");
    assert_eq!(decided.len(), 3);
    assert!(decided.iter().all(|it| it.decided.is_some()));
}
