//! Statistics of ratings and choices in perceptual studies, for answers with few values and many ties, and of lexica.
//!
//! Every function takes plain numbers and is pure. A statistic without a value is [`Undefined`], with the reason; no function
//! returns a NaN, and none accepts one: leave such values out, and count them.
//!
//! | for | use |
//! |---|---|
//! | one group | [`Description`], [`mid_ranks`] |
//! | two groups | [`mann_whitney`], [`Effect`] |
//! | several groups | [`kruskal_wallis`] (with Dunn's comparisons), [`holm`] |
//! | two conditions, same people | [`wilcoxon`] |
//! | several conditions, same people | [`friedman`] |
//! | shares | [`wilson`], [`fisher`], [`mcnemar`] |
//! | two measures of the same things | [`spearman`], [`kendall`] |
//! | intervals and sameness | [`Resamples`], [`jackknife`], [`equivalence`] |
//! | values without an order | [`Classes`] (entropy), [`functional_load`], [`contrasts`], [`Association`], [`Shuffled`] |
//! | a model of answers on a scale | [`ordinal::fit`] |
//!
//! ```
//! use chereme_analysis::statistics::{Alternative, Effect, mann_whitney};
//!
//! let (playback, synthesis) = ([3.0, 4.0, 2.0, 5.0], [4.0, 5.0, 5.0, 4.0]);
//! let test = mann_whitney(&playback, &synthesis, Alternative::TwoSided, None)?;
//! assert_eq!(test.u, 4.0);
//! assert_eq!(Effect::of(&playback, &synthesis)?.delta, -0.5);
//! # Ok::<(), chereme_analysis::statistics::Undefined>(())
//! ```

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, Normal};

mod association;
mod correlation;
mod describe;
mod groups;
mod information;
pub mod ordinal;
mod pairs;
mod resample;
mod shares;
#[cfg(test)]
mod tests;

pub use association::{Association, Shuffled};
pub use correlation::{Correlation, kendall, spearman};
pub use describe::{Description, Ranks, mid_ranks, quantile};
pub use groups::{
    Comparison, Effect, KruskalWallis, MannWhitney, Size, holm, kruskal_wallis, mann_whitney,
};
pub use information::{Classes, Contrast, contrasts, functional_load, functional_load_interval};
pub use pairs::{Friedman, Wilcoxon, Zeros, friedman, wilcoxon};
pub use resample::{Equivalence, Interval, Resamples, equivalence, jackknife};
pub use shares::{Fisher, fisher, mcnemar, wilson};

/// The reason why a statistic has no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "kebab-case")]
pub enum Undefined {
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
pub enum Alternative {
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
pub enum Method {
    /// The distribution over all equally likely arrangements of the values, ties included.
    Exact,
    /// The normal approximation with a correction for continuity.
    Continuity,
    /// The normal approximation as it is.
    Normal,
}

/// Returns the share of the standard normal distribution above `z`.
pub(crate) fn above(z: f64) -> f64 {
    standard().sf(z)
}

/// Returns the point of the standard normal distribution below which the share `level` lies.
pub(crate) fn normal_point(level: f64) -> Result<f64, Undefined> {
    if level > 0.0 && level < 1.0 {
        Ok(standard().inverse_cdf(level))
    } else {
        Err(Undefined::OutOfRange)
    }
}

fn standard() -> Normal {
    Normal::new(0.0, 1.0).expect("the standard normal distribution")
}

/// Returns p of a statistic by the normal approximation: `distance` is the statistic minus its expectation.
///
/// With `continuity` half a unit is taken off towards the expectation; without it a deviation of 0 has no p.
fn normal_p(
    distance: f64,
    deviation: f64,
    side: Alternative,
    continuity: bool,
) -> Result<f64, Undefined> {
    if deviation <= 0.0 {
        return if continuity {
            Ok(1.0)
        } else {
            Err(Undefined::NoSpread)
        };
    }
    let half = if continuity { 0.5 } else { 0.0 };
    Ok(match side {
        Alternative::TwoSided => (2.0 * above((distance.abs() - half) / deviation)).min(1.0),
        Alternative::Less => above(-(distance + half) / deviation),
        Alternative::Greater => above((distance - half) / deviation),
    })
}

/// Returns p of an observed sum from the weights of all its values `0, 1, 2, …`.
///
/// Two-sided p counts the sums that are at least as far from the expectation, which is `twice_mean / 2`.
fn exact_p(weights: &[f64], observed: usize, twice_mean: usize, side: Alternative) -> f64 {
    let all: f64 = weights.iter().sum();
    let distance = |at: usize| (2 * at).abs_diff(twice_mean);
    let extreme = weights.iter().enumerate().filter(|(at, _)| match side {
        Alternative::TwoSided => distance(*at) >= distance(observed),
        Alternative::Less => *at <= observed,
        Alternative::Greater => *at >= observed,
    });
    let extreme: f64 = extreme.map(|(_, weight)| weight).sum();
    (extreme / all).min(1.0)
}

/// Refuses values that are not finite, and groups without values.
fn checked(values: &[f64]) -> Result<(), Undefined> {
    if values.is_empty() {
        return Err(Undefined::Empty);
    }
    if values.iter().any(|x| !x.is_finite()) {
        return Err(Undefined::NotANumber);
    }
    Ok(())
}
