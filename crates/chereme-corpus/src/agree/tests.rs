//! Agreement on small corpora: figures by hand, names of tiers, the list of disagreements, adjudication.

use std::fmt::Write as _;
use std::ops::ControlFlow;

use super::{AgreeOptions, AnnotatorAgreement, DisagreementKind};
use crate::{
    ConflictDecision, Corpus, CorpusError, ImportOptions, ProgressReceiver, ProgressStep, RowName, TierPropertyChange,
    TierRequestName, ignore_progress_step,
};
use chereme_sign::{SignComponent, TierRole};

/// A tier: its name, its annotator, and its annotations with start, end and value.
type Tier<'a> = (&'a str, &'a str, &'a [(i64, i64, &'a str)]);

/// Returns an EAF file with these tiers.
fn eaf(tiers: &[Tier<'_>]) -> String {
    let (mut slots, mut body, mut number) = (String::new(), String::new(), 0);
    for (name, annotator, annotations) in tiers {
        let by = match annotator.is_empty() {
            true => String::new(),
            false => format!(" ANNOTATOR=\"{annotator}\""),
        };
        let _ = write!(body, "<TIER LINGUISTIC_TYPE_REF=\"t\" TIER_ID=\"{name}\"{by}>");
        for (start, end, value) in *annotations {
            number += 2;
            let (from, to) = (number - 1, number);
            for (slot, time) in [(from, start), (to, end)] {
                let _ = write!(slots, "<TIME_SLOT TIME_SLOT_ID=\"ts{slot}\" TIME_VALUE=\"{time}\"/>");
            }
            let _ = write!(
                body,
                "<ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID=\"a{number}\" TIME_SLOT_REF1=\"ts{from}\" \
                 TIME_SLOT_REF2=\"ts{to}\"><ANNOTATION_VALUE>{value}</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>"
            );
        }
        body.push_str("</TIER>");
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><ANNOTATION_DOCUMENT AUTHOR=\"\" DATE=\"2026-01-01T00:00:00+00:00\" \
         FORMAT=\"3.0\" VERSION=\"3.0\"><HEADER MEDIA_FILE=\"\" TIME_UNITS=\"milliseconds\"/><TIME_ORDER>{slots}</TIME_ORDER>\
         {body}<LINGUISTIC_TYPE GRAPHIC_REFERENCES=\"false\" LINGUISTIC_TYPE_ID=\"t\" TIME_ALIGNABLE=\"true\"/>\
         </ANNOTATION_DOCUMENT>"
    )
}

struct Desk {
    corpus: Corpus,
    _folder: tempfile::TempDir,
}

/// Returns a corpus with a recording for each list of tiers, named `one`, `two` and so on.
fn desk(recordings: &[&[Tier<'_>]]) -> Desk {
    let folder = tempfile::tempdir().expect("a folder");
    let mut corpus = Corpus::create_corpus(&folder.path().join("c.chereme"), "Cleo").expect("made");
    for (name, tiers) in ["one", "two", "three"].iter().zip(recordings) {
        let path = folder.path().join(format!("{name}.eaf"));
        std::fs::write(&path, eaf(tiers)).expect("written");
        let mut hear = ignore_progress_step;
        let report = corpus
            .import_paths(
                &[path],
                &ImportOptions::default(),
                &mut ProgressReceiver::new(&mut hear),
            )
            .expect("imported");
        assert_eq!(report.created["recordings"], 1);
    }
    Desk {
        corpus,
        _folder: folder,
    }
}

fn agree(corpus: &Corpus, options: &AgreeOptions) -> AnnotatorAgreement {
    let mut hear = ignore_progress_step;
    corpus
        .compare_annotators(options, &mut ProgressReceiver::new(&mut hear))
        .expect("compared")
}

fn figure(found: &AnnotatorAgreement, name: &str) -> Option<f64> {
    let figure = found.measures.iter().find(|(own, _)| *own == name);
    figure.unwrap_or_else(|| panic!("no {name}")).1.value
}

const A: &[(i64, i64, &str)] = &[
    (0, 1000, "X"),
    (1000, 2000, "Y"),
    (2500, 3500, "X"),
    (4000, 5000, "Y"),
    (6000, 6500, "Z"),
];
const B: &[(i64, i64, &str)] = &[
    (20, 1000, "X"),
    (1000, 2000, "X"),
    (2500, 3700, "X"),
    (4000, 5000, "Y"),
    (8000, 8400, "Z"),
];

#[test]
fn counts_values_and_disagreements_of_a_case_by_hand() {
    let desk = desk(&[&[("A", "", A), ("B", "", B)]]);
    let found = agree(&desk.corpus, &AgreeOptions::new("A", "B"));
    let counts = &found.counts;
    assert_eq!((counts.units_a, counts.units_b), (5, 5));
    assert_eq!((counts.matched, counts.equal), (4, 3));
    assert_eq!((counts.unmatched_a, counts.unmatched_b), (1, 1));
    assert!(found.counts_only, "five units are few");
    // 3 equal pairs of 10 annotations, two each; 4 pairs, 3 of them equal.
    assert_eq!(figure(&found, "raw"), Some(0.6));
    assert_eq!(figure(&found, "label_raw"), Some(0.75));
    assert_eq!(figure(&found, "matched"), Some(0.8));
    // Rows X 2, Y 2; columns X 3, Y 1: chance 0.5 * 0.75 + 0.5 * 0.25.
    assert_eq!(figure(&found, "label_kappa"), Some((0.75 - 0.5) / 0.5));
    let x = &found.by_value[0];
    assert_eq!(
        (x.value.as_str(), x.a, x.b, x.both, x.other, x.alone),
        ("X", 2, 3, 2, 1, 0)
    );
    let z = &found.by_value[2];
    assert_eq!((z.value.as_str(), z.both, z.alone), ("Z", 0, 2));
    let confused: Vec<_> = found.confusion.iter().map(|it| (&*it.a, &*it.b, it.count)).collect();
    assert_eq!(confused, [("Y", "X", 1)]);
    let list: Vec<_> = found
        .list
        .iter()
        .map(|it| (it.kind, it.start_us / 1000, it.end_us / 1000))
        .collect();
    use DisagreementKind::{Boundary, OnlyA, OnlyB, Value};
    assert_eq!(
        list,
        [
            (Value, 1000, 2000),
            (OnlyA, 6000, 6500),
            (OnlyB, 8000, 8400),
            (Boundary, 2500, 3700)
        ]
    );
    assert!(found.list.is_sorted_by(|a, b| a.cost >= b.cost));
    let onset = found.onset_s.expect("starts");
    assert_eq!((onset.q1, onset.median), (0.0, 0.0));
    let wide = AgreeOptions {
        tolerance_us: 200_000,
        ..AgreeOptions::new("A", "B")
    };
    assert_eq!(agree(&desk.corpus, &wide).disagreements.boundary, 0);
    let whole = AgreeOptions {
        whole: true,
        ..AgreeOptions::new("B", "A")
    };
    let turned = agree(&desk.corpus, &whole);
    assert_eq!(figure(&turned, "raw"), figure(&found, "raw"));
}

#[test]
fn the_same_seed_gives_the_same_document_and_stopping_stops() {
    let many: Vec<(i64, i64, &str)> = (0..30)
        .map(|at| (at * 500, at * 500 + 400, ["X", "Y", "Z"][at as usize % 3]))
        .collect();
    let mut other = many.clone();
    other[4].2 = "X";
    other[9].0 += 150;
    other.remove(20);
    let desk = desk(&[&[("A", "", &many), ("B", "", &other)]]);
    let options = AgreeOptions {
        draws: 200,
        ..AgreeOptions::new("A", "B")
    };
    let found = agree(&desk.corpus, &options);
    let text = |it: &AnnotatorAgreement| serde_json::to_string(it).expect("JSON");
    assert_eq!(text(&found), text(&agree(&desk.corpus, &options)));
    assert!(!found.counts_only);
    for name in ["kappa_ipf", "alpha_u", "gamma", "gamma_cat", "frames_kappa"] {
        let value = figure(&found, name).expect("defined");
        assert!(value > 0.3 && value < 1.0, "{name}: {value}");
    }
    let interval = found.measures[0].1.interval.expect("an interval");
    let kappa = found.measures[0].1.value.expect("kappa");
    assert!(interval.low < kappa && kappa < interval.high && interval.of == "units");
    for (name, own) in &found.measures {
        let holds = own
            .interval
            .zip(own.value)
            .is_none_or(|(it, value)| it.low <= value && value <= it.high);
        assert!(holds, "{name}: {own:?}");
        assert!(name != &"kappa_max" || own.interval.is_none());
    }
    let turned = AgreeOptions {
        a: "B".into(),
        b: "A".into(),
        ..options.clone()
    };
    let turned = agree(&desk.corpus, &turned);
    for (name, figure) in &found.measures {
        let other = turned.measures.iter().find(|it| it.0 == *name);
        let other = other.and_then(|it| it.1.value);
        match (figure.value, other) {
            // Measures of segments take the first annotator as the truth.
            (Some(one), Some(other)) if !name.starts_with("overlap") && !name.starts_with("segment_") => {
                // ELAN's 20 rounds of fitting scale rows before columns, so that the last digits depend on the order.
                let tolerance = if *name == "kappa_ipf" { 1e-5 } else { 1e-9 };
                assert!((one - other).abs() < tolerance, "{name}: {one} {other}");
            }
            (one, other) => assert_eq!(one.is_some(), other.is_some(), "{name}"),
        }
    }
    let few = AgreeOptions {
        measures: vec!["alpha_u".into()],
        ..options.clone()
    };
    let names: Vec<&str> = agree(&desk.corpus, &few).measures.iter().map(|it| it.0).collect();
    assert_eq!(names, ["alpha_u"]);
    let mut stop = |_: ProgressStep<'_>| ControlFlow::Break(());
    let stopped = desk
        .corpus
        .compare_annotators(&options, &mut ProgressReceiver::new(&mut stop));
    assert!(matches!(stopped, Err(CorpusError::Stopped)));
}

#[test]
fn tiers_are_named_by_name_pattern_annotator_and_number() {
    let first: &[Tier<'_>] = &[("G-A", "Anna", A), ("G-B", "Ben", B), ("M-A", "", A)];
    let second: &[Tier<'_>] = &[("G-A", "Anna", A), ("G-B", "Ben", A)];
    let desk = desk(&[first, second]);
    let pairs = |a: &str, b: &str| {
        let found = agree(&desk.corpus, &AgreeOptions::new(a, b));
        let name = |it: &super::PairAgreement| format!("{} {} {}", it.recording, it.tier_a, it.tier_b);
        found.pairs.iter().map(name).collect::<Vec<_>>()
    };
    let both = ["one G-A G-B", "two G-A G-B"];
    assert_eq!(pairs("G-A", "G-B"), both);
    assert_eq!(pairs("g-a", "g-b"), both);
    assert_eq!(pairs("*-A", "*-B"), both);
    assert_eq!(pairs("annotator:Anna", "annotator:\"ben\""), both);
    assert_eq!(pairs("tier:1", "tier:5"), ["one G-A G-B"]);
    assert_eq!(pairs("tier:3", "G-A"), ["one M-A G-A"]);
    let one = AgreeOptions {
        recording: Some(RowName::Text("two".into())),
        ..AgreeOptions::new("G-A", "G-B")
    };
    let found = agree(&desk.corpus, &one);
    assert_eq!(found.pairs.len(), 1);
    assert_eq!(figure(&found, "label_raw"), Some(1.0));
    for (name, own) in &found.pairs[0].measures {
        assert_eq!(own.value, figure(&found, name), "{name}");
    }
    let pooled = agree(&desk.corpus, &AgreeOptions::new("G-A", "G-B"));
    assert_eq!((pooled.counts.units_a, pooled.counts.matched), (10, 9));
    for (options, wanted) in [
        (AgreeOptions::new("G-A", "G-C"), "did you mean"),
        (AgreeOptions::new("annotator:Anna", "annotator:Bem"), "did you mean"),
        (AgreeOptions::new("G-A", "G-A"), "itself"),
        (
            AgreeOptions {
                recording: Some(RowName::Text("two".into())),
                ..AgreeOptions::new("tier:1", "tier:5")
            },
            "no recording has both",
        ),
        (
            AgreeOptions {
                share: 0.4,
                ..AgreeOptions::new("G-A", "G-B")
            },
            "51",
        ),
        (
            AgreeOptions {
                measures: vec!["kapa".into()],
                ..AgreeOptions::new("G-A", "G-B")
            },
            "kapa",
        ),
    ] {
        let mut hear = ignore_progress_step;
        let error = desk
            .corpus
            .compare_annotators(&options, &mut ProgressReceiver::new(&mut hear))
            .expect_err(wanted);
        assert!(error.to_string().contains(wanted), "{error}");
        assert!(error.error_remedy().is_some(), "{error}");
    }
}

#[test]
fn annotations_of_one_span_keep_their_values_in_the_list() {
    let twice = &[(100, 100, "Y"), (100, 100, "X")];
    let desk = desk(&[&[("G-A", "", twice), ("G-B", "", &[(700, 900, "Z")])]]);
    let found = agree(&desk.corpus, &AgreeOptions::new("G-A", "G-B"));
    let sides: Vec<_> = found.list.iter().filter_map(|it| it.a.as_ref()).collect();
    assert_eq!(sides.len(), 2);
    for side in sides {
        let stored = crate::db::stored_tiers::load_annotation_row(desk.corpus.store.read_connection(), side.annotation);
        assert_eq!(stored.expect("stored").value, side.value);
    }
}

#[test]
fn annotations_without_a_value_are_left_out_or_compared_as_spans() {
    let some: &[(i64, i64, &str)] = &[(0, 1000, "X"), (1500, 2000, ""), (2000, 3000, "Y")];
    let none: &[(i64, i64, &str)] = &[(0, 1000, ""), (1500, 2000, "")];
    let desk = desk(&[&[("A", "", some), ("B", "", some), ("C", "", none), ("D", "", none)]]);
    let found = agree(&desk.corpus, &AgreeOptions::new("A", "B"));
    assert_eq!((found.counts.units_a, found.counts.left_out_a), (2, 1));
    assert!(found.findings[0].contains("left out: 1"), "{:?}", found.findings);
    let spans = agree(&desk.corpus, &AgreeOptions::new("C", "D"));
    assert_eq!((spans.counts.units_a, spans.counts.matched, spans.values), (2, 2, 0));
    assert_eq!(figure(&spans, "kappa_ipf"), None);
    let why = &spans.measures[0].1.why;
    assert_eq!(why.as_deref(), Some("one value only"));
    assert_eq!(figure(&spans, "alpha_u"), Some(1.0));
    let empty: &[(i64, i64, &str)] = &[];
    let nothing = super::tests::desk(&[&[("A", "", empty), ("B", "", empty)]]);
    let found = agree(&nothing.corpus, &AgreeOptions::new("A", "B"));
    for (name, figure) in &found.measures {
        assert_eq!(figure.value, None, "{name}");
        assert!(figure.why.is_some(), "{name}");
    }
}

#[test]
fn near_handshapes_cost_less_and_their_features_are_named() {
    let shapes = |of: [&'static str; 4]| -> Vec<(i64, i64, &'static str)> {
        (0..)
            .zip(of)
            .map(|(at, value)| (at * 1000, at * 1000 + 800, value))
            .collect()
    };
    let (a, b) = (shapes(["A", "S", "U", "A"]), shapes(["S", "S", "U", "U"]));
    let mut desk = desk(&[&[("A", "", &a), ("B", "", &b)]]);
    for tier in ["A", "B"] {
        let name = TierRequestName::Of {
            recording: RowName::Text("one".into()),
            tier: tier.into(),
        };
        let role = TierRole::Component {
            component: SignComponent::Configuration,
            feature: None,
        };
        let change = TierPropertyChange {
            role: Some(role),
            ..TierPropertyChange::default()
        };
        desk.corpus.change_tier_properties(&name, &change).expect("changed");
    }
    let found = agree(&desk.corpus, &AgreeOptions::new("A", "B"));
    let (nominal, near) = (figure(&found, "label_alpha"), figure(&found, "label_alpha_features"));
    assert!(near > nominal, "{near:?} {nominal:?}");
    let far = &found.list[0];
    let thumb = &found.list[1];
    assert_eq!(
        (far.a.as_ref().map(|it| &*it.value), far.b.as_ref().map(|it| &*it.value)),
        (Some("A"), Some("U"))
    );
    assert!(far.cost > thumb.cost);
    assert_eq!(thumb.differs, ["thumb-across", "thumb-alongside"]);
    let confused = found.confusion.iter().find(|it| it.b == "S").expect("A for S");
    assert_eq!(
        (&confused.only_a[..], &confused.only_b[..]),
        (&["thumb-alongside".to_owned()][..], &["thumb-across".to_owned()][..])
    );
}

/// Returns the annotations of a tier as `start-end value` in milliseconds.
fn said(corpus: &Corpus, tier: &str) -> Vec<String> {
    let tiers = crate::db::stored_tiers::load_tier_rows(corpus.store.read_connection(), 1).expect("read");
    let Some(tier) = tiers.iter().find(|it| it.name == tier) else {
        return Vec::new();
    };
    let rows =
        crate::db::stored_tiers::load_tier_annotation_rows(corpus.store.read_connection(), tier.id).expect("read");
    rows.iter()
        .map(|it| format!("{}-{} {}", it.start_us / 1000, it.end_us / 1000, it.value))
        .collect()
}

#[test]
fn a_third_tier_holds_agreements_and_conflicts_wait_for_decisions() {
    let mut desk = desk(&[&[("A", "", A), ("B", "", B)]]);
    let corpus = &mut desk.corpus;
    let options = AgreeOptions::new("A", "B");
    let mut hear = ignore_progress_step;
    let done = corpus
        .adjudicate_tiers(&options, "C", &mut ProgressReceiver::new(&mut hear))
        .expect("adjudicated");
    assert_eq!((done.agreed, done.conflicts), (2, 4));
    assert_eq!(done.recordings, ["one"]);
    assert_eq!(
        said(corpus, "C"),
        ["0-1000 X", "1000-2000 Y", "2500-3500 X", "4000-5000 Y", "6000-6500 Z"]
    );
    let open = corpus.merge_conflicts(false).expect("conflicts");
    assert_eq!(open.len(), 4);
    let number = |test: &dyn Fn(&crate::CorpusConflict) -> bool| open.iter().find(|it| test(it)).expect("open").number;
    let value = number(&|it| it.theirs.as_ref().is_some_and(|it| it.start_us == Some(1_000_000)));
    let boundary = number(&|it| it.theirs.as_ref().is_some_and(|it| it.end_us == Some(3_700_000)));
    let only_a = number(&|it| it.theirs.is_none());
    let only_b = number(&|it| it.mine.is_none());
    corpus
        .decide_conflicts(&[value, only_a, only_b], ConflictDecision::Theirs)
        .expect("decided");
    corpus
        .decide_conflicts(&[boundary], ConflictDecision::Mine)
        .expect("decided");
    assert_eq!(
        said(corpus, "C"),
        ["0-1000 X", "1000-2000 X", "2500-3500 X", "4000-5000 Y", "8000-8400 Z"]
    );
    assert!(corpus.merge_conflicts(false).expect("conflicts").is_empty());
    let mut hear = ignore_progress_step;
    let check = corpus
        .check_corpus(false, &mut ProgressReceiver::new(&mut hear))
        .expect("checked");
    assert_eq!(check.all_findings().next(), None);
    assert_eq!((said(corpus, "A").len(), said(corpus, "B").len()), (5, 5));
    for _ in 0..3 {
        corpus.undo_operation().expect("undone");
    }
    assert!(said(corpus, "C").is_empty());
    assert!(corpus.merge_conflicts(true).expect("conflicts").is_empty());
    let mut hear = ignore_progress_step;
    let again = corpus.adjudicate_tiers(&options, "A", &mut ProgressReceiver::new(&mut hear));
    assert!(again.is_err(), "the tier exists");
}

#[test]
fn an_annotation_without_length_is_named_before_a_third_tier_is_begun() {
    let units: &[(i64, i64, &str)] = &[(0, 1000, "X"), (2000, 2000, "Y")];
    let whole: &[(i64, i64, &str)] = &[(0, 1000, "X"), (2000, 2500, "Y")];
    for (a, b, place) in [(units, whole, "one, A"), (whole, units, "one, B")] {
        let mut desk = desk(&[&[("A", "", a), ("B", "", b)]]);
        let mut hear = ignore_progress_step;
        let options = AgreeOptions::new("A", "B");
        let progress = &mut ProgressReceiver::new(&mut hear);
        let error = desk.corpus.adjudicate_tiers(&options, "C", progress);
        let error = error.expect_err("refused");
        assert!(error.to_string().contains("\"Y\" at 2.000 s"), "{error}");
        assert_eq!(error.error_place().as_deref(), Some(place));
        assert!(said(&desk.corpus, "C").is_empty());
    }
}

#[test]
fn the_table_of_disagreements_has_a_row_for_each() {
    let desk = desk(&[&[("A", "", A), ("B", "", B)]]);
    let found = agree(&desk.corpus, &AgreeOptions::new("A", "B"));
    let to = desk._folder.path().join("d.csv");
    found.write_disagreements(&to, false).expect("written");
    let text = std::fs::read_to_string(&to).expect("read");
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1 + found.list.len());
    assert!(
        lines[1].starts_with("one,value,1.000,1.000,2.000,Y,X,0.000,0.000,,"),
        "{}",
        lines[1]
    );
    assert!(found.write_disagreements(&to, false).is_err(), "it exists");
    found.write_disagreements(&to, true).expect("replaced");
}

#[test]
fn deciding_all_for_one_side_gives_its_tier() {
    let split: &[(i64, i64, &str)] = &[(0, 500, "X"), (500, 1000, "X"), (1000, 1400, "Y"), (2000, 3000, "Z")];
    let whole: &[(i64, i64, &str)] = &[(0, 1000, "X"), (1010, 1600, "W"), (1600, 2100, "V"), (2100, 3000, "Z")];
    let empty: &[(i64, i64, &str)] = &[];
    for (a, b) in [(whole, split), (split, whole), (A, B), (B, A), (A, empty), (empty, A)] {
        for decision in [ConflictDecision::Mine, ConflictDecision::Theirs] {
            let mut desk = desk(&[&[("A", "", a), ("B", "", b)]]);
            let exact = AgreeOptions {
                tolerance_us: 0,
                ..AgreeOptions::new("A", "B")
            };
            let mut hear = ignore_progress_step;
            let corpus = &mut desk.corpus;
            let done = corpus
                .adjudicate_tiers(&exact, "C", &mut ProgressReceiver::new(&mut hear))
                .expect("adjudicated");
            let open = corpus.merge_conflicts(false).expect("conflicts");
            assert_eq!(open.len() as u64, done.conflicts, "{a:?} {b:?}");
            let numbers: Vec<usize> = open.iter().map(|it| it.number).collect();
            corpus.decide_conflicts(&numbers, decision).expect("decided");
            let wanted = if decision == ConflictDecision::Mine { "A" } else { "B" };
            assert_eq!(said(corpus, "C"), said(corpus, wanted), "{a:?} {b:?} {decision:?}");
        }
    }
}

#[test]
fn a_candidate_does_not_reach_into_an_agreed_annotation_within_the_tolerance() {
    let a: &[(i64, i64, &str)] = &[(0, 1000, "X"), (2000, 3000, "Y")];
    let b: &[(i64, i64, &str)] = &[(0, 950, "X"), (950, 1400, "N"), (2000, 3000, "W")];
    let mut desk = desk(&[&[("A", "", a), ("B", "", b)]]);
    let corpus = &mut desk.corpus;
    let mut hear = ignore_progress_step;
    corpus
        .adjudicate_tiers(&AgreeOptions::new("A", "B"), "C", &mut ProgressReceiver::new(&mut hear))
        .expect("adjudicated");
    let open: Vec<usize> = corpus
        .merge_conflicts(false)
        .expect("open")
        .iter()
        .map(|it| it.number)
        .collect();
    assert_eq!(open.len(), 2);
    corpus
        .decide_conflicts(&open, ConflictDecision::Theirs)
        .expect("decided");
    assert_eq!(said(corpus, "C"), ["0-1000 X", "1000-1400 N", "2000-3000 W"]);
}
