//! The results of the use cases, which panes and notices match on.

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::study::report::StudyReport;
use chereme_corpus::study::{AnswerList, AnswersReport, BuiltQuestionnaire, NamedText, StudyClip, StudyOverview};
use chereme_corpus::{
    AdjudicationResult, AnnotateReport, AnnotatorAgreement, CheckReport, CueSlips, DeletionReport, DisplayedMovement,
    ExportReport, FitReport, FoundExpressions, ImportReport, KinematicCurves, MadePart, MergeReport, NonmanualOnsets,
    ObjectDetails, OperationRow, PerformanceChoice, PointsPiece, ProposalResult, RecombinationResult, SearchAnswer,
    SignMap, SignMeasures, SignSuggestions, TierRoundReport, TokenNeighbours, ValueTally,
};
use eframe::egui::ColorImage;

/// The result of a [`CorpusJob`](super::CorpusJob).
#[derive(Debug)]
pub(crate) enum WorkOutcome {
    /// A sentence that reports the result, in the language of the window.
    Said(String),
    /// Annotations were changed.
    Annotated(AnnotateReport),
    /// Something was changed that the next snapshot shows.
    Changed,
    /// A sign was generated and stored.
    Recombined(Box<RecombinationResult>),
    /// Files were imported, or examined for an import.
    Imported(ImportReport),
    /// Another corpus was merged in.
    Merged(MergeReport),
    /// An operation was undone.
    Undone(OperationRow),
    /// An operation was redone.
    Redone(OperationRow),
    /// Several operations were undone or redone.
    Walked {
        /// Whether they were undone.
        back: bool,
        /// Their number.
        steps: usize,
    },
    /// Recordings and signs were deleted, or examined for that.
    Deleted(DeletionReport),
    /// The people to whom the markers of a recording belong; none if it is one person.
    People(Vec<String>),
    /// A body was fitted to markers.
    Fitted(Box<FitReport>),
    /// The corpus was checked.
    Checked(CheckReport),
    /// Values of a component were proposed from movement.
    Proposed(ProposalResult),
    /// All details of something.
    Looked(Box<ObjectDetails>),
    /// Tokens were found.
    Found(SearchAnswer),
    /// The values of a field were counted.
    Tallied(ValueTally),
    /// The changes that work on the tiers of many recordings made, or would make.
    Toured(TierRoundReport),
    /// The signs of a lexicon were measured one by one.
    SignsMeasured(Arc<SignMeasures>),
    /// The annotations around tokens.
    Around(Vec<TokenNeighbours>),
    /// The map of signs.
    Mapped(Arc<SignMap>),
    /// The slips of a take.
    CueSlips(Box<CueSlips>),
    /// The expressions of faces.
    Expressions(Arc<FoundExpressions>),
    /// Performances were ranked.
    Chosen(Arc<PerformanceChoice>),
    /// Two annotators were compared.
    Agreed(Arc<AnnotatorAgreement>),
    /// A third tier was written from those of two annotators.
    Adjudicated(AdjudicationResult),
    /// The studies.
    Studies(Arc<Vec<StudyOverview>>),
    /// The clip of a trial was made.
    TrialClip(Arc<StudyClip>),
    /// The study of that name was planned.
    Planned(String),
    /// A questionnaire was built.
    QuestionnaireBuilt(Box<BuiltQuestionnaire>),
    /// Answers to a study were imported.
    AnswersImported(Box<AnswersReport>),
    /// The answers to a study one by one.
    AnswersListed(Arc<AnswerList>),
    /// Answers to a study were written as a table.
    AnswersWritten,
    /// The plan of a study was written.
    PlanWritten,
    /// A file for the form of a study was read.
    StudyText(NamedText),
    /// The disagreements of two annotators were written.
    DisagreementsWritten,
    /// The report of a study was made.
    Reported(Arc<StudyReport>),
    /// Whether the desktop has a program that opened a file.
    Opened(bool),
    /// The report of a study was written to these files.
    ReportWritten(Vec<PathBuf>),
    /// The begin and end of non-manuals were measured.
    Onsets(Arc<NonmanualOnsets>),
    /// Movement was generated.
    Previewed(Arc<RecombinationResult>),
    /// Suggested recipes.
    Suggested(SignSuggestions),
    /// Files were written.
    Exported(ExportReport),
    /// The contents of the stage were written to a file.
    Shared {
        /// The name of the contents.
        title: String,
        /// The file.
        path: PathBuf,
        /// The objects that were left out, each with those who have not agreed that others see it.
        notes: Vec<String>,
    },
    /// A piece of movement.
    Moved {
        /// The recording's row id.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// The movement.
        moving: Arc<DisplayedMovement>,
    },
    /// The points of a span of a recording.
    Points(Vec<PointsPiece>),
    /// The movement of a span, if there is any.
    Stretch(Option<Arc<DisplayedMovement>>),
    /// A picture of a film, for a span without movement.
    Still(Arc<ColorImage>),
    /// Pieces of a generated sign, each with its original if it has one.
    Originals(Vec<(MadePart, Option<Arc<DisplayedMovement>>)>),
    /// A piece of movement was measured.
    Measured {
        /// The piece's number.
        piece: usize,
        /// Its curves.
        curves: Box<KinematicCurves>,
    },
}
