//! Movement that was made and lies in no recording: what a recipe gives before it is stored.

use std::sync::Arc;

use chereme_corpus::{MadePart, Recombination};
use chereme_motion::{Anatomy, Clip};
use chereme_sign::Handedness;

/// A made clip, with its name and what it was made from.
#[derive(Debug, Clone)]
#[allow(dead_code, reason = "for the preview of recipes")]
pub(crate) struct Made {
    /// What it is called: the gloss or the recipe.
    pub(crate) name: String,
    /// The token whose notation it was made of, where it is that alone.
    pub(crate) token: Option<i64>,
    pub(crate) clip: Clip,
    pub(crate) anatomy: Arc<Anatomy>,
    /// Which hand the signer signs with.
    pub(crate) handedness: Handedness,
    /// What it was made from, with the time of each piece.
    pub(crate) parts: Vec<MadePart>,
}

impl Made {
    /// Returns what the notation of a token gave, called as its sign is.
    pub(crate) fn notated(made: &Recombination, token: i64) -> Self {
        let gloss = made.parts.first().map(|part| part.gloss.clone());
        let of = Self::of(made);
        Self {
            name: gloss.filter(|it| !it.is_empty()).unwrap_or(of.name.clone()),
            token: Some(token),
            ..of
        }
    }

    /// Returns what a recipe gave.
    pub(crate) fn of(made: &Recombination) -> Self {
        let name = if made.gloss.is_empty() {
            &made.recipe
        } else {
            &made.gloss
        };
        Self {
            name: name.clone(),
            token: None,
            clip: made.clip.clone(),
            anatomy: made.anatomy.clone(),
            handedness: made.handedness,
            parts: made.parts.clone(),
        }
    }
}
