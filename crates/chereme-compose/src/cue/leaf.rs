//! Cued speech as a source of a recipe: its questions to the corpus, and its movement.

use chereme_motion::BodySide;
use chereme_sign::SignComponent;

use super::{CuePhases, PhaseRule, perform_cues, read_cue_utterance};
use crate::answers::{AnswerSlot, CorpusAsker, NodeAnswers};
use crate::error::StepError;
use crate::ops::StepOutcome;
use crate::poses::{self, HandPose};
use crate::recipe_inputs::MaterialInput;
use crate::recipe_settings::CueSettings;
use crate::sources::{ComponentValue, MaterialSigner, ValueMeaning};
use crate::work::WorkingClip;

/// The body that cues.
pub(crate) const CUE_BODY_SLOT: AnswerSlot<MaterialInput> = AnswerSlot::new("cue");
/// The postures of the code's shapes; the resting hand's comes first.
const CUE_SHAPES_SLOT: AnswerSlot<Vec<HandPose>> = AnswerSlot::new("cue/shapes");
/// The phases measured in the corpus.
const CUE_PHASES_SLOT: AnswerSlot<CuePhases> = AnswerSlot::new("cue/by");

/// Asks for the body, the shapes of the code and, if the recipe wants them, the measured phases.
pub(crate) fn resolve_cue_inputs(
    settings: &CueSettings,
    ask: &mut CorpusAsker<'_>,
) -> Result<MaterialSigner, StepError> {
    let read = read_cue_utterance(settings)?;
    let setting = ask.ask_signer_body(&CUE_BODY_SLOT, settings.on.as_deref())?;
    let side = settings.hand.chosen_sides(setting.handedness)[0];
    let shape_names = read.code.shapes.iter().map(|shape| &shape.configuration);
    let mut shapes = Vec::new();
    for name in std::iter::once(&read.code.rest.configuration).chain(shape_names) {
        let value = ask.sources.find_component_value(SignComponent::Configuration, name)?;
        shapes.push(cue_shape_posture(ask, &value, side, &setting)?);
    }
    ask.put_answer(&CUE_SHAPES_SLOT, shapes);
    if settings.phase == PhaseRule::Measured {
        let phases = ask.sources.cue_phases()?.ok_or(StepError::NoPhases)?;
        ask.put_answer(&CUE_PHASES_SLOT, phases);
    }
    Ok(setting)
}

/// Returns the posture of a shape of cued speech: the inventory's own, because every cuer learns the same charts; a
/// captured one if the inventory has none.
fn cue_shape_posture(
    ask: &CorpusAsker<'_>,
    value: &ComponentValue,
    side: BodySide,
    setting: &MaterialSigner,
) -> Result<HandPose, StepError> {
    match &value.meaning {
        Some(ValueMeaning::Hand(angles)) => Ok(HandPose {
            value: Some(value.id.clone()),
            origin: poses::PoseOrigin::Inventory(value.inventory.clone()),
            angles: *angles,
            exact: None,
            coding: None,
        }),
        Some(ValueMeaning::Place(_)) | None => poses::of_value(ask.sources, value, side, setting),
    }
}

/// Generates cued speech.
pub(crate) fn generate_cue_movement(
    settings: &CueSettings,
    given: &mut NodeAnswers<'_>,
) -> Result<(WorkingClip, StepOutcome), StepError> {
    let mut work = WorkingClip::working_clip_from(given.answered_material(&CUE_BODY_SLOT)?);
    let poses = given.required_answer(&CUE_SHAPES_SLOT)?;
    let read = read_cue_utterance(settings)?;
    let numbers = std::iter::once(read.code.rest.number).chain(read.code.shapes.iter().map(|shape| shape.number));
    let shapes: Vec<(u8, HandPose)> = numbers.zip(poses.iter().cloned()).collect();
    let measured = given.get_answer(&CUE_PHASES_SLOT).copied().unwrap_or_default();
    let done = perform_cues(&mut work, settings, &shapes, &measured)?;
    let warning_texts = done.warnings.iter().map(|warning| format!("cue: {warning}"));
    let warnings = warning_texts.collect();
    Ok((
        work,
        StepOutcome {
            warnings,
            ..StepOutcome::with_residual(done.did, done.residual)
        },
    ))
}
