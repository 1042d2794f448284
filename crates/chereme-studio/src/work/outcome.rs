//! The results of the use cases, which panes and notices match on.

use std::path::PathBuf;
use std::sync::Arc;

use chereme_corpus::study::report::Report;
use chereme_corpus::study::{
    AnswerList, AnswersReport, NamedText, Questionnaire, StudyClip, StudyOverview,
};
use chereme_corpus::{
    Adjudicated, Agreement, AnnotateReport, Answer, Around, CheckReport, Choice, CueSlips, Curves,
    Deleted, Details, ExportReport, Expressions, FitReport, ImportReport, MadePart, MergeReport,
    Moving, Onsets, OperationRow, Picture, PointsPiece, Proposed, Recombination, SignMap,
    Suggestions,
};
use eframe::egui::ColorImage;

/// The result of a [`Job`](super::Job).
#[derive(Debug)]
pub(crate) enum Outcome {
    /// A sentence that reports the result, in the language of the window.
    Said(String),
    /// Annotations were changed.
    Annotated(AnnotateReport),
    /// Something was changed that the next snapshot shows.
    Changed,
    /// A sign was generated and stored.
    Recombined(Box<Recombination>),
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
    Deleted(Deleted),
    /// The people to whom the markers of a recording belong; none if it is one person.
    People(Vec<String>),
    /// A body was fitted to markers.
    Fitted(Box<FitReport>),
    /// The corpus was checked.
    Checked(CheckReport),
    /// Values of a component were proposed from movement.
    Proposed(Proposed),
    /// All details of something.
    Looked(Details),
    /// Tokens were found.
    Found(Answer),
    /// The annotations around tokens.
    Around(Vec<Around>),
    /// The map of signs.
    Mapped(Arc<SignMap>),
    /// The slips of a take.
    CueSlips(Box<CueSlips>),
    /// The expressions of faces.
    Expressions(Arc<Expressions>),
    /// Performances were ranked.
    Chosen(Arc<Choice>),
    /// Two annotators were compared.
    Agreed(Arc<Agreement>),
    /// A third tier was written from those of two annotators.
    Adjudicated(Adjudicated),
    /// The studies.
    Studies(Arc<Vec<StudyOverview>>),
    /// The clip of a trial was made.
    TrialClip(Arc<StudyClip>),
    /// The study of that name was planned.
    Planned(String),
    /// A questionnaire was built.
    QuestionnaireBuilt(Box<Questionnaire>),
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
    Reported(Arc<Report>),
    /// Whether the desktop has a program that opened a file.
    Opened(bool),
    /// The report of a study was written to these files.
    ReportWritten(Vec<PathBuf>),
    /// The begin and end of non-manuals were measured.
    Onsets(Arc<Onsets>),
    /// Movement was generated.
    Previewed(Arc<Recombination>),
    /// Suggested recipes.
    Suggested(Suggestions),
    /// Files were written.
    Exported(ExportReport),
    /// The stage was drawn to a file.
    Shared(Picture),
    /// A piece of movement.
    Moved {
        /// The recording's row id.
        recording: i64,
        /// The piece's number.
        piece: usize,
        /// The movement.
        moving: Arc<Moving>,
    },
    /// The points of a span of a recording.
    Points(Vec<PointsPiece>),
    /// The movement of a span, if there is any.
    Stretch(Option<Arc<Moving>>),
    /// A picture of a film, for a span without movement.
    Still(Arc<ColorImage>),
    /// Pieces of a generated sign, each with its original if it has one.
    Originals(Vec<(MadePart, Option<Arc<Moving>>)>),
    /// A piece of movement was measured.
    Measured {
        /// The piece's number.
        piece: usize,
        /// Its curves.
        curves: Box<Curves>,
    },
}
