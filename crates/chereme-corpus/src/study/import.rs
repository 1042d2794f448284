//! Answers that participants sent back, from files.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use chereme_sign::Remedy;
use rusqlite::Connection;
use serde::Serialize;

use super::answers::{ANSWERS_FORMAT, ANSWERS_VERSION, Participant};
use super::plan::{Plan, QuestionKind};
use super::{found, long, stored};
use crate::Corpus;
use crate::db::studies as db;
use crate::error::{Error, Result};
use crate::import::{FileStatus, ReportFinding};
use crate::paths::legible;
use crate::progress::{Progress, Step, Unit};
use crate::words::counted;

/// The size of the largest file of answers, in bytes.
const LARGEST: u64 = 32 << 20;
/// The largest number of answers of a participant.
const MOST_ANSWERS: usize = 100_000;
/// The largest number of files of one import, and of folders inside each other.
const MOST_FILES: usize = 100_000;
const DEEPEST: usize = 8;
/// The largest number of findings that are listed for a file.
const MOST_FINDINGS: usize = 100;
/// The length of the longest code of a participant.
const LONGEST_CODE: usize = 60;

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
        let mut files = Vec::new();
        for path in paths {
            listed(path, 0, &mut files)?;
        }
        self.store
            .operation_with_progress("import answers", progress, |connection, progress| {
                let (id, plan) = found(connection, study)?;
                let mut report = AnswersReport {
                    study: plan.name.clone(),
                    ..AnswersReport::default()
                };
                let work = Work {
                    connection,
                    study: id,
                    sha256: plan.sha256(),
                    plan: &plan,
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
                let people = counted(report.added + report.replaced, "participants");
                let summary = format!("{}, {people}", plan.name);
                Ok((report, summary))
            })
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

/// Adds the file, or the files of a folder that may hold answers, in the order of their names.
fn listed(path: &Path, depth: usize, files: &mut Vec<PathBuf>) -> Result<()> {
    let fault = |error| Error::file(path, error);
    if !fs::metadata(path).map_err(fault)?.is_dir() {
        files.push(path.to_owned());
    } else if depth < DEEPEST {
        let mut inside = Vec::new();
        for entry in fs::read_dir(path).map_err(fault)? {
            let entry = entry.map_err(fault)?;
            let kind = entry.file_type().map_err(fault)?;
            let own = entry.path();
            let ending = own
                .extension()
                .map(|it| it.to_string_lossy().to_lowercase());
            let may = matches!(ending.as_deref(), Some("json" | "csv"));
            if kind.is_dir() || (kind.is_file() && may) {
                inside.push(own);
            }
        }
        inside.sort();
        for own in inside {
            listed(&own, depth + 1, files)?;
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
struct Findings {
    list: Vec<ReportFinding>,
    more: usize,
}

impl Findings {
    fn add(
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

    fn refuse(&mut self, line: Option<u64>, message: String, remedy: &'static str) {
        self.add("error", line, message, Some(remedy.into()));
    }

    fn finished(mut self) -> Vec<ReportFinding> {
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

/// What became of a participant.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Became {
    Added,
    Replaced,
    Unchanged,
    Refused,
}

struct Work<'c> {
    connection: &'c Connection,
    study: i64,
    plan: &'c Plan,
    sha256: String,
}

impl Work<'_> {
    fn file(&self, path: &Path, report: &mut AnswersReport) -> Result<()> {
        let mut findings = Findings::default();
        let people = match read(path, &mut findings) {
            Ok(people) => people,
            Err(error) => {
                findings.add("error", None, error.to_string(), error.remedy());
                Vec::new()
            }
        };
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
        if let Some((message, remedy)) = self.refused(&person) {
            let line = lines.first().copied();
            findings.refuse(line, message, remedy);
            return Ok((person, Became::Refused));
        }
        person.study.clone_from(&self.plan.name);
        person.started_day = day(&person.started_day);
        if !["en", "fr"].contains(&person.language.as_str()) {
            person.language.clear();
        }
        if !person.device.dpr.is_finite() {
            person.device.dpr = 0.0;
        }
        self.profile(&mut person, findings);
        self.answers(&mut person, &lines, findings);
        let code = Some(person.code.as_str());
        let known = db::participants(self.connection, self.study, code)?;
        let Some((row, finished)) = known.first().map(|(row, it)| (*row, it.finished)) else {
            stored::insert(self.connection, self.study, &person)?;
            return Ok((person, Became::Added));
        };
        let before = stored::participants(self.connection, self.study, self.plan, code)?;
        let before = before.into_iter().next();
        if before.as_ref() == Some(&person) {
            return Ok((person, Became::Unchanged));
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
        stored::insert(self.connection, self.study, &person)?;
        Ok((person, Became::Replaced))
    }

    /// Returns why a participant cannot be imported at all, and what to do.
    fn refused(&self, person: &Participant) -> Option<(String, &'static str)> {
        if person.format != ANSWERS_FORMAT {
            let message = format!(
                "the file is no {ANSWERS_FORMAT}, but {:?}",
                short(&person.format)
            );
            return Some((message, "import the files that the questionnaire saves"));
        }
        if person.version != ANSWERS_VERSION {
            let message = format!(
                "the answers are of version {}; this program reads version {ANSWERS_VERSION}",
                person.version
            );
            return Some((
                message,
                "import them with the version of Chereme that built the questionnaire",
            ));
        }
        if person.plan_sha256 != self.sha256 {
            let message = format!(
                "the answers of {:?} belong to another plan than that of the study {:?}",
                short(&person.code),
                self.plan.name
            );
            return Some((
                message,
                "import them into the study that the questionnaire was built from; a plan that changed is another plan",
            ));
        }
        if !is_code(&person.code) {
            let message = format!("{:?} is no code of a participant", short(&person.code));
            return Some((
                message,
                "a code has up to 60 letters, digits, hyphens, dots, underscores and blanks",
            ));
        }
        if person.answers.len() > MOST_ANSWERS {
            let message = format!("the participant has more than {MOST_ANSWERS} answers");
            return Some((message, "import the files that the questionnaire saves"));
        }
        if person.consent.get("analysis") == Some(&false) {
            let message = format!(
                "{:?} did not agree that the answers are analysed",
                person.code
            );
            return Some((message, "delete the file"));
        }
        None
    }

    /// Leaves out answers about the participant that the plan does not offer.
    fn profile(&self, person: &mut Participant, findings: &mut Findings) {
        let code = person.code.clone();
        person
            .consent
            .retain(|name, _| ["analysis", "publication"].contains(&name.as_str()));
        person.profile.retain(|name, option| {
            let question = self.plan.profile.iter().find(|it| it.name == *name);
            let known = question.is_some_and(|it| it.options.iter().any(|it| it.name == *option));
            if !known {
                let message = format!(
                    "{code}: the plan has no answer {:?} to {:?}; it was left out",
                    short(option),
                    short(name)
                );
                findings.add("warning", None, message, None);
            }
            known
        });
    }

    /// Leaves out answers that do not fit the plan, and computes which are right.
    fn answers(&self, person: &mut Participant, lines: &[u64], findings: &mut Findings) {
        let mut seen = BTreeSet::new();
        let mut at = 0;
        person.answers.retain_mut(|answer| {
            let number = at + 1;
            let line = lines.get(at).copied();
            at += 1;
            let fault = match self.fits(answer) {
                Err(fault) => Some(fault),
                Ok(()) if !seen.insert((answer.n, answer.question.clone())) => Some(format!(
                    "{:?} was answered twice in trial {}",
                    short(&answer.question),
                    answer.n
                )),
                Ok(()) => None,
            };
            let Some(fault) = fault else {
                return true;
            };
            let message = format!("answer {number} was left out: {fault}");
            findings.add("warning", line, message, None);
            false
        });
    }

    /// Checks an answer, and fills in its scale and whether it is right.
    fn fits(&self, answer: &mut super::answers::Answer) -> std::result::Result<(), String> {
        let (part, item, condition) = (&answer.part, &answer.item, &answer.condition);
        let trial = self.plan.trial(part, item, condition, answer.role);
        let trial = trial.ok_or_else(|| {
            format!(
                "the plan has no trial with {:?} and {:?} ({})",
                short(item),
                short(condition),
                answer.role.name()
            )
        })?;
        let name = answer.question.as_str();
        let question = self.plan.asked(trial).find(|it| it.name == name);
        let question =
            question.ok_or_else(|| format!("the plan does not ask {:?} there", short(name)))?;
        if answer.n == 0 || answer.n as usize > MOST_ANSWERS {
            return Err(format!("{} is no place in an order of trials", answer.n));
        }
        match &question.kind {
            QuestionKind::Scale { low, high, .. } => {
                let ends = [*low, *high];
                if answer.scale.is_some_and(|scale| scale != ends) {
                    return Err(format!("the scale of {name:?} goes from {low} to {high}"));
                }
                if let Some(value) = answer.value.filter(|it| !(low..=high).contains(&it)) {
                    return Err(format!(
                        "{value} lies outside the scale from {low} to {high}"
                    ));
                }
                if answer.choice.is_some() {
                    return Err(format!("{name:?} is a scale, which has no options"));
                }
                answer.scale = Some(ends);
                answer.right = None;
            }
            QuestionKind::Choice { options } => {
                if answer.value.is_some() || answer.scale.is_some() {
                    return Err(format!("{name:?} is a choice, which has no numbers"));
                }
                let choice = answer.choice.as_ref();
                if let Some(wrong) = choice.filter(|it| !options.iter().any(|one| one.name == **it))
                {
                    return Err(format!("{name:?} has no option {:?}", short(wrong)));
                }
                let right = trial.right.get(name);
                answer.right = right.map(|right| choice == Some(right));
            }
        }
        if answer.value.is_none() && answer.choice.is_none() {
            if !question.cannot_say {
                return Err(format!("{name:?} has no answer"));
            }
            answer.right = None;
        }
        Ok(())
    }
}

/// Returns whether a text can be the code of a participant.
fn is_code(text: &str) -> bool {
    let plain = |letter: char| letter.is_alphanumeric() || "-_. ".contains(letter);
    text.starts_with(char::is_alphanumeric)
        && text.chars().count() <= LONGEST_CODE
        && text.chars().all(plain)
}

/// Returns a day as `2026-11-27`; nothing if it is none.
fn day(text: &str) -> String {
    let digits = |text: &str| text.bytes().all(|it| it.is_ascii_digit());
    let parts: Vec<&str> = text.split('-').collect();
    match parts.as_slice() {
        [year, month, day] if (year.len(), month.len(), day.len()) == (4, 2, 2) => {
            let whole = digits(year) && digits(month) && digits(day);
            if whole {
                text.to_owned()
            } else {
                String::new()
            }
        }
        _ => String::new(),
    }
}

/// Returns the beginning of a text of a file, for a message.
fn short(text: &str) -> String {
    const SHOWN: usize = 40;
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// A participant as a file has it; the lines of the answers, if the file is a table.
struct FromFile {
    participant: Participant,
    lines: Vec<u64>,
}

/// Reads a file of answers.
fn read(path: &Path, findings: &mut Findings) -> Result<Vec<FromFile>> {
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
    let text = String::from_utf8(bytes).map_err(|_| {
        Error::wrong("the file is no text in UTF-8").advise("save it as text in UTF-8")
    })?;
    let text = text.trim_start_matches('\u{feff}');
    if text.trim_start().starts_with('{') {
        return match serde_json::from_str::<Participant>(text) {
            Ok(participant) => Ok(vec![FromFile {
                participant,
                lines: Vec::new(),
            }]),
            Err(error) => {
                let line = Some(error.line() as u64).filter(|line| *line > 0);
                let message = format!("the answers cannot be read: {error}");
                findings.refuse(
                    line,
                    message,
                    "import the files that the questionnaire saves",
                );
                Ok(Vec::new())
            }
        };
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
    Ok(read)
}

#[cfg(test)]
mod tests;
