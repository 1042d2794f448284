//! Faces of recordings: derivation from captured channels, milestones of expressions, scores, and choices among them.
//!
//! | file | what it does |
//! |---|---|
//! | `face_fit` | the weights of a mapping, fitted to a signer |
//! | `expressions` | expressions of a function, with their milestones |
//! | `face_milestones` | milestones derived from glosses and written as tiers |
//! | `performances` | expressions as numbers at one rate, cached until their recordings change |
//! | `shelf` | a cache of many performances in the corpus file |
//! | `touched` | the recordings whose performances a change affects |
//! | `face_onsets` | begin and end of non-manuals relative to the signs that they span |
//! | `face_choose` | ranking of performances for a sentence |

#[cfg(test)]
#[path = "tests/derived.rs"]
mod derived_tests;
mod expressions;
mod face_choose;
mod face_fit;
mod face_milestones;
mod face_onsets;
mod performances;
mod shelf;
#[cfg(test)]
mod tests;
mod touched;

use chereme_formats::{FindingSeverity, ImportFinding};
use chereme_motion::FacePosture;
use chereme_sign::ErrorRemedy;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName, find_addressed_recording};
use crate::curves::face_captured::{load_captured_face, no_face};
use crate::error::CorpusResult;

pub(crate) use expressions::find_expression_at as expression_at;
pub use face_choose::{
    ChooseOptions, FaceScore, PerformanceChoice, RankedPerformance, RankingCriterion, ScoredChannel,
};
pub use face_fit::{FaceFit, FittedNumber};
pub use face_milestones::{FoundExpression, FoundExpressions, MilestoneOptions};
pub use face_onsets::{NonmanualOnsets, NumberQuartiles, OnsetRow};
pub use performances::{FACE_CHANNELS, FaceChannel};
pub(crate) use performances::{PerformancePool, sample_channel_numbers};

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
