//! The pane of studies, used like a person: a plan with previews, the questionnaire, dropped answers, the report.

mod common;

use chereme_corpus::Corpus;
use chereme_corpus::study::StudyRequest;
use chereme_studio::InterfaceLanguage;
use common::studies::*;
use common::tiers::{ALT, CTRL, operations, stored};
use common::*;
use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key};
use egui_kittest::kittest::{NodeT, Queryable};

#[test]
fn a_study_is_planned_built_answered_and_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    until(&mut window, "the empty list", |it| contains(it, "No study yet"));
    click(&mut window, "New study");
    assert!(contains(&window, "a study needs trials"));
    type_into(&mut window, "Name of the study", "places");
    type_into(&mut window, "Signs", "ESCARGOT");
    click(&mut window, "Add a condition");
    type_into(&mut window, "Name of condition 2", "higher");
    let recipe = "Recipe of condition 2, with {} for the sign";
    type_into(&mut window, recipe, "place both by up 10cm");
    // The form moves its rows while the plan is checked, so the click waits for that.
    idle(&mut window);
    // Each clip is shown on the stage before anything is stored.
    click(&mut window, "ESCARGOT, higher");
    until(&mut window, "the clip", |it| {
        it.state().staged_movement_name() == Some("ESCARGOT, higher")
    });
    let before = operations(&window);
    click(&mut window, "Store the plan");
    stored(&mut window, before);
    until(&mut window, "the study", |it| {
        has(it, "Trials (2); a click shows the clip on the stage")
    });
    let path = window.state().shown_corpus_path().expect("open").clone();
    let corpus = Corpus::open_corpus(&path, "reader").expect("opened");
    let study = corpus.study_with_answers("places").expect("stored");
    assert_eq!(study.plan.trials[1].clip, "ESCARGOT | place both by up 10cm");

    click(&mut window, "Questionnaire");
    for (number, text) in [("Height of films", "64"), ("Pictures per second", "5")] {
        window.get_by_role_and_label(Role::SpinButton, number).focus();
        window.run_steps(2);
        window.event(Event::Text(text.to_owned()));
        window.run_steps(2);
        window.key_press(Key::Enter);
        window.run_steps(2);
    }
    click(&mut window, "Build the questionnaire");
    until(&mut window, "the questionnaire", |it| contains(it, "2 films, "));
    let page = folder.path().join("places-questionnaire/index.html");
    assert!(page.is_file());

    click(&mut window, "Answers");
    for (code, values) in [("p1", [4, 2]), ("p2", [5, 3])] {
        let values = [("captured", values[0]), ("higher", values[1])];
        let file = write_answers(folder.path(), &study.plan_sha256, code, &values);
        drop_file(&mut window, &file);
        let before = operations(&window);
        click(&mut window, "Import the answers");
        stored(&mut window, before);
    }
    until(&mut window, "the answers", |it| {
        has(it, "2 people answered, 2 to the end; 4 answers")
    });

    click(&mut window, "Report");
    until(&mut window, "the report", |it| {
        has(it, "2 people answered, 2 are analysed")
    });
    assert!(has(&window, "4.500") && has(&window, "2.500"));
    click(&mut window, "Save the report");
    until(&mut window, "the page", |it| contains(it, "Saved: "));
    let page = folder.path().join("places-report.html");
    let text = std::fs::read_to_string(page).expect("written");
    assert!(text.contains("<html lang=\"en\">"));

    // Undo takes the answers back one import after the other, and the plan.
    for left in [2, 0] {
        let before = operations(&window);
        window.key_press_modifiers(CTRL, Key::Z);
        stored(&mut window, before);
        assert_eq!(corpus.study_overviews().expect("read")[0].answers, left);
    }
    let before = operations(&window);
    window.key_press_modifiers(CTRL, Key::Z);
    stored(&mut window, before);
    until(&mut window, "the empty list", |it| contains(it, "No study yet"));
}

#[test]
fn the_form_takes_the_chosen_sign_and_speaks_french() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::French);
    click(&mut window, "Acteur Gloss");
    window.key_press_modifiers(ALT, Key::ArrowRight);
    window.run_steps(3);
    click(&mut window, "Nouvelle étude");
    click(&mut window, "Ajouter le signe choisi");
    let items = window.get_by_label("Signes").accesskit_node().value();
    assert!(items.is_some_and(|it| !it.is_empty()));
    click(&mut window, "Demander quel signe c’était");
    click(&mut window, "Retirer Question 2");
    assert!(!has(&window, "Question 2"));
    let store = window.get_by_label("Enregistrer le plan");
    assert!(store.accesskit_node().is_disabled(), "the name is missing");
}

#[test]
fn a_plan_that_is_left_can_be_continued_and_a_mended_fault_is_not_said_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    until(&mut window, "the empty list", |it| contains(it, "No study yet"));
    // The form is filled in without the mouse.
    window.get_by_label("New study").focus();
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(3);
    let name = window.get_by_label("Name of the study");
    assert!(name.accesskit_node().is_focused());
    type_into(&mut window, "Name of the study", "places");
    type_into(&mut window, "Signs", "NULLE");
    click(&mut window, "Store the plan");
    until(&mut window, "the fault", |it| contains(it, "is not in the corpus"));
    type_into(&mut window, "Signs", " ESCARGOT");
    assert!(!contains(&window, "is not in the corpus"));
    click(&mut window, "Back to the studies");
    click(&mut window, "Continue the unfinished plan");
    let name = window.get_by_label("Name of the study");
    assert_eq!(name.accesskit_node().value().as_deref(), Some("places"));
}

#[test]
fn the_work_of_a_study_is_found_again_after_another_was_looked_at() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    for name in ["one", "two"] {
        let conditions = vec![("captured".to_owned(), "{}".to_owned())];
        let request = StudyRequest {
            conditions,
            ..places(name)
        };
        plan(&mut corpus, &request);
    }
    until(&mut window, "the studies", |it| has(it, "two"));
    click(&mut window, "one");
    click(&mut window, "Questionnaire");
    // A file stands where the folder is to be.
    std::fs::write(folder.path().join("one-questionnaire"), "").expect("written");
    click(&mut window, "Build the questionnaire");
    click(&mut window, "two");
    idle(&mut window);
    assert!(!contains(&window, "one-questionnaire"));
    click(&mut window, "one");
    until(&mut window, "the fault", |it| contains(it, "one-questionnaire"));
    // Nobody has answered; a path that is emptied is not proposed again.
    click(&mut window, "Report");
    until(&mut window, "the report", |it| has(it, "Nobody has answered yet."));
    let file = (Role::TextInput, "File of the report (.html)");
    window.get_by_role_and_label(file.0, file.1).focus();
    window.run_steps(2);
    window.key_press_modifiers(CTRL, Key::A);
    window.run_steps(2);
    window.key_press(Key::Backspace);
    window.run_steps(3);
    let field = window.get_by_role_and_label(file.0, file.1);
    assert_eq!(field.accesskit_node().value().as_deref(), Some(""));
    let save = window.get_by_label("Save the report");
    assert!(save.accesskit_node().is_disabled());
}

#[test]
fn the_keyboard_keeps_what_it_reaches_in_sight() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::English);
    window.set_size([1280.0, 800.0].into());
    window.key_press_modifiers(CTRL, Key::F1);
    window.run_steps(3);
    window.key_press_modifiers(CTRL | ALT, Key::O);
    window.run_steps(3);
    click(&mut window, "New study");
    // The timeline lies below the pane.
    let bottom = 0.575 * 800.0;
    let last = "Each person sees a sign in one condition only";
    assert!(window.get_by_label(last).rect().top() > bottom);
    for _ in 0..20 {
        window.key_press(Key::Tab);
        window.run_steps(30);
        if window.get_by_label(last).is_focused() {
            break;
        }
    }
    let reached = window.get_by_label(last);
    assert!(reached.is_focused());
    assert!(reached.rect().bottom() < bottom, "{}", reached.rect());
}
