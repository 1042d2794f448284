//! Sample buffers: the nearest surface at every sample of a picture, divisible into bands of rows.

use std::ops::Range;

/// The depth of paper.
const PAPER_DEPTH: f32 = f32::INFINITY;
/// Least distance in metres by which a veiled layer must be in front of the surface that hides it, so that parts that
/// hardly moved do not show through.
const VEIL_DISTANCE_METRES: f32 = 0.015;
/// Factor on colours stored in a byte, so that light beyond white is not lost before shade falls on it.
const STORED_COLOUR_SCALE: f32 = 0.875;

/// The nearest surface at every sample; a margin of paper all around makes tests for the edge unnecessary.
#[derive(Debug, Clone, Default)]
pub(crate) struct SampleBuffers {
    /// Columns and rows of samples, the margin not counted.
    pub(crate) size: [usize; 2],
    pub(crate) margin: usize,
    pub(crate) stride: usize,
    /// Distance from the eye in metres; infinite for paper.
    pub(crate) depth: Vec<f32>,
    /// The part of the body and the lit colour, see [`pack_paint`]; 0 for paper.
    pub(crate) paint: Vec<u32>,
    /// Columns and rows of samples in use; all others are paper.
    pub(crate) used: [Range<usize>; 2],
    /// Whether there are marks without light and lines among the parts.
    pub(crate) marked: bool,
    /// The depths of the last layer that was not veiled.
    solid: Vec<f32>,
    /// The rows whose depths are in use; all others have the depth of paper.
    depth_used: Range<usize>,
    solid_used: Range<usize>,
}

/// Packs a colour and its part of the body into one number: the part, then blue, green and red, a byte
/// each.
#[inline(always)]
pub(crate) fn pack_paint(group: u8, colour: [f32; 3]) -> u32 {
    let [red, green, blue] = colour;
    u32::from(group) << 24 | round_to_byte(blue) << 16 | round_to_byte(green) << 8 | round_to_byte(red)
}

/// Rounds to the nearest whole number from 0 to 255; the input may exceed this range by less than a half.
#[inline(always)]
pub(crate) fn round_to_byte(part: f32) -> u32 {
    /// Adding 2²³ to a number moves its whole part to the lowest bits.
    const ROUNDING_OFFSET: f32 = 8_388_608.0;
    (part + ROUNDING_OFFSET).to_bits() & 0xFF
}

/// Returns the byte that [`pack_paint`] takes for a component of a colour, 0 to 255 or brighter.
#[inline(always)]
pub(crate) fn stored_colour_byte(part: f32) -> f32 {
    (part * STORED_COLOUR_SCALE).clamp(0.0, 255.0)
}

/// Returns a component of a packed colour, 0 for red to 2 for blue.
#[inline(always)]
pub(crate) fn unpack_paint(paint: u32, part: usize) -> f32 {
    (paint >> (8 * part) & 0xFF) as i32 as f32 * (1.0 / STORED_COLOUR_SCALE)
}

impl SampleBuffers {
    /// Clears everything to paper.
    pub(crate) fn clear_buffers(&mut self, size: [usize; 2], margin: usize) {
        // Of equal size only the rows in use have to be cleared.
        if (self.size, self.margin) == (size, margin) {
            let rows = self.rows_of(&self.used[1]);
            self.paint[rows].fill(0);
            let rows = self.rows_of(&self.depth_used);
            self.depth[rows].fill(PAPER_DEPTH);
        } else {
            self.size = size;
            self.margin = margin;
            self.stride = size[0] + 2 * margin;
            let len = self.stride * (size[1] + 2 * margin);
            for depths in [&mut self.depth, &mut self.solid] {
                depths.clear();
                depths.resize(len, PAPER_DEPTH);
            }
            self.paint.clear();
            self.paint.resize(len, 0);
            // Depths of another size cannot veil anything.
            self.solid_used = 0..0;
        }
        self.set_used([0..0, 0..0]);
    }

    /// Sets the columns and rows of samples in use; all others will be paper.
    pub(crate) fn set_used(&mut self, used: [Range<usize>; 2]) {
        self.depth_used = used[1].clone();
        self.used = used;
    }

    /// Returns the index of a sample in the buffers.
    #[inline]
    pub(crate) fn index(&self, x: usize, y: usize) -> usize {
        (y + self.margin) * self.stride + x + self.margin
    }

    /// Returns the range of whole rows in the buffers.
    fn rows_of(&self, rows: &Range<usize>) -> Range<usize> {
        let row_start = |row: usize| (row + self.margin) * self.stride;
        row_start(rows.start)..row_start(rows.end.max(rows.start))
    }

    /// Removes everything behind the last layer that was [kept](Self::keep_layer_depths).
    pub(crate) fn remove_veiled_samples(&mut self) {
        let rows = self.rows_of(&self.used[1]);
        let (depth, paint) = (&mut self.depth[rows.clone()], &mut self.paint[rows.clone()]);
        for ((depth, paint), before) in depth.iter_mut().zip(paint).zip(&self.solid[rows]) {
            // A point at less than the distance before the surface counts as behind it.
            if *before < *depth + VEIL_DISTANCE_METRES {
                *depth = PAPER_DEPTH;
                *paint = 0;
            }
        }
    }

    /// Keeps the depths of this layer for the layers that it veils; the current depths are invalid until
    /// they are cleared.
    pub(crate) fn keep_layer_depths(&mut self) {
        // Swapped instead of copied: the other buffer is cleared before it is used again.
        std::mem::swap(&mut self.solid, &mut self.depth);
        std::mem::swap(&mut self.solid_used, &mut self.depth_used);
    }

    /// Splits the used rows of samples into `count` bands, or fewer if there are few rows.
    pub(crate) fn split_buffer_bands(&mut self, count: usize) -> Vec<BufferBand<'_>> {
        let used = self.used[1].clone();
        let each = used.len().div_ceil(count).max(1);
        let rows = self.rows_of(&self.used[1]);
        let mut depth = &mut self.depth[rows.clone()];
        let mut paint = &mut self.paint[rows];
        let mut bands = Vec::with_capacity(count);
        for first in used.clone().step_by(each) {
            let rows = each.min(used.end - first);
            let (depths, paints);
            (depths, depth) = depth.split_at_mut(rows * self.stride);
            (paints, paint) = paint.split_at_mut(rows * self.stride);
            bands.push(BufferBand {
                first,
                rows,
                width: self.size[0],
                margin: self.margin,
                stride: self.stride,
                depth: depths,
                paint: paints,
            });
        }
        bands
    }
}

/// Some rows of the buffers.
pub(crate) struct BufferBand<'a> {
    pub(crate) first: usize,
    pub(crate) rows: usize,
    pub(crate) width: usize,
    pub(crate) margin: usize,
    pub(crate) stride: usize,
    pub(crate) depth: &'a mut [f32],
    pub(crate) paint: &'a mut [u32],
}
