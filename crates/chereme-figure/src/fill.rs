//! Fills triangles: finds the samples inside, keeps the nearest surface, and computes its colour.

use pulp::{Arch, NullaryFnOnce};

use crate::buffers::{BufferBand, pack_paint, round_to_byte};

/// Steps per sample to which corners are snapped.
pub(crate) const SUBPIXEL_STEPS: f32 = 16.0;
/// [`SUBPIXEL_STEPS`] as a whole number.
const SUBPIXEL_UNIT: i32 = SUBPIXEL_STEPS as i32;
/// Largest width and height of a triangle, in parts of a sample, for which products of its sides fit 32
/// bits.
const MAX_NARROW_SIZE: i32 = 1 << 14;

/// A vertex in the picture: snapped position, depth, lit colour, and the part of the body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TriangleCorner {
    pub(crate) at: [i32; 2],
    pub(crate) values: [f32; 4],
    pub(crate) group: u8,
    pub(crate) seen: bool,
}

/// Fills those samples of a band that lie in triangles.
pub(crate) fn fill_band_triangles(band: BufferBand<'_>, corners: &[TriangleCorner], triangles: &[[u32; 3]]) {
    Arch::new().dispatch(BandFillTask {
        band,
        corners,
        triangles,
    });
}

/// A call that is compiled for each instruction set and selected at run time.
struct BandFillTask<'a> {
    band: BufferBand<'a>,
    corners: &'a [TriangleCorner],
    triangles: &'a [[u32; 3]],
}

impl NullaryFnOnce for BandFillTask<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let mut band = self.band;
        for triangle in self.triangles {
            band.triangle(triangle.map(|index| &self.corners[index as usize]));
        }
    }
}

impl BufferBand<'_> {
    /// Fills the samples whose middle is inside a triangle that faces the eye.
    #[inline(always)]
    fn triangle(&mut self, corners: [&TriangleCorner; 3]) {
        let [a, b, c] = corners;
        // Places of corners that are not seen may be too far away to subtract.
        if !(a.seen && b.seen && c.seen) {
            return;
        }
        let area = doubled_signed_area(a.at, b.at, c.at);
        // Seen from behind: closed surfaces hide these triangles anyway.
        if area >= 0 {
            return;
        }
        let range = |axis: usize, first: usize, count: usize| {
            let [a, b, c] = corners.map(|corner| corner.at[axis]);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            // The first and the last sample whose middle lies within the corners' range.
            let from = (low + SUBPIXEL_UNIT / 2 - 1)
                .div_euclid(SUBPIXEL_UNIT)
                .max(first as i32);
            let to = (high - SUBPIXEL_UNIT / 2).div_euclid(SUBPIXEL_UNIT);
            (from, to.min((first + count) as i32 - 1), high - low)
        };
        let (top, bottom, height) = range(1, self.first, self.rows);
        let (left, right, width) = range(0, 0, self.width);
        if top > bottom || left > right {
            return;
        }
        let place = [left, right, top, bottom];
        // Small triangles are almost all of them, and 32 bits vectorise better.
        if width.max(height) < MAX_NARROW_SIZE {
            self.fill_narrow_triangle(corners, area as i32, place);
        } else {
            self.fill_wide_triangle(corners, area, place);
        }
    }

    /// Fills a triangle in integers of 32 bits.
    #[inline(always)]
    fn fill_narrow_triangle(&mut self, [a, b, c]: [&TriangleCorner; 3], area: i32, place: [i32; 4]) {
        let [left, right, top, bottom] = place;
        let middle = [
            left * SUBPIXEL_UNIT + SUBPIXEL_UNIT / 2,
            top * SUBPIXEL_UNIT + SUBPIXEL_UNIT / 2,
        ];
        let edge = |from: &TriangleCorner, to: &TriangleCorner| {
            let side = [to.at[0] - from.at[0], to.at[1] - from.at[1]];
            let away = [middle[0] - from.at[0], middle[1] - from.at[1]];
            let value = side[0] * away[1] - side[1] * away[0];
            (value, side[1] * SUBPIXEL_UNIT, side[0] * SUBPIXEL_UNIT)
        };
        let (mut u, across_u, down_u) = edge(b, c);
        let (mut v, across_v, down_v) = edge(c, a);
        let limits = [
            EdgeLimit::new(across_u),
            EdgeLimit::new(across_v),
            EdgeLimit::new(-across_u - across_v),
        ];
        let share = 1.0 / area as f32;
        // The third edge follows from the other two: the three values sum up to the area.
        let value_slope = |corner: &TriangleCorner| -> [f32; 4] {
            std::array::from_fn(|part| (corner.values[part] - c.values[part]) * share)
        };
        let (beside_a, beside_b) = (value_slope(a), value_slope(b));
        let step: [f32; 4] =
            std::array::from_fn(|part| -(beside_a[part] * across_u as f32 + beside_b[part] * across_v as f32));
        let group = u32::from(a.group) << 24;
        let wide = right - left;
        let mut start = (top as usize - self.first) * self.stride + self.margin + left as usize;
        for _ in top..=bottom {
            let (mut from, mut to) = (0, wide);
            for (limit, value) in limits.iter().zip([u, v, area - u - v]) {
                limit.restrict_columns(value, &mut from, &mut to);
            }
            if from <= to {
                let (u, v) = ((u - across_u * from) as f32, (v - across_v * from) as f32);
                let first: [f32; 4] =
                    std::array::from_fn(|part| c.values[part] + beside_a[part] * u + beside_b[part] * v);
                let row = start + from as usize..=start + to as usize;
                let depths = self.depth[row.clone()].iter_mut();
                let mut k = 0.0;
                for (depth, paint) in depths.zip(&mut self.paint[row]) {
                    // The picture is drawn in any order of triangles; the nearest one wins.
                    let pixel_depth = first[0] + step[0] * k;
                    if pixel_depth < *depth {
                        *depth = pixel_depth;
                        let colour = [1, 2, 3].map(|part| round_to_byte(first[part] + step[part] * k));
                        *paint = group | colour[2] << 16 | colour[1] << 8 | colour[0];
                    }
                    k += 1.0;
                }
            }
            u += down_u;
            v += down_v;
            start += self.stride;
        }
    }

    /// Fills a triangle of any size.
    #[cold]
    fn fill_wide_triangle(&mut self, corners: [&TriangleCorner; 3], area: i64, [left, right, top, bottom]: [i32; 4]) {
        let [a, b, c] = corners;
        let unit = i64::from(SUBPIXEL_UNIT);
        let edges = [(b, c), (c, a), (a, b)];
        let sides = edges.map(|(from, to)| [0, 1].map(|axis| i64::from(to.at[axis] - from.at[axis])));
        let across = sides.map(|side| side[1] * unit);
        let down = sides.map(|side| side[0] * unit);
        let middle = [
            left * SUBPIXEL_UNIT + SUBPIXEL_UNIT / 2,
            top * SUBPIXEL_UNIT + SUBPIXEL_UNIT / 2,
        ];
        let mut first = edges.map(|(from, to)| doubled_signed_area(from.at, to.at, middle));
        let share = 1.0 / area as f32;
        let last = i64::from(right - left);
        for row in top..=bottom {
            // Exact division in integers, since products of such sides exceed what a float holds.
            let (from, to) = inside_column_span(first, across, last);
            let start = (row as usize - self.first) * self.stride + self.margin + left as usize;
            for column in from..=to {
                let inside = [0, 1, 2].map(|i| (first[i] - across[i] * column) as f32 * share);
                let value = |part: usize| -> f32 {
                    let values = corners.iter().zip(inside);
                    values.map(|(corner, share)| corner.values[part] * share).sum()
                };
                let (at, depth) = (start + column as usize, value(0));
                if depth < self.depth[at] {
                    self.depth[at] = depth;
                    self.paint[at] = pack_paint(a.group, [value(1), value(2), value(3)]);
                }
            }
            for i in 0..3 {
                first[i] += down[i];
            }
        }
    }
}

/// The columns of a row on the inner side of an edge.
#[derive(Clone, Copy)]
struct EdgeLimit {
    /// The decrease of the edge's value from column to column.
    across: i32,
    /// The inverse of `across`, 0 if that is 0.
    inverse: f64,
}

impl EdgeLimit {
    #[inline(always)]
    fn new(across: i32) -> Self {
        // An edge along the row has no column where it begins.
        let inverse = if across == 0 { 0.0 } else { 1.0 / f64::from(across) };
        Self { across, inverse }
    }

    /// Restricts columns to those in which the edge's value, `value` at column 0, is not positive.
    ///
    /// The quotient of two such numbers is whole, or a hundred times farther from a whole number than the
    /// tolerance for the rounding of its product.
    #[inline(always)]
    fn restrict_columns(self, value: i32, from: &mut i32, to: &mut i32) {
        const COLUMN_ROUNDING_TOLERANCE: f64 = 1e-8;
        let column = f64::from(value) * self.inverse;
        if self.across > 0 {
            *from = (*from).max((column - COLUMN_ROUNDING_TOLERANCE).ceil() as i32);
        } else if self.across < 0 {
            *to = (*to).min((column + COLUMN_ROUNDING_TOLERANCE).floor() as i32);
        }
    }
}

/// Returns the first and the last of columns 0 to `wide` at which none of the three edge values (`first`
/// less `across` times the column) is positive; the first exceeds the last if no such column exists.
fn inside_column_span(first: [i64; 3], across: [i64; 3], wide: i64) -> (i64, i64) {
    let (mut from, mut to) = (0, wide);
    for (value, step) in first.into_iter().zip(across) {
        if step > 0 && value > 0 {
            from = from.max((value + step - 1) / step);
        } else if step < 0 && value <= 0 {
            to = to.min(value / step);
        } else if value > 0 {
            // An edge along the row leaves all columns or none.
            return (1, 0);
        }
    }
    (from, to)
}

/// Returns twice the signed area of a triangle in the picture; negative if it is anticlockwise as seen by
/// the eye (rows count downwards).
#[inline(always)]
fn doubled_signed_area(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> i64 {
    let side = |from: [i32; 2], to: [i32; 2], axis: usize| i64::from(to[axis] - from[axis]);
    side(a, b, 0) * side(a, c, 1) - side(a, b, 1) * side(a, c, 0)
}
