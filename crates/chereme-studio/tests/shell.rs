//! The window without a corpus, driven by labels.

mod common;

use chereme_corpus::Corpus;
use chereme_studio::StudioOptions;
use common::*;
use eframe::egui::{Key, Modifiers, Rect, Role, ViewportCommand, ViewportEvent, ViewportId};
use egui_kittest::kittest::Queryable;

#[test]
fn the_starter_corpus_is_opened_and_a_recording_played() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_starter(folder.path());
    click(&mut window, "aimer");
    until(&mut window, "the tiers", |window| has(window, "Tier Gloss"));
    idle(&mut window);
    assert_eq!(window.state().playhead_instant().instant_micros(), 0);
    click(&mut window, "Play");
    window.run_steps(30);
    let at = window.state().playhead_instant().instant_micros();
    assert!((400_000..700_000).contains(&at), "{at}");
    assert!(has(&window, "Pause"));
    click(&mut window, "Pause");
    let at = window.state().playhead_instant();
    window.run_steps(10);
    assert_eq!(window.state().playhead_instant(), at);
    window.key_press_modifiers(Modifiers::COMMAND, Key::ArrowRight);
    window.run_steps(2);
    assert!(window.state().playhead_instant() > at);
}

#[test]
fn the_start_page_shows_errors_with_remedies() {
    let folder = tempfile::tempdir().expect("a folder");
    let rubbish = folder.path().join("no.chereme");
    std::fs::write(&rubbish, "rubbish, rubbish").expect("written");
    let mut window = window(StudioOptions {
        corpus: Some(rubbish),
        ..options(folder.path())
    });
    until(&mut window, "the notice", |window| has(window, "Close"));
    assert!(window.query_by_label_contains("What helps: choose a file").is_some());
    click(&mut window, "Close");
    window.step();
    assert!(!has(&window, "Close"));
    assert!(has(&window, "Open the starter corpus"));
}

#[test]
fn a_corpus_is_checked_from_the_menu() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    click(&mut window, "File");
    window.run_steps(2);
    window.get_by_label_contains("Check the corpus").click();
    until(&mut window, "what was found", |window| {
        has(window, "Checked: nothing is wrong.")
    });
}

/// Returns the place of the lowest widget with that label: a tab, below the menu of the same name.
fn lowest(window: &Window<'_>, label: &str) -> Rect {
    let all = window.query_all_by_label(label).map(|it| it.rect());
    let lowest = all.max_by(|a, b| a.top().total_cmp(&b.top()));
    lowest.unwrap_or(Rect::NOTHING)
}

#[test]
fn every_tab_of_a_narrow_strip_is_reached_and_the_open_one_is_in_sight() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_starter(folder.path());
    let wide = [1280.0, 800.0];
    for (size, pane) in [
        (wide, "Import"),
        (wide, "Recombine"),
        ([1024.0, 700.0], "Cueing"),
        ([1024.0, 700.0], "Library"),
    ] {
        window.set_size(size.into());
        window.run_steps(4);
        let edge = lowest(&window, "Stage").left();
        let menus = window.query_all_by_label("All panes of this strip");
        let menu = menus.min_by(|a, b| a.rect().left().total_cmp(&b.rect().left()));
        let menu = menu.expect("a menu");
        assert!(menu.rect().right() <= edge, "it belongs to the narrow strip");
        menu.click();
        window.run_steps(3);
        let entries = window.query_all_by_label(pane);
        let entry = entries.max_by(|a, b| a.rect().top().total_cmp(&b.rect().top()));
        entry.expect("an entry").click();
        window.run_steps(10);
        let tab = lowest(&window, pane);
        assert!(
            tab.left() >= -1.0 && tab.right() <= edge,
            "{pane} at {size:?}: {tab:?}, the stage begins at {edge}"
        );
    }
}

#[test]
fn the_hint_below_the_map_is_whole_in_a_narrow_pane() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_starter(folder.path());
    window.set_size([1024.0, 700.0].into());
    click(&mut window, "Map");
    let there = |window: &Window<'_>| {
        let mut hints = window.query_all_by_label_contains("The wheel zooms");
        hints.next().is_some()
    };
    until(&mut window, "the map", there);
    window.run_steps(4);
    let hint = window.get_by_label_contains("The wheel zooms").rect();
    let below = lowest(&window, "Timeline").top();
    assert!(hint.bottom() <= below, "{hint:?} ends above {below}");
}

#[test]
fn the_tools_of_the_map_leave_room_for_it_in_a_narrow_pane() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_starter(folder.path());
    click(&mut window, "Map");
    let there = |window: &Window<'_>| {
        let mut count = window.query_all_by_label_contains("Signs on the map");
        count.next().is_some()
    };
    until(&mut window, "the map", there);
    window.run_steps(3);
    let top = window.get_by_label("Similar by").rect().top();
    let lowest = window.get_by_label("Whole map").rect().bottom();
    assert!(lowest - top < 110.0, "{top} to {lowest}");
}

#[test]
fn a_used_path_is_not_appended_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let mut window = window(options(folder.path()));
    window.run_steps(2);
    let typed = path.display().to_string();
    let field = window.get_by_role_and_label(Role::TextInput, "Or type a path");
    field.focus();
    field.type_text(&typed);
    window.run_steps(2);
    click(&mut window, "Open");
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::W);
    window.run_steps(3);
    let field = window.get_by_role_and_label(Role::TextInput, "Or type a path");
    assert_eq!(field.value().unwrap_or_default(), "");
}

#[test]
fn the_start_page_is_operated_by_keys_and_resumes_the_last_corpus() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let mut window = open_starter_by_key(folder.path());
    assert!(has(&window, "aimer"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::W);
    window.run_steps(3);
    // The last opened corpus has the keyboard focus; the offers are below it.
    let focused = |window: &Window<'_>, label: &str| window.get_by_label(label).is_focused();
    assert!(focused(&window, "starter"));
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    assert!(focused(&window, "Open the starter corpus"));
    click(&mut window, "Forget starter; its file stays");
    window.run_steps(2);
    assert!(!has(&window, "starter"), "it is not offered any more");
    drop(window);
    let corpus = Some(path);
    let mut window = self::window(StudioOptions {
        corpus,
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    drop(window);
    let mut window = self::window(options(folder.path()));
    window.run_steps(3);
    window.key_press(Key::Enter);
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    let open = window.state().shown_corpus_path().expect("open");
    assert!(open.ends_with("small.chereme"), "{open:?}");
}

/// Opens the starter corpus without a mouse.
fn open_starter_by_key<'a>(folder: &std::path::Path) -> Window<'a> {
    let mut window = window(options(folder));
    window.run_steps(2);
    window.key_press(Key::Enter);
    until(&mut window, "the starter corpus", |window| has(window, "aimer"));
    idle(&mut window);
    window
}

#[test]
fn opened_corpora_and_choices_are_remembered() {
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
    assert!(has(&window, "Fonds"));
    let path = window.state().shown_corpus_path().expect("open").clone();
    drop(window);
    let mut window = self::window(options(folder.path()));
    window.run_steps(3);
    assert!(has(&window, "Ouvrir le corpus de départ"));
    let name = path.file_stem().expect("a name").to_string_lossy();
    click(&mut window, &name);
    until(&mut window, "the corpus", |window| has(window, "escargot"));
}

#[test]
fn a_change_by_another_program_is_noticed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut other = Corpus::open_corpus(&path, "B").expect("opened");
    other
        .recombine_recipe("ESCARGOT | configure right U", "LIMACE")
        .expect("made");
    until(&mut window, "the new recording", |window| has(window, "LIMACE"));
    let said = "B changed the corpus in another program: LIMACE made";
    until(&mut window, "who did what", |it| {
        it.query_by_label_contains(said).is_some()
    });
}

#[cfg(unix)]
#[test]
fn a_corpus_that_is_deleted_while_it_is_open_is_noticed_and_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    for end in ["", "-wal", "-shm"] {
        // A missing file needs no removal.
        drop(std::fs::remove_file(format!("{}{end}", path.display())));
    }
    until(&mut window, "the notice", |it| has(it, "Put it back"));
    assert!(has(&window, "Save a copy…") && has(&window, "Error"));
    assert!(window.query_by_label_contains("The corpus file is gone").is_some());
    // The window stays open at first.
    let close = |window: &mut common::Window<'_>| {
        let viewport = window.input_mut().viewports.get_mut(&ViewportId::ROOT);
        let viewport = viewport.expect("the window");
        viewport.events.push(ViewportEvent::Close);
        window.step();
        let all = &window.output().viewport_output[&ViewportId::ROOT].commands;
        all.contains(&ViewportCommand::CancelClose)
    };
    assert!(close(&mut window));
    assert!(has(&window, "Put it back"));
    assert!(
        window
            .query_by_label_contains("closing the window again loses it")
            .is_some()
    );
    assert!(!close(&mut window));
    click(&mut window, "Put it back");
    until(&mut window, "the file", |_| path.is_file());
    until(&mut window, "the corpus", |it| {
        !has(it, "Put it back") && has(it, "escargot")
    });
    idle(&mut window);
    let corpus = Corpus::open_corpus(&path, "B").expect("opened");
    assert_eq!(corpus.load_corpus_overview(1).expect("read").recordings.len(), 1);
}

#[test]
fn a_small_window_shows_stage_and_timeline_and_grows_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    until(&mut window, "the tiers", |it| has(it, "Tier Gloss"));
    assert!(has(&window, "Trails"));
    window.set_size(eframe::egui::vec2(800.0, 600.0));
    window.run_steps(3);
    assert!(has(&window, "Tier Gloss") && has(&window, "Show…") && !has(&window, "Trails"));
    assert!(!has(&window, "Recordings (1)"));
    // A click on the time lets the user type another.
    click(&mut window, "Go to a time…");
    window.run_steps(3);
    assert!(has(&window, "Go"));
    window.key_press(eframe::egui::Key::Escape);
    window.set_size(eframe::egui::vec2(1280.0, 800.0));
    window.run_steps(3);
    assert!(has(&window, "Trails") && has(&window, "Recordings (1)"));
}

#[test]
fn the_first_steps_name_the_keys_and_the_start_page_speaks_either_language() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(options(folder.path()));
    window.run_steps(3);
    click(&mut window, "Français");
    window.run_steps(2);
    assert!(has(&window, "Ouvrir le corpus de départ"));
    click(&mut window, "English");
    window.run_steps(2);
    window.key_press(Key::F12);
    window.run_steps(3);
    assert!(has(&window, "2. Annotate"));
    assert!(window.query_by_label_contains("Ctrl+Z").is_some());
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(!has(&window, "2. Annotate"));
}
