//! Agreement of two segmentations without gaps: boundary similarity (Fournier 2013).

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
}

impl SegmentationEdits {
    /// Adds the edits of another stretch.
    pub fn add_segmentation_edits(&mut self, other: &Self) {
        self.matches += other.matches;
        self.additions += other.additions;
        self.transpositions += other.transpositions;
        self.distance += other.distance;
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
    let mut near_pairs: Vec<(usize, usize, usize)> = Vec::new();
    for (at, place) in a.iter().enumerate() {
        // Boundaries rise, so that only those around the place are compared.
        let from = b.partition_point(|boundary| boundary + near <= *place);
        for (other, it) in b.iter().enumerate().skip(from) {
            // Equal places match even if `near` is 0.
            if *it >= place + near.max(1) {
                break;
            }
            near_pairs.push((place.abs_diff(*it), at, other));
        }
    }
    near_pairs.sort_unstable();
    let (mut of_a, mut of_b) = (vec![false; a.len()], vec![false; b.len()]);
    let mut edits = SegmentationEdits {
        additions: a.len() + b.len(),
        ..SegmentationEdits::default()
    };
    for (distance, at, other) in near_pairs {
        if of_a[at] || of_b[other] {
            continue;
        }
        (of_a[at], of_b[other]) = (true, true);
        // A pair takes the place of one addition on either side.
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

fn segmentation_edit_cost(edits: &SegmentationEdits, near: usize) -> f64 {
    edits.additions as f64 + edits.distance as f64 / near.max(1) as f64
}
