//! Tests of lexicon tables that are imported again, of their mapping, and of queries for what their cells hold.

use super::*;
use crate::{PairOptions, ProgressReceiver, RowName, SearchOptions, SignChange};

fn total(corpus: &mut Corpus, query: &str) -> usize {
    let answer = corpus.search_tokens(query, &SearchOptions::default());
    answer.expect(query).total
}

fn pairs(corpus: &mut Corpus, fields: &[&str]) -> (usize, usize) {
    let options = PairOptions {
        fields: fields.iter().map(|it| (*it).to_owned()).collect(),
        ..PairOptions::default()
    };
    let found = corpus
        .minimal_pairs(&options, &mut crate::ProgressReceiver::silent_progress())
        .expect("counted");
    (found.total, found.entries)
}

fn glosses(corpus: &Corpus) -> Vec<String> {
    crate::db::signs::list_all_glosses(corpus.store.read_connection()).expect("glosses")
}

fn messages(report: &FileReport) -> String {
    let all = report.findings.iter().map(|it| it.message.as_str());
    all.collect::<Vec<_>>().join("\n")
}

const BY_LEMMA: &str = r#"{"columns": {"LemmaID": "gloss", "EntryID": "attribute"}}"#;

#[test]
fn another_mapping_of_the_gloss_changes_the_signs_and_makes_no_new_ones() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let text = "EntryID,LemmaID,Handshape\ne1,L1,B\ne2,L2,5\ne3,L2,5\nL1,e1,A\n";
    let table = desk.file("m.csv", text);
    import(&mut corpus, &table, "{}");
    assert_eq!(glosses(&corpus), ["L1", "e1", "e2", "e3"]);
    let name = RowName::Text("e2".into());
    let note = SignChange {
        notes: Some(Some("kept".to_owned())),
        ..SignChange::default()
    };
    corpus.change_sign(&name, &note).expect("noted");
    let before = corpus.load_corpus_info().expect("info").counts.clone();
    let report = import(&mut corpus, &table, BY_LEMMA);
    assert_eq!(report.status, FileStatus::Updated);
    // A sign that somebody wrote a remark about stays.
    assert_eq!(glosses(&corpus), ["L1", "L2", "e1", "e2"]);
    assert_eq!(
        corpus.load_corpus_info().expect("info").counts["tokens"],
        before["tokens"]
    );
    for (query, wanted) in [
        ("", 4),
        ("gloss=L1 configuration=B attribute.EntryID=e1", 1),
        ("gloss=e1 configuration=A attribute.EntryID=L1", 1),
        ("gloss=L2 configuration=5", 2),
        ("gloss=e2", 0),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
    let cited = "SELECT count(*) FROM token GROUP BY sign_id HAVING sum(citation) <> 1";
    let cited = corpus
        .store
        .read_connection()
        .prepare(cited)
        .and_then(|mut it| it.exists([]));
    assert!(!cited.expect("counted"), "each sign has one citation form");
    assert_whole(&mut corpus);
    // A copy of the table at another place is the same table.
    fs::create_dir(desk.folder.path().join("b")).expect("made");
    let copy = desk.file("b/m.csv", text);
    import(&mut corpus, &copy, r#"{"columns": {"EntryID": "gloss"}}"#);
    assert_eq!(glosses(&corpus), ["L1", "e1", "e2", "e3"]);
    assert_eq!(total(&mut corpus, ""), 4);
    corpus.undo_operation().expect("undone");
    corpus.undo_operation().expect("undone");
    assert_eq!(glosses(&corpus), ["L1", "e1", "e2", "e3"]);
    assert_whole(&mut corpus);
}

#[test]
fn the_mapping_of_a_table_is_used_whenever_the_table_is_read() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let text = "EntryID,LemmaID,Form\ne1,L1,B\ne2,L2,5\n";
    let mapping = r#"{"columns": {"Lemma*": "gloss", "EntryID": "attribute", "Form": "dominant.configuration"}}"#;
    let table = desk.file("m.csv", text);
    import(&mut corpus, &table, mapping);
    assert_eq!(pairs(&mut corpus, &["Form"]), (1, 2));
    assert_eq!(pairs(&mut corpus, &["Handshape strong"]), (1, 2), "by its meaning");
    // The next version has no mapping of its own, or one that is about another table.
    for (at, other) in ["{}", r#"{"columns": {"Ort": "placement"}}"#].into_iter().enumerate() {
        let table = desk.file("m.csv", &format!("{text}e3,L3,S{at}\n"));
        let report = import(&mut corpus, &table, other);
        let messages = messages(&report);
        let said = "by the mapping given then: \"EntryID\" attribute, \"Form\" dominant.configuration, \
                    \"LemmaID\" gloss";
        assert!(messages.contains(said), "{messages}");
        assert_eq!(glosses(&corpus), ["L1", "L2", "L3"]);
        assert_eq!(total(&mut corpus, &format!("gloss=L3 configuration=S{at}")), 1);
        assert_eq!(pairs(&mut corpus, &["Form"]), (3, 3));
    }
    assert_whole(&mut corpus);
}

#[test]
fn a_row_that_was_removed_from_a_table_is_reported() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let head = "gloss,handshape\nA,V\n";
    import(
        &mut corpus,
        &desk.file("t.csv", &format!("{head}B,5\nC,S\nC,A\n")),
        "{}",
    );
    for rows in ["C,S\n", "C,B\n"] {
        let report = import(&mut corpus, &desk.file("t.csv", &format!("{head}{rows}")), "{}");
        let found = report.findings.iter().find(|it| it.message.contains("no row here"));
        let found = found.expect("a finding");
        assert!(found.message.ends_with("were kept: B, C"), "{}", found.message);
        let remedy = found.remedy.as_ref().expect("a remedy").to_string();
        assert!(remedy.contains("chereme delete CORPUS sign:GLOSS"), "{remedy}");
        assert_eq!(total(&mut corpus, "gloss=C configuration=A"), 1);
    }
    let whole = desk.file("t.csv", &format!("{head}B,5\nC,B\nC,A\nD,A\n"));
    let report = import(&mut corpus, &whole, "{}");
    assert!(!messages(&report).contains("no row here"), "{}", messages(&report));
    assert_eq!(total(&mut corpus, ""), 5);
    // The first version again is a new version.
    let first = desk.file("t.csv", &format!("{head}B,5\nC,S\nC,A\n"));
    let report = import(&mut corpus, &first, "{}");
    assert_eq!(report.status, FileStatus::Imported);
    assert!(messages(&report).contains("were kept: D"), "{}", messages(&report));
    assert_eq!(total(&mut corpus, "gloss=C configuration=S"), 1);
    let report = import(&mut corpus, &first, "{}");
    assert_eq!(report.status, FileStatus::Unchanged);
}

#[test]
fn a_homonym_has_its_own_attributes_alone() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let text = "Gloss,Handshape,Location,Frequency,Iconicity\nBANK,B,chin,5.5,\nBANK,A,chest,,2.0\n";
    import(&mut corpus, &desk.file("t.csv", text), "{}");
    import(
        &mut corpus,
        &desk.file("take.eaf", &eaf(&[("Gloss", 0, 500, "BANK")])),
        "{}",
    );
    for (query, wanted) in [
        ("attribute.Iconicity<3 configuration=B", 0),
        ("attribute.Iconicity<3 configuration=A", 1),
        ("attribute.Frequency=* configuration=A", 0),
        ("attribute.Iconicity=unset", 1),
        ("attribute.Iconicity!=7", 2),
        ("attribute.Iconicity=2 attribute.Frequency=5.5 origin=captured", 1),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
}

#[test]
fn signs_without_a_gloss_under_two_names_are_two_signs() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let sign = |gloss: &str| {
        format!(
            "<sigml><hns_sign{gloss}><hamnosys_manual><hamflathand/><hamextfingeru/><hampalml/></hamnosys_manual></hns_sign></sigml>"
        )
    };
    fs::create_dir(desk.folder.path().join("b")).expect("made");
    for (name, text, status, signs) in [
        ("one.sigml", sign(""), FileStatus::Imported, 1),
        ("two.sigml", sign(""), FileStatus::Imported, 2),
        ("two.sigml", sign(""), FileStatus::Unchanged, 2),
        ("b/one.sigml", sign(""), FileStatus::Unchanged, 2),
        ("three.sigml", sign(" gloss=\"C\""), FileStatus::Imported, 3),
        ("four.sigml", sign(" gloss=\"C\""), FileStatus::Unchanged, 3),
    ] {
        let report = import(&mut corpus, &desk.file(name, &text), "{}");
        assert_eq!(report.status, status, "{name}: {}", messages(&report));
        assert_eq!(glosses(&corpus).len(), signs, "{name}");
    }
}

#[test]
fn queries_know_initial_values_and_movements_that_are_none() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let text = "Gloss,Handshape,Final handshape,Location,Final location,Movement,Repeated movement,Contact\n\
                A,B,S,chin,chest,None,yes,yes\nC,B,,chin,,arc,no,no\nD,S,B,chest,chin,,yes,yes\n";
    import(&mut corpus, &desk.file("t.csv", text), "{}");
    for (query, wanted) in [
        ("placement=chin > chest", 1),
        ("placement=chin > *", 1),
        ("configuration=B > S", 1),
        ("final.placement=chin", 2),
        ("final.configuration=B", 2),
        ("initial.placement=chin", 2),
        ("placement=chin", 3),
        ("movement=none", 1),
        ("movement=unset", 1),
        ("movement=*", 2),
        ("not movement=*", 1),
        ("movement.repeated=*", 3),
        ("placement.contact=*", 3),
        // Of the orientation, the corpus has neither values nor parts.
        ("orientation=unset", 3),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let tally = corpus.tally_values("", &["initial.placement".to_owned()], progress);
    let rows = tally.expect("counted").rows.into_iter();
    let rows: Vec<_> = rows.map(|row| (row.value, row.total)).collect();
    assert_eq!(rows, [("chin".to_owned(), 2), ("chest".to_owned(), 1)]);
    let out = desk.folder.path().join("tokens.csv");
    let options = ExportOptions::default();
    corpus
        .export_corpus(&ExportWhat::All, &out, &options, progress)
        .expect("exported");
    let written = fs::read_to_string(out).expect("read");
    assert!(
        written.contains("chin > chest") && written.contains("B > S"),
        "{written}"
    );
    // A final place that does not apply leaves one place.
    let mut minor = desk.corpus("e.chereme");
    let text = "Gloss,MinorLocation,SecondMinorLocation\nA,Palm,NA\nB,Palm,Wrist\nC,Chin,Palm\n";
    import(&mut minor, &desk.file("e.csv", text), "{}");
    for (query, wanted) in [
        ("final.placement.minor=Palm", 1),
        ("placement.minor=Palm > *", 1),
        ("placement.minor=Palm", 3),
    ] {
        assert_eq!(total(&mut minor, query), wanted, "{query}");
    }
    let coded = crate::db::signs::load_citation_tokens(minor.store.read_connection()).expect("tokens");
    let reader = crate::suggest::CodingReader::in_standing_words(&minor).expect("words");
    let coded = coded.iter().map(|token| reader.coding_of(token).expect("a coding"));
    let coded: Vec<String> = coded.map(|it| it["placement.minor"].clone()).collect();
    assert_eq!(coded, ["Palm", "Palm > Wrist", "Chin > Palm"]);
    // Where only parts are coded, they count.
    let mut parts = desk.corpus("d.chereme");
    import(
        &mut parts,
        &desk.file("d.csv", "Gloss,Movement direction\nA,up\nB,\n"),
        "{}",
    );
    for (query, wanted) in [("movement=*", 1), ("movement=unset", 1), ("movement=up", 1)] {
        assert_eq!(total(&mut parts, query), wanted, "{query}");
    }
}

#[test]
fn rows_with_ids_stay_themselves_whatever_changes_in_them() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let first = desk.file(
        "ids.csv",
        "Signbank ID,Gloss,Handshape\n77,BANK,B\n12,BANK,5\n31,CHAT,A\n40,CHIEN,A\n",
    );
    import(&mut corpus, &first, "{}");
    let tokens: BTreeMap<String, i64> = token_ids_by_attribute(&corpus, "Signbank ID");
    // Renamed, changed in its handshape, in another order, one gone, one new with the gloss of another.
    let text = "Signbank ID,Gloss,Handshape\n12,BANK,5\n99,BANK,A\n77,BENCH,B\n31,CHAT,5\n";
    let report = import(&mut corpus, &desk.file("ids.csv", text), "{}");
    let said = messages(&report);
    assert!(said.contains("1 new, 2 changed, 1 as before, 1 gone"), "{said}");
    let now = token_ids_by_attribute(&corpus, "Signbank ID");
    for id in ["77", "12", "31", "40"] {
        assert_eq!(now[id], tokens[id], "{id}");
    }
    assert_eq!(total(&mut corpus, "gloss=BENCH configuration=B"), 1);
    assert_eq!(total(&mut corpus, "gloss=BANK"), 2);
    assert_eq!(total(&mut corpus, "gloss=CHAT configuration=5"), 1);
    // Numbers of rows are no ids: the row that comes first now is not the first one of before.
    let second = desk.file("rows.csv", "id,Gloss,Handshape\n0,UN,B\n1,DEUX,5\n");
    import(&mut corpus, &second, "{}");
    let text = "id,Gloss,Handshape\n0,ZERO,A\n1,UN,B\n2,DEUX,5\n";
    let report = import(&mut corpus, &desk.file("rows.csv", text), "{}");
    assert!(!messages(&report).contains("recognised by"), "{}", messages(&report));
    assert_eq!(total(&mut corpus, "gloss=UN configuration=B"), 1);
}

/// Returns the rows of tokens by the text of an attribute.
fn token_ids_by_attribute(corpus: &Corpus, name: &str) -> BTreeMap<String, i64> {
    let connection = corpus.store.read_connection();
    let mut statement = connection
        .prepare("SELECT text, token_id FROM attribute WHERE name = ?1")
        .expect("a statement");
    let rows = statement.query_map([name], |row| Ok((row.get(0)?, row.get(1)?)));
    rows.expect("rows").collect::<Result<_, _>>().expect("read")
}

/// Returns the glosses of all signs with their numbers, in the order of lists.
fn labels(corpus: &Corpus) -> Vec<String> {
    let signs = corpus.load_corpus_overview(0).expect("an overview").signs;
    signs.into_iter().map(|sign| sign.gloss).collect()
}

#[test]
fn rows_of_one_gloss_with_ids_are_entries_of_their_own() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let head = "Signbank ID,Gloss,Handshape";
    let table = desk.file("t.csv", &format!("{head}\n77,BANK,B\n12,BANK,5\n31,CHAT,A\n"));
    let report = import(&mut corpus, &table, "{}");
    assert!(messages(&report).contains("BANK#2"), "{}", messages(&report));
    assert!(!messages(&report).contains("nothing keeps them apart"));
    let mut without_ids = desk.corpus("e.chereme");
    let joined = import(
        &mut without_ids,
        &desk.file("e.csv", "Gloss,Handshape\nBANK,B\nBANK,5\n"),
        "{}",
    );
    assert!(messages(&joined).contains("nothing keeps them apart: 1 (BANK, line 3)"));
    assert_eq!(labels(&corpus), ["BANK", "BANK#2", "CHAT"]);
    assert_eq!(pairs(&mut corpus, &["Handshape"]), (3, 3));
    let take = eaf(&[("Gloss", 0, 500, "BANK"), ("Gloss2", 600, 900, "BANK#2")]);
    let report = import(
        &mut corpus,
        &desk.file("take.eaf", &take),
        r#"{"tiers": {"Gloss2": "gloss"}}"#,
    );
    assert!(
        messages(&report).contains("which the first was taken: BANK"),
        "{}",
        messages(&report)
    );
    let lexicon = &corpus.list_lexicons().expect("lexicons")[0];
    assert_eq!((lexicon.signs, lexicon.homonyms, lexicon.guessed_tokens), (3, 1, 1));
    for (query, wanted) in [
        ("gloss=BANK", 4),
        ("sign=BANK#2", 2),
        ("sign=BANK#1", 2),
        ("sign=t/BANK#2", 2),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
    let answer = corpus
        .search_tokens("gloss=BANK#2", &SearchOptions::default())
        .expect("an answer");
    let hint = answer.findings[0].finding_message();
    assert!(
        answer.total == 0 && hint.contains("there are: sign=\"BANK#2\""),
        "{hint}"
    );
    let details = |corpus: &Corpus, name: &str| corpus.sign_details(&RowName::Text(name.to_owned()));
    let ambiguous = details(&corpus, "BANK").expect_err("two entries").to_string();
    assert!(
        ambiguous.contains("t/BANK#1") && ambiguous.contains("t/BANK#2"),
        "{ambiguous}"
    );
    let second = details(&corpus, "t/BANK#2").expect("an entry");
    assert_eq!((second.gloss.as_str(), second.tokens.len()), ("BANK#2", 2));
    // Another order of the rows and a new one change no number; without ids, the cells tell.
    let text = format!("{head}\n50,BANK,A\n12,BANK,5\n31,CHAT,A\n77,BANK,V\n");
    import(&mut corpus, &desk.file("t.csv", &text), "{}");
    assert_eq!(labels(&corpus), ["BANK", "BANK#2", "BANK#3", "CHAT"]);
    assert_eq!(total(&mut corpus, "sign=BANK#1 configuration=V"), 1);
    assert_eq!(total(&mut corpus, "sign=BANK#3 configuration=A"), 1);
    // Tables of tokens keep the numbers, in a corpus of their own, too.
    let out = desk.folder.path().join("out.csv");
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let exported = corpus.export_corpus(&ExportWhat::All, &out, &ExportOptions::default(), progress);
    exported.expect("exported");
    let mut other = desk.corpus("d.chereme");
    import(&mut other, &out, "{}");
    assert_eq!(labels(&other), ["BANK", "BANK#2", "BANK#3", "CHAT"]);
    // Renaming an entry renames the annotations of that entry, and gives it the number that is asked for.
    let rename = |corpus: &mut Corpus, from: &str, to: &str| {
        let change = SignChange {
            gloss: Some(to.to_owned()),
            ..SignChange::default()
        };
        corpus.change_sign(&RowName::Text(from.to_owned()), &change)
    };
    assert_eq!(rename(&mut corpus, "BANK#2", "RIVE").expect("renamed"), "RIVE");
    assert_eq!(total(&mut corpus, "sign=RIVE origin=captured"), 1);
    assert!(rename(&mut corpus, "RIVE", "BANK#3").is_err());
    assert_eq!(rename(&mut corpus, "RIVE", "BANK#2").expect("renamed"), "BANK#2");
    corpus.undo_operation().expect("undone");
    assert_eq!(labels(&corpus), ["BANK", "BANK#3", "CHAT", "RIVE"]);
    assert_whole(&mut corpus);
}

#[test]
fn entries_of_a_table_that_had_no_ids_part_when_it_has_them() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    import(
        &mut corpus,
        &desk.file("t.csv", "Gloss,Handshape\nBANK,B\nBANK,5\n"),
        "{}",
    );
    assert_eq!(labels(&corpus), ["BANK"]);
    let numbered = "Gloss,Handshape,homonym\nBANK,B,\nBANK,5,2\n";
    import(&mut corpus, &desk.file("t.csv", numbered), "{}");
    assert_eq!(labels(&corpus), ["BANK", "BANK#2"]);
    assert_eq!(total(&mut corpus, "sign=BANK#2 configuration=5"), 1);
    // The number is that of the entry, and no attribute.
    let attribute = corpus.search_tokens("attribute.homonym=*", &SearchOptions::default());
    assert!(attribute.is_err());
    // A table that lost the numbers keeps its rows where they are.
    import(
        &mut corpus,
        &desk.file("t.csv", "Gloss,Handshape\nBANK,A\nBANK,5\n"),
        "{}",
    );
    assert_eq!(labels(&corpus), ["BANK", "BANK#2"]);
    assert_eq!(total(&mut corpus, "sign=BANK#1 configuration=A"), 1);
    assert_whole(&mut corpus);
}
