//! Quantities as a recipe writes them: lengths, times, directions, hands.

use std::fmt;
use std::str::FromStr;

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::SignerHandedness;
use serde::{Deserialize, Serialize};

/// A quantity that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum UnitError {
    /// The text before the unit is not a finite number.
    #[error("{text:?} is no number with a unit, such as {example}")]
    Number {
        /// The text as written.
        text: String,
        /// A valid quantity.
        example: &'static str,
    },
    /// The unit is missing or unknown.
    #[error("{text:?} has {}; write one of {units}", unit_found(unit))]
    Unit {
        /// The text as written.
        text: String,
        /// The unit found, possibly empty.
        unit: String,
        /// The units that are understood.
        units: &'static str,
    },
}

fn unit_found(unit: &str) -> String {
    if unit.is_empty() {
        "no unit".to_owned()
    } else {
        format!("the unknown unit {unit:?}")
    }
}

/// A length: absolute, or a share of the signer's arm from shoulder to wrist.
///
/// As text and in JSON `25cm`, `250mm`, `0.25m`, `10in`, or `40%` (of the arm).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum RecipeLength {
    /// Metres.
    Metres(f64),
    /// A share of the arm's length; 1 is the whole arm.
    Arm(f64),
}

impl RecipeLength {
    /// Returns the length in metres for an arm of `arm` metres.
    #[must_use]
    pub fn length_in_metres(self, arm: f64) -> f64 {
        match self {
            Self::Metres(metres) => metres,
            Self::Arm(share) => share * arm,
        }
    }

    /// Returns whether the length is zero for every arm.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.length_in_metres(1.0) == 0.0
    }
}

impl FromStr for RecipeLength {
    type Err = UnitError;
    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (number, unit) = split_number_unit(text, "25cm")?;
        Ok(match unit {
            "m" => Self::Metres(number),
            "cm" => Self::Metres(number / 100.0),
            "mm" => Self::Metres(number / 1000.0),
            "in" | "inch" | "inches" => Self::Metres(number * 0.0254),
            "%" => Self::Arm(number / 100.0),
            _ => {
                return Err(unknown_unit_error(text, unit, "mm, cm, m, in, % (of the arm)"));
            }
        })
    }
}

impl fmt::Display for RecipeLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Metres(m) => match scale_exactly(m, 100.0) {
                Some(cm) => write!(f, "{cm}cm"),
                None => write!(f, "{m}m"),
            },
            Self::Arm(share) => match scale_exactly(share, 100.0) {
                Some(percent) => write!(f, "{percent}%"),
                None => write!(f, "{}%", share * 100.0),
            },
        }
    }
}

/// A length of time in seconds; as text and in JSON `0.2s` or `200ms`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct RecipeSeconds(pub f64);

impl FromStr for RecipeSeconds {
    type Err = UnitError;
    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (number, unit) = split_number_unit(text, "0.2s")?;
        Ok(Self(match unit {
            "s" | "sec" => number,
            "ms" => number / 1000.0,
            _ => return Err(unknown_unit_error(text, unit, "s, ms")),
        }))
    }
}

impl fmt::Display for RecipeSeconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}s", self.0)
    }
}

/// An angle in degrees; as text and in JSON `30deg`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct RecipeDegrees(pub f64);

impl FromStr for RecipeDegrees {
    type Err = UnitError;
    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (number, unit) = split_number_unit(text, "30deg")?;
        match unit {
            "deg" | "°" | "degrees" => Ok(Self(number)),
            _ => Err(unknown_unit_error(text, unit, "deg")),
        }
    }
}

impl fmt::Display for RecipeDegrees {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}deg", self.0)
    }
}

/// A plain factor; as text `1.5` or `150%`, in JSON the text.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct RecipeFactor(pub f64);

impl FromStr for RecipeFactor {
    type Err = UnitError;
    fn from_str(text: &str) -> Result<Self, UnitError> {
        let (number, unit) = split_number_unit(text, "1.5")?;
        match unit {
            "" => Ok(Self(number)),
            "%" => Ok(Self(number / 100.0)),
            _ => Err(unknown_unit_error(text, unit, "none, or %")),
        }
    }
}

impl fmt::Display for RecipeFactor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

chereme_motion::keep_as_text!(RecipeLength, RecipeSeconds, RecipeDegrees, RecipeFactor);

fn split_number_unit<'a>(text: &'a str, example: &'static str) -> Result<(f64, &'a str), UnitError> {
    let text = text.trim();
    let end = text
        .char_indices()
        .find(|&(at, c)| {
            let exponent = (c == 'e' || c == 'E')
                && text[at + 1..]
                    .trim_start_matches(['-', '+'])
                    .starts_with(|d: char| d.is_ascii_digit());
            let sign = (c == '-' || c == '+') && (at == 0 || text[..at].ends_with(['e', 'E']));
            !(c.is_ascii_digit() || c == '.' || exponent || sign)
        })
        .map_or(text.len(), |(at, _)| at);
    let parsed_number = text[..end].parse::<f64>().ok().filter(|n| n.is_finite());
    let number = parsed_number.ok_or_else(|| UnitError::Number {
        text: text.to_owned(),
        example,
    })?;
    Ok((number, text[end..].trim()))
}

fn unknown_unit_error(text: &str, unit: &str, units: &'static str) -> UnitError {
    UnitError::Unit {
        text: text.to_owned(),
        unit: unit.to_owned(),
        units,
    }
}

/// Returns `value` times `by`, rounded to 12 digits so that 0.07 m prints as 7 cm; `None` if dividing it again does not
/// give `value` exactly.
fn scale_exactly(value: f64, by: f64) -> Option<f64> {
    let rounded: f64 = format!("{:.11e}", value * by).parse().ok()?;
    (rounded / by == value && rounded.abs() >= 0.1 || value == 0.0).then_some(rounded)
}

/// One of six directions of the signer's own body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BodyDirection {
    /// To the signer's left.
    Left,
    /// To the signer's right.
    Right,
    /// Upwards.
    Up,
    /// Downwards.
    Down,
    /// Away from the signer's chest; also written `out`.
    Forward,
    /// Towards the signer's back; also written `in`.
    Back,
}

impl BodyDirection {
    /// Every direction.
    pub const ALL_BODY_DIRECTIONS: [Self; 6] =
        [Self::Left, Self::Right, Self::Up, Self::Down, Self::Forward, Self::Back];

    /// Returns the word recipes print.
    #[must_use]
    pub fn body_direction_name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Up => "up",
            Self::Down => "down",
            Self::Forward => "forward",
            Self::Back => "back",
        }
    }

    /// Returns the direction that `word` names.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        match word {
            "out" | "forwards" | "front" => Some(Self::Forward),
            "in" | "backward" | "backwards" => Some(Self::Back),
            _ => Self::ALL_BODY_DIRECTIONS
                .into_iter()
                .find(|d| d.body_direction_name() == word),
        }
    }

    /// Returns the unit vector in body space: X to the left, Y up, Z forward.
    #[must_use]
    pub fn direction_unit_vector(self) -> DVec3 {
        match self {
            Self::Left => DVec3::X,
            Self::Right => DVec3::NEG_X,
            Self::Up => DVec3::Y,
            Self::Down => DVec3::NEG_Y,
            Self::Forward => DVec3::Z,
            Self::Back => DVec3::NEG_Z,
        }
    }
}

/// Returns the unit vector in body space half-way between directions; `None` if they cancel.
#[must_use]
pub fn mean_of_directions(directions: &[BodyDirection]) -> Option<DVec3> {
    directions
        .iter()
        .map(|d| d.direction_unit_vector())
        .sum::<DVec3>()
        .try_normalize()
}

/// The hand or hands an operator changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandChoice {
    /// The signer's right hand.
    Right,
    /// The signer's left hand.
    Left,
    /// Both hands.
    Both,
    /// The hand that signs one-handed signs.
    Dominant,
    /// The other hand.
    Weak,
}

impl HandChoice {
    /// Every choice.
    pub const ALL_HAND_CHOICES: [Self; 5] = [Self::Right, Self::Left, Self::Both, Self::Dominant, Self::Weak];

    /// Returns the word recipes print.
    #[must_use]
    pub fn hand_choice_name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
            Self::Both => "both",
            Self::Dominant => "dominant",
            Self::Weak => "weak",
        }
    }

    /// Returns the choice that `word` names.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL_HAND_CHOICES
            .into_iter()
            .find(|hands| hands.hand_choice_name() == word)
    }

    /// Returns the sides of these hands for a signer of this handedness.
    #[must_use]
    pub fn chosen_sides(self, handedness: SignerHandedness) -> &'static [BodySide] {
        let side = match self {
            Self::Both => return &BodySide::BOTH_SIDES,
            Self::Right => BodySide::Right,
            Self::Left => BodySide::Left,
            Self::Dominant => handedness.signer_dominant_side(),
            Self::Weak => handedness.signer_dominant_side().opposite_side(),
        };
        match side {
            BodySide::Right => &[BodySide::Right],
            BodySide::Left => &[BodySide::Left],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn quantities_parse_as_people_write_them() {
        for (text, metres, printed) in [
            ("25cm", 0.25, "25cm"),
            ("250 mm", 0.25, "25cm"),
            ("0.25m", 0.25, "25cm"),
            ("10in", 0.254, "25.4cm"),
            ("7cm", 0.07, "7cm"),
            ("-3.5cm", -0.035, "-3.5cm"),
            ("1e2cm", 1.0, "100cm"),
            ("40%", 0.4 * 0.6, "40%"),
        ] {
            let length: RecipeLength = text.parse().expect(text);
            assert!((length.length_in_metres(0.6) - metres).abs() < 1e-15, "{text}");
            assert_eq!(length.to_string(), printed, "{text}");
        }
        assert_eq!("200ms".parse(), Ok(RecipeSeconds(0.2)));
        assert_eq!("150%".parse(), Ok(RecipeFactor(1.5)));
        assert_eq!("30°".parse(), Ok(RecipeDegrees(30.0)));
        for (text, want) in [
            ("25", "no unit"),
            ("25 miles", "unknown unit \"miles\""),
            ("cm", "no number"),
            ("1e999m", "no number"),
            ("", "no number"),
        ] {
            let error = text.parse::<RecipeLength>().expect_err(text).to_string();
            assert!(error.contains(want), "{text}: {error}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn printed_lengths_parse_to_the_same_length(metres in -3.0f64..3.0, share in any::<bool>()) {
            let length = if share { RecipeLength::Arm(metres) } else { RecipeLength::Metres(metres) };
            let back: RecipeLength = length.to_string().parse().expect("printed");
            prop_assert!((back.length_in_metres(1.0) - length.length_in_metres(1.0)).abs() < 1e-15);
            let cm = RecipeLength::Metres((metres * 1000.0).round() / 1000.0);
            prop_assert_eq!(cm.to_string().parse(), Ok(cm));
        }
    }
}
