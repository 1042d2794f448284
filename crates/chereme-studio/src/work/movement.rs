//! Jobs that load movement, for the stage, for measurement and for little figures.

use std::collections::BTreeMap;
use std::sync::Arc;

use chereme_corpus::{Address, ChannelGroup, Corpus, MadePart, Moving, Name, Result};
use chereme_motion::Span;
use eframe::egui::{Color32, ColorImage};

use super::{About, Job, Lane, Outcome};
use crate::miniatures::shown;

/// The room for the picture of a film in a list, in pixels.
const STILL: [usize; 2] = [288, 288];
/// How many different originals are loaded at most.
const ORIGINALS: usize = 24;

/// Loads the piece of movement of a recording with that number and span.
pub(crate) fn load(recording: i64, piece: usize, span: Span) -> Job {
    let about = About {
        lane: Lane::Movement,
        ..About::LITTLE
    };
    Job::new(about, move |corpus, _| {
        let moving = Arc::new(movement_in(corpus, recording, span)?);
        Ok(Outcome::Moved {
            recording,
            piece,
            moving,
        })
    })
}

/// Measures the piece of movement of a recording with that number and span, for the curves.
pub(crate) fn measure(recording: i64, piece: usize, span: Span) -> Job {
    let about = About {
        lane: Lane::Measure,
        ..About::LITTLE
    };
    Job::new(about, move |corpus, _| {
        let curves = Box::new(corpus.curves(recording, span)?);
        Ok(Outcome::Measured { piece, curves })
    })
}

/// Loads the points of a span of a recording, such as optical markers.
pub(crate) fn points(recording: i64, span: Span) -> Job {
    Job::new(About::LITTLE, move |corpus, _| {
        corpus.points_in(recording, span).map(Outcome::Points)
    })
}

/// Loads the beginning of the usable movement of a span of a recording, or a picture of its film if nothing moves; if
/// both are missing, that is not an error.
pub(crate) fn stretch(recording: i64, span: Span) -> Job {
    Job::new(About::LITTLE, move |corpus, _| {
        let address = Address::Recording(Name::Number(recording));
        let span = shown(corpus.usable_part(&address, Some(span)).unwrap_or(span));
        let moving = movement_in(corpus, recording, span).ok();
        match moving.filter(|it| it.clip.frames() > 0) {
            Some(moving) => Ok(Outcome::Stretch(Some(Arc::new(moving)))),
            None => film_still(corpus, recording, span),
        }
    })
}

/// Loads the original movement of the pieces of a generated sign.
pub(crate) fn originals(parts: Vec<MadePart>) -> Job {
    Job::new(About::LITTLE, move |corpus, _| {
        Ok(load_originals(corpus, parts))
    })
}

/// Loads the original movement of the pieces of a stored generated sign.
pub(crate) fn originals_of(recording: i64) -> Job {
    Job::new(About::LITTLE, move |corpus, _| {
        let parts = corpus.made_parts(recording)?;
        Ok(load_originals(corpus, parts))
    })
}

fn movement_in(corpus: &Corpus, recording: i64, span: Span) -> Result<Moving> {
    let address = Address::Recording(Name::Number(recording));
    corpus.movement_in(&address, Some(span), &ChannelGroup::ALL)
}

/// Loads the original of each piece; equal originals are loaded once, and a missing one is not an error.
fn load_originals(corpus: &Corpus, parts: Vec<MadePart>) -> Outcome {
    let mut known: BTreeMap<String, Option<Arc<Moving>>> = BTreeMap::new();
    let loaded = parts.into_iter().map(|part| {
        if !known.contains_key(&part.from) && known.len() < ORIGINALS {
            let moving = part.original().and_then(|it| corpus.movement(&it).ok());
            let moving = moving.filter(|it| it.clip.frames() > 0).map(Arc::new);
            known.insert(part.from.clone(), moving);
        }
        let moving = known.get(&part.from).cloned().flatten();
        (part, moving)
    });
    Outcome::Originals(loaded.collect())
}

/// Takes the picture of a recording's film in the middle of a span.
fn film_still(corpus: &Corpus, recording: i64, span: Span) -> Result<Outcome> {
    let middle = span.start().shifted(span.micros() / 2);
    let still = corpus.film_still(&Name::Number(recording), middle, STILL)?;
    Ok(match still {
        Some(picture) => {
            let pixels = picture.rgba.chunks_exact(4);
            let pixels = pixels.map(|it| Color32::from_rgb(it[0], it[1], it[2]));
            let size = [picture.width, picture.height];
            Outcome::Still(Arc::new(ColorImage::new(size, pixels.collect())))
        }
        None => Outcome::Stretch(None),
    })
}
