//! Proposals for non-manual tiers from the curves of a face.

use chereme_analysis::detect::Nonmanuals;
use chereme_analysis::nonmanuals::Curves;
use chereme_motion::{Face, Instant, Span};
use rusqlite::Connection;
use serde::Serialize;

use super::performances::{CHANNELS, numbers};
use super::{Fits, no_face, recording_of};
use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::recordings::RecordingRow;
use crate::detect::{self, LONGEST, Proposal, ProposalChanges};
use crate::error::Result;
use crate::progress::Progress;

/// The frames per second at which proposals are determined.
const RATE: f64 = 60.0;

/// Proposals for the parts of a face in a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceProposals {
    /// The recording's name.
    pub recording: String,
    /// The proposals, part by part in order of time.
    pub proposals: Vec<Proposal>,
    /// How many annotations were written.
    pub written: u64,
}

/// The curves of a recording's face and head, with a number for each of its channels and frames.
pub(crate) struct FaceCurves {
    channels: Vec<Option<Vec<f64>>>,
}

impl FaceCurves {
    /// Reads the curves of a recording from its start; `None` without a face and a head.
    pub(crate) fn read(connection: &Connection, row: &RecordingRow) -> Result<Option<Self>> {
        let frames = (row.duration_us.min(LONGEST) as f64 / 1e6 * RATE) as usize;
        let moments: Vec<Instant> = (0..frames)
            .map(|n| Instant::from_seconds(n as f64 / RATE))
            .collect();
        let channels: Vec<usize> = (0..CHANNELS.len()).collect();
        let fits = Fits::of(connection)?;
        let found = numbers(connection, row.id, &moments, &channels, &fits)?;
        Ok(found.map(|channels| Self { channels }))
    }

    /// Returns the curves as detectors examine them.
    pub(crate) fn curves(&self) -> Curves<'_> {
        let head = |at: usize| self.channels[at].as_deref();
        let of = |name: &str| self.channels[Face::position(name)? + 3].as_deref();
        Curves {
            rate: RATE,
            brow_raise: [of("brow_raise_right"), of("brow_raise_left")],
            brow_squeeze: of("brow_squeeze"),
            eye_close: [of("eye_close_right"), of("eye_close_left")],
            gaze_left: of("gaze_left"),
            gaze_up: of("gaze_up"),
            jaw_open: of("jaw_open"),
            lips_part: of("lips_part"),
            head_pitch: head(0),
            head_yaw: head(1),
        }
    }
}

impl Corpus {
    /// Proposes actions of brows, lids, gaze, mouth and head in a recording with a face. With `store` they become
    /// annotations of a detector on tiers such as `nonmanual.brows (proposed)`, and replace earlier proposals that
    /// nobody has changed.
    ///
    /// # Errors
    /// Fails if nothing has that address, it has no face, or the corpus cannot be written.
    pub fn propose_nonmanuals(
        &mut self,
        address: &Address,
        store: bool,
        progress: &mut Progress<'_>,
    ) -> Result<FaceProposals> {
        let connection = self.store.read();
        let recording = recording_of(connection, address)?;
        let row = address::recording(connection, &Name::Number(recording))?;
        let proposals = detect::proposals(connection, &Nonmanuals, &row)?;
        let proposals = proposals.ok_or_else(|| no_face(&row.name))?;
        let mut written = 0;
        if store {
            let mut changes = ProposalChanges::default();
            let whole = Span::between(Instant::ZERO, Instant::from_micros(row.duration_us));
            changes.take(connection, recording, whole, (&Nonmanuals, &proposals))?;
            self.store_proposals(&changes, progress)?;
            written = changes.added;
        }
        Ok(FaceProposals {
            recording: row.name,
            proposals,
            written,
        })
    }
}
