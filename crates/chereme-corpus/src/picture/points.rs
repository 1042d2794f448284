//! Contact sheets of points: markers, and points estimated from film.

use chereme_figure::points_sheet;
use chereme_figure::raster::Style;
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

/// Draws points to a contact sheet.
pub(super) fn draw(
    points: &Markers,
    title: &str,
    to: &Path,
    options: &PictureOptions,
    progress: &mut Progress<'_>,
) -> Result<Picture> {
    if extension(to) != "png" {
        return Err(ending(to, "points without a skeleton are drawn to a .png"));
    }
    let mut hear = |done: usize, total: usize| {
        let step = Step {
            task: "drawing",
            done: done as u64,
            total: Some(total as u64),
            unit: Unit::Frames,
        };
        match progress.tell(step) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        }
    };
    let size = [options.frames, options.height.unwrap_or(HEIGHT)];
    let image = points_sheet(points, title, size, &Style::default(), &mut hear).map_err(figure)?;
    let bytes = write(to, options.force, |out| {
        write_png(&image, out).map_err(figure)
    })?;
    Ok(told(to, title, bytes, options.frames.min(points.frames())))
}
