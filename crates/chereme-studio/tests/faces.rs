//! The pane of faces, used like a person: candidates side by side, reasons, milestones, storing with one click, and
//! undo.

mod common;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use chereme_corpus::{
    AnnotateOptions, AnnotationAction, AnnotationName, Corpus, CorpusAddress, ImportOptions, ListFilter, ListKind,
    NewTier, ProgressReceiver, RecordingInstant, RowName, TableMoment, TierRequestName, TierRole, ignore_progress_step,
};
use chereme_studio::{InterfaceLanguage, StudioOptions};
use common::tiers::{ALT, CTRL, operations, stored};
use common::*;
use eframe::egui::Key;
use egui_kittest::kittest::Queryable;

const SIGNS: [(&str, i64, i64); 4] = [
    ("HIER", 200, 600),
    ("ANNA", 700, 1100),
    ("AIMER", 1200, 1600),
    ("QUOI", 1700, 2300),
];

/// Writes a face whose brows are raised up to `most` during the question.
fn write_face(path: &Path, most: f64) {
    let mut text =
        String::from("time [s],brow_raise_right,brow_raise_left,brow_squeeze,jaw_open,head_pitch,head_yaw,head_roll\n");
    for frame in 0..180 {
        let at = f64::from(frame) / 60.0;
        let up = most * ((at - 0.6) / 0.1).min((2.6 - at) / 0.3).clamp(0.0, 1.0);
        writeln!(text, "{at:.6},{up:.6},{up:.6},0,0.1,{:.6},0,0", 0.2 * up).expect("text");
    }
    std::fs::write(path, text).expect("written");
}

fn tier(corpus: &mut Corpus, recording: &str, name: &str, role: TierRole, spans: &[(&str, i64, i64)]) {
    let recording = RowName::Text(recording.to_owned());
    corpus
        .add_tier(&NewTier::new(recording.clone(), name, role))
        .expect("a tier");
    let time = |millis| Some(TableMoment::Time(RecordingInstant::from_millis(millis)));
    let add = |(value, start, end): &(&str, i64, i64)| {
        AnnotationAction::Add {
            tier: TierRequestName::Of {
                recording: recording.clone(),
                tier: name.to_owned(),
            },
            start: time(*start),
            end: time(*end),
            parent: None,
            order: None,
            value: (*value).to_owned(),
            confidence: None,
        }
        .into()
    };
    let changes: Vec<_> = spans.iter().map(add).collect();
    let mut hear = ignore_progress_step;
    corpus
        .annotate_corpus(
            &changes,
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("annotated");
}

/// Returns a corpus with four wh questions whose brows are raised by different amounts.
fn questions(folder: &Path) -> PathBuf {
    let path = folder.join("faces.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    for (name, most) in [("W1", 1.0), ("W2", 0.2), ("W3", 0.9), ("W4", 0.6)] {
        let file = folder.join(format!("{name}.csv"));
        write_face(&file, most);
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(
                &[file],
                &ImportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("imported");
        tier(&mut corpus, name, "gloss", TierRole::Gloss, &SIGNS);
        tier(&mut corpus, name, "function", TierRole::Free, &[("wh", 700, 2300)]);
    }
    path
}

fn opened<'a>(folder: &Path, language: InterfaceLanguage) -> Window<'a> {
    let corpus = Some(questions(folder));
    let mut window = window(StudioOptions {
        corpus,
        language,
        ..options(folder)
    });
    until(&mut window, "the corpus", |it| contains(it, "W1"));
    idle(&mut window);
    // The layout for searching gives the pane half of the window.
    window.key_press_modifiers(CTRL, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(CTRL | ALT, Key::V);
    window.run_steps(3);
    window
}

fn rows(window: &Window<'_>, kind: ListKind) -> usize {
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let found = corpus.list_rows(kind, &ListFilter::default()).expect("listed");
    found.total as usize
}

#[test]
fn a_face_is_chosen_explained_and_applied_to_the_sentence_with_one_click() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    until(&mut window, "candidates", |it| contains(it, "1. W3: score"));
    assert!(contains(&window, "W1, its own face"));
    assert!(contains(&window, "2. W4: score") && contains(&window, "3. W2: score"));
    assert!(has(&window, "Why W3"), "the first is chosen");
    for phase in ["onset", "first part", "rest", "offset", "brow_raise_right"] {
        assert!(has(&window, phase), "{phase}");
    }
    window.get_by_label_contains("2. W4: score").click();
    window.run_steps(3);
    assert!(has(&window, "Why W4"));
    let before = (operations(&window), rows(&window, ListKind::Recordings));
    click(&mut window, "Put this face on the sentence");
    stored(&mut window, before.0);
    until(&mut window, "the new sign", |it| has(it, "W1-WH-W4 is stored"));
    assert_eq!(rows(&window, ListKind::Recordings), before.1 + 1);
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let made = corpus
        .movement_at_address(&CorpusAddress::Gloss("W1-WH-W4".into()))
        .expect("movement");
    let brows = made.faces[made
        .clip
        .clip_frame_rate()
        .nearest_frame_at(RecordingInstant::from_millis(1500))]
    .brows[0];
    assert!((brows - 0.6).abs() < 0.02, "{brows}");
    drop(corpus);
    let before = operations(&window);
    window.key_press_modifiers(CTRL, Key::Z);
    stored(&mut window, before);
    assert_eq!(rows(&window, ListKind::Recordings), 4, "undone");
}

#[test]
fn milestones_are_shown_written_as_a_tier_and_corrected() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    until(&mut window, "milestones", |it| has(it, "M2 0.700"));
    assert!(has(&window, "M3 1.700") && has(&window, "derived from the glosses"));
    let before = operations(&window);
    click(&mut window, "Write as a tier");
    stored(&mut window, before);
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut corpus = Corpus::open_corpus(&path, "Ann").expect("opened");
    let first = corpus.load_corpus_overview(4).expect("read").recordings[0].row.id;
    let contents = corpus.load_recording_contents(first).expect("read");
    let written = contents.tiers.iter().find(|it| it.row.name == "milestones wh");
    let written = written.expect("a tier of milestones");
    assert_eq!(written.annotations.len(), 4);
    let onset = AnnotationAction::Set {
        annotation: AnnotationName::Number(written.annotations.ids[0]),
        start: Some(TableMoment::Time(RecordingInstant::from_millis(500))),
        end: None,
        value: None,
    };
    let mut hear = ignore_progress_step;
    corpus
        .annotate_corpus(
            &[onset.into()],
            &AnnotateOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("corrected");
    drop(corpus);
    until(&mut window, "the correction", |it| has(it, "M1 0.500"));
    assert!(has(&window, "corrected by a person"));
}

#[test]
fn the_pane_speaks_french_and_draws_begin_and_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::French);
    until(&mut window, "candidates", |it| contains(it, "1. W3: score"));
    assert!(contains(&window, "W1, son propre visage"));
    assert!(has(&window, "Mettre ce visage sur la phrase"));
    click(&mut window, "Début et fin par rapport aux signes");
    window.run_steps(10);
    click(&mut window, "Mesurer");
    until(&mut window, "the plot", |it| contains(it, "Début et fin de"));
    assert!(has(&window, "brow_raise_right"));
}

#[test]
fn a_corpus_without_functions_says_what_to_annotate() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(CTRL | ALT, Key::V);
    until(&mut window, "advice", |it| contains(it, "No tier names the function"));
    assert!(has(&window, "Propose brows, lids, gaze, mouth and head"));
    assert!(!contains(&window, "Sentence: "), "no empty list to choose from");
}
