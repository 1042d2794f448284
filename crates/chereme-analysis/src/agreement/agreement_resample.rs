//! Percentile intervals by the bootstrap (Efron 1979), from a seed.

use crate::random::RandomNumbers;
use crate::statistics::sorted_quantile;

/// An interval that holds 95 of 100 draws.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct BootstrapInterval {
    /// The 2.5th percentile.
    pub low: f64,
    /// The 97.5th percentile.
    pub high: f64,
    /// The number of draws for which the figure is defined.
    pub draws: usize,
}

impl BootstrapInterval {
    /// Returns the percentiles of draws; `None` if fewer than two are given.
    #[must_use]
    pub fn from_bootstrap_draws(mut draws: Vec<f64>) -> Option<Self> {
        draws.retain(|draw| draw.is_finite());
        draws.sort_by(f64::total_cmp);
        let [low, high] = [0.025, 0.975].map(|level| sorted_quantile(&draws, level).ok());
        (draws.len() > 1).then_some(Self {
            low: low?,
            high: high?,
            draws: draws.len(),
        })
    }
}

/// Draws `count` of `count` things with replacement, `draws` times, and hands the places of the drawn ones to `each`.
pub fn draw_bootstrap_samples(count: usize, draws: usize, seed: u64, mut each: impl FnMut(&[usize])) {
    let mut random = RandomNumbers::new(seed);
    let mut drawn = vec![0; count];
    for _ in 0..draws {
        drawn.iter_mut().for_each(|index| *index = random.random_below(count));
        each(&drawn);
    }
}
