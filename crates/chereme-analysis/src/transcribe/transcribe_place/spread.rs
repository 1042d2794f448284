//! Distributions of the distance between hands and their intended places.

use glam::DVec3;

use super::super::transcribe_scene::SignerScene;
use crate::transcribe::transcribe_tuned::tuned;

/// The kinds of hands that touch nothing, with displacements of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FreeHandKind {
    /// A hand before the trunk.
    Trunk,
    /// A hand before the head.
    Head,
    /// The point between two hands, which keep clear of each other.
    Between,
}

/// The thing that a hand touches or should touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum TouchedThing {
    Trunk,
    /// The head or an arm.
    Other,
    /// The other hand.
    Hand,
}

/// Distributions of a hand's offset from its intended place, as mixtures of normal distributions.
#[derive(Clone)]
pub(super) struct HandOffsetSpread {
    /// Standard deviation about the place, in metres.
    about: f64,
    arm: f64,
}

impl HandOffsetSpread {
    pub(super) fn spread_from_scene(scene: &SignerScene<'_>) -> Self {
        Self {
            about: scene.slack,
            arm: scene.arm,
        }
    }

    /// Returns the penalty (nepers) of a hand before a place at the offset `off` (left, up, forward;
    /// metres), against a hand exactly there. With `far`, the arm should reach far and may fall short.
    pub(super) fn free_hand_penalty(&self, off: DVec3, of: FreeHandKind, far: bool) -> f64 {
        let of = of as usize;
        let [side, up, down, forward, back] = tuned().spread.room[of];
        let room = DVec3::new(
            side,
            if off.y < 0.0 { down } else { up },
            if off.z < 0.0 { back } else { forward },
        );
        let reach = if far { tuned().spread.short } else { 1.0 };
        let room = room.map(|by| reach * (by * self.arm).hypot(self.about));
        let anywhere = DVec3::splat(tuned().spread.anywhere[of] * self.arm);
        self.mixture_offset_penalty(
            tuned().spread.free[of],
            [normal_offset_density(off, room), normal_offset_density(off, anywhere)],
            off,
        )
    }

    /// Like [`free`](Self::free), for a hand that touches a place with the outward normal `out`. Hands
    /// that would be in the trunk are pushed out of it.
    pub(super) fn touching_hand_penalty(&self, off: DVec3, out: DVec3, trunk: bool) -> f64 {
        let [of_trunk, of_other] = tuned().spread.touching;
        if !trunk {
            return self.touched_offset_penalty(of_other, off, TouchedThing::Other);
        }
        let missed = self.missed_touch_deviation(TouchedThing::Trunk);
        let far = off.dot(out);
        let aside = off - out * far;
        let mean = tuned().spread.pushed * self.arm;
        // The farther a hand is pushed, the farther it may slide aside.
        let slides = missed.hypot(tuned().spread.slides * far.max(0.0));
        let flat =
            (-0.5 * aside.length_squared() / (slides * slides)).exp() / (std::f64::consts::TAU * slides * slides);
        // Outwards the distance is exponential, as the trunk pushes hands; inwards it is normal.
        let ahead = if far > 0.0 {
            -far / mean
        } else {
            -0.5 * (far / missed).powi(2)
        };
        let pushed = flat * ahead.exp() / mean;
        let astray = normal_offset_density(off, self.astray(TouchedThing::Trunk));
        self.mixture_offset_penalty(of_trunk, [pushed, astray], off)
    }

    /// Like [`free`](Self::free), for a hand that should be at the other hand.
    pub(super) fn joined_hands_penalty(&self, off: DVec3) -> f64 {
        self.touched_offset_penalty(tuned().spread.shares, off, TouchedThing::Hand)
    }

    fn touched_offset_penalty(&self, shares: [f64; 3], off: DVec3, of: TouchedThing) -> f64 {
        let missed = normal_offset_density(off, DVec3::splat(self.missed_touch_deviation(of)));
        self.mixture_offset_penalty(shares, [missed, normal_offset_density(off, self.astray(of))], off)
    }

    /// Returns the standard deviation (m) of a hand that should touch something but misses it.
    fn missed_touch_deviation(&self, of: TouchedThing) -> f64 {
        tuned().spread.missed[of as usize] * self.arm + self.about
    }

    /// Returns the standard deviations (m) of a hand that should touch something but may be anywhere.
    fn astray(&self, of: TouchedThing) -> DVec3 {
        DVec3::splat(tuned().spread.astray[of as usize] * self.arm)
    }

    fn mixture_offset_penalty(&self, shares: [f64; 3], [some, any]: [f64; 2], off: DVec3) -> f64 {
        let about = DVec3::splat(self.about);
        let exact = DVec3::splat(self.about * (self.about / tuned().spread.exact).min(1.0));
        let core = |off: DVec3| 0.8 * normal_offset_density(off, exact) + 0.2 * normal_offset_density(off, about);
        let likelihood = shares[0] * core(off) + shares[1] * some + shares[2] * any;
        (tuned().spread.shares[0] * core(DVec3::ZERO) / likelihood.max(f64::MIN_POSITIVE)).ln()
    }
}

/// Returns the density (per cubic metre) of a normal distribution with these standard deviations along the
/// axes.
fn normal_offset_density(off: DVec3, wide: DVec3) -> f64 {
    let root = std::f64::consts::TAU.sqrt();
    (-0.5 * (off / wide).length_squared()).exp() / (root.powi(3) * wide.x * wide.y * wide.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(about: f64) -> HandOffsetSpread {
        HandOffsetSpread { about, arm: 0.55 }
    }

    #[test]
    fn penalties_grow_with_distance_up_to_a_bound() {
        for about in [0.004, 0.02] {
            let spread = spread(about);
            for direction in [DVec3::X, DVec3::Y, DVec3::NEG_Z] {
                let at = |n: i32| direction * (0.01 * f64::from(n));
                let all: Vec<Vec<f64>> = (0..12)
                    .map(|n| {
                        let off = at(n);
                        let touch = spread.touching_hand_penalty(off, DVec3::Z, false);
                        let free = [FreeHandKind::Trunk, FreeHandKind::Head, FreeHandKind::Between];
                        let free = free.map(|of| spread.free_hand_penalty(off, of, false));
                        [free.as_slice(), &[touch, spread.joined_hands_penalty(off)]].concat()
                    })
                    .collect();
                for (n, pair) in all.windows(2).enumerate() {
                    let farther = pair[0].iter().zip(&pair[1]).all(|(a, b)| a < b);
                    assert!(farther, "{about} {direction} {n}: {pair:?}");
                }
                assert!(all[0].iter().all(|it| it.abs() < 0.3));
                assert!(spread.free_hand_penalty(direction * 0.15, FreeHandKind::Trunk, false) < 20.0);
            }
        }
    }

    #[test]
    fn shifts_out_of_the_trunk_and_forward_cost_less_than_shifts_aside_and_up() {
        let spread = spread(0.004);
        let touch = |off: DVec3| spread.touching_hand_penalty(off, DVec3::Z, true);
        assert!(touch(DVec3::Z * 0.06) + 1.0 < touch(DVec3::X * 0.06));
        assert!(touch(DVec3::Z * 0.06) + 1.0 < touch(DVec3::NEG_Z * 0.06));
        let free = |off: DVec3| spread.free_hand_penalty(off, FreeHandKind::Trunk, false);
        assert!(free(DVec3::Z * 0.03) + 2.0 < free(DVec3::Y * 0.03));
        assert!(spread.free_hand_penalty(DVec3::Y * 0.04, FreeHandKind::Trunk, true) < free(DVec3::Y * 0.04));
    }
}
