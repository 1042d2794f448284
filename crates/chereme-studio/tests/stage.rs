//! The stage, driven by labels: views, panes, trails, ghosts, places, and the originals of generated signs.

mod common;

use chereme_corpus::Corpus;
use common::{Window, click, has, idle, open_small, until};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

fn pictures(window: &Window<'_>) -> Vec<String> {
    let nodes = window.query_all_by_label_contains("The signer: ");
    nodes.filter_map(|node| node.accesskit_node().label()).collect()
}

fn is_on(window: &Window<'_>, label: &str) -> bool {
    is_chosen(&window.get_by_label(label))
}

fn is_chosen<'a>(node: &impl NodeT<'a>) -> bool {
    let node = node.accesskit_node();
    node.is_selected() == Some(true) || format!("{:?}", node.toggled()).contains("True")
}

#[test]
fn the_signer_is_shown_from_seven_directions_and_in_up_to_four_views() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    assert_eq!(pictures(&window), ["The signer: From the front"]);
    window.key_press_modifiers(Modifiers::ALT, Key::Num6);
    window.run_steps(2);
    assert_eq!(pictures(&window), ["The signer: Right hand close up"]);
    click(&mut window, "Two views");
    let two = ["The signer: Right hand close up", "The signer: From the front"];
    assert_eq!(pictures(&window), two);
    window.key_press_modifiers(Modifiers::ALT, Key::Num9);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::ALT, Key::Num5);
    window.run_steps(2);
    assert_eq!(pictures(&window)[1], "The signer: From above");
    window.key_press_modifiers(Modifiers::ALT, Key::Num8);
    window.run_steps(2);
    assert_eq!(pictures(&window).len(), 4);
    click(&mut window, "One view");
    assert_eq!(pictures(&window).len(), 1);
}

#[test]
fn hands_are_in_the_corners_and_palms_and_the_face_on_request() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let hands = ["Right hand close up", "Left hand close up"];
    until(&mut window, "both hands", |window| {
        hands.iter().all(|hand| has(window, hand))
    });
    assert!(is_on(&window, "Hands") && !is_on(&window, "Palms"));
    assert!(!has(&window, "Face close up"));
    click(&mut window, "Face");
    until(&mut window, "the face", |window| has(window, "Face close up"));
    click(&mut window, hands[0]);
    window.run_steps(2);
    assert!(is_on(&window, "Palms"), "a click turns the palms to the eye");
    window.key_press_modifiers(Modifiers::ALT, Key::H);
    window.run_steps(3);
    assert!(!is_on(&window, "Hands") && !has(&window, hands[0]));
    // A close view needs no close-up.
    window.key_press_modifiers(Modifiers::ALT, Key::V);
    window.run_steps(3);
    assert!(!has(&window, "Face close up"));
}

#[test]
fn trails_ghosts_grid_and_places_are_shown_and_hidden() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    for (label, key) in [
        ("Trails", Key::T),
        ("Ghosts", Key::G),
        ("Grid", Key::R),
        ("Places", Key::P),
    ] {
        assert!(!is_on(&window, label), "{label}");
        click(&mut window, label);
        assert!(is_on(&window, label), "{label}");
        window.key_press_modifiers(Modifiers::ALT, key);
        window.run_steps(2);
        assert!(!is_on(&window, label), "{label}");
    }
    assert!(!has(&window, "chin"));
    click(&mut window, "Trails");
    assert!(has(&window, "Length of the trails in seconds"));
    click(&mut window, "Places");
    until(&mut window, "the places", |window| has(window, "chin"));
    // Zones lie close together from the front: the pointer would be over its neighbour as well.
    window.get_by_label("chin").click_accesskit();
    window.run_steps(3);
    // The inspector shows it too.
    let all = window.query_all_by_label("chin");
    assert_eq!(all.filter(is_chosen).count(), 1);
}

#[test]
fn the_bar_moves_the_playhead_by_mouse_and_by_keys() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    click(&mut window, "Time");
    let at = window.state().playhead_instant().instant_micros();
    assert!((1_500_000..2_200_000).contains(&at), "{at}");
    window.get_by_label("Time").focus();
    window.run_steps(2);
    window.key_press(Key::ArrowRight);
    window.run_steps(3);
    let later = window.state().playhead_instant().instant_micros();
    assert!((later - at).abs() < 40_000 && later != at, "{at}, {later}");
    click(&mut window, "To the start");
    assert_eq!(window.state().playhead_instant().instant_micros(), 0);
    assert!(!is_on(&window, "Loop"));
    click(&mut window, "Loop");
    assert!(is_on(&window, "Loop"));
}

#[test]
fn the_view_of_the_stage_is_restored_when_the_window_opens_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    click(&mut window, "Two views");
    click(&mut window, "Grid");
    window.run_steps(3);
    drop(window);
    let options = chereme_studio::StudioOptions {
        corpus: Some(path),
        ..common::options(folder.path())
    };
    let mut window = common::window(options);
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    assert_eq!(pictures(&window).len(), 2);
    assert!(is_on(&window, "Grid") && !is_on(&window, "Trails"));
}

#[test]
fn the_original_of_each_piece_is_shown_or_reported_missing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut other = Corpus::open_corpus(&path, "B").expect("opened");
    other.recombine_recipe("ESCARGOT then spell LSF", "BOTH").expect("made");
    other.recombine_recipe("spell LSF", "LETTERS").expect("made");
    until(&mut window, "the new recordings", |window| has(window, "LETTERS"));
    click(&mut window, "BOTH");
    until(&mut window, "the original", |window| has(window, "Beside"));
    idle(&mut window);
    assert_eq!(pictures(&window).len(), 2);
    click(&mut window, "LETTERS");
    idle(&mut window);
    window.run_steps(3);
    assert!(!has(&window, "Beside"));
    assert_eq!(pictures(&window).len(), 1);
}

#[test]
fn a_generated_sign_is_shown_next_to_its_source() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut other = Corpus::open_corpus(&path, "B").expect("opened");
    other
        .recombine_recipe("ESCARGOT | configure right U", "LIMACE")
        .expect("made");
    until(&mut window, "the new recording", |window| has(window, "LIMACE"));
    click(&mut window, "LIMACE");
    until(&mut window, "the original", |window| has(window, "Beside"));
    idle(&mut window);
    window.step();
    assert_eq!(pictures(&window).len(), 2);
    click(&mut window, "Over");
    assert_eq!(pictures(&window).len(), 1);
    window.key_press_modifiers(Modifiers::ALT, Key::O);
    window.run_steps(2);
    assert!(is_on(&window, "Alone"));
}
