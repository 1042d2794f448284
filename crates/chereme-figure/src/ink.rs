//! Lines where one part of the body lies before another, shade behind what is nearer, and the
//! averaging of samples to pixels.
//!
//! The shade is a cheap form of *Image enhancement by unsharp masking the depth buffer* (Luft,
//! Colditz, Deussen, ACM Transactions on Graphics 25(3), 2006, p. 1206): it lets fingers stand out
//! before palm and chest.

use crate::body::group::FLAT;
use crate::image::Image;
use crate::palette::Colour;
use crate::raster::{Buffers, Style};

/// Half the width of a line, and how far a shade reaches, in pixels of the finished picture.
const LINE: f32 = 0.6;
const SHADE: f32 = 2.5;
/// How dark a shade is at its darkest.
const SHADE_STRENGTH: f32 = 0.38;
/// The depth step at which a shade begins, and the one beyond it at which it is full, in metres.
const SHADE_STEPS: [f32; 2] = [0.006, 0.033];
/// The depth step from which a line between two parts is drawn at full strength, in metres.
const CLEAR_STEP: f32 = 0.004;
/// How strong lines are: within a part, between parts that touch, between parts apart.
const STRENGTHS: [f32; 3] = [0.75, 0.5, 0.9];
/// The colour of lines within the figure.
const INNER_LINE: [f32; 3] = [34.0, 30.0, 34.0];

fn reach(samples: usize, pixels: f32) -> usize {
    (samples as f32 * pixels).round().max(1.0) as usize
}

/// Returns how much paper is needed around the picture, in samples.
pub(crate) fn margin(samples: usize) -> usize {
    reach(samples, SHADE) + 1
}

/// What lines and shades are drawn with; steps are distances between places in the buffers.
struct Ink {
    outline: [f32; 3],
    near: [isize; 8],
    far: [isize; 8],
    step: f32,
    /// How far a line reaches, in samples.
    beside: usize,
    samples: usize,
    opacity: f32,
}

/// The side of the squares that are looked at together, in pixels.
const SQUARE: usize = 8;
/// How many samples are worked on at once.
const LANES: usize = 8;
/// As many for each part of their colours.
const PARTS: usize = 3 * LANES;

/// Draws lines and shades, and averages the samples of each pixel over what is in `image`.
pub(crate) fn finish(
    buffers: &Buffers,
    image: &mut Image,
    samples: usize,
    style: &Style,
    opacity: f32,
) {
    let ink = Ink {
        outline: style.theme.outline().0.map(f32::from),
        near: around(reach(samples, LINE), buffers.stride),
        far: around(reach(samples, SHADE), buffers.stride),
        step: style.step,
        beside: reach(samples, LINE),
        samples,
        opacity: opacity.clamp(0.0, 1.0),
    };
    let width = image.width();
    if width == 0 {
        return;
    }
    let rows = image.height().div_ceil(SQUARE);
    let each = rows.div_ceil(style.threads.max(1)).max(1) * SQUARE;
    let mut bands: Vec<_> = image
        .pixels_mut()
        .chunks_mut(each * width)
        .enumerate()
        .collect();
    let last = bands.pop();
    let ink = &ink;
    // Squares that begin elsewhere are paper, with all that lines could be drawn around.
    let touched = &buffers.used.clone().map(|used| {
        let first = (used.start / samples).saturating_sub(SQUARE + buffers.margin);
        first..used.end.div_ceil(samples) + buffers.margin
    });
    let paint = |(band, pixels): (usize, &mut [Colour])| {
        for (row, pixels) in pixels.chunks_mut(SQUARE * width).enumerate() {
            let top = band * each + row * SQUARE;
            if !touched[1].contains(&top) {
                continue;
            }
            for left in (0..width).step_by(SQUARE) {
                if touched[0].contains(&left) {
                    ink.square(buffers, pixels, [left, top]);
                }
            }
        }
    };
    std::thread::scope(|scope| {
        for band in bands {
            scope.spawn(move || paint(band));
        }
        last.map(paint);
    });
}

/// What the samples of a square and all around it show that could shade it.
#[derive(Clone, Copy, PartialEq)]
enum Around {
    Paper,
    /// One part without a step: no line can be there, and no shade.
    Plain,
    /// One part without a step, but with what may shade it.
    Shaded,
    Mixed,
}

/// How the colours of some samples become those of the picture: times a factor, and something added.
struct Mix {
    factor: [f32; LANES],
    added: [f32; PARTS],
}

impl Ink {
    /// Draws the square of pixels whose first has that place; `rows` are the rows of the picture
    /// from there on.
    fn square(&self, buffers: &Buffers, rows: &mut [Colour], [left, top]: [usize; 2]) {
        let width = buffers.size[0] / self.samples;
        let columns = left..(left + SQUARE).min(width);
        let place = |x: usize, y: usize| buffers.index(x * self.samples, (top + y) * self.samples);
        let size = [columns.len(), rows.len() / width];
        let all = self.alike(buffers, place(left, 0), size);
        if all == Around::Paper {
            return;
        }
        for (y, row) in rows.chunks_mut(width).enumerate() {
            let row = &mut row[columns.clone()];
            let mut sums = [0.0f32; 3 * SQUARE];
            for j in 0..self.samples {
                let start = place(left, y) + j * buffers.stride;
                let end = start + row.len() * self.samples;
                for (nth, at) in (start..end).step_by(LANES).enumerate() {
                    let mut parts = [0.0f32; PARTS];
                    let colours = &buffers.colour[at..end.min(at + LANES)];
                    for (part, from) in parts.iter_mut().zip(colours.as_flattened()) {
                        *part = *from;
                    }
                    match all {
                        Around::Shaded => {
                            let shade = self.shade(buffers, at);
                            for (k, part) in parts.iter_mut().enumerate() {
                                *part *= shade[k / 3];
                            }
                        }
                        Around::Mixed if self.is_within_one(buffers, at, colours.len()) => {
                            let shade = self.shade(buffers, at);
                            for (k, part) in parts.iter_mut().enumerate() {
                                *part *= shade[k / 3];
                            }
                        }
                        Around::Mixed => {
                            let below = |k: usize| row[(nth * LANES + k) / self.samples].0;
                            let mix = self.mix(buffers, at, colours.len(), below);
                            for (k, part) in parts.iter_mut().enumerate() {
                                *part = *part * mix.factor[k / 3] + mix.added[k];
                            }
                        }
                        Around::Plain | Around::Paper => {}
                    }
                    self.sum(&mut sums, nth, &parts);
                }
            }
            self.put(row, &sums);
        }
    }

    /// Adds the colours of samples to those of the pixels that they are in.
    #[inline]
    fn sum(&self, sums: &mut [f32; 3 * SQUARE], nth: usize, parts: &[f32; PARTS]) {
        if self.samples == 1 {
            *sums = *parts;
            return;
        }
        for (k, colour) in parts.chunks_exact(3).enumerate() {
            let pixel = (nth * LANES + k) / self.samples;
            if let Some(sum) = sums.get_mut(3 * pixel..3 * pixel + 3) {
                for (sum, part) in sum.iter_mut().zip(colour) {
                    *sum += part;
                }
            }
        }
    }

    /// Writes the means of pixels over what is there.
    #[inline]
    fn put(&self, row: &mut [Colour], sums: &[f32; 3 * SQUARE]) {
        /// What is added to a number makes its whole part the lowest bits: 2²³.
        const WHOLE: f32 = 8_388_608.0;
        let share = self.opacity / (self.samples * self.samples) as f32;
        let rest = 1.0 - self.opacity;
        let mut below = [0.0f32; 3 * SQUARE];
        if rest > 0.0 {
            for (below, pixel) in below.chunks_exact_mut(3).zip(row.iter()) {
                below.copy_from_slice(&pixel.0.map(f32::from));
            }
        }
        let mut bytes = [0u8; 3 * SQUARE];
        for k in 0..3 * SQUARE {
            let part = sums[k] * share + below[k] * rest;
            bytes[k] = (part.clamp(0.0, 255.0) + WHOLE).to_bits() as u8;
        }
        for (pixel, bytes) in row.iter_mut().zip(bytes.chunks_exact(3)) {
            pixel.0.copy_from_slice(bytes);
        }
    }

    /// Returns what a square of pixels shows together with all that could shade it.
    fn alike(&self, buffers: &Buffers, corner: usize, [width, height]: [usize; 2]) -> Around {
        let beyond = buffers.margin;
        let group = buffers.group[corner];
        let wide = width * self.samples + 2 * beyond;
        let first = corner - beyond * (buffers.stride + 1);
        let rows = height * self.samples + 2 * beyond;
        let row = |j: usize| first + j * buffers.stride..first + j * buffers.stride + wide;
        let same = |j: usize| {
            let row = &buffers.group[row(j)];
            row.iter().fold(0, |all, other| all | (other ^ group)) == 0
        };
        if !(0..rows).all(same) {
            return Around::Mixed;
        }
        if group == 0 {
            return Around::Paper;
        }
        if group >= FLAT {
            return Around::Plain;
        }
        let (mut low, mut high) = (f32::INFINITY, 0.0f32);
        (0..rows).for_each(|j| extremes(&buffers.depth[row(j)], &mut low, &mut high));
        if high - low <= self.step.min(SHADE_STEPS[0]) {
            return Around::Plain;
        }
        if high - low <= self.step {
            return Around::Shaded;
        }
        Around::Mixed
    }

    /// Returns whether samples in a row lie within one part of the body, and no line is near.
    #[inline]
    fn is_within_one(&self, buffers: &Buffers, at: usize, count: usize) -> bool {
        let group = buffers.group[at];
        if group == 0 || group >= FLAT {
            return false;
        }
        let beside = self.beside as isize;
        let (mut low, mut high) = ([f32::INFINITY; LANES], [0.0f32; LANES]);
        let mut other = [0u8; LANES];
        for row in -beside..=beside {
            for column in -beside..=beside {
                let step = row * buffers.stride as isize + column;
                let place = at.wrapping_add_signed(step);
                let (depth, part) = (lanes(&buffers.depth, place), lanes(&buffers.group, place));
                for k in 0..LANES {
                    low[k] = if depth[k] < low[k] { depth[k] } else { low[k] };
                    high[k] = if depth[k] > high[k] {
                        depth[k]
                    } else {
                        high[k]
                    };
                    other[k] |= part[k] ^ group;
                }
            }
        }
        let mut far = [false; LANES];
        for k in 0..LANES {
            far[k] = other[k] != 0 || high[k] - low[k] > self.step;
        }
        !far[..count].contains(&true)
    }

    /// Returns how much light is left where nearer parts lie around, of samples in a row.
    #[inline]
    fn shade(&self, buffers: &Buffers, at: usize) -> [f32; LANES] {
        let own = lanes(&buffers.depth, at);
        let mut behind = [0.0f32; LANES];
        for step in self.far {
            let other = lanes(&buffers.depth, at.wrapping_add_signed(step));
            for k in 0..LANES {
                let before = (own[k] - SHADE_STEPS[0] - other[k]) * (1.0 / SHADE_STEPS[1]);
                let before = if before > 0.0 { before } else { 0.0 };
                behind[k] += if before < 1.0 { before } else { 1.0 };
            }
        }
        behind.map(|behind| 1.0 - behind * (SHADE_STRENGTH / 8.0))
    }

    /// Returns what becomes of the colours of samples in a row, with lines and shades.
    #[inline]
    fn mix(
        &self,
        buffers: &Buffers,
        at: usize,
        count: usize,
        below: impl Fn(usize) -> [u8; 3],
    ) -> Mix {
        let depth = lanes(&buffers.depth, at);
        let group = lanes(&buffers.group, at);
        let mut line = [0.0f32; LANES];
        let mut drawn = [0u8; LANES];
        for step in self.near {
            let beside = at.wrapping_add_signed(step);
            let other = lanes(&buffers.depth, beside);
            let part = lanes(&buffers.group, beside);
            for k in 0..LANES {
                let before = depth[k] - other[k];
                let within = if before > self.step {
                    STRENGTHS[0]
                } else {
                    0.0
                };
                let between = if before > CLEAR_STEP {
                    STRENGTHS[2]
                } else {
                    STRENGTHS[1]
                };
                let strong = if part[k] == group[k] { within } else { between };
                let strong = if before > 0.0 && part[k] < FLAT {
                    strong
                } else {
                    0.0
                };
                line[k] = if strong > line[k] { strong } else { line[k] };
                drawn[k] |= u8::from(part[k].wrapping_sub(1) < FLAT - 1);
            }
        }
        let shade = self.shade(buffers, at);
        let mut mix = Mix {
            factor: [0.0; LANES],
            added: [0.0; PARTS],
        };
        for k in 0..count {
            let (factor, added) = match group[k] {
                0 if drawn[k] != 0 => (0.0, self.outline),
                0 => (0.0, below(k).map(f32::from)),
                FLAT.. => (1.0, [0.0; 3]),
                _ => (
                    shade[k] * (1.0 - line[k]),
                    INNER_LINE.map(|it| it * line[k]),
                ),
            };
            mix.factor[k] = factor;
            mix.added[3 * k..3 * k + 3].copy_from_slice(&added);
        }
        mix
    }
}

/// Returns values in a row, from that place on; the margin of the buffers is wider than what is missing.
#[inline]
fn lanes<T: Copy + Default>(all: &[T], at: usize) -> [T; LANES] {
    let mut some = [T::default(); LANES];
    if let Some(row) = all.get(at..at + LANES) {
        some.copy_from_slice(row);
    }
    some
}

/// Widens `low` and `high` to hold all of `depths`, none of which is NaN; in lanes, so that the
/// compiler can do several at once.
#[inline]
fn extremes(depths: &[f32], low: &mut f32, high: &mut f32) {
    const LANES: usize = 8;
    let (mut lows, mut highs) = ([*low; LANES], [*high; LANES]);
    let chunks = depths.chunks_exact(LANES);
    let rest = chunks.remainder();
    let last = std::iter::once(rest).filter(|rest| !rest.is_empty());
    for chunk in chunks.chain(last) {
        for ((depth, low), high) in chunk.iter().zip(&mut lows).zip(&mut highs) {
            *low = if depth < low { *depth } else { *low };
            *high = if depth > high { *depth } else { *high };
        }
    }
    *low = lows.into_iter().fold(*low, f32::min);
    *high = highs.into_iter().fold(*high, f32::max);
}

/// Returns the steps to the eight places `reach` samples away.
fn around(reach: usize, stride: usize) -> [isize; 8] {
    let (reach, stride) = (reach as isize, stride as isize);
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
    .map(|[x, y]| y * stride + x)
}
