//! The moving body in scene files, and code that readers of such files share.

use chereme_motion::glam::DVec3;
use chereme_motion::{Clip, CurveTrack, JointChannel, RecordingInstant, SkeletonJoint, SpaceConvention};

/// The moving body in a document.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyScene {
    /// The movement in the file's unit and axes; one frame at rest if the file has no animation.
    pub clip: Clip,
    /// Unit and axes of the file.
    pub convention: SpaceConvention,
    /// The weights of morph targets, if they move.
    pub morphs: Option<CurveTrack>,
    /// The name of the animation that was read.
    pub take: Option<String>,
    /// The time of day of the first frame, if the file's times are timecodes.
    pub clock: Option<RecordingInstant>,
}

/// The most frames from which a median is taken.
const MAX_SCENE_MEDIAN_FRAMES: usize = 2048;
/// Distance between a joint and its offset above which the offset counts as wrong, as a share of the
/// longer of both.
const WRONG_OFFSET_SHARE: f64 = 0.15;
/// Largest median distance of a bone's end from its median position, as a share of the bone's length;
/// joints that move more are not attached to a bone.
const MAX_BONE_SPREAD_SHARE: f64 = 0.25;
/// Places that differ less than this share of their length are equal.
const SAME_PLACE_SHARE: f64 = 1e-7;

/// Returns the median position of a joint if the joint stays near it and its `offset` contradicts it; `found`
/// are its positions in its parent's space.
pub(crate) fn median_joint_place(offset: DVec3, found: &[DVec3]) -> Option<DVec3> {
    let median_place = DVec3::from_array([0, 1, 2].map(|axis| {
        let mut values: Vec<f64> = found.iter().map(|at| at[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
    }));
    if !median_place.is_finite() || median_place.abs().max_element() > 1e9 {
        return None;
    }
    let length = median_place.length().max(offset.length());
    let mut far: Vec<f64> = found.iter().map(|place| place.distance(median_place)).collect();
    far.sort_by(f64::total_cmp);
    let spread = far.get(far.len() / 2).copied().unwrap_or_default();
    let off = median_place.distance(offset) > WRONG_OFFSET_SHARE * length;
    (off && spread < MAX_BONE_SPREAD_SHARE * median_place.length().max(1e-9)).then_some(median_place)
}

/// Puts the joints whose movement contradicts their offsets where their movement has them, and drops positions
/// that never differ from the offset. Joints that carry most of the body keep both: they move in the room.
/// Returns the number of wrong offsets.
pub(crate) fn settle_joint_offsets(joints: &mut [SkeletonJoint], channels: &mut [JointChannel]) -> usize {
    let count = joints.len();
    let mut below = vec![1_usize; count];
    for joint in (0..count).rev() {
        if let Some(parent) = joints[joint].parent {
            below[parent] += below[joint];
        }
    }
    let mut moved = 0;
    for (joint, channel) in channels.iter_mut().enumerate() {
        let Some(places) = &channel.translations else {
            continue;
        };
        if joint > 0 && below[joint] * 2 <= count {
            let step = places.len().div_ceil(MAX_SCENE_MEDIAN_FRAMES).max(1);
            let sampled_places: Vec<DVec3> = places.iter().copied().step_by(step).collect();
            if let Some(at) = median_joint_place(joints[joint].offset, &sampled_places) {
                joints[joint].offset = at;
                moved += 1;
            }
        }
        let offset = joints[joint].offset;
        let same = |place: &DVec3| place.distance(offset) <= SAME_PLACE_SHARE * offset.length().max(1e-6);
        if places.iter().all(same) {
            channel.translations = None;
        }
    }
    moved
}

/// Returns the common frame rate near `rate`, which was computed from rounded times; `rate` itself if none is near.
pub(crate) fn near_usual(rate: f64) -> f64 {
    near_usual_within(rate, 5e-4)
}

/// Returns the nearest common frame rate within a share of `rate`; `rate` itself if there is none.
pub(crate) fn near_usual_within(rate: f64, share: f64) -> f64 {
    let usual = [
        23.976, 24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 59.94, 60.0, 90.0, 100.0, 119.88, 120.0, 240.0,
    ];
    let off = |usual: &f64| (rate / usual - 1.0).abs();
    let near = usual.into_iter().filter(|usual| off(usual) < share);
    near.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(rate)
}

#[cfg(test)]
mod tests {
    use chereme_motion::glam::DQuat;

    use super::*;

    #[test]
    fn joint_positions_equal_those_of_the_movement_and_constant_ones_are_dropped() {
        let channel = |places: Vec<DVec3>| JointChannel {
            rotations: vec![DQuat::IDENTITY; places.len()],
            translations: Some(places),
        };
        let mut joints = vec![
            SkeletonJoint::new("hips", None, DVec3::Y),
            SkeletonJoint::new("chest", Some(0), DVec3::Y),
            SkeletonJoint::new("finger", Some(1), DVec3::X),
            SkeletonJoint::new("tip", Some(2), DVec3::new(60.0, 3.0, 0.0)),
        ];
        let mut channels = vec![
            channel(vec![DVec3::X, DVec3::Y, DVec3::Z]),
            channel(vec![DVec3::Y; 3]),
            channel(vec![DVec3::X; 3]),
            channel([2.0, 2.01, 1.99].map(|x| DVec3::new(x, 0.0, 0.0)).to_vec()),
        ];
        assert_eq!(settle_joint_offsets(&mut joints, &mut channels), 1);
        assert_eq!(joints[3].offset, DVec3::new(2.0, 0.0, 0.0));
        let kept: Vec<bool> = channels.iter().map(|channel| channel.translations.is_some()).collect();
        assert_eq!(kept, [true, false, false, true]);
    }
}
