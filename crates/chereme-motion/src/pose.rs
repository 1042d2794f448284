//! Postures in local and in model space, and the conversion between them.

use glam::{DQuat, DVec3};

use crate::skeleton::Skeleton;

/// A posture in local space: each joint relative to its parent.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalPose {
    /// The rotation of each joint in its parent's space, a unit quaternion.
    pub rotations: Vec<DQuat>,
    /// The position of each joint in its parent's space, in metres; the root's is in model space.
    pub translations: Vec<DVec3>,
}

/// A posture in model space: the position and the rotation of each joint.
///
/// With R the rotation and p the position of a joint in model space, q and t its rotation and
/// translation in its parent's space, and P its parent: `R = R_P · q` and `p = p_P + R_P · t`.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelPose {
    positions: Vec<DVec3>,
    rotations: Vec<DQuat>,
}

impl ModelPose {
    /// Returns `pose` in model space (forward kinematics).
    ///
    /// # Panics
    /// Panics if `pose` has another number of joints than `skeleton`.
    #[must_use]
    pub fn from_local_pose(skeleton: &Skeleton, pose: &LocalPose) -> Self {
        let mut model = Self {
            positions: Vec::with_capacity(skeleton.len()),
            rotations: Vec::with_capacity(skeleton.len()),
        };
        model.set_local_pose(skeleton, pose);
        model
    }

    /// Replaces this posture by `pose` in model space, without a new allocation.
    ///
    /// # Panics
    /// Panics if `pose` has another number of joints than `skeleton`.
    pub fn set_local_pose(&mut self, skeleton: &Skeleton, pose: &LocalPose) {
        assert_eq!(pose.rotations.len(), skeleton.len(), "a pose has one rotation a joint");
        assert_eq!(
            pose.translations.len(),
            skeleton.len(),
            "a pose has one translation a joint"
        );
        self.positions.clear();
        self.rotations.clear();
        for (index, joint) in skeleton.skeleton_joints().iter().enumerate() {
            let (rotation, translation) = (pose.rotations[index], pose.translations[index]);
            let (position, rotation) = match joint.parent {
                None => (translation, rotation),
                Some(parent) => {
                    let turned = self.rotations[parent];
                    (self.positions[parent] + turned * translation, turned * rotation)
                }
            };
            self.positions.push(position);
            self.rotations.push(rotation);
        }
    }

    /// Returns the position of `joint`, in metres.
    #[must_use]
    pub fn model_joint_position(&self, joint: usize) -> DVec3 {
        self.positions[joint]
    }

    /// Returns the rotation of `joint`.
    #[must_use]
    pub fn model_joint_rotation(&self, joint: usize) -> DQuat {
        self.rotations[joint]
    }

    /// Returns the positions of all joints, in metres.
    #[must_use]
    pub fn model_joint_positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Returns the rotations of all joints.
    #[must_use]
    pub fn model_joint_rotations(&self) -> &[DQuat] {
        &self.rotations
    }

    /// Converts the point `local` in `joint`'s space to model space.
    #[must_use]
    pub fn joint_point_to_model(&self, joint: usize, local: DVec3) -> DVec3 {
        self.positions[joint] + self.rotations[joint] * local
    }

    /// Returns the end of `joint`'s bone if it has a tip.
    #[must_use]
    pub fn bone_tip_position(&self, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
        skeleton
            .joint_at(joint)
            .tip
            .map(|tip| self.joint_point_to_model(joint, tip))
    }

    /// Returns the same posture in local space.
    #[must_use]
    pub fn to_local(&self, skeleton: &Skeleton) -> LocalPose {
        let mut pose = LocalPose {
            rotations: Vec::new(),
            translations: Vec::new(),
        };
        for (index, joint) in skeleton.skeleton_joints().iter().enumerate() {
            let (position, rotation) = (self.positions[index], self.rotations[index]);
            let (translation, rotation) = match joint.parent {
                None => (position, rotation),
                Some(parent) => {
                    let back = self.rotations[parent].inverse();
                    (back * (position - self.positions[parent]), back * rotation)
                }
            };
            pose.rotations.push(rotation.normalize());
            pose.translations.push(translation);
        }
        pose
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::skeleton::SkeletonJoint;
    use glam::{DMat4, EulerRot};
    use proptest::prelude::*;

    fn chain() -> Skeleton {
        Skeleton::new(vec![
            SkeletonJoint::new("a", None, DVec3::ZERO),
            SkeletonJoint::new("b", Some(0), DVec3::new(0.0, 0.5, 0.1)),
            SkeletonJoint::new("c", Some(1), DVec3::new(0.3, 0.0, 0.0)),
            SkeletonJoint::new("d", Some(1), DVec3::new(-0.3, 0.0, 0.2)).with_tip(DVec3::Y),
        ])
        .expect("a tree")
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn forward_kinematics_agree_with_matrices_and_are_inverted(angles in proptest::array::uniform12(-3.0f64..3.0)) {
            let skeleton = chain();
            let pose = LocalPose {
                rotations: angles.chunks(3)
                    .map(|a| DQuat::from_euler(EulerRot::XYZ, a[0], a[1], a[2])).collect(),
                translations: skeleton.rest_pose().translations,
            };
            let model = ModelPose::from_local_pose(&skeleton, &pose);
            let mut matrices: Vec<DMat4> = Vec::new();
            for (i, joint) in skeleton.skeleton_joints().iter().enumerate() {
                let local = DMat4::from_rotation_translation(pose.rotations[i], pose.translations[i]);
                matrices.push(joint.parent.map_or(local, |parent| matrices[parent] * local));
                let point = matrices[i].transform_point3(DVec3::ZERO);
                prop_assert!(model.model_joint_position(i).abs_diff_eq(point, 1e-12));
            }
            let tip = matrices[3].transform_point3(DVec3::Y);
            prop_assert!(model.bone_tip_position(&skeleton, 3).is_some_and(|at| at.abs_diff_eq(tip, 1e-12)));
            let back = model.to_local(&skeleton);
            for i in 0..skeleton.len() {
                prop_assert!(back.rotations[i].angle_between(pose.rotations[i]) < 1e-7);
                prop_assert!(back.translations[i].abs_diff_eq(pose.translations[i], 1e-12));
            }
        }
    }
}
