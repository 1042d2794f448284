//! Tests of minimal pairs in small tables, and in one that was counted independently.

use std::collections::BTreeSet;

use super::*;
use crate::progress::ProgressReceiver;
use crate::{ImportOptions, SearchOptions, ignore_progress_step};

fn corpus_of(folder: &std::path::Path, file: &std::path::Path) -> Corpus {
    let mut corpus = Corpus::create_corpus(&folder.join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    let files = [file.to_owned()];
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&files, &ImportOptions::default(), progress)
        .expect("imported");
    corpus
}

fn asked(corpus: &mut Corpus, fields: &[&str], empty: EmptyCellTreatment) -> MinimalPairs {
    let fields = fields.iter().map(|it| (*it).to_owned()).collect();
    let options = PairOptions {
        fields,
        empty,
        ..PairOptions::default()
    };
    corpus
        .minimal_pairs(&options, &mut crate::ProgressReceiver::silent_progress())
        .expect("counted")
}

#[test]
fn pairs_differ_in_one_field_and_name_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("t.csv");
    let table = "gloss,handshape,handshape weak,location\nA,V + O,,chin\nB,V,,chin\nC,V,V,chin\n\
                 D,V,,chin\nE,B,,chest\nF,,,chest\n";
    std::fs::write(&file, table).expect("written");
    let mut corpus = corpus_of(folder.path(), &file);
    let titles = ["handshape", "Handshape Weak", "location"];
    let value = asked(&mut corpus, &titles, EmptyCellTreatment::Value);
    let list: Vec<String> = value
        .list
        .iter()
        .map(|it| minimal_pair_line(it).trim().replace('\t', " "))
        .collect();
    let wanted = [
        "A B handshape",
        "A D handshape",
        "B C Handshape Weak",
        "C D Handshape Weak",
        "E F handshape",
    ];
    assert_eq!(list, wanted);
    assert_eq!((value.total, value.signs, value.certain), (5, 6, 2));
    let homonyms = (value.homonyms, value.homonym_groups, value.homonym_signs);
    assert_eq!((homonyms, value.forms), ((1, 1, 2), 5));
    let unknown = asked(&mut corpus, &titles, EmptyCellTreatment::Unknown);
    assert_eq!((unknown.total, unknown.entries), (0, 1));
    // If cells are compared as they were coded, "V + O" differs from "V", too.
    let coded = asked(
        &mut corpus,
        &["configuration", "weak.configuration", "placement"],
        EmptyCellTreatment::Value,
    );
    assert_eq!(coded.total, value.total, "{:?}", coded.list);
    for fields in [vec!["nosuch".to_owned()], vec!["orientation.palm".to_owned()]] {
        let options = PairOptions {
            fields,
            ..PairOptions::default()
        };
        assert!(
            corpus
                .minimal_pairs(&options, &mut crate::ProgressReceiver::silent_progress())
                .is_err()
        );
    }
}

#[test]
fn named_sets_of_fields_fit_the_titles_of_signbank() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("t.csv");
    let table = "Annotation ID Gloss (Dutch),Handedness,Strong Hand,Weak Hand,Handshape Change,\
                 Relation between Articulators,Location,Relative Orientation: Movement,\
                 Relative Orientation: Location,Orientation Change,Contact Type,Movement Shape,\
                 Movement Direction,Repeated Movement,Alternating Movement\n\
                 A,1,B,,,,chin,Palm,-,,,,down,False,False\nC,1,5,,,,chin,Palm,-,,,,down,False,False\n\
                 D,1,5,,,,chin,Back,-,,,,down,False,False\n";
    std::fs::write(&file, table).expect("written");
    let mut corpus = corpus_of(folder.path(), &file);
    let found = asked(&mut corpus, &["S13"], EmptyCellTreatment::Value);
    let list: Vec<String> = found
        .list
        .iter()
        .map(|it| minimal_pair_line(it).trim().replace('\t', " "))
        .collect();
    assert_eq!(list, ["A C Handshape strong", "C D Relative orientation movement"]);
    let options = PairOptions {
        fields: ["Handedness", "Strong Hands", "Location"].map(str::to_owned).to_vec(),
        ..PairOptions::default()
    };
    let error = corpus
        .minimal_pairs(&options, &mut crate::ProgressReceiver::silent_progress())
        .expect_err("no such column")
        .to_string();
    let said = "no imported table has a column \"Strong Hands\" with the others; did you mean \"Strong Hand\"?";
    assert!(error.contains(said), "{error}");
}

#[test]
fn pairs_count_only_rows_that_the_corpus_still_has() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("t.csv");
    let counted = |corpus: &mut Corpus| {
        let found = asked(corpus, &["handshape", "location"], EmptyCellTreatment::Value);
        let list = found
            .list
            .iter()
            .map(|it| minimal_pair_line(it).trim().replace('\t', " "));
        (found.entries, list.collect::<Vec<_>>().join(", "))
    };
    let table = "gloss,handshape,location\nA,V,chin\nB,V,chest\nC,5,chin\nD,B,nose\n";
    std::fs::write(&file, table).expect("written");
    let mut corpus = corpus_of(folder.path(), &file);
    let both = "A B location, A C handshape";
    assert_eq!(counted(&mut corpus), (4, both.to_owned()));
    // The next version has another cell of C, and no D.
    std::fs::write(&file, "gloss,handshape,location\nA,V,chin\nB,V,chest\nC,5,nose\n").expect("written");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&[file], &ImportOptions::default(), progress)
        .expect("imported");
    assert_eq!(counted(&mut corpus), (3, "A B location".to_owned()));
    let renamed = crate::SignChange {
        gloss: Some("E".to_owned()),
        ..crate::SignChange::default()
    };
    let name = crate::address::RowName::Text("A".to_owned());
    corpus.change_sign(&name, &renamed).expect("renamed");
    assert_eq!(counted(&mut corpus), (3, "B E location".to_owned()));
    let what = ["sign:B".parse().expect("an address")];
    corpus
        .delete_objects(&what, crate::DeleteOptions::default(), progress)
        .expect("deleted");
    assert_eq!(counted(&mut corpus), (2, String::new()));
}

#[test]
fn simultaneous_values_differ_from_successive_ones_and_all_unused_values_are_listed() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("t.csv");
    let table = "gloss,handshape,location,movement direction\nSEQ,B,chin,downwards > inwards\n\
                 SIM,B,chin,\"downwards, inwards\"\nEND,B,chin,> inwards\nONE,B,chin,inwards\n\
                 OTHER,5,chin,\"inwards, downwards\"\n";
    std::fs::write(&file, table).expect("written");
    let mut corpus = corpus_of(folder.path(), &file);
    let fields = ["dominant.configuration", "placement", "movement.direction"];
    let found = asked(&mut corpus, &fields, EmptyCellTreatment::Value);
    let list = found
        .list
        .iter()
        .map(|it| minimal_pair_line(it).trim().replace('\t', " "));
    let direction = |pair: &str| format!("{pair} movement.direction");
    let mut wanted: Vec<String> = ["END ONE", "END SEQ", "END SIM", "ONE SEQ", "ONE SIM"]
        .map(direction)
        .to_vec();
    wanted.push("OTHER SIM dominant.configuration".to_owned());
    wanted.push(direction("SEQ SIM"));
    assert_eq!((found.homonyms, list.collect::<Vec<_>>()), (0, wanted));
    let suggested = corpus
        .suggest_new_signs(&"SIM".parse().expect("an address"), false)
        .expect("coded");
    assert_eq!(suggested.coding["movement.direction"], "downwards + inwards");
    let to: Vec<&str> = suggested.partners.iter().map(|it| it.to.as_str()).collect();
    assert_eq!(to, ["5", "> inwards", "inwards", "downwards > inwards"]);
    let inventory = chereme_sign::inventory::builtin_by_id("configurations");
    let values = inventory.map_or(0, |it| it.values.len());
    let unused = suggested.unused["dominant.configuration"].len();
    // All but the sign's own handshape and that of OTHER.
    assert!(values > 42 && unused == values - 2, "{unused} of {values}");
}

#[test]
fn pairs_of_the_shared_lexicon_equal_an_independent_count() {
    let Ok(shared) = std::env::var("CHEREME_SHARED_DATA") else {
        eprintln!("CHEREME_SHARED_DATA is not set: the lexicon was not counted");
        return;
    };
    let folder = tempfile::tempdir().expect("a folder");
    let file = std::path::Path::new(&shared).join("phonology/ngt_lexicon.tsv");
    let mut corpus = corpus_of(folder.path(), &file);
    let value = EmptyCellTreatment::Value;
    for (set, empty, total, signs, homonyms, forms, sha256) in [
        (
            "S13",
            value,
            4134,
            1353,
            (363, 203, 475),
            1873,
            "a20c157000a4a392acf22f4c06b779456e66ddd093d11588d33934b4fd931d43",
        ),
        (
            "F8",
            value,
            11507,
            1851,
            (813, 292, 769),
            1668,
            "dd2b28a9c508a1b9d1ba965e3c57df3ad972074bc636929d1ee4b7bbdafeb87f",
        ),
        (
            "F7",
            value,
            17595,
            1845,
            (1202, 308, 884),
            1569,
            "b366762d4d7ace3b6d216c6cc8ff82397f9b84237ba3959e3d5e0a63849b47d9",
        ),
        (
            "F5",
            value,
            58700,
            2084,
            (4092, 351, 1358),
            1138,
            "4fecf0b3c8687505583df705d0e1d67f3c74187c5a7cc03f6775336fa983feb1",
        ),
        (
            "C3",
            value,
            158_748,
            2135,
            (7268, 333, 1574),
            904,
            "19565cd43720c9492a0b5527e97359cb29aaefa71906bdb3c56934214b375796",
        ),
        (
            "F7",
            EmptyCellTreatment::Unknown,
            29,
            35,
            (10, 5, 12),
            81,
            "1d63be8590ef3b2314cb76e0835b42c63b73f221693033d1911daf8a7c1c34a0",
        ),
        (
            "F5",
            EmptyCellTreatment::Unknown,
            10750,
            750,
            (1302, 132, 500),
            422,
            "fb099d8f139b6825c24303a7695e5606f1bc6dffdbe9df1272c004886b4874f2",
        ),
    ] {
        let found = asked(&mut corpus, &[set], empty);
        let groups = (found.homonyms, found.homonym_groups, found.homonym_signs);
        let counts = (found.total, found.signs, groups, found.forms);
        assert_eq!(counts, (total, signs, homonyms, forms), "{set} {empty:?}");
        assert_eq!(found.sha256, sha256, "{set} {empty:?}");
    }
    let found = asked(&mut corpus, &["S13"], value);
    assert_eq!(found.certain, 3306);
    assert_eq!(found.by_field[0], ("Handshape strong".to_owned(), 2368));
    let top: Vec<(&str, usize)> = found.densest.iter().map(|it| (&*it.gloss, it.pairs)).collect();
    let wanted = [
        ("1-A", 59),
        ("EVEN-DENKEN-C", 59),
        ("TELHAND-1-B", 59),
        ("TELHAND-5", 51),
        ("HEFTIG", 48),
        ("SEPTEMBER-B", 48),
        ("STRENG", 48),
        ("2-A", 46),
        ("PB", 46),
        ("VRIJDAG-B", 46),
    ];
    assert_eq!(top, wanted);
}

#[test]
fn a_sign_with_two_citation_forms_is_one_entry_and_no_homonym_of_itself() {
    let folder = tempfile::tempdir().expect("a folder");
    // LION, POULE and VACHE have an entry in the lexicon and a recording.
    let files = crate::unpack_starter(&folder.path().join("files")).expect("unpacked");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&files, &ImportOptions::default(), progress)
        .expect("imported");
    let fields = ["dominant.configuration", "placement", "movement"];
    let found = asked(&mut corpus, &fields, EmptyCellTreatment::Value);
    let tokens = crate::db::signs::load_citation_tokens(corpus.store.read_connection()).expect("read");
    let glosses: BTreeSet<&str> = tokens.iter().map(|it| it.gloss.as_str()).collect();
    assert!(glosses.contains("LION") && tokens.len() == glosses.len());
    assert!(found.entries <= glosses.len(), "{found:?}");
    assert!(found.list.iter().all(|it| it.a != it.b), "{found:?}");
    assert_eq!(found.entries - found.forms, found.homonym_signs - found.homonym_groups);
}

#[test]
fn a_coded_value_counts_before_the_one_of_a_sign_that_was_made_from_notation() {
    let folder = tempfile::tempdir().expect("a folder");
    let table = folder.path().join("signs.csv");
    let notation = "hamflathand hamextfingeru hampalml hamchest";
    std::fs::write(
        &table,
        format!("gloss,handshape,HamNoSys\nBOOK,B,{notation}\nCAT,B,{notation}\n"),
    )
    .expect("written");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "A").expect("made");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    corpus
        .import_paths(&[table], &ImportOptions::default(), progress)
        .expect("imported");
    let fields = ["dominant.configuration"];
    let before = asked(&mut corpus, &fields, EmptyCellTreatment::Value);
    let staging = crate::NotationStaging::default();
    corpus
        .animate_notation(&["BOOK"], &staging, Some("BOOK"))
        .expect("made");
    let made = corpus.search_tokens("gloss=BOOK origin=made", &SearchOptions::default());
    let made = made.expect("found").hits.remove(0);
    assert_ne!(
        made.components["right.configuration"], "B",
        "the words of the notation differ"
    );
    let after = asked(&mut corpus, &fields, EmptyCellTreatment::Value);
    assert_eq!((before.forms, before.homonym_signs), (1, 2));
    assert_eq!((after.forms, after.homonym_signs), (1, 2));
}

#[test]
fn codings_with_too_many_pairs_have_none() {
    let coded = |count: usize| -> Vec<(String, BTreeMap<String, String>)> {
        let value = |at: usize| BTreeMap::from([("placement".to_owned(), format!("v{at}"))]);
        (0..count).map(|at| (format!("S{at}"), value(at))).collect()
    };
    let few = of_codings(&coded(40)).expect("few pairs");
    assert_eq!(few.total, 40 * 39 / 2);
    // All of them differ in their only field.
    assert!(of_codings(&coded(3300)).is_none());
}
