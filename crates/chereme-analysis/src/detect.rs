//! Detectors, which find annotations in movement, behind one trait.
//!
//! A detector gets the movement and the face of a signer ([`ObservedSigner`]) and returns [`DetectedStretch`]s: a span, a tier, a
//! value, a confidence and the evidence. It stores nothing. The caller chooses the tiers and writes the detections with
//! the origin of a detector, so that the codings of people stay apart.
//!
//! To add one, write a module beside `detect_signs` with a type that implements [`AnnotationDetector`], and add it to [`ALL_DETECTORS`].
//! `chereme detect` and the window offer every detector of that list by its name and its words.

mod detect_nonmanuals;
mod detect_signs;

use crate::cut::UncutReason;
use crate::nonmanuals::ObservedFaceCurves;
use chereme_motion::{BodyAnatomy, Clip, RecordingInstant, TimeSpan};
use chereme_sign::ComponentField;
use chereme_sign::words::InterfaceText;
pub use detect_nonmanuals::NonmanualDetector;
pub use detect_signs::{SignDetector, UNKNOWN_GLOSS};

/// Every detector.
pub const ALL_DETECTORS: &[&dyn AnnotationDetector] = &[&NonmanualDetector, &SignDetector { sign_cost: None }];

/// Finds annotations in what was observed.
pub trait AnnotationDetector: Sync {
    /// Returns the name, such as `signs`.
    fn detector_name(&self) -> &'static str;

    /// Returns the words about the detector that people read.
    fn detector_description(&self) -> &'static DetectorDescription;

    /// Returns the parts of a signer that it examines; it finds nothing if all of them are missing.
    fn examines(&self) -> &'static [SignerPart];

    /// Returns the subjects that it may write about. A stored proposal does not name its detector, so no two detectors share a
    /// subject: the earlier proposals of its subjects are its own, and another run replaces them.
    fn detected_subjects(&self) -> Vec<DetectedSubject>;

    /// Returns the detections, subject by subject in order of time, without overlaps in a subject; empty if the parts that it
    /// examines were not observed.
    ///
    /// # Errors
    /// [`UncutReason`] if it can say why it finds nothing.
    fn detect_annotations(&self, observed: &ObservedSigner<'_>) -> Result<Vec<DetectedStretch>, UncutReason>;
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
#[derive(Debug, Clone, PartialEq)]
pub struct DetectedStretch {
    /// The time of the value on the recording's clock.
    pub span: TimeSpan,
    /// The subject, by which its tier is chosen.
    pub subject: DetectedSubject,
    /// The gloss of a sign, or the value of the field's inventory.
    pub value: String,
    /// The confidence, from 0 to 1.
    pub confidence: f64,
    /// The evidence, with its numbers.
    pub why: String,
}

/// What a detection is about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DetectedSubject {
    /// A sign, whose value is its gloss.
    Sign,
    /// A field, such as `right.movement.phase` or `nonmanual.brows`.
    Field(ComponentField),
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
    use crate::cut::tests::signed_clip;
    use chereme_sign::words::InterfaceLanguage;

    #[test]
    fn detectors_are_found_by_name_and_detect_nothing_without_input() {
        for detector in ALL_DETECTORS {
            let same = find_detector(detector.detector_name()).map(AnnotationDetector::detector_name);
            assert_eq!(same, Some(detector.detector_name()));
            let words = detector.detector_description();
            let found = words.finds.text_in_language(InterfaceLanguage::French);
            assert!(!found.starts_with("detector-"), "{found}");
            assert!(!detector.examines().is_empty());
            let detections = detector.detect_annotations(&ObservedSigner::default());
            assert_eq!(detections, Ok(Vec::new()), "{}", detector.detector_name());
        }
        assert!(find_detector("waves").is_none());
    }

    #[test]
    fn no_two_detectors_write_about_the_same_subject() {
        let mut all: Vec<DetectedSubject> = Vec::new();
        for detector in ALL_DETECTORS {
            let subjects = detector.detected_subjects();
            assert!(!subjects.is_empty(), "{}", detector.detector_name());
            for subject in subjects {
                assert!(!all.contains(&subject), "{subject:?}");
                all.push(subject);
            }
        }
    }

    #[test]
    fn every_detector_gives_spans_subjects_and_confidences() {
        let (clip, anatomy) = signed_clip(1, 1.0);
        let raised: Vec<f64> = (0..200)
            .map(|frame| if (50..100).contains(&frame) { 1.0 } else { 0.2 })
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
        for (name, start) in [("nonmanuals", 1.0), ("signs", 10.0)] {
            let detector = find_detector(name).expect(name);
            let detections = detector.detect_annotations(&observed).expect("detections");
            for pair in detections.windows(2) {
                let is_same = pair[0].subject == pair[1].subject;
                let is_before = pair[0].span.span_end_instant() <= pair[1].span.span_start_instant();
                assert!(!is_same || is_before, "{pair:?}");
            }
            let subjects = detector.detected_subjects();
            for detection in &detections {
                assert!(subjects.contains(&detection.subject), "{detection:?}");
                assert!(!detection.span.is_empty() && (0.0..=1.0).contains(&detection.confidence));
                assert!(detection.span.span_start_instant() >= RecordingInstant::from_seconds(start));
            }
            assert!(!detections.is_empty(), "{name}");
        }
    }
}
