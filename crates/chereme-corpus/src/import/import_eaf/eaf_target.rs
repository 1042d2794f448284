//! Determines the recording of an annotation file, and the earlier file that it is a new version of.

use chereme_formats::eaf::eaf_convert::AnnotationTranscript;
use chereme_sign::{ErrorRemedy, RemedyChoice};

use super::update;
use super::{FileReport, ImportJob, OwnEdits};
use crate::db::stored_recordings::{self, SourceFileRow};
use crate::db::stored_tracks;
use crate::error::CorpusResult;
use crate::import::import_joining::JoinReason;
use crate::import::import_places::NamedRecording;
use crate::import::readers::ParseFunction;
use crate::report_finding::ReportFinding;

/// The recording and the earlier version that an annotation file belongs to.
#[derive(Default)]
pub(super) struct EafImportTarget {
    /// Its recording, if the corpus has it.
    pub(super) recording: Option<i64>,
    /// The file's earlier version.
    pub(super) base: Option<SourceFileRow>,
}

impl EafImportTarget {
    /// Returns the report that a file changed nothing, with the path of the earlier version if it differs.
    pub(super) fn unchanged_report(&self, job: &ImportJob<'_>, report: FileReport) -> FileReport {
        let path = self.base.as_ref().and_then(|base| base.path.as_deref());
        FileReport {
            recording: report.recording,
            ..FileReport::unchanged_file_report(job.path, path.filter(|path| *path != job.place))
        }
    }

    /// Reads the earlier version; nothing if the corpus does not have it or it cannot be read.
    pub(super) fn read_earlier_transcript(
        &self,
        job: &ImportJob<'_>,
        read: ParseFunction<AnnotationTranscript>,
    ) -> CorpusResult<Option<AnnotationTranscript>> {
        match &self.base {
            Some(base) => read_stored_transcript(job, read, base),
            None => Ok(None),
        }
    }
}

/// Reads a stored file of the job's kind; nothing if its bytes are missing or cannot be read.
fn read_stored_transcript(
    job: &ImportJob<'_>,
    read: ParseFunction<AnnotationTranscript>,
    file: &SourceFileRow,
) -> CorpusResult<Option<AnnotationTranscript>> {
    let bytes = stored_recordings::source_bytes(job.connection, file.id)?;
    // A version that cannot be read any more is as good as a missing one.
    Ok(bytes.and_then(|bytes| Some(read(&bytes).ok()?.0)))
}

/// Returns the report of an unchanged file at an unchanged path, if it belongs to the take beside it.
pub(super) fn report_unchanged_target(job: &ImportJob<'_>, here: &SourceFileRow) -> CorpusResult<Option<FileReport>> {
    let Some(id) = here.recording_id else {
        return Ok(None);
    };
    // The file may have been moved to another take in the meantime, which only a full import settles.
    if job.places.recording_beside_file(&job.place) != Some(id) {
        return Ok(None);
    }
    let mut report = FileReport::unchanged_file_report(job.path, None);
    report.recording = Some(stored_recordings::load_recording_row(job.connection, id)?.name);
    Ok(Some(report))
}

/// Finds the recording of a file: that of the take beside it, otherwise that of the file that it is a version of,
/// otherwise that of the film that it names, otherwise one of its name without such a file, if the caller joins by name.
/// `read` reads files of its kind.
pub(super) fn find_import_target(
    job: &mut ImportJob<'_>,
    read: ParseFunction<AnnotationTranscript>,
    transcript: &AnnotationTranscript,
    report: &mut FileReport,
) -> CorpusResult<EafImportTarget> {
    if let Some(id) = job.find_sibling_recording() {
        job.note_file_join(id, JoinReason::FolderAndName);
        return Ok(EafImportTarget {
            recording: Some(id),
            base: find_earlier_eaf(job, id)?,
        });
    }
    let candidates = job.recordings_of_same_name()?;
    for &NamedRecording { id, .. } in &candidates {
        let Some(base) = find_earlier_eaf(job, id)? else {
            continue;
        };
        // A file of the same name elsewhere is often of another signer, so the name alone does not suffice.
        if is_version(job, read, &base, transcript, report)? {
            job.note_file_join(id, JoinReason::FileVersion);
            return Ok(EafImportTarget {
                recording: Some(id),
                base: Some(base),
            });
        }
    }
    // The caller names the recording, so nothing is guessed from films and names.
    if job.options.into.is_some() {
        return Ok(EafImportTarget::default());
    }
    let filmed = job.recording_of_named_film(transcript);
    // A recording that has annotations of its own would get those of another file on top.
    if let Some(id) = filmed.filter(|id| !job.places.has_file_of_kind(*id, job.kind))
        && !job.is_other_signer(id)?
    {
        job.note_file_join(id, JoinReason::NamedFilm);
        return Ok(EafImportTarget {
            recording: Some(id),
            base: None,
        });
    }
    let (mut unfit, mut likely) = (None, Vec::new());
    for candidate in candidates {
        if find_earlier_eaf(job, candidate.id)?.is_some() {
            continue;
        }
        // A take of this name in another folder, in which these annotations do not fit, is another take.
        if fits_in_recording(job, candidate.id, transcript)? {
            likely.push(candidate);
        } else {
            unfit = unfit.or(Some(candidate.id));
        }
    }
    if !likely.is_empty() {
        // Even a fitting recording is only joined if the caller allows names as evidence.
        let recording = job.join_by_name_elsewhere(&likely, report)?;
        return Ok(EafImportTarget { recording, base: None });
    }
    if let Some(id) = unfit {
        let other = stored_recordings::load_recording_row(job.connection, id)?.name;
        report.findings.push(ReportFinding {
            severity: "note",
            line: None,
            message: format!(
                "it is no part of the recording {other:?} of this name in another folder, which ends before its \
                 annotations"
            ),
            remedy: Some(ErrorRemedy::command_remedy(
                "if it is: `chereme undo`, then import it with --into recording:N",
            )),
        });
    }
    Ok(EafImportTarget::default())
}

/// Returns whether annotations fit into a recording, which ends where the longest of its tracks does.
fn fits_in_recording(job: &ImportJob<'_>, recording: i64, transcript: &AnnotationTranscript) -> CorpusResult<bool> {
    let tracks = stored_tracks::load_track_rows(job.connection, recording)?;
    let ends = tracks
        .iter()
        .filter_map(|track| track.duration_us?.checked_add(track.offset_us));
    // A recording without tracks sets no bounds to annotations.
    let Some(end) = ends.max() else {
        return Ok(true);
    };
    Ok(transcript.transcript_end().instant_micros() <= end.saturating_add(super::MAX_OVERHANG_US))
}

/// Returns the newest annotation file of a recording: the one at this path, otherwise one of this name.
fn find_earlier_eaf(job: &ImportJob<'_>, recording: i64) -> CorpusResult<Option<SourceFileRow>> {
    let files = stored_recordings::source_files(job.connection, recording)?;
    // The newest version is the one that the corpus was last brought in line with.
    let all = || files.iter().rev().filter(|row| row.kind == job.kind);
    let here = all().find(|row| row.path.as_deref() == Some(&job.place));
    let name = job.file_name.to_lowercase();
    let named = || all().find(|row| row.name.to_lowercase() == name);
    Ok(here.or_else(named).cloned())
}

/// Reports whether a file from elsewhere is a version of one of the same name that an earlier import read: the caller
/// says so, the bytes are the same, or at least half of the annotations are the same.
fn is_version(
    job: &ImportJob<'_>,
    read: ParseFunction<AnnotationTranscript>,
    base: &SourceFileRow,
    transcript: &AnnotationTranscript,
    report: &mut FileReport,
) -> CorpusResult<bool> {
    // Without a path nothing distinguishes the two files, so the name has to do.
    let Some(path) = &base.path else {
        return Ok(true);
    };
    // Two files of one import are both current, so neither is a version of the other.
    if !job.places.is_earlier(base) {
        return Ok(false);
    }
    if base.hash == job.hash {
        return Ok(true);
    }
    let Some(before) = read_stored_transcript(job, read, base)? else {
        return Ok(false);
    };
    let (same, all) = update::count_same_annotations(&before, transcript);
    // Ids of annotations recur in all files, so a few equal ones may be chance.
    let alike = same > 0 && 2 * same >= all;
    // An option about edits only makes sense for a file that was imported before.
    if alike || job.options.own_edits != OwnEdits::Ask {
        report.findings.push(ReportFinding::finding_note(format!(
            "it is taken for a new version of {path}: {same} of {all} annotations are the same"
        )));
        return Ok(true);
    }
    report.findings.push(ReportFinding {
        severity: "note",
        line: None,
        message: format!("it is taken for another file than {path}, with which it shares {same} of {all} annotations"),
        remedy: Some(
            ErrorRemedy::choice_remedy(
                RemedyChoice::Side,
                "if it is a new version of that file: `chereme undo`, then import it with --merge, --theirs or \
             --mine",
            )
            .to_owned(),
        ),
    });
    Ok(false)
}
