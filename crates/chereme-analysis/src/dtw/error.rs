//! Reasons why two series cannot be aligned, with remedies.

use std::fmt;

use super::{AlignmentWindow, StepPattern};

/// The reason why there is no path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathObstacle {
    /// The window leaves out the last pair of frames, or the first.
    Window(AlignmentWindow),
    /// The step pattern cannot stretch one length to the other.
    Slope(StepPattern),
    /// Window and pattern each allow a path, but not together.
    Together(AlignmentWindow, StepPattern),
}

impl fmt::Display for PathObstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Window(window) => write!(f, "the window {window} does not reach both corners"),
            Self::Slope(pattern) => write!(f, "{pattern:?} steps cannot stretch so far"),
            Self::Together(window, pattern) => {
                write!(f, "{pattern:?} steps find no path inside the window {window}")
            }
        }
    }
}

/// The reason why two series cannot be aligned, with a remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DtwError {
    /// A series has no frame or no channel.
    #[error("a series needs at least one frame and one channel")]
    Empty,
    /// The number of values of a frame differs from that of the others.
    #[error("frame {frame} has {found} values where {expected} channels were expected")]
    Ragged {
        /// The frame, from 0.
        frame: usize,
        /// The number of values.
        found: usize,
        /// The expected number of values.
        expected: usize,
    },
    /// A value without a distance to others, such as NaN.
    #[error(
        "channel {channel} is {value} at frame {frame}; values must be numbers within 1e140 of \
         zero: fill gaps first or leave the channel out"
    )]
    Value {
        /// The frame, from 0.
        frame: usize,
        /// The channel, from 0.
        channel: usize,
        /// The value.
        value: f64,
    },
    /// The number of scales differs from the number of channels.
    #[error("{found} scales were given for {channels} channels; each channel needs one")]
    Scales {
        /// Scales given.
        found: usize,
        /// Channels of the series.
        channels: usize,
    },
    /// A scale that is zero, negative or not finite.
    #[error("the scale of channel {channel} is {scale}; it must be a number above zero")]
    Scale {
        /// The channel, from 0.
        channel: usize,
        /// The scale given.
        scale: f64,
    },
    /// The two series do not have the same channels.
    #[error(
        "the query has {query} channels and the reference {reference}; compare the channels that \
         both have"
    )]
    Channels {
        /// Channels of the query.
        query: usize,
        /// Channels of the reference.
        reference: usize,
    },
    /// An open end was requested for a pattern that has no norm for it.
    #[error(
        "{pattern:?} cannot have an open {end}: {}",
        if *end == "begin" {
            "use Asymmetric, AsymmetricP1 or TypeIiiC, which are normalised by the query's length"
        } else {
            "use any pattern but Symmetric1, which has no norm to choose an end by"
        }
    )]
    OpenEnd {
        /// The requested pattern.
        pattern: StepPattern,
        /// `begin` or `end`.
        end: &'static str,
    },
    /// No path leads from the first to the last frames.
    #[error("{query} frames cannot be aligned with {reference}: {reason}; {remedy}")]
    NoPath {
        /// Frames of the query.
        query: usize,
        /// Frames of the reference.
        reference: usize,
        /// The obstacle.
        reason: PathObstacle,
        /// A change of pattern, window or lengths under which a path exists.
        remedy: String,
    },
    /// The table is larger than the limits allow.
    #[error("aligning takes {cells} cells and {limit} are allowed; {remedy}")]
    TooLarge {
        /// Cells inside the window.
        cells: u64,
        /// Cells allowed.
        limit: u64,
        /// A change that would fit the limits.
        remedy: String,
    },
}
