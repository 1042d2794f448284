//! The ends of thumbs and fingers, and lengths of their bones that no hand has.

use glam::DVec3;

use super::fingers::in_hand;
use super::{Anatomy, Part};
use crate::hand::Finger;
use crate::skeleton::Skeleton;

/// The angle by which the last bone of a digit may be bent more than the one before it at rest, in radians; it is up to
/// 12 degrees in captures.
const STIFF: f64 = 0.6;

/// Returns the end of a digit's last bone as its file has it, in the joint's space: the joint's tip, or its only child.
fn written_end(anatomy: &Anatomy, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
    let tip = skeleton.joint(joint).tip;
    tip.or_else(|| match *skeleton.children(joint) {
        [child] if anatomy.part_of(child).is_none() => Some(skeleton.joint(child).offset),
        _ => None,
    })
}

/// Returns the usual length of a digit's last bone, as the bone before it and the palm suggest; the longer of the two.
/// `None` if the joint is not below another one of the digit.
fn usual_end(anatomy: &Anatomy, skeleton: &Skeleton, joint: usize) -> Option<f64> {
    let digit = anatomy.part_of(joint).filter(is_digit)?;
    let above = skeleton.parent(joint)?;
    anatomy.part_of(above).filter(is_digit)?;
    let hand = digit
        .side()
        .and_then(|side| anatomy.joint(Part::Hand(side)));
    let palm = digit.side().zip(hand).and_then(|(side, hand)| {
        let knuckles = Finger::ALL.map(|finger| anatomy.joint(Part::Finger(side, finger, 1)));
        let lengths = knuckles.into_iter().flatten();
        let lengths = lengths.map(|knuckle| in_hand(skeleton, hand, knuckle).0.length());
        lengths.reduce(f64::min)
    });
    let before = skeleton.joint(joint).offset.length();
    Some((END[0] * before).max(END[1] * palm.unwrap_or_default()))
}

fn is_digit(part: &Part) -> bool {
    matches!(part, Part::Thumb(..) | Part::Finger(..))
}

/// The last bone of a digit with its flesh as a share of the bone before it, and of the palm from wrist to knuckle
/// (Buryanov and Kotiuk 2010, Int. J. Morphol. 28(3), table I: 0.8 to 1, and 0.27).
const END: [f64; 2] = [0.8, 0.25];
/// The length of a last bone from which it is impossible, as a multiple of the usual one.
const LONG: f64 = 2.0;

/// Returns the end of a digit's last bone in the joint's space.
///
/// Some programs write ends along an axis of the joint instead of along the finger. A tip is turned to the direction of
/// the bone before it if it is off by more than end joints bend at rest: [`STIFF`] more than the bone before is bent. An
/// end that is impossibly far away is drawn in to the usual length.
pub(super) fn digit_tip(anatomy: &Anatomy, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
    let end = straight_end(anatomy, skeleton, joint)?;
    let usual = usual_end(anatomy, skeleton, joint).filter(|usual| end.length() > LONG * usual);
    Some(match usual.filter(|usual| *usual > 0.0) {
        Some(usual) => end.normalize_or_zero() * usual,
        None => end,
    })
}

/// Returns the end of a digit's last bone in the direction of the digit.
fn straight_end(anatomy: &Anatomy, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
    let own = skeleton.joint(joint);
    let Some(tip) = own.tip else {
        return written_end(anatomy, skeleton, joint);
    };
    let above = skeleton.parent(joint);
    let above = above.filter(|&above| anatomy.part_of(above).as_ref().is_some_and(is_digit));
    let Some(above) = above.map(|above| skeleton.joint(above)) else {
        return Some(tip);
    };
    let bones = [
        above.rest.inverse() * above.offset,
        own.offset,
        own.rest * tip,
    ];
    let [Some(first), Some(second), Some(last)] = bones.map(DVec3::try_normalize) else {
        return Some(tip);
    };
    if last.angle_between(second) <= STIFF + second.angle_between(first) {
        return Some(tip);
    }
    Some(own.rest.inverse() * second * tip.length())
}

/// A fault of the end of a thumb or finger in its file, which is mended for measures and pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum OddTip {
    /// It points elsewhere than the finger, and is turned to the direction of the bone before.
    Turned,
    /// It has no length.
    Short,
    /// It is over twice as long as the rest of the hand suggests, and is drawn in to the usual length.
    Long,
}

/// The least length of a tip as a share of the bone before it.
const SHORT: f64 = 0.05;

impl Anatomy {
    /// Returns the tip of a joint in the joint's space, as [`digit_end`](Self::digit_end) for the last joint of a thumb
    /// or finger; `None` if the joint has none.
    #[must_use]
    pub fn tip(&self, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
        skeleton.joint(joint).tip?;
        self.digit_end(skeleton, joint)
    }

    /// Returns the end of the last bone of a thumb or finger in its joint's space: its tip, or a joint that only ends it.
    /// One that points elsewhere than its bones is turned, and one that is impossibly far away is drawn in; `None` if
    /// there is none, or one that is as good as none.
    #[must_use]
    pub fn digit_end(&self, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
        match self.odd_tip(skeleton, joint) {
            Some(OddTip::Short) => None,
            _ => digit_tip(self, skeleton, joint),
        }
    }

    /// Returns the fault of the end of a joint's bone, if it ends a thumb or finger and has one.
    #[must_use]
    pub fn odd_tip(&self, skeleton: &Skeleton, joint: usize) -> Option<OddTip> {
        let own = skeleton.joint(joint);
        let end = written_end(self, skeleton, joint)?;
        self.part_of(joint).filter(is_digit)?;
        if usual_end(self, skeleton, joint).is_some_and(|usual| end.length() > LONG * usual) {
            return Some(OddTip::Long);
        }
        if !skeleton.children(joint).is_empty() {
            return None;
        }
        if end.length() <= SHORT * own.offset.length() {
            return Some(OddTip::Short);
        }
        (digit_tip(self, skeleton, joint) != Some(end)).then_some(OddTip::Turned)
    }
}

impl Anatomy {
    /// Returns the joints of thumbs and fingers whose bone from the joint before is over twice as long as that of the other
    /// hand, and as the median of the other fingers; each with the longer one of these, in the unit of the skeleton.
    #[must_use]
    pub fn long_finger_bones(&self, skeleton: &Skeleton) -> Vec<(usize, f64)> {
        let length = |part| Some(skeleton.joint(self.joint(part)?).offset.length());
        let usual = |part: Part| {
            let (other, mut alike) = match part {
                Part::Thumb(side, at @ 1..) => (Part::Thumb(side.other(), at), Vec::new()),
                Part::Finger(side, finger, at @ 2..) => {
                    let others = Finger::ALL.into_iter().filter(|other| *other != finger);
                    let others = others.filter_map(|other| length(Part::Finger(side, other, at)));
                    (Part::Finger(side.other(), finger, at), others.collect())
                }
                _ => return None,
            };
            alike.sort_by(f64::total_cmp);
            let median = alike.get(alike.len() / 2).copied();
            length(other).into_iter().chain(median).reduce(f64::max)
        };
        let long = self.found().filter_map(|(part, joint, _)| {
            let own = skeleton.joint(joint).offset.length();
            let usual = usual(part).filter(|usual| *usual > 0.0 && own > LONG * usual);
            Some((joint, usual?))
        });
        long.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{PLAIN, Wear, body, roles};
    use super::*;
    use crate::hand::{HandAngles, Side};
    use crate::pose::ModelPose;
    use crate::skeleton::Joint;

    fn known(joints: Vec<Joint>) -> (Skeleton, Anatomy) {
        let skeleton = Skeleton::new(joints).expect("a tree");
        let anatomy = Anatomy::with_roles(&skeleton, &roles(&skeleton)).expect("its own names");
        (skeleton, anatomy)
    }

    #[test]
    fn bones_over_twice_as_long_as_the_others_are_named() {
        for (part, by, is_long) in [
            (Part::Finger(Side::Left, Finger::Ring, 2), 2.5, true),
            (Part::Thumb(Side::Right, 1), 2.5, true),
            (Part::Finger(Side::Left, Finger::Ring, 2), 1.3, false),
            (Part::Finger(Side::Left, Finger::Ring, 1), 2.5, false),
        ] {
            let mut joints = body(PLAIN).joints().to_vec();
            let joint = joints.iter().position(|it| it.name == part.to_string());
            let joint = joint.expect("a joint");
            let own = joints[joint].offset.length();
            joints[joint].offset *= by;
            let (skeleton, anatomy) = known(joints);
            let found = anatomy.long_finger_bones(&skeleton);
            let named: Vec<usize> = found.iter().map(|(joint, _)| *joint).collect();
            let want = if is_long { vec![joint] } else { Vec::new() };
            assert_eq!(named, want, "{part} {by}");
            for (_, usual) in found {
                assert!((usual / own - 1.0).abs() < 0.3, "{part}: {usual} for {own}");
            }
        }
    }

    #[test]
    fn ends_over_twice_as_long_as_usual_are_drawn_in() {
        let plain = body(PLAIN);
        for (length, is_joint, is_long) in [
            (0.72, false, true),
            (1.0, false, true),
            (0.72, true, true),
            (0.03, false, false),
            (0.03, true, false),
        ] {
            let mut joints = plain.joints().to_vec();
            let name = Part::Finger(Side::Left, Finger::Middle, 3).to_string();
            let last = plain.find(&name).expect("a last joint");
            let tip = joints[last].tip.expect("a tip").normalize() * length;
            joints[last].tip = Some(tip).filter(|_| !is_joint);
            if is_joint {
                joints.push(Joint::new("LeftHandMiddle4", Some(last), tip));
            }
            let skeleton = Skeleton::new(joints).expect("a tree");
            let anatomy = Anatomy::with_roles(&skeleton, &roles(&plain)).expect("roles");
            let case = format!("{length} m, {is_joint}");
            let odd = anatomy.odd_tip(&skeleton, last) == Some(OddTip::Long);
            assert_eq!(odd, is_long, "{case}");
            let usual = Anatomy::with_roles(&plain, &roles(&plain)).expect("roles");
            let [drawn, own] =
                [(&skeleton, &anatomy), (&plain, &usual)].map(|(skeleton, anatomy)| {
                    let model = skeleton.rest_model_pose();
                    let tip = anatomy.landmark(skeleton, &model, "left-middle-tip");
                    tip.expect("a tip").distance(model.position(last))
                });
            let want = if is_long { own } else { length };
            assert!((drawn - want).abs() < 0.012, "{case}: {drawn}");
            let [hand, own] = [anatomy, usual].map(|it| it.measures().expect("measures").hand);
            assert!((hand / own - 1.0).abs() < 0.1, "{case}: {hand}");
        }
    }

    #[test]
    fn a_tip_that_points_elsewhere_than_its_finger_is_turned_to_the_bone_before() {
        let wear = Wear { bent: 0.1, ..PLAIN };
        let (plain, anatomy) = known(body(wear).joints().to_vec());
        let mut angles = HandAngles::default();
        for finger in &mut angles.fingers {
            finger.flexion = [0.4, 1.2, 0.7];
        }
        angles.thumb.flexion = [0.3, 0.5];
        let mut pose = plain.rest_pose();
        for side in Side::BOTH {
            assert!(anatomy.set_hand_angles(&plain, side, &angles, &mut pose));
        }
        for axis in [DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
            let mut joints = plain.joints().to_vec();
            for joint in &mut joints {
                let part = joint.name.parse();
                if matches!(part, Ok(Part::Thumb(..) | Part::Finger(..))) {
                    joint.tip = joint.tip.map(|tip| axis * tip.length());
                }
            }
            let (odd, read) = known(joints);
            for side in Side::BOTH {
                let got = read.hand_angles(&odd, side, &pose).expect("a hand");
                for (a, b) in got.to_array().into_iter().zip(angles.to_array()) {
                    // The tips of `plain` are bent by 0.1 at rest, which nothing else shows.
                    assert!((a - b).abs() < 0.11, "{axis} {side:?}: {got:?}");
                }
                let model = ModelPose::of(&plain, &pose);
                for finger in Finger::ALL {
                    let name = format!("{}-{}-tip", side.name(), finger.name());
                    let at = |(skeleton, anatomy): (&Skeleton, &Anatomy)| {
                        anatomy.landmark(skeleton, &model, &name).expect("a tip")
                    };
                    let (one, other) = (at((&plain, &anatomy)), at((&odd, &read)));
                    assert!(one.distance(other) < 0.003, "{axis} {name}");
                    let last = read.joint(Part::Finger(side, finger, 3)).expect("a joint");
                    assert_eq!(read.odd_tip(&odd, last), Some(OddTip::Turned));
                    let (tip, plain_tip) = (read.tip(&odd, last), plain.joint(last).tip);
                    let off = tip.expect("a tip").distance(plain_tip.expect("a tip"));
                    assert!(off < 0.003, "{axis} {name}: {off}");
                }
            }
        }
    }

    #[test]
    fn the_tips_of_fingers_that_are_bent_at_rest_are_believed() {
        for bent in [0.0, 0.2, 0.5, 0.8, 1.2] {
            let (skeleton, anatomy) = known(body(Wear { bent, ..PLAIN }).joints().to_vec());
            for joint in 0..skeleton.len() {
                let tip = digit_tip(&anatomy, &skeleton, joint);
                assert_eq!(tip, skeleton.joint(joint).tip, "{bent}");
                assert_eq!(anatomy.tip(&skeleton, joint), tip, "{bent}");
                assert_eq!(anatomy.odd_tip(&skeleton, joint), None, "{bent}");
            }
        }
    }

    #[test]
    fn a_tip_without_a_length_is_none() {
        let mut joints = body(PLAIN).joints().to_vec();
        for joint in &mut joints {
            joint.tip = joint.tip.map(|_| DVec3::ZERO);
        }
        let (skeleton, anatomy) = known(joints);
        for side in Side::BOTH {
            let last = anatomy.joint(Part::Finger(side, Finger::Index, 3));
            let last = last.expect("a joint");
            assert_eq!(anatomy.odd_tip(&skeleton, last), Some(OddTip::Short));
            assert_eq!(anatomy.tip(&skeleton, last), None);
        }
        let head = anatomy.joint(Part::Head).expect("a head");
        assert_eq!(anatomy.odd_tip(&skeleton, head), None);
        assert_eq!(anatomy.tip(&skeleton, head), skeleton.joint(head).tip);
    }
}
