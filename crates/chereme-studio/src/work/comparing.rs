//! Jobs that compare annotators with each other.

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{AgreeOptions, AnnotatorAgreement};

use super::{CorpusJob, JobAbout, WorkLane, WorkOutcome};
use crate::words::agreement as words;

const COMPARE_JOB_ABOUT: JobAbout = JobAbout {
    lane: WorkLane::Compare,
    task: words::TASK,
    quiet: true,
    may_stop: true,
};

/// Compares two tiers.
pub(crate) fn compare_tiers_job(options: AgreeOptions) -> CorpusJob {
    CorpusJob::new(COMPARE_JOB_ABOUT, move |corpus, progress| {
        let agreement = corpus.compare_annotators(&options, progress)?;
        Ok(WorkOutcome::Agreed(Arc::new(agreement)))
    })
}

/// Writes the disagreements as a table.
pub(crate) fn write_disagreements_job(found: Arc<AnnotatorAgreement>, to: PathBuf, force: bool) -> CorpusJob {
    CorpusJob::new(JobAbout::WRITE_JOB_ABOUT, move |_, _| {
        found.write_disagreements(&to, force)?;
        Ok(WorkOutcome::DisagreementsWritten)
    })
}

/// Writes a third tier of that name with what both agree on, and a conflict for each disagreement.
pub(crate) fn adjudicate_tiers_job(options: AgreeOptions, into: String) -> CorpusJob {
    CorpusJob::new_long_job(words::TASK, move |corpus, progress| {
        let done = corpus.adjudicate_tiers(&options, &into, progress)?;
        Ok(WorkOutcome::Adjudicated(done))
    })
}
