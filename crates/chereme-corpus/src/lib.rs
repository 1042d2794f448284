//! A corpus opened for work: SQLite, search index, history, and all use cases.
//!
//! User interfaces work on a corpus through [`Corpus`]; free functions do what needs no corpus, such as merging two
//! annotation files. Each change is one named operation in one transaction,
//! with its changeset. Nothing here prints, prompts, or reads the environment.

mod address;
mod agree;
mod animate;
mod annotate;
mod atomic_write;
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
mod forget;
mod forms;
mod hands;
mod import;
mod info;
mod inventories;
mod kinematics;
mod lexicon;
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
mod people;
mod picture;
mod progress;
mod propose;
mod publish;
pub mod recipe;
mod recombine;
mod relations;
mod report_finding;
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
mod values;
mod word_coverage;
pub mod words;

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

/// A corpus file with its search index.
type IndexedStore = db::CorpusStore<search::index::SearchIndex>;

pub use chereme_formats::faces::{FaceSystem, MappingLoss};
pub use chereme_formats::roles::{AnnotatedHands, MappingError, TierGuess, TierMapping};
pub use chereme_formats::table::annotations::{TableMoment, TableTimeUnit};
pub use chereme_motion::RecordingInstant;
pub use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones, ExpressionPhase};
pub use chereme_sign::query::QUERY_HELP;
pub use chereme_sign::remedy;
pub use chereme_sign::tier::tier_spans::NeighbourMode;
pub use chereme_sign::{TierRole, TierStereotype, TierTopic};

pub use address::{CorpusAddress, RecordingStretch, RowName};
pub use agree::{
    AdjudicationResult, AgreeOptions, AnnotatorAgreement, BaselineAgreement, DisagreementCounts, DisagreementKind,
    DisagreementSide, FEWEST_UNITS, FigureInterval, MEASURE_NAMES, MeasureFigure, PairAgreement, USUAL_MEASURES,
    UnitCounts, ValueAgreement, ValueConfusion, ValueDisagreement, alike_tiers,
};
pub use animate::NotationStaging;
pub use annotate::{
    AnnotateOptions, AnnotateReport, AnnotationAction, AnnotationChange, AnnotationName, CopiedAnnotations, NewTier,
    RemovedTiers, ReplacedValue, ReplacementReport, TierPropertyChange, TierRequestName, TierRoundOptions,
    TierRoundReport, TierRoundRow, TierRoundScope, TierRoundWork, TierScheme, TierSelection, TierValueSource,
    ValueSearch,
};
pub use annotate::{annotate_clipboard, annotate_paste, drag_limits, requests, snap, tier_values};
pub use author::determine_author;
pub use check::{CheckReport, CorpusFault};
pub use chereme_analysis::cut::CutOptions;
pub use chereme_analysis::detect::{ALL_DETECTORS, AnnotationDetector, NonmanualDetector};
pub use chereme_analysis::kinematics::{ClipKinematicCurves, HandCurves};
pub use chereme_analysis::phases::{NoPath, PhaseScore};
pub use chereme_analysis::{ClipSimilarityScore, ScoreOptions};
pub use chereme_compose::GeneratedCurve;
pub use chereme_figure::ANIMATION_SPEEDS;
pub use chereme_formats::compare::{
    ComparedAnnotation, MergeConflict as FileConflict, MovedAnnotation, RevaluedAnnotation, TranscriptDifference,
    TranscriptTierChange as TierDifference,
};
pub use chereme_sign::query::{add_query_condition, facet_condition, has_query_condition, remove_query_condition};
pub use compare::{CompareSide, FileMerge, merge_files};
pub use consent::{
    ConsentAudience, ConsentChange, ConsentKind, ConsentRow, OutputAudience, PersonConsent, WithheldOutput,
    WithheldReason,
};
pub use contents::{
    AnnotationColumns, CorpusOverview, ProposalAcceptor, RecordingContents, RecordingGlance, ShownFrames, SignGlance,
    TierContents,
};
pub use context::TokenNeighbours;
pub use cue::{
    CueKey, CueKeys, CueOptions, KeysOptions, SpokenWord, cue_keys, cue_keys_of_file, cue_phones_of_espeak,
    cue_phones_of_file, cue_recipe, read_pronunciation_dictionary,
};
pub use cued::{
    CueConfusion, CueCosts, CuePhaseRow, CuePhaseStatistics, CueRecognition, CueSlip, CueSlips, CueTargets,
    CuedMarkers, CuedOptions, DictionaryCueOptions, DictionaryReport, DikeyDictionaryReport, FoundKey, FromDictionary,
    MarkerSet, MisreadKey, MissingDikey, RestoreOptions, RestoredMarker, RestoredTake, ScriptCoverage, SentencePiece,
    SlipKind, WorthRecording, read_marker_labels,
};
pub use db::file_identity::FileIdentity;
pub use db::lexicons::{LexiconContents, LexiconRow};
pub use db::people::{PersonAttribute, PersonContents};
pub use db::sign_relations::SignRelation;
pub use db::signs::TokenRow;
pub use db::stored_columns::{AnnotationOrigin, RecordOrigin, ValueState};
pub use db::stored_delete::RecordingBelongings;
pub use db::stored_recordings::{MediaTrackRow, RecordingRow, SignerRow};
pub use db::stored_rows::KeptSearch;
pub use db::stored_tiers::{TierRow, TierShown, is_detector_tier, proposed_for};
pub use db::{OperationKind, OperationRow, SchemaUpgrade, on_waiting};
pub use delete::{DeleteOptions, DeletedRecording, DeletionDependent, DeletionReport, DependentsPolicy};
pub use details::{
    ObjectDetails, RecordingDetails, SignDetails, SignerDetails, TokenDetails, TokenValue, ValueDetails, ValueOpinion,
};
pub use detect::{
    DetectOptions, DetectedIn, DetectionReport, DetectionUse, FaceProposals, GLOSSES_FROM_NAMES, ProposedAnnotation,
    UndetectedIn,
};
pub use edit::{RecordingChange, SignChange, SignerChange};
pub use error::{CorpusError, CorpusResult, DatabaseFailureCause, FailedStep, MeantName, WrongQuery};
pub use export::{ExportOptions, ExportReport, ExportWhat, ExportedFile, MovementForm};
pub use face::{
    ChooseOptions, FACE_CHANNELS, FaceChannel, FaceFinding, FaceFit, FaceNumber, FaceReport, FaceScore, FittedNumber,
    FoundExpression, FoundExpressions, MilestoneOptions, NonmanualOnsets, NumberQuartiles, OnsetRow, PerformanceChoice,
    RankedPerformance, RankingCriterion, ScoredChannel,
};
pub use film::{FilmFacts, FilmFile, FilmPicture, FilmTimes, PicturePlanes};
pub use foreign_code::hide_handled_panics;
pub use forget::{ForgottenSigner, StillSaidText};
pub use forms::{EmptyCellTreatment, FIELD_SETS, FieldSet, FormSource};
pub use import::{
    AnnotationSide, BodyRead, ConventionRead, EditOutcome, FileInterpretation, FileJoin, FileJoining, FileReport,
    FileStatus, ImportCompletion, ImportOptions, ImportReport, JoinReason, JoinedFile, JoinedRecording, JointRole,
    MovementRead, OwnEdit, OwnEdits, ReimportChanges, RootRead, SharedPart, TiersRead, TrackRead, UnreadFileKind,
    read_stream, readable_files, time_of_day,
};
pub use info::{AttributeInfo, CorpusInfo, InventoryInfo, SignerInfo, TrackAmount};
pub use inventories::{EqualValues, StoredInventory, ValueName};
pub use kinematics::KinematicCurves;
pub use lexicon::{LexiconChange, LexiconScope, LinkedRecordings, UnitedLexicons};
pub use list::{ListFilter, ListKind, ListedRows, cell_text, components_text};
pub use log::{ChangeKind, ChangedRow, FieldChange, OperationDetail, change_sentence};
pub use map::{MapOptions, MapPoint, SignMap};
pub use media::{MediaChange, MediaPlace, find_media, is_film};
pub use merge::{ConflictCandidate, CorpusConflict, MergeReport};
pub use movement::ChannelGroup;
pub use notation::{TokenNotation, read_notation};
pub use pairs::{DenseSign, MinimalPair, MinimalPairs, PairOptions};
pub use paths::paths_like;
pub use people::{PeopleTableReport, PersonChange, UnitedPeople};
pub use picture::picture_values as value_pictures;
pub use picture::{DisplayedMovement, DrawablePerformance, DrawnPicture, PictureOptions, draw_clip};
pub use progress::{ProgressListener, ProgressReceiver, ProgressStep, ProgressUnit, ignore_progress_step};
pub use propose::{
    AcceptanceResult, ProposalChoice, ProposalResult, ProposeOptions, ProposeScope, ProposedCoding, ProposedValue,
    accepting_tier,
};
pub use publish::{LeftOutPart, LeftOutSigns, PublishOptions, PublishedDictionary};
pub use recombine::{MadePart, NotationFinding, RecombinationResult, TimedNote};
pub use relations::RelationChange;
pub use report_finding::ReportFinding;
pub use score::MovementScore;
pub use search::saved_search::kept_like;
pub use search::{
    FACET_VALUES, FindingKind, HitOrder, NO_VALUE, OpinionStanding, QueryFinding, SearchAnswer, SearchHit,
    SearchOptions, TallyRow, ValueTally, guessed_query_text, meant_query_text,
};
pub use starter::{StarterSign, built_in_body, starter_files, starter_signs, unpack_starter};
pub use stats::{
    BattisonConditions, ChanceAssociation, CrossCell, FieldAssociation, FieldContrast, FieldInDepth, FieldStatistics,
    FieldValue, HandCondition, IntervalEnds, LexiconStatistics, MeasuredSign, NeighbourDefinition, SignMeasureOptions,
    SignMeasures, StatsEstimate, StatsFinding, StatsOptions, TwoHands,
};
pub use suggest::{MinimalPairPartner, SignSuggestions};
pub use track::{
    AlignmentSignal, FitOptions, FitReport, FitResidual, MediaFile, NewTrack, PointsPiece, SkeletonTrack,
    TrackAlignment, TrackChange, TrackContent, TrackKind, TrackRow,
};
pub use transcribe::{SignTranscription, TranscribedFeature, TranscribedStage, TranscribedValue};
pub use values::{EqualProposal, MergedValues};
pub use word_coverage::{LanguageCoverage, MissingPhrase, PhraseFault, language_coverage, use_word_folder};
pub use words::effect::ConflictDecision;

/// An open corpus.
pub struct Corpus {
    store: IndexedStore,
    /// Cache of what was learned from the corpus: the profile of strokes and samples of body language.
    learned: RefCell<sources::LearnedCache>,
    /// Cache of the inventories, with the generation for which they are valid.
    inventories: RefCell<Option<(i64, Arc<Vec<StoredInventory>>)>>,
    /// Cache of the corrections of finger angles by recording.
    hands: RefCell<hands::HandCorrectionCache>,
    /// The recipe being drafted.
    drafted: recombine::DraftedRecipe,
    /// Cache of facial expressions as numbers; after a change only the changed recordings are read again.
    faces: RefCell<face::PerformancePool>,
}

impl Corpus {
    /// Creates an empty corpus at `path`; `author` is recorded with every change.
    ///
    /// # Errors
    /// [`CorpusError::File`] if something exists there already or the folder is missing.
    pub fn create_corpus(path: &Path, author: &str) -> CorpusResult<Self> {
        let store = IndexedStore::create_corpus_store(path, author, inventories::store_builtin)?;
        Ok(Self::of_store(store))
    }

    fn of_store(store: IndexedStore) -> Self {
        Self {
            store,
            learned: RefCell::default(),
            inventories: RefCell::default(),
            hands: RefCell::default(),
            drafted: recombine::DraftedRecipe::default(),
            faces: RefCell::default(),
        }
    }

    /// Writes the whole corpus to a new file, even if its own file was deleted while it is open.
    ///
    /// # Errors
    /// [`CorpusError::File`] if something exists there already, or if the disk or the database fails;
    /// then nothing is left there.
    pub fn save_copy(&self, to: &Path) -> CorpusResult<()> {
        self.store.copy_store_file(to)
    }

    /// Opens the corpus at `path`; `author` is recorded with every change. A file of an older version is upgraded, and
    /// kept as it was beside itself: [`schema_upgrade`](Self::schema_upgrade).
    ///
    /// # Errors
    /// [`CorpusError::File`] if the file does not exist, [`CorpusError::NotACorpus`] if it is another kind of file.
    pub fn open_corpus(path: &Path, author: &str) -> CorpusResult<Self> {
        Ok(Self::of_store(IndexedStore::open_corpus_store(path, author)?))
    }

    /// Opens somebody else's corpus to read it, as for a merge into the one at `own`: the file stays as it is, also if its
    /// version is older. The changes of its copy are lost.
    ///
    /// # Errors
    /// Those of [`open_corpus`](Self::open_corpus).
    pub fn open_unchanged(path: &Path, own: &Path, author: &str) -> CorpusResult<Self> {
        Ok(Self::of_store(IndexedStore::open_unchanged(path, own, author)?))
    }

    /// Returns the upgrade that opening the file made, if its version was older.
    #[must_use]
    pub fn schema_upgrade(&self) -> Option<&SchemaUpgrade> {
        self.store.store_upgrade()
    }

    /// Returns the path of the file.
    #[must_use]
    pub fn corpus_file_path(&self) -> &Path {
        self.store.store_path()
    }

    /// Undoes the newest operation that is in effect, and returns the operation that did so.
    ///
    /// # Errors
    /// Fails if nothing is left to undo, or if another change has touched a row of the operation since.
    pub fn undo_operation(&mut self) -> CorpusResult<OperationRow> {
        self.undo_with_progress(&mut ProgressReceiver::silent_progress())
    }

    /// Undoes as [`undo_operation`](Self::undo_operation) does, and can be stopped.
    ///
    /// # Errors
    /// Those of [`undo_operation`](Self::undo_operation), and [`CorpusError::Stopped`].
    pub fn undo_with_progress(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<OperationRow> {
        self.store.undo_store_operation(progress)
    }

    /// Redoes the operation that was undone last, and returns the operation that did so.
    ///
    /// # Errors
    /// Fails if nothing is left to redo, or if a row of the operation is not as the undo left it.
    pub fn redo_operation(&mut self) -> CorpusResult<OperationRow> {
        self.redo_with_progress(&mut ProgressReceiver::silent_progress())
    }

    /// Redoes as [`redo_operation`](Self::redo_operation) does, and can be stopped.
    ///
    /// # Errors
    /// Those of [`redo_operation`](Self::redo_operation), and [`CorpusError::Stopped`].
    pub fn redo_with_progress(&mut self, progress: &mut ProgressReceiver<'_>) -> CorpusResult<OperationRow> {
        self.store.redo_store_operation(progress)
    }

    /// Returns at most `limit` operations, the newest first.
    ///
    /// # Errors
    /// Fails if the database fails.
    pub fn operation_log(&self, limit: usize) -> CorpusResult<Vec<OperationRow>> {
        self.store.store_operation_log(limit)
    }
}
