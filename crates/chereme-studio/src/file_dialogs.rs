//! The file choosers of the system, a complement to typed paths, which always work.

use crate::command::ChooserPurpose;
use std::future::Future;
use std::path::PathBuf;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake as TaskWake};

use rfd::{AsyncFileDialog, FileHandle};

use crate::command::WindowCommand;
use crate::words::{InterfaceLanguage, shell as words};
use crate::work::desk::WindowWaker;

/// The chosen paths; empty if nothing was chosen.
type ChosenPathsFuture = Pin<Box<dyn Future<Output = Vec<PathBuf>> + Send>>;
/// Shows a chooser.
pub(crate) type ShowChooser = fn(ChooserPurpose, InterfaceLanguage) -> ChosenPathsFuture;

/// The chooser that is open, if any.
pub(crate) struct FileChooser {
    pub(crate) show: ShowChooser,
    open: Option<(ChooserPurpose, ChosenPathsFuture, f64)>,
}

/// The result of an open chooser.
#[derive(Debug)]
pub(crate) enum ChooserResult {
    /// A path was chosen: carry out this command.
    Command(WindowCommand),
    /// The user closed the chooser.
    Nothing,
    /// The chooser ended sooner than a person can close it: this system has none, and the path is to be typed.
    NoChooser(ChooserPurpose),
}

/// Shortest time in which a person can close a chooser, in seconds.
const MIN_CHOOSER_SECONDS: f64 = 0.4;

impl Default for FileChooser {
    fn default() -> Self {
        Self {
            show: native,
            open: None,
        }
    }
}

impl FileChooser {
    /// Shows a chooser, and forgets the one that is open.
    pub(crate) fn ask_for_file(&mut self, what: ChooserPurpose, language: InterfaceLanguage, now: f64) {
        self.open = Some((what, (self.show)(what, language), now));
    }

    /// Returns whether a chooser is open.
    pub(crate) fn is_chooser_open(&self) -> bool {
        self.open.is_some()
    }

    /// Returns the result of the open chooser if it has ended; arranges for the window to wake at its end.
    pub(crate) fn take_chooser_result(&mut self, wake: &WindowWaker, now: f64) -> Option<ChooserResult> {
        let (what, paths, since) = self.open.as_mut()?;
        let waker = Arc::new(ChooserWaker(wake.clone())).into();
        let Poll::Ready(paths) = paths.as_mut().poll(&mut Context::from_waker(&waker)) else {
            return None;
        };
        let (what, quick) = (*what, now - *since < MIN_CHOOSER_SECONDS);
        self.open = None;
        Some(match what.command_for_paths(paths) {
            Some(command) => ChooserResult::Command(command),
            None if quick => ChooserResult::NoChooser(what),
            None => ChooserResult::Nothing,
        })
    }
}

struct ChooserWaker(WindowWaker);

impl TaskWake for ChooserWaker {
    fn wake(self: Arc<Self>) {
        (self.0)();
    }
}

/// Shows the file chooser of the desktop.
fn native(what: ChooserPurpose, language: InterfaceLanguage) -> ChosenPathsFuture {
    let dialog = AsyncFileDialog::new().set_title(what.chooser_title().text_in_language(language));
    let one = |file: Option<FileHandle>| file.map(|handle| handle.path().to_owned()).into_iter().collect();
    // The dialog is made at once and awaited later: some desktops open it only from the main thread.
    let corpora = [words::CORPORA.text_in_language(language), "chereme"];
    match what {
        ChooserPurpose::Corpus | ChooserPurpose::Merge => {
            let file = dialog.add_filter(corpora[0], &corpora[1..]).pick_file();
            Box::pin(async move { one(file.await) })
        }
        ChooserPurpose::NewCorpus | ChooserPurpose::Copy => {
            let file = dialog
                .add_filter(corpora[0], &corpora[1..])
                .set_file_name("corpus.chereme")
                .save_file();
            Box::pin(async move { one(file.await) })
        }
        ChooserPurpose::CorpusOfFolder | ChooserPurpose::Folder | ChooserPurpose::Questionnaire => {
            let folder = dialog.pick_folder();
            Box::pin(async move { one(folder.await) })
        }
        ChooserPurpose::Media(..) | ChooserPurpose::Trials | ChooserPurpose::Columns | ChooserPurpose::Plan => {
            let file = dialog.pick_file();
            Box::pin(async move { one(file.await) })
        }
        ChooserPurpose::Report => {
            let file = dialog
                .add_filter("HTML", &["html"])
                .set_file_name("report.html")
                .save_file();
            Box::pin(async move { one(file.await) })
        }
        ChooserPurpose::SavePlan | ChooserPurpose::AnswersTable | ChooserPurpose::Disagreements => {
            let name = match what {
                ChooserPurpose::SavePlan => "plan.json",
                ChooserPurpose::AnswersTable => "answers.csv",
                _ => "disagreements.csv",
            };
            let file = dialog.set_file_name(name).save_file();
            Box::pin(async move { one(file.await) })
        }
        ChooserPurpose::Files | ChooserPurpose::Answers => {
            let files = dialog.pick_files();
            Box::pin(async move {
                let files = files.await.unwrap_or_default();
                files.iter().map(|file| file.path().to_owned()).collect()
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::work::begin::CorpusOpening;

    fn ended(show: ShowChooser, what: ChooserPurpose, after: f64) -> ChooserResult {
        let mut chooser = FileChooser { show, open: None };
        chooser.ask_for_file(what, InterfaceLanguage::English, 0.0);
        let wake: WindowWaker = Arc::new(|| {});
        let ended = chooser.take_chooser_result(&wake, after).expect("at once");
        assert!(!chooser.is_chooser_open());
        ended
    }

    #[test]
    fn a_chosen_file_gives_its_command_and_a_missing_dialog_is_reported() {
        let one: ShowChooser = |_, _| Box::pin(async { vec![PathBuf::from("a")] });
        let none: ShowChooser = |_, _| Box::pin(async { Vec::new() });
        let is = |what, expected| match ended(one, what, 1.0) {
            ChooserResult::Command(WindowCommand::Begin(begin)) => assert_eq!(begin, expected),
            other => panic!("{other:?}"),
        };
        is(ChooserPurpose::Corpus, CorpusOpening::Open("a".into()));
        is(ChooserPurpose::NewCorpus, CorpusOpening::New("a".into()));
        is(ChooserPurpose::CorpusOfFolder, CorpusOpening::Folder("a".into()));
        assert!(matches!(
            ended(one, ChooserPurpose::Copy, 1.0),
            ChooserResult::Command(WindowCommand::SaveCopy(path)) if path.as_os_str() == "a"
        ));
        assert!(matches!(
            ended(one, ChooserPurpose::Files, 1.0),
            ChooserResult::Command(WindowCommand::Import(paths)) if paths == [PathBuf::from("a")]
        ));
        assert!(matches!(
            ended(none, ChooserPurpose::Corpus, 3.0),
            ChooserResult::Nothing
        ));
        assert!(matches!(
            ended(none, ChooserPurpose::Corpus, 0.1),
            ChooserResult::NoChooser(ChooserPurpose::Corpus)
        ));
    }
}
