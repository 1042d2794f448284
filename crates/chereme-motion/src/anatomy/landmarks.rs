//! Places on the body, computed from the skeleton's own measures.
//!
//! Places of the face are fixed to the head and follow its rotation. Heights are shares of the
//! head's height from chin to top: the eyes at one half (Drillis & Contini 1966 give eye height
//! 0.936 and chin height 0.870 of stature, so (0.936 - 0.870)/0.130 = 0.51), the base of the nose at
//! a third, the mouth between it and the chin, the hairline at four fifths: the canon of drawing
//! schools. Breadth 0.66 and depth 0.86 of the height are those of adult heads (about 15 and 20 cm
//! of 23). Places of the trunk are shares of trunk length and shoulder width; the front of the chest
//! is about a third of the shoulder width before the spine (chest depth 23 cm, width 35 cm).

use glam::{DQuat, DVec3};

use super::{BodyAnatomy, BodyFrame, BodyMeasures, BodyPart};
use crate::hand::{BodySide, HandFinger};
use crate::pose::ModelPose;
use crate::skeleton::Skeleton;

/// Places of the head: name, and the offset to the left, up and forward from the middle of the skull at the height of
/// the chin, in head heights. Those off the middle exist on both sides.
const HEAD_LANDMARKS: [(&str, [f64; 3]); 19] = [
    ("head-top", [0.0, 1.0, 0.0]),
    ("head-back", [0.0, 0.58, -0.43]),
    ("forehead", [0.0, 0.74, 0.42]),
    ("temple", [0.31, 0.60, 0.18]),
    ("eyebrow", [0.13, 0.58, 0.41]),
    ("eyebrows", [0.0, 0.58, 0.43]),
    ("eye", [0.135, 0.50, 0.38]),
    ("eyes", [0.0, 0.50, 0.41]),
    ("nose", [0.0, 0.37, 0.53]),
    ("nostril", [0.05, 0.34, 0.48]),
    ("cheek", [0.22, 0.33, 0.34]),
    ("ear", [0.34, 0.46, -0.02]),
    ("earlobe", [0.33, 0.34, 0.0]),
    ("philtrum", [0.0, 0.27, 0.47]),
    ("mouth", [0.0, 0.21, 0.47]),
    ("mouth-corner", [0.11, 0.21, 0.42]),
    ("chin", [0.0, 0.04, 0.44]),
    ("jaw", [0.25, 0.12, 0.15]),
    ("under-chin", [0.0, -0.03, 0.33]),
];

/// Places of the trunk: name, offset to the left and forward in shoulder widths, and up in trunk lengths, all from the
/// point midway between the shoulder joints.
const TRUNK_LANDMARKS: [(&str, [f64; 3]); 12] = [
    ("throat", [0.0, 0.18, 0.16]),
    ("neck", [0.0, 0.24, 0.12]),
    ("neck-side", [0.17, 0.24, 0.02]),
    ("chest", [0.0, -0.28, 0.33]),
    ("upper-chest", [0.0, -0.08, 0.28]),
    ("chest-side", [0.28, -0.25, 0.30]),
    ("heart", [0.14, -0.28, 0.33]),
    ("armpit", [0.46, -0.20, 0.05]),
    ("stomach", [0.0, -0.58, 0.33]),
    ("belly", [0.0, -0.72, 0.34]),
    ("abdomen", [0.0, -0.88, 0.32]),
    ("waist", [0.42, -0.78, 0.0]),
];

/// Other names for places.
const LANDMARK_SYNONYMS: [(&str, &str); 11] = [
    ("top-of-head", "head-top"),
    ("back-of-head", "head-back"),
    ("back-of-hand", "hand-back"),
    ("lips", "mouth"),
    ("brow", "eyebrow"),
    ("underchin", "under-chin"),
    ("hips", "hip"),
    ("trunk", "chest"),
    ("torso", "chest"),
    ("thumb-side", "hand-radial"),
    ("little-side", "hand-ulnar"),
];

/// Places of each arm and hand.
const ARM_LANDMARKS: [&str; 14] = [
    "shoulder",
    "upper-arm",
    "elbow",
    "forearm",
    "wrist",
    "palm",
    "hand-back",
    "hand-radial",
    "hand-ulnar",
    "thumb-tip",
    "index-tip",
    "middle-tip",
    "ring-tip",
    "little-tip",
];

/// Places of the trunk that exist on both sides.
const SIDED_TRUNK_LANDMARKS: [&str; 4] = ["neck-side", "chest-side", "armpit", "waist"];

/// The head's directions and the position of its chin, in the space of the head's joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HeadFrame {
    /// Rotation from left, up and forward to the joint's space.
    axes: DQuat,
    /// The middle of the skull at the height of the chin.
    chin: DVec3,
}

impl HeadFrame {
    /// Returns the frame of a head that has the same direction as the trunk in the posture `model`.
    pub(super) fn from_head_anatomy(
        anatomy: &BodyAnatomy,
        model: &ModelPose,
        axes: DQuat,
        measures: &BodyMeasures,
    ) -> Option<Self> {
        let head = anatomy.part_joint(BodyPart::Head)?;
        let back = model.model_joint_rotation(head).inverse();
        let axes = (back * axes).normalize();
        let size = measures.head;
        let mut chin = DVec3::new(0.0, measures.head_top - size, 0.0);
        let eyes = BodySide::BOTH_SIDES.map(|side| anatomy.part_joint(BodyPart::Eye(side)));
        if let [Some(right), Some(left)] = eyes {
            let middle = (model.model_joint_position(right) + model.model_joint_position(left)) / 2.0;
            let head_point = axes.inverse() * (back * (middle - model.model_joint_position(head)));
            // Eyes lie at half the head's height, and 0.32 of it before the middle of the skull.
            let seat = DVec3::new(0.0, 0.5 * size, 0.32 * size);
            // Eyes far from there are helpers at the root or far before the face.
            if head_point.distance(chin + seat) < 0.5 * size {
                chin = DVec3::new(0.0, head_point.y - seat.y, head_point.z - seat.z);
            }
        }
        Some(Self {
            axes,
            chin: axes * chin,
        })
    }
}

impl BodyAnatomy {
    /// Returns the names that [`landmark_place_position`](Self::landmark_place_position) accepts, in alphabetical order.
    ///
    /// Not every skeleton has the joints for all of them.
    #[must_use]
    pub fn landmark_names() -> Vec<String> {
        let sided = |name: &str, each: bool| -> Vec<String> {
            if each {
                BodySide::BOTH_SIDES
                    .map(|side| format!("{}-{name}", side.body_side_name()))
                    .to_vec()
            } else {
                vec![name.to_owned()]
            }
        };
        let mut names = vec!["neutral-space".to_owned()];
        for (name, at) in HEAD_LANDMARKS {
            names.extend(sided(name, at[0] != 0.0));
        }
        for (name, _) in TRUNK_LANDMARKS {
            names.extend(sided(name, SIDED_TRUNK_LANDMARKS.contains(&name)));
        }
        names.extend(sided("chest", true));
        names.push("hips".to_owned());
        names.extend(sided("hip", true));
        names.extend(sided("thigh", true));
        names.extend(sided("knee", true));
        for name in ARM_LANDMARKS {
            names.extend(sided(name, true));
        }
        names.sort_unstable();
        names
    }

    /// Returns the position of the place `name` on the body in the posture `model`, in metres.
    ///
    /// The side comes before or after the name (`left-ear`, `ear left`); blanks and underscores count as hyphens. The
    /// distance of places on the skin from the bone is that of a person of this size. Returns `None` for a name that is
    /// not in [`landmark_names`](Self::landmark_names), or if the skeleton lacks the joints for it.
    #[must_use]
    pub fn landmark_place_position(&self, skeleton: &Skeleton, model: &ModelPose, name: &str) -> Option<DVec3> {
        let (side, name) = split_landmark_name(name);
        let name = name.as_str();
        if let Some(&(_, [x, y, z])) = HEAD_LANDMARKS.iter().find(|(known, _)| *known == name) {
            // A place off the middle has no single position without a side.
            let x = if x == 0.0 { 0.0 } else { side?.side_sign() * x };
            return self.on_head(model, DVec3::new(x, y, z));
        }
        // Names of the arm are tried first, since a side may also belong to a place of the trunk.
        if let Some(side) = side
            && let Some(at) = self.on_arm(skeleton, model, side, name)
        {
            return Some(at);
        }
        let frame = self.body_frame(model)?;
        let trunk = self.anatomy_measures()?.trunk / frame.scale;
        let place = |x: f64, y: f64, z: f64| frame.to_model(DVec3::new(x, y * trunk, z));
        let sign = side.map(BodySide::side_sign);
        match name {
            "neutral-space" => {
                let reach = self.anatomy_measures()?.arm / frame.scale;
                Some(place(0.0, -0.5, 0.33 + 0.45 * reach))
            }
            "hip" if side.is_none() => Some(model.model_joint_position(self.part_joint(BodyPart::Hips)?)),
            "hip" => Some(match self.part_joint(BodyPart::Thigh(side?)) {
                Some(joint) => model.model_joint_position(joint) + frame.left * (sign? * 0.15 * frame.scale),
                None => place(sign? * 0.42, -1.0, 0.0),
            }),
            "thigh" => {
                let (hip, knee) = (
                    self.part_joint(BodyPart::Thigh(side?))?,
                    self.part_joint(BodyPart::Shin(side?))?,
                );
                // The front of the thigh lies 0.22 shoulder widths before the bone.
                let middle = (model.model_joint_position(hip) + model.model_joint_position(knee)) / 2.0;
                Some(middle + frame.forward * (0.22 * frame.scale))
            }
            "knee" => Some(model.model_joint_position(self.part_joint(BodyPart::Shin(side?))?)),
            "chest" if side.is_some() => Some(place(sign? * 0.28, -0.25, 0.30)),
            _ => {
                let &(_, [x, y, z]) = TRUNK_LANDMARKS.iter().find(|(known, _)| *known == name)?;
                let x = if SIDED_TRUNK_LANDMARKS.contains(&name) {
                    sign? * x
                } else {
                    x
                };
                Some(place(x, y, z))
            }
        }
    }

    fn on_head(&self, model: &ModelPose, at: DVec3) -> Option<DVec3> {
        let (head, measures) = (self.part_joint(BodyPart::Head)?, self.anatomy_measures()?);
        let scaled_place = at * measures.head;
        if let Some(frame) = self.head {
            return Some(model.joint_point_to_model(head, frame.chin + frame.axes * scaled_place));
        }
        // A head whose axes are unknown is taken to face as the trunk does.
        let body = self.body_frame(model)?;
        let chin = DVec3::new(0.0, measures.head_top - measures.head, 0.0);
        Some(model.model_joint_position(head) + body.direction_to_model(chin + scaled_place))
    }

    /// Returns the unit vectors left, up and forward of the head in model space.
    #[must_use]
    pub fn head_axes(&self, model: &ModelPose) -> Option<[DVec3; 3]> {
        let turned = match self.head {
            Some(frame) => model.model_joint_rotation(self.part_joint(BodyPart::Head)?) * frame.axes,
            None => self.body_frame(model)?.body_frame_rotation(),
        };
        Some([DVec3::X, DVec3::Y, DVec3::Z].map(|axis| turned * axis))
    }

    fn on_arm(&self, skeleton: &Skeleton, model: &ModelPose, side: BodySide, name: &str) -> Option<DVec3> {
        let part_place = |part| self.part_joint(part).map(|joint| model.model_joint_position(joint));
        let (upper, forearm, hand) = (
            part_place(BodyPart::UpperArm(side)),
            part_place(BodyPart::Forearm(side)),
            part_place(BodyPart::Hand(side)),
        );
        match name {
            "shoulder" => {
                let up = self
                    .body_frame(model)
                    .map_or(DVec3::ZERO, |frame| frame.up * (0.12 * frame.scale));
                Some(upper? + up)
            }
            "upper-arm" => Some((upper? + forearm?) / 2.0),
            "elbow" => forearm,
            "forearm" => Some((forearm? + hand?) / 2.0),
            "wrist" => hand,
            _ => match name.strip_suffix("-tip") {
                Some(digit) => self.fingertip(skeleton, model, side, digit),
                None => self.on_hand(model, side, hand?, name),
            },
        }
    }

    /// Returns a place on the hand's palm, back or edges, half a hand's thickness or breadth from its middle; the
    /// middle lies half-way from the wrist to the base of the middle finger.
    fn on_hand(&self, model: &ModelPose, side: BodySide, wrist: DVec3, name: &str) -> Option<DVec3> {
        let length = self.anatomy_measures()?.hand;
        let along = self.hand_direction(side, model)?;
        let base = self
            .part_joint(BodyPart::Finger(side, HandFinger::Middle, 1))
            .map_or(0.5 * length, |joint| model.model_joint_position(joint).distance(wrist));
        let middle = wrist + along * (0.55 * base);
        let palm = self.palm_normal(side, model);
        // The thumb's side follows from palm and direction with the sign of the hand.
        let radial = palm.map(|palm| palm.cross(along) * side.side_sign());
        let out = match name {
            "palm" => palm.map_or(DVec3::ZERO, |palm| palm * (0.08 * length)),
            "hand-back" => palm.map_or(DVec3::ZERO, |palm| palm * (-0.08 * length)),
            "hand-radial" => radial? * (0.22 * length),
            "hand-ulnar" => radial? * (-0.22 * length),
            _ => return None,
        };
        Some(middle + out)
    }

    /// Returns the end of a digit: its last joint's tip, else a point beyond the last joint by 0.8 of the last bone's
    /// length.
    fn fingertip(&self, skeleton: &Skeleton, model: &ModelPose, side: BodySide, digit: &str) -> Option<DVec3> {
        let parts: Vec<BodyPart> = if digit == "thumb" {
            (0..3).map(|n| BodyPart::Thumb(side, n)).collect()
        } else {
            let finger = HandFinger::ALL_FINGERS
                .into_iter()
                .find(|finger| finger.finger_name() == digit)?;
            (1..4).map(|n| BodyPart::Finger(side, finger, n)).collect()
        };
        let last = parts.iter().rev().find_map(|&part| self.part_joint(part))?;
        if let Some(tip) = super::tips::digit_tip(self, skeleton, last) {
            return Some(model.joint_point_to_model(last, tip));
        }
        // Without a tip the last bone is assumed to be 0.8 of the one before it.
        let from = model.model_joint_position(skeleton.joint_parent(last)?);
        Some(model.model_joint_position(last) + (model.model_joint_position(last) - from) * 0.8)
    }

    /// Returns the frame of the trunk in the posture `model`.
    ///
    /// Up is the direction from the hips to the shoulders. Left follows the collar bones if they are apart, else the
    /// shoulders, else the hips; so a signer turned away from +Z is still measured in body space. Returns `None` if the
    /// skeleton lacks these joints, or if they lie in a line.
    #[must_use]
    pub fn body_frame(&self, model: &ModelPose) -> Option<BodyFrame> {
        let [left, up, forward] = super::measures::trunk_axes(self, model)?;
        let origin = super::measures::part_midpoint(self, model, BodyPart::UpperArm).or_else(|| {
            let joint = self
                .part_joint(BodyPart::Chest)
                .or_else(|| self.part_joint(BodyPart::Neck))?;
            Some(model.model_joint_position(joint))
        })?;
        let scale = self.anatomy_measures()?.shoulder_width;
        Some(BodyFrame {
            origin,
            left,
            up,
            forward,
            scale,
        })
    }
}

/// Splits a landmark's name into its side and the canonical rest.
fn split_landmark_name(name: &str) -> (Option<BodySide>, String) {
    let lower = name.to_lowercase().replace(['_', ' '], "-");
    let mut side = None;
    let rest: Vec<&str> = lower
        .split('-')
        .filter(|word| {
            let word_side = BodySide::BOTH_SIDES
                .into_iter()
                .find(|side| side.body_side_name() == *word);
            // The first word for a side counts, and all of them leave the name.
            side = side.or(word_side);
            word_side.is_none() && !word.is_empty()
        })
        .collect();
    let rest = rest.join("-");
    let synonym = LANDMARK_SYNONYMS.iter().find(|(word, _)| *word == rest);
    (side, synonym.map_or(rest.clone(), |(_, name)| (*name).to_owned()))
}

#[cfg(test)]
mod tests {
    use super::super::tests::fixtures::{PLAIN_BODY_VARIATION, fixture_body};
    use super::*;

    #[test]
    fn a_rest_pose_along_one_axis_gives_the_same_face_in_a_usual_posture() {
        let whole = fixture_body(PLAIN_BODY_VARIATION);
        let model = whole.rest_model_pose();
        let usual = BodyAnatomy::detect_anatomy(&whole);
        let mut joints = whole.skeleton_joints().to_vec();
        for joint in &mut joints {
            joint.offset = DVec3::Y * joint.offset.length();
        }
        let straight = Skeleton::new(joints).expect("a tree");
        let odd = BodyAnatomy::detect_anatomy(&straight);
        assert!(usual.is_posed() && !odd.is_posed());
        for name in ["chin", "nose", "forehead", "left-eye", "head-top"] {
            let [one, two] = [(&usual, &whole), (&odd, &straight)]
                .map(|(anatomy, skeleton)| anatomy.landmark_place_position(skeleton, &model, name).expect(name));
            assert!(one.distance(two) < 0.03, "{name}: {one} {two}");
        }
    }
}
