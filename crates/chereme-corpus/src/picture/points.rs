//! Pictures and films of points: markers, and points estimated from film.

use chereme_figure::raster::Style;
use chereme_figure::{Pictures, PointsAnimation, PointsOptions, points_sheet};
use chereme_motion::Markers;
use rusqlite::Connection;

use super::*;
use crate::db::tracks;
use crate::track::{TrackKind, read};

/// Returns the first track of points of a recording that has no skeleton.
pub(super) fn of(
    connection: &Connection,
    stretch: &Stretch,
    span: Span,
) -> Result<Option<Markers>> {
    let rows = tracks::tracks(connection, stretch.recording.id)?;
    let row = rows.iter().find(|row| row.kind == TrackKind::Markers);
    row.map(|row| read::markers(connection, row, Some(span)))
        .transpose()
}

/// Draws points: a contact sheet to a `.png`, an animation to a `.gif`, a film to an `.mp4`.
pub(super) fn draw(
    points: &Markers,
    title: &str,
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
    let mut hear = |done: usize, total: usize| match report(done, total) {
        Ok(()) => ControlFlow::Continue(()),
        Err(_) => ControlFlow::Break(()),
    };
    match extension(to).as_str() {
        "png" => {
            let size = [options.frames, options.height.unwrap_or(HEIGHT)];
            let image =
                points_sheet(points, title, size, &Style::default(), &mut hear).map_err(figure)?;
            let bytes = write(to, options.force, |out| {
                write_png(&image, out).map_err(figure)
            })?;
            let frames = options.frames.min(points.frames());
            Ok(picture_report(to, title, bytes, frames))
        }
        "gif" => {
            let mut film = film(points, options, (HEIGHT, None))?;
            let bytes = write(to, options.force, |out| {
                write_gif(&mut film, out, &mut hear).map_err(figure)
            })?;
            Ok(picture_report(to, title, bytes, film.frames()))
        }
        "mp4" => {
            let rate = options.rate.clamp(1, 120);
            let mut film = film(points, options, (FILM, Some(rate)))?;
            let shape = Shape { rate };
            let mut frames = 0;
            let bytes = write(to, options.force, |out| {
                frames = write_film(&mut film, shape, out, &mut report)?;
                Ok(())
            })?;
            Ok(picture_report(to, title, bytes, frames))
        }
        _ => Err(ending(
            to,
            "write a contact sheet to .png, an animation to .gif, a film to .mp4",
        )),
    }
}

fn film<'a>(
    points: &'a Markers,
    options: &PictureOptions,
    (height, rate): (usize, Option<u32>),
) -> Result<PointsAnimation<'a>> {
    let settings = PointsOptions {
        height: options.height.unwrap_or(height),
        speed: options.speed,
        rate,
        ..PointsOptions::default()
    };
    PointsAnimation::new(points, settings).map_err(figure)
}
