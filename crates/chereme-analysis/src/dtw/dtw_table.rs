//! The table of least costs with the path through it; fills it by the faster method that its step pattern allows.

use super::skew::ReversedSeries;
use super::{ChannelSeries, DtwOptions, dtw_rows, skew};

pub(super) enum DtwTable {
    Rows(dtw_rows::RowCostTable),
    Skew(skew::SkewCostTable),
}

impl DtwTable {
    pub(super) fn fill_dtw_table<const KEEP: bool>(
        query: &ChannelSeries,
        reference: &ChannelSeries,
        options: &DtwOptions,
    ) -> Option<Self> {
        let rows = options
            .window
            .window_row_ranges(query.series_frame_count(), reference.series_frame_count());
        // Patterns of single steps run along anti-diagonals, whose cells do not depend on each other.
        let Some(diagonal) = options.pattern.diagonal_weight() else {
            return Some(Self::Rows(dtw_rows::fill_row_table(
                query, reference, &rows, options, KEEP,
            )));
        };
        let ask = skew::SkewKernelRequest {
            rows: &rows,
            diagonal,
            local: options.local,
            limit: f64::INFINITY,
            rest: &[],
        };
        skew::fill_skew_table::<KEEP>(query, &ReversedSeries::reverse_series(reference), &ask).map(Self::Skew)
    }

    /// Returns the least cost of reaching each frame of the reference with the query's last; infinite if
    /// no path leads there.
    pub(super) fn last_row_costs(&self) -> &[f64] {
        match self {
            Self::Rows(table) => &table.last,
            Self::Skew(table) => &table.last,
        }
    }

    /// Returns the path to frame `end` of the reference, first pair first, from a table that kept
    /// its steps.
    pub(super) fn trace_alignment_path(&self, query: usize, end: usize, options: &DtwOptions) -> Vec<(usize, usize)> {
        let productions = options.pattern.step_productions();
        let mut path = Vec::with_capacity(query * 2);
        let (mut i, mut j) = (query - 1, end);
        loop {
            if i == 0 && j == 0 && !options.open_begin {
                path.push((0, 0));
                break;
            }
            let step = match self {
                Self::Rows(table) => table.row_table_step(i, j),
                Self::Skew(table) => table.skew_table_step(i, j),
            };
            let production = &productions[usize::from(step)];
            path.extend(production.via.iter().rev().map(|(a, b, _)| (i - a, j - b)));
            let (di, dj) = production.from;
            // With an open begin the first step leads out of the table.
            if di > i {
                break;
            }
            (i, j) = (i - di, j - dj);
        }
        path.reverse();
        path
    }
}
