//! Imports points from film as JSON: a file for each frame, or one for a whole film.

use std::fs;
use std::path::{Path, PathBuf};

use chereme_formats::keypoints::{Reader, frame_of_name};
use sha2::{Digest, Sha256};

use super::{FileReport, Job, captured, whole};
use crate::db::motion::hex;
use crate::error::{Error, Result};
use crate::progress::{Progress, Step, Unit};

/// The largest number of files for one film.
const MOST: usize = 2_000_000;

/// Returns the folder and prefix that the frame files of one film share, if this is one of them.
pub(super) fn series(path: &Path) -> Option<(PathBuf, String)> {
    let name = path.file_name()?.to_str()?;
    let (prefix, _) = frame_of_name(name)?;
    Some((path.parent()?.to_owned(), prefix.to_owned()))
}

/// Returns the frame files of a film in the order of their numbers.
fn frames(folder: &Path, prefix: &str) -> Result<Vec<(u64, PathBuf)>> {
    let fault = |error| Error::file(folder, error);
    let mut found = Vec::new();
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
            found.push((number, path));
        }
        if found.len() > MOST {
            return Err(Error::wrong(format!(
                "the film has more than {MOST} files of frames"
            )));
        }
    }
    found.sort();
    Ok(found)
}

/// Reads a film's points into tracks, one for each person.
pub(super) fn import(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    job.kind = "keypoints";
    let mut reader = Reader::default();
    let wrong = |error: chereme_formats::keypoints::Error| {
        Error::wrong(error.to_string()).advise(
            "files of OpenPose are called NAME_000000000000_keypoints.json, one for each frame",
        )
    };
    let files = match series(job.path) {
        Some((folder, prefix)) => {
            let files = frames(&folder, &prefix)?;
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
            return captured::with_kept_form(job, report);
        }
        let bytes = job.bytes()?;
        reader.push(None, &bytes).map_err(wrong)?;
    } else {
        let total = files.len() as u64;
        let mut digest = Sha256::new();
        for (done, (number, path)) in (0..).zip(&files) {
            let bytes = whole::read(path)?;
            digest.update(&bytes);
            let at = |error| wrong(error).at(path.display().to_string());
            reader.push(Some(*number), &bytes).map_err(at)?;
            if done % 64 == 0 {
                progress.report(Step {
                    task: &job.file_name,
                    done,
                    total: Some(total),
                    unit: Unit::Frames,
                })?;
            }
        }
        job.hash = hex(&digest.finalize());
        if let Some(report) = job.imported_before() {
            return captured::with_kept_form(job, report);
        }
    }
    job.report_progress(progress)?;
    let (document, findings) = reader.finish(job.options.rate).map_err(wrong)?;
    captured::keep_take(job, document, findings, progress)
}
