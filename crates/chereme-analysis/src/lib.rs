//! Movement to annotations and scores.
//!
//! | module | holds |
//! |---|---|
//! | [`dtw`] | dynamic time warping: alignments, distances, nearest neighbours |

pub mod dtw;
