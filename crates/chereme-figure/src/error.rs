//! Errors that prevent a picture.

use std::ops::RangeInclusive;

/// The largest side of a picture, in pixels.
pub const MAX_SIDE: usize = 16_384;
/// The most pixels of a picture.
pub const MAX_PIXELS: usize = 64_000_000;

/// The most pixels of one view of a figure, which is drawn several times larger.
pub const MAX_VIEW_PIXELS: usize = 4_000_000;

/// The allowed speeds of animations; 1 is the speed of the movement.
pub const ANIMATION_SPEEDS: RangeInclusive<f64> = 0.05..=20.0;
/// The most pictures of an animation.
pub const MAX_FRAMES: usize = 12_000;

/// A reason why a picture cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The clip has no frames.
    #[error("the clip is empty: it has no frame to draw")]
    Empty,
    /// The clip does not have the requested frame.
    #[error("there is no frame {frame}; the clip's frames are 0 to {last}")]
    Frame {
        /// The frame.
        frame: usize,
        /// The clip's last frame.
        last: usize,
    },
    /// No view or no column was requested.
    #[error("nothing to draw: at least one {what} is needed")]
    Nothing {
        /// The missing thing, in the singular.
        what: &'static str,
    },
    /// The picture would be too small to show anything or unreasonably large.
    #[error(
        "a picture of {width} by {height} pixels cannot be made; sides are from 16 to \
         {MAX_SIDE}, one view has at most {MAX_VIEW_PIXELS} pixels and a sheet at most \
         {MAX_PIXELS}; ask for fewer or smaller cells"
    )]
    Size {
        /// The width in pixels.
        width: usize,
        /// The height in pixels.
        height: usize,
    },
    /// The animation's speed is outside the allowed range.
    #[error("an animation cannot run at the speed {speed}; give a number from {} to {}", ANIMATION_SPEEDS.start(), ANIMATION_SPEEDS.end())]
    Speed {
        /// The speed.
        speed: f64,
    },
    /// An animation would have too many pictures.
    #[error(
        "an animation of {frames} pictures is too long, at most {MAX_FRAMES} are drawn; draw a shorter stretch, or run \
         it faster"
    )]
    Long {
        /// The number of its pictures.
        frames: usize,
    },
    /// The caller's progress function stopped it.
    #[error("stopped after {done} of {total} pictures")]
    Stopped {
        /// The number of finished pictures.
        done: usize,
        /// The total number of pictures.
        total: usize,
    },
    /// A PNG could not be written.
    #[error("the PNG could not be written")]
    Png(#[from] png::EncodingError),
    /// A GIF could not be written.
    #[error("the GIF could not be written")]
    Gif(#[from] gif::EncodingError),
}

/// Returns the size if a picture can have it.
pub(crate) fn checked_size(width: usize, height: usize) -> Result<[usize; 2], FigureError> {
    let sides = 16..=MAX_SIDE;
    let inside = sides.contains(&width) && sides.contains(&height);
    let fits = inside && width * height <= MAX_PIXELS;
    let error = FigureError::Size { width, height };
    fits.then_some([width, height]).ok_or(error)
}

/// Returns the size if one view of a figure can have it.
pub(crate) fn checked_view(width: usize, height: usize) -> Result<[usize; 2], FigureError> {
    checked_size(width, height)?;
    let error = FigureError::Size { width, height };
    let fits = width * height <= MAX_VIEW_PIXELS;
    fits.then_some([width, height]).ok_or(error)
}
