//! Import with a preview, and export of the selection, driven by labels.

mod common;

use chereme_corpus::ConsentAudience;
use common::*;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Role, pos2};
use egui_kittest::kittest::Queryable;

fn type_into(window: &mut Window<'_>, label: &str, text: &str) {
    window.get_by_label(label).click();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(2);
    window.get_by_label(label).type_text(text);
    window.run_steps(4);
}

fn shows(window: &Window<'_>, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

#[test]
fn files_are_inspected_before_they_are_imported() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let bad = folder.path().join("bad.bvh");
    std::fs::write(&bad, "HIERARCHY\nnonsense").expect("written");
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::I);
    window.run_steps(3);
    type_into(&mut window, "File or folder", &bad.display().to_string());
    click(&mut window, "Look at it first");
    idle(&mut window);
    assert!(shows(&window, "refused"), "a bad file says so");
    assert!(shows(&window, "What helps"));
    let files = folder.path().join("files");
    let names: Vec<_> = std::fs::read_dir(&files)
        .expect("there")
        .flatten()
        .map(|it| it.path())
        .filter(|path| path.file_stem().is_some_and(|stem| stem == "bol"))
        .collect();
    assert!(names.len() >= 2);
    let chosen = folder.path().join("chosen");
    std::fs::create_dir(&chosen).expect("made");
    for path in names {
        let to = chosen.join(path.file_name().expect("a name"));
        std::fs::copy(&path, to).expect("copied");
    }
    type_into(&mut window, "File or folder", &chosen.display().to_string());
    click(&mut window, "Look at it first");
    idle(&mut window);
    assert!(shows(&window, "nothing is written yet"));
    assert!(shows(&window, "parts found"), "the body is shown");
    assert!(shows(&window, "Tier Gloss is"), "tiers can be changed");
    let path = window.state().shown_corpus_path().expect("open").clone();
    let count = || {
        let corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
        corpus.load_corpus_overview(1).expect("read").recordings.len()
    };
    assert_eq!(count(), 1, "nothing is written by looking");
    let header = window.get_by_label("Joints and their parts of the body");
    header.click_accesskit();
    window.run_steps(12);
    window.get_by_label("Joint of: head").focus();
    window.run_steps(2);
    window.get_by_label("Joint of: head").type_text("x");
    window.run_steps(3);
    click(&mut window, "Look again");
    idle(&mut window);
    assert!(shows(&window, "refused"), "there is no such joint");
    click(&mut window, "Forget: head");
    click(&mut window, "Look again");
    idle(&mut window);
    assert!(shows(&window, "parts found"));
    click(&mut window, "Take in");
    idle(&mut window);
    assert!(shows(&window, "Undo takes it all back"));
    until(&mut window, "what was done", |it| shows(it, "Imported: "));
    assert!(!shows(&window, "another program"), "it is one's own work");
    window.key_press_modifiers(Modifiers::SHIFT, Key::F1);
    until(&mut window, "the new recording", |window| has(window, "bol"));
}

#[test]
fn the_shown_recording_is_exported_to_a_typed_path() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::E);
    window.run_steps(4);
    assert!(has(&window, "The recording escargot"));
    click(&mut window, "The whole corpus");
    click(&mut window, "table (.csv)");
    window.run_steps(2);
    let to = folder.path().join("all.csv");
    type_into(&mut window, "Where to", &to.display().to_string());
    click(&mut window, "Write");
    idle(&mut window);
    until(&mut window, "the notice", |window| {
        shows(window, &format!("Written: all.csv in {}", folder.path().display()))
    });
    assert!(std::fs::read_to_string(&to).expect("written").contains("ESCARGOT"));
    click(&mut window, "Write");
    idle(&mut window);
    assert!(shows(&window, "there already"), "what is there is not replaced unasked");
    click(&mut window, "Replace the existing file");
    click(&mut window, "Write");
    idle(&mut window);
    assert!(!shows(&window, "there already"));
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(!has(&window, "Where to"));
}

#[test]
fn an_export_for_others_leaves_out_and_names_what_nobody_agreed_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    let agree = |annotation| {
        let mut corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
        let change = chereme_corpus::ConsentChange {
            movement: Some(Some(ConsentAudience::Public)),
            annotation: Some(annotation),
            ..Default::default()
        };
        let signer = "signer:1".parse().expect("an address");
        corpus.change_consent(&[signer], &change).expect("changed");
    };
    agree(Some(ConsentAudience::Public));
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::E);
    window.run_steps(4);
    click(&mut window, "The whole corpus");
    click(&mut window, "everybody");
    let to = folder.path().join("all");
    type_into(&mut window, "Where to", &to.display().to_string());
    click(&mut window, "Write");
    idle(&mut window);
    assert!(shows(&window, "Written: ") && !shows(&window, "Left out"));
    agree(None);
    let to = folder.path().join("others");
    type_into(&mut window, "Where to", &to.display().to_string());
    click(&mut window, "Write");
    idle(&mut window);
    assert!(shows(&window, "Left out, because somebody has not agreed: 1"));
    assert!(shows(&window, "\"escargot\" is withheld from public because of"));
    assert!(!to.join("recordings").join("escargot.bvh").exists());
    click(&mut window, "The recording escargot");
    click(&mut window, "ELAN (.eaf)");
    click(&mut window, "Write");
    idle(&mut window);
    assert!(shows(&window, "under “Agreed to”"), "it says how to state a consent");
    click(&mut window, "me alone");
    click(&mut window, "Write");
    idle(&mut window);
    assert!(shows(&window, "this is for you alone"));
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(!shows(&window, "this is for you alone"));
    click(&mut window, "Share");
    click(&mut window, "Share as a body that moves (GLB)");
    idle(&mut window);
    until(&mut window, "who did not agree", |it| {
        shows(it, "this is for you alone")
    });
    assert!(folder.path().join("escargot.glb").exists());
}

#[test]
fn a_folder_of_the_start_page_is_inspected_first_and_cancelling_leaves_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = folder.path().join("takes");
    chereme_corpus::unpack_starter(&files).expect("unpacked");
    let path = folder.path().join("takes.chereme");
    let mut window = window(options(folder.path()));
    window.run_steps(2);
    for takes in [false, true] {
        let field = window.get_by_role_and_label(Role::TextInput, "Or type a path");
        field.focus();
        field.type_text(&files.display().to_string());
        window.run_steps(2);
        click(&mut window, "Import");
        until(&mut window, "the look", |it| shows(it, "nothing is written yet"));
        idle(&mut window);
        let corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
        assert!(corpus.load_corpus_overview(1).expect("read").recordings.is_empty());
        drop(corpus);
        if takes {
            click(&mut window, "Take in");
            idle(&mut window);
            until(&mut window, "what was done", |it| shows(it, "Imported: "));
            assert!(has(&window, "aimer"), "the recordings are shown");
        }
        window.key_press_modifiers(Modifiers::COMMAND, Key::W);
        window.run_steps(3);
        assert_eq!(path.exists(), takes, "an empty corpus does not stay");
    }
}

#[test]
fn remedies_name_parts_of_the_window_and_a_click_on_the_body_sets_a_joint() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let whole = std::fs::read_to_string(folder.path().join("files/escargot.bvh")).expect("there");
    // A hand whose joint has a meaningless name.
    let odd = folder.path().join("odd.bvh");
    std::fs::write(&odd, whole.replace("Head", "Thing")).expect("written");
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::I);
    window.run_steps(3);
    type_into(&mut window, "File or folder", &odd.display().to_string());
    click(&mut window, "Look at it first");
    idle(&mut window);
    assert!(shows(&window, "up is the file's Y axis"));
    assert!(!shows(&window, "--") && !shows(&window, "roles file"));
    let map = window.get_by_label_contains("parts found").rect();
    // The head is 0.08 of the height below the top, in the middle.
    let head = pos2(map.center().x, map.top() + map.height() * 0.08);
    window.hover_at(head);
    window.run_steps(3);
    for pressed in [true, false] {
        window.event(Event::PointerButton {
            pos: head,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        window.step();
    }
    until(&mut window, "the joints", |it| {
        it.query_by_label("Joint of: head").is_some_and(|it| it.is_focused())
    });
}
