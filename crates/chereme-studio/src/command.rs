//! Every possible request, as one value: menus, keys, palette and panes send the same commands; the requests of a frame.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::recipe::{PlacementGoal, RecipeLength};
use chereme_motion::{RecordingInstant, TimeSpan};

use crate::action::Action;
use crate::model::InspectedThing;
use crate::model::generated::GeneratedClip;
use crate::model::model_handle::{PlacementHandle, TravelCourse};
use crate::settings::stage_settings::StageSettings;
use crate::settings::{SearchHistory, StudioSettings};
use crate::words::{InterfaceText, agreement, shell as words, studies_words};
use crate::work::begin::CorpusOpening;
use crate::work::{CorpusJob, WorkId};

/// A request to the window.
#[derive(Debug)]
pub(crate) enum WindowCommand {
    /// Carry out an action of keys, menus or the palette.
    Do(Action),
    /// Run a use case of the corpus.
    Work(WorkId, CorpusJob),
    /// Stop a piece of work.
    Stop(WorkId),
    /// Open a corpus.
    Begin(CorpusOpening),
    /// Let the user choose files or a folder, and use them.
    Choose(ChooserPurpose),
    /// Stop opening.
    StopBeginning,
    /// Show a recording, from its start.
    Recording(i64),
    /// Show a span of a recording, selected, with the playhead at its start.
    Place(i64, TimeSpan),
    /// Bring the stage into sight after something was opened, so that it can be seen.
    Look,
    /// Select a tier.
    Tier(Option<i64>),
    /// Select annotations.
    Annotations(BTreeSet<i64>),
    /// Select a span of time.
    Span(Option<TimeSpan>),
    /// Move the playhead.
    Seek(RecordingInstant),
    /// Move the playhead of the stage, even if it shows generated movement.
    Cue(RecordingInstant),
    /// Note the placement value that was clicked on the body: [`DisplayState::spot`](crate::model::display_state::DisplayState::spot).
    Spot(Option<String>),
    /// Play at that multiple of the recorded speed.
    Speed(f64),
    /// Show movement outside of recordings on the stage, in a loop, or `None` to end that. Commands that show or move
    /// something in a recording end it too.
    Made(Option<Arc<GeneratedClip>>),
    /// Set the placement that can be dragged on the stage, or `None` to remove it:
    /// [`DisplayState::handle`](crate::model::display_state::DisplayState::handle).
    Handle(Option<PlacementHandle>),
    /// Set the path that can be pulled on the stage, or `None` to remove it:
    /// [`DisplayState::course`](crate::model::display_state::DisplayState::course).
    Course(Option<Box<TravelCourse>>),
    /// Change the path of a card, which was pulled or drawn: the card's number, and the points of the path as lengths
    /// to the left, up and forward.
    Travelled(u64, Vec<[RecipeLength; 3]>),
    /// Change the placement of a card, which was dragged: the card's number and the new goal.
    Placed(u64, PlacementGoal),
    /// Add a media file to the recording with that row id, or replace its track with the given row id.
    Media(i64, Option<i64>, PathBuf),
    /// Give the pane of studies the paths that a chooser for it returned.
    Studied(ChooserPurpose, Vec<PathBuf>),
    /// Open the import pane with these files and folders.
    Import(Vec<PathBuf>),
    /// Show everything known about something in the inspector.
    Inspect(InspectedThing),
    /// Show something in the inspector, and bring the inspector into sight unless that hides the stage.
    Note(InspectedThing),
    /// Run a search with this query.
    Find(String),
    /// Open a recipe; the name is that of the stored recording that was made from it, if any.
    Recipe(String, Option<String>),
    /// Begin to make a sign from a recipe, which may be empty.
    Make { recipe: String, gloss: String },
    /// Add a sign to the recipe.
    Use(DraggedToken),
    /// Replace the saved and recent searches.
    Searches(SearchHistory),
    /// Replace the stage's settings.
    Stage(Box<StageSettings>),
    /// Replace the settings.
    Settings(Box<StudioSettings>),
    /// Report why something cannot be done; the notice disappears by itself.
    Cannot(InterfaceText),
    /// Show a notice that disappears by itself.
    Say(String),
    /// Save a copy of the corpus there and continue in it.
    SaveCopy(PathBuf),
    /// Put a text on the clipboard.
    Copy(String),
    /// Show a notice that stays, with a remedy.
    Notify(String, InterfaceText),
    /// Dismiss a notice.
    Dismiss(u64),
}

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

/// A token that is dragged from one pane to another: the payload of egui's drag and drop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct DraggedToken {
    pub(crate) token: i64,
    pub(crate) gloss: String,
}

/// The requests of a frame; carried out after it, in order.
#[derive(Debug, Default)]
pub(crate) struct CommandOutbox {
    commands: RefCell<Vec<WindowCommand>>,
    next: Cell<u64>,
}

impl CommandOutbox {
    /// Returns an empty outbox that continues the work numbers of `other`.
    pub(crate) fn after_outbox(other: &Self) -> Self {
        Self {
            next: other.next.clone(),
            ..Self::default()
        }
    }

    pub(crate) fn send_command(&self, command: WindowCommand) {
        self.commands.borrow_mut().push(command);
    }

    /// Requests a job, and returns the id that its outcome carries.
    pub(crate) fn request_work(&self, job: CorpusJob) -> WorkId {
        self.next.set(self.next.get() + 1);
        let id = WorkId(self.next.get());
        self.send_command(WindowCommand::Work(id, job));
        id
    }

    /// Moves the playhead.
    pub(crate) fn send_seek(&self, at: RecordingInstant) {
        self.send_command(WindowCommand::Seek(at));
    }

    pub(crate) fn take_commands(&self) -> Vec<WindowCommand> {
        self.commands.take()
    }
}
