//! A body for players elsewhere: a surface in bind space, and the few rotations that move it.
//!
//! A player computes the bones in order, from the motions of the [`PortableBone::Keyed`] ones, and moves each vertex by the
//! weighted mean of its bones. The surface is that of [`SignerBody`] without legs, and with its face at rest; the
//! [`FaceMorph`]s move it to expressions.

use chereme_motion::{FacePosture, ModelPose, Skeleton};
use glam::{Quat, Vec3};

use super::body_head::HeadPlacement;
use super::body_shape::{posed_joint_position, posed_joint_rotation};
use super::skin::{FollowerMotion, SkinFollower, SkinRig, halfway_motion};
use super::{BodySkin, SignerBody, TrunkRig};
use crate::palette::{FigurePalette, RgbColour};

/// A surface whose vertices follow bones.
#[derive(Debug, Clone, PartialEq)]
pub struct PortableBody {
    /// The vertices, in the space of their bones.
    pub vertices: Vec<PortableVertex>,
    /// The corners of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The bones. A keyed one comes after its parent, which is keyed too; the others depend on keyed ones and on those
    /// before them.
    pub bones: Vec<PortableBone>,
    /// For each keyed bone, the source of its motion.
    sources: Vec<BoneMotionSource>,
    /// The first vertex of the head, whose vertices follow each other.
    first_head_vertex: Option<usize>,
}

/// The change of a portable body's face by one number of a [`FacePosture`], in proportion to it.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceMorph {
    /// The place of the number in [`FacePosture::FACE_NUMBER_NAMES`].
    pub number: usize,
    /// Whether it is the change for negative values: it is whole at -1 instead of 1.
    pub is_negative: bool,
    /// The vertices that move, in rising order.
    pub vertices: Vec<usize>,
    /// How far each of them moves in bind space, in metres.
    pub offsets: Vec<Vec3>,
}

impl FaceMorph {
    /// Returns the share of this change that a face has.
    #[must_use]
    pub fn morph_share(&self, face: &FacePosture) -> f64 {
        let value = face.face_numbers()[self.number];
        (if self.is_negative { -value } else { value }).clamp(0.0, 1.0)
    }
}

/// Shorter ways of a vertex are left out of a [`FaceMorph`], in metres.
const LEAST_MORPH_OFFSET_METRES: f32 = 2.5e-4;

/// A vertex of a portable body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PortableVertex {
    /// Its position in bind space, in metres.
    pub place: Vec3,
    /// Its colour before light falls on it.
    pub colour: RgbColour,
    /// Up to four bones that move it.
    pub bones: [u16; 4],
    /// The weights of these bones; their sum is 1.
    pub weights: [f32; 4],
}

/// Something that moves vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PortableBone {
    /// A bone whose motion each posture gives.
    Keyed {
        /// The bone to which the motion is relative.
        parent: Option<usize>,
        /// The point of bind space about which it rotates.
        from: Vec3,
        /// The point that the parent would move to the same position, in the parent's bind space.
        at: Vec3,
    },
    /// The same as another bone.
    Same(usize),
    /// A rotation between those of two bones about a shared point, by spherical interpolation.
    Between {
        /// The two bones.
        ends: [usize; 2],
        /// The share of the second one.
        share: f32,
    },
    /// A bone halfway between two about a point of bind space; it becomes thicker across a bend by up to `swell`.
    Half {
        /// The bone before the bend.
        parent: usize,
        /// The bone behind it.
        child: usize,
        /// The point of bind space.
        at: Vec3,
        /// The direction of the limb in bind space.
        along: Vec3,
        /// The largest added share of the thickness.
        swell: f32,
    },
}

/// The motion of a keyed bone in a posture, relative to its parent; without one, in model space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoneMotion {
    /// The rotation.
    pub turn: Quat,
    /// The distance of its point from where the parent alone would move it, in the parent's axes, in metres.
    pub off: Vec3,
}

/// The source of a keyed bone's motion.
#[derive(Debug, Clone, Copy, PartialEq)]
enum BoneMotionSource {
    Follower(usize),
    Joint(usize),
}

impl SignerBody {
    /// Returns the body for players elsewhere; `None` unless the skeleton has two arms.
    #[must_use]
    pub fn to_portable_body(&self, skeleton: &Skeleton) -> Option<PortableBody> {
        let skin = self.skin.as_ref()?;
        // Without a trunk it is a lone hand, which has no body to export.
        skin.rig.trunk.as_ref()?;
        let mut out = PortableBody {
            vertices: Vec::new(),
            triangles: Vec::new(),
            bones: Vec::new(),
            sources: Vec::new(),
            first_head_vertex: None,
        };
        for index in 0..skin.rig.followers.len() {
            let bone = follower_to_bone(&skin.rig, index, skeleton);
            if matches!(bone, PortableBone::Keyed { .. }) {
                out.sources.push(BoneMotionSource::Follower(index));
            }
            out.bones.push(bone);
        }
        let mut places: Vec<Option<u32>> = vec![None; self.template.vertices.len()];
        self.skin_vertices(skin, &mut places, &mut out);
        for element in &self.elements {
            let Some((joint, points)) = element.rigid_points() else {
                // Vertices of parts that are left out keep None, and their triangles are dropped.
                continue;
            };
            let parent_follower = skin
                // A rigid part rotates with the bone of its joint if that is exported.
                .rig
                .followers
                .iter()
                .position(|follower| matches!(follower, SkinFollower::Joint { joint: own, .. } if *own == joint));
            let joint_place = match parent_follower.map(|index| &skin.rig.followers[index]) {
                Some(SkinFollower::Joint { at, .. }) => *at,
                _ => Vec3::ZERO,
            };
            let bone_index = out.bones.len();
            out.bones.push(PortableBone::Keyed {
                parent: parent_follower,
                from: Vec3::ZERO,
                at: joint_place,
            });
            out.sources.push(BoneMotionSource::Joint(joint));
            let face = self.face.as_ref();
            if face.is_some_and(|face| face.vertices.start == element.element_vertex_range().start) {
                out.first_head_vertex = Some(out.vertices.len());
            }
            for (vertex, point) in element.element_vertex_range().zip(points) {
                places[vertex] = Some(out.vertices.len() as u32);
                out.vertices.push(PortableVertex {
                    place: *point,
                    colour: self.template.vertices[vertex].colour,
                    bones: [bone_index as u16, 0, 0, 0],
                    weights: [1.0, 0.0, 0.0, 0.0],
                });
            }
        }
        for triangle in &self.template.triangles {
            if let [Some(a), Some(b), Some(c)] = triangle.map(|corner| places[corner as usize]) {
                out.triangles.push([a, b, c]);
            }
        }
        Some(out)
    }

    fn skin_vertices(&self, skin: &BodySkin, places: &mut [Option<u32>], out: &mut PortableBody) {
        for (vertex, bound) in skin.vertices.clone().zip(&skin.bound) {
            places[vertex] = Some(out.vertices.len() as u32);
            out.vertices.push(PortableVertex {
                place: bound.at,
                colour: self.template.vertices[vertex].colour,
                bones: bound.followers,
                weights: bound.weights,
            });
        }
    }

    /// Returns the changes of the face of `portable`, made by [`portable`](Self::to_portable_body): the sum of their shares is
    /// close to an expression, and exact for one number at its end.
    #[must_use]
    pub fn face_morphs(&self, portable: &PortableBody) -> Vec<FaceMorph> {
        let (Some(known), Some(first_head_vertex)) = (&self.face, portable.first_head_vertex) else {
            return Vec::new();
        };
        head_face_morphs(&known.head, &known.palette, first_head_vertex)
    }

    /// Returns the motions of the keyed bones of `portable`, made by [`portable`](Self::to_portable_body), in `pose`.
    ///
    /// # Panics
    /// If `pose` has fewer joints than the body's skeleton.
    #[must_use]
    pub fn bone_motions(&self, portable: &PortableBody, pose: &ModelPose) -> Vec<BoneMotion> {
        let Some(skin) = &self.skin else {
            return Vec::new();
        };
        let moved = skin.rig.follower_motions(pose);
        let source_motion = |source: &BoneMotionSource| match *source {
            BoneMotionSource::Follower(index) => moved[index],
            BoneMotionSource::Joint(joint) => FollowerMotion::new(
                posed_joint_rotation(pose, joint),
                Vec3::ZERO,
                posed_joint_position(pose, joint),
            ),
        };
        let keyed = portable.bones.iter().filter_map(|bone| match bone {
            PortableBone::Keyed { parent, from, at } => Some((*parent, *from, *at)),
            _ => None,
        });
        keyed
            .zip(&portable.sources)
            .map(|((parent, from, at), source)| {
                // Points are moved without the stretch, which only thickens and is no position.
                let motion = source_motion(source);
                let to = moved_point(&motion, from);
                let Some(parent) = parent.map(|parent_index| moved[parent_index]) else {
                    return BoneMotion {
                        turn: motion.turn.normalize(),
                        off: to,
                    };
                };
                let back = parent.turn.inverse();
                BoneMotion {
                    turn: (back * motion.turn).normalize(),
                    off: back * (to - moved_point(&parent, at)),
                }
            })
            .collect()
    }
}

impl PortableBody {
    /// Returns the positions of the vertices for the motions of the keyed bones, as a player computes them.
    #[must_use]
    pub fn posed_vertices(&self, keyed: &[BoneMotion]) -> Vec<Vec3> {
        let rest = FollowerMotion::new(Quat::IDENTITY, Vec3::ZERO, Vec3::ZERO);
        let mut motions = vec![rest; self.bones.len()];
        let mut given = keyed.iter();
        // Keyed bones first, since the others depend on them.
        for (index, bone) in self.bones.iter().enumerate() {
            let PortableBone::Keyed { parent, from, at } = *bone else {
                continue;
            };
            let Some(own) = given.next() else { break };
            motions[index] = match parent.map(|parent_index| motions[parent_index]) {
                Some(parent) => FollowerMotion::new(
                    parent.turn * own.turn,
                    from,
                    moved_point(&parent, at) + parent.turn * own.off,
                ),
                None => FollowerMotion::new(own.turn, from, own.off),
            };
        }
        // In order: a bone that is the same as another stands after it.
        for (index, bone) in self.bones.iter().enumerate() {
            motions[index] = match *bone {
                PortableBone::Keyed { .. } => continue,
                PortableBone::Same(other) => motions[other],
                // Both ends rotate about one point, so that only the rotation lies between.
                PortableBone::Between { ends, share } => {
                    let [a, b] = ends.map(|end| motions[end]);
                    FollowerMotion::new(a.turn.slerp(b.turn, share), a.from, a.to)
                }
                PortableBone::Half {
                    parent,
                    child,
                    at,
                    along,
                    swell,
                } => halfway_motion([motions[parent], motions[child]], at, along, swell),
            };
        }
        let matrices: Vec<_> = motions.iter().map(FollowerMotion::motion_matrix).collect();
        let place = |vertex: &PortableVertex| {
            let shares = vertex.bones.iter().zip(vertex.weights);
            let moved = shares.map(|(bone, weight)| {
                let (turn, offset) = &matrices[usize::from(*bone)];
                (*turn * vertex.place + *offset) * weight
            });
            moved.sum()
        };
        self.vertices.iter().map(place).collect()
    }
}

/// Returns the changes of a head's face in the space of its joint, for vertices from `first_head_vertex` on.
pub(super) fn head_face_morphs(
    head: &HeadPlacement,
    palette: &FigurePalette,
    first_head_vertex: usize,
) -> Vec<FaceMorph> {
    let shape = |face: &FacePosture| head.head_mesh(palette, face).vertices;
    let tongue_numbers = ["tongue_out", "tongue_left"].map(FacePosture::face_number_position);
    let ends = (0..FacePosture::FACE_NUMBER_COUNT).flat_map(|number| [(number, false), (number, true)]);
    let morphs = ends.filter_map(|(number, is_negative)| {
        let mut numbers = [0.0; FacePosture::FACE_NUMBER_COUNT];
        if let [Some(out), Some(aside)] = tongue_numbers
            && aside == number
        {
            // A tongue that is not out does not move to a side.
            numbers[out] = 1.0;
        }
        let rest = shape(&FacePosture::from_numbers(numbers));
        numbers[number] = if is_negative { -1.0 } else { 1.0 };
        let moved = shape(&FacePosture::from_numbers(numbers));
        let offsets = moved
            .iter()
            .zip(&rest)
            .map(|(end, start)| end.position - start.position);
        let moving = offsets
            .enumerate()
            .filter(|(_, offset)| offset.length() > LEAST_MORPH_OFFSET_METRES);
        let (vertices, offsets): (Vec<usize>, Vec<Vec3>) = moving
            .map(|(vertex, offset)| (first_head_vertex + vertex, offset))
            .unzip();
        (!vertices.is_empty()).then_some(FaceMorph {
            number,
            is_negative,
            vertices,
            offsets,
        })
    });
    morphs.collect()
}

/// Returns where a motion takes a point, without its stretch.
pub(super) fn moved_point(motion: &FollowerMotion, at: Vec3) -> Vec3 {
    motion.turn * (at - motion.from) + motion.to
}

/// Returns a follower as a bone.
fn follower_to_bone(rig: &SkinRig, index: usize, skeleton: &Skeleton) -> PortableBone {
    let find = |wanted: &dyn Fn(&SkinFollower) -> bool| rig.followers[..index].iter().position(wanted);
    let chest = || find(&|follower| matches!(follower, SkinFollower::Chest));
    let arm = |side: usize, joint: usize| rig.arms[side].as_ref().map_or(Vec3::ZERO, |limb| limb.places[joint]);
    let keyed = |parent: Option<usize>, at: Vec3| PortableBone::Keyed { parent, from: at, at };
    match rig.followers[index] {
        SkinFollower::Same(other) => PortableBone::Same(other),
        SkinFollower::Half {
            parent,
            child,
            at,
            along,
            swell,
        } => PortableBone::Half {
            parent,
            child,
            at,
            along,
            swell,
        },
        SkinFollower::Pelvis => keyed(None, rig.trunk.as_ref().map_or(Vec3::ZERO, TrunkRig::seat_place)),
        SkinFollower::Chest => keyed(
            find(&|follower| matches!(follower, SkinFollower::Pelvis)),
            rig.trunk.as_ref().map_or(Vec3::ZERO, TrunkRig::chest_place),
        ),
        SkinFollower::Shoulder(side) => keyed(chest(), arm(side, 0)),
        SkinFollower::Upper(side, share) => arm_share_bone(rig, index, side, share, false, arm(side, 0)),
        SkinFollower::Fore(side, share) => arm_share_bone(rig, index, side, share, true, arm(side, 1)),
        SkinFollower::Hand(side) => keyed(
            find(&|follower| matches!(follower, SkinFollower::Fore(own, share) if *own == side && *share == 1.0)),
            arm(side, 2),
        ),
        SkinFollower::Joint { joint, at, .. } => {
            // The nearest joint above that is a bone itself; joints of no bone are passed over.
            let above = skeleton.joint_ancestors(joint).skip(1).find_map(|above| {
                find(&|follower| match follower {
                    SkinFollower::Joint { joint, .. } => *joint == above,
                    SkinFollower::Hand(side) => rig.arms[*side].as_ref().is_some_and(|arm| arm.hand_joint() == above),
                    _ => false,
                })
            });
            keyed(above.or_else(chest), at)
        }
    }
}

/// Returns a part of an arm with a share of its rotation: the ends of the row are keyed, the others lie between them.
fn arm_share_bone(rig: &SkinRig, index: usize, side: usize, share: f32, fore: bool, at: Vec3) -> PortableBone {
    let row = |wanted: f32| {
        rig.followers.iter().position(|follower| match follower {
            SkinFollower::Upper(own, share) => !fore && *own == side && *share == wanted,
            SkinFollower::Fore(own, share) => fore && *own == side && *share == wanted,
            _ => false,
        })
    };
    // A player interpolates the middle followers, which need no keys then.
    if share > 0.0
        && share < 1.0
        && let (Some(a), Some(b)) = (row(0.0), row(1.0))
    {
        return PortableBone::Between { ends: [a, b], share };
    }
    let first = row(0.0).filter(|follower_index| *follower_index < index);
    let parent = first.or_else(|| {
        rig.followers[..index].iter().position(|follower| match follower {
            SkinFollower::Upper(own, share) => fore && *own == side && *share == 1.0,
            SkinFollower::Chest => !fore,
            _ => false,
        })
    });
    PortableBone::Keyed { parent, from: at, at }
}
