//! The times of the frames of points from film.

use std::collections::BTreeMap;

use chereme_motion::column::FrameNumberColumn;
use chereme_motion::{FrameRate, FrameTimes, RecordingInstant};
use chereme_sign::ErrorRemedy;
use serde_json::Value;

use super::{DEFAULT_KEYPOINT_FPS, KeypointError};
use crate::finding::ImportFinding;
use crate::scene::near_usual;
use crate::tally::FindingTally;
use crate::timecode::SECONDS_PER_DAY;
use crate::tracks::{another_rate, rate_of};

/// Collects what frames and films state about time.
#[derive(Debug, Default)]
pub(super) struct KeypointClock {
    rate: Option<f64>,
    /// Milliseconds of frames that state them, by row.
    millis: BTreeMap<u64, f64>,
    /// Times of frames without a unit, by row.
    stamps: BTreeMap<u64, f64>,
}

impl KeypointClock {
    /// Takes the rate that a film states.
    pub(super) fn take_stated_rate(&mut self, rate: Option<f64>) {
        self.rate = self.rate.or(rate);
    }

    /// Takes the time that a frame states.
    pub(super) fn take_frame_time(&mut self, row: u64, frame: &Value) {
        let named = |key: &str| frame.get(key).and_then(Value::as_f64);
        let millis = named("timestampMs")
            .or_else(|| named("timestamp_ms"))
            .or_else(|| named("time").map(|seconds| seconds * 1000.0));
        if let Some(at) = millis.filter(|at| at.is_finite()) {
            self.millis.entry(row).or_insert(at);
        } else if let Some(at) = named("timestamp").filter(|at| at.is_finite()) {
            self.stamps.entry(row).or_insert(at);
        }
    }

    /// Returns the times of `rows` frames and that of the first one: at the rate that the caller or the film states,
    /// else as the frames state them, else at the usual rate.
    pub(super) fn keypoint_frame_times(
        &self,
        rows: usize,
        known: Option<FrameRate>,
        findings: &mut FindingTally,
    ) -> Result<(FrameTimes, RecordingInstant), KeypointError> {
        let millis = match self.millis.is_empty() {
            true => in_millis(&self.stamps),
            false => self.millis.clone(),
        };
        let offset = first_row_offset(&millis, findings);
        // Times of frames say more than a rate in the head, which often is that of another export.
        let stated = even_keypoint_rate(&millis).or_else(|| self.rate.and_then(rate_of));
        if let (Some(known), Some(stated)) = (known, stated)
            && known != stated
        {
            findings.push_counted_finding(another_rate(stated, known));
        }
        let is_whole = millis.len() == rows && rows > 1;
        let rising = millis.values().is_sorted_by(|a, b| a < b);
        if known.is_none() && even_keypoint_rate(&millis).is_none() && is_whole && rising {
            findings.push_note_finding(
                None,
                "the times of the frames are not even; every frame has its own time",
            );
            let first = millis.values().next().copied().unwrap_or_default();
            let seconds = millis.values().map(|at| (at - first) / 1000.0);
            let listed_times =
                FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(seconds.collect()));
            let times = listed_times.map_err(|error| KeypointError::Track(error.to_string()))?;
            return Ok((times, offset));
        }
        if let Some(rate) = known.or(stated) {
            return Ok((FrameTimes::Even(rate), offset));
        }
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                None,
                format!(
                    "the file does not state the rate of the film; {DEFAULT_KEYPOINT_FPS} frames a second are taken"
                ),
            )
            .with_remedy(ErrorRemedy::command_remedy(
                "import it with --rate, such as --rate 50 or --rate 30000/1001",
            )),
        );
        let rate = FrameRate::new(DEFAULT_KEYPOINT_FPS, 1).map_err(|error| KeypointError::Track(error.to_string()))?;
        Ok((FrameTimes::Even(rate), offset))
    }
}

/// Returns the time of the first row; a date is none.
fn first_row_offset(millis: &BTreeMap<u64, f64>, findings: &mut FindingTally) -> RecordingInstant {
    let seconds = millis.get(&0).map_or(0.0, |at| at / 1000.0);
    if seconds.abs() < SECONDS_PER_DAY {
        return RecordingInstant::from_seconds(seconds);
    }
    findings.push_note_finding(
        None,
        format!("its first frame has the time {seconds:.3} s; that is 0 s here"),
    );
    RecordingInstant::RECORDING_START
}

/// Returns times without a unit as milliseconds: frames that are a whole second or more apart state these.
fn in_millis(stamps: &BTreeMap<u64, f64>) -> BTreeMap<u64, f64> {
    let values: Vec<f64> = stamps.values().copied().collect();
    let mut steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
    let unit = if usual < 1.0 { 1000.0 } else { 1.0 };
    stamps.iter().map(|(row, at)| (*row, at * unit)).collect()
}

/// Returns the rate that the milliseconds of frames show, if they are even.
fn even_keypoint_rate(millis: &BTreeMap<u64, f64>) -> Option<FrameRate> {
    let (first, last) = (millis.first_key_value()?, millis.last_key_value()?);
    let frames = last.0.checked_sub(*first.0).filter(|frames| *frames > 0)?;
    let rate = frames as f64 * 1000.0 / (last.1 - first.1);
    let close = |(row, at): (&u64, &f64)| {
        let expected_time = first.1 + (row - first.0) as f64 * 1000.0 / rate;
        (expected_time - at).abs() < 500.0 / rate
    };
    let even = rate.is_finite() && rate > 0.0 && millis.iter().all(close);
    rate_of(near_usual(rate)).filter(|_| even)
}
