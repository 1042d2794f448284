//! Directions about an axis: notation's letters for palms of hands that point anywhere, for arcs of movements that go
//! anywhere, and for the points of circles.
//!
//! For a hand that points away from the signer the eight letters are plain directions. For one that points elsewhere, it
//! is first raised to its height about the axis from left to right, then turned about the vertical, and the letters turn
//! with it: pointing up, `d` faces away from the signer; pointing to the left, `l` faces the signer. Straight up and down
//! there is no turn, so the meaning changes abruptly there. The two public engines that animate this notation do the same:
//! the rule gives each of 208 measured postures of the reference engine within 19 degrees.
//!
//! For a hand that points back towards the signer `l` and `r` change places, so that they keep their sides: `r` of a right
//! hand that points inwards and left faces the signer's chest.
//!
//! The letters of arcs and circles follow the same rule. In signs of the sign language of the Netherlands transcribers write
//! `u` 44 times and `d` 12 times for arcs of movements straight, up or down towards the signer, and 96 and 38 times for
//! those away: `u` bends upwards in both.

/// The sine of the angle from the vertical below which a direction is straight up or down.
const VERTICAL_SINE: f64 = 1e-6;

/// A vector to the signer's left, up and away from the signer.
type SignerVector = [f64; 3];

/// Returns the unit vector of a palm's direction: `direction` is the unit vector of the hand's axis, `angle` is as in
/// [`CompassDirection::compass_angle`](super::CompassDirection::compass_angle).
#[must_use]
pub fn palm_direction_vector(direction: [f64; 3], angle: f64) -> [f64; 3] {
    rotate_from_forward(direction, angle)
}

/// Returns the angle of a palm that faces `palm` on a hand that points to `direction`, both unit vectors.
/// For this angle, [`palm_direction_vector`] returns the part of `palm_direction_vector` at a right angle to the direction.
#[must_use]
pub fn palm_angle(direction: [f64; 3], palm: [f64; 3]) -> f64 {
    angle_about(direction, palm)
}

/// Inverts [`rotate_from_forward`]: returns the angle of the part of `vector` at a right angle to `direction`, a unit vector.
#[must_use]
pub fn angle_about(direction: [f64; 3], vector: [f64; 3]) -> f64 {
    let dot = |a: SignerVector, b: SignerVector| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let down = dot(vector, rotate_from_forward(direction, 0.0));
    let right = dot(vector, rotate_from_forward(direction, std::f64::consts::FRAC_PI_2));
    right.atan2(down)
}

/// Raises and then turns forward to `direction`, a unit vector, and with it the direction at `angle` from down over right;
/// the angle is reversed for directions towards the signer.
#[must_use]
pub fn rotate_from_forward(direction: [f64; 3], angle: f64) -> [f64; 3] {
    let [left, up, out] = direction;
    let (across, down) = (if out < -1e-9 { angle.sin() } else { -angle.sin() }, -angle.cos());
    let level = left.hypot(out);
    let (turn_sine, turn_cosine) = match level > VERTICAL_SINE {
        true => (left / level, out / level),
        false => (0.0, 1.0),
    };
    // Raised by its height, down leans away from forward.
    let (raised, leaning) = (down * level, -down * up);
    [
        across * turn_cosine + leaning * turn_sine,
        raised,
        leaning * turn_cosine - across * turn_sine,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hamnosys::{CompassDirection, SpatialDirection};

    #[test]
    fn palm_symbols_face_as_transcribers_use_them() {
        let half = 0.5f64.sqrt();
        for (direction, letter, faces) in [
            ("o", "d", [0.0, -1.0, 0.0]),
            ("o", "l", [1.0, 0.0, 0.0]),
            ("u", "d", [0.0, 0.0, 1.0]),
            ("u", "u", [0.0, 0.0, -1.0]),
            ("u", "l", [1.0, 0.0, 0.0]),
            ("l", "d", [0.0, -1.0, 0.0]),
            ("l", "l", [0.0, 0.0, -1.0]),
            ("d", "u", [0.0, 0.0, 1.0]),
            ("i", "d", [0.0, -1.0, 0.0]),
            ("i", "l", [1.0, 0.0, 0.0]),
            ("il", "r", [-half, 0.0, -half]),
            ("ui", "d", [0.0, -half, -half]),
            ("ul", "d", [half, -half, 0.0]),
            ("ul", "l", [0.0, 0.0, -1.0]),
            ("dr", "u", [-half, half, 0.0]),
        ] {
            let pointing: SpatialDirection = direction.parse().expect("a direction");
            let angle = letter.parse::<CompassDirection>().expect("a palm").compass_angle();
            let is = palm_direction_vector(pointing.spatial_direction_vector(), angle);
            let far: f64 = is.iter().zip(faces).map(|(a, b)| (a - b).abs()).sum();
            assert!(far < 1e-9, "{direction} {letter}: {is:?}");
        }
    }

    #[test]
    fn palms_are_perpendicular_to_the_hand_and_angles_convert_back() {
        for direction in SpatialDirection::all_spatial_directions() {
            let pointing = direction.spatial_direction_vector();
            for letter in CompassDirection::ALL_COMPASS_DIRECTIONS {
                let is = palm_direction_vector(pointing, letter.compass_angle());
                let along: f64 = is.iter().zip(pointing).map(|(a, b)| a * b).sum();
                let length: f64 = is.iter().map(|a| a * a).sum();
                assert!(along.abs() < 1e-9 && (length - 1.0).abs() < 1e-9);
                assert_eq!(
                    CompassDirection::nearest_compass_direction(palm_angle(pointing, is)),
                    letter,
                    "{direction}"
                );
            }
        }
    }
}
