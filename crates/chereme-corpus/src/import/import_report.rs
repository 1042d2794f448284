//! The report of an import, file by file.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use chereme_motion::RecordingInstant;
use chereme_sign::{ErrorRemedy, RemedyChoice};
use serde::Serialize;

use super::OwnEdits;
use super::import_joining::{FileJoin, JoinedRecording};
use super::understood::FileInterpretation;
use crate::error::CorpusError;
use crate::paths::legible_path_text;
use crate::report_finding::ReportFinding;
use crate::words::effect::OperationEffect;

/// The report of an import.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ImportReport {
    /// Number of created rows of each kind.
    pub created: BTreeMap<&'static str, u64>,
    /// Number of changed rows of each kind.
    pub changed: BTreeMap<&'static str, u64>,
    /// Number of removed rows of each kind.
    pub removed: BTreeMap<&'static str, u64>,
    /// The report of each file.
    pub files: Vec<FileReport>,
    /// The recordings that files joined, and why each file did.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub joined: Vec<JoinedRecording>,
    /// Oddities of the import as a whole, such as a mapping that names no tier of any file.
    pub findings: Vec<ReportFinding>,
    /// Whether nothing was written because the caller asked for a dry run.
    pub dry_run: bool,
    #[serde(skip)]
    pub(super) complete: bool,
}

/// The report of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FileReport {
    /// The file.
    pub path: String,
    /// The result: imported, unchanged, refused and so on.
    pub status: FileStatus,
    /// The recording that it became or was added to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub recording: Option<String>,
    /// The file of that recording that it was joined with, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joined: Option<FileJoin>,
    /// Its interpretation: unit and axes, joint roles, tiers, columns.
    #[serde(skip_serializing_if = "FileInterpretation::is_empty")]
    pub understood: Box<FileInterpretation>,
    /// Its oddities, or the reason why it was refused.
    pub findings: Vec<ReportFinding>,
    /// Edits in the corpus that the file contradicts, and the outcome of each. If the file is refused because of them,
    /// it can be imported with another [`OwnEdits`](super::OwnEdits).
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<OwnEdit>,
}

/// An annotation that was edited in the corpus, and that differs in a file imported again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OwnEdit {
    /// The name of the tier.
    pub tier: String,
    /// The annotation in the corpus; nothing if it was removed there.
    pub mine: Option<AnnotationSide>,
    /// The annotation in the file; nothing if the file no longer has it.
    pub theirs: Option<AnnotationSide>,
    /// The outcome.
    pub outcome: EditOutcome,
}

/// The value of an annotation, and its time.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct AnnotationSide {
    /// Its start in microseconds, in whole milliseconds as in files.
    pub start_us: i64,
    /// Its end in microseconds, in whole milliseconds.
    pub end_us: i64,
    /// Its value.
    pub value: String,
}

/// The outcome of an edit in the corpus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum EditOutcome {
    /// The file's annotation replaces it; if the file is refused, it would replace it.
    Lost,
    /// It stays; the file did not change the annotation.
    Kept,
    /// It stays, though the file changed the same annotation.
    Conflict,
}

impl OwnEdit {
    /// Returns an annotation as text, with its times if those of the two sides differ.
    fn side_as_text(&self, side: &AnnotationSide) -> String {
        let times = |saying: &AnnotationSide| (saying.start_us, saying.end_us);
        let both = self.mine.as_ref().zip(self.theirs.as_ref());
        let differ = both.is_some_and(|(mine, theirs)| times(mine) != times(theirs));
        let [start, end] = [side.start_us, side.end_us].map(RecordingInstant::from_micros);
        if differ {
            format!("{:?} (from {start} to {end})", side.value)
        } else {
            format!("{:?}", side.value)
        }
    }
}

impl fmt::Display for OwnEdit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let any = self.mine.as_ref().or(self.theirs.as_ref());
        let start = RecordingInstant::from_micros(any.map_or(0, |saying| saying.start_us));
        write!(f, "tier {:?} at {start}: ", self.tier)?;
        let text = |side: &Option<AnnotationSide>| side.as_ref().map(|saying| self.side_as_text(saying));
        let (mine, theirs) = (text(&self.mine), text(&self.theirs));
        match (mine, theirs, self.outcome) {
            (Some(mine), Some(theirs), EditOutcome::Lost) => {
                write!(f, "your {mine} gives way to the file's {theirs}")
            }
            (Some(mine), None, EditOutcome::Lost) => {
                write!(f, "your {mine} goes: the file does not have it")
            }
            (None, theirs, EditOutcome::Lost) => {
                let theirs = theirs.unwrap_or_default();
                write!(f, "the file's {theirs} comes back, which you removed")
            }
            (Some(mine), Some(theirs), EditOutcome::Kept) => {
                write!(f, "your {mine} stays; the file still says {theirs}")
            }
            (Some(mine), Some(theirs), EditOutcome::Conflict) => {
                write!(f, "both were changed: your {mine} stays, the file says {theirs}")
            }
            (Some(mine), None, _) => {
                write!(f, "your {mine} stays, though the file has removed it")
            }
            (None, theirs, _) => {
                let theirs = theirs.unwrap_or_default();
                write!(
                    f,
                    "the file's {theirs} is left out: you removed it, or it overlaps what you changed"
                )
            }
        }
    }
}

/// Number of rows of each kind that a file created, changed and removed.
#[derive(Debug, Clone, Default)]
pub(super) struct RowChangeCounts {
    pub(super) created: BTreeMap<&'static str, u64>,
    pub(super) changed: BTreeMap<&'static str, u64>,
    pub(super) removed: BTreeMap<&'static str, u64>,
}

impl RowChangeCounts {
    pub(super) fn count_added_rows(&mut self, what: &'static str, many: usize) {
        *self.created.entry(what).or_default() += many as u64;
    }

    /// Returns the number of all rows.
    pub(super) fn total_row_changes(&self) -> u64 {
        let all = [&self.created, &self.changed, &self.removed];
        all.into_iter().flat_map(|counts| counts.values()).sum()
    }

    pub(super) fn count_changed_rows(&mut self, what: &'static str, many: usize) {
        *self.changed.entry(what).or_default() += many as u64;
    }

    pub(super) fn count_removed_rows(&mut self, what: &'static str, many: usize) {
        *self.removed.entry(what).or_default() += many as u64;
    }
}

/// The result for a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FileStatus {
    /// The file was imported.
    Imported,
    /// The file was imported before and edited since; the corpus was updated.
    Updated,
    /// The file was imported before and has not changed.
    Unchanged,
    /// The file is of a kind that cannot be read.
    Skipped,
    /// The file could not be imported.
    Refused,
}

/// Files of one kind that an import left alone.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct UnreadFileKind {
    /// The ending of their names in lower case, without the dot.
    pub ending: Option<String>,
    /// The files.
    pub files: Vec<String>,
    /// The reason why they were not read.
    pub why: String,
    /// A way to make their contents readable.
    pub remedy: Option<ErrorRemedy>,
}

impl FileReport {
    pub(super) fn new(path: &Path, status: FileStatus) -> Self {
        Self {
            path: legible_path_text(path),
            status,
            recording: None,
            joined: None,
            understood: Box::default(),
            findings: Vec::new(),
            edits: Vec::new(),
        }
    }

    /// Returns the report of a file that was skipped, with the reason.
    pub(super) fn skipped_file_report(path: &Path, why: &CorpusError) -> Self {
        let mut report = Self::new(path, FileStatus::Skipped);
        report.findings.push(ReportFinding {
            severity: "note",
            line: None,
            message: why.to_string(),
            remedy: why.error_remedy(),
        });
        report
    }

    /// Returns the report of a file that the corpus already has; `earlier` is its earlier path, if that differs.
    pub(super) fn unchanged_file_report(path: &Path, earlier: Option<&str>) -> Self {
        let mut report = Self::new(path, FileStatus::Unchanged);
        let message = match earlier {
            Some(place) => format!("the same bytes were imported before, from {place}"),
            None => "the same file was imported before".to_owned(),
        };
        report.findings.push(ReportFinding::finding_note(message));
        report
    }

    pub(super) fn refused_file_report(path: &Path, error: &CorpusError) -> Self {
        let mut report = Self::new(path, FileStatus::Refused);
        let place = error.error_place().unwrap_or_default();
        let line = place.strip_prefix("line ").and_then(|line| line.parse().ok());
        report.findings.push(ReportFinding {
            severity: "error",
            line,
            message: error.to_string(),
            remedy: error.error_remedy(),
        });
        report
    }
}

impl FileReport {
    /// Leaves the corpus as it is because of edits that the file would take back, and says which.
    pub(super) fn refuse_own_edits(&mut self, own_edits: OwnEdits, edits: Vec<OwnEdit>) {
        let lost_edits = edits.iter().filter(|edit| edit.outcome == EditOutcome::Lost);
        let lost: Vec<String> = lost_edits.map(ToString::to_string).collect();
        let many = match lost.len() {
            1 => "an edit".to_owned(),
            many => format!("{many} edits"),
        };
        self.edits = edits;
        let mut lines: Vec<ReportFinding> = Vec::new();
        if own_edits == OwnEdits::Mine {
            self.status = FileStatus::Unchanged;
            lines.push(ReportFinding::finding_note(format!(
                "it would take back {many} of yours: the recording stays as it is"
            )));
            for edit in &mut self.edits {
                edit.outcome = EditOutcome::Conflict;
            }
        } else {
            self.status = FileStatus::Refused;
            lines.push(ReportFinding::finding_error(
                format!("it was changed since it was imported, and would take back {many} of yours"),
                ErrorRemedy::choice_remedy(
                    RemedyChoice::Side,
                    "import it again with --merge (your edits and the file's changes; yours where both changed \
             the same annotation), --theirs (the file), or --mine (your edits)",
                ),
            ));
            pass_first_lines(&lost, &mut |line| lines.push(ReportFinding::finding_note(line)));
        }
        // The reason of the refusal matters more than the oddities that were found before it.
        self.findings.splice(0..0, lines);
    }

    /// Adds the edits about which the user has decided, and the outcome of each.
    pub(super) fn add_own_edits(&mut self, edits: Vec<OwnEdit>) {
        let outcomes = |outcome| {
            let edits = edits.iter().filter(move |edit| edit.outcome == outcome);
            edits.map(ToString::to_string).collect::<Vec<_>>()
        };
        let warn = |remedy: ErrorRemedy| move |text: String| ReportFinding::finding_warning(text, remedy.clone());
        let lost = warn(ErrorRemedy::command_remedy("`chereme undo` takes the import back"));
        pass_first_lines(&outcomes(EditOutcome::Lost), &mut |text| self.findings.push(lost(text)));
        let conflict = warn(ErrorRemedy::command_remedy(
            "`chereme conflicts CORPUS` lists both candidates; decide there",
        ));
        pass_first_lines(&outcomes(EditOutcome::Conflict), &mut |text| {
            self.findings.push(conflict(text))
        });
        let mut note = |text: String| self.findings.push(ReportFinding::finding_note(text));
        pass_first_lines(&outcomes(EditOutcome::Kept), &mut note);
        self.edits = edits;
    }
}

/// The largest number of changes that are listed one by one.
const MAX_LISTED_CHANGES: usize = 20;

/// Passes on the first lines of many, and the number of remaining ones.
pub(super) fn pass_first_lines(lines: &[String], take: &mut dyn FnMut(String)) {
    for line in lines.iter().take(MAX_LISTED_CHANGES) {
        take(line.clone());
    }
    let more = lines.len().saturating_sub(MAX_LISTED_CHANGES);
    if more > 0 {
        take(format!("and {more} more"));
    }
}

impl ImportReport {
    /// Returns the kinds of files in the folders that were not read: their ending, the files, the reason, and a way to
    /// make their contents readable.
    #[must_use]
    pub fn unread_file_kinds(&self) -> Vec<UnreadFileKind> {
        let mut kinds: Vec<UnreadFileKind> = Vec::new();
        for file in &self.files {
            if file.status != FileStatus::Skipped {
                continue;
            }
            let ending = super::readers::lower_file_ending(Path::new(&file.path));
            let first = file.findings.first();
            let why = first.map(|finding| finding.message.clone()).unwrap_or_default();
            let same = |kind: &&mut UnreadFileKind| kind.ending == ending && kind.why == why;
            if let Some(known) = kinds.iter_mut().find(same) {
                known.files.push(file.path.clone());
                continue;
            }
            kinds.push(UnreadFileKind {
                ending,
                files: vec![file.path.clone()],
                why,
                remedy: first.and_then(|finding| finding.remedy.clone()),
            });
        }
        kinds
    }

    /// Returns whether a file was refused.
    #[must_use]
    pub fn has_refusals(&self) -> bool {
        self.files.iter().any(|file| file.status == FileStatus::Refused)
    }

    pub(super) fn import_effect(&self) -> OperationEffect {
        let imported = self
            .files
            .iter()
            .filter(|file| matches!(file.status, FileStatus::Imported | FileStatus::Updated));
        let names: Vec<&str> = imported
            .filter_map(|file| Path::new(&file.path).file_name()?.to_str())
            .collect();
        let name = |name: Option<&&str>| name.map_or_else(String::new, ToString::to_string);
        OperationEffect::Import {
            count: names.len() as u64,
            first: name(names.first()),
            last: name(names.last()),
        }
    }
}
