//! Imports points from film as JSON: a file for each frame, or one for a whole film.

use std::fs;
use std::path::{Path, PathBuf};

use chereme_formats::keypoints::{KeypointReader, frame_of_name};
use sha2::{Digest, Sha256};

use super::{FileReport, ImportJob, import_captured, import_whole};
use crate::db::stored_motion::to_hex_text;
use crate::error::{CorpusError, CorpusResult};
use crate::progress::{ProgressReceiver, ProgressUnit};

/// The largest number of files for one film.
const MAX_POINT_FILES: usize = 2_000_000;

/// Returns the folder and prefix that the frame files of one film share, if this is one of them.
pub(super) fn point_file_series(path: &Path) -> Option<(PathBuf, String)> {
    let name = path.file_name()?.to_str()?;
    let (prefix, _) = frame_of_name(name)?;
    Some((path.parent()?.to_owned(), prefix.to_owned()))
}

/// Returns the frame files of a film in the order of their numbers.
fn list_point_frame_files(folder: &Path, prefix: &str) -> CorpusResult<Vec<(u64, PathBuf)>> {
    let fault = |error| CorpusError::from_file_failure(folder, error);
    let mut frame_paths = Vec::new();
    // A path without a folder has an empty parent, which cannot be listed.
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    for entry in fs::read_dir(folder).map_err(fault)? {
        let path = entry.map_err(fault)?.path();
        let name = path.file_name().and_then(|name| name.to_str());
        if let Some((own, number)) = name.and_then(frame_of_name)
            && own == prefix
        {
            frame_paths.push((number, path));
        }
        if frame_paths.len() > MAX_POINT_FILES {
            return Err(CorpusError::from_wrong_message(format!(
                "the film has more than {MAX_POINT_FILES} files of frames"
            )));
        }
    }
    // The system lists a folder in any order.
    frame_paths.sort();
    Ok(frame_paths)
}

/// Reads a film's points into tracks, one for each person.
pub(super) fn import_point_files(
    job: &mut ImportJob<'_>,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    job.kind = "keypoints";
    let mut reader = KeypointReader::default();
    let wrong = |error: chereme_formats::keypoints::KeypointError| {
        CorpusError::from_wrong_message(error.to_string())
            .with_advice("files of OpenPose are called NAME_000000000000_keypoints.json, one for each frame")
    };
    let files = match point_file_series(job.path) {
        Some((folder, prefix)) => {
            let files = list_point_frame_files(&folder, &prefix)?;
            // All frames together count as one file, so it gets a name and a place of its own.
            job.file_name = format!("{prefix}.json");
            job.place = match job.place.rsplit_once('/') {
                Some((folder, _)) => format!("{folder}/{prefix}.json"),
                None => format!("{prefix}.json"),
            };
            job.stem = prefix;
            files
        }
        None => Vec::new(),
    };
    if files.is_empty() {
        if let Some(report) = job.imported_before() {
            return import_captured::with_kept_form(job, report);
        }
        let bytes = job.read_job_bytes()?;
        reader.push_keypoint_document(None, &bytes).map_err(wrong)?;
    } else {
        let total = files.len() as u64;
        let mut digest = Sha256::new();
        for (done, (number, path)) in (0..).zip(&files) {
            let bytes = import_whole::read_whole_file(path)?;
            // The file of one film is only known as unchanged if no frame of it changed.
            digest.update(&bytes);
            let with_place = |error| wrong(error).with_error_place(path.display().to_string());
            reader
                .push_keypoint_document(Some(*number), &bytes)
                .map_err(with_place)?;
            if done % 64 == 0 {
                progress.report_amount(ProgressUnit::Frames, &job.file_name, done, Some(total))?;
            }
        }
        job.hash = to_hex_text(&digest.finalize());
        if let Some(report) = job.imported_before() {
            return import_captured::with_kept_form(job, report);
        }
    }
    job.report_progress(progress)?;
    let (document, findings) = reader.finish_keypoint_tracks(job.options.rate).map_err(wrong)?;
    import_captured::keep_take(job, document, findings, progress)
}
