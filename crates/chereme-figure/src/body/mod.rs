//! The signer's body as a surface: the surfaces of its parts with their joints, assembled once per
//! skeleton.

mod body_builder;
mod body_contact;
mod body_face;
mod body_hand;
mod body_head;
pub(crate) mod body_shape;
mod clothed;
mod delaunay;
mod extras;
mod features;
mod glove;
pub mod portable;
mod rods;
mod skin;
pub mod skinned_figure;
mod solids;
mod trunk;
mod weights;

use std::ops::Range;

use chereme_motion::{BodyAnatomy, BodySide, FacePosture, ModelPose, Skeleton};
use glam::Vec3;

use crate::mesh::{TriangleMesh, smooth_vertex_normals};
use crate::palette::FigurePalette;
use body_builder::BodyBuilder;
use body_contact::HandContactShade;
use body_head::HeadPlacement;
use body_shape::{BodyElement, posed_joint_position, posed_joint_rotation};
use skin::{BoundSkinVertex, SkinRig};
use trunk::TrunkRig;

/// A signer's body, built once for a skeleton and moved to any posture of it.
///
/// Trunk, arms and hands are one skin whose vertices follow several joints, in clothes that leave head and hands free;
/// the head has a face. A hand without finger joints has a relaxed posture. Parts that the anatomy lacks are left out
/// or plain; a skeleton without arms is drawn bone by bone.
#[derive(Debug, Clone, PartialEq)]
pub struct SignerBody {
    template: TriangleMesh,
    elements: Vec<BodyElement>,
    skin: Option<BodySkin>,
    face: Option<ExpressiveHead>,
    contact: HandContactShade,
}

/// A skin and its vertices in the body's mesh.
#[derive(Debug, Clone, PartialEq)]
struct BodySkin {
    rig: SkinRig,
    bound: Vec<BoundSkinVertex>,
    vertices: Range<usize>,
    triangles: Range<usize>,
}

impl BodySkin {
    fn pose_body_skin(&self, pose: &ModelPose, mesh: &mut TriangleMesh) {
        let motions = self.rig.follower_matrices(pose);
        let out = &mut mesh.vertices[self.vertices.clone()];
        for (vertex, bound) in out.iter_mut().zip(&self.bound) {
            let mut blended_place = Vec3::ZERO;
            for (&follower, &weight) in bound.followers.iter().zip(&bound.weights) {
                if weight > 0.0 {
                    let (turn, offset) = &motions[usize::from(follower)];
                    blended_place += (*turn * bound.at + *offset) * weight;
                }
            }
            vertex.position = blended_place;
        }
        // Normals are recomputed from the posed triangles: turned ones look inflated at bends.
        let base = self.vertices.start as u32;
        smooth_vertex_normals(out, &mesh.triangles[self.triangles.clone()], base);
    }
}

/// A head with a movable face.
#[derive(Debug, Clone, PartialEq)]
struct ExpressiveHead {
    joint: usize,
    head: HeadPlacement,
    palette: FigurePalette,
    vertices: Range<usize>,
}

/// Indices of the parts between which lines are drawn; 0 is the paper.
pub mod group {
    use chereme_motion::BodySide;

    /// Torso, shoulders and neck.
    pub const TORSO_GROUP: u8 = 1;
    /// The head.
    pub const HEAD_GROUP: u8 = 2;
    /// Legs, and the bones of a skeleton that is not a body.
    pub const REMAINING_BODY_GROUP: u8 = 3;
    /// Hair.
    pub const HAIR_GROUP: u8 = 4;

    /// The first index of marks in space, such as a grid or a trail, which have no light and no lines.
    pub const FIRST_FLAT_GROUP: u8 = 128;

    /// Returns the number of an arm.
    #[must_use]
    pub const fn arm_group(side: BodySide) -> u8 {
        side_base(side)
    }

    /// Returns the number of a palm.
    #[must_use]
    pub const fn palm_group(side: BodySide) -> u8 {
        side_base(side) + 1
    }

    /// Returns the number of a finger: 0 the thumb, 1 the index, to 4 the little finger.
    #[must_use]
    pub const fn digit_group(side: BodySide, number: usize) -> u8 {
        side_base(side) + 2 + number as u8
    }

    const fn side_base(side: BodySide) -> u8 {
        match side {
            BodySide::Right => 10,
            BodySide::Left => 20,
        }
    }
}

impl SignerBody {
    /// Returns the body of `skeleton` in the default colours.
    #[must_use]
    pub fn new(skeleton: &Skeleton, anatomy: &BodyAnatomy) -> Self {
        Self::with_palette(skeleton, anatomy, &FigurePalette::default())
    }

    /// Returns the body of `skeleton` in the given colours.
    #[must_use]
    pub fn with_palette(skeleton: &Skeleton, anatomy: &BodyAnatomy, palette: &FigurePalette) -> Self {
        let rest = anatomy.bind_pose(skeleton);
        let mut builder = BodyBuilder::new(skeleton, anatomy, palette, &rest);
        // One arm is enough for a signer; without any it is drawn bone by bone.
        if BodySide::BOTH_SIDES
            .iter()
            .any(|&side| anatomy.arm_chain(side).is_some())
        {
            builder.add_whole_signer();
        } else {
            builder.add_bone_rods();
        }
        builder.finish_body()
    }

    /// Returns only both hands, without arms; empty if there are no wrists.
    #[must_use]
    pub fn with_both_hands(skeleton: &Skeleton, anatomy: &BodyAnatomy, palette: &FigurePalette) -> Self {
        Self::of_hands(skeleton, anatomy, &BodySide::BOTH_SIDES, palette)
    }

    /// Returns only the hand of `side`, without the forearm; empty if there is no wrist.
    #[must_use]
    pub fn with_single_hand(
        skeleton: &Skeleton,
        anatomy: &BodyAnatomy,
        side: BodySide,
        palette: &FigurePalette,
    ) -> Self {
        Self::of_hands(skeleton, anatomy, &[side], palette)
    }

    fn of_hands(skeleton: &Skeleton, anatomy: &BodyAnatomy, sides: &[BodySide], palette: &FigurePalette) -> Self {
        let rest = anatomy.bind_pose(skeleton);
        let mut builder = BodyBuilder::new(skeleton, anatomy, palette, &rest);
        for &side in sides {
            builder.add_lone_hand(side);
        }
        builder.finish_body()
    }

    /// Returns the surface in `pose`, a posture of the body's skeleton.
    ///
    /// # Panics
    /// If `pose` has fewer joints than that skeleton.
    #[must_use]
    pub fn posed_mesh(&self, pose: &ModelPose) -> TriangleMesh {
        let mut mesh = self.template.clone();
        self.shape_body_mesh(pose, &mut mesh);
        mesh
    }

    /// Moves a `mesh` from [`mesh`](Self::posed_mesh) of this body to `pose` without allocating a new one;
    /// triangles, colours and groups stay.
    ///
    /// # Panics
    /// If `mesh` is smaller than this body's or `pose` has fewer joints.
    pub fn shape_body_mesh(&self, pose: &ModelPose, mesh: &mut TriangleMesh) {
        // A mesh of another body is replaced as a whole.
        if mesh.vertices.len() != self.template.vertices.len() {
            mesh.clone_from(&self.template);
        }
        self.pose_body_elements(pose, mesh);
        self.contact.shade_contact_vertices(pose, &self.template, mesh);
    }

    fn pose_body_elements(&self, pose: &ModelPose, mesh: &mut TriangleMesh) {
        for element in &self.elements {
            element.pose_body_element(pose, mesh);
        }
        if let Some(skin) = &self.skin {
            skin.pose_body_skin(pose, mesh);
        }
    }

    /// Applies a facial expression to `mesh`, which [`shape_body_mesh`](Self::shape_body_mesh) moved to `pose`; a body without a head is
    /// unchanged. The next `shape_body_mesh` resets the face to rest.
    ///
    /// # Panics
    /// The same as [`shape_body_mesh`](Self::shape_body_mesh)'s.
    pub fn apply_face_expression(&self, pose: &ModelPose, face: &FacePosture, mesh: &mut TriangleMesh) {
        let Some(known) = &self.face else { return };
        let local = known.head.head_mesh(&known.palette, face);
        let (at, turn) = (
            posed_joint_position(pose, known.joint),
            posed_joint_rotation(pose, known.joint),
        );
        let out = &mut mesh.vertices[known.vertices.clone()];
        for (vertex, own) in out.iter_mut().zip(local.vertices) {
            vertex.position = at + turn * own.position;
            vertex.normal = turn * own.normal;
        }
    }
}
