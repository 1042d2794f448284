//! `span` and `trim`: cut a part out of the movement, or remove rest at its ends.

use std::ops::Range;

use chereme_motion::ends::{self, ClipEnds};
use chereme_motion::{Clip, RecordingInstant, TimeSpan};

use crate::error::StepError;
use crate::work::{JointGroup, WorkingClip};
use std::fmt::{self, Display, Formatter};

use chereme_sign::SignerHandedness;
use chereme_sign::words::InterfaceText;
use serde::{Deserialize, Serialize};

use super::described_operator;
use crate::answers::NodeAnswers;
use crate::check;
use crate::contact::{ContactEffect, ContactsToKeep};
use crate::error::RecipeError;
use crate::ops::{FieldSetting, OperatorDescription, OperatorField, OperatorSyntax, StepOperator, StepOutcome};
use crate::stroke::{between_rests, phase_frame_range};
use crate::text::{ParsedText, RecipeParser, write_separated_list};
use crate::units::RecipeSeconds;

/// Settings of `span 0.4s..1.9s`, `span 0.4s..`, `span ..1.9s`: the part of the movement to keep.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpanSettings {
    /// The time at which it begins; `None` for the first frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<RecipeSeconds>,
    /// The time at which it ends; `None` for the end of the last frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<RecipeSeconds>,
}

impl OperatorSyntax for SpanSettings {
    const OPERATOR_NAME: &'static str = "span";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "span",
        "part": "span 0.4s..1.9s",
        "all-from-time": "span 0.4s.."
    );

    fn parse_operator_text(parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        parse_movement_part(parser)
    }

    fn default_operator() -> Self {
        Self {
            from: Some(RecipeSeconds(0.2)),
            to: None,
        }
    }
}

/// Reads the two ends alone.
pub(crate) fn parse_movement_part(parser: &mut RecipeParser<'_>) -> ParsedText<SpanSettings> {
    let [from, to] = parser.parse_time_span()?;
    Ok(SpanSettings { from, to })
}

/// Checks the two ends of a part of a movement.
pub(crate) fn check_movement_part(step: &'static str, cut: &SpanSettings) -> Result<(), RecipeError> {
    check::check_step_time(step, "the start", cut.from, check::MAX_RECIPE_SECONDS)?;
    check::check_step_time(step, "the end", cut.to, check::MAX_RECIPE_SECONDS)?;
    let (from, to) = (cut.from.map_or(0.0, |time| time.0), cut.to.map(|time| time.0));
    if to.is_some_and(|to| to <= from) || (cut.from.is_none() && to.is_none()) {
        let what = "it ends before it begins; write the earlier time first, such as 0.4s..1.9s";
        return Err(RecipeError::Empty { step, what });
    }
    Ok(())
}

impl Display for SpanSettings {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "span {}", CutEnds(self))
    }
}

/// Prints the two ends alone: `0.4s..1.9s`.
pub(crate) struct CutEnds<'a>(pub(crate) &'a SpanSettings);

impl Display for CutEnds<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write_separated_list(f, self.0.from, "")?;
        f.write_str("..")?;
        write_separated_list(f, self.0.to, "")
    }
}

impl StepOperator for SpanSettings {
    fn check_operator_settings(&self) -> Result<(), RecipeError> {
        check_movement_part(Self::OPERATOR_NAME, self)
    }

    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        Ok(cut_work_span(work, self, given.text)?.into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        None
    }

    fn operator_form_fields(&mut self) -> Vec<FieldSetting<'_>> {
        let setting = |id, field| FieldSetting::new(InterfaceText::from_id(id), field);
        vec![
            setting("setting-from-time", OperatorField::Time(&mut self.from, 0.2)),
            setting("setting-to-time", OperatorField::Time(&mut self.to, 1.0)),
        ]
    }
}

/// The operator that removes rest at both ends; it has no settings.
pub(crate) struct Trim;

impl OperatorSyntax for Trim {
    const OPERATOR_NAME: &'static str = "trim";
    const OPERATOR_DESCRIPTION: OperatorDescription = described_operator!(
        "trim",
        "rest-odd-first": "trim"
    );

    fn parse_operator_text(_parser: &mut RecipeParser<'_>, _word: &str) -> ParsedText<Self> {
        Ok(Self)
    }

    fn default_operator() -> Self {
        Self
    }
}

impl Display for Trim {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(Self::OPERATOR_NAME)
    }
}

impl StepOperator for Trim {
    fn apply_operator(&self, work: &mut WorkingClip, given: &mut NodeAnswers<'_>) -> Result<StepOutcome, StepError> {
        Ok(trim_resting_ends(work, given.text)?.into())
    }

    fn contact_effect_for(&self, _handedness: SignerHandedness) -> Option<(ContactEffect, ContactsToKeep)> {
        None
    }
}

/// Keeps the frames that begin in a span.
pub(crate) fn cut_work_span(
    work: &mut WorkingClip,
    cut: &SpanSettings,
    operator: &str,
) -> Result<Vec<String>, StepError> {
    let frames = movement_part_frames(work, cut)?;
    let mut did = vec![describe_cut_frames(work, &frames)];
    // A span that is too long is understood, and said.
    let end = work.working_clip_end();
    if cut.to.is_some_and(|to| RecordingInstant::from_seconds(to.0) > end) {
        did.push(format!("the movement ends at {end}"));
    }
    keep_work_frames(work, frames, operator);
    Ok(did)
}

/// Returns the frames that begin in a part of the movement.
pub(crate) fn movement_part_frames(work: &WorkingClip, part: &SpanSettings) -> Result<Range<usize>, StepError> {
    let full_span = work.working_clip_span();
    let cut_instant = |seconds: f64| RecordingInstant::from_seconds(seconds);
    let from = part
        .from
        .map_or(full_span.span_start_instant(), |time| cut_instant(time.0));
    let to = part.to.map_or(full_span.span_end_instant(), |time| cut_instant(time.0));
    let length = full_span.span_seconds();
    let none = || StepError::Cut { length };
    let asked_span = TimeSpan::new(from, to.max(from)).map_err(|_| none())?;
    let wanted = asked_span.span_intersection(full_span).ok_or_else(none)?;
    let wanted_frames = work.rate.frames_in(wanted);
    let frames = wanted_frames.start..wanted_frames.end.min(work.frames);
    (!frames.is_empty()).then_some(frames).ok_or_else(none)
}

/// Keeps the active frames; a movement without rest stays unchanged.
pub(crate) fn trim_resting_ends(work: &mut WorkingClip, operator: &str) -> Result<Vec<String>, StepError> {
    let channels = work.channels.clone();
    let clip = Clip::new(work.skeleton.clone(), work.rate, channels)?;
    let odd = ClipEnds::examine_clip_ends(&clip, &work.anatomy);
    let moving = ends::activity_frames(&clip, &work.anatomy).unwrap_or(odd.sound.clone());
    let signed = phase_frame_range(work).map(|phases| between_rests(work, &moving, &phases));
    let active_frames = signed.map_or(moving.clone(), |signed| {
        moving.start.max(signed.start)..moving.end.min(signed.end)
    });
    let active = if active_frames.is_empty() {
        moving.clone()
    } else {
        active_frames
    };
    let mut did: Vec<String> = odd.odd.iter().map(|odd| format!("left out {odd}")).collect();
    if active == (0..work.frames) {
        did.push("the movement has no rest before or after it".to_owned());
        return Ok(did);
    }
    did.push(describe_cut_frames(work, &active));
    if active != moving {
        did.push("the movement from rest and back to it is left out: the phases of the sign are known".to_owned());
    }
    keep_work_frames(work, active, operator);
    Ok(did)
}

fn describe_cut_frames(work: &WorkingClip, frames: &Range<usize>) -> String {
    let kept = work.rate.frame_range_span(frames.clone());
    format!(
        "kept {} to {} of {}: frames {} to {}",
        kept.span_start_instant(),
        kept.span_end_instant(),
        work.working_clip_end(),
        frames.start,
        frames.end - 1
    )
}

fn keep_work_frames(work: &mut WorkingClip, frames: Range<usize>, operator: &str) {
    keep_quietly(work, frames);
    work.note_changed_groups(JointGroup::ALL_JOINT_GROUPS, operator);
}

/// Keeps some frames, without a word about it in the sources of the channels.
pub(crate) fn keep_quietly(work: &mut WorkingClip, frames: Range<usize>) {
    for channel in &mut work.channels {
        channel.rotations = channel.rotations[frames.clone()].to_vec();
        if let Some(places) = &mut channel.translations {
            *places = places[frames.clone()].to_vec();
        }
    }
    for curve in &mut work.curves {
        curve.values = curve.values[frames.clone()].to_vec();
    }
    let kept = work.rate.frame_range_span(frames.clone());
    let back = -kept.span_start_instant().instant_micros();
    work.notes.retain_mut(|note| {
        let kept_part = note.span.span_intersection(kept);
        let left = kept_part.filter(|span| span.span_micros() > 0);
        note.span = left.unwrap_or(kept).shifted_span(back);
        left.is_some()
    });
    work.frames = frames.len();
}
