//! What is held when annotations are dragged: those of their tier that count, and what limits them.

use std::collections::{BTreeMap, BTreeSet};

use chereme_corpus::{Contents, Stereotype, TierContents, TierRow};

use super::spans::{self, Grip, Item, Limits, Mode};

/// How long an annotation is at least, where frames do not say: a hundredth of a second.
pub(crate) const LEAST: i64 = 10_000;
/// Where a recording without movement ends: annotations make it longer.
const FAR: i64 = 1 << 50;

/// What times the annotations of a tier have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Their own.
    Root,
    /// Their own, inside those of the annotation above.
    Inside,
    /// They share the time of the annotation above without gaps.
    Tiled,
    /// None of their own.
    Listed,
}

impl Kind {
    pub(crate) fn of(row: &TierRow) -> Self {
        if row.parent_id.is_none() {
            return Self::Root;
        }
        let stereotype = row
            .stereotype
            .as_deref()
            .and_then(Stereotype::from_elan_name);
        match stereotype {
            Some(Stereotype::TimeSubdivision) => Self::Tiled,
            Some(Stereotype::IncludedIn) | None => Self::Inside,
            Some(_) => Self::Listed,
        }
    }
}

/// Annotations of one tier that are held, with those that may be in their way.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Held {
    pub(crate) tier: i64,
    pub(crate) kind: Kind,
    pub(crate) items: Vec<Item>,
    pub(crate) chosen: BTreeSet<i64>,
    pub(crate) limits: Limits,
}

impl Held {
    /// Returns those that change when they are dragged.
    pub(crate) fn dragged(&self, grip: Grip, by: i64, mode: Mode) -> Vec<Item> {
        match self.kind {
            Kind::Listed => Vec::new(),
            Kind::Tiled => spans::tiled(&self.items, &self.chosen, (grip, by), self.limits),
            _ => spans::dragged(&self.items, &self.chosen, (grip, by), mode, self.limits),
        }
    }

    /// Returns what of the changed ones has to be asked for, in an order that never overlaps.
    pub(crate) fn asked(&self, changed: &[Item]) -> Vec<Item> {
        if self.kind == Kind::Tiled {
            // The neighbours' shared boundaries follow by themselves.
            let own = changed.iter().filter(|item| self.chosen.contains(&item.id));
            return own.copied().collect();
        }
        spans::in_order(&self.items, changed)
    }
}

/// Returns the time within which annotations of a recording lie; `frames` tells whether it has movement.
pub(crate) fn limits(contents: &Contents, frames: bool) -> Limits {
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

/// Returns what is held when `chosen` are dragged, tier by tier. Annotations whose parent is held too go
/// along with it and are left out.
pub(crate) fn held(contents: &Contents, chosen: &BTreeSet<i64>, frames: bool) -> Vec<Held> {
    let limits = limits(contents, frames);
    let mut all = Vec::new();
    for tier in &contents.tiers {
        let columns = &tier.annotations;
        let mut families: BTreeMap<Option<i64>, BTreeSet<i64>> = BTreeMap::new();
        let kind = Kind::of(&tier.row);
        for at in places(tier, chosen) {
            let parent = columns.parents.get(at).copied().flatten();
            if parent.is_some_and(|parent| chosen.contains(&parent)) {
                continue;
            }
            let family = parent.filter(|_| kind != Kind::Root);
            families.entry(family).or_default().insert(columns.ids[at]);
        }
        for (parent, chosen) in families {
            let above = parent.and_then(|parent| span_of(contents, parent));
            let limits = match above {
                Some((from, to)) => Limits { from, to, ..limits },
                None => limits,
            };
            all.push(Held {
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

/// Returns annotations with all that hang below them.
pub(crate) fn with_below(contents: &Contents, mut all: BTreeSet<i64>) -> BTreeSet<i64> {
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

/// Returns the places of the annotations of a tier that are in `chosen`.
pub(crate) fn places<'a>(
    tier: &'a TierContents,
    chosen: &'a BTreeSet<i64>,
) -> impl Iterator<Item = usize> + 'a {
    let ids = tier.annotations.ids.iter().enumerate();
    let none = chosen.is_empty();
    ids.filter(move |(_, id)| !none && chosen.contains(id))
        .map(|(at, _)| at)
}

/// Returns the annotations of a tier in time, only those below `parent` where one is given.
pub(crate) fn items(tier: &TierContents, parent: Option<i64>) -> Vec<Item> {
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

/// Returns where a new annotation of a tier can be within `wanted`: what is free of it, and where the tier
/// hangs below another what lies inside one annotation there.
pub(crate) fn room(
    contents: &Contents,
    tier: &TierContents,
    wanted: (i64, i64),
) -> Option<(i64, i64)> {
    let own = items(tier, None);
    let kind = Kind::of(&tier.row);
    let parent = contents
        .tiers
        .iter()
        .find(|it| Some(it.row.id) == tier.row.parent_id);
    let Some(parent) = parent.filter(|_| kind != Kind::Root) else {
        return spans::room(&own, wanted);
    };
    let mut best: Option<(i64, i64)> = None;
    for above in items(parent, None) {
        let inside = (above.start.max(wanted.0), above.end.min(wanted.1));
        if inside.0 >= inside.1 {
            continue;
        }
        let found = match kind {
            Kind::Inside => spans::room(&own, inside),
            Kind::Listed => Some((above.start, above.end)),
            _ => tiled_room(&own, above, inside),
        };
        let length = |span: (i64, i64)| span.1.min(wanted.1) - span.0.max(wanted.0);
        if let Some(found) = found.filter(|it| best.is_none_or(|best| length(*it) > length(best))) {
            best = Some(found);
        }
    }
    best
}

/// Returns the whole parent where it has no child yet, else the tail of the child that `wanted` begins in,
/// or its head where it begins there.
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
pub(super) mod tests {
    use super::*;
    use chereme_corpus::{AnnotationColumns, RecordingRow, ValueState};

    /// `(id, start, end, parent)`.
    type Said = (i64, i64, i64, Option<i64>);

    /// A recording of a second with tiers as `(id, parent, stereotype, annotations)`.
    pub(in crate::panes::timeline) fn contents(
        tiers: &[(i64, Option<i64>, &str, &[Said])],
    ) -> Contents {
        let tiers = tiers
            .iter()
            .map(|(id, parent, stereotype, all)| TierContents {
                row: TierRow {
                    id: *id,
                    parent_id: *parent,
                    stereotype: parent.map(|_| (*stereotype).to_owned()),
                    name: format!("tier {id}"),
                    role: "free".into(),
                    ..TierRow::default()
                },
                annotations: AnnotationColumns {
                    ids: all.iter().map(|it| it.0).collect(),
                    starts: all.iter().map(|it| it.1).collect(),
                    ends: all.iter().map(|it| it.2).collect(),
                    states: vec![ValueState::Value; all.len()],
                    values: all.iter().map(|it| format!("v{}", it.0).into()).collect(),
                    parents: all.iter().map(|it| it.3).collect(),
                    confidences: vec![None; all.len()],
                },
            });
        Contents {
            generation: 1,
            recording: RecordingRow {
                id: 1,
                name: "r".into(),
                signer_id: None,
                signer: None,
                origin: "captured".into(),
                duration_us: 1_000_000,
                licence: None,
                notes: None,
            },
            tiers: tiers.collect(),
            tokens: Vec::new(),
            media: Vec::new(),
        }
    }

    #[test]
    fn children_stay_inside_and_go_along_with_parents_that_are_held_too() {
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
    fn room_for_a_new_one_follows_the_kind_of_tier() {
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
