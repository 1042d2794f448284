//! Fits the weights of a mapping to a signer, on a take in which the face moves to its extremes; the fit is stored with
//! that take.

use std::collections::BTreeMap;

use chereme_formats::faces::{Fit, View};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};

use super::{FaceFinding, captured_with, no_face, recording_of};
use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::tracks;
use crate::error::{Error, Result};
use crate::words::effect::OperationEffect;

/// The fit of a take.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceFit {
    /// The recording of the take.
    pub recording: String,
    /// The signer whose faces the fit applies to; `None` if it is for this recording alone.
    pub signer: Option<String>,
    /// The system, such as `arkit`.
    pub system: String,
    /// The frames of the take.
    pub frames: u64,
    /// The numbers of the face.
    pub numbers: Vec<FittedNumber>,
    /// Numbers that do not change in the take, and losses of the mapping.
    pub findings: Vec<FaceFinding>,
    /// Whether it was stored.
    pub stored: bool,
}

/// The fit of one number of a face.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedNumber {
    /// The name.
    pub name: String,
    /// The formula of the mapping whose weights are multiplied.
    pub formula: String,
    /// The number of a face at rest.
    pub rest: f64,
    /// The factor of all weights above rest; 1 if the take has no values there.
    pub up: f64,
    /// The factor of all weights below rest; 1 if the take has no values there.
    pub down: f64,
}

/// The layout of a track on which weights were fitted.
#[derive(Serialize, Deserialize)]
struct Kept {
    fit: Fit,
}

/// The fits of a corpus.
#[derive(Default)]
pub(crate) struct Fits {
    by_recording: BTreeMap<i64, Fit>,
    by_signer: BTreeMap<i64, (i64, Fit)>,
    signers: BTreeMap<i64, i64>,
}

impl Fits {
    /// Returns all fits stored with takes of a corpus.
    pub(crate) fn of(connection: &Connection) -> Result<Self> {
        let mut fits = Self::default();
        for (recording, signer, text) in tracks::layouts_of_curves(connection)? {
            // A layout without a fit belongs to another program.
            let Ok(Kept { fit }) = serde_json::from_str(&text) else {
                continue;
            };
            if let Some(signer) = signer {
                fits.by_signer.insert(signer, (recording, fit.clone()));
            }
            fits.by_recording.insert(recording, fit);
        }
        if !fits.by_signer.is_empty() {
            fits.signers = tracks::signers_of_recordings(connection)?;
        }
        Ok(fits)
    }

    /// Converts the numbers of a recording's face by the fit of its own take or of its signer's newest one; returns the
    /// recording of that take.
    pub(crate) fn apply(&self, recording: i64, view: &mut View) -> Option<i64> {
        let own = self
            .by_recording
            .get(&recording)
            .map(|fit| (recording, fit));
        let signer = self.signers.get(&recording);
        let signers = signer.and_then(|it| self.by_signer.get(it));
        let (of, fit) = own.or(signers.map(|(of, fit)| (*of, fit)))?;
        fit.suits(view).then(|| {
            fit.apply(view);
            of
        })
    }
}

impl Corpus {
    /// Fits the weights of a face system's mapping to the signer of a take in which the face moves to its extremes.
    /// With `store` the weights are stored with that take: faces of the same signer and system are then measured from
    /// the signer's own rest, and are 1 at the signer's usual extreme.
    ///
    /// # Errors
    /// Fails if nothing has that address, it has no captured face, or the corpus cannot be written.
    pub fn fit_face(&mut self, address: &Address, store: bool) -> Result<FaceFit> {
        let connection = self.store.read();
        let recording = recording_of(connection, address)?;
        let row = address::recording(connection, &Name::Number(recording))?;
        let plain = captured_with(connection, recording, None, &Fits::default())?;
        let plain = plain.ok_or_else(|| no_face(&row.name))?;
        let fit = Fit::of(&plain.view).ok_or_else(|| no_face(&row.name))?;
        let number = |(name, reach): (&String, &chereme_formats::faces::Reach)| {
            let [up, down] = reach.factors();
            let formula = plain.view.system.house.get(name);
            FittedNumber {
                name: name.clone(),
                formula: formula.cloned().unwrap_or_default(),
                rest: reach.rest,
                up,
                down,
            }
        };
        let mut findings: Vec<FaceFinding> = Vec::new();
        let untried: Vec<&str> = fit.untried().collect();
        if !untried.is_empty() {
            let says = format!(
                "the take never moves {}: their weights stay",
                untried.join(", ")
            );
            let remedy = "record a take in which each part of the face goes as far as it can";
            let finding = chereme_formats::Finding::warning(None, says).with_remedy(remedy);
            findings.push(finding.into());
        }
        findings.extend(plain.view.findings.iter().cloned().map(FaceFinding::from));
        let mut report = FaceFit {
            signer: row.signer.clone(),
            system: fit.system.clone(),
            frames: fit.frames as u64,
            numbers: fit.numbers.iter().map(number).collect(),
            recording: row.name.clone(),
            findings,
            stored: false,
        };
        let track = plain.row;
        if store && track.kind != tracks::TrackKind::Curves {
            return Err(Error::wrong(format!(
                "the face of {:?} is estimated from points on film, which count from their own median and keep no weights",
                row.name
            ))
            .at(&row.name)
            .advise("fit a take of a face system, such as Live Link or MPEG-4"));
        }
        if store {
            let text = serde_json::to_string(&Kept { fit })
                .map_err(|error| Error::wrong(error.to_string()))?;
            self.store.operation(|connection| {
                tracks::set_layout(connection, track.id, &text)?;
                let signer = row.signer.as_ref().unwrap_or(&row.name).clone();
                let (track, recording) = (track.name.clone(), row.name.clone());
                let effect = OperationEffect::FitFace {
                    track,
                    signer,
                    recording,
                };
                Ok(((), effect))
            })?;
            report.stored = true;
        }
        Ok(report)
    }
}
