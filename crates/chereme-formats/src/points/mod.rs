//! Marker movement as tables of text: what Motive, Nexus, QTM, DeepLabCut, Anipose and people's own scripts write.
//!
//! A row is a frame, and two or three columns are a point. The numbers are kept as decimals; columns of numbers that
//! belong to no point become curves.
//!
//! ```
//! use chereme_formats::points;
//!
//! let table = b"time,wrist_x,wrist_y,wrist_z\n0,0.1,1.2,0.3\n0.01,0.1,1.3,0.3\n";
//! assert_eq!(points::PointFile::detect_point_file(table), Some(points::PointFile::Plain));
//! let (tracks, _) = points::read_point_table(table, None)?;
//! assert_eq!(tracks.tracks[0].name, "markers");
//! # Ok::<(), points::PointTableError>(())
//! ```

mod lines;
mod motive;
mod plain;
mod points_clock;
mod points_rows;
mod qualisys;
mod space;
mod stacked;
#[cfg(test)]
mod tests;
mod titles;
mod vicon;

use chereme_motion::column::FrameNumberColumn;
use chereme_motion::{
    CaptureMethod, CurveTrack, FrameRate, FrameTimes, MarkerTrack, MotionMarker, QualityMeaning, RecordingInstant,
    ScalarCurve,
};

use crate::finding::ImportFinding;
use crate::noughts::open_noughts;
use crate::table::{TableError, decode_table_bytes};
use crate::tally::FindingTally;
use crate::tracks::{
    CapturedTrackContent, CapturedTracks, FileTrack, events_to_transcript, rate_of, unique_track_names,
};
use lines::TableTextLines;
use points_rows::{PointTableLayout, PointTableRows};

/// The kinds of tables of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointFile {
    /// The CSV of OptiTrack Motive.
    Motive,
    /// The CSV of Vicon Nexus: sections; `Trajectories` holds points.
    Vicon,
    /// The TSV of Qualisys Track Manager.
    Qualisys,
    /// Titles over several rows: names above `x`, `y` and `z`, as DeepLabCut writes them.
    Stacked,
    /// One row of titles, which name a point and its axis.
    Plain,
}

impl PointFile {
    /// Returns the kind of table that begins with these bytes; `None` if it holds no points.
    #[must_use]
    pub fn detect_point_file(head: &[u8]) -> Option<Self> {
        let text = decode_table_bytes(head, &mut FindingTally::default()).ok()?;
        let lines = TableTextLines::from_table_text(&text);
        if motive::is_motive_export(&lines) {
            return Some(Self::Motive);
        }
        if vicon::is_vicon_export(&lines) {
            return Some(Self::Vicon);
        }
        if qualisys::is_qualisys_export(&lines) {
            return Some(Self::Qualisys);
        }
        if stacked::read_stacked_layout(&lines).is_some() {
            return Some(Self::Stacked);
        }
        plain::is_plain_point_table(&lines).then_some(Self::Plain)
    }
}

/// Why bytes could not be read as a table of points.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PointTableError {
    /// The file is not text.
    #[error("line {line}: this is not text")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// The titles name no points.
    #[error(
        "this is no table of points: no columns have the name of a point and an axis, such as wrist_x, wrist_y and wrist_z"
    )]
    Unknown,
    /// A row of the header is missing.
    #[error("the header has no row of {0}; export the take again with its header")]
    Missing(&'static str),
    /// The sections of the file hold no places of markers.
    #[error("the file has no section Trajectories, which holds markers, but {0}; export the trajectories, too")]
    Sections(String),
    /// Places of bones are relative to their parents.
    #[error(
        "the places of its bones are relative to their parents (Coordinate Space is Local), and it holds no markers; export them in global coordinates, or the take as BVH, FBX or C3D"
    )]
    Local,
    /// The file holds bodies without places that can be found.
    #[error(
        "line {line}: the titles of the bodies (BODY_NAMES) do not show which columns are places; export the take as C3D, or as TSV with 3D data"
    )]
    Bodies {
        /// The line, counted from 1.
        line: u64,
    },
    /// Each row is one point of a frame.
    #[error(
        "each row is one point of a frame, which the column {column:?} names; write one row for each frame, with columns such as wrist_x, wrist_y and wrist_z"
    )]
    Long {
        /// The title of the column that names the points.
        column: String,
    },
    /// A row has more cells than the header.
    #[error("line {line}: the row has {found} cells, and the header has {expected}")]
    Width {
        /// The line, counted from 1.
        line: u64,
        /// The cells of the row.
        found: usize,
        /// The cells of the header.
        expected: usize,
    },
    /// Rows lack more cells than may be added.
    #[error(
        "line {line}: the rows up to here lack {lacking} cells of the header; the header fits other rows than these"
    )]
    Ragged {
        /// The line, counted from 1.
        line: u64,
        /// The number of missing cells so far.
        lacking: usize,
    },
    /// There are more columns than any capture has.
    #[error("the header has more than {0} columns")]
    Columns(usize),
    /// A cell is not a number.
    #[error("line {line}: {cell:?} is no number")]
    Number {
        /// The line, counted from 1.
        line: u64,
        /// The cell, cut to 40 characters.
        cell: String,
    },
    /// The time of a row is not after that of the row before.
    #[error("line {line}: its time is not after that of the row before; sort the rows by time, one row for each frame")]
    Backwards {
        /// The line, counted from 1.
        line: u64,
    },
    /// There are no rows or no points.
    #[error("the file holds no points")]
    Empty,
    /// The rows cannot be a track.
    #[error("{0}")]
    Track(String),
}

/// Reads a table of points of any kind that [`PointFile::detect_point_file`] recognises; `rate` is that of the frames if the table
/// states none.
///
/// # Errors
/// [`PointTableError`] if the table holds no points, or its rows do not fit its header.
pub fn read_point_table(
    bytes: &[u8],
    rate: Option<FrameRate>,
) -> Result<(CapturedTracks, Vec<ImportFinding>), PointTableError> {
    let mut findings = FindingTally::default();
    let text = decode_table_bytes(bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => PointTableError::NotText { line },
        _ => PointTableError::Unknown,
    })?;
    let lines = TableTextLines::from_table_text(&text);
    let layout = if motive::is_motive_export(&lines) {
        motive::read_motive_layout(&lines, &mut findings)?
    } else if vicon::is_vicon_export(&lines) {
        vicon::read_vicon_layout(&lines, &mut findings)?
    } else if qualisys::is_qualisys_export(&lines) {
        qualisys::read_qualisys_layout(&lines, &mut findings)?
    } else if let Some(layout) = stacked::read_stacked_layout(&lines) {
        layout
    } else {
        plain::read_plain_layout(&lines, &mut findings)?
    };
    let tracks = read_point_tracks(&lines, layout, rate, &mut findings)?;
    Ok((tracks, findings.finish_finding_tally()))
}

/// Reads the rows of a table whose columns are known.
fn read_point_tracks(
    lines: &TableTextLines<'_>,
    layout: PointTableLayout,
    wanted: Option<FrameRate>,
    findings: &mut FindingTally,
) -> Result<CapturedTracks, PointTableError> {
    let mut rows = PointTableRows::read_point_rows(lines, &layout, findings)?;
    let row_count = rows.lines.len();
    if let Some(stated) = layout.frames.filter(|stated| *stated != row_count) {
        let text = format!("the header states {stated} frames, and the file holds {row_count}");
        findings.push_warning_finding(layout.line, text);
    }
    let (times, offset) = points_clock::infer_row_times(&rows, &layout, wanted, findings)?;
    let wide = layout.coordinates_per_point();
    let names = unique_point_names(&layout, findings);
    // Points of pictures may truly lie in the corner 0, 0; in a room the origin is a gap.
    if wide == 3 {
        let shown: Vec<String> = names.iter().map(|(_, name)| name.clone()).collect();
        open_noughts(&shown, &mut rows.places, findings);
    }
    rows.open_unsure(&layout);
    let mut places = rows.places.into_iter();
    let mut sure = rows.quality.into_iter();
    let made = layout.points.iter().zip(names).map(|(point, (group, name))| {
        let place = places
            .by_ref()
            .take(wide)
            .map(FrameNumberColumn::from_decimals)
            .collect();
        let quality = point.quality.and_then(|_| sure.next());
        MotionMarker {
            group,
            name,
            place,
            quality: quality.map(FrameNumberColumn::from_decimals),
        }
    });
    let made: Vec<MotionMarker> = made.collect();
    let space = space::infer_point_space(&layout, &made, findings);
    let capture = match layout.quality {
        Some(QualityMeaning::Confidence) => CaptureMethod::Estimated,
        // Points of pictures come from an estimate, whatever the table says.
        _ if wide == 2 => CaptureMethod::Estimated,
        _ => CaptureMethod::Measured,
    };
    let fault = |error: chereme_motion::TrackError| PointTableError::Track(error.to_string());
    let plain_markers = MarkerTrack::new(times.clone(), space, made).map_err(fault)?;
    let markers = plain_markers.with_capture_method(capture);
    let markers = match layout.quality {
        Some(quality) => markers.with_quality_meaning(quality),
        None => markers,
    };
    let rate = times.even_times_rate().or(layout.rate.and_then(rate_of));
    let name = if capture == CaptureMethod::Estimated && layout.program.is_empty() {
        "landmarks"
    } else {
        "markers"
    };
    let mut all = vec![FileTrack::new(name, CapturedTrackContent::Markers(markers))];
    if let Some(curves) = columns_to_curves(&layout.others, rows.others, times)? {
        all.push(FileTrack::new("curves", CapturedTrackContent::Curves(curves)));
    }
    for track in &mut all {
        track.offset = offset;
    }
    let moments: Vec<(RecordingInstant, String)> = layout.events;
    Ok(CapturedTracks {
        tracks: all,
        events: rate.and_then(|rate| events_to_transcript("events", &moments, rate)),
    })
}

/// Returns the columns that belong to no point as curves.
fn columns_to_curves(
    titles: &[(String, usize)],
    columns: Vec<Vec<Option<chereme_motion::column::FileNumber>>>,
    times: FrameTimes,
) -> Result<Option<CurveTrack>, PointTableError> {
    let names = unique_track_names(titles.iter().map(|(title, _)| title.as_str()), "column");
    let named_columns = names.into_iter().zip(columns);
    let filled_columns = named_columns.filter(|(_, numbers)| numbers.iter().any(Option::is_some));
    let all_curves = filled_columns.map(|(name, numbers)| ScalarCurve {
        name,
        unit: String::new(),
        values: FrameNumberColumn::from_decimals(numbers),
    });
    let curves: Vec<ScalarCurve> = all_curves.collect();
    if curves.is_empty() {
        return Ok(None);
    }
    let curves = CurveTrack::new(times, curves).map_err(|error| PointTableError::Track(error.to_string()))?;
    Ok(Some(curves))
}

/// Returns the groups and names of the points, each pair once.
fn unique_point_names(layout: &PointTableLayout, findings: &mut FindingTally) -> Vec<(String, String)> {
    let full_name = |point: &points_rows::PointColumns| match (point.group.as_str(), point.name.as_str()) {
        ("", name) => name.to_owned(),
        (_, "") => String::new(),
        (group, name) => format!("{group}:{name}"),
    };
    let given: Vec<String> = layout.points.iter().map(full_name).collect();
    let made = unique_track_names(given.iter().map(String::as_str), "marker");
    let points = layout.points.iter().zip(&given).zip(made);
    let named = points.map(|((point, given), made)| {
        if *given == made {
            return (point.group.clone(), point.name.clone());
        }
        let (kind, text) = match given.is_empty() {
            true => (
                "markers without a label",
                format!("a marker has no label; it is {made:?} here"),
            ),
            false => (
                "repeated labels",
                format!("the label {given:?} occurs again; it is {made:?} here"),
            ),
        };
        findings.add_limited_note(kind, layout.line, || text);
        let name = match made.strip_prefix(&format!("{}:", point.group)) {
            Some(name) if !point.group.is_empty() => name.to_owned(),
            _ => made,
        };
        (point.group.clone(), name)
    });
    named.collect()
}
