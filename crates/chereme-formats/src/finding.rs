//! What a reader noticed that is odd but not fatal.

use serde::Serialize;

/// One thing that a reader noticed about a foreign file and could live with.
///
/// What makes a file meaningless is an error of the format's own type instead.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// How much it matters.
    pub severity: Severity,
    /// The line of the file, counted from 1, where it was (first) met; none where lines say nothing.
    pub line: Option<u64>,
    /// What is odd, and what was made of it.
    pub message: String,
    /// What would set it right, where something can be done.
    pub remedy: Option<String>,
}

impl Finding {
    /// Returns a note: odd, understood, and nothing was lost.
    #[must_use]
    pub fn note(line: impl Into<Option<u64>>, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Note,
            line: line.into(),
            message: message.into(),
            remedy: None,
        }
    }

    /// Returns a warning: something may be lost or mean another thing than it says.
    #[must_use]
    pub fn warning(line: impl Into<Option<u64>>, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            line: line.into(),
            message: message.into(),
            remedy: None,
        }
    }

    /// Returns the finding with what would set it right.
    #[must_use]
    pub fn with_remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}

/// How much a [`Finding`] matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Odd, but understood; nothing was lost.
    Note,
    /// Something may be lost, or mean another thing than it says; a person should look.
    Warning,
}
