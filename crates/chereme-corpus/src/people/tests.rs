//! Tests of people: names, attributes, tables, and two who become one.

use tempfile::TempDir;

use super::*;
use crate::annotate::NewTier;
use crate::consent::{ConsentChange, OutputAudience};
use crate::export::{ExportOptions, ExportWhat};
use crate::import::ImportOptions;
use crate::{CorpusAddress, SignerChange};

/// A dialogue of two people whose tiers two annotators made, and a take of one of them.
const DIALOGUE_EAF: &str = include_str!("dialogue.eaf");

fn dialogue_corpus() -> (TempDir, Corpus) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    let file = folder.path().join("dialogue.eaf");
    std::fs::write(&file, DIALOGUE_EAF).expect("written");
    let report = corpus
        .import_paths(
            &[file],
            &ImportOptions::default(),
            &mut crate::ProgressReceiver::silent_progress(),
        )
        .expect("imported");
    assert_eq!(report.files.len(), 1);
    (folder, corpus)
}

fn named(name: &str) -> RowName {
    RowName::Text(name.to_owned())
}

fn person(corpus: &Corpus, name: &str) -> PersonContents {
    let all = corpus.list_people().expect("people");
    all.into_iter().find(|person| person.name == name).expect("the person")
}

fn found_tokens(corpus: &mut Corpus, query: &str) -> usize {
    let answer = corpus.search_tokens(query, &crate::SearchOptions::default());
    answer.expect("an answer").total
}

#[test]
fn an_unknown_name_lists_those_who_only_annotate_too() {
    let (_folder, mut corpus) = dialogue_corpus();
    let error = corpus.change_person(&named("ann"), &PersonChange::default());
    let remedy = error
        .expect_err("nobody")
        .error_remedy()
        .map(|remedy| remedy.to_string());
    assert_eq!(remedy.as_deref(), Some("the people are: A.L., Ada, Bo, anno"));
}

#[test]
fn everybody_whom_a_file_names_is_a_person() {
    let (_folder, corpus) = dialogue_corpus();
    let names: Vec<String> = corpus
        .list_people()
        .expect("people")
        .into_iter()
        .map(|one| one.name)
        .collect();
    assert_eq!(names, ["A.L.", "Ada", "Bo", "anno"]);
    assert_eq!(person(&corpus, "Ada").participant_tiers, 1);
    assert_eq!(person(&corpus, "anno").annotator_tiers, 3);
    // Who only annotates signs nothing.
    let signers = corpus.load_corpus_info().expect("info").signers;
    assert!(signers.iter().all(|signer| signer.name != "anno"), "{signers:?}");
}

#[test]
fn two_people_become_one_everywhere_and_undo_takes_it_back() {
    let (_folder, mut corpus) = dialogue_corpus();
    corpus
        .change_consent(
            &[CorpusAddress::Signer(named("Ada"))],
            &ConsentChange {
                movement: Some(Some(ConsentAudience::Public)),
                ..ConsentChange::default()
            },
        )
        .expect("agreed");
    corpus
        .change_consent(
            &[CorpusAddress::Signer(named("A.L."))],
            &ConsentChange {
                movement: Some(Some(ConsentAudience::Research)),
                ..ConsentChange::default()
            },
        )
        .expect("agreed");
    let before = corpus.list_people().expect("people");
    assert_eq!(found_tokens(&mut corpus, "signer=Ada"), 1);
    let report = corpus.unite_people(&[named("A.L.")], &named("Ada")).expect("one");
    assert_eq!((report.tiers, report.is_consent_narrower), (1, true));
    let ada = person(&corpus, "Ada");
    assert_eq!(ada.aliases, ["A.L."]);
    assert_eq!(ada.participant_tiers, 2);
    // Both names find all tokens of the person.
    assert_eq!(found_tokens(&mut corpus, "signer=Ada"), 2);
    assert_eq!(found_tokens(&mut corpus, "signer=\"A.L.\""), 2);
    let consent = corpus
        .consents_of(&[CorpusAddress::Signer(named("A.L."))])
        .expect("a consent");
    assert_eq!(consent[0].consent.movement, Some(ConsentAudience::Research));
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.list_people().expect("people"), before);
    assert_eq!(found_tokens(&mut corpus, "signer=Ada"), 1);
}

#[test]
fn a_file_that_says_another_name_means_the_person() {
    let (folder, mut corpus) = dialogue_corpus();
    corpus.unite_people(&[named("A.L.")], &named("Ada")).expect("one");
    let second = folder.path().join("second.eaf");
    std::fs::write(&second, DIALOGUE_EAF.replace("NOM1", "NOM3")).expect("written");
    let mut progress = crate::ProgressReceiver::silent_progress();
    corpus
        .import_paths(&[second], &ImportOptions::default(), &mut progress)
        .expect("imported");
    assert!(
        corpus
            .list_people()
            .expect("people")
            .iter()
            .all(|one| one.name != "A.L.")
    );
    assert_eq!(person(&corpus, "Ada").participant_tiers, 4);
    // So does a tier that a person adds.
    let tier = NewTier {
        participant: Some("A.L.".into()),
        ..NewTier::new(named("second"), "more", chereme_sign::TierRole::Gloss)
    };
    let row = corpus.add_tier(&tier).expect("added");
    assert_eq!(row.participant.as_deref(), Some("Ada"));
}

#[test]
fn people_who_differ_are_not_made_one() {
    let (_folder, mut corpus) = dialogue_corpus();
    for (name, hand) in [("Ada", BodySide::Right), ("Bo", BodySide::Left)] {
        let change = SignerChange {
            handedness: Some(Some(hand)),
            ..SignerChange::default()
        };
        corpus.change_signer(&named(name), &change).expect("changed");
    }
    let error = corpus
        .unite_people(&[named("Bo")], &named("Ada"))
        .expect_err("they differ");
    assert!(error.to_string().contains("handedness (right, left)"), "{error}");
    let error = corpus
        .unite_people(&[named("Ada")], &named("Ada"))
        .expect_err("nobody else");
    assert!(error.to_string().contains("nobody"), "{error}");
}

#[test]
fn attributes_are_queried_and_leave_only_for_whom_they_may() {
    let (folder, mut corpus) = dialogue_corpus();
    let table = b"name,other names,region,age,handedness\nAda,Lovelace,north,34,right\nBo,,south,51,\nCy,,east,,\n";
    let tried = corpus
        .import_people_table(table, "people.csv", None, true)
        .expect("tried");
    assert_eq!(tried.added, ["Cy"]);
    assert!(person(&corpus, "Ada").attributes.is_empty());
    let report = corpus
        .import_people_table(table, "people.csv", None, false)
        .expect("read");
    assert_eq!(
        (report.added, report.changed),
        (vec!["Cy".into()], vec!["Ada".into(), "Bo".into()])
    );
    let again = corpus
        .import_people_table(table, "people.csv", None, false)
        .expect("read");
    assert_eq!((again.changed.len(), again.unchanged), (0, 3));
    assert_eq!(person(&corpus, "Ada").aliases, ["Lovelace"]);
    assert_eq!(found_tokens(&mut corpus, "signer.region=north"), 1);
    assert_eq!(found_tokens(&mut corpus, "signer.age>40"), 1);
    let change = PersonChange {
        attributes: [("region".to_owned(), "north".to_owned())].into(),
        audience: Some(ConsentAudience::Research),
        notes: Some(Some("met at the club".into())),
        ..PersonChange::default()
    };
    corpus.change_person(&named("Lovelace"), &change).expect("changed");
    for row in corpus.list_people().expect("people") {
        let agreed = ConsentChange {
            movement: Some(Some(ConsentAudience::Public)),
            annotation: Some(Some(ConsentAudience::Public)),
            derived: Some(Some(ConsentAudience::Public)),
            licence: Some("CC0".into()),
            ..ConsentChange::default()
        };
        corpus
            .change_consent(&[CorpusAddress::Signer(named(&row.name))], &agreed)
            .expect("agreed");
    }
    // The audience, and the regions and ages that the table shows to it.
    for (audience, shown) in [
        (OutputAudience::Me, vec!["signer.age", "signer.region"]),
        (OutputAudience::Research, vec!["signer.region"]),
        (OutputAudience::Public, vec![]),
    ] {
        let file = folder.path().join(format!("{audience}.csv"));
        let options = ExportOptions {
            audience,
            ..ExportOptions::default()
        };
        let mut progress = crate::ProgressReceiver::silent_progress();
        corpus
            .export_corpus(&ExportWhat::All, &file, &options, &mut progress)
            .expect("written");
        let text = std::fs::read_to_string(&file).expect("text");
        let titles = text.lines().next().expect("titles");
        let of_signers: Vec<&str> = titles.split(',').filter(|title| title.starts_with("signer.")).collect();
        assert_eq!(of_signers, shown, "{audience}");
        // The signer of a token of a dialogue is known, and another name of theirs stays at home.
        assert!(text.contains("Ada") && !text.contains("Lovelace"), "{text}");
    }
    let copy = folder.path().join("copy");
    let options = ExportOptions {
        audience: OutputAudience::Public,
        ..ExportOptions::default()
    };
    let mut progress = crate::ProgressReceiver::silent_progress();
    corpus
        .export_corpus(&ExportWhat::All, &copy, &options, &mut progress)
        .expect("written");
    for entry in walk_files(&copy) {
        let bytes = std::fs::read(&entry).expect("bytes");
        for secret in ["Lovelace", "north", "south", "the club"] {
            let is_there = bytes.windows(secret.len()).any(|window| window == secret.as_bytes());
            assert!(!is_there, "{secret} in {}", entry.display());
        }
    }
}

fn walk_files(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => files.extend(walk_files(&path)),
            false => files.push(path),
        }
    }
    files
}

#[test]
fn a_name_belongs_to_one_person() {
    let (_folder, mut corpus) = dialogue_corpus();
    let with_alias = |alias: &str| PersonChange {
        add_aliases: vec![alias.to_owned()],
        ..PersonChange::default()
    };
    let error = corpus
        .change_person(&named("Ada"), &with_alias("Bo"))
        .expect_err("taken");
    assert!(error.to_string().contains("a name of Bo"), "{error}");
    corpus
        .change_person(&named("Bo"), &with_alias("Boris"))
        .expect("changed");
    let error = corpus
        .change_person(&named("Ada"), &with_alias("Boris"))
        .expect_err("taken");
    assert!(error.to_string().contains("a name of Bo"), "{error}");
    let renamed = PersonChange {
        name: Some("Boris".into()),
        keeps_former_name: true,
        ..PersonChange::default()
    };
    let row = corpus.change_person(&named("Bo"), &renamed).expect("renamed");
    assert_eq!((row.name.as_str(), row.aliases), ("Boris", vec!["Bo".to_owned()]));
    assert_eq!(row.participant_tiers, 1);
}

#[test]
fn a_consent_that_comes_to_hold_for_more_is_said() {
    let (_folder, mut corpus) = dialogue_corpus();
    let agreed = ConsentChange {
        movement: Some(Some(ConsentAudience::Public)),
        ..ConsentChange::default()
    };
    corpus
        .change_consent(&[CorpusAddress::Signer(named("Ada"))], &agreed)
        .expect("agreed");
    let report = corpus.unite_people(&[named("A.L.")], &named("Ada")).expect("one");
    assert_eq!((report.is_consent_extended, report.is_consent_narrower), (true, false));
    let nothing_said = corpus.unite_people(&[named("anno")], &named("Bo")).expect("one");
    assert_eq!(
        (nothing_said.is_consent_extended, nothing_said.is_consent_narrower),
        (false, false)
    );
}

#[test]
fn the_preferred_annotator_is_preferred_under_every_name() {
    let (_folder, mut corpus) = dialogue_corpus();
    corpus.prefer_annotator(Some("anno")).expect("preferred");
    let preferred = |corpus: &Corpus| tokens::preferred_annotator(corpus.store.read_connection()).expect("read");
    let renamed = PersonChange {
        name: Some("Anna".into()),
        ..PersonChange::default()
    };
    corpus.change_person(&named("anno"), &renamed).expect("renamed");
    assert_eq!(preferred(&corpus).as_deref(), Some("Anna"));
    corpus.unite_people(&[named("Anna")], &named("Bo")).expect("one");
    assert_eq!(preferred(&corpus).as_deref(), Some("Bo"));
    let by_bo = corpus.list_people().expect("people");
    assert!(
        by_bo
            .iter()
            .any(|person| person.name == "Bo" && person.annotator_tiers == 3)
    );
}

#[test]
fn who_annotated_others_is_not_forgotten_in_silence() {
    let (_folder, mut corpus) = dialogue_corpus();
    let progress = &mut crate::ProgressReceiver::silent_progress();
    let error = corpus
        .forget_signer(&named("anno"), true, progress)
        .expect_err("needed");
    assert!(
        error.to_string().contains("annotated recordings of others: dialogue"),
        "{error}"
    );
}

#[test]
fn people_come_along_when_copies_are_merged() {
    let (folder, mut mine) = dialogue_corpus();
    let copy = folder.path().join("copy.chereme");
    let options = ExportOptions {
        with_history: true,
        ..ExportOptions::default()
    };
    let progress = &mut crate::ProgressReceiver::silent_progress();
    let shared = folder.path().join("shared");
    mine.export_corpus(&ExportWhat::All, &shared, &options, progress)
        .expect("written");
    std::fs::copy(shared.join("corpus.chereme"), &copy).expect("copied");
    let mut theirs = Corpus::open_corpus(&copy, "other").expect("opened");
    theirs.unite_people(&[named("A.L.")], &named("Ada")).expect("one");
    let change = PersonChange {
        attributes: [("region".to_owned(), "north".to_owned())].into(),
        ..PersonChange::default()
    };
    theirs.change_person(&named("Ada"), &change).expect("changed");
    drop(theirs);
    let report = mine.merge_corpus(&copy, None, progress).expect("merged");
    assert!(report.conflicts.is_empty(), "{report:?}");
    let ada = person(&mine, "Ada");
    assert_eq!(ada.aliases, ["A.L."]);
    assert_eq!(ada.participant_tiers, 2);
    assert_eq!(ada.attributes[0].text, "north");
    assert_eq!(mine.list_people().expect("people").len(), 3);
}
