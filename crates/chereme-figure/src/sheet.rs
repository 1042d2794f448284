//! Contact sheets: a clip at a glance, frames from left to right, views from top to bottom.

use std::ops::ControlFlow;

use chereme_motion::{Anatomy, Clip, Face, Side};

use crate::body::Body;
use crate::error::{FigureError, checked_size, checked_view};
use crate::font;
use crate::image::Image;
use crate::mesh::Mesh;
use crate::palette::Palette;
use crate::raster::{Raster, Style};
use crate::view::{Framing, View, signed, stroke};

/// The frames of a clip to show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Frames {
    /// This number of frames, evenly spaced over the signing: from the first to the last frame with a hand up, without
    /// odd frames at both ends; all of these if there are fewer.
    Spaced(usize),
    /// Exactly these frames.
    At(Vec<usize>),
}

/// Options of a contact sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetOptions {
    /// The line above the pictures; empty for no line.
    pub title: String,
    /// The columns.
    pub frames: Frames,
    /// The rows.
    pub views: Vec<View>,
    /// The face of each frame of the clip; on later frames it is at rest.
    pub faces: Vec<Face>,
    /// The height of a cell in pixels, without its label.
    pub cell_height: usize,
    /// The colours of the body.
    pub palette: Palette,
    /// Paper, light and lines.
    pub style: Style,
}

impl Default for SheetOptions {
    fn default() -> Self {
        Self {
            title: String::new(),
            frames: Frames::Spaced(8),
            views: vec![View::Addressee, View::Right],
            faces: Vec::new(),
            cell_height: 260,
            palette: Palette::default(),
            style: Style::default(),
        }
    }
}

impl SheetOptions {
    /// Returns the options with a row for each hand from nearby.
    #[must_use]
    pub fn with_hands(mut self) -> Self {
        self.views.extend(Side::BOTH.map(View::Hand));
        self
    }

    /// Returns the options with a row for the face from nearby, whether it moves or not.
    #[must_use]
    pub fn with_face_row(mut self) -> Self {
        if !self.views.contains(&View::Face) {
            self.views.push(View::Face);
        }
        self
    }

    /// Returns the options with facial expressions, and with a row for the face from nearby if it moves at all.
    #[must_use]
    pub fn with_faces(mut self, faces: Vec<Face>) -> Self {
        if faces.iter().any(|face| !face.is_at_rest()) {
            self = self.with_face_row();
        }
        self.faces = faces;
        self
    }
}

/// A callback between pictures: receives the number of finished pictures and the total.
pub type Progress<'a> = &'a mut dyn FnMut(usize, usize) -> ControlFlow<()>;

/// Height of a line of labels, in pixels.
const LABEL: usize = 18;
/// The gap between cells, in pixels.
const GAP: usize = 6;

/// Draws the contact sheet of `clip`: one row per view, one column per frame, each with its time.
///
/// # Errors
/// [`FigureError`] if the clip is empty, a frame is not in it, the sheet would be too large, or `progress`
/// stops it.
pub fn contact_sheet(
    clip: &Clip,
    anatomy: &Anatomy,
    options: &SheetOptions,
    progress: Progress<'_>,
) -> Result<Image, FigureError> {
    let framing = Framing::of(clip, anatomy).ok_or(FigureError::Empty)?;
    let frames = chosen(&options.frames, clip, anatomy)?;
    if options.views.is_empty() {
        return Err(FigureError::Nothing { what: "view" });
    }
    let wide = options
        .views
        .iter()
        .map(|&view| framing.aspect(view))
        .fold(0.45, f32::max);
    let width = (options.cell_height as f32 * wide.min(1.6)) as usize;
    let cell = checked_view(width, options.cell_height)?;
    let head = if options.title.is_empty() {
        GAP
    } else {
        2 * font::HEIGHT + 2 * GAP
    };
    let size = checked_size(
        frames.len().saturating_mul(cell[0] + GAP) + GAP,
        options.views.len().saturating_mul(cell[1] + GAP) + head + LABEL,
    )?;
    let theme = options.style.theme;
    let mut sheet = Image::new(size[0], size[1], theme.rule());
    sheet.fill([0, 0], [size[0] as i64, head as i64], theme.background());
    let title = font::fitted(&options.title, (size[0] - 2 * GAP) / 2);
    sheet.text(&title, [GAP as i64, GAP as i64], 2, theme.text());

    let body = Body::with_palette(clip.skeleton(), anatomy, &options.palette);
    let mut mesh = Mesh::default();
    let mut raster = Raster::default();
    let total = frames.len() * options.views.len();
    for (column, &frame) in frames.iter().enumerate() {
        let pose = clip.model_pose(frame);
        body.shape(&pose, &mut mesh);
        if let Some(face) = options.faces.get(frame) {
            body.express(&pose, face, &mut mesh);
        }
        let x = GAP + column * (cell[0] + GAP);
        for (row, &view) in options.views.iter().enumerate() {
            let done = column * options.views.len() + row;
            if progress(done, total).is_break() {
                return Err(FigureError::Stopped { done, total });
            }
            let aspect = cell[0] as f32 / cell[1] as f32;
            let camera = framing.camera(view, aspect, &pose, anatomy);
            let mut picture = raster.draw(&mesh, &camera, cell, &options.style);
            if column == 0 {
                let chip = [font::width(view.name()) as i64 + 8, font::HEIGHT as i64 + 3];
                picture.fill([0, 0], chip, theme.background());
                picture.text(view.name(), [4, 0], 1, theme.text());
            }
            sheet.paste(&picture, [x, head + row * (cell[1] + GAP)]);
        }
        let label = label(clip, frame);
        let label = font::fitted(&label, cell[0]);
        let y = head + options.views.len() * (cell[1] + GAP);
        let inset = (cell[0] - font::width(&label).min(cell[0])) / 2;
        sheet.text(&label, [(x + inset) as i64, y as i64], 1, theme.text());
    }
    Ok(sheet)
}

/// Draws one small picture of the stroke of `clip` from the front; `size` is columns and rows.
///
/// # Errors
/// [`FigureError`] if the clip is empty or the picture would be too small or too large.
pub fn thumbnail(
    clip: &Clip,
    anatomy: &Anatomy,
    size: [usize; 2],
    style: &Style,
) -> Result<Image, FigureError> {
    let framing = Framing::of(clip, anatomy).ok_or(FigureError::Empty)?;
    let size = checked_view(size[0], size[1])?;
    let pose = clip.model_pose(stroke(clip, anatomy));
    let mesh = Body::new(clip.skeleton(), anatomy).mesh(&pose);
    let aspect = size[0] as f32 / size[1] as f32;
    let camera = framing.camera(View::Addressee, aspect, &pose, anatomy);
    Ok(Raster::default().draw(&mesh, &camera, size, style))
}

/// The height of a face in the corner of a small picture, as a share of the picture's height.
const INSET: f32 = 0.45;

/// Draws one small picture as [`thumbnail`] does, with the face from nearby in its upper right corner: `faces` are
/// those of the clip's frames, at rest beyond them.
///
/// # Errors
/// The same as [`thumbnail`]'s.
pub fn thumbnail_with_face(
    clip: &Clip,
    anatomy: &Anatomy,
    faces: &[Face],
    size: [usize; 2],
    style: &Style,
) -> Result<Image, FigureError> {
    let framing = Framing::of(clip, anatomy).ok_or(FigureError::Empty)?;
    let size = checked_view(size[0], size[1])?;
    let frame = stroke(clip, anatomy);
    let pose = clip.model_pose(frame);
    let body = Body::new(clip.skeleton(), anatomy);
    let mut mesh = body.mesh(&pose);
    if let Some(face) = faces.get(frame) {
        body.express(&pose, face, &mut mesh);
    }
    let mut raster = Raster::default();
    let mut draw = |view: View, size: [usize; 2]| {
        let aspect = size[0] as f32 / size[1] as f32;
        let camera = framing.camera(view, aspect, &pose, anatomy);
        raster.draw(&mesh, &camera, size, style)
    };
    let mut image = draw(View::Addressee, size);
    let side = (size[1].min(size[0]) as f32 * INSET) as usize;
    if side >= 8 {
        let near = draw(View::Face, [side - 1, side - 1]);
        let left = size[0] - side;
        let rule = style.theme.rule();
        image.fill([left as i64, 0], [side as i64, side as i64], rule);
        image.paste(&near, [left + 1, 0]);
    }
    Ok(image)
}

/// Returns time and number of a frame for its label.
fn label(clip: &Clip, frame: usize) -> String {
    let seconds = clip.rate().instant(frame).seconds();
    format!("{seconds:.2} s  #{frame}")
}

/// Returns the chosen frames.
fn chosen(frames: &Frames, clip: &Clip, anatomy: &Anatomy) -> Result<Vec<usize>, FigureError> {
    let last = clip.frames().checked_sub(1).ok_or(FigureError::Empty)?;
    let chosen = match frames {
        Frames::Spaced(wanted) => {
            let sound = signed(clip, anatomy);
            let (wanted, last) = ((*wanted).min(sound.len()), sound.len().saturating_sub(1));
            (0..wanted)
                .map(|i| (2 * last * i + (wanted - 1)) / (2 * (wanted - 1).max(1)))
                .map(|frame| sound.start + frame)
                .collect()
        }
        Frames::At(frames) => frames.clone(),
    };
    if let Some(&frame) = chosen.iter().find(|&&frame| frame > last) {
        return Err(FigureError::Frame { frame, last });
    }
    if chosen.is_empty() {
        return Err(FigureError::Nothing { what: "frame" });
    }
    Ok(chosen)
}
