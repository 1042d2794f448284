//! Measures the size and duration of movements whose kind is already annotated: the data of a signer's
//! body language.

use std::ops::Range;

use chereme_motion::{Anatomy, Clip, Side};
use glam::{DQuat, DVec3};

use crate::strokes::{Mover, between_minima, place_in, smoothed, speeds, strokes};
use crate::transcribe::path::{self, PathForm};

/// The least peak of speed of a stroke, in metres per second: small strokes are slow.
const LEAST: f64 = 0.05;
/// A stroke shorter than this share of the longest stroke next to it is not counted: the hand comes to
/// rest.
const AMONG: f64 = 1.0 / 3.0;
/// A speed below this share of the peak is a hold.
const STILL: f64 = 0.1;
/// At least this share of a stroke must be inside the given stretch.
const INSIDE: f64 = 2.0 / 3.0;

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
pub struct Measured {
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
pub fn measure(
    clip: &Clip,
    anatomy: &Anatomy,
    side: Side,
    within: Range<usize>,
    kind: MeasuredKind,
) -> Option<Measured> {
    let within = within.start..within.end.min(clip.frames());
    let arm = anatomy.arm(side)?;
    let base = clip.skeleton().parent(arm.clavicle.unwrap_or(arm.upper));
    let wrist = |frame: usize| place_in(clip, arm.hand, DVec3::ZERO, base, frame);
    if within.len() < 3 {
        return None;
    }
    let within = match kind {
        MeasuredKind::Round | MeasuredKind::Wave => moving(clip, wrist, within),
        _ => within,
    };
    let path = || -> Vec<DVec3> { within.clone().map(wrist).collect() };
    let whole = within.len() as f64 * clip.rate().frame_time();
    match kind {
        MeasuredKind::Stroke => stroke(clip, wrist, &within),
        MeasuredKind::Shape => {
            let found = strokes(clip, anatomy, side, Mover::Fingers);
            let mut inside = found.iter().filter(|frames| is_inside(frames, &within));
            let first = inside.next()?;
            Some(Measured {
                seconds: (first.len() - 1) as f64 * clip.rate().frame_time(),
                strokes: 1 + inside.count(),
                ..Measured::default()
            })
        }
        MeasuredKind::Round => match path::fit(&path(), path::exact()).path {
            PathForm::Circle {
                turns,
                long,
                narrow,
                ..
            } => Some(Measured {
                seconds: whole / turns,
                radius: long.length() * (1.0 + narrow) / 2.0,
                strokes: 1,
                ..Measured::default()
            }),
            _ => None,
        },
        MeasuredKind::Wave => match path::fit(&path(), path::exact()).path {
            PathForm::Wave { chord, width, .. } => Some(Measured {
                seconds: whole,
                length: chord.length(),
                depth: width,
                strokes: 1,
                ..Measured::default()
            }),
            _ => None,
        },
        MeasuredKind::Transition => {
            let (first, last) = (within.start, within.end - 1);
            let turned = |frame| turned_in(clip, arm.hand, base, frame);
            Some(Measured {
                seconds: whole,
                length: wrist(first).distance(wrist(last)),
                turn: turned(first).angle_between(turned(last)),
                strokes: 1,
                ..Measured::default()
            })
        }
    }
}

fn stroke(clip: &Clip, wrist: impl Fn(usize) -> DVec3, within: &Range<usize>) -> Option<Measured> {
    let all: Vec<DVec3> = (0..clip.frames()).map(wrist).collect();
    let raw = speeds(all.len(), clip, |a, b| all[a].distance(all[b]));
    let mut found = between_minima(&smoothed(&raw, clip), LEAST);
    found.retain(|frames| frames.len() > 2 && is_inside(frames, within));
    let long = |frames: &Range<usize>| all[frames.start].distance(all[frames.end - 1]);
    let longest = found.iter().map(long).fold(0.0, f64::max);
    found.retain(|frames| long(frames) >= AMONG * longest);
    let first = found.first()?;
    let points = &all[first.clone()];
    let chord = points[points.len() - 1] - points[0];
    let length = chord.length();
    if length <= 0.0 {
        return None;
    }
    let even = path::evenly(points, 49);
    let bow = (even[24] - points[0] - chord / 2.0).reject_from_normalized(chord / length);
    Some(Measured {
        seconds: (first.len() - 1) as f64 * clip.rate().frame_time(),
        length,
        depth: bow.length() / length,
        strokes: found.len(),
        ..Measured::default()
    })
}

/// Returns a stretch without the holds at its beginning and its end.
fn moving(clip: &Clip, wrist: impl Fn(usize) -> DVec3, within: Range<usize>) -> Range<usize> {
    let all: Vec<DVec3> = (0..clip.frames()).map(wrist).collect();
    let raw = speeds(all.len(), clip, |a, b| all[a].distance(all[b]));
    let speeds = smoothed(&raw, clip);
    let peak = speeds[within.clone()].iter().copied().fold(0.0, f64::max);
    let moves = |frame: &usize| speeds[*frame] >= STILL * peak;
    match (within.clone().find(moves), within.clone().rfind(moves)) {
        (Some(first), Some(last)) => first..last + 1,
        _ => within,
    }
}

fn is_inside(frames: &Range<usize>, within: &Range<usize>) -> bool {
    let shared = frames
        .end
        .min(within.end)
        .saturating_sub(frames.start.max(within.start));
    shared as f64 >= INSIDE * frames.len() as f64
}

/// Returns the rotation of a joint in the space of `base`, a joint above it, or of the model.
fn turned_in(clip: &Clip, joint: usize, base: Option<usize>, frame: usize) -> DQuat {
    let above = clip.skeleton().ancestors(joint);
    above
        .take_while(|&joint| Some(joint) != base)
        .fold(DQuat::IDENTITY, |turned, joint| {
            clip.channel(joint).rotations[frame] * turned
        })
}
