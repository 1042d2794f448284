//! Which joint is what, whatever the skeleton calls it, and what follows from that.
//!
//! | module | holds |
//! |---|---|
//! | `part` | the parts of the body and their names |
//! | `names` | what joint names say, over the conventions people meet |
//! | `detect` | parts found by name, then by topology and side |
//! | `roles` | the user's word on it |

mod detect;
mod names;
mod part;
mod roles;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

pub use part::{Part, PartError};
pub use roles::{Roles, RolesError};

use crate::hand::{Finger, Side};
use crate::skeleton::Skeleton;

/// How a part's joint was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Evidence {
    /// The user said so.
    Roles,
    /// By the joint's name.
    Name,
    /// By its place among the other joints.
    Topology,
}

/// A part that could be more joints than one, or a joint whose side nothing tells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ambiguity {
    /// The part.
    pub part: Part,
    /// The joint that was taken.
    pub taken: usize,
    /// Other joints whose names say the same; empty where it is the side that is not told.
    pub others: Vec<usize>,
}

/// The joints of an arm, from the body outwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ArmChain {
    /// The collar bone's joint, where there is one.
    pub clavicle: Option<usize>,
    /// The shoulder.
    pub upper: usize,
    /// The elbow.
    pub forearm: usize,
    /// The wrist.
    pub hand: usize,
}

/// Which joint of a skeleton is which part of the body.
///
/// It belongs to the skeleton it was found in: indices are that skeleton's, and methods that take
/// a skeleton or a posture expect the same one.
#[derive(Debug, Clone, PartialEq)]
pub struct Anatomy {
    found: BTreeMap<Part, (usize, Evidence)>,
    parts: Vec<Option<Part>>,
    ambiguous: Vec<Ambiguity>,
    parents: Vec<Option<usize>>,
}

impl Anatomy {
    /// Finds the parts of the body by joint names, and by topology and side where they do not tell.
    #[must_use]
    pub fn detect(skeleton: &Skeleton) -> Self {
        Self::of(skeleton, detect::detect(skeleton, &BTreeMap::new()))
    }

    /// Finds the parts of the body as [`detect`](Self::detect) does, after the user's word.
    ///
    /// # Errors
    /// [`RolesError`] where the roles name a joint that the skeleton does not have.
    pub fn with_roles(skeleton: &Skeleton, roles: &Roles) -> Result<Self, RolesError> {
        let said = roles.resolve(skeleton)?;
        Ok(Self::of(skeleton, detect::detect(skeleton, &said)))
    }

    fn of(skeleton: &Skeleton, detected: detect::Detected) -> Self {
        let mut parts = vec![None; skeleton.len()];
        for (&part, &(joint, _)) in &detected.found {
            parts[joint] = Some(part);
        }
        Self {
            parents: (0..skeleton.len()).map(|j| skeleton.parent(j)).collect(),
            found: detected.found,
            ambiguous: detected.ambiguous,
            parts,
        }
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

    /// Returns the part that `joint` is; the chest where it is spine and chest.
    #[must_use]
    pub fn part_of(&self, joint: usize) -> Option<Part> {
        self.parts.get(joint).copied().flatten()
    }

    /// Returns every part found, with its joint and how it was found, in the order of parts.
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

    /// Returns the parts that names do not settle, in the order of parts.
    #[must_use]
    pub fn ambiguous(&self) -> &[Ambiguity] {
        &self.ambiguous
    }

    /// Returns the arm of `side` where shoulder, elbow and wrist are found and hang together.
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
        let below = |&joint: &usize| joint != hand && self.is_below(joint, hand);
        (0..self.parents.len()).filter(below).collect()
    }

    /// Returns whether the base joints of all four fingers of `side` are found.
    #[must_use]
    pub fn has_fingers(&self, side: Side) -> bool {
        Finger::ALL
            .iter()
            .all(|&finger| self.found.contains_key(&Part::Finger(side, finger, 1)))
    }

    /// Returns for each joint its counterpart on the other side: itself for one of the middle or
    /// one that no part or name places on a side, nothing where the other side has no such joint.
    #[must_use]
    pub fn mirror_map(&self, skeleton: &Skeleton) -> Vec<Option<usize>> {
        detect::mirror_map(self, skeleton)
    }

    fn up_from(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(joint), |&joint| self.parents[joint])
    }

    /// Whether `joint` is `above` or hangs below it.
    fn is_below(&self, joint: usize, above: usize) -> bool {
        self.up_from(joint).any(|joint| joint == above)
    }
}
