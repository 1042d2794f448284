//! `reverse`: plays the movement backwards; applied twice, it changes nothing.

use chereme_motion::TimeSpan;
use chereme_sign::ComponentReading;
use chereme_sign::words::InterfaceText;

use crate::ops::component_notes;
use crate::outcome::NoteSubject;
use crate::work::{JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;

use super::described_operator;
use crate::answers::NodeAnswers;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::StepError;
use crate::ops::{OperatorDescription, OperatorNeighbours, OperatorSyntax, Step, StepOperator, StepOutcome};
use crate::text::{ParsedText, RecipeParser};

/// The operator; it has no settings.
pub(crate) struct Reverse;

impl OperatorSyntax for Reverse {
    const OPERATOR_NAME: &'static str = "reverse";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "reverse",
        "backwards": "reverse"
    );

    fn parse_operator_text(_parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        Ok(Self)
    }

    fn default_operator() -> Self {
        Self
    }
}

impl Display for Reverse {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::OPERATOR_NAME)
    }
}

impl StepOperator for Reverse {
    fn apply_operator(&self, work: &mut WorkingClip, _given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        Ok(reverse_movement(work).into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        None
    }

    fn relation_to_previous(&self, before: &mut Step) -> OperatorNeighbours {
        match before {
            Step::Reverse => OperatorNeighbours::Nothing,
            _ => OperatorNeighbours::Apart,
        }
    }
}

/// Plays all channels backwards; returns cautions about the result.
pub(crate) fn reverse_movement(work: &mut WorkingClip) -> Vec<String> {
    for channel in &mut work.channels {
        channel.rotations.reverse();
        if let Some(places) = &mut channel.translations {
            places.reverse();
        }
    }
    for curve in &mut work.curves {
        curve.values.reverse();
    }
    let end = work.working_clip_end().instant_micros();
    let mut did = vec![format!("{} frames played backwards", work.frames)];
    for note in &mut work.notes {
        let span = note.span;
        note.span = TimeSpan::span_between(span.span_end_instant(), span.span_start_instant()).mirror_in_time(end);
        let (NoteSubject::Component(component, feature), Some(value)) = (&note.about, note.value.reading_value())
        else {
            continue;
        };
        match component_notes::backwards_value(*component, feature.as_deref(), value) {
            // Most values are the same both ways.
            Some(other) if other == value => {}
            Some(other) => note.value = ComponentReading::Value(other),
            None => {
                did.push(format!(
                    "{component} {value:?} is no longer written: it runs the other way"
                ));
                note.value = ComponentReading::Unset;
            }
        }
    }
    work.notes.sort_by_key(|note| note.span.span_start_instant());
    work.note_changed_groups(JointGroup::ALL_JOINT_GROUPS, "reverse");
    did
}

trait MirroredInTime {
    fn mirror_in_time(self, end: i64) -> Self;
}

impl MirroredInTime for TimeSpan {
    /// Returns the mirror image of the span in a movement that ends at `end` microseconds.
    fn mirror_in_time(self, end: i64) -> Self {
        let mirrored_instant = |instant: chereme_motion::RecordingInstant| {
            chereme_motion::RecordingInstant::from_micros(end.saturating_sub(instant.instant_micros()))
        };
        Self::span_between(
            mirrored_instant(self.span_end_instant()),
            mirrored_instant(self.span_start_instant()),
        )
    }
}
