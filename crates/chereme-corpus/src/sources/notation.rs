//! Notated signs for recipes, and a body for a corpus that has none.

use std::path::Path;
use std::sync::Arc;

use chereme_compose::notation::{self as animator, Settings};
use chereme_compose::{About, ENGINE, Generated, HeldValue, Material, SourceError, Sources};
use chereme_formats::bvh::convert::{self, ClipBuilder};
use chereme_formats::bvh::raw::{Block, Reader};
use chereme_motion::Clip;
use chereme_motion::anatomy::{Anatomy, Roles};
use chereme_sign::Handedness;
use chereme_sign::hamnosys::{self, Notated};
use sha2::{Digest, Sha256};

use super::{CorpusSources, WANTED_NOTATION, missing, unreadable};
use crate::address::{self, Address, Name};
use crate::db::motion::hex;
use crate::error::{Error, Result};
use crate::notation::{self, Notation};
use crate::starter;

/// The address of the body that comes with the program, for a corpus without movement.
pub(crate) const OWN_BODY: &str = "built-in body";

/// The recording of the starter corpus whose first frame is that body at rest.
const OWN_RECORDING: &str = "bol.bvh";

/// The separator between the names of signs that follow one another.
pub(crate) const NEXT: &str = " + ";

impl CorpusSources<'_> {
    /// Returns the notated signs for a name: from the corpus, from a file, HamNoSys text, or several of these separated
    /// by ` + `.
    pub(super) fn notated(&self, name: &str) -> std::result::Result<Vec<Notated>, SourceError> {
        let error = match notation::named(self.connection, name) {
            Ok(found) if !found.is_empty() => {
                return Ok(found.into_iter().map(|found| found.document).collect());
            }
            Ok(_) => Error::wrong(format!("{name} has no notation")),
            Err(error) => error,
        };
        if Path::new(name).is_file() {
            let read = notation::read_notation(Path::new(name));
            return read.map(|(signs, _)| signs).map_err(|e| unreadable(&e));
        }
        if !name.contains(NEXT) {
            if let Ok(read) = hamnosys::parse(name) {
                return Ok(vec![Notated {
                    text: Some(name.to_owned()),
                    sign: read.sign,
                    ..Notated::default()
                }]);
            }
            if self.has(name) {
                let address = name.to_owned();
                return Err(SourceError::NoNotation { address });
            }
            return Err(missing(self, name, WANTED_NOTATION, &error));
        }
        let mut signs = Vec::new();
        for part in name.split(NEXT) {
            signs.extend(self.notated(part.trim())?);
        }
        Ok(signs)
    }

    /// Returns whether a name belongs to a sign or a token, notated or not.
    pub(super) fn has(&self, name: &str) -> bool {
        match name.parse() {
            Ok(Address::Gloss(gloss) | Address::Sign(Name::Text(gloss))) => {
                address::sign(self.connection, &gloss).is_ok()
            }
            Ok(other) => address::token(self.connection, &other).is_ok(),
            Err(_) => false,
        }
    }

    pub(super) fn notation_of(&self, name: &str) -> Result<Notation> {
        notation::find(self.connection, &name.parse()?)
    }

    /// Returns the movement of a sign that has only a notation, on the body that the corpus chooses.
    pub(super) fn animated(
        &self,
        address: &str,
    ) -> std::result::Result<Option<Material>, SourceError> {
        let Ok(found) = self.notation_of(address) else {
            return Ok(None);
        };
        let stage = self.stage(None)?;
        let settings = Settings {
            rate: stage.clip.rate(),
            ..Settings::default()
        };
        let made = animator::animate(&[&found.document], &stage, &settings)
            .map_err(|error| unreadable(&Error::wrong(error.to_string())))?;
        let document = serde_json::to_string(&found.document).unwrap_or_default();
        let name = format!("notation {document} {} {ENGINE}", stage.hash);
        Ok(Some(material(
            made,
            format!("token:{}", found.token),
            hex(&Sha256::digest(name.as_bytes())),
            found.document.gloss,
        )))
    }
}

fn material(made: Generated, address: String, hash: String, gloss: String) -> Material {
    let held = made.notes.into_iter().filter_map(|note| match note.about {
        About::Component(component, feature) => Some(HeldValue {
            hand: note.hand,
            component,
            feature,
            value: note.value,
            span: note.span,
        }),
        About::Gloss | About::Transition | About::Cue(_) => None,
    });
    Material {
        address,
        hash,
        gloss,
        signer: made.signer,
        handedness: made.handedness,
        held: held.collect(),
        curves: made.curves,
        clip: made.clip,
        anatomy: made.anatomy,
    }
}

/// Returns the body that comes with the program, at rest.
pub(crate) fn own_body() -> Result<Material> {
    let (clip, anatomy, bytes) = own_movement(OWN_RECORDING, 1)?;
    Ok(Material {
        address: OWN_BODY.to_owned(),
        hash: hex(&Sha256::digest(bytes)),
        gloss: OWN_BODY.to_owned(),
        signer: None,
        handedness: Handedness::Right,
        clip,
        anatomy: Arc::new(anatomy),
        held: Vec::new(),
        curves: Vec::new(),
    })
}

/// Returns the first `most` frames of a recording of the starter corpus, its anatomy, and the file's bytes.
pub(crate) fn own_movement(name: &str, most: usize) -> Result<(Clip, Anatomy, &'static [u8])> {
    let bad = |what: String| Error::wrong(format!("{name} of the program cannot be read: {what}"));
    let bytes = starter::starter_files()
        .find(|(path, _)| *path == Path::new(name))
        .map(|(_, bytes)| bytes)
        .ok_or_else(|| bad("it is missing".to_owned()))?;
    let mut reader = Reader::open(bytes).map_err(|error| bad(error.to_string()))?;
    let rate = convert::rate(reader.header().frame_time.as_ref());
    let rate = rate.map_err(|error| bad(error.to_string()))?;
    let mut builder =
        ClipBuilder::new(reader.hierarchy(), None).map_err(|error| bad(error.to_string()))?;
    let mut block = Block::default();
    let mut left = most;
    while left > 0
        && reader
            .next_block(&mut block)
            .map_err(|error| bad(error.to_string()))?
    {
        let taken = block.frames.min(left);
        builder.push(0..taken, |at| block.columns.get(at));
        left -= taken;
    }
    let clip = builder
        .finish(rate)
        .map_err(|error| bad(error.to_string()))?;
    let anatomy = Anatomy::with_roles(clip.skeleton(), &Roles::default());
    let anatomy = anatomy.map_err(|error| bad(error.to_string()))?;
    let pose = (clip.frames() > 0).then(|| clip.model_pose(0));
    let convention = anatomy
        .convention(clip.skeleton(), pose.as_ref())
        .convention;
    let clip = convention.clip(&clip);
    let anatomy = Anatomy::with_roles(clip.skeleton(), &Roles::default());
    let anatomy = anatomy
        .map_err(|error| bad(error.to_string()))?
        .with_clip(&clip);
    Ok((clip, anatomy, bytes))
}

#[cfg(test)]
mod tests {
    use chereme_motion::Side;

    use super::*;

    #[test]
    fn the_built_in_body_has_hands_and_stands_in_metres() {
        let body = own_body().expect("it is part of the program");
        assert_eq!(body.clip.frames(), 1);
        assert!(
            Side::BOTH
                .iter()
                .all(|&side| body.anatomy.has_fingers(side))
        );
        let height = body
            .clip
            .model_pose(0)
            .positions()
            .iter()
            .map(|at| at.y)
            .fold(0.0, f64::max);
        assert!((1.2..2.2).contains(&height), "{height}");
    }
}
