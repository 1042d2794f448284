//! Searching, as a person would: by typing, by pictures, by facets, by example.

mod common;

use common::*;
use eframe::egui::accesskit::{Role, Toggled};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

/// Opens the small corpus with the search in front.
fn searching<'a>(folder: &std::path::Path) -> Window<'a> {
    let mut window = open_small(folder);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    window
}

fn query(window: &Window<'_>) -> String {
    let field = window.get_by_role_and_label(Role::TextInput, "Query");
    field.value().unwrap_or_default()
}

fn type_query(window: &mut Window<'_>, text: &str) {
    window.get_by_role_and_label(Role::TextInput, "Query").type_text(text);
    window.run_steps(4);
}

fn enter(window: &mut Window<'_>) {
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(window);
    window.run_steps(2);
}

fn hits(window: &Window<'_>) -> usize {
    let found = window.query_by_label_contains("Found: ");
    let text = found.and_then(|node| node.value().or_else(|| node.accesskit_node().label()));
    let text = text.unwrap_or_default();
    text.trim_start_matches("Found: ").parse().unwrap_or(usize::MAX)
}

#[test]
fn a_handshape_is_searched_by_typing_with_completion_and_its_hit_opened_by_keys() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    type_query(&mut window, "handsh");
    assert!(has(&window, "Write configuration="));
    window.key_press(Key::Tab);
    window.run_steps(2);
    assert_eq!(query(&window), "configuration=");
    type_query(&mut window, "Y");
    enter(&mut window);
    assert_eq!(query(&window), "configuration=Y");
    assert_eq!(hits(&window), 1);
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(&mut window);
    window.run_steps(3);
    assert!(window.state().playhead_instant().instant_micros() > 0);
}

#[test]
fn everyday_words_are_understood_and_an_opened_hit_is_visible_in_a_small_window() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.set_size(eframe::egui::vec2(800.0, 600.0));
    window.run_steps(3);
    assert!(has(&window, "Play"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    assert!(!has(&window, "Play"), "the stage is behind the search");
    type_query(&mut window, "handshape Y");
    enter(&mut window);
    assert_eq!(query(&window), "configuration=Y");
    assert_eq!(hits(&window), 1);
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(3);
    idle(&mut window);
    assert!(has(&window, "Play") && has(&window, "Tier Gloss"));
    assert!(
        window
            .query_by_label_contains("Ctrl+F goes back to the results")
            .is_some()
    );
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    assert_eq!(query(&window), "configuration=Y");
    assert_eq!(hits(&window), 1);
    // In a layout that shows both, no pane hides the other.
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(3);
    assert!(has(&window, "Play") && hits(&window) == 1);
}

#[test]
fn a_query_without_hits_is_offered_in_its_likely_meanings() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    type_query(&mut window, "forehead Y");
    enter(&mut window);
    assert_eq!(hits(&window), 0);
    click(&mut window, "Search for placement=forehead configuration=Y");
    idle(&mut window);
    assert_eq!(query(&window), "placement=forehead configuration=Y");
}

#[test]
fn a_slip_is_marked_and_mended() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    type_query(&mut window, "right.confguration=Y");
    click(&mut window, "Write configuration");
    assert_eq!(query(&window), "right.configuration=Y");
    enter(&mut window);
    assert_eq!(hits(&window), 1);
    type_query(&mut window, "zz");
    enter(&mut window);
    assert!(window.query_by_label_contains("is in no inventory").is_some());
}

#[test]
fn conditions_are_added_by_pictures_and_the_text_matches() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    click(&mut window, "Add a condition");
    click(&mut window, "handshape");
    window.run_steps(2);
    window.get_by_label("Type to find a value").type_text("y");
    window.run_steps(2);
    assert!(window.query_by_label_contains("Enter picks Y, ").is_some());
    enter(&mut window);
    assert_eq!(query(&window), "configuration=Y");
    assert_eq!(hits(&window), 1);
    click(&mut window, "Value of handshape in condition 1");
    let cell = "U, index and middle finger together";
    window.get_by_label(cell).click_accesskit();
    window.run_steps(2);
    idle(&mut window);
    window.run_steps(2);
    assert_eq!(query(&window), "configuration=U");
    assert_eq!(hits(&window), 0);
    until(&mut window, "what is to blame", |window| {
        has(window, "without configuration=U: 1")
    });
    click(&mut window, "without configuration=U: 1");
    idle(&mut window);
    assert_eq!(query(&window), "");
    click(&mut window, "Add a condition");
    click(&mut window, "placement");
    until(&mut window, "the body", |window| {
        has(window, "forehead, on the picture")
    });
    click(&mut window, "forehead, on the picture");
    idle(&mut window);
    assert_eq!(query(&window), "placement=forehead");
    click(&mut window, "Remove condition 1");
    idle(&mut window);
    assert_eq!(query(&window), "");
}

#[test]
fn facets_narrow_and_a_search_is_saved_renamed_and_deleted() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    enter(&mut window);
    assert_eq!(hits(&window), 1);
    let facet = window
        .get_all_by_role(Role::Button)
        .find_map(|node| {
            let label = node.accesskit_node().label()?;
            label.contains("configuration=Y (").then_some(label)
        })
        .expect("a facet of the handshape");
    window.get_by_label(&facet).click_accesskit();
    window.run_steps(2);
    idle(&mut window);
    let narrowed = query(&window);
    assert!(narrowed.ends_with("configuration==Y"), "{narrowed}");
    // A click switches a facet off, and the next switches it on.
    for wanted in [String::new(), narrowed] {
        window.get_by_label(&facet).click_accesskit();
        window.run_steps(2);
        idle(&mut window);
        assert_eq!(query(&window), wanted);
    }
    click(&mut window, "Saved");
    window.run_steps(3);
    window.get_by_label("Name of this search").type_text("vees");
    window.run_steps(2);
    let name = window.get_by_role_and_label(Role::TextInput, "Name of this search");
    assert_eq!(name.value().as_deref(), Some("vees"));
    click(&mut window, "Save");
    until(&mut window, "the kept search", |window| has(window, "Rename vees"));
    click(&mut window, "Rename vees");
    window.run_steps(2);
    window
        .get_by_role_and_label(Role::TextInput, "Rename vees")
        .type_text("2");
    window.run_steps(2);
    window.key_press(Key::Enter);
    until(&mut window, "the other name", |window| has(window, "Delete vees2"));
    let path = window.state().shown_corpus_path().expect("open").clone();
    let kept = || {
        let corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
        let all = corpus.kept_searches().expect("read");
        all.into_iter().map(|it| it.name).collect::<Vec<_>>()
    };
    assert_eq!(kept(), ["vees2"], "it is in the corpus");
    // The name of another search is asked about, whatever its case.
    let queries = || {
        let corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
        let all = corpus.kept_searches().expect("read");
        all.into_iter().map(|it| it.query).collect::<Vec<_>>()
    };
    let narrowed = queries();
    let other = chereme_corpus::KeptSearch {
        name: "vees2".into(),
        query: "movement=arc".into(),
    };
    let mut corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
    corpus.keep_searches(&[other]).expect("kept");
    until(&mut window, "the other search", |it| {
        it.state().shown_generation() == corpus.corpus_generation().ok()
    });
    click(&mut window, "Name of this search");
    window.get_by_label("Name of this search").type_text("VEES2");
    window.run_steps(2);
    click(&mut window, "Save");
    idle(&mut window);
    assert_eq!(queries(), ["movement=arc"]);
    click(&mut window, "Replace it");
    until(&mut window, "the first search", |window| has(window, "Delete VEES2"));
    assert_eq!(queries(), narrowed);
    click(&mut window, "Delete VEES2");
    until(&mut window, "an empty list", |window| !has(window, "Delete VEES2"));
    assert!(kept().is_empty());
}

#[test]
fn signs_like_the_selected_one_are_found_weighted_and_shown_as_a_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    enter(&mut window);
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(&mut window);
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::F);
    window.run_steps(2);
    idle(&mut window);
    assert!(query(&window).starts_with("like "), "{}", query(&window));
    assert!(window.query_by_role_and_label(Role::Slider, "placement").is_some());
    let slider = window.get_by_role_and_label(Role::Slider, "least similarity");
    slider.focus();
    window.run_steps(2);
    window.key_press(Key::ArrowRight);
    window.run_steps(2);
    idle(&mut window);
    assert!(query(&window).contains(" above 0."), "{}", query(&window));
    assert_eq!(hits(&window), 1, "a sign is like itself");
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::G);
    window.run_steps(2);
    idle(&mut window);
    assert!(has(&window, "Sort by before"));
    click(&mut window, "Sort by gloss");
    idle(&mut window);
    assert_eq!(hits(&window), 1);
}

/// Opens the first handshape of the facets in the inspector, and returns it.
fn inspect_handshape_facet(window: &mut Window<'_>) -> String {
    let facet = |window: &Window<'_>| {
        let found = window.get_all_by_role(Role::Button).find_map(|node| {
            let label = node.accesskit_node().label()?;
            (label.starts_with("configuration=") || label.contains(".configuration="))
                .then_some((node.rect().center(), label))
        });
        found.expect("a facet of handshapes")
    };
    let (at, label) = facet(window);
    let value = label.split(['=', ' ']).nth(1).expect("a value").to_owned();
    for pressed in [true, false] {
        let event = eframe::egui::Event::PointerButton {
            pos: at,
            button: eframe::egui::PointerButton::Primary,
            pressed,
            modifiers: Modifiers::COMMAND,
        };
        window.event_modifiers(event, Modifiers::COMMAND);
        window.step();
    }
    until(window, "the value", |window| has(window, "← What is selected"));
    value
}

#[test]
fn values_of_two_inventories_are_made_one_in_the_inspector_and_parted_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let table = folder.path().join("words.csv");
    std::fs::write(&table, "Gloss,Handshape\nMAIN,palm-hand\n").expect("written");
    let mut corpus = chereme_corpus::Corpus::open_corpus(&path, "A").expect("opened");
    let progress = &mut chereme_corpus::ProgressReceiver::silent_progress();
    let imported = corpus.import_paths(&[table], &chereme_corpus::ImportOptions::default(), progress);
    imported.expect("imported");
    drop(corpus);
    let mut window = common::window(chereme_studio::StudioOptions {
        corpus: Some(path.clone()),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    type_query(&mut window, "gloss=MAIN");
    enter(&mut window);
    assert_eq!(inspect_handshape_facet(&mut window), "palm-hand");
    until(&mut window, "its details", |window| has(window, "Make one with"));
    window.get_by_label("Make one with").focus();
    window.run_steps(2);
    window.get_by_label("Make one with").type_text("configurations/flat");
    window.run_steps(3);
    window.key_press(Key::Enter);
    idle(&mut window);
    until(&mut window, "the other value", |window| {
        has(window, "One with no other")
    });
    let groups = || {
        let corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
        corpus.list_equal_values().expect("a list").equal_groups().len()
    };
    assert!(has(&window, "configurations/flat"));
    assert_eq!(groups(), 1);
    click(&mut window, "One with no other");
    idle(&mut window);
    assert_eq!(groups(), 0);
}

#[test]
fn the_inspector_describes_a_facet_and_a_value_of_a_picker() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    type_query(&mut window, "gloss=ESCARGOT");
    enter(&mut window);
    let value = inspect_handshape_facet(&mut window);
    // The answer reports it, and the query stays.
    assert_eq!(query(&window), "gloss=ESCARGOT");
    until(&mut window, "its details", |window| {
        window.query_all_by_label_contains(&value).count() > 1
    });
}

#[test]
fn the_intended_saved_search_is_suggested() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let mut corpus = chereme_corpus::Corpus::open_corpus(&path, "A").expect("opened");
    let mine = chereme_corpus::KeptSearch {
        name: "mine".into(),
        query: "gloss=ESCARGOT".into(),
    };
    corpus.keep_searches(&[mine]).expect("kept");
    drop(corpus);
    let mut window = common::window(chereme_studio::StudioOptions {
        corpus: Some(path),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    type_query(&mut window, "@mein");
    assert!(has(&window, "No search is saved as mein."));
    click(&mut window, "Write @mine");
    assert_eq!(query(&window), "@mine");
    assert!(!has(&window, "No search is saved as mine."));
    enter(&mut window);
    assert_eq!((query(&window).as_str(), hits(&window)), ("gloss=ESCARGOT", 1));
}

#[test]
fn a_narrow_pane_shows_the_display_options_in_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    type_query(&mut window, "gloss:ESCARGOT");
    enter(&mut window);
    assert_eq!(hits(&window), 1);
    assert!(has(&window, "Display") && !has(&window, "Looping"));
    click(&mut window, "Display");
    click(&mut window, "Hand close up");
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(3);
    assert!(!has(&window, "Display") && has(&window, "Looping"));
    let close = window.get_by_label("Hand close up");
    assert_eq!(close.accesskit_node().toggled(), Some(Toggled::True));
}

#[test]
fn an_error_replaces_the_hits_of_another_query_and_a_slip_is_mended_by_a_click() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    enter(&mut window);
    assert_eq!(hits(&window), 1);
    type_query(&mut window, "right.configuration=Yy gloss=x");
    enter(&mut window);
    assert_eq!(hits(&window), usize::MAX, "old hits are no answer");
    let mend = window
        .get_all_by_role(Role::Button)
        .find_map(|node| {
            let label = node.accesskit_node().label()?;
            label.starts_with("Write ").then_some(label)
        })
        .expect("a slip that can be mended");
    click(&mut window, &mend);
    idle(&mut window);
    let value = mend.trim_start_matches("Write ");
    assert_eq!(query(&window), format!("right.configuration={value} gloss=x"));
}

#[test]
fn taking_over_searches_of_this_computer_asks_before_one_is_replaced() {
    let folder = tempfile::tempdir().expect("a folder");
    let settings = r#"{"searches": {"saved": [
        {"name": "chin", "query": "placement=head"},
        {"name": "short", "query": "duration<1s"}
    ]}}"#;
    std::fs::create_dir_all(folder.path().join("config")).expect("a folder");
    std::fs::write(folder.path().join("config/studio.json"), settings).expect("written");
    let path = small_corpus(folder.path());
    let kept = || {
        let corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
        let all = corpus.kept_searches().expect("read");
        all.into_iter()
            .map(|it| format!("{}: {}", it.name, it.query))
            .collect::<Vec<_>>()
    };
    let own = chereme_corpus::KeptSearch {
        name: "Chin".into(),
        query: "placement=chin".into(),
    };
    let mut corpus = chereme_corpus::Corpus::open_corpus(&path, "B").expect("opened");
    corpus.keep_searches(&[own]).expect("kept");
    let mut window = window(chereme_studio::StudioOptions {
        corpus: Some(path.clone()),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    click(&mut window, "Saved");
    window.run_steps(3);
    click(&mut window, "Take over into this corpus");
    idle(&mut window);
    window.run_steps(3);
    assert_eq!(kept(), ["Chin: placement=chin"], "nothing without a word");
    assert!(has(&window, "This corpus has other searches of these names: chin."));
    click(&mut window, "Only the others");
    until(&mut window, "the others", |window| has(window, "Delete short"));
    idle(&mut window);
    window.run_steps(3);
    assert_eq!(kept(), ["Chin: placement=chin", "short: duration<1s"]);
    // The one that was not taken over is still there.
    click(&mut window, "Take over into this corpus");
    window.run_steps(3);
    click(&mut window, "Replace them");
    until(&mut window, "the search in its place", |window| {
        has(window, "Delete chin")
    });
    assert_eq!(kept(), ["chin: placement=head", "short: duration<1s"]);
    window.run_steps(3);
    assert!(!has(&window, "Take over into this corpus"));
}

#[test]
fn stored_measures_order_and_count_the_hits() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_starter(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::ALT, Key::I);
    until(&mut window, "the measures", |it| contains(it, "Signs measured: "));
    click(&mut window, "Sort by gloss");
    let rows = || window.query_all_by_label_contains(", neighbours ");
    let glosses: Vec<String> = rows().filter_map(|row| row.accesskit_node().label()).collect();
    assert!(glosses.len() > 5 && glosses.is_sorted(), "{glosses:?}");
    window.get_by_label(&glosses[0]).click();
    window.run_steps(3);
    idle(&mut window);
    assert!(
        window.state().playhead_instant().instant_micros() > 0,
        "the sign is opened"
    );
    click(&mut window, "Store as attributes");
    until(&mut window, "stored measures", |it| contains(it, "signs stored"));
    idle(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    until(&mut window, "the hits", |it| contains(it, "Found: "));
    click(&mut window, "Order: best first");
    window.run_steps(3);
    click(&mut window, "neighbours");
    idle(&mut window);
    window.run_steps(3);
    assert!(has(&window, "Order: neighbours"));
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut corpus = chereme_corpus::Corpus::open_corpus(&path, "reader").expect("opened");
    let options = chereme_corpus::SearchOptions {
        order: chereme_corpus::HitOrder::AttributeDescending("density".to_owned()),
        ..chereme_corpus::SearchOptions::default()
    };
    let answer = corpus.search_tokens("", &options).expect("an answer");
    let first = window
        .query_all_by_label_contains(", neighbours ")
        .next()
        .expect("a hit");
    let first = first.accesskit_node().label().expect("its name");
    let (gloss, value) = (&answer.hits[0].gloss, &answer.hits[0].order_values[0]);
    assert!(
        first.starts_with(&format!("{gloss}, ")) && first.ends_with(&format!(", neighbours {value}")),
        "{first}"
    );
    click(&mut window, "Also count…");
    window.run_steps(3);
    click(&mut window, "signers");
    idle(&mut window);
    window.run_steps(3);
    let counted = window.query_all_by_label_contains("attribute.measure.signers=").next();
    counted.expect("a facet").click();
    window.run_steps(3);
    assert!(
        query(&window).starts_with("attribute.measure.signers=="),
        "{}",
        query(&window)
    );
}

#[test]
fn a_cross_table_counts_pairs_of_values_and_narrows_the_query() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = searching(folder.path());
    until(&mut window, "the hits", |it| contains(it, "Found: "));
    click(&mut window, "Cross table…");
    idle(&mut window);
    until(&mut window, "the table", |it| has(it, "Copy the table"));
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut corpus = chereme_corpus::Corpus::open_corpus(&path, "reader").expect("opened");
    let fields = ["configuration", "placement"].map(str::to_owned);
    let mut hear = chereme_corpus::ignore_progress_step;
    let mut progress = chereme_corpus::ProgressReceiver::new(&mut hear);
    let tally = corpus.tally_values("", &fields, &mut progress).expect("a table");
    let row = &tally.rows[0];
    click(&mut window, &format!("{} ({})", row.value, row.total));
    idle(&mut window);
    window.run_steps(3);
    let narrowed = query(&window);
    assert!(narrowed.starts_with("configuration="), "{narrowed}");
    assert_eq!(hits(&window), row.total);
}
