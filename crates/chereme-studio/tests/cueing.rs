//! Cued speech in the window, driven by its labels: text, keys, corrections, the cuer, practice, storing.

mod common;

use common::*;
use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

fn shows(window: &Window<'_>, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

fn press(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click_accesskit();
    window.run_steps(3);
}

fn type_into(window: &mut Window<'_>, label: &str, text: &str) {
    window.get_by_label(label).focus();
    window.run_steps(2);
    window.get_by_label(label).type_text(text);
    window.run_steps(3);
}

fn open_pane(window: &mut Window<'_>) {
    window.key_press_modifiers(Modifiers::COMMAND.plus(Modifiers::ALT), Key::L);
    window.run_steps(3);
    until(window, "the pane", |window| has(window, "Practise reading"));
}

#[test]
fn a_text_is_cued_corrected_shown_and_stored() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    open_pane(&mut window);
    for name in ["Code", "Timing of the hand"] {
        let label = window.get_by_label(name).rect();
        let list = window.get_by_label_contains(&format!("{name}: ")).rect();
        let row = (label.center().y - list.center().y).abs();
        assert!(row < 6.0, "{name} stands before its list: {label} {list}");
    }
    type_into(&mut window, "Text to cue", "la maison");
    until(&mut window, "the keys", |window| has(window, "side 6 for l a"));
    let doubt = "chin 5 for m E; some pronounce the vowel differently: a click takes throat 5";
    assert!(has(&window, doubt), "the mid vowel is marked");
    press(&mut window, doubt);
    assert!(shows(&window, "throat 5 for m e"), "the click took the other vowel");
    type_into(&mut window, "Gloss of the new sign", "MAISON");
    until(&mut window, "the cuer on the stage", |window| {
        let store = window.get_by_label("Store");
        !store.accesskit_node().is_disabled()
    });
    idle(&mut window);
    press(&mut window, "Store");
    until(&mut window, "the stored sign", |window| {
        shows(window, "Stored as MAISON")
    });
    idle(&mut window);
    // The pane never reports an undone sign as stored.
    press(&mut window, "Edit");
    window.run_steps(2);
    window.get_by_label_contains("Undo").click_accesskit();
    window.run_steps(2);
    idle(&mut window);
    until(&mut window, "the snapshot without the sign", |window| {
        !shows(window, "Stored as MAISON")
    });
    press(&mut window, "Change the pronunciation of la: l a");
    until(&mut window, "the phones of a word", |window| {
        has(window, "Phones of la")
    });
}

#[test]
fn reading_is_practised_with_words_that_look_alike() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    open_pane(&mut window);
    press(&mut window, "Practise reading");
    until(&mut window, "the sets", |window| has(window, "pain, bain, main"));
    press(&mut window, "pain, bain, main");
    until(&mut window, "the question", |window| has(window, "What was cued?"));
    idle(&mut window);
    until(&mut window, "a stage that does not name the word", |window| {
        shows(window, "what is it?")
    });
    for word in ["pain", "bain", "main"] {
        let named = format!("The stage shows {word}");
        assert!(!shows(&window, &named), "{named}");
    }
    press(&mut window, "bain");
    assert!(has(&window, "Right: bain") || shows(&window, "No, it was"));
    assert!(has(&window, "1 of 1 right") || has(&window, "0 of 1 right"));
    press(&mut window, "From the side");
    press(&mut window, "Next word");
    idle(&mut window);
    press(&mut window, "Reveal the word");
    // The revealed word is a label of the same text.
    window.get_by_role_and_label(Role::Button, "main").click_accesskit();
    window.run_steps(3);
    assert!(shows(&window, "of 1 right"), "a revealed word counts for nothing");
}

#[test]
fn slips_of_a_recording_without_phones_are_refused_with_an_explanation() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    open_pane(&mut window);
    press(&mut window, "Slips in a take");
    until(&mut window, "the button", |window| {
        has(window, "Compare the keys of the recording")
    });
    press(&mut window, "Compare the keys of the recording");
    until(&mut window, "the answer", |window| {
        shows(window, "no tier of phones") || shows(window, "Open a recording")
    });
}
