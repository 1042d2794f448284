//! Conversion between hand angles and local rotations, and the directions of the hand.
//!
//! All axes come from the rest geometry, so that the same angles look alike on any skeleton. With *along* from the
//! wrist to the base of the middle finger, *radial* towards the thumb's side and *palm* out of the palm, all
//! perpendicular, a finger joint has the rotation D in the hand's space:
//!
//! `D = B(flexion) · N(spread)` at the base, `· B(flexion)` at each joint further out,
//!
//! where B turns along → palm and N along → radial (flexion first, then the floating axis, as in
//! the ISB's recommendation for fingers: Wu et al. 2005, J. Biomech. 38). The thumb's metacarpal is
//! turned by `N(radial) · B(palmar) · O(opposition)`, O about its own length, and its joints by
//! turns along → away from *radial*. D is relative to the straight finger along the hand.

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec3};

use super::tips::digit_tip;
use super::{BodyAnatomy, BodyPart};
use crate::euler::RotationOrder;
use crate::hand::{BodySide, FingerAngles, HandAngles, HandFinger, ThumbAngles};
use crate::pose::{LocalPose, ModelPose};
use crate::skeleton::Skeleton;

/// The geometry of one hand at rest, in the space of its joint.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HandFrame {
    pub(super) along: DVec3,
    pub(super) radial: DVec3,
    pub(super) palm: DVec3,
    /// Rotation from the axes of B and N, and a third axis perpendicular to both, to the hand's space.
    basis: DQuat,
    thumb: [Option<StraightJoint>; 3],
    fingers: [[Option<StraightJoint>; 3]; 4],
    /// The metacarpal joint of each finger that has one.
    metacarpals: [Option<usize>; 4],
}

/// A joint and its rotation in the hand's space when the finger is straight along the hand.
#[derive(Debug, Clone, Copy, PartialEq)]
struct StraightJoint {
    joint: usize,
    rotation: DQuat,
}

/// The greatest turn of the metacarpals, in radians: 10 degrees for the ring finger and 23 for the little finger, less
/// than hands can (El-Shennawy et al. 2001, J. Hand Surg. 26A: some 20 and 27 degrees).
const METACARPAL_ARCH_RADIANS: [f64; 4] = [0.0, 0.0, 0.17, 0.40];
/// The flexion of a finger's base in a relaxed hand, in radians; up to it the palm stays flat.
const RELAXED_FLEXION_RADIANS: f64 = 0.5;
/// The spread of a finger in a widely spread hand, in radians.
const WIDE_SPREAD_RADIANS: f64 = 0.35;

/// Returns the turn of a finger's metacarpal towards the palm, in radians.
fn arch(place: usize, finger: &FingerAngles) -> f64 {
    // From the relaxed hand up to a right angle; before that the palm stays flat.
    let bent = ((finger.flexion[0] - RELAXED_FLEXION_RADIANS) / (FRAC_PI_2 - RELAXED_FLEXION_RADIANS)).clamp(0.0, 1.0);
    let outwards = (-finger.spread / WIDE_SPREAD_RADIANS).clamp(0.0, 1.0);
    METACARPAL_ARCH_RADIANS[place] * bent * outwards
}

impl HandFrame {
    /// Returns the frame of a hand with at least one finger; `None` if the side of the thumb cannot be found.
    pub(super) fn from_hand_anatomy(anatomy: &BodyAnatomy, skeleton: &Skeleton, side: BodySide) -> Option<Self> {
        let hand = anatomy.part_joint(BodyPart::Hand(side))?;
        let part_place = |part| {
            let joint = anatomy.part_joint(part)?;
            Some(in_hand(skeleton, hand, joint).0)
        };
        let bases = HandFinger::ALL_FINGERS.map(|finger| part_place(BodyPart::Finger(side, finger, 1)));
        let found_bases: Vec<DVec3> = bases.iter().copied().flatten().collect();
        let mean = found_bases.iter().sum::<DVec3>() / found_bases.len().max(1) as f64;
        // The middle finger shows the hand's direction; without it, the mean of the others does.
        let along = bases[1].unwrap_or(mean).try_normalize()?;
        // Some thumbs have only their metacarpal: its tip shows the side as well.
        let thumb = part_place(BodyPart::Thumb(side, 1)).or_else(|| {
            let joint = anatomy.part_joint(BodyPart::Thumb(side, 0))?;
            let (place, turned) = in_hand(skeleton, hand, joint);
            Some(place + turned * digit_tip(anatomy, skeleton, joint)?)
        });
        // Across the knuckles if there are two; otherwise the thumb shows its side.
        let across = match (found_bases.first(), found_bases.last()) {
            (Some(&first), Some(&last)) if found_bases.len() > 1 => first - last,
            _ => thumb?,
        };
        let radial = across.reject_from_normalized(along).try_normalize()?;
        // The sign makes the palm's normal point out of the palm on either hand.
        let mut palm = radial.cross(along) * -side.side_sign();
        if found_bases.len() > 1 && is_inside_out(anatomy, skeleton, side, [along, radial, palm]) {
            palm = -palm;
        }
        let (flex, spread) = (along.cross(palm), along.cross(radial));
        let third = flex.cross(spread);
        let basis = glam::DMat3::from_cols(flex, spread, third);
        let mut frame = Self {
            along,
            radial,
            palm,
            basis: DQuat::from_mat3(&basis).normalize(),
            thumb: [None; 3],
            fingers: [[None; 3]; 4],
            metacarpals: HandFinger::ALL_FINGERS.map(|finger| anatomy.part_joint(BodyPart::Finger(side, finger, 0))),
        };
        frame.thumb = frame.straight_joint_rotations(
            anatomy,
            skeleton,
            hand,
            [0, 1, 2].map(|n| anatomy.part_joint(BodyPart::Thumb(side, n))),
            true,
        );
        for finger in HandFinger::ALL_FINGERS {
            let joints = [1, 2, 3].map(|n| anatomy.part_joint(BodyPart::Finger(side, finger, n)));
            frame.fingers[finger.index()] = frame.straight_joint_rotations(anatomy, skeleton, hand, joints, false);
        }
        Some(frame)
    }

    /// Returns the rotations of a digit's joints when it is straight along the hand.
    fn straight_joint_rotations(
        &self,
        anatomy: &BodyAnatomy,
        skeleton: &Skeleton,
        hand: usize,
        joints: [Option<usize>; 3],
        thumb: bool,
    ) -> [Option<StraightJoint>; 3] {
        let mut before: Option<(DQuat, DVec3)> = None;
        let mut zeros = [None; 3];
        for place in 0..3 {
            let Some(joint) = joints[place] else {
                continue;
            };
            let (start, turned) = in_hand(skeleton, hand, joint);
            let next = joints[place + 1..].iter().flatten().next();
            // The last bone without an end goes on as the one before it.
            let bone = bone_end(anatomy, skeleton, hand, joint, next.copied())
                .and_then(|end| (end - start).try_normalize())
                .or(before.map(|(_, bone)| bone))
                .unwrap_or(self.along);
            let bent = match before {
                None => self.base_turn(bone, thumb),
                // Outer joints bend from the bone before by the shortest way, which adds no twist.
                Some((bent, _)) => bent * DQuat::from_rotation_arc(self.along, bent.inverse() * bone),
            };
            zeros[place] = Some(StraightJoint {
                joint,
                rotation: (bent.inverse() * turned).normalize(),
            });
            before = Some((bent, bone));
        }
        zeros
    }

    /// Returns the rotation from *along* to `bone` without a twist about the bone's own length.
    fn base_turn(&self, bone: DVec3, thumb: bool) -> DQuat {
        let (a, r, p) = (bone.dot(self.along), bone.dot(self.radial), bone.dot(self.palm));
        if thumb {
            self.angles_to_rotation(RotationOrder::YXZ_ORDER, [r.atan2(a), p.clamp(-1.0, 1.0).asin(), 0.0])
        } else {
            self.angles_to_rotation(RotationOrder::XYZ_ORDER, [p.atan2(a), r.clamp(-1.0, 1.0).asin(), 0.0])
        }
    }

    fn angles_to_rotation(&self, order: RotationOrder, angles: [f64; 3]) -> DQuat {
        self.basis * order.to_quat(angles) * self.basis.inverse()
    }

    /// Returns by how much a rotation bends a thumb's bone across the palm, in radians: the angle between the bones
    /// regardless of the hinge's direction, negative if it is bent back.
    fn thumb_bend_across(&self, turn: DQuat) -> f64 {
        let bone = turn * self.along;
        let bend = bone.dot(self.along).clamp(-1.0, 1.0).acos();
        // Across the palm is towards the palm and away from the thumb's side at once.
        let forward = bone.dot(self.palm) - bone.dot(self.radial);
        if forward < 0.0 { -bend } else { bend }
    }

    fn rotation_to_angles(&self, order: RotationOrder, turn: DQuat) -> [f64; 3] {
        order.nearest_euler_angles(self.basis.inverse() * turn * self.basis, [0.0; 3])
    }
}

/// Returns the position and the rotation of `joint` at rest, in the space of its ancestor `hand`.
pub(super) fn in_hand(skeleton: &Skeleton, hand: usize, joint: usize) -> (DVec3, DQuat) {
    let (mut place, mut turned) = (DVec3::ZERO, DQuat::IDENTITY);
    for above in skeleton.joint_ancestors(joint).take_while(|&j| j != hand) {
        let parent_joint = skeleton.joint_at(above);
        place = parent_joint.offset + parent_joint.rest * place;
        turned = parent_joint.rest * turned;
    }
    (place, turned.normalize())
}

/// Returns the end of the bone of `joint`: the digit's next joint, its tip, or its only child.
fn bone_end(
    anatomy: &BodyAnatomy,
    skeleton: &Skeleton,
    hand: usize,
    joint: usize,
    next: Option<usize>,
) -> Option<DVec3> {
    let child = match *skeleton.joint_children(joint) {
        [child] => Some(child),
        _ => None,
    };
    if let Some(next) = next.or(child) {
        return Some(in_hand(skeleton, hand, next).0);
    }
    let (place, turned) = in_hand(skeleton, hand, joint);
    digit_tip(anatomy, skeleton, joint).map(|tip| place + turned * tip)
}

/// Returns whether thumb and fingers at rest clearly point and bend away from the palm that the side implies: then the
/// skeleton was mirrored without renaming its joints. Both must do so by at least 0.3 rad, so that a relaxed hand is
/// never affected.
fn is_inside_out(anatomy: &BodyAnatomy, skeleton: &Skeleton, side: BodySide, axes: [DVec3; 3]) -> bool {
    let Some(hand) = anatomy.part_joint(BodyPart::Hand(side)) else {
        return false;
    };
    let [along, _, palm] = axes;
    let bend = |from: Option<usize>, to: Option<usize>| {
        let bone = in_hand(skeleton, hand, to?).0 - in_hand(skeleton, hand, from?).0;
        Some(bone.dot(palm).atan2(bone.reject_from(palm).length()))
    };
    let joint = |part| anatomy.part_joint(part);
    let thumb = bend(joint(BodyPart::Thumb(side, 0)), joint(BodyPart::Thumb(side, 1)));
    let fingers: Vec<f64> = HandFinger::ALL_FINGERS
        .iter()
        .filter_map(|&finger| {
            let from = joint(BodyPart::Finger(side, finger, 1));
            bend(from, joint(BodyPart::Finger(side, finger, 3)))
        })
        .collect();
    let mean = fingers.iter().sum::<f64>() / fingers.len().max(1) as f64;
    along.is_finite() && thumb.is_some_and(|bend| bend < -0.3) && mean < -0.3
}

impl BodyAnatomy {
    /// Returns the posture of the hand of `side`; angles of joints that the skeleton lacks are zero.
    ///
    /// Returns `None` if the hand has no finger, or if the side of the thumb is unknown. Twists of a finger about its
    /// length and sideways bends of its outer joints have no angle and are left out. The thumb's opposition is relative
    /// to the rest pose, which counts as zero.
    ///
    /// # Panics
    /// Panics if `pose` has fewer joints than `skeleton`.
    #[must_use]
    pub fn hand_angles(&self, skeleton: &Skeleton, side: BodySide, pose: &LocalPose) -> Option<HandAngles> {
        let frame = self.hand_frame(side)?;
        let hand = self.part_joint(BodyPart::Hand(side))?;
        let turns = |zeros: &[Option<StraightJoint>; 3]| {
            let mut before = DQuat::IDENTITY;
            zeros.map(|zero| {
                let zero = zero?;
                let now = rotation_below_hand(skeleton, hand, zero.joint, pose) * zero.rotation.inverse();
                let turn = before.inverse() * now;
                before = now;
                Some(turn)
            })
        };
        // Without the base joint, its angles are unknown and count as zero.
        let first = |order, turn: Option<DQuat>| turn.map_or([0.0; 3], |turn| frame.rotation_to_angles(order, turn));
        let [metacarpal, middle, end] = turns(&frame.thumb);
        let [radial, palmar, opposition] = first(RotationOrder::YXZ_ORDER, metacarpal);
        let thumb = ThumbAngles {
            radial,
            palmar,
            // The sign of opposition is against the right-hand rule about the thumb's length.
            opposition: -opposition,
            flexion: [middle, end].map(|turn| turn.map_or(0.0, |turn| frame.thumb_bend_across(turn))),
        };
        let fingers = frame.fingers.map(|zeros| {
            let [base, middle, end] = turns(&zeros);
            let [flexion, spread, _] = first(RotationOrder::XYZ_ORDER, base);
            let outer = [middle, end].map(|turn| first(RotationOrder::XYZ_ORDER, turn)[0]);
            FingerAngles {
                spread,
                flexion: [flexion, outer[0], outer[1]],
            }
        });
        Some(HandAngles { thumb, fingers })
    }

    /// Sets the hand of `side` in `pose` to the posture `angles`, and returns whether it has fingers.
    ///
    /// Only rotations below the wrist change: finger joints are set, angles of joints that the skeleton lacks are
    /// ignored, and everything else stays. Metacarpals return to rest, except those of ring and little finger: they
    /// carry their fingers towards the palm if these are bent and spread at once, as around a ball (Kennaway,
    /// *Avatar-independent scripting for real-time gesture animation*, section 4.3).
    ///
    /// # Panics
    /// Panics if `pose` has fewer joints than `skeleton`.
    pub fn set_hand_angles(
        &self,
        skeleton: &Skeleton,
        side: BodySide,
        angles: &HandAngles,
        pose: &mut LocalPose,
    ) -> bool {
        let (Some(frame), Some(hand)) = (self.hand_frame(side), self.part_joint(BodyPart::Hand(side))) else {
            return false;
        };
        for (place, joint) in frame.metacarpals.iter().enumerate() {
            let Some(joint) = *joint else { continue };
            let rest = skeleton.joint_at(joint).rest;
            let arch = arch(place, &angles.fingers[place]);
            // Only a metacarpal directly below the hand turns in the hand's axes.
            pose.rotations[joint] = if arch > 0.0 && skeleton.joint_parent(joint) == Some(hand) {
                let turn = frame.angles_to_rotation(RotationOrder::XYZ_ORDER, [arch, 0.0, 0.0]);
                (turn * rest).normalize()
            } else {
                rest
            };
        }
        let mut set = |zeros: &[Option<StraightJoint>; 3], turns: [DQuat; 3]| {
            let mut turned = DQuat::IDENTITY;
            for (zero, turn) in zeros.iter().zip(turns) {
                let Some(zero) = zero else { continue };
                // Turns add up along the digit even if the skeleton lacks a joint between.
                turned *= turn;
                let parent = skeleton.joint_parent(zero.joint).unwrap_or(hand);
                let above = rotation_below_hand(skeleton, hand, parent, pose);
                let local = above.inverse() * turned * zero.rotation;
                pose.rotations[zero.joint] = local.normalize();
            }
        };
        let thumb = &angles.thumb;
        let cross = |flexion: f64| frame.angles_to_rotation(RotationOrder::YXZ_ORDER, [-flexion, 0.0, 0.0]);
        let metacarpal = [thumb.radial, thumb.palmar, -thumb.opposition];
        set(
            &frame.thumb,
            [
                frame.angles_to_rotation(RotationOrder::YXZ_ORDER, metacarpal),
                cross(thumb.flexion[0]),
                cross(thumb.flexion[1]),
            ],
        );
        for (zeros, finger) in frame.fingers.iter().zip(&angles.fingers) {
            let bend = |flexion, spread| frame.angles_to_rotation(RotationOrder::XYZ_ORDER, [flexion, spread, 0.0]);
            let [base, middle, end] = finger.flexion;
            set(zeros, [bend(base, finger.spread), bend(middle, 0.0), bend(end, 0.0)]);
        }
        true
    }

    /// Returns the unit vector out of the palm of `side` in model space.
    ///
    /// Returns `None` if the hand has too few fingers.
    #[must_use]
    pub fn palm_normal(&self, side: BodySide, model: &ModelPose) -> Option<DVec3> {
        let hand = self.part_joint(BodyPart::Hand(side))?;
        Some(model.model_joint_rotation(hand) * self.hand_frame(side)?.palm)
    }

    /// Returns the unit vector from the wrist of `side` to the base of its middle finger in model space; for a hand
    /// without fingers, along the hand's bone, else along the forearm's.
    #[must_use]
    pub fn hand_direction(&self, side: BodySide, model: &ModelPose) -> Option<DVec3> {
        let hand = self.part_joint(BodyPart::Hand(side))?;
        if let Some(frame) = self.hand_frame(side) {
            return Some(model.model_joint_rotation(hand) * frame.along);
        }
        let tip = self.hand_tips[super::side_pair_index(side)];
        let along = match tip {
            Some(tip) => model.model_joint_rotation(hand) * tip,
            None => {
                model.model_joint_position(hand) - model.model_joint_position(self.part_joint(BodyPart::Forearm(side))?)
            }
        };
        along.try_normalize()
    }

    /// Returns the rotation of the hand joint of `side` in model space for which
    /// [`hand_direction`](Self::hand_direction) is `direction` and [`palm_normal`](Self::palm_normal) is as near to
    /// `palm` as a right angle between them allows.
    ///
    /// Returns `None` if the hand has too few fingers, or if the two directions are parallel.
    #[must_use]
    pub fn hand_rotation(&self, side: BodySide, direction: DVec3, palm: DVec3) -> Option<DQuat> {
        let frame = self.hand_frame(side)?;
        let along = direction.try_normalize()?;
        let palm = palm.reject_from_normalized(along).try_normalize()?;
        let columns = |a: DVec3, p: DVec3| glam::DMat3::from_cols(a, p, a.cross(p));
        // The transpose of an orthonormal frame is its inverse.
        let turn = columns(along, palm) * columns(frame.along, frame.palm).transpose();
        Some(DQuat::from_mat3(&turn).normalize())
    }
}

/// Returns the rotation of `joint` in the space of `hand`, which is the same joint or an ancestor.
fn rotation_below_hand(skeleton: &Skeleton, hand: usize, joint: usize, pose: &LocalPose) -> DQuat {
    skeleton
        .joint_ancestors(joint)
        .take_while(|&j| j != hand)
        .fold(DQuat::IDENTITY, |turned, j| pose.rotations[j] * turned)
}

#[cfg(test)]
mod tests {
    use super::super::tests::fixtures::{PLAIN_BODY_VARIATION, fixture_body, fixture_joint_roles};
    use super::*;
    use crate::skeleton::SkeletonJoint;

    fn known(joints: Vec<SkeletonJoint>) -> (Skeleton, BodyAnatomy) {
        let skeleton = Skeleton::new(joints).expect("a tree");
        let anatomy = BodyAnatomy::with_roles(&skeleton, &fixture_joint_roles(&skeleton)).expect("its own names");
        (skeleton, anatomy)
    }

    #[test]
    fn a_hand_without_fingers_points_along_its_tip_else_along_the_forearm() {
        let whole = fixture_body(PLAIN_BODY_VARIATION);
        for (tip, raised) in [
            (None, 0.0),
            (Some(DVec3::ZERO), 0.0),
            (Some(DVec3::new(0.0, 0.1, 0.0)), 1.0),
        ] {
            let joints = whole.skeleton_joints();
            let is_digit = |joint: &SkeletonJoint| {
                let part = joint.name.parse();
                matches!(part, Ok(BodyPart::Thumb(..) | BodyPart::Finger(..)))
            };
            let kept: Vec<usize> = (0..joints.len()).filter(|&n| !is_digit(&joints[n])).collect();
            let place = |old: usize| kept.iter().position(|&it| it == old);
            let joints = kept.iter().map(|&n| SkeletonJoint {
                parent: joints[n].parent.and_then(place),
                tip: if joints[n].name.ends_with("hand") {
                    tip
                } else {
                    joints[n].tip
                },
                ..joints[n].clone()
            });
            let (skeleton, anatomy) = known(joints.collect());
            for side in BodySide::BOTH_SIDES {
                let along = anatomy.hand_direction(side, &skeleton.rest_model_pose());
                let want = DVec3::new(side.side_sign() * (1.0 - raised), raised, 0.0);
                assert!(
                    along.expect("a direction").abs_diff_eq(want, 1e-9),
                    "{tip:?}: {along:?}"
                );
            }
        }
    }
}
