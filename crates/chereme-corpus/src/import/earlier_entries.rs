//! The entries that an earlier import of a table left, and the rows that are theirs now.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::lexicon::{LexiconColumnMeaning, LexiconEntry, SignLexicon};
use chereme_sign::ErrorRemedy;
use chereme_sign::text::compose_accents;
use serde_json::{Map, Value};

use super::ImportJob;
use super::lexicon::{SHOWN_NAMES, is_name_of_file};
use crate::db::signs::{self, TokenRow};
use crate::error::CorpusResult;
use crate::forms::row_has_cells;
use crate::lexicon::entry_match::is_row_id_title;
use crate::report_finding::ReportFinding;

/// The entries of earlier imports of the file that no row has taken yet.
#[derive(Default)]
pub(super) struct EarlierEntries {
    /// The entries by gloss, oldest first.
    by_gloss: BTreeMap<String, Vec<EarlierEntry>>,
    /// The column that identifies the rows, if the table has one.
    row_id: Option<RowIdColumn>,
}

/// The column that identifies the rows of a table, whatever else changes in them.
struct RowIdColumn {
    /// Its place among the columns.
    column: usize,
    title: String,
    /// The gloss of the earlier entry with each id.
    earlier_glosses: BTreeMap<String, String>,
    counts: RowIdCounts,
}

/// The rows of a table that was imported before, by their ids.
#[derive(Default)]
struct RowIdCounts {
    new: usize,
    changed: usize,
    unchanged: usize,
}

impl RowIdColumn {
    /// Returns the column whose title says that it identifies rows, and whose cells do. A column that only numbers the rows
    /// does not: a row that is inserted gives all rows below it another number.
    fn find_row_id_column(table: &SignLexicon) -> Option<Self> {
        let column = table.columns.iter().position(|column| {
            let is_other = matches!(
                column.meaning,
                LexiconColumnMeaning::Attribute | LexiconColumnMeaning::Note
            );
            is_other && is_row_id_title(&column.title)
        })?;
        let cell = |entry: &LexiconEntry| entry.cells.get(column).map(|cell| cell.trim().to_owned());
        let ids: Vec<String> = table.entries.iter().filter_map(cell).collect();
        let different: BTreeSet<&String> = ids.iter().filter(|id| !id.is_empty()).collect();
        let is_complete = different.len() == table.entries.len();
        let numbers: Vec<Option<i64>> = ids.iter().map(|id| id.parse().ok()).collect();
        let is_consecutive = numbers
            .windows(2)
            .all(|pair| pair[0].is_some() && pair[0].and_then(|id| id.checked_add(1)) == pair[1]);
        (is_complete && !is_consecutive).then(|| Self {
            column,
            title: table.columns[column].title.clone(),
            earlier_glosses: BTreeMap::new(),
            counts: RowIdCounts::default(),
        })
    }
}

/// An entry of an earlier import.
struct EarlierEntry {
    token: TokenRow,
    /// Its row of the table then: titles and cells, without the gloss and empty cells.
    cells: Map<String, Value>,
}

impl EarlierEntries {
    /// Reads the entries that earlier imports of the table at this place left; `is_known` says whether a file there was
    /// imported before. A table with ids also takes the entries of the lexicon that the user `named`, wherever its former
    /// file was.
    pub(super) fn load_earlier_entries(
        job: &ImportJob<'_>,
        place: &str,
        is_known: bool,
        named: Option<&str>,
        table: &SignLexicon,
    ) -> CorpusResult<Self> {
        let mut all = Self {
            row_id: RowIdColumn::find_row_id_column(table),
            ..Self::default()
        };
        let named = named.filter(|_| all.row_id.is_some());
        let mut namesakes = job.places.files_of_same_name(&job.file_name);
        if named.is_none() && !is_known && !namesakes.any(|row| row.path.is_none()) {
            return Ok(all);
        }
        for token in signs::lexicon_entries(job.connection)? {
            let text = token.source.as_deref().unwrap_or_default();
            // An entry that was not made from a table has no row to compare with.
            let Ok(mut origin) = serde_json::from_str::<Value>(text) else {
                continue;
            };
            let same = match origin["path"].as_str() {
                Some(path) => path == place,
                // Entries of older corpora know only the name of their file.
                None => origin["file"].as_str() == Some(&job.file_name),
            };
            let lexicon = token.lexicon.as_deref();
            // A lexicon that somebody named keeps its entries, whatever else lies at the same place.
            let is_other = job
                .options
                .lexicon
                .as_deref()
                .is_some_and(|named| lexicon != Some(named))
                && lexicon.is_some_and(|lexicon| !is_name_of_file(lexicon, &job.stem));
            let same = same && !is_other || (named.is_some() && lexicon == named);
            // A sign from a SiGML file has no cells: it is an entry of its own.
            if let Value::Object(cells) = origin["cells"].take()
                && same
            {
                let gloss = compose_accents(token.plain_gloss()).into_owned();
                if let Some(row_id) = &mut all.row_id
                    && let Some(id) = cells.get(&row_id.title).and_then(Value::as_str)
                {
                    row_id.earlier_glosses.insert(id.trim().to_owned(), gloss.clone());
                }
                let entries = all.by_gloss.entry(gloss).or_default();
                entries.push(EarlierEntry { token, cells });
            }
        }
        Ok(all)
    }

    /// Takes the entry of a row: the one with the row's id; else the one with the same cells, whose gloss is that of the row
    /// or, because another column was the gloss, that of another cell; otherwise the oldest with the row's gloss, unless it
    /// has another id.
    pub(super) fn take_earlier_entry(&mut self, table: &SignLexicon, row: &LexiconEntry) -> Option<TokenRow> {
        if self.by_gloss.is_empty() {
            return None;
        }
        if let Some(row_id) = &mut self.row_id {
            let id = row.cells.get(row_id.column).map(|cell| cell.trim()).unwrap_or_default();
            let gloss = row_id.earlier_glosses.get(id);
            let entries = gloss.and_then(|gloss| self.by_gloss.get_mut(gloss));
            let has_id = |entry: &EarlierEntry| {
                entry.cells.get(&row_id.title).and_then(Value::as_str).map(str::trim) == Some(id)
            };
            if let Some(entries) = entries
                && let Some(at) = entries.iter().position(has_id)
            {
                let entry = entries.remove(at);
                let is_same_gloss = compose_accents(entry.token.plain_gloss()) == compose_accents(&row.gloss);
                match is_same_gloss && row_has_cells(table, row, &entry.cells) {
                    true => row_id.counts.unchanged += 1,
                    false => row_id.counts.changed += 1,
                }
                return Some(entry.token);
            }
            row_id.counts.new += 1;
        }
        for (column, cell) in table.columns.iter().zip(&row.cells) {
            let entries = self.by_gloss.get_mut(&*compose_accents(cell.trim()));
            let is_row = |entry: &EarlierEntry| {
                // The stored cells lack the gloss, so the column that is missing in them was the gloss then.
                !entry.cells.contains_key(&column.title) && row_has_cells(table, row, &entry.cells)
            };
            if let Some(entries) = entries
                && let Some(at) = entries.iter().position(is_row)
            {
                return Some(entries.remove(at).token);
            }
        }
        let gloss_entries = self.by_gloss.get_mut(&*compose_accents(&row.gloss));
        let title = self.row_id.as_ref().map(|row_id| row_id.title.as_str());
        // An entry with an id of its own is another row's, or nobody's.
        let is_free = |entry: &EarlierEntry| title.is_none_or(|title| !entry.cells.contains_key(title));
        let entries = gloss_entries?;
        let at = entries.iter().position(is_free)?;
        Some(entries.remove(at).token)
    }

    /// Returns whether a column identifies the rows of the table.
    pub(super) fn has_row_ids(&self) -> bool {
        self.row_id.is_some()
    }

    /// Returns whether a sign has an entry that no row has taken yet.
    pub(super) fn holds_sign(&self, gloss: &str, sign: i64) -> bool {
        let entries = self.by_gloss.get(&*compose_accents(gloss));
        entries.is_some_and(|entries| entries.iter().any(|entry| entry.token.sign_id == sign))
    }

    /// Returns a finding about the rows that are new, changed and gone since the table was imported before, by their ids.
    pub(super) fn row_id_finding(&self) -> Option<ReportFinding> {
        let row_id = self
            .row_id
            .as_ref()
            .filter(|row_id| !row_id.earlier_glosses.is_empty())?;
        let RowIdCounts {
            new,
            changed,
            unchanged,
        } = row_id.counts;
        let gone: usize = self.by_gloss.values().map(Vec::len).sum();
        Some(ReportFinding::finding_note(format!(
            "its rows were recognised by the column {:?}: {new} new, {changed} changed, {unchanged} as before, {gone} gone",
            row_id.title
        )))
    }

    /// Returns a finding about the entries that no row of the table has taken.
    pub(super) fn missing_entries_finding(&self) -> Option<ReportFinding> {
        let mut glosses = self.by_gloss.iter().filter(|(_, left)| !left.is_empty());
        let shown_glosses = glosses.by_ref().take(SHOWN_NAMES);
        let shown: Vec<&str> = shown_glosses.map(|(gloss, _)| gloss.as_str()).collect();
        let more = match glosses.count() {
            0 => String::new(),
            more => format!(", and {more} more"),
        };
        let message = format!(
            "signs of an earlier version of this table that have no row here, and were kept: {}{more}",
            shown.join(", ")
        );
        let remedy = ErrorRemedy::command_remedy(
            "`chereme delete CORPUS sign:GLOSS` deletes a sign that is not wanted any more; or put its row back into the \
             table, and import that again",
        );
        (!shown.is_empty()).then(|| ReportFinding::finding_warning(message, remedy))
    }
}
