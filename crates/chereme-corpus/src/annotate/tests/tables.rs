//! Tests of tables that name an annotation by its id and say where it lies.

use super::*;

#[test]
fn an_annotation_named_by_its_id_must_be_where_its_row_says() {
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, "add G 0-100 BOL; add H 0-100 CHAT").expect("added");
    let options = AnnotateOptions::default();
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let there = "annotation:1 is on the tier \"G\" of recording:1 (\"Take 1\")";
    let before = rows(corpus.store.read_connection());
    for (row, named) in [
        ("set,recording:99,Nope,WRONG,annotation:1", "recording:99"),
        ("remove,recording:99,,,annotation:1", "recording:99"),
        ("set,Take 2,G,WRONG,annotation:1", "recording:\"Take 2\""),
        ("set,,Nope,WRONG,annotation:1", "the tier \"Nope\""),
        ("set,Take 1,H,WRONG,annotation:1", "the tier \"H\""),
        ("set,Take 1,tier:2,WRONG,1", "the tier \"tier:2\""),
        ("remove,,H,,1", "the tier \"H\""),
    ] {
        // The first change is sound, and is not made either.
        let table = format!("action,recording,tier,value,id\nset,,,CHIEN,annotation:2\n{row}\n");
        let error = corpus
            .annotate_table(table.as_bytes(), "t.csv", None, &options, &mut progress)
            .expect_err(row);
        let want = format!("t.csv, line 3: the row names {named}, but {there}");
        assert!(error.to_string().contains(&want), "{want} in\n{error}");
        let CorpusError::Several { errors, .. } = error else {
            panic!("one error of one row: {row}");
        };
        let remedy = errors[0].error_remedy().map(|it| it.to_string());
        assert!(remedy.is_some_and(|it| it.contains("correct the row")), "{row}");
        assert_eq!(rows(corpus.store.read_connection()), before, "{row}");
    }
    for row in [
        "set,,,A,annotation:1",
        "set,Take 1,G,B,annotation:1",
        "set,recording:1,tier:1,C,1",
        "set,,g,D,1",
    ] {
        let table = format!("action,recording,tier,value,id\n{row}\n");
        corpus
            .annotate_table(table.as_bytes(), "t.csv", None, &options, &mut progress)
            .expect(row);
    }
    assert_eq!(shown(&corpus), "G 1 0-100 D; H 2 0-100 CHAT");
}

#[test]
fn a_table_may_add_the_tiers_that_it_needs_in_the_same_step() {
    let (_folder, mut corpus) = corpus();
    let before = rows(corpus.store.read_connection());
    let table = "recording,tier,start,end,value\nTake 1,Mouth,0,1,a\nrecording:1,Mouth,1,2,b\nTake 1,g,0,1,BOL\n";
    let mut hear = ignore_progress_step;
    let mut progress = ProgressReceiver::new(&mut hear);
    let mut write = |corpus: &mut Corpus, add_tiers| {
        let options = AnnotateOptions {
            add_tiers,
            ..AnnotateOptions::default()
        };
        corpus.annotate_table(table.as_bytes(), "t.csv", None, &options, &mut progress)
    };
    let error = write(&mut corpus, false).expect_err("no such tier");
    assert!(error.to_string().contains("has no tier \"Mouth\""), "{error}");
    assert_eq!(rows(corpus.store.read_connection()), before);
    let (report, _) = write(&mut corpus, true).expect("written");
    let added: Vec<_> = report
        .added_tiers
        .iter()
        .map(|row| (row.recording, row.tiers.clone()))
        .collect();
    assert_eq!((report.added, added), (3, vec![(1, vec!["Mouth".to_owned()])]));
    let name = RowName::Number(1);
    let name = TierRequestName::parse_tier_name("Mouth", Some(&name)).expect("a name");
    let tier = annotate_names::find_named_tier(corpus.store.read_connection(), &name).expect("a tier");
    assert_eq!(tier.tier_topic().to_string(), "nonmanual.mouth");
    corpus.undo_operation().expect("undone");
    assert_eq!(rows(corpus.store.read_connection()), before);
}
