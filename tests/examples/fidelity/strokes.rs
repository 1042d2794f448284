//! Transitions in captured movement: strokes of wrists and changes of handshape.

use std::ops::Range;

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, Side};

use crate::capture::Capture;

/// The deviation of the Gauss curve that speeds are smoothed by before minima are looked for, in
/// seconds.
const SMOOTH: f64 = 0.03;
/// The least time of a transition in seconds, and its least frames.
const LEAST: (f64, usize) = (0.1, 6);
/// A minimum counts where the speed falls below this share of the peaks on both of its sides.
const DIP: f64 = 0.8;
/// A speed below this share of the peak is rest: its first minimum ends the transition.
const REST: f64 = 0.1;

/// What makes a transition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// The wrist goes from place to place, told by its speed in the space of the trunk.
    Stroke,
    /// The fingers go from shape to shape, told by the root of the mean square of their joints'
    /// angular speeds.
    Handshape,
}

/// A transition between two minima of speed.
pub(crate) struct Transition {
    /// Which capture.
    pub(crate) capture: usize,
    /// The transition alone: its frames, from the first posture to the last.
    pub(crate) clip: Clip,
    /// The joints that make it.
    pub(crate) joints: Vec<usize>,
    /// The joints whose ends are compared, and the joint in whose space they are.
    pub(crate) points: Vec<usize>,
    pub(crate) base: Option<usize>,
}

impl Transition {
    /// Tells whether the points go rather straight: their distance from start to end is at least
    /// seven tenths of the length of their way.
    pub(crate) fn is_direct(&self) -> bool {
        let (mut along, mut across) = (0.0, 0.0);
        for &joint in &self.points {
            let path: Vec<DVec3> = (0..self.clip.frames())
                .map(|frame| point(&self.clip, joint, self.base, frame))
                .collect();
            along += path
                .windows(2)
                .map(|two| two[0].distance(two[1]))
                .sum::<f64>();
            across += path[0].distance(path[path.len() - 1]);
        }
        across >= 0.7 * along
    }
}

/// Returns every transition of a kind in a capture.
pub(crate) fn find(number: usize, capture: &Capture, kind: Kind) -> Vec<Transition> {
    let mut found = Vec::new();
    let (clip, anatomy) = (&capture.clip, &capture.anatomy);
    let skeleton = clip.skeleton();
    for side in capture.sides() {
        let Some(arm) = anatomy.arm(side) else {
            continue;
        };
        let top = arm.clavicle.unwrap_or(arm.upper);
        let (joints, points, base) = match kind {
            Kind::Stroke => (
                anatomy.arm_joints(side),
                vec![arm.hand],
                skeleton.parent(top),
            ),
            Kind::Handshape => {
                let fingers = anatomy.fingers(side);
                let is_end = |&joint: &usize| skeleton.children(joint).is_empty();
                let ends = fingers.iter().copied().filter(is_end).collect();
                (fingers, ends, Some(arm.hand))
            }
        };
        let (speeds, least) = match kind {
            Kind::Stroke => (wrist_speeds(clip, arm.hand, base), 0.15),
            Kind::Handshape => (finger_speeds(clip, &joints), 0.5),
        };
        for frames in between_minima(&smoothed(&speeds, clip), least) {
            let long = frames.len() as f64 * clip.rate().frame_time() >= LEAST.0;
            if !long || frames.len() < LEAST.1 || !moves(capture, side, kind, &frames, base) {
                continue;
            }
            found.push(Transition {
                capture: number,
                clip: clip.slice(frames),
                joints: joints.clone(),
                points: points.clone(),
                base,
            });
        }
    }
    found
}

/// Tells whether the posture at the end is clearly another than that at the start: the wrist 5 cm
/// away, or the fingers turned by 20 degrees altogether.
fn moves(
    capture: &Capture,
    side: Side,
    kind: Kind,
    frames: &Range<usize>,
    base: Option<usize>,
) -> bool {
    let (clip, ends) = (&capture.clip, [frames.start, frames.end - 1]);
    match (kind, capture.anatomy.arm(side)) {
        (Kind::Stroke, Some(arm)) => {
            let [a, b] = ends.map(|frame| point(clip, arm.hand, base, frame));
            a.distance(b) > 0.05
        }
        (Kind::Handshape, _) => {
            let turned = capture.anatomy.fingers(side).into_iter().map(|joint| {
                let [a, b] = ends.map(|frame| clip.channel(joint).rotations[frame]);
                a.angle_between(b).powi(2)
            });
            turned.sum::<f64>().sqrt() > 20f64.to_radians()
        }
        (Kind::Stroke, None) => false,
    }
}

/// Returns the end of `joint` in the space of `base`, or of the model.
pub(crate) fn point(clip: &Clip, joint: usize, base: Option<usize>, frame: usize) -> DVec3 {
    let skeleton = clip.skeleton();
    let is_end = skeleton.children(joint).is_empty();
    let mut at = skeleton
        .joint(joint)
        .tip
        .filter(|_| is_end)
        .unwrap_or(DVec3::ZERO);
    let mut next = Some(joint);
    while let Some(joint) = next.filter(|&joint| Some(joint) != base) {
        at = clip.translation(joint, frame) + clip.channel(joint).rotations[frame] * at;
        next = skeleton.parent(joint);
    }
    at
}

fn wrist_speeds(clip: &Clip, hand: usize, base: Option<usize>) -> Vec<f64> {
    let path: Vec<DVec3> = (0..clip.frames())
        .map(|frame| point(clip, hand, base, frame))
        .collect();
    speeds(&path, clip.rate().per_second(), |a, b| a.distance(*b))
}

fn finger_speeds(clip: &Clip, joints: &[usize]) -> Vec<f64> {
    let shapes: Vec<Vec<DQuat>> = (0..clip.frames())
        .map(|frame| {
            joints
                .iter()
                .map(|&j| clip.channel(j).rotations[frame])
                .collect()
        })
        .collect();
    speeds(&shapes, clip.rate().per_second(), |a, b| {
        let squares = a.iter().zip(b).map(|(a, b)| a.angle_between(*b).powi(2));
        (squares.sum::<f64>() / a.len().max(1) as f64).sqrt()
    })
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

fn smoothed(speeds: &[f64], clip: &Clip) -> Vec<f64> {
    let frame = clip.rate().frame_time();
    let reach = (3.0 * SMOOTH / frame).ceil() as usize;
    (0..speeds.len())
        .map(|n| {
            let near = n.saturating_sub(reach)..(n + reach + 1).min(speeds.len());
            let (mut sum, mut weights) = (0.0, 0.0);
            for m in near {
                let away = (m as f64 - n as f64) * frame / SMOOTH;
                let weight = (-0.5 * away * away).exp();
                sum += weight * speeds[m];
                weights += weight;
            }
            sum / weights
        })
        .collect()
}

/// Returns the stretches between two minima around each peak of at least `least`.
fn between_minima(speeds: &[f64], least: f64) -> Vec<Range<usize>> {
    let peak = |n: usize| {
        let (before, after) = (n.checked_sub(1).map(|m| speeds[m]), speeds.get(n + 1));
        speeds[n] >= least
            && before.is_none_or(|s| s < speeds[n])
            && after.is_none_or(|s| *s <= speeds[n])
    };
    let mut found: Vec<Range<usize>> = Vec::new();
    for top in (0..speeds.len()).filter(|&n| peak(n)) {
        let start = minimum(speeds, top, (0..top).rev());
        let end = minimum(speeds, top, top + 1..speeds.len());
        let (Some(start), Some(end)) = (start, end) else {
            continue;
        };
        let highest = speeds[start..=end]
            .iter()
            .all(|&speed| speed <= speeds[top]);
        if highest && found.last().is_none_or(|last| last.start != start) {
            found.push(start..end + 1);
        }
    }
    found
}

/// Walks away from a peak to the minimum that ends its transition; nothing where the speed rises
/// above the peak before, or the movement ends without falling far enough.
fn minimum(speeds: &[f64], top: usize, way: impl Iterator<Item = usize>) -> Option<usize> {
    let mut lowest = top;
    for n in way {
        if speeds[n] < speeds[lowest] {
            lowest = n;
        } else if speeds[lowest] < REST * speeds[top] || speeds[n] * DIP > speeds[lowest] {
            break;
        }
        if speeds[n] > speeds[top] {
            return None;
        }
    }
    (speeds[lowest] < DIP * speeds[top]).then_some(lowest)
}
