//! Finds the position of one track on another track's clock from movement that both show.

use chereme_analysis::align::{self, Signal as Samples};
use chereme_motion::anatomy::Part;
use chereme_motion::glam::DVec3;
use chereme_motion::{Curves, Markers, Side};
use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::Serialize;

use super::change::named;
use super::{SkeletonTrack, Track, TrackRow, read};
use crate::Corpus;
use crate::address::{self, Name};
use crate::db::tracks;
use crate::error::{Error, Result};

/// The part of a track that is compared.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signal {
    /// The track's name.
    pub track: String,
    /// Names of joints, points or curves; by default the wrists, or every channel if no wrist is known.
    pub channels: Vec<String>,
}

impl Signal {
    /// Returns the signal of a track's wrists.
    #[must_use]
    pub fn of(track: impl Into<String>) -> Self {
        Self {
            track: track.into(),
            channels: Vec::new(),
        }
    }
}

/// The position of a track on the recording's clock, inferred from its movement.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Alignment {
    /// The track that would be moved.
    pub track: String,
    /// The track that it is compared with.
    pub to: String,
    /// The compared channels of the two tracks.
    pub channels: [Vec<String>; 2],
    /// Its present offset on the recording's clock, in microseconds.
    pub offset_now_us: i64,
    /// The offset on the recording's clock at which the two speeds are most alike, in microseconds.
    pub offset_us: i64,
    /// The correlation of the two speeds at `offset_us`, at most 1.
    pub correlation: f64,
    /// The best correlation at any offset away from `offset_us`.
    pub runner_up: f64,
    /// Confidence in the offset, from 0 to 1; below 0.5 a person should look at both tracks before using it.
    pub confidence: f64,
}

impl Corpus {
    /// Finds the position of a track on the clock of another track of its recording: the offset at which their speeds,
    /// such as those of a wrist, are most alike. Changes nothing.
    ///
    /// `limit_us` is the largest distance from its present offset.
    ///
    /// # Errors
    /// Fails if there is no such track or channel, or the two share no movement.
    pub fn align_track(
        &self,
        recording: &Name,
        track: &Signal,
        to: &Signal,
        limit_us: i64,
    ) -> Result<Alignment> {
        let connection = self.store.read();
        let row = address::recording(connection, recording)?;
        let all = tracks::tracks(connection, row.id)?;
        let own = named(&all, &row.name, &track.track)?;
        let other = named(&all, &row.name, &to.track)?;
        let (moved, moved_names) = signal(connection, own, &track.channels)?;
        let (still, still_names) = signal(connection, other, &to.channels)?;
        let limit = limit_us as f64 / 1e6;
        let shift = align::shift(&still, &moved, limit).ok_or_else(|| {
            Error::wrong(format!(
                "{:?} and {:?} share no movement that could bring them together",
                own.name, other.name
            ))
            .at(&own.name)
            .advise("name a joint, point or curve that moves in both, or set the offset by hand")
        })?;
        Ok(Alignment {
            track: own.name.clone(),
            to: other.name.clone(),
            channels: [moved_names, still_names],
            offset_now_us: own.offset_us,
            offset_us: own.offset_us + (shift.seconds * 1e6).round() as i64,
            correlation: shift.correlation,
            runner_up: shift.runner_up,
            confidence: shift.confidence(),
        })
    }
}

/// Returns the mean speed of a track's channels over time on the recording's clock, and their names.
fn signal(
    connection: &Connection,
    row: &TrackRow,
    wanted: &[String],
) -> Result<(Samples, Vec<String>)> {
    let (paths, names) = match read::track(connection, row, None)? {
        Track::Skeleton(skeleton) => of_skeleton(&skeleton, wanted)?,
        Track::Markers(markers) => of_markers(&markers, wanted)?,
        Track::Curves(curves) => of_curves(&curves, wanted)?,
        Track::Media(_) => {
            return Err(Error::wrong(format!("{:?} is a file of media", row.name))
                .at(&row.name)
                .advise("compare a track of points that were estimated from it"));
        }
    };
    let mut points = Vec::new();
    for frame in 1..paths.times.len() {
        let (from, to) = (paths.times[frame - 1], paths.times[frame]);
        let speeds: Vec<f64> = paths
            .places
            .iter()
            .filter_map(|path| Some(path[frame]?.distance(path[frame - 1]?) / (to - from)))
            .collect();
        if !speeds.is_empty() && to > from {
            let speed = speeds.iter().sum::<f64>() / speeds.len() as f64;
            points.push(((from + to) / 2.0 + row.offset_us as f64 / 1e6, speed));
        }
    }
    Ok((Samples { points }, names))
}

/// Positions by channel and frame, and the time of each frame.
struct Paths {
    times: Vec<f64>,
    places: Vec<Vec<Option<DVec3>>>,
}

fn unknown(wanted: &str, names: &[String]) -> Error {
    let near = chereme_sign::text::nearest(wanted, names.iter().map(String::as_str));
    let near = chereme_sign::text::did_you_mean(near);
    Error::wrong(format!("the track has no {wanted:?}{near}"))
        .at(wanted)
        .advise(Remedy::command(
            "`chereme list CORPUS tracks` lists tracks; export one as .csv to see its channels",
        ))
}

/// Returns the indices of the wanted names; those of `usual` if none is wanted, or all.
fn chosen(names: &[String], wanted: &[String], usual: Vec<usize>) -> Result<Vec<usize>> {
    if wanted.is_empty() {
        return Ok(if usual.is_empty() {
            (0..names.len()).collect()
        } else {
            usual
        });
    }
    let find = |name: &String| {
        let found = names.iter().position(|it| it.eq_ignore_ascii_case(name));
        found.ok_or_else(|| unknown(name, names))
    };
    wanted.iter().map(find).collect()
}

fn of_skeleton(track: &SkeletonTrack, wanted: &[String]) -> Result<(Paths, Vec<String>)> {
    let clip = track.convention.clip(&track.clip);
    let joints = clip.skeleton().joints().iter();
    let names: Vec<String> = joints.map(|joint| joint.name.clone()).collect();
    let roles = track.roles.clone().unwrap_or_default();
    let anatomy = chereme_motion::Anatomy::with_roles(clip.skeleton(), &roles).ok();
    let wrists = anatomy.map(|anatomy| {
        let sides = Side::BOTH.iter();
        sides
            .filter_map(|side| anatomy.joint(Part::Hand(*side)))
            .collect()
    });
    let chosen = chosen(&names, wanted, wrists.unwrap_or_default())?;
    let path = |joint: &usize| clip.path(*joint).into_iter().map(Some).collect();
    let paths = Paths {
        times: (0..clip.frames())
            .map(|n| clip.rate().instant(n).seconds())
            .collect(),
        places: chosen.iter().map(path).collect(),
    };
    Ok((
        paths,
        chosen.into_iter().map(|at| names[at].clone()).collect(),
    ))
}

fn of_markers(markers: &Markers, wanted: &[String]) -> Result<(Paths, Vec<String>)> {
    let points = markers.points();
    let names: Vec<String> = points.iter().map(|point| point.name.clone()).collect();
    let wrists = (0..points.len())
        .filter(|&at| is_wrist(&names[at]))
        .collect();
    let chosen = chosen(&names, wanted, wrists)?;
    let frames = 0..markers.frames();
    let place =
        |point: usize, frame: usize| points[point].at(frame).map(|at| markers.space().shown(at));
    let paths = Paths {
        times: frames
            .clone()
            .map(|n| markers.times().instant(n).seconds())
            .collect(),
        places: chosen
            .iter()
            .map(|&point| frames.clone().map(|frame| place(point, frame)).collect())
            .collect(),
    };
    Ok((
        paths,
        chosen.into_iter().map(|at| names[at].clone()).collect(),
    ))
}

/// Returns whether a point is a wrist by its name: `LWRA`, `TakeoMonday:RWRB`, `RIGHT_WRIST`, `R.Wrist`.
fn is_wrist(name: &str) -> bool {
    let name = name.rsplit(':').next().unwrap_or(name).to_ascii_uppercase();
    let plug_in = ["LWRA", "LWRB", "RWRA", "RWRB", "LWRI", "RWRI"];
    name.contains("WRIST") || plug_in.contains(&name.as_str())
}

fn of_curves(curves: &Curves, wanted: &[String]) -> Result<(Paths, Vec<String>)> {
    let all = curves.curves();
    let names: Vec<String> = all.iter().map(|curve| curve.name.clone()).collect();
    let chosen = chosen(&names, wanted, Vec::new())?;
    let value = |at: &usize| {
        let values = all[*at].values.values();
        values
            .map(|value| value.map(|value| DVec3::new(value, 0.0, 0.0)))
            .collect()
    };
    let paths = Paths {
        times: (0..curves.frames())
            .map(|n| curves.times().instant(n).seconds())
            .collect(),
        places: chosen.iter().map(value).collect(),
    };
    Ok((
        paths,
        chosen.into_iter().map(|at| names[at].clone()).collect(),
    ))
}
