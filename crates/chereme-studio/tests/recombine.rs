//! Recombination, driven by its labels: LIMACE from ESCARGOT, stored, undone, opened again, changed.

use std::path::{Path, PathBuf};
use std::time::Duration;

use chereme_corpus::{
    Corpus, ImportOptions, ListFilter, ListKind, ProgressReceiver, ignore_progress_step, unpack_starter,
};
use chereme_studio::{InterfaceLanguage, Studio, StudioFolders, StudioOptions};
use eframe::egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};

type Window<'a> = Harness<'a, Studio>;

/// Draws frames until `done`, for at most a minute.
fn until(window: &mut Window<'_>, what: &str, done: impl Fn(&Window<'_>) -> bool) {
    for _ in 0..12_000 {
        window.step();
        if done(window) {
            window.step();
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("{what} never came");
}

fn idle(window: &mut Window<'_>) {
    window.run_steps(2);
    until(window, "an idle window", |window| window.state().is_idle());
}

fn has(window: &Window<'_>, label: &str) -> bool {
    window.query_all_by_label(label).next().is_some()
}

fn shows(window: &Window<'_>, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

/// Clicks a label without the pointer, which could miss: cards grow when their results arrive.
fn press(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click_accesskit();
    window.step();
    window.step();
}

fn click(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

fn type_into(window: &mut Window<'_>, label: &str, text: &str) {
    window.get_by_label(label).click();
    window.run_steps(2);
    window.get_by_label(label).type_text(text);
    window.run_steps(3);
}

/// Returns a corpus with a few signs, one of them only in the lexicon.
fn corpus(folder: &Path) -> PathBuf {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let wanted = |path: &PathBuf| {
        let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
        stem.is_some_and(|stem| ["escargot", "lion", "lexicon"].contains(&stem.as_str()))
    };
    let files: Vec<PathBuf> = files.into_iter().filter(wanted).collect();
    let path = folder.join("small.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let options = ImportOptions::default();
    corpus.import_paths(&files, &options, &mut progress).expect("imported");
    path
}

fn open<'a>(folder: &Path) -> Window<'a> {
    let options = StudioOptions {
        corpus: Some(corpus(folder)),
        author: "Zoé".into(),
        folders: StudioFolders {
            config: Some(folder.join("config")),
            data: Some(folder.join("data")),
        },
        language: InterfaceLanguage::English,
        asked_language: None,
    };
    let mut window = Harness::builder()
        .with_size([1280.0, 1500.0])
        .with_step_dt(1.0 / 60.0)
        .build_ui_state(|ui, studio: &mut Studio| studio.ui(ui), Studio::new(options));
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    window
}

/// Returns the names of the recordings in the corpus file.
fn recordings(window: &Window<'_>) -> Vec<String> {
    let path = window.state().shown_corpus_path().expect("open");
    let corpus = Corpus::open_corpus(path, "B").expect("opened");
    let listing = corpus
        .list_rows(ListKind::Recordings, &ListFilter::default())
        .expect("listed");
    let name = |row: &serde_json::Map<String, serde_json::Value>| row["name"].as_str().map(str::to_owned);
    listing.rows.iter().filter_map(name).collect()
}

fn recipe_of(window: &Window<'_>) -> String {
    window.get_by_label("Recipe").value().unwrap_or_default()
}

fn key(window: &mut Window<'_>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(3);
}

#[test]
fn limace_is_made_from_escargot_stored_undone_and_changed() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::R);
    click(&mut window, "Begin with…");
    click(&mut window, "Sign");
    type_into(&mut window, "Gloss or address of the sign", "esc");
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(recipe_of(&window), "ESCARGOT");
    idle(&mut window);
    assert!(shows(&window, "frames at"), "what was made is told on the card");
    click(&mut window, "Change…");
    window.get_by_label_contains("Handshape").click();
    window.run_steps(3);
    assert!(shows(&window, "Not filled in yet"));
    assert!(has(&window, "Type to find a value"), "its picker is open");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!has(&window, "Type to find a value"));
    assert_eq!(recipe_of(&window), "ESCARGOT");
    type_into(&mut window, "Handshape", "U");
    assert_eq!(recipe_of(&window), "ESCARGOT | configure dominant U");
    idle(&mut window);
    assert!(shows(&window, "becomes U"), "the report is on its card");
    key(&mut window, Modifiers::NONE, Key::Escape);
    type_into(&mut window, "Gloss of the new sign", "LIMACE");
    click(&mut window, "Store");
    until(&mut window, "the new sign", |window| has(window, "Show it"));
    idle(&mut window);
    assert!(recordings(&window).contains(&"LIMACE".to_owned()));
    click(&mut window, "Card: Handshape");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    idle(&mut window);
    assert!(!recordings(&window).contains(&"LIMACE".to_owned()));
    // The status never reports an undone sign as stored.
    until(&mut window, "the snapshot", |window| !has(window, "Show it"));
    key(&mut window, Modifiers::COMMAND, Key::Y);
    idle(&mut window);
    assert!(recordings(&window).contains(&"LIMACE".to_owned()));
}

/// Opens the stored sign in the list of recordings.
fn show(window: &mut Window<'_>, recording: &str) {
    key(window, Modifiers::SHIFT, Key::F1);
    click(window, recording);
    idle(window);
    until(window, "its tiers", |window| has(window, "Tier Gloss"));
}

#[test]
fn a_stored_recipe_is_opened_again_changed_and_stored_as_another() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut other = Corpus::open_corpus(&path, "B").expect("opened");
    other
        .recombine_recipe("ESCARGOT | configure right U", "LIMACE")
        .expect("made");
    until(&mut window, "the made sign", |window| has(window, "LIMACE"));
    show(&mut window, "LIMACE");
    until(&mut window, "the inspector", |window| has(window, "Open in Recombine"));
    window
        .get_all_by_label("Open in Recombine")
        .next()
        .expect("a button")
        .click();
    window.run_steps(4);
    idle(&mut window);
    assert_eq!(recipe_of_stored(&window), "ESCARGOT | configure right U");
    click(&mut window, "Change…");
    window.get_by_label_contains("Reverse").click();
    window.run_steps(3);
    idle(&mut window);
    click(&mut window, "Store as new");
    until(&mut window, "the new sign", |window| has(window, "Show it"));
    idle(&mut window);
    assert_eq!(
        recordings(&window)
            .iter()
            .filter(|name| name.starts_with("LIMACE"))
            .count(),
        2
    );
}

#[test]
fn a_changed_recipe_replaces_its_sign_and_undo_restores_the_former_one() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut other = Corpus::open_corpus(&path, "B").expect("opened");
    other
        .recombine_recipe("ESCARGOT | configure right U", "LIMACE")
        .expect("made");
    until(&mut window, "the made sign", |window| has(window, "LIMACE"));
    show(&mut window, "LIMACE");
    until(&mut window, "the inspector", |window| has(window, "Open in Recombine"));
    press(&mut window, "Open in Recombine");
    idle(&mut window);
    let is_enabled = |window: &Window<'_>| {
        let node = window.get_by_label("Replace LIMACE");
        !node.accesskit_node().is_disabled()
    };
    assert!(!is_enabled(&window), "nothing was changed yet");
    click(&mut window, "Change…");
    window.get_by_label_contains("Repeat").click();
    window.run_steps(3);
    idle(&mut window);
    assert!(is_enabled(&window));
    let length = |window: &Window<'_>| {
        let path = window.state().shown_corpus_path().expect("open");
        let overview = Corpus::open_corpus(path, "B").expect("opened").load_corpus_overview(1);
        let all = overview.expect("read").recordings;
        let made = all.iter().find(|it| it.row.name == "LIMACE");
        made.expect("there").row.duration_us
    };
    let before = length(&window);
    click(&mut window, "Replace LIMACE");
    until(&mut window, "the new form", |window| has(window, "Show it"));
    idle(&mut window);
    assert_eq!(recordings(&window), ["escargot", "LIMACE"]);
    assert!(length(&window) > before);
    press(&mut window, "Card: Repeat");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    idle(&mut window);
    assert_eq!(length(&window), before);
    // The pane never reports an undone replacement as stored; redo brings the report back.
    until(&mut window, "the snapshot", |window| !has(window, "Show it"));
    key(&mut window, Modifiers::COMMAND, Key::Y);
    idle(&mut window);
    until(&mut window, "the new form", |window| has(window, "Show it"));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    idle(&mut window);
    assert_eq!(length(&window), before);
    // The next undo undoes the earlier change of the recipe.
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(recipe_of_stored(&window), "ESCARGOT | configure right U");
}

#[test]
fn a_placed_hand_is_moved_on_the_stage_by_keys_and_by_dragging() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::R);
    type_into(&mut window, "Recipe", "ESCARGOT | place right by up 10cm");
    idle(&mut window);
    assert!(!has(&window, "Move: right hand"), "no card is chosen");
    press(&mut window, "Card: Place");
    idle(&mut window);
    let value = |window: &Window<'_>| {
        let node = window.get_by_label("Move: right hand");
        node.value().unwrap_or_default()
    };
    assert_eq!(value(&window), "left 0.0 · up 10.0 · forward 0.0 cm");
    window.get_by_label("Move: right hand").focus();
    window.run_steps(2);
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    key(&mut window, Modifiers::SHIFT, Key::ArrowRight);
    key(&mut window, Modifiers::NONE, Key::PageDown);
    idle(&mut window);
    assert_eq!(
        recipe_of(&window),
        "ESCARGOT | place right by left 5cm up 9cm forward 1cm"
    );
    assert_eq!(value(&window), "left 5.0 · up 9.0 · forward 1.0 cm");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(recipe_of(&window), "ESCARGOT | place right by up 10cm");
    idle(&mut window);

    // The handle is at the hand's place in the picture.
    press(&mut window, "Pause");
    until(&mut window, "the picture", |window| window.state().is_drawn());
    let from = window.get_by_label("Move: right hand").rect().center();
    let to = from + eframe::egui::vec2(-30.0, -40.0);
    window.drag_at(from);
    window.run_steps(2);
    for share in [0.3, 0.6, 1.0] {
        window.hover_at(from + (to - from) * share);
        window.run_steps(2);
    }
    let dragged = recipe_of(&window);
    assert!(dragged.starts_with("ESCARGOT | place right by right "), "{dragged}");
    window.drop_at(to);
    window.run_steps(3);
    idle(&mut window);
    assert_eq!(recipe_of(&window), dragged);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(
        recipe_of(&window),
        "ESCARGOT | place right by up 10cm",
        "a drag is one step"
    );
    key(&mut window, Modifiers::COMMAND, Key::Y);
    assert_eq!(recipe_of(&window), dragged);

    // A key that is never released does not join the steps.
    window.event(eframe::egui::Event::Key {
        key: Key::R,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(40);
    window.get_by_label("Move: right hand").focus();
    window.run_steps(2);
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    window.run_steps(40);
    let once = recipe_of(&window);
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    window.run_steps(40);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(recipe_of(&window), once);
}

#[test]
fn a_path_is_a_curve_that_is_pulled_by_keys_and_drawn_on_the_stage() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::R);
    let curve = "travel right through 0cm,6cm,0cm then 6cm,8cm,0cm";
    type_into(&mut window, "Recipe", &format!("ESCARGOT | {curve}"));
    idle(&mut window);
    until(&mut window, "the only path", |it| has(it, "Point 1 of the path"));
    press(&mut window, "Card: Sign");
    idle(&mut window);
    assert!(!has(&window, "Point 1 of the path"), "the sign is chosen");
    press(&mut window, "Card: Path");
    idle(&mut window);
    window.run_steps(60);
    window.get_by_label("Point 2 of the path").focus();
    window.run_steps(2);
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    idle(&mut window);
    assert_eq!(
        recipe_of(&window),
        "ESCARGOT | travel right through 0cm,6cm,0cm then 6cm,9cm,0cm"
    );
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(recipe_of(&window), format!("ESCARGOT | {curve}"));
    window.run_steps(60);
    idle(&mut window);

    press(&mut window, "Pause");
    until(&mut window, "the picture", |window| window.state().is_drawn());
    let from = window.get_by_label("Point 1 of the path").rect().center();
    press(&mut window, "Draw on the stage");
    window.drag_at(from);
    window.run_steps(2);
    for step in 1..=24 {
        let angle = step as f32 / 24.0 * std::f32::consts::PI;
        let by = eframe::egui::vec2(60.0 - 60.0 * angle.cos(), -40.0 * angle.sin());
        window.hover_at(from + by);
        window.run_steps(1);
    }
    window.drop_at(from + eframe::egui::vec2(120.0, 0.0));
    window.run_steps(4);
    idle(&mut window);
    let drawn = recipe_of(&window);
    assert!(drawn.starts_with("ESCARGOT | travel right through "), "{drawn}");
    assert!(
        drawn.matches(" then ").count() >= 3,
        "an arc has several points: {drawn}"
    );
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(recipe_of(&window), format!("ESCARGOT | {curve}"), "it is one step");
}

#[test]
fn a_press_near_a_moving_handle_pauses_the_hand_and_grabs_the_handle() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::R);
    type_into(&mut window, "Recipe", "ESCARGOT | place right by up 10cm");
    idle(&mut window);
    press(&mut window, "Card: Place");
    idle(&mut window);
    until(&mut window, "the handle", |window| has(window, "Move: right hand"));
    assert!(has(&window, "Pause"), "what was made plays");
    let at = window.get_by_label("Move: right hand").rect().center();
    let beside = at + eframe::egui::vec2(-18.0, 14.0);
    window.drag_at(beside);
    window.run_steps(2);
    assert!(has(&window, "Play"), "it stands still while it is held");
    window.hover_at(beside + eframe::egui::vec2(-25.0, 25.0));
    window.run_steps(2);
    let dragged = recipe_of(&window);
    assert_ne!(dragged, "ESCARGOT | place right by up 10cm");
    window.drop_at(beside + eframe::egui::vec2(-25.0, 25.0));
    window.run_steps(3);
    assert!(has(&window, "Pause"), "it plays on");
    // A press without a drag only grabs it.
    let at = window.get_by_label("Move: right hand").rect().center();
    window.drag_at(at);
    window.run_steps(2);
    assert!(has(&window, "Play"));
    window.drop_at(at);
    window.run_steps(3);
    assert!(has(&window, "Pause"));
    assert_eq!(recipe_of(&window), dragged);
}

fn recipe_of_stored(window: &Window<'_>) -> String {
    let field = window.get_by_label("The recipe of LIMACE");
    field.value().unwrap_or_default()
}

#[test]
fn history_walks_back_and_forward_and_asks_before_several_steps() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    let path = window.state().shown_corpus_path().expect("open").clone();
    let mut other = Corpus::open_corpus(&path, "B").expect("opened");
    for gloss in ["UN", "DEUX", "TROIS"] {
        other.recombine_recipe("ESCARGOT | reverse", gloss).expect("made");
    }
    until(&mut window, "the made signs", |window| has(window, "TROIS"));
    key(&mut window, Modifiers::COMMAND, Key::H);
    click(&mut window, "UN made: ESCARGOT | reverse");
    assert!(has(&window, "Undo 2 steps?"));
    click(&mut window, "Yes");
    idle(&mut window);
    // The corpus may be read between two steps.
    until(&mut window, "undone", |window| {
        !has(window, "TROIS") && !has(window, "DEUX")
    });
    assert_eq!(recordings(&window).len(), 2, "{:?}", recordings(&window));
    idle(&mut window);
    press(&mut window, "DEUX made: ESCARGOT | reverse");
    idle(&mut window);
    until(&mut window, "done again", |window| has(window, "DEUX"));
    assert_eq!(recordings(&window).len(), 3);
    type_into(&mut window, "Who or what", "deux");
    assert!(!has(&window, "UN made: ESCARGOT | reverse"));
}

#[test]
fn the_inspector_changes_what_it_shows_and_undo_takes_it_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    show(&mut window, "escargot");
    until(&mut window, "what is known", |window| shows(window, "Joints and"));
    type_into(&mut window, "Licence", "!");
    key(&mut window, Modifiers::NONE, Key::Enter);
    idle(&mut window);
    let licence = |window: &Window<'_>| {
        let path = window.state().shown_corpus_path().expect("open");
        let corpus = Corpus::open_corpus(path, "B").expect("opened");
        let overview = corpus.load_corpus_overview(1).expect("read");
        let found = overview.recordings.iter().find(|it| it.row.name == "escargot");
        found.and_then(|it| it.row.licence.clone()).unwrap_or_default()
    };
    assert!(licence(&window).ends_with('!'), "{}", licence(&window));
    key(&mut window, Modifiers::COMMAND, Key::H);
    click(&mut window, "Undo");
    idle(&mut window);
    assert!(!licence(&window).ends_with('!'));
}

#[test]
fn cards_are_switched_moved_and_removed_and_the_text_follows() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::R);
    type_into(&mut window, "Recipe", "ESCARGOT | reverse | repeat 2");
    idle(&mut window);
    press(&mut window, "Switched on: Reverse");
    assert_eq!(recipe_of(&window), "ESCARGOT | repeat 2");
    press(&mut window, "Switched on: Reverse");
    assert_eq!(recipe_of(&window), "ESCARGOT | reverse | repeat 2");
    press(&mut window, "Card: Repeat");
    key(&mut window, Modifiers::ALT, Key::ArrowUp);
    assert_eq!(recipe_of(&window), "ESCARGOT | repeat 2 | reverse");
    press(&mut window, "Remove: Reverse");
    assert_eq!(recipe_of(&window), "ESCARGOT | repeat 2");
    type_into(&mut window, "Recipe", " |");
    assert!(shows(&window, "an operator"), "what is wrong is told");
    assert!(has(&window, "Card: Repeat"), "the cards stay");
}

#[test]
fn a_failed_step_is_reported_on_its_card_only() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::R);
    type_into(&mut window, "Recipe", "ESCARGOT | configure right NOSUCH");
    idle(&mut window);
    // An unfinished name is not an error yet.
    until(&mut window, "what is wrong", |window| shows(window, "NOSUCH"));
    assert!(!has(&window, "Close"), "no notice stands in the way");
    click(&mut window, "Clear");
    type_into(&mut window, "Recipe", "ESCARGOT");
    idle(&mut window);
    click(&mut window, "New signs from ESCARGOT");
    idle(&mut window);
    click(&mut window, "LIMACE");
    assert!(
        recipe_of(&window).contains("configure dominant U"),
        "{}",
        recipe_of(&window)
    );
}

#[test]
fn a_notation_is_written_from_the_board_of_symbols() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open(folder.path());
    key(&mut window, Modifiers::COMMAND, Key::R);
    click(&mut window, "Begin with…");
    click(&mut window, "HamNoSys");
    click(&mut window, "Symbols");
    type_into(&mut window, "Type to find a symbol", "fist");
    key(&mut window, Modifiers::NONE, Key::Enter);
    type_into(&mut window, "Type to find a symbol", "up");
    press(&mut window, "extfingeru: the fingers point up");
    window.get_by_label("Type to find a symbol").click();
    key(&mut window, Modifiers::COMMAND, Key::A);
    type_into(&mut window, "Type to find a symbol", "palml");
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(recipe_of(&window), "hamnosys \"hamfist hamextfingeru hampalml\"");
    click(&mut window, "Take back");
    assert_eq!(recipe_of(&window), "hamnosys \"hamfist hamextfingeru\"");
    press(&mut window, "palml: the palm faces left");
    key(&mut window, Modifiers::NONE, Key::Escape);
    idle(&mut window);
    assert!(shows(&window, "generated in"), "it was generated");
}
