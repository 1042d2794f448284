//! Shares of right answers: their intervals, and tests of two of them.

use serde::{Deserialize, Serialize};

use super::{UndefinedStatistic, normal_point};

/// The most answers that a table may count.
const MAX_TABLE_ANSWERS: u64 = 1 << 20;

/// Returns Wilson's interval of the share `hits` of `n` at a level such as 0.95.
///
/// # Errors
/// [`UndefinedStatistic::Empty`] for `n = 0`; [`UndefinedStatistic::OutOfRange`] for more hits than answers or a level outside 0 to 1.
pub fn wilson_interval(hits: u64, n: u64, level: f64) -> Result<[f64; 2], UndefinedStatistic> {
    if n == 0 {
        return Err(UndefinedStatistic::Empty);
    }
    if hits > n || !(level > 0.0 && level < 1.0) {
        return Err(UndefinedStatistic::OutOfRange);
    }
    let z = normal_point(0.5 + level / 2.0)?;
    let (share, n) = (hits as f64 / n as f64, n as f64);
    let shrunk = 1.0 + z * z / n;
    let middle = (share + z * z / (2.0 * n)) / shrunk;
    let half = z / shrunk * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    // At the ends the formula gives 0 and 1 but for rounding.
    let low = if share == 0.0 { 0.0 } else { middle - half };
    let high = if share == 1.0 { 1.0 } else { middle + half };
    Ok([low.max(0.0), high.min(1.0)])
}

/// The result of Fisher's exact test.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FisherResult {
    /// The odds ratio of the sample; nothing if it is infinite or both of its products are 0.
    pub odds_ratio: Option<f64>,
    /// The two-sided p: of all tables with the same margins, those that are at most as likely.
    pub p: f64,
}

/// Tests whether two shares of different people differ: one row a group, hits and misses.
///
/// # Errors
/// [`UndefinedStatistic::Empty`] if a row or a column is empty; [`UndefinedStatistic::TooMany`] above a million answers.
pub fn fisher_exact_test(table: [[u64; 2]; 2]) -> Result<FisherResult, UndefinedStatistic> {
    let [[a, b], [c, d]] = table;
    let checked_sum = [a, b, c, d].into_iter().try_fold(0_u64, u64::checked_add);
    let all = checked_sum
        .filter(|all| *all <= MAX_TABLE_ANSWERS)
        .ok_or(UndefinedStatistic::TooMany)?;
    let (row, column) = (a + b, a + c);
    if row == 0 || c + d == 0 || column == 0 || b + d == 0 {
        return Err(UndefinedStatistic::Empty);
    }
    let (low, high) = (row.saturating_sub(b + d), row.min(column));
    // The hypergeometric weight of the next table over that of this one.
    let ratio = |x: u64| {
        let (up, down) = ((row - x) * (column - x), (x + 1) * (all + x + 1 - row - column));
        up as f64 / down as f64
    };
    let weights = relative_weights(low, high, ratio);
    let observed = weights[(a - low) as usize];
    // Tables that are as likely may differ from the observed one by rounding.
    let unlikely = weights.iter().filter(|weight| **weight <= observed * (1.0 + 1e-9));
    let p = unlikely.sum::<f64>() / weights.iter().sum::<f64>();
    let (num, den) = (a as f64 * d as f64, b as f64 * c as f64);
    Ok(FisherResult {
        odds_ratio: (den > 0.0).then(|| num / den),
        p: p.min(1.0),
    })
}

/// Returns p of McNemar's exact test: of people who answered both, `b` were right the first time only, `c` the second.
///
/// # Errors
/// [`UndefinedStatistic::TooMany`] above a million answers.
pub fn mcnemar_exact_test(b: u64, c: u64) -> Result<f64, UndefinedStatistic> {
    let discordant_count = b.checked_add(c).filter(|n| *n <= MAX_TABLE_ANSWERS);
    let n = discordant_count.ok_or(UndefinedStatistic::TooMany)?;
    let weights = relative_weights(0, n, |k| (n - k) as f64 / (k + 1) as f64);
    let all: f64 = weights.iter().sum();
    let tail: f64 = weights[..=b.min(c) as usize].iter().sum();
    Ok((2.0 * tail / all).min(1.0))
}

/// Returns the weights of `low..=high` relative to the greatest, from the ratio of each weight to the one before.
fn relative_weights(low: u64, high: u64, ratio: impl Fn(u64) -> f64) -> Vec<f64> {
    // From the greatest weight outwards, so that nothing overflows.
    let mode = (low..high).find(|x| ratio(*x) < 1.0).unwrap_or(high);
    let mut weights = vec![1.0; (high - low + 1) as usize];
    for x in (low..mode).rev() {
        weights[(x - low) as usize] = weights[(x - low + 1) as usize] / ratio(x);
    }
    for x in mode..high {
        weights[(x - low + 1) as usize] = weights[(x - low) as usize] * ratio(x);
    }
    weights
}
