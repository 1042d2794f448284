//! Intervals of any statistic from resampled participants, and whether an effect is small enough to call it none.

use serde::{Deserialize, Serialize};

use super::{UndefinedStatistic, check_finite_values, normal_point, normal_tail_share, sorted_quantile};
use crate::random::RandomNumbers;

/// The rule by which resamples become an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ResampleIntervalRule {
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
pub struct ParticipantResamples {
    /// The statistic of all participants.
    pub estimate: f64,
    /// The statistic of each resample in which it has a value, in ascending order.
    pub values: Vec<f64>,
    /// The statistic without each participant in turn.
    pub jackknife: Vec<f64>,
    /// The number of resamples in which the statistic has no value.
    pub undefined: usize,
}

impl ParticipantResamples {
    /// Draws participants with replacement, all answers of a participant together, `times` times.
    ///
    /// `statistic` takes the numbers of the drawn participants, below `people`; a participant may come several times.
    /// The same seed gives the same resamples.
    ///
    /// # Errors
    /// [`UndefinedStatistic::TooFew`] for fewer than two participants; the reason of the statistic if it has no value for all
    /// participants.
    pub fn draw_participants(
        people: usize,
        times: usize,
        seed: u64,
        statistic: impl Fn(&[usize]) -> Result<f64, UndefinedStatistic>,
    ) -> Result<Self, UndefinedStatistic> {
        if people < 2 {
            return Err(UndefinedStatistic::TooFew);
        }
        let mut drawn: Vec<usize> = (0..people).collect();
        let estimate = statistic(&drawn)?;
        let mut random = RandomNumbers::new(seed);
        let mut values = Vec::with_capacity(times);
        for _ in 0..times {
            drawn.fill_with(|| random.random_below(people));
            values.extend(statistic(&drawn).ok());
        }
        values.sort_by(f64::total_cmp);
        let without = |left_out: usize| {
            let others: Vec<usize> = (0..people).filter(|person| *person != left_out).collect();
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
    /// [`UndefinedStatistic::TooFew`] without resamples, or if more than one in twenty has no value; [`UndefinedStatistic::NoSpread`]
    /// if [`ResampleIntervalRule::Bca`] finds all resamples on one side of the estimate, or no difference between the participants;
    /// [`UndefinedStatistic::OutOfRange`] for a level outside 0 to 1.
    pub fn resample_interval(&self, kind: ResampleIntervalRule, level: f64) -> Result<[f64; 2], UndefinedStatistic> {
        if self.values.is_empty() || self.undefined * 19 > self.values.len() {
            return Err(UndefinedStatistic::TooFew);
        }
        check_finite_values(&self.values)?;
        if !(level > 0.0 && level < 1.0) {
            return Err(UndefinedStatistic::OutOfRange);
        }
        let tails = [(1.0 - level) / 2.0, (1.0 + level) / 2.0];
        let [low, high] = match kind {
            ResampleIntervalRule::Bca => self.corrected_tail_shares(tails)?,
            ResampleIntervalRule::Percentile | ResampleIntervalRule::Basic => tails,
        };
        let ends = [
            sorted_quantile(&self.values, low)?,
            sorted_quantile(&self.values, high)?,
        ];
        Ok(match kind {
            ResampleIntervalRule::Basic => [2.0 * self.estimate - ends[1], 2.0 * self.estimate - ends[0]],
            ResampleIntervalRule::Percentile | ResampleIntervalRule::Bca => ends,
        })
    }

    /// Returns the shares between which BCa reads its interval: Efron 1987, equation 6.8.
    fn corrected_tail_shares(&self, tails: [f64; 2]) -> Result<[f64; 2], UndefinedStatistic> {
        let n = self.values.len() as f64;
        let below = self.values.partition_point(|value| *value < self.estimate) as f64;
        // Resamples that equal the estimate count by half on either side.
        let level = self.values.partition_point(|value| *value <= self.estimate) as f64 - below;
        let bias = normal_point((below + level / 2.0) / n).map_err(|_| UndefinedStatistic::NoSpread)?;
        let mean = self.jackknife.iter().sum::<f64>() / self.jackknife.len() as f64;
        let power = |p: i32| -> f64 { self.jackknife.iter().map(|value| (mean - value).powi(p)).sum() };
        let skew = power(3) / (6.0 * power(2).powf(1.5));
        if !skew.is_finite() {
            return Err(UndefinedStatistic::NoSpread);
        }
        let mut shares = [0.0; 2];
        for (share, tail) in shares.iter_mut().zip(tails) {
            let z = bias + normal_point(tail)?;
            *share = 1.0 - normal_tail_share(bias + z / (1.0 - skew * z));
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
/// [`UndefinedStatistic::TooFew`] for fewer than two things; [`UndefinedStatistic::NoSpread`] if no thing makes a difference;
/// [`UndefinedStatistic::NotANumber`]; [`UndefinedStatistic::OutOfRange`] for a level outside 0 to 1.
pub fn jackknife_interval(estimate: f64, without: &[f64], level: f64) -> Result<[f64; 2], UndefinedStatistic> {
    if without.len() < 2 {
        return Err(UndefinedStatistic::TooFew);
    }
    check_finite_values(without)?;
    check_finite_values(&[estimate])?;
    if !(level > 0.0 && level < 1.0) {
        return Err(UndefinedStatistic::OutOfRange);
    }
    if without.iter().all(|value| *value == without[0]) {
        return Err(UndefinedStatistic::NoSpread);
    }
    let n = without.len() as f64;
    let mean = without.iter().sum::<f64>() / n;
    let squares: f64 = without.iter().map(|value| (value - mean).powi(2)).sum();
    let half = normal_point((1.0 + level) / 2.0)? * ((n - 1.0) / n * squares).sqrt();
    Ok([estimate - half, estimate + half])
}

/// The conclusion about an effect whose smallest interesting size was stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EquivalenceConclusion {
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
/// [`UndefinedStatistic::OutOfRange`] if the bound is not a positive number.
pub fn conclude_equivalence(interval: [f64; 2], bound: f64) -> Result<EquivalenceConclusion, UndefinedStatistic> {
    if !(bound > 0.0 && bound.is_finite()) {
        return Err(UndefinedStatistic::OutOfRange);
    }
    let [low, high] = interval;
    Ok(if low > -bound && high < bound {
        EquivalenceConclusion::Equivalent
    } else if low >= bound || high <= -bound {
        EquivalenceConclusion::Relevant
    } else {
        EquivalenceConclusion::Undecided
    })
}
