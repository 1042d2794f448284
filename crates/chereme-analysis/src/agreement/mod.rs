//! Agreement between annotators: on values of the same items, on spans and values of two tiers, on boundaries.
//!
//! | module | holds |
//! |---|---|
//! | [`items`] | raw agreement, kappa of Cohen, Scott and Fleiss, AC1 of Gwet, alpha of Krippendorff |
//! | [`matching`] | two tiers as ELAN compares them: ratio of overlap, matched units, modified kappa |
//! | [`unitizing`] | alpha over time: alpha_U, the u-alpha family, frames |
//! | [`gamma`] | alignment of least disorder, gamma and gamma_cat |
//! | [`segments`] | boundary similarity, WindowDiff, Pk |
//! | [`span_measures`] | mF1B, mF1S, IoU, offsets, splits and merges of segmentations with gaps |
//! | [`agreement_resample`] | percentile intervals from a seed |
//!
//! A figure that is undefined is an [`UndefinedAgreement`] with its reason, never NaN, 0 or 1. Times are whole numbers of any unit;
//! alpha_U counts in this unit, and its authors count milliseconds.
//!
//! Limits. Gamma's chance is drawn as in pygamma-agreement, where the paper shifts real units: numbers of other programs
//! differ by some 0.05, and by more on few units. The expected term of cuα is a limit, because the paper was not at hand.
//! The alignment of three or more annotators is exact, or refused if the search is too long. Staccato is left out.
//!
//! ```
//! use chereme_analysis::agreement::{items::AgreementCounts, UndefinedAgreement};
//!
//! let counts = AgreementCounts::from_value_pairs(&[(0, 0), (0, 1), (1, 1), (1, 1)]);
//! assert_eq!(counts.cohen_kappa(), Ok(0.5));
//! assert_eq!(AgreementCounts::from_value_pairs(&[(0, 0)]).cohen_kappa(), Err(UndefinedAgreement::OneValue));
//! ```

pub mod agreement_resample;
mod assignment;
pub mod gamma;
pub mod items;
pub mod matching;
pub mod segments;
pub mod span_measures;
#[cfg(test)]
mod tests;
pub mod unitizing;

use std::ops::Range;
use thiserror::Error;

/// A figure, or the reason why it is undefined.
pub type AgreementMeasure = Result<f64, UndefinedAgreement>;

/// The reason why a figure is undefined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum UndefinedAgreement {
    /// No tier has a unit.
    #[error("both tiers empty")]
    BothEmpty,
    /// All units or items have the same value, so that chance alone would agree.
    #[error("one value only")]
    OneValue,
    /// Nobody else gave a value to any item that has one.
    #[error("no item has two values")]
    NoPair,
    /// The figure needs two annotators, or a value from each for every item.
    #[error("values are missing")]
    Missing,
    /// Chance alone explains all, for another reason than a single value.
    #[error("no disagreement is expected by chance")]
    NoChance,
    /// There is no boundary within the time.
    #[error("no boundary")]
    NoBoundary,
    /// The units do not follow each other without gaps.
    #[error("units with gaps between them")]
    Gaps,
    /// More units overlap than can be aligned.
    #[error("too many units overlap")]
    TooMany,
}

/// A span with a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct AnnotatedUnit {
    /// The start.
    pub start: i64,
    /// The first moment after it.
    pub end: i64,
    /// The number of its value.
    pub value: usize,
}

impl AnnotatedUnit {
    /// Returns the unit of a span with a value.
    #[must_use]
    pub fn new(start: i64, end: i64, value: usize) -> Self {
        Self { start, end, value }
    }

    /// Returns the length.
    #[must_use]
    pub fn unit_length(&self) -> i64 {
        self.end - self.start
    }

    /// Returns the time that both cover; touching units share none.
    #[must_use]
    pub fn shared_unit_time(&self, other: &Self) -> i64 {
        (self.end.min(other.end) - self.start.max(other.start)).max(0)
    }
}

/// The largest time of a unit, on either side of 0: some 30 years in milliseconds.
const MOST_TIME: i64 = 1 << 40;

/// The units of each annotator over one stretch of time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AnnotationContinuum {
    start: i64,
    end: i64,
    tiers: Vec<Vec<AnnotatedUnit>>,
}

impl AnnotationContinuum {
    /// Creates the continuum of a stretch of time from the units of each annotator.
    ///
    /// Units are put in the order of time; units without length are left out; the stretch is extended to hold every
    /// unit.
    #[must_use]
    pub fn new(stretch: Range<i64>, tiers: Vec<Vec<AnnotatedUnit>>) -> Self {
        let within = |time: i64| time.clamp(-MOST_TIME, MOST_TIME);
        let cleaned = |units: Vec<AnnotatedUnit>| {
            let clipped_units = units.into_iter().map(|unit| AnnotatedUnit {
                start: within(unit.start),
                end: within(unit.end),
                ..unit
            });
            let mut units: Vec<AnnotatedUnit> = clipped_units.filter(|unit| unit.end > unit.start).collect();
            units.sort_unstable();
            units
        };
        let tiers: Vec<Vec<AnnotatedUnit>> = tiers.into_iter().map(cleaned).collect();
        let (mut start, mut end) = (within(stretch.start), within(stretch.end));
        for unit in tiers.iter().flatten() {
            start = start.min(unit.start);
            end = end.max(unit.end);
        }
        // A stretch that is given backwards is empty.
        let end = end.max(start);
        Self { start, end, tiers }
    }

    /// Returns the start of the stretch.
    #[must_use]
    pub fn continuum_start(&self) -> i64 {
        self.start
    }

    /// Returns the first moment after the stretch.
    #[must_use]
    pub fn continuum_end(&self) -> i64 {
        self.end
    }

    /// Returns the units of each annotator, by time.
    #[must_use]
    pub fn annotator_tiers(&self) -> &[Vec<AnnotatedUnit>] {
        &self.tiers
    }

    /// Returns the number of units of all annotators.
    #[must_use]
    pub fn annotated_unit_count(&self) -> usize {
        self.tiers.iter().map(Vec::len).sum()
    }

    /// Returns the continua one after another as one.
    #[must_use]
    pub fn join_continua(all: &[Self]) -> Self {
        let annotators = all.iter().map(|continuum| continuum.tiers.len()).max().unwrap_or(0);
        let mut tiers = vec![Vec::new(); annotators];
        let mut end = 0_i64;
        for one in all {
            for (tier, units) in tiers.iter_mut().zip(&one.tiers) {
                let moved = |unit: &AnnotatedUnit| {
                    AnnotatedUnit::new(unit.start - one.start + end, unit.end - one.start + end, unit.value)
                };
                tier.extend(units.iter().map(moved));
            }
            end += one.end - one.start;
        }
        Self { start: 0, end, tiers }
    }
}

/// Returns `(observed - expected) / (1 - expected)`.
fn beyond_chance(observed: f64, expected: f64) -> AgreementMeasure {
    let room = 1.0 - expected;
    // Chance alone agrees everywhere, and nothing is left to explain.
    if room.abs() < 1e-12 {
        return Err(UndefinedAgreement::OneValue);
    }
    Ok((observed - expected) / room)
}

/// Returns `1 - observed / expected` of disagreements.
fn below_chance(observed: f64, expected: f64, reason: UndefinedAgreement) -> AgreementMeasure {
    if expected.abs() < 1e-300 {
        return Err(reason);
    }
    Ok(1.0 - observed / expected)
}
