//! Signs belong to lexicons: two tables with one gloss are two signs.

use std::fs;
use std::path::Path;

use super::*;
use crate::ProgressReceiver;
use crate::lexicon::{LexiconChange, LexiconScope, LinkedRecordings};
use crate::pairs::PairOptions;

fn import_with(corpus: &mut Corpus, path: &Path, options: &ImportOptions) -> FileReport {
    let report = corpus
        .import_paths(&[path.to_owned()], options, &mut ProgressReceiver::silent_progress())
        .expect("imported");
    report.files.into_iter().next().expect("a file")
}

fn import_file(corpus: &mut Corpus, path: &Path) -> FileReport {
    import_with(corpus, path, &ImportOptions::default())
}

fn found(corpus: &mut Corpus, query: &str) -> Vec<String> {
    let answer = corpus
        .search_tokens(query, &crate::SearchOptions::default())
        .expect("an answer");
    let mut glosses: Vec<String> = answer.hits.into_iter().map(|hit| hit.gloss).collect();
    glosses.sort();
    glosses
}

fn write_tables(folder: &Path) -> [std::path::PathBuf; 2] {
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).expect("written");
        path
    };
    [
        write(
            "asl.csv",
            "Gloss,Handshape,Location\nBOOK,B,chest\nMOTHER,5,chin\nTREE,5,chest\n",
        ),
        write("bsl.csv", "Gloss,Handshape,Location\nBOOK,B,chin\nMOTHER,B,chest\n"),
    ]
}

/// A corpus with two lexicons, ASL and BSL.
fn corpus_of_two(folder: &Path) -> Corpus {
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "test").expect("made");
    for table in write_tables(folder) {
        let report = import_file(&mut corpus, &table);
        assert_eq!(
            report.understood.lexicon.as_deref(),
            table.file_stem().and_then(|stem| stem.to_str())
        );
    }
    corpus
}

#[test]
fn a_newer_version_in_another_folder_updates_the_lexicon_that_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    let [old, new] = ["old", "new"].map(|name| folder.path().join(name).join("asl.csv"));
    for (path, mother) in [(&old, "MOTHER"), (&new, "MUM")] {
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        let text = format!("Gloss,Signbank ID,Handshape\nBOOK,a7,B\n{mother},a9,5\n");
        fs::write(path, text).expect("written");
    }
    import_file(&mut corpus, &old);
    let report = import_file(&mut corpus, &new);
    let said: Vec<&str> = report.findings.iter().map(|finding| finding.message.as_str()).collect();
    assert!(
        said.iter().any(|text| text.contains("there is a lexicon \"asl\"")),
        "{said:?}"
    );
    let remedies = report.findings.iter().filter_map(|finding| finding.remedy.as_ref());
    let remedies: Vec<&str> = remedies.map(|remedy| remedy.remedy_text()).collect();
    assert!(
        remedies.iter().any(|text| text.ends_with("--lexicon \"asl\"")),
        "{remedies:?}"
    );
    assert_eq!(report.understood.lexicon.as_deref(), Some("asl (2)"));
    // The second time, the file has a lexicon of its own already.
    let said = import_file(&mut corpus, &new).findings;
    assert!(!said.iter().any(|finding| finding.severity == "warning"), "{said:?}");
    assert_eq!(found(&mut corpus, "gloss=*").len(), 4);
    corpus.undo_operation().expect("undone");
    let options = ImportOptions {
        lexicon: Some("asl".to_owned()),
        ..ImportOptions::default()
    };
    let report = import_with(&mut corpus, &new, &options);
    let said: Vec<&str> = report.findings.iter().map(|finding| finding.message.as_str()).collect();
    assert!(
        said.iter()
            .any(|text| text.contains("0 new, 1 changed, 1 as before, 0 gone")),
        "{said:?}"
    );
    assert_eq!(found(&mut corpus, "gloss=*"), ["BOOK", "MUM"]);
}

#[test]
fn a_lexicon_that_was_named_keeps_its_entries_whatever_lies_at_the_same_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    let path = folder.path().join("export.csv");
    let texts = [
        "Gloss,id,Handshape\nBOOK,7,B\nTREE,9,5\n",
        "Gloss,id,Handshape\nBOOK,7,A\nHOUSE,9,U\n",
    ];
    // The last one has the bytes of the first.
    for (lexicon, text) in [
        ("ASL", texts[0]),
        ("BSL", texts[1]),
        ("LSF", texts[0]),
        ("ASL", texts[0]),
    ] {
        fs::write(&path, text).expect("written");
        let options = ImportOptions {
            lexicon: Some(lexicon.to_owned()),
            ..ImportOptions::default()
        };
        import_with(&mut corpus, &path, &options);
    }
    assert_eq!(found(&mut corpus, "lexicon=ASL configuration=B,5"), ["BOOK", "TREE"]);
    assert_eq!(found(&mut corpus, "lexicon=BSL configuration=A,U"), ["BOOK", "HOUSE"]);
    assert_eq!(found(&mut corpus, "lexicon=LSF"), ["BOOK", "TREE"]);
    assert_eq!(found(&mut corpus, "gloss=*").len(), 6);
}

#[test]
fn an_entry_with_an_id_stays_the_same_sign_under_another_gloss() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    let path = folder.path().join("asl.csv");
    fs::write(&path, "Gloss,id,Handshape\nBOOK,17,B\nTREE,23,5\nHOUSE,30,U\n").expect("written");
    import_file(&mut corpus, &path);
    let sign = |corpus: &Corpus, gloss: &str| corpus.sign_details(&crate::RowName::Text(gloss.into())).expect(gloss);
    let [book, tree] = ["BOOK", "TREE"].map(|gloss| sign(&corpus, gloss).id);
    for (id, gloss, notes) in [(book, Some("BOOKS"), "n1"), (tree, None, "n2")] {
        let change = crate::SignChange {
            gloss: gloss.map(str::to_owned),
            notes: Some(Some(notes.into())),
            ..crate::SignChange::default()
        };
        corpus
            .change_sign(&crate::RowName::Number(id), &change)
            .expect("changed");
    }
    let mut again = |text: &str| {
        fs::write(&path, text).expect("written");
        let findings = import_file(&mut corpus, &path).findings;
        let said = findings.into_iter().map(|finding| finding.message);
        let signs = ["BOOKS", "TREES"].map(|gloss| {
            let sign = sign(&corpus, gloss);
            (sign.id, sign.notes, sign.tokens.len())
        });
        (
            said.filter(|text| text.contains("another gloss")).collect::<Vec<_>>(),
            signs,
        )
    };
    let (said, signs) = again("Gloss,id,Handshape\nBOOK,17,A\nTREES,23,5\nHOUSE,30,U\n");
    let kept = [(book, Some("n1".to_owned()), 1), (tree, Some("n2".to_owned()), 1)];
    assert_eq!(signs, kept);
    assert_eq!(
        said,
        ["signs with another gloss in the table, which stay the same signs: 1 (TREE is TREES)"]
    );
    // Where both gave it another name, that of the person stays, and the finding has both.
    let (said, signs) = again("Gloss,id,Handshape\nVOLUME,17,A\nTREES,23,5\nHOUSE,30,U\n");
    assert_eq!(signs, kept);
    assert!(said[0].ends_with("1 (BOOKS (the table says VOLUME))"), "{said:?}");
    assert_eq!(found(&mut corpus, "gloss=*"), ["BOOKS", "HOUSE", "TREES"]);
}

#[test]
fn one_gloss_in_two_tables_is_two_signs() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_of_two(folder.path());
    let counts: Vec<(String, i64)> = corpus
        .list_lexicons()
        .expect("lexicons")
        .into_iter()
        .map(|contents| (contents.lexicon.name, contents.signs))
        .collect();
    assert_eq!(counts, [("asl".to_owned(), 3), ("bsl".to_owned(), 2)]);
    assert_eq!(found(&mut corpus, "lexicon=asl"), ["BOOK", "MOTHER", "TREE"]);
    assert_eq!(found(&mut corpus, "lexicon=bsl gloss=BOOK placement=chin"), ["BOOK"]);
    assert_eq!(found(&mut corpus, "file=bsl.csv configuration=B"), ["BOOK", "MOTHER"]);
    let error = corpus
        .token_details(&"BOOK".parse().expect("an address"))
        .expect_err("two signs");
    assert!(
        error.to_string().contains("sign:\"asl/BOOK\", sign:\"bsl/BOOK\""),
        "{error}"
    );
    for (address, value) in [("asl/BOOK", "chest"), ("sign:bsl/book", "chin")] {
        let details = corpus
            .token_details(&address.parse().expect("an address"))
            .expect("one sign");
        assert!(format!("{details:?}").contains(value), "{address}: {details:?}");
    }
    // The language of a lexicon is found at once after it was stated.
    let change = LexiconChange {
        name: Some("ASL".into()),
        language: Some(Some("ASE".into())),
        ..LexiconChange::default()
    };
    corpus.change_lexicon("asl", &change).expect("changed");
    let check = corpus
        .check_corpus(false, &mut ProgressReceiver::silent_progress())
        .expect("checked");
    assert_eq!(check.all_findings().next(), None, "the index has followed");
    assert_eq!(found(&mut corpus, "language=ase").len(), 3);
    assert_eq!(found(&mut corpus, "lexicon=ASL").len(), 3);
    corpus.undo_operation().expect("undone");
    assert_eq!(found(&mut corpus, "lexicon=asl").len(), 3);
    assert!(
        corpus
            .change_lexicon(
                "asl",
                &LexiconChange {
                    name: Some("bsl".into()),
                    ..LexiconChange::default()
                }
            )
            .is_err()
    );
}

#[test]
fn signs_of_two_lexicons_are_compared_only_if_that_is_asked() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_of_two(folder.path());
    let mut pairs = |scope: LexiconScope, query: Option<&str>| {
        let options = PairOptions {
            fields: vec!["Handshape".into(), "Location".into()],
            query: query.map(str::to_owned),
            scope,
            ..PairOptions::default()
        };
        let counted = corpus.minimal_pairs(&options, &mut ProgressReceiver::silent_progress());
        counted.map(|pairs| pairs.total)
    };
    // ASL: BOOK and TREE, MOTHER and TREE; BSL: BOOK and MOTHER.
    assert_eq!(pairs(LexiconScope::Named("asl".into()), None).ok(), Some(2));
    assert_eq!(pairs(LexiconScope::Named("BSL".into()), None).ok(), Some(1));
    assert_eq!(pairs(LexiconScope::Single, Some("lexicon=bsl")).ok(), Some(1));
    assert!(pairs(LexiconScope::Across, None).is_ok_and(|total| total > 3));
    let error = pairs(LexiconScope::Single, None).expect_err("two lexicons");
    assert!(error.to_string().contains("asl (3), bsl (2)"), "{error}");
    assert!(pairs(LexiconScope::Named("ngt".into()), None).is_err());
}

#[test]
fn glosses_of_a_recording_mean_the_lexicon_to_which_it_is_linked() {
    let folder = tempfile::tempdir().expect("a folder");
    let take = folder.path().join("take.eaf");
    fs::write(&take, eaf(&[("Gloss", 0, 500, "BOOK"), ("Handshape", 0, 500, "B")])).expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    import_file(&mut corpus, &take);
    let glosses = found(&mut corpus, "origin=captured");
    let gloss = glosses.first().expect("a token").clone();
    let rows = |name: &str| {
        let path = folder.path().join(name);
        fs::write(&path, format!("Gloss,Handshape\n{gloss},B\n{name},5\n")).expect("written");
        path
    };
    // The first lexicon adopts what was annotated before it came; the second one does not.
    import_file(&mut corpus, &rows("one.csv"));
    assert_eq!(
        found(&mut corpus, &format!("lexicon=one origin=captured gloss={gloss:?}")).len(),
        1
    );
    import_file(&mut corpus, &rows("two.csv"));
    assert_eq!(found(&mut corpus, "lexicon=two").len(), 2);
    let silent = &mut ProgressReceiver::silent_progress();
    let linked = corpus
        .link_lexicon(Some("two"), &LinkedRecordings::All, silent)
        .expect("linked");
    assert_eq!(linked, ["take"]);
    assert_eq!(found(&mut corpus, "lexicon=one").len(), 2);
    assert_eq!(found(&mut corpus, "lexicon=two").len(), 3);
    corpus
        .link_lexicon(None, &LinkedRecordings::All, silent)
        .expect("linked");
    assert_eq!(found(&mut corpus, "lexicon=two").len(), 2);
    for _ in 0..2 {
        corpus.undo_operation().expect("undone");
    }
    assert_eq!(found(&mut corpus, "lexicon=one").len(), 3);
    // A recording that comes later belongs to none of the two, and the report says how to link it.
    let other = folder.path().join("other.eaf");
    fs::write(&other, eaf(&[("Gloss", 0, 600, "TREE")])).expect("written");
    let report = import_file(&mut corpus, &other);
    let texts: Vec<String> = report.findings.iter().map(|it| it.message.clone()).collect();
    assert!(
        texts
            .iter()
            .any(|text| text.contains("the corpus has several: one, two")),
        "{texts:?}"
    );
}

#[test]
fn notation_and_tables_of_one_named_lexicon_are_one_sign_each() {
    let folder = tempfile::tempdir().expect("a folder");
    let [asl, bsl] = write_tables(folder.path());
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    let options = |lexicon: &str, language: &str| ImportOptions {
        lexicon: Some(lexicon.to_owned()),
        sign_language: Some(language.to_owned()),
        ..ImportOptions::default()
    };
    import_with(&mut corpus, &asl, &options("ASL", "ase"));
    import_with(&mut corpus, &bsl, &options("BSL", "bfi"));
    let lines = folder.path().join("book.hns");
    fs::write(
        &lines,
        "BOOK\tham\u{2d}\n".replace("ham\u{2d}", "\u{e001}\u{e020}\u{e03c}"),
    )
    .expect("written");
    let report = import_with(&mut corpus, &lines, &options("BSL", "bfi"));
    assert_eq!(report.understood.lexicon.as_deref(), Some("BSL"), "{report:?}");
    assert_eq!(found(&mut corpus, "gloss=BOOK language=bfi").len(), 2);
    assert_eq!(found(&mut corpus, "gloss=BOOK language=ase").len(), 1);
    let wrong = ImportOptions {
        lexicon: Some("A/B".into()),
        ..ImportOptions::default()
    };
    let refused = corpus.import_paths(&[bsl], &wrong, &mut ProgressReceiver::silent_progress());
    assert!(!format!("{refused:?}").contains("Imported"), "{refused:?}");
}

#[test]
fn a_lexicon_is_removed_once_it_has_no_signs() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = corpus_of_two(folder.path());
    let error = corpus.remove_lexicon("bsl").expect_err("it has signs");
    assert_eq!(error.to_string(), "the lexicon \"bsl\" has 2 signs");
    let moved = ImportOptions {
        lexicon: Some("Signs of Leeds".into()),
        ..ImportOptions::default()
    };
    import_with(&mut corpus, &folder.path().join("bsl.csv"), &moved);
    corpus.remove_lexicon("bsl").expect("it is empty");
    let names = |corpus: &Corpus| -> Vec<String> {
        let all = corpus.list_lexicons().expect("lexicons");
        all.into_iter().map(|lexicon| lexicon.lexicon.name).collect()
    };
    assert_eq!(names(&corpus), ["Signs of Leeds", "asl"]);
    corpus.undo_operation().expect("undone");
    assert_eq!(names(&corpus).len(), 3);
}

#[test]
fn lexicons_are_made_one_entry_by_entry_and_nothing_is_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    let table = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        path
    };
    let head = "Signbank ID,Gloss,translation.en,Handshape";
    let old = format!("{head}\n7,BANK,bank,B\n3,BANK,bench,5\n9,CHAT,cat,A\n");
    let new = format!("{head}\n3,BANK,bench,5\n5,BANK,shore,S\n9,CHAT,puss,V\n4,CHIEN,dog,A\n");
    import_file(&mut corpus, &table("old.csv", &old));
    import_file(&mut corpus, &table("new.csv", &new));
    let take = table(
        "take.eaf",
        &eaf(&[("Gloss", 0, 500, "BANK"), ("Gloss2", 600, 900, "CHIEN")]),
    );
    let mapping = r#"{"tiers": {"Gloss2": "gloss"}}"#;
    let options = ImportOptions {
        mapping: TierMapping::from_json(mapping).expect("a mapping"),
        ..ImportOptions::default()
    };
    import_with(&mut corpus, &take, &options);
    let progress = &mut ProgressReceiver::silent_progress();
    let linked = corpus.link_lexicon(Some("old"), &LinkedRecordings::All, progress);
    assert_eq!(linked.expect("linked").len(), 1);
    let before = corpus.corpus_generation().expect("a number");
    for (lexicon, version) in [("old", "1"), ("new", "2")] {
        let change = LexiconChange {
            version: Some(Some(version.to_owned())),
            ..LexiconChange::default()
        };
        corpus.change_lexicon(lexicon, &change).expect("changed");
    }
    let refused = corpus.unite_lexicons(&["old".to_owned()], "new", progress);
    let refused = refused.expect_err("two versions").to_string();
    assert!(refused.contains("version (2, 1)"), "{refused}");
    let change = LexiconChange {
        version: Some(None),
        ..LexiconChange::default()
    };
    corpus.change_lexicon("old", &change).expect("changed");
    let united = corpus
        .unite_lexicons(&["old".to_owned()], "new", progress)
        .expect("united");
    // Id 3 is the second of one and the first of the other; the first of one has no partner, and moves.
    assert_eq!((united.joined, united.moved), (2, 1), "{united:?}");
    assert_eq!(united.differing, ["CHAT"]);
    assert_eq!(united.renumbered, ["BANK is BANK#3", "BANK#2 is BANK"]);
    let lexicons = corpus.list_lexicons().expect("lexicons");
    let [only] = lexicons.as_slice() else {
        panic!("{lexicons:?}")
    };
    assert_eq!(
        (only.signs, only.homonyms, only.recordings, only.files.len()),
        (5, 2, 1, 2)
    );
    assert_eq!(only.lexicon.version.as_deref(), Some("2"));
    // The annotation of the first entry of old says so now, and the gloss that old did not have is an entry.
    assert_eq!(found(&mut corpus, "sign=BANK#3 origin=captured"), ["BANK#3"]);
    assert_eq!(found(&mut corpus, "lexicon=new origin=captured").len(), 2);
    assert_eq!(found(&mut corpus, "sign=BANK#1").len(), 2);
    assert_eq!(found(&mut corpus, "translation:cat configuration=V").len(), 1);
    assert_whole(&mut corpus);
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.list_lexicons().expect("lexicons").len(), 2);
    assert_eq!(found(&mut corpus, "sign=old/BANK#1 origin=captured"), ["BANK"]);
    assert!(corpus.corpus_generation().expect("a number") > before);
    assert_whole(&mut corpus);
}
