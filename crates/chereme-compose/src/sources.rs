//! The evaluator's questions to the outside: the one trait that a corpus implements.

use std::sync::Arc;

use chereme_motion::{Anatomy, Clip, HandAngles, Side, Span};
use chereme_sign::hamnosys::Notated;
use chereme_sign::inventory::{Inventory, InventoryValue, Landmark};
use chereme_sign::milestones::{Function, Milestones};
use chereme_sign::{Component, Handedness, Reading};
use serde::{Deserialize, Serialize};

use crate::cue::CuePhases;
use crate::language::Language;
use crate::made::Curve;

/// Where recipes find movement, values and examples; a corpus implements it.
///
/// Every question is asked while a recipe is [resolved](crate::Recipe); evaluating asks nothing.
/// Answers must not depend on anything but the corpus: the same question gives the same answer in
/// the same order.
pub trait Sources {
    /// Returns the movement at an address as written: a gloss, `token:41`, `sign:LIMACE`.
    ///
    /// # Errors
    /// [`SourceError::Missing`] if nothing has that address, [`SourceError::Ambiguous`] if several things have it,
    /// [`SourceError::NoMovement`] for a lexicon entry without movement.
    fn material(&self, address: &str) -> Result<Material, SourceError>;

    /// Returns a body at rest, for movement that comes from no recording: a frame or more of a
    /// neutral posture of the signer (an address), or of one the corpus chooses.
    ///
    /// # Errors
    /// [`SourceError`] where there is no such signer, or no movement at all.
    fn stage(&self, signer: Option<&str>) -> Result<Material, SourceError>;

    /// Returns the value of `component` that `text` names: by id, by a name in any language, or by
    /// its notation.
    ///
    /// # Errors
    /// [`SourceError::UnknownValue`] with what was probably meant.
    fn value(&self, component: Component, text: &str) -> Result<Value, SourceError>;

    /// Returns every value of `component` in the inventories, in their order.
    fn values(&self, component: Component) -> Vec<Value>;

    /// Returns the tokens with movement that hold the value with this id, best examples first.
    ///
    /// # Errors
    /// [`SourceError`] where the corpus cannot be read.
    fn holding(&self, component: Component, value: &str) -> Result<Vec<Example>, SourceError>;

    /// Returns the tokens with movement that answer `query`, best first; `signer=same` in it means
    /// the signer given here.
    ///
    /// # Errors
    /// [`SourceError::Query`] where the query is not understood.
    fn best(&self, query: &str, signer: Option<&str>) -> Result<Vec<Example>, SourceError>;

    /// Returns the signs of the notation that `name` stands for: a SiGML file that the corpus holds,
    /// or the notation of a sign.
    ///
    /// # Errors
    /// [`SourceError::Missing`] where nothing notated has that name.
    fn notation(&self, name: &str) -> Result<Vec<Notated>, SourceError> {
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
    fn body_language(
        &self,
        _named: Option<&str>,
        _signer: Option<&str>,
    ) -> Result<Language, SourceError> {
        Ok(Language::default())
    }

    /// Returns an expression of the face with its milestones: that of `function` at the address, or the only one there.
    ///
    /// # Errors
    /// [`SourceError::Expression`] if nothing there has milestones, or several things have; those of
    /// [`material`](Self::material).
    fn expression(
        &self,
        address: &str,
        function: Option<&str>,
    ) -> Result<ExpressionSource, SourceError> {
        let _ = function;
        Err(SourceError::Expression {
            address: address.to_owned(),
            why: "it has no milestones".to_owned(),
        })
    }

    /// Returns the letters of `word` in an alphabet, or in the corpus's usual one.
    ///
    /// # Errors
    /// [`SourceError::UnknownAlphabet`], or [`SourceError::UnknownLetter`] naming the first letter that
    /// the alphabet does not have.
    fn letters(&self, alphabet: Option<&str>, word: &str) -> Result<Vec<Letter>, SourceError>;

    /// Returns the usual courses of the corpus's own transitions; nothing where it shows too few.
    ///
    /// # Errors
    /// [`SourceError`] where the corpus cannot be read.
    fn learned_profile(&self) -> Result<Option<LearnedProfile>, SourceError> {
        Ok(None)
    }

    /// Returns the phases of the corpus's captured keys of cued speech; nothing if there are too few.
    ///
    /// # Errors
    /// [`SourceError`] if the corpus cannot be read.
    fn cue_phases(&self) -> Result<Option<CuePhases>, SourceError> {
        Ok(None)
    }

    /// Returns how long the corpus's hands hold a configuration and take to the next.
    ///
    /// # Errors
    /// [`SourceError`] where the corpus cannot be read.
    fn spelling_times(&self) -> Result<SpellingTimes, SourceError> {
        Ok(SpellingTimes::default())
    }
}

/// The usual courses of a corpus's transitions, for each channel that shows enough of them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LearnedProfile {
    /// The course of wrists from place to place; without it that of the fingers is used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub arms: Option<LearnedCourse>,
    /// The course of fingers from shape to shape; without it that of the arms is used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingers: Option<LearnedCourse>,
}

/// The usual course of transitions, as [`learn_course`](crate::learn_course) finds it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LearnedCourse {
    /// Shares of the way at equal steps of time, from 0 to 1.
    pub shares: Vec<f64>,
    /// How many transitions it was learned from.
    pub transitions: usize,
    /// The recordings that they are of, by their names.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub recordings: Vec<String>,
}

impl LearnedProfile {
    /// Returns the course of the arms, or the fingers' if it is missing.
    #[must_use]
    pub fn of_arms(&self) -> Option<&LearnedCourse> {
        self.arms.as_ref().or(self.fingers.as_ref())
    }

    /// Returns the course of the fingers, or the arms' if it is missing.
    #[must_use]
    pub fn of_fingers(&self) -> Option<&LearnedCourse> {
        self.fingers.as_ref().or(self.arms.as_ref())
    }
}

/// How long hands hold a configuration, and how long they take from one to the next.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpellingTimes {
    /// Of holds; nothing where there are too few.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold: Option<MedianTime>,
    /// From the end of one hold to the start of the next; nothing where there are too few.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change: Option<MedianTime>,
}

/// A median of times.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MedianTime {
    /// The median in seconds.
    pub seconds: f64,
    /// How many it is the median of.
    pub count: usize,
}

/// A piece of movement with its annotations.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its address without doubt, such as `token:41`.
    pub address: String,
    /// A hash of the movement, as the corpus makes it; the same movement always has the same.
    pub hash: String,
    /// What it is called.
    pub gloss: String,
    /// The address of the signer, where known.
    pub signer: Option<String>,
    /// Which hand the signer signs with.
    pub handedness: Handedness,
    /// The movement; times in `held` count from its first frame.
    pub clip: Clip,
    /// Which joint is what.
    pub anatomy: Arc<Anatomy>,
    /// The component values it holds, in any order.
    pub held: Vec<Held>,
    /// Scalar curves of it, a value a frame.
    pub curves: Vec<Curve>,
}

/// An expression of the face with the movement it is part of.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpressionSource {
    /// The movement, at least from M1 to M5 as far as it was recorded.
    pub material: Material,
    /// The function of the expression in the signs that it spans.
    pub function: Function,
    /// Its milestones, from the first frame of the movement on.
    pub milestones: Milestones,
}

/// A value of a component over a span of a piece of movement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Held {
    /// The hand; nothing for non-manual components.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hand: Option<Side>,
    /// The component.
    pub component: Component,
    /// The part of the component, such as `brows` or `palm`; nothing for the whole.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feature: Option<String>,
    /// The value: an id of an inventory where there is one.
    pub value: Reading,
    /// The time, from the movement's first frame.
    pub span: Span,
}

/// A value of an inventory with what it means for a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Value {
    /// The id under which annotations name it.
    pub id: String,
    /// The inventory.
    pub inventory: String,
    /// Its meaning, if the inventory gives one.
    pub meaning: Option<Meaning>,
}

/// The meaning of a value for a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Meaning {
    /// A posture of the hand.
    Hand(HandAngles),
    /// A place.
    Place(Spatial),
}

/// A place relative to a signer's body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spatial {
    /// The landmark's name, as [`Anatomy::landmark`] spells it; `ipsi-` and `contra-` at its start
    /// stand for the acting hand's own and other side.
    pub landmark: String,
    /// From the landmark to the left, up and forward in shoulder widths; with `ipsi-` and `contra-`
    /// the first counts away from the body's middle.
    pub offset: [f64; 3],
}

impl From<&Landmark> for Spatial {
    fn from(landmark: &Landmark) -> Self {
        Self {
            landmark: landmark.name.clone(),
            offset: landmark.offset,
        }
    }
}

impl Value {
    /// Returns a value of an inventory with what it means for a body.
    #[must_use]
    pub fn of(inventory: &Inventory, value: &InventoryValue) -> Self {
        let hand = value.pose.map(Meaning::Hand);
        let place = || value.landmark.as_ref().map(|at| Meaning::Place(at.into()));
        Self {
            id: value.id.clone(),
            inventory: inventory.id.clone(),
            meaning: hand.or_else(place),
        }
    }
}

/// A token that shows something, and where in it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Example {
    /// Its address.
    pub address: String,
    /// Its signer's address, where known.
    pub signer: Option<String>,
    /// The hand that shows it; `None` if it is unknown.
    pub hand: Option<Side>,
    /// When, from the start of its movement; nothing for all of it.
    pub span: Option<Span>,
}

/// A letter of a manual alphabet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Letter {
    /// The letter as written.
    pub letter: String,
    /// Its configuration's value.
    pub value: Value,
    /// Where the straight fingers point: left, up, forward for a right hand; nothing for up.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fingers: Option<[f64; 3]>,
    /// The direction of the palm, in the same form; `None` for forward.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub palm: Option<[f64; 3]>,
    /// The strokes of the hand while it shows the letter; empty for one that is held still.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub strokes: Vec<LetterStroke>,
}

/// One stroke of a letter that moves.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LetterStroke {
    /// The way to the left, up and forward in shoulder widths, for a right hand.
    pub way: [f64; 3],
    /// The turn of the forearm meanwhile in radians, positive when the palm turns to face up.
    pub turn: f64,
}

/// Why the corpus has no answer.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SourceError {
    /// Nothing has this address.
    #[error("{address:?} is not in the corpus{}", chereme_sign::text::did_you_mean(nearest.as_deref()))]
    Missing {
        /// The address as written.
        address: String,
        /// An address near to it.
        nearest: Option<String>,
    },
    /// Several things have this address.
    #[error("{address:?} could be any of {}; name one of them", candidates.join(", "))]
    Ambiguous {
        /// The address as written.
        address: String,
        /// Addresses without doubt.
        candidates: Vec<String>,
    },
    /// The sign is a lexicon entry without movement.
    #[error(
        "{address:?} has no movement: it is an entry of a lexicon; name a sign that was captured or made"
    )]
    NoMovement {
        /// The address as written.
        address: String,
    },
    /// Something has no expression with milestones.
    #[error("{address:?} has no expression of the face to carry over: {why}")]
    Expression {
        /// The address as written.
        address: String,
        /// The reason, with a remedy.
        why: String,
    },
    /// The sign is not there as notation.
    #[error(
        "{address:?} has no notation; import it as SiGML or HamNoSys, or write it from its movement: \
         `chereme transcribe CORPUS {address} --store`"
    )]
    NoNotation {
        /// The address as written.
        address: String,
    },
    /// No inventory has this value.
    #[error("{text:?} is no {component} of any inventory{}", chereme_sign::text::did_you_mean(nearest.as_deref()))]
    UnknownValue {
        /// The component.
        component: Component,
        /// The value as written.
        text: String,
        /// A value near to it.
        nearest: Option<String>,
    },
    /// No inventory with this name has letters.
    #[error("{name:?} is no manual alphabet; there {}", match known.as_slice() { [] => "is none".to_owned(), known => format!("is {}", known.join(", ")) })]
    UnknownAlphabet {
        /// The name as written.
        name: String,
        /// The inventories that have letters.
        known: Vec<String>,
    },
    /// An alphabet does not have a letter.
    #[error("{letter:?} is no letter of the manual alphabet {alphabet:?}; spell with {known} only")]
    UnknownLetter {
        /// The letter.
        letter: String,
        /// The inventory.
        alphabet: String,
        /// The letters that it has.
        known: String,
    },
    /// The file is not a body language.
    #[error(
        "the body language {name:?} cannot be used: {message}; name default, measured, or a file such as {{\"version\": 1, \"values\": {{\"move.big\": [0.5, \"arm\", \"mine\"]}}}}"
    )]
    Language {
        /// The name as written.
        name: String,
        /// The fault.
        message: String,
    },
    /// A query is not understood.
    #[error("the query {query:?} is not understood: {message}")]
    Query {
        /// The query.
        query: String,
        /// The fault and its place.
        message: String,
    },
    /// The corpus cannot be read.
    #[error("the corpus cannot be read: {0}")]
    Unreadable(String),
}
