//! Finds parts by the hierarchy of joints if names do not decide.

use std::collections::BTreeMap;

use glam::DVec3;

use super::anatomy_detect::PartFinder;
use super::anatomy_names::{AnatomyDigit, JointWord, stated_side};
use super::fingers::in_hand;
use super::part::BodyPart;
use super::{PartAmbiguity, PartEvidence};
use crate::hand::{BodySide, HandFinger};
use crate::skeleton::Skeleton;

impl PartFinder<'_> {
    /// Finds arms and legs as pairs of similar chains, fills gaps in chains, and finds digits.
    pub(super) fn by_topology(&mut self) {
        let unnamed = |finder: &Self, part: fn(BodySide) -> BodyPart| {
            BodySide::BOTH_SIDES
                .iter()
                .all(|&side| finder.assigned_joint(part(side)).is_none())
        };
        // Names beat shapes: limbs are searched only if not even one side has a name.
        if unnamed(self, BodyPart::UpperArm) && unnamed(self, BodyPart::Hand) {
            self.find_limb_chains();
        }
        for side in BodySide::BOTH_SIDES {
            self.fill_limb_joint([BodyPart::UpperArm(side), BodyPart::Forearm(side), BodyPart::Hand(side)]);
            self.fill_limb_joint([BodyPart::Thigh(side), BodyPart::Shin(side), BodyPart::Foot(side)]);
            self.digits_by_shape(side);
        }
        self.find_hips_joint();
    }

    /// Finds the hips, where the thighs branch off, else at a joint called root. A root may also be a node on the floor.
    fn find_hips_joint(&mut self) {
        let thighs = BodySide::BOTH_SIDES.map(|side| self.assigned_joint(BodyPart::Thigh(side)));
        if let [Some(right), Some(left)] = thighs
            && let Some(hips) = self.lowest_common_ancestor(right, left)
        {
            // A root is hips only if the thighs branch off there; on the floor it is not.
            let root = self.labels[hips].is_some_and(|label| label.word == JointWord::Root);
            let how = if root {
                PartEvidence::Name
            } else {
                PartEvidence::Topology
            };
            self.assign_part_joint(BodyPart::Hips, hips, how);
        }
        self.assign_labelled_part(BodyPart::Hips, &[JointWord::Root]);
    }

    /// Finds neck and head as the chain that continues from the chest beside the arms.
    pub(super) fn neck_and_head(&mut self) {
        let Some(chest) = self.assigned_joint(BodyPart::Chest) else {
            return;
        };
        let arms: Vec<usize> = BodySide::BOTH_SIDES
            .iter()
            .flat_map(|&side| [BodyPart::Clavicle(side), BodyPart::UpperArm(side)])
            .filter_map(|part| self.assigned_joint(part))
            .collect();
        let children = self.skeleton.joint_children(chest).iter().copied();
        // A joint that carries an arm is no neck.
        let free = children.filter(|&child| !arms.iter().any(|&arm| self.is_below(arm, child)));
        let depths = depths(self.skeleton);
        // The longest chain is that of the head; others are helpers.
        let Some(neck) = free.max_by_key(|&child| (depths[child], child)) else {
            return;
        };
        let mut chain = vec![neck];
        while let [child] = *self.skeleton.joint_children(chain[chain.len() - 1]) {
            chain.push(child);
        }
        match *chain {
            [head] => self.assign_part_joint(BodyPart::Head, head, PartEvidence::Topology),
            [.., head] => {
                self.assign_part_joint(BodyPart::Head, head, PartEvidence::Topology);
                // A head that was found by its name may be the chain's first joint, which is no neck then.
                if self.assigned_joint(BodyPart::Head) != Some(neck) {
                    self.assign_part_joint(BodyPart::Neck, neck, PartEvidence::Topology);
                }
            }
            [] => {}
        }
    }

    /// Finds the middle or the last of three joints of a limb if its neighbours are known.
    fn fill_limb_joint(&mut self, [first, second, third]: [BodyPart; 3]) {
        let joints = [first, second, third].map(|part| self.assigned_joint(part));
        match joints {
            [Some(upper), None, Some(lower)] if self.is_below(lower, upper) => {
                let between = self.skeleton.joint_parent(lower).filter(|&joint| joint != upper);
                if let Some(joint) = between.filter(|&joint| self.is_free(joint)) {
                    self.assign_part_joint(second, joint, PartEvidence::Topology);
                }
            }
            [Some(_), Some(middle), None] => {
                let mut free = self.skeleton.joint_children(middle).iter().copied();
                if let Some(joint) = free.find(|&joint| self.is_free(joint)) {
                    self.assign_part_joint(third, joint, PartEvidence::Topology);
                }
            }
            [None, Some(middle), Some(_)] => {
                let above = self.skeleton.joint_parent(middle);
                // The root is never a limb's first joint.
                if let Some(joint) = above.filter(|&joint| joint != 0 && self.is_free(joint)) {
                    self.assign_part_joint(first, joint, PartEvidence::Topology);
                }
            }
            _ => {}
        }
    }

    fn is_free(&self, joint: usize) -> bool {
        self.labels[joint].is_none() && !self.found.values().any(|&(taken, _)| taken == joint)
    }

    /// Finds two pairs of similar chains: the one nearer to the root are the legs, the other the arms. A single pair
    /// are the arms if something else, a neck, continues beside them. Names decide which limb is the left one, if they
    /// state a side; else the direction of the toes does.
    fn find_limb_chains(&mut self) {
        let pairs = find_limb_pairs(self.skeleton);
        let rest = self.skeleton.rest_model_pose();
        let (legs, arms) = match *pairs.as_slice() {
            [legs, arms, ..] => (Some(legs), arms),
            // Two arms and nothing else could be two legs as well.
            [arms] if self.skeleton.joint_children(arms.fork).len() > 2 => (None, arms),
            _ => return,
        };
        let joint_place = |joint: usize| rest.model_joint_position(joint);
        let up = match legs {
            Some(legs) => joint_place(arms.fork) - joint_place(legs.fork),
            None => DVec3::Y,
        };
        let mut toes = DVec3::ZERO;
        for limb in legs.iter().flat_map(|pair| pair.limbs) {
            if let [.., foot, end] = *single_child_chain(self.skeleton, limb) {
                toes += rest.bone_tip_position(self.skeleton, end).unwrap_or(joint_place(end)) - joint_place(foot);
            }
        }
        let up = up.normalize_or(DVec3::Y);
        // Toes point forward, but may also slope down.
        let facing = toes.reject_from_normalized(up);
        // Toes of a hundredth of the body are rounding, not a direction.
        let sure = facing.length() > 0.01 * joint_place(arms.fork).distance(joint_place(0));
        // Without toes the left is assumed at +X, and the result is marked as ambiguous below.
        let left = if sure { up.cross(facing) } else { DVec3::X };
        for (pair, is_arm) in [(Some(arms), true), (legs, false)] {
            let Some(pair) = pair else { continue };
            let [a, b] = pair.limbs.map(|limb| chain_end(self.skeleton, limb));
            let across = (joint_place(a) - joint_place(b)).dot(left);
            let [first, second] = pair.limbs.map(|limb| self.stated_side(limb));
            let stated = match (first, second) {
                // Two limbs of one stated side contradict each other, and neither is believed.
                (Some(first), Some(second)) if first != second => Some(first),
                _ => None,
            };
            let first_is_left = stated.map_or(across > 0.0, |side| side == BodySide::Left);
            let order = if first_is_left { [1, 0] } else { [0, 1] };
            let sure = sure || stated.is_some();
            for (side, which) in BodySide::BOTH_SIDES.into_iter().zip(order) {
                self.assign_limb_joints(side, pair.limbs[which], is_arm);
                let part = if is_arm {
                    BodyPart::UpperArm(side)
                } else {
                    BodyPart::Thigh(side)
                };
                if let Some(taken) = self.assigned_joint(part).filter(|_| !sure) {
                    self.ambiguous.push(PartAmbiguity {
                        part,
                        taken,
                        others: Vec::new(),
                    });
                }
            }
        }
    }

    /// Returns the side that the names of a limb's joints state, if they agree.
    fn stated_side(&self, limb: usize) -> Option<BodySide> {
        let joints = self.skeleton.joint_subtree(limb);
        let mut sides = joints
            .into_iter()
            .filter_map(|joint| stated_side(&self.skeleton.joint_at(joint).name));
        let first = sides.next()?;
        sides.all(|side| side == first).then_some(first)
    }

    fn assign_limb_joints(&mut self, side: BodySide, first: usize, is_arm: bool) {
        let joints = single_child_chain(self.skeleton, first);
        let parts: &[BodyPart] = match (is_arm, joints.len()) {
            (true, 3) => &[BodyPart::UpperArm(side), BodyPart::Forearm(side), BodyPart::Hand(side)],
            // Four joints or more start with a collar bone.
            (true, _) => &[
                BodyPart::Clavicle(side),
                BodyPart::UpperArm(side),
                BodyPart::Forearm(side),
                BodyPart::Hand(side),
            ],
            (false, _) => &[
                BodyPart::Thigh(side),
                BodyPart::Shin(side),
                BodyPart::Foot(side),
                BodyPart::Toes(side),
            ],
        };
        for (&part, &joint) in parts.iter().zip(&joints) {
            self.assign_part_joint(part, joint, PartEvidence::Topology);
        }
    }

    /// Finds thumb and fingers of a hand that has five chains, none of them found by name: the thumb is the chain that
    /// points away from the others and begins near the wrist, and the others follow from it outwards.
    fn digits_by_shape(&mut self, side: BodySide) {
        let Some(hand) = self.assigned_joint(BodyPart::Hand(side)) else {
            return;
        };
        let has_digits = self
            .found
            .keys()
            .any(|part| matches!(part, BodyPart::Thumb(s, _) | BodyPart::Finger(s, _, _) if *s == side));
        let mut chains: Vec<Vec<usize>> = self
            .skeleton
            .joint_children(hand)
            .iter()
            .map(|&child| single_child_chain(self.skeleton, child))
            .filter(|chain| chain.len() > 1)
            .collect();
        // Fewer or more than five chains cannot be distinguished by shape.
        if has_digits || chains.len() != 5 {
            return;
        }
        let hand_place = |joint| in_hand(self.skeleton, hand, joint).0;
        let direction = |chain: &[usize]| (hand_place(chain[1]) - hand_place(chain[0])).normalize_or_zero();
        let mean = chains.iter().map(|chain| direction(chain)).sum::<DVec3>();
        let farthest = chains.iter().map(|c| hand_place(c[1]).length()).fold(0.0, f64::max);
        let apart = |chain: &[usize]| {
            // A thumb begins nearer to the wrist than fingers do.
            let near = 1.0 - hand_place(chain[1]).length() / farthest.max(f64::MIN_POSITIVE);
            1.0 - direction(chain).dot(mean.normalize_or_zero()) + near
        };
        chains.sort_by(|a, b| apart(b).total_cmp(&apart(a)));
        let thumb = hand_place(chain_end(self.skeleton, chains[0][0]));
        let along = (mean - direction(&chains[0])).normalize_or_zero();
        let across = |chain: &[usize]| {
            let start = if self.starts_inside(AnatomyDigit::Finger(HandFinger::Index), chain) {
                chain[1]
            } else {
                chain[0]
            };
            (hand_place(start) - thumb).reject_from(along).length()
        };
        // Fingers follow from the thumb outwards.
        chains[1..].sort_by(|a, b| across(a).total_cmp(&across(b)));
        for (digit, chain) in AnatomyDigit::ALL_ANATOMY_DIGITS.into_iter().zip(&chains) {
            let metacarpal = self.starts_inside(digit, chain);
            self.assign_digit(side, digit, chain, metacarpal, PartEvidence::Topology);
        }
    }
}

/// Two similar chains that branch off at one joint.
#[derive(Debug, Clone, Copy)]
struct LimbPair {
    fork: usize,
    limbs: [usize; 2],
}

/// Returns the pairs of limbs, from the root outwards: two children of one joint with similar subtrees of at least
/// three joints, whose bones have similar lengths.
fn find_limb_pairs(skeleton: &Skeleton) -> Vec<LimbPair> {
    let shapes = subtree_shapes(skeleton);
    let reach = |joint: usize| -> f64 {
        let joints = single_child_chain(skeleton, joint);
        joints[1..].iter().map(|&j| skeleton.joint_at(j).offset.length()).sum()
    };
    let depths = depths(skeleton);
    let mut pairs: Vec<LimbPair> = Vec::new();
    let mut inside = vec![false; skeleton.len()];
    for fork in 0..skeleton.len() {
        // Pairs inside a limb are part of it: hands would be pairs of their own.
        inside[fork] |= skeleton.joint_parent(fork).is_some_and(|parent| inside[parent]);
        if inside[fork] {
            continue;
        }
        let mut waiting: BTreeMap<usize, (usize, f64)> = BTreeMap::new();
        // Two joints or fewer are helpers; limbs have three.
        for &b in skeleton.joint_children(fork).iter().filter(|&&child| depths[child] > 2) {
            let y = reach(b);
            match waiting.remove(&shapes[b]) {
                // Left and right differ by a fifth at most, even in captured bodies.
                Some((a, x)) if (x - y).abs() <= 0.2 * x.max(y) => {
                    inside[a] = true;
                    inside[b] = true;
                    pairs.push(LimbPair { fork, limbs: [a, b] });
                }
                _ => drop(waiting.insert(shapes[b], (b, y))),
            }
        }
    }
    pairs
}

/// Returns for each joint the number of joints on the longest path down, including itself.
fn depths(skeleton: &Skeleton) -> Vec<usize> {
    let mut depths = vec![1; skeleton.len()];
    // Children come after their parents, so that backwards every child is final first.
    for joint in (0..skeleton.len()).rev() {
        if let Some(parent) = skeleton.joint_parent(joint) {
            depths[parent] = depths[parent].max(depths[joint] + 1);
        }
    }
    depths
}

/// Returns a number for each joint; joints with the same number have subtrees of the same shape.
fn subtree_shapes(skeleton: &Skeleton) -> Vec<usize> {
    let mut shape_numbers: std::collections::BTreeMap<Vec<usize>, usize> = std::collections::BTreeMap::new();
    let mut shapes = vec![0; skeleton.len()];
    for joint in (0..skeleton.len()).rev() {
        let mut below: Vec<usize> = skeleton
            .joint_children(joint)
            .iter()
            .map(|&child| shapes[child])
            .collect();
        below.sort_unstable();
        // The children's shapes are sorted, so that their order does not make a difference.
        let next = shape_numbers.len();
        shapes[joint] = *shape_numbers.entry(below).or_insert(next);
    }
    shapes
}

/// Returns `joint` and its descendants as long as each has one child; a joint with several is the last. Helpers on the
/// bone do not count as children.
fn single_child_chain(skeleton: &Skeleton, joint: usize) -> Vec<usize> {
    let mut joints = vec![joint];
    while let Some(child) = only_child(skeleton, joints[joints.len() - 1]) {
        joints.push(child);
    }
    joints
}

/// Returns the child of a joint that has one, besides leaves that lie on the bone to it, as those that spread a twist.
fn only_child(skeleton: &Skeleton, joint: usize) -> Option<usize> {
    let children = skeleton.joint_children(joint);
    if let [child] = *children {
        return Some(child);
    }
    // Twist helpers are leaves on the bone: they do not end a chain.
    let mut inner = children
        .iter()
        .filter(|&&child| !skeleton.joint_children(child).is_empty());
    let (&child, None) = (inner.next()?, inner.next()) else {
        return None;
    };
    let bone = skeleton.joint_at(child).offset;
    let length = bone.length();
    let on_bone = |leaf: usize| {
        let leaf_offset = skeleton.joint_at(leaf).offset;
        let along = leaf_offset.dot(bone.normalize_or_zero());
        // A tolerance of a fiftieth of the bone, since helpers are rounded in files.
        let aside = (leaf_offset - bone.normalize_or_zero() * along).length();
        aside <= ON_BONE * length && (-ON_BONE..=1.0 + ON_BONE).contains(&(along / length))
    };
    let leaves = children.iter().filter(|&&leaf| leaf != child);
    (length > 0.0 && leaves.copied().all(on_bone)).then_some(child)
}

/// How far from a bone a helper lies at most, as a share of the bone's length.
const ON_BONE: f64 = 0.02;

fn chain_end(skeleton: &Skeleton, joint: usize) -> usize {
    single_child_chain(skeleton, joint).last().copied().unwrap_or(joint)
}
