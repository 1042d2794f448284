//! Relations that tables, people, recipes and forms state, read from both ends.

use std::fs;
use std::path::Path;

use super::*;
use crate::{ImportOptions, SearchOptions};

fn import_table(corpus: &mut Corpus, path: &Path, text: &str) -> Vec<String> {
    fs::write(path, text).expect("written");
    let progress = &mut ProgressReceiver::silent_progress();
    let report = corpus.import_paths(&[path.to_owned()], &ImportOptions::default(), progress);
    let file = report.expect("imported").files.remove(0);
    file.findings.into_iter().map(|finding| finding.message).collect()
}

fn said(corpus: &Corpus, gloss: &str) -> Vec<String> {
    let rows = corpus.list_relations(Some(&RowName::Text(gloss.into()))).expect("read");
    rows.into_iter()
        .map(|row| format!("{} {}", row.relation, row.related))
        .collect()
}

fn found(corpus: &mut Corpus, query: &str) -> Vec<String> {
    let answer = corpus
        .search_tokens(query, &SearchOptions::default())
        .expect("an answer");
    let mut glosses: Vec<String> = answer.hits.into_iter().map(|hit| hit.gloss).collect();
    glosses.sort();
    glosses
}

const TABLE: &str = "id,Gloss,Handshape,Location,Movement,Variants,Sequential Morphology,Relations to other signs
1,BOOK,B,chest,open,,,
2,SHOP,5,chest,down,MARKET,,
3,MARKET,5,chest,down,SHOP,,\"antonym:GONE, seealso:BOOK\"
4,BOOKSHOP,B,chest,open,,BOOK + SHOP,
5,TEN,A,chest,down,,,
";

#[test]
fn a_table_states_relations_that_are_read_from_both_ends_and_follow_its_next_version() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("asl.csv");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    let findings = import_table(&mut corpus, &path, TABLE);
    let unknown = "columns of relations name 1 signs or relations that are not known: GONE";
    assert!(findings.iter().any(|text| text == unknown), "{findings:?}");
    assert_eq!(said(&corpus, "BOOK"), ["part-of BOOKSHOP", "see-also MARKET"]);
    assert_eq!(said(&corpus, "BOOKSHOP"), ["compound-of BOOK", "compound-of SHOP"]);
    // Both rows say it; it is one relation.
    assert_eq!(said(&corpus, "SHOP"), ["part-of BOOKSHOP", "variant MARKET"]);
    assert_eq!(found(&mut corpus, "related.part-of=*"), ["BOOK", "SHOP"]);
    assert_eq!(found(&mut corpus, "related.variant=SHOP"), ["MARKET"]);
    assert_eq!(
        found(&mut corpus, "related.compound-of=SHOP placement=chest"),
        ["BOOKSHOP"]
    );
    // The cells stay as they were written.
    assert_eq!(
        found(&mut corpus, "attribute(\"Sequential Morphology\")=\"BOOK + SHOP\""),
        ["BOOKSHOP"]
    );
    let operations = corpus.operation_log(10).expect("read").len();
    let again = TABLE
        .replace("SHOP,\"antonym:GONE, seealso:BOOK\"", "SHOP,synonym:TEN")
        .replace("MARKET,,", ",,");
    import_table(
        &mut corpus,
        &path,
        &again.replace("3,MARKET,5,chest,down,SHOP,", "3,MARKET,5,chest,down,,"),
    );
    assert_eq!(said(&corpus, "MARKET"), ["see-also BOOK"]);
    assert_eq!(corpus.operation_log(10).expect("read").len(), operations + 1);
}

#[test]
fn people_relate_signs_and_take_it_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    import_table(
        &mut corpus,
        &folder.path().join("asl.csv"),
        "Gloss,Handshape\nBOOK,B\nSHOP,5\nTREE,5\n",
    );
    let [book, shop, tree] = ["BOOK", "SHOP", "TREE"].map(|gloss| RowName::Text(gloss.into()));
    let change = |corpus: &mut Corpus, relation: &str, others: &[RowName], change| {
        corpus.change_relations(&book, relation, others, change)
    };
    let add = RelationChange::Add;
    assert_eq!(
        change(&mut corpus, "Part of", &[shop.clone(), tree.clone()], add).expect("added"),
        2
    );
    assert_eq!(said(&corpus, "SHOP"), ["compound-of BOOK"]);
    assert_eq!(
        change(&mut corpus, "variant", std::slice::from_ref(&tree), add).expect("added"),
        1
    );
    // From the other end it is the same.
    assert_eq!(
        corpus
            .change_relations(&tree, "variant", std::slice::from_ref(&book), add)
            .expect("asked"),
        0
    );
    assert_eq!(
        corpus
            .change_relations(&tree, "variant", std::slice::from_ref(&book), RelationChange::Remove)
            .expect("removed"),
        1
    );
    corpus.undo_operation().expect("undone");
    assert_eq!(said(&corpus, "BOOK"), ["part-of SHOP", "part-of TREE", "variant TREE"]);
    for (relation, others) in [
        ("cousin", &shop),
        ("variant", &book),
        ("variant", &RowName::Text("NOBODY".into())),
    ] {
        let error = change(&mut corpus, relation, std::slice::from_ref(others), add).expect_err("refused");
        assert!(error.error_remedy().is_some(), "{error}");
    }
    assert!(
        corpus
            .check_corpus(false, &mut ProgressReceiver::silent_progress())
            .expect("checked")
            .faults
            .is_empty()
    );
}

#[test]
fn forms_decide_homonyms_and_paradigms() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "test").expect("made");
    import_table(&mut corpus, &folder.path().join("asl.csv"), TABLE);
    let by_form = |corpus: &mut Corpus, store| {
        let progress = &mut ProgressReceiver::silent_progress();
        let rows = corpus
            .relate_by_form(&PairOptions::default(), store, progress)
            .expect("found");
        let text = rows
            .into_iter()
            .map(|row| format!("{} {} {}", row.sign, row.relation, row.related));
        let mut all: Vec<String> = text.collect();
        all.sort();
        all
    };
    let expected = [
        "BOOK homonym BOOKSHOP",
        "MARKET paradigm TEN",
        "SHOP homonym MARKET",
        "SHOP paradigm TEN",
    ];
    assert_eq!(by_form(&mut corpus, false), expected);
    assert_eq!(by_form(&mut corpus, true), expected);
    assert_eq!(by_form(&mut corpus, true), [""; 0], "they are stated now");
    assert_eq!(found(&mut corpus, "related.paradigm=TEN"), ["MARKET", "SHOP"]);
}
