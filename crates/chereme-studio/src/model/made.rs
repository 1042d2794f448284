//! Generated movement outside of a recording: the result of a recipe before it is stored.

use std::sync::Arc;

use chereme_corpus::{MadePart, Recombination};
use chereme_motion::{Anatomy, Clip, Face};
use chereme_sign::Handedness;

/// A made clip, with its name and what it was made from.
#[derive(Debug, Clone)]
pub(crate) struct Made {
    /// What it is called: the gloss or the recipe.
    pub(crate) name: String,
    /// The token whose notation it was generated from, if that is its only source.
    pub(crate) token: Option<i64>,
    pub(crate) clip: Clip,
    /// The face in each frame; empty if it is at rest throughout.
    pub(crate) faces: Vec<Face>,
    pub(crate) anatomy: Arc<Anatomy>,
    /// Which hand the signer signs with.
    pub(crate) handedness: Handedness,
    /// The pieces it was built from, with the time of each.
    pub(crate) parts: Vec<MadePart>,
}

impl Made {
    /// Returns what the notation of a token gave, called as its sign is.
    pub(crate) fn notated(made: &Recombination, token: i64) -> Self {
        Self {
            token: Some(token),
            ..Self::of(made)
        }
    }

    /// Returns what a recipe gave.
    pub(crate) fn of(made: &Recombination) -> Self {
        let name = match made.parts.as_slice() {
            _ if !made.gloss.is_empty() => &made.gloss,
            // A sign by itself is called by its gloss, whatever its address.
            [part] if !part.gloss.is_empty() && !made.recipe.contains(" | ") => &part.gloss,
            _ => &made.recipe,
        };
        Self {
            name: name.clone(),
            token: None,
            clip: made.clip.clone(),
            faces: made.faces.clone(),
            anatomy: made.anatomy.clone(),
            handedness: made.handedness,
            parts: made.parts.clone(),
        }
    }
}
