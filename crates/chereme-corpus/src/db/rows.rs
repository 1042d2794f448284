//! Rows that are read together, as the rest of the corpus and both skins see them.

use chereme_motion::{Instant, Rate, Span};
use serde::Serialize;

use crate::db::columns::ValueState;
use crate::db::recordings::RecordingRow;
use crate::db::tracks::TrackKind;

/// The annotations before and after a token on its tier.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct Around {
    /// The token.
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
    /// How many frames of movement it has; 0 where it has none.
    pub frames: u64,
    /// The rate of its frames.
    pub rate: Option<Rate>,
    /// Where its first frame lies on the recording's clock, in microseconds.
    pub offset_us: i64,
    /// The kinds of its tracks, each once.
    pub kinds: Vec<TrackKind>,
    /// How many tiers it has.
    pub tiers: u64,
    /// How many tokens it has.
    pub tokens: u64,
    /// Its recipe, if it was generated.
    pub recipe: Option<String>,
}

/// A sign at a glance.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SignGlance {
    /// The row.
    pub id: i64,
    /// The gloss.
    pub gloss: String,
    /// Remarks.
    pub notes: Option<String>,
    /// How many tokens it has.
    pub tokens: u64,
    /// The token of its citation form, one with movement before a lexicon entry.
    pub citation: Option<i64>,
    /// The recording that token lies in, and where.
    pub place: Option<(i64, Span)>,
    /// Whether that token is notated.
    pub notated: bool,
}

/// Annotations of a tier column by column, by start, all columns equally long.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AnnotationColumns {
    /// The rows.
    pub ids: Vec<i64>,
    /// Where they start, in microseconds; never falling.
    pub starts: Vec<i64>,
    /// The first microseconds after them.
    pub ends: Vec<i64>,
    /// Whether they have values.
    pub states: Vec<ValueState>,
    /// What they say.
    pub values: Vec<Box<str>>,
    /// The annotations above.
    pub parents: Vec<Option<i64>>,
    /// How sure their origin is, from 0 to 1, where it says so.
    pub confidences: Vec<Option<f64>>,
}

impl AnnotationColumns {
    /// Returns how many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns whether the list is empty.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Returns the span of the one at `at`.
    ///
    /// # Panics
    /// Where there are not that many.
    #[must_use]
    pub fn span(&self, at: usize) -> Span {
        let micros = Instant::from_micros;
        Span::between(micros(self.starts[at]), micros(self.ends[at]))
    }
}

/// A query with a name.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct KeptSearch {
    /// Its name; no other of the corpus has it, whatever the case and accents.
    pub name: String,
    /// The query as it was written.
    pub query: String,
}

/// A signer at a glance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SignerInfo {
    /// The name.
    pub name: String,
    /// The dominant hand, if it is known.
    pub handedness: Option<String>,
    /// How many recordings there are.
    pub recordings: u64,
}

/// An inventory at a glance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct InventoryInfo {
    /// Its id, such as `configurations`.
    pub id: String,
    /// The component that its values are of, with the feature.
    pub field: String,
    /// How many values it has.
    pub values: u64,
    /// How many tiers take their values from it.
    pub tiers: u64,
}
