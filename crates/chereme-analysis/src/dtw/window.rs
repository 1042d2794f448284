//! Windows: limits on the distance of an alignment from the diagonal.

use std::fmt;
use std::ops::Range;

use serde::{Deserialize, Serialize};

/// The largest distance of an alignment from a diagonal, in frames of the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AlignmentWindow {
    /// Unlimited.
    #[default]
    None,
    /// `|i - j| <= w` about the main diagonal (Sakoe and Chiba); lengths that differ by more than `w` have
    /// no path.
    SakoeChiba(usize),
    /// `|j - i*(M-1)/(N-1)| <= w` about the line from corner to corner; a single frame of the query is at
    /// the reference's first. Very unequal lengths may have no path, as the line then rises by more than
    /// the band's width per step.
    SlantedBand(usize),
}

impl fmt::Display for AlignmentWindow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("without a limit"),
            Self::SakoeChiba(width) => write!(f, "of {width} frames about the diagonal"),
            Self::SlantedBand(width) => {
                write!(f, "of {width} frames about the line from corner to corner")
            }
        }
    }
}

impl AlignmentWindow {
    /// Returns the frames of a reference of `m` frames that frame `i` of `n` may be aligned with.
    pub(crate) fn window_row_range(self, i: usize, n: usize, m: usize) -> Range<usize> {
        match self {
            Self::None => 0..m,
            Self::SakoeChiba(w) => i.saturating_sub(w).min(m)..i.saturating_add(w).min(m - 1) + 1,
            Self::SlantedBand(w) => {
                // Products of two long lengths exceed 64 bits.
                let run = (n as u128).saturating_sub(1).max(1);
                let (line, width) = (i as u128 * (m as u128 - 1), w as u128 * run);
                let start = line.saturating_sub(width).div_ceil(run);
                let end = (line + width) / run + 1;
                start.min(m as u128) as usize..end.min(m as u128) as usize
            }
        }
    }

    /// Returns [`row`](Self::row) for every frame of the query; starts and ends never decrease.
    pub(crate) fn window_row_ranges(self, n: usize, m: usize) -> Vec<Range<usize>> {
        (0..n)
            .map(|i| {
                let row = self.window_row_range(i, n, m);
                // A row outside the reference is empty and must not be a reversed range.
                row.start.min(row.end)..row.end
            })
            .collect()
    }

    /// Returns the number of cells in the window, without listing them.
    pub(crate) fn count_window_cells(self, n: usize, m: usize) -> u64 {
        match self {
            Self::None => (n as u64).saturating_mul(m as u64),
            Self::SakoeChiba(w) | Self::SlantedBand(w) => {
                let width = w.saturating_mul(2).saturating_add(1).min(m);
                (n as u64).saturating_mul(width as u64)
            }
        }
    }
}

/// Returns whether single steps along, up and across can lead from the first to the last cell.
pub(crate) fn is_window_connected(rows: &[Range<usize>], m: usize) -> bool {
    let first = rows.first().is_some_and(|row| row.contains(&0));
    let last = rows.last().is_some_and(|row| row.contains(&(m - 1)));
    let steps = rows
        .windows(2)
        .all(|two| two[1].start <= two[0].end && !two[1].is_empty());
    first && last && steps
}

/// Returns, for every column of `m`, the rows whose ranges include it.
pub(crate) fn transpose_row_ranges(rows: &[Range<usize>], m: usize) -> Vec<Range<usize>> {
    let mut columns = Vec::with_capacity(m);
    let (mut start, mut end) = (0, 0);
    for j in 0..m {
        while end < rows.len() && rows[end].start <= j {
            end += 1;
        }
        while start < end && rows[start].end <= j {
            start += 1;
        }
        columns.push(start..end);
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn rows_hold_the_cells_that_the_window_definition_allows(n in 1usize..30, m in 1usize..30, w in 0usize..12) {
            for window in [AlignmentWindow::None, AlignmentWindow::SakoeChiba(w), AlignmentWindow::SlantedBand(w)] {
                let rows = window.window_row_ranges(n, m);
                let columns = transpose_row_ranges(&rows, m);
                for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
                    let inside = match window {
                        AlignmentWindow::None => true,
                        AlignmentWindow::SakoeChiba(w) => i.abs_diff(j) <= w,
                        AlignmentWindow::SlantedBand(w) => {
                            let run = (n - 1).max(1);
                            (j * run).abs_diff(i * (m - 1)) <= w * run
                        }
                    };
                    prop_assert_eq!(rows[i].contains(&j), inside, "{:?} {} {}", window, i, j);
                    prop_assert_eq!(columns[j].contains(&i), inside);
                }
                prop_assert!(rows.windows(2).all(|r| r[0].start <= r[1].start && r[0].end <= r[1].end));
                prop_assert!(window.count_window_cells(n, m) >= rows.iter().map(|r| r.len() as u64).sum());
            }
        }
    }
}
