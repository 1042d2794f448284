//! The reasons why a change cannot be made.

use super::tier_check::{NamedAnnotation, TierViolation};
use super::{AnnotationId, TierId, TierStereotype};
use crate::component::ComponentReading;
use chereme_motion::{RecordingInstant, TimeSpan};

/// A change that cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// It would break a rule.
    #[error(transparent)]
    Breaks(#[from] TierViolation),
    /// The change names a tier that does not exist.
    #[error("{0} does not exist")]
    UnknownTier(TierId),
    /// The change names an annotation that does not exist.
    #[error("{0} does not exist")]
    UnknownAnnotation(AnnotationId),
    /// The change needs a tier with times of its own.
    #[error("{tier} is a {stereotype}: its annotations have no times of their own; change the one above")]
    NoTime {
        /// The tier.
        tier: TierId,
        /// Its stereotype.
        stereotype: TierStereotype,
    },
    /// The change needs a tier without times of its own.
    #[error("{tier} has times of its own; give the new annotation a time instead of a parent")]
    NotSymbolic {
        /// The tier.
        tier: TierId,
    },
    /// The change needs a Symbolic_Subdivision.
    #[error("{tier} is no Symbolic_Subdivision: its annotations have no order to change")]
    NoOrder {
        /// The tier.
        tier: TierId,
    },
    /// No annotation of the tier above holds the wanted time.
    #[error("{annotation} from {} to {} must lie inside one annotation of {parent_tier}{}", span.span_start_instant(), span.span_end_instant(), nearest_reach_text(nearest))]
    NoParent {
        /// The annotation; `None` for one that was to be added.
        annotation: NamedAnnotation,
        /// The wanted time.
        span: TimeSpan,
        /// The tier above.
        parent_tier: TierId,
        /// An annotation there that holds some of the time, and its time.
        nearest: Option<(AnnotationId, TimeSpan)>,
    },
    /// The annotation given as parent is not on the tier above.
    #[error("{parent} is not on {parent_tier}, the tier above {tier}")]
    WrongParent {
        /// The tier.
        tier: TierId,
        /// The tier above.
        parent_tier: TierId,
        /// The annotation that was given.
        parent: AnnotationId,
    },
    /// The first child on a Time_Subdivision must fill its parent.
    #[error("the first annotation of {tier} below {parent} must last from {} to {} as that does; split it afterwards", parent_span.span_start_instant(), parent_span.span_end_instant())]
    FillParent {
        /// The tier.
        tier: TierId,
        /// The annotation above.
        parent: AnnotationId,
        /// The time of that one.
        parent_span: TimeSpan,
    },
    /// A new annotation of a Time_Subdivision must be the head or tail of one sibling.
    #[error(
        "on the Time_Subdivision {tier} a new annotation takes the head or the tail of an existing one; split {sibling} instead"
    )]
    HeadOrTail {
        /// The tier.
        tier: TierId,
        /// The sibling that holds the start of the wanted time.
        sibling: AnnotationId,
    },
    /// A boundary on a Time_Subdivision would pass its neighbour's other end or leave the parent.
    #[error("{annotation} cannot have a boundary at {at}; between {from} and {to} is right")]
    Boundary {
        /// The annotation.
        annotation: AnnotationId,
        /// The wanted boundary.
        at: RecordingInstant,
        /// The earliest allowed boundary.
        from: RecordingInstant,
        /// The latest allowed boundary.
        to: RecordingInstant,
    },
    /// A cut does not lie inside the annotation.
    #[error("{annotation} cannot be cut at {at}; it lasts from {} to {}", span.span_start_instant(), span.span_end_instant())]
    CutOutside {
        /// The annotation.
        annotation: AnnotationId,
        /// The wanted cut.
        at: RecordingInstant,
        /// The annotation's time.
        span: TimeSpan,
    },
    /// Two annotations to merge are not neighbours below one parent, the first before the second.
    #[error("{first} and {second} are not neighbours in this order on one tier below one parent; merge only such")]
    NotNeighbours {
        /// The first.
        first: AnnotationId,
        /// The second.
        second: AnnotationId,
    },
    /// Two annotations to merge have different values.
    #[error("{first} says {:?} and {second} says {:?}; give the value for the merged annotation", values.0.to_string(), values.1.to_string())]
    ValuesDiffer {
        /// The first.
        first: AnnotationId,
        /// The second.
        second: AnnotationId,
        /// Their values.
        values: Box<(ComponentReading, ComponentReading)>,
    },
    /// A time lies further than 2^62 microseconds from the start of the recording.
    #[error("{at} is too far from the start of the recording")]
    TooFar {
        /// The time.
        at: RecordingInstant,
    },
}

fn nearest_reach_text(nearest: &Option<(AnnotationId, TimeSpan)>) -> String {
    let text = |(id, span): &(AnnotationId, TimeSpan)| {
        format!(
            "; {id} there lasts from {} to {}",
            span.span_start_instant(),
            span.span_end_instant()
        )
    };
    nearest.as_ref().map(text).unwrap_or_default()
}
