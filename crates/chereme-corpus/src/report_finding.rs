//! Findings about files that are read, as reports list them.

use chereme_formats::{FindingSeverity, ImportFinding};
use chereme_sign::ErrorRemedy;
use serde::Serialize;

/// A finding about a file for the user.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ReportFinding {
    /// `note`, `warning` or `error`.
    pub severity: &'static str,
    /// The line of the file, from 1.
    pub line: Option<u64>,
    /// The finding.
    pub message: String,
    /// A remedy.
    pub remedy: Option<ErrorRemedy>,
}

impl From<ImportFinding> for ReportFinding {
    fn from(finding: ImportFinding) -> Self {
        let severity = match finding.severity {
            FindingSeverity::Note => "note",
            FindingSeverity::Warning => "warning",
        };
        let ImportFinding {
            line, message, remedy, ..
        } = finding;
        Self {
            severity,
            line,
            message,
            remedy,
        }
    }
}

impl ReportFinding {
    pub(crate) fn finding_note(message: impl Into<String>) -> Self {
        Self {
            severity: "note",
            line: None,
            message: message.into(),
            remedy: None,
        }
    }

    pub(crate) fn finding_error(message: impl Into<String>, remedy: impl Into<ErrorRemedy>) -> Self {
        Self {
            severity: "error",
            ..Self::finding_warning(message, remedy)
        }
    }

    pub(crate) fn finding_warning(message: impl Into<String>, remedy: impl Into<ErrorRemedy>) -> Self {
        let remedy = Some(remedy.into());
        Self {
            severity: "warning",
            line: None,
            message: message.into(),
            remedy,
        }
    }
}
