//! The pane of agreement, used like a person: two tiers, the measures, the list of disagreements by mouse and keys, and
//! a third tier with its conflicts.

mod common;

use std::path::{Path, PathBuf};

use chereme_corpus::{
    AgreeOptions, AnnotateOptions, AnnotationAction, Corpus, ImportOptions, NewTier, ProgressReceiver,
    RecordingInstant, RowName, TableMoment, TierRequestName, TierRole, ignore_progress_step,
};
use chereme_studio::{InterfaceLanguage, StudioOptions};
use common::tiers::{ALT, CTRL, operations, stored};
use common::*;
use eframe::egui::Key;
use egui_kittest::kittest::{NodeT, Queryable};

/// The glosses of both annotators in milliseconds; they agree on the first eleven.
const BOTH: [&str; 11] = ["A", "B", "C", "A", "B", "C", "D", "A", "D", "B", "C"];

fn glosses(second: bool) -> Vec<(String, i64, i64)> {
    let same = BOTH.iter().zip(0..);
    let mut all: Vec<(String, i64, i64)> = same.map(|(it, at)| ((*it).to_owned(), 60 * at, 60 * at + 50)).collect();
    all.push(match second {
        true => ("CHIEN".to_owned(), 700, 800),
        false => ("CHAT".to_owned(), 700, 800),
    });
    match second {
        true => all.push(("LONG".to_owned(), 820, 1100)),
        false => {
            all.push(("LONG".to_owned(), 820, 1000));
            all.push(("SEUL".to_owned(), 1150, 1200));
        }
    }
    all
}

fn write_tier(corpus: &mut Corpus, name: &str, glosses: &[(String, i64, i64)]) {
    let recording = RowName::Number(1);
    corpus
        .add_tier(&NewTier::new(recording.clone(), name, TierRole::Free))
        .expect("a tier");
    let time = |millis| Some(TableMoment::Time(RecordingInstant::from_millis(millis)));
    let add = |(value, start, end): &(String, i64, i64)| {
        AnnotationAction::Add {
            tier: TierRequestName::Of {
                recording: recording.clone(),
                tier: name.to_owned(),
            },
            start: time(*start),
            end: time(*end),
            parent: None,
            order: None,
            value: value.clone(),
            confidence: None,
        }
        .into()
    };
    let changes: Vec<_> = glosses.iter().map(add).collect();
    let mut hear = ignore_progress_step;
    corpus
        .annotate_corpus(
            &changes,
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("annotated");
}

fn coded_twice(folder: &Path) -> PathBuf {
    let path = small_corpus(folder);
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    write_tier(&mut corpus, "Notes Anna", &glosses(false));
    write_tier(&mut corpus, "Notes Ben", &glosses(true));
    path
}

fn opened<'a>(folder: &Path, language: InterfaceLanguage) -> Window<'a> {
    let corpus = Some(coded_twice(folder));
    let mut window = window(StudioOptions {
        corpus,
        language,
        ..options(folder)
    });
    until(&mut window, "the corpus", |it| contains(it, "escargot"));
    idle(&mut window);
    window.key_press_modifiers(CTRL, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(CTRL | ALT, Key::B);
    window.run_steps(3);
    window
}

fn playhead_ms(window: &Window<'_>) -> i64 {
    (window.state().playhead_instant().instant_micros() + 500) / 1000
}

#[test]
fn two_tiers_are_proposed_and_their_disagreements_opened_by_mouse_and_keys() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    until(&mut window, "the comparison", |it| has(it, "Disagreements (3)"));
    assert!(has(&window, "First tier: Notes Anna") && has(&window, "Second tier: Notes Ben"));
    assert!(has(&window, "14 and 13 annotations; matched 13, of equal value 12"));
    // The figures are those of the library.
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let options = AgreeOptions::new("Notes Anna", "Notes Ben");
    let mut hear = ignore_progress_step;
    let found = corpus
        .compare_annotators(&options, &mut ProgressReceiver::new(&mut hear))
        .expect("compared");
    for name in ["raw", "kappa_ipf", "alpha_u", "matched"] {
        let figure = found.measures.iter().find(|it| it.0 == name).expect(name);
        let text = figure.1.figure_text().expect("a value");
        assert!(has(&window, &text), "{name} {text}");
    }
    assert!(!has(&window, "gamma"), "only on request");
    click(&mut window, "CHAT ≠ CHIEN");
    assert_eq!(playhead_ms(&window), 700);
    // The list follows by arrows from there, and by keys from everywhere.
    window.run_steps(2);
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    assert_eq!(playhead_ms(&window), 1150);
    let row = window.get_by_label("SEUL: only Notes Anna");
    assert!(row.accesskit_node().is_focused());
    window.key_press_modifiers(ALT, Key::PageDown);
    window.run_steps(3);
    assert_eq!(playhead_ms(&window), 820);
    assert!(has(&window, "LONG: start +0 ms, end +100 ms") && has(&window, "3 of 3"));
    window.key_press_modifiers(ALT, Key::PageDown);
    window.run_steps(3);
    assert!(contains(&window, "There is no further disagreement"));
    window.key_press_modifiers(ALT, Key::PageUp);
    window.run_steps(3);
    assert_eq!(playhead_ms(&window), 1150);
    // A row that has the focus is opened by Enter.
    window.get_by_label("CHAT ≠ CHIEN").focus();
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(3);
    assert_eq!(playhead_ms(&window), 700);
    click(&mut window, "Gamma");
    until(&mut window, "gamma", |it| has(it, "gamma"));
    for (view, shown) in [
        ("Values", "CHIEN"),
        ("Confusions", "CHAT"),
        ("All measures", "label_pi"),
    ] {
        click(&mut window, view);
        assert!(has(&window, shown), "{view}");
    }
}

#[test]
fn a_third_tier_is_written_decided_in_the_history_and_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    until(&mut window, "the comparison", |it| has(it, "Disagreements (3)"));
    let before = operations(&window);
    click(&mut window, "Write the third tier");
    stored(&mut window, before);
    until(&mut window, "the third tier", |it| {
        has(it, "Notes: 11 agreed, 3 to decide")
    });
    assert_eq!(common::tiers::values(&window, "Notes").len(), 14);
    click(&mut window, "Decide them in the history");
    until(&mut window, "the conflicts", |it| has(it, "Conflicts (3)"));
    let before = operations(&window);
    window.key_press_modifiers(CTRL, Key::Z);
    stored(&mut window, before);
    window.key_press_modifiers(CTRL | ALT, Key::B);
    window.run_steps(3);
    assert!(!contains(&window, "to decide"), "undone");
    assert!(!has(&window, "Conflicts (3)"));
}

#[test]
fn the_pane_speaks_french_and_advises_without_two_tiers() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::French);
    until(&mut window, "the comparison", |it| has(it, "Désaccords (3)"));
    assert!(has(&window, "SEUL : seulement Notes Anna"));
    drop(window);
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(ALT, Key::PageDown);
    window.run_steps(3);
    assert!(contains(&window, "Compare two tiers in the pane Agreement first"));
    window.key_press_modifiers(CTRL | ALT, Key::B);
    until(&mut window, "advice", |it| {
        contains(it, "Choose the tiers of two annotators")
    });
}

#[test]
fn a_low_and_narrow_pane_shows_the_names_of_all_lists_and_the_opened_row() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    until(&mut window, "the comparison", |it| has(it, "Disagreements (3)"));
    window.set_size([1280.0, 800.0].into());
    window.key_press_modifiers(CTRL, Key::F1);
    window.run_steps(3);
    window.key_press_modifiers(CTRL | ALT, Key::B);
    window.run_steps(3);
    for _ in 0..3 {
        window.key_press_modifiers(ALT, Key::PageDown);
        window.run_steps(20);
    }
    // The timeline lies below the pane, and the stage beside it.
    let [right, bottom] = [0.262 * 1280.0, 0.575 * 800.0];
    let name = window.get_by_label("All measures").rect();
    assert!(name.right() < right, "{name}");
    let row = window.get_by_label("LONG: start +0 ms, end +100 ms").rect();
    assert!(row.right() < right && row.bottom() < bottom, "{row}");
}

#[test]
fn a_recording_without_two_tiers_asks_for_another_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = chereme_corpus::unpack_starter(&folder.path().join("files")).expect("unpacked");
    let is_movement = |path: &&PathBuf| path.ends_with("escargot.bvh");
    let file = files.iter().find(is_movement).expect("a movement");
    let path = folder.path().join("bare.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(std::slice::from_ref(file), &ImportOptions::default(), &mut progress)
        .expect("imported");
    let mut window = window(StudioOptions {
        corpus: Some(path),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |it| contains(it, "escargot"));
    idle(&mut window);
    window.key_press_modifiers(CTRL | ALT, Key::B);
    until(&mut window, "advice", |it| {
        has(it, "Open a recording with the tiers of two annotators.")
    });
}
