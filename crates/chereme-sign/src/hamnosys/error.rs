//! Errors in transcriptions, with their places.

use std::fmt;

use super::symbol::Symbol;
use crate::text::{did_you_mean, nearest};

/// Why a text is no transcription. Indexes count symbols from 0.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HamnosysError {
    /// There is no symbol at all.
    #[error("there is no symbol; write at least a handshape or a movement")]
    Empty,
    /// A character or a name is no symbol.
    #[error(
        "symbol {index} is {written:?}, which HamNoSys 4 does not have; write one of its 209 symbols or their names{}",
        meant(written)
    )]
    Unknown {
        /// Which.
        index: usize,
        /// What is there.
        written: String,
    },
    /// A symbol is where it cannot be.
    #[error("symbol {index} is {symbol}, but expected {expected}")]
    Unexpected {
        /// Which.
        index: usize,
        /// What it is.
        symbol: Symbol,
        /// What could be there.
        expected: &'static str,
    },
    /// The text ends too early.
    #[error("after the last symbol, {index}, expected {expected}")]
    Ended {
        /// The number of symbols.
        index: usize,
        /// What should follow.
        expected: &'static str,
    },
    /// A bracket is not closed where it should be.
    #[error("symbol {index}, {symbol}, is not closed; expected {expected} at symbol {at}")]
    Unclosed {
        /// The opening bracket.
        index: usize,
        /// What it is.
        symbol: Symbol,
        /// Where it should be closed.
        at: usize,
        /// By what.
        expected: &'static str,
    },
    /// Brackets or groups are nested too deep.
    #[error("symbol {index} nests deeper than {limit} levels; split the sign into parts")]
    TooDeep {
        /// Where.
        index: usize,
        /// How deep is allowed.
        limit: usize,
    },
    /// The text is too long.
    #[error("{count} symbols are more than a transcription has; write {limit} at most")]
    TooLong {
        /// How many there are.
        count: usize,
        /// How many are allowed.
        limit: usize,
    },
}

/// Returns the end of a message about a word that is no symbol's name: the name that was meant, if one is near.
pub(super) fn meant(written: &str) -> String {
    let near = nearest(written, Symbol::all().map(Symbol::name));
    did_you_mean(near.filter(|_| written.is_ascii()))
}

impl HamnosysError {
    /// Returns the symbol it is about.
    #[must_use]
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::Unknown { index, .. }
            | Self::Unexpected { index, .. }
            | Self::Ended { index, .. }
            | Self::Unclosed { index, .. }
            | Self::TooDeep { index, .. } => Some(*index),
            Self::Empty | Self::TooLong { .. } => None,
        }
    }
}

/// Something odd about a transcription that did not stop its reading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Finding {
    /// The symbol it is about, from 0.
    pub index: usize,
    /// What is odd.
    pub message: String,
    /// What would be right.
    pub remedy: &'static str,
    /// The symbol is in the text only, not in the tree.
    pub dropped: bool,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "symbol {}: {}; {}",
            self.index, self.message, self.remedy
        )
    }
}
