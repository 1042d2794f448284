//! Annotations that are being dragged: their neighbours on the tier, and the limits of their movement.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::Stereotype;
use chereme_sign::tier::spans::{self, Grip, Item, Limits, Mode};

use crate::contents::{Contents, TierContents};
use crate::db::tiers::TierRow;

/// The shortest length of an annotation in a recording without frames: a hundredth of a second.
pub const LEAST: i64 = 10_000;
/// The end of a recording without movement, which annotations can extend.
pub(super) const FAR: i64 = 1 << 50;

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
    pub fn of(row: &TierRow) -> Self {
        if row.parent_id.is_none() {
            return Self::Root;
        }
        match row.stereotype {
            Some(Stereotype::TimeSubdivision) => Self::Tiled,
            Some(Stereotype::IncludedIn) | None => Self::Inside,
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
    pub items: Vec<Item>,
    /// The dragged annotations.
    pub chosen: BTreeSet<i64>,
    /// The time limits of the dragged annotations.
    pub limits: Limits,
}

impl DraggedAnnotations {
    /// Returns the annotations that change when they are dragged.
    #[must_use]
    pub fn dragged(&self, grip: Grip, by: i64, mode: Mode) -> Vec<Item> {
        match self.kind {
            TierTiming::Listed => Vec::new(),
            TierTiming::Tiled => spans::tiled(&self.items, &self.chosen, (grip, by), self.limits),
            _ => spans::dragged(&self.items, &self.chosen, (grip, by), mode, self.limits),
        }
    }

    /// Returns the changes that must be requested, in an order that never overlaps.
    #[must_use]
    pub fn asked(&self, changed: &[Item]) -> Vec<Item> {
        if self.kind == TierTiming::Tiled {
            // The neighbours' shared boundaries are adjusted automatically.
            let own = changed.iter().filter(|item| self.chosen.contains(&item.id));
            return own.copied().collect();
        }
        spans::in_order(&self.items, changed)
    }
}

/// Returns the time limits for annotations of a recording; `frames` means that it has movement.
#[must_use]
pub fn limits(contents: &Contents, frames: bool) -> Limits {
    let to = if frames {
        contents.recording.duration_us
    } else {
        FAR
    };
    Limits {
        from: 0,
        to,
        least: LEAST,
    }
}

/// Returns what is dragged if `chosen` are, tier by tier. Annotations whose parent is dragged too move with it and are
/// left out.
#[must_use]
pub fn held(contents: &Contents, chosen: &BTreeSet<i64>, frames: bool) -> Vec<DraggedAnnotations> {
    let limits = limits(contents, frames);
    let mut all = Vec::new();
    for tier in &contents.tiers {
        let columns = &tier.annotations;
        let mut families: BTreeMap<Option<i64>, BTreeSet<i64>> = BTreeMap::new();
        let kind = TierTiming::of(&tier.row);
        for at in places(tier, chosen) {
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
                Some((from, to)) => Limits { from, to, ..limits },
                None => limits,
            };
            all.push(DraggedAnnotations {
                tier: tier.row.id,
                kind,
                items: items(tier, parent),
                chosen,
                limits,
            });
        }
    }
    all
}

/// Returns annotations together with all their descendants.
#[must_use]
pub fn with_below(contents: &Contents, mut all: BTreeSet<i64>) -> BTreeSet<i64> {
    loop {
        let before = all.len();
        for columns in contents.tiers.iter().map(|tier| &tier.annotations) {
            let pairs = columns.ids.iter().zip(&columns.parents);
            let below = pairs.filter(|(_, parent)| parent.is_some_and(|it| all.contains(&it)));
            let below: Vec<i64> = below.map(|(id, _)| *id).collect();
            all.extend(below);
        }
        if all.len() == before {
            return all;
        }
    }
}

/// Returns the indices of the annotations of a tier that are in `chosen`.
pub fn places<'a>(
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
pub fn items(tier: &TierContents, parent: Option<i64>) -> Vec<Item> {
    let columns = &tier.annotations;
    (0..columns.len())
        .filter(|at| parent.is_none() || columns.parents.get(*at).copied().flatten() == parent)
        .map(|at| Item {
            id: columns.ids[at],
            start: columns.starts[at],
            end: columns.ends[at],
        })
        .collect()
}

/// Returns the time of an annotation of the recording.
fn span_of(contents: &Contents, id: i64) -> Option<(i64, i64)> {
    contents.tiers.iter().find_map(|tier| {
        let columns = &tier.annotations;
        let at = columns.ids.iter().position(|it| *it == id)?;
        Some((columns.starts[at], columns.ends[at]))
    })
}

/// Returns the room for a new annotation of a tier within `wanted`: the free time, and on a tier below another the part
/// inside one annotation of that tier.
#[must_use]
pub fn room(contents: &Contents, tier: &TierContents, wanted: (i64, i64)) -> Option<(i64, i64)> {
    let own = items(tier, None);
    let kind = TierTiming::of(&tier.row);
    let parent = contents
        .tiers
        .iter()
        .find(|it| Some(it.row.id) == tier.row.parent_id);
    let Some(parent) = parent.filter(|_| kind != TierTiming::Root) else {
        return spans::room(&own, wanted);
    };
    let mut best: Option<(i64, i64)> = None;
    for above in items(parent, None) {
        let inside = (above.start.max(wanted.0), above.end.min(wanted.1));
        if inside.0 >= inside.1 {
            continue;
        }
        let found = match kind {
            TierTiming::Inside => spans::room(&own, inside),
            TierTiming::Listed => Some((above.start, above.end)),
            _ => tiled_room(&own, above, inside),
        };
        let length = |span: (i64, i64)| span.1.min(wanted.1) - span.0.max(wanted.0);
        if let Some(found) = found.filter(|it| best.is_none_or(|best| length(*it) > length(best))) {
            best = Some(found);
        }
    }
    best
}

/// Returns the whole parent if it has no child yet, otherwise the tail of the child in which `wanted` begins, or its
/// head if both begin together.
fn tiled_room(own: &[Item], above: Item, wanted: (i64, i64)) -> Option<(i64, i64)> {
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
            (
                1,
                None,
                "",
                &[(1, 0, 400_000, None), (2, 500_000, 900_000, None)],
            ),
            (
                2,
                Some(1),
                "Included_In",
                &[
                    (3, 100_000, 200_000, Some(1)),
                    (4, 600_000, 700_000, Some(2)),
                ],
            ),
        ]);
        let one = held(&all, &BTreeSet::from([3]), true);
        assert_eq!(one.len(), 1);
        assert_eq!((one[0].limits.from, one[0].limits.to), (0, 400_000));
        let moved = one[0].dragged(Grip::Whole, 900_000, Mode::Normal);
        assert_eq!((moved[0].start, moved[0].end), (300_000, 400_000));
        let both = held(&all, &BTreeSet::from([1, 3, 4]), true);
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
        let held = held(&all, &BTreeSet::from([3]), true);
        let changed = held[0].dragged(Grip::End, 100_000, Mode::Shift);
        let spans: Vec<_> = changed.iter().map(|it| (it.id, it.start, it.end)).collect();
        assert_eq!(spans, [(3, 0, 300_000), (4, 300_000, 400_000)]);
        assert_eq!(held[0].asked(&changed), [changed[0]]);
        assert!(held[0].dragged(Grip::Start, -9, Mode::Normal).is_empty());
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
                room(&all, &all.tiers[tier], wanted),
                want,
                "{tier} {wanted:?}"
            );
        }
    }
}
