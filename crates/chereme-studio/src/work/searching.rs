//! Jobs that find tokens, lay them out, and save searches.

use std::sync::Arc;

use chereme_corpus::{KeptSearch, LexiconScope, MapOptions, SearchOptions};
use chereme_sign::SignComponent;

use super::{CorpusJob, JobAbout, WorkOutcome};

/// Finds tokens.
pub(crate) fn search_tokens_job(query: String, options: SearchOptions) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, progress| {
        let answer = corpus.search_until(&query, &options, progress);
        answer.map(WorkOutcome::Found)
    })
}

/// Counts the values of one field, or of two, among the tokens that a query finds.
pub(crate) fn tally_values_job(query: String, fields: Vec<String>) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, progress| {
        let tally = corpus.tally_values(&query, &fields, progress);
        tally.map(WorkOutcome::Tallied)
    })
}

/// Returns the annotations before and after tokens, up to `most` on each side.
pub(crate) fn load_neighbours_job(tokens: Vec<i64>, most: usize) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, _| {
        corpus.annotations_around_tokens(&tokens, most).map(WorkOutcome::Around)
    })
}

/// Places the signs on a map by the similarity of these components.
pub(crate) fn map_signs_job(components: Vec<SignComponent>) -> CorpusJob {
    CorpusJob::new(JobAbout::ASK_JOB_ABOUT, move |corpus, progress| {
        let query = None;
        let options = MapOptions {
            components,
            query,
            scope: LexiconScope::Across,
        };
        Ok(WorkOutcome::Mapped(Arc::new(
            corpus.arrange_sign_map(&options, progress)?,
        )))
    })
}

/// Saves searches under their names.
pub(crate) fn save_searches(all: Vec<KeptSearch>) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.keep_searches(&all))
}

/// Renames a saved search.
pub(crate) fn rename_search(from: String, to: String) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.rename_search(&from, &to))
}

/// Deletes a saved search.
pub(crate) fn delete_search(name: String) -> CorpusJob {
    CorpusJob::new_change_job(move |corpus, _| corpus.forget_search(&name))
}
