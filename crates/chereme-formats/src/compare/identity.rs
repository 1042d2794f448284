//! Matches the annotations and tiers of one document with those of another.

use super::{TIME_TOLERANCE_MICROS, compared_annotation_at, is_symbolic, list_annotation_addresses};
use crate::transcript::AnnotationTranscript;
use crate::transcript::{AnnotationAddress, TranscriptAnnotation};
use std::collections::{BTreeMap, HashMap};

/// The annotations and tiers that two documents share.
#[derive(Debug, Default)]
pub(super) struct TranscriptMatching {
    /// For each tier of the first document the tier of the second that it was matched with.
    pub(super) tiers: Vec<Option<usize>>,
    /// Annotations of the first document, each with its counterpart in the second.
    pub(super) pairs: BTreeMap<AnnotationAddress, AnnotationAddress>,
    /// The same pairs in the other direction.
    pub(super) back: BTreeMap<AnnotationAddress, AnnotationAddress>,
}

impl TranscriptMatching {
    fn pair_annotations(&mut self, a: AnnotationAddress, b: AnnotationAddress) {
        if !self.pairs.contains_key(&a) && !self.back.contains_key(&b) {
            self.pairs.insert(a, b);
            self.back.insert(b, a);
        }
    }
}

/// Matches tiers by name, else by their contents; annotations by id if both documents descend from one, else by time
/// and value.
pub(super) fn match_transcripts(a: &AnnotationTranscript, b: &AnnotationTranscript) -> TranscriptMatching {
    let ids: HashMap<&str, AnnotationAddress> = list_annotation_addresses(b)
        .into_iter()
        .map(|place| (compared_annotation_at(b, place).id.as_str(), place))
        .collect();
    let trusted = has_common_descent(a, b, &ids);
    let mut matching = TranscriptMatching {
        tiers: match_transcript_tiers(a, b, if trusted { Some(&ids) } else { None }),
        ..TranscriptMatching::default()
    };
    if trusted {
        by_id(a, b, &ids, &mut matching);
    }
    // Links of chains are matched below matched parents, which therefore come first.
    for at in a.tiers_parents_first() {
        if let Some(other) = matching.tiers[at] {
            if is_symbolic(a, at) {
                by_place(a, b, at, other, &mut matching);
            } else {
                by_time(a, b, at, other, &mut matching);
            }
        }
    }
    matching
}

/// Matches annotations by id. If an annotation moved but an equal one is now at its old time on the same tier, it is
/// matched with that one: two annotations that exchanged their ids have not moved.
fn by_id(
    a: &AnnotationTranscript,
    b: &AnnotationTranscript,
    ids: &HashMap<&str, AnnotationAddress>,
    matching: &mut TranscriptMatching,
) {
    let mut moved = Vec::new();
    for place in list_annotation_addresses(a) {
        let own_annotation = compared_annotation_at(a, place);
        let Some(other) = ids.get(own_annotation.id.as_str()) else {
            continue;
        };
        let same_tier = matching.tiers[place.tier] == Some(other.tier);
        let same_value = own_annotation.value == compared_annotation_at(b, *other).value;
        let near = annotation_overlap_share(own_annotation, compared_annotation_at(b, *other)) > 0.0
            || has_same_times(own_annotation, compared_annotation_at(b, *other));
        let symbolic = is_symbolic(a, place.tier) && is_symbolic(b, other.tier);
        // An id alone proves little: programs number annotations again when they save.
        if (same_tier && (near || symbolic)) || (near && same_value) {
            matching.pair_annotations(place, *other);
        } else if same_tier && same_value {
            moved.push((place, *other));
        }
    }
    if moved.is_empty() {
        return;
    }
    let mut equals: BTreeMap<(usize, &str), Vec<AnnotationAddress>> = BTreeMap::new();
    for place in list_annotation_addresses(b) {
        let key = (place.tier, compared_annotation_at(b, place).value.as_str());
        equals.entry(key).or_default().push(place);
    }
    for all in equals.values_mut() {
        all.sort_by_key(|place| compared_annotation_at(b, *place).span);
    }
    for (place, other) in &moved {
        let own_annotation = compared_annotation_at(a, *place);
        let Some(all) = equals.get(&(other.tier, own_annotation.value.as_str())) else {
            continue;
        };
        // The list is sorted by start, so that only those within the tolerance are looked at.
        let earliest = own_annotation
            .span
            .span_start_instant()
            .instant_micros()
            .saturating_sub(TIME_TOLERANCE_MICROS);
        let first = all.partition_point(|address| {
            compared_annotation_at(b, *address)
                .span
                .span_start_instant()
                .instant_micros()
                < earliest
        });
        let twin = all[first..]
            .iter()
            .take_while(|address| {
                compared_annotation_at(b, **address)
                    .span
                    .span_start_instant()
                    .instant_micros()
                    <= earliest.saturating_add(2 * TIME_TOLERANCE_MICROS)
            })
            .find(|address| {
                has_same_times(own_annotation, compared_annotation_at(b, **address))
                    && !matching.back.contains_key(*address)
            });
        if let Some(twin) = twin {
            matching.pair_annotations(*place, *twin);
        }
    }
    for (place, other) in moved {
        matching.pair_annotations(place, other);
    }
}

/// Returns whether both documents descend from one, so that an id means the same annotation in both: they have the same
/// URN, or nine in ten of the shared ids agree.
fn has_common_descent(
    a: &AnnotationTranscript,
    b: &AnnotationTranscript,
    ids: &HashMap<&str, AnnotationAddress>,
) -> bool {
    let urn = |transcript: &AnnotationTranscript| {
        let urn_property = transcript.properties.iter().find(|(name, _)| name == "URN");
        urn_property
            .map(|(_, value)| value.clone())
            .filter(|value| !value.is_empty())
    };
    if urn(a).is_some() && urn(a) == urn(b) {
        return true;
    }
    let (mut shared, mut agree) = (0usize, 0usize);
    for place in list_annotation_addresses(a) {
        let own_annotation = compared_annotation_at(a, place);
        if let Some(other) = ids.get(own_annotation.id.as_str()) {
            shared += 1;
            let same = a.tiers[place.tier].name == b.tiers[other.tier].name;
            let there = compared_annotation_at(b, *other);
            agree += usize::from(
                same && (annotation_overlap_share(own_annotation, there) > 0.0
                    || has_same_times(own_annotation, there)),
            );
        }
    }
    shared > 0 && 10 * agree >= 9 * shared
}

/// Returns for each tier of `a` the tier of `b` that it was matched with.
pub(super) fn matched_tiers(a: &AnnotationTranscript, b: &AnnotationTranscript) -> Vec<Option<usize>> {
    let ids: HashMap<&str, AnnotationAddress> = list_annotation_addresses(b)
        .into_iter()
        .map(|place| (compared_annotation_at(b, place).id.as_str(), place))
        .collect();
    let trusted = has_common_descent(a, b, &ids);
    match_transcript_tiers(a, b, if trusted { Some(&ids) } else { None })
}

fn match_transcript_tiers(
    a: &AnnotationTranscript,
    b: &AnnotationTranscript,
    ids: Option<&HashMap<&str, AnnotationAddress>>,
) -> Vec<Option<usize>> {
    let by_name: HashMap<&str, usize> = b
        .tiers
        .iter()
        .enumerate()
        .map(|(at, tier)| (tier.name.as_str(), at))
        .collect();
    let mut matched_tiers: Vec<Option<usize>> = a
        .tiers
        .iter()
        .map(|tier| by_name.get(tier.name.as_str()).copied())
        .collect();
    for at in 0..a.tiers.len() {
        if matched_tiers[at].is_some() {
            continue;
        }
        let own_tier = &a.tiers[at];
        let free = (0..b.tiers.len()).filter(|index| !matched_tiers.contains(&Some(*index)));
        let same_kind = |index: &usize| {
            let other = &b.tiers[*index];
            (&own_tier.kind, own_tier.stereotype, &own_tier.participant)
                == (&other.kind, other.stereotype, &other.participant)
        };
        let mut best: Option<(usize, usize)> = None;
        for other in free.filter(same_kind) {
            let shared = own_tier.annotations.iter().filter(|annotation| match ids {
                Some(ids) => ids.get(annotation.id.as_str()).is_some_and(|place| place.tier == other),
                None => {
                    // Without ids every pair is compared; so many annotations are enough to know a tier.
                    let there = &b.tiers[other].annotations;
                    there.iter().take(2000).any(|that| has_same_times(annotation, that))
                }
            });
            let shared = shared.count();
            if 2 * shared > own_tier.annotations.len() && best.is_none_or(|(most, _)| shared > most) {
                best = Some((shared, other));
            }
        }
        matched_tiers[at] = best.map(|(_, other)| other);
    }
    matched_tiers
}

/// Matches the rest of two tiers by the share of time in common, at least half; equal values first.
fn by_time(
    a: &AnnotationTranscript,
    b: &AnnotationTranscript,
    tier: usize,
    other: usize,
    matching: &mut TranscriptMatching,
) {
    let left = |transcript: &AnnotationTranscript,
                tier: usize,
                known: &BTreeMap<AnnotationAddress, AnnotationAddress>|
     -> Vec<AnnotationAddress> {
        (0..transcript.tiers[tier].annotations.len())
            .map(|index| AnnotationAddress { tier, index })
            .filter(|place| !known.contains_key(place))
            .collect()
    };
    let mine = left(a, tier, &matching.pairs);
    let mut theirs = left(b, other, &matching.back);
    theirs.sort_by_key(|place| compared_annotation_at(b, *place).span);
    let longest_span = theirs
        .iter()
        .map(|place| compared_annotation_at(b, *place).span.span_micros())
        .max();
    let longest = longest_span.unwrap_or(0);
    let mut candidates: Vec<(f64, bool, AnnotationAddress, AnnotationAddress)> = Vec::new();
    for place in mine {
        let own_annotation = compared_annotation_at(a, place);
        // An annotation that begins earlier ends before this one, as long as it may be.
        let from = own_annotation
            .span
            .span_start_instant()
            .instant_micros()
            .saturating_sub(longest);
        let first = theirs.partition_point(|address| {
            compared_annotation_at(b, *address)
                .span
                .span_start_instant()
                .instant_micros()
                < from
        });
        for that in &theirs[first..] {
            let there = compared_annotation_at(b, *that);
            if there.span.span_start_instant() > own_annotation.span.span_end_instant() {
                break;
            }
            let share = if has_same_times(own_annotation, there) {
                1.0
            } else {
                annotation_overlap_share(own_annotation, there)
            };
            if share >= 0.5 {
                candidates.push((share, own_annotation.value == there.value, place, *that));
            }
        }
    }
    candidates.sort_by(|x, y| {
        let key =
            |candidate: &(f64, bool, AnnotationAddress, AnnotationAddress)| (candidate.1, candidate.2, candidate.3);
        y.0.total_cmp(&x.0)
            .then_with(|| y.1.cmp(&x.1))
            .then_with(|| key(x).cmp(&key(y)))
    });
    for (_, _, mine, theirs) in candidates {
        matching.pair_annotations(mine, theirs);
    }
}

/// Matches the rest of two symbolic tiers below the same parents: first equal values, then equal positions.
fn by_place(
    a: &AnnotationTranscript,
    b: &AnnotationTranscript,
    tier: usize,
    other: usize,
    matching: &mut TranscriptMatching,
) {
    let mut below: HashMap<AnnotationAddress, Vec<AnnotationAddress>> = HashMap::new();
    for (index, it) in b.tiers[other].annotations.iter().enumerate() {
        let place = AnnotationAddress { tier: other, index };
        if let Some(parent) = it.parent.filter(|_| !matching.back.contains_key(&place)) {
            below.entry(parent).or_default().push(place);
        }
    }
    // A renamed annotation must not take the place of one that kept its value.
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
                let there = compared_annotation_at(b, **that);
                !matching.back.contains_key(*that)
                    && if exact {
                        there.value == it.value
                    } else {
                        there.order == it.order
                    }
            };
            if let Some(that) = siblings.iter().find(fits).copied() {
                matching.pair_annotations(place, that);
            }
        }
    }
}

/// Returns whether two annotations have the same times.
pub(super) fn has_same_times(a: &TranscriptAnnotation, b: &TranscriptAnnotation) -> bool {
    let near = |x: i64, y: i64| x.abs_diff(y) <= TIME_TOLERANCE_MICROS.unsigned_abs();
    near(
        a.span.span_start_instant().instant_micros(),
        b.span.span_start_instant().instant_micros(),
    ) && near(
        a.span.span_end_instant().instant_micros(),
        b.span.span_end_instant().instant_micros(),
    )
}

/// Returns the share of time that two annotations have in common, of all the time that they cover.
fn annotation_overlap_share(a: &TranscriptAnnotation, b: &TranscriptAnnotation) -> f64 {
    let start = a
        .span
        .span_start_instant()
        .max(b.span.span_start_instant())
        .instant_micros();
    let end = a
        .span
        .span_end_instant()
        .min(b.span.span_end_instant())
        .instant_micros();
    let first = a
        .span
        .span_start_instant()
        .min(b.span.span_start_instant())
        .instant_micros();
    let last_end = a
        .span
        .span_end_instant()
        .max(b.span.span_end_instant())
        .instant_micros();
    let whole_length = last_end.saturating_sub(first);
    if end <= start || whole_length <= 0 {
        return 0.0;
    }
    end.saturating_sub(start) as f64 / whole_length as f64
}
