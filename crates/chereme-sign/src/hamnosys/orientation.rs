//! Directions about an axis: notation's letters for palms of hands that point anywhere, for arcs of movements that go
//! anywhere, and for the points of circles.
//!
//! For a hand that points away from the signer the eight letters are plain directions. For one that points
//! to a side, up or down, it is turned there by the shortest rotation, and the letters with it: pointing
//! up, `d` faces away from the signer. For one that points back towards the signer the letters are those
//! of its mirror image that points away: `r` of a right hand that points inwards and left faces the
//! signer's chest. Transcribers use the letters this way: in signs of the sign language of the Netherlands
//! that touch the chest with the palm's side of such a hand, it is `r`. At the plane between the two
//! halves the meaning changes abruptly, as it does in those signs.
//!
//! The letters of arcs and circles follow the same rule. In the same signs transcribers write `u` 44 times and `d` 12 times
//! for arcs of movements straight, up or down towards the signer, and 96 and 38 times for those away: `u` bends upwards in
//! both.

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

/// Applies the shortest rotation from forward to `direction` to the direction at `angle` from down over
/// right; mirrored for directions towards the signer.
#[must_use]
pub fn rotate_from_forward(direction: [f64; 3], angle: f64) -> [f64; 3] {
    let [x, y, z] = direction;
    let towards = z < -1e-9;
    let z = z.abs();
    let (across, down) = (-angle.sin(), -angle.cos());
    // The shortest turn from forward to (x, y, z) applied to (across, down, 0).
    let along = across * x + down * y;
    let turned = [across - x * along / (1.0 + z), down - y * along / (1.0 + z), -along];
    if towards {
        [turned[0], turned[1], -turned[2]]
    } else {
        turned
    }
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
            ("ul", "dl", [half, -half, 0.0]),
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
