//! Agreement of two segmentations with gaps, such as the signs of a take by a person and by a program: boundaries, spans, and
//! what was split or merged.
//!
//! Times are put on a grid of 25 frames a second first ([`grid_frames`]), whatever the rate of a capture; figures on other grids
//! cannot be compared. mF1B and mF1S are those of Renz et al. 2021; here the share of an overlap is never below 0. Pool the
//! counts of all takes ([`SpanComparison::add_span_comparison`]) before a figure is read. IoU alone says little: it does not see
//! that two signs are one span.

use std::ops::Range;

use super::{AgreementMeasure, UndefinedAgreement};

/// The length of a frame of the grid, in microseconds.
pub const GRID_FRAME_US: i64 = 40_000;
/// The tolerances of boundaries, in frames of the grid.
const BOUNDARY_TOLERANCES: [f64; 4] = [1.0, 2.0, 3.0, 4.0];
/// The shares of overlap above which two spans are one.
const OVERLAP_SHARES: [f64; 8] = [0.40, 0.45, 0.50, 0.55, 0.60, 0.65, 0.70, 0.75];
/// The share of a span that lies within another if it is a piece of it.
const PIECE_SHARE: f64 = 0.5;

/// Hits, and what is only in one of the two.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HitCounts {
    /// What both have.
    pub hits: usize,
    /// What only the second has.
    pub surplus: usize,
    /// What only the first has.
    pub missed: usize,
}

impl HitCounts {
    fn of_hits(hits: usize, first: usize, second: usize) -> Self {
        Self {
            hits,
            surplus: second - hits,
            missed: first - hits,
        }
    }

    fn add_hits(&mut self, other: Self) {
        self.hits += other.hits;
        self.surplus += other.surplus;
        self.missed += other.missed;
    }

    /// Returns F1, from 0 to 1.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn f1_measure(self) -> AgreementMeasure {
        match 2 * self.hits + self.surplus + self.missed {
            0 => Err(UndefinedAgreement::BothEmpty),
            all => Ok(2.0 * self.hits as f64 / all as f64),
        }
    }
}

/// Two spans that were matched, by their places in the two lists.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MatchedSpans {
    /// The place in the first list.
    pub first: usize,
    /// The place in the second list.
    pub second: usize,
    /// The shared time as a share of the time of both.
    pub overlap: f64,
}

/// The comparison of spans, the first ones being those of a person or the truth.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpanComparison {
    /// How many spans the first has.
    pub first_count: usize,
    /// How many spans the second has.
    pub second_count: usize,
    /// Boundaries within 1, 2, 3 and 4 frames.
    pub boundaries: [HitCounts; 4],
    /// Spans that overlap by more than .40, .45, up to .75.
    pub spans: [HitCounts; 8],
    /// Frames within spans of both, and of any.
    pub shared_frames: i64,
    /// Frames within spans of any.
    pub covered_frames: i64,
    /// The overlap of each matched pair.
    pub overlaps: Vec<f64>,
    /// The times by which the begins of overlapping pairs are later in the second, in frames.
    pub begin_offsets: Vec<i64>,
    /// The same for their ends.
    pub end_offsets: Vec<i64>,
    /// Spans of the first that are several of the second.
    pub splits: usize,
    /// Spans of the second that are several of the first.
    pub merges: usize,
}

/// Returns the frames of the grid for a span in microseconds.
#[must_use]
pub fn grid_frames(start_us: i64, end_us: i64) -> Range<i64> {
    // To the nearest frame, before 0 too.
    let frame = |micros: i64| (micros + GRID_FRAME_US / 2).div_euclid(GRID_FRAME_US);
    let start = frame(start_us);
    // A span shorter than a frame still covers one.
    start..frame(end_us).max(start + 1)
}

/// Compares the spans of two annotators, in frames of the grid.
#[must_use]
pub fn compare_span_lists(first: &[Range<i64>], second: &[Range<i64>]) -> SpanComparison {
    let matched = match_spans_by_overlap(first, second);
    let distances = closest_boundary_distances(&boundary_positions(first), &boundary_positions(second));
    let (first_boundaries, second_boundaries) = (boundary_positions(first).len(), boundary_positions(second).len());
    let is_overlapping = |pair: &&MatchedSpans| pair.overlap > 0.0;
    let offsets = |of: fn(&Range<i64>) -> i64| -> Vec<i64> {
        let pairs = matched.iter().filter(is_overlapping);
        pairs
            .map(|pair| of(&second[pair.second]) - of(&first[pair.first]))
            .collect()
    };
    // In pieces, because overlapping spans of one list would count a frame twice.
    let shared: i64 = covered_pieces(first)
        .iter()
        .flat_map(|one| {
            covered_pieces(second)
                .into_iter()
                .map(|other| shared_frames(one, &other))
        })
        .sum();
    let covered = |spans: &[Range<i64>]| {
        covered_pieces(spans)
            .iter()
            .map(|span| span.end - span.start)
            .sum::<i64>()
    };
    SpanComparison {
        first_count: first.len(),
        second_count: second.len(),
        boundaries: BOUNDARY_TOLERANCES.map(|tolerance| {
            let hits = distances.iter().filter(|distance| **distance <= tolerance).count();
            HitCounts::of_hits(hits, first_boundaries, second_boundaries)
        }),
        spans: OVERLAP_SHARES.map(|share| {
            let hits = matched.iter().filter(|pair| pair.overlap > share).count();
            HitCounts::of_hits(hits, first.len(), second.len())
        }),
        shared_frames: shared,
        covered_frames: covered(first) + covered(second) - shared,
        overlaps: matched.iter().map(|pair| pair.overlap).collect(),
        begin_offsets: offsets(|span| span.start),
        end_offsets: offsets(|span| span.end),
        splits: count_divided_spans(first, second),
        merges: count_divided_spans(second, first),
    }
}

impl SpanComparison {
    /// Adds the comparison of another take.
    pub fn add_span_comparison(&mut self, other: &Self) {
        self.first_count += other.first_count;
        self.second_count += other.second_count;
        for (counts, more) in self.boundaries.iter_mut().zip(&other.boundaries) {
            counts.add_hits(*more);
        }
        for (counts, more) in self.spans.iter_mut().zip(&other.spans) {
            counts.add_hits(*more);
        }
        self.shared_frames += other.shared_frames;
        self.covered_frames += other.covered_frames;
        self.overlaps.extend(&other.overlaps);
        self.begin_offsets.extend(&other.begin_offsets);
        self.end_offsets.extend(&other.end_offsets);
        self.splits += other.splits;
        self.merges += other.merges;
    }

    /// Returns mF1B: the mean F1 of boundaries over four tolerances, from 0 to 1.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn mean_boundary_f1(&self) -> AgreementMeasure {
        mean_of_measures(self.boundaries.iter().map(|counts| counts.f1_measure()))
    }

    /// Returns mF1S: the mean F1 of spans over eight shares of overlap, from 0 to 1.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn mean_span_f1(&self) -> AgreementMeasure {
        mean_of_measures(self.spans.iter().map(|counts| counts.f1_measure()))
    }

    /// Returns F1 of spans that overlap by more than half.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn half_overlap_f1(&self) -> AgreementMeasure {
        self.spans[2].f1_measure()
    }

    /// Returns the frames within spans of both as a share of those within spans of any.
    ///
    /// # Errors
    /// [`UndefinedAgreement::BothEmpty`].
    pub fn frame_overlap(&self) -> AgreementMeasure {
        match self.covered_frames {
            0 => Err(UndefinedAgreement::BothEmpty),
            covered => Ok(self.shared_frames as f64 / covered as f64),
        }
    }

    /// Returns the mean overlap of matched pairs.
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoPair`].
    pub fn mean_pair_overlap(&self) -> AgreementMeasure {
        match self.overlaps.len() {
            0 => Err(UndefinedAgreement::NoPair),
            count => Ok(self.overlaps.iter().sum::<f64>() / count as f64),
        }
    }

    /// Returns how many spans the second has for each of the first.
    ///
    /// # Errors
    /// [`UndefinedAgreement::Missing`] if the first has none.
    pub fn span_count_ratio(&self) -> AgreementMeasure {
        match self.first_count {
            0 => Err(UndefinedAgreement::Missing),
            count => Ok(self.second_count as f64 / count as f64),
        }
    }
}

/// Returns so many spans of equal length that follow each other through a time: the baseline that knows the true count.
#[must_use]
pub fn divide_evenly(time: Range<i64>, count: usize) -> Vec<Range<i64>> {
    let length = time.end - time.start;
    let boundary = |part: usize| time.start + length * part as i64 / count.max(1) as i64;
    let spans = (0..count).map(|part| boundary(part)..boundary(part + 1));
    spans.filter(|span| span.end > span.start).collect()
}

fn mean_of_measures(measures: impl Iterator<Item = AgreementMeasure>) -> AgreementMeasure {
    let all: Vec<f64> = measures.collect::<Result<_, _>>()?;
    Ok(all.iter().sum::<f64>() / all.len() as f64)
}

fn shared_frames(one: &Range<i64>, other: &Range<i64>) -> i64 {
    (one.end.min(other.end) - one.start.max(other.start)).max(0)
}

/// Matches the pair with the largest overlap first, and so on; each span is in one pair at most.
fn match_spans_by_overlap(first: &[Range<i64>], second: &[Range<i64>]) -> Vec<MatchedSpans> {
    let mut pairs: Vec<MatchedSpans> = Vec::new();
    for (place, one) in first.iter().enumerate() {
        for (other_place, other) in second.iter().enumerate() {
            let shared = shared_frames(one, other);
            let all = one.end.max(other.end) - one.start.min(other.start);
            pairs.push(MatchedSpans {
                first: place,
                second: other_place,
                overlap: shared as f64 / all.max(1) as f64,
            });
        }
    }
    // A stable sort keeps equal overlaps in the order of the lists.
    pairs.sort_by(|one, other| other.overlap.total_cmp(&one.overlap));
    let (mut in_first, mut in_second) = (vec![false; first.len()], vec![false; second.len()]);
    pairs.retain(|pair| {
        let is_free = !in_first[pair.first] && !in_second[pair.second];
        if is_free {
            (in_first[pair.first], in_second[pair.second]) = (true, true);
        }
        is_free
    });
    pairs
}

/// Returns the middle of each run of frames at which a span begins or ends.
fn boundary_positions(spans: &[Range<i64>]) -> Vec<f64> {
    let mut frames: Vec<i64> = spans.iter().flat_map(|span| [span.start, span.end]).collect();
    frames.sort_unstable();
    frames.dedup();
    // An end and a begin in neighbouring frames are one boundary.
    let runs = frames.chunk_by(|one, next| next - one == 1);
    runs.map(|run| (run[0] + run[run.len() - 1]) as f64 / 2.0).collect()
}

/// Returns the distances of the closest boundaries of both, of the next closest ones, and so on.
fn closest_boundary_distances(first: &[f64], second: &[f64]) -> Vec<f64> {
    let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
    for (place, one) in first.iter().enumerate() {
        pairs.extend(
            second
                .iter()
                .enumerate()
                .map(|(other_place, other)| ((one - other).abs(), place, other_place)),
        );
    }
    pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
    let (mut in_first, mut in_second) = (vec![false; first.len()], vec![false; second.len()]);
    let mut distances = Vec::new();
    for (distance, place, other_place) in pairs {
        if !in_first[place] && !in_second[other_place] {
            (in_first[place], in_second[other_place]) = (true, true);
            distances.push(distance);
        }
    }
    distances
}

/// Returns the pieces of time that spans cover.
fn covered_pieces(spans: &[Range<i64>]) -> Vec<Range<i64>> {
    let mut sorted: Vec<Range<i64>> = spans.to_vec();
    sorted.sort_by_key(|span| (span.start, span.end));
    let mut pieces: Vec<Range<i64>> = Vec::new();
    for span in sorted {
        match pieces.last_mut() {
            Some(last) if span.start <= last.end => last.end = last.end.max(span.end),
            _ => pieces.push(span),
        }
    }
    pieces
}

/// Counts the spans that contain half or more of each of several others.
fn count_divided_spans(spans: &[Range<i64>], others: &[Range<i64>]) -> usize {
    let is_piece = |span: &Range<i64>, other: &Range<i64>| {
        shared_frames(span, other) as f64 >= PIECE_SHARE * (other.end - other.start) as f64
    };
    let is_divided = |span: &&Range<i64>| others.iter().filter(|other| is_piece(span, other)).count() > 1;
    spans.iter().filter(is_divided).count()
}
