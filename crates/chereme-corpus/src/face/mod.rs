//! Faces of recordings: derived from captured channels, milestones of their expressions, scores, and choices among them.
//!
//! | module | what it does |
//! |---|---|
//! | [`stage`] | a recording of a face alone as movement of the program's own body |
//! | [`head`] | the turns of a head, from a skeleton or from the face's capture |
//! | [`expressions`] | where expressions of a function are, with their milestones |
//! | [`milestones`] | milestones derived from glosses and written as tiers |
//! | [`performances`] | expressions as numbers at one rate, kept while the corpus does not change |
//! | [`onsets`] | when non-manuals begin and end against the signs that they span |
//! | [`propose`] | proposals for brows, lids, gaze, mouth and head |
//! | [`choose`] | performances ranked for a sentence |

mod choose;
mod expressions;
mod head;
mod milestones;
mod onsets;
mod performances;
mod propose;
pub(crate) mod stage;
#[cfg(test)]
mod tests;

use chereme_compose::{Curve, NUMBER};
use chereme_formats::faces::{System, View};
use chereme_formats::{Finding, Severity};
use chereme_motion::{Face, Instant, Span};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::tracks::{self, TrackKind, TrackRow};
use crate::db::upgrade::NONMANUALS;
use crate::error::{Error, Result};
use crate::track;

pub use choose::{Choice, ChooseOptions, FaceScore, Rank, Ranked, ScoredChannel};
pub(crate) use expressions::at as expression_at;
pub use milestones::{Expressions, FoundExpression, MilestoneOptions};
pub use onsets::{OnsetRow, Onsets, Quartiles};
pub use performances::{CHANNELS, FaceChannel};
pub(crate) use performances::{Pool, numbers as numbers_of};
pub use propose::{FaceProposal, FaceProposals};

/// The face of a recording, as its capture gives it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceReport {
    /// The recording.
    pub recording: String,
    /// The track with the captured channels.
    pub track: String,
    /// The system of the channels, such as `arkit`.
    pub system: String,
    /// How many frames there are.
    pub frames: u64,
    /// How long they take, in microseconds.
    pub duration_us: i64,
    /// The numbers of the face, each over all frames.
    pub numbers: Vec<FaceNumber>,
    /// How many frames had gaps that were bridged.
    pub bridged: u64,
    /// The losses of the mapping, and oddities of the capture.
    pub findings: Vec<FaceFinding>,
}

/// One number of a face over all frames of a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceNumber {
    /// The name, one of [`Face::NAMES`], or `head_pitch`, `head_yaw`, `head_roll` in degrees.
    pub name: String,
    /// Whether the capture gives it; else it is unknown, not at rest.
    pub known: bool,
    /// The least value; `None` if unknown.
    pub least: Option<f64>,
    /// The mean; `None` if unknown.
    pub mean: Option<f64>,
    /// The greatest value; `None` if unknown.
    pub most: Option<f64>,
}

/// Something that a mapping loses, or that is odd in a capture.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FaceFinding {
    /// How much it matters.
    pub severity: Severity,
    /// What it is.
    pub message: String,
    /// What can be done; `None` if nothing.
    pub remedy: Option<String>,
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
    /// Returns what the captured face of a recording gives, and what its mapping to the house's face loses.
    ///
    /// # Errors
    /// If nothing has that address, or it has no captured face.
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
            findings: view.findings.into_iter().map(FaceFinding::from).collect(),
        })
    }
}

/// Returns the recording that an address lies in: its own, or that of a token, tier or annotation.
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

fn no_face(recording: &str) -> Error {
    Error::wrong(format!("the recording {recording:?} has no captured face"))
        .at(recording)
        .advise("import its face file (Live Link CSV, OpenFace CSV, MediaPipe JSON, .fap) under the same name")
}

/// The captured face of a recording.
pub(crate) struct Captured {
    pub(crate) row: TrackRow,
    pub(crate) times: chereme_motion::Times,
    pub(crate) view: View,
}

/// Returns the captured face of a recording, whole or of the frames in a span of the recording's clock: the first track of
/// curves that is of a face system. Curves that a recipe made do not count.
pub(crate) fn captured(
    connection: &Connection,
    recording: i64,
    span: Option<Span>,
) -> Result<Option<Captured>> {
    for row in tracks::tracks(connection, recording)? {
        if row.kind != TrackKind::Curves || row.name == NONMANUALS {
            continue;
        }
        let first = track::read::curves(connection, &row, Some(Span::default()));
        let known = match first {
            Ok(names) => System::of(&names),
            Err(error) => return Err(error),
        };
        let Some(system) = known.filter(|system| !system.expressions) else {
            continue;
        };
        let curves = track::read::curves(connection, &row, span)?;
        return Ok(Some(Captured {
            times: curves.times().clone(),
            view: system.view(&curves),
            row,
        }));
    }
    Ok(None)
}

impl Captured {
    /// Returns the face, the known numbers and the turns of the head at a moment of the recording's clock, blended between
    /// frames; before the first frame and after the last one the nearest frame's.
    pub(crate) fn at(&self, moment: Instant) -> (Face, Option<[f64; 3]>) {
        let own = moment.shifted(-self.row.offset_us).seconds();
        let last = self.view.faces.len().saturating_sub(1);
        let at = match self.times.rate() {
            Some(rate) => (own * rate.per_second()).clamp(0.0, last as f64),
            None => self.listed(own, last),
        };
        let (first, share) = (at.floor() as usize, at.fract());
        let second = (first + 1).min(last);
        let face = match self.view.faces.get(first) {
            Some(face) if share == 0.0 => *face,
            Some(face) => face.towards(&self.view.faces[second], share),
            None => Face::default(),
        };
        let head = self.view.head.as_ref().and_then(|all| {
            let (a, b) = (all.get(first)?, all.get(second)?);
            Some(std::array::from_fn(|n| a[n] + (b[n] - a[n]) * share))
        });
        (face, head)
    }

    fn listed(&self, seconds: f64, last: usize) -> f64 {
        let at = |frame: usize| self.times.instant(frame).seconds();
        let moment = Instant::from_seconds(seconds);
        let first = self.times.frame_at(moment, last + 1).unwrap_or(0).min(last);
        let second = (first + 1).min(last);
        let share = (seconds - at(first)) / (at(second) - at(first));
        first as f64
            + if share.is_nan() {
                0.0
            } else {
                share.clamp(0.0, 1.0)
            }
    }

    /// Returns a curve for each number that the capture gives, at these moments of the recording's clock.
    pub(crate) fn curves(&self, moments: impl Iterator<Item = Instant>) -> Vec<Curve> {
        let faces: Vec<[f64; Face::LEN]> = moments.map(|at| self.at(at).0.numbers()).collect();
        let known = Face::NAMES
            .iter()
            .enumerate()
            .filter(|(n, _)| self.view.known[*n]);
        known
            .map(|(n, name)| Curve {
                name: format!("{NUMBER}{name}"),
                values: faces.iter().map(|numbers| numbers[n]).collect(),
            })
            .collect()
    }
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
    Ok(match found {
        // The times of an even track count from its first frame, which a part does not begin with.
        Some(part) if part.times.rate().is_some() => {
            let mut part = part;
            let skipped = part.times.frames_in(
                span.shifted(-part.row.offset_us),
                usize::try_from(part.row.frames.unwrap_or_default()).unwrap_or(usize::MAX),
            );
            let moved = part.times.instant(skipped.start);
            part.row.offset_us = part.row.offset_us.saturating_add(moved.micros());
            part.curves(moments)
        }
        Some(part) => part.curves(moments),
        None => Vec::new(),
    })
}
