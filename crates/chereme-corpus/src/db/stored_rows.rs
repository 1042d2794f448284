//! Rows read from several tables, for the rest of the corpus and both user interfaces.

use chereme_motion::{FrameRate, RecordingInstant, TimeSpan};
use serde::Serialize;

use crate::db::stored_columns::ValueState;
use crate::db::stored_recordings::RecordingRow;
use crate::db::stored_tracks::TrackKind;

/// The annotations before and after a token on its tier.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct TokenNeighbours {
    /// The row of the token.
    pub token: i64,
    /// Its annotation; a lexicon entry has no annotation.
    pub annotation: Option<i64>,
    /// The tier of the annotation.
    pub tier: Option<i64>,
    /// The values of the annotations before it, the nearest last, without empty ones.
    pub before: Vec<String>,
    /// The values of the annotations after it, the nearest first.
    pub after: Vec<String>,
}

/// A recording at a glance.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordingGlance {
    /// The recording.
    pub row: RecordingRow,
    /// The number of frames of movement; 0 if it has none.
    pub frames: u64,
    /// The rate of its frames.
    pub rate: Option<FrameRate>,
    /// The time of its first frame on the recording's clock, in microseconds.
    pub offset_us: i64,
    /// The kinds of its tracks, each once.
    pub kinds: Vec<TrackKind>,
    /// How many tiers it has.
    pub tiers: u64,
    /// How many tokens it has.
    pub tokens: u64,
    /// Its recipe, if it was generated.
    pub recipe: Option<String>,
    /// The frames of its captured face, if it has no skeleton: the program's own body shows the face.
    pub face_alone: Option<ShownFrames>,
}

impl RecordingGlance {
    /// Returns the frames that can be shown: of its movement, else of its face alone; `None` if it has neither.
    #[must_use]
    pub fn shown_frames(&self) -> Option<ShownFrames> {
        let own_frames = self.rate.filter(|_| self.frames > 0).map(|rate| ShownFrames {
            frames: self.frames,
            rows: self.frames,
            rate,
            offset_us: self.offset_us,
        });
        own_frames.or(self.face_alone)
    }
}

/// Frames that can be shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShownFrames {
    /// How many there are.
    pub frames: u64,
    /// How many frames the track itself has: others, if each has a time of its own.
    pub rows: u64,
    /// Their rate.
    pub rate: FrameRate,
    /// The time of the first one on the recording's clock, in microseconds.
    pub offset_us: i64,
}

/// A track of curves of a recording without a skeleton.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CurvesAlone {
    pub(crate) recording: i64,
    /// The names of its channels, a line each.
    pub(crate) names: String,
    pub(crate) frames: u64,
    /// `None` if frames have times of their own.
    pub(crate) rate: Option<FrameRate>,
    pub(crate) offset_us: i64,
    /// The duration of the recording.
    pub(crate) duration_us: i64,
}

/// A sign at a glance.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignGlance {
    /// The row.
    pub id: i64,
    /// The gloss.
    pub gloss: String,
    /// The lexicon to which it belongs, if it belongs to one.
    pub lexicon: Option<String>,
    /// Remarks.
    pub notes: Option<String>,
    /// How many tokens it has.
    pub tokens: u64,
    /// The token of its citation form; a token with movement is preferred to a lexicon entry.
    pub citation: Option<i64>,
    /// The recording that contains the citation form, and its span there.
    pub place: Option<(i64, TimeSpan)>,
    /// Whether the citation form has a notation.
    pub notated: bool,
}

/// Annotations of a tier by column and ordered by start; all columns have the same length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnnotationColumns {
    /// The rows.
    pub ids: Vec<i64>,
    /// Their starts in microseconds, in ascending order.
    pub starts: Vec<i64>,
    /// The first microseconds after their ends.
    pub ends: Vec<i64>,
    /// Whether they have values.
    pub states: Vec<ValueState>,
    /// Their values.
    pub values: Vec<Box<str>>,
    /// Their parent annotations.
    pub parents: Vec<Option<i64>>,
    /// The confidences of their origins, from 0 to 1, if given.
    pub confidences: Vec<Option<f64>>,
}

impl AnnotationColumns {
    /// Returns the number of annotations.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns whether the list is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Returns the span of the annotation at index `at`.
    ///
    /// # Panics
    /// Panics if `at` is out of range.
    #[must_use]
    pub fn annotation_span_at(&self, at: usize) -> TimeSpan {
        let micros = RecordingInstant::from_micros;
        TimeSpan::span_between(micros(self.starts[at]), micros(self.ends[at]))
    }
}

/// A saved search: a query with a name.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct KeptSearch {
    /// Its name; unique in the corpus even if case and accents are ignored.
    pub name: String,
    /// The query as the user wrote it.
    pub query: String,
}

/// A signer at a glance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SignerInfo {
    /// The name.
    pub name: String,
    /// The dominant hand, if it is known.
    pub handedness: Option<String>,
    /// The number of recordings.
    pub recordings: u64,
}

/// An inventory at a glance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct InventoryInfo {
    /// Its id, such as `configurations`.
    pub id: String,
    /// The component of its values, with the feature.
    pub field: String,
    /// The number of values.
    pub values: u64,
    /// The number of tiers that take their values from it.
    pub tiers: u64,
}
