//! `retime`: makes movement faster or slower, as a whole or phase by phase.

use chereme_motion::{BodySide, RecordingInstant, TimeSpan};
use chereme_sign::SignComponent;
use chereme_sign::words::InterfaceText;

use crate::error::StepError;
use crate::ops::{OperatorDescription, component_notes, join};
use crate::outcome::NoteSubject;
use crate::work::{JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::NodeAnswers;
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::{OperatorSyntax, StepOperator, StepOutcome};
use crate::text::{ParsedText, RecipeParser, RecipeTokenKind, write_separated_list};
use crate::units::{RecipeFactor, RecipeSeconds};

/// Settings of `retime 150%`, `retime to 2s`, `retime 100%, 50%, to 1s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RetimeSettings {
    /// One pace for the whole sign, or one for each of its successive phases.
    pub paces: Vec<RetimePace>,
}

/// A new length of time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum RetimePace {
    /// The factor on the old length: 2 makes it twice as long.
    Times(RecipeFactor),
    /// The length itself.
    To(RecipeSeconds),
}

impl OperatorSyntax for RetimeSettings {
    const OPERATOR_NAME: &'static str = "retime";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "retime",
        "slower-half-long": "retime 150%",
        "slow-fast-time": "retime to 2s",
        "phase-by-phase": "retime 1, 50%, to 0.3s"
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        let mut paces = Vec::new();
        loop {
            paces.push(if parser.accept_word("to") {
                RetimePace::To(parser.parse_quantity("a time, such as 2s")?)
            } else {
                RetimePace::Times(parser.parse_quantity("a factor, such as 150%, or \"to\" and a time")?)
            });
            if !parser.accept_kind(RecipeTokenKind::Comma) {
                return Ok(Self { paces });
            }
        }
    }

    fn default_operator() -> Self {
        Self {
            paces: vec![RetimePace::Times(RecipeFactor(1.5))],
        }
    }
}

impl Display for RetimeSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("retime ")?;
        write_separated_list(f, &self.paces, ", ")
    }
}

impl Display for RetimePace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Times(factor) => write!(f, "{factor}"),
            Self::To(seconds) => write!(f, "to {seconds}"),
        }
    }
}

impl StepOperator for RetimeSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        check::check_filled_list(Self::OPERATOR_NAME, &self.paces, "no pace is given")?;
        self.paces.iter().try_for_each(|pace| match *pace {
            RetimePace::Times(by) => check::check_step_range(Self::OPERATOR_NAME, "the factor", by.0, 0.05, 20.0),
            RetimePace::To(time) => check::check_step_range(Self::OPERATOR_NAME, "the time", time.0, 0.01, 600.0),
        })
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        Ok(retime_movement(work, &self.paces, given.text)?.into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        Some((ContactEffect::Anytime, ContactsToKeep::None))
    }

    fn is_nothing(&self) -> bool {
        self.paces == [RetimePace::Times(RecipeFactor(1.0))]
    }
}

/// Changes the length of the movement, or of each of its phases.
///
/// Phases begin and end with the dominant hand's movements, else with its placements, else with its configurations,
/// whichever of these are annotated.
pub(crate) fn retime_movement(
    work: &mut WorkingClip,
    paces: &[RetimePace],
    operator: &str,
) -> Result<Vec<String>, StepError> {
    let bounds = match paces {
        [_] => vec![0, work.frames],
        _ => phase_boundary_frames(work),
    };
    let count = bounds.len() - 1;
    if paces.len() != count {
        return Err(StepError::Phases {
            given: paces.len(),
            phases: count,
        });
    }
    let mut did = Vec::new();
    let mut new = vec![0.0];
    for (pair, pace) in bounds.windows(2).zip(paces) {
        let frames = (pair[1] - pair[0]) as f64;
        let length = match *pace {
            RetimePace::Times(factor) => frames * factor.0,
            RetimePace::To(seconds) => seconds.0 / work.rate.frame_time(),
        };
        did.push(format!(
            "{:.2} s became {:.2} s",
            frames * work.rate.frame_time(),
            length * work.rate.frame_time()
        ));
        new.push(new[new.len() - 1] + length);
    }
    let map = FrameMap {
        old: bounds.iter().map(|&bound| bound as f64).collect(),
        new,
    };
    let other = map.new.last() != map.old.last();
    warp(work, &map)?;
    // Another length belies a written manner, such as a fast one.
    if other {
        component_notes::withdraw_hand_notes(work, &BodySide::BOTH_SIDES, operator, |component, feature| {
            component == SignComponent::Movement && feature == Some("manner")
        });
    }
    work.note_changed_groups(JointGroup::ALL_JOINT_GROUPS, operator);
    Ok(did)
}

/// Makes the movement `factor` times as long.
pub(crate) fn stretch_movement(work: &mut WorkingClip, factor: f64) -> Result<(), StepError> {
    let frames = work.frames as f64;
    warp(
        work,
        &FrameMap {
            old: vec![0.0, frames],
            new: vec![0.0, frames * factor],
        },
    )
}

/// A piecewise linear map between old and new frames.
struct FrameMap {
    old: Vec<f64>,
    new: Vec<f64>,
}

fn map_frame_through(from: &[f64], to: &[f64], at: f64) -> f64 {
    // Beyond either end its outermost piece goes on.
    let n = from.partition_point(|&bound| bound <= at).clamp(1, from.len() - 1);
    let (a, b) = (from[n - 1], from[n]);
    let share = if b > a { (at - a) / (b - a) } else { 0.0 };
    to[n - 1] + (to[n] - to[n - 1]) * share
}

fn warp(work: &mut WorkingClip, map: &FrameMap) -> Result<(), StepError> {
    let frames = map.new.last().copied().unwrap_or(0.0).round().max(1.0) as usize;
    join::check_length(work, frames)?;
    let same = map.old == map.new;
    if same {
        return Ok(());
    }
    // Frame n covers the time from n to n + 1: middles map to middles.
    let sample_positions: Vec<f64> = (0..frames)
        .map(|frame| map_frame_through(&map.new, &map.old, frame as f64 + 0.5) - 0.5)
        .collect();
    work.resample_channels(&sample_positions);
    let rate = work.rate.per_second();
    let moved = |instant: RecordingInstant| {
        RecordingInstant::from_seconds(map_frame_through(&map.old, &map.new, instant.instant_seconds() * rate) / rate)
    };
    let end = work.working_clip_end();
    for note in &mut work.notes {
        // The rounded length may be shorter than the mapped one.
        let (start, stop) = (
            moved(note.span.span_start_instant()).min(end),
            moved(note.span.span_end_instant()).min(end),
        );
        note.span = TimeSpan::span_between(start, stop);
    }
    Ok(())
}

/// Returns the frames at which phases begin, and the last one ends.
fn phase_boundary_frames(work: &WorkingClip) -> Vec<usize> {
    let dominant = work.handedness.signer_dominant_side();
    let sides: [BodySide; 2] = [dominant, dominant.opposite_side()];
    let components = [
        SignComponent::Movement,
        SignComponent::Placement,
        SignComponent::Configuration,
    ];
    // The dominant hand leads, and its movement says more of phases than its shape.
    let phase_notes = sides.into_iter().find_map(|side| {
        components.into_iter().find_map(|component| {
            let about = NoteSubject::Component(component, None);
            let spans: Vec<TimeSpan> = work
                .notes
                .iter()
                .filter(|note| note.hand == Some(side) && note.about == about)
                .map(|note| note.span)
                .collect();
            (!spans.is_empty()).then_some(spans)
        })
    });
    let mut bounds = vec![0, work.frames];
    for span in phase_notes.into_iter().flatten() {
        bounds.extend([
            work.rate.nearest_frame_at(span.span_start_instant()),
            work.rate.nearest_frame_at(span.span_end_instant()),
        ]);
    }
    bounds.retain(|&bound| bound <= work.frames);
    bounds.sort_unstable();
    bounds.dedup();
    bounds
}
