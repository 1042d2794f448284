//! Jobs about the expressions of faces.

use std::sync::Arc;

use chereme_corpus::{ChooseOptions, CorpusAddress, ExpressionFunction, MilestoneOptions};

use super::{CorpusJob, JobAbout, WorkOutcome};

/// Finds the expressions of faces with their milestones.
pub(crate) fn find_expressions_job() -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, |corpus, progress| {
        let options = MilestoneOptions {
            dry_run: true,
            ..MilestoneOptions::default()
        };
        let found_expressions = corpus.derive_face_milestones(&options, progress)?;
        Ok(WorkOutcome::Expressions(Arc::new(found_expressions)))
    })
}

/// Writes the milestones of every expression of a function onto tiers.
pub(crate) fn write_milestones_job(function: ExpressionFunction) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, progress| {
        let options = MilestoneOptions {
            function: Some(function),
            ..MilestoneOptions::default()
        };
        corpus.derive_face_milestones(&options, progress)
    })
}

/// Ranks the performances of a function for the sentence `target`.
pub(crate) fn choose_performance_job(
    function: ExpressionFunction,
    target: CorpusAddress,
    options: ChooseOptions,
) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, progress| {
        let choice = corpus.choose_performances(&function, &target, &options, progress)?;
        Ok(WorkOutcome::Chosen(Arc::new(choice)))
    })
}

/// Measures when non-manuals begin and end, for one function or for all.
pub(crate) fn measure_onsets_job(function: Option<ExpressionFunction>) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, progress| {
        let onsets = corpus.measure_nonmanual_onsets(function.as_ref(), progress)?;
        Ok(WorkOutcome::Onsets(Arc::new(onsets)))
    })
}
