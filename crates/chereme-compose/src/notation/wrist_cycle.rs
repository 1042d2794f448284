//! Movement to and fro about the wrist: nodding, swinging, twisting, stirring.

use std::f64::consts::TAU;

use chereme_motion::glam::{DQuat, DVec3};

/// A movement to and fro about the wrist.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WristCycle {
    /// Two rotation vectors (rad) in the hand's space, a quarter of a cycle apart: the hand's farthest turns to one side.
    pub(crate) axes: [DVec3; 2],
    /// The number of cycles.
    pub(crate) cycles: f64,
    /// Whether the hand turns from its posture to one side only and back, instead of to both sides: it leaves the skin
    /// that it touches, and returns.
    pub(crate) one_sided: bool,
}

impl WristCycle {
    /// Returns the hand's rotation in its own space after a share of the movement's time; it begins and ends softly.
    pub(crate) fn wrist_cycle_rotation(&self, share: f64) -> DQuat {
        let turn = TAU * self.cycles * share;
        let linear_ends = (share.min(1.0 - share) * self.cycles * 4.0).clamp(0.0, 1.0);
        let ends = linear_ends * linear_ends * (3.0 - 2.0 * linear_ends);
        let about = match self.one_sided {
            true => self.axes[0] * (0.5 - 0.5 * turn.cos()),
            false => self.axes[0] * turn.sin() + self.axes[1] * turn.cos(),
        };
        DQuat::from_scaled_axis(about * ends)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hand_turns_to_both_sides_or_to_one() {
        let axes = [DVec3::X * 0.4, DVec3::ZERO];
        let both = WristCycle {
            axes,
            cycles: 2.0,
            one_sided: false,
        };
        let one = WristCycle {
            one_sided: true,
            ..both
        };
        let angle = |cycle: &WristCycle, share: f64| cycle.wrist_cycle_rotation(share).to_scaled_axis().x;
        for (share, sides, side) in [
            (0.0, 0.0, 0.0),
            (0.125, 0.4, 0.2),
            (0.25, 0.0, 0.4),
            (0.375, -0.4, 0.2),
            (0.5, 0.0, 0.0),
            (0.75, 0.0, 0.4),
            (1.0, 0.0, 0.0),
        ] {
            let [found, alone] = [&both, &one].map(|cycle| angle(cycle, share));
            assert!((found - sides).abs() < 1e-9, "{found} at {share}");
            assert!((alone - side).abs() < 1e-9, "{alone} at {share}, one-sided");
        }
        let least = (0..=100).map(|n| angle(&one, f64::from(n) / 100.0));
        assert!(least.fold(f64::INFINITY, f64::min) > -1e-12);
    }
}
