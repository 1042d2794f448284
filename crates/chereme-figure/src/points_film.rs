//! Animations of points: optical markers, and points estimated from film.

use chereme_motion::{MarkerTrack, RecordingInstant};

use crate::animation::PictureSequence;
use crate::error::{ANIMATION_SPEEDS, FigureError, MAX_FRAMES, checked_size, checked_view};
use crate::font;
use crate::image::RasterImage;
use crate::points::PointCloud;
use crate::raster::{FigureRaster, FigureStyle};
use crate::view::FigureView;

/// Height of the progress bar, in pixels.
const PROGRESS_BAR_HEIGHT_PIXELS: usize = 4;
/// Distance of the note from the border, in pixels.
const NOTE_INSET_PIXELS: i64 = 6;

/// Options of an animation of points.
#[derive(Debug, Clone, PartialEq)]
pub struct PointsOptions {
    /// The height in pixels.
    pub height: usize,
    /// Duration of each picture in hundredths of a second, 1 to 100.
    pub centiseconds: u16,
    /// Pictures per second, for films; it overrides `centiseconds`, the unit of GIFs.
    pub rate: Option<u32>,
    /// Playback speed, one of [`ANIMATION_SPEEDS`].
    pub speed: f64,
    /// Paper, light and lines.
    pub style: FigureStyle,
}

impl Default for PointsOptions {
    fn default() -> Self {
        Self {
            height: 360,
            centiseconds: 4,
            rate: None,
            speed: 1.0,
            style: FigureStyle::default(),
        }
    }
}

/// An animation of points whose pictures are drawn on demand: from the front, and from the left if the points are in a
/// room.
pub struct PointsAnimation<'a> {
    markers: &'a MarkerTrack,
    cloud: PointCloud<&'a MarkerTrack>,
    options: PointsOptions,
    views: Vec<FigureView>,
    columns: Vec<usize>,
    size: [usize; 2],
    frames: usize,
    raster: FigureRaster,
}

impl<'a> PointsAnimation<'a> {
    /// Returns the animation of a track of points.
    ///
    /// # Errors
    /// [`FigureError`] if no frame has a point, pictures would be too large or too many, or the speed is not one of
    /// [`ANIMATION_SPEEDS`].
    pub fn new(markers: &'a MarkerTrack, options: PointsOptions) -> Result<Self, FigureError> {
        let cloud = PointCloud::cloud_from_markers(markers, options.style.theme).ok_or(FigureError::Empty)?;
        let views = match cloud.is_flat() {
            true => vec![FigureView::Addressee],
            false => vec![FigureView::Addressee, FigureView::Left],
        };
        let room = options.height.saturating_sub(PROGRESS_BAR_HEIGHT_PIXELS);
        let width = |&view: &FigureView| (cloud.cloud_view_aspect(view).clamp(0.45, 2.0) * room as f32) as usize;
        let columns: Vec<usize> = views.iter().map(width).collect();
        for &column in &columns {
            checked_view(column, options.height)?;
        }
        let size = checked_size(columns.iter().sum(), options.height)?;
        if !ANIMATION_SPEEDS.contains(&options.speed) {
            return Err(FigureError::Speed { speed: options.speed });
        }
        // The track is played from time zero, even if its first frame comes later.
        let seconds = markers.marker_track_span().span_end_instant().instant_seconds();
        let frames = ((seconds / picture_step_seconds(&options)).ceil() as usize).max(1);
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
            raster: FigureRaster::default(),
        })
    }
}

/// Returns the time in the track from one picture to the next, in seconds.
fn picture_step_seconds(options: &PointsOptions) -> f64 {
    let seconds = match options.rate {
        Some(rate) => 1.0 / f64::from(rate.clamp(1, 240)),
        None => f64::from(options.centiseconds.clamp(1, 100)) / 100.0,
    };
    seconds * options.speed
}

impl PictureSequence for PointsAnimation<'_> {
    fn picture_count(&self) -> usize {
        self.frames
    }

    fn picture_size(&self) -> [usize; 2] {
        self.size
    }

    fn centiseconds(&self) -> u16 {
        self.options.centiseconds.clamp(1, 100)
    }

    fn draw_sequence_picture(&mut self, frame: usize) -> RasterImage {
        let film_instant = RecordingInstant::from_seconds(frame as f64 * picture_step_seconds(&self.options));
        let last = self.markers.marker_frame_count().saturating_sub(1);
        // A track without frames at that time shows its last one.
        let marker_frame = self
            .markers
            .marker_times()
            .shown_frame_at(film_instant, self.markers.marker_frame_count());
        let mesh = self.cloud.cloud_frame_mesh(marker_frame.unwrap_or(last));
        let theme = self.options.style.theme;
        let mut image = RasterImage::new(self.size[0], self.size[1], theme.theme_paper_colour());
        let room = self.size[1] - PROGRESS_BAR_HEIGHT_PIXELS;
        let mut x = 0;
        for (&view, &width) in self.views.iter().zip(&self.columns) {
            let camera = self.cloud.cloud_camera(view, width as f32 / room as f32);
            let picture = self
                .raster
                .draw_mesh_picture(&mesh, &camera, [width, room], &self.options.style);
            image.paste_image(&picture, [x, 0]);
            if x > 0 {
                image.fill_image_rectangle([x as i64, 0], [1, room as i64], theme.rule_colour());
            }
            x += width;
        }
        if let Some(note) = self.cloud.cloud_measurement_note() {
            let note = font::fit_text_width(note, self.size[0].saturating_sub(2 * NOTE_INSET_PIXELS as usize));
            image.draw_image_text(
                &note,
                [NOTE_INSET_PIXELS, NOTE_INSET_PIXELS],
                1,
                theme.theme_text_colour(),
            );
        }
        // The bar is full at the last picture.
        let played = self.size[0] * (frame + 1) / self.frames;
        let bar = |width: usize| [width as i64, PROGRESS_BAR_HEIGHT_PIXELS as i64];
        image.fill_image_rectangle([0, room as i64], bar(self.size[0]), theme.rule_colour());
        image.fill_image_rectangle([0, room as i64], bar(played), theme.theme_text_colour());
        image
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use chereme_motion::{FrameNumberColumn, FrameRate, FrameTimes, MarkerSpace, MotionMarker, SpaceConvention};

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
            FrameNumberColumn::from_double_floats(values.collect())
        };
        let point = |name, phase| MotionMarker::new(name, vec![column(phase), column(1.0), column(0.1)]);
        let markers = MarkerTrack::new(
            FrameTimes::Even(FrameRate::new(50, 1).expect("a rate")),
            MarkerSpace::World(SpaceConvention::MODEL_CONVENTION),
            vec![point("LWRA", 0.2), point("RWRA", -0.7)],
        )
        .expect("markers");
        let options = PointsOptions {
            height: 120,
            rate: Some(20),
            ..PointsOptions::default()
        };
        let mut film = PointsAnimation::new(&markers, options.clone()).expect("a film");
        assert_eq!(film.picture_count(), 20, "one second");
        let paper = options.style.theme.theme_paper_colour();
        let mut ink = |frame| {
            let image = film.draw_sequence_picture(frame);
            let rows = (0..110).flat_map(|y| (0..image.image_width()).map(move |x| (x, y)));
            rows.filter(|&(x, y)| image.image_pixel_at(x, y) != paper).count()
        };
        // The line between the two views is always drawn.
        assert!(ink(0) > ink(19) + 20, "{} {}", ink(0), ink(19));
        let mut bytes = Vec::new();
        let mut go = |_, _| ControlFlow::Continue(());
        write_gif(&mut film, &mut bytes, &mut go).expect("a gif");
        assert!(bytes.starts_with(b"GIF89a"));
    }
}
