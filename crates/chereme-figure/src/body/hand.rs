//! A hand: a palm between wrist and knuckles, a thumb and fingers of rods, nails.

use chereme_motion::{Anatomy, Finger, ModelPose, Side, Skeleton, anatomy::Part};
use glam::{Quat, Vec3};

use super::group;
use super::shape::{Assembly, Loft, Paint, Point, Rod, Section, ellipsoid, place, rotation};
use crate::palette::{Colour, HandColours};

/// The joints of a hand: base, middle and end of each finger that the skeleton has.
#[derive(Debug, Clone)]
pub(super) struct HandJoints {
    side: Side,
    wrist: usize,
    thumb: Vec<usize>,
    /// The fingers found, from the thumb's side outwards, each with its joints from the base on.
    fingers: Vec<(Finger, Vec<usize>)>,
}

impl HandJoints {
    /// Returns the hand of `side`; `None` if there is no wrist.
    pub(super) fn of(anatomy: &Anatomy, side: Side) -> Option<Self> {
        let chain = |parts: Vec<Part>| -> Vec<usize> {
            parts
                .into_iter()
                .map_while(|part| anatomy.joint(part))
                .collect()
        };
        let fingers = Finger::ALL
            .into_iter()
            .map(|f| (f, chain((1..4).map(|n| Part::Finger(side, f, n)).collect())))
            .filter(|(_, joints)| !joints.is_empty());
        Some(Self {
            side,
            wrist: anatomy.joint(Part::Hand(side))?,
            thumb: chain((0..3).map(|n| Part::Thumb(side, n)).collect()),
            fingers: fingers.collect(),
        })
    }
}

/// The measures of a hand at rest, and its axes in model space.
struct Measures {
    /// Half the thickness of a finger at its base, in metres.
    radius: f32,
    along: Vec3,
    /// Towards the thumb's side.
    thumbward: Vec3,
    /// Out of the palm.
    palm: Vec3,
}

impl Measures {
    /// Returns the measures; `None` if knuckles and wrist do not span a palm.
    fn of(anatomy: &Anatomy, hand: &HandJoints, rest: &ModelPose) -> Option<Self> {
        let base = |joints: &[usize]| place(rest, joints[0]);
        let (first, last) = (hand.fingers.first()?, hand.fingers.last()?);
        let (first, last) = (base(&first.1), base(&last.1));
        let along = (first + last) * 0.5 - place(rest, hand.wrist);
        let gap = (first - last).length() / (hand.fingers.len().max(2) - 1) as f32;
        let length = along.length();
        let along = along.try_normalize()?;
        let across = first - last;
        let thumbward = (across - along * across.dot(along)).try_normalize()?;
        Some(Self {
            radius: (gap * 0.46).clamp(length * 0.075, length * 0.11),
            along,
            thumbward,
            palm: anatomy.palm_normal(hand.side, rest).map_or_else(
                || thumbward.cross(along) * -hand.side.sign() as f32,
                |palm| palm.as_vec3(),
            ),
        })
    }
}

/// Thickness of each finger relative to the index, from the thumb outwards.
const THICKNESS: [f32; 5] = [1.18, 1.0, 1.0, 0.96, 0.85];
/// Brightness of each finger relative to the others, so that neighbours differ.
const TINT: [f32; 5] = [1.0, 1.0, 0.93, 1.0, 0.93];
const WHITE: Colour = Colour::hex(0xFF_FF_FF);

/// Adds the hand; without fingers it is a mitten.
pub(super) fn add(
    body: &mut Assembly,
    (skeleton, anatomy): (&Skeleton, &Anatomy),
    rest: &ModelPose,
    hand: &HandJoints,
    colours: HandColours,
) {
    let measures = (hand.fingers.len() >= 2)
        .then(|| Measures::of(anatomy, hand, rest))
        .flatten();
    let Some(measures) = measures else {
        return mitten(body, skeleton, hand, colours);
    };
    palm(body, rest, hand, &measures, colours);
    let towards_palm = measures.palm;
    for (finger, joints) in &hand.fingers {
        let digit = Digit {
            number: finger.index() + 1,
            joints: joints.clone(),
            inner: towards_palm,
        };
        digit.add(body, skeleton, rest, &measures, (hand.side, colours));
    }
    let thumb = Digit {
        number: 0,
        joints: hand.thumb.iter().copied().skip(1).collect(),
        inner: (measures.palm * 0.8 - measures.thumbward * 0.6).normalize_or(measures.palm),
    };
    thumb.add(body, skeleton, rest, &measures, (hand.side, colours));
}

/// A finger, or the thumb without its metacarpal.
struct Digit {
    number: usize,
    joints: Vec<usize>,
    /// The direction of its inner side at rest, in model space.
    inner: Vec3,
}

impl Digit {
    fn add(
        &self,
        body: &mut Assembly,
        skeleton: &Skeleton,
        rest: &ModelPose,
        measures: &Measures,
        (side, colours): (Side, HandColours),
    ) {
        let radius = measures.radius * THICKNESS[self.number];
        let group = group::digit(side, self.number);
        let tint = TINT[self.number];
        for (index, &joint) in self.joints.iter().enumerate() {
            let last = index + 1 == self.joints.len();
            let start = Point::at(joint);
            let end = match self.joints.get(index + 1) {
                Some(&next) => Point::at(next),
                None => tip(skeleton, rest, joint, radius),
            };
            let bone = end.place(rest) - start.place(rest);
            let turn = rotation(rest, joint).inverse();
            let along = bone.normalize_or(measures.along);
            let inner = (self.inner - along * along.dot(self.inner)).normalize_or(self.inner);
            let steps = self.joints.len().max(3) as f32;
            let at = |i: usize| radius * (1.0 - 0.22 * (i as f32 / steps));
            let radii = [at(index), at(index) * 0.93, at(index + 1)];
            let light = if last { 0.22 } else { 0.0 };
            let paint = Paint {
                front: colours.palm.scaled(tint).mixed(WHITE, light),
                back: colours.back.scaled(tint).mixed(WHITE, light * 0.6),
                group,
            };
            let rod = Rod {
                ends: [start, end],
                radii,
                facing: (joint, turn * inner),
                columns: 16,
            };
            body.rod(rod, paint);
            if last {
                let nail = Nail {
                    end: end.local,
                    inner: turn * inner,
                    radius: radii[2],
                };
                body.rigid(joint, &nail.mesh(colours.nail, group));
            }
        }
    }
}

/// Returns the end of the bone of a last joint: its tip, an end joint below it, or straight on.
fn tip(skeleton: &Skeleton, rest: &ModelPose, joint: usize, radius: f32) -> Point {
    let local = skeleton.joint(joint).tip.map(|tip| tip.as_vec3());
    let child = || {
        let child = *skeleton.children(joint).first()?;
        Some(skeleton.joint(child).offset.as_vec3())
    };
    let onwards = || {
        let parent = skeleton.parent(joint)?;
        let bone = place(rest, joint) - place(rest, parent);
        Some(rotation(rest, joint).inverse() * bone * 0.8)
    };
    let reach = local
        .or_else(child)
        .filter(|reach| reach.length() > radius * 0.5)
        .or_else(onwards)
        .unwrap_or(Vec3::Y * radius * 3.0);
    let length = reach.length();
    let round = (length - radius * 0.75).max(length * 0.6);
    Point {
        joint,
        local: reach * (round / length.max(1e-9)),
    }
}

/// The nail on the outer side of a finger's end.
struct Nail {
    end: Vec3,
    inner: Vec3,
    radius: f32,
}

impl Nail {
    fn mesh(&self, colour: Colour, group: u8) -> crate::mesh::Mesh {
        let along = self.end.normalize_or(Vec3::Y);
        let side = along.cross(self.inner).normalize_or(Vec3::X);
        let turn = Quat::from_mat3(&glam::Mat3::from_cols(
            side,
            self.inner,
            side.cross(self.inner),
        ));
        let radius = self.radius;
        let centre = self.end + along * radius * 0.12 - self.inner * radius * 0.82;
        let radii = Vec3::new(0.66, 0.30, 0.85) * radius;
        ellipsoid(centre, radii, turn, [10, 6], |point| (point, colour), group)
    }
}

/// Adds the palm, the thumb's metacarpal, and the skin between the two.
fn palm(
    body: &mut Assembly,
    rest: &ModelPose,
    hand: &HandJoints,
    measures: &Measures,
    colours: HandColours,
) {
    let radius = measures.radius;
    let paint = Paint {
        front: colours.palm,
        back: colours.back,
        group: group::palm(hand.side),
    };
    let mut knuckles: Vec<Point> = hand.fingers.iter().map(|f| Point::at(f.1[0])).collect();
    let turn = rotation(rest, hand.wrist).inverse();
    let wrist = |thumbward: f32, along: f32| Point {
        joint: hand.wrist,
        local: turn * (measures.thumbward * thumbward + measures.along * along) * radius,
    };
    let mut roots: Vec<Point> = (0..knuckles.len())
        .map(|i| i as f32 / (knuckles.len() - 1) as f32 * 2.0 - 1.0)
        .map(|share| wrist(-share * 1.75, 0.0))
        .collect();
    if hand.side == Side::Right {
        knuckles.reverse();
        roots.reverse();
    }
    let section = |share: f32, beyond: f32, thickness: [f32; 2], shift: f32| Section {
        spine: roots
            .iter()
            .zip(&knuckles)
            .map(|(&root, &knuckle)| vec![(root, 1.0 - share), (knuckle, share)])
            .collect(),
        beyond: beyond * radius,
        thickness: thickness.map(|t| t * radius),
        shift: shift * radius,
    };
    body.loft(
        Loft {
            sections: vec![
                section(0.0, -0.1, [1.0, 0.9], -0.6),
                section(0.0, 0.35, [1.5, 1.25], 0.2),
                section(0.35, 0.75, [1.6, 1.25], 0.0),
                section(0.7, 0.95, [1.3, 1.1], 0.0),
                section(0.93, 0.85, [1.0, 1.0], 0.0),
                section(1.0, 0.45, [0.7, 0.75], 0.25),
            ],
            columns: 24,
            roundness: 0.62,
        },
        paint,
    );
    let [Some(&root), Some(&middle)] = [hand.thumb.first(), hand.thumb.get(1)] else {
        return;
    };
    let facing = (hand.wrist, turn * measures.palm);
    let metacarpal = Rod {
        ends: [Point::at(root), Point::at(middle)],
        radii: [1.55, 1.45, 1.33].map(|r| r * radius),
        facing,
        columns: 18,
    };
    body.rod(metacarpal, paint);
    let index = if hand.side == Side::Right {
        knuckles.len() - 1
    } else {
        0
    };
    let web = Rod {
        ends: [
            between(rest, root, place(rest, middle), 0.62),
            between(rest, hand.wrist, knuckles[index].place(rest), 0.6),
        ],
        radii: [1.15, 0.95, 1.0].map(|r| r * radius),
        facing,
        columns: 12,
    };
    body.rod(web, paint);
}

/// Returns the point at a share of the line from `joint` to `to` (in model space), fixed to `joint`.
fn between(rest: &ModelPose, joint: usize, to: Vec3, share: f32) -> Point {
    let bone = (to - place(rest, joint)) * share;
    Point {
        joint,
        local: rotation(rest, joint).inverse() * bone,
    }
}

/// Adds a hand without fingers: a round form in the forearm's direction.
fn mitten(body: &mut Assembly, skeleton: &Skeleton, hand: &HandJoints, colours: HandColours) {
    let joint = skeleton.joint(hand.wrist);
    let child = skeleton.children(hand.wrist).first();
    let forearm = joint.offset.as_vec3().length();
    let reach = child
        .map(|&child| skeleton.joint(child).offset.as_vec3())
        .or(joint.tip.map(|tip| tip.as_vec3()))
        .filter(|reach| reach.length() > forearm * 0.05)
        .unwrap_or_else(|| joint.rest.as_quat().inverse() * joint.offset.as_vec3());
    let size = forearm.max(0.05);
    let along = reach.normalize_or(Vec3::Y) * size * 0.52;
    let rod = Rod {
        ends: [
            Point::at(hand.wrist),
            Point {
                joint: hand.wrist,
                local: along,
            },
        ],
        radii: [size * 0.11, size * 0.19, size * 0.13],
        facing: (hand.wrist, along.any_orthonormal_vector()),
        columns: 16,
    };
    body.rod(
        rod,
        Paint::plain(
            colours.palm.mixed(colours.back, 0.4),
            group::palm(hand.side),
        ),
    );
}
