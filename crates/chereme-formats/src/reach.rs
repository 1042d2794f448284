//! The range of places in files that hold 32-bit numbers.

use chereme_motion::ModelPose;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Clip, LocalPose, Skeleton};

/// The largest coordinate that is written as a 32-bit number; products of four such numbers still are finite ones.
const MAX_WRITABLE_COORDINATE: f64 = 1e9;

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
pub(crate) fn is_writable_place(place: DVec3) -> bool {
    place
        .to_array()
        .iter()
        .all(|value| value.abs() <= MAX_WRITABLE_COORDINATE)
}

fn is_writable_rotation(rotation: DQuat) -> bool {
    rotation.normalize().is_finite()
}

/// Returns the rest pose of a skeleton in model space.
pub(crate) fn skeleton_rest_pose(skeleton: &Skeleton) -> ModelPose {
    let joints = skeleton.skeleton_joints();
    let pose = LocalPose {
        rotations: joints.iter().map(|joint| joint.rest).collect(),
        translations: joints.iter().map(|joint| joint.offset).collect(),
    };
    ModelPose::from_local_pose(skeleton, &pose)
}

/// Refuses a clip with a place or rotation that 32-bit numbers cannot hold, at rest or in any frame.
///
/// # Errors
/// [`TooFar`] with the first such joint.
pub(crate) fn check_clip_reach(clip: &Clip) -> Result<(), TooFar> {
    let skeleton = clip.clip_skeleton();
    let too_far = |joint: usize, frame| TooFar {
        kind: "joint",
        name: skeleton.joint_at(joint).name.clone(),
        frame,
    };
    let rest = skeleton_rest_pose(skeleton);
    for (at, joint) in skeleton.skeleton_joints().iter().enumerate() {
        let tip = joint.tip.map_or(DVec3::ZERO, |tip| rest.joint_point_to_model(at, tip));
        let places = [joint.offset, rest.model_joint_position(at), tip];
        if !places.into_iter().all(is_writable_place) || !is_writable_rotation(joint.rest) {
            return Err(too_far(at, None));
        }
    }
    for frame in 0..clip.clip_frame_count() {
        for (at, channel) in clip.joint_channels().iter().enumerate() {
            if !is_writable_place(clip.joint_translation(at, frame)) || !is_writable_rotation(channel.rotations[frame])
            {
                return Err(too_far(at, Some(frame)));
            }
        }
    }
    Ok(())
}
