//! Golden tables: every number that the modules find in generated bodies, movement and tracks.

mod bodies;
mod names;
mod numbers;
mod reaching;
mod takes;

use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::anatomy::tests::fixtures::{BodyVariation, PLAIN_BODY_VARIATION, fixture_body, fixture_joint_roles};
use crate::{BodyAnatomy, BodyPart, BodySide, Clip, FrameRate, LocalPose, Skeleton};

/// Returns a position in words, in millimetres.
fn milli(at: DVec3) -> String {
    let [x, y, z] = (at * 1000.0).to_array();
    format!("{x:?} {y:?} {z:?}")
}

/// Returns a rotation in words: the directions of the first two axes.
fn turned(q: DQuat) -> String {
    let axes = [q * DVec3::X, q * DVec3::Y].map(|axis| axis.to_array());
    list(axes.into_iter().flatten())
}

/// Returns numbers in words.
fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let words = numbers.into_iter().map(|number| format!("{number:?}"));
    words.collect::<Vec<_>>().join(" ")
}

/// Returns a body and its parts.
fn dressed(wear: BodyVariation) -> (Arc<Skeleton>, BodyAnatomy) {
    let skeleton = Arc::new(fixture_body(wear));
    let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("a body");
    (skeleton, anatomy)
}

/// Returns a posture of a signer at a moment: both arms bent in front, the trunk and the head turned.
fn signing(skeleton: &Skeleton, anatomy: &BodyAnatomy, at: f64) -> LocalPose {
    let mut pose = skeleton.rest_pose();
    let mut turn = |part: BodyPart, by: DQuat| {
        if let Some(joint) = anatomy.part_joint(part) {
            pose.rotations[joint] = (pose.rotations[joint] * by).normalize();
        }
    };
    turn(BodyPart::Spine, DQuat::from_rotation_y(0.2 * at.sin()));
    turn(BodyPart::Head, DQuat::from_rotation_x(0.15 + 0.1 * at.cos()));
    for side in BodySide::BOTH_SIDES {
        let own = side.side_sign();
        let late = at + 0.4 * own;
        turn(
            BodyPart::UpperArm(side),
            DQuat::from_rotation_z(-own * (0.9 + 0.2 * late.sin())),
        );
        turn(
            BodyPart::Forearm(side),
            DQuat::from_rotation_y(-own * (1.3 + 0.4 * late.cos())),
        );
        turn(BodyPart::Hand(side), DQuat::from_rotation_x(0.3 * late.sin()));
    }
    pose.translations[0] += DVec3::new(0.02 * at.sin(), 0.0, 0.01 * at);
    pose
}

/// Returns the movement of a signer.
fn take(wear: BodyVariation, frames: usize, rate: FrameRate) -> (Clip, BodyAnatomy) {
    let (skeleton, anatomy) = dressed(wear);
    let poses: Vec<LocalPose> = (0..frames)
        .map(|frame| signing(&skeleton, &anatomy, 3.0 * frame as f64 * rate.frame_time()))
        .collect();
    let clip = Clip::from_poses(skeleton, rate, &poses).expect("a clip");
    (clip, anatomy)
}

/// Returns the movement of a usual signer.
fn usual_take(frames: usize) -> (Clip, BodyAnatomy) {
    take(PLAIN_BODY_VARIATION, frames, FrameRate::new(50, 1).expect("a rate"))
}
