//! Tables of text: CSV and TSV as people save them.
//!
//! | module | holds |
//! |---|---|
//! | [`annotations`] | changes to annotations in bulk |

pub mod annotations;
mod cells;
mod rows;

pub use cells::TableError;
pub(crate) use cells::{
    COLUMNS, Cells, PADDED, Row, WINDOWS, decode, is_gap, lines_above_titles, listed, western,
};
pub use rows::{tab_rows, write_tab_rows};
