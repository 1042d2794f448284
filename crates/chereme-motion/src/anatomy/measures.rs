//! The size of a body and the directions of its trunk.

use glam::{DMat3, DQuat, DVec3};

use super::{BodyAnatomy, BodyPart};
use crate::hand::{BodySide, HandFinger};
use crate::pose::ModelPose;
use crate::skeleton::Skeleton;

/// Shares of stature after Drillis & Contini 1966, as in Winter, *Biomechanics and Motor Control of Human Movement*,
/// fig. 4.1.
pub(super) const ARM_STATURE_SHARE: f64 = 0.186 + 0.146;
pub(super) const HAND_STATURE_SHARE: f64 = 0.108;
const LEG_STATURE_SHARE: f64 = 0.245 + 0.246;
const ANKLE_STATURE_SHARE: f64 = 0.039;
const HEAD_STATURE_SHARE: f64 = 0.130;
const TRUNK_STATURE_SHARE: f64 = 0.818 - 0.530;
/// The distance of the shoulder joints' centres as a share of stature: the breadth of the shoulders, 0.259, less some 5
/// cm of bone and flesh on either side at a stature of 1.7 m.
const SHOULDER_STATURE_SHARE: f64 = 0.200;

/// The size of a body, in the unit of its skeleton: metres in model space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMeasures {
    /// From the sole to the top of the head; measured on the whole body if the skeleton has it, else inferred from the
    /// arm, the leg or the hand.
    pub stature: f64,
    /// Between the two shoulder joints.
    pub shoulder_width: f64,
    /// From the height of the shoulder joints down to the hips.
    pub trunk: f64,
    /// From shoulder through elbow to wrist: the mean of both arms.
    pub arm: f64,
    /// From the wrist to the end of the middle finger: the mean of both hands.
    pub hand: f64,
    /// From the chin to the top of the head.
    pub head: f64,
    /// From the head's joint up to the top of the head.
    pub head_top: f64,
}

impl BodyMeasures {
    /// Measures bone lengths, and distances in the posture `model` if the bones do not show them. Returns `None` if
    /// the skeleton has no arm, leg or hand to measure.
    pub(super) fn measure_body(anatomy: &BodyAnatomy, skeleton: &Skeleton, model: &ModelPose) -> Option<Self> {
        let arm = average_both_sides(|side| {
            let arm = anatomy.arm_chain(side)?;
            Some(bone_chain_length(skeleton, arm.hand, arm.upper))
        });
        let leg = average_both_sides(|side| {
            let (foot, thigh) = (
                anatomy.part_joint(BodyPart::Foot(side))?,
                anatomy.part_joint(BodyPart::Thigh(side))?,
            );
            anatomy
                .is_below(foot, thigh)
                .then(|| bone_chain_length(skeleton, foot, thigh))
        });
        let sum = arm
            .map(|l| l / ARM_STATURE_SHARE)
            .or(leg.map(|l| l / LEG_STATURE_SHARE));
        let hand =
            average_both_sides(|side| hand_length(anatomy, skeleton, side, sum.map(|all| HAND_STATURE_SHARE * all)));
        let rough = sum.or(hand.map(|l| l / HAND_STATURE_SHARE)).filter(|&h| h > 0.0)?;
        let head_top = head_top(anatomy, skeleton, rough);
        // With legs and trunk the stature is measured; otherwise it is a multiple of the arm.
        let stature = match (leg, trunk_and_neck(anatomy, skeleton, model)) {
            (Some(leg), Some(middle)) => leg * (1.0 + ANKLE_STATURE_SHARE / LEG_STATURE_SHARE) + middle + head_top,
            _ => rough,
        };
        // Up to this height the top fits a usual head; beyond it the head is larger in proportion.
        let head = if head_top <= 0.115 * stature {
            HEAD_STATURE_SHARE * stature
        } else {
            head_top * HEAD_STATURE_SHARE / 0.115
        };
        // Hips at the shoulders, as in upper-body skeletons, show no trunk.
        let measured = trunk_length(anatomy, model).filter(|t| *t > 0.15 * stature);
        Some(Self {
            stature,
            shoulder_width: shoulder_width(anatomy, skeleton, model, stature),
            trunk: measured.unwrap_or(TRUNK_STATURE_SHARE * stature),
            arm: arm.unwrap_or(ARM_STATURE_SHARE * stature),
            hand: hand.unwrap_or(HAND_STATURE_SHARE * stature),
            head,
            head_top,
        })
    }
}

/// Distances of a hand's tip from its wrist, as shares of the usual hand, between which the tip is the end of the hand.
const HAND_TIP_SHARES: [f64; 2] = [0.75, 1.4];

/// The length of a hand's bones from which they are impossible, as a multiple of the usual hand.
const GIANT_HAND_FACTOR: f64 = 2.0;

fn average_both_sides(measure: impl Fn(BodySide) -> Option<f64>) -> Option<f64> {
    let measured_lengths: Vec<f64> = BodySide::BOTH_SIDES.iter().filter_map(|&side| measure(side)).collect();
    (!measured_lengths.is_empty()).then(|| measured_lengths.iter().sum::<f64>() / measured_lengths.len() as f64)
}

/// Returns the length of the bones from `above` down to `joint`.
fn bone_chain_length(skeleton: &Skeleton, joint: usize, above: usize) -> f64 {
    let path = skeleton.joint_ancestors(joint).take_while(|&j| j != above);
    path.map(|j| skeleton.joint_at(j).offset.length()).sum()
}

/// Returns the length of a hand: of its middle finger's bones, or without fingers to the hand's tip, if that is far
/// enough for a hand of the `usual` length; the tips of many skeletons without fingers end at the palm.
fn hand_length(anatomy: &BodyAnatomy, skeleton: &Skeleton, side: BodySide, usual: Option<f64>) -> Option<f64> {
    let hand = anatomy.part_joint(BodyPart::Hand(side))?;
    let middle = [3, 2, 1].map(|n| anatomy.part_joint(BodyPart::Finger(side, HandFinger::Middle, n)));
    let Some(last) = middle.into_iter().flatten().next() else {
        // Without arm or leg nothing says how long a hand should be, so that any tip is taken.
        let [least, most] = usual.map_or([0.0, f64::INFINITY], |size| HAND_TIP_SHARES.map(|share| share * size));
        let tip = skeleton.joint_at(hand).tip.map(DVec3::length);
        return tip.filter(|&length| length > least && length < most);
    };
    let digit_end = super::tips::digit_tip(anatomy, skeleton, last);
    // 0.8 of the bone before is the usual end of a finger with its flesh.
    let tip = digit_end.map_or(0.8 * skeleton.joint_at(last).offset.length(), DVec3::length);
    let full_length = bone_chain_length(skeleton, last, hand) + tip;
    // A finger of impossible bones does not make a giant's hand.
    Some(
        usual
            .filter(|usual| full_length > GIANT_HAND_FACTOR * usual)
            .unwrap_or(full_length),
    )
}

/// Returns the height of the head above its joint: from its tip or a child such as `HeadTop_End`, if that is long
/// enough; else two thirds of the head's height, the usual height of head joints.
fn head_top(anatomy: &BodyAnatomy, skeleton: &Skeleton, stature: f64) -> f64 {
    let usual = HEAD_STATURE_SHARE * stature * 2.0 / 3.0;
    let Some(head) = anatomy.part_joint(BodyPart::Head) else {
        return usual;
    };
    let children = skeleton.joint_children(head).iter();
    let unknown = children.filter(|&&j| anatomy.part_of(j).is_none());
    let ends = unknown.map(|&j| skeleton.joint_at(j).offset.length());
    let tip = skeleton.joint_at(head).tip.map(DVec3::length);
    let longest = ends.chain(tip).fold(0.0, f64::max);
    // Outside this range the end is not the top of a head.
    if (0.08 * stature..0.25 * stature).contains(&longest) {
        longest
    } else {
        usual
    }
}

/// Returns the distance from the hip joints up to the head's joint.
fn trunk_and_neck(anatomy: &BodyAnatomy, skeleton: &Skeleton, model: &ModelPose) -> Option<f64> {
    let (head, hips) = (anatomy.part_joint(BodyPart::Head)?, anatomy.part_joint(BodyPart::Hips)?);
    if !anatomy.is_below(head, hips) {
        return None;
    }
    let distance = bone_chain_length(skeleton, head, hips);
    // Only what lies below the hips along the trunk counts, and a fifth of it at most.
    let below = part_midpoint(anatomy, model, BodyPart::Thigh).map_or(0.0, |thighs| {
        let up = (model.model_joint_position(head) - model.model_joint_position(hips)).normalize_or_zero();
        (model.model_joint_position(hips) - thighs).dot(up)
    });
    Some(distance + below.clamp(0.0, 0.2 * distance))
}

fn trunk_length(anatomy: &BodyAnatomy, model: &ModelPose) -> Option<f64> {
    let shoulders = part_midpoint(anatomy, model, BodyPart::UpperArm)?;
    let hips = model.model_joint_position(anatomy.part_joint(BodyPart::Hips)?);
    Some(shoulders.distance(hips))
}

/// Returns the distance of the shoulders in the posture if it fits the stature; else the distance that they have when
/// both collar bones lie in one line, if that fits; else the usual share of the stature.
fn shoulder_width(anatomy: &BodyAnatomy, skeleton: &Skeleton, model: &ModelPose, stature: f64) -> f64 {
    let joint = |side| anatomy.part_joint(BodyPart::UpperArm(side));
    let fits = |width: &f64| (0.12 * stature..0.35 * stature).contains(width);
    let [Some(right), Some(left)] = BodySide::BOTH_SIDES.map(joint) else {
        return SHOULDER_STATURE_SHARE * stature;
    };
    let posed = model
        .model_joint_position(right)
        .distance(model.model_joint_position(left));
    let collars = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(BodyPart::Clavicle(side)));
    let line = match collars {
        [Some(a), Some(b)] => {
            let bones = bone_chain_length(skeleton, right, a) + bone_chain_length(skeleton, left, b);
            model.model_joint_position(a).distance(model.model_joint_position(b)) + bones
        }
        _ => 0.0,
    };
    Some(posed)
        .filter(fits)
        .or(Some(line).filter(fits))
        .unwrap_or(SHOULDER_STATURE_SHARE * stature)
}

/// Returns the point midway between a part on the right and on the left, or the position of the only one.
pub(super) fn part_midpoint(
    anatomy: &BodyAnatomy,
    model: &ModelPose,
    part: impl Fn(BodySide) -> BodyPart,
) -> Option<DVec3> {
    let side_places =
        BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(part(side)).map(|j| model.model_joint_position(j)));
    match side_places {
        [Some(right), Some(left)] => Some((right + left) / 2.0),
        [one, other] => one.or(other),
    }
}

/// The frame of a signer's trunk in a posture: an origin, three directions, a size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyFrame {
    /// The middle between the shoulder joints, in model space.
    pub origin: DVec3,
    /// The unit vector to the signer's left.
    pub left: DVec3,
    /// The unit vector up along the trunk, perpendicular to `left`.
    pub up: DVec3,
    /// The unit vector that the chest faces.
    pub forward: DVec3,
    /// The distance of the shoulder joints in metres, which is the unit of body space.
    pub scale: f64,
}

impl BodyFrame {
    /// Converts a position in model space to shoulder widths to the left, up and forward of the origin.
    #[must_use]
    pub fn to_body(&self, at: DVec3) -> DVec3 {
        self.direction_to_body(at - self.origin) / self.scale
    }

    /// Converts a position in shoulder widths to the left, up and forward of the origin to model space.
    #[must_use]
    pub fn to_model(&self, at: DVec3) -> DVec3 {
        self.origin + self.direction_to_model(at * self.scale)
    }

    /// Converts a direction or distance in model space to components to the left, up and forward, in metres.
    #[must_use]
    pub fn direction_to_body(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.left), v.dot(self.up), v.dot(self.forward))
    }

    /// Converts components to the left, up and forward to a direction or distance in model space, in metres.
    #[must_use]
    pub fn direction_to_model(&self, v: DVec3) -> DVec3 {
        self.left * v.x + self.up * v.y + self.forward * v.z
    }

    /// Returns the rotation from the model axes to left, up and forward.
    #[must_use]
    pub fn body_frame_rotation(&self) -> DQuat {
        DQuat::from_mat3(&DMat3::from_cols(self.left, self.up, self.forward)).normalize()
    }
}

/// Returns left, up and forward of the trunk; `None` if the joints do not span a plane.
pub(super) fn trunk_axes(anatomy: &BodyAnatomy, model: &ModelPose) -> Option<[DVec3; 3]> {
    let part_place = |part| anatomy.part_joint(part).map(|j| model.model_joint_position(j));
    let low = part_place(BodyPart::Hips)
        .or_else(|| part_midpoint(anatomy, model, BodyPart::Thigh))
        .or_else(|| part_place(BodyPart::Spine))
        .or_else(|| part_place(BodyPart::Chest))?;
    // Without hips the low point is already in the upper body, so the head shows up better.
    let high = part_midpoint(anatomy, model, BodyPart::UpperArm)
        .filter(|_| part_place(BodyPart::Hips).is_some())
        .or_else(|| part_place(BodyPart::Head))
        .or_else(|| part_place(BodyPart::Neck))?;
    let up = (high - low).try_normalize()?;
    let across = |part: fn(BodySide) -> BodyPart| {
        let [right, left] = BodySide::BOTH_SIDES.map(|side| part_place(part(side)));
        let line = left? - right?;
        let left = line.reject_from_normalized(up);
        // A line too close to the trunk's own direction does not show the left.
        (left.length() > 0.3 * line.length() && left.length() > 0.05 * high.distance(low)).then_some(left)
    };
    let shoulders = across(BodyPart::UpperArm);
    let collars = across(BodyPart::Clavicle)
        // Collar bones that begin at one point have no direction.
        .filter(|collars| shoulders.is_none_or(|line| collars.length() > 0.1 * line.length()));
    let leftwards = collars.or(shoulders).or_else(|| across(BodyPart::Thigh))?;
    let left = leftwards.try_normalize()?;
    // Left is kept exactly, since the shoulders show it better than the spine shows up.
    let up = up.reject_from_normalized(left).try_normalize()?;
    Some([left, up, left.cross(up)])
}

#[cfg(test)]
mod tests {
    use super::super::tests::fixtures::{PLAIN_BODY_VARIATION, fixture_body};
    use super::*;

    /// Returns the body with every bone of its limbs along the joint's X axis, as Maya writes them, backwards on the
    /// right side if `mirrored`; the trunk branches off sideways of its own axis.
    fn along_x(mirrored: bool) -> Skeleton {
        let mut joints = fixture_body(PLAIN_BODY_VARIATION).skeleton_joints().to_vec();
        for joint in &mut joints {
            let part: BodyPart = joint.name.parse().expect("a part");
            let back = mirrored && part.part_side() == Some(BodySide::Right);
            joint.offset = match part {
                BodyPart::Hips | BodyPart::Spine | BodyPart::Thigh(_) => joint.offset,
                BodyPart::Chest | BodyPart::Neck | BodyPart::Head | BodyPart::Clavicle(_) => {
                    DVec3::new(joint.offset.y, -joint.offset.x, joint.offset.z)
                }
                _ => DVec3::X * joint.offset.length() * if back { -1.0 } else { 1.0 },
            };
        }
        Skeleton::new(joints).expect("a tree")
    }

    #[test]
    fn a_rest_pose_along_one_axis_is_no_reference() {
        let lowered = |lowered| {
            fixture_body(super::super::tests::fixtures::BodyVariation {
                lowered,
                ..PLAIN_BODY_VARIATION
            })
        };
        for (skeleton, is_posed) in [
            (along_x(false), false),
            (along_x(true), false),
            (lowered(0.0), true),
            (lowered(0.8), true),
            (lowered(1.5), true),
            // Both arms straight up.
            (lowered(-1.5), true),
        ] {
            let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
            assert_eq!(anatomy.is_posed(), is_posed);
        }
    }

    #[test]
    fn a_head_whose_top_is_measured_gives_its_own_height() {
        for (top, measured) in [(0.16, false), (0.19, false), (0.26, true), (0.32, true)] {
            let mut joints = fixture_body(PLAIN_BODY_VARIATION).skeleton_joints().to_vec();

            let head = joints.iter().position(|joint| joint.name == BodyPart::Head.to_string());
            joints[head.expect("a head")].tip = Some(DVec3::Y * top);
            let skeleton = Skeleton::new(joints).expect("a tree");
            let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
            let m = anatomy.anatomy_measures().expect("measures");
            assert!((m.head_top - top).abs() < 1e-12, "{top}: {}", m.head_top);
            // The joint lies as far below the top as the middle of the ear, 0.115 of the stature; the chin is at 0.130.
            let head = match measured {
                true => top * 0.130 / 0.115,
                false => 0.130 * m.stature,
            };
            assert!((m.head - head).abs() < 1e-12, "{top}: {} {head}", m.head);
        }
    }
}
