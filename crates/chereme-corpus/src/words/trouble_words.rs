//! Words for errors of the corpus.

pub use crate::words::texts::trouble::*;
