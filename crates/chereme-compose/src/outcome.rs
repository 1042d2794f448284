//! The result of a recipe: movement, its annotations, and the report.

use chereme_motion::{BodySide, Clip, RecordingInstant, TimeSpan};
use chereme_sign::{ComponentReading, SignComponent, SignerHandedness};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

use chereme_motion::BodyAnatomy;

use crate::language::BodyLanguageChanges;

/// A generated sign or utterance.
#[derive(Debug, Clone, PartialEq)]
pub struct GeneratedMovement {
    /// The movement.
    pub clip: Clip,
    /// The parts of the body that the skeleton's joints are.
    pub anatomy: Arc<BodyAnatomy>,
    /// The hand with which the signer signs.
    pub handedness: SignerHandedness,
    /// The signer whose body moves, if known.
    pub signer: Option<String>,
    /// The amount of each non-manual at each frame.
    pub curves: Vec<GeneratedCurve>,
    /// The annotations.
    pub notes: Vec<GeneratedNote>,
    /// The steps, sources and accuracy of the result.
    pub report: GenerationReport,
}

/// A scalar curve of a clip, with a value per frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GeneratedCurve {
    /// The part and the code of SiGML: `head.SH`, `brows.RB`, `mouth.L04`, `mouthing.hYs`.
    pub name: String,
    /// The amount, from 0 to 1.
    pub values: Vec<f64>,
}

/// A statement about a span of generated movement; the corpus turns these into annotations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct GeneratedNote {
    /// The hand; `None` for glosses and non-manual components.
    pub hand: Option<BodySide>,
    /// The subject.
    pub about: NoteSubject,
    /// The value.
    pub value: ComponentReading,
    /// The time, from the first frame.
    pub span: TimeSpan,
    /// The source of the movement in that span.
    pub origin: String,
}

/// The subject of a note.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoteSubject {
    /// The gloss of the sign from which the span was generated.
    Gloss,
    /// A component, and its part if the note is not about the whole.
    Component(SignComponent, Option<String>),
    /// Movement synthesised between two pieces or values.
    Transition,
    /// Cued speech.
    Cue(CueTier),
}

/// The tier of cued speech to which a note belongs.
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
    pub fn cue_tier_name(self) -> &'static str {
        match self {
            Self::Phones => "Phones",
            Self::Keys => "Keys",
            Self::Hand => "Hand M1 M2",
            Self::Fingers => "Fingers D1 D2",
        }
    }
}

/// The steps, sources and accuracy of a generated sign, for people and for `--explain`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GenerationReport {
    /// The steps in the order in which they were taken.
    pub steps: Vec<StepReport>,
    /// The source of movement for each channel of the body.
    pub channels: Vec<ChannelReport>,
    /// The places at which pieces of movement meet.
    pub joins: Vec<JoinReport>,
    /// Contacts of the sources that an operator lost, with distances.
    #[serde(default)]
    pub contacts: Vec<String>,
    /// Reasons for caution about the result.
    pub warnings: Vec<String>,
}

/// One step that was taken.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StepReport {
    /// Its path in the recipe's JSON, such as `/pipe/steps/0`.
    pub path: String,
    /// The source or operator as text.
    pub step: String,
    /// The effects, in a few words.
    pub did: Vec<String>,
    /// The largest distance between a wrist and its target, in metres.
    pub residual: Option<f64>,
    /// The displacement of the hands by a placement: metres to the signer's left, up and forward.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moved: Option<[f64; 3]>,
    /// The body language that animated the notation, if it is not the default one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub language: Option<BodyLanguageChanges>,
    /// The accuracy of each hand, for notation.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hands: Vec<HandReport>,
    /// The touches of the hands, for movement on another body.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub touches: Vec<TouchReport>,
}

/// A touch of a hand after its movement was put on another body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TouchReport {
    /// The point of the hand, such as `right-index-tip`.
    pub point: String,
    /// The touched place or point of the other hand, such as `chin` or `left-palm`.
    pub place: String,
    /// The moment at which they are nearest.
    pub at: RecordingInstant,
    /// Their distance at that moment on the former body, in metres.
    pub was_m: f64,
    /// Their distance on this body, in metres.
    pub now_m: f64,
    /// The distance by which the point is off against the place, in metres.
    pub off_m: f64,
    /// The longest shift of a wrist for it, in metres.
    pub moved_m: f64,
}

/// The largest deviations of a hand from its notation over all frames.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HandReport {
    /// The hand.
    pub hand: BodySide,
    /// The distance from its path, in metres.
    pub off_m: f64,
    /// The distance from the place that it should touch, in metres.
    pub short_m: f64,
    /// The rotation away from the notated one, in degrees.
    pub turned_deg: f64,
    /// The distance by which it was moved out of the trunk, in metres.
    pub pushed_m: f64,
}

/// The sources of the movement of a channel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChannelReport {
    /// The channel: `right fingers`, `left arm`, `head`, `trunk`.
    pub channel: String,
    /// The sources, then the operators that changed it, in order.
    pub from: Vec<String>,
}

/// The smoothness of a join at one end of a transition, at a wrist.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JoinReport {
    /// The joined pieces.
    pub what: String,
    /// The hand.
    pub hand: BodySide,
    /// The transition.
    pub span: TimeSpan,
    /// The distance of the wrist from the position that its speed predicts, in metres; the larger of both ends.
    pub position: f64,
    /// The change of velocity in metres per second; the larger of both ends.
    pub velocity: f64,
    /// The change of acceleration in metres per second squared; the larger of both ends.
    pub acceleration: f64,
}
