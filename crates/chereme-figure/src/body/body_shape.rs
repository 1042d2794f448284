//! The forms of a body; each of them follows its joints.

use std::ops::Range;

use chereme_motion::ModelPose;
use glam::{Quat, Vec2, Vec3};

use super::solids::smooth_step;
use crate::mesh::{MeshVertex, RingGrid, TriangleMesh, smooth_vertex_normals};
use crate::palette::RgbColour;

/// A point in the space of a joint, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JointPoint {
    pub(super) joint: usize,
    pub(super) local: Vec3,
}

impl JointPoint {
    /// Returns the joint's own position.
    pub(super) fn from_joint_index(joint: usize) -> Self {
        Self {
            joint,
            local: Vec3::ZERO,
        }
    }

    pub(super) fn point_position(self, pose: &ModelPose) -> Vec3 {
        posed_joint_position(pose, self.joint) + posed_joint_rotation(pose, self.joint) * self.local
    }
}

/// Returns the position of a joint.
pub(super) fn posed_joint_position(pose: &ModelPose, joint: usize) -> Vec3 {
    pose.model_joint_position(joint).as_vec3()
}

/// Returns the rotation of a joint.
pub(super) fn posed_joint_rotation(pose: &ModelPose, joint: usize) -> Quat {
    pose.model_joint_rotation(joint).as_quat()
}

/// A form with its joints.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum BodyShape {
    /// A rod with round ends.
    Rod(BodyRod),
    /// A surface that rotates with one joint, in that joint's space.
    Rigid {
        joint: usize,
        places: Vec<Vec3>,
        normals: Vec<Vec3>,
    },
    /// A surface through rings that follow several joints.
    Loft(BodyLoft),
}

/// A rod between two points with round ends, which may differ in thickness.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BodyRod {
    pub(super) ends: [JointPoint; 2],
    /// Radii at both ends and in the middle between them, in metres.
    pub(super) radii: [f32; 3],
    /// A joint, and the direction in its space that the rod's +X side faces.
    pub(super) facing: (usize, Vec3),
    pub(super) columns: usize,
}

/// Sines of the latitudes of a rod's rings; the middle of the rod lies between the halves.
const ROD_RING_LATITUDES: [f32; 4] = [-0.93, -0.74, -0.42, 0.0];

impl BodyRod {
    fn rod_grid(&self) -> RingGrid {
        RingGrid::new(self.columns, 2 * ROD_RING_LATITUDES.len() + 1)
    }

    fn pose_rod(&self, grid: &RingGrid, pose: &ModelPose, out: &mut [MeshVertex]) {
        let [from, to] = self.ends.map(|end| end.point_position(pose));
        let towards = posed_joint_rotation(pose, self.facing.0) * self.facing.1;
        // A rod of no length points anywhere; it must only not be along its own facing.
        let z = (to - from).normalize_or(towards.any_orthonormal_vector());
        let aside = towards - z * z.dot(towards);
        // A facing along the rod says nothing of its sides.
        let x = if aside.length() > 0.01 {
            aside.normalize()
        } else {
            z.any_orthonormal_vector()
        };
        let y = z.cross(x);
        let mut rings: Vec<(Vec3, f32, f32)> = Vec::with_capacity(grid.rings);
        for sine in ROD_RING_LATITUDES {
            rings.push((from, self.radii[0], sine));
        }
        // One ring in the middle, since the radius there is given of its own.
        rings.push((from.lerp(to, 0.5), self.radii[1], 0.0));
        for sine in ROD_RING_LATITUDES.iter().rev() {
            rings.push((to, self.radii[2], -sine));
        }
        out[0].position = from - z * self.radii[0];
        out[0].normal = -z;
        let mut next = 1;
        for (centre, radius, sine) in rings {
            let cosine = (1.0 - sine * sine).sqrt();
            for point in &grid.circle {
                let normal = (x * point.x + y * point.y) * cosine + z * sine;
                out[next].position = centre + normal * radius;
                out[next].normal = normal;
                next += 1;
            }
        }
        out[next].position = to + z * self.radii[2];
        out[next].normal = z;
    }
}

/// The distance in metres below which the middles of two rings are equal.
const SAME_MIDDLE_METRES: f32 = 1e-3;

/// A surface through rings; the rings belong to [`LoftSection`]s.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BodyLoft {
    /// The rings from the first to the last.
    pub(super) sections: Vec<LoftSection>,
    pub(super) columns: usize,
    /// The shape of the rings: 1 is an ellipse, and values towards 0 approach a rectangle.
    pub(super) roundness: f32,
}

/// One ring of a [`Loft`]: a rounded rectangle about a spine of points.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LoftSection {
    /// Points along the ring's width from its -Y to its +Y end, each a mean of weighted points.
    pub(super) spine: Vec<Vec<(JointPoint, f32)>>,
    /// Extension of the ring beyond the first and the last point of the spine, in metres.
    pub(super) beyond: f32,
    /// Half its thickness on the side that it faces, and on the other side, in metres.
    pub(super) thickness: [f32; 2],
    /// Shift of the ring along the surface, in metres.
    pub(super) shift: f32,
}

impl BodyLoft {
    fn loft_grid(&self) -> RingGrid {
        RingGrid::new(self.columns, self.sections.len())
    }

    fn pose_loft(&self, grid: &RingGrid, pose: &ModelPose, out: &mut [MeshVertex]) {
        let spines: Vec<Vec<Vec3>> = self
            .sections
            .iter()
            .map(|section| section.spine.iter().map(|mix| weighted_point_mean(mix, pose)).collect())
            .collect();
        let middle = |spine: &[Vec3]| (spine[0] + spine[spine.len() - 1]) * 0.5;
        let spine_line = middle(&spines[spines.len() - 1]) - middle(&spines[0]);
        let mut next = 1;
        for (index, section) in self.sections.iter().enumerate() {
            let spine = &spines[index];
            let before = middle(&spines[index.saturating_sub(1)]);
            let after = middle(&spines[(index + 1).min(spines.len() - 1)]);
            let across = (spine[spine.len() - 1] - spine[0]).normalize_or(Vec3::X);
            let local = after - before;
            // Rings with one middle have no direction between them: the whole spine's is used.
            let steps = local.length() > SAME_MIDDLE_METRES;
            let along = if steps { local } else { spine_line }.normalize_or(Vec3::Y);
            let facing = across.cross(along).normalize_or(Vec3::Z);
            let reach = |v: f32| along_spine(spine, across * section.beyond, v);
            for point in &grid.circle {
                // The power makes an ellipse more like a rectangle.
                let square = point.map(|v| v.signum() * v.abs().powf(self.roundness));
                let thick = section.thickness[usize::from(square.x < 0.0)];
                out[next].position = reach(square.y) + facing * (square.x * thick) + along * section.shift;
                next += 1;
            }
        }
        let columns = grid.circle.len();
        let pole = |ring: &[MeshVertex]| ring.iter().map(|vertex| vertex.position).sum::<Vec3>() / ring.len() as f32;
        out[0].position = pole(&out[1..=columns]);
        out[next].position = pole(&out[next - columns..next]);
        smooth_vertex_normals(out, &grid.grid_triangles(0), 0);
    }
}

/// Returns the weighted mean of points.
fn weighted_point_mean(mix: &[(JointPoint, f32)], pose: &ModelPose) -> Vec3 {
    mix.iter()
        .map(|(point, weight)| point.point_position(pose) * *weight)
        .sum()
}

/// Returns the point at `v` (-1 to 1) along a spine that extends by `beyond` at its ends.
fn along_spine(spine: &[Vec3], beyond: Vec3, v: f32) -> Vec3 {
    let last = spine.len() - 1;
    let (first_end, last_end) = (spine[0] - beyond, spine[last] + beyond);
    let count = last + 2;
    let spine_position = (v + 1.0) * 0.5 * count as f32;
    let piece = (spine_position as usize).min(count - 1);
    // Index 0 and the last are the ends beyond the spine.
    let point = |i: usize| match i {
        0 => first_end,
        i if i > last + 1 => last_end,
        i => spine[i - 1],
    };
    point(piece).lerp(point(piece + 1), spine_position - piece as f32)
}

/// A form with its position in the body's mesh.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BodyElement {
    shape: BodyShape,
    grid: Option<RingGrid>,
    vertices: Range<usize>,
}

impl BodyElement {
    /// Returns the joint with which the element rotates as a whole, and its points in that joint's space.
    pub(super) fn rigid_points(&self) -> Option<(usize, &[Vec3])> {
        match &self.shape {
            BodyShape::Rigid { joint, places, .. } => Some((*joint, places)),
            _ => None,
        }
    }

    /// Returns the joint with which all of it moves; `None` if several move it.
    pub(super) fn carrying_joint(&self) -> Option<usize> {
        match &self.shape {
            BodyShape::Rigid { joint, .. } => Some(*joint),
            BodyShape::Rod(rod) => Some(rod.ends[0].joint),
            BodyShape::Loft(_) => None,
        }
    }

    /// Returns its vertices in the body's mesh.
    pub(super) fn element_vertex_range(&self) -> Range<usize> {
        self.vertices.clone()
    }

    /// Moves the element's vertices to their positions in `pose`.
    pub(super) fn pose_body_element(&self, pose: &ModelPose, mesh: &mut TriangleMesh) {
        let out = &mut mesh.vertices[self.vertices.clone()];
        match (&self.shape, &self.grid) {
            (BodyShape::Rod(rod), Some(grid)) => rod.pose_rod(grid, pose, out),
            (BodyShape::Loft(loft), Some(grid)) => loft.pose_loft(grid, pose, out),
            (BodyShape::Rigid { joint, places, normals }, _) => {
                let (at, turn) = (posed_joint_position(pose, *joint), posed_joint_rotation(pose, *joint));
                for ((vertex, place), normal) in out.iter_mut().zip(places).zip(normals) {
                    vertex.position = at + turn * *place;
                    vertex.normal = turn * *normal;
                }
            }
            _ => {}
        }
    }
}

/// Elements and their mesh, under construction.
#[derive(Debug, Clone, Default)]
pub(super) struct BodyAssembly {
    pub(super) mesh: TriangleMesh,
    pub(super) elements: Vec<BodyElement>,
}

/// The colours of a form: of the side that it faces, and of the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct ShapePaint {
    pub(super) front: RgbColour,
    pub(super) back: RgbColour,
    pub(super) group: u8,
}

impl ShapePaint {
    pub(super) fn from_plain_colour(colour: RgbColour, group: u8) -> Self {
        Self {
            front: colour,
            back: colour,
            group,
        }
    }
}

impl BodyAssembly {
    pub(super) fn add_body_rod(&mut self, rod: BodyRod, paint: ShapePaint) {
        let grid = rod.rod_grid();
        self.add_grid_shape(BodyShape::Rod(rod), grid, paint);
    }

    pub(super) fn add_body_loft(&mut self, loft: BodyLoft, paint: ShapePaint) {
        let grid = loft.loft_grid();
        self.add_grid_shape(BodyShape::Loft(loft), grid, paint);
    }

    fn add_grid_shape(&mut self, shape: BodyShape, grid: RingGrid, paint: ShapePaint) {
        let start = self.mesh.vertices.len();
        for facing in grid.vertex_facings() {
            // The colours change softly where front and back meet.
            let share = smooth_step((facing + 0.35) / 0.7);
            self.mesh.vertices.push(MeshVertex {
                position: Vec3::ZERO,
                normal: Vec3::Y,
                colour: paint.back.mix_colour(paint.front, share),
                group: paint.group,
            });
        }
        self.mesh.triangles.extend(grid.grid_triangles(start as u32));
        self.elements.push(BodyElement {
            shape,
            grid: Some(grid),
            vertices: start..self.mesh.vertices.len(),
        });
    }

    /// Adds a surface that rotates with `joint`; `local` is in that joint's space.
    pub(super) fn add_rigid_mesh(&mut self, joint: usize, local: &TriangleMesh) {
        let start = self.mesh.vertices.len();
        self.mesh.append_mesh(local);
        self.elements.push(BodyElement {
            shape: BodyShape::Rigid {
                joint,
                places: local.vertices.iter().map(|v| v.position).collect(),
                normals: local.vertices.iter().map(|v| v.normal).collect(),
            },
            grid: None,
            vertices: start..self.mesh.vertices.len(),
        });
    }
}

/// Returns an ellipsoid about `centre`, with its axes rotated by `turn`; `colour` gives the colour for a point of the
/// unit sphere.
pub(crate) fn ellipsoid_mesh(
    centre: Vec3,
    radii: Vec3,
    turn: Quat,
    detail: [usize; 2],
    paint: impl Fn(Vec3) -> (Vec3, RgbColour),
    group: u8,
) -> TriangleMesh {
    let grid = RingGrid::new(detail[0], detail[1]);
    let mut sphere = vec![Vec3::NEG_Z];
    for ring in 1..=detail[1] {
        let angle = std::f64::consts::PI * ring as f64 / (detail[1] + 1) as f64;
        let (sine, cosine) = (angle.sin() as f32, -angle.cos() as f32);
        sphere.extend(grid.circle.iter().map(|p: &Vec2| (*p * sine).extend(cosine)));
    }
    sphere.push(Vec3::Z);
    let triangles = grid.grid_triangles(0);
    let mut vertices: Vec<MeshVertex> = sphere
        .into_iter()
        .map(|point| {
            let (formed, colour) = paint(point);
            MeshVertex {
                position: centre + turn * (formed * radii),
                normal: Vec3::Y,
                colour,
                group,
            }
        })
        .collect();
    smooth_vertex_normals(&mut vertices, &triangles, 0);
    TriangleMesh { vertices, triangles }
}
