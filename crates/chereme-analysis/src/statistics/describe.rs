//! Ranks and descriptions of one group of values.

use serde::{Deserialize, Serialize};

use super::{UndefinedStatistic, check_finite_values};

/// The ranks of values, counted from 1; equal values share the mean of their ranks.
#[derive(Debug, Clone, PartialEq)]
pub struct ValueRanks {
    /// The rank of each value, in the order of the values.
    pub ranks: Vec<f64>,
    /// The sizes of groups of equal values, from the lowest value to the highest; a single value counts 1.
    pub ties: Vec<usize>,
}

impl ValueRanks {
    /// Returns the sum of t³ - t over groups of t equal values, by which variances are corrected.
    #[must_use]
    pub fn tie_term(&self) -> f64 {
        let cube = |t: &usize| {
            let t = *t as f64;
            t * t * t - t
        };
        self.ties.iter().map(cube).sum()
    }
}

/// Returns the mid-ranks of values.
///
/// # Errors
/// [`UndefinedStatistic::Empty`], [`UndefinedStatistic::NotANumber`].
pub fn mid_ranks(values: &[f64]) -> Result<ValueRanks, UndefinedStatistic> {
    check_finite_values(values)?;
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut ties = Vec::new();
    // `==` also joins 0 and -0, which `total_cmp` puts next to each other.
    for tied in order.chunk_by(|a, b| values[*a] == values[*b]) {
        let before: usize = ties.iter().sum();
        let rank = before as f64 + (tied.len() as f64 + 1.0) / 2.0;
        for own in tied {
            ranks[*own] = rank;
        }
        ties.push(tied.len());
    }
    Ok(ValueRanks { ranks, ties })
}

/// Returns the value below which the share `level` of sorted values lies: quartiles of type 7, as in R and numpy.
///
/// # Errors
/// [`UndefinedStatistic::Empty`], [`UndefinedStatistic::OutOfRange`] if `level` does not lie in 0 to 1.
pub fn sorted_quantile(sorted: &[f64], level: f64) -> Result<f64, UndefinedStatistic> {
    let last = sorted.len().checked_sub(1).ok_or(UndefinedStatistic::Empty)?;
    if !(0.0..=1.0).contains(&level) {
        return Err(UndefinedStatistic::OutOfRange);
    }
    let position = last as f64 * level;
    let (low, high) = (position.floor() as usize, position.ceil() as usize);
    Ok(sorted[low] + (position - low as f64) * (sorted[high] - sorted[low]))
}

/// A description of one group, as a box plot shows it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GroupDescription {
    /// The number of values.
    pub n: usize,
    /// The mean.
    pub mean: f64,
    /// The standard deviation of the sample (divided by n - 1); nothing for one value.
    pub sd: Option<f64>,
    /// The lower quartile (type 7).
    pub q1: f64,
    /// The median.
    pub median: f64,
    /// The upper quartile (type 7).
    pub q3: f64,
    /// The lowest value that is at most 1.5 interquartile ranges below the lower quartile.
    pub whisker_low: f64,
    /// The highest value that is at most 1.5 interquartile ranges above the upper quartile.
    pub whisker_high: f64,
    /// The values beyond the whiskers, in order.
    pub outliers: Vec<f64>,
}

impl GroupDescription {
    /// Describes values.
    ///
    /// # Errors
    /// [`UndefinedStatistic::Empty`], [`UndefinedStatistic::NotANumber`].
    pub fn describe_values(values: &[f64]) -> Result<Self, UndefinedStatistic> {
        check_finite_values(values)?;
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let n = sorted.len();
        let mean = sorted.iter().sum::<f64>() / n as f64;
        let squares: f64 = sorted.iter().map(|x| (x - mean).powi(2)).sum();
        let (q1, q3) = (sorted_quantile(&sorted, 0.25)?, sorted_quantile(&sorted, 0.75)?);
        let fence = 1.5 * (q3 - q1);
        let inside = |x: &f64| (q1 - fence..=q3 + fence).contains(x);
        let mut kept = sorted.iter().copied().filter(inside);
        let whisker_low = kept.next().unwrap_or(q1);
        Ok(Self {
            n,
            mean,
            sd: (n > 1).then(|| (squares / (n as f64 - 1.0)).sqrt()),
            q1,
            median: sorted_quantile(&sorted, 0.5)?,
            q3,
            whisker_low,
            whisker_high: kept.next_back().unwrap_or(whisker_low),
            outliers: sorted.iter().copied().filter(|x| !inside(x)).collect(),
        })
    }
}
