//! Rasterises triangles with a depth buffer and light; lines and shades are added afterwards.
//!
//! Everything is drawn several times larger than requested and averaged. Corners are snapped to a
//! sixteenth of such a pixel and edges tested in integers, so that neighbouring triangles leave no gap and
//! the same mesh gives the same bytes.

use std::ops::Range;

use glam::Vec3;
use pulp::{Arch, NullaryFnOnce};

use crate::body::group::FIRST_FLAT_GROUP;
use crate::buffers::{SampleBuffers, stored_colour_byte};
use crate::camera::{CameraProjection, FigureCamera};
use crate::fill::{self, SUBPIXEL_STEPS, TriangleCorner};
use crate::image::RasterImage;
use crate::ink;
use crate::mesh::{MeshVertex, TriangleMesh};
use crate::palette::PaperTheme;

/// Light and outlines of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FigureStyle {
    /// The paper.
    pub theme: PaperTheme,
    /// The number of samples per pixel along each side, 1 to 4.
    pub samples: usize,
    /// Direction of the stronger light: the picture's right, up and towards the eye.
    pub key_light: Vec3,
    /// Direction of the weaker light, in the same axes.
    pub fill_light: Vec3,
    /// The depth step from which a line is drawn within one part of the body, in metres.
    pub step: f32,
    /// Half the width of a line, in pixels of the finished picture.
    pub line: f32,
    /// The number of drawing threads, at least one; it does not change the picture.
    pub threads: usize,
}

impl Default for FigureStyle {
    fn default() -> Self {
        Self {
            theme: PaperTheme::Light,
            samples: 2,
            key_light: Vec3::new(-0.42, 0.52, 0.75),
            fill_light: Vec3::new(0.80, 0.10, 0.55),
            step: 0.012,
            line: 0.6,
            threads: 1,
        }
    }
}

/// Shares of ambient light, key light and fill light.
const LIGHT_SHARES: [f32; 3] = [0.60, 0.42, 0.15];
/// The share of light from behind along the rim, most at the top.
const RIM_LIGHT_SHARE: f32 = 0.16;
/// Largest distance of a corner from the picture, in samples; triangles beyond are left out.
const FAR_OUT: f32 = 1e6;
/// Smallest drawing distance for any camera, in metres before the eye.
const NEAREST_DRAWING_METRES: f32 = 1e-3;

/// Buffers for drawing, reused from picture to picture to save allocations.
#[derive(Debug, Clone, Default)]
pub struct FigureRaster {
    pub(crate) buffers: SampleBuffers,
    corners: Vec<TriangleCorner>,
}

/// A surface to draw over the current picture.
#[derive(Debug, Clone, Copy)]
pub struct RasterLayer<'a> {
    /// Its surface.
    pub mesh: &'a TriangleMesh,
    /// The share of the background that it hides, from 0 to 1.
    pub opacity: f32,
    /// Whether it is drawn only in front of the last layer that is not veiled.
    pub veiled: bool,
}

impl FigureRaster {
    /// Draws `mesh` as seen by `camera`; `size` is columns and rows of pixels.
    #[must_use]
    pub fn draw_mesh_picture(
        &mut self,
        mesh: &TriangleMesh,
        camera: &FigureCamera,
        size: [usize; 2],
        style: &FigureStyle,
    ) -> RasterImage {
        let mut image = RasterImage::new(size[0], size[1], style.theme.theme_paper_colour());
        let layer = RasterLayer {
            mesh,
            opacity: 1.0,
            veiled: false,
        };
        self.draw_over(&mut image, layer, camera, style);
        image
    }

    /// Draws a layer as seen by `camera` over the contents of `image`.
    pub fn draw_over(
        &mut self,
        image: &mut RasterImage,
        layer: RasterLayer<'_>,
        camera: &FigureCamera,
        style: &FigureStyle,
    ) {
        let samples = style.samples.clamp(1, 4);
        let size = [image.image_width(), image.image_height()];
        self.buffers
            .clear_buffers(size.map(|side| side * samples), ink::paper_margin(samples));
        // The buffers keep a margin of paper, so that lines need no test for the edge.
        self.project_mesh_vertices(layer.mesh, camera, style);
        self.fill_mesh_triangles(layer.mesh, style.threads);
        if layer.veiled {
            self.buffers.remove_veiled_samples();
        }
        ink::ink_picture(&self.buffers, image, samples, style, layer.opacity);
        if !layer.veiled {
            self.buffers.keep_layer_depths();
        }
    }

    /// Fills all triangles; each thread fills the samples of its own rows.
    fn fill_mesh_triangles(&mut self, mesh: &TriangleMesh, threads: usize) {
        let corners = &self.corners;
        // Bands share no rows, so that threads need no lock and their number changes no byte.
        let mut bands = self.buffers.split_buffer_bands(threads.max(1));
        let last = bands.pop();
        std::thread::scope(|scope| {
            for band in bands {
                scope.spawn(|| fill::fill_band_triangles(band, corners, &mesh.triangles));
            }
            if let Some(band) = last {
                fill::fill_band_triangles(band, corners, &mesh.triangles);
            }
        });
    }

    fn project_mesh_vertices(&mut self, mesh: &TriangleMesh, camera: &FigureCamera, style: &FigureStyle) {
        let [width, height] = self.buffers.size;
        self.corners.clear();
        let used = Arch::new().dispatch(MeshProjectionTask {
            vertices: &mesh.vertices,
            projection: camera.camera_projection(width, height),
            lights: [style.key_light, style.fill_light].map(|light| light.normalize_or(Vec3::Z)),
            near: camera.near.max(NEAREST_DRAWING_METRES),
            size: self.buffers.size,
            out: &mut self.corners,
        });
        self.buffers.set_used(used);
        self.buffers.marked = mesh.vertices.iter().any(|vertex| vertex.group >= FIRST_FLAT_GROUP);
    }
}

/// A call that is compiled for each instruction set and selected at run time.
struct MeshProjectionTask<'a> {
    vertices: &'a [MeshVertex],
    projection: CameraProjection,
    lights: [Vec3; 2],
    near: f32,
    size: [usize; 2],
    out: &'a mut Vec<TriangleCorner>,
}

impl NullaryFnOnce for MeshProjectionTask<'_> {
    /// The columns and rows of samples in use.
    type Output = [Range<usize>; 2];

    #[inline(always)]
    fn call(self) -> Self::Output {
        let (mut low, mut high) = ([i32::MAX; 2], [-1; 2]);
        let corners = self.vertices.iter().map(|vertex| {
            let place = self.projection.project_point(vertex.position);
            // Coordinates beyond would saturate when they are snapped to integers.
            let inside = place.x.abs() < FAR_OUT && place.y.abs() < FAR_OUT;
            // Marks such as grids and trails have their own colour whatever the light.
            let flat = vertex.group >= FIRST_FLAT_GROUP;
            let light = if flat {
                1.0
            } else {
                brightness(self.projection.to_picture_axes(vertex.normal), self.lights)
            };
            let [r, g, b] = vertex.colour.0.map(|part| stored_colour_byte(f32::from(part) * light));
            // Snapped to sixteenths of a sample, so that edges are tested exactly in integers.
            let subpixels = [place.x, place.y].map(|v| (v * SUBPIXEL_STEPS + 0.5).floor() as i32);
            let seen = place.depth > self.near && inside;
            if seen {
                for axis in 0..2 {
                    low[axis] = low[axis].min(subpixels[axis]);
                    high[axis] = high[axis].max(subpixels[axis]);
                }
            }
            TriangleCorner {
                at: subpixels,
                values: [place.depth, r, g, b],
                group: vertex.group,
                seen,
            }
        });
        self.out.extend(corners);
        [0, 1].map(|axis| {
            let whole_pixel = |at: i32| at.div_euclid(SUBPIXEL_STEPS as i32);
            let inside = |at: i32| at.clamp(0, self.size[axis] as i32) as usize;
            inside(whole_pixel(low[axis]))..inside(whole_pixel(high[axis]) + 1)
        })
    }
}

/// Returns the brightness of a surface with the normal `normal` (the picture's right, up, towards the
/// eye).
#[inline(always)]
fn brightness(normal: Vec3, [key, fill]: [Vec3; 2]) -> f32 {
    // The sky lights faces that look up a little more.
    let sky = 0.5 + 0.5 * normal.y;
    let around = LIGHT_SHARES[0] * (0.80 + 0.20 * sky);
    let lit = LIGHT_SHARES[1] * normal.dot(key).max(0.0) + LIGHT_SHARES[2] * normal.dot(fill).max(0.0);
    let edge = (1.0 - normal.z).max(0.0);
    // The cube keeps the rim narrow.
    let rim = RIM_LIGHT_SHARE * edge * edge * edge * (0.3 + 0.7 * normal.y).max(0.0);
    // A little beyond white, since shades take light away later.
    (around + lit + rim).min(1.14)
}

#[cfg(test)]
#[path = "raster_tests.rs"]
mod tests;
