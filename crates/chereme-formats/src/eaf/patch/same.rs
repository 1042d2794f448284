//! Compares what two transcripts mean, whatever their files look like.

use super::{annotation_end_millis, annotations_by_id, is_alignable};
use crate::transcript::{AnnotationTiming, AnnotationTranscript, TranscriptAnnotation, TranscriptTier};
use chereme_sign::TierStereotype;
use std::collections::BTreeMap;

/// Returns whether two transcripts mean the same. The order of annotations on a tier, the date, times that follow from
/// others, and the counter of ids make no difference.
#[must_use]
pub fn same_meaning(a: &AnnotationTranscript, b: &AnnotationTranscript) -> bool {
    a.author == b.author
        && a.media == b.media
        && a.linked_files == b.linked_files
        && sorted_transcript_properties(a) == sorted_transcript_properties(b)
        && vocabularies_by_id(a) == vocabularies_by_id(b)
        && a.tiers.len() == b.tiers.len()
        && same_annotations(a, b)
        && a.tiers.iter().zip(&b.tiers).all(|(x, y)| {
            let bare = |tier: &TranscriptTier| TranscriptTier {
                annotations: Vec::new(),
                ..tier.clone()
            };
            bare(x) == bare(y)
        })
}

fn sorted_transcript_properties(transcript: &AnnotationTranscript) -> Vec<(&str, &str)> {
    let mut all: Vec<(&str, &str)> = transcript
        .properties
        .iter()
        .map(|(name, value)| (name.as_str(), value.as_str()))
        .filter(|(name, _)| *name != "lastUsedAnnotationId")
        .collect();
    all.sort_unstable();
    all
}

fn vocabularies_by_id(
    transcript: &AnnotationTranscript,
) -> BTreeMap<&str, &crate::eaf::eaf_convert::ControlledVocabulary> {
    let all = transcript.vocabularies.iter();
    all.map(|vocabulary| (vocabulary.id.as_str(), vocabulary)).collect()
}

fn same_annotations(a: &AnnotationTranscript, b: &AnnotationTranscript) -> bool {
    let (known, found) = (annotations_by_id(a), annotations_by_id(b));
    known.len() == found.len()
        && known.iter().all(|(id, place)| {
            let Some(other) = found.get(id).filter(|other| other.tier == place.tier) else {
                return false;
            };
            let pair = a.annotation_at(*place).zip(b.annotation_at(*other));
            pair.is_some_and(|(x, y)| is_same_annotation(a, b, place.tier, x, y))
        })
}

fn is_same_annotation(
    a: &AnnotationTranscript,
    b: &AnnotationTranscript,
    tier: usize,
    x: &TranscriptAnnotation,
    y: &TranscriptAnnotation,
) -> bool {
    let above = |transcript: &AnnotationTranscript, it: &TranscriptAnnotation| {
        let place = it.parent?;
        Some(transcript.annotation_at(place)?.id.clone())
    };
    let has_same_time = if is_alignable(a, tier) {
        annotation_end_millis(x) == annotation_end_millis(y)
    } else {
        above(a, x) == above(b, y)
            && (x.order == y.order || a.tiers[tier].stereotype != Some(TierStereotype::SymbolicSubdivision))
    };
    let open = |annotation: &TranscriptAnnotation| matches!(annotation.timing, AnnotationTiming::Proposed { .. });
    has_same_time
        && open(x) == open(y)
        && x.value == y.value
        && x.entry == y.entry
        && x.language == y.language
        && x.external_ref == y.external_ref
}
