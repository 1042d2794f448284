//! Directions as notation names them: letters for the signer's own sides.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// One of the 26 directions in space: up or down, out or in, left or right, and half-way between.
///
/// Written as SiGML writes it: `u`, `ol`, `dir` (down, in, right).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct SpatialDirection {
    up: i8,
    out: i8,
    left: i8,
}

impl SpatialDirection {
    /// Straight up.
    pub const UP_DIRECTION: Self = Self::from_direction_steps(1, 0, 0);
    /// Straight down.
    pub const DOWN_DIRECTION: Self = Self::from_direction_steps(-1, 0, 0);
    /// Away from the signer.
    pub const OUT_DIRECTION: Self = Self::from_direction_steps(0, 1, 0);
    /// To the signer's left.
    pub const LEFT_DIRECTION: Self = Self::from_direction_steps(0, 0, 1);
    /// To the signer's right.
    pub const RIGHT_DIRECTION: Self = Self::from_direction_steps(0, 0, -1);

    pub(crate) const fn from_direction_steps(up: i8, out: i8, left: i8) -> Self {
        Self { up, out, left }
    }

    /// Returns the direction with these parts, each by its sign; `None` if all are zero.
    #[must_use]
    pub fn from_parts(up: i8, out: i8, left: i8) -> Option<Self> {
        let direction = Self::from_direction_steps(up.signum(), out.signum(), left.signum());
        (direction != Self::from_direction_steps(0, 0, 0)).then_some(direction)
    }

    /// Returns every direction, in a fixed order.
    pub fn all_spatial_directions() -> impl Iterator<Item = Self> {
        let part = [1, 0, -1];
        part.into_iter().flat_map(move |up| {
            part.into_iter()
                .flat_map(move |out| part.into_iter().filter_map(move |left| Self::from_parts(up, out, left)))
        })
    }

    /// Returns the unit vector: to the signer's left, up, away from the signer.
    #[must_use]
    pub fn spatial_direction_vector(self) -> [f64; 3] {
        let parts = [self.left, self.up, self.out].map(f64::from);
        let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        parts.map(|part| part / length)
    }

    /// Returns the direction nearest to a vector (left, up, out); `None` for the zero vector or numbers
    /// that are not finite.
    #[must_use]
    pub fn nearest_spatial_direction(vector: [f64; 3]) -> Option<Self> {
        let dot = |direction: Self| -> f64 {
            let direction_vector = direction.spatial_direction_vector();
            direction_vector.iter().zip(vector).map(|(a, b)| a * b).sum()
        };
        if !vector.iter().all(|part| part.is_finite()) || vector == [0.0; 3] {
            return None;
        }
        Self::all_spatial_directions().max_by(|a, b| dot(*a).total_cmp(&dot(*b)))
    }

    /// Returns the mirror image across the signer's middle.
    #[must_use]
    pub fn mirrored_spatial_direction(self) -> Self {
        Self::from_direction_steps(self.up, self.out, -self.left)
    }

    /// Returns the opposite direction.
    #[must_use]
    pub fn opposite_spatial_direction(self) -> Self {
        Self::from_direction_steps(-self.up, -self.out, -self.left)
    }

    /// Returns the corner between two directions of two parts each that share one: `uo` and `ol` give
    /// `uol`.
    ///
    /// HamNoSys writes corners this way, as they have no symbol of their own.
    #[must_use]
    pub fn corner_with(self, other: Self) -> Option<Self> {
        let own_components = [self.up, self.out, self.left];
        let others = [other.up, other.out, other.left];
        let two = |parts: [i8; 3]| parts.iter().filter(|part| **part != 0).count() == 2;
        let agree = own_components
            .iter()
            .zip(others)
            .all(|(a, b)| *a == 0 || b == 0 || *a == b);
        if !two(own_components) || !two(others) || !agree || self == other {
            return None;
        }
        Self::from_parts(self.up + other.up, self.out + other.out, self.left + other.left)
    }

    /// Returns the two directions whose symbols, one after the other, mean a corner.
    #[must_use]
    pub fn corner_parts(self) -> Option<(Self, Self)> {
        (!self.has_symbol()).then_some((
            Self::from_direction_steps(self.up, self.out, 0),
            Self::from_direction_steps(0, self.out, self.left),
        ))
    }

    /// Returns whether HamNoSys has one symbol for it: a direction with at most two parts.
    #[must_use]
    pub fn has_symbol(self) -> bool {
        self.up == 0 || self.out == 0 || self.left == 0
    }
}

impl fmt::Display for SpatialDirection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let letters = [(self.up, 'u', 'd'), (self.out, 'o', 'i'), (self.left, 'l', 'r')];
        for (part, plus, minus) in letters {
            match part {
                0 => {}
                1 => write!(f, "{plus}")?,
                _ => write!(f, "{minus}")?,
            }
        }
        Ok(())
    }
}

/// A text that is not a direction.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no direction; write one to three of u or d, o or i, l or r, such as \"u\", \"ol\" or \"dir\"")]
pub struct DirectionError(pub String);

impl FromStr for SpatialDirection {
    type Err = DirectionError;

    /// Reads letters in any order; each of the three pairs may contribute at most one letter.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let error = || DirectionError(text.chars().take(12).collect());
        let (mut up, mut out, mut left) = (0, 0, 0);
        for letter in text.chars() {
            let (part, value) = match letter {
                'u' => (&mut up, 1),
                'd' => (&mut up, -1),
                'o' => (&mut out, 1),
                'i' => (&mut out, -1),
                'l' => (&mut left, 1),
                'r' => (&mut left, -1),
                _ => return Err(error()),
            };
            if *part != 0 {
                return Err(error());
            }
            *part = value;
        }
        Self::from_parts(up, out, left).ok_or_else(error)
    }
}

chereme_motion::keep_as_text!(SpatialDirection);

/// One of eight directions about an axis: of a palm, of a curve's bulge, of a circle's start.
///
/// For a palm the axis is the hand's own, and the letters are those of a hand that points away from the
/// signer: `d` faces the floor, `l` the signer's left. For hands that point elsewhere,
/// [`orientation`](super::orientation) defines them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CompassDirection {
    /// Down.
    D,
    /// Down and right.
    Dr,
    /// Right.
    R,
    /// Up and right.
    Ur,
    /// Up.
    U,
    /// Up and left.
    Ul,
    /// Left.
    L,
    /// Down and left.
    Dl,
}

impl CompassDirection {
    /// Every direction, an eighth of a turn apart, from down over the right.
    pub const ALL_COMPASS_DIRECTIONS: [Self; 8] = [
        Self::D,
        Self::Dr,
        Self::R,
        Self::Ur,
        Self::U,
        Self::Ul,
        Self::L,
        Self::Dl,
    ];

    /// Returns the angle about the axis in radians, from `d` over `r`: 0, π/4 ... 7π/4.
    #[must_use]
    pub fn compass_angle(self) -> f64 {
        f64::from(self as u8) * std::f64::consts::FRAC_PI_4
    }

    /// Returns the direction nearest to an angle in radians, from `d` over `r`.
    #[must_use]
    pub fn nearest_compass_direction(angle: f64) -> Self {
        let eighths = (angle / std::f64::consts::FRAC_PI_4).round().rem_euclid(8.0);
        Self::ALL_COMPASS_DIRECTIONS[if eighths.is_finite() { eighths as usize % 8 } else { 0 }]
    }

    /// Returns the mirror image across the signer's middle.
    #[must_use]
    pub fn mirrored_compass_direction(self) -> Self {
        Self::ALL_COMPASS_DIRECTIONS[(8 - self as usize) % 8]
    }

    /// Returns the letters, as SiGML writes them.
    #[must_use]
    pub fn compass_letters(self) -> &'static str {
        ["d", "dr", "r", "ur", "u", "ul", "l", "dl"][self as usize]
    }
}

impl fmt::Display for CompassDirection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.compass_letters())
    }
}

impl FromStr for CompassDirection {
    type Err = CompassError;
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Self::ALL_COMPASS_DIRECTIONS
            .into_iter()
            .find(|palm| palm.compass_letters() == text)
            .ok_or_else(|| CompassError(text.chars().take(12).collect()))
    }
}

/// A text that names none of the eight directions.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is not one of the eight directions; write u, ur, r, dr, d, dl, l or ul")]
pub struct CompassError(pub String);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_reads_back_and_is_its_own_nearest_direction() {
        assert_eq!(SpatialDirection::all_spatial_directions().count(), 26);
        assert_eq!(
            SpatialDirection::all_spatial_directions()
                .filter(|d| d.has_symbol())
                .count(),
            18
        );
        for direction in SpatialDirection::all_spatial_directions() {
            assert_eq!(direction.to_string().parse(), Ok(direction));
            assert_eq!(
                SpatialDirection::nearest_spatial_direction(direction.spatial_direction_vector()),
                Some(direction)
            );
            assert_eq!(
                direction.mirrored_spatial_direction().mirrored_spatial_direction(),
                direction
            );
            let corner = direction.corner_parts();
            assert_eq!(corner.is_none(), direction.has_symbol());
            assert!(corner.is_none_or(|(a, b)| a.corner_with(b) == Some(direction)));
        }
        assert_eq!(
            "uol"
                .parse::<SpatialDirection>()
                .map(SpatialDirection::spatial_direction_vector)
                .ok(),
            Some([1.0 / 3f64.sqrt(); 3])
        );
        for odd in ["", "uu", "ud", "x", "uuo"] {
            assert!(odd.parse::<SpatialDirection>().is_err(), "{odd:?}");
        }
    }

    #[test]
    fn palms_are_an_eighth_of_a_turn_apart() {
        for palm in CompassDirection::ALL_COMPASS_DIRECTIONS {
            assert_eq!(palm.compass_letters().parse(), Ok(palm));
            assert_eq!(
                CompassDirection::nearest_compass_direction(palm.compass_angle() + 0.3),
                palm
            );
            assert_eq!(palm.mirrored_compass_direction().mirrored_compass_direction(), palm);
        }
        assert_eq!(CompassDirection::L.mirrored_compass_direction(), CompassDirection::R);
        assert_eq!(
            CompassDirection::nearest_compass_direction(-std::f64::consts::FRAC_PI_2),
            CompassDirection::L
        );
    }
}
