//! Findings of hostile files, which may be millions of one kind.

use crate::finding::Finding;
use std::collections::BTreeMap;

/// How often findings of one kind are told one by one.
const TOLD: u64 = 20;

/// Collects findings; of one kind only the first few are told one by one and the rest counted.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    told: Vec<Finding>,
    kinds: BTreeMap<&'static str, u64>,
}

impl Findings {
    /// Adds the finding made by `make`, unless enough of its `kind` were told.
    pub(crate) fn add(&mut self, kind: &'static str, make: impl FnOnce() -> Finding) {
        if self.counts(kind) {
            self.told.push(make());
        }
    }

    /// Counts one more of `kind` and says whether it is to be told.
    pub(crate) fn counts(&mut self, kind: &'static str) -> bool {
        let count = self.kinds.entry(kind).or_default();
        *count += 1;
        *count <= TOLD
    }

    /// Adds a finding that was counted.
    pub(crate) fn push(&mut self, finding: Finding) {
        self.told.push(finding);
    }

    /// Returns what was found, in the order in which it was, and the counts of what was not told.
    pub(crate) fn finish(mut self) -> Vec<Finding> {
        for (kind, count) in self.kinds.iter().filter(|(_, count)| **count > TOLD) {
            self.told.push(Finding::warning(
                None,
                format!("{} more: {kind}", count - TOLD),
            ));
        }
        self.told
    }
}
