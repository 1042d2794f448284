//! Jobs that evaluate recipes: to look at the sign, or to store it.

use std::sync::Arc;

use chereme_corpus::{CorpusAddress, RowName};

use super::{CorpusJob, JobAbout, WorkLane, WorkOutcome};
use crate::words::shell;

/// The open recipe, to be evaluated.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OpenRecipeDraft {
    pub(crate) recipe: String,
    /// Whether to look everything up again.
    pub(crate) again: bool,
}

const STORE_JOB_ABOUT: JobAbout = JobAbout {
    task: shell::TASK_RECOMBINE,
    ..JobAbout::EDIT_JOB_ABOUT
};

/// Generates a sign from a recipe and stores it under a new gloss.
pub(crate) fn store_recipe_job(recipe: String, gloss: String) -> CorpusJob {
    CorpusJob::new(STORE_JOB_ABOUT, move |corpus, _| {
        let stored = corpus.recombine_recipe(&recipe, &gloss)?;
        Ok(WorkOutcome::Recombined(Box::new(stored)))
    })
}

/// Generates a sign from a recipe and stores it in place of an earlier one.
pub(crate) fn store_again(recipe: String, recording: i64) -> CorpusJob {
    CorpusJob::new(STORE_JOB_ABOUT, move |corpus, _| {
        let sign = CorpusAddress::Recording(RowName::Number(recording));
        let stored = corpus.recombine_again(&sign, &recipe)?;
        Ok(WorkOutcome::Recombined(Box::new(stored)))
    })
}

/// Generates the movement of a recipe and stores nothing.
pub(crate) fn preview_recipe_job(recipe: String) -> CorpusJob {
    CorpusJob::new(JobAbout::PREVIEW_JOB_ABOUT, move |corpus, _| {
        let made = corpus.preview_recipe(&recipe)?;
        Ok(WorkOutcome::Previewed(Arc::new(made)))
    })
}

/// Generates the movement of the open recipe, using stored results for unchanged parts.
pub(crate) fn evaluate_draft_job(draft: OpenRecipeDraft) -> CorpusJob {
    let about = JobAbout {
        lane: WorkLane::Draft,
        ..JobAbout::PREVIEW_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, progress| {
        let made = corpus.draft_recipe(&draft.recipe, draft.again, progress)?;
        Ok(WorkOutcome::Previewed(Arc::new(made)))
    })
}

/// Suggests recipes for a token.
pub(crate) fn suggest_recipes_job(token: CorpusAddress) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, _| {
        corpus.suggest_new_signs(&token, false).map(WorkOutcome::Suggested)
    })
}
