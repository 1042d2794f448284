//! Movement to annotations and scores.
