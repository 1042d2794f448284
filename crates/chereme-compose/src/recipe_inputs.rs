//! The answers that were chosen for a recipe, in the form in which they are stored with it.

use std::collections::BTreeMap;

use chereme_sign::SignerHandedness;
use chereme_sign::hamnosys::NotatedSign;
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones};
use serde::{Deserialize, Serialize};

use crate::cue_timing::CuePhases;
use crate::language::BodyLanguageChanges;
use crate::poses::HandPose;
use crate::sources::{AlphabetLetter, BodyInput, BodyRelativePlace, HeldValue, LearnedProfile, SpellingTimes};

/// The chosen inputs of a recipe, by their paths in the recipe's JSON.
///
/// Spans, poses and places are stored here, so that better annotation, a better detector or new recordings never change
/// a sign that was generated before.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RecipeInputs(pub BTreeMap<String, RecipeInput>);

/// The choice for one path in a recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum RecipeInput {
    /// A source of movement.
    Material(MaterialInput),
    /// Postures of the hand.
    Poses(Vec<HandPose>),
    /// A place on or about the body.
    Place(PlaceInput),
    /// The letters of a word.
    Letters(Vec<LetterInput>),
    /// Signs as notation.
    Notation(Vec<NotatedSign>),
    /// Body language that differs from the default one.
    Language(BodyLanguageChanges),
    /// Learned courses of transitions: the progress of arms and fingers over time.
    Courses(LearnedProfile),
    /// The times of held letters, and of the change from one to the next.
    Times(SpellingTimes),
    /// Measured phases of cued speech.
    Phases(CuePhases),
    /// An expression of the face.
    Expression(ExpressionInput),
}

impl RecipeInput {
    /// Returns the addresses of the signs that gave postures or a place, but no movement.
    #[must_use]
    pub fn input_giver_addresses(&self) -> Vec<&str> {
        match self {
            Self::Poses(poses) => poses.iter().filter_map(HandPose::posture_giver_address).collect(),
            Self::Letters(letters) => {
                let poses = letters.iter().map(|letter| &letter.pose);
                poses.filter_map(HandPose::posture_giver_address).collect()
            }
            Self::Place(place) => {
                let is_sign = ["token:", "recording:"];
                let sign = is_sign.iter().any(|prefix| place.from.starts_with(prefix));
                sign.then_some(place.from.as_str()).into_iter().collect()
            }
            _ => Vec::new(),
        }
    }
}

/// The expression of the face that was found for a recipe.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpressionInput {
    /// Its function in the signs that it spans.
    pub function: ExpressionFunction,
    /// Its milestones, from the first frame of its movement on.
    pub milestones: ExpressionMilestones,
}

/// The source of movement that was found for a recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialInput {
    /// Its unambiguous address.
    pub address: String,
    /// The hash of its movement.
    pub hash: String,
    /// Its gloss.
    pub gloss: String,
    /// The hand with which its signer signs.
    pub handedness: SignerHandedness,
    /// Its component values.
    pub held: Vec<HeldValue>,
    /// The body that performs it, if it is a notation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<BodyInput>,
}

/// The place that was found for a recipe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceInput {
    /// The value, if it belongs to an inventory.
    pub value: Option<String>,
    /// The inventory or sign that gives it.
    pub from: String,
    /// The position.
    pub at: BodyRelativePlace,
}

/// A letter with the posture chosen for it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LetterInput {
    /// The letter.
    pub letter: AlphabetLetter,
    /// The hand's posture.
    pub pose: HandPose,
}
