//! The detector of signs, and of the phases of each hand.

use chereme_motion::BodySide;
use chereme_sign::words::{InterfaceLanguage, InterfaceText};
use chereme_sign::{ComponentField, SignComponent};

use super::{AnnotationDetector, DetectedStretch, DetectedSubject, DetectorDescription, ObservedSigner, SignerPart};
use crate::cut::{CutOptions, CutRule, TakeCut, UncutReason, cut_take};

/// The value of a sign that nobody has glossed; a question mark would be no value.
pub const UNKNOWN_GLOSS: &str = "UNGLOSSED";

/// Detector of signs between and within activities, and of each hand's preparation, stroke, hold and retraction, by the
/// rules of [`cut`](crate::cut).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SignDetector {
    /// The cost of a sign, if not the usual one: a larger one gives fewer signs.
    pub sign_cost: Option<f64>,
}

const PEELED_SIGN_TEXT: InterfaceText = InterfaceText::from_id("detector-signs-peeled");
const PEELED_BY_BOTH_TEXT: InterfaceText = InterfaceText::from_id("detector-signs-peeled-by-both");
const DECODED_SIGN_TEXT: InterfaceText = InterfaceText::from_id("detector-signs-decoded");
const DECODED_BY_BOTH_TEXT: InterfaceText = InterfaceText::from_id("detector-signs-decoded-by-both");
const SIGN_PHASE_TEXT: InterfaceText = InterfaceText::from_id("detector-signs-phase");

impl AnnotationDetector for SignDetector {
    fn detector_name(&self) -> &'static str {
        "signs"
    }

    fn detector_description(&self) -> &'static DetectorDescription {
        const SIGN_DESCRIPTION: DetectorDescription = DetectorDescription {
            finds: InterfaceText::from_id("detector-signs-finds"),
            messages: &[
                DECODED_BY_BOTH_TEXT,
                DECODED_SIGN_TEXT,
                PEELED_BY_BOTH_TEXT,
                PEELED_SIGN_TEXT,
                SIGN_PHASE_TEXT,
            ],
        };
        &SIGN_DESCRIPTION
    }

    fn examines(&self) -> &'static [SignerPart] {
        &[SignerPart::Body]
    }

    fn detected_subjects(&self) -> Vec<DetectedSubject> {
        let phases = BodySide::BOTH_SIDES.map(|side| DetectedSubject::Field(phase_field(side)));
        [DetectedSubject::Sign].into_iter().chain(phases).collect()
    }

    fn detect_annotations(&self, observed: &ObservedSigner<'_>) -> Result<Vec<DetectedStretch>, UncutReason> {
        let Some(body) = observed.body else {
            return Ok(Vec::new());
        };
        let options = self
            .sign_cost
            .map_or_else(CutOptions::default, |sign_cost| CutOptions { sign_cost });
        let TakeCut { signs, phases } = cut_take(body.clip, body.anatomy, options)?;
        let start = body.start.instant_micros();
        let mut stretches = Vec::new();
        for sign in signs {
            let why = match (sign.rule, sign.is_two_handed) {
                (CutRule::Peeled, false) => PEELED_SIGN_TEXT,
                (CutRule::Peeled, true) => PEELED_BY_BOTH_TEXT,
                (CutRule::Decoded, false) => DECODED_SIGN_TEXT,
                (CutRule::Decoded, true) => DECODED_BY_BOTH_TEXT,
            };
            stretches.push(DetectedStretch {
                span: sign.span.shifted_span(start),
                subject: DetectedSubject::Sign,
                value: UNKNOWN_GLOSS.to_owned(),
                confidence: sign.confidence,
                why: why
                    .text_in_language(InterfaceLanguage::English)
                    .replace("{side}", sign.dominant.body_side_name()),
            });
        }
        for (side, hand_phases) in BodySide::BOTH_SIDES.into_iter().zip(phases) {
            stretches.extend(hand_phases.into_iter().map(|phase| DetectedStretch {
                span: phase.span.shifted_span(start),
                subject: DetectedSubject::Field(phase_field(side)),
                value: phase.kind.phase_name().to_owned(),
                confidence: phase.confidence,
                why: SIGN_PHASE_TEXT.text_in_language(InterfaceLanguage::English).to_owned(),
            }));
        }
        Ok(stretches)
    }
}

/// Returns the field of the phases of a side.
fn phase_field(side: BodySide) -> ComponentField {
    ComponentField::new(SignComponent::Movement)
        .with_field_feature("phase")
        .with_field_hand(side)
}
