//! The input of a pane while it draws.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use chereme_motion::RecordingInstant;

use crate::command::{CommandOutbox, WindowCommand};
use crate::film::RecordingFilms;
use crate::keys::ActionKeys;
use crate::miniatures::MiniatureFigures;
use crate::model::CorpusSnapshot;
use crate::model::display_state::DisplayState;
use crate::model::reel::MovementReel;
use crate::settings::StudioSettings;
use crate::theme::ThemeColours;
use crate::words::{InterfaceLanguage, InterfaceText};
use crate::work::desk::RunningWork;
use crate::work::{CorpusJob, WorkId, WorkProgress};

/// The read-only input of a pane while it draws, and the outbox for what it requests.
#[derive(Clone, Copy)]
pub(crate) struct PaneInput<'a> {
    /// The file of the corpus.
    pub(crate) path: &'a Path,
    pub(crate) snapshot: &'a CorpusSnapshot,
    pub(crate) shown: &'a DisplayState,
    pub(crate) reel: &'a MovementReel,
    /// Looping little figures of any movement.
    pub(crate) little: &'a MiniatureFigures,
    /// Films of the recording.
    pub(crate) films: &'a RecordingFilms,
    pub(crate) keys: &'a ActionKeys,
    pub(crate) settings: &'a StudioSettings,
    pub(crate) language: InterfaceLanguage,
    pub(crate) dark: bool,
    /// Work that has been started and has not ended.
    pub(crate) running: &'a BTreeMap<WorkId, RunningWork>,
    /// The requests of this frame.
    pub(crate) out: &'a CommandOutbox,
}

impl PaneInput<'_> {
    pub(crate) fn send_command(&self, command: WindowCommand) {
        self.out.send_command(command);
    }

    /// Requests a job, and returns the id that its outcome carries.
    pub(crate) fn request_work(&self, job: CorpusJob) -> WorkId {
        self.out.request_work(job)
    }

    /// Moves the playhead.
    pub(crate) fn send_seek(&self, at: RecordingInstant) {
        self.out.send_seek(at);
    }

    /// Returns a text in the window's language.
    pub(crate) fn say_text(&self, text: InterfaceText) -> &'static str {
        text.text_in_language(self.language)
    }

    pub(crate) fn pane_colours(&self) -> &'static ThemeColours {
        ThemeColours::colours_for_theme(self.dark)
    }

    /// Returns the path of a file of that name beside the corpus.
    pub(crate) fn path_beside_corpus(&self, name: &str) -> PathBuf {
        self.path.with_file_name(name)
    }

    /// Returns the progress of a running piece of work.
    pub(crate) fn work_progress(&self, work: WorkId) -> Option<&WorkProgress> {
        self.running.get(&work).map(|task| &task.far)
    }

    pub(crate) fn is_running(&self, work: Option<WorkId>) -> bool {
        work.is_some_and(|id| self.running.contains_key(&id))
    }
}
