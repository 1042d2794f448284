//! A document whose annotations refer to each other by id, so that they can be added and removed one by one.

use super::tier_without_annotations;
use crate::transcript::AnnotationTranscript;
use crate::transcript::{AnnotationAddress, AnnotationTiming, TranscriptAnnotation, TranscriptTier};
use chereme_sign::TierStereotype;
use chereme_sign::tier::subdivision_share;
use std::collections::{BTreeMap, HashMap, HashSet};

/// An annotation by id.
#[derive(Debug, Clone)]
pub(super) struct LooseAnnotation {
    pub(super) it: TranscriptAnnotation,
    pub(super) tier: String,
    /// The id of the annotation above.
    pub(super) above: Option<String>,
    /// Its position among its siblings: they are sorted by rank.
    pub(super) rank: f64,
}

/// A document taken apart: tiers and annotations in separate lists.
pub(super) struct TranscriptPieces {
    pub(super) rest: AnnotationTranscript,
    /// The tiers, without annotations, each with the name of its parent tier.
    pub(super) tiers: Vec<(TranscriptTier, Option<String>)>,
    /// The annotations by id.
    pub(super) all: BTreeMap<String, LooseAnnotation>,
    /// The ids in the order of the document.
    pub(super) order: Vec<String>,
    last: u64,
}

impl TranscriptPieces {
    pub(super) fn pieces_from_transcript(it: &AnnotationTranscript) -> Self {
        let mut pieces = Self {
            rest: AnnotationTranscript {
                tiers: Vec::new(),
                ..it.clone()
            },
            tiers: Vec::new(),
            all: BTreeMap::new(),
            order: Vec::new(),
            last: 0,
        };
        for tier in &it.tiers {
            let above = tier.parent.map(|at| it.tiers[at].name.clone());
            pieces.tiers.push((tier_without_annotations(tier), above));
            for annotation in &tier.annotations {
                let above = annotation.parent.and_then(|place| it.annotation_at(place));
                let loose = LooseAnnotation {
                    it: annotation.clone(),
                    tier: tier.name.clone(),
                    above: above.map(|parent| parent.id.clone()),
                    rank: f64::from(annotation.order),
                };
                pieces.note_id(&annotation.id);
                pieces.order.push(annotation.id.clone());
                pieces.all.insert(annotation.id.clone(), loose);
            }
        }
        pieces
    }

    /// Makes the ids of later additions higher than this one.
    pub(super) fn note_id(&mut self, id: &str) {
        let parsed_number = id.strip_prefix('a').and_then(|digits| digits.parse::<u64>().ok());
        // Enormous numbers leave no room for later ids.
        let number = parsed_number.filter(|value| *value < u64::MAX / 2);
        self.last = self.last.max(number.unwrap_or(0));
    }

    pub(super) fn find_loose_tier(&mut self, name: &str) -> Option<&mut (TranscriptTier, Option<String>)> {
        self.tiers.iter_mut().find(|(tier, _)| tier.name == name)
    }

    /// Adds an annotation, under its own id if that is free, and returns its id.
    pub(super) fn add_loose_annotation(&mut self, mut loose: LooseAnnotation) -> String {
        if self.all.contains_key(&loose.it.id) || loose.it.id.is_empty() {
            self.last += 1;
            loose.it.id = format!("a{}", self.last);
        }
        let id = loose.it.id.clone();
        self.note_id(&id);
        self.order.push(id.clone());
        self.all.insert(id.clone(), loose);
        id
    }

    /// Renames a tier, also where annotations and other tiers refer to it.
    pub(super) fn rename_loose_tier(&mut self, from: &str, to: &str) {
        for (tier, above) in &mut self.tiers {
            if tier.name == from {
                to.clone_into(&mut tier.name);
            }
            if above.as_deref() == Some(from) {
                *above = Some(to.to_owned());
            }
        }
        for loose in self.all.values_mut().filter(|entry| entry.tier == from) {
            to.clone_into(&mut loose.tier);
        }
    }

    /// Returns the document; annotations below symbolic parents get their spans from the parents.
    pub(super) fn reassemble_transcript(mut self) -> AnnotationTranscript {
        let names: HashMap<String, usize> = self
            .tiers
            .iter()
            .enumerate()
            .map(|(at, (tier, _))| (tier.name.clone(), at))
            .collect();
        let mut transcript = self.rest;
        for (mut tier, above) in self.tiers {
            tier.parent = above.and_then(|name| names.get(&name).copied());
            // A stereotype says how a tier hangs on its parent.
            if tier.parent.is_none() {
                tier.stereotype = None;
            }
            transcript.tiers.push(tier);
        }
        let mut places: HashMap<String, AnnotationAddress> = HashMap::new();
        let mut seen = HashSet::new();
        for at in transcript.tiers_parents_first() {
            let name = transcript.tiers[at].name.clone();
            let mut tier_annotations: Vec<LooseAnnotation> = Vec::new();
            for id in &self.order {
                if self.all.get(id).is_some_and(|entry| entry.tier == name) && seen.insert(id.clone()) {
                    tier_annotations.extend(self.all.remove(id));
                }
            }
            fill_transcript_tier(&mut transcript, at, tier_annotations, &mut places);
        }
        let counter = transcript
            .properties
            .iter_mut()
            .find(|(name, _)| name == "lastUsedAnnotationId");
        if let Some((_, value)) = counter {
            let stated_number = value.parse().unwrap_or(0);
            *value = self.last.max(stated_number).to_string();
        }
        transcript
    }
}

fn fill_transcript_tier(
    transcript: &mut AnnotationTranscript,
    at: usize,
    mut own: Vec<LooseAnnotation>,
    places: &mut HashMap<String, AnnotationAddress>,
) {
    let stereotype = transcript.tiers[at].stereotype;
    let symbolic = stereotype.is_some_and(|stereotype| !stereotype.is_alignable());
    if !symbolic {
        own.sort_by_key(|loose| loose.it.span);
    }
    let mut families: BTreeMap<AnnotationAddress, Vec<usize>> = BTreeMap::new();
    let mut kept: Vec<(TranscriptAnnotation, f64)> = Vec::new();
    for loose in own {
        let mut it = loose.it;
        it.parent = loose.above.and_then(|id| places.get(&id).copied());
        if symbolic {
            // A link of a chain without a parent has no time.
            let Some(parent) = it.parent else { continue };
            families.entry(parent).or_default().push(kept.len());
        }
        it.order = 0;
        kept.push((it, loose.rank));
    }
    for (parent, mut family) in families {
        family.sort_by(|x, y| kept[*x].1.total_cmp(&kept[*y].1));
        let Some(span) = transcript.annotation_at(parent).map(|annotation| annotation.span) else {
            continue;
        };
        let many = stereotype == Some(TierStereotype::SymbolicSubdivision);
        let count = family.len();
        for (order, index) in family.into_iter().enumerate() {
            let it = &mut kept[index].0;
            it.millis = None;
            if many {
                it.order = u32::try_from(order).unwrap_or(u32::MAX);
                it.span = subdivision_share(span, order, count);
                it.timing = if count == 1 {
                    AnnotationTiming::Parent
                } else {
                    AnnotationTiming::Share
                };
            } else {
                it.span = span;
                it.timing = AnnotationTiming::Parent;
            }
        }
    }
    for (index, (it, _)) in kept.into_iter().enumerate() {
        places.insert(it.id.clone(), AnnotationAddress { tier: at, index });
        transcript.tiers[at].annotations.push(it);
    }
}
