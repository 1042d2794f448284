//! The settings of a recipe's sources, and the words that they share with operators: transitions, spots, hands, legs.

use serde::{Deserialize, Serialize};

use crate::cue_timing::PhaseRule;
use crate::units::{BodyDirection, HandChoice, RecipeFactor, RecipeLength, RecipeSeconds};

/// A transition from one posture to the next: `via sigmoid 0.2s`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PostureTransition {
    /// The course; the default is the sigmoid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<TransitionProfile>,
    /// The time it takes; by default the operator chooses, from the material if it can.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<RecipeSeconds>,
}

impl PostureTransition {
    /// Returns whether every setting is the default.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// The course of a transition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TransitionProfile {
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

impl TransitionProfile {
    /// Every course.
    pub const ALL_TRANSITION_PROFILES: [Self; 5] = [
        Self::Slerp,
        Self::Cosine,
        Self::Sigmoid,
        Self::MinimumJerk,
        Self::Learned,
    ];

    /// Returns the word recipes print.
    #[must_use]
    pub fn transition_profile_name(self) -> &'static str {
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
pub struct SpellSettings {
    /// The word to spell.
    pub word: String,
    /// The hand that spells.
    #[serde(default = "dominant_hand_choice")]
    pub hand: HandChoice,
    /// The inventory with the letters; `None` for the corpus's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alphabet: Option<String>,
    /// The time for which each letter is held; the default is the median of the corpus's letters, else 0.2 s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold: Option<RecipeSeconds>,
    /// The transition from letter to letter.
    #[serde(default, skip_serializing_if = "PostureTransition::is_default")]
    pub via: PostureTransition,
    /// The signer whose body spells; `None` lets the corpus choose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

/// Cued speech: `cue "le chat dort" dominant by paper pace 1.6 on signer:1`, `cue "l=87 @=131" as sampa`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CueSettings {
    /// The text, or phones separated by blanks; `a=120` is a phone of 120 ms.
    pub text: String,
    /// The alphabet of the phones: `sampa`, `ipa` or `mfa`; `None` if the text is in ordinary spelling.
    #[serde(rename = "as", default, skip_serializing_if = "Option::is_none")]
    pub phones: Option<String>,
    /// The code; the default is French.
    #[serde(rename = "with", default, skip_serializing_if = "Option::is_none")]
    pub code: Option<String>,
    /// Habits of the cuer by their names, and `no-liaison`, `schwa-said`, `schwa-dropped`.
    #[serde(rename = "variant", default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<String>,
    /// The hand that cues; never both.
    #[serde(default = "dominant_hand_choice")]
    pub hand: HandChoice,
    /// The rule for the times of the hand.
    #[serde(rename = "by", default, skip_serializing_if = "PhaseRule::is_default")]
    pub phase: PhaseRule,
    /// The factor on the usual durations of sounds, if the phones have no times; the default is 1.6.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pace: Option<RecipeFactor>,
    /// The signer whose body cues; `None` lets the corpus choose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

/// Movement from notation: `hamnosys "…" with default on signer:1`, `sigml HUIS`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NotationSettings {
    /// The symbols of the sign, or the name of notation in the corpus.
    pub of: String,
    /// The body language: `default` for the program's own, `measured` for measurements in the corpus's captured signs,
    /// or a file; the default is `measured`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<String>,
    /// The signer whose body signs; `None` lets the corpus choose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

/// A pointing gesture: `point right at 30cm,140cm,50cm with U hold 0.3s via sigmoid 0.5s on signer:1`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointSettings {
    /// The hand that points.
    #[serde(default = "dominant_hand_choice")]
    pub hand: HandChoice,
    /// The target.
    pub at: SigningSpot,
    /// The hand's shape; the default is the index finger's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<ValueChoice>,
    /// The time for which the gesture stays at its apex; the default is 0.3 s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold: Option<RecipeSeconds>,
    /// The transitions of reaching and retraction; course and time are by default those of the corpus's captured reaches,
    /// and no wrist is faster than captured ones.
    #[serde(default, skip_serializing_if = "PostureTransition::is_default")]
    pub via: PostureTransition,
    /// The signer whose body points; `None` lets the corpus choose.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
}

pub(crate) fn dominant_hand_choice() -> HandChoice {
    HandChoice::Dominant
}

pub(crate) fn both_hands_choice() -> HandChoice {
    HandChoice::Both
}

/// The source of a value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ValueChoice {
    /// The present value; written `_`.
    Keep,
    /// A value of an inventory by its name.
    Value(String),
    /// The value of another sign, by its address: `from LION`.
    From(String),
    /// The value of the best answer to a query: `best(configuration=U signer=same)`.
    Best(String),
}

/// A straight leg of a path: `left 25cm`, `right up 10cm` (the diagonal), `down 20cm in 0.4s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StraightLeg {
    /// The directions; the leg goes half-way between them.
    pub towards: Vec<BodyDirection>,
    /// Its length.
    pub distance: RecipeLength,
    /// The time it takes; only a path has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<RecipeSeconds>,
}

/// A point of the hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RecipeHandPoint {
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

impl RecipeHandPoint {
    /// Every point.
    pub const ALL_HAND_POINTS: [Self; 7] = [
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
    pub fn hand_point_name(self) -> &'static str {
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

/// The method that finds an arm's posture from the wrist's place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ArmSolverMethod {
    /// Two bones in closed form, the elbow turned as in the source.
    #[default]
    Analytic,
    /// FABRIK, as in the founding paper.
    Fabrik,
}

impl ArmSolverMethod {
    /// Every solver.
    pub const ALL_ARM_SOLVERS: [Self; 2] = [Self::Analytic, Self::Fabrik];

    /// Returns the word that recipes print.
    #[must_use]
    pub fn arm_solver_name(self) -> &'static str {
        match self {
            Self::Analytic => "analytic",
            Self::Fabrik => "fabrik",
        }
    }

    /// Returns whether this is the default method.
    #[must_use]
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

/// A place in the signing space that signs refer to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum SigningSpot {
    /// The signer's own chest.
    Me,
    /// The person in front of the signer.
    You,
    /// A direction from the chest, such as `left` or `right forward`.
    Towards(Vec<BodyDirection>),
    /// A placement of an inventory.
    Value(String),
    /// A point of body space: to the left, up from the floor, and forward.
    Point([RecipeLength; 3]),
}
