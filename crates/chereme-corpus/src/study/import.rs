//! Answers that participants sent back, from files.

use std::path::{Path, PathBuf};

use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::Serialize;

use super::answers::Participant;
use super::files::{self, Findings, FromFile, listed};
use super::stored::Stored;
use super::wide::{ColumnMap, ColumnUse};
use super::{fits, found, long, stored};
use crate::Corpus;
use crate::db::studies as db;
use crate::error::{Error, Result};
use crate::import::{FileStatus, ReportFinding};
use crate::paths::legible;
use crate::progress::{Progress, Step, Unit};
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
    /// # Errors
    /// Fails if there is no such study or a path leads nowhere; a file with a fault is reported, and the others imported.
    pub fn import_answers(
        &mut self,
        study: &str,
        paths: &[PathBuf],
        progress: &mut Progress<'_>,
    ) -> Result<AnswersReport> {
        self.import_answers_by(study, paths, &AnswersOptions::default(), progress)
    }

    /// Imports answers as [`import_answers`](Self::import_answers) does, and reads tables by a map of their columns: tables
    /// of LimeSurvey or Qualtrics, one participant a row. The map is a table, too: a title in the column `column`, and either
    /// `item`, `condition`, `question` (and `part`, `role`) or `means`: `participant`, `language`, `started_day`, `finished`,
    /// `profile.NAME`, `consent.NAME`. Codes of answers stand under `values`, as `A1=left; A2=right`. The report has the use
    /// of each column.
    ///
    /// # Errors
    /// Those of [`import_answers`](Self::import_answers); fails if the map names something that the plan does not have.
    pub fn import_answers_by(
        &mut self,
        study: &str,
        paths: &[PathBuf],
        options: &AnswersOptions,
        progress: &mut Progress<'_>,
    ) -> Result<AnswersReport> {
        let mut files = Vec::new();
        for path in paths {
            listed(path, 0, &mut files)?;
        }
        if files.is_empty() {
            let place = paths.first().map(|it| it.display().to_string());
            return Err(Error::wrong("there are no files of answers")
                .at(place.unwrap_or_default())
                .advise("answers are files that end in .json or .csv"));
        }
        let mut tried = None;
        let carry = |connection: &Connection, progress: &mut Progress<'_>| {
            let report = import(connection, study, (&files, options), progress)?;
            if options.dry_run {
                tried = Some(report);
                // An error rolls the attempt back.
                return Err(Error::Stopped);
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
    pub fn read_study_text(path: &Path) -> Result<NamedText> {
        let file = legible(path);
        let text = files::text(path).map_err(|it| it.at(file.clone()))?;
        Ok(NamedText { text, file })
    }

    /// Writes all answers to a study as a table in the long form, one answer a row; import reads it again.
    ///
    /// # Errors
    /// Fails if there is no such study, or the file exists and `force` is not set.
    pub fn export_answers(&self, study: &str, to: &Path, force: bool) -> Result<u64> {
        let study = self.study(study)?;
        crate::picture::write(to, force, |out| {
            long::write(&study.plan, &study.participants, out)
        })?;
        Ok(study
            .participants
            .iter()
            .map(|it| it.answers.len() as u64)
            .sum())
    }
}

/// Imports files of answers.
fn import(
    connection: &Connection,
    study: &str,
    (files, options): (&[PathBuf], &AnswersOptions),
    progress: &mut Progress<'_>,
) -> Result<AnswersReport> {
    let found = found(connection, study)?;
    let map = options.columns.as_ref();
    let map = map.map(|it| ColumnMap::read(&it.text, &it.file, &found.plan));
    let map = map.transpose()?;
    let mut report = AnswersReport {
        study: found.plan.name.clone(),
        ..AnswersReport::default()
    };
    let work = Work {
        connection,
        study: &found,
        map: map.as_ref(),
    };
    for (done, path) in files.iter().enumerate() {
        progress.report(Step {
            task: "reading answers",
            done: done as u64,
            total: Some(files.len() as u64),
            unit: Unit::Items,
        })?;
        work.file(path, &mut report)?;
    }
    Ok(report)
}

/// The outcome of the import for a participant.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Became {
    Added,
    Replaced,
    Unchanged,
    Refused,
}

struct Work<'c> {
    connection: &'c Connection,
    study: &'c Stored,
    map: Option<&'c ColumnMap>,
}

impl Work<'_> {
    fn file(&self, path: &Path, report: &mut AnswersReport) -> Result<()> {
        let mut findings = Findings::default();
        let read = files::read(path, self.study, self.map, &mut findings);
        let (people, columns) = read.unwrap_or_else(|error| {
            findings.add("error", None, error.to_string(), error.remedy());
            Default::default()
        });
        let mut codes = Vec::new();
        let mut became = Vec::new();
        for it in people {
            let before = it.participant.answers.len();
            let (person, result) = self.person(it, &mut findings)?;
            became.push(result);
            match result {
                Became::Added => report.added += 1,
                Became::Replaced => report.replaced += 1,
                Became::Unchanged => report.unchanged += 1,
                Became::Refused => continue,
            }
            codes.push(person.code);
            if result != Became::Unchanged {
                report.answers += person.answers.len().min(before) as u64;
            }
        }
        let status = if became.contains(&Became::Added) {
            FileStatus::Imported
        } else if became.contains(&Became::Replaced) {
            FileStatus::Updated
        } else if became.contains(&Became::Unchanged) {
            FileStatus::Unchanged
        } else {
            FileStatus::Refused
        };
        report.files.push(AnswersFile {
            path: legible(path),
            status,
            participants: codes,
            findings: findings.finished(),
            columns,
        });
        Ok(())
    }

    /// Checks a participant and stores what fits the plan.
    fn person(&self, it: FromFile, findings: &mut Findings) -> Result<(Participant, Became)> {
        let FromFile {
            participant: mut person,
            lines,
        } = it;
        person.code = person.code.trim().to_owned();
        if let Some((message, remedy)) =
            fits::refused(&self.study.plan, &self.study.sha256, &person)
        {
            let line = lines.first().copied();
            findings.refuse(line, message, remedy);
            return Ok((person, Became::Refused));
        }
        person.study.clone_from(&self.study.plan.name);
        person.started_day = fits::day(&person.started_day);
        if !["en", "fr"].contains(&person.language.as_str()) {
            person.language.clear();
        }
        if !person.device.dpr.is_finite() {
            person.device.dpr = 0.0;
        }
        fits::profile(&self.study.plan, &mut person, findings);
        fits::answers(&self.study.plan, &mut person, &lines, findings);
        fits::skipped(&mut person, findings);
        let code = Some(person.code.as_str());
        let known = db::participants(self.connection, self.study.id, code)?;
        let Some((row, finished)) = known.first().map(|(row, it)| (*row, it.finished)) else {
            stored::insert(self.connection, self.study.id, &person)?;
            return Ok((person, Became::Added));
        };
        let before = stored::participants(self.connection, self.study, code)?;
        let before = before.into_iter().next();
        if before.as_ref() == Some(&person) {
            return Ok((person, Became::Unchanged));
        }
        if let Some(before) = before.as_ref().filter(|it| it.seed != person.seed) {
            let message = format!(
                "another participant has the code {:?}, whose answers stay: the seeds are {} and {}",
                person.code, before.seed, person.seed
            );
            let remedy = Remedy::command(
                "if they are two people, write another code into this file; if not, delete the earlier answers with `chereme study forget CORPUS NAME CODE`; then import again",
            );
            findings.add("warning", None, message, Some(remedy));
            return Ok((person, Became::Refused));
        }
        let earlier = before.map_or(0, |it| it.answers.len());
        if finished {
            let message = format!(
                "the participant {:?} has finished before with other answers, which stay",
                person.code
            );
            let remedy = Remedy::command(
                "if these are the right ones, delete the others with `chereme study forget CORPUS NAME CODE` and import again",
            );
            findings.add("warning", None, message, Some(remedy));
            return Ok((person, Became::Refused));
        }
        if !person.finished && person.answers.len() < earlier {
            let message = format!(
                "the participant {:?} has {earlier} answers, more than this file, and they stay",
                person.code
            );
            findings.add("warning", None, message, None);
            return Ok((person, Became::Refused));
        }
        db::delete_participant(self.connection, row)?;
        stored::insert(self.connection, self.study.id, &person)?;
        Ok((person, Became::Replaced))
    }
}

#[cfg(test)]
mod tests;
