//! The shade of hands on trunk and face, which darkens as a hand comes near the skin.

use chereme_motion::{Anatomy, Finger, ModelPose, Part, Side, Skeleton};
use glam::Vec3;

use super::group;
use super::shape::Point;
use crate::mesh::Mesh;

/// The share of light that a touching hand takes away.
const STRENGTH: f32 = 0.36;
/// The distance in metres at which about a third of the shade is left.
const REACH: f32 = 0.06;
/// The distance beyond which hands give no shade, as a multiple of the reach.
const FAR: f32 = 2.5;

/// Points of both hands, and the vertices of a mesh that they shade.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Contact {
    points: Vec<Point>,
    vertices: Vec<u32>,
    reach: f32,
}

impl Contact {
    /// Returns the points of the skeleton's hands, and the vertices of trunk, head and hair; `size` is that of the body
    /// relative to an adult's.
    pub(super) fn of(skeleton: &Skeleton, anatomy: &Anatomy, mesh: &Mesh, size: f32) -> Self {
        let shaded = |group: u8| [group::TORSO, group::HEAD, group::HAIR].contains(&group);
        let vertices = (0..).zip(&mesh.vertices);
        let vertices = vertices.filter(|(_, vertex)| shaded(vertex.group));
        Self {
            points: Side::BOTH
                .into_iter()
                .flat_map(|side| points(skeleton, anatomy, side))
                .collect(),
            vertices: vertices.map(|(index, _)| index).collect(),
            reach: REACH * size,
        }
    }

    /// Shades the vertices of a mesh in a posture; otherwise their colours are those of `plain`.
    pub(super) fn shade(&self, pose: &ModelPose, plain: &Mesh, mesh: &mut Mesh) {
        let places = || self.vertices.iter().map(|&index| index as usize);
        for index in places() {
            mesh.vertices[index].colour = plain.vertices[index].colour;
        }
        let Some(first) = self.vertices.first() else {
            return;
        };
        let first = mesh.vertices[*first as usize].position;
        let (low, high) = places().fold((first, first), |(low, high), index| {
            let at = mesh.vertices[index].position;
            (low.min(at), high.max(at))
        });
        let margin = Vec3::splat(self.reach * FAR);
        let (low, high) = (low - margin, high + margin);
        let points = self.points.iter().map(|point| point.place(pose));
        let points: Vec<Vec3> = points
            .filter(|at| at.cmpge(low).all() && at.cmple(high).all())
            .collect();
        if points.is_empty() {
            return;
        }
        let most = (self.reach * FAR).powi(2);
        for index in places() {
            let vertex = &mut mesh.vertices[index];
            let mut nearest = most;
            for point in &points {
                let away = *point - vertex.position;
                if away.dot(vertex.normal) > 0.0 {
                    nearest = nearest.min(away.length_squared());
                }
            }
            if nearest < most {
                let share = (-nearest / (self.reach * self.reach)).exp();
                vertex.colour = vertex.colour.scaled(1.0 - STRENGTH * share);
            }
        }
    }
}

/// Returns points of one hand: its wrist, the knuckles, and the tips of all digits.
fn points(skeleton: &Skeleton, anatomy: &Anatomy, side: Side) -> Vec<Point> {
    let at = |part: Part| anatomy.joint(part).map(Point::at);
    let tip = |part: Part| {
        let joint = anatomy.joint(part)?;
        let local = anatomy.tip(skeleton, joint).unwrap_or_default().as_vec3();
        Some(Point { joint, local })
    };
    let knuckles = Finger::ALL.map(|finger| at(Part::Finger(side, finger, 1)));
    let tips = Finger::ALL.map(|finger| tip(Part::Finger(side, finger, 3)));
    let others = [at(Part::Hand(side)), tip(Part::Thumb(side, 2))];
    knuckles
        .into_iter()
        .chain(tips)
        .chain(others)
        .flatten()
        .collect()
}
