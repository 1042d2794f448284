//! Rows and columns: Live Link Face, OpenFace, and plain tables with a time.

use std::borrow::Cow;

use chereme_motion::column::FileNumber;

use super::{CurveChannels, CurveClock, CurveError};
use crate::faces::{FARTHEST_TURN, HALF_TURN};
use crate::finding::ImportFinding;
use crate::table::is_gap;
use crate::tally::FindingTally;
use crate::timecode;
use crate::tracks::rate_of;

/// The longest usual step of timestamps, in seconds, that are no times: OpenFace writes milliseconds or 0 for a series
/// of pictures.
const MAX_COUNTED_STEP_SECONDS: f64 = 0.001_000_1;
/// The most faces of a file that become tracks.
const MOST_FACES: usize = 16;
/// Frames per second if the file gives no times.
const DEFAULT_TABLE_FPS: f64 = 30.0;

/// The rows of a table with their lines.
struct CurveTable {
    header: Vec<String>,
    rows: Vec<(u64, csv::StringRecord)>,
    /// Whether numbers may have a comma before their decimals.
    has_commas: bool,
}

/// Reads a table; `is_short` says whether a row may lack the cells at its end.
fn read_curve_table(text: &str, is_short: fn(&csv::StringRecord) -> bool) -> Result<CurveTable, CurveError> {
    let mut lines = text.lines();
    let head = lines.find(|line| !line.trim().is_empty());
    let count = |letter: char| {
        let head = head.unwrap_or_default();
        head.chars().filter(|character| *character == letter).count()
    };
    let delimiter = [',', ';', '\t']
        .into_iter()
        .max_by_key(|letter| count(*letter))
        .unwrap_or(',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(delimiter as u8)
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(text.trim_start().as_bytes());
    let header_record = reader.headers().map_err(|_| CurveError::Unknown)?;
    let mut header: Vec<String> = header_record.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for record in reader.into_records() {
        let mut record = record.map_err(|_| CurveError::Unknown)?;
        let line = record.position().map_or(0, csv::Position::line);
        let cell_count = record.iter().count();
        if record.iter().all(str::is_empty) {
            continue;
        }
        while record.len() < header.len() && is_short(&record) {
            record.push_field("");
        }
        if record.len() != header.len() && record.iter().skip(header.len()).any(|cell| !cell.is_empty())
            || record.len() < header.len()
        {
            return Err(CurveError::Width {
                line,
                found: cell_count,
                expected: header.len(),
            });
        }
        rows.push((line, record));
    }
    // A comma at the end of every line is no column.
    let is_blank = |at: usize| rows.iter().all(|(_, row)| row[at].is_empty());
    if header.last().is_some_and(String::is_empty) && is_blank(header.len() - 1) {
        header.pop();
    }
    Ok(CurveTable {
        header,
        rows,
        has_commas: delimiter != ',',
    })
}

/// Reads a number, whose decimals a comma may begin if commas do not divide the cells.
fn parse_table_number(cell: &str, line: u64, has_commas: bool) -> Result<Option<FileNumber>, CurveError> {
    if is_gap(cell) {
        return Ok(None);
    }
    let point = match has_commas && !cell.contains('.') {
        true => Cow::Owned(cell.replacen(',', ".", 1)),
        false => Cow::Borrowed(cell),
    };
    let parsed = FileNumber::parse_file_number(point.as_bytes())
        .ok()
        .filter(|number| number.to_f64().is_finite());
    parsed
        .map(Some)
        .ok_or_else(|| CurveError::curve_cell_error(line, cell, "number"))
}

/// Reads all columns but those to be left out.
fn read_table_channels(table: &CurveTable, left_out: &[usize]) -> Result<CurveChannels, CurveError> {
    let kept: Vec<usize> = (0..table.header.len()).filter(|at| !left_out.contains(at)).collect();
    let named = kept.iter().map(|at| name_and_unit(&table.header[*at]));
    let (names, units): (Vec<String>, Vec<&str>) = named.unzip();
    let mut channels = CurveChannels::new(names);
    channels.units = units;
    for (line, row) in &table.rows {
        for (column, at) in channels.columns.iter_mut().zip(&kept) {
            column.push(parse_table_number(&row[*at], *line, table.has_commas)?);
        }
    }
    Ok(channels)
}

/// The units that titles name, each with the unit that it stands for.
const TITLE_UNITS: [(&str, &str); 14] = [
    ("rad", "rad"),
    ("radians", "rad"),
    ("deg", "deg"),
    ("degrees", "deg"),
    ("°", "deg"),
    ("mm", "mm"),
    ("cm", "cm"),
    ("m", "m"),
    ("N", "N"),
    ("mV", "mV"),
    ("V", "V"),
    ("px", "px"),
    ("s", "s"),
    ("ms", "ms"),
];

/// Returns the name and the unit of a title such as `HeadYaw [deg]`, or of an angle's such as `head_yaw_deg`; an unknown
/// unit is part of the name.
fn name_and_unit(title: &str) -> (String, &'static str) {
    let unit_match = title.rsplit_once([' ', '_']).and_then(|(name, unit)| {
        let bare = unit.trim_matches(['[', ']', '(', ')']);
        let (_, known) = TITLE_UNITS.iter().find(|(known, _)| *known == bare)?;
        let is_angle = ["rad", "deg"].contains(known);
        (bare.len() < unit.len() || is_angle).then(|| (name.to_owned(), *known))
    });
    unit_match.unwrap_or_else(|| (title.to_owned(), ""))
}

pub(super) fn live_link(text: &str, findings: &mut FindingTally) -> Result<CurveChannels, CurveError> {
    let has_no_face = |row: &csv::StringRecord| row.get(1) == Some("0");
    let table = read_curve_table(text, has_no_face)?;
    let mut channels = read_table_channels(&table, &[0])?;
    let blank = table.rows.iter().filter(|(_, row)| has_no_face(row));
    match blank.count() {
        0 => {}
        blank => findings.push_warning_finding(
            None,
            format!(
                "rows without a face (BlendShapeCount is 0), whose numbers, if there are any, mean nothing: {blank}"
            ),
        ),
    }
    let code = |(line, row): &(u64, csv::StringRecord)| {
        timecode::parse_timecode(&row[0]).ok_or_else(|| CurveError::curve_cell_error(*line, &row[0], "timecode"))
    };
    let codes: Result<Vec<_>, CurveError> = table.rows.iter().map(code).collect();
    let times = timecode::infer_timecode_times(&codes?);
    let base = times.base;
    if times.is_guessed && times.seconds.len() > 1 {
        findings.push_warning_finding(
            1,
            format!(
                "no step into the next second shows how many frames a second its timecodes count; {base} are taken"
            ),
        );
    } else {
        findings.push_note_finding(1, format!("its timecodes count {base} frames a second"));
    }
    if times.drops {
        findings.push_note_finding(
            1,
            format!("its timecodes leave out frames (drop frame), so {base} of them last 1.001 s"),
        );
    }
    if times.repeats {
        findings.push_note_finding(
            1,
            "the decimals of its timecodes are those of the second, which the frames show already",
        );
    }
    channels.clock = CurveClock::Seconds(times.seconds);
    let is_turn = |name: &str| {
        let name = name.to_lowercase();
        ["yaw", "pitch", "roll"].iter().any(|turn| name.ends_with(turn))
    };
    let turns: Vec<usize> = (0..channels.names.len())
        .filter(|at| is_turn(&channels.names[*at]))
        .collect();
    let values = turns.iter().flat_map(|at| channels.columns[*at].iter().flatten());
    let most = values.map(|value| value.to_f64().abs()).fold(0.0, f64::max);
    // Between both, nothing distinguishes degrees from radians.
    let unit = match most {
        _ if most > HALF_TURN => "deg",
        _ if most > FARTHEST_TURN => "",
        _ => "rad",
    };
    for at in turns {
        if channels.units[at].is_empty() {
            channels.units[at] = unit;
        }
    }
    Ok(channels)
}

/// Reads the channels of every face of a file, in the order in which they are first seen.
pub(super) fn open_face(text: &str, findings: &mut FindingTally) -> Result<Vec<CurveChannels>, CurveError> {
    let full_table = read_curve_table(text, |_| false)?;
    let named = |title: &String| title.eq_ignore_ascii_case("face_id");
    let Some(at) = full_table.header.iter().position(named) else {
        return Ok(vec![read_face_channels(&full_table, findings)?]);
    };
    let mut faces: Vec<(String, CurveTable)> = Vec::new();
    for (line, row) in full_table.rows {
        let number = &row[at];
        let earlier_face = faces.iter().position(|(known, _)| known == number);
        // Rows of several people alternate, frame by frame.
        let face_index = match earlier_face {
            Some(known) => known,
            None if faces.len() == MOST_FACES => {
                return Err(CurveError::Track(format!(
                    "the file holds more than {MOST_FACES} faces (face_id); run OpenFace for one face, or split the file"
                )));
            }
            None => {
                let face_table = CurveTable {
                    header: full_table.header.clone(),
                    rows: Vec::new(),
                    has_commas: full_table.has_commas,
                };
                faces.push((number.to_owned(), face_table));
                faces.len() - 1
            }
        };
        faces[face_index].1.rows.push((line, row));
    }
    if faces.len() > 1 {
        let names: Vec<&str> = faces.iter().map(|(name, _)| name.as_str()).collect();
        findings.push_note_finding(
            None,
            format!(
                "each of its faces (face_id) is a track of its own: {}",
                names.join(", ")
            ),
        );
    }
    faces
        .iter()
        .map(|(_, table)| read_face_channels(table, findings))
        .collect()
}

/// Reads the channels of one face.
fn read_face_channels(table: &CurveTable, findings: &mut FindingTally) -> Result<CurveChannels, CurveError> {
    let mut channels = read_table_channels(table, &[])?;
    let find = |name: &str| table.header.iter().position(|title| title.eq_ignore_ascii_case(name));
    let success = find("success");
    let failed = success.map_or(0, |at| {
        channels.columns[at]
            .iter()
            .flatten()
            .filter(|value| value.to_f64() == 0.0)
            .count()
    });
    if failed > 0 {
        findings.push_warning_finding(
            None,
            format!("rows without a face (success is 0), whose numbers are kept and mean nothing: {failed}"),
        );
    }
    for (at, name) in channels.names.iter().enumerate() {
        if !channels.units[at].is_empty() {
            continue;
        }
        // Units by the names that OpenFace gives; its wiki lists them.
        channels.units[at] = match name.as_str() {
            "timestamp" => "s",
            "pose_Tx" | "pose_Ty" | "pose_Tz" => "mm",
            "pose_Rx" | "pose_Ry" | "pose_Rz" | "gaze_angle_x" | "gaze_angle_y" => "rad",
            name if name.starts_with(['X', 'Y', 'Z']) && name[1..].starts_with('_') => "mm",
            name if name.starts_with(['x', 'y']) && name[1..].starts_with('_') => "px",
            _ => "",
        };
    }
    let times = find("timestamp").map(|at| read_column_seconds(table, at, 1.0));
    channels.clock = match times.transpose()? {
        Some(times) if !is_counted(&times) => CurveClock::Seconds(times),
        times => {
            let text = match times {
                Some(_) => format!(
                    "its timestamps are those of a series of pictures, at most 1 ms apart; {DEFAULT_TABLE_FPS} frames a second are taken"
                ),
                None => format!("its frames have no times; {DEFAULT_TABLE_FPS} a second are taken"),
            };
            findings.push_counted_finding(
                ImportFinding::new_warning_finding(None, text)
                    .with_remedy("write the seconds of each row into the column \"timestamp\""),
            );
            let numbers = match find("frame") {
                Some(at) => read_column_seconds(table, at, 1.0 / DEFAULT_TABLE_FPS)?,
                None => Vec::new(),
            };
            match rate_of(DEFAULT_TABLE_FPS) {
                // Without times and numbers each row is the next frame.
                Some(rate) if !numbers.is_sorted_by(|a, b| a < b) || numbers.is_empty() => CurveClock::Rate(rate),
                _ => CurveClock::Seconds(numbers.iter().map(|number| number - numbers[0]).collect()),
            }
        }
    };
    Ok(channels)
}

/// The usual steps of milliseconds of a film's frames, in milliseconds.
const STEPS_OF_FILM: std::ops::RangeInclusive<f64> = 4.0..=100.0;

/// Returns whether times without a unit are milliseconds: whole numbers whose usual step is that of a film's frames.
pub(crate) fn are_millis(times: &[f64]) -> bool {
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps.get(steps.len() / 2);
    let is_whole = times.iter().all(|time| time.fract() == 0.0);
    is_whole && usual.is_some_and(|usual| STEPS_OF_FILM.contains(usual))
}

/// Returns whether times are whole numbers some microseconds of a film apart.
pub(crate) fn are_micros(times: &[f64]) -> bool {
    let thousandth: Vec<f64> = times.iter().map(|time| (time / 1000.0).round()).collect();
    are_millis(&thousandth) && times.iter().all(|time| time.fract() == 0.0)
}

/// Returns whether timestamps count rows instead of giving their times.
fn is_counted(times: &[f64]) -> bool {
    let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let usual = steps.get(steps.len() / 2);
    usual.is_some_and(|usual| (0.0..=MAX_COUNTED_STEP_SECONDS).contains(usual))
}

/// Returns a column as seconds, each cell worth `unit`.
fn read_column_seconds(table: &CurveTable, at: usize, unit: f64) -> Result<Vec<f64>, CurveError> {
    let time = |(line, row): &(u64, csv::StringRecord)| {
        let cell_number = parse_table_number(&row[at], *line, table.has_commas)?;
        let parsed = cell_number.ok_or_else(|| CurveError::curve_cell_error(*line, &row[at], "time"))?;
        Ok(parsed.to_f64() * unit)
    };
    table.rows.iter().map(time).collect()
}

/// The unit of a column of times, from its title: its length in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ColumnTimeUnit {
    Seconds(f64),
    /// Frames at the rate that the title names, such as `frame [25 fps]`.
    Frames(f64),
}

/// Reads the title of a column of times, such as `time [s]`, `ms` or `frame [25 fps]`.
pub(crate) fn unit_of_time(title: &str) -> Option<ColumnTimeUnit> {
    let title = title.to_lowercase();
    let (name, unit) = match title.split_once(['[', '(']) {
        Some((name, unit)) => (name.trim(), unit.trim_end_matches([']', ')']).trim()),
        None => (title.trim(), ""),
    };
    let named = |words: &[&str]| words.contains(&name);
    if named(&["frame", "frames"]) {
        let rate: f64 = unit.trim_end_matches("fps").trim().parse().ok()?;
        return (rate.is_finite() && rate > 0.0).then_some(ColumnTimeUnit::Frames(rate));
    }
    match (name, unit) {
        ("ms" | "milliseconds" | "time_ms" | "timestamp_ms", "") => Some(ColumnTimeUnit::Seconds(0.001)),
        ("us" | "µs" | "microseconds" | "time_us" | "timestamp_us", "") => Some(ColumnTimeUnit::Seconds(1e-6)),
        ("ns" | "nanoseconds" | "time_ns" | "timestamp_ns", "") => Some(ColumnTimeUnit::Seconds(1e-9)),
        ("time" | "timestamp" | "t", "us" | "µs" | "microseconds") => Some(ColumnTimeUnit::Seconds(1e-6)),
        ("time" | "timestamp" | "t", "ns" | "nanoseconds") => Some(ColumnTimeUnit::Seconds(1e-9)),
        ("s" | "seconds" | "time_s" | "time" | "timestamp" | "t", "" | "s" | "sec" | "seconds") => {
            Some(ColumnTimeUnit::Seconds(1.0))
        }
        ("time" | "timestamp" | "t", "ms" | "milliseconds") => Some(ColumnTimeUnit::Seconds(0.001)),
        _ => None,
    }
}

/// Returns the column of times among the first two, and its unit. A column of frame numbers before one of seconds only
/// counts the rows, as in the tables that this program writes.
pub(super) fn column_of_time<'t>(mut titles: impl Iterator<Item = &'t str>) -> Option<(usize, ColumnTimeUnit)> {
    let first = titles.next()?;
    if counts_frames(first)
        && let Some(unit @ ColumnTimeUnit::Seconds(_)) = titles.next().and_then(unit_of_time)
    {
        return Some((1, unit));
    }
    Some((0, unit_of_time(first)?))
}

/// Returns whether a title is that of frame numbers, such as `frame` or `frame [25 fps]`.
fn counts_frames(title: &str) -> bool {
    let name = title.split(['[', '(']).next().unwrap_or_default().trim();
    ["frame", "frames"].iter().any(|word| name.eq_ignore_ascii_case(word))
}

pub(super) fn read_plain_channels(text: &str, findings: &mut FindingTally) -> Result<CurveChannels, CurveError> {
    let table = read_curve_table(text, |_| false)?;
    let titles = table.header.iter().map(String::as_str);
    let (at, unit) = column_of_time(titles).ok_or(CurveError::NoRate)?;
    let left_out: Vec<usize> = (0..=at).collect();
    let mut channels = read_table_channels(&table, &left_out)?;
    channels.clock = match unit {
        ColumnTimeUnit::Seconds(unit) => {
            let times = read_column_seconds(&table, at, unit)?;
            let stated = table
                .header
                .get(at)
                .is_some_and(|title| title.contains(['[', '(', '_']));
            match !stated && unit == 1.0 && are_millis(&times) {
                true => {
                    findings.push_counted_finding(ImportFinding::new_warning_finding(
                        1,
                        "its times are whole numbers some milliseconds of a film apart; they are read as milliseconds",
                    ).with_remedy("write the unit into the title of that column, such as time [ms] or time [s]"));
                    CurveClock::Seconds(times.iter().map(|time| time / 1000.0).collect())
                }
                false => CurveClock::Seconds(times),
            }
        }
        ColumnTimeUnit::Frames(rate) => {
            let frames = read_column_seconds(&table, at, 1.0)?;
            let even = frames.windows(2).all(|pair| pair[1] - pair[0] == 1.0);
            match rate_of(rate).filter(|_| even) {
                Some(rate) => CurveClock::Rate(rate),
                None => CurveClock::Seconds(frames.iter().map(|frame| frame / rate).collect()),
            }
        }
    };
    Ok(channels)
}
