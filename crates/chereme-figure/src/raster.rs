//! Triangles to pixels: a depth buffer and light; lines and shades are added after.
//!
//! Everything is drawn several times larger than asked for and averaged. Corners are snapped to a
//! sixteenth of such a pixel and edges tested in integers, so that neighbouring triangles leave no
//! gap and the same mesh gives the same bytes.

use std::ops::Range;

use glam::Vec3;

use crate::body::group::FLAT;
use crate::camera::Camera;
use crate::image::Image;
use crate::ink;
use crate::mesh::Mesh;
use crate::palette::Theme;

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
    /// How many threads draw, at least one; the picture is the same.
    pub threads: usize,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            theme: Theme::Light,
            samples: 2,
            key_light: Vec3::new(-0.42, 0.52, 0.75),
            fill_light: Vec3::new(0.80, 0.10, 0.55),
            step: 0.012,
            threads: 1,
        }
    }
}

/// The share of light that comes from everywhere, from the key and from the fill light.
const LIGHT: [f32; 3] = [0.52, 0.44, 0.16];
/// How much nearer than what hides it a veiled layer has to be, in metres, so that what hardly moved
/// does not come through.
const VEIL: f32 = 0.015;
/// The snapping of corners: pixels are divided by this.
const SUBPIXELS: f32 = 16.0;
/// How far outside the picture a corner may lie, in samples; triangles beyond are left out.
const FAR_OUT: f32 = 1e6;
/// The nearest that anything is drawn whatever the camera says, in metres before the eye.
const NEAREST: f32 = 1e-3;

/// Buffers for drawing, kept from picture to picture so that nothing is allocated anew.
#[derive(Debug, Clone, Default)]
pub struct Raster {
    pub(crate) buffers: Buffers,
    corners: Vec<Corner>,
    /// The depths of the last layer that was not veiled.
    solid: Vec<f32>,
}

/// Something drawn over what is in the picture already.
#[derive(Debug, Clone, Copy)]
pub struct Layer<'a> {
    /// Its surface.
    pub mesh: &'a Mesh,
    /// How much of what lies below it hides, from 0 to 1.
    pub opacity: f32,
    /// Whether it is hidden where the last layer that is not so lies nearer to the eye.
    pub veiled: bool,
}

/// What is nearest at every sample; a margin of paper all around saves the test for the edge.
#[derive(Debug, Clone, Default)]
pub(crate) struct Buffers {
    /// Columns and rows of samples, the margin not counted.
    pub(crate) size: [usize; 2],
    pub(crate) margin: usize,
    pub(crate) stride: usize,
    /// Distance from the eye in metres; infinite where there is paper.
    pub(crate) depth: Vec<f32>,
    /// The part of the body; 0 is paper.
    pub(crate) group: Vec<u8>,
    /// The lit colour; meaningless where there is paper.
    pub(crate) colour: Vec<[f32; 3]>,
    /// Columns and rows of samples outside of which all is paper.
    pub(crate) used: [Range<usize>; 2],
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

impl Raster {
    /// Draws `mesh` as `camera` sees it, `size` being columns and rows of pixels.
    #[must_use]
    pub fn draw(&mut self, mesh: &Mesh, camera: &Camera, size: [usize; 2], style: &Style) -> Image {
        let mut image = Image::new(size[0], size[1], style.theme.background());
        let layer = Layer {
            mesh,
            opacity: 1.0,
            veiled: false,
        };
        self.draw_over(&mut image, layer, camera, style);
        image
    }

    /// Draws a layer as `camera` sees it over what is in `image`.
    pub fn draw_over(
        &mut self,
        image: &mut Image,
        layer: Layer<'_>,
        camera: &Camera,
        style: &Style,
    ) {
        let samples = style.samples.clamp(1, 4);
        let size = [image.width(), image.height()];
        self.buffers
            .clear(size.map(|side| side * samples), ink::margin(samples));
        self.project(layer.mesh, camera, style);
        self.fill(layer.mesh, style.threads);
        if layer.veiled {
            self.buffers.veil(&self.solid);
        }
        ink::finish(&self.buffers, image, samples, style, layer.opacity);
        if !layer.veiled {
            std::mem::swap(&mut self.solid, &mut self.buffers.depth);
        }
    }

    /// Fills all triangles, each thread those samples that lie in its own rows.
    fn fill(&mut self, mesh: &Mesh, threads: usize) {
        let corners = &self.corners;
        let paint = |mut band: Band<'_>| {
            for triangle in &mesh.triangles {
                band.triangle(triangle.map(|index| &corners[index as usize]));
            }
        };
        let mut bands = self.buffers.bands(threads.max(1));
        let last = bands.pop();
        std::thread::scope(|scope| {
            for band in bands {
                scope.spawn(|| paint(band));
            }
            last.map(paint);
        });
    }

    fn project(&mut self, mesh: &Mesh, camera: &Camera, style: &Style) {
        let [width, height] = self.buffers.size;
        let projection = camera.projection(width, height);
        let lights = [style.key_light, style.fill_light].map(|light| light.normalize_or(Vec3::Z));
        let corners = mesh.vertices.iter().map(|vertex| {
            let light = brightness(projection.turned(vertex.normal), lights);
            let place = projection.project(vertex.position);
            let inside = place.x.abs() < FAR_OUT && place.y.abs() < FAR_OUT;
            Corner {
                at: [place.x, place.y].map(|v| (v * SUBPIXELS + 0.5).floor() as i64),
                depth: place.depth,
                colour: vertex.colour.0.map(|part| {
                    let part = f32::from(part);
                    if vertex.group >= FLAT {
                        part
                    } else {
                        part * light
                    }
                }),
                group: vertex.group,
                seen: place.depth > camera.near.max(NEAREST) && inside,
            }
        });
        self.corners.clear();
        self.corners.extend(corners);
        self.buffers.used = [0, 1].map(|axis| {
            let seen = self.corners.iter().filter(|corner| corner.seen);
            let places = seen.map(|corner| corner.at[axis].div_euclid(SUBPIXELS as i64));
            let (low, high) = places.fold((i64::MAX, -1), |(low, high), at| {
                (low.min(at), high.max(at))
            });
            let inside = |at: i64| at.clamp(0, self.buffers.size[axis] as i64) as usize;
            inside(low)..inside(high + 1)
        });
    }
}

impl Buffers {
    fn clear(&mut self, size: [usize; 2], margin: usize) {
        self.size = size;
        self.margin = margin;
        self.stride = size[0] + 2 * margin;
        let len = self.stride * (size[1] + 2 * margin);
        self.depth.clear();
        self.depth.resize(len, f32::INFINITY);
        self.group.clear();
        self.group.resize(len, 0);
        self.colour.resize(len, [0.0; 3]);
    }

    /// Returns the place of a sample in the buffers.
    #[inline]
    pub(crate) fn index(&self, x: usize, y: usize) -> usize {
        (y + self.margin) * self.stride + x + self.margin
    }

    /// Takes away what lies behind `solid`, depths of the same picture.
    fn veil(&mut self, solid: &[f32]) {
        let samples = self.depth.iter_mut().zip(&mut self.group).zip(solid);
        for ((depth, group), before) in samples {
            if *before < *depth + VEIL {
                *depth = f32::INFINITY;
                *group = 0;
            }
        }
    }

    /// Parts the rows of samples into `count` bands, fewer where there are few rows.
    fn bands(&mut self, count: usize) -> Vec<Band<'_>> {
        let height = self.size[1];
        let each = height.div_ceil(count).max(1);
        let skip = self.margin * self.stride;
        let mut depth = &mut self.depth[skip..];
        let mut group = &mut self.group[skip..];
        let mut colour = &mut self.colour[skip..];
        let mut bands = Vec::with_capacity(count);
        for first in (0..height).step_by(each) {
            let rows = each.min(height - first);
            let len = rows * self.stride;
            let band;
            (band, depth) = depth.split_at_mut(len);
            let groups;
            (groups, group) = group.split_at_mut(len);
            let colours;
            (colours, colour) = colour.split_at_mut(len);
            bands.push(Band {
                first,
                rows,
                width: self.size[0],
                margin: self.margin,
                stride: self.stride,
                depth: band,
                group: groups,
                colour: colours,
            });
        }
        bands
    }
}

/// Some rows of the buffers.
struct Band<'a> {
    first: usize,
    rows: usize,
    width: usize,
    margin: usize,
    stride: usize,
    depth: &'a mut [f32],
    group: &'a mut [u8],
    colour: &'a mut [[f32; 3]],
}

impl Band<'_> {
    /// Fills the samples whose middle is inside a triangle that faces the eye.
    fn triangle(&mut self, corners: [&Corner; 3]) {
        let [a, b, c] = corners;
        let area = cross(a.at, b.at, c.at);
        if area >= 0 || !(a.seen && b.seen && c.seen) {
            return;
        }
        let unit = SUBPIXELS as i64;
        let range = |axis: usize, first: usize, count: usize| {
            let [a, b, c] = [a, b, c].map(|corner| corner.at[axis]);
            let low = (a.min(b).min(c) - unit / 2).div_euclid(unit);
            let high = (a.max(b).max(c) + unit / 2).div_euclid(unit);
            let first = first as i64;
            (low.max(first), high.min(first + count as i64 - 1))
        };
        let rows = range(1, self.first, self.rows);
        if rows.0 > rows.1 {
            return;
        }
        let columns = range(0, 0, self.width);
        if columns.0 > columns.1 {
            return;
        }
        let edges = [(b, c), (c, a), (a, b)];
        let across = edges.map(|(from, to)| (to.at[1] - from.at[1]) * unit);
        let down = edges.map(|(from, to)| (to.at[0] - from.at[0]) * unit);
        let middle = [columns.0 * unit + unit / 2, rows.0 * unit + unit / 2];
        let mut first = edges.map(|(from, to)| cross(from.at, to.at, middle));
        let share = 1.0 / area as f32;
        let wide = columns.1 - columns.0;
        for row in rows.0..=rows.1 {
            let (from, to) = span(first, across, wide);
            if from <= to {
                let row = row as usize - self.first;
                let start = row * self.stride + self.margin + (columns.0 + from) as usize;
                let mut inside = [0, 1, 2].map(|i| first[i] - across[i] * from);
                for offset in 0..=(to - from) as usize {
                    self.sample(start + offset, corners, inside.map(|w| w as f32 * share));
                    for i in 0..3 {
                        inside[i] -= across[i];
                    }
                }
            }
            for i in 0..3 {
                first[i] += down[i];
            }
        }
    }

    #[inline]
    fn sample(&mut self, index: usize, [a, b, c]: [&Corner; 3], [u, v, w]: [f32; 3]) {
        let depth = a.depth * u + b.depth * v + c.depth * w;
        if depth < self.depth[index] {
            self.depth[index] = depth;
            self.group[index] = a.group;
            self.colour[index] =
                std::array::from_fn(|i| a.colour[i] * u + b.colour[i] * v + c.colour[i] * w);
        }
    }
}

/// Returns the first and the last of columns 0 to `wide` whose three edge values, `first` less
/// `across` times the column, are none positive; the first exceeds the last where there is none.
#[inline]
fn span(first: [i64; 3], across: [i64; 3], wide: i64) -> (i64, i64) {
    let (mut from, mut to) = (0, wide);
    for (value, step) in first.into_iter().zip(across) {
        if step > 0 && value > 0 {
            from = from.max((value + step - 1) / step);
        } else if step < 0 && value <= 0 {
            to = to.min(value / step);
        } else if value > 0 {
            return (1, 0);
        }
    }
    (from, to)
}

/// Returns how bright a surface is whose normal is `normal` in the picture's right, up, towards.
fn brightness(normal: Vec3, [key, fill]: [Vec3; 2]) -> f32 {
    let sky = 0.5 + 0.5 * normal.y;
    let around = LIGHT[0] * (0.85 + 0.15 * sky);
    let lit = LIGHT[1] * normal.dot(key).max(0.0) + LIGHT[2] * normal.dot(fill).max(0.0);
    (around + lit).min(1.12)
}

/// Returns twice the signed area of a triangle in the picture, negative where it turns
/// anticlockwise to the eye (rows count downwards).
#[inline]
fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
#[path = "raster_tests.rs"]
mod tests;
