//! C3D files of optical capture: markers, analog channels and events.
//!
//! [`c3d_raw`] mirrors the file; [`read_c3d`] turns it into [`CapturedTracks`]: a track of markers with residuals, a track of
//! curves at the analog rate, model outputs such as joint angles as curves of their own, and events on a tier.
//! A point that no camera saw is a gap.

pub mod c3d_raw;
mod c3d_write;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

use chereme_motion::column::{ColumnGaps, FrameNumberColumn};
use chereme_motion::{
    AxisDirection, CurveTrack, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, QualityMeaning, RecordingInstant,
    ScalarCurve, SpaceConvention,
};
use glam::DVec3;

use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::timecode;
use crate::tracks::{
    CapturedTrackContent, CapturedTracks, FileTrack, axes_with_up, events_to_transcript, metres_of_unit, rate_of,
    say_axes, unique_track_names, up_of,
};
use c3d_raw::C3dDocument;

pub use c3d_raw::C3dError;
pub use c3d_write::write_c3d;

/// Reads a C3D file.
///
/// # Errors
/// [`C3dError`] if the bytes are no C3D file, end before the data, or hold neither points nor channels.
pub fn read_c3d(bytes: &[u8]) -> Result<(CapturedTracks, Vec<ImportFinding>), C3dError> {
    let document = c3d_raw::read_c3d_document(bytes)?;
    let mut findings = FindingTally::default();
    if document.frames < document.promised_frames {
        findings.push_warning_finding(
            None,
            format!(
                "the file promises {} frames and holds {}",
                document.promised_frames, document.frames
            ),
        );
    }
    if document.unread_frames > 0 {
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                None,
                format!(
                    "the file states {} frames, and its data has room for {} more, which are left out",
                    document.frames, document.unread_frames
                ),
            )
            .with_remedy("correct the number of the last frame in the file's header if they are frames"),
        );
    }
    if let Some(other) = document.other_rate {
        findings.push_warning_finding(
            None,
            format!(
                "the header states {other} frames a second and POINT:RATE {}, which are taken",
                document.rate
            ),
        );
    }
    // Frames are counted from 1, and cut captures keep their numbers.
    if document.first_frame != 1 {
        findings.push_note_finding(
            None,
            format!(
                "it begins with frame {} of its capture; that is 0 s here",
                document.first_frame
            ),
        );
    }
    let rate = rate_of(document.rate).ok_or_else(|| C3dError::Rate(document.rate.to_string()))?;
    let reader = C3dReader {
        bytes,
        document: &document,
        times: FrameTimes::Even(rate),
    };
    let mut tracks = CapturedTracks::default();
    let (places, outputs) = reader.split_point_kinds();
    if let Some(markers) = reader.read_c3d_markers(&places, &mut findings) {
        tracks
            .tracks
            .push(FileTrack::new("markers", CapturedTrackContent::Markers(markers)));
    }
    if let Some(curves) = reader.outputs(&outputs) {
        tracks
            .tracks
            .push(FileTrack::new("model outputs", CapturedTrackContent::Curves(curves)));
    }
    if let Some(curves) = reader.analog(&mut findings) {
        tracks
            .tracks
            .push(FileTrack::new("analog", CapturedTrackContent::Curves(curves)));
    }
    if tracks.tracks.is_empty() {
        return Err(C3dError::Empty);
    }
    let code = document.parameters.first_frame_timecode();
    let clock = code.and_then(|code| timecode::time_of_day(code, document.rate));
    for track in &mut tracks.tracks {
        track.clock = clock;
    }
    let moments = reader.c3d_event_moments(&mut findings);
    tracks.events = events_to_transcript("events", &moments, rate);
    Ok((tracks, findings.finish_finding_tally()))
}

struct C3dReader<'a> {
    bytes: &'a [u8],
    document: &'a C3dDocument,
    times: FrameTimes,
}

impl C3dReader<'_> {
    /// Returns the points' labels, each once; a point without a label is called by its number.
    fn c3d_point_labels(&self) -> Vec<String> {
        let labels = self.document.parameters.parameter_texts("POINT:LABELS");
        let given = (0..self.document.points).map(|at| labels.get(at).copied().unwrap_or_default());
        unique_track_names(given, "point")
    }

    /// Returns the numbers of the points that are places, and of those that are outputs of a model.
    fn split_point_kinds(&self) -> (Vec<usize>, Vec<usize>) {
        let parameters = &self.document.parameters;
        let mut outputs = BTreeSet::new();
        let groups = parameters.parameter_texts("POINT:TYPE_GROUPS");
        let of_model = ["ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS"];
        for name in of_model.iter().copied().chain(groups) {
            if of_model.contains(&name.to_uppercase().as_str()) {
                outputs.extend(parameters.parameter_texts(&format!("POINT:{}", name.to_uppercase())));
            }
        }
        let labels = self.c3d_point_labels();
        // The list may leave out the subject of a label such as `Anna:LElbowAngles`.
        let bare = |label: &str| label.rsplit(':').next().unwrap_or_default().to_owned();
        (0..self.document.points).partition(|at| {
            let label = labels[*at].as_str();
            !outputs.contains(label) && !outputs.contains(bare(label).as_str())
        })
    }

    fn read_c3d_markers(&self, points: &[usize], findings: &mut FindingTally) -> Option<MarkerTrack> {
        if points.is_empty() || self.document.frames == 0 {
            return None;
        }
        let labels = self.c3d_point_labels();
        let prefixes = self.document.parameters.parameter_texts("SUBJECTS:LABEL_PREFIXES");
        let mut nought = 0;
        let made_markers: Option<Vec<MotionMarker>> = points
            .iter()
            .map(|point| self.read_c3d_marker(*point, &labels[*point], &prefixes, &mut nought))
            .collect();
        let made = made_markers?;
        if nought > 0 {
            findings.push_warning_finding(
                None,
                format!(
                    "{nought} places are exactly 0 0 0 though the file calls them seen; some programs write gaps so"
                ),
            );
        }
        let convention = self.c3d_convention(&made, findings);
        let markers = MarkerTrack::new(self.times.clone(), MarkerSpace::World(convention), made).ok()?;
        Some(markers.with_quality_meaning(QualityMeaning::Residual))
    }

    fn read_c3d_marker(
        &self,
        point: usize,
        label: &str,
        prefixes: &[&str],
        nought: &mut usize,
    ) -> Option<MotionMarker> {
        let document = self.document;
        let mut axes: [Vec<f32>; 3] = Default::default();
        let (mut residuals, mut gaps) = (Vec::new(), Vec::new());
        for frame in 0..document.frames {
            let read = document.c3d_frame_point(self.bytes, frame, point)?;
            for (axis, value) in axes.iter_mut().zip(read.at) {
                axis.push(value);
            }
            residuals.push(i32::from(read.residual.unwrap_or(0)));
            match read.residual {
                None => gaps.push(frame as u32),
                // A point at the origin without a residual most often is a gap that was not marked.
                Some(0) if read.at == [0.0; 3] => *nought += 1,
                Some(_) => {}
            }
        }
        let gaps = ColumnGaps::from_gap_frames(gaps);
        // The sign of the scale says whether the numbers are real or whole.
        let stated_scale = f64::from(document.scale.abs());
        let scale = if stated_scale.is_finite() && stated_scale > 0.0 {
            stated_scale
        } else {
            1.0
        };
        let column = |values: Vec<f32>| {
            let column = if document.is_real() {
                FrameNumberColumn::from_single_floats(values)
            } else {
                let whole_values = values.iter().map(|value| *value as i32).collect();
                FrameNumberColumn::from_scaled_integers(whole_values, 0.0, scale).ok()?
            };
            column.with_gaps(&gaps).ok()
        };
        let place: Option<Vec<FrameNumberColumn>> = axes.into_iter().map(column).collect();
        // Vicon writes the subject before the name of each of its markers.
        let (group, name) = prefixes
            .iter()
            .find_map(|prefix| Some((*prefix, label.strip_prefix(prefix)?)))
            .filter(|(prefix, name)| !prefix.is_empty() && !name.is_empty())
            .unwrap_or(("", label));
        Some(MotionMarker {
            group: group.trim_end_matches(':').to_owned(),
            name: name.to_owned(),
            place: place?,
            quality: FrameNumberColumn::from_scaled_integers(residuals, 0.0, scale)
                .and_then(|column| column.with_gaps(&gaps))
                .ok(),
        })
    }

    /// Returns unit and axes: units from the file, up from its screen axes, left from the markers' names.
    fn c3d_convention(&self, markers: &[MotionMarker], findings: &mut FindingTally) -> SpaceConvention {
        let parameters = &self.document.parameters;
        let unit = parameters.parameter_text("POINT:UNITS").unwrap_or_default();
        let metres_per_unit = metres_of_unit(unit).unwrap_or_else(|| {
            findings.push_note_finding(None, format!("the unit of points is {unit:?}; millimetres are assumed"));
            0.001
        });
        let up = self.find_up_direction(markers, findings);
        let axes = axes_with_up(markers, up, findings);
        SpaceConvention { metres_per_unit, axes }
    }

    /// Returns the axis that is up: that of the markers of head and feet, else that of the screen, else Z.
    fn find_up_direction(&self, markers: &[MotionMarker], findings: &mut FindingTally) -> AxisDirection {
        let text = self.document.parameters.parameter_text("POINT:Y_SCREEN");
        let screen = text.and_then(|axis| {
            let sign = if axis.contains('-') { '-' } else { '+' };
            let axis = axis.trim_matches(['+', '-', ' ']).to_uppercase();
            format!("{sign}{axis}").parse::<AxisDirection>().ok()
        });
        match (screen, up_of(markers)) {
            (Some(screen), Some(shown)) if screen != shown => {
                let text = format!(
                    "POINT:Y_SCREEN says that {screen} is up, and the markers of head and feet show {shown}, which is taken"
                );
                findings.push_counted_finding(ImportFinding::new_warning_finding(None, text).with_remedy(say_axes()));
                shown
            }
            (Some(up), _) | (None, Some(up)) => up,
            (None, None) => {
                let text = "no markers of head and feet show which axis is up; +Z is taken";
                findings.push_counted_finding(ImportFinding::new_note_finding(None, text).with_remedy(say_axes()));
                AxisDirection::nearest_axis_direction(DVec3::Z)
            }
        }
    }

    /// Returns outputs of a model as three curves each.
    fn outputs(&self, points: &[usize]) -> Option<CurveTrack> {
        let labels = self.c3d_point_labels();
        let mut curves = Vec::new();
        for point in points {
            let mut axes: [Vec<f32>; 3] = Default::default();
            for frame in 0..self.document.frames {
                let read = self.document.c3d_frame_point(self.bytes, frame, *point)?;
                let scale = if self.document.is_real() {
                    1.0
                } else {
                    self.document.scale
                };
                for (axis, value) in axes.iter_mut().zip(read.at) {
                    axis.push(read.residual.map_or(f32::NAN, |_| value * scale));
                }
            }
            for (axis, values) in ["x", "y", "z"].iter().zip(axes) {
                let name = format!("{}.{axis}", labels[*point]);
                curves.push(ScalarCurve::new(name, FrameNumberColumn::from_single_floats(values)));
            }
        }
        CurveTrack::new(self.times.clone(), curves).ok()
    }

    fn analog(&self, findings: &mut FindingTally) -> Option<CurveTrack> {
        let document = self.document;
        if document.channels == 0 || document.frames == 0 {
            return None;
        }
        let parameters = &document.parameters;
        let labels = parameters.parameter_texts("ANALOG:LABELS");
        let given = (0..document.channels).map(|at| labels.get(at).copied().unwrap_or_default());
        let names = unique_track_names(given, "analog");
        let units = parameters.parameter_texts("ANALOG:UNITS");
        let is_unsigned = parameters
            .parameter_text("ANALOG:FORMAT")
            .is_some_and(|format| format.eq_ignore_ascii_case("unsigned"));
        let general = parameters.parameter_number("ANALOG:GEN_SCALE").unwrap_or(1.0);
        let scales = parameters.unsigned_parameter_numbers("ANALOG:SCALE");
        // Offsets are signed as the samples are.
        let offsets = match is_unsigned {
            true => parameters.unsigned_parameter_numbers("ANALOG:OFFSET"),
            false => parameters.signed_parameter_numbers("ANALOG:OFFSET"),
        };
        let mut curves = Vec::new();
        for (channel, name) in names.into_iter().enumerate() {
            let mut values = Vec::with_capacity(document.frames * document.samples);
            for frame in 0..document.frames {
                for sample in 0..document.samples {
                    values.push(document.c3d_analog_sample(self.bytes, frame, sample, channel, is_unsigned)?);
                }
            }
            let unit = general * scales.get(channel).copied().unwrap_or(1.0);
            let zero = offsets.get(channel).copied().unwrap_or(0.0);
            let scaled = unit.is_finite() && unit != 0.0 && zero.is_finite();
            let (unit, zero) = if scaled { (unit, zero) } else { (1.0, 0.0) };
            if !scaled {
                findings.add_limited_warning("analog channels without a scale", None, || {
                    format!("the analog channel {name:?} has no usable scale; its numbers are the file's own")
                });
            }
            let column = if document.is_real() {
                let value = |raw: &f32| (f64::from(*raw) - zero) * unit;
                FrameNumberColumn::from_double_floats(values.iter().map(value).collect())
            } else {
                let whole_values = values.iter().map(|value| *value as i32).collect();
                FrameNumberColumn::from_scaled_integers(whole_values, zero, unit).ok()?
            };
            curves.push(ScalarCurve {
                name,
                unit: units.get(channel).copied().unwrap_or_default().to_owned(),
                values: column,
            });
        }
        let rate = rate_of(document.rate * document.samples as f64)?;
        CurveTrack::new(FrameTimes::Even(rate), curves).ok()
    }

    /// Returns the events of the header and of the group EVENT, from the start of the file.
    fn c3d_event_moments(&self, findings: &mut FindingTally) -> Vec<(RecordingInstant, String)> {
        let document = self.document;
        let mut event_list: Vec<(f64, String)> = document
            .header_events
            .iter()
            .map(|(seconds, label)| (f64::from(*seconds), label.clone()))
            .collect();
        let parameters = &document.parameters;
        let times = parameters.unsigned_parameter_numbers("EVENT:TIMES");
        let (labels, contexts) = (
            parameters.parameter_texts("EVENT:LABELS"),
            parameters.parameter_texts("EVENT:CONTEXTS"),
        );
        for (at, time) in times.chunks_exact(2).enumerate() {
            // EVENT:TIMES holds pairs of minutes and seconds.
            let seconds = time[0] * 60.0 + time[1];
            let word = |texts: &[&str]| texts.get(at).copied().unwrap_or_default().to_owned();
            let both_words = [word(&contexts), word(&labels)];
            let words: Vec<&str> = both_words
                .iter()
                .map(String::as_str)
                .filter(|word| !word.is_empty())
                .collect();
            event_list.push((seconds, words.join(" ")));
        }
        // Times count from frame 1 of the capture.
        let begin = f64::from(document.first_frame.saturating_sub(1)) / document.rate;
        let length = document.frames as f64 / document.rate;
        let (inside, outside): (Vec<_>, Vec<_>) = event_list.into_iter().partition(|(seconds, _)| {
            let event_time = seconds - begin;
            event_time.is_finite() && event_time >= 0.0 && event_time <= length
        });
        if !outside.is_empty() {
            let labels: Vec<&str> = outside.iter().map(|(_, label)| label.as_str()).collect();
            findings.push_note_finding(
                None,
                format!("events outside the frames were left out: {}", labels.join(", ")),
            );
        }
        let named = inside.into_iter().map(|(seconds, label)| {
            let label = if label.is_empty() { "event".to_owned() } else { label };
            (RecordingInstant::from_seconds(seconds - begin), label)
        });
        named.collect()
    }
}
