//! The shade of hands on trunk and face, which darkens as a hand comes near the skin.

use chereme_motion::{BodyAnatomy, BodyPart, BodySide, HandFinger, ModelPose, Skeleton};
use glam::Vec3;

use super::body_shape::JointPoint;
use super::group;
use crate::mesh::TriangleMesh;

/// The share of light that a touching hand takes away.
const CONTACT_SHADE_STRENGTH: f32 = 0.36;
/// The distance in metres at which about a third of the shade is left.
const CONTACT_REACH_METRES: f32 = 0.06;
/// The distance beyond which hands give no shade, as a multiple of the reach.
const MAX_SHADE_REACH_FACTOR: f32 = 2.5;

/// Points of both hands, and the vertices of a mesh that they shade.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct HandContactShade {
    points: Vec<JointPoint>,
    vertices: Vec<u32>,
    reach: f32,
}

impl HandContactShade {
    /// Returns the points of the skeleton's hands, and the vertices of trunk, head and hair; `size` is that of the body
    /// relative to an adult's.
    pub(super) fn from_hand_points(skeleton: &Skeleton, anatomy: &BodyAnatomy, mesh: &TriangleMesh, size: f32) -> Self {
        // Hands and arms give the shade and do not receive it.
        let shaded = |group: u8| [group::TORSO_GROUP, group::HEAD_GROUP, group::HAIR_GROUP].contains(&group);
        let all_vertices = (0..).zip(&mesh.vertices);
        let vertices = all_vertices.filter(|(_, vertex)| shaded(vertex.group));
        Self {
            points: BodySide::BOTH_SIDES
                .into_iter()
                .flat_map(|side| hand_contact_points(skeleton, anatomy, side))
                .collect(),
            vertices: vertices.map(|(index, _)| index).collect(),
            reach: CONTACT_REACH_METRES * size,
        }
    }

    /// Shades the vertices of a mesh in a posture; otherwise their colours are those of `plain`.
    pub(super) fn shade_contact_vertices(&self, pose: &ModelPose, plain: &TriangleMesh, mesh: &mut TriangleMesh) {
        let places = || self.vertices.iter().map(|&index| index as usize);
        // The shade of the posture before is taken off.
        for index in places() {
            mesh.vertices[index].colour = plain.vertices[index].colour;
        }
        let Some(first) = self.vertices.first() else {
            return;
        };
        let first = mesh.vertices[*first as usize].position;
        let (low, high) = places().fold((first, first), |(low, high), index| {
            let vertex_place = mesh.vertices[index].position;
            (low.min(vertex_place), high.max(vertex_place))
        });
        let margin = Vec3::splat(self.reach * MAX_SHADE_REACH_FACTOR);
        let (low, high) = (low - margin, high + margin);
        let posed_points = self.points.iter().map(|point| point.point_position(pose));
        // Points far from the body are left out, which spares most postures the inner loop.
        let points: Vec<Vec3> = posed_points
            .filter(|at| at.cmpge(low).all() && at.cmple(high).all())
            .collect();
        if points.is_empty() {
            return;
        }
        let most = (self.reach * MAX_SHADE_REACH_FACTOR).powi(2);
        for index in places() {
            let vertex = &mut mesh.vertices[index];
            let mut nearest = most;
            for point in &points {
                let away = *point - vertex.position;
                // A point behind the skin is on the other side of the body.
                if away.dot(vertex.normal) > 0.0 {
                    nearest = nearest.min(away.length_squared());
                }
            }
            if nearest < most {
                let share = (-nearest / (self.reach * self.reach)).exp();
                vertex.colour = vertex.colour.scale_colour(1.0 - CONTACT_SHADE_STRENGTH * share);
            }
        }
    }
}

/// Returns points of one hand: its wrist, the knuckles, and the tips of all digits.
fn hand_contact_points(skeleton: &Skeleton, anatomy: &BodyAnatomy, side: BodySide) -> Vec<JointPoint> {
    let joint_point = |part: BodyPart| anatomy.part_joint(part).map(JointPoint::from_joint_index);
    let tip = |part: BodyPart| {
        let joint = anatomy.part_joint(part)?;
        let local = anatomy.joint_tip(skeleton, joint).unwrap_or_default().as_vec3();
        Some(JointPoint { joint, local })
    };
    let knuckles = HandFinger::ALL_FINGERS.map(|finger| joint_point(BodyPart::Finger(side, finger, 1)));
    let tips = HandFinger::ALL_FINGERS.map(|finger| tip(BodyPart::Finger(side, finger, 3)));
    let others = [joint_point(BodyPart::Hand(side)), tip(BodyPart::Thumb(side, 2))];
    knuckles.into_iter().chain(tips).chain(others).flatten().collect()
}
