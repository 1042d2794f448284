//! Tests with any mixture of consents: the folder has only what is public, also after a withdrawal.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use super::*;
use crate::consent::tests::{any_audience, corpus};
use crate::db::{stored_recordings, stored_tiers};
use crate::{ConsentAudience, ConsentChange, RecordingChange, RowName, SignChange, ignore_progress_step};

/// Generated signs with their recipes: one from one recording, one from two, one from a generated one with
/// the handshape of another.
const MADE: [(&str, &str, &[&str]); 3] = [
    ("QZMADEZQ", "QZSNAILZQ | place both by up 2cm", &["qzrecsnailzq"]),
    ("QZBOTHZQ", "QZBOWLZQ then QZSNAILZQ", &["qzrecbowlzq", "qzrecsnailzq"]),
    (
        "QZDEEPZQ",
        "QZMADEZQ | configure right from QZBOWLZQ",
        &["QZMADEZQ", "qzrecbowlzq"],
    ),
];
/// Captured signs: the recording of the starter corpus, its new name, the signer, the gloss before and after.
const CAPTURED: [(&str, &str, &str, &str, &str); 2] = [
    ("escargot", "qzrecsnailzq", "Qzadazq", "ESCARGOT", "QZSNAILZQ"),
    ("bol", "qzrecbowlzq", "Qzbeazq", "BOL", "QZBOWLZQ"),
];
/// Everything that can have a consent.
const SUBJECTS: [&str; 7] = [
    "signer:Qzadazq",
    "signer:Qzbeazq",
    "recording:qzrecsnailzq",
    "recording:qzrecbowlzq",
    "recording:QZMADEZQ",
    "recording:QZBOTHZQ",
    "recording:QZDEEPZQ",
];
const LICENCES: [Option<&str>; 4] = [Some("CC0"), Some("CC BY 4.0"), Some("CC BY-ND 4.0"), None];

fn world(folder: &Path) -> Corpus {
    let mut corpus = corpus(folder);
    for (old, name, signer, before, gloss) in CAPTURED {
        let change = RecordingChange {
            name: Some(name.into()),
            signer: Some(Some(signer.into())),
            ..RecordingChange::default()
        };
        let recording = RowName::Text(old.into());
        corpus.change_recording(&recording, &change).expect("changed");
        let change = SignChange {
            gloss: Some(gloss.into()),
            ..SignChange::default()
        };
        let sign = RowName::Text(before.into());
        corpus.change_sign(&sign, &change).expect("changed");
    }
    for (gloss, recipe, _) in MADE {
        corpus.recombine_recipe(recipe, gloss).expect("generated");
    }
    corpus
}

/// The consents of a case, and the terms of the recordings.
#[derive(Debug, Clone)]
struct Case {
    said: Vec<[Option<ConsentAudience>; 3]>,
    licences: Vec<Option<&'static str>>,
}

fn any_case() -> impl Strategy<Value = Case> {
    // Most say yes, so that something is published.
    let audience = prop_oneof![
        5 => Just(Some(ConsentAudience::Public)),
        2 => Just(None),
        1 => any_audience(),
    ];
    let said = prop::collection::vec(prop::array::uniform3(audience), SUBJECTS.len());
    let licence = prop_oneof![5 => Just(LICENCES[0]), 1 => prop::sample::select(&LICENCES[..])];
    let licences = prop::collection::vec(licence, CAPTURED.len() + MADE.len());
    (said, licences).prop_map(|(said, licences)| Case { said, licences })
}

impl Case {
    fn state(&self, corpus: &mut Corpus) {
        for (subject, said) in SUBJECTS.iter().zip(&self.said) {
            let change = ConsentChange {
                movement: Some(said[0]),
                annotation: Some(said[1]),
                derived: Some(said[2]),
                ..ConsentChange::default()
            };
            let of = [subject.parse().expect("an address")];
            corpus.change_consent(&of, &change).expect("changed");
        }
        let names = SUBJECTS[2..].iter().zip(&self.licences);
        for (subject, licence) in names {
            let name = subject.split_once(':').expect("a kind").1;
            let change = RecordingChange {
                licence: Some(licence.map(str::to_owned)),
                ..RecordingChange::default()
            };
            let name = RowName::Text(name.into());
            corpus.change_recording(&name, &change).expect("changed");
        }
    }

    fn of(&self, subject: &str) -> [Option<ConsentAudience>; 3] {
        let at = SUBJECTS.iter().position(|it| *it == subject);
        at.map_or([None; 3], |at| self.said[at])
    }

    /// Returns whether everybody may see a recording (0), its annotation (1), or a sign made from it (2), read off the
    /// rules and not off the program: everybody concerned says so, nobody says no, and the terms allow it.
    fn may(&self, recording: &str, kind: usize, people: &People) -> bool {
        let of = format!("recording:{recording}");
        let own = self.of(&of);
        let inputs = MADE.iter().find(|it| it.0 == recording).map(|it| it.2);
        let at = SUBJECTS[2..].iter().position(|it| *it == of).expect("known");
        let licence = self.licences[at];
        let no = |said: Option<ConsentAudience>| said.is_some_and(|it| it != ConsentAudience::Public);
        if no(own[kind]) {
            return false;
        }
        let asked = kind;
        let kind = if inputs.is_some() { 2 } else { kind };
        let signer = people
            .signers
            .get(recording)
            .map(|it| self.of(&format!("signer:{it}"))[kind]);
        let strange = people.strangers.contains(recording);
        let refused = no(own[kind]) || signer.is_some_and(no);
        let known = own[kind].is_some() || !strange && signer.is_none_or(|it| it.is_some());
        let terms = licence.is_some() || inputs.is_some();
        let mut from = inputs.into_iter().flatten();
        !refused
            && known
            && terms
            && from.all(|input| {
                let of = format!("recording:{input}");
                let at = SUBJECTS[2..].iter().position(|it| *it == of).expect("known");
                // Values are taken over, and joined signs and those with another handshape keep the movement of arms.
                let keeps = recording == MADE[1].0 || (recording == MADE[2].0 && *input == MADE[0].0);
                let is_shown = asked == 1 || (asked == 0 && keeps);
                let shown = !is_shown || self.may(input, asked, people);
                self.licences[at] != LICENCES[2] && self.may(input, 2, people) && shown
            })
    }
}

/// Returns text or bytes as letters of one byte each, so that both can be searched for.
fn letters(bytes: &[u8]) -> String {
    bytes.iter().map(|it| char::from(it.to_ascii_lowercase())).collect()
}

/// Returns the uids of everything in the corpus, as bytes and as digits.
fn uids(corpus: &Corpus) -> Vec<String> {
    let connection = corpus.store.read_connection();
    let mut all = Vec::new();
    for table in ["sign", "recording", "token", "signer"] {
        let sql = format!("SELECT hex(uid), uid FROM {table}");
        let mut statement = connection.prepare(&sql).expect("a table with uids");
        let rows = statement.query_map([], |row| Ok((row.get(0)?, row.get(1)?)));
        for row in rows.expect("read") {
            let (digits, bytes): (String, Vec<u8>) = row.expect("read");
            all.extend([letters(digits.as_bytes()), letters(&bytes)]);
        }
    }
    all
}

/// The people in recordings.
struct People {
    /// The signers by recording.
    signers: BTreeMap<String, String>,
    /// Recordings with a tier of somebody who stated nothing.
    strangers: BTreeSet<String>,
}

fn people(corpus: &Corpus) -> People {
    let connection = corpus.store.read_connection();
    let rows = stored_recordings::load_recording_rows(connection).expect("read");
    let (mut signers, mut strangers) = (BTreeMap::new(), BTreeSet::new());
    for row in rows {
        let signer = row
            .signer_id
            .map(|id| stored_recordings::find_signer_row(connection, id).expect("read"));
        let signer = signer.flatten().map(|it| it.name);
        let tiers = stored_tiers::load_tier_rows(connection, row.id).expect("read");
        let mut named = tiers.iter().filter_map(|it| it.participant.as_ref());
        if named.any(|it| Some(it) != signer.as_ref()) {
            strangers.insert(row.name.clone());
        }
        signers.extend(signer.map(|it| (row.name, it)));
    }
    People { signers, strangers }
}

/// Publishes, and checks the folder against the rules.
fn check(corpus: &mut Corpus, case: &Case, to: &Path) -> std::result::Result<(), TestCaseError> {
    let people = people(corpus);
    let captured = CAPTURED.map(|it| (it.4, it.1));
    let all = captured.into_iter().chain(MADE.map(|it| (it.0, it.0)));
    let (mut shown, mut moving) = (BTreeSet::new(), BTreeSet::new());
    let (mut secret, mut still) = (Vec::new(), Vec::new());
    for (gloss, recording) in all {
        match case.may(recording, 1, &people) {
            true => drop(shown.insert(gloss.to_owned())),
            false => secret.push(gloss),
        }
        match case.may(recording, 0, &people) && case.may(recording, 1, &people) {
            true => drop(moving.insert(gloss.to_owned())),
            false => still.push(gloss),
        }
    }
    let before = to.exists();
    let done = corpus.publish_dictionary(
        to,
        &PublishOptions::default(),
        &mut ProgressReceiver::new(&mut ignore_progress_step),
    );
    if shown.is_empty() && !before {
        prop_assert!(done.is_err() && !to.exists());
        return Ok(());
    }
    let done = done.expect("published");
    prop_assert_eq!(
        (done.signs, done.moving),
        (shown.len(), moving.len()),
        "{:?} {:?}",
        shown,
        done.left_out
    );
    let files = files(to);
    let part = |start: &str, end: &str| -> BTreeSet<String> {
        let names = files.keys().filter_map(|it| it.strip_prefix(start)?.strip_suffix(end));
        names.map(str::to_owned).collect()
    };
    prop_assert_eq!(&part("sign/", "/index.html"), &shown);
    prop_assert_eq!(&part("data/motion/", ".js"), &moving);
    prop_assert_eq!(&part("sign/", "/still.png"), &moving);
    let mut never: Vec<String> = secret.iter().map(|it| letters(it.as_bytes())).collect();
    never.extend(SUBJECTS.iter().filter_map(|it| {
        let name = it.split_once(':').map(|it| it.1)?;
        (!name.starts_with("QZ")).then(|| letters(name.as_bytes()))
    }));
    never.extend(uids(corpus));
    for (name, bytes) in &files {
        let text = format!("{}\n{}", letters(name.as_bytes()), letters(bytes));
        let found = never.iter().find(|it| text.contains(it.as_str()));
        prop_assert!(found.is_none(), "{}: {:?}", name, found);
    }
    for gloss in still.iter().filter(|it| shown.contains(**it)) {
        let page = &files[&format!("sign/{gloss}/index.html")];
        prop_assert!(!String::from_utf8_lossy(page).contains("data-motion"), "{}", gloss);
    }
    Ok(())
}

/// One corpus serves all cases: its consents are stated again for each.
#[test]
fn nothing_without_public_consent_reaches_the_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    let corpus = RefCell::new(world(folder.path()));
    let mut runner = TestRunner::new(ProptestConfig {
        cases: 6,
        max_shrink_iters: 12,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let checked = runner.run(&(any_case(), 0..SUBJECTS.len()), |(first, withdraws)| {
        let mut corpus = corpus.borrow_mut();
        let to = tempfile::tempdir().expect("a folder");
        let to = to.path().join("site");
        first.state(&mut corpus);
        check(&mut corpus, &first, &to)?;
        let mut second = first.clone();
        second.said[withdraws] = [Some(ConsentAudience::Nobody); 3];
        second.state(&mut corpus);
        check(&mut corpus, &second, &to)
    });
    checked.unwrap_or_else(|error| panic!("{error}"));
}

/// A sign whose name differs only in case from one that is not public has the name of its own gloss.
#[test]
fn the_name_of_a_folder_does_not_show_that_another_sign_exists() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    corpus.recombine_recipe("BOL | mirror", "escargot").expect("generated");
    let to = folder.path().join("site");
    consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
    consented(&mut corpus, "recording:escargot", ConsentAudience::Nobody);
    let options = PublishOptions::default();
    let done = corpus.publish_dictionary(&to, &options, &mut ProgressReceiver::new(&mut ignore_progress_step));
    done.expect("published");
    let names = files(&to);
    assert!(names.contains_key("sign/escargot/index.html"), "{:?}", names.keys());
    assert!(!names.keys().any(|it| it.contains('~')));
}

/// After the last sign was withdrawn, the folder shows an empty dictionary; a first publication without signs is refused.
#[test]
fn the_last_sign_can_be_withdrawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus(folder.path());
    let to = folder.path().join("site");
    consented(&mut corpus, "signer:Ada", ConsentAudience::Public);
    let publish = |corpus: &mut Corpus, query: Option<&str>| {
        let options = PublishOptions {
            query: query.map(str::to_owned),
            ..PublishOptions::default()
        };
        corpus.publish_dictionary(&to, &options, &mut ProgressReceiver::new(&mut ignore_progress_step))
    };
    publish(&mut corpus, None).expect("published");
    let before = files(&to);
    publish(&mut corpus, Some("gloss=NOTHING")).expect_err("no sign was meant");
    assert_eq!(files(&to), before);
    // Forgotten terms withdraw nothing.
    publish(&mut corpus, Some("gloss=LION")).expect_err("no terms are stated");
    assert_eq!(files(&to), before);
    consented(&mut corpus, "signer:Ada", ConsentAudience::Nobody);
    let done = publish(&mut corpus, None).expect("published");
    assert_eq!((done.signs, done.left_out.is_empty()), (0, false));
    assert!(files(&to).keys().all(|it| !it.starts_with("sign/")));
}
