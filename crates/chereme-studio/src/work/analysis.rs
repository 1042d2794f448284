//! Jobs that infer annotations from movement, and compare annotations with each other.

use chereme_corpus::{CuedOptions, DetectOptions, ProposeOptions, RowName};
use chereme_sign::SignComponent;

use super::{CorpusJob, JobAbout, WorkOutcome};
use crate::words::{InterfaceLanguage, fill_text_braces, shell};

const PROPOSE_JOB_ABOUT: JobAbout = JobAbout {
    task: shell::TASK_PROPOSE,
    may_stop: true,
    ..JobAbout::EDIT_JOB_ABOUT
};

/// Proposes values for a sign, a span or a recording.
pub(crate) fn propose_values_job(options: ProposeOptions) -> CorpusJob {
    CorpusJob::new(PROPOSE_JOB_ABOUT, move |corpus, progress| {
        corpus.propose_components(&options, progress).map(WorkOutcome::Proposed)
    })
}

/// Infers a component that is not coded from movement, and stores proposals.
pub(crate) fn propose_coding(component: SignComponent) -> CorpusJob {
    CorpusJob::new(PROPOSE_JOB_ABOUT, move |corpus, progress| {
        let proposed = corpus.propose_coding(component, progress);
        proposed.map(WorkOutcome::Proposed)
    })
}

/// Runs a detector, stores its proposals, and reports their number in `language`.
pub(crate) fn run_detector_job(options: DetectOptions, language: InterfaceLanguage) -> CorpusJob {
    CorpusJob::new(PROPOSE_JOB_ABOUT, move |corpus, progress| {
        let annotation_count = corpus.run_detection(&options, progress)?.annotations;
        let text = match annotation_count {
            0 => shell::NOTICE_NOT_DETECTED,
            _ => shell::NOTICE_DETECTED,
        };
        Ok(WorkOutcome::Said(fill_text_braces(
            text.text_in_language(language),
            &[("n", &annotation_count)],
        )))
    })
}

/// Accepts these proposals.
pub(crate) fn accept_proposals_job(annotations: Vec<i64>) -> CorpusJob {
    CorpusJob::new(JobAbout::EDIT_JOB_ABOUT, move |corpus, progress| {
        let report = corpus.accept_proposals(&annotations, progress);
        report.map(WorkOutcome::Annotated)
    })
}

/// Rejects these proposals.
pub(crate) fn reject_proposals_job(annotations: Vec<i64>) -> CorpusJob {
    CorpusJob::new(JobAbout::EDIT_JOB_ABOUT, move |corpus, progress| {
        let report = corpus.reject_proposals(&annotations, progress);
        report.map(WorkOutcome::Annotated)
    })
}

/// Compares the keys of a recording with those that its phones predict in the named code.
pub(crate) fn cue_slips(recording: i64, code: String) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, _| {
        let options = CuedOptions {
            code,
            ..CuedOptions::default()
        };
        let slips = corpus.cue_slips(&RowName::Number(recording), None, false, &options)?;
        Ok(WorkOutcome::CueSlips(Box::new(slips)))
    })
}
