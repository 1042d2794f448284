//! The stroke of a sign: the frames that operators change. The rest before and after it stays where it is.

use std::ops::Range;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, TimeSpan, ends};
use chereme_sign::SignComponent;

use crate::error::StepError;
use crate::outcome::NoteSubject;
use crate::work::WorkingClip;

/// The time in which an operator sets in after a rest, and ends before one, in seconds: a hand needs half a second to
/// rise. At most a quarter of the movement between the rests.
const STROKE_ONSET: f64 = 0.4;

/// The frames in which operators have their full effect, and those in which it sets in and ends.
#[derive(Debug, Clone)]
pub(crate) struct SignStroke {
    /// The frames of the full effect; never empty.
    pub(crate) frames: Range<usize>,
    /// The frames of any effect, which end where the rests begin.
    moving: Range<usize>,
}

impl SignStroke {
    /// Finds the stroke of a movement: what `trim` keeps, without the way from rest and back to it.
    pub(crate) fn of_work(work: &WorkingClip) -> Result<Self, StepError> {
        let clip = Clip::new(work.skeleton.clone(), work.rate, work.channels.clone())?;
        let all = 0..work.frames;
        let moving = ends::activity_frames(&clip, &work.anatomy).unwrap_or(all.clone());
        let signed = signed_frame_range(work)?;
        let onset_frames = (STROKE_ONSET / work.rate.frame_time()).round() as usize;
        let onset = onset_frames.min(moving.len() / 4);
        // Known phases begin where the hand has risen; otherwise it rises for a while.
        let start = match moving.start {
            0 => 0,
            rest if signed.start > rest => signed.start,
            rest => rest + onset,
        };
        let end = match moving.end {
            end if end == all.end => end,
            rest if signed.end < rest => signed.end,
            rest => rest - onset,
        };
        let frames = if start < end { start..end } else { moving.clone() };
        Ok(Self { frames, moving })
    }

    /// Returns the share of an operator's effect at a frame: 1 in the stroke, 0 at rest.
    pub(crate) fn effect_share(&self, frame: usize) -> f64 {
        let eased = |from: usize, to: usize| {
            let w = (from.abs_diff(frame) as f64 / from.abs_diff(to) as f64).clamp(0.0, 1.0);
            w * w * w * (10.0 + w * (6.0 * w - 15.0))
        };
        if self.frames.contains(&frame) {
            1.0
        } else if !self.moving.contains(&frame) {
            0.0
        } else if frame < self.frames.start {
            eased(self.moving.start, self.frames.start)
        } else {
            eased(self.moving.end, self.frames.end)
        }
    }

    /// Returns the frame of the stroke that is nearest to a frame.
    pub(crate) fn nearest_frame(&self, frame: usize) -> usize {
        frame.clamp(self.frames.start, self.frames.end - 1)
    }

    /// Returns the frame in its middle.
    pub(crate) fn middle_frame(&self) -> usize {
        (self.frames.start + self.frames.end) / 2
    }

    /// Returns a point on its way to a target, as far as the effect goes at a frame.
    pub(crate) fn point_between(&self, frame: usize, from: DVec3, to: DVec3) -> DVec3 {
        match self.effect_share(frame) {
            1.0 => to,
            share => from + (to - from) * share,
        }
    }

    /// Returns a rotation as far as the effect goes at a frame.
    pub(crate) fn turn_share(&self, frame: usize, turn: DQuat) -> DQuat {
        match self.effect_share(frame) {
            1.0 => turn,
            share => DQuat::IDENTITY.slerp(turn, share),
        }
    }

    /// Returns the time from its first frame to its last, in seconds.
    pub(crate) fn stroke_seconds(&self, work: &WorkingClip) -> f64 {
        self.frames.len().saturating_sub(1).max(1) as f64 * work.rate.frame_time()
    }

    /// Describes the rests that stay as they are.
    pub(crate) fn describe_rests(&self, work: &WorkingClip) -> Option<String> {
        let (start, end) = (self.moving.start, self.moving.end);
        let [before, after] = [start, end].map(|frame| work.rate.frame_start_instant(frame));
        match (start > 0, end < work.frames) {
            (false, false) => None,
            (true, false) => Some(format!("the rest before {before} stays as it is")),
            (false, true) => Some(format!("the rest after {after} stays as it is")),
            (true, true) => Some(format!("the rest before {before} and after {after} stays as it is")),
        }
    }
}

/// Returns the frames of a sign without the movement from rest to its first phase, and from its last one back to rest:
/// only an end with rest whose phases are known is cut.
pub(crate) fn signed_frame_range(work: &WorkingClip) -> Result<Range<usize>, StepError> {
    let all = 0..work.frames;
    let Some(phases) = phase_frame_range(work) else {
        return Ok(all);
    };
    let channels = work.channels.clone();
    let clip = Clip::new(work.skeleton.clone(), work.rate, channels)?;
    let active = ends::activity_frames(&clip, &work.anatomy).unwrap_or(all);
    Ok(between_rests(work, &active, &phases))
}

/// Returns the frames from the first phase of a hand to the end of the last one; `None` if no phase is known.
pub(crate) fn phase_frame_range(work: &WorkingClip) -> Option<Range<usize>> {
    let about = NoteSubject::Component(SignComponent::Movement, Some("phase".to_owned()));
    let notes = work.notes.iter().filter(|note| note.about == about);
    let spans: Vec<TimeSpan> = notes.map(|note| note.span).collect();
    let from = spans.iter().map(|span| span.span_start_instant()).min()?;
    let to = spans.iter().map(|span| span.span_end_instant()).max()?;
    let phase_frames = work.rate.frames_in(TimeSpan::new(from, to).ok()?);
    let frames = phase_frames.start.min(work.frames)..phase_frames.end.min(work.frames);
    (!frames.is_empty()).then_some(frames)
}

/// Returns the frames of the phases at each end that has rest, and all frames at the other.
pub(crate) fn between_rests(work: &WorkingClip, active: &Range<usize>, phases: &Range<usize>) -> Range<usize> {
    let rests = (active.start > 0, active.end < work.frames);
    let start = if rests.0 { phases.start } else { 0 };
    let end = if rests.1 { phases.end } else { work.frames };
    start..end
}
