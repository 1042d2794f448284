//! Tiers and annotations: the description of a recording, apart from its movement.
//!
//! A [`Tier`] is a list of annotations of one kind; a child tier hangs below a parent tier by one of ELAN's four
//! [`TierStereotype`]s. A [`TierSet`] holds the tiers of one recording, or only the neighbourhood of one change. Nothing
//! edits a tier set directly: [`plan_tier_change`] turns a [`AskedTierChange`] into the [`TierEdit`]s that carry it out with all its
//! consequences, or reports the rule that it would break; [`check_tier_set`] lists the broken rules of a set from elsewhere.
//!
//! # Rules
//!
//! | tier | rule |
//! |---|---|
//! | all | annotations of a tier never overlap; an aligned one lasts at least a microsecond |
//! | root | every annotation has its own time |
//! | Time_Subdivision | the children of one parent tile it without gaps |
//! | Included_In | each annotation lies inside one parent |
//! | Symbolic_Subdivision | the children of one parent are an ordered list; each has an equal share of its time |
//! | Symbolic_Association | at most one child per parent, with its parent's time |
//! | tree | no tier is its own ancestor; an alignable tier never sits below a symbolic one |
//! | vocabulary | if the values of a tier's vocabulary are known, its annotations use no others |

mod error;
mod role;
#[cfg(test)]
mod tests;
mod tier_check;
mod tier_merge;
mod tier_plan;
pub mod tier_spans;

pub use error::EditError;
pub use role::{AnnotatedHands, RoleError, RoleWords, TierRole, TierTopic};
pub use tier_check::{MAX_TIER_DEPTH, NamedAnnotation, TierViolation, check_tier_set, check_tiers};
pub use tier_plan::plan_tier_change;

use crate::component::{ComponentReading, HandRef};
use chereme_motion::TimeSpan;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Names one tier within a corpus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct TierId(pub u64);

/// Names one annotation within a corpus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct AnnotationId(pub u64);

impl fmt::Display for TierId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tier:{}", self.0)
    }
}

impl fmt::Display for AnnotationId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "annotation:{}", self.0)
    }
}

/// The relation of a child tier's annotations to those of its parent tier, as in ELAN.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum TierStereotype {
    /// The children tile their parent without gaps.
    #[serde(rename = "Time_Subdivision")]
    TimeSubdivision,
    /// Each child lies inside one parent; gaps are allowed.
    #[serde(rename = "Included_In")]
    IncludedIn,
    /// The children are an ordered list without times of their own.
    #[serde(rename = "Symbolic_Subdivision")]
    SymbolicSubdivision,
    /// At most one child, without a time of its own.
    #[serde(rename = "Symbolic_Association")]
    SymbolicAssociation,
}

impl TierStereotype {
    /// The four stereotypes.
    pub const ALL_TIER_STEREOTYPES: [Self; 4] = [
        Self::TimeSubdivision,
        Self::IncludedIn,
        Self::SymbolicSubdivision,
        Self::SymbolicAssociation,
    ];

    /// Returns ELAN's name of the stereotype, such as `Time_Subdivision`.
    #[must_use]
    pub fn elan_name(self) -> &'static str {
        match self {
            Self::TimeSubdivision => "Time_Subdivision",
            Self::IncludedIn => "Included_In",
            Self::SymbolicSubdivision => "Symbolic_Subdivision",
            Self::SymbolicAssociation => "Symbolic_Association",
        }
    }

    /// Returns the stereotype of ELAN's name; case, blanks and underscores do not count.
    #[must_use]
    pub fn from_elan_name(text: &str) -> Option<Self> {
        let plain = |name: &str| {
            name.chars()
                .filter(|c| c.is_alphanumeric())
                .collect::<String>()
                .to_lowercase()
        };
        Self::ALL_TIER_STEREOTYPES
            .into_iter()
            .find(|stereotype| plain(stereotype.elan_name()) == plain(text))
    }

    /// Returns whether annotations below this stereotype have times of their own.
    #[must_use]
    pub fn is_alignable(self) -> bool {
        matches!(self, Self::TimeSubdivision | Self::IncludedIn)
    }
}

impl fmt::Display for TierStereotype {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.elan_name())
    }
}

/// A list of annotations of one kind about one recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tier {
    /// The tier's handle.
    pub id: TierId,
    /// The name, unique within its recording.
    pub name: String,
    /// The subject of the annotations.
    pub role: TierRole,
    /// The hand that they describe, if they describe one.
    pub hand: Option<HandRef>,
    /// The tier above, and the relation to it; `None` for a root tier.
    pub parent: Option<(TierId, TierStereotype)>,
    /// The id of the inventory or controlled vocabulary that the values come from.
    pub vocabulary: Option<String>,
}

impl Tier {
    /// Returns a root tier of glosses without a hand.
    #[must_use]
    pub fn root_tier(id: TierId, name: impl Into<String>) -> Self {
        let (role, hand, parent, vocabulary) = (TierRole::Gloss, None, None, None);
        Self {
            id,
            name: name.into(),
            role,
            hand,
            parent,
            vocabulary,
        }
    }

    /// Returns the stereotype; `None` for a root tier.
    #[must_use]
    pub fn tier_stereotype(&self) -> Option<TierStereotype> {
        self.parent.map(|(_, stereotype)| stereotype)
    }

    /// Returns the handle of the tier above; `None` for a root tier.
    #[must_use]
    pub fn parent_id(&self) -> Option<TierId> {
        self.parent.map(|(id, _)| id)
    }

    /// Returns whether the annotations have times of their own.
    #[must_use]
    pub fn is_alignable(&self) -> bool {
        self.tier_stereotype().is_none_or(TierStereotype::is_alignable)
    }
}

/// One statement about a stretch of a recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TierAnnotation {
    /// The annotation's handle.
    pub id: AnnotationId,
    /// The tier it is on.
    pub tier: TierId,
    /// The annotation above it on the parent tier; `None` on a root tier.
    pub parent: Option<AnnotationId>,
    /// The place among its siblings in a Symbolic_Subdivision, counted from 0; 0 elsewhere.
    pub order: u32,
    /// Its time span: its own, or on a symbolic tier the one that follows from its parent.
    pub span: TimeSpan,
    /// Its value.
    pub value: ComponentReading,
}

/// Values that the annotations of a tier may have.
pub type TierVocabulary = BTreeSet<String>;

/// The tiers of a recording with their annotations, or the neighbourhood of one change.
///
/// A set that holds less than everything must hold every tier of the recording, and for a
/// [`AskedTierChange`] the annotations that [`AskedTierChange::change_window`] describes.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TierSet {
    tiers: BTreeMap<TierId, Tier>,
    vocabularies: BTreeMap<String, TierVocabulary>,
    annotations: BTreeMap<AnnotationId, TierAnnotation>,
    by_time: BTreeMap<TierId, BTreeSet<TimeKey>>,
    children: BTreeMap<AnnotationId, BTreeSet<(TierId, TimeKey)>>,
}

type TimeKey = (chereme_motion::RecordingInstant, u32, AnnotationId);

/// One step of a change: annotations to write or remove, or a tier to write.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TierEdit {
    /// Writes the annotation, in place of the one with the same handle if there is one.
    Put(TierAnnotation),
    /// Removes the annotation with this handle.
    Remove(AnnotationId),
}

/// A change that somebody asks for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum AskedTierChange {
    /// Adds an annotation with a time of its own to an alignable tier.
    Add {
        /// The tier.
        tier: TierId,
        /// The time. On a Time_Subdivision it is either a whole parent that has no child there yet, or the head or tail
        /// of one sibling, which is shortened.
        span: TimeSpan,
        /// The value.
        value: ComponentReading,
    },
    /// Adds an annotation below a parent on a symbolic tier.
    AddBelow {
        /// The tier.
        tier: TierId,
        /// The annotation above.
        parent: AnnotationId,
        /// The position among the siblings from 0, later ones moving on; `None` for the end.
        order: Option<u32>,
        /// The value.
        value: ComponentReading,
    },
    /// Gives an aligned annotation another time.
    ///
    /// If the length stays the same, everything below moves along; otherwise annotations below are clipped, and those
    /// without any time left are removed. On a Time_Subdivision the neighbours' shared boundaries follow.
    Move {
        /// The annotation.
        annotation: AnnotationId,
        /// The new time.
        span: TimeSpan,
    },
    /// Gives an annotation of a Symbolic_Subdivision another place among its siblings.
    Reorder {
        /// The annotation.
        annotation: AnnotationId,
        /// The new place from 0; past the end is the end.
        order: u32,
    },
    /// Cuts an aligned annotation in two, both with its value.
    ///
    /// An annotation below goes to the half in which it lies; one that crosses the cut is cut too; symbolic
    /// children stay with the first half.
    Split {
        /// The annotation, which becomes the first half.
        annotation: AnnotationId,
        /// The cut, inside the annotation.
        at: chereme_motion::RecordingInstant,
    },
    /// Merges two neighbours on an alignable tier or in a Symbolic_Subdivision into one annotation.
    ///
    /// The first stays and takes the second's time and children; a gap between them is filled. Symbolic lists are
    /// joined; of two equal Symbolic_Associations one stays.
    Merge {
        /// The earlier annotation, which stays.
        first: AnnotationId,
        /// The later annotation, which is removed.
        second: AnnotationId,
        /// The value of the merged annotation; `None` if both have the same.
        value: Option<ComponentReading>,
        /// The treatment of children of equal value that meet at the seam.
        seam: MergeSeam,
    },
    /// Removes an annotation and all below it.
    ///
    /// On a Time_Subdivision the sibling before it, or else after it, takes over its time.
    Remove {
        /// The annotation.
        annotation: AnnotationId,
    },
    /// Changes the value of an annotation.
    SetValue {
        /// The annotation.
        annotation: AnnotationId,
        /// The new value.
        value: ComponentReading,
    },
}

/// How a merge treats children of equal value that meet at the seam of their parents.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MergeSeam {
    /// They stay apart.
    #[default]
    Keep,
    /// They become one, which undoes a split that cut their parents.
    Join,
}

impl TierSet {
    /// Returns a set of these tiers and annotations without checking them; [`check_tier_set`] lists the rules that they break.
    #[must_use]
    pub fn new(tiers: impl IntoIterator<Item = Tier>, annotations: impl IntoIterator<Item = TierAnnotation>) -> Self {
        let mut set = Self::default();
        for tier in tiers {
            set.tiers.insert(tier.id, tier);
        }
        for annotation in annotations {
            set.put_annotation(annotation);
        }
        set
    }

    /// Returns this set with the values of the vocabulary `id`; values of vocabularies that a set does not know are not
    /// checked.
    #[must_use]
    pub fn with_vocabulary(mut self, id: impl Into<String>, values: impl IntoIterator<Item = String>) -> Self {
        self.vocabularies.insert(id.into(), values.into_iter().collect());
        self
    }

    /// Returns the tiers in the order of their handles.
    pub fn all_tiers(&self) -> impl Iterator<Item = &Tier> {
        self.tiers.values()
    }

    /// Returns the tier with this handle.
    #[must_use]
    pub fn tier_by_id(&self, id: TierId) -> Option<&Tier> {
        self.tiers.get(&id)
    }

    /// Returns the tiers that hang directly below `id`.
    pub fn tiers_below(&self, id: TierId) -> impl Iterator<Item = &Tier> {
        self.tiers.values().filter(move |tier| tier.parent_id() == Some(id))
    }

    /// Returns the known values of the vocabulary `id`.
    #[must_use]
    pub fn vocabulary_by_id(&self, id: &str) -> Option<&TierVocabulary> {
        self.vocabularies.get(id)
    }

    /// Returns every annotation in the order of their handles.
    pub fn all_annotations(&self) -> impl Iterator<Item = &TierAnnotation> {
        self.annotations.values()
    }

    /// Returns the annotation with this handle.
    #[must_use]
    pub fn annotation_by_id(&self, id: AnnotationId) -> Option<&TierAnnotation> {
        self.annotations.get(&id)
    }

    /// Returns the annotations of a tier in the order of time, and of their positions below a parent.
    pub fn annotations_on_tier(&self, tier: TierId) -> impl DoubleEndedIterator<Item = &TierAnnotation> {
        let keys = self.by_time.get(&tier).into_iter().flatten();
        keys.filter_map(|(_, _, id)| self.annotations.get(id))
    }

    /// Returns the annotations directly below `parent`, tier by tier, each in the order of time.
    pub fn annotations_below(&self, parent: AnnotationId) -> impl DoubleEndedIterator<Item = &TierAnnotation> {
        let keys = self.children.get(&parent).into_iter().flatten();
        keys.filter_map(|(_, (_, _, id))| self.annotations.get(id))
    }

    /// Returns the annotations of `tier` directly below `parent` in the order of time.
    pub fn below_on(&self, parent: AnnotationId, tier: TierId) -> impl DoubleEndedIterator<Item = &TierAnnotation> {
        self.annotations_below(parent).filter(move |child| child.tier == tier)
    }

    /// Returns the annotations of `tier` that share an instant with `span`, in the order of time.
    #[must_use]
    pub fn overlapping_annotations(&self, tier: TierId, span: TimeSpan) -> Vec<&TierAnnotation> {
        let Some(keys) = self.by_time.get(&tier) else {
            return Vec::new();
        };
        let end = (span.span_end_instant(), 0, AnnotationId(0));
        let mut overlaps: Vec<&TierAnnotation> = keys
            .range(..end)
            .rev()
            .filter_map(|(_, _, id)| self.annotations.get(id))
            .take_while(|annotation| annotation.span.span_end_instant() > span.span_start_instant())
            .collect();
        overlaps.reverse();
        overlaps
    }

    /// Carries out `edits` in their order.
    pub fn apply_edits(&mut self, edits: impl IntoIterator<Item = TierEdit>) {
        for edit in edits {
            match edit {
                TierEdit::Put(annotation) => self.put_annotation(annotation),
                TierEdit::Remove(id) => self.remove_annotation(id),
            }
        }
    }

    fn put_annotation(&mut self, annotation: TierAnnotation) {
        self.remove_annotation(annotation.id);
        let key = time_key(&annotation);
        self.by_time.entry(annotation.tier).or_default().insert(key);
        if let Some(parent) = annotation.parent {
            self.children.entry(parent).or_default().insert((annotation.tier, key));
        }
        self.annotations.insert(annotation.id, annotation);
    }

    fn remove_annotation(&mut self, id: AnnotationId) {
        let Some(old) = self.annotations.remove(&id) else {
            return;
        };
        let key = time_key(&old);
        if let Some(keys) = self.by_time.get_mut(&old.tier) {
            keys.remove(&key);
            if keys.is_empty() {
                self.by_time.remove(&old.tier);
            }
        }
        let Some(parent) = old.parent else { return };
        if let Some(keys) = self.children.get_mut(&parent) {
            keys.remove(&(old.tier, key));
            if keys.is_empty() {
                self.children.remove(&parent);
            }
        }
    }
}

/// Returns the time of the child at position `place` of `count` equal ones below a parent, as ELAN shows a
/// Symbolic_Subdivision.
///
/// The shares tile the parent; their lengths differ by a microsecond at most.
#[must_use]
pub fn subdivision_share(parent: TimeSpan, place: usize, count: usize) -> TimeSpan {
    let (length, count) = (i128::from(parent.span_micros()), (count as i128).max(1));
    let boundary = |place: i128| {
        let offset = length * place.min(count) / count;
        parent
            .span_start_instant()
            .shifted_instant(i64::try_from(offset).unwrap_or(i64::MAX))
    };
    TimeSpan::span_between(boundary(place as i128), boundary(place as i128 + 1))
}

fn time_key(annotation: &TierAnnotation) -> TimeKey {
    (annotation.span.span_start_instant(), annotation.order, annotation.id)
}
