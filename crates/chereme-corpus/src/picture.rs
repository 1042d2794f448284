//! Pictures of stored movement and of inventories, drawn without a window.

mod picture_faces;
mod picture_points;
pub mod picture_values;

use std::collections::BTreeSet;
use std::io::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use chereme_figure::{
    AnimationCaption, AnimationOptions, AnimationStrip, ClipAnimation, FigureError, FigureView, HandshapeOptions,
    PaperTheme, SheetOptions, contact_sheet, handshape_picture, handshape_sheet, write_gif, write_png,
};
use chereme_motion::anatomy::BodyAnatomy;
use chereme_motion::{BodySide, Clip, FacePosture, RecordingInstant, TimeSpan};
use chereme_sign::hamnosys::{HamnosysSymbol, drawing};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, CorpusAddress, RecordingStretch};
use crate::animate::NotationStaging;
use crate::atomic_write::{lowercase_extension, write_atomically};
use crate::consent::{ConsentKind, OutputAudience, OutputGate, WithheldOutput, nothing_passes_error};
use crate::curves;
use crate::curves::face_captured;
use crate::curves::face_stage::load_face_material;
use crate::db::{seals, signs, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::film::{WrittenFilmShape, write_film};
use crate::inventories;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::notation::{self, TokenNotation};
use crate::progress::ProgressReceiver;
use crate::recombine::RecombinationResult;
use crate::starter::built_in_body;

/// The height of a film in pixels, and its pictures per second.
const FILM_HEIGHT_PX: usize = 540;
const FILM_RATE: u32 = 25;
/// The longest stretch that is drawn, in microseconds: all of its movement is in memory.
const MAX_DRAWN_STRETCH_US: i64 = 1_200_000_000;

/// Returns a span if all of it can be drawn.
fn drawable(span: TimeSpan) -> CorpusResult<TimeSpan> {
    if span.span_micros() <= MAX_DRAWN_STRETCH_US {
        return Ok(span);
    }
    Err(CorpusError::from_wrong_message(format!(
        "the movement lasts {:.0} s, and at most {} s can be drawn at once",
        span.span_seconds(),
        MAX_DRAWN_STRETCH_US / 1_000_000
    ))
    .with_advice("name an annotation or a token of it, or store a part of it with a recipe: `| span 0s..600s`"))
}

/// The inventory name for the symbols of HamNoSys.
const HAMNOSYS_SYMBOL_INVENTORY: &str = "hamnosys";
/// The inventory name for the faces of SiGML's non-manuals.
const SIGML_FACE_INVENTORY: &str = "faces";
/// The size in pixels up to which a handshape is drawn in the style for small sizes.
const SMALL_HAND: usize = 160;
/// The height of one picture of movement, in pixels.
const MOVEMENT_PICTURE_HEIGHT_PX: usize = 260;
/// The height of a notation symbol, in pixels of a scalable picture.
const NOTATION_SYMBOL_HEIGHT_PX: f32 = 64.0;

/// Options for drawing a picture.
#[derive(Debug, Clone)]
pub struct PictureOptions {
    /// How many pictures stand side by side on a contact sheet.
    pub frames: usize,
    /// Whether the contact sheet has close-ups of the hands, and of the face if it is active.
    pub hands: bool,
    /// Whether a close-up of the face is beside the signer in every picture.
    pub face: bool,
    /// The height of one picture in pixels; by default 260 for movement, 540 for a film, 128 for a handshape, 160 for a
    /// face.
    pub height: Option<usize>,
    /// The speed of an animation relative to the recorded speed; from 0.05 to 20.
    pub speed: f64,
    /// The pictures per second of a film, from 1 to 120.
    pub rate: u32,
    /// Whether glosses appear below an animation or a film while they are signed.
    pub captions: bool,
    /// Whether an existing file is overwritten.
    pub force: bool,
    /// For whom it is drawn: what somebody did not agree to show them is left out.
    pub audience: OutputAudience,
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self {
            frames: 8,
            hands: true,
            face: false,
            height: None,
            speed: 1.0,
            rate: FILM_RATE,
            captions: false,
            force: false,
            audience: OutputAudience::Me,
        }
    }
}

/// A picture that was drawn.
#[derive(Debug, Clone, Serialize)]
pub struct DrawnPicture {
    /// The file.
    pub path: PathBuf,
    /// Its subject.
    pub title: String,
    /// Its size in bytes.
    pub bytes: u64,
    /// The number of pictures, or of symbols of a notation, in sequence or side by side.
    pub frames: usize,
    /// The body on which notation was animated, if the sign has no movement of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub animated_on: Option<String>,
    /// Whether the drawn notation was transcribed from the movement because none is stored.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub transcribed: bool,
    /// What was left out, because somebody did not agree that this audience sees it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub withheld: Vec<WithheldOutput>,
    /// The sentence that names those who have not agreed that others see it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub for_me: Option<String>,
}

/// A piece of movement with the data needed to display it.
#[derive(Debug, Clone)]
pub struct DisplayedMovement {
    /// Its stretch of a recording.
    pub stretch: RecordingStretch,
    /// The movement in metres and model space.
    pub clip: Clip,
    /// The body part of each joint.
    pub anatomy: BodyAnatomy,
    /// The face in each frame, if curves of non-manuals give it; otherwise empty.
    pub faces: Vec<FacePosture>,
}

/// Movement in the form for drawing.
#[derive(Debug, Clone, Copy)]
pub struct DrawablePerformance<'a> {
    /// The movement.
    pub clip: &'a Clip,
    /// The body part of each joint.
    pub anatomy: &'a BodyAnatomy,
    /// The face in each frame; frames beyond them have a face at rest.
    pub faces: &'a [FacePosture],
}

impl<'a> From<&'a DisplayedMovement> for DrawablePerformance<'a> {
    fn from(moving: &'a DisplayedMovement) -> Self {
        Self {
            clip: &moving.clip,
            anatomy: &moving.anatomy,
            faces: &moving.faces,
        }
    }
}

impl<'a> From<&'a RecombinationResult> for DrawablePerformance<'a> {
    fn from(made: &'a RecombinationResult) -> Self {
        Self {
            clip: &made.clip,
            anatomy: &made.anatomy,
            faces: &made.faces,
        }
    }
}

/// Returns the movement of a recording that has only a face, by the program's own body; `None` for other recordings.
fn load_moving_face(connection: &Connection, stretch: &RecordingStretch) -> CorpusResult<Option<DisplayedMovement>> {
    if stored_recordings::body_track(connection, stretch.recording.id)?.is_some() {
        return Ok(None);
    }
    Ok(load_face_material(connection, stretch)?.map(|face| DisplayedMovement {
        faces: chereme_compose::faces_from_curves(&face.curves),
        clip: face.clip,
        anatomy: (*face.anatomy).clone(),
        stretch: stretch.clone(),
    }))
}

impl Corpus {
    /// Returns the movement at an address: a token's span, a recording, a sign's citation form.
    ///
    /// # Errors
    /// Fails if nothing has that address, if several things have it, or if it has no movement.
    pub fn movement_at_address(&self, address: &CorpusAddress) -> CorpusResult<DisplayedMovement> {
        self.movement_in(address, None, &ChannelGroup::ALL_CHANNEL_GROUPS)
    }

    /// Returns the movement at an address without frames that are left out of measures and pictures.
    ///
    /// # Errors
    /// As [`movement`](Self::movement_at_address).
    pub fn usable_movement(&self, address: &CorpusAddress) -> CorpusResult<DisplayedMovement> {
        let span = self.usable_part(address, None)?;
        self.movement_in(address, Some(span), &ChannelGroup::ALL_CHANNEL_GROUPS)
    }

    /// Returns part of the movement at an address: a span of the recording, and some channel groups; joints of other
    /// groups stay at rest.
    ///
    /// # Errors
    /// As [`movement`](Self::movement_at_address).
    pub fn movement_in(
        &self,
        address: &CorpusAddress,
        span: Option<TimeSpan>,
        groups: &[ChannelGroup],
    ) -> CorpusResult<DisplayedMovement> {
        let connection = self.store.read_connection();
        let mut stretch = address::find_addressed_stretch(connection, address)?;
        stretch.span = match span {
            Some(span) => stretch.span.span_intersection(span).unwrap_or_default(),
            None => stretch.span,
        };
        if let Some(moving) = load_moving_face(connection, &stretch)? {
            return Ok(moving);
        }
        let track = MotionTrack::open_motion_track(connection, stretch.recording.id)?;
        let frames = track.frames_in(stretch.span);
        let clip = track.read_motion_clip(connection, frames.clone(), groups)?;
        // A word is mouthed over its whole curve, even if only a part of it is displayed.
        let curves = curves::of_track(connection, &track, 0..track.motion_frame_count())?;
        let all_faces = chereme_compose::faces_from_curves(&curves);
        let faces = all_faces.get(frames).map(<[FacePosture]>::to_vec).unwrap_or_default();
        Ok(DisplayedMovement {
            clip,
            faces,
            anatomy: track.track_anatomy(connection)?,
            stretch,
        })
    }

    /// Draws movement to a file: a contact sheet for `.png`, an animation for `.gif`, a film for `.mp4`. A sign that
    /// has only a notation is animated on the body that the corpus chooses. For `.svg` the notation itself is drawn,
    /// symbol by symbol; for a sign without one, the transcription of its movement.
    ///
    /// # Errors
    /// Fails if there is nothing to draw, the file has another ending, or it exists already.
    pub fn draw_movement_file(
        &mut self,
        address: &CorpusAddress,
        to: &Path,
        options: &PictureOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DrawnPicture> {
        let connection = self.store.read_connection();
        if lowercase_extension(to) == "svg" {
            return self.draw_symbols(address, to, options.force, progress);
        }
        let stretch = match address::find_addressed_stretch(connection, address) {
            Ok(stretch) => stretch,
            Err(error) => {
                let Ok(notated) = notation::find_address_notation(connection, address) else {
                    return Err(error);
                };
                return self.draw_notated(&notated, to, options, progress);
            }
        };
        verify_stretch(connection, &stretch)?;
        let span = drawable(self.usable_span(&stretch)?)?;
        // A face from points on film is shown on the program's own body.
        let has_own_face = options.face && face_captured::has_face(connection, stretch.recording.id)?;
        if !has_own_face
            && stored_recordings::body_track(connection, stretch.recording.id)?.is_none()
            && let Some(points) = picture_points::first_point_track(connection, &stretch, span)?
        {
            return picture_points::draw_points_file(&points, &stretch_title(&stretch), to, options, progress);
        }
        let moving = self.movement_in(address, Some(span), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
        let title = stretch_title(&moving.stretch);
        let captions = match options.captions {
            true => self.captions(&moving.stretch)?,
            false => Vec::new(),
        };
        let scene = SideBySideScene {
            performance: (&moving).into(),
            title: &title,
            captions,
        };
        draw_scenes(&[scene], to, options, progress)
    }

    /// Draws several movements side by side to a file, as one animation (`.gif`) or film (`.mp4`). They begin together,
    /// and a shorter one holds its last picture.
    ///
    /// # Errors
    /// As [`draw_movement_file`](Self::draw_movement_file); also fails if one of them has no movement, or the file has another ending.
    pub fn draw_together(
        &mut self,
        addresses: &[CorpusAddress],
        to: &Path,
        options: &PictureOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DrawnPicture> {
        let gate = OutputGate::open_output_gate(self.store.read_connection(), options.audience)?;
        let (mut passed, mut withheld, mut shown) = (Vec::new(), Vec::new(), BTreeSet::new());
        for address in addresses {
            let recording = self.pictured_recording(address)?;
            shown.extend(recording);
            match recording.and_then(|id| gate.withheld_output(id, &[ConsentKind::Movement, ConsentKind::Annotation])) {
                Some(one) => withheld.push(one),
                None => passed.push(address.clone()),
            }
        }
        if passed.is_empty() && !withheld.is_empty() {
            return Err(nothing_passes_error(&withheld, options.audience));
        }
        let picture = self.draw_side_by_side(&passed, to, options, progress)?;
        Ok(DrawnPicture {
            withheld,
            for_me: gate.for_me_sentence(Some(&shown)),
            ..picture
        })
    }

    /// Returns the recording that a picture of an address shows; for a notation, that of the body that performs it.
    fn pictured_recording(&mut self, address: &CorpusAddress) -> CorpusResult<Option<i64>> {
        if let Ok(stretch) = address::find_addressed_stretch(self.store.read_connection(), address) {
            return Ok(Some(stretch.recording.id));
        }
        if notation::find_address_notation(self.store.read_connection(), address).is_err() {
            // What cannot be found is refused when it is drawn.
            return Ok(None);
        }
        let body = self.chosen_body()?.parse::<CorpusAddress>()?;
        let stretch = address::find_addressed_stretch(self.store.read_connection(), &body);
        Ok(stretch.ok().map(|stretch| stretch.recording.id))
    }

    /// Returns a sentence that names those who have not agreed that everybody sees what a recipe makes, before it is
    /// stored; `None` if all have.
    ///
    /// # Errors
    /// Fails if the database fails. A recipe that cannot be evaluated shows nobody.
    pub fn recipe_consent_sentence(&mut self, recipe: &str) -> CorpusResult<Option<String>> {
        let (kinds, refused) = match self.withheld_recipe(recipe, OutputAudience::Public) {
            Ok(None) => return Ok(None),
            Ok(refused) => (&[ConsentKind::Derived][..], refused),
            // A corpus that cannot be written cannot judge a sign as if it were stored, so that all who might object are named.
            Err(_) => (&ConsentKind::ALL_CONSENT_KINDS[..], None),
        };
        let sources = self.recipe_sources(recipe)?;
        let gate = OutputGate::open_output_gate(self.store.read_connection(), OutputAudience::Me)?;
        Ok(gate.unstored_sign_sentence(refused, &sources, kinds))
    }

    fn draw_side_by_side(
        &mut self,
        addresses: &[CorpusAddress],
        to: &Path,
        options: &PictureOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DrawnPicture> {
        if let [one] = addresses {
            return self.draw_movement_file(one, to, options, progress);
        }
        if !matches!(lowercase_extension(to).as_str(), "gif" | "mp4") {
            return Err(
                CorpusError::from_wrong_message("such a picture shows one movement, and several are named")
                    .with_error_place(to.display().to_string())
                    .with_advice("several movements are drawn next to each other to an .mp4 or a .gif"),
            );
        }
        let mut all = Vec::with_capacity(addresses.len());
        for address in addresses {
            let stretch = address::find_addressed_stretch(self.store.read_connection(), address)?;
            verify_stretch(self.store.read_connection(), &stretch)?;
            let span = drawable(self.usable_span(&stretch)?)?;
            let moving = self.movement_in(address, Some(span), &ChannelGroup::ALL_CHANNEL_GROUPS)?;
            let captions = match options.captions {
                true => self.captions(&moving.stretch)?,
                false => Vec::new(),
            };
            all.push((stretch_title(&moving.stretch), captions, moving));
        }
        let scenes: Vec<SideBySideScene<'_>> = all
            .iter()
            .map(|(title, captions, moving)| SideBySideScene {
                performance: moving.into(),
                title,
                captions: captions.clone(),
            })
            .collect();
        draw_scenes(&scenes, to, options, progress)
    }

    /// Returns the glosses in a stretch as captions, on the clock of its movement.
    fn captions(&self, stretch: &RecordingStretch) -> CorpusResult<Vec<AnimationCaption>> {
        let from = stretch.span.span_start_instant().instant_micros();
        let caption = |text: &str, span: TimeSpan| AnimationCaption {
            span: span.shifted_span(-from),
            text: text.to_owned(),
        };
        if let Some(token) = &stretch.token {
            // The last picture may lie a fraction of a frame later, and is held.
            let end = stretch.span.span_end_instant().shifted_instant(1_000_000);
            let full_span = TimeSpan::span_between(stretch.span.span_start_instant(), end);
            return Ok(vec![caption(&token.gloss, full_span)]);
        }
        let tokens = signs::tokens_of_recording(self.store.read_connection(), stretch.recording.id)?;
        let numbers: Vec<i64> = tokens.iter().map(|token| token.id).collect();
        seals::verify_tokens(self.store.read_connection(), &numbers)?;
        let spans = tokens.iter().filter_map(|token| {
            let (start, end) = (token.start_us?, token.end_us?);
            let span = TimeSpan::from_span_micros(start, end);
            let within = span.span_intersection(stretch.span)?;
            Some(caption(&token.gloss, within))
        });
        Ok(spans.collect())
    }

    /// Draws the symbols of a notation to an SVG: the stored notation, otherwise a transcription of the movement.
    fn draw_symbols(
        &self,
        address: &CorpusAddress,
        to: &Path,
        force: bool,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DrawnPicture> {
        let connection = self.store.read_connection();
        let (title, text, transcribed) = match notation::find_address_notation(connection, address) {
            Ok(found) => {
                seals::verify_tokens(connection, &[found.token])?;
                let text = found.text.unwrap_or_else(|| found.document.hamnosys_text().text);
                (found.document.gloss, text, false)
            }
            Err(error) => {
                if let Ok(stretch) = address::find_addressed_stretch(connection, address) {
                    verify_stretch(connection, &stretch)?;
                }
                match self.transcribe_movement(address, progress) {
                    Ok(written) => (written.gloss, written.hamnosys, true),
                    Err(CorpusError::Stopped) => return Err(CorpusError::Stopped),
                    Err(_) => return Err(error),
                }
            }
        };
        let unknown =
            || CorpusError::from_wrong_message("the notation holds what is no symbol").with_error_place(&title);
        let symbols = drawing::draw_hamnosys_text(&text).ok_or_else(unknown)?.len();
        let picture = drawing::hamnosys_to_svg(&text, NOTATION_SYMBOL_HEIGHT_PX).ok_or_else(unknown)?;
        Ok(DrawnPicture {
            transcribed,
            ..write_svg_picture(&picture, &title, symbols, to, force)?
        })
    }

    fn draw_notated(
        &mut self,
        notated: &TokenNotation,
        to: &Path,
        options: &PictureOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<DrawnPicture> {
        seals::verify_tokens(self.store.read_connection(), &[notated.token])?;
        let body = self.chosen_body()?;
        let name = format!("token:{}", notated.token);
        let staging = NotationStaging {
            signer: Some(&body),
            language: None,
        };
        let done = self.animate_notation(&[&name], &staging, None)?;
        let title = &notated.document.gloss;
        let picture = draw_clip((&done).into(), title, to, options, progress)?;
        Ok(DrawnPicture {
            animated_on: Some(body),
            ..picture
        })
    }

    /// Draws handshapes to a PNG: one value, or all values of an inventory that have a posture. The inventory
    /// `hamnosys` stands for the symbols of HamNoSys, drawn to an SVG; `faces` stands for the faces of SiGML's
    /// non-manuals, drawn to a PNG.
    ///
    /// # Errors
    /// Fails if there is no such inventory, or it has no handshape of that name.
    pub fn draw_handshapes(
        &self,
        inventory: &str,
        value: Option<&str>,
        side: BodySide,
        to: &Path,
        options: &PictureOptions,
    ) -> CorpusResult<DrawnPicture> {
        if inventory == HAMNOSYS_SYMBOL_INVENTORY && value.is_none() {
            if lowercase_extension(to) != "svg" {
                return Err(missing_ending_error(to, "the symbols of HamNoSys are drawn to an .svg"));
            }
            let chart = drawing::symbol_chart_svg();
            return write_svg_picture(
                &chart,
                HAMNOSYS_SYMBOL_INVENTORY,
                HamnosysSymbol::all_symbols().len(),
                to,
                options.force,
            );
        }
        if inventory == SIGML_FACE_INVENTORY && value.is_none() {
            return picture_faces::draw_face_sheet(to, options);
        }
        seals::verify_tables(self.store.read_connection(), ["inventory", "inventory_value"])?;
        let all = inventories::load_all_inventories(self.store.read_connection())?;
        let ids: Vec<&str> = all.iter().map(|row| row.inventory.id.as_str()).collect();
        let stored = all.iter().find(|row| row.inventory.id == inventory).ok_or_else(|| {
            CorpusError::from_wrong_message(format!("no inventory is called {inventory:?}"))
                .with_error_place(inventory)
                .with_advice(format!("the inventories are: {}", ids.join(", ")))
        })?;
        let configurations = all
            .iter()
            .find(|row| row.inventory.id == "configurations")
            .unwrap_or(stored);
        let pose = |value: &chereme_sign::inventory::InventoryValue| value.hand_pose(&configurations.inventory);
        let usual = HandshapeOptions::default();
        let size = options.height.unwrap_or(usual.size);
        let base_shape = if size <= SMALL_HAND {
            HandshapeOptions::with_small_size(size)
        } else {
            HandshapeOptions { size, ..usual }
        };
        let shape = HandshapeOptions { side, ..base_shape };
        let (image, title, frames) = match value {
            Some(text) => {
                let named_value = stored.inventory.find_inventory_value(text);
                let value_pose = named_value.and_then(|value| Some((value.id.clone(), pose(value)?)));
                let (id, angles) = value_pose.ok_or_else(|| {
                    CorpusError::from_wrong_message(format!("{inventory:?} has no handshape {text:?}"))
                        .with_error_place(text)
                        .with_advice(format!(
                            "near to it: {}",
                            stored.inventory.suggest_value_ids(text).join(", ")
                        ))
                })?;
                (handshape_picture(&angles, &shape).map_err(picture_figure_error)?, id, 1)
            }
            None => {
                let posed: Vec<_> = stored
                    .inventory
                    .values
                    .iter()
                    .filter_map(|value| Some((value.id.clone(), pose(value)?)))
                    .collect();
                if posed.is_empty() {
                    return Err(CorpusError::from_wrong_message(format!(
                        "the values of {inventory:?} have no handshapes"
                    ))
                    .with_error_place(inventory)
                    .with_advice("draw the inventory configurations"));
                }
                let image = handshape_sheet(&posed, 10, &shape).map_err(picture_figure_error)?;
                (image, inventory.to_owned(), posed.len())
            }
        };
        if lowercase_extension(to) != "png" {
            return Err(missing_ending_error(to, "a handshape is drawn to a .png"));
        }
        let bytes = write_atomically(to, options.force, |out| {
            write_png(&image, out).map_err(picture_figure_error)
        })?;
        Ok(picture_report(to, &title, bytes, frames))
    }
}

/// Writes a picture in SVG.
fn write_svg_picture(picture: &str, title: &str, symbols: usize, to: &Path, force: bool) -> CorpusResult<DrawnPicture> {
    let bytes = write_atomically(to, force, |out| {
        out.write_all(picture.as_bytes())
            .map_err(|error| CorpusError::from_file_failure(to, error))
    })?;
    Ok(picture_report(to, title, bytes, symbols))
}

/// Draws a clip to a file; see [`Corpus::draw_movement_file`].
///
/// # Errors
/// As [`Corpus::draw_movement_file`].
pub fn draw_clip(
    performance: DrawablePerformance<'_>,
    title: &str,
    to: &Path,
    options: &PictureOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<DrawnPicture> {
    let full_span = performance.clip.clip_span();
    let captions = match options.captions {
        true => vec![AnimationCaption {
            span: full_span,
            text: title.to_owned(),
        }],
        false => Vec::new(),
    };
    let scene = SideBySideScene {
        performance,
        title,
        captions,
    };
    draw_scenes(&[scene], to, options, progress)
}

/// A movement that is drawn beside others.
struct SideBySideScene<'a> {
    performance: DrawablePerformance<'a>,
    title: &'a str,
    captions: Vec<AnimationCaption>,
}

fn draw_scenes(
    scenes: &[SideBySideScene<'_>],
    to: &Path,
    options: &PictureOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<DrawnPicture> {
    let mut report = |done: usize, total: usize| progress.report_frames("drawing", done, total);
    let kind = lowercase_extension(to);
    let (bytes, frames) = match (kind.as_str(), scenes) {
        ("png", [scene]) => {
            let mut hear = |done: usize, total: usize| match report(done, total) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            };
            sheet(scene, to, options, &mut hear)?
        }
        ("gif", _) => {
            let height = options.height.unwrap_or(MOVEMENT_PICTURE_HEIGHT_PX);
            let mut strip = side_by_side_strip(scenes, options, height, None)?;
            let mut hear = |done: usize, total: usize| match report(done, total) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            };
            let frames = chereme_figure::PictureSequence::picture_count(&strip);
            let bytes = write_atomically(to, options.force, |out| {
                write_gif(&mut strip, out, &mut hear).map_err(picture_figure_error)
            })?;
            (bytes, frames)
        }
        ("mp4", _) => {
            let rate = options.rate.clamp(1, 120);
            let height = options.height.unwrap_or(FILM_HEIGHT_PX);
            let mut strip = side_by_side_strip(scenes, options, height, Some(rate))?;
            let shape = WrittenFilmShape { rate };
            let mut frames = 0;
            let bytes = write_atomically(to, options.force, |out| {
                frames = write_film(&mut strip, shape, out, &mut report)?;
                Ok(())
            })?;
            (bytes, frames)
        }
        _ => {
            return Err(missing_ending_error(
                to,
                "write a contact sheet to .png, an animation to .gif, a film to .mp4, or the notation to .svg",
            ));
        }
    };
    let titles: Vec<&str> = scenes.iter().map(|scene| scene.title).collect();
    Ok(picture_report(to, &titles.join(", "), bytes, frames))
}

/// Draws a contact sheet, and returns its size in bytes and the number of pictures.
fn sheet(
    scene: &SideBySideScene<'_>,
    to: &Path,
    options: &PictureOptions,
    hear: chereme_figure::PictureProgress<'_>,
) -> CorpusResult<(u64, usize)> {
    let DrawablePerformance { clip, anatomy, faces } = scene.performance;
    let mut sheet = SheetOptions {
        title: scene.title.to_owned(),
        frames: chereme_figure::SheetFrames::Spaced(options.frames),
        cell_height: options.height.unwrap_or(MOVEMENT_PICTURE_HEIGHT_PX),
        ..SheetOptions::default()
    };
    if options.hands && BodySide::BOTH_SIDES.iter().any(|&side| anatomy.has_fingers(side)) {
        sheet = sheet.with_hands();
    }
    if options.hands {
        sheet = sheet.with_faces(faces.to_vec());
    } else {
        sheet.faces = faces.to_vec();
    }
    if options.face {
        sheet = sheet.with_face_row();
    }
    let image = contact_sheet(clip, anatomy, &sheet, hear).map_err(picture_figure_error)?;
    let bytes = write_atomically(to, options.force, |out| {
        write_png(&image, out).map_err(picture_figure_error)
    })?;
    Ok((bytes, options.frames.min(clip.clip_frame_count())))
}

/// Returns the pictures of movements side by side: a single one from two sides, several each from the front.
fn side_by_side_strip<'a>(
    scenes: &[SideBySideScene<'a>],
    options: &PictureOptions,
    height: usize,
    rate: Option<u32>,
) -> CorpusResult<AnimationStrip<'a>> {
    let mut views = match scenes {
        [_] => vec![FigureView::Addressee, FigureView::Left],
        _ => vec![FigureView::Addressee],
    };
    if options.face {
        views.push(FigureView::Face);
    }
    let mut cells = Vec::with_capacity(scenes.len());
    for scene in scenes {
        let DrawablePerformance { clip, anatomy, faces } = scene.performance;
        let settings = AnimationOptions {
            views: views.clone(),
            height,
            speed: options.speed,
            rate,
            faces: faces.to_vec(),
            ..AnimationOptions::default()
        };
        let animation = ClipAnimation::new(clip, anatomy, settings).map_err(picture_figure_error)?;
        cells.push((animation, scene.captions.clone()));
    }
    AnimationStrip::new(cells, PaperTheme::Light).map_err(picture_figure_error)
}

/// Fails if the rows that a picture of a stretch shows are not as they were stored.
fn verify_stretch(connection: &Connection, stretch: &RecordingStretch) -> CorpusResult<()> {
    let tokens: Vec<i64> = stretch.token.iter().map(|token| token.id).collect();
    seals::verify_tokens(connection, &tokens)?;
    seals::verify_recordings(connection, &[stretch.recording.id])
}

fn stretch_title(stretch: &RecordingStretch) -> String {
    let start = |at: RecordingInstant| format!("{:.2}", at.instant_seconds());
    match &stretch.token {
        Some(token) => format!(
            "{} - {} {}-{} s",
            token.gloss,
            stretch.recording.name,
            start(stretch.span.span_start_instant()),
            start(stretch.span.span_end_instant())
        ),
        None => stretch.recording.name.clone(),
    }
}

/// Returns the report of a picture of stored movement or of an inventory.
fn picture_report(to: &Path, title: &str, bytes: u64, frames: usize) -> DrawnPicture {
    DrawnPicture {
        path: to.to_owned(),
        title: title.to_owned(),
        bytes,
        frames,
        animated_on: None,
        transcribed: false,
        withheld: Vec::new(),
        for_me: None,
    }
}

fn missing_ending_error(path: &Path, advice: &str) -> CorpusError {
    CorpusError::from_wrong_message("the picture's name has no ending that says its kind")
        .with_error_place(path.display().to_string())
        .with_advice(advice)
}

fn picture_figure_error(error: FigureError) -> CorpusError {
    match error {
        FigureError::Stopped { .. } => CorpusError::Stopped,
        other => CorpusError::from_wrong_message(other.to_string()),
    }
}
