//! Agreement of two segmentations without gaps: boundary similarity (Fournier 2013), WindowDiff, Pk.

use super::{AgreementMeasure, UndefinedAgreement};

/// A segmentation: the lengths of its segments, in whole steps such as frames of 40 ms.
pub type SegmentMasses = [usize];

/// The edits that turn one segmentation into another.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SegmentationEdits {
    /// Boundaries that both have.
    pub matches: usize,
    /// Boundaries that one has and the other lacks.
    pub additions: usize,
    /// Boundaries that lie less than `near` steps apart.
    pub transpositions: usize,
    /// The sum of the distances of these boundaries, in steps.
    pub distance: usize,
    /// Places where a boundary may be.
    pub places: usize,
}

impl SegmentationEdits {
    /// Adds the edits of another stretch.
    pub fn add_segmentation_edits(&mut self, other: &Self) {
        self.matches += other.matches;
        self.additions += other.additions;
        self.transpositions += other.transpositions;
        self.distance += other.distance;
        self.places += other.places;
    }

    /// Returns the boundary similarity of the edits, see [`boundary_similarity`].
    ///
    /// # Errors
    /// [`UndefinedAgreement::NoBoundary`].
    pub fn boundary_similarity(&self, near: usize) -> AgreementMeasure {
        let all = self.additions + self.transpositions + self.matches;
        if all == 0 {
            return Err(UndefinedAgreement::NoBoundary);
        }
        Ok(1.0 - segmentation_edit_cost(self, near) / all as f64)
    }
}

/// Returns the edits between two segmentations; boundaries less than `near` steps apart are one boundary in two places.
///
/// The nearest boundaries are paired first, earlier ones before later ones.
#[must_use]
pub fn count_segmentation_edits(first: &SegmentMasses, second: &SegmentMasses, near: usize) -> SegmentationEdits {
    let (a, b) = (boundary_places(first), boundary_places(second));
    let length = first.iter().sum::<usize>().max(second.iter().sum::<usize>());
    let mut near_pairs: Vec<(usize, usize, usize)> = Vec::new();
    for (at, place) in a.iter().enumerate() {
        let from = b.partition_point(|boundary| boundary + near <= *place);
        for (other, it) in b.iter().enumerate().skip(from) {
            if *it >= place + near.max(1) {
                break;
            }
            near_pairs.push((place.abs_diff(*it), at, other));
        }
    }
    near_pairs.sort_unstable();
    let (mut of_a, mut of_b) = (vec![false; a.len()], vec![false; b.len()]);
    let mut edits = SegmentationEdits {
        places: length.saturating_sub(1),
        additions: a.len() + b.len(),
        ..SegmentationEdits::default()
    };
    for (distance, at, other) in near_pairs {
        if of_a[at] || of_b[other] {
            continue;
        }
        (of_a[at], of_b[other]) = (true, true);
        edits.additions -= 2;
        match distance {
            0 => edits.matches += 1,
            _ => edits.transpositions += 1,
        }
        edits.distance += distance;
    }
    edits
}

/// Returns the places of the boundaries, without the two ends.
fn boundary_places(masses: &SegmentMasses) -> Vec<usize> {
    let mut ends: Vec<usize> = masses
        .iter()
        .scan(0, |end, mass| {
            *end += mass;
            Some(*end)
        })
        .collect();
    ends.pop();
    ends
}

/// Returns boundary similarity: 1 less the edits over all boundaries; boundaries less than `near` steps apart count in
/// proportion to their distance.
///
/// # Errors
/// [`UndefinedAgreement::NoBoundary`].
pub fn boundary_similarity(first: &SegmentMasses, second: &SegmentMasses, near: usize) -> AgreementMeasure {
    count_segmentation_edits(first, second, near).boundary_similarity(near)
}

/// Returns segmentation similarity (Fournier and Inkpen 2012): as boundary similarity, over all places for a boundary.
///
/// # Errors
/// [`UndefinedAgreement::NoBoundary`].
pub fn segmentation_similarity(first: &SegmentMasses, second: &SegmentMasses, near: usize) -> AgreementMeasure {
    let edits = count_segmentation_edits(first, second, near);
    if edits.additions + edits.transpositions + edits.matches == 0 {
        return Err(UndefinedAgreement::NoBoundary);
    }
    Ok(1.0 - segmentation_edit_cost(&edits, near) / edits.places as f64)
}

fn segmentation_edit_cost(edits: &SegmentationEdits, near: usize) -> f64 {
    edits.additions as f64 + edits.distance as f64 / near.max(1) as f64
}

/// Returns WindowDiff (Pevzner and Hearst 2002): the share of windows with different numbers of boundaries; a window is
/// half a mean segment of the second segmentation long.
///
/// # Errors
/// [`UndefinedAgreement::NoBoundary`] if no window fits.
pub fn window_diff(first: &SegmentMasses, second: &SegmentMasses) -> AgreementMeasure {
    compare_segmentation_windows(first, second, |a, b| a != b)
}

/// Returns Pk (Beeferman, Berger and Lafferty 1999): the share of windows whose two ends are in one segment for one of
/// the two only.
///
/// # Errors
/// [`UndefinedAgreement::NoBoundary`] if no window fits.
pub fn segmentation_pk(first: &SegmentMasses, second: &SegmentMasses) -> AgreementMeasure {
    compare_segmentation_windows(first, second, |a, b| (a == 0) != (b == 0))
}

fn compare_segmentation_windows(
    first: &SegmentMasses,
    second: &SegmentMasses,
    differ: impl Fn(usize, usize) -> bool,
) -> AgreementMeasure {
    let length: usize = second.iter().sum();
    let half = length as f64 / second.len().max(1) as f64 / 2.0;
    let window = (half.round_ties_even() as usize).max(2);
    if first.iter().sum::<usize>() != length || window >= length {
        return Err(UndefinedAgreement::NoBoundary);
    }
    let (a, b) = (boundary_places(first), boundary_places(second));
    let within = |places: &[usize], start: usize| {
        let before = |end: usize| places.partition_point(|place| *place <= end);
        before(start + window) - before(start)
    };
    let count = length - window;
    let wrong = (0..count).filter(|start| differ(within(&a, *start), within(&b, *start)));
    Ok(wrong.count() as f64 / count as f64)
}
