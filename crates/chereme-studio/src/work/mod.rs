//! Work beside the window: each use case of the corpus is a value that a thread carries out.
//!
//! [`Work`] says what to do, [`Outcome`] what came of it. To add a use case, add a variant to both
//! (or to `Work` alone where an outcome fits), its lane in [`Work::lane`], and an arm in
//! [`carry`](carry::carry).

pub(crate) mod begin;
mod carry;
pub(crate) mod desk;

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::{
    Address, AnnotateOptions, AnnotateReport, AnnotationChange, Answer, Around, CheckReport,
    Choice, ChooseOptions, Copied, CueSlips, Curves, Decision, Details, Error, ExportOptions,
    ExportReport, ExportWhat, Expressions, Function, ImportOptions, ImportReport, KeptSearch,
    MadePart, MediaChange, MergeReport, Moving, Name, NewTier, Onsets, OperationRow, Picture,
    PictureOptions, PointsPiece, ProposeOptions, Proposed, Recombination, RecordingChange, Scheme,
    SearchOptions, SignChange, SignMap, SignerChange, Suggestions, TierChange, TierName,
    TrackChange, Unit,
};
use chereme_motion::Span;
use chereme_sign::Component;

use crate::model::made::Made;
use crate::panes::inspector::Thing;
use crate::words::{Text, shell};

/// The number of a piece of work, counted up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct WorkId(pub(crate) u64);

/// A use case of the corpus with all it needs.
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
    /// Makes a sign by a recipe and stores it.
    Recombine {
        /// The recipe.
        recipe: String,
        /// The gloss of the new sign.
        gloss: String,
    },
    /// Makes a sign by a recipe and stores it in the place of one that was made before.
    RecombineAgain {
        /// The recipe.
        recipe: String,
        /// The recording of the former sign.
        recording: i64,
    },
    /// Decides a conflict of a merge.
    Decide(usize, Decision),
    /// Merges another corpus into this one.
    Merge(PathBuf),
    /// Takes files in.
    Import(Vec<PathBuf>, Box<ImportOptions>),
    /// Takes the newest operation back.
    Undo,
    /// Does it again.
    Redo,
    /// Takes several operations back, or does them again.
    Walk {
        /// Whether back.
        back: bool,
        /// How many.
        steps: usize,
    },
    /// Changes a recording.
    ChangeRecording(Name, Box<RecordingChange>),
    /// Changes which media go with a recording.
    ChangeMedia(Name, MediaChange),
    /// Changes a track of a recording, such as where it lies on the clock.
    ChangeTrack(Name, String, TrackChange),
    /// Changes a signer.
    ChangeSigner(Name, Box<SignerChange>),
    /// Changes a sign.
    ChangeSign(Name, Box<SignChange>),
    /// Makes a token the citation form of its sign.
    SetCitation(Address),
    /// Keeps searches under their names.
    KeepSearches(Vec<KeptSearch>),
    /// Gives a kept search another name.
    RenameSearch(String, String),
    /// Keeps a search no longer.
    ForgetSearch(String),
    /// Checks the whole corpus; wrong derived rows are built again on request.
    Check {
        /// Whether it is.
        mend: bool,
    },
    /// Reads a component that is not coded from movement.
    Propose(Component),
    /// Propose values for a sign, a span or a recording.
    ProposeIn(ProposeOptions),
    /// Accept these proposals.
    Accept(Vec<i64>),
    /// Says all that is known of something.
    Look(Thing),
    /// Finds tokens.
    Search(String, SearchOptions),
    /// Says what stands before and after tokens, so many annotations to each side.
    Around(Vec<i64>, usize),
    /// Places the signs on a map by these components.
    Map(Vec<Component>),
    /// Compares the keys of a recording with those that its phones predict by the code of that name.
    CueSlips(i64, String),
    /// Finds the expressions of faces, with their milestones.
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
    /// Measures when non-manuals begin and end, of a function or of all.
    Onsets(Option<Function>),
    /// Writes what the face of a recording seems to do onto tiers of proposals.
    ProposeNonmanuals(Address),
    /// Makes the movement of a recipe and stores nothing.
    Preview(String),
    /// Makes the movement of the recipe that is worked on, of what changed in it.
    Draft {
        /// The recipe.
        recipe: String,
        /// Whether everything is looked up again.
        anew: bool,
    },
    /// Says what could be made from a token.
    Suggest(Address),
    /// Says what a typed path may become.
    Paths(String),
    /// Writes the tokens that a query finds.
    ExportFound(String, PathBuf, ExportOptions),
    /// Writes files.
    Export(ExportWhat, PathBuf, ExportOptions),
    /// Draws what is on the stage to a film, an animation or a picture.
    Share(Shared, PathBuf, PictureOptions),
    /// Loads a piece of movement of a recording.
    Movement {
        /// The recording's row.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// Its span.
        span: Span,
    },
    /// Loads the points of a span of a recording, such as optical markers.
    Points(i64, Span),
    /// Loads a span of a recording's movement by itself; none is no error.
    Stretch(i64, Span),
    /// Loads the originals of what a sign is made of.
    Originals(Vec<MadePart>),
    /// Loads the originals of what a stored sign was made of.
    OriginalsOf(i64),
    /// Measures a piece of movement of a recording.
    Measure {
        /// The recording's row.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// Its span.
        span: Span,
    },
}

/// The outcome of a piece of [`Work`].
#[derive(Debug)]
#[allow(dead_code, reason = "panes read what they need")]
pub(crate) enum Outcome {
    /// Annotations were changed.
    Annotated(AnnotateReport),
    /// Something was changed that the next snapshot shows.
    Changed,
    /// A sign was made and stored.
    Recombined(Box<Recombination>),
    /// Files were taken in, or looked at.
    Imported(ImportReport),
    /// Another corpus was merged in.
    Merged(MergeReport),
    /// An operation was taken back.
    Undone(OperationRow),
    /// An operation was done again.
    Redone(OperationRow),
    /// That many operations were taken back, or done again.
    Walked {
        /// Whether back.
        back: bool,
        /// How many.
        steps: usize,
    },
    /// The corpus was looked through.
    Checked(CheckReport),
    /// A component was read from movement.
    Proposed(Proposed),
    /// All that is known of something.
    Looked(Details),
    /// Tokens were found.
    Found(Answer),
    /// The annotations around tokens.
    Around(Vec<Around>),
    /// The signs have places on a map.
    Mapped(Arc<SignMap>),
    /// The slips of a take.
    CueSlips(Box<CueSlips>),
    /// The expressions of faces.
    Expressions(Arc<Expressions>),
    /// Performances were ranked.
    Chosen(Arc<Choice>),
    /// Begin and end of non-manuals were measured.
    Onsets(Arc<Onsets>),
    /// Movement was made.
    Previewed(Arc<Recombination>),
    /// What could be made.
    Suggested(Suggestions),
    /// The completions of a typed path.
    Paths(String, Vec<String>),
    /// Files were written.
    Exported(ExportReport),
    /// The stage was drawn to a file.
    Shared(Picture),
    /// A piece of movement.
    Moved {
        /// The recording's row.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// The movement.
        moving: Arc<Moving>,
    },
    /// The points of a span of a recording.
    Points(Vec<PointsPiece>),
    /// The movement of a span, where there is some.
    Stretch(Option<Arc<Moving>>),
    /// Pieces of a generated sign, each with its original if it has one.
    Originals(Vec<(MadePart, Option<Arc<Moving>>)>),
    /// A piece of movement was measured.
    Measured {
        /// The recording's row.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// Its curves.
        curves: Box<Curves>,
    },
}

/// The thing that is shared.
#[derive(Debug, Clone)]
pub(crate) enum Shared {
    /// Something stored in the corpus.
    Stored(Address),
    /// Generated movement that is not stored.
    Made(Arc<Made>),
}

/// A thread with a connection of its own; work in one lane is done in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Lane {
    /// Changes of the corpus.
    Edit,
    /// Questions that people wait for.
    Ask,
    /// Movement made of notation, one sign after the other; it never waits for a search.
    Make,
    /// The recipe that is worked on; nothing else is in its way.
    Draft,
    /// Movement to look at.
    Movement,
    /// Movement of little figures, which the stage does not wait for.
    Little,
    /// Movement to measure.
    Measure,
    /// Files written.
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

    /// Returns what it is called while it runs.
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

    /// Returns whether it may be stopped when the window closes: text that a person typed must be stored.
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

/// How far a piece of work is.
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

    /// Returns the share that is done, where the whole is known.
    pub(crate) fn share(&self) -> Option<f32> {
        let total = self.total.filter(|total| *total > 0)?;
        Some((self.done as f64 / total as f64).min(1.0) as f32)
    }
}

/// The end of a piece of work.
pub(crate) type Ended = Result<Outcome, Error>;
