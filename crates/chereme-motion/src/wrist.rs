//! Angles of a hand on its forearm, and their limits. The animator poses no hand beyond the limits; the transcriber
//! expects that a hand at a limit was meant to turn farther.

/// Angles of a hand on its forearm, in radians.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WristAngles {
    /// Bend towards the palm.
    pub flexion: f64,
    /// Bend towards the thumb.
    pub deviation: f64,
    /// Turn of the forearm: 0 if the thumb is up, negative towards palm down, positive towards palm up.
    pub turn: f64,
}

/// Limits of wrist and forearm, in radians; each pair holds the largest negative angle, without its sign, and the
/// largest positive one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WristLimits {
    /// Backward, and towards the palm.
    pub flexion: [f64; 2],
    /// Towards the little finger, and towards the thumb.
    pub deviation: [f64; 2],
    /// Palm down, and palm up.
    pub turn: [f64; 2],
}

impl WristAngles {
    /// Returns the bend of the wrist as a multiple of the largest bend in the same direction; above 1 it is out of
    /// range. The largest bends form an ellipse over flexion and deviation.
    #[must_use]
    pub fn wrist_bend_share(&self, limits: &WristLimits) -> f64 {
        let ends = self.bend_limit_axes(limits);
        let [a, b] = [self.flexion / ends[0], self.deviation / ends[1]];
        (a * a + b * b).sqrt()
    }

    /// Returns the turn of the forearm as a multiple of its limit; above 1 it is out of range.
    #[must_use]
    pub fn forearm_turn_share(&self, limits: &WristLimits) -> f64 {
        self.turn.abs() / limits.turn[usize::from(self.turn > 0.0)]
    }

    /// Returns the nearest angles within the limits; a forearm beyond its limits stops at the upper one (palm up) if
    /// `high`, at the lower one otherwise.
    #[must_use]
    pub fn clamp_to_limits(&self, limits: &WristLimits, high: bool) -> Self {
        let [flexion, deviation] = match self.wrist_bend_share(limits) > 1.0 {
            true => self.nearest_bend(limits),
            false => [self.flexion, self.deviation],
        };
        let [less, more] = limits.turn;
        let turn = match (-less..=more).contains(&self.turn) {
            // A turn has two ends at which the same palm is reached; the caller knows which one is meant.
            true => self.turn,
            false if high => more,
            false => -less,
        };
        Self {
            flexion,
            deviation,
            turn,
        }
    }

    /// Returns flexion and deviation at the nearest point of the limit; only for a [`wrist_bend_share`](Self::wrist_bend_share) above 1.
    #[must_use]
    pub fn nearest_bend(&self, limits: &WristLimits) -> [f64; 2] {
        nearest_on_ellipse([self.flexion, self.deviation], self.bend_limit_axes(limits))
    }

    /// Interpolates linearly; the limits are convex, so the result is within them if both ends are.
    #[must_use]
    pub fn interpolate_wrist_angles(&self, to: &Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        Self {
            flexion: mix(self.flexion, to.flexion),
            deviation: mix(self.deviation, to.deviation),
            turn: mix(self.turn, to.turn),
        }
    }

    /// Returns the largest difference of an angle.
    #[must_use]
    pub fn largest_angle_difference(&self, other: &Self) -> f64 {
        let flexion = (self.flexion - other.flexion).abs();
        let deviation = (self.deviation - other.deviation).abs();
        flexion.max(deviation).max((self.turn - other.turn).abs())
    }

    /// Returns the limits of flexion and deviation on the sides to which the wrist bends: the half axes of the ellipse
    /// of limits there.
    fn bend_limit_axes(&self, limits: &WristLimits) -> [f64; 2] {
        [
            limits.flexion[usize::from(self.flexion > 0.0)],
            limits.deviation[usize::from(self.deviation > 0.0)],
        ]
    }
}

/// Returns the point of an ellipse about the origin with half axes `ends` that is nearest to a point
/// outside of it. The normal at that point leads to the given one: `x = e²p / (t + e²)` in either axis,
/// with the `t` that puts it on the ellipse, found by Newton's method from below (Eberly, *Distance from a
/// point to an ellipse*).
fn nearest_on_ellipse(point: [f64; 2], ends: [f64; 2]) -> [f64; 2] {
    // An end of zero would divide by zero below.
    let [a, b] = ends.map(|end| end.max(1e-6));
    let [x, y] = point;
    // For larger `t` the sum is convex and falling, and it is at least 1 here.
    let mut t = (a * x.abs() - a * a).max(b * y.abs() - b * b).max(0.0);
    for _ in 0..8 {
        let (u, v) = (a * x / (t + a * a), b * y / (t + b * b));
        let over = u * u + v * v - 1.0;
        if over < 1e-7 {
            break;
        }
        t += over / (2.0 * (u * u / (t + a * a) + v * v / (t + b * b)));
    }
    let (u, v) = (a * x / (t + a * a), b * y / (t + b * b));
    // A direction that the iteration leaves outside the ellipse is scaled onto it.
    let size = (u * u + v * v).sqrt().max(1.0);
    [a * u / size, b * v / size]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_of_an_ellipse_is_found() {
        for (point, ends) in [
            ([1.0, 1.0], [1.4, 0.4]),
            ([0.1, -0.9], [1.3, 0.7]),
            ([-2.0, 0.0], [1.0, 0.5]),
        ] {
            let [x, y] = nearest_on_ellipse(point, ends);
            assert!(((x / ends[0]).hypot(y / ends[1]) - 1.0).abs() < 1e-6);
            let own = (x - point[0]).hypot(y - point[1]);
            for n in 0..360 {
                let (sin, cos) = f64::from(n).to_radians().sin_cos();
                let other = (ends[0] * cos - point[0]).hypot(ends[1] * sin - point[1]);
                assert!(own <= other + 1e-6, "{point:?} {n}");
            }
        }
    }

    #[test]
    fn angles_within_their_limits_are_kept_and_others_are_clamped() {
        let limits = WristLimits {
            flexion: [1.0, 1.4],
            deviation: [0.6, 0.3],
            turn: [1.2, 1.6],
        };
        for flexion in [-1.5, -0.4, 0.0, 0.9, 2.0] {
            for deviation in [-0.9, -0.1, 0.2, 0.5] {
                for turn in [-2.0, -0.5, 1.0, 2.0] {
                    let asked = WristAngles {
                        flexion,
                        deviation,
                        turn,
                    };
                    let free = asked.wrist_bend_share(&limits) <= 1.0 && asked.forearm_turn_share(&limits) <= 1.0;
                    for high in [false, true] {
                        let allowed = asked.clamp_to_limits(&limits, high);
                        assert!(allowed.wrist_bend_share(&limits) < 1.0 + 1e-6, "{asked:?}");
                        assert!(allowed.forearm_turn_share(&limits) <= 1.0, "{asked:?}");
                        assert_eq!(allowed == asked, free, "{asked:?}");
                        assert!(
                            allowed
                                .clamp_to_limits(&limits, high)
                                .largest_angle_difference(&allowed)
                                < 1e-6
                        );
                    }
                }
            }
        }
    }
}
