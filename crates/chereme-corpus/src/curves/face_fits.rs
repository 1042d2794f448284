//! The fits of signers' faces, which are stored with the takes on which they were made.

use std::collections::BTreeMap;

use chereme_formats::faces::{DerivedFaceView, FaceCalibration};
use rusqlite::Connection;
use serde::{Deserialize, Serialize};

use crate::db::stored_tracks;
use crate::error::CorpusResult;

/// The layout of a track on which weights were fitted.
#[derive(Serialize, Deserialize)]
pub(crate) struct FittedTrackLayout {
    /// The fit.
    pub(crate) fit: FaceCalibration,
}

/// The fits of a corpus.
#[derive(Default)]
pub(crate) struct CorpusFits {
    by_recording: BTreeMap<i64, FaceCalibration>,
    by_signer: BTreeMap<i64, (i64, FaceCalibration)>,
    signers: BTreeMap<i64, i64>,
}

impl CorpusFits {
    /// Returns all fits stored with takes of a corpus.
    pub(crate) fn load_corpus_fits(connection: &Connection) -> CorpusResult<Self> {
        let mut fits = Self::default();
        for (recording, signer, text) in stored_tracks::layouts_of_curves(connection)? {
            // A layout without a fit belongs to another program.
            let Ok(FittedTrackLayout { fit }) = serde_json::from_str(&text) else {
                continue;
            };
            if let Some(signer) = signer {
                fits.by_signer.insert(signer, (recording, fit.clone()));
            }
            fits.by_recording.insert(recording, fit);
        }
        if !fits.by_signer.is_empty() {
            fits.signers = stored_tracks::signers_of_recordings(connection)?;
        }
        Ok(fits)
    }

    /// Converts the numbers of a recording's face by the fit of its own take or of its signer's newest one; returns the
    /// recording of that take.
    pub(crate) fn apply_recording_fit(&self, recording: i64, view: &mut DerivedFaceView) -> Option<i64> {
        let recording_fit = self.by_recording.get(&recording).map(|fit| (recording, fit));
        let signer = self.signers.get(&recording);
        let signers = signer.and_then(|name| self.by_signer.get(name));
        let (of, fit) = recording_fit.or(signers.map(|(of, fit)| (*of, fit)))?;
        fit.is_calibration_for(view).then(|| {
            fit.apply_face_calibration(view);
            of
        })
    }
}
