//! Rows and columns: Live Link Face, OpenFace, and plain tables with a time.

use chereme_motion::column::Number;

use super::{Channels, Clock, Error};
use crate::finding::Finding;
use crate::tally::Findings;
use crate::timecode;
use crate::tracks::rate_of;

/// The largest angle in radians; greater numbers are degrees, as no head turns so far.
const MOST_RADIANS: f64 = 3.2;

/// The longest usual step of timestamps, in seconds, that are no times: OpenFace writes milliseconds or 0 for a series
/// of pictures.
const COUNTED: f64 = 0.001_000_1;
/// Frames per second if the file gives no times.
const USUAL_RATE: f64 = 30.0;

/// The rows of a table with their lines.
struct Table {
    header: Vec<String>,
    rows: Vec<(u64, csv::StringRecord)>,
}

fn table(text: &str) -> Result<Table, Error> {
    let head = text.lines().next().unwrap_or_default();
    let count = |letter: char| head.chars().filter(|it| *it == letter).count();
    let delimiter = [',', ';', '\t']
        .into_iter()
        .max_by_key(|letter| count(*letter))
        .unwrap_or(',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter as u8)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(|_| Error::Unknown)?;
    let header: Vec<String> = header.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for record in reader.into_records() {
        let record = record.map_err(|_| Error::Unknown)?;
        let line = record.position().map_or(0, csv::Position::line);
        let found = record.iter().count();
        if record.iter().all(str::is_empty) {
            continue;
        }
        if found != header.len() {
            return Err(Error::Width {
                line,
                found,
                expected: header.len(),
            });
        }
        rows.push((line, record));
    }
    Ok(Table { header, rows })
}

fn number(cell: &str, line: u64) -> Result<Option<Number>, Error> {
    if cell.is_empty() || cell.eq_ignore_ascii_case("nan") {
        return Ok(None);
    }
    let parsed = Number::parse(cell.as_bytes())
        .ok()
        .filter(|number| number.to_f64().is_finite());
    parsed
        .map(Some)
        .ok_or_else(|| Error::cell(line, cell, "number"))
}

/// Reads all columns but those to be left out.
fn channels(table: &Table, left_out: &[usize]) -> Result<Channels, Error> {
    let kept: Vec<usize> = (0..table.header.len())
        .filter(|at| !left_out.contains(at))
        .collect();
    let mut channels = Channels::new(kept.iter().map(|at| table.header[*at].clone()).collect());
    for (line, row) in &table.rows {
        for (column, at) in channels.columns.iter_mut().zip(&kept) {
            column.push(number(&row[*at], *line)?);
        }
    }
    Ok(channels)
}

pub(super) fn live_link(text: &str, findings: &mut Findings) -> Result<Channels, Error> {
    let table = table(text)?;
    let mut channels = channels(&table, &[0])?;
    let code = |(line, row): &(u64, csv::StringRecord)| {
        timecode::parse(&row[0]).ok_or_else(|| Error::cell(*line, &row[0], "timecode"))
    };
    let codes: Result<Vec<_>, Error> = table.rows.iter().map(code).collect();
    let (seconds, base) = timecode::seconds(&codes?);
    findings.push(Finding::note(
        1,
        format!("its timecodes count {base} frames a second"),
    ));
    channels.clock = Clock::Seconds(seconds);
    let is_turn = |name: &str| {
        let name = name.to_lowercase();
        ["yaw", "pitch", "roll"]
            .iter()
            .any(|turn| name.ends_with(turn))
    };
    let turns: Vec<usize> = (0..channels.names.len())
        .filter(|at| is_turn(&channels.names[*at]))
        .collect();
    let values = turns
        .iter()
        .flat_map(|at| channels.columns[*at].iter().flatten());
    let most = values.map(|value| value.to_f64().abs()).fold(0.0, f64::max);
    let unit = if most > MOST_RADIANS { "deg" } else { "rad" };
    for at in turns {
        channels.units[at] = unit;
    }
    Ok(channels)
}

pub(super) fn open_face(text: &str, findings: &mut Findings) -> Result<Channels, Error> {
    let table = table(text)?;
    let mut channels = channels(&table, &[])?;
    let find = |name: &str| {
        table
            .header
            .iter()
            .position(|title| title.eq_ignore_ascii_case(name))
    };
    let success = find("success");
    let failed = success.map_or(0, |at| {
        channels.columns[at]
            .iter()
            .flatten()
            .filter(|value| value.to_f64() == 0.0)
            .count()
    });
    if failed > 0 {
        findings.push(Finding::warning(
            None,
            format!("rows without a face (success is 0), whose numbers are kept and mean nothing: {failed}"),
        ));
    }
    for (at, name) in channels.names.iter().enumerate() {
        channels.units[at] = match name.as_str() {
            "timestamp" => "s",
            "pose_Tx" | "pose_Ty" | "pose_Tz" => "mm",
            "pose_Rx" | "pose_Ry" | "pose_Rz" | "gaze_angle_x" | "gaze_angle_y" => "rad",
            name if name.starts_with(['X', 'Y', 'Z']) && name[1..].starts_with('_') => "mm",
            name if name.starts_with(['x', 'y']) && name[1..].starts_with('_') => "px",
            _ => "",
        };
    }
    let faces = find("face_id").map(|at| {
        let mut ids: Vec<String> = table
            .rows
            .iter()
            .map(|(_, row)| row[at].to_owned())
            .collect();
        ids.sort();
        ids.dedup();
        ids.len()
    });
    if faces.is_some_and(|faces| faces > 1) {
        return Err(Error::Track(
            "the file holds several faces (face_id); run OpenFace for one face, or split the file"
                .to_owned(),
        ));
    }
    let Some(at) = find("timestamp") else {
        return Err(Error::Unknown);
    };
    let times = seconds(&table, at, 1.0)?;
    channels.clock = match is_counted(&times) {
        false => Clock::Seconds(times),
        true => {
            findings.push(
                Finding::warning(
                    None,
                    format!(
                        "its timestamps are those of a series of pictures, at most 1 ms apart; {USUAL_RATE} frames a second are taken"
                    ),
                )
                .with_remedy("write the seconds of each row into the column \"timestamp\""),
            );
            let numbers = match find("frame") {
                Some(at) => seconds(&table, at, 1.0 / USUAL_RATE)?,
                None => Vec::new(),
            };
            match rate_of(USUAL_RATE) {
                Some(rate) if !numbers.is_sorted_by(|a, b| a < b) || numbers.is_empty() => {
                    Clock::Rate(rate)
                }
                _ => Clock::Seconds(numbers.iter().map(|it| it - numbers[0]).collect()),
            }
        }
    };
    Ok(channels)
}

/// Returns whether timestamps count rows instead of giving their times.
fn is_counted(times: &[f64]) -> bool {
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps.get(steps.len() / 2);
    usual.is_some_and(|usual| (0.0..=COUNTED).contains(usual))
}

/// Returns a column as seconds, each cell worth `unit`.
fn seconds(table: &Table, at: usize, unit: f64) -> Result<Vec<f64>, Error> {
    let time = |(line, row): &(u64, csv::StringRecord)| {
        let parsed = number(&row[at], *line)?;
        let parsed = parsed.ok_or_else(|| Error::cell(*line, &row[at], "time"))?;
        Ok(parsed.to_f64() * unit)
    };
    table.rows.iter().map(time).collect()
}

/// The unit of a column of times, from its title: its length in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum TimeUnit {
    Seconds(f64),
    /// Frames at the rate that the title names, such as `frame [25 fps]`.
    Frames(f64),
}

/// Reads the title of a column of times, such as `time [s]`, `ms` or `frame [25 fps]`.
pub(super) fn unit_of_time(title: &str) -> Option<TimeUnit> {
    let title = title.to_lowercase();
    let (name, unit) = match title.split_once(['[', '(']) {
        Some((name, unit)) => (name.trim(), unit.trim_end_matches([']', ')']).trim()),
        None => (title.trim(), ""),
    };
    let named = |words: &[&str]| words.contains(&name);
    if named(&["frame", "frames"]) {
        let rate: f64 = unit.trim_end_matches("fps").trim().parse().ok()?;
        return (rate.is_finite() && rate > 0.0).then_some(TimeUnit::Frames(rate));
    }
    match (name, unit) {
        ("ms" | "milliseconds" | "time_ms" | "timestamp_ms", "") => Some(TimeUnit::Seconds(0.001)),
        ("s" | "seconds" | "time_s" | "time" | "timestamp" | "t", "" | "s" | "sec" | "seconds") => {
            Some(TimeUnit::Seconds(1.0))
        }
        ("time" | "timestamp" | "t", "ms" | "milliseconds") => Some(TimeUnit::Seconds(0.001)),
        _ => None,
    }
}

pub(super) fn plain(text: &str) -> Result<Channels, Error> {
    let table = table(text)?;
    let unit = table
        .header
        .first()
        .and_then(|title| unit_of_time(title))
        .ok_or(Error::Unknown)?;
    let mut channels = channels(&table, &[0])?;
    // A unit stands behind the name in square brackets.
    let known = [
        "rad", "deg", "mm", "cm", "m", "N", "mV", "V", "px", "s", "ms",
    ];
    for (name, unit) in channels.names.iter_mut().zip(&mut channels.units) {
        let split = name
            .strip_suffix(']')
            .and_then(|rest| rest.rsplit_once(" ["));
        if let Some((bare, given)) = split
            && let Some(known) = known.iter().find(|known| **known == given)
        {
            *unit = known;
            *name = bare.to_owned();
        }
    }
    channels.clock = match unit {
        TimeUnit::Seconds(unit) => Clock::Seconds(seconds(&table, 0, unit)?),
        TimeUnit::Frames(rate) => {
            let frames = seconds(&table, 0, 1.0)?;
            let even = frames.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
            match rate_of(rate).filter(|_| even) {
                Some(rate) => Clock::Rate(rate),
                None => Clock::Seconds(frames.iter().map(|frame| frame / rate).collect()),
            }
        }
    };
    Ok(channels)
}
