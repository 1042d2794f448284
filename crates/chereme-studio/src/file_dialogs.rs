//! The file choosers of the system, a complement to typed paths, which always work.

use std::future::Future;
use std::path::PathBuf;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake as TaskWake};

use rfd::{AsyncFileDialog, FileHandle};

use crate::command::Command;
use crate::words::{Language, Text, agreement, shell as words, studies};
use crate::work::begin::Begin;
use crate::work::desk::Wake;

/// The purpose of a chooser, which decides how the chosen path is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Choose {
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
type Paths = Pin<Box<dyn Future<Output = Vec<PathBuf>> + Send>>;
/// Shows a chooser.
pub(crate) type Show = fn(Choose, Language) -> Paths;

/// The chooser that is open, if any.
pub(crate) struct Chooser {
    pub(crate) show: Show,
    open: Option<(Choose, Paths, f64)>,
}

/// The result of an open chooser.
#[derive(Debug)]
pub(crate) enum Chosen {
    /// A path was chosen: carry out this command.
    Command(Command),
    /// The user closed the chooser.
    Nothing,
    /// The chooser ended sooner than a person can close it: this system has none, and the path is to be typed.
    NoChooser(Choose),
}

/// Shortest time in which a person can close a chooser, in seconds.
const AT_ONCE: f64 = 0.4;

impl Default for Chooser {
    fn default() -> Self {
        Self {
            show: native,
            open: None,
        }
    }
}

impl Chooser {
    /// Shows a chooser, and forgets the one that is open.
    pub(crate) fn ask(&mut self, what: Choose, language: Language, now: f64) {
        self.open = Some((what, (self.show)(what, language), now));
    }

    /// Returns whether a chooser is open.
    pub(crate) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Returns the result of the open chooser if it has ended; arranges for the window to wake at its end.
    pub(crate) fn ended(&mut self, wake: &Wake, now: f64) -> Option<Chosen> {
        let (what, paths, since) = self.open.as_mut()?;
        let waker = Arc::new(Waking(wake.clone())).into();
        let Poll::Ready(paths) = paths.as_mut().poll(&mut Context::from_waker(&waker)) else {
            return None;
        };
        let (what, quick) = (*what, now - *since < AT_ONCE);
        self.open = None;
        Some(match what.command(paths) {
            Some(command) => Chosen::Command(command),
            None if quick => Chosen::NoChooser(what),
            None => Chosen::Nothing,
        })
    }
}

struct Waking(Wake);

impl TaskWake for Waking {
    fn wake(self: Arc<Self>) {
        (self.0)();
    }
}

impl Choose {
    /// Returns the title of the chooser.
    pub(crate) fn title(self) -> Text {
        match self {
            Self::Corpus => words::START_OPEN,
            Self::NewCorpus => words::START_NEW,
            Self::Copy => words::SAVE_COPY,
            Self::CorpusOfFolder | Self::Folder => words::START_IMPORT,
            Self::Files => words::CHOOSE_FILES,
            Self::Merge => words::CHOOSE_CORPUS,
            Self::Questionnaire => studies::FOLDER,
            Self::Answers => studies::DISK_FILES,
            Self::Report => studies::REPORT_PATH,
            Self::Trials => studies::CHOOSE_TABLE,
            Self::Columns => studies::CHOOSE_MAP,
            Self::Plan => studies::PLAN_OF_FILE,
            Self::SavePlan => studies::PLAN_FILE,
            Self::AnswersTable => studies::ANSWERS_TABLE,
            Self::Disagreements => agreement::TABLE_FILE,
            Self::Media(..) => words::CHOOSE_MEDIA,
        }
    }

    /// Returns the command that uses the chosen paths; `None` without a path.
    pub(crate) fn command(self, mut paths: Vec<PathBuf>) -> Option<Command> {
        let first = match self {
            Self::Files | Self::Folder | Self::Merge if !paths.is_empty() => {
                return Some(Command::Import(paths));
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
                return Some(Command::Studied(self, paths));
            }
            Self::Media(recording, track) => {
                return Some(Command::Media(recording, track, paths.swap_remove(0)));
            }
            Self::Copy => return Some(Command::SaveCopy(paths.swap_remove(0))),
            _ => paths.swap_remove(0),
        };
        Some(Command::Begin(match self {
            Self::NewCorpus => Begin::New(first),
            Self::CorpusOfFolder => Begin::Folder(first),
            _ => Begin::Open(first),
        }))
    }
}

/// Shows the file chooser of the desktop.
fn native(what: Choose, language: Language) -> Paths {
    let dialog = AsyncFileDialog::new().set_title(what.title().of(language));
    let one = |file: Option<FileHandle>| file.map(|it| it.path().to_owned()).into_iter().collect();
    let corpora = [words::CORPORA.of(language), "chereme"];
    match what {
        Choose::Corpus | Choose::Merge => {
            let file = dialog.add_filter(corpora[0], &corpora[1..]).pick_file();
            Box::pin(async move { one(file.await) })
        }
        Choose::NewCorpus | Choose::Copy => {
            let file = dialog
                .add_filter(corpora[0], &corpora[1..])
                .set_file_name("corpus.chereme")
                .save_file();
            Box::pin(async move { one(file.await) })
        }
        Choose::CorpusOfFolder | Choose::Folder | Choose::Questionnaire => {
            let folder = dialog.pick_folder();
            Box::pin(async move { one(folder.await) })
        }
        Choose::Media(..) | Choose::Trials | Choose::Columns | Choose::Plan => {
            let file = dialog.pick_file();
            Box::pin(async move { one(file.await) })
        }
        Choose::Report => {
            let file = dialog
                .add_filter("HTML", &["html"])
                .set_file_name("report.html")
                .save_file();
            Box::pin(async move { one(file.await) })
        }
        Choose::SavePlan | Choose::AnswersTable | Choose::Disagreements => {
            let name = match what {
                Choose::SavePlan => "plan.json",
                Choose::AnswersTable => "answers.csv",
                _ => "disagreements.csv",
            };
            let file = dialog.set_file_name(name).save_file();
            Box::pin(async move { one(file.await) })
        }
        Choose::Files | Choose::Answers => {
            let files = dialog.pick_files();
            Box::pin(async move {
                let files = files.await.unwrap_or_default();
                files.iter().map(|it| it.path().to_owned()).collect()
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ended(show: Show, what: Choose, after: f64) -> Chosen {
        let mut chooser = Chooser { show, open: None };
        chooser.ask(what, Language::English, 0.0);
        let wake: Wake = Arc::new(|| {});
        let ended = chooser.ended(&wake, after).expect("at once");
        assert!(!chooser.is_open());
        ended
    }

    #[test]
    fn a_chosen_file_gives_its_command_and_a_missing_dialog_is_reported() {
        let one: Show = |_, _| Box::pin(async { vec![PathBuf::from("a")] });
        let none: Show = |_, _| Box::pin(async { Vec::new() });
        let is = |what, expected| match ended(one, what, 1.0) {
            Chosen::Command(Command::Begin(begin)) => assert_eq!(begin, expected),
            other => panic!("{other:?}"),
        };
        is(Choose::Corpus, Begin::Open("a".into()));
        is(Choose::NewCorpus, Begin::New("a".into()));
        is(Choose::CorpusOfFolder, Begin::Folder("a".into()));
        assert!(matches!(
            ended(one, Choose::Copy, 1.0),
            Chosen::Command(Command::SaveCopy(path)) if path.as_os_str() == "a"
        ));
        assert!(matches!(
            ended(one, Choose::Files, 1.0),
            Chosen::Command(Command::Import(paths)) if paths == [PathBuf::from("a")]
        ));
        assert!(matches!(ended(none, Choose::Corpus, 3.0), Chosen::Nothing));
        assert!(matches!(
            ended(none, Choose::Corpus, 0.1),
            Chosen::NoChooser(Choose::Corpus)
        ));
    }
}
