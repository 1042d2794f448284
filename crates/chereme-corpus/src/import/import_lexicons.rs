//! The lexicon to which the signs of an imported table or file of notation belong.

use std::collections::BTreeMap;

use chereme_formats::lexicon::{LexiconColumn, LexiconEntry, SignLexicon};
use chereme_sign::ErrorRemedy;
use chereme_sign::text::fold_text;

use super::ImportJob;
use crate::db::lexicons::{self, LexiconRow};
use crate::error::CorpusResult;
use crate::lexicon;
use crate::report_finding::ReportFinding;

/// Returns the lexicon of a table: the one that the options name, otherwise that of its earlier import, whose file is
/// `earlier`; otherwise a new one with the name of the file. Nothing for a table of an older corpus whose signs belong to
/// no lexicon.
pub(super) fn lexicon_of_table(job: &mut ImportJob<'_>, earlier: Option<i64>) -> CorpusResult<Option<LexiconRow>> {
    if let Some(named) = named_lexicon(job)? {
        return Ok(Some(named));
    }
    let lexicon = match earlier {
        Some(file) => lexicons::lexicon_of_file(job.connection, file)?,
        None => {
            let name = lexicons::free_lexicon_name(job.connection, &job.stem)?;
            job.count_created_rows("lexicons", 1);
            Some(lexicons::insert_lexicon(job.connection, &name)?)
        }
    };
    lexicon_row(job, lexicon)
}

/// The entries that rows of a table name: the lexicon in a column `lexicon` such as exports have, or `dataset`; the number
/// among the entries of one gloss in a column `homonym`.
#[derive(Default)]
pub(super) struct LexiconCells {
    column: Option<usize>,
    number_column: Option<usize>,
    /// The titles of the columns.
    pub(super) titles: Vec<String>,
    /// The lexicons by name.
    pub(super) lexicons: BTreeMap<String, i64>,
    /// Whether every row names one.
    pub(super) covers_all_rows: bool,
}

impl LexiconCells {
    /// Reads the column; the lexicons that the corpus does not have are made. A lexicon that the options name counts for
    /// all rows.
    pub(super) fn read_lexicon_cells(job: &mut ImportJob<'_>, table: &SignLexicon) -> CorpusResult<Self> {
        const LEXICON_TITLES: [&str; 3] = ["lexicon", "lexique", "dataset"];
        const HOMONYM_TITLE: &str = "homonym";
        let is_lexicon = |column: &LexiconColumn| LEXICON_TITLES.contains(&&*fold_text(column.title.trim()));
        let is_number = |column: &LexiconColumn| fold_text(column.title.trim()) == HOMONYM_TITLE;
        let mut cells = Self {
            number_column: table.columns.iter().position(is_number),
            ..Self::default()
        };
        let number_title = cells.number_column.map(|column| table.columns[column].title.clone());
        cells.titles.extend(number_title);
        let Some(column) = table
            .columns
            .iter()
            .position(is_lexicon)
            .filter(|_| job.options.lexicon.is_none())
        else {
            return Ok(cells);
        };
        // An empty table says nothing about the lexicon of its signs.
        cells.covers_all_rows = !table.entries.is_empty();
        for row in &table.entries {
            let name = row.cells[column].trim();
            if name.is_empty() || cells.lexicons.contains_key(name) {
                cells.covers_all_rows &= !name.is_empty();
                continue;
            }
            let lexicon = make_lexicon(job, name)?;
            cells.lexicons.insert(name.to_owned(), lexicon.id);
        }
        cells.column = Some(column);
        cells.titles.push(table.columns[column].title.clone());
        Ok(cells)
    }

    /// Returns the number that a row has among the entries of its gloss, if the table has a column for it; an empty cell is
    /// the first.
    pub(super) fn number_of_row(&self, row: &LexiconEntry) -> Option<i64> {
        let cell = row.cells[self.number_column?].trim();
        match cell.is_empty() {
            true => Some(1),
            false => cell.parse().ok().filter(|number| *number > 0),
        }
    }

    /// Returns the lexicon that a row names.
    pub(super) fn lexicon_of_row(&self, row: &LexiconEntry) -> Option<i64> {
        self.lexicons.get(row.cells[self.column?].trim()).copied()
    }
}

/// Returns the lexicon of a file of notation: the one that the options name, otherwise that of its earlier import, whose
/// file is `earlier`; otherwise the only one of the corpus.
pub(super) fn lexicon_of_notation(job: &mut ImportJob<'_>, earlier: Option<i64>) -> CorpusResult<Option<LexiconRow>> {
    if let Some(named) = named_lexicon(job)? {
        return Ok(Some(named));
    }
    let lexicon = match earlier {
        Some(file) => lexicons::lexicon_of_file(job.connection, file)?,
        None => lexicons::find_sole_lexicon(job.connection)?,
    };
    lexicon_row(job, lexicon)
}

/// Returns whether the options name another lexicon than the one of an earlier import.
pub(super) fn names_other_lexicon(job: &ImportJob<'_>, earlier: Option<i64>) -> CorpusResult<bool> {
    let Some(name) = &job.options.lexicon else {
        return Ok(false);
    };
    let named = lexicons::find_lexicon(job.connection, name)?;
    Ok(named.is_none_or(|row| Some(row.id) != earlier))
}

fn lexicon_row(job: &ImportJob<'_>, id: Option<i64>) -> CorpusResult<Option<LexiconRow>> {
    let rows = lexicons::load_lexicon_rows(job.connection)?;
    Ok(rows.into_iter().find(|row| Some(row.id) == id))
}

/// Returns the lexicon that the options name; it is made if the corpus does not have it.
fn named_lexicon(job: &mut ImportJob<'_>) -> CorpusResult<Option<LexiconRow>> {
    let Some(name) = &job.options.lexicon else {
        return Ok(None);
    };
    let mut row = make_lexicon(job, name)?;
    if let Some(code) = &job.options.sign_language {
        let language = Some(lexicon::check_sign_language(code)?);
        if row.language != language {
            row.language = language;
            lexicons::update_lexicon(job.connection, &row)?;
        }
    }
    Ok(Some(row))
}

/// Returns the lexicon of this name; makes it if the corpus does not have it.
fn make_lexicon(job: &mut ImportJob<'_>, name: &str) -> CorpusResult<LexiconRow> {
    if let Some(row) = lexicons::find_lexicon(job.connection, name)? {
        return Ok(row);
    }
    let name = lexicon::check_lexicon_name(name)?;
    job.count_created_rows("lexicons", 1);
    Ok(LexiconRow {
        id: lexicons::insert_lexicon(job.connection, &name)?,
        name,
        ..LexiconRow::default()
    })
}

/// Returns a finding about a recording whose glosses are looked up in no lexicon although the corpus has several, or about
/// its glosses that several entries of its lexicon have.
pub(super) fn unlinked_glosses_finding(job: &ImportJob<'_>, recording: i64) -> CorpusResult<Option<ReportFinding>> {
    let bare = lexicons::bare_glosses_of_recording(job.connection, recording)?;
    if let Some(first) = bare.first() {
        return Ok(Some(ReportFinding::finding_warning(
            format!(
                "glosses of several entries, of which the first was taken: {}",
                bare.join(", ")
            ),
            ErrorRemedy::command_remedy(format!(
                "write {:?} in an annotation that means the second; `chereme list CORPUS signs` lists the entries",
                format!("{first}#2")
            )),
        )));
    }
    let rows = lexicons::load_lexicon_rows(job.connection)?;
    // With a single lexicon, all glosses belong to it without a link.
    if rows.len() < 2 || lexicons::lexicon_of_recording(job.connection, recording)?.is_some() {
        return Ok(None);
    }
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    Ok(Some(ReportFinding::finding_warning(
        format!(
            "its glosses belong to none of the lexicons, since the corpus has several: {}",
            names.join(", ")
        ),
        ErrorRemedy::command_remedy(format!(
            "`chereme lexicon CORPUS link {:?} recording:{recording}` looks them up in that lexicon",
            names.first().copied().unwrap_or_default()
        )),
    )))
}
