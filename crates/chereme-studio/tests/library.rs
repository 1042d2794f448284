//! Signs without recordings, and signs taken from a list into a recipe, by the mouse and by keys.

mod common;

use std::path::Path;

use chereme_corpus::{
    ConsentAudience, Corpus, ImportOptions, PersonContents, ProgressReceiver, TierPropertyChange, TierRequestName,
    ignore_progress_step, unpack_starter,
};
use chereme_studio::{InterfaceLanguage, StudioOptions};
use common::*;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::Queryable;

const SIGML: &str = r#"<sigml>
<hns_sign gloss="HOCHER"><hamnosys_manual>
  <hamfist/><hamthumbacrossmod/><hamextfingero/><hampalmd/><hamnodding/>
</hamnosys_manual></hns_sign>
</sigml>
"#;

/// Opens a corpus with a notated sign and a lexicon of coded signs, without recordings.
fn open_notated<'a>(folder: &Path) -> Window<'a> {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let lexicon = |path: &std::path::PathBuf| path.file_stem().is_some_and(|it| it == "lexicon");
    let mut files: Vec<_> = files.into_iter().filter(lexicon).collect();
    let sigml = folder.join("oui.sigml");
    std::fs::write(&sigml, SIGML).expect("written");
    files.push(sigml);
    let path = folder.join("notated.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    let imported = corpus.import_paths(&files, &ImportOptions::default(), &mut ProgressReceiver::new(&mut hear));
    imported.expect("imported");
    drop(corpus);
    let mut window = window(StudioOptions {
        corpus: Some(path),
        ..options(folder)
    });
    until(&mut window, "the signs", |window| {
        window.query_by_label_contains("Signs (").is_some()
    });
    idle(&mut window);
    window
}

fn says(window: &Window<'_>, part: &str) -> bool {
    window.query_all_by_label_contains(part).next().is_some()
}

#[test]
fn signs_without_recordings_are_listed_animated_and_used_in_a_recipe() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_notated(folder.path());
    assert!(says(&window, "This corpus has no recordings"));
    window.get_by_label("Filter").type_text("hocher");
    window.run_steps(3);
    click(&mut window, "HOCHER");
    until(&mut window, "the animated sign", |window| {
        says(window, "HOCHER is animated from its notation")
    });
    idle(&mut window);
    until(&mut window, "the stage", |window| says(window, "Made: HOCHER"));
    // In a lower pane, that text is in the same line as the buttons, and the list keeps its height.
    let beside = |window: &Window<'_>| {
        let said = window.get_by_label_contains("HOCHER is animated from its notation");
        let button = window.get_by_label("Take it into a recipe");
        said.rect().left() > button.rect().right()
    };
    assert!(!beside(&window));
    window.set_size(eframe::egui::vec2(1280.0, 760.0));
    window.run_steps(4);
    assert!(beside(&window));
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::ALT, Key::R);
    window.run_steps(4);
    idle(&mut window);
    until(&mut window, "the card", |window| says(window, "Store"));
    assert!(!says(&window, "A new sign begins with"));
}

#[test]
fn a_small_window_shows_and_uses_an_opened_notated_sign() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_notated(folder.path());
    window.set_size(eframe::egui::vec2(800.0, 600.0));
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    // A field keeps the keyboard, regardless of the contents below it.
    for word in ["gloss", "=", "HOCHER"] {
        window.event(Event::Text(word.to_owned()));
        window.run_steps(40);
        idle(&mut window);
    }
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(&mut window);
    window.run_steps(2);
    assert!(says(&window, "Found: 1"));
    assert!(!has(&window, "Pause"), "the stage is behind the search");
    window.key_press(Key::ArrowDown);
    window.run_steps(3);
    window.key_press(Key::Enter);
    until(&mut window, "the stage in front", |window| has(window, "Pause"));
    idle(&mut window);
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::ALT, Key::R);
    window.run_steps(4);
    idle(&mut window);
    until(&mut window, "the card", |window| says(window, "Store"));
}

#[test]
fn a_coded_sign_shows_its_possible_actions() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_notated(folder.path());
    window.get_by_label("Filter").type_text("limace");
    window.run_steps(3);
    click(&mut window, "LIMACE");
    window.run_steps(3);
    assert!(says(&window, "LIMACE is coded, but has no movement yet"));
    click(&mut window, "Make it by a recipe");
    window.run_steps(3);
    assert!(!says(&window, "LIMACE is coded"), "the recipe is in front");
}

fn pointer(window: &mut Window<'_>, at: Pos2, pressed: Option<bool>) {
    window.event(Event::PointerMoved(at));
    if let Some(pressed) = pressed {
        window.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        });
    }
    window.step();
}

#[test]
fn a_hit_is_dragged_over_a_tab_to_the_recipe() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    window.key_press_modifiers(Modifiers::COMMAND, Key::F2);
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::F);
    window.run_steps(3);
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(&mut window);
    window.run_steps(2);
    let hit = window.get_by_label_contains("ESCARGOT, escargot").rect();
    let tab = window.get_by_label("Recombine").rect();
    pointer(&mut window, hit.center(), None);
    pointer(&mut window, hit.center(), Some(true));
    for by in 1..6 {
        let at = hit.center().lerp(tab.center(), by as f32 / 5.0);
        pointer(&mut window, at, None);
    }
    for _ in 0..40 {
        pointer(&mut window, tab.center(), None);
    }
    assert!(says(&window, "Begin with"), "the pane came to the front");
    let below = tab.center() + eframe::egui::vec2(0.0, 300.0);
    pointer(&mut window, below, None);
    pointer(&mut window, below, Some(false));
    window.run_steps(3);
    idle(&mut window);
    assert!(
        window.query_all_by_value("ESCARGOT").next().is_some(),
        "the card has the sign"
    );
}

#[test]
fn a_recording_is_deleted_by_key_and_undone_from_its_notice() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    let path = folder.path().join("small.chereme");
    let recordings = || {
        let corpus = Corpus::open_corpus(&path, "B").expect("opened");
        corpus.load_corpus_overview(1).expect("read").recordings.len()
    };
    click(&mut window, "Recordings (1)");
    let row = window.get_by_label("escargot").rect().center();
    pointer(&mut window, row, Some(true));
    pointer(&mut window, row, Some(false));
    window.run_steps(3);
    window.key_press(Key::Delete);
    until(&mut window, "the notice", |window| says(window, "Deleted: escargot"));
    idle(&mut window);
    assert_eq!(recordings(), 0);
    until(&mut window, "the empty list", |window| {
        says(window, "The corpus is empty")
    });
    let undo = window.get_all_by_label("Undo").last().expect("an offer");
    undo.click();
    until(&mut window, "the recording", |window| has(window, "escargot"));
    idle(&mut window);
    assert_eq!(recordings(), 1);
}

#[test]
fn deleting_the_source_of_a_sign_asks_about_that_sign_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let recordings = || -> Vec<String> {
        let corpus = Corpus::open_corpus(&path, "B").expect("opened");
        let all = corpus.load_corpus_overview(1).expect("read").recordings;
        all.into_iter().map(|it| it.row.name).collect()
    };
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    let made = corpus.recombine_recipe("ESCARGOT | configure right U", "LIMACE");
    made.expect("generated");
    drop(corpus);
    let mut window = window(StudioOptions {
        corpus: Some(path.clone()),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    idle(&mut window);
    let ask = |window: &mut Window<'_>| {
        window.get_by_label("escargot").click_secondary();
        window.run_steps(3);
        let entry = window.get_by_label_contains("Delete from the corpus");
        entry.click();
        until(window, "the question", |window| {
            says(window, "Generated signs take movement from escargot")
        });
        assert!(says(window, "• LIMACE"));
    };
    ask(&mut window);
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(!says(&window, "Generated signs take movement"));
    assert_eq!(recordings(), ["escargot", "LIMACE"]);
    ask(&mut window);
    click(&mut window, "Keep them with their own movement");
    until(&mut window, "the notice", |window| says(window, "Deleted: escargot"));
    idle(&mut window);
    assert_eq!(recordings(), ["LIMACE"]);
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    until(&mut window, "the recording", |window| has(window, "escargot"));
    idle(&mut window);
    ask(&mut window);
    click(&mut window, "Delete them as well");
    until(&mut window, "the notice", |window| {
        says(window, "Deleted: LIMACE, escargot")
    });
    idle(&mut window);
    assert!(recordings().is_empty());
}

#[test]
fn an_annotated_sign_is_deleted_with_its_annotations() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = open_small(folder.path());
    click(&mut window, "Signs (1)");
    window.get_by_label("ESCARGOT").click_secondary();
    window.run_steps(3);
    window.get_by_label_contains("Delete from the corpus").click();
    until(&mut window, "the question", |window| {
        says(window, "ESCARGOT is annotated in recordings that stay")
    });
    click(&mut window, "Delete its annotations as well");
    until(&mut window, "the notice", |window| says(window, "Deleted: ESCARGOT"));
    until(&mut window, "the empty list", |window| says(window, "Signs (0)"));
}

#[test]
fn a_list_without_entries_differs_from_a_filter_that_nothing_fits() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = unpack_starter(&folder.path().join("files")).expect("unpacked");
    let bare = |path: &std::path::PathBuf| path.file_name().is_some_and(|it| it == "bol.bvh");
    let files: Vec<_> = files.into_iter().filter(bare).collect();
    let path = folder.path().join("captured.chereme");
    let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
    let mut hear = ignore_progress_step;
    let options_of_import = ImportOptions::default();
    let mut progress = ProgressReceiver::new(&mut hear);
    let imported = corpus.import_paths(&files, &options_of_import, &mut progress);
    imported.expect("imported");
    drop(corpus);
    let of = |language| {
        window(StudioOptions {
            corpus: Some(path.clone()),
            asked_language: Some(language),
            ..options(folder.path())
        })
    };
    let mut window = of(InterfaceLanguage::English);
    until(&mut window, "the recording", |it| has(it, "Signs (0)"));
    click(&mut window, "Signs (0)");
    assert!(says(&window, "There are no signs yet") && !says(&window, "No sign has this name"));
    click(&mut window, "Recordings (1)");
    window.get_by_label("Filter").focus();
    window.run_steps(2);
    window.get_by_label("Filter").type_text("zzz");
    window.run_steps(3);
    assert!(says(&window, "No recording has this name"));
    drop(window);
    let mut french = of(InterfaceLanguage::French);
    until(&mut french, "the recording", |it| has(it, "Signes (0)"));
    french.key_press_modifiers(Modifiers::COMMAND | Modifiers::ALT, Key::K);
    until(&mut french, "why there is no map", |it| {
        says(it, "une carte en demande deux")
    });
}

/// Returns a file of the markers of two people who stand as the signer of a starter capture does.
fn two_people(folder: &Path) -> std::path::PathBuf {
    let labels = [
        "LFHD", "RFHD", "C7", "LSHO", "RSHO", "LELB", "RELB", "LWRA", "RWRA", "LWRB", "RWRB", "LFIN", "RFIN", "LKNE",
        "RKNE", "LANK", "RANK",
    ];
    let path = small_corpus(folder);
    let corpus = Corpus::open_corpus(&path, "A").expect("open");
    let signer = corpus.movement_at_address(&"recording:1".parse().expect("an address"));
    let signer = signer.expect("movement");
    let model = signer.clip.model_pose(0);
    let (mut names, mut axes, mut places) = (String::new(), String::new(), String::new());
    let people = ["Anna", "Bob"]
        .into_iter()
        .flat_map(|it| labels.map(|label| (it, label)));
    for (n, (person, label)) in (1..).zip(people) {
        let known = chereme_motion::fit::find_marker_attachment(label).expect("a known label");
        let part = known.near.or(known.towards.map(|(part, _)| part));
        let joint = signer.anatomy.part_joint(part.unwrap_or(known.on[0])).expect("a joint");
        let at = model.model_joint_position(joint) * 1000.0;
        names += &format!("{person}:{label}\t\t\t");
        axes += &format!("X{n}\tY{n}\tZ{n}\t");
        places += &format!("\t{:.2}\t{:.2}\t{:.2}", at.x, at.y, at.z + 1000.0 * known.thumbwards);
    }
    let mut text = format!(
        "PathFileType\t4\t(X/Y/Z)\tduo.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n\
         100\t100\t10\t{}\tmm\nFrame#\tTime\t{names}\n\t\t{axes}\n\n",
        2 * labels.len()
    );
    for frame in 0..10 {
        text += &format!("{}\t{:.2}{places}\n", frame + 1, f64::from(frame) / 100.0);
    }
    let file = folder.join("duo.trc");
    std::fs::write(&file, text).expect("written");
    file
}

#[test]
fn a_body_is_fitted_to_the_markers_of_the_person_who_is_chosen() {
    for (language, menu, entry, title, done) in [
        (
            InterfaceLanguage::English,
            None,
            "Fit a body to the markers…",
            "Whose markers?",
            "A body is fitted to",
        ),
        (
            InterfaceLanguage::French,
            Some("Édition"),
            "Ajuster un corps aux marqueurs…",
            "Les marqueurs de qui ?",
            "Un corps est ajusté à",
        ),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let file = two_people(folder.path());
        let path = folder.path().join("c.chereme");
        let mut corpus = Corpus::create_corpus(&path, "A").expect("made");
        let mut hear = ignore_progress_step;
        corpus
            .import_paths(
                &[file],
                &ImportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("imported");
        drop(corpus);
        let mut window = window(StudioOptions {
            corpus: Some(path.clone()),
            language,
            ..options(folder.path())
        });
        until(&mut window, "the recording", |window| says(window, "duo"));
        idle(&mut window);
        // From the entry of the list, or from the menu for the recording on display.
        match menu {
            None => window.get_by_label("duo").click_secondary(),
            Some(menu) => click(&mut window, menu),
        }
        window.run_steps(4);
        window.get_by_label_contains(entry).click();
        window.run_steps(2);
        until(&mut window, "the question", |window| says(window, title));
        assert!(has(&window, "Anna") && has(&window, "Bob"));
        click(&mut window, "Bob");
        until(&mut window, "the notice", |window| says(window, done));
        idle(&mut window);
        assert!(!says(&window, title), "the question is answered");
        let corpus = Corpus::open_corpus(&path, "A").expect("open");
        let take = chereme_corpus::RowName::Number(1);
        let tracks = corpus.recording_tracks(&take).expect("tracks");
        assert!(tracks.iter().any(|it| it.name == "body"), "{language:?}");
        let summary = &corpus.operation_log(1).expect("read")[0].summary;
        assert!(summary.contains("of Bob, "), "{summary}");
    }
}

#[test]
fn people_who_only_annotate_are_listed_changed_and_united() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = small_corpus(folder.path());
    let mut corpus = Corpus::open_corpus(&path, "A").expect("opened");
    for (tier, name) in [(1, "Anno"), (2, "A. Nno")] {
        let annotator = Some(Some(name.to_owned()));
        let change = TierPropertyChange {
            annotator,
            ..TierPropertyChange::default()
        };
        let changed = corpus.change_tier_properties(&TierRequestName::Number(tier), &change);
        changed.expect("changed");
    }
    drop(corpus);
    let mut window = window(StudioOptions {
        corpus: Some(path.clone()),
        ..options(folder.path())
    });
    until(&mut window, "the corpus", |window| has(window, "escargot"));
    let people = || -> Vec<PersonContents> {
        let corpus = Corpus::open_corpus(&path, "B").expect("opened");
        corpus.list_people().expect("people")
    };
    let count = people().len();
    click(&mut window, &format!("People ({count})"));
    window.run_steps(3);
    window.get_by_label("Filter").focus();
    window.run_steps(2);
    window.get_by_label("Filter").type_text("annotator · tiers: 1");
    window.run_steps(3);
    assert!(has(&window, "A. Nno") && has(&window, "Anno"));
    click(&mut window, "A. Nno");
    until(&mut window, "the person", |window| has(window, "Same person as"));
    window.get_by_label("Attributes").focus();
    window.run_steps(2);
    window.get_by_label("Attributes").type_text("region=north");
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(&mut window);
    let of = |name: &str| people().into_iter().find(|person| person.name == name);
    assert_eq!(of("A. Nno").expect("there").attributes[0].text, "north");
    let overview = || {
        let corpus = Corpus::open_corpus(&path, "B").expect("opened");
        corpus.load_corpus_overview(1).expect("read")
    };
    click(&mut window, "Their values count first");
    idle(&mut window);
    assert_eq!(overview().preferred_annotator.as_deref(), Some("A. Nno"));
    click(&mut window, "Movement seen by: not known");
    click(&mut window, "research");
    idle(&mut window);
    let consent = || {
        let corpus = Corpus::open_corpus(&path, "B").expect("opened");
        let rows = corpus.list_consents().expect("read");
        rows.into_iter().find(|row| row.name == "A. Nno").map(|row| row.consent)
    };
    let agreed = consent().expect("stated");
    assert_eq!(
        (agreed.movement, agreed.derived),
        (Some(ConsentAudience::Research), None)
    );
    until(&mut window, "the consent", |window| {
        has(window, "Movement seen by: research")
    });
    for _ in 0..2 {
        window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        window.run_steps(2);
        idle(&mut window);
    }
    assert!(consent().is_none() && overview().preferred_annotator.is_none());
    until(&mut window, "the person", |window| has(window, "Same person as"));
    window.get_by_label("Same person as").focus();
    window.run_steps(2);
    window.get_by_label("Same person as").type_text("Anno");
    window.key_press(Key::Enter);
    window.run_steps(2);
    idle(&mut window);
    assert_eq!(people().len(), count - 1);
    until(&mut window, "the selection", |window| !has(window, "Same person as"));
    assert!(!contains(&window, "there is no signer"));
    let anno = of("Anno").expect("one person");
    assert_eq!((anno.annotator_tiers, anno.aliases), (2, vec!["A. Nno".to_owned()]));
}
