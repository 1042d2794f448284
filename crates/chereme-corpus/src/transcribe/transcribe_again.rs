//! Re-synthesis of notation on the body of a recording that was generated from notation.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::num::NonZero;
use std::ops::Range;
use std::thread::{available_parallelism, scope};

use chereme_analysis::transcribe::{MOST_TRIALS, NotationSynthesiser};
use chereme_compose::notation::{AnimatorSettings, SignPerformer};
use chereme_compose::recipe::RecipeNode;
use chereme_compose::{MaterialInput, Recipe, RecipeInput};
use chereme_motion::{Clip, RecordingInstant};
use chereme_sign::hamnosys::{BodyLanguage, NotatedSign};
use rusqlite::Connection;
use serde::Deserialize;

use crate::address::{self, CorpusAddress, RecordingStretch};
use crate::db::stored_columns::{AnnotationOrigin, RecordOrigin};
use crate::db::{recipes, stored_tiers};
use crate::error::CorpusResult;
use crate::movement::MotionTrack;
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit};
use crate::recombine::{SOURCE_TIER_NAME, engine_version};
use crate::sources::floor::ground_body;
use crate::sources::standing_body_material;
use crate::starter::{OWN_BODY, own_body};

/// The number of postures that each processor synthesises between two reports of progress.
const POSTURES_PER_REPORT: usize = 8;

/// A body for re-synthesis of the notation that it performed.
pub(super) struct ResynthesisBody(SignPerformer);

/// Re-synthesis on all processors, with progress reports.
pub(super) struct ResynthesisProof<'a, 'p> {
    body: &'a SignPerformer,
    progress: RefCell<&'a mut ProgressReceiver<'p>>,
    done: Cell<usize>,
    stopped: Cell<bool>,
}

impl ResynthesisProof<'_, '_> {
    /// Reports that `more` postures were synthesised, and returns whether to go on.
    fn goes_on(&self, more: usize) -> bool {
        self.done.set(self.done.get() + more);
        let step = ProgressStep {
            task: "performing",
            done: self.done.get() as u64,
            total: Some(MOST_TRIALS.max(self.done.get()) as u64),
            unit: ProgressUnit::Items,
        };
        let stopped = self.stopped.get() || self.progress.borrow_mut().report_step(step).is_err();
        self.stopped.set(stopped);
        !stopped
    }

    /// Synthesises signs on all processors, each of them `at_once` between two reports of progress.
    fn on_all_processors(
        &self,
        signs: &[NotatedSign],
        at_once: usize,
        synthesises: impl Fn(&NotatedSign) -> Option<Clip> + Sync,
    ) -> Vec<Option<Clip>> {
        let threads = available_parallelism().map_or(1, NonZero::get);
        let (most, synthesises) = (at_once * threads, &synthesises);
        let mut all = vec![None; signs.len()];
        for (signs, clips) in signs.chunks(most).zip(all.chunks_mut(most)) {
            // A chunk is short enough that stopping takes effect soon.
            if !self.goes_on(signs.len()) {
                break;
            }
            let share = signs.len().div_ceil(threads);
            scope(|scope| {
                for (signs, clips) in signs.chunks(share).zip(clips.chunks_mut(share)) {
                    scope.spawn(move || {
                        for (sign, clip) in signs.iter().zip(clips) {
                            *clip = synthesises(sign);
                        }
                    });
                }
            });
        }
        all
    }

    /// Returns whether the work was asked to stop.
    pub(super) fn is_resynthesis_stopped(&self) -> bool {
        self.stopped.get()
    }
}

impl NotationSynthesiser for ResynthesisProof<'_, '_> {
    fn synthesise_first_posture(&self, sign: &NotatedSign) -> Option<Clip> {
        let goes_on = self.goes_on(1);
        goes_on.then(|| self.body.perform_first_posture(sign).ok()).flatten()
    }

    fn begin_all(&self, signs: &[NotatedSign]) -> Vec<Option<Clip>> {
        let body = self.body;
        self.on_all_processors(signs, POSTURES_PER_REPORT, |sign| body.perform_first_posture(sign).ok())
    }

    fn synthesise_notated_sign(&self, sign: &NotatedSign) -> Option<Clip> {
        let goes_on = self.goes_on(0);
        goes_on.then(|| self.body.perform_sign(sign).ok()).flatten()
    }

    fn perform_all(&self, signs: &[NotatedSign]) -> Vec<Option<Clip>> {
        let body = self.body;
        self.on_all_processors(signs, 1, |sign| body.perform_sign(sign).ok())
    }
}

impl ResynthesisBody {
    /// Returns the body for re-synthesis of a recording that was generated from notation alone, by this animator,
    /// if its body has not changed since; `None` for other recordings.
    pub(super) fn resynthesis_body_of(
        connection: &Connection,
        stretch: &RecordingStretch,
    ) -> CorpusResult<Option<Self>> {
        let recipe_row = recipes::find_recording_recipe(connection, stretch.recording.id)?;
        // Another version of the engine would perform the same notation differently.
        let made = recipe_row.filter(|row| row.engine == engine_version());
        let made = made.and_then(|row| serde_json::from_str::<GeneratedDocument>(&row.document).ok());
        let Some((language, body)) = made.as_ref().and_then(GeneratedDocument::notation_inputs) else {
            return Ok(None);
        };
        let stage = if body.address == OWN_BODY {
            own_body()?
        } else {
            let Ok(CorpusAddress::Recording(name)) = body.address.parse() else {
                return Ok(None);
            };
            let Ok(recording) = address::find_recording_by_name(connection, &name) else {
                return Ok(None);
            };
            // A body that hangs in the air performed on the floor, or earlier where it hangs.
            let stage = standing_body_material(connection, recording)?;
            match stage.hash == body.hash {
                true => stage,
                false => ground_body(stage)?,
            }
        };
        // A body that changed since cannot show what was performed on the old one.
        if stage.hash != body.hash {
            return Ok(None);
        }
        let settings = AnimatorSettings {
            rate: stage.clip.clip_frame_rate(),
            language,
        };
        Ok(SignPerformer::new(stage, settings).ok().map(Self))
    }

    /// Returns a re-synthesis that reports its progress to `progress`.
    pub(super) fn start_resynthesis<'a, 'p>(
        &'a self,
        progress: &'a mut ProgressReceiver<'p>,
    ) -> ResynthesisProof<'a, 'p> {
        ResynthesisProof {
            body: &self.0,
            progress: RefCell::new(progress),
            done: Cell::new(0),
            stopped: Cell::new(false),
        }
    }

    /// Returns the body language of the recording.
    pub(super) fn recording_body_language(&self) -> BodyLanguage {
        self.0.performer_settings().language.clone()
    }
}

/// The stored document of a generated recording: its recipe and inputs.
#[derive(Deserialize)]
struct GeneratedDocument {
    recipe: Recipe,
    inputs: BTreeMap<String, RecipeInput>,
}

impl GeneratedDocument {
    /// Returns the body language and the body of movement that was generated from notation alone.
    fn notation_inputs(&self) -> Option<(BodyLanguage, &MaterialInput)> {
        // Any further step may have changed what the notation says.
        let (RecipeNode::Hamnosys(_) | RecipeNode::Sigml(_)) = self.recipe.recipe_root() else {
            return None;
        };
        let body = self.inputs.values().find_map(|input| match input {
            RecipeInput::Material(body) => Some(body),
            _ => None,
        });
        let language_input = self.inputs.values().find_map(|input| match input {
            RecipeInput::Language(language) => Some(language.whole_body_language().ok()),
            _ => None,
        });
        Some((
            language_input.unwrap_or_else(|| Some(BodyLanguage::default_body_language().clone()))?,
            body?,
        ))
    }
}

/// Returns the frames of the one sign in a generated stretch, without the transitions from and to rest; `None` if
/// the stretch does not record them.
pub(super) fn generated_sign_frames(
    connection: &Connection,
    track: &MotionTrack,
    stretch: &RecordingStretch,
) -> CorpusResult<Option<Range<usize>>> {
    if stretch.recording.origin != RecordOrigin::Made {
        return Ok(None);
    }
    let tiers = stored_tiers::load_tier_rows(connection, stretch.recording.id)?;
    let Some(tier) = tiers.iter().find(|tier| tier.name == SOURCE_TIER_NAME) else {
        return Ok(None);
    };
    let [from, to] =
        [stretch.span.span_start_instant(), stretch.span.span_end_instant()].map(RecordingInstant::instant_micros);
    let mut sign_annotations = stored_tiers::annotations_near(connection, tier.id, from, to)?;
    sign_annotations.retain(|annotation| {
        annotation.origin == AnnotationOrigin::Made && annotation.start_us >= from && annotation.end_us <= to
    });
    // Several signs in the stretch have no common beginning and end.
    let [sign] = sign_annotations.as_slice() else {
        return Ok(None);
    };
    let frame = |at: i64| track.rate.nearest_frame_at(RecordingInstant::from_micros(at));
    Ok(Some(frame(sign.start_us)..frame(sign.end_us) + 1))
}
