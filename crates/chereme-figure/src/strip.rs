//! Animations next to each other that play together, with captions below them.

use chereme_motion::Span;

use crate::animation::{Animation, Pictures};
use crate::error::{FigureError, MAX_FRAMES, checked_size};
use crate::font;
use crate::image::Image;
use crate::palette::Theme;

/// A text that is shown below an animation for a time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Caption {
    /// The time at which it is shown, on the clock of the clip.
    pub span: Span,
    /// The text, in any script.
    pub text: String,
}

/// Animations of one height next to each other; a shorter one holds its last picture.
pub struct Strip<'a> {
    cells: Vec<(Animation<'a>, Vec<Caption>)>,
    theme: Theme,
    /// The height of the line of captions; 0 without captions.
    line: usize,
    scale: usize,
    size: [usize; 2],
    frames: usize,
}

impl<'a> Strip<'a> {
    /// Returns the animations next to each other; if any has captions, a line for them is below all of them.
    ///
    /// # Errors
    /// [`FigureError`] if there is no animation, or pictures would be too large or too many.
    pub fn new(
        cells: Vec<(Animation<'a>, Vec<Caption>)>,
        theme: Theme,
    ) -> Result<Self, FigureError> {
        let frames = cells.iter().map(|cell| cell.0.frames()).max();
        let frames = frames.ok_or(FigureError::Nothing { what: "clip" })?;
        if frames > MAX_FRAMES {
            return Err(FigureError::Long { frames });
        }
        let height = cells.iter().map(|cell| cell.0.size()[1]).max();
        let height = height.unwrap_or_default();
        let scale = (height / 200).clamp(1, 6);
        let has_captions = cells.iter().any(|cell| !cell.1.is_empty());
        let line = if has_captions {
            scale * (font::HEIGHT + 6)
        } else {
            0
        };
        let width = cells.iter().map(|cell| cell.0.size()[0]).sum();
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

impl Pictures for Strip<'_> {
    fn frames(&self) -> usize {
        self.frames
    }

    fn size(&self) -> [usize; 2] {
        self.size
    }

    fn centiseconds(&self) -> u16 {
        self.cells.first().map_or(4, |cell| cell.0.centiseconds())
    }

    fn draw(&mut self, frame: usize) -> Image {
        let mut image = Image::new(self.size[0], self.size[1], self.theme.background());
        let top = self.size[1] - self.line;
        let mut x = 0;
        for (animation, captions) in &mut self.cells {
            let frame = frame.min(animation.frames() - 1);
            let width = animation.size()[0];
            image.paste(&animation.draw(frame), [x, 0]);
            let now = animation.instant(frame);
            let shown: Vec<&str> = captions
                .iter()
                .filter(|caption| caption.span.contains(now))
                .map(|caption| caption.text.as_str())
                .collect();
            let text = font::fitted(&shown.join("  "), width.saturating_sub(12) / self.scale);
            let wide = font::width(&text) * self.scale;
            let at = [
                (x + width.saturating_sub(wide) / 2) as i64,
                (top + 3 * self.scale) as i64,
            ];
            image.text(&text, at, self.scale, self.theme.text());
            if x > 0 {
                image.fill([x as i64, 0], [2, self.size[1] as i64], self.theme.rule());
            }
            x += width;
        }
        image
    }
}

#[cfg(test)]
mod tests {
    use chereme_motion::glam::DVec3;
    use chereme_motion::{Anatomy, Clip, Instant, Joint, Rate, Skeleton};

    use super::*;
    use crate::animation::AnimationOptions;

    fn stick(frames: usize) -> (Clip, Anatomy) {
        let skeleton = Skeleton::new(vec![
            Joint::new("root", None, DVec3::ZERO),
            Joint::new("stick", Some(0), DVec3::Y).with_tip(DVec3::X),
        ]);
        let skeleton = skeleton.expect("a skeleton");
        let anatomy = Anatomy::detect(&skeleton);
        let rate = Rate::new(50, 1).expect("a rate");
        (Clip::still(skeleton.into(), rate, frames), anatomy)
    }

    #[test]
    fn animations_run_together_with_captions_in_their_time() {
        let (long, anatomy) = stick(100);
        let (short, _) = stick(50);
        let options = AnimationOptions {
            height: 120,
            views: vec![crate::View::Addressee],
            rate: Some(30),
            ..AnimationOptions::default()
        };
        let animation = |clip| Animation::new(clip, &anatomy, options.clone()).expect("made");
        let said = Caption {
            span: Span::between(Instant::from_millis(500), Instant::from_millis(1000)),
            text: "STICK".to_owned(),
        };
        let both = vec![
            (animation(&long), vec![said]),
            (animation(&short), Vec::new()),
        ];
        let [width, height] = both[0].0.size();
        let mut strip = Strip::new(both, Theme::Light).expect("a strip");
        assert_eq!(strip.frames(), 60, "two seconds");
        assert_eq!(strip.size()[0], 2 * width);
        let line = strip.size()[1] - height;
        assert!(line > 0, "there is room for captions");
        let ink = |image: &Image| {
            let rows = height..height + line;
            let mut pixels = rows.flat_map(|y| (0..width).map(move |x| (x, y)));
            pixels.any(|(x, y)| image.pixel(x, y) != Theme::Light.background())
        };
        let said: Vec<bool> = [0, 14, 16, 29, 31, 59]
            .map(|frame| ink(&strip.draw(frame)))
            .to_vec();
        assert_eq!(said, [false, false, true, true, false, false]);
        assert!(Strip::new(Vec::new(), Theme::Light).is_err());
    }
}
