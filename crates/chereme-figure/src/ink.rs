//! Lines where one part of the body lies before another, shade behind what is nearer, and the
//! averaging of samples to pixels.
//!
//! The shade is a cheap form of *Image enhancement by unsharp masking the depth buffer* (Luft,
//! Colditz, Deussen, ACM Transactions on Graphics 25(3), 2006, p. 1206): it lets fingers stand out
//! before palm and chest.

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
    paper: [f32; 3],
    outline: [f32; 3],
    near: [isize; 8],
    far: [isize; 8],
    step: f32,
    beside: usize,
}

/// Draws lines and shades, and averages the samples of each pixel.
pub(crate) fn finish(buffers: &Buffers, size: [usize; 2], samples: usize, style: &Style) -> Image {
    let mut image = Image::new(size[0], size[1], style.theme.background());
    let ink = Ink {
        paper: style.theme.background().0.map(f32::from),
        outline: style.theme.outline().0.map(f32::from),
        near: around(reach(samples, LINE), buffers.stride),
        far: around(reach(samples, SHADE), buffers.stride),
        step: style.step,
        beside: reach(samples, LINE),
    };
    let covered = covered(buffers);
    let share = 1.0 / (samples * samples) as f32;
    for (y, row) in image.pixels_mut().chunks_mut(size[0].max(1)).enumerate() {
        let beside = ink.beside;
        let rows = (y * samples).saturating_sub(beside)..(y + 1) * samples + beside;
        let ranges = covered.iter().take(rows.end).skip(rows.start).flatten();
        let Some((left, right)) = ranges.copied().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
        else {
            continue;
        };
        let first = left.saturating_sub(beside) / samples;
        let last = ((right + beside) / samples).min(size[0] - 1);
        for (x, pixel) in row.iter_mut().enumerate().take(last + 1).skip(first) {
            let corner = buffers.index(x * samples, y * samples);
            let sum = ink.pixel(buffers, corner, samples);
            *pixel = Colour(sum.map(|part| (part * share + 0.5).clamp(0.0, 255.0) as u8));
        }
    }
    image
}

/// Returns for each row of samples its first and last that is not paper.
fn covered(buffers: &Buffers) -> Vec<Option<(usize, usize)>> {
    let [width, height] = buffers.size;
    let row = |y: usize| {
        let start = buffers.index(0, y);
        let row = &buffers.group[start..start + width];
        let first = row.iter().position(|&group| group != 0)?;
        let last = row.iter().rposition(|&group| group != 0)?;
        Some((first, last))
    };
    (0..height).map(row).collect()
}

/// What a pixel and the samples within a line's reach of it show.
enum Around {
    Paper,
    /// One part without a step: no line can be there.
    Plain,
    Mixed,
}

impl Ink {
    /// Returns the sum of the colours of the samples of the pixel whose first one is `corner`.
    #[inline]
    fn pixel(&self, buffers: &Buffers, corner: usize, samples: usize) -> [f32; 3] {
        let rows = (0..samples).map(|j| corner + j * buffers.stride);
        let all = rows.flat_map(|start| start..start + samples);
        let mut sum = [0.0; 3];
        let mut add = |colour: [f32; 3]| {
            for (total, part) in sum.iter_mut().zip(colour) {
                *total += part;
            }
        };
        match self.around(buffers, corner, samples) {
            Around::Paper => add(self.paper.map(|part| part * (samples * samples) as f32)),
            Around::Plain => {
                let shade = self.shade(buffers, corner);
                all.for_each(|index| add(buffers.colour[index].map(|part| part * shade)));
            }
            Around::Mixed => all.for_each(|index| add(self.sample(buffers, index))),
        }
        sum
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
                low = low.min(depth);
                high = high.max(depth);
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
    fn sample(&self, buffers: &Buffers, index: usize) -> [f32; 3] {
        let (depth, group) = (buffers.depth[index], buffers.group[index]);
        let at = |step: isize| index.wrapping_add_signed(step);
        if group == 0 {
            let beside = self.near.iter().any(|&step| buffers.group[at(step)] != 0);
            return if beside { self.outline } else { self.paper };
        }
        let mut line = 0.0f32;
        for &step in &self.near {
            let before = depth - buffers.depth[at(step)];
            if before > 0.0 {
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
