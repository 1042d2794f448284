//! Every possible request, as one value: menus, keys, palette and panes send the same commands.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::recipe::{PlacementGoal, RecipeLength};
use chereme_motion::{RecordingInstant, TimeSpan};

use crate::action::Action;
use crate::file_dialogs::ChooserPurpose;
use crate::model::generated::GeneratedClip;
use crate::model::model_handle::{PlacementHandle, TravelCourse};
use crate::panes::DraggedToken;
use crate::panes::inspector::InspectedThing;
use crate::panes::stage::StageSettings;
use crate::settings::{SearchHistory, StudioSettings};
use crate::words::InterfaceText;
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
    /// Note the placement value that was clicked on the body: [`DisplayState::spot`](crate::context::DisplayState::spot).
    Spot(Option<String>),
    /// Play at that multiple of the recorded speed.
    Speed(f64),
    /// Show movement outside of recordings on the stage, in a loop, or `None` to end that. Commands that show or move
    /// something in a recording end it too.
    Made(Option<Arc<GeneratedClip>>),
    /// Set the placement that can be dragged on the stage, or `None` to remove it:
    /// [`DisplayState::handle`](crate::context::DisplayState::handle).
    Handle(Option<PlacementHandle>),
    /// Set the path that can be pulled on the stage, or `None` to remove it:
    /// [`DisplayState::course`](crate::context::DisplayState::course).
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
