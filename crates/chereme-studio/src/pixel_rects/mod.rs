//! Draws shapes as rectangles of whole pixels if they have that form.
//!
//! A window drawn by software pays for each triangle, and draws two triangles that form a rectangle along the
//! screen's axes as one if all of a batch are such pairs. egui gives shapes soft edges of many triangles, even at
//! an edge between two pixels that shows no softness. Here rectangles, also those with round corners, and level and
//! upright lines become the same pixels without them.

mod surface;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use eframe::egui::emath::GuiRounding;
use eframe::egui::epaint::{ClippedShape, CornerRadiusF32, PathShape, RectShape, Vertex, WHITE_UV};
use eframe::egui::{
    Color32, Context, FullOutput, Mesh, Plugin, Pos2, Rect, Shape, Stroke, StrokeKind, TextureId, pos2,
};

use surface::{ColourRuns, PixelSurface};

/// The most triangles of a batch: in larger batches, the software renderer checks only parts for rectangles.
const MAX_BATCH_TRIANGLES: usize = 340;
/// How much egui enlarges the radius of rounded corners, in points.
const CORNER_ENLARGEMENT_POINTS: f32 = 0.4;

/// The plugin that simplifies the shapes of a frame after all of it was painted.
pub(crate) struct ShapeSimplifier;

impl Plugin for ShapeSimplifier {
    fn debug_name(&self) -> &'static str {
        "plain shapes"
    }

    fn output_hook(&mut self, _ctx: &Context, output: &mut FullOutput) {
        let shapes = std::mem::take(&mut output.shapes);
        output.shapes = simplify_clipped_shapes(shapes, output.pixels_per_point);
    }
}

/// Returns the same picture with rectangles in place of shapes, as far as possible; `scale` is in pixels per point.
fn simplify_clipped_shapes(shapes: Vec<ClippedShape>, scale: f32) -> Vec<ClippedShape> {
    let mut sheet = RectangleSheet {
        scale,
        done: Vec::with_capacity(shapes.len()),
        mesh: Mesh::default(),
        clip: Rect::NOTHING,
        texture: TextureId::default(),
        count: 0,
        aside: false,
    };
    for clipped in shapes {
        if clipped.transform_after_tessellation == Default::default() {
            sheet.add_clipped_shape(clipped.clip_rect, clipped.shape);
        } else {
            // Transformed shapes do not lie along pixels.
            sheet.flush();
            sheet.done.push(clipped);
        }
    }
    sheet.flush();
    sheet.done
}

struct RectangleSheet {
    scale: f32,
    done: Vec<ClippedShape>,
    /// Collected rectangles that are not yet in `done`.
    mesh: Mesh,
    /// The clip rectangle of a batch, its texture, and its number of triangles.
    clip: Rect,
    texture: TextureId,
    count: usize,
    /// Whether the clip of this batch is widened by a thousandth of a point, since a batch with another clip is drawn
    /// separately.
    aside: bool,
}

impl RectangleSheet {
    fn add_clipped_shape(&mut self, clip: Rect, shape: Shape) {
        match shape {
            Shape::Noop => {}
            Shape::Vec(shapes) => {
                for shape in shapes {
                    self.add_clipped_shape(clip, shape);
                }
            }
            Shape::Rect(rect) => match self.rectangle(clip, &rect) {
                true => {}
                false => self.add_unchanged_shape(clip, Shape::Rect(rect), 150),
            },
            Shape::LineSegment { points, stroke } => match self.add_straight_line(clip, points, stroke) {
                true => {}
                false => self.add_unchanged_shape(clip, Shape::LineSegment { points, stroke }, 20),
            },
            Shape::Mesh(mesh) if mesh.indices.len() <= MAX_BATCH_TRIANGLES * 3 => {
                let count = mesh.indices.len() / 3;
                self.add_unchanged_shape(clip, Shape::Mesh(mesh), count);
                self.pair_odd_triangles(clip, count);
            }
            Shape::Mesh(mesh) => {
                for indices in mesh.indices.chunks(MAX_BATCH_TRIANGLES * 3) {
                    let part = extract_partial_mesh(&mesh, indices);
                    self.add_unchanged_shape(clip, Shape::mesh(part), indices.len() / 3);
                }
                // The two triangles of a later rectangle must not be parted.
                self.pair_odd_triangles(clip, mesh.indices.len() / 3);
            }
            Shape::Text(text) => {
                let count = text.galley.num_indices / 3;
                self.add_unchanged_shape(clip, Shape::Text(text), count);
            }
            Shape::Path(path) => {
                let odd = has_odd_triangles(&path);
                let count = path.points.len() * 7;
                self.add_unchanged_shape(clip, Shape::Path(path), count);
                self.pair_odd_triangles(clip, usize::from(odd));
            }
            shape => self.add_unchanged_shape(clip, shape, 100),
        }
    }

    /// Adds a shape unchanged.
    fn add_unchanged_shape(&mut self, clip: Rect, shape: Shape, count: usize) {
        self.turn_to_batch(clip, shape.texture_id(), count);
        self.flush();
        self.done.push(ClippedShape::new(self.batch_clip_rect(), shape));
    }

    /// Adds a triangle of no size after an odd number of triangles, so that the two of a rectangle stay a pair.
    fn pair_odd_triangles(&mut self, clip: Rect, count: usize) {
        if count % 2 == 1 {
            let texture = self.texture;
            let mesh = self.rectangle_batch_mesh(clip, texture, 1);
            let vertex_index = mesh.vertices.len() as u32;
            mesh.vertices.push(Vertex::default());
            mesh.indices.extend([vertex_index; 3]);
        }
    }

    /// Starts a batch, unless the shape can join the last one.
    fn turn_to_batch(&mut self, clip: Rect, texture: TextureId, count: usize) {
        let same = clip == self.clip && texture == self.texture;
        if !same || self.count + count > MAX_BATCH_TRIANGLES {
            self.flush();
            // A clip that differs a little makes the renderer begin another batch.
            self.aside = same && !self.aside;
            (self.clip, self.texture, self.count) = (clip, texture, 0);
        }
        self.count += count;
    }

    fn batch_clip_rect(&self) -> Rect {
        if self.aside { self.clip.expand(1e-3) } else { self.clip }
    }

    fn flush(&mut self) {
        if !self.mesh.indices.is_empty() {
            let mesh = std::mem::take(&mut self.mesh);
            let shape = Shape::Mesh(Arc::new(mesh));
            self.done.push(ClippedShape::new(self.batch_clip_rect(), shape));
        }
    }

    /// Returns the mesh that collects rectangles, with `count` triangles reserved in its batch.
    fn rectangle_batch_mesh(&mut self, clip: Rect, texture: TextureId, count: usize) -> &mut Mesh {
        self.turn_to_batch(clip, texture, count);
        self.mesh.texture_id = texture;
        &mut self.mesh
    }
}

impl RectangleSheet {
    /// Adds a line if it is horizontal or vertical; returns whether it is.
    fn add_straight_line(&mut self, clip: Rect, [from, to]: [Pos2; 2], stroke: Stroke) -> bool {
        let upright = from.x == to.x;
        let width = stroke.width * self.scale;
        // A slanted line, a point, or one so thin that softness is all of it.
        if upright == (from.y == to.y) || width < 0.95 {
            return false;
        }
        // Level lines are treated as upright ones with both axes exchanged.
        let turned = |at: Pos2| if upright { at } else { pos2(at.y, at.x) };
        let (from, to) = (turned(from), turned(to));
        let mut middle = from.x;
        stroke.round_center_to_pixel(self.scale, &mut middle);
        let middle = middle * self.scale;
        let end = |at: f32| (at * self.scale - 0.5).round() + 0.5;
        let (low, high) = (from.y.min(to.y), from.y.max(to.y));
        let quarter = 0.25 / self.scale;
        let (low, high) = (end(low + quarter) - 0.5, end(high - quarter) + 0.5);
        let reach = (width + 1.0) / 2.0;
        let mut runs = ColourRuns::default();
        for at in (middle - reach).floor() as i32..(middle + reach).ceil() as i32 {
            let share = reach - (at as f32 + 0.5 - middle).abs();
            runs.add_colour_run(at, at + 1, stroke.color.gamma_multiply(share.clamp(0.0, 1.0)));
        }
        for (left, right, colour) in runs.0 {
            let corners = [(left, low), (right, high)];
            let [min, max] = corners.map(|(x, y)| turned(pos2(x as f32, y) / self.scale));
            let mesh = self.rectangle_batch_mesh(clip, TextureId::default(), 2);
            mesh.add_colored_rect(Rect::from_min_max(min, max), colour);
        }
        true
    }

    /// Adds a rectangle if its edges can lie between pixels; returns whether they can.
    fn rectangle(&mut self, clip: Rect, shape: &RectShape) -> bool {
        let (mut stroke, mut fill, mut rect) = (shape.stroke, shape.fill, shape.rect);
        if shape.angle != 0.0 || shape.blur_width > 0.0 || shape.round_to_pixels == Some(false) {
            return false;
        }
        if stroke.width == 0.0 {
            stroke = Stroke::NONE;
        }
        let pixel = 1.0 / self.scale;
        if !stroke.is_empty() {
            let stroked_rect = match shape.stroke_kind {
                StrokeKind::Inside => rect,
                StrokeKind::Middle => rect.expand(stroke.width / 2.0),
                StrokeKind::Outside => rect.expand(stroke.width),
            };
            // Both edges meet: nothing of the fill is left.
            if stroked_rect.size().min_elem() <= 2.0 * stroke.width + 0.5 * pixel {
                (rect, fill, stroke) = (stroked_rect, stroke.color, Stroke::NONE);
            }
        }
        if stroke.is_empty() && stroke.width > 0.0 || shape.brush.is_some() && !stroke.is_empty() {
            return false;
        }
        if stroke.is_empty() && shape.brush.is_none() && rect.size().min_elem() <= 2.0 * pixel {
            let (ends, width) = if rect.width() <= 2.0 * pixel {
                ([rect.center_top(), rect.center_bottom()], rect.width())
            } else {
                ([rect.left_center(), rect.right_center()], rect.height())
            };
            return self.add_straight_line(clip, ends, Stroke::new(width, fill));
        }
        let rounded = match shape.stroke_kind {
            // An odd edge lies in the middle of pixels, an even one between them.
            StrokeKind::Middle if is_odd(stroke.width * self.scale) => rect.round_to_pixel_center(self.scale),
            _ => rect.round_to_pixels(self.scale),
        };
        let beyond = match shape.stroke_kind {
            StrokeKind::Inside => 0.0,
            StrokeKind::Middle => stroke.width / 2.0,
            StrokeKind::Outside => stroke.width,
        };
        let outer = rounded.expand(beyond) * self.scale;
        let pixel_rect = outer.round();
        // An edge within a pixel keeps egui's softness.
        if (outer.min - pixel_rect.min).abs().max_elem() > 0.01 || !pixel_rect.is_positive() {
            return false;
        }
        let least = stroke.width + 0.1;
        let corner_radii = CornerRadiusF32::from(shape.corner_radius);
        let radius = [corner_radii.nw, corner_radii.ne, corner_radii.sw, corner_radii.se].map(|corner| match corner {
            0.0 => 0.0,
            it => (it + beyond + CORNER_ENLARGEMENT_POINTS).max(least) * self.scale,
        });
        let surface = PixelSurface {
            size: [pixel_rect.width(), pixel_rect.height()],
            radius: radius.map(|corner| corner.min(pixel_rect.size().min_elem() / 2.0)),
            width: stroke.width * self.scale,
            fill,
            edge: stroke.color,
        };
        let texture = shape.brush.as_ref().map(|brush| (brush.fill_texture_id, brush.uv));
        let area = rounded.expand(beyond);
        for (place, colour) in surface.surface_pieces() {
            let place = place.translate(pixel_rect.min.to_vec2()) / self.scale;
            let (texture, uv) = match texture {
                None => (TextureId::default(), Rect::from_min_max(WHITE_UV, WHITE_UV)),
                Some((texture, uv)) => {
                    let uv_at = |at: Pos2| uv.lerp_inside((at - area.min) / area.size());
                    let uv = Rect::from_min_max(uv_at(place.min), uv_at(place.max));
                    (texture, uv)
                }
            };
            let mesh = self.rectangle_batch_mesh(clip, texture, 2);
            mesh.add_rect_with_uv(place, uv, colour);
        }
        true
    }
}

fn is_odd(pixels: f32) -> bool {
    pixels.round() as i64 % 2 == 1
}

/// Returns whether egui makes an odd number of triangles of a path: it does for a filled surface with an odd number of
/// corners; all other triangles come in pairs.
fn has_odd_triangles(path: &PathShape) -> bool {
    path.fill != Color32::TRANSPARENT && path.points.len() % 2 == 1
}

/// Returns a separate mesh of some triangles of `mesh`.
fn extract_partial_mesh(mesh: &Mesh, indices: &[u32]) -> Mesh {
    let first = indices.iter().copied().min().unwrap_or_default();
    let last = indices.iter().copied().max().unwrap_or_default();
    let vertices = mesh.vertices.get(first as usize..=last as usize);
    Mesh {
        indices: indices.iter().map(|index| index - first).collect(),
        vertices: vertices.unwrap_or_default().to_vec(),
        texture_id: mesh.texture_id,
    }
}
