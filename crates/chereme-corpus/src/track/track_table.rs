//! A track of markers or curves as a table of its exact numbers.

use std::io::Write;

use chereme_motion::column::FrameNumberColumn;
use chereme_motion::{CurveTrack, FrameRate, FrameTimes, MarkerTrack};

use super::TrackContent;
use crate::error::{CorpusError, CorpusResult};

/// Writes one row for each frame: its number, its time in seconds on the track's own clock, and the numbers of all
/// columns as in the file; a gap is an empty cell.
///
/// # Errors
/// Fails if the track is neither markers nor curves, or `out` fails.
pub(crate) fn write_track_table(track: &TrackContent, delimiter: u8, out: &mut dyn Write) -> CorpusResult<()> {
    match track {
        TrackContent::Markers(markers) => {
            let (titles, columns) = of_markers(markers);
            write_track_rows(
                markers.marker_times(),
                markers.marker_frame_count(),
                &titles,
                &columns,
                delimiter,
                out,
            )
        }
        TrackContent::Curves(curves) => {
            let (titles, columns) = of_curves(curves);
            write_track_rows(
                curves.curve_times(),
                curves.curve_frame_count(),
                &titles,
                &columns,
                delimiter,
                out,
            )
        }
        other => Err(CorpusError::from_wrong_message(format!(
            "a track of kind {} is no table",
            other.track_kind().track_kind_name()
        ))
        .with_advice("a skeleton is written as .bvh; media are files already")),
    }
}

fn of_curves(curves: &CurveTrack) -> (Vec<String>, Vec<&FrameNumberColumn>) {
    let title = |curve: &chereme_motion::ScalarCurve| match curve.unit.as_str() {
        "" => curve.name.clone(),
        unit => format!("{} [{unit}]", curve.name),
    };
    let all = curves.track_curves().iter();
    all.map(|curve| (title(curve), &curve.values)).unzip()
}

fn of_markers(markers: &MarkerTrack) -> (Vec<String>, Vec<&FrameNumberColumn>) {
    let mut all = Vec::new();
    for point in markers.marker_points() {
        // Points of two parts may have one name; the part before a colon distinguishes them.
        let name = match point.group.as_str() {
            "" => point.name.clone(),
            group => format!("{group}:{}", point.name),
        };
        for (axis, column) in ["x", "y", "z"].iter().zip(&point.place) {
            all.push((format!("{name}.{axis}"), column));
        }
        let quality = markers
            .marker_quality()
            .map_or("quality", |quality| quality.quality_meaning_name());
        all.extend(point.quality.iter().map(|column| (format!("{name}.{quality}"), column)));
    }
    all.into_iter().unzip()
}

/// Returns the time of a frame in seconds, not rounded to microseconds: it shows the rate when the table is read again.
pub(crate) fn frame_seconds(rate: FrameRate, frame: usize) -> f64 {
    frame as f64 * f64::from(rate.per_seconds()) / f64::from(rate.rate_numerator())
}

fn write_track_rows(
    times: &FrameTimes,
    frames: usize,
    titles: &[String],
    columns: &[&FrameNumberColumn],
    delimiter: u8,
    out: &mut dyn Write,
) -> CorpusResult<()> {
    let fault = |error: csv::Error| CorpusError::from_wrong_message(format!("the track cannot be written: {error}"));
    let mut table = csv::WriterBuilder::new().delimiter(delimiter).from_writer(out);
    let first = ["frame", "time_s"].into_iter();
    table
        .write_record(first.chain(titles.iter().map(String::as_str)))
        .map_err(fault)?;
    for frame in 0..frames {
        let time = match times {
            FrameTimes::Even(rate) => frame_seconds(*rate, frame).to_string(),
            FrameTimes::Listed(listed) => listed.listed_seconds().column_text_at(frame).unwrap_or_default(),
        };
        let cells = columns
            .iter()
            .map(|column| column.column_text_at(frame).unwrap_or_default());
        let row = [frame.to_string(), time].into_iter().chain(cells);
        table.write_record(row).map_err(fault)?;
    }
    table
        .flush()
        .map_err(|error| CorpusError::from_wrong_message(format!("the track cannot be written: {error}")))
}
