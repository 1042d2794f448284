//! The result of a recipe: movement, its annotations, and the report.

use chereme_motion::{Clip, Side, Span};
use chereme_sign::{Component, Handedness, Reading};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

use chereme_motion::Anatomy;

use crate::language::Language;

/// A made sign or utterance.
#[derive(Debug, Clone, PartialEq)]
pub struct Made {
    /// The movement.
    pub clip: Clip,
    /// Which joint of its skeleton is what.
    pub anatomy: Arc<Anatomy>,
    /// Which hand the signer signs with.
    pub handedness: Handedness,
    /// Whose body moves, where known.
    pub signer: Option<String>,
    /// How much there is of each non-manual at each frame.
    pub curves: Vec<Curve>,
    /// The annotations.
    pub notes: Vec<Note>,
    /// How it came about.
    pub report: Report,
}

/// A scalar curve beside a clip, a value a frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The part and the code of SiGML: `head.SH`, `brows.RB`, `mouth.L04`, `mouthing.hYs`.
    pub name: String,
    /// From 0, nothing of it, to 1, all of it.
    pub values: Vec<f64>,
}

/// Something said about a stretch of made movement; the corpus makes annotations of these.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Note {
    /// The hand; nothing for glosses and non-manual components.
    pub hand: Option<Side>,
    /// What is said.
    pub about: About,
    /// The value.
    pub value: Reading,
    /// The time, from the first frame.
    pub span: Span,
    /// Where the movement of that stretch comes from.
    pub origin: String,
}

/// The subject of a note.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum About {
    /// The gloss of the sign that the stretch was made from.
    Gloss,
    /// A component, and its part if the note is not about the whole.
    Component(Component, Option<String>),
    /// Movement synthesised between two pieces or values.
    Transition,
    /// Cued speech.
    Cue(CueTier),
}

/// The subject of a note of cued speech.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CueTier {
    /// A phone in SAMPA.
    Phones,
    /// A key, from the start of its first sound to the end of its last: the gloss of a token.
    Keys,
    /// The hand on its way to a key, from M1 to M2.
    Hand,
    /// The fingers changing for a key, from D1 to D2.
    Fingers,
}

impl CueTier {
    /// Returns the name of the tier.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Phones => "Phones",
            Self::Keys => "Keys",
            Self::Hand => "Hand M1 M2",
            Self::Fingers => "Fingers D1 D2",
        }
    }
}

/// How a made sign came about, for people and for `--explain`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Report {
    /// The steps in the order in which they were taken.
    pub steps: Vec<StepReport>,
    /// For each channel of the body, where its movement comes from.
    pub channels: Vec<ChannelReport>,
    /// The places at which pieces of movement meet.
    pub joins: Vec<JoinReport>,
    /// Contacts of the sources that an operator undid, and by how much.
    #[serde(default)]
    pub contacts: Vec<String>,
    /// Reasons for caution about the result.
    pub warnings: Vec<String>,
}

/// One step that was taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepReport {
    /// Where it stands in the recipe's JSON, such as `/pipe/steps/0`.
    pub path: String,
    /// The source or operator as text.
    pub step: String,
    /// The effects, in a few words.
    pub did: Vec<String>,
    /// The largest distance in metres between where a wrist should have come and where it came.
    pub residual: Option<f64>,
    /// The way by which a placement moved the hands: metres to the signer's left, up and forward.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moved: Option<[f64; 3]>,
    /// The body language that notation was animated with, if it is not the usual one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<Language>,
    /// Of notation: how near each hand came to what is written.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hands: Vec<HandReport>,
}

/// How near a hand came to what is written; the worst of all frames.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HandReport {
    /// The hand.
    pub hand: Side,
    /// How far it is off its way, in metres.
    pub off_m: f64,
    /// How far it stays short of what it touches, in metres.
    pub short_m: f64,
    /// How far it is turned from what is written, in degrees.
    pub turned_deg: f64,
    /// How far it was moved out of the trunk, in metres.
    pub pushed_m: f64,
}

/// Where the movement of a channel comes from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChannelReport {
    /// The channel: `right fingers`, `left arm`, `head`, `trunk`.
    pub channel: String,
    /// The sources, then the operators that changed it, in order.
    pub from: Vec<String>,
}

/// How well two pieces of movement meet at one end of a transition, at a wrist.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JoinReport {
    /// What is joined.
    pub what: String,
    /// The hand.
    pub hand: Side,
    /// The transition.
    pub span: Span,
    /// How far the wrist is from where its speed would have brought it, in metres; the larger of both ends.
    pub position: f64,
    /// The change of velocity in metres per second; the larger of both ends.
    pub velocity: f64,
    /// The change of acceleration in metres per second squared; the larger of both ends.
    pub acceleration: f64,
}
