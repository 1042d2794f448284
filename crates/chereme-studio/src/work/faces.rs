//! Jobs about the expressions of faces.

use std::sync::Arc;

use chereme_corpus::{Address, ChooseOptions, Function, MilestoneOptions};

use super::{About, Job, Outcome};

/// Finds the expressions of faces with their milestones.
pub(crate) fn expressions() -> Job {
    Job::new(About::ASK, |corpus, progress| {
        let options = MilestoneOptions {
            dry_run: true,
            ..MilestoneOptions::default()
        };
        let found = corpus.milestones(&options, progress)?;
        Ok(Outcome::Expressions(Arc::new(found)))
    })
}

/// Writes the milestones of every expression of a function onto tiers.
pub(crate) fn milestones(function: Function) -> Job {
    Job::change(move |corpus, progress| {
        let options = MilestoneOptions {
            function: Some(function),
            ..MilestoneOptions::default()
        };
        corpus.milestones(&options, progress)
    })
}

/// Ranks the performances of a function for the sentence `target`.
pub(crate) fn choose(function: Function, target: Address, options: ChooseOptions) -> Job {
    Job::new(About::ASK, move |corpus, progress| {
        let choice = corpus.choose(&function, &target, &options, progress)?;
        Ok(Outcome::Chosen(Arc::new(choice)))
    })
}

/// Measures when non-manuals begin and end, for one function or for all.
pub(crate) fn onsets(function: Option<Function>) -> Job {
    Job::new(About::ASK, move |corpus, progress| {
        let onsets = corpus.onsets(function.as_ref(), progress)?;
        Ok(Outcome::Onsets(Arc::new(onsets)))
    })
}
