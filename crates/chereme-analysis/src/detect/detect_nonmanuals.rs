//! The detector of actions of face and head.

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::words::InterfaceText;
use chereme_sign::{ComponentField, SignComponent};

use super::{AnnotationDetector, DetectedStretch, DetectedSubject, DetectorDescription, ObservedSigner, SignerPart};
use crate::cut::UncutReason;
use crate::nonmanuals::{PROPOSED_FACE_FEATURES, propose_face_actions};

/// Detector of actions of brows, lids, gaze, mouth and head, by the rules of [`nonmanuals`](crate::nonmanuals).
#[derive(Debug, Clone, Copy)]
pub struct NonmanualDetector;

impl AnnotationDetector for NonmanualDetector {
    fn detector_name(&self) -> &'static str {
        "nonmanuals"
    }

    fn detector_description(&self) -> &'static DetectorDescription {
        const NONMANUAL_DESCRIPTION: DetectorDescription = DetectorDescription {
            finds: InterfaceText::from_id("detector-nonmanuals-finds"),
            messages: &[
                InterfaceText::from_id("detector-nonmanuals-shorter"),
                InterfaceText::from_id("detector-nonmanuals-above"),
                InterfaceText::from_id("detector-nonmanuals-swings"),
            ],
        };
        &NONMANUAL_DESCRIPTION
    }

    fn examines(&self) -> &'static [SignerPart] {
        &[SignerPart::Face]
    }

    fn detected_subjects(&self) -> Vec<DetectedSubject> {
        PROPOSED_FACE_FEATURES.map(nonmanual_subject).to_vec()
    }

    fn detect_annotations(&self, observed: &ObservedSigner<'_>) -> Result<Vec<DetectedStretch>, UncutReason> {
        let Some(curves) = &observed.face else {
            return Ok(Vec::new());
        };
        let frame_instant = |frame: usize| RecordingInstant::from_seconds(frame as f64 / curves.rate);
        let raw_proposals = propose_face_actions(curves).into_iter();
        let detections = raw_proposals.map(|proposal| DetectedStretch {
            span: TimeSpan::span_between(frame_instant(proposal.frames.start), frame_instant(proposal.frames.end)),
            subject: nonmanual_subject(proposal.feature),
            value: proposal.value.to_owned(),
            confidence: proposal.confidence,
            why: proposal.why,
        });
        Ok(detections.collect())
    }
}

/// Returns the subject of a part of face or head.
fn nonmanual_subject(feature: &str) -> DetectedSubject {
    DetectedSubject::Field(ComponentField::new(SignComponent::NonManual).with_field_feature(feature))
}
