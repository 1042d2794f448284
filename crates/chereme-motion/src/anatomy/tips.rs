//! The ends of thumbs and fingers, and lengths of their bones that no hand has.

use glam::DVec3;

use super::fingers::in_hand;
use super::{BodyAnatomy, BodyPart};
use crate::hand::HandFinger;
use crate::skeleton::Skeleton;

/// The angle by which the last bone of a digit may be bent more than the one before it at rest, in radians; it is up to
/// 12 degrees in captures.
const STIFF_BEND_RADIANS: f64 = 0.6;

/// Returns the end of a digit's last bone as its file has it, in the joint's space: the joint's tip, or its only child.
fn written_end(anatomy: &BodyAnatomy, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
    let tip = skeleton.joint_at(joint).tip;
    // A child with a part of its own is a joint of the digit, not its end.
    tip.or_else(|| match *skeleton.joint_children(joint) {
        [child] if anatomy.part_of(child).is_none() => Some(skeleton.joint_at(child).offset),
        _ => None,
    })
}

/// Returns the usual length of a digit's last bone, as the bone before it and the palm suggest; the longer of the two.
/// `None` if the joint is not below another one of the digit.
fn usual_end(anatomy: &BodyAnatomy, skeleton: &Skeleton, joint: usize) -> Option<f64> {
    let digit = anatomy.part_of(joint).filter(is_digit)?;
    let above = skeleton.joint_parent(joint)?;
    anatomy.part_of(above).filter(is_digit)?;
    let hand = digit
        .part_side()
        .and_then(|side| anatomy.part_joint(BodyPart::Hand(side)));
    let palm = digit.part_side().zip(hand).and_then(|(side, hand)| {
        let knuckles = HandFinger::ALL_FINGERS.map(|finger| anatomy.part_joint(BodyPart::Finger(side, finger, 1)));
        let present_knuckles = knuckles.into_iter().flatten();
        let lengths = present_knuckles.map(|knuckle| in_hand(skeleton, hand, knuckle).0.length());
        lengths.reduce(f64::min)
    });
    let before = skeleton.joint_at(joint).offset.length();
    // Whichever is longer, so that only truly impossible bones count as too long.
    Some((DIGIT_END_SHARES[0] * before).max(DIGIT_END_SHARES[1] * palm.unwrap_or_default()))
}

fn is_digit(part: &BodyPart) -> bool {
    matches!(part, BodyPart::Thumb(..) | BodyPart::Finger(..))
}

/// The last bone of a digit with its flesh as a share of the bone before it, and of the palm from wrist to knuckle
/// (Buryanov and Kotiuk 2010, Int. J. Morphol. 28(3), table I: 0.8 to 1, and 0.27).
const DIGIT_END_SHARES: [f64; 2] = [0.8, 0.25];
/// The length of a last bone from which it is impossible, as a multiple of the usual one.
const LONG_BONE_FACTOR: f64 = 2.0;

/// Returns the end of a digit's last bone in the joint's space.
///
/// Some programs write ends along an axis of the joint instead of along the finger. A tip is turned to the direction of
/// the bone before it if it is off by more than end joints bend at rest: [`STIFF_BEND_RADIANS`] more than the bone before is bent. An
/// end that is impossibly far away is drawn in to the usual length.
pub(super) fn digit_tip(anatomy: &BodyAnatomy, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
    let end = straight_end(anatomy, skeleton, joint)?;
    let usual = usual_end(anatomy, skeleton, joint).filter(|usual| end.length() > LONG_BONE_FACTOR * usual);
    Some(match usual.filter(|usual| *usual > 0.0) {
        Some(usual) => end.normalize_or_zero() * usual,
        None => end,
    })
}

/// Returns the end of a digit's last bone in the direction of the digit.
fn straight_end(anatomy: &BodyAnatomy, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
    let end_joint = skeleton.joint_at(joint);
    // An end joint was placed by somebody; only tips are written along a wrong axis.
    let Some(tip) = end_joint.tip else {
        return written_end(anatomy, skeleton, joint);
    };
    let parent = skeleton.joint_parent(joint);
    // Below the hand there is no bone of the digit to compare with.
    let above = parent.filter(|&above| anatomy.part_of(above).as_ref().is_some_and(is_digit));
    let Some(above) = above.map(|above| skeleton.joint_at(above)) else {
        return Some(tip);
    };
    let bones = [
        above.rest.inverse() * above.offset,
        end_joint.offset,
        end_joint.rest * tip,
    ];
    // A bone without length has no direction to compare.
    let [Some(first), Some(second), Some(last)] = bones.map(DVec3::try_normalize) else {
        return Some(tip);
    };
    if last.angle_between(second) <= STIFF_BEND_RADIANS + second.angle_between(first) {
        return Some(tip);
    }
    Some(end_joint.rest.inverse() * second * tip.length())
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
const MIN_TIP_SHARE: f64 = 0.05;

impl BodyAnatomy {
    /// Returns the tip of a joint in the joint's space, as [`digit_end`](Self::digit_end) for the last joint of a thumb
    /// or finger; `None` if the joint has none.
    #[must_use]
    pub fn joint_tip(&self, skeleton: &Skeleton, joint: usize) -> Option<DVec3> {
        skeleton.joint_at(joint).tip?;
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
        let own_joint = skeleton.joint_at(joint);
        let end = written_end(self, skeleton, joint)?;
        self.part_of(joint).filter(is_digit)?;
        if usual_end(self, skeleton, joint).is_some_and(|usual| end.length() > LONG_BONE_FACTOR * usual) {
            return Some(OddTip::Long);
        }
        // A joint that ends the bone is trusted except for its length.
        if !skeleton.joint_children(joint).is_empty() {
            return None;
        }
        if end.length() <= MIN_TIP_SHARE * own_joint.offset.length() {
            return Some(OddTip::Short);
        }
        (digit_tip(self, skeleton, joint) != Some(end)).then_some(OddTip::Turned)
    }
}

impl BodyAnatomy {
    /// Returns the joints of thumbs and fingers whose bone from the joint before is over twice as long as that of the other
    /// hand, and as the median of the other fingers; each with the longer one of these, in the unit of the skeleton.
    #[must_use]
    pub fn long_finger_bones(&self, skeleton: &Skeleton) -> Vec<(usize, f64)> {
        let length = |part| Some(skeleton.joint_at(self.part_joint(part)?).offset.length());
        let usual = |part: BodyPart| {
            // The thumb has no finger beside it to compare with: only the other hand.
            let (other, mut alike) = match part {
                BodyPart::Thumb(side, at @ 1..) => (BodyPart::Thumb(side.opposite_side(), at), Vec::new()),
                BodyPart::Finger(side, finger, at @ 2..) => {
                    let other_fingers = HandFinger::ALL_FINGERS.into_iter().filter(|other| *other != finger);
                    let others = other_fingers.filter_map(|other| length(BodyPart::Finger(side, other, at)));
                    (BodyPart::Finger(side.opposite_side(), finger, at), others.collect())
                }
                _ => return None,
            };
            alike.sort_by(f64::total_cmp);
            let median = alike.get(alike.len() / 2).copied();
            length(other).into_iter().chain(median).reduce(f64::max)
        };
        let long = self.found_parts().filter_map(|(part, joint, _)| {
            let bone_length = skeleton.joint_at(joint).offset.length();
            let usual = usual(part).filter(|usual| *usual > 0.0 && bone_length > LONG_BONE_FACTOR * usual);
            Some((joint, usual?))
        });
        long.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::fixtures::{BodyVariation, PLAIN_BODY_VARIATION, fixture_body, fixture_joint_roles};
    use super::*;
    use crate::hand::{BodySide, HandAngles};
    use crate::pose::ModelPose;
    use crate::skeleton::SkeletonJoint;

    fn known(joints: Vec<SkeletonJoint>) -> (Skeleton, BodyAnatomy) {
        let skeleton = Skeleton::new(joints).expect("a tree");
        let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("its own names");
        (skeleton, anatomy)
    }

    #[test]
    fn bones_over_twice_as_long_as_the_others_are_named() {
        for (part, by, is_long) in [
            (BodyPart::Finger(BodySide::Left, HandFinger::Ring, 2), 2.5, true),
            (BodyPart::Thumb(BodySide::Right, 1), 2.5, true),
            (BodyPart::Finger(BodySide::Left, HandFinger::Ring, 2), 1.3, false),
            (BodyPart::Finger(BodySide::Left, HandFinger::Ring, 1), 2.5, false),
        ] {
            let mut joints = fixture_body(PLAIN_BODY_VARIATION).skeleton_joints().to_vec();
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
        let plain = fixture_body(PLAIN_BODY_VARIATION);
        for (length, is_joint, is_long) in [
            (0.72, false, true),
            (1.0, false, true),
            (0.72, true, true),
            (0.03, false, false),
            (0.03, true, false),
        ] {
            let mut joints = plain.skeleton_joints().to_vec();
            let name = BodyPart::Finger(BodySide::Left, HandFinger::Middle, 3).to_string();
            let last = plain.find_joint(&name).expect("a last joint");
            let tip = joints[last].tip.expect("a tip").normalize() * length;
            joints[last].tip = Some(tip).filter(|_| !is_joint);
            if is_joint {
                joints.push(SkeletonJoint::new("LeftHandMiddle4", Some(last), tip));
            }
            let skeleton = Skeleton::new(joints).expect("a tree");
            let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&plain)).expect("roles");
            let case = format!("{length} m, {is_joint}");
            let odd = anatomy.odd_tip(&skeleton, last) == Some(OddTip::Long);
            assert_eq!(odd, is_long, "{case}");
            let usual = BodyAnatomy::with_roles(&plain, &fixture_joint_roles(&plain)).expect("roles");
            let [drawn, own] = [(&skeleton, &anatomy), (&plain, &usual)].map(|(skeleton, anatomy)| {
                let model = skeleton.rest_model_pose();
                let tip = anatomy.landmark_place_position(skeleton, &model, "left-middle-tip");
                tip.expect("a tip").distance(model.model_joint_position(last))
            });
            let want = if is_long { own } else { length };
            assert!((drawn - want).abs() < 0.012, "{case}: {drawn}");
            let [hand, own] = [anatomy, usual].map(|it| it.anatomy_measures().expect("measures").hand);
            assert!((hand / own - 1.0).abs() < 0.1, "{case}: {hand}");
        }
    }

    #[test]
    fn a_tip_that_points_elsewhere_than_its_finger_is_turned_to_the_bone_before() {
        let wear = BodyVariation {
            bent: 0.1,
            ..PLAIN_BODY_VARIATION
        };
        let (plain, anatomy) = known(fixture_body(wear).skeleton_joints().to_vec());
        let mut angles = HandAngles::default();
        for finger in &mut angles.fingers {
            finger.flexion = [0.4, 1.2, 0.7];
        }
        angles.thumb.flexion = [0.3, 0.5];
        let mut pose = plain.rest_pose();
        for side in BodySide::BOTH_SIDES {
            assert!(anatomy.set_hand_angles(&plain, side, &angles, &mut pose));
        }
        for axis in [DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
            let mut joints = plain.skeleton_joints().to_vec();
            for joint in &mut joints {
                let part = joint.name.parse();
                if matches!(part, Ok(BodyPart::Thumb(..) | BodyPart::Finger(..))) {
                    joint.tip = joint.tip.map(|tip| axis * tip.length());
                }
            }
            let (odd, read) = known(joints);
            for side in BodySide::BOTH_SIDES {
                let got = read.hand_angles(&odd, side, &pose).expect("a hand");
                for (a, b) in got.to_array().into_iter().zip(angles.to_array()) {
                    // The tips of `plain` are bent by 0.1 at rest, which nothing else shows.
                    assert!((a - b).abs() < 0.11, "{axis} {side:?}: {got:?}");
                }
                let model = ModelPose::from_local_pose(&plain, &pose);
                for finger in HandFinger::ALL_FINGERS {
                    let name = format!("{}-{}-tip", side.body_side_name(), finger.finger_name());
                    let at = |(skeleton, anatomy): (&Skeleton, &BodyAnatomy)| {
                        anatomy.landmark_place_position(skeleton, &model, &name).expect("a tip")
                    };
                    let (one, other) = (at((&plain, &anatomy)), at((&odd, &read)));
                    assert!(one.distance(other) < 0.003, "{axis} {name}");
                    let last = read.part_joint(BodyPart::Finger(side, finger, 3)).expect("a joint");
                    assert_eq!(read.odd_tip(&odd, last), Some(OddTip::Turned));
                    let (tip, plain_tip) = (read.joint_tip(&odd, last), plain.joint_at(last).tip);
                    let off = tip.expect("a tip").distance(plain_tip.expect("a tip"));
                    assert!(off < 0.003, "{axis} {name}: {off}");
                }
            }
        }
    }

    #[test]
    fn the_tips_of_fingers_that_are_bent_at_rest_are_believed() {
        for bent in [0.0, 0.2, 0.5, 0.8, 1.2] {
            let (skeleton, anatomy) = known(
                fixture_body(BodyVariation {
                    bent,
                    ..PLAIN_BODY_VARIATION
                })
                .skeleton_joints()
                .to_vec(),
            );
            for joint in 0..skeleton.len() {
                let tip = digit_tip(&anatomy, &skeleton, joint);
                assert_eq!(tip, skeleton.joint_at(joint).tip, "{bent}");
                assert_eq!(anatomy.joint_tip(&skeleton, joint), tip, "{bent}");
                assert_eq!(anatomy.odd_tip(&skeleton, joint), None, "{bent}");
            }
        }
    }

    #[test]
    fn a_tip_without_a_length_is_none() {
        let mut joints = fixture_body(PLAIN_BODY_VARIATION).skeleton_joints().to_vec();
        for joint in &mut joints {
            joint.tip = joint.tip.map(|_| DVec3::ZERO);
        }
        let (skeleton, anatomy) = known(joints);
        for side in BodySide::BOTH_SIDES {
            let last = anatomy.part_joint(BodyPart::Finger(side, HandFinger::Index, 3));
            let last = last.expect("a joint");
            assert_eq!(anatomy.odd_tip(&skeleton, last), Some(OddTip::Short));
            assert_eq!(anatomy.joint_tip(&skeleton, last), None);
        }
        let head = anatomy.part_joint(BodyPart::Head).expect("a head");
        assert_eq!(anatomy.odd_tip(&skeleton, head), None);
        assert_eq!(anatomy.joint_tip(&skeleton, head), skeleton.joint_at(head).tip);
    }
}
