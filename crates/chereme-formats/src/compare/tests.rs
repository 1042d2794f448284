//! Tests of differences and merges of annotation documents: cases by hand, and laws under random changes.

mod applied;
mod unchanged_side;

use super::{MergedTranscript, TranscriptDifference, diff_transcripts, merge_two, with_candidates};
use crate::compare::merge_transcripts;
use crate::transcript::AnnotationTranscript;
use crate::transcript::{AnnotationAddress, AnnotationTiming, TranscriptAnnotation, TranscriptTier};
use applied::apply_difference;
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::TierStereotype;
use proptest::prelude::*;

/// A document of lines `tier [<parent]: id start-end value, …`; symbolic children are `id ^parent value`.
fn document(text: &str) -> AnnotationTranscript {
    let mut it = AnnotationTranscript::default();
    it.properties.push(("URN".into(), "urn:one".into()));
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let (head, rest) = line.split_once(':').expect("a tier");
        let (name, parent) = match head.split_once('<') {
            Some((name, parent)) => (name.trim(), Some(parent.trim())),
            None => (head.trim(), None),
        };
        let parent = parent.and_then(|name| it.tiers.iter().position(|tier| tier.name == name));
        it.tiers.push(TranscriptTier {
            name: name.to_owned(),
            parent,
            stereotype: parent.map(|_| TierStereotype::SymbolicSubdivision),
            kind: "k".into(),
            ..TranscriptTier::default()
        });
        let tier = it.tiers.len() - 1;
        for part in rest.split(',').filter(|part| !part.trim().is_empty()) {
            let words: Vec<&str> = part.split_whitespace().collect();
            let value = words.get(2).copied().unwrap_or_default();
            let annotation = match words[1].strip_prefix('^') {
                Some(above) => child(&it, tier, (words[0], above, value)),
                None => {
                    let (start, end) = words[1].split_once('-').expect("times");
                    let millis = |text: &str| text.parse::<i64>().expect("a time") * 1000;
                    own(words[0], millis(start), millis(end), value)
                }
            };
            it.tiers[tier].annotations.push(annotation);
        }
    }
    super::loose::TranscriptPieces::pieces_from_transcript(&it).reassemble_transcript()
}

fn own(id: &str, start: i64, end: i64, value: &str) -> TranscriptAnnotation {
    TranscriptAnnotation {
        id: id.to_owned(),
        span: TimeSpan::from_span_micros(start, end),
        timing: AnnotationTiming::Own,
        parent: None,
        order: 0,
        value: value.to_owned(),
        entry: None,
        language: None,
        external_ref: None,
        millis: None,
    }
}

fn child(it: &AnnotationTranscript, tier: usize, (id, above, value): (&str, &str, &str)) -> TranscriptAnnotation {
    let mut all = super::list_annotation_addresses(it).into_iter();
    let parent: AnnotationAddress = all
        .find(|place| super::compared_annotation_at(it, *place).id == above)
        .expect("parent");
    let siblings = it.tiers[tier].annotations.iter();
    let order = siblings.filter(|it| it.parent == Some(parent)).count();
    TranscriptAnnotation {
        parent: Some(parent),
        order: u32::try_from(order).expect("few"),
        timing: AnnotationTiming::Share,
        ..own(id, 0, 0, value)
    }
}

/// The tiers as lines, each annotation as `start-end value`, with its parent's text in a symbolic tier.
fn shown(it: &AnnotationTranscript) -> Vec<String> {
    let mut lines = Vec::new();
    for tier in &it.tiers {
        let mut all: Vec<String> = tier
            .annotations
            .iter()
            .map(|own| {
                let millis = |at: RecordingInstant| at.instant_millis();
                let above = own.parent.filter(|_| tier.stereotype.is_some());
                let above = above.and_then(|place| it.annotation_at(place));
                let above = above.map(|it| format!("^{} {} ", it.value, own.order));
                let times = format!(
                    "{}-{}",
                    millis(own.span.span_start_instant()),
                    millis(own.span.span_end_instant())
                );
                format!("{}{times} {}", above.unwrap_or_default(), own.value)
            })
            .collect();
        all.sort();
        lines.push(format!("{}: {}", tier.name, all.join(", ")));
    }
    lines.sort();
    lines
}

#[track_caller]
fn merges(base: &str, mine: &str, theirs: &str, want: &str, conflicts: usize) -> MergedTranscript {
    let [base, mine, theirs] = [base, mine, theirs].map(document);
    let merged = merge_transcripts(&base, &mine, &theirs);
    assert_eq!(shown(&merged.document), shown(&document(want)));
    assert_eq!(merged.conflicts.len(), conflicts, "{:?}", merged.conflicts);
    let other = merge_transcripts(&base, &theirs, &mine);
    if conflicts == 0 {
        assert_eq!(shown(&other.document), shown(&merged.document));
    }
    assert_eq!(other.conflicts.len(), conflicts);
    merged
}

#[test]
fn differences_are_by_meaning() {
    let a = document("G: a1 0-100 CHAT, a2 200-300 CHIEN, a3 400-500 VACHE\nP <G: a4 ^a1 x, a5 ^a1 y");
    let b = document("G: a1 0-100 CHAT, a2 200-350 CHIEN, a9 600-700 LION\nP <G: a4 ^a1 z, a5 ^a1 y\nN:");
    let found = diff_transcripts(&a, &b);
    let counts = |it: &TranscriptDifference| {
        [
            it.added.len(),
            it.removed.len(),
            it.moved.len(),
            it.revalued.len(),
            it.tiers.len(),
        ]
    };
    assert_eq!(counts(&found), [1, 1, 1, 1, 1]);
    assert_eq!(
        (found.moved[0].from, found.moved[0].to),
        ([200_000, 300_000], [200_000, 350_000])
    );
    assert_eq!((&*found.revalued[0].from, &*found.revalued[0].to), ("x", "z"));
    let json = serde_json::to_value(&found).expect("JSON");
    assert_eq!(json["tiers"][0]["change"], "added");
    assert!(json["added"][0].get("whole").is_none());
}

#[test]
fn the_same_id_of_two_different_annotations_is_no_change() {
    let a = document("G: a1 0-100 CHAT, a2 200-300 CHIEN");
    let b = document("G: a1 0-100 CHAT, a2 900-999 LION");
    let found = diff_transcripts(&a, &b);
    assert_eq!((found.added.len(), found.removed.len()), (1, 1));
}

#[test]
fn documents_without_common_ids_are_matched_by_time() {
    let a = document("G: x1 0-100 CHAT, x2 200-300 CHIEN");
    let mut b = document("G: b7 0-104 CHAT, b8 200-300 LION");
    b.properties.clear();
    let found = diff_transcripts(&a, &b);
    assert_eq!((found.moved.len(), found.revalued.len(), found.added.len()), (1, 1, 0));
}

#[test]
fn changes_of_different_annotations_are_all_merged() {
    merges(
        "G: a1 0-100 A, a2 200-300 B, a3 400-500 C",
        "G: a1 0-120 A, a2 200-300 B2, a3 400-500 C",
        "G: a1 0-100 A1, a3 400-500 C, a4 600-700 D",
        "G: a1 0-120 A1, a2 200-300 B2, a3 400-500 C, a4 600-700 D",
        1,
    );
    merges(
        "G: a1 0-100 A",
        "G: a1 10-100 A, a2 200-300 M",
        "G: a1 0-90 A, a2 400-500 T\nN: a3 0-50 n",
        "G: a1 10-90 A, a2 200-300 M, a3 400-500 T\nN: a4 0-50 n",
        0,
    );
}

#[test]
fn an_annotation_that_both_changed_is_a_conflict_with_both_candidates() {
    let merged = merges("G: a1 0-100 A", "G: a1 0-100 M", "G: a1 0-100 T", "G: a1 0-100 M", 1);
    let conflict = &merged.conflicts[0];
    let value = |it: &Option<super::ComparedAnnotation>| it.as_ref().map(|it| it.value.clone());
    assert_eq!(value(&conflict.base).as_deref(), Some("A"));
    assert_eq!(value(&conflict.mine).as_deref(), Some("M"));
    assert_eq!(value(&conflict.theirs).as_deref(), Some("T"));
    merges("G: a1 0-100 A", "G: a1 0-110 A", "G: a1 0-120 A", "G: a1 0-110 A", 1);
    merges("G: a1 0-100 A", "G:", "G: a1 0-100 T", "G:", 1);
    merges("G: a1 0-100 A", "G: a1 0-100 T", "G:", "G: a1 0-100 T", 1);
    merges("G:", "G: a1 0-100 M", "G: a1 50-150 T", "G: a1 0-100 M", 1);
}

#[test]
fn documents_without_a_common_ancestor_are_united() {
    let [mine, theirs] = [
        "G: a1 0-100 A, a2 200-300 M",
        "G: a1 0-100 T, a3 400-500 C\nN: a4 0-9 n",
    ]
    .map(document);
    let merged = merge_two(&mine, &theirs);
    let want = document("G: a1 0-100 A, a2 200-300 M, a3 400-500 C\nN: a4 0-9 n");
    assert_eq!(shown(&merged.document), shown(&want));
    assert_eq!(merged.conflicts.len(), 1);
    let both = shown(&with_candidates(&merged));
    assert!(both.contains(&"G (theirs): 0-100 T".to_owned()), "{both:?}");
    assert!(merge_two(&mine, &mine).conflicts.is_empty());
}

#[test]
fn chains_of_annotations_grow_on_both_sides() {
    merges(
        "G: a1 0-100 A\nP <G: a2 ^a1 x, a3 ^a1 y",
        "G: a1 0-100 A\nP <G: a2 ^a1 x, a4 ^a1 m, a3 ^a1 y",
        "G: a1 0-100 A\nP <G: a2 ^a1 x, a4 ^a1 t, a3 ^a1 y2",
        "G: a1 0-100 A\nP <G: a2 ^a1 x, a4 ^a1 m, a5 ^a1 t, a3 ^a1 y2",
        0,
    );
}

#[test]
fn added_removed_and_renamed_tiers_are_merged() {
    merges(
        "G: a1 0-100 A\nH: a2 0-50 h\nI: a3 0-50 i",
        "G: a1 0-100 A\nH: a2 0-50 h\nI: a3 0-50 i2",
        "Gloss: a1 0-100 A\nN: a4 5-6 n",
        "Gloss: a1 0-100 A\nI: a3 0-50 i2\nN: a4 5-6 n",
        1,
    );
}

#[test]
fn properties_that_one_side_changed_are_taken_and_mine_win() {
    let with = |properties: &[(&str, &str)]| {
        let mut it = document("G: a1 0-100 A");
        let own = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
        it.properties = properties.iter().map(own).collect();
        it
    };
    for (base, mine, theirs, want) in [
        (&[][..], &[][..], &[("a", "1")][..], &[("a", "1")][..]),
        (&[], &[("a", "1")], &[], &[("a", "1")]),
        (&[], &[("a", "1")], &[("a", "2")], &[("a", "1")]),
        (&[("a", "1")], &[("a", "1")], &[("a", "2")], &[("a", "2")]),
        (&[("a", "1")], &[("a", "3")], &[("a", "2")], &[("a", "3")]),
        (&[("a", "1")], &[("a", "1")], &[], &[]),
        (&[("a", "1")], &[], &[("a", "1")], &[]),
        (&[("a", "1")], &[], &[("a", "2")], &[]),
        (
            &[("a", "1")],
            &[("a", "1"), ("b", "m")],
            &[("a", "1"), ("c", "t")],
            &[("a", "1"), ("b", "m"), ("c", "t")],
        ),
    ] {
        let merged = merge_transcripts(&with(base), &with(mine), &with(theirs));
        let got = &merged.document.properties;
        assert_eq!(*got, with(want).properties, "{base:?} {mine:?} {theirs:?}");
    }
}

#[test]
fn annotations_that_exchanged_their_ids_have_not_moved() {
    let a = document("G: a1 0-100 x, a2 500-600 x, a3 700-800 y");
    let b = document("G: a2 0-100 x, a1 500-600 x, a3 700-800 y");
    assert!(diff_transcripts(&a, &b).is_empty(), "{:?}", diff_transcripts(&a, &b));
}

/// A random change of a document: numbers that select the annotation, the kind of change, and its size.
type Deed = (usize, u8, i64);

fn changed(it: &AnnotationTranscript, deeds: &[Deed], name: &str) -> AnnotationTranscript {
    let mut it = it.clone();
    for (at, what, far) in deeds {
        let all = super::list_annotation_addresses(&it);
        let Some(place) = all.get(at % all.len().max(1)).copied() else {
            break;
        };
        let symbolic = super::is_symbolic(&it, place.tier);
        let tier = &mut it.tiers[place.tier];
        match what % 5 {
            0 => tier.annotations[place.index].value = format!("{name}{far}"),
            1 if !symbolic => {
                let own = &mut tier.annotations[place.index];
                let end = own.span.span_end_instant().shifted_instant(far * 2000);
                if end > own.span.span_start_instant() {
                    own.span = TimeSpan::span_between(own.span.span_start_instant(), end);
                }
            }
            2 if !symbolic => {
                let start = 1_000_000 + far.abs() * 300_000;
                let free = tier
                    .annotations
                    .iter()
                    .all(|own| own.span.span_start_instant().instant_micros() != start);
                if free {
                    let id = format!("a{}", 100 + tier.annotations.len());
                    tier.annotations.push(own(&id, start, start + 200_000, name));
                }
            }
            3 => {
                let below = it.tiers.iter().flat_map(|tier| &tier.annotations);
                if below.filter(|own| own.parent.is_some()).count() == 0 {
                    drop(it.tiers[place.tier].annotations.remove(place.index));
                }
            }
            _ => it.tiers[place.tier].participant = Some(format!("{name}{far}")),
        }
        it = super::loose::TranscriptPieces::pieces_from_transcript(&it).reassemble_transcript();
    }
    it
}

fn start() -> AnnotationTranscript {
    document(
        "G: a1 0-100 A, a2 200-300 B, a3 400-500 C, a4 600-700 D\nP <G: a5 ^a1 x, a6 ^a1 y, a7 ^a2 z\nN: a8 0-900 n",
    )
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(128) })]

    #[test]
    fn applying_the_difference_gives_the_other(
        a in proptest::collection::vec((0usize..20, 0u8..5, -50i64..50), 0..8),
        b in proptest::collection::vec((0usize..20, 0u8..5, -50i64..50), 0..8),
    ) {
        let (a, b) = (changed(&start(), &a, "m"), changed(&start(), &b, "t"));
        let applied = apply_difference(&diff_transcripts(&a, &b), &a);
        prop_assert_eq!(shown(&applied), shown(&b));
        prop_assert!(diff_transcripts(&a, &a).is_empty());
        prop_assert!(diff_transcripts(&applied, &b).is_empty(), "{:?}", diff_transcripts(&applied, &b));
    }

    #[test]
    fn a_merge_with_an_unchanged_side_gives_the_other(
        deeds in proptest::collection::vec((0usize..20, 0u8..5, -50i64..50), 0..8),
    ) {
        let (base, other) = (start(), changed(&start(), &deeds, "m"));
        for merged in [merge_transcripts(&base, &other, &base), merge_transcripts(&base, &base, &other)] {
            prop_assert_eq!(shown(&merged.document), shown(&other));
            prop_assert!(merged.conflicts.is_empty(), "{:?}", merged.conflicts);
        }
    }

    #[test]
    fn a_merge_gives_the_same_result_in_either_direction(
        a in proptest::collection::vec((0usize..20, 0u8..4, -50i64..50), 0..6),
        b in proptest::collection::vec((0usize..20, 0u8..4, -50i64..50), 0..6),
    ) {
        let base = start();
        let (mine, theirs) = (changed(&base, &a, "m"), changed(&base, &b, "t"));
        let (one, two) = (merge_transcripts(&base, &mine, &theirs), merge_transcripts(&base, &theirs, &mine));
        if one.conflicts.is_empty() && two.conflicts.is_empty() {
            prop_assert_eq!(shown(&one.document), shown(&two.document));
        }
        // Nothing is lost: each side's own annotations are in the document or in a conflict.
        for (side, merged) in [(&mine, &one), (&theirs, &one), (&theirs, &two)] {
            for said in diff_transcripts(&base, side).added {
                let there = shown(&merged.document).join(" ").contains(&said.value);
                let listed = merged.conflicts.iter().any(|it| {
                    [&it.mine, &it.theirs].into_iter().flatten().any(|that| that.value == said.value)
                });
                prop_assert!(there || listed, "{:?}", said);
            }
        }
    }
}

/// Numbers in a fixed order.
struct Seeded(u64);

impl Seeded {
    fn below(&mut self, most: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 33) % most
    }
}

#[test]
fn an_hour_of_work_by_two_annotators_is_merged_without_loss() {
    let mut seeded = Seeded(7);
    let mut base = document("Right:\nLeft:\nMouth:");
    let mut id = 0;
    for tier in &mut base.tiers {
        for second in 0..3600i64 {
            id += 1;
            let start = second * 1_000_000;
            let value = format!("S{}", seeded.below(500));
            tier.annotations
                .push(own(&format!("a{id}"), start, start + 600_000, &value));
        }
    }
    let mut edit = |name: &str, gap: i64| {
        let mut it = base.clone();
        let mut fresh = id;
        for tier in &mut it.tiers {
            let mut kept = Vec::new();
            for mut own_one in std::mem::take(&mut tier.annotations) {
                match seeded.below(40) {
                    0 => own_one.value = format!("{name}{}", seeded.below(500)),
                    1 => {
                        let end = own_one.span.span_end_instant().shifted_instant(40_000 + gap);
                        own_one.span = TimeSpan::span_between(own_one.span.span_start_instant(), end);
                    }
                    2 => continue,
                    3 => {
                        fresh += 1;
                        let start = own_one.span.span_start_instant().instant_micros() + 700_000 + gap;
                        let value = format!("{name}+{fresh}");
                        kept.push(own(&format!("a{fresh}"), start, start + 100_000, &value));
                    }
                    _ => {}
                }
                kept.push(own_one);
            }
            tier.annotations = kept;
        }
        super::loose::TranscriptPieces::pieces_from_transcript(&it).reassemble_transcript()
    };
    let (mine, theirs) = (edit("M", 0), edit("T", 120_000));
    let merged = merge_transcripts(&base, &mine, &theirs);
    assert!(diff_transcripts(&base, &mine).added.len() > 200 && diff_transcripts(&base, &theirs).added.len() > 200);
    assert!((1..200).contains(&merged.conflicts.len()), "{}", merged.conflicts.len());
    let mut known: std::collections::BTreeSet<(String, String)> = Default::default();
    for tier in &merged.document.tiers {
        known.extend(tier.annotations.iter().map(|it| (tier.name.clone(), it.value.clone())));
    }
    for it in &merged.conflicts {
        for said in [&it.mine, &it.theirs].into_iter().flatten() {
            known.insert((said.tier.clone(), said.value.clone()));
        }
    }
    for side in [&mine, &theirs] {
        let changes = diff_transcripts(&base, side);
        let said = changes.added.iter().map(|it| (&it.tier, &it.value));
        let revalued = changes.revalued.iter().map(|it| (&it.tier, &it.to));
        for (tier, value) in said.chain(revalued) {
            assert!(known.contains(&(tier.clone(), value.clone())), "{tier} {value}");
        }
    }
    let other = merge_transcripts(&base, &theirs, &mine);
    assert_eq!(other.conflicts.len(), merged.conflicts.len());
}

#[test]
fn golden_differences_and_merges() {
    use crate::golden::{compare, put};
    let mut out = String::new();
    let documents = [
        "G: a1 0-100 CHAT, a2 200-300 CHIEN, a3 400-500 VACHE\nP <G: a4 ^a1 x, a5 ^a1 y",
        "G: a1 0-100 CHAT, a2 200-350 CHIEN, a9 600-700 LION\nP <G: a4 ^a1 z, a5 ^a1 y\nN:",
        "G: a1 0-120 CHAT, a2 200-340 LOUP, a3 400-500 VACHE\nQ: q1 0-50 n",
        "G: b1 0-100 CHAT, b2 205-300 CHIEN, b3 400-500 VACHES, b4 800-900 OURS\nP <G: b5 ^b1 y, b6 ^b1 x, b7 ^b4 w",
        "",
    ];
    let mut documents: Vec<AnnotationTranscript> = documents.iter().map(|text| document(text)).collect();
    // Documents of unknown origin, whose ids agree or do not.
    for n in 0..4 {
        let mut unknown = documents[n].clone();
        unknown.properties.clear();
        documents.push(unknown);
    }
    for (n, a) in documents.iter().enumerate() {
        let others = documents.iter().enumerate();
        for (m, b) in others.filter(|(m, _)| *m != n && (n > 4) == (*m > 4)) {
            put(&mut out, format!("## from {n} to {m}"));
            let found = diff_transcripts(a, b);
            put(&mut out, format!("{} {found:?}", found.is_empty()));
            put(&mut out, format!("applied {:?}", shown(&apply_difference(&found, a))));
            for merged in [merge_two(a, b), merge_transcripts(&documents[0], a, b)] {
                put(&mut out, format!("merged {:?}", shown(&merged.document)));
                for conflict in &merged.conflicts {
                    put(&mut out, format!("  {conflict:?}"));
                }
                put(&mut out, format!("both {:?}", shown(&with_candidates(&merged))));
            }
        }
    }
    compare("differences", &out);
}

#[test]
fn a_change_of_one_millisecond_is_a_change_and_less_is_rounding() {
    let (before, after) = ("A: a1 368-500 x", "A: a1 369-500 x");
    let found = diff_transcripts(&document(before), &document(after));
    assert_eq!(found.moved.len(), 1, "{found:?}");
    merges(before, before, after, after, 0);
    let mut rounded = document(before);
    rounded.tiers[0].annotations[0].span = own("", 368_600, 500_400, "").span;
    assert_eq!(
        diff_transcripts(&document(before), &rounded),
        TranscriptDifference::default()
    );
}
