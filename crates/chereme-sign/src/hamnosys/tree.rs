//! The tree of a sign as notation describes it.
//!
//! The parts and their names follow gestural SiGML 1.2; HamNoSys text says the same in symbols. What
//! a spelling leaves unsaid is `None` here, never a default: a reader of the tree decides.

use serde::{Deserialize, Serialize};

use super::direction::{Compass, Direction};

/// A sign: what the hands do, part after part.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sign {
    /// The parts of a compound in their order; one for a simple sign.
    pub parts: Vec<Manual>,
}

/// What the hands do in one part of a sign.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Manual {
    /// Which hands act.
    pub hands: HandsUsed,
    /// The hands keep what the part before ended with.
    pub holdover: bool,
    /// What the body does while the sign begins.
    pub body: Vec<BodyAction>,
    /// The posture it begins with.
    pub posture: Posture,
    /// What is done from there, in order.
    pub actions: Vec<Motion>,
    /// How text spelled this part, where it is not as the printer would.
    #[serde(skip)]
    pub written: Written,
}

/// Which hands act in a sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HandsUsed {
    /// The dominant hand alone.
    #[default]
    Dominant,
    /// The other hand alone.
    Nondominant,
    /// Both, the second following the first by a symmetry.
    Both(Symmetry),
}

/// How the second hand follows the dominant one.
///
/// Without any of the mirrors both do the same (parallel).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Symmetry {
    /// Left and right are exchanged.
    pub left_right: bool,
    /// Up and down are exchanged.
    pub up_down: bool,
    /// Out and in are exchanged.
    pub out_in: bool,
    /// The second hand is half a period behind.
    pub out_of_phase: bool,
    /// Places are meant in real space, not on each hand's own side.
    pub real_space: bool,
}

/// What is said of the hands: nothing, one thing for both, or a thing for each.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Each<T> {
    /// Nothing is said: as it was, or as is usual.
    #[default]
    Unset,
    /// For every acting hand; the second takes it through the symmetry.
    Shared(T),
    /// For the dominant hand, then for the other; what is missing stays as it was.
    Split(Option<T>, Option<T>),
}

impl<T> Each<T> {
    /// Returns what is said of the dominant hand.
    #[must_use]
    pub fn dominant(&self) -> Option<&T> {
        match self {
            Self::Unset => None,
            Self::Shared(one) => Some(one),
            Self::Split(dominant, _) => dominant.as_ref(),
        }
    }

    /// Returns what is said of the other hand in words of its own, no symmetry needed.
    #[must_use]
    pub fn other(&self) -> Option<&T> {
        match self {
            Self::Split(_, other) => other.as_ref(),
            _ => None,
        }
    }

    /// Tells whether nothing is said.
    #[must_use]
    pub fn is_unset(&self) -> bool {
        matches!(self, Self::Unset)
    }
}

/// A posture of the hands, part by part; what is unset stays as it was.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Posture {
    /// The handshape.
    pub shape: Each<Handshape>,
    /// Where the hand's own axis points, from the wrist to the middle knuckle.
    pub extended: Each<Aim<Direction>>,
    /// Where the palm faces, as an angle about that axis.
    pub palm: Each<Aim<Compass>>,
    /// Where the hands are.
    pub place: Option<Place>,
}

impl Posture {
    /// Tells whether it says nothing at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// A direction, or the middle of two.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Aim<D> {
    /// The direction.
    pub first: D,
    /// The second one where half-way between is meant.
    #[serde(default = "none", skip_serializing_if = "Option::is_none")]
    pub second: Option<D>,
    /// Only roughly so.
    #[serde(default)]
    pub approx: bool,
    /// What it is relative to.
    #[serde(default)]
    pub frame: Frame,
}

fn none<D>() -> Option<D> {
    None
}

impl<D> Aim<D> {
    /// Returns an aim straight in one direction.
    pub const fn at(first: D) -> Self {
        Self {
            first,
            second: None,
            approx: false,
            frame: Frame::Plain,
        }
    }
}

/// What a direction is relative to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Frame {
    /// As usual: the signer's body.
    #[default]
    Plain,
    /// The body, said expressly.
    Absolute,
    /// The movement's direction, or the place on the body.
    Relative,
}

/// A handshape: its class with what modifies it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Handshape {
    /// The class with its thumb and bend.
    pub form: Form,
    /// A second form where half-way between is meant.
    pub between: Option<Form>,
    /// Only roughly so.
    pub approx: bool,
    /// How far fingers are spread: 0, 1 or 2; as is the class's nature where unset.
    pub splay: Option<u8>,
    /// The fingers selected, where not the class's own.
    pub special: Digits,
    /// Fingers that the bend does not apply to.
    pub exempt: Digits,
    /// The digit that the thumb meets, where not the class's own.
    pub opposed: Option<Digit>,
    /// Bends of single digits, thumb first.
    pub bends: [Option<Bend>; 5],
    /// Fingers that touch each other or are crossed; two at most.
    pub contacts: Vec<FingerContact>,
    /// Where the thumb is, beyond its position.
    pub thumb: Option<ThumbExtra>,
    /// How text spelled it, where not as the printer would.
    #[serde(skip)]
    pub written: Written,
}

/// A class of handshapes with thumb position and bend.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Form {
    /// The class.
    pub class: HandClass,
    /// Where the thumb is; alongside where unset.
    pub thumb: Option<ThumbPosition>,
    /// The bend of the selected fingers.
    pub bend: Option<Bend>,
    /// How far a cee is open; text writes it as the thumb's position.
    pub opening: Option<Opening>,
}

/// The twelve classes of handshapes.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default, Serialize, Deserialize,
)]
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

/// Where the thumb is.
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

/// How far the thumb of a cee is from the fingers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Opening {
    /// Nearer than usual.
    Tight,
    /// Further than usual.
    Slack,
}

/// How far a finger's three joints are bent, from the palm outwards: 0 straight, 4 as far as goes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Bend {
    /// At the base joint: 4 0 0.
    Bent,
    /// At all joints a little: 2 2 2.
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

impl Bend {
    /// Returns how far each joint is bent, from the palm outwards: 0 straight, 4 as far as goes.
    #[must_use]
    pub fn joints(self) -> [f64; 3] {
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

/// A digit, thumb first as notation counts them: 1 to 5.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Digit {
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

impl Digit {
    /// Every digit from the thumb.
    pub const ALL: [Self; 5] = [
        Self::Thumb,
        Self::Index,
        Self::Middle,
        Self::Ring,
        Self::Little,
    ];

    /// Returns the number notation gives it, 1 to 5.
    #[must_use]
    pub fn number(self) -> u8 {
        self as u8 + 1
    }
}

/// Digits of a hand, in the order they are written, none twice.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Digits(pub Vec<Digit>);

impl Digits {
    /// Tells whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Tells whether this digit is among them.
    #[must_use]
    pub fn contains(&self, digit: Digit) -> bool {
        self.0.contains(&digit)
    }
}

/// Two digits of a hand that touch or cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FingerContact {
    /// The digit that lies upon the other.
    pub first: Digit,
    /// The other.
    pub second: Digit,
    /// The part of the second digit that is met.
    #[serde(default)]
    pub part: Option<FingerPart>,
}

/// Where the thumb is, beyond its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ThumbExtra {
    /// Between two fingers.
    Between(Digit, Digit),
    /// Enclosed by the fingers.
    Enclosed,
    /// It touches this part of the fingers.
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

/// Where the hands are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// On or before the body, or in the space before it.
    Body(BodyPlace),
    /// On a hand.
    Hand(HandSite),
    /// The two hands by each other.
    Hands(Constellation),
    /// A place of its own for the dominant hand and for the other; what is missing stays as it was.
    Split(Option<Box<Place>>, Option<Box<Place>>),
    /// A place that the sign named before, 1 to 5.
    Named(u8),
}

/// A place on the body or in the space before it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BodyPlace {
    /// The place; nothing where only neutral space is said.
    pub site: Option<Site<BodyLocation>>,
    /// A second one where half-way between is meant.
    pub second: Option<Site<BodyLocation>>,
    /// Behind it.
    pub behind: bool,
    /// How near the hand comes.
    pub contact: Option<Contact>,
    /// Which part of the hand is meant.
    pub by: Option<HandSite>,
    /// The number under which the place is called up later, 1 to 5.
    pub define: Option<u8>,
    /// How text spelled it, where not as the printer would.
    #[serde(skip)]
    pub written: Written,
}

/// A location with the side of it that is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Site<L> {
    /// The location.
    pub at: L,
    /// The side.
    #[serde(default)]
    pub side: Option<Side>,
    /// Only roughly there.
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

/// A site on a hand or arm: the part, and of which digits.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HandSite {
    /// The part; nothing where whole digits are meant.
    pub at: Option<HandLocation>,
    /// The digits, where it is a part of digits.
    pub digits: Digits,
    /// The side.
    pub side: Option<Side>,
    /// Only roughly there.
    pub approx: bool,
    /// A second site where half-way between is meant.
    pub second: Option<Box<HandSite>>,
    /// How near the other hand comes.
    pub contact: Option<Contact>,
    /// Which part of the acting hand is meant.
    pub by: Option<Box<HandSite>>,
    /// The number under which the place is called up later, 1 to 5.
    pub define: Option<u8>,
    /// How text spelled it, where not as the printer would.
    #[serde(skip)]
    pub written: Written,
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
pub enum Side {
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

/// How near the hand comes to a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Contact {
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

/// The two hands by each other, and where they are together.
///
/// With neither site, a contact alone is with whatever the hand has before it: the other hand, or the
/// place it was close to.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Constellation {
    /// The site of the dominant hand.
    pub dominant: Option<HandSite>,
    /// The site of the other hand.
    pub other: Option<HandSite>,
    /// How near they come to each other.
    pub contact: Option<Contact>,
    /// Where the two are.
    pub at: Option<BodyPlace>,
    /// The number under which the place is called up later, 1 to 5.
    pub define: Option<u8>,
    /// How text spelled it, where not as the printer would.
    #[serde(skip)]
    pub written: Written,
}

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
    /// What it does; nothing where it is only held.
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

/// The symbols that text spelled a part with, where they are not those the printer would choose.
///
/// Two parts are equal whatever their spelling. Whoever changes a part drops its spelling
/// (`Written::default()`).
#[derive(Debug, Clone, Default)]
pub struct Written(pub Option<Box<str>>);

impl PartialEq for Written {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
