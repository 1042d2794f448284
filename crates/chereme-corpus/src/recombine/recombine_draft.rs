//! A recipe being drafted, which is evaluated again after every change.

use std::cell::RefCell;

use chereme_compose::{RecipeDraft, StepError};

use super::{RecombinationResult, cannot, read_recipe_text, recombination};
use crate::Corpus;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};
use crate::sources::CorpusSources;

/// The recipe being drafted, and the generation of the corpus for which its results are valid.
#[derive(Default)]
pub(crate) struct DraftedRecipe {
    draft: RecipeDraft,
    generation: i64,
}

impl Corpus {
    /// Evaluates a recipe that is being drafted, and stores nothing.
    ///
    /// Returns the same as [`preview`](Self::preview_recipe). Parts of the recipe that have not changed since the last draft
    /// are not evaluated again as long as the corpus stays the same. With `again` everything is looked up again,
    /// including files that recipes name.
    ///
    /// # Errors
    /// As [`preview`](Self::preview_recipe), and [`CorpusError::Stopped`] if the receiver asks to stop between two steps; the
    /// results of finished steps are kept.
    pub fn draft_recipe(
        &mut self,
        recipe: &str,
        again: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<RecombinationResult> {
        let recipe = read_recipe_text(recipe)?;
        let inventories = self.inventories_now()?;
        let generation = self.corpus_generation()?;
        if again || self.drafted.generation != generation {
            self.drafted.draft.forget_draft_results();
            self.drafted.generation = generation;
        }
        let sources = CorpusSources::open_corpus_sources(&mut self.store, &inventories, &self.learned)?;
        let progress = RefCell::new(progress);
        let goes_on = || {
            let step = ProgressStep {
                task: "",
                done: 0,
                total: None,
                unit: ProgressUnit::Items,
            };
            progress.borrow_mut().report_step(step).is_ok()
        };
        let made = self.drafted.draft.generate_draft(&recipe, &sources, &goes_on);
        match made {
            Ok(made) => Ok(recombination(&recipe, String::new(), made)),
            Err(error) if matches!(error.cause, StepError::Stopped) => Err(CorpusError::Stopped),
            Err(error) => Err(cannot(error)),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::progress::{ProgressReceiver, ProgressStep, ignore_progress_step};
    use crate::{Corpus, CorpusError, ImportOptions, unpack_starter};
    use std::ops::ControlFlow;

    fn corpus(folder: &std::path::Path) -> Corpus {
        let mut files = unpack_starter(&folder.join("files")).expect("unpacked");
        files.retain(|path| path.file_stem().is_some_and(|stem| stem == "escargot"));
        let mut corpus = Corpus::create_corpus(&folder.join("a.chereme"), "A").expect("made");
        let mut hear = ignore_progress_step;
        let options = ImportOptions::default();
        let report = corpus.import_paths(&files, &options, &mut ProgressReceiver::new(&mut hear));
        report.expect("imported");
        corpus
    }

    #[test]
    fn a_draft_equals_a_preview_even_after_the_corpus_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus(folder.path());
        let mut hear = ignore_progress_step;
        let mut same = |corpus: &mut Corpus, recipe: &str| {
            let drafted = corpus.draft_recipe(recipe, false, &mut ProgressReceiver::new(&mut hear));
            let drafted = drafted.expect("made");
            let whole = corpus.preview_recipe(recipe).expect("made");
            assert_eq!(drafted.clip, whole.clip, "{recipe}");
            assert_eq!(drafted.report, whole.report, "{recipe}");
            assert_eq!(drafted.notes, whole.notes, "{recipe}");
        };
        same(&mut corpus, "ESCARGOT | configure right U");
        same(&mut corpus, "ESCARGOT | configure right U | swap");
        corpus.recombine_recipe("ESCARGOT | swap", "GAUCHE").expect("stored");
        same(&mut corpus, "GAUCHE | swap");
        corpus.undo_operation().expect("undone");
        let mut unheard = ignore_progress_step;
        let gone = corpus.draft_recipe("GAUCHE | swap", false, &mut ProgressReceiver::new(&mut unheard));
        assert!(gone.is_err(), "what is gone is not taken from before");
    }

    #[test]
    fn a_cancelled_draft_is_stopped() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus(folder.path());
        let mut stop = |_: ProgressStep<'_>| ControlFlow::Break(());
        let stopped = corpus.draft_recipe("ESCARGOT", false, &mut ProgressReceiver::new(&mut stop));
        assert!(matches!(stopped, Err(CorpusError::Stopped)));
    }
}
