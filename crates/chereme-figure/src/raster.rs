//! Triangles to pixels: depth buffer, light, lines where one part lies before another.
//!
//! Everything is drawn several times larger than asked for and averaged. Corners are snapped to a
//! sixteenth of such a pixel and edges tested in integers, so that neighbouring triangles leave no
//! gap and the same mesh gives the same bytes.

use glam::Vec3;

use crate::camera::Camera;
use crate::image::Image;
use crate::mesh::Mesh;
use crate::palette::{Colour, Theme};

/// How a figure is lit and outlined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    /// The paper.
    pub theme: Theme,
    /// How many samples a pixel has along each side, 1 to 4.
    pub samples: usize,
    /// Towards the stronger light, as the picture's right, up and towards the eye.
    pub key_light: Vec3,
    /// Towards the weaker light, in the same way.
    pub fill_light: Vec3,
    /// The depth step from which a line is drawn within one part of the body, in metres.
    pub step: f32,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            theme: Theme::Light,
            samples: 2,
            key_light: Vec3::new(-0.45, 0.65, 0.62),
            fill_light: Vec3::new(0.80, 0.10, 0.55),
            step: 0.012,
        }
    }
}

/// The share of light that comes from everywhere, from the key and from the fill light.
const LIGHT: [f32; 3] = [0.52, 0.44, 0.16];
/// How far around a nearer part the farther one is shaded, in pixels of the finished picture.
const HALO: f32 = 2.5;
/// How dark that shade is at its darkest.
const HALO_STRENGTH: f32 = 0.38;
/// The snapping of corners: pixels are divided by this.
const SUBPIXELS: f32 = 16.0;

/// Buffers for drawing, kept from frame to frame so that nothing is allocated anew.
#[derive(Debug, Clone, Default)]
pub struct Raster {
    width: usize,
    height: usize,
    depth: Vec<f32>,
    group: Vec<u8>,
    colour: Vec<[f32; 3]>,
    corners: Vec<Corner>,
}

/// A vertex in the picture: snapped place, depth, lit colour.
#[derive(Debug, Clone, Copy)]
struct Corner {
    at: [i64; 2],
    depth: f32,
    colour: [f32; 3],
    group: u8,
    seen: bool,
}

/// A place beside a pixel: columns and rows away.
type Step = [isize; 2];

impl Raster {
    /// Draws `mesh` as `camera` sees it, `width` by `height` pixels.
    #[must_use]
    pub fn draw(&mut self, mesh: &Mesh, camera: &Camera, size: [usize; 2], style: &Style) -> Image {
        let samples = style.samples.clamp(1, 4);
        self.clear(size[0] * samples, size[1] * samples);
        let projection = camera.projection(self.width, self.height);
        self.corners.clear();
        for vertex in &mesh.vertices {
            let light = brightness(projection.turned(vertex.normal), style);
            let place = projection.project(vertex.position);
            let seen = place.depth > 1e-3 && place.x.abs() < 1e5 && place.y.abs() < 1e5;
            self.corners.push(Corner {
                at: [place.x, place.y].map(|v| (v * SUBPIXELS).round() as i64),
                depth: place.depth,
                colour: vertex.colour.0.map(|part| f32::from(part) * light),
                group: vertex.group,
                seen,
            });
        }
        for triangle in &mesh.triangles {
            self.triangle(triangle.map(|index| self.corners[index as usize]));
        }
        self.finish(size, samples, style)
    }

    fn clear(&mut self, width: usize, height: usize) {
        (self.width, self.height) = (width, height);
        let len = width * height;
        self.depth.clear();
        self.depth.resize(len, f32::INFINITY);
        self.group.clear();
        self.group.resize(len, 0);
        self.colour.resize(len, [0.0; 3]);
    }

    /// Fills the pixels whose middle is inside a triangle that faces the eye.
    fn triangle(&mut self, corners: [Corner; 3]) {
        let [a, b, c] = corners;
        let area = cross(a.at, b.at, c.at);
        if area >= 0 || !(a.seen && b.seen && c.seen) {
            return;
        }
        let unit = SUBPIXELS as i64;
        let range = |axis: usize, limit: usize| {
            let all = corners.map(|corner| corner.at[axis]);
            let low = all.iter().min().map_or(0, |v| v.div_euclid(unit)).max(0);
            let high = all.iter().max().map_or(0, |v| v.div_euclid(unit));
            (low, high.min(limit as i64 - 1))
        };
        let (columns, rows) = (range(0, self.width), range(1, self.height));
        if columns.0 > columns.1 {
            return;
        }
        let edges = [(b, c), (c, a), (a, b)];
        let along = edges.map(|(from, to)| (to.at[1] - from.at[1]) * unit);
        let weight = -1.0 / (area as f32).abs();
        for row in rows.0..=rows.1 {
            let middle = [columns.0 * unit + unit / 2, row * unit + unit / 2];
            let mut inside = edges.map(|(from, to)| cross(from.at, to.at, middle));
            let start = row as usize * self.width;
            for column in columns.0..=columns.1 {
                if inside.iter().all(|&w| w <= 0) {
                    let weights = inside.map(|w| w as f32 * weight);
                    self.pixel(start + column as usize, corners, weights);
                }
                for (w, step) in inside.iter_mut().zip(along) {
                    *w -= step;
                }
            }
        }
    }

    #[inline]
    fn pixel(&mut self, index: usize, corners: [Corner; 3], weights: [f32; 3]) {
        let [a, b, c] = corners;
        let [u, v, w] = weights;
        let depth = a.depth * u + b.depth * v + c.depth * w;
        if depth < self.depth[index] {
            self.depth[index] = depth;
            self.group[index] = a.group;
            self.colour[index] =
                std::array::from_fn(|i| a.colour[i] * u + b.colour[i] * v + c.colour[i] * w);
        }
    }

    /// Draws lines and shades, and averages the samples of each pixel.
    fn finish(&self, size: [usize; 2], samples: usize, style: &Style) -> Image {
        let mut image = Image::new(size[0], size[1], style.theme.background());
        let ink = Ink {
            paper: style.theme.background().0.map(f32::from),
            outline: style.theme.outline().0.map(f32::from),
            near: around((samples as f32 * 0.6).round().max(1.0) as isize),
            far: around((samples as f32 * HALO).round() as isize),
            step: style.step,
        };
        let share = 1.0 / (samples * samples) as f32;
        let Some((left, top, right, bottom)) = self.touched(samples) else {
            return image;
        };
        for y in top..=bottom {
            for x in left..=right {
                let mut sum = [0.0; 3];
                for sample in 0..samples * samples {
                    let (i, j) = (sample % samples, sample / samples);
                    let colour = self.sample(x * samples + i, y * samples + j, &ink);
                    for (total, part) in sum.iter_mut().zip(colour) {
                        *total += part;
                    }
                }
                let pixel = Colour(sum.map(|part| (part * share + 0.5).clamp(0.0, 255.0) as u8));
                image.set(x as i64, y as i64, pixel);
            }
        }
        image
    }

    /// Returns the first and last column and row of finished pixels that are not all paper.
    fn touched(&self, samples: usize) -> Option<(usize, usize, usize, usize)> {
        let mut found: Option<(usize, usize, usize, usize)> = None;
        for (y, row) in self.group.chunks(self.width.max(1)).enumerate() {
            let Some(first) = row.iter().position(|&group| group != 0) else {
                continue;
            };
            let last = row.iter().rposition(|&group| group != 0).unwrap_or(first);
            let (left, top, right, _) = found.unwrap_or((first, y, last, y));
            found = Some((left.min(first), top, right.max(last), y));
        }
        let (left, top, right, bottom) = found?;
        Some((
            (left / samples).saturating_sub(1),
            (top / samples).saturating_sub(1),
            (right / samples + 1).min(self.width / samples - 1),
            (bottom / samples + 1).min(self.height / samples - 1),
        ))
    }

    /// Returns the colour of one sample with its line and its shade.
    fn sample(&self, x: usize, y: usize, ink: &Ink) -> [f32; 3] {
        let index = y * self.width + x;
        let (depth, group) = (self.depth[index], self.group[index]);
        if group == 0 {
            let beside = ink.near.iter().any(|&step| self.at(x, y, step).is_some());
            return if beside { ink.outline } else { ink.paper };
        }
        let mut line = 0.0f32;
        for &step in &ink.near {
            if let Some((other, other_group)) = self.at(x, y, step) {
                let before = depth - other;
                line = line.max(match (group == other_group, before) {
                    (true, before) if before > ink.step => 0.75,
                    (false, before) if before > 0.004 => 0.9,
                    (false, before) if before > 0.0 => 0.5,
                    _ => 0.0,
                });
            }
        }
        let mut halo = 0.0f32;
        for &step in &ink.far {
            if let Some((other, _)) = self.at(x, y, step) {
                halo += ((depth - other - 0.006) * 30.0).clamp(0.0, 1.0) / 8.0;
            }
        }
        let shade = 1.0 - halo * HALO_STRENGTH;
        let colour = self.colour[index];
        std::array::from_fn(|i| colour[i] * shade * (1.0 - line) + INNER_LINE[i] * line)
    }

    /// Returns depth and group of the sample `step` away, or nothing where it is paper or outside.
    #[inline]
    fn at(&self, x: usize, y: usize, step: Step) -> Option<(f32, u8)> {
        let (x, y) = (
            x.wrapping_add_signed(step[0]),
            y.wrapping_add_signed(step[1]),
        );
        if x >= self.width || y >= self.height {
            return None;
        }
        let index = y * self.width + x;
        (self.group[index] != 0).then(|| (self.depth[index], self.group[index]))
    }
}

/// What lines and shades are drawn with.
struct Ink {
    paper: [f32; 3],
    outline: [f32; 3],
    near: [Step; 8],
    far: [Step; 8],
    step: f32,
}

/// The colour of lines within the figure.
const INNER_LINE: [f32; 3] = [34.0, 30.0, 34.0];

/// Returns the eight places `reach` samples away.
fn around(reach: isize) -> [Step; 8] {
    let slant = (reach * 3 + 2) / 4;
    [
        [reach, 0],
        [slant, slant],
        [0, reach],
        [-slant, slant],
        [-reach, 0],
        [-slant, -slant],
        [0, -reach],
        [slant, -slant],
    ]
}

/// Returns how bright a surface is whose normal is `normal` in the picture's right, up, towards.
fn brightness(normal: Vec3, style: &Style) -> f32 {
    let lit = |light: Vec3| normal.dot(light.normalize_or(Vec3::Z)).max(0.0);
    let sky = 0.5 + 0.5 * normal.y;
    let around = LIGHT[0] * (0.85 + 0.15 * sky);
    (around + LIGHT[1] * lit(style.key_light) + LIGHT[2] * lit(style.fill_light)).min(1.12)
}

/// Returns twice the signed area of a triangle in the picture, negative where it turns
/// anticlockwise to the eye (rows count downwards).
fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
