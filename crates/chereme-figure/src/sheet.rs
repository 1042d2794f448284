//! Contact sheets: a clip at a glance, frames from left to right, views from top to bottom.

use std::ops::ControlFlow;

use chereme_motion::{BodyAnatomy, BodySide, Clip, FacePosture};

use crate::body::SignerBody;
use crate::error::{FigureError, checked_size, checked_view};
use crate::font;
use crate::image::RasterImage;
use crate::mesh::TriangleMesh;
use crate::palette::{FigurePalette, PaperTheme};
use crate::raster::{FigureRaster, FigureStyle};
use crate::view::{ClipFraming, FigureView, active_signing_frames, stroke_frame};

/// The frames of a clip to show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SheetFrames {
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
    pub frames: SheetFrames,
    /// The rows.
    pub views: Vec<FigureView>,
    /// The face of each frame of the clip; on later frames it is at rest.
    pub faces: Vec<FacePosture>,
    /// The height of a cell in pixels, without its label.
    pub cell_height: usize,
    /// The colours of the body.
    pub palette: FigurePalette,
    /// Paper, light and lines.
    pub style: FigureStyle,
}

impl Default for SheetOptions {
    fn default() -> Self {
        Self {
            title: String::new(),
            frames: SheetFrames::Spaced(8),
            views: vec![FigureView::Addressee, FigureView::Right],
            faces: Vec::new(),
            cell_height: 260,
            palette: FigurePalette::default(),
            style: FigureStyle::default(),
        }
    }
}

impl SheetOptions {
    /// Returns the options with a row for each hand from nearby.
    #[must_use]
    pub fn with_hands(mut self) -> Self {
        self.views.extend(BodySide::BOTH_SIDES.map(FigureView::Hand));
        self
    }

    /// Returns the options with a row for the face from nearby, whether it moves or not.
    #[must_use]
    pub fn with_face_row(mut self) -> Self {
        if !self.views.contains(&FigureView::Face) {
            self.views.push(FigureView::Face);
        }
        self
    }

    /// Returns the options with facial expressions, and with a row for the face from nearby if it moves at all.
    #[must_use]
    pub fn with_faces(mut self, faces: Vec<FacePosture>) -> Self {
        if faces.iter().any(|face| !face.is_at_rest()) {
            self = self.with_face_row();
        }
        self.faces = faces;
        self
    }
}

/// A callback between pictures: receives the number of finished pictures and the total.
pub type PictureProgress<'a> = &'a mut dyn FnMut(usize, usize) -> ControlFlow<()>;

/// Height of a line of labels, in pixels.
const SHEET_LABEL_HEIGHT_PIXELS: usize = 18;
/// The gap between cells, in pixels.
const SHEET_CELL_GAP_PIXELS: usize = 6;

/// Draws the contact sheet of `clip`: one row per view, one column per frame, each with its time.
///
/// # Errors
/// [`FigureError`] if the clip is empty, a frame is not in it, the sheet would be too large, or `progress`
/// stops it.
pub fn contact_sheet(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    options: &SheetOptions,
    progress: PictureProgress<'_>,
) -> Result<RasterImage, FigureError> {
    let framing = ClipFraming::framing_from_clip(clip, anatomy).ok_or(FigureError::Empty)?;
    let frames = choose_sheet_frames(&options.frames, clip, anatomy)?;
    if options.views.is_empty() {
        return Err(FigureError::Nothing { what: "view" });
    }
    let wide = options
        .views
        .iter()
        .map(|&view| framing.framing_view_aspect(view))
        // The widest view decides, since all cells have one size.
        .fold(0.45, f32::max);
    let width = (options.cell_height as f32 * wide.min(1.6)) as usize;
    let cell = checked_view(width, options.cell_height)?;
    let head = if options.title.is_empty() {
        SHEET_CELL_GAP_PIXELS
    } else {
        2 * font::CELL_HEIGHT_DOTS + 2 * SHEET_CELL_GAP_PIXELS
    };
    let size = checked_size(
        frames.len().saturating_mul(cell[0] + SHEET_CELL_GAP_PIXELS) + SHEET_CELL_GAP_PIXELS,
        options.views.len().saturating_mul(cell[1] + SHEET_CELL_GAP_PIXELS) + head + SHEET_LABEL_HEIGHT_PIXELS,
    )?;
    let theme = options.style.theme;
    let mut sheet = RasterImage::new(size[0], size[1], theme.rule_colour());
    sheet.fill_image_rectangle([0, 0], [size[0] as i64, head as i64], theme.theme_paper_colour());
    let title = font::fit_text_width(&options.title, (size[0] - 2 * SHEET_CELL_GAP_PIXELS) / 2);
    sheet.draw_image_text(
        &title,
        [SHEET_CELL_GAP_PIXELS as i64, SHEET_CELL_GAP_PIXELS as i64],
        2,
        theme.theme_text_colour(),
    );

    let body = SignerBody::with_palette(clip.clip_skeleton(), anatomy, &options.palette);
    let mut mesh = TriangleMesh::default();
    let mut raster = FigureRaster::default();
    let total = frames.len() * options.views.len();
    for (column, &frame) in frames.iter().enumerate() {
        let pose = clip.model_pose(frame);
        body.shape_body_mesh(&pose, &mut mesh);
        if let Some(face) = options.faces.get(frame) {
            body.apply_face_expression(&pose, face, &mut mesh);
        }
        let x = SHEET_CELL_GAP_PIXELS + column * (cell[0] + SHEET_CELL_GAP_PIXELS);
        for (row, &view) in options.views.iter().enumerate() {
            let done = column * options.views.len() + row;
            if progress(done, total).is_break() {
                return Err(FigureError::Stopped { done, total });
            }
            let aspect = cell[0] as f32 / cell[1] as f32;
            let camera = framing.framing_camera(view, aspect, &pose, anatomy);
            let mut picture = raster.draw_mesh_picture(&mesh, &camera, cell, &options.style);
            if column == 0 {
                draw_view_name(&mut picture, view, theme);
            }
            sheet.paste_image(&picture, [x, head + row * (cell[1] + SHEET_CELL_GAP_PIXELS)]);
        }
        let frame_label = sheet_frame_label(clip, frame);
        let y = head + options.views.len() * (cell[1] + SHEET_CELL_GAP_PIXELS);
        draw_column_label(&mut sheet, &frame_label, [x, y], cell[0], theme);
    }
    Ok(sheet)
}

/// Names the view of a picture in its corner.
pub(crate) fn draw_view_name(picture: &mut RasterImage, view: FigureView, theme: PaperTheme) {
    let name = view.figure_view_name();
    let chip = [
        font::text_width_dots(name) as i64 + 8,
        font::CELL_HEIGHT_DOTS as i64 + 3,
    ];
    picture.fill_image_rectangle([0, 0], chip, theme.theme_paper_colour());
    picture.draw_image_text(name, [4, 0], 1, theme.theme_text_colour());
}

/// Writes a text in the middle below a column `width` pixels wide, whose lower left corner is given.
pub(crate) fn draw_column_label(
    sheet: &mut RasterImage,
    text: &str,
    [x, y]: [usize; 2],
    width: usize,
    theme: PaperTheme,
) {
    let label = font::fit_text_width(text, width);
    let inset = (width - font::text_width_dots(&label).min(width)) / 2;
    sheet.draw_image_text(&label, [(x + inset) as i64, y as i64], 1, theme.theme_text_colour());
}

/// Draws one small picture of the stroke of `clip` from the front; `size` is columns and rows.
///
/// # Errors
/// [`FigureError`] if the clip is empty or the picture would be too small or too large.
pub fn clip_thumbnail(
    clip: &Clip,
    anatomy: &BodyAnatomy,
    size: [usize; 2],
    style: &FigureStyle,
) -> Result<RasterImage, FigureError> {
    let framing = ClipFraming::framing_from_clip(clip, anatomy).ok_or(FigureError::Empty)?;
    let size = checked_view(size[0], size[1])?;
    let pose = clip.model_pose(stroke_frame(clip, anatomy));
    let mesh = SignerBody::new(clip.clip_skeleton(), anatomy).posed_mesh(&pose);
    let aspect = size[0] as f32 / size[1] as f32;
    let camera = framing.framing_camera(FigureView::Addressee, aspect, &pose, anatomy);
    Ok(FigureRaster::default().draw_mesh_picture(&mesh, &camera, size, style))
}

/// Returns time and number of a frame for its label.
fn sheet_frame_label(clip: &Clip, frame: usize) -> String {
    let seconds = clip.clip_frame_rate().frame_start_instant(frame).instant_seconds();
    format!("{seconds:.2} s  #{frame}")
}

/// Returns the chosen frames.
fn choose_sheet_frames(frames: &SheetFrames, clip: &Clip, anatomy: &BodyAnatomy) -> Result<Vec<usize>, FigureError> {
    let last = clip.clip_frame_count().checked_sub(1).ok_or(FigureError::Empty)?;
    let chosen = match frames {
        SheetFrames::Spaced(wanted) => {
            let sound = active_signing_frames(clip, anatomy);
            let (wanted, last) = ((*wanted).min(sound.len()), sound.len().saturating_sub(1));
            (0..wanted)
                // Rounded to the nearest frame, where a plain division would round down.
                .map(|i| (2 * last * i + (wanted - 1)) / (2 * (wanted - 1).max(1)))
                .map(|frame| sound.start + frame)
                .collect()
        }
        SheetFrames::At(frames) => frames.clone(),
    };
    if let Some(&frame) = chosen.iter().find(|&&frame| frame > last) {
        return Err(FigureError::Frame { frame, last });
    }
    if chosen.is_empty() {
        return Err(FigureError::Nothing { what: "frame" });
    }
    Ok(chosen)
}
