//! The bodies on which the signs of a dictionary play: those of the signers, or the program's own.

use std::sync::Arc;

use chereme_compose::{StepError, on_body};
use chereme_figure::raster::{FigureRaster, FigureStyle};
use chereme_figure::{FigurePalette, FigureView, PaperTheme, PortableBody, SignerBody, stroke_frame};
use chereme_motion::{BodyAnatomy, Clip, FacePosture, Skeleton};
use chereme_sign::SignerHandedness;
use serde_json::json;

use super::entries::DictionaryEntry;
use super::folder::PublicationFolder;
use super::pages::STILL_PICTURE_SIZE_PX;
use super::png;
use super::publish_motion;
use crate::Corpus;
use crate::address::CorpusAddress;
use crate::animate::NotationStaging;
use crate::error::{CorpusError, CorpusResult};
use crate::sources::DEFAULT_LANGUAGE_NAME;
use crate::starter::{OWN_BODY, built_in_body};
use crate::tokens::recording_handedness;

/// The bodies of a dictionary.
pub(super) struct DictionaryBodies {
    /// The program's own one, if all signs play on it.
    own: Option<(Arc<Skeleton>, Arc<BodyAnatomy>)>,
    written: Vec<WrittenBody>,
}

/// A body that was written.
struct WrittenBody {
    skeleton: Skeleton,
    name: String,
    body: SignerBody,
    portable: PortableBody,
}

/// Movement with the face in each frame, if there is one.
struct FacedClip {
    clip: Clip,
    faces: Vec<FacePosture>,
}

/// A sign whose movement was written.
pub(super) struct ShownSign {
    /// The name of its body.
    pub(super) body: String,
    /// Whether the movement is cut.
    pub(super) is_cut: bool,
    /// Whether a touch was lost on the program's own body.
    pub(super) is_apart: bool,
}

impl DictionaryBodies {
    /// Begins a dictionary whose signs play on the program's own body, or on those of the signers.
    pub(super) fn new(own: bool) -> CorpusResult<Self> {
        let own_body = match own {
            true => {
                let (clip, anatomy) = built_in_body()?;
                Some((Arc::clone(clip.clip_skeleton()), anatomy))
            }
            false => None,
        };
        Ok(Self {
            own: own_body,
            written: Vec::new(),
        })
    }

    /// Writes the movement of a sign that was captured or stored as one, and its still picture; nothing if its skeleton
    /// has no arms or its movement no frames.
    pub(super) fn write_stored_sign(
        &mut self,
        corpus: &Corpus,
        folder: &mut PublicationFolder,
        entry: &DictionaryEntry,
    ) -> CorpusResult<Option<ShownSign>> {
        let moving = corpus.usable_movement(&CorpusAddress::Token(entry.token.id))?;
        let handedness = recording_handedness(corpus.store.read_connection(), &moving.stretch.recording)?;
        let faces = FacedClip {
            clip: moving.clip,
            faces: moving.faces,
        };
        self.write_sign_movement(folder, &entry.name, faces, Arc::new(moving.anatomy), handedness)
    }

    /// Writes the movement that the notation of a token is performed as on the program's own body, and its still picture.
    ///
    /// # Errors
    /// Fails if the notation cannot be animated.
    pub(super) fn write_notated_sign(
        &mut self,
        corpus: &mut Corpus,
        folder: &mut PublicationFolder,
        entry: &DictionaryEntry,
        token: i64,
    ) -> CorpusResult<Option<ShownSign>> {
        // Neither the body nor the manner is then that of a signer, whom somebody would have to ask.
        let staging = NotationStaging {
            signer: Some(OWN_BODY),
            language: Some(DEFAULT_LANGUAGE_NAME),
        };
        let made = corpus.animate_notation(&[&format!("token:{token}")], &staging, None)?;
        let faces = FacedClip {
            clip: made.clip,
            faces: made.faces,
        };
        self.write_sign_movement(folder, &entry.name, faces, made.anatomy, made.handedness)
    }

    fn write_sign_movement(
        &mut self,
        folder: &mut PublicationFolder,
        name: &str,
        movement: FacedClip,
        anatomy: Arc<BodyAnatomy>,
        handedness: SignerHandedness,
    ) -> CorpusResult<Option<ShownSign>> {
        let (clip, is_cut) = publish_motion::limit_published_frames(&movement.clip)?;
        if clip.clip_frame_count() == 0 {
            return Ok(None);
        }
        let faces = publish_motion::published_faces(&clip, &movement.faces, movement.clip.clip_frame_rate());
        let Some((clip, anatomy, is_apart)) = self.place_on_body(clip, anatomy, handedness)? else {
            return Ok(None);
        };
        let Some(at) = self.find_dictionary_body(folder, &clip, &anatomy)? else {
            return Ok(None);
        };
        let of = &self.written[at];
        let coded = publish_motion::coded_motion_json(&clip, &faces, &anatomy, &of.body, &of.portable);
        let key = json!(name);
        let text = format!("CH.motion({key}, {coded});\n");
        folder.write_published_file(&format!("data/motion/{name}.js"), text.as_bytes())?;
        if let Some((framing, pose)) = publish_motion::shared_framing(&clip, &anatomy) {
            let style = FigureStyle {
                theme: PaperTheme::Light,
                ..FigureStyle::default()
            };
            let [width, height] = STILL_PICTURE_SIZE_PX;
            let aspect = width as f32 / height as f32;
            let camera = framing.framing_camera(FigureView::Addressee, aspect, &pose, &anatomy);
            let mut mesh = of.body.posed_mesh(&pose);
            let stroke = stroke_frame(&clip, &anatomy).min(faces.len() - 1);
            of.body.apply_face_expression(&pose, &faces[stroke], &mut mesh);
            let still = FigureRaster::default().draw_mesh_picture(&mesh, &camera, STILL_PICTURE_SIZE_PX, &style);
            folder.write_published_file(&format!("sign/{name}/still.png"), &png(&still)?)?;
        }
        Ok(Some(ShownSign {
            body: of.name.clone(),
            is_cut,
            is_apart,
        }))
    }

    /// Returns the movement on the body that shows it, and whether a touch was lost there; nothing if the movement has
    /// no arms.
    fn place_on_body(
        &self,
        clip: Clip,
        anatomy: Arc<BodyAnatomy>,
        handedness: SignerHandedness,
    ) -> CorpusResult<Option<(Clip, Arc<BodyAnatomy>, bool)>> {
        let Some((skeleton, own)) = &self.own else {
            return Ok(Some((clip, anatomy, false)));
        };
        match on_body(&clip, &anatomy, handedness, skeleton, own) {
            Ok(done) => Ok(Some((done.clip, Arc::clone(own), !done.lost.is_empty()))),
            Err(StepError::NoArm(_)) => Ok(None),
            Err(error) => Err(CorpusError::from_wrong_message(error.to_string())),
        }
    }

    /// Returns the body of a movement, which is written if it is new; nothing without two arms.
    fn find_dictionary_body(
        &mut self,
        folder: &mut PublicationFolder,
        clip: &Clip,
        anatomy: &BodyAnatomy,
    ) -> CorpusResult<Option<usize>> {
        let skeleton: &Skeleton = clip.clip_skeleton();
        // Signers often share one skeleton over many signs, so each body is written once.
        if let Some(at) = self.written.iter().position(|body| body.skeleton == *skeleton) {
            return Ok(Some(at));
        }
        let body = SignerBody::with_palette(skeleton, anatomy, &FigurePalette::default());
        let Some(portable) = body.to_portable_body(skeleton) else {
            return Ok(None);
        };
        let name = format!("b{}", self.written.len() + 1);
        let surface = publish_motion::body_surface_json(&portable);
        let text = format!("CH.body(\"{name}\", {surface});\n");
        folder.write_published_file(&format!("data/body/{name}.js"), text.as_bytes())?;
        // A file of its own, since signs with a face at rest do without it.
        let morphs = publish_motion::face_morphs_json(&body.face_morphs(&portable));
        let text = format!("CH.face(\"{name}\", {morphs});\n");
        folder.write_published_file(&format!("data/body/{name}-face.js"), text.as_bytes())?;
        self.written.push(WrittenBody {
            skeleton: skeleton.clone(),
            name,
            body,
            portable,
        });
        Ok(Some(self.written.len() - 1))
    }
}
