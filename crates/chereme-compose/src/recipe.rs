//! The tree of a recipe: sources, the operators applied to them, and utterances.

mod recipe_check;
mod recipe_json;
mod recipe_parse;
mod recipe_print;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

pub use crate::face_parts::FacePart;
pub use crate::ops::settings::*;
pub use crate::ops::{FieldSetting, OperatorDescription, OperatorField, Step};
pub use crate::recipe_settings::*;
pub use recipe_check::{MAX_RECIPE_DEPTH, MOST_PARTS};
pub use recipe_json::RECIPE_TREE_VERSION;

/// A description from which movement is generated, as text (`ESCARGOT | configure right U`) and as JSON.
///
/// Both spellings are the same tree: [`str::parse`] and [`Display`](std::fmt::Display) read and write the text, serde
/// the JSON, which carries a version: `{"version": 1, "make": {"pipe": {"of": {"sign": "CLAIR"}, "steps":
/// ["reverse"]}}}`. Unknown fields and versions from the future are refused by name. A recipe names its sources and
/// does not refer to other recipes, so that there are no cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "recipe_json::VersionedRecipe", into = "recipe_json::VersionedRecipe")]
pub struct Recipe {
    pub(crate) root: RecipeNode,
}

/// A part of a recipe that produces movement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum RecipeNode {
    /// A sign of the corpus by its address as written: a gloss, `token:41`, `sign:LIMACE`.
    Sign(String),
    /// A word in a manual alphabet.
    Spell(SpellSettings),
    /// A pointing gesture.
    Point(PointSettings),
    /// Cued speech.
    Cue(CueSettings),
    /// A sign written in HamNoSys.
    Hamnosys(NotationSettings),
    /// The signs of a SiGML file, or a notated sign, that the corpus knows.
    Sigml(NotationSettings),
    /// Movement with operators applied to it, in order.
    Pipe(OperatorPipe),
    /// One piece of movement after another.
    Then(RecipeChain),
}

impl RecipeNode {
    /// Returns the name of the kind of node, as JSON has it.
    pub(crate) fn node_kind_name(&self) -> &'static str {
        match self {
            Self::Sign(_) => "sign",
            Self::Spell(_) => "spell",
            Self::Point(_) => "point",
            Self::Cue(_) => "cue",
            Self::Hamnosys(_) => "hamnosys",
            Self::Sigml(_) => "sigml",
            Self::Pipe(_) => "pipe",
            Self::Then(_) => "then",
        }
    }
}

/// Operators applied to a piece of movement, in order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OperatorPipe {
    /// The operand of the first operator; never itself a pipe once normalised.
    pub of: Box<RecipeNode>,
    /// The operators; at least one once normalised.
    pub steps: Vec<Step>,
}

/// Pieces of movement one after another, joined by transitions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecipeChain {
    /// The first piece.
    pub first: Box<RecipeNode>,
    /// The pieces that follow; at least one once normalised.
    pub next: Vec<JoinedPiece>,
}

/// A piece of movement that follows another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JoinedPiece {
    /// The transition from the piece before.
    #[serde(default, skip_serializing_if = "PostureTransition::is_default")]
    pub via: PostureTransition,
    /// The piece.
    pub node: RecipeNode,
}
