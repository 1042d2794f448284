use super::*;
use chereme_motion::{FrameRate, JointChannel, Skeleton, SkeletonJoint};
use std::sync::Arc;

/// An arm whose forearm bends by `angle` at each frame.
pub(crate) fn bending(angle: impl Fn(f64) -> f64) -> (Clip, BodyAnatomy) {
    let mut joints = vec![SkeletonJoint::new("Hips", None, DVec3::Y)];
    let chain = ["Spine", "Neck", "Head"];
    for (n, name) in chain.into_iter().enumerate() {
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
    }
    let skeleton = Arc::new(Skeleton::new(joints).expect("a tree"));
    let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
    let elbow = anatomy.arm_chain(BodySide::Right).expect("an arm").forearm;
    let channels = (0..skeleton.len()).map(|joint| JointChannel {
        rotations: (0..360)
            .map(|f| match joint == elbow {
                true => DQuat::from_rotation_y(angle(f64::from(f) / 120.0)),
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
fn strokes_lie_between_rests() {
    // There in the second half second, back in the fourth.
    let step = |s: f64| s.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * s.clamp(0.0, 1.0));
    let (clip, anatomy) = bending(|t| step(2.0 * t - 1.0) - step(2.0 * t - 3.0));
    let found_strokes = find_transition_strokes(&clip, &anatomy, BodySide::Right, MovingPart::Wrist);
    assert_eq!(found_strokes.len(), 2, "{found_strokes:?}");
    for (frames, start) in found_strokes.iter().zip([60, 180]) {
        assert!(frames.start.abs_diff(start) < 20, "{frames:?}");
        assert!(frames.end.abs_diff(start + 60) < 20, "{frames:?}");
    }
    assert!(find_transition_strokes(&clip, &anatomy, BodySide::Left, MovingPart::Wrist).is_empty());
    assert!(find_transition_strokes(&clip, &anatomy, BodySide::Right, MovingPart::Fingers).is_empty());
}

#[test]
fn a_tiny_tremble_is_no_stroke() {
    let (clip, anatomy) = bending(|t| 0.05 * (t * 6.0).sin());
    assert!(find_transition_strokes(&clip, &anatomy, BodySide::Right, MovingPart::Wrist).is_empty());
}

#[test]
fn a_point_is_converted_to_the_space_of_its_base_joint() {
    let (clip, anatomy) = bending(|_| std::f64::consts::FRAC_PI_2);
    let arm = anatomy.arm_chain(BodySide::Right).expect("an arm");
    let local_place = place_in(&clip, arm.hand, DVec3::ZERO, Some(arm.upper), 3);
    assert!(
        local_place.abs_diff_eq(DVec3::new(-0.3, 0.0, 0.25), 1e-12),
        "{local_place}"
    );
    let place = clip.model_pose(3).model_joint_position(arm.hand);
    let model_place = place_in(&clip, arm.hand, DVec3::ZERO, None, 3);
    assert!(model_place.abs_diff_eq(place, 1e-12));
}
