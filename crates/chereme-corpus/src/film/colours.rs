//! Conversion between the colour numbers of films and screen colours (ITU-R BT.601, BT.709, BT.2020).

use chereme_figure::RasterImage;
use chereme_formats::mp4::{PictureColours, PictureRotation};

use super::FilmPicture;

/// A decoded picture: luma of each pixel, and two colour differences of each square of four.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PicturePlanes {
    /// Coded width in pixels.
    pub width: usize,
    /// Coded height in pixels.
    pub height: usize,
    /// Luma, row by row.
    pub y: Vec<u8>,
    /// The blue difference; rows have half of the width, rounded up.
    pub u: Vec<u8>,
    /// The red difference, in the same layout.
    pub v: Vec<u8>,
    /// The meaning of the numbers as colours, if the film states it.
    pub(crate) colours: Option<PictureColours>,
}

/// Returns the weights of red and blue in luma.
fn weights(matrix: u8) -> (f32, f32) {
    match matrix {
        5 | 6 => (0.299, 0.114),
        9 | 10 => (0.2627, 0.0593),
        _ => (0.2126, 0.0722),
    }
}

/// Returns the coding of colours for a picture of that height if a film does not name it: that of television.
pub(crate) fn default_film_colours(height: usize) -> PictureColours {
    PictureColours {
        matrix: if height < 720 { 6 } else { 1 },
        full_range: false,
    }
}

/// Factors from numbers to colours, in 65,536ths.
struct ColourFactors {
    bright: i32,
    black: i32,
    red: i32,
    green: [i32; 2],
    blue: i32,
}

impl ColourFactors {
    fn factors_of_colours(colours: PictureColours) -> Self {
        let (red, blue) = weights(colours.matrix);
        let green = 1.0 - red - blue;
        let (bright, chroma) = if colours.full_range {
            (1.0, 1.0)
        } else {
            (255.0 / 219.0, 255.0 / 224.0)
        };
        let fixed = |value: f32| (value * 65536.0).round() as i32;
        Self {
            bright: fixed(bright),
            black: if colours.full_range { 0 } else { 16 },
            red: fixed(2.0 * (1.0 - red) * chroma),
            green: [
                fixed(2.0 * (1.0 - blue) * blue / green * chroma),
                fixed(2.0 * (1.0 - red) * red / green * chroma),
            ],
            blue: fixed(2.0 * (1.0 - blue) * chroma),
        }
    }

    fn convert_yuv_colour(&self, y: i32, u: i32, v: i32) -> [u8; 3] {
        let bright = (y - self.black) * self.bright + 32768;
        let (u, v) = (u - 128, v - 128);
        [
            bright + self.red * v,
            bright - self.green[0] * u - self.green[1] * v,
            bright + self.blue * u,
        ]
        .map(|sum| (sum >> 16).clamp(0, 255) as u8)
    }
}

impl PicturePlanes {
    /// Returns its size in bytes.
    pub(crate) fn plane_byte_count(&self) -> usize {
        self.y.len() + self.u.len() + self.v.len()
    }

    /// Returns it in screen colours, rotated, and reduced to fit into `within`.
    #[must_use]
    pub fn to_screen_picture(&self, turn: PictureRotation, within: [usize; 2]) -> FilmPicture {
        let turned = turn.rotated_picture_size([self.width, self.height]);
        let [width, height] = fit_picture_size(turned, within);
        let factors =
            ColourFactors::factors_of_colours(self.colours.unwrap_or_else(|| default_film_colours(self.height)));
        let chroma = self.width.div_ceil(2);
        // The ranges of the coded picture that correspond to columns and rows of the result.
        let spans = |count: usize, of: usize| -> Vec<(usize, usize)> {
            let edge = |at: usize| at * of / count;
            (0..count)
                // Each range has at least one pixel, so that no mean is taken of nothing.
                .map(|at| (edge(at), edge(at + 1).max(edge(at) + 1)))
                .collect()
        };
        let (columns, rows) = (spans(width, turned[0]), spans(height, turned[1]));
        let back = |(from, to): (usize, usize), size: usize| (size - to, size - from);
        let mut rgba = Vec::with_capacity(width * height * 4);
        for row in &rows {
            for column in &columns {
                let (xs, ys) = match turn {
                    PictureRotation::None => (*column, *row),
                    PictureRotation::Half => (back(*column, self.width), back(*row, self.height)),
                    PictureRotation::Quarter => (*row, back(*column, self.height)),
                    PictureRotation::ThreeQuarters => (back(*row, self.width), *column),
                };
                let mut sum = 0_u32;
                for y in ys.0..ys.1 {
                    let line = &self.y[y * self.width + xs.0..y * self.width + xs.1];
                    sum += line.iter().map(|value| u32::from(*value)).sum::<u32>();
                }
                let count = ((xs.1 - xs.0) * (ys.1 - ys.0)) as u32;
                let chroma_index = (ys.0 + ys.1) / 4 * chroma + (xs.0 + xs.1) / 4;
                // At an odd edge, the last square of four reaches beyond the picture.
                let near = chroma_index.min(self.u.len().saturating_sub(1));
                let bright = ((sum + count / 2) / count) as i32;
                let (u, v) = (i32::from(self.u[near]), i32::from(self.v[near]));
                let [red, green, blue] = factors.convert_yuv_colour(bright, u, v);
                rgba.extend_from_slice(&[red, green, blue, 255]);
            }
        }
        FilmPicture { width, height, rgba }
    }

    /// Converts a drawn picture to film colours; an odd width or height is made even by repeating the edge.
    pub(crate) fn from_drawn_image(image: &RasterImage, colours: PictureColours) -> Self {
        let (wide, high) = (image.image_width(), image.image_height());
        let (width, height) = (wide.next_multiple_of(2), high.next_multiple_of(2));
        let (red, blue) = weights(colours.matrix);
        let green = 1.0 - red - blue;
        let pixels = image.image_pixels();
        let pixel_at = |x: usize, y: usize| pixels[y.min(high - 1) * wide + x.min(wide - 1)].0.map(f32::from);
        let bright = |[r, g, b]: [f32; 3]| red * r + green * g + blue * b;
        let mut y = Vec::with_capacity(width * height);
        for row in 0..height {
            y.extend((0..width).map(|x| {
                let value = bright(pixel_at(x, row)) * (219.0 / 255.0) + 16.0;
                (value + 0.5) as u8
            }));
        }
        let (mut u, mut v) = (Vec::new(), Vec::new());
        for row in (0..height).step_by(2) {
            for x in (0..width).step_by(2) {
                let four = [
                    pixel_at(x, row),
                    pixel_at(x + 1, row),
                    pixel_at(x, row + 1),
                    pixel_at(x + 1, row + 1),
                ];
                let mean = |channel: usize| four.iter().map(|pixel| pixel[channel]).sum::<f32>() / 4.0;
                let colour = [mean(0), mean(1), mean(2)];
                let middle = bright(colour);
                let put = |value: f32, weight: f32| {
                    let share = (value - middle) / (2.0 * (1.0 - weight));
                    (share * (224.0 / 255.0) + 128.5) as u8
                };
                u.push(put(colour[2], blue));
                v.push(put(colour[0], red));
            }
        }
        Self {
            width,
            height,
            y,
            u,
            v,
            colours: Some(colours),
        }
    }
}

/// Returns the largest size of the same proportions that fits into `within` and is not larger than the original.
fn fit_picture_size([width, height]: [usize; 2], within: [usize; 2]) -> [usize; 2] {
    let share = (within[0] as f64 / width.max(1) as f64)
        .min(within[1] as f64 / height.max(1) as f64)
        .min(1.0);
    let side = |of: usize| ((of as f64 * share).round() as usize).clamp(1, of.max(1));
    [side(width), side(height)]
}
