//! Values of an animation's samplers at any time (glTF 2.0, appendix C).

use chereme_motion::glam::{DQuat, DVec3};

use super::gltf_model::GltfInterpolation;

/// The keys of one sampler.
pub(super) struct SamplerKeys {
    pub(super) times: Vec<f32>,
    pub(super) values: Vec<f32>,
    pub(super) interpolation: GltfInterpolation,
    /// The number of numbers in a value.
    pub(super) width: usize,
}

impl SamplerKeys {
    /// Returns whether there are as many values as times, and the times rise.
    pub(super) fn are_sound(&self) -> bool {
        let each = if self.interpolation == GltfInterpolation::Cubic {
            3
        } else {
            1
        };
        !self.times.is_empty()
            && self.values.len() == self.times.len() * self.width * each
            && self.times.windows(2).all(|pair| pair[0] < pair[1])
    }

    /// Returns a part of a key: 1 for its value, 0 and 2 for the tangents of a spline.
    fn sampler_key_part(&self, key: usize, part: usize) -> &[f32] {
        let value_index = match self.interpolation {
            GltfInterpolation::Cubic => 3 * key + part,
            _ => key,
        };
        &self.values[value_index * self.width..(value_index + 1) * self.width]
    }

    /// Returns the rotation at a time in seconds; outside the keys, that of the first or last key.
    pub(super) fn turn_at(&self, time: f64) -> DQuat {
        match self.keys_around_time(time) {
            KeyTimePlace::Between(before, share) if self.interpolation == GltfInterpolation::Linear => {
                let (a, b) = (self.sampler_key_part(before, 1), self.sampler_key_part(before + 1, 1));
                unit_rotation_from(&four_key_values(a)).slerp(unit_rotation_from(&four_key_values(b)), share)
            }
            _ => {
                let mut values = [0.0; 4];
                self.write_values_at(time, &mut values);
                unit_rotation_from(&values)
            }
        }
    }

    /// Returns the position at a time in seconds; outside the keys, that of the first or last key.
    pub(super) fn place_at(&self, time: f64) -> DVec3 {
        let mut values = [0.0; 3];
        self.write_values_at(time, &mut values);
        DVec3::from_array(values)
    }

    /// Writes the numbers at a time in seconds into `into`; outside the keys, those of the first or last key.
    pub(super) fn write_values_at(&self, time: f64, into: &mut [f64]) {
        let (before, share) = match self.keys_around_time(time) {
            KeyTimePlace::Key(key) => return put_key_values(self.sampler_key_part(key, 1), into),
            KeyTimePlace::Between(before, share) => (before, share),
        };
        let (a, b) = (self.sampler_key_part(before, 1), self.sampler_key_part(before + 1, 1));
        match self.interpolation {
            GltfInterpolation::Step => put_key_values(a, into),
            GltfInterpolation::Linear => {
                for (into, (a, b)) in into.iter_mut().zip(a.iter().zip(b)) {
                    let (a, b) = (f64::from(*a), f64::from(*b));
                    *into = a + (b - a) * share;
                }
            }
            GltfInterpolation::Cubic => {
                let (out, toward) = (self.sampler_key_part(before, 2), self.sampler_key_part(before + 1, 0));
                let length = f64::from(self.times[before + 1]) - f64::from(self.times[before]);
                let (s, s2, s3) = (share, share * share, share * share * share);
                for (at, into) in into.iter_mut().enumerate().take(self.width) {
                    let [a, out, b, toward] = [a[at], out[at], b[at], toward[at]].map(f64::from);
                    *into = (2.0 * s3 - 3.0 * s2 + 1.0) * a
                        + length * (s3 - 2.0 * s2 + s) * out
                        + (-2.0 * s3 + 3.0 * s2) * b
                        + length * (s3 - s2) * toward;
                }
            }
        }
    }

    /// Returns the keys around a time.
    fn keys_around_time(&self, time: f64) -> KeyTimePlace {
        let after = self.times.partition_point(|key| f64::from(*key) <= time);
        match after.checked_sub(1) {
            None => KeyTimePlace::Key(0),
            Some(before) if after == self.times.len() => KeyTimePlace::Key(before),
            Some(before) => {
                let (start, end) = (f64::from(self.times[before]), f64::from(self.times[after]));
                KeyTimePlace::Between(before, (time - start) / (end - start))
            }
        }
    }
}

/// The place of a time among the keys.
enum KeyTimePlace {
    /// Outside the keys: this one is the nearest.
    Key(usize),
    /// After this key, by this share of the time to the next one.
    Between(usize, f64),
}

fn put_key_values(values: &[f32], into: &mut [f64]) {
    for (into, value) in into.iter_mut().zip(values) {
        *into = f64::from(*value);
    }
}

fn four_key_values(values: &[f32]) -> [f64; 4] {
    let mut four = [0.0; 4];
    put_key_values(values, &mut four);
    four
}

/// Returns a unit rotation from x y z w; all zeros give the identity.
pub(super) fn unit_rotation_from(values: &[f64]) -> DQuat {
    match values {
        [x, y, z, w] => {
            let turn = DQuat::from_xyzw(*x, *y, *z, *w);
            let length = turn.length();
            if length > 1e-9 { turn / length } else { DQuat::IDENTITY }
        }
        _ => DQuat::IDENTITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(interpolation: GltfInterpolation, width: usize, values: &[f32]) -> SamplerKeys {
        SamplerKeys {
            times: vec![1.0, 3.0],
            values: values.to_vec(),
            interpolation,
            width,
        }
    }

    fn at(keys: &SamplerKeys, time: f64) -> Vec<f64> {
        let mut values = vec![0.0; keys.width];
        keys.write_values_at(time, &mut values);
        values
    }

    #[test]
    fn four_weights_are_numbers_and_no_rotation() {
        let weights = [0.0, 0.0, 0.0, 1.0, 1.0, 0.5, 0.0, 0.0];
        let keys = keys(GltfInterpolation::Linear, 4, &weights);
        assert!(keys.are_sound());
        assert_eq!(at(&keys, 2.0), [0.5, 0.25, 0.0, 0.5]);
        assert_eq!(at(&keys, 0.0), [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(at(&keys, 9.0), [1.0, 0.5, 0.0, 0.0]);
    }

    #[test]
    fn rotations_take_the_shortest_arc_at_an_even_speed() {
        let turns = [0.0, 0.9].map(|angle| DQuat::from_rotation_y(angle).as_quat().to_array());
        let flipped = turns[1].map(|it| -it);
        for last in [turns[1], flipped] {
            let keys = keys(GltfInterpolation::Linear, 4, &[turns[0], last].concat());
            for (time, angle) in [(0.0, 0.0), (1.5, 0.225), (2.0, 0.45), (3.0, 0.9)] {
                let turned = keys.turn_at(time);
                let apart = turned.angle_between(DQuat::from_rotation_y(angle));
                assert!(apart < 1e-6, "{time}: {apart}");
            }
        }
    }

    #[test]
    fn a_cubic_spline_follows_the_formula_of_the_standard() {
        // In-tangent, value, out-tangent of two keys: the line 2 t has the tangent 2 everywhere.
        let line = [2.0, 2.0, 2.0, 2.0, 6.0, 2.0];
        let keys = keys(GltfInterpolation::Cubic, 1, &line);
        for time in [1.0, 1.25, 2.0, 2.9, 3.0] {
            assert!((at(&keys, time)[0] - 2.0 * time).abs() < 1e-12, "{time}");
        }
        assert_eq!(keys.place_at(0.0), DVec3::new(2.0, 0.0, 0.0));
    }
}
