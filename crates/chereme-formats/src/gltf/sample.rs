//! Values of an animation's samplers at any time (glTF 2.0, appendix C).

use chereme_motion::glam::{DQuat, DVec3};

use super::model::Interpolation;

/// The keys of one sampler.
pub(super) struct Keys {
    pub(super) times: Vec<f32>,
    pub(super) values: Vec<f32>,
    pub(super) interpolation: Interpolation,
    /// The number of numbers in a value.
    pub(super) width: usize,
}

impl Keys {
    /// Returns whether there are as many values as times, and the times rise.
    pub(super) fn are_sound(&self) -> bool {
        let each = if self.interpolation == Interpolation::Cubic {
            3
        } else {
            1
        };
        !self.times.is_empty()
            && self.values.len() == self.times.len() * self.width * each
            && self.times.windows(2).all(|pair| pair[0] < pair[1])
    }

    /// Returns a part of a key: 1 for its value, 0 and 2 for the tangents of a spline.
    fn value(&self, key: usize, part: usize) -> &[f32] {
        let at = match self.interpolation {
            Interpolation::Cubic => 3 * key + part,
            _ => key,
        };
        &self.values[at * self.width..(at + 1) * self.width]
    }

    /// Returns the value at a time in seconds; outside the keys, that of the first or last key.
    pub(super) fn at(&self, time: f64) -> Vec<f64> {
        let numbers = |values: &[f32]| values.iter().map(|value| f64::from(*value)).collect();
        let after = self.times.partition_point(|key| f64::from(*key) <= time);
        let Some(before) = after.checked_sub(1) else {
            return numbers(self.value(0, 1));
        };
        if after == self.times.len() {
            return numbers(self.value(before, 1));
        }
        let (start, end) = (f64::from(self.times[before]), f64::from(self.times[after]));
        let length = end - start;
        let share = (time - start) / length;
        let (a, b) = (self.value(before, 1), self.value(after, 1));
        let pairs = a.iter().zip(b).map(|(a, b)| (f64::from(*a), f64::from(*b)));
        match self.interpolation {
            Interpolation::Step => numbers(a),
            Interpolation::Linear if self.width == 4 => {
                let quat = |values: &[f32]| {
                    turn(&values.iter().map(|it| f64::from(*it)).collect::<Vec<_>>())
                };
                quat(a).slerp(quat(b), share).to_array().to_vec()
            }
            Interpolation::Linear => pairs.map(|(a, b)| a + (b - a) * share).collect(),
            Interpolation::Cubic => {
                let (out, into) = (self.value(before, 2), self.value(after, 0));
                let (s, s2, s3) = (share, share * share, share * share * share);
                let spline = |(at, (a, b)): (usize, (f64, f64))| {
                    let (out, into) = (f64::from(out[at]), f64::from(into[at]));
                    (2.0 * s3 - 3.0 * s2 + 1.0) * a
                        + length * (s3 - 2.0 * s2 + s) * out
                        + (-2.0 * s3 + 3.0 * s2) * b
                        + length * (s3 - s2) * into
                };
                pairs.enumerate().map(spline).collect()
            }
        }
    }
}

/// Returns a unit rotation from x y z w; all zeros give the identity.
pub(super) fn turn(values: &[f64]) -> DQuat {
    match values {
        [x, y, z, w] => {
            let turn = DQuat::from_xyzw(*x, *y, *z, *w);
            let length = turn.length();
            if length > 1e-9 {
                turn / length
            } else {
                DQuat::IDENTITY
            }
        }
        _ => DQuat::IDENTITY,
    }
}

/// Returns a position from x y z.
pub(super) fn place(values: &[f64]) -> DVec3 {
    match values {
        [x, y, z] => DVec3::new(*x, *y, *z),
        _ => DVec3::ZERO,
    }
}
