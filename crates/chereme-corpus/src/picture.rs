//! Pictures of stored movement and of inventories, drawn without a window.

mod atomic_write;
mod faces;
mod points;
mod svg;
pub mod values;

use std::io::Write;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chereme_figure::{
    Animation, AnimationOptions, Caption, FigureError, HandshapeOptions, SheetOptions, Strip,
    Theme, View, contact_sheet, handshape_picture, handshape_sheet, write_gif, write_png,
};
use chereme_motion::anatomy::Anatomy;
use chereme_motion::{Clip, Face, Instant, Side, Span};
use chereme_sign::hamnosys::{Symbol, drawing};
use rusqlite::Connection;
use serde::Serialize;

use crate::Corpus;
use crate::address::{self, Address, Stretch};
use crate::animate::Staging;
use crate::curves;
use crate::db::{recordings, seals, signs};
use crate::error::{Error, Result};
use crate::face;
use crate::film::{Shape, write_film};
use crate::inventories;
use crate::movement::{ChannelGroup, MotionTrack};
use crate::notation::{self, Notation};
use crate::progress::{Progress, Step, Unit};
use crate::recombine::Recombination;
use crate::sources::notation::own_body;

use atomic_write::extension;
pub(crate) use atomic_write::write;
pub(crate) use svg::write_svg;

/// The height of a film in pixels, and its pictures per second.
const FILM: usize = 540;
const FILM_RATE: u32 = 25;
/// The longest stretch that is drawn, in microseconds: all of its movement is in memory.
const LONGEST: i64 = 1_200_000_000;

/// Returns a span if all of it can be drawn.
fn drawable(span: Span) -> Result<Span> {
    if span.micros() <= LONGEST {
        return Ok(span);
    }
    Err(Error::wrong(format!(
        "the movement lasts {:.0} s, and at most {} s can be drawn at once",
        span.seconds(),
        LONGEST / 1_000_000
    ))
    .advise("name an annotation or a token of it, or store a part of it with a recipe: `| span 0s..600s`"))
}

/// The inventory name for the symbols of HamNoSys.
const SYMBOLS: &str = "hamnosys";
/// The inventory name for the faces of SiGML's non-manuals.
const FACES: &str = "faces";
/// The size in pixels up to which a handshape is drawn in the style for small sizes.
const SMALL_HAND: usize = 160;
/// The height of one picture of movement, in pixels.
const HEIGHT: usize = 260;
/// The height of a notation symbol, in pixels of a scalable picture.
const SYMBOL: f32 = 64.0;

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
        }
    }
}

/// A picture that was drawn.
#[derive(Debug, Clone, Serialize)]
pub struct Picture {
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
}

/// A piece of movement with the data needed to display it.
#[derive(Debug, Clone)]
pub struct Moving {
    /// Its stretch of a recording.
    pub stretch: Stretch,
    /// The movement in metres and model space.
    pub clip: Clip,
    /// The body part of each joint.
    pub anatomy: Anatomy,
    /// The face in each frame, if curves of non-manuals give it; otherwise empty.
    pub faces: Vec<Face>,
}

/// Movement in the form for drawing.
#[derive(Debug, Clone, Copy)]
pub struct Performance<'a> {
    /// The movement.
    pub clip: &'a Clip,
    /// The body part of each joint.
    pub anatomy: &'a Anatomy,
    /// The face in each frame; frames beyond them have a face at rest.
    pub faces: &'a [Face],
}

impl<'a> From<&'a Moving> for Performance<'a> {
    fn from(moving: &'a Moving) -> Self {
        Self {
            clip: &moving.clip,
            anatomy: &moving.anatomy,
            faces: &moving.faces,
        }
    }
}

impl<'a> From<&'a Recombination> for Performance<'a> {
    fn from(made: &'a Recombination) -> Self {
        Self {
            clip: &made.clip,
            anatomy: &made.anatomy,
            faces: &made.faces,
        }
    }
}

/// Returns the body that comes with the program: a single frame at rest, with the body part of each joint.
///
/// # Errors
/// Fails if the program's own file is damaged.
pub fn built_in_body() -> Result<(Clip, Arc<Anatomy>)> {
    let body = own_body()?;
    Ok((body.clip, body.anatomy))
}

impl Corpus {
    /// Returns the movement at an address: a token's span, a recording, a sign's citation form.
    ///
    /// # Errors
    /// Fails if nothing has that address, if several things have it, or if it has no movement.
    pub fn movement(&self, address: &Address) -> Result<Moving> {
        self.movement_in(address, None, &ChannelGroup::ALL)
    }

    /// Returns part of the movement at an address: a span of the recording, and some channel groups; joints of other
    /// groups stay at rest.
    ///
    /// # Errors
    /// As [`movement`](Self::movement).
    pub fn movement_in(
        &self,
        address: &Address,
        span: Option<Span>,
        groups: &[ChannelGroup],
    ) -> Result<Moving> {
        let connection = self.store.read();
        let mut stretch = address::stretch(connection, address)?;
        stretch.span = match span {
            Some(span) => stretch.span.intersection(span).unwrap_or_default(),
            None => stretch.span,
        };
        if let Some(moving) = face::stage::moving(connection, &stretch)? {
            return Ok(moving);
        }
        let track = MotionTrack::of(connection, stretch.recording.id)?;
        let frames = track.frames_in(stretch.span);
        let clip = track.clip(connection, frames.clone(), groups)?;
        // A word is mouthed over its whole curve, even if only a part of it is displayed.
        let curves = curves::of_track(connection, &track, 0..track.frames())?;
        let faces = chereme_compose::faces(&curves);
        let faces = faces.get(frames).map(<[Face]>::to_vec).unwrap_or_default();
        Ok(Moving {
            clip,
            faces,
            anatomy: track.anatomy(connection)?,
            stretch,
        })
    }

    /// Draws movement to a file: a contact sheet for `.png`, an animation for `.gif`, a film for `.mp4`. A sign that
    /// has only a notation is animated on the body that the corpus chooses. For `.svg` the notation itself is drawn,
    /// symbol by symbol; for a sign without one, the transcription of its movement.
    ///
    /// # Errors
    /// Fails if there is nothing to draw, the file has another ending, or it exists already.
    pub fn draw(
        &mut self,
        address: &Address,
        to: &Path,
        options: &PictureOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Picture> {
        let connection = self.store.read();
        if extension(to) == "svg" {
            return self.draw_symbols(address, to, options.force, progress);
        }
        let stretch = match address::stretch(connection, address) {
            Ok(stretch) => stretch,
            Err(error) => {
                let Ok(notated) = notation::find(connection, address) else {
                    return Err(error);
                };
                return self.draw_notated(&notated, to, options, progress);
            }
        };
        verify_stretch(connection, &stretch)?;
        let span = drawable(self.usable_span(&stretch)?)?;
        // A face from points on film is shown on the program's own body.
        let own = options.face && face::has_face(connection, stretch.recording.id)?;
        if !own
            && recordings::body_track(connection, stretch.recording.id)?.is_none()
            && let Some(points) = points::of(connection, &stretch, span)?
        {
            return points::draw(&points, &title(&stretch), to, options, progress);
        }
        let moving = self.movement_in(address, Some(span), &ChannelGroup::ALL)?;
        let title = title(&moving.stretch);
        let captions = match options.captions {
            true => self.captions(&moving.stretch)?,
            false => Vec::new(),
        };
        let scene = Scene {
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
    /// As [`draw`](Self::draw); also fails if one of them has no movement, or the file has another ending.
    pub fn draw_together(
        &mut self,
        addresses: &[Address],
        to: &Path,
        options: &PictureOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Picture> {
        if let [one] = addresses {
            return self.draw(one, to, options, progress);
        }
        if !matches!(extension(to).as_str(), "gif" | "mp4") {
            return Err(
                Error::wrong("such a picture shows one movement, and several are named")
                    .at(to.display().to_string())
                    .advise("several movements are drawn next to each other to an .mp4 or a .gif"),
            );
        }
        let mut all = Vec::with_capacity(addresses.len());
        for address in addresses {
            let stretch = address::stretch(self.store.read(), address)?;
            verify_stretch(self.store.read(), &stretch)?;
            let span = drawable(self.usable_span(&stretch)?)?;
            let moving = self.movement_in(address, Some(span), &ChannelGroup::ALL)?;
            let captions = match options.captions {
                true => self.captions(&moving.stretch)?,
                false => Vec::new(),
            };
            all.push((title(&moving.stretch), captions, moving));
        }
        let scenes: Vec<Scene<'_>> = all
            .iter()
            .map(|(title, captions, moving)| Scene {
                performance: moving.into(),
                title,
                captions: captions.clone(),
            })
            .collect();
        draw_scenes(&scenes, to, options, progress)
    }

    /// Returns the glosses in a stretch as captions, on the clock of its movement.
    fn captions(&self, stretch: &Stretch) -> Result<Vec<Caption>> {
        let from = stretch.span.start().micros();
        let caption = |text: &str, span: Span| Caption {
            span: span.shifted(-from),
            text: text.to_owned(),
        };
        if let Some(token) = &stretch.token {
            // The last picture may lie a fraction of a frame later, and is held.
            let end = stretch.span.end().shifted(1_000_000);
            let whole = Span::between(stretch.span.start(), end);
            return Ok(vec![caption(&token.gloss, whole)]);
        }
        let tokens = signs::tokens_of_recording(self.store.read(), stretch.recording.id)?;
        let numbers: Vec<i64> = tokens.iter().map(|token| token.id).collect();
        seals::verify_tokens(self.store.read(), &numbers)?;
        let spans = tokens.iter().filter_map(|token| {
            let (start, end) = (token.start_us?, token.end_us?);
            let span = Span::between(Instant::from_micros(start), Instant::from_micros(end));
            let within = span.intersection(stretch.span)?;
            Some(caption(&token.gloss, within))
        });
        Ok(spans.collect())
    }

    /// Draws the symbols of a notation to an SVG: the stored notation, otherwise a transcription of the movement.
    fn draw_symbols(
        &self,
        address: &Address,
        to: &Path,
        force: bool,
        progress: &mut Progress<'_>,
    ) -> Result<Picture> {
        let connection = self.store.read();
        let (title, text, transcribed) = match notation::find(connection, address) {
            Ok(found) => {
                seals::verify_tokens(connection, &[found.token])?;
                let text = found.text.unwrap_or_else(|| found.document.hamnosys().text);
                (found.document.gloss, text, false)
            }
            Err(error) => {
                if let Ok(stretch) = address::stretch(connection, address) {
                    verify_stretch(connection, &stretch)?;
                }
                match self.transcribe(address, progress) {
                    Ok(written) => (written.gloss, written.hamnosys, true),
                    Err(Error::Stopped) => return Err(Error::Stopped),
                    Err(_) => return Err(error),
                }
            }
        };
        let unknown = || Error::wrong("the notation holds what is no symbol").at(&title);
        let symbols = drawing::drawn(&text).ok_or_else(unknown)?.len();
        let picture = drawing::svg(&text, SYMBOL).ok_or_else(unknown)?;
        Ok(Picture {
            transcribed,
            ..written(&picture, &title, symbols, to, force)?
        })
    }

    fn draw_notated(
        &mut self,
        notated: &Notation,
        to: &Path,
        options: &PictureOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Picture> {
        seals::verify_tokens(self.store.read(), &[notated.token])?;
        let body = self.chosen_body()?;
        let name = format!("token:{}", notated.token);
        let staging = Staging {
            signer: Some(&body),
            language: None,
        };
        let done = self.animate(&[&name], &staging, None)?;
        let title = &notated.document.gloss;
        let picture = draw_clip((&done).into(), title, to, options, progress)?;
        Ok(Picture {
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
        side: Side,
        to: &Path,
        options: &PictureOptions,
    ) -> Result<Picture> {
        if inventory == SYMBOLS && value.is_none() {
            if extension(to) != "svg" {
                return Err(ending(to, "the symbols of HamNoSys are drawn to an .svg"));
            }
            let chart = drawing::chart();
            return written(&chart, SYMBOLS, Symbol::all().len(), to, options.force);
        }
        if inventory == FACES && value.is_none() {
            return faces::draw(to, options);
        }
        seals::verify_tables(self.store.read(), ["inventory", "inventory_value"])?;
        let all = inventories::load(self.store.read())?;
        let ids: Vec<&str> = all.iter().map(|it| it.inventory.id.as_str()).collect();
        let stored = all
            .iter()
            .find(|it| it.inventory.id == inventory)
            .ok_or_else(|| {
                Error::wrong(format!("no inventory is called {inventory:?}"))
                    .at(inventory)
                    .advise(format!("the inventories are: {}", ids.join(", ")))
            })?;
        let configurations = all
            .iter()
            .find(|it| it.inventory.id == "configurations")
            .unwrap_or(stored);
        let pose = |value: &chereme_sign::inventory::InventoryValue| {
            value.hand_pose(&configurations.inventory)
        };
        let usual = HandshapeOptions::default();
        let size = options.height.unwrap_or(usual.size);
        let shape = if size <= SMALL_HAND {
            HandshapeOptions::small(size)
        } else {
            HandshapeOptions { size, ..usual }
        };
        let shape = HandshapeOptions { side, ..shape };
        let (image, title, frames) = match value {
            Some(text) => {
                let found = stored.inventory.find(text);
                let found = found.and_then(|value| Some((value.id.clone(), pose(value)?)));
                let (id, angles) = found.ok_or_else(|| {
                    Error::wrong(format!("{inventory:?} has no handshape {text:?}"))
                        .at(text)
                        .advise(format!(
                            "near to it: {}",
                            stored.inventory.suggest(text).join(", ")
                        ))
                })?;
                (handshape_picture(&angles, &shape).map_err(figure)?, id, 1)
            }
            None => {
                let posed: Vec<_> = stored
                    .inventory
                    .values
                    .iter()
                    .filter_map(|value| Some((value.id.clone(), pose(value)?)))
                    .collect();
                if posed.is_empty() {
                    return Err(Error::wrong(format!(
                        "the values of {inventory:?} have no handshapes"
                    ))
                    .at(inventory)
                    .advise("draw the inventory configurations"));
                }
                let image = handshape_sheet(&posed, 10, &shape).map_err(figure)?;
                (image, inventory.to_owned(), posed.len())
            }
        };
        if extension(to) != "png" {
            return Err(ending(to, "a handshape is drawn to a .png"));
        }
        let bytes = write(to, options.force, |out| {
            write_png(&image, out).map_err(figure)
        })?;
        Ok(picture_report(to, &title, bytes, frames))
    }
}

/// Writes a picture in SVG.
fn written(picture: &str, title: &str, symbols: usize, to: &Path, force: bool) -> Result<Picture> {
    let bytes = write(to, force, |out| {
        out.write_all(picture.as_bytes())
            .map_err(|error| Error::file(to, error))
    })?;
    Ok(picture_report(to, title, bytes, symbols))
}

/// Draws a clip to a file; see [`Corpus::draw`].
///
/// # Errors
/// As [`Corpus::draw`].
pub fn draw_clip(
    performance: Performance<'_>,
    title: &str,
    to: &Path,
    options: &PictureOptions,
    progress: &mut Progress<'_>,
) -> Result<Picture> {
    let whole = performance.clip.span();
    let captions = match options.captions {
        true => vec![Caption {
            span: whole,
            text: title.to_owned(),
        }],
        false => Vec::new(),
    };
    let scene = Scene {
        performance,
        title,
        captions,
    };
    draw_scenes(&[scene], to, options, progress)
}

/// A movement that is drawn beside others.
struct Scene<'a> {
    performance: Performance<'a>,
    title: &'a str,
    captions: Vec<Caption>,
}

fn draw_scenes(
    scenes: &[Scene<'_>],
    to: &Path,
    options: &PictureOptions,
    progress: &mut Progress<'_>,
) -> Result<Picture> {
    let mut report = |done: usize, total: usize| {
        progress.report(Step {
            task: "drawing",
            done: done as u64,
            total: Some(total as u64),
            unit: Unit::Frames,
        })
    };
    let kind = extension(to);
    let (bytes, frames) = match (kind.as_str(), scenes) {
        ("png", [scene]) => {
            let mut hear = |done: usize, total: usize| match report(done, total) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            };
            sheet(scene, to, options, &mut hear)?
        }
        ("gif", _) => {
            let height = options.height.unwrap_or(HEIGHT);
            let mut strip = strip(scenes, options, (height, None))?;
            let mut hear = |done: usize, total: usize| match report(done, total) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            };
            let frames = chereme_figure::Pictures::frames(&strip);
            let bytes = write(to, options.force, |out| {
                write_gif(&mut strip, out, &mut hear).map_err(figure)
            })?;
            (bytes, frames)
        }
        ("mp4", _) => {
            let rate = options.rate.clamp(1, 120);
            let height = options.height.unwrap_or(FILM);
            let mut strip = strip(scenes, options, (height, Some(rate)))?;
            let shape = Shape { rate };
            let mut frames = 0;
            let bytes = write(to, options.force, |out| {
                frames = write_film(&mut strip, shape, out, &mut report)?;
                Ok(())
            })?;
            (bytes, frames)
        }
        _ => {
            return Err(ending(
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
    scene: &Scene<'_>,
    to: &Path,
    options: &PictureOptions,
    hear: chereme_figure::Progress<'_>,
) -> Result<(u64, usize)> {
    let Performance {
        clip,
        anatomy,
        faces,
    } = scene.performance;
    let mut sheet = SheetOptions {
        title: scene.title.to_owned(),
        frames: chereme_figure::Frames::Spaced(options.frames),
        cell_height: options.height.unwrap_or(HEIGHT),
        ..SheetOptions::default()
    };
    if options.hands && Side::BOTH.iter().any(|&side| anatomy.has_fingers(side)) {
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
    let image = contact_sheet(clip, anatomy, &sheet, hear).map_err(figure)?;
    let bytes = write(to, options.force, |out| {
        write_png(&image, out).map_err(figure)
    })?;
    Ok((bytes, options.frames.min(clip.frames())))
}

/// Returns the pictures of movements side by side: a single one from two sides, several each from the front.
fn strip<'a>(
    scenes: &[Scene<'a>],
    options: &PictureOptions,
    (height, rate): (usize, Option<u32>),
) -> Result<Strip<'a>> {
    let mut views = match scenes {
        [_] => vec![View::Addressee, View::Left],
        _ => vec![View::Addressee],
    };
    if options.face {
        views.push(View::Face);
    }
    let mut cells = Vec::with_capacity(scenes.len());
    for scene in scenes {
        let Performance {
            clip,
            anatomy,
            faces,
        } = scene.performance;
        let settings = AnimationOptions {
            views: views.clone(),
            height,
            speed: options.speed,
            rate,
            faces: faces.to_vec(),
            ..AnimationOptions::default()
        };
        let animation = Animation::new(clip, anatomy, settings).map_err(figure)?;
        cells.push((animation, scene.captions.clone()));
    }
    Strip::new(cells, Theme::Light).map_err(figure)
}

/// Fails if the rows that a picture of a stretch shows are not as they were stored.
fn verify_stretch(connection: &Connection, stretch: &Stretch) -> Result<()> {
    let tokens: Vec<i64> = stretch.token.iter().map(|token| token.id).collect();
    seals::verify_tokens(connection, &tokens)?;
    seals::verify_recordings(connection, &[stretch.recording.id])
}

fn title(stretch: &Stretch) -> String {
    let start = |at: Instant| format!("{:.2}", at.seconds());
    match &stretch.token {
        Some(token) => format!(
            "{} - {} {}-{} s",
            token.gloss,
            stretch.recording.name,
            start(stretch.span.start()),
            start(stretch.span.end())
        ),
        None => stretch.recording.name.clone(),
    }
}

/// Returns the report of a picture of stored movement or of an inventory.
fn picture_report(to: &Path, title: &str, bytes: u64, frames: usize) -> Picture {
    Picture {
        path: to.to_owned(),
        title: title.to_owned(),
        bytes,
        frames,
        animated_on: None,
        transcribed: false,
    }
}

fn ending(path: &Path, advice: &str) -> Error {
    Error::wrong("the picture's name has no ending that says its kind")
        .at(path.display().to_string())
        .advise(advice)
}

fn figure(error: FigureError) -> Error {
    match error {
        FigureError::Stopped { .. } => Error::Stopped,
        other => Error::wrong(other.to_string()),
    }
}
