//! Everything that can be asked for, as one value: menus, keys, palette and panes send the same.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::recipe::{Goal, Length};
use chereme_motion::{Instant, Span};

use crate::action::Action;
use crate::choose::Choose;
use crate::model::handle::{Course, Handle};
use crate::model::made::Made;
use crate::panes::Carried;
use crate::panes::inspector::Thing;
use crate::panes::stage::StageWays;
use crate::settings::{Searches, Settings};
use crate::words::Text;
use crate::work::begin::Begin;
use crate::work::{Work, WorkId};

/// Something asked for.
#[derive(Debug, Clone)]
pub(crate) enum Command {
    /// What keys, menus and the palette can ask for.
    Do(Action),
    /// A use case of the corpus.
    Work(WorkId, Work),
    /// Stop a piece of work.
    Stop(WorkId),
    /// Open a corpus.
    Begin(Begin),
    /// Have files or a folder chosen, and go on with them.
    Choose(Choose),
    /// Stop opening.
    StopBeginning,
    /// Show a recording, from its start.
    Recording(i64),
    /// Show a span of a recording, selected, with the playhead at its start.
    Place(i64, Span),
    /// Bring the stage into sight, so that people see the opened thing.
    Look,
    /// Select a tier.
    Tier(Option<i64>),
    /// Select annotations.
    Annotations(BTreeSet<i64>),
    /// Select a span of time.
    Span(Option<Span>),
    /// Move the playhead.
    Seek(Instant),
    /// Move the playhead of what is on the stage, made movement too.
    Cue(Instant),
    /// A placement value was clicked on the body: [`Shown::spot`](crate::context::Shown::spot).
    Spot(Option<String>),
    /// Play that many times as fast.
    Speed(f64),
    /// Show movement that lies in no recording on the stage, in a loop; nothing goes back to the
    /// recording, as does whatever shows or moves in one.
    Made(Option<Arc<Made>>),
    /// A placement that can be dragged on the stage, or `None` to remove it:
    /// [`Shown::handle`](crate::context::Shown::handle).
    Handle(Option<Handle>),
    /// A path that can be pulled on the stage, or `None` to remove it:
    /// [`Shown::course`](crate::context::Shown::course).
    Course(Option<Box<Course>>),
    /// The path of that card was pulled or drawn: its points to the left, up and forward.
    Travelled(u64, Vec<[Length; 3]>),
    /// The placement of that card was dragged there.
    Placed(u64, Goal),
    /// A media file goes with the recording of that row, in place of the track of that row where one is said.
    Media(i64, Option<i64>, PathBuf),
    /// Have these files and folders taken in: opens the import with them.
    Import(Vec<PathBuf>),
    /// Show all that is known of something in the inspector.
    Inspect(Thing),
    /// Show something in the inspector, and bring the inspector into sight unless that hides the stage.
    Note(Thing),
    /// Find what this query asks for.
    Find(String),
    /// Turn to a recipe, that of the stored recording of that name where there is one.
    Recipe(String, Option<String>),
    /// Begin to make a sign by a recipe, which may be empty.
    Make { recipe: String, gloss: String },
    /// Take a sign into the recipe.
    Use(Carried),
    /// Change which queries are kept and remembered.
    Searches(Searches),
    /// Change what is remembered of the stage.
    Stage(Box<StageWays>),
    /// Change what is remembered.
    Settings(Box<Settings>),
    /// Say why something cannot be done, which goes away by itself.
    Cannot(Text),
    /// Say something that goes away by itself.
    Say(String),
    /// Save a copy of the corpus there and go on in it.
    SaveCopy(PathBuf),
    /// Put a text on the clipboard.
    Copy(String),
    /// Say something that stays, with what helps.
    Tell(String, Text),
    /// Put a notice away.
    Dismiss(u64),
}
