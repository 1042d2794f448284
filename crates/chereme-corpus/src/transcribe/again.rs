//! Notation made again on the body of a recording that was made of notation.

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_analysis::transcribe::Performs;
use chereme_compose::notation::{Performer, Settings};
use chereme_compose::recipe::Node;
use chereme_compose::{Input, MaterialInput, Recipe};
use chereme_motion::{Clip, Instant};
use chereme_sign::hamnosys::{BodyLanguage, Sign};
use rusqlite::Connection;
use serde::Deserialize;

use crate::address::{self, Address, Stretch};
use crate::db::{recipes, tiers};
use crate::error::Result;
use crate::movement::Track;
use crate::recombine::{SOURCE, engine};
use crate::sources::notation::{OWN_BODY, own_body};
use crate::sources::standing;

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
    /// Puts the body that a recording was made on upon the stage, where it was made of notation alone, by this
    /// animator, and its body is what it was then; nothing for other recordings.
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
            standing(connection, recording)?
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

    /// Returns the body language it was made in.
    pub(super) fn language(&self) -> BodyLanguage {
        self.0.settings().language.clone()
    }
}

/// What was made, and of what.
#[derive(Deserialize)]
struct Document {
    recipe: Recipe,
    inputs: BTreeMap<String, Input>,
}

impl Document {
    /// Returns the body language and the body of movement that was made of notation alone.
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
        Some((own.unwrap_or_else(|| Some(BodyLanguage::usual().clone()))?, body?))
    }
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
