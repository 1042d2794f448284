//! What a list of changes did, for the history.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::{SignComponent, TierRole};

use super::AnnotateReport;
use crate::db::stored_tiers::TierRow;
use crate::words::effect::{AnnotationDeed, AnnotationEffect, ValuedThing};

/// Changes of annotations that the history names, such as a merge.
#[derive(Debug, Default)]
pub(super) struct AnnotationDeeds {
    moved: BTreeSet<i64>,
    merged: BTreeSet<i64>,
    split: BTreeSet<i64>,
    /// The number of merges; each removes an annotation.
    merges: u64,
    /// Annotations that got a value, by what it says something about, and the value.
    valued: BTreeMap<(ValuedThing, String), BTreeSet<i64>>,
    /// Whether anything else changed; the history then counts added, changed and removed annotations instead.
    other: bool,
}

impl AnnotationDeeds {
    pub(super) fn note_moved_annotation(&mut self, annotation: i64) {
        self.moved.insert(annotation);
    }

    pub(super) fn note_merged_annotations(&mut self, first: i64, second: i64) {
        self.merged.extend([first, second]);
        self.merges += 1;
    }

    pub(super) fn note_split_annotation(&mut self, annotation: i64) {
        self.split.insert(annotation);
    }

    /// Records that an annotation of a tier got a value.
    pub(super) fn note_annotation_value(&mut self, tier: &TierRow, annotation: i64, value: &str) {
        let key = (valued_thing(&tier.role), value.to_owned());
        self.valued.entry(key).or_default().insert(annotation);
    }

    pub(super) fn does_else(&mut self) {
        self.other = true;
    }

    /// Returns what was done, and where.
    pub(super) fn collected_deed_effect(&self, report: &AnnotateReport) -> AnnotationEffect {
        let mut changes = match self.other {
            true => Vec::new(),
            false => self.named_deeds(report.removed),
        };
        if changes.is_empty() {
            changes = counted_deeds(report);
        }
        AnnotationEffect::from_changes(changes, &report.recordings)
    }

    /// Returns the named changes; `removed` annotations were removed.
    fn named_deeds(&self, removed: u64) -> Vec<AnnotationDeed> {
        use AnnotationDeed as Deed;
        let counted = |all: &BTreeSet<i64>| Some(all.len() as u64).filter(|count| *count > 0);
        let mut valued_deeds = self.valued.iter();
        let valued = match (valued_deeds.next(), valued_deeds.next()) {
            (None, _) => None,
            (Some(((of, value), all)), None) => Some(Deed::AnnotationsValued {
                count: all.len() as u64,
                of: *of,
                value: value.clone(),
            }),
            _ => {
                let all: BTreeSet<i64> = self.valued.values().flatten().copied().collect();
                counted(&all).map(|count| Deed::AnnotationsRevalued { count })
            }
        };
        // Annotations below a moved one that lie outside of it are removed with it.
        let unmerged_count = removed.checked_sub(self.merges).filter(|count| *count > 0);
        let removed = unmerged_count.filter(|_| !self.moved.is_empty());
        let deeds = [
            counted(&self.moved).map(|count| Deed::AnnotationsMoved { count }),
            counted(&self.merged).map(|count| Deed::AnnotationsMerged { count }),
            counted(&self.split).map(|count| Deed::AnnotationsSplit { count }),
            removed.map(|count| Deed::AnnotationsRemoved { count }),
            valued,
        ];
        deeds.into_iter().flatten().collect()
    }
}

fn counted_deeds(report: &AnnotateReport) -> Vec<AnnotationDeed> {
    use AnnotationDeed as Deed;
    let counted = |count: u64, deed: fn(u64) -> Deed| (count > 0).then(|| deed(count));
    let deeds = [
        counted(report.added, |count| Deed::AnnotationsAdded { count }),
        counted(report.changed, |count| Deed::AnnotationsChanged { count }),
        counted(report.removed, |count| Deed::AnnotationsRemoved { count }),
    ];
    deeds.into_iter().flatten().collect()
}

/// Returns what the annotations of tiers with this role say something about.
fn valued_thing(role: &TierRole) -> ValuedThing {
    let component = match role {
        TierRole::Gloss => return ValuedThing::Gloss,
        TierRole::Component { component, .. } => component,
        _ => return ValuedThing::Annotation,
    };
    match component {
        SignComponent::Configuration => ValuedThing::Handshape,
        SignComponent::Placement => ValuedThing::Placement,
        SignComponent::Movement => ValuedThing::Movement,
        SignComponent::Orientation => ValuedThing::Orientation,
        SignComponent::NonManual => ValuedThing::Annotation,
    }
}
