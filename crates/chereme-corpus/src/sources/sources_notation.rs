//! Notated signs for recipes.

use std::path::Path;

use chereme_compose::notation::{self as animator, AnimatorSettings};
use chereme_compose::{
    ENGINE_VERSION, GeneratedMovement, HeldValue, MovementMaterial, NoteSubject, RecipeSources, SourceError,
};
use chereme_sign::hamnosys::{self, NotatedSign};
use sha2::{Digest, Sha256};

use super::{CorpusSources, WANTED_NOTATION, missing_source_error, unreadable};
use crate::address::{self, CorpusAddress, RowName};
use crate::db::stored_motion::to_hex_text;
use crate::error::{CorpusError, CorpusResult};
use crate::notation::{self, TokenNotation};

/// The separator between the names of signs that follow one another.
pub(crate) const SIGN_NAME_SEPARATOR: &str = " + ";

impl CorpusSources<'_> {
    /// Returns the notated signs for a name: from the corpus, from a file, HamNoSys text, or several of these separated
    /// by ` + `.
    pub(super) fn find_notated_signs(&self, name: &str) -> std::result::Result<Vec<NotatedSign>, SourceError> {
        let error = match notation::find_named_notations(self.connection, name) {
            Ok(found) if !found.is_empty() => {
                return Ok(found.into_iter().map(|found| found.document).collect());
            }
            Ok(_) => CorpusError::from_wrong_message(format!("{name} has no notation")),
            Err(error) => error,
        };
        if Path::new(name).is_file() {
            let read = notation::read_notation(Path::new(name));
            return read.map(|(signs, _)| signs).map_err(|e| unreadable(&e));
        }
        // A separator means several signs, and HamNoSys has none.
        if !name.contains(SIGN_NAME_SEPARATOR) {
            if let Ok(read) = hamnosys::parse_hamnosys(name) {
                return Ok(vec![NotatedSign {
                    text: Some(name.to_owned()),
                    sign: read.sign,
                    ..NotatedSign::default()
                }]);
            }
            // A sign of this name exists, so that the missing thing is its notation.
            if self.has_notated_name(name) {
                let address = name.to_owned();
                return Err(SourceError::NoNotation { address });
            }
            return Err(missing_source_error(self, name, WANTED_NOTATION, &error));
        }
        let mut signs = Vec::new();
        for part in name.split(SIGN_NAME_SEPARATOR) {
            signs.extend(self.find_notated_signs(part.trim())?);
        }
        Ok(signs)
    }

    /// Returns whether a name belongs to a sign or a token, notated or not.
    pub(super) fn has_notated_name(&self, name: &str) -> bool {
        match name.parse() {
            Ok(CorpusAddress::Gloss(gloss) | CorpusAddress::Sign(RowName::Text(gloss))) => {
                address::find_sign_by_gloss(self.connection, &gloss).is_ok()
            }
            Ok(other) => address::find_addressed_token(self.connection, &other).is_ok(),
            Err(_) => false,
        }
    }

    pub(super) fn notation_of(&self, name: &str) -> CorpusResult<TokenNotation> {
        notation::find_address_notation(self.connection, &name.parse()?)
    }

    /// Returns the movement of a sign that has only a notation, on the body that the corpus chooses.
    pub(super) fn animate_notated_sign(
        &self,
        address: &str,
    ) -> std::result::Result<Option<MovementMaterial>, SourceError> {
        let Ok(found) = self.notation_of(address) else {
            return Ok(None);
        };
        let stage = self.stage(None)?;
        let settings = AnimatorSettings {
            rate: stage.clip.clip_frame_rate(),
            ..AnimatorSettings::default()
        };
        let made = animator::animate_signs(&[&found.document], &stage, &settings)
            .map_err(|error| unreadable(&CorpusError::from_wrong_message(error.to_string())))?;
        let document = serde_json::to_string(&found.document).unwrap_or_default();
        let name = format!("notation {document} {} {ENGINE_VERSION}", stage.hash);
        Ok(Some(generated_material(
            made,
            format!("token:{}", found.token),
            to_hex_text(&Sha256::digest(name.as_bytes())),
            found.document.gloss,
        )))
    }
}

fn generated_material(made: GeneratedMovement, address: String, hash: String, gloss: String) -> MovementMaterial {
    let held_values = made.notes.into_iter().filter_map(|note| match note.about {
        NoteSubject::Component(component, feature) => Some(HeldValue {
            hand: note.hand,
            component,
            feature,
            value: note.value,
            span: note.span,
        }),
        NoteSubject::Gloss | NoteSubject::Transition | NoteSubject::Cue(_) => None,
    });
    MovementMaterial {
        address,
        hash,
        gloss,
        signer: made.signer,
        handedness: made.handedness,
        held: held_values.collect(),
        curves: made.curves,
        clip: made.clip,
        anatomy: made.anatomy,
    }
}
