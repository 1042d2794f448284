//! Interpolation between two rotations, after Naert, Larboulette & Gibet 2021, section 4.2.

use glam::DQuat;
use serde::{Deserialize, Serialize};

/// The course of an interpolation as its weight goes from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum InterpolationKind {
    /// Spherical linear interpolation (eq. 1): constant angular speed.
    Slerp,
    /// The blend `(1 - c)·a + c·b` with `c = (1 - cos πw)/2` (eq. 2).
    Cosine,
    /// The blend of eq. 3 with `s = 1/(1 + exp(-10(w - 0.5)))`. As printed, s goes from 0.0067 to 0.9933; here it is
    /// scaled to go from 0 to 1, so that both ends are reached.
    #[default]
    Sigmoid,
    /// The blend with `10w³ - 15w⁴ + 6w⁵`: the point-to-point path of least jerk (Flash & Hogan
    /// 1985), at rest at both ends.
    MinimumJerk,
}

impl InterpolationKind {
    /// Returns the share of the path that is done at weight `w`, which is clamped to 0..=1; it is 0 at 0, ½ at ½ and 1
    /// at 1, and never decreases.
    #[must_use]
    pub fn interpolation_share(self, w: f64) -> f64 {
        let w = w.clamp(0.0, 1.0);
        match self {
            Self::Slerp => w,
            Self::Cosine => (1.0 - (std::f64::consts::PI * w).cos()) / 2.0,
            Self::Sigmoid => {
                // As printed the sigmoid misses both ends by 0.0067, so it is stretched to reach them.
                let printed = |w: f64| 1.0 / (1.0 + (-10.0 * (w - 0.5)).exp());
                let (low, high) = (printed(0.0), printed(1.0));
                (printed(w) - low) / (high - low)
            }
            Self::MinimumJerk => w * w * w * (10.0 + w * (6.0 * w - 15.0)),
        }
    }

    /// Returns the rotation at weight `w` from `a` to `b`, along the shorter path.
    ///
    /// [`Slerp`](Self::Slerp) follows the great circle; the others are normalised linear blends, like the paper's
    /// equations 2 and 3.
    #[must_use]
    pub fn interpolate_rotation(self, a: DQuat, b: DQuat, w: f64) -> DQuat {
        match self {
            Self::Slerp => a.slerp(b, w.clamp(0.0, 1.0)),
            _ => {
                let share = self.interpolation_share(w);
                // Both signs are the same rotation: the one on the near side gives the shorter path.
                let near = if a.dot(b) < 0.0 { -b } else { b };
                (a * (1.0 - share) + near * share).normalize()
            }
        }
    }
}

/// Returns a smooth share from 0 to 1 whose slope is 0 at both ends (Hermite's cubic); shares outside count as the ends.
#[must_use]
pub fn smooth_step(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const EVERY_KIND: [InterpolationKind; 4] = [
        InterpolationKind::Slerp,
        InterpolationKind::Cosine,
        InterpolationKind::Sigmoid,
        InterpolationKind::MinimumJerk,
    ];

    #[test]
    fn speed_profiles_equal_their_end_points_and_published_values() {
        for interpolation in EVERY_KIND {
            assert_eq!(interpolation.interpolation_share(0.0), 0.0, "{interpolation:?}");
            assert_eq!(interpolation.interpolation_share(1.0), 1.0, "{interpolation:?}");
            assert!(
                (interpolation.interpolation_share(0.5) - 0.5).abs() < 1e-12,
                "{interpolation:?}"
            );
        }
        let printed = |w: f64| 1.0 / (1.0 + (-10.0 * (w - 0.5f64)).exp());
        assert!((printed(0.0) - 0.0067).abs() < 5e-5 && (printed(1.0) - 0.9933).abs() < 5e-5);
        let back =
            |w: f64| InterpolationKind::Sigmoid.interpolation_share(w) * (printed(1.0) - printed(0.0)) + printed(0.0);
        assert!((back(0.3) - printed(0.3)).abs() < 1e-12);
    }

    #[test]
    fn minimum_jerk_peaks_at_fifteen_eighths_of_the_mean_speed() {
        let h = 1e-6;
        let interpolation = InterpolationKind::MinimumJerk;
        let speed =
            (interpolation.interpolation_share(0.5 + h) - interpolation.interpolation_share(0.5 - h)) / (2.0 * h);
        assert!((speed - 1.875).abs() < 1e-6);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn interpolated_rotations_stay_normalised_on_the_arc_and_are_symmetric(
            axis in proptest::array::uniform3(-1.0f64..1.0), angle in 0.01f64..3.0, w in 0.0f64..1.0
        ) {
            let axis = glam::DVec3::from(axis);
            prop_assume!(axis.length() > 0.1);
            let a = DQuat::from_rotation_x(0.3);
            let b = a * DQuat::from_axis_angle(axis.normalize(), angle);
            for interpolation in EVERY_KIND {
                let q = interpolation.interpolate_rotation(a, b, w);
                prop_assert!(q.is_normalized());
                let along = a.angle_between(q) + q.angle_between(b);
                prop_assert!((along - a.angle_between(b)).abs() < 1e-6);
                prop_assert!(q.angle_between(interpolation.interpolate_rotation(b, a, 1.0 - w)) < 1e-6);
            }
        }
    }
}
