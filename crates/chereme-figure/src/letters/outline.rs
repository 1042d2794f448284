//! The outlines of a font's letters: shaped by the rules of their script, and filled.

use harfrust::{Direction, ShapeOptions, ShaperData, UnicodeBuffer};
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{GlyphId, MetadataProvider};

use super::letters_fonts::FontFile;

/// The outline of a letter: its index, and its position from the beginning of its text, in parts of the
/// font's size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlacedOutline {
    glyph: u32,
    at: [f32; 2],
}

/// Returns a text of one direction as outlines from left to right, and its width in parts of the font's
/// size.
pub(super) fn shape_text_outlines(font: &FontFile, text: &str, from_right: bool) -> (Vec<PlacedOutline>, f32) {
    let Some(tables) = font.font_tables() else {
        return (Vec::new(), 0.0);
    };
    let data = ShaperData::new(&tables);
    let shaper = data.shaper(&tables).build();
    let mut buffer = UnicodeBuffer::new();
    buffer.push_str(text);
    buffer.guess_segment_properties();
    buffer.set_direction(if from_right {
        Direction::RightToLeft
    } else {
        Direction::LeftToRight
    });
    let shaped = shaper.shape(buffer, ShapeOptions::new());
    let unit = 1.0 / shaper.units_per_em().max(1) as f32;
    let mut x = 0.0;
    let mut placed = Vec::new();
    for (info, place) in shaped.glyph_infos().iter().zip(shaped.glyph_positions()) {
        let glyph_place = [x + place.x_offset as f32 * unit, place.y_offset as f32 * unit];
        placed.push(PlacedOutline {
            glyph: info.glyph_id,
            at: glyph_place,
        });
        x += place.x_advance as f32 * unit;
    }
    (placed, x)
}

/// Fills outlines at a size in pixels, their beginning on the base line at `at`; `paint` gets each touched
/// pixel and its covered share.
pub(super) fn fill_text_outlines(
    font: &FontFile,
    placed: &[PlacedOutline],
    size: f32,
    at: [f32; 2],
    mut paint: impl FnMut(i64, i64, f32),
) {
    let Some(tables) = font.font_tables() else {
        return;
    };
    let outlines = tables.outline_glyphs();
    for one in placed {
        let Some(outline) = outlines.get(GlyphId::new(one.glyph)) else {
            continue;
        };
        let mut path = OutlinePath::default();
        let settings = DrawSettings::unhinted(Size::new(size), LocationRef::default());
        if outline.draw(settings, &mut path).is_err() {
            continue;
        }
        let corner = [at[0] + one.at[0] * size, at[1] - one.at[1] * size];
        path.fill_outline_path(corner, size, &mut paint);
    }
}

/// The sides of an outline, with curves as straight pieces; y goes up.
#[derive(Debug, Default)]
struct OutlinePath {
    sides: Vec<[[f32; 2]; 2]>,
    start: [f32; 2],
    last: [f32; 2],
}

/// The number of straight pieces per curve.
const PIECES_PER_CURVE: u32 = 6;

impl OutlinePath {
    fn add_outline_side(&mut self, next: [f32; 2]) {
        self.sides.push([self.last, next]);
        self.last = next;
    }

    /// Paints the covered share of each pixel; overlapping parts of the outline count once.
    fn fill_outline_path(&self, corner: [f32; 2], size: f32, paint: &mut impl FnMut(i64, i64, f32)) {
        let place = |p: [f32; 2]| [corner[0] + p[0], corner[1] - p[1]];
        let points = || self.sides.iter().flatten().map(|p| place(*p));
        let bound = |axis: usize| {
            let all = || points().map(|p| p[axis]);
            let (low, high) = (all().fold(f32::MAX, f32::min), all().fold(f32::MIN, f32::max));
            (low.floor(), high.ceil())
        };
        let ((left, right), (top, bottom)) = (bound(0), bound(1));
        // A letter is not much larger than its font, but a broken one could be of any size.
        let most = size * 8.0 + 8.0;
        if !(right > left && right - left < most && bottom - top < most) {
            return;
        }
        let (width, height) = ((right - left) as usize + 2, (bottom - top) as usize);
        let mut area = vec![0.0f32; width * height];
        for [from, to] in &self.sides {
            let near = |p: [f32; 2]| [place(p)[0] - left, place(p)[1] - top];
            add_side_coverage(&mut area, width, near(*from), near(*to));
        }
        for (y, row) in area.chunks(width).enumerate() {
            let mut sum = 0.0;
            for (x, part) in row.iter().enumerate() {
                sum += part;
                let covered = sum.abs().min(1.0);
                if covered > 1.0 / 512.0 {
                    paint(left as i64 + x as i64, top as i64 + y as i64, covered);
                }
            }
        }
    }
}

/// Adds, for one side of an outline, the change of coverage from each pixel to the next. The sum along a row is the
/// share of a pixel that lies to the right of the side.
fn add_side_coverage(area: &mut [f32], width: usize, from: [f32; 2], to: [f32; 2]) {
    let (sign, from, to) = if from[1] < to[1] {
        (1.0, from, to)
    } else {
        (-1.0, to, from)
    };
    if from[1] == to[1] {
        return;
    }
    let slope = (to[0] - from[0]) / (to[1] - from[1]);
    let rows = area.len() / width;
    let last = (to[1].ceil() as usize).min(rows);
    for row in from[1] as usize..last {
        let top = from[1].max(row as f32);
        let bottom = to[1].min(row as f32 + 1.0);
        let ends = [top, bottom].map(|y| from[0] + (y - from[1]) * slope);
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let line = &mut area[row * width..(row + 1) * width];
        let mut done = 0.0;
        let first = low.max(0.0) as usize;
        for (x, cell) in line.iter_mut().enumerate().skip(first) {
            let x = x as f32;
            let right = right_of(low, high, x + 1.0) - right_of(low, high, x);
            let total = right * (bottom - top) * sign;
            *cell += total - done;
            done = total;
            if x >= high {
                break;
            }
        }
    }
}

/// Returns the area right of a side that goes from `low` to `high` within its row, and left of `edge`.
fn right_of(low: f32, high: f32, edge: f32) -> f32 {
    let wide = high - low;
    let crossed = (edge - low).clamp(0.0, wide);
    let slanted = if wide > 0.0 {
        crossed * crossed / (2.0 * wide)
    } else {
        0.0
    };
    slanted + (edge - high).max(0.0)
}

impl OutlinePen for OutlinePath {
    fn move_to(&mut self, x: f32, y: f32) {
        self.close();
        (self.start, self.last) = ([x, y], [x, y]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add_outline_side([x, y]);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        let from = self.last;
        for piece in 1..=PIECES_PER_CURVE {
            let t = piece as f32 / PIECES_PER_CURVE as f32;
            let part = |a: f32, b: f32, c: f32| {
                let (left, right) = (a + (b - a) * t, b + (c - b) * t);
                left + (right - left) * t
            };
            self.add_outline_side([part(from[0], cx, x), part(from[1], cy, y)]);
        }
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        let from = self.last;
        for piece in 1..=PIECES_PER_CURVE {
            let t = piece as f32 / PIECES_PER_CURVE as f32;
            let s = 1.0 - t;
            let part = |a: f32, b: f32, c: f32, d: f32| {
                a * s * s * s + 3.0 * b * s * s * t + 3.0 * c * s * t * t + d * t * t * t
            };
            self.add_outline_side([part(from[0], cx0, cx1, x), part(from[1], cy0, cy1, y)]);
        }
    }

    fn close(&mut self) {
        if self.last != self.start {
            self.add_outline_side(self.start);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(points: &[[f32; 2]]) -> (f32, f32) {
        let mut path = OutlinePath::default();
        path.move_to(points[0][0], points[0][1]);
        for p in &points[1..] {
            path.line_to(p[0], p[1]);
        }
        path.close();
        let (mut sum, mut most) = (0.0, 0.0f32);
        path.fill_outline_path([20.0, 20.0], 10.0, &mut |_, _, part| {
            sum += part;
            most = most.max(part);
        });
        (sum, most)
    }

    #[test]
    fn a_filled_outline_has_the_area_of_its_shape() {
        for (points, area) in [
            (&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]][..], 12.0),
            (&[[0.25, 0.5], [4.75, 0.5], [4.75, 3.25], [0.25, 3.25]], 4.5 * 2.75),
            (&[[0.0, 0.0], [7.3, 1.1], [2.2, 5.9]], 20.325),
            (&[[2.2, 5.9], [7.3, 1.1], [0.0, 0.0]], 20.325),
            (&[[0.1, 0.0], [0.4, 0.0], [0.4, 9.0], [0.1, 9.0]], 2.7),
        ] {
            let (sum, most) = covered(points);
            // The rounding errors of a few hundred 32-bit products add up.
            assert!((sum - area).abs() < 0.02, "{points:?}: {sum}");
            assert!(most <= 1.0);
        }
    }
}
