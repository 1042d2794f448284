//! Animations: a clip from one or more sides at once, and their GIF.
//!
//! Frames are drawn and written one at a time, so that a long clip needs no more memory than a short one.

use std::borrow::Cow;
use std::io::Write;
use std::ops::ControlFlow;

use chereme_motion::ends::ClipEnds;
use chereme_motion::{BodyAnatomy, Clip, FacePosture, ModelPose, RecordingInstant};

use crate::body::SignerBody;
use crate::error::{ANIMATION_SPEEDS, FigureError, MAX_FRAMES, checked_size, checked_view};
use crate::image::RasterImage;
use crate::mesh::TriangleMesh;
use crate::palette::FigurePalette;
use crate::quantize::ColourQuantizer;
use crate::raster::{FigureRaster, FigureStyle};
use crate::sheet::PictureProgress;
use crate::view::{ClipFraming, FigureView};

/// Options of an animation.
#[derive(Debug, Clone, PartialEq)]
pub struct AnimationOptions {
    /// The views, side by side from the left.
    pub views: Vec<FigureView>,
    /// The face of each frame of the clip; on later frames it is at rest.
    pub faces: Vec<FacePosture>,
    /// The height in pixels.
    pub height: usize,
    /// Duration of each picture in hundredths of a second, 1 to 100; 4 gives 25 pictures per second.
    pub centiseconds: u16,
    /// Pictures per second, for films; it overrides `centiseconds`, the unit of GIFs.
    pub rate: Option<u32>,
    /// Playback speed, one of [`ANIMATION_SPEEDS`]; 0.5 is half the original speed.
    pub speed: f64,
    /// The colours of the body.
    pub palette: FigurePalette,
    /// Paper, light and lines.
    pub style: FigureStyle,
    /// The space that the pictures show; by default that of the clip's own signing.
    pub framing: Option<ClipFraming>,
    /// Whether a bar at the lower edge shows how much was played.
    pub bar: bool,
}

impl Default for AnimationOptions {
    fn default() -> Self {
        Self {
            views: vec![FigureView::Addressee, FigureView::Right],
            faces: Vec::new(),
            height: 360,
            centiseconds: 4,
            rate: None,
            speed: 1.0,
            palette: FigurePalette::default(),
            style: FigureStyle::default(),
            framing: None,
            bar: true,
        }
    }
}

impl AnimationOptions {
    /// Returns the height of the progress bar in pixels.
    fn progress_bar_height(&self) -> usize {
        if self.bar { PROGRESS_BAR_HEIGHT_PX } else { 0 }
    }

    /// Returns the time for which a picture is shown, in seconds.
    fn picture_seconds(&self) -> f64 {
        match self.rate {
            Some(rate) => 1.0 / f64::from(rate.clamp(1, 240)),
            None => f64::from(self.centiseconds.clamp(1, 100)) / 100.0,
        }
    }
}

/// A sequence of pictures that are drawn one at a time.
pub trait PictureSequence {
    /// Returns the number of pictures.
    fn picture_count(&self) -> usize;

    /// Returns width and height of each picture in pixels.
    fn picture_size(&self) -> [usize; 2];

    /// Returns the time for which each picture is shown in a GIF, in hundredths of a second.
    fn centiseconds(&self) -> u16;

    /// Draws one picture.
    fn draw_sequence_picture(&mut self, frame: usize) -> RasterImage;
}

impl PictureSequence for ClipAnimation<'_> {
    fn picture_count(&self) -> usize {
        self.animation_frame_count()
    }

    fn picture_size(&self) -> [usize; 2] {
        self.animation_size()
    }

    fn centiseconds(&self) -> u16 {
        self.options.centiseconds.clamp(1, 100)
    }

    fn draw_sequence_picture(&mut self, frame: usize) -> RasterImage {
        self.draw_animation_frame(frame)
    }
}

/// An animation whose pictures are drawn on demand, in any order.
pub struct ClipAnimation<'a> {
    clip: &'a Clip,
    anatomy: &'a BodyAnatomy,
    framing: ClipFraming,
    body: SignerBody,
    options: AnimationOptions,
    /// The width of each view's column in pixels.
    columns: Vec<usize>,
    size: [usize; 2],
    frames: usize,
    start: RecordingInstant,
    mesh: TriangleMesh,
    raster: FigureRaster,
    pose: Option<ModelPose>,
}

/// Height of the progress bar, in pixels.
const PROGRESS_BAR_HEIGHT_PX: usize = 4;

impl<'a> ClipAnimation<'a> {
    /// Returns the animation of `clip`, without odd frames at its ends.
    ///
    /// # Errors
    /// [`FigureError`] if the clip is empty, no view is requested, pictures would be too large or too
    /// many, or the speed is not one of [`ANIMATION_SPEEDS`].
    pub fn new(clip: &'a Clip, anatomy: &'a BodyAnatomy, options: AnimationOptions) -> Result<Self, FigureError> {
        // Computed even if a framing is given, since it refuses an empty clip.
        let clip_framing = ClipFraming::framing_from_clip(clip, anatomy).ok_or(FigureError::Empty)?;
        let framing = options.framing.unwrap_or(clip_framing);
        if options.views.is_empty() {
            return Err(FigureError::Nothing { what: "view" });
        }
        let room = options.height.saturating_sub(options.progress_bar_height());
        // Very narrow and very wide columns would leave no room for the others.
        let width = |&view: &FigureView| (framing.framing_view_aspect(view).clamp(0.45, 2.0) * room as f32) as usize;
        let columns: Vec<usize> = options.views.iter().map(width).collect();
        for &column in &columns {
            checked_view(column, options.height)?;
        }
        let size = checked_size(columns.iter().sum(), options.height)?;
        if !ANIMATION_SPEEDS.contains(&options.speed) {
            return Err(FigureError::Speed { speed: options.speed });
        }
        let sound = clip
            .clip_frame_rate()
            .frame_range_span(ClipEnds::examine_clip_ends(clip, anatomy).sound);
        // At half speed a picture shows half the time of the clip.
        let step = options.picture_seconds() * options.speed;
        let frames = ((sound.span_seconds() / step).ceil() as usize).max(1);
        if frames > MAX_FRAMES {
            return Err(FigureError::Long { frames });
        }
        Ok(Self {
            body: SignerBody::with_palette(clip.clip_skeleton(), anatomy, &options.palette),
            mesh: TriangleMesh::default(),
            raster: FigureRaster::default(),
            pose: None,
            clip,
            anatomy,
            framing,
            start: sound.span_start_instant(),
            options,
            columns,
            size,
            frames,
        })
    }

    /// Returns the number of pictures, at least one.
    #[must_use]
    pub fn animation_frame_count(&self) -> usize {
        self.frames
    }

    /// Returns width and height in pixels.
    #[must_use]
    pub fn animation_size(&self) -> [usize; 2] {
        self.size
    }

    /// Returns the time in the clip that picture `frame` shows.
    #[must_use]
    pub fn frame_clip_instant(&self, frame: usize) -> RecordingInstant {
        let step = self.options.picture_seconds() * self.options.speed;
        let from = RecordingInstant::from_seconds(frame as f64 * step);
        from.shifted_instant(self.start.instant_micros())
    }

    /// Draws picture `frame`.
    #[must_use]
    pub fn draw_animation_frame(&mut self, frame: usize) -> RasterImage {
        let instant = self.frame_clip_instant(frame);
        let local = self.clip.sample_pose(instant);
        let skeleton = self.clip.clip_skeleton();
        // The posture's buffers are reused from picture to picture.
        match &mut self.pose {
            Some(pose) => pose.set_local_pose(skeleton, &local),
            none => *none = Some(ModelPose::from_local_pose(skeleton, &local)),
        }
        let theme = self.options.style.theme;
        let mut image = RasterImage::new(self.size[0], self.size[1], theme.theme_paper_colour());
        let Some(pose) = &self.pose else {
            return image;
        };
        self.body.shape_body_mesh(pose, &mut self.mesh);
        // Frames beyond the list of faces are at rest, as the mesh is already.
        if let Some(face) = FacePosture::face_at_moment(&self.options.faces, self.clip.clip_frame_rate(), instant) {
            self.body.apply_face_expression(pose, &face, &mut self.mesh);
        }
        let room = self.size[1] - self.options.progress_bar_height();
        let mut x = 0;
        for (&view, &width) in self.options.views.iter().zip(&self.columns) {
            let camera = self
                .framing
                .framing_camera(view, width as f32 / room as f32, pose, self.anatomy);
            let picture = self
                .raster
                .draw_mesh_picture(&self.mesh, &camera, [width, room], &self.options.style);
            image.paste_image(&picture, [x, 0]);
            if x > 0 {
                image.fill_image_rectangle([x as i64, 0], [1, room as i64], theme.rule_colour());
            }
            x += width;
        }
        if self.options.bar {
            let played = self.size[0] * (frame + 1) / self.frames;
            let bar = |width: usize| [width as i64, PROGRESS_BAR_HEIGHT_PX as i64];
            image.fill_image_rectangle([0, room as i64], bar(self.size[0]), theme.rule_colour());
            image.fill_image_rectangle([0, room as i64], bar(played), theme.theme_text_colour());
        }
        image
    }
}

/// The number of pictures from which the colours of a GIF are chosen.
const GIF_SAMPLED_PICTURES: usize = 12;

/// Writes an animation as a GIF that repeats for ever, in colours chosen from pictures all over it; each
/// picture stores only its changes.
///
/// # Errors
/// [`FigureError`] if `out` cannot be written or `progress` stops it; the file is incomplete then.
pub fn write_gif(
    animation: &mut impl PictureSequence,
    out: impl Write,
    progress: PictureProgress<'_>,
) -> Result<(), FigureError> {
    let total = animation.picture_count();
    let sampled = total.min(GIF_SAMPLED_PICTURES);
    let mut quantizer = ColourQuantizer::default();
    for i in 0..sampled {
        // Pictures evenly from the first to the last, so that late colours are not missed.
        let picture = animation.draw_sequence_picture((total - 1) * i / (sampled - 1).max(1));
        quantizer.count_picture_colours(picture.image_pixels());
    }
    // The last index is kept for pixels that do not change.
    quantizer.choose_palette_colours(usize::from(CLEAR_COLOUR_INDEX));
    let [width, height] = animation.picture_size().map(|side| side as u16);
    let delay = animation.centiseconds();
    let mut encoder = gif::Encoder::new(out, width, height, &quantizer.palette_bytes())?;
    encoder.set_repeat(gif::Repeat::Infinite)?;
    let mut shown: Vec<u8> = Vec::new();
    for done in 0..total {
        if progress(done, total) == ControlFlow::Break(()) {
            return Err(FigureError::Stopped { done, total });
        }
        let picture = animation.draw_sequence_picture(done);
        let indices: Vec<u8> = picture.image_pixels().iter().map(|&c| quantizer.index(c)).collect();
        let frame = gif::Frame {
            delay,
            dispose: gif::DisposalMethod::Keep,
            ..changed_gif_frame(&shown, &indices, usize::from(width))
        };
        encoder.write_frame(&frame)?;
        shown = indices;
    }
    Ok(())
}

/// The index for pixels that stay unchanged.
const CLEAR_COLOUR_INDEX: u8 = 255;

/// Returns the smallest rectangle in which `next` differs from `shown`, with unchanged pixels left clear.
fn changed_gif_frame(shown: &[u8], next: &[u8], width: usize) -> gif::Frame<'static> {
    let height = next.len() / width;
    // The first picture has nothing before it.
    if shown.is_empty() {
        return gif::Frame {
            width: width as u16,
            height: height as u16,
            buffer: Cow::Owned(next.to_vec()),
            ..gif::Frame::default()
        };
    }
    let (mut low, mut high) = ([width, height], [0, 0]);
    for (y, (a, b)) in shown.chunks(width).zip(next.chunks(width)).enumerate() {
        let differs = |x: &usize| a[*x] != b[*x];
        if let Some(first) = (0..width).find(differs) {
            let last = (0..width).rev().find(differs).unwrap_or(first);
            low = [low[0].min(first), low[1].min(y)];
            high = [high[0].max(last + 1), y + 1];
        }
    }
    // A GIF needs a picture even if nothing changed: one clear pixel.
    if high[0] == 0 {
        (low, high) = ([0, 0], [1, 1]);
    }
    let rows = (low[1]..high[1]).flat_map(|y| (low[0]..high[0]).map(move |x| y * width + x));
    let kept = |i: usize| {
        if shown[i] == next[i] {
            CLEAR_COLOUR_INDEX
        } else {
            next[i]
        }
    };
    gif::Frame {
        left: low[0] as u16,
        top: low[1] as u16,
        width: (high[0] - low[0]) as u16,
        height: (high[1] - low[1]) as u16,
        transparent: Some(CLEAR_COLOUR_INDEX),
        buffer: Cow::Owned(rows.map(kept).collect()),
        ..gif::Frame::default()
    }
}
