//! Recipes to movement: recombination and synthesis.

mod check;
mod error;
mod json;
pub mod made;
pub mod recipe;
pub mod sources;
mod text;
pub mod units;

pub use check::{DEEPEST, MOST_PARTS, MOST_REPETITIONS};
pub use error::{Problem, RecipeError, TextError};
pub use json::VERSION;
pub use made::{About, ChannelReport, JoinReport, Made, Note, Report, StepReport};
pub use recipe::Recipe;
pub use sources::{Example, Held, Letter, Material, Meaning, SourceError, Sources, Spatial, Value};
