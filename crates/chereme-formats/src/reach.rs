//! The range of places in files that hold 32-bit numbers.

use chereme_motion::ModelPose;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, Pose, Skeleton};

/// The largest coordinate that is written as a 32-bit number; products of four such numbers still are finite ones.
const FARTHEST: f64 = 1e9;

/// A joint or marker whose numbers do not fit into a file of 32-bit numbers.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{kind} {name:?} is too far away to be written{}", when(*.frame))]
pub struct TooFar {
    /// `joint` or `marker`.
    pub kind: &'static str,
    /// Its name.
    pub name: String,
    /// The frame, counted from 0; `None` for the rest pose.
    pub frame: Option<usize>,
}

fn when(frame: Option<usize>) -> String {
    match frame {
        Some(frame) => format!(" in frame {frame}"),
        None => " in its rest pose".to_owned(),
    }
}

/// Returns whether a place can be written; one that is no number cannot.
pub(crate) fn reaches(place: DVec3) -> bool {
    place.to_array().iter().all(|value| value.abs() <= FARTHEST)
}

fn turns(rotation: DQuat) -> bool {
    rotation.normalize().is_finite()
}

/// Returns the rest pose of a skeleton in model space.
pub(crate) fn rest(skeleton: &Skeleton) -> ModelPose {
    let joints = skeleton.joints();
    let pose = Pose {
        rotations: joints.iter().map(|joint| joint.rest).collect(),
        translations: joints.iter().map(|joint| joint.offset).collect(),
    };
    ModelPose::of(skeleton, &pose)
}

/// Refuses a clip with a place or rotation that 32-bit numbers cannot hold, at rest or in any frame.
///
/// # Errors
/// [`TooFar`] with the first such joint.
pub(crate) fn check(clip: &Clip) -> Result<(), TooFar> {
    let skeleton = clip.skeleton();
    let too_far = |joint: usize, frame| TooFar {
        kind: "joint",
        name: skeleton.joint(joint).name.clone(),
        frame,
    };
    let rest = rest(skeleton);
    for (at, joint) in skeleton.joints().iter().enumerate() {
        let tip = joint.tip.map_or(DVec3::ZERO, |tip| rest.point(at, tip));
        let places = [joint.offset, rest.position(at), tip];
        if !places.into_iter().all(reaches) || !turns(joint.rest) {
            return Err(too_far(at, None));
        }
    }
    for frame in 0..clip.frames() {
        for (at, channel) in clip.channels().iter().enumerate() {
            if !reaches(clip.translation(at, frame)) || !turns(channel.rotations[frame]) {
                return Err(too_far(at, Some(frame)));
            }
        }
    }
    Ok(())
}
