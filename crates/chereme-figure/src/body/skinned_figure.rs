//! A body as a skin over the joints of its own skeleton, for files in which other programs move it.
//!
//! Its bones hang below joints; those that no joint moves alone, such as the steps of twist along a forearm, have places of
//! their own in each posture. The knuckles' added thickness at bends is left out, because no bone can have it.

use chereme_motion::{BodyAnatomy, BodyPart, BodySide, FacePosture, ModelPose, Skeleton};
use glam::{Quat, Vec3};

use super::body_shape::{posed_joint_position, posed_joint_rotation};
use super::portable::{FaceMorph, head_face_morphs, moved_point};
use super::skin::{FollowerMotion, SkinFollower, SkinRig};
use super::{BodySkin, SignerBody, TrunkRig};
use crate::mesh::{MeshVertex, smooth_vertex_normals};

/// A skin whose vertices follow bones that hang below the joints of a skeleton.
#[derive(Debug, Clone, PartialEq)]
pub struct SkinnedFigure {
    /// The vertices in model space, in metres, as the body is bound: upright, with its pelvis where the skeleton rests.
    pub vertices: Vec<MeshVertex>,
    /// The corners of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The bones of each vertex.
    pub bones_of_vertices: Vec<[u16; 4]>,
    /// The weights of these bones, whose sum is 1.
    pub weights: Vec<[f32; 4]>,
    /// The bones.
    pub bones: Vec<FigureBone>,
    /// The changes of the face in the bound pose.
    pub morphs: Vec<FaceMorph>,
}

/// A bone of a skinned figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FigureBone {
    /// The joint of the skeleton below which it hangs.
    pub joint: usize,
    /// Its position as the body is bound; it is not rotated there.
    pub bind: Vec3,
    /// The follower that moves it and its position in the follower's space; else it rotates with its joint.
    follower: Option<(usize, Vec3)>,
    /// The rotation from the bound body to the space of the follower or joint.
    turn: Quat,
}

/// Where a bone is in a posture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BonePlacement {
    /// The rotation of what is bound to it.
    pub turn: Quat,
    /// Its position in model space, in metres.
    pub place: Vec3,
}

impl SignerBody {
    /// Returns the body as a skin over its skeleton; `None` unless it has a trunk and two arms of one skin.
    #[must_use]
    pub fn to_skinned_figure(&self, skeleton: &Skeleton, anatomy: &BodyAnatomy) -> Option<SkinnedFigure> {
        let skin = self.skin.as_ref()?;
        skin.rig.trunk.as_ref()?;
        let rest = anatomy.bind_pose(skeleton);
        let moved = skin.rig.follower_motions(&rest);
        let is_pelvis = |follower: &SkinFollower| matches!(follower, SkinFollower::Pelvis);
        let pelvis = moved[skin.rig.followers.iter().position(is_pelvis)?];
        let mut out = SkinnedFigure {
            vertices: self.posed_mesh(&rest).vertices,
            triangles: self.template.triangles.clone(),
            bones_of_vertices: vec![[0; 4]; self.template.vertices.len()],
            weights: vec![[1.0, 0.0, 0.0, 0.0]; self.template.vertices.len()],
            bones: follower_bones(&skin.rig, anatomy),
            morphs: Vec::new(),
        };
        for bone in &mut out.bones {
            (bone.bind, bone.turn) = (moved_point(&pelvis, bone.bind), pelvis.turn.inverse());
        }
        for (vertex, known) in out.vertices.iter_mut().zip(&self.template.vertices) {
            // Hands that rest at the trunk would shade it for good.
            vertex.colour = known.colour;
        }
        for element in &self.elements {
            let joint = element.carrying_joint()?;
            let turn = posed_joint_rotation(&rest, joint);
            for vertex in element.element_vertex_range() {
                out.bones_of_vertices[vertex][0] = out.bones.len() as u16;
            }
            if let Some(face) = &self.face
                && face.vertices.start == element.element_vertex_range().start
            {
                out.morphs = head_face_morphs(&face.head, &face.palette, face.vertices.start);
                let offsets = out.morphs.iter_mut().flat_map(|morph| &mut morph.offsets);
                offsets.for_each(|offset| *offset = turn * *offset);
            }
            out.bones.push(FigureBone {
                joint,
                bind: posed_joint_position(&rest, joint),
                follower: None,
                turn: turn.inverse(),
            });
        }
        bind_skin_vertices(skin, &pelvis, &mut out);
        Some(out)
    }

    /// Returns where the bones of `figure`, made by [`to_skinned_figure`](Self::to_skinned_figure), are in `pose`.
    ///
    /// # Panics
    /// If `pose` has fewer joints than the body's skeleton.
    #[must_use]
    pub fn bone_placements(&self, figure: &SkinnedFigure, pose: &ModelPose) -> Vec<BonePlacement> {
        let moved = self.skin.as_ref().map(|skin| skin.rig.follower_motions(pose));
        let placement = |bone: &FigureBone| match bone.follower.zip(moved.as_ref()) {
            Some(((follower, place), moved)) => BonePlacement {
                turn: (moved[follower].turn * bone.turn).normalize(),
                place: moved_point(&moved[follower], place),
            },
            None => BonePlacement {
                turn: (posed_joint_rotation(pose, bone.joint) * bone.turn).normalize(),
                place: posed_joint_position(pose, bone.joint),
            },
        };
        figure.bones.iter().map(placement).collect()
    }
}

fn bind_skin_vertices(skin: &BodySkin, pelvis: &FollowerMotion, out: &mut SkinnedFigure) {
    for (vertex, bound) in skin.vertices.clone().zip(&skin.bound) {
        out.vertices[vertex].position = moved_point(pelvis, bound.at);
        out.bones_of_vertices[vertex] = bound.followers;
        out.weights[vertex] = bound.weights;
    }
    let triangles = &out.triangles[skin.triangles.clone()];
    let vertices = &mut out.vertices[skin.vertices.clone()];
    smooth_vertex_normals(vertices, triangles, skin.vertices.start as u32);
}

/// Returns a bone for each follower, below the joint that moves with it most nearly.
fn follower_bones(rig: &SkinRig, anatomy: &BodyAnatomy) -> Vec<FigureBone> {
    let mut bones: Vec<FigureBone> = Vec::with_capacity(rig.followers.len());
    for (index, follower) in rig.followers.iter().enumerate() {
        let limb = |side: usize, part: fn(BodySide) -> BodyPart| part(BodySide::BOTH_SIDES[side]);
        let arm = |side: usize, at: usize| rig.arms[side].as_ref().map_or(Vec3::ZERO, |limb| limb.places[at]);
        let trunk = |place: fn(&TrunkRig) -> Vec3| rig.trunk.as_ref().map_or(Vec3::ZERO, place);
        let (part, bind) = match *follower {
            SkinFollower::Joint { joint, at, .. } => (Err(joint), at),
            SkinFollower::Same(other) => (
                Err(bones[other].joint),
                bones[other].follower.map_or(Vec3::ZERO, |known| known.1),
            ),
            SkinFollower::Half { parent, at, .. } => (Err(bones[parent].joint), at),
            SkinFollower::Pelvis => (Ok(BodyPart::Hips), trunk(TrunkRig::seat_place)),
            SkinFollower::Chest => (Ok(BodyPart::Chest), trunk(TrunkRig::chest_place)),
            SkinFollower::Shoulder(side) => (Ok(limb(side, BodyPart::Clavicle)), arm(side, 0)),
            SkinFollower::Upper(side, _) => (Ok(limb(side, BodyPart::UpperArm)), arm(side, 0)),
            SkinFollower::Fore(side, _) => (Ok(limb(side, BodyPart::Forearm)), arm(side, 1)),
            SkinFollower::Hand(side) => (Ok(limb(side, BodyPart::Hand)), arm(side, 2)),
        };
        let found = |part: BodyPart| anatomy.part_joint(part);
        let joint = match part {
            Ok(part) => [part, BodyPart::Chest, BodyPart::Spine, BodyPart::Hips]
                .into_iter()
                .find_map(found),
            Err(joint) => Some(joint),
        };
        bones.push(FigureBone {
            joint: joint.unwrap_or(0),
            bind,
            follower: Some((index, bind)),
            turn: Quat::IDENTITY,
        });
    }
    bones
}

impl FaceMorph {
    /// Returns the name of the change: that of its number, and `_back` for negative values.
    #[must_use]
    pub fn morph_name(&self) -> String {
        let end = if self.is_negative { "_back" } else { "" };
        format!("{}{end}", FacePosture::FACE_NUMBER_NAMES[self.number])
    }
}
