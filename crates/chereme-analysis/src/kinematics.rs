//! Kinematics of the hands, frame by frame: speed of the wrist, opening, the palm's direction, distance of
//! the hands.

use chereme_motion::anatomy::BodyPart;
use chereme_motion::{BodyAnatomy, BodySide, Clip, ModelPose};
use glam::DVec3;

use crate::strokes::{central_difference_speeds, gaussian_smoothed_speeds, place_in};

/// A minimum of speed counts if the speed rises on both sides to this multiple of it.
const MIN_SPEED_RISE: f64 = 1.25;
/// Speeds below this, in metres per second, are rest: their minima carry no information.
const REST_METRES_PER_SECOND: f64 = 0.02;

/// Curves of a clip; each has a number for every frame, or is absent if the skeleton does not show it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ClipKinematicCurves {
    /// The curves of the right hand, then of the left.
    pub hands: [HandCurves; 2],
    /// The distance between the wrists, in metres.
    pub distance: Vec<f64>,
}

/// Curves of one hand.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HandCurves {
    /// The speed of the wrist in the space of the trunk, in metres per second, smoothed over 30 ms.
    pub speed: Vec<f64>,
    /// Aperture of the hand: the mean over the fingers of the distance from wrist to tip as a share of the
    /// length along their bones; 1 for straight fingers.
    pub aperture: Vec<f64>,
    /// Direction of the palm, as a unit vector `[left, up, forward]` in the space of the trunk.
    pub palm: Vec<DVec3>,
}

/// Returns the curves of a clip.
#[must_use]
pub fn compute_kinematic_curves(clip: &Clip, anatomy: &BodyAnatomy) -> ClipKinematicCurves {
    let poses: Vec<ModelPose> = (0..clip.clip_frame_count())
        .map(|frame| clip.model_pose(frame))
        .collect();
    let wrist = |side| anatomy.part_joint(BodyPart::Hand(side));
    let distance = match (wrist(BodySide::Right), wrist(BodySide::Left)) {
        (Some(right), Some(left)) => poses
            .iter()
            .map(|pose| {
                pose.model_joint_position(right)
                    .distance(pose.model_joint_position(left))
            })
            .collect(),
        _ => Vec::new(),
    };
    ClipKinematicCurves {
        hands: [BodySide::Right, BodySide::Left].map(|side| compute_hand_curves(clip, anatomy, side, &poses)),
        distance,
    }
}

fn compute_hand_curves(clip: &Clip, anatomy: &BodyAnatomy, side: BodySide, poses: &[ModelPose]) -> HandCurves {
    let palms = poses.iter().map(|pose| {
        let palm = anatomy.palm_normal(side, pose)?;
        let body = anatomy.body_frame(pose)?;
        Some(body.direction_to_body(palm).normalize_or_zero())
    });
    HandCurves {
        speed: wrist_speed(clip, anatomy, side),
        aperture: aperture(clip, anatomy, side, poses),
        palm: palms.collect::<Option<_>>().unwrap_or_default(),
    }
}

/// Returns the speed of a wrist in the space of the trunk, in metres per second, smoothed.
#[must_use]
pub fn wrist_speed(clip: &Clip, anatomy: &BodyAnatomy, side: BodySide) -> Vec<f64> {
    let Some(arm) = anatomy.arm_chain(side) else {
        return Vec::new();
    };
    // Seen from above the collar bone, so that a moving trunk moves no hand.
    let base = clip.clip_skeleton().joint_parent(arm.clavicle.unwrap_or(arm.upper));
    let path: Vec<DVec3> = (0..clip.clip_frame_count())
        .map(|frame| place_in(clip, arm.hand, DVec3::ZERO, base, frame))
        .collect();
    let raw = central_difference_speeds(path.len(), clip, |a, b| path[a].distance(path[b]));
    gaussian_smoothed_speeds(&raw, clip)
}

/// The joints of a finger from the wrist's child to the last, and the end of that one in its own space.
struct FingerChain {
    joints: Vec<usize>,
    tip: DVec3,
    /// The length along the bones from the wrist.
    length: f64,
}

fn chains(clip: &Clip, anatomy: &BodyAnatomy, side: BodySide, wrist: usize) -> Vec<FingerChain> {
    let skeleton = clip.clip_skeleton();
    let fingers = anatomy.possible_fingers(side);
    let goes_on = |joint: usize| {
        skeleton
            .joint_children(joint)
            .iter()
            .any(|child| fingers.contains(child))
    };
    let ends = fingers.iter().filter(|&&joint| !goes_on(joint));
    ends.filter_map(|&end| {
        let above = skeleton.joint_ancestors(end);
        let mut joints: Vec<usize> = above.take_while(|&joint| joint != wrist).collect();
        joints.reverse();
        let tip = anatomy.digit_end(skeleton, end).unwrap_or_default();
        let bones = joints.iter().map(|&joint| skeleton.joint_at(joint).offset.length());
        let length = bones.sum::<f64>() + tip.length();
        (length > 1e-6 && joints.len() > 1).then_some(FingerChain { joints, tip, length })
    })
    .collect()
}

fn aperture(clip: &Clip, anatomy: &BodyAnatomy, side: BodySide, poses: &[ModelPose]) -> Vec<f64> {
    let Some(wrist) = anatomy.part_joint(BodyPart::Hand(side)) else {
        return Vec::new();
    };
    let chains = chains(clip, anatomy, side, wrist);
    if chains.is_empty() {
        return Vec::new();
    }
    let open = |pose: &ModelPose| {
        let shares = chains.iter().filter_map(|chain| {
            let tip = pose.joint_point_to_model(*chain.joints.last()?, chain.tip);
            Some(tip.distance(pose.model_joint_position(wrist)) / chain.length)
        });
        shares.sum::<f64>() / chains.len() as f64
    };
    poses.iter().map(open).collect()
}

/// Returns the frames of least smoothed speed between two rises: the boundaries between strokes. Of a rest
/// it returns the first and the last frame.
#[must_use]
pub fn find_speed_minima(speed: &[f64]) -> Vec<usize> {
    let mut minimum_frames = Vec::new();
    let floor = |frame: usize| speed[frame].max(REST_METRES_PER_SECOND);
    // A rest that lasts since the first frame ends here, but its beginning is unknown.
    let mut lowest = speed
        .first()
        .filter(|first| **first <= REST_METRES_PER_SECOND)
        .map(|_| 0);
    let (mut fell, mut top) = (false, 0.0_f64);
    for (frame, &now) in speed.iter().enumerate() {
        match lowest {
            None => {
                top = top.max(now);
                if floor(frame) * MIN_SPEED_RISE < top {
                    (lowest, fell) = (Some(frame), true);
                }
            }
            Some(low) if floor(frame) > floor(low) * MIN_SPEED_RISE => {
                minimum_frames.extend(Some(low).filter(|_| fell));
                let rest = (low..frame).rev().find(|&at| speed[at] <= REST_METRES_PER_SECOND);
                minimum_frames.extend(rest.filter(|&last| last > low));
                (lowest, top) = (None, now);
            }
            Some(low) if now < speed[low] && speed[low] > REST_METRES_PER_SECOND => lowest = Some(frame),
            Some(_) => {}
        }
    }
    minimum_frames.extend(lowest.filter(|_| fell));
    minimum_frames
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::glam::DQuat;
    use chereme_motion::{FrameRate, JointChannel, Skeleton, SkeletonJoint};
    use std::f64::consts::PI;
    use std::sync::Arc;

    /// Two straight arms with two fingers of two joints each; `turn` bends the right elbow and every
    /// right finger joint.
    fn bending(turn: impl Fn(f64) -> f64) -> (Clip, BodyAnatomy) {
        let mut joints = vec![SkeletonJoint::new("Hips", None, DVec3::Y)];
        for (n, name) in ["Spine", "Neck", "Head"].into_iter().enumerate() {
            joints.push(SkeletonJoint::new(name, Some(n), DVec3::Y * 0.2));
        }
        for (side, x) in [("Left", 1.0), ("Right", -1.0)] {
            let first = joints.len();
            let names = ["Shoulder", "Arm", "ForeArm", "Hand"];
            for (n, (name, long)) in names.into_iter().zip([0.05, 0.12, 0.3, 0.25]).enumerate() {
                let parent = if n == 0 { 1 } else { first + n - 1 };
                let offset = DVec3::new(long * x, if n == 0 { 0.15 } else { 0.0 }, 0.0);
                joints.push(SkeletonJoint::new(format!("{side}{name}"), Some(parent), offset));
            }
            let hand = joints.len() - 1;
            for finger in ["Index", "Middle"] {
                let base = joints.len();
                let out = DVec3::X * x;
                joints.push(SkeletonJoint::new(
                    format!("{side}Hand{finger}1"),
                    Some(hand),
                    out * 0.1,
                ));
                let end = SkeletonJoint::new(format!("{side}Hand{finger}2"), Some(base), out * 0.04);
                joints.push(end.with_tip(out * 0.03));
            }
        }
        let skeleton = Arc::new(Skeleton::new(joints).expect("a tree"));
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        let turned = |joint: usize| {
            let name = &skeleton.joint_at(joint).name;
            name == "RightForeArm" || name.starts_with("RightHandI") || name.starts_with("RightHandM")
        };
        let channels = (0..skeleton.len()).map(|joint| JointChannel {
            rotations: (0..240)
                .map(|f| match turned(joint) {
                    true => DQuat::from_rotation_y(turn(f64::from(f) / 120.0)),
                    false => DQuat::IDENTITY,
                })
                .collect(),
            translations: None,
        });
        let rate = FrameRate::new(120, 1).expect("a rate");
        let clip = Clip::new(Arc::clone(&skeleton), rate, channels.collect()).expect("a clip");
        (clip, anatomy)
    }

    #[test]
    fn a_wrist_that_circles_has_the_speed_of_its_circle() {
        let (clip, anatomy) = bending(|t| t);
        let curves = compute_kinematic_curves(&clip, &anatomy);
        let [right, left] = &curves.hands;
        // One radian per second, a quarter of a metre from the elbow; the ends are one-sided.
        for speed in &right.speed[20..220] {
            assert!((speed - 0.25).abs() < 1e-4, "{speed}");
        }
        assert!(left.speed.iter().all(|speed| *speed < 1e-12));
        assert_eq!(curves.distance.len(), 240);
        assert!((curves.distance[0] - 1.44).abs() < 1e-9);
    }

    #[test]
    fn an_open_hand_has_openness_one_and_a_bent_one_less() {
        let (clip, anatomy) = bending(|t| t);
        let [right, left] = compute_kinematic_curves(&clip, &anatomy).hands;
        assert!((right.aperture[0] - 1.0).abs() < 1e-12);
        assert!(left.aperture.iter().all(|open| (open - 1.0).abs() < 1e-12));
        // Both joints at a right angle after pi/2 seconds: 0.1 out, 0.04 across, 0.03 back.
        let frame = (PI / 2.0 * 120.0).round() as usize;
        let want = 0.07_f64.hypot(0.04) / 0.17;
        assert!((right.aperture[frame] - want).abs() < 0.01, "{}", right.aperture[frame]);
    }

    #[test]
    fn minima_lie_between_rises_and_at_both_ends_of_a_rest() {
        let wave: Vec<f64> = (0..200)
            .map(|n| 0.6 + 0.5 * (f64::from(n) / 50.0 * 2.0 * PI).cos())
            .collect();
        assert_eq!(find_speed_minima(&wave), [25, 75, 125, 175]);
        let mut rest = vec![1.0; 20];
        rest.extend(vec![0.0; 30]);
        rest.extend(vec![1.0; 20]);
        assert_eq!(find_speed_minima(&rest), [20, 49]);
        assert_eq!(find_speed_minima(&rest[30..]), [19]);
        assert_eq!(find_speed_minima(&[0.001; 50]), [] as [usize; 0]);
        assert_eq!(find_speed_minima(&[]), [] as [usize; 0]);
    }

    #[test]
    fn a_skeleton_without_arms_has_no_curves() {
        let skeleton = Skeleton::new(vec![SkeletonJoint::new("root", None, DVec3::ZERO)]).expect("a tree");
        let skeleton = Arc::new(skeleton);
        let clip = Clip::from_rest_pose(Arc::clone(&skeleton), FrameRate::new(30, 1).expect("a rate"), 5);
        let curves = compute_kinematic_curves(&clip, &BodyAnatomy::detect_anatomy(&skeleton));
        assert_eq!(curves, ClipKinematicCurves::default());
    }
}
