//! Tests of tables of annotations that name their recordings.

use super::again::{choose, has, take};
use super::*;
use crate::annotate::AnnotateOptions;

/// Returns tier, times in milliseconds and value of every annotation, by recording and tier.
fn annotations(corpus: &Corpus) -> Vec<String> {
    use crate::db::stored_tiers;
    let connection = corpus.store.read_connection();
    let mut all = Vec::new();
    for recording in recordings_of(corpus) {
        for tier in stored_tiers::load_tier_rows(connection, recording).expect("tiers") {
            let rows = stored_tiers::load_tier_annotation_rows(connection, tier.id).expect("annotations");
            all.extend(rows.iter().map(|row| {
                let times = (row.start_us / 1000, row.end_us / 1000);
                format!("{recording} {} {}-{} {}", tier.name, times.0, times.1, row.value)
            }));
        }
    }
    all
}

/// Returns a corpus with two recordings, `a` and `b`, whose files lie beside it.
fn corpus_of_two(desk: &Desk) -> Corpus {
    let mut corpus = desk.corpus("c.chereme");
    for name in ["a.eaf", "b.eaf"] {
        import(&mut corpus, &desk.file(name, &eaf(&[("Notes", 0, 4000, name)])), "{}");
    }
    corpus
}

const TABLE: &str = "recording,tier,start,end,value\na,Gloss,0,1,CHAT\na,Gloss,1,2,CHIEN\nb,Mouthing,0.5,1,chat\n";

#[test]
fn a_folder_brings_recordings_and_the_table_of_their_annotations_in_one_step() {
    let desk = Desk::new();
    let folder = desk.folder.path().join("takes");
    fs::create_dir(&folder).expect("a folder");
    for name in ["a.eaf", "b.eaf"] {
        fs::write(folder.join(name), eaf(&[("Notes", 0, 4000, name)])).expect("written");
    }
    // The table comes first by its name, and its recordings are read before it.
    fs::write(folder.join("0.csv"), TABLE).expect("written");
    let mut corpus = desk.corpus("c.chereme");
    let report = take(&mut corpus, std::slice::from_ref(&folder), &choose(OwnEdits::Ask));
    assert!(!report.has_refusals(), "{report:?}");
    assert_eq!((report.created["recordings"], report.created["annotations"]), (2, 5));
    let all = annotations(&corpus);
    let glosses: Vec<&String> = all.iter().filter(|row| !row.contains("Notes")).collect();
    let wanted = [
        "1 Gloss 0-1000 CHAT",
        "1 Gloss 1000-2000 CHIEN",
        "2 Mouthing 500-1000 chat",
    ];
    assert_eq!(glosses, wanted);
    assert!(
        roles(&corpus).iter().any(|role| role.contains("gloss")),
        "{:?}",
        roles(&corpus)
    );
    assert_whole(&mut corpus);
    let again = take(&mut corpus, std::slice::from_ref(&folder), &choose(OwnEdits::Ask));
    assert!(
        again.files.iter().all(|file| file.status == FileStatus::Unchanged),
        "{again:?}"
    );
    corpus.undo_operation().expect("undone");
    assert!(recordings_of(&corpus).is_empty());
}

#[test]
fn an_edited_table_adds_its_new_rows_and_asks_before_it_changes_annotations() {
    for (own_edits, status, kept, edits) in [
        (OwnEdits::Ask, FileStatus::Refused, &["1 Gloss 1000-2000 CHIEN"][..], 1),
        (OwnEdits::Mine, FileStatus::Unchanged, &["1 Gloss 1000-2000 CHIEN"], 1),
        (
            OwnEdits::Merge,
            FileStatus::Updated,
            &["1 Gloss 1000-2000 CHIEN", "2 Mouthing 2000-3000 new"],
            1,
        ),
        (
            OwnEdits::Theirs,
            FileStatus::Updated,
            &["1 Gloss 1000-2500 CHIEN-2", "2 Mouthing 2000-3000 new"],
            1,
        ),
    ] {
        let desk = Desk::new();
        let mut corpus = corpus_of_two(&desk);
        let path = desk.file("t.csv", TABLE);
        let first = import(&mut corpus, &path, "{}");
        assert_eq!(first.status, FileStatus::Imported, "{:?}", first.findings);
        let guess = "guessed from their names: Gloss, Mouthing";
        assert!(has(&first.findings, guess), "{:?}", first.findings);
        // A row that the table does not have any more takes nothing away.
        let edited = TABLE
            .replace("1,2,CHIEN", "1,2.5,CHIEN-2")
            .replace("a,Gloss,0,1,CHAT\n", "");
        desk.file("t.csv", &(edited + "b,Mouthing,2,3,new\n"));
        let before = annotations(&corpus);
        let options = ImportOptions {
            dry_run: true,
            ..choose(own_edits)
        };
        let tried = take(&mut corpus, std::slice::from_ref(&path), &options);
        assert_eq!((tried.files[0].status, annotations(&corpus)), (status, before));
        let report = take(&mut corpus, std::slice::from_ref(&path), &choose(own_edits));
        assert_eq!(
            (report.files[0].status, report.files[0].edits.len()),
            (status, edits),
            "{own_edits:?}"
        );
        let mut wanted = vec![
            "1 Gloss 0-1000 CHAT",
            "1 Notes 0-4000 a.eaf",
            "2 Mouthing 500-1000 chat",
            "2 Notes 0-4000 b.eaf",
        ];
        wanted.extend(kept);
        wanted.sort_unstable();
        let mut all = annotations(&corpus);
        all.sort();
        assert_eq!(all, wanted, "{own_edits:?}");
        assert_whole(&mut corpus);
    }
}

#[test]
fn an_unchanged_table_takes_no_edit_back_and_says_what_differs() {
    let desk = Desk::new();
    let mut corpus = corpus_of_two(&desk);
    let path = desk.file("t.csv", TABLE);
    import(&mut corpus, &path, "{}");
    again::edit(&mut corpus, "chat", Some("mine"));
    let before = annotations(&corpus);
    let report = import(&mut corpus, &path, "{}");
    assert_eq!((report.status, annotations(&corpus)), (FileStatus::Unchanged, before));
    assert!(
        has(&report.findings, "does not have as they are: 1"),
        "{:?}",
        report.findings
    );
    // Its texts are those of its recordings alone, which may be withheld or forgotten.
    let kept: i64 = corpus
        .store
        .read_connection()
        .query_row("SELECT count(data) FROM source_file WHERE name = 't.csv'", [], |row| {
            row.get(0)
        })
        .expect("a count");
    assert_eq!(kept, 0);
}

#[test]
fn rows_that_the_corpus_has_already_are_not_added_twice() {
    let desk = Desk::new();
    let mut corpus = corpus_of_two(&desk);
    let options = AnnotateOptions {
        add_tiers: true,
        ..AnnotateOptions::default()
    };
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let written = corpus.annotate_table(TABLE.as_bytes(), "t.csv", None, &options, &mut progress);
    written.expect("written");
    // A child hangs below a row that stands already, which it names by the id in the table.
    let table = "action,recording,tier,start,end,value,id\nadd,a.eaf,Gloss,0,1,CHAT,x\nadd,b,Mouthing,2,3,y,\n";
    let report = import(&mut corpus, &desk.file("t.csv", table), "{}");
    assert_eq!(report.status, FileStatus::Imported, "{:?}", report.findings);
    assert!(
        has(&report.findings, "what the corpus has already: 1"),
        "{:?}",
        report.findings
    );
    assert_eq!(annotations(&corpus).len(), 6);
}

#[test]
fn wrong_rows_are_named_with_their_lines_and_nothing_is_written() {
    let desk = Desk::new();
    let mut corpus = corpus_of_two(&desk);
    let before = annotations(&corpus);
    let table = TABLE.to_owned() + "nobody,Gloss,0,1,X\na,Gloss,0.5,3,X\na,Gloss,3,2,X\n";
    let report = import(&mut corpus, &desk.file("t.csv", &table), "{}");
    assert_eq!(report.status, FileStatus::Refused);
    for line in ["t.csv, line 5", "t.csv, line 6", "t.csv, line 7"] {
        assert!(has(&report.findings, line), "{line} {:?}", report.findings);
    }
    assert_eq!(annotations(&corpus), before);
    assert_eq!(roles(&corpus).len(), 2, "no tier stays behind");
}

#[test]
fn a_table_is_one_of_annotations_only_if_its_titles_say_so() {
    let desk = Desk::new();
    for (name, text, expected) in [
        ("a.csv", TABLE, true),
        (
            "b.tsv",
            "File\tTier\tBegin Time - msec\tEnd Time - msec\tAnnotation\na.eaf\tG\t0\t5\tX\n",
            true,
        ),
        ("c.txt", "enregistrement;piste;début;fin;valeur\na;G;0;1;X\n", true),
        ("d.csv", "action,tier,start,value\nset,Gloss,1,X\n", true),
        ("e.csv", "tier,start,end,value\nG,0,1,X\n", false),
        ("f.csv", "gloss,handshape,recording,id\nCHAT,5,a.mp4,3\n", false),
        ("g.csv", "name,region,file,start\nAda,north,x,1\n", false),
        ("h.csv", "time,wrist_x,wrist_y,wrist_z\n0,1,2,3\n", false),
        ("i.tsv", "G\t0.0\t1.0\tX\n", false),
        ("j.csv", "recording,gloss,translation,tier\na,CHAT,cat,1\n", false),
        ("k.csv", "", false),
    ] {
        let path = desk.file(name, text);
        assert_eq!(import_changes::is_change_table(&path), expected, "{text}");
        let reader = readers::find_reader_index(&path).map(|index| FILE_READERS[index].kind);
        assert_eq!(
            reader == Some(import_changes::CHANGE_TABLE_KIND),
            expected,
            "{text} {reader:?}"
        );
    }
}

#[test]
fn the_file_of_a_second_annotator_brings_readings_of_its_own() {
    let desk = Desk::new();
    let mut corpus = desk.corpus("c.chereme");
    let by = |who: &str, rows: &[(&str, i64, i64, &str)]| {
        eaf(rows).replace("TIER_ID=", &format!("ANNOTATOR=\"{who}\" TIER_ID="))
    };
    let glosses = ("Gloss", 0, 1000, "BOOK");
    let anna = desk.file(
        "anna.eaf",
        &by("Anna", &[glosses, ("Configuration right", 0, 1000, "B")]),
    );
    take(&mut corpus, &[anna], &choose(OwnEdits::Ask));
    let options = ImportOptions {
        into: Some(crate::RowName::Text("anna".into())),
        ..choose(OwnEdits::Ask)
    };
    // The second version of the file updates the second annotator's tier, too.
    for (value, edits) in [("C", OwnEdits::Ask), ("S", OwnEdits::Ask)] {
        let ben = desk.file(
            "ben.eaf",
            &by("Ben", &[glosses, ("Configuration right", 0, 1000, value)]),
        );
        let options = ImportOptions {
            own_edits: edits,
            ..options.clone()
        };
        let report = take(&mut corpus, &[ben], &options);
        assert!(!report.has_refusals(), "{report:?}");
        let wanted = [
            "1 Gloss 0-1000 BOOK".to_owned(),
            "1 Configuration right 0-1000 B".to_owned(),
            format!("1 Configuration right (Ben) 0-1000 {value}"),
        ];
        assert_eq!(annotations(&corpus), wanted);
    }
    let mut count = |query: &str| {
        corpus
            .search_tokens(query, &crate::SearchOptions::default())
            .expect(query)
            .total
    };
    assert_eq!(count("disputed:yes"), 1);
    assert_eq!(count("configuration=S{by=Ben}"), 1);
    assert_eq!(count("configuration=B{by=Anna}"), 1);
}
