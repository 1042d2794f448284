//! Compares pictures: shapes as egui draws them, and the simplified ones.

use eframe::egui::epaint::{ClippedPrimitive, Primitive, TessellationOptions, Tessellator, Vertex};
use eframe::egui::{CornerRadius, vec2};
use proptest::prelude::*;

use super::*;

const SIDE: usize = 80;
const PAPER: f32 = 200.0;

/// Returns a picture of some shapes without text, pixel by pixel.
fn picture(shapes: Vec<ClippedShape>, scale: f32) -> Vec<[f32; 4]> {
    let options = TessellationOptions::default();
    let primitives = Tessellator::new(scale, options, [1, 1], Vec::new()).tessellate_shapes(shapes);
    let mut pixels = vec![[PAPER; 4]; SIDE * SIDE];
    for ClippedPrimitive { primitive, .. } in primitives {
        let Primitive::Mesh(mesh) = primitive else {
            continue;
        };
        for triangle in mesh.indices.chunks(3) {
            let corners = [0, 1, 2].map(|at| mesh.vertices[triangle[at] as usize]);
            fill(&mut pixels, corners, scale);
        }
    }
    pixels
}

/// Fills the pixels whose middle lies in a triangle; those on an edge between two triangles only once. Corners are
/// snapped to a 256th of a pixel, as software renderers do.
fn fill(pixels: &mut [[f32; 4]], [a, mut b, mut c]: [Vertex; 3], scale: f32) {
    const UNIT: f32 = 256.0;
    let snapped = |it: Vertex| [it.pos.x, it.pos.y].map(|it| (it * scale * UNIT).round() as i64);
    let cross = |from: [i64; 2], to: [i64; 2], at: [i64; 2]| {
        (to[0] - from[0]) * (at[1] - from[1]) - (to[1] - from[1]) * (at[0] - from[0])
    };
    if cross(snapped(a), snapped(b), snapped(c)) < 0 {
        std::mem::swap(&mut b, &mut c);
    }
    let places = [a, b, c].map(snapped);
    let area = cross(places[0], places[1], places[2]);
    let side = |axis: usize| {
        let all = places.map(|it| (it[axis] / 256).clamp(0, SIDE as i64 - 1) as usize);
        all[0].min(all[1]).min(all[2])..=all[0].max(all[1]).max(all[2])
    };
    let within = side(1).flat_map(|y| side(0).map(move |x| [x, y]));
    for [x, y] in within {
        let pixel = &mut pixels[y * SIDE + x];
        let at = [x, y].map(|it| it as i64 * 256 + 128);
        let shares = [1, 2, 0].map(|next| {
            let (from, to) = (places[next], places[(next + 1) % 3]);
            let owned = to[1] < from[1] || to[1] == from[1] && to[0] > from[0];
            (cross(from, to, at), owned)
        });
        if area == 0 || !shares.iter().all(|it| it.0 > 0 || it.0 == 0 && it.1) {
            continue;
        }
        let part = |which: usize| {
            let all = [a, b, c].into_iter().zip(&shares);
            all.map(|(corner, share)| f32::from(corner.color.to_array()[which]) * share.0 as f32 / area as f32)
                .sum::<f32>()
        };
        let below = 1.0 - part(3) / 255.0;
        *pixel = [0, 1, 2, 3].map(|which| part(which) + pixel[which] * below);
    }
}

/// Returns by how much the two pictures of a shape differ in any pixel, in 255ths: in `corners`, and elsewhere.
fn apart(shape: &Shape, scale: f32, corners: impl Fn(Pos2) -> bool) -> [f32; 2] {
    let all = || vec![ClippedShape::new(Rect::EVERYTHING, shape.clone())];
    let (usual, own) = (
        picture(all(), scale),
        picture(simplify_clipped_shapes(all(), scale), scale),
    );
    let mut most = [0.0_f32; 2];
    for (number, (a, b)) in usual.iter().zip(&own).enumerate() {
        let at = pos2((number % SIDE) as f32 + 0.5, (number / SIDE) as f32 + 0.5) / scale;
        let most = &mut most[usize::from(!corners(at))];
        for part in 0..4 {
            *most = most.max((a[part] - b[part]).abs());
        }
    }
    most
}

fn triangles(shapes: &[ClippedShape]) -> Vec<usize> {
    let count = |it: &ClippedShape| match &it.shape {
        Shape::Mesh(mesh) => mesh.indices.len() / 3,
        _ => 0,
    };
    shapes.iter().map(count).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn rectangles_equal_those_drawn_by_egui(
        place in (2.0_f32..12.0, 2.0_f32..12.0),
        size in (10.0_f32..24.0, 10.0_f32..24.0),
        sharp in any::<bool>(),
        edge in prop::sample::select(vec![0.0_f32, 1.0, 2.0]),
        inner in prop::sample::select(vec![0_u8, 90, 255]),
        scale in prop::sample::select(vec![1.0_f32, 2.0]),
    ) {
        let rect = Rect::from_min_size(place.into(), size.into());
        let radius = if sharp { 0 } else { 4 };
        let fill = Color32::from_rgba_unmultiplied(40, 120, 200, inner);
        let shape = Shape::Rect(RectShape::new(
            rect, CornerRadius::same(radius), fill, Stroke::new(edge, Color32::BLACK), StrokeKind::Inside,
        ));
        let near = |at: f32, from: f32, to: f32| at - from < 7.0 || to - at < 7.0;
        let corners = |at: Pos2| {
            !sharp && near(at.x, rect.left(), rect.right()) && near(at.y, rect.top(), rect.bottom())
        };
        // Round corners are exact arcs here, and polygons in egui.
        let [round, straight] = apart(&shape, scale, corners);
        prop_assert!(straight < 3.0, "{straight}");
        prop_assert!(round < 90.0, "{round}");
    }

    #[test]
    fn lines_equal_those_drawn_by_egui(
        from in (5.0_f32..10.0, 5.0_f32..10.0),
        length in 3.0_f32..20.0,
        width in prop::sample::select(vec![1.0_f32, 1.5, 2.0, 2.5, 3.0]),
        upright in any::<bool>(),
    ) {
        let from = Pos2::from(from);
        let to = from + if upright { vec2(0.0, length) } else { vec2(length, 0.0) };
        let shape = Shape::line_segment([from, to], Stroke::new(width, Color32::BLACK));
        let [_, straight] = apart(&shape, 1.0, |_| false);
        prop_assert!(straight < 3.0, "{straight}");
    }
}

#[test]
fn only_bounded_runs_of_triangle_pairs_are_drawn_as_rectangles() {
    let mut long = Mesh::default();
    for at in 0..500 {
        let place = Rect::from_min_size(pos2(at as f32, 0.0), vec2(1.0, 2.0));
        long.add_colored_rect(place, Color32::RED);
    }
    let odd = [[0.0, 0.0], [9.0, 0.0], [0.0, 9.0]].map(Pos2::from).to_vec();
    let odd = Shape::convex_polygon(odd, Color32::RED, Stroke::NONE);
    let square = Rect::from_min_size(pos2(1.0, 1.0), vec2(8.0, 8.0));
    let square = Shape::rect_filled(square, 0.0, Color32::RED);
    let all = [Shape::mesh(long), odd, Shape::Noop, square];
    let seen = Rect::from_min_size(Pos2::ZERO, vec2(1000.0, 100.0));
    let clipped = |shape| ClippedShape::new(seen, shape);
    let made = simplify_clipped_shapes(all.map(clipped).to_vec(), 1.0);
    assert_eq!(triangles(&made), [340, 340, 320, 0, 3]);
    // A shape with another clip rectangle begins a new batch.
    let begins = made.windows(2).map(|it| it[0].clip_rect != it[1].clip_rect);
    assert_eq!(begins.collect::<Vec<_>>(), [true, true, true, false]);
}
