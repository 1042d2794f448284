//! The forms of a body; each of them follows its joints.

use std::ops::Range;

use chereme_motion::ModelPose;
use glam::{Quat, Vec2, Vec3};

use crate::mesh::{Grid, Mesh, Vertex, smooth};
use crate::palette::Colour;

/// A point in the space of a joint, in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    pub(super) joint: usize,
    pub(super) local: Vec3,
}

impl Point {
    /// Returns the joint's own position.
    pub(super) fn at(joint: usize) -> Self {
        Self {
            joint,
            local: Vec3::ZERO,
        }
    }

    pub(super) fn place(self, pose: &ModelPose) -> Vec3 {
        place(pose, self.joint) + rotation(pose, self.joint) * self.local
    }
}

/// Returns the position of a joint.
pub(super) fn place(pose: &ModelPose, joint: usize) -> Vec3 {
    pose.position(joint).as_vec3()
}

/// Returns the rotation of a joint.
pub(super) fn rotation(pose: &ModelPose, joint: usize) -> Quat {
    pose.rotation(joint).as_quat()
}

/// A form with its joints.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Shape {
    /// A rod with round ends.
    Rod(Rod),
    /// A surface that rotates with one joint, in that joint's space.
    Rigid {
        joint: usize,
        places: Vec<Vec3>,
        normals: Vec<Vec3>,
    },
    /// A surface through rings that follow several joints.
    Loft(Loft),
}

/// A rod between two points with round ends, which may differ in thickness.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rod {
    pub(super) ends: [Point; 2],
    /// Radii at both ends and in the middle between them, in metres.
    pub(super) radii: [f32; 3],
    /// A joint, and the direction in its space that the rod's +X side faces.
    pub(super) facing: (usize, Vec3),
    pub(super) columns: usize,
}

/// Sines of the latitudes of a rod's rings; the middle of the rod lies between the halves.
const LATITUDES: [f32; 4] = [-0.93, -0.74, -0.42, 0.0];

impl Rod {
    fn grid(&self) -> Grid {
        Grid::new(self.columns, 2 * LATITUDES.len() + 1)
    }

    fn pose(&self, grid: &Grid, pose: &ModelPose, out: &mut [Vertex]) {
        let [from, to] = self.ends.map(|end| end.place(pose));
        let towards = rotation(pose, self.facing.0) * self.facing.1;
        let z = (to - from).normalize_or(towards.any_orthonormal_vector());
        let aside = towards - z * z.dot(towards);
        let x = if aside.length() > 0.01 {
            aside.normalize()
        } else {
            z.any_orthonormal_vector()
        };
        let y = z.cross(x);
        let mut rings: Vec<(Vec3, f32, f32)> = Vec::with_capacity(grid.rings);
        for sine in LATITUDES {
            rings.push((from, self.radii[0], sine));
        }
        rings.push((from.lerp(to, 0.5), self.radii[1], 0.0));
        for sine in LATITUDES.iter().rev() {
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
const SAME: f32 = 1e-3;

/// A surface through rings; the rings belong to [`Section`]s.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Loft {
    /// The rings from the first to the last.
    pub(super) sections: Vec<Section>,
    pub(super) columns: usize,
    /// The shape of the rings: 1 is an ellipse, and values towards 0 approach a rectangle.
    pub(super) roundness: f32,
}

/// One ring of a [`Loft`]: a rounded rectangle about a spine of points.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Section {
    /// Points along the ring's width from its -Y to its +Y end, each a mean of weighted points.
    pub(super) spine: Vec<Vec<(Point, f32)>>,
    /// Extension of the ring beyond the first and the last point of the spine, in metres.
    pub(super) beyond: f32,
    /// Half its thickness on the side that it faces, and on the other side, in metres.
    pub(super) thickness: [f32; 2],
    /// Shift of the ring along the surface, in metres.
    pub(super) shift: f32,
}

impl Loft {
    fn grid(&self) -> Grid {
        Grid::new(self.columns, self.sections.len())
    }

    fn pose(&self, grid: &Grid, pose: &ModelPose, out: &mut [Vertex]) {
        let spines: Vec<Vec<Vec3>> = self
            .sections
            .iter()
            .map(|section| section.spine.iter().map(|mix| mean(mix, pose)).collect())
            .collect();
        let middle = |spine: &[Vec3]| (spine[0] + spine[spine.len() - 1]) * 0.5;
        let whole = middle(&spines[spines.len() - 1]) - middle(&spines[0]);
        let mut next = 1;
        for (index, section) in self.sections.iter().enumerate() {
            let spine = &spines[index];
            let before = middle(&spines[index.saturating_sub(1)]);
            let after = middle(&spines[(index + 1).min(spines.len() - 1)]);
            let across = (spine[spine.len() - 1] - spine[0]).normalize_or(Vec3::X);
            let local = after - before;
            let steps = local.length() > SAME;
            let along = if steps { local } else { whole }.normalize_or(Vec3::Y);
            let facing = across.cross(along).normalize_or(Vec3::Z);
            let reach = |v: f32| along_spine(spine, across * section.beyond, v);
            for point in &grid.circle {
                let square = point.map(|v| v.signum() * v.abs().powf(self.roundness));
                let thick = section.thickness[usize::from(square.x < 0.0)];
                out[next].position =
                    reach(square.y) + facing * (square.x * thick) + along * section.shift;
                next += 1;
            }
        }
        let columns = grid.circle.len();
        let pole = |ring: &[Vertex]| {
            ring.iter().map(|vertex| vertex.position).sum::<Vec3>() / ring.len() as f32
        };
        out[0].position = pole(&out[1..=columns]);
        out[next].position = pole(&out[next - columns..next]);
        smooth(out, &grid.triangles(0), 0);
    }
}

/// Returns the weighted mean of points.
fn mean(mix: &[(Point, f32)], pose: &ModelPose) -> Vec3 {
    mix.iter()
        .map(|(point, weight)| point.place(pose) * *weight)
        .sum()
}

/// Returns the point at `v` (-1 to 1) along a spine that extends by `beyond` at its ends.
fn along_spine(spine: &[Vec3], beyond: Vec3, v: f32) -> Vec3 {
    let last = spine.len() - 1;
    let (first_end, last_end) = (spine[0] - beyond, spine[last] + beyond);
    let count = last + 2;
    let at = (v + 1.0) * 0.5 * count as f32;
    let piece = (at as usize).min(count - 1);
    let point = |i: usize| match i {
        0 => first_end,
        i if i > last + 1 => last_end,
        i => spine[i - 1],
    };
    point(piece).lerp(point(piece + 1), at - piece as f32)
}

/// A form with its position in the body's mesh.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Element {
    shape: Shape,
    grid: Option<Grid>,
    vertices: Range<usize>,
}

impl Element {
    /// Returns the joint with which the element rotates as a whole, and its points in that joint's space.
    pub(super) fn rigid(&self) -> Option<(usize, &[Vec3])> {
        match &self.shape {
            Shape::Rigid { joint, places, .. } => Some((*joint, places)),
            _ => None,
        }
    }

    /// Returns its vertices in the body's mesh.
    pub(super) fn vertices(&self) -> Range<usize> {
        self.vertices.clone()
    }

    /// Moves the element's vertices to their positions in `pose`.
    pub(super) fn pose(&self, pose: &ModelPose, mesh: &mut Mesh) {
        let out = &mut mesh.vertices[self.vertices.clone()];
        match (&self.shape, &self.grid) {
            (Shape::Rod(rod), Some(grid)) => rod.pose(grid, pose, out),
            (Shape::Loft(loft), Some(grid)) => loft.pose(grid, pose, out),
            (
                Shape::Rigid {
                    joint,
                    places,
                    normals,
                },
                _,
            ) => {
                let (at, turn) = (place(pose, *joint), rotation(pose, *joint));
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
pub(super) struct Assembly {
    pub(super) mesh: Mesh,
    pub(super) elements: Vec<Element>,
}

/// The colours of a form: of the side that it faces, and of the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Paint {
    pub(super) front: Colour,
    pub(super) back: Colour,
    pub(super) group: u8,
}

impl Paint {
    pub(super) fn plain(colour: Colour, group: u8) -> Self {
        Self {
            front: colour,
            back: colour,
            group,
        }
    }
}

impl Assembly {
    pub(super) fn rod(&mut self, rod: Rod, paint: Paint) {
        let grid = rod.grid();
        self.grid(Shape::Rod(rod), grid, paint);
    }

    pub(super) fn loft(&mut self, loft: Loft, paint: Paint) {
        let grid = loft.grid();
        self.grid(Shape::Loft(loft), grid, paint);
    }

    fn grid(&mut self, shape: Shape, grid: Grid, paint: Paint) {
        let start = self.mesh.vertices.len();
        for facing in grid.facing() {
            let share = ((facing + 0.35) / 0.7).clamp(0.0, 1.0);
            self.mesh.vertices.push(Vertex {
                position: Vec3::ZERO,
                normal: Vec3::Y,
                colour: paint
                    .back
                    .mixed(paint.front, share * share * (3.0 - 2.0 * share)),
                group: paint.group,
            });
        }
        self.mesh.triangles.extend(grid.triangles(start as u32));
        self.elements.push(Element {
            shape,
            grid: Some(grid),
            vertices: start..self.mesh.vertices.len(),
        });
    }

    /// Adds a surface that rotates with `joint`; `local` is in that joint's space.
    pub(super) fn rigid(&mut self, joint: usize, local: &Mesh) {
        let start = self.mesh.vertices.len();
        self.mesh.append(local);
        self.elements.push(Element {
            shape: Shape::Rigid {
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
pub(crate) fn ellipsoid(
    centre: Vec3,
    radii: Vec3,
    turn: Quat,
    detail: [usize; 2],
    paint: impl Fn(Vec3) -> (Vec3, Colour),
    group: u8,
) -> Mesh {
    let grid = Grid::new(detail[0], detail[1]);
    let mut sphere = vec![Vec3::NEG_Z];
    for ring in 1..=detail[1] {
        let angle = std::f64::consts::PI * ring as f64 / (detail[1] + 1) as f64;
        let (sine, cosine) = (angle.sin() as f32, -angle.cos() as f32);
        sphere.extend(
            grid.circle
                .iter()
                .map(|p: &Vec2| (*p * sine).extend(cosine)),
        );
    }
    sphere.push(Vec3::Z);
    let triangles = grid.triangles(0);
    let mut vertices: Vec<Vertex> = sphere
        .into_iter()
        .map(|point| {
            let (formed, colour) = paint(point);
            Vertex {
                position: centre + turn * (formed * radii),
                normal: Vec3::Y,
                colour,
                group,
            }
        })
        .collect();
    smooth(&mut vertices, &triangles, 0);
    Mesh {
        vertices,
        triangles,
    }
}
