//! Fits the weights of a mapping to a signer, on a take in which the face moves to its extremes; the fit is stored with
//! that take.

use chereme_formats::faces::FaceCalibration;
use serde::Serialize;

use super::FaceFinding;
use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName, find_addressed_recording};
use crate::curves::face_captured::{captured_with, no_face};
use crate::curves::face_fits::{CorpusFits, FittedTrackLayout};
use crate::db::stored_tracks;
use crate::error::{CorpusError, CorpusResult};
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

impl Corpus {
    /// Fits the weights of a face system's mapping to the signer of a take in which the face moves to its extremes.
    /// With `store` the weights are stored with that take: faces of the same signer and system are then measured from
    /// the signer's own rest, and are 1 at the signer's usual extreme.
    ///
    /// # Errors
    /// Fails if nothing has that address, it has no captured face, or the corpus cannot be written.
    pub fn fit_face(&mut self, address: &CorpusAddress, store: bool) -> CorpusResult<FaceFit> {
        let connection = self.store.read_connection();
        let recording = find_addressed_recording(connection, address)?;
        let row = address::find_recording_by_name(connection, &RowName::Number(recording))?;
        // An earlier fit must not change the numbers from which this one is determined.
        let plain_capture = captured_with(connection, recording, None, &CorpusFits::default())?;
        let plain = plain_capture.ok_or_else(|| no_face(&row.name))?;
        let fit = FaceCalibration::calibration_from_view(&plain.view).ok_or_else(|| no_face(&row.name))?;
        let number = |(name, reach): (&String, &chereme_formats::faces::ExcursionReach)| {
            let [up, down] = reach.excursion_factors();
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
        let untried: Vec<&str> = fit.untried_number_names().collect();
        if !untried.is_empty() {
            let says = format!("the take never moves {}: their weights stay", untried.join(", "));
            let remedy = "record a take in which each part of the face goes as far as it can";
            let finding = chereme_formats::ImportFinding::new_warning_finding(None, says).with_remedy(remedy);
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
        if store && track.kind != stored_tracks::TrackKind::Curves {
            return Err(CorpusError::from_wrong_message(format!(
                "the face of {:?} is estimated from points on film, which count from their own median and keep no weights",
                row.name
            ))
            .with_error_place(&row.name)
            .with_advice("fit a take of a face system, such as Live Link or MPEG-4"));
        }
        if store {
            let text = serde_json::to_string(&FittedTrackLayout { fit })
                .map_err(|error| CorpusError::from_wrong_message(error.to_string()))?;
            self.store.run_store_operation(|connection| {
                stored_tracks::set_layout(connection, track.id, &text)?;
                // A take without a signer keeps the fit for itself.
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
