//! Stores the tracks of a file in the recording that they belong to.

use super::report::ReportFinding;
use super::understood::TrackRead;
use super::{FileReport, Job, bvh, clock};
use crate::db::recordings;
use crate::db::tracks;
use crate::error::Result;
use crate::movement::{self, BLOCK_FRAMES};
use crate::track::{NewTrack, Track, store};
use chereme_motion::{
    Anatomy, Clip, Column, Convention, Instant, Marker, Markers, Rate, Skeleton, Space, Times,
};
use chereme_sign::Remedy;

/// Stores the tracks of a file and returns their recording: the one that the caller named, the one of the files with
/// this folder and stem, or a new one. Adds a line for each track to the report, and the caller's offset to each track.
///
/// The reader stores the file itself ([`Job::keep`]) and reports its oddities.
pub(super) fn store(job: &mut Job<'_>, new: Vec<NewTrack>, report: &mut FileReport) -> Result<i64> {
    let same_take = job.beside().filter(|_| job.options.into.is_none());
    let given = job.options.clock.map(Instant::micros);
    let day = |track: &NewTrack| {
        let start = track.clock_us.or(given)?;
        Some(start..start.saturating_add(length_us(&track.track)))
    };
    let days: Vec<_> = new.iter().filter_map(day).collect();
    let recording = match same_take {
        Some(recording) => recording,
        None => match clock::take_of(job, &days, report)? {
            Some(recording) => recording,
            None => match folder_take(job, &new)? {
                Some(recording) => {
                    report_folder(job, recording, report)?;
                    recording
                }
                None => {
                    let lengths = new.iter().map(|track| length_us(&track.track));
                    bvh::insert_recording(job, lengths.max(), report)?
                }
            },
        },
    };
    for track in &new {
        report.findings.extend(gaps(&track.track));
    }
    let mut ids = Vec::with_capacity(new.len());
    for mut track in new {
        track.offset_us = track.offset_us.saturating_add(job.options.offset_us);
        track.clock_us = track.clock_us.or(given);
        ids.push(store::store(job.connection, recording, &track)?);
    }
    clock::place(job, recording, &ids, report)?;
    job.count("tracks", ids.len());
    let shown = |id: &i64| -> Result<TrackRead> {
        let (row, form) = (
            tracks::track(job.connection, *id)?,
            tracks::form(job.connection, *id)?,
        );
        Ok(TrackRead {
            kind: row.kind,
            name: row.name,
            rate: row.rate.map(chereme_motion::Rate::per_second),
            frames: row.frames,
            offset_us: row.offset_us,
            duration_us: row.duration_us,
            channels: row.channels,
            metres_per_unit: form.metres_per_unit,
            axes: form.axes,
        })
    };
    report.recording = Some(recordings::recording(job.connection, recording)?.name);
    report.understood.tracks = Some(ids.iter().map(shown).collect::<Result<_>>()?);
    Ok(recording)
}

/// Returns a finding about the gaps between rows of curves; `None` without any.
fn gaps(track: &Track) -> Option<ReportFinding> {
    let Track::Curves(curves) = track else {
        return None;
    };
    let gaps = curves.times().gaps(curves.frames());
    let longest = gaps.iter().max_by_key(|gap| gap.micros())?;
    let total = gaps.iter().map(|gap| gap.seconds()).sum::<f64>();
    Some(ReportFinding::warning(
        format!(
            "gaps in its rows: {}, {total:.3} s in all, the longest after {:.3} s; nothing counts as measured there",
            gaps.len(),
            longest.start().seconds()
        ),
        "export it again if the gaps are not in the recording itself",
    ))
}

/// The largest ratio of lengths of two tracks in a folder that are taken for one take.
const LONGER: i64 = 2;

/// Returns the recording of the only motion file in the folder, if its length is similar to that of the tracks.
fn folder_take(job: &Job<'_>, new: &[NewTrack]) -> Result<Option<i64>> {
    let Some(recording) = job.folder_take.filter(|_| job.options.into.is_none()) else {
        return Ok(None);
    };
    let own = new.iter().map(|track| length_us(&track.track)).max();
    let own = own.unwrap_or_default();
    let theirs = recordings::recording(job.connection, recording)?.duration_us;
    let alike = own <= theirs.saturating_mul(LONGER) && theirs <= own.saturating_mul(LONGER);
    Ok(Some(recording).filter(|_| alike))
}

/// Reports that a file was assigned to the take of its folder.
fn report_folder(job: &Job<'_>, recording: i64, report: &mut FileReport) -> Result<()> {
    let name = recordings::recording(job.connection, recording)?.name;
    report.findings.push(ReportFinding {
        remedy: Some(
            Remedy::command("if they are of two takes: `chereme undo`, and import each file by its name"),
        ),
        ..ReportFinding::note(format!(
            "it is the only file of its kind next to one of movement: it is taken for the take {name:?}"
        ))
    });
    Ok(())
}

/// Returns the length of a track in microseconds.
fn length_us(track: &Track) -> i64 {
    match track {
        Track::Skeleton(skeleton) => skeleton
            .clip
            .rate()
            .instant(skeleton.clip.frames())
            .micros(),
        Track::Markers(markers) => markers.span().end().micros(),
        Track::Curves(curves) => curves.times().span(curves.frames()).end().micros(),
        Track::Media(_) => 0,
    }
}

/// Stores the optical markers among the skeleton's leaf joints as a track of points, and returns that.
pub(super) fn keep_beside(
    job: &Job<'_>,
    track: i64,
    offset_us: i64,
    anatomy: &Anatomy,
    report: &mut FileReport,
) -> Result<Option<i64>> {
    if anatomy.markers().is_empty() {
        return Ok(None);
    }
    let stored = movement::MotionTrack::of_row(job.connection, track)?;
    let frames = stored.frames();
    let head = stored.raw_clip(job.connection, 0..1)?;
    let mut beside = Beside::of(head.skeleton(), anatomy);
    if !beside.fits(frames) {
        report.findings.push(ReportFinding::warning(
            "the markers beside the skeleton are too many to be kept as a track of points; they stay its joints",
            "cut the take into shorter files",
        ));
        return Ok(None);
    }
    for start in (0..frames).step_by(8 * BLOCK_FRAMES) {
        let part = start..(start + 8 * BLOCK_FRAMES).min(frames);
        beside.push(&stored.raw_clip(job.connection, part)?);
    }
    let Some(markers) = beside.track(stored.rate, stored.convention) else {
        return Ok(None);
    };
    let new = NewTrack {
        offset_us,
        ..NewTrack::new("markers", Track::Markers(markers))
    };
    let id = store::store(job.connection, stored.row.recording_id, &new)?;
    Ok(Some(id))
}

/// The largest number of marker positions beside a skeleton that are stored as a track.
const MOST: usize = 12_000_000;

/// The optical markers beside a skeleton as points in the file's unit and axes.
pub(super) struct Beside {
    joints: Vec<usize>,
    names: Vec<String>,
    places: Vec<[Vec<f64>; 3]>,
}

impl Beside {
    /// Creates an empty collection for the markers of an anatomy.
    pub(super) fn of(skeleton: &Skeleton, anatomy: &Anatomy) -> Self {
        let joints = anatomy.markers().to_vec();
        let name = |&joint: &usize| skeleton.joint(joint).name.clone();
        Self {
            names: joints.iter().map(name).collect(),
            places: joints.iter().map(|_| Default::default()).collect(),
            joints,
        }
    }

    /// Returns whether there are markers, and few enough positions of them in this number of frames.
    pub(super) fn fits(&self, frames: usize) -> bool {
        !self.joints.is_empty() && self.joints.len().saturating_mul(frames) <= MOST
    }

    /// Adds the frames that follow those added before.
    pub(super) fn push(&mut self, clip: &Clip) {
        for (&joint, places) in self.joints.iter().zip(&mut self.places) {
            for at in clip.path(joint) {
                for (axis, values) in places.iter_mut().enumerate() {
                    values.push(at[axis]);
                }
            }
        }
    }

    /// Returns the track; nothing if there is no marker.
    pub(super) fn track(self, rate: Rate, convention: Convention) -> Option<Markers> {
        let points = self.names.into_iter().zip(self.places);
        let points = points.map(|(name, places)| {
            Marker::new(name, places.map(Column::doubles).into_iter().collect())
        });
        Markers::new(
            Times::Even(rate),
            Space::World(convention),
            points.collect(),
        )
        .ok()
    }
}
