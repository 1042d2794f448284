//! Findings of hostile files, which may be millions of one kind.

use crate::finding::Finding;
use std::collections::BTreeMap;

/// The number of findings of one kind that are reported one by one.
const LISTED: u64 = 20;

/// Collects findings; of each kind only the first few are reported one by one, and the rest are counted.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    listed: Vec<Finding>,
    kinds: BTreeMap<&'static str, u64>,
}

impl Findings {
    /// Adds the finding from `make`, unless enough of its `kind` have been reported.
    pub(crate) fn add(&mut self, kind: &'static str, make: impl FnOnce() -> Finding) {
        if self.counts(kind) {
            self.listed.push(make());
        }
    }

    /// Adds the finding from `make`, unless there is one with the same message.
    pub(crate) fn once(&mut self, make: impl FnOnce() -> Finding) {
        let finding = make();
        if !self.listed.iter().any(|it| it.message == finding.message) {
            self.listed.push(finding);
        }
    }

    /// Counts one more of `kind`; returns whether to report it.
    pub(crate) fn counts(&mut self, kind: &'static str) -> bool {
        let count = self.kinds.entry(kind).or_default();
        *count += 1;
        *count <= LISTED
    }

    /// Adds a finding that was counted.
    pub(crate) fn push(&mut self, finding: Finding) {
        self.listed.push(finding);
    }

    /// Returns the findings in their order, and the counts of the unreported ones.
    pub(crate) fn finish(mut self) -> Vec<Finding> {
        for (kind, count) in self.kinds.iter().filter(|(_, count)| **count > LISTED) {
            self.listed.push(Finding::warning(
                None,
                format!("{} more: {kind}", count - LISTED),
            ));
        }
        self.listed
    }
}
