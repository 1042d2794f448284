//! The times of the rows of a table of points.

use chereme_motion::column::{FileNumber, FrameNumberColumn};
use chereme_motion::{FrameRate, FrameTimes, RecordingInstant};
use chereme_sign::ErrorRemedy;

use super::PointTableError;
use super::points_rows::{PointTableLayout, PointTableRows};
use crate::curves::{ColumnTimeUnit, are_micros, are_millis};
use crate::finding::ImportFinding;
use crate::keypoints::DEFAULT_KEYPOINT_FPS;
use crate::scene::{near_usual, near_usual_within};
use crate::tally::FindingTally;
use crate::timecode::SECONDS_PER_DAY;
use crate::tracks::rate_of;
use crate::trc::last_decimal_worth;

/// The largest distance of a time from an even grid, as a share of a frame, if a rate is stated, and if none is.
const TIME_GRID_SLACK: [f64; 2] = [0.5, 0.1];

/// Returns an even rate if the rows are even, else their own times; and the time of the first row.
pub(super) fn infer_row_times(
    rows: &PointTableRows,
    layout: &PointTableLayout,
    wanted: Option<FrameRate>,
    findings: &mut FindingTally,
) -> Result<(FrameTimes, RecordingInstant), PointTableError> {
    let stated = layout.rate.and_then(rate_of);
    let unit = match layout.time {
        Some((_, ColumnTimeUnit::Seconds(unit))) => unit,
        Some((_, ColumnTimeUnit::Frames(rate))) => 1.0 / rate,
        None => 1.0,
    };
    let Some(times) = complete_column_numbers(&rows.times).filter(|_| layout.time.is_some()) else {
        return by_number(rows, layout, stated.or(wanted), findings);
    };
    let first = times[0];
    // A stated unit or rate is not doubted.
    let bare = unit == 1.0 && stated.is_none();
    let millis = bare && are_millis(&times);
    let micros = bare && !millis && are_micros(&times);
    let unit = match (millis, micros) {
        (true, _) => 1e-3,
        (_, true) => 1e-6,
        _ => unit,
    };
    let seconds: Vec<f64> = times.iter().map(|time| (time - first) * unit).collect();
    let offset = first_row_instant(first * unit, findings);
    let last_decimal = match layout.time {
        Some((_, ColumnTimeUnit::Frames(_))) => 0.0,
        _ => last_decimal_worth(&rows.times) * unit,
    };
    if millis || micros {
        let text = match millis {
            true => "its times are whole numbers some milliseconds of a film apart; they are read as milliseconds",
            false => "its times are whole numbers some microseconds of a film apart; they are read as microseconds",
        };
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(layout.line, text)
                .with_remedy("write the unit into the title of that column, such as time [ms] or time [s]"),
        );
    }
    if let [_] = seconds[..] {
        let (times, _) = by_number(rows, layout, stated.or(wanted), findings)?;
        return Ok((times, offset));
    }
    if let Some(rate) = stated {
        if is_even(&seconds, rate, TIME_GRID_SLACK[0], last_decimal) {
            return Ok((FrameTimes::Even(rate), offset));
        }
        let thousandth: Vec<f64> = seconds.iter().map(|time| time / 1000.0).collect();
        if is_even(&thousandth, rate, TIME_GRID_SLACK[0], last_decimal / 1000.0) {
            let text = "the times are milliseconds, as the stated rate shows; they are read as such";
            findings.push_warning_finding(None, text);
            return Ok((
                FrameTimes::Even(rate),
                RecordingInstant::from_seconds(first * unit / 1000.0),
            ));
        }
    }
    let mean = (seconds.len() - 1) as f64 / seconds[seconds.len() - 1];
    let mut steps: Vec<f64> = seconds.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let usual = 1.0 / steps[steps.len() / 2];
    // The last time may be rounded.
    let rounded = (last_decimal / seconds[seconds.len() - 1]).max(5e-4);
    let rates = [near_usual_within(mean, rounded), mean, near_usual(usual), usual];
    let column_rates = rates.into_iter().filter_map(rate_of);
    let even = column_rates
        .into_iter()
        .find(|rate| is_even(&seconds, *rate, TIME_GRID_SLACK[1], last_decimal))
        .filter(|_| !has_holes(&seconds) && !lacks_frames(rows));
    if let Some(rate) = even {
        if let Some(stated) = stated {
            let text = format!("the file states {stated}, and the times of the rows show {rate}, which is taken");
            findings.push_warning_finding(None, text);
        }
        return Ok((FrameTimes::Even(rate), offset));
    }
    if let Some(at) = seconds.windows(2).position(|pair| pair[1] <= pair[0]) {
        let line = rows.lines[at + 1];
        return Err(PointTableError::Backwards { line });
    }
    let text = "the times of the frames are not even; every frame has its own time";
    findings.push_note_finding(None, text);
    let listed_times = FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(seconds));
    let times = listed_times.map_err(|error| PointTableError::Track(error.to_string()))?;
    Ok((times, offset))
}

/// Returns the times that the numbers of the frames show, at the rate that is known, else the usual one.
fn by_number(
    rows: &PointTableRows,
    layout: &PointTableLayout,
    rate: Option<FrameRate>,
    findings: &mut FindingTally,
) -> Result<(FrameTimes, RecordingInstant), PointTableError> {
    if layout.time.is_some() && rows.lines.len() > 1 {
        let text = "some rows have no time; the numbers of the frames and the rate show it";
        findings.push_warning_finding(None, text);
    }
    let rate = match rate {
        Some(rate) => rate,
        None => {
            let text =
                format!("the table states neither a rate nor times; {DEFAULT_KEYPOINT_FPS} frames a second are taken");
            findings.push_counted_finding(ImportFinding::new_warning_finding(None, text).with_remedy(
                ErrorRemedy::command_remedy("import it with --rate, such as --rate 50 or --rate 30000/1001"),
            ));
            FrameRate::new(DEFAULT_KEYPOINT_FPS, 1).map_err(|error| PointTableError::Track(error.to_string()))?
        }
    };
    let Some(frames) = complete_column_numbers(&rows.frames).filter(|_| layout.frame.is_some()) else {
        return Ok((FrameTimes::Even(rate), RecordingInstant::RECORDING_START));
    };
    // A known program counts the frames of a capture from 1, and its events have the times of the capture.
    let offset = match layout.program {
        "" => RecordingInstant::RECORDING_START,
        _ => RecordingInstant::from_seconds((frames[0] - 1.0).max(0.0) * rate.frame_time()),
    };
    if frames[0] > 1.0 {
        let text = format!(
            "it begins with frame {} of its capture; that is {} s here",
            frames[0],
            offset.instant_seconds()
        );
        findings.push_note_finding(None, text);
    }
    let even = frames.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
    if even {
        return Ok((FrameTimes::Even(rate), offset));
    }
    if !frames.is_sorted_by(|a, b| a < b) {
        let text = "the numbers of the frames do not rise; the rows are taken one after the other";
        findings.push_warning_finding(None, text);
        return Ok((FrameTimes::Even(rate), offset));
    }
    let text = "frames are missing, as their numbers show; every frame has its own time";
    findings.push_note_finding(None, text);
    let seconds = frames.iter().map(|frame| (frame - frames[0]) * rate.frame_time());
    let listed_times = FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(seconds.collect()));
    let times = listed_times.map_err(|error| PointTableError::Track(error.to_string()))?;
    Ok((times, offset))
}

/// Returns whether some steps are two or more times as long as the usual one, and none is shorter: frames are missing.
fn has_holes(seconds: &[f64]) -> bool {
    let mut steps: Vec<f64> = seconds.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps[(steps.len() - 1) / 2];
    let near = |step: &f64, count: f64| (step - count * usual).abs() < 0.1 * usual;
    let is_whole = |step: &f64| near(step, (step / usual).round());
    usual > 0.0
        && near(&steps[0], 1.0)
        && steps.iter().all(is_whole)
        && steps.last().is_some_and(|last| !near(last, 1.0))
}

/// Returns whether the numbers of the frames rise by steps of different lengths.
fn lacks_frames(rows: &PointTableRows) -> bool {
    let Some(frames) = complete_column_numbers(&rows.frames) else {
        return false;
    };
    let mut steps = frames.windows(2).map(|pair| pair[1] - pair[0]);
    let first = steps.clone().next();
    steps.clone().all(|step| step > 0.0) && steps.any(|step| Some(step) != first)
}

/// Returns whether times from the first one on are those of a rate.
fn is_even(seconds: &[f64], rate: FrameRate, slack: f64, last_decimal: f64) -> bool {
    let slack = slack * rate.frame_time() + last_decimal;
    let near = |(frame, time): (usize, &f64)| (time - frame as f64 * rate.frame_time()).abs() <= slack;
    seconds.iter().enumerate().all(near)
}

/// Returns the time of the first row; a date is none.
fn first_row_instant(seconds: f64, findings: &mut FindingTally) -> RecordingInstant {
    if seconds.abs() < SECONDS_PER_DAY {
        return RecordingInstant::from_seconds(seconds);
    }
    let text = format!("its first frame has the time {seconds:.3} s; that is 0 s here");
    findings.push_note_finding(None, text);
    RecordingInstant::RECORDING_START
}

/// Returns the numbers of a column if none is missing.
fn complete_column_numbers(column: &[Option<FileNumber>]) -> Option<Vec<f64>> {
    let numbers = column.iter().map(|number| number.as_ref().map(FileNumber::to_f64));
    numbers.collect::<Option<Vec<f64>>>().filter(|all| !all.is_empty())
}
