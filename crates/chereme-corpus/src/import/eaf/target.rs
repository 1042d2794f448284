//! Determines the recording of an annotation file, and the earlier file that it is a new version of.

use chereme_formats::eaf::convert::Transcript;
use chereme_sign::{Choice, Remedy};

use super::update;
use super::{FileReport, Job, OwnEdits};
use crate::db::recordings::{self, SourceFileRow};
use crate::db::tracks;
use crate::error::Result;
use crate::import::readers::Parse;
use crate::import::report::ReportFinding;

/// The recording and the earlier version that an annotation file belongs to.
#[derive(Default)]
pub(super) struct Target {
    /// Its recording, if the corpus has it.
    pub(super) recording: Option<i64>,
    /// The file's earlier version.
    pub(super) base: Option<SourceFileRow>,
}

impl Target {
    /// Returns the path of the earlier version, if it differs.
    pub(super) fn elsewhere(&self, job: &Job<'_>) -> Option<&str> {
        let path = self.base.as_ref()?.path.as_deref()?;
        (path != job.place).then_some(path)
    }

    /// Reads the earlier version; nothing if the corpus does not have it or it cannot be read.
    pub(super) fn transcript(
        &self,
        job: &Job<'_>,
        read: Parse<Transcript>,
    ) -> Result<Option<Transcript>> {
        match &self.base {
            Some(base) => stored(job, read, base),
            None => Ok(None),
        }
    }
}

/// Reads a stored file of the job's kind; nothing if its bytes are missing or cannot be read.
fn stored(
    job: &Job<'_>,
    read: Parse<Transcript>,
    file: &SourceFileRow,
) -> Result<Option<Transcript>> {
    let bytes = recordings::source_bytes(job.connection, file.id)?;
    Ok(bytes.and_then(|bytes| Some(read(&bytes).ok()?.0)))
}

/// Returns the report of an unchanged file at an unchanged path, if it belongs to the take beside it.
pub(super) fn unchanged(job: &Job<'_>, here: &SourceFileRow) -> Result<Option<FileReport>> {
    let Some(id) = here.recording_id else {
        return Ok(None);
    };
    if job.places.beside(&job.place) != Some(id) {
        return Ok(None);
    }
    let mut report = FileReport::unchanged(job.path, None);
    report.recording = Some(recordings::recording(job.connection, id)?.name);
    Ok(Some(report))
}

/// Finds the recording of a file: that of the take beside it, otherwise that of the file that it is a version of,
/// otherwise one of its name that has no annotation file from elsewhere. `read` reads files of its kind.
pub(super) fn find(
    job: &Job<'_>,
    read: Parse<Transcript>,
    transcript: &Transcript,
    report: &mut FileReport,
) -> Result<Target> {
    if let Some(id) = job.places.beside(&job.place) {
        return Ok(Target {
            recording: Some(id),
            base: earlier(job, id)?,
        });
    }
    let mut candidates = job.places.recordings_named(&job.place);
    let named = recordings::recording_named(job.connection, &job.stem)?.map(|row| row.id);
    candidates.extend(
        named
            .filter(|id| !candidates.contains(id))
            .into_iter()
            .collect::<Vec<_>>(),
    );
    for &id in &candidates {
        let Some(base) = earlier(job, id)? else {
            continue;
        };
        if is_version(job, (read, &base), transcript, report)? {
            return Ok(Target {
                recording: Some(id),
                base: Some(base),
            });
        }
    }
    let mut unfit = None;
    for id in candidates {
        if earlier(job, id)?.is_some() {
            continue;
        }
        // A take of this name in another folder, in which these annotations do not fit, is another take.
        if job.options.into.is_none() && !fits(job, id, transcript)? {
            unfit = unfit.or(Some(id));
            continue;
        }
        return Ok(Target {
            recording: Some(id),
            base: None,
        });
    }
    if let Some(id) = unfit {
        let other = recordings::recording(job.connection, id)?.name;
        report.findings.push(ReportFinding {
            severity: "note",
            line: None,
            message: format!(
                "it is no part of the recording {other:?} of this name in another folder, which ends before its \
                 annotations"
            ),
            remedy: Some(Remedy::command("if it is: `chereme undo`, then import it with --into recording:N")),
        });
    }
    Ok(Target::default())
}

/// Returns whether annotations fit into a recording, which ends where the longest of its tracks does.
fn fits(job: &Job<'_>, recording: i64, transcript: &Transcript) -> Result<bool> {
    let tracks = tracks::tracks(job.connection, recording)?;
    let ends = tracks
        .iter()
        .filter_map(|it| it.duration_us?.checked_add(it.offset_us));
    let Some(end) = ends.max() else {
        return Ok(true);
    };
    Ok(transcript.end().micros() <= end.saturating_add(super::BEYOND))
}

/// Returns the newest annotation file of a recording: the one at this path, otherwise one of this name.
fn earlier(job: &Job<'_>, recording: i64) -> Result<Option<SourceFileRow>> {
    let files = recordings::source_files(job.connection, recording)?;
    let all = || files.iter().rev().filter(|row| row.kind == job.kind);
    let here = all().find(|row| row.path.as_deref() == Some(&job.place));
    let name = job.file_name.to_lowercase();
    let named = || all().find(|row| row.name.to_lowercase() == name);
    Ok(here.or_else(named).cloned())
}

/// Reports whether a file from elsewhere is a version of one of the same name that an earlier import read: the caller
/// says so, the bytes are the same, or at least half of the annotations are the same.
fn is_version(
    job: &Job<'_>,
    (read, base): (Parse<Transcript>, &SourceFileRow),
    transcript: &Transcript,
    report: &mut FileReport,
) -> Result<bool> {
    let Some(path) = &base.path else {
        return Ok(true);
    };
    if !job.places.is_earlier(base) {
        return Ok(false);
    }
    if base.hash == job.hash {
        return Ok(true);
    }
    let Some(before) = stored(job, read, base)? else {
        return Ok(false);
    };
    let (same, all) = update::alike(&before, transcript);
    let alike = same > 0 && 2 * same >= all;
    if alike || job.options.own_edits != OwnEdits::Ask {
        report.findings.push(ReportFinding::note(format!(
            "it is taken for a new version of {path}: {same} of {all} annotations are the same"
        )));
        return Ok(true);
    }
    report.findings.push(ReportFinding {
        severity: "note",
        line: None,
        message: format!(
            "it is taken for another file than {path}, with which it shares {same} of {all} annotations"
        ),
        remedy: Some(
            Remedy::choice(Choice::Side, "if it is a new version of that file: `chereme undo`, then import it with --merge, --theirs or \
             --mine")
                .to_owned(),
        ),
    });
    Ok(false)
}
