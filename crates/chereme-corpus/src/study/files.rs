//! Files of answers: which there are, what they hold, and what is odd about them.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use chereme_sign::Remedy;

use super::answers::Participant;
use super::fits::short;
use super::long;
use super::stored::Stored;
use super::wide::{self, ColumnMap, ColumnUse};
use crate::error::{Error, Result};
use crate::import::ReportFinding;
use crate::paths::legible;

/// The size of the largest file of answers, in bytes.
const LARGEST: u64 = 32 << 20;
/// The largest number of files of one import, and of folders inside each other.
const MOST_FILES: usize = 100_000;
const DEEPEST: usize = 8;
/// The largest number of findings that are listed for a file.
const MOST_FINDINGS: usize = 100;

/// Adds the file, or the files of a folder that may hold answers, in the order of their names.
pub(super) fn listed(path: &Path, depth: usize, files: &mut Vec<PathBuf>) -> Result<()> {
    let fault = |error| Error::file(path, error);
    if !fs::metadata(path).map_err(fault)?.is_dir() {
        files.push(path.to_owned());
    } else if depth == DEEPEST {
        let message = format!("folders lie more than {DEEPEST} deep inside each other");
        return Err(Error::wrong(message)
            .at(legible(path))
            .advise("name the folder that holds the answers"));
    } else {
        let mut inside = Vec::new();
        for entry in fs::read_dir(path).map_err(fault)? {
            let entry = entry.map_err(fault)?;
            let kind = entry.file_type().map_err(fault)?;
            let own = entry.path();
            let ending = own
                .extension()
                .map(|it| it.to_string_lossy().to_lowercase());
            let may = matches!(ending.as_deref(), Some("json" | "csv"));
            // A link to a file is read as one, a link to a folder is not followed: it could lead in circles.
            let leads_to_folder = kind.is_symlink() && own.is_dir();
            if kind.is_dir() || (may && !leads_to_folder) {
                inside.push((own, kind.is_dir()));
            }
        }
        inside.sort();
        for (own, is_folder) in inside {
            if is_folder {
                listed(&own, depth + 1, files)?;
            } else {
                files.push(own);
            }
        }
    }
    if files.len() > MOST_FILES {
        let message = format!("there are more than {MOST_FILES} files");
        return Err(Error::wrong(message).at(path.display().to_string()));
    }
    Ok(())
}

/// The findings of a file; those beyond the first ones are counted.
#[derive(Default)]
pub(super) struct Findings {
    list: Vec<ReportFinding>,
    more: usize,
}

impl Findings {
    pub(super) fn add(
        &mut self,
        severity: &'static str,
        line: Option<u64>,
        message: String,
        remedy: Option<Remedy>,
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

    pub(super) fn refuse(&mut self, line: Option<u64>, message: String, remedy: &'static str) {
        self.add("error", line, message, Some(remedy.into()));
    }

    pub(super) fn finished(mut self) -> Vec<ReportFinding> {
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
    pub(super) participant: Participant,
    pub(super) lines: Vec<u64>,
}

/// Reads a file of text.
pub(super) fn text(path: &Path) -> Result<String> {
    let fault = |error| Error::file(path, error);
    if !fs::metadata(path).map_err(fault)?.is_file() {
        return Err(Error::wrong("it is no regular file"));
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(fault)?;
    file.take(LARGEST + 1)
        .read_to_end(&mut bytes)
        .map_err(fault)?;
    if bytes.len() as u64 > LARGEST {
        return Err(Error::wrong(format!(
            "the file has more than {LARGEST} bytes"
        )));
    }
    String::from_utf8(bytes).map_err(|_| {
        Error::wrong("the file is no text in UTF-8").advise("save it as text in UTF-8")
    })
}

/// Reads a file of answers; a table by the map of its columns, if there is one, and then returns their use.
pub(super) fn read(
    path: &Path,
    study: &Stored,
    map: Option<&ColumnMap>,
    findings: &mut Findings,
) -> Result<(Vec<FromFile>, Vec<ColumnUse>)> {
    let text = text(path)?;
    let text = text.trim_start_matches('\u{feff}');
    if text.trim_start().starts_with('{') {
        return match serde_json::from_str::<Participant>(text) {
            Ok(participant) => {
                let lines = Vec::new();
                Ok((vec![FromFile { participant, lines }], Vec::new()))
            }
            Err(error) => {
                let line = Some(error.line() as u64).filter(|line| *line > 0);
                let message = format!("the answers cannot be read: {error}");
                findings.refuse(
                    line,
                    message,
                    "import the files that the questionnaire saves",
                );
                Ok((Vec::new(), Vec::new()))
            }
        };
    }
    if let Some(map) = map {
        let by = (map, &study.plan, study.sha256.as_str());
        return wide::read(text, &legible(path), by, findings);
    }
    let (people, unknown) = long::read(text, &legible(path))?;
    for title in unknown {
        let message = format!(
            "the column {:?} is not known and was left out",
            short(&title)
        );
        findings.add("note", None, message, None);
    }
    let mut read = Vec::with_capacity(people.len());
    for it in people {
        for (line, reason) in it.unread {
            let message = format!("a row was left out: {reason}");
            findings.add("warning", Some(line), message, None);
        }
        read.push(FromFile {
            participant: it.participant,
            lines: it.lines,
        });
    }
    Ok((read, Vec::new()))
}
