//! Checks the tier rules and lists the violations.

use super::{AnnotationId, Tier, TierAnnotation, TierId, TierSet, TierStereotype, subdivision_share};
use crate::text::did_you_mean;
use chereme_motion::{RecordingInstant, TimeSpan};
use std::collections::BTreeMap;

/// The deepest nesting of tiers.
pub const MAX_TIER_DEPTH: usize = 64;

/// One broken rule, with its place; the message states a correction.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TierViolation {
    /// Two tiers have one name.
    #[error("{tier} has the name {name:?} of {other}; give it another")]
    DuplicateName {
        /// The later tier.
        tier: TierId,
        /// The tier that had the name first.
        other: TierId,
        /// The name.
        name: String,
    },
    /// A tier hangs below one that does not exist.
    #[error("{tier} hangs below {parent}, which does not exist; make it a root tier")]
    MissingParentTier {
        /// The tier.
        tier: TierId,
        /// The missing parent.
        parent: TierId,
    },
    /// A tier is its own ancestor.
    #[error("{tier} hangs below itself; give it a parent that is not below it")]
    ParentCycle {
        /// The tier.
        tier: TierId,
    },
    /// A tier hangs below more than [`MAX_TIER_DEPTH`] others.
    #[error("{tier} hangs below more than {MAX_TIER_DEPTH} other tiers; hang it higher")]
    TooDeep {
        /// The tier.
        tier: TierId,
    },
    /// A tier with times of its own hangs below one without.
    #[error(
        "{tier} has times of its own but hangs below {parent}, which has none; make it Symbolic_Subdivision or Symbolic_Association"
    )]
    AlignableBelowSymbolic {
        /// The tier.
        tier: TierId,
        /// The symbolic tier above.
        parent: TierId,
    },
    /// An annotation is on a tier that does not exist.
    #[error("{annotation} is on {tier}, which does not exist")]
    MissingTier {
        /// The annotation.
        annotation: AnnotationId,
        /// The missing tier.
        tier: TierId,
    },
    /// An annotation lasts no time.
    #[error("{annotation} on {tier} starts and ends at {at}; it must last at least a microsecond")]
    ZeroLength {
        /// The tier.
        tier: TierId,
        /// The annotation; `None` for one that was to be added.
        annotation: NamedAnnotation,
        /// Its start and end.
        at: RecordingInstant,
    },
    /// Two annotations of one tier share time.
    #[error("{annotation} from {} to {} overlaps {other} on {tier}; {}", span.span_start_instant(), span.span_end_instant(), separating_change_text(*span, *other_span))]
    Overlap {
        /// The tier.
        tier: TierId,
        /// The annotation; `None` for one that was to be added.
        annotation: NamedAnnotation,
        /// Its time.
        span: TimeSpan,
        /// The one it overlaps.
        other: AnnotationId,
        /// The time of that one.
        other_span: TimeSpan,
    },
    /// An annotation of a child tier has no parent on the tier above.
    #[error("{annotation} on {tier} has no annotation above it on {parent_tier}")]
    MissingParent {
        /// The tier.
        tier: TierId,
        /// The annotation.
        annotation: AnnotationId,
        /// The tier above.
        parent_tier: TierId,
    },
    /// An annotation of a root tier has a parent.
    #[error("{annotation} on the root tier {tier} hangs below {parent}; annotations of a root tier have no parent")]
    ParentOfRoot {
        /// The tier.
        tier: TierId,
        /// The annotation.
        annotation: AnnotationId,
        /// Its parent.
        parent: AnnotationId,
    },
    /// An aligned annotation reaches out of its parent.
    #[error("{annotation} on {tier} lasts from {} to {}; it must lie inside {parent}, from {} to {}", span.span_start_instant(), span.span_end_instant(), parent_span.span_start_instant(), parent_span.span_end_instant())]
    OutsideParent {
        /// The tier.
        tier: TierId,
        /// The annotation.
        annotation: AnnotationId,
        /// Its time.
        span: TimeSpan,
        /// The annotation above.
        parent: AnnotationId,
        /// The time of that one.
        parent_span: TimeSpan,
    },
    /// The Time_Subdivision of an annotation leaves time uncovered.
    #[error("the Time_Subdivision {tier} of {parent} leaves {} to {} uncovered; move a boundary there", gap.span_start_instant(), gap.span_end_instant())]
    Gap {
        /// The tier.
        tier: TierId,
        /// The annotation above.
        parent: AnnotationId,
        /// The uncovered time.
        gap: TimeSpan,
    },
    /// A parent has a second child on a Symbolic_Association.
    #[error("{parent} has {other} on the Symbolic_Association {tier} already; change that one, or remove {annotation}")]
    SecondAssociation {
        /// The tier.
        tier: TierId,
        /// The second child; `None` for one that was to be added.
        annotation: NamedAnnotation,
        /// The annotation above.
        parent: AnnotationId,
        /// The first child.
        other: AnnotationId,
    },
    /// A position among siblings is taken twice, left out, or given on a tier without positions.
    #[error("{annotation} on {tier} has place {order} among its siblings; it must be {expected}")]
    Order {
        /// The tier.
        tier: TierId,
        /// The annotation.
        annotation: AnnotationId,
        /// Its position.
        order: u32,
        /// The position that it must have.
        expected: u32,
    },
    /// A symbolic annotation has another time than follows from its parent.
    #[error("{annotation} on the symbolic {tier} lasts from {} to {}; from its parent follows {} to {}", span.span_start_instant(), span.span_end_instant(), expected.span_start_instant(), expected.span_end_instant())]
    DerivedSpan {
        /// The tier.
        tier: TierId,
        /// The annotation.
        annotation: AnnotationId,
        /// Its time.
        span: TimeSpan,
        /// The time that follows from its parent.
        expected: TimeSpan,
    },
    /// A value is not in the tier's vocabulary.
    #[error("{annotation} on {tier} says {value:?}, which is not in {vocabulary:?}{}", did_you_mean(nearest.as_deref()))]
    NotInVocabulary {
        /// The tier.
        tier: TierId,
        /// The annotation; `None` for one that was to be added.
        annotation: NamedAnnotation,
        /// The value.
        value: String,
        /// The id of the vocabulary.
        vocabulary: String,
        /// The value of the vocabulary nearest to it.
        nearest: Option<String>,
    },
}

impl TierViolation {
    /// Returns the annotations that break the rule, those that are named first; none if it is a rule of tiers.
    #[must_use]
    pub fn violating_annotations(&self) -> Vec<AnnotationId> {
        let named = |annotation: &NamedAnnotation| annotation.0;
        let all = match self {
            Self::Overlap { annotation, other, .. } | Self::SecondAssociation { annotation, other, .. } => {
                [named(annotation), Some(*other)]
            }
            Self::ZeroLength { annotation, .. } | Self::NotInVocabulary { annotation, .. } => [named(annotation), None],
            Self::ParentOfRoot { annotation, parent, .. } | Self::OutsideParent { annotation, parent, .. } => {
                [Some(*annotation), Some(*parent)]
            }
            Self::MissingTier { annotation, .. }
            | Self::MissingParent { annotation, .. }
            | Self::Order { annotation, .. }
            | Self::DerivedSpan { annotation, .. } => [Some(*annotation), None],
            Self::Gap { parent, .. } => [Some(*parent), None],
            Self::DuplicateName { .. }
            | Self::MissingParentTier { .. }
            | Self::ParentCycle { .. }
            | Self::TooDeep { .. }
            | Self::AlignableBelowSymbolic { .. } => [None, None],
        };
        all.into_iter().flatten().collect()
    }
}

/// An annotation; `None` for one that was to be added and has no handle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NamedAnnotation(pub Option<AnnotationId>);

impl std::fmt::Display for NamedAnnotation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Some(id) => id.fmt(f),
            None => f.write_str("the new annotation"),
        }
    }
}

impl From<AnnotationId> for NamedAnnotation {
    fn from(id: AnnotationId) -> Self {
        Self(Some(id))
    }
}

/// Returns every broken rule of the set: of the tiers first, then tier by tier in time order.
#[must_use]
pub fn check_tier_set(set: &TierSet) -> Vec<TierViolation> {
    let mut violations = check_tiers(set);
    for annotation in set.all_annotations().filter(|a| set.tier_by_id(a.tier).is_none()) {
        let TierAnnotation { id, tier, .. } = *annotation;
        violations.push(TierViolation::MissingTier { annotation: id, tier });
    }
    for tier in set.all_tiers() {
        check_annotations(set, tier, &mut violations);
    }
    violations
}

/// Returns every broken rule of the tiers alone: names, parents, stereotypes.
#[must_use]
pub fn check_tiers(set: &TierSet) -> Vec<TierViolation> {
    let mut violations = Vec::new();
    let mut names = BTreeMap::new();
    for tier in set.all_tiers() {
        if let Some(other) = names.insert(&tier.name, tier.id) {
            let (tier, name) = (tier.id, tier.name.clone());
            violations.push(TierViolation::DuplicateName { tier, other, name });
        }
        violations.extend(check_ancestors(set, tier));
    }
    violations
}

fn check_ancestors(set: &TierSet, tier: &Tier) -> Option<TierViolation> {
    let parent = set.tier_by_id(tier.parent_id()?);
    match parent {
        None => {
            let parent = tier.parent_id()?;
            return Some(TierViolation::MissingParentTier { tier: tier.id, parent });
        }
        Some(parent) if tier.is_alignable() && !parent.is_alignable() => {
            let parent = parent.id;
            return Some(TierViolation::AlignableBelowSymbolic { tier: tier.id, parent });
        }
        Some(_) => {}
    }
    let mut above = parent;
    // A circle above this tier that does not contain it must end, too.
    for _ in 0..MAX_TIER_DEPTH {
        let ancestor = above?;
        if ancestor.id == tier.id {
            return Some(TierViolation::ParentCycle { tier: tier.id });
        }
        above = ancestor.parent_id().and_then(|id| set.tier_by_id(id));
    }
    above.map(|_| TierViolation::TooDeep { tier: tier.id })
}

fn check_annotations(set: &TierSet, tier: &Tier, found: &mut Vec<TierViolation>) {
    let mut latest: Option<&TierAnnotation> = None;
    let mut families: BTreeMap<AnnotationId, Vec<&TierAnnotation>> = BTreeMap::new();
    for annotation in set.annotations_on_tier(tier.id) {
        found.extend(check_value(set, tier, annotation.id.into(), &annotation.value));
        if tier.is_alignable() {
            found.extend(check_time(annotation, latest));
            // Annotations in order of their starts may end later than the next one; the longest so far counts.
            latest = latest
                .into_iter()
                .chain([annotation])
                .max_by_key(|a| a.span.span_end_instant());
        }
        match check_parent(set, tier, annotation) {
            Ok(Some(parent)) => families.entry(parent).or_default().push(annotation),
            Ok(None) => {}
            Err(violation) => found.push(violation),
        }
    }
    for (parent, children) in families {
        if let (Some(parent), Some(stereotype)) = (set.annotation_by_id(parent), tier.tier_stereotype()) {
            check_family(parent, stereotype, children, found);
        }
    }
}

fn check_time(annotation: &TierAnnotation, latest: Option<&TierAnnotation>) -> Option<TierViolation> {
    let TierAnnotation { id, tier, span, .. } = *annotation;
    if span.is_empty() {
        return Some(TierViolation::ZeroLength {
            tier,
            annotation: id.into(),
            at: span.span_start_instant(),
        });
    }
    let other = latest.filter(|other| other.span.is_overlapping_span(span))?;
    Some(overlap_violation(tier, id.into(), span, other))
}

/// Returns the change that would separate an annotation from one that it overlaps: a possible end, a possible start, or
/// another time.
fn separating_change_text(span: TimeSpan, other: TimeSpan) -> String {
    let end = (other.span_start_instant() > span.span_start_instant())
        .then(|| format!("end it at {} or before", other.span_start_instant()));
    let start = (other.span_end_instant() < span.span_end_instant())
        .then(|| format!("start it at {} or after", other.span_end_instant()));
    match (end, start) {
        (Some(end), Some(start)) => format!("{end}, or {start}"),
        (Some(only), None) | (None, Some(only)) => only,
        (None, None) => "move one of the two, or shorten the other".to_owned(),
    }
}

pub(super) fn overlap_violation(
    tier: TierId,
    annotation: NamedAnnotation,
    span: TimeSpan,
    with: &TierAnnotation,
) -> TierViolation {
    TierViolation::Overlap {
        tier,
        annotation,
        span,
        other: with.id,
        other_span: with.span,
    }
}

/// Returns the parent of an annotation, or the violation if it has none but needs one, or has one on a root tier.
fn check_parent(
    set: &TierSet,
    tier: &Tier,
    annotation: &TierAnnotation,
) -> Result<Option<AnnotationId>, TierViolation> {
    let id = annotation.id;
    match (tier.parent_id(), annotation.parent) {
        (None, None) => Ok(None),
        (None, Some(parent)) => Err(TierViolation::ParentOfRoot {
            tier: tier.id,
            annotation: id,
            parent,
        }),
        (Some(parent_tier), parent) => parent
            .filter(|parent| set.annotation_by_id(*parent).is_some_and(|p| p.tier == parent_tier))
            .map(Some)
            .ok_or(TierViolation::MissingParent {
                tier: tier.id,
                annotation: id,
                parent_tier,
            }),
    }
}

fn check_family(
    parent: &TierAnnotation,
    stereotype: TierStereotype,
    mut children: Vec<&TierAnnotation>,
    found: &mut Vec<TierViolation>,
) {
    children.sort_by_key(|child| child.order);
    let count = children.len();
    for (place, child) in children.iter().enumerate() {
        let TierAnnotation {
            id: annotation,
            tier,
            span,
            order,
            ..
        } = **child;
        let listed = stereotype == TierStereotype::SymbolicSubdivision;
        let expected = if listed {
            u32::try_from(place).unwrap_or(u32::MAX)
        } else {
            0
        };
        if order != expected {
            found.push(TierViolation::Order {
                tier,
                annotation,
                order,
                expected,
            });
        }
        let (parent, parent_span) = (parent.id, parent.span);
        if stereotype.is_alignable() {
            if !parent_span.has_span_inside(span) {
                found.push(TierViolation::OutsideParent {
                    tier,
                    annotation,
                    span,
                    parent,
                    parent_span,
                });
            }
            continue;
        }
        // An association has one child at most.
        if place > 0 && !listed {
            let (annotation, other) = (annotation.into(), children[0].id);
            found.push(TierViolation::SecondAssociation {
                tier,
                annotation,
                parent,
                other,
            });
        }
        let expected = if listed {
            subdivision_share(parent_span, place, count)
        } else {
            parent_span
        };
        if span != expected {
            found.push(TierViolation::DerivedSpan {
                tier,
                annotation,
                span,
                expected,
            });
        }
    }
    if stereotype == TierStereotype::TimeSubdivision {
        check_tiling(parent, &children, found);
    }
}

fn check_tiling(parent: &TierAnnotation, children: &[&TierAnnotation], found: &mut Vec<TierViolation>) {
    let ends = children
        .iter()
        .map(|child| (child.span.span_start_instant(), child.span.span_end_instant()));
    let mut covered = parent.span.span_start_instant();
    let end = parent.span.span_end_instant();
    for (start, next) in ends.chain([(end, end)]) {
        if covered < start {
            let (tier, gap) = (children[0].tier, TimeSpan::span_between(covered, start));
            found.push(TierViolation::Gap {
                tier,
                parent: parent.id,
                gap,
            });
        }
        covered = covered.max(next);
    }
}

/// Returns the violation if a value is not in its tier's vocabulary.
pub(super) fn check_value(
    set: &TierSet,
    tier: &Tier,
    annotation: NamedAnnotation,
    value: &crate::component::ComponentReading,
) -> Option<TierViolation> {
    let value = value.reading_value()?;
    let vocabulary = tier.vocabulary.as_deref()?;
    let unmet_vocabulary = set
        .vocabulary_by_id(vocabulary)
        .filter(|known| !known.contains(value))?;
    let nearest = crate::text::nearest_candidate(value, unmet_vocabulary.iter().map(String::as_str));
    Some(TierViolation::NotInVocabulary {
        tier: tier.id,
        annotation,
        value: value.to_owned(),
        vocabulary: vocabulary.to_owned(),
        nearest: nearest.map(str::to_owned),
    })
}
