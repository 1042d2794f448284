//! Finding the parts of the body: by name first, then by topology and side.

use std::collections::BTreeMap;

use super::markers;
use super::names::{self, Digit, Label, Segment, Word};
use super::part::Part;
use super::{Ambiguity, Anatomy, Evidence};
use crate::hand::Side;
use crate::skeleton::Skeleton;

/// The length of a thumb's first two bones as a share of the third, below which the first joint is one more than a
/// thumb has: some 0.9 there, and 2.2 if the joints are metacarpal, base, end joint and end.
const EXTRA: f64 = 1.6;

/// The result of the detection.
pub(super) struct Detected {
    pub(super) found: BTreeMap<Part, (usize, Evidence)>,
    pub(super) ambiguous: Vec<Ambiguity>,
    pub(super) markers: Vec<usize>,
}

/// Finds the parts, the user's `assignments` first; these hold `None` for a part that the skeleton does not have.
pub(super) fn detect(skeleton: &Skeleton, assignments: &BTreeMap<Part, Option<usize>>) -> Detected {
    let mut finder = Finder::new(skeleton, assignments);
    finder.head_and_trunk();
    for side in Side::BOTH {
        finder.arm(side);
        finder.leg(side);
        for digit in Digit::ALL {
            finder.digit(side, digit);
        }
    }
    finder.by_topology();
    finder.chest_and_spine();
    finder.neck_and_head();
    finder.ambiguous.sort_by_key(|ambiguity| ambiguity.part);
    Detected {
        found: finder.found,
        ambiguous: finder.ambiguous,
        markers: finder.markers,
    }
}

pub(super) struct Finder<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) labels: Vec<Option<Label>>,
    assignments: &'a BTreeMap<Part, Option<usize>>,
    pub(super) found: BTreeMap<Part, (usize, Evidence)>,
    pub(super) ambiguous: Vec<Ambiguity>,
    markers: Vec<usize>,
}

impl<'a> Finder<'a> {
    fn new(skeleton: &'a Skeleton, assignments: &'a BTreeMap<Part, Option<usize>>) -> Self {
        let joints = skeleton.joints().iter();
        let names: Vec<&str> = joints.map(|joint| joint.name.as_str()).collect();
        let mut labels = names::read_all(&names);
        let assigned: Vec<usize> = assignments.values().copied().flatten().collect();
        let mut markers = markers::find(skeleton, &names, &labels);
        markers.retain(|joint| !assigned.contains(joint));
        for joint in assigned.into_iter().chain(markers.iter().copied()) {
            labels[joint] = None;
        }
        let mut finder = Self {
            skeleton,
            labels,
            assignments,
            found: assignments
                .iter()
                .filter_map(|(&part, joint)| Some((part, ((*joint)?, Evidence::Roles))))
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
        let mut near: Vec<Option<Side>> = vec![None; count];
        for joint in (0..count).rev() {
            let own = self.labels[joint].and_then(|label| label.side);
            near[joint] = own.or(near[joint]);
            if let (Some(parent), Some(side)) = (self.skeleton.parent(joint), near[joint]) {
                near[parent] = Some(side);
            }
        }
        let below = near.clone();
        for joint in 0..count {
            let own = self.labels[joint].and_then(|label| label.side);
            let parent = self.skeleton.parent(joint);
            near[joint] = own.or_else(|| near[parent?]);
            if let Some(label) = &mut self.labels[joint]
                && label.word.sided()
            {
                label.side = near[joint].or(below[joint]);
            }
        }
    }

    pub(super) fn joint(&self, part: Part) -> Option<usize> {
        self.found.get(&part).map(|&(joint, _)| joint)
    }

    pub(super) fn put(&mut self, part: Part, joint: usize, evidence: Evidence) {
        if !self.assignments.contains_key(&part) && !self.found.contains_key(&part) {
            self.found.insert(part, (joint, evidence));
        }
    }

    pub(super) fn labelled(&self, side: Option<Side>, word: Word) -> Vec<usize> {
        let want = Some(Label { side, word });
        (0..self.labels.len())
            .filter(|&j| self.labels[j] == want)
            .collect()
    }

    pub(super) fn is_below(&self, joint: usize, above: usize) -> bool {
        self.skeleton.ancestors(joint).any(|j| j == above)
    }

    /// Assigns `part` to the first joint with one of the words, in the order of `words`. Other joints with the same
    /// word make the part ambiguous, unless they are below that joint.
    pub(super) fn take(&mut self, part: Part, words: &[Word]) {
        let side = part.side();
        let all = words.iter().map(|&word| self.labelled(side, word));
        let Some(all) = all.into_iter().find(|all| !all.is_empty()) else {
            return;
        };
        let first = all[0];
        let rivals = all[1..].iter().copied();
        let others: Vec<usize> = rivals.filter(|&j| !self.is_below(j, first)).collect();
        if !others.is_empty() && !self.assignments.contains_key(&part) {
            self.ambiguous.push(Ambiguity {
                part,
                taken: first,
                others,
            });
        }
        self.put(part, first, Evidence::Name);
    }

    fn head_and_trunk(&mut self) {
        self.take(Part::Hips, &[Word::Hips]);
        self.take(Part::Neck, &[Word::Neck]);
        self.take(Part::Head, &[Word::Head]);
        self.take(Part::Jaw, &[Word::Jaw]);
        for side in Side::BOTH {
            self.take(Part::Eye(side), &[Word::Eye]);
        }
    }

    fn arm(&mut self, side: Side) {
        let has = |word| !self.labelled(Some(side), word).is_empty();
        let has_upper = has(Word::UpperArm);
        let (clavicle, upper): (&[Word], &[Word]) = if has_upper {
            (&[Word::Clavicle, Word::Shoulder], &[Word::UpperArm])
        } else {
            (&[Word::Clavicle], &[Word::Shoulder])
        };
        self.take(Part::Clavicle(side), clavicle);
        self.take(Part::UpperArm(side), upper);
        self.take(Part::Forearm(side), &[Word::Forearm]);
        self.take_upper_of(Part::Hand(side), [Word::Wrist, Word::Hand]);
    }

    /// Assigns `part` to the one of two joints in a chain (wrist and hand) that is nearer to the body.
    fn take_upper_of(&mut self, part: Part, words: [Word; 2]) {
        let first = |word| self.labelled(part.side(), word).first().copied();
        let words = match words.map(first) {
            [Some(a), Some(b)] if b < a => [words[1], words[0]],
            _ => words,
        };
        self.take(part, &words);
    }

    fn leg(&mut self, side: Side) {
        let has = |word| !self.labelled(Some(side), word).is_empty();
        let has_thigh = has(Word::Thigh) || has(Word::SideHip);
        let (has_ankle, has_toes) = (has(Word::Ankle), has(Word::Toes));
        let thigh: &[Word] = if has_thigh {
            &[Word::Thigh, Word::SideHip]
        } else {
            &[Word::Leg]
        };
        self.take(Part::Thigh(side), thigh);
        if has_thigh {
            self.take(Part::Shin(side), &[Word::Shin, Word::Leg]);
        } else {
            self.take(Part::Shin(side), &[Word::Shin]);
        }
        self.take(Part::Foot(side), &[Word::Ankle, Word::Foot]);
        if has_toes {
            self.take(Part::Toes(side), &[Word::Toes]);
        } else if has_ankle {
            self.take(Part::Toes(side), &[Word::Foot]);
        }
    }

    fn digit(&mut self, side: Side, digit: Digit) {
        let mut chain: Vec<(usize, Segment)> = Vec::new();
        for (joint, label) in self.labels.iter().enumerate() {
            if let Some(label) = label
                && label.side == Some(side)
                && let Word::Digit(which, segment) = label.word
                && which == digit
            {
                chain.push((joint, segment));
            }
        }
        let Some(&(first, _)) = chain.first() else {
            return;
        };
        chain.retain(|&(joint, _)| self.is_below(joint, first));
        let joints: Vec<usize> = chain.iter().map(|&(joint, _)| joint).collect();
        let metacarpal = chain[0].1 == Segment::Metacarpal
            || (!chain.iter().any(|(_, s)| *s == Segment::Proximal)
                && self.starts_inside(digit, &joints));
        self.assign_digit(side, digit, &joints, metacarpal, Evidence::Name);
    }

    /// Assigns the parts of a digit to its joints, from the metacarpal or the base on. A thumb of four joints or more
    /// that starts inside the hand, as `metacarpal` says, has a joint before its own metacarpal, which is no part.
    pub(super) fn assign_digit(
        &mut self,
        side: Side,
        digit: Digit,
        joints: &[usize],
        metacarpal: bool,
        how: Evidence,
    ) {
        let skip = u8::from(!metacarpal);
        let extra = digit == Digit::Thumb && metacarpal && joints.len() > 3;
        let joints = &joints[usize::from(extra)..];
        for (place, &joint) in (0u8..).zip(joints) {
            let part = match digit {
                Digit::Thumb if place < 3 => Part::Thumb(side, place),
                Digit::Finger(finger) if place + skip < 4 => {
                    Part::Finger(side, finger, place + skip)
                }
                _ => break,
            };
            self.put(part, joint, how);
        }
    }

    /// Returns whether the first joint of a digit with three or more joints lies inside the hand: nearer to the wrist
    /// than to its second joint. That is so for a finger's metacarpal, and not for its base joint. For a thumb, which
    /// starts with its metacarpal, returns whether its first two bones are about as long as the third: then they lead
    /// from the wrist to the metacarpal, and else the last of four joints is the thumb's end.
    pub(super) fn starts_inside(&self, digit: Digit, chain: &[usize]) -> bool {
        let length = |joint: usize| self.skeleton.joint(joint).offset.length();
        match (digit, chain) {
            (Digit::Thumb, &[first, second, third, _, ..]) => {
                length(first) + length(second) < EXTRA * length(third)
            }
            (Digit::Thumb, _) => false,
            (Digit::Finger(_), &[first, second, _, ..]) => length(first) < length(second),
            (Digit::Finger(_), _) => false,
        }
    }

    /// Finds the chest, where the arms (or one arm and the neck) branch off, and the spine, which begins above the
    /// hips.
    fn chest_and_spine(&mut self) {
        let arms: Vec<usize> = Side::BOTH
            .iter()
            .filter_map(|&side| {
                let clavicle = self.joint(Part::Clavicle(side));
                clavicle.or_else(|| self.joint(Part::UpperArm(side)))
            })
            .collect();
        let neck = self.joint(Part::Neck).or_else(|| self.joint(Part::Head));
        let fork = match (arms.as_slice(), neck) {
            (&[a, b], _) | (&[a], Some(b)) => self.common(a, b),
            (&[a], None) => self.skeleton.parent(a),
            _ => None,
        };
        let is_spine = |finder: &Self, joint: usize| {
            finder.labels[joint].is_some_and(|label| label.word == Word::Spine)
        };
        let hips = self.joint(Part::Hips);
        let last_named = (0..self.labels.len()).rev().find(|&j| is_spine(self, j));
        let Some(chest) = fork.filter(|&j| Some(j) != hips).or(last_named) else {
            return;
        };
        let how = |finder: &Self, joint| {
            if is_spine(finder, joint) {
                Evidence::Name
            } else {
                Evidence::Topology
            }
        };
        self.put(Part::Chest, chest, how(self, chest));
        let path = self.skeleton.ancestors(chest);
        let above: Vec<usize> = path.take_while(|&j| Some(j) != hips && j != 0).collect();
        let named = above.iter().rev().find(|&&j| is_spine(self, j));
        if let Some(&spine) = named.or(above.last()) {
            self.put(Part::Spine, spine, how(self, spine));
        }
    }

    /// Returns the lowest common ancestor of two joints, which may be one of them.
    pub(super) fn common(&self, a: usize, b: usize) -> Option<usize> {
        let above: Vec<usize> = self.skeleton.ancestors(b).collect();
        self.skeleton
            .ancestors(a)
            .find(|joint| above.contains(joint))
    }
}

/// Pairs joints by part, then by name with the sides exchanged, then by their position below paired joints.
pub(super) fn mirror_map(anatomy: &Anatomy, skeleton: &Skeleton) -> Vec<Option<usize>> {
    let mut map: Vec<Option<usize>> = Vec::with_capacity(skeleton.len());
    let mut names: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, joint) in skeleton.joints().iter().enumerate() {
        names.entry(&joint.name).or_insert(index);
    }
    let mut free: Vec<Vec<usize>> = vec![Vec::new(); skeleton.len()];
    let mut rank = vec![0; skeleton.len()];
    for joint in (0..skeleton.len()).filter(|&joint| anatomy.part_of(joint).is_none()) {
        if let Some(parent) = skeleton.parent(joint) {
            rank[joint] = free[parent].len();
            free[parent].push(joint);
        }
    }
    for joint in 0..skeleton.len() {
        let counterpart = match anatomy.part_of(joint) {
            Some(part) => anatomy.joint(part.mirrored()),
            None => {
                let named = other_side(&skeleton.joint(joint).name);
                let named = named.and_then(|name| names.get(name.as_str()).copied());
                named.or_else(|| match skeleton.parent(joint) {
                    Some(parent) => {
                        let (here, there) = (&free[parent], &free[map[parent]?]);
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
        before && (edge(after) || (n == 0 && after.is_some_and(|c| c.is_uppercase())))
    };
    let at = (0..letters.len()).find(|&n| "lrLR".contains(letters[n]) && alone(n))?;
    let swapped = match letters[at] {
        'l' => 'r',
        'r' => 'l',
        'L' => 'R',
        _ => 'L',
    };
    let mut letters = letters;
    letters[at] = swapped;
    Some(letters.into_iter().collect())
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{PLAIN, body, renamed, roles};
    use super::*;
    use crate::skeleton::Joint;

    /// Returns a body whose thumbs have four joints: one more at a share of the path from the wrist to the metacarpal,
    /// or else one more at the thumb's end.
    fn with_long_thumbs(names: [&str; 4], inside: Option<f64>) -> Skeleton {
        let plain = body(PLAIN);
        let anatomy = Anatomy::with_roles(&plain, &roles(&plain)).expect("its own names");
        let mut joints: Vec<Joint> = Vec::new();
        let mut places = vec![0; plain.len()];
        let named = |side: Side, n: usize| {
            names[n].replace("{}", ["Right", "Left"][super::super::place(side)])
        };
        for (n, joint) in plain.joints().iter().enumerate() {
            let mut joint = joint.clone();
            joint.parent = joint.parent.map(|parent| places[parent]);
            match anatomy.part_of(n) {
                Some(Part::Thumb(side, bone)) => {
                    let bone = usize::from(bone);
                    if let Some(share) = inside.filter(|_| bone == 0) {
                        let offset = joint.offset * share;
                        joints.push(Joint::new(named(side, 0), joint.parent, offset));
                        joint.parent = Some(joints.len() - 1);
                        joint.offset -= offset;
                    }
                    joint.name = named(side, bone + usize::from(inside.is_some()));
                    places[n] = joints.len();
                    let tip = joint.tip.take();
                    joints.push(joint);
                    if let Some(tip) = tip {
                        if inside.is_none() {
                            joints.push(Joint::new(named(side, 3), Some(places[n]), tip));
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
        let numbered = [
            "{}HandThumb1",
            "{}HandThumb2",
            "{}HandThumb3",
            "{}HandThumb4",
        ];
        let from_zero = [
            "{}HandThumb0",
            "{}HandThumb1",
            "{}HandThumb2",
            "{}HandThumb3",
        ];
        let in_hand = [
            "{}InHandThumb",
            "{}HandThumb1",
            "{}HandThumb2",
            "{}HandThumb3",
        ];
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
            let mut known = roles(&skeleton);
            known.0.retain(|part, _| match part {
                Part::Thumb(..) => false,
                Part::Finger(..) => !unnamed,
                _ => true,
            });
            let anatomy = Anatomy::with_roles(&skeleton, &known).expect("its own names");
            for side in Side::BOTH {
                for bone in 0..3u8 {
                    let joint = anatomy.joint(Part::Thumb(side, bone)).expect("a thumb");
                    let name = &skeleton.joint(joint).name;
                    let at = usize::from(bone) + usize::from(inside.is_some());
                    let word = ["Right", "Left"][super::super::place(side)];
                    assert_eq!(*name, names[at].replace("{}", word), "{inside:?} {bone}");
                }
            }
        }
    }

    /// Returns a body whose arms have names without a meaning but with a side, and helpers on their bones.
    fn with_helpers(sides: [&str; 2]) -> Skeleton {
        let plain = body(PLAIN);
        let mut joints: Vec<Joint> = Vec::new();
        let mut places = Vec::new();
        for (n, joint) in plain.joints().iter().enumerate() {
            let mut joint = joint.clone();
            let side = usize::from(joint.name.starts_with("left"));
            let sided = joint.name.starts_with("left") || joint.name.starts_with("right");
            let arm = joint.name.ends_with("arm");
            joint.parent = joint.parent.map(|parent| places[parent]);
            joint.name = format!("{}x{n}", if sided { sides[side] } else { "" });
            places.push(joints.len());
            joints.push(joint);
            let next = plain.children(n).first().filter(|_| arm);
            if let Some(&next) = next {
                let at = plain.joint(next).offset;
                let here = places[n];
                for share in [0.0, 0.5] {
                    joints.push(Joint::new(format!("h{n}{share}"), Some(here), at * share));
                }
            }
        }
        Skeleton::new(joints).expect("a tree")
    }

    #[test]
    fn arms_with_helpers_on_their_bones_are_found_on_the_sides_that_names_state() {
        for (sides, swapped) in [
            (["", ""], false),
            (["R_", "L_"], false),
            (["L_", "R_"], true),
        ] {
            let skeleton = with_helpers(sides);
            let anatomy = Anatomy::detect(&skeleton);
            let rest = skeleton.rest_model_pose();
            for side in Side::BOTH {
                for part in [Part::UpperArm(side), Part::Forearm(side), Part::Hand(side)] {
                    let joint = anatomy.joint(part).expect("found by topology");
                    assert!(!skeleton.joint(joint).name.starts_with('h'), "{part}");
                    let is_left = rest.position(joint).x > 0.0;
                    assert_eq!(is_left, (side == Side::Left) != swapped, "{part}");
                }
                let finger = Part::Finger(side, crate::hand::Finger::Little, 3);
                assert!(anatomy.joint(finger).is_some(), "{sides:?}");
            }
        }
    }

    #[test]
    fn a_root_on_the_floor_is_not_the_hips() {
        let plain = body(PLAIN);
        let mut joints = vec![Joint::new("root", None, glam::DVec3::ZERO)];
        joints.extend(plain.joints().iter().cloned().map(|mut joint| {
            joint.parent = Some(joint.parent.map_or(0, |parent| parent + 1));
            if joint.name == "hips" {
                joint.name = "pivot".to_owned();
            }
            joint
        }));
        let skeleton = Skeleton::new(joints).expect("a tree");
        let hips = Anatomy::detect(&skeleton).joint(Part::Hips);
        assert_eq!(
            hips.map(|it| skeleton.joint(it).name.as_str()),
            Some("pivot")
        );
    }

    #[test]
    fn toes_of_legs_without_known_names_are_no_markers() {
        let plain = body(PLAIN);
        let skeleton = renamed(&plain, |_, name| {
            let leg = ["thigh", "shin", "foot", "toes"];
            match leg.iter().find(|part| name.ends_with(*part)) {
                Some(part) => format!("{}-{}", &name[..2], part.replace(['e', 'i', 'o'], "x")),
                None => name.to_owned(),
            }
        });
        let anatomy = Anatomy::detect(&skeleton);
        assert_eq!(anatomy.markers(), [0; 0]);
        assert!(anatomy.arm(Side::Left).is_some());
    }
}
