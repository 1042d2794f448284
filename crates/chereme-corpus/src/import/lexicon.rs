//! Imports tables of lexicon codings: each row is a sign whose citation form is a token without movement.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::ImportFinding;
use chereme_formats::lexicon::{self, ComponentCoding, LexiconColumn, LexiconColumnMeaning, LexiconEntry, SignLexicon};
use chereme_formats::roles::TierMapping;
use chereme_formats::table::TableError;
use chereme_sign::query::NumberSpelling;
use chereme_sign::text::{compose_accents, fold_text};
use chereme_sign::{ComponentInventory, ComponentReading, ErrorRemedy, InventoryValue, SignComponent};
use serde_json::{Map, Value, json};

use super::earlier_entries::EarlierEntries;
use super::import_lexicons::{LexiconCells, lexicon_of_table, names_other_lexicon};
use super::import_notation::{LexiconNotationText, NotationValueMapper};
use super::import_relations::RelationColumns;
use super::{FileReport, FileStatus, ImportJob};
use crate::db::edits;
use crate::db::lexicons;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_attributes::{self, AttributeRow, MEASURE_PREFIX};
use crate::db::stored_columns::{RecordOrigin, ValueState};
use crate::db::stored_recordings::{self, SourceFileRow};
use crate::error::{CorpusError, CorpusResult};
use crate::inventories;
use crate::lexicon::entry_match;
use crate::progress::{ProgressReceiver, ProgressUnit};
use crate::report_finding::ReportFinding;

/// The number of names of values that a finding lists.
pub(super) const SHOWN_NAMES: usize = 8;

pub(super) fn import_lexicon(job: &mut ImportJob<'_>, progress: &mut ProgressReceiver<'_>) -> CorpusResult<FileReport> {
    let source = LexiconFileSource::find_lexicon_source(job)?;
    // The bytes may be those of another lexicon, which stays as it is.
    let earlier_report = source.newest.and_then(|_| job.report_unchanged_file());
    if let Some(report) = &earlier_report
        // A mapping or a lexicon may give the same bytes another meaning.
        && job.options.mapping.mapping_entry_names().next().is_none()
        && job.options.lexicon.is_none()
    {
        return Ok(report.clone());
    }
    let bytes = job.read_job_bytes()?;
    let columns = LexiconColumnsRead::read_lexicon_columns(job, &source, &bytes)?;
    // A lexicon that is named now takes the signs over.
    let is_taken_over = source.is_of_other_lexicon(job)?;
    let (table, findings) = match columns.read {
        // A folder may hold tables of other kinds, which are no reason to complain.
        Err(error @ TableError::Missing { .. }) if !job.named => {
            return Ok(FileReport::skipped_file_report(job.path, &lexicon_table_error(&error)));
        }
        other => other.map_err(|error| lexicon_table_error(&error))?,
    };
    let mut report = match earlier_report {
        Some(report) if !columns.is_mapped_now && !is_taken_over => return Ok(report),
        Some(_) => FileReport::new(job.path, FileStatus::Updated),
        None => FileReport::new(job.path, FileStatus::Imported),
    };
    let remapped = report.status == FileStatus::Updated;
    let stated = stated_meanings(&table, &columns.mapping);
    if remapped && columns.is_mapped_now {
        report.findings.push(ReportFinding::finding_note(
            "it was imported before: its columns were read again, as the mapping says",
        ));
    } else if columns.is_mapped_before && !stated.is_empty() {
        let stated_texts = stated.iter().map(|(title, text)| format!("{title:?} {text}"));
        let named: Vec<String> = stated_texts.collect();
        report.findings.push(ReportFinding::finding_note(format!(
            "its columns were read as in the import before, by the mapping given then: {}",
            named.join(", ")
        )));
    }
    report.findings.extend(findings.into_iter().map(ReportFinding::from));
    report.understood.columns = Some(table.columns.clone());
    let inventories = store_inventories(job, &table, &mut report)?;
    let file = match source.same_bytes {
        // The bytes are stored already, so the row of the file stays and only its meaning changes.
        Some(id) if remapped => id,
        _ => job.keep_source_file(None, Some(&bytes))?,
    };
    stored_recordings::set_source_mapping(job.connection, file, &stated)?;
    let mut signs = LexiconSigns::prepare_lexicon_signs(job, &table, source, file, &mut report)?;
    let numerals = numerals(&table);
    report.findings.extend(unsure_numbers(&table, &numerals));
    let stored = job.inventories.clone();
    let words = NotationValueMapper::new(&stored);
    let total = Some(table.entries.len() as u64);
    let relations = RelationColumns::find_relation_columns(job, &table)?;
    let mut tokens = Vec::new();
    for (done, entry) in table.entries.iter().enumerate() {
        let token = import_entry(job, &table, entry, (&inventories, &numerals), &mut signs)?;
        tokens.push(token);
        if let Some(text) = &entry.notation {
            let notation = LexiconNotationText {
                token,
                file,
                line: entry.line,
                gloss: &entry.gloss,
                text,
            };
            notation.import_sign_notation(job, &words, &mut report)?;
        }
        if done % 256 == 0 {
            let done = done as u64;
            progress.report_amount(ProgressUnit::Items, &job.file_name, done, total)?;
        }
    }
    signs.leave_emptied(job)?;
    relations.store_table_relations(job, &table, &tokens, &mut report)?;
    report.findings.extend(signs.further_forms_finding());
    report.findings.extend(signs.homonyms_finding());
    report.findings.extend(signs.renamed_signs_finding());
    report.findings.extend(signs.earlier.row_id_finding());
    report.findings.extend(signs.earlier.missing_entries_finding());
    Ok(report)
}

/// The columns of a table as a mapping understands them.
struct LexiconColumnsRead {
    read: Result<(SignLexicon, Vec<ImportFinding>), TableError>,
    mapping: TierMapping,
    /// Whether the mapping of this import names a column.
    is_mapped_now: bool,
    /// Whether the mapping is that of an earlier import.
    is_mapped_before: bool,
}

impl LexiconColumnsRead {
    fn read_lexicon_columns(job: &mut ImportJob<'_>, source: &LexiconFileSource, bytes: &[u8]) -> CorpusResult<Self> {
        let mapping = job.options.mapping.clone();
        let read = lexicon::read_lexicon(bytes, &mapping);
        let is_mapped_now = read.as_ref().is_ok_and(|(table, _)| map_columns(job, table));
        let before = match source.newest {
            // A mapping that was given once holds for new versions of the file, too, until another is given.
            Some(id) if !is_mapped_now => stored_recordings::source_mapping(job.connection, id)?,
            _ => None,
        };
        let is_mapped_before = before.is_some();
        let (read, mapping) = match before {
            Some(before) => (lexicon::read_lexicon(bytes, &before), before),
            None => (read, mapping),
        };
        Ok(Self {
            read,
            mapping,
            is_mapped_now,
            is_mapped_before,
        })
    }
}

/// The earlier imports of a file.
#[derive(Default)]
struct LexiconFileSource {
    /// The path under which entries of the file are known.
    place: String,
    /// The newest file at that path, of any bytes.
    newest: Option<i64>,
    /// The file of the same bytes.
    same_bytes: Option<i64>,
}

impl LexiconFileSource {
    fn find_lexicon_source(job: &ImportJob<'_>) -> CorpusResult<Self> {
        let same_file = || job.places.files_with_hash(&job.hash).filter(|row| row.kind == job.kind);
        let here = |row: &&SourceFileRow| row.path.as_deref() == Some(&job.place);
        // A copy at this path counts more than one that was moved from elsewhere.
        let same = same_file().find(here).or_else(|| same_file().next());
        let earlier_place = same.and_then(|row| row.path.as_ref());
        let place = earlier_place.unwrap_or(&job.place).clone();
        let newest = job.places.find_file_at(&place, job.kind).or(same);
        let source = Self {
            newest: newest.map(|row| row.id),
            same_bytes: same.map(|row| row.id),
            place,
        };
        // Only a lexicon that nobody named is renamed by a later import; a named one keeps its entries.
        match source.is_of_other_lexicon(job)? && !source.has_name_of_file(job)? {
            true => Ok(Self {
                place: source.place,
                ..Self::default()
            }),
            false => Ok(source),
        }
    }

    /// Returns whether the lexicon of the earlier import has the name of the file, as one that nobody named.
    fn has_name_of_file(&self, job: &ImportJob<'_>) -> CorpusResult<bool> {
        let lexicon = match self.newest {
            Some(file) => lexicons::lexicon_of_file(job.connection, file)?,
            None => None,
        };
        let rows = lexicons::load_lexicon_rows(job.connection)?;
        let row = rows.iter().find(|row| Some(row.id) == lexicon);
        Ok(row.is_none_or(|row| is_name_of_file(&row.name, &job.stem)))
    }

    /// Returns whether the options name another lexicon than that of the earlier import.
    fn is_of_other_lexicon(&self, job: &ImportJob<'_>) -> CorpusResult<bool> {
        let earlier = match self.newest {
            Some(file) => lexicons::lexicon_of_file(job.connection, file)?,
            None => None,
        };
        names_other_lexicon(job, earlier)
    }
}

/// Returns whether a lexicon has the name that the import of a file gives one: `asl`, or `asl (2)`.
pub(super) fn is_name_of_file(lexicon: &str, stem: &str) -> bool {
    let rest = lexicon.strip_prefix(stem.trim());
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(" ("))
}

/// Returns the meanings of the columns that a mapping names, as mappings spell them, by title.
fn stated_meanings(table: &SignLexicon, mapping: &TierMapping) -> BTreeMap<String, String> {
    let columns = table.columns.iter();
    let stated = columns.filter(|column| mapping.column_mapping_entry(&column.title).is_some());
    let meaning = |column: &LexiconColumn| (column.title.clone(), column.meaning.to_string());
    stated.map(meaning).collect()
}

/// Returns the spelling of the numbers in each column of attributes.
fn numerals(table: &SignLexicon) -> BTreeMap<&str, NumberSpelling> {
    let mut cells: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (name, text) in table.entries.iter().flat_map(|entry| &entry.attributes) {
        cells.entry(name).or_default().push(text);
    }
    let spelled = |(name, cells): (_, Vec<&str>)| (name, NumberSpelling::from_column_cells(cells));
    cells.into_iter().map(spelled).collect()
}

/// Returns a finding for each column with numbers such as `1,234` whose comma may as well part thousands.
fn unsure_numbers(table: &SignLexicon, numerals: &BTreeMap<&str, NumberSpelling>) -> Vec<ReportFinding> {
    let mut unsure: BTreeMap<&str, (u64, &str, f64, usize)> = BTreeMap::new();
    for entry in &table.entries {
        for (name, text) in &entry.attributes {
            let column = numerals
                .get(name.as_str())
                .filter(|candidate| candidate.is_ambiguous(text));
            if let Some(number) = column.and_then(|column| column.parse_cell_number(text)) {
                let first = (entry.line, text.trim(), number, 0);
                unsure.entry(name).or_insert(first).3 += 1;
            }
        }
    }
    let finding = |(name, (line, text, number, count)): (&str, (u64, &str, f64, usize))| {
        ReportFinding::from(
            ImportFinding::new_warning_finding(
                line,
                format!(
                    "numbers in the column {name:?} may have a comma before decimals or before thousands; {text:?} was \
                     read as {number}, and so were {count} in all"
                ),
            )
            .with_remedy("if the comma parts thousands, save the table without it, and import it again"),
        )
    };
    unsure.into_iter().map(finding).collect()
}

fn lexicon_table_error(error: &TableError) -> CorpusError {
    CorpusError::from_wrong_message(error.to_string())
        .with_advice("a lexicon is a table with a header row and a column of glosses")
}

/// Records which entries of the mapping name a column of the table, and returns whether any does.
fn map_columns(job: &mut ImportJob<'_>, table: &SignLexicon) -> bool {
    let mut any = false;
    for column in &table.columns {
        if let Some((entry, _)) = job.options.mapping.column_mapping_entry(&column.title) {
            job.used.insert(entry.to_owned());
            any = true;
        }
    }
    any
}

type InventoryKey = (SignComponent, Option<String>);

/// The row of a part's inventory, and the value for each spelling in the table.
struct KnownInventoryPart {
    row: i64,
    values: BTreeMap<String, String>,
}

/// The signs of the table so far, by gloss; each is looked up once, however many rows share it.
#[derive(Default)]
struct LexiconSigns {
    source: LexiconFileSource,
    /// The lexicon to which they belong, unless their row names one.
    lexicon: Option<i64>,
    by_row: LexiconCells,
    known: BTreeMap<EntryKey, i64>,
    signs: BTreeMap<i64, KnownSign>,
    /// The largest number that a row got without saying one, by lexicon and gloss.
    numbers: BTreeMap<(Option<i64>, String), i64>,
    earlier: EarlierEntries,
    /// The signs that lost an entry to another gloss, with the cells of its row.
    left: BTreeMap<i64, BTreeSet<String>>,
    /// The rows that are forms of a sign with another row, each with its line.
    further_forms: Vec<String>,
    /// The signs whose gloss changed in the table, each with both.
    renamed: Vec<String>,
}

/// Lexicon and gloss of an entry, and its number among those of the gloss if something keeps them apart.
type EntryKey = (Option<i64>, String, Option<i64>);

/// A sign of the corpus to which rows of the table add entries.
struct KnownSign {
    id: i64,
    /// Whether one of its tokens is its citation form.
    has_citation: bool,
}

impl LexiconSigns {
    /// Returns the signs of a table before its first row: their lexicon, and the entries of earlier imports.
    fn prepare_lexicon_signs(
        job: &mut ImportJob<'_>,
        table: &SignLexicon,
        source: LexiconFileSource,
        file: i64,
        report: &mut FileReport,
    ) -> CorpusResult<Self> {
        let by_row = LexiconCells::read_lexicon_cells(job, table)?;
        // A table that names the lexicon in each row needs none for itself.
        let lexicon = match by_row.covers_all_rows {
            true => None,
            false => lexicon_of_table(job, source.newest)?,
        };
        if let Some(lexicon) = &lexicon {
            lexicons::set_file_lexicon(job.connection, file, lexicon.id)?;
        }
        let names = lexicon
            .iter()
            .map(|lexicon| &lexicon.name)
            .chain(by_row.lexicons.keys());
        let names: Vec<&str> = names.map(String::as_str).collect();
        if let Some(lexicon) = lexicon
            .as_ref()
            .filter(|_| job.options.lexicon.is_none() && source.newest.is_none())
            && lexicon.name != job.stem.trim()
            && is_name_of_file(&lexicon.name, &job.stem)
        {
            let (name, other) = (&lexicon.name, &job.stem);
            report.findings.push(ReportFinding::finding_warning(
                format!("there is a lexicon {other:?}, so this one is called {name:?}"),
                ErrorRemedy::command_remedy(format!(
                    "if it is a newer version, undo, and import it with --lexicon {other:?}"
                )),
            ));
        }
        report.understood.lexicon = (!names.is_empty()).then(|| names.join(", "));
        let named = job.options.lexicon.as_ref().and(lexicon.as_ref());
        let named = named.map(|lexicon| lexicon.name.as_str());
        Ok(Self {
            earlier: EarlierEntries::load_earlier_entries(job, &source.place, source.newest.is_some(), named, table)?,
            source,
            lexicon: lexicon.map(|lexicon| lexicon.id),
            by_row,
            ..Self::default()
        })
    }

    /// Returns the sign of a row, which had an entry before if `earlier` is one; inserts it if it is missing.
    fn sign_of_row(
        &mut self,
        job: &mut ImportJob<'_>,
        row: &LexiconEntry,
        earlier: Option<&TokenRow>,
    ) -> CorpusResult<&mut KnownSign> {
        let lexicon = self.by_row.lexicon_of_row(row).or(self.lexicon);
        let gloss = compose_accents(&row.gloss).into_owned();
        if let Some(token) = earlier
            && let Some(id) = self.keep_renamed_sign(job, row, token, lexicon)?
        {
            let has_citation = signs::has_citation(job.connection, id)?;
            return Ok(self.signs.entry(id).or_insert(KnownSign { id, has_citation }));
        }
        let number = match self.by_row.number_of_row(row) {
            Some(number) => Some(number),
            None => self.number_of_entry(job, (lexicon, &gloss), earlier)?,
        };
        let id = match self.known.entry((lexicon, gloss, number)) {
            Entry::Occupied(known) => {
                self.further_forms.push(format!("{}, line {}", row.gloss, row.line));
                *known.get()
            }
            Entry::Vacant(new) => {
                let sign = match number {
                    Some(number) => signs::enter_homonym(job.connection, lexicon, &row.gloss, number)?,
                    None => signs::enter_sign(job.connection, lexicon, &row.gloss)?,
                };
                job.count_created_rows("signs", usize::from(sign.is_new));
                *new.insert(sign.id)
            }
        };
        match self.signs.entry(id) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(new) => Ok(new.insert(KnownSign {
                id,
                has_citation: signs::has_citation(job.connection, id)?,
            })),
        }
    }

    /// Returns the sign of an entry whose gloss the table or a person changed since the last import: it stays the same sign,
    /// with its translations, remarks and relations. A gloss that the table changed becomes that of the sign, unless a person
    /// gave it another one. Nothing if the row is an entry by its gloss.
    fn keep_renamed_sign(
        &mut self,
        job: &mut ImportJob<'_>,
        row: &LexiconEntry,
        token: &TokenRow,
        lexicon: Option<i64>,
    ) -> CorpusResult<Option<i64>> {
        let sign = token.sign_id;
        let own = compose_accents(token.plain_gloss()).into_owned();
        let now = compose_accents(&row.gloss).into_owned();
        let stays_in_lexicon = lexicons::lexicon_of_sign(job.connection, sign)? == lexicon;
        if !self.earlier.has_row_ids() || own == now || !stays_in_lexicon {
            return Ok(None);
        }
        let source = token.source.as_deref().unwrap_or_default();
        let origin: Value = serde_json::from_str(source).unwrap_or_default();
        let before = origin["gloss"].as_str().unwrap_or(&own);
        let is_tables_gloss = compose_accents(before) == own.as_str();
        let number = token.homonym.unwrap_or(1);
        let key = |gloss: &str| (lexicon, gloss.to_owned(), Some(number));
        if is_tables_gloss {
            let is_taken = signs::find_entry(job.connection, lexicon, &now, Some(number))?.is_some()
                || self.known.contains_key(&key(&now));
            // Other rows of the sign still say the former gloss.
            if is_taken || entry_match::lexicon_tokens(job.connection, sign)?.len() > 1 {
                return Ok(None);
            }
            let (_, notes) = edits::sign_gloss_and_notes(job.connection, sign)?;
            let label = signs::sign_label(job.connection, sign)?;
            edits::update_sign(job.connection, sign, (&row.gloss, number), notes.as_deref())?;
            let renamed = signs::sign_label(job.connection, sign)?;
            edits::replace_gloss_values(job.connection, sign, &label, &renamed)?;
            job.counts.count_changed_rows("signs", 1);
            self.renamed.push(format!("{label} is {renamed}"));
        } else if compose_accents(before) != now.as_str() {
            self.renamed.push(format!("{own} (the table says {now})"));
        }
        let gloss = if is_tables_gloss { &now } else { &own };
        self.known.insert(key(gloss), sign);
        Ok(Some(sign))
    }

    /// Returns a finding about the signs whose gloss changed in the table.
    fn renamed_signs_finding(&self) -> Option<ReportFinding> {
        let list = self.renamed.iter().take(SHOWN_NAMES).map(String::as_str);
        let list = list.collect::<Vec<_>>().join("; ");
        (!list.is_empty()).then(|| {
            ReportFinding::finding_note(format!(
                "signs with another gloss in the table, which stay the same signs: {} ({list})",
                self.renamed.len()
            ))
        })
    }

    /// Returns the number of a row among the entries of its gloss: the one that it had before, unless another row has it;
    /// otherwise, if the rows have ids, the first that no other row has. Without ids, rows of one gloss are one entry.
    fn number_of_entry(
        &mut self,
        job: &ImportJob<'_>,
        (lexicon, gloss): (Option<i64>, &str),
        earlier: Option<&TokenRow>,
    ) -> CorpusResult<Option<i64>> {
        let has_ids = self.earlier.has_row_ids();
        let is_taken = |number| has_ids && self.known.contains_key(&(lexicon, gloss.to_owned(), Some(number)));
        let stays = earlier.filter(|token| compose_accents(token.plain_gloss()) == gloss);
        let before = stays.map(|token| token.homonym.unwrap_or(1));
        if let Some(number) = before.filter(|number| !is_taken(*number)) {
            return Ok(Some(number));
        }
        if !has_ids {
            return Ok(None);
        }
        let last = self.numbers.entry((lexicon, gloss.to_owned())).or_default();
        loop {
            *last += 1;
            let sign = signs::find_entry(job.connection, lexicon, gloss, Some(*last))?;
            let is_held = sign.is_some_and(|sign| self.earlier.holds_sign(gloss, sign));
            if !is_held && !self.known.contains_key(&(lexicon, gloss.to_owned(), Some(*last))) {
                return Ok(Some(*last));
            }
        }
    }

    /// Returns a finding about the glosses that several entries have.
    fn further_forms_finding(&self) -> Option<ReportFinding> {
        let list = self.further_forms.iter().take(SHOWN_NAMES).map(String::as_str);
        let list = list.collect::<Vec<_>>().join("; ");
        (!list.is_empty()).then(|| {
            let count = self.further_forms.len();
            let message = format!(
                "rows that are forms of a sign with another row, as nothing keeps them apart: {count} ({list})"
            );
            let remedy =
                "if they are signs of their own, add a column \"homonym\" with 1, 2 and so on, or a column \"id\" whose cells do more than number the rows";
            ReportFinding {
                remedy: Some(remedy.into()),
                ..ReportFinding::finding_note(message)
            }
        })
    }

    fn homonyms_finding(&self) -> Option<ReportFinding> {
        let numbered = self.known.keys().filter(|(_, _, number)| *number > Some(1));
        let labels = numbered.map(|(_, gloss, number)| format!("{gloss}#{}", number.unwrap_or_default()));
        let all: Vec<String> = labels.collect();
        let shown = all.iter().take(SHOWN_NAMES).map(String::as_str);
        let list = shown.collect::<Vec<_>>().join(", ");
        (!all.is_empty()).then(|| {
            ReportFinding::finding_note(format!(
                "entries whose gloss another entry has, too: {} ({list}); annotations of the bare gloss mean the first",
                all.len()
            ))
        })
    }

    /// Deletes the signs that have no entry any more, with the translations that the table gave them, and gives the
    /// others a citation form.
    fn leave_emptied(&self, job: &mut ImportJob<'_>) -> CorpusResult<()> {
        for (sign, cells) in &self.left {
            let tokens = signs::tokens_of_sign(job.connection, *sign)?;
            match tokens.first() {
                Some(first) if !first.citation => {
                    edits::set_citation_token(job.connection, *sign, first.id)?;
                }
                Some(_) => {}
                None => {
                    for (language, text) in signs::list_sign_translations(job.connection, *sign)? {
                        if cells.contains(&text) {
                            edits::remove_text(job.connection, *sign, &language, &text)?;
                        }
                    }
                    let gone = signs::delete_empty_sign(job.connection, *sign)?;
                    job.counts.count_removed_rows("signs", usize::from(gone));
                }
            }
        }
        Ok(())
    }
}

/// Stores the values that the table uses, unless an inventory of the corpus already has them all and keeps them apart.
fn store_inventories(
    job: &mut ImportJob<'_>,
    table: &SignLexicon,
    report: &mut FileReport,
) -> CorpusResult<BTreeMap<InventoryKey, KnownInventoryPart>> {
    let mut known_inventories = BTreeMap::new();
    for used in table.component_inventories() {
        let part = (used.component, used.feature.clone());
        let same = |inventory: &ComponentInventory| {
            (inventory.component, &inventory.feature) == (used.component, &used.feature)
        };
        // An inventory that fits serves many tables, so that their values can be compared.
        let complete = job.inventories.iter().find(|stored| {
            let values = used.values.keys().map(String::as_str);
            same(&stored.inventory) && stored.inventory.keeps_apart(values)
        });
        let (row, inventory) = match complete {
            Some(stored) => {
                let texts = used.values.keys().map(String::as_str);
                report.findings.extend(renamed_values_finding(&stored.inventory, texts));
                (stored.id, stored.inventory.clone())
            }
            None => {
                let new_inventory = own_inventory(&job.stem, &used);
                let mut stored = job.inventories.iter().map(|entry| &entry.inventory);
                let before = stored.find(|inventory| inventory.id == new_inventory.id);
                let is_new = before.is_none();
                let inventory = inventories::join_stored_inventory(before, new_inventory);
                let row = inventories::store_inventory(job.connection, &inventory)?;
                job.count_created_rows("inventories", usize::from(is_new));
                (row, inventory)
            }
        };
        let value_id = |value: &String| Some((value.clone(), inventory.find_inventory_value(value)?.id.clone()));
        let values = used.values.keys().filter_map(value_id).collect();
        known_inventories.insert(part, KnownInventoryPart { row, values });
    }
    Ok(known_inventories)
}

/// Returns a finding about the values that have different names in the table and in the inventory.
fn renamed_values_finding<'t>(
    inventory: &ComponentInventory,
    texts: impl Iterator<Item = &'t str>,
) -> Option<ReportFinding> {
    let renamed = texts.filter_map(|text| {
        let id = &inventory.find_inventory_value(text)?.id;
        (fold_text(id) != fold_text(text.trim())).then(|| format!("{} = {id}", text.trim()))
    });
    let renamed: Vec<String> = renamed.collect();
    let shown_names = renamed.iter().take(SHOWN_NAMES).map(String::as_str);
    let shown = shown_names.collect::<Vec<_>>().join(", ");
    let more = match renamed.len().saturating_sub(SHOWN_NAMES) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    (!renamed.is_empty()).then(|| {
        ReportFinding::finding_note(format!(
            "the inventory {:?} has other names for values, under which they are stored: {shown}{more}",
            inventory.id
        ))
    })
}

fn own_inventory(stem: &str, used: &lexicon::LexiconInventory) -> ComponentInventory {
    let feature = used
        .feature
        .as_ref()
        .map_or(String::new(), |feature| format!(".{feature}"));
    ComponentInventory {
        id: format!("{stem}/{}{feature}", used.component),
        component: used.component,
        feature: used.feature.clone(),
        version: 1,
        language: None,
        names: BTreeMap::from([("en".to_owned(), format!("{}{feature} of {stem}", used.component))]),
        description: format!("The values that the table {stem} uses."),
        values: used
            .values
            .keys()
            .map(|value| InventoryValue {
                id: value.trim().to_owned(),
                ..InventoryValue::default()
            })
            .collect(),
    }
}

fn import_entry(
    job: &mut ImportJob<'_>,
    table: &SignLexicon,
    entry: &LexiconEntry,
    (inventories, numerals): (
        &BTreeMap<InventoryKey, KnownInventoryPart>,
        &BTreeMap<&str, NumberSpelling>,
    ),
    signs: &mut LexiconSigns,
) -> CorpusResult<i64> {
    let connection = job.connection;
    let earlier_token = signs.earlier.take_earlier_entry(table, entry);
    let (is_known, mut is_moved) = (earlier_token.is_some(), false);
    let source = Some(lexicon_row_cells(job, (table, &signs.source), entry).to_string());
    let sign = signs.sign_of_row(job, entry, earlier_token.as_ref())?;
    for (language, text) in &entry.translations {
        signs::add_text(connection, sign.id, language, text)?;
    }
    let token = match earlier_token {
        Some(token) => {
            let row = TokenRow {
                sign_id: sign.id,
                // An entry that comes to another sign must not displace the citation form there.
                citation: match token.sign_id == sign.id {
                    true => token.citation,
                    false => !sign.has_citation,
                },
                source,
                ..token.clone()
            };
            sign.has_citation |= row.citation;
            if row != token {
                signs::update_token(connection, &row)?;
            }
            is_moved = row.sign_id != token.sign_id;
            if is_moved {
                // Whether the former sign is empty is known only after the last row.
                let left = signs.left.entry(token.sign_id).or_default();
                left.extend(entry.cells.iter().map(|cell| cell.trim().to_owned()));
            }
            token.id
        }
        None => {
            let row = TokenRow {
                sign_id: sign.id,
                origin: RecordOrigin::Lexicon,
                citation: !sign.has_citation,
                source,
                ..TokenRow::default()
            };
            sign.has_citation = true;
            job.count_created_rows("tokens", 1);
            signs::insert_token(connection, &row)?
        }
    };
    let mut attributes: Vec<AttributeRow> = (entry.attributes.iter())
        // Lexicon and number are stored as such, and would only repeat themselves among the attributes.
        .filter(|(name, _)| !signs.by_row.titles.contains(name))
        .map(|(name, text)| AttributeRow {
            name: name.clone(),
            text: text.clone(),
            number: (numerals.get(name.as_str())).and_then(|column| column.parse_cell_number(text)),
        })
        .collect();
    if is_known {
        // Measures of the program are not the table's to remove.
        let stored = stored_attributes::of_tokens(connection, &[token])?.remove(&token);
        let measures = stored
            .into_iter()
            .flatten()
            .filter(|row| row.name.starts_with(MEASURE_PREFIX));
        attributes.extend(measures);
    }
    stored_attributes::set_token_attributes(connection, token, &attributes)?;
    let values: Vec<TokenValueRow> = entry
        .codings
        .iter()
        .map(|coding| value_row(coding, inventories))
        .collect();
    if is_moved || is_known && !signs::load_token_values(connection, token)?.starts_with(&values) {
        job.counts.count_changed_rows("tokens", 1);
    }
    // The table is the source of these values, so it replaces them all.
    signs::set_values(connection, token, &values)?;
    Ok(token)
}

fn value_row(coding: &ComponentCoding, inventories: &BTreeMap<InventoryKey, KnownInventoryPart>) -> TokenValueRow {
    let known_inventory = inventories.get(&(coding.component, coding.feature.clone()));
    let value = coding.reading.reading_value().map(|value| {
        let same = known_inventory.and_then(|known| known.values.get(value));
        same.cloned().unwrap_or_else(|| value.to_owned())
    });
    let is_value = matches!(coding.reading, ComponentReading::Value(_));
    TokenValueRow {
        hand: coding.hand,
        component: coding.component,
        feature: coding.feature.clone(),
        phase: coding.phase,
        state: ValueState::state_of_reading(&coding.reading),
        value,
        inventory_id: known_inventory.filter(|_| is_value).map(|known| known.row),
        annotation_id: None,
        standing: None,
    }
}

/// Returns the cells of a row as in the table, so that nothing is lost.
fn lexicon_row_cells(
    job: &ImportJob<'_>,
    (table, source): (&SignLexicon, &LexiconFileSource),
    entry: &LexiconEntry,
) -> Value {
    let cells: Map<String, Value> = table
        .columns
        .iter()
        .zip(&entry.cells)
        .filter(|(column, cell)| {
            !cell.trim().is_empty() && !matches!(column.meaning, LexiconColumnMeaning::Gloss { .. })
        })
        .map(|(column, cell)| (column.title.clone(), Value::from(cell.as_str())))
        .collect();
    json!({
        "file": job.file_name, "path": source.place, "line": entry.line, "gloss": entry.gloss, "cells": cells
    })
}
