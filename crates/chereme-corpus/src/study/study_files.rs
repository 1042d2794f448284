//! Files of answers: which there are, what they hold, and what is odd about them.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use chereme_sign::ErrorRemedy;

use super::fits::shorten_message_text;
use super::stored::StoredStudy;
use super::study_answers::StudyParticipant;
use super::study_long;
use super::wide::{self, ColumnMap, ColumnUse};
use crate::error::{CorpusError, CorpusResult};
use crate::paths::legible_path_text;
use crate::report_finding::ReportFinding;

/// The size of the largest file of answers, in bytes.
const MAX_ANSWERS_FILE_BYTES: u64 = 32 << 20;
/// The largest number of files of one import, and of folders inside each other.
const MOST_FILES: usize = 100_000;
const MAX_ANSWERS_FOLDER_DEPTH: usize = 8;
/// The largest number of findings that are listed for a file.
const MOST_FINDINGS: usize = 100;

/// Adds the file, or the files of a folder that may hold answers, in the order of their names.
pub(super) fn list_answer_files(path: &Path, depth: usize, files: &mut Vec<PathBuf>) -> CorpusResult<()> {
    let fault = |error| CorpusError::from_file_failure(path, error);
    if !fs::metadata(path).map_err(fault)?.is_dir() {
        files.push(path.to_owned());
    } else if depth == MAX_ANSWERS_FOLDER_DEPTH {
        let message = format!("folders lie more than {MAX_ANSWERS_FOLDER_DEPTH} deep inside each other");
        return Err(CorpusError::from_wrong_message(message)
            .with_error_place(legible_path_text(path))
            .with_advice("name the folder that holds the answers"));
    } else {
        let mut inside = Vec::new();
        for entry in fs::read_dir(path).map_err(fault)? {
            let entry = entry.map_err(fault)?;
            let kind = entry.file_type().map_err(fault)?;
            let entry_path = entry.path();
            let ending = entry_path
                .extension()
                .map(|suffix| suffix.to_string_lossy().to_lowercase());
            let may = matches!(ending.as_deref(), Some("json" | "csv"));
            // A link to a file is read as one, a link to a folder is not followed: it could lead in circles.
            let leads_to_folder = kind.is_symlink() && entry_path.is_dir();
            if kind.is_dir() || (may && !leads_to_folder) {
                inside.push((entry_path, kind.is_dir()));
            }
        }
        inside.sort();
        for (own, is_folder) in inside {
            if is_folder {
                list_answer_files(&own, depth + 1, files)?;
            } else {
                files.push(own);
            }
        }
    }
    if files.len() > MOST_FILES {
        let message = format!("there are more than {MOST_FILES} files");
        return Err(CorpusError::from_wrong_message(message).with_error_place(path.display().to_string()));
    }
    Ok(())
}

/// The findings of a file; those beyond the first ones are counted.
#[derive(Default)]
pub(super) struct FileFindings {
    list: Vec<ReportFinding>,
    more: usize,
}

impl FileFindings {
    pub(super) fn add_file_finding(
        &mut self,
        severity: &'static str,
        line: Option<u64>,
        message: String,
        remedy: Option<ErrorRemedy>,
    ) {
        if self.list.len() < MOST_FINDINGS {
            self.list.push(ReportFinding {
                severity,
                line,
                message,
                remedy,
            });
        } else {
            self.more += 1;
        }
    }

    pub(super) fn refuse_answers(&mut self, line: Option<u64>, message: String, remedy: &'static str) {
        self.add_file_finding("error", line, message, Some(remedy.into()));
    }

    pub(super) fn finish_findings(mut self) -> Vec<ReportFinding> {
        if self.more > 0 {
            self.list.push(ReportFinding {
                severity: "warning",
                line: None,
                message: format!("and {} more findings", self.more),
                remedy: None,
            });
        }
        self.list
    }
}

/// A participant as a file has it; the lines of the answers, if the file is a table.
pub(super) struct FromFile {
    pub(super) participant: StudyParticipant,
    pub(super) lines: Vec<u64>,
}

/// Reads a file of text.
pub(super) fn read_answers_text(path: &Path) -> CorpusResult<String> {
    let fault = |error| CorpusError::from_file_failure(path, error);
    if !fs::metadata(path).map_err(fault)?.is_file() {
        return Err(CorpusError::from_wrong_message("it is no regular file"));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(fault)?;
    file.take(MAX_ANSWERS_FILE_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(fault)?;
    if bytes.len() as u64 > MAX_ANSWERS_FILE_BYTES {
        return Err(CorpusError::from_wrong_message(format!(
            "the file has more than {MAX_ANSWERS_FILE_BYTES} bytes"
        )));
    }
    String::from_utf8(bytes).map_err(|_| {
        CorpusError::from_wrong_message("the file is no text in UTF-8").with_advice("save it as text in UTF-8")
    })
}

/// Reads a file of answers; a table by the map of its columns, if there is one, and then returns their use.
pub(super) fn read_answers_file(
    path: &Path,
    study: &StoredStudy,
    map: Option<&ColumnMap>,
    findings: &mut FileFindings,
) -> CorpusResult<(Vec<FromFile>, Vec<ColumnUse>)> {
    let raw_text = read_answers_text(path)?;
    let text = raw_text.trim_start_matches('\u{feff}');
    if text.trim_start().starts_with('{') {
        return match serde_json::from_str::<StudyParticipant>(text) {
            Ok(participant) => {
                let lines = Vec::new();
                Ok((vec![FromFile { participant, lines }], Vec::new()))
            }
            Err(error) => {
                let line = Some(error.line() as u64).filter(|line| *line > 0);
                let message = format!("the answers cannot be read: {error}");
                findings.refuse_answers(line, message, "import the files that the questionnaire saves");
                Ok((Vec::new(), Vec::new()))
            }
        };
    }
    if let Some(map) = map {
        let file = legible_path_text(path);
        return wide::read_wide_answers(text, &file, map, &study.plan, &study.sha256, findings);
    }
    let (people, unknown) = study_long::read_long_answers(text, &legible_path_text(path))?;
    for title in unknown {
        let message = format!(
            "the column {:?} is not known and was left out",
            shorten_message_text(&title)
        );
        findings.add_file_finding("note", None, message, None);
    }
    let mut read = Vec::with_capacity(people.len());
    for it in people {
        for (line, reason) in it.unread {
            let message = format!("a row was left out: {reason}");
            findings.add_file_finding("warning", Some(line), message, None);
        }
        read.push(FromFile {
            participant: it.participant,
            lines: it.lines,
        });
    }
    Ok((read, Vec::new()))
}
