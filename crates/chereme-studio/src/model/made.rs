//! Movement that was made and lies in no recording: what a recipe gives before it is stored.

use std::sync::Arc;

use chereme_corpus::{MadePart, Recombination};
use chereme_motion::{Anatomy, Clip, Face};
use chereme_sign::Handedness;

/// A made clip, with its name and what it was made from.
#[derive(Debug, Clone)]
pub(crate) struct Made {
    /// What it is called: the gloss or the recipe.
    pub(crate) name: String,
    /// The token whose notation it was made of, where it is that alone.
    pub(crate) token: Option<i64>,
    pub(crate) clip: Clip,
    /// What the face does in each frame; none where it is at rest throughout.
    pub(crate) faces: Vec<Face>,
    pub(crate) anatomy: Arc<Anatomy>,
    /// Which hand the signer signs with.
    pub(crate) handedness: Handedness,
    /// What it was made from, with the time of each piece.
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
