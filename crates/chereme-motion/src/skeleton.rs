//! The tree of joints, parents before children; it is checked once and never invalid.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::pose::{LocalPose, ModelPose};

/// One joint of a skeleton.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SkeletonJoint {
    /// The name in its source.
    pub name: String,
    /// The index of the parent joint; only the root has none.
    pub parent: Option<usize>,
    /// The position of the joint in its parent's space at rest, in metres.
    pub offset: DVec3,
    /// The local rotation at rest; the identity if the source does not specify one.
    pub rest: DQuat,
    /// The end of a bone without a further joint (an End Site), in this joint's space, in metres.
    pub tip: Option<DVec3>,
}

impl SkeletonJoint {
    /// Returns a joint without a rotation at rest and without a tip.
    #[must_use]
    pub fn new(name: impl Into<String>, parent: Option<usize>, offset: DVec3) -> Self {
        Self {
            name: name.into(),
            parent,
            offset,
            rest: DQuat::IDENTITY,
            tip: None,
        }
    }

    /// Returns the joint with a tip at `tip` in its own space.
    #[must_use]
    pub fn with_tip(self, tip: DVec3) -> Self {
        Self { tip: Some(tip), ..self }
    }
}

/// Joints in a tree with one root; every parent comes before its children.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<SkeletonJoint>", into = "Vec<SkeletonJoint>")]
pub struct Skeleton {
    joints: Vec<SkeletonJoint>,
    children: Vec<Vec<usize>>,
}

/// Why joints do not form a skeleton.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SkeletonError {
    /// There is no joint at all.
    #[error("a skeleton needs at least one joint")]
    Empty,
    /// The first joint has a parent, or a later one has none.
    #[error("joint {index} ({name:?}) is a second root; exactly the first joint has no parent")]
    Root {
        /// The joint's index.
        index: usize,
        /// Its name.
        name: String,
    },
    /// A joint's parent is itself, follows it, or does not exist.
    #[error("joint {index} ({name:?}) names parent {parent}, but a parent comes before its children")]
    Parent {
        /// The joint's index.
        index: usize,
        /// Its name.
        name: String,
        /// The parent it names.
        parent: usize,
    },
    /// An offset, tip or rest rotation is not finite, or the rotation is not of length one.
    #[error("joint {index} ({name:?}) has an offset, tip or rest rotation that is no number")]
    Value {
        /// The joint's index.
        index: usize,
        /// Its name.
        name: String,
    },
}

impl Skeleton {
    /// Returns the skeleton of `joints`, the root first and every parent before its children.
    ///
    /// # Errors
    /// [`SkeletonError`] if the joints are not one tree in that order, or if a number is not finite.
    pub fn new(joints: Vec<SkeletonJoint>) -> Result<Self, SkeletonError> {
        if joints.is_empty() {
            return Err(SkeletonError::Empty);
        }
        let mut children = vec![Vec::new(); joints.len()];
        for (index, joint) in joints.iter().enumerate() {
            let name = || joint.name.clone();
            match joint.parent {
                None if index > 0 => {
                    return Err(SkeletonError::Root { index, name: name() });
                }
                Some(_) if index == 0 => {
                    return Err(SkeletonError::Root { index, name: name() });
                }
                Some(parent) if parent >= index => {
                    return Err(SkeletonError::Parent {
                        index,
                        name: name(),
                        parent,
                    });
                }
                Some(parent) => children[parent].push(index),
                None => {}
            }
            let finite =
                joint.offset.is_finite() && joint.tip.is_none_or(DVec3::is_finite) && joint.rest.is_normalized();
            if !finite {
                return Err(SkeletonError::Value { index, name: name() });
            }
        }
        Ok(Self { joints, children })
    }

    /// Returns the joints, the root first.
    #[must_use]
    pub fn skeleton_joints(&self) -> &[SkeletonJoint] {
        &self.joints
    }

    /// Returns how many joints there are; never zero.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a skeleton is never empty")]
    pub fn len(&self) -> usize {
        self.joints.len()
    }

    /// Returns the joint at `index`.
    ///
    /// # Panics
    /// Panics if `index` is not below [`len`](Self::len).
    #[must_use]
    pub fn joint_at(&self, index: usize) -> &SkeletonJoint {
        &self.joints[index]
    }

    /// Returns the joints whose parent is `index`, in order.
    #[must_use]
    pub fn joint_children(&self, index: usize) -> &[usize] {
        &self.children[index]
    }

    /// Returns the parent of `index`.
    #[must_use]
    pub fn joint_parent(&self, index: usize) -> Option<usize> {
        self.joints[index].parent
    }

    /// Returns the first joint whose name is exactly `name`.
    #[must_use]
    pub fn find_joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Returns the joints from `index` up to the root, `index` first.
    pub fn joint_ancestors(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(index), |&joint| self.joint_parent(joint))
    }

    /// Returns `index` and all its descendants, parents first.
    #[must_use]
    pub fn joint_subtree(&self, index: usize) -> Vec<usize> {
        let mut inside = vec![false; self.len()];
        inside[index] = true;
        for joint in index + 1..self.len() {
            inside[joint] = self.joint_parent(joint).is_some_and(|parent| inside[parent]);
        }
        (index..self.len()).filter(|&joint| inside[joint]).collect()
    }

    /// Returns the posture at rest, in local space.
    #[must_use]
    pub fn rest_pose(&self) -> LocalPose {
        LocalPose {
            rotations: self.joints.iter().map(|joint| joint.rest).collect(),
            translations: self.joints.iter().map(|joint| joint.offset).collect(),
        }
    }

    /// Returns the posture at rest, in model space.
    #[must_use]
    pub fn rest_model_pose(&self) -> ModelPose {
        ModelPose::from_local_pose(self, &self.rest_pose())
    }
}

impl TryFrom<Vec<SkeletonJoint>> for Skeleton {
    type Error = SkeletonError;
    fn try_from(joints: Vec<SkeletonJoint>) -> Result<Self, SkeletonError> {
        Self::new(joints)
    }
}

impl From<Skeleton> for Vec<SkeletonJoint> {
    fn from(skeleton: Skeleton) -> Self {
        skeleton.joints
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_that_form_no_tree_are_refused_by_name() {
        let joint = |name: &str, parent| SkeletonJoint::new(name, parent, DVec3::Y);
        for (joints, want) in [
            (vec![], "at least one joint"),
            (vec![joint("a", Some(0))], "second root"),
            (
                vec![joint("a", None), joint("b", None)],
                "joint 1 (\"b\") is a second root",
            ),
            (vec![joint("a", None), joint("b", Some(1))], "names parent 1"),
            (vec![joint("a", None), joint("b", Some(7))], "names parent 7"),
            (vec![SkeletonJoint::new("a", None, DVec3::NAN)], "no number"),
        ] {
            let error = Skeleton::new(joints).expect_err(want).to_string();
            assert!(error.contains(want), "{error}");
        }
    }

    #[test]
    fn a_subtree_holds_all_descendants() {
        let parents = [None, Some(0), Some(1), Some(0), Some(2), Some(3)];
        let joints = parents.map(|parent| SkeletonJoint::new("j", parent, DVec3::Y)).to_vec();
        let skeleton = Skeleton::new(joints).expect("a tree");
        assert_eq!(skeleton.joint_subtree(1), [1, 2, 4]);
        assert_eq!(skeleton.joint_subtree(0), [0, 1, 2, 3, 4, 5]);
        assert_eq!(skeleton.joint_ancestors(4).collect::<Vec<_>>(), [4, 2, 1, 0]);
        assert_eq!(skeleton.joint_children(0), [1, 3]);
    }
}
