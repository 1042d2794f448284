//! Lines between parts of the body at different depths, shade behind nearer parts, and the
//! averaging of samples to pixels.
//!
//! The shade is a cheap form of *Image enhancement by unsharp masking the depth buffer* (Luft,
//! Colditz, Deussen, ACM Transactions on Graphics 25(3), 2006, p. 1206): it lets fingers stand out
//! before palm and chest.

use std::ops::Range;

use pulp::{Arch, NullaryFnOnce};

use crate::body::group::FIRST_FLAT_GROUP;
use crate::buffers::{SampleBuffers, round_to_byte, unpack_paint};
use crate::image::RasterImage;
use crate::palette::RgbColour;
use crate::raster::FigureStyle;

/// Reach of a shade, in pixels of the finished picture.
const SHADE_REACH_PIXELS: f32 = 2.5;
/// Strength of the darkest shade.
const SHADE_STRENGTH: f32 = 0.38;
/// The depth steps at which a shade begins and at which it is full, in metres.
const SHADE_STEPS: [f32; 2] = [0.006, 0.033];
/// The depth step from which a line between two parts is drawn at full strength, in metres.
const CLEAR_STEP: f32 = 0.004;
/// The depth step from which a line between two parts that touch is drawn, in metres; continuous skin has no such step.
const TOUCH_STEP: f32 = 0.0018;
/// Strengths of lines: within a part, between parts that touch, between parts apart.
const LINE_STRENGTHS: [f32; 3] = [0.75, 0.5, 0.9];
/// The colour of lines within the figure.
const INNER_LINE: [f32; 3] = [34.0, 30.0, 34.0];

/// The bits of packed colours that identify the part.
const PAINT_PART_MASK: u32 = 0xFF << 24;
/// Values of these bits from here on are marks.
const FIRST_MARK_PAINT: u32 = (FIRST_FLAT_GROUP as u32) << 24;

fn reach_in_samples(samples: usize, pixels: f32) -> usize {
    (samples as f32 * pixels).round().max(1.0) as usize
}

/// Returns half the width of a line, in samples; not wider than the margin allows.
fn half_line_width(samples: usize, style: &FigureStyle) -> usize {
    reach_in_samples(samples, style.line.clamp(0.0, SHADE_REACH_PIXELS))
}

/// Returns the width of the paper margin around the picture, in samples.
pub(crate) fn paper_margin(samples: usize) -> usize {
    reach_in_samples(samples, SHADE_REACH_PIXELS) + 1
}

/// Settings for lines and shades; steps are distances between places in the buffers.
#[derive(Clone, Copy)]
struct InkSettings {
    outline: [f32; 3],
    near: [isize; 8],
    far: [isize; 8],
    step: f32,
    touch: f32,
    opacity: f32,
}

/// The number of samples in a row that are processed at once. Large enough for the compiler to vectorise
/// the loops, and a multiple of every number of samples that a pixel may have.
const INK_LANE_SAMPLES: usize = 48;

/// Red, green and blue of some samples or pixels in a row.
type InkLaneColours = [[f32; INK_LANE_SAMPLES]; 3];

/// Draws lines and shades, and averages the samples of each pixel over the background in `image`.
pub(crate) fn ink_picture(
    buffers: &SampleBuffers,
    image: &mut RasterImage,
    samples: usize,
    style: &FigureStyle,
    opacity: f32,
) {
    let ink = InkSettings {
        outline: style.theme.outline_colour().0.map(f32::from),
        near: neighbour_sample_steps(half_line_width(samples, style), buffers.stride),
        // Lines reach as far as half their width, shades farther.
        far: neighbour_sample_steps(reach_in_samples(samples, SHADE_REACH_PIXELS), buffers.stride),
        step: style.step,
        touch: TOUCH_STEP,
        opacity: opacity.clamp(0.0, 1.0),
    };
    // Everything beyond the used area and the reach of a line is paper.
    let ink_reach = half_line_width(samples, style);
    let touched = |axis: usize, size: usize| {
        let used = &buffers.used[axis];
        let first = used.start.saturating_sub(ink_reach) / samples;
        first..(used.end + ink_reach).div_ceil(samples).min(size)
    };
    let width = image.image_width();
    let (columns, rows) = (touched(0, width), touched(1, image.image_height()));
    // Nothing was drawn: the background stays as it is.
    if columns.is_empty() || rows.is_empty() || buffers.used[1].is_empty() {
        return;
    }
    let each = rows.len().div_ceil(style.threads.max(1));
    let pixels = &mut image.pixels_mut()[rows.start * width..rows.end * width];
    let band_iterator = pixels.chunks_mut(each * width).enumerate();
    let mut bands: Vec<_> = band_iterator
        .map(|(band, pixels)| InkingTask {
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
            // The last band is drawn by this thread, which would only wait otherwise.
            scope.spawn(|| Arch::new().dispatch(band));
        }
        if let Some(band) = last {
            Arch::new().dispatch(band);
        }
    });
}

/// A call that is compiled for each instruction set and selected at run time: some rows of the picture.
struct InkingTask<'a> {
    ink: InkSettings,
    buffers: &'a SampleBuffers,
    samples: usize,
    /// The first row.
    first: usize,
    columns: Range<usize>,
    width: usize,
    pixels: &'a mut [RgbColour],
}

impl NullaryFnOnce for InkingTask<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        // One and two samples are usual and get code without tests for marks.
        match (self.samples, self.buffers.marked) {
            (1, false) => self.ink_picture_rows::<1, false>(),
            (2, false) => self.ink_picture_rows::<2, false>(),
            (1, true) => self.ink_picture_rows::<1, true>(),
            (2, true) => self.ink_picture_rows::<2, true>(),
            (3, _) => self.ink_picture_rows::<3, true>(),
            (_, _) => self.ink_picture_rows::<4, true>(),
        }
    }
}

impl InkingTask<'_> {
    #[inline(always)]
    fn ink_picture_rows<const ROW_PIXEL_SAMPLES: usize, const HAS_MARKED_ROWS: bool>(self) {
        for (y, row) in self.pixels.chunks_mut(self.width).enumerate() {
            let row = &mut row[..self.columns.end];
            for left in self.columns.clone().step_by(INK_LANE_SAMPLES) {
                let pixel_index = self
                    .buffers
                    .index(left * ROW_PIXEL_SAMPLES, (self.first + y) * ROW_PIXEL_SAMPLES);
                let end = row.len().min(left + INK_LANE_SAMPLES);
                self.ink.ink_picture_strip::<ROW_PIXEL_SAMPLES, HAS_MARKED_ROWS>(
                    self.buffers,
                    pixel_index,
                    &mut row[left..end],
                );
            }
        }
    }
}

impl InkSettings {
    /// Draws some pixels in a row; the index is that of the first pixel's first sample in the buffers.
    #[inline(always)]
    fn ink_picture_strip<const STRIP_PIXEL_SAMPLES: usize, const HAS_MARKED_STRIP: bool>(
        &self,
        buffers: &SampleBuffers,
        at: usize,
        row: &mut [RgbColour],
    ) {
        let mut paper = true;
        for j in 0..STRIP_PIXEL_SAMPLES {
            for nth in 0..STRIP_PIXEL_SAMPLES {
                paper &= self.is_paper(buffers, at + j * buffers.stride + nth * INK_LANE_SAMPLES);
            }
        }
        // Most strips are paper and need no work.
        if paper {
            return;
        }
        let mut below = [[0.0f32; INK_LANE_SAMPLES]; 3];
        for (k, pixel) in row.iter().enumerate() {
            for (below, part) in below.iter_mut().zip(pixel.0) {
                below[k] = f32::from(part);
            }
        }
        let mut sums = [[0.0f32; INK_LANE_SAMPLES]; 3];
        for j in 0..STRIP_PIXEL_SAMPLES {
            for nth in 0..STRIP_PIXEL_SAMPLES {
                // Lanes hold samples, and several of them belong to one pixel.
                let (first, each) = (
                    nth * (INK_LANE_SAMPLES / STRIP_PIXEL_SAMPLES),
                    INK_LANE_SAMPLES / STRIP_PIXEL_SAMPLES,
                );
                let mut under = [[0.0f32; INK_LANE_SAMPLES]; 3];
                for part in 0..3 {
                    for (under, below) in under[part]
                        .chunks_exact_mut(STRIP_PIXEL_SAMPLES)
                        .zip(&below[part][first..first + each])
                    {
                        for under in under {
                            *under = *below;
                        }
                    }
                }
                let place = at + j * buffers.stride + nth * INK_LANE_SAMPLES;
                let inked = self.inked::<HAS_MARKED_STRIP>(buffers, place, &under);
                for part in 0..3 {
                    for (sum, inked) in sums[part][first..first + each]
                        .iter_mut()
                        .zip(inked[part].chunks_exact(STRIP_PIXEL_SAMPLES))
                    {
                        for inked in inked {
                            *sum += inked;
                        }
                    }
                }
            }
        }
        let share = self.opacity / (STRIP_PIXEL_SAMPLES * STRIP_PIXEL_SAMPLES) as f32;
        let rest = 1.0 - self.opacity;
        let mut bytes = [[0u32; INK_LANE_SAMPLES]; 3];
        for part in 0..3 {
            for k in 0..INK_LANE_SAMPLES {
                let mean = sums[part][k] * share + below[part][k] * rest;
                bytes[part][k] = round_to_byte(if mean < 255.0 { mean } else { 255.0 });
            }
        }
        for (k, pixel) in row.iter_mut().enumerate() {
            pixel.0 = [bytes[0][k] as u8, bytes[1][k] as u8, bytes[2][k] as u8];
        }
    }

    /// Returns whether samples in a row and everything within the reach of a line are paper.
    #[inline(always)]
    fn is_paper(&self, buffers: &SampleBuffers, at: usize) -> bool {
        let mut any = [0; INK_LANE_SAMPLES];
        any.copy_from_slice(lane_values(&buffers.paint, at, &[0; INK_LANE_SAMPLES]));
        for step in self.near {
            let neighbour_paint = lane_values(&buffers.paint, at.wrapping_add_signed(step), &[0; INK_LANE_SAMPLES]);
            for k in 0..INK_LANE_SAMPLES {
                any[k] |= neighbour_paint[k];
            }
        }
        any.iter().fold(0, |all, one| all | one) == 0
    }

    /// Returns the colours of samples in a row, with lines and shades; `below` is the background that
    /// paper shows.
    #[inline(always)]
    fn inked<const HAS_MARKED_SAMPLES: bool>(
        &self,
        buffers: &SampleBuffers,
        at: usize,
        below: &InkLaneColours,
    ) -> InkLaneColours {
        const FAR_LANE_DEPTHS: [f32; INK_LANE_SAMPLES] = [f32::INFINITY; INK_LANE_SAMPLES];
        let depth = lane_values(&buffers.depth, at, &FAR_LANE_DEPTHS);
        let paint = lane_values(&buffers.paint, at, &[0; INK_LANE_SAMPLES]);
        // The depth steps to nearer neighbours, of the same part and of others; infinite next to paper.
        let (mut within, mut between) = ([0.0f32; INK_LANE_SAMPLES], [0.0f32; INK_LANE_SAMPLES]);
        for step in self.near {
            let neighbour_index = at.wrapping_add_signed(step);
            let other = lane_values(&buffers.depth, neighbour_index, &FAR_LANE_DEPTHS);
            let part = lane_values(&buffers.paint, neighbour_index, &[0; INK_LANE_SAMPLES]);
            for k in 0..INK_LANE_SAMPLES {
                let depth_gap = depth[k] - other[k];
                let before = if depth_gap > 0.0 { depth_gap } else { 0.0 };
                // A mark in front draws no line on what is behind it.
                let before = if HAS_MARKED_SAMPLES && part[k] >= FIRST_MARK_PAINT {
                    0.0
                } else {
                    before
                };
                // Parts are equal if their bits are, whatever their colours.
                let same = (part[k] ^ paint[k]) & PAINT_PART_MASK == 0;
                let (own, apart) = if same { (before, 0.0) } else { (0.0, before) };
                within[k] = if own > within[k] { own } else { within[k] };
                between[k] = if apart > between[k] { apart } else { between[k] };
            }
        }
        let mut behind = [0.0f32; INK_LANE_SAMPLES];
        for step in self.far {
            let other = lane_values(&buffers.depth, at.wrapping_add_signed(step), &FAR_LANE_DEPTHS);
            for k in 0..INK_LANE_SAMPLES {
                // A step below the first threshold throws no shade.
                let depth_gap = (depth[k] - SHADE_STEPS[0]) - other[k];
                let before = if depth_gap > 0.0 { depth_gap } else { 0.0 };
                behind[k] += if before < SHADE_STEPS[1] {
                    before
                } else {
                    SHADE_STEPS[1]
                };
            }
        }
        let (mut light, mut line) = ([0.0f32; INK_LANE_SAMPLES], [0.0f32; INK_LANE_SAMPLES]);
        for k in 0..INK_LANE_SAMPLES {
            let ink_strength = if within[k] > self.step { LINE_STRENGTHS[0] } else { 0.0 };
            let clear = if between[k] > CLEAR_STEP {
                LINE_STRENGTHS[2]
            } else {
                LINE_STRENGTHS[1]
            };
            let apart = if between[k] > self.touch { clear } else { 0.0 };
            // The stronger of both lines, since they would be too dark together.
            line[k] = if ink_strength > apart { ink_strength } else { apart };
            light[k] = (1.0 - behind[k] * (SHADE_STRENGTH / 8.0 / SHADE_STEPS[1])) * (1.0 - line[k]);
        }
        let mut inked = [[0.0f32; INK_LANE_SAMPLES]; 3];
        for part in 0..3 {
            for k in 0..INK_LANE_SAMPLES {
                let lit = unpack_paint(paint[k], part);
                let inner = lit * light[k] + INNER_LINE[part] * line[k];
                let marked = if HAS_MARKED_SAMPLES && paint[k] >= FIRST_MARK_PAINT {
                    lit
                } else {
                    inner
                };
                let outline = self.outline[part];
                // Paper next to a surface is where the outline lies.
                let paper = if between[k] > 0.0 { outline } else { below[part][k] };
                inked[part][k] = if paint[k] == 0 { paper } else { marked };
            }
        }
        inked
    }
}

/// Returns values in a row from an index on; `other` values beyond the end.
#[inline(always)]
fn lane_values<'a, T>(all: &'a [T], at: usize, missing: &'a [T; INK_LANE_SAMPLES]) -> &'a [T; INK_LANE_SAMPLES] {
    let row = all.get(at..).and_then(|row| row.first_chunk());
    row.unwrap_or(missing)
}

/// Returns the steps to the eight places `reach` samples away.
fn neighbour_sample_steps(reach: usize, stride: usize) -> [isize; 8] {
    let (reach, stride) = (reach as isize, stride as isize);
    // Three quarters stand for the diagonal's 0.71, rounded to whole samples.
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
