//! Rank correlations of two measures of the same things.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::{UndefinedStatistic, ValueRanks, mid_ranks, normal_tail_share};

/// The most things whose pairs are compared.
const MAX_CORRELATED_THINGS: usize = 20_000;
/// The most things for which p of Kendall's tau is exact.
const MAX_EXACT_KENDALL: usize = 100;

/// A rank correlation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RankCorrelation {
    /// The number of things.
    pub n: usize,
    /// The coefficient, from -1 to 1.
    pub coefficient: f64,
    /// The two-sided p; nothing for two things with Spearman's coefficient.
    pub p: Option<f64>,
}

/// Returns Spearman's coefficient, the correlation of mid-ranks; p by Student's t with n - 2 degrees of freedom.
///
/// # Errors
/// [`UndefinedStatistic::Unequal`], [`UndefinedStatistic::TooFew`] for fewer than two things, [`UndefinedStatistic::NotANumber`], and
/// [`UndefinedStatistic::NoSpread`] if all values of one measure are equal.
pub fn spearman_correlation(x: &[f64], y: &[f64]) -> Result<RankCorrelation, UndefinedStatistic> {
    let [x, y] = both_ranks(x, y)?;
    let n = x.ranks.len();
    let mean = (n as f64 + 1.0) / 2.0;
    let product = |a: &ValueRanks, b: &ValueRanks| -> f64 {
        let pairs = a.ranks.iter().zip(&b.ranks);
        pairs.map(|(a, b)| (a - mean) * (b - mean)).sum()
    };
    let raw_rho = product(&x, &y) / (product(&x, &x) * product(&y, &y)).sqrt();
    let rho = raw_rho.clamp(-1.0, 1.0);
    let df = n as f64 - 2.0;
    let t = rho * (df / (1.0 - rho * rho)).sqrt();
    let student = StudentsT::new(0.0, 1.0, df).ok();
    let p = student.map(|distribution| {
        // A correlation of 1 has an infinite t.
        if t.is_finite() {
            2.0 * distribution.sf(t.abs())
        } else {
            0.0
        }
    });
    Ok(RankCorrelation { n, coefficient: rho, p })
}

/// Returns Kendall's tau-b; p is exact up to 100 things without ties, and approximate with ties or for more things.
///
/// Source: Kendall, Rank Correlation Methods (1970), chapters 4 and 5.
///
/// # Errors
/// The same as [`spearman_correlation`], and [`UndefinedStatistic::TooMany`] above 20,000 things.
pub fn kendall_tau(x: &[f64], y: &[f64]) -> Result<RankCorrelation, UndefinedStatistic> {
    let n = x.len();
    if n > MAX_CORRELATED_THINGS {
        return Err(UndefinedStatistic::TooMany);
    }
    let [x, y] = both_ranks(x, y)?;
    let (mut balance, mut discordant) = (0_i64, 0_usize);
    for i in 0..n {
        for j in 0..i {
            let order = |variable: &ValueRanks| variable.ranks[i].total_cmp(&variable.ranks[j]);
            match (order(&x), order(&y)) {
                (Ordering::Equal, _) | (_, Ordering::Equal) => {}
                (a, b) if a == b => balance += 1,
                _ => {
                    balance -= 1;
                    discordant += 1;
                }
            }
        }
    }
    let pairs = (n * (n - 1) / 2) as f64;
    let tied = |variable: &ValueRanks| sum_of_ties(variable, |t| t * (t - 1.0) / 2.0);
    let untied = ((pairs - tied(&x)) * (pairs - tied(&y))).sqrt();
    let distinct = x.ties.len() == n && y.ties.len() == n;
    let p = if distinct && n <= MAX_EXACT_KENDALL {
        inversions_p(n, discordant)
    } else {
        (2.0 * normal_tail_share((balance as f64).abs() / concordance_deviation(&x, &y))).min(1.0)
    };
    Ok(RankCorrelation {
        n,
        coefficient: (balance as f64 / untied).clamp(-1.0, 1.0),
        p: Some(p),
    })
}

fn both_ranks(x: &[f64], y: &[f64]) -> Result<[ValueRanks; 2], UndefinedStatistic> {
    if x.len() != y.len() {
        return Err(UndefinedStatistic::Unequal);
    }
    if x.len() < 2 {
        return Err(UndefinedStatistic::TooFew);
    }
    let both = [mid_ranks(x)?, mid_ranks(y)?];
    if both.iter().any(|variable| variable.ties.len() < 2) {
        return Err(UndefinedStatistic::NoSpread);
    }
    Ok(both)
}

fn sum_of_ties(ranks: &ValueRanks, of: impl Fn(f64) -> f64) -> f64 {
    ranks.ties.iter().map(|t| of(*t as f64)).sum()
}

/// Returns the standard deviation of concordant minus discordant pairs for independent measures with ties.
fn concordance_deviation(x: &ValueRanks, y: &ValueRanks) -> f64 {
    let n = x.ranks.len() as f64;
    let pairs = n * (n - 1.0);
    let sum = |of: fn(f64) -> f64| [x, y].map(|variable| sum_of_ties(variable, of));
    let [v1, w1] = sum(|t| t * (t - 1.0) * (2.0 * t + 5.0));
    let [v2, w2] = sum(|t| t * (t - 1.0) * (t - 2.0));
    let [v3, w3] = sum(|t| t * (t - 1.0) / 2.0);
    // The term of triples needs three things.
    let third = if n > 2.0 {
        v2 * w2 / (9.0 * pairs * (n - 2.0))
    } else {
        0.0
    };
    ((pairs * (2.0 * n + 5.0) - v1 - w1) / 18.0 + third + 2.0 * v3 * w3 / pairs).sqrt()
}

/// Returns the two-sided p of a number of discordant pairs among all orders of `n` things, which are equally likely.
fn inversions_p(n: usize, discordant: usize) -> f64 {
    let most = n * (n - 1) / 2;
    // `shares[k]`: the share of orders with `k` discordant pairs; a thing more adds 0 to `size - 1` of them.
    let mut shares = vec![0.0; most + 1];
    shares[0] = 1.0;
    for size in 2..=n {
        let mut next = vec![0.0; most + 1];
        let mut window = 0.0;
        for k in 0..=most {
            window += shares[k];
            if k >= size {
                window -= shares[k - size];
            }
            next[k] = window / size as f64;
        }
        shares = next;
    }
    let rarer = discordant.min(most - discordant);
    let tail: f64 = shares[..=rarer].iter().sum();
    (2.0 * tail).min(1.0)
}
