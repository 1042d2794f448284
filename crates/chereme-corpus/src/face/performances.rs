//! Expressions as numbers at one rate, cut into phases, kept while the corpus does not change.

use std::sync::Arc;

use chereme_analysis::phases::Phased;
use chereme_compose::faces;
use chereme_motion::{Face, Instant, Span};
use chereme_sign::milestones::Function;
use rusqlite::Connection;
use serde::Serialize;

use super::expressions::{self, Expression};
use super::{captured, head};
use crate::curves;
use crate::db::{history, recordings};
use crate::error::{Error, Result};
use crate::movement::{ChannelGroup, Track};
use crate::progress::{Progress, Step, Unit};

/// Frames a second at which performances are compared; the window of 10 frames is then a third of a second.
pub(crate) const RATE: f64 = 30.0;
/// Performances with more frames than this are cut short of comparison.
const LONGEST: usize = 3_600;

/// A channel by which performances are compared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FaceChannel {
    /// The name, one of [`Face::NAMES`], or `head_pitch`, `head_yaw`, `head_roll`.
    pub name: &'static str,
    /// What counts as 1: of head turns degrees, else a share of the usual reach.
    pub counts_as_one: f64,
    /// Whether it is compared if nothing else is asked for.
    pub usual: bool,
}

/// The channels, those that the paper compares first: head, brows, and brows drawn together.
pub const CHANNELS: [FaceChannel; 24] = {
    const fn channel(name: &'static str, counts_as_one: f64, usual: bool) -> FaceChannel {
        FaceChannel {
            name,
            counts_as_one,
            usual,
        }
    }
    let mut all = [channel("head_pitch", 10.0, true); 24];
    all[1] = channel("head_yaw", 10.0, true);
    all[2] = channel("head_roll", 10.0, true);
    let mut at = 0;
    while at < Face::LEN {
        all[at + 3] = channel(Face::NAMES[at], 0.25, at < 3);
        at += 1;
    }
    all
};

/// A performance as numbers.
#[derive(Debug, Clone)]
pub(crate) struct Performance {
    pub(crate) expression: Expression,
    /// The address by which it is named.
    pub(crate) address: String,
    /// The recording's name.
    pub(crate) name: String,
    /// Numbers of the asked channels at [`RATE`] from M1 on; `None` if unknown.
    pub(crate) columns: Vec<Option<Vec<f64>>>,
    /// M1 to M5 in frames.
    pub(crate) marks: [usize; 5],
    /// From M1 to M5.
    pub(crate) seconds: f64,
}

impl Performance {
    /// Returns it cut into phases: `use_of` are places in its columns, which are of the channels `asked`, each in units that
    /// count as 1; `one` takes its body as one phase.
    pub(crate) fn phased_of(&self, asked: &[usize], use_of: &[usize], one: bool) -> Result<Phased> {
        let mut columns = Vec::with_capacity(use_of.len());
        for &at in use_of {
            let channel = CHANNELS[asked[at]];
            let Some(column) = &self.columns[at] else {
                let (address, name) = (&self.address, channel.name);
                return Err(Error::wrong(format!("{address} does not show {name}")));
            };
            let unit = channel.counts_as_one;
            columns.push(column.iter().map(|value| value / unit).collect());
        }
        let mut marks = self.marks;
        if one {
            marks[2] = marks[1];
        }
        Phased::new(&columns, marks, self.seconds)
            .map_err(|error| Error::wrong(format!("{}: {error}", self.address)))
    }
}

/// The performances of a function, as they were after an operation.
#[derive(Default)]
pub(crate) struct Pool {
    newest: Option<i64>,
    key: Option<(Function, Vec<usize>)>,
    all: Arc<Vec<Performance>>,
}

impl Pool {
    /// Returns every performance of a function, with the asked channels, in order of recordings.
    pub(crate) fn of(
        &mut self,
        connection: &Connection,
        function: &Function,
        channels: &[usize],
        progress: &mut Progress<'_>,
    ) -> Result<Arc<Vec<Performance>>> {
        let newest = history::newest(connection)?;
        let key = (function.clone(), channels.to_vec());
        if self.newest == newest && newest.is_some() && self.key.as_ref() == Some(&key) {
            return Ok(Arc::clone(&self.all));
        }
        let mut all = Vec::new();
        let recordings = recordings::recordings(connection)?;
        for (done, row) in recordings.iter().enumerate() {
            if done % 64 == 0 {
                progress.tell(Step {
                    task: "reading faces",
                    done: done as u64,
                    total: Some(recordings.len() as u64),
                    unit: Unit::Items,
                })?;
            }
            let found = expressions::of_recording(connection, row.id, Some(function), None)?;
            for it in &found {
                let address = super::milestones::address_of(it, &found);
                all.extend(of_expression(connection, it, address, &row.name, channels)?);
            }
        }
        *self = Self {
            newest,
            key: Some(key),
            all: Arc::new(all),
        };
        Ok(Arc::clone(&self.all))
    }
}

/// Returns an expression as numbers of channels; `None` if its recording shows no face and no head.
pub(crate) fn of_expression(
    connection: &Connection,
    it: &Expression,
    address: String,
    name: &str,
    channels: &[usize],
) -> Result<Option<Performance>> {
    let times = it.milestones.times();
    let start = times[0];
    let frame = |at: Instant| ((at.seconds() - start.seconds()) * RATE).round() as usize;
    let marks = times.map(frame);
    let frames = marks[4];
    if frames == 0 || frames > LONGEST {
        return Ok(None);
    }
    let moments: Vec<Instant> = (0..frames)
        .map(|n| Instant::from_seconds(start.seconds() + n as f64 / RATE))
        .collect();
    let Some(numbers) = numbers(connection, it.recording, &moments, channels)? else {
        return Ok(None);
    };
    Ok(Some(Performance {
        expression: it.clone(),
        address,
        name: name.to_owned(),
        columns: numbers,
        marks,
        seconds: it.milestones.span().seconds(),
    }))
}

/// Returns numbers of channels of a recording at moments of its clock: in degrees of the head, as they are of the face.
pub(crate) fn numbers(
    connection: &Connection,
    recording: i64,
    moments: &[Instant],
    channels: &[usize],
) -> Result<Option<Vec<Option<Vec<f64>>>>> {
    let (Some(first), Some(last)) = (moments.first(), moments.last()) else {
        return Ok(None);
    };
    let captured = captured(connection, recording, None)?;
    let body = match recordings::body_track(connection, recording)? {
        Some(_) => Some(Track::of(connection, recording)?),
        None => None,
    };
    let needs_head = channels.iter().any(|at| *at < 3);
    let mut turns: Option<Vec<[f64; 3]>> = None;
    let mut made: Option<Vec<Face>> = None;
    if let Some(track) = &body {
        let around = Span::between(first.shifted(-100_000), last.shifted(100_000));
        let frames = track.frames_in(around);
        let nearest = |at: Instant| {
            let own = at.shifted(-track.row.offset_us).seconds() * track.rate.per_second();
            let last = frames.end.saturating_sub(1).max(frames.start);
            (own.round().max(0.0) as usize).clamp(frames.start, last) - frames.start
        };
        if needs_head && !frames.is_empty() {
            let clip = track.clip(
                connection,
                frames.clone(),
                &[ChannelGroup::Head, ChannelGroup::Rest],
            )?;
            let all = head::of_clip(&clip, &track.anatomy(connection)?);
            turns = all.map(|all| moments.iter().map(|at| all[nearest(*at)]).collect());
        }
        if captured.is_none() && !frames.is_empty() {
            let whole = faces(&curves::of_track(connection, track, 0..track.frames())?);
            let of = |at: &Instant| whole.get(nearest(*at) + frames.start).copied();
            made = (!whole.is_empty()).then(|| {
                moments
                    .iter()
                    .map(|at| of(at).unwrap_or_default())
                    .collect()
            });
        }
    }
    let seen: Option<Vec<_>> = captured
        .as_ref()
        .map(|face| moments.iter().map(|at| face.at(*at)).collect());
    if turns.is_none()
        && let Some(seen) = &seen
    {
        turns = seen.iter().map(|(_, head)| *head).collect();
    }
    if turns.is_none() && seen.is_none() && made.is_none() {
        return Ok(None);
    }
    let column = |at: &usize| -> Option<Vec<f64>> {
        let Some(number) = at.checked_sub(3) else {
            return Some(
                turns
                    .as_ref()?
                    .iter()
                    .map(|turn| turn[*at].to_degrees())
                    .collect(),
            );
        };
        match (&captured, &seen, &made) {
            (Some(face), Some(seen), _) if face.view.known[number] => Some(
                seen.iter()
                    .map(|(face, _)| face.numbers()[number])
                    .collect(),
            ),
            (None, _, Some(made)) => Some(made.iter().map(|face| face.numbers()[number]).collect()),
            _ => None,
        }
    };
    Ok(Some(channels.iter().map(column).collect()))
}
