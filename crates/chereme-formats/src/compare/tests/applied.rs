//! Applies differences to a document, so that tests can see whether they are complete.

use std::collections::BTreeMap;

use crate::compare::apply::{loosen_compared_annotation, order_by_references, revalue_loose_annotation};
use crate::compare::loose::TranscriptPieces;
use crate::compare::{ComparedAnnotation, TranscriptDifference, TranscriptTierChange};
use crate::transcript::AnnotationTranscript;

/// Applies `difference` to `a`. The result has the same meaning as the document that [`diff_transcripts`](crate::compare::diff_transcripts) compared `a`
/// with. An id in use in `a` is not reused: the new annotation gets a fresh id.
pub(super) fn apply_difference(difference: &TranscriptDifference, a: &AnnotationTranscript) -> AnnotationTranscript {
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
        pieces.all.retain(|_, annotation| annotation.tier != change.tier);
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
