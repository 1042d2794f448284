//! Shared parts of the tests that drive the window.
#![allow(dead_code, unreachable_pub, reason = "each test uses some of it")]

pub mod studies;
pub mod tiers;

use std::path::{Path, PathBuf};
use std::time::Duration;

use chereme_corpus::{Corpus, ImportOptions, ProgressReceiver, ignore_progress_step, unpack_starter};
use chereme_studio::{InterfaceLanguage, Studio, StudioFolders, StudioOptions};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

pub type Window<'a> = Harness<'a, Studio>;

pub fn options(folder: &Path) -> StudioOptions {
    StudioOptions {
        corpus: None,
        author: "Zoé".into(),
        folders: StudioFolders {
            config: Some(folder.join("config")),
            data: Some(folder.join("data")),
        },
        language: InterfaceLanguage::English,
        asked_language: None,
    }
}

pub fn window<'a>(options: StudioOptions) -> Window<'a> {
    Harness::builder()
        .with_size([1280.0, 1040.0])
        .with_step_dt(1.0 / 60.0)
        .build_ui_state(|ui, studio: &mut Studio| studio.ui(ui), Studio::new(options))
}

/// Draws frames until `done`, for at most a minute.
pub fn until(window: &mut Window<'_>, what: &str, done: impl Fn(&Window<'_>) -> bool) {
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

pub fn idle(window: &mut Window<'_>) {
    until(window, "an idle window", |window| window.state().is_idle());
}

pub fn has(window: &Window<'_>, label: &str) -> bool {
    window.query_all_by_label(label).next().is_some()
}

pub fn contains(window: &Window<'_>, label: &str) -> bool {
    window.query_all_by_label_contains(label).next().is_some()
}

pub fn click(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click();
    window.step();
    window.step();
}

pub fn open_starter<'a>(folder: &Path) -> Window<'a> {
    let mut window = window(options(folder));
    window.step();
    click(&mut window, "Open the starter corpus");
    until(&mut window, "the starter corpus", |window| has(window, "aimer"));
    idle(&mut window);
    window
}

/// Returns a corpus with one recording and its tiers.
pub fn small_corpus(folder: &Path) -> PathBuf {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let wanted = |path: &PathBuf| path.file_stem().is_some_and(|stem| stem == "escargot");
    let files: Vec<PathBuf> = files.into_iter().filter(wanted).collect();
    let path = folder.join("small.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let options = ImportOptions::default();
    corpus.import_paths(&files, &options, &mut progress).expect("imported");
    path
}

pub fn open_small<'a>(folder: &Path) -> Window<'a> {
    let corpus = Some(small_corpus(folder));
    let mut window = window(StudioOptions {
        corpus,
        ..options(folder)
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    window
}
