//! C3D files of optical capture: markers, analog channels and events.
//!
//! [`raw`] mirrors the file; [`read`] turns it into [`Tracks`]: a track of markers with residuals, a track of
//! curves at the analog rate, model outputs such as joint angles as curves of their own, and events on a tier.
//! A point that no camera saw is a gap.

pub mod raw;
#[cfg(test)]
mod tests;
mod write;

use std::collections::BTreeSet;

use chereme_motion::column::{Column, Gaps};
use chereme_motion::{
    Convention, Curve, Curves, Direction, Instant, Marker, Markers, Quality, Space, Times,
};
use glam::DVec3;

use crate::finding::Finding;
use crate::tally::Findings;
use crate::timecode;
use crate::tracks::{
    Content, FileTrack, Tracks, axes_with_up, events, metres_of_unit, rate_of, say_axes, unique,
    up_of,
};
use raw::Document;

pub use raw::Error;
pub use write::write;

/// Reads a C3D file.
///
/// # Errors
/// [`Error`] if the bytes are no C3D file, end before the data, or hold neither points nor channels.
pub fn read(bytes: &[u8]) -> Result<(Tracks, Vec<Finding>), Error> {
    let document = raw::read(bytes)?;
    let mut findings = Findings::default();
    if document.frames < document.promised_frames {
        findings.push(Finding::warning(
            None,
            format!(
                "the file promises {} frames and holds {}",
                document.promised_frames, document.frames
            ),
        ));
    }
    if document.unread_frames > 0 {
        findings.push(
            Finding::warning(
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
        findings.push(Finding::warning(
            None,
            format!(
                "the header states {other} frames a second and POINT:RATE {}, which are taken",
                document.rate
            ),
        ));
    }
    if document.first_frame != 1 {
        findings.push(Finding::note(
            None,
            format!(
                "it begins with frame {} of its capture; that is 0 s here",
                document.first_frame
            ),
        ));
    }
    let rate = rate_of(document.rate).ok_or_else(|| Error::Rate(document.rate.to_string()))?;
    let reader = Reader {
        bytes,
        document: &document,
        times: Times::Even(rate),
    };
    let mut tracks = Tracks::default();
    let (places, outputs) = reader.kinds();
    if let Some(markers) = reader.markers(&places, &mut findings) {
        tracks
            .tracks
            .push(FileTrack::new("markers", Content::Markers(markers)));
    }
    if let Some(curves) = reader.outputs(&outputs) {
        tracks
            .tracks
            .push(FileTrack::new("model outputs", Content::Curves(curves)));
    }
    if let Some(curves) = reader.analog(&mut findings) {
        tracks
            .tracks
            .push(FileTrack::new("analog", Content::Curves(curves)));
    }
    if tracks.tracks.is_empty() {
        return Err(Error::Empty);
    }
    let code = document.parameters.timecode();
    let clock = code.and_then(|code| timecode::time_of_day(code, document.rate));
    for track in &mut tracks.tracks {
        track.clock = clock;
    }
    let moments = reader.moments(&mut findings);
    tracks.events = events("events", &moments, rate);
    Ok((tracks, findings.finish()))
}

struct Reader<'a> {
    bytes: &'a [u8],
    document: &'a Document,
    times: Times,
}

impl Reader<'_> {
    /// Returns the points' labels, each once; a point without a label is called by its number.
    fn labels(&self) -> Vec<String> {
        let labels = self.document.parameters.texts("POINT:LABELS");
        let given = (0..self.document.points).map(|at| labels.get(at).copied().unwrap_or_default());
        unique(given, "point")
    }

    /// Returns the numbers of the points that are places, and of those that are outputs of a model.
    fn kinds(&self) -> (Vec<usize>, Vec<usize>) {
        let parameters = &self.document.parameters;
        let mut outputs = BTreeSet::new();
        let groups = parameters.texts("POINT:TYPE_GROUPS");
        let of_model = ["ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS"];
        for name in of_model.iter().copied().chain(groups) {
            if of_model.contains(&name.to_uppercase().as_str()) {
                outputs.extend(parameters.texts(&format!("POINT:{}", name.to_uppercase())));
            }
        }
        let labels = self.labels();
        // The list may leave out the subject of a label such as `Anna:LElbowAngles`.
        let bare = |label: &str| label.rsplit(':').next().unwrap_or_default().to_owned();
        (0..self.document.points).partition(|at| {
            let label = labels[*at].as_str();
            !outputs.contains(label) && !outputs.contains(bare(label).as_str())
        })
    }

    fn markers(&self, points: &[usize], findings: &mut Findings) -> Option<Markers> {
        if points.is_empty() || self.document.frames == 0 {
            return None;
        }
        let labels = self.labels();
        let prefixes = self.document.parameters.texts("SUBJECTS:LABEL_PREFIXES");
        let mut nought = 0;
        let made: Option<Vec<Marker>> = points
            .iter()
            .map(|point| self.marker(*point, &labels[*point], &prefixes, &mut nought))
            .collect();
        let made = made?;
        if nought > 0 {
            findings.push(Finding::warning(
                None,
                format!("{nought} places are exactly 0 0 0 though the file calls them seen; some programs write gaps so"),
            ));
        }
        let convention = self.convention(&made, findings);
        let markers = Markers::new(self.times.clone(), Space::World(convention), made).ok()?;
        Some(markers.rated(Quality::Residual))
    }

    fn marker(
        &self,
        point: usize,
        label: &str,
        prefixes: &[&str],
        nought: &mut usize,
    ) -> Option<Marker> {
        let document = self.document;
        let mut axes: [Vec<f32>; 3] = Default::default();
        let (mut residuals, mut gaps) = (Vec::new(), Vec::new());
        for frame in 0..document.frames {
            let read = document.point(self.bytes, frame, point)?;
            for (axis, value) in axes.iter_mut().zip(read.at) {
                axis.push(value);
            }
            residuals.push(i32::from(read.residual.unwrap_or(0)));
            match read.residual {
                None => gaps.push(frame as u32),
                Some(0) if read.at == [0.0; 3] => *nought += 1,
                Some(_) => {}
            }
        }
        let gaps = Gaps::at(gaps);
        let scale = f64::from(document.scale.abs());
        let scale = if scale.is_finite() && scale > 0.0 {
            scale
        } else {
            1.0
        };
        let column = |values: Vec<f32>| {
            let column = if document.is_real() {
                Column::singles(values)
            } else {
                let whole = values.iter().map(|value| *value as i32).collect();
                Column::integers(whole, 0.0, scale).ok()?
            };
            column.with_gaps(&gaps).ok()
        };
        let place: Option<Vec<Column>> = axes.into_iter().map(column).collect();
        let (group, name) = prefixes
            .iter()
            .find_map(|prefix| Some((*prefix, label.strip_prefix(prefix)?)))
            .filter(|(prefix, name)| !prefix.is_empty() && !name.is_empty())
            .unwrap_or(("", label));
        Some(Marker {
            group: group.trim_end_matches(':').to_owned(),
            name: name.to_owned(),
            place: place?,
            quality: Column::integers(residuals, 0.0, scale)
                .and_then(|column| column.with_gaps(&gaps))
                .ok(),
        })
    }

    /// Returns unit and axes: units from the file, up from its screen axes, left from the markers' names.
    fn convention(&self, markers: &[Marker], findings: &mut Findings) -> Convention {
        let parameters = &self.document.parameters;
        let unit = parameters.text("POINT:UNITS").unwrap_or_default();
        let metres_per_unit = metres_of_unit(unit).unwrap_or_else(|| {
            findings.push(Finding::note(
                None,
                format!("the unit of points is {unit:?}; millimetres are assumed"),
            ));
            0.001
        });
        let up = self.up(markers, findings);
        let axes = axes_with_up(markers, up, findings);
        Convention {
            metres_per_unit,
            axes,
        }
    }

    /// Returns the axis that is up: that of the markers of head and feet, else that of the screen, else Z.
    fn up(&self, markers: &[Marker], findings: &mut Findings) -> Direction {
        let text = self.document.parameters.text("POINT:Y_SCREEN");
        let screen = text.and_then(|axis| {
            let sign = if axis.contains('-') { '-' } else { '+' };
            let axis = axis.trim_matches(['+', '-', ' ']).to_uppercase();
            format!("{sign}{axis}").parse::<Direction>().ok()
        });
        match (screen, up_of(markers)) {
            (Some(screen), Some(shown)) if screen != shown => {
                let text = format!(
                    "POINT:Y_SCREEN says that {screen} is up, and the markers of head and feet show {shown}, which is taken"
                );
                findings.push(Finding::warning(None, text).with_remedy(say_axes()));
                shown
            }
            (Some(up), _) | (None, Some(up)) => up,
            (None, None) => {
                let text = "no markers of head and feet show which axis is up; +Z is taken";
                findings.push(Finding::note(None, text).with_remedy(say_axes()));
                Direction::nearest(DVec3::Z)
            }
        }
    }

    /// Returns outputs of a model as three curves each.
    fn outputs(&self, points: &[usize]) -> Option<Curves> {
        let labels = self.labels();
        let mut curves = Vec::new();
        for point in points {
            let mut axes: [Vec<f32>; 3] = Default::default();
            for frame in 0..self.document.frames {
                let read = self.document.point(self.bytes, frame, *point)?;
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
                curves.push(Curve::new(name, Column::singles(values)));
            }
        }
        Curves::new(self.times.clone(), curves).ok()
    }

    fn analog(&self, findings: &mut Findings) -> Option<Curves> {
        let document = self.document;
        if document.channels == 0 || document.frames == 0 {
            return None;
        }
        let parameters = &document.parameters;
        let labels = parameters.texts("ANALOG:LABELS");
        let given = (0..document.channels).map(|at| labels.get(at).copied().unwrap_or_default());
        let names = unique(given, "analog");
        let units = parameters.texts("ANALOG:UNITS");
        let is_unsigned = parameters
            .text("ANALOG:FORMAT")
            .is_some_and(|format| format.eq_ignore_ascii_case("unsigned"));
        let general = parameters.number("ANALOG:GEN_SCALE").unwrap_or(1.0);
        let scales = parameters.numbers("ANALOG:SCALE");
        let offsets = match is_unsigned {
            true => parameters.numbers("ANALOG:OFFSET"),
            false => parameters.signed("ANALOG:OFFSET"),
        };
        let mut curves = Vec::new();
        for (channel, name) in names.into_iter().enumerate() {
            let mut values = Vec::with_capacity(document.frames * document.samples);
            for frame in 0..document.frames {
                for sample in 0..document.samples {
                    let at = (frame, sample, channel);
                    values.push(document.sample(self.bytes, at, is_unsigned)?);
                }
            }
            let unit = general * scales.get(channel).copied().unwrap_or(1.0);
            let zero = offsets.get(channel).copied().unwrap_or(0.0);
            let scaled = unit.is_finite() && unit != 0.0 && zero.is_finite();
            let (unit, zero) = if scaled { (unit, zero) } else { (1.0, 0.0) };
            if !scaled {
                findings.add("analog channels without a scale", || {
                    Finding::warning(None, format!("the analog channel {name:?} has no usable scale; its numbers are the file's own"))
                });
            }
            let column = if document.is_real() {
                let value = |raw: &f32| (f64::from(*raw) - zero) * unit;
                Column::doubles(values.iter().map(value).collect())
            } else {
                let whole = values.iter().map(|value| *value as i32).collect();
                Column::integers(whole, zero, unit).ok()?
            };
            curves.push(Curve {
                name,
                unit: units.get(channel).copied().unwrap_or_default().to_owned(),
                values: column,
            });
        }
        let rate = rate_of(document.rate * document.samples as f64)?;
        Curves::new(Times::Even(rate), curves).ok()
    }

    /// Returns the events of the header and of the group EVENT, from the start of the file.
    fn moments(&self, findings: &mut Findings) -> Vec<(Instant, String)> {
        let document = self.document;
        let mut found: Vec<(f64, String)> = document
            .header_events
            .iter()
            .map(|(seconds, label)| (f64::from(*seconds), label.clone()))
            .collect();
        let parameters = &document.parameters;
        let times = parameters.numbers("EVENT:TIMES");
        let (labels, contexts) = (
            parameters.texts("EVENT:LABELS"),
            parameters.texts("EVENT:CONTEXTS"),
        );
        for (at, time) in times.chunks_exact(2).enumerate() {
            let seconds = time[0] * 60.0 + time[1];
            let word = |texts: &[&str]| texts.get(at).copied().unwrap_or_default().to_owned();
            let words = [word(&contexts), word(&labels)];
            let words: Vec<&str> = words
                .iter()
                .map(String::as_str)
                .filter(|word| !word.is_empty())
                .collect();
            found.push((seconds, words.join(" ")));
        }
        // Times count from frame 1 of the capture.
        let begin = f64::from(document.first_frame.saturating_sub(1)) / document.rate;
        let length = document.frames as f64 / document.rate;
        let (inside, outside): (Vec<_>, Vec<_>) = found.into_iter().partition(|(seconds, _)| {
            let at = seconds - begin;
            at.is_finite() && at >= 0.0 && at <= length
        });
        if !outside.is_empty() {
            let labels: Vec<&str> = outside.iter().map(|(_, label)| label.as_str()).collect();
            findings.push(Finding::note(
                None,
                format!(
                    "events outside the frames were left out: {}",
                    labels.join(", ")
                ),
            ));
        }
        let named = inside.into_iter().map(|(seconds, label)| {
            let label = if label.is_empty() {
                "event".to_owned()
            } else {
                label
            };
            (Instant::from_seconds(seconds - begin), label)
        });
        named.collect()
    }
}
