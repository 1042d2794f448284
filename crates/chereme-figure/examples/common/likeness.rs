//! How alike small pictures look: the distance of their lightness, and what a set of them has in common.

use chereme_figure::RasterImage;

/// Lightness of a picture, and which pixels differ from the paper.
pub(crate) struct Tones {
    /// Columns and rows.
    size: [usize; 2],
    light: Vec<f32>,
    inked: Vec<bool>,
    /// The farthest shift in pixels at which another picture is compared.
    shift: usize,
}

pub(crate) fn tones(image: &RasterImage) -> Tones {
    let paper = image.image_pixel_at(0, 0);
    Tones {
        size: [image.image_width(), image.image_height()],
        light: image.image_pixels().iter().map(|pixel| lightness(pixel.0)).collect(),
        inked: image.image_pixels().iter().map(|&pixel| pixel != paper).collect(),
        shift: (image.image_height() / 32).max(1),
    }
}

impl Tones {
    /// Returns the same picture, to be compared without shifts: the position in it counts.
    #[allow(dead_code, reason = "hands may lie anywhere in their pictures")]
    pub(crate) fn fixed(self) -> Self {
        Self { shift: 0, ..self }
    }
}

/// Returns the lightness of a colour as in CIE L*a*b*, from 0 to 100.
fn lightness(rgb: [u8; 3]) -> f32 {
    let [r, g, b] = rgb.map(|part| {
        let part = f32::from(part) / 255.0;
        if part <= 0.04045 {
            part / 12.92
        } else {
            ((part + 0.055) / 1.055).powf(2.4)
        }
    });
    let bright = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    if bright > 0.008_856 {
        116.0 * bright.cbrt() - 16.0
    } else {
        903.3 * bright
    }
}

/// Returns the root mean square difference of lightness over the pixels of both hands, the least over small shifts.
pub(crate) fn distance(a: &Tones, b: &Tones) -> f32 {
    let [wide, high] = a.size.map(|side| side as i64);
    let most = a.shift.min(b.shift) as i64;
    let mut least = f32::INFINITY;
    for dy in -most..=most {
        for dx in -most..=most {
            let (mut sum, mut count) = (0.0f32, 0usize);
            for y in 0..high {
                for x in 0..wide {
                    let own = (y * wide + x) as usize;
                    let (u, v) = (x + dx, y + dy);
                    let inside = (0..wide).contains(&u) && (0..high).contains(&v);
                    let other = inside.then_some((v * wide + u) as usize);
                    let inked = a.inked[own] || other.is_some_and(|other| b.inked[other]);
                    if inked {
                        let light = other.map_or(b.light[0], |other| b.light[other]);
                        sum += (a.light[own] - light).powi(2);
                        count += 1;
                    }
                }
            }
            least = least.min((sum / count.max(1) as f32).sqrt() / 100.0);
        }
    }
    least
}

/// Returns the nearest of some pictures, and its distance.
pub(crate) fn nearest(all: &[Tones], one: &Tones, among: impl Iterator<Item = usize>) -> Option<(f32, usize)> {
    among
        .map(|index| (distance(&all[index], one), index))
        .min_by(|a, b| a.0.total_cmp(&b.0))
}

/// Returns the cells of a row about pictures: mean and fifth percentile of the distance to the nearest other picture,
/// the number of pictures nearer than 0.08, further cells, and the nearest pairs.
pub(crate) fn summary(drawn: &[Tones], names: &[&str], further: &[String]) -> String {
    let others = |a: usize| (0..drawn.len()).filter(move |&b| b != a);
    let mut near: Vec<(f32, usize, usize)> = (0..drawn.len())
        .filter_map(|a| nearest(drawn, &drawn[a], others(a)).map(|(far, b)| (far, a, b)))
        .collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mean = near.iter().map(|it| it.0).sum::<f32>() / near.len().max(1) as f32;
    let fifth = near.get(near.len() / 20).map_or(0.0, |it| it.0);
    let close = near.iter().filter(|it| it.0 < 0.08).count();
    let mut pairs: Vec<String> = Vec::new();
    for &(_, a, b) in &near {
        let pair = format!("{}/{}", names[a.min(b)], names[a.max(b)]);
        if pairs.len() < 4 && !pairs.contains(&pair) {
            pairs.push(pair);
        }
    }
    let further = further.join(" | ");
    let pairs = pairs.join(", ");
    format!("{mean:.3} | {fifth:.3} | {close} | {further} | {pairs}")
}

/// Numbers from -1 to 1 that are the same in every run.
pub(crate) struct Random(u64);

impl Default for Random {
    fn default() -> Self {
        Self(0x2545_F491_4F6C_DD1D)
    }
}

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f64 / f64::from(1u32 << 24) * 2.0 - 1.0
    }
}
