//! The evaluator's questions to the outside: the one trait that a corpus implements.

use std::sync::Arc;

use chereme_motion::{BodyAnatomy, BodySide, Clip, HandAngles, TimeSpan};
use chereme_sign::hamnosys::NotatedSign;
use chereme_sign::inventory::{BodyLandmark, ComponentInventory, InventoryValue};
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones};
use chereme_sign::{ComponentReading, SignComponent, SignerHandedness};
use serde::{Deserialize, Serialize};

use crate::cue_timing::CuePhases;
use crate::error::SourceError;
use crate::language::BodyLanguageChanges;
use crate::outcome::GeneratedCurve;
use crate::poses::DonorCoding;

/// The source of movement, values and examples for recipes; a corpus implements it.
///
/// All questions are asked while a recipe is resolved, none during evaluation. Answers must depend on
/// the corpus only: the same question gives the same answer in the same order.
pub trait RecipeSources {
    /// Returns the movement at an address as written: a gloss, `token:41`, `sign:LIMACE`.
    ///
    /// # Errors
    /// [`SourceError::Missing`] if nothing has that address, [`SourceError::Ambiguous`] if several things have it,
    /// [`SourceError::NoMovement`] for a lexicon entry without movement.
    fn find_material(&self, address: &str) -> Result<MovementMaterial, SourceError>;

    /// Returns the body that performs the movement at an address of [`material`](Self::find_material), if that is a notation,
    /// which has no body of its own.
    ///
    /// # Errors
    /// [`SourceError`] if the corpus cannot be read.
    fn performer(&self, _address: &str) -> Result<Option<BodyInput>, SourceError> {
        Ok(None)
    }

    /// Returns a body at rest, for movement without a recording: one or more frames of a neutral posture of the signer
    /// (an address), or of one that the corpus chooses.
    ///
    /// # Errors
    /// [`SourceError`] if there is no such signer, or no movement at all.
    fn stage(&self, signer: Option<&str>) -> Result<MovementMaterial, SourceError>;

    /// Returns the value of `component` that `text` names: by id, by a name in any language, or by
    /// its notation.
    ///
    /// # Errors
    /// [`SourceError::UnknownValue`] with the value that was probably meant.
    fn find_component_value(&self, component: SignComponent, text: &str) -> Result<ComponentValue, SourceError>;

    /// Returns every value of `component` in the inventories, in their order.
    fn list_component_values(&self, component: SignComponent) -> Vec<ComponentValue>;

    /// Returns the tokens with movement that have the value with this id, best examples first.
    ///
    /// # Errors
    /// [`SourceError`] if the corpus cannot be read.
    fn holding(&self, component: SignComponent, value: &str) -> Result<Vec<TokenExample>, SourceError>;

    /// Returns the tokens with movement that answer `query`, best first; `signer=same` in it means
    /// the signer given here.
    ///
    /// # Errors
    /// [`SourceError::Query`] if the query is not understood.
    fn find_best_examples(&self, query: &str, signer: Option<&str>) -> Result<Vec<TokenExample>, SourceError>;

    /// Returns the signs of the notation named `name`: a SiGML file in the corpus, or the notation of a sign.
    ///
    /// # Errors
    /// [`SourceError::Missing`] if no notation has that name.
    fn find_named_notation(&self, name: &str) -> Result<Vec<NotatedSign>, SourceError> {
        Err(SourceError::Missing {
            address: name.to_owned(),
            nearest: None,
        })
    }

    /// Returns the body language for animating notation: `default`, a file, or, for `measured` and by default, the
    /// one measured in captured movement, the signer's own if there is enough of it.
    ///
    /// # Errors
    /// [`SourceError::Language`] if a file is not a body language; [`SourceError::Unreadable`].
    fn body_language(&self, _named: Option<&str>, _signer: Option<&str>) -> Result<BodyLanguageChanges, SourceError> {
        Ok(BodyLanguageChanges::default())
    }

    /// Returns an expression of the face with its milestones: that of `function` at the address, or the only one there.
    ///
    /// # Errors
    /// [`SourceError::Expression`] if nothing there has milestones, or several things have; those of
    /// [`material`](Self::find_material).
    fn find_face_expression(&self, address: &str, function: Option<&str>) -> Result<ExpressionSource, SourceError> {
        let _ = function;
        Err(SourceError::Expression {
            address: address.to_owned(),
            why: "it has no milestones".to_owned(),
            remedy: None,
        })
    }

    /// Returns the letters of `word` in an alphabet, or in the corpus's usual one.
    ///
    /// # Errors
    /// [`SourceError::UnknownAlphabet`], or [`SourceError::UnknownLetter`] with the first letter that the alphabet
    /// lacks.
    fn find_alphabet_letters(&self, alphabet: Option<&str>, word: &str) -> Result<Vec<AlphabetLetter>, SourceError>;

    /// Returns the usual courses of the corpus's own transitions and reaches; `None` if there are too few.
    ///
    /// # Errors
    /// [`SourceError`] if the corpus cannot be read.
    fn learned_profile(&self) -> Result<Option<LearnedProfile>, SourceError> {
        Ok(None)
    }

    /// Returns the phases of the corpus's captured keys of cued speech; `None` if there are too few.
    ///
    /// # Errors
    /// [`SourceError`] if the corpus cannot be read.
    fn cue_phases(&self) -> Result<Option<CuePhases>, SourceError> {
        Ok(None)
    }

    /// Returns the times for which the corpus's hands hold a configuration and change to the next.
    ///
    /// # Errors
    /// [`SourceError`] if the corpus cannot be read.
    fn spelling_times(&self) -> Result<SpellingTimes, SourceError> {
        Ok(SpellingTimes::default())
    }
}

/// The usual courses of a corpus's transitions, for each channel with enough of them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LearnedProfile {
    /// The course of wrists from place to place; if missing, that of the fingers is used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arms: Option<LearnedCourse>,
    /// The course of fingers from shape to shape; if missing, that of the arms is used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingers: Option<LearnedCourse>,
    /// The reaches among the transitions of the wrists, for pointing; missing if there are too few.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reaches: Option<LearnedReaches>,
}

/// The usual reach: how a hand goes from rest to a far place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LearnedReaches {
    /// The course of the wrist.
    pub course: LearnedCourse,
    /// The median of their mean speeds, in metres per second.
    pub speed: f64,
}

/// The usual course of transitions, as `learn_course` finds it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LearnedCourse {
    /// Shares of the path at equal steps of time, from 0 to 1.
    pub shares: Vec<f64>,
    /// The number of transitions that it was learned from.
    pub transitions: usize,
    /// The names of their recordings.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<String>,
}

impl LearnedProfile {
    /// Returns the course of reaches, if they are known; else that of the arms, or the fingers' if it is missing.
    #[must_use]
    pub fn of_arms(&self) -> Option<&LearnedCourse> {
        let reaches = self.reaches.as_ref().map(|reaches| &reaches.course);
        reaches.or(self.arms.as_ref()).or(self.fingers.as_ref())
    }

    /// Returns the course of the fingers, or the arms' if it is missing.
    #[must_use]
    pub fn of_fingers(&self) -> Option<&LearnedCourse> {
        self.fingers.as_ref().or_else(|| self.of_arms())
    }
}

/// The times for which hands hold a configuration, and change from one to the next.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpellingTimes {
    /// The time of a hold; `None` if there are too few.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold: Option<MedianTime>,
    /// The time from the end of one hold to the start of the next; `None` if there are too few.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change: Option<MedianTime>,
}

/// A median of times.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MedianTime {
    /// The median in seconds.
    pub seconds: f64,
    /// The number of times measured.
    pub count: usize,
}

/// A piece of movement with its annotations.
#[derive(Debug, Clone, PartialEq)]
pub struct MovementMaterial {
    /// Its unambiguous address, such as `token:41`.
    pub address: String,
    /// A hash of the movement, as the corpus computes it; equal movements have equal hashes.
    pub hash: String,
    /// Its gloss.
    pub gloss: String,
    /// The address of the signer, if known.
    pub signer: Option<String>,
    /// The hand with which the signer signs.
    pub handedness: SignerHandedness,
    /// The movement; times in `held` count from its first frame.
    pub clip: Clip,
    /// The parts of the body that its joints are.
    pub anatomy: Arc<BodyAnatomy>,
    /// Its component values, in any order.
    pub held: Vec<HeldValue>,
    /// Its scalar curves, with a value per frame.
    pub curves: Vec<GeneratedCurve>,
}

/// An expression of the face with the movement that contains it.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpressionSource {
    /// The movement, at least from M1 to M5 as far as it was recorded.
    pub material: MovementMaterial,
    /// The function of the expression in the signs that it spans.
    pub function: ExpressionFunction,
    /// Its milestones, from the first frame of the movement on.
    pub milestones: ExpressionMilestones,
}

/// A value of a component over a span of a piece of movement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeldValue {
    /// The hand; `None` for non-manual components.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hand: Option<BodySide>,
    /// The component.
    pub component: SignComponent,
    /// The part of the component, such as `brows` or `palm`; `None` for the whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature: Option<String>,
    /// The value: an id of an inventory if it has one.
    pub value: ComponentReading,
    /// The time, from the movement's first frame.
    pub span: TimeSpan,
}

/// A value of an inventory with its meaning for a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ComponentValue {
    /// The id under which annotations name it.
    pub id: String,
    /// The id of the inventory.
    pub inventory: String,
    /// Its meaning, if the inventory gives one.
    pub meaning: Option<ValueMeaning>,
}

/// The meaning of a value for a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ValueMeaning {
    /// A posture of the hand.
    Hand(HandAngles),
    /// A place.
    Place(BodyRelativePlace),
}

/// A place relative to a signer's body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyRelativePlace {
    /// The landmark's name, as [`BodyAnatomy::landmark_place_position`] spells it; `ipsi-` and `contra-` at its start
    /// stand for the acting hand's own and other side.
    pub landmark: String,
    /// Offset from the landmark to the left, up and forward in shoulder widths; with `ipsi-` and `contra-` the first
    /// counts away from the body's middle.
    pub offset: [f64; 3],
}

impl From<&BodyLandmark> for BodyRelativePlace {
    fn from(landmark: &BodyLandmark) -> Self {
        Self {
            landmark: landmark.name.clone(),
            offset: landmark.offset,
        }
    }
}

impl ComponentValue {
    /// Returns a value of an inventory with its meaning for a body.
    #[must_use]
    pub fn value_from_inventory(inventory: &ComponentInventory, value: &InventoryValue) -> Self {
        let hand = value.pose.map(ValueMeaning::Hand);
        let place = || value.landmark.as_ref().map(|at| ValueMeaning::Place(at.into()));
        Self {
            id: value.id.clone(),
            inventory: inventory.id.clone(),
            meaning: hand.or_else(place),
        }
    }
}

/// A token that is an example of something, with the hand and span that show it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TokenExample {
    /// Its address, such as `token:41`.
    pub address: String,
    /// Its signer's address, if known.
    pub signer: Option<String>,
    /// The hand that shows it; `None` if it is unknown.
    pub hand: Option<BodySide>,
    /// The span, from the start of its movement; `None` for all of it.
    pub span: Option<TimeSpan>,
    /// Who coded it with the value.
    pub coding: DonorCoding,
}

/// A letter of a manual alphabet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AlphabetLetter {
    /// The letter as written.
    pub letter: String,
    /// Its configuration's value.
    pub value: ComponentValue,
    /// The direction of the straight fingers: left, up, forward for a right hand; `None` for up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingers: Option<[f64; 3]>,
    /// The direction of the palm, in the same form; `None` for forward.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub palm: Option<[f64; 3]>,
    /// The strokes of the hand during the letter; empty if it is held still.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub strokes: Vec<LetterStroke>,
}

/// One stroke of a letter that moves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LetterStroke {
    /// The displacement to the left, up and forward in shoulder widths, for a right hand.
    #[serde(rename = "way")]
    pub displacement: [f64; 3],
    /// The rotation of the forearm during the stroke in radians, positive when the palm turns to face up.
    pub turn: f64,
}

/// The body that was found for a notation.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyInput {
    /// Its unambiguous address.
    pub address: String,
    /// The hash of its posture.
    pub hash: String,
}

/// The signer whose movement an operator changes.
#[derive(Clone)]
pub(crate) struct MaterialSigner {
    pub(crate) signer: Option<String>,
    pub(crate) handedness: SignerHandedness,
}

impl MaterialSigner {
    pub(crate) fn signer_from_material(material: &MovementMaterial) -> Self {
        Self {
            signer: material.signer.clone(),
            handedness: material.handedness,
        }
    }
}
