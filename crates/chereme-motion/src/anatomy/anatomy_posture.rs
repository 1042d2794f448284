//! The posture in which skins are bound to a skeleton and avatars rest, built from bone lengths and parts.

use glam::{DQuat, DVec3};

use super::{BodyAnatomy, BodyPart};
use crate::hand::{BodySide, HandFinger};
use crate::pose::{LocalPose, ModelPose};
use crate::skeleton::Skeleton;

/// The angle in radians from which the trunk of a rest pose does not stand, or does not face +Z.
const LYING_ANGLE_RADIANS: f64 = 0.5;

/// Returns the direction of a stretched arm.
fn stretched_arm_direction(side: BodySide) -> DVec3 {
    DVec3::X * side.side_sign()
}

impl BodyAnatomy {
    /// Returns the T-pose of the skeleton: upright, facing +Z, arms along X with palms down, thumbs between X and +Z.
    ///
    /// It begins with the rest pose, or with the reference posture if no body can rest so: many files keep every bone
    /// along one axis.
    #[must_use]
    pub fn t_pose(&self, skeleton: &Skeleton) -> ModelPose {
        let mut pose = skeleton.rest_pose();
        let is_at_rest = self.is_measured_at_rest(skeleton);
        if !is_at_rest {
            // Only rotations are taken: bone lengths and the root's place stay those of the file.
            pose.rotations = self.measured_pose.to_local(skeleton).rotations;
        }
        let mut stance = PostureBuilder {
            skeleton,
            model: ModelPose::from_local_pose(skeleton, &pose),
            pose,
        };
        let joint = |part: BodyPart| self.part_joint(part);
        let can_rest = self.posed && is_at_rest;
        // The trunk of a body at rest leans a little; one that lies, or faces another direction, is put upright.
        let trunk = self.body_frame(&stance.model);
        if let Some((hips, upright)) =
            joint(BodyPart::Hips).zip(trunk.map(|frame| frame.body_frame_rotation().inverse()))
            && (!can_rest || upright.angle_between(DQuat::IDENTITY) > LYING_ANGLE_RADIANS)
        {
            stance.turn_posture_joint(hips, upright);
        }
        for (from, to, direction) in self.straight_bones(can_rest) {
            let now = stance.model.model_joint_position(to) - stance.model.model_joint_position(from);
            let Some(now) = now.try_normalize() else {
                continue;
            };
            stance.turn_posture_joint(from, DQuat::from_rotation_arc(now, direction));
            let side = BodySide::BOTH_SIDES
                .into_iter()
                .find(|&side| joint(BodyPart::Hand(side)) == Some(from));
            // The palm is turned down after its bone is straight, since the turn is about the arm.
            if let Some(turn) = side.and_then(|side| self.palm_down(side, &stance.model)) {
                stance.turn_posture_joint(from, turn);
            }
        }
        stance.model
    }

    /// Returns the posture in which a skin is bound: the rest pose, or if no body can rest so, the T-pose that follows
    /// from the reference posture.
    #[must_use]
    pub fn bind_pose(&self, skeleton: &Skeleton) -> ModelPose {
        match self.is_measured_at_rest(skeleton) {
            true => skeleton.rest_model_pose(),
            false => self.t_pose(skeleton),
        }
    }

    fn is_measured_at_rest(&self, skeleton: &Skeleton) -> bool {
        self.measured_pose == skeleton.rest_model_pose()
    }

    /// Returns the bones of the T-pose from the hips outwards: two joints, and the direction from one to the other.
    fn straight_bones(&self, can_rest: bool) -> Vec<(usize, usize, DVec3)> {
        let joint = |part: BodyPart| self.part_joint(part);
        let mut bones = Vec::new();
        let mut add = |from: BodyPart, to: BodyPart, direction: DVec3| {
            bones.extend(joint(from).zip(joint(to)).map(|(from, to)| (from, to, direction)));
        };
        if !can_rest {
            // The neck stays as it is, so that the head looks ahead as in the reference.
            let mut spine = vec![BodyPart::Hips, BodyPart::Spine, BodyPart::Chest, BodyPart::Neck];
            spine.retain(|&part| joint(part).is_some());
            spine.dedup_by_key(|part| joint(*part));
            for pair in spine.windows(2).skip(1) {
                add(pair[0], pair[1], DVec3::Y);
            }
        }
        // From the trunk outwards, since a turn carries everything below it.
        for side in [BodySide::Left, BodySide::Right] {
            let out = stretched_arm_direction(side);
            add(BodyPart::UpperArm(side), BodyPart::Forearm(side), out);
            add(BodyPart::Forearm(side), BodyPart::Hand(side), out);
            let middle = BodyPart::Finger(side, HandFinger::Middle, 1);
            add(BodyPart::Hand(side), middle, out);
            for finger in HandFinger::ALL_FINGERS {
                for at in 1..3 {
                    let bone = [at, at + 1].map(|at| BodyPart::Finger(side, finger, at));
                    add(bone[0], bone[1], out);
                }
            }
            let thumb = (out + DVec3::Z).normalize();
            for at in 0..2 {
                add(BodyPart::Thumb(side, at), BodyPart::Thumb(side, at + 1), thumb);
            }
            add(BodyPart::Thigh(side), BodyPart::Shin(side), DVec3::NEG_Y);
            add(BodyPart::Shin(side), BodyPart::Foot(side), DVec3::NEG_Y);
        }
        bones
    }

    /// Returns the turn about a stretched arm that makes its palm face down: the knuckle of the index is in front.
    fn palm_down(&self, side: BodySide, model: &ModelPose) -> Option<DQuat> {
        let knuckle = |finger| Some(model.model_joint_position(self.part_joint(BodyPart::Finger(side, finger, 1))?));
        let out = stretched_arm_direction(side);
        let knuckle_line = knuckle(HandFinger::Index)? - knuckle(HandFinger::Little)?;
        let across = knuckle_line.reject_from_normalized(out).try_normalize()?;
        let angle = across.cross(DVec3::Z).dot(out).atan2(across.dot(DVec3::Z));
        Some(DQuat::from_axis_angle(out, angle))
    }
}

/// A posture under construction, in local and in model space.
struct PostureBuilder<'a> {
    skeleton: &'a Skeleton,
    pose: LocalPose,
    model: ModelPose,
}

impl PostureBuilder<'_> {
    /// Turns a joint in model space, with everything that it carries.
    fn turn_posture_joint(&mut self, joint: usize, by: DQuat) {
        let parent = self.skeleton.joint_parent(joint);
        let above = parent.map_or(DQuat::IDENTITY, |above| self.model.model_joint_rotation(above));
        // The turn is in model space and the local rotation in the parent's.
        let turned = above.inverse() * by * self.model.model_joint_rotation(joint);
        self.pose.rotations[joint] = turned.normalize();
        self.model.set_local_pose(self.skeleton, &self.pose);
    }
}
