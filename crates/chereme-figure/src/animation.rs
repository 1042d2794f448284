//! Animations: a clip from one or more sides at once, and their GIF.
//!
//! Frames are drawn and written one at a time, so that a long clip needs no more memory than a short one.

use std::borrow::Cow;
use std::io::Write;
use std::ops::ControlFlow;

use chereme_motion::ends::Ends;
use chereme_motion::{Anatomy, Clip, Face, Instant, ModelPose};

use crate::body::Body;
use crate::error::{FigureError, MAX_FRAMES, SPEEDS, checked_size, checked_view};
use crate::image::Image;
use crate::mesh::Mesh;
use crate::palette::Palette;
use crate::quantize::Quantizer;
use crate::raster::{Raster, Style};
use crate::sheet::Progress;
use crate::view::{Framing, View};

/// Options of an animation.
#[derive(Debug, Clone, PartialEq)]
pub struct AnimationOptions {
    /// The views, side by side from the left.
    pub views: Vec<View>,
    /// The face of each frame of the clip; on later frames it is at rest.
    pub faces: Vec<Face>,
    /// The height in pixels.
    pub height: usize,
    /// Duration of each picture in hundredths of a second, 1 to 100; 4 gives 25 pictures per second.
    pub centiseconds: u16,
    /// Pictures per second, for films; it overrides `centiseconds`, the unit of GIFs.
    pub rate: Option<u32>,
    /// Playback speed, one of [`SPEEDS`]; 0.5 is half the original speed.
    pub speed: f64,
    /// The colours of the body.
    pub palette: Palette,
    /// Paper, light and lines.
    pub style: Style,
    /// The space that the pictures show; by default that of the clip's own signing.
    pub framing: Option<Framing>,
    /// Whether a bar at the lower edge shows how much was played.
    pub bar: bool,
}

impl Default for AnimationOptions {
    fn default() -> Self {
        Self {
            views: vec![View::Addressee, View::Right],
            faces: Vec::new(),
            height: 360,
            centiseconds: 4,
            rate: None,
            speed: 1.0,
            palette: Palette::default(),
            style: Style::default(),
            framing: None,
            bar: true,
        }
    }
}

impl AnimationOptions {
    /// Returns the height of the progress bar in pixels.
    fn bar(&self) -> usize {
        if self.bar { BAR } else { 0 }
    }

    /// Returns the time for which a picture is shown, in seconds.
    fn seconds(&self) -> f64 {
        match self.rate {
            Some(rate) => 1.0 / f64::from(rate.clamp(1, 240)),
            None => f64::from(self.centiseconds.clamp(1, 100)) / 100.0,
        }
    }
}

/// A sequence of pictures that are drawn one at a time.
pub trait Pictures {
    /// Returns the number of pictures.
    fn frames(&self) -> usize;

    /// Returns width and height of each picture in pixels.
    fn size(&self) -> [usize; 2];

    /// Returns the time for which each picture is shown in a GIF, in hundredths of a second.
    fn centiseconds(&self) -> u16;

    /// Draws one picture.
    fn draw(&mut self, frame: usize) -> Image;
}

impl Pictures for Animation<'_> {
    fn frames(&self) -> usize {
        self.frames()
    }

    fn size(&self) -> [usize; 2] {
        self.size()
    }

    fn centiseconds(&self) -> u16 {
        self.options.centiseconds.clamp(1, 100)
    }

    fn draw(&mut self, frame: usize) -> Image {
        self.draw(frame)
    }
}

/// An animation whose pictures are drawn on demand, in any order.
pub struct Animation<'a> {
    clip: &'a Clip,
    anatomy: &'a Anatomy,
    framing: Framing,
    body: Body,
    options: AnimationOptions,
    /// The width of each view's column in pixels.
    columns: Vec<usize>,
    size: [usize; 2],
    frames: usize,
    start: Instant,
    mesh: Mesh,
    raster: Raster,
    pose: Option<ModelPose>,
}

/// Height of the progress bar, in pixels.
const BAR: usize = 4;

impl<'a> Animation<'a> {
    /// Returns the animation of `clip`, without odd frames at its ends.
    ///
    /// # Errors
    /// [`FigureError`] if the clip is empty, no view is requested, pictures would be too large or too
    /// many, or the speed is not one of [`SPEEDS`].
    pub fn new(
        clip: &'a Clip,
        anatomy: &'a Anatomy,
        options: AnimationOptions,
    ) -> Result<Self, FigureError> {
        let own = Framing::of(clip, anatomy).ok_or(FigureError::Empty)?;
        let framing = options.framing.unwrap_or(own);
        if options.views.is_empty() {
            return Err(FigureError::Nothing { what: "view" });
        }
        let room = options.height.saturating_sub(options.bar());
        let width = |&view: &View| (framing.aspect(view).clamp(0.45, 2.0) * room as f32) as usize;
        let columns: Vec<usize> = options.views.iter().map(width).collect();
        for &column in &columns {
            checked_view(column, options.height)?;
        }
        let size = checked_size(columns.iter().sum(), options.height)?;
        if !SPEEDS.contains(&options.speed) {
            return Err(FigureError::Speed {
                speed: options.speed,
            });
        }
        let sound = clip.rate().span(Ends::of(clip, anatomy).sound);
        let step = options.seconds() * options.speed;
        let frames = ((sound.seconds() / step).ceil() as usize).max(1);
        if frames > MAX_FRAMES {
            return Err(FigureError::Long { frames });
        }
        Ok(Self {
            body: Body::with_palette(clip.skeleton(), anatomy, &options.palette),
            mesh: Mesh::default(),
            raster: Raster::default(),
            pose: None,
            clip,
            anatomy,
            framing,
            start: sound.start(),
            options,
            columns,
            size,
            frames,
        })
    }

    /// Returns the number of pictures, at least one.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Returns width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Returns the time in the clip that picture `frame` shows.
    #[must_use]
    pub fn instant(&self, frame: usize) -> Instant {
        let step = self.options.seconds() * self.options.speed;
        let from = Instant::from_seconds(frame as f64 * step);
        from.shifted(self.start.micros())
    }

    /// Draws picture `frame`.
    #[must_use]
    pub fn draw(&mut self, frame: usize) -> Image {
        let instant = self.instant(frame);
        let local = self.clip.sample(instant);
        let skeleton = self.clip.skeleton();
        match &mut self.pose {
            Some(pose) => pose.set(skeleton, &local),
            none => *none = Some(ModelPose::of(skeleton, &local)),
        }
        let theme = self.options.style.theme;
        let mut image = Image::new(self.size[0], self.size[1], theme.background());
        let Some(pose) = &self.pose else {
            return image;
        };
        self.body.shape(pose, &mut self.mesh);
        if let Some(face) = Face::at(&self.options.faces, self.clip.rate(), instant) {
            self.body.express(pose, &face, &mut self.mesh);
        }
        let room = self.size[1] - self.options.bar();
        let mut x = 0;
        for (&view, &width) in self.options.views.iter().zip(&self.columns) {
            let camera = self
                .framing
                .camera(view, width as f32 / room as f32, pose, self.anatomy);
            let picture = self
                .raster
                .draw(&self.mesh, &camera, [width, room], &self.options.style);
            image.paste(&picture, [x, 0]);
            if x > 0 {
                image.fill([x as i64, 0], [1, room as i64], theme.rule());
            }
            x += width;
        }
        if self.options.bar {
            let played = self.size[0] * (frame + 1) / self.frames;
            let bar = |width: usize| [width as i64, BAR as i64];
            image.fill([0, room as i64], bar(self.size[0]), theme.rule());
            image.fill([0, room as i64], bar(played), theme.text());
        }
        image
    }
}

/// The number of pictures from which the colours of a GIF are chosen.
const SAMPLED: usize = 12;

/// Writes an animation as a GIF that repeats for ever, in colours chosen from pictures all over it; each
/// picture stores only its changes.
///
/// # Errors
/// [`FigureError`] if `out` cannot be written or `progress` stops it; the file is incomplete then.
pub fn write_gif(
    animation: &mut impl Pictures,
    out: impl Write,
    progress: Progress<'_>,
) -> Result<(), FigureError> {
    let total = animation.frames();
    let sampled = total.min(SAMPLED);
    let mut quantizer = Quantizer::default();
    for i in 0..sampled {
        let picture = animation.draw((total - 1) * i / (sampled - 1).max(1));
        quantizer.add(picture.pixels());
    }
    quantizer.choose(usize::from(CLEAR));
    let [width, height] = animation.size().map(|side| side as u16);
    let delay = animation.centiseconds();
    let mut encoder = gif::Encoder::new(out, width, height, &quantizer.palette_bytes())?;
    encoder.set_repeat(gif::Repeat::Infinite)?;
    let mut shown: Vec<u8> = Vec::new();
    for done in 0..total {
        if progress(done, total) == ControlFlow::Break(()) {
            return Err(FigureError::Stopped { done, total });
        }
        let picture = animation.draw(done);
        let indices: Vec<u8> = picture
            .pixels()
            .iter()
            .map(|&c| quantizer.index(c))
            .collect();
        let frame = gif::Frame {
            delay,
            dispose: gif::DisposalMethod::Keep,
            ..changed(&shown, &indices, usize::from(width))
        };
        encoder.write_frame(&frame)?;
        shown = indices;
    }
    Ok(())
}

/// The index for pixels that stay unchanged.
const CLEAR: u8 = 255;

/// Returns the smallest rectangle in which `next` differs from `shown`, with unchanged pixels left clear.
fn changed(shown: &[u8], next: &[u8], width: usize) -> gif::Frame<'static> {
    let height = next.len() / width;
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
    if high[0] == 0 {
        (low, high) = ([0, 0], [1, 1]);
    }
    let rows = (low[1]..high[1]).flat_map(|y| (low[0]..high[0]).map(move |x| y * width + x));
    let kept = |i: usize| if shown[i] == next[i] { CLEAR } else { next[i] };
    gif::Frame {
        left: low[0] as u16,
        top: low[1] as u16,
        width: (high[0] - low[0]) as u16,
        height: (high[1] - low[1]) as u16,
        transparent: Some(CLEAR),
        buffer: Cow::Owned(rows.map(kept).collect()),
        ..gif::Frame::default()
    }
}
