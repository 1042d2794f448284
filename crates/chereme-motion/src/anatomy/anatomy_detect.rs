//! Finding the parts of the body: by name first, then by topology and side.

use std::collections::BTreeMap;

use super::anatomy_markers;
use super::anatomy_names::{self, AnatomyDigit, DigitSegment, JointLabel, JointWord};
use super::part::BodyPart;
use super::{BodyAnatomy, PartAmbiguity, PartEvidence};
use crate::hand::BodySide;
use crate::skeleton::Skeleton;

/// The length of a thumb's first two bones as a share of the third, below which the first joint is one more than a
/// thumb has: some 0.9 there, and 2.2 if the joints are metacarpal, base, end joint and end.
const EXTRA_THUMB_JOINT_RATIO: f64 = 1.6;

/// The result of the detection.
pub(super) struct DetectedParts {
    pub(super) found: BTreeMap<BodyPart, (usize, PartEvidence)>,
    pub(super) ambiguous: Vec<PartAmbiguity>,
    pub(super) markers: Vec<usize>,
}

/// Finds the parts, the user's `assignments` first; these hold `None` for a part that the skeleton does not have.
pub(super) fn detect_body_parts(skeleton: &Skeleton, assignments: &BTreeMap<BodyPart, Option<usize>>) -> DetectedParts {
    let mut finder = PartFinder::new(skeleton, assignments);
    finder.head_and_trunk();
    for side in BodySide::BOTH_SIDES {
        finder.find_arm_joints(side);
        finder.find_leg_joints(side);
        for digit in AnatomyDigit::ALL_ANATOMY_DIGITS {
            finder.find_digit_joints(side, digit);
        }
    }
    finder.by_topology();
    finder.chest_and_spine();
    finder.neck_and_head();
    finder.ambiguous.sort_by_key(|ambiguity| ambiguity.part);
    DetectedParts {
        found: finder.found,
        ambiguous: finder.ambiguous,
        markers: finder.markers,
    }
}

pub(super) struct PartFinder<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) labels: Vec<Option<JointLabel>>,
    assignments: &'a BTreeMap<BodyPart, Option<usize>>,
    pub(super) found: BTreeMap<BodyPart, (usize, PartEvidence)>,
    pub(super) ambiguous: Vec<PartAmbiguity>,
    markers: Vec<usize>,
}

impl<'a> PartFinder<'a> {
    fn new(skeleton: &'a Skeleton, assignments: &'a BTreeMap<BodyPart, Option<usize>>) -> Self {
        let joints = skeleton.skeleton_joints().iter();
        let names: Vec<&str> = joints.map(|joint| joint.name.as_str()).collect();
        let mut labels = anatomy_names::read_all(&names);
        let assigned: Vec<usize> = assignments.values().copied().flatten().collect();
        let mut markers = anatomy_markers::find_marker_joints(skeleton, &names, &labels);
        markers.retain(|joint| !assigned.contains(joint));
        // Joints that the user assigned and markers are no longer named by their labels.
        for joint in assigned.into_iter().chain(markers.iter().copied()) {
            labels[joint] = None;
        }
        let mut finder = Self {
            skeleton,
            labels,
            assignments,
            found: assignments
                .iter()
                .filter_map(|(&part, joint)| Some((part, ((*joint)?, PartEvidence::Roles))))
                .collect(),
            ambiguous: Vec::new(),
            markers,
        };
        finder.inherit_sides();
        finder
    }

    /// Gives labels without a side the side of the joints above, else that of the joints below.
    fn inherit_sides(&mut self) {
        let count = self.labels.len();
        let mut near: Vec<Option<BodySide>> = vec![None; count];
        // From the leaves up, every joint learns a side stated below it; then downwards from above.
        for joint in (0..count).rev() {
            let own_side = self.labels[joint].and_then(|label| label.side);
            near[joint] = own_side.or(near[joint]);
            if let (Some(parent), Some(side)) = (self.skeleton.joint_parent(joint), near[joint]) {
                near[parent] = Some(side);
            }
        }
        let below = near.clone();
        for joint in 0..count {
            let joint_side = self.labels[joint].and_then(|label| label.side);
            let parent = self.skeleton.joint_parent(joint);
            near[joint] = joint_side.or_else(|| near[parent?]);
            if let Some(label) = &mut self.labels[joint]
                && label.word.is_sided_word()
            {
                // The side of the joints above is surer than that of those below.
                label.side = near[joint].or(below[joint]);
            }
        }
    }

    pub(super) fn assigned_joint(&self, part: BodyPart) -> Option<usize> {
        self.found.get(&part).map(|&(joint, _)| joint)
    }

    pub(super) fn assign_part_joint(&mut self, part: BodyPart, joint: usize, evidence: PartEvidence) {
        if !self.assignments.contains_key(&part) && !self.found.contains_key(&part) {
            self.found.insert(part, (joint, evidence));
        }
    }

    pub(super) fn labelled_joints(&self, side: Option<BodySide>, word: JointWord) -> Vec<usize> {
        let wanted_label = Some(JointLabel { side, word });
        (0..self.labels.len())
            .filter(|&j| self.labels[j] == wanted_label)
            .collect()
    }

    pub(super) fn is_below(&self, joint: usize, above: usize) -> bool {
        self.skeleton.joint_ancestors(joint).any(|j| j == above)
    }

    /// Assigns `part` to the first joint with one of the words, in the order of `words`. Other joints with the same
    /// word make the part ambiguous, unless they are below that joint.
    pub(super) fn assign_labelled_part(&mut self, part: BodyPart, words: &[JointWord]) {
        let side = part.part_side();
        let all = words.iter().map(|&word| self.labelled_joints(side, word));
        let Some(all) = all.into_iter().find(|all| !all.is_empty()) else {
            return;
        };
        // Parents stand first in a skeleton, so that the first joint is the upper one.
        let first = all[0];
        let rivals = all[1..].iter().copied();
        // A joint below the first is its continuation, such as a second neck bone.
        let others: Vec<usize> = rivals.filter(|&j| !self.is_below(j, first)).collect();
        if !others.is_empty() && !self.assignments.contains_key(&part) {
            self.ambiguous.push(PartAmbiguity {
                part,
                taken: first,
                others,
            });
        }
        self.assign_part_joint(part, first, PartEvidence::Name);
    }

    fn head_and_trunk(&mut self) {
        self.assign_labelled_part(BodyPart::Hips, &[JointWord::Hips]);
        self.assign_labelled_part(BodyPart::Neck, &[JointWord::Neck]);
        self.assign_labelled_part(BodyPart::Head, &[JointWord::Head]);
        self.assign_labelled_part(BodyPart::Jaw, &[JointWord::Jaw]);
        for side in BodySide::BOTH_SIDES {
            self.assign_labelled_part(BodyPart::Eye(side), &[JointWord::Eye]);
        }
    }

    fn find_arm_joints(&mut self, side: BodySide) {
        let has = |word| !self.labelled_joints(Some(side), word).is_empty();
        let has_upper = has(JointWord::UpperArm);
        // "Shoulder" is the collar bone where an upper arm has a name, and the upper arm elsewhere.
        let (clavicle, upper): (&[JointWord], &[JointWord]) = if has_upper {
            (&[JointWord::Clavicle, JointWord::Shoulder], &[JointWord::UpperArm])
        } else {
            (&[JointWord::Clavicle], &[JointWord::Shoulder])
        };
        self.assign_labelled_part(BodyPart::Clavicle(side), clavicle);
        self.assign_labelled_part(BodyPart::UpperArm(side), upper);
        self.assign_labelled_part(BodyPart::Forearm(side), &[JointWord::Forearm]);
        self.take_upper_of(BodyPart::Hand(side), [JointWord::Wrist, JointWord::Hand]);
    }

    /// Assigns `part` to the one of two joints in a chain (wrist and hand) that is nearer to the body.
    fn take_upper_of(&mut self, part: BodyPart, words: [JointWord; 2]) {
        let first = |word| self.labelled_joints(part.part_side(), word).first().copied();
        let words = match words.map(first) {
            [Some(a), Some(b)] if b < a => [words[1], words[0]],
            _ => words,
        };
        self.assign_labelled_part(part, &words);
    }

    fn find_leg_joints(&mut self, side: BodySide) {
        let has = |word| !self.labelled_joints(Some(side), word).is_empty();
        let has_thigh = has(JointWord::Thigh) || has(JointWord::SideHip);
        let (has_ankle, has_toes) = (has(JointWord::Ankle), has(JointWord::Toes));
        let thigh: &[JointWord] = if has_thigh {
            // "Leg" is the shin beside a named thigh, and the thigh elsewhere.
            &[JointWord::Thigh, JointWord::SideHip]
        } else {
            &[JointWord::Leg]
        };
        self.assign_labelled_part(BodyPart::Thigh(side), thigh);
        if has_thigh {
            self.assign_labelled_part(BodyPart::Shin(side), &[JointWord::Shin, JointWord::Leg]);
        } else {
            self.assign_labelled_part(BodyPart::Shin(side), &[JointWord::Shin]);
        }
        self.assign_labelled_part(BodyPart::Foot(side), &[JointWord::Ankle, JointWord::Foot]);
        if has_toes {
            self.assign_labelled_part(BodyPart::Toes(side), &[JointWord::Toes]);
        } else if has_ankle {
            // With an ankle, "foot" is the ball of the foot.
            self.assign_labelled_part(BodyPart::Toes(side), &[JointWord::Foot]);
        }
    }

    fn find_digit_joints(&mut self, side: BodySide, digit: AnatomyDigit) {
        let mut chain: Vec<(usize, DigitSegment)> = Vec::new();
        for (joint, label) in self.labels.iter().enumerate() {
            if let Some(label) = label
                && label.side == Some(side)
                && let JointWord::Digit(which, segment) = label.word
                && which == digit
            {
                chain.push((joint, segment));
            }
        }
        let Some(&(first, _)) = chain.first() else {
            return;
        };
        // Two chains of one digit's name: only the one below the first joint is it.
        chain.retain(|&(joint, _)| self.is_below(joint, first));
        let joints: Vec<usize> = chain.iter().map(|&(joint, _)| joint).collect();
        let metacarpal = chain[0].1 == DigitSegment::Metacarpal
            // Without a joint called proximal, lengths decide whether the first one is the metacarpal.
            || (!chain.iter().any(|(_, s)| *s == DigitSegment::Proximal) && self.starts_inside(digit, &joints));
        self.assign_digit(side, digit, &joints, metacarpal, PartEvidence::Name);
    }

    /// Assigns the parts of a digit to its joints, from the metacarpal or the base on. A thumb of four joints or more
    /// that starts inside the hand, as `metacarpal` says, has a joint before its own metacarpal, which is no part.
    pub(super) fn assign_digit(
        &mut self,
        side: BodySide,
        digit: AnatomyDigit,
        joints: &[usize],
        metacarpal: bool,
        how: PartEvidence,
    ) {
        // Fingers without a metacarpal begin with their second part, the base.
        let skip = u8::from(!metacarpal);
        let extra = digit == AnatomyDigit::Thumb && metacarpal && joints.len() > 3;
        let joints = &joints[usize::from(extra)..];
        for (place, &joint) in (0u8..).zip(joints) {
            let part = match digit {
                AnatomyDigit::Thumb if place < 3 => BodyPart::Thumb(side, place),
                AnatomyDigit::Finger(finger) if place + skip < 4 => BodyPart::Finger(side, finger, place + skip),
                _ => break,
            };
            self.assign_part_joint(part, joint, how);
        }
    }

    /// Returns whether the first joint of a digit with three or more joints lies inside the hand: nearer to the wrist
    /// than to its second joint. That is so for a finger's metacarpal, and not for its base joint. For a thumb, which
    /// starts with its metacarpal, returns whether its first two bones are about as long as the third: then they lead
    /// from the wrist to the metacarpal, and else the last of four joints is the thumb's end.
    pub(super) fn starts_inside(&self, digit: AnatomyDigit, chain: &[usize]) -> bool {
        let length = |joint: usize| self.skeleton.joint_at(joint).offset.length();
        match (digit, chain) {
            (AnatomyDigit::Thumb, &[first, second, third, _, ..]) => {
                length(first) + length(second) < EXTRA_THUMB_JOINT_RATIO * length(third)
            }
            (AnatomyDigit::Thumb, _) => false,
            (AnatomyDigit::Finger(_), &[first, second, _, ..]) => length(first) < length(second),
            (AnatomyDigit::Finger(_), _) => false,
        }
    }

    /// Finds the chest, where the arms (or one arm and the neck) branch off, and the spine, which begins above the
    /// hips.
    fn chest_and_spine(&mut self) {
        let arms: Vec<usize> = BodySide::BOTH_SIDES
            .iter()
            .filter_map(|&side| {
                let clavicle = self.assigned_joint(BodyPart::Clavicle(side));
                clavicle.or_else(|| self.assigned_joint(BodyPart::UpperArm(side)))
            })
            .collect();
        let neck = self
            .assigned_joint(BodyPart::Neck)
            .or_else(|| self.assigned_joint(BodyPart::Head));
        // With one arm the neck shows where the chest is.
        let fork = match (arms.as_slice(), neck) {
            (&[a, b], _) | (&[a], Some(b)) => self.lowest_common_ancestor(a, b),
            (&[a], None) => self.skeleton.joint_parent(a),
            _ => None,
        };
        let is_spine =
            |finder: &Self, joint: usize| finder.labels[joint].is_some_and(|label| label.word == JointWord::Spine);
        let hips = self.assigned_joint(BodyPart::Hips);
        let last_named = (0..self.labels.len()).rev().find(|&j| is_spine(self, j));
        // A fork at the hips is a skeleton without a spine; its last named bone has to do.
        let Some(chest) = fork.filter(|&j| Some(j) != hips).or(last_named) else {
            return;
        };
        let how = |finder: &Self, joint| {
            if is_spine(finder, joint) {
                PartEvidence::Name
            } else {
                PartEvidence::Topology
            }
        };
        self.assign_part_joint(BodyPart::Chest, chest, how(self, chest));
        let path = self.skeleton.joint_ancestors(chest);
        // The root is no spine, even if nothing is called hips.
        let above: Vec<usize> = path.take_while(|&j| Some(j) != hips && j != 0).collect();
        let named = above.iter().rev().find(|&&j| is_spine(self, j));
        if let Some(&spine) = named.or(above.last()) {
            self.assign_part_joint(BodyPart::Spine, spine, how(self, spine));
        }
    }

    /// Returns the lowest common ancestor of two joints, which may be one of them.
    pub(super) fn lowest_common_ancestor(&self, a: usize, b: usize) -> Option<usize> {
        let above: Vec<usize> = self.skeleton.joint_ancestors(b).collect();
        self.skeleton.joint_ancestors(a).find(|joint| above.contains(joint))
    }
}

/// Pairs joints by part, then by name with the sides exchanged, then by their position below paired joints.
pub(super) fn mirror_map(anatomy: &BodyAnatomy, skeleton: &Skeleton) -> Vec<Option<usize>> {
    let mut map: Vec<Option<usize>> = Vec::with_capacity(skeleton.len());
    let mut names: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, joint) in skeleton.skeleton_joints().iter().enumerate() {
        // Of two joints with one name the first counts.
        names.entry(&joint.name).or_insert(index);
    }
    let mut free: Vec<Vec<usize>> = vec![Vec::new(); skeleton.len()];
    let mut rank = vec![0; skeleton.len()];
    for joint in (0..skeleton.len()).filter(|&joint| anatomy.part_of(joint).is_none()) {
        if let Some(parent) = skeleton.joint_parent(joint) {
            rank[joint] = free[parent].len();
            free[parent].push(joint);
        }
    }
    for joint in 0..skeleton.len() {
        let counterpart = match anatomy.part_of(joint) {
            // Mirrored helpers are found by their rank below the same parents.
            Some(part) => anatomy.part_joint(part.mirrored_part()),
            None => {
                let mirrored_name = other_side(&skeleton.joint_at(joint).name);
                let named = mirrored_name.and_then(|name| names.get(name.as_str()).copied());
                named.or_else(|| match skeleton.joint_parent(joint) {
                    Some(parent) => {
                        let (here, there) = (&free[parent], &free[map[parent]?]);
                        // Different numbers of helpers on both sides cannot be paired.
                        (here.len() == there.len()).then(|| there[rank[joint]])
                    }
                    None => Some(joint),
                })
            }
        };
        map.push(counterpart);
    }
    map
}

/// Returns the name with its word for a side exchanged, if it has one.
fn other_side(name: &str) -> Option<String> {
    for (a, b) in [
        ("Left", "Right"),
        ("left", "right"),
        ("LEFT", "RIGHT"),
        ("Links", "Rechts"),
        ("links", "rechts"),
    ] {
        for (from, to) in [(a, b), (b, a)] {
            if name.contains(from) {
                return Some(name.replacen(from, to, 1));
            }
        }
    }
    let letters: Vec<char> = name.chars().collect();
    let alone = |n: usize| {
        let edge = |c: Option<&char>| c.is_none_or(|c| !c.is_alphanumeric());
        let before = edge(n.checked_sub(1).and_then(|n| letters.get(n)));
        let after = letters.get(n + 1);
        // A single letter is a side if it stands alone, or first before a capital: lArm, RHand.
        before && (edge(after) || (n == 0 && after.is_some_and(|c| c.is_uppercase())))
    };
    let letter_index = (0..letters.len()).find(|&n| "lrLR".contains(letters[n]) && alone(n))?;
    let swapped = match letters[letter_index] {
        'l' => 'r',
        'r' => 'l',
        'L' => 'R',
        _ => 'L',
    };
    let mut letters = letters;
    letters[letter_index] = swapped;
    Some(letters.into_iter().collect())
}

#[cfg(test)]
mod tests {
    use super::super::tests::fixtures::{PLAIN_BODY_VARIATION, fixture_body, fixture_joint_roles, rename_joints};
    use super::*;
    use crate::skeleton::SkeletonJoint;

    /// Returns a body whose thumbs have four joints: one more at a share of the path from the wrist to the metacarpal,
    /// or else one more at the thumb's end.
    fn with_long_thumbs(names: [&str; 4], inside: Option<f64>) -> Skeleton {
        let plain = fixture_body(PLAIN_BODY_VARIATION);
        let anatomy = BodyAnatomy::with_roles(&plain, &fixture_joint_roles(&plain)).expect("its own names");
        let mut joints: Vec<SkeletonJoint> = Vec::new();
        let mut places = vec![0; plain.len()];
        let named =
            |side: BodySide, n: usize| names[n].replace("{}", ["Right", "Left"][super::super::side_pair_index(side)]);
        for (n, joint) in plain.skeleton_joints().iter().enumerate() {
            let mut joint = joint.clone();
            joint.parent = joint.parent.map(|parent| places[parent]);
            match anatomy.part_of(n) {
                Some(BodyPart::Thumb(side, bone)) => {
                    let bone = usize::from(bone);
                    if let Some(share) = inside.filter(|_| bone == 0) {
                        let offset = joint.offset * share;
                        joints.push(SkeletonJoint::new(named(side, 0), joint.parent, offset));
                        joint.parent = Some(joints.len() - 1);
                        joint.offset -= offset;
                    }
                    joint.name = named(side, bone + usize::from(inside.is_some()));
                    places[n] = joints.len();
                    let tip = joint.tip.take();
                    joints.push(joint);
                    if let Some(tip) = tip {
                        if inside.is_none() {
                            joints.push(SkeletonJoint::new(named(side, 3), Some(places[n]), tip));
                        }
                        let last = joints.last_mut().expect("a joint");
                        last.tip = Some(tip);
                    }
                }
                _ => {
                    places[n] = joints.len();
                    joints.push(joint);
                }
            }
        }
        Skeleton::new(joints).expect("a tree")
    }

    #[test]
    fn a_thumb_of_four_joints_has_one_more_before_its_metacarpal_or_an_end() {
        let numbered = ["{}HandThumb1", "{}HandThumb2", "{}HandThumb3", "{}HandThumb4"];
        let from_zero = ["{}HandThumb0", "{}HandThumb1", "{}HandThumb2", "{}HandThumb3"];
        let in_hand = ["{}InHandThumb", "{}HandThumb1", "{}HandThumb2", "{}HandThumb3"];
        let words = [
            "{}ThumbMetacarpal",
            "{}ThumbProximal",
            "{}ThumbIntermediate",
            "{}ThumbDistal",
        ];
        for (names, inside) in [
            (in_hand, Some(0.0)),
            (in_hand, Some(0.5)),
            (from_zero, Some(0.0)),
            (from_zero, Some(0.5)),
            (words, Some(0.5)),
            (numbered, Some(0.4)),
            (numbered, Some(0.9)),
            (["a{}", "b{}", "c{}", "d{}"], Some(0.4)),
            (numbered, None),
            (from_zero, None),
            (["a{}", "b{}", "c{}", "d{}"], None),
        ] {
            let skeleton = with_long_thumbs(names, inside);
            let unnamed = names[0].starts_with('a');
            let mut known = fixture_joint_roles(&skeleton);
            known.0.retain(|part, _| match part {
                BodyPart::Thumb(..) => false,
                BodyPart::Finger(..) => !unnamed,
                _ => true,
            });
            let anatomy = BodyAnatomy::with_roles(&skeleton, &known).expect("its own names");
            for side in BodySide::BOTH_SIDES {
                for bone in 0..3u8 {
                    let joint = anatomy.part_joint(BodyPart::Thumb(side, bone)).expect("a thumb");
                    let name = &skeleton.joint_at(joint).name;
                    let at = usize::from(bone) + usize::from(inside.is_some());
                    let word = ["Right", "Left"][super::super::side_pair_index(side)];
                    assert_eq!(*name, names[at].replace("{}", word), "{inside:?} {bone}");
                }
            }
        }
    }

    /// Returns a body whose arms have names without a meaning but with a side, and helpers on their bones.
    fn with_helpers(sides: [&str; 2]) -> Skeleton {
        let plain = fixture_body(PLAIN_BODY_VARIATION);
        let mut joints: Vec<SkeletonJoint> = Vec::new();
        let mut places = Vec::new();
        for (n, joint) in plain.skeleton_joints().iter().enumerate() {
            let mut joint = joint.clone();
            let side = usize::from(joint.name.starts_with("left"));
            let sided = joint.name.starts_with("left") || joint.name.starts_with("right");
            let arm = joint.name.ends_with("arm");
            joint.parent = joint.parent.map(|parent| places[parent]);
            joint.name = format!("{}x{n}", if sided { sides[side] } else { "" });
            places.push(joints.len());
            joints.push(joint);
            let next = plain.joint_children(n).first().filter(|_| arm);
            if let Some(&next) = next {
                let at = plain.joint_at(next).offset;
                let here = places[n];
                for share in [0.0, 0.5] {
                    joints.push(SkeletonJoint::new(format!("h{n}{share}"), Some(here), at * share));
                }
            }
        }
        Skeleton::new(joints).expect("a tree")
    }

    #[test]
    fn arms_with_helpers_on_their_bones_are_found_on_the_sides_that_names_state() {
        for (sides, swapped) in [(["", ""], false), (["R_", "L_"], false), (["L_", "R_"], true)] {
            let skeleton = with_helpers(sides);
            let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
            let rest = skeleton.rest_model_pose();
            for side in BodySide::BOTH_SIDES {
                for part in [BodyPart::UpperArm(side), BodyPart::Forearm(side), BodyPart::Hand(side)] {
                    let joint = anatomy.part_joint(part).expect("found by topology");
                    assert!(!skeleton.joint_at(joint).name.starts_with('h'), "{part}");
                    let is_left = rest.model_joint_position(joint).x > 0.0;
                    assert_eq!(is_left, (side == BodySide::Left) != swapped, "{part}");
                }
                let finger = BodyPart::Finger(side, crate::hand::HandFinger::Little, 3);
                assert!(anatomy.part_joint(finger).is_some(), "{sides:?}");
            }
        }
    }

    #[test]
    fn a_root_on_the_floor_is_not_the_hips() {
        let plain = fixture_body(PLAIN_BODY_VARIATION);
        let mut joints = vec![SkeletonJoint::new("root", None, glam::DVec3::ZERO)];
        joints.extend(plain.skeleton_joints().iter().cloned().map(|mut joint| {
            joint.parent = Some(joint.parent.map_or(0, |parent| parent + 1));
            if joint.name == "hips" {
                joint.name = "pivot".to_owned();
            }
            joint
        }));
        let skeleton = Skeleton::new(joints).expect("a tree");
        let hips = BodyAnatomy::detect_anatomy(&skeleton).part_joint(BodyPart::Hips);
        assert_eq!(hips.map(|it| skeleton.joint_at(it).name.as_str()), Some("pivot"));
    }

    #[test]
    fn toes_of_legs_without_known_names_are_no_markers() {
        let plain = fixture_body(PLAIN_BODY_VARIATION);
        let skeleton = rename_joints(&plain, |_, name| {
            let leg = ["thigh", "shin", "foot", "toes"];
            match leg.iter().find(|part| name.ends_with(*part)) {
                Some(part) => format!("{}-{}", &name[..2], part.replace(['e', 'i', 'o'], "x")),
                None => name.to_owned(),
            }
        });
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        assert_eq!(anatomy.marker_joints(), [0; 0]);
        assert!(anatomy.arm_chain(BodySide::Left).is_some());
    }
}
