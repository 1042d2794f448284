//! Jobs that compare annotators with each other.

use std::sync::Arc;

use chereme_corpus::AgreeOptions;

use super::{About, Job, Lane, Outcome};
use crate::words::agreement as words;

const COMPARE: About = About {
    lane: Lane::Compare,
    task: words::TASK,
    quiet: true,
    may_stop: true,
};

/// Compares two tiers.
pub(crate) fn agree(options: AgreeOptions) -> Job {
    Job::new(COMPARE, move |corpus, progress| {
        let found = corpus.agree(&options, progress)?;
        Ok(Outcome::Agreed(Arc::new(found)))
    })
}

/// Writes a third tier of that name with what both agree on, and a conflict for each disagreement.
pub(crate) fn adjudicate(options: AgreeOptions, into: String) -> Job {
    Job::long(words::TASK, move |corpus, progress| {
        let done = corpus.adjudicate(&options, &into, progress)?;
        Ok(Outcome::Adjudicated(done))
    })
}
