//! Jobs that find tokens, lay them out, and save searches.

use std::sync::Arc;

use chereme_corpus::{KeptSearch, MapOptions, SearchOptions};
use chereme_sign::Component;

use super::{About, Job, Outcome};

/// Finds tokens.
pub(crate) fn search(query: String, options: SearchOptions) -> Job {
    Job::new(About::ASK, move |corpus, progress| {
        let answer = corpus.search_until(&query, &options, progress);
        answer.map(Outcome::Found)
    })
}

/// Returns the annotations before and after tokens, up to `most` on each side.
pub(crate) fn around(tokens: Vec<i64>, most: usize) -> Job {
    Job::new(About::ASK, move |corpus, _| {
        corpus.around(&tokens, most).map(Outcome::Around)
    })
}

/// Places the signs on a map by the similarity of these components.
pub(crate) fn map(components: Vec<Component>) -> Job {
    Job::new(About::ASK, move |corpus, progress| {
        let query = None;
        let options = MapOptions { components, query };
        Ok(Outcome::Mapped(Arc::new(corpus.map(&options, progress)?)))
    })
}

/// Saves searches under their names.
pub(crate) fn save_searches(all: Vec<KeptSearch>) -> Job {
    Job::change(move |corpus, _| corpus.keep_searches(&all))
}

/// Renames a saved search.
pub(crate) fn rename_search(from: String, to: String) -> Job {
    Job::change(move |corpus, _| corpus.rename_search(&from, &to))
}

/// Deletes a saved search.
pub(crate) fn delete_search(name: String) -> Job {
    Job::change(move |corpus, _| corpus.forget_search(&name))
}
