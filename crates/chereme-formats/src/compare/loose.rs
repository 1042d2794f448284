//! A document whose annotations refer to each other by id, so that they can be added and removed one by one.

use super::bare;
use crate::eaf::Transcript;
use crate::eaf::convert::{Annotation, AnnotationAddress, Tier, Timing};
use chereme_motion::Span;
use chereme_sign::Stereotype;
use std::collections::{BTreeMap, HashMap, HashSet};

/// An annotation by id.
#[derive(Debug, Clone)]
pub(super) struct Loose {
    pub(super) it: Annotation,
    pub(super) tier: String,
    /// The id of the annotation above.
    pub(super) above: Option<String>,
    /// Its position among its siblings: they are sorted by rank.
    pub(super) rank: f64,
}

/// A document taken apart: tiers and annotations in separate lists.
pub(super) struct Pieces {
    pub(super) rest: Transcript,
    /// The tiers, without annotations, each with the name of its parent tier.
    pub(super) tiers: Vec<(Tier, Option<String>)>,
    /// The annotations by id.
    pub(super) all: BTreeMap<String, Loose>,
    /// The ids in the order of the document.
    pub(super) order: Vec<String>,
    last: u64,
}

impl Pieces {
    pub(super) fn of(it: &Transcript) -> Self {
        let mut pieces = Self {
            rest: Transcript {
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
            pieces.tiers.push((bare(tier), above));
            for annotation in &tier.annotations {
                let above = annotation.parent.and_then(|place| it.annotation(place));
                let loose = Loose {
                    it: annotation.clone(),
                    tier: tier.name.clone(),
                    above: above.map(|it| it.id.clone()),
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
        let number = id.strip_prefix('a').and_then(|it| it.parse::<u64>().ok());
        let number = number.filter(|it| *it < u64::MAX / 2);
        self.last = self.last.max(number.unwrap_or(0));
    }

    pub(super) fn tier(&mut self, name: &str) -> Option<&mut (Tier, Option<String>)> {
        self.tiers.iter_mut().find(|(tier, _)| tier.name == name)
    }

    /// Adds an annotation, under its own id if that is free, and returns its id.
    pub(super) fn add(&mut self, mut loose: Loose) -> String {
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
    pub(super) fn rename(&mut self, from: &str, to: &str) {
        for (tier, above) in &mut self.tiers {
            if tier.name == from {
                to.clone_into(&mut tier.name);
            }
            if above.as_deref() == Some(from) {
                *above = Some(to.to_owned());
            }
        }
        for loose in self.all.values_mut().filter(|it| it.tier == from) {
            to.clone_into(&mut loose.tier);
        }
    }

    /// Returns the document; annotations below symbolic parents get their spans from the parents.
    pub(super) fn whole(mut self) -> Transcript {
        let names: HashMap<String, usize> = self
            .tiers
            .iter()
            .enumerate()
            .map(|(at, (tier, _))| (tier.name.clone(), at))
            .collect();
        let mut transcript = self.rest;
        for (mut tier, above) in self.tiers {
            tier.parent = above.and_then(|name| names.get(&name).copied());
            if tier.parent.is_none() {
                tier.stereotype = None;
            }
            transcript.tiers.push(tier);
        }
        let mut places: HashMap<String, AnnotationAddress> = HashMap::new();
        let mut seen = HashSet::new();
        for at in parents_first(&transcript) {
            let name = transcript.tiers[at].name.clone();
            let mut own: Vec<Loose> = Vec::new();
            for id in &self.order {
                if self.all.get(id).is_some_and(|it| it.tier == name) && seen.insert(id.clone()) {
                    own.extend(self.all.remove(id));
                }
            }
            fill(&mut transcript, at, own, &mut places);
        }
        let counter = transcript
            .properties
            .iter_mut()
            .find(|(name, _)| name == "lastUsedAnnotationId");
        if let Some((_, value)) = counter {
            let known = value.parse().unwrap_or(0);
            *value = self.last.max(known).to_string();
        }
        transcript
    }
}

fn fill(
    transcript: &mut Transcript,
    at: usize,
    mut own: Vec<Loose>,
    places: &mut HashMap<String, AnnotationAddress>,
) {
    let stereotype = transcript.tiers[at].stereotype;
    let symbolic = stereotype.is_some_and(|it| !it.is_alignable());
    if !symbolic {
        own.sort_by_key(|it| it.it.span);
    }
    let mut families: BTreeMap<AnnotationAddress, Vec<usize>> = BTreeMap::new();
    let mut kept: Vec<(Annotation, f64)> = Vec::new();
    for loose in own {
        let mut it = loose.it;
        it.parent = loose.above.and_then(|id| places.get(&id).copied());
        if symbolic {
            let Some(parent) = it.parent else { continue };
            families.entry(parent).or_default().push(kept.len());
        }
        it.order = 0;
        kept.push((it, loose.rank));
    }
    for (parent, mut family) in families {
        family.sort_by(|x, y| kept[*x].1.total_cmp(&kept[*y].1));
        let Some(span) = transcript.annotation(parent).map(|it| it.span) else {
            continue;
        };
        let many = stereotype == Some(Stereotype::SymbolicSubdivision);
        let count = family.len();
        for (order, index) in family.into_iter().enumerate() {
            let it = &mut kept[index].0;
            it.millis = None;
            if many {
                it.order = u32::try_from(order).unwrap_or(u32::MAX);
                it.span = share(span, order, count);
                it.timing = if count == 1 {
                    Timing::Parent
                } else {
                    Timing::Share
                };
            } else {
                it.span = span;
                it.timing = Timing::Parent;
            }
        }
    }
    for (index, (it, _)) in kept.into_iter().enumerate() {
        places.insert(it.id.clone(), AnnotationAddress { tier: at, index });
        transcript.tiers[at].annotations.push(it);
    }
}

/// Returns the `k`-th of `count` even shares of a span.
fn share(span: Span, k: usize, count: usize) -> Span {
    let cut = |k: usize| {
        let offset = i128::from(span.micros()) * k as i128 / count.max(1) as i128;
        span.start()
            .shifted(i64::try_from(offset).unwrap_or(i64::MAX))
    };
    Span::between(cut(k), cut(k + 1))
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
