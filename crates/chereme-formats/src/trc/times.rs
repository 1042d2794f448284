//! The times of the rows of a TRC file.

use chereme_motion::column::{Column, Number};
use chereme_motion::{Instant, Rate, Times};

use super::{Error, Rows};
use crate::finding::Finding;
use crate::scene::near_usual;
use crate::tally::Findings;
use crate::tracks::rate_of;

/// Returns an even rate if the times are even, else the times themselves; and the time of the first frame.
pub(super) fn read(
    rows: &Rows,
    stated: Option<&str>,
    findings: &mut Findings,
) -> Result<(Times, Instant), Error> {
    let rate = stated
        .and_then(|text| text.replacen(',', ".", 1).parse::<f64>().ok())
        .and_then(rate_of);
    let seconds = numbers(&rows.times);
    let rate = match (rate, seconds.as_deref().and_then(rate_of_times)) {
        (Some(rate), _) => rate,
        (None, Some(rate)) => {
            let stated = stated.unwrap_or_default();
            let text = format!("DataRate is {stated:?}; the times of the rows show {rate}");
            findings.push(Finding::warning(3, text));
            rate
        }
        (None, None) => {
            let found = stated.unwrap_or_default().chars().take(40).collect();
            return Err(Error::Rate { found });
        }
    };
    let Some(seconds) = seconds else {
        return Ok((by_number(rows, rate, findings)?, Instant::ZERO));
    };
    let offset = Instant::from_seconds(seconds[0]);
    // Times are written with few decimals.
    let last_decimal = decimals(&rows.times);
    let even = |unit: f64| {
        let slack = 0.5 * rate.frame_time() + last_decimal * unit;
        (0..).zip(&seconds).all(|(frame, time)| {
            let at = f64::from(frame) * rate.frame_time();
            ((time - seconds[0]) * unit - at).abs() <= slack
        })
    };
    if even(1.0) {
        return Ok((Times::Even(rate), offset));
    }
    if even(0.001) {
        let text = "the times are milliseconds, as DataRate shows; they are read as such";
        findings.push(Finding::warning(None, text));
        return Ok((
            Times::Even(rate),
            Instant::from_seconds(seconds[0] / 1000.0),
        ));
    }
    findings.push(Finding::note(
        None,
        "the times do not follow DataRate; every frame has its own time",
    ));
    let shifted: Vec<f64> = seconds.iter().map(|time| time - seconds[0]).collect();
    let column = if seconds[0] == 0.0 {
        Column::decimals(rows.times.iter().cloned())
    } else {
        Column::doubles(shifted)
    };
    let times = Times::listed(column).map_err(|error| Error::Track(error.to_string()))?;
    Ok((times, offset))
}

/// Returns the times that the numbers of the frames show.
fn by_number(rows: &Rows, rate: Rate, findings: &mut Findings) -> Result<Times, Error> {
    let frames = numbers(&rows.frames).filter(|all| all.is_sorted_by(|a, b| a < b));
    let uneven = |all: &Vec<f64>| all.windows(2).any(|pair| pair[1] - pair[0] != 1.0);
    let Some(frames) = frames.filter(uneven) else {
        findings.push(Finding::warning(
            None,
            "some rows have no time; frames are taken to be even",
        ));
        return Ok(Times::Even(rate));
    };
    findings.push(Finding::warning(
        None,
        "some rows have no time; the numbers of the frames and DataRate show it",
    ));
    let seconds = frames
        .iter()
        .map(|frame| (frame - frames[0]) * rate.frame_time());
    Times::listed(Column::doubles(seconds.collect()))
        .map_err(|error| Error::Track(error.to_string()))
}

fn numbers(cells: &[Option<Number>]) -> Option<Vec<f64>> {
    cells
        .iter()
        .map(|cell| Some(cell.as_ref()?.to_f64()))
        .collect()
}

/// Returns the worth of the last decimal of the times as they are written.
pub(crate) fn decimals(times: &[Option<Number>]) -> f64 {
    let count = |time: &Number| {
        let mut text = Vec::new();
        time.push_to(&mut text);
        let point = text.iter().position(|letter| *letter == b'.');
        point.map_or(0, |point| text.len() - point - 1)
    };
    let most = times.iter().flatten().map(count).max().unwrap_or(0);
    10f64.powi(-i32::try_from(most).unwrap_or(i32::MAX))
}

/// Returns the rate of moments in seconds, from the median of their distances.
fn rate_of_times(seconds: &[f64]) -> Option<Rate> {
    let mut steps: Vec<f64> = seconds.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let step = *steps.get(steps.len() / 2)?;
    rate_of(near_usual(1.0 / step))
}
