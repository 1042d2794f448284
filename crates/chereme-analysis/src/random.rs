//! Random numbers from a seed.

#[cfg(any(test, feature = "testing"))]
use glam::DVec3;

/// Random numbers that are the same on every machine (SplitMix64).
#[derive(Debug, Clone)]
pub struct RandomNumbers(u64);

impl RandomNumbers {
    /// Returns the generator for a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns 64 random bits.
    pub(crate) fn random_bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Returns a random number from 0 to 1.
    pub fn random_share(&mut self) -> f64 {
        (self.random_bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a random number with a standard normal distribution.
    pub fn random_normal(&mut self) -> f64 {
        let (a, b) = (self.random_share().max(1e-300), self.random_share());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }

    /// Returns a random whole number below `end`, which must not be 0.
    pub fn random_below(&mut self, end: usize) -> usize {
        ((self.random_share() * end as f64) as usize).min(end.saturating_sub(1))
    }

    /// Returns a vector of three normal numbers with this standard deviation.
    #[cfg(any(test, feature = "testing"))]
    pub(crate) fn random_normal_vector(&mut self, sd: f64) -> DVec3 {
        DVec3::new(self.random_normal(), self.random_normal(), self.random_normal()) * sd
    }
}
