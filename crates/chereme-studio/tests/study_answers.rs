//! The answers to a study, used like a person: listed and filtered, a participant deleted, all exported, and tables of
//! other survey programs imported by a map of their columns.

mod common;

use chereme_studio::InterfaceLanguage;
use common::studies::*;
use common::tiers::{CTRL, operations, stored};
use common::*;
use eframe::egui::Key;
use eframe::egui::accesskit::Role;
use egui_kittest::kittest::Queryable;

#[test]
fn answers_are_listed_filtered_deleted_and_exported() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened_with(folder.path(), InterfaceLanguage::English, |corpus| {
        answered(corpus, folder.path());
    });
    until(&mut window, "the study", |it| has(it, "places"));
    click(&mut window, "places");
    click(&mut window, "Answers");
    until(&mut window, "the list", |it| contains(it, "4 of 4; a click"));
    assert!(has(&window, "p1 · ESCARGOT, captured · realism: 5"));
    // A question that somebody passed over is in sight, too.
    assert!(has(&window, "p2 · ESCARGOT, higher · realism: passed over"));
    click(&mut window, "Only questions without an answer");
    until(&mut window, "the missing one", |it| contains(it, "1 of 4; a click"));
    assert!(!has(&window, "p1 · ESCARGOT, captured · realism: 5"));
    click(&mut window, "Only questions without an answer");
    type_into(&mut window, "Answers with", "CAPTURED");
    until(&mut window, "two answers", |it| contains(it, "2 of 4; a click"));
    click(&mut window, "p1 · ESCARGOT, captured · realism: 5");
    until(&mut window, "the clip", |it| {
        it.state().staged_movement_name() == Some("p1 · ESCARGOT, captured · realism: 5")
    });

    // The keyboard chooses a participant, whose deletion is confirmed.
    window.get_by_label("Participant: everybody").focus();
    window.run_steps(2);
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    assert!(contains(&window, "2 answers, 0 passed over, 0 not reached"));
    click(&mut window, "Delete p1…");
    assert!(contains(&window, "This deletes p1 with 2 answers"));
    click(&mut window, "Cancel");
    assert!(!has(&window, "Delete the participant"));
    click(&mut window, "Delete p1…");
    let before = operations(&window);
    click(&mut window, "Delete the participant");
    stored(&mut window, before);
    assert_eq!(corpus(&window).study_overviews().expect("read")[0].participants, 1);
    until(&mut window, "the shorter list", |it| {
        has(it, "Participant: everybody") && contains(it, "1 of 2; a click")
    });
    let before = operations(&window);
    window.key_press_modifiers(CTRL, Key::Z);
    stored(&mut window, before);
    assert_eq!(corpus(&window).study_overviews().expect("read")[0].answers, 3);

    // The list grows again, and moves the button below it.
    until(&mut window, "the longer list", |it| contains(it, "of 4; a click"));
    idle(&mut window);
    click_in_sight(&mut window, "Save the answers");
    until(&mut window, "the table", |it| contains(it, "Saved: "));
    let text = std::fs::read_to_string(folder.path().join("places-answers.csv"));
    assert_eq!(text.expect("written").lines().count(), 4);
}

#[test]
fn a_map_of_columns_is_shown_before_a_table_of_people_is_imported() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened_with(folder.path(), InterfaceLanguage::English, |corpus| {
        plan(corpus, &places("places"));
    });
    until(&mut window, "the study", |it| has(it, "places"));
    click(&mut window, "places");
    click(&mut window, "Answers");
    let file = folder.path().join("survey.csv");
    let table = "id,startlanguage,Q1,Q2,extra\n7,fr,A5,A1,x\n8,en,A2,,y\n";
    std::fs::write(&file, table).expect("written");
    drop_file(&mut window, &file);
    let header = "Tables with one participant a row (LimeSurvey, Qualtrics)";
    click(&mut window, header);
    window.run_steps(40);
    let map = "column;item;condition;question;means;values\n\
               id;;;;participant;\nstartlanguage;;;;language;\n\
               Q1;ESCARGOT;captured;realism;;\"A1=1; A2=2; A5=5\"\n\
               Q2;ESCARGOT;hgher;realism;;\"A1=1; A2=2; A5=5\"\n\
               Q3;;;;age;\n";
    let field = (Role::MultilineTextInput, header);
    let fill = |window: &mut Window<'_>, text: &str| {
        window.get_by_role_and_label(field.0, field.1).focus();
        window.run_steps(2);
        window.key_press_modifiers(CTRL, Key::A);
        window.run_steps(2);
        window.get_by_role_and_label(field.0, field.1).type_text(text);
        window.run_steps(3);
    };
    fill(&mut window, map);
    click(&mut window, "Show what would be imported");
    until(&mut window, "the faults", |it| contains(it, "map, line 5: "));
    assert!(contains(&window, "map, line 6: \"age\" is no meaning of a column"));
    let map = map.replace("hgher", "higher").replace("Q3;;;;age;\n", "");
    fill(&mut window, &map);
    let before = operations(&window);
    click(&mut window, "Show what would be imported");
    until(&mut window, "the preview", |it| has(it, "Nothing is stored yet:"));
    assert!(has(&window, "ESCARGOT · captured · realism") && has(&window, "A5 = 5"));
    assert!(has(&window, "left out") && contains(&window, "2 people new"));
    idle(&mut window);
    assert_eq!(operations(&window), before);
    click(&mut window, "Import the answers");
    stored(&mut window, before);
    until(&mut window, "the answers", |it| {
        has(it, "8 · ESCARGOT, captured · realism: 2")
    });
    click(&mut window, "Only questions without an answer");
    until(&mut window, "the missing one", |it| {
        has(it, "8 · ESCARGOT, higher · realism: not reached")
    });
    let study = corpus(&window).study_with_answers("places").expect("stored");
    let languages: Vec<&str> = study.participants.iter().map(|it| it.language.as_str()).collect();
    assert_eq!(languages, ["fr", "en"]);
}

#[test]
fn the_report_shows_bars_tables_and_conclusions_in_french() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened_with(folder.path(), InterfaceLanguage::French, |corpus| {
        answered(corpus, folder.path());
    });
    until(&mut window, "the study", |it| has(it, "places"));
    click(&mut window, "places");
    click(&mut window, "Rapport");
    until(&mut window, "the report", |it| {
        has(it, "2 personnes ont répondu, 2 sont analysées")
    });
    assert!(has(&window, "captured: 1: 0, 2: 0, 3: 0, 4: 0, 5: 2"));
    assert!(has(&window, "5,000") && has(&window, "2,000"));
    assert!(contains(&window, "Le plan n’énonce aucune hypothèse"));
}
