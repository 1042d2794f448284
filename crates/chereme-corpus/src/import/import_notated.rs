//! Imports notation files (SiGML, or lines of HamNoSys): each sign becomes a lexicon entry with its notation and the
//! components derived from it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use chereme_formats::{ImportFinding, ReaderCorrection};
use chereme_sign::hamnosys::NotatedSign;
use serde_json::json;

use super::import_lexicons::{lexicon_of_notation, names_other_lexicon};
use super::import_notation::{NotationValueMapper, lost_notation_finding, notated_sign_document, uncoded_text_finding};
use super::{FileReport, FileStatus, ImportJob};
use crate::db::lexicons;
use crate::db::notations::{self, NotationRow};
use crate::db::signs::{self, EnteredSign, TokenRow};
use crate::db::stored_columns::RecordOrigin;
use crate::db::stored_recordings::SourceFileRow;
use crate::error::CorpusResult;
use crate::notation::{self, NotationFormat};
use crate::paths::legible_path_text;
use crate::progress::ProgressReceiver;
use crate::report_finding::ReportFinding;

/// Reads a file of SiGML.
pub(super) fn import_sigml(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    import_notated_signs(job, NotationFormat::Sigml, progress)
}

/// Reads a file of lines of HamNoSys.
pub(super) fn import_lines(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    import_notated_signs(job, NotationFormat::Lines, progress)
}

fn import_notated_signs(
    job: &mut ImportJob<'_>,
    form: NotationFormat,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<FileReport> {
    let mut earlier_report = job.report_unchanged_file();
    let earlier_file = job.places.files_with_hash(&job.hash).map(|row| row.id).max();
    let earlier_lexicon = match earlier_file {
        Some(file) => lexicons::lexicon_of_file(job.connection, file)?,
        None => None,
    };
    // A lexicon that is named now takes the signs over.
    if names_other_lexicon(job, earlier_lexicon)? {
        earlier_report = None;
    }
    if let Some(report) = &earlier_report
        && is_known_by_name(job)
    {
        return Ok(report.clone());
    }
    let bytes = job.read_job_bytes()?;
    let (entries, findings) = notation::read_signs(&bytes, form)?;
    // Signs without a gloss are called as their file: under another name the same bytes are other signs.
    if let Some(report) = earlier_report
        && entries.iter().all(|(sign, _)| !sign.gloss.is_empty())
    {
        return Ok(report);
    }
    let mut report = FileReport::new(job.path, FileStatus::Imported);
    // The names given to these signs are reported below.
    let named = |finding: &ImportFinding| finding.mend != Some(ReaderCorrection::Gloss);
    let findings = findings.into_iter().filter(named);
    report.findings.extend(findings.map(ReportFinding::from));
    let earlier = load_earlier_tokens(job, &mut report)?;
    if !earlier.tokens.is_empty() {
        report.status = FileStatus::Updated;
    }
    let lexicon = lexicon_of_notation(job, earlier.file)?;
    let file = job.keep_source_file(None, Some(&bytes))?;
    if let Some(lexicon) = &lexicon {
        lexicons::set_file_lexicon(job.connection, file, lexicon.id)?;
    }
    report.understood.lexicon = lexicon.as_ref().map(|lexicon| lexicon.name.clone());
    let inventories = job.inventories.clone();
    let words = NotationValueMapper::new(&inventories);
    let mut place = NotationFile {
        file,
        lexicon: lexicon.map(|lexicon| lexicon.id),
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
    let left = place.earlier.tokens.values().map(Vec::len).sum::<usize>();
    if left > 0 {
        report.findings.push(ReportFinding::finding_warning(
            format!("signs of an earlier file of this name that are missing here, and were kept: {left}"),
            "undo the earlier import, if the new file is to take its place",
        ));
    }
    Ok(report)
}

/// Returns whether a file of the same bytes and of this name, the ending apart, was imported before.
fn is_known_by_name(job: &ImportJob<'_>) -> bool {
    let stem = |row: &SourceFileRow| Path::new(&row.name).file_stem().map(legible_path_text);
    let mut same = job.places.files_with_hash(&job.hash);
    same.any(|row| row.kind == job.kind && stem(row).as_ref() == Some(&job.stem))
}

/// Returns the tokens of an earlier import of this file. Tokens of a file of the same name in another folder are other
/// signs; a note says so.
fn load_earlier_tokens(job: &ImportJob<'_>, report: &mut FileReport) -> CorpusResult<EarlierSignTokens> {
    let mut files = BTreeSet::new();
    let mut elsewhere = None;
    for row in job.places.files_of_same_name(&job.file_name) {
        // The list also has files that differ in the ending or in case, which hold other signs.
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
        report.findings.push(ReportFinding::finding_note(format!(
            "another file of this name, {path}, was imported before; the signs of this one stand next \
             to those, also where they have the same gloss"
        )));
    }
    Ok(EarlierSignTokens::new(files.last().copied(), rows))
}

/// The earlier imports of the file.
struct EarlierSignTokens {
    /// The newest of them.
    file: Option<i64>,
    /// Their tokens by gloss, in reverse order.
    tokens: BTreeMap<String, Vec<i64>>,
}

impl EarlierSignTokens {
    fn new(file: Option<i64>, rows: Vec<NotationRow>) -> Self {
        let mut tokens: BTreeMap<String, Vec<i64>> = BTreeMap::new();
        // The tokens are taken from the end, so that the first sign of a gloss gets the first token.
        for row in rows.into_iter().rev() {
            tokens.entry(row.gloss).or_default().push(row.token_id);
        }
        Self { file, tokens }
    }

    /// Returns the next token with this gloss.
    fn next(&mut self, gloss: &str) -> Option<i64> {
        self.tokens.get_mut(gloss)?.pop()
    }
}

/// The file from which signs come.
struct NotationFile {
    file: i64,
    /// The lexicon to which the signs belong.
    lexicon: Option<i64>,
    form: NotationFormat,
    several: bool,
    earlier: EarlierSignTokens,
    /// Lines and names of signs without a gloss.
    unnamed: Vec<(u64, String)>,
}

impl NotationFile {
    /// Returns a note with the names given to signs without a gloss.
    fn unnamed_signs(&self) -> Option<ReportFinding> {
        const NAMELESS_SIGN_REMEDY: &str = "give each sign a gloss in the file, and import it again";
        let message = match self.unnamed.as_slice() {
            [] => return None,
            [(_, name)] => format!("the sign has no gloss: it is called {name:?}, as the file"),
            [(_, first), .., (_, last)] => format!(
                "{} signs have no gloss: they are called {first:?} to {last:?}, by the file and the line",
                self.unnamed.len()
            ),
        };
        let mut finding = ReportFinding::finding_warning(message, NAMELESS_SIGN_REMEDY);
        finding.line = self.unnamed.first().map(|(line, _)| *line);
        Some(finding)
    }
}

fn import_sign(
    job: &mut ImportJob<'_>,
    sign: &NotatedSign,
    line: u64,
    words: &NotationValueMapper<'_>,
    place: &mut NotationFile,
    report: &mut FileReport,
) -> CorpusResult<()> {
    let gloss = match sign.gloss.as_str() {
        // Several signs of one file would otherwise all get the same name.
        "" if place.several => format!("{}-{line}", job.stem),
        "" => job.stem.clone(),
        gloss => gloss.to_owned(),
    };
    if sign.gloss.is_empty() {
        place.unnamed.push((line, gloss.clone()));
    }
    let row = i64::try_from(line).ok();
    let token = match place.earlier.next(&gloss) {
        Some(token) => {
            enter_earlier_token(job, place.lexicon, token)?;
            token
        }
        None => insert_token(job, place.lexicon, &gloss, row)?,
    };
    let mut mapped = words.map_notated_sign(sign);
    // Only lines can hold text that is no HamNoSys, since SiGML names its symbols by tags.
    let text = sign.text.as_deref().filter(|_| place.form == NotationFormat::Lines);
    if let Some(finding) = text.and_then(|text| uncoded_text_finding(&gloss, line, text)) {
        report.findings.push(finding);
        mapped.values.clear();
    }
    signs::set_values(job.connection, token, &words.mapped_value_rows(&mapped))?;
    let row = NotationRow {
        token_id: token,
        source_file_id: Some(place.file),
        line: row,
        system: match place.form {
            NotationFormat::Sigml => "sigml",
            NotationFormat::Lines => "hamnosys",
        }
        .to_owned(),
        text: sign.text.clone(),
        document: notated_sign_document(sign)?,
        ..NotationRow::default()
    };
    let before = notations::find_token_notation(job.connection, token)?;
    if before.is_some_and(|notation| (notation.text, notation.document) != (row.text.clone(), row.document.clone())) {
        job.counts.count_changed_rows("notations", 1);
    }
    notations::set_token_notation(job.connection, &row)?;
    report.findings.extend(lost_notation_finding(&gloss, line, &mapped));
    Ok(())
}

/// Makes a token of an earlier import one of the lexicon's entry.
fn enter_earlier_token(job: &ImportJob<'_>, lexicon: Option<i64>, token: i64) -> CorpusResult<()> {
    let row = signs::load_token_row(job.connection, token)?;
    if lexicon.is_none() || lexicons::lexicon_of_sign(job.connection, row.sign_id)? == lexicon {
        return Ok(());
    }
    let sign = signs::enter_sign(job.connection, lexicon, &row.gloss)?;
    if sign.id == row.sign_id {
        return Ok(());
    }
    let former_sign = row.sign_id;
    let row = TokenRow {
        sign_id: sign.id,
        // The citation form of a sign that has one already stays as it is.
        citation: !signs::has_citation(job.connection, sign.id)?,
        ..row
    };
    signs::update_token(job.connection, &row)?;
    signs::delete_empty_sign(job.connection, former_sign)?;
    Ok(())
}

fn insert_token(job: &mut ImportJob<'_>, lexicon: Option<i64>, gloss: &str, line: Option<i64>) -> CorpusResult<i64> {
    let EnteredSign { id: sign, is_new } = signs::enter_sign(job.connection, lexicon, gloss)?;
    let row = TokenRow {
        sign_id: sign,
        origin: RecordOrigin::Lexicon,
        citation: !signs::has_citation(job.connection, sign)?,
        source: Some(json!({ "file": job.file_name, "line": line }).to_string()),
        ..TokenRow::default()
    };
    job.count_created_rows("signs", usize::from(is_new));
    job.count_created_rows("tokens", 1);
    job.count_created_rows("notations", 1);
    signs::insert_token(job.connection, &row)
}
