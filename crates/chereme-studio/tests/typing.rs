//! Where keys act: in the pane that has the focus, and nowhere else by mistake.

mod common;

use common::tiers::*;
use common::{Window, click, contains, has, idle};
use eframe::egui::{Event, Key, Modifiers, Role};
use egui_kittest::kittest::{NodeT, Queryable};

/// Types a text letter by letter, as a keyboard does.
fn type_text(window: &mut Window<'_>, text: &str) {
    for letter in text.chars() {
        if let Some(key) = Key::from_name(&letter.to_string()) {
            window.key_press(key);
        }
        window.event(Event::Text(letter.to_string()));
        window.step();
    }
    idle(window);
    window.run_steps(3);
}

/// Selects the first handshape.
fn select_handshape(window: &mut Window<'_>) {
    click(window, "Tier Configuration RH");
    press(window, ALT, Key::Home);
}

/// Returns the focused widget's label.
fn focused(window: &Window<'_>) -> Option<String> {
    let mut fields = window.query_all_by_role(Role::TextInput);
    let mut blocks = window.query_all_by_role(Role::MultilineTextInput);
    let field = fields.find(|it| it.accesskit_node().is_focused());
    let field = field.or_else(|| blocks.find(|it| it.accesskit_node().is_focused()));
    field.map(|it| it.value().unwrap_or_default())
}

#[test]
fn keys_that_code_do_nothing_outside_the_timeline_and_say_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    select_handshape(&mut window);
    let (before, all) = (operations(&window), values(&window, "Configuration RH"));
    for (modifiers, key) in [
        (Modifiers::SHIFT, Key::F1),
        (Modifiers::SHIFT, Key::F2),
        (Modifiers::SHIFT, Key::F4),
        (CTRL, Key::H),
        (CTRL | Modifiers::SHIFT, Key::I),
        (CTRL, Key::R),
        (CTRL, Key::F2),
        (CTRL, Key::F3),
    ] {
        press(&mut window, modifiers, key);
        press(&mut window, NONE, Key::Escape);
        type_text(&mut window, "34");
        if key != Key::F1 {
            // In the library it deletes the recording.
            press(&mut window, NONE, Key::Delete);
        }
        let said = "Shift+F3 gives the timeline the focus";
        assert!(contains(&window, said), "{key:?}");
        for (modifiers, key) in [
            (NONE, Key::Enter),
            (Modifiers::SHIFT, Key::Enter),
            (Modifiers::SHIFT, Key::Enter),
        ] {
            press(&mut window, modifiers, key);
            assert!(!contains(&window, "Value on"), "{key:?}");
        }
        // The stage and the inspector show the selected annotation, so that deliberate keys edit it there.
        if key != Key::F2 && key != Key::F4 || modifiers == CTRL {
            press(&mut window, CTRL, Key::Delete);
            window.event(Event::Cut);
            window.event(Event::Paste("Configuration RH\t1\t2\tB".into()));
        }
        idle(&mut window);
        assert_eq!(operations(&window), before, "{key:?}");
    }
    assert_eq!(values(&window, "Configuration RH"), all);
    // In the timeline they act again.
    press(&mut window, CTRL, Key::F1);
    press(&mut window, Modifiers::SHIFT, Key::F3);
    press(&mut window, NONE, Key::Num2);
    stored(&mut window, before);
    assert_ne!(values(&window, "Configuration RH"), all);
}

#[test]
fn a_button_leaves_the_cursor_in_the_field_of_its_pane() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    select_handshape(&mut window);
    let before = operations(&window);
    press(&mut window, CTRL, Key::F3);
    press(&mut window, CTRL, Key::R);
    type_text(&mut window, "ESCARGOT");
    assert_eq!(focused(&window).as_deref(), Some("ESCARGOT"));
    click(&mut window, "Clear");
    window.run_steps(2);
    type_text(&mut window, "3 TON");
    assert_eq!(focused(&window).as_deref(), Some("3 TON"));
    assert_eq!(operations(&window), before);
}

#[test]
fn the_end_of_an_annotation_opens_its_field_in_sight() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    press(&mut window, CTRL, Key::B);
    let before = operations(&window);
    let shift = Modifiers::SHIFT;
    window.key_press_modifiers(shift, Key::Enter);
    for _ in 0..10 {
        window.key_press_modifiers(CTRL, Key::ArrowRight);
    }
    window.key_press_modifiers(shift, Key::Enter);
    window.step();
    type_text(&mut window, "TEST1");
    assert!(has(&window, "Value on Gloss"));
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before + 1);
    assert_eq!(values(&window, "Gloss"), ["TEST1"]);
    // A letter begins to type over a gloss; a digit alone is a value of the tier.
    type_text(&mut window, "HUIS-2");
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before + 2);
    assert_eq!(values(&window, "Gloss"), ["HUIS-2"]);
}

#[test]
fn an_annotation_is_begun_only_from_the_timeline() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    press(&mut window, CTRL, Key::B);
    let before = operations(&window);
    let begin_and_end = |window: &mut Window<'_>| {
        for _ in 0..2 {
            press(window, Modifiers::SHIFT, Key::Enter);
            press(window, CTRL, Key::ArrowRight);
            press(window, CTRL, Key::ArrowRight);
        }
        idle(window);
        window.run_steps(3);
    };
    press(&mut window, Modifiers::SHIFT, Key::F2);
    begin_and_end(&mut window);
    assert_eq!(operations(&window), before);
    press(&mut window, Modifiers::SHIFT, Key::F3);
    begin_and_end(&mut window);
    assert!(has(&window, "Value on Gloss"));
}
