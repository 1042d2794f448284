//! Names that occur once.

use std::collections::{BTreeMap, BTreeSet};

/// The names that were given.
#[derive(Debug, Default)]
pub(crate) struct UniqueNames {
    taken: BTreeSet<String>,
    counts: BTreeMap<String, u64>,
}

impl UniqueNames {
    /// Returns a name that was not given before: the wanted one, or one with a number after it, as `gloss (2)`.
    pub(crate) fn give_unique_name(&mut self, wanted: &str) -> String {
        self.give_numbered_name(wanted, |name, count| format!("{name} ({count})"))
    }

    /// Returns an id that was not given before: the wanted one, or one with a number after it, as `i5-2`.
    pub(crate) fn give_unique_id(&mut self, wanted: &str) -> String {
        self.give_numbered_name(wanted, |name, count| format!("{name}-{count}"))
    }

    fn give_numbered_name(&mut self, wanted: &str, numbered: impl Fn(&str, u64) -> String) -> String {
        let mut unique = wanted.to_owned();
        while !self.taken.insert(unique.clone()) {
            let count = self.counts.entry(wanted.to_owned()).or_insert(1);
            *count += 1;
            unique = numbered(wanted, *count);
        }
        unique
    }
}
