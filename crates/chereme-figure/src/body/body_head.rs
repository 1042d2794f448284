//! The head with its face: the canonical net moved by an expression, with eyes, brows, teeth, tongue, ears and hair.

use chereme_motion::FacePosture;
use glam::{Mat3, Quat, Vec3};

use super::body_face::{CanonicalHead, EYE_LOOP_VERTICES, FacePart, MOUTH_LOOP_VERTICES, height_above_hairline};
use super::extras;
use super::features::FaceFeatures;
use super::group;
use super::solids::smooth_step;
use crate::mesh::{MeshVertex, TriangleMesh, smooth_vertex_normals};
use crate::palette::{FigurePalette, HairCut, RgbColour};

/// The head's position and measures in the space of its joint.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HeadPlacement {
    /// The middle between chin and crown.
    pub(super) centre: Vec3,
    /// From chin to crown, in metres.
    pub(super) height: f32,
    /// The signer's left, up and forwards.
    pub(super) axes: Mat3,
}

/// The distance of the canonical head in front of the middle of the skull, in head heights.
const HEAD_FORWARDS_SHARE: f32 = 0.05;

impl HeadPlacement {
    /// Returns the head's surface in the space of its joint, with its facial expression. Every expression
    /// has the same vertices in the same order.
    pub(super) fn head_mesh(&self, palette: &FigurePalette, face: &FacePosture) -> TriangleMesh {
        let canon = CanonicalHead::shared_head();
        let features = FaceFeatures::from_face_values(face);
        let places = features.moved_head_vertices(canon);
        let mut mesh = TriangleMesh {
            vertices: canon
                .knots
                .iter()
                .zip(&places)
                .map(|(knot, &position)| MeshVertex {
                    position,
                    normal: Vec3::Z,
                    colour: head_vertex_colour(knot.place, knot.at, &features, palette).scale_colour(
                        match knot.place {
                            FacePart::Skin | FacePart::Eye(..) => knot.open,
                            _ => 1.0,
                        },
                    ),
                    group: group::HEAD_GROUP,
                })
                .collect(),
            triangles: canon.triangles.clone(),
        };
        smooth_vertex_normals(&mut mesh.vertices, &mesh.triangles, 0);
        hair(&mut mesh, canon, palette);
        extras::add_head_extras(&mut mesh, &features, canon, palette);
        let turn = Quat::from_mat3(&self.axes);
        for vertex in &mut mesh.vertices {
            let moved_place = vertex.position + Vec3::Z * HEAD_FORWARDS_SHARE;
            vertex.position = self.centre + turn * (moved_place * self.height);
            vertex.normal = turn * vertex.normal;
        }
        mesh
    }
}

/// Adds a shell over the scalp, and the other parts of the haircut.
fn hair(mesh: &mut TriangleMesh, canon: &CanonicalHead, palette: &FigurePalette) {
    if palette.cut == HairCut::None {
        return;
    }
    let base = mesh.vertices.len();
    let mut numbers = vec![u32::MAX; canon.knots.len()];
    let mut order = Vec::new();
    for &index in canon.scalp.iter().flatten() {
        let slot = &mut numbers[index as usize];
        if *slot == u32::MAX {
            *slot = order.len() as u32;
            order.push(index as usize);
        }
    }
    let count = order.len() as u32;
    for outer in [true, false] {
        for &index in &order {
            let (at, normal) = (mesh.vertices[index].position, mesh.vertices[index].normal);
            let deep = smooth_step(height_above_hairline(canon.knots[index].at) / 0.24);
            let top = smooth_step((at.y - 0.1) / 0.4);
            let thick = if outer {
                0.012 + (0.026 + 0.022 * top) * deep
            } else {
                -0.03
            };
            let strand = (at.x * 55.0 + at.z * 18.0).sin() * 0.5 + (at.x * 23.0 - at.y * 31.0).sin() * 0.5;
            mesh.vertices.push(MeshVertex {
                position: at + normal * thick,
                normal: Vec3::Z,
                colour: palette.crown.scale_colour(1.0 + 0.07 * strand * deep),
                group: group::HAIR_GROUP,
            });
        }
    }
    let mut shell: Vec<[u32; 3]> = Vec::new();
    let mut edges = std::collections::BTreeMap::new();
    for t in &canon.scalp {
        let shell_triangle = t.map(|i| numbers[i as usize]);
        shell.push(shell_triangle);
        shell.push([shell_triangle[0], shell_triangle[2], shell_triangle[1]].map(|i| i + count));
        for k in 0..3 {
            edges.insert((shell_triangle[k], shell_triangle[(k + 1) % 3]), ());
        }
    }
    for &(a, b) in edges.keys() {
        if !edges.contains_key(&(b, a)) {
            shell.extend([[b, a, a + count], [b, a + count, b + count]]);
        }
    }
    smooth_vertex_normals(&mut mesh.vertices[base..], &shell, 0);
    let shell = shell.into_iter().map(|t| t.map(|i| i + base as u32));
    mesh.triangles.extend(shell);
    extras::add_haircut_parts(mesh, palette);
}

fn head_vertex_colour(place: FacePart, at: Vec3, features: &FaceFeatures, palette: &FigurePalette) -> RgbColour {
    let lips = palette.mouth;
    let skin = palette.face;
    match place {
        FacePart::Skin => {
            // Blush in the cheeks, and stubble if no hair is drawn.
            let side = if at.x > 0.0 { 1.0 } else { -1.0 };
            let cheek = (at - Vec3::new(0.185 * side, -0.14, 0.25)).length();
            let warm = (1.0 - smooth_step(cheek / 0.15)) * 0.16;
            let (wrinkled, widened) = (features.nose.max(0.0), (-features.nose).max(0.0));
            let fold = (0.10 * wrinkled + 0.22 * widened)
                * (1.0 - smooth_step((at - Vec3::new(0.09 * side, -0.13, 0.33)).length() / 0.06));
            // A puffed cheek catches light, a sucked-in one does not.
            let puff = (at - Vec3::new(0.175 * side, -0.23, 0.20)).length();
            let puffed = features.cheeks[usize::from(side > 0.0)] * (1.0 - smooth_step(puff / 0.13));
            let shade = puffed * if puffed > 0.0 { 0.10 } else { 0.22 };
            let grown = palette.cut != HairCut::None && height_above_hairline(at) > 0.02;
            let under = if grown { palette.crown } else { skin };
            under.mix_colour(palette.mouth, warm).scale_colour(1.0 - fold + shade)
        }
        FacePart::Mouth(0, k) => lips.scale_colour(if features.has_open_lips() {
            0.80
        } else {
            if k <= MOUTH_LOOP_VERTICES / 2 { 0.62 } else { 0.75 }
        }),
        FacePart::Mouth(1, k) => lips.scale_colour(if k <= MOUTH_LOOP_VERTICES / 2 { 0.95 } else { 1.06 }),
        FacePart::Mouth(2, _) => lips.mix_colour(skin, 0.45),
        FacePart::Mouth(..) => skin,
        FacePart::Eye(_, 0, k) if k <= EYE_LOOP_VERTICES / 2 => palette.marks,
        FacePart::Eye(_, 0, _) => skin.scale_colour(0.72),
        FacePart::Eye(_, 1, _) => skin.scale_colour(0.93),
        FacePart::Eye(_, 2, k) if k < EYE_LOOP_VERTICES / 2 => skin.scale_colour(0.86),
        FacePart::Eye(..) => skin.scale_colour(0.97),
        FacePart::Bowl(_) => lips.scale_colour(0.36),
        FacePart::Socket(..) => skin.scale_colour(0.4),
    }
}
