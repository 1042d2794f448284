//! Files of notation, SiGML or lines of HamNoSys: each sign a lexicon entry with its notation, and with
//! components from it.

use std::collections::BTreeMap;

use chereme_sign::hamnosys::Notated;
use serde_json::json;

use super::notation::{Words, document, lost};
use super::report::ReportFinding;
use super::{FileReport, FileStatus, Job};
use crate::db::notations::{self, NotationRow};
use crate::db::recordings;
use crate::db::signs::{self, TokenRow};
use crate::error::Result;
use crate::notation::{self, Form};
use crate::progress::Progress;

/// Reads a file of SiGML.
pub(super) fn import_sigml(job: &mut Job<'_>, _: &mut Progress<'_>) -> Result<FileReport> {
    import(job, Form::Sigml)
}

/// Reads a file of lines of HamNoSys.
pub(super) fn import_lines(job: &mut Job<'_>, _: &mut Progress<'_>) -> Result<FileReport> {
    import(job, Form::Lines)
}

fn import(job: &mut Job<'_>, form: Form) -> Result<FileReport> {
    if recordings::source_file_hashed(job.connection, &job.hash)?.is_some() {
        return Ok(FileReport::unchanged(job.path));
    }
    let bytes = job.bytes()?;
    let (entries, findings) = notation::read_signs(&bytes, form)?;
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    let earlier = notations::of_file(job.connection, &job.file_name)?;
    let file = job.keep(None, Some(&bytes))?;
    let inventories = job.inventories.clone();
    let words = Words::new(&inventories);
    let mut place = Place {
        file,
        form,
        several: entries.len() > 1,
        earlier: Earlier::new(earlier),
    };
    for (sign, line) in &entries {
        import_sign(job, sign, *line, &words, &mut place, &mut report)?;
    }
    let left = place.earlier.0.values().map(Vec::len).sum::<usize>();
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

/// The file that signs come from.
struct Place {
    file: i64,
    form: Form,
    several: bool,
    earlier: Earlier,
}

fn import_sign(
    job: &mut Job<'_>,
    sign: &Notated,
    line: u64,
    words: &Words<'_>,
    place: &mut Place,
    report: &mut FileReport,
) -> Result<()> {
    let gloss = match (sign.gloss.as_str(), place.form) {
        ("", Form::Lines) if place.several => format!("{}-{line}", job.stem),
        ("", _) => job.stem.clone(),
        (gloss, _) => gloss.to_owned(),
    };
    let row = i64::try_from(line).ok();
    let token = match place.earlier.next(&gloss) {
        Some(token) => token,
        None => insert_token(job, &gloss, row)?,
    };
    let mapped = words.map(sign);
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
    notations::set(job.connection, &row)?;
    report.findings.extend(lost(&gloss, line, &mapped));
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
