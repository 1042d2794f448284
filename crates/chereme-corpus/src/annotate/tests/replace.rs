//! Tests of replacing values, shifting tiers, and annotations that move out of the way.

use super::*;
use crate::annotate::replace::{TierSelection, ValueSearch};

fn on(tiers: &[&str]) -> TierSelection {
    TierSelection {
        recording: Some(RowName::Text(RECORDING.into())),
        tiers: tiers.iter().map(|name| (*name).to_owned()).collect(),
    }
}

fn replace(
    corpus: &mut Corpus,
    find: &ValueSearch,
    with: &str,
    tiers: &[&str],
    dry: bool,
) -> CorpusResult<Vec<String>> {
    let mut hear = ignore_progress_step;
    let progress = &mut ProgressReceiver::new(&mut hear);
    let done = corpus.replace_values(find, with, &on(tiers), dry, progress)?;
    assert_eq!(done.changed, done.values.len() as u64);
    Ok(done
        .values
        .iter()
        .map(|it| format!("{} {}>{}", it.tier, it.from, it.to))
        .collect())
}

#[test]
fn values_are_replaced_as_one_operation_and_a_dry_run_only_reports_it() {
    let (_folder, mut corpus) = corpus();
    annotate(
        &mut corpus,
        "add G 0-100 BOL-A; add G 200-300 BOL; add H 0-100 BOL; add L 0-100 chin",
    )
    .expect("added");
    let before = shown(&corpus);
    let text = |text: &str| ValueSearch::Text(text.to_owned());
    let pattern = |text: &str| ValueSearch::from_value_pattern(text).expect("a pattern");
    let operations = corpus.count_undo_steps().expect("steps").0;
    let cases: [(ValueSearch, &str, &[&str], &[&str]); 9] = [
        (text("BOL"), "TASSE", &["G"], &["G BOL-A>TASSE-A", "G BOL>TASSE"]),
        (text("bol"), "TASSE", &["G"], &[]),
        (text(""), "x", &["G"], &[]),
        (
            ValueSearch::Whole("BOL".into()),
            "TASSE",
            &["G", "H"],
            &["G BOL>TASSE", "H BOL>TASSE"],
        ),
        (pattern("^BO(.)"), "$1", &["*"], &["G BOL-A>L-A", "G BOL>L", "H BOL>L"]),
        (pattern("^B(O)"), "$1OX$$", &["H"], &["H BOL>OOX$L"]),
        (pattern("^(?<x>B)O"), "${x}_$x", &["H"], &["H BOL>B_BL"]),
        (pattern("-.$"), "", &[], &["G BOL-A>BOL"]),
        (text("chin"), "a $1", &["l"], &["L chin>a $1"]),
    ];
    for (find, with, tiers, want) in cases {
        let reported = replace(&mut corpus, &find, with, tiers, true).expect("tried");
        assert_eq!(reported, want, "{find:?}");
        assert_eq!(shown(&corpus), before, "a dry run writes nothing");
        assert_eq!(corpus.count_undo_steps().expect("steps").0, operations);
        assert_eq!(replace(&mut corpus, &find, with, tiers, false).expect("done"), want);
        if !want.is_empty() {
            assert_ne!(shown(&corpus), before);
            corpus.undo_operation().expect("undone");
            assert_eq!(shown(&corpus), before, "one operation");
        }
    }
}

#[test]
fn a_replacement_with_one_invalid_value_is_refused_whole() {
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, "add C 0-100 U; add G 0-100 U").expect("added");
    let before = shown(&corpus);
    for dry in [true, false] {
        let find = ValueSearch::Text("U".into());
        let error = replace(&mut corpus, &find, "no such shape", &["C", "G"], dry).expect_err("refused");
        assert!(error.to_string().contains("no value of the inventory"), "{error}");
        assert_eq!(shown(&corpus), before);
    }
    let gone = replace(&mut corpus, &ValueSearch::Text("U".into()), "V", &["Q"], true).expect_err("no tier");
    assert!(gone.to_string().contains("no tier \"Q\""), "{gone}");
    for with in ["$2", "$name", "${1", "$"] {
        let find = ValueSearch::from_value_pattern("(U)").expect("a pattern");
        let error = replace(&mut corpus, &find, with, &["G"], false).expect_err(with);
        assert!(error.to_string().contains("names the group"), "{error}");
        assert_eq!(shown(&corpus), before);
    }
    let bad = ValueSearch::from_value_pattern("(").expect_err("no pattern");
    assert!(bad.error_remedy().is_some(), "{bad}");
}

#[test]
fn tiers_are_shifted_with_their_child_tiers() {
    let (_folder, mut corpus) = corpus();
    annotate(
        &mut corpus,
        "add G 100-200 A; add G 200-400 B; add I 220-300 b; add H 0-50 C",
    )
    .expect("added");
    let before = shown(&corpus);
    let shift = |corpus: &mut Corpus, tiers: &[&str], by: i64, dry: bool| {
        let mut hear = ignore_progress_step;
        corpus.shift_tiers(&on(tiers), by * 1000, dry, &mut ProgressReceiver::new(&mut hear))
    };
    shift(&mut corpus, &["G"], 50, true).expect("tried");
    assert_eq!(shown(&corpus), before);
    shift(&mut corpus, &["G", "I"], 50, false).expect("shifted");
    assert_eq!(
        shown(&corpus),
        "G 1 150-250 A; G 2 250-450 B; H 4 0-50 C; I 3<2 270-350 b"
    );
    shift(&mut corpus, &["G"], -50, false).expect("shifted back");
    assert_eq!(shown(&corpus), before);
    shift(&mut corpus, &[], 1000, false).expect("all of it");
    assert_eq!(
        shown(&corpus),
        "G 1 1100-1200 A; G 2 1200-1400 B; H 4 1000-1050 C; I 3<2 1220-1300 b"
    );
    corpus.undo_operation().expect("undone");
    assert_eq!(shown(&corpus), before, "one operation");
    for (by, most) in [(-101, "-0.100s"), (9_700, "9.600s")] {
        let error = shift(&mut corpus, &["G"], by, false).expect_err("too far");
        let remedy = error.error_remedy().expect("a remedy");
        assert!(remedy.remedy_text().contains(most), "{remedy}");
    }
    assert!(shift(&mut corpus, &["I"], 500, false).is_err(), "out of the one above");
    assert_eq!(shown(&corpus), before);
}

fn with_mode(corpus: &mut Corpus, mode: NeighbourMode, text: &str) -> CorpusResult<AnnotateReport> {
    let options = AnnotateOptions {
        mode,
        ..AnnotateOptions::default()
    };
    let mut hear = ignore_progress_step;
    corpus.annotate_corpus(&[action(text).into()], &options, &mut ProgressReceiver::new(&mut hear))
}

#[test]
fn annotations_in_the_path_are_pushed_or_shifted() {
    let start = "add G 0-100 A; add G 150-250 B; add G 300-400 C; add I 310-390 c";
    for (mode, text, want) in [
        (
            NeighbourMode::Bulldozer,
            "set 2 150-340",
            "G 1 0-100; G 2 150-340; G 3 340-440; I 4 350-430",
        ),
        (
            NeighbourMode::Shift,
            "set 2 150-340",
            "G 1 0-100; G 2 150-340; G 3 390-490; I 4 400-480",
        ),
        (
            NeighbourMode::Bulldozer,
            "set 1 60-160",
            "G 1 60-160; G 2 160-260; G 3 300-400; I 4 310-390",
        ),
        (
            NeighbourMode::Bulldozer,
            "set 2 200-350",
            "G 1 0-100; G 2 200-350; G 3 350-450; I 4 360-440",
        ),
        (
            NeighbourMode::Bulldozer,
            "add G 120-200 N",
            "G 1 0-100; G 5 120-200; G 2 200-300; G 3 300-400; I 4 310-390",
        ),
        (
            NeighbourMode::Shift,
            "add G 120-200 N",
            "G 1 0-100; G 5 120-200; G 2 200-300; G 3 350-450; I 4 360-440",
        ),
    ] {
        let (_folder, mut corpus) = corpus();
        annotate(&mut corpus, start).expect("added");
        with_mode(&mut corpus, mode, text).expect("made");
        let spans = strings(
            corpus.store.read_connection(),
            "SELECT t.name || ' ' || a.id || ' ' || (a.start_us / 1000) || '-' || (a.end_us / 1000)
             FROM annotation a JOIN tier t ON t.id = a.tier_id ORDER BY t.id, a.start_us",
        );
        assert_eq!(spans.join("; "), want, "{mode:?} {text}");
        corpus.undo_operation().expect("undone");
        assert!(shown(&corpus).contains("G 2 150-250 B"), "one operation");
    }
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, start).expect("added");
    for (mode, text) in [
        (NeighbourMode::Normal, "set 2 150-340"),
        (NeighbourMode::Bulldozer, "set 2 150-9990"),
        (NeighbourMode::Shift, "set 3 50-120"),
        (NeighbourMode::Shift, "add G 50-120 N"),
    ] {
        let error = with_mode(&mut corpus, mode, text).expect_err(text);
        assert!(error.error_remedy().is_some(), "{error}");
    }
}

#[test]
fn an_overlap_names_the_other_annotation_and_the_free_time() {
    let (_folder, mut corpus) = corpus();
    annotate(&mut corpus, "add G 780-4090 SO; add G 5000-10000 END; add T 780-4090 x").expect("added");
    for (text, message, remedy) in [
        (
            "add G 1000-2000 N",
            "a new annotation from 1.000s to 2.000s overlaps \"SO\" (0.780s to 4.090s) on the tier \"G\" of \"Take 1\"",
            "free next to it: 0.000s to 0.780s, 4.090s to 5.000s",
        ),
        (
            "set 1 4000-6000",
            "\"SO\" from 4.000s to 6.000s overlaps \"END\" (5.000s to 10.000s) on the tier \"G\" of \"Take 1\"",
            "free next to it: 4.090s to 5.000s",
        ),
    ] {
        let error = annotate(&mut corpus, text).expect_err(text);
        assert_eq!(error.to_string(), message);
        assert_eq!(error.error_remedy(), Some(remedy.into()));
    }
    for text in ["split 3 5000", "add T 900-1000 y; add T 950-1000 z", "set 3 0-500"] {
        let error = annotate(&mut corpus, text).expect_err(text).to_string();
        assert!(!error.contains("annotation:") && !error.contains("tier:"), "{error}");
    }
}
