//! Jobs that load movement, for the stage, for measurement and for little figures.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::{ChannelGroup, Corpus, CorpusAddress, CorpusResult, DisplayedMovement, MadePart, RowName};
use chereme_motion::TimeSpan;
use eframe::egui::{Color32, ColorImage};

use super::{CorpusJob, JobAbout, WorkLane, WorkOutcome};

/// The room for the picture of a film in a list, in pixels.
const FILM_STILL_SIZE_PIXELS: [usize; 2] = [288, 288];
/// How many different originals are loaded at most.
const MAX_LOADED_ORIGINALS: usize = 24;

/// Loads the piece of movement of a recording with that number and span.
pub(crate) fn load_movement_job(recording: i64, piece: usize, span: TimeSpan) -> CorpusJob {
    let about = JobAbout {
        lane: WorkLane::Movement,
        ..JobAbout::LITTLE_FIGURE_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, _| {
        let moving = Arc::new(movement_in(corpus, recording, span)?);
        Ok(WorkOutcome::Moved {
            recording,
            piece,
            moving,
        })
    })
}

/// Measures the piece of movement of a recording with that number and span, for the curves.
pub(crate) fn measure_movement_job(recording: i64, piece: usize, span: TimeSpan) -> CorpusJob {
    let about = JobAbout {
        lane: WorkLane::Measure,
        ..JobAbout::LITTLE_FIGURE_JOB_ABOUT
    };
    CorpusJob::new(about, move |corpus, _| {
        let curves = Box::new(corpus.load_kinematic_curves(recording, span)?);
        Ok(WorkOutcome::Measured { piece, curves })
    })
}

/// Loads the points of a span of a recording, such as optical markers.
pub(crate) fn load_points_job(recording: i64, span: TimeSpan) -> CorpusJob {
    CorpusJob::new(JobAbout::LITTLE_FIGURE_JOB_ABOUT, move |corpus, _| {
        corpus.points_in(recording, span).map(WorkOutcome::Points)
    })
}

/// Loads the beginning of the usable movement of a span of a recording, or a picture of its film if nothing moves; if
/// both are missing, that is not an error.
pub(crate) fn load_stretch_job(recording: i64, span: TimeSpan, shown_part: fn(TimeSpan) -> TimeSpan) -> CorpusJob {
    CorpusJob::new(JobAbout::LITTLE_FIGURE_JOB_ABOUT, move |corpus, _| {
        let address = CorpusAddress::Recording(RowName::Number(recording));
        // Calibration poses at the beginning would be all that a list shows.
        let span = shown_part(corpus.usable_part(&address, Some(span)).unwrap_or(span));
        // A recording without movement may have a film.
        let moving = movement_in(corpus, recording, span).ok();
        match moving.filter(|moving| moving.clip.clip_frame_count() > 0) {
            Some(moving) => Ok(WorkOutcome::Stretch(Some(Arc::new(moving)))),
            None => film_still(corpus, recording, span),
        }
    })
}

/// Loads the original movement of the pieces of a generated sign.
pub(crate) fn load_originals_job(parts: Vec<MadePart>) -> CorpusJob {
    CorpusJob::new(JobAbout::LITTLE_FIGURE_JOB_ABOUT, move |corpus, _| {
        Ok(load_originals(corpus, parts))
    })
}

/// Loads the original movement of the pieces of a stored generated sign.
pub(crate) fn originals_of(recording: i64) -> CorpusJob {
    CorpusJob::new(JobAbout::LITTLE_FIGURE_JOB_ABOUT, move |corpus, _| {
        let parts = corpus.made_parts(recording)?;
        Ok(load_originals(corpus, parts))
    })
}

fn movement_in(corpus: &Corpus, recording: i64, span: TimeSpan) -> CorpusResult<DisplayedMovement> {
    let address = CorpusAddress::Recording(RowName::Number(recording));
    corpus.movement_in(&address, Some(span), &ChannelGroup::ALL_CHANNEL_GROUPS)
}

/// Loads the original of each piece; equal originals are loaded once, and a missing one is not an error.
fn load_originals(corpus: &Corpus, parts: Vec<MadePart>) -> WorkOutcome {
    let mut movements: BTreeMap<String, Option<Arc<DisplayedMovement>>> = BTreeMap::new();
    let loaded = parts.into_iter().map(|part| {
        // Beyond the limit an original counts as missing.
        if !movements.contains_key(&part.from) && movements.len() < MAX_LOADED_ORIGINALS {
            let read_movement = part
                .original_address()
                .and_then(|source| corpus.movement_at_address(&source).ok());
            let moving = read_movement
                .filter(|movement| movement.clip.clip_frame_count() > 0)
                .map(Arc::new);
            movements.insert(part.from.clone(), moving);
        }
        let moving = movements.get(&part.from).cloned().flatten();
        (part, moving)
    });
    WorkOutcome::Originals(loaded.collect())
}

/// Takes the picture of a recording's film in the middle of a span.
fn film_still(corpus: &Corpus, recording: i64, span: TimeSpan) -> CorpusResult<WorkOutcome> {
    let middle = span.span_start_instant().shifted_instant(span.span_micros() / 2);
    let still = corpus.film_still(&RowName::Number(recording), middle, FILM_STILL_SIZE_PIXELS)?;
    Ok(match still {
        Some(picture) => {
            let rgba_chunks = picture.rgba.chunks_exact(4);
            let pixels = rgba_chunks.map(|rgba| Color32::from_rgb(rgba[0], rgba[1], rgba[2]));
            let size = [picture.width, picture.height];
            WorkOutcome::Still(Arc::new(ColorImage::new(size, pixels.collect())))
        }
        None => WorkOutcome::Stretch(None),
    })
}
