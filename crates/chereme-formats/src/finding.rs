//! Oddities that a reader noticed and tolerated.

use chereme_sign::Remedy;
use serde::{Deserialize, Serialize};

/// An oddity of a foreign file that the reader tolerated.
///
/// An error that makes a file unreadable has the format's own error type instead.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Its severity.
    pub severity: Severity,
    /// The line of the file, counted from 1, on which the oddity (first) occurred; `None` if lines are
    /// meaningless.
    pub line: Option<u64>,
    /// The oddity, and the reader's interpretation.
    pub message: String,
    /// A correction, if one is possible.
    pub remedy: Option<Remedy>,
    /// The correction that an option of the reader makes, if one does.
    #[serde(skip)]
    pub mend: Option<Mend>,
}

/// A correction that an option of a reader makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mend {
    /// The root's columns are read in another order than the header states.
    RootOrder,
    /// The caller gives a sign the gloss that its file lacks.
    Gloss,
}

impl Finding {
    /// Returns a note: an understood oddity without loss.
    #[must_use]
    pub fn note(line: impl Into<Option<u64>>, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Note,
            line: line.into(),
            message: message.into(),
            remedy: None,
            mend: None,
        }
    }

    /// Returns a warning: something may be lost, or mean something else.
    #[must_use]
    pub fn warning(line: impl Into<Option<u64>>, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            line: line.into(),
            message: message.into(),
            remedy: None,
            mend: None,
        }
    }

    /// Returns the finding with a correction.
    #[must_use]
    pub fn with_remedy(mut self, remedy: impl Into<Remedy>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}

/// The severity of a [`Finding`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// An understood oddity without loss.
    Note,
    /// Something may be lost, or mean something else; a person should look.
    Warning,
}
