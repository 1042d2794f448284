//! Jobs that edit annotations and tiers.

use chereme_corpus::{
    AnnotateOptions, AnnotationChange, Copied, Name, NewTier, Scheme, TierChange, TierName,
};

use super::{About, Job, Outcome};

/// Changes annotations, as one operation.
pub(crate) fn annotate(changes: Vec<AnnotationChange>) -> Job {
    Job::new(About::EDIT, move |corpus, progress| {
        let options = AnnotateOptions::default();
        let report = corpus.annotate(&changes, &options, progress);
        report.map(Outcome::Annotated)
    })
}

/// Adds a tier.
pub(crate) fn add_tier(tier: NewTier) -> Job {
    Job::change(move |corpus, _| corpus.add_tier(&tier))
}

/// Gives a recording the tiers of a scheme.
pub(crate) fn add_tiers(recording: Name, scheme: Scheme) -> Job {
    Job::change(move |corpus, _| corpus.add_tiers(&recording, &scheme))
}

/// Changes a tier.
pub(crate) fn change_tier(tier: TierName, change: TierChange) -> Job {
    Job::change(move |corpus, _| corpus.change_tier(&tier, &change))
}

/// Copies a tier under another name.
pub(crate) fn copy_tier(tier: TierName, name: String, copied: Copied) -> Job {
    Job::change(move |corpus, _| corpus.copy_tier(&tier, &name, &copied))
}

/// Puts the tiers of a recording in an order.
pub(crate) fn order_tiers(recording: Name, order: Vec<i64>) -> Job {
    Job::change(move |corpus, _| corpus.order_tiers(&recording, &order))
}

/// Removes a tier.
pub(crate) fn remove_tier(tier: TierName) -> Job {
    Job::change(move |corpus, _| corpus.remove_tier(&tier))
}
