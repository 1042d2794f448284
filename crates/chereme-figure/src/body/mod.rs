//! The signer's body as a surface: the surfaces of its parts with their joints, assembled once per
//! skeleton.

mod features;
mod hand;
mod head;
pub(crate) mod shape;

use std::ops::Range;

use chereme_motion::{Anatomy, Face, ModelPose, Side, Skeleton, anatomy::Part};
use glam::{Mat3, Vec3};

use crate::mesh::Mesh;
use crate::palette::Palette;
use head::Head;
use shape::{Assembly, Element, Loft, Paint, Point, Rod, Section, place, rotation};

/// A signer's body, built once for a skeleton and moved to any posture of it.
///
/// Limbs are rods between the joints, the torso a rounded slab from hips to shoulders, hands have
/// palms, fingers and nails, the head a face. Parts that the anatomy lacks are left out; a hand
/// without fingers is a mitten; a skeleton without arms is drawn bone by bone.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    template: Mesh,
    elements: Vec<Element>,
    face: Option<Expressive>,
}

/// A head with a movable face.
#[derive(Debug, Clone, PartialEq)]
struct Expressive {
    joint: usize,
    head: Head,
    palette: Palette,
    vertices: Range<usize>,
}

/// Numbers of the parts between which lines are drawn; 0 is the paper.
pub mod group {
    use chereme_motion::Side;

    /// Torso, shoulders and neck.
    pub const TORSO: u8 = 1;
    /// The head.
    pub const HEAD: u8 = 2;
    /// Legs, and the bones of a skeleton that is not a body.
    pub const REST: u8 = 3;

    /// Numbers from here on are marks in space, such as a grid or a trail, without light and lines.
    pub const FLAT: u8 = 128;

    /// Returns the number of an arm.
    #[must_use]
    pub const fn arm(side: Side) -> u8 {
        side_base(side)
    }

    /// Returns the number of a palm.
    #[must_use]
    pub const fn palm(side: Side) -> u8 {
        side_base(side) + 1
    }

    /// Returns the number of a finger: 0 the thumb, 1 the index, to 4 the little finger.
    #[must_use]
    pub const fn digit(side: Side, number: usize) -> u8 {
        side_base(side) + 2 + number as u8
    }

    const fn side_base(side: Side) -> u8 {
        match side {
            Side::Right => 10,
            Side::Left => 20,
        }
    }
}

/// The arm's length from shoulder to wrist for which the measures below are defined, in metres.
const ARM: f32 = 0.53;

impl Body {
    /// Returns the body of `skeleton` in the usual colours.
    #[must_use]
    pub fn new(skeleton: &Skeleton, anatomy: &Anatomy) -> Self {
        Self::with_palette(skeleton, anatomy, &Palette::default())
    }

    /// Returns the body of `skeleton` in the given colours.
    #[must_use]
    pub fn with_palette(skeleton: &Skeleton, anatomy: &Anatomy, palette: &Palette) -> Self {
        let rest = skeleton.rest_model_pose();
        let mut builder = Builder {
            skeleton,
            anatomy,
            palette,
            rest: &rest,
            size: body_size(anatomy),
            face: None,
            out: Assembly::default(),
        };
        if Side::BOTH.iter().any(|&side| anatomy.arm(side).is_some()) {
            builder.signer();
        } else {
            builder.bones();
        }
        Body {
            face: builder.face,
            ..builder.out.into_body(&rest)
        }
    }

    /// Returns only both hands, without arms; empty if there are no wrists.
    #[must_use]
    pub fn hands(skeleton: &Skeleton, anatomy: &Anatomy, palette: &Palette) -> Self {
        let rest = skeleton.rest_model_pose();
        let mut out = Assembly::default();
        for side in Side::BOTH {
            if let Some(joints) = hand::HandJoints::of(anatomy, side) {
                let colours = colours(palette, side);
                hand::add(&mut out, (skeleton, anatomy), &rest, &joints, colours);
            }
        }
        out.into_body(&rest)
    }

    /// Returns only the hand of `side`, without the forearm; empty if there is no wrist.
    #[must_use]
    pub fn hand(skeleton: &Skeleton, anatomy: &Anatomy, side: Side, palette: &Palette) -> Self {
        let rest = skeleton.rest_model_pose();
        let mut out = Assembly::default();
        if let Some(joints) = hand::HandJoints::of(anatomy, side) {
            let colours = colours(palette, side);
            hand::add(&mut out, (skeleton, anatomy), &rest, &joints, colours);
        }
        out.into_body(&rest)
    }

    /// Returns the surface in `pose`, a posture of the body's skeleton.
    ///
    /// # Panics
    /// If `pose` has fewer joints than that skeleton.
    #[must_use]
    pub fn mesh(&self, pose: &ModelPose) -> Mesh {
        let mut mesh = self.template.clone();
        self.shape(pose, &mut mesh);
        mesh
    }

    /// Moves a `mesh` from [`mesh`](Self::mesh) of this body to `pose` without allocating a new one;
    /// triangles, colours and groups stay.
    ///
    /// # Panics
    /// If `mesh` is smaller than this body's or `pose` has fewer joints.
    pub fn shape(&self, pose: &ModelPose, mesh: &mut Mesh) {
        if mesh.vertices.len() != self.template.vertices.len() {
            mesh.clone_from(&self.template);
        }
        for element in &self.elements {
            element.pose(pose, mesh);
        }
    }

    /// Applies a facial expression to `mesh`, which [`shape`](Self::shape) moved to `pose`; a body without
    /// a head is unchanged. The next `shape` puts the face at rest again.
    ///
    /// # Panics
    /// The same as [`shape`](Self::shape)'s.
    pub fn express(&self, pose: &ModelPose, face: &Face, mesh: &mut Mesh) {
        let Some(known) = &self.face else { return };
        let local = known.head.mesh(&known.palette, face);
        let (at, turn) = (place(pose, known.joint), rotation(pose, known.joint));
        let out = &mut mesh.vertices[known.vertices.clone()];
        for (vertex, own) in out.iter_mut().zip(local.vertices) {
            vertex.position = at + turn * own.position;
            vertex.normal = turn * own.normal;
        }
    }
}

impl Assembly {
    fn into_body(mut self, rest: &ModelPose) -> Body {
        for element in &self.elements {
            element.pose(rest, &mut self.mesh);
        }
        Body {
            template: self.mesh,
            elements: self.elements,
            face: None,
        }
    }
}

/// Returns the size of the body relative to an adult's, by its arms.
fn body_size(anatomy: &Anatomy) -> f32 {
    let arm = anatomy
        .measures()
        .map_or(0.0, |measures| measures.arm as f32);
    if arm > 1e-6 { arm / ARM } else { 1.0 }
}

fn colours(palette: &Palette, side: Side) -> crate::palette::HandColours {
    match side {
        Side::Right => palette.right,
        Side::Left => palette.left,
    }
}

/// Points of a trunk without joints, below the middle of the shoulders.
struct Hang {
    joint: usize,
    at: Vec3,
    turn: glam::Quat,
    from: Vec3,
    up: Vec3,
}

impl Hang {
    /// Returns the point `down` metres below the shoulders.
    fn below(&self, down: f32) -> Point {
        Point {
            joint: self.joint,
            local: self.turn * (self.from - self.up * down - self.at),
        }
    }
}

struct Builder<'a> {
    skeleton: &'a Skeleton,
    anatomy: &'a Anatomy,
    palette: &'a Palette,
    rest: &'a ModelPose,
    size: f32,
    face: Option<Expressive>,
    out: Assembly,
}

impl Builder<'_> {
    fn joint(&self, part: Part) -> Option<usize> {
        self.anatomy.joint(part)
    }

    fn signer(&mut self) {
        self.torso();
        self.head();
        for side in Side::BOTH {
            self.leg(side);
            self.arm(side);
            if let Some(joints) = hand::HandJoints::of(self.anatomy, side) {
                let colours = colours(self.palette, side);
                let known = (self.skeleton, self.anatomy);
                hand::add(&mut self.out, known, self.rest, &joints, colours);
            }
        }
    }

    /// Adds a rod between two joints; radii are an adult's.
    fn limb(&mut self, from: usize, to: usize, radii: [f32; 3], paint: Paint) {
        let bone =
            rotation(self.rest, from).inverse() * (place(self.rest, to) - place(self.rest, from));
        let rod = Rod {
            ends: [Point::at(from), Point::at(to)],
            radii: radii.map(|radius| radius * self.size),
            facing: (from, bone.normalize_or(Vec3::X).any_orthonormal_vector()),
            columns: 20,
        };
        self.out.rod(rod, paint);
    }

    fn arm(&mut self, side: Side) {
        let parts = [Part::UpperArm(side), Part::Forearm(side), Part::Hand(side)];
        let paint = Paint::plain(self.palette.sleeves, group::arm(side));
        let [Some(upper), Some(forearm), Some(hand)] = parts.map(|part| self.joint(part)) else {
            return;
        };
        self.limb(upper, forearm, [0.058, 0.050, 0.043], paint);
        self.limb(forearm, hand, [0.043, 0.038, 0.026], paint);
    }

    fn leg(&mut self, side: Side) {
        let paint = Paint::plain(self.palette.legs, group::REST);
        let parts = [
            Part::Thigh(side),
            Part::Shin(side),
            Part::Foot(side),
            Part::Toes(side),
        ];
        let radii = [
            [0.085, 0.075, 0.055],
            [0.055, 0.052, 0.038],
            [0.038, 0.035, 0.030],
        ];
        for (pair, radii) in parts.windows(2).zip(radii) {
            if let (Some(from), Some(to)) = (self.joint(pair[0]), self.joint(pair[1])) {
                self.limb(from, to, radii, paint);
            }
        }
    }

    fn torso(&mut self) {
        let paint = Paint::plain(self.palette.torso, group::TORSO);
        let upper = Side::BOTH.map(|side| self.joint(Part::UpperArm(side)));
        let [Some(right), Some(left)] = upper else {
            return;
        };
        let size = self.size;
        let hang = self.hang(right, left);
        let top = self.joint(Part::Neck).or(self.joint(Part::Head));
        let neck = top.map_or_else(|| hang.below(-0.09 * size), Point::at);
        let hips = self
            .joint(Part::Hips)
            .filter(|&hips| place(self.rest, hips).distance(hang.from) > 0.25 * size);
        let middle = match (hips, top) {
            (Some(hips), Some(top)) => Point::at(self.spine_middle(hips, top)),
            (Some(hips), None) => {
                let far = place(self.rest, hips).distance(hang.from);
                hang.below(far * 0.5)
            }
            (None, _) => hang.below(0.25 * size),
        };
        let section = |middle: &[(Point, f32)], half: f32, measures: [f32; 4]| {
            let [beyond, front, back, shift] = measures.map(|measure| measure * size);
            let point = |sign: f32| {
                let mut mix: Vec<(Point, f32)> = middle.to_vec();
                mix.push((Point::at(left), sign * half));
                mix.push((Point::at(right), -sign * half));
                mix
            };
            Section {
                spine: vec![point(-1.0), point(0.0), point(1.0)],
                beyond,
                thickness: [front, back],
                shift,
            }
        };
        let thighs = Side::BOTH.map(|side| self.joint(Part::Thigh(side)));
        let seat = match thighs {
            [Some(r), Some(l)] => vec![(Point::at(r), 0.5), (Point::at(l), 0.5)],
            _ => vec![(hips.map_or_else(|| hang.below(0.5 * size), Point::at), 1.0)],
        };
        let between = |share: f32| {
            vec![
                (middle, 1.0 - share),
                (Point::at(left), share / 2.0),
                (Point::at(right), share / 2.0),
            ]
        };
        let sections = vec![
            section(&seat, 0.26, [0.050, 0.080, 0.085, -0.075]),
            section(&seat, 0.32, [0.070, 0.110, 0.115, 0.0]),
            section(&seat, 0.29, [0.070, 0.110, 0.110, 0.09]),
            section(&between(0.0), 0.26, [0.055, 0.105, 0.095, 0.0]),
            section(&between(0.5), 0.33, [0.050, 0.115, 0.105, 0.0]),
            section(&between(0.85), 0.38, [0.030, 0.100, 0.098, 0.0]),
            section(&between(1.0), 0.34, [0.020, 0.068, 0.078, 0.03]),
            section(
                &[(Point::at(left), 0.3), (Point::at(right), 0.3), (neck, 0.4)],
                0.18,
                [0.045, 0.048, 0.06, 0.025],
            ),
        ];
        self.out.loft(
            Loft {
                sections,
                columns: 32,
                roundness: 0.8,
            },
            paint,
        );
        for shoulder in [left, right] {
            let rod = Rod {
                ends: [Point::at(shoulder), neck],
                radii: [0.046 * size, 0.050 * size, 0.040 * size],
                facing: (shoulder, Vec3::Z),
                columns: 20,
            };
            self.out.rod(rod, paint);
        }
    }

    /// Returns the point that the trunk hangs on if joints of it are missing: the joint that carries both
    /// arms.
    fn hang(&self, right: usize, left: usize) -> Hang {
        let above: Vec<usize> = self.skeleton.ancestors(right).collect();
        let shared = self.skeleton.ancestors(left).find(|it| above.contains(it));
        let joint = self.joint(Part::Chest).or(shared).unwrap_or(0);
        let up = self.anatomy.body_frame(self.rest);
        let up = up.map_or(Vec3::Y, |frame| frame.up.as_vec3());
        Hang {
            joint,
            at: place(self.rest, joint),
            turn: rotation(self.rest, joint).inverse(),
            from: (place(self.rest, right) + place(self.rest, left)) * 0.5,
            up,
        }
    }

    /// Returns the joint of the spine nearest the middle between hips and neck at rest.
    fn spine_middle(&self, hips: usize, neck: usize) -> usize {
        let target = (place(self.rest, hips) + place(self.rest, neck)) * 0.5;
        let distance = |joint: usize| place(self.rest, joint).distance_squared(target);
        let chain = self.skeleton.ancestors(neck).skip(1);
        chain
            .take_while(|&joint| joint != hips)
            .min_by(|&a, &b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(hips)
    }

    fn head(&mut self) {
        let Some(joint) = self.joint(Part::Head) else {
            return;
        };
        if let Some(neck) = self.joint(Part::Neck) {
            let paint = Paint::plain(self.palette.face.scaled(0.9), group::HEAD);
            self.limb(neck, joint, [0.050, 0.047, 0.046], paint);
        }
        let axes = self.anatomy.head_axes(self.rest);
        let (Some(axes), Some(measures)) = (axes, self.anatomy.measures()) else {
            return;
        };
        let axes = Mat3::from_cols_array_2d(&axes.map(|axis| axis.as_vec3().to_array()));
        let height = measures.head as f32;
        let top = self.anatomy.landmark(self.skeleton, self.rest, "head-top");
        let up = axes.y_axis;
        let top = top.map_or_else(
            || up * (measures.head_top as f32),
            |top| top.as_vec3() - place(self.rest, joint),
        );
        let turn = rotation(self.rest, joint).inverse();
        let head = Head {
            centre: turn * (top - up * height * 0.5),
            height,
            axes: Mat3::from_quat(turn) * axes,
        };
        let start = self.out.mesh.vertices.len();
        self.out
            .rigid(joint, &head.mesh(self.palette, &Face::default()));
        self.face = Some(Expressive {
            joint,
            head,
            palette: *self.palette,
            vertices: start..self.out.mesh.vertices.len(),
        });
    }

    /// Adds every bone of a skeleton that is not a known body.
    fn bones(&mut self) {
        let paint = Paint::plain(self.palette.face, group::REST);
        let places: Vec<Vec3> = (0..self.skeleton.len())
            .map(|j| place(self.rest, j))
            .collect();
        let box_ = places
            .iter()
            .fold((places[0], places[0]), |(low, high), &at| {
                (low.min(at), high.max(at))
            });
        let thick = (box_.1 - box_.0).length().max(0.1) * 0.03;
        let rod = |ends: [Point; 2], length: f32| {
            let radius = (length * 0.14).clamp(thick * 0.15, thick);
            Rod {
                ends,
                radii: [radius, radius * 0.85, radius * 0.7],
                facing: (ends[0].joint, Vec3::Z),
                columns: 12,
            }
        };
        for (index, joint) in self.skeleton.joints().iter().enumerate() {
            if let Some(parent) = joint.parent {
                let ends = [Point::at(parent), Point::at(index)];
                self.out.rod(rod(ends, joint.offset.length() as f32), paint);
            }
            if let Some(tip) = joint.tip {
                let local = tip.as_vec3();
                let end = Point {
                    joint: index,
                    local,
                };
                self.out
                    .rod(rod([Point::at(index), end], local.length()), paint);
            }
            if self.skeleton.len() == 1 && joint.tip.is_none() {
                let ends = [Point::at(0), Point::at(0)];
                self.out.rod(rod(ends, 0.1), paint);
            }
        }
    }
}
