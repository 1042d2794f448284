//! Motions of the hands: paths, circles, turns of the wrist, and their combinations.

use serde::{Deserialize, Serialize};

use super::{BodyLocation, DigitList, LocationSide, NotatedPosture, WrittenSymbols};
use crate::hamnosys::direction::{CompassDirection, SpatialDirection};

/// A motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NotatedMotion {
    /// The kind of motion.
    pub kind: MotionKind,
    /// Its manner.
    #[serde(default)]
    pub manner: MotionManner,
    /// Its spelling in text, if it differs from the printer's.
    #[serde(skip)]
    pub written: WrittenSymbols,
}

impl NotatedMotion {
    /// Returns a motion in the usual manner.
    #[must_use]
    pub fn new(kind: MotionKind) -> Self {
        Self {
            kind,
            manner: MotionManner::default(),
            written: WrittenSymbols::default(),
        }
    }
}

/// The kinds of motions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MotionKind {
    /// Along a path.
    Directed(DirectedPath),
    /// Round and round.
    Circular(CircularPath),
    /// Of the wrist.
    Wrist {
        /// The direction.
        motion: WristMotion,
        /// The size.
        #[serde(default)]
        size: Option<MotionSize>,
    },
    /// A cross is drawn: upright, or diagonal.
    Cross {
        /// Diagonal, like the letter X.
        diagonal: bool,
    },
    /// The fingers play: these digits, or all of them if empty.
    FingerPlay(DigitList),
    /// Nothing moves.
    Still,
    /// An action of the body in place of the hand.
    Body(BodyAction),
    /// A motion for the dominant hand and one for the other; a hand without a motion stays as it is.
    Split(Option<Box<NotatedMotion>>, Option<Box<NotatedMotion>>),
    /// One after the other.
    Sequence {
        /// The motions.
        motions: Vec<NotatedMotion>,
        /// Whether they run into each other.
        #[serde(default)]
        fused: bool,
    },
    /// At the same time.
    Parallel(Vec<NotatedMotion>),
    /// A motion that ends in a posture; a change in place if there is no motion.
    Target {
        /// The motion that leads there.
        motion: Option<Box<NotatedMotion>>,
        /// The posture at its end.
        posture: Box<NotatedPosture>,
    },
    /// A motion that is repeated.
    Repeated {
        /// The motion.
        motion: Box<NotatedMotion>,
        /// The repetition.
        repetition: MotionRepetition,
    },
}

/// An action of a part of the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyAction {
    /// The acting part.
    pub part: BodyLocation,
    /// Its side.
    #[serde(default)]
    pub side: Option<LocationSide>,
    /// Its motion; `None` if it is only held.
    #[serde(default)]
    pub motion: Option<Box<NotatedMotion>>,
}

/// A path through space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DirectedPath {
    /// Its direction.
    pub direction: SpatialDirection,
    /// A second direction, if half-way between two is meant.
    #[serde(default)]
    pub second: Option<SpatialDirection>,
    /// Its size.
    #[serde(default)]
    pub size: SizeAmount,
    /// Its curve, if any.
    #[serde(default)]
    pub curve: Option<PathCurve>,
    /// Its zigzag or waves, if any.
    #[serde(default)]
    pub zigzag: Option<PathZigzag>,
    /// The plane of the ellipse that it belongs to.
    #[serde(default)]
    pub ellipse: Option<EllipseAxis>,
}

/// A size, or the middle of two; the usual one if unset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SizeAmount {
    /// The size.
    pub first: Option<MotionSize>,
    /// A second one, if half-way between two is meant, or if a circle has two.
    pub second: Option<MotionSize>,
}

/// Small or big.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MotionSize {
    /// Smaller than usual.
    Small,
    /// Bigger than usual.
    Big,
}

/// The curve of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathCurve {
    /// The side of the bulge, seen along the path: one of the eight directions about it.
    pub to: CompassDirection,
    /// Its depth.
    #[serde(default)]
    pub size: Option<MotionSize>,
}

/// A zigzag or wave along a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathZigzag {
    /// Whether it runs in waves; in corners otherwise.
    pub wavy: bool,
    /// Its width.
    #[serde(default)]
    pub size: Option<MotionSize>,
    /// Its growth, if any.
    #[serde(default)]
    pub growth: Option<MotionGrowth>,
}

/// Growth or shrinking during a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionGrowth {
    /// Whether it grows; it shrinks otherwise.
    pub increasing: bool,
    /// The amount.
    #[serde(default)]
    pub size: Option<MotionSize>,
}

/// The long axis of an ellipse in its plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EllipseAxis {
    /// Horizontal.
    Horizontal,
    /// Rising to the right.
    UpRight,
    /// Vertical.
    Vertical,
    /// Rising to the left.
    UpLeft,
}

/// A circle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CircularPath {
    /// The axis it turns about by the right-hand rule.
    pub axis: SpatialDirection,
    /// A second axis, if half-way between two is meant.
    #[serde(default)]
    pub second: Option<SpatialDirection>,
    /// Its size.
    #[serde(default)]
    pub size: SizeAmount,
    /// The long axis, if it is an ellipse.
    #[serde(default)]
    pub ellipse: Option<EllipseAxis>,
    /// The narrowness of the ellipse.
    #[serde(default)]
    pub ellipse_size: Option<MotionSize>,
    /// Its start, its end, and the number of turns.
    #[serde(default)]
    pub clock: ClockRange,
    /// Its zigzag or waves, if any.
    #[serde(default)]
    pub zigzag: Option<PathZigzag>,
    /// Its growth, if any.
    #[serde(default)]
    pub growth: Option<MotionGrowth>,
}

/// The start and the end of a circle on its rim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClockRange {
    /// The start.
    pub start: Option<CompassDirection>,
    /// The end.
    pub end: Option<CompassDirection>,
    /// Additional full turns, 0 to 2.
    pub full: u8,
}

/// A motion of the wrist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum WristMotion {
    /// Up and down, as if the hand said yes.
    Nodding,
    /// From side to side.
    Swinging,
    /// About the forearm.
    Twisting,
    /// Clockwise, as if stirring.
    StirCw,
    /// Counter-clockwise.
    StirCcw,
}

/// The manner of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "the notation's own marks, free of each other"
)]
pub struct MotionManner {
    /// Fast.
    pub fast: bool,
    /// Slow.
    pub slow: bool,
    /// Tense.
    pub tense: bool,
    /// After a rest.
    pub rest: bool,
    /// It stops suddenly.
    pub halt: bool,
    /// It bounces back from its end.
    pub bouncing: bool,
    /// The hands alternate.
    pub alternating: bool,
    /// The hands alternate, marked a second time after a repetition.
    pub second_alternating: bool,
    /// Relative to the body even if the hand's frame is turned.
    pub absolute: bool,
    /// A factor on the speed, 1 by default; present in some files.
    pub speed: Option<f64>,
}

/// The repetition of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MotionRepetition {
    /// Its kind.
    pub repeat: RepeatKind,
    /// A second mark.
    #[serde(default)]
    pub second: Option<RepeatKind>,
    /// The growth from one repetition to the next.
    #[serde(default)]
    pub growth: Option<MotionGrowth>,
    /// The direction of the shift from each repetition to the next.
    #[serde(default)]
    pub shift: Option<SpatialDirection>,
    /// The size of that shift.
    #[serde(default)]
    pub shift_size: Option<MotionSize>,
    /// The growth of the shifts.
    #[serde(default)]
    pub shift_growth: Option<MotionGrowth>,
    /// Whether it is only approximate.
    #[serde(default)]
    pub approx: bool,
}

impl MotionRepetition {
    /// Returns a plain repetition, without growth or shift.
    #[must_use]
    pub const fn plain_repetition(repeat: RepeatKind) -> Self {
        Self {
            repeat,
            second: None,
            growth: None,
            shift: None,
            shift_size: None,
            shift_growth: None,
            approx: false,
        }
    }
}

/// A kind of repetition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RepeatKind {
    /// Once more, from its start.
    FromStart,
    /// Several times more, from its start.
    FromStartSeveral,
    /// To and fro.
    ToFro,
    /// Many times, at random.
    ManyRandom,
    /// Once more, from its end.
    Continue,
    /// Several times more, from its end.
    ContinueSeveral,
    /// Back along the same path.
    Reverse,
    /// With the hands exchanged.
    Swap,
}
