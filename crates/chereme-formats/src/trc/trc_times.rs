//! The times of the rows of a TRC file.

use chereme_motion::column::{FileNumber, FrameNumberColumn};
use chereme_motion::{FrameRate, FrameTimes, RecordingInstant};

use super::{TrcError, TrcRows};
use crate::scene::near_usual;
use crate::tally::FindingTally;
use crate::tracks::rate_of;

/// Returns an even rate if the times are even, else the times themselves; and the time of the first frame.
pub(super) fn read_trc_times(
    rows: &TrcRows,
    stated: Option<&str>,
    findings: &mut FindingTally,
) -> Result<(FrameTimes, RecordingInstant), TrcError> {
    let rate = stated
        .and_then(|text| text.replacen(',', ".", 1).parse::<f64>().ok())
        .and_then(rate_of);
    let seconds = complete_trc_numbers(&rows.times);
    let rate = match (rate, seconds.as_deref().and_then(rate_of_times)) {
        (Some(rate), _) => rate,
        (None, Some(rate)) => {
            let stated = stated.unwrap_or_default();
            let text = format!("DataRate is {stated:?}; the times of the rows show {rate}");
            findings.push_warning_finding(3, text);
            rate
        }
        (None, None) => {
            let stated_text = stated.unwrap_or_default().chars().take(40).collect();
            return Err(TrcError::Rate { found: stated_text });
        }
    };
    let Some(seconds) = seconds else {
        return Ok((by_number(rows, rate, findings)?, RecordingInstant::RECORDING_START));
    };
    let offset = RecordingInstant::from_seconds(seconds[0]);
    // Times are written with few decimals.
    let last_decimal = last_decimal_worth(&rows.times);
    let even = |unit: f64| {
        let slack = 0.5 * rate.frame_time() + last_decimal * unit;
        (0..).zip(&seconds).all(|(frame, time)| {
            let even_time = f64::from(frame) * rate.frame_time();
            ((time - seconds[0]) * unit - even_time).abs() <= slack
        })
    };
    if even(1.0) {
        return Ok((FrameTimes::Even(rate), offset));
    }
    if even(0.001) {
        let text = "the times are milliseconds, as DataRate shows; they are read as such";
        findings.push_warning_finding(None, text);
        return Ok((
            FrameTimes::Even(rate),
            RecordingInstant::from_seconds(seconds[0] / 1000.0),
        ));
    }
    findings.push_note_finding(None, "the times do not follow DataRate; every frame has its own time");
    let shifted: Vec<f64> = seconds.iter().map(|time| time - seconds[0]).collect();
    let column = if seconds[0] == 0.0 {
        FrameNumberColumn::from_decimals(rows.times.iter().cloned())
    } else {
        FrameNumberColumn::from_double_floats(shifted)
    };
    let times = FrameTimes::from_listed_seconds(column).map_err(|error| TrcError::Track(error.to_string()))?;
    Ok((times, offset))
}

/// Returns the times that the numbers of the frames show.
fn by_number(rows: &TrcRows, rate: FrameRate, findings: &mut FindingTally) -> Result<FrameTimes, TrcError> {
    let frames = complete_trc_numbers(&rows.frames).filter(|all| all.is_sorted_by(|a, b| a < b));
    let uneven = |all: &Vec<f64>| all.windows(2).any(|pair| pair[1] - pair[0] != 1.0);
    let Some(frames) = frames.filter(uneven) else {
        findings.push_warning_finding(None, "some rows have no time; frames are taken to be even");
        return Ok(FrameTimes::Even(rate));
    };
    findings.push_warning_finding(
        None,
        "some rows have no time; the numbers of the frames and DataRate show it",
    );
    let seconds = frames.iter().map(|frame| (frame - frames[0]) * rate.frame_time());
    FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(seconds.collect()))
        .map_err(|error| TrcError::Track(error.to_string()))
}

fn complete_trc_numbers(cells: &[Option<FileNumber>]) -> Option<Vec<f64>> {
    cells.iter().map(|cell| Some(cell.as_ref()?.to_f64())).collect()
}

/// Returns the worth of the last decimal of the times as they are written.
pub(crate) fn last_decimal_worth(times: &[Option<FileNumber>]) -> f64 {
    let count = |time: &FileNumber| {
        let mut text = Vec::new();
        time.push_to(&mut text);
        let point = text.iter().position(|letter| *letter == b'.');
        point.map_or(0, |point| text.len() - point - 1)
    };
    let most = times.iter().flatten().map(count).max().unwrap_or(0);
    10f64.powi(-i32::try_from(most).unwrap_or(i32::MAX))
}

/// Returns the rate of moments in seconds, from the median of their distances.
fn rate_of_times(seconds: &[f64]) -> Option<FrameRate> {
    let mut steps: Vec<f64> = seconds.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let step = *steps.get(steps.len() / 2)?;
    rate_of(near_usual(1.0 / step))
}
