//! Imports notation files (SiGML, or lines of HamNoSys): each sign becomes a lexicon entry with its notation and the
//! components derived from it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use chereme_formats::{Finding, Mend};
use chereme_sign::hamnosys::Notated;
use serde_json::json;

use super::notation::{Words, document, lost, uncoded};
use super::report::ReportFinding;
use super::{FileReport, FileStatus, Job};
use crate::db::columns::Origin;
use crate::db::notations::{self, NotationRow};
use crate::db::recordings::SourceFileRow;
use crate::db::signs::{self, TokenRow};
use crate::error::Result;
use crate::notation::{self, Form};
use crate::paths::legible;
use crate::progress::Progress;

/// Reads a file of SiGML.
pub(super) fn import_sigml(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    import(job, Form::Sigml, progress)
}

/// Reads a file of lines of HamNoSys.
pub(super) fn import_lines(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    import(job, Form::Lines, progress)
}

fn import(job: &mut Job<'_>, form: Form, progress: &mut Progress<'_>) -> Result<FileReport> {
    let known = job.unchanged();
    if let Some(report) = &known
        && is_known_by_name(job)
    {
        return Ok(report.clone());
    }
    let bytes = job.bytes()?;
    let (entries, findings) = notation::read_signs(&bytes, form)?;
    // Signs without a gloss are called as their file: under another name the same bytes are other signs.
    if let Some(report) = known
        && entries.iter().all(|(sign, _)| !sign.gloss.is_empty())
    {
        return Ok(report);
    }
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    // The names given to these signs are reported below.
    let named = |finding: &Finding| finding.mend != Some(Mend::Gloss);
    let findings = findings.into_iter().filter(named);
    report.findings.extend(findings.map(ReportFinding::from));
    let earlier = earlier(job, &mut report)?;
    if !earlier.0.is_empty() {
        report.status = FileStatus::Updated;
    }
    let file = job.keep(None, Some(&bytes))?;
    let inventories = job.inventories.clone();
    let words = Words::new(&inventories);
    let mut place = NotationFile {
        file,
        form,
        several: entries.len() > 1,
        earlier,
        unnamed: Vec::new(),
    };
    for (done, (sign, line)) in entries.iter().enumerate() {
        if done % 64 == 63 {
            job.report_progress(progress)?;
        }
        import_sign(job, sign, *line, &words, &mut place, &mut report)?;
    }
    if let Some(finding) = place.unnamed_signs() {
        report.findings.push(finding);
    }
    let left = place.earlier.0.values().map(Vec::len).sum::<usize>();
    if left > 0 {
        report.findings.push(ReportFinding::warning(
            format!(
                "signs of an earlier file of this name that are missing here, and were kept: {left}"
            ),
            "undo the earlier import, if the new file is to take its place",
        ));
    }
    Ok(report)
}

/// Returns whether a file of the same bytes and of this name, the ending apart, was imported before.
fn is_known_by_name(job: &Job<'_>) -> bool {
    let stem = |row: &SourceFileRow| Path::new(&row.name).file_stem().map(legible);
    let mut same = job.places.hashed(&job.hash);
    same.any(|row| row.kind == job.kind && stem(row).as_ref() == Some(&job.stem))
}

/// Returns the tokens of an earlier import of this file. Tokens of a file of the same name in another folder are other
/// signs; a note says so.
fn earlier(job: &Job<'_>, report: &mut FileReport) -> Result<Earlier> {
    let mut files = BTreeSet::new();
    let mut elsewhere = None;
    for row in job.places.namesakes(&job.file_name) {
        if row.name != job.file_name || row.kind != job.kind {
            continue;
        }
        match &row.path {
            Some(path) if *path != job.place => elsewhere = Some(path),
            _ => {
                files.insert(row.id);
            }
        }
    }
    let mut rows = notations::of_file(job.connection, &job.file_name)?;
    rows.retain(|row| row.source_file_id.is_some_and(|id| files.contains(&id)));
    if let Some(path) = elsewhere.filter(|_| files.is_empty()) {
        report.findings.push(ReportFinding::note(format!(
            "another file of this name, {path}, was imported before; the signs of this one stand next \
             to those, also where they have the same gloss"
        )));
    }
    Ok(Earlier::new(rows))
}

/// Tokens of earlier imports of the file, by gloss, in reverse order.
struct Earlier(BTreeMap<String, Vec<i64>>);

impl Earlier {
    fn new(rows: Vec<NotationRow>) -> Self {
        let mut tokens: BTreeMap<String, Vec<i64>> = BTreeMap::new();
        for row in rows.into_iter().rev() {
            tokens.entry(row.gloss).or_default().push(row.token_id);
        }
        Self(tokens)
    }

    /// Returns the next token with this gloss.
    fn next(&mut self, gloss: &str) -> Option<i64> {
        self.0.get_mut(gloss)?.pop()
    }
}

/// The file from which signs come.
struct NotationFile {
    file: i64,
    form: Form,
    several: bool,
    earlier: Earlier,
    /// Lines and names of signs without a gloss.
    unnamed: Vec<(u64, String)>,
}

impl NotationFile {
    /// Returns a note with the names given to signs without a gloss.
    fn unnamed_signs(&self) -> Option<ReportFinding> {
        const REMEDY: &str = "give each sign a gloss in the file, and import it again";
        let message = match self.unnamed.as_slice() {
            [] => return None,
            [(_, name)] => format!("the sign has no gloss: it is called {name:?}, as the file"),
            [(_, first), .., (_, last)] => format!(
                "{} signs have no gloss: they are called {first:?} to {last:?}, by the file and the line",
                self.unnamed.len()
            ),
        };
        let mut finding = ReportFinding::warning(message, REMEDY);
        finding.line = self.unnamed.first().map(|(line, _)| *line);
        Some(finding)
    }
}

fn import_sign(
    job: &mut Job<'_>,
    sign: &Notated,
    line: u64,
    words: &Words<'_>,
    place: &mut NotationFile,
    report: &mut FileReport,
) -> Result<()> {
    let gloss = match sign.gloss.as_str() {
        "" if place.several => format!("{}-{line}", job.stem),
        "" => job.stem.clone(),
        gloss => gloss.to_owned(),
    };
    if sign.gloss.is_empty() {
        place.unnamed.push((line, gloss.clone()));
    }
    let row = i64::try_from(line).ok();
    let token = match place.earlier.next(&gloss) {
        Some(token) => token,
        None => insert_token(job, &gloss, row)?,
    };
    let mut mapped = words.map(sign);
    let text = sign.text.as_deref().filter(|_| place.form == Form::Lines);
    if let Some(finding) = text.and_then(|text| uncoded(&gloss, line, text)) {
        report.findings.push(finding);
        mapped.values.clear();
    }
    signs::set_values(job.connection, token, &words.rows(&mapped))?;
    let row = NotationRow {
        token_id: token,
        source_file_id: Some(place.file),
        line: row,
        system: match place.form {
            Form::Sigml => "sigml",
            Form::Lines => "hamnosys",
        }
        .to_owned(),
        text: sign.text.clone(),
        document: document(sign)?,
        ..NotationRow::default()
    };
    let before = notations::of_token(job.connection, token)?;
    if before.is_some_and(|it| (it.text, it.document) != (row.text.clone(), row.document.clone())) {
        job.counts.changed("notations", 1);
    }
    notations::set(job.connection, &row)?;
    report.findings.extend(lost(&gloss, line, &mapped));
    Ok(())
}

fn insert_token(job: &mut Job<'_>, gloss: &str, line: Option<i64>) -> Result<i64> {
    let is_new = signs::find_sign(job.connection, gloss)?.is_none();
    let sign = signs::sign_glossed(job.connection, gloss)?;
    let row = TokenRow {
        sign_id: sign,
        origin: Origin::Lexicon,
        citation: !signs::has_citation(job.connection, sign)?,
        source: Some(json!({ "file": job.file_name, "line": line }).to_string()),
        ..TokenRow::default()
    };
    job.count("signs", usize::from(is_new));
    job.count("tokens", 1);
    job.count("notations", 1);
    signs::insert_token(job.connection, &row)
}
