//! Shared parts of the tests that drive the timeline.

use std::collections::BTreeMap;

use chereme_corpus::{AnnotationColumns, Corpus};
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, pos2};
use egui_kittest::kittest::Queryable;

use super::{Window, click, has, idle, open_small, until};

pub const CTRL: Modifiers = Modifiers::COMMAND;
pub const ALT: Modifiers = Modifiers::ALT;
pub const NONE: Modifiers = Modifiers::NONE;

pub fn opened<'a>(folder: &std::path::Path) -> Window<'a> {
    let mut window = open_small(folder);
    until(&mut window, "the tiers", |it| has(it, "Tier Gloss"));
    idle(&mut window);
    window
}

/// Returns the annotations of a tier, as `(start in milliseconds, end, value)`.
pub fn says(window: &Window<'_>, tier: &str) -> Vec<(i64, i64, String)> {
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let recording = corpus.load_corpus_overview(1).expect("read").recordings[0].row.id;
    let contents = corpus.load_recording_contents(recording).expect("read");
    let tier = contents.tiers.iter().find(|it| it.row.name == tier);
    let columns: AnnotationColumns = tier.expect("a tier").annotations.clone();
    (0..columns.len())
        .map(|at| {
            let millis = |micros: i64| (micros + 500) / 1000;
            (
                millis(columns.starts[at]),
                millis(columns.ends[at]),
                columns.values[at].to_string(),
            )
        })
        .collect()
}

/// Returns the values of a tier.
pub fn values(window: &Window<'_>, tier: &str) -> Vec<String> {
    says(window, tier).into_iter().map(|it| it.2).collect()
}

pub fn operations(window: &Window<'_>) -> usize {
    let path = window.state().shown_corpus_path().expect("open").clone();
    Corpus::open_corpus(&path, "reader")
        .expect("opened")
        .operation_log(999)
        .expect("read")
        .len()
}

pub fn press(window: &mut Window<'_>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(2);
}

/// Draws frames until an edit is in the corpus and in the window.
pub fn stored(window: &mut Window<'_>, operations_before: usize) {
    until(window, "the edit", |it| {
        it.state().is_idle() && operations(it) > operations_before
    });
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let stored = corpus.corpus_generation().expect("read");
    until(window, "what was stored", |it| {
        it.state().shown_generation() >= Some(stored)
    });
    window.run_steps(2);
}

pub fn rect(window: &Window<'_>, label: &str) -> eframe::egui::Rect {
    window.get_by_label(label).rect()
}

pub fn pointer(window: &mut Window<'_>, at: Pos2, pressed: Option<bool>, modifiers: Modifiers) {
    window.event_modifiers(Event::PointerMoved(at), modifiers);
    if let Some(pressed) = pressed {
        let event = Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers,
        };
        window.event_modifiers(event, modifiers);
    }
    window.step();
}

pub fn drag(window: &mut Window<'_>, from: Pos2, to: Pos2, modifiers: Modifiers) {
    pointer(window, from, None, modifiers);
    pointer(window, from, Some(true), modifiers);
    for step in 1..=4 {
        let at = from + (to - from) * (step as f32 / 4.0);
        pointer(window, at, None, modifiers);
    }
    pointer(window, to, Some(false), modifiers);
    window.step();
}

pub fn click_with(window: &mut Window<'_>, label: &str, modifiers: Modifiers) {
    let at = rect(window, label).center();
    pointer(window, at, Some(true), modifiers);
    pointer(window, at, Some(false), modifiers);
    window.run_steps(2);
}

/// Opens a window and removes every gloss annotation, so that the tier is empty.
pub fn emptied<'a>(folder: &std::path::Path) -> Window<'a> {
    let mut window = opened(folder);
    click(&mut window, "Tier Gloss");
    press(&mut window, CTRL, Key::A);
    let before = operations(&window);
    press(&mut window, CTRL | ALT, Key::D);
    stored(&mut window, before);
    assert!(says(&window, "Gloss").is_empty());
    window
}

/// Opens a window with three glosses a, b, c at 10-20, 30-40 and 60-70 % of the recording.
pub fn three<'a>(folder: &std::path::Path) -> Window<'a> {
    let mut window = emptied(folder);
    let lane = rect(&window, "Lane of Gloss");
    for (text, from, to) in [("a", 0.1, 0.2), ("b", 0.3, 0.4), ("c", 0.6, 0.7)] {
        let at = |x: f32| pos2(lane.left() + lane.width() * x, lane.center().y);
        let before = operations(&window);
        drag(&mut window, at(from), at(to), ALT);
        window.get_by_label("Value on Gloss").type_text(text);
        window.step();
        press(&mut window, NONE, Key::Enter);
        stored(&mut window, before);
    }
    // Snapping is off, so that distances are those of the mouse.
    for switch in [Key::F6, Key::F7] {
        press(&mut window, Modifiers::SHIFT, switch);
    }
    window
}

pub fn spans(window: &Window<'_>) -> BTreeMap<String, (i64, i64)> {
    let all = says(window, "Gloss").into_iter();
    all.map(|(start, end, value)| (value, (start, end))).collect()
}
