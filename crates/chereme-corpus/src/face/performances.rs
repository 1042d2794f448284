//! Expressions as numbers at one rate, cut into phases, and cached until their recordings change.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;

use chereme_analysis::phases::PhasedPerformance;
use chereme_compose::faces_from_curves;
use chereme_motion::{FacePosture, RecordingInstant, TimeSpan};
use chereme_sign::milestones::{ExpressionFunction, ExpressionMilestones};
use rusqlite::Connection;
use serde::Serialize;

use super::expressions::{self, FaceExpression};
use super::{shelf, touched};
use crate::curves;
use crate::curves::face_captured::captured_with;
use crate::curves::face_course::FIRST_TRUNK_INDEX;
use crate::curves::face_fits::CorpusFits;
use crate::curves::face_head::{self, HeadTrunkTurns};
use crate::db::stored_recordings::RecordingRow;
use crate::db::{stored_history, stored_recordings};
use crate::error::{CorpusError, CorpusResult};
use crate::movement::{ChannelGroup, MotionTrack};
use crate::progress::ProgressReceiver;

/// The frames per second at which performances are compared; the window of 10 frames is then a third of a second.
pub(crate) const PERFORMANCE_RATE_FPS: f64 = 30.0;
/// The time that is read before and after the requested moments, in microseconds.
const PERFORMANCE_MARGIN_US: i64 = 200_000;
/// The part of a frame by which a moment may come after the last one, as moments are rounded.
const NEAR_FRAME: f64 = 0.01;
/// The largest number of frames of a performance that can be compared.
const MAX_PERFORMANCE_FRAMES: usize = 3_600;

/// A channel for comparing performances.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FaceChannel {
    /// The name, one of [`FacePosture::FACE_NUMBER_NAMES`], `head_pitch`, `head_yaw`, `head_roll`, or the same of the `trunk`.
    pub name: &'static str,
    /// The unit, a difference that counts as 1: for rotations in degrees, otherwise a share of the usual range.
    pub counts_as_one: f64,
    /// Whether it is compared by default.
    pub usual: bool,
}

/// The channels; those that the paper compares come first: head, brows, and brows drawn together; the trunk comes last.
pub const FACE_CHANNELS: [FaceChannel; 27] = {
    const fn new_face_channel(name: &'static str, counts_as_one: f64, usual: bool) -> FaceChannel {
        FaceChannel {
            name,
            counts_as_one,
            usual,
        }
    }
    let mut all = [new_face_channel("head_pitch", 10.0, true); 27];
    all[1] = new_face_channel("head_yaw", 10.0, true);
    all[2] = new_face_channel("head_roll", 10.0, true);
    let mut index = 0;
    while index < FacePosture::FACE_NUMBER_COUNT {
        // A quarter of the range of a face counts as 10 degrees of the head.
        all[index + 3] = new_face_channel(FacePosture::FACE_NUMBER_NAMES[index], 0.25, index < 3);
        index += 1;
    }
    all[FIRST_TRUNK_INDEX] = new_face_channel("trunk_pitch", 10.0, false);
    all[FIRST_TRUNK_INDEX + 1] = new_face_channel("trunk_yaw", 10.0, false);
    all[FIRST_TRUNK_INDEX + 2] = new_face_channel("trunk_roll", 10.0, false);
    all
};

/// A performance as numbers.
#[derive(Debug, Clone)]
pub(crate) struct FacePerformance {
    pub(crate) expression: FaceExpression,
    /// The address of its expression.
    pub(crate) address: String,
    /// The recording's name.
    pub(crate) name: String,
    /// Numbers of the requested channels at [`PERFORMANCE_RATE_FPS`] from M1 on; `None` if unknown. If nothing was measured at a time, they are
    /// no number.
    pub(crate) columns: Vec<Option<Vec<f64>>>,
    /// M1 to M5 in frames.
    pub(crate) marks: [usize; 5],
    /// The time from M1 to M5, in seconds.
    pub(crate) seconds: f64,
}

impl FacePerformance {
    /// Returns the performance cut into phases, with numbers in their channels' units. `asked` are the channels of its
    /// columns, and `use_of` the indices of the columns to use; `one` makes its body a single phase. Of the phases before
    /// and after the body only the measured part counts.
    ///
    /// # Errors
    /// Fails if the expression is too long, lacks a channel, or its body was not measured throughout.
    pub(crate) fn phased_of(&self, asked: &[usize], use_of: &[usize], one: bool) -> CorpusResult<PhasedPerformance> {
        self.within_length()?;
        let mut columns = Vec::with_capacity(use_of.len());
        for &at in use_of {
            let channel = FACE_CHANNELS[asked[at]];
            let Some(column) = &self.columns[at] else {
                let (address, name) = (&self.address, channel.name);
                return Err(CorpusError::from_wrong_message(format!(
                    "{address} does not show {name}"
                )));
            };
            // Degrees and shares of a range become comparable, each in the unit of its channel.
            let unit = channel.counts_as_one;
            columns.push(column.iter().map(|value| value / unit).collect());
        }
        let measured = self.measured_frames(&columns)?;
        for column in &mut columns {
            *column = column[measured.clone()].to_vec();
        }
        let mut marks = self
            .marks
            .map(|mark| mark.clamp(measured.start, measured.end) - measured.start);
        // M3 on M2 leaves the stroke phase empty.
        if one {
            marks[2] = marks[1];
        }
        PhasedPerformance::new(&columns, marks, self.seconds)
            .map_err(|error| CorpusError::from_wrong_message(format!("{}: {error}", self.address)))
    }

    /// Returns whether the expression is short enough to be compared.
    pub(crate) fn is_comparable(&self) -> bool {
        self.marks[4] <= MAX_PERFORMANCE_FRAMES
    }

    /// Returns whether it has numbers, or would have some if it were shorter.
    pub(crate) fn shows_performance(&self) -> bool {
        !self.is_comparable() || self.columns.iter().any(Option::is_some)
    }

    fn within_length(&self) -> CorpusResult<()> {
        if self.is_comparable() {
            return Ok(());
        }
        let (address, seconds) = (&self.address, self.seconds);
        let most = MAX_PERFORMANCE_FRAMES as f64 / PERFORMANCE_RATE_FPS;
        Err(CorpusError::from_wrong_message(format!(
            "{address} lasts {seconds:.0} s, and expressions of more than {most:.0} s are not compared"
        ))
        .with_advice("annotate shorter expressions on the tier \"function\""))
    }

    /// Returns the frames in which all columns have numbers.
    fn measured_frames(&self, columns: &[Vec<f64>]) -> CorpusResult<Range<usize>> {
        let shown = |frame: &usize| columns.iter().all(|column| column[*frame].is_finite());
        let frames = 0..self.marks[4].min(columns.iter().map(Vec::len).min().unwrap_or_default());
        let first = frames.clone().find(shown).unwrap_or(frames.end);
        let end = frames.clone().rfind(shown).map_or(first, |last| last + 1);
        let (body, gaps) = (self.marks[1]..self.marks[3], first..end);
        // Onset and offset may lack frames, but gaps in the body would stretch the alignment.
        if first > body.start.min(frames.end)
            || end < body.end.min(frames.end)
            || !gaps.clone().all(|frame| shown(&frame))
        {
            let missing = frames.filter(|frame| !shown(frame)).count() as f64 / PERFORMANCE_RATE_FPS;
            return Err(CorpusError::from_wrong_message(format!(
                "{}: nothing was measured in {missing:.1} s of its {:.1} s",
                self.address, self.seconds
            ))
            .with_advice("compare an expression that its capture covers without gaps"));
        }
        Ok(gaps)
    }
}

/// Cache of the performances of a function; after a change only the recordings that it touched are read again.
#[derive(Default)]
pub(crate) struct PerformancePool {
    /// The operation after which the performances were read.
    newest: Option<i64>,
    key: Option<(ExpressionFunction, Vec<usize>)>,
    all: Arc<Vec<FacePerformance>>,
}

/// The most recordings that are read again without renewing the cache in the corpus file.
const MAX_UNCACHED_RECORDINGS: usize = 256;

impl PerformancePool {
    /// Returns every performance of a function, with the requested channels, in order of recordings.
    pub(crate) fn load_pooled_performances(
        &mut self,
        connection: &Connection,
        function: &ExpressionFunction,
        channels: &[usize],
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<Arc<Vec<FacePerformance>>> {
        let newest = stored_history::find_newest_operation(connection)?;
        let key = (function.clone(), channels.to_vec());
        // A corpus without operations has no number by which a change would show.
        if self.newest == newest && newest.is_some() && self.key.as_ref() == Some(&key) {
            return Ok(Arc::clone(&self.all));
        }
        // Taken, so that many performances are not copied.
        let before = std::mem::take(self);
        // This process's own copy is newer than the one in the file.
        let kept = match before.newest {
            Some(at) if before.key.as_ref() == Some(&key) => Some((at, Arc::unwrap_or_clone(before.all))),
            _ => shelf::read_cached_performances(connection, function, channels),
        };
        let touched = match &kept {
            Some((at, _)) => touched::recordings_since(connection, *at)?,
            None => None,
        };
        let (all, many) = match (touched, kept) {
            (Some(touched), Some((_, kept))) => {
                // Writing the file's copy again costs more than reading a few recordings.
                let many = touched.len() > MAX_UNCACHED_RECORDINGS;
                (renew_touched_performances(connection, &key, kept, &touched)?, many)
            }
            _ => (read_all(connection, &key, progress)?, true),
        };
        if let Some(newest) = newest.filter(|_| many) {
            shelf::write_cached_performances(connection, function, channels, newest, &all);
        }
        *self = Self {
            newest,
            key: Some(key),
            all: Arc::new(all),
        };
        Ok(Arc::clone(&self.all))
    }
}

/// Reads every performance of a function from its recording.
fn read_all(
    connection: &Connection,
    (function, channels): &(ExpressionFunction, Vec<usize>),
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<Vec<FacePerformance>> {
    let mut all = Vec::new();
    let fits = CorpusFits::load_corpus_fits(connection)?;
    let recordings = stored_recordings::load_recording_rows(connection)?;
    for (done, row) in recordings.iter().enumerate() {
        if done % 64 == 0 {
            progress.report_items("reading faces", done, recordings.len())?;
        }
        all.extend(load_recording_performances(connection, row, function, channels, &fits)?);
    }
    Ok(all)
}

/// Returns performances with those of the touched recordings read again.
fn renew_touched_performances(
    connection: &Connection,
    (function, channels): &(ExpressionFunction, Vec<usize>),
    kept: Vec<FacePerformance>,
    touched: &BTreeSet<i64>,
) -> CorpusResult<Vec<FacePerformance>> {
    if touched.is_empty() {
        return Ok(kept);
    }
    let mut kept = kept.into_iter().peekable();
    let mut all = Vec::with_capacity(kept.len());
    let fits = CorpusFits::load_corpus_fits(connection)?;
    // Both lists are in order of recordings, so that they are merged in one pass.
    for row in stored_recordings::load_recording_rows(connection)? {
        while let Some(it) = kept.next_if(|performance| performance.expression.recording <= row.id) {
            if !touched.contains(&it.expression.recording) {
                all.push(it);
            }
        }
        if touched.contains(&row.id) {
            all.extend(load_recording_performances(
                connection, &row, function, channels, &fits,
            )?);
        }
    }
    Ok(all)
}

fn load_recording_performances(
    connection: &Connection,
    row: &RecordingRow,
    function: &ExpressionFunction,
    channels: &[usize],
    fits: &CorpusFits,
) -> CorpusResult<Vec<FacePerformance>> {
    let expressions = expressions::load_recording_expressions(connection, row.id, Some(function), None)?;
    let mut all = Vec::new();
    for it in &expressions {
        let address = super::face_milestones::address_of(it, &expressions);
        all.extend(of_expression(connection, it, address, &row.name, channels, fits)?);
    }
    Ok(all)
}

/// Returns M1 to M5 as frames at [`PERFORMANCE_RATE_FPS`] from M1 on; `None` if there is no frame.
pub(super) fn milestone_frames(milestones: &ExpressionMilestones) -> Option<[usize; 5]> {
    let times = milestones.milestone_times();
    let frame = |at: RecordingInstant| {
        ((at.instant_seconds() - times[0].instant_seconds()) * PERFORMANCE_RATE_FPS).round() as usize
    };
    let marks = times.map(frame);
    (marks[4] > 0).then_some(marks)
}

/// Returns an expression as numbers of channels; `None` if its recording shows no face and no head. One that is too
/// long to be compared has no numbers.
pub(crate) fn of_expression(
    connection: &Connection,
    it: &FaceExpression,
    address: String,
    name: &str,
    channels: &[usize],
    fits: &CorpusFits,
) -> CorpusResult<Option<FacePerformance>> {
    let Some(marks) = milestone_frames(&it.milestones) else {
        return Ok(None);
    };
    let performance = |columns: Vec<Option<Vec<f64>>>| FacePerformance {
        expression: it.clone(),
        address,
        name: name.to_owned(),
        columns,
        marks,
        seconds: it.milestones.milestone_span().span_seconds(),
    };
    if marks[4] > MAX_PERFORMANCE_FRAMES {
        return Ok(Some(performance(vec![None; channels.len()])));
    }
    let (start, frames) = (it.milestones.milestone_times()[0], marks[4]);
    let moments: Vec<RecordingInstant> = (0..frames)
        .map(|n| RecordingInstant::from_seconds(start.instant_seconds() + n as f64 / PERFORMANCE_RATE_FPS))
        .collect();
    let Some(numbers) = sample_channel_numbers(connection, it.recording, &moments, channels, fits)? else {
        return Ok(None);
    };
    let shown = |column: &Vec<f64>| column.iter().any(|value| value.is_finite());
    let columns = numbers.into_iter().map(|column| column.filter(shown));
    Ok(Some(performance(columns.collect())))
}

/// Returns numbers of channels of a recording at moments of its clock: degrees for head and trunk, the face's own
/// numbers otherwise. Where the capture measured nothing they are no number.
pub(crate) fn sample_channel_numbers(
    connection: &Connection,
    recording: i64,
    moments: &[RecordingInstant],
    channels: &[usize],
    fits: &CorpusFits,
) -> CorpusResult<Option<Vec<Option<Vec<f64>>>>> {
    let (Some(first), Some(last)) = (moments.first(), moments.last()) else {
        return Ok(None);
    };
    // The frames beside the first and the last moment are needed to blend with.
    let around = TimeSpan::span_between(
        first.shifted_instant(-PERFORMANCE_MARGIN_US),
        last.shifted_instant(PERFORMANCE_MARGIN_US),
    );
    // Only the whole capture shows whether a head was recorded at all.
    let captured = captured_with(connection, recording, None, fits)?;
    let body = match stored_recordings::body_track(connection, recording)? {
        Some(_) => Some(MotionTrack::open_motion_track(connection, recording)?),
        None => None,
    };
    // The skeleton's own head says more than a face's; it is read only if a channel needs it.
    let mut turned = match &body {
        Some(track) if channels.iter().any(|at| *at < 3 || *at >= FIRST_TRUNK_INDEX) => {
            load_turns_at_moments(connection, track, around, moments)?
        }
        _ => HeadTrunkTurns::default(),
    };
    // A captured face hides the one that a recipe made.
    let made = match &body {
        Some(track) if captured.is_none() => of_recipe(connection, track, around, moments)?,
        _ => None,
    };
    let seen: Option<Vec<_>> = captured
        .as_ref()
        .map(|face| moments.iter().map(|at| face.blended_face_at(*at)).collect());
    let measured: Vec<bool> = match &captured {
        Some(face) => moments.iter().map(|at| face.is_measured_at(*at)).collect(),
        None => Vec::new(),
    };
    // A face is blended across gaps so that it can be drawn; whoever compares must not take that for
    // measured.
    let unmeasured = |frame: usize, number: f64| match measured.get(frame) {
        Some(false) => f64::NAN,
        _ => number,
    };
    if let Some(face) = &captured {
        turned.head = turned.head.or_else(|| {
            let seen = seen.as_ref()?.iter().enumerate();
            seen.map(|(frame, (_, head))| Some((*head)?.map(|turn| unmeasured(frame, turn))))
                .collect()
        });
        turned.trunk = turned.trunk.or_else(|| {
            let trunk = moments.iter().map(|at| face.trunk_at(*at)).enumerate();
            trunk
                .map(|(frame, turn)| Some(turn?.map(|turn| unmeasured(frame, turn))))
                .collect()
        });
    }
    let shows = turned.head.is_some() || turned.trunk.is_some();
    if !shows && seen.is_none() && made.is_none() {
        return Ok(None);
    }
    let degrees = |turns: &Option<Vec<[f64; 3]>>, axis: usize| {
        let all = turns.as_ref()?;
        Some(all.iter().map(|turn| turn[axis].to_degrees()).collect())
    };
    let column = |at: &usize| -> Option<Vec<f64>> {
        let number = match *at {
            at @ 0..3 => return degrees(&turned.head, at),
            at if at >= FIRST_TRUNK_INDEX => return degrees(&turned.trunk, at - FIRST_TRUNK_INDEX),
            at => at - 3,
        };
        match (&captured, &seen, &made) {
            (Some(face), Some(seen), _) if face.view.known[number] => {
                let face_numbers = seen.iter().map(|(face, _)| face.face_numbers()[number]);
                let numbers = face_numbers.enumerate();
                Some(numbers.map(|(frame, it)| unmeasured(frame, it)).collect())
            }
            (None, _, Some(made)) => Some(made.iter().map(|face| face.face_numbers()[number]).collect()),
            _ => None,
        }
    };
    Ok(Some(channels.iter().map(column).collect()))
}

/// Returns whether a movement was captured at a moment: a frame lasts until the next one.
fn is_captured_at(track: &MotionTrack, at: RecordingInstant) -> bool {
    let frame_place = at.shifted_instant(-track.row.offset_us).instant_seconds() * track.rate.per_second();
    // Half a frame before the first still rounds to it; after the last, a frame lasts its whole length.
    frame_place > -0.5 && frame_place < track.motion_frame_count() as f64 + NEAR_FRAME
}

/// Returns the frame of a track within a span that is nearest to a moment.
fn nearest_track_frame(track: &MotionTrack, frames: &Range<usize>, at: RecordingInstant) -> usize {
    let frame_place = at.shifted_instant(-track.row.offset_us).instant_seconds() * track.rate.per_second();
    let last = frames.end.saturating_sub(1).max(frames.start);
    (frame_place.round().max(0.0) as usize).clamp(frames.start, last)
}

/// Returns the rotations of head and trunk of a skeleton at moments; no numbers before its first frame and after its last.
fn load_turns_at_moments(
    connection: &Connection,
    track: &MotionTrack,
    around: TimeSpan,
    moments: &[RecordingInstant],
) -> CorpusResult<HeadTrunkTurns> {
    let frames = track.frames_in(around);
    if frames.is_empty() {
        return Ok(HeadTrunkTurns::default());
    }
    let groups = [ChannelGroup::Head, ChannelGroup::Rest];
    let clip = track.read_motion_clip(connection, frames.clone(), &groups)?;
    let all = face_head::of_clip(&clip, &track.track_anatomy(connection)?);
    let at_moments = |all: Vec<[f64; 3]>| {
        let turn_at = |at: &RecordingInstant| match is_captured_at(track, *at) {
            true => all[nearest_track_frame(track, &frames, *at) - frames.start],
            false => [f64::NAN; 3],
        };
        moments.iter().map(turn_at).collect()
    };
    Ok(HeadTrunkTurns {
        head: all.head.map(at_moments),
        trunk: all.trunk.map(at_moments),
    })
}

/// Returns the face generated by a recipe, at moments.
fn of_recipe(
    connection: &Connection,
    track: &MotionTrack,
    around: TimeSpan,
    moments: &[RecordingInstant],
) -> CorpusResult<Option<Vec<FacePosture>>> {
    let frames = track.frames_in(around);
    if frames.is_empty() {
        return Ok(None);
    }
    // The whole track is read because frames are numbered from its start.
    let all_faces = faces_from_curves(&curves::of_track(connection, track, 0..track.motion_frame_count())?);
    let of = |at: &RecordingInstant| all_faces.get(nearest_track_frame(track, &frames, *at)).copied();
    let all = moments.iter().map(|at| of(at).unwrap_or_default());
    Ok((!all_faces.is_empty()).then(|| all.collect()))
}
