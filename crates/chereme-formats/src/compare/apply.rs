//! Applies differences to a document.

use super::loose::{Loose, Pieces};
use super::{Above, ComparedAnnotation, Difference, TierChange};
use crate::eaf::Transcript;
use std::collections::BTreeMap;

/// Applies `difference` to `a`. The result has the same meaning as the document that [`diff`](super::diff) compared `a`
/// with. An id in use in `a` is not reused: the new annotation gets a fresh id.
#[must_use]
pub fn apply(difference: &Difference, a: &Transcript) -> Transcript {
    let mut pieces = Pieces::of(a);
    if let Some(rest) = &difference.rest {
        pieces.rest = (**rest).clone();
    }
    for change in &difference.tiers {
        if let Some(to) = &change.to {
            pieces.rename(&change.tier, to);
        }
    }
    for change in &difference.tiers {
        match change.change {
            "added" => pieces
                .tiers
                .push((change.whole.clone(), change.parent.clone())),
            "changed" => change_tier(&mut pieces, change),
            _ => {}
        }
    }
    for gone in &difference.removed {
        pieces.all.remove(&gone.id);
    }
    for change in difference.tiers.iter().filter(|it| it.change == "removed") {
        pieces.tiers.retain(|(tier, _)| tier.name != change.tier);
        pieces.all.retain(|_, it| it.tier != change.tier);
    }
    let mut fresh = BTreeMap::new();
    for annotation in in_order(difference.added.iter()) {
        let loose = loose(&pieces, annotation, &fresh);
        let id = pieces.add(loose);
        fresh.insert(annotation.id.clone(), id);
    }
    let old: BTreeMap<&str, &str> = difference
        .moved
        .iter()
        .map(|it| (it.annotation.id.as_str(), it.id.as_str()))
        .collect();
    for moved in in_order(difference.moved.iter().map(|it| &it.annotation)) {
        if let Some(id) = old.get(moved.id.as_str()) {
            place(&mut pieces, id, moved, &fresh);
        }
    }
    for change in &difference.revalued {
        if let Some(own) = pieces.all.get_mut(&change.id) {
            revalue(own, &change.annotation);
        }
    }
    pieces.whole()
}

/// Gives a tier its properties in the other document, except for the name.
fn change_tier(pieces: &mut Pieces, change: &TierChange) {
    let name = change.whole.name.clone();
    if let Some((tier, above)) = pieces.tier(&name) {
        *tier = change.whole.clone();
        if change.fields.contains_key("parent") {
            above.clone_from(&change.parent);
        }
    }
}

/// Returns annotations in an order in which each comes after those that it refers to.
pub(super) fn in_order<'s>(
    all: impl Iterator<Item = &'s ComparedAnnotation>,
) -> Vec<&'s ComparedAnnotation> {
    let mut all: Vec<&ComparedAnnotation> = all.collect();
    let ids: BTreeMap<&str, &ComparedAnnotation> =
        all.iter().map(|it| (it.id.as_str(), *it)).collect();
    let depth = |annotation: &ComparedAnnotation| {
        let above = |it: &&ComparedAnnotation| match &it.above {
            Some(Above::New(id)) => ids.get(id.as_str()).copied(),
            _ => None,
        };
        std::iter::successors(ids.get(annotation.id.as_str()).copied(), above)
            .take(64)
            .count()
    };
    all.sort_by_cached_key(|it| (depth(it), it.whole.order));
    all
}

/// Gives an annotation its text in the other document.
pub(super) fn revalue(own: &mut Loose, annotation: &ComparedAnnotation) {
    own.it.value.clone_from(&annotation.whole.value);
    own.it.entry.clone_from(&annotation.whole.entry);
    own.it.language.clone_from(&annotation.whole.language);
    own.it
        .external_ref
        .clone_from(&annotation.whole.external_ref);
}

/// Moves an annotation to its time, tier and parent in the other document.
fn place(
    pieces: &mut Pieces,
    id: &str,
    annotation: &ComparedAnnotation,
    fresh: &BTreeMap<String, String>,
) {
    let new = loose(pieces, annotation, fresh);
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
pub(super) fn loose(
    pieces: &Pieces,
    annotation: &ComparedAnnotation,
    fresh: &BTreeMap<String, String>,
) -> Loose {
    let name = |it: &Above| match it {
        Above::Known(id) => id.clone(),
        Above::New(id) => fresh.get(id).unwrap_or(id).clone(),
    };
    let above = annotation.above.as_ref().map(name);
    let before = annotation.before.as_ref().map(name);
    // Annotations with times of their own have no rank among siblings.
    let chained = above.is_some() && annotation.whole.millis.is_none();
    Loose {
        rank: if chained {
            rank(
                pieces,
                &annotation.tier,
                above.as_deref(),
                before.as_deref(),
            )
        } else {
            0.0
        },
        it: annotation.whole.clone(),
        tier: annotation.tier.clone(),
        above,
    }
}

/// Returns a rank directly after the sibling `before`, or before all siblings if there is no such sibling.
fn rank(pieces: &Pieces, tier: &str, above: Option<&str>, before: Option<&str>) -> f64 {
    let siblings = pieces.all.values();
    let siblings = siblings.filter(|it| it.tier == tier && it.above.as_deref() == above);
    let ranks: Vec<f64> = siblings.map(|it| it.rank).collect();
    let Some(own) = before.and_then(|id| pieces.all.get(id)).map(|it| it.rank) else {
        return ranks.iter().copied().fold(1.0, f64::min) - 1.0;
    };
    let next = ranks.into_iter().filter(|it| *it > own);
    let next = next.fold(f64::INFINITY, f64::min);
    if next.is_finite() {
        f64::midpoint(own, next)
    } else {
        own + 1.0
    }
}
