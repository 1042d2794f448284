//! The captured face of a recording: channels of a face system, or points of a face on film.

use chereme_compose::{Curve, NUMBER};
use chereme_formats::faces::{FaceMesh, Measures, System, View};
use chereme_motion::{Face, Instant, Span, Times};
use rusqlite::Connection;

use super::Fits;
use crate::db::tracks::{self, TrackKind, TrackRow};
use crate::db::upgrade::NONMANUALS;
use crate::error::Result;
use crate::track;

/// The number of frames of points that are read at once.
const PIECE: usize = 4_096;
/// The largest number of frames of points that are read as a face.
const LONGEST: usize = 1_000_000;

/// The height of the head above the hips, in metres: the lever by which a leaning trunk moves it.
const TRUNK: f64 = 0.65;

/// The captured face of a recording.
pub(crate) struct Captured {
    pub(crate) row: TrackRow,
    pub(crate) times: Times,
    pub(crate) view: View,
    /// The recording of the take on which the weights were fitted.
    pub(crate) fitted: Option<i64>,
    /// The mean position of the head.
    usual_place: Option<[f64; 3]>,
    steps: Steps,
}

/// The times between the frames of a capture, in microseconds.
#[derive(Debug, Clone, Copy)]
struct Steps {
    usual: i64,
    /// The longest one that is no gap.
    longest: i64,
}

impl Steps {
    fn of(times: &Times, frames: usize) -> Self {
        Self {
            usual: times.usual_step(frames),
            longest: times.longest_step(frames),
        }
    }
}

/// Returns the captured face of a recording, complete or in the frames within a span of the recording's clock: the
/// first track of curves in a face system, otherwise the first track of points with a face. Curves that a recipe
/// generated do not count.
pub(crate) fn captured(
    connection: &Connection,
    recording: i64,
    span: Option<Span>,
) -> Result<Option<Captured>> {
    captured_with(connection, recording, span, &Fits::of(connection)?)
}

/// Returns the captured face as [`captured`] does, with fitted weights that were looked up before.
pub(crate) fn captured_with(
    connection: &Connection,
    recording: i64,
    span: Option<Span>,
    fits: &Fits,
) -> Result<Option<Captured>> {
    let all = tracks::tracks(connection, recording)?;
    for row in &all {
        if row.kind != TrackKind::Curves || row.name == NONMANUALS {
            continue;
        }
        let channels = tracks::channels(connection, row.id)?;
        let names = channels.iter().map(|channel| channel.name.as_str());
        let Some(system) = System::of_names(names).filter(|system| !system.expressions) else {
            continue;
        };
        let mut row = row.clone();
        let curves = track::read::curves(connection, &row, span)?;
        if let (Some(span), Some(rate)) = (span, row.rate) {
            // In a part at an even rate, times count from its first frame.
            let count = usize::try_from(row.frames.unwrap_or_default()).unwrap_or(usize::MAX);
            let skipped = Times::Even(rate).frames_in(span.shifted(-row.offset_us), count);
            let moved = rate.instant(skipped.start).micros();
            row.offset_us = row.offset_us.saturating_add(moved);
        }
        let mut view = system.view(&curves);
        let fitted = fits.apply(recording, &mut view);
        return Ok(Some(Captured {
            steps: Steps::of(curves.times(), view.faces.len()),
            times: curves.times().clone(),
            usual_place: usual_place(&view),
            view,
            row,
            fitted,
        }));
    }
    for row in all {
        if row.kind == TrackKind::Markers
            && let Some(found) = of_points(connection, recording, row, fits)?
        {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Returns the face from a track of points; `None` if the points contain no face.
fn of_points(
    connection: &Connection,
    recording: i64,
    row: TrackRow,
    fits: &Fits,
) -> Result<Option<Captured>> {
    let channels = tracks::channels(connection, row.id)?;
    let named = channels
        .iter()
        .map(|it| (it.part.as_str(), it.name.as_str()));
    let Some(mesh) = FaceMesh::find(named) else {
        return Ok(None);
    };
    let count = usize::try_from(row.frames.unwrap_or_default()).unwrap_or(usize::MAX);
    let Some(system) = System::named("mesh").filter(|_| count <= LONGEST) else {
        return Ok(None);
    };
    let mut measured: Vec<Measures> = Vec::new();
    let times = match row.rate {
        Some(rate) => {
            while measured.len() < count {
                let part = measured.len()..count.min(measured.len() + PIECE);
                let span = rate.span(part.clone()).shifted(row.offset_us);
                let points = track::read::markers(connection, &row, Some(span))?;
                let more = mesh.measure(&points);
                if more.is_empty() {
                    break;
                }
                measured.extend(more.into_iter().take(part.len()));
            }
            Times::Even(rate)
        }
        None => {
            let points = track::read::markers(connection, &row, None)?;
            measured = mesh.measure(&points);
            points.times().clone()
        }
    };
    let Ok(curves) = FaceMesh::curves(times.clone(), &measured) else {
        return Ok(None);
    };
    let mut view = system.view(&curves);
    if !view.known.iter().any(|known| *known) {
        return Ok(None);
    }
    let fitted = fits.apply(recording, &mut view);
    Ok(Some(Captured {
        steps: Steps::of(&times, view.faces.len()),
        usual_place: None,
        row,
        times,
        view,
        fitted,
    }))
}

/// Returns the mean position of a head.
fn usual_place(view: &View) -> Option<[f64; 3]> {
    let places = view.place.as_ref().filter(|all| !all.is_empty())?;
    let middle = |axis: usize| {
        let sum: f64 = places.iter().map(|at| at[axis]).sum();
        sum / places.len() as f64
    };
    Some(std::array::from_fn(middle))
}

impl Captured {
    /// Returns the moments of the frames on the recording's clock.
    pub(crate) fn moments(&self) -> impl Iterator<Item = Instant> + '_ {
        let frames = 0..self.view.faces.len();
        frames.map(|frame| self.times.instant(frame).shifted(self.row.offset_us))
    }

    /// Returns the usual and the longest time between two frames without a gap, in microseconds.
    pub(crate) fn steps(&self) -> (i64, i64) {
        (self.steps.usual, self.steps.longest)
    }

    /// Returns whether the face was measured at a moment of the recording's clock: within half a usual step of a frame,
    /// or between two frames without a gap.
    pub(crate) fn is_measured_at(&self, moment: Instant) -> bool {
        let own = moment.shifted(-self.row.offset_us);
        let count = self.view.faces.len();
        let Some(before) = self.times.frame_at(own, count) else {
            return false;
        };
        // Moments are rounded to microseconds.
        let near = self.steps.usual / 2 + 1;
        let at = |frame: usize| self.times.instant(frame).micros();
        let (own, first) = (own.micros(), at(before));
        if (own - first).abs() <= near {
            return true;
        }
        let next = before + 1;
        own > first && next < count && {
            at(next) - own <= near || at(next) - first <= self.steps.longest
        }
    }

    /// Returns the rotation of the trunk at a moment, in radians, estimated from the position of the head: a leaning
    /// trunk moves the head forward and sideways. `None` if the capture has no position of the head.
    pub(crate) fn trunk_at(&self, moment: Instant) -> Option<[f64; 3]> {
        let places = self.view.place.as_ref()?;
        let (first, second, share) = self.place_of(moment);
        let (a, b) = (places.get(first)?, places.get(second)?);
        let usual = self.usual_place?;
        let [left, _, forward] = std::array::from_fn(|n| a[n] + (b[n] - a[n]) * share - usual[n]);
        let turn = |away: f64| (away / TRUNK).clamp(-0.7, 0.7).asin();
        Some([turn(forward), 0.0, -turn(left)])
    }

    /// Returns the two frames around a moment of the recording's clock, and the share of the way from the first to the
    /// second.
    fn place_of(&self, moment: Instant) -> (usize, usize, f64) {
        let own = moment.shifted(-self.row.offset_us).seconds();
        let last = self.view.faces.len().saturating_sub(1);
        let at = match self.times.rate() {
            Some(rate) => (own * rate.per_second()).clamp(0.0, last as f64),
            None => self.listed(own, last),
        };
        let first = at.floor() as usize;
        (first, (first + 1).min(last), at.fract())
    }

    /// Returns the face, its known numbers and the rotation of the head at a moment of the recording's clock, blended
    /// between frames, also across gaps; before the first frame and after the last one those of the nearest frame. So a
    /// face can be drawn at any time: whoever measures asks [`is_measured_at`](Self::is_measured_at) as well.
    pub(crate) fn at(&self, moment: Instant) -> (Face, Option<[f64; 3]>) {
        let (first, second, share) = self.place_of(moment);
        let face = match self.view.faces.get(first) {
            Some(face) if share == 0.0 => *face,
            Some(face) => face.towards(&self.view.faces[second], share),
            None => Face::default(),
        };
        let head = self.view.head.as_ref().and_then(|all| {
            let (a, b) = (all.get(first)?, all.get(second)?);
            Some(std::array::from_fn(|n| a[n] + (b[n] - a[n]) * share))
        });
        (face, head)
    }

    fn listed(&self, seconds: f64, last: usize) -> f64 {
        let at = |frame: usize| self.times.instant(frame).seconds();
        let moment = Instant::from_seconds(seconds);
        let first = self.times.frame_at(moment, last + 1).unwrap_or(0).min(last);
        let second = (first + 1).min(last);
        let share = (seconds - at(first)) / (at(second) - at(first));
        first as f64
            + if share.is_nan() {
                0.0
            } else {
                share.clamp(0.0, 1.0)
            }
    }

    /// Returns a curve for each number of the capture, at these moments of the recording's clock.
    pub(crate) fn curves(&self, moments: impl Iterator<Item = Instant>) -> Vec<Curve> {
        let faces: Vec<[f64; Face::LEN]> = moments.map(|at| self.at(at).0.numbers()).collect();
        let known = Face::NAMES
            .iter()
            .enumerate()
            .filter(|(n, _)| self.view.known[*n]);
        known
            .map(|(n, name)| Curve {
                name: format!("{NUMBER}{name}"),
                values: faces.iter().map(|numbers| numbers[n]).collect(),
            })
            .collect()
    }
}
