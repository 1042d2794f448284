//! `reverse`: the movement played backwards, an exact involution.

use chereme_motion::Span;
use chereme_sign::{Component, Reading};

use crate::made::About;
use crate::work::{Group, Work};

/// Plays all channels backwards; returns what one should know.
pub(crate) fn reverse(work: &mut Work) -> Vec<String> {
    for channel in &mut work.channels {
        channel.rotations.reverse();
        if let Some(places) = &mut channel.translations {
            places.reverse();
        }
    }
    for curve in &mut work.curves {
        curve.values.reverse();
    }
    let end = work.end().micros();
    let mut did = vec![format!("{} frames played backwards", work.frames)];
    for note in &mut work.notes {
        let span = note.span;
        note.span = Span::between(span.end(), span.start()).mirrored(end);
        if matches!(note.about, About::Component(Component::Movement, _))
            && let Some(value) = note.value.value()
        {
            did.push(format!(
                "movement {value:?} is no longer told: it runs the other way"
            ));
            note.value = Reading::Unset;
        }
    }
    work.notes.sort_by_key(|note| note.span.start());
    work.changed(Group::ALL, "reverse");
    did
}

trait Mirrored {
    fn mirrored(self, end: i64) -> Self;
}

impl Mirrored for Span {
    /// Returns the span as seen from an end at `end` microseconds.
    fn mirrored(self, end: i64) -> Self {
        let at = |instant: chereme_motion::Instant| {
            chereme_motion::Instant::from_micros(end.saturating_sub(instant.micros()))
        };
        Self::between(at(self.end()), at(self.start()))
    }
}
