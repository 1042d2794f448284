//! Small slow movement without a pattern; a seed gives the same movement on every machine.

/// A smooth function of time between about -1 and 1.
#[derive(Clone, Debug)]
pub(crate) struct Noise([[f64; 3]; 4]);

impl Noise {
    /// Returns the noise of a seed and a channel; its slowest wave takes about 4 s, its fastest 0.8 s.
    pub(crate) fn new(seed: u64, channel: u64) -> Self {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ channel.wrapping_mul(0xD1B5_4A32_D192_ED03);
        let mut dice = || {
            state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = state;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        };
        Self([0.25, 0.45, 0.8, 1.25].map(|pace| {
            let pace = pace * (0.85 + 0.3 * dice());
            [
                pace * std::f64::consts::TAU,
                dice() * std::f64::consts::TAU,
                0.35 / pace.sqrt(),
            ]
        }))
    }

    /// Returns the value at `time` seconds.
    pub(crate) fn at(&self, time: f64) -> f64 {
        self.0
            .iter()
            .map(|[pace, phase, size]| size * (pace * time + phase).sin())
            .sum()
    }
}
