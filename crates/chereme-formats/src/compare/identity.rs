//! Matches the annotations and tiers of one document with those of another.

use super::{TOLERANCE, get, is_symbolic, places};
use crate::eaf::Transcript;
use crate::eaf::convert::{Annotation, AnnotationAddress};
use std::collections::{BTreeMap, HashMap};

/// The annotations and tiers that two documents share.
#[derive(Debug, Default)]
pub(super) struct Matching {
    /// For each tier of the first document the tier of the second that it was matched with.
    pub(super) tiers: Vec<Option<usize>>,
    /// Annotations of the first document, each with its counterpart in the second.
    pub(super) pairs: BTreeMap<AnnotationAddress, AnnotationAddress>,
    /// The same pairs in the other direction.
    pub(super) back: BTreeMap<AnnotationAddress, AnnotationAddress>,
}

impl Matching {
    fn pair(&mut self, a: AnnotationAddress, b: AnnotationAddress) {
        if !self.pairs.contains_key(&a) && !self.back.contains_key(&b) {
            self.pairs.insert(a, b);
            self.back.insert(b, a);
        }
    }
}

/// Matches tiers by name, else by their contents; annotations by id if both documents descend from one, else by time
/// and value.
pub(super) fn matched(a: &Transcript, b: &Transcript) -> Matching {
    let ids: HashMap<&str, AnnotationAddress> = places(b)
        .into_iter()
        .map(|place| (get(b, place).id.as_str(), place))
        .collect();
    let trusted = descend(a, b, &ids);
    let mut matching = Matching {
        tiers: tiers(a, b, if trusted { Some(&ids) } else { None }),
        ..Matching::default()
    };
    if trusted {
        by_id(a, b, &ids, &mut matching);
    }
    for at in parents_first(a) {
        if let Some(other) = matching.tiers[at] {
            if is_symbolic(a, at) {
                by_place(a, b, (at, other), &mut matching);
            } else {
                by_time(a, b, (at, other), &mut matching);
            }
        }
    }
    matching
}

/// Matches annotations by id. If an annotation moved but an equal one is now at its old time on the same tier, it is
/// matched with that one: two annotations that exchanged their ids have not moved.
fn by_id(
    a: &Transcript,
    b: &Transcript,
    ids: &HashMap<&str, AnnotationAddress>,
    matching: &mut Matching,
) {
    let mut moved = Vec::new();
    for place in places(a) {
        let own = get(a, place);
        let Some(other) = ids.get(own.id.as_str()) else {
            continue;
        };
        let same_tier = matching.tiers[place.tier] == Some(other.tier);
        let same_value = own.value == get(b, *other).value;
        let near = overlap(own, get(b, *other)) > 0.0 || alike(own, get(b, *other));
        let symbolic = is_symbolic(a, place.tier) && is_symbolic(b, other.tier);
        if (same_tier && (near || symbolic)) || (near && same_value) {
            matching.pair(place, *other);
        } else if same_tier && same_value {
            moved.push((place, *other));
        }
    }
    if moved.is_empty() {
        return;
    }
    let mut equals: BTreeMap<(usize, &str), Vec<AnnotationAddress>> = BTreeMap::new();
    for place in places(b) {
        let key = (place.tier, get(b, place).value.as_str());
        equals.entry(key).or_default().push(place);
    }
    for all in equals.values_mut() {
        all.sort_by_key(|place| get(b, *place).span);
    }
    for (place, other) in &moved {
        let own = get(a, *place);
        let Some(all) = equals.get(&(other.tier, own.value.as_str())) else {
            continue;
        };
        let earliest = own.span.start().micros().saturating_sub(TOLERANCE);
        let first = all.partition_point(|it| get(b, *it).span.start().micros() < earliest);
        let twin = all[first..]
            .iter()
            .take_while(|it| {
                get(b, **it).span.start().micros() <= earliest.saturating_add(2 * TOLERANCE)
            })
            .find(|it| alike(own, get(b, **it)) && !matching.back.contains_key(*it));
        if let Some(twin) = twin {
            matching.pair(*place, *twin);
        }
    }
    for (place, other) in moved {
        matching.pair(place, other);
    }
}

/// Returns whether both documents descend from one, so that an id means the same annotation in both: they have the same
/// URN, or nine in ten of the shared ids agree.
fn descend(a: &Transcript, b: &Transcript, ids: &HashMap<&str, AnnotationAddress>) -> bool {
    let urn = |it: &Transcript| {
        let found = it.properties.iter().find(|(name, _)| name == "URN");
        found
            .map(|(_, value)| value.clone())
            .filter(|value| !value.is_empty())
    };
    if urn(a).is_some() && urn(a) == urn(b) {
        return true;
    }
    let (mut shared, mut agree) = (0usize, 0usize);
    for place in places(a) {
        let own = get(a, place);
        if let Some(other) = ids.get(own.id.as_str()) {
            shared += 1;
            let same = a.tiers[place.tier].name == b.tiers[other.tier].name;
            let there = get(b, *other);
            agree += usize::from(same && (overlap(own, there) > 0.0 || alike(own, there)));
        }
    }
    shared > 0 && 10 * agree >= 9 * shared
}

/// Returns for each tier of `a` the tier of `b` that it was matched with.
pub(super) fn matched_tiers(a: &Transcript, b: &Transcript) -> Vec<Option<usize>> {
    let ids: HashMap<&str, AnnotationAddress> = places(b)
        .into_iter()
        .map(|place| (get(b, place).id.as_str(), place))
        .collect();
    let trusted = descend(a, b, &ids);
    tiers(a, b, if trusted { Some(&ids) } else { None })
}

fn tiers(
    a: &Transcript,
    b: &Transcript,
    ids: Option<&HashMap<&str, AnnotationAddress>>,
) -> Vec<Option<usize>> {
    let by_name: HashMap<&str, usize> = b
        .tiers
        .iter()
        .enumerate()
        .map(|(at, tier)| (tier.name.as_str(), at))
        .collect();
    let mut found: Vec<Option<usize>> = a
        .tiers
        .iter()
        .map(|tier| by_name.get(tier.name.as_str()).copied())
        .collect();
    for at in 0..a.tiers.len() {
        if found[at].is_some() {
            continue;
        }
        let own = &a.tiers[at];
        let free = (0..b.tiers.len()).filter(|it| !found.contains(&Some(*it)));
        let same_kind = |it: &usize| {
            let other = &b.tiers[*it];
            (&own.kind, own.stereotype, &own.participant)
                == (&other.kind, other.stereotype, &other.participant)
        };
        let mut best: Option<(usize, usize)> = None;
        for other in free.filter(same_kind) {
            let shared = own.annotations.iter().filter(|it| match ids {
                Some(ids) => ids
                    .get(it.id.as_str())
                    .is_some_and(|place| place.tier == other),
                None => {
                    let there = &b.tiers[other].annotations;
                    there.iter().take(2000).any(|that| alike(it, that))
                }
            });
            let shared = shared.count();
            if 2 * shared > own.annotations.len() && best.is_none_or(|(most, _)| shared > most) {
                best = Some((shared, other));
            }
        }
        found[at] = best.map(|(_, other)| other);
    }
    found
}

/// Matches the rest of two tiers by the share of time in common, at least half; equal values first.
fn by_time(a: &Transcript, b: &Transcript, (tier, other): (usize, usize), matching: &mut Matching) {
    let left = |it: &Transcript,
                tier: usize,
                known: &BTreeMap<AnnotationAddress, AnnotationAddress>|
     -> Vec<AnnotationAddress> {
        (0..it.tiers[tier].annotations.len())
            .map(|index| AnnotationAddress { tier, index })
            .filter(|place| !known.contains_key(place))
            .collect()
    };
    let mine = left(a, tier, &matching.pairs);
    let mut theirs = left(b, other, &matching.back);
    theirs.sort_by_key(|place| get(b, *place).span);
    let longest = theirs
        .iter()
        .map(|place| get(b, *place).span.micros())
        .max();
    let longest = longest.unwrap_or(0);
    let mut candidates: Vec<(f64, bool, AnnotationAddress, AnnotationAddress)> = Vec::new();
    for place in mine {
        let own = get(a, place);
        let from = own.span.start().micros().saturating_sub(longest);
        let first = theirs.partition_point(|it| get(b, *it).span.start().micros() < from);
        for that in &theirs[first..] {
            let there = get(b, *that);
            if there.span.start() > own.span.end() {
                break;
            }
            let share = if alike(own, there) {
                1.0
            } else {
                overlap(own, there)
            };
            if share >= 0.5 {
                candidates.push((share, own.value == there.value, place, *that));
            }
        }
    }
    candidates.sort_by(|x, y| {
        let key = |it: &(f64, bool, AnnotationAddress, AnnotationAddress)| (it.1, it.2, it.3);
        y.0.total_cmp(&x.0)
            .then_with(|| y.1.cmp(&x.1))
            .then_with(|| key(x).cmp(&key(y)))
    });
    for (_, _, mine, theirs) in candidates {
        matching.pair(mine, theirs);
    }
}

/// Matches the rest of two symbolic tiers below the same parents: first equal values, then equal positions.
fn by_place(
    a: &Transcript,
    b: &Transcript,
    (tier, other): (usize, usize),
    matching: &mut Matching,
) {
    let mut below: HashMap<AnnotationAddress, Vec<AnnotationAddress>> = HashMap::new();
    for (index, it) in b.tiers[other].annotations.iter().enumerate() {
        let place = AnnotationAddress { tier: other, index };
        if let Some(parent) = it.parent.filter(|_| !matching.back.contains_key(&place)) {
            below.entry(parent).or_default().push(place);
        }
    }
    for exact in [true, false] {
        for (index, it) in a.tiers[tier].annotations.iter().enumerate() {
            let place = AnnotationAddress { tier, index };
            if matching.pairs.contains_key(&place) {
                continue;
            }
            let parent = it.parent.and_then(|place| matching.pairs.get(&place));
            let Some(siblings) = parent.and_then(|parent| below.get(parent)) else {
                continue;
            };
            let fits = |that: &&AnnotationAddress| {
                let there = get(b, **that);
                !matching.back.contains_key(*that)
                    && if exact {
                        there.value == it.value
                    } else {
                        there.order == it.order
                    }
            };
            if let Some(that) = siblings.iter().find(fits).copied() {
                matching.pair(place, that);
            }
        }
    }
}

/// Returns whether two annotations have the same times.
pub(super) fn alike(a: &Annotation, b: &Annotation) -> bool {
    let near = |x: i64, y: i64| x.abs_diff(y) <= TOLERANCE.unsigned_abs();
    near(a.span.start().micros(), b.span.start().micros())
        && near(a.span.end().micros(), b.span.end().micros())
}

/// Returns the share of time that two annotations have in common, of all the time that they cover.
fn overlap(a: &Annotation, b: &Annotation) -> f64 {
    let start = a.span.start().max(b.span.start()).micros();
    let end = a.span.end().min(b.span.end()).micros();
    let first = a.span.start().min(b.span.start()).micros();
    let whole = a.span.end().max(b.span.end()).micros();
    let whole = whole.saturating_sub(first);
    if end <= start || whole <= 0 {
        return 0.0;
    }
    end.saturating_sub(start) as f64 / whole as f64
}

fn parents_first(it: &Transcript) -> Vec<usize> {
    let depth = |tier: usize| {
        std::iter::successors(Some(tier), |at| it.tiers[*at].parent)
            .take(it.tiers.len() + 1)
            .count()
    };
    let mut order: Vec<usize> = (0..it.tiers.len()).collect();
    order.sort_by_key(|tier| (depth(*tier), *tier));
    order
}
