//! Moves fingers, hand and arm from one target to the next.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyPart, BodySide, HandFinger, InterpolationKind, ModelPose};
use chereme_sign::cue::CueCode;

use super::CueTarget;
use super::cue_places::{CueHeadSpace, CueSpot};
use crate::arm;
use crate::error::StepError;
use crate::poses::{self, HandPose};
use crate::work::WorkingClip;

/// The minimum-jerk course from rest to rest.
const CUE_HAND_COURSE: InterpolationKind = InterpolationKind::MinimumJerk;

/// Moves fingers, hand and arm of `side`; returns the largest distance of the wrist from its path, in metres.
pub(super) fn move_cueing_hand(
    work: &mut WorkingClip,
    side: BodySide,
    head: &CueHeadSpace,
    targets: &[CueTarget],
    shapes: &[(u8, HandPose)],
    code: &CueCode,
) -> Result<f64, StepError> {
    let reaches = move_cue_fingers(work, side, targets, shapes, code)?;
    let turns: Vec<DQuat> = targets
        .iter()
        .map(|target| cue_hand_rotation(work, side, head, &target.spot))
        .collect::<Option<_>>()
        .ok_or(StepError::NoFingers(side))?;
    let (mut wrists, mut hands) = (Vec::new(), Vec::new());
    for frame in 0..work.frames {
        let (n, share) = target_approach_share(targets, cue_frame_seconds(work, frame), |times| (times.m1, times.m2));
        let before = n.saturating_sub(1);
        let turn = CUE_HAND_COURSE.interpolate_rotation(turns[before], turns[n], share);
        let share = CUE_HAND_COURSE.interpolation_share(share);
        let bow_spot = targets[n]
            .bow
            .bowed_tip_position(&targets[before].spot, &targets[n].spot, share);
        // Fingers that fold and unfold on the path do not pull the hand to the face.
        let reach = reaches[before].lerp(reaches[n], share);
        wrists.push(head.head_to_model_point(bow_spot) - turn * reach);
        hands.push(turn);
    }
    let outside = head.axes[0];
    let reach = arm::raise_arm(work, side, &wrists, &hands, outside).ok_or(StepError::NoArm(side))?;
    Ok(reach.residual)
}

fn cue_frame_seconds(work: &WorkingClip, frame: usize) -> f64 {
    frame as f64 * work.rate.frame_time()
}

/// Returns the number of the target that is shown or approached at a time, and the share of its approach that is over.
fn target_approach_share(
    targets: &[CueTarget],
    time: f64,
    of: impl Fn(&super::KeyTimes) -> (f64, f64),
) -> (usize, f64) {
    let n = targets
        .partition_point(|target| of(&target.times).0 <= time)
        .saturating_sub(1);
    let (from, to) = of(&targets[n].times);
    let share = if to > from {
        ((time - from) / (to - from)).clamp(0.0, 1.0)
    } else {
        1.0
    };
    (n, share)
}

/// Moves the fingers; returns for each target the vector from the wrist to the pointing tip in its shape, in the space of
/// the hand.
fn move_cue_fingers(
    work: &mut WorkingClip,
    side: BodySide,
    targets: &[CueTarget],
    shapes: &[(u8, HandPose)],
    code: &CueCode,
) -> Result<Vec<DVec3>, StepError> {
    let mut shape_joints = Vec::with_capacity(shapes.len());
    for (number, pose) in shapes {
        let joints = poses::hand_pose_rotations(&work.skeleton, &work.anatomy, side, pose);
        shape_joints.push((*number, joints.ok_or(StepError::NoFingers(side))?));
    }
    let shape = |number: u8| {
        let matching_shape = shape_joints.iter().find(|(own, _)| *own == number);
        matching_shape.map(|(_, joints)| joints)
    };
    for frame in 0..work.frames {
        let (n, share) = target_approach_share(targets, cue_frame_seconds(work, frame), |times| (times.d1, times.d2));
        let before = shape(targets[n.saturating_sub(1)].shape);
        // Before the first target the hand has the first shape already.
        let (Some(before), Some(after)) = (before, shape(targets[n].shape)) else {
            return Err(StepError::Input);
        };
        for ((joint, from), (_, to)) in before.iter().zip(after) {
            work.channels[*joint].rotations[frame] = CUE_HAND_COURSE.interpolate_rotation(*from, *to, share);
        }
    }
    let hand = work.anatomy.arm_chain(side).ok_or(StepError::NoArm(side))?.hand;
    let reach = |target: &CueTarget| {
        let mut pose = work.local_pose_at(0);
        for (joint, rotation) in shape(target.shape)? {
            pose.rotations[*joint] = *rotation;
        }
        let model = ModelPose::from_local_pose(&work.skeleton, &pose);
        let tip = pointing(work, &model, side, target, code)?;
        Some(model.model_joint_rotation(hand).inverse() * (tip - model.model_joint_position(hand)))
    };
    let reaches = targets.iter().map(reach).collect::<Option<_>>();
    reaches.ok_or(StepError::NoFingers(side))
}

/// Returns the rotation of the hand at a place: fingers up and towards the face, the back of the hand to the front.
fn cue_hand_rotation(work: &WorkingClip, side: BodySide, head: &CueHeadSpace, spot: &CueSpot) -> Option<DQuat> {
    // The first axis points to the side of the cueing hand, from which its fingers point away.
    let level = DVec3::new(-spot.angle.cos(), spot.angle.sin(), 0.0);
    let along = level * spot.lean.cos() - DVec3::Z * spot.lean.sin();
    let (along, palm) = (
        head.head_to_model_direction(along),
        head.head_to_model_direction(DVec3::NEG_Z),
    );
    work.anatomy.hand_rotation(side, along, palm)
}

/// Returns the position of the pointing tip at a frame: the index or the middle finger's, in between while the shape
/// changes, and the knuckle of the index finger at rest.
pub(super) fn pointing_tip_position(
    work: &WorkingClip,
    model: &ModelPose,
    side: BodySide,
    targets: &[CueTarget],
    frame: usize,
    code: &CueCode,
) -> Option<DVec3> {
    let (n, share) = target_approach_share(targets, cue_frame_seconds(work, frame), |times| (times.d1, times.d2));
    let of = |target: &CueTarget| pointing(work, model, side, target, code);
    let (before, after) = (of(&targets[n.saturating_sub(1)])?, of(&targets[n])?);
    Some(before.lerp(after, CUE_HAND_COURSE.interpolation_share(share)))
}

/// Returns the position of the fingertip that points for a target, or of the knuckle of the index finger at rest.
fn pointing(
    work: &WorkingClip,
    model: &ModelPose,
    side: BodySide,
    target: &CueTarget,
    code: &CueCode,
) -> Option<DVec3> {
    match code.find_cue_shape(target.shape) {
        Some(shape) => {
            let name = format!("{}-{}-tip", side.body_side_name(), shape.points_with);
            work.anatomy.landmark_place_position(&work.skeleton, model, &name)
        }
        None => {
            let knuckle = work.anatomy.part_joint(BodyPart::Finger(side, HandFinger::Index, 1))?;
            Some(model.model_joint_position(knuckle))
        }
    }
}
