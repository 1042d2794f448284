//! A corpus opened for work: SQLite, search index, history, and all use cases.
//!
//! User interfaces work on a corpus through [`Corpus`]; free functions do what needs no corpus, such as merging two
//! annotation files. Each change is one named operation in one transaction,
//! with its changeset. Nothing here prints, prompts, or reads the environment.

mod address;
mod agree;
mod animate;
mod annotate;
mod author;
mod check;
pub(crate) mod codec;
mod compare;
mod consent;
mod contents;
mod context;
mod cue;
mod cued;
mod curves;
pub(crate) mod db;
mod delete;
mod details;
mod detect;
mod edit;
mod error;
mod export;
mod face;
mod film;
mod foreign_code;
mod forms;
mod hands;
mod import;
mod info;
mod inventories;
mod kinematics;
mod list;
mod log;
mod map;
mod media;
mod merge;
mod movement;
mod notation;
mod page;
mod pairs;
mod paths;
mod picture;
mod progress;
mod propose;
mod publish;
pub mod recipe;
mod recombine;
mod saved_search;
mod score;
pub(crate) mod search;
mod sources;
mod starter;
mod stats;
pub mod study;
mod suggest;
mod tokens;
mod track;
mod transcribe;
mod usable;
mod values;
pub mod words;

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

/// A corpus file with its search index.
type Store = db::Store<search::index::SearchIndex>;

pub use chereme_formats::faces::{Loss, System as FaceSystem};
pub use chereme_formats::roles::{Hands, Mapping, MappingError, TierGuess};
pub use chereme_formats::table::annotations::{Moment, TimeUnit};
pub use chereme_motion::Instant;
pub use chereme_sign::milestones::{Function, Milestones, Phase as ExpressionPhase};
pub use chereme_sign::query::HELP as QUERY_HELP;
pub use chereme_sign::remedy;
pub use chereme_sign::tier::spans::Mode;
pub use chereme_sign::{Stereotype, TierRole, TierTopic};

pub use address::{Address, Name, Stretch};
pub use agree::{
    Adjudicated, AgreeOptions, Agreement, Confusion, Disagreement, DisagreementCounts,
    DisagreementKind, DisagreementSide, FEWEST_UNITS, Figure, FigureInterval, MEASURES,
    PairAgreement, USUAL_MEASURES, UnitCounts, ValueAgreement, alike_tiers,
};
pub use animate::Staging;
pub use annotate::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName, Copied,
    Find, NewTier, RemovedTiers, Replaced, ReplacedValue, Scheme, TierChange, TierName, Values,
    Within,
};
pub use annotate::{clipboard, drag_limits, paste, requests, snap, tier_values};
pub use author::author;
pub use check::{CheckReport, Fault};
pub use chereme_analysis::detect::{DETECTORS, Detector, Nonmanuals};
pub use chereme_analysis::kinematics::{HandCurves, Kinematics};
pub use chereme_analysis::phases::{NoPath, PhaseScore};
pub use chereme_analysis::{Score, ScoreOptions};
pub use chereme_compose::Curve;
pub use chereme_figure::SPEEDS;
pub use chereme_formats::compare::{
    ComparedAnnotation, Conflict as FileConflict, Difference, Moved, Revalued,
    TierChange as TierDifference,
};
pub use chereme_sign::query::{facet_condition, narrow, wants, without};
pub use compare::{CompareSide, FileMerge, merge_files};
pub use consent::{Audience, Consent, ConsentChange, ConsentKind, ConsentRow, Withheld};
pub use contents::{
    AnnotationColumns, Contents, Overview, RecordingGlance, ShownFrames, SignGlance, TierContents,
};
pub use context::Around;
pub use cue::{
    CueKey, CueKeys, CueOptions, KeysOptions, SpokenWord, cue_keys, cue_keys_of_file,
    cue_phones_of_espeak, cue_phones_of_file, cue_recipe,
};
pub use cued::{
    CueConfusion, CueCosts, CuePhaseRow, CuePhaseStatistics, CueRecognition, CueSlip, CueSlips,
    CueTargets, CuedMarkers, CuedOptions, DictionaryReport, Dikeys, FoundKey, FromDictionary,
    MarkerSet, Misread, MissingDikey, RestoreOptions, RestoredMarker, RestoredTake, ScriptCoverage,
    SentencePiece, SlipKind, WorthRecording, read_marker_labels,
};
pub use db::columns::{AnnotationOrigin, Origin, ValueState};
pub use db::delete::Belongings;
pub use db::file_identity::FileIdentity;
pub use db::recordings::{MediaTrackRow, RecordingRow, SignerRow};
pub use db::signs::TokenRow;
pub use db::tiers::{TierRow, TierShown};
pub use db::{OperationKind, OperationRow, Upgrade, on_waiting};
pub use delete::{DeleteOptions, Deleted, DeletedRecording, Dependent, Dependents};
pub use details::{
    Details, RecordingDetails, SignDetails, SignerDetails, TokenDetails, TokenValue,
};
pub use detect::{DetectOptions, Detected, DetectedIn, Proposal};
pub use edit::{RecordingChange, SignChange, SignerChange};
pub use error::{Cause, Error, FailedStep, Meant, Result, WrongQuery};
pub use export::{ExportOptions, ExportReport, ExportWhat, ExportedFile};
pub use face::{
    CHANNELS as FACE_CHANNELS, Choice, ChooseOptions, Expressions, FaceChannel, FaceFinding,
    FaceFit, FaceNumber, FaceProposals, FaceReport, FaceScore, FittedNumber, FoundExpression,
    MilestoneOptions, OnsetRow, Onsets, Quartiles, Rank, Ranked, ScoredChannel,
};
pub use film::{Film, FilmFacts, FilmPicture, FilmTimes, Planes};
pub use foreign_code::hide_handled_panics;
pub use forms::{Empty, FIELD_SETS, FormSource};
pub use import::{
    BodyRead, Changes, ConventionRead, FileReport, FileStatus, ImportOptions, ImportReport,
    JointRole, MovementRead, Outcome, OwnEdit, OwnEdits, ReportFinding, RootRead, Saying, Shared,
    TiersRead, TrackRead, Understood, Unread, read_stream, readable_files, time_of_day,
};
pub use info::{Amount, AttributeInfo, Info, InventoryInfo, SignerInfo};
pub use inventories::StoredInventory;
pub use kinematics::Curves;
pub use list::{ListFilter, ListKind, Listing, cell_text, components_text};
pub use log::{ChangeKind, Changed, FieldChange, OperationDetail};
pub use map::{MapOptions, MapPoint, SignMap};
pub use media::{MediaChange, MediaPlace, find_media, is_film};
pub use merge::{Candidate, CorpusConflict, Decision, MergeReport};
pub use movement::ChannelGroup;
pub use notation::{Notation, read_notation};
pub use pairs::{Dense, Pair, PairOptions, Pairs};
pub use paths::paths_like;
pub use picture::values as value_pictures;
pub use picture::{Moving, Performance, Picture, PictureOptions, built_in_body, draw_clip};
pub use progress::{Progress, Step, Unit, unheard};
pub use propose::{ProposeOptions, ProposeScope, Proposed, accepting_tier, proposed_for};
pub use publish::{LeftOut, PublishOptions, Published};
pub use recombine::{MadePart, NotationFinding, Recombination, TimedNote};
pub use saved_search::{KeptSearch, kept_like};
pub use score::Scored;
pub use search::{
    Answer, FACET_VALUES, Finding, FindingKind, Hit, NO_VALUE, Order, SearchOptions, Tally,
    TallyRow, guessed, meant,
};
pub use starter::{StarterSign, starter_files, starter_signs, unpack_starter};
pub use stats::{
    Battison, Chance, CrossCell, Ends, Estimate, FieldAssociation, FieldContrast, FieldInDepth,
    FieldStatistics, FieldValue, HandCondition, LexiconStatistics, StatsFinding, StatsOptions,
    TwoHands,
};
pub use suggest::{Partner, Suggestions};
pub use track::{
    Alignment, FitOptions, FitReport, FitResidual, MediaFile, NewTrack, PointsPiece, Signal,
    SkeletonTrack, Track, TrackChange, TrackKind, TrackRow,
};
pub use transcribe::{Transcribed, TranscribedFeature, TranscribedStage, TranscribedValue};
pub use values::MergedValues;

/// An open corpus.
pub struct Corpus {
    store: Store,
    /// Cache of what was learned from the corpus: the profile of strokes and samples of body language.
    learned: RefCell<sources::Learned>,
    /// Cache of the inventories, with the generation for which they are valid.
    inventories: RefCell<Option<(i64, Arc<Vec<StoredInventory>>)>>,
    /// Cache of the corrections of finger angles by recording.
    hands: RefCell<hands::Kept>,
    /// The recipe being drafted.
    drafted: recombine::Drafted,
    /// Cache of facial expressions as numbers; after a change only the changed recordings are read again.
    faces: RefCell<face::Pool>,
}

impl Corpus {
    /// Creates an empty corpus at `path`; `author` is recorded with every change.
    ///
    /// # Errors
    /// [`Error::File`] if something exists there already or the folder is missing.
    pub fn create(path: &Path, author: &str) -> Result<Self> {
        let store = Store::create(path, author, inventories::store_builtin)?;
        Ok(Self::of_store(store))
    }

    fn of_store(store: Store) -> Self {
        Self {
            store,
            learned: RefCell::default(),
            inventories: RefCell::default(),
            hands: RefCell::default(),
            drafted: recombine::Drafted::default(),
            faces: RefCell::default(),
        }
    }

    /// Writes the whole corpus to a new file, even if its own file was deleted while it is open.
    ///
    /// # Errors
    /// [`Error::File`] if something exists there already, or if the disk or the database fails;
    /// then nothing is left there.
    pub fn save_copy(&self, to: &Path) -> Result<()> {
        self.store.copy(to)
    }

    /// Opens the corpus at `path`; `author` is recorded with every change. A file of an older version is upgraded, and
    /// kept as it was beside itself: [`upgrade`](Self::upgrade).
    ///
    /// # Errors
    /// [`Error::File`] if the file does not exist, [`Error::NotACorpus`] if it is another kind of file.
    pub fn open(path: &Path, author: &str) -> Result<Self> {
        Ok(Self::of_store(Store::open(path, author)?))
    }

    /// Opens somebody else's corpus to read it, as for a merge into the one at `own`: the file stays as it is, also if its
    /// version is older. The changes of its copy are lost.
    ///
    /// # Errors
    /// Those of [`open`](Self::open).
    pub fn open_unchanged(path: &Path, own: &Path, author: &str) -> Result<Self> {
        Ok(Self::of_store(Store::open_unchanged(path, own, author)?))
    }

    /// Returns the upgrade that opening the file made, if its version was older.
    #[must_use]
    pub fn upgrade(&self) -> Option<&Upgrade> {
        self.store.upgrade()
    }

    /// Returns the path of the file.
    #[must_use]
    pub fn path(&self) -> &Path {
        self.store.path()
    }

    /// Undoes the newest operation that is in effect, and returns the operation that did so.
    ///
    /// # Errors
    /// Fails if nothing is left to undo, or if another change has touched a row of the operation since.
    pub fn undo(&mut self) -> Result<OperationRow> {
        self.undo_with_progress(&mut Progress::new(&mut unheard))
    }

    /// Undoes as [`undo`](Self::undo) does, and can be stopped.
    ///
    /// # Errors
    /// Those of [`undo`](Self::undo), and [`Error::Stopped`].
    pub fn undo_with_progress(&mut self, progress: &mut Progress<'_>) -> Result<OperationRow> {
        self.store.undo(progress)
    }

    /// Redoes the operation that was undone last, and returns the operation that did so.
    ///
    /// # Errors
    /// Fails if nothing is left to redo, or if a row of the operation is not as the undo left it.
    pub fn redo(&mut self) -> Result<OperationRow> {
        self.redo_with_progress(&mut Progress::new(&mut unheard))
    }

    /// Redoes as [`redo`](Self::redo) does, and can be stopped.
    ///
    /// # Errors
    /// Those of [`redo`](Self::redo), and [`Error::Stopped`].
    pub fn redo_with_progress(&mut self, progress: &mut Progress<'_>) -> Result<OperationRow> {
        self.store.redo(progress)
    }

    /// Returns at most `limit` operations, the newest first.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn log(&self, limit: usize) -> Result<Vec<OperationRow>> {
        self.store.log(limit)
    }
}
