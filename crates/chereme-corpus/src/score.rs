//! Similarity of two pieces of movement.

use std::path::Path;

use chereme_analysis::score::{Score, ScoreOptions, score_as};
use chereme_figure::{ChartOptions, alignment_picture, write_png};

use crate::Corpus;
use crate::address::Address;
use crate::error::{Error, Result};
use crate::picture::{Moving, write};

impl Corpus {
    /// Compares two pieces of movement by dynamic time warping, component by component.
    ///
    /// # Errors
    /// Fails if an address has no movement, or the two have nothing in common that can be compared.
    pub fn score(&self, a: &Address, b: &Address, options: &ScoreOptions) -> Result<Score> {
        let (a, b) = (self.movement(a)?, self.movement(b)?);
        score(&a, &b, options)
    }

    /// Compares as [`score`](Self::score) does, and draws the alignment to a PNG.
    ///
    /// # Errors
    /// As [`score`](Self::score), or if the picture cannot be written.
    pub fn draw_alignment(
        &self,
        [a, b]: [&Address; 2],
        options: &ScoreOptions,
        to: &Path,
        force: bool,
    ) -> Result<Score> {
        let names = [a.to_string(), b.to_string()];
        let (a, b) = (self.movement(a)?, self.movement(b)?);
        let scored = score(&a, &b, options)?;
        let chart = ChartOptions {
            names,
            ..ChartOptions::default()
        };
        let lengths = [a.clip.frames(), b.clip.frames()];
        let fault = |error: chereme_figure::FigureError| Error::wrong(error.to_string());
        let image = alignment_picture(&scored.alignment, lengths, &chart).map_err(fault)?;
        write(to, force, |out| write_png(&image, out).map_err(fault))?;
        Ok(scored)
    }
}

fn score(a: &Moving, b: &Moving, options: &ScoreOptions) -> Result<Score> {
    score_as((&a.clip, &a.anatomy), (&b.clip, &b.anatomy), options)
        .map_err(|error| Error::wrong(format!("the two cannot be compared: {error}")))
}
