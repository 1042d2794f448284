//! A track of markers or curves as a table of its exact numbers.

use std::io::Write;

use chereme_motion::column::Column;
use chereme_motion::{Curves, Markers, Rate, Times};

use super::Track;
use crate::error::{Error, Result};

/// Writes one row for each frame: its number, its time in seconds on the track's own clock, and the numbers of all
/// columns as in the file; a gap is an empty cell.
///
/// # Errors
/// Fails if the track is neither markers nor curves, or `out` fails.
pub(crate) fn write(track: &Track, delimiter: u8, out: &mut dyn Write) -> Result<()> {
    match track {
        Track::Markers(markers) => {
            let (titles, columns) = of_markers(markers);
            rows(
                markers.times(),
                markers.frames(),
                &titles,
                &columns,
                delimiter,
                out,
            )
        }
        Track::Curves(curves) => {
            let (titles, columns) = of_curves(curves);
            rows(
                curves.times(),
                curves.frames(),
                &titles,
                &columns,
                delimiter,
                out,
            )
        }
        other => Err(Error::wrong(format!(
            "a track of kind {} is no table",
            other.kind().name()
        ))
        .advise("a skeleton is written as .bvh; media are files already")),
    }
}

fn of_curves(curves: &Curves) -> (Vec<String>, Vec<&Column>) {
    let title = |curve: &chereme_motion::Curve| match curve.unit.as_str() {
        "" => curve.name.clone(),
        unit => format!("{} [{unit}]", curve.name),
    };
    let all = curves.curves().iter();
    all.map(|curve| (title(curve), &curve.values)).unzip()
}

fn of_markers(markers: &Markers) -> (Vec<String>, Vec<&Column>) {
    let mut all = Vec::new();
    for point in markers.points() {
        let name = match point.group.as_str() {
            "" => point.name.clone(),
            group => format!("{group}:{}", point.name),
        };
        for (axis, column) in ["x", "y", "z"].iter().zip(&point.place) {
            all.push((format!("{name}.{axis}"), column));
        }
        let quality = markers.quality().map_or("quality", |it| it.name());
        all.extend(
            point
                .quality
                .iter()
                .map(|column| (format!("{name}.{quality}"), column)),
        );
    }
    all.into_iter().unzip()
}

/// Returns the time of a frame in seconds, not rounded to microseconds: it shows the rate when the table is read again.
pub(crate) fn seconds(rate: Rate, frame: usize) -> f64 {
    frame as f64 * f64::from(rate.per_seconds()) / f64::from(rate.frames())
}

fn rows(
    times: &Times,
    frames: usize,
    titles: &[String],
    columns: &[&Column],
    delimiter: u8,
    out: &mut dyn Write,
) -> Result<()> {
    let fault = |error: csv::Error| Error::wrong(format!("the track cannot be written: {error}"));
    let mut table = csv::WriterBuilder::new()
        .delimiter(delimiter)
        .from_writer(out);
    let first = ["frame", "time_s"].into_iter();
    table
        .write_record(first.chain(titles.iter().map(String::as_str)))
        .map_err(fault)?;
    for frame in 0..frames {
        let time = match times {
            Times::Even(rate) => seconds(*rate, frame).to_string(),
            Times::Listed(listed) => listed.seconds().text(frame).unwrap_or_default(),
        };
        let cells = columns
            .iter()
            .map(|column| column.text(frame).unwrap_or_default());
        let row = [frame.to_string(), time].into_iter().chain(cells);
        table.write_record(row).map_err(fault)?;
    }
    table
        .flush()
        .map_err(|error| Error::wrong(format!("the track cannot be written: {error}")))
}
