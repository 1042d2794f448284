//! What an import did, file by file.

use std::collections::BTreeMap;
use std::path::Path;

use chereme_formats::{Finding, Severity};
use serde::Serialize;
use serde_json::Value;

use crate::error::Error;

/// What an import did.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ImportReport {
    /// How many rows of each kind were made.
    pub created: BTreeMap<&'static str, u64>,
    /// What became of each file.
    pub files: Vec<FileReport>,
    /// Whether nothing was written, as asked.
    pub dry_run: bool,
    #[serde(skip)]
    pub(super) complete: bool,
}

/// What became of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FileReport {
    /// The file.
    pub path: String,
    /// Whether it was taken in.
    pub status: FileStatus,
    /// The recording that it became or was added to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recording: Option<String>,
    /// How it was understood: unit and axes, joint roles, tiers, columns.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub understood: BTreeMap<&'static str, Value>,
    /// What is odd about it, or why it was refused.
    pub findings: Vec<ReportFinding>,
}

/// What became of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FileStatus {
    /// It was taken in.
    Imported,
    /// It was taken in before and edited since; what it says now was taken over.
    Updated,
    /// It was taken in before, and is the same.
    Unchanged,
    /// It is of no kind that the corpus takes in.
    Skipped,
    /// It could not be taken in.
    Refused,
}

/// Something about a file that a person should know.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ReportFinding {
    /// `note`, `warning` or `error`.
    pub severity: &'static str,
    /// The line of the file, from 1.
    pub line: Option<u64>,
    /// What it is.
    pub message: String,
    /// What would be right.
    pub remedy: Option<String>,
}

impl From<Finding> for ReportFinding {
    fn from(finding: Finding) -> Self {
        let severity = match finding.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
        };
        let Finding {
            line,
            message,
            remedy,
            ..
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
    pub(super) fn note(message: impl Into<String>) -> Self {
        Self {
            severity: "note",
            line: None,
            message: message.into(),
            remedy: None,
        }
    }

    pub(super) fn warning(message: impl Into<String>, remedy: impl Into<String>) -> Self {
        let remedy = Some(remedy.into());
        Self {
            severity: "warning",
            line: None,
            message: message.into(),
            remedy,
        }
    }
}

impl FileReport {
    pub(super) fn new(path: &Path, status: FileStatus) -> Self {
        Self {
            path: path.display().to_string(),
            status,
            recording: None,
            understood: BTreeMap::new(),
            findings: Vec::new(),
        }
    }

    /// Returns that a file was left alone, and why.
    pub(super) fn skipped(path: &Path, why: &Error) -> Self {
        let mut report = Self::new(path, FileStatus::Skipped);
        report.findings.push(ReportFinding {
            severity: "note",
            line: None,
            message: why.to_string(),
            remedy: why.remedy(),
        });
        report
    }

    pub(super) fn unchanged(path: &Path) -> Self {
        let mut report = Self::new(path, FileStatus::Unchanged);
        report
            .findings
            .push(ReportFinding::note("the same file was imported before"));
        report
    }

    pub(super) fn refused(path: &Path, error: &Error) -> Self {
        let mut report = Self::new(path, FileStatus::Refused);
        let place = error.place().unwrap_or_default();
        let line = place
            .strip_prefix("line ")
            .and_then(|line| line.parse().ok());
        report.findings.push(ReportFinding {
            severity: "error",
            line,
            message: error.to_string(),
            remedy: error.remedy(),
        });
        report
    }

    /// Returns how it was understood, for `key`, as JSON.
    pub(super) fn understand(&mut self, key: &'static str, value: impl Serialize) {
        let value = serde_json::to_value(value).unwrap_or(Value::Null);
        self.understood.insert(key, value);
    }
}

impl ImportReport {
    /// Returns whether a file was refused.
    #[must_use]
    pub fn has_refusals(&self) -> bool {
        self.files
            .iter()
            .any(|file| file.status == FileStatus::Refused)
    }

    pub(super) fn summary(&self) -> String {
        let imported = self
            .files
            .iter()
            .filter(|file| matches!(file.status, FileStatus::Imported | FileStatus::Updated));
        let names: Vec<&str> = imported
            .filter_map(|file| Path::new(&file.path).file_name()?.to_str())
            .collect();
        match names.as_slice() {
            [] => "nothing new".to_owned(),
            [one] => (*one).to_owned(),
            [first, .., last] => format!("{} files from {first} to {last}", names.len()),
        }
    }
}
