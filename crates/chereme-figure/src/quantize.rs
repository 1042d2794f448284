//! Reduces the number of colours: median cut (Heckbert 1982, doi:10.1145/965145.801294) with six bits per
//! component.

use crate::palette::RgbColour;

const BITS_PER_COLOUR_PART: u32 = 6;
const COLOUR_CELL_COUNT: usize = 1 << (3 * BITS_PER_COLOUR_PART);
const UNKNOWN_PALETTE_INDEX: u16 = u16::MAX;

/// Counts colours, chooses a palette, and finds the palette's nearest colour.
pub(crate) struct ColourQuantizer {
    counts: Vec<u32>,
    /// The sums of the colours in each cell, so that a flat colour remains exact.
    sums: Vec<[u64; 3]>,
    palette: Vec<RgbColour>,
    nearest: Vec<u16>,
}

impl Default for ColourQuantizer {
    fn default() -> Self {
        Self {
            counts: vec![0; COLOUR_CELL_COUNT],
            sums: vec![[0; 3]; COLOUR_CELL_COUNT],
            palette: Vec::new(),
            nearest: vec![UNKNOWN_PALETTE_INDEX; COLOUR_CELL_COUNT],
        }
    }
}

fn colour_cell(colour: RgbColour) -> usize {
    let [r, g, b] = colour.0.map(|part| usize::from(part >> (8 - BITS_PER_COLOUR_PART)));
    (r << (2 * BITS_PER_COLOUR_PART)) | (g << BITS_PER_COLOUR_PART) | b
}

/// Returns the colour in the middle of a cell.
fn cell_middle_colour(cell: usize) -> RgbColour {
    let part = |shift: u32| ((cell >> shift) & ((1 << BITS_PER_COLOUR_PART) - 1)) as u8;
    // The high bits are repeated below, so that white stays white.
    RgbColour([part(2 * BITS_PER_COLOUR_PART), part(BITS_PER_COLOUR_PART), part(0)].map(|v| (v << 2) | (v >> 4)))
}

/// A box of colours: each with its number of occurrences.
struct ColourBox {
    colours: Vec<(RgbColour, u32)>,
}

impl ColourBox {
    /// Returns the axis with the widest range of colours and that range, weighted so that boxes of many pixels are
    /// split first.
    fn widest(&self) -> (usize, f64) {
        let mut best = (0, -1.0);
        for axis in 0..3 {
            let parts = self.colours.iter().map(|entry| entry.0.0[axis]);
            let low = parts.clone().min().unwrap_or(0);
            let spread = f64::from(parts.max().unwrap_or(0) - low);
            if spread > best.1 {
                best = (axis, spread);
            }
        }
        let pixels: f64 = self.colours.iter().map(|entry| f64::from(entry.1)).sum();
        // A power below one: large flat areas do not take all colours for themselves.
        (best.0, best.1 * pixels.powf(0.3))
    }

    fn cut_colour_box(mut self, axis: usize) -> [Self; 2] {
        // The whole colour breaks ties, so that the order is the same everywhere.
        self.colours.sort_unstable_by_key(|entry| (entry.0.0[axis], entry.0));
        let total: u64 = self.colours.iter().map(|entry| u64::from(entry.1)).sum();
        let mut below = 0;
        let median_index = self.colours.iter().position(|entry| {
            below += u64::from(entry.1);
            below * 2 >= total
        });
        // Each half has at least one colour.
        let cut_index = (median_index.unwrap_or(0) + 1).clamp(1, self.colours.len() - 1);
        let upper = self.colours.split_off(cut_index);
        [self, Self { colours: upper }]
    }

    fn mean_box_colour(&self) -> RgbColour {
        let total: u64 = self.colours.iter().map(|entry| u64::from(entry.1)).sum();
        RgbColour(std::array::from_fn(|axis| {
            let sum: u64 = self
                .colours
                .iter()
                .map(|entry| u64::from(entry.0.0[axis]) * u64::from(entry.1))
                .sum();
            ((sum + total / 2) / total.max(1)) as u8
        }))
    }
}

impl ColourQuantizer {
    /// Counts the colours of a picture.
    pub(crate) fn count_picture_colours(&mut self, pixels: &[RgbColour]) {
        for &pixel in pixels {
            let cell = colour_cell(pixel);
            let count = &mut self.counts[cell];
            *count = count.saturating_add(1);
            for (sum, part) in self.sums[cell].iter_mut().zip(pixel.0) {
                *sum += u64::from(part);
            }
        }
    }

    /// Returns the mean of the colours in a cell.
    fn mean_cell_colour(&self, cell: usize) -> RgbColour {
        let count = u64::from(self.counts[cell].max(1));
        RgbColour(self.sums[cell].map(|sum| ((sum + count / 2) / count).min(255) as u8))
    }

    /// Chooses at most `most` colours.
    pub(crate) fn choose_palette_colours(&mut self, most: usize) {
        let met = (0..COLOUR_CELL_COUNT).filter(|&i| self.counts[i] > 0);
        let colours: Vec<(RgbColour, u32)> = met.map(|i| (self.mean_cell_colour(i), self.counts[i])).collect();
        let mut boxes = vec![ColourBox { colours }];
        while boxes.len() < most {
            // A box of one colour cannot be cut.
            let cuttable = (0..boxes.len()).filter(|&i| boxes[i].colours.len() > 1);
            let Some((index, (axis, _))) = cuttable
                .map(|i| (i, boxes[i].widest()))
                .max_by(|a, b| a.1.1.total_cmp(&b.1.1))
            else {
                break;
            };
            let halves = boxes.swap_remove(index).cut_colour_box(axis);
            boxes.extend(halves);
        }
        self.palette = boxes.iter().map(ColourBox::mean_box_colour).collect();
        // The order of boxes depends on cuts; sorted palettes make equal files.
        self.palette.sort_unstable();
        // Indices of an earlier palette are no longer valid.
        self.nearest.fill(UNKNOWN_PALETTE_INDEX);
    }

    /// Returns red, green and blue of every colour of the palette.
    pub(crate) fn palette_bytes(&self) -> Vec<u8> {
        self.palette.iter().flat_map(|colour| colour.0).collect()
    }

    /// Returns the index in the palette of the colour nearest to `colour`.
    pub(crate) fn index(&mut self, colour: RgbColour) -> u8 {
        let cell = colour_cell(colour);
        if self.nearest[cell] == UNKNOWN_PALETTE_INDEX {
            // A colour that was not sampled has no mean: the middle of its cell stands for it.
            let wanted = if self.counts[cell] > 0 {
                self.mean_cell_colour(cell)
            } else {
                cell_middle_colour(cell)
            };
            let distance = |other: &RgbColour| -> i32 {
                let part = |i: usize| i32::from(other.0[i]) - i32::from(wanted.0[i]);
                2 * part(0) * part(0) + 4 * part(1) * part(1) + 3 * part(2) * part(2)
            };
            let all = self.palette.iter().enumerate();
            let best = all.min_by_key(|entry| distance(entry.1));
            self.nearest[cell] = best.map_or(0, |entry| entry.0 as u16);
        }
        self.nearest[cell] as u8
    }
}
