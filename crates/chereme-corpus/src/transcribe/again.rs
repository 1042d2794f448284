//! Notation made again on the body of a recording that was made of notation.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use chereme_analysis::transcribe::Performs;
use chereme_compose::notation::{Performer, Settings};
use chereme_compose::recipe::Node;
use chereme_compose::{Input, Material, Recipe};
use chereme_motion::{Clip, Instant, Side};
use chereme_sign::Handedness;
use chereme_sign::hamnosys::{BodyLanguage, Sign};
use rusqlite::Connection;
use serde::Deserialize;

use crate::address::Stretch;
use crate::db::{recipes, tiers};
use crate::error::Result;
use crate::movement::{ChannelGroup, Track};
use crate::recombine::{SOURCE, engine};

/// Makes notation again as it was made.
pub(super) struct Again(Performer);

impl Performs for Again {
    fn begins(&self, sign: &Sign) -> Option<Clip> {
        self.0.begins(sign).ok()
    }

    fn performs(&self, sign: &Sign) -> Option<Clip> {
        self.0.performs(sign).ok()
    }
}

impl Again {
    /// Puts the body of a recording that was made of notation alone, by this animator, on the stage as it stands in
    /// the first frame; nothing for other recordings.
    pub(super) fn of(
        connection: &Connection,
        track: &Track,
        stretch: &Stretch,
        dominant: Side,
    ) -> Result<Option<Self>> {
        let Some(language) = of_notation(connection, stretch)? else {
            return Ok(None);
        };
        let clip = track.clip(connection, 0..1, &ChannelGroup::ALL)?;
        let settings = Settings {
            rate: clip.rate(),
            language,
        };
        let stage = Material {
            address: format!("recording:{}", stretch.recording.id),
            hash: String::new(),
            gloss: String::new(),
            signer: None,
            handedness: match dominant {
                Side::Left => Handedness::Left,
                Side::Right => Handedness::Right,
            },
            anatomy: Arc::new(track.anatomy(connection)?),
            clip,
            held: Vec::new(),
            curves: Vec::new(),
        };
        Ok(Performer::new(stage, settings).ok().map(Self))
    }

    /// Returns the body language it was made in.
    pub(super) fn language(&self) -> BodyLanguage {
        self.0.settings().language.clone()
    }
}

/// Returns the body language of movement that was made of notation alone, by this animator.
fn of_notation(connection: &Connection, stretch: &Stretch) -> Result<Option<BodyLanguage>> {
    /// What was made, and of what.
    #[derive(Deserialize)]
    struct Document {
        recipe: Recipe,
        inputs: BTreeMap<String, Input>,
    }
    let made = recipes::of_recording(connection, stretch.recording.id)?;
    let made = made.filter(|row| row.engine == engine());
    let made = made.and_then(|row| serde_json::from_str::<Document>(&row.document).ok());
    let made = made.filter(|made| matches!(made.recipe.root(), Node::Hamnosys(_) | Node::Sigml(_)));
    Ok(made.and_then(|made| {
        let own = made.inputs.values().find_map(|input| match input {
            Input::Language(language) => Some(language.whole().ok()),
            _ => None,
        });
        own.unwrap_or_else(|| Some(BodyLanguage::usual().clone()))
    }))
}

/// Returns the frames of the one sign that a made stretch holds, the ways from and to rest left out; nothing where it
/// does not say which they are.
pub(super) fn signed(
    connection: &Connection,
    track: &Track,
    stretch: &Stretch,
) -> Result<Option<Range<usize>>> {
    if stretch.recording.origin != "made" {
        return Ok(None);
    }
    let tiers = tiers::tiers(connection, stretch.recording.id)?;
    let Some(tier) = tiers.iter().find(|tier| tier.name == SOURCE) else {
        return Ok(None);
    };
    let [from, to] = [stretch.span.start(), stretch.span.end()].map(Instant::micros);
    let mut said = tiers::annotations_near(connection, tier.id, from, to)?;
    said.retain(|it| it.origin == "made" && it.start_us >= from && it.end_us <= to);
    let [sign] = said.as_slice() else {
        return Ok(None);
    };
    let frame = |at: i64| track.rate.frame_at(Instant::from_micros(at));
    Ok(Some(frame(sign.start_us)..frame(sign.end_us) + 1))
}
