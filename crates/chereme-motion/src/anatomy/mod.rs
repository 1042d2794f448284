//! The parts of the body that a skeleton's joints stand for, and the measures and directions that follow.
//!
//! ```
//! use chereme_motion::anatomy::{Anatomy, Part};
//! use chereme_motion::{Joint, Side, Skeleton, glam::DVec3};
//!
//! let skeleton = Skeleton::new(vec![
//!     Joint::new("mixamorig:RightArm", None, DVec3::ZERO),
//!     Joint::new("mixamorig:RightForeArm", Some(0), DVec3::new(-0.28, 0.0, 0.0)),
//!     Joint::new("mixamorig:RightHand", Some(1), DVec3::new(-0.25, 0.0, 0.0)),
//! ])?;
//! let anatomy = Anatomy::detect(&skeleton);
//! assert_eq!(anatomy.joint(Part::Hand(Side::Right)), Some(2));
//! assert!(anatomy.arm(Side::Right).is_some() && anatomy.arm(Side::Left).is_none());
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

mod convention;
mod detect;
mod fingers;
mod landmarks;
mod languages;
mod markers;
mod measures;
mod names;
mod part;
mod posture;
mod range;
mod roles;
mod tips;
mod topology;

#[cfg(test)]
pub(crate) mod fixtures;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};

pub use convention::{ConventionGuess, detect_convention};
pub use measures::{BodyFrame, Measures};
pub use part::{Part, PartError};
pub use range::{HandCorrection, HandRange};
pub use roles::{Roles, RolesError};
pub use tips::OddTip;

use crate::clip::Clip;
use crate::hand::{Finger, Side};
use crate::pose::ModelPose;
use crate::skeleton::Skeleton;

/// How a part's joint was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Evidence {
    /// By the user's assignment.
    Roles,
    /// By the joint's name.
    Name,
    /// By its position in the hierarchy of joints.
    Topology,
}

/// A part that could be any of several joints, or a joint whose side is unknown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ambiguity {
    /// The part.
    pub part: Part,
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
pub struct Anatomy {
    found: BTreeMap<Part, (usize, Evidence)>,
    parts: Vec<Option<Part>>,
    ambiguous: Vec<Ambiguity>,
    parents: Vec<Option<usize>>,
    markers: Vec<usize>,
    hands: [Option<fingers::HandFrame>; 2],
    hand_tips: [Option<DVec3>; 2],
    measures: Option<Measures>,
    head: Option<landmarks::HeadFrame>,
    elbows: [Option<DVec3>; 2],
    /// The posture in which the body was measured.
    measured_pose: ModelPose,
    posed: bool,
    /// Joints that only end a digit, impossibly far away.
    far_ends: Vec<usize>,
}

/// The least distance of the shoulder joints in a possible posture, as a share of the body's own.
const NARROW: f64 = 0.3;

/// Returns the index of a side in pairs, right first.
fn place(side: Side) -> usize {
    usize::from(side == Side::Left)
}

impl Anatomy {
    /// Finds the parts of the body by joint names, and by topology and side if names do not decide.
    #[must_use]
    pub fn detect(skeleton: &Skeleton) -> Self {
        Self::of(skeleton, detect::detect(skeleton, &BTreeMap::new()))
    }

    /// Finds the parts of the body like [`detect`](Self::detect), with the user's assignments first.
    ///
    /// # Errors
    /// [`RolesError`] if the roles name a joint that the skeleton does not have.
    pub fn with_roles(skeleton: &Skeleton, roles: &Roles) -> Result<Self, RolesError> {
        let assignments = roles.resolve(skeleton)?;
        Ok(Self::of(skeleton, detect::detect(skeleton, &assignments)))
    }

    fn of(skeleton: &Skeleton, detected: detect::Detected) -> Self {
        let mut parts = vec![None; skeleton.len()];
        for (&part, &(joint, _)) in &detected.found {
            parts[joint] = Some(part);
        }
        let mut anatomy = Self {
            parents: (0..skeleton.len()).map(|j| skeleton.parent(j)).collect(),
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
        anatomy.far_ends = long
            .flat_map(|joint| skeleton.children(joint).to_vec())
            .collect();
        for side in Side::BOTH {
            anatomy.hands[place(side)] = fingers::HandFrame::of(&anatomy, skeleton, side);
            let hand = anatomy.joint(Part::Hand(side));
            anatomy.hand_tips[place(side)] = hand
                .and_then(|hand| skeleton.joint(hand).tip)
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
        self.measures = Measures::of(&self, skeleton, model);
        let axes = measures::trunk_axes(&self, model);
        self.posed = axes.is_some_and(|[_, up, _]| {
            self.has_breadth(model) && !self.arms_stick_out(model, up) && self.can_stand(model, up)
        });
        let turned = axes.map(|[left, up, forward]| {
            DQuat::from_mat3(&DMat3::from_cols(left, up, forward)).normalize()
        });
        self.head = turned
            .zip(self.measures)
            .and_then(|(axes, measures)| landmarks::HeadFrame::of(&self, model, axes, &measures));
        self.elbows = Side::BOTH.map(|side| self.elbow_at(side, model, axes?[2]));
        self.measured_pose.clone_from(model);
        self
    }

    /// Returns whether the shoulders are not in one place, as they are if both collar bones lie along the spine.
    fn has_breadth(&self, model: &ModelPose) -> bool {
        let shoulders = Side::BOTH.map(|side| self.joint(Part::UpperArm(side)));
        let ([Some(right), Some(left)], Some(measures)) = (shoulders, self.measures) else {
            return true;
        };
        model.position(right).distance(model.position(left)) > NARROW * measures.shoulder_width
    }

    fn arms_stick_out(&self, model: &ModelPose, up: DVec3) -> bool {
        let directions = Side::BOTH.map(|side| {
            let arm = self.arm(side)?;
            (model.position(arm.forearm) - model.position(arm.upper)).try_normalize()
        });
        let [Some(right), Some(left)] = directions else {
            return false;
        };
        right.dot(left) > 0.9 && right.dot(up).abs() < 0.5
    }

    /// Returns whether no leg points up, and not one arm straight up and the other down. Both happen if every bone lies
    /// along one local axis, and only the trunk's bones have places of their own.
    fn can_stand(&self, model: &ModelPose, up: DVec3) -> bool {
        let rise = |from: Part, to: Part| {
            let bone = model.position(self.joint(to)?) - model.position(self.joint(from)?);
            Some(bone.try_normalize()?.dot(up))
        };
        let legs = Side::BOTH.map(|side| rise(Part::Thigh(side), Part::Shin(side)));
        let arms = Side::BOTH.map(|side| rise(Part::UpperArm(side), Part::Forearm(side)));
        let opposite = match arms {
            [Some(right), Some(left)] => right * left < -0.64,
            _ => false,
        };
        !opposite && legs.into_iter().flatten().all(|rise| rise < 0.5)
    }

    /// Returns the direction in which the elbow points, in the upper arm's space: as it is bent in `model`; if it is
    /// straight, the opposite of the direction that the body faces. Returns `None` if a straight arm is parallel to
    /// that direction.
    fn elbow_at(&self, side: Side, model: &ModelPose, forward: DVec3) -> Option<DVec3> {
        let arm = self.arm(side)?;
        let at = |joint| model.position(joint);
        let line = (at(arm.hand) - at(arm.upper)).try_normalize()?;
        let upper = at(arm.forearm) - at(arm.upper);
        let bent = upper.reject_from_normalized(line);
        let sine = bent.length() / upper.length().max(f64::MIN_POSITIVE);
        let out = if sine > 0.09 {
            bent
        } else {
            -forward.reject_from_normalized(line)
        };
        let out = (sine > 0.09 || out.length() > 0.3).then_some(out)?;
        Some(model.rotation(arm.upper).inverse() * out.try_normalize()?)
    }

    /// Returns the same anatomy with the first frame of `clip` as its reference if the rest pose is not possible for a
    /// body; the clip must have the same skeleton.
    #[must_use]
    pub fn with_clip(self, clip: &Clip) -> Self {
        if self.posed || clip.frames() == 0 {
            return self;
        }
        self.with_reference(clip.skeleton(), &clip.model_pose(0))
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
    pub fn measures(&self) -> Option<Measures> {
        self.measures
    }

    /// Returns the unit vector in which the elbow of `side` points, in the space of the upper arm's joint and
    /// perpendicular to the arm: the opposite of the direction in which it bends. Returns `None` if it is unknown.
    #[must_use]
    pub fn elbow(&self, side: Side) -> Option<DVec3> {
        self.elbows[place(side)]
    }

    fn hand_frame(&self, side: Side) -> Option<&fingers::HandFrame> {
        self.hands[place(side)].as_ref()
    }

    /// Returns the joint of `part`; spine and chest may be one joint.
    #[must_use]
    pub fn joint(&self, part: Part) -> Option<usize> {
        self.found.get(&part).map(|&(joint, _)| joint)
    }

    /// Returns how the joint of `part` was found.
    #[must_use]
    pub fn evidence(&self, part: Part) -> Option<Evidence> {
        self.found.get(&part).map(|&(_, evidence)| evidence)
    }

    /// Returns the part of `joint`; the chest if the joint is both spine and chest.
    #[must_use]
    pub fn part_of(&self, joint: usize) -> Option<Part> {
        self.parts.get(joint).copied().flatten()
    }

    /// Returns every part found, with its joint and its evidence, in the order of parts.
    pub fn found(&self) -> impl Iterator<Item = (Part, usize, Evidence)> + '_ {
        self.found
            .iter()
            .map(|(&part, &(joint, how))| (part, joint, how))
    }

    /// Returns the usual parts of a signing body that were not found, in the order of parts.
    #[must_use]
    pub fn missing(&self) -> Vec<Part> {
        let mut all = Part::all();
        all.retain(|part| part.is_usual() && !self.found.contains_key(part));
        all
    }

    /// Returns the parts that names do not determine, in the order of parts.
    #[must_use]
    pub fn ambiguous(&self) -> &[Ambiguity] {
        &self.ambiguous
    }

    /// Returns the joints that are optical markers beside the skeleton, in order; they have no part.
    #[must_use]
    pub fn markers(&self) -> &[usize] {
        &self.markers
    }

    /// Returns the arm of `side` if shoulder, elbow and wrist are found and form a chain.
    #[must_use]
    pub fn arm(&self, side: Side) -> Option<ArmChain> {
        let upper = self.joint(Part::UpperArm(side))?;
        let forearm = self.joint(Part::Forearm(side))?;
        let hand = self.joint(Part::Hand(side))?;
        let joined = self.is_below(forearm, upper) && self.is_below(hand, forearm);
        let clavicle = self
            .joint(Part::Clavicle(side))
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
    pub fn arm_joints(&self, side: Side) -> Vec<usize> {
        let parts = [
            Part::Clavicle(side),
            Part::UpperArm(side),
            Part::Forearm(side),
            Part::Hand(side),
        ];
        let mut found: Vec<usize> = parts.iter().filter_map(|&part| self.joint(part)).collect();
        if let (Some(&first), Some(&last)) = (found.first(), found.last())
            && self.is_below(last, first)
        {
            found.extend(self.up_from(last).take_while(|&joint| joint != first));
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Returns all joints below the wrist of `side`, parents first: the channel of the fingers.
    #[must_use]
    pub fn fingers(&self, side: Side) -> Vec<usize> {
        let Some(hand) = self.joint(Part::Hand(side)) else {
            return Vec::new();
        };
        let mut inside = vec![false; self.parents.len()];
        inside[hand] = true;
        for joint in hand + 1..inside.len() {
            inside[joint] = self.parents[joint].is_some_and(|parent| inside[parent]);
        }
        (hand + 1..inside.len())
            .filter(|&joint| inside[joint])
            .collect()
    }

    /// Returns the joints below the wrist of `side` that can be where they are, parents first: without ends impossibly far
    /// away, which pictures and measures draw in.
    #[must_use]
    pub fn possible_fingers(&self, side: Side) -> Vec<usize> {
        let mut fingers = self.fingers(side);
        fingers.retain(|joint| !self.far_ends.contains(joint));
        fingers
    }

    /// Returns whether the base joints of all four fingers of `side` are found.
    #[must_use]
    pub fn has_fingers(&self, side: Side) -> bool {
        Finger::ALL
            .iter()
            .all(|&finger| self.found.contains_key(&Part::Finger(side, finger, 1)))
    }

    /// Returns for each joint its counterpart on the other side: itself for a joint in the middle, `None` if the other
    /// side has no such joint. A joint that is no part of the body is paired by its name with the sides exchanged, or
    /// by its order below paired parents.
    #[must_use]
    pub fn mirror_map(&self, skeleton: &Skeleton) -> Vec<Option<usize>> {
        detect::mirror_map(self, skeleton)
    }

    fn up_from(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(joint), |&joint| self.parents[joint])
    }

    /// Returns whether `joint` is `above` or a descendant of it.
    fn is_below(&self, joint: usize, above: usize) -> bool {
        self.up_from(joint).any(|joint| joint == above)
    }
}
