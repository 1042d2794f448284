//! Tiers reordered, copied, hidden and shown; and the view of a corpus, which is restored.

mod common;

use chereme_studio::{InterfaceLanguage, StudioOptions};
use common::tiers::*;
use common::{Window, click, has, idle, until};
use eframe::egui::{Key, Modifiers, Role, pos2, vec2};
use egui_kittest::kittest::{NodeT, Queryable};

const SHIFT: Modifiers = Modifiers::SHIFT;

/// Returns the names of the tiers in their stored order.
fn order(window: &Window<'_>) -> Vec<String> {
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = chereme_corpus::Corpus::open_corpus(&path, "reader").expect("opened");
    let contents = corpus.load_recording_contents(1).expect("read");
    contents.tiers.into_iter().map(|it| it.row.name).collect()
}

#[test]
fn tiers_are_dragged_by_their_names_and_sorted() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    let old = order(&window);
    let before = operations(&window);
    let from = rect(&window, "Tier Movement RH").center();
    let to = rect(&window, "Tier Translation FR").center();
    drag(&mut window, from, to - vec2(0.0, 6.0), NONE);
    stored(&mut window, before);
    let new = order(&window);
    let at = |all: &[String], name: &str| all.iter().position(|it| it == name);
    assert!(at(&new, "Movement RH") < at(&new, "Translation FR"));
    let top = |window: &Window<'_>, label: &str| rect(window, label).top();
    until(&mut window, "the place", |it| {
        top(it, "Tier Movement RH") < top(it, "Tier Translation FR")
    });
    press(&mut window, SHIFT | ALT, Key::K);
    stored(&mut window, before + 1);
    let kinds = order(&window);
    assert!(at(&kinds, "Translation FR") < at(&kinds, "Movement RH"));
    press(&mut window, SHIFT | ALT, Key::O);
    stored(&mut window, before + 2);
    let names = order(&window);
    assert!(names.is_sorted_by_key(|it| it.to_lowercase()));
    for done in 0..3 {
        press(&mut window, CTRL, Key::Z);
        stored(&mut window, before + 3 + done);
    }
    assert_eq!(order(&window), old);
}

#[test]
fn a_tier_is_copied_with_the_chosen_contents() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    let before = operations(&window);
    click(&mut window, "Tier Gloss");
    press(&mut window, CTRL | SHIFT | ALT, Key::T);
    assert!(has(&window, "Copy the tier"));
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    until(&mut window, "the copy", |it| has(it, "Gloss copy: a"));
    assert_eq!(values(&window, "Gloss copy"), ["a", "b", "c"]);
    for _ in 0..20 {
        press(&mut window, CTRL, Key::ArrowUp);
    }
    press(&mut window, CTRL | SHIFT | ALT, Key::T);
    window
        .get_by_role_and_label(Role::TextInput, "Name of the tier")
        .type_text(" 2");
    window.get_by_role_and_label(Role::ComboBox, "With").click();
    window.run_steps(3);
    click(&mut window, "annotations that contain:");
    let field = window.get_by_role_and_label(Role::TextInput, "Text they contain");
    field.focus();
    window.run_steps(2);
    let field = window.get_by_role_and_label(Role::TextInput, "Text they contain");
    field.type_text("B");
    window.step();
    click(&mut window, "Copy");
    stored(&mut window, before + 1);
    assert_eq!(values(&window, "Gloss copy 2"), ["b"]);
    press(&mut window, CTRL, Key::Z);
    until(&mut window, "the undo", |it| !has(it, "Tier Gloss copy 2"));
}

/// Returns how many recordings there are, and how many have a tier of this name.
fn recordings_with_tier(window: &Window<'_>, name: &str) -> (usize, usize) {
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = chereme_corpus::Corpus::open_corpus(&path, "reader").expect("opened");
    let overview = corpus.load_corpus_overview(0).expect("read");
    let has_tier = |id: i64| {
        let contents = corpus.load_recording_contents(id).expect("read");
        contents.tiers.iter().any(|tier| tier.row.name == name)
    };
    let ids: Vec<i64> = overview.recordings.iter().map(|glance| glance.row.id).collect();
    (ids.len(), ids.iter().filter(|id| has_tier(**id)).count())
}

#[test]
fn tiers_of_many_recordings_are_tried_first_and_added_in_one_step() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = common::open_starter(folder.path());
    let before = operations(&window);
    press(&mut window, CTRL | SHIFT | ALT, Key::U);
    window.get_by_role_and_label(Role::ComboBox, "Work").click();
    window.run_steps(3);
    click(&mut window, "add a tier");
    let may_press = |window: &Window<'_>, label: &str| !window.get_by_label(label).accesskit_node().is_disabled();
    assert!(!may_press(&window, "Show what would change"), "a name is missing");
    let name = window.get_by_role_and_label(Role::TextInput, "Name of the tier");
    name.focus();
    window.run_steps(2);
    let name = window.get_by_role_and_label(Role::TextInput, "Name of the tier");
    name.type_text("Notes");
    window.run_steps(2);
    assert!(!may_press(&window, "Carry out"), "it was not tried");
    click(&mut window, "Show what would change");
    idle(&mut window);
    window.run_steps(2);
    let (all, _) = recordings_with_tier(&window, "Notes");
    let would = format!("Would change: {all} · refuse: 0 · stay as they are: 0");
    until(&mut window, "the list", |it| has(it, &would));
    assert_eq!(
        (operations(&window), recordings_with_tier(&window, "Notes")),
        (before, (all, 0))
    );
    click(&mut window, "Carry out");
    stored(&mut window, before);
    assert_eq!(
        (operations(&window), recordings_with_tier(&window, "Notes")),
        (before + 1, (all, all))
    );
    click(&mut window, "Show what would change");
    idle(&mut window);
    window.run_steps(2);
    assert!(common::contains(&window, &format!("refuse: {all}")) && !may_press(&window, "Carry out"));
    press(&mut window, NONE, Key::Escape);
    assert!(!has(&window, "Carry out"));
    press(&mut window, CTRL, Key::Z);
    stored(&mut window, before + 1);
    assert_eq!(recordings_with_tier(&window, "Notes"), (all, 0));
}

#[test]
fn hidden_tiers_and_zoom_are_remembered_for_each_corpus() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    window.get_by_role_and_label(Role::Button, "Tiers").click();
    window.run_steps(3);
    window.get_by_role_and_label(Role::CheckBox, "Translation FR").click();
    window.run_steps(2);
    assert!(!has(&window, "Tier Translation FR"));
    press(&mut window, NONE, Key::Escape);
    press(&mut window, CTRL | ALT, Key::E);
    let hidden = |window: &Window<'_>| {
        let found = window.query_by_label_contains("hidden");
        found.is_some_and(|it| it.rect().width() > 0.0)
    };
    assert!(hidden(&window));
    click(&mut window, "Gloss: ESCARGOT");
    for _ in 0..3 {
        press(&mut window, CTRL, Key::Plus);
    }
    let wide = rect(&window, "Gloss: ESCARGOT").width();
    drop(window);
    let again = |path: &std::path::Path| {
        let mut window = common::window(StudioOptions {
            corpus: Some(path.to_owned()),
            ..common::options(folder.path())
        });
        until(&mut window, "the tiers", |it| has(it, "Tier Gloss"));
        idle(&mut window);
        window
    };
    let window = again(&path);
    assert!(!has(&window, "Tier Translation FR"));
    assert!((rect(&window, "Gloss: ESCARGOT").width() - wide).abs() < 2.0);
    drop(window);
    let other = folder.path().join("other.chereme");
    std::fs::copy(&path, &other).expect("copied");
    let window = again(&other);
    assert!(has(&window, "Tier Translation FR"));
}

#[test]
fn the_box_of_the_overview_is_dragged_and_shows_another_part() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    let strip = |window: &Window<'_>| {
        let found = window.query_by_label_contains("Overview: ");
        found.map(|it| (it.rect(), it.accesskit_node().label().unwrap_or_default()))
    };
    assert_eq!(strip(&window), None);
    for _ in 0..4 {
        press(&mut window, CTRL, Key::Plus);
    }
    let (area, says) = strip(&window).expect("a strip");
    assert!(says.starts_with("Overview: 0:00.000 to 0:00."), "{says}");
    let from = pos2(area.left() + 20.0, area.center().y);
    drag(&mut window, from, from + vec2(200.0, 0.0), NONE);
    let moved = strip(&window).expect("a strip").1;
    assert_ne!(moved, says);
    // A click centres the strip's box there; the end of the recording stays the end.
    let end = pos2(area.right() - 2.0, area.center().y);
    pointer(&mut window, end, Some(true), NONE);
    pointer(&mut window, end, Some(false), NONE);
    window.run_steps(2);
    let last = strip(&window).expect("a strip").1;
    assert_ne!(last, moved);
    press(&mut window, CTRL, Key::F9);
    assert_eq!(strip(&window), None);
}

#[test]
fn stored_face_curves_have_lanes() {
    const SIGML: &str = "<sigml><hamgestural_sign gloss=\"VRAAG\"><sign_nonmanual>\
        <facialexpr_tier><eye_brows movement=\"RB\"/></facialexpr_tier></sign_nonmanual>\
        <sign_manual><handconfig handshape=\"flat\" extfidir=\"uo\" palmor=\"l\"/>\
        <directedmotion direction=\"o\"/></sign_manual></hamgestural_sign></sigml>";
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("vraag.sigml");
    std::fs::write(&file, SIGML).expect("written");
    let path = folder.path().join("made.chereme");
    let mut corpus = chereme_corpus::Corpus::create_corpus(&path, "A").expect("made");
    let recipe = format!("sigml {:?}", file.display().to_string());
    corpus.recombine_recipe(&recipe, "VRAAG").expect("stored");
    drop(corpus);
    let mut window = common::window(StudioOptions {
        corpus: Some(path),
        ..common::options(folder.path())
    });
    until(&mut window, "the tiers", |it| has(it, "Tier Gloss"));
    idle(&mut window);
    press(&mut window, CTRL, Key::F10);
    until(&mut window, "the brows", |it| {
        it.query_by_label_contains("both brows raised ").is_some()
    });
    let lane = window.get_by_label_contains("both brows raised ").rect();
    let middle = pos2(lane.left() + lane.width() * 0.5, lane.center().y);
    pointer(&mut window, middle, Some(true), NONE);
    pointer(&mut window, middle, Some(false), NONE);
    window.run_steps(2);
    assert!(window.state().playhead_instant().instant_micros() > 0);
    let says = window.get_by_label_contains("both brows raised ");
    let says = says.accesskit_node().label().unwrap_or_default();
    assert!(!says.ends_with(" 0 %"), "{says}");
    press(&mut window, CTRL, Key::F10);
    assert!(window.query_by_label_contains("both brows raised ").is_none());
}

#[test]
fn a_component_tier_is_added_by_keys_with_a_proposed_parent() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path());
    click(&mut window, "Tier Gloss");
    press(&mut window, CTRL, Key::T);
    press(&mut window, NONE, Key::Tab);
    window.event(eframe::egui::Event::Text("p".to_owned()));
    window.run_steps(3);
    // Enter opens the list with the focus, and closes nothing.
    press(&mut window, NONE, Key::Enter);
    press(&mut window, NONE, Key::Escape);
    let name = window.get_by_role_and_label(Role::TextInput, "Name of the tier");
    assert_eq!(name.value().as_deref(), Some("placement"));
    let before = operations(&window);
    name.focus();
    window.run_steps(2);
    press(&mut window, NONE, Key::Enter);
    stored(&mut window, before);
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = chereme_corpus::Corpus::open_corpus(&path, "reader").expect("opened");
    let contents = corpus.load_recording_contents(1).expect("read");
    let tier = |name: &str| contents.tiers.iter().find(|it| it.row.name == name);
    let (gloss, added) = (tier("Gloss").expect("a tier"), tier("placement"));
    assert_eq!(added.expect("added").row.parent_id, Some(gloss.row.id));
}

#[test]
fn the_properties_of_a_tier_are_edited_in_words() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = three(folder.path());
    click(&mut window, "Tier Gloss");
    press(&mut window, CTRL, Key::T);
    let list = |window: &Window<'_>, label: &str| {
        let combo = window.get_by_role_and_label(Role::ComboBox, label);
        combo.value().unwrap_or_default()
    };
    window.get_by_role_and_label(Role::ComboBox, "What it says").click();
    window.run_steps(3);
    window.get_by_label("non-manual · brows").click_accesskit();
    window.run_steps(3);
    assert_eq!(list(&window, "What it says"), "non-manual · brows");
    assert_eq!(list(&window, "How"), "within its time (Included In)");
    let name = window.get_by_role_and_label(Role::TextInput, "Name of the tier");
    assert_eq!(name.value().as_deref(), Some("non-manual · brows"));
    // Arrows go through an open list, too.
    let says = window.get_by_role_and_label(Role::ComboBox, "What it says");
    says.focus();
    window.run_steps(2);
    press(&mut window, NONE, Key::Space);
    press(&mut window, NONE, Key::ArrowUp);
    let other = list(&window, "What it says");
    assert_ne!(other, "non-manual · brows");
    press(&mut window, NONE, Key::Space);
    press(&mut window, NONE, Key::ArrowDown);
    assert_eq!(list(&window, "What it says"), "non-manual · brows");
}

#[test]
fn the_tools_fit_a_narrow_pane_in_the_longer_language() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = common::window(StudioOptions {
        corpus: Some(common::small_corpus(folder.path())),
        language: InterfaceLanguage::French,
        asked_language: None,
        ..common::options(folder.path())
    });
    until(&mut window, "the corpus", |it| has(it, "escargot"));
    idle(&mut window);
    for (layout, narrow) in [(Key::F1, false), (Key::F2, true)] {
        press(&mut window, CTRL, layout);
        window.run_steps(3);
        let tiers = window.get_by_role_and_label(Role::Button, "Acteurs").rect();
        assert!(tiers.right() <= 1280.0, "{layout:?}: {tiers}");
        assert_eq!(has(&window, "Caler"), narrow, "{layout:?}");
    }
}
