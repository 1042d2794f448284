//! The moment of a sign that determines its place.

use std::ops::Range;

use chereme_motion::Side;
use chereme_motion::glam::DVec3;
use chereme_sign::Component;

use crate::body;
use crate::contact::{self, Touch};
use crate::ops::say;
use crate::outcome::About;
use crate::recipe::HandPoint;
use crate::stroke::SignStroke;
use crate::work::Work;

/// The moment of a sign that determines its place: frames, and the point of the hand.
pub(super) struct Anchor {
    pub(super) point: HandPoint,
    pub(super) frames: Range<usize>,
    /// The contact that determines the place, if there is one.
    touch: Option<Touch>,
}

/// Finds the moment that determines the place of a sign. For one hand it is the contact with the body that falls in the
/// span of its own placement, or in the whole stroke if no placement is annotated; else the annotated stroke in that
/// span, else the span, else the stroke.
pub(super) fn anchor(
    work: &Work,
    stroke: &SignStroke,
    sides: &[Side],
    with: Option<HandPoint>,
) -> Anchor {
    let whole = stroke.frames.clone();
    let point = with.unwrap_or(HandPoint::Palm);
    let [side] = *sides else {
        let spans = sides.iter().filter_map(|&side| body::placed(work, side));
        let frames = spans.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
        return Anchor {
            point,
            frames: frames.unwrap_or(whole),
            touch: None,
        };
    };
    let placed = body::placed(work, side);
    let within = placed.clone().unwrap_or(whole.clone());
    if let Some(touch) = contact::touches(work).with_body(side, &within) {
        return Anchor {
            point: with.unwrap_or(touch.point),
            frames: touch.frame..touch.frame + 1,
            touch: Some(touch),
        };
    }
    let about = About::Component(Component::Movement, Some("phase".to_owned()));
    let strokes = work.notes.iter().filter(|note| {
        let stroke = note.value.value() == Some("stroke");
        stroke && note.about == about && say::is_of(work, note, &[side])
    });
    let strokes = strokes.filter_map(|note| {
        let frames = work.rate.frames_in(note.span);
        let frames = frames.start.max(within.start)..frames.end.min(within.end);
        (!frames.is_empty()).then_some(frames)
    });
    let stroke = strokes.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
    Anchor {
        point,
        frames: placed.or(stroke).unwrap_or(whole),
        touch: None,
    }
}

impl Anchor {
    /// Returns the position of the point at that moment; for two hands the middle between them.
    pub(super) fn at(&self, work: &Work, sides: &[Side]) -> Option<DVec3> {
        if sides.len() > 1 {
            return body::mean_point(work, sides, self.point);
        }
        let point = |model: &_| body::hand_point(work, model, sides[0], self.point);
        body::mean(work, self.frames.clone(), point)
    }

    pub(super) fn describe(&self, work: &Work) -> Option<String> {
        let touch = self.touch?;
        let at = work.rate.instant(touch.frame);
        Some(format!(
            "the place is that of the contact at {at}: the {} at the {}",
            self.point.name(),
            touch.place
        ))
    }
}
