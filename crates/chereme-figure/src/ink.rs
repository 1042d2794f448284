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
    beside: usize,
    samples: usize,
    opacity: f32,
}

/// The side of the squares that are looked at together, in pixels.
const SQUARE: usize = 8;

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
    let paint = |(band, pixels): (usize, &mut [Colour])| {
        for (row, pixels) in pixels.chunks_mut(SQUARE * width).enumerate() {
            for left in (0..width).step_by(SQUARE) {
                ink.square(buffers, pixels, [left, band * each + row * SQUARE]);
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

/// What a pixel and the samples within a line's reach of it show.
enum Around {
    Paper,
    /// One part without a step: no line can be there.
    Plain,
    /// One part without a step, but with what may shade it.
    Shaded,
    Mixed,
}

impl Ink {
    /// Draws the square of pixels whose first has that place; `rows` are the rows of the picture
    /// from there on.
    fn square(&self, buffers: &Buffers, rows: &mut [Colour], [left, top]: [usize; 2]) {
        let width = buffers.size[0] / self.samples;
        let columns = left..(left + SQUARE).min(width);
        let place = |x: usize, y: usize| buffers.index(x * self.samples, (top + y) * self.samples);
        let all = self.alike(buffers, place(left, 0), [columns.len(), rows.len() / width]);
        if matches!(all, Around::Paper) {
            return;
        }
        for (y, row) in rows.chunks_mut(width).enumerate() {
            for x in columns.clone() {
                let corner = place(x, y);
                row[x] = match all {
                    Around::Plain => self.plain(buffers, corner, row[x], 1.0),
                    Around::Shaded => {
                        let shade = self.shade(buffers, corner);
                        self.plain(buffers, corner, row[x], shade)
                    }
                    _ => self.pixel(buffers, corner, row[x]),
                };
            }
        }
    }

    /// Returns what a square of pixels shows together with all that could shade it.
    fn alike(&self, buffers: &Buffers, corner: usize, [width, height]: [usize; 2]) -> Around {
        let beyond = buffers.margin;
        let group = buffers.group[corner];
        let wide = width * self.samples + 2 * beyond;
        let (mut low, mut high) = (f32::INFINITY, 0.0f32);
        for j in 0..height * self.samples + 2 * beyond {
            let start = corner + j * buffers.stride - beyond * (buffers.stride + 1);
            let row = &buffers.group[start..start + wide];
            if row.iter().fold(0, |all, other| all | (other ^ group)) != 0 {
                return Around::Mixed;
            }
            if group != 0 {
                extremes(&buffers.depth[start..start + wide], &mut low, &mut high);
            }
        }
        match group {
            0 => Around::Paper,
            FLAT.. => Around::Plain,
            _ if high - low <= self.step.min(SHADE_STEPS[0]) => Around::Plain,
            _ if high - low <= self.step => Around::Shaded,
            _ => Around::Mixed,
        }
    }

    /// Returns the colour of the pixel whose first sample is `corner` over `below`.
    #[inline]
    fn pixel(&self, buffers: &Buffers, corner: usize, below: Colour) -> Colour {
        match self.around(buffers, corner, self.samples) {
            Around::Paper => below,
            Around::Plain | Around::Shaded => {
                let shade = match buffers.group[corner] {
                    FLAT.. => 1.0,
                    _ => self.shade(buffers, corner),
                };
                self.plain(buffers, corner, below, shade)
            }
            Around::Mixed => {
                let paper = below.0.map(f32::from);
                let each = |index| self.sample(buffers, index, paper);
                self.mean(corner, buffers.stride, below, each)
            }
        }
    }

    /// Returns the mean of a pixel's samples, none of them paper, in that light, over `below`.
    #[inline]
    fn plain(&self, buffers: &Buffers, corner: usize, below: Colour, light: f32) -> Colour {
        let each = |index: usize| buffers.colour[index].map(|part| part * light);
        self.mean(corner, buffers.stride, below, each)
    }

    #[inline]
    fn mean(
        &self,
        corner: usize,
        stride: usize,
        below: Colour,
        each: impl Fn(usize) -> [f32; 3],
    ) -> Colour {
        let mut sum = [0.0; 3];
        for j in 0..self.samples {
            let start = corner + j * stride;
            for index in start..start + self.samples {
                for (total, part) in sum.iter_mut().zip(each(index)) {
                    *total += part;
                }
            }
        }
        let share = self.opacity / (self.samples * self.samples) as f32;
        Colour(std::array::from_fn(|i| {
            let part = sum[i] * share + f32::from(below.0[i]) * (1.0 - self.opacity);
            (part + 0.5).clamp(0.0, 255.0) as u8
        }))
    }

    fn around(&self, buffers: &Buffers, corner: usize, samples: usize) -> Around {
        let group = buffers.group[corner];
        let (mut same, mut low, mut high) = (true, f32::INFINITY, 0.0f32);
        let side = samples + 2 * self.beside;
        for j in 0..side {
            let start = corner + j * buffers.stride - self.beside * (buffers.stride + 1);
            same &= buffers.group[start..start + side]
                .iter()
                .all(|&other| other == group);
            for &depth in &buffers.depth[start..start + side] {
                low = if depth < low { depth } else { low };
                high = if depth > high { depth } else { high };
            }
        }
        match (same, group) {
            (true, 0) => Around::Paper,
            (true, _) if high - low <= self.step => Around::Plain,
            _ => Around::Mixed,
        }
    }

    /// Returns how much light is left where nearer parts lie around.
    #[inline]
    fn shade(&self, buffers: &Buffers, index: usize) -> f32 {
        let depth = buffers.depth[index] - SHADE_STEPS[0];
        let behind = self.far.map(|step| {
            let before = depth - buffers.depth[index.wrapping_add_signed(step)];
            (before * (1.0 / SHADE_STEPS[1])).clamp(0.0, 1.0)
        });
        1.0 - behind.iter().sum::<f32>() / 8.0 * SHADE_STRENGTH
    }

    /// Returns the colour of one sample with its line and its shade.
    #[inline]
    fn sample(&self, buffers: &Buffers, index: usize, paper: [f32; 3]) -> [f32; 3] {
        let (depth, group) = (buffers.depth[index], buffers.group[index]);
        let at = |step: isize| index.wrapping_add_signed(step);
        if group == 0 {
            let drawn = |&step: &isize| (1..FLAT).contains(&buffers.group[at(step)]);
            let beside = self.near.iter().any(drawn);
            return if beside { self.outline } else { paper };
        }
        if group >= FLAT {
            return buffers.colour[index];
        }
        let mut line = 0.0f32;
        for &step in &self.near {
            let before = depth - buffers.depth[at(step)];
            if before > 0.0 && buffers.group[at(step)] < FLAT {
                line = line.max(self.line(group == buffers.group[at(step)], before));
            }
        }
        let shade = self.shade(buffers, index);
        let colour = buffers.colour[index];
        std::array::from_fn(|i| colour[i] * shade * (1.0 - line) + INNER_LINE[i] * line)
    }

    /// Returns how strong the line is on what lies `before` metres behind its neighbour.
    fn line(&self, same_part: bool, before: f32) -> f32 {
        match same_part {
            true if before > self.step => STRENGTHS[0],
            true => 0.0,
            false if before > CLEAR_STEP => STRENGTHS[2],
            false => STRENGTHS[1],
        }
    }
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
