//! Statistics of ratings and choices in perceptual studies, for answers with few values and many ties, and of lexica.
//!
//! Every function takes plain numbers and is pure. A statistic without a value is [`UndefinedStatistic`], with the reason; no function
//! returns a NaN, and none accepts one: leave such values out, and count them.
//!
//! | for | use |
//! |---|---|
//! | one group | [`GroupDescription`], [`mid_ranks`] |
//! | two groups | [`mann_whitney`], [`GroupEffect`] |
//! | several groups | [`kruskal_wallis`] (with Dunn's comparisons), [`holm_p_values`] |
//! | two conditions, same people | [`wilcoxon_test`] |
//! | several conditions, same people | [`friedman_test`] |
//! | shares | [`wilson_interval`], [`fisher_exact_test`], [`mcnemar_exact_test`] |
//! | two measures of the same things | [`spearman_correlation`], [`kendall_tau`] |
//! | intervals and sameness | [`ParticipantResamples`], [`jackknife_interval`], [`conclude_equivalence`] |
//! | values without an order | [`EqualityClasses`] (entropy), [`functional_load`], [`find_value_contrasts`], [`ValueAssociation`], [`ShuffledAssociation`] |
//! | rows that differ in few fields | [`count_row_neighbours`] |
//! | a model of answers on a scale | [`ordinal::fit_ordinal_model`] |
//!
//! ```
//! use chereme_analysis::statistics::{TestAlternative, GroupEffect, mann_whitney};
//!
//! let (playback, synthesis) = ([3.0, 4.0, 2.0, 5.0], [4.0, 5.0, 5.0, 4.0]);
//! let test = mann_whitney(&playback, &synthesis, TestAlternative::TwoSided, None)?;
//! assert_eq!(test.u, 4.0);
//! assert_eq!(GroupEffect::measure_group_effect(&playback, &synthesis)?.delta, -0.5);
//! # Ok::<(), chereme_analysis::statistics::UndefinedStatistic>(())
//! ```

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

mod association;
mod correlation;
mod describe;
mod information;
mod neighbours;
pub mod ordinal;
mod shares;
mod statistics_groups;
mod statistics_pairs;
mod statistics_resample;
#[cfg(test)]
mod tests;

pub use association::{ShuffledAssociation, ValueAssociation};
pub use correlation::{RankCorrelation, kendall_tau, spearman_correlation};
pub use describe::{GroupDescription, ValueRanks, mid_ranks, sorted_quantile};
pub use information::{
    EqualityClasses, ValueContrast, find_value_contrasts, functional_load, functional_load_interval,
};
pub use neighbours::{RowNeighbours, count_row_neighbours};
pub use shares::{FisherResult, fisher_exact_test, mcnemar_exact_test, wilson_interval};
pub use statistics_groups::{
    EffectComparison, EffectSize, GroupEffect, KruskalWallis, MannWhitney, holm_p_values, kruskal_wallis, mann_whitney,
};
pub use statistics_pairs::{FriedmanResult, WilcoxonResult, ZeroTreatment, friedman_test, wilcoxon_test};
pub use statistics_resample::{
    EquivalenceConclusion, ParticipantResamples, ResampleIntervalRule, conclude_equivalence, jackknife_interval,
};

/// The reason why a statistic has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "kebab-case")]
pub enum UndefinedStatistic {
    /// A value is not a finite number.
    #[error("a value is not a number")]
    NotANumber,
    /// A group has no value.
    #[error("a group is empty")]
    Empty,
    /// There are fewer values than the statistic needs.
    #[error("there are too few values")]
    TooFew,
    /// There are more values than the computation is made for.
    #[error("there are too many different values")]
    TooMany,
    /// All values are equal, or all values of one side.
    #[error("there is no spread: all values are equal")]
    NoSpread,
    /// The two values of each pair are equal.
    #[error("no pair differs")]
    NoDifference,
    /// Groups do not overlap, so that no finite estimate exists.
    #[error("the groups do not overlap, so no finite estimate exists")]
    Separated,
    /// A column of a model follows from the other columns.
    #[error("a column of the model follows from the others")]
    Dependent,
    /// The value is infinite.
    #[error("the value is infinite")]
    Infinite,
    /// Two lists that belong together have different lengths.
    #[error("two lists that belong together have different lengths")]
    Unequal,
    /// A share, level or bound lies outside its range.
    #[error("a level, a count or a bound lies outside its range")]
    OutOfRange,
}

/// The direction in which a test looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TestAlternative {
    /// The groups differ, in any direction.
    #[default]
    TwoSided,
    /// The first group tends to lower values.
    Less,
    /// The first group tends to higher values.
    Greater,
}

/// The computation of a p-value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PValueMethod {
    /// The distribution over all equally likely arrangements of the values, ties included.
    Exact,
    /// The normal approximation with a correction for continuity.
    Continuity,
    /// The normal approximation as it is.
    Normal,
}

/// Returns the share of the standard normal distribution above `z`.
pub(crate) fn normal_tail_share(z: f64) -> f64 {
    standard().sf(z)
}

/// Returns the point of the standard normal distribution below which the share `level` lies.
pub(crate) fn normal_point(level: f64) -> Result<f64, UndefinedStatistic> {
    if level > 0.0 && level < 1.0 {
        Ok(standard().inverse_cdf(level))
    } else {
        Err(UndefinedStatistic::OutOfRange)
    }
}

fn standard() -> Normal {
    Normal::new(0.0, 1.0).expect("the standard normal distribution")
}

/// Returns p of a statistic by the normal approximation: `distance` is the statistic minus its expectation.
///
/// With `continuity` half a unit is taken off towards the expectation; without it a deviation of 0 has no p.
fn normal_p(distance: f64, deviation: f64, side: TestAlternative, continuity: bool) -> Result<f64, UndefinedStatistic> {
    if deviation <= 0.0 {
        return if continuity {
            Ok(1.0)
        } else {
            Err(UndefinedStatistic::NoSpread)
        };
    }
    let half = if continuity { 0.5 } else { 0.0 };
    Ok(match side {
        TestAlternative::TwoSided => (2.0 * normal_tail_share((distance.abs() - half) / deviation)).min(1.0),
        TestAlternative::Less => normal_tail_share(-(distance + half) / deviation),
        TestAlternative::Greater => normal_tail_share((distance - half) / deviation),
    })
}

/// Returns p of an observed sum from the weights of all its values `0, 1, 2, …`.
///
/// Two-sided p counts the sums that are at least as far from the expectation, which is `twice_mean / 2`.
fn exact_p(weights: &[f64], observed: usize, twice_mean: usize, side: TestAlternative) -> f64 {
    let all: f64 = weights.iter().sum();
    let distance = |at: usize| (2 * at).abs_diff(twice_mean);
    let extreme_weights = weights.iter().enumerate().filter(|(at, _)| match side {
        TestAlternative::TwoSided => distance(*at) >= distance(observed),
        TestAlternative::Less => *at <= observed,
        TestAlternative::Greater => *at >= observed,
    });
    let extreme: f64 = extreme_weights.map(|(_, weight)| weight).sum();
    (extreme / all).min(1.0)
}

/// Refuses values that are not finite, and groups without values.
fn check_finite_values(values: &[f64]) -> Result<(), UndefinedStatistic> {
    if values.is_empty() {
        return Err(UndefinedStatistic::Empty);
    }
    if values.iter().any(|x| !x.is_finite()) {
        return Err(UndefinedStatistic::NotANumber);
    }
    Ok(())
}
