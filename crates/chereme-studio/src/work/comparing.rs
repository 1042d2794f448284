//! Jobs that compare annotators, or signs, with each other.

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{AgreeOptions, AnnotatorAgreement, SignMeasureOptions, SignMeasures};

use super::{CorpusJob, JobAbout, WorkLane, WorkOutcome};
use crate::words::{agreement as words, measures_words};

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

/// Measures the signs of a lexicon one by one.
pub(crate) fn measure_signs_job(options: SignMeasureOptions) -> CorpusJob {
    let about = JobAbout {
        task: measures_words::TASK,
        ..COMPARE_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        let measures = corpus.measure_signs(&options, progress)?;
        Ok(WorkOutcome::SignsMeasured(Arc::new(measures)))
    })
}

/// Stores measures as attributes of the signs.
pub(crate) fn store_measures_job(measures: Arc<SignMeasures>) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.store_sign_measures(&measures))
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
