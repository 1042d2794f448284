//! Similarity of two pieces of movement.

use std::path::Path;

use chereme_analysis::score::{ClipSimilarityScore, PerformedClip, ScoreError, ScoreOptions, score_as};
use chereme_figure::{ChartOptions, alignment_picture, write_png};
use chereme_motion::BodySide;
use serde::Serialize;

use crate::Corpus;
use crate::address::CorpusAddress;
use crate::atomic_write::write_atomically;
use crate::db::stored_recordings;
use crate::error::{CorpusError, CorpusResult};
use crate::hands;
use crate::picture::DisplayedMovement;

/// The similarity of two pieces of movement of a corpus.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MovementScore {
    /// The distances and the alignment.
    #[serde(flatten)]
    pub score: ClipSimilarityScore,
    /// Notes on what is not compared.
    pub findings: Vec<String>,
}

/// A piece of movement with the hands whose fingers nobody captured.
struct ScoredPiece {
    moving: DisplayedMovement,
    uncaptured: Vec<BodySide>,
}

impl Corpus {
    /// Compares two pieces of movement by dynamic time warping, component by component. Handshapes of hands that nobody
    /// captured are not compared; a finding lists them.
    ///
    /// # Errors
    /// Fails if an address has no movement or only a face, or the two have nothing in common that can be compared.
    pub fn score_movements(
        &self,
        a: &CorpusAddress,
        b: &CorpusAddress,
        options: &ScoreOptions,
    ) -> CorpusResult<MovementScore> {
        score_two_pieces(&self.scored_piece(a)?, &self.scored_piece(b)?, options)
    }

    /// Compares as [`score`](Self::score_movements) does, and draws the alignment to a PNG.
    ///
    /// # Errors
    /// As [`score`](Self::score_movements), or if the picture cannot be written.
    pub fn draw_alignment(
        &self,
        [a, b]: [&CorpusAddress; 2],
        options: &ScoreOptions,
        to: &Path,
        force: bool,
    ) -> CorpusResult<MovementScore> {
        let names = [a.to_string(), b.to_string()];
        let (a, b) = (self.scored_piece(a)?, self.scored_piece(b)?);
        let scored = score_two_pieces(&a, &b, options)?;
        let chart = ChartOptions {
            names,
            ..ChartOptions::default()
        };
        let lengths = [a.moving.clip.clip_frame_count(), b.moving.clip.clip_frame_count()];
        let fault = |error: chereme_figure::FigureError| CorpusError::from_wrong_message(error.to_string());
        let image = alignment_picture(&scored.score.alignment, lengths, &chart).map_err(fault)?;
        write_atomically(to, force, |out| write_png(&image, out).map_err(fault))?;
        Ok(scored)
    }

    /// Returns the movement at an address, which has a captured or made body.
    fn scored_piece(&self, address: &CorpusAddress) -> CorpusResult<ScoredPiece> {
        let moving = self.usable_movement(address)?;
        let connection = self.store.read_connection();
        let recording = &moving.stretch.recording;
        if stored_recordings::body_track(connection, recording.id)?.is_none() {
            let text = format!("{:?} has a face but no body to compare", recording.name);
            return Err(CorpusError::from_wrong_message(text)
                .with_error_place(&recording.name)
                .with_command_advice("`chereme score CORPUS A B --face` compares expressions of the face"));
        }
        // Fingers that rest throughout would make all handshapes equal, though nobody captured them.
        let uncaptured = hands::find_resting_hands(connection, &self.hands, recording)?;
        Ok(ScoredPiece { moving, uncaptured })
    }
}

fn score_two_pieces(a: &ScoredPiece, b: &ScoredPiece, options: &ScoreOptions) -> CorpusResult<MovementScore> {
    let score = score_as(a.performed(), b.performed(), options).map_err(|error| match error {
        ScoreError::NothingCaptured => CorpusError::from_wrong_message(
            "the two have only handshapes in common, and nobody captured them, as the fingers rest throughout",
        )
        .with_advice("compare recordings whose fingers move, or that have joints of the arms"),
        error => CorpusError::from_wrong_message(format!("the two cannot be compared: {error}")),
    })?;
    let findings = score_findings(&score, [a, b].map(ScoredPiece::piece_recording_name));
    Ok(MovementScore { score, findings })
}

impl ScoredPiece {
    fn performed(&self) -> PerformedClip<'_> {
        PerformedClip {
            clip: &self.moving.clip,
            anatomy: &self.moving.anatomy,
            uncaptured: &self.uncaptured,
        }
    }

    fn piece_recording_name(&self) -> &str {
        &self.moving.stretch.recording.name
    }
}

/// Returns the findings about components that are left out of a score of pieces of two recordings.
fn score_findings(score: &ClipSimilarityScore, [first, second]: [&str; 2]) -> Vec<String> {
    let mut findings = Vec::new();
    let mut without_joints = Vec::new();
    for left in &score.left_out {
        let names = match left.uncaptured {
            (true, true) if first != second => format!("{first}, {second}"),
            (true, _) => first.to_owned(),
            (_, true) => second.to_owned(),
            _ => {
                without_joints.push(format!("{} {}", left.component, left.side.body_side_name()));
                continue;
            }
        };
        findings.push(format!(
            "handshapes of the {} hand are not compared, as its fingers rest throughout and nobody captured them: {names}",
            left.side.body_side_name()
        ));
    }
    if !without_joints.is_empty() {
        findings.push(format!(
            "not compared, as one or both of the skeletons have no joints for it: {}",
            without_joints.join(", ")
        ));
    }
    findings
}
