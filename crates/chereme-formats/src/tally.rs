//! Findings of hostile files, which may be millions of one kind.

use crate::finding::ImportFinding;
use std::collections::BTreeMap;

/// The number of findings of one kind that are reported one by one.
const MAX_LISTED_FINDINGS: u64 = 20;

/// Collects findings; of each kind only the first few are reported one by one, and the rest are counted.
#[derive(Debug, Default)]
pub(crate) struct FindingTally {
    listed: Vec<ImportFinding>,
    kinds: BTreeMap<&'static str, u64>,
}

impl FindingTally {
    /// Adds the finding from `make`, unless enough of its `kind` have been reported.
    pub(crate) fn add_limited_finding(&mut self, kind: &'static str, make: impl FnOnce() -> ImportFinding) {
        if self.count_finding_kind(kind) {
            self.listed.push(make());
        }
    }

    /// Adds a note on a line, or on the whole file, unless enough of its `kind` have been reported.
    pub(crate) fn add_limited_note<M: Into<String>>(
        &mut self,
        kind: &'static str,
        line: impl Into<Option<u64>>,
        message: impl FnOnce() -> M,
    ) {
        self.add_limited_finding(kind, || ImportFinding::new_note_finding(line, message()));
    }

    /// Adds a warning as [`add_limited_note`](Self::add_limited_note) adds a note.
    pub(crate) fn add_limited_warning<M: Into<String>>(
        &mut self,
        kind: &'static str,
        line: impl Into<Option<u64>>,
        message: impl FnOnce() -> M,
    ) {
        self.add_limited_finding(kind, || ImportFinding::new_warning_finding(line, message()));
    }

    /// Adds the finding from `make`, unless there is one with the same message.
    pub(crate) fn add_unique_finding(&mut self, make: impl FnOnce() -> ImportFinding) {
        let finding = make();
        if !self.listed.iter().any(|other| other.message == finding.message) {
            self.listed.push(finding);
        }
    }

    /// Counts one more of `kind`; returns whether to report it.
    pub(crate) fn count_finding_kind(&mut self, kind: &'static str) -> bool {
        let count = self.kinds.entry(kind).or_default();
        *count += 1;
        *count <= MAX_LISTED_FINDINGS
    }

    /// Adds a finding that was counted.
    pub(crate) fn push_counted_finding(&mut self, finding: ImportFinding) {
        self.listed.push(finding);
    }

    /// Adds a note on a line, or on the whole file.
    pub(crate) fn push_note_finding(&mut self, line: impl Into<Option<u64>>, message: impl Into<String>) {
        self.push_counted_finding(ImportFinding::new_note_finding(line, message));
    }

    /// Adds a warning on a line, or on the whole file.
    pub(crate) fn push_warning_finding(&mut self, line: impl Into<Option<u64>>, message: impl Into<String>) {
        self.push_counted_finding(ImportFinding::new_warning_finding(line, message));
    }

    /// Returns the findings in their order, and the counts of the unreported ones.
    pub(crate) fn finish_finding_tally(mut self) -> Vec<ImportFinding> {
        for (kind, count) in self.kinds.iter().filter(|(_, count)| **count > MAX_LISTED_FINDINGS) {
            self.listed.push(ImportFinding::new_warning_finding(
                None,
                format!("{} more: {kind}", count - MAX_LISTED_FINDINGS),
            ));
        }
        self.listed
    }
}
