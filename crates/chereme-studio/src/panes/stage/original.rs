//! The sources of generated movement: the original of each of its pieces, at the corresponding time.

use std::sync::Arc;

use chereme_corpus::{DisplayedMovement, MadePart};
use chereme_motion::RecordingInstant;

use super::stage_scene::StageSubject;
use crate::context::PaneInput;
use crate::work::{WorkId, WorkOutcome, WorkResult, movement_jobs};

/// The originals of the movement on the stage.
#[derive(Default)]
pub(super) struct OriginalMovements {
    source: Option<OriginalSource>,
    work: Option<WorkId>,
    parts: Vec<OriginalPiece>,
    /// Whether the pieces are known, with or without originals.
    answered: bool,
}

#[derive(Debug, Clone, PartialEq)]
enum OriginalSource {
    Parts(Vec<MadePart>),
    /// The row id of a stored recording, and its recipe.
    Stored(i64, String),
}

/// A piece of the generated movement.
pub(super) struct OriginalPiece {
    pub(super) part: MadePart,
    /// Its original, if it has one.
    pub(super) shown: Option<(Arc<DisplayedMovement>, StageSubject)>,
}

impl OriginalMovements {
    /// Requests the originals if the movement on the stage changed; returns whether it did.
    pub(super) fn request_original_movements(&mut self, seen: &PaneInput<'_>) -> bool {
        let source = match &seen.shown.made {
            Some(showing) => Some(OriginalSource::Parts(showing.made.parts.clone())),
            None => {
                let shown = seen.shown.recording;
                let glance = shown.and_then(|id| seen.snapshot.recording_glance(id));
                glance.and_then(|glance| Some(OriginalSource::Stored(glance.row.id, glance.recipe.clone()?)))
            }
        };
        if source == self.source {
            return false;
        }
        let job = source.clone().map(|source| match source {
            OriginalSource::Parts(parts) => movement_jobs::load_originals_job(parts),
            OriginalSource::Stored(recording, _) => movement_jobs::originals_of(recording),
        });
        *self = Self {
            // The request before is dropped with the old state: its answer would be of another movement.
            source,
            work: job.map(|job| seen.request_work(job)),
            ..Self::default()
        };
        true
    }

    /// Handles the result of work; returns whether it was the requested originals.
    pub(super) fn receive_original_movements(&mut self, id: WorkId, ended: &WorkResult) -> bool {
        // Answers to requests before a change of the stage are of no use.
        if self.work.take_if(|work| *work == id).is_none() {
            return false;
        }
        if let Ok(WorkOutcome::Originals(all)) = ended {
            self.answered = true;
            self.parts = all
                .iter()
                .map(|(part, moving)| {
                    let shown = moving.as_ref().and_then(|moving| {
                        let subject = StageSubject::succeed_stage_subject(None, &moving.clip, &moving.anatomy, false)?;
                        Some((moving.clone(), subject))
                    });
                    OriginalPiece {
                        part: part.clone(),
                        shown,
                    }
                })
                .collect();
        }
        true
    }

    /// Returns whether any piece has an original.
    pub(super) fn is_there(&self) -> bool {
        self.parts.iter().any(|piece| piece.shown.is_some())
    }

    /// Returns the source of the first piece if no piece has an original and the movement is fingerspelling or
    /// pointing; `None` for notation, which is not expected to have an original.
    pub(super) fn made_by(&self) -> Option<&str> {
        let none = self.answered && !self.is_there();
        let first = self.parts.first().filter(|_| none)?;
        let from = &first.part.from;
        let made = ["spell ", "point "].iter().any(|word| from.starts_with(word));
        made.then_some(from)
    }

    /// Returns the piece at `at`; between two pieces, the nearer one.
    pub(super) fn original_piece_at(&self, at: RecordingInstant) -> Option<&OriginalPiece> {
        let nearest = nearest_made_part(self.parts.iter().map(|piece| &piece.part), at)?;
        self.parts.get(nearest)
    }
}

/// Returns the index of the part whose time is nearest to `at`; the first of equally near ones.
fn nearest_made_part<'a>(parts: impl Iterator<Item = &'a MadePart>, at: RecordingInstant) -> Option<usize> {
    let far = |part: &MadePart| {
        let (start, end) = part.span.span_bounds_micros();
        // The end is excluded from a span, so that a moment there is one microsecond away.
        (start - at.instant_micros()).max(at.instant_micros() - end + 1).max(0)
    };
    parts
        .enumerate()
        .min_by_key(|(_, part)| far(part))
        .map(|(place, _)| place)
}

/// Returns the moment of the original that corresponds to `at`: at the same distance from the beginning, but not after
/// the end.
pub(super) fn original_moment_at(
    piece: &MadePart,
    moving: &DisplayedMovement,
    at: RecordingInstant,
) -> RecordingInstant {
    let inside = at
        .shifted_instant(-piece.span.span_start_instant().instant_micros())
        .max(RecordingInstant::RECORDING_START);
    // Originals may be shorter than the piece made of them; their last posture stays.
    inside.min(moving.clip.clip_span().span_end_instant())
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::TimeSpan;

    #[test]
    fn the_played_piece_is_the_one_at_the_playhead_or_the_nearest() {
        let micros = RecordingInstant::from_micros;
        let part = |start, end| MadePart {
            span: TimeSpan::span_between(micros(start), micros(end)),
            gloss: String::new(),
            from: String::new(),
        };
        let parts = [part(0, 100), part(140, 200)];
        let at = |at| nearest_made_part(parts.iter(), micros(at));
        assert_eq!([0, 99, 110, 130, 140, 500].map(at), [0, 0, 0, 1, 1, 1].map(Some));
        assert_eq!(nearest_made_part([].iter(), micros(0)), None);
    }
}
