//! The table of least costs for the symmetric step patterns: computed for eight rows at a time along anti-diagonals,
//! whose cells are independent. Without recorded steps it needs only the memory of one row.

use std::ops::Range;

use super::{ChannelSeries, LocalDistance};

/// Factor on lower bounds: it lowers them by far more than rounding can raise them.
pub(super) const LOWER_BOUND_SLACK: f64 = 1.0 - 1e-9;

/// Rows that are processed together.
const SKEW_LANE_ROWS: usize = 8;
/// Anti-diagonals whose local distances are computed before their costs.
const SKEW_TILE_DIAGONALS: usize = 32;

type CostLane = [f64; SKEW_LANE_ROWS];

/// A series with its frames reversed and padded, so that the cells of an anti-diagonal lie side
/// by side.
pub(super) struct ReversedSeries {
    frames: usize,
    stride: usize,
    values: Vec<f64>,
}

impl ReversedSeries {
    pub(super) fn reverse_series(series: &ChannelSeries) -> Self {
        let frames = series.series_frame_count();
        // Lanes beyond either end read padding, so that no cell needs a test.
        let stride = frames + 2 * SKEW_LANE_ROWS;
        let mut values = vec![0.0; stride * series.series_channel_count()];
        for (channel, out) in values.chunks_exact_mut(stride).enumerate() {
            for (out, value) in out[SKEW_LANE_ROWS..]
                .iter_mut()
                .zip(series.channel_values(channel).iter().rev())
            {
                *out = *value;
            }
        }
        Self { frames, stride, values }
    }
}

/// The request for one run of the kernel.
pub(super) struct SkewKernelRequest<'a> {
    /// Columns that each row may reach.
    pub(super) rows: &'a [Range<usize>],
    /// Weight of a diagonal step.
    pub(super) diagonal: f64,
    /// Distance between two frames.
    pub(super) local: LocalDistance,
    /// The cost above which the result is useless.
    pub(super) limit: f64,
    /// For every row a lower bound of the cost of the later rows; may be empty.
    pub(super) rest: &'a [f64],
}

/// The last row of a table, and each cell's step if kept.
pub(super) struct SkewCostTable {
    /// Least cost of reaching each column with the last row; infinite if no path leads there.
    pub(super) last: Vec<f64>,
    /// Steps of all blocks, anti-diagonal by anti-diagonal.
    steps: Vec<[u8; SKEW_LANE_ROWS]>,
    /// For each block, the index at which its steps begin, and the column they begin at.
    blocks: Vec<(usize, usize)>,
}

impl SkewCostTable {
    /// Returns the step that leads to a cell: 0 across, 1 along the columns, 2 along the rows.
    pub(super) fn skew_table_step(&self, i: usize, j: usize) -> u8 {
        let (offset, start) = self.blocks[i / SKEW_LANE_ROWS];
        self.steps[offset + j + i % SKEW_LANE_ROWS - start][i % SKEW_LANE_ROWS]
    }
}

/// Fills the table, with about a byte per cell for its steps if `KEEP`; `None` if the least cost exceeds
/// the limit.
pub(super) fn fill_skew_table<const KEEP: bool>(
    rows: &ChannelSeries,
    columns: &ReversedSeries,
    ask: &SkewKernelRequest<'_>,
) -> Option<SkewCostTable> {
    pulp::Arch::new().dispatch(SkewTableFill::<KEEP> { rows, columns, ask })
}

/// A call of [`blocks`] that is compiled for each instruction set and selected at run time.
struct SkewTableFill<'a, const KEEP: bool> {
    rows: &'a ChannelSeries,
    columns: &'a ReversedSeries,
    ask: &'a SkewKernelRequest<'a>,
}

impl<const KEEP: bool> pulp::NullaryFnOnce for SkewTableFill<'_, KEEP> {
    type Output = Option<SkewCostTable>;

    #[inline(always)]
    fn call(self) -> Option<SkewCostTable> {
        fill_row_blocks::<KEEP>(self.rows, self.columns, self.ask)
    }
}

#[inline(always)]
fn fill_row_blocks<const KEEP: bool>(
    rows: &ChannelSeries,
    columns: &ReversedSeries,
    ask: &SkewKernelRequest<'_>,
) -> Option<SkewCostTable> {
    let (n, m) = (rows.series_frame_count(), columns.frames);
    let mut above = vec![f64::INFINITY; m + SKEW_LANE_ROWS + 1];
    let (mut steps, mut offsets) = (Vec::new(), Vec::new());
    let mut values = vec![[0.0; SKEW_LANE_ROWS]; rows.series_channel_count()];
    load_lane_frames(rows, 0, &mut values);
    let mut corner = [[0.0; SKEW_LANE_ROWS]];
    local_costs(&values, columns, 0, ask.local, &mut corner);
    // The first cell weighs 1 whatever a diagonal step weighs.
    above[0] = -(ask.diagonal - 1.0) * corner[0][0];
    for first in (0..n).step_by(SKEW_LANE_ROWS) {
        load_lane_frames(rows, first, &mut values);
        let rows = &ask.rows[first..n.min(first + SKEW_LANE_ROWS)];
        if KEEP {
            offsets.push((steps.len(), rows[0].start));
        }
        let least = advance_row_block::<KEEP>(&values, columns, rows, ask, &mut above, &mut steps);
        let rest = ask.rest.get(first + rows.len() - 1).copied().unwrap_or(0.0);
        if (least + rest) * LOWER_BOUND_SLACK > ask.limit {
            return None;
        }
    }
    // Columns before the last row's range still hold costs of earlier rows.
    above[..=ask.rows[n - 1].start].fill(f64::INFINITY);
    Some(SkewCostTable {
        last: above[1..=m].to_vec(),
        steps,
        blocks: offsets,
    })
}

/// Gathers the eight frames from `first` on, channel by channel; past the end the last frame is repeated.
#[inline(always)]
fn load_lane_frames(rows: &ChannelSeries, first: usize, values: &mut [CostLane]) {
    for (channel, lane) in values.iter_mut().enumerate() {
        let column = rows.channel_values(channel);
        for (r, value) in lane.iter_mut().enumerate() {
            *value = column[(first + r).min(column.len() - 1)];
        }
    }
}

/// Advances the row of costs `above` (from one column before the first) by the block's rows and
/// returns the least cost in the new row.
#[inline(always)]
fn advance_row_block<const KEEP: bool>(
    values: &[CostLane],
    columns: &ReversedSeries,
    rows: &[Range<usize>],
    ask: &SkewKernelRequest<'_>,
    above: &mut [f64],
    steps: &mut Vec<[u8; SKEW_LANE_ROWS]>,
) -> f64 {
    let last = rows.len() - 1;
    let (start, end) = (rows[0].start, rows[last].end + last);
    let mut diagonal = [f64::INFINITY; SKEW_LANE_ROWS];
    diagonal[0] = std::mem::replace(&mut above[start], f64::INFINITY);
    let mut left = [f64::INFINITY; SKEW_LANE_ROWS];
    let mut least = f64::INFINITY;
    let mut tile = [[0.0; SKEW_LANE_ROWS]; SKEW_TILE_DIAGONALS];
    let mut from = start;
    while from < end {
        let count = SKEW_TILE_DIAGONALS.min(end - from);
        let tile = &mut tile[..count];
        local_costs(values, columns, from, ask.local, tile);
        mask(rows, from, tile);
        for (s, d) in (from..).zip(tile.iter()) {
            let mut up = [above[s + 1]; SKEW_LANE_ROWS];
            up[1..].copy_from_slice(&left[..SKEW_LANE_ROWS - 1]);
            let mut codes = [0; SKEW_LANE_ROWS];
            for r in 0..SKEW_LANE_ROWS {
                let (across, along) = (diagonal[r] + ask.diagonal * d[r], left[r] + d[r]);
                left[r] = lesser(lesser(up[r], left[r]) + d[r], across);
                // A tie takes the step that is first in the table: across, along the columns, along the rows.
                if KEEP {
                    let straight = if along == left[r] { 1 } else { 2 };
                    codes[r] = if across == left[r] { 0 } else { straight };
                }
            }
            diagonal = up;
            if KEEP {
                steps.push(codes);
            }
            // The lane of the last row is that many anti-diagonals behind.
            if s >= start + last {
                above[s - last + 1] = left[last];
                least = lesser(left[last], least);
            }
        }
        from += count;
    }
    least
}

/// Writes the local distances of the anti-diagonals from step `from`: lane `r` of step `s` is row `r`,
/// column `s - r`.
#[inline(always)]
fn local_costs(
    values: &[CostLane],
    columns: &ReversedSeries,
    from: usize,
    local: LocalDistance,
    tile: &mut [CostLane],
) {
    let base = SKEW_LANE_ROWS + columns.frames - 1 - from;
    for (t, out) in tile.iter_mut().enumerate() {
        let mut sums = [0.0; SKEW_LANE_ROWS];
        for (value, column) in values.iter().zip(columns.values.chunks_exact(columns.stride)) {
            let column = &column[base - t..][..SKEW_LANE_ROWS];
            for r in 0..SKEW_LANE_ROWS {
                let difference = value[r] - column[r];
                sums[r] += difference * difference;
            }
        }
        *out = if local == LocalDistance::Euclidean {
            sums.map(f64::sqrt)
        } else {
            sums
        };
    }
}

/// Makes the cells of a tile that lie outside their row's range unreachable.
#[inline(always)]
fn mask(rows: &[Range<usize>], from: usize, tile: &mut [CostLane]) {
    let count = tile.len();
    for r in 0..SKEW_LANE_ROWS {
        // Lanes after the last row have no cell.
        let (start, end) = rows
            .get(r)
            .map_or((count + from, 0), |row| (row.start + r, row.end + r));
        let inside = start.saturating_sub(from).min(count)..end.saturating_sub(from).min(count);
        for d in &mut tile[..inside.start] {
            d[r] = f64::INFINITY;
        }
        for d in &mut tile[inside.end.max(inside.start)..] {
            d[r] = f64::INFINITY;
        }
    }
}

#[inline(always)]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
