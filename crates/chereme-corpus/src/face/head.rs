//! The turns of a head: pitch (down), yaw (to the signer's left) and roll (to the right), in radians.

use chereme_motion::glam::{DQuat, EulerRot};
use chereme_motion::{Anatomy, Clip, Part};

/// A head that turns less than this, in radians, was not captured.
const STILL: f64 = 0.008;

/// Returns the rotation in model space of these turns.
pub(crate) fn rotation([pitch, yaw, roll]: [f64; 3]) -> DQuat {
    DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll)
}

/// Returns the turns of a rotation in model space.
pub(crate) fn turns(rotation: DQuat) -> [f64; 3] {
    let (yaw, pitch, roll) = rotation.to_euler(EulerRot::YXZ);
    [pitch, yaw, roll]
}

/// Returns the turns of the head against the chest in each frame, from the skeleton's rest posture on; `None` if the
/// skeleton has no head, or it never turns.
pub(crate) fn of_clip(clip: &Clip, anatomy: &Anatomy) -> Option<Vec<[f64; 3]>> {
    let head = anatomy.joint(Part::Head).or(anatomy.joint(Part::Neck))?;
    let trunk = anatomy.joint(Part::Chest).or(anatomy.joint(Part::Spine));
    let trunk = trunk.or(anatomy.joint(Part::Hips));
    let rest = clip.skeleton().rest_model_pose();
    let turned = |frame: usize| {
        let pose = clip.model_pose(frame);
        let from_rest = |joint: usize| pose.rotation(joint) * rest.rotation(joint).inverse();
        let below = trunk.map_or(DQuat::IDENTITY, from_rest);
        turns(below.inverse() * from_rest(head))
    };
    let all: Vec<[f64; 3]> = (0..clip.frames()).map(turned).collect();
    let first = all.first()?;
    let moves = all
        .iter()
        .any(|turn| turn.iter().zip(first).any(|(a, b)| (a - b).abs() > STILL));
    moves.then_some(all)
}

#[cfg(test)]
mod tests {
    use super::{rotation, turns};
    use chereme_motion::glam::DVec3;

    #[test]
    fn turns_go_where_they_say_and_come_back() {
        let (ahead, up) = (DVec3::Z, DVec3::Y);
        assert!(
            (rotation([0.3, 0.0, 0.0]) * ahead).y < -0.2,
            "pitch is down"
        );
        assert!(
            (rotation([0.0, 0.3, 0.0]) * ahead).x > 0.2,
            "yaw is to the signer's left"
        );
        assert!(
            (rotation([0.0, 0.0, 0.3]) * up).x < -0.2,
            "roll is to the signer's right"
        );
        let back = turns(rotation([0.3, -0.4, 0.2]));
        for (back, want) in back.into_iter().zip([0.3, -0.4, 0.2]) {
            assert!((back - want).abs() < 1e-9, "{back} {want}");
        }
    }
}
