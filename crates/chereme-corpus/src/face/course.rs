//! The mean of some channels of a recording over time, at the frames of its capture or movement.

use chereme_compose::faces;
use chereme_motion::{Face, Instant};
use rusqlite::Connection;

use super::captured::Captured;
use super::performances::TRUNK;
use super::{Fits, captured_with, head};
use crate::curves;
use crate::db::recordings;
use crate::error::Result;
use crate::movement::{ChannelGroup, MotionTrack};

/// The number of frames of a movement that are read at once.
const PIECE: usize = 16_384;

/// The mean of some channels over time. Between two frames its value is on the line between theirs; in gaps of a
/// capture, and outside of it, it has none.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Course {
    /// The moments of the frames in microseconds of the recording's clock, with the values there.
    frames: Vec<(i64, f64)>,
    /// The usual and the longest time between two frames without a gap, in microseconds.
    steps: (i64, i64),
}

impl Course {
    /// Returns the mean of those channels that a recording shows, by their indices in [`CHANNELS`](super::CHANNELS):
    /// all of the head, all of the trunk, or all of the face. `None` if it shows none of them.
    pub(crate) fn of(
        connection: &Connection,
        recording: i64,
        channels: &[usize],
        fits: &Fits,
    ) -> Result<Option<Self>> {
        let captured = captured_with(connection, recording, None, fits)?;
        let body = match recordings::body_track(connection, recording)? {
            Some(_) => Some(MotionTrack::of(connection, recording)?),
            None => None,
        };
        let is_face = channels.iter().all(|at| (3..TRUNK).contains(at));
        if !is_face {
            let turned = match &body {
                Some(track) => of_body(connection, track, channels)?,
                None => None,
            };
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
        moments: impl Iterator<Item = Instant>,
        values: impl Iterator<Item = f64>,
        steps: (i64, i64),
    ) -> Option<Self> {
        let mut frames: Vec<(i64, f64)> = moments.map(Instant::micros).zip(values).collect();
        frames.dedup_by_key(|(at, _)| *at);
        (!frames.is_empty()).then_some(Self { frames, steps })
    }

    /// Returns the value at a time of the recording's clock; `None` if nothing was measured.
    fn value(&self, at: i64) -> Option<f64> {
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
    pub(crate) fn passes(
        &self,
        (start, end): (i64, i64),
        lasting: i64,
        test: impl Fn(f64) -> bool,
    ) -> bool {
        let place = |at: i64| self.frames.partition_point(|(own, _)| *own <= at);
        let inside = place(start)..self.frames.partition_point(|(own, _)| *own < end);
        let inside = self.frames.get(inside).unwrap_or_default().iter().copied();
        let first = self.value(start).map(|value| (start, value));
        let last = self.value(end).map(|value| (end, value));
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
            if is_break {
                from = None;
            }
        }
        false
    }
}

/// Returns the mean of the channels that a captured face shows.
fn of_captured(captured: &Captured, channels: &[usize]) -> Option<Course> {
    let known = |number: &usize| captured.view.known[*number];
    let numbers: Vec<usize> = channels.iter().map(|at| at - 3).filter(known).collect();
    if numbers.is_empty() {
        return None;
    }
    let faces = captured.view.faces.iter();
    let means = faces.map(|face| mean_of(face, &numbers));
    Course::new(captured.moments(), means, captured.steps())
}

fn mean_of(face: &Face, numbers: &[usize]) -> f64 {
    let all = face.numbers();
    numbers.iter().map(|number| all[*number]).sum::<f64>() / numbers.len() as f64
}

/// Returns the mean of rotations of the head or trunk from a face's capture, in degrees.
fn of_captured_turns(captured: &Captured, channels: &[usize]) -> Option<Course> {
    let turns: Vec<[f64; 3]> = match channels.iter().all(|at| *at < 3) {
        true => captured.view.head.clone()?,
        false => captured
            .moments()
            .map(|at| captured.trunk_at(at))
            .collect::<Option<_>>()?,
    };
    let means = turns.iter().map(|turn| mean_turn(turn, channels));
    Course::new(captured.moments(), means, captured.steps())
}

/// Returns the mean of rotations of the head or trunk of a skeleton, in degrees; `None` if it never turns that part.
fn of_body(
    connection: &Connection,
    track: &MotionTrack,
    channels: &[usize],
) -> Result<Option<Course>> {
    let groups = [ChannelGroup::Head, ChannelGroup::Rest];
    let anatomy = track.anatomy(connection)?;
    let is_head = channels.iter().all(|at| *at < 3);
    let mut turns = Vec::new();
    let count = track.frames();
    for start in (0..count).step_by(PIECE) {
        let clip = track.clip(connection, start..count.min(start + PIECE), &groups)?;
        let (heads, trunks) = head::in_frames(&clip, &anatomy);
        turns.extend(if is_head { heads } else { trunks });
    }
    let turns = head::moving(turns);
    Ok(turns.and_then(|turns| {
        let means = turns.iter().map(|turn| mean_turn(turn, channels));
        along(track, means)
    }))
}

fn mean_turn(turn: &[f64; 3], channels: &[usize]) -> f64 {
    let sum: f64 = channels
        .iter()
        .map(|at| turn[at % TRUNK].to_degrees())
        .sum();
    sum / channels.len() as f64
}

/// Returns the mean of the channels of the face that a recipe generated.
fn of_recipe(
    connection: &Connection,
    track: &MotionTrack,
    channels: &[usize],
) -> Result<Option<Course>> {
    let numbers: Vec<usize> = channels.iter().map(|at| at - 3).collect();
    let faces = faces(&curves::of_track(connection, track, 0..track.frames())?);
    Ok(along(
        track,
        faces.iter().map(|face| mean_of(face, &numbers)),
    ))
}

/// Returns a course with a value for each frame of a movement.
fn along(track: &MotionTrack, values: impl Iterator<Item = f64>) -> Option<Course> {
    let moment = |frame: usize| track.rate.instant(frame).shifted(track.row.offset_us);
    let step = track.rate.instant(1).micros();
    Course::new((0..track.frames()).map(moment), values, (step, i64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A capture at 10 frames a second from 1 s on, with a gap from 1.3 s to 2 s.
    fn course() -> Course {
        let values = [0.0, 0.0, 0.9, 0.9, 0.9, 0.9, 0.1, 0.1, 0.9];
        let times =
            [10, 11, 12, 13, 20, 21, 22, 23, 24].map(|at: i64| Instant::from_millis(at * 100));
        Course::new(times.into_iter(), values.into_iter(), (100_000, 300_000)).expect("frames")
    }

    #[test]
    fn there_are_no_values_in_gaps_and_outside_of_a_capture() {
        let at = |seconds: f64| course().value((seconds * 1e6) as i64);
        let near = |seconds, value: f64| {
            assert!(
                at(seconds).is_some_and(|own| (own - value).abs() < 1e-9),
                "{seconds}"
            );
        };
        for (seconds, value) in [
            (0.96, 0.0),
            (1.15, 0.45),
            (1.34, 0.9),
            (1.96, 0.9),
            (2.44, 0.9),
        ] {
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
            course.passes((micros(start), micros(end)), micros(lasting), |it| it > 0.5)
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
            assert_eq!(
                passes(start, end, lasting),
                expected,
                "{start} to {end} for {lasting}"
            );
        }
    }
}
