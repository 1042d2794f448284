//! The form of a plan, used like a person: a stored plan is changed, trials come from a table, hypotheses are stated.

mod common;

use chereme_corpus::study::study_plan::{HypothesisComparison, StudyPlan};
use chereme_studio::InterfaceLanguage;
use common::studies::*;
use common::tiers::{CTRL, operations, stored};
use common::*;
use eframe::egui::Key;
use eframe::egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};

fn value(window: &Window<'_>, label: &str) -> String {
    let node = window.get_by_label(label);
    node.accesskit_node().value().unwrap_or_default()
}

fn plan_of(window: &Window<'_>, name: &str) -> StudyPlan {
    corpus(window).study_with_answers(name).expect("stored").plan
}

/// Presses the button that stores the plan, and waits for it.
fn store(window: &mut Window<'_>) {
    idle(window);
    let before = operations(window);
    click_in_sight(window, "Store the plan");
    stored(window, before);
}

#[test]
fn a_stored_plan_is_opened_as_it_is_and_its_change_is_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened_with(folder.path(), InterfaceLanguage::English, |corpus| {
        let mut request = places("places");
        request.design.seed = 7;
        plan(corpus, &request);
    });
    until(&mut window, "the study", |it| has(it, "places"));
    click(&mut window, "places");
    let before = plan_of(&window, "places");
    click(&mut window, "Change the plan");
    assert_eq!(value(&window, "Name of the study"), "places");
    assert_eq!(value(&window, "Signs"), "ESCARGOT");
    let recipe = "Recipe of condition 2, with {} for the sign";
    assert_eq!(value(&window, recipe), "{} | place both by up 10cm");
    assert!(contains(&window, "Nobody has answered “places”"));
    // A plan that is stored again without a change stays the same, and nothing is to be undone.
    idle(&mut window);
    let done = operations(&window);
    click_in_sight(&mut window, "Store the plan");
    until(&mut window, "the stored plan", |it| {
        has(it, "Change the plan") && it.state().is_idle()
    });
    assert_eq!(
        (plan_of(&window, "places"), operations(&window)),
        (before.clone(), done)
    );

    click(&mut window, "Change the plan");
    click(&mut window, "Add a question");
    type_into(&mut window, "Question 2", "clarity=1-7");
    click_in_sight(&mut window, "Hypotheses (0)");
    window.run_steps(40);
    click_in_sight(&mut window, "Add a hypothesis");
    window.run_steps(3);
    type_into(&mut window, "Hypothesis 1: statement", "higher signs look worse");
    let second = ["captured", "higher"].map(|it| format!("Hypothesis 1, Group 2: {it}"));
    for condition in &second {
        click_in_sight(&mut window, condition);
    }
    until(&mut window, "the fault", |it| {
        contains(it, "two groups have the same trials")
    });
    for condition in &second {
        click_in_sight(&mut window, condition);
    }
    store(&mut window);
    let after = plan_of(&window, "places");
    assert_eq!((after.questions.len(), after.design.seed), (2, 7));
    let HypothesisComparison::Between(groups) = &after.hypotheses[0].compares else {
        panic!("two groups")
    };
    assert_eq!(groups[1].conditions, ["higher"]);
    assert_eq!(after.hypotheses[0].text["en"], "higher signs look worse");
    until(&mut window, "the hypothesis", |it| {
        contains(it, "H1: realism: captured ≠ higher – higher signs look worse")
    });
    // The hypothesis is removed in the form, and comes back with an undo.
    click(&mut window, "Change the plan");
    // The form shows the parts that were open before.
    window.run_steps(40);
    click_in_sight(&mut window, "Remove Hypothesis 1");
    store(&mut window);
    assert!(plan_of(&window, "places").hypotheses.is_empty());
    for expected in [&after, &before] {
        let operations = operations(&window);
        window.key_press_modifiers(CTRL, Key::Z);
        stored(&mut window, operations);
        assert_eq!(&plan_of(&window, "places"), expected);
    }
}

#[test]
fn a_change_of_an_answered_plan_is_a_study_of_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened_with(folder.path(), InterfaceLanguage::English, |corpus| {
        answered(corpus, folder.path());
    });
    until(&mut window, "the study", |it| has(it, "places"));
    click(&mut window, "places");
    click(&mut window, "Change the plan");
    assert!(contains(
        &window,
        "2 people gave 3 answers to “places”, and these name its plan"
    ));
    assert_eq!(value(&window, "Name of the study"), "places (2)");
    click(&mut window, "Each person sees a sign in one condition only");
    store(&mut window);
    assert!(plan_of(&window, "places (2)").design.between);
    assert!(!plan_of(&window, "places").design.between);
    let answers: Vec<u64> = corpus(&window)
        .study_overviews()
        .expect("read")
        .iter()
        .map(|it| it.answers)
        .collect();
    assert_eq!(answers, [3, 0]);
}

#[test]
fn plans_that_were_left_stay_whatever_is_looked_at_since() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened_with(folder.path(), InterfaceLanguage::English, |corpus| {
        plan(corpus, &places("places"));
    });
    until(&mut window, "the study", |it| has(it, "places"));
    for name in ["first", "second"] {
        click(&mut window, "New study");
        type_into(&mut window, "Name of the study", name);
        click(&mut window, "Back to the studies");
    }
    // A stored plan that was only looked at is not unfinished.
    click(&mut window, "places");
    click(&mut window, "Change the plan");
    assert_eq!(value(&window, "Name of the study"), "places");
    click(&mut window, "Back to the studies");
    for name in ["second", "first"] {
        click(&mut window, "Continue the unfinished plan");
        assert_eq!(value(&window, "Name of the study"), name);
        type_into(&mut window, "Signs", "ESCARGOT");
        idle(&mut window);
        store(&mut window);
    }
    assert!(!has(&window, "Continue the unfinished plan"));
    assert_eq!(corpus(&window).study_overviews().expect("read").len(), 3);
}

#[test]
fn a_table_of_trials_is_typed_or_dropped_and_each_wrong_row_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened(folder.path(), InterfaceLanguage::French);
    until(&mut window, "the empty list", |it| contains(it, "Pas encore"));
    click(&mut window, "Nouvelle étude");
    type_into(&mut window, "Nom de l’étude", "tableau");
    let file = folder.path().join("essais.csv");
    let wrong = "item;condition;clip;role;distance\nESCARGOT;a;ESCARGOT;;1\nESCARGOT;b;;;2\nESCARGOT;c;ESCARGOT;;x\n";
    std::fs::write(&file, wrong).expect("written");
    drop_file(&mut window, &file);
    until(&mut window, "the first fault", |it| {
        contains(it, "essais.csv, ligne 3 : un essai a besoin")
    });
    assert!(contains(&window, "essais.csv, ligne 4 : "));
    let store = window.get_by_label("Enregistrer le plan");
    assert!(store.accesskit_node().is_disabled());
    let right = wrong.replace("b;;;2", "b;ESCARGOT | reverse;;2").replace(";x", ";3.5");
    std::fs::write(&file, right).expect("written");
    drop_file(&mut window, &file);
    until(&mut window, "the trials", |it| has(it, "ESCARGOT, c"));
    idle(&mut window);
    let before = operations(&window);
    click(&mut window, "Enregistrer le plan");
    stored(&mut window, before);
    let plan = plan_of(&window, "tableau");
    assert_eq!(plan.trials.len(), 3);
    assert_eq!(plan.trials[2].measures["distance"], 3.5);
    // The table is in the form again, as text.
    click(&mut window, "Modifier le plan");
    let table = window.get_by_role_and_label(Role::MultilineTextInput, "Tableau d’essais");
    let text = table.accesskit_node().value().unwrap_or_default();
    assert!(text.contains("ESCARGOT,b,ESCARGOT | reverse,2"), "{text}");
}

#[test]
fn distances_texts_and_the_file_of_a_plan_are_in_the_form() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = opened_with(folder.path(), InterfaceLanguage::English, |corpus| {
        let mut request = places("places");
        request.questions = vec!["place=left right".to_owned()];
        plan(corpus, &request);
    });
    until(&mut window, "the study", |it| has(it, "places"));
    click(&mut window, "places");
    click(&mut window, "Change the plan");
    // The keyboard chooses in the list of conditions.
    window.get_by_label("Distances of clips from: none").focus();
    window.run_steps(2);
    window.key_press(Key::ArrowDown);
    window.run_steps(2);
    assert!(has(&window, "Distances of clips from: captured"));
    click(&mut window, "What participants read");
    window.run_steps(40);
    click(&mut window, "place");
    window.run_steps(40);
    type_into(&mut window, "place: left, picture", "left.png");
    type_into(&mut window, "place: left, in French", "à gauche");
    click(&mut window, "Asked after a second viewing");
    store(&mut window);
    let stored_plan = plan_of(&window, "places");
    assert!(stored_plan.trials[0].measures["distance"].abs() < 1e-6);
    assert!(stored_plan.trials[1].measures["distance"] > 0.0);
    let json = serde_json::to_value(&stored_plan.questions[0]).expect("JSON");
    assert_eq!(json["after"], "second");
    assert_eq!(json["kind"]["choice"]["options"][0]["picture"], "left.png");
    assert_eq!(json["kind"]["choice"]["options"][0]["text"]["fr"], "à gauche");

    click(&mut window, "Save the plan as a file");
    window.run_steps(40);
    click(&mut window, "Save the plan");
    until(&mut window, "the file", |it| contains(it, "Saved: "));
    let text = std::fs::read_to_string(folder.path().join("places-plan.json")).expect("written");
    let read = chereme_corpus::Corpus::read_plan(&text, "plan.json").expect("a plan");
    assert_eq!(read, stored_plan);
}
