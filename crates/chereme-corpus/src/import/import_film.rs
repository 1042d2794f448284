//! Imports films: links them to the recording whose take they show, or creates a recording for them.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use chereme_formats::mp4;
use rusqlite::Connection;
use sha2::{Digest, Sha256};

use super::import_joining::{JoinQuestion, JoinReason};
use super::{FileReport, FileStatus, ImportJob};
use crate::db::stored_motion::to_hex_text;
use crate::db::stored_recordings::{self, MediaTrackRow, RecordingRow};
use crate::db::stored_tracks;
use crate::error::{CorpusError, CorpusResult};
use crate::film::FilmFile;
use crate::media::{find_media, is_same_film, media_type};
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;

/// The kind of films in `source_file.kind`.
pub(super) const FILM_KIND: &str = "film";
/// The number of bytes at either end of a film that identify it, together with its size.
const FILM_IDENTITY_END_BYTES: u64 = 1 << 20;

/// Returns a hash of both ends of a film and of its size: films are too large to be read completely.
pub(super) fn hash(path: &Path) -> CorpusResult<String> {
    let fault = |error| CorpusError::from_file_failure(path, error);
    let mut file = File::open(path).map_err(fault)?;
    let size = file.metadata().map_err(fault)?.len();
    let mut digest = Sha256::new();
    digest.update(size.to_le_bytes());
    for start in [0, size.saturating_sub(FILM_IDENTITY_END_BYTES)] {
        let mut bytes = Vec::new();
        file.seek(SeekFrom::Start(start)).map_err(fault)?;
        let mut part = Read::by_ref(&mut file).take(FILM_IDENTITY_END_BYTES);
        part.read_to_end(&mut bytes).map_err(fault)?;
        digest.update(&bytes);
    }
    Ok(to_hex_text(&digest.finalize()))
}

/// Links a film to its recording: the recording of the files beside it, one whose annotation file names it, one of the
/// same name without a film, or a new one.
pub(super) fn import_film(job: &mut ImportJob<'_>, _progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    // With a named recording, the film is linked even if another recording has it.
    if job.options.into.is_none() {
        let here = job.places.find_file_at(&job.place, FILM_KIND);
        if here.is_some_and(|row| row.hash == job.hash) {
            return Ok(FileReport::unchanged_file_report(job.path, None));
        }
        // A film that was moved away and is imported from its new place.
        let gone = |path: &String| !job.base.join(path).is_file();
        let moved = job
            .places
            .files_with_hash(&job.hash)
            // If the film still lies at its old place, this is a copy and no moved film.
            .find(|row| row.kind == FILM_KIND && row.path.as_ref().is_some_and(gone) && job.places.is_earlier(row));
        if let Some((id, path)) = moved.and_then(|row| Some((row.recording_id?, row.path.clone()))) {
            job.keep_source_file(Some(id), None)?;
            let mut report = FileReport::unchanged_file_report(job.path, path.as_deref());
            report.recording = Some(stored_recordings::load_recording_row(job.connection, id)?.name);
            return Ok(report);
        }
    }
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    let length = film_length_micros(job.path, &mut report)?;
    let (id, name) = match find_film_recording(job, &mut report)? {
        Some(row) => (row.id, row.name),
        None => new(job, &mut report)?,
    };
    let films = stored_recordings::media_tracks(job.connection, id)?;
    let known_track = films
        .iter()
        .find(|film| film.is_film() && is_same_film(film, &job.file_name));
    let mut offset = job.options.offset_us;
    let track = if let Some(own) = known_track {
        // The annotations state where the film begins, which counts more than the option for all files.
        offset = own.offset_us;
        let note = format!("it is the film that the recording {name:?} names");
        report.findings.push(ReportFinding::finding_note(note));
        own.id
    } else {
        let film_names = (1..).map(|n| format!("film {n}"));
        let free = film_names
            .take(films.len() + 1)
            .find(|name| films.iter().all(|film| film.name != *name));
        let row = MediaTrackRow {
            id: 0,
            recording_id: id,
            name: free.unwrap_or_default(),
            offset_us: offset,
            url: job.place.clone(),
            media_type: media_type(&job.file_name).map(str::to_owned),
            imported: Vec::new(),
        };
        job.count_created_rows("tracks", 1);
        stored_recordings::insert_media_track(job.connection, &row)?
    };
    // A length of zero means that it is unknown, so a known one is not overwritten.
    if length > 0 {
        stored_tracks::set_duration(job.connection, track, length)?;
    }
    // The film may begin after the recording, and then also ends later.
    stored_recordings::lengthen_recording(job.connection, id, length.saturating_add(offset))?;
    report.recording = Some(name);
    job.keep_source_file(Some(id), None)?;
    Ok(report)
}

/// Returns the length of a film in microseconds; 0 if no reader here can determine it.
fn film_length_micros(path: &Path, report: &mut FileReport) -> CorpusResult<i64> {
    let mut file = File::open(path).map_err(|error| CorpusError::from_file_failure(path, error))?;
    match mp4::read_mp4_index(&mut file) {
        Ok((container, findings)) => {
            let coding = container.coding_name().to_owned();
            report.findings.extend(findings.into_iter().map(ReportFinding::from));
            // The built-in decoder plays only H.264.
            if !matches!(container.coding.as_str(), "avc1" | "avc3") {
                report.findings.push(ReportFinding::finding_warning(
                    format!(
                        "its pictures are coded as {coding}, which is played through ffmpeg where that is installed"
                    ),
                    "install ffmpeg, or convert the film once: ffmpeg -i FILM -c:v libx264 -pix_fmt yuv420p NEW.mp4",
                ));
            }
            Ok(container.ticks_to_micros(container.film_length_ticks()))
        }
        // A damaged MP4 would otherwise be passed to ffmpeg, and its error would hide the cause.
        Err(mp4::Mp4Error::NoMp4) if !is_mp4(path) => match FilmFile::open_film(path) {
            Ok(film) => Ok(film.film_times().film_end()),
            Err(error) => {
                let remedy = error.error_remedy();
                report.findings.push(ReportFinding {
                    remedy,
                    ..ReportFinding::finding_warning(error.to_string(), "")
                });
                // A film that cannot be measured is linked all the same, and its length stays unknown.
                Ok(0)
            }
        },
        Err(error) => Err(
            CorpusError::from_wrong_message(format!("the film cannot be read: {error}"))
                .with_error_place(path.display().to_string())
                .with_advice("export or copy it again from where it was recorded"),
        ),
    }
}

/// Returns whether a film is MP4 or QuickTime, judged by its name.
fn is_mp4(path: &Path) -> bool {
    let kind = path.extension().unwrap_or_default().to_string_lossy();
    ["mp4", "m4v", "mov"].contains(&kind.to_lowercase().as_str())
}

/// Returns the recording that a film belongs to: the one that the caller named, the one of the files beside it, one whose
/// annotations name it, or one of its name without a film, if the caller joins by name.
fn find_film_recording(job: &mut ImportJob<'_>, report: &mut FileReport) -> CorpusResult<Option<RecordingRow>> {
    let (id, reason) = if let Some(into) = &job.options.into {
        let row = crate::address::find_recording_by_name(job.connection, into)?;
        (row.id, JoinReason::Stated)
    } else if let Some(id) = job.places.recording_beside_file(&job.place) {
        (id, JoinReason::FolderAndName)
    } else {
        let mut naming_ids = Vec::new();
        for row in stored_recordings::load_recording_rows(job.connection)? {
            match named_film_place(job, row.id)? {
                Some(NamedFilmPlace::Here) => {
                    // A path that leads to this very file outweighs films of the same name that are missing.
                    naming_ids = vec![row.id];
                    break;
                }
                Some(NamedFilmPlace::Missing) => naming_ids.push(row.id),
                None => {}
            }
        }
        match naming_ids.as_slice() {
            [one] => (*one, JoinReason::NamedFilm),
            [] => {
                let mut filmless = job.recordings_of_same_name()?;
                let mut filmed = BTreeSet::new();
                for candidate in &filmless {
                    if has_film(job.connection, candidate.id)? {
                        filmed.insert(candidate.id);
                    }
                }
                filmless.retain(|candidate| !filmed.contains(&candidate.id));
                let id = job.join_by_name_elsewhere(&filmless, report)?;
                let row = id.map(|id| stored_recordings::load_recording_row(job.connection, id));
                return row.transpose();
            }
            several => {
                job.report_join_question(JoinQuestion::NamedFilm, several, report)?;
                return Ok(None);
            }
        }
    };
    job.note_file_join(id, reason);
    stored_recordings::load_recording_row(job.connection, id).map(Some)
}

/// Where the film is that the annotations of a recording name as the file being imported is called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NamedFilmPlace {
    /// It is the file being imported.
    Here,
    /// It is not at the place that they name.
    Missing,
}

/// Returns where the film is that the annotations of a recording name, if it is called as the file being imported and is
/// no other file.
fn named_film_place(job: &ImportJob<'_>, recording: i64) -> CorpusResult<Option<NamedFilmPlace>> {
    let tracks = stored_recordings::media_tracks(job.connection, recording)?;
    let named = tracks
        .into_iter()
        .find(|track| track.is_film() && is_same_film(track, &job.file_name));
    let Some(track) = named else { return Ok(None) };
    let media_place = find_media(track, &job.base.join("corpus"));
    let is_same = |path: &Path| {
        let both = path.canonicalize().ok().zip(job.path.canonicalize().ok());
        both.is_some_and(|(named, imported)| named == imported)
    };
    Ok(match media_place.path.as_deref() {
        _ if !media_place.is_there => Some(NamedFilmPlace::Missing),
        Some(path) if is_same(path) => Some(NamedFilmPlace::Here),
        _ => None,
    })
}

fn has_film(connection: &Connection, recording: i64) -> CorpusResult<bool> {
    let tracks = stored_recordings::media_tracks(connection, recording)?;
    Ok(tracks.iter().any(MediaTrackRow::is_film))
}

/// Creates a recording for a film that belongs to no other.
fn new(job: &mut ImportJob<'_>, report: &mut FileReport) -> CorpusResult<(i64, String)> {
    let (name, note) = job.own_name()?;
    report.findings.extend(note);
    let signer = match &job.options.signer {
        Some(name) => {
            let new = stored_recordings::find_signer(job.connection, name)?.is_none();
            job.count_created_rows("signers", usize::from(new));
            let hand = job.options.handedness.as_deref();
            Some(stored_recordings::signer_named(job.connection, name, hand)?)
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
    let id = stored_recordings::insert_recording(job.connection, &row)?;
    job.count_created_rows("recordings", 1);
    Ok((id, name))
}
