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

mod captured;
mod choose;
mod course;
#[cfg(test)]
#[path = "tests/derived.rs"]
mod derived_tests;
mod expressions;
mod fit;
mod head;
mod milestones;
mod onsets;
mod performances;
mod propose;
mod shelf;
pub(crate) mod stage;
#[cfg(test)]
mod tests;
mod touched;

use chereme_compose::Curve;
use chereme_formats::{Finding, Severity};
use chereme_motion::{Face, Instant, Span};
use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::error::{Error, Result};

pub(crate) use captured::{captured, captured_with};
pub use choose::{Choice, ChooseOptions, FaceScore, Rank, Ranked, ScoredChannel};
pub(crate) use course::Course;
pub(crate) use expressions::at as expression_at;
pub(crate) use fit::Fits;
pub use fit::{FaceFit, FittedNumber};
pub use milestones::{Expressions, FoundExpression, MilestoneOptions};
pub use onsets::{OnsetRow, Onsets, Quartiles};
pub(crate) use performances::Pool;
pub use performances::{CHANNELS, FaceChannel};
pub(crate) use propose::FaceCurves;
pub use propose::FaceProposals;

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
    /// The name, one of [`Face::NAMES`], or `head_pitch`, `head_yaw`, `head_roll` in degrees.
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
    pub severity: Severity,
    /// The finding.
    pub message: String,
    /// A remedy, if there is one.
    pub remedy: Option<Remedy>,
}

impl From<Finding> for FaceFinding {
    fn from(finding: Finding) -> Self {
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
    pub fn face(&self, address: &Address) -> Result<FaceReport> {
        let connection = self.store.read();
        let recording = recording_of(connection, address)?;
        let row = address::recording(connection, &Name::Number(recording))?;
        let captured = captured(connection, recording, None)?.ok_or_else(|| no_face(&row.name))?;
        let view = captured.view;
        let number = |name: &str, values: Option<Vec<f64>>| {
            let of = |choose: fn(f64, f64) -> f64| {
                values
                    .as_ref()
                    .and_then(|all| all.iter().copied().reduce(choose))
            };
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
        let mut numbers: Vec<FaceNumber> = Face::NAMES
            .iter()
            .map(|name| number(name, view.value(name)))
            .collect();
        for (at, name) in ["head_pitch", "head_yaw", "head_roll"]
            .into_iter()
            .enumerate()
        {
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
                Some(id) => Some(address::recording(connection, &Name::Number(id))?.name),
                None => None,
            },
            findings: view.findings.into_iter().map(FaceFinding::from).collect(),
        })
    }
}

/// Returns the recording that contains the object at an address: a recording, token, tier or annotation.
pub(crate) fn recording_of(connection: &Connection, address: &Address) -> Result<i64> {
    use crate::db::tiers;
    Ok(match address {
        Address::Recording(name) => address::recording(connection, name)?.id,
        Address::Annotation(id) => {
            let row = tiers::annotation(connection, *id)?;
            tiers::tier(connection, row.tier_id)?.recording_id
        }
        Address::Tier(id) => tiers::tier(connection, *id)?.recording_id,
        other => address::stretch(connection, other)?.recording.id,
    })
}

/// Returns whether a recording has a captured face.
pub(crate) fn has_face(connection: &Connection, recording: i64) -> Result<bool> {
    Ok(captured(connection, recording, None)?.is_some())
}

pub(crate) fn no_face(recording: &str) -> Error {
    Error::wrong(format!("the recording {recording:?} has no captured face"))
        .at(recording)
        .advise("import its face file (Live Link CSV, OpenFace CSV, MediaPipe JSON, .fap) under the same name")
}

/// Returns a curve for each number of the captured face of a recording, at these moments of its clock; empty without one.
pub(crate) fn curves_at(
    connection: &Connection,
    recording: i64,
    moments: impl Iterator<Item = Instant> + Clone,
) -> Result<Vec<Curve>> {
    let (Some(first), Some(last)) = (moments.clone().next(), moments.clone().last()) else {
        return Ok(Vec::new());
    };
    const AROUND: i64 = 200_000;
    let span = Span::between(first.shifted(-AROUND), last.shifted(AROUND));
    let found = captured(connection, recording, Some(span))?;
    Ok(found.map_or(Vec::new(), |face| face.curves(moments)))
}
