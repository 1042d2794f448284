//! Writes faces in ARKit's shapes as the CSV of Live Link Face, which Unreal, MotionBuilder and Faceit read.

use std::fmt::Write as _;

use chereme_motion::{CurveTrack, RecordingInstant, ScalarCurve};

use crate::faces::{FaceSystem, PERCENT_VALUE_LIMIT};
use crate::finding::ImportFinding;
use crate::timecode::format_timecode;

/// The column of the number of shapes that a row gives; 0 means that no face was found.
const SHAPE_COUNT_TITLE: &str = "BlendShapeCount";

/// A column of the file.
struct LiveLinkColumn<'c> {
    title: &'c str,
    curve: Option<&'c ScalarCurve>,
    /// The factor to the unit of Live Link: shares from 0 to 1, and radians.
    factor: f64,
}

impl LiveLinkColumn<'_> {
    /// Returns the cell of a frame: the number of the capture as it is, 0 for a shape that the capture does not have, and
    /// nothing for a gap.
    fn cell_text_at(&self, frame: usize) -> String {
        let Some(curve) = self.curve else {
            return "0".to_owned();
        };
        match self.factor {
            1.0 => curve.values.column_text_at(frame).unwrap_or_default(),
            factor => curve
                .values
                .column_value_at(frame)
                .map_or_else(String::new, |value| format!("{:.10}", value * factor)),
        }
    }
}

/// Writes a face as Live Link Face does: a timecode that counts 60 frames a second and their thousandths, the number of
/// shapes, and 61 columns. `begin` is the time of day of the track's own time 0. Numbers that have Live Link's units
/// come out as they were read; degrees and percent are converted. `None` if the channels are neither ARKit's nor
/// MediaPipe's shapes.
#[must_use]
pub fn write_live_link_csv(curves: &CurveTrack, begin: RecordingInstant) -> Option<(String, Vec<ImportFinding>)> {
    let system = FaceSystem::system_of_curves(curves).filter(|system| system.has_live_link_shapes())?;
    let channels = &FaceSystem::find_face_system("arkit")?.channels;
    let position_of = |title: &str| system.position_of_channel(curves, title);
    let mut places: Vec<(Option<usize>, &str)> = channels
        .iter()
        .map(|title| (position_of(title), title.as_str()))
        .collect();
    let missing: Vec<&str> = places
        .iter()
        .filter(|place| place.0.is_none())
        .map(|place| place.1)
        .collect();
    let count_position = position_of(SHAPE_COUNT_TITLE);
    let kept: Vec<usize> = places
        .iter()
        .map(|place| place.0)
        .chain([count_position])
        .flatten()
        .collect();
    let of_track = |position: usize| &curves.track_curves()[position];
    let left_out = (0..curves.track_curves().len()).filter(|position| !kept.contains(position));
    let left_out: Vec<&str> = left_out.map(|position| of_track(position).name.as_str()).collect();
    let mut findings = Vec::new();
    let mut push_note = |text: &str, names: &[&str]| {
        if !names.is_empty() {
            let message = format!("{text}: {}", names.join(", "));
            findings.push(ImportFinding::new_note_finding(None, message));
        }
    };
    push_note("columns that the capture does not have are 0", &missing);
    push_note(
        "channels for which Live Link Face has no column are left out",
        &left_out,
    );
    // The phone puts right before left, other writers do not: a whole take keeps its own order.
    if missing.is_empty() {
        places.sort();
    }
    let is_turn = |title: &str| ["Yaw", "Pitch", "Roll"].iter().any(|turn| title.ends_with(turn));
    let shapes = places
        .iter()
        .filter(|place| !is_turn(place.1))
        .filter_map(|place| place.0);
    let shape_values = shapes.flat_map(|position| of_track(position).values.column_values().flatten());
    let is_percent = shape_values.fold(0.0, f64::max) > PERCENT_VALUE_LIMIT;
    let columns: Vec<LiveLinkColumn<'_>> = places
        .into_iter()
        .map(|(position, title)| {
            let curve = position.map(of_track);
            let factor = match curve.map(|curve| curve.unit.as_str()) {
                Some("deg") => 1_f64.to_radians(),
                _ if is_percent && !is_turn(title) => 0.01,
                _ => 1.0,
            };
            LiveLinkColumn { title, curve, factor }
        })
        .collect();
    if columns.iter().any(|column| column.factor != 1.0) {
        let message = "numbers were converted to the units of Live Link Face, shares from 0 to 1 and radians";
        findings.push(ImportFinding::new_note_finding(None, message));
    }
    let count_title = count_position.map_or(SHAPE_COUNT_TITLE, |position| of_track(position).name.as_str());
    let mut out = format!("Timecode,{count_title}");
    for column in &columns {
        let _ = write!(out, ",{}", column.title);
    }
    for frame in 0..curves.curve_frame_count() {
        let time = curves.curve_times().frame_time_instant(frame);
        let of_day = begin.shifted_instant(time.instant_micros());
        let cells: Vec<String> = columns.iter().map(|column| column.cell_text_at(frame)).collect();
        let stated_count = count_position.and_then(|position| of_track(position).values.column_text_at(frame));
        let count = stated_count.unwrap_or_else(|| match cells.iter().all(String::is_empty) {
            true => "0".to_owned(),
            false => columns.len().to_string(),
        });
        let _ = write!(out, "\n{},{count},{}", format_timecode(of_day), cells.join(","));
    }
    out.push('\n');
    Some((out, findings))
}
