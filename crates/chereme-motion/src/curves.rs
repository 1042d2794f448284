//! Named scalar channels over time: face parameters, analog signals, forces, any number that is not a position.

use std::collections::BTreeSet;

use crate::column::FrameNumberColumn;
use crate::time::{RecordingInstant, TimeSpan};
use crate::times::FrameTimes;

/// One scalar channel.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalarCurve {
    /// The name in the file; unique among the curves of a track.
    pub name: String,
    /// The unit of the numbers, such as `rad`, `N` or `mV`; empty for a plain number or an unknown unit.
    pub unit: String,
    /// One number per frame.
    pub values: FrameNumberColumn,
}

impl ScalarCurve {
    /// Returns a curve of plain numbers.
    #[must_use]
    pub fn new(name: impl Into<String>, values: FrameNumberColumn) -> Self {
        Self {
            name: name.into(),
            unit: String::new(),
            values,
        }
    }
}

/// Curves with the same times: one track of scalar channels.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTrack {
    times: FrameTimes,
    frames: usize,
    curves: Vec<ScalarCurve>,
}

/// A reason why channels are not a track.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TrackError {
    /// There is no channel.
    #[error("there is no channel")]
    Empty,
    /// A channel has no name.
    #[error("channel {0} has no name")]
    Nameless(usize),
    /// Two channels have the same name.
    #[error("two channels have the name {0:?}")]
    Twice(String),
    /// A channel is longer or shorter than the first.
    #[error("the channel {name:?} has {found} frames, and {expected} were expected")]
    Length {
        /// The channel's name.
        name: String,
        /// Its frames.
        found: usize,
        /// The frames of the first channel.
        expected: usize,
    },
    /// There are more or fewer times than frames.
    #[error("{times} times were given for {frames} frames")]
    Times {
        /// The times given.
        times: usize,
        /// The frames of the channels.
        frames: usize,
    },
    /// A point has more or fewer coordinates than its space.
    #[error("the point {name:?} has {found} coordinates, and its space has {expected}")]
    Coordinates {
        /// The point's name.
        name: String,
        /// Its coordinates.
        found: usize,
        /// The coordinates of its space.
        expected: usize,
    },
    /// A limb joins points that do not exist, or a point to itself.
    #[error("a limb joins the points {from} and {to} of {points}")]
    Limb {
        /// Its first point.
        from: usize,
        /// Its second point.
        to: usize,
        /// The number of points.
        points: usize,
    },
    /// The unit of positions is not a positive number.
    #[error("{0} is no length for a unit of places")]
    Unit(String),
}

/// Checks the lengths of channels, and returns their number of frames.
pub(crate) fn channel_frame_count<'a>(
    times: &FrameTimes,
    mut channels: impl Iterator<Item = (&'a str, &'a FrameNumberColumn)>,
) -> Result<usize, TrackError> {
    let (_, first) = channels.next().ok_or(TrackError::Empty)?;
    let frames = first.len();
    // Every column is held against the first: there is no other statement of the frame count.
    if let Some((name, odd)) = channels.find(|(_, column)| column.len() != frames) {
        return Err(TrackError::Length {
            name: name.to_owned(),
            found: odd.len(),
            expected: frames,
        });
    }
    match times.timed_frame_count() {
        // Even times are valid for any number of frames.
        Some(times) if times != frames => Err(TrackError::Times { times, frames }),
        _ => Ok(frames),
    }
}

/// Checks that every channel has a name, and that names are unique.
pub(crate) fn check_names<'a>(names: impl Iterator<Item = (&'a str, &'a str)>) -> Result<(), TrackError> {
    let mut seen = BTreeSet::new();
    // Names need to be unique only within a group, such as one hand of several.
    for (at, (group, name)) in names.enumerate() {
        if name.is_empty() {
            return Err(TrackError::Nameless(at));
        }
        if !seen.insert((group, name)) {
            return Err(TrackError::Twice(name.to_owned()));
        }
    }
    Ok(())
}

impl CurveTrack {
    /// Returns the track of `curves`.
    ///
    /// # Errors
    /// [`TrackError`] if there is no curve, names are missing or equal, or lengths differ.
    pub fn new(times: FrameTimes, curves: Vec<ScalarCurve>) -> Result<Self, TrackError> {
        check_names(curves.iter().map(|curve| ("", curve.name.as_str())))?;
        let channels = curves.iter().map(|curve| (curve.name.as_str(), &curve.values));
        let frames = channel_frame_count(&times, channels)?;
        Ok(Self { times, frames, curves })
    }

    /// Returns the times of the frames.
    #[must_use]
    pub fn curve_times(&self) -> &FrameTimes {
        &self.times
    }

    /// Returns how many frames there are.
    #[must_use]
    pub fn curve_frame_count(&self) -> usize {
        self.frames
    }

    /// Returns the span of the track, counted from its own start.
    #[must_use]
    pub fn curve_track_span(&self) -> TimeSpan {
        self.times.frame_times_span(self.frames)
    }

    /// Returns the curves in the order of the file.
    #[must_use]
    pub fn track_curves(&self) -> &[ScalarCurve] {
        &self.curves
    }

    /// Returns every curve's number at `instant`: interpolated between the two frames around it, or that of the nearest
    /// frame outside the track; `None` in a gap.
    #[must_use]
    pub fn sample_curves(&self, instant: RecordingInstant) -> Vec<Option<f64>> {
        let Some(last) = self.frames.checked_sub(1) else {
            return vec![None; self.curves.len()];
        };
        let first = match &self.times {
            FrameTimes::Even(rate) => {
                let frame_position = instant.instant_seconds().max(0.0) * rate.per_second();
                (frame_position.floor() as usize).min(last)
            }
            FrameTimes::Listed(_) => self.times.shown_frame_at(instant, self.frames).unwrap_or(last),
        };
        let second = (first + 1).min(last);
        let (a, b) = (
            self.times.frame_time_instant(first).instant_seconds(),
            self.times.frame_time_instant(second).instant_seconds(),
        );
        let raw_share = ((instant.instant_seconds() - a) / (b - a)).clamp(0.0, 1.0);
        // At the last frame both ends are one frame, and the share is 0/0.
        let share = if raw_share.is_nan() { 0.0 } else { raw_share };
        let blend = |curve: &ScalarCurve| {
            let from = curve.values.column_value_at(first)?;
            // Exactly at a frame, a gap in the next one does not matter.
            if share == 0.0 {
                return Some(from);
            }
            Some(from + (curve.values.column_value_at(second)? - from) * share)
        };
        self.curves.iter().map(blend).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::FrameRate;

    fn rate() -> FrameTimes {
        FrameTimes::Even(FrameRate::new(10, 1).expect("a rate"))
    }

    #[test]
    fn curves_are_blended_between_frames_and_stop_at_gaps() {
        let jaw = FrameNumberColumn::from_single_floats(vec![0.0, 1.0, f32::NAN, 0.5]);
        let curves = CurveTrack::new(rate(), vec![ScalarCurve::new("JawOpen", jaw)]).expect("a track");
        let at = |seconds| curves.sample_curves(RecordingInstant::from_seconds(seconds))[0];
        assert_eq!(at(-1.0), Some(0.0));
        assert!((at(0.05).expect("a number") - 0.5).abs() < 1e-12);
        assert_eq!(
            [at(0.1), at(0.15), at(0.2), at(0.3), at(9.0)],
            [Some(1.0), None, None, Some(0.5), Some(0.5)]
        );
        assert_eq!(curves.curve_track_span().span_seconds(), 0.4);
    }

    #[test]
    fn channels_that_cannot_form_a_track_are_refused() {
        let curve =
            |name: &str, frames| ScalarCurve::new(name, FrameNumberColumn::from_double_floats(vec![0.0; frames]));
        let cases = [
            (vec![], TrackError::Empty),
            (vec![curve("", 1)], TrackError::Nameless(0)),
            (vec![curve("a", 1), curve("a", 1)], TrackError::Twice("a".into())),
            (
                vec![curve("a", 2), curve("b", 1)],
                TrackError::Length {
                    name: "b".into(),
                    found: 1,
                    expected: 2,
                },
            ),
        ];
        for (curves, fault) in cases {
            assert_eq!(CurveTrack::new(rate(), curves), Err(fault));
        }
        let times =
            FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(vec![0.0, 0.5])).expect("times");
        let fault = TrackError::Times { times: 2, frames: 3 };
        assert_eq!(CurveTrack::new(times, vec![curve("a", 3)]), Err(fault));
    }
}
