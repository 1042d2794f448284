//! Jobs that infer annotations from movement, and compare annotations with each other.

use chereme_corpus::{CuedOptions, DetectOptions, Name, ProposeOptions};
use chereme_sign::Component;

use super::{About, Job, Outcome};
use crate::words::{Language, fill, shell};

const PROPOSE: About = About {
    task: shell::TASK_PROPOSE,
    may_stop: true,
    ..About::EDIT
};

/// Proposes values for a sign, a span or a recording.
pub(crate) fn propose(options: ProposeOptions) -> Job {
    Job::new(PROPOSE, move |corpus, progress| {
        corpus.propose(&options, progress).map(Outcome::Proposed)
    })
}

/// Infers a component that is not coded from movement, and stores proposals.
pub(crate) fn propose_coding(component: Component) -> Job {
    Job::new(PROPOSE, move |corpus, progress| {
        let proposed = corpus.propose_coding(component, progress);
        proposed.map(Outcome::Proposed)
    })
}

/// Runs a detector, stores its proposals, and reports their number in `language`.
pub(crate) fn detect(options: DetectOptions, language: Language) -> Job {
    Job::new(PROPOSE, move |corpus, progress| {
        let found = corpus.detect(&options, progress)?.annotations;
        let text = match found {
            0 => shell::NOTICE_NOT_DETECTED,
            _ => shell::NOTICE_DETECTED,
        };
        Ok(Outcome::Said(fill(text.of(language), &[("n", &found)])))
    })
}

/// Accepts these proposals.
pub(crate) fn accept(annotations: Vec<i64>) -> Job {
    Job::new(About::EDIT, move |corpus, progress| {
        let report = corpus.accept_proposals(&annotations, progress);
        report.map(Outcome::Annotated)
    })
}

/// Compares the keys of a recording with those that its phones predict in the named code.
pub(crate) fn cue_slips(recording: i64, code: String) -> Job {
    Job::new(About::ASK, move |corpus, _| {
        let options = CuedOptions {
            code,
            ..CuedOptions::default()
        };
        let slips = corpus.cue_slips(&Name::Number(recording), None, false, &options)?;
        Ok(Outcome::CueSlips(Box::new(slips)))
    })
}
