//! The timeline, driven by labels: creating, moving and coding annotations by mouse and by keys.

mod common;

use chereme_corpus::{Corpus, TierRequestName};
use common::tiers::*;
use common::{Window, click, has, idle, until};
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Role, pos2};
use egui_kittest::kittest::{NodeT, Queryable};

/// Returns the field for the name of a tier.
fn named<'w>(window: &'w Window<'_>) -> egui_kittest::Node<'w> {
    window.get_by_role_and_label(Role::TextInput, "Name of the tier")
}

#[test]
fn a_gloss_is_added_on_a_dragged_selection_and_typed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    let lane = rect(&window, "Lane of Gloss");
    let at = |x: f32| pos2(lane.left() + lane.width() * x, lane.center().y);
    drag(&mut window, at(0.2), at(0.4), NONE);
    let before = operations(&window);
    press(&mut window, NONE, Key::Enter);
    assert!(has(&window, "Value on Gloss"));
    window.get_by_label("Value on Gloss").type_text("maison");
    window.step();
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    assert_eq!(operations(&window), before + 1);
    assert_eq!(values(&window, "Gloss"), ["maison"]);
    until(&mut window, "the gloss", |it| has(it, "Gloss: maison"));
    press(&mut window, CTRL, Key::Z);
    until(&mut window, "the undo", |it| !has(it, "Gloss: maison"));
    idle(&mut window);
    assert!(says(&window, "Gloss").is_empty());
}

/// Presses and releases within one frame, as touchpads do.
fn tap(window: &mut Window<'_>, at: Pos2) {
    let button = |pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: NONE,
    };
    let events = [Event::PointerMoved(at), button(true), button(false)];
    window.input_mut().events.extend(events);
    window.step();
}

#[test]
fn two_taps_on_the_selection_open_a_field_that_stays_open() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    let lane = rect(&window, "Lane of Gloss");
    let at = |x: f32| pos2(lane.left() + lane.width() * x, lane.center().y);
    drag(&mut window, at(0.2), at(0.4), NONE);
    let before = operations(&window);
    for _ in 0..2 {
        tap(&mut window, at(0.3));
    }
    window.run_steps(3);
    window.get_by_label("Value on Gloss").type_text("maison");
    window.step();
    tap(&mut window, at(0.8));
    stored(&mut window, before);
    assert_eq!(values(&window, "Gloss"), ["maison"]);
}

#[test]
fn a_recording_without_tiers_gets_the_usual_ones() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = common::small_corpus(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let recording = corpus.load_corpus_overview(1).expect("read").recordings[0].row.id;
    let contents = corpus.load_recording_contents(recording).expect("read");
    for tier in contents.tiers.iter().filter(|it| it.row.parent_id.is_none()) {
        let tier = TierRequestName::Number(tier.row.id);
        corpus.remove_tier(&tier).expect("removed");
    }
    drop(corpus);
    let mut window = common::window(chereme_studio::StudioOptions {
        corpus: Some(path),
        ..common::options(folder.path())
    });
    until(&mut window, "the offer", |it| has(it, "Add the usual tiers"));
    idle(&mut window);
    click(&mut window, "Add the usual tiers");
    until(&mut window, "the tiers", |it| has(it, "Tier Placement LH"));
    press(&mut window, CTRL, Key::Z);
    until(&mut window, "the offer", |it| has(it, "Add the usual tiers"));
}

#[test]
fn alt_drag_adds_an_annotation_and_escape_discards_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    let lane = rect(&window, "Lane of Gloss");
    let at = |x: f32| pos2(lane.left() + lane.width() * x, lane.center().y);
    let before = operations(&window);
    drag(&mut window, at(0.2), at(0.4), ALT);
    assert!(has(&window, "Value on Gloss"));
    press(&mut window, NONE, Key::Escape);
    assert!(!has(&window, "Value on Gloss"));
    drag(&mut window, at(0.5), at(0.7), ALT);
    window.get_by_label("Value on Gloss").type_text("b");
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    assert_eq!(values(&window, "Gloss"), ["b"]);
}

#[test]
fn a_selected_annotation_is_moved_and_neighbours_are_pushed_in_one_undo() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let old = spans(&window);
    click(&mut window, "Gloss: b");
    let (from, c) = (rect(&window, "Gloss: b").center(), rect(&window, "Gloss: c"));
    let before = operations(&window);
    // Normal mode: it stops at its neighbour.
    drag(&mut window, from, pos2(c.left(), from.y), NONE);
    stored(&mut window, before);
    let new = spans(&window);
    assert_eq!(new["b"].1, new["c"].0);
    assert_eq!(new["c"], old["c"]);
    // Bulldozer mode: the neighbour moves along.
    click(&mut window, "Bulldozer");
    let from = rect(&window, "Gloss: b").center();
    let before = operations(&window);
    drag(&mut window, from, from + eframe::egui::vec2(30.0, 0.0), NONE);
    stored(&mut window, before);
    assert_eq!(operations(&window), before + 1);
    let pushed = spans(&window);
    assert!(pushed["b"].0 > new["b"].0 && pushed["c"].0 > new["c"].0);
    assert_eq!(pushed["b"].1, pushed["c"].0);
    press(&mut window, CTRL, Key::Z);
    stored(&mut window, before + 1);
    assert_eq!(spans(&window), new);
}

#[test]
fn an_edge_is_dragged_and_escape_cancels() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let old = spans(&window);
    click(&mut window, "Gloss: b");
    let b = rect(&window, "Gloss: b");
    let edge = pos2(b.right() - 2.0, b.center().y);
    let here = window.state().playhead_instant();
    pointer(&mut window, edge, Some(true), NONE);
    pointer(&mut window, edge + eframe::egui::vec2(10.0, 0.0), None, NONE);
    press(&mut window, NONE, Key::Escape);
    pointer(&mut window, edge, Some(false), NONE);
    idle(&mut window);
    assert_eq!(spans(&window), old);
    assert_eq!(window.state().playhead_instant(), here, "Escape brings it back");
    let before = operations(&window);
    drag(&mut window, edge, edge + eframe::egui::vec2(12.0, 0.0), NONE);
    stored(&mut window, before);
    let new = spans(&window);
    assert_eq!(new["b"].0, old["b"].0);
    assert!(new["b"].1 > old["b"].1);
    // The stage shows the moment of the edge.
    assert_eq!(window.state().playhead_instant().instant_micros() / 1000, new["b"].1);
}

#[test]
fn several_are_selected_by_click_and_frame_and_changed_together() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    click(&mut window, "Gloss: a");
    click_with(&mut window, "Gloss: c", CTRL);
    assert!(has(&window, "2 selected"));
    click(&mut window, "Gloss: a");
    click_with(&mut window, "Gloss: b", ALT);
    assert!(has(&window, "2 selected"), "Alt and a click add too");
    click_with(&mut window, "Gloss: b", ALT);
    assert!(!has(&window, "2 selected"), "and take out again");
    click(&mut window, "Gloss: a");
    click_with(&mut window, "Gloss: c", Modifiers::SHIFT);
    assert!(has(&window, "3 selected"));
    let (a, b) = (rect(&window, "Gloss: a"), rect(&window, "Gloss: b"));
    let outside = pos2(a.left() - 8.0, a.center().y - 2.0);
    drag(
        &mut window,
        outside,
        pos2(b.right() - 2.0, b.bottom()),
        Modifiers::SHIFT,
    );
    assert!(has(&window, "2 selected"));
    let before = operations(&window);
    press(&mut window, NONE, Key::Enter);
    window.get_by_label("Value on Gloss").type_text("x");
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    assert_eq!(values(&window, "Gloss"), ["x", "x", "c"]);
    assert_eq!(operations(&window), before + 1);
    until(&mut window, "what was done", |it| {
        it.query_by_label_contains("2 glosses changed to x in ").is_some()
    });
    let old = says(&window, "Gloss");
    press(&mut window, CTRL | ALT, Key::U);
    stored(&mut window, before + 1);
    let new = says(&window, "Gloss");
    assert!(new[0].0 > old[0].0 && new[1].0 > old[1].0 && new[2] == old[2]);
}

#[test]
fn the_selected_tier_stays_visible_if_the_window_gets_lower() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    for _ in 0..16 {
        press(&mut window, CTRL, Key::ArrowDown);
    }
    let all = window.query_all_by_label_contains("Tier ");
    let lowest = all.max_by(|a, b| a.rect().top().total_cmp(&b.rect().top()));
    let name = lowest.and_then(|it| it.accesskit_node().label());
    let name = name.expect("a tier");
    window.set_size(eframe::egui::vec2(1280.0, 650.0));
    window.run_steps(8);
    assert!(has(&window, &name), "{name}");
    window.set_size(eframe::egui::vec2(1280.0, 1040.0));
    window.run_steps(8);
    assert!(has(&window, &name), "{name}");
}

#[test]
fn an_annotation_is_added_split_merged_shifted_and_deleted_by_keys_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    press(&mut window, CTRL, Key::B);
    press(&mut window, Modifiers::SHIFT, Key::Enter);
    for _ in 0..10 {
        press(&mut window, CTRL, Key::ArrowRight);
    }
    let before = operations(&window);
    press(&mut window, Modifiers::SHIFT, Key::Enter);
    stored(&mut window, before);
    assert_eq!(says(&window, "Gloss").len(), 1);
    let value = |window: &mut Window<'_>, text: &str| {
        let before = operations(window);
        if !has(window, "Value on Gloss") {
            press(window, NONE, Key::Enter);
        }
        window.get_by_label("Value on Gloss").type_text(text);
        window.step();
        press(window, NONE, Key::Enter);
        stored(window, before);
    };
    value(&mut window, "un");
    for _ in 0..5 {
        press(&mut window, CTRL, Key::ArrowLeft);
    }
    let before = operations(&window);
    press(&mut window, CTRL | ALT, Key::S);
    stored(&mut window, before);
    assert_eq!(values(&window, "Gloss"), ["un", "un"]);
    press(&mut window, ALT, Key::ArrowRight);
    value(&mut window, "deux");
    press(&mut window, ALT, Key::ArrowLeft);
    let before = operations(&window);
    press(&mut window, CTRL | Modifiers::SHIFT, Key::A);
    stored(&mut window, before);
    assert_eq!(values(&window, "Gloss"), ["un deux"]);
    let old = says(&window, "Gloss");
    for modifiers in [CTRL, CTRL | ALT] {
        let before = operations(&window);
        press(&mut window, modifiers, Key::U);
        stored(&mut window, before);
    }
    let new = says(&window, "Gloss");
    assert!(new[0].0 > old[0].0 && new[0].1 > old[0].1);
    let before = operations(&window);
    press(&mut window, NONE, Key::Delete);
    stored(&mut window, before);
    assert!(says(&window, "Gloss").is_empty());
}

#[test]
fn the_selection_is_extended_and_an_annotation_snapped_to_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = emptied(folder.path());
    press(&mut window, CTRL, Key::B);
    for _ in 0..4 {
        press(&mut window, CTRL | Modifiers::SHIFT, Key::ArrowRight);
    }
    let before = operations(&window);
    press(&mut window, CTRL | ALT, Key::N);
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    let short = says(&window, "Gloss")[0].clone();
    for _ in 0..4 {
        press(&mut window, CTRL | Modifiers::SHIFT, Key::ArrowRight);
    }
    let before = operations(&window);
    press(&mut window, CTRL, Key::Enter);
    stored(&mut window, before);
    let long = says(&window, "Gloss")[0].clone();
    assert_eq!(long.0, short.0);
    assert!(long.1 > short.1);
}

#[test]
fn tab_stores_and_continues_and_digits_give_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    click(&mut window, "Gloss: a");
    press(&mut window, NONE, Key::Enter);
    window.get_by_label("Value on Gloss").type_text("ananas");
    let before = operations(&window);
    press(&mut window, NONE, Key::Tab);
    window.get_by_label("Value on Gloss").type_text("b");
    press(&mut window, NONE, Key::Tab);
    window.get_by_label("Value on Gloss").type_text("banane");
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before + 1);
    assert_eq!(values(&window, "Gloss"), ["ananas", "b", "banane"]);
    click(&mut window, "Gloss: b");
    let before = operations(&window);
    press(&mut window, NONE, Key::Num1);
    stored(&mut window, before);
    assert_ne!(values(&window, "Gloss")[1], "b");
}

#[test]
fn a_handshape_is_chosen_from_the_values_of_its_inventory() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    click(&mut window, "Tier Configuration RH");
    press(&mut window, ALT, Key::ArrowRight);
    let before = operations(&window);
    press(&mut window, NONE, Key::Enter);
    window
        .get_by_label("Value on Configuration RH")
        .type_text("no such shape");
    window.step();
    press(&mut window, NONE, Key::Enter);
    assert!(has(&window, "The tier has no such value."));
    press(&mut window, NONE, Key::Escape);
    press(&mut window, NONE, Key::Enter);
    window.get_by_label("Value on Configuration RH").type_text("v");
    window.run_steps(2);
    click(&mut window, "Value V");
    stored(&mut window, before);
    assert_eq!(values(&window, "Configuration RH")[0], "V");
}

#[test]
fn lanes_of_movement_are_measured_in_the_background() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    press(&mut window, CTRL, Key::F5);
    press(&mut window, CTRL, Key::F7);
    until(&mut window, "the speed", |it| {
        it.query_by_label_contains("Wrist speed R").is_some()
    });
    until(&mut window, "the palm", |it| {
        it.query_by_label_contains("Palm R").is_some()
    });
    press(&mut window, CTRL, Key::F5);
    assert!(window.query_by_label_contains("Wrist speed R").is_none());
}

#[test]
fn lanes_are_folded_and_leave_the_tiers_visible() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    for key in [Key::F5, Key::F6, Key::F7, Key::F8] {
        press(&mut window, CTRL, key);
    }
    for size in [[1280.0, 800.0], [1024.0, 640.0]] {
        window.set_size(eframe::egui::vec2(size[0], size[1]));
        window.run_steps(4);
        until(&mut window, "the speed", |it| {
            it.query_by_label_contains("Wrist speed R").is_some()
        });
        let speed = window.get_by_label_contains("Wrist speed R").rect();
        assert!(speed.height() <= 28.0, "{size:?}: {}", speed.height());
        for tier in ["Tier Gloss", "Tier Translation FR"] {
            let tier = rect(&window, tier);
            assert!(tier.bottom() <= size[1] - 20.0, "{size:?}: {tier:?}");
        }
    }
    window.set_size(eframe::egui::vec2(1280.0, 1040.0));
    window.run_steps(4);
    let before = rect(&window, "Tier Gloss").top();
    for lane in ["Wrist speed", "Aperture", "Palm"] {
        click(&mut window, &format!("Fold {lane}"));
    }
    assert!(window.query_by_label_contains("Wrist speed R").is_none());
    assert!(rect(&window, "Tier Gloss").top() < before);
    click(&mut window, "Unfold Wrist speed");
    assert!(window.query_by_label_contains("Wrist speed R").is_some());
}

#[test]
fn tiers_are_folded_and_hidden_and_shown_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    assert!(has(&window, "Tier Translation FR"));
    click(&mut window, "Fold Gloss");
    assert!(!has(&window, "Tier Translation FR"));
    click(&mut window, "Unfold Gloss");
    click(&mut window, "Tier Translation FR");
    press(&mut window, CTRL | ALT, Key::H);
    assert!(!has(&window, "Tier Translation FR"));
    assert!(has(&window, "Tiers, 1 hidden"));
    press(&mut window, CTRL | Modifiers::SHIFT, Key::H);
    assert!(has(&window, "Tier Translation FR"));
}

#[test]
fn a_tier_is_added_renamed_moved_and_removed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    let before = operations(&window);
    press(&mut window, CTRL, Key::T);
    named(&window).type_text("Mouth");
    window.step();
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    until(&mut window, "the tier", |it| has(it, "Tier Mouth"));
    press(&mut window, CTRL | Modifiers::SHIFT, Key::T);
    named(&window).type_text("ing");
    window.step();
    press(&mut window, NONE, Key::Enter);
    until(&mut window, "the name", |it| has(it, "Tier Mouthing"));
    idle(&mut window);
    let y = |window: &Window<'_>, label: &str| rect(window, label).top();
    let (mouth, phase) = (y(&window, "Tier Mouthing"), y(&window, "Tier Phase LH"));
    assert!(mouth > phase);
    press(&mut window, CTRL | Modifiers::SHIFT, Key::ArrowUp);
    stored(&mut window, before + 2);
    until(&mut window, "the place", |it| {
        y(it, "Tier Mouthing") < y(it, "Tier Phase LH")
    });
    press(&mut window, CTRL | ALT, Key::T);
    click(&mut window, "Remove");
    until(&mut window, "no tier", |it| !has(it, "Tier Mouthing"));
    idle(&mut window);
    press(&mut window, CTRL, Key::Z);
    until(&mut window, "the tier again", |it| has(it, "Tier Mouthing"));
}

#[test]
fn an_annotation_is_copied_to_another_tier_by_keys() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let before = operations(&window);
    click(&mut window, "Gloss: b");
    press(&mut window, CTRL, Key::T);
    named(&window).type_text("Other");
    window.step();
    click(&mut window, "Add");
    stored(&mut window, before);
    press(&mut window, CTRL | Modifiers::SHIFT, Key::D);
    window.get_by_label("Name of a tier").type_text("oth");
    window.step();
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before + 1);
    assert_eq!(values(&window, "Other"), ["b"]);
    assert_eq!(values(&window, "Gloss"), ["a", "b", "c"]);
}

/// Returns a window with the pictures for the choice of a handshape, and the number of operations before.
fn among_pictures<'a>(folder: &std::path::Path) -> (Window<'a>, usize) {
    let mut window = opened(folder);
    click(&mut window, "Tier Configuration RH");
    press(&mut window, ALT, Key::ArrowRight);
    let before = operations(&window);
    press(&mut window, NONE, Key::F3);
    window.run_steps(3);
    (window, before)
}

#[test]
fn a_handshape_is_chosen_by_its_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, before) = among_pictures(folder.path());
    assert!(has(&window, "U, index and middle finger together"));
    window.event(Event::Text("u".to_owned()));
    window.run_steps(3);
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    assert_eq!(values(&window, "Configuration RH")[0], "U");
}

#[test]
fn a_digit_means_the_same_value_in_the_list_and_among_the_pictures() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut window, before) = among_pictures(folder.path());
    press(&mut window, CTRL, Key::Num2);
    stored(&mut window, before);
    let pictured = values(&window, "Configuration RH")[0].clone();
    // The first digit picks the value in use, as it does in the list.
    assert_eq!(pictured, "A");
}

#[test]
fn the_name_column_grows_for_a_name_scrolled_into_view_and_keeps_its_width() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    window.set_size(eframe::egui::vec2(1280.0, 660.0));
    click(&mut window, "Tier Gloss");
    let lane = |window: &Window<'_>| rect(window, "Lane of Gloss").left();
    let narrow = lane(&window);
    press(&mut window, CTRL, Key::T);
    let long = "Zzz of which nobody knows why it is";
    named(&window).type_text(long);
    window.step();
    let before = operations(&window);
    click(&mut window, "Add");
    stored(&mut window, before);
    window.run_steps(40);
    assert!(has(&window, &format!("Tier {long}")));
    for _ in 0..40 {
        press(&mut window, CTRL, Key::ArrowUp);
    }
    window.run_steps(40);
    let wide = lane(&window);
    assert!(wide > narrow + 40.0, "{narrow} {wide}");
}

#[test]
fn a_restored_annotation_is_selected_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    click(&mut window, "Gloss: b");
    let before = operations(&window);
    press(&mut window, CTRL | ALT, Key::D);
    stored(&mut window, before);
    press(&mut window, CTRL, Key::Z);
    stored(&mut window, before + 1);
    press(&mut window, NONE, Key::Enter);
    let field = window.get_by_label("Value on Gloss");
    assert_eq!(field.value().as_deref(), Some("b"));
}
