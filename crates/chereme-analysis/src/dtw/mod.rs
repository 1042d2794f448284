//! Dynamic time warping: measures the similarity of two movements independently of their tempo, and finds their
//! corresponding frames.
//!
//! Exact, multivariate, in `f64`; the results equal those of dtw-python and R's `dtw`, which the field
//! uses. [`align_series`] gives the path, [`dtw_distance`] the cost alone in the memory of one row, and [`find_nearest_candidates`]
//! the best of many.
//!
//! ```
//! use chereme_analysis::dtw::{DtwOptions, ChannelSeries, StepPattern, align_series};
//!
//! let query = ChannelSeries::from_rows(&[[0.0], [5.0]])?;
//! let reference = ChannelSeries::from_rows(&[[0.0], [9.0], [5.0]])?;
//! let options = DtwOptions { pattern: StepPattern::Asymmetric, ..DtwOptions::default() };
//! let alignment = align_series(&query, &reference, &options)?;
//! assert_eq!((alignment.cost.distance, alignment.path), (0.0, vec![(0, 0), (1, 2)]));
//! # Ok::<(), chereme_analysis::dtw::DtwError>(())
//! ```
//!
//! **If no path exists** (a window narrower than the difference in length, a pattern that cannot stretch
//! that far), there is no distance either. [`DtwPathPolicy`] decides what happens then; the default refuses, and
//! [`DtwCost::made`] reports any other policy that was applied.

mod dtw_pattern;
mod dtw_rows;
mod dtw_table;
mod error;
mod nearest;
mod series;
mod skew;
mod window;

pub use dtw_pattern::StepPattern;
pub use error::{DtwError, PathObstacle};
pub use nearest::{DtwNeighbour, NearestCandidates, find_nearest_candidates};
pub use series::ChannelSeries;
pub use window::AlignmentWindow;

use std::fmt;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use dtw_pattern::CostNorm;
use dtw_table::DtwTable;

/// The local distance of two frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LocalDistance {
    /// The Euclidean distance over all channels.
    #[default]
    Euclidean,
    /// Its square; costs add up squares and no root is taken at the end.
    SquaredEuclidean,
}

/// The policy for series that no path connects under the requested pattern and window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DtwPathPolicy {
    /// Refuse with [`DtwError::NoPath`], as dtw-python and R do.
    #[default]
    Refuse,
    /// Resample the reference to the query's length by linear interpolation and align the result, under
    /// the same pattern and window; always possible. The path names the nearest original frames.
    Resample,
    /// Exchange the window for a slanted band at least as wide (and wide enough for the lengths); a series
    /// that the step pattern itself forbids is still refused.
    SlantedBand,
}

/// Limits that keep two long recordings from filling memory or running for hours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct DtwLimits {
    /// Most cells for which [`align_series`] keeps a step, one byte each.
    pub kept: u64,
    /// Most cells to compute, in [`align_series`] and in [`dtw_distance`].
    pub cells: u64,
}

impl Default for DtwLimits {
    /// 256 MiB of steps (16,000 by 16,000 frames), 2^36 cells (about two minutes of work).
    fn default() -> Self {
        Self {
            kept: 1 << 28,
            cells: 1 << 36,
        }
    }
}

/// Options of an alignment; the default is R's: symmetric2, no window, closed ends, refusal if there is no
/// path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct DtwOptions {
    /// The steps a path may take.
    pub pattern: StepPattern,
    /// The cells a path may visit.
    pub window: AlignmentWindow,
    /// The distance of two frames.
    pub local: LocalDistance,
    /// Whether the path may start at any frame of the reference; only for patterns normalised by the
    /// query's length. The window still counts from the first frames of both (dtw-python's is one frame
    /// off there). All but the plain asymmetric pattern then leave out the reference's first frame, as a
    /// step along the reference leads to the query's first.
    pub open_begin: bool,
    /// Whether the path may end at any frame of the reference: at the one with the least normalised
    /// distance, the earliest of several; not for symmetric1.
    pub open_end: bool,
    /// The policy if there is no path.
    pub policy: DtwPathPolicy,
    /// Limits of work and memory.
    pub limits: DtwLimits,
}

/// The method by which a cost was computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CostMethod {
    /// Under the requested pattern and window.
    AsAsked,
    /// After resampling the reference to the query's length, by [`DtwPathPolicy::Resample`].
    Resampled,
    /// In a slanted band of this half width, by [`DtwPathPolicy::SlantedBand`].
    SlantedBand(usize),
}

impl fmt::Display for CostMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AsAsked => f.write_str("as asked"),
            Self::Resampled => f.write_str("resampled"),
            Self::SlantedBand(width) => write!(f, "slanted band of {width}"),
        }
    }
}

/// The cost of the best alignment.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DtwCost {
    /// Weighted sum of the local distances along the path.
    pub distance: f64,
    /// The distance divided by the path's total weight: the query's length, or the sum of both lengths,
    /// counting the reference only up to the end of the path. `None` for symmetric1, which has no norm.
    pub normalized: Option<f64>,
    /// The method: as requested, or by the policy for missing paths.
    pub made: CostMethod,
}

/// The best alignment of a query with a reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DtwAlignment {
    /// Its cost.
    pub cost: DtwCost,
    /// Corresponding frames of the query and of the reference, in order; neither ever decreases.
    pub path: Vec<(usize, usize)>,
}

/// Returns the best alignment of `query` with `reference` and its path.
///
/// Memory is one byte per cell inside the window; see [`DtwLimits`].
///
/// # Errors
/// [`DtwError::Channels`], [`DtwError::OpenEnd`], [`DtwError::TooLarge`], and [`DtwError::NoPath`] if the
/// policy refuses.
pub fn align_series(
    query: &ChannelSeries,
    reference: &ChannelSeries,
    options: &DtwOptions,
) -> Result<DtwAlignment, DtwError> {
    let limit = options.limits.kept.min(options.limits.cells);
    check_dtw_input(query, reference, options, limit)?;
    with_policy(query, reference, options, |query, reference, options| {
        let table = DtwTable::fill_dtw_table::<true>(query, reference, options)?;
        let (end, cost) = choose_path_end(table.last_row_costs(), query.series_frame_count(), options)?;
        let path = table.trace_alignment_path(query.series_frame_count(), end, options);
        Some(DtwAlignment { cost, path })
    })
}

/// Returns the cost of the best alignment of `query` with `reference`, without its path.
///
/// Equal to that of [`align_series`] to the last digit or two; memory grows with the lengths only.
///
/// # Errors
/// The same as [`align_series`]'s.
pub fn dtw_distance(
    query: &ChannelSeries,
    reference: &ChannelSeries,
    options: &DtwOptions,
) -> Result<DtwCost, DtwError> {
    check_dtw_input(query, reference, options, options.limits.cells)?;
    let outcome = with_policy(query, reference, options, |query, reference, options| {
        let table = DtwTable::fill_dtw_table::<false>(query, reference, options)?;
        let (_, cost) = choose_path_end(table.last_row_costs(), query.series_frame_count(), options)?;
        let path = Vec::new();
        Some(DtwAlignment { cost, path })
    });
    outcome.map(|alignment| alignment.cost)
}

/// Returns the divisor of the cost of a path to frame `end` of the reference.
fn path_cost_divisor(pattern: StepPattern, query: usize, end: usize) -> Option<f64> {
    match pattern.cost_norm() {
        CostNorm::None => None,
        CostNorm::Query => Some(query as f64),
        CostNorm::Both => Some((query + end + 1) as f64),
    }
}

/// Chooses the frame of the reference at which the path ends; `None` if no frame is reached.
fn choose_path_end(last: &[f64], query: usize, options: &DtwOptions) -> Option<(usize, DtwCost)> {
    let normalized = |end: usize| path_cost_divisor(options.pattern, query, end).map(|norm| last[end] / norm);
    let end = if options.open_end {
        let least = |end: &usize| normalized(*end).unwrap_or(last[*end]);
        (0..last.len()).min_by(|a, b| least(a).total_cmp(&least(b)))?
    } else {
        last.len() - 1
    };
    let cost = DtwCost {
        distance: last[end],
        normalized: normalized(end),
        made: CostMethod::AsAsked,
    };
    cost.distance.is_finite().then_some((end, cost))
}

fn check_dtw_input(
    query: &ChannelSeries,
    reference: &ChannelSeries,
    options: &DtwOptions,
    limit: u64,
) -> Result<(), DtwError> {
    let (channels, other) = (query.series_channel_count(), reference.series_channel_count());
    if channels != other {
        return Err(DtwError::Channels {
            query: channels,
            reference: other,
        });
    }
    let pattern = options.pattern;
    if options.open_begin && pattern.cost_norm() != CostNorm::Query {
        return Err(DtwError::OpenEnd { pattern, end: "begin" });
    }
    if options.open_end && pattern.cost_norm() == CostNorm::None {
        return Err(DtwError::OpenEnd { pattern, end: "end" });
    }
    let cells = options
        .window
        .count_window_cells(query.series_frame_count(), reference.series_frame_count());
    if cells > limit {
        return Err(too_large(
            cells,
            limit,
            query.series_frame_count(),
            limit < options.limits.cells,
        ));
    }
    Ok(())
}

fn too_large(cells: u64, limit: u64, frames: usize, kept: bool) -> DtwError {
    // A band of half width w has at most 2w + 1 cells for each frame.
    let half_width = (limit / frames.max(1) as u64).saturating_sub(1) / 2;
    let without_path = if kept {
        ", or ask for the distance without its path"
    } else {
        ""
    };
    let remedy = if half_width > 0 {
        format!("use a slanted band of at most {half_width} frames{without_path}")
    } else {
        format!("cut the recordings into signs or lower their frame rate{without_path}")
    };
    DtwError::TooLarge { cells, limit, remedy }
}

/// Calls `run` as requested and, if it finds no path, once more according to the policy.
fn with_policy(
    query: &ChannelSeries,
    reference: &ChannelSeries,
    options: &DtwOptions,
    run: impl Fn(&ChannelSeries, &ChannelSeries, &DtwOptions) -> Option<DtwAlignment>,
) -> Result<DtwAlignment, DtwError> {
    if let Some(found) = run(query, reference, options) {
        return Ok(found);
    }
    let (n, m) = (query.series_frame_count(), reference.series_frame_count());
    let remedied = match options.policy {
        DtwPathPolicy::Refuse => None,
        DtwPathPolicy::Resample => run(query, &reference.resample_series_frames(n), options).map(|mut found| {
            for (_, j) in &mut found.path {
                *j = series::resampled_frame_position(*j, n, m).round() as usize;
            }
            found.cost.made = CostMethod::Resampled;
            found
        }),
        DtwPathPolicy::SlantedBand => {
            let half_width = slanted_width(options.window, n, m);
            let window = AlignmentWindow::SlantedBand(half_width);
            // The band may have more cells than the window that was checked.
            check_dtw_input(
                query,
                reference,
                &DtwOptions { window, ..*options },
                options.limits.kept,
            )?;
            run(query, reference, &DtwOptions { window, ..*options }).map(|mut found| {
                found.cost.made = CostMethod::SlantedBand(half_width);
                found
            })
        }
    };
    remedied.ok_or_else(|| no_path(n, m, options))
}

/// Returns the half width of a slanted band no narrower than `window` that holds both corners.
fn slanted_width(window: AlignmentWindow, n: usize, m: usize) -> usize {
    let asked = match window {
        AlignmentWindow::None => m,
        AlignmentWindow::SakoeChiba(w) | AlignmentWindow::SlantedBand(w) => w,
    };
    // A narrower band leaves gaps between the rows of a longer reference.
    asked.max(m.div_ceil(n))
}

fn no_path(query: usize, reference: usize, options: &DtwOptions) -> DtwError {
    let (pattern, window) = (options.pattern, options.window);
    let rows: Vec<Range<usize>> = window.window_row_ranges(query, reference);
    let (reason, remedy) = if !pattern.may_span_frames(query, reference) && !options.open_end {
        let remedy = "use a symmetric pattern, or resample one of them (policy resample)";
        (PathObstacle::Slope(pattern), remedy.to_owned())
    } else if !window::is_window_connected(&rows, reference) {
        let remedy = match window {
            AlignmentWindow::SakoeChiba(_) => format!(
                "use a window of at least {} frames, a slanted band, or the policy resample",
                query.abs_diff(reference)
            ),
            _ => format!(
                "use a slanted band of at least {} frames, or the policy resample",
                slanted_width(AlignmentWindow::SlantedBand(0), query, reference)
            ),
        };
        (PathObstacle::Window(window), remedy)
    } else {
        let remedy = "widen the window, use a symmetric pattern, or the policy resample";
        (PathObstacle::Together(window, pattern), remedy.to_owned())
    };
    DtwError::NoPath {
        query,
        reference,
        reason,
        remedy,
    }
}
