//! Jobs that evaluate recipes: to look at the sign, or to store it.

use std::sync::Arc;

use chereme_corpus::{Address, Name};

use super::{About, Job, Lane, Outcome};
use crate::words::shell;

/// The open recipe, to be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Draft {
    pub(crate) recipe: String,
    /// Whether to look everything up again.
    pub(crate) again: bool,
}

const STORE: About = About {
    task: shell::TASK_RECOMBINE,
    ..About::EDIT
};

/// Generates a sign from a recipe and stores it under a new gloss.
pub(crate) fn store(recipe: String, gloss: String) -> Job {
    Job::new(STORE, move |corpus, _| {
        let stored = corpus.recombine(&recipe, &gloss)?;
        Ok(Outcome::Recombined(Box::new(stored)))
    })
}

/// Generates a sign from a recipe and stores it in place of an earlier one.
pub(crate) fn store_again(recipe: String, recording: i64) -> Job {
    Job::new(STORE, move |corpus, _| {
        let sign = Address::Recording(Name::Number(recording));
        let stored = corpus.recombine_again(&sign, &recipe)?;
        Ok(Outcome::Recombined(Box::new(stored)))
    })
}

/// Generates the movement of a recipe and stores nothing.
pub(crate) fn preview(recipe: String) -> Job {
    Job::new(About::PREVIEW, move |corpus, _| {
        let made = corpus.preview(&recipe)?;
        Ok(Outcome::Previewed(Arc::new(made)))
    })
}

/// Generates the movement of the open recipe, using stored results for unchanged parts.
pub(crate) fn draft(draft: Draft) -> Job {
    let about = About {
        lane: Lane::Draft,
        ..About::PREVIEW
    };
    Job::new(about, move |corpus, progress| {
        let made = corpus.draft(&draft.recipe, draft.again, progress)?;
        Ok(Outcome::Previewed(Arc::new(made)))
    })
}

/// Suggests recipes for a token.
pub(crate) fn suggest(token: Address) -> Job {
    Job::new(About::ASK, move |corpus, _| {
        corpus.suggest(&token).map(Outcome::Suggested)
    })
}
