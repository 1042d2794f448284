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
use super::{Anatomy, Part};
use crate::euler::RotationOrder;
use crate::hand::{Finger, FingerAngles, HandAngles, Side, ThumbAngles};
use crate::pose::{ModelPose, Pose};
use crate::skeleton::Skeleton;

/// The geometry of one hand at rest, in the space of its joint.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HandFrame {
    pub(super) along: DVec3,
    pub(super) radial: DVec3,
    pub(super) palm: DVec3,
    /// Rotation from the axes of B and N, and a third axis perpendicular to both, to the hand's space.
    basis: DQuat,
    thumb: [Option<Zero>; 3],
    fingers: [[Option<Zero>; 3]; 4],
    /// The metacarpal joint of each finger that has one.
    metacarpals: [Option<usize>; 4],
}

/// A joint and its rotation in the hand's space when the finger is straight along the hand.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Zero {
    joint: usize,
    rotation: DQuat,
}

/// The greatest turn of the metacarpals, in radians: 10 degrees for the ring finger and 23 for the little finger, less
/// than hands can (El-Shennawy et al. 2001, J. Hand Surg. 26A: some 20 and 27 degrees).
const ARCH: [f64; 4] = [0.0, 0.0, 0.17, 0.40];
/// The flexion of a finger's base in a relaxed hand, in radians; up to it the palm stays flat.
const LAX: f64 = 0.5;
/// The spread of a finger in a widely spread hand, in radians.
const WIDE: f64 = 0.35;

/// Returns the turn of a finger's metacarpal towards the palm, in radians.
fn arch(place: usize, finger: &FingerAngles) -> f64 {
    let bent = ((finger.flexion[0] - LAX) / (FRAC_PI_2 - LAX)).clamp(0.0, 1.0);
    let outwards = (-finger.spread / WIDE).clamp(0.0, 1.0);
    ARCH[place] * bent * outwards
}

impl HandFrame {
    /// Returns the frame of a hand with at least one finger; `None` if the side of the thumb cannot be found.
    pub(super) fn of(anatomy: &Anatomy, skeleton: &Skeleton, side: Side) -> Option<Self> {
        let hand = anatomy.joint(Part::Hand(side))?;
        let at = |part| {
            let joint = anatomy.joint(part)?;
            Some(in_hand(skeleton, hand, joint).0)
        };
        let bases = Finger::ALL.map(|finger| at(Part::Finger(side, finger, 1)));
        let known: Vec<DVec3> = bases.iter().copied().flatten().collect();
        let mean = known.iter().sum::<DVec3>() / known.len().max(1) as f64;
        let along = bases[1].unwrap_or(mean).try_normalize()?;
        let thumb = at(Part::Thumb(side, 1)).or_else(|| {
            let joint = anatomy.joint(Part::Thumb(side, 0))?;
            let (place, turned) = in_hand(skeleton, hand, joint);
            Some(place + turned * digit_tip(anatomy, skeleton, joint)?)
        });
        let across = match (known.first(), known.last()) {
            (Some(&first), Some(&last)) if known.len() > 1 => first - last,
            _ => thumb?,
        };
        let radial = across.reject_from_normalized(along).try_normalize()?;
        let mut palm = radial.cross(along) * -side.sign();
        if known.len() > 1 && is_inside_out(anatomy, skeleton, side, [along, radial, palm]) {
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
            metacarpals: Finger::ALL.map(|finger| anatomy.joint(Part::Finger(side, finger, 0))),
        };
        frame.thumb = frame.zeros(
            (anatomy, skeleton),
            hand,
            [0, 1, 2].map(|n| anatomy.joint(Part::Thumb(side, n))),
            true,
        );
        for finger in Finger::ALL {
            let joints = [1, 2, 3].map(|n| anatomy.joint(Part::Finger(side, finger, n)));
            frame.fingers[finger.index()] = frame.zeros((anatomy, skeleton), hand, joints, false);
        }
        Some(frame)
    }

    /// Returns the rotations of a digit's joints when it is straight along the hand.
    fn zeros(
        &self,
        (anatomy, skeleton): (&Anatomy, &Skeleton),
        hand: usize,
        joints: [Option<usize>; 3],
        thumb: bool,
    ) -> [Option<Zero>; 3] {
        let mut before: Option<(DQuat, DVec3)> = None;
        let mut zeros = [None; 3];
        for place in 0..3 {
            let Some(joint) = joints[place] else {
                continue;
            };
            let (start, turned) = in_hand(skeleton, hand, joint);
            let next = joints[place + 1..].iter().flatten().next();
            let bone = bone_end((anatomy, skeleton), hand, joint, next.copied())
                .and_then(|end| (end - start).try_normalize())
                .or(before.map(|(_, bone)| bone))
                .unwrap_or(self.along);
            let bent = match before {
                None => self.base_turn(bone, thumb),
                Some((bent, _)) => {
                    bent * DQuat::from_rotation_arc(self.along, bent.inverse() * bone)
                }
            };
            zeros[place] = Some(Zero {
                joint,
                rotation: (bent.inverse() * turned).normalize(),
            });
            before = Some((bent, bone));
        }
        zeros
    }

    /// Returns the rotation from *along* to `bone` without a twist about the bone's own length.
    fn base_turn(&self, bone: DVec3, thumb: bool) -> DQuat {
        let (a, r, p) = (
            bone.dot(self.along),
            bone.dot(self.radial),
            bone.dot(self.palm),
        );
        if thumb {
            self.turn(
                RotationOrder::YXZ,
                [r.atan2(a), p.clamp(-1.0, 1.0).asin(), 0.0],
            )
        } else {
            self.turn(
                RotationOrder::XYZ,
                [p.atan2(a), r.clamp(-1.0, 1.0).asin(), 0.0],
            )
        }
    }

    fn turn(&self, order: RotationOrder, angles: [f64; 3]) -> DQuat {
        self.basis * order.to_quat(angles) * self.basis.inverse()
    }

    /// Returns by how much a rotation bends a thumb's bone across the palm, in radians: the angle between the bones
    /// regardless of the hinge's direction, negative if it is bent back.
    fn across(&self, turn: DQuat) -> f64 {
        let bone = turn * self.along;
        let bend = bone.dot(self.along).clamp(-1.0, 1.0).acos();
        let forward = bone.dot(self.palm) - bone.dot(self.radial);
        if forward < 0.0 { -bend } else { bend }
    }

    fn angles(&self, order: RotationOrder, turn: DQuat) -> [f64; 3] {
        order.angles(self.basis.inverse() * turn * self.basis, [0.0; 3])
    }
}

/// Returns the position and the rotation of `joint` at rest, in the space of its ancestor `hand`.
pub(super) fn in_hand(skeleton: &Skeleton, hand: usize, joint: usize) -> (DVec3, DQuat) {
    let (mut place, mut turned) = (DVec3::ZERO, DQuat::IDENTITY);
    for above in skeleton.ancestors(joint).take_while(|&j| j != hand) {
        let at = skeleton.joint(above);
        place = at.offset + at.rest * place;
        turned = at.rest * turned;
    }
    (place, turned.normalize())
}

/// Returns the end of the bone of `joint`: the digit's next joint, its tip, or its only child.
fn bone_end(
    (anatomy, skeleton): (&Anatomy, &Skeleton),
    hand: usize,
    joint: usize,
    next: Option<usize>,
) -> Option<DVec3> {
    let child = match *skeleton.children(joint) {
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
fn is_inside_out(anatomy: &Anatomy, skeleton: &Skeleton, side: Side, axes: [DVec3; 3]) -> bool {
    let Some(hand) = anatomy.joint(Part::Hand(side)) else {
        return false;
    };
    let [along, _, palm] = axes;
    let bend = |from: Option<usize>, to: Option<usize>| {
        let bone = in_hand(skeleton, hand, to?).0 - in_hand(skeleton, hand, from?).0;
        Some(bone.dot(palm).atan2(bone.reject_from(palm).length()))
    };
    let joint = |part| anatomy.joint(part);
    let thumb = bend(joint(Part::Thumb(side, 0)), joint(Part::Thumb(side, 1)));
    let fingers: Vec<f64> = Finger::ALL
        .iter()
        .filter_map(|&finger| {
            let from = joint(Part::Finger(side, finger, 1));
            bend(from, joint(Part::Finger(side, finger, 3)))
        })
        .collect();
    let mean = fingers.iter().sum::<f64>() / fingers.len().max(1) as f64;
    along.is_finite() && thumb.is_some_and(|bend| bend < -0.3) && mean < -0.3
}

impl Anatomy {
    /// Returns the posture of the hand of `side`; angles of joints that the skeleton lacks are zero.
    ///
    /// Returns `None` if the hand has no finger, or if the side of the thumb is unknown. Twists of a finger about its
    /// length and sideways bends of its outer joints have no angle and are left out. The thumb's opposition is relative
    /// to the rest pose, which counts as zero.
    ///
    /// # Panics
    /// Panics if `pose` has fewer joints than `skeleton`.
    #[must_use]
    pub fn hand_angles(&self, skeleton: &Skeleton, side: Side, pose: &Pose) -> Option<HandAngles> {
        let frame = self.hand_frame(side)?;
        let hand = self.joint(Part::Hand(side))?;
        let turns = |zeros: &[Option<Zero>; 3]| {
            let mut before = DQuat::IDENTITY;
            zeros.map(|zero| {
                let zero = zero?;
                let now = below(skeleton, hand, zero.joint, pose) * zero.rotation.inverse();
                let turn = before.inverse() * now;
                before = now;
                Some(turn)
            })
        };
        let first =
            |order, turn: Option<DQuat>| turn.map_or([0.0; 3], |turn| frame.angles(order, turn));
        let [metacarpal, middle, end] = turns(&frame.thumb);
        let [radial, palmar, opposition] = first(RotationOrder::YXZ, metacarpal);
        let thumb = ThumbAngles {
            radial,
            palmar,
            opposition: -opposition,
            flexion: [middle, end].map(|turn| turn.map_or(0.0, |turn| frame.across(turn))),
        };
        let fingers = frame.fingers.map(|zeros| {
            let [base, middle, end] = turns(&zeros);
            let [flexion, spread, _] = first(RotationOrder::XYZ, base);
            let outer = [middle, end].map(|turn| first(RotationOrder::XYZ, turn)[0]);
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
        side: Side,
        angles: &HandAngles,
        pose: &mut Pose,
    ) -> bool {
        let (Some(frame), Some(hand)) = (self.hand_frame(side), self.joint(Part::Hand(side)))
        else {
            return false;
        };
        for (place, joint) in frame.metacarpals.iter().enumerate() {
            let Some(joint) = *joint else { continue };
            let rest = skeleton.joint(joint).rest;
            let arch = arch(place, &angles.fingers[place]);
            pose.rotations[joint] = if arch > 0.0 && skeleton.parent(joint) == Some(hand) {
                let turn = frame.turn(RotationOrder::XYZ, [arch, 0.0, 0.0]);
                (turn * rest).normalize()
            } else {
                rest
            };
        }
        let mut set = |zeros: &[Option<Zero>; 3], turns: [DQuat; 3]| {
            let mut turned = DQuat::IDENTITY;
            for (zero, turn) in zeros.iter().zip(turns) {
                let Some(zero) = zero else { continue };
                turned *= turn;
                let parent = skeleton.parent(zero.joint).unwrap_or(hand);
                let above = below(skeleton, hand, parent, pose);
                let local = above.inverse() * turned * zero.rotation;
                pose.rotations[zero.joint] = local.normalize();
            }
        };
        let thumb = &angles.thumb;
        let cross = |flexion: f64| frame.turn(RotationOrder::YXZ, [-flexion, 0.0, 0.0]);
        let metacarpal = [thumb.radial, thumb.palmar, -thumb.opposition];
        set(
            &frame.thumb,
            [
                frame.turn(RotationOrder::YXZ, metacarpal),
                cross(thumb.flexion[0]),
                cross(thumb.flexion[1]),
            ],
        );
        for (zeros, finger) in frame.fingers.iter().zip(&angles.fingers) {
            let bend = |flexion, spread| frame.turn(RotationOrder::XYZ, [flexion, spread, 0.0]);
            let [base, middle, end] = finger.flexion;
            set(
                zeros,
                [bend(base, finger.spread), bend(middle, 0.0), bend(end, 0.0)],
            );
        }
        true
    }

    /// Returns the unit vector out of the palm of `side` in model space.
    ///
    /// Returns `None` if the hand has too few fingers.
    #[must_use]
    pub fn palm_normal(&self, side: Side, model: &ModelPose) -> Option<DVec3> {
        let hand = self.joint(Part::Hand(side))?;
        Some(model.rotation(hand) * self.hand_frame(side)?.palm)
    }

    /// Returns the unit vector from the wrist of `side` to the base of its middle finger in model space; for a hand
    /// without fingers, along the hand's bone, else along the forearm's.
    #[must_use]
    pub fn hand_direction(&self, side: Side, model: &ModelPose) -> Option<DVec3> {
        let hand = self.joint(Part::Hand(side))?;
        if let Some(frame) = self.hand_frame(side) {
            return Some(model.rotation(hand) * frame.along);
        }
        let tip = self.hand_tips[super::place(side)];
        let along = match tip {
            Some(tip) => model.rotation(hand) * tip,
            None => model.position(hand) - model.position(self.joint(Part::Forearm(side))?),
        };
        along.try_normalize()
    }

    /// Returns the rotation of the hand joint of `side` in model space for which
    /// [`hand_direction`](Self::hand_direction) is `direction` and [`palm_normal`](Self::palm_normal) is as near to
    /// `palm` as a right angle between them allows.
    ///
    /// Returns `None` if the hand has too few fingers, or if the two directions are parallel.
    #[must_use]
    pub fn hand_rotation(&self, side: Side, direction: DVec3, palm: DVec3) -> Option<DQuat> {
        let frame = self.hand_frame(side)?;
        let along = direction.try_normalize()?;
        let palm = palm.reject_from_normalized(along).try_normalize()?;
        let columns = |a: DVec3, p: DVec3| glam::DMat3::from_cols(a, p, a.cross(p));
        let turn = columns(along, palm) * columns(frame.along, frame.palm).transpose();
        Some(DQuat::from_mat3(&turn).normalize())
    }
}

/// Returns the rotation of `joint` in the space of `hand`, which is the same joint or an ancestor.
fn below(skeleton: &Skeleton, hand: usize, joint: usize, pose: &Pose) -> DQuat {
    skeleton
        .ancestors(joint)
        .take_while(|&j| j != hand)
        .fold(DQuat::IDENTITY, |turned, j| pose.rotations[j] * turned)
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{PLAIN, body, roles};
    use super::*;
    use crate::skeleton::Joint;

    fn known(joints: Vec<Joint>) -> (Skeleton, Anatomy) {
        let skeleton = Skeleton::new(joints).expect("a tree");
        let anatomy = Anatomy::with_roles(&skeleton, &roles(&skeleton)).expect("its own names");
        (skeleton, anatomy)
    }

    #[test]
    fn a_hand_without_fingers_points_along_its_tip_else_along_the_forearm() {
        let whole = body(PLAIN);
        for (tip, raised) in [
            (None, 0.0),
            (Some(DVec3::ZERO), 0.0),
            (Some(DVec3::new(0.0, 0.1, 0.0)), 1.0),
        ] {
            let joints = whole.joints();
            let is_digit = |joint: &Joint| {
                let part = joint.name.parse();
                matches!(part, Ok(Part::Thumb(..) | Part::Finger(..)))
            };
            let kept: Vec<usize> = (0..joints.len())
                .filter(|&n| !is_digit(&joints[n]))
                .collect();
            let place = |old: usize| kept.iter().position(|&it| it == old);
            let joints = kept.iter().map(|&n| Joint {
                parent: joints[n].parent.and_then(place),
                tip: if joints[n].name.ends_with("hand") {
                    tip
                } else {
                    joints[n].tip
                },
                ..joints[n].clone()
            });
            let (skeleton, anatomy) = known(joints.collect());
            for side in Side::BOTH {
                let along = anatomy.hand_direction(side, &skeleton.rest_model_pose());
                let want = DVec3::new(side.sign() * (1.0 - raised), raised, 0.0);
                assert!(
                    along.expect("a direction").abs_diff_eq(want, 1e-9),
                    "{tip:?}: {along:?}"
                );
            }
        }
    }
}
