//! Copies of a movement count as that movement, and every way out passes one gate.

use std::fs;

use super::*;
use crate::export::{ExportOptions, ExportWhat};

/// A recipe with the sources whose movement its result shows unchanged.
const COPIES: [(&str, &str, &[&str]); 6] = [
    ("COPY", "BOL", &["bol"]),
    ("SLOWED", "BOL | retime 100%", &["bol"]),
    ("AGAIN", "COPY", &["bol", "COPY"]),
    ("JOINED", "BOL then ESCARGOT", &["bol", "escargot"]),
    ("SHAPED", "BOL | configure right U", &["bol"]),
    ("RAISED", "BOL | place both by up 5cm", &[]),
];

fn copies(folder: &std::path::Path) -> Corpus {
    let mut corpus = corpus(folder);
    for (gloss, recipe, _) in COPIES {
        corpus.recombine_recipe(recipe, gloss).expect("generated");
    }
    let yes = ConsentChange {
        licence: Some("CC0".into()),
        ..all(ConsentAudience::Public)
    };
    corpus.change_consent(&[address("signer:Ada")], &yes).expect("changed");
    corpus
}

fn refuse(corpus: &mut Corpus, of: &str, change: &ConsentChange) {
    corpus.change_consent(&[address(of)], change).expect("changed");
}

/// Returns the recipes of a kind that everybody may see.
fn public(corpus: &Corpus, kind: ConsentKind) -> Vec<&'static str> {
    let connection = corpus.store.read_connection();
    let permissions = PublishPermissions::read_publish_permissions(connection, None).expect("read");
    let may = |gloss: &str| {
        let found = stored_recordings::recording_named(connection, gloss).expect("read");
        permissions
            .recording_publish_terms(found.expect("there").id, kind)
            .is_ok()
    };
    COPIES.iter().map(|copy| copy.0).filter(|gloss| may(gloss)).collect()
}

#[test]
fn a_copy_counts_as_the_movement_that_it_shows() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    assert_eq!(public(&corpus, ConsentKind::Movement).len(), COPIES.len());
    let change = ConsentChange {
        movement: Some(Some(ConsentAudience::Nobody)),
        ..ConsentChange::default()
    };
    refuse(&mut corpus, "recording:bol", &change);
    let free = COPIES.iter().filter(|copy| copy.2.is_empty()).map(|copy| copy.0);
    assert_eq!(public(&corpus, ConsentKind::Movement), free.collect::<Vec<_>>());
    assert_eq!(public(&corpus, ConsentKind::Annotation).len(), COPIES.len());
    corpus.undo_operation().expect("undone");
    let change = ConsentChange {
        annotation: Some(Some(ConsentAudience::Nobody)),
        ..ConsentChange::default()
    };
    refuse(&mut corpus, "recording:bol", &change);
    assert_eq!(
        public(&corpus, ConsentKind::Annotation),
        Vec::<&str>::new(),
        "the values are BOL's"
    );
}

#[test]
fn bytes_that_are_equal_are_one_movement() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    let exported = folder.path().join("taken.bvh");
    let what = ExportWhat::Address(address("recording:bol"));
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .export_corpus(&what, &exported, &ExportOptions::default(), progress)
        .expect("exported");
    corpus
        .import_paths(&[exported], &ImportOptions::default(), progress)
        .expect("imported");
    let yes = ConsentChange {
        licence: Some("CC BY 4.0".into()),
        ..all(ConsentAudience::Public)
    };
    refuse(&mut corpus, "recording:taken", &yes);
    let verdict = |corpus: &Corpus| {
        let connection = corpus.store.read_connection();
        let permissions = PublishPermissions::read_publish_permissions(connection, None).expect("read");
        let found = stored_recordings::recording_named(connection, "taken").expect("read");
        permissions.recording_publish_terms(found.expect("there").id, ConsentKind::Movement)
    };
    assert!(verdict(&corpus).is_ok());
    refuse(&mut corpus, "recording:bol", &all(ConsentAudience::Nobody));
    assert_eq!(verdict(&corpus), Err(WithheldReason::NotPublic));
    // Movement that was generated elsewhere has terms of its own, too.
    let changed = corpus.store.named_operation("origin", |connection| {
        let sql = "UPDATE recording SET origin = 'generated' WHERE name IN ('bol', 'taken')";
        Ok((connection.execute(sql, [])?, String::new()))
    });
    assert_eq!(changed.expect("changed"), 2);
    assert_eq!(verdict(&corpus), Err(WithheldReason::NotPublic));
}

#[test]
fn a_sign_that_comes_back_from_a_file_has_the_consents_of_those_it_was_made_from() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    corpus
        .recombine_recipe("ESCARGOT | mirror", "TURNED")
        .expect("generated");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    // A copy that is unchanged shows the movement that was recorded; the mirrored one only the sign.
    for (sign, name) in [("TURNED", "back"), ("escargot", "taken")] {
        let file = folder.path().join(format!("{name}.bvh"));
        let what = ExportWhat::Address(address(&format!("recording:{sign}")));
        corpus
            .export_corpus(&what, &file, &ExportOptions::default(), progress)
            .expect("exported");
        corpus
            .import_paths(&[file], &ImportOptions::default(), progress)
            .expect("imported");
        let change = RecordingChange {
            signer: Some(Some("Cleo".into())),
            ..RecordingChange::default()
        };
        corpus
            .change_recording(&RowName::Text(name.into()), &change)
            .expect("changed");
    }
    let yes = ConsentChange {
        licence: Some("CC BY 4.0".into()),
        ..all(ConsentAudience::Public)
    };
    refuse(&mut corpus, "signer:Cleo", &yes);
    let terms = |corpus: &Corpus, name: &str| {
        let connection = corpus.store.read_connection();
        let permissions = PublishPermissions::read_publish_permissions(connection, None).expect("read");
        let found = stored_recordings::recording_named(connection, name).expect("read");
        permissions.recording_publish_terms(found.expect("there").id, ConsentKind::Movement)
    };
    assert!(terms(&corpus, "back").is_ok() && terms(&corpus, "taken").is_ok());
    let no_signs = ConsentChange {
        derived: Some(Some(ConsentAudience::Nobody)),
        ..ConsentChange::default()
    };
    refuse(&mut corpus, "signer:Ada", &no_signs);
    assert_eq!(terms(&corpus, "back"), Err(WithheldReason::NotPublic));
    assert!(terms(&corpus, "taken").is_ok(), "Ada lets others see what was recorded");
    // While the copy stays, the signer is not forgotten, and the copy is named.
    let refusal = corpus.forget_signer(&RowName::Text("Ada".into()), true, progress);
    let refusal = refusal.expect_err("needed").to_string();
    assert!(refusal.contains("back"), "{refusal}");
}

#[test]
fn a_longer_recording_and_near_copies_show_the_take_that_is_in_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    let near = [
        ("SLOWER", "BOL | retime 101%"),
        ("LONG", "BOL | retime 250%"),
        ("BACK", "LONG | retime 40%"),
        ("LARGER", "BOL | amplify both 1.02"),
    ];
    for (gloss, recipe) in near {
        corpus.recombine_recipe(recipe, gloss).expect("generated");
    }
    let text = fs::read_to_string(folder.path().join("files").join("bol.bvh")).expect("read");
    let (header, frames) = text.split_once("Frame Time:").expect("frames");
    let (rate, frames) = frames.split_once('\n').expect("frames");
    let count = frames.lines().filter(|line| !line.trim().is_empty()).count();
    let header = header.replace(&format!("Frames: {count}"), &format!("Frames: {}", 2 * count));
    let file = folder.path().join("twice.bvh");
    fs::write(&file, format!("{header}Frame Time:{rate}\n{frames}\n{frames}")).expect("written");
    let options = ImportOptions {
        signer: Some("Elsa".into()),
        ..ImportOptions::default()
    };
    let progress = &mut ProgressReceiver::silent_progress();
    let report = corpus.import_paths(&[file], &options, progress).expect("imported");
    let said: Vec<&String> = report.files[0]
        .findings
        .iter()
        .map(|finding| &finding.message)
        .collect();
    assert!(said.iter().any(|text| text.contains("\"bol\", of Ada")), "{said:?}");
    let yes = ConsentChange {
        licence: Some("CC BY 4.0".into()),
        ..all(ConsentAudience::Public)
    };
    refuse(&mut corpus, "signer:Elsa", &yes);
    let no_movement = ConsentChange {
        movement: Some(Some(ConsentAudience::Nobody)),
        ..ConsentChange::default()
    };
    refuse(&mut corpus, "recording:bol", &no_movement);
    let connection = corpus.store.read_connection();
    let permissions = PublishPermissions::read_publish_permissions(connection, None).expect("read");
    for name in near.map(|(gloss, _)| gloss).into_iter().chain(["twice"]) {
        let found = stored_recordings::recording_named(connection, name).expect("read");
        let terms = permissions.recording_publish_terms(found.expect("there").id, ConsentKind::Movement);
        assert_eq!(terms, Err(WithheldReason::NotPublic), "{name}");
    }
}

#[test]
fn terms_are_those_of_all_contributors_and_are_never_stamped_over_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    let bea = RecordingChange {
        signer: Some(Some("Bea".into())),
        licence: Some(Some("CC BY-SA 4.0".into())),
        ..RecordingChange::default()
    };
    corpus
        .change_recording(&RowName::Text("escargot".into()), &bea)
        .expect("changed");
    let terms = |corpus: &Corpus, name: &str| {
        let connection = corpus.store.read_connection();
        let permissions = PublishPermissions::read_publish_permissions(connection, None).expect("read");
        let found = stored_recordings::recording_named(connection, name).expect("read");
        permissions.recording_terms_text(found.expect("there").id)
    };
    assert_eq!(terms(&corpus, "JOINED"), "CC BY-SA 4.0; CC0");
    refuse(&mut corpus, "signer:Bea", &all(ConsentAudience::Research));
    assert_eq!(terms(&corpus, "JOINED"), "for research only; CC BY-SA 4.0; CC0");
    refuse(&mut corpus, "signer:Bea", &all(ConsentAudience::Nobody));
    assert_eq!(terms(&corpus, "JOINED"), "may not be shared");
    assert_eq!(terms(&corpus, "COPY"), "CC0");
    let all_of = folder.path().join("shared");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let report = corpus
        .export_corpus(&ExportWhat::All, &all_of, &ExportOptions::default(), progress)
        .expect("exported");
    let named = report.notes.iter().find(|note| note.contains("for you alone"));
    assert!(
        named.is_some_and(|note| note.contains("Bea") && !note.contains("Ada")),
        "{:?}",
        report.notes
    );
    let licences = fs::read_to_string(all_of.join("LICENCES.md")).expect("read");
    assert!(
        licences.contains("JOINED | Ada | made | may not be shared"),
        "{licences}"
    );
    let film = folder.path().join("joined.glb");
    let what = ExportWhat::Address(address("recording:JOINED"));
    corpus
        .export_corpus(&what, &film, &ExportOptions::default(), progress)
        .expect("exported");
    let bytes = fs::read(&film).expect("read");
    let says = |text: &str| bytes.windows(text.len()).any(|part| part == text.as_bytes());
    assert!(says(r#""copyright":"may not be shared""#));
}

#[test]
fn an_export_for_others_leaves_out_what_is_withheld_and_lists_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    let bea = RecordingChange {
        name: Some("qzsecretzq".into()),
        signer: Some(Some("Qzbeazq".into())),
        licence: Some(Some("CC0".into())),
        ..RecordingChange::default()
    };
    corpus
        .change_recording(&RowName::Text("escargot".into()), &bea)
        .expect("changed");
    refuse(&mut corpus, "signer:Qzbeazq", &all(ConsentAudience::Research));
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    for (format, ending) in [
        (None, "all"),
        (Some("bvh"), "bvh"),
        (Some("csv"), "csv"),
        (Some("glb"), "glb"),
        (Some("eaf"), "eaf"),
    ] {
        for (audience, shows) in [("public", false), ("research", true), ("me", true)] {
            let to = folder.path().join(format!("{ending}-{audience}"));
            let options = ExportOptions {
                format: format.map(str::to_owned),
                audience: audience.parse().expect("an audience"),
                ..ExportOptions::default()
            };
            let report = corpus
                .export_corpus(&ExportWhat::All, &to, &options, progress)
                .expect("exported");
            let has = |text: &str| {
                report.files.iter().any(|file| {
                    let bytes = fs::read(&file.path).expect("read");
                    let name = file.path.to_string_lossy().into_owned();
                    name.contains(text) || bytes.windows(text.len()).any(|part| part == text.as_bytes())
                })
            };
            assert_eq!(has("qzsecretzq"), shows, "{ending} {audience}");
            assert!(shows || !has("Qzbeazq"), "{ending} {audience}");
            let listed = report
                .withheld
                .iter()
                .any(|one| one.name == "qzsecretzq" && one.who == "Qzbeazq");
            assert_eq!(listed, !shows, "{ending} {audience}: {:?}", report.withheld);
        }
    }
    let alone = ExportWhat::Address(address("recording:qzsecretzq"));
    let options = ExportOptions {
        audience: "public".parse().expect("an audience"),
        ..ExportOptions::default()
    };
    for name in ["one.bvh", "one.glb", "one.eaf", "one.csv"] {
        let to = folder.path().join(name);
        let refused = corpus
            .export_corpus(&alone, &to, &options, progress)
            .expect_err("withheld");
        assert!(refused.to_string().contains("is withheld from public"), "{refused}");
        assert!(!to.exists());
    }
}

#[test]
fn a_copy_of_everything_has_no_history_unless_it_is_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    let bea = SignerChange {
        name: Some("anonymous".into()),
        ..SignerChange::default()
    };
    corpus
        .change_signer(&RowName::Text("Ada".into()), &bea)
        .expect("changed");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    for with_history in [false, true] {
        let to = folder.path().join(format!("copy-{with_history}"));
        let options = ExportOptions {
            with_history,
            ..ExportOptions::default()
        };
        let report = corpus
            .export_corpus(&ExportWhat::All, &to, &options, progress)
            .expect("exported");
        assert_eq!(
            report.notes.iter().any(|note| note.contains("no history")),
            !with_history
        );
        let copy = Corpus::open_corpus(&to.join("corpus.chereme"), "B").expect("opened");
        let operations = copy.operation_log(100).expect("read").len();
        assert_eq!(operations > 0, with_history);
    }
}

#[test]
fn a_sign_that_is_not_stored_names_those_who_did_not_agree_to_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = copies(folder.path());
    let named = |corpus: &mut Corpus, recipe: &str| {
        let before = corpus.load_corpus_overview(1).expect("read");
        let sentence = corpus.recipe_consent_sentence(recipe).expect("judged");
        let after = corpus.load_corpus_overview(1).expect("read");
        assert_eq!(before.recordings.len(), after.recordings.len(), "nothing is stored");
        sentence.is_some_and(|text| text.ends_with(": Ada"))
    };
    for (_, recipe, _) in COPIES {
        assert!(!named(&mut corpus, recipe), "{recipe}");
    }
    assert!(!named(&mut corpus, "no such sign |"), "it shows nobody");
    let change = ConsentChange {
        movement: Some(Some(ConsentAudience::Research)),
        ..ConsentChange::default()
    };
    refuse(&mut corpus, "signer:Ada", &change);
    for (_, recipe, sources) in COPIES {
        assert_eq!(named(&mut corpus, recipe), !sources.is_empty(), "{recipe}");
    }
    let change = ConsentChange {
        derived: Some(None),
        ..ConsentChange::default()
    };
    refuse(&mut corpus, "signer:Ada", &change);
    for (_, recipe, _) in COPIES {
        assert!(named(&mut corpus, recipe), "{recipe}");
    }
}
