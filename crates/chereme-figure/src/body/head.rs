//! An egg-shaped head, with the features that show its direction: eyes, brows, nose, mouth, crown.

use std::f32::consts::FRAC_PI_2;

use chereme_motion::Face;
use glam::{Mat3, Quat, Vec3};

use super::features::Features;
use super::group;
use super::shape::ellipsoid;
use crate::mesh::Mesh;
use crate::palette::{Colour, Palette};

/// The head's place and measures in the space of its joint.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Head {
    /// The middle between chin and crown.
    pub(super) centre: Vec3,
    /// From chin to crown, in metres.
    pub(super) height: f32,
    /// The signer's left, up and forwards.
    pub(super) axes: Mat3,
}

/// Half the width, height and depth of a head relative to its height, as in the anatomy's landmarks.
const RADII: Vec3 = Vec3::new(0.345, 0.5, 0.42);

impl Head {
    /// Returns the head's surface in the space of its joint, with its facial expression. Every expression
    /// has the same vertices in the same order.
    pub(super) fn mesh(&self, palette: &Palette, face: &Face) -> Mesh {
        let face = Features::of(face);
        let turn = Quat::from_mat3(&self.axes);
        let radii = RADII * self.height;
        // Turning puts the rings' poles at crown and chin instead of the ears.
        let upright = Quat::from_rotation_x(-FRAC_PI_2);
        let mut mesh = ellipsoid(
            self.centre,
            Vec3::ONE,
            turn,
            [32, 24],
            |point| {
                let point = upright * point;
                (face.formed(point) * radii, crown_or_face(point, palette))
            },
            group::HEAD,
        );
        for mark in marks(palette, &face) {
            mesh.append(&self.mark(&mark, turn));
        }
        let surface = |at: [f32; 2], out: f32| {
            self.centre + turn * (face.surface(at) * RADII + Vec3::Z * out) * self.height
        };
        face.mouth(palette).add(&mut mesh, surface);
        mesh
    }

    fn mark(&self, mark: &Mark, turn: Quat) -> Mesh {
        let centre = self.centre + turn * (surface(mark.at) + Vec3::Z * mark.out) * self.height;
        let tilt =
            turn * Quat::from_rotation_y(mark.at[0] * 0.8) * Quat::from_rotation_z(mark.tilt);
        ellipsoid(
            centre,
            mark.radii * self.height,
            tilt,
            [14, 8],
            |point| match mark.form {
                Form::Whole => (point, mark.colour),
                Form::Lid { edge, lash } => {
                    let point = Quat::from_rotation_x(-FRAC_PI_2) * point;
                    let colour = if point.y < -0.6 { lash } else { mark.colour };
                    (cap(point, edge), colour)
                }
            },
            group::HEAD,
        )
    }
}

/// Returns the point of a resting head's surface at `at` (to the signer's left, up) on the unit sphere, in
/// units of the head's height.
fn surface([x, y]: [f32; 2]) -> Vec3 {
    let z = (1.0 - x * x - y * y).max(0.0).sqrt();
    egg(Vec3::new(x, y, z)) * RADII
}

/// Projects a point of the unit sphere onto the part of it above `edge`, closed by a disc there.
fn cap(point: Vec3, edge: f32) -> Vec3 {
    let y = edge + (point.y + 1.0) * 0.5 * (1.0 - edge);
    let around = Vec3::new(point.x, 0.0, point.z).normalize_or_zero();
    around * (1.0 - y * y).max(0.0).sqrt() + Vec3::Y * y
}

/// Maps a point of the unit sphere onto an egg with its narrow end down.
pub(super) fn egg(point: Vec3) -> Vec3 {
    let low = (-point.y).max(0.0);
    let narrow = 1.0 - 0.30 * low * low;
    let jaw = if point.z > 0.0 {
        0.06 * low
    } else {
        -0.25 * low
    };
    Vec3::new(point.x * narrow, point.y, point.z * narrow + jaw)
}

fn crown_or_face(point: Vec3, palette: &Palette) -> Colour {
    let behind = point.y * 0.62 - point.z * 0.80 - 0.13;
    let low = (-0.45 - point.y) * 2.0;
    let share = (behind.min(-low) * 6.0 + 0.5).clamp(0.0, 1.0);
    palette.face.mixed(palette.crown, share)
}

/// A small form on the face, in units of the head's height.
struct Mark {
    /// Position on the unit sphere: towards the signer's left, and up.
    at: [f32; 2],
    /// Distance of its middle from the surface.
    out: f32,
    radii: Vec3,
    tilt: f32,
    colour: Colour,
    form: Form,
}

/// The visible part of a mark's ellipsoid.
enum Form {
    Whole,
    /// The part above an edge that has lashes.
    Lid {
        edge: f32,
        lash: Colour,
    },
}

fn marks(palette: &Palette, face: &Features) -> Vec<Mark> {
    let mark = |at, out, radii: [f32; 3], colour| Mark {
        at,
        out,
        radii: Vec3::from_array(radii),
        tilt: 0.0,
        colour,
        form: Form::Whole,
    };
    let skin = palette.face.scaled(0.93);
    let wrinkled = face.nose;
    let nose = [
        0.042 * (1.0 + 0.2 * wrinkled),
        0.085 * (1.0 - 0.15 * wrinkled),
        0.055,
    ];
    let mut all = vec![mark([0.0, -0.19 + 0.04 * wrinkled], 0.012, nose, skin)];
    for (n, side) in [-1.0, 1.0].into_iter().enumerate() {
        let (lid, brow) = (face.lids[n], face.brows[n]);
        let wide = (-lid).max(0.0);
        let eye = [0.063, 0.039 * (1.0 + 0.4 * wide), 0.026];
        let edge = if lid > 0.0 {
            0.60 - 1.42 * lid
        } else {
            0.60 + 0.35 * wide
        };
        let [aside, up] = face.gaze;
        let pupil = [side * 0.385 + 0.09 * aside, 0.04 * up];
        all.push(mark([side * 0.99, -0.08], 0.0, [0.035, 0.085, 0.045], skin));
        all.push(mark([side * 0.39, 0.0], -0.012, eye, palette.eyes));
        all.push(mark(pupil, 0.006, [0.027, 0.030, 0.018], palette.marks));
        all.push(Mark {
            form: Form::Lid {
                edge,
                lash: palette.marks.mixed(palette.face, 0.25),
            },
            ..mark(
                [side * 0.39, 0.0],
                -0.010,
                [eye[0] + 0.006, eye[1] + 0.006, eye[2] + 0.014],
                skin,
            )
        });
        all.push(Mark {
            tilt: side * (0.38 * face.frown - 0.02),
            ..mark(
                [
                    side * (0.40 - 0.05 * face.frown),
                    0.19 + 0.13 * brow.max(0.0) + 0.07 * brow.min(0.0) - 0.03 * face.frown,
                ],
                0.002 + 0.006 * face.frown,
                [0.080, 0.013, 0.020],
                palette.marks.mixed(palette.crown, 0.4),
            )
        });
    }
    all
}
