//! Proposals for non-manual tiers from the curves of a face.

use chereme_analysis::detect::NonmanualDetector;
use chereme_analysis::nonmanuals::ObservedFaceCurves;
use chereme_motion::{FacePosture, RecordingInstant, TimeSpan};
use rusqlite::Connection;
use serde::Serialize;

use super::{DetectionOutcome, DetectionUse, ProposalChanges, ProposedAnnotation};
use crate::Corpus;
use crate::address::{self, CorpusAddress, RowName, find_addressed_recording};
use crate::curves::face_captured::{CapturedFace, captured_with, no_face};
use crate::curves::face_fits::CorpusFits;
use crate::db::stored_recordings::{self, RecordingRow};
use crate::error::CorpusResult;
use crate::face::{FACE_CHANNELS, sample_channel_numbers};
use crate::movement::MotionTrack;
use crate::progress::ProgressReceiver;

/// The frames per second at which proposals are determined.
const PROPOSAL_RATE_FPS: f64 = 60.0;

/// The part of a recording that is examined, in microseconds from its start: a day.
const MAX_EXAMINED_TIME_US: i64 = 86_400_000_000;
/// The number of frames that are read at once: two hours.
const PROPOSAL_PIECE_FRAMES: usize = 432_000;

/// Proposals for the parts of a face in a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaceProposals {
    /// The recording's name.
    pub recording: String,
    /// The proposals, part by part in order of time.
    pub proposals: Vec<ProposedAnnotation>,
    /// How many annotations were written.
    pub written: u64,
}

/// The curves of a recording's face and head, with a number for each of its channels and frames.
pub(crate) struct FaceCurves {
    channels: Vec<Option<Vec<f64>>>,
}

impl FaceCurves {
    /// The names of the channels that detectors examine.
    const EXAMINED_CHANNEL_NAMES: [&str; 11] = [
        "head_pitch",
        "head_yaw",
        "brow_raise_right",
        "brow_raise_left",
        "brow_squeeze",
        "eye_close_right",
        "eye_close_left",
        "gaze_left",
        "gaze_up",
        "jaw_open",
        "lips_part",
    ];

    /// Reads the curves of a recording from its start; `None` without a face and a head.
    pub(crate) fn read_face_curves(connection: &Connection, row: &RecordingRow) -> CorpusResult<Option<Self>> {
        Self::in_pieces(connection, row, PROPOSAL_PIECE_FRAMES)
    }

    /// Reads as [`read_face_curves`](Self::read_face_curves) does, this many frames at once.
    pub(crate) fn in_pieces(connection: &Connection, row: &RecordingRow, piece: usize) -> CorpusResult<Option<Self>> {
        // A damaged file may claim a duration of years; no more than a day of frames is prepared for.
        let frames = (row.duration_us.min(MAX_EXAMINED_TIME_US) as f64 / 1e6 * PROPOSAL_RATE_FPS) as usize;
        let wanted: Vec<usize> = Self::EXAMINED_CHANNEL_NAMES
            .iter()
            .filter_map(|name| FACE_CHANNELS.iter().position(|channel| channel.name == *name))
            .collect();
        let fits = CorpusFits::load_corpus_fits(connection)?;
        let shown = Self::shown_between_test(connection, row, &fits)?;
        let moment = |n: usize| RecordingInstant::from_seconds(n as f64 / PROPOSAL_RATE_FPS);
        let mut channels: Vec<Option<Vec<f64>>> = vec![None; FACE_CHANNELS.len()];
        for start in (0..frames).step_by(piece) {
            let end = frames.min(start + piece);
            // A recording may last hours longer than its capture; empty pieces cost neither memory nor time.
            if !shown(moment(start), moment(end)) {
                continue;
            }
            let moments: Vec<RecordingInstant> = (start..end).map(moment).collect();
            let piece_numbers = sample_channel_numbers(connection, row.id, &moments, &wanted, &fits)?;
            for (&at, more) in wanted.iter().zip(piece_numbers.into_iter().flatten()) {
                if let Some(more) = more {
                    let series = channels[at].get_or_insert_default();
                    // Skipped pieces, and those before a channel first appears, have no number.
                    series.resize(start, f64::NAN);
                    series.extend(more);
                }
            }
        }
        let length = channels.iter().flatten().map(Vec::len).max();
        for channel in channels.iter_mut().flatten() {
            channel.resize(length.unwrap_or_default(), f64::NAN);
        }
        Ok(channels.iter().any(Option::is_some).then_some(Self { channels }))
    }

    /// Returns a test of whether a face or a skeleton may show something between two moments.
    fn shown_between_test(
        connection: &Connection,
        row: &RecordingRow,
        fits: &CorpusFits,
    ) -> CorpusResult<impl Fn(RecordingInstant, RecordingInstant) -> bool> {
        let captured = captured_with(connection, row.id, None, fits)?;
        // A face lasts up to the longest step past its frame, so that a piece beside it may show it.
        let near = captured.as_ref().map_or(0, |face| face.capture_frame_steps().1);
        let mut moments: Vec<RecordingInstant> =
            captured.iter().flat_map(CapturedFace::capture_frame_moments).collect();
        moments.sort_unstable();
        let motion_track = match stored_recordings::body_track(connection, row.id)? {
            Some(_) => Some(MotionTrack::open_motion_track(connection, row.id)?),
            None => None,
        };
        let body = motion_track.map(|track| {
            let length = track
                .rate
                .frame_start_instant(track.motion_frame_count())
                .instant_micros();
            track.row.offset_us..=track.row.offset_us.saturating_add(length)
        });
        Ok(move |start: RecordingInstant, end: RecordingInstant| {
            let (start, end) = (start.shifted_instant(-near), end.shifted_instant(near));
            let next = moments.partition_point(|moment| *moment < start);
            let moves = body
                .as_ref()
                .is_some_and(|range| *range.start() <= end.instant_micros() && start.instant_micros() <= *range.end());
            moves || moments.get(next).is_some_and(|moment| *moment <= end)
        })
    }

    /// Returns the curves as detectors examine them.
    pub(crate) fn detector_curves(&self) -> ObservedFaceCurves<'_> {
        let head = |at: usize| self.channels[at].as_deref();
        // The first three channels are those of the head; the numbers of the face follow.
        let of = |name: &str| self.channels[FacePosture::face_number_position(name)? + 3].as_deref();
        ObservedFaceCurves {
            rate: PROPOSAL_RATE_FPS,
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
        address: &CorpusAddress,
        store: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<FaceProposals> {
        let connection = self.store.read_connection();
        let recording = find_addressed_recording(connection, address)?;
        let row = address::find_recording_by_name(connection, &RowName::Number(recording))?;
        let proposals = match super::propose_for_recording(connection, &NonmanualDetector, &row)? {
            DetectionOutcome::Found(proposals) => proposals,
            DetectionOutcome::Nothing(_) => Vec::new(),
            DetectionOutcome::Unobserved => return Err(no_face(&row.name)),
        };
        let mut written = 0;
        if store {
            let mut changes = ProposalChanges::default();
            let full_span = TimeSpan::span_between(
                RecordingInstant::RECORDING_START,
                RecordingInstant::from_micros(row.duration_us),
            );
            changes.take_proposals(connection, recording, full_span, &NonmanualDetector, &proposals, None)?;
            self.store_proposals(&changes, DetectionUse::Proposed, progress)?;
            written = changes.added;
        }
        Ok(FaceProposals {
            recording: row.name,
            proposals,
            written,
        })
    }
}
