//! Transitions in movement: strokes of wrists and changes of handshape, between two minima of speed.

use std::ops::Range;

use chereme_motion::{BodyAnatomy, BodySide, Clip};
use glam::{DQuat, DVec3};

/// Standard deviation (s) of the Gaussian that smooths speeds before minima are searched.
const SPEED_SMOOTHING_SECONDS: f64 = 0.03;
/// Shortest duration of a transition: in seconds, and in frames.
const MIN_TRANSITION_DURATION: (f64, usize) = (0.1, 6);
/// A minimum counts if the speed falls below this share of the peaks on both sides.
const SPEED_DIP_SHARE: f64 = 0.8;
/// A speed below this share of the peak is rest: its first minimum ends the transition.
const REST_SPEED_SHARE: f64 = 0.1;
/// Least peak of speed (m/s) and least distance (m) of a stroke of the wrist.
const MIN_WRIST_STROKE: (f64, f64) = (0.15, 0.05);
/// Least peak of speed (rad/s, root of the mean square over the joints) and least rotation (rad, root of the sum of squares:
/// 20 degrees) of a change of handshape.
const MIN_SHAPE_CHANGE: (f64, f64) = (0.5, 0.349);

/// The body part that moves in a transition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MovingPart {
    /// The wrist, which goes from place to place. Found by its speed in the space of the trunk.
    Wrist,
    /// The fingers, which go from shape to shape. Found by the root of the mean square of their joints'
    /// angular speeds.
    Fingers,
}

impl MovingPart {
    /// Returns the joints that move in the transition, in the skeleton's order; empty if the skeleton
    /// lacks them.
    #[must_use]
    pub fn moving_joints(self, anatomy: &BodyAnatomy, side: BodySide) -> Vec<usize> {
        match self {
            Self::Wrist => anatomy.arm_joints(side),
            Self::Fingers => anatomy.finger_joints(side),
        }
    }
}

/// Returns the frames of every transition of one side, from its first posture up to and including its
/// last, in order of time.
///
/// A transition goes from one minimum of speed to the next and lasts a tenth of a second and six frames or
/// more; the wrist ends 5 cm or more from where it started, or the fingers are turned by 20 degrees or
/// more altogether. Speeds are smoothed over 30 ms first. Empty if the skeleton has no such arm or hand.
#[must_use]
pub fn find_transition_strokes(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    side: BodySide,
    mover: MovingPart,
) -> Vec<Range<usize>> {
    let joints = mover.moving_joints(anatomy, side);
    let Some(arm) = anatomy.arm_chain(side).filter(|_| !joints.is_empty()) else {
        return Vec::new();
    };
    let base = clip.clip_skeleton().joint_parent(arm.clavicle.unwrap_or(arm.upper));
    let path = match mover {
        MovingPart::Wrist => (0..clip.clip_frame_count())
            .map(|frame| place_in(clip, arm.hand, DVec3::ZERO, base, frame))
            .collect(),
        MovingPart::Fingers => Vec::new(),
    };
    let ((least, _), speeds) = match mover {
        MovingPart::Wrist => {
            let speeds = central_difference_speeds(path.len(), clip, |a, b| path[a].distance(path[b]));
            (MIN_WRIST_STROKE, speeds)
        }
        MovingPart::Fingers => {
            // The root of the sum of squares, divided by this, is the root of the mean square.
            let count = (joints.len() as f64).sqrt();
            let turned = |a, b| joint_rotation_between(clip, &joints, a, b) / count;
            (
                MIN_SHAPE_CHANGE,
                central_difference_speeds(clip.clip_frame_count(), clip, turned),
            )
        }
    };
    let far = |frames: &Range<usize>| {
        let (first, last) = (frames.start, frames.end - 1);
        match mover {
            MovingPart::Wrist => path[first].distance(path[last]) > MIN_WRIST_STROKE.1,
            MovingPart::Fingers => joint_rotation_between(clip, &joints, first, last) > MIN_SHAPE_CHANGE.1,
        }
    };
    let long = |frames: &Range<usize>| {
        frames.len() as f64 * clip.clip_frame_rate().frame_time() >= MIN_TRANSITION_DURATION.0
            && frames.len() >= MIN_TRANSITION_DURATION.1
    };
    let mut stroke_frames = between_minima(&gaussian_smoothed_speeds(&speeds, clip), least);
    stroke_frames.retain(|frames| long(frames) && far(frames));
    stroke_frames
}

/// Converts a point from the space of `joint` to that of `base`, a joint above it, or of the model.
#[must_use]
pub fn place_in(clip: &Clip, joint: usize, point: DVec3, base: Option<usize>, frame: usize) -> DVec3 {
    let above = clip.clip_skeleton().joint_ancestors(joint);
    above.take_while(|&joint| Some(joint) != base).fold(point, |at, joint| {
        clip.joint_translation(joint, frame) + clip.joint_channel(joint).rotations[frame] * at
    })
}

/// Returns the rotation of joints from one frame to another: the root of the sum of squares.
fn joint_rotation_between(clip: &Clip, joints: &[usize], from: usize, to: usize) -> f64 {
    let squares = joints.iter().map(|&joint| {
        let column: &[DQuat] = &clip.joint_channel(joint).rotations;
        column[from].angle_between(column[to]).powi(2)
    });
    squares.sum::<f64>().sqrt()
}

/// Returns speeds by central differences, given the distance between two frames.
pub(crate) fn central_difference_speeds(
    frames: usize,
    clip: &Clip,
    distance: impl Fn(usize, usize) -> f64,
) -> Vec<f64> {
    let last = frames.saturating_sub(1);
    (0..frames)
        .map(|n| {
            let (before, after) = (n.saturating_sub(1), (n + 1).min(last));
            let steps = (after - before).max(1) as f64;
            distance(before, after) * clip.clip_frame_rate().per_second() / steps
        })
        .collect()
}

/// Returns speeds smoothed by a Gaussian, so that noise adds no minima.
pub(crate) fn gaussian_smoothed_speeds(speeds: &[f64], clip: &Clip) -> Vec<f64> {
    let frame = clip.clip_frame_rate().frame_time();
    // Beyond three standard deviations the bell adds nothing that counts.
    let reach = ((3.0 * SPEED_SMOOTHING_SECONDS / frame).ceil() as usize).min(speeds.len());
    let bell: Vec<f64> = (0..=reach)
        .map(|away| (-0.5 * (away as f64 * frame / SPEED_SMOOTHING_SECONDS).powi(2)).exp())
        .collect();
    (0..speeds.len())
        .map(|n| {
            let near = n.saturating_sub(reach)..(n + reach + 1).min(speeds.len());
            // Near the ends the bell is cut off, so that its weights differ.
            let (mut sum, mut weights) = (0.0, 0.0);
            for m in near {
                let weight = bell[m.abs_diff(n)];
                sum += weight * speeds[m];
                weights += weight;
            }
            sum / weights
        })
        .collect()
}

/// Returns the stretches between two minima around each peak of at least `least`.
pub(crate) fn between_minima(speeds: &[f64], least: f64) -> Vec<Range<usize>> {
    let peak = |n: usize| {
        let (before, after) = (n.checked_sub(1).map(|m| speeds[m]), speeds.get(n + 1));
        // Of a plateau the first frame is the peak.
        speeds[n] >= least && before.is_none_or(|s| s < speeds[n]) && after.is_none_or(|s| *s <= speeds[n])
    };
    let mut frame_ranges: Vec<Range<usize>> = Vec::new();
    for top in (0..speeds.len()).filter(|&n| peak(n)) {
        let start = minimum(speeds, top, (0..top).rev());
        let end = minimum(speeds, top, top + 1..speeds.len());
        let (Some(start), Some(end)) = (start, end) else {
            continue;
        };
        // A higher peak between the two minima has the stretch as its own.
        let highest = speeds[start..=end].iter().all(|&speed| speed <= speeds[top]);
        if highest && frame_ranges.last().is_none_or(|last| last.start != start) {
            frame_ranges.push(start..end + 1);
        }
    }
    frame_ranges
}

/// Searches from a peak for the minimum that ends its transition; `None` if the speed first rises above
/// the peak, or the movement ends without falling far enough.
fn minimum(speeds: &[f64], top: usize, frames: impl Iterator<Item = usize>) -> Option<usize> {
    let mut lowest = top;
    for n in frames {
        if speeds[n] < speeds[lowest] {
            lowest = n;
        } else if speeds[lowest] < REST_SPEED_SHARE * speeds[top] || speeds[n] * SPEED_DIP_SHARE > speeds[lowest] {
            break;
        }
        if speeds[n] > speeds[top] {
            return None;
        }
    }
    (speeds[lowest] < SPEED_DIP_SHARE * speeds[top]).then_some(lowest)
}

#[cfg(test)]
pub(crate) mod tests;
