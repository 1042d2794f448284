//! Cued speech as a source of a recipe: its questions to the corpus, and its movement.

use chereme_motion::Side;
use chereme_sign::Component;

use super::{CuePhases, PhaseRule, cue, read};
use crate::answers::{Ask, Given, Setting, Slot};
use crate::error::Cause;
use crate::ops::Done;
use crate::poses::{self, HandPose};
use crate::recipe::Cue;
use crate::resolve::MaterialInput;
use crate::sources::{Meaning, Value};
use crate::work::Work;

/// The body that cues.
pub(crate) const BODY: Slot<MaterialInput> = Slot::new("cue");
/// The postures of the code's shapes; the resting hand's comes first.
const SHAPES: Slot<Vec<HandPose>> = Slot::new("cue/shapes");
/// The phases measured in the corpus.
const PHASES: Slot<CuePhases> = Slot::new("cue/by");

/// Asks for the body, the shapes of the code and, if the recipe wants them, the measured phases.
pub(crate) fn resolve(settings: &Cue, ask: &mut Ask<'_>) -> Result<Setting, Cause> {
    let read = read(settings)?;
    let setting = ask.body(&BODY, settings.on.as_deref())?;
    let side = settings.hand.sides(setting.handedness)[0];
    let own = read.code.shapes.iter().map(|shape| &shape.configuration);
    let mut shapes = Vec::new();
    for name in std::iter::once(&read.code.rest.configuration).chain(own) {
        let value = ask.sources.value(Component::Configuration, name)?;
        shapes.push(shape(ask, &value, side, &setting)?);
    }
    ask.put(&SHAPES, shapes);
    if settings.phase == PhaseRule::Measured {
        let phases = ask.sources.cue_phases()?.ok_or(Cause::NoPhases)?;
        ask.put(&PHASES, phases);
    }
    Ok(setting)
}

/// Returns the posture of a shape of cued speech: the inventory's own, because every cuer learns the same charts; a
/// captured one if the inventory has none.
fn shape(ask: &Ask<'_>, value: &Value, side: Side, setting: &Setting) -> Result<HandPose, Cause> {
    match &value.meaning {
        Some(Meaning::Hand(angles)) => Ok(HandPose {
            value: Some(value.id.clone()),
            origin: poses::PoseOrigin::Inventory(value.inventory.clone()),
            angles: *angles,
            exact: None,
        }),
        Some(Meaning::Place(_)) | None => poses::of_value(ask.sources, value, side, setting),
    }
}

/// Generates cued speech.
pub(crate) fn generate(settings: &Cue, given: &mut Given<'_>) -> Result<(Work, Done), Cause> {
    let mut work = Work::of(given.material(&BODY)?);
    let poses = given.need(&SHAPES)?;
    let read = read(settings)?;
    let numbers = std::iter::once(read.code.rest.number)
        .chain(read.code.shapes.iter().map(|shape| shape.number));
    let shapes: Vec<(u8, HandPose)> = numbers.zip(poses.iter().cloned()).collect();
    let measured = given.get(&PHASES).copied().unwrap_or_default();
    let done = cue(&mut work, settings, &shapes, &measured)?;
    let warnings = done.warnings.iter().map(|it| format!("cue: {it}"));
    let warnings = warnings.collect();
    Ok((
        work,
        Done {
            warnings,
            ..(done.did, done.residual).into()
        },
    ))
}
