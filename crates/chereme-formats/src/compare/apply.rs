//! Applies differences to a document.

use super::loose::{LooseAnnotation, TranscriptPieces};
use super::{ComparedAnnotation, ReferredAnnotation, TranscriptDifference, TranscriptTierChange};
use crate::transcript::AnnotationTranscript;
use std::collections::BTreeMap;

/// Applies `difference` to `a`. The result has the same meaning as the document that [`diff_transcripts`](super::diff_transcripts) compared `a`
/// with. An id in use in `a` is not reused: the new annotation gets a fresh id.
#[must_use]
pub fn apply_difference(difference: &TranscriptDifference, a: &AnnotationTranscript) -> AnnotationTranscript {
    let mut pieces = TranscriptPieces::pieces_from_transcript(a);
    if let Some(rest) = &difference.rest {
        pieces.rest = (**rest).clone();
    }
    // Names come first, because all other changes name tiers as the second document does.
    for change in &difference.tiers {
        if let Some(to) = &change.to {
            pieces.rename_loose_tier(&change.tier, to);
        }
    }
    for change in &difference.tiers {
        match change.change {
            "added" => pieces.tiers.push((change.whole.clone(), change.parent.clone())),
            "changed" => apply_tier_change(&mut pieces, change),
            _ => {}
        }
    }
    for gone in &difference.removed {
        pieces.all.remove(&gone.id);
    }
    for change in difference
        .tiers
        .iter()
        .filter(|tier_change| tier_change.change == "removed")
    {
        pieces.tiers.retain(|(tier, _)| tier.name != change.tier);
        pieces.all.retain(|_, it| it.tier != change.tier);
    }
    let mut fresh = BTreeMap::new();
    for annotation in order_by_references(difference.added.iter()) {
        let loose = loosen_compared_annotation(&pieces, annotation, &fresh);
        let id = pieces.add_loose_annotation(loose);
        fresh.insert(annotation.id.clone(), id);
    }
    let old: BTreeMap<&str, &str> = difference
        .moved
        .iter()
        .map(|moved| (moved.annotation.id.as_str(), moved.id.as_str()))
        .collect();
    // A moved annotation may stand below an added one.
    for moved in order_by_references(difference.moved.iter().map(|entry| &entry.annotation)) {
        if let Some(id) = old.get(moved.id.as_str()) {
            place_loose_annotation(&mut pieces, id, moved, &fresh);
        }
    }
    for change in &difference.revalued {
        if let Some(own) = pieces.all.get_mut(&change.id) {
            revalue_loose_annotation(own, &change.annotation);
        }
    }
    pieces.reassemble_transcript()
}

/// Gives a tier its properties in the other document, except for the name.
fn apply_tier_change(pieces: &mut TranscriptPieces, change: &TranscriptTierChange) {
    let name = change.whole.name.clone();
    if let Some((tier, above)) = pieces.find_loose_tier(&name) {
        *tier = change.whole.clone();
        if change.fields.contains_key("parent") {
            above.clone_from(&change.parent);
        }
    }
}

/// Returns annotations in an order in which each comes after those that it refers to.
pub(super) fn order_by_references<'s>(
    all: impl Iterator<Item = &'s ComparedAnnotation>,
) -> Vec<&'s ComparedAnnotation> {
    let mut all: Vec<&ComparedAnnotation> = all.collect();
    let ids: BTreeMap<&str, &ComparedAnnotation> = all
        .iter()
        .map(|annotation| (annotation.id.as_str(), *annotation))
        .collect();
    let depth = |annotation: &ComparedAnnotation| {
        let above = |compared: &&ComparedAnnotation| match &compared.above {
            Some(ReferredAnnotation::New(id)) => ids.get(id.as_str()).copied(),
            _ => None,
        };
        // References in a circle must not be followed for ever.
        std::iter::successors(ids.get(annotation.id.as_str()).copied(), above)
            .take(64)
            .count()
    };
    all.sort_by_cached_key(|annotation| (depth(annotation), annotation.whole.order));
    all
}

/// Gives an annotation its text in the other document.
pub(super) fn revalue_loose_annotation(own: &mut LooseAnnotation, annotation: &ComparedAnnotation) {
    own.it.value.clone_from(&annotation.whole.value);
    own.it.entry.clone_from(&annotation.whole.entry);
    own.it.language.clone_from(&annotation.whole.language);
    own.it.external_ref.clone_from(&annotation.whole.external_ref);
}

/// Moves an annotation to its time, tier and parent in the other document.
fn place_loose_annotation(
    pieces: &mut TranscriptPieces,
    id: &str,
    annotation: &ComparedAnnotation,
    fresh: &BTreeMap<String, String>,
) {
    let new = loosen_compared_annotation(pieces, annotation, fresh);
    if let Some(own) = pieces.all.get_mut(id) {
        own.it.span = new.it.span;
        own.it.millis = new.it.millis;
        own.it.timing = new.it.timing;
        own.tier = new.tier;
        own.above = new.above;
        own.rank = new.rank;
    }
}

/// Returns an annotation of the other document; its references name annotations of this document.
pub(super) fn loosen_compared_annotation(
    pieces: &TranscriptPieces,
    annotation: &ComparedAnnotation,
    fresh: &BTreeMap<String, String>,
) -> LooseAnnotation {
    let name = |above: &ReferredAnnotation| match above {
        ReferredAnnotation::Known(id) => id.clone(),
        ReferredAnnotation::New(id) => fresh.get(id).unwrap_or(id).clone(),
    };
    let above = annotation.above.as_ref().map(name);
    let before = annotation.before.as_ref().map(name);
    // Annotations with times of their own have no rank among siblings.
    let chained = above.is_some() && annotation.whole.millis.is_none();
    LooseAnnotation {
        rank: if chained {
            sibling_rank_after(pieces, &annotation.tier, above.as_deref(), before.as_deref())
        } else {
            0.0
        },
        it: annotation.whole.clone(),
        tier: annotation.tier.clone(),
        above,
    }
}

/// Returns a rank directly after the sibling `before`, or before all siblings if there is no such sibling.
fn sibling_rank_after(pieces: &TranscriptPieces, tier: &str, above: Option<&str>, before: Option<&str>) -> f64 {
    let all_loose = pieces.all.values();
    let siblings = all_loose.filter(|sibling| sibling.tier == tier && sibling.above.as_deref() == above);
    let ranks: Vec<f64> = siblings.map(|sibling| sibling.rank).collect();
    let Some(own) = before.and_then(|id| pieces.all.get(id)).map(|sibling| sibling.rank) else {
        return ranks.iter().copied().fold(1.0, f64::min) - 1.0;
    };
    let later_ranks = ranks.into_iter().filter(|other_rank| *other_rank > own);
    let next = later_ranks.fold(f64::INFINITY, f64::min);
    if next.is_finite() {
        f64::midpoint(own, next)
    } else {
        own + 1.0
    }
}
