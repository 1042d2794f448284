//! Smooths angles over time: reliable ones stay, and the angle changes steadily through unreliable ones.

use std::f64::consts::{PI, TAU};

/// The change of an angle beyond its `own` change, in radians per second, above which it is doubted.
const MAX_TRUSTED_ANGLE_SPEED: f64 = 5.0;
/// Times before and after a doubted change over which it is spread, tried in order, in seconds.
const CHANGE_SPREAD_SECONDS: [f64; 4] = [0.05, 0.1, 0.2, 0.4];
/// The time over which angles of little trust are smoothed, in seconds.
const ANGLE_SMOOTHING_SECONDS: f64 = 0.04;
/// The weight of an angle that may not change.
const SMOOTHING_FIXED_WEIGHT: f64 = 1e9;

/// Angles of one joint, one per frame.
pub(super) struct TrustedAngles {
    /// The angles in radians; angles that differ by whole turns are the same.
    pub(super) values: Vec<f64>,
    /// The reliability of each angle, from 0 to 1; above 1 the angle must not change.
    pub(super) trust: Vec<f64>,
    /// The known change of the source's angle from the frame before; 0 if it is unknown.
    pub(super) own: Vec<f64>,
}

impl TrustedAngles {
    /// Returns the correction of each angle that keeps all from changing too fast; `None` if none is needed.
    ///
    /// Angles of little trust follow more reliable neighbours; if an angle still changes too fast, the change is spread
    /// over the frames around it. This is a least-squares solution: it minimises the sum of `weight · change²` and of
    /// the squared differences between the steps and their `own` changes.
    pub(super) fn calming_corrections(mut self, frame_time: f64) -> Option<Vec<f64>> {
        self.unwrap_joint_angles();
        let fastest = MAX_TRUSTED_ANGLE_SPEED * frame_time;
        let mut weights: Vec<f64> = self.trust.iter().map(|&trust| trust_weight(trust)).collect();
        let doubted = |values: &[f64], own: &[f64]| -> Vec<usize> {
            let too_fast = |n: &usize| (values[*n] - values[n - 1] - own[*n]).abs() > fastest;
            (1..values.len()).filter(too_fast).collect()
        };
        let mut values = self.values.clone();
        let mut left = doubted(&values, &self.own);
        // Without a jump only angles of little trust have anything to correct.
        if left.is_empty() && self.trust.iter().all(|&trust| trust > 0.99) {
            return None;
        }
        let stiff = (ANGLE_SMOOTHING_SECONDS / frame_time).powi(2);
        for spread in CHANGE_SPREAD_SECONDS {
            let near = (spread / frame_time).round() as usize;
            for &at in &left {
                let around = at.saturating_sub(near)..(at + near).min(weights.len());
                for weight in weights[around]
                    .iter_mut()
                    .filter(|weight| **weight < SMOOTHING_FIXED_WEIGHT)
                {
                    // A doubted angle gives way to its neighbours.
                    *weight = weight.min(1e-3);
                }
            }
            // Always from the given values, so that a wider spread does not come on top of a narrow one.
            values = evened(&self.values, &weights, &self.own, stiff);
            left = doubted(&values, &self.own);
            if left.is_empty() {
                break;
            }
        }
        let changes = values.iter().zip(&self.values).map(|(new, old)| new - old);
        Some(changes.collect())
    }

    /// Removes whole turns: each angle becomes the one nearest to the last reliable angle plus its `own` changes since.
    fn unwrap_joint_angles(&mut self) {
        let mut last = self.values.first().copied().unwrap_or_default();
        for ((value, trust), own) in self.values.iter_mut().zip(&self.trust).zip(&self.own) {
            last += own;
            // Leaves the difference from the last reliable angle within half a turn.
            *value -= TAU * ((*value - last + PI) / TAU).floor();
            // An angle of little trust may stand anywhere and must not lead its followers astray.
            if *trust > 0.3 {
                last = *value;
            }
        }
    }
}

fn trust_weight(trust: f64) -> f64 {
    if trust > 1.0 {
        return SMOOTHING_FIXED_WEIGHT;
    }
    let trust = trust.max(0.0);
    // A trace keeps the equations solvable without trust; full trust weighs 4,000.
    1e-4 + 4.0 * trust * trust / (1.001 - trust)
}

/// Returns the values that are near the given ones by weight, and whose steps are near `own`.
fn evened(values: &[f64], weights: &[f64], own: &[f64], stiff: f64) -> Vec<f64> {
    let len = values.len();
    // The equations are tridiagonal; all entries beside the diagonal are equal.
    let mut above = vec![0.0; len];
    let mut solved = vec![0.0; len];
    for n in 0..len {
        let neighbours = f64::from(u8::from(n > 0)) + f64::from(u8::from(n + 1 < len));
        let mut right = weights[n] * values[n];
        if n > 0 {
            right += stiff * own[n];
        }
        if n + 1 < len {
            right -= stiff * own[n + 1];
        }
        let mut diagonal = weights[n] + stiff * neighbours;
        if n > 0 {
            diagonal += stiff * above[n - 1];
            right += stiff * solved[n - 1];
        }
        above[n] = -stiff / diagonal;
        solved[n] = right / diagonal;
    }
    for n in (0..len.saturating_sub(1)).rev() {
        solved[n] -= above[n] * solved[n + 1];
    }
    solved
}

#[cfg(test)]
mod tests {
    use super::*;

    fn angles(values: Vec<f64>, trust: Vec<f64>) -> TrustedAngles {
        let own = vec![0.0; values.len()];
        TrustedAngles { values, trust, own }
    }

    #[test]
    fn smooth_angles_are_kept() {
        let values: Vec<f64> = (0..200).map(|n| 3.0 + 0.01 * f64::from(n)).collect();
        let wrapped = values.iter().map(|v| (v + PI).rem_euclid(TAU) - PI).collect();
        assert_eq!(angles(wrapped, vec![1.0; 200]).calming_corrections(1.0 / 120.0), None);
    }

    #[test]
    fn a_jump_is_spread_and_fixed_frames_are_kept() {
        let jump: Vec<f64> = (0..240).map(|n| if n < 120 { 0.0 } else { 2.0 }).collect();
        let mut trust = vec![1.0; 240];
        trust[..20].fill(2.0);
        let changes = angles(jump.clone(), trust)
            .calming_corrections(1.0 / 120.0)
            .expect("a jump");
        let now: Vec<f64> = jump.iter().zip(&changes).map(|(a, b)| a + b).collect();
        let steepest = now.windows(2).map(|w| (w[1] - w[0]).abs()).fold(0.0, f64::max);
        assert!(steepest < 0.05, "{steepest}");
        assert!(changes[..20].iter().all(|change| change.abs() < 1e-6));
        assert!(changes[0].abs() + changes[239].abs() < 1e-3);
    }

    #[test]
    fn untrusted_angles_follow_their_neighbours() {
        let values: Vec<f64> = (0..60).map(|n| if (20..40).contains(&n) { 2.5 } else { 0.3 }).collect();
        let trust = values.iter().map(|&v| if v > 1.0 { 0.0 } else { 1.0 }).collect();
        let changes = angles(values.clone(), trust)
            .calming_corrections(1.0 / 120.0)
            .expect("doubts");
        for (value, change) in values.iter().zip(changes) {
            assert!((value + change - 0.3).abs() < 0.02, "{}", value + change);
        }
    }

    #[test]
    fn least_squares_agree_with_elimination_by_hand() {
        // (1 + 2)x - 2y = 0 + 2·(-0.5); -2x + (3 + 2)y = 3·1 + 2·0.5.
        let solved = evened(&[0.0, 1.0], &[1.0, 3.0], &[0.0, 0.5], 2.0);
        assert!((solved[0] - 3.0 / 11.0).abs() < 1e-12 && (solved[1] - 10.0 / 11.0).abs() < 1e-12);
    }
}
