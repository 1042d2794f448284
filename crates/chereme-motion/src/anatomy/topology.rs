//! Finds parts by the hierarchy of joints if names do not decide.

use std::collections::BTreeMap;

use glam::DVec3;

use super::detect::Finder;
use super::fingers::in_hand;
use super::names::{Digit, Word, stated_side};
use super::part::Part;
use super::{Ambiguity, Evidence};
use crate::hand::{Finger, Side};
use crate::skeleton::Skeleton;

impl Finder<'_> {
    /// Finds arms and legs as pairs of similar chains, fills gaps in chains, and finds digits.
    pub(super) fn by_topology(&mut self) {
        let unnamed = |finder: &Self, part: fn(Side) -> Part| {
            Side::BOTH
                .iter()
                .all(|&side| finder.joint(part(side)).is_none())
        };
        if unnamed(self, Part::UpperArm) && unnamed(self, Part::Hand) {
            self.limbs();
        }
        for side in Side::BOTH {
            self.fill([Part::UpperArm(side), Part::Forearm(side), Part::Hand(side)]);
            self.fill([Part::Thigh(side), Part::Shin(side), Part::Foot(side)]);
            self.digits_by_shape(side);
        }
        self.hips();
    }

    /// Finds the hips, where the thighs branch off, else at a joint called root. A root may also be a node on the floor.
    fn hips(&mut self) {
        let thighs = Side::BOTH.map(|side| self.joint(Part::Thigh(side)));
        if let [Some(right), Some(left)] = thighs
            && let Some(hips) = self.common(right, left)
        {
            let root = self.labels[hips].is_some_and(|label| label.word == Word::Root);
            let how = if root {
                Evidence::Name
            } else {
                Evidence::Topology
            };
            self.put(Part::Hips, hips, how);
        }
        self.take(Part::Hips, &[Word::Root]);
    }

    /// Finds neck and head as the chain that continues from the chest beside the arms.
    pub(super) fn neck_and_head(&mut self) {
        let Some(chest) = self.joint(Part::Chest) else {
            return;
        };
        let arms: Vec<usize> = Side::BOTH
            .iter()
            .flat_map(|&side| [Part::Clavicle(side), Part::UpperArm(side)])
            .filter_map(|part| self.joint(part))
            .collect();
        let children = self.skeleton.children(chest).iter().copied();
        let free = children.filter(|&child| !arms.iter().any(|&arm| self.is_below(arm, child)));
        let depths = depths(self.skeleton);
        let Some(neck) = free.max_by_key(|&child| (depths[child], child)) else {
            return;
        };
        let mut chain = vec![neck];
        while let [child] = *self.skeleton.children(chain[chain.len() - 1]) {
            chain.push(child);
        }
        match *chain {
            [head] => self.put(Part::Head, head, Evidence::Topology),
            [.., head] => {
                self.put(Part::Head, head, Evidence::Topology);
                if self.joint(Part::Head) != Some(neck) {
                    self.put(Part::Neck, neck, Evidence::Topology);
                }
            }
            [] => {}
        }
    }

    /// Finds the middle or the last of three joints of a limb if its neighbours are known.
    fn fill(&mut self, [first, second, third]: [Part; 3]) {
        let joints = [first, second, third].map(|part| self.joint(part));
        match joints {
            [Some(upper), None, Some(lower)] if self.is_below(lower, upper) => {
                let between = self.skeleton.parent(lower).filter(|&joint| joint != upper);
                if let Some(joint) = between.filter(|&joint| self.is_free(joint)) {
                    self.put(second, joint, Evidence::Topology);
                }
            }
            [Some(_), Some(middle), None] => {
                let mut free = self.skeleton.children(middle).iter().copied();
                if let Some(joint) = free.find(|&joint| self.is_free(joint)) {
                    self.put(third, joint, Evidence::Topology);
                }
            }
            [None, Some(middle), Some(_)] => {
                let above = self.skeleton.parent(middle);
                if let Some(joint) = above.filter(|&joint| joint != 0 && self.is_free(joint)) {
                    self.put(first, joint, Evidence::Topology);
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
    fn limbs(&mut self) {
        let pairs = pairs(self.skeleton);
        let rest = self.skeleton.rest_model_pose();
        let (legs, arms) = match *pairs.as_slice() {
            [legs, arms, ..] => (Some(legs), arms),
            [arms] if self.skeleton.children(arms.fork).len() > 2 => (None, arms),
            _ => return,
        };
        let at = |joint: usize| rest.position(joint);
        let up = match legs {
            Some(legs) => at(arms.fork) - at(legs.fork),
            None => DVec3::Y,
        };
        let mut toes = DVec3::ZERO;
        for limb in legs.iter().flat_map(|pair| pair.limbs) {
            if let [.., foot, end] = *chain(self.skeleton, limb) {
                toes += rest.tip(self.skeleton, end).unwrap_or(at(end)) - at(foot);
            }
        }
        let up = up.normalize_or(DVec3::Y);
        let facing = toes.reject_from_normalized(up);
        let sure = facing.length() > 0.01 * at(arms.fork).distance(at(0));
        let left = if sure { up.cross(facing) } else { DVec3::X };
        for (pair, is_arm) in [(Some(arms), true), (legs, false)] {
            let Some(pair) = pair else { continue };
            let [a, b] = pair.limbs.map(|limb| end(self.skeleton, limb));
            let across = (at(a) - at(b)).dot(left);
            let [first, second] = pair.limbs.map(|limb| self.stated_side(limb));
            let stated = match (first, second) {
                (Some(first), Some(second)) if first != second => Some(first),
                _ => None,
            };
            let first_is_left = stated.map_or(across > 0.0, |side| side == Side::Left);
            let order = if first_is_left { [1, 0] } else { [0, 1] };
            let sure = sure || stated.is_some();
            for (side, which) in Side::BOTH.into_iter().zip(order) {
                self.limb(side, pair.limbs[which], is_arm);
                let part = if is_arm {
                    Part::UpperArm(side)
                } else {
                    Part::Thigh(side)
                };
                if let Some(taken) = self.joint(part).filter(|_| !sure) {
                    self.ambiguous.push(Ambiguity {
                        part,
                        taken,
                        others: Vec::new(),
                    });
                }
            }
        }
    }

    /// Returns the side that the names of a limb's joints state, if they agree.
    fn stated_side(&self, limb: usize) -> Option<Side> {
        let joints = self.skeleton.subtree(limb);
        let mut sides = joints
            .into_iter()
            .filter_map(|joint| stated_side(&self.skeleton.joint(joint).name));
        let first = sides.next()?;
        sides.all(|side| side == first).then_some(first)
    }

    fn limb(&mut self, side: Side, first: usize, is_arm: bool) {
        let joints = chain(self.skeleton, first);
        let parts: &[Part] = match (is_arm, joints.len()) {
            (true, 3) => &[Part::UpperArm(side), Part::Forearm(side), Part::Hand(side)],
            (true, _) => &[
                Part::Clavicle(side),
                Part::UpperArm(side),
                Part::Forearm(side),
                Part::Hand(side),
            ],
            (false, _) => &[
                Part::Thigh(side),
                Part::Shin(side),
                Part::Foot(side),
                Part::Toes(side),
            ],
        };
        for (&part, &joint) in parts.iter().zip(&joints) {
            self.put(part, joint, Evidence::Topology);
        }
    }

    /// Finds thumb and fingers of a hand that has five chains, none of them found by name: the thumb is the chain that
    /// points away from the others and begins near the wrist, and the others follow from it outwards.
    fn digits_by_shape(&mut self, side: Side) {
        let Some(hand) = self.joint(Part::Hand(side)) else {
            return;
        };
        let known = self
            .found
            .keys()
            .any(|part| matches!(part, Part::Thumb(s, _) | Part::Finger(s, _, _) if *s == side));
        let mut chains: Vec<Vec<usize>> = self
            .skeleton
            .children(hand)
            .iter()
            .map(|&child| chain(self.skeleton, child))
            .filter(|chain| chain.len() > 1)
            .collect();
        if known || chains.len() != 5 {
            return;
        }
        let at = |joint| in_hand(self.skeleton, hand, joint).0;
        let direction = |chain: &[usize]| (at(chain[1]) - at(chain[0])).normalize_or_zero();
        let mean = chains.iter().map(|chain| direction(chain)).sum::<DVec3>();
        let farthest = chains.iter().map(|c| at(c[1]).length()).fold(0.0, f64::max);
        let apart = |chain: &[usize]| {
            let near = 1.0 - at(chain[1]).length() / farthest.max(f64::MIN_POSITIVE);
            1.0 - direction(chain).dot(mean.normalize_or_zero()) + near
        };
        chains.sort_by(|a, b| apart(b).total_cmp(&apart(a)));
        let thumb = at(end(self.skeleton, chains[0][0]));
        let along = (mean - direction(&chains[0])).normalize_or_zero();
        let across = |chain: &[usize]| {
            let start = if self.starts_inside(Digit::Finger(Finger::Index), chain) {
                chain[1]
            } else {
                chain[0]
            };
            (at(start) - thumb).reject_from(along).length()
        };
        chains[1..].sort_by(|a, b| across(a).total_cmp(&across(b)));
        for (digit, chain) in Digit::ALL.into_iter().zip(&chains) {
            let metacarpal = self.starts_inside(digit, chain);
            self.assign_digit(side, digit, chain, metacarpal, Evidence::Topology);
        }
    }
}

/// Two similar chains that branch off at one joint.
#[derive(Debug, Clone, Copy)]
struct Pair {
    fork: usize,
    limbs: [usize; 2],
}

/// Returns the pairs of limbs, from the root outwards: two children of one joint with similar subtrees of at least
/// three joints, whose bones have similar lengths.
fn pairs(skeleton: &Skeleton) -> Vec<Pair> {
    let shapes = shapes(skeleton);
    let reach = |joint: usize| -> f64 {
        let joints = chain(skeleton, joint);
        joints[1..]
            .iter()
            .map(|&j| skeleton.joint(j).offset.length())
            .sum()
    };
    let depths = depths(skeleton);
    let mut pairs: Vec<Pair> = Vec::new();
    let mut inside = vec![false; skeleton.len()];
    for fork in 0..skeleton.len() {
        inside[fork] |= skeleton.parent(fork).is_some_and(|parent| inside[parent]);
        if inside[fork] {
            continue;
        }
        let mut waiting: BTreeMap<usize, (usize, f64)> = BTreeMap::new();
        for &b in skeleton
            .children(fork)
            .iter()
            .filter(|&&child| depths[child] > 2)
        {
            let y = reach(b);
            match waiting.remove(&shapes[b]) {
                Some((a, x)) if (x - y).abs() <= 0.2 * x.max(y) => {
                    inside[a] = true;
                    inside[b] = true;
                    pairs.push(Pair {
                        fork,
                        limbs: [a, b],
                    });
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
    for joint in (0..skeleton.len()).rev() {
        if let Some(parent) = skeleton.parent(joint) {
            depths[parent] = depths[parent].max(depths[joint] + 1);
        }
    }
    depths
}

/// Returns a number for each joint; joints with the same number have subtrees of the same shape.
fn shapes(skeleton: &Skeleton) -> Vec<usize> {
    let mut known: std::collections::BTreeMap<Vec<usize>, usize> =
        std::collections::BTreeMap::new();
    let mut shapes = vec![0; skeleton.len()];
    for joint in (0..skeleton.len()).rev() {
        let mut below: Vec<usize> = skeleton
            .children(joint)
            .iter()
            .map(|&child| shapes[child])
            .collect();
        below.sort_unstable();
        let next = known.len();
        shapes[joint] = *known.entry(below).or_insert(next);
    }
    shapes
}

/// Returns `joint` and its descendants as long as each has one child; a joint with several is the last. Helpers on the
/// bone do not count as children.
fn chain(skeleton: &Skeleton, joint: usize) -> Vec<usize> {
    let mut joints = vec![joint];
    while let Some(child) = only_child(skeleton, joints[joints.len() - 1]) {
        joints.push(child);
    }
    joints
}

/// Returns the child of a joint that has one, besides leaves that lie on the bone to it, as those that spread a twist.
fn only_child(skeleton: &Skeleton, joint: usize) -> Option<usize> {
    let children = skeleton.children(joint);
    if let [child] = *children {
        return Some(child);
    }
    let mut inner = children
        .iter()
        .filter(|&&child| !skeleton.children(child).is_empty());
    let (&child, None) = (inner.next()?, inner.next()) else {
        return None;
    };
    let bone = skeleton.joint(child).offset;
    let length = bone.length();
    let on_bone = |leaf: usize| {
        let at = skeleton.joint(leaf).offset;
        let along = at.dot(bone.normalize_or_zero());
        let aside = (at - bone.normalize_or_zero() * along).length();
        aside <= ON_BONE * length && (-ON_BONE..=1.0 + ON_BONE).contains(&(along / length))
    };
    let leaves = children.iter().filter(|&&leaf| leaf != child);
    (length > 0.0 && leaves.copied().all(on_bone)).then_some(child)
}

/// How far from a bone a helper lies at most, as a share of the bone's length.
const ON_BONE: f64 = 0.02;

fn end(skeleton: &Skeleton, joint: usize) -> usize {
    chain(skeleton, joint).last().copied().unwrap_or(joint)
}
