//! Triangles with normals, colours and outline groups, and the closed forms from which bodies are built.

use glam::{Vec2, Vec3};

use crate::palette::RgbColour;

/// One corner of the triangles of a [`TriangleMesh`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshVertex {
    /// The position in model space, in metres.
    pub position: Vec3,
    /// The outward direction of the surface, of length one.
    pub normal: Vec3,
    /// The colour of the surface before light falls on it.
    pub colour: RgbColour,
    /// The part of the body it belongs to; lines are drawn where two groups meet.
    pub group: u8,
}

/// A surface of triangles, each anticlockwise seen from outside.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriangleMesh {
    /// The corners.
    pub vertices: Vec<MeshVertex>,
    /// The corners of each triangle, as indices into `vertices`.
    pub triangles: Vec<[u32; 3]>,
}

impl TriangleMesh {
    /// Adds everything from `other`.
    pub fn append_mesh(&mut self, other: &Self) {
        let base = self.vertices.len() as u32;
        self.vertices.extend_from_slice(&other.vertices);
        let moved = other.triangles.iter().map(|t| t.map(|i| i + base));
        self.triangles.extend(moved);
    }
}

/// Returns the path through `points` as a thin tube of `radius` metres that fades from `from` to
/// `to`: the trail of a wrist or a fingertip. Fewer than two points give nothing.
#[must_use]
pub fn trail_mesh(points: &[Vec3], radius: f32, [from, to]: [RgbColour; 2], group: u8) -> TriangleMesh {
    if points.len() < 2 {
        return TriangleMesh::default();
    }
    let grid = RingGrid::new(6, points.len());
    let last = points.len() - 1;
    let mut vertices = Vec::with_capacity(grid.len());
    // Carried from ring to ring, so that the tube does not twist.
    let mut side = Vec3::X;
    let mut add = |position, normal, share: f32| {
        vertices.push(MeshVertex {
            position,
            normal,
            colour: from.mix_colour(to, share),
            group,
        });
    };
    add(points[0], Vec3::NEG_Z, 0.0);
    for (index, &point) in points.iter().enumerate() {
        // The step across both neighbours is smoother than that to one of them.
        let step_vector = points[(index + 1).min(last)] - points[index.saturating_sub(1)];
        let along = step_vector.normalize_or(Vec3::Z);
        let fallback = along.any_orthonormal_vector();
        side = (side - along * along.dot(side)).normalize_or(fallback);
        let other = along.cross(side);
        for spoke in &grid.circle {
            let normal = side * spoke.x + other * spoke.y;
            add(point + normal * radius, normal, index as f32 / last as f32);
        }
    }
    add(points[last], Vec3::Z, 1.0);
    TriangleMesh {
        vertices,
        triangles: grid.grid_triangles(0),
    }
}

/// A closed surface of rings from a first pole to a last one, described in its own space.
///
/// The rings lie across the Z axis. [`RingGrid::vertex_facings`] gives each vertex's position along the ring's +X, so that the two
/// sides of a finger can have different colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RingGrid {
    /// Points on the unit circle, one per column, from +X towards +Y.
    pub(crate) circle: Vec<Vec2>,
    /// The number of rings, each of `circle.len()` points, without the poles.
    pub(crate) rings: usize,
}

impl RingGrid {
    pub(crate) fn new(columns: usize, rings: usize) -> Self {
        let circle = (0..columns)
            .map(|i| {
                let angle = std::f64::consts::TAU * i as f64 / columns as f64;
                Vec2::new(angle.cos() as f32, angle.sin() as f32)
            })
            .collect();
        Self { circle, rings }
    }

    /// Returns the number of vertices of the surface: the first pole, the rings, the last pole.
    pub(crate) fn len(&self) -> usize {
        self.rings * self.circle.len() + 2
    }

    /// Returns the triangles, anticlockwise from outside if the rings advance along +Z.
    pub(crate) fn grid_triangles(&self, base: u32) -> Vec<[u32; 3]> {
        let columns = self.circle.len() as u32;
        let vertex_index = |ring: u32, column: u32| base + 1 + ring * columns + column % columns;
        let last = base + self.len() as u32 - 1;
        let mut triangles = Vec::with_capacity(self.rings * self.circle.len() * 2);
        for column in 0..columns {
            triangles.push([base, vertex_index(0, column + 1), vertex_index(0, column)]);
        }
        for ring in 1..self.rings as u32 {
            for column in 0..columns {
                let (a, b) = (vertex_index(ring - 1, column), vertex_index(ring - 1, column + 1));
                let (c, d) = (vertex_index(ring, column), vertex_index(ring, column + 1));
                triangles.push([a, b, d]);
                triangles.push([a, d, c]);
            }
        }
        let ring = self.rings as u32 - 1;
        for column in 0..columns {
            triangles.push([last, vertex_index(ring, column), vertex_index(ring, column + 1)]);
        }
        triangles
    }

    /// Returns for every vertex its position along the ring's +X, from -1 to 1.
    pub(crate) fn vertex_facings(&self) -> Vec<f32> {
        let ring = self.circle.iter().map(|point| point.x);
        std::iter::once(0.0)
            .chain((0..self.rings).flat_map(|_| ring.clone()))
            .chain(std::iter::once(0.0))
            .collect()
    }
}

/// Replaces the normals of `vertices` by the area-weighted means of those of the triangles around.
pub(crate) fn smooth_vertex_normals(vertices: &mut [MeshVertex], triangles: &[[u32; 3]], base: u32) {
    for vertex in vertices.iter_mut() {
        vertex.normal = Vec3::ZERO;
    }
    for triangle in triangles {
        let [a, b, c] = triangle.map(|index| (index - base) as usize);
        let origin = vertices[a].position;
        // The cross product is as long as twice the area, which weighs large triangles more.
        let normal = (vertices[b].position - origin).cross(vertices[c].position - origin);
        for index in [a, b, c] {
            vertices[index].normal += normal;
        }
    }
    for vertex in vertices.iter_mut() {
        // A vertex of no triangle has no normal; any will do.
        vertex.normal = vertex.normal.normalize_or(Vec3::Y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trail_surrounds_its_path_and_faces_outwards() {
        let path: Vec<Vec3> = (0..20)
            .map(|i| i as f32 * 0.3)
            .map(|t| Vec3::new(t.cos(), t.sin(), 0.1 * t))
            .collect();
        let colours = [RgbColour::from_hex_colour(0), RgbColour::from_hex_colour(0xFF_FF_FF)];
        let tube = trail_mesh(&path, 0.01, colours, 1);
        for (ring, at) in path.iter().enumerate() {
            for vertex in &tube.vertices[1 + ring * 6..1 + (ring + 1) * 6] {
                assert!((vertex.position.distance(*at) - 0.01).abs() < 1e-5);
            }
        }
        let volume: f32 = tube
            .triangles
            .iter()
            .map(|t| t.map(|i| tube.vertices[i as usize].position))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        let length: f32 = path.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let hexagon = 1.5 * 3.0f32.sqrt() * 0.01 * 0.01;
        let share = volume / (length * hexagon);
        assert!((0.9..1.05).contains(&share), "{share}");
        assert!(trail_mesh(&path[..1], 0.01, colours, 1).triangles.is_empty());
    }
}
