//! Lines between parts of the body at different depths, shade behind nearer parts, and the
//! averaging of samples to pixels.
//!
//! The shade is a cheap form of *Image enhancement by unsharp masking the depth buffer* (Luft,
//! Colditz, Deussen, ACM Transactions on Graphics 25(3), 2006, p. 1206): it lets fingers stand out
//! before palm and chest.

use std::ops::Range;

use pulp::{Arch, NullaryFnOnce};

use crate::body::group::FLAT;
use crate::buffers::{Buffers, unpacked, whole};
use crate::image::Image;
use crate::palette::Colour;
use crate::raster::Style;

/// Reach of a shade, in pixels of the finished picture.
const SHADE: f32 = 2.5;
/// Strength of the darkest shade.
const SHADE_STRENGTH: f32 = 0.38;
/// The depth steps at which a shade begins and at which it is full, in metres.
const SHADE_STEPS: [f32; 2] = [0.006, 0.033];
/// The depth step from which a line between two parts is drawn at full strength, in metres.
const CLEAR_STEP: f32 = 0.004;
/// The depth step from which a line between two parts that touch is drawn, in metres; continuous skin has no such step.
const TOUCH_STEP: f32 = 0.0018;
/// Strengths of lines: within a part, between parts that touch, between parts apart.
const STRENGTHS: [f32; 3] = [0.75, 0.5, 0.9];
/// The colour of lines within the figure.
const INNER_LINE: [f32; 3] = [34.0, 30.0, 34.0];

/// The bits of packed colours that identify the part.
const PART: u32 = 0xFF << 24;
/// Values of these bits from here on are marks.
const MARKS: u32 = (FLAT as u32) << 24;

fn reach(samples: usize, pixels: f32) -> usize {
    (samples as f32 * pixels).round().max(1.0) as usize
}

/// Returns half the width of a line, in samples; not wider than the margin allows.
fn line(samples: usize, style: &Style) -> usize {
    reach(samples, style.line.clamp(0.0, SHADE))
}

/// Returns the width of the paper margin around the picture, in samples.
pub(crate) fn margin(samples: usize) -> usize {
    reach(samples, SHADE) + 1
}

/// Settings for lines and shades; steps are distances between places in the buffers.
#[derive(Clone, Copy)]
struct Ink {
    outline: [f32; 3],
    near: [isize; 8],
    far: [isize; 8],
    step: f32,
    touch: f32,
    opacity: f32,
}

/// The number of samples in a row that are processed at once. Large enough for the compiler to vectorise
/// the loops, and a multiple of every number of samples that a pixel may have.
const LANES: usize = 48;

/// Red, green and blue of some samples or pixels in a row.
type Colours = [[f32; LANES]; 3];

/// Draws lines and shades, and averages the samples of each pixel over the background in `image`.
pub(crate) fn finish(
    buffers: &Buffers,
    image: &mut Image,
    samples: usize,
    style: &Style,
    opacity: f32,
) {
    let ink = Ink {
        outline: style.theme.outline().0.map(f32::from),
        near: around(line(samples, style), buffers.stride),
        far: around(reach(samples, SHADE), buffers.stride),
        step: style.step,
        touch: TOUCH_STEP,
        opacity: opacity.clamp(0.0, 1.0),
    };
    // Everything beyond the used area and the reach of a line is paper.
    let beside = line(samples, style);
    let touched = |axis: usize, size: usize| {
        let used = &buffers.used[axis];
        let first = used.start.saturating_sub(beside) / samples;
        first..(used.end + beside).div_ceil(samples).min(size)
    };
    let width = image.width();
    let (columns, rows) = (touched(0, width), touched(1, image.height()));
    if columns.is_empty() || rows.is_empty() || buffers.used[1].is_empty() {
        return;
    }
    let each = rows.len().div_ceil(style.threads.max(1));
    let pixels = &mut image.pixels_mut()[rows.start * width..rows.end * width];
    let bands = pixels.chunks_mut(each * width).enumerate();
    let mut bands: Vec<_> = bands
        .map(|(band, pixels)| Inking {
            ink,
            buffers,
            samples,
            first: rows.start + band * each,
            columns: columns.clone(),
            width,
            pixels,
        })
        .collect();
    let last = bands.pop();
    std::thread::scope(|scope| {
        for band in bands {
            scope.spawn(|| Arch::new().dispatch(band));
        }
        if let Some(band) = last {
            Arch::new().dispatch(band);
        }
    });
}

/// A call that is compiled for each instruction set and selected at run time: some rows of the picture.
struct Inking<'a> {
    ink: Ink,
    buffers: &'a Buffers,
    samples: usize,
    /// The first row.
    first: usize,
    columns: Range<usize>,
    width: usize,
    pixels: &'a mut [Colour],
}

impl NullaryFnOnce for Inking<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        match (self.samples, self.buffers.marked) {
            (1, false) => self.rows::<1, false>(),
            (2, false) => self.rows::<2, false>(),
            (1, true) => self.rows::<1, true>(),
            (2, true) => self.rows::<2, true>(),
            (3, _) => self.rows::<3, true>(),
            (_, _) => self.rows::<4, true>(),
        }
    }
}

impl Inking<'_> {
    #[inline(always)]
    fn rows<const SAMPLES: usize, const MARKED: bool>(self) {
        for (y, row) in self.pixels.chunks_mut(self.width).enumerate() {
            let row = &mut row[..self.columns.end];
            for left in self.columns.clone().step_by(LANES) {
                let at = self
                    .buffers
                    .index(left * SAMPLES, (self.first + y) * SAMPLES);
                let end = row.len().min(left + LANES);
                self.ink
                    .strip::<SAMPLES, MARKED>(self.buffers, at, &mut row[left..end]);
            }
        }
    }
}

impl Ink {
    /// Draws some pixels in a row; the index is that of the first pixel's first sample in the buffers.
    #[inline(always)]
    fn strip<const SAMPLES: usize, const MARKED: bool>(
        &self,
        buffers: &Buffers,
        at: usize,
        row: &mut [Colour],
    ) {
        let mut paper = true;
        for j in 0..SAMPLES {
            for nth in 0..SAMPLES {
                paper &= self.is_paper(buffers, at + j * buffers.stride + nth * LANES);
            }
        }
        if paper {
            return;
        }
        let mut below = [[0.0f32; LANES]; 3];
        for (k, pixel) in row.iter().enumerate() {
            for (below, part) in below.iter_mut().zip(pixel.0) {
                below[k] = f32::from(part);
            }
        }
        let mut sums = [[0.0f32; LANES]; 3];
        for j in 0..SAMPLES {
            for nth in 0..SAMPLES {
                let (first, each) = (nth * (LANES / SAMPLES), LANES / SAMPLES);
                let mut under = [[0.0f32; LANES]; 3];
                for part in 0..3 {
                    for (under, below) in under[part]
                        .chunks_exact_mut(SAMPLES)
                        .zip(&below[part][first..first + each])
                    {
                        for under in under {
                            *under = *below;
                        }
                    }
                }
                let place = at + j * buffers.stride + nth * LANES;
                let inked = self.inked::<MARKED>(buffers, place, &under);
                for part in 0..3 {
                    for (sum, inked) in sums[part][first..first + each]
                        .iter_mut()
                        .zip(inked[part].chunks_exact(SAMPLES))
                    {
                        for inked in inked {
                            *sum += inked;
                        }
                    }
                }
            }
        }
        let share = self.opacity / (SAMPLES * SAMPLES) as f32;
        let rest = 1.0 - self.opacity;
        let mut bytes = [[0u32; LANES]; 3];
        for part in 0..3 {
            for k in 0..LANES {
                let mean = sums[part][k] * share + below[part][k] * rest;
                bytes[part][k] = whole(if mean < 255.0 { mean } else { 255.0 });
            }
        }
        for (k, pixel) in row.iter_mut().enumerate() {
            pixel.0 = [bytes[0][k] as u8, bytes[1][k] as u8, bytes[2][k] as u8];
        }
    }

    /// Returns whether samples in a row and everything within the reach of a line are paper.
    #[inline(always)]
    fn is_paper(&self, buffers: &Buffers, at: usize) -> bool {
        let mut any = [0; LANES];
        any.copy_from_slice(lanes(&buffers.paint, at, &[0; LANES]));
        for step in self.near {
            let beside = lanes(&buffers.paint, at.wrapping_add_signed(step), &[0; LANES]);
            for k in 0..LANES {
                any[k] |= beside[k];
            }
        }
        any.iter().fold(0, |all, one| all | one) == 0
    }

    /// Returns the colours of samples in a row, with lines and shades; `below` is the background that
    /// paper shows.
    #[inline(always)]
    fn inked<const MARKED: bool>(&self, buffers: &Buffers, at: usize, below: &Colours) -> Colours {
        const FAR: [f32; LANES] = [f32::INFINITY; LANES];
        let depth = lanes(&buffers.depth, at, &FAR);
        let paint = lanes(&buffers.paint, at, &[0; LANES]);
        // The depth steps to nearer neighbours, of the same part and of others; infinite next to paper.
        let (mut within, mut between) = ([0.0f32; LANES], [0.0f32; LANES]);
        for step in self.near {
            let beside = at.wrapping_add_signed(step);
            let other = lanes(&buffers.depth, beside, &FAR);
            let part = lanes(&buffers.paint, beside, &[0; LANES]);
            for k in 0..LANES {
                let before = depth[k] - other[k];
                let before = if before > 0.0 { before } else { 0.0 };
                let before = if MARKED && part[k] >= MARKS {
                    0.0
                } else {
                    before
                };
                let same = (part[k] ^ paint[k]) & PART == 0;
                let (own, apart) = if same { (before, 0.0) } else { (0.0, before) };
                within[k] = if own > within[k] { own } else { within[k] };
                between[k] = if apart > between[k] {
                    apart
                } else {
                    between[k]
                };
            }
        }
        let mut behind = [0.0f32; LANES];
        for step in self.far {
            let other = lanes(&buffers.depth, at.wrapping_add_signed(step), &FAR);
            for k in 0..LANES {
                let before = (depth[k] - SHADE_STEPS[0]) - other[k];
                let before = if before > 0.0 { before } else { 0.0 };
                behind[k] += if before < SHADE_STEPS[1] {
                    before
                } else {
                    SHADE_STEPS[1]
                };
            }
        }
        let (mut light, mut line) = ([0.0f32; LANES], [0.0f32; LANES]);
        for k in 0..LANES {
            let own = if within[k] > self.step {
                STRENGTHS[0]
            } else {
                0.0
            };
            let clear = if between[k] > CLEAR_STEP {
                STRENGTHS[2]
            } else {
                STRENGTHS[1]
            };
            let apart = if between[k] > self.touch { clear } else { 0.0 };
            line[k] = if own > apart { own } else { apart };
            light[k] =
                (1.0 - behind[k] * (SHADE_STRENGTH / 8.0 / SHADE_STEPS[1])) * (1.0 - line[k]);
        }
        let mut inked = [[0.0f32; LANES]; 3];
        for part in 0..3 {
            for k in 0..LANES {
                let lit = unpacked(paint[k], part);
                let inner = lit * light[k] + INNER_LINE[part] * line[k];
                let marked = if MARKED && paint[k] >= MARKS {
                    lit
                } else {
                    inner
                };
                let outline = self.outline[part];
                let paper = if between[k] > 0.0 {
                    outline
                } else {
                    below[part][k]
                };
                inked[part][k] = if paint[k] == 0 { paper } else { marked };
            }
        }
        inked
    }
}

/// Returns values in a row from an index on; `other` values beyond the end.
#[inline(always)]
fn lanes<'a, T>(all: &'a [T], at: usize, missing: &'a [T; LANES]) -> &'a [T; LANES] {
    let row = all.get(at..).and_then(|row| row.first_chunk());
    row.unwrap_or(missing)
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
