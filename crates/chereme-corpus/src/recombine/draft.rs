//! A recipe being drafted, which is evaluated again after every change.

use std::cell::RefCell;

use chereme_compose::{Cause, Draft};

use super::{Recombination, cannot, read, recombination};
use crate::Corpus;
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit};
use crate::sources::CorpusSources;

/// The recipe being drafted, and the generation of the corpus for which its results are valid.
#[derive(Default)]
pub(crate) struct Drafted {
    draft: Draft,
    generation: i64,
}

impl Corpus {
    /// Evaluates a recipe that is being drafted, and stores nothing.
    ///
    /// Returns the same as [`preview`](Self::preview). Parts of the recipe that have not changed since the last draft
    /// are not evaluated again as long as the corpus stays the same. With `again` everything is looked up again,
    /// including files that recipes name.
    ///
    /// # Errors
    /// As [`preview`](Self::preview), and [`Error::Stopped`] if the receiver asks to stop between two steps; the
    /// results of finished steps are kept.
    pub fn draft(
        &mut self,
        recipe: &str,
        again: bool,
        progress: &mut Progress<'_>,
    ) -> Result<Recombination> {
        let recipe = read(recipe)?;
        let inventories = self.inventories_now()?;
        let generation = self.generation()?;
        if again || self.drafted.generation != generation {
            self.drafted.draft.forget();
            self.drafted.generation = generation;
        }
        let sources = CorpusSources::open(&mut self.store, &inventories, &self.learned)?;
        let progress = RefCell::new(progress);
        let goes_on = || {
            let step = Step {
                task: "",
                done: 0,
                total: None,
                unit: Unit::Items,
            };
            progress.borrow_mut().report(step).is_ok()
        };
        let made = self.drafted.draft.make(&recipe, &sources, &goes_on);
        match made {
            Ok(made) => Ok(recombination(&recipe, String::new(), made)),
            Err(error) if matches!(error.cause, Cause::Stopped) => Err(Error::Stopped),
            Err(error) => Err(cannot(error)),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::progress::{Progress, Step, unheard};
    use crate::{Corpus, Error, ImportOptions, unpack_starter};
    use std::ops::ControlFlow;

    fn corpus(folder: &std::path::Path) -> Corpus {
        let mut files = unpack_starter(&folder.join("files")).expect("unpacked");
        files.retain(|path| path.file_stem().is_some_and(|stem| stem == "escargot"));
        let mut corpus = Corpus::create(&folder.join("a.chereme"), "A").expect("made");
        let mut hear = unheard;
        let options = ImportOptions::default();
        let report = corpus.import(&files, &options, &mut Progress::new(&mut hear));
        report.expect("imported");
        corpus
    }

    #[test]
    fn a_draft_equals_a_preview_even_after_the_corpus_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus(folder.path());
        let mut hear = unheard;
        let mut same = |corpus: &mut Corpus, recipe: &str| {
            let drafted = corpus.draft(recipe, false, &mut Progress::new(&mut hear));
            let drafted = drafted.expect("made");
            let whole = corpus.preview(recipe).expect("made");
            assert_eq!(drafted.clip, whole.clip, "{recipe}");
            assert_eq!(drafted.report, whole.report, "{recipe}");
            assert_eq!(drafted.notes, whole.notes, "{recipe}");
        };
        same(&mut corpus, "ESCARGOT | configure right U");
        same(&mut corpus, "ESCARGOT | configure right U | swap");
        corpus
            .recombine("ESCARGOT | swap", "GAUCHE")
            .expect("stored");
        same(&mut corpus, "GAUCHE | swap");
        corpus.undo().expect("undone");
        let mut unheard = unheard;
        let gone = corpus.draft("GAUCHE | swap", false, &mut Progress::new(&mut unheard));
        assert!(gone.is_err(), "what is gone is not taken from before");
    }

    #[test]
    fn a_cancelled_draft_is_stopped() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut corpus = corpus(folder.path());
        let mut stop = |_: Step<'_>| ControlFlow::Break(());
        let stopped = corpus.draft("ESCARGOT", false, &mut Progress::new(&mut stop));
        assert!(matches!(stopped, Err(Error::Stopped)));
    }
}
