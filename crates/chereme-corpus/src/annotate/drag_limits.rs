//! Annotations that are being dragged: their neighbours on the tier, and the limits of their movement.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::TierStereotype;
use chereme_sign::tier::tier_spans::{self, DragGrip, NeighbourMode, SpanItem, SpanLimits};

use crate::contents::{RecordingContents, TierContents};
use crate::db::stored_tiers::TierRow;

/// The shortest length of an annotation in a recording without frames: a hundredth of a second.
pub const MIN_ANNOTATION_US: i64 = 10_000;
/// The end of a recording without movement, which annotations can extend.
pub(super) const OPEN_RECORDING_END_US: i64 = 1 << 50;

/// How the annotations of a tier get their times.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TierTiming {
    /// Times of their own.
    Root,
    /// Times of their own, within the parent annotation.
    Inside,
    /// They divide the time of the parent annotation without gaps.
    Tiled,
    /// No times of their own.
    Listed,
}

impl TierTiming {
    /// Returns the kind of a tier.
    #[must_use]
    pub fn timing_of_tier(row: &TierRow) -> Self {
        if row.parent_id.is_none() {
            return Self::Root;
        }
        match row.stereotype {
            Some(TierStereotype::TimeSubdivision) => Self::Tiled,
            Some(TierStereotype::IncludedIn) | None => Self::Inside,
            Some(_) => Self::Listed,
        }
    }
}

/// Annotations of one tier that are being dragged, with those that may be in their way.
#[derive(Debug, Clone, PartialEq)]
pub struct DraggedAnnotations {
    /// The row of the tier.
    pub tier: i64,
    /// How its annotations get their times.
    pub kind: TierTiming,
    /// The annotations that may be in the way, including the dragged ones, in order of time.
    pub items: Vec<SpanItem>,
    /// The dragged annotations.
    pub chosen: BTreeSet<i64>,
    /// The time limits of the dragged annotations.
    pub limits: SpanLimits,
}

impl DraggedAnnotations {
    /// Returns the annotations that change when they are dragged.
    #[must_use]
    pub fn drag_annotations(&self, grip: DragGrip, by: i64, mode: NeighbourMode) -> Vec<SpanItem> {
        match self.kind {
            TierTiming::Listed => Vec::new(),
            TierTiming::Tiled => tier_spans::drag_tiled_spans(&self.items, &self.chosen, grip, by, self.limits),
            _ => tier_spans::drag_spans(&self.items, &self.chosen, grip, by, mode, self.limits),
        }
    }

    /// Returns the changes that must be requested, in an order that never overlaps.
    #[must_use]
    pub fn requested_drag_changes(&self, changed: &[SpanItem]) -> Vec<SpanItem> {
        if self.kind == TierTiming::Tiled {
            // The neighbours' shared boundaries are adjusted automatically.
            let chosen_items = changed.iter().filter(|item| self.chosen.contains(&item.id));
            return chosen_items.copied().collect();
        }
        tier_spans::order_span_changes(&self.items, changed)
    }
}

/// Returns the time limits for annotations of a recording; `frames` means that it has movement.
#[must_use]
pub fn annotation_time_limits(contents: &RecordingContents, frames: bool) -> SpanLimits {
    let to = if frames {
        contents.recording.duration_us
    } else {
        OPEN_RECORDING_END_US
    };
    SpanLimits {
        from: 0,
        to,
        least: MIN_ANNOTATION_US,
    }
}

/// Returns what is dragged if `chosen` are, tier by tier. Annotations whose parent is dragged too move with it and are
/// left out.
#[must_use]
pub fn held_drag_groups(contents: &RecordingContents, chosen: &BTreeSet<i64>, frames: bool) -> Vec<DraggedAnnotations> {
    let limits = annotation_time_limits(contents, frames);
    let mut all = Vec::new();
    for tier in &contents.tiers {
        let columns = &tier.annotations;
        let mut families: BTreeMap<Option<i64>, BTreeSet<i64>> = BTreeMap::new();
        let kind = TierTiming::timing_of_tier(&tier.row);
        for at in chosen_annotation_indices(tier, chosen) {
            let parent = columns.parents.get(at).copied().flatten();
            if parent.is_some_and(|parent| chosen.contains(&parent)) {
                continue;
            }
            let family = parent.filter(|_| kind != TierTiming::Root);
            families.entry(family).or_default().insert(columns.ids[at]);
        }
        for (parent, chosen) in families {
            let above = parent.and_then(|parent| span_of(contents, parent));
            let limits = match above {
                Some((from, to)) => SpanLimits { from, to, ..limits },
                None => limits,
            };
            all.push(DraggedAnnotations {
                tier: tier.row.id,
                kind,
                items: timed_annotation_items(tier, parent),
                chosen,
                limits,
            });
        }
    }
    all
}

/// Returns annotations together with all their descendants.
#[must_use]
pub fn with_below(contents: &RecordingContents, mut all: BTreeSet<i64>) -> BTreeSet<i64> {
    loop {
        let before = all.len();
        for columns in contents.tiers.iter().map(|tier| &tier.annotations) {
            let pairs = columns.ids.iter().zip(&columns.parents);
            let child_pairs = pairs.filter(|(_, parent)| parent.is_some_and(|id| all.contains(&id)));
            let below: Vec<i64> = child_pairs.map(|(id, _)| *id).collect();
            all.extend(below);
        }
        if all.len() == before {
            return all;
        }
    }
}

/// Returns the indices of the annotations of a tier that are in `chosen`.
pub fn chosen_annotation_indices<'a>(
    tier: &'a TierContents,
    chosen: &'a BTreeSet<i64>,
) -> impl Iterator<Item = usize> + 'a {
    let ids = tier.annotations.ids.iter().enumerate();
    let none = chosen.is_empty();
    ids.filter(move |(_, id)| !none && chosen.contains(id))
        .map(|(at, _)| at)
}

/// Returns the annotations of a tier with times; if `parent` is given, only its children.
#[must_use]
pub fn timed_annotation_items(tier: &TierContents, parent: Option<i64>) -> Vec<SpanItem> {
    let columns = &tier.annotations;
    (0..columns.len())
        .filter(|at| parent.is_none() || columns.parents.get(*at).copied().flatten() == parent)
        .map(|at| SpanItem {
            id: columns.ids[at],
            start: columns.starts[at],
            end: columns.ends[at],
        })
        .collect()
}

/// Returns the time of an annotation of the recording.
fn span_of(contents: &RecordingContents, id: i64) -> Option<(i64, i64)> {
    contents.tiers.iter().find_map(|tier| {
        let columns = &tier.annotations;
        let index = columns.ids.iter().position(|other| *other == id)?;
        Some((columns.starts[index], columns.ends[index]))
    })
}

/// Returns the room for a new annotation of a tier within `wanted`: the free time, and on a tier below another the part
/// inside one annotation of that tier.
#[must_use]
pub fn room_for_annotation(
    contents: &RecordingContents,
    tier: &TierContents,
    wanted: (i64, i64),
) -> Option<(i64, i64)> {
    let tier_items = timed_annotation_items(tier, None);
    let kind = TierTiming::timing_of_tier(&tier.row);
    let parent = contents
        .tiers
        .iter()
        .find(|candidate| Some(candidate.row.id) == tier.row.parent_id);
    let Some(parent) = parent.filter(|_| kind != TierTiming::Root) else {
        return tier_spans::longest_free_span(&tier_items, wanted.0, wanted.1);
    };
    let mut best: Option<(i64, i64)> = None;
    for above in timed_annotation_items(parent, None) {
        let inside = (above.start.max(wanted.0), above.end.min(wanted.1));
        if inside.0 >= inside.1 {
            continue;
        }
        let free_room = match kind {
            TierTiming::Inside => tier_spans::longest_free_span(&tier_items, inside.0, inside.1),
            TierTiming::Listed => Some((above.start, above.end)),
            _ => tiled_room(&tier_items, above, inside),
        };
        let length = |span: (i64, i64)| span.1.min(wanted.1) - span.0.max(wanted.0);
        if let Some(found) = free_room.filter(|range| best.is_none_or(|best| length(*range) > length(best))) {
            best = Some(found);
        }
    }
    best
}

/// Returns the whole parent if it has no child yet, otherwise the tail of the child in which `wanted` begins, or its
/// head if both begin together.
fn tiled_room(own: &[SpanItem], above: SpanItem, wanted: (i64, i64)) -> Option<(i64, i64)> {
    let mut below = own
        .iter()
        .filter(|item| item.start >= above.start && item.end <= above.end)
        .peekable();
    if below.peek().is_none() {
        return Some((above.start, above.end));
    }
    let sibling = below.find(|item| item.start <= wanted.0 && wanted.0 < item.end)?;
    if wanted.0 > sibling.start {
        return Some((wanted.0, sibling.end));
    }
    (wanted.1 < sibling.end).then_some((sibling.start, wanted.1))
}

#[cfg(test)]
mod tests {
    use super::super::testing::contents;
    use super::*;

    #[test]
    fn children_stay_inside_and_move_with_a_dragged_parent() {
        let all = contents(&[
            (1, None, "", &[(1, 0, 400_000, None), (2, 500_000, 900_000, None)]),
            (
                2,
                Some(1),
                "Included_In",
                &[(3, 100_000, 200_000, Some(1)), (4, 600_000, 700_000, Some(2))],
            ),
        ]);
        let one = held_drag_groups(&all, &BTreeSet::from([3]), true);
        assert_eq!(one.len(), 1);
        assert_eq!((one[0].limits.from, one[0].limits.to), (0, 400_000));
        let moved = one[0].drag_annotations(DragGrip::Whole, 900_000, NeighbourMode::Normal);
        assert_eq!((moved[0].start, moved[0].end), (300_000, 400_000));
        let both = held_drag_groups(&all, &BTreeSet::from([1, 3, 4]), true);
        let tiers: Vec<_> = both.iter().map(|it| (it.tier, it.chosen.clone())).collect();
        assert_eq!(tiers, [(1, BTreeSet::from([1])), (2, BTreeSet::from([4]))]);
    }

    #[test]
    fn neighbours_on_a_tiled_tier_share_their_boundary() {
        let all = contents(&[
            (1, None, "", &[(1, 0, 400_000, None)]),
            (
                2,
                Some(1),
                "Time_Subdivision",
                &[(3, 0, 200_000, Some(1)), (4, 200_000, 400_000, Some(1))],
            ),
        ]);
        let held = held_drag_groups(&all, &BTreeSet::from([3]), true);
        let changed = held[0].drag_annotations(DragGrip::End, 100_000, NeighbourMode::Shift);
        let spans: Vec<_> = changed.iter().map(|it| (it.id, it.start, it.end)).collect();
        assert_eq!(spans, [(3, 0, 300_000), (4, 300_000, 400_000)]);
        assert_eq!(held[0].requested_drag_changes(&changed), [changed[0]]);
        assert!(
            held[0]
                .drag_annotations(DragGrip::Start, -9, NeighbourMode::Normal)
                .is_empty()
        );
    }

    #[test]
    fn the_free_time_for_a_new_annotation_depends_on_the_tier_kind() {
        let parents: &[_] = &[(1, 0, 400_000, None), (2, 500_000, 900_000, None)];
        let below: &[_] = &[(3, 100_000, 200_000, Some(1))];
        let tiled: &[_] = &[(4, 0, 400_000, Some(1))];
        let all = contents(&[
            (1, None, "", parents),
            (2, Some(1), "Included_In", below),
            (3, Some(1), "Symbolic_Association", &[]),
            (4, Some(1), "Time_Subdivision", tiled),
        ]);
        let cases = [
            (0, (350_000, 600_000), Some((400_000, 500_000))),
            (1, (0, 950_000), Some((500_000, 900_000))),
            (1, (150_000, 450_000), Some((200_000, 400_000))),
            (2, (550_000, 560_000), Some((500_000, 900_000))),
            (2, (410_000, 450_000), None),
            (3, (100_000, 200_000), Some((100_000, 400_000))),
            (3, (600_000, 700_000), Some((500_000, 900_000))),
        ];
        for (tier, wanted, want) in cases {
            assert_eq!(
                room_for_annotation(&all, &all.tiers[tier], wanted),
                want,
                "{tier} {wanted:?}"
            );
        }
    }
}
