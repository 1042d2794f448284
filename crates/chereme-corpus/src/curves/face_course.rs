//! The mean of some channels of a recording over time, at the frames of its capture or movement.

use chereme_compose::faces_from_curves;
use chereme_motion::{FacePosture, RecordingInstant};
use rusqlite::Connection;

use super::face_captured::{CapturedFace, captured_with};
use super::face_fits::CorpusFits;
use super::face_head;
use crate::db::stored_recordings;
use crate::error::CorpusResult;
use crate::movement::{ChannelGroup, MotionTrack};

/// The number of frames of a movement that are read at once.
const COURSE_PIECE_FRAMES: usize = 16_384;

/// The index of the trunk's first rotation; they come after head and face.
pub(crate) const FIRST_TRUNK_INDEX: usize = 3 + FacePosture::FACE_NUMBER_COUNT;

/// The mean of some channels over time. Between two frames its value is on the line between theirs; in gaps of a
/// capture, and outside of it, it has none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChannelCourse {
    /// The moments of the frames in microseconds of the recording's clock, with the values there.
    frames: Vec<(i64, f64)>,
    /// The usual and the longest time between two frames without a gap, in microseconds.
    steps: (i64, i64),
}

impl ChannelCourse {
    /// Returns the mean of those channels that a recording shows, by their indices among those of performances:
    /// all of the head, all of the trunk, or all of the face. `None` if it shows none of them.
    pub(crate) fn load_channel_course(
        connection: &Connection,
        recording: i64,
        channels: &[usize],
        fits: &CorpusFits,
    ) -> CorpusResult<Option<Self>> {
        let captured = captured_with(connection, recording, None, fits)?;
        let body = match stored_recordings::body_track(connection, recording)? {
            Some(_) => Some(MotionTrack::open_motion_track(connection, recording)?),
            None => None,
        };
        let is_face = channels.iter().all(|at| (3..FIRST_TRUNK_INDEX).contains(at));
        if !is_face {
            let turned = match &body {
                Some(track) => of_body(connection, track, channels)?,
                None => None,
            };
            // A skeleton that never turns the part does not hide the turns of a captured face.
            return Ok(turned.or_else(|| of_captured_turns(captured.as_ref()?, channels)));
        }
        match (&captured, &body) {
            (Some(captured), _) => Ok(of_captured(captured, channels)),
            (None, Some(track)) => of_recipe(connection, track, channels),
            (None, None) => Ok(None),
        }
    }

    /// Returns the course with these values; `None` without any.
    fn new(
        moments: impl Iterator<Item = RecordingInstant>,
        values: impl Iterator<Item = f64>,
        steps: (i64, i64),
    ) -> Option<Self> {
        let mut frames: Vec<(i64, f64)> = moments.map(RecordingInstant::instant_micros).zip(values).collect();
        // Two frames of one moment would make a line without length.
        frames.dedup_by_key(|(at, _)| *at);
        (!frames.is_empty()).then_some(Self { frames, steps })
    }

    /// Returns the value at a time of the recording's clock; `None` if nothing was measured.
    fn course_value_at(&self, at: i64) -> Option<f64> {
        // Moments are rounded to microseconds, so that half a step gets one more.
        let near = self.steps.0 / 2 + 1;
        let next = self.frames.partition_point(|(own, _)| *own <= at);
        let before = next.checked_sub(1).map(|before| self.frames[before]);
        match (before, self.frames.get(next).copied()) {
            (Some((from, a)), Some((to, b))) if to - from <= self.steps.1 => {
                Some(a + (b - a) * (at - from) as f64 / (to - from) as f64)
            }
            (Some((from, a)), _) if at - from <= near => Some(a),
            (_, Some((to, b))) if to - at <= near => Some(b),
            _ => None,
        }
    }

    /// Returns whether the values pass a test for at least `lasting` microseconds without a break between two times: at
    /// both of them, and at the frames between them. A frame lasts until the next one, and before a gap for a usual step.
    pub(crate) fn passes_lasting_test(&self, start: i64, end: i64, lasting: i64, test: impl Fn(f64) -> bool) -> bool {
        let place = |at: i64| self.frames.partition_point(|(own, _)| *own <= at);
        let inside_range = place(start)..self.frames.partition_point(|(own, _)| *own < end);
        let inside = self.frames.get(inside_range).unwrap_or_default().iter().copied();
        let first = self.course_value_at(start).map(|value| (start, value));
        let last = self.course_value_at(end).map(|value| (end, value));
        let mut points = first
            .into_iter()
            .chain(inside)
            .chain(last.filter(|_| end > start))
            .peekable();
        let mut from: Option<i64> = None;
        while let Some((at, value)) = points.next() {
            if !test(value) {
                from = None;
                continue;
            }
            let began = *from.get_or_insert(at);
            let (ends, is_break) = match points.peek() {
                Some((next, _)) if next - at <= self.steps.1 => (*next, false),
                next => ((at + self.steps.0).min(end), next.is_some()),
            };
            if ends.max(at) - began >= lasting {
                return true;
            }
            // The time on the other side of a gap is counted for itself, as nothing was measured between.
            if is_break {
                from = None;
            }
        }
        false
    }
}

/// Returns the mean of the channels that a captured face shows.
fn of_captured(captured: &CapturedFace, channels: &[usize]) -> Option<ChannelCourse> {
    let is_known = |number: &usize| captured.view.known[*number];
    let numbers: Vec<usize> = channels.iter().map(|at| at - 3).filter(is_known).collect();
    if numbers.is_empty() {
        return None;
    }
    let faces = captured.view.faces.iter();
    let means = faces.map(|face| mean_of(face, &numbers));
    ChannelCourse::new(captured.capture_frame_moments(), means, captured.capture_frame_steps())
}

fn mean_of(face: &FacePosture, numbers: &[usize]) -> f64 {
    let all = face.face_numbers();
    numbers.iter().map(|number| all[*number]).sum::<f64>() / numbers.len() as f64
}

/// Returns the mean of rotations of the head or trunk from a face's capture, in degrees.
fn of_captured_turns(captured: &CapturedFace, channels: &[usize]) -> Option<ChannelCourse> {
    let turns: Vec<[f64; 3]> = match channels.iter().all(|at| *at < 3) {
        true => captured.view.head.clone()?,
        false => captured
            .capture_frame_moments()
            .map(|at| captured.trunk_at(at))
            .collect::<Option<_>>()?,
    };
    let means = turns.iter().map(|turn| mean_turn(turn, channels));
    ChannelCourse::new(captured.capture_frame_moments(), means, captured.capture_frame_steps())
}

/// Returns the mean of rotations of the head or trunk of a skeleton, in degrees; `None` if it never turns that part.
fn of_body(connection: &Connection, track: &MotionTrack, channels: &[usize]) -> CorpusResult<Option<ChannelCourse>> {
    let groups = [ChannelGroup::Head, ChannelGroup::Rest];
    let anatomy = track.track_anatomy(connection)?;
    let is_head = channels.iter().all(|at| *at < 3);
    let mut turns = Vec::new();
    let count = track.motion_frame_count();
    for start in (0..count).step_by(COURSE_PIECE_FRAMES) {
        let clip = track.read_motion_clip(connection, start..count.min(start + COURSE_PIECE_FRAMES), &groups)?;
        let (heads, trunks) = face_head::in_frames(&clip, &anatomy);
        turns.extend(if is_head { heads } else { trunks });
    }
    // Whether a part ever turns shows in all pieces together only.
    let turns = face_head::only_moving_turns(turns);
    Ok(turns.and_then(|turns| {
        let means = turns.iter().map(|turn| mean_turn(turn, channels));
        course_along_track(track, means)
    }))
}

fn mean_turn(turn: &[f64; 3], channels: &[usize]) -> f64 {
    // The turns of head and trunk both count from 0, wherever their channels lie.
    let sum: f64 = channels
        .iter()
        .map(|at| turn[at % FIRST_TRUNK_INDEX].to_degrees())
        .sum();
    sum / channels.len() as f64
}

/// Returns the mean of the channels of the face that a recipe generated.
fn of_recipe(connection: &Connection, track: &MotionTrack, channels: &[usize]) -> CorpusResult<Option<ChannelCourse>> {
    let numbers: Vec<usize> = channels.iter().map(|at| at - 3).collect();
    let faces = faces_from_curves(&super::of_track(connection, track, 0..track.motion_frame_count())?);
    Ok(course_along_track(
        track,
        faces.iter().map(|face| mean_of(face, &numbers)),
    ))
}

/// Returns a course with a value for each frame of a movement.
fn course_along_track(track: &MotionTrack, values: impl Iterator<Item = f64>) -> Option<ChannelCourse> {
    let moment = |frame: usize| {
        track
            .rate
            .frame_start_instant(frame)
            .shifted_instant(track.row.offset_us)
    };
    let step = track.rate.frame_start_instant(1).instant_micros();
    // Movement has a frame at every step, so that none of its steps is a gap.
    ChannelCourse::new((0..track.motion_frame_count()).map(moment), values, (step, i64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A capture at 10 frames a second from 1 s on, with a gap from 1.3 s to 2 s.
    fn course() -> ChannelCourse {
        let values = [0.0, 0.0, 0.9, 0.9, 0.9, 0.9, 0.1, 0.1, 0.9];
        let times = [10, 11, 12, 13, 20, 21, 22, 23, 24].map(|at: i64| RecordingInstant::from_millis(at * 100));
        ChannelCourse::new(times.into_iter(), values.into_iter(), (100_000, 300_000)).expect("frames")
    }

    #[test]
    fn there_are_no_values_in_gaps_and_outside_of_a_capture() {
        let at = |seconds: f64| course().course_value_at((seconds * 1e6) as i64);
        let near = |seconds, value: f64| {
            assert!(at(seconds).is_some_and(|own| (own - value).abs() < 1e-9), "{seconds}");
        };
        for (seconds, value) in [(0.96, 0.0), (1.15, 0.45), (1.34, 0.9), (1.96, 0.9), (2.44, 0.9)] {
            near(seconds, value);
        }
        for seconds in [0.0, 0.9, 1.4, 1.7, 1.9, 2.5, 60.0] {
            assert_eq!(at(seconds), None, "{seconds}");
        }
    }

    #[test]
    fn a_run_counts_as_far_as_it_lies_in_the_token_and_gaps_break_it() {
        let course = course();
        let passes = |start: f64, end: f64, lasting: f64| {
            let micros = |seconds: f64| (seconds * 1e6) as i64;
            course.passes_lasting_test(micros(start), micros(end), micros(lasting), |it| it > 0.5)
        };
        // Start and end of a token, the required time, and whether there is a run.
        for (start, end, lasting, expected) in [
            (1.0, 2.5, 0.2, true),
            (1.0, 2.5, 0.3, false),
            (1.31, 1.99, 0.0, true),
            (1.4, 1.9, 0.0, false),
            (1.25, 1.3, 0.05, true),
            (1.25, 1.3, 0.1, false),
            (0.0, 1.0, 0.0, false),
            (1.0, 1.1, 0.0, false),
            (1.0, 1.18, 0.0, true),
            (2.2, 2.5, 0.1, true),
            (2.2, 2.7, 0.11, false),
            (60.0, 61.0, 0.0, false),
            (1.2, 1.2, 0.0, true),
        ] {
            assert_eq!(passes(start, end, lasting), expected, "{start} to {end} for {lasting}");
        }
    }
}
