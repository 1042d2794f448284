//! Imports films: links them to the recording whose take they show, or creates a recording for them.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use chereme_formats::mp4;
use rusqlite::Connection;
use sha2::{Digest, Sha256};

use super::report::ReportFinding;
use super::{FileReport, FileStatus, Job};
use crate::db::motion::hex;
use crate::db::recordings::{self, MediaTrackRow, RecordingRow};
use crate::db::tracks;
use crate::error::{Error, Result};
use crate::film::Film;
use crate::media::{find_media, is_same_film, media_type};
use crate::progress::Progress;

/// The kind of films in `source_file.kind`.
pub(super) const KIND: &str = "film";
/// The number of bytes at either end of a film that identify it, together with its size.
const ENDS: u64 = 1 << 20;

/// Returns a hash of both ends of a film and of its size: films are too large to be read completely.
pub(super) fn hash(path: &Path) -> Result<String> {
    let fault = |error| Error::file(path, error);
    let mut file = File::open(path).map_err(fault)?;
    let size = file.metadata().map_err(fault)?.len();
    let mut digest = Sha256::new();
    digest.update(size.to_le_bytes());
    for start in [0, size.saturating_sub(ENDS)] {
        let mut bytes = Vec::new();
        file.seek(SeekFrom::Start(start)).map_err(fault)?;
        let mut part = Read::by_ref(&mut file).take(ENDS);
        part.read_to_end(&mut bytes).map_err(fault)?;
        digest.update(&bytes);
    }
    Ok(hex(&digest.finalize()))
}

/// Links a film to its recording: the recording of the files beside it, one whose annotation file names it, one of the
/// same name without a film, or a new one.
pub(super) fn import(job: &mut Job<'_>, _progress: &mut Progress<'_>) -> Result<FileReport> {
    if job.options.into.is_none() {
        let here = job.places.at(&job.place, KIND);
        if here.is_some_and(|row| row.hash == job.hash) {
            return Ok(FileReport::unchanged(job.path, None));
        }
        // A film that was moved away and is imported from its new place.
        let gone = |path: &String| !job.base.join(path).is_file();
        let moved = job.places.hashed(&job.hash).find(|row| {
            row.kind == KIND && row.path.as_ref().is_some_and(gone) && job.places.is_earlier(row)
        });
        if let Some((id, path)) = moved.and_then(|row| Some((row.recording_id?, row.path.clone())))
        {
            job.keep(Some(id), None)?;
            let mut report = FileReport::unchanged(job.path, path.as_deref());
            report.recording = Some(recordings::recording(job.connection, id)?.name);
            return Ok(report);
        }
    }
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let length = length(job.path, &mut report)?;
    let (id, name) = match recording(job)? {
        Some(row) => (row.id, row.name),
        None => new(job, &mut report)?,
    };
    let films = recordings::media_tracks(job.connection, id)?;
    let own = films
        .iter()
        .find(|it| it.is_film() && is_same_film(it, &job.file_name));
    let mut offset = job.options.offset_us;
    let track = if let Some(own) = own {
        offset = own.offset_us;
        let note = format!("it is the film that the recording {name:?} names");
        report.findings.push(ReportFinding::note(note));
        own.id
    } else {
        let free = (1..).map(|n| format!("film {n}"));
        let free = free
            .take(films.len() + 1)
            .find(|name| films.iter().all(|it| it.name != *name));
        let row = MediaTrackRow {
            id: 0,
            recording_id: id,
            name: free.unwrap_or_default(),
            offset_us: offset,
            url: job.place.clone(),
            media_type: media_type(&job.file_name).map(str::to_owned),
            imported: Vec::new(),
        };
        job.count("tracks", 1);
        recordings::insert_media_track(job.connection, &row)?
    };
    if length > 0 {
        tracks::set_duration(job.connection, track, length)?;
    }
    recordings::lengthen(job.connection, id, length.saturating_add(offset))?;
    report.recording = Some(name);
    job.keep(Some(id), None)?;
    Ok(report)
}

/// Returns the length of a film in microseconds; 0 if no reader here can determine it.
fn length(path: &Path, report: &mut FileReport) -> Result<i64> {
    let mut file = File::open(path).map_err(|error| Error::file(path, error))?;
    match mp4::read(&mut file) {
        Ok((container, findings)) => {
            let coding = container.coding_name().to_owned();
            report
                .findings
                .extend(findings.into_iter().map(ReportFinding::from));
            if !matches!(container.coding.as_str(), "avc1" | "avc3") {
                report.findings.push(ReportFinding::warning(
                    format!("its pictures are coded as {coding}, which is played through ffmpeg where that is installed"),
                    "install ffmpeg, or convert the film once: ffmpeg -i FILM -c:v libx264 -pix_fmt yuv420p NEW.mp4",
                ));
            }
            Ok(container.micros(container.length()))
        }
        Err(mp4::Error::NoMp4) if !is_mp4(path) => match Film::open(path) {
            Ok(film) => Ok(film.times().end()),
            Err(error) => {
                let remedy = error.remedy();
                report.findings.push(ReportFinding {
                    remedy,
                    ..ReportFinding::warning(error.to_string(), "")
                });
                Ok(0)
            }
        },
        Err(error) => Err(Error::wrong(format!("the film cannot be read: {error}"))
            .at(path.display().to_string())
            .advise("export or copy it again from where it was recorded")),
    }
}

/// Returns whether a film is MP4 or QuickTime, judged by its name.
fn is_mp4(path: &Path) -> bool {
    let kind = path.extension().unwrap_or_default().to_string_lossy();
    ["mp4", "m4v", "mov"].contains(&kind.to_lowercase().as_str())
}

/// Returns the recording that a film belongs to.
fn recording(job: &Job<'_>) -> Result<Option<RecordingRow>> {
    if let Some(into) = &job.options.into {
        return crate::address::recording(job.connection, into).map(Some);
    }
    if let Some(id) = job.places.beside(&job.place) {
        return recordings::recording(job.connection, id).map(Some);
    }
    let all = recordings::recordings(job.connection)?;
    let mut without = None;
    for row in all {
        let tracks = recordings::media_tracks(job.connection, row.id)?;
        let named = tracks
            .into_iter()
            .find(|it| it.is_film() && is_same_film(it, &job.file_name));
        if let Some(track) = named
            && is_here(job, track)
        {
            return Ok(Some(row));
        }
        if row.name == job.stem && !has_film(job.connection, row.id)? {
            without = Some(row);
        }
    }
    Ok(without)
}

/// Returns whether the film of a track is missing, or is the file being imported.
fn is_here(job: &Job<'_>, track: MediaTrackRow) -> bool {
    let corpus = job.base.join("corpus");
    let found = find_media(track, &corpus);
    let same = |path: &Path| {
        let both = path.canonicalize().ok().zip(job.path.canonicalize().ok());
        both.is_some_and(|(a, b)| a == b)
    };
    !found.is_there || found.path.as_deref().is_some_and(same)
}

fn has_film(connection: &Connection, recording: i64) -> Result<bool> {
    let tracks = recordings::media_tracks(connection, recording)?;
    Ok(tracks.iter().any(MediaTrackRow::is_film))
}

/// Creates a recording for a film that belongs to no other.
fn new(job: &mut Job<'_>, report: &mut FileReport) -> Result<(i64, String)> {
    let (name, note) = job.own_name()?;
    report.findings.extend(note);
    let signer = match &job.options.signer {
        Some(name) => {
            let new = recordings::find_signer(job.connection, name)?.is_none();
            job.count("signers", usize::from(new));
            let hand = job.options.handedness.as_deref();
            Some(recordings::signer_named(job.connection, name, hand)?)
        }
        None => None,
    };
    let row = RecordingRow {
        id: 0,
        name: name.clone(),
        signer_id: signer,
        signer: None,
        origin: job.options.origin.unwrap_or_default(),
        duration_us: 0,
        licence: job.options.licence.clone(),
        notes: None,
    };
    let id = recordings::insert_recording(job.connection, &row)?;
    job.count("recordings", 1);
    Ok((id, name))
}
