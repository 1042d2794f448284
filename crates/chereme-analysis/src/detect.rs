//! Detectors, which find annotations in movement, behind one trait.
//!
//! A detector gets the movement and the face of a signer ([`Observed`]) and returns [`Detection`]s: a span, a field, a
//! value, a confidence and the evidence. It stores nothing. The caller chooses the tiers and writes the detections with
//! the origin of a detector, so that the codings of people stay apart.
//!
//! To add one, write a module with a type that implements [`Detector`], and add it to [`DETECTORS`]. No command runs
//! that list yet: callers name the detector that they need.

use chereme_motion::{Anatomy, Clip, Instant, Side, Span};
use chereme_sign::{Component, Field};
use serde::Serialize;

use crate::nonmanuals::{Curves, proposals};
use crate::strokes::{Mover, strokes};

/// Every detector.
pub const DETECTORS: &[&dyn Detector] = &[&Nonmanuals, &Strokes];

/// Finds annotations in what was observed.
pub trait Detector: Sync {
    /// Returns the name, such as `strokes`.
    fn name(&self) -> &'static str;

    /// Returns the detections, field by field in order of time; empty if the part that it examines was not observed.
    fn detect(&self, observed: &Observed<'_>) -> Vec<Detection>;
}

/// The observed movement and face of a signer; a missing part is `None`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Observed<'a> {
    /// The movement of the body, and the body parts of its joints.
    pub body: Option<(&'a Clip, &'a Anatomy)>,
    /// The curves of the face.
    pub face: Option<Curves<'a>>,
}

/// A stretch of movement in which a value was detected.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Detection {
    /// The time of the value, counted from the first observed frame.
    pub span: Span,
    /// The field, such as `right.movement.phase` or `nonmanual.brows`.
    pub field: Field,
    /// The value of the field's inventory.
    pub value: String,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
    /// The evidence, with its numbers.
    pub why: String,
}

/// Returns the detector of that name.
#[must_use]
pub fn detector(name: &str) -> Option<&'static dyn Detector> {
    DETECTORS.iter().copied().find(|it| it.name() == name)
}

/// Detector of actions of brows, lids, gaze, mouth and head, by the rules of [`nonmanuals`](crate::nonmanuals).
#[derive(Debug, Clone, Copy)]
pub struct Nonmanuals;

impl Detector for Nonmanuals {
    fn name(&self) -> &'static str {
        "nonmanuals"
    }

    fn detect(&self, observed: &Observed<'_>) -> Vec<Detection> {
        let Some(curves) = &observed.face else {
            return Vec::new();
        };
        let at = |frame: usize| Instant::from_seconds(frame as f64 / curves.rate);
        let found = proposals(curves).into_iter();
        found
            .map(|it| Detection {
                span: Span::between(at(it.frames.start), at(it.frames.end)),
                field: Field::new(Component::NonManual).of(it.feature),
                value: it.value.to_owned(),
                confidence: it.confidence,
                why: it.why,
            })
            .collect()
    }
}

/// Detector of strokes of the wrists, between two minima of their speed: the phase `stroke` of a hand's movement.
#[derive(Debug, Clone, Copy)]
pub struct Strokes;

/// The confidence of a stroke: minima of speed show that the wrist moves, but not whether it signs.
const STROKE: f64 = 0.5;

impl Detector for Strokes {
    fn name(&self) -> &'static str {
        "strokes"
    }

    fn detect(&self, observed: &Observed<'_>) -> Vec<Detection> {
        let Some((clip, anatomy)) = observed.body else {
            return Vec::new();
        };
        let of = |side: Side| {
            let found = strokes(clip, anatomy, side, Mover::Wrist).into_iter();
            found.map(move |frames| Detection {
                span: clip.rate().span(frames),
                field: Field::new(Component::Movement).of("phase").on(side),
                value: "stroke".to_owned(),
                confidence: STROKE,
                why: "the wrist moves between two minima of its speed".to_owned(),
            })
        };
        Side::BOTH.into_iter().flat_map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strokes::tests::bending;

    #[test]
    fn detectors_are_found_by_name_and_detect_nothing_without_input() {
        for it in DETECTORS {
            let found = detector(it.name()).map(Detector::name);
            assert_eq!(found, Some(it.name()));
            assert!(it.detect(&Observed::default()).is_empty(), "{}", it.name());
        }
        assert!(detector("signs").is_none());
    }

    #[test]
    fn every_detector_gives_spans_fields_and_confidences() {
        let step = |s: f64| s.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * s.clamp(0.0, 1.0));
        let (clip, anatomy) = bending(|t| step(2.0 * t - 1.0) - step(2.0 * t - 3.0));
        let raised: Vec<f64> = (0..200)
            .map(|n| if (50..100).contains(&n) { 1.0 } else { 0.2 })
            .collect();
        let observed = Observed {
            body: Some((&clip, &anatomy)),
            face: Some(Curves {
                rate: 50.0,
                brow_raise: [Some(&raised), Some(&raised)],
                ..Curves::default()
            }),
        };
        for (name, field, count) in [
            ("nonmanuals", "nonmanual.brows", 1),
            ("strokes", "right.movement.phase", 2),
        ] {
            let found = detector(name).expect(name).detect(&observed);
            assert_eq!(found.len(), count, "{found:?}");
            for it in &found {
                assert_eq!(it.field.to_string(), field);
                assert!(!it.span.is_empty() && (0.0..=1.0).contains(&it.confidence));
            }
        }
        let brows = Nonmanuals.detect(&observed);
        assert_eq!(brows[0].span.start(), Instant::from_seconds(1.0));
        assert_eq!(brows[0].span.end(), Instant::from_seconds(2.0));
    }
}
