//! Percentile intervals by the bootstrap (Efron 1979), from a seed.

use crate::random::Random;

/// An interval that holds 95 of 100 draws.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Interval {
    /// The 2.5th percentile.
    pub low: f64,
    /// The 97.5th percentile.
    pub high: f64,
    /// The number of draws for which the figure is defined.
    pub draws: usize,
}

impl Interval {
    /// Returns the percentiles of draws; `None` if fewer than two are given.
    #[must_use]
    pub fn of(mut draws: Vec<f64>) -> Option<Self> {
        draws.retain(|it| it.is_finite());
        draws.sort_by(f64::total_cmp);
        (draws.len() > 1).then(|| Self {
            low: quantile(&draws, 0.025),
            high: quantile(&draws, 0.975),
            draws: draws.len(),
        })
    }
}

/// Returns a quantile of sorted numbers, linear between two of them; 0 if there are no numbers.
#[must_use]
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return 0.0;
    };
    let at = share.clamp(0.0, 1.0) * last as f64;
    let (low, part) = (at.floor() as usize, at.fract());
    let high = (low + 1).min(last);
    sorted[low] + (sorted[high] - sorted[low]) * part
}

/// Draws `count` of `count` things with replacement, `draws` times, and hands the places of the drawn ones to `each`.
pub fn bootstrap(count: usize, draws: usize, seed: u64, mut each: impl FnMut(&[usize])) {
    let mut random = Random::new(seed);
    let mut drawn = vec![0; count];
    for _ in 0..draws {
        drawn.iter_mut().for_each(|it| *it = random.below(count));
        each(&drawn);
    }
}
