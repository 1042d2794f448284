//! Jobs that compare annotators with each other.

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{AgreeOptions, Agreement};

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

/// Writes the disagreements as a table.
pub(crate) fn write(found: Arc<Agreement>, to: PathBuf, force: bool) -> Job {
    Job::new(About::WRITE, move |_, _| {
        found.write_disagreements(&to, force)?;
        Ok(Outcome::DisagreementsWritten)
    })
}

/// Writes a third tier of that name with what both agree on, and a conflict for each disagreement.
pub(crate) fn adjudicate(options: AgreeOptions, into: String) -> Job {
    Job::long(words::TASK, move |corpus, progress| {
        let done = corpus.adjudicate(&options, &into, progress)?;
        Ok(Outcome::Adjudicated(done))
    })
}
