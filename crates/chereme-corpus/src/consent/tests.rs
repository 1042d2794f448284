mod anything;
mod bodies;
mod outputs;

use std::collections::BTreeSet;
use std::path::PathBuf;

use proptest::prelude::*;

use super::consent_gate::{forbids_derivatives, state_audience};
use super::*;
use crate::{
    ImportOptions, ProgressReceiver, RecordOrigin, RecordingChange, RowName, SignerChange, ignore_progress_step,
    unpack_starter,
};

/// Returns a corpus with BOL and ESCARGOT, as recorded from Ada, and LIMACE, which is generated from the latter.
pub(crate) fn corpus(folder: &std::path::Path) -> Corpus {
    let files = unpack_starter(&folder.join("files")).expect("unpacked");
    let wanted = ["escargot", "bol", "lexicon"];
    let named = |path: &PathBuf| {
        let stem = path.file_stem();
        stem.is_some_and(|it| wanted.iter().any(|w| it == *w))
    };
    let files: Vec<PathBuf> = files.into_iter().filter(named).collect();
    let mut corpus = Corpus::create_corpus(&folder.join("a.chereme"), "A").expect("created");
    let options = ImportOptions::default();
    corpus
        .import_paths(&files, &options, &mut ProgressReceiver::new(&mut ignore_progress_step))
        .expect("imported");
    for name in ["escargot", "bol"] {
        let change = RecordingChange {
            origin: Some(RecordOrigin::Captured),
            licence: Some(None),
            ..RecordingChange::default()
        };
        let recording = RowName::Text(name.into());
        corpus.change_recording(&recording, &change).expect("changed");
    }
    let signers = corpus.list_consents().expect("read");
    let ada = SignerChange {
        name: Some("Ada".into()),
        ..SignerChange::default()
    };
    corpus
        .change_signer(&RowName::Number(signers[0].id), &ada)
        .expect("changed");
    corpus
        .recombine_recipe("ESCARGOT | configure right U", "LIMACE")
        .expect("generated");
    corpus
}

fn address(text: &str) -> CorpusAddress {
    text.parse().expect("an address")
}

fn all(audience: ConsentAudience) -> ConsentChange {
    let said = Some(Some(audience));
    ConsentChange {
        movement: said,
        annotation: said,
        derived: said,
        ..ConsentChange::default()
    }
}

/// Returns for ESCARGOT and LIMACE whether the movement may be published.
fn verdicts(corpus: &Corpus) -> [std::result::Result<BTreeSet<String>, WithheldReason>; 2] {
    let connection = corpus.store.read_connection();
    let known = PublishPermissions::read_publish_permissions(connection, None).expect("read");
    ["escargot", "LIMACE"].map(|name| {
        let found = stored_recordings::recording_named(connection, name).expect("read");
        known.recording_publish_terms(found.expect("a recording").id, ConsentKind::Movement)
    })
}

#[test]
fn unknown_is_not_public_and_a_withdrawal_reaches_what_was_generated() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let ada = [address("signer:Ada")];
    let unknown = Err(WithheldReason::ConsentUnknown);
    assert_eq!(verdicts(&corpus), [unknown.clone(), unknown]);
    corpus
        .change_consent(&ada, &all(ConsentAudience::Public))
        .expect("changed");
    let no_terms = Err(WithheldReason::NoTerms);
    assert_eq!(verdicts(&corpus), [no_terms.clone(), no_terms]);
    let licence = ConsentChange {
        licence: Some("CC BY 4.0".into()),
        ..ConsentChange::default()
    };
    corpus
        .change_consent(&[address("recording:escargot")], &licence)
        .expect("changed");
    let terms = Ok(BTreeSet::from(["CC BY 4.0".to_owned()]));
    assert_eq!(verdicts(&corpus), [terms.clone(), terms.clone()]);
    // Each of these takes something back; undo gives it again.
    let derived = ConsentChange {
        derived: Some(Some(ConsentAudience::Research)),
        ..ConsentChange::default()
    };
    corpus.change_consent(&ada, &derived).expect("changed");
    assert_eq!(verdicts(&corpus), [terms.clone(), Err(WithheldReason::NotPublic)]);
    corpus.undo_operation().expect("undone");
    let one = [address("recording:escargot")];
    corpus
        .change_consent(&one, &all(ConsentAudience::Nobody))
        .expect("changed");
    let refused = Err(WithheldReason::NotPublic);
    assert_eq!(verdicts(&corpus), [refused.clone(), refused]);
    corpus.undo_operation().expect("undone");
    assert_eq!(verdicts(&corpus), [terms.clone(), terms]);
}

#[test]
fn terms_that_forbid_changes_hold_back_what_was_generated() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let change = ConsentChange {
        licence: Some("CC BY-NC-ND 4.0".into()),
        ..all(ConsentAudience::Public)
    };
    corpus
        .change_consent(&[address("signer:Ada")], &change)
        .expect("changed");
    let [own, generated] = verdicts(&corpus);
    assert!(own.is_ok());
    assert_eq!(generated, Err(WithheldReason::NoDerivatives));
    for (text, forbids) in [
        ("CC BY-ND 4.0", true),
        ("Attribution-NoDerivatives", true),
        ("No derivative works", true),
        ("CC BY-SA 4.0", false),
        ("Indiana", false),
    ] {
        assert_eq!(forbids_derivatives(text), forbids, "{text}");
    }
}

#[test]
fn the_source_of_a_generated_sign_that_is_gone_holds_it_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let change = ConsentChange {
        licence: Some("CC0".into()),
        ..all(ConsentAudience::Public)
    };
    corpus
        .change_consent(&[address("signer:Ada")], &change)
        .expect("changed");
    let options = crate::DeleteOptions {
        dependents: crate::DependentsPolicy::Keep,
        dry_run: false,
    };
    corpus
        .delete_objects(
            &[address("recording:escargot")],
            options,
            &mut ProgressReceiver::new(&mut ignore_progress_step),
        )
        .expect("deleted");
    let connection = corpus.store.read_connection();
    let known = PublishPermissions::read_publish_permissions(connection, Some("CC0")).expect("read");
    let found = stored_recordings::recording_named(connection, "LIMACE").expect("read");
    let verdict = known.recording_publish_terms(found.expect("there").id, ConsentKind::Movement);
    assert_eq!(verdict, Err(WithheldReason::InputGone));
}

/// Returns two copies of a corpus whose signer agreed to everything, and the path of the second.
fn copies(folder: &std::path::Path) -> (Corpus, Corpus, PathBuf) {
    let mut mine = corpus(folder);
    let change = ConsentChange {
        licence: Some("CC0".into()),
        ..all(ConsentAudience::Public)
    };
    mine.change_consent(&[address("signer:Ada")], &change).expect("changed");
    let path = folder.join("b.chereme");
    drop(mine);
    std::fs::copy(folder.join("a.chereme"), &path).expect("copied");
    let open = |path: &std::path::Path| Corpus::open_corpus(path, "A").expect("opened");
    (open(&folder.join("a.chereme")), open(&path), path)
}

fn say(corpus: &mut Corpus, of: &str, change: &ConsentChange) {
    corpus.change_consent(&[address(of)], change).expect("changed");
}

fn merge(corpus: &mut Corpus, other: &std::path::Path) -> usize {
    let report = corpus.merge_corpus(other, None, &mut ProgressReceiver::new(&mut ignore_progress_step));
    report.expect("merged").conflicts.len()
}

#[test]
fn the_stricter_of_two_copies_holds_until_somebody_decides() {
    let terms = Ok(BTreeSet::from(["CC0".to_owned()]));
    let undecided = Err(WithheldReason::Undecided);
    let form = ConsentChange {
        form: Some(Some("second form".into())),
        ..ConsentChange::default()
    };
    for (of, decision) in [
        ("signer:Ada", crate::ConflictDecision::Mine),
        ("signer:Ada", crate::ConflictDecision::Theirs),
        ("recording:escargot", crate::ConflictDecision::Theirs),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let (mut mine, mut theirs, path) = copies(folder.path());
        say(&mut mine, of, &form);
        say(&mut theirs, of, &all(ConsentAudience::Nobody));
        assert_eq!(merge(&mut mine, &path), 1);
        let conflicts = mine.merge_conflicts(false).expect("read");
        let refusal = conflicts[0].theirs.as_ref().map(|it| it.text.as_str());
        assert!(refusal.is_some_and(|it| it.contains("movement nobody, ")));
        assert_eq!(verdicts(&mine), [undecided.clone(), undecided.clone()], "{of}");
        mine.decide_conflicts(&[1], decision).expect("decided");
        let wanted = match decision {
            crate::ConflictDecision::Mine => terms.clone(),
            _ => Err(WithheldReason::NotPublic),
        };
        assert_eq!(verdicts(&mine), [wanted.clone(), wanted], "{of}");
    }
    // A difference that refuses nothing holds nothing back.
    let folder = tempfile::tempdir().expect("a folder");
    let (mut mine, mut theirs, path) = copies(folder.path());
    say(&mut mine, "signer:Ada", &form);
    let day = ConsentChange {
        day: Some(Some("2026-11-27".into())),
        ..ConsentChange::default()
    };
    say(&mut theirs, "signer:Ada", &day);
    assert_eq!(merge(&mut mine, &path), 1);
    assert_eq!(verdicts(&mine), [terms.clone(), terms]);
}

/// Returns two copies that both gave ESCARGOT to a new signer, and the path of the second.
fn copies_with_bea(folder: &std::path::Path) -> (Corpus, Corpus, PathBuf) {
    let (mut mine, mut theirs, path) = copies(folder);
    for corpus in [&mut mine, &mut theirs] {
        let change = RecordingChange {
            signer: Some(Some("Bea".into())),
            ..RecordingChange::default()
        };
        let name = RowName::Text("escargot".into());
        corpus.change_recording(&name, &change).expect("changed");
    }
    (mine, theirs, path)
}

#[test]
fn a_refusal_of_a_signer_whom_both_copies_created_counts() {
    let undecided = Err(WithheldReason::Undecided);
    let refused = Err(WithheldReason::NotPublic);
    let folder = tempfile::tempdir().expect("a folder");
    let (mut mine, mut theirs, path) = copies_with_bea(folder.path());
    say(&mut mine, "signer:Bea", &all(ConsentAudience::Public));
    say(&mut theirs, "signer:Bea", &all(ConsentAudience::Nobody));
    assert!(merge(&mut mine, &path) > 0);
    assert_eq!(verdicts(&mine), [undecided.clone(), undecided]);
    // Also if she refused only after a merge: here she has another uid.
    let folder = tempfile::tempdir().expect("a folder");
    let (mut mine, mut theirs, path) = copies_with_bea(folder.path());
    say(&mut mine, "signer:Bea", &all(ConsentAudience::Public));
    let public = verdicts(&mine);
    assert!(public.iter().all(std::result::Result::is_ok), "{public:?}");
    merge(&mut mine, &path);
    assert_eq!(verdicts(&mine), public, "nobody asked her there");
    say(&mut theirs, "signer:Bea", &all(ConsentAudience::Nobody));
    merge(&mut mine, &path);
    let found = verdicts(&mine);
    assert!(found.iter().all(std::result::Result::is_err), "{found:?}");
    // And if only the other copy knows what she agreed to.
    let folder = tempfile::tempdir().expect("a folder");
    let (mut mine, mut theirs, path) = copies_with_bea(folder.path());
    say(&mut mine, "recording:escargot", &all(ConsentAudience::Public));
    say(&mut theirs, "signer:Bea", &all(ConsentAudience::Nobody));
    merge(&mut mine, &path);
    assert_eq!(verdicts(&mine), [refused.clone(), refused]);
}

#[test]
fn what_a_generated_sign_itself_refuses_counts_and_unknown_sources_hold_it_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut mine, _, _) = copies(folder.path());
    let movement = ConsentChange {
        movement: Some(Some(ConsentAudience::Research)),
        ..ConsentChange::default()
    };
    say(&mut mine, "recording:LIMACE", &movement);
    assert_eq!(verdicts(&mine)[1], Err(WithheldReason::NotPublic));
    mine.undo_operation().expect("undone");
    assert!(verdicts(&mine)[1].is_ok());
    let change = RecordingChange {
        origin: Some(RecordOrigin::Made),
        signer: Some(None),
        ..RecordingChange::default()
    };
    let name = RowName::Text("escargot".into());
    mine.change_recording(&name, &change).expect("changed");
    assert_eq!(verdicts(&mine)[0], Err(WithheldReason::InputGone));
}

#[test]
fn a_participant_in_other_letters_is_the_same_person() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut mine = corpus(folder.path());
    let change = ConsentChange {
        licence: Some("CC0".into()),
        ..all(ConsentAudience::Public)
    };
    say(&mut mine, "recording:escargot", &change);
    assert!(verdicts(&mine)[0].is_ok());
    let alone = RecordingChange {
        signer: Some(None),
        ..RecordingChange::default()
    };
    let name = RowName::Text("escargot".into());
    mine.change_recording(&name, &alone).expect("changed");
    say(&mut mine, "signer:Ada", &all(ConsentAudience::Nobody));
    let sql = "UPDATE tier SET participant = 'ADA ' WHERE recording_id =
               (SELECT id FROM recording WHERE name = 'escargot')";
    let store = mine.store.named_operation("test", |connection| {
        connection.execute(sql, [])?;
        Ok(((), String::new()))
    });
    store.expect("changed");
    assert_eq!(verdicts(&mine)[0], Err(WithheldReason::NotPublic));
    // Whoever refused is named, and not the signer, who agreed.
    let cleo = RecordingChange {
        signer: Some(Some("Cleo".into())),
        ..RecordingChange::default()
    };
    mine.change_recording(&name, &cleo).expect("changed");
    say(&mut mine, "signer:Cleo", &all(ConsentAudience::Public));
    let connection = mine.store.read_connection();
    let gate = OutputGate::open_output_gate(connection, OutputAudience::Public).expect("open");
    let recording = crate::db::stored_recordings::recording_named(connection, "escargot").expect("read");
    let withheld = gate.withheld_output(recording.expect("there").id, &[ConsentKind::Movement]);
    assert_eq!(withheld.expect("withheld").who, "Ada");
}

#[test]
fn days_are_days() {
    for (text, fits) in [
        ("2026-11-27", true),
        ("2026-13-01", false),
        ("2026-1-1", false),
        ("today", false),
        ("+026-11-27", false),
    ] {
        assert_eq!(is_day(text), fits, "{text}");
    }
}

pub(crate) fn any_audience() -> impl Strategy<Value = Option<ConsentAudience>> {
    prop::option::of(prop::sample::select(ConsentAudience::ALL_AUDIENCES.to_vec()))
}

proptest! {
    /// Public is only what everybody involved made public, or what the recording's own consent covers for people of
    /// whom nothing is known.
    #[test]
    fn the_narrowest_consent_holds(own in any_audience(), people in prop::collection::vec(any_audience(), 0..4)) {
        let consent = |movement: Option<ConsentAudience>| PersonConsent { movement, ..PersonConsent::default() };
        let each: Vec<PersonConsent> = people.iter().map(|it| consent(*it)).collect();
        let each: Vec<Option<&PersonConsent>> = each.iter().map(Some).collect();
        let stated = state_audience(Some(&consent(own)), &each, true, ConsentKind::Movement);
        let found = stated.least.filter(|least| !stated.is_incomplete || *least < ConsentAudience::Public);
        let said: Vec<ConsentAudience> = people.iter().copied().flatten().chain(own).collect();
        if found == Some(ConsentAudience::Public) {
            prop_assert!(said.iter().all(|it| *it == ConsentAudience::Public));
            prop_assert!(own.is_some() || (!people.is_empty() && people.iter().all(Option::is_some)));
        }
        if said.iter().any(|it| *it < ConsentAudience::Public) {
            prop_assert_eq!(found, said.iter().copied().min());
        }
    }
}

#[test]
fn a_piece_of_a_withheld_take_is_withheld_under_another_signer_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    // Later than the first frame, so that its frames and blocks are others than those of the take.
    let piece = folder.path().join("piece.bvh");
    let what = crate::ExportWhat::Address(address("sign:BOL"));
    let mut hear = ignore_progress_step;
    corpus
        .export_corpus(
            &what,
            &piece,
            &crate::ExportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("exported");
    let options = ImportOptions {
        signer: Some("Cem".into()),
        origin: Some(RecordOrigin::Captured),
        licence: Some("CC0".into()),
        ..ImportOptions::default()
    };
    let mut hear = ignore_progress_step;
    let report = corpus
        .import_paths(&[piece], &options, &mut ProgressReceiver::new(&mut hear))
        .expect("imported");
    let findings = &report.files[0].findings;
    let known = "its movement is that of the recording \"bol\" from ";
    assert!(
        findings
            .iter()
            .any(|it| it.message.starts_with(known) && it.message.ends_with(", of Ada")),
        "{findings:?}"
    );
    let mut verdict = |ada: Option<ConsentAudience>| {
        for (who, audience) in [("signer:Ada", ada), ("signer:Cem", Some(ConsentAudience::Public))] {
            let change = ConsentChange {
                movement: Some(audience),
                derived: Some(audience),
                ..ConsentChange::default()
            };
            corpus.change_consent(&[address(who)], &change).expect("changed");
        }
        let connection = corpus.store.read_connection();
        let known = PublishPermissions::read_publish_permissions(connection, None).expect("read");
        let row = stored_recordings::recording_named(connection, "piece").expect("read");
        let terms = known.contributed_terms(row.expect("a recording").id, ConsentKind::Movement);
        let bol = stored_recordings::recording_named(connection, "bol").expect("read");
        terms.map(|terms| terms.len()).map_err(|withheld| {
            assert_eq!(Some(withheld.recording), bol.map(|row| row.id), "because of Ada");
            withheld.reason
        })
    };
    assert_eq!(verdict(Some(ConsentAudience::Public)), Ok(1));
    assert_eq!(verdict(Some(ConsentAudience::Nobody)), Err(WithheldReason::NotPublic));
    assert_eq!(verdict(None), Err(WithheldReason::ConsentUnknown));
}
