//! Work on other threads: each use case of the corpus is a value that a thread carries out.
//!
//! [`Work`] is the request, [`Outcome`] the result. To add a use case, add a variant to both (or to `Work` alone if an
//! existing outcome fits), its lane in [`Work::lane`], and an arm in [`carry`](carry::carry).

pub(crate) mod begin;
mod carry;
pub(crate) mod desk;
mod outcome;

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{
    Address, AnnotateOptions, AnnotationChange, ChooseOptions, Copied, Decision, DeleteOptions,
    Error, ExportOptions, ExportWhat, Function, ImportOptions, KeptSearch, MadePart, MediaChange,
    Name, NewTier, PictureOptions, ProposeOptions, RecordingChange, Scheme, SearchOptions,
    SignChange, SignerChange, TierChange, TierName, TrackChange, Unit,
};
use chereme_motion::Span;
use chereme_sign::Component;

pub(crate) use outcome::Outcome;

use crate::model::generated::GeneratedClip;
use crate::panes::inspector::Thing;
use crate::words::{Text, shell};

/// Serial number of a piece of work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct WorkId(pub(crate) u64);

/// A use case of the corpus with its arguments.
#[derive(Debug, Clone)]
#[allow(dead_code, reason = "every use case, asked for or not")]
pub(crate) enum Work {
    /// Changes annotations.
    Annotate(Vec<AnnotationChange>, AnnotateOptions),
    /// Adds a tier.
    AddTier(Box<NewTier>),
    /// Gives a recording the tiers of a scheme.
    AddTiers(Name, Scheme),
    /// Changes a tier.
    ChangeTier(TierName, Box<TierChange>),
    /// Copies a tier under another name.
    CopyTier(TierName, String, Copied),
    /// Puts the tiers of a recording in an order.
    OrderTiers(Name, Vec<i64>),
    /// Removes a tier.
    RemoveTier(TierName),
    /// Generates a sign from a recipe and stores it.
    Recombine {
        /// The recipe.
        recipe: String,
        /// The gloss of the new sign.
        gloss: String,
    },
    /// Generates a sign from a recipe and stores it in place of an earlier one.
    RecombineAgain {
        /// The recipe.
        recipe: String,
        /// The recording of the earlier sign.
        recording: i64,
    },
    /// Decides a conflict of a merge.
    Decide(usize, Decision),
    /// Merges another corpus into this one.
    Merge(PathBuf),
    /// Imports files, or only reports what an import would do.
    Import(Vec<PathBuf>, Box<ImportOptions>),
    /// Undoes the newest operation.
    Undo,
    /// Redoes the last undone operation.
    Redo,
    /// Undoes or redoes several operations.
    Walk {
        /// Whether to undo.
        back: bool,
        /// The number of operations.
        steps: usize,
    },
    /// Changes a recording.
    ChangeRecording(Name, Box<RecordingChange>),
    /// Changes the media files of a recording.
    ChangeMedia(Name, MediaChange),
    /// Changes a track of a recording, for example its place on the clock.
    ChangeTrack(Name, String, TrackChange),
    /// Changes a signer.
    ChangeSigner(Name, Box<SignerChange>),
    /// Changes a sign.
    ChangeSign(Name, Box<SignChange>),
    /// Makes a token the citation form of its sign.
    SetCitation(Address),
    /// Saves searches under their names.
    KeepSearches(Vec<KeptSearch>),
    /// Renames a saved search.
    RenameSearch(String, String),
    /// Deletes a saved search.
    ForgetSearch(String),
    /// Deletes recordings and signs, or reports what would be deleted.
    Delete(Vec<Address>, DeleteOptions),
    /// Checks the whole corpus; rebuilds wrong derived rows on request.
    Check {
        /// Whether to rebuild them.
        mend: bool,
    },
    /// Infers a component that is not coded from movement, and stores proposals.
    Propose(Component),
    /// Proposes values for a sign, a span or a recording.
    ProposeIn(ProposeOptions),
    /// Accepts these proposals.
    Accept(Vec<i64>),
    /// Returns all details of something.
    Look(Thing),
    /// Finds tokens.
    Search(String, SearchOptions),
    /// Returns the annotations before and after tokens, up to that number on each side.
    Around(Vec<i64>, usize),
    /// Places the signs on a map by the similarity of these components.
    Map(Vec<Component>),
    /// Compares the keys of a recording with those that its phones predict in the named code.
    CueSlips(i64, String),
    /// Finds the expressions of faces with their milestones.
    Expressions,
    /// Writes the milestones of every expression of a function onto tiers.
    Milestones(Function),
    /// Ranks the performances of a function for a sentence.
    ChooseFace {
        /// The function.
        function: Function,
        /// The sentence.
        target: Address,
        /// How they are compared.
        options: Box<ChooseOptions>,
    },
    /// Measures when non-manuals begin and end, for one function or for all.
    Onsets(Option<Function>),
    /// Writes the inferred facial movements of a recording onto tiers of proposals.
    ProposeNonmanuals(Address),
    /// Generates the movement of a recipe and stores nothing.
    Preview(String),
    /// Generates the movement of the open recipe, using stored results for unchanged parts.
    Draft {
        /// The recipe.
        recipe: String,
        /// Whether to look everything up again.
        again: bool,
    },
    /// Suggests recipes for a token.
    Suggest(Address),
    /// Completes a typed path.
    Paths(String),
    /// Writes the tokens that a query finds to files.
    ExportFound(String, PathBuf, ExportOptions),
    /// Writes something stored in the corpus to files.
    Export(ExportWhat, PathBuf, ExportOptions),
    /// Draws the contents of the stage to a film, an animation or a picture.
    Share(Shared, PathBuf, PictureOptions),
    /// Loads a piece of movement of a recording.
    Movement {
        /// The recording's row id.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// Its span.
        span: Span,
    },
    /// Loads the points of a span of a recording, such as optical markers.
    Points(i64, Span),
    /// Loads the movement of a span of a recording, or a picture of its film if nothing moves; if both are missing, that
    /// is not an error.
    Stretch(i64, Span),
    /// Loads the original movement of the pieces of a generated sign.
    Originals(Vec<MadePart>),
    /// Loads the original movement of the pieces of a stored generated sign.
    OriginalsOf(i64),
    /// Measures a piece of movement of a recording, for the curves.
    Measure {
        /// The recording's row id.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// Its span.
        span: Span,
    },
}

/// Movement that the user shares as a file: stored in the corpus, or only generated.
#[derive(Debug, Clone)]
pub(crate) enum Shared {
    /// Something stored in the corpus.
    Stored(Address),
    /// Generated movement that is not stored.
    Made(Arc<GeneratedClip>),
}

/// A thread with its own connection to the corpus; the work of one lane is done in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Lane {
    /// Changes of the corpus.
    Edit,
    /// Queries that the user waits for.
    Ask,
    /// Movement generated from notation, one sign after the other; it never waits for a search.
    Make,
    /// The open recipe; no other work shares this lane.
    Draft,
    /// Movement for the stage.
    Movement,
    /// Movement of little figures; the stage does not wait for it.
    Little,
    /// Movement for measurement.
    Measure,
    /// Writing of files.
    Export,
}

impl Lane {
    pub(crate) const ALL: [Self; 8] = [
        Self::Edit,
        Self::Ask,
        Self::Make,
        Self::Draft,
        Self::Movement,
        Self::Little,
        Self::Measure,
        Self::Export,
    ];
}

impl Work {
    pub(crate) fn lane(&self) -> Lane {
        match self {
            Self::Annotate(..)
            | Self::AddTier(_)
            | Self::AddTiers(..)
            | Self::ChangeTier(..)
            | Self::RemoveTier(_)
            | Self::CopyTier(..)
            | Self::OrderTiers(..)
            | Self::Recombine { .. }
            | Self::RecombineAgain { .. }
            | Self::Decide(..)
            | Self::Merge(_)
            | Self::Import(..)
            | Self::Walk { .. }
            | Self::ChangeRecording(..)
            | Self::ChangeMedia(..)
            | Self::ChangeTrack(..)
            | Self::ChangeSigner(..)
            | Self::ChangeSign(..)
            | Self::SetCitation(_)
            | Self::KeepSearches(_)
            | Self::RenameSearch(..)
            | Self::ForgetSearch(_)
            | Self::Delete(..)
            | Self::Check { .. }
            | Self::Propose(_)
            | Self::ProposeIn(_)
            | Self::Accept(_)
            | Self::Milestones(_)
            | Self::ProposeNonmanuals(_)
            | Self::Undo
            | Self::Redo => Lane::Edit,
            Self::Search(..)
            | Self::Around(..)
            | Self::Map(_)
            | Self::CueSlips(..)
            | Self::Expressions
            | Self::ChooseFace { .. }
            | Self::Onsets(_)
            | Self::Suggest(_)
            | Self::Look(_)
            | Self::Paths(_) => Lane::Ask,
            Self::Preview(_) => Lane::Make,
            Self::Draft { .. } => Lane::Draft,
            Self::Movement { .. } => Lane::Movement,
            Self::Points(..) | Self::Stretch(..) | Self::Originals(_) | Self::OriginalsOf(_) => {
                Lane::Little
            }
            Self::Measure { .. } => Lane::Measure,
            Self::Export(..) | Self::ExportFound(..) | Self::Share(..) => Lane::Export,
        }
    }

    /// Returns the title of the work while it runs.
    pub(crate) fn task(&self) -> Text {
        match self {
            Self::Import(_, options) if options.dry_run => shell::TASK_LOOKING,
            Self::Import(..) => shell::TASK_IMPORT,
            Self::Merge(_) => shell::TASK_MERGE,
            Self::Check { .. } => shell::TASK_CHECK,
            Self::Propose(_) | Self::ProposeIn(_) | Self::ProposeNonmanuals(_) => {
                shell::TASK_PROPOSE
            }
            Self::Search(..)
            | Self::Around(..)
            | Self::Map(_)
            | Self::CueSlips(..)
            | Self::Expressions
            | Self::ChooseFace { .. }
            | Self::Onsets(_)
            | Self::Suggest(_)
            | Self::Look(_)
            | Self::Paths(_) => shell::TASK_SEARCH,
            Self::Recombine { .. }
            | Self::RecombineAgain { .. }
            | Self::Preview(_)
            | Self::Draft { .. } => shell::TASK_RECOMBINE,
            Self::Export(..) | Self::ExportFound(..) | Self::Share(..) => shell::TASK_EXPORT,
            Self::Movement { .. }
            | Self::Points(..)
            | Self::Stretch(..)
            | Self::Originals(_)
            | Self::OriginalsOf(_)
            | Self::Measure { .. } => shell::TASK_MOVEMENT,
            _ => shell::TASK_EDIT,
        }
    }

    /// Returns whether the pane that requested it shows errors itself.
    pub(crate) fn is_quiet(&self) -> bool {
        matches!(
            self,
            Self::Preview(_)
                | Self::Draft { .. }
                | Self::Suggest(_)
                | Self::Look(_)
                | Self::Paths(_)
                | Self::Import(..)
                | Self::Merge(_)
                | Self::Export(..)
                | Self::ExportFound(..)
                | Self::Search(..)
                | Self::Around(..)
                | Self::Map(_)
                | Self::CueSlips(..)
                | Self::Expressions
                | Self::ChooseFace { .. }
                | Self::Onsets(_)
        )
    }

    /// Returns whether the work may be stopped when the window closes; edits must be stored.
    pub(crate) fn may_stop(&self) -> bool {
        self.lane() != Lane::Edit
            || matches!(
                self,
                Self::Import(..)
                    | Self::Merge(_)
                    | Self::Check { .. }
                    | Self::Propose(_)
                    | Self::ProposeIn(_)
            )
    }
}

/// The progress of a piece of work.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Far {
    /// The current task, such as a file's name.
    pub(crate) task: String,
    pub(crate) done: u64,
    pub(crate) total: Option<u64>,
}

impl Far {
    fn of(step: &chereme_corpus::Step<'_>) -> Self {
        let scale = if step.unit == Unit::Bytes { 1024 } else { 1 };
        Self {
            task: step.task.to_owned(),
            done: step.done / scale,
            total: step.total.map(|total| total / scale),
        }
    }

    /// Returns the share that is done, if the total is known.
    pub(crate) fn share(&self) -> Option<f32> {
        let total = self.total.filter(|total| *total > 0)?;
        Some((self.done as f64 / total as f64).min(1.0) as f32)
    }
}

/// The result of a piece of work.
pub(crate) type Ended = Result<Outcome, Error>;
