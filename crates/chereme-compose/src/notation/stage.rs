//! The body that signs: its directions, its surface, and points of its hands.

use std::sync::Arc;

use chereme_motion::anatomy::BodyFrame;
use chereme_motion::glam::{DQuat, DVec3};
use chereme_motion::{Anatomy, Finger, HandAngles, ModelPose, Part, Pose, Side, Skeleton};
use chereme_sign::hamnosys::Digit;
use chereme_sign::hamnosys::sites::{Face, HandPoint, digit_joint, from_bone, on_palm};

use super::arm::{HeldDirections, Rig};
use crate::sources::Material;

/// Half the thickness of a finger, in hand lengths.
pub(crate) const FINGER_FLESH: f64 = 0.042;

/// A body in its standing posture.
pub(crate) struct Stage {
    pub(crate) skeleton: Arc<Skeleton>,
    pub(crate) anatomy: Arc<Anatomy>,
    pub(crate) base: Pose,
    pub(crate) model: ModelPose,
    /// Level unit vector to the signer's left.
    pub(crate) left: DVec3,
    /// Level unit vector to the signer's front.
    pub(crate) forward: DVec3,
    /// The width of the shoulders in metres.
    pub(crate) shoulders: f64,
    /// The length of the arm in metres.
    pub(crate) arm: f64,
    pub(crate) torso: Torso,
    /// The right hand, then the left.
    pub(crate) hands: [Option<Hand>; 2],
}

/// A hand at the end of its arm.
pub(crate) struct Hand {
    pub(crate) side: Side,
    pub(crate) rig: Rig,
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
pub(crate) struct Shape {
    pub(crate) angles: HandAngles,
    /// The local rotations of [`Hand::fingers`].
    pub(crate) rotations: Vec<DQuat>,
    /// Positions and rotations of the joints in the hand's space, in the order of [`Hand::fingers`].
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
    pub(crate) const NONE: &'static Self = &Self {
        points: Vec::new(),
        middle: DVec3::ZERO,
        radius: 0.0,
    };

    fn of(points: Vec<DVec3>) -> Self {
        let Some(&first) = points.first() else {
            return Self::default();
        };
        let (low, high) = points.iter().fold((first, first), |(low, high), &point| {
            (low.min(point), high.max(point))
        });
        let middle = low.midpoint(high);
        let far = points.iter().map(|point| point.distance(middle));
        Self {
            radius: far.fold(0.0, f64::max),
            middle,
            points,
        }
    }
}

impl Stage {
    /// Takes the body from the first frame of its material; `None` if it has no arm.
    pub(crate) fn of(material: &Material) -> Option<Self> {
        let clip = &material.clip;
        if clip.frames() == 0 {
            return None;
        }
        let (skeleton, anatomy) = (Arc::clone(clip.skeleton()), Arc::clone(&material.anatomy));
        let base = clip.pose(0);
        let model = ModelPose::of(&skeleton, &base);
        let measures = anatomy.measures()?;
        let body = anatomy.body_frame(&model);
        let forward = body.map_or(DVec3::Z, |body| body.forward);
        let forward = DVec3::new(forward.x, 0.0, forward.z).normalize_or(DVec3::Z);
        let left = DVec3::Y.cross(forward);
        let torso = Torso::of(body, measures.trunk);
        let hands = Side::BOTH
            .map(|side| Hand::of(&skeleton, &anatomy, &base, &model, side, [left, forward]));
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
    pub(crate) fn hand(&self, side: Side) -> Option<&Hand> {
        self.hands[usize::from(side == Side::Left)].as_ref()
    }

    /// Converts left, up and forward to model space.
    pub(crate) fn direction(&self, v: DVec3) -> DVec3 {
        self.left * v.x + DVec3::Y * v.y + self.forward * v.z
    }

    /// Returns the position of a landmark on the standing body.
    pub(crate) fn landmark(&self, name: &str) -> Option<DVec3> {
        self.anatomy.landmark(&self.skeleton, &self.model, name)
    }

    /// Returns the middle between the shoulder joints.
    pub(crate) fn middle(&self) -> DVec3 {
        let at = self.hands.iter().flatten().map(|hand| hand.rig.shoulder);
        let (sum, count) = at.fold((DVec3::ZERO, 0.0), |(sum, n), at| (sum + at, n + 1.0));
        let middle = sum / count;
        match (&self.hands[0], &self.hands[1]) {
            (Some(_), Some(_)) => middle,
            (Some(_), None) => middle + self.left * (0.5 * self.shoulders),
            _ => middle - self.left * (0.5 * self.shoulders),
        }
    }

    /// Returns the shape of the fingers for joint angles.
    pub(crate) fn shape(&self, side: Side, angles: &HandAngles) -> Shape {
        let mut pose = self.base.clone();
        self.anatomy
            .set_hand_angles(&self.skeleton, side, angles, &mut pose);
        self.shape_of(side, *angles, &pose)
    }

    /// Returns the shape of the fingers in a posture of the body.
    pub(crate) fn shape_of(&self, side: Side, angles: HandAngles, pose: &Pose) -> Shape {
        let Some(hand) = self.hand(side) else {
            return Shape {
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
    pub(crate) fn outline(&self, side: Side, rotations: Vec<DQuat>) -> HandOutline {
        let Some(hand) = self.hand(side) else {
            return HandOutline::default();
        };
        let angles = HandAngles::default();
        let shape = self.shape_with(hand, angles, rotations, &self.base.translations);
        shape.outline
    }

    fn shape_with(
        &self,
        hand: &Hand,
        angles: HandAngles,
        rotations: Vec<DQuat>,
        translations: &[DVec3],
    ) -> Shape {
        let mut places: Vec<(DVec3, DQuat)> = Vec::with_capacity(rotations.len());
        for (&joint, &turn) in hand.fingers.iter().zip(&rotations) {
            let parent = self.skeleton.parent(joint);
            let above = hand.fingers.iter().position(|&j| Some(j) == parent);
            let (at, turned) = above.map_or((DVec3::ZERO, DQuat::IDENTITY), |n| places[n]);
            places.push((at + turned * translations[joint], turned * turn));
        }
        let mut shape = Shape {
            angles,
            rotations,
            places,
            outline: HandOutline::default(),
        };
        let mut outline = vec![DVec3::ZERO, hand.along * (0.55 * hand.base)];
        for digit in Digit::ALL {
            for point in [
                HandPoint::Base(digit, Face::Middle),
                HandPoint::Middle(digit, Face::Middle),
                HandPoint::Tip(digit, Face::Middle),
            ] {
                outline.push(self.point(hand, &shape, point));
            }
        }
        // The joints before the tips stand out if fingers are hooked.
        let ends = Digit::ALL.into_iter().filter_map(|digit| {
            let joint = self.anatomy.joint(digit_joint(hand.side, digit, 3))?;
            let n = hand.fingers.iter().position(|&j| j == joint)?;
            Some(shape.places[n].0)
        });
        outline.extend(ends);
        shape.outline = HandOutline::of(outline);
        shape
    }

    /// Returns the position of a hand point, in the space of the hand's joint.
    pub(crate) fn point(&self, hand: &Hand, shape: &Shape, point: HandPoint) -> DVec3 {
        match point {
            HandPoint::Palm
            | HandPoint::Back
            | HandPoint::Radial
            | HandPoint::Ulnar
            | HandPoint::ThumbBall => {
                let [along, palm, radial] = on_palm(point);
                hand.along * (along * hand.base)
                    + (hand.palm * palm + hand.radial * radial) * hand.length
            }
            HandPoint::Wrist(face) => {
                self.faced(hand, face, hand.along) * (from_bone(point)[0] * hand.length)
            }
            HandPoint::Tip(digit, face) => {
                self.on_digit(hand, shape, (digit, 3, face), from_bone(point))
            }
            HandPoint::Middle(digit, face) => {
                self.on_digit(hand, shape, (digit, 2, face), from_bone(point))
            }
            HandPoint::Base(digit, face) => {
                self.on_digit(hand, shape, (digit, 1, face), from_bone(point))
            }
            HandPoint::Elbow => -hand.along * hand.rig.lengths[1],
            HandPoint::Forearm => -hand.along * (0.5 * hand.rig.lengths[1]),
            HandPoint::UpperArm => -hand.along * (1.3 * hand.rig.lengths[1]),
        }
    }

    /// Returns the outward unit normal at a hand point, in the space of the hand's joint.
    pub(crate) fn outward(&self, hand: &Hand, shape: &Shape, point: HandPoint) -> DVec3 {
        match point {
            HandPoint::Palm | HandPoint::ThumbBall => hand.palm,
            HandPoint::Back => -hand.palm,
            HandPoint::Radial => hand.radial,
            HandPoint::Ulnar => -hand.radial,
            HandPoint::Wrist(face) => self.faced(hand, face, hand.along),
            HandPoint::Tip(digit, Face::Middle) => self.bone(hand, shape, digit),
            HandPoint::Tip(digit, face) => self.faced(hand, face, self.bone(hand, shape, digit)),
            HandPoint::Middle(digit, face) | HandPoint::Base(digit, face) => {
                let _ = digit;
                let face = if face == Face::Middle {
                    Face::Dorsal
                } else {
                    face
                };
                self.faced(hand, face, hand.along)
            }
            HandPoint::Elbow | HandPoint::Forearm | HandPoint::UpperArm => -hand.palm,
        }
    }

    /// Returns the outward normal of a face of the hand, or of a digit whose bone points along `bone`.
    fn faced(&self, hand: &Hand, face: Face, bone: DVec3) -> DVec3 {
        let across = hand.along.cross(hand.palm);
        match face {
            Face::Middle => DVec3::ZERO,
            Face::Palmar => across.cross(bone).normalize_or(hand.palm),
            Face::Dorsal => -across.cross(bone).normalize_or(hand.palm),
            Face::Radial => hand.radial,
            Face::Ulnar => -hand.radial,
        }
    }

    /// Returns the direction of a digit's last bone in the hand's space.
    pub(crate) fn bone(&self, hand: &Hand, shape: &Shape, digit: Digit) -> DVec3 {
        let tip = self.end(hand, shape, digit, 3);
        let before = self.end(hand, shape, digit, 2);
        match (tip, before) {
            (Some(tip), Some(before)) => (tip - before).normalize_or(hand.along),
            _ => hand.along,
        }
    }

    /// Returns a point on a digit: 1 its base joint, 2 its middle joint, 3 its tip.
    fn on_digit(
        &self,
        hand: &Hand,
        shape: &Shape,
        (digit, which, face): (Digit, u8, Face),
        [out, back]: [f64; 2],
    ) -> DVec3 {
        let at = self.end(hand, shape, digit, which);
        let at = at.unwrap_or(hand.along * (hand.base * if which == 1 { 1.0 } else { 1.6 }));
        if face == Face::Middle {
            return at;
        }
        let bone = if which == 1 {
            hand.along
        } else {
            self.bone(hand, shape, digit)
        };
        at + (self.faced(hand, face, bone) * out - bone * back) * hand.length
    }

    /// Returns the position of the joint before the tip of a digit, in the hand's space.
    pub(crate) fn last_joint(&self, hand: &Hand, shape: &Shape, digit: Digit) -> Option<DVec3> {
        let joint = self.anatomy.joint(digit_joint(hand.side, digit, 3))?;
        let n = hand.fingers.iter().position(|&known| known == joint)?;
        Some(shape.places[n].0)
    }

    /// Returns the position of the base joint (1), the middle joint (2) or the tip (3) of a digit.
    fn end(&self, hand: &Hand, shape: &Shape, digit: Digit, which: u8) -> Option<DVec3> {
        let place = |joint: usize| {
            let n = hand.fingers.iter().position(|&j| j == joint)?;
            Some(shape.places[n])
        };
        if which < 3 {
            let joint = self.anatomy.joint(digit_joint(hand.side, digit, which));
            return Some(place(joint?)?.0);
        }
        let last = (1..4)
            .rev()
            .find_map(|n| self.anatomy.joint(digit_joint(hand.side, digit, n)))?;
        let (at, turned) = place(last)?;
        if let Some(tip) = self.skeleton.joint(last).tip {
            return Some(at + turned * tip);
        }
        if let [child] = *self.skeleton.children(last) {
            return Some(place(child)?.0);
        }
        let from = place(self.skeleton.parent(last)?)?.0;
        Some(at + (at - from) * 0.8)
    }

    /// Returns the rotation of a hand's joint that points its axis along `direction` and its palm towards
    /// `palm`, both in model space.
    pub(crate) fn turned(&self, side: Side, direction: DVec3, palm: DVec3) -> Option<DQuat> {
        let own = self.anatomy.hand_rotation(side, direction, palm);
        own.or_else(|| {
            let hand = self.hand(side)?;
            let columns =
                |a: DVec3, p: DVec3| chereme_motion::glam::DMat3::from_cols(a, p, a.cross(p));
            let palm = palm.reject_from_normalized(direction).try_normalize()?;
            let turn = columns(direction, palm) * columns(hand.along, hand.palm).transpose();
            Some(DQuat::from_mat3(&turn).normalize())
        })
    }
}

impl Hand {
    fn of(
        skeleton: &Arc<Skeleton>,
        anatomy: &Anatomy,
        base: &Pose,
        model: &ModelPose,
        side: Side,
        [left, forward]: [DVec3; 2],
    ) -> Option<Self> {
        let rig = Rig::of(skeleton, anatomy, base, model, side, [left, forward])?;
        let joint = rig.chain.hand;
        let back = model.rotation(joint).inverse();
        let along = (back * anatomy.hand_direction(side, model)?).normalize();
        let palm = match anatomy.palm_normal(side, model) {
            Some(palm) => back * palm,
            None => {
                let down = back * (rig.elbow_axis * -side.sign());
                down.reject_from_normalized(along)
                    .normalize_or(along.any_orthonormal_vector())
            }
        };
        let measures = anatomy.measures()?;
        let knuckle = anatomy.joint(Part::Finger(side, Finger::Middle, 1));
        let at = |joint: usize| {
            model
                .position(joint)
                .distance(model.position(rig.chain.hand))
        };
        Some(Self {
            side,
            fingers: anatomy.fingers(side),
            along,
            palm,
            radial: palm.cross(along) * side.sign(),
            length: measures.hand,
            base: knuckle.map_or(0.5 * measures.hand, at),
            joint,
            rig,
        })
    }

    /// Returns the hand's directions in the space of its joint.
    pub(crate) fn held(&self) -> HeldDirections {
        HeldDirections::of(self.along, self.palm, self.radial)
    }

    /// Returns the hand's joint.
    pub(crate) fn joint(&self) -> usize {
        self.joint
    }

    /// Returns the hand's length in metres.
    pub(crate) fn length(&self) -> f64 {
        self.length
    }
}

/// The trunk as an obstacle: an ellipse at each height.
pub(crate) struct Torso {
    body: Option<BodyFrame>,
    trunk: f64,
}

/// Outline of the trunk, in shoulder widths except for the first number: height above the shoulders (trunk
/// lengths), front, half the width. The front passes through the landmarks of the trunk.
const OUTLINE: [(f64, f64, f64); 11] = [
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
const FRONT: f64 = 0.335;
/// Greatest distance of the trunk's side from its middle, in shoulder widths.
const WIDE: f64 = 0.46;
/// Distance of the trunk's back from its middle, in shoulder widths.
const BACK: f64 = 0.22;

impl Torso {
    /// Returns the trunk of a body in a posture, `trunk` being its length in metres.
    pub(crate) fn of(body: Option<BodyFrame>, trunk: f64) -> Self {
        Self { body, trunk }
    }

    /// Returns the outward unit normal of the trunk's front near a position.
    pub(crate) fn normal(&self, at: DVec3) -> Option<DVec3> {
        let body = self.body.as_ref()?;
        let step = 0.01;
        let along = |axis: DVec3| {
            let [more, less] =
                [1.0, -1.0].map(|sign| share(body, self.trunk, at + axis * (sign * step)));
            Some(axis * (more? - less?))
        };
        (along(body.left)? + along(body.up)? + along(body.forward)?).try_normalize()
    }

    /// Returns the box around the trunk in the space of a hand with this wrist and rotation; `None` without a trunk.
    pub(crate) fn seen_from(&self, wrist: DVec3, turned: DQuat) -> Option<TrunkBox> {
        let body = self.body.as_ref()?;
        let (back, v) = (turned.inverse(), wrist - body.origin);
        let [top, bottom] = [OUTLINE[0].0, OUTLINE[OUTLINE.len() - 1].0].map(|y| y * self.trunk);
        let [front, behind, wide] = [FRONT, -BACK, WIDE].map(|share| share * body.scale);
        let sides = [
            (body.forward, behind, front),
            (body.left, -wide, wide),
            (body.up, bottom, top),
        ];
        Some(TrunkBox {
            sides: sides.map(|(axis, from, to)| {
                let own = v.dot(axis);
                (back * axis, from - own, to - own)
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
        if !(-BACK..0.0).contains(&v.z) {
            return self.offset_out(at, margin);
        }
        let Some((_, wide)) =
            outline(v.y * body.scale / self.trunk).filter(|(front, _)| *front > 0.0)
        else {
            return DVec3::ZERO;
        };
        let deep = wide * body.scale + margin - v.x.abs() * body.scale;
        body.left * (deep.max(0.0) * if v.x < 0.0 { -1.0 } else { 1.0 })
    }

    /// Returns the level offset by which a point nearer than `margin` metres to the trunk leaves it: along
    /// the surface normal, preferably to the front.
    pub(crate) fn offset_out(&self, at: DVec3, margin: f64) -> DVec3 {
        let Some(body) = &self.body else {
            return DVec3::ZERO;
        };
        let v = at - body.origin;
        let z = v.dot(body.forward);
        let x = v.dot(body.left);
        let aside = x.abs() > WIDE * body.scale + margin;
        if aside || z > FRONT * body.scale + margin || z < -BACK * body.scale - margin {
            return DVec3::ZERO;
        }
        let y = v.dot(body.up) / self.trunk;
        let Some((front, wide)) = outline(y) else {
            return DVec3::ZERO;
        };
        let margin = margin / body.scale;
        let (front, wide, back) = (front + margin, wide + margin, BACK.min(front) + margin);
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
        let ahead = ((z + 0.5 * BACK) / (0.5 * BACK)).clamp(0.0, 1.0);
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
            let at = at.dot(axis);
            at < from - around || at > to + around
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
fn share(body: &BodyFrame, trunk: f64, at: DVec3) -> Option<f64> {
    let v = at - body.origin;
    let (front, wide) = outline(v.dot(body.up) / trunk)?;
    let front = front.max(0.05);
    let x = v.dot(body.left) / (body.scale * wide);
    let z = v.dot(body.forward) / (body.scale * front);
    Some(x.hypot(z))
}

/// Returns the extent of the trunk at a height: forward, and to either side.
fn outline(y: f64) -> Option<(f64, f64)> {
    let (top, bottom) = (OUTLINE[0].0, OUTLINE[OUTLINE.len() - 1].0);
    if y >= top || y <= bottom {
        return None;
    }
    let n = OUTLINE
        .partition_point(|row| row.0 >= y)
        .clamp(1, OUTLINE.len() - 1);
    let (above, below) = (OUTLINE[n - 1], OUTLINE[n]);
    let w = (above.0 - y) / (above.0 - below.0);
    let mix = |a: f64, b: f64| a + (b - a) * w;
    Some((mix(above.1, below.1), mix(above.2, below.2)))
}
