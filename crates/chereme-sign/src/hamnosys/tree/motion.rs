//! What hands do: ways, circles, turns of the wrist, and how these are put together.

use serde::{Deserialize, Serialize};

use super::{BodyLocation, Digits, Posture, Side, Written};
use crate::hamnosys::direction::{Compass, Direction};

/// Something that moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// What is done.
    pub kind: MotionKind,
    /// How it is done.
    #[serde(default)]
    pub manner: Manner,
    /// How text spelled it, where not as the printer would.
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

/// What a motion is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MotionKind {
    /// Along a way.
    Directed(Directed),
    /// Round and round.
    Circular(Circular),
    /// Of the wrist.
    Wrist {
        /// Which way.
        motion: WristMotion,
        /// How far.
        #[serde(default)]
        size: Option<Size>,
    },
    /// A cross is drawn: upright, or diagonal.
    Cross {
        /// Diagonal, like the letter X.
        diagonal: bool,
    },
    /// The fingers play; these digits where not all.
    FingerPlay(Digits),
    /// Nothing moves.
    Still,
    /// The body does something instead of the hand.
    Body(BodyAction),
    /// A motion for the dominant hand and one for the other; a missing one keeps what it had.
    Split(Option<Box<Motion>>, Option<Box<Motion>>),
    /// One after the other.
    Sequence {
        /// The motions.
        motions: Vec<Motion>,
        /// They run into each other.
        #[serde(default)]
        fused: bool,
    },
    /// At the same time.
    Parallel(Vec<Motion>),
    /// A motion that ends in a posture; a replacement where there is no motion.
    Target {
        /// The way there.
        motion: Option<Box<Motion>>,
        /// The posture at its end.
        posture: Box<Posture>,
    },
    /// A motion that is repeated.
    Repeated {
        /// The motion.
        motion: Box<Motion>,
        /// How it is repeated.
        repetition: Repetition,
    },
}

/// A part of the body moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyAction {
    /// The part that moves.
    pub part: BodyLocation,
    /// The side of it.
    #[serde(default)]
    pub side: Option<Side>,
    /// Its motion; `None` if it is only held.
    #[serde(default)]
    pub motion: Option<Box<Motion>>,
}

/// A way through space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Directed {
    /// Where it goes.
    pub direction: Direction,
    /// A second direction where half-way between is meant.
    #[serde(default)]
    pub second: Option<Direction>,
    /// How far.
    #[serde(default)]
    pub size: Amount,
    /// It is curved.
    #[serde(default)]
    pub curve: Option<Curve>,
    /// It goes to and fro, or in waves.
    #[serde(default)]
    pub zigzag: Option<Zigzag>,
    /// The plane of the ellipse it is part of.
    #[serde(default)]
    pub ellipse: Option<Ellipse>,
}

/// A size, or the middle of two; as is usual where unset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Amount {
    /// The size.
    pub first: Option<Size>,
    /// A second one where half-way between is meant, or where a circle has two.
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

/// How a way is curved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Curve {
    /// The side it bulges to, seen along the way: one of the eight directions about it.
    pub to: Compass,
    /// How deep.
    #[serde(default)]
    pub size: Option<Size>,
}

/// A way that goes to and fro.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Zigzag {
    /// In waves, not in corners.
    pub wavy: bool,
    /// How wide.
    #[serde(default)]
    pub size: Option<Size>,
    /// It grows or shrinks.
    #[serde(default)]
    pub growth: Option<Growth>,
}

/// Something grows or shrinks as it goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Growth {
    /// It grows; else it shrinks.
    pub increasing: bool,
    /// By how much.
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
    /// A second axis where half-way between is meant.
    #[serde(default)]
    pub second: Option<Direction>,
    /// Its size.
    #[serde(default)]
    pub size: Amount,
    /// The plane of the ellipse it is.
    #[serde(default)]
    pub ellipse: Option<Ellipse>,
    /// How narrow the ellipse is.
    #[serde(default)]
    pub ellipse_size: Option<Size>,
    /// Where it begins and ends, and how many turns it makes.
    #[serde(default)]
    pub clock: Clock,
    /// It goes to and fro.
    #[serde(default)]
    pub zigzag: Option<Zigzag>,
    /// It grows or shrinks.
    #[serde(default)]
    pub growth: Option<Growth>,
}

/// Where on its rim a circle begins and ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Clock {
    /// Where it begins.
    pub start: Option<Compass>,
    /// Where it ends.
    pub end: Option<Compass>,
    /// Full turns beyond, 0 to 2.
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

/// How a motion is done.
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
    /// With a rest before it.
    pub rest: bool,
    /// It stops suddenly.
    pub halt: bool,
    /// It bounces back from its end.
    pub bouncing: bool,
    /// The hands alternate.
    pub alternating: bool,
    /// The hands alternate, said a second time after a repetition.
    pub second_alternating: bool,
    /// Relative to the body even where the hand's frame turned.
    pub absolute: bool,
    /// A factor of speed, 1 as usual; some files carry it.
    pub speed: Option<f64>,
}

/// How a motion is repeated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Repetition {
    /// How.
    pub repeat: Repeat,
    /// A second mark.
    #[serde(default)]
    pub second: Option<Repeat>,
    /// It grows or shrinks from one to the next.
    #[serde(default)]
    pub growth: Option<Growth>,
    /// Each begins further on, in this direction.
    #[serde(default)]
    pub shift: Option<Direction>,
    /// How far on.
    #[serde(default)]
    pub shift_size: Option<Size>,
    /// The steps grow or shrink.
    #[serde(default)]
    pub shift_growth: Option<Growth>,
    /// Only roughly so.
    #[serde(default)]
    pub approx: bool,
}

/// A kind of repetition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Repeat {
    /// Once more, from where it began.
    FromStart,
    /// Several times more, from where it began.
    FromStartSeveral,
    /// To and fro.
    ToFro,
    /// Many times, at random.
    ManyRandom,
    /// Once more, from where it ended.
    Continue,
    /// Several times more, from where it ended.
    ContinueSeveral,
    /// Back the way it came.
    Reverse,
    /// With the hands exchanged.
    Swap,
}
