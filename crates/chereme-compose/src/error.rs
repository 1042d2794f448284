//! What can be wrong with a recipe before anything is made of it.

use crate::units::UnitError;

/// A recipe that cannot be read or held.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecipeError {
    /// The text is no recipe.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The JSON is of a version that this engine does not know.
    #[error(
        "this recipe is of version {found}; this program reads version 1, so a newer one is needed"
    )]
    Version {
        /// The version as written.
        found: String,
    },
    /// A field of the JSON is missing, unknown or of the wrong kind.
    #[error("{message}")]
    Field {
        /// What is wrong with which field.
        message: String,
    },
    /// A number is outside of what can be made.
    #[error("{step}: {what} is {found}; it must lie between {least} and {most}")]
    Range {
        /// The operator.
        step: &'static str,
        /// The setting.
        what: &'static str,
        /// What was asked for.
        found: String,
        /// The least that is allowed.
        least: f64,
        /// The most that is allowed.
        most: f64,
    },
    /// A list that must hold something is empty, or directions cancel out.
    #[error("{step}: {what}")]
    Empty {
        /// The operator.
        step: &'static str,
        /// What is missing.
        what: &'static str,
    },
    /// There are too many operators, or they are nested too deep.
    #[error("a recipe has at most {most} {what}; split it and store the parts as signs")]
    Size {
        /// What there is too much of.
        what: &'static str,
        /// How much is allowed.
        most: usize,
    },
}

/// Where and why a text is no recipe.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("character {}: {problem}", at + 1)]
pub struct TextError {
    /// The text that was read.
    pub text: String,
    /// The character, from 0, at which reading stopped.
    pub at: usize,
    /// What is wrong there.
    pub problem: Problem,
}

impl TextError {
    /// Returns the text with a mark under the character, on two lines.
    #[must_use]
    pub fn pointed(&self) -> String {
        format!("{}\n{}^", self.text, " ".repeat(self.at))
    }
}

/// What is wrong at a character of a recipe's text.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Problem {
    /// Something else was expected.
    #[error(
        "{} where {expected} was expected{}",
        found.as_ref().map_or("the text ends".to_owned(), |found| format!("{found:?} stands")),
        chereme_sign::text::did_you_mean(nearest.as_deref())
    )]
    Expected {
        /// What would be right.
        expected: &'static str,
        /// The word that stands there; nothing at the end.
        found: Option<String>,
        /// A word near to it that would be right.
        nearest: Option<String>,
    },
    /// A quantity cannot be read.
    #[error(transparent)]
    Unit(UnitError),
    /// A quotation mark or parenthesis is not closed.
    #[error("this {0} is never closed")]
    Unclosed(char),
    /// The query in `best(...)` is none.
    #[error("the query is not understood: {0}")]
    Query(String),
    /// The text is too long.
    #[error("the text is longer than {0} bytes")]
    TooLong(usize),
    /// Parentheses are nested too deep.
    #[error("parentheses are nested deeper than {0}")]
    TooDeep(usize),
}
