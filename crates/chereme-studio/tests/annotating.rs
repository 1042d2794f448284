//! Copying and pasting annotations, creating them beside others, and going to them, by keys and by the mouse.

mod common;

use common::tiers::*;
use common::{Window, click, has, idle};
use eframe::egui::{Event, Key, Modifiers, Role};
use egui_kittest::kittest::Queryable;

/// Waits until the paste, or any other request, is done.
fn settled(window: &mut Window<'_>) {
    window.run_steps(8);
    idle(window);
    window.run_steps(2);
}

#[test]
fn annotations_are_copied_cut_and_pasted_through_the_clipboard() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let old = spans(&window);
    click(&mut window, "Gloss: a");
    click_with(&mut window, "Gloss: b", CTRL);
    window.event(Event::Copy);
    window.run_steps(2);
    assert!(has(&window, "Annotations copied: 2"));
    // There are annotations at their own times already.
    press(&mut window, CTRL, Key::V);
    settled(&mut window);
    let said = "There is an annotation already at that time. Paste at the playhead instead.";
    assert!(has(&window, said));
    assert_eq!(spans(&window), old);
    // At the playhead they keep their distances, on the selected tier.
    let before = operations(&window);
    press(&mut window, CTRL, Key::T);
    window
        .get_by_role_and_label(Role::TextInput, "Name of the tier")
        .type_text("Other");
    window.step();
    click(&mut window, "Add");
    stored(&mut window, before);
    press(&mut window, CTRL, Key::B);
    let before = operations(&window);
    press(&mut window, CTRL | Modifiers::SHIFT, Key::V);
    stored(&mut window, before);
    let pasted = says(&window, "Other");
    assert_eq!(pasted.len(), 2);
    assert_eq!(pasted[0].0, 0);
    let apart = old["b"].0 - old["a"].0;
    assert!((pasted[1].0 - apart).abs() <= 1, "{pasted:?}");
    press(&mut window, CTRL, Key::Z);
    stored(&mut window, before + 1);
    assert!(says(&window, "Other").is_empty());
    for _ in 0..20 {
        press(&mut window, CTRL, Key::ArrowUp);
    }
    click(&mut window, "Gloss: c");
    window.event(Event::Cut);
    stored(&mut window, before + 2);
    assert_eq!(values(&window, "Gloss"), ["a", "b"]);
    press(&mut window, CTRL, Key::V);
    stored(&mut window, before + 3);
    assert_eq!(spans(&window), old);
}

#[test]
fn cells_of_a_spreadsheet_are_pasted_and_odd_lines_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    let cells = "Tier\tBegin\tEnd\tValue\nGloss\t0,1\t0,2\tUN\nGloss\tsoon\t0.4\tDEUX\n\
                 Nowhere\t0.1\t0.2\tX\nConfiguration RH\t0.12\t0.18\tzzz\nConfiguration RH\t0.12\t0.18\tflat\n";
    window.event(Event::Paste(cells.into()));
    window.run_steps(3);
    assert!(has(&window, "Line 4: no tier Nowhere here"));
    assert!(has(&window, "Line 5: “zzz” is no value of its tier"));
    assert!(window.query_by_label_contains("Line 3: “soon” is no time").is_some());
    let before = operations(&window);
    click(&mut window, "Paste the others: 2");
    stored(&mut window, before);
    assert_eq!(says(&window, "Gloss"), [(100, 200, "UN".to_owned())]);
    assert_eq!(says(&window, "Configuration RH"), [(120, 180, "flat".to_owned())]);
    // A column of values alone is assigned to the selected annotations, beginning with the first.
    click(&mut window, "Gloss: UN");
    window.event(Event::Paste("MAISON\n".into()));
    stored(&mut window, before + 1);
    assert_eq!(values(&window, "Gloss"), ["MAISON"]);
    // While text is typed, the clipboard belongs to the text field.
    press(&mut window, NONE, Key::Enter);
    window.event(Event::Paste("1\t2\tX".into()));
    window.run_steps(3);
    press(&mut window, NONE, Key::Escape);
    idle(&mut window);
    assert_eq!(values(&window, "Gloss"), ["MAISON"]);
}

#[test]
fn annotations_are_added_duplicated_extended_and_merged_with_a_neighbour() {
    const SHIFT: Modifiers = Modifiers::SHIFT;
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let old = spans(&window);
    click(&mut window, "Gloss: b");
    let mut before = operations(&window);
    let mut after = |window: &mut Window<'_>, modifiers, key| {
        press(window, modifiers, key);
        stored(window, before);
        before += 1;
    };
    after(&mut window, CTRL, Key::D);
    let all = says(&window, "Gloss");
    assert_eq!(all.len(), 4);
    assert_eq!((all[2].0, all[2].2.as_str()), (old["b"].1, "b"));
    after(&mut window, CTRL | SHIFT, Key::B);
    assert_eq!(values(&window, "Gloss"), ["a", "b", "c"]);
    assert_eq!(spans(&window)["b"].1, all[2].1);
    after(&mut window, SHIFT | ALT, Key::U);
    after(&mut window, SHIFT | ALT, Key::J);
    let wide = spans(&window);
    assert_eq!(wide["b"], (old["a"].1, old["c"].0));
    press(&mut window, CTRL | SHIFT, Key::N);
    assert!(!has(&window, "Value on Gloss"));
    click(&mut window, "Gloss: c");
    press(&mut window, SHIFT | ALT, Key::N);
    window.get_by_label("Value on Gloss").type_text("d");
    window.step();
    after(&mut window, NONE, Key::Enter);
    assert_eq!(values(&window, "Gloss"), ["a", "b", "c", "d"]);
    assert_eq!(spans(&window)["d"].0, old["c"].1);
    press(&mut window, ALT, Key::Home);
    after(&mut window, CTRL | SHIFT | ALT, Key::D);
    for tier in ["Translation FR", "Configuration RH"] {
        let made = says(&window, tier);
        assert_eq!((made[0].0, made[0].1), old["a"], "{tier}");
    }
    // The annotation is copied and pasted with all its descendants.
    press(&mut window, CTRL | ALT, Key::C);
    press(&mut window, ALT, Key::End);
    after(&mut window, NONE, Key::Delete);
    after(&mut window, CTRL | SHIFT, Key::V);
    assert_eq!(values(&window, "Gloss"), ["a", "b", "c", "a"]);
    assert_eq!(says(&window, "Translation FR").len(), 2);
}

#[test]
fn the_playhead_goes_to_a_typed_time_and_through_the_tier() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let old = spans(&window);
    let go = |window: &mut Window<'_>, text: &str| {
        press(window, CTRL, Key::G);
        window
            .get_by_role_and_label(Role::TextInput, "Time, or f and a frame")
            .type_text(text);
        window.step();
        press(window, NONE, Key::Enter);
        window.state().playhead_instant().instant_micros()
    };
    assert_eq!(go(&mut window, "0:00.5"), 500_000);
    assert_eq!(go(&mut window, "+0,25"), 750_000);
    assert_eq!(go(&mut window, "f1"), 0);
    assert_eq!(go(&mut window, "9:00"), 0);
    assert!(window.query_by_label_contains("The recording ends at").is_some());
    press(&mut window, NONE, Key::Escape);
    let at = |window: &Window<'_>| (window.state().playhead_instant().instant_micros() + 500) / 1000;
    click(&mut window, "Tier Gloss");
    press(&mut window, ALT, Key::End);
    assert_eq!(at(&window), old["c"].0);
    press(&mut window, ALT, Key::ArrowRight);
    assert_eq!(at(&window), old["c"].0);
    press(&mut window, CTRL, Key::L);
    press(&mut window, ALT, Key::ArrowRight);
    assert_eq!(at(&window), old["a"].0);
    press(&mut window, CTRL | ALT, Key::G);
    assert!(window.query_by_label_contains("Copied: 0:0").is_some());
}

#[test]
fn the_secondary_button_offers_the_possible_actions() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let before = operations(&window);
    window.get_by_label("Gloss: b").click_secondary();
    window.run_steps(3);
    let all: Vec<_> = window.query_all_by_label_contains("Duplicate the annotation").collect();
    all.last().expect("an entry").click();
    window.run_steps(2);
    stored(&mut window, before);
    assert_eq!(values(&window, "Gloss"), ["a", "b", "b", "c"]);
}

#[test]
fn short_pieces_are_repeated_until_stopped() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let old = spans(&window);
    click(&mut window, "Gloss: b");
    press(&mut window, CTRL | ALT, Key::Space);
    let (mut least, mut most, mut returns, mut before) = (i64::MAX, 0, 0, 0);
    for _ in 0..60 {
        window.step();
        let at = window.state().playhead_instant().instant_micros() / 1000;
        returns += usize::from(at < before);
        (least, most, before) = (least.min(at), most.max(at), at);
    }
    assert!(returns > 0 && least >= old["b"].0 - 20 && most <= old["b"].1 + 20);
    press(&mut window, CTRL | ALT, Key::Space);
    let at = window.state().playhead_instant();
    window.run_steps(5);
    assert_eq!(window.state().playhead_instant(), at);
}

#[test]
fn a_key_is_found_in_the_help_by_its_action() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    press(&mut window, NONE, Key::F1);
    let field = window.get_by_role_and_label(Role::TextInput, "Find an action or a key");
    field.type_text("duplicate annotation");
    window.run_steps(3);
    assert!(has(&window, "Change the key of: Duplicate the annotation"));
    assert!(!has(&window, "Change the key of: Undo"));
}
