//! Percentile intervals by the bootstrap (Efron 1979), from a seed.

use crate::random::Random;
use crate::statistics::quantile;

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
        let [low, high] = [0.025, 0.975].map(|level| quantile(&draws, level).ok());
        (draws.len() > 1).then_some(Self {
            low: low?,
            high: high?,
            draws: draws.len(),
        })
    }
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
