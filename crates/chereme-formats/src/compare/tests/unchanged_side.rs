//! A merge with an unchanged side gives the other side, for tiers of every stereotype.

use super::{Seeded, own, shown};
use crate::compare::TIME_TOLERANCE_MICROS;
use crate::compare::diff_transcripts;
use crate::compare::loose::{LooseAnnotation, TranscriptPieces};
use crate::compare::merge_transcripts;
use crate::transcript::AnnotationTranscript;
use crate::transcript::TranscriptTier;
use chereme_motion::TimeSpan;
use chereme_sign::TierStereotype;
use proptest::prelude::*;
use std::collections::BTreeMap;

/// The tiers: the name, the parent, and the stereotype.
const TIERS: [(&str, &str, Option<TierStereotype>); 8] = [
    ("Gloss", "", None),
    ("word", "Gloss", Some(TierStereotype::SymbolicSubdivision)),
    ("morph", "word", Some(TierStereotype::SymbolicSubdivision)),
    ("pos", "morph", Some(TierStereotype::SymbolicAssociation)),
    ("phase", "Gloss", Some(TierStereotype::TimeSubdivision)),
    ("mouth", "Gloss", Some(TierStereotype::IncludedIn)),
    ("note", "mouth", Some(TierStereotype::SymbolicAssociation)),
    ("Head", "", None),
];

fn stereotype(pieces: &TranscriptPieces, tier: &str) -> Option<TierStereotype> {
    let found = pieces.tiers.iter().find(|(it, _)| it.name == tier);
    found.and_then(|(it, _)| it.stereotype)
}

fn put(pieces: &mut TranscriptPieces, tier: &str, (above, rank): (Option<&str>, f64), value: &str) -> String {
    let times = above.and_then(|id| pieces.all.get(id)).map(|it| it.it.span);
    let (start, end) = times.map_or((0, 1000), |it| it.span_bounds_micros());
    pieces.add_loose_annotation(LooseAnnotation {
        it: own("", start, end, value),
        tier: tier.to_owned(),
        above: above.map(str::to_owned),
        rank,
    })
}

fn set_times(pieces: &mut TranscriptPieces, id: &str, start: i64, end: i64) {
    if let Some(it) = pieces.all.get_mut(id) {
        it.it.span = TimeSpan::from_span_micros(start, end);
    }
}

fn times(it: &LooseAnnotation) -> (i64, i64) {
    it.it.span.span_bounds_micros()
}

fn base(numbers: &mut Seeded) -> AnnotationTranscript {
    let mut pieces = TranscriptPieces::pieces_from_transcript(&AnnotationTranscript::default());
    if numbers.below(2) == 0 {
        let urn = ("URN".to_owned(), "urn:one".to_owned());
        pieces.rest.properties.push(urn);
    }
    for (name, parent, stereotype) in TIERS {
        let parent = Some(parent.to_owned()).filter(|it| !it.is_empty());
        let tier = TranscriptTier {
            name: name.to_owned(),
            kind: "k".into(),
            stereotype,
            ..TranscriptTier::default()
        };
        pieces.tiers.push((tier, parent.clone()));
        let above: Vec<Option<String>> = match parent {
            None => (0..4).map(|_| None).collect(),
            Some(parent) => {
                let all = pieces.all.iter().filter(|(_, it)| it.tier == parent);
                all.map(|(id, _)| Some(id.clone())).collect()
            }
        };
        for (at, above) in above.iter().enumerate() {
            let count = match stereotype {
                None => 1,
                Some(TierStereotype::SymbolicAssociation) => numbers.below(2),
                Some(_) => numbers.below(4),
            };
            for rank in 0..count {
                let value = format!("{name}{at}{rank}");
                let chain = (above.as_deref(), rank as f64);
                let id = put(&mut pieces, name, chain, &value);
                let (start, end) = times(&pieces.all[&id]);
                let (rank, many) = (i64::try_from(rank).expect("few"), 1 + count as i64);
                match stereotype {
                    None => {
                        let start = 1_000_000 * at as i64;
                        set_times(&mut pieces, &id, start, start + 800_000);
                    }
                    Some(TierStereotype::TimeSubdivision | TierStereotype::IncludedIn) => {
                        let step = (end - start) / many;
                        let start = start + step * rank;
                        set_times(&mut pieces, &id, start, start + step);
                    }
                    Some(_) => {}
                }
            }
        }
    }
    pieces.reassemble_transcript()
}

/// Removes an annotation with all below it.
fn remove(pieces: &mut TranscriptPieces, id: &str) {
    pieces.all.remove(id);
    let below = pieces.all.iter();
    let below = below.filter(|(_, it)| it.above.as_deref() == Some(id));
    let below: Vec<String> = below.map(|(id, _)| id.clone()).collect();
    for id in below {
        remove(pieces, &id);
    }
}

fn remove_tier(pieces: &mut TranscriptPieces, name: &str) {
    pieces.tiers.retain(|(tier, _)| tier.name != name);
    pieces.all.retain(|_, it| it.tier != name);
    let below = pieces.tiers.iter();
    let below = below.filter(|it| it.1.as_deref() == Some(name));
    let below: Vec<String> = below.map(|(tier, _)| tier.name.clone()).collect();
    for name in below {
        remove_tier(pieces, &name);
    }
}

/// Splits an annotation with times; the second part gets the children that begin later or come later in their chains.
fn split(pieces: &mut TranscriptPieces, id: &str) {
    let first = pieces.all[id].clone();
    let (start, end) = times(&first);
    let middle = i64::midpoint(start, end);
    set_times(pieces, id, start, middle);
    let second = put(pieces, &first.tier, (first.above.as_deref(), 0.0), &first.it.value);
    set_times(pieces, &second, middle, end);
    for it in pieces.all.values_mut() {
        if it.above.as_deref() == Some(id) && (it.rank > 0.0 || times(it).0 >= middle) {
            it.above = Some(second.clone());
        }
    }
}

/// Changes a document as an annotator does.
fn edited(it: &AnnotationTranscript, numbers: &mut Seeded, deeds: u64) -> AnnotationTranscript {
    let mut pieces = TranscriptPieces::pieces_from_transcript(it);
    for deed in 0..deeds {
        let ids: Vec<String> = pieces.all.keys().cloned().collect();
        if ids.is_empty() {
            break;
        }
        let id = ids[numbers.below(ids.len() as u64) as usize].clone();
        let old = pieces.all[&id].clone();
        let stereotype = stereotype(&pieces, &old.tier);
        let chained = stereotype.is_some_and(|it| !it.is_alignable());
        let (start, end) = times(&old);
        let new = format!("N{deed}");
        match numbers.below(12) {
            0 => {
                if let Some(own) = pieces.all.get_mut(&id) {
                    own.it.value.clone_from(&new);
                }
            }
            1 if !chained => {
                let most = u64::try_from(end - start).expect("a length").max(2);
                let by = numbers.below(most - 1) as i64;
                // Times that are rounded alike are no change.
                if by > TIME_TOLERANCE_MICROS {
                    set_times(&mut pieces, &id, start + by, end);
                }
            }
            2 | 3 => remove(&mut pieces, &id),
            4 if stereotype == Some(TierStereotype::SymbolicSubdivision) => {
                let chain = (old.above.as_deref(), old.rank + 0.5 - numbers.below(2) as f64);
                put(&mut pieces, &old.tier, chain, &new);
            }
            5 if !chained => {
                let added = put(&mut pieces, &old.tier, (old.above.as_deref(), 0.0), &new);
                set_times(&mut pieces, &added, end, end + (end - start) / 3);
            }
            6 if !chained && end - start > 10_000 => split(&mut pieces, &id),
            7 if numbers.below(3) == 0 => remove_tier(&mut pieces, &old.tier),
            8 => pieces.rename_loose_tier(&old.tier, &new),
            9 => {
                let tier = TranscriptTier {
                    name: new.clone(),
                    kind: "k".into(),
                    stereotype: Some(TierStereotype::SymbolicAssociation),
                    ..TranscriptTier::default()
                };
                pieces.tiers.push((tier, Some(old.tier.clone())));
                put(&mut pieces, &new, (Some(&id), 0.0), &new);
            }
            10 => {
                if let Some(own) = pieces.all.get_mut(&id) {
                    own.rank = -f64::from(u32::try_from(deed).expect("few")) - 1.0;
                }
            }
            _ => {
                if let Some((tier, _)) = pieces.find_loose_tier(&old.tier) {
                    tier.participant = Some(new);
                }
            }
        }
    }
    pieces.reassemble_transcript()
}

/// Adds a tier that has nothing to do with the others.
fn with_another_tier(it: &AnnotationTranscript) -> AnnotationTranscript {
    let mut pieces = TranscriptPieces::pieces_from_transcript(it);
    let tier = TranscriptTier {
        name: "another".into(),
        ..TranscriptTier::default()
    };
    pieces.tiers.push((tier, None));
    put(&mut pieces, "another", (None, 0.0), "mine");
    pieces.reassemble_transcript()
}

fn unchanged_side_gives_the_other(seed: u64, deeds: u64) {
    let numbers = &mut Seeded(seed);
    let base = base(numbers);
    let other = edited(&base, numbers, deeds);
    let [more, most] = [&base, &other].map(with_another_tier);
    let cases: BTreeMap<&str, _> = BTreeMap::from([
        ("theirs changed", (merge_transcripts(&base, &base, &other), &other)),
        ("mine changed", (merge_transcripts(&base, &other, &base), &other)),
        ("both changed alike", (merge_transcripts(&base, &other, &other), &other)),
        (
            "mine has another tier",
            (merge_transcripts(&base, &more, &other), &most),
        ),
        (
            "theirs has another tier",
            (merge_transcripts(&base, &other, &more), &most),
        ),
    ]);
    for (name, (merged, want)) in cases {
        let message = format!("{name}\n{:#?}\n{:#?}", shown(&base), shown(&other));
        assert_eq!(shown(&merged.document), shown(want), "{message}");
        assert_eq!(merged.conflicts, [], "{message}");
        let left = diff_transcripts(want, &merged.document);
        assert!(left.is_empty(), "{message}\n{left:#?}");
    }
}

#[test]
fn an_annotation_with_words_and_their_parts_is_removed_as_a_whole() {
    let words = "Gloss: a1 0-1000 A, a2 1000-2000 B\nc <Gloss: a3 ^a1 X, a4 ^a1 Y\nd <c: a5 ^a3 M, a6 ^a4 N";
    for left in [
        "Gloss: a2 1000-2000 B\nc <Gloss:\nd <c:",
        "Gloss: a1 0-1000 A, a2 1000-2000 B\nc <Gloss: a3 ^a1 X\nd <c: a5 ^a3 M",
        "Gloss: a1 0-1000 A, a2 1000-2000 B",
    ] {
        super::merges(words, words, left, left, 0);
    }
    // A changed part is a conflict, and so is the removal of all that it belongs to.
    let [base, mine, theirs] = [
        words.to_owned(),
        words.replace('M', "M2"),
        "Gloss: a2 1000-2000 B\nc <Gloss:\nd <c:".to_owned(),
    ]
    .map(|text| super::document(&text));
    let merged = merge_transcripts(&base, &mine, &theirs);
    let want = "Gloss: a1 0-1000 A, a2 1000-2000 B\nc <Gloss: a3 ^a1 X\nd <c: a5 ^a3 M2";
    assert_eq!(shown(&merged.document), shown(&super::document(want)));
    let sides = merged.conflicts.iter().map(|it| {
        let mine = it.mine.as_ref().map(|it| it.value.as_str());
        (mine, it.theirs.is_some())
    });
    let sides: BTreeMap<_, _> = sides.collect();
    let want = [(Some("A"), false), (Some("M2"), false), (Some("X"), false)];
    assert_eq!(sides, BTreeMap::from(want));
}

#[test]
fn a_chain_gets_the_order_of_the_side_that_changed_it() {
    let base = "Gloss: a1 0-900 A\nw <Gloss: a2 ^a1 p, a3 ^a1 q, a4 ^a1 r, a5 ^a1 s";
    for chain in [
        "a5 ^a1 s, a4 ^a1 r, a3 ^a1 q, a2 ^a1 p",
        "a4 ^a1 r, a6 ^a1 n, a2 ^a1 p, a3 ^a1 q, a5 ^a1 s",
        "a3 ^a1 q, a5 ^a1 s, a2 ^a1 p",
    ] {
        let other = format!("Gloss: a1 0-900 A\nw <Gloss: {chain}");
        super::merges(base, base, &other, &other, 0);
    }
}

#[test]
fn what_both_moved_and_added_alike_is_no_conflict_although_it_overlaps() {
    let base = "phase: a1 3000-3200 A, a2 3400-3600 B";
    let other = "phase: a1 3000-3200 A, a3 3400-3467 N, a2 3400-3500 B, a4 3500-3600 B";
    super::merges(base, other, other, other, 0);
    for (seed, deeds) in [(9_755_687_742_123_914_689, 2), (6_438_491_371_946_492_730, 4)] {
        unchanged_side_gives_the_other(seed, deeds);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn a_merge_with_an_unchanged_side_gives_the_other_for_every_stereotype(
        seed in any::<u64>(),
        deeds in 0u64..6,
    ) {
        unchanged_side_gives_the_other(seed, deeds);
    }
}
