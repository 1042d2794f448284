//! Handshapes: a class, with its modifiers.

use serde::{Deserialize, Serialize};

use super::WrittenSymbols;

/// A handshape: its class with its modifiers.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Handshape {
    /// The class with its thumb and bend.
    pub form: HandshapeForm,
    /// A second form, if the handshape is half-way between two.
    pub between: Option<HandshapeForm>,
    /// Whether it is only approximate.
    pub approx: bool,
    /// Spread of the fingers: 0, 1 or 2; `None` for the class's usual spread.
    pub splay: Option<u8>,
    /// The selected fingers, if they differ from the class's own.
    pub special: DigitList,
    /// Fingers that the bend does not apply to.
    pub exempt: DigitList,
    /// The digit that the thumb meets, if it differs from the class's own.
    pub opposed: Option<HandDigit>,
    /// Bends of single digits, thumb first.
    pub bends: [Option<FingerBend>; 5],
    /// Fingers that touch each other or are crossed; two at most.
    pub contacts: Vec<FingerContact>,
    /// A detail of the thumb's position.
    pub thumb: Option<ThumbExtra>,
    /// Its spelling in text, if it differs from the printer's.
    #[serde(skip)]
    pub written: WrittenSymbols,
}

/// A class of handshapes with thumb position and bend.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HandshapeForm {
    /// The class.
    pub class: HandClass,
    /// The position of the thumb; alongside if `None`.
    pub thumb: Option<ThumbPosition>,
    /// The bend of the selected fingers.
    pub bend: Option<FingerBend>,
    /// The opening of a cee; text writes it as the thumb's position.
    pub opening: Option<CeeOpening>,
}

/// The twelve classes of handshapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandClass {
    /// All fingers closed.
    #[default]
    Fist,
    /// All fingers extended, side by side.
    Flat,
    /// The index finger extended.
    Finger2,
    /// Index and middle finger extended, side by side.
    Finger23,
    /// Index and middle finger extended and spread.
    Finger23Spread,
    /// Four fingers extended and spread.
    Finger2345,
    /// Thumb and index finger pinched, the others closed.
    Pinch12,
    /// Thumb and index finger pinched, the others extended.
    Pinch12Open,
    /// The thumb pinched against all fingers.
    PinchAll,
    /// Thumb and index finger curved towards each other, the others closed.
    Cee12,
    /// Thumb and index finger curved towards each other, the others extended.
    Cee12Open,
    /// The thumb and all fingers curved towards each other.
    CeeAll,
}

/// Positions of the thumb.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ThumbPosition {
    /// Stretched out sideways.
    Out,
    /// Across the palm or the closed fingers.
    Across,
    /// Opposed to the fingers.
    Opposed,
}

/// The distance between the thumb of a cee and the fingers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CeeOpening {
    /// Nearer than usual.
    Tight,
    /// Further than usual.
    Slack,
}

/// The bends of a finger's three joints, from the palm outwards: 0 straight, 4 fully bent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FingerBend {
    /// At the base joint: 4 0 0.
    Bent,
    /// Slightly at all joints: 2 2 2.
    Round,
    /// At the middle and end joints: 0 4 4.
    Hooked,
    /// At base and middle joints: 4 4 0.
    DoubleBent,
    /// At all joints: 4 4 4.
    DoubleHooked,
    /// At the base joint, half-way: 2 0 0.
    HalfBent,
    /// As given, joint by joint.
    Joints([f64; 3]),
}

impl FingerBend {
    /// Returns the bend of each joint, from the palm outwards: 0 straight, 4 fully bent.
    #[must_use]
    pub fn joint_bends(self) -> [f64; 3] {
        match self {
            Self::Bent => [4.0, 0.0, 0.0],
            Self::Round => [2.0, 2.0, 2.0],
            Self::Hooked => [0.0, 4.0, 4.0],
            Self::DoubleBent => [4.0, 4.0, 0.0],
            Self::DoubleHooked => [4.0, 4.0, 4.0],
            Self::HalfBent => [2.0, 0.0, 0.0],
            Self::Joints(joints) => joints,
        }
    }
}

/// A digit; notation counts from the thumb, 1 to 5.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandDigit {
    /// The thumb, 1.
    Thumb,
    /// The index finger, 2.
    Index,
    /// The middle finger, 3.
    Middle,
    /// The ring finger, 4.
    Ring,
    /// The little finger, 5.
    Little,
}

impl HandDigit {
    /// Every digit from the thumb.
    pub const ALL_HAND_DIGITS: [Self; 5] = [Self::Thumb, Self::Index, Self::Middle, Self::Ring, Self::Little];

    /// Returns its number in notation, 1 to 5.
    #[must_use]
    pub fn digit_number(self) -> u8 {
        self as u8 + 1
    }
}

/// Digits of a hand in the order of writing, without duplicates.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct DigitList(pub Vec<HandDigit>);

impl DigitList {
    /// Returns whether there are no digits.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns whether this digit is included.
    #[must_use]
    pub fn contains_digit(&self, digit: HandDigit) -> bool {
        self.0.contains(&digit)
    }
}

/// Two digits of a hand that touch or cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FingerContact {
    /// The digit that lies upon the other.
    pub first: HandDigit,
    /// The other.
    pub second: HandDigit,
    /// The part of the second digit that the first one meets.
    #[serde(default)]
    pub part: Option<FingerPart>,
}

/// Details of the thumb's position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ThumbExtra {
    /// Between two fingers.
    Between(HandDigit, HandDigit),
    /// Enclosed by the fingers.
    Enclosed,
    /// It touches this part of a finger.
    Contact(FingerPart),
}

/// A part of a finger.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FingerPart {
    /// The tip.
    Tip,
    /// The nail.
    Nail,
    /// The pad.
    Pad,
    /// The middle joint.
    MidJoint,
    /// The base.
    Base,
    /// The side.
    Side,
}
