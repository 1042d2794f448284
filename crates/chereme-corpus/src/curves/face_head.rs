//! Rotations of head and trunk: pitch (down), yaw (to the signer's left) and roll (to the right), in radians.

use chereme_motion::glam::{DQuat, EulerRot};
use chereme_motion::{BodyAnatomy, BodyPart, Clip};

/// The smallest rotation of a part that counts as captured, in radians.
const STILL_ROTATION_RADIANS: f64 = 0.008;

/// Returns the rotation in model space for these angles.
pub(crate) fn rotation_from_angles([pitch, yaw, roll]: [f64; 3]) -> DQuat {
    // The head turns, then nods, then tilts, so that pitch and roll are those of the turned head.
    DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll)
}

/// Returns the angles of a rotation in model space.
pub(crate) fn angles_from_rotation(rotation: DQuat) -> [f64; 3] {
    let (yaw, pitch, roll) = rotation.to_euler(EulerRot::YXZ);
    [pitch, yaw, roll]
}

/// The rotations of head and trunk in each frame of a clip.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct HeadTrunkTurns {
    /// The head relative to the chest; `None` if the skeleton has no head, or it never turns.
    pub(crate) head: Option<Vec<[f64; 3]>>,
    /// The chest relative to the hips; `None` if the skeleton has no chest, or it never turns.
    pub(crate) trunk: Option<Vec<[f64; 3]>>,
}

/// Returns the rotations of head and trunk in each frame, relative to the skeleton's rest posture.
pub(crate) fn of_clip(clip: &Clip, anatomy: &BodyAnatomy) -> HeadTrunkTurns {
    let (heads, trunks) = in_frames(clip, anatomy);
    HeadTrunkTurns {
        head: only_moving_turns(heads),
        trunk: only_moving_turns(trunks),
    }
}

/// Returns the rotations of head and trunk in each frame of a part of a movement, also those that never change; none of
/// a part that the skeleton lacks.
pub(crate) fn in_frames(clip: &Clip, anatomy: &BodyAnatomy) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let head = anatomy
        .part_joint(BodyPart::Head)
        .or(anatomy.part_joint(BodyPart::Neck));
    let chest = anatomy
        .part_joint(BodyPart::Chest)
        .or(anatomy.part_joint(BodyPart::Spine));
    let hips = anatomy.part_joint(BodyPart::Hips);
    let rest = clip.clip_skeleton().rest_model_pose();
    let (mut heads, mut trunks) = (Vec::new(), Vec::new());
    for frame in 0..clip.clip_frame_count() {
        let pose = clip.model_pose(frame);
        // Joints have axes of their own at rest; the rotation since then is the same in every skeleton.
        let from_rest = |joint: usize| pose.model_joint_rotation(joint) * rest.model_joint_rotation(joint).inverse();
        let against = |own: usize, below: Option<usize>| {
            angles_from_rotation(below.map_or(DQuat::IDENTITY, from_rest).inverse() * from_rest(own))
        };
        heads.extend(head.map(|own| against(own, chest.or(hips))));
        // Without a chest the hips may stand for it, and nothing turns against itself.
        trunks.extend(chest.filter(|own| Some(*own) != hips).map(|own| against(own, hips)));
    }
    (heads, trunks)
}

/// Returns rotations that change; those of a part that was not captured are constant.
pub(crate) fn only_moving_turns(all: Vec<[f64; 3]>) -> Option<Vec<[f64; 3]>> {
    let first = *all.first()?;
    let away = |turn: &[f64; 3]| {
        turn.iter()
            .zip(first)
            .any(|(a, b)| (a - b).abs() > STILL_ROTATION_RADIANS)
    };
    all.iter().any(away).then_some(all)
}

#[cfg(test)]
mod tests {
    use super::{angles_from_rotation, rotation_from_angles};
    use chereme_motion::glam::DVec3;

    #[test]
    fn head_turns_have_the_stated_directions_and_convert_back() {
        let (ahead, up) = (DVec3::Z, DVec3::Y);
        assert!(
            (rotation_from_angles([0.3, 0.0, 0.0]) * ahead).y < -0.2,
            "pitch is down"
        );
        assert!(
            (rotation_from_angles([0.0, 0.3, 0.0]) * ahead).x > 0.2,
            "yaw is to the signer's left"
        );
        assert!(
            (rotation_from_angles([0.0, 0.0, 0.3]) * up).x < -0.2,
            "roll is to the signer's right"
        );
        let back = angles_from_rotation(rotation_from_angles([0.3, -0.4, 0.2]));
        for (back, want) in back.into_iter().zip([0.3, -0.4, 0.2]) {
            assert!((back - want).abs() < 1e-9, "{back} {want}");
        }
    }
}
