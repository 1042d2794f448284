//! Animations next to each other that play together, with captions below them.

use chereme_motion::TimeSpan;

use crate::animation::{ClipAnimation, PictureSequence};
use crate::error::{FigureError, MAX_FRAMES, checked_size};
use crate::font;
use crate::image::RasterImage;
use crate::palette::PaperTheme;

/// A text that is shown below an animation for a time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AnimationCaption {
    /// The time at which it is shown, on the clock of the clip.
    pub span: TimeSpan,
    /// The text, in any script.
    pub text: String,
}

/// Animations of one height next to each other; a shorter one holds its last picture.
pub struct AnimationStrip<'a> {
    cells: Vec<(ClipAnimation<'a>, Vec<AnimationCaption>)>,
    theme: PaperTheme,
    /// The height of the line of captions; 0 without captions.
    line: usize,
    scale: usize,
    size: [usize; 2],
    frames: usize,
}

impl<'a> AnimationStrip<'a> {
    /// Returns the animations next to each other; if any has captions, a line for them is below all of them.
    ///
    /// # Errors
    /// [`FigureError`] if there is no animation, or pictures would be too large or too many.
    pub fn new(cells: Vec<(ClipAnimation<'a>, Vec<AnimationCaption>)>, theme: PaperTheme) -> Result<Self, FigureError> {
        let most_frames = cells.iter().map(|cell| cell.0.animation_frame_count()).max();
        let frames = most_frames.ok_or(FigureError::Nothing { what: "clip" })?;
        if frames > MAX_FRAMES {
            return Err(FigureError::Long { frames });
        }
        let tallest = cells.iter().map(|cell| cell.0.animation_size()[1]).max();
        let height = tallest.unwrap_or_default();
        // Captions grow with the picture, so that they stay readable.
        let scale = (height / 200).clamp(1, 6);
        let has_captions = cells.iter().any(|cell| !cell.1.is_empty());
        let line = if has_captions {
            scale * (font::CELL_HEIGHT_DOTS + 6)
        } else {
            0
        };
        let width = cells.iter().map(|cell| cell.0.animation_size()[0]).sum();
        Ok(Self {
            size: checked_size(width, height + line)?,
            cells,
            theme,
            line,
            scale,
            frames,
        })
    }
}

impl PictureSequence for AnimationStrip<'_> {
    fn picture_count(&self) -> usize {
        self.frames
    }

    fn picture_size(&self) -> [usize; 2] {
        self.size
    }

    fn centiseconds(&self) -> u16 {
        self.cells.first().map_or(4, |cell| cell.0.centiseconds())
    }

    fn draw_sequence_picture(&mut self, frame: usize) -> RasterImage {
        let mut image = RasterImage::new(self.size[0], self.size[1], self.theme.theme_paper_colour());
        let top = self.size[1] - self.line;
        let mut x = 0;
        for (animation, captions) in &mut self.cells {
            // A shorter animation holds its last picture.
            let frame = frame.min(animation.animation_frame_count() - 1);
            let width = animation.animation_size()[0];
            image.paste_image(&animation.draw_animation_frame(frame), [x, 0]);
            let now = animation.frame_clip_instant(frame);
            let shown: Vec<&str> = captions
                .iter()
                .filter(|caption| caption.span.has_instant(now))
                .map(|caption| caption.text.as_str())
                .collect();
            let text = font::fit_text_width(&shown.join("  "), width.saturating_sub(12) / self.scale);
            let wide = font::text_width_dots(&text) * self.scale;
            let caption_place = [
                (x + width.saturating_sub(wide) / 2) as i64,
                (top + 3 * self.scale) as i64,
            ];
            image.draw_image_text(&text, caption_place, self.scale, self.theme.theme_text_colour());
            if x > 0 {
                image.fill_image_rectangle([x as i64, 0], [2, self.size[1] as i64], self.theme.rule_colour());
            }
            x += width;
        }
        image
    }
}

#[cfg(test)]
mod tests {
    use chereme_motion::glam::DVec3;
    use chereme_motion::{BodyAnatomy, Clip, FrameRate, RecordingInstant, Skeleton, SkeletonJoint};

    use super::*;
    use crate::animation::AnimationOptions;

    fn stick(frames: usize) -> (Clip, BodyAnatomy) {
        let skeleton = Skeleton::new(vec![
            SkeletonJoint::new("root", None, DVec3::ZERO),
            SkeletonJoint::new("stick", Some(0), DVec3::Y).with_tip(DVec3::X),
        ]);
        let skeleton = skeleton.expect("a skeleton");
        let anatomy = BodyAnatomy::detect_anatomy(&skeleton);
        let rate = FrameRate::new(50, 1).expect("a rate");
        (Clip::from_rest_pose(skeleton.into(), rate, frames), anatomy)
    }

    #[test]
    fn animations_run_together_with_captions_in_their_time() {
        let (long, anatomy) = stick(100);
        let (short, _) = stick(50);
        let options = AnimationOptions {
            height: 120,
            views: vec![crate::FigureView::Addressee],
            rate: Some(30),
            ..AnimationOptions::default()
        };
        let animation = |clip| ClipAnimation::new(clip, &anatomy, options.clone()).expect("made");
        let said = AnimationCaption {
            span: TimeSpan::span_between(RecordingInstant::from_millis(500), RecordingInstant::from_millis(1000)),
            text: "STICK".to_owned(),
        };
        let both = vec![(animation(&long), vec![said]), (animation(&short), Vec::new())];
        let [width, height] = both[0].0.animation_size();
        let mut strip = AnimationStrip::new(both, PaperTheme::Light).expect("a strip");
        assert_eq!(strip.picture_count(), 60, "two seconds");
        assert_eq!(strip.picture_size()[0], 2 * width);
        let line = strip.picture_size()[1] - height;
        assert!(line > 0, "there is room for captions");
        let ink = |image: &RasterImage| {
            let rows = height..height + line;
            let mut pixels = rows.flat_map(|y| (0..width).map(move |x| (x, y)));
            pixels.any(|(x, y)| image.image_pixel_at(x, y) != PaperTheme::Light.theme_paper_colour())
        };
        let said: Vec<bool> = [0, 14, 16, 29, 31, 59]
            .map(|frame| ink(&strip.draw_sequence_picture(frame)))
            .to_vec();
        assert_eq!(said, [false, false, true, true, false, false]);
        assert!(AnimationStrip::new(Vec::new(), PaperTheme::Light).is_err());
    }
}
