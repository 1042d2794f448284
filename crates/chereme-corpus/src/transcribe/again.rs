//! Re-synthesis of notation on the body of a recording that was generated from notation.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::num::NonZero;
use std::ops::Range;
use std::thread::{available_parallelism, scope};

use chereme_analysis::transcribe::{MOST_TRIALS, Performs};
use chereme_compose::notation::{Performer, Settings};
use chereme_compose::recipe::Node;
use chereme_compose::{Input, MaterialInput, Recipe};
use chereme_motion::{Clip, Instant};
use chereme_sign::hamnosys::{BodyLanguage, Notated};
use rusqlite::Connection;
use serde::Deserialize;

use crate::address::{self, Address, Stretch};
use crate::db::columns::{AnnotationOrigin, Origin};
use crate::db::{recipes, tiers};
use crate::error::Result;
use crate::movement::MotionTrack;
use crate::progress::{Progress, Step, Unit};
use crate::recombine::{SOURCE, engine};
use crate::sources::floor::grounded;
use crate::sources::notation::{OWN_BODY, own_body};
use crate::sources::standing;

/// The number of postures that each processor synthesises between two reports of progress.
const AT_ONCE: usize = 8;

/// A body for re-synthesis of the notation that it performed.
pub(super) struct Again(Performer);

/// Re-synthesis on all processors, with progress reports.
pub(super) struct Proving<'a, 'p> {
    body: &'a Performer,
    progress: RefCell<&'a mut Progress<'p>>,
    done: Cell<usize>,
    stopped: Cell<bool>,
}

impl Proving<'_, '_> {
    /// Reports that `more` postures were synthesised, and returns whether to go on.
    fn goes_on(&self, more: usize) -> bool {
        self.done.set(self.done.get() + more);
        let step = Step {
            task: "performing",
            done: self.done.get() as u64,
            total: Some(MOST_TRIALS.max(self.done.get()) as u64),
            unit: Unit::Items,
        };
        let stopped = self.stopped.get() || self.progress.borrow_mut().report(step).is_err();
        self.stopped.set(stopped);
        !stopped
    }

    /// Synthesises signs on all processors, each of them `at_once` between two reports of progress.
    fn on_all_processors(
        &self,
        signs: &[Notated],
        at_once: usize,
        synthesises: impl Fn(&Notated) -> Option<Clip> + Sync,
    ) -> Vec<Option<Clip>> {
        let threads = available_parallelism().map_or(1, NonZero::get);
        let (most, synthesises) = (at_once * threads, &synthesises);
        let mut all = vec![None; signs.len()];
        for (signs, clips) in signs.chunks(most).zip(all.chunks_mut(most)) {
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
    pub(super) fn stopped(&self) -> bool {
        self.stopped.get()
    }
}

impl Performs for Proving<'_, '_> {
    fn begins(&self, sign: &Notated) -> Option<Clip> {
        let goes_on = self.goes_on(1);
        goes_on.then(|| self.body.begins(sign).ok()).flatten()
    }

    fn begin_all(&self, signs: &[Notated]) -> Vec<Option<Clip>> {
        let body = self.body;
        self.on_all_processors(signs, AT_ONCE, |sign| body.begins(sign).ok())
    }

    fn performs(&self, sign: &Notated) -> Option<Clip> {
        let goes_on = self.goes_on(0);
        goes_on.then(|| self.body.performs(sign).ok()).flatten()
    }

    fn perform_all(&self, signs: &[Notated]) -> Vec<Option<Clip>> {
        let body = self.body;
        self.on_all_processors(signs, 1, |sign| body.performs(sign).ok())
    }
}

impl Again {
    /// Returns the body for re-synthesis of a recording that was generated from notation alone, by this animator,
    /// if its body has not changed since; `None` for other recordings.
    pub(super) fn of(connection: &Connection, stretch: &Stretch) -> Result<Option<Self>> {
        let made = recipes::of_recording(connection, stretch.recording.id)?;
        let made = made.filter(|row| row.engine == engine());
        let made = made.and_then(|row| serde_json::from_str::<Document>(&row.document).ok());
        let Some((language, body)) = made.as_ref().and_then(Document::notation) else {
            return Ok(None);
        };
        let stage = if body.address == OWN_BODY {
            own_body()?
        } else {
            let Ok(Address::Recording(name)) = body.address.parse() else {
                return Ok(None);
            };
            let Ok(recording) = address::recording(connection, &name) else {
                return Ok(None);
            };
            // A body that hangs in the air performed on the floor, or earlier where it hangs.
            let stage = standing(connection, recording)?;
            match stage.hash == body.hash {
                true => stage,
                false => grounded(stage)?,
            }
        };
        if stage.hash != body.hash {
            return Ok(None);
        }
        let settings = Settings {
            rate: stage.clip.rate(),
            language,
        };
        Ok(Performer::new(stage, settings).ok().map(Self))
    }

    /// Returns a re-synthesis that reports its progress to `progress`.
    pub(super) fn proving<'a, 'p>(&'a self, progress: &'a mut Progress<'p>) -> Proving<'a, 'p> {
        Proving {
            body: &self.0,
            progress: RefCell::new(progress),
            done: Cell::new(0),
            stopped: Cell::new(false),
        }
    }

    /// Returns the body language of the recording.
    pub(super) fn language(&self) -> BodyLanguage {
        self.0.settings().language.clone()
    }
}

/// The stored document of a generated recording: its recipe and inputs.
#[derive(Deserialize)]
struct Document {
    recipe: Recipe,
    inputs: BTreeMap<String, Input>,
}

impl Document {
    /// Returns the body language and the body of movement that was generated from notation alone.
    fn notation(&self) -> Option<(BodyLanguage, &MaterialInput)> {
        let (Node::Hamnosys(_) | Node::Sigml(_)) = self.recipe.root() else {
            return None;
        };
        let body = self.inputs.values().find_map(|input| match input {
            Input::Material(body) => Some(body),
            _ => None,
        });
        let own = self.inputs.values().find_map(|input| match input {
            Input::Language(language) => Some(language.whole().ok()),
            _ => None,
        });
        Some((
            own.unwrap_or_else(|| Some(BodyLanguage::usual().clone()))?,
            body?,
        ))
    }
}

/// Returns the frames of the one sign in a generated stretch, without the transitions from and to rest; `None` if
/// the stretch does not record them.
pub(super) fn signed(
    connection: &Connection,
    track: &MotionTrack,
    stretch: &Stretch,
) -> Result<Option<Range<usize>>> {
    if stretch.recording.origin != Origin::Made {
        return Ok(None);
    }
    let tiers = tiers::tiers(connection, stretch.recording.id)?;
    let Some(tier) = tiers.iter().find(|tier| tier.name == SOURCE) else {
        return Ok(None);
    };
    let [from, to] = [stretch.span.start(), stretch.span.end()].map(Instant::micros);
    let mut said = tiers::annotations_near(connection, tier.id, from, to)?;
    said.retain(|it| it.origin == AnnotationOrigin::Made && it.start_us >= from && it.end_us <= to);
    let [sign] = said.as_slice() else {
        return Ok(None);
    };
    let frame = |at: i64| track.rate.frame_at(Instant::from_micros(at));
    Ok(Some(frame(sign.start_us)..frame(sign.end_us) + 1))
}
