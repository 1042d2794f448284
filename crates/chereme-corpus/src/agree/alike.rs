//! Two tiers of one recording that seem to code the same thing, as a proposal of what to compare.

use std::collections::BTreeSet;

use chereme_sign::TierRole;
use chereme_sign::text::fold_text;

use crate::contents::TierContents;
use crate::db::stored_tiers::TierRow;

/// The fewest letters that two names must share to be alike.
const MIN_SHARED_LETTERS: usize = 3;
/// The least score of a proposal: names alike, or two annotators, or a role that both have.
const MIN_PROPOSAL_SCORE: f64 = 2.0;

/// Returns the two tiers of a recording that most probably code the same thing, in their order; nothing if no two do.
///
/// Both have annotations, the same role and hand, and no two participants or languages, and neither is below the other. Different
/// annotators, names that differ in one part, a role other than free text and common values count for a pair.
#[must_use]
pub fn alike_tiers(tiers: &[TierContents]) -> Option<[i64; 2]> {
    let filled: Vec<(&TierRow, BTreeSet<&str>)> = tiers
        .iter()
        .filter(|tier| !tier.annotations.is_empty())
        .map(|tier| {
            let values = tier.annotations.values.iter().map(AsRef::as_ref);
            (&tier.row, values.filter(|value| !value.is_empty()).collect())
        })
        .collect();
    let mut best: Option<(f64, [i64; 2])> = None;
    for (at, (a, of_a)) in filled.iter().enumerate() {
        for (b, of_b) in &filled[at + 1..] {
            if !may_be_compared(a, b) {
                continue;
            }
            // Common values only order the pairs: free texts about the same signs share many values, too.
            let pair_score = tier_pair_score(a, b) + 3.0 * common_value_share(of_a, of_b);
            if tier_pair_score(a, b) >= MIN_PROPOSAL_SCORE && best.is_none_or(|(most, _)| pair_score > most) {
                best = Some((pair_score, [a.id, b.id]));
            }
        }
    }
    best.map(|(_, pair)| pair)
}

/// Returns whether two tiers can code the same thing of the same person.
fn may_be_compared(a: &TierRow, b: &TierRow) -> bool {
    let may_be_same = |a: &Option<String>, b: &Option<String>| match (a, b) {
        (Some(a), Some(b)) => {
            let (a, b) = (fold_text(a.trim()), fold_text(b.trim()));
            // A value that one tier leaves out does not contradict the other.
            a == b || a.is_empty() || b.is_empty()
        }
        _ => true,
    };
    a.tier_topic() == b.tier_topic()
        && may_be_same(&a.participant, &b.participant)
        && may_be_same(&a.language, &b.language)
        && a.parent_id != Some(b.id)
        && b.parent_id != Some(a.id)
}

/// Returns how much the descriptions of two tiers speak for a pair.
fn tier_pair_score(a: &TierRow, b: &TierRow) -> f64 {
    let annotator = |tier: &TierRow| fold_text(tier.annotator.as_deref().unwrap_or_default().trim());
    let (one, other) = (annotator(a), annotator(b));
    let two_people = !one.is_empty() && !other.is_empty() && one != other;
    let mut score = 0.0;
    for (holds, weight) in [
        (two_people, 3.0),
        (a.role != TierRole::Free, 2.0),
        (names_are_alike(&a.name, &b.name), 2.0),
    ] {
        score += if holds { weight } else { 0.0 };
    }
    score
}

/// Returns whether two names differ in one part only, which is no longer than what they share.
fn names_are_alike(a: &str, b: &str) -> bool {
    let (a, b): (Vec<char>, Vec<char>) = (fold_text(a).chars().collect(), fold_text(b).chars().collect());
    let same = |pair: &(&char, &char)| pair.0 == pair.1;
    let before = a.iter().zip(&b).take_while(same).count();
    // The ending may not use letters of the beginning again, as in `aa` and `aaa`.
    let rest = a.len().min(b.len()) - before;
    let ending_pairs = a.iter().rev().zip(b.iter().rev()).take(rest);
    let after = ending_pairs.take_while(same).count();
    let shared = before + after;
    shared >= MIN_SHARED_LETTERS && 2 * shared >= a.len().max(b.len())
}

/// Returns the share of values that both have among all values.
fn common_value_share(a: &BTreeSet<&str>, b: &BTreeSet<&str>) -> f64 {
    match a.union(b).count() {
        0 => 0.0,
        all => a.intersection(b).count() as f64 / all as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contents::AnnotationColumns;
    use crate::{AnnotatedHands, ValueState};
    use chereme_sign::HandRef;

    /// Returns a tier with an annotation of each value.
    fn tier(id: i64, name: &str, values: &[&str], of: impl FnOnce(&mut TierRow)) -> TierContents {
        let mut row = TierRow {
            id,
            name: name.to_owned(),
            ..TierRow::default()
        };
        of(&mut row);
        let count = values.len();
        TierContents {
            row,
            annotations: AnnotationColumns {
                ids: (0..count as i64).collect(),
                starts: (0..count as i64).collect(),
                ends: (1..=count as i64).collect(),
                states: vec![ValueState::Value; count],
                values: values.iter().map(|it| Box::from(*it)).collect(),
                parents: vec![None; count],
                confidences: vec![None; count],
            },
        }
    }

    fn plain(_: &mut TierRow) {}

    #[test]
    fn names_that_differ_in_one_part_are_alike() {
        for (a, b, alike) in [
            ("Gloss-A", "Gloss-B", true),
            ("Gloss Anna", "gloss ben", true),
            ("Anna Gloss", "Ben Gloss", true),
            ("RH 1", "RH 2", true),
            ("left", "right", false),
            ("Gloss", "Mouth", false),
            ("A", "B", false),
            ("", "", false),
        ] {
            assert_eq!(names_are_alike(a, b), alike, "{a} {b}");
        }
    }

    #[test]
    fn the_pair_that_codes_the_same_is_proposed() {
        let annotator = |name: &'static str| move |it: &mut TierRow| it.annotator = Some(name.to_owned());
        let gloss = |it: &mut TierRow| it.role = TierRole::Gloss;
        // Names, annotators and roles each suffice.
        let names = [
            tier(1, "Text", &["a"], plain),
            tier(2, "Gloss-A", &["CAT"], plain),
            tier(3, "Gloss-B", &["CAT"], plain),
        ];
        assert_eq!(alike_tiers(&names), Some([2, 3]));
        let people = [
            tier(1, "x", &["CAT"], annotator("Anna")),
            tier(2, "other", &["CAT"], annotator("Ben")),
        ];
        assert_eq!(alike_tiers(&people), Some([1, 2]));
        let roles = [tier(1, "x", &["CAT"], gloss), tier(2, "other", &["DOG"], gloss)];
        assert_eq!(alike_tiers(&roles), Some([1, 2]));
        // Common values decide between several pairs.
        let several = [
            tier(1, "Tier 1", &["a"], plain),
            tier(2, "Tier 2", &["b", "c"], plain),
            tier(3, "Tier 3", &["b", "c"], plain),
        ];
        assert_eq!(alike_tiers(&several), Some([2, 3]));
    }

    #[test]
    fn other_hands_people_languages_and_empty_tiers_are_no_pair() {
        let hand = |hand| move |it: &mut TierRow| (it.role, it.hand) = (TierRole::Gloss, Some(hand));
        let person = |name: &'static str| move |it: &mut TierRow| it.participant = Some(name.to_owned());
        let language = |name: &'static str| {
            move |it: &mut TierRow| {
                (it.role, it.language) = (TierRole::Translation, Some(name.to_owned()));
            }
        };
        let below = |it: &mut TierRow| it.parent_id = Some(1);
        for (what, one, other) in [
            (
                "hands",
                tier(1, "Gloss R", &["A"], hand(AnnotatedHands::One(HandRef::Right))),
                tier(2, "Gloss L", &["A"], hand(AnnotatedHands::One(HandRef::Left))),
            ),
            (
                "people",
                tier(1, "Gloss 1", &["A"], person("Zoé")),
                tier(2, "Gloss 2", &["A"], person("Max")),
            ),
            (
                "languages",
                tier(1, "Translation FR", &["A"], language("fra")),
                tier(2, "Translation EN", &["A"], language("eng")),
            ),
            (
                "a parent",
                tier(1, "Gloss 1", &["A"], plain),
                tier(2, "Gloss 2", &["A"], below),
            ),
            (
                "an empty tier",
                tier(1, "Gloss 1", &["A"], plain),
                tier(2, "Gloss 2", &[], plain),
            ),
        ] {
            assert_eq!(alike_tiers(&[one, other]), None, "{what}");
        }
        assert_eq!(alike_tiers(&[]), None);
    }
}
