//! The parts of the body that a skeleton's joints stand for, and the measures and directions that follow.
//!
//! ```
//! use chereme_motion::anatomy::{BodyAnatomy, BodyPart};
//! use chereme_motion::{SkeletonJoint, BodySide, Skeleton, glam::DVec3};
//!
//! let skeleton = Skeleton::new(vec![
//!     SkeletonJoint::new("mixamorig:RightArm", None, DVec3::ZERO),
//!     SkeletonJoint::new("mixamorig:RightForeArm", Some(0), DVec3::new(-0.28, 0.0, 0.0)),
//!     SkeletonJoint::new("mixamorig:RightHand", Some(1), DVec3::new(-0.25, 0.0, 0.0)),
//! ])?;
//! let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
//! assert_eq!(anatomy.part_joint(BodyPart::Hand(BodySide::Right)), Some(2));
//! assert!(anatomy.arm_chain(BodySide::Right).is_some() && anatomy.arm_chain(BodySide::Left).is_none());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | holds |
//! |---|---|
//! | `part` | the parts of the body and their names |
//! | `names` | the meaning of joint names, in common conventions |
//! | `detect` | parts found by name |
//! | `markers` | optical markers beside a skeleton, which are not parts |
//! | `topology` | parts found by the hierarchy of joints |
//! | `roles` | the user's assignment of joints to parts |
//! | `measures` | the size of the body, the frame of the trunk |
//! | `posture` | the T-pose, in which skins are bound and avatars rest |
//! | `tips` | the ends of thumbs and fingers, and impossible lengths of their bones |
//! | `convention` | the unit and axes a skeleton was written in |
//! | `landmarks` | places on the body |
//! | `range` | the angles of straight and fully bent fingers, from a signer's own takes |
//! | `fingers` | conversion between finger angles and local rotations, directions of the hand |

mod anatomy_detect;
mod anatomy_markers;
mod anatomy_names;
mod anatomy_posture;
mod anatomy_roles;
mod convention;
mod fingers;
mod landmarks;
mod languages;
mod measures;
mod part;
mod range;
mod tips;
mod topology;

#[cfg(test)]
pub(crate) mod tests;

use std::collections::BTreeMap;

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};

pub use anatomy_roles::{AssignedJointRoles, RolesError};
pub use convention::ConventionGuess;
pub use measures::{BodyFrame, BodyMeasures};
pub use part::{BodyPart, PartError};
pub use range::{HandCorrection, HandRange};
pub use tips::OddTip;

use crate::clip::Clip;
use crate::hand::{BodySide, HandFinger};
use crate::pose::ModelPose;
use crate::skeleton::Skeleton;

/// How a part's joint was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PartEvidence {
    /// By the user's assignment.
    Roles,
    /// By the joint's name.
    Name,
    /// By its position in the hierarchy of joints.
    Topology,
}

/// A part that could be any of several joints, or a joint whose side is unknown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PartAmbiguity {
    /// The part.
    pub part: BodyPart,
    /// The joint that was chosen.
    pub taken: usize,
    /// Other joints whose names have the same meaning; empty if only the side is unknown.
    pub others: Vec<usize>,
}

/// The joints of an arm, from the body outwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ArmChain {
    /// The joint of the collar bone, if any.
    pub clavicle: Option<usize>,
    /// The shoulder.
    pub upper: usize,
    /// The elbow.
    pub forearm: usize,
    /// The wrist.
    pub hand: usize,
}

/// The assignment of a skeleton's joints to parts of the body.
///
/// It belongs to the skeleton that it was detected in: indices are that skeleton's, and methods that take a skeleton or
/// a posture expect the same one.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyAnatomy {
    found: BTreeMap<BodyPart, (usize, PartEvidence)>,
    parts: Vec<Option<BodyPart>>,
    ambiguous: Vec<PartAmbiguity>,
    parents: Vec<Option<usize>>,
    markers: Vec<usize>,
    hands: [Option<fingers::HandFrame>; 2],
    hand_tips: [Option<DVec3>; 2],
    measures: Option<BodyMeasures>,
    head: Option<landmarks::HeadFrame>,
    elbows: [Option<DVec3>; 2],
    /// The posture in which the body was measured.
    measured_pose: ModelPose,
    posed: bool,
    /// Joints that only end a digit, impossibly far away.
    far_ends: Vec<usize>,
}

/// The least distance of the shoulder joints in a possible posture, as a share of the body's own.
const MIN_SHOULDER_DISTANCE_SHARE: f64 = 0.3;

/// Returns the index of a side in pairs, right first.
fn side_pair_index(side: BodySide) -> usize {
    usize::from(side == BodySide::Left)
}

impl BodyAnatomy {
    /// Finds the parts of the body by joint names, and by topology and side if names do not decide.
    #[must_use]
    pub fn detect_anatomy(skeleton: &Skeleton) -> Self {
        Self::from_detected_parts(skeleton, anatomy_detect::detect_body_parts(skeleton, &BTreeMap::new()))
    }

    /// Finds the parts of the body like [`detect_anatomy`](Self::detect_anatomy), with the user's assignments first.
    ///
    /// # Errors
    /// [`RolesError`] if the roles name a joint that the skeleton does not have.
    pub fn with_roles(skeleton: &Skeleton, roles: &AssignedJointRoles) -> Result<Self, RolesError> {
        let assignments = roles.resolve_joint_roles(skeleton)?;
        Ok(Self::from_detected_parts(
            skeleton,
            anatomy_detect::detect_body_parts(skeleton, &assignments),
        ))
    }

    fn from_detected_parts(skeleton: &Skeleton, detected: anatomy_detect::DetectedParts) -> Self {
        let mut parts = vec![None; skeleton.len()];
        for (&part, &(joint, _)) in &detected.found {
            parts[joint] = Some(part);
        }
        let mut anatomy = Self {
            parents: (0..skeleton.len()).map(|j| skeleton.joint_parent(j)).collect(),
            found: detected.found,
            ambiguous: detected.ambiguous,
            markers: detected.markers,
            parts,
            hands: [None, None],
            hand_tips: [None, None],
            measures: None,
            head: None,
            elbows: [None, None],
            measured_pose: skeleton.rest_model_pose(),
            posed: false,
            far_ends: Vec::new(),
        };
        let is_long = |&joint: &usize| anatomy.odd_tip(skeleton, joint) == Some(OddTip::Long);
        let long = (0..skeleton.len()).filter(is_long);
        anatomy.far_ends = long.flat_map(|joint| skeleton.joint_children(joint).to_vec()).collect();
        for side in BodySide::BOTH_SIDES {
            anatomy.hands[side_pair_index(side)] = fingers::HandFrame::from_hand_anatomy(&anatomy, skeleton, side);
            let hand = anatomy.part_joint(BodyPart::Hand(side));
            anatomy.hand_tips[side_pair_index(side)] = hand
                .and_then(|hand| skeleton.joint_at(hand).tip)
                .filter(|tip| tip.try_normalize().is_some());
        }
        let rest = anatomy.measured_pose.clone();
        anatomy.with_reference(skeleton, &rest)
    }

    /// Returns the same anatomy, measured in the posture `model` instead of the rest pose.
    ///
    /// Pass a posture in which the signer stands upright and looks ahead if [`is_posed`](Self::is_posed) returns
    /// false: many files keep every bone along one local axis and put the body together by rotations only. The
    /// hands' geometry is always that of the rest pose.
    #[must_use]
    pub fn with_reference(mut self, skeleton: &Skeleton, model: &ModelPose) -> Self {
        self.measures = BodyMeasures::measure_body(&self, skeleton, model);
        let axes = measures::trunk_axes(&self, model);
        self.posed = axes.is_some_and(|[_, up, _]| {
            self.has_breadth(model) && !self.arms_stick_out(model, up) && self.can_stand(model, up)
        });
        let turned = axes.map(|[left, up, forward]| DQuat::from_mat3(&DMat3::from_cols(left, up, forward)).normalize());
        self.head = turned
            .zip(self.measures)
            .and_then(|(axes, measures)| landmarks::HeadFrame::from_head_anatomy(&self, model, axes, &measures));
        self.elbows = BodySide::BOTH_SIDES.map(|side| self.elbow_at(side, model, axes?[2]));
        self.measured_pose.clone_from(model);
        self
    }

    /// Returns whether the shoulders are not in one place, as they are if both collar bones lie along the spine.
    fn has_breadth(&self, model: &ModelPose) -> bool {
        let shoulders = BodySide::BOTH_SIDES.map(|side| self.part_joint(BodyPart::UpperArm(side)));
        let ([Some(right), Some(left)], Some(measures)) = (shoulders, self.measures) else {
            return true;
        };
        model
            .model_joint_position(right)
            .distance(model.model_joint_position(left))
            > MIN_SHOULDER_DISTANCE_SHARE * measures.shoulder_width
    }

    fn arms_stick_out(&self, model: &ModelPose, up: DVec3) -> bool {
        let directions = BodySide::BOTH_SIDES.map(|side| {
            let arm = self.arm_chain(side)?;
            (model.model_joint_position(arm.forearm) - model.model_joint_position(arm.upper)).try_normalize()
        });
        let [Some(right), Some(left)] = directions else {
            return false;
        };
        right.dot(left) > 0.9 && right.dot(up).abs() < 0.5
    }

    /// Returns whether no leg points up, and not one arm straight up and the other down. Both happen if every bone lies
    /// along one local axis, and only the trunk's bones have places of their own.
    fn can_stand(&self, model: &ModelPose, up: DVec3) -> bool {
        let rise = |from: BodyPart, to: BodyPart| {
            let bone =
                model.model_joint_position(self.part_joint(to)?) - model.model_joint_position(self.part_joint(from)?);
            Some(bone.try_normalize()?.dot(up))
        };
        let legs = BodySide::BOTH_SIDES.map(|side| rise(BodyPart::Thigh(side), BodyPart::Shin(side)));
        let arms = BodySide::BOTH_SIDES.map(|side| rise(BodyPart::UpperArm(side), BodyPart::Forearm(side)));
        let opposite = match arms {
            [Some(right), Some(left)] => right * left < -0.64,
            _ => false,
        };
        !opposite && legs.into_iter().flatten().all(|rise| rise < 0.5)
    }

    /// Returns the direction in which the elbow points, in the upper arm's space: as it is bent in `model`; if it is
    /// straight, the opposite of the direction that the body faces. Returns `None` if a straight arm is parallel to
    /// that direction.
    fn elbow_at(&self, side: BodySide, model: &ModelPose, forward: DVec3) -> Option<DVec3> {
        let arm = self.arm_chain(side)?;
        let joint_place = |joint| model.model_joint_position(joint);
        let line = (joint_place(arm.hand) - joint_place(arm.upper)).try_normalize()?;
        let upper = joint_place(arm.forearm) - joint_place(arm.upper);
        let bent = upper.reject_from_normalized(line);
        let sine = bent.length() / upper.length().max(f64::MIN_POSITIVE);
        let elbow_direction = if sine > 0.09 {
            bent
        } else {
            -forward.reject_from_normalized(line)
        };
        let out = (sine > 0.09 || elbow_direction.length() > 0.3).then_some(elbow_direction)?;
        Some(model.model_joint_rotation(arm.upper).inverse() * out.try_normalize()?)
    }

    /// Returns the same anatomy with the first frame of `clip` as its reference if the rest pose is not possible for a
    /// body; the clip must have the same skeleton.
    #[must_use]
    pub fn with_clip(self, clip: &Clip) -> Self {
        if self.posed || clip.clip_frame_count() == 0 {
            return self;
        }
        self.with_reference(clip.clip_skeleton(), &clip.model_pose(0))
    }

    /// Returns whether the reference posture is possible for a body: it shows up, left and forward, the shoulders are
    /// apart, the arms do not both point sideways in the same direction nor one up and one down, and no leg points up.
    #[must_use]
    pub fn is_posed(&self) -> bool {
        self.posed
    }

    /// Returns the posture in which the body was measured.
    #[must_use]
    pub fn measured_pose(&self) -> &ModelPose {
        &self.measured_pose
    }

    /// Returns the size of the body; `None` if the skeleton has no arm, leg or hand.
    #[must_use]
    pub fn anatomy_measures(&self) -> Option<BodyMeasures> {
        self.measures
    }

    /// Returns the unit vector in which the elbow of `side` points, in the space of the upper arm's joint and
    /// perpendicular to the arm: the opposite of the direction in which it bends. Returns `None` if it is unknown.
    #[must_use]
    pub fn elbow_direction(&self, side: BodySide) -> Option<DVec3> {
        self.elbows[side_pair_index(side)]
    }

    fn hand_frame(&self, side: BodySide) -> Option<&fingers::HandFrame> {
        self.hands[side_pair_index(side)].as_ref()
    }

    /// Returns the joint of `part`; spine and chest may be one joint.
    #[must_use]
    pub fn part_joint(&self, part: BodyPart) -> Option<usize> {
        self.found.get(&part).map(|&(joint, _)| joint)
    }

    /// Returns how the joint of `part` was found.
    #[must_use]
    pub fn part_evidence(&self, part: BodyPart) -> Option<PartEvidence> {
        self.found.get(&part).map(|&(_, evidence)| evidence)
    }

    /// Returns the part of `joint`; the chest if the joint is both spine and chest.
    #[must_use]
    pub fn part_of(&self, joint: usize) -> Option<BodyPart> {
        self.parts.get(joint).copied().flatten()
    }

    /// Returns every part found, with its joint and its evidence, in the order of parts.
    pub fn found_parts(&self) -> impl Iterator<Item = (BodyPart, usize, PartEvidence)> + '_ {
        self.found.iter().map(|(&part, &(joint, how))| (part, joint, how))
    }

    /// Returns the usual parts of a signing body that were not found, in the order of parts.
    #[must_use]
    pub fn missing_parts(&self) -> Vec<BodyPart> {
        let mut all = BodyPart::all_body_parts();
        all.retain(|part| part.is_usual() && !self.found.contains_key(part));
        all
    }

    /// Returns the parts that names do not determine, in the order of parts.
    #[must_use]
    pub fn ambiguous_parts(&self) -> &[PartAmbiguity] {
        &self.ambiguous
    }

    /// Returns the joints that are optical markers beside the skeleton, in order; they have no part.
    #[must_use]
    pub fn marker_joints(&self) -> &[usize] {
        &self.markers
    }

    /// Returns the arm of `side` if shoulder, elbow and wrist are found and form a chain.
    #[must_use]
    pub fn arm_chain(&self, side: BodySide) -> Option<ArmChain> {
        let upper = self.part_joint(BodyPart::UpperArm(side))?;
        let forearm = self.part_joint(BodyPart::Forearm(side))?;
        let hand = self.part_joint(BodyPart::Hand(side))?;
        let joined = self.is_below(forearm, upper) && self.is_below(hand, forearm);
        let clavicle = self
            .part_joint(BodyPart::Clavicle(side))
            .filter(|&joint| self.is_below(upper, joint));
        joined.then_some(ArmChain {
            clavicle,
            upper,
            forearm,
            hand,
        })
    }

    /// Returns the joints from collar bone to wrist that were found, with those between them.
    #[must_use]
    pub fn arm_joints(&self, side: BodySide) -> Vec<usize> {
        let parts = [
            BodyPart::Clavicle(side),
            BodyPart::UpperArm(side),
            BodyPart::Forearm(side),
            BodyPart::Hand(side),
        ];
        let mut found_joints: Vec<usize> = parts.iter().filter_map(|&part| self.part_joint(part)).collect();
        if let (Some(&first), Some(&last)) = (found_joints.first(), found_joints.last())
            && self.is_below(last, first)
        {
            found_joints.extend(self.up_from(last).take_while(|&joint| joint != first));
        }
        found_joints.sort_unstable();
        found_joints.dedup();
        found_joints
    }

    /// Returns all joints below the wrist of `side`, parents first: the channel of the fingers.
    #[must_use]
    pub fn finger_joints(&self, side: BodySide) -> Vec<usize> {
        let Some(hand) = self.part_joint(BodyPart::Hand(side)) else {
            return Vec::new();
        };
        let mut inside = vec![false; self.parents.len()];
        inside[hand] = true;
        for joint in hand + 1..inside.len() {
            inside[joint] = self.parents[joint].is_some_and(|parent| inside[parent]);
        }
        (hand + 1..inside.len()).filter(|&joint| inside[joint]).collect()
    }

    /// Returns the joints below the wrist of `side` that can be where they are, parents first: without ends impossibly far
    /// away, which pictures and measures draw in.
    #[must_use]
    pub fn possible_fingers(&self, side: BodySide) -> Vec<usize> {
        let mut fingers = self.finger_joints(side);
        fingers.retain(|joint| !self.far_ends.contains(joint));
        fingers
    }

    /// Returns whether the base joints of all four fingers of `side` are found.
    #[must_use]
    pub fn has_fingers(&self, side: BodySide) -> bool {
        HandFinger::ALL_FINGERS
            .iter()
            .all(|&finger| self.found.contains_key(&BodyPart::Finger(side, finger, 1)))
    }

    /// Returns for each joint its counterpart on the other side: itself for a joint in the middle, `None` if the other
    /// side has no such joint. A joint that is no part of the body is paired by its name with the sides exchanged, or
    /// by its order below paired parents.
    #[must_use]
    pub fn mirror_map(&self, skeleton: &Skeleton) -> Vec<Option<usize>> {
        anatomy_detect::mirror_map(self, skeleton)
    }

    fn up_from(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(joint), |&joint| self.parents[joint])
    }

    /// Returns whether `joint` is `above` or a descendant of it.
    fn is_below(&self, joint: usize, above: usize) -> bool {
        self.up_from(joint).any(|joint| joint == above)
    }
}
