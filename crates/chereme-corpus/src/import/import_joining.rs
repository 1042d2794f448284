//! Decides which files belong to one recording, and says why: a join that is not certain is a question, and not made.

use std::path::Path;

use chereme_formats::eaf::eaf_convert::AnnotationTranscript;
use chereme_sign::{ErrorRemedy, RemedyChoice};
use serde::Serialize;

use super::import_film::FILM_KIND;
use super::import_places::NamedRecording;
use super::{FileReport, ImportJob, absolute, relative_file_path};
use crate::db::stored_recordings;
use crate::error::CorpusResult;
use crate::media::candidate_media_paths;
use crate::report_finding::ReportFinding;

/// The evidence that is enough to join files into one recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FileJoining {
    /// Folder and name, what a file says, and within a folder a true timecode; everything else is a question.
    #[default]
    Certain,
    /// Also the same name in another folder, if exactly one recording has it.
    Name,
    /// Also any timecode, in neighbouring folders too.
    Timecode,
    /// Folder and name alone.
    None,
}

/// Why a file belongs to the recording of another file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum JoinReason {
    /// The caller named the recording.
    Stated,
    /// The files have the same folder and name.
    FolderAndName,
    /// The file is a version of one of the recording.
    FileVersion,
    /// An annotation file names the film.
    NamedFilm,
    /// It is the only file of its kind beside the only movement of a folder.
    OnlyInFolder,
    /// Their timecodes overlap.
    Timecode,
    /// They have the same name in different folders.
    NameElsewhere,
}

impl JoinReason {
    /// Returns the reason in words.
    #[must_use]
    pub fn join_reason_text(self) -> &'static str {
        match self {
            Self::Stated => "the recording was named",
            Self::FolderAndName => "same folder and name",
            Self::FileVersion => "a version of the same file",
            Self::NamedFilm => "the annotation file names the film",
            Self::OnlyInFolder => "the only one of its kind beside the movement of the folder",
            Self::Timecode => "same timecode",
            Self::NameElsewhere => "same name in another folder",
        }
    }
}

/// The file that another one was joined with, and why.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FileJoin {
    /// The newest other file of the recording.
    pub with: String,
    /// The reason.
    pub by: JoinReason,
}

/// A recording that files of an import joined.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct JoinedRecording {
    /// The name of the recording.
    pub recording: String,
    /// The file that the first of them joined.
    pub with: String,
    /// The files that joined it.
    pub files: Vec<JoinedFile>,
}

/// A file that joined a recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct JoinedFile {
    /// The file.
    pub path: String,
    /// The reason.
    pub by: JoinReason,
}

/// Returns the recordings that files joined, in the order of their files.
pub(super) fn joined_recordings(files: &[FileReport]) -> Vec<JoinedRecording> {
    let mut recordings: Vec<JoinedRecording> = Vec::new();
    for file in files {
        let Some((join, name)) = file.joined.as_ref().zip(file.recording.as_ref()) else {
            continue;
        };
        let joined_file = JoinedFile {
            path: file.path.clone(),
            by: join.by,
        };
        match recordings.iter_mut().find(|other| other.recording == *name) {
            Some(other) => other.files.push(joined_file),
            None => recordings.push(JoinedRecording {
                recording: name.clone(),
                with: join.with.clone(),
                files: vec![joined_file],
            }),
        }
    }
    recordings
}

/// The number of recordings that a question names.
const MAX_NAMED_CANDIDATES: usize = 5;

impl ImportJob<'_> {
    /// Notes that the file joins a recording, for the report; nothing is noted if the recording has no other file.
    pub(super) fn note_file_join(&mut self, recording: i64, by: JoinReason) {
        let with = self.places.newest_file_path(recording, &self.place).map(str::to_owned);
        self.joined = with.map(|with| FileJoin { with, by });
    }

    /// Returns whether the caller's signer is another person than the one of a recording.
    pub(super) fn is_other_signer(&self, recording: i64) -> CorpusResult<bool> {
        let theirs = stored_recordings::load_recording_row(self.connection, recording)?.signer;
        let both = self.options.signer.as_ref().zip(theirs.as_ref());
        // A signer that is unknown on either side contradicts nothing.
        Ok(both.is_some_and(|(own, theirs)| own != theirs))
    }

    /// Returns the recording that the name of the file suggests though it lies in another folder, if the caller joins by
    /// name and one is nearer than all others; otherwise reports the candidates as a question.
    pub(super) fn join_by_name_elsewhere(
        &mut self,
        candidates: &[NamedRecording],
        report: &mut FileReport,
    ) -> CorpusResult<Option<i64>> {
        let mut likely = Vec::with_capacity(candidates.len());
        for candidate in candidates {
            // Takes of the same name by other signers are what separate folders are usually for.
            if !self.is_other_signer(candidate.id)? {
                likely.push(*candidate);
            }
        }
        let nearest = match likely.as_slice() {
            [one] => Some(*one),
            // The candidates are sorted by nearness, so only the second one can be as near as the first.
            [first, second, ..] if first.shared_folders > second.shared_folders => Some(*first),
            _ => None,
        };
        match (self.options.joining, nearest) {
            (FileJoining::Name, Some(nearest)) => {
                self.note_file_join(nearest.id, JoinReason::NameElsewhere);
                Ok(Some(nearest.id))
            }
            // The caller wants no joins by name, so a question about them would only disturb.
            (FileJoining::None, _) => Ok(None),
            _ => {
                let ids: Vec<i64> = likely.iter().map(|candidate| candidate.id).collect();
                self.report_join_question(JoinQuestion::NameElsewhere, &ids, report)?;
                Ok(None)
            }
        }
    }

    /// Reports recordings that the file may belong to and was not joined with.
    pub(super) fn report_join_question(
        &self,
        question: JoinQuestion,
        candidates: &[i64],
        report: &mut FileReport,
    ) -> CorpusResult<()> {
        let mut names = Vec::with_capacity(candidates.len());
        for &id in candidates.iter().take(MAX_NAMED_CANDIDATES) {
            let name = stored_recordings::load_recording_row(self.connection, id)?.name;
            names.push(match self.places.newest_file_path(id, &self.place) {
                Some(path) => format!("{name:?} ({path})"),
                None => format!("{name:?}"),
            });
        }
        if candidates.len() > MAX_NAMED_CANDIDATES {
            names.push("…".to_owned());
        }
        let names = names.join(", ");
        let (message, remedy) = match (question, candidates.len()) {
            (_, 0) => return Ok(()),
            (JoinQuestion::NameElsewhere, 1) => (
                format!("the recording {names} has its name in another folder: it was not joined with that"),
                join_by_name_remedy(),
            ),
            (JoinQuestion::NameElsewhere, _) => (
                format!("several recordings have its name in other folders, and it was joined with none: {names}"),
                join_by_name_remedy(),
            ),
            (JoinQuestion::NamedFilm, _) => (
                format!("the annotations of several recordings name this film, and it was joined with none: {names}"),
                join_into_remedy(),
            ),
            (JoinQuestion::Timecode, 1) => (
                format!("its timecodes are those of the recording {names}: it was not joined with that"),
                join_by_timecode_remedy(),
            ),
            (JoinQuestion::Timecode, _) => (
                format!("its timecodes are those of several recordings, and it was joined with none: {names}"),
                join_by_timecode_remedy(),
            ),
        };
        report.findings.push(ReportFinding::finding_warning(message, remedy));
        Ok(())
    }

    /// Returns the recording of the film that annotations name by its path, if the film was imported and there is one.
    pub(super) fn recording_of_named_film(&self, transcript: &AnnotationTranscript) -> Option<i64> {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let urls = transcript
            .media
            .iter()
            .flat_map(|media| media.relative_url.iter().chain(Some(&media.url)));
        let mut recording_ids: Vec<i64> = urls
            .filter_map(|url| {
                let path = candidate_media_paths(url, folder)
                    .into_iter()
                    .find(|path| path.is_file())?;
                let place = relative_file_path(&absolute(&path), self.base);
                self.places.find_file_at(&place, FILM_KIND)?.recording_id
            })
            .collect();
        // The path and the relative path usually lead to the same film.
        recording_ids.dedup();
        match recording_ids.as_slice() {
            [one] => Some(*one),
            _ => None,
        }
    }

    /// Reports that the corpus has the same bytes from another path, whatever the kind of the file.
    pub(super) fn report_equal_bytes(&self, report: &mut FileReport) -> CorpusResult<()> {
        let elsewhere = |path: &&str| *path != self.place;
        let same_files = self
            .places
            .files_with_hash(&self.hash)
            .filter(|row| row.kind == self.kind);
        let mut same_places =
            same_files.filter_map(|row| Some((row.path.as_deref().filter(elsewhere)?, row.recording_id)));
        let Some((path, recording)) = same_places.next() else {
            return Ok(());
        };
        let message = match recording {
            Some(id) => {
                let name = stored_recordings::load_recording_row(self.connection, id)?.name;
                format!("its bytes are the same as those of {path}, of the recording {name:?}")
            }
            None => format!("its bytes are the same as those of {path}"),
        };
        let remedy = ErrorRemedy::command_remedy(
            "if it is a copy, it counts twice: `chereme undo`, and import one of them; else nothing is to be done",
        );
        report.findings.push(ReportFinding::finding_warning(message, remedy));
        Ok(())
    }
}

/// The evidence for a join that is not certain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JoinQuestion {
    NameElsewhere,
    NamedFilm,
    Timecode,
}

fn join_into_remedy() -> ErrorRemedy {
    ErrorRemedy::command_remedy("if it belongs to one of them: `chereme undo`, then import it with --into RECORDING")
}

fn join_by_name_remedy() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(
        RemedyChoice::Joining,
        "if they are of one take: `chereme undo`, then import it with --into RECORDING, or all \
files with --join name, which joins those whose name only one recording has",
    )
}

fn join_by_timecode_remedy() -> ErrorRemedy {
    ErrorRemedy::choice_remedy(
        RemedyChoice::Joining,
        "if they are of one take: `chereme undo`, then import it with --into RECORDING, or \
with --join timecode, which also joins files of other folders, of one kind, of unlike length, and from 00:00:00:00 or \
10:00:00:00",
    )
}
