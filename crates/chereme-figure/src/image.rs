//! A picture of pixels, and the few marks that sheets and charts need.

use crate::letters;
use crate::palette::RgbColour;

/// A picture, row by row from the top left, without transparency.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RasterImage {
    width: usize,
    height: usize,
    pixels: Vec<RgbColour>,
}

impl RasterImage {
    /// Returns a picture of one colour.
    #[must_use]
    pub fn new(width: usize, height: usize, colour: RgbColour) -> Self {
        Self {
            width,
            height,
            pixels: vec![colour; width * height],
        }
    }

    /// Returns the width in pixels.
    #[must_use]
    pub fn image_width(&self) -> usize {
        self.width
    }

    /// Returns the height in pixels.
    #[must_use]
    pub fn image_height(&self) -> usize {
        self.height
    }

    /// Returns all pixels, row by row.
    #[must_use]
    pub fn image_pixels(&self) -> &[RgbColour] {
        &self.pixels
    }

    /// Returns the bytes red, green, blue of every pixel, row by row.
    #[must_use]
    pub fn to_rgb(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|colour| colour.0).collect()
    }

    /// Returns the colour at column `x` of row `y`.
    ///
    /// # Panics
    /// If the position is outside.
    #[must_use]
    pub fn image_pixel_at(&self, x: usize, y: usize) -> RgbColour {
        assert!(x < self.width && y < self.height, "the pixel is inside");
        self.pixels[y * self.width + x]
    }

    /// Returns the picture with left and right exchanged.
    #[must_use]
    pub fn mirror_image(&self) -> Self {
        let rows = self.pixels.chunks(self.width.max(1));
        Self {
            pixels: rows.flat_map(|row| row.iter().rev().copied()).collect(),
            ..*self
        }
    }

    /// Sets the colour of the pixel in that column and row; positions outside are ignored.
    pub fn set_colour(&mut self, [x, y]: [usize; 2], colour: RgbColour) {
        self.set_image_pixel(x as i64, y as i64, colour);
    }

    pub(crate) fn pixels_mut(&mut self) -> &mut [RgbColour] {
        &mut self.pixels
    }

    /// Sets one pixel; positions outside are ignored.
    pub(crate) fn set_image_pixel(&mut self, x: i64, y: i64, colour: RgbColour) {
        if (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y) {
            self.pixels[y as usize * self.width + x as usize] = colour;
        }
    }

    /// Fills the part of a rectangle that is inside.
    pub(crate) fn fill_image_rectangle(&mut self, at: [i64; 2], size: [i64; 2], colour: RgbColour) {
        for y in at[1]..at[1] + size[1] {
            for x in at[0]..at[0] + size[0] {
                self.set_image_pixel(x, y, colour);
            }
        }
    }

    /// Draws a straight line between two pixels, both included.
    pub(crate) fn draw_image_line(&mut self, from: [i64; 2], to: [i64; 2], colour: RgbColour) {
        // One pixel for each step of the longer side leaves no gap.
        let steps = (to[0] - from[0]).abs().max((to[1] - from[1]).abs()).max(1);
        for step in 0..=steps {
            let along = |axis: usize| {
                // Doubled, so that half a pixel is added without a fraction.
                let twice = 2 * (to[axis] - from[axis]) * step + steps;
                from[axis] + twice.div_euclid(2 * steps)
            };
            self.set_image_pixel(along(0), along(1), colour);
        }
    }

    /// Draws the part of `other` that is inside, with its top left corner at `at`.
    pub fn paste_image(&mut self, other: &Self, at: [usize; 2]) {
        let width = other.width.min(self.width.saturating_sub(at[0]));
        for row in 0..other.height.min(self.height.saturating_sub(at[1])) {
            let to = (at[1] + row) * self.width + at[0];
            let from = row * other.width;
            self.pixels[to..to + width].copy_from_slice(&other.pixels[from..from + width]);
        }
    }

    /// Writes one line of text whose cells have their top left corner at `at`.
    pub(crate) fn draw_image_text(&mut self, text: &str, at: [i64; 2], scale: usize, colour: RgbColour) {
        let line = letters::lay_out_line(text);
        line.paint_text_line(at, scale, |x, y, covered| self.blend_image_pixel(x, y, colour, covered));
    }

    /// Covers a part of one pixel; positions outside are ignored.
    fn blend_image_pixel(&mut self, x: i64, y: i64, colour: RgbColour, covered: f32) {
        if covered >= 1.0 {
            return self.set_image_pixel(x, y, colour);
        }
        let inside = (0..self.width as i64).contains(&x) && (0..self.height as i64).contains(&y);
        // Text may reach beyond the picture.
        if inside {
            let below = &mut self.pixels[y as usize * self.width + x as usize];
            for (below, over) in below.0.iter_mut().zip(colour.0) {
                let mixed = f32::from(*below) * (1.0 - covered) + f32::from(over) * covered;
                *below = mixed.round() as u8;
            }
        }
    }
}
