//! The signer's body as a surface: the surfaces of its parts with their joints, assembled once per
//! skeleton.

mod builder;
mod clothed;
mod contact;
mod delaunay;
mod extras;
mod face;
mod features;
mod glove;
mod hand;
mod head;
pub mod portable;
mod rods;
pub(crate) mod shape;
mod skin;
mod solids;
mod trunk;
mod weights;

use std::ops::Range;

use chereme_motion::{Anatomy, Face, ModelPose, Side, Skeleton};
use glam::Vec3;

use crate::mesh::{Mesh, smooth};
use crate::palette::Palette;
use builder::Builder;
use contact::Contact;
use head::Head;
use shape::{Element, place, rotation};
use skin::{Bound, Rig};

/// A signer's body, built once for a skeleton and moved to any posture of it.
///
/// Trunk, arms and hands are one skin whose vertices follow several joints, in clothes that leave head and hands free;
/// the head has a face. A hand without finger joints has a relaxed posture. Parts that the anatomy lacks are left out
/// or plain; a skeleton without arms is drawn bone by bone.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    template: Mesh,
    elements: Vec<Element>,
    skin: Option<Skin>,
    face: Option<Expressive>,
    contact: Contact,
}

/// A skin and its vertices in the body's mesh.
#[derive(Debug, Clone, PartialEq)]
struct Skin {
    rig: Rig,
    bound: Vec<Bound>,
    vertices: Range<usize>,
    triangles: Range<usize>,
}

impl Skin {
    fn pose(&self, pose: &ModelPose, mesh: &mut Mesh) {
        let motions = self.rig.motions(pose);
        let out = &mut mesh.vertices[self.vertices.clone()];
        for (vertex, bound) in out.iter_mut().zip(&self.bound) {
            let mut at = Vec3::ZERO;
            for (&follower, &weight) in bound.followers.iter().zip(&bound.weights) {
                if weight > 0.0 {
                    let (turn, offset) = &motions[usize::from(follower)];
                    at += (*turn * bound.at + *offset) * weight;
                }
            }
            vertex.position = at;
        }
        let base = self.vertices.start as u32;
        smooth(out, &mesh.triangles[self.triangles.clone()], base);
    }
}

/// A head with a movable face.
#[derive(Debug, Clone, PartialEq)]
struct Expressive {
    joint: usize,
    head: Head,
    palette: Palette,
    vertices: Range<usize>,
}

/// Indices of the parts between which lines are drawn; 0 is the paper.
pub mod group {
    use chereme_motion::Side;

    /// Torso, shoulders and neck.
    pub const TORSO: u8 = 1;
    /// The head.
    pub const HEAD: u8 = 2;
    /// Legs, and the bones of a skeleton that is not a body.
    pub const REST: u8 = 3;
    /// Hair.
    pub const HAIR: u8 = 4;

    /// The first index of marks in space, such as a grid or a trail, which have no light and no lines.
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

impl Body {
    /// Returns the body of `skeleton` in the default colours.
    #[must_use]
    pub fn new(skeleton: &Skeleton, anatomy: &Anatomy) -> Self {
        Self::with_palette(skeleton, anatomy, &Palette::default())
    }

    /// Returns the body of `skeleton` in the given colours.
    #[must_use]
    pub fn with_palette(skeleton: &Skeleton, anatomy: &Anatomy, palette: &Palette) -> Self {
        let rest = anatomy.bind_pose(skeleton);
        let mut builder = Builder::new(skeleton, anatomy, palette, &rest);
        if Side::BOTH.iter().any(|&side| anatomy.arm(side).is_some()) {
            builder.signer();
        } else {
            builder.bones();
        }
        builder.finish()
    }

    /// Returns only both hands, without arms; empty if there are no wrists.
    #[must_use]
    pub fn hands(skeleton: &Skeleton, anatomy: &Anatomy, palette: &Palette) -> Self {
        Self::of_hands(skeleton, anatomy, &Side::BOTH, palette)
    }

    /// Returns only the hand of `side`, without the forearm; empty if there is no wrist.
    #[must_use]
    pub fn hand(skeleton: &Skeleton, anatomy: &Anatomy, side: Side, palette: &Palette) -> Self {
        Self::of_hands(skeleton, anatomy, &[side], palette)
    }

    fn of_hands(skeleton: &Skeleton, anatomy: &Anatomy, sides: &[Side], palette: &Palette) -> Self {
        let rest = anatomy.bind_pose(skeleton);
        let mut builder = Builder::new(skeleton, anatomy, palette, &rest);
        for &side in sides {
            builder.hand(side);
        }
        builder.finish()
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
        self.pose(pose, mesh);
        self.contact.shade(pose, &self.template, mesh);
    }

    fn pose(&self, pose: &ModelPose, mesh: &mut Mesh) {
        for element in &self.elements {
            element.pose(pose, mesh);
        }
        if let Some(skin) = &self.skin {
            skin.pose(pose, mesh);
        }
    }

    /// Applies a facial expression to `mesh`, which [`shape`](Self::shape) moved to `pose`; a body without a head is
    /// unchanged. The next `shape` resets the face to rest.
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
