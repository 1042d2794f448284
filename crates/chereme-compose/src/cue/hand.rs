//! Moves fingers, hand and arm from one target to the next.

use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Finger, Interpolation, ModelPose, Part, Side};
use chereme_sign::cue::CueCode;

use super::Target;
use super::places::{Head, Spot};
use crate::arm;
use crate::error::Cause;
use crate::poses::{self, HandPose};
use crate::work::Work;

/// The minimum-jerk course from rest to rest.
const COURSE: Interpolation = Interpolation::MinimumJerk;

/// Moves fingers, hand and arm of `side`; returns the largest distance of the wrist from its path, in metres.
pub(super) fn show(
    work: &mut Work,
    side: Side,
    head: &Head,
    targets: &[Target],
    (shapes, code): (&[(u8, HandPose)], &CueCode),
) -> Result<f64, Cause> {
    let reaches = fingers(work, side, targets, (shapes, code))?;
    let turns: Vec<DQuat> = targets
        .iter()
        .map(|target| rotation(work, side, head, &target.spot))
        .collect::<Option<_>>()
        .ok_or(Cause::NoFingers(side))?;
    let (mut wrists, mut hands) = (Vec::new(), Vec::new());
    for frame in 0..work.frames {
        let (n, share) = along(targets, time(work, frame), |times| (times.m1, times.m2));
        let before = n.saturating_sub(1);
        let turn = COURSE.rotation(turns[before], turns[n], share);
        let share = COURSE.share(share);
        let at = targets[n]
            .bow
            .at(&targets[before].spot, &targets[n].spot, share);
        // Fingers that fold and unfold on the path do not pull the hand to the face.
        let reach = reaches[before].lerp(reaches[n], share);
        wrists.push(head.point(at) - turn * reach);
        hands.push(turn);
    }
    let outside = head.axes[0];
    let reach = arm::raise_arm(work, side, &wrists, &hands, outside).ok_or(Cause::NoArm(side))?;
    Ok(reach.residual)
}

fn time(work: &Work, frame: usize) -> f64 {
    frame as f64 * work.rate.frame_time()
}

/// Returns the number of the target that is shown or approached at a time, and the share of its approach that is over.
fn along(
    targets: &[Target],
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
fn fingers(
    work: &mut Work,
    side: Side,
    targets: &[Target],
    (shapes, code): (&[(u8, HandPose)], &CueCode),
) -> Result<Vec<DVec3>, Cause> {
    let mut known = Vec::with_capacity(shapes.len());
    for (number, pose) in shapes {
        let joints = poses::rotations(&work.skeleton, &work.anatomy, side, pose);
        known.push((*number, joints.ok_or(Cause::NoFingers(side))?));
    }
    let shape = |number: u8| {
        let found = known.iter().find(|(own, _)| *own == number);
        found.map(|(_, joints)| joints)
    };
    for frame in 0..work.frames {
        let (n, share) = along(targets, time(work, frame), |times| (times.d1, times.d2));
        let before = shape(targets[n.saturating_sub(1)].shape);
        let (Some(before), Some(after)) = (before, shape(targets[n].shape)) else {
            return Err(Cause::Input);
        };
        for ((joint, from), (_, to)) in before.iter().zip(after) {
            work.channels[*joint].rotations[frame] = COURSE.rotation(*from, *to, share);
        }
    }
    let hand = work.anatomy.arm(side).ok_or(Cause::NoArm(side))?.hand;
    let reach = |target: &Target| {
        let mut pose = work.pose(0);
        for (joint, rotation) in shape(target.shape)? {
            pose.rotations[*joint] = *rotation;
        }
        let model = ModelPose::of(&work.skeleton, &pose);
        let tip = pointing(work, &model, side, target, code)?;
        Some(model.rotation(hand).inverse() * (tip - model.position(hand)))
    };
    let reaches = targets.iter().map(reach).collect::<Option<_>>();
    reaches.ok_or(Cause::NoFingers(side))
}

/// Returns the rotation of the hand at a place: fingers up and towards the face, the back of the hand to the front.
fn rotation(work: &Work, side: Side, head: &Head, spot: &Spot) -> Option<DQuat> {
    let level = DVec3::new(-spot.angle.cos(), spot.angle.sin(), 0.0);
    let along = level * spot.lean.cos() - DVec3::Z * spot.lean.sin();
    let (along, palm) = (head.direction(along), head.direction(DVec3::NEG_Z));
    work.anatomy.hand_rotation(side, along, palm)
}

/// Returns the position of the pointing tip at a frame: the index or the middle finger's, in between while the shape
/// changes, and the knuckle of the index finger at rest.
pub(super) fn tip(
    work: &Work,
    model: &ModelPose,
    side: Side,
    targets: &[Target],
    frame: usize,
    code: &CueCode,
) -> Option<DVec3> {
    let (n, share) = along(targets, time(work, frame), |times| (times.d1, times.d2));
    let of = |target: &Target| pointing(work, model, side, target, code);
    let (before, after) = (of(&targets[n.saturating_sub(1)])?, of(&targets[n])?);
    Some(before.lerp(after, COURSE.share(share)))
}

/// Returns the position of the fingertip that points for a target, or of the knuckle of the index finger at rest.
fn pointing(
    work: &Work,
    model: &ModelPose,
    side: Side,
    target: &Target,
    code: &CueCode,
) -> Option<DVec3> {
    match code.shape(target.shape) {
        Some(shape) => {
            let name = format!("{}-{}-tip", side.name(), shape.points_with);
            work.anatomy.landmark(&work.skeleton, model, &name)
        }
        None => {
            let knuckle = work.anatomy.joint(Part::Finger(side, Finger::Index, 1))?;
            Some(model.position(knuckle))
        }
    }
}
