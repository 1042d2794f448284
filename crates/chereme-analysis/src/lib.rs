//! Movement to annotations and scores.
//!
//! | module | holds |
//! |---|---|
//! | [`dtw`] | dynamic time warping: alignments, distances, nearest neighbours |
//! | [`score`](mod@score) | how alike two performances are, component by component, with their alignment |

pub mod dtw;
pub mod score;

pub use score::{Score, ScoreError, ScoreOptions, score};
