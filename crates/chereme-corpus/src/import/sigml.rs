//! SiGML files: each sign a lexicon entry with its notation, and with components from it.

use std::collections::BTreeMap;

use chereme_formats::sigml::{self, Entry};
use serde_json::json;

use super::notation::{Words, document, lost};
use super::report::ReportFinding;
use super::{FileReport, FileStatus, Job};
use crate::db::notations::{self, NotationRow};
use crate::db::recordings::{self, SourceFileRow};
use crate::db::signs::{self, TokenRow};
use crate::error::{Error, Result};

pub(super) fn import(job: &mut Job<'_>) -> Result<FileReport> {
    if recordings::source_file_hashed(job.connection, &job.hash)?.is_some() {
        return Ok(FileReport::unchanged(job.path));
    }
    let bytes = job.bytes()?;
    let (entries, findings) = sigml::read(&bytes).map_err(|error| {
        Error::wrong(error.to_string()).advise("a SiGML file holds <hamgestural_sign> elements")
    })?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    let earlier = notations::of_file(job.connection, &job.file_name)?;
    let row = SourceFileRow {
        id: 0,
        recording_id: None,
        kind: "sigml".into(),
        name: job.file_name.clone(),
        hash: job.hash.clone(),
    };
    let file = recordings::insert_source_file(job.connection, &row, Some(&bytes))?;
    let inventories = job.inventories.clone();
    let words = Words::new(&inventories);
    let mut earlier = Earlier::new(earlier);
    for entry in &entries {
        import_entry(job, entry, file, &words, &mut earlier, &mut report)?;
    }
    let left = earlier.0.values().map(Vec::len).sum::<usize>();
    if left > 0 {
        report.findings.push(ReportFinding::warning(
            format!("{left} signs of an earlier file of this name are not in it; they were kept"),
            "undo the earlier import, if the new file is to take its place",
        ));
    }
    Ok(report)
}

/// Tokens of files of the same name that were imported before, by gloss, the last one first.
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

fn import_entry(
    job: &mut Job<'_>,
    entry: &Entry,
    file: i64,
    words: &Words<'_>,
    earlier: &mut Earlier,
    report: &mut FileReport,
) -> Result<()> {
    let gloss = match entry.sign.gloss.as_str() {
        "" => job.stem.clone(),
        gloss => gloss.to_owned(),
    };
    let line = i64::try_from(entry.line.0).ok();
    let token = match earlier.next(&gloss) {
        Some(token) => token,
        None => insert_token(job, &gloss, line)?,
    };
    let mapped = words.map(&entry.sign);
    signs::set_values(job.connection, token, &words.rows(&mapped))?;
    let row = NotationRow {
        token_id: token,
        source_file_id: Some(file),
        line,
        system: "sigml".to_owned(),
        text: entry.sign.text.clone(),
        document: document(&entry.sign)?,
        ..NotationRow::default()
    };
    notations::set(job.connection, &row)?;
    if let Some(note) = lost(&gloss, entry.line.0, &mapped) {
        report.findings.push(note);
    }
    Ok(())
}

fn insert_token(job: &mut Job<'_>, gloss: &str, line: Option<i64>) -> Result<i64> {
    let is_new = signs::find_sign(job.connection, gloss)?.is_none();
    let sign = signs::sign_glossed(job.connection, gloss)?;
    let tokens = signs::tokens_of_sign(job.connection, sign)?;
    let row = TokenRow {
        sign_id: sign,
        origin: "lexicon".to_owned(),
        citation: !tokens.iter().any(|token| token.citation),
        source: Some(json!({ "file": job.file_name, "line": line }).to_string()),
        ..TokenRow::default()
    };
    job.count("signs", usize::from(is_new));
    job.count("tokens", 1);
    job.count("notations", 1);
    signs::insert_token(job.connection, &row)
}
