//! Tracks of every kind on a recording's clock: stored exactly as their file has them, read back, moved, removed.
//!
//! | module | what it does |
//! |---|---|
//! | [`store`] | a track into rows and blocks |
//! | [`read`] | rows and blocks into a track, whole or in part |
//! | [`change`] | tracks of a recording as operations: added, moved on the clock, renamed, removed |
//! | [`align`] | where one track lies on another's clock, found from their movement |
//! | [`fit`] | a skeleton fitted to markers |
//! | [`piece`] | points of a span, to look at |
//! | [`table`] | a track as a table of its exact numbers |

pub(crate) mod align;
mod change;
mod fit;
pub(crate) mod piece;
pub(crate) mod read;
pub(crate) mod store;
pub(crate) mod table;
#[cfg(test)]
mod tests;

use chereme_motion::anatomy::Roles;
use chereme_motion::{Clip, Convention, Curves, Markers};

pub use crate::db::tracks::{TrackKind, TrackRow};
pub use align::{Alignment, Signal};
pub use change::TrackChange;
pub use fit::{FitReport, FitResidual};
pub use piece::PointsPiece;

/// What a track holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Track {
    /// Movement of a skeleton.
    Skeleton(SkeletonTrack),
    /// Named points.
    Markers(Markers),
    /// Named scalar channels.
    Curves(Curves),
    /// A file next to the corpus.
    Media(MediaFile),
}

impl Track {
    /// Returns the kind of the track.
    #[must_use]
    pub fn kind(&self) -> TrackKind {
        match self {
            Self::Skeleton(_) => TrackKind::Skeleton,
            Self::Markers(_) => TrackKind::Markers,
            Self::Curves(_) => TrackKind::Curves,
            Self::Media(_) => TrackKind::Media,
        }
    }
}

/// Movement of a skeleton in its file's unit and axes.
#[derive(Debug, Clone, PartialEq)]
pub struct SkeletonTrack {
    /// The movement in the file's own unit and axes; each number is stored exactly.
    pub clip: Clip,
    /// How the file's numbers become metres in model space.
    pub convention: Convention,
    /// Which joint is which part of the body, where a person says so.
    pub roles: Option<Roles>,
}

/// A film, sound or picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MediaFile {
    /// Where the file lies: a path or an address.
    pub url: String,
    /// Its media type, such as `video/mp4`.
    pub media_type: Option<String>,
}

/// A track to be stored.
#[derive(Debug, Clone, PartialEq)]
pub struct NewTrack {
    /// The name, such as `markers` or `face`; ` 2` and so on follows if the recording has one of that name.
    pub name: String,
    /// Where the track's own time 0 lies on the recording's clock, in microseconds; may be negative.
    pub offset_us: i64,
    /// The time of day of the track's own time 0, in microseconds after midnight, if it is known.
    pub clock_us: Option<i64>,
    /// What it holds.
    pub track: Track,
}

impl NewTrack {
    /// Returns a track that starts with its recording.
    #[must_use]
    pub fn new(name: impl Into<String>, track: Track) -> Self {
        Self {
            name: name.into(),
            offset_us: 0,
            clock_us: None,
            track,
        }
    }
}
