//! Tests of lexicon rows: homonyms, spellings, attributes, notation in a wrong encoding; and the assignment of tokens
//! to several participants.

use super::*;
use crate::{ListFilter, ListKind, RowName, SignerChange, TierPropertyChange, TierRequestName};

fn total(corpus: &mut Corpus, query: &str) -> usize {
    let answer = corpus.search_tokens(query, &SearchOptions::default());
    answer.expect(query).total
}

#[test]
fn rows_of_one_gloss_are_entries_of_one_sign_even_on_a_second_import() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let rows = "drag\tB\t0.5\ndrag\tS\t2.5\nsee\tU\t1\n";
    let table = desk.file("lex.tsv", &format!("gloss\tHandshape\tFrequency\n{rows}"));
    let report = import(&mut corpus, &table, "{}");
    let forms = "nothing keeps them apart: 1 (drag, line 3)";
    assert!(
        report.findings.iter().any(|it| it.message.ends_with(forms)),
        "{:?}",
        report.findings
    );
    assert_eq!(total(&mut corpus, ""), 3);
    assert_eq!(total(&mut corpus, "gloss=drag"), 2);
    assert_eq!(total(&mut corpus, "gloss=drag configuration=S frequency>2"), 1);
    assert_eq!(total(&mut corpus, "gloss=drag configuration=B frequency>2"), 0);
    let rows = "drag\tB\t0.5\ndrag\tC\t3\nsee\tU\t1\nsee\tU\t9\n";
    let again = desk.file("lex.tsv", &format!("gloss\tHandshape\tFrequency\n{rows}"));
    import(&mut corpus, &again, "{}");
    for (query, wanted) in [
        ("", 4),
        ("gloss=drag", 2),
        ("configuration=S", 0),
        ("configuration=C frequency=3..3", 1),
        ("gloss=see frequency>5", 1),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
    assert_whole(&mut corpus);
    fs::create_dir(desk.folder.path().join("b")).expect("made");
    let other = desk.file("b/lex.tsv", "gloss\tHandshape\ndrag\tV\n");
    import(&mut corpus, &other, "{}");
    assert_eq!(
        total(&mut corpus, "gloss=drag"),
        3,
        "another file has entries of its own"
    );
    assert_eq!(
        total(&mut corpus, "gloss=drag frequency>=0"),
        2,
        "each row has its own attributes alone"
    );
}

#[test]
fn spellings_that_differ_only_in_case_are_kept() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let table = desk.file(
        "lex.tsv",
        "gloss\tHandedness\tHandshape\nA\t2s\tb\nC\t2s\tB\nD\t2S\tb\n",
    );
    import(&mut corpus, &table, "{}");
    for (query, wanted) in [
        ("configuration.handedness==2s", 2),
        ("configuration.handedness==2S", 1),
        ("configuration.handedness=2s", 3),
        ("dominant.configuration==b", 2),
        ("dominant.configuration==B", 1),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
    let again = desk.file(
        "lex.tsv",
        "gloss\tHandedness\tHandshape\nA\t2S\tb\nC\t2s\tB\nD\t2S\tb\n",
    );
    import(&mut corpus, &again, "{}");
    assert_eq!(total(&mut corpus, "configuration.handedness==2s"), 1);
    assert_whole(&mut corpus);
}

#[test]
fn a_value_of_a_table_is_not_equal_to_others_by_aliases_of_the_program() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let table = desk.file(
        "lex.tsv",
        "gloss\tHandshape\tLocation\nA\tP\tupper lip\nB\tK\tmouth\nC\tK\tmouth\nD\tK\tcheek\n\
         E\tK\tcheekbone\nF\tof-table\tof the table\n",
    );
    import(&mut corpus, &table, "{}");
    for (query, wanted, found) in [
        ("placement=\"upper lip\"", 1, ""),
        ("placement=mouth", 2, ""),
        ("placement==mouth", 2, ""),
        ("placement=cheekbone", 1, ""),
        ("placement=cheek", 1, ""),
        ("placement!=cheek placement==cheekbone", 1, ""),
        ("configuration=P", 1, ""),
        ("configuration=K", 4, ""),
        ("configuration==K", 4, ""),
        (
            "placement=\"lower lip\"",
            3,
            "equal to it by an alias, too: mouth (2), upper lip (1); placement== with one",
        ),
        (
            "placement==\"lower lip\"",
            3,
            "equal to it by an alias, too: mouth (2), upper lip (1); placement== with one",
        ),
        ("placement=bouche", 3, "equal to it by an alias, too: upper lip (1)"),
    ] {
        let answer = corpus.search_tokens(query, &SearchOptions::default());
        let answer = answer.expect(query);
        assert_eq!(answer.total, wanted, "{query}: {:?}", answer.findings);
        let messages: Vec<String> = answer.findings.iter().map(|it| it.finding_message()).collect();
        let says = match found {
            "" => messages.is_empty(),
            found => messages[0].contains(found),
        };
        assert!(says, "{query}: {messages:?}");
    }
}

#[test]
fn values_that_an_inventory_knows_stay_as_many_as_the_table_has() {
    let desk = Desk::new();
    let renamed = "other names for values, under which they are stored: ";
    // The values of a column (the program knows them all), the query of each value with its number of signs, and the finding.
    type Case<'t> = (&'t [&'t str], &'t [(&'t str, usize)], Option<&'t str>);
    let cases: [Case<'_>; 4] = [
        (
            &["upper lip", "lower lip", "mouth", "mouth"],
            &[("\"upper lip\"", 1), ("\"lower lip\"", 1), ("mouth", 2)],
            None,
        ),
        (
            &["cheekbone", "cheek", "chin"],
            &[("cheekbone", 1), ("cheek", 1), ("chin", 1)],
            None,
        ),
        (
            &["upper lip", "cheek", "throat"],
            &[("mouth", 1), ("cheek", 1), ("neck", 1)],
            Some("throat = neck, upper lip = mouth"),
        ),
        (&["mouth", "Cheek"], &[("mouth", 1), ("cheek", 1)], None),
    ];
    for (at, (values, queries, finding)) in cases.into_iter().enumerate() {
        let mut corpus = desk.corpus(&format!("{at}.chereme"));
        let rows = values.iter().enumerate();
        let rows: String = rows.map(|(row, value)| format!("G{row}\t{value}\n")).collect();
        let table = desk.file(&format!("{at}.tsv"), &format!("gloss\tLocation\n{rows}"));
        let report = import(&mut corpus, &table, "{}");
        for (value, wanted) in queries {
            assert_eq!(
                total(&mut corpus, &format!("placement=={value}")),
                *wanted,
                "{at} {value}"
            );
        }
        let messages = report.findings.iter().map(|it| it.message.as_str());
        let found = messages.filter_map(|it| Some(it.split_once(renamed)?.1)).next();
        assert_eq!(found, finding, "{:?}", report.findings);
    }
}

#[test]
fn numbers_of_a_column_are_read_by_what_its_commas_mean() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let table = desk.file(
        "lex.tsv",
        "gloss\tCorpus frequency\tZipf frequency\tShare\nA\t1,234\t1,234\t12 %\nB\t12,500\t2\t3.5%\n\
         C\t7\t3\t1 234\nD\t1,000,000\t4\t\n",
    );
    let report = import(&mut corpus, &table, "{}");
    for (query, wanted) in [
        ("attribute(\"Corpus frequency\")<20", 1),
        ("attribute(\"Corpus frequency\")>1000", 3),
        ("attribute(\"Zipf frequency\")<2", 1),
        ("attribute.Share>3", 3),
        ("attribute.Share>=1234", 1),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
    let unsure: Vec<_> = (report.findings.iter())
        .filter(|it| it.message.contains("thousands"))
        .collect();
    let [unsure] = &unsure[..] else {
        panic!("{:?}", report.findings);
    };
    assert_eq!(unsure.line, Some(2));
    assert!(unsure.message.contains("\"Zipf frequency\"") && unsure.message.contains("1.234"));
}

#[test]
fn glosses_that_differ_only_in_the_storage_of_accents_are_one_sign() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let one = desk.file("one.eaf", &eaf(&[("Gloss", 0, 500, "ÉTÉ")]));
    let two = desk.file("two.eaf", &eaf(&[("Gloss", 0, 500, "E\u{301}TE\u{301}")]));
    let table = desk.file("lex.tsv", "gloss\tHandshape\nE\u{301}TE\u{301}\tB\nÉTÉ\tS\n");
    for file in [one, two, table] {
        import(&mut corpus, &file, "{}");
    }
    assert_whole(&mut corpus);
    for query in ["gloss=ÉTÉ", "gloss=/ÉTÉ/", "gloss==ÉTÉ", "gloss==E\u{301}TE\u{301}"] {
        assert_eq!(total(&mut corpus, query), 4, "{query}");
    }
    let mut hear = crate::ignore_progress_step;
    let progress = &mut crate::ProgressReceiver::new(&mut hear);
    let tally = corpus.tally_values("", &["gloss".to_owned()], progress);
    assert_eq!(tally.expect("counted").rows.len(), 1);
    let citations = total(&mut corpus, "origin=lexicon");
    assert_eq!(citations, 2);
}

#[test]
fn attributes_are_kept_listed_and_found_and_can_be_undone() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let table = desk.file(
        "lex.tsv",
        "gloss\tMajorLocation.2.0\tMajorLocation.2.0Frequency\tSign Frequency\tClass\n\
         A\thead\t0.457\t4.10\tNoun\nB\tneutral\t0.1\t2\tVerb\nC\thead\t0.457\t\tminor verb\n",
    );
    let eaf = desk.file("take.eaf", &eaf(&[("Gloss", 0, 500, "A")]));
    import(&mut corpus, &table, "{}");
    import(&mut corpus, &eaf, "{}");
    for (query, wanted) in [
        ("attribute.MajorLocation.2.0Frequency>0.4", 3),
        ("attribute(\"sign frequency\")=4.1", 2),
        ("attribute.sign-frequency=2..4.1", 3),
        ("attribute.SignFrequency<4 origin=lexicon", 1),
        ("attribute.class=*verb", 2),
        ("class>1 or attribute.class=noun origin=captured", 1),
        ("attribute.class!=noun", 2),
        ("attribute.sign_frequency=unset", 1),
        ("not attribute.class=verb", 3),
        ("placement=0.457", 0),
        ("placement=*", 3),
    ] {
        let answer = corpus.search_tokens(query, &SearchOptions::default());
        match answer {
            Ok(answer) => assert_eq!(answer.total, wanted, "{query}"),
            Err(error) => assert_eq!(wanted, 0, "{query}: {error}"),
        }
    }
    let error = corpus
        .search_tokens("attribute.clas=noun", &SearchOptions::default())
        .expect_err("no such attribute");
    let message = format!("{error} {}", error.error_remedy().unwrap_or_default());
    assert!(
        message.contains("attribute.Class") && message.contains("Sign Frequency"),
        "{message}"
    );
    let listed = corpus
        .list_rows(
            ListKind::Signs,
            &ListFilter {
                columns: vec![("gloss".to_owned(), "A".to_owned())],
                ..ListFilter::default()
            },
        )
        .expect("listed");
    assert_eq!(
        listed.rows[0]["attributes"]["Sign Frequency"], "4.10",
        "letter by letter"
    );
    let info = corpus.load_corpus_info().expect("info").attributes;
    let reported: Vec<_> = info.iter().map(|it| (&*it.name, it.entries, it.greatest)).collect();
    assert_eq!(
        reported,
        [
            ("MajorLocation.2.0Frequency", 3, Some(0.457)),
            ("Sign Frequency", 2, Some(4.1)),
            ("Class", 3, None)
        ]
    );
    assert_whole(&mut corpus);
    let out = desk.folder.path().join("tokens.csv");
    let mut hear = ignore_progress_step;
    corpus
        .export_corpus(
            &ExportWhat::All,
            &out,
            &ExportOptions::default(),
            &mut ProgressReceiver::new(&mut hear),
        )
        .expect("exported");
    let mut elsewhere = desk.corpus("d.chereme");
    import(&mut elsewhere, &out, "{}");
    let again = elsewhere.load_corpus_info().expect("info").attributes;
    assert_eq!(again, info, "a table of tokens holds them, too");
    corpus.undo_operation().expect("undone");
    corpus.undo_operation().expect("undone");
    assert_eq!(corpus.load_corpus_info().expect("info").attributes, []);
}

#[test]
fn notation_in_a_wrong_encoding_is_mended_or_left_uncoded() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let symbols = "\u{e000}\u{e020}\u{e03c}\u{e049}\u{e0d1}";
    let latin: String = symbols.bytes().map(char::from).collect();
    let twice: String = latin.bytes().map(char::from).collect();
    let table = desk.file(
        "lex.tsv",
        &format!("gloss\tHamNoSys\nA\t{symbols}\nB\t{latin}\nC\t{twice}\nD\tîîî\nE\tsee the film\nF\t\n"),
    );
    let report = import(&mut corpus, &table, "{}");
    assert_eq!(total(&mut corpus, ""), 6);
    let coded = total(&mut corpus, "configuration=*");
    assert_eq!((coded, total(&mut corpus, "placement=*")), (3, 3));
    let messages: Vec<&str> = report.findings.iter().map(|it| &*it.message).collect();
    for (start, wanted) in [("D: its HamNoSys was saved", 1), ("E: \"see the film\"", 1)] {
        let count = messages.iter().filter(|it| it.starts_with(start)).count();
        assert_eq!(count, wanted, "{start}: {messages:?}");
    }
    let mended = messages.iter().filter(|it| it.contains("were mended")).count();
    assert_eq!(mended, 2, "{messages:?}");
    assert_whole(&mut corpus);
}

fn of_two_people() -> String {
    let tiers = [
        ("Gloss A", 0, 500, "BOL"),
        ("Gloss B", 0, 500, "CHAT"),
        ("Handshape A", 0, 500, "S"),
        ("Handshape B", 0, 500, "U"),
    ];
    let mut text = eaf(&tiers);
    for (name, _, _, _) in tiers {
        let who = if name.ends_with('A') { "ber-12" } else { "ber-13" };
        let tier = format!("TIER_ID=\"{name}\"");
        assert!(text.contains(&tier), "{text}");
        text = text.replace(&tier, &format!("{tier} PARTICIPANT=\"{who}\""));
    }
    text
}

#[test]
fn participants_of_a_file_are_signers_of_their_own_tokens() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    import(&mut corpus, &desk.file("talk.eaf", &of_two_people()), "{}");
    for (query, wanted) in [
        ("", 2),
        ("signer=ber-12", 1),
        ("participant=ber-13 gloss=CHAT", 1),
        ("signer=ber-13 gloss=BOL", 0),
        ("gloss=BOL configuration=S", 1),
        ("gloss=BOL configuration=U", 0),
        ("gloss=CHAT configuration=U", 1),
    ] {
        assert_eq!(total(&mut corpus, query), wanted, "{query}");
    }
    let signers = corpus
        .list_rows(ListKind::Signers, &ListFilter::default())
        .expect("listed");
    let reported: Vec<_> = (signers.rows.iter())
        .map(|row| (row["name"].as_str(), row["recordings"].as_i64(), row["tokens"].as_i64()))
        .collect();
    assert_eq!(
        reported,
        [(Some("ber-12"), Some(1), Some(1)), (Some("ber-13"), Some(1), Some(1))]
    );
    let change = SignerChange {
        name: Some("Anna".into()),
        ..SignerChange::default()
    };
    corpus
        .change_signer(&RowName::Text("ber-12".into()), &change)
        .expect("renamed");
    assert_eq!(total(&mut corpus, "signer=Anna gloss=BOL"), 1);
    let change = TierPropertyChange {
        participant: Some(Some(" Zoë ".into())),
        annotator: Some(Some("me".into())),
        language: Some(Some("fr".into())),
        ..TierPropertyChange::default()
    };
    let recording = RowName::Number(1);
    let tier = TierRequestName::parse_tier_name("Gloss B", Some(&recording)).expect("a name");
    let row = corpus.change_tier_properties(&tier, &change).expect("changed");
    assert_eq!(
        [row.participant, row.annotator, row.language].map(Option::unwrap_or_default),
        ["Zoë", "me", "fr"]
    );
    assert_eq!(total(&mut corpus, "signer=zoe gloss=CHAT"), 1);
    let row = corpus
        .change_tier_properties(
            &tier,
            &TierPropertyChange {
                participant: Some(None),
                ..TierPropertyChange::default()
            },
        )
        .expect("changed");
    assert_eq!(row.participant, None);
    assert_whole(&mut corpus);
}

#[test]
fn json_lines_are_read_entry_by_entry_or_refused() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let lines = "{\"gloss\": \"A\", \"Handshape\": \"U\"}\n{\"gloss\": \"B\", \"Handshape\": \"S\"}\n";
    let report = import(&mut corpus, &desk.file("lines.json", lines), "{}");
    assert_eq!(report.status, FileStatus::Imported, "{:?}", report.findings);
    for query in ["gloss=A configuration=U", "gloss=B configuration=S"] {
        assert_eq!(total(&mut corpus, query), 1, "{query}");
    }
    assert_eq!(total(&mut corpus, ""), 2);
    for (name, text, place) in [
        (
            "arrays.json",
            "[\"gloss\", \"Handshape\"]\n[\"C\", \"U\"]\n",
            "line 1, column 1",
        ),
        (
            "cut.json",
            "{\"gloss\": \"C\", \"Handshape\": \"U\"}\n{\"gloss\": \"D\"\n",
            "line 3, column 0",
        ),
    ] {
        let report = import(&mut corpus, &desk.file(name, text), "{}");
        assert_eq!(report.status, FileStatus::Refused, "{name}");
        let finding = &report.findings[0];
        assert!(finding.message.contains(place), "{}", finding.message);
        let remedy = finding.remedy.as_ref().map(ToString::to_string);
        assert!(remedy.is_some_and(|it| it.contains("on each line")));
    }
    assert_eq!(total(&mut corpus, ""), 2, "nothing of them was stored");
}

#[test]
fn rows_of_one_gloss_become_tokens_of_one_sign_with_one_citation_form() {
    const ROWS: u32 = 50;
    let desk = Desk::new();
    let found = |name: &str, gloss: &dyn Fn(u32) -> String| -> [u32; 3] {
        let mut corpus = desk.corpus(&format!("{name}.chereme"));
        let rows: String = (0..ROWS).map(|row| format!("{},U,x\n", gloss(row))).collect();
        let table = desk.file(&format!("{name}.csv"), &format!("gloss,Handshape,Class\n{rows}"));
        import(&mut corpus, &table, "{}");
        let list = "SELECT count(*), sum(citation), count(DISTINCT sign_id) FROM token";
        let found =
            (corpus.store.read_connection()).query_row(list, [], |row| Ok([row.get(0)?, row.get(1)?, row.get(2)?]));
        found.expect("counted")
    };
    let many = found("many", &|row| format!("G{row}"));
    assert_eq!(many, [ROWS, ROWS, ROWS]);
    let one = found("one", &|_| "A".to_owned());
    assert_eq!(one, [ROWS, 1, 1]);
}
