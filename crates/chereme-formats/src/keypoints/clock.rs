//! The times of the frames of points from film.

use std::collections::BTreeMap;

use chereme_motion::column::Column;
use chereme_motion::{Instant, Rate, Times};
use chereme_sign::Remedy;
use serde_json::Value;

use super::{Error, USUAL_RATE};
use crate::finding::Finding;
use crate::scene::near_usual;
use crate::tally::Findings;
use crate::timecode::DAY;
use crate::tracks::{another_rate, rate_of};

/// Collects what frames and films state about time.
#[derive(Debug, Default)]
pub(super) struct Clock {
    rate: Option<f64>,
    /// Milliseconds of frames that state them, by row.
    millis: BTreeMap<u64, f64>,
    /// Times of frames without a unit, by row.
    stamps: BTreeMap<u64, f64>,
}

impl Clock {
    /// Takes the rate that a film states.
    pub(super) fn state(&mut self, rate: Option<f64>) {
        self.rate = self.rate.or(rate);
    }

    /// Takes the time that a frame states.
    pub(super) fn see(&mut self, row: u64, frame: &Value) {
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
    pub(super) fn times(
        &self,
        rows: usize,
        known: Option<Rate>,
        findings: &mut Findings,
    ) -> Result<(Times, Instant), Error> {
        let millis = match self.millis.is_empty() {
            true => in_millis(&self.stamps),
            false => self.millis.clone(),
        };
        let offset = offset(&millis, findings);
        let stated = even(&millis).or_else(|| self.rate.and_then(rate_of));
        if let (Some(known), Some(stated)) = (known, stated)
            && known != stated
        {
            findings.push(another_rate(stated, known));
        }
        let is_whole = millis.len() == rows && rows > 1;
        let rising = millis.values().is_sorted_by(|a, b| a < b);
        if known.is_none() && even(&millis).is_none() && is_whole && rising {
            findings.push(Finding::note(
                None,
                "the times of the frames are not even; every frame has its own time",
            ));
            let first = millis.values().next().copied().unwrap_or_default();
            let seconds = millis.values().map(|at| (at - first) / 1000.0);
            let times = Times::listed(Column::doubles(seconds.collect()));
            let times = times.map_err(|error| Error::Track(error.to_string()))?;
            return Ok((times, offset));
        }
        if let Some(rate) = known.or(stated) {
            return Ok((Times::Even(rate), offset));
        }
        findings.push(
            Finding::warning(
                None,
                format!("the file does not state the rate of the film; {USUAL_RATE} frames a second are taken"),
            )
            .with_remedy(Remedy::command(
                "import it with --rate, such as --rate 50 or --rate 30000/1001",
            )),
        );
        let rate = Rate::new(USUAL_RATE, 1).map_err(|error| Error::Track(error.to_string()))?;
        Ok((Times::Even(rate), offset))
    }
}

/// Returns the time of the first row; a date is none.
fn offset(millis: &BTreeMap<u64, f64>, findings: &mut Findings) -> Instant {
    let seconds = millis.get(&0).map_or(0.0, |at| at / 1000.0);
    if seconds.abs() < DAY {
        return Instant::from_seconds(seconds);
    }
    findings.push(Finding::note(
        None,
        format!("its first frame has the time {seconds:.3} s; that is 0 s here"),
    ));
    Instant::ZERO
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
fn even(millis: &BTreeMap<u64, f64>) -> Option<Rate> {
    let (first, last) = (millis.first_key_value()?, millis.last_key_value()?);
    let frames = last.0.checked_sub(*first.0).filter(|frames| *frames > 0)?;
    let rate = frames as f64 * 1000.0 / (last.1 - first.1);
    let close = |(row, at): (&u64, &f64)| {
        let want = first.1 + (row - first.0) as f64 * 1000.0 / rate;
        (want - at).abs() < 500.0 / rate
    };
    let even = rate.is_finite() && rate > 0.0 && millis.iter().all(close);
    rate_of(near_usual(rate)).filter(|_| even)
}
