//! Oddities that a reader noticed and tolerated.

use chereme_sign::ErrorRemedy;
use serde::{Deserialize, Serialize};

/// An oddity of a foreign file that the reader tolerated.
///
/// An error that makes a file unreadable has the format's own error type instead.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ImportFinding {
    /// Its severity.
    pub severity: FindingSeverity,
    /// The line of the file, counted from 1, on which the oddity (first) occurred; `None` if lines are
    /// meaningless.
    pub line: Option<u64>,
    /// The oddity, and the reader's interpretation.
    pub message: String,
    /// A correction, if one is possible.
    pub remedy: Option<ErrorRemedy>,
    /// The correction that an option of the reader makes, if one does.
    #[serde(skip)]
    pub mend: Option<ReaderCorrection>,
}

/// A correction that an option of a reader makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReaderCorrection {
    /// The root's columns are read in another order than the header states.
    RootOrder,
    /// The caller gives a sign the gloss that its file lacks.
    Gloss,
}

impl ImportFinding {
    /// Returns a note: an understood oddity without loss.
    #[must_use]
    pub fn new_note_finding(line: impl Into<Option<u64>>, message: impl Into<String>) -> Self {
        Self {
            severity: FindingSeverity::Note,
            line: line.into(),
            message: message.into(),
            remedy: None,
            mend: None,
        }
    }

    /// Returns a warning: something may be lost, or mean something else.
    #[must_use]
    pub fn new_warning_finding(line: impl Into<Option<u64>>, message: impl Into<String>) -> Self {
        Self {
            severity: FindingSeverity::Warning,
            line: line.into(),
            message: message.into(),
            remedy: None,
            mend: None,
        }
    }

    /// Returns the finding with a correction.
    #[must_use]
    pub fn with_remedy(mut self, remedy: impl Into<ErrorRemedy>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}

/// The severity of a [`ImportFinding`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FindingSeverity {
    /// An understood oddity without loss.
    Note,
    /// Something may be lost, or mean something else; a person should look.
    Warning,
}
