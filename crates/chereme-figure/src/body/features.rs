//! Facial expressions as deformations of a head: jaw, cheeks and mouth.

use std::f32::consts::TAU;

use chereme_motion::Face;
use glam::{Vec2, Vec3};

use super::group;
use super::head::egg;
use crate::mesh::{Mesh, Vertex, smooth};
use crate::palette::{Colour, Palette};

/// A [`Face`] in the figure's numbers.
pub(super) struct Features {
    pub(super) brows: [f32; 2],
    pub(super) frown: f32,
    pub(super) lids: [f32; 2],
    /// The direction of gaze: to the signer's left, and up.
    pub(super) gaze: [f32; 2],
    pub(super) nose: f32,
    jaw: f32,
    aside: f32,
    parted: f32,
    wide: f32,
    corners: [f32; 2],
    pressed: f32,
    pout: f32,
    teeth: f32,
    tongue: f32,
    tongue_aside: f32,
    cheeks: [f32; 2],
}

/// How far the chin moves down with the jaw, relative to half the head's height.
const CHIN: f32 = 0.20;
/// Height of the line between the lips at rest, on the unit sphere.
const LIPS: f32 = -0.56;

impl Features {
    pub(super) fn of(face: &Face) -> Self {
        let number = |number: f64| {
            if number.is_finite() {
                number.clamp(-1.0, 1.0) as f32
            } else {
                0.0
            }
        };
        let only_up = |it: f64| number(it).max(0.0);
        Self {
            brows: face.brows.map(number),
            frown: only_up(face.frown),
            lids: face.lids.map(number),
            gaze: face.gaze.map(number),
            nose: only_up(face.nose),
            jaw: only_up(face.jaw),
            aside: number(face.aside),
            parted: only_up(face.parted),
            wide: number(face.wide),
            corners: face.corners.map(number),
            pressed: only_up(face.pressed),
            pout: only_up(face.pout),
            teeth: only_up(face.teeth),
            tongue: only_up(face.tongue),
            tongue_aside: number(face.tongue_aside),
            cheeks: face.cheeks.map(number),
        }
    }

    /// Returns the position on the head of a point of the unit sphere, with the current jaw and cheeks.
    pub(super) fn formed(&self, point: Vec3) -> Vec3 {
        let mut formed = egg(point);
        if point.z <= 0.0 {
            return formed;
        }
        let front = (point.z * 3.0).min(1.0);
        let low = ((-0.40 - point.y) / 0.5).clamp(0.0, 1.0);
        let low = low * low * (3.0 - 2.0 * low) * front;
        formed.y -= CHIN * self.jaw * low;
        formed.x += 0.08 * self.aside * low;
        for (cheek, side) in self.cheeks.into_iter().zip([-1.0, 1.0]) {
            let off = Vec2::new(point.x - side * 0.56, point.y + 0.45).length_squared();
            let much = cheek * (-off / 0.07).exp() * front;
            formed.x += side * 0.14 * much;
            formed.z += 0.14 * much;
        }
        formed
    }

    /// Returns the point of the head's surface at `at` (to the signer's left, up) on a resting head's unit
    /// sphere.
    pub(super) fn surface(&self, [x, y]: [f32; 2]) -> Vec3 {
        let on_sphere = |y: f32| Vec3::new(x, y, (1.0 - x * x - y * y).max(0.0).sqrt());
        // Find the point that the jaw lowers to this height.
        let mut above = y;
        for _ in 0..4 {
            let lowered = above - self.formed(on_sphere(above)).y;
            above = (y + lowered).min(1.0);
        }
        let formed = self.formed(on_sphere(above));
        Vec3::new(egg(on_sphere(y)).x, y, formed.z)
    }

    /// Returns the open part of the mouth, with lips, teeth and tongue.
    pub(super) fn mouth(&self, palette: &Palette) -> Mouth {
        let shut = 1.0 - self.pressed;
        let narrow = (-self.wide).max(0.0);
        let width = 0.265 * (1.0 + 0.28 * self.wide.max(0.0) - 0.55 * narrow);
        let jaw = 0.26 * self.jaw * shut;
        let up = (0.030 * self.parted + 0.03 * self.nose) * shut;
        let down = 0.055 * self.parted * shut + jaw;
        let full = (1.0 - 0.7 * self.pressed) * (1.0 + 0.6 * self.pout);
        Mouth {
            middle: [0.03 * self.aside, LIPS - 0.3 * down],
            width,
            open: [up + 0.3 * down, 0.7 * down],
            lips: [0.030 * full, 0.040 * full],
            corners: self.corners.map(|corner| corner * 0.075),
            aside: 0.05 * self.aside,
            out: 0.035 * self.pout,
            teeth: self.teeth,
            tongue: self.tongue,
            tongue_aside: self.tongue_aside,
            colours: Colours {
                lips: palette.mouth,
                inside: palette.mouth.scaled(0.35),
                teeth: palette.eyes,
                tongue: palette.mouth.mixed(palette.face, 0.35),
            },
        }
    }
}

/// A mouth on the unit sphere of the head; `out` of its surface in units of the head's height.
pub(super) struct Mouth {
    middle: [f32; 2],
    /// Half its width.
    width: f32,
    /// The opening above and below the middle.
    open: [f32; 2],
    /// Thickness of the upper and the lower lip.
    lips: [f32; 2],
    /// Height of the raised right and left corner.
    corners: [f32; 2],
    /// Offset of the lower lip to the left of the upper one.
    aside: f32,
    out: f32,
    teeth: f32,
    tongue: f32,
    tongue_aside: f32,
    colours: Colours,
}

struct Colours {
    lips: Colour,
    inside: Colour,
    teeth: Colour,
    tongue: Colour,
}

/// Depth behind the surface at which pieces of the mouth are closed.
const BEHIND: f32 = 0.03;
/// The number of corners around the mouth.
const AROUND: usize = 24;
/// The number of corners along the teeth.
const ALONG: usize = 11;

impl Mouth {
    /// Adds the mouth to a mesh; `surface(at, out)` returns a position at a distance out of the head's
    /// surface.
    pub(super) fn add(&self, mesh: &mut Mesh, surface: impl Fn([f32; 2], f32) -> Vec3) {
        self.lips(mesh, &surface);
        self.row_of_teeth(mesh, &surface);
        self.tongue(mesh, &surface);
    }

    /// Returns a place of the mouth: `at` along its half width and up from its middle.
    fn place(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let far = (x / self.width.max(1e-3)).clamp(-1.2, 1.2);
        let corner = self.corners[usize::from(x > 0.0)] * far.abs().powf(1.5);
        let lower = if y < 0.0 { 1.0 } else { 0.3 };
        [
            self.middle[0] + x + self.aside * lower,
            self.middle[1] + y + corner,
        ]
    }

    fn lips(&self, mesh: &mut Mesh, surface: &impl Fn([f32; 2], f32) -> Vec3) {
        let Colours { lips, inside, .. } = self.colours;
        let rings: [(f32, f32, f32, Colour); 5] = [
            (0.5, 0.0, 0.006, inside),
            (1.0, 0.0, 0.008, inside),
            (1.0, 0.0, 0.008, lips),
            (1.0, 0.5, 0.018, lips),
            (1.0, 1.0, 0.001, lips),
        ];
        let mut patch = Patch::default();
        patch.vertex(surface(self.place([0.0, 0.0]), 0.006 + self.out), inside);
        for (open, lip, out, colour) in rings {
            for step in 0..AROUND {
                let (sine, cosine) = (TAU * step as f32 / AROUND as f32).sin_cos();
                let half = usize::from(sine < 0.0);
                let tall = self.open[half] * open + self.lips[half] * lip;
                let wide = self.width * (0.9 * open + 0.1 * lip);
                let at = self.place([wide * cosine, tall * sine]);
                patch.vertex(surface(at, out + self.out), colour);
            }
        }
        let around = AROUND as u32;
        for step in 0..around {
            let next = (step + 1) % around;
            patch.triangles.push([0, 1 + step, 1 + next]);
            for ring in 0..4 {
                let (a, b) = (1 + ring * around, 1 + (ring + 1) * around);
                patch.quad([a + step, b + step, b + next, a + next]);
            }
        }
        let behind = surface(self.place([0.0, 0.0]), -BEHIND);
        let rim = 1 + 4 * around..1 + 5 * around;
        patch.append_to(mesh, rim.collect(), behind);
    }

    fn row_of_teeth(&self, mesh: &mut Mesh, surface: &impl Fn([f32; 2], f32) -> Vec3) {
        let mut patch = Patch::default();
        for row in [1.0, 0.0] {
            for step in 0..ALONG {
                let x = (step as f32 / (ALONG - 1) as f32 * 2.0 - 1.0) * 0.86;
                let round = (1.0 - x * x).sqrt();
                let (top, gap) = (self.open[0] * round, (self.open[0] + self.open[1]) * round);
                let tall = (gap * 0.85).min(0.06) * self.teeth;
                let y = top - tall * (1.0 - row);
                let at = self.place([self.width * 0.9 * x, y]);
                patch.vertex(surface(at, 0.0085 + self.out), self.colours.teeth);
            }
        }
        let along = ALONG as u32;
        for step in 0..along - 1 {
            patch.quad([step + 1, step, along + step, along + step + 1]);
        }
        let behind = surface(self.place([0.0, 0.0]), -BEHIND);
        let rim = (along..2 * along).chain((0..along).rev());
        patch.append_to(mesh, rim.collect(), behind);
    }

    fn tongue(&self, mesh: &mut Mesh, surface: &impl Fn([f32; 2], f32) -> Vec3) {
        let out = self.tongue;
        let visible = (out * 6.0).min(1.0);
        let half = (self.width * 0.5).min(0.15) * visible;
        let root = -self.open[1] * 0.4;
        let long = 0.05 * visible + 0.20 * out;
        let mut patch = Patch::default();
        patch.vertex(
            surface(self.place([0.0, root]), 0.0095 + self.out),
            self.colours.tongue,
        );
        for ring in [0.5, 1.0] {
            for step in 0..AROUND {
                let (sine, cosine) = (TAU * step as f32 / AROUND as f32).sin_cos();
                let below = (-sine).max(0.0);
                let x = half * ring * cosine + self.tongue_aside * 0.14 * visible * below;
                let y = root
                    + ring
                        * if sine < 0.0 {
                            long * sine
                        } else {
                            0.03 * visible * sine
                        };
                let lift = (0.010 + 0.05 * out * below) * (1.5 - ring);
                let at = self.place([x, y]);
                patch.vertex(
                    surface(at, 0.0095 + self.out + lift * visible),
                    self.colours.tongue,
                );
            }
        }
        let around = AROUND as u32;
        for step in 0..around {
            let next = (step + 1) % around;
            patch.triangles.push([0, 1 + step, 1 + next]);
            patch.quad([1 + step, 1 + around + step, 1 + around + next, 1 + next]);
        }
        let behind = surface(self.place([0.0, root]), -BEHIND);
        patch.append_to(mesh, (1 + around..1 + 2 * around).collect(), behind);
    }
}

/// A piece of the face's surface, seen from the front.
#[derive(Default)]
struct Patch {
    vertices: Vec<Vertex>,
    triangles: Vec<[u32; 3]>,
}

impl Patch {
    fn vertex(&mut self, position: Vec3, colour: Colour) {
        self.vertices.push(Vertex {
            position,
            normal: Vec3::Z,
            colour,
            group: group::HEAD,
        });
    }

    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// Appends the piece, closed by a cone from its rim, which runs anticlockwise, to a point behind it.
    fn append_to(mut self, mesh: &mut Mesh, rim: Vec<u32>, behind: Vec3) {
        smooth(&mut self.vertices, &self.triangles, 0);
        let tip = self.vertices.len() as u32;
        self.vertex(behind, self.vertices[0].colour);
        let following = rim.iter().cycle().skip(1);
        let cone = rim
            .iter()
            .zip(following)
            .map(|(&from, &to)| [tip, to, from]);
        self.triangles.extend(cone);
        mesh.append(&Mesh {
            vertices: self.vertices,
            triangles: self.triangles,
        });
    }
}
