//! Tables of text: CSV and TSV as people save them.
//!
//! | module | holds |
//! |---|---|
//! | [`annotations`] | changes to annotations in bulk |

pub mod annotations;
mod cells;

pub use cells::TableError;
pub(crate) use cells::{COLUMNS, Cells, PADDED, Row, WINDOWS, decode, western};
