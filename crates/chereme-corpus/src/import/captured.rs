//! Captures that are no BVH: markers, curves and skeletons of other formats, and tiers of other programs.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::Path;

use chereme_formats::eaf::Transcript;
use chereme_formats::tracks::{Content, Tracks};
use chereme_formats::{Finding, c3d, curves, gltf, pose, subtitles, textgrid, trc};

use super::report::ReportFinding;
use super::{FileReport, FileStatus, Job, eaf, inventory, lexicon, tracks};
use crate::error::{Error, Result};
use crate::progress::Progress;
use crate::track::{NewTrack, SkeletonTrack, Track};

/// So many bytes of a table or JSON document show whether it holds curves.
const HEAD: usize = 1 << 14;

/// Reads a C3D file: markers, analog channels, model outputs, events.
pub(super) fn import_c3d(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    take(job, progress, |bytes| {
        c3d::read(bytes).map_err(|it| it.to_string())
    })
}

/// Reads a TRC file of markers.
pub(super) fn import_trc(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    take(job, progress, |bytes| {
        trc::read(bytes).map_err(|it| it.to_string())
    })
}

/// Reads points that were estimated from film.
pub(super) fn import_pose(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    take(job, progress, |bytes| {
        pose::read(bytes).map_err(|it| it.to_string())
    })
}

/// Reads facial animation parameters.
pub(super) fn import_curves(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    job.kind = "curves";
    take(job, progress, |bytes| {
        curves::read(bytes).map_err(|it| it.to_string())
    })
}

/// Reads a table: curves if its first column is a time, else a lexicon.
pub(super) fn import_table(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    match holds_curves(job.path)? {
        true => import_curves(job, progress),
        false => lexicon::import(job, progress),
    }
}

/// Reads JSON: scores of a face, else an inventory or signs.
pub(super) fn import_json(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    match holds_curves(job.path)? {
        true => import_curves(job, progress),
        false => inventory::import(job, progress),
    }
}

fn holds_curves(path: &Path) -> Result<bool> {
    let fault = |error| Error::file(path, error);
    let mut head = Vec::new();
    let file = File::open(path).map_err(fault)?;
    file.take(HEAD as u64)
        .read_to_end(&mut head)
        .map_err(fault)?;
    Ok(curves::Kind::of(&head).is_some())
}

/// Reads a skeleton of glTF with its movement, and the weights of morph targets.
pub(super) fn import_gltf(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    if let Some(report) = job.unchanged() {
        return Ok(report);
    }
    let bytes = job.bytes()?;
    job.tell(progress)?;
    let folder = job.path.parent().unwrap_or(Path::new(""));
    let beside = |name: &str| fs::read(folder.join(name)).ok();
    let (scene, findings) =
        gltf::read(&bytes, &beside).map_err(|it| Error::wrong(it.to_string()))?;
    job.tell(progress)?;
    let mut new = vec![NewTrack::new(
        "body",
        Track::Skeleton(SkeletonTrack {
            clip: scene.clip,
            convention: scene.convention,
            roles: job.options.roles.clone(),
        }),
    )];
    new.extend(
        scene
            .morphs
            .map(|morphs| NewTrack::new("face", Track::Curves(morphs))),
    );
    let mut report = begun(job, findings);
    let recording = tracks::store(job, new, &mut report)?;
    job.keep(Some(recording), None)?;
    Ok(report)
}

/// Reads a TextGrid of Praat.
pub(super) fn import_text_grid(
    job: &mut Job<'_>,
    progress: &mut Progress<'_>,
) -> Result<FileReport> {
    eaf::import_as(job, progress, |bytes| {
        textgrid::read(bytes).map_err(|it| it.to_string())
    })
}

/// Reads subtitles.
pub(super) fn import_subtitles(
    job: &mut Job<'_>,
    progress: &mut Progress<'_>,
) -> Result<FileReport> {
    eaf::import_as(job, progress, |bytes| {
        subtitles::read(bytes).map_err(|it| it.to_string())
    })
}

fn begun(job: &Job<'_>, findings: Vec<Finding>) -> FileReport {
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    report
}

/// Stores the tracks and events of a file.
fn take(
    job: &mut Job<'_>,
    progress: &mut Progress<'_>,
    read: impl FnOnce(&[u8]) -> std::result::Result<(Tracks, Vec<Finding>), String>,
) -> Result<FileReport> {
    if let Some(report) = job.unchanged() {
        return Ok(report);
    }
    let bytes = job.bytes()?;
    job.tell(progress)?;
    let (document, findings) = read(&bytes).map_err(Error::wrong)?;
    job.tell(progress)?;
    let new = document.tracks.into_iter().map(|track| NewTrack {
        offset_us: track.offset.micros(),
        ..NewTrack::new(
            track.name,
            match track.content {
                Content::Markers(markers) => Track::Markers(markers),
                Content::Curves(curves) => Track::Curves(curves),
            },
        )
    });
    let mut report = begun(job, findings);
    let recording = tracks::store(job, new.collect(), &mut report)?;
    if let Some(events) = document.events {
        add_events(job, recording, &events, &mut report, progress)?;
    }
    job.keep(Some(recording), None)?;
    Ok(report)
}

/// Stores events of a capture as a tier, unless the recording has a tier of their name.
fn add_events(
    job: &mut Job<'_>,
    recording: i64,
    events: &Transcript,
    report: &mut FileReport,
    progress: &mut Progress<'_>,
) -> Result<()> {
    if !eaf::add(job, recording, events, report, progress)? {
        report.findings.push(ReportFinding::warning(
            "the recording has a tier \"events\" already, so the events of this file were left out",
            "rename that tier and import the file again",
        ));
    }
    Ok(())
}
