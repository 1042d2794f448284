//! The tree of a recipe: sources, the operators applied to them, and utterances.

use serde::{Deserialize, Serialize};

use crate::cue::PhaseRule;
use crate::units::{Degrees, Direction, Factor, Hands, Length, Seconds};

/// How a made clip comes about, as text (`ESCARGOT | configure right U`) and as JSON.
///
/// Both spellings are the same tree: [`str::parse`] and [`Display`](std::fmt::Display) give and
/// take the text, serde the JSON, which carries a version:
/// `{"version": 1, "make": {"pipe": {"of": {"sign": "CLAIR"}, "steps": ["reverse"]}}}`.
/// Unknown fields and versions from the future are refused by name. A recipe names its sources and
/// holds no other recipe by reference, so that there are no cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "crate::json::Versioned", into = "crate::json::Versioned")]
pub struct Recipe {
    pub(crate) root: Node,
}

/// A part of a recipe that gives movement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Node {
    /// A sign of the corpus by its address as written: a gloss, `token:41`, `sign:LIMACE`.
    Sign(String),
    /// A word in a manual alphabet.
    Spell(Spell),
    /// A pointing gesture.
    Point(Point),
    /// Cued speech.
    Cue(Cue),
    /// A sign written in HamNoSys.
    Hamnosys(Notation),
    /// The signs of a SiGML file, or a notated sign, that the corpus knows.
    Sigml(Notation),
    /// Movement with operators applied to it, in order.
    Pipe(Pipe),
    /// One piece of movement after another.
    Then(Then),
}

/// Operators applied to a piece of movement, in order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pipe {
    /// The operand of the first operator; never itself a pipe once normalised.
    pub of: Box<Node>,
    /// The operators; at least one once normalised.
    pub steps: Vec<Step>,
}

/// Pieces of movement one after another, joined by transitions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Then {
    /// The first piece.
    pub first: Box<Node>,
    /// The pieces that follow; at least one once normalised.
    pub next: Vec<Joined>,
}

/// A piece of movement that follows another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Joined {
    /// How the piece before it leads into it.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
    /// The piece.
    pub node: Node,
}

/// How one posture leads to the next: `via sigmoid 0.2s`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transition {
    /// The course of the way; without one the sigmoid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// The time it takes; by default the operator chooses, from the material if it can.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<Seconds>,
}

impl Transition {
    /// Returns whether every setting is the default.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// The course of a transition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Profile {
    /// Constant angular speed (eq. 1 of Naert, Larboulette & Gibet 2021).
    Slerp,
    /// The cosine blend (eq. 2).
    Cosine,
    /// The sigmoid blend (eq. 3), stretched to start at 0 and end at 1.
    #[default]
    Sigmoid,
    /// The path of least jerk from rest to rest.
    MinimumJerk,
    /// The mean course of the corpus's own transitions.
    Learned,
}

impl Profile {
    /// Every course.
    pub const ALL: [Self; 5] = [
        Self::Slerp,
        Self::Cosine,
        Self::Sigmoid,
        Self::MinimumJerk,
        Self::Learned,
    ];

    /// Returns the word recipes print.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Slerp => "slerp",
            Self::Cosine => "cosine",
            Self::Sigmoid => "sigmoid",
            Self::MinimumJerk => "minimum-jerk",
            Self::Learned => "learned",
        }
    }
}

/// A word in a manual alphabet: `spell LSF with lsf dominant hold 0.2s via sigmoid 0.25s on signer:1`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spell {
    /// The word.
    pub word: String,
    /// The hand that spells.
    #[serde(default = "dominant")]
    pub hand: Hands,
    /// The inventory with the letters; without one the corpus's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alphabet: Option<String>,
    /// How long each letter is held; without one as long as the corpus's letters are, else 0.2 s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold: Option<Seconds>,
    /// From letter to letter.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
    /// Whose body spells; without one the corpus chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

/// Cued speech: `cue "le chat dort" dominant by paper pace 1.6 on signer:1`, `cue "l=87 @=131" as sampa`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cue {
    /// The text, or phones separated by blanks; `a=120` is a phone of 120 ms.
    pub text: String,
    /// The alphabet of the phones: `sampa`, `ipa` or `mfa`; without one the text is in ordinary spelling.
    #[serde(rename = "as", default, skip_serializing_if = "Option::is_none")]
    pub phones: Option<String>,
    /// The code; without one French.
    #[serde(rename = "with", default, skip_serializing_if = "Option::is_none")]
    pub code: Option<String>,
    /// Habits of the cuer by their names, and `no-liaison`, `schwa-said`, `schwa-dropped`.
    #[serde(rename = "variant", default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<String>,
    /// The hand that cues; never both.
    #[serde(default = "dominant")]
    pub hand: Hands,
    /// When the hand is where.
    #[serde(rename = "by", default, skip_serializing_if = "PhaseRule::is_default")]
    pub phase: PhaseRule,
    /// How many times longer than usual sounds last if the phones have no times; without one 1.6.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pace: Option<Factor>,
    /// Whose body cues; without one the corpus chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

/// Movement from notation: `hamnosys "…" with default on signer:1`, `sigml HUIS`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Notation {
    /// The symbols of the sign, or the name of what the corpus knows as notation.
    pub of: String,
    /// The body language: `default` for the program's own, `measured` for what the corpus's captured
    /// signs show, or a file; without one what is measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<String>,
    /// Whose body signs; without one the corpus chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

/// A pointing gesture: `point right at 30cm,140cm,50cm with U hold 0.3s via sigmoid 0.5s on signer:1`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// The hand that points.
    #[serde(default = "dominant")]
    pub hand: Hands,
    /// What is pointed at.
    pub at: Spot,
    /// The hand's shape; without one the index finger's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<Choice>,
    /// How long the gesture stays at its apex; without one 0.3 s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold: Option<Seconds>,
    /// Reaching and retraction; without a time 0.5 s each.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
    /// Whose body points; without one the corpus chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

fn dominant() -> Hands {
    Hands::Dominant
}

fn both() -> Hands {
    Hands::Both
}

/// One operator with its settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Step {
    /// Gives the hands other configurations.
    Configure(Configure),
    /// Moves the hands elsewhere.
    Place(Place),
    /// Plays the movement backwards.
    Reverse,
    /// Exchanges what the two arms do, across the body's sagittal plane.
    Swap,
    /// Makes one arm do the mirror image of what the other does.
    Mirror(Mirror),
    /// Plays the movement several times.
    Repeat(Repeat),
    /// Turns the hands.
    Orient(Orient),
    /// Makes the hands' movement larger or smaller.
    Amplify(Amplify),
    /// Carries the hands along a path.
    Travel(Travel),
    /// Makes the movement faster or slower.
    Retime(Retime),
    /// Takes head and face from another sign.
    Nonmanual(Nonmanual),
    /// Makes a directional verb start or end elsewhere.
    Indicate(Indicate),
    /// Keeps a part of the movement and leaves the rest out.
    Span(Cut),
    /// Keeps the activity: rest before and after it goes, odd first and last frames with it.
    Trim,
}

impl Step {
    /// The word that begins each operator; directional verbs begin with either of the last two.
    pub const WORDS: [&'static str; 15] = [
        "configure",
        "place",
        "reverse",
        "swap",
        "mirror",
        "repeat",
        "orient",
        "amplify",
        "travel",
        "retime",
        "nonmanual",
        "span",
        "trim",
        "from",
        "to",
    ];

    /// Returns the operator's name.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Configure(_) => "configure",
            Self::Place(_) => "place",
            Self::Reverse => "reverse",
            Self::Swap => "swap",
            Self::Mirror(_) => "mirror",
            Self::Repeat(_) => "repeat",
            Self::Orient(_) => "orient",
            Self::Amplify(_) => "amplify",
            Self::Travel(_) => "travel",
            Self::Retime(_) => "retime",
            Self::Nonmanual(_) => "nonmanual",
            Self::Indicate(_) => "indicate",
            Self::Span(_) => "span",
            Self::Trim => "trim",
        }
    }
}

/// Where a value comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Choice {
    /// The value that is there already; written `_`.
    Keep,
    /// A value of an inventory by its name.
    Value(String),
    /// The value of another sign, by its address: `from LION`.
    From(String),
    /// The value of the best answer to a query: `best(configuration=U signer=same)`.
    Best(String),
}

/// Settings of `configure right U`, `configure both from LION`, `configure right U, S`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Configure {
    /// The hands that change.
    #[serde(default = "dominant")]
    pub hand: Hands,
    /// One value for the whole sign, or one for each configuration that the sign holds in turn.
    pub values: Vec<Choice>,
    /// Into and out of each value, and from one to the next.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
}

/// Settings of `place both by left 25cm`, `place right at chin`, `place left near BOL`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The hands that move, as one body where both do.
    #[serde(default = "both")]
    pub hand: Hands,
    /// Where to.
    pub to: Goal,
    /// The point of the hand that comes to the goal; without one the point that touches the body in the sign, else
    /// the palm. `by` moves all points alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<HandPoint>,
    /// The way the arm's posture is found; `using fabrik`.
    #[serde(default, skip_serializing_if = "Solver::is_default")]
    pub solver: Solver,
}

/// Where hands are placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Goal {
    /// Moved by the sum of these, each in the signer's own directions.
    By(Vec<Leg>),
    /// At a placement of an inventory.
    At(String),
    /// At a point of body space: metres to the left, up from the floor, and forward.
    AtPoint([Length; 3]),
    /// Where the hand is in another sign, by its address, and moved on from there.
    Near {
        /// The other sign.
        of: String,
        /// How far beside it.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        by: Vec<Leg>,
    },
    /// Where the hand is in the best answer to a query.
    Best(String),
}

/// A straight way: `left 25cm`, `right up 10cm` (the diagonal), `down 20cm in 0.4s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Leg {
    /// The directions, half-way between which the way goes.
    pub towards: Vec<Direction>,
    /// Its length.
    pub distance: Length,
    /// The time it takes; only a path has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<Seconds>,
}

/// A point of the hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandPoint {
    /// The wrist joint.
    Wrist,
    /// The middle of the palm.
    Palm,
    /// The tip of the thumb.
    Thumb,
    /// The tip of the index finger.
    Index,
    /// The tip of the middle finger.
    Middle,
    /// The tip of the ring finger.
    Ring,
    /// The tip of the little finger.
    Little,
}

impl HandPoint {
    /// Every point.
    pub const ALL: [Self; 7] = [
        Self::Wrist,
        Self::Palm,
        Self::Thumb,
        Self::Index,
        Self::Middle,
        Self::Ring,
        Self::Little,
    ];

    /// Returns the word recipes print.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wrist => "wrist",
            Self::Palm => "palm",
            Self::Thumb => "thumb",
            Self::Index => "index",
            Self::Middle => "middle",
            Self::Ring => "ring",
            Self::Little => "little",
        }
    }
}

/// How an arm's posture is found from the wrist's place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Solver {
    /// Two bones in closed form, the elbow turned as in the source.
    #[default]
    Analytic,
    /// FABRIK, as the founding paper has it.
    Fabrik,
}

impl Solver {
    /// Returns whether this is the usual one.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// Settings of `mirror right`: the arm that is copied; without one the dominant.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mirror {
    /// The arm whose movement the other arm takes; never both.
    #[serde(default = "dominant")]
    pub from: Hands,
}

/// Settings of `repeat 3 scale 0.8 tempo 1.2 gap 0.1s`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Repeat {
    /// How often the movement is played, from 1 on.
    pub times: u32,
    /// The factor for the size of the hands' movement from each repetition to the next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Factor>,
    /// The factor for the speed from each repetition to the next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tempo: Option<Factor>,
    /// The time between two repetitions, the transition included.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap: Option<Seconds>,
    /// The course between two repetitions; without one slerp, as the founding paper has it.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
}

/// Settings of `orient right palm up`, `orient right fingers forward palm down`, `orient both by 30deg about up`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Orient {
    /// The hands that turn.
    #[serde(default = "dominant")]
    pub hand: Hands,
    /// Where the palm faces in the middle of the sign.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub palm: Vec<Direction>,
    /// Where the fingers would point if they were straight.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fingers: Vec<Direction>,
    /// Turns about the signer's own directions, right-handed, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by: Vec<Turn>,
}

/// A turn about one of the signer's directions: `30deg about up`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// How far; positive is counter-clockwise seen against the direction.
    pub angle: Degrees,
    /// The direction turned about.
    pub about: Direction,
}

/// Settings of `amplify both 1.5`: the hands' paths grow about their middle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Amplify {
    /// The hands whose movement changes, about one middle where both do.
    #[serde(default = "both")]
    pub hand: Hands,
    /// The factor for distances from the middle of the movement.
    pub by: Factor,
}

/// Settings of `travel right down 20cm then up 20cm`, and of
/// `travel right through 10cm,5cm,0cm then 20cm,0cm,0cm in 1.2s`: along straight legs, or along a smooth curve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Travel {
    /// The hands that travel.
    #[serde(default = "dominant")]
    pub hand: Hands,
    /// The legs, one after another; those without a time share the rest by their length.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<Leg>,
    /// The points of a curve that is taken instead of legs, each so far to the left of where the hands would be, up and
    /// forward.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub through: Vec<[Length; 3]>,
    /// The time that the curve takes; without one all of the movement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<Seconds>,
    /// The course along each way; without one minimum jerk.
    #[serde(default, skip_serializing_if = "Transition::is_default")]
    pub via: Transition,
}

/// Settings of `retime 150%`, `retime to 2s`, `retime 100%, 50%, to 1s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Retime {
    /// One pace for the whole sign, or one for each of its phases in turn.
    pub paces: Vec<Pace>,
}

/// How long something lasts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Pace {
    /// This times as long as it did.
    Times(Factor),
    /// This long.
    To(Seconds),
}

/// Settings of `nonmanual from TOKEN`: head and face of another sign, fitted to this one's time, and of
/// `nonmanual wh from recording:3 over 0.4s..1.9s by phases`: an expression carried over phase by phase.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Nonmanual {
    /// The other sign's address.
    pub from: String,
    /// The function of the expression, such as `wh`; without one the only expression that is there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub function: Option<String>,
    /// The part of this movement over which the expression lies; without one all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<Over>,
    /// Whether each phase of the expression is stretched onto the same phase here; else all of it evenly.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub by_phases: bool,
}

impl Nonmanual {
    /// Returns head and face of a whole sign, fitted to this one's time.
    #[must_use]
    pub fn of(from: impl Into<String>) -> Self {
        Self {
            from: from.into(),
            ..Self::default()
        }
    }

    /// Returns whether an expression with milestones is carried over, and not all of another sign.
    #[must_use]
    pub fn is_expression(&self) -> bool {
        self.by_phases || self.over.is_some() || self.function.is_some()
    }
}

/// Where an expression lies in a movement.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Over {
    /// Over the signs of this part, `0.4s..1.9s`: the milestones follow from them.
    Part(Cut),
    /// With these milestones M1 to M5, `0s, 0.4s, 1.2s, 1.9s, 2.4s`; M3 is M2 if one sign is spanned.
    At([Seconds; 5]),
}

/// Settings of `from me to left`: where a directional verb starts and ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Indicate {
    /// The hands that move; a hand that stays still away from the other keeps its place.
    #[serde(default = "both")]
    pub hand: Hands,
    /// Where the movement starts; without one where it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Spot>,
    /// Where the movement ends; without one where it did.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<Spot>,
}

/// Settings of `span 0.4s..1.9s`, `span 0.4s..`, `span ..1.9s`: the part of the movement that is kept.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cut {
    /// The time at which it begins; without one at the first frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Seconds>,
    /// The time before which it ends; without one after the last frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<Seconds>,
}

/// A place in the signing space that signs refer to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Spot {
    /// The signer's own chest.
    Me,
    /// The person in front of the signer.
    You,
    /// A direction from the chest, such as `left` or `right forward`.
    Towards(Vec<Direction>),
    /// A placement of an inventory.
    Value(String),
    /// A point of body space: to the left, up from the floor, and forward.
    Point([Length; 3]),
}
