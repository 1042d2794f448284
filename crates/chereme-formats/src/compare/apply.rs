//! Gives annotations of one document their places, references and values in the other.

use super::loose::{LooseAnnotation, TranscriptPieces};
use super::{ComparedAnnotation, ReferredAnnotation};
use std::collections::BTreeMap;

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
