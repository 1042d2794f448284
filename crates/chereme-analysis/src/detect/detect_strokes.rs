//! The detector of strokes of the hands.

use chereme_motion::BodySide;
use chereme_sign::words::InterfaceText;
use chereme_sign::{ComponentField, SignComponent};

use super::{AnnotationDetector, DetectedStretch, DetectorDescription, ObservedSigner, SignerPart};
use crate::strokes::{MovingPart, find_transition_strokes};

/// Detector of strokes of the wrists, between two minima of their speed: the phase `stroke` of a hand's movement.
#[derive(Debug, Clone, Copy)]
pub struct StrokeDetector;

/// The confidence of a stroke: minima of speed show that the wrist moves, but not whether it signs.
const STROKE_CONFIDENCE: f64 = 0.5;

impl AnnotationDetector for StrokeDetector {
    fn detector_name(&self) -> &'static str {
        "strokes"
    }

    fn detector_description(&self) -> &'static DetectorDescription {
        const STROKE_DESCRIPTION: DetectorDescription = DetectorDescription {
            finds: InterfaceText::new(
                "strokes of each wrist, between two minima of its speed",
                "mouvements utiles (strokes) de chaque poignet, entre deux minimums de sa vitesse",
            ),
            messages: &[InterfaceText::new(
                "the wrist moves between two minima of its speed",
                "le poignet bouge entre deux minimums de sa vitesse",
            )],
        };
        &STROKE_DESCRIPTION
    }

    fn examines(&self) -> &'static [SignerPart] {
        &[SignerPart::Arms]
    }

    fn detected_fields(&self) -> Vec<ComponentField> {
        BodySide::BOTH_SIDES.map(stroke_field).to_vec()
    }

    fn detect_annotations(&self, observed: &ObservedSigner<'_>) -> Vec<DetectedStretch> {
        let Some(body) = observed.body else {
            return Vec::new();
        };
        let of = |side: BodySide| {
            let stroke_frames = find_transition_strokes(body.clip, body.anatomy, side, MovingPart::Wrist).into_iter();
            // A stroke begins with the posture in which the one before it ends, so its last frame is not in its span.
            let times = stroke_frames.map(|frames| {
                body.clip
                    .clip_frame_rate()
                    .frame_range_span(frames.start..frames.end - 1)
            });
            times.map(move |span| DetectedStretch {
                span: span.shifted_span(body.start.instant_micros()),
                field: stroke_field(side),
                value: "stroke".to_owned(),
                confidence: STROKE_CONFIDENCE,
                why: "the wrist moves between two minima of its speed".to_owned(),
            })
        };
        BodySide::BOTH_SIDES.into_iter().flat_map(of).collect()
    }
}

/// Returns the field of the strokes of a side.
fn stroke_field(side: BodySide) -> ComponentField {
    ComponentField::new(SignComponent::Movement)
        .with_field_feature("phase")
        .with_field_hand(side)
}
