//! Tables of text: CSV and TSV as people save them.
//!
//! | module | holds |
//! |---|---|
//! | [`annotations`] | changes to annotations in bulk |
//! | [`people_table`] | people, with their names and attributes |

pub mod annotations;
pub mod people_table;
mod table_cells;
mod table_rows;

pub(crate) use table_cells::{
    MAX_PADDED_CELLS, MAX_TABLE_COLUMNS, TableCells, TableRow, decode_table_bytes, is_gap, join_column_names,
    lines_above_titles,
};
pub use table_cells::{TableError, decode_table_text};
pub use table_rows::{tab_rows, write_tab_rows};
