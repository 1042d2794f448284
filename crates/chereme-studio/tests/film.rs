//! Films, driven by labels: next to the signer, alone on the stage, aligned with the movement, missing, damaged.

mod common;

use std::path::{Path, PathBuf};

use chereme_corpus::{
    Corpus, CorpusAddress, ImportOptions, MediaChange, PictureOptions, ProgressReceiver, RowName, TrackChange,
    ignore_progress_step, unpack_starter,
};
use chereme_studio::StudioOptions;
use common::{Window, click, has, idle, options, small_corpus, until, window};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

fn shows(window: &Window<'_>, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

/// Writes a film next to the small corpus that shows its sign.
fn film(corpus: &mut Corpus, folder: &Path) -> PathBuf {
    let path = folder.join("film.mp4");
    let options = PictureOptions {
        height: Some(96),
        ..PictureOptions::default()
    };
    let mut hear = ignore_progress_step;
    let address: CorpusAddress = "ESCARGOT".parse().expect("an address");
    corpus
        .draw_movement_file(&address, &path, &options, &mut ProgressReceiver::new(&mut hear))
        .expect("drawn");
    path
}

/// Opens the small corpus with a film linked to its recording.
fn filmed<'a>(folder: &Path) -> (Window<'a>, PathBuf) {
    let path = small_corpus(folder);
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    film(&mut corpus, folder);
    let take = RowName::Text("escargot".to_owned());
    corpus
        .change_media(&take, &MediaChange::Add("film.mp4".to_owned()))
        .expect("linked");
    drop(corpus);
    let options = StudioOptions {
        corpus: Some(path.clone()),
        ..options(folder)
    };
    (window(options), path)
}

/// Opens a corpus with only an EAF file that names this film.
fn film_alone<'a>(folder: &Path, film: &str) -> Window<'a> {
    let eaf = folder.join("talk.eaf");
    let text = format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<ANNOTATION_DOCUMENT AUTHOR="" DATE="2020-01-01T00:00:00+00:00" FORMAT="3.0" VERSION="3.0">
<HEADER MEDIA_FILE="" TIME_UNITS="milliseconds"><MEDIA_DESCRIPTOR MEDIA_URL="file:///D:/gone/{film}" MIME_TYPE="video/mp4"/></HEADER>
<TIME_ORDER><TIME_SLOT TIME_SLOT_ID="a" TIME_VALUE="0"/><TIME_SLOT TIME_SLOT_ID="b" TIME_VALUE="200"/></TIME_ORDER>
<TIER LINGUISTIC_TYPE_REF="t" TIER_ID="Gloss"><ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="a" TIME_SLOT_REF2="b"><ANNOTATION_VALUE>MAISON</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER>
<LINGUISTIC_TYPE LINGUISTIC_TYPE_ID="t" TIME_ALIGNABLE="true"/>
</ANNOTATION_DOCUMENT>"#
    );
    std::fs::write(&eaf, text).expect("written");
    let path = folder.join("talk.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    corpus
        .import_paths(&[eaf], &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear))
        .expect("imported");
    drop(corpus);
    window(StudioOptions {
        corpus: Some(path),
        ..options(folder)
    })
}

fn offset(path: &Path) -> i64 {
    let corpus = Corpus::open_corpus(path, "B").expect("opened");
    let tracks = corpus.recording_tracks(&RowName::Text("escargot".to_owned()));
    let tracks = tracks.expect("read");
    let film = tracks.iter().find(|it| it.name == "linked 1");
    film.expect("a film").offset_us
}

#[test]
fn a_film_plays_next_to_the_signer_and_as_an_overlay() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, path) = filmed(folder.path());
    // The film and the signer are read apart: either may be there first.
    until(&mut window, "the film beside the signer", |window| {
        shows(window, "film frame 1 of") && shows(window, "The signer: ")
    });
    assert!(has(&window, "film.mp4"));
    for _ in 0..6 {
        window.key_press_modifiers(Modifiers::ALT, Key::Period);
        window.run_steps(2);
    }
    assert_eq!(window.state().playhead_instant().instant_micros(), 240_000);
    assert!(shows(&window, "film frame 7 of"));
    until(&mut window, "its picture", |window| window.state().is_filmed());
    // The film stands still while the movement goes on, and is then aligned with it.
    click(&mut window, "Hold");
    for _ in 0..3 {
        window.key_press_modifiers(Modifiers::SHIFT, Key::ArrowRight);
        window.run_steps(2);
    }
    assert!(shows(&window, "film frame 7 of"));
    let there = window.state().playhead_instant().instant_micros();
    click(&mut window, "This frame is here");
    idle(&mut window);
    assert_eq!(offset(&path), there - 240_000);
    assert!(shows(&window, "film frame 7 of"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.run_steps(2);
    idle(&mut window);
    assert_eq!(offset(&path), 0);
}

#[test]
fn the_film_moves_from_the_stage_to_its_pane_while_that_is_visible() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, _) = filmed(folder.path());
    until(&mut window, "the film", |window| shows(window, "film frame 1 of"));
    let width = |window: &Window<'_>| window.get_by_label("film.mp4").rect().width();
    let beside = width(&window);
    window.key_press_modifiers(Modifiers::SHIFT, Key::F5);
    window.run_steps(4);
    assert!(width(&window) < beside, "it is in the pane, and once");
    window.key_press_modifiers(Modifiers::SHIFT, Key::F4);
    window.run_steps(4);
    assert_eq!(width(&window), beside);
}

#[test]
fn a_film_without_movement_is_on_the_stage_and_stepped_through() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    film(&mut corpus, folder.path());
    drop(corpus);
    let mut window = film_alone(folder.path(), "film.mp4");
    until(&mut window, "the film", |window| shows(window, "film frame 1 of"));
    assert!(!shows(&window, "The signer: "));
    for frame in 1..=9 {
        window.key_press_modifiers(Modifiers::COMMAND, Key::ArrowRight);
        window.run_steps(2);
        assert_eq!(window.state().playhead_instant().instant_micros(), frame * 40_000);
    }
    // The film continues after the end of the annotations.
    assert!(shows(&window, "film frame 10 of"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::ArrowLeft);
    window.run_steps(2);
    assert!(shows(&window, "film frame 9 of"));
}

#[test]
fn a_missing_or_damaged_film_is_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = film_alone(folder.path(), "nowhere.mp4");
    until(&mut window, "word of it", |window| has(window, "Find it…"));
    let folder = tempfile::tempdir().expect("a folder");
    let broken = folder.path().join("broken.mp4");
    std::fs::write(broken, b"\0\0\0\x08ftyp\0\0\0\x07moov").expect("written");
    let mut window = film_alone(folder.path(), "broken.mp4");
    until(&mut window, "word of it", |window| has(window, "Find it…"));
}

#[test]
fn a_missing_film_takes_a_line_below_the_films_that_are_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut alone, path) = filmed(folder.path());
    let shown = |window: &mut Window<'_>| {
        until(window, "the film", |window| shows(window, "film frame 1 of"));
        window.get_by_label("film.mp4").rect()
    };
    let before = shown(&mut alone);
    drop(alone);
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let take = RowName::Text("escargot".to_owned());
    corpus
        .change_media(&take, &MediaChange::Add("nowhere.mp4".to_owned()))
        .expect("linked");
    drop(corpus);
    let mut window = window(StudioOptions {
        corpus: Some(path),
        ..options(folder.path())
    });
    until(&mut window, "word of it", |window| {
        shows(window, "Missing: nowhere.mp4")
    });
    let after = shown(&mut window);
    assert_eq!(before.width(), after.width());
    assert!(before.height() - after.height() < 30.0);
}

#[test]
fn a_recording_does_not_last_as_long_as_the_film_of_the_recording_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    film(&mut corpus, folder.path());
    let files = unpack_starter(&folder.path().join("more")).expect("unpacked");
    let bol = files.into_iter().filter(|it| it.ends_with("bol.bvh"));
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let options_of_import = ImportOptions::default();
    corpus
        .import_paths(&bol.collect::<Vec<_>>(), &options_of_import, &mut progress)
        .expect("imported");
    let take = RowName::Text("escargot".to_owned());
    let link = MediaChange::Add("film.mp4".to_owned());
    corpus.change_media(&take, &link).expect("linked");
    let late = TrackChange::Offset(20_000_000);
    corpus.change_track(&take, "linked 1", &late).expect("moved");
    drop(corpus);
    let mut window = window(StudioOptions {
        corpus: Some(path),
        ..options(folder.path())
    });
    until(&mut window, "the film", |window| {
        has(window, "film.mp4") && window.state().is_filmed()
    });
    let end = |window: &mut Window<'_>| {
        click(window, "To the end");
        window.run_steps(3);
        window.state().playhead_instant().instant_micros()
    };
    assert!(end(&mut window) > 20_000_000);
    click(&mut window, "bol");
    idle(&mut window);
    until(&mut window, "the other recording", |window| !has(window, "film.mp4"));
    assert!(end(&mut window) < 10_000_000);
}
