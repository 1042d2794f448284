//! Tracks that a file holds into the recording that they belong to.

use serde_json::json;

use super::{FileReport, Job, bvh};
use crate::db::recordings;
use crate::db::tracks::{self, TrackRow};
use crate::error::Result;
use crate::track::{NewTrack, store};

/// Stores the tracks of a file and returns their recording: the one that the caller named, that of the files with this
/// folder and stem, or a new one. The report gets a line for each track, and the caller's offset is added to each.
///
/// The reader itself keeps the file ([`Job::keep`]) and reports what was odd about it.
pub(super) fn store(job: &mut Job<'_>, new: Vec<NewTrack>, report: &mut FileReport) -> Result<i64> {
    let same_take = job
        .places
        .beside(&job.place)
        .filter(|_| job.options.into.is_none());
    let recording = match same_take {
        Some(recording) => recording,
        None => bvh::insert_recording(job, report)?,
    };
    let mut rows: Vec<TrackRow> = Vec::with_capacity(new.len());
    for mut track in new {
        track.offset_us = track.offset_us.saturating_add(job.options.offset_us);
        let id = store::store(job.connection, recording, &track)?;
        rows.push(tracks::track(job.connection, id)?);
    }
    job.count("tracks", rows.len());
    let shown = |row: &TrackRow| {
        json!({
            "kind": row.kind,
            "name": row.name,
            "rate": row.rate.map(chereme_motion::Rate::per_second),
            "frames": row.frames,
            "offset_us": row.offset_us,
            "duration_us": row.duration_us,
            "channels": row.channels,
        })
    };
    report.recording = Some(recordings::recording(job.connection, recording)?.name);
    report.understand("tracks", rows.iter().map(shown).collect::<Vec<_>>());
    Ok(recording)
}
