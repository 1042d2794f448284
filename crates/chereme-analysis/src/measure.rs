//! Measures the size and duration of movements whose kind is already annotated: the data of a signer's
//! body language.

use std::ops::Range;

use chereme_motion::{BodyAnatomy, BodySide, Clip};
use glam::{DQuat, DVec3};

use crate::strokes::{
    MovingPart, between_minima, central_difference_speeds, find_transition_strokes, gaussian_smoothed_speeds, place_in,
};
use crate::transcribe::transcribe_path::{self, PathForm};

/// The least peak of speed of a stroke, in metres per second: small strokes are slow.
const MIN_STROKE_PEAK_SPEED: f64 = 0.05;
/// A stroke shorter than this share of the longest stroke next to it is not counted: the hand comes to
/// rest.
const MIN_NEIGHBOUR_STROKE_SHARE: f64 = 1.0 / 3.0;
/// A speed below this share of the peak is a hold.
const HOLD_SPEED_SHARE: f64 = 0.1;
/// At least this share of a stroke must be inside the given stretch.
const MIN_INSIDE_SHARE: f64 = 2.0 / 3.0;

/// The kind of movement to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredKind {
    /// The wrist goes from place to place, straight or curved.
    Stroke,
    /// The wrist moves in a circle.
    Round,
    /// The wrist moves to and fro across its path.
    Wave,
    /// The fingers go from shape to shape.
    Shape,
    /// The hand moves from the end of one movement to the start of another.
    Transition,
}

/// The measurements of one movement.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MeasuredStroke {
    /// Its duration in seconds; of a [`MeasuredKind::Round`] that of one turn.
    pub seconds: f64,
    /// Distance from start to end, in metres; zero for circles.
    pub length: f64,
    /// Depth of the bulge relative to the length; for a wave half its width in metres.
    pub depth: f64,
    /// The radius of a circle in metres: the mean of the longer and the shorter one.
    pub radius: f64,
    /// Rotation of the hand relative to the trunk from start to end, in radians.
    pub turn: f64,
    /// The number of strokes of about the same size; only the first one is measured.
    pub strokes: usize,
}

/// Measures the movement of one hand that lies in `within`; the frames around it show where strokes
/// begin and end.
///
/// A stroke lies between two minima of the wrist's speed; if the stretch has several, the first one is
/// measured, so that repetitions and return movements do not count. Circling and waving movements are
/// measured over the stretch without the holds at its ends, a transition over the stretch itself. Lengths
/// are those of the wrist in the space of the trunk. `None` if the skeleton has no such hand, or the
/// movement is not of that kind.
#[must_use]
pub fn measure_hand_movement(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    side: BodySide,
    within: Range<usize>,
    kind: MeasuredKind,
) -> Option<MeasuredStroke> {
    let within = within.start..within.end.min(clip.clip_frame_count());
    let arm = anatomy.arm_chain(side)?;
    let base = clip.clip_skeleton().joint_parent(arm.clavicle.unwrap_or(arm.upper));
    let wrist = |frame: usize| place_in(clip, arm.hand, DVec3::ZERO, base, frame);
    if within.len() < 3 {
        return None;
    }
    let within = match kind {
        MeasuredKind::Round | MeasuredKind::Wave => trim_movement_holds(clip, wrist, within),
        _ => within,
    };
    let path = || -> Vec<DVec3> { within.clone().map(wrist).collect() };
    let duration = within.len() as f64 * clip.clip_frame_rate().frame_time();
    match kind {
        MeasuredKind::Stroke => measure_wrist_stroke(clip, wrist, &within),
        MeasuredKind::Shape => {
            let finger_strokes = find_transition_strokes(clip, anatomy, side, MovingPart::Fingers);
            let mut inside = finger_strokes.iter().filter(|frames| is_stroke_inside(frames, &within));
            let first = inside.next()?;
            // Frames stand at both ends of a stroke, so that it lasts one interval less than its frames.
            Some(MeasuredStroke {
                seconds: (first.len() - 1) as f64 * clip.clip_frame_rate().frame_time(),
                strokes: 1 + inside.count(),
                ..MeasuredStroke::default()
            })
        }
        MeasuredKind::Round => {
            match transcribe_path::fit_path_form(&path(), transcribe_path::synthesised_path_error()).path {
                PathForm::Circle {
                    turns, long, narrow, ..
                } => Some(MeasuredStroke {
                    seconds: duration / turns,
                    radius: long.length() * (1.0 + narrow) / 2.0,
                    strokes: 1,
                    ..MeasuredStroke::default()
                }),
                _ => None,
            }
        }
        MeasuredKind::Wave => {
            match transcribe_path::fit_path_form(&path(), transcribe_path::synthesised_path_error()).path {
                PathForm::Wave { chord, width, .. } => Some(MeasuredStroke {
                    seconds: duration,
                    length: chord.length(),
                    depth: width,
                    strokes: 1,
                    ..MeasuredStroke::default()
                }),
                _ => None,
            }
        }
        MeasuredKind::Transition => {
            let (first, last) = (within.start, within.end - 1);
            let turned = |frame| turned_in(clip, arm.hand, base, frame);
            Some(MeasuredStroke {
                seconds: duration,
                length: wrist(first).distance(wrist(last)),
                turn: turned(first).angle_between(turned(last)),
                strokes: 1,
                ..MeasuredStroke::default()
            })
        }
    }
}

fn measure_wrist_stroke(clip: &Clip, wrist: impl Fn(usize) -> DVec3, within: &Range<usize>) -> Option<MeasuredStroke> {
    let all: Vec<DVec3> = (0..clip.clip_frame_count()).map(wrist).collect();
    let raw = central_difference_speeds(all.len(), clip, |a, b| all[a].distance(all[b]));
    let mut stroke_frames = between_minima(&gaussian_smoothed_speeds(&raw, clip), MIN_STROKE_PEAK_SPEED);
    stroke_frames.retain(|frames| frames.len() > 2 && is_stroke_inside(frames, within));
    let long = |frames: &Range<usize>| all[frames.start].distance(all[frames.end - 1]);
    let longest = stroke_frames.iter().map(long).fold(0.0, f64::max);
    stroke_frames.retain(|frames| long(frames) >= MIN_NEIGHBOUR_STROKE_SHARE * longest);
    let first = stroke_frames.first()?;
    let points = &all[first.clone()];
    let chord = points[points.len() - 1] - points[0];
    let length = chord.length();
    if length <= 0.0 {
        return None;
    }
    // Of 49 points the 25th is the middle of the path.
    let even = transcribe_path::evenly_spaced_points(points, 49);
    let bow = (even[24] - points[0] - chord / 2.0).reject_from_normalized(chord / length);
    Some(MeasuredStroke {
        seconds: (first.len() - 1) as f64 * clip.clip_frame_rate().frame_time(),
        length,
        depth: bow.length() / length,
        strokes: stroke_frames.len(),
        ..MeasuredStroke::default()
    })
}

/// Returns a stretch without the holds at its beginning and its end.
fn trim_movement_holds(clip: &Clip, wrist: impl Fn(usize) -> DVec3, within: Range<usize>) -> Range<usize> {
    let all: Vec<DVec3> = (0..clip.clip_frame_count()).map(wrist).collect();
    let raw = central_difference_speeds(all.len(), clip, |a, b| all[a].distance(all[b]));
    let speeds = gaussian_smoothed_speeds(&raw, clip);
    let peak = speeds[within.clone()].iter().copied().fold(0.0, f64::max);
    let moves = |frame: &usize| speeds[*frame] >= HOLD_SPEED_SHARE * peak;
    match (within.clone().find(moves), within.clone().rfind(moves)) {
        (Some(first), Some(last)) => first..last + 1,
        _ => within,
    }
}

fn is_stroke_inside(frames: &Range<usize>, within: &Range<usize>) -> bool {
    let shared = frames
        .end
        .min(within.end)
        .saturating_sub(frames.start.max(within.start));
    shared as f64 >= MIN_INSIDE_SHARE * frames.len() as f64
}

/// Returns the rotation of a joint in the space of `base`, a joint above it, or of the model.
fn turned_in(clip: &Clip, joint: usize, base: Option<usize>, frame: usize) -> DQuat {
    let above = clip.clip_skeleton().joint_ancestors(joint);
    above
        .take_while(|&joint| Some(joint) != base)
        .fold(DQuat::IDENTITY, |turned, joint| {
            clip.joint_channel(joint).rotations[frame] * turned
        })
}
