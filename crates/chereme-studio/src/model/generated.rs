//! Generated movement outside of a recording: the result of a recipe before it is stored.

use std::sync::Arc;

use chereme_corpus::{MadePart, RecombinationResult};
use chereme_motion::{BodyAnatomy, Clip, FacePosture};
use chereme_sign::SignerHandedness;

/// A generated clip, with its name and its source.
#[derive(Debug, Clone)]
pub(crate) struct GeneratedClip {
    /// Name for display: the gloss or the recipe.
    pub(crate) name: String,
    /// The recipe that it was generated from.
    pub(crate) recipe: String,
    /// The token whose notation it was generated from, if that is its only source.
    pub(crate) token: Option<i64>,
    pub(crate) clip: Clip,
    /// The face in each frame; empty if the face is at rest throughout.
    pub(crate) faces: Vec<FacePosture>,
    pub(crate) anatomy: Arc<BodyAnatomy>,
    /// The dominant hand of the signer.
    pub(crate) handedness: SignerHandedness,
    /// The pieces it was built from, with the time of each.
    pub(crate) parts: Vec<MadePart>,
}

impl GeneratedClip {
    /// Returns the movement generated from the notation of a token, named after its sign.
    pub(crate) fn from_notated_token(made: &RecombinationResult, token: i64) -> Self {
        Self {
            token: Some(token),
            ..Self::clip_from_recipe_result(made)
        }
    }

    /// Returns the movement generated from a recipe.
    pub(crate) fn clip_from_recipe_result(made: &RecombinationResult) -> Self {
        let name = match made.parts.as_slice() {
            _ if !made.gloss.is_empty() => &made.gloss,
            // A sign without changes is named by its gloss, whatever its address.
            [part] if !part.gloss.is_empty() && !made.recipe.contains(" | ") => &part.gloss,
            _ => &made.recipe,
        };
        Self {
            name: name.clone(),
            recipe: made.recipe.clone(),
            token: None,
            clip: made.clip.clone(),
            faces: made.faces.clone(),
            anatomy: made.anatomy.clone(),
            handedness: made.handedness,
            parts: made.parts.clone(),
        }
    }
}
