//! Random changes, one after another, and the laws that always hold.

use proptest::prelude::*;

use super::super::*;
use super::{example, show, span};

/// A random change: numbers that select its kind, its place, its time and its length.
type Dice = (u8, u8, u8, u8);

fn rolled(set: &TierSet, (what, whom, start, length): Dice, unique: u64) -> AskedTierChange {
    let timed = matches!(what % 9, 3..=5);
    let fits = |note: &&TierAnnotation| !timed || set.tier_by_id(note.tier).is_some_and(Tier::is_alignable);
    let count = set.all_annotations().filter(fits).count().max(1);
    let picked = set.all_annotations().filter(fits).nth(usize::from(whom) % count);
    let annotation = picked.map_or(AnnotationId(0), |note| note.id);
    let old = picked.map_or(span(0, 1), |note| note.span);
    let tier = TierId(1 + u64::from(whom) % 8);
    let (start, length) = (i64::from(start), i64::from(length));
    let wanted = span(start % 60, start % 60 + length % 14);
    let order = length as u32 % 4;
    let value = ComponentReading::Value(format!("v{unique}"));
    match what % 9 {
        0 => AskedTierChange::Add {
            tier,
            span: wanted,
            value,
        },
        1 => {
            let below = set.tiers_below(picked.map_or(tier, |note| note.tier));
            let tier = below
                .filter(|tier| tier.is_alignable())
                .last()
                .map_or(tier, |tier| tier.id);
            AskedTierChange::Add { tier, span: old, value }
        }
        2 => {
            let below = set.tiers_below(picked.map_or(tier, |note| note.tier));
            let tier = below
                .filter(|tier| !tier.is_alignable())
                .last()
                .map_or(tier, |tier| tier.id);
            AskedTierChange::AddBelow {
                tier,
                parent: annotation,
                order: Some(order),
                value,
            }
        }
        3 => AskedTierChange::Move {
            annotation,
            span: wanted,
        },
        4 => {
            let (a, b) = (
                old.span_start_instant().shifted_instant(start % 3 * 700),
                old.span_end_instant().shifted_instant(length % 3 * 900 - 900),
            );
            AskedTierChange::Move {
                annotation,
                span: TimeSpan::span_between(a, b),
            }
        }
        5 => {
            let at = old
                .span_start_instant()
                .shifted_instant(start * 97 % old.span_micros().max(1));
            AskedTierChange::Split { annotation, at }
        }
        6 => {
            let siblings: Vec<AnnotationId> = picked
                .into_iter()
                .flat_map(|note| set.annotations_on_tier(note.tier))
                .map(|note| note.id)
                .collect();
            let place = siblings.iter().position(|id| *id == annotation).unwrap_or(0);
            let second = siblings.get(place + 1).copied().unwrap_or(annotation);
            let seam = if length % 2 == 0 {
                MergeSeam::Keep
            } else {
                MergeSeam::Join
            };
            AskedTierChange::Merge {
                first: annotation,
                second,
                value: Some(value),
                seam,
            }
        }
        7 => AskedTierChange::Remove { annotation },
        _ => AskedTierChange::Reorder { annotation, order },
    }
}

/// Runs the changes that are accepted, and hands each step to `each`.
fn run(dice: &[Dice], mut each: impl FnMut(&TierSet, &AskedTierChange, &[TierEdit])) -> (TierSet, usize) {
    let mut set = example();
    let (mut next, mut accepted) = (1000, 0);
    for roll in dice {
        let change = rolled(&set, *roll, next);
        let edits = plan_tier_change(&set, &change, &mut || {
            next += 1;
            AnnotationId(next)
        });
        next += 1;
        if let Ok(edits) = edits {
            each(&set, &change, &edits);
            set.apply_edits(edits);
            accepted += 1;
        }
    }
    (set, accepted)
}

/// Returns the part of `set` that a change needs according to [`AskedTierChange::change_window`].
fn neighbourhood(set: &TierSet, change: &AskedTierChange) -> TierSet {
    let mut named: Vec<&TierAnnotation> = change
        .changed_annotations()
        .iter()
        .filter_map(|id| set.annotation_by_id(*id))
        .collect();
    let parents = |note: &&TierAnnotation| note.parent.and_then(|parent| set.annotation_by_id(parent));
    let mut kept: BTreeMap<AnnotationId, TierAnnotation> = BTreeMap::new();
    for note in named.iter().copied().chain(named.iter().filter_map(parents)) {
        kept.insert(note.id, note.clone());
    }
    let symbolic = |note: &&&TierAnnotation| set.tier_by_id(note.tier).is_some_and(|t| !t.is_alignable());
    let above: Vec<&TierAnnotation> = named.iter().filter(symbolic).filter_map(parents).collect();
    named.extend(above);
    let tier = match change {
        AskedTierChange::Add { tier, .. } | AskedTierChange::AddBelow { tier, .. } => Some(*tier),
        _ => named.first().map(|note| note.tier),
    };
    let parent_tier = tier.and_then(|tier| set.tier_by_id(tier)).and_then(Tier::parent_id);
    if let Some(window) = change.change_window(&named) {
        let near = |note: &&TierAnnotation| {
            note.span.span_start_instant() <= window.span_end_instant()
                && note.span.span_end_instant() >= window.span_start_instant()
        };
        let mut open: Vec<&TierAnnotation> = Vec::new();
        for note in set.all_annotations().filter(near) {
            if Some(note.tier) == tier || Some(note.tier) == parent_tier {
                kept.insert(note.id, note.clone());
            }
            if Some(note.tier) == tier {
                open.push(note);
            }
        }
        while let Some(note) = open.pop() {
            kept.insert(note.id, note.clone());
            open.extend(set.annotations_below(note.id));
        }
    }
    TierSet::new(set.all_tiers().cloned(), kept.into_values())
}

fn dice() -> impl Strategy<Value = Vec<Dice>> {
    proptest::collection::vec(any::<Dice>(), 0..60)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn accepted_changes_never_break_a_rule(dice in dice()) {
        run(&dice, |set, change, edits| {
            let mut after = set.clone();
            for edit in edits {
                match edit {
                    TierEdit::Put(note) => {
                        let parent = note.parent.is_none_or(|parent| after.annotation_by_id(parent).is_some());
                        assert!(parent, "{change:?} puts {} before its parent", note.id);
                    }
                    TierEdit::Remove(id) => {
                        assert_eq!(after.annotations_below(*id).next(), None, "{change:?} leaves children of {id}");
                    }
                }
                after.apply_edits([edit.clone()]);
            }
            assert_eq!(check_tier_set(&after), [], "{change:?} {}", show(set, edits));
        });
    }

    #[test]
    fn planning_on_the_neighbourhood_equals_planning_on_the_whole(dice in dice()) {
        run(&dice, |set, change, edits| {
            let part = neighbourhood(set, change);
            let first = edits.iter().filter_map(|edit| match edit {
                TierEdit::Put(note) if set.annotation_by_id(note.id).is_none() => Some(note.id.0),
                _ => None,
            }).min();
            let mut next = first.unwrap_or(0);
            let again = plan_tier_change(&part, change, &mut || { next += 1; AnnotationId(next - 1) });
            assert_eq!(again.as_deref(), Ok(edits), "{change:?}");
        });
    }

    #[test]
    fn merging_undoes_a_split(dice in dice(), whom in any::<u8>(), cut in any::<u8>()) {
        let (mut set, _) = run(&dice, |_, _, _| {});
        let notes: Vec<TierAnnotation> = set.all_annotations().cloned().collect();
        set.apply_edits(notes.into_iter().map(|note| {
            TierEdit::Put(TierAnnotation { value: ComponentReading::Value(note.id.to_string()), ..note })
        }));
        let aligned: Vec<TierAnnotation> = set
            .all_annotations()
            .filter(|note| set.tier_by_id(note.tier).is_some_and(Tier::is_alignable))
            .filter(|note| note.span.span_micros() > 1)
            .cloned()
            .collect();
        prop_assume!(!aligned.is_empty());
        let note = &aligned[usize::from(whom) % aligned.len()];
        let at = note.span.span_start_instant().shifted_instant(1 + i64::from(cut) % (note.span.span_micros() - 1));
        let mut next = 1_000_000;
        let mut fresh = || { next += 1; AnnotationId(next) };
        let mut halves = set.clone();
        let split = AskedTierChange::Split { annotation: note.id, at };
        halves.apply_edits(plan_tier_change(&set, &split, &mut fresh).expect("a cut inside"));
        prop_assert_eq!(check_tier_set(&halves), []);
        let (first, second) = (note.id, AnnotationId(1_000_001));
        let merge = AskedTierChange::Merge { first, second, value: None, seam: MergeSeam::Join };
        let edits = plan_tier_change(&halves, &merge, &mut fresh).expect("two halves are neighbours");
        halves.apply_edits(edits);
        prop_assert_eq!(halves, set);
    }

    #[test]
    fn shares_tile_the_parent(start in -50i64..50, length in 0i64..100, count in 1usize..12) {
        let parent = span(start, start + length);
        let mut covered = parent.span_start_instant();
        for place in 0..count {
            let share = subdivision_share(parent, place, count);
            prop_assert_eq!(share.span_start_instant(), covered);
            prop_assert!((share.span_micros() - length * 1000 / count as i64) <= 1);
            covered = share.span_end_instant();
        }
        prop_assert_eq!(covered, parent.span_end_instant());
    }
}

#[test]
fn random_changes_are_often_accepted() {
    let dice: Vec<Dice> = (0..2000u32)
        .map(|n| {
            let [a, b, c, d] = n.wrapping_mul(2_654_435_761).to_be_bytes();
            (a, b, c, d)
        })
        .collect();
    let (_, accepted) = run(&dice, |_, _, _| {});
    assert!(accepted > 400, "{accepted} of 2000 random changes were accepted");
}
