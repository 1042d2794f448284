//! Animations of points: optical markers, and points estimated from film.

use chereme_motion::{Instant, Markers};

use crate::animation::Pictures;
use crate::error::{FigureError, MAX_FRAMES, SPEEDS, checked_size, checked_view};
use crate::font;
use crate::image::Image;
use crate::points::PointCloud;
use crate::raster::{Raster, Style};
use crate::view::View;

/// Height of the progress bar, in pixels.
const BAR: usize = 4;
/// Distance of the note from the border, in pixels.
const INSET: i64 = 6;

/// Options of an animation of points.
#[derive(Debug, Clone, PartialEq)]
pub struct PointsOptions {
    /// The height in pixels.
    pub height: usize,
    /// Duration of each picture in hundredths of a second, 1 to 100.
    pub centiseconds: u16,
    /// Pictures per second, for films; it overrides `centiseconds`, the unit of GIFs.
    pub rate: Option<u32>,
    /// Playback speed, one of [`SPEEDS`].
    pub speed: f64,
    /// Paper, light and lines.
    pub style: Style,
}

impl Default for PointsOptions {
    fn default() -> Self {
        Self {
            height: 360,
            centiseconds: 4,
            rate: None,
            speed: 1.0,
            style: Style::default(),
        }
    }
}

/// An animation of points whose pictures are drawn on demand: from the front, and from the left if the points are in a
/// room.
pub struct PointsAnimation<'a> {
    markers: &'a Markers,
    cloud: PointCloud<&'a Markers>,
    options: PointsOptions,
    views: Vec<View>,
    columns: Vec<usize>,
    size: [usize; 2],
    frames: usize,
    raster: Raster,
}

impl<'a> PointsAnimation<'a> {
    /// Returns the animation of a track of points.
    ///
    /// # Errors
    /// [`FigureError`] if no frame has a point, pictures would be too large or too many, or the speed is not one of
    /// [`SPEEDS`].
    pub fn new(markers: &'a Markers, options: PointsOptions) -> Result<Self, FigureError> {
        let cloud = PointCloud::of(markers, options.style.theme).ok_or(FigureError::Empty)?;
        let views = match cloud.is_flat() {
            true => vec![View::Addressee],
            false => vec![View::Addressee, View::Left],
        };
        let room = options.height.saturating_sub(BAR);
        let width = |&view: &View| (cloud.aspect(view).clamp(0.45, 2.0) * room as f32) as usize;
        let columns: Vec<usize> = views.iter().map(width).collect();
        for &column in &columns {
            checked_view(column, options.height)?;
        }
        let size = checked_size(columns.iter().sum(), options.height)?;
        if !SPEEDS.contains(&options.speed) {
            return Err(FigureError::Speed {
                speed: options.speed,
            });
        }
        let seconds = markers.span().end().seconds();
        let frames = ((seconds / step(&options)).ceil() as usize).max(1);
        if frames > MAX_FRAMES {
            return Err(FigureError::Long { frames });
        }
        Ok(Self {
            markers,
            cloud,
            options,
            views,
            columns,
            size,
            frames,
            raster: Raster::default(),
        })
    }
}

/// Returns the time in the track from one picture to the next, in seconds.
fn step(options: &PointsOptions) -> f64 {
    let seconds = match options.rate {
        Some(rate) => 1.0 / f64::from(rate.clamp(1, 240)),
        None => f64::from(options.centiseconds.clamp(1, 100)) / 100.0,
    };
    seconds * options.speed
}

impl Pictures for PointsAnimation<'_> {
    fn frames(&self) -> usize {
        self.frames
    }

    fn size(&self) -> [usize; 2] {
        self.size
    }

    fn centiseconds(&self) -> u16 {
        self.options.centiseconds.clamp(1, 100)
    }

    fn draw(&mut self, frame: usize) -> Image {
        let at = Instant::from_seconds(frame as f64 * step(&self.options));
        let last = self.markers.frames().saturating_sub(1);
        let own = self.markers.times().frame_at(at, self.markers.frames());
        let mesh = self.cloud.mesh(own.unwrap_or(last));
        let theme = self.options.style.theme;
        let mut image = Image::new(self.size[0], self.size[1], theme.background());
        let room = self.size[1] - BAR;
        let mut x = 0;
        for (&view, &width) in self.views.iter().zip(&self.columns) {
            let camera = self.cloud.camera(view, width as f32 / room as f32);
            let picture = self
                .raster
                .draw(&mesh, &camera, [width, room], &self.options.style);
            image.paste(&picture, [x, 0]);
            if x > 0 {
                image.fill([x as i64, 0], [1, room as i64], theme.rule());
            }
            x += width;
        }
        if let Some(note) = self.cloud.note() {
            let note = font::fitted(note, self.size[0].saturating_sub(2 * INSET as usize));
            image.text(&note, [INSET, INSET], 1, theme.text());
        }
        let played = self.size[0] * (frame + 1) / self.frames;
        let bar = |width: usize| [width as i64, BAR as i64];
        image.fill([0, room as i64], bar(self.size[0]), theme.rule());
        image.fill([0, room as i64], bar(played), theme.text());
        image
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use chereme_motion::{Column, Convention, Marker, Rate, Space, Times};

    use super::*;
    use crate::animation::write_gif;

    #[test]
    fn points_run_through_their_time_and_a_gap_shows_nothing() {
        let column = |phase: f64| {
            let values = (0..50).map(|at| {
                if at < 25 {
                    phase + f64::from(at) * 0.02
                } else {
                    f64::NAN
                }
            });
            Column::doubles(values.collect())
        };
        let point = |name, phase| Marker::new(name, vec![column(phase), column(1.0), column(0.1)]);
        let markers = Markers::new(
            Times::Even(Rate::new(50, 1).expect("a rate")),
            Space::World(Convention::MODEL),
            vec![point("LWRA", 0.2), point("RWRA", -0.7)],
        )
        .expect("markers");
        let options = PointsOptions {
            height: 120,
            rate: Some(20),
            ..PointsOptions::default()
        };
        let mut film = PointsAnimation::new(&markers, options.clone()).expect("a film");
        assert_eq!(film.frames(), 20, "one second");
        let paper = options.style.theme.background();
        let mut ink = |frame| {
            let image = film.draw(frame);
            let rows = (0..110).flat_map(|y| (0..image.width()).map(move |x| (x, y)));
            rows.filter(|&(x, y)| image.pixel(x, y) != paper).count()
        };
        // The line between the two views is always drawn.
        assert!(ink(0) > ink(19) + 20, "{} {}", ink(0), ink(19));
        let mut bytes = Vec::new();
        let mut go = |_, _| ControlFlow::Continue(());
        write_gif(&mut film, &mut bytes, &mut go).expect("a gif");
        assert!(bytes.starts_with(b"GIF89a"));
    }
}
