//! Intervals of any statistic from resampled participants, and whether an effect is small enough to call it none.

use serde::{Deserialize, Serialize};

use super::{Undefined, above, checked, normal_point, quantile};
use crate::random::Random;

/// The rule by which resamples become an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Interval {
    /// The quantiles of the resamples.
    Percentile,
    /// The quantiles, mirrored at the estimate.
    Basic,
    /// The quantiles, corrected for bias and skew (Efron 1987).
    #[default]
    Bca,
}

/// A statistic of resampled participants.
#[derive(Debug, Clone, PartialEq)]
pub struct Resamples {
    /// The statistic of all participants.
    pub estimate: f64,
    /// The statistic of each resample in which it has a value, in ascending order.
    pub values: Vec<f64>,
    /// The statistic without each participant in turn.
    pub jackknife: Vec<f64>,
    /// The number of resamples in which the statistic has no value.
    pub undefined: usize,
}

impl Resamples {
    /// Draws participants with replacement, all answers of a participant together, `times` times.
    ///
    /// `statistic` takes the numbers of the drawn participants, below `people`; a participant may come several times.
    /// The same seed gives the same resamples.
    ///
    /// # Errors
    /// [`Undefined::TooFew`] for fewer than two participants; the reason of the statistic if it has no value for all
    /// participants.
    pub fn draw(
        people: usize,
        times: usize,
        seed: u64,
        statistic: impl Fn(&[usize]) -> Result<f64, Undefined>,
    ) -> Result<Self, Undefined> {
        if people < 2 {
            return Err(Undefined::TooFew);
        }
        let mut drawn: Vec<usize> = (0..people).collect();
        let estimate = statistic(&drawn)?;
        let mut random = Random::new(seed);
        let mut values = Vec::with_capacity(times);
        for _ in 0..times {
            drawn.fill_with(|| random.below(people));
            values.extend(statistic(&drawn).ok());
        }
        values.sort_by(f64::total_cmp);
        let without = |left_out: usize| {
            let others: Vec<usize> = (0..people).filter(|it| *it != left_out).collect();
            statistic(&others).ok()
        };
        Ok(Self {
            estimate,
            undefined: times - values.len(),
            values,
            jackknife: (0..people).filter_map(without).collect(),
        })
    }

    /// Returns the interval of the statistic at a level such as 0.95.
    ///
    /// # Errors
    /// [`Undefined::TooFew`] without resamples, or if more than one in twenty has no value; [`Undefined::NoSpread`]
    /// if [`Interval::Bca`] finds all resamples on one side of the estimate, or no difference between the participants;
    /// [`Undefined::OutOfRange`] for a level outside 0 to 1.
    pub fn interval(&self, kind: Interval, level: f64) -> Result<[f64; 2], Undefined> {
        if self.values.is_empty() || self.undefined * 19 > self.values.len() {
            return Err(Undefined::TooFew);
        }
        checked(&self.values)?;
        if !(level > 0.0 && level < 1.0) {
            return Err(Undefined::OutOfRange);
        }
        let tails = [(1.0 - level) / 2.0, (1.0 + level) / 2.0];
        let [low, high] = match kind {
            Interval::Bca => self.corrected(tails)?,
            Interval::Percentile | Interval::Basic => tails,
        };
        let ends = [quantile(&self.values, low)?, quantile(&self.values, high)?];
        Ok(match kind {
            Interval::Basic => [2.0 * self.estimate - ends[1], 2.0 * self.estimate - ends[0]],
            Interval::Percentile | Interval::Bca => ends,
        })
    }

    /// Returns the shares between which BCa reads its interval: Efron 1987, equation 6.8.
    fn corrected(&self, tails: [f64; 2]) -> Result<[f64; 2], Undefined> {
        let n = self.values.len() as f64;
        let below = self.values.partition_point(|it| *it < self.estimate) as f64;
        let level = self.values.partition_point(|it| *it <= self.estimate) as f64 - below;
        let bias = normal_point((below + level / 2.0) / n).map_err(|_| Undefined::NoSpread)?;
        let mean = self.jackknife.iter().sum::<f64>() / self.jackknife.len() as f64;
        let power = |p: i32| -> f64 { self.jackknife.iter().map(|it| (mean - it).powi(p)).sum() };
        let skew = power(3) / (6.0 * power(2).powf(1.5));
        if !skew.is_finite() {
            return Err(Undefined::NoSpread);
        }
        let mut shares = [0.0; 2];
        for (share, tail) in shares.iter_mut().zip(tails) {
            let z = bias + normal_point(tail)?;
            *share = 1.0 - above(bias + z / (1.0 - skew * z));
        }
        Ok(shares)
    }
}

/// Returns the interval of a statistic by the jackknife: the estimate, less and more its standard error times the normal point.
///
/// `without` has the statistic without each thing in turn. The variance is that of Tukey 1958; on average it is not too
/// small, whatever the statistic (Efron and Stein 1981).
///
/// # Errors
/// [`Undefined::TooFew`] for fewer than two things; [`Undefined::NoSpread`] if no thing makes a difference;
/// [`Undefined::NotANumber`]; [`Undefined::OutOfRange`] for a level outside 0 to 1.
pub fn jackknife(estimate: f64, without: &[f64], level: f64) -> Result<[f64; 2], Undefined> {
    if without.len() < 2 {
        return Err(Undefined::TooFew);
    }
    checked(without)?;
    checked(&[estimate])?;
    if !(level > 0.0 && level < 1.0) {
        return Err(Undefined::OutOfRange);
    }
    if without.iter().all(|it| *it == without[0]) {
        return Err(Undefined::NoSpread);
    }
    let n = without.len() as f64;
    let mean = without.iter().sum::<f64>() / n;
    let squares: f64 = without.iter().map(|it| (it - mean).powi(2)).sum();
    let half = normal_point((1.0 + level) / 2.0)? * ((n - 1.0) / n * squares).sqrt();
    Ok([estimate - half, estimate + half])
}

/// The conclusion about an effect whose smallest interesting size was stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Equivalence {
    /// The interval lies within the bounds: whatever difference there is, it is smaller.
    Equivalent,
    /// The interval lies beyond a bound: the difference is at least that large.
    Relevant,
    /// The interval contains a bound: the answers do not decide.
    Undecided,
}

/// Compares an interval with the bounds -`bound` and `bound`.
///
/// An interval of level 1 - 2α makes this the two one-sided tests at α (Schuirmann 1987).
///
/// # Errors
/// [`Undefined::OutOfRange`] if the bound is not a positive number.
pub fn equivalence(interval: [f64; 2], bound: f64) -> Result<Equivalence, Undefined> {
    if !(bound > 0.0 && bound.is_finite()) {
        return Err(Undefined::OutOfRange);
    }
    let [low, high] = interval;
    Ok(if low > -bound && high < bound {
        Equivalence::Equivalent
    } else if low >= bound || high <= -bound {
        Equivalence::Relevant
    } else {
        Equivalence::Undecided
    })
}
