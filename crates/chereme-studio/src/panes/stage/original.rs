//! The sources of generated movement: the original of each of its pieces, at the corresponding time.

use std::sync::Arc;

use chereme_corpus::{MadePart, Moving};
use chereme_motion::Instant;

use super::scene::Subject;
use crate::context::{Outbox, PaneInput};
use crate::work::{Ended, Outcome, WorkId, movement};

/// The originals of the movement on the stage.
#[derive(Default)]
pub(super) struct Original {
    source: Option<Source>,
    work: Option<WorkId>,
    parts: Vec<Piece>,
    /// Whether the pieces are known, with or without originals.
    answered: bool,
}

#[derive(Debug, Clone, PartialEq)]
enum Source {
    Parts(Vec<MadePart>),
    /// The row id of a stored recording, and its recipe.
    Stored(i64, String),
}

/// A piece of the generated movement.
pub(super) struct Piece {
    pub(super) part: MadePart,
    /// Its original, if it has one.
    pub(super) shown: Option<(Arc<Moving>, Subject)>,
}

impl Original {
    /// Requests the originals if the movement on the stage changed; returns whether it did.
    pub(super) fn follow(&mut self, seen: &PaneInput<'_>, out: &mut Outbox) -> bool {
        let source = match &seen.shown.made {
            Some(showing) => Some(Source::Parts(showing.made.parts.clone())),
            None => {
                let shown = seen.shown.recording;
                let glance = shown.and_then(|id| seen.snapshot.recording(id));
                glance.and_then(|it| Some(Source::Stored(it.row.id, it.recipe.clone()?)))
            }
        };
        if source == self.source {
            return false;
        }
        let job = source.clone().map(|source| match source {
            Source::Parts(parts) => movement::originals(parts),
            Source::Stored(recording, _) => movement::originals_of(recording),
        });
        *self = Self {
            source,
            work: job.map(|job| out.work(job)),
            ..Self::default()
        };
        true
    }

    /// Handles the result of work; returns whether it was the requested originals.
    pub(super) fn hear(&mut self, id: WorkId, ended: &Ended) -> bool {
        if self.work.take_if(|work| *work == id).is_none() {
            return false;
        }
        if let Ok(Outcome::Originals(all)) = ended {
            self.answered = true;
            self.parts = all
                .iter()
                .map(|(part, moving)| {
                    let shown = moving.as_ref().and_then(|moving| {
                        let subject = Subject::after(None, &moving.clip, &moving.anatomy, false)?;
                        Some((moving.clone(), subject))
                    });
                    Piece {
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
        let made = ["spell ", "point "]
            .iter()
            .any(|word| from.starts_with(word));
        made.then_some(from)
    }

    /// Returns the piece at `at`; between two pieces, the nearer one.
    pub(super) fn piece(&self, at: Instant) -> Option<&Piece> {
        let nearest = nearest(self.parts.iter().map(|piece| &piece.part), at)?;
        self.parts.get(nearest)
    }
}

/// Returns the index of the part whose time is nearest to `at`; the first of equally near ones.
fn nearest<'a>(parts: impl Iterator<Item = &'a MadePart>, at: Instant) -> Option<usize> {
    let far = |part: &MadePart| {
        let (start, end) = (part.span.start().micros(), part.span.end().micros());
        (start - at.micros()).max(at.micros() - end + 1).max(0)
    };
    parts
        .enumerate()
        .min_by_key(|(_, part)| far(part))
        .map(|(place, _)| place)
}

/// Returns the moment of the original that corresponds to `at`: at the same distance from the beginning, but not after
/// the end.
pub(super) fn moment(piece: &MadePart, moving: &Moving, at: Instant) -> Instant {
    let inside = at.shifted(-piece.span.start().micros()).max(Instant::ZERO);
    inside.min(moving.clip.span().end())
}

#[cfg(test)]
mod tests {
    use super::*;
    use chereme_motion::Span;

    #[test]
    fn the_played_piece_is_the_one_at_the_playhead_or_the_nearest() {
        let micros = Instant::from_micros;
        let part = |start, end| MadePart {
            span: Span::between(micros(start), micros(end)),
            gloss: String::new(),
            from: String::new(),
        };
        let parts = [part(0, 100), part(140, 200)];
        let at = |at| nearest(parts.iter(), micros(at));
        assert_eq!(
            [0, 99, 110, 130, 140, 500].map(at),
            [0, 0, 0, 1, 1, 1].map(Some)
        );
        assert_eq!(nearest([].iter(), micros(0)), None);
    }
}
