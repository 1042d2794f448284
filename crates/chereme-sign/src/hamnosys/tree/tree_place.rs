//! Places of hands: on the body, on a hand, or in a constellation.

use serde::{Deserialize, Serialize};

use super::{DigitList, WrittenSymbols};

/// The place of the hands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HandPlace {
    /// On or before the body, or in the space before it.
    Body(BodyPlace),
    /// On a hand.
    Hand(HandSite),
    /// A constellation of the two hands.
    Hands(HandConstellation),
    /// One place for the dominant hand, then one for the other; a missing one keeps its previous value.
    Split(Option<Box<HandPlace>>, Option<Box<HandPlace>>),
    /// A place that the sign named before, 1 to 5.
    Named(u8),
}

/// A place on the body or in the space before it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BodyPlace {
    /// The place; `None` for mere neutral space.
    pub site: Option<SidedLocation<BodyLocation>>,
    /// A second place, if half-way between two is meant.
    pub second: Option<SidedLocation<BodyLocation>>,
    /// Whether the hand is behind it.
    pub behind: bool,
    /// The nearness of the hand.
    pub contact: Option<PlaceContact>,
    /// The part of the hand that is meant.
    pub by: Option<HandSite>,
    /// The number by which later parts of the sign refer to the place, 1 to 5.
    pub define: Option<u8>,
    /// Its spelling in text, if it differs from the printer's.
    #[serde(skip)]
    pub written: WrittenSymbols,
}

/// A location with its side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SidedLocation<L> {
    /// The location.
    pub at: L,
    /// The side.
    #[serde(default)]
    pub side: Option<LocationSide>,
    /// Whether it is only approximate.
    #[serde(default)]
    pub approx: bool,
}

/// Locations of the body and the arms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "each is what its name says")]
pub enum BodyLocation {
    Head,
    HeadTop,
    Forehead,
    Eyebrows,
    Eyes,
    UpperEyelid,
    LowerEyelid,
    Nose,
    Nostrils,
    Lips,
    UpperLip,
    LowerLip,
    Tongue,
    Teeth,
    UpperTeeth,
    LowerTeeth,
    Chin,
    UnderChin,
    Neck,
    Shoulders,
    ShoulderTop,
    Chest,
    Stomach,
    BelowStomach,
    Ear,
    EarLobe,
    Cheek,
    UpperArm,
    Elbow,
    ElbowInside,
    LowerArm,
    NeutralSpace,
}

/// A site on a hand or arm: the part, with its digits.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HandSite {
    /// The part; `None` for whole digits.
    pub at: Option<HandLocation>,
    /// The digits, if the part belongs to digits.
    pub digits: DigitList,
    /// The side.
    pub side: Option<LocationSide>,
    /// Whether it is only approximate.
    pub approx: bool,
    /// A second site, if half-way between two is meant.
    pub second: Option<Box<HandSite>>,
    /// The nearness of the other hand.
    pub contact: Option<PlaceContact>,
    /// The part of the acting hand that is meant.
    pub by: Option<Box<HandSite>>,
    /// The number by which later parts of the sign refer to the place, 1 to 5.
    pub define: Option<u8>,
    /// Its spelling in text, if it differs from the printer's.
    #[serde(skip)]
    pub written: WrittenSymbols,
}

/// Parts of the hand and the arm.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "each is what its name says")]
pub enum HandLocation {
    UpperArm,
    Elbow,
    ElbowInside,
    LowerArm,
    WristBack,
    ThumbBall,
    Palm,
    HandBack,
    ThumbSide,
    PinkySide,
    Tip,
    Nail,
    Pad,
    MidJoint,
    Base,
    Side,
}

/// A side of a location, always the signer's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "each is what its name says")]
pub enum LocationSide {
    LeftBeside,
    LeftAt,
    RightAt,
    RightBeside,
    Front,
    Back,
    Dorsal,
    Palmar,
    Radial,
    Ulnar,
}

/// The nearness of a hand to a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PlaceContact {
    /// It touches.
    Touch,
    /// It is close.
    Close,
    /// The hands interlock.
    Interlock,
    /// The hands cross.
    Cross,
    /// As far as the arm reaches.
    ArmExtended,
    /// It brushes along.
    Brushing,
}

/// A constellation: the two hands relative to each other, and their common place.
///
/// Without any site, a contact alone refers to whatever is in front of the hand: the other hand, or the
/// place it was close to.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HandConstellation {
    /// The site of the dominant hand.
    pub dominant: Option<HandSite>,
    /// The site of the other hand.
    pub other: Option<HandSite>,
    /// Their nearness to each other.
    pub contact: Option<PlaceContact>,
    /// The common place of the two.
    pub at: Option<BodyPlace>,
    /// The number by which later parts of the sign refer to the place, 1 to 5.
    pub define: Option<u8>,
    /// Its spelling in text, if it differs from the printer's.
    #[serde(skip)]
    pub written: WrittenSymbols,
}
