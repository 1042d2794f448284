//! A head like an egg, with what tells where it looks: eyes, brows, nose, mouth, crown.

use glam::{Mat3, Quat, Vec3};

use super::group;
use super::shape::ellipsoid;
use crate::mesh::Mesh;
use crate::palette::{Colour, Palette};

/// The head's place and measures in the space of its joint.
pub(super) struct Head {
    /// The middle between chin and crown.
    pub(super) centre: Vec3,
    /// From chin to crown, in metres.
    pub(super) height: f32,
    /// The signer's left, up and forwards.
    pub(super) axes: Mat3,
}

/// Half the width, height and depth of a head beside its height, as the anatomy's landmarks have it.
const RADII: Vec3 = Vec3::new(0.345, 0.5, 0.42);

impl Head {
    /// Returns the head's surface in the space of its joint.
    pub(super) fn mesh(&self, palette: &Palette) -> Mesh {
        let turn = Quat::from_mat3(&self.axes);
        let skull = |point: Vec3| {
            let colour = crown_or_face(point, palette);
            (egg(point), colour)
        };
        let radii = RADII * self.height;
        // The rings' poles lie on the ears' axis otherwise; turning puts them at crown and chin.
        let upright = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
        let mut mesh = ellipsoid(
            self.centre,
            Vec3::ONE,
            turn,
            [32, 24],
            |point| {
                let (formed, colour) = skull(upright * point);
                (formed * radii, colour)
            },
            group::HEAD,
        );
        for mark in marks(palette) {
            mesh.append(&self.mark(&mark, turn));
        }
        mesh
    }

    fn mark(&self, mark: &Mark, turn: Quat) -> Mesh {
        let [x, y] = mark.at;
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let surface = egg(Vec3::new(x, y, z)) * RADII + Vec3::Z * mark.out;
        let centre = self.centre + turn * surface * self.height;
        let tilt = turn * Quat::from_rotation_y(x * 0.8) * Quat::from_rotation_z(mark.tilt);
        let colour = mark.colour;
        ellipsoid(
            centre,
            mark.radii * self.height,
            tilt,
            [14, 8],
            |point| (point, colour),
            group::HEAD,
        )
    }
}

/// Returns a point of the unit sphere moved to where an egg with its narrow end down has it.
fn egg(point: Vec3) -> Vec3 {
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
    /// Place on the unit sphere: towards the signer's left, and up.
    at: [f32; 2],
    /// How far out of the surface its middle lies.
    out: f32,
    radii: Vec3,
    tilt: f32,
    colour: Colour,
}

fn marks(palette: &Palette) -> Vec<Mark> {
    let mut all = vec![
        Mark {
            at: [0.0, -0.19],
            out: 0.012,
            radii: Vec3::new(0.042, 0.085, 0.055),
            tilt: 0.0,
            colour: palette.face.scaled(0.93),
        },
        Mark {
            at: [0.0, -0.56],
            out: -0.004,
            radii: Vec3::new(0.095, 0.020, 0.022),
            tilt: 0.0,
            colour: palette.mouth,
        },
    ];
    for side in [-1.0, 1.0] {
        all.push(Mark {
            at: [side * 0.99, -0.08],
            out: 0.0,
            radii: Vec3::new(0.035, 0.085, 0.045),
            tilt: 0.0,
            colour: palette.face.scaled(0.93),
        });
        all.push(Mark {
            at: [side * 0.39, 0.0],
            out: -0.012,
            radii: Vec3::new(0.060, 0.036, 0.026),
            tilt: 0.0,
            colour: palette.eyes,
        });
        all.push(Mark {
            at: [side * 0.385, 0.0],
            out: 0.006,
            radii: Vec3::new(0.027, 0.030, 0.018),
            tilt: 0.0,
            colour: palette.marks,
        });
        all.push(Mark {
            at: [side * 0.40, 0.19],
            out: 0.002,
            radii: Vec3::new(0.080, 0.013, 0.020),
            tilt: -side * 0.02,
            colour: palette.marks.mixed(palette.crown, 0.4),
        });
    }
    all
}
