//! A window that is killed while somebody types: the typed text is restored when the corpus is opened again.

mod common;

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use chereme_corpus::Corpus;
use chereme_studio::StudioOptions;
use common::{Window, has, idle, options, small_corpus, until, window};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

/// The environment variable with the folder for the process that types and is killed.
const TYPIST: &str = "CHEREME_TEST_TYPIST";

fn open<'a>(folder: &Path, corpus: &Path) -> Window<'a> {
    let mut window = window(StudioOptions {
        corpus: Some(corpus.to_owned()),
        ..options(folder)
    });
    until(&mut window, "the tiers", |it| has(it, "Tier Gloss"));
    window
}

/// Opens the first gloss for typing.
fn edit(window: &mut Window<'_>) {
    idle(window);
    window.key_press_modifiers(Modifiers::ALT, Key::ArrowRight);
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(2);
}

fn field(window: &Window<'_>) -> Option<String> {
    window.query_by_label("Value on Gloss")?.value()
}

fn glosses(corpus: &Path) -> Vec<String> {
    let corpus = Corpus::open_corpus(corpus, "reader").expect("opened");
    let recording = corpus.load_corpus_overview(1).expect("read").recordings[0].row.id;
    let contents = corpus.load_recording_contents(recording).expect("read");
    let tier = contents.tiers.iter().find(|it| it.row.name == "Gloss");
    tier.expect("a tier")
        .annotations
        .values
        .iter()
        .map(|it| it.to_string())
        .collect()
}

/// Types letter after letter until the process is killed, and reports each after its frame.
#[test]
fn typist() {
    let Some(folder) = std::env::var_os(TYPIST).map(PathBuf::from) else {
        return;
    };
    let mut window = open(&folder, &folder.join("small.chereme"));
    edit(&mut window);
    let mut output = std::io::stdout();
    for letter in ('a'..='z').cycle() {
        window.event(eframe::egui::Event::Text(letter.to_string()));
        window.step();
        let typed = field(&window).expect("the field is open");
        writeln!(output, "typed {typed}").expect("told");
        output.flush().expect("told");
    }
}

#[test]
fn text_typed_before_a_kill_is_restored_in_place() {
    for letters in [1, 7] {
        let folder = tempfile::tempdir().expect("a folder");
        let corpus = small_corpus(folder.path());
        let stored = glosses(&corpus);
        let program = std::env::current_exe().expect("this program");
        let mut typist = Command::new(program)
            .args(["--exact", "typist", "--nocapture"])
            .env(TYPIST, folder.path())
            .stdout(Stdio::piped())
            .spawn()
            .expect("started");
        let lines = BufReader::new(typist.stdout.take().expect("its words")).lines();
        let mut typed = String::new();
        let mut heard = 0;
        for line in lines {
            let line = line.expect("a line");
            let Some(text) = line.strip_prefix("typed ") else {
                continue;
            };
            text.clone_into(&mut typed);
            heard += 1;
            if heard == letters {
                typist.kill().expect("killed");
            }
        }
        typist.wait().expect("over");
        assert_eq!(glosses(&corpus), stored);
        let mut window = open(folder.path(), &corpus);
        until(&mut window, "the text", |it| field(it).is_some());
        let back = field(&window).expect("the field");
        window.run_steps(3);
        let tier = window.get_by_label("Tier Gloss");
        let chosen = format!("{:?}", tier.accesskit_node().toggled());
        assert!(chosen.contains("True"), "its tier is turned to");
        // The last letter may have been written without being reported.
        assert!(back.starts_with(&typed), "{back:?} is not {typed:?}");
        window.key_press(Key::Enter);
        window.run_steps(2);
        idle(&mut window);
        assert_eq!(glosses(&corpus)[0], back);
        drop(window);
        let mut window = open(folder.path(), &corpus);
        idle(&mut window);
        assert_eq!(field(&window), None);
    }
}

#[test]
fn a_discarded_draft_is_not_restored() {
    let folder = tempfile::tempdir().expect("a folder");
    let corpus = small_corpus(folder.path());
    let stored = glosses(&corpus);
    let mut window = open(folder.path(), &corpus);
    edit(&mut window);
    window.get_by_label("Value on Gloss").type_text("half");
    window.run_steps(2);
    drop(window);
    let mut window = open(folder.path(), &corpus);
    until(&mut window, "the text", |it| field(it).as_deref() == Some("half"));
    window.key_press(Key::Escape);
    window.run_steps(2);
    drop(window);
    let mut window = open(folder.path(), &corpus);
    idle(&mut window);
    assert_eq!(field(&window), None);
    assert_eq!(glosses(&corpus), stored);
}
