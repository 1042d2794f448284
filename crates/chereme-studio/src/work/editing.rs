//! Jobs that edit annotations and tiers.

use chereme_corpus::{
    AnnotateOptions, AnnotationChange, CopiedAnnotations, NewTier, RowName, TierPropertyChange, TierRequestName,
    TierRoundOptions, TierRoundScope, TierRoundWork, TierScheme,
};

use super::{CorpusJob, JobAbout, WorkOutcome};
use crate::words::tier_round_words;

/// Changes annotations, as one operation.
pub(crate) fn annotate_corpus_job(changes: Vec<AnnotationChange>) -> CorpusJob {
    CorpusJob::new(JobAbout::EDIT_JOB_ABOUT, move |corpus, progress| {
        let options = AnnotateOptions::default();
        let report = corpus.annotate_corpus(&changes, &options, progress);
        report.map(WorkOutcome::Annotated)
    })
}

/// Adds a tier.
pub(crate) fn add_tier(tier: NewTier) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.add_tier(&tier))
}

/// Gives a recording the tiers of a scheme.
pub(crate) fn add_tiers(recording: RowName, scheme: TierScheme) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.add_tiers(&recording, &scheme))
}

/// Does the same work on the tiers of many recordings, or only reports what it would do.
pub(crate) fn work_on_tiers_job(scope: TierRoundScope, work: TierRoundWork, options: TierRoundOptions) -> CorpusJob {
    let about = JobAbout {
        task: tier_round_words::TASK,
        quiet: true,
        may_stop: true,
        ..JobAbout::EDIT_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        let report = corpus.work_on_tiers(&scope, &work, options, progress);
        report.map(WorkOutcome::Toured)
    })
}

/// Changes a tier.
pub(crate) fn change_tier_job(tier: TierRequestName, change: TierPropertyChange) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.change_tier_properties(&tier, &change))
}

/// Copies a tier under another name.
pub(crate) fn copy_tier(tier: TierRequestName, name: String, copied: CopiedAnnotations) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.copy_tier(&tier, &name, &copied))
}

/// Puts the tiers of a recording in an order.
pub(crate) fn order_tiers(recording: RowName, order: Vec<i64>) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.order_tiers(&recording, &order))
}

/// Removes a tier.
pub(crate) fn remove_tier(tier: TierRequestName) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.remove_tier(&tier))
}
