//! The bodies on which the signs of a dictionary play: those of the signers, or the program's own.

use std::sync::Arc;

use chereme_compose::{Cause, on_body};
use chereme_figure::raster::Style;
use chereme_figure::{Body, Palette, PortableBody, Theme, thumbnail};
use chereme_motion::{Anatomy, Clip, Skeleton};
use chereme_sign::Handedness;
use serde_json::json;

use super::entries::Entry;
use super::folder::Folder;
use super::motion;
use super::pages::STILL;
use super::png;
use crate::Corpus;
use crate::address::Address;
use crate::built_in_body;
use crate::error::{Error, Result};
use crate::tokens::handedness;

/// The bodies of a dictionary.
pub(super) struct Bodies {
    /// The program's own one, if all signs play on it.
    own: Option<(Arc<Skeleton>, Arc<Anatomy>)>,
    written: Vec<Written>,
}

/// A body that was written.
struct Written {
    skeleton: Skeleton,
    name: String,
    body: Body,
    portable: PortableBody,
}

/// A sign whose movement was written.
pub(super) struct Shown {
    /// The name of its body.
    pub(super) body: String,
    /// Whether the movement is cut.
    pub(super) is_cut: bool,
    /// Whether a touch was lost on the program's own body.
    pub(super) is_apart: bool,
}

impl Bodies {
    /// Begins a dictionary whose signs play on the program's own body, or on those of the signers.
    pub(super) fn new(own: bool) -> Result<Self> {
        let own = match own {
            true => {
                let (clip, anatomy) = built_in_body()?;
                Some((Arc::clone(clip.skeleton()), anatomy))
            }
            false => None,
        };
        Ok(Self {
            own,
            written: Vec::new(),
        })
    }

    /// Writes the movement and the still picture of a sign; nothing if its skeleton has no arms or its movement no
    /// frames.
    pub(super) fn write(
        &mut self,
        corpus: &Corpus,
        folder: &mut Folder,
        entry: &Entry,
    ) -> Result<Option<Shown>> {
        let moving = corpus.usable_movement(&Address::Token(entry.token.id))?;
        let (clip, is_cut) = motion::shown(&moving.clip)?;
        if clip.frames() == 0 {
            return Ok(None);
        }
        let handedness = handedness(corpus.store.read(), &moving.stretch.recording)?;
        let Some((clip, anatomy, is_apart)) =
            self.placed(clip, Arc::new(moving.anatomy), handedness)?
        else {
            return Ok(None);
        };
        let Some(at) = self.find(folder, &clip, &anatomy)? else {
            return Ok(None);
        };
        let of = &self.written[at];
        let coded = motion::coded(&clip, &anatomy, (&of.body, &of.portable));
        let key = json!(entry.name);
        let text = format!("CH.motion({key}, {coded});\n");
        folder.write(&format!("data/motion/{}.js", entry.name), text.as_bytes())?;
        let style = Style {
            theme: Theme::Light,
            ..Style::default()
        };
        let still = thumbnail(&clip, &anatomy, STILL, &style)
            .map_err(|error| Error::wrong(error.to_string()))?;
        folder.write(&format!("sign/{}/still.png", entry.name), &png(&still)?)?;
        Ok(Some(Shown {
            body: of.name.clone(),
            is_cut,
            is_apart,
        }))
    }

    /// Returns the movement on the body that shows it, and whether a touch was lost there; nothing if the movement has
    /// no arms.
    fn placed(
        &self,
        clip: Clip,
        anatomy: Arc<Anatomy>,
        handedness: Handedness,
    ) -> Result<Option<(Clip, Arc<Anatomy>, bool)>> {
        let Some((skeleton, own)) = &self.own else {
            return Ok(Some((clip, anatomy, false)));
        };
        match on_body((&clip, &anatomy), handedness, (skeleton, own)) {
            Ok(done) => Ok(Some((done.clip, Arc::clone(own), !done.lost.is_empty()))),
            Err(Cause::NoArm(_)) => Ok(None),
            Err(error) => Err(Error::wrong(error.to_string())),
        }
    }

    /// Returns the body of a movement, which is written if it is new; nothing without two arms.
    fn find(
        &mut self,
        folder: &mut Folder,
        clip: &Clip,
        anatomy: &Anatomy,
    ) -> Result<Option<usize>> {
        let skeleton: &Skeleton = clip.skeleton();
        if let Some(at) = self.written.iter().position(|it| it.skeleton == *skeleton) {
            return Ok(Some(at));
        }
        let body = Body::with_palette(skeleton, anatomy, &Palette::default());
        let Some(portable) = body.portable(skeleton) else {
            return Ok(None);
        };
        let name = format!("b{}", self.written.len() + 1);
        let surface = motion::surface(&portable);
        let text = format!("CH.body(\"{name}\", {surface});\n");
        folder.write(&format!("data/body/{name}.js"), text.as_bytes())?;
        self.written.push(Written {
            skeleton: skeleton.clone(),
            name,
            body,
            portable,
        });
        Ok(Some(self.written.len() - 1))
    }
}
