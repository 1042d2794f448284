//! Proposals for non-manual tiers from the curves of a face.

use chereme_analysis::detect::Nonmanuals;
use chereme_analysis::nonmanuals::Curves;
use chereme_motion::{Face, Instant, Span};
use rusqlite::Connection;
use serde::Serialize;

use super::captured::Captured;
use super::performances::{CHANNELS, numbers};
use super::{Fits, captured_with, no_face, recording_of};
use crate::Corpus;
use crate::address::{self, Address, Name};
use crate::db::recordings::{self, RecordingRow};
use crate::detect::{self, Proposal, ProposalChanges};
use crate::error::Result;
use crate::movement::MotionTrack;
use crate::progress::Progress;

/// The frames per second at which proposals are determined.
const RATE: f64 = 60.0;

/// The part of a recording that is examined, in microseconds from its start: a day.
const LONGEST: i64 = 86_400_000_000;
/// The number of frames that are read at once: two hours.
const PIECE: usize = 432_000;

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
    /// The names of the channels that detectors examine.
    const EXAMINED: [&str; 11] = [
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
    pub(crate) fn read(connection: &Connection, row: &RecordingRow) -> Result<Option<Self>> {
        Self::in_pieces(connection, row, PIECE)
    }

    /// Reads as [`read`](Self::read) does, this many frames at once.
    pub(super) fn in_pieces(
        connection: &Connection,
        row: &RecordingRow,
        piece: usize,
    ) -> Result<Option<Self>> {
        let frames = (row.duration_us.min(LONGEST) as f64 / 1e6 * RATE) as usize;
        let wanted: Vec<usize> = Self::EXAMINED
            .iter()
            .filter_map(|name| CHANNELS.iter().position(|channel| channel.name == *name))
            .collect();
        let fits = Fits::of(connection)?;
        let shown = Self::shown(connection, row, &fits)?;
        let moment = |n: usize| Instant::from_seconds(n as f64 / RATE);
        let mut channels: Vec<Option<Vec<f64>>> = vec![None; CHANNELS.len()];
        for start in (0..frames).step_by(piece) {
            let end = frames.min(start + piece);
            if !shown(moment(start), moment(end)) {
                continue;
            }
            let moments: Vec<Instant> = (start..end).map(moment).collect();
            let found = numbers(connection, row.id, &moments, &wanted, &fits)?;
            for (&at, more) in wanted.iter().zip(found.into_iter().flatten()) {
                if let Some(more) = more {
                    let known = channels[at].get_or_insert_default();
                    known.resize(start, f64::NAN);
                    known.extend(more);
                }
            }
        }
        let length = channels.iter().flatten().map(Vec::len).max();
        for channel in channels.iter_mut().flatten() {
            channel.resize(length.unwrap_or_default(), f64::NAN);
        }
        Ok(channels
            .iter()
            .any(Option::is_some)
            .then_some(Self { channels }))
    }

    /// Returns a test of whether a face or a skeleton may show something between two moments.
    fn shown(
        connection: &Connection,
        row: &RecordingRow,
        fits: &Fits,
    ) -> Result<impl Fn(Instant, Instant) -> bool> {
        let captured = captured_with(connection, row.id, None, fits)?;
        let near = captured.as_ref().map_or(0, |it| it.steps().1);
        let mut moments: Vec<Instant> = captured.iter().flat_map(Captured::moments).collect();
        moments.sort_unstable();
        let body = match recordings::body_track(connection, row.id)? {
            Some(_) => Some(MotionTrack::of(connection, row.id)?),
            None => None,
        };
        let body = body.map(|it| {
            let length = it.rate.instant(it.frames()).micros();
            it.row.offset_us..=it.row.offset_us.saturating_add(length)
        });
        Ok(move |start: Instant, end: Instant| {
            let (start, end) = (start.shifted(-near), end.shifted(near));
            let next = moments.partition_point(|it| *it < start);
            let moves = body
                .as_ref()
                .is_some_and(|it| *it.start() <= end.micros() && start.micros() <= *it.end());
            moves || moments.get(next).is_some_and(|it| *it <= end)
        })
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
