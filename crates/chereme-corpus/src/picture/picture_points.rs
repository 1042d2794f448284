//! Pictures and films of points: markers, and points estimated from film.

use chereme_figure::raster::FigureStyle;
use chereme_figure::{PictureSequence, PointsAnimation, PointsOptions, points_sheet};
use chereme_motion::MarkerTrack;
use rusqlite::Connection;

use super::*;
use crate::db::stored_tracks;
use crate::track::{TrackKind, track_read};

/// Returns the first track of points of a recording that has no skeleton.
pub(super) fn first_point_track(
    connection: &Connection,
    stretch: &RecordingStretch,
    span: TimeSpan,
) -> CorpusResult<Option<MarkerTrack>> {
    let rows = stored_tracks::load_track_rows(connection, stretch.recording.id)?;
    let row = rows.iter().find(|row| row.kind == TrackKind::Markers);
    row.map(|row| track_read::read_track_markers(connection, row, Some(span)))
        .transpose()
}

/// Draws points: a contact sheet to a `.png`, an animation to a `.gif`, a film to an `.mp4`.
pub(super) fn draw_points_file(
    points: &MarkerTrack,
    title: &str,
    to: &Path,
    options: &PictureOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<DrawnPicture> {
    let mut report = |done: usize, total: usize| progress.report_frames("drawing", done, total);
    let mut hear = |done: usize, total: usize| match report(done, total) {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    };
    match lowercase_extension(to).as_str() {
        "png" => {
            let size = [options.frames, options.height.unwrap_or(MOVEMENT_PICTURE_HEIGHT_PX)];
            let image =
                points_sheet(points, title, size, &FigureStyle::default(), &mut hear).map_err(picture_figure_error)?;
            let bytes = write_atomically(to, options.force, |out| {
                write_png(&image, out).map_err(picture_figure_error)
            })?;
            let frames = options.frames.min(points.marker_frame_count());
            Ok(picture_report(to, title, bytes, frames))
        }
        "gif" => {
            let mut film = points_animation(points, options, MOVEMENT_PICTURE_HEIGHT_PX, None)?;
            let bytes = write_atomically(to, options.force, |out| {
                write_gif(&mut film, out, &mut hear).map_err(picture_figure_error)
            })?;
            Ok(picture_report(to, title, bytes, film.picture_count()))
        }
        "mp4" => {
            let rate = options.rate.clamp(1, 120);
            let mut film = points_animation(points, options, FILM_HEIGHT_PX, Some(rate))?;
            let shape = WrittenFilmShape { rate };
            let mut frames = 0;
            let bytes = write_atomically(to, options.force, |out| {
                frames = write_film(&mut film, shape, out, &mut report)?;
                Ok(())
            })?;
            Ok(picture_report(to, title, bytes, frames))
        }
        _ => Err(missing_ending_error(
            to,
            "write a contact sheet to .png, an animation to .gif, a film to .mp4",
        )),
    }
}

fn points_animation<'a>(
    points: &'a MarkerTrack,
    options: &PictureOptions,
    height: usize,
    rate: Option<u32>,
) -> CorpusResult<PointsAnimation<'a>> {
    let settings = PointsOptions {
        height: options.height.unwrap_or(height),
        speed: options.speed,
        rate,
        ..PointsOptions::default()
    };
    PointsAnimation::new(points, settings).map_err(picture_figure_error)
}
