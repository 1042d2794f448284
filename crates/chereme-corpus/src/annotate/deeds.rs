//! The summary line of the history for a list of changes.

use std::collections::{BTreeMap, BTreeSet};

use super::AnnotateReport;
use crate::db::tiers::TierRow;
use crate::words::{Text, counted, deeds as words, fill};

/// Changes of annotations for which the summary has a specific sentence, such as a merge.
#[derive(Debug, Default)]
pub(super) struct Deeds {
    moved: BTreeSet<i64>,
    merged: BTreeSet<i64>,
    split: BTreeSet<i64>,
    /// The number of merges; each removes an annotation.
    merges: u64,
    /// Annotations that got a value, by the sentence for it and the value.
    valued: BTreeMap<(&'static str, String), (Text, Text, BTreeSet<i64>)>,
    /// Whether anything else changed; the summary then counts added, changed and removed annotations instead.
    other: bool,
}

impl Deeds {
    pub(super) fn moves(&mut self, annotation: i64) {
        self.moved.insert(annotation);
    }

    pub(super) fn merges(&mut self, first: i64, second: i64) {
        self.merged.extend([first, second]);
        self.merges += 1;
    }

    pub(super) fn splits(&mut self, annotation: i64) {
        self.split.insert(annotation);
    }

    /// Records that an annotation of a tier got a value.
    pub(super) fn says(&mut self, tier: &TierRow, annotation: i64, value: &str) {
        let [one, several] = words::valued(&tier.role);
        let key = (several.en, value.to_owned());
        let known = self.valued.entry(key);
        let known = known.or_insert_with(|| (one, several, BTreeSet::new()));
        known.2.insert(annotation);
    }

    pub(super) fn does_else(&mut self) {
        self.other = true;
    }

    /// Returns the summary.
    pub(super) fn summary(&self, report: &AnnotateReport) -> String {
        let named = self.named(report.removed);
        let what = if self.other || named.is_empty() {
            counts(report)
        } else {
            named
        };
        let place = match report.recordings.as_slice() {
            [one] => one.clone(),
            several => counted(several.len() as u64, "recordings"),
        };
        format!("{} in {place}", what.join(", "))
    }

    /// Returns the sentences; `removed` annotations were removed.
    fn named(&self, removed: u64) -> Vec<String> {
        let say = |(one, several): (Text, Text), all: &BTreeSet<i64>, value: &str| {
            let text = if all.len() == 1 { one } else { several };
            let text = fill(text.en, &[("n", &all.len())]);
            (!all.is_empty()).then(|| fill(&text, &[("value", &value)]))
        };
        let none = BTreeSet::new();
        let mut valued = self.valued.iter();
        let valued = match (valued.next(), valued.next()) {
            (Some(((_, value), (one, several, all))), None) => say((*one, *several), all, value),
            (None, _) => say((words::ONE_SAYS, words::SAY), &none, ""),
            _ => {
                let all = self.valued.values().flat_map(|it| &it.2).copied();
                say((words::ONE_SAYS, words::SAY), &all.collect(), "")
            }
        };
        // Annotations below a moved one that lie outside of it are removed with it.
        let removed = removed.checked_sub(self.merges).filter(|count| *count > 0);
        let removed = removed.filter(|_| !self.moved.is_empty());
        let removed = removed.map(|count| format!("{count} removed"));
        let parts = [
            say((words::ONE_MOVED, words::MOVED), &self.moved, ""),
            say((words::MERGED, words::MERGED), &self.merged, ""),
            say((words::ONE_SPLIT, words::SPLIT), &self.split, ""),
            removed,
            // A value may contain any text, including the separator of these parts.
            valued,
        ];
        parts.into_iter().flatten().collect()
    }
}

fn counts(report: &AnnotateReport) -> Vec<String> {
    let counts = [
        (report.added, "added"),
        (report.changed, "changed"),
        (report.removed, "removed"),
    ];
    counts
        .iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect()
}
