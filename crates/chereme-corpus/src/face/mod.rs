//! Faces of recordings: derivation from captured channels, milestones of expressions, scores, and choices among them.
//!
//! | module | what it does |
//! |---|---|
//! | [`stage`] | a recording that has only a face, as movement of the program's own body |
//! | [`captured`] | the captured face of a recording: channels of a face system, or points on film |
//! | [`course`] | the mean of some channels over time, for conditions of a search |
//! | [`fit`] | the weights of a mapping, fitted to a signer |
//! | [`head`] | rotations of head and trunk, from a skeleton or from the face's capture |
//! | [`expressions`] | expressions of a function, with their milestones |
//! | [`milestones`] | milestones derived from glosses and written as tiers |
//! | [`performances`] | expressions as numbers at one rate, cached until their recordings change |
//! | [`shelf`] | a cache of many performances in the corpus file |
//! | [`touched`] | the recordings whose performances a change affects |
//! | [`onsets`] | begin and end of non-manuals relative to the signs that they span |
//! | [`propose`] | proposals for brows, lids, gaze, mouth and head |
//! | [`choose`] | ranking of performances for a sentence |

#[cfg(test)]
#[path = "tests/derived.rs"]
mod derived_tests;
mod expressions;
mod face_captured;
mod face_choose;
mod face_course;
mod face_fit;
mod face_head;
mod face_milestones;
mod face_onsets;
mod face_propose;
pub(crate) mod face_stage;
mod performances;
mod shelf;
#[cfg(test)]
mod tests;
mod touched;

use chereme_compose::GeneratedCurve;
use chereme_formats::{FindingSeverity, ImportFinding};
use chereme_motion::{FacePosture, RecordingInstant, TimeSpan};
use chereme_sign::ErrorRemedy;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName};
use crate::error::{CorpusError, CorpusResult};

pub(crate) use expressions::find_expression_at as expression_at;
pub(crate) use face_captured::{captured_with, load_captured_face};
pub use face_choose::{
    ChooseOptions, FaceScore, PerformanceChoice, RankedPerformance, RankingCriterion, ScoredChannel,
};
pub(crate) use face_course::ChannelCourse;
pub(crate) use face_fit::CorpusFits;
pub use face_fit::{FaceFit, FittedNumber};
pub use face_milestones::{FoundExpression, FoundExpressions, MilestoneOptions};
pub use face_onsets::{NonmanualOnsets, NumberQuartiles, OnsetRow};
pub(crate) use face_propose::FaceCurves;
pub use face_propose::FaceProposals;
pub(crate) use performances::PerformancePool;
pub use performances::{FACE_CHANNELS, FaceChannel};

/// The face of a recording, derived from its capture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceReport {
    /// The name of the recording.
    pub recording: String,
    /// The track with the captured channels.
    pub track: String,
    /// The system of the channels, such as `arkit`.
    pub system: String,
    /// How many frames there are.
    pub frames: u64,
    /// The length in microseconds.
    pub duration_us: i64,
    /// The numbers of the face, each over all frames.
    pub numbers: Vec<FaceNumber>,
    /// The number of frames with gaps that were bridged.
    pub bridged: u64,
    /// The recording on whose take the weights were fitted; `None` if they are those of the mapping.
    pub fitted_on: Option<String>,
    /// The losses of the mapping, and oddities of the capture.
    pub findings: Vec<FaceFinding>,
}

/// One number of a face over all frames of a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceNumber {
    /// The name, one of [`FacePosture::FACE_NUMBER_NAMES`], or `head_pitch`, `head_yaw`, `head_roll` in degrees.
    pub name: String,
    /// Whether the capture provides it; otherwise it is unknown, not at rest.
    pub known: bool,
    /// The least value; `None` if unknown.
    pub least: Option<f64>,
    /// The mean; `None` if unknown.
    pub mean: Option<f64>,
    /// The greatest value; `None` if unknown.
    pub most: Option<f64>,
}

/// A loss of a mapping, or an oddity of a capture.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FaceFinding {
    /// The severity.
    pub severity: FindingSeverity,
    /// The finding.
    pub message: String,
    /// A remedy, if there is one.
    pub remedy: Option<ErrorRemedy>,
}

impl From<ImportFinding> for FaceFinding {
    fn from(finding: ImportFinding) -> Self {
        Self {
            severity: finding.severity,
            message: finding.message,
            remedy: finding.remedy,
        }
    }
}

impl Corpus {
    /// Returns the face derived from the capture of a recording, and the losses of its mapping to the program's own
    /// face.
    ///
    /// # Errors
    /// Fails if nothing has that address, or it has no captured face.
    pub fn report_captured_face(&self, address: &CorpusAddress) -> CorpusResult<FaceReport> {
        let connection = self.store.read_connection();
        let recording = find_addressed_recording(connection, address)?;
        let row = address::find_recording_by_name(connection, &RowName::Number(recording))?;
        let captured = load_captured_face(connection, recording, None)?.ok_or_else(|| no_face(&row.name))?;
        let view = captured.view;
        let number = |name: &str, values: Option<Vec<f64>>| {
            let of = |choose: fn(f64, f64) -> f64| values.as_ref().and_then(|all| all.iter().copied().reduce(choose));
            FaceNumber {
                name: name.to_owned(),
                known: values.is_some(),
                least: of(f64::min),
                mean: of(|a, b| a + b)
                    .zip(values.as_ref())
                    .map(|(sum, all)| sum / all.len() as f64),
                most: of(f64::max),
            }
        };
        let mut numbers: Vec<FaceNumber> = FacePosture::FACE_NUMBER_NAMES
            .iter()
            .map(|name| number(name, view.face_number_values(name)))
            .collect();
        for (at, name) in ["head_pitch", "head_yaw", "head_roll"].into_iter().enumerate() {
            let turned = view
                .head
                .as_ref()
                .map(|all| all.iter().map(|turn| turn[at].to_degrees()).collect());
            numbers.push(number(name, turned));
        }
        Ok(FaceReport {
            recording: row.name,
            track: captured.row.name.clone(),
            system: view.system.id.clone(),
            frames: view.faces.len() as u64,
            duration_us: captured.row.duration_us.unwrap_or_default(),
            numbers,
            bridged: view.bridged as u64,
            fitted_on: match captured.fitted {
                Some(id) => Some(address::find_recording_by_name(connection, &RowName::Number(id))?.name),
                None => None,
            },
            findings: view.findings.into_iter().map(FaceFinding::from).collect(),
        })
    }
}

/// Returns the recording that contains the object at an address: a recording, token, tier or annotation.
pub(crate) fn find_addressed_recording(connection: &Connection, address: &CorpusAddress) -> CorpusResult<i64> {
    use crate::db::stored_tiers;
    Ok(match address {
        CorpusAddress::Recording(name) => address::find_recording_by_name(connection, name)?.id,
        CorpusAddress::Annotation(id) => {
            let row = stored_tiers::load_annotation_row(connection, *id)?;
            stored_tiers::load_tier_row(connection, row.tier_id)?.recording_id
        }
        CorpusAddress::Tier(id) => stored_tiers::load_tier_row(connection, *id)?.recording_id,
        other => address::find_addressed_stretch(connection, other)?.recording.id,
    })
}

/// Returns whether a recording has a captured face.
pub(crate) fn has_face(connection: &Connection, recording: i64) -> CorpusResult<bool> {
    Ok(load_captured_face(connection, recording, None)?.is_some())
}

pub(crate) fn no_face(recording: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("the recording {recording:?} has no captured face"))
        .with_error_place(recording)
        .with_advice("import its face file (Live Link CSV, OpenFace CSV, MediaPipe JSON, .fap) under the same name")
}

/// Returns a curve for each number of the captured face of a recording, at these moments of its clock; empty without one.
pub(crate) fn curves_at(
    connection: &Connection,
    recording: i64,
    moments: impl Iterator<Item = RecordingInstant> + Clone,
) -> CorpusResult<Vec<GeneratedCurve>> {
    let (Some(first), Some(last)) = (moments.clone().next(), moments.clone().last()) else {
        return Ok(Vec::new());
    };
    const CURVE_MARGIN_US: i64 = 200_000;
    let span = TimeSpan::span_between(
        first.shifted_instant(-CURVE_MARGIN_US),
        last.shifted_instant(CURVE_MARGIN_US),
    );
    let captured_face = load_captured_face(connection, recording, Some(span))?;
    Ok(captured_face.map_or(Vec::new(), |face| face.sample_capture_curves(moments)))
}
