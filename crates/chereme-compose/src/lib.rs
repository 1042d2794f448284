//! Generates movement from recipes: recombination and synthesis of signs.
//!
//! A [`Recipe`] describes how to build a sign, as text or as JSON. [`resolve_recipe`] asks a corpus, through the one trait
//! [`RecipeSources`], for everything the recipe needs, and fixes it; [`evaluate_recipe`] generates the movement, its
//! annotations, and a report on the source of every part.
//!
//! ```
//! use chereme_compose::Recipe;
//!
//! let recipe: Recipe = "ESCARGOT | configure right U | place both by left 25cm".parse()?;
//! let json = serde_json::to_string(&recipe)?;
//! assert_eq!(serde_json::from_str::<Recipe>(&json)?.to_string(), recipe.to_string());
//!
//! let error = "BOL | palce both by left 25cm".parse::<Recipe>().unwrap_err();
//! assert!(error.to_string().contains("character 7") && error.to_string().contains("\"place\"?"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | holds |
//! |---|---|
//! | [`recipe`] | the tree: sources, operators with their settings, utterances |
//! | [`units`] | lengths, times, directions and hands as recipes write them |
//! | [`sources`] | the questions to a corpus, and its answers |
//! | [`cue`](mod@cue) | a cuer, its phases, and a dictionary of movements between keys |
//! | [`outcome`] | movement with its notes and its report |
//! | [`notation`] | movement from HamNoSys and SiGML |
//!
//! The rest is reached through functions: [`resolve_recipe`], [`evaluate_recipe`],
//! [`value_in`] and [`letters_in`] for a corpus's answers, [`learn_course`] and [`bridge_captured_stretch`] for courses
//! learned from captured transitions.
//!
//! After Naert, Larboulette & Gibet, *Motion synthesis and editing for the generation of new sign
//! language content*, Machine Translation 35 (2021).

mod answers;
mod arm;
mod body;
mod check;
mod contact;
mod course;
pub mod cue;
mod cue_timing;
mod curve;
mod draft;
mod draft_stages;
mod error;
mod evaluate;
mod explain;
mod face;
mod face_parts;
#[cfg(test)]
#[path = "../../../tests/shared/golden.rs"]
mod golden;
mod language;
mod learn;
mod lookup;
pub mod notation;
mod ops;
pub mod outcome;
mod poses;
pub mod recipe;
mod recipe_inputs;
mod recipe_settings;
mod resolve;
mod simplify;
pub mod sources;
mod speed;
mod stroke;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod text;
mod transfer;
#[cfg(test)]
#[path = "../../../tests/shared/tuned_faults.rs"]
mod tuned_faults;
pub mod units;
mod work;

pub use cue_timing::{CuePhases, PhaseRule};
pub use curve::MeasuredSpline;
pub use draft::RecipeDraft;
pub use error::{
    MakeError, MeantName, RecipeError, RecipeTextProblem, SourceError, StepError, TextError, UnknownFaceWord,
};
pub use evaluate::{ENGINE_VERSION, evaluate_recipe};
pub use explain::shorten_step_text;
pub use face::{FACE_NUMBER_PREFIX, faces_from_curves};
pub use face_parts::FacePart;
pub use language::{BodyLanguageChanges, LanguageValue};
pub use learn::{CapturedStretch, CourseLearner, bridge_captured_stretch, learn_course};
pub use lookup::{letters_in, value_in};
pub use ops::repeat_operator::MOST_REPETITIONS;
pub use outcome::{
    ChannelReport, CueTier, GeneratedCurve, GeneratedMovement, GeneratedNote, GenerationReport, HandReport, JoinReport,
    NoteSubject, StepReport, TouchReport,
};
pub use poses::{DonorCoding, ExactHandRotations, HandPose, PoseOrigin};
pub use recipe::{MAX_RECIPE_DEPTH, MOST_PARTS, RECIPE_TREE_VERSION, Recipe};
pub use recipe_inputs::{ExpressionInput, LetterInput, MaterialInput, PlaceInput, RecipeInput, RecipeInputs};
pub use resolve::{ResolvedRecipe, resolve_recipe};
pub use sources::{
    AlphabetLetter, BodyInput, BodyRelativePlace, ComponentValue, ExpressionSource, HeldValue, LearnedCourse,
    LearnedProfile, LearnedReaches, LetterStroke, MedianTime, MovementMaterial, RecipeSources, SpellingTimes,
    TokenExample, ValueMeaning,
};
pub use transfer::{TransferredMovement, on_body};
