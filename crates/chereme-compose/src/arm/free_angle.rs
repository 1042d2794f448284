//! Chooses one free angle per frame so that avoidable jumps disappear.

use std::f64::consts::{FRAC_PI_2, PI};

use chereme_motion::glam::{DQuat, DVec3};

/// The time before and after a jump over which angles change, in seconds.
const ANGLE_JUMP_SECONDS: f64 = 0.25;
/// The weight of a rotation beyond the limit, relative to an equal change of an angle.
const TOO_FAR: f64 = 2e6;
/// The weight of an angle that must stay.
const FREE_ANGLE_FIXED_WEIGHT: f64 = 1e9;
/// The most iterations.
const MAX_EASING_STEPS: usize = 40;
/// The longest step of one angle, in radians.
const MAX_FREE_ANGLE_STEP: f64 = 0.3;

/// The rotation beyond the limit between two frames, in radians, and its derivatives by the angles of the first and the
/// second frame; `None` within the limit.
pub(super) type ExcessRotation = Option<(f64, [f64; 2])>;

/// A direction that rotates about a line by a free angle; both are unit vectors.
pub(super) struct RotatingDirection {
    pub(super) line: DVec3,
    /// The direction at angle zero.
    pub(super) start: DVec3,
}

impl RotatingDirection {
    fn direction_at_angle(&self, angle: f64) -> DVec3 {
        let along = self.line * self.line.dot(self.start);
        along + (self.start - along) * angle.cos() + self.line.cross(self.start) * angle.sin()
    }

    /// Returns whether no direction rotates by more than `most` radians from one frame to the next while every free
    /// angle is zero.
    pub(super) fn is_calm(all: &[Self], most: f64) -> bool {
        // The cosine falls only up to a half turn.
        let least = most.min(PI).cos();
        all.windows(2).all(|two| two[0].start.dot(two[1].start) >= least)
    }

    /// Returns by how much the direction rotates beyond `most` radians from one frame to the next.
    pub(super) fn direction_excess_rotation(two: [&Self; 2], angles: [f64; 2], most: f64) -> ExcessRotation {
        let [before, now] = [0, 1].map(|n| two[n].direction_at_angle(angles[n]));
        let turn = before.angle_between(now);
        let sine = turn.sin();
        // At a half turn the slopes are undefined.
        (turn > most && sine > 1e-9).then(|| {
            let slopes = [two[0].line.cross(before).dot(now), two[1].line.cross(now).dot(before)];
            (turn - most, slopes.map(|slope| -slope / sine))
        })
    }
}

/// A rotation that is followed by a rotation about a line, a unit vector, by a free angle.
pub(super) struct FreelyTurnedRotation {
    pub(super) line: DVec3,
    /// The rotation at angle zero.
    pub(super) start: DQuat,
}

impl FreelyTurnedRotation {
    /// Returns whether no rotation changes by more than `most` radians from one frame to the next while every free
    /// angle is zero.
    pub(super) fn is_calm(all: &[Self], most: f64) -> bool {
        // The scalar product of two quaternions is the cosine of half the angle between them, but for its
        // sign.
        let least = (most / 2.0).min(FRAC_PI_2).cos();
        all.windows(2).all(|two| two[0].start.dot(two[1].start).abs() >= least)
    }

    /// Returns by how much the rotation changes beyond `most` radians from one frame to the next.
    pub(super) fn turned_excess_rotation(two: [&Self; 2], angles: [f64; 2], most: f64) -> ExcessRotation {
        let angle_rotation = |n: usize| DQuat::from_axis_angle(two[n].line, angles[n]) * two[n].start;
        let rotated = |n: usize, at: DQuat| DQuat::from_vec4(two[n].line.extend(0.0)) * at;
        let [before, now] = [angle_rotation(0), angle_rotation(1)];
        let cosine = before.dot(now);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        let turn = 2.0 * sine.atan2(cosine.abs());
        // Equal rotations have no slopes to divide by.
        (turn > most && sine > 1e-9).then(|| {
            let slopes = [rotated(0, before).dot(now), rotated(1, now).dot(before)];
            (turn - most, slopes.map(|slope| -slope * cosine.signum() / sine))
        })
    }
}

/// Returns the angles that minimise the rotation beyond the limits, starting from zero; `None` if nothing exceeds its
/// limit at zero. `fixed` angles stay zero.
///
/// Damped Gauss-Newton steps, each a tridiagonal solution, minimise the sum of the squares of the angles, of their
/// changes from frame to frame, and of the results of `excess`, which takes the index of the second of two frames and
/// their angles.
pub(super) fn ease_free_angles(
    fixed: &[bool],
    frame_time: f64,
    excess: impl Fn(usize, [f64; 2]) -> [ExcessRotation; 2],
) -> Option<Vec<f64>> {
    let weights: Vec<f64> = fixed
        .iter()
        .map(|&fixed| if fixed { FREE_ANGLE_FIXED_WEIGHT } else { 1.0 })
        .collect();
    // The square of a time in frames: an angle beside a jump decays over that time.
    let stiff = (ANGLE_JUMP_SECONDS / frame_time).powi(2);
    let pairs = |angles: &[f64]| -> Vec<[ExcessRotation; 2]> {
        (1..angles.len())
            .map(|n| excess(n, [angles[n - 1], angles[n]]))
            .collect()
    };
    let sum = |angles: &[f64], pairs: &[[ExcessRotation; 2]]| {
        let places = weights.iter().zip(angles).map(|(weight, angle)| weight * angle * angle);
        let turns = angles.windows(2).map(|two| stiff * (two[1] - two[0]).powi(2));
        let far = pairs
            .iter()
            .flatten()
            .flatten()
            .map(|(excess, _)| TOO_FAR * excess * excess);
        places.sum::<f64>() + turns.sum::<f64>() + far.sum::<f64>()
    };
    let mut angles = vec![0.0; fixed.len()];
    let mut far = pairs(&angles);
    if far.iter().flatten().all(Option::is_none) {
        return None;
    }
    let mut least = sum(&angles, &far);
    let mut damping = 1.0;
    for _ in 0..MAX_EASING_STEPS {
        let mut equations = TridiagonalEquations::new(&weights, &angles, damping);
        for n in 1..angles.len() {
            equations.add_squared_value(n, stiff, angles[n] - angles[n - 1], [-1.0, 1.0]);
            for &(excess, slopes) in far[n - 1].iter().flatten() {
                equations.add_squared_value(n, TOO_FAR, excess, slopes);
            }
        }
        let steps = equations.solved().into_iter();
        // The slopes hold near the present angles only, so that steps are short.
        let tried_angles = angles
            .iter()
            .zip(steps)
            .map(|(angle, step)| angle + step.clamp(-MAX_FREE_ANGLE_STEP, MAX_FREE_ANGLE_STEP));
        let tried: Vec<f64> = tried_angles.collect();
        let now = pairs(&tried);
        let total = sum(&tried, &now);
        if total >= least {
            damping *= 10.0;
            continue;
        }
        let done = least - total < 1e-4 * least;
        (angles, far, least, damping) = (tried, now, total, damping * 0.2);
        if done {
            break;
        }
    }
    Some(angles)
}

/// Tridiagonal equations for one step of all angles.
struct TridiagonalEquations {
    diagonal: Vec<f64>,
    /// The entries left of the diagonal.
    beside: Vec<f64>,
    right: Vec<f64>,
}

impl TridiagonalEquations {
    fn new(weights: &[f64], angles: &[f64], damping: f64) -> Self {
        Self {
            diagonal: weights.iter().map(|weight| weight + damping).collect(),
            beside: vec![0.0; weights.len()],
            right: weights
                .iter()
                .zip(angles)
                .map(|(weight, angle)| -weight * angle)
                .collect(),
        }
    }

    /// Adds the square of `value`, whose derivatives by the angles of frames `n - 1` and `n` are given.
    fn add_squared_value(&mut self, n: usize, weight: f64, value: f64, [before, now]: [f64; 2]) {
        self.diagonal[n - 1] += weight * before * before;
        self.diagonal[n] += weight * now * now;
        self.beside[n] += weight * before * now;
        self.right[n - 1] -= weight * value * before;
        self.right[n] -= weight * value * now;
    }

    fn solved(mut self) -> Vec<f64> {
        let len = self.right.len();
        // Gauss elimination of three diagonals: downwards here, and back upwards below.
        for n in 1..len {
            let share = self.beside[n] / self.diagonal[n - 1];
            self.diagonal[n] -= share * self.beside[n];
            self.right[n] -= share * self.right[n - 1];
        }
        for n in (0..len).rev() {
            if n + 1 < len {
                self.right[n] -= self.beside[n + 1] * self.right[n + 1];
            }
            self.right[n] /= self.diagonal[n];
        }
        self.right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: f64 = 1.0 / 120.0;
    const MOST: f64 = 0.07;

    /// An elbow while the wrist passes above the shoulder: the line rotates fastest in the middle.
    fn passing() -> Vec<RotatingDirection> {
        let at = |n: i32| {
            let line = DVec3::new(f64::from(n - 120) * 0.02, 0.2, 0.0).normalize();
            let out = DVec3::new(-line.y * 0.9, line.x * 0.9, 0.3).normalize();
            let start = (line * 0.4 + out).normalize();
            RotatingDirection { line, start }
        };
        (0..240).map(at).collect()
    }

    fn ease(circles: &[RotatingDirection], fixed: &[bool]) -> Option<Vec<f64>> {
        ease_free_angles(fixed, FRAME, |n, angles| {
            [
                RotatingDirection::direction_excess_rotation([&circles[n - 1], &circles[n]], angles, MOST),
                None,
            ]
        })
    }

    fn farthest(circles: &[RotatingDirection], angles: &[f64]) -> f64 {
        let at: Vec<DVec3> = circles
            .iter()
            .zip(angles)
            .map(|(c, &a)| c.direction_at_angle(a))
            .collect();
        let turns = at.windows(2).map(|two| two[0].angle_between(two[1]));
        turns.fold(0.0, f64::max)
    }

    #[test]
    fn fast_elbow_turns_are_spread_over_earlier_and_later_frames() {
        let circles = passing();
        let fixed: Vec<bool> = (0..240).map(|n| n < 5).collect();
        let angles = ease(&circles, &fixed).expect("it turns too far");
        let [was, is] = [farthest(&circles, &[0.0; 240]), farthest(&circles, &angles)];
        assert!(was > 0.09 && is < MOST + 0.01, "{was} {is}");
        assert!(angles[..5].iter().all(|angle| angle.abs() < 1e-4));
        let turns = angles.windows(2).map(|two| (two[1] - two[0]).abs());
        assert!(turns.fold(0.0, f64::max) < MOST);
    }

    #[test]
    fn elbows_that_turn_slowly_are_kept() {
        assert_eq!(ease(&passing()[..60], &[false; 60]), None);
        assert_eq!(ease(&[], &[]), None);
    }

    #[test]
    fn derivatives_of_the_excess_equal_finite_differences() {
        let lines = [DVec3::X, DVec3::new(0.6, 0.8, 0.0)];
        let starts = [DVec3::new(0.0, 0.6, 0.8), DVec3::new(0.36, 0.48, 0.8)];
        let circles = [0, 1].map(|n| RotatingDirection {
            line: lines[n],
            start: starts[n],
        });
        let turned = [0, 1].map(|n| FreelyTurnedRotation {
            line: lines[n],
            start: DQuat::from_rotation_arc(starts[n], lines[1 - n]),
        });
        let circle = |angles| RotatingDirection::direction_excess_rotation([&circles[0], &circles[1]], angles, 0.01);
        let turn = |angles| FreelyTurnedRotation::turned_excess_rotation([&turned[0], &turned[1]], angles, 0.01);
        let forms: [&dyn Fn([f64; 2]) -> ExcessRotation; 2] = [&circle, &turn];
        for form in forms {
            let value = |a, b| form([a, b]).expect("it turns").0;
            let (_, slopes) = form([0.3, -0.2]).expect("it turns");
            let [before, now] = [
                value(0.3 + 1e-6, -0.2) - value(0.3 - 1e-6, -0.2),
                value(0.3, -0.2 + 1e-6) - value(0.3, -0.2 - 1e-6),
            ];
            assert!((slopes[0] - before / 2e-6).abs() < 1e-6, "{slopes:?} {before}");
            assert!((slopes[1] - now / 2e-6).abs() < 1e-6, "{slopes:?} {now}");
        }
    }
}
