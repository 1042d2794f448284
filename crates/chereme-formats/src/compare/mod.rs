//! Annotation documents side by side: their [differences](diff_transcripts) by meaning, and a [merge_transcripts] of two that diverged.
//!
//! Annotations are the same by their ids if both documents descend from one, else by tier and time. Time slots,
//! the order of elements and the spelling of a file make no difference.

mod apply;
mod compare_merge;
mod identity;
mod loose;
#[cfg(test)]
mod tests;

pub use compare_merge::{MergeConflict, MergedTranscript, merge_transcripts, merge_two, with_candidates};

use crate::transcript::AnnotationTranscript;
use crate::transcript::{AnnotationAddress, TranscriptAnnotation, TranscriptTier};
use chereme_sign::TierStereotype;
use identity::{TranscriptMatching, match_transcripts, matched_tiers};
use serde::Serialize;
use std::collections::BTreeMap;

/// The greatest difference, in microseconds, of times that count as equal: less than the millisecond to which files round.
pub const TIME_TOLERANCE_MICROS: i64 = 999;

/// The differences of two documents, from the first to the second.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TranscriptDifference {
    /// Annotations of the second alone.
    pub added: Vec<ComparedAnnotation>,
    /// Annotations of the first alone.
    pub removed: Vec<ComparedAnnotation>,
    /// Annotations at another time, on another tier, or at another place among their siblings.
    pub moved: Vec<MovedAnnotation>,
    /// Annotations whose text or vocabulary entry changed.
    pub revalued: Vec<RevaluedAnnotation>,
    /// Tiers that were added, removed, renamed or changed.
    pub tiers: Vec<TranscriptTierChange>,
    /// Changes of media, properties and vocabularies, as sentences.
    pub document: Vec<String>,
    /// Everything of the second document except its tiers, if it differs.
    #[serde(skip)]
    pub(crate) rest: Option<Box<AnnotationTranscript>>,
}

/// An annotation in one of the documents.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ComparedAnnotation {
    /// The name of its tier.
    pub tier: String,
    /// Its id in the document.
    pub id: String,
    /// Its start in microseconds.
    pub start_us: i64,
    /// Its end in microseconds: the first microsecond after it.
    pub end_us: i64,
    /// Its text.
    pub value: String,
    #[serde(skip)]
    pub(crate) whole: TranscriptAnnotation,
    /// The annotation above.
    #[serde(skip)]
    pub(crate) above: Option<ReferredAnnotation>,
    /// The sibling before it.
    #[serde(skip)]
    pub(crate) before: Option<ReferredAnnotation>,
}

/// An annotation that another refers to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum ReferredAnnotation {
    /// An annotation of the first document, by its id there.
    Known(String),
    /// An annotation of the second document alone, by its id there.
    New(String),
}

/// An annotation whose time or place changed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct MovedAnnotation {
    /// Its tier in the first document.
    pub tier: String,
    /// Its id in the first document.
    pub id: String,
    /// Its text in the first document.
    pub value: String,
    /// Its times in the first document, in microseconds.
    pub from: [i64; 2],
    /// Its times in the second document.
    pub to: [i64; 2],
    /// Its tier in the second document, if it changed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to_tier: Option<String>,
    #[serde(skip)]
    pub(crate) annotation: ComparedAnnotation,
}

/// An annotation whose text changed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct RevaluedAnnotation {
    /// Its tier in the first document.
    pub tier: String,
    /// Its id in the first document.
    pub id: String,
    /// Its start in the first document, in microseconds.
    pub start_us: i64,
    /// Its end in the first document: the first microsecond after it.
    pub end_us: i64,
    /// Its text in the first document.
    pub from: String,
    /// Its text in the second document.
    pub to: String,
    /// The vocabulary entries in both, if the link to the vocabulary changed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub entry: Option<[Option<String>; 2]>,
    #[serde(skip)]
    pub(crate) annotation: ComparedAnnotation,
}

/// A change of a tier.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TranscriptTierChange {
    /// `added`, `removed`, `renamed` or `changed`.
    pub change: &'static str,
    /// Its name in the first document, or in the second if it was added.
    pub tier: String,
    /// Its new name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// Properties before and after, such as `participant`.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub fields: BTreeMap<&'static str, [String; 2]>,
    #[serde(skip)]
    pub(crate) whole: TranscriptTier,
    #[serde(skip)]
    pub(crate) parent: Option<String>,
}

impl TranscriptDifference {
    /// Returns whether both documents mean the same.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.added.is_empty()
            && self.removed.is_empty()
            && self.moved.is_empty()
            && self.revalued.is_empty()
            && self.tiers.is_empty()
            && self.document.is_empty()
    }
}

/// Returns the differences from `a` to `b`.
#[must_use]
pub fn diff_transcripts(a: &AnnotationTranscript, b: &AnnotationTranscript) -> TranscriptDifference {
    let matching = match_transcripts(a, b);
    let mut difference = TranscriptDifference {
        document: compare_document_parts(a, b),
        ..TranscriptDifference::default()
    };
    difference.rest = (!difference.document.is_empty()).then(|| {
        Box::new(AnnotationTranscript {
            tiers: Vec::new(),
            ..b.clone()
        })
    });
    compare_transcript_tiers(a, b, &matching, &mut difference);
    for place in list_annotation_addresses(a) {
        let Some(other) = matching.pairs.get(&place) else {
            difference.removed.push(to_compared_annotation(a, None, place));
            continue;
        };
        compare_annotation_pair(a, place, b, *other, &matching, &mut difference);
    }
    for place in list_annotation_addresses(b) {
        if !matching.back.contains_key(&place) {
            let added_annotation = to_compared_annotation(b, Some((a, &matching)), place);
            difference.added.push(added_annotation);
        }
    }
    difference
}

/// Returns the tiers of `a` that have another name in `b`, each with its new name.
#[must_use]
pub fn renamed_tiers(a: &AnnotationTranscript, b: &AnnotationTranscript) -> Vec<(String, String)> {
    let pairs = a.tiers.iter().zip(matched_tiers(a, b));
    pairs
        .filter_map(|(tier, other)| Some((tier, &b.tiers[other?])))
        .filter(|(tier, other)| tier.name != other.name)
        .map(|(tier, other)| (tier.name.clone(), other.name.clone()))
        .collect()
}

fn compare_annotation_pair(
    a: &AnnotationTranscript,
    old: AnnotationAddress,
    b: &AnnotationTranscript,
    new: AnnotationAddress,
    matching: &TranscriptMatching,
    difference: &mut TranscriptDifference,
) {
    let (x, y) = (compared_annotation_at(a, old), compared_annotation_at(b, new));
    let now = to_compared_annotation(b, Some((a, matching)), new);
    let before = to_compared_annotation(a, None, old);
    let symbolic = is_symbolic(b, new.tier);
    let parent = |annotation: &TranscriptAnnotation| annotation.parent;
    // Times of symbolic annotations follow from their parents, so that only a parent or neighbour moves them.
    let elsewhere = matching.tiers[old.tier] != Some(new.tier);
    let moved = if symbolic {
        let above = parent(x).and_then(|place| matching.pairs.get(&place));
        above.copied() != parent(y) || !same_neighbour(a, old, b, new, matching)
    } else {
        let far = |p: i64, q: i64| p.abs_diff(q) > TIME_TOLERANCE_MICROS.unsigned_abs();
        far(before.start_us, now.start_us) || far(before.end_us, now.end_us)
    };
    if moved || elsewhere {
        difference.moved.push(MovedAnnotation {
            tier: before.tier.clone(),
            id: before.id.clone(),
            value: before.value.clone(),
            from: [before.start_us, before.end_us],
            to: [now.start_us, now.end_us],
            to_tier: elsewhere.then(|| now.tier.clone()),
            annotation: now.clone(),
        });
    }
    if x.value != y.value || x.entry != y.entry {
        difference.revalued.push(RevaluedAnnotation {
            tier: before.tier,
            id: before.id,
            start_us: before.start_us,
            end_us: before.end_us,
            from: x.value.clone(),
            to: y.value.clone(),
            entry: (x.entry != y.entry).then(|| [x.entry.clone(), y.entry.clone()]),
            annotation: now,
        });
    }
}

/// Returns whether an annotation still follows the same sibling as before; siblings of one document alone do not count.
fn same_neighbour(
    a: &AnnotationTranscript,
    old: AnnotationAddress,
    b: &AnnotationTranscript,
    new: AnnotationAddress,
    matching: &TranscriptMatching,
) -> bool {
    let chain =
        |transcript: &AnnotationTranscript, own: AnnotationAddress, known: &dyn Fn(AnnotationAddress) -> bool| {
            let annotation = compared_annotation_at(transcript, own);
            let siblings = transcript.tiers[own.tier].annotations.iter().enumerate();
            siblings
                .filter(|(index, sibling)| {
                    let place = AnnotationAddress {
                        tier: own.tier,
                        index: *index,
                    };
                    sibling.parent == annotation.parent && sibling.order < annotation.order && known(place)
                })
                .max_by_key(|(_, sibling)| sibling.order)
                .map(|(index, _)| AnnotationAddress { tier: own.tier, index })
        };
    let before = chain(a, old, &|place| matching.pairs.contains_key(&place));
    let after = chain(b, new, &|place| matching.back.contains_key(&place));
    before.and_then(|place| matching.pairs.get(&place)).copied() == after
}

fn compare_transcript_tiers(
    a: &AnnotationTranscript,
    b: &AnnotationTranscript,
    matching: &TranscriptMatching,
    difference: &mut TranscriptDifference,
) {
    let name =
        |transcript: &AnnotationTranscript, tier: Option<usize>| tier.map(|at| transcript.tiers[at].name.clone());
    for (at, tier) in a.tiers.iter().enumerate() {
        let change = |change, other: &TranscriptTier| TranscriptTierChange {
            change,
            tier: tier.name.clone(),
            to: None,
            fields: BTreeMap::new(),
            whole: tier_without_annotations(other),
            parent: None,
        };
        let Some(new) = matching.tiers[at] else {
            difference.tiers.push(change("removed", tier));
            continue;
        };
        let other = &b.tiers[new];
        let parent = name(b, other.parent);
        if tier.name != other.name {
            difference.tiers.push(TranscriptTierChange {
                to: Some(other.name.clone()),
                parent: parent.clone(),
                ..change("renamed", other)
            });
        }
        let same_parent = tier.parent.and_then(|parent| matching.tiers[parent]) == other.parent;
        let mut fields = changed_tier_fields(tier, other);
        if !same_parent {
            let both = [name(a, tier.parent), name(b, other.parent)];
            fields.insert("parent", both.map(Option::unwrap_or_default));
        }
        if !fields.is_empty() {
            difference.tiers.push(TranscriptTierChange {
                fields,
                parent,
                ..change("changed", other)
            });
        }
    }
    for (at, tier) in b.tiers.iter().enumerate() {
        if !matching.tiers.contains(&Some(at)) {
            difference.tiers.push(TranscriptTierChange {
                change: "added",
                tier: tier.name.clone(),
                to: None,
                fields: BTreeMap::new(),
                whole: tier_without_annotations(tier),
                parent: name(b, tier.parent),
            });
        }
    }
}

/// Returns the properties that differ between two tiers, except for names and parents.
fn changed_tier_fields(a: &TranscriptTier, b: &TranscriptTier) -> BTreeMap<&'static str, [String; 2]> {
    let stereotype = |tier: &TranscriptTier| tier.stereotype.map(TierStereotype::elan_name).map(str::to_owned);
    let all = [
        ("type", Some(a.kind.clone()), Some(b.kind.clone())),
        ("stereotype", stereotype(a), stereotype(b)),
        ("participant", a.participant.clone(), b.participant.clone()),
        ("annotator", a.annotator.clone(), b.annotator.clone()),
        ("language", a.language.clone(), b.language.clone()),
        ("locale", a.locale.clone(), b.locale.clone()),
        ("vocabulary", a.vocabulary.clone(), b.vocabulary.clone()),
    ];
    all.into_iter()
        .filter(|(_, x, y)| x != y)
        .map(|(name, x, y)| (name, [x, y].map(Option::unwrap_or_default)))
        .collect()
}

fn compare_document_parts(a: &AnnotationTranscript, b: &AnnotationTranscript) -> Vec<String> {
    let mut all = Vec::new();
    let properties = |transcript: &AnnotationTranscript| -> BTreeMap<String, String> {
        // The counter of ids is no content.
        let own_properties = transcript.properties.iter().cloned();
        own_properties
            .filter(|(name, _)| name != "lastUsedAnnotationId")
            .collect()
    };
    describe_part_changes("property", &properties(a), &properties(b), &mut all);
    let media = |transcript: &AnnotationTranscript| -> BTreeMap<String, String> {
        let media_files = transcript.media.iter().chain(&transcript.linked_files);
        media_files
            .map(|file| (file.url.clone(), format!("{file:?}")))
            .collect()
    };
    describe_part_changes("media file", &media(a), &media(b), &mut all);
    let vocabularies = |transcript: &AnnotationTranscript| -> BTreeMap<String, String> {
        let own_vocabularies = transcript.vocabularies.iter();
        own_vocabularies
            .map(|vocabulary| (vocabulary.id.clone(), format!("{vocabulary:?}")))
            .collect()
    };
    describe_part_changes("vocabulary", &vocabularies(a), &vocabularies(b), &mut all);
    all
}

fn describe_part_changes(
    what: &str,
    a: &BTreeMap<String, String>,
    b: &BTreeMap<String, String>,
    into: &mut Vec<String>,
) {
    for (name, text) in a {
        match b.get(name) {
            None => into.push(format!("the {what} {name:?} was removed")),
            Some(other) if other != text => into.push(format!("the {what} {name:?} changed")),
            Some(_) => {}
        }
    }
    let new = b.keys().filter(|name| !a.contains_key(*name));
    into.extend(new.map(|name| format!("the {what} {name:?} was added")));
}

/// Returns an annotation as a [`ComparedAnnotation`]; its references name annotations of the first document if that is given.
fn to_compared_annotation(
    it: &AnnotationTranscript,
    of: Option<(&AnnotationTranscript, &TranscriptMatching)>,
    place: AnnotationAddress,
) -> ComparedAnnotation {
    let compared_annotation = compared_annotation_at(it, place);
    let refer = |other: AnnotationAddress| match of {
        None => ReferredAnnotation::Known(compared_annotation_at(it, other).id.clone()),
        Some((a, matching)) => match matching.back.get(&other) {
            Some(known) => ReferredAnnotation::Known(compared_annotation_at(a, *known).id.clone()),
            None => ReferredAnnotation::New(compared_annotation_at(it, other).id.clone()),
        },
    };
    // Only links of a chain have an order; a search for the neighbours of all others would take long.
    let siblings = it.tiers[place.tier].annotations.iter().enumerate();
    let before = (compared_annotation.order > 0).then(|| {
        let mut siblings = siblings.filter(|(_, sibling)| {
            sibling.parent == compared_annotation.parent && sibling.order + 1 == compared_annotation.order
        });
        siblings.next().map(|(index, _)| AnnotationAddress {
            tier: place.tier,
            index,
        })
    });
    let before = before.flatten();
    ComparedAnnotation {
        tier: it.tiers[place.tier].name.clone(),
        id: compared_annotation.id.clone(),
        start_us: compared_annotation.span.span_start_instant().instant_micros(),
        end_us: compared_annotation.span.span_end_instant().instant_micros(),
        value: compared_annotation.value.clone(),
        above: compared_annotation.parent.map(refer),
        before: before.map(refer),
        whole: compared_annotation.clone(),
    }
}

fn tier_without_annotations(tier: &TranscriptTier) -> TranscriptTier {
    TranscriptTier {
        annotations: Vec::new(),
        parent: None,
        ..tier.clone()
    }
}

fn list_annotation_addresses(it: &AnnotationTranscript) -> Vec<AnnotationAddress> {
    let all = it.tiers.iter().enumerate();
    all.flat_map(|(tier, own)| (0..own.annotations.len()).map(move |index| AnnotationAddress { tier, index }))
        .collect()
}

fn compared_annotation_at(it: &AnnotationTranscript, place: AnnotationAddress) -> &TranscriptAnnotation {
    &it.tiers[place.tier].annotations[place.index]
}

fn is_symbolic(it: &AnnotationTranscript, tier: usize) -> bool {
    let stereotype = it.tiers[tier].stereotype;
    stereotype.is_some_and(|stereotype| !stereotype.is_alignable())
}
