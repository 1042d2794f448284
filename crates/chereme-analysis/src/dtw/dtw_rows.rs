//! The table of least costs row by row, for every step pattern except the symmetric ones without slope
//! constraint, with the steps if a path is requested.

use std::ops::Range;

use super::dtw_pattern::StepProduction;
use super::{ChannelSeries, DtwOptions, LocalDistance, StepPattern};

/// Columns of unreachable cost before the first, so that steps back need no test.
const ROW_PADDING_COLUMNS: usize = 2;
/// Columns whose local distances are computed together.
const DISTANCE_CHUNK_COLUMNS: usize = 16;

/// The parts of a filled table that are kept: the costs of its last row, and each cell's step if
/// requested.
pub(super) struct RowCostTable {
    /// Least cost of reaching each frame of the reference with the query's last; infinite if no path leads
    /// there.
    pub(super) last: Vec<f64>,
    steps: Vec<u8>,
    /// For each row, the index at which its steps begin, and the column they begin at.
    offsets: Vec<(usize, usize)>,
}

/// Fills the table over `rows`; with `keep` it holds one byte per cell of them.
pub(super) fn fill_row_table(
    query: &ChannelSeries,
    reference: &ChannelSeries,
    rows: &[Range<usize>],
    options: &DtwOptions,
    keep: bool,
) -> RowCostTable {
    pulp::Arch::new().dispatch(RowTableFill {
        query,
        reference,
        rows,
        options,
        keep,
    })
}

/// A call that is compiled for each instruction set and selected at run time.
struct RowTableFill<'a> {
    query: &'a ChannelSeries,
    reference: &'a ChannelSeries,
    rows: &'a [Range<usize>],
    options: &'a DtwOptions,
    keep: bool,
}

impl pulp::NullaryFnOnce for RowTableFill<'_> {
    type Output = RowCostTable;

    #[inline(always)]
    fn call(self) -> RowCostTable {
        let Self {
            query,
            reference,
            rows,
            options,
            keep,
        } = self;
        let (n, m) = (query.series_frame_count(), reference.series_frame_count());
        // Steps go back two rows at most, so that three rows of costs take turns.
        let mut costs = [(); 3].map(|()| vec![f64::INFINITY; m + ROW_PADDING_COLUMNS]);
        let mut locals = [(); 2].map(|()| vec![f64::INFINITY; m + ROW_PADDING_COLUMNS]);
        let mut steps = vec![0; if keep { rows.iter().map(Range::len).sum() } else { m }];
        let mut used = 0;
        let mut offsets = Vec::with_capacity(n);
        if options.open_begin {
            // This is the row before the first: at no cost, paths may start at any column.
            costs[0][ROW_PADDING_COLUMNS..].fill(0.0);
        }
        for i in 0..n {
            let range = rows[i].clone();
            // Only what the row three before this one wrote has to be cleared.
            let stale = if i >= 3 { rows[i - 3].clone() } else { 0..m };
            let mut cost = std::mem::take(&mut costs[(i + 1) % 3]);
            cost[stale.start + ROW_PADDING_COLUMNS..stale.end + ROW_PADDING_COLUMNS].fill(f64::INFINITY);
            // A step over two rows reads this row's distances in the columns of the next.
            let ahead = rows.get(i + 1).map_or(0, |next| next.end).max(range.end);
            let values: Vec<f64> = query.frame_values(i).collect();
            local_row(
                &values,
                reference,
                range.start.saturating_sub(1)..ahead,
                options.local,
                &mut locals[i % 2][ROW_PADDING_COLUMNS..],
            );
            let back = |d: usize| costs[(i + 4 - d) % 3].as_slice();
            let taken = if keep { used..used + range.len() } else { 0..range.len() };
            offsets.push((used, range.start));
            used += range.len();
            let row = RowInputs {
                range,
                start: i == 0 && !options.open_begin,
                previous: [back(1), back(2)],
                locals: [&locals[i % 2], &locals[(i + 1) % 2]],
            };
            row.fill_cost_row(options.pattern, &mut cost, &mut steps[taken]);
            costs[(i + 1) % 3] = cost;
        }
        let last = costs[n % 3].split_off(ROW_PADDING_COLUMNS);
        RowCostTable { last, steps, offsets }
    }
}

/// The inputs of one row of the table. Slices begin [`ROW_PADDING_COLUMNS`] columns early.
struct RowInputs<'a> {
    range: Range<usize>,
    /// Whether the row's first cell is the fixed start of every path.
    start: bool,
    /// Costs of the row before and of the one before that.
    previous: [&'a [f64]; 2],
    /// Local distances of this row and of the row before.
    locals: [&'a [f64]; 2],
}

impl RowInputs<'_> {
    #[inline(always)]
    fn fill_cost_row(mut self, pattern: StepPattern, cost: &mut [f64], mut steps: &mut [u8]) {
        // Every path starts in the first cell, to which no step leads.
        if self.start && self.range.contains(&0) {
            cost[ROW_PADDING_COLUMNS] = self.locals[0][ROW_PADDING_COLUMNS];
            self.range.start = 1;
            steps = &mut steps[1..];
        }
        match pattern {
            StepPattern::Asymmetric => self.asymmetric(cost, steps),
            other => self.fill_any_pattern(other.step_productions(), cost, steps),
        }
    }

    /// The asymmetric pattern: the step is the number of frames by which the reference advances.
    #[inline(always)]
    fn asymmetric(self, cost: &mut [f64], steps: &mut [u8]) {
        let Range { start, end } = self.range;
        let above = &self.previous[0][start + ROW_PADDING_COLUMNS - 2..end + ROW_PADDING_COLUMNS];
        let local = &self.locals[0][start + ROW_PADDING_COLUMNS..end + ROW_PADDING_COLUMNS];
        let out = &mut cost[start + ROW_PADDING_COLUMNS..end + ROW_PADDING_COLUMNS];
        for (((three, d), out), step) in above.windows(3).zip(local).zip(out).zip(steps) {
            // Strict comparisons let the step that is first in the table win a tie.
            let (best, code) = if three[1] < three[2] {
                (three[1], 1)
            } else {
                (three[2], 0)
            };
            let (best, code) = if three[0] < best { (three[0], 2) } else { (best, code) };
            (*out, *step) = (best + d, code);
        }
    }

    fn fill_any_pattern(self, productions: &[StepProduction], cost: &mut [f64], steps: &mut [u8]) {
        for (j, step) in (self.range.start + ROW_PADDING_COLUMNS..self.range.end + ROW_PADDING_COLUMNS).zip(steps) {
            let mut best = (f64::INFINITY, 0);
            for (code, production) in (0u8..).zip(productions) {
                let (di, dj) = production.from;
                let path_cost = production
                    .via
                    .iter()
                    .fold(self.previous[di - 1][j - dj], |sum, (a, b, weight)| {
                        sum + weight * self.locals[*a][j - b]
                    });
                if path_cost < best.0 {
                    best = (path_cost, code);
                }
            }
            (cost[j], *step) = best;
        }
    }
}

/// Writes the local distances of one frame, `values`, to the frames `range` of the reference.
#[inline(always)]
fn local_row(values: &[f64], reference: &ChannelSeries, range: Range<usize>, local: LocalDistance, out: &mut [f64]) {
    let mut start = range.start;
    for out in out[range].chunks_mut(DISTANCE_CHUNK_COLUMNS) {
        let mut sums = [0.0; DISTANCE_CHUNK_COLUMNS];
        for (channel, value) in values.iter().enumerate() {
            let column = &reference.channel_values(channel)[start..start + out.len()];
            // A fixed length lets the compiler use vector instructions.
            match <&[f64; DISTANCE_CHUNK_COLUMNS]>::try_from(column) {
                Ok(column) => add_squares(&mut sums, *value, column),
                Err(_) => add_squares(&mut sums[..column.len()], *value, column),
            }
        }
        if local == LocalDistance::Euclidean {
            sums = sums.map(f64::sqrt);
        }
        out.copy_from_slice(&sums[..out.len()]);
        start += out.len();
    }
}

#[inline(always)]
fn add_squares(sums: &mut [f64], value: f64, column: &[f64]) {
    for (sum, other) in sums.iter_mut().zip(column) {
        *sum += (value - other) * (value - other);
    }
}

impl RowCostTable {
    /// Returns the step that leads to a cell, as the index of its production in the pattern.
    pub(super) fn row_table_step(&self, i: usize, j: usize) -> u8 {
        let (offset, start) = self.offsets[i];
        self.steps[offset + j - start]
    }
}
