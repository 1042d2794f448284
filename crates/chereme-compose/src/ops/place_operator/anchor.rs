//! The moment of a sign that determines its place.

use std::ops::Range;

use chereme_motion::BodySide;
use chereme_motion::glam::DVec3;
use chereme_sign::SignComponent;

use crate::body;
use crate::contact::{self, BodyTouch};
use crate::ops::component_notes;
use crate::outcome::NoteSubject;
use crate::recipe_settings::RecipeHandPoint;
use crate::stroke::SignStroke;
use crate::work::WorkingClip;

/// The moment of a sign that determines its place: frames, and the point of the hand.
pub(super) struct PlacementAnchor {
    pub(super) point: RecipeHandPoint,
    pub(super) frames: Range<usize>,
    /// The contact that determines the place, if there is one.
    touch: Option<BodyTouch>,
}

/// Finds the moment that determines the place of a sign. For one hand it is the contact with the body that falls in the
/// span of its own placement, or in the whole stroke if no placement is annotated; else that span; without a placement the
/// annotated stroke, else the stroke.
pub(super) fn find_placement_anchor(
    work: &WorkingClip,
    stroke: &SignStroke,
    sides: &[BodySide],
    with: Option<RecipeHandPoint>,
) -> PlacementAnchor {
    let stroke_frames = stroke.frames.clone();
    let point = with.unwrap_or(RecipeHandPoint::Palm);
    // Two hands have no single contact that could stand for the place of both.
    let [side] = *sides else {
        let spans = sides.iter().filter_map(|&side| body::held_placement_frames(work, side));
        let frames = spans.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
        return PlacementAnchor {
            point,
            frames: frames.unwrap_or(stroke_frames),
            touch: None,
        };
    };
    let placed = body::held_placement_frames(work, side);
    let within = placed.clone().unwrap_or(stroke_frames.clone());
    if let Some(touch) = contact::find_contacts(work).with_body(side, &within) {
        return PlacementAnchor {
            point: with.unwrap_or(touch.point),
            frames: touch.frame..touch.frame + 1,
            touch: Some(touch),
        };
    }
    let about = NoteSubject::Component(SignComponent::Movement, Some("phase".to_owned()));
    let strokes = work.notes.iter().filter(|note| {
        let stroke = note.value.reading_value() == Some("stroke");
        stroke && note.about == about && component_notes::is_of(work, note, &[side])
    });
    let strokes = strokes.filter_map(|note| {
        let note_frames = work.rate.frames_in(note.span);
        let frames = note_frames.start.max(within.start)..note_frames.end.min(within.end);
        (!frames.is_empty()).then_some(frames)
    });
    let stroke = strokes.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end));
    PlacementAnchor {
        point,
        frames: placed.or(stroke).unwrap_or(stroke_frames),
        touch: None,
    }
}

impl PlacementAnchor {
    /// Returns the position of the point at that moment; for two hands the middle between them.
    pub(super) fn anchor_position(&self, work: &WorkingClip, sides: &[BodySide]) -> Option<DVec3> {
        if sides.len() > 1 {
            return body::mean_point(work, sides, self.point);
        }
        let point = |model: &_| body::hand_point(work, model, sides[0], self.point);
        body::mean_body_position(work, self.frames.clone(), point)
    }

    pub(super) fn describe_placement_anchor(&self, work: &WorkingClip) -> Option<String> {
        let touch = self.touch?;
        let touch_instant = work.rate.frame_start_instant(touch.frame);
        Some(format!(
            "the place is that of the contact at {touch_instant}: the {} at the {}",
            self.point.hand_point_name(),
            touch.place
        ))
    }
}
