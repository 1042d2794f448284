//! Compares what two transcripts mean, whatever their files look like.

use super::{ends, ids, is_alignable};
use crate::eaf::model::{Annotation, Tier, Timing, Transcript};
use chereme_sign::Stereotype;
use std::collections::BTreeMap;

/// Returns whether two transcripts mean the same. The order of annotations on a tier, the date, times that follow from
/// others, and the counter of ids make no difference.
#[must_use]
pub fn same_meaning(a: &Transcript, b: &Transcript) -> bool {
    a.author == b.author
        && a.media == b.media
        && a.linked_files == b.linked_files
        && properties(a) == properties(b)
        && vocabularies(a) == vocabularies(b)
        && a.tiers.len() == b.tiers.len()
        && same_annotations(a, b)
        && a.tiers.iter().zip(&b.tiers).all(|(x, y)| {
            let bare = |tier: &Tier| Tier {
                annotations: Vec::new(),
                ..tier.clone()
            };
            bare(x) == bare(y)
        })
}

fn properties(transcript: &Transcript) -> Vec<(&str, &str)> {
    let mut all: Vec<(&str, &str)> = transcript
        .properties
        .iter()
        .map(|(name, value)| (name.as_str(), value.as_str()))
        .filter(|(name, _)| *name != "lastUsedAnnotationId")
        .collect();
    all.sort_unstable();
    all
}

fn vocabularies(transcript: &Transcript) -> BTreeMap<&str, &crate::eaf::convert::Vocabulary> {
    let all = transcript.vocabularies.iter();
    all.map(|it| (it.id.as_str(), it)).collect()
}

fn same_annotations(a: &Transcript, b: &Transcript) -> bool {
    let (known, found) = (ids(a), ids(b));
    known.len() == found.len()
        && known.iter().all(|(id, place)| {
            let Some(other) = found.get(id).filter(|other| other.tier == place.tier) else {
                return false;
            };
            let pair = a.annotation(*place).zip(b.annotation(*other));
            pair.is_some_and(|(x, y)| same(a, b, place.tier, (x, y)))
        })
}

fn same(a: &Transcript, b: &Transcript, tier: usize, (x, y): (&Annotation, &Annotation)) -> bool {
    let above = |transcript: &Transcript, it: &Annotation| {
        let place = it.parent?;
        Some(transcript.annotation(place)?.id.clone())
    };
    let held = if is_alignable(a, tier) {
        ends(x) == ends(y)
    } else {
        above(a, x) == above(b, y)
            && (x.order == y.order
                || a.tiers[tier].stereotype != Some(Stereotype::SymbolicSubdivision))
    };
    let open = |it: &Annotation| matches!(it.timing, Timing::Proposed { .. });
    held && open(x) == open(y)
        && x.value == y.value
        && x.entry == y.entry
        && x.language == y.language
        && x.external_ref == y.external_ref
}
