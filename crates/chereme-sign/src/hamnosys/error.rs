//! Errors in transcriptions, with their places.

use std::fmt;

use super::symbol::HamnosysSymbol;
use crate::text::{did_you_mean, nearest_candidate};

/// The reason why a text is not a transcription. Indexes count symbols from 0,
/// messages from 1.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HamnosysError {
    /// There is no symbol.
    #[error("there is no symbol; write at least a handshape or a movement")]
    Empty,
    /// A character or a name is not a symbol.
    #[error(
        "symbol {} is {written:?}, which HamNoSys 4 does not have; write one of its 209 symbols or their names{}",
        index + 1,
        similar_symbol_hint(written)
    )]
    Unknown {
        /// The index of the symbol.
        index: usize,
        /// The text found.
        written: String,
    },
    /// A symbol is at an impossible place.
    #[error("symbol {} is {symbol}, but expected {expected}", index + 1)]
    Unexpected {
        /// The index of the symbol.
        index: usize,
        /// The symbol.
        symbol: HamnosysSymbol,
        /// The symbols that are possible there.
        expected: &'static str,
    },
    /// The text ends too early.
    #[error("after the last symbol, {index}, expected {expected}")]
    Ended {
        /// The number of symbols.
        index: usize,
        /// The expected symbols.
        expected: &'static str,
    },
    /// A bracket is not closed where it should be.
    #[error("symbol {}, {symbol}, is not closed; expected {expected} at symbol {}", index + 1, at + 1)]
    Unclosed {
        /// The opening bracket.
        index: usize,
        /// The bracket.
        symbol: HamnosysSymbol,
        /// The index at which it should be closed.
        at: usize,
        /// The expected symbol.
        expected: &'static str,
    },
    /// Brackets or groups are nested too deep.
    #[error("symbol {} nests deeper than {limit} levels; split the sign into parts", index + 1)]
    TooDeep {
        /// The index of the symbol.
        index: usize,
        /// The largest allowed depth.
        limit: usize,
    },
    /// The text is too long.
    #[error("{count} symbols are more than a transcription has; write {limit} at most")]
    TooLong {
        /// The number of symbols.
        count: usize,
        /// The largest allowed number.
        limit: usize,
    },
}

/// Returns the end of a message about a word that names no symbol: the most similar name, if any.
pub(super) fn similar_symbol_hint(written: &str) -> String {
    let near = nearest_candidate(written, HamnosysSymbol::all_symbols().map(HamnosysSymbol::symbol_name));
    did_you_mean(near.filter(|_| written.is_ascii()))
}

impl HamnosysError {
    /// Returns the index of the symbol concerned.
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

/// An oddity of a transcription that did not stop its reading.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HamnosysFinding {
    /// The index of the symbol concerned, from 0.
    pub index: usize,
    /// The oddity.
    pub message: String,
    /// A correction.
    pub remedy: &'static str,
    /// Whether the symbol is in the text only, not in the tree.
    pub dropped: bool,
}

impl HamnosysFinding {
    /// Returns the number of the symbol concerned, from 1, for messages.
    #[must_use]
    pub fn symbol_number(&self) -> usize {
        self.index + 1
    }
}

impl fmt::Display for HamnosysFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "symbol {}: {}; {}", self.symbol_number(), self.message, self.remedy)
    }
}
