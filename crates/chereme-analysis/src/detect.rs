//! Detectors, which find annotations in movement, behind one trait.
//!
//! A detector gets the movement and the face of a signer ([`ObservedSigner`]) and returns [`DetectedStretch`]s: a span, a field, a
//! value, a confidence and the evidence. It stores nothing. The caller chooses the tiers and writes the detections with
//! the origin of a detector, so that the codings of people stay apart.
//!
//! To add one, write a module beside `strokes` with a type that implements [`AnnotationDetector`], and add it to [`ALL_DETECTORS`].
//! `chereme propose --detector` and the window offer every detector of that list by its name and its words.

mod detect_nonmanuals;
mod detect_strokes;

use chereme_motion::{BodyAnatomy, Clip, RecordingInstant, TimeSpan};
use chereme_sign::ComponentField;
use chereme_sign::words::InterfaceText;
use serde::Serialize;

use crate::nonmanuals::ObservedFaceCurves;
pub use detect_nonmanuals::NonmanualDetector;
pub use detect_strokes::StrokeDetector;

/// Every detector.
pub const ALL_DETECTORS: &[&dyn AnnotationDetector] = &[&NonmanualDetector, &StrokeDetector];

/// Finds annotations in what was observed.
pub trait AnnotationDetector: Sync {
    /// Returns the name, such as `strokes`.
    fn detector_name(&self) -> &'static str;

    /// Returns the words about the detector that people read.
    fn detector_description(&self) -> &'static DetectorDescription;

    /// Returns the parts of a signer that it examines; it finds nothing if all of them are missing.
    fn examines(&self) -> &'static [SignerPart];

    /// Returns the fields that it may write. A stored proposal does not name its detector, so no two detectors write the
    /// same field: the earlier proposals of its fields are its own, and another run replaces them.
    fn detected_fields(&self) -> Vec<ComponentField>;

    /// Returns the detections, field by field in order of time, without overlaps in a field; empty if the parts that it
    /// examines were not observed.
    fn detect_annotations(&self, observed: &ObservedSigner<'_>) -> Vec<DetectedStretch>;
}

/// The words about a detector, in English and French.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DetectorDescription {
    /// The annotations that it finds, for a list of detectors.
    pub finds: InterfaceText,
    /// The sentences of its evidence; `{name}` stands for a variable part. A sentence that is contained in another comes
    /// after it.
    pub messages: &'static [InterfaceText],
}

/// A part of a signer that detectors examine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SignerPart {
    /// The movement of the whole body and the hands.
    Body,
    /// The movement of the arms, from the collar bones to the wrists; all other joints of the observed clip may be at rest.
    Arms,
    /// The curves of face and head.
    Face,
}

/// The observed movement and face of a signer; a missing part is `None`.
#[derive(Debug, Clone, Copy, Default)]
pub struct ObservedSigner<'a> {
    /// The movement of the body.
    pub body: Option<ObservedBody<'a>>,
    /// The curves of the face, from the start of the recording.
    pub face: Option<ObservedFaceCurves<'a>>,
}

/// The observed movement of a body.
#[derive(Debug, Clone, Copy)]
pub struct ObservedBody<'a> {
    /// The movement.
    pub clip: &'a Clip,
    /// The body parts of its joints.
    pub anatomy: &'a BodyAnatomy,
    /// The time of the first frame on the recording's clock.
    pub start: RecordingInstant,
}

/// A stretch of movement in which a value was detected.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DetectedStretch {
    /// The time of the value on the recording's clock.
    pub span: TimeSpan,
    /// The field, such as `right.movement.phase` or `nonmanual.brows`.
    pub field: ComponentField,
    /// The value of the field's inventory.
    pub value: String,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
    /// The evidence, with its numbers.
    pub why: String,
}

/// Returns the detector of that name.
#[must_use]
pub fn find_detector(name: &str) -> Option<&'static dyn AnnotationDetector> {
    ALL_DETECTORS
        .iter()
        .copied()
        .find(|detector| detector.detector_name() == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strokes::tests::bending;

    #[test]
    fn detectors_are_found_by_name_and_detect_nothing_without_input() {
        for it in ALL_DETECTORS {
            let found = find_detector(it.detector_name()).map(AnnotationDetector::detector_name);
            assert_eq!(found, Some(it.detector_name()));
            let words = it.detector_description();
            assert!(!words.finds.en.is_empty() && !words.finds.fr.is_empty());
            assert!(!it.examines().is_empty());
            assert!(
                it.detect_annotations(&ObservedSigner::default()).is_empty(),
                "{}",
                it.detector_name()
            );
        }
        assert!(find_detector("signs").is_none());
    }

    #[test]
    fn no_two_detectors_write_the_same_field() {
        let mut all: Vec<String> = Vec::new();
        for it in ALL_DETECTORS {
            let own = it.detected_fields();
            assert!(!own.is_empty(), "{}", it.detector_name());
            all.extend(own.iter().map(ToString::to_string));
        }
        let count = all.len();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), count, "{all:?}");
    }

    #[test]
    fn every_detector_gives_spans_fields_and_confidences() {
        let step = |s: f64| s.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * s.clamp(0.0, 1.0));
        let (clip, anatomy) = bending(|t| step(2.0 * t - 1.0) - step(2.0 * t - 3.0));
        let raised: Vec<f64> = (0..200)
            .map(|n| if (50..100).contains(&n) { 1.0 } else { 0.2 })
            .collect();
        let observed = ObservedSigner {
            body: Some(ObservedBody {
                clip: &clip,
                anatomy: &anatomy,
                start: RecordingInstant::from_seconds(10.0),
            }),
            face: Some(ObservedFaceCurves {
                rate: 50.0,
                brow_raise: [Some(&raised), Some(&raised)],
                ..ObservedFaceCurves::default()
            }),
        };
        for (name, field, count) in [
            ("nonmanuals", "nonmanual.brows", 1),
            ("strokes", "right.movement.phase", 2),
        ] {
            let found = find_detector(name).expect(name).detect_annotations(&observed);
            assert_eq!(found.len(), count, "{found:?}");
            for pair in found.windows(2) {
                assert!(
                    pair[0].span.span_end_instant() <= pair[1].span.span_start_instant(),
                    "{pair:?}"
                );
            }
            let own = find_detector(name).expect(name).detected_fields();
            for it in &found {
                assert_eq!(it.field.to_string(), field);
                assert!(own.contains(&it.field), "{it:?}");
                assert!(!it.span.is_empty() && (0.0..=1.0).contains(&it.confidence));
            }
        }
        let hands = StrokeDetector.detect_annotations(&observed);
        assert!(hands[0].span.span_start_instant() >= RecordingInstant::from_seconds(10.0));
        let brows = NonmanualDetector.detect_annotations(&observed);
        assert_eq!(brows[0].span.span_start_instant(), RecordingInstant::from_seconds(1.0));
        assert_eq!(brows[0].span.span_end_instant(), RecordingInstant::from_seconds(2.0));
    }
}
