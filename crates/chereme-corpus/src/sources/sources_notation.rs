//! Notated signs for recipes, and a body for a corpus that has none.

use std::path::Path;
use std::sync::Arc;

use chereme_compose::notation::{self as animator, AnimatorSettings};
use chereme_compose::{
    ENGINE_VERSION, GeneratedMovement, HeldValue, MovementMaterial, NoteSubject, RecipeSources, SourceError,
};
use chereme_formats::bvh::bvh_convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{BvhReader, MotionBlock};
use chereme_motion::Clip;
use chereme_motion::anatomy::{AssignedJointRoles, BodyAnatomy};
use chereme_sign::SignerHandedness;
use chereme_sign::hamnosys::{self, NotatedSign};
use sha2::{Digest, Sha256};

use super::{CorpusSources, WANTED_NOTATION, missing_source_error, unreadable};
use crate::address::{self, CorpusAddress, RowName};
use crate::db::stored_motion::to_hex_text;
use crate::error::{CorpusError, CorpusResult};
use crate::notation::{self, TokenNotation};
use crate::starter;

/// The address of the body that comes with the program, for a corpus without movement.
pub(crate) const OWN_BODY: &str = "built-in body";

/// The recording of the starter corpus whose first frame is that body at rest.
const OWN_RECORDING: &str = "bol.bvh";

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
        if !name.contains(SIGN_NAME_SEPARATOR) {
            if let Ok(read) = hamnosys::parse_hamnosys(name) {
                return Ok(vec![NotatedSign {
                    text: Some(name.to_owned()),
                    sign: read.sign,
                    ..NotatedSign::default()
                }]);
            }
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

/// Returns the body that comes with the program, at rest.
pub(crate) fn own_body() -> CorpusResult<MovementMaterial> {
    let (clip, anatomy, bytes) = own_movement(OWN_RECORDING, 1)?;
    Ok(MovementMaterial {
        address: OWN_BODY.to_owned(),
        hash: to_hex_text(&Sha256::digest(bytes)),
        gloss: OWN_BODY.to_owned(),
        signer: None,
        handedness: SignerHandedness::Right,
        clip,
        anatomy: Arc::new(anatomy),
        held: Vec::new(),
        curves: Vec::new(),
    })
}

/// Returns the first `most` frames of a recording of the starter corpus, its anatomy, and the file's bytes.
pub(crate) fn own_movement(name: &str, most: usize) -> CorpusResult<(Clip, BodyAnatomy, &'static [u8])> {
    let bad = |what: String| CorpusError::from_wrong_message(format!("{name} of the program cannot be read: {what}"));
    let bytes = starter::starter_files()
        .find(|(path, _)| *path == Path::new(name))
        .map(|(_, bytes)| bytes)
        .ok_or_else(|| bad("it is missing".to_owned()))?;
    let mut reader = BvhReader::open_bvh(bytes).map_err(|error| bad(error.to_string()))?;
    let rate_result = bvh_convert::rate_from_frame_time(reader.bvh_motion_header().frame_time.as_ref());
    let rate = rate_result.map_err(|error| bad(error.to_string()))?;
    let mut builder = ClipBuilder::new(reader.bvh_hierarchy(), None).map_err(|error| bad(error.to_string()))?;
    let mut block = MotionBlock::default();
    let mut left = most;
    while left > 0 && reader.next_block(&mut block).map_err(|error| bad(error.to_string()))? {
        let taken = block.frames.min(left);
        builder.push_block_rows(0..taken, |at| block.columns.get(at));
        left -= taken;
    }
    let clip = builder.finish_bvh_clip(rate).map_err(|error| bad(error.to_string()))?;
    let anatomy_result = BodyAnatomy::with_roles(clip.clip_skeleton(), &AssignedJointRoles::default());
    let anatomy = anatomy_result.map_err(|error| bad(error.to_string()))?;
    let pose = (clip.clip_frame_count() > 0).then(|| clip.model_pose(0));
    let convention = anatomy.guess_convention(clip.clip_skeleton(), pose.as_ref()).convention;
    let clip = convention.file_clip_to_model(&clip);
    let anatomy = BodyAnatomy::with_roles(clip.clip_skeleton(), &AssignedJointRoles::default());
    let anatomy = anatomy.map_err(|error| bad(error.to_string()))?.with_clip(&clip);
    Ok((clip, anatomy, bytes))
}

#[cfg(test)]
mod tests {
    use chereme_motion::BodySide;

    use super::*;

    #[test]
    fn the_built_in_body_has_hands_and_stands_in_metres() {
        let body = own_body().expect("it is part of the program");
        assert_eq!(body.clip.clip_frame_count(), 1);
        assert!(BodySide::BOTH_SIDES.iter().all(|&side| body.anatomy.has_fingers(side)));
        let height = body
            .clip
            .model_pose(0)
            .model_joint_positions()
            .iter()
            .map(|at| at.y)
            .fold(0.0, f64::max);
        assert!((1.2..2.2).contains(&height), "{height}");
    }
}
