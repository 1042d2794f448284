//! Proposals from movement: requested, visited in turn, accepted with Enter, and undone.

mod common;

use std::path::{Path, PathBuf};

use chereme_corpus::{
    AnnotatedHands, AnnotationAction, Corpus, ImportOptions, ListFilter, ListKind, NewTier, ProgressReceiver, RowName,
    TableMoment, TierRequestName, TierRole, ignore_progress_step, requests, starter_files,
};
use chereme_motion::RecordingInstant;
use chereme_sign::HandRef;
use chereme_studio::StudioOptions;
use common::*;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;

/// Returns a corpus with one recording in which only the gloss is annotated.
fn uncoded(folder: &Path) -> PathBuf {
    let film = folder.join("bol.bvh");
    let (_, bytes) = starter_files()
        .find(|(name, _)| *name == Path::new("bol.bvh"))
        .expect("in the starter corpus");
    std::fs::write(&film, bytes).expect("written");
    let path = folder.join("uncoded.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&[film], &ImportOptions::default(), &mut progress)
        .expect("imported");
    let gloss = NewTier::new(RowName::Text("bol".into()), "gloss", TierRole::Gloss);
    let tier = corpus.add_tier(&gloss).expect("a tier");
    let time = |micros| Some(TableMoment::Time(RecordingInstant::from_micros(micros)));
    let add = AnnotationAction::Add {
        tier: TierRequestName::Number(tier.id),
        start: time(0),
        end: time(1_000_000),
        parent: None,
        order: None,
        value: "BOL".into(),
        confidence: None,
    };
    corpus
        .annotate_corpus(&[add.into()], &Default::default(), &mut progress)
        .expect("annotated");
    path
}

/// Returns how many annotations each tier has, by its name.
fn tiers(window: &Window<'_>) -> Vec<(String, u64)> {
    let path = window.state().shown_corpus_path().expect("open");
    let corpus = Corpus::open_corpus(path, "B").expect("opened");
    let listing = corpus.list_rows(ListKind::Tiers, &ListFilter::default());
    let rows = listing.expect("listed").rows;
    rows.iter()
        .map(|row| {
            let name = row["name"].as_str().unwrap_or_default().to_owned();
            (name, row["annotations"].as_u64().unwrap_or_default())
        })
        .collect()
}

fn count(window: &Window<'_>, wanted: impl Fn(&str) -> bool) -> u64 {
    let all = tiers(window);
    all.iter().filter(|it| wanted(&it.0)).map(|it| it.1).sum()
}

/// Presses a key, and waits for what it does.
fn press(window: &mut Window<'_>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(4);
    idle(window);
    window.run_steps(4);
}

#[test]
fn values_are_proposed_for_a_recording_reviewed_and_accepted() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(StudioOptions {
        corpus: Some(uncoded(folder.path())),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "bol"));
    idle(&mut window);
    press(&mut window, Modifiers::COMMAND | Modifiers::ALT, Key::P);
    until(&mut window, "the proposals", |window| {
        let mut named = window.query_all_by_label_contains("(proposed)");
        named.next().is_some()
    });
    let proposed = |name: &str| name.ends_with("(proposed)");
    let all = count(&window, proposed);
    assert!(all >= 3, "{:?}", tiers(&window));
    assert_eq!(
        count(&window, |name| name.starts_with("configuration ") && !proposed(name)),
        0
    );

    press(&mut window, Modifiers::ALT, Key::N);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(count(&window, proposed), all - 1, "{:?}", tiers(&window));
    let accepted = |name: &str| !proposed(name) && name != "gloss";
    assert_eq!(count(&window, accepted), 1, "{:?}", tiers(&window));
    // The next proposal is selected then.
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(count(&window, proposed), all - 2, "{:?}", tiers(&window));
    assert_eq!(count(&window, accepted), 2);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(count(&window, proposed), all);
    assert_eq!(count(&window, accepted), 0);
    // F2 types another value, and accepts nothing.
    press(&mut window, Modifiers::ALT, Key::N);
    press(&mut window, Modifiers::NONE, Key::F2);
    let mut fields = window.query_all_by_label_contains("Value on");
    assert!(fields.next().is_some(), "the field is open");
    drop(fields);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(count(&window, proposed), all);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(count(&window, proposed), 0, "all of them were one step");
}

#[test]
fn enter_after_the_last_proposal_makes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(StudioOptions {
        corpus: Some(uncoded(folder.path())),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "bol"));
    idle(&mut window);
    press(&mut window, Modifiers::COMMAND | Modifiers::ALT, Key::P);
    let proposed = |name: &str| name.ends_with("(proposed)");
    until(&mut window, "the proposals", |window| count(window, proposed) > 0);
    idle(&mut window);
    window.run_steps(4);
    let in_sight = window
        .query_all_by_label_contains("(proposed)")
        .any(|it| it.rect().bottom() < 1010.0);
    assert!(in_sight, "they are scrolled to");
    press(&mut window, Modifiers::ALT, Key::N);
    let all = count(&window, proposed);
    // Typed at once, each Enter waits for the one before it.
    for _ in 0..all + 3 {
        window.key_press(Key::Enter);
    }
    window.run_steps(2);
    idle(&mut window);
    window.run_steps(4);
    assert_eq!(count(&window, proposed), 0, "{:?}", tiers(&window));
    assert_eq!(count(&window, |name| name != "gloss"), all);
    let text = "All proposals of this recording are accepted.";
    assert!(window.query_all_by_label_contains(text).next().is_some());
    // A tier of proposals takes no annotation of a person.
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::ArrowRight);
    for (modifiers, key) in [
        (Modifiers::COMMAND | Modifiers::ALT, Key::N),
        (Modifiers::SHIFT, Key::Enter),
        (Modifiers::SHIFT, Key::Enter),
        (Modifiers::NONE, Key::Enter),
        (Modifiers::NONE, Key::Num1),
    ] {
        press(&mut window, modifiers, key);
        let mut fields = window.query_all_by_label_contains("Value on");
        assert!(fields.next().is_none(), "{key:?}");
    }
    assert_eq!(count(&window, proposed), 0, "{:?}", tiers(&window));
}

#[test]
fn a_detector_is_chosen_from_the_list_and_its_proposals_are_one_step() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(StudioOptions {
        corpus: Some(uncoded(folder.path())),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "bol"));
    idle(&mut window);
    let all = Modifiers::COMMAND | Modifiers::SHIFT | Modifiers::ALT;
    window.key_press_modifiers(all, Key::P);
    window.run_steps(4);
    let strokes = window.get_by_label_contains("signs: signs, and the preparation");
    strokes.click();
    window.run_steps(4);
    idle(&mut window);
    let strokes = |name: &str| name == "movement.phase right (proposed)";
    until(&mut window, "the strokes", |window| count(window, strokes) > 0);
    until(&mut window, "the notice", |window| {
        let text = "Proposals on separate tiers, hatched:";
        window.query_all_by_label_contains(text).next().is_some()
    });
    let undo = (Modifiers::COMMAND, Key::Z);
    window.key_press_modifiers(undo.0, undo.1);
    window.run_steps(4);
    idle(&mut window);
    assert_eq!(count(&window, strokes), 0, "{:?}", tiers(&window));
}

#[test]
fn accepting_ends_at_proposals_whose_places_are_taken() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = uncoded(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let role = "movement.phase".parse().expect("a role");
    let mut phase = NewTier::new(RowName::Text("bol".into()), "Phase RH", role);
    phase.hand = Some(AnnotatedHands::One(HandRef::Right));
    let tier = corpus.add_tier(&phase).expect("a tier").id;
    let end = corpus.load_corpus_overview(1).expect("read").recordings[0]
        .row
        .duration_us;
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let whole = [requests::add_annotation_change(tier, 0, end, "stroke")];
    let added = corpus.annotate_corpus(&whole, &Default::default(), &mut progress);
    added.expect("annotated");
    let mut window = window(StudioOptions {
        corpus: Some(path),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "bol"));
    idle(&mut window);
    let all = Modifiers::COMMAND | Modifiers::SHIFT | Modifiers::ALT;
    press(&mut window, all, Key::P);
    let strokes = window.get_by_label_contains("signs: signs, and the preparation");
    strokes.click();
    let proposed = |name: &str| name.ends_with("(proposed)");
    until(&mut window, "the strokes", |window| count(window, proposed) > 0);
    idle(&mut window);
    let strokes = count(&window, proposed);
    let right = |name: &str| name == "movement.phase right (proposed)";
    let stuck = count(&window, right);
    assert!(stuck > 0, "{:?}", tiers(&window));
    press(&mut window, Modifiers::ALT, Key::N);
    for _ in 0..strokes + 3 {
        press(&mut window, Modifiers::NONE, Key::Enter);
        assert!(!contains(&window, "overlaps"), "{:?}", tiers(&window));
    }
    assert_eq!(count(&window, proposed), stuck, "{:?}", tiers(&window));
    assert_eq!(count(&window, |name| name == "Phase RH"), 1);
    let left = format!("Proposals that are left: {stuck}, the first at ");
    assert!(contains(&window, &left));
    assert!(contains(&window, "no room on: Phase RH"));
    // Without that annotation they are accepted.
    click(&mut window, "Tier Phase RH");
    press(&mut window, Modifiers::ALT, Key::Home);
    press(&mut window, Modifiers::NONE, Key::Delete);
    press(&mut window, Modifiers::ALT, Key::N);
    for _ in 0..=stuck {
        press(&mut window, Modifiers::NONE, Key::Enter);
    }
    assert_eq!(count(&window, proposed), 0, "{:?}", tiers(&window));
    assert_eq!(count(&window, |name| name == "Phase RH"), stuck);
    assert!(contains(&window, "All proposals of this recording"));
}

#[test]
fn nothing_is_pasted_or_duplicated_onto_tiers_of_proposals() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(StudioOptions {
        corpus: Some(uncoded(folder.path())),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "bol"));
    idle(&mut window);
    press(&mut window, Modifiers::COMMAND | Modifiers::ALT, Key::P);
    let proposed = |name: &str| name.ends_with("(proposed)");
    until(&mut window, "the proposals", |window| count(window, proposed) > 0);
    idle(&mut window);
    let before = tiers(&window);
    let refused = |window: &mut Window<'_>, what: &str| {
        idle(window);
        window.run_steps(3);
        assert!(contains(window, "A tier of proposals takes no annotations"), "{what}");
        assert_eq!(tiers(window), before, "{what}");
        // The next one must say it again.
        window.event(Event::Copy);
        window.run_steps(3);
        assert!(!contains(window, "A tier of proposals takes"), "{what}");
    };
    press(&mut window, Modifiers::ALT, Key::N);
    let later = "configuration dominant (proposed)\t1.2\t1.3\tB\n";
    for (text, modifiers) in [
        (later, Modifiers::COMMAND),
        (
            "X\t0.1\t0.2\tB\nconfiguration dominant (proposed)\t1.2\t1.3\tB",
            Modifiers::COMMAND,
        ),
        ("1.2\t1.3\tB", Modifiers::COMMAND),
        ("B", Modifiers::COMMAND),
    ] {
        window.event_modifiers(Event::Paste(text.into()), modifiers);
        refused(&mut window, text);
    }
    press(&mut window, Modifiers::COMMAND, Key::D);
    refused(&mut window, "a proposal is duplicated");
    // From the gloss to the proposal below it.
    click(&mut window, "Tier gloss");
    press(&mut window, Modifiers::ALT, Key::Home);
    press(&mut window, Modifiers::ALT, Key::ArrowDown);
    press(&mut window, Modifiers::COMMAND, Key::D);
    refused(&mut window, "the proposal below a gloss is duplicated");
}
