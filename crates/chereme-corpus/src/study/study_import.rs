//! Answers that participants sent back, from files.

use std::path::{Path, PathBuf};

use chereme_sign::ErrorRemedy;
use rusqlite::Connection;
use serde::Serialize;

use super::stored::StoredStudy;
use super::study_answers::StudyParticipant;
use super::study_files::{self, FileFindings, FromFile, list_answer_files};
use super::wide::{ColumnMap, ColumnUse};
use super::{find_stored_study, fits, stored, study_long};
use crate::Corpus;
use crate::db::stored_studies as db;
use crate::error::{CorpusError, CorpusResult};
use crate::import::FileStatus;
use crate::paths::legible_path_text;
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;
use crate::words::effect::OperationEffect;

/// The report of an import of answers.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct AnswersReport {
    /// The study.
    pub study: String,
    /// How many participants are new.
    pub added: u64,
    /// How many unfinished ones were replaced by later answers.
    pub replaced: u64,
    /// How many were known already.
    pub unchanged: u64,
    /// The number of answers that were stored.
    pub answers: u64,
    /// The report of each file.
    pub files: Vec<AnswersFile>,
}

/// The report of a file of answers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnswersFile {
    /// The file.
    pub path: String,
    /// The result.
    pub status: FileStatus,
    /// The codes of its participants.
    pub participants: Vec<String>,
    /// Its oddities, or the reason why it was refused.
    pub findings: Vec<ReportFinding>,
    /// The use of its columns, if it was read by a map.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub columns: Vec<ColumnUse>,
}

/// A text with the name of its file, which messages name.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct NamedText {
    /// The text.
    pub text: String,
    /// The file.
    pub file: String,
}

/// The settings of an import of answers.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct AnswersOptions {
    /// The map of the columns of tables with one participant a row, itself a table.
    pub columns: Option<NamedText>,
    /// Whether the import is only tried: it reports the same, and nothing is stored.
    pub dry_run: bool,
}

impl Corpus {
    /// Imports answers to a study: files of the questionnaire (`.json`), tables in the long form (`.csv`), or folders of
    /// both. Answers that do not fit the plan are left out, with a finding. A file that was imported before changes
    /// nothing; later answers replace those of a participant who had not finished.
    ///
    /// The options may name a map of columns, which reads tables of LimeSurvey or Qualtrics, one participant a row. The map is a table, too: a title in the column `column`, and either
    /// `item`, `condition`, `question` (and `part`, `role`) or `means`: `participant`, `language`, `started_day`, `finished`,
    /// `profile.NAME`, `consent.NAME`. Codes of answers stand under `values`, as `A1=left; A2=right`. The report has the use
    /// of each column.
    ///
    /// # Errors
    /// Fails if there is no such study, a path leads nowhere, or the map names something that the plan does not have; a file
    /// with a fault is reported, and the others imported.
    pub fn import_answers(
        &mut self,
        study: &str,
        paths: &[PathBuf],
        options: &AnswersOptions,
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<AnswersReport> {
        let mut files = Vec::new();
        for path in paths {
            list_answer_files(path, 0, &mut files)?;
        }
        if files.is_empty() {
            let place = paths.first().map(|path| path.display().to_string());
            return Err(CorpusError::from_wrong_message("there are no files of answers")
                .with_error_place(place.unwrap_or_default())
                .with_advice("answers are files that end in .json or .csv"));
        }
        let mut tried = None;
        let carry = |connection: &Connection, progress: &mut ProgressReceiver<'_>| {
            let report = import_answer_files(connection, study, &files, options, progress)?;
            if options.dry_run {
                tried = Some(report);
                // An error rolls the attempt back.
                return Err(CorpusError::Stopped);
            }
            let effect = OperationEffect::ImportAnswers {
                study: report.study.clone(),
                participants: (report.added + report.replaced) as u64,
            };
            Ok((report, effect))
        };
        let done = self.store.operation_with_progress(progress, carry);
        tried.map_or(done, Ok)
    }

    /// Reads a text that is made into a plan, a table of trials or a map of columns.
    ///
    /// # Errors
    /// Fails if the file cannot be read, is very large, or holds no text in UTF-8.
    pub fn read_study_text(path: &Path) -> CorpusResult<NamedText> {
        let file = legible_path_text(path);
        let text = study_files::read_answers_text(path).map_err(|error| error.with_error_place(file.clone()))?;
        Ok(NamedText { text, file })
    }

    /// Writes all answers to a study as a table in the long form, one answer a row; import reads it again.
    ///
    /// # Errors
    /// Fails if there is no such study, or the file exists and `force` is not set.
    pub fn export_answers(&self, study: &str, to: &Path, force: bool) -> CorpusResult<u64> {
        let study = self.study_with_answers(study)?;
        crate::atomic_write::write_atomically(to, force, |out| {
            study_long::write_long_answers(&study.plan, &study.participants, out)
        })?;
        Ok(study
            .participants
            .iter()
            .map(|person| person.answers.len() as u64)
            .sum())
    }
}

/// Imports files of answers.
fn import_answer_files(
    connection: &Connection,
    study: &str,
    files: &[PathBuf],
    options: &AnswersOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<AnswersReport> {
    let stored_study = find_stored_study(connection, study)?;
    let map_text = options.columns.as_ref();
    let map =
        map_text.map(|named_text| ColumnMap::read_column_map(&named_text.text, &named_text.file, &stored_study.plan));
    let map = map.transpose()?;
    let mut report = AnswersReport {
        study: stored_study.plan.name.clone(),
        ..AnswersReport::default()
    };
    let work = AnswersImport {
        connection,
        study: &stored_study,
        map: map.as_ref(),
    };
    for (done, path) in files.iter().enumerate() {
        progress.report_items("reading answers", done, files.len())?;
        work.import_answers_file(path, &mut report)?;
    }
    Ok(report)
}

/// The outcome of the import for a participant.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ParticipantOutcome {
    Added,
    Replaced,
    Unchanged,
    Refused,
}

struct AnswersImport<'c> {
    connection: &'c Connection,
    study: &'c StoredStudy,
    map: Option<&'c ColumnMap>,
}

impl AnswersImport<'_> {
    fn import_answers_file(&self, path: &Path, report: &mut AnswersReport) -> CorpusResult<()> {
        let mut findings = FileFindings::default();
        let read = study_files::read_answers_file(path, self.study, self.map, &mut findings);
        let (people, columns) = read.unwrap_or_else(|error| {
            findings.add_file_finding("error", None, error.to_string(), error.error_remedy());
            Default::default()
        });
        let mut codes = Vec::new();
        let mut became = Vec::new();
        for it in people {
            let before = it.participant.answers.len();
            let (person, result) = self.import_participant(it, &mut findings)?;
            became.push(result);
            match result {
                ParticipantOutcome::Added => report.added += 1,
                ParticipantOutcome::Replaced => report.replaced += 1,
                ParticipantOutcome::Unchanged => report.unchanged += 1,
                ParticipantOutcome::Refused => continue,
            }
            codes.push(person.code);
            if result != ParticipantOutcome::Unchanged {
                report.answers += person.answers.len().min(before) as u64;
            }
        }
        let status = if became.contains(&ParticipantOutcome::Added) {
            FileStatus::Imported
        } else if became.contains(&ParticipantOutcome::Replaced) {
            FileStatus::Updated
        } else if became.contains(&ParticipantOutcome::Unchanged) {
            FileStatus::Unchanged
        } else {
            FileStatus::Refused
        };
        report.files.push(AnswersFile {
            path: legible_path_text(path),
            status,
            participants: codes,
            findings: findings.finish_findings(),
            columns,
        });
        Ok(())
    }

    /// Checks a participant and stores what fits the plan.
    fn import_participant(
        &self,
        it: FromFile,
        findings: &mut FileFindings,
    ) -> CorpusResult<(StudyParticipant, ParticipantOutcome)> {
        let FromFile {
            participant: mut person,
            lines,
        } = it;
        person.code = person.code.trim().to_owned();
        if let Some((message, remedy)) = fits::refuse_participant(&self.study.plan, &self.study.sha256, &person) {
            let line = lines.first().copied();
            findings.refuse_answers(line, message, remedy);
            return Ok((person, ParticipantOutcome::Refused));
        }
        person.study.clone_from(&self.study.plan.name);
        person.started_day = fits::normalize_day(&person.started_day);
        if !["en", "fr"].contains(&person.language.as_str()) {
            person.language.clear();
        }
        if !person.device.dpr.is_finite() {
            person.device.dpr = 0.0;
        }
        fits::drop_unoffered_profile(&self.study.plan, &mut person, findings);
        fits::drop_unfit_answers(&self.study.plan, &mut person, &lines, findings);
        fits::drop_skipped_trials(&mut person, findings);
        let code = Some(person.code.as_str());
        let known_people = db::load_study_participants(self.connection, self.study.id, code)?;
        let Some((row, finished)) = known_people.first().map(|(row, it)| (*row, it.finished)) else {
            stored::store_study_participant(self.connection, self.study.id, &person)?;
            return Ok((person, ParticipantOutcome::Added));
        };
        let stored_people = stored::stored_participants(self.connection, self.study, code)?;
        let before = stored_people.into_iter().next();
        if before.as_ref() == Some(&person) {
            return Ok((person, ParticipantOutcome::Unchanged));
        }
        if let Some(before) = before.as_ref().filter(|other| other.seed != person.seed) {
            let message = format!(
                "another participant has the code {:?}, whose answers stay: the seeds are {} and {}",
                person.code, before.seed, person.seed
            );
            let remedy = ErrorRemedy::command_remedy(
                "if they are two people, write another code into this file; if not, delete the earlier answers with `chereme study forget CORPUS NAME CODE`; then import again",
            );
            findings.add_file_finding("warning", None, message, Some(remedy));
            return Ok((person, ParticipantOutcome::Refused));
        }
        let earlier = before.map_or(0, |participant| participant.answers.len());
        if finished {
            let message = format!(
                "the participant {:?} has finished before with other answers, which stay",
                person.code
            );
            let remedy = ErrorRemedy::command_remedy(
                "if these are the right ones, delete the others with `chereme study forget CORPUS NAME CODE` and import again",
            );
            findings.add_file_finding("warning", None, message, Some(remedy));
            return Ok((person, ParticipantOutcome::Refused));
        }
        if !person.finished && person.answers.len() < earlier {
            let message = format!(
                "the participant {:?} has {earlier} answers, more than this file, and they stay",
                person.code
            );
            findings.add_file_finding("warning", None, message, None);
            return Ok((person, ParticipantOutcome::Refused));
        }
        db::delete_participant(self.connection, row)?;
        stored::store_study_participant(self.connection, self.study.id, &person)?;
        Ok((person, ParticipantOutcome::Replaced))
    }
}

#[cfg(test)]
mod tests;
