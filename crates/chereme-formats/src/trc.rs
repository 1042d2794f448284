//! TRC files: marker trajectories as tab-separated text, as OpenSim, Cortex and others write them.
//!
//! Dialects that are read: labels shifted by a column, missing line of axes, blanks instead of tabs in the
//! header, empty cells, NaN or 0 0 0 for gaps, counts that are wrong. The numbers are kept as decimals.

#[cfg(test)]
mod tests;

use std::fmt::Write as _;

use chereme_motion::column::{Column, Number};
use chereme_motion::{Convention, Direction, Instant, Marker, Markers, Rate, Space, Times};

use glam::DVec3;

use crate::finding::Finding;
use crate::scene::near_usual;
use crate::table::{TableError, decode};
use crate::tally::Findings;
use crate::tracks::{Content, FileTrack, Tracks, axes_with_up, rate_of, unique, up_of};

/// Why bytes could not be read as TRC.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
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
/// [`Error`] if the bytes are no TRC file, or a row does not fit its markers.
pub fn read(bytes: &[u8]) -> Result<(Tracks, Vec<Finding>), Error> {
    let mut findings = Findings::default();
    let text = decode(bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => Error::NotText { line },
        _ => Error::NoTrc,
    })?;
    if !text.trim_start().starts_with("PathFileType") {
        return Err(Error::NoTrc);
    }
    let mut lines = (1u64..).zip(text.lines());
    lines.next();
    let (_, keys) = lines
        .next()
        .ok_or(Error::Missing("DataRate and its like"))?;
    let (_, values) = lines.next().ok_or(Error::Missing("header values"))?;
    let header: Vec<(&str, &str)> = keys
        .split_whitespace()
        .zip(values.split_whitespace())
        .collect();
    let header_value = |key: &str| {
        let found = header
            .iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(key));
        found.map(|(_, value)| *value)
    };
    let (_, labels) = lines.next().ok_or(Error::Missing("labels"))?;
    let names = names(labels, &mut findings);
    if names.is_empty() {
        return Err(Error::Empty);
    }
    let mut rows = rows(lines, names.len())?;
    if rows.times.is_empty() {
        return Err(Error::Empty);
    }
    check_count(
        "NumFrames",
        header_value("NumFrames"),
        rows.times.len(),
        &mut findings,
    );
    check_count(
        "NumMarkers",
        header_value("NumMarkers"),
        names.len(),
        &mut findings,
    );
    open_noughts(&names, &mut rows.columns, &mut findings);
    let (times, offset) = times(&rows.times, header_value("DataRate"), &mut findings)?;
    let points = names
        .into_iter()
        .zip(rows.columns.chunks(3))
        .map(|(name, axes)| {
            let column = |numbers: &Vec<Option<Number>>| Column::decimals(numbers.iter().cloned());
            Marker::new(name, axes.iter().map(column).collect())
        });
    let points: Vec<Marker> = points.collect();
    let convention = convention(header_value("Units"), &points, &mut findings);
    let markers = Markers::new(times, Space::World(convention), points)
        .map_err(|error| Error::Track(error.to_string()))?;
    let mut track = FileTrack::new("markers", Content::Markers(markers));
    track.offset = offset;
    let tracks = Tracks {
        tracks: vec![track],
        events: None,
    };
    Ok((tracks, findings.finish()))
}

/// Returns the labels after `Frame#` and `Time`, each once.
fn names(line: &str, findings: &mut Findings) -> Vec<String> {
    let cells = line
        .split('\t')
        .map(str::trim)
        .filter(|cell| !cell.is_empty());
    let is_head = |cell: &&str| {
        let cell = cell.to_lowercase();
        cell.starts_with("frame") || cell == "time"
    };
    let given: Vec<&str> = cells.skip_while(is_head).collect();
    let names = unique(given.iter().copied(), "marker");
    for (name, unique) in given
        .iter()
        .zip(&names)
        .filter(|(name, unique)| name != unique)
    {
        findings.add("repeated labels", || {
            Finding::note(
                4,
                format!("the label {name:?} occurs again; it is {unique:?} here"),
            )
        });
    }
    names
}

struct Rows {
    times: Vec<(u64, Option<Number>)>,
    columns: Vec<Vec<Option<Number>>>,
}

fn rows<'t>(lines: impl Iterator<Item = (u64, &'t str)>, markers: usize) -> Result<Rows, Error> {
    let expected = 2 + 3 * markers;
    let mut rows = Rows {
        times: Vec::new(),
        columns: vec![Vec::new(); 3 * markers],
    };
    for (line, text) in lines {
        let text = text.strip_suffix('\r').unwrap_or(text);
        if text.trim().is_empty() {
            continue;
        }
        let cells: Vec<&str> = text.split('\t').map(str::trim).collect();
        let is_axes = rows.times.is_empty()
            && cells
                .iter()
                .find(|cell| !cell.is_empty())
                .is_some_and(|cell| cell.starts_with(['X', 'x']));
        if is_axes {
            continue;
        }
        // Rows may end with extra tabs, or omit empty cells at their end.
        let extra = cells.len() > expected && cells[expected..].iter().any(|cell| !cell.is_empty());
        if extra || cells.len() < 3 {
            return Err(Error::Width {
                line,
                found: cells.len(),
                markers,
                expected,
            });
        }
        let number = |cell: &str| number(cell, line);
        rows.times.push((line, number(cells[1])?));
        for (at, column) in rows.columns.iter_mut().enumerate() {
            column.push(number(cells.get(at + 2).copied().unwrap_or_default())?);
        }
    }
    Ok(rows)
}

/// Reads a cell; an empty one and NaN are gaps.
fn number(cell: &str, line: u64) -> Result<Option<Number>, Error> {
    if cell.is_empty() || cell.eq_ignore_ascii_case("nan") {
        return Ok(None);
    }
    let parsed = Number::parse(cell.as_bytes())
        .ok()
        .filter(|number| number.to_f64().is_finite());
    parsed.map(Some).ok_or_else(|| Error::Number {
        line,
        cell: cell.chars().take(40).collect(),
    })
}

/// The least distance of a marker from 0, as a share of its usual one, for its places at exactly 0 0 0 to be gaps.
const NEAR_NOUGHT: f64 = 0.1;

/// Makes gaps of the places at exactly 0 0 0 of markers that are otherwise far from there, and reports their count.
///
/// A marker that is there in every frame was never seen if others are elsewhere.
fn open_noughts(names: &[String], columns: &mut [Vec<Option<Number>>], findings: &mut Findings) {
    let places = |axes: &[Vec<Option<Number>>]| -> Vec<Option<DVec3>> {
        let at = |axis: &Vec<Option<Number>>, frame: usize| Some(axis[frame].as_ref()?.to_f64());
        let place = |frame| {
            let [x, y, z] = [0, 1, 2].map(|axis| at(&axes[axis], frame));
            Some(DVec3::new(x?, y?, z?))
        };
        (0..axes[0].len()).map(place).collect()
    };
    let is_nought = |place: &Option<DVec3>| *place == Some(DVec3::ZERO);
    let has_places = columns
        .chunks(3)
        .any(|axes| places(axes).iter().flatten().any(|at| *at != DVec3::ZERO));
    let (mut opened, mut markers, mut left) = (0, Vec::new(), 0);
    for (name, axes) in names.iter().zip(columns.chunks_mut(3)) {
        let places = places(axes);
        let noughts = places.iter().filter(|place| is_nought(place)).count();
        if noughts == 0 {
            continue;
        }
        let seen = places.iter().flatten().map(|at| at.length());
        let mut far: Vec<f64> = seen.filter(|length| *length > 0.0).collect();
        far.sort_by(f64::total_cmp);
        let is_far = match (far.first(), far.get(far.len() / 2)) {
            (Some(least), Some(usual)) => *least > NEAR_NOUGHT * usual,
            _ => has_places,
        };
        if !is_far {
            left += noughts;
            continue;
        }
        for axis in axes {
            for (number, _) in axis.iter_mut().zip(&places).filter(|(_, at)| is_nought(at)) {
                *number = None;
            }
        }
        opened += noughts;
        markers.push(name.as_str());
    }
    if opened > 0 {
        let some = markers[..markers.len().min(NAMED)].join(", ");
        findings.push(
            Finding::warning(
                None,
                format!(
                    "{opened} places of {} markers are exactly 0 0 0 and become gaps, as some programs write gaps so: {some}",
                    markers.len()
                ),
            )
            .with_remedy("write gaps as empty cells, and a marker that is really there as 0.001"),
        );
    }
    if left > 0 {
        findings.push(Finding::warning(
            None,
            format!("{left} places are exactly 0 0 0 though the file calls them seen; some programs write gaps so"),
        ));
    }
}

/// The number of markers that a finding names.
const NAMED: usize = 5;

fn check_count(key: &str, stated: Option<&str>, found: usize, findings: &mut Findings) {
    if let Some(count) = stated.and_then(|text| text.parse::<usize>().ok())
        && count != found
    {
        findings.push(Finding::note(
            3,
            format!("{key} says {count}, and the file holds {found}"),
        ));
    }
}

/// Returns an even rate if the times are even, else the times themselves; and the time of the first frame.
fn times(
    rows: &[(u64, Option<Number>)],
    stated: Option<&str>,
    findings: &mut Findings,
) -> Result<(Times, Instant), Error> {
    let rate = stated
        .and_then(|text| text.parse::<f64>().ok())
        .and_then(rate_of);
    let seconds: Option<Vec<f64>> = rows
        .iter()
        .map(|(_, time)| Some(time.as_ref()?.to_f64()))
        .collect();
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
        findings.push(Finding::warning(
            None,
            "some rows have no time; frames are taken to be even",
        ));
        return Ok((Times::Even(rate), Instant::ZERO));
    };
    let offset = Instant::from_seconds(seconds[0]);
    // Times are written with few decimals.
    let even = |rate: Rate| {
        let slack = 0.5 * rate.frame_time();
        (0..).zip(&seconds).all(|(frame, time)| {
            let at = f64::from(frame) * rate.frame_time();
            (time - seconds[0] - at).abs() <= slack
        })
    };
    if even(rate) {
        return Ok((Times::Even(rate), offset));
    }
    findings.push(Finding::note(
        None,
        "the times do not follow DataRate; every frame has its own time",
    ));
    let listed = rows.iter().map(|(_, time)| time.clone());
    let shifted: Vec<f64> = seconds.iter().map(|time| time - seconds[0]).collect();
    let column = if seconds[0] == 0.0 {
        Column::decimals(listed)
    } else {
        Column::doubles(shifted)
    };
    let times = Times::listed(column).map_err(|error| Error::Track(error.to_string()))?;
    Ok((times, offset))
}

/// Returns the rate of moments in seconds, from the median of their distances.
fn rate_of_times(seconds: &[f64]) -> Option<Rate> {
    let mut steps: Vec<f64> = seconds.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let step = *steps.get(steps.len() / 2)?;
    rate_of(near_usual(1.0 / step))
}

fn convention(unit: Option<&str>, points: &[Marker], findings: &mut Findings) -> Convention {
    let metres_per_unit = match unit.unwrap_or_default().to_lowercase().as_str() {
        "m" | "meters" => 1.0,
        "cm" => 0.01,
        "mm" => 0.001,
        "in" => 0.0254,
        _ => {
            let text = format!(
                "the unit is {:?}; millimetres are assumed",
                unit.unwrap_or_default()
            );
            findings.push(Finding::note(3, text));
            0.001
        }
    };
    let up = up_of(points).unwrap_or_else(|| {
        let text = "no markers of head and feet show which axis is up; +Y is taken";
        findings.push(Finding::note(None, text).with_remedy("name the axes when importing"));
        Direction::nearest(DVec3::Y)
    });
    Convention {
        metres_per_unit,
        axes: axes_with_up(points, up, findings),
    }
}

/// Writes a track of markers in a room as TRC; gaps are empty cells.
///
/// # Errors
/// Fails, with a sentence for the user, if the points are not in a room, or the frames have no even rate.
pub fn write(name: &str, markers: &Markers, offset: Instant) -> Result<String, String> {
    let Space::World(convention) = markers.space() else {
        return Err(format!(
            "TRC holds places in a room, and these are {}",
            markers.space().name()
        ));
    };
    let rate = markers
        .times()
        .rate()
        .ok_or("TRC needs an even frame rate")?;
    let units = [(1.0, "m"), (0.01, "cm"), (0.001, "mm"), (0.0254, "in")];
    let (_, unit) = units
        .iter()
        .find(|(metres, _)| (metres - convention.metres_per_unit).abs() < 1e-9)
        .ok_or_else(|| format!("TRC has no unit of {} m", convention.metres_per_unit))?;
    let per_second = rate.per_second();
    let (frames, points) = (markers.frames(), markers.points().len());
    let mut out = format!(
        "PathFileType\t4\t(X/Y/Z)\t{name}\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n\
         {per_second}\t{per_second}\t{frames}\t{points}\t{unit}\t{per_second}\t1\t{frames}\nFrame#\tTime"
    );
    for point in markers.points() {
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
        let seconds = markers.times().instant(frame).seconds() + offset.seconds();
        let _ = write!(out, "{}\t{seconds:.6}", frame + 1);
        for point in markers.points() {
            for column in &point.place {
                let text = column.text(frame).unwrap_or_default();
                let _ = write!(out, "\t{text}");
            }
        }
        out.push('\n');
    }
    Ok(out)
}
