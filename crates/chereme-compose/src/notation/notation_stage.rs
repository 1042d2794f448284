//! The body that signs: its directions, its surface, and points of its hands.

use std::sync::Arc;

use chereme_motion::anatomy::BodyFrame;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{BodyAnatomy, BodyPart, BodySide, HandAngles, HandFinger, LocalPose, ModelPose, Skeleton};
use chereme_sign::hamnosys::HandDigit;
use chereme_sign::hamnosys::sites::{DigitFace, NotatedHandPoint, digit_joint, from_bone, on_palm};

use super::notation_arm::{ArmBoneRig, HeldDirections};
use crate::sources::MovementMaterial;

/// Half the thickness of a finger, in hand lengths.
pub(crate) const FINGER_FLESH: f64 = 0.042;

/// A body in its standing posture.
pub(crate) struct StandingBody {
    pub(crate) skeleton: Arc<Skeleton>,
    pub(crate) anatomy: Arc<BodyAnatomy>,
    pub(crate) base: LocalPose,
    pub(crate) model: ModelPose,
    /// Level unit vector to the signer's left.
    pub(crate) left: DVec3,
    /// Level unit vector to the signer's front.
    pub(crate) forward: DVec3,
    /// The width of the shoulders in metres.
    pub(crate) shoulders: f64,
    /// The length of the arm in metres.
    pub(crate) arm: f64,
    pub(crate) torso: TrunkObstacle,
    /// The right hand, then the left.
    pub(crate) hands: [Option<StagedHand>; 2],
}

/// A hand at the end of its arm.
pub(crate) struct StagedHand {
    pub(crate) side: BodySide,
    pub(crate) rig: ArmBoneRig,
    /// The joints below the wrist, parents first.
    pub(crate) fingers: Vec<usize>,
    /// Direction of the hand's axis, in the space of its joint.
    pub(crate) along: DVec3,
    /// Direction of the palm, in the space of its joint.
    pub(crate) palm: DVec3,
    /// Direction of the thumb's side, in the space of its joint.
    pub(crate) radial: DVec3,
    /// Distance from the wrist to the tip of the middle finger, in metres.
    length: f64,
    /// Distance from the wrist to the base of the middle finger, in metres.
    base: f64,
    joint: usize,
}

/// A posture of the fingers of one hand.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FingerShape {
    pub(crate) angles: HandAngles,
    /// The local rotations of [`StagedHand::fingers`].
    pub(crate) rotations: Vec<DQuat>,
    /// Positions and rotations of the joints in the hand's space, in the order of [`StagedHand::fingers`].
    places: Vec<(DVec3, DQuat)>,
    /// Points of the hand in its space.
    pub(crate) outline: HandOutline,
}

/// Points of a hand in its space: wrist, palm, then knuckles, middle joints and tips.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct HandOutline {
    pub(crate) points: Vec<DVec3>,
    /// The middle of the smallest box around the points.
    pub(crate) middle: DVec3,
    /// Distance (m) of the farthest point from the middle.
    pub(crate) radius: f64,
}

impl HandOutline {
    /// A hand without points: its wrist alone counts.
    pub(crate) const EMPTY_HAND_OUTLINE: &'static Self = &Self {
        points: Vec::new(),
        middle: DVec3::ZERO,
        radius: 0.0,
    };

    fn outline_from_points(points: Vec<DVec3>) -> Self {
        let Some(&first) = points.first() else {
            return Self::default();
        };
        let (low, high) = points
            .iter()
            .fold((first, first), |(low, high), &point| (low.min(point), high.max(point)));
        let middle = low.midpoint(high);
        let far = points.iter().map(|point| point.distance(middle));
        Self {
            radius: far.fold(0.0, f64::max),
            middle,
            points,
        }
    }
}

impl StandingBody {
    /// Takes the body from the first frame of its material; `None` if it has no arm.
    pub(crate) fn body_from_material(material: &MovementMaterial) -> Option<Self> {
        let clip = &material.clip;
        if clip.clip_frame_count() == 0 {
            return None;
        }
        let (skeleton, anatomy) = (Arc::clone(clip.clip_skeleton()), Arc::clone(&material.anatomy));
        Self::body_in_posture(skeleton, anatomy, clip.clip_pose_at(0))
    }

    /// Returns the body in a posture; `None` if it has no arm.
    pub(crate) fn body_in_posture(skeleton: Arc<Skeleton>, anatomy: Arc<BodyAnatomy>, base: LocalPose) -> Option<Self> {
        let model = ModelPose::from_local_pose(&skeleton, &base);
        let measures = anatomy.anatomy_measures()?;
        let body = anatomy.body_frame(&model);
        let body_forward = body.map_or(DVec3::Z, |body| body.forward);
        let forward = DVec3::new(body_forward.x, 0.0, body_forward.z).normalize_or(DVec3::Z);
        let left = DVec3::Y.cross(forward);
        let torso = TrunkObstacle::trunk_from_frame(body, measures.trunk);
        let hands = BodySide::BOTH_SIDES
            .map(|side| StagedHand::hand_from_skeleton(&skeleton, &anatomy, &base, &model, side, [left, forward]));
        if hands.iter().all(Option::is_none) {
            return None;
        }
        Some(Self {
            skeleton,
            anatomy,
            base,
            model,
            left,
            forward,
            shoulders: measures.shoulder_width,
            arm: measures.arm,
            torso,
            hands,
        })
    }

    /// Returns the hand of a side.
    pub(crate) fn hand_of_side(&self, side: BodySide) -> Option<&StagedHand> {
        self.hands[usize::from(side == BodySide::Left)].as_ref()
    }

    /// Converts left, up and forward to model space.
    pub(crate) fn body_to_model_direction(&self, v: DVec3) -> DVec3 {
        self.left * v.x + DVec3::Y * v.y + self.forward * v.z
    }

    /// Returns the position of a landmark on the standing body.
    pub(crate) fn body_landmark_position(&self, name: &str) -> Option<DVec3> {
        self.anatomy.landmark_place_position(&self.skeleton, &self.model, name)
    }

    /// Returns the middle between the shoulder joints.
    pub(crate) fn shoulder_middle(&self) -> DVec3 {
        let shoulders = self.hands.iter().flatten().map(|hand| hand.rig.shoulder);
        let (sum, count) = shoulders.fold((DVec3::ZERO, 0.0), |(sum, n), at| (sum + at, n + 1.0));
        let middle = sum / count;
        match (&self.hands[0], &self.hands[1]) {
            (Some(_), Some(_)) => middle,
            (Some(_), None) => middle + self.left * (0.5 * self.shoulders),
            _ => middle - self.left * (0.5 * self.shoulders),
        }
    }

    /// Returns the shape of the fingers for joint angles.
    pub(crate) fn finger_shape(&self, side: BodySide, angles: &HandAngles) -> FingerShape {
        let mut pose = self.base.clone();
        self.anatomy.set_hand_angles(&self.skeleton, side, angles, &mut pose);
        self.shape_of(side, *angles, &pose)
    }

    /// Returns the shape of the fingers in a posture of the body.
    pub(crate) fn shape_of(&self, side: BodySide, angles: HandAngles, pose: &LocalPose) -> FingerShape {
        let Some(hand) = self.hand_of_side(side) else {
            return FingerShape {
                angles,
                rotations: Vec::new(),
                places: Vec::new(),
                outline: HandOutline::default(),
            };
        };
        let rotations = hand.fingers.iter().map(|&j| pose.rotations[j]).collect();
        self.shape_with(hand, angles, rotations, &pose.translations)
    }

    /// Returns the outline of a hand with these finger rotations.
    pub(crate) fn hand_outline(&self, side: BodySide, rotations: Vec<DQuat>) -> HandOutline {
        let Some(hand) = self.hand_of_side(side) else {
            return HandOutline::default();
        };
        let angles = HandAngles::default();
        let shape = self.shape_with(hand, angles, rotations, &self.base.translations);
        shape.outline
    }

    fn shape_with(
        &self,
        hand: &StagedHand,
        angles: HandAngles,
        rotations: Vec<DQuat>,
        translations: &[DVec3],
    ) -> FingerShape {
        let mut places: Vec<(DVec3, DQuat)> = Vec::with_capacity(rotations.len());
        for (&joint, &turn) in hand.fingers.iter().zip(&rotations) {
            let parent = self.skeleton.joint_parent(joint);
            let above = hand.fingers.iter().position(|&j| Some(j) == parent);
            let (at, turned) = above.map_or((DVec3::ZERO, DQuat::IDENTITY), |n| places[n]);
            places.push((at + turned * translations[joint], turned * turn));
        }
        let mut shape = FingerShape {
            angles,
            rotations,
            places,
            outline: HandOutline::default(),
        };
        let mut outline = vec![DVec3::ZERO, hand.along * (0.55 * hand.base)];
        for digit in HandDigit::ALL_HAND_DIGITS {
            for point in [
                NotatedHandPoint::Base(digit, DigitFace::Middle),
                NotatedHandPoint::Middle(digit, DigitFace::Middle),
                NotatedHandPoint::Tip(digit, DigitFace::Middle),
            ] {
                outline.push(self.hand_point_offset(hand, &shape, point));
            }
        }
        // The joints before the tips stand out if fingers are hooked.
        let ends = HandDigit::ALL_HAND_DIGITS.into_iter().filter_map(|digit| {
            let joint = self.anatomy.part_joint(digit_joint(hand.side, digit, 3))?;
            let n = hand.fingers.iter().position(|&j| j == joint)?;
            Some(shape.places[n].0)
        });
        outline.extend(ends);
        shape.outline = HandOutline::outline_from_points(outline);
        shape
    }

    /// Returns the position of a hand point, in the space of the hand's joint.
    pub(crate) fn hand_point_offset(&self, hand: &StagedHand, shape: &FingerShape, point: NotatedHandPoint) -> DVec3 {
        match point {
            NotatedHandPoint::Palm
            | NotatedHandPoint::Back
            | NotatedHandPoint::Radial
            | NotatedHandPoint::Ulnar
            | NotatedHandPoint::ThumbBall => {
                let [along, palm, radial] = on_palm(point);
                hand.along * (along * hand.base) + (hand.palm * palm + hand.radial * radial) * hand.length
            }
            NotatedHandPoint::Wrist(face) => self.faced(hand, face, hand.along) * (from_bone(point)[0] * hand.length),
            NotatedHandPoint::Tip(digit, face) => self.on_digit(hand, shape, digit, 3, face, from_bone(point)),
            NotatedHandPoint::Middle(digit, face) => self.on_digit(hand, shape, digit, 2, face, from_bone(point)),
            NotatedHandPoint::Base(digit, face) => self.on_digit(hand, shape, digit, 1, face, from_bone(point)),
            NotatedHandPoint::Elbow => -hand.along * hand.rig.lengths[1],
            NotatedHandPoint::Forearm => -hand.along * (0.5 * hand.rig.lengths[1]),
            NotatedHandPoint::UpperArm => -hand.along * (1.3 * hand.rig.lengths[1]),
        }
    }

    /// Returns the outward unit normal at a hand point, in the space of the hand's joint.
    pub(crate) fn hand_point_normal(&self, hand: &StagedHand, shape: &FingerShape, point: NotatedHandPoint) -> DVec3 {
        match point {
            NotatedHandPoint::Palm | NotatedHandPoint::ThumbBall => hand.palm,
            NotatedHandPoint::Back => -hand.palm,
            NotatedHandPoint::Radial => hand.radial,
            NotatedHandPoint::Ulnar => -hand.radial,
            NotatedHandPoint::Wrist(face) => self.faced(hand, face, hand.along),
            NotatedHandPoint::Tip(digit, DigitFace::Middle) => self.last_bone_direction(hand, shape, digit),
            NotatedHandPoint::Tip(digit, face) => self.faced(hand, face, self.last_bone_direction(hand, shape, digit)),
            NotatedHandPoint::Middle(digit, face) | NotatedHandPoint::Base(digit, face) => {
                let _ = digit;
                let face = if face == DigitFace::Middle {
                    DigitFace::Dorsal
                } else {
                    face
                };
                self.faced(hand, face, hand.along)
            }
            NotatedHandPoint::Elbow | NotatedHandPoint::Forearm | NotatedHandPoint::UpperArm => -hand.palm,
        }
    }

    /// Returns the outward normal of a face of the hand, or of a digit whose bone points along `bone`.
    fn faced(&self, hand: &StagedHand, face: DigitFace, bone: DVec3) -> DVec3 {
        let across = hand.along.cross(hand.palm);
        match face {
            DigitFace::Middle => DVec3::ZERO,
            DigitFace::Palmar => across.cross(bone).normalize_or(hand.palm),
            DigitFace::Dorsal => -across.cross(bone).normalize_or(hand.palm),
            DigitFace::Radial => hand.radial,
            DigitFace::Ulnar => -hand.radial,
        }
    }

    /// Returns the direction of a digit's last bone in the hand's space.
    pub(crate) fn last_bone_direction(&self, hand: &StagedHand, shape: &FingerShape, digit: HandDigit) -> DVec3 {
        let tip = self.digit_joint_position(hand, shape, digit, 3);
        let before = self.digit_joint_position(hand, shape, digit, 2);
        match (tip, before) {
            (Some(tip), Some(before)) => (tip - before).normalize_or(hand.along),
            _ => hand.along,
        }
    }

    /// Returns a point on a digit: 1 its base joint, 2 its middle joint, 3 its tip.
    fn on_digit(
        &self,
        hand: &StagedHand,
        shape: &FingerShape,
        digit: HandDigit,
        which: u8,
        face: DigitFace,
        [out, back]: [f64; 2],
    ) -> DVec3 {
        let digit_end = self.digit_joint_position(hand, shape, digit, which);
        let end_point = digit_end.unwrap_or(hand.along * (hand.base * if which == 1 { 1.0 } else { 1.6 }));
        if face == DigitFace::Middle {
            return end_point;
        }
        let bone = if which == 1 {
            hand.along
        } else {
            self.last_bone_direction(hand, shape, digit)
        };
        end_point + (self.faced(hand, face, bone) * out - bone * back) * hand.length
    }

    /// Returns the position of the joint before the tip of a digit, in the hand's space.
    pub(crate) fn last_joint(&self, hand: &StagedHand, shape: &FingerShape, digit: HandDigit) -> Option<DVec3> {
        let joint = self.anatomy.part_joint(digit_joint(hand.side, digit, 3))?;
        let n = hand.fingers.iter().position(|&known| known == joint)?;
        Some(shape.places[n].0)
    }

    /// Returns the position of the base joint (1), the middle joint (2) or the tip (3) of a digit.
    fn digit_joint_position(
        &self,
        hand: &StagedHand,
        shape: &FingerShape,
        digit: HandDigit,
        which: u8,
    ) -> Option<DVec3> {
        let place = |joint: usize| {
            let n = hand.fingers.iter().position(|&j| j == joint)?;
            Some(shape.places[n])
        };
        if which < 3 {
            let joint = self.anatomy.part_joint(digit_joint(hand.side, digit, which));
            return Some(place(joint?)?.0);
        }
        let last = (1..4)
            .rev()
            .find_map(|n| self.anatomy.part_joint(digit_joint(hand.side, digit, n)))?;
        let (at, turned) = place(last)?;
        if let Some(tip) = self.skeleton.joint_at(last).tip {
            return Some(at + turned * tip);
        }
        if let [child] = *self.skeleton.joint_children(last) {
            return Some(place(child)?.0);
        }
        let from = place(self.skeleton.joint_parent(last)?)?.0;
        Some(at + (at - from) * 0.8)
    }

    /// Returns the rotation of a hand's joint that points its axis along `direction` and its palm towards
    /// `palm`, both in model space.
    pub(crate) fn hand_joint_rotation(&self, side: BodySide, direction: DVec3, palm: DVec3) -> Option<DQuat> {
        let hand_turn = self.anatomy.hand_rotation(side, direction, palm);
        hand_turn.or_else(|| {
            let hand = self.hand_of_side(side)?;
            let columns = |a: DVec3, p: DVec3| chereme_motion::glam::DMat3::from_cols(a, p, a.cross(p));
            let palm = palm.reject_from_normalized(direction).try_normalize()?;
            let turn = columns(direction, palm) * columns(hand.along, hand.palm).transpose();
            Some(DQuat::from_mat3(&turn).normalize())
        })
    }
}

impl StagedHand {
    fn hand_from_skeleton(
        skeleton: &Arc<Skeleton>,
        anatomy: &BodyAnatomy,
        base: &LocalPose,
        model: &ModelPose,
        side: BodySide,
        [left, forward]: [DVec3; 2],
    ) -> Option<Self> {
        let rig = ArmBoneRig::build_arm_rig(skeleton, anatomy, base, model, side, [left, forward])?;
        let joint = rig.chain.hand;
        let back = model.model_joint_rotation(joint).inverse();
        let along = (back * anatomy.hand_direction(side, model)?).normalize();
        let palm = match anatomy.palm_normal(side, model) {
            Some(palm) => back * palm,
            None => {
                let down = back * (rig.elbow_axis * -side.side_sign());
                down.reject_from_normalized(along)
                    .normalize_or(along.any_orthonormal_vector())
            }
        };
        let measures = anatomy.anatomy_measures()?;
        let knuckle = anatomy.part_joint(BodyPart::Finger(side, HandFinger::Middle, 1));
        let joint_position = |joint: usize| {
            model
                .model_joint_position(joint)
                .distance(model.model_joint_position(rig.chain.hand))
        };
        Some(Self {
            side,
            fingers: anatomy.finger_joints(side),
            along,
            palm,
            radial: palm.cross(along) * side.side_sign(),
            length: measures.hand,
            base: knuckle.map_or(0.5 * measures.hand, joint_position),
            joint,
            rig,
        })
    }

    /// Returns the hand's directions in the space of its joint.
    pub(crate) fn held_hand_directions(&self) -> HeldDirections {
        HeldDirections::from_hand_directions(self.along, self.palm, self.radial)
    }

    /// Returns the hand's joint.
    pub(crate) fn hand_joint_index(&self) -> usize {
        self.joint
    }

    /// Returns the hand's length in metres.
    pub(crate) fn staged_hand_length(&self) -> f64 {
        self.length
    }
}

/// The trunk as an obstacle: an ellipse at each height.
pub(crate) struct TrunkObstacle {
    body: Option<BodyFrame>,
    trunk: f64,
}

/// Outline of the trunk, in shoulder widths except for the first number: height above the shoulders (trunk
/// lengths), front, half the width. The front passes through the landmarks of the trunk.
const TRUNK_OUTLINE: [(f64, f64, f64); 11] = [
    // Above and below, the surface draws back behind the body, so that depth fades out there.
    (0.34, -0.15, 0.12),
    (0.22, 0.13, 0.20),
    (0.12, 0.19, 0.30),
    (0.02, 0.22, 0.38),
    (-0.08, 0.27, 0.45),
    (-0.28, 0.325, 0.46),
    (-0.58, 0.325, 0.43),
    (-0.72, 0.335, 0.42),
    (-0.88, 0.315, 0.43),
    (-1.05, 0.29, 0.46),
    (-1.45, -0.25, 0.46),
];

/// Greatest distance of the trunk's front from its middle, in shoulder widths.
const TRUNK_FRONT_EXTENT: f64 = 0.335;
/// Greatest distance of the trunk's side from its middle, in shoulder widths.
const TRUNK_SIDE_EXTENT: f64 = 0.46;
/// Distance of the trunk's back from its middle, in shoulder widths.
const TRUNK_BACK_EXTENT: f64 = 0.22;

impl TrunkObstacle {
    /// Returns the trunk of a body in a posture, `trunk` being its length in metres.
    pub(crate) fn trunk_from_frame(body: Option<BodyFrame>, trunk: f64) -> Self {
        Self { body, trunk }
    }

    /// Returns the outward unit normal of the trunk's front near a position.
    pub(crate) fn trunk_front_normal(&self, at: DVec3) -> Option<DVec3> {
        let body = self.body.as_ref()?;
        let step = 0.01;
        let along = |axis: DVec3| {
            let [more, less] = [1.0, -1.0].map(|sign| trunk_outline_share(body, self.trunk, at + axis * (sign * step)));
            Some(axis * (more? - less?))
        };
        (along(body.left)? + along(body.up)? + along(body.forward)?).try_normalize()
    }

    /// Returns the box around the trunk in the space of a hand with this wrist and rotation; `None` without a trunk.
    pub(crate) fn seen_from(&self, wrist: DVec3, turned: DQuat) -> Option<TrunkBox> {
        let body = self.body.as_ref()?;
        let (back, v) = (turned.inverse(), wrist - body.origin);
        let [top, bottom] = [TRUNK_OUTLINE[0].0, TRUNK_OUTLINE[TRUNK_OUTLINE.len() - 1].0].map(|y| y * self.trunk);
        let [front, behind, wide] =
            [TRUNK_FRONT_EXTENT, -TRUNK_BACK_EXTENT, TRUNK_SIDE_EXTENT].map(|share| share * body.scale);
        let sides = [
            (body.forward, behind, front),
            (body.left, -wide, wide),
            (body.up, bottom, top),
        ];
        Some(TrunkBox {
            sides: sides.map(|(axis, from, to)| {
                let axis_distance = v.dot(axis);
                (back * axis, from - axis_distance, to - axis_distance)
            }),
        })
    }

    /// Returns the offset by which an elbow nearer than `margin` metres to the trunk leaves it; sideways
    /// next to the back.
    pub(crate) fn offset_aside(&self, at: DVec3, margin: f64) -> DVec3 {
        let Some(body) = &self.body else {
            return DVec3::ZERO;
        };
        let v = body.to_body(at);
        if !(-TRUNK_BACK_EXTENT..0.0).contains(&v.z) {
            return self.offset_out_of_trunk(at, margin);
        }
        let Some((_, wide)) = trunk_extent_at(v.y * body.scale / self.trunk).filter(|(front, _)| *front > 0.0) else {
            return DVec3::ZERO;
        };
        let deep = wide * body.scale + margin - v.x.abs() * body.scale;
        body.left * (deep.max(0.0) * if v.x < 0.0 { -1.0 } else { 1.0 })
    }

    /// Returns the level offset by which a point nearer than `margin` metres to the trunk leaves it: along
    /// the surface normal, preferably to the front.
    pub(crate) fn offset_out_of_trunk(&self, at: DVec3, margin: f64) -> DVec3 {
        let Some(body) = &self.body else {
            return DVec3::ZERO;
        };
        let v = at - body.origin;
        let z = v.dot(body.forward);
        let x = v.dot(body.left);
        let aside = x.abs() > TRUNK_SIDE_EXTENT * body.scale + margin;
        if aside || z > TRUNK_FRONT_EXTENT * body.scale + margin || z < -TRUNK_BACK_EXTENT * body.scale - margin {
            return DVec3::ZERO;
        }
        let y = v.dot(body.up) / self.trunk;
        let Some((front, wide)) = trunk_extent_at(y) else {
            return DVec3::ZERO;
        };
        let margin = margin / body.scale;
        let (front, wide, back) = (front + margin, wide + margin, TRUNK_BACK_EXTENT.min(front) + margin);
        let (x, z) = (x / body.scale, z / body.scale);
        if x.abs() >= wide || z >= front || z <= -back {
            return DVec3::ZERO;
        }
        let deep = |z: f64| if z >= 0.0 { front } else { back };
        let inside = |x: f64, z: f64| (x / wide).powi(2) + (z / deep(z)).powi(2) < 1.0;
        if front <= 0.0 || back <= 0.0 || wide <= 0.0 {
            return DVec3::ZERO;
        }
        if !inside(x, z) {
            return corner(x, z, wide, back).map_or(DVec3::ZERO, |(dx, dz)| {
                (body.left * dx + body.forward * dz) * body.scale
            });
        }
        // Only points well behind the middle leave at the back.
        let ahead = ((z + 0.5 * TRUNK_BACK_EXTENT) / (0.5 * TRUNK_BACK_EXTENT)).clamp(0.0, 1.0);
        let (nx, nz) = (x / (wide * wide), z / (deep(z) * deep(z)));
        let size = (nx * nx + nz * nz).sqrt().max(1e-9);
        let (dx, dz) = (nx / size, nz / size + 1.2 * ahead);
        let size = (dx * dx + dz * dz).sqrt();
        let (dx, dz) = if size > 1e-6 {
            (dx / size, dz / size)
        } else {
            (0.0, 1.0)
        };
        let b = deep(if dz >= 0.0 { 0.0 } else { -1.0 });
        // Intersection of the line and the ellipse: |(x + t dx) / wide, (z + t dz) / b| = 1.
        let along = (dx / wide).powi(2) + (dz / b).powi(2);
        let half = x * dx / (wide * wide) + z * dz / (b * b);
        let rest = (x / wide).powi(2) + (z / b).powi(2) - 1.0;
        let t = (-half + (half * half - along * rest).max(0.0).sqrt()) / along;
        let (dx, dz) = (dx * t.max(0.0), dz * t.max(0.0));
        let (more_x, more_z) = corner(x + dx, z + dz, wide, back).unwrap_or_default();
        (body.left * (dx + more_x) + body.forward * (dz + more_z)) * body.scale
    }
}

/// The box around the trunk in the space of a hand.
pub(crate) struct TrunkBox {
    /// Its three axes, and the least and the greatest coordinate of the box on each, in metres.
    sides: [(DVec3, f64, f64); 3],
}

impl TrunkBox {
    /// Returns whether everything within a distance of a point is surely outside the trunk.
    #[inline]
    pub(crate) fn is_clear(&self, at: DVec3, around: f64) -> bool {
        // Larger than any rounding error of the coordinates.
        let around = around + 1e-9;
        self.sides.iter().any(|&(axis, from, to)| {
            let axis_distance = at.dot(axis);
            axis_distance < from - around || axis_distance > to + around
        })
    }
}

/// Returns the shorter offset out of the corner next to the back, which is almost square (left, forward).
fn corner(x: f64, z: f64, wide: f64, back: f64) -> Option<(f64, f64)> {
    let (aside, behind) = (0.94 * wide - x.abs(), z + 0.92 * back);
    if z >= 0.0 || aside <= 0.0 || behind <= 0.0 {
        return None;
    }
    Some(match aside < behind {
        true => (aside * x.signum(), 0.0),
        false => (0.0, -behind),
    })
}

/// Returns the distance of a position from the middle, as a multiple of the trunk's outline at its height.
fn trunk_outline_share(body: &BodyFrame, trunk: f64, at: DVec3) -> Option<f64> {
    let v = at - body.origin;
    let (front, wide) = trunk_extent_at(v.dot(body.up) / trunk)?;
    let front = front.max(0.05);
    let x = v.dot(body.left) / (body.scale * wide);
    let z = v.dot(body.forward) / (body.scale * front);
    Some(x.hypot(z))
}

/// Returns the extent of the trunk at a height: forward, and to either side.
fn trunk_extent_at(y: f64) -> Option<(f64, f64)> {
    let (top, bottom) = (TRUNK_OUTLINE[0].0, TRUNK_OUTLINE[TRUNK_OUTLINE.len() - 1].0);
    if y >= top || y <= bottom {
        return None;
    }
    let n = TRUNK_OUTLINE
        .partition_point(|row| row.0 >= y)
        .clamp(1, TRUNK_OUTLINE.len() - 1);
    let (above, below) = (TRUNK_OUTLINE[n - 1], TRUNK_OUTLINE[n]);
    let w = (above.0 - y) / (above.0 - below.0);
    let mix = |a: f64, b: f64| a + (b - a) * w;
    Some((mix(above.1, below.1), mix(above.2, below.2)))
}
