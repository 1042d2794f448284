//! Parts of the canonical head: eyeballs, brows, nostrils, teeth, tongue, ears, and hair that hangs.
//!
//! Lengths are in head heights, in the axes of `face`: x to the signer's left, y up, z forward. Each part is a surface
//! of its own, separate from the net of the head. `side` is 0 for right and 1 for left, `sign` the same as -1 and 1.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use glam::{Quat, Vec3};

use super::body_face::{CanonicalHead, LEFT_EYEBALL, LIP_LINE_HEIGHT};
use super::body_shape::ellipsoid_mesh;
use super::features::FaceFeatures;
use super::group;
use crate::mesh::{MeshVertex, RingGrid, TriangleMesh, smooth_vertex_normals};
use crate::palette::{FigurePalette, HairCut, RgbColour};

/// Adds everything but hair.
pub(super) fn add_head_extras(
    mesh: &mut TriangleMesh,
    features: &FaceFeatures,
    canon: &CanonicalHead,
    palette: &FigurePalette,
) {
    for side in 0..2 {
        let sign = if side == 0 { -1.0 } else { 1.0 };
        add_eyeball(mesh, features, sign, side, palette);
        brow(mesh, features, canon, sign, side, palette);
        ear(mesh, sign, palette);
        nostril(mesh, features, canon, sign, palette);
    }
    teeth(mesh, features, palette);
    tongue(mesh, features, palette);
}

/// Angles of the rings of an eyeball from the middle of the pupil, in degrees.
const EYEBALL_RING_DEGREES: [f32; 11] = [7.0, 15.0, 16.5, 25.0, 32.0, 34.5, 50.0, 75.0, 100.0, 130.0, 160.0];

/// Adds an eyeball with pupil and iris in the direction of gaze, and a glint unless the lid is more than half closed.
fn add_eyeball(mesh: &mut TriangleMesh, features: &FaceFeatures, sign: f32, side: usize, palette: &FigurePalette) {
    let [left, up] = features.gaze;
    // Eyes turn further to the sides than up or down.
    let turn = Quat::from_rotation_y(left * 26f32.to_radians()) * Quat::from_rotation_x(-up * 22f32.to_radians());
    let grid = RingGrid::new(20, EYEBALL_RING_DEGREES.len());
    let centre = LEFT_EYEBALL.0 * Vec3::new(sign, 1.0, 1.0);
    let base = mesh.vertices.len() as u32;
    let mut add = |direction: Vec3, colour: RgbColour| {
        mesh.vertices.push(MeshVertex {
            position: centre + turn * direction * LEFT_EYEBALL.1,
            normal: turn * direction,
            colour,
            group: group::HEAD_GROUP,
        });
    };
    let dark = RgbColour::from_hex_colour(0x17_12_12);
    let colour = |angle: f32| match angle {
        a if a < 15.5 => dark,
        a if a < 26.0 => palette.iris,
        a if a < 33.0 => palette.iris.scale_colour(0.78),
        a if a < 60.0 => palette.eyes,
        _ => palette.eyes.scale_colour(0.93),
    };
    add(Vec3::Z, dark);
    for angle in EYEBALL_RING_DEGREES {
        let (sine, cosine) = angle.to_radians().sin_cos();
        for spoke in &grid.circle {
            add(Vec3::new(spoke.x * sine, spoke.y * sine, cosine), colour(angle));
        }
    }
    add(Vec3::NEG_Z, palette.eyes);
    // The grid begins with its hind pole and here with the front one, which turns triangles inside out.
    let flipped = grid.grid_triangles(base).into_iter().map(|[a, b, c]| [a, c, b]);
    mesh.triangles.extend(flipped);
    // Kept with no size, so that every expression has the same vertices.
    let open = if features.lids[side] > 0.5 { 0.0 } else { 1.0 };
    let glint = centre + (turn * Vec3::new(0.20, 0.22, 0.955)).normalize() * LEFT_EYEBALL.1;
    let small = ellipsoid_mesh(
        glint,
        Vec3::new(0.010, 0.010, 0.004) * open,
        Quat::IDENTITY,
        [6, 4],
        |point| (point, RgbColour::from_hex_colour(0xFF_FF_FF)),
        group::HEAD_GROUP,
    );
    mesh.append_mesh(&small);
}

/// Adds a brow: a ridge of hair above the eye, raised, lowered or drawn to the middle with the expression.
fn brow(
    mesh: &mut TriangleMesh,
    features: &FaceFeatures,
    canon: &CanonicalHead,
    sign: f32,
    side: usize,
    palette: &FigurePalette,
) {
    const BROW_SEGMENTS: usize = 9;
    let base = mesh.vertices.len();
    let brow = features.brows[side];
    let mut ring = Vec::new();
    let station = |k: usize| {
        let t = k as f32 / (BROW_SEGMENTS - 1) as f32;
        let x = 0.044 + 0.184 * t;
        let arch = 0.092 + 0.030 * (PI * t.powf(1.15) * 0.86).sin() - 0.012 * t;
        let lift = if brow > 0.0 {
            brow * (0.050 + 0.034 * (PI * t).sin())
        } else {
            brow * (0.036 + 0.012 * (1.0 - t))
        };
        // A frown draws the inner end of a brow most.
        let drawn = features.frown * (1.0 - t).powf(1.3);
        let brow_place = [sign * (x - 0.022 * drawn), arch + lift - 0.026 * drawn];
        let thick = 0.0115 * (0.30 + 0.95 * (PI * (0.06 + 0.88 * t)).sin()) * (1.0 - 0.30 * t);
        (brow_place, thick)
    };
    let mut push = |[x, y]: [f32; 2], out: f32| {
        let skin = Vec3::new(x, y, canon.front_depth_at(x, y));
        // The brow stays on raised skin, but does not sink into a hollow.
        let z = skin.z + features.feature_displacement(skin).z.max(0.0) + out;
        mesh.vertices.push(MeshVertex {
            position: Vec3::new(x, y, z),
            normal: Vec3::Z,
            colour: palette.brows,
            group: group::HEAD_GROUP,
        });
    };
    for (up, out) in [(1.0, 0.002), (0.0, 0.013), (-1.0, 0.002)] {
        for k in 0..BROW_SEGMENTS {
            let ([x, y], thick) = station(k);
            push([x, y + thick * up], out);
        }
    }
    let vertex_index = |row: usize, k: usize| (base + row * BROW_SEGMENTS + k) as u32;
    let mut triangles = Vec::new();
    for row in 0..2 {
        for k in 0..BROW_SEGMENTS - 1 {
            let (a, b, c, d) = (
                vertex_index(row, k),
                vertex_index(row, k + 1),
                vertex_index(row + 1, k + 1),
                vertex_index(row + 1, k),
            );
            triangles.extend([[a, d, c], [a, c, b]]);
        }
    }
    ring.extend((0..BROW_SEGMENTS).map(|k| vertex_index(0, k)));
    ring.push(vertex_index(1, BROW_SEGMENTS - 1));
    ring.extend((0..BROW_SEGMENTS).rev().map(|k| vertex_index(2, k)));
    ring.push(vertex_index(1, 0));
    let ([x, y], _) = station(BROW_SEGMENTS / 2);
    // A point inside the head closes the ridge, so that it has no open edge from any side.
    push([x, y], -0.03);
    let behind = mesh.vertices.len() as u32 - 1;
    for (k, &a) in ring.iter().enumerate() {
        let b = ring[(k + 1) % ring.len()];
        triangles.push([a, b, behind]);
    }
    append_side_triangles(mesh, base, triangles, sign < 0.0);
}

/// Appends the triangles of the vertices from `base` on, reversed for the other side, with smooth normals.
fn append_side_triangles(mesh: &mut TriangleMesh, base: usize, mut triangles: Vec<[u32; 3]>, flip: bool) {
    if flip {
        for triangle in &mut triangles {
            triangle.swap(1, 2);
        }
    }
    smooth_vertex_normals(&mut mesh.vertices[base..], &triangles, base as u32);
    mesh.triangles.extend(triangles);
}

/// Adds a nostril: a dark spot on the skin that grows when the nose widens.
fn nostril(
    mesh: &mut TriangleMesh,
    features: &FaceFeatures,
    canon: &CanonicalHead,
    sign: f32,
    palette: &FigurePalette,
) {
    let widened = (-features.nose).max(0.0);
    let (x, y) = ((0.024 + 0.016 * widened) * sign, -0.188);
    let skin = Vec3::new(x, y, canon.front_depth_at(x, y));
    let size = Vec3::new(0.015 + 0.021 * widened, 0.006 + 0.014 * widened, 0.010);
    let colour = palette.face.mix_colour(palette.mouth, 0.35).scale_colour(0.42);
    let full_mesh = ellipsoid_mesh(
        skin + features.feature_displacement(skin) + Vec3::Z * 0.003,
        size,
        Quat::from_rotation_z(-0.25 * sign),
        [10, 6],
        |point| (point, colour),
        group::HEAD_GROUP,
    );
    mesh.append_mesh(&full_mesh);
}

/// Adds an ear: a flat ellipsoid, narrow towards the lobe, with a darker hollow.
fn ear(mesh: &mut TriangleMesh, sign: f32, palette: &FigurePalette) {
    let turn = Quat::from_rotation_y(sign * 0.45) * Quat::from_rotation_z(-sign * 0.12);
    let skin = palette.face;
    let full_mesh = ellipsoid_mesh(
        Vec3::new(0.338 * sign, -0.035, -0.045),
        Vec3::new(0.022, 0.125, 0.072),
        turn,
        [16, 12],
        |point| {
            // Narrow towards the lobe, hollow in the middle.
            let up = Quat::from_rotation_x(-FRAC_PI_2) * point;
            let low = 1.0 - 0.28 * super::solids::smooth_step(-up.y);
            let hollow = up.x * sign > 0.25 && up.y.abs() < 0.6 && (up.z - 0.1).abs() < 0.5;
            let colour = if hollow {
                skin.scale_colour(0.84)
            } else {
                skin.scale_colour(0.97)
            };
            (Vec3::new(up.x, up.y, up.z * low), colour)
        },
        group::HEAD_GROUP,
    );
    mesh.append_mesh(&full_mesh);
}

/// Adds the upper and the lower row of teeth, as far as the open mouth shows them.
fn teeth(mesh: &mut TriangleMesh, features: &FaceFeatures, palette: &FigurePalette) {
    const TEETH_SEGMENTS: usize = 11;
    let [above, below] = features.mouth_gap();
    let open = (above + below).max(0.0);
    let half = features.mouth_half_width() * 0.86;
    for lower in [false, true] {
        let shown = if lower {
            // Lower teeth show only in bared teeth and hide again in a wide open mouth.
            (features.teeth - 0.05).max(0.0) * if open > 0.09 { 0.0 } else { 1.0 }
        } else {
            features.teeth.max(if open > 0.03 { 0.42 } else { 0.0 })
        };
        // The two rows together never take up more than the gap.
        let full_height = (0.012 + 0.030 * shown).min(open * if lower { 0.40 } else { 0.62 });
        let tall = if shown > 0.0 && open > 0.004 { full_height } else { 0.0 };
        let base = mesh.vertices.len();
        let root = if lower {
            LIP_LINE_HEIGHT - below
        } else {
            LIP_LINE_HEIGHT + above
        };
        for edge in [0.0, 1.0] {
            for k in 0..TEETH_SEGMENTS {
                let u = k as f32 / (TEETH_SEGMENTS - 1) as f32 * 2.0 - 1.0;
                let bend = (1.0 - u * u).max(0.0);
                // A tenth of the way into the gum hides the upper edge of the row.
                let y = root + if lower { 1.0 } else { -1.0 } * (tall * edge * bend.sqrt().max(0.3) - 0.010);
                // Every second tooth is slightly darker, which separates them at small sizes.
                let gap = if k % 2 == 0 { 1.0 } else { 0.97 };
                mesh.vertices.push(MeshVertex {
                    position: Vec3::new(u * half, y, 0.262 + 0.045 * bend + features.lip_protrusion() * 0.5),
                    normal: Vec3::Z,
                    colour: palette.eyes.scale_colour(gap * if lower { 0.93 } else { 0.98 }),
                    group: group::HEAD_GROUP,
                });
            }
        }
        mesh.vertices.push(MeshVertex {
            position: Vec3::new(0.0, root, 0.20),
            normal: Vec3::Z,
            colour: palette.eyes,
            group: group::HEAD_GROUP,
        });
        let vertex_index = |row: usize, k: usize| (base + row * TEETH_SEGMENTS + k) as u32;
        let behind = (base + 2 * TEETH_SEGMENTS) as u32;
        let mut triangles = Vec::new();
        for k in 0..TEETH_SEGMENTS - 1 {
            triangles.extend([
                [vertex_index(0, k), vertex_index(1, k), vertex_index(1, k + 1)],
                [vertex_index(0, k), vertex_index(1, k + 1), vertex_index(0, k + 1)],
                [vertex_index(0, k + 1), behind, vertex_index(0, k)],
                [vertex_index(1, k), behind, vertex_index(1, k + 1)],
            ]);
        }
        triangles.push([vertex_index(0, 0), behind, vertex_index(1, 0)]);
        triangles.push([
            vertex_index(1, TEETH_SEGMENTS - 1),
            behind,
            vertex_index(0, TEETH_SEGMENTS - 1),
        ]);
        // The lower row is built as the upper one mirrored, so its triangles turn.
        append_side_triangles(mesh, base, triangles, lower);
    }
}

/// Adds the tongue, in the mouth or stretched out over the lower lip.
fn tongue(mesh: &mut TriangleMesh, features: &FaceFeatures, palette: &FigurePalette) {
    const TONGUE_RIM_POINTS: usize = 14;
    let [above, below] = features.mouth_gap();
    let open = above + below;
    let inside = (open / 0.06).min(1.0);
    let out = features.tongue;
    let base = mesh.vertices.len();
    let colour = palette.tongue;
    // A tongue that is out keeps its width even if the lips almost close on it.
    let width = (features.mouth_half_width() * 0.52).min(0.062) * inside.max(if out > 0.0 { 1.0 } else { 0.0 });
    // Rings from the root in the mouth to the tip, which hangs over the lower lip.
    let rings: [f32; 6] = [0.0, 0.25, 0.5, 0.72, 0.90, 0.985];
    let seat = LIP_LINE_HEIGHT - below * 0.72;
    let middle = |s: f32| {
        let long = 0.05 + 0.105 * out;
        let reach = s * long;
        let lip = 0.30 + features.lip_protrusion();
        let inner = 0.205 + reach.min(lip - 0.205 + 0.015);
        let over = (reach - 0.085).max(0.0);
        let aside = features.tongue_aside * 0.06 * out * s * s;
        let z = if out > 0.0 {
            0.245 + (0.135 + features.lip_protrusion()) * (s / 0.42).min(1.0) + 0.02 * s
        } else {
            inner
        };
        let y = if out > 0.0 {
            LIP_LINE_HEIGHT - below * 0.5 + 0.004 - (0.085 * out) * s.powi(2) - over * 0.2
        } else {
            seat
        };
        Vec3::new(aside, y, z)
    };
    mesh.vertices.push(vertex(middle(0.0) - Vec3::Z * 0.01, colour));
    for s in rings {
        // Not to zero at the tip, where the rings would fall into one point.
        let round = (1.0 - s.powi(4)).max(0.02).sqrt();
        for k in 0..TONGUE_RIM_POINTS {
            let (sine, cosine) = (TAU * k as f32 / TONGUE_RIM_POINTS as f32).sin_cos();
            let groove = if sine > 0.0 {
                1.0 - 0.35 * (1.0 - cosine.abs())
            } else {
                1.0
            };
            let tongue_place = middle(s) + Vec3::new(cosine * width * round, sine * 0.016 * round * groove, 0.0);
            let dark = if sine > 0.3 && cosine.abs() < 0.3 { 0.88 } else { 1.0 };
            mesh.vertices.push(vertex(tongue_place, colour.scale_colour(dark)));
        }
    }
    mesh.vertices.push(vertex(middle(1.0) + Vec3::Z * 0.004, colour));
    let mut grid = RingGrid::new(TONGUE_RIM_POINTS, rings.len());
    grid.rings = rings.len();
    let triangles = grid.grid_triangles(base as u32);
    append_side_triangles(mesh, base, triangles, false);
}

/// Returns a vertex of the head whose normal is computed later.
fn vertex(position: Vec3, colour: RgbColour) -> MeshVertex {
    MeshVertex {
        position,
        normal: Vec3::Z,
        colour,
        group: group::HEAD_GROUP,
    }
}

/// Adds the parts of a haircut beyond the cap: a knot behind the head, or hair that hangs to the chin.
pub(super) fn add_haircut_parts(mesh: &mut TriangleMesh, palette: &FigurePalette) {
    match palette.cut {
        HairCut::None | HairCut::Short => {}
        HairCut::Tied => {
            let knot = ellipsoid_mesh(
                Vec3::new(0.0, 0.20, -0.50),
                Vec3::new(0.13, 0.12, 0.11),
                Quat::IDENTITY,
                [16, 10],
                |point| (point, palette.crown.scale_colour(0.96)),
                group::HAIR_GROUP,
            );
            mesh.append_mesh(&knot);
        }
        HairCut::Bob => curtain(mesh, palette),
    }
}

/// Adds hair that hangs round the back and both sides of the head, as a shell with an outside and an inside.
fn curtain(mesh: &mut TriangleMesh, palette: &FigurePalette) {
    const CURTAIN_RIM_POINTS: usize = 26;
    let base = mesh.vertices.len();
    let rows: [[f32; 3]; 6] = [
        [0.16, 0.345, 0.0],
        [0.02, 0.385, 0.02],
        [-0.14, 0.400, 0.035],
        [-0.28, 0.395, 0.04],
        [-0.40, 0.370, 0.035],
        [-0.44, 0.340, 0.02],
    ];
    let row = |y: f32, wide: f32, mesh: &mut TriangleMesh| {
        for k in 0..CURTAIN_RIM_POINTS {
            // Leaves the face free: hair goes round from 62 degrees on one side to 298.
            let angle = (62.0 + 236.0 * k as f32 / (CURTAIN_RIM_POINTS - 1) as f32).to_radians();
            let ring_place = Vec3::new(angle.sin() * wide, y, -0.055 + angle.cos() * (wide + 0.075));
            let strand = 1.0 + 0.05 * (k as f32 * 2.3).sin();
            mesh.vertices.push(MeshVertex {
                position: ring_place,
                normal: Vec3::Z,
                colour: palette.crown.scale_colour(strand),
                group: group::HAIR_GROUP,
            });
        }
    };
    for [y, wide, _] in rows {
        row(y, wide, mesh);
    }
    // The inside follows in the opposite order, so that outside and inside form one closed profile.
    for [y, wide, _] in rows.iter().rev() {
        row(*y, wide - 0.045, mesh);
    }
    let count = rows.len() * 2;
    let vertex_index = |r: usize, k: usize| (base + (r % count) * CURTAIN_RIM_POINTS + k) as u32;
    let mut triangles = Vec::new();
    for r in 0..count {
        for k in 0..CURTAIN_RIM_POINTS - 1 {
            let (a, b, c, d) = (
                vertex_index(r, k),
                vertex_index(r, k + 1),
                vertex_index(r + 1, k + 1),
                vertex_index(r + 1, k),
            );
            triangles.extend([[a, d, c], [a, c, b]]);
        }
    }
    for (k, flip) in [(0, true), (CURTAIN_RIM_POINTS - 1, false)] {
        for r in 1..count - 1 {
            let (a, b, c) = (vertex_index(0, k), vertex_index(r, k), vertex_index(r + 1, k));
            triangles.push(if flip { [a, b, c] } else { [a, c, b] });
        }
    }
    for triangle in &mut triangles {
        triangle.swap(1, 2);
    }
    append_side_triangles(mesh, base, triangles, false);
}
