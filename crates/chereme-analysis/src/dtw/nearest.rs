//! Finds the nearest of many series, exactly, without computing most of the alignments.

use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BinaryHeap, VecDeque};
use std::ops::Range;

use super::skew::{self, LOWER_BOUND_SLACK, ReversedSeries, SkewKernelRequest};
use super::window::{is_window_connected, transpose_row_ranges};
use super::{ChannelSeries, DtwError, DtwOptions, DtwPathPolicy, LocalDistance, check_dtw_input, dtw_distance};

/// Frames of a candidate whose bounds are computed together.
const BOUND_RUN_FRAMES: usize = 16;
/// Distance in frames between the runs whose bounds are computed first, as a sample.
const BOUND_SAMPLE_FRAMES: usize = 4 * BOUND_RUN_FRAMES;

/// A candidate with its distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DtwNeighbour {
    /// Its index among the candidates.
    pub index: usize,
    /// The dtw_distance of its best alignment, as [`dtw_distance`] gives it (not normalised).
    pub distance: f64,
}

/// The candidates nearest to a query, and counts of the work done to find them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NearestCandidates {
    /// Nearest first, equal distances by index; fewer than requested if fewer have a path.
    pub neighbours: Vec<DtwNeighbour>,
    /// The number of candidates whose alignment was computed to the end; the others were ruled out
    /// earlier.
    pub completed: usize,
    /// The number of candidates without a path under these options, and therefore without a distance.
    pub without_path: usize,
}

/// Returns the `k` candidates with the least alignment distance to `query`.
///
/// The answer equals that of [`dtw_distance`] on every candidate. For the symmetric patterns with closed ends
/// a lower bound of each (Keogh and Ratanamahatana 2005, doi 10.1007/s10115-004-0154-9; on each channel,
/// with the window's own envelope) determines the order of work and excludes most candidates, and a
/// running alignment is abandoned once it cannot win.
///
/// # Errors
/// The same as [`dtw_distance`]'s, but candidates without a path are counted instead of refused.
pub fn find_nearest_candidates(
    query: &ChannelSeries,
    candidates: &[ChannelSeries],
    k: usize,
    options: &DtwOptions,
) -> Result<NearestCandidates, DtwError> {
    for candidate in candidates {
        check_dtw_input(query, candidate, options, options.limits.cells)?;
    }
    let closed = !options.open_begin && !options.open_end;
    match options.pattern.diagonal_weight() {
        Some(diagonal) if closed && options.policy == DtwPathPolicy::Refuse => {
            Ok(pruned(query, candidates, k, options, diagonal))
        }
        _ => every(query, candidates, k, options),
    }
}

fn every(
    query: &ChannelSeries,
    candidates: &[ChannelSeries],
    k: usize,
    options: &DtwOptions,
) -> Result<NearestCandidates, DtwError> {
    let mut best = BestCandidates::new(k);
    for (index, candidate) in candidates.iter().enumerate() {
        match dtw_distance(query, candidate, options) {
            Ok(cost) => best.offer_candidate(index, cost.distance),
            Err(DtwError::NoPath { .. }) => best.found.without_path += 1,
            Err(error) => return Err(error),
        }
    }
    Ok(best.found)
}

/// Processes the candidate with the least bound: first from a sample of its frames, then from all of them,
/// then by its alignment.
fn pruned(
    query: &ChannelSeries,
    candidates: &[ChannelSeries],
    k: usize,
    options: &DtwOptions,
    diagonal: f64,
) -> NearestCandidates {
    let mut best = BestCandidates::new(k);
    let mut envelopes: BTreeMap<usize, Option<QueryEnvelope>> = BTreeMap::new();
    let mut queue = Vec::with_capacity(candidates.len());
    let mut bounds = Vec::new();
    for (index, candidate) in candidates.iter().enumerate() {
        // An envelope depends on the length alone, and candidates of one length share it.
        let envelope = envelopes
            .entry(candidate.series_frame_count())
            .or_insert_with_key(|frames| QueryEnvelope::envelope_for_length(query, *frames, options));
        let Some(envelope) = envelope else {
            best.found.without_path += 1;
            continue;
        };
        envelope.write_frame_bounds(candidate, options.local, BOUND_SAMPLE_FRAMES, &mut bounds);
        queue.push(Reverse(DistanceBound {
            least: sum_frame_bounds(&bounds),
            index,
            sampled: true,
        }));
    }
    let mut queue = BinaryHeap::from(queue);
    let reversed = ReversedSeries::reverse_series(query);
    while let Some(Reverse(bound)) = queue.pop() {
        // Bounds come out of the queue in order: no later candidate can win either.
        if bound.least * LOWER_BOUND_SLACK > best.useful_distance_limit() {
            break;
        }
        let candidate = &candidates[bound.index];
        let Some(Some(envelope)) = envelopes.get(&candidate.series_frame_count()) else {
            continue;
        };
        envelope.write_frame_bounds(candidate, options.local, BOUND_RUN_FRAMES, &mut bounds);
        // The bound from all frames is higher and may let others go first.
        if bound.sampled {
            queue.push(Reverse(DistanceBound {
                least: sum_frame_bounds(&bounds),
                sampled: false,
                ..bound
            }));
            continue;
        }
        accumulate_later_bounds(&mut bounds);
        let ask = SkewKernelRequest {
            rows: &envelope.rows,
            diagonal,
            local: options.local,
            limit: best.useful_distance_limit(),
            rest: &bounds,
        };
        if let Some(table) = skew::fill_skew_table::<false>(candidate, &reversed, &ask) {
            best.offer_candidate(bound.index, table.last[query.series_frame_count() - 1]);
        }
    }
    best.found
}

/// A lower bound of a candidate's distance.
struct DistanceBound {
    least: f64,
    index: usize,
    /// Whether it comes from a sample of the frames.
    sampled: bool,
}

impl Ord for DistanceBound {
    fn cmp(&self, other: &Self) -> Ordering {
        self.least.total_cmp(&other.least).then(self.index.cmp(&other.index))
    }
}

impl PartialOrd for DistanceBound {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for DistanceBound {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for DistanceBound {}

/// Returns the sum, by eight independent sums.
fn sum_frame_bounds(bounds: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (chunks, rest) = bounds.as_chunks::<8>();
    for chunk in chunks {
        for (sum, value) in sums.iter_mut().zip(chunk) {
            *sum += value;
        }
    }
    sums.iter().chain(rest).sum()
}

/// Replaces the bound of each frame by the sum of those of all later frames.
fn accumulate_later_bounds(bounds: &mut [f64]) {
    let mut sum = 0.0;
    for bound in bounds.iter_mut().rev() {
        let bound_value = *bound;
        *bound = sum;
        sum += bound_value;
    }
}

/// The range of the query's values that each frame of a candidate may meet, for one length.
struct QueryEnvelope {
    /// Frames of the query that each frame of the candidate may be aligned with.
    rows: Vec<Range<usize>>,
    /// Least and greatest value, channel by channel.
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl QueryEnvelope {
    /// Returns the envelope for candidates of `length` frames; `None` if they have no path.
    fn envelope_for_length(query: &ChannelSeries, length: usize, options: &DtwOptions) -> Option<Self> {
        let window = options.window.window_row_ranges(query.series_frame_count(), length);
        if !is_window_connected(&window, length) {
            return None;
        }
        let rows = transpose_row_ranges(&window, length);
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for channel in 0..query.series_channel_count() {
            let column = query.channel_values(channel);
            lower.extend(sliding(column, &rows, |a, b| a <= b));
            upper.extend(sliding(column, &rows, |a, b| a >= b));
        }
        Some(Self { rows, lower, upper })
    }

    /// Writes for frames of `candidate` the least distance from any frame they may be aligned with: for
    /// the first [`BOUND_RUN_FRAMES`] frames in every `stride`.
    fn write_frame_bounds(&self, candidate: &ChannelSeries, local: LocalDistance, stride: usize, out: &mut Vec<f64>) {
        pulp::Arch::new().dispatch(EnvelopeSumsCall {
            envelope: self,
            candidate,
            local,
            stride,
            out,
        });
    }

    #[inline(always)]
    fn sums(&self, candidate: &ChannelSeries, local: LocalDistance, stride: usize, out: &mut Vec<f64>) {
        let frames = candidate.series_frame_count();
        out.clear();
        for start in (0..frames).step_by(stride) {
            let run = BOUND_RUN_FRAMES.min(frames - start);
            let mut sums = [0.0; BOUND_RUN_FRAMES];
            for channel in 0..candidate.series_channel_count() {
                let values = &candidate.channel_values(channel)[start..][..run];
                let envelope = channel * frames + start;
                let lower = &self.lower[envelope..][..run];
                let upper = &self.upper[envelope..][..run];
                for (((sum, value), lower), upper) in sums.iter_mut().zip(values).zip(lower).zip(upper) {
                    let (below, above) = (lower - value, value - upper);
                    let excess = if below > above { below } else { above };
                    let outside = if excess > 0.0 { excess } else { 0.0 };
                    *sum += outside * outside;
                }
            }
            if local == LocalDistance::Euclidean {
                sums = sums.map(f64::sqrt);
            }
            out.extend_from_slice(&sums[..run]);
        }
    }
}

/// The arguments of a call of [`QueryEnvelope::sums`]; `pulp` compiles the call for several instruction sets and selects one
/// of them at run time.
struct EnvelopeSumsCall<'a> {
    envelope: &'a QueryEnvelope,
    candidate: &'a ChannelSeries,
    local: LocalDistance,
    stride: usize,
    out: &'a mut Vec<f64>,
}

impl pulp::NullaryFnOnce for EnvelopeSumsCall<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.envelope.sums(self.candidate, self.local, self.stride, self.out);
    }
}

/// Returns the value of each range that comes first in the order `before`. A queue keeps the values before which no
/// later one comes (Lemire 2009, doi 10.1016/j.patcog.2008.11.030).
fn sliding(column: &[f64], ranges: &[Range<usize>], before: fn(f64, f64) -> bool) -> Vec<f64> {
    let mut queue: VecDeque<usize> = VecDeque::new();
    let mut next = 0;
    ranges
        .iter()
        .map(|range| {
            while next < range.end {
                while queue.back().is_some_and(|last| before(column[next], column[*last])) {
                    queue.pop_back();
                }
                queue.push_back(next);
                next += 1;
            }
            while queue.front().is_some_and(|first| *first < range.start) {
                queue.pop_front();
            }
            queue.front().map_or(0.0, |first| column[*first])
        })
        .collect()
}

/// The best candidates so far.
struct BestCandidates {
    k: usize,
    found: NearestCandidates,
}

impl BestCandidates {
    fn new(k: usize) -> Self {
        Self {
            k,
            found: NearestCandidates::default(),
        }
    }

    /// Returns the distance that a useful candidate must not exceed.
    fn useful_distance_limit(&self) -> f64 {
        let kept = &self.found.neighbours;
        match kept.last() {
            _ if self.k == 0 => f64::NEG_INFINITY,
            Some(last) if kept.len() >= self.k => last.distance,
            _ => f64::INFINITY,
        }
    }

    fn offer_candidate(&mut self, index: usize, distance: f64) {
        self.found.completed += 1;
        let kept = &mut self.found.neighbours;
        let place = kept.partition_point(|n| n.distance.total_cmp(&distance).then(n.index.cmp(&index)).is_lt());
        kept.insert(place, DtwNeighbour { index, distance });
        kept.truncate(self.k);
    }
}
