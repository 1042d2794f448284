//! Scalar channels: Live Link Face (tables and packets), OpenFace, MediaPipe blendshapes, FAP text, and plain CSV.
//!
//! Every column becomes a curve under its own name with its exact decimals. Times are those of the file:
//! timecodes, timestamps, frame numbers or seconds.

mod curves_table;
mod fap;
mod live_link;
mod mediapipe;
mod packets;
#[cfg(test)]
pub(crate) mod tests;

use chereme_motion::column::{FileNumber, FrameNumberColumn};
use chereme_motion::{CurveTrack, FrameRate, FrameTimes, RecordingInstant, ScalarCurve};

use crate::faces::FaceSystem;
use crate::finding::ImportFinding;
use crate::keypoints;
use crate::scene::near_usual;
use crate::table::{TableError, decode_table_bytes};
use crate::tally::FindingTally;
use crate::tracks::{CapturedTrackContent, CapturedTracks, FileTrack, rate_of, unique_track_names};
pub use live_link::write_live_link_csv;

pub(crate) use curves_table::{ColumnTimeUnit, are_micros, are_millis, unit_of_time};

/// Largest distance of a time from an even grid, as a share of a frame, at which the rate still counts as even.
const EVEN_SLACK: f64 = 0.1;

/// Largest distance, in seconds, of times from the grid of a rate that were computed from it and not rounded.
const EXACT_SLACK: f64 = 1e-9;

/// The kinds of files of channels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveFile {
    /// The CSV of Live Link Face: timecodes and the 52 shapes of ARKit.
    LiveLink,
    /// The CSV of OpenFace 2: gaze, head, landmarks and action units.
    OpenFace,
    /// JSON of MediaPipe's face landmarker, frames of named scores, or of ARKit's shapes.
    MediaPipe,
    /// MPEG-4 facial animation parameters as text.
    Fap,
    /// Packets of Live Link Face as they came over the network.
    Packets,
    /// A table whose first column is a time or a frame number.
    Plain,
}

impl CurveFile {
    /// Returns the kind of file that begins with these bytes; `None` if it holds no channels.
    #[must_use]
    pub fn detect_curve_file(bytes: &[u8]) -> Option<Self> {
        if packets::is_recording(bytes) {
            return Some(Self::Packets);
        }
        let start_text = String::from_utf8_lossy(&bytes[..bytes.len().min(1 << 14)]);
        let start = start_text.trim_start_matches('\u{feff}').trim_start();
        if start.starts_with(['{', '[']) {
            let named = start.contains("\"categoryName\"") && !keypoints::has_sides(&start.to_ascii_lowercase());
            let is_scores = named || start.contains("\"faceBlendshapes\"") || mediapipe::names_shapes(start);
            return is_scores.then_some(Self::MediaPipe);
        }
        let text_lines = start.lines().map(str::trim);
        let shown = text_lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
        if shown.clone().next().is_some_and(mediapipe::opens_score) {
            return Some(Self::MediaPipe);
        }
        let head = start.lines().next()?.to_lowercase();
        if fap::is_header(&head) {
            return Some(Self::Fap);
        }
        let cells: Vec<&str> = head
            .split([',', ';', '\t'])
            .map(|cell| cell.trim().trim_matches('"'))
            .collect();
        match *cells.first()? {
            "timecode" if cells.get(1) == Some(&"blendshapecount") => Some(Self::LiveLink),
            "frame" if cells.contains(&"confidence") && cells.contains(&"success") => Some(Self::OpenFace),
            _ if curves_table::column_of_time(cells.iter().copied()).is_some_and(|(at, _)| cells.len() > at + 1) => {
                Some(Self::Plain)
            }
            // Without their rate frames are no times; the reader says so of a face.
            "frame" | "frames" if FaceSystem::of_names(cells.iter().copied()).is_some() => Some(Self::Plain),
            _ => None,
        }
    }
}

/// Why bytes could not be read as channels.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CurveError {
    /// The file is not text.
    #[error("line {line}: this is not text")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// The file is not one of the known kinds.
    #[error("this is no table of channels: its first column is neither a timecode, a time nor a frame number")]
    Unknown,
    /// The first column counts frames, and nothing states their rate.
    #[error(
        "line 1: the first column counts frames, whose rate is not stated; write it into its title, such as frame [30 fps]"
    )]
    NoRate,
    /// A row has another number of cells than the header.
    #[error("line {line}: the row has {found} cells, and the header has {expected}")]
    Width {
        /// The line, counted from 1.
        line: u64,
        /// The cells of the row.
        found: usize,
        /// The cells of the header.
        expected: usize,
    },
    /// A cell has another form than its column.
    #[error("line {line}: {cell:?} is no {expected}")]
    Cell {
        /// The line, counted from 1.
        line: u64,
        /// The cell, cut to 40 characters.
        cell: String,
        /// The expected form.
        expected: &'static str,
    },
    /// The document is no JSON of scores.
    #[error("{0}")]
    Json(String),
    /// There are no rows or no channels.
    #[error("the file holds no numbers")]
    Empty,
    /// The rows cannot be a track.
    #[error("{0}")]
    Track(String),
}

impl CurveError {
    fn curve_cell_error(line: u64, cell: &str, expected: &'static str) -> Self {
        Self::Cell {
            line,
            cell: cell.chars().take(40).collect(),
            expected,
        }
    }
}

/// Reads a file of channels of any kind that [`CurveFile::detect_curve_file`] recognises.
///
/// # Errors
/// [`CurveError`] if the file is of no known kind, or its rows do not fit their header.
pub fn read_curves(bytes: &[u8]) -> Result<(CapturedTracks, Vec<ImportFinding>), CurveError> {
    let mut findings = FindingTally::default();
    let kind = CurveFile::detect_curve_file(bytes).ok_or(CurveError::Unknown)?;
    if kind == CurveFile::Packets {
        let channels = packets::read_packet_channels(bytes, &mut findings)?;
        return Ok((
            channels.channels_to_tracks(kind, &mut findings)?,
            findings.finish_finding_tally(),
        ));
    }
    let text = decode_table_bytes(bytes, &mut findings).map_err(|error| match error {
        TableError::NotText { line } => CurveError::NotText { line },
        _ => CurveError::Unknown,
    })?;
    if kind == CurveFile::OpenFace {
        let mut tracks = CapturedTracks::default();
        for (number, face) in (1..).zip(curves_table::open_face(&text, &mut findings)?) {
            for mut track in face.channels_to_tracks(kind, &mut findings)?.tracks {
                // The first face keeps the plain name, which links of films and recordings use.
                if number > 1 {
                    track.name = format!("{} {number}", track.name);
                }
                tracks.tracks.push(track);
            }
        }
        return match tracks.tracks.is_empty() {
            true => Err(CurveError::Empty),
            false => Ok((tracks, findings.finish_finding_tally())),
        };
    }
    let channels = match kind {
        CurveFile::LiveLink => curves_table::live_link(&text, &mut findings)?,
        CurveFile::Plain => curves_table::read_plain_channels(&text, &mut findings)?,
        CurveFile::MediaPipe => mediapipe::read_mediapipe_channels(&text, &mut findings)?,
        CurveFile::Fap => fap::read_fap_channels(&text)?,
        CurveFile::OpenFace | CurveFile::Packets => return Err(CurveError::Unknown),
    };
    Ok((
        channels.channels_to_tracks(kind, &mut findings)?,
        findings.finish_finding_tally(),
    ))
}

/// Channels and times from a reader of one kind.
struct CurveChannels {
    names: Vec<String>,
    units: Vec<&'static str>,
    /// The numbers, channel by channel.
    columns: Vec<Vec<Option<FileNumber>>>,
    clock: CurveClock,
}

/// The form in which a file gives the times of its rows.
enum CurveClock {
    /// Seconds of each row.
    Seconds(Vec<f64>),
    /// An even rate from the first row on.
    Rate(FrameRate),
}

impl CurveChannels {
    fn new(names: Vec<String>) -> Self {
        Self {
            columns: vec![Vec::new(); names.len()],
            units: vec![""; names.len()],
            names,
            clock: CurveClock::Seconds(Vec::new()),
        }
    }

    fn channels_to_tracks(self, kind: CurveFile, findings: &mut FindingTally) -> Result<CapturedTracks, CurveError> {
        let rows = self.columns.first().map_or(0, Vec::len);
        if rows == 0 {
            return Err(CurveError::Empty);
        }
        let day = match (&self.clock, kind) {
            // Live Link writes the time of day, by which the tracks of a take are joined.
            (CurveClock::Seconds(seconds), CurveFile::LiveLink) => seconds.first().copied(),
            _ => None,
        };
        let (times, offset) = curve_row_times(self.clock, kind, findings)?;
        let names = unique_track_names(self.names.iter().map(String::as_str), "column");
        let named_columns = names.into_iter().zip(self.columns).zip(self.units);
        let curves = named_columns.map(|((name, numbers), unit)| ScalarCurve {
            name,
            unit: unit.to_owned(),
            values: FrameNumberColumn::from_decimals(numbers),
        });
        let curves = CurveTrack::new(times, curves.collect()).map_err(|error| CurveError::Track(error.to_string()))?;
        let system = FaceSystem::system_of_curves(&curves);
        if let Some(system) = system {
            for unit in system.derive_face_view(&curves).units {
                findings.push_counted_finding(unit);
            }
        }
        // A plain table may hold anything, and is a face if its names are those of a face system.
        let is_face = kind != CurveFile::Plain || system.is_some();
        let name = if is_face { "face" } else { "curves" };
        let mut track = FileTrack::new(name, CapturedTrackContent::Curves(curves));
        track.offset = offset;
        track.clock = day.map(RecordingInstant::from_seconds);
        Ok(CapturedTracks {
            tracks: vec![track],
            events: None,
        })
    }
}

/// Returns an even rate if the rows are even, else their own times, and the time of the first row.
fn curve_row_times(
    clock: CurveClock,
    kind: CurveFile,
    findings: &mut FindingTally,
) -> Result<(FrameTimes, RecordingInstant), CurveError> {
    let seconds = match clock {
        CurveClock::Rate(rate) => {
            return Ok((FrameTimes::Even(rate), RecordingInstant::RECORDING_START));
        }
        CurveClock::Seconds(seconds) => seconds,
    };
    let first = seconds.first().copied().unwrap_or_default();
    // A timecode is the time of day; the track begins with its first row.
    let offset = match kind {
        CurveFile::LiveLink | CurveFile::Packets => RecordingInstant::RECORDING_START,
        _ => RecordingInstant::from_seconds(first),
    };
    if matches!(kind, CurveFile::LiveLink | CurveFile::Packets) {
        findings.push_note_finding(
            None,
            format!("its first row has the time {first:.3} s of the day; that is 0 s here"),
        );
    }
    let from_first: Vec<f64> = seconds.iter().map(|time| time - first).collect();
    let count = from_first.len();
    let last = from_first.last().copied().unwrap_or_default();
    let mean = (count.max(2) - 1) as f64 / last;
    let fits = |rate: &FrameRate, slack: f64| {
        let near = |(frame, time): (usize, &f64)| (time - frame as f64 * rate.frame_time()).abs() <= slack;
        from_first.iter().enumerate().all(near)
    };
    // Rounded times show a usual rate with an error of their own; exact ones show theirs, however near a usual one is.
    let exact = rate_of(mean).filter(|rate| fits(rate, EXACT_SLACK));
    let rates = [near_usual(mean), mean].into_iter().filter_map(rate_of);
    let even = exact.or_else(|| {
        rates
            .into_iter()
            .find(|rate| fits(rate, EVEN_SLACK * rate.frame_time()))
    });
    if let Some(rate) = even.filter(|_| count > 1) {
        return Ok((FrameTimes::Even(rate), offset));
    }
    let times = FrameTimes::from_listed_seconds(FrameNumberColumn::from_double_floats(from_first))
        .map_err(|error| CurveError::Track(error.to_string()))?;
    Ok((times, offset))
}
