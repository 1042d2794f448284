//! Similarity of two pieces of movement.

use std::path::Path;

use chereme_analysis::score::{Performed, Score, ScoreError, ScoreOptions, score_as};
use chereme_figure::{ChartOptions, alignment_picture, write_png};
use chereme_motion::Side;
use chereme_sign::Remedy;
use serde::Serialize;

use crate::Corpus;
use crate::address::Address;
use crate::db::recordings;
use crate::error::{Error, Result};
use crate::hands;
use crate::picture::{Moving, write};

/// The similarity of two pieces of movement of a corpus.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scored {
    /// The distances and the alignment.
    #[serde(flatten)]
    pub score: Score,
    /// Notes on what is not compared.
    pub findings: Vec<String>,
}

/// A piece of movement with the hands whose fingers nobody captured.
struct Piece {
    moving: Moving,
    uncaptured: Vec<Side>,
}

impl Corpus {
    /// Compares two pieces of movement by dynamic time warping, component by component. Handshapes of hands that nobody
    /// captured are not compared; a finding lists them.
    ///
    /// # Errors
    /// Fails if an address has no movement or only a face, or the two have nothing in common that can be compared.
    pub fn score(&self, a: &Address, b: &Address, options: &ScoreOptions) -> Result<Scored> {
        score(&self.piece(a)?, &self.piece(b)?, options)
    }

    /// Compares as [`score`](Self::score) does, and draws the alignment to a PNG.
    ///
    /// # Errors
    /// As [`score`](Self::score), or if the picture cannot be written.
    pub fn draw_alignment(
        &self,
        [a, b]: [&Address; 2],
        options: &ScoreOptions,
        to: &Path,
        force: bool,
    ) -> Result<Scored> {
        let names = [a.to_string(), b.to_string()];
        let (a, b) = (self.piece(a)?, self.piece(b)?);
        let scored = score(&a, &b, options)?;
        let chart = ChartOptions {
            names,
            ..ChartOptions::default()
        };
        let lengths = [a.moving.clip.frames(), b.moving.clip.frames()];
        let fault = |error: chereme_figure::FigureError| Error::wrong(error.to_string());
        let image = alignment_picture(&scored.score.alignment, lengths, &chart).map_err(fault)?;
        write(to, force, |out| write_png(&image, out).map_err(fault))?;
        Ok(scored)
    }

    /// Returns the movement at an address, which has a captured or made body.
    fn piece(&self, address: &Address) -> Result<Piece> {
        let moving = self.usable_movement(address)?;
        let connection = self.store.read();
        let recording = &moving.stretch.recording;
        if recordings::body_track(connection, recording.id)?.is_none() {
            let text = format!("{:?} has a face but no body to compare", recording.name);
            return Err(Error::wrong(text)
                .at(&recording.name)
                .advise(Remedy::command(
                    "`chereme score CORPUS A B --face` compares expressions of the face",
                )));
        }
        let uncaptured = hands::resting(connection, &self.hands, recording)?;
        Ok(Piece { moving, uncaptured })
    }
}

fn score(a: &Piece, b: &Piece, options: &ScoreOptions) -> Result<Scored> {
    let score =
        score_as(a.performed(), b.performed(), options).map_err(|error| match error {
            ScoreError::NothingCaptured => Error::wrong(
                "the two have only handshapes in common, and nobody captured them, as the fingers rest throughout",
            )
            .advise("compare recordings whose fingers move, or that have joints of the arms"),
            error => Error::wrong(format!("the two cannot be compared: {error}")),
        })?;
    let findings = findings(&score, [a, b].map(Piece::recording));
    Ok(Scored { score, findings })
}

impl Piece {
    fn performed(&self) -> Performed<'_> {
        Performed {
            clip: &self.moving.clip,
            anatomy: &self.moving.anatomy,
            uncaptured: &self.uncaptured,
        }
    }

    fn recording(&self) -> &str {
        &self.moving.stretch.recording.name
    }
}

/// Returns the findings about components that are left out of a score of pieces of two recordings.
fn findings(score: &Score, [first, second]: [&str; 2]) -> Vec<String> {
    let mut findings = Vec::new();
    let mut without_joints = Vec::new();
    for left in &score.left_out {
        let names = match left.uncaptured {
            (true, true) if first != second => format!("{first}, {second}"),
            (true, _) => first.to_owned(),
            (_, true) => second.to_owned(),
            _ => {
                without_joints.push(format!("{} {}", left.component, left.side.name()));
                continue;
            }
        };
        findings.push(format!(
            "handshapes of the {} hand are not compared, as its fingers rest throughout and nobody captured them: {names}",
            left.side.name()
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
