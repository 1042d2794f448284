//! Recipes to movement: recombination and synthesis.

mod arm;
mod body;
mod check;
mod contact;
mod course;
mod error;
mod evaluate;
mod explain;
mod json;
pub mod made;
mod ops;
mod poses;
pub mod recipe;
mod resolve;
mod simplify;
pub mod sources;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
mod text;
pub mod units;
mod work;

pub use check::{DEEPEST, MOST_PARTS, MOST_REPETITIONS};
pub use error::{Cause, MakeError, Problem, RecipeError, TextError};
pub use evaluate::evaluate;
pub use json::VERSION;
pub use made::{About, ChannelReport, JoinReport, Made, Note, Report, StepReport};
pub use poses::{Exact, HandPose, PoseOrigin};
pub use recipe::Recipe;
pub use resolve::{
    Input, Inputs, LetterInput, MaterialInput, PlaceInput, Resolved, resolve, restore,
};
pub use sources::{
    Example, Held, Letter, LetterStroke, Material, Meaning, SourceError, Sources, Spatial, Value,
};
