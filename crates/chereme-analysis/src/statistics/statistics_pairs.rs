//! Tests for several conditions judged by the same people.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::statistics_groups::chi_squared_above;
use super::{PValueMethod, TestAlternative, UndefinedStatistic, check_finite_values, exact_p, mid_ranks, normal_p};

/// The most pairs that differ for which p can be exact.
const MAX_EXACT_PAIRS: usize = 200;

/// The treatment of pairs whose two values are equal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ZeroTreatment {
    /// They are left out before ranks are given (Wilcoxon 1945).
    #[default]
    Wilcox,
    /// They get the lowest ranks, and are left out afterwards (Pratt 1959).
    Pratt,
}

/// The result of Wilcoxon's signed-rank test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WilcoxonResult {
    /// The number of pairs.
    pub n: usize,
    /// The number of pairs whose values are equal.
    pub zeros: usize,
    /// The sum of ranks of pairs whose first value is higher.
    pub plus: f64,
    /// The sum of ranks of pairs whose second value is higher.
    pub minus: f64,
    /// The effect: the difference of the two sums divided by their total, from -1 to 1.
    pub rank_biserial: f64,
    /// The probability of such sums if differences are symmetric about 0.
    pub p: f64,
    /// The computation of p.
    pub method: PValueMethod,
}

/// Tests whether the first values of pairs tend to be higher than the second values.
///
/// Without a method p is exact up to 200 pairs that differ, with ties too, and approximate above. The variance is a
/// quarter of the sum of squared ranks, which is n(n+1)(2n+1)/24 - Σ(t³-t)/48 without zeros. Source: Pratt 1959.
///
/// # Errors
/// [`UndefinedStatistic::Unequal`], [`UndefinedStatistic::Empty`], [`UndefinedStatistic::NotANumber`]; [`UndefinedStatistic::NoDifference`] if no pair
/// differs; [`UndefinedStatistic::TooMany`] for [`PValueMethod::Exact`] and more than 200 pairs.
pub fn wilcoxon_test(
    first: &[f64],
    second: &[f64],
    zeros: ZeroTreatment,
    side: TestAlternative,
    method: Option<PValueMethod>,
) -> Result<WilcoxonResult, UndefinedStatistic> {
    if first.len() != second.len() {
        return Err(UndefinedStatistic::Unequal);
    }
    let differences: Vec<f64> = first.iter().zip(second).map(|(x, y)| x - y).collect();
    check_finite_values(&differences)?;
    let all_differences = differences.iter().copied();
    let used: Vec<f64> = all_differences
        .filter(|difference| zeros == ZeroTreatment::Pratt || *difference != 0.0)
        .collect();
    let nonzero = differences.iter().filter(|difference| **difference != 0.0).count();
    if nonzero == 0 {
        return Err(UndefinedStatistic::NoDifference);
    }
    let sizes: Vec<f64> = used.iter().map(|difference| difference.abs()).collect();
    let ranks = mid_ranks(&sizes)?.ranks;
    let signed: Vec<(f64, f64)> = used.into_iter().zip(ranks).filter(|entry| entry.0 != 0.0).collect();
    let sum = |wanted: fn(f64) -> bool| -> f64 {
        let matching_ranks = signed.iter().filter(|entry| wanted(entry.0));
        matching_ranks.map(|entry| entry.1).sum()
    };
    let (plus, minus) = (sum(|number| number > 0.0), sum(|number| number < 0.0));
    let method = method.unwrap_or(if nonzero <= MAX_EXACT_PAIRS {
        PValueMethod::Exact
    } else {
        PValueMethod::Continuity
    });
    let p = match method {
        PValueMethod::Exact if nonzero > MAX_EXACT_PAIRS => {
            return Err(UndefinedStatistic::TooMany);
        }
        PValueMethod::Exact => {
            // Mid-ranks of ties end in a half; doubled, all of them are whole.
            let doubled_ranks = signed.iter().map(|entry| (2.0 * entry.1).round() as usize);
            let twice: Vec<usize> = doubled_ranks.collect();
            let observed = (2.0 * plus).round() as usize;
            exact_p(&sums_of_signs(&twice), observed, twice.iter().sum(), side)
        }
        PValueMethod::Continuity | PValueMethod::Normal => {
            let squares: f64 = signed.iter().map(|entry| entry.1 * entry.1).sum();
            let distance = plus - (plus + minus) / 2.0;
            normal_p(distance, squares.sqrt() / 2.0, side, method == PValueMethod::Continuity)?
        }
    };
    Ok(WilcoxonResult {
        n: first.len(),
        zeros: first.len() - nonzero,
        plus,
        minus,
        rank_biserial: (plus - minus) / (plus + minus),
        p,
        method,
    })
}

/// Returns the probability of each sum of ranks, where each rank is added or not with equal probability.
fn sums_of_signs(ranks: &[usize]) -> Vec<f64> {
    let mut weights = vec![0.0; ranks.iter().sum::<usize>() + 1];
    weights[0] = 1.0;
    let mut reached = 0;
    for rank in ranks {
        reached += rank;
        // Downwards, so that no rank is added twice.
        for at in (0..=reached).rev() {
            let with = at.checked_sub(*rank).map_or(0.0, |index| weights[index]);
            weights[at] = (weights[at] + with) / 2.0;
        }
    }
    weights
}

/// The result of a Friedman test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FriedmanResult {
    /// The number of people.
    pub n: usize,
    /// The number of conditions.
    pub k: usize,
    /// The statistic, corrected for ties.
    pub chi_squared: f64,
    /// The probability of such a statistic if conditions do not differ (chi-squared with k - 1 degrees of freedom).
    pub p: f64,
    /// Kendall's W, the agreement of people's orders, from 0 to 1.
    pub w: f64,
    /// The statistic in the form of Iman and Davenport (1980) and its p; nothing if all orders are the same, because it
    /// is infinite then.
    pub f: Option<(f64, f64)>,
    /// The mean rank of each condition.
    pub mean_ranks: Vec<f64>,
}

/// Tests whether people who judged all conditions rank any of them higher: one row a person, one column a condition.
///
/// Source: Friedman 1937, with the correction for ties of Conover, Practical Nonparametric Statistics, section 5.8.
///
/// # Errors
/// [`UndefinedStatistic::TooFew`] for fewer than two people or two conditions, [`UndefinedStatistic::Unequal`],
/// [`UndefinedStatistic::NotANumber`], and [`UndefinedStatistic::NoSpread`] if nobody ranks any condition higher.
pub fn friedman_test(rows: &[Vec<f64>]) -> Result<FriedmanResult, UndefinedStatistic> {
    let n = rows.len();
    let k = rows.first().map_or(0, Vec::len);
    if n < 2 || k < 2 {
        return Err(UndefinedStatistic::TooFew);
    }
    if rows.iter().any(|row| row.len() != k) {
        return Err(UndefinedStatistic::Unequal);
    }
    let mut sums = vec![0.0; k];
    let mut ties = 0.0;
    for row in rows {
        let row_ranks = mid_ranks(row)?;
        ties += row_ranks.tie_term();
        for (sum, rank) in sums.iter_mut().zip(row_ranks.ranks) {
            *sum += rank;
        }
    }
    let (people, conditions) = (n as f64, k as f64);
    let correction = 1.0 - ties / (people * (conditions.powi(3) - conditions));
    if correction <= 0.0 {
        return Err(UndefinedStatistic::NoSpread);
    }
    let expected = people * (conditions + 1.0) / 2.0;
    let squares: f64 = sums.iter().map(|sum| (sum - expected).powi(2)).sum();
    let plain = 12.0 * squares / (people * conditions * (conditions + 1.0));
    let chi_squared = plain / correction;
    let most = people * (conditions - 1.0);
    Ok(FriedmanResult {
        n,
        k,
        chi_squared,
        p: chi_squared_above(chi_squared, k - 1),
        w: chi_squared / most,
        f: iman_davenport(chi_squared, n, k),
        mean_ranks: sums.into_iter().map(|sum| sum / people).collect(),
    })
}

fn iman_davenport(chi_squared: f64, n: usize, k: usize) -> Option<(f64, f64)> {
    let most = n as f64 * (k as f64 - 1.0);
    if chi_squared >= most * (1.0 - 1e-12) {
        return None;
    }
    let f = (n as f64 - 1.0) * chi_squared / (most - chi_squared);
    let (above, below) = (k as f64 - 1.0, (n as f64 - 1.0) * (k as f64 - 1.0));
    let p = FisherSnedecor::new(above, below).ok()?.sf(f);
    Some((f, p))
}
