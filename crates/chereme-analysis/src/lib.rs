//! Movement to annotations and scores.
//!
//! | module | holds |
//! |---|---|
//! | [`dtw`] | dynamic time warping: alignments, distances, nearest neighbours |
//! | [`score`](mod@score) | how alike two performances are, component by component, with their alignment |
//! | [`strokes`](mod@strokes) | transitions of wrists and fingers between two minima of their speed |

pub mod dtw;
pub mod score;
pub mod strokes;

pub use score::{Score, ScoreError, ScoreOptions, score};
