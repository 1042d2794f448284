//! The file choosers of the system, a complement to typed paths, which always work.

use std::future::Future;
use std::path::PathBuf;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake as TaskWake};

use rfd::{AsyncFileDialog, FileHandle};

use crate::command::WindowCommand;
use crate::words::{InterfaceLanguage, InterfaceText, agreement, shell as words, studies_words};
use crate::work::begin::CorpusOpening;
use crate::work::desk::WindowWaker;

/// The purpose of a chooser, which decides how the chosen path is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ChooserPurpose {
    /// A corpus to open.
    Corpus,
    /// Where to create a new corpus.
    NewCorpus,
    /// Where to save a copy of the open corpus.
    Copy,
    /// A folder to make a corpus of.
    CorpusOfFolder,
    /// Files to import into the open corpus.
    Files,
    /// A folder to import into the open corpus.
    Folder,
    /// A corpus to merge into the open one.
    Merge,
    /// A folder for the questionnaire of a study.
    Questionnaire,
    /// Files of answers to a study.
    Answers,
    /// Where to write the report of a study.
    Report,
    /// A table of trials for the plan of a study.
    Trials,
    /// A map of the columns of tables with one participant a row.
    Columns,
    /// The file of a plan of a study.
    Plan,
    /// Where to write the plan of a study.
    SavePlan,
    /// Where to write the answers to a study.
    AnswersTable,
    /// Where to write the disagreements of two annotators.
    Disagreements,
    /// A media file for the recording with that row id; it replaces the track with the given row id, if any.
    Media(i64, Option<i64>),
}

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

impl ChooserPurpose {
    /// Returns the title of the chooser.
    pub(crate) fn chooser_title(self) -> InterfaceText {
        match self {
            Self::Corpus => words::START_OPEN,
            Self::NewCorpus => words::START_NEW,
            Self::Copy => words::SAVE_COPY,
            Self::CorpusOfFolder | Self::Folder => words::START_IMPORT,
            Self::Files => words::CHOOSE_FILES,
            Self::Merge => words::CHOOSE_CORPUS,
            Self::Questionnaire => studies_words::FOLDER,
            Self::Answers => studies_words::DISK_FILES,
            Self::Report => studies_words::REPORT_PATH,
            Self::Trials => studies_words::CHOOSE_TABLE,
            Self::Columns => studies_words::CHOOSE_MAP,
            Self::Plan => studies_words::PLAN_OF_FILE,
            Self::SavePlan => studies_words::PLAN_FILE,
            Self::AnswersTable => studies_words::ANSWERS_TABLE,
            Self::Disagreements => agreement::TABLE_FILE,
            Self::Media(..) => words::CHOOSE_MEDIA,
        }
    }

    /// Returns the command that uses the chosen paths; `None` without a path.
    pub(crate) fn command_for_paths(self, mut paths: Vec<PathBuf>) -> Option<WindowCommand> {
        let first = match self {
            Self::Files | Self::Folder | Self::Merge if !paths.is_empty() => {
                return Some(WindowCommand::Import(paths));
            }
            _ if paths.is_empty() => return None,
            Self::Questionnaire
            | Self::Answers
            | Self::Report
            | Self::Trials
            | Self::Columns
            | Self::Plan
            | Self::SavePlan
            | Self::AnswersTable
            | Self::Disagreements => {
                return Some(WindowCommand::Studied(self, paths));
            }
            Self::Media(recording, track) => {
                return Some(WindowCommand::Media(recording, track, paths.swap_remove(0)));
            }
            Self::Copy => return Some(WindowCommand::SaveCopy(paths.swap_remove(0))),
            _ => paths.swap_remove(0),
        };
        Some(WindowCommand::Begin(match self {
            Self::NewCorpus => CorpusOpening::New(first),
            Self::CorpusOfFolder => CorpusOpening::Folder(first),
            _ => CorpusOpening::Open(first),
        }))
    }
}

/// Shows the file chooser of the desktop.
fn native(what: ChooserPurpose, language: InterfaceLanguage) -> ChosenPathsFuture {
    let dialog = AsyncFileDialog::new().set_title(what.chooser_title().text_in_language(language));
    let one = |file: Option<FileHandle>| file.map(|handle| handle.path().to_owned()).into_iter().collect();
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
