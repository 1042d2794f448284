//! The window driven by its labels, as a person would, without one being open.

use std::path::{Path, PathBuf};
use std::time::Duration;

use chereme_corpus::{Corpus, ImportOptions, Progress, unheard, unpack_starter};
use chereme_studio::{Folders, Language, Options, Studio};
use eframe::egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

type Window<'a> = Harness<'a, Studio>;

fn options(folder: &Path) -> Options {
    Options {
        corpus: None,
        author: "Zoé".into(),
        folders: Folders {
            config: Some(folder.join("config")),
            data: Some(folder.join("data")),
        },
        language: Language::English,
    }
}

fn window<'a>(options: Options) -> Window<'a> {
    Harness::builder()
        .with_size([1280.0, 1040.0])
        .with_step_dt(1.0 / 60.0)
        .build_ui_state(
            |ui, studio: &mut Studio| studio.ui(ui),
            Studio::new(options),
        )
}

/// Draws frames until `done`; a minute is more than any of this takes.
fn until(window: &mut Window<'_>, what: &str, done: impl Fn(&Window<'_>) -> bool) {
    for _ in 0..12_000 {
        window.step();
        if done(window) {
            window.step();
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("{what} never came");
}

fn idle(window: &mut Window<'_>) {
    until(window, "an idle window", |window| window.state().is_idle());
}

fn has(window: &Window<'_>, label: &str) -> bool {
    window.query_all_by_label(label).next().is_some()
}

fn click(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click();
    window.step();
    window.step();
}

fn open_starter<'a>(folder: &Path) -> Window<'a> {
    let mut window = window(options(folder));
    window.step();
    click(&mut window, "Open the starter corpus");
    until(&mut window, "the starter corpus", |window| {
        has(window, "escargot")
    });
    idle(&mut window);
    window
}

/// Returns a corpus with one recording and its tiers.
fn small_corpus(folder: &Path) -> PathBuf {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let wanted = |path: &PathBuf| path.file_stem().is_some_and(|stem| stem == "escargot");
    let files: Vec<PathBuf> = files.into_iter().filter(wanted).collect();
    let path = folder.join("small.chereme");
    let mut corpus = Corpus::create(&path, "A").expect("made");
    let mut hear = unheard;
    let mut progress = Progress::new(&mut hear);
    let options = ImportOptions::default();
    corpus
        .import(&files, &options, &mut progress)
        .expect("imported");
    path
}

fn open_small<'a>(folder: &Path) -> Window<'a> {
    let corpus = Some(small_corpus(folder));
    let mut window = window(Options {
        corpus,
        ..options(folder)
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    window
}

#[test]
fn the_starter_corpus_is_opened_and_a_recording_played() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_starter(folder.path());
    click(&mut window, "escargot");
    until(&mut window, "the tiers", |window| has(window, "Tier Gloss"));
    idle(&mut window);
    assert_eq!(window.state().playhead().micros(), 0);
    click(&mut window, "Play");
    window.run_steps(30);
    let at = window.state().playhead().micros();
    assert!((400_000..700_000).contains(&at), "{at}");
    assert!(has(&window, "Pause"));
    click(&mut window, "Pause");
    let at = window.state().playhead();
    window.run_steps(10);
    assert_eq!(window.state().playhead(), at);
    window.key_press_modifiers(Modifiers::COMMAND, Key::ArrowRight);
    window.run_steps(2);
    assert!(window.state().playhead() > at);
}

#[test]
fn the_start_page_says_what_is_wrong_and_what_helps() {
    let folder = tempfile::tempdir().expect("a folder");
    let rubbish = folder.path().join("no.chereme");
    std::fs::write(&rubbish, "rubbish, rubbish").expect("written");
    let mut window = window(Options {
        corpus: Some(rubbish),
        ..options(folder.path())
    });
    until(&mut window, "the notice", |window| has(window, "Close"));
    assert!(
        window
            .query_by_label_contains("What helps: choose a file")
            .is_some()
    );
    click(&mut window, "Close");
    window.step();
    assert!(!has(&window, "Close"));
    assert!(has(&window, "Open the starter corpus"));
}

#[test]
fn what_was_opened_and_chosen_is_remembered() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    window.run_steps(3);
    let field = "Type what you want to do";
    window.get_by_label(field).type_text("settings");
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(3);
    click(&mut window, "Français");
    window.run_steps(3);
    assert!(has(&window, "Enregistrements"));
    let path = window.state().corpus().expect("open").clone();
    drop(window);
    let mut window = self::window(options(folder.path()));
    window.run_steps(3);
    assert!(has(&window, "Ouvrir le corpus de départ"));
    let name = path.file_stem().expect("a name").to_string_lossy();
    click(&mut window, &name);
    until(&mut window, "the corpus", |window| has(window, "escargot"));
}

#[test]
fn another_programs_change_is_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = window.state().corpus().expect("open").clone();
    let mut other = Corpus::open(&path, "B").expect("opened");
    other
        .recombine("ESCARGOT | configure right U", "LIMACE")
        .expect("made");
    until(&mut window, "the new recording", |window| {
        has(window, "LIMACE")
    });
}
