//! Finds transitions in captured movement: strokes of wrists and changes of handshape.

use chereme_analysis::strokes::{MovingPart, find_transition_strokes, place_in};
use chereme_motion::Clip;
use chereme_motion::glam::DVec3;

use crate::capture::Capture;

/// A transition between two minima of speed.
pub(crate) struct Transition {
    /// The index of the capture.
    pub(crate) capture: usize,
    /// The transition alone: its frames, from the first posture to the last.
    pub(crate) clip: Clip,
    /// The joints that move in it.
    pub(crate) joints: Vec<usize>,
    /// The joints whose ends are compared; `base` is the joint in whose space they are compared.
    pub(crate) points: Vec<usize>,
    pub(crate) base: Option<usize>,
}

impl Transition {
    /// Returns whether the points follow a nearly straight path: their distance from start to end is at least seven
    /// tenths of its length.
    pub(crate) fn is_direct(&self) -> bool {
        let (mut along, mut across) = (0.0, 0.0);
        for &joint in &self.points {
            let path: Vec<DVec3> = (0..self.clip.clip_frame_count())
                .map(|frame| point(&self.clip, joint, self.base, frame))
                .collect();
            along += path.windows(2).map(|two| two[0].distance(two[1])).sum::<f64>();
            across += path[0].distance(path[path.len() - 1]);
        }
        across >= 0.7 * along
    }
}

/// Returns every transition of a kind in a capture.
pub(crate) fn find(number: usize, capture: &Capture, mover: MovingPart) -> Vec<Transition> {
    let mut found = Vec::new();
    let (clip, anatomy) = (&capture.clip, &capture.anatomy);
    let skeleton = clip.clip_skeleton();
    for side in capture.sides() {
        let Some(arm) = anatomy.arm_chain(side) else {
            continue;
        };
        let joints = mover.moving_joints(anatomy, side);
        let (points, base) = match mover {
            MovingPart::Wrist => {
                let top = arm.clavicle.unwrap_or(arm.upper);
                (vec![arm.hand], skeleton.joint_parent(top))
            }
            MovingPart::Fingers => {
                let is_end = |&joint: &usize| skeleton.joint_children(joint).is_empty();
                let ends = joints.iter().copied().filter(is_end).collect();
                (ends, Some(arm.hand))
            }
        };
        found.extend(
            find_transition_strokes(clip, anatomy, side, mover)
                .into_iter()
                .map(|frames| Transition {
                    capture: number,
                    clip: clip.slice_clip_frames(frames),
                    joints: joints.clone(),
                    points: points.clone(),
                    base,
                }),
        );
    }
    found
}

/// Returns the end of `joint` in the space of `base`, or of the model.
pub(crate) fn point(clip: &Clip, joint: usize, base: Option<usize>, frame: usize) -> DVec3 {
    let skeleton = clip.clip_skeleton();
    let tip = skeleton.joint_at(joint).tip;
    let is_end = skeleton.joint_children(joint).is_empty();
    let end = tip.filter(|_| is_end).unwrap_or(DVec3::ZERO);
    place_in(clip, joint, end, base, frame)
}

/// Returns speeds by central differences.
pub(crate) fn speeds<T>(path: &[T], per_second: f64, distance: impl Fn(&T, &T) -> f64) -> Vec<f64> {
    let last = path.len().saturating_sub(1);
    (0..path.len())
        .map(|n| {
            let (before, after) = (n.saturating_sub(1), (n + 1).min(last));
            let steps = (after - before).max(1) as f64;
            distance(&path[before], &path[after]) * per_second / steps
        })
        .collect()
}
