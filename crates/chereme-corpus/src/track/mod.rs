//! Tracks of every kind on a recording's clock: stored exactly as their file has them, read back, moved, removed.
//!
//! | module | what it does |
//! |---|---|
//! | [`store`] | writes a track into rows and blocks |
//! | [`read`] | reads a track from rows and blocks, whole or in part |
//! | [`change`] | operations on tracks of a recording: add, move on the clock, rename, remove |
//! | [`align`] | finds the position of one track on another's clock from their movement |
//! | [`fit`] | fits a skeleton to markers |
//! | [`piece`] | points within a span, for display |
//! | [`table`] | writes a track as a table of its exact numbers |

pub(crate) mod piece;
#[cfg(test)]
mod tests;
pub(crate) mod track_align;
mod track_change;
mod track_fit;
pub(crate) mod track_read;
pub(crate) mod track_store;
pub(crate) mod track_table;

use chereme_motion::anatomy::AssignedJointRoles;
use chereme_motion::{Clip, CurveTrack, MarkerTrack, SpaceConvention};

pub use crate::db::stored_tracks::{TrackKind, TrackRow};
pub use piece::PointsPiece;
pub use track_align::{AlignmentSignal, TrackAlignment};
pub use track_change::TrackChange;
pub use track_fit::{FitOptions, FitReport, FitResidual};

/// The content of a track.
#[derive(Debug, Clone, PartialEq)]
pub enum TrackContent {
    /// Movement of a skeleton.
    Skeleton(SkeletonTrack),
    /// Named points.
    Markers(MarkerTrack),
    /// Named scalar channels.
    Curves(CurveTrack),
    /// A file next to the corpus.
    Media(MediaFile),
}

impl TrackContent {
    /// Returns the kind of the track.
    #[must_use]
    pub fn track_kind(&self) -> TrackKind {
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
    /// The movement in the file's own unit and axes; each number is stored exactly as read.
    pub clip: Clip,
    /// The conversion of the file's numbers to metres in model space.
    pub convention: SpaceConvention,
    /// The body part of each joint, if a person has set them.
    pub roles: Option<AssignedJointRoles>,
}

/// A film, sound or picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MediaFile {
    /// The location of the file: a path or an address.
    pub url: String,
    /// Its media type, such as `video/mp4`.
    pub media_type: Option<String>,
}

/// A track to store.
#[derive(Debug, Clone, PartialEq)]
pub struct NewTrack {
    /// The name, such as `markers` or `face`; a number (` 2`, ` 3` …) is appended if the recording already has a track
    /// of that name.
    pub name: String,
    /// The time of the track's own time 0 on the recording's clock, in microseconds; may be negative.
    pub offset_us: i64,
    /// The time of day of the track's own time 0, in microseconds after midnight, if it is known.
    pub clock_us: Option<i64>,
    /// The content.
    pub track: TrackContent,
}

impl NewTrack {
    /// Returns a track that starts together with its recording.
    #[must_use]
    pub fn new(name: impl Into<String>, track: TrackContent) -> Self {
        Self {
            name: name.into(),
            offset_us: 0,
            clock_us: None,
            track,
        }
    }
}
