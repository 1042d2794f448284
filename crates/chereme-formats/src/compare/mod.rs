//! Annotation documents side by side: their [differences](diff) by meaning, and a [merge] of two that diverged.
//!
//! Annotations are the same by their ids if both documents descend from one, else by tier and time. Time slots,
//! the order of elements and the spelling of a file make no difference.

mod apply;
mod identity;
mod loose;
mod merge;
#[cfg(test)]
mod tests;

pub use apply::apply;
pub use merge::{Conflict, Merged, merge, merge_two, with_candidates};

use crate::eaf::Transcript;
use crate::eaf::convert::{Annotation, AnnotationAddress, Tier};
use chereme_sign::Stereotype;
use identity::{Matching, matched, matched_tiers};
use serde::Serialize;
use std::collections::BTreeMap;

/// The greatest difference, in microseconds, of times that count as equal: less than the millisecond to which files round.
pub const TOLERANCE: i64 = 999;

/// The differences of two documents, from the first to the second.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Difference {
    /// Annotations of the second alone.
    pub added: Vec<ComparedAnnotation>,
    /// Annotations of the first alone.
    pub removed: Vec<ComparedAnnotation>,
    /// Annotations at another time, on another tier, or at another place among their siblings.
    pub moved: Vec<Moved>,
    /// Annotations whose text or vocabulary entry changed.
    pub revalued: Vec<Revalued>,
    /// Tiers that were added, removed, renamed or changed.
    pub tiers: Vec<TierChange>,
    /// Changes of media, properties and vocabularies, as sentences.
    pub document: Vec<String>,
    /// Everything of the second document except its tiers, if it differs.
    #[serde(skip)]
    pub(crate) rest: Option<Box<Transcript>>,
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
    pub(crate) whole: Annotation,
    /// The annotation above.
    #[serde(skip)]
    pub(crate) above: Option<Above>,
    /// The sibling before it.
    #[serde(skip)]
    pub(crate) before: Option<Above>,
}

/// An annotation that another refers to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Above {
    /// An annotation of the first document, by its id there.
    Known(String),
    /// An annotation of the second document alone, by its id there.
    New(String),
}

/// An annotation whose time or place changed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Moved {
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
pub struct Revalued {
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
pub struct TierChange {
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
    pub(crate) whole: Tier,
    #[serde(skip)]
    pub(crate) parent: Option<String>,
}

impl Difference {
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
pub fn diff(a: &Transcript, b: &Transcript) -> Difference {
    let matching = matched(a, b);
    let mut difference = Difference {
        document: document(a, b),
        ..Difference::default()
    };
    difference.rest = (!difference.document.is_empty()).then(|| {
        Box::new(Transcript {
            tiers: Vec::new(),
            ..b.clone()
        })
    });
    tiers(a, b, &matching, &mut difference);
    for place in places(a) {
        let Some(other) = matching.pairs.get(&place) else {
            difference.removed.push(compared((a, None), place));
            continue;
        };
        compare((a, place), (b, *other), &matching, &mut difference);
    }
    for place in places(b) {
        if !matching.back.contains_key(&place) {
            let whole = compared((b, Some((a, &matching))), place);
            difference.added.push(whole);
        }
    }
    difference
}

/// Returns the tiers of `a` that have another name in `b`, each with its new name.
#[must_use]
pub fn renamed_tiers(a: &Transcript, b: &Transcript) -> Vec<(String, String)> {
    let pairs = a.tiers.iter().zip(matched_tiers(a, b));
    pairs
        .filter_map(|(tier, other)| Some((tier, &b.tiers[other?])))
        .filter(|(tier, other)| tier.name != other.name)
        .map(|(tier, other)| (tier.name.clone(), other.name.clone()))
        .collect()
}

fn compare(
    (a, old): (&Transcript, AnnotationAddress),
    (b, new): (&Transcript, AnnotationAddress),
    matching: &Matching,
    difference: &mut Difference,
) {
    let (x, y) = (get(a, old), get(b, new));
    let now = compared((b, Some((a, matching))), new);
    let before = compared((a, None), old);
    let symbolic = is_symbolic(b, new.tier);
    let parent = |it: &Annotation| it.parent;
    let elsewhere = matching.tiers[old.tier] != Some(new.tier);
    let moved = if symbolic {
        let above = parent(x).and_then(|place| matching.pairs.get(&place));
        above.copied() != parent(y) || !same_neighbour((a, old), (b, new), matching)
    } else {
        let far = |p: i64, q: i64| p.abs_diff(q) > TOLERANCE.unsigned_abs();
        far(before.start_us, now.start_us) || far(before.end_us, now.end_us)
    };
    if moved || elsewhere {
        difference.moved.push(Moved {
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
        difference.revalued.push(Revalued {
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
    (a, old): (&Transcript, AnnotationAddress),
    (b, new): (&Transcript, AnnotationAddress),
    matching: &Matching,
) -> bool {
    let chain =
        |it: &Transcript, own: AnnotationAddress, known: &dyn Fn(AnnotationAddress) -> bool| {
            let annotation = get(it, own);
            let siblings = it.tiers[own.tier].annotations.iter().enumerate();
            siblings
                .filter(|(index, sibling)| {
                    let place = AnnotationAddress {
                        tier: own.tier,
                        index: *index,
                    };
                    sibling.parent == annotation.parent
                        && sibling.order < annotation.order
                        && known(place)
                })
                .max_by_key(|(_, sibling)| sibling.order)
                .map(|(index, _)| AnnotationAddress {
                    tier: own.tier,
                    index,
                })
        };
    let before = chain(a, old, &|place| matching.pairs.contains_key(&place));
    let after = chain(b, new, &|place| matching.back.contains_key(&place));
    before.and_then(|place| matching.pairs.get(&place)).copied() == after
}

fn tiers(a: &Transcript, b: &Transcript, matching: &Matching, difference: &mut Difference) {
    let name = |it: &Transcript, tier: Option<usize>| tier.map(|at| it.tiers[at].name.clone());
    for (at, tier) in a.tiers.iter().enumerate() {
        let change = |change, other: &Tier| TierChange {
            change,
            tier: tier.name.clone(),
            to: None,
            fields: BTreeMap::new(),
            whole: bare(other),
            parent: None,
        };
        let Some(new) = matching.tiers[at] else {
            difference.tiers.push(change("removed", tier));
            continue;
        };
        let other = &b.tiers[new];
        let parent = name(b, other.parent);
        if tier.name != other.name {
            difference.tiers.push(TierChange {
                to: Some(other.name.clone()),
                parent: parent.clone(),
                ..change("renamed", other)
            });
        }
        let same_parent = tier.parent.and_then(|it| matching.tiers[it]) == other.parent;
        let mut fields = fields(tier, other);
        if !same_parent {
            let both = [name(a, tier.parent), name(b, other.parent)];
            fields.insert("parent", both.map(Option::unwrap_or_default));
        }
        if !fields.is_empty() {
            difference.tiers.push(TierChange {
                fields,
                parent,
                ..change("changed", other)
            });
        }
    }
    for (at, tier) in b.tiers.iter().enumerate() {
        if !matching.tiers.contains(&Some(at)) {
            difference.tiers.push(TierChange {
                change: "added",
                tier: tier.name.clone(),
                to: None,
                fields: BTreeMap::new(),
                whole: bare(tier),
                parent: name(b, tier.parent),
            });
        }
    }
}

/// Returns the properties that differ between two tiers, except for names and parents.
fn fields(a: &Tier, b: &Tier) -> BTreeMap<&'static str, [String; 2]> {
    let stereotype = |it: &Tier| it.stereotype.map(Stereotype::elan_name).map(str::to_owned);
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

fn document(a: &Transcript, b: &Transcript) -> Vec<String> {
    let mut all = Vec::new();
    let properties = |it: &Transcript| -> BTreeMap<String, String> {
        let own = it.properties.iter().cloned();
        own.filter(|(name, _)| name != "lastUsedAnnotationId")
            .collect()
    };
    sentences("property", &properties(a), &properties(b), &mut all);
    let media = |it: &Transcript| -> BTreeMap<String, String> {
        let own = it.media.iter().chain(&it.linked_files);
        own.map(|it| (it.url.clone(), format!("{it:?}"))).collect()
    };
    sentences("media file", &media(a), &media(b), &mut all);
    let vocabularies = |it: &Transcript| -> BTreeMap<String, String> {
        let own = it.vocabularies.iter();
        own.map(|it| (it.id.clone(), format!("{it:?}"))).collect()
    };
    sentences("vocabulary", &vocabularies(a), &vocabularies(b), &mut all);
    all
}

fn sentences(
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
fn compared(
    (it, of): (&Transcript, Option<(&Transcript, &Matching)>),
    place: AnnotationAddress,
) -> ComparedAnnotation {
    let whole = get(it, place);
    let refer = |other: AnnotationAddress| match of {
        None => Above::Known(get(it, other).id.clone()),
        Some((a, matching)) => match matching.back.get(&other) {
            Some(known) => Above::Known(get(a, *known).id.clone()),
            None => Above::New(get(it, other).id.clone()),
        },
    };
    // Only links of a chain have an order; a search for the neighbours of all others would take long.
    let siblings = it.tiers[place.tier].annotations.iter().enumerate();
    let before = (whole.order > 0).then(|| {
        let mut siblings = siblings.filter(|(_, sibling)| {
            sibling.parent == whole.parent && sibling.order + 1 == whole.order
        });
        siblings.next().map(|(index, _)| AnnotationAddress {
            tier: place.tier,
            index,
        })
    });
    let before = before.flatten();
    ComparedAnnotation {
        tier: it.tiers[place.tier].name.clone(),
        id: whole.id.clone(),
        start_us: whole.span.start().micros(),
        end_us: whole.span.end().micros(),
        value: whole.value.clone(),
        above: whole.parent.map(refer),
        before: before.map(refer),
        whole: whole.clone(),
    }
}

fn bare(tier: &Tier) -> Tier {
    Tier {
        annotations: Vec::new(),
        parent: None,
        ..tier.clone()
    }
}

fn places(it: &Transcript) -> Vec<AnnotationAddress> {
    let all = it.tiers.iter().enumerate();
    all.flat_map(|(tier, own)| {
        (0..own.annotations.len()).map(move |index| AnnotationAddress { tier, index })
    })
    .collect()
}

fn get(it: &Transcript, place: AnnotationAddress) -> &Annotation {
    &it.tiers[place.tier].annotations[place.index]
}

fn is_symbolic(it: &Transcript, tier: usize) -> bool {
    let stereotype = it.tiers[tier].stereotype;
    stereotype.is_some_and(|it| !it.is_alignable())
}
