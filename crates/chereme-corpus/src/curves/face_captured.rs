//! The captured face of a recording: channels of a face system, or points of a face on film.

use chereme_compose::{FACE_NUMBER_PREFIX, GeneratedCurve};
use chereme_formats::faces::{DerivedFaceView, FaceMeasures, FaceMesh, FaceSystem};
use chereme_motion::{CurveTrack, FacePosture, FrameTimes, RecordingInstant, TimeSpan};
use rusqlite::Connection;

use super::face_fits::CorpusFits;
use crate::db::stored_tracks::{self, TrackKind, TrackRow};
use crate::db::upgrade::NONMANUALS_TRACK_NAME;
use crate::error::{CorpusError, CorpusResult};
use crate::track;

/// The number of frames of points that are read at once.
const FACE_POINTS_PIECE_FRAMES: usize = 4_096;
/// The largest number of frames of points that are read as a face.
const MAX_FACE_POINT_FRAMES: usize = 1_000_000;

/// The height of the head above the hips, in metres: the lever by which a leaning trunk moves it.
const HEAD_ABOVE_HIPS_M: f64 = 0.65;

/// The captured face of a recording.
pub(crate) struct CapturedFace {
    pub(crate) row: TrackRow,
    pub(crate) times: FrameTimes,
    pub(crate) view: DerivedFaceView,
    /// The recording of the take on which the weights were fitted.
    pub(crate) fitted: Option<i64>,
    /// The mean position of the head.
    usual_place: Option<[f64; 3]>,
    steps: CaptureFrameSteps,
}

/// The times between the frames of a capture, in microseconds.
#[derive(Debug, Clone, Copy)]
struct CaptureFrameSteps {
    usual: i64,
    /// The longest one that is no gap.
    longest: i64,
}

impl CaptureFrameSteps {
    fn from_frame_times(times: &FrameTimes, frames: usize) -> Self {
        Self {
            usual: times.usual_step(frames),
            longest: times.longest_step(frames),
        }
    }
}

/// Returns the captured face of a recording, complete or in the frames within a span of the recording's clock: the
/// first track of curves in a face system, otherwise the first track of points with a face. Curves that a recipe
/// generated do not count.
pub(crate) fn load_captured_face(
    connection: &Connection,
    recording: i64,
    span: Option<TimeSpan>,
) -> CorpusResult<Option<CapturedFace>> {
    captured_with(connection, recording, span, &CorpusFits::load_corpus_fits(connection)?)
}

/// Returns the captured face as [`load_captured_face`] does, with fitted weights that were looked up before.
pub(crate) fn captured_with(
    connection: &Connection,
    recording: i64,
    span: Option<TimeSpan>,
    fits: &CorpusFits,
) -> CorpusResult<Option<CapturedFace>> {
    // Channels of expressions, such as joy, do not give single numbers of a face.
    if let Some(channels) = load_face_channels(connection, recording, span, |system| !system.expressions)? {
        let FaceChannels { row, system, curves } = channels;
        let mut view = system.derive_face_view(&curves);
        let fitted = fits.apply_recording_fit(recording, &mut view);
        return Ok(Some(CapturedFace {
            steps: CaptureFrameSteps::from_frame_times(curves.curve_times(), view.faces.len()),
            times: curves.curve_times().clone(),
            usual_place: usual_place(&view),
            view,
            row,
            fitted,
        }));
    }
    // Channels of a face system are closer to what was measured than numbers derived from points.
    for row in stored_tracks::load_track_rows(connection, recording)? {
        if row.kind == TrackKind::Markers
            && let Some(found) = of_points(connection, recording, row, fits)?
        {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// The channels of a captured face in the frames of a span.
pub(crate) struct FaceChannels {
    /// The track; its offset and its time of day are those of the time 0 of the curves.
    pub(crate) row: TrackRow,
    pub(crate) system: &'static FaceSystem,
    pub(crate) curves: CurveTrack,
}

/// Returns the channels of the first track of curves in a face system that is wanted, all of them or those in the frames
/// within a span of the recording's clock.
pub(crate) fn load_face_channels(
    connection: &Connection,
    recording: i64,
    span: Option<TimeSpan>,
    is_wanted: fn(&FaceSystem) -> bool,
) -> CorpusResult<Option<FaceChannels>> {
    for mut row in stored_tracks::load_track_rows(connection, recording)? {
        if row.kind != TrackKind::Curves || row.name == NONMANUALS_TRACK_NAME {
            continue;
        }
        let channels = stored_tracks::load_channel_rows(connection, row.id)?;
        let names = channels.iter().map(|channel| channel.name.as_str());
        let Some(system) = FaceSystem::of_names(names).filter(|system| is_wanted(system)) else {
            continue;
        };
        let curves = track::track_read::read_track_curves(connection, &row, span)?;
        if let (Some(span), Some(rate)) = (span, row.rate) {
            // In a part at an even rate, times count from its first frame.
            let count = usize::try_from(row.frames.unwrap_or_default()).unwrap_or(usize::MAX);
            let skipped = FrameTimes::Even(rate).frames_in(span.shifted_span(-row.offset_us), count);
            let moved = rate.frame_start_instant(skipped.start).instant_micros();
            row.offset_us = row.offset_us.saturating_add(moved);
            row.clock_us = row.clock_us.map(|clock| clock.saturating_add(moved));
        }
        return Ok(Some(FaceChannels { row, system, curves }));
    }
    Ok(None)
}

/// Returns the face from a track of points; `None` if the points contain no face.
fn of_points(
    connection: &Connection,
    recording: i64,
    row: TrackRow,
    fits: &CorpusFits,
) -> CorpusResult<Option<CapturedFace>> {
    let channels = stored_tracks::load_channel_rows(connection, row.id)?;
    let named = channels
        .iter()
        .map(|channel| (channel.part.as_str(), channel.name.as_str()));
    let Some(mesh) = FaceMesh::find_face_mesh(named) else {
        return Ok(None);
    };
    let count = usize::try_from(row.frames.unwrap_or_default()).unwrap_or(usize::MAX);
    let Some(system) = FaceSystem::find_face_system("mesh").filter(|_| count <= MAX_FACE_POINT_FRAMES) else {
        return Ok(None);
    };
    let mut measured: Vec<FaceMeasures> = Vec::new();
    let times = match row.rate {
        Some(rate) => {
            while measured.len() < count {
                let part = measured.len()..count.min(measured.len() + FACE_POINTS_PIECE_FRAMES);
                let span = rate.frame_range_span(part.clone()).shifted_span(row.offset_us);
                let points = track::track_read::read_track_markers(connection, &row, Some(span))?;
                let more = mesh.measure_face_frames(&points);
                // The track states more frames than it has blocks for.
                if more.is_empty() {
                    break;
                }
                measured.extend(more.into_iter().take(part.len()));
            }
            FrameTimes::Even(rate)
        }
        None => {
            let points = track::track_read::read_track_markers(connection, &row, None)?;
            measured = mesh.measure_face_frames(&points);
            points.marker_times().clone()
        }
    };
    let Ok(curves) = FaceMesh::face_measure_curves(times.clone(), &measured) else {
        return Ok(None);
    };
    let mut view = system.derive_face_view(&curves);
    if !view.known.iter().any(|known| *known) {
        return Ok(None);
    }
    let fitted = fits.apply_recording_fit(recording, &mut view);
    Ok(Some(CapturedFace {
        steps: CaptureFrameSteps::from_frame_times(&times, view.faces.len()),
        // Points on film have no place of the head in space.
        usual_place: None,
        row,
        times,
        view,
        fitted,
    }))
}

/// Returns the mean position of a head.
fn usual_place(view: &DerivedFaceView) -> Option<[f64; 3]> {
    let places = view.place.as_ref().filter(|all| !all.is_empty())?;
    let middle = |axis: usize| {
        let sum: f64 = places.iter().map(|at| at[axis]).sum();
        sum / places.len() as f64
    };
    Some(std::array::from_fn(middle))
}

impl CapturedFace {
    /// Returns the moments of the frames on the recording's clock.
    pub(crate) fn capture_frame_moments(&self) -> impl Iterator<Item = RecordingInstant> + '_ {
        let frames = 0..self.view.faces.len();
        frames.map(|frame| self.times.frame_time_instant(frame).shifted_instant(self.row.offset_us))
    }

    /// Returns the usual and the longest time between two frames without a gap, in microseconds.
    pub(crate) fn capture_frame_steps(&self) -> (i64, i64) {
        (self.steps.usual, self.steps.longest)
    }

    /// Returns whether the face was measured at a moment of the recording's clock: within half a usual step of a frame,
    /// or between two frames without a gap.
    pub(crate) fn is_measured_at(&self, moment: RecordingInstant) -> bool {
        let track_time = moment.shifted_instant(-self.row.offset_us);
        let count = self.view.faces.len();
        let Some(before) = self.times.shown_frame_at(track_time, count) else {
            return false;
        };
        // Moments are rounded to microseconds.
        let near = self.steps.usual / 2 + 1;
        let micros_at = |frame: usize| self.times.frame_time_instant(frame).instant_micros();
        let (own, first) = (track_time.instant_micros(), micros_at(before));
        if (own - first).abs() <= near {
            return true;
        }
        let next = before + 1;
        own > first && next < count && {
            micros_at(next) - own <= near || micros_at(next) - first <= self.steps.longest
        }
    }

    /// Returns the rotation of the trunk at a moment, in radians, estimated from the position of the head: a leaning
    /// trunk moves the head forward and sideways. `None` if the capture has no position of the head.
    pub(crate) fn trunk_at(&self, moment: RecordingInstant) -> Option<[f64; 3]> {
        let places = self.view.place.as_ref()?;
        let (first, second, share) = self.place_of(moment);
        let (a, b) = (places.get(first)?, places.get(second)?);
        let usual = self.usual_place?;
        // Only what differs from the usual place is leaning; the height of the head says nothing about it.
        let [left, _, forward] = std::array::from_fn(|n| a[n] + (b[n] - a[n]) * share - usual[n]);
        // A place far off, such as that of a person who steps aside, must not bend the trunk past 45 degrees.
        let turn = |away: f64| (away / HEAD_ABOVE_HIPS_M).clamp(-0.7, 0.7).asin();
        // A lean to the left is a negative roll, as roll is positive to the right.
        Some([turn(forward), 0.0, -turn(left)])
    }

    /// Returns the two frames around a moment of the recording's clock, and the share of the way from the first to the
    /// second.
    fn place_of(&self, moment: RecordingInstant) -> (usize, usize, f64) {
        let track_seconds = moment.shifted_instant(-self.row.offset_us).instant_seconds();
        let last = self.view.faces.len().saturating_sub(1);
        let place = match self.times.even_times_rate() {
            Some(rate) => (track_seconds * rate.per_second()).clamp(0.0, last as f64),
            None => self.listed_frame_position(track_seconds, last),
        };
        let first = place.floor() as usize;
        (first, (first + 1).min(last), place.fract())
    }

    /// Returns the face, its known numbers and the rotation of the head at a moment of the recording's clock, blended
    /// between frames, also across gaps; before the first frame and after the last one those of the nearest frame. So a
    /// face can be drawn at any time: whoever measures asks [`is_measured_at`](Self::is_measured_at) as well.
    pub(crate) fn blended_face_at(&self, moment: RecordingInstant) -> (FacePosture, Option<[f64; 3]>) {
        let (first, second, share) = self.place_of(moment);
        let face = match self.view.faces.get(first) {
            Some(face) if share == 0.0 => *face,
            Some(face) => face.interpolate_face(&self.view.faces[second], share),
            None => FacePosture::default(),
        };
        let head = self.view.head.as_ref().and_then(|all| {
            let (a, b) = (all.get(first)?, all.get(second)?);
            Some(std::array::from_fn(|n| a[n] + (b[n] - a[n]) * share))
        });
        (face, head)
    }

    fn listed_frame_position(&self, seconds: f64, last: usize) -> f64 {
        let seconds_at = |frame: usize| self.times.frame_time_instant(frame).instant_seconds();
        let moment = RecordingInstant::from_seconds(seconds);
        let first = self.times.shown_frame_at(moment, last + 1).unwrap_or(0).min(last);
        let second = (first + 1).min(last);
        let share = (seconds - seconds_at(first)) / (seconds_at(second) - seconds_at(first));
        // Two frames of one time divide zero by zero.
        first as f64 + if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) }
    }

    /// Returns a curve for each number of the capture, at these moments of the recording's clock.
    pub(crate) fn sample_capture_curves(&self, moments: impl Iterator<Item = RecordingInstant>) -> Vec<GeneratedCurve> {
        let faces: Vec<[f64; FacePosture::FACE_NUMBER_COUNT]> =
            moments.map(|at| self.blended_face_at(at).0.face_numbers()).collect();
        let known_numbers = FacePosture::FACE_NUMBER_NAMES
            .iter()
            .enumerate()
            .filter(|(n, _)| self.view.known[*n]);
        known_numbers
            .map(|(n, name)| GeneratedCurve {
                name: format!("{FACE_NUMBER_PREFIX}{name}"),
                values: faces.iter().map(|numbers| numbers[n]).collect(),
            })
            .collect()
    }
}

/// Returns whether a recording has a captured face.
pub(crate) fn has_face(connection: &Connection, recording: i64) -> CorpusResult<bool> {
    Ok(load_captured_face(connection, recording, None)?.is_some())
}

pub(crate) fn no_face(recording: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("the recording {recording:?} has no captured face"))
        .with_error_place(recording)
        .with_advice("import its face file (Live Link CSV, OpenFace CSV, MediaPipe JSON, .fap) under the same name")
}

/// Returns a curve for each number of the captured face of a recording, at these moments of its clock; empty without one.
pub(crate) fn curves_at(
    connection: &Connection,
    recording: i64,
    moments: impl Iterator<Item = RecordingInstant> + Clone,
) -> CorpusResult<Vec<GeneratedCurve>> {
    let (Some(first), Some(last)) = (moments.clone().next(), moments.clone().last()) else {
        return Ok(Vec::new());
    };
    const CURVE_MARGIN_US: i64 = 200_000;
    let span = TimeSpan::span_between(
        first.shifted_instant(-CURVE_MARGIN_US),
        last.shifted_instant(CURVE_MARGIN_US),
    );
    let captured_face = load_captured_face(connection, recording, Some(span))?;
    Ok(captured_face.map_or(Vec::new(), |face| face.sample_capture_curves(moments)))
}
