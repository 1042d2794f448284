//! Motions of the hands: paths, circles, turns of the wrist, and their combinations.

use serde::{Deserialize, Serialize};

use super::{BodyLocation, Digits, Posture, Side, Written};
use crate::hamnosys::direction::{Compass, Direction};

/// A motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// The kind of motion.
    pub kind: MotionKind,
    /// Its manner.
    #[serde(default)]
    pub manner: Manner,
    /// Its spelling in text, if it differs from the printer's.
    #[serde(skip)]
    pub written: Written,
}

impl Motion {
    /// Returns a motion in the usual manner.
    #[must_use]
    pub fn new(kind: MotionKind) -> Self {
        Self {
            kind,
            manner: Manner::default(),
            written: Written::default(),
        }
    }
}

/// The kinds of motions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MotionKind {
    /// Along a path.
    Directed(Directed),
    /// Round and round.
    Circular(Circular),
    /// Of the wrist.
    Wrist {
        /// The direction.
        motion: WristMotion,
        /// The size.
        #[serde(default)]
        size: Option<Size>,
    },
    /// A cross is drawn: upright, or diagonal.
    Cross {
        /// Diagonal, like the letter X.
        diagonal: bool,
    },
    /// The fingers play: these digits, or all of them if empty.
    FingerPlay(Digits),
    /// Nothing moves.
    Still,
    /// An action of the body in place of the hand.
    Body(BodyAction),
    /// A motion for the dominant hand and one for the other; a hand without a motion stays as it is.
    Split(Option<Box<Motion>>, Option<Box<Motion>>),
    /// One after the other.
    Sequence {
        /// The motions.
        motions: Vec<Motion>,
        /// Whether they run into each other.
        #[serde(default)]
        fused: bool,
    },
    /// At the same time.
    Parallel(Vec<Motion>),
    /// A motion that ends in a posture; a change in place if there is no motion.
    Target {
        /// The motion that leads there.
        motion: Option<Box<Motion>>,
        /// The posture at its end.
        posture: Box<Posture>,
    },
    /// A motion that is repeated.
    Repeated {
        /// The motion.
        motion: Box<Motion>,
        /// The repetition.
        repetition: Repetition,
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
    pub side: Option<Side>,
    /// Its motion; `None` if it is only held.
    #[serde(default)]
    pub motion: Option<Box<Motion>>,
}

/// A path through space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Directed {
    /// Its direction.
    pub direction: Direction,
    /// A second direction, if half-way between two is meant.
    #[serde(default)]
    pub second: Option<Direction>,
    /// Its size.
    #[serde(default)]
    pub size: Amount,
    /// Its curve, if any.
    #[serde(default)]
    pub curve: Option<Curve>,
    /// Its zigzag or waves, if any.
    #[serde(default)]
    pub zigzag: Option<Zigzag>,
    /// The plane of the ellipse that it belongs to.
    #[serde(default)]
    pub ellipse: Option<Ellipse>,
}

/// A size, or the middle of two; the usual one if unset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Amount {
    /// The size.
    pub first: Option<Size>,
    /// A second one, if half-way between two is meant, or if a circle has two.
    pub second: Option<Size>,
}

/// Small or big.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Size {
    /// Smaller than usual.
    Small,
    /// Bigger than usual.
    Big,
}

/// The curve of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Curve {
    /// The side of the bulge, seen along the path: one of the eight directions about it.
    pub to: Compass,
    /// Its depth.
    #[serde(default)]
    pub size: Option<Size>,
}

/// A zigzag or wave along a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zigzag {
    /// Whether it runs in waves; in corners otherwise.
    pub wavy: bool,
    /// Its width.
    #[serde(default)]
    pub size: Option<Size>,
    /// Its growth, if any.
    #[serde(default)]
    pub growth: Option<Growth>,
}

/// Growth or shrinking during a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Growth {
    /// Whether it grows; it shrinks otherwise.
    pub increasing: bool,
    /// The amount.
    #[serde(default)]
    pub size: Option<Size>,
}

/// The long axis of an ellipse in its plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Ellipse {
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
pub struct Circular {
    /// The axis it turns about by the right-hand rule.
    pub axis: Direction,
    /// A second axis, if half-way between two is meant.
    #[serde(default)]
    pub second: Option<Direction>,
    /// Its size.
    #[serde(default)]
    pub size: Amount,
    /// The long axis, if it is an ellipse.
    #[serde(default)]
    pub ellipse: Option<Ellipse>,
    /// The narrowness of the ellipse.
    #[serde(default)]
    pub ellipse_size: Option<Size>,
    /// Its start, its end, and the number of turns.
    #[serde(default)]
    pub clock: Clock,
    /// Its zigzag or waves, if any.
    #[serde(default)]
    pub zigzag: Option<Zigzag>,
    /// Its growth, if any.
    #[serde(default)]
    pub growth: Option<Growth>,
}

/// The start and the end of a circle on its rim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Clock {
    /// The start.
    pub start: Option<Compass>,
    /// The end.
    pub end: Option<Compass>,
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
pub struct Manner {
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
pub struct Repetition {
    /// Its kind.
    pub repeat: Repeat,
    /// A second mark.
    #[serde(default)]
    pub second: Option<Repeat>,
    /// The growth from one repetition to the next.
    #[serde(default)]
    pub growth: Option<Growth>,
    /// The direction of the shift from each repetition to the next.
    #[serde(default)]
    pub shift: Option<Direction>,
    /// The size of that shift.
    #[serde(default)]
    pub shift_size: Option<Size>,
    /// The growth of the shifts.
    #[serde(default)]
    pub shift_growth: Option<Growth>,
    /// Whether it is only approximate.
    #[serde(default)]
    pub approx: bool,
}

impl Repetition {
    /// Returns a plain repetition, without growth or shift.
    #[must_use]
    pub const fn plain(repeat: Repeat) -> Self {
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
pub enum Repeat {
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
