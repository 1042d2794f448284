//! TRC files: marker trajectories as tab-separated text, as OpenSim, Cortex and others write them.
//!
//! Dialects that are read: labels shifted by a column, one label for each coordinate, markers without a label, missing
//! line of axes, missing column of times, blanks instead of tabs, decimal commas, lines that end with CR, empty cells,
//! NaN or 0 0 0 for gaps, counts that are wrong. The numbers are kept as decimals.

mod trc_labels;
mod trc_times;

#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::fmt::Write as _;

use chereme_motion::column::{FileNumber, FrameNumberColumn};
use chereme_motion::{
    AxisDirection, FrameRate, FrameTimes, MarkerSpace, MarkerTrack, MotionMarker, RecordingInstant, SpaceConvention,
};

use glam::DVec3;

use crate::finding::ImportFinding;
use crate::noughts::open_noughts;
use crate::table::{TableError, decode_table_bytes, is_gap};
use crate::tally::FindingTally;
use crate::tracks::{CapturedTrackContent, CapturedTracks, FileTrack, axes_with_up, metres_of_unit, say_axes, up_of};
use trc_labels::TrcLabels;
pub(crate) use trc_times::last_decimal_worth;

/// Why bytes could not be read as TRC.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TrcError {
    /// The file is not text.
    #[error("line {line}: this is not text")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// The file does not begin as TRC files do.
    #[error("this is no TRC file: its first line does not begin with PathFileType")]
    NoTrc,
    /// A header line is missing.
    #[error("the line of {0} is missing")]
    Missing(&'static str),
    /// A row has another number of cells than the markers need.
    #[error("line {line}: the row has {found} cells, and {markers} markers need {expected}")]
    Width {
        /// The line, counted from 1.
        line: u64,
        /// The cells of the row.
        found: usize,
        /// The markers.
        markers: usize,
        /// The cells that they need.
        expected: usize,
    },
    /// A cell is not a number.
    #[error("line {line}: {cell:?} is no number")]
    Number {
        /// The line, counted from 1.
        line: u64,
        /// The cell.
        cell: String,
    },
    /// Neither the header nor the times show a rate.
    #[error("line 3: DataRate is {found:?}; write the number of frames a second there")]
    Rate {
        /// The value of the header.
        found: String,
    },
    /// There are no rows or no markers.
    #[error("the file holds no markers")]
    Empty,
    /// The rows cannot be a track.
    #[error("{0}")]
    Track(String),
}

/// Reads a TRC file.
///
/// # Errors
/// [`TrcError`] if the bytes are no TRC file, or a row does not fit its markers.
pub fn read_trc_file(bytes: &[u8]) -> Result<(CapturedTracks, Vec<ImportFinding>), TrcError> {
    let mut findings = FindingTally::default();
    let text = decode_table_bytes(bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => TrcError::NotText { line },
        _ => TrcError::NoTrc,
    })?;
    let begin = text.trim_start();
    let head_length = text.len() - begin.len();
    let above = text[..head_length].matches('\n').count() as u64;
    let text = begin;
    if !text.starts_with("PathFileType") {
        return Err(TrcError::NoTrc);
    }
    // Old programs of the Macintosh end their lines with CR alone.
    let text = match text.contains('\n') {
        true => Cow::Borrowed(text),
        false => Cow::Owned(text.replace('\r', "\n")),
    };
    let mut lines = (1 + above..).zip(text.lines());
    lines.next();
    let (_, keys) = lines.next().ok_or(TrcError::Missing("DataRate and its like"))?;
    let (_, values) = lines.next().ok_or(TrcError::Missing("header values"))?;
    let header = parse_trc_header(keys, values);
    let header_value = |key: &str| {
        let header_pair = header.iter().find(|(name, _)| name.eq_ignore_ascii_case(key));
        header_pair.map(|(_, value)| *value).filter(|value| !value.is_empty())
    };
    let (_, labels) = lines.next().ok_or(TrcError::Missing("labels"))?;
    let table = read_trc_table(lines, &mut findings)?;
    let marker_count = table.axes.or_else(|| header_value("NumMarkers")?.parse().ok());
    let markers = marker_count.filter(|count| *count <= MOST_MARKERS);
    let labels = TrcLabels::read_trc_labels(&split_trc_cells(labels), markers, table.width, &mut findings);
    let names = labels.names;
    if names.is_empty() {
        return Err(TrcError::Empty);
    }
    let is_counted = markers.is_none_or(|count| count == names.len());
    let mut rows = read_trc_rows(&table, names.len(), is_counted, labels.has_times)?;
    if rows.times.is_empty() {
        return Err(TrcError::Empty);
    }
    if !text.ends_with('\n') {
        report_cut_row(&table, &mut findings);
    }
    check_count("NumFrames", header_value("NumFrames"), rows.times.len(), &mut findings);
    check_count("NumMarkers", header_value("NumMarkers"), names.len(), &mut findings);
    open_noughts(&names, &mut rows.columns, &mut findings);
    let (times, offset) = trc_times::read_trc_times(&rows, header_value("DataRate"), &mut findings)?;
    let points = names.into_iter().zip(rows.columns.chunks(3)).map(|(name, axes)| {
        let column = |numbers: &Vec<Option<FileNumber>>| FrameNumberColumn::from_decimals(numbers.iter().cloned());
        MotionMarker::new(name, axes.iter().map(column).collect())
    });
    let points: Vec<MotionMarker> = points.collect();
    let convention = infer_trc_convention(header_value("Units"), &points, &mut findings);
    let markers = MarkerTrack::new(times, MarkerSpace::World(convention), points)
        .map_err(|error| TrcError::Track(error.to_string()))?;
    let mut track = FileTrack::new("markers", CapturedTrackContent::Markers(markers));
    track.offset = offset;
    let tracks = CapturedTracks {
        tracks: vec![track],
        events: None,
    };
    Ok((tracks, findings.finish_finding_tally()))
}

/// Returns the header's keys with their values: word by word if there are as many, else those of the same column.
fn parse_trc_header<'t>(keys: &'t str, values: &'t str) -> Vec<(Cow<'t, str>, &'t str)> {
    let count = |line: &str| line.split_whitespace().count();
    if count(keys) == count(values) || !keys.contains('\t') {
        let keys = keys.split_whitespace().map(Cow::Borrowed);
        return keys.zip(values.split_whitespace()).collect();
    }
    let keys = keys
        .split('\t')
        .map(|key| Cow::Owned(key.replace(char::is_whitespace, "")));
    keys.zip(values.split('\t').map(str::trim)).collect()
}

/// Returns the cells of a line, which tabs or, if it has none, blanks divide.
fn split_trc_cells(line: &str) -> Vec<&str> {
    match line.contains('\t') {
        true => line.split('\t').map(str::trim).collect(),
        false => line.split_whitespace().collect(),
    }
}

/// The lines below the labels.
struct TrcTable<'t> {
    /// The markers that the line of axes counts, if there is one.
    axes: Option<usize>,
    lines: Vec<(u64, Vec<&'t str>)>,
    /// The cells of the widest row, empty ones at its end left out.
    width: usize,
    /// Whether numbers have a comma before their decimals.
    has_commas: bool,
}

fn read_trc_table<'t>(
    lines: impl Iterator<Item = (u64, &'t str)>,
    findings: &mut FindingTally,
) -> Result<TrcTable<'t>, TrcError> {
    let mut table = TrcTable {
        axes: None,
        lines: Vec::new(),
        width: 0,
        has_commas: false,
    };
    let mut has_points = false;
    for (line, text) in lines {
        if text.trim().is_empty() {
            continue;
        }
        let cells = split_trc_cells(text);
        let begins_with_x = |cell: &&&str| cell.starts_with(['X', 'x']);
        if table.lines.is_empty()
            && cells
                .iter()
                .find(|cell| !cell.is_empty())
                .is_some_and(|cell| begins_with_x(&cell))
        {
            table.axes = Some(cells.iter().filter(begins_with_x).count());
            continue;
        }
        has_points |= text.contains('.');
        table.has_commas |= text.contains(',');
        let filled = cells.iter().rposition(|cell| !cell.is_empty());
        table.width = table.width.max(filled.map_or(0, |last| last + 1));
        table.lines.push((line, cells));
    }
    // Where points occur, commas part cells or thousands.
    table.has_commas &= !has_points;
    if table.has_commas {
        findings.push_note_finding(
            table.lines.first().map(|(line, _)| *line),
            "the numbers have decimal commas",
        );
    }
    Ok(table)
}

/// The numbers of the rows.
struct TrcRows {
    /// The frame numbers.
    frames: Vec<Option<FileNumber>>,
    times: Vec<Option<FileNumber>>,
    columns: Vec<Vec<Option<FileNumber>>>,
}

/// Reads the rows of `markers` markers, whose count `is_counted` in the file too.
fn read_trc_rows(table: &TrcTable<'_>, markers: usize, is_counted: bool, has_times: bool) -> Result<TrcRows, TrcError> {
    let first = 1 + usize::from(has_times);
    let expected = first + 3 * markers;
    let has_cells = is_counted || table.width + 3 > expected;
    let mut rows = TrcRows {
        frames: Vec::new(),
        times: Vec::new(),
        columns: vec![Vec::new(); 3 * markers],
    };
    for (line, cells) in &table.lines {
        // Rows may end with extra tabs, or omit empty cells at their end.
        let extra = cells.len() > expected && cells[expected..].iter().any(|cell| !cell.is_empty());
        if extra || cells.len() < 3 || !has_cells {
            return Err(TrcError::Width {
                line: *line,
                found: cells.len(),
                markers,
                expected,
            });
        }
        let number = |cell: &str| parse_trc_number(cell, *line, table.has_commas);
        rows.frames.push(number(cells[0]).unwrap_or(None));
        rows.times.push(match has_times {
            true => number(cells[1])?,
            false => None,
        });
        for (at, column) in rows.columns.iter_mut().enumerate() {
            column.push(number(cells.get(at + first).copied().unwrap_or_default())?);
        }
    }
    Ok(rows)
}

/// Reads a cell; an empty one and NaN are gaps.
fn parse_trc_number(cell: &str, line: u64, has_commas: bool) -> Result<Option<FileNumber>, TrcError> {
    if is_gap(cell) {
        return Ok(None);
    }
    let point = match has_commas {
        true => Cow::Owned(cell.replacen(',', ".", 1)),
        false => Cow::Borrowed(cell),
    };
    let parsed = FileNumber::parse_file_number(point.as_bytes())
        .ok()
        .filter(|number| number.to_f64().is_finite());
    parsed.map(Some).ok_or_else(|| TrcError::Number {
        line,
        cell: cell.chars().take(40).collect(),
    })
}

/// Reports a last row without the end of its line that has fewer cells than the row before.
fn report_cut_row(table: &TrcTable<'_>, findings: &mut FindingTally) {
    let [.., (_, before), (line, last)] = table.lines.as_slice() else {
        return;
    };
    if last.len() < before.len() {
        findings.push_counted_finding(
            ImportFinding::new_warning_finding(
                *line,
                format!(
                    "the last row has {} cells and the row before {}; the file may be cut short, and the last number of that row too",
                    last.len(),
                    before.len()
                ),
            )
            .with_remedy("export the take again from the program that recorded it"),
        );
    }
}

/// The most markers that a header may promise.
const MOST_MARKERS: usize = 100_000;

fn check_count(key: &str, stated: Option<&str>, found: usize, findings: &mut FindingTally) {
    if let Some(count) = stated.and_then(|text| text.parse::<usize>().ok())
        && count != found
    {
        findings.push_note_finding(3, format!("{key} says {count}, and the file holds {found}"));
    }
}

fn infer_trc_convention(unit: Option<&str>, points: &[MotionMarker], findings: &mut FindingTally) -> SpaceConvention {
    let unit = unit.unwrap_or_default();
    let metres_per_unit = metres_of_unit(unit).unwrap_or_else(|| {
        let text = format!("the unit is {unit:?}; millimetres are assumed");
        findings.push_note_finding(3, text);
        0.001
    });
    let up = up_of(points).unwrap_or_else(|| {
        let text = "no markers of head and feet show which axis is up; +Y is taken";
        findings.push_counted_finding(ImportFinding::new_note_finding(None, text).with_remedy(say_axes()));
        AxisDirection::nearest_axis_direction(DVec3::Y)
    });
    SpaceConvention {
        metres_per_unit,
        axes: axes_with_up(points, up, findings),
    }
}

/// Writes a track of markers in a room as TRC; gaps are empty cells. Frames without an even rate have their own times, and
/// `DataRate` is the rate of their shortest step, which shows that they are uneven.
///
/// # Errors
/// Fails, with a sentence for the user, if the points are not in a room, or TRC has no name for their unit.
pub fn write_trc_file(name: &str, markers: &MarkerTrack, offset: RecordingInstant) -> Result<String, String> {
    let MarkerSpace::World(convention) = markers.marker_space() else {
        return Err(format!(
            "TRC holds places in a room, and these are {}",
            markers.marker_space().marker_space_name()
        ));
    };
    let units = [
        (1.0, "m"),
        (0.01, "cm"),
        (0.001, "mm"),
        (0.0254, "in"),
        (0.3048, "ft"),
        (0.1, "dm"),
    ];
    let (_, unit) = units
        .iter()
        .find(|(metres, _)| (metres - convention.metres_per_unit).abs() < 1e-9)
        .ok_or_else(|| format!("TRC has no unit of {} m", convention.metres_per_unit))?;
    let (frames, points) = (markers.marker_frame_count(), markers.marker_points().len());
    let per_second = markers
        .marker_times()
        .even_times_rate()
        .map_or_else(|| shortest_step(markers).recip(), FrameRate::per_second);
    let mut out = format!(
        "PathFileType\t4\t(X/Y/Z)\t{name}\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
         {per_second}\t{per_second}\t{frames}\t{points}\t{unit}\t{per_second}\t1\t{frames}\nFrame#\tTime"
    );
    for point in markers.marker_points() {
        let label = if point.group.is_empty() {
            point.name.clone()
        } else {
            format!("{}:{}", point.group, point.name)
        };
        let _ = write!(out, "\t{label}\t\t");
    }
    out.push_str("\n\t");
    for number in 1..=points {
        let _ = write!(out, "\tX{number}\tY{number}\tZ{number}");
    }
    out.push_str("\n\n");
    for frame in 0..frames {
        // The times of a file come back as they were written.
        let listed_text = match markers.marker_times() {
            FrameTimes::Listed(listed) if offset == RecordingInstant::RECORDING_START => {
                listed.listed_seconds().column_text_at(frame)
            }
            _ => None,
        };
        let seconds = markers.marker_times().frame_time_instant(frame).instant_seconds() + offset.instant_seconds();
        let seconds = listed_text.unwrap_or_else(|| format!("{seconds:.6}"));
        let _ = write!(out, "{}\t{seconds}", frame + 1);
        for point in markers.marker_points() {
            for column in &point.place {
                let text = column.column_text_at(frame).unwrap_or_default();
                let _ = write!(out, "\t{text}");
            }
        }
        out.push('\n');
    }
    Ok(out)
}

/// Returns the shortest step in seconds between frames with times of their own; 1 for a single frame.
fn shortest_step(markers: &MarkerTrack) -> f64 {
    let at = |frame: usize| markers.marker_times().frame_time_instant(frame).instant_seconds();
    let steps = (1..markers.marker_frame_count()).map(|frame| at(frame) - at(frame - 1));
    let shortest = steps.filter(|step| *step > 0.0).fold(f64::INFINITY, f64::min);
    if shortest.is_finite() { shortest } else { 1.0 }
}
