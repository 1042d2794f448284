//! What the movement of a sign in a dictionary comes from.

use std::collections::BTreeSet;

use chereme_compose::{RecipeInput, RecipeInputs};
use rusqlite::Connection;
use serde_json::Value;

use crate::RecordOrigin;
use crate::db::recipes;
use crate::db::signs::TokenRow;
use crate::db::stored_recordings;
use crate::error::CorpusResult;
use crate::recombine::source_rows;

/// What a movement comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MovementSource {
    /// It was captured.
    Capture,
    /// A recipe made it from captured movement, perhaps with other movement.
    Captures,
    /// A recipe made it from notation, without captured movement.
    Notation,
    /// A program made it from something else, such as a word to spell.
    Program,
}

impl MovementSource {
    /// Returns what the movement of a token comes from, through all recipes that lead to it.
    ///
    /// A body that performs notation or spells a word gives no movement, even if it was captured.
    pub(super) fn movement_source_of_token(connection: &Connection, token: &TokenRow) -> CorpusResult<Self> {
        match token.origin {
            RecordOrigin::Captured => return Ok(Self::Capture),
            RecordOrigin::Made => {}
            _ => return Ok(Self::Program),
        }
        let mut source = Self::Program;
        let mut next: Vec<i64> = token.recording_id.into_iter().collect();
        let mut seen = BTreeSet::new();
        while let Some(recording) = next.pop() {
            if !seen.insert(recording) {
                continue;
            }
            match stored_recordings::load_recording_row(connection, recording)?.origin {
                RecordOrigin::Captured => return Ok(Self::Captures),
                RecordOrigin::Made => {}
                _ => continue,
            }
            let recipe = recipes::find_recording_recipe(connection, recording)?;
            let Some(inputs) = recipe.and_then(|recipe| inputs_of(&recipe.document)) else {
                return Ok(Self::Captures);
            };
            for (path, input) in &inputs.0 {
                match input {
                    RecipeInput::Notation(_) => source = Self::Notation,
                    RecipeInput::Material(material) if material.body.is_some() => source = Self::Notation,
                    RecipeInput::Material(material) if gives_movement(path) => {
                        next.extend(source_rows(connection, &material.address)?.0);
                    }
                    _ => {}
                }
            }
        }
        Ok(source)
    }
}

/// Returns the inputs in a stored recipe; `None` if they cannot be read.
fn inputs_of(document: &str) -> Option<RecipeInputs> {
    let mut document: Value = serde_json::from_str(document).ok()?;
    serde_json::from_value(document.get_mut("inputs")?.take()).ok()
}

/// Returns whether the movement at a path of a recipe is used, and not only its body.
fn gives_movement(path: &str) -> bool {
    ["/sign", "/nonmanual/from", "/face/from"]
        .iter()
        .any(|end| path.ends_with(end))
}
