//! Imports tables of lexicon codings: each row is a sign whose citation form is a token without movement.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use chereme_formats::Finding;
use chereme_formats::lexicon::{self, Coding, Lexicon, LexiconEntry, Meaning};
use chereme_formats::table::TableError;
use chereme_sign::query::Numerals;
use chereme_sign::text::{composed, fold};
use chereme_sign::{Component, Inventory, InventoryValue, Reading};
use serde_json::{Map, Value, json};

use super::notation::{Text, Words};
use super::report::ReportFinding;
use super::{FileReport, FileStatus, Job};
use crate::db::attributes::{self, AttributeRow};
use crate::db::columns::{Origin, ValueState};
use crate::db::notations;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::error::{Error, Result};
use crate::inventories;
use crate::progress::{Progress, Step, Unit};

/// The number of names of values that a finding lists.
const SHOWN_NAMES: usize = 8;

pub(super) fn import(job: &mut Job<'_>, progress: &mut Progress<'_>) -> Result<FileReport> {
    let known = job.unchanged();
    if let Some(report) = &known
        && job.options.mapping.entries().next().is_none()
    {
        return Ok(report.clone());
    }
    let bytes = job.bytes()?;
    let (table, findings) = match lexicon::read(&bytes, &job.options.mapping) {
        Err(error @ TableError::Missing { .. }) if !job.named => {
            return Ok(FileReport::skipped(job.path, &wrong(&error)));
        }
        other => other.map_err(|error| wrong(&error))?,
    };
    let mapped = map_columns(job, &table);
    let mut report = match known {
        Some(report) if !mapped => return Ok(report),
        Some(_) => FileReport::new(job.path, FileStatus::Updated),
        None => FileReport::new(job.path, FileStatus::Imported),
    };
    let remapped = report.status == FileStatus::Updated;
    if remapped {
        report.findings.push(ReportFinding::note(
            "it was imported before: its columns were read again, as the mapping says",
        ));
    }
    report
        .findings
        .extend(findings.into_iter().map(ReportFinding::from));
    report.understood.columns = Some(table.columns.clone());
    let inventories = store_inventories(job, &table, &mut report)?;
    let before = job
        .places
        .hashed(&job.hash)
        .find(|row| row.kind == job.kind);
    let file = match before.map(|row| row.id) {
        Some(id) if remapped => id,
        _ => job.keep(None, Some(&bytes))?,
    };
    let numerals = numerals(&table);
    report.findings.extend(unsure_numbers(&table, &numerals));
    let stored = job.inventories.clone();
    let words = Words::new(&stored);
    let total = Some(table.entries.len() as u64);
    let mut signs = Signs::default();
    for (done, entry) in table.entries.iter().enumerate() {
        let token = import_entry(job, &table, entry, (&inventories, &numerals), &mut signs)?;
        if let Some(text) = &entry.notation {
            let notation = Text {
                token,
                file,
                line: entry.line,
                gloss: &entry.gloss,
                text,
            };
            notation.import(job, &words, &mut report)?;
        }
        if done % 256 == 0 {
            let done = done as u64;
            progress.report(Step {
                task: &job.file_name,
                done,
                total,
                unit: Unit::Items,
            })?;
        }
    }
    Ok(report)
}

/// Returns the spelling of the numbers in each column of attributes.
fn numerals(table: &Lexicon) -> BTreeMap<&str, Numerals> {
    let mut cells: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for (name, text) in table.entries.iter().flat_map(|entry| &entry.attributes) {
        cells.entry(name).or_default().push(text);
    }
    let spelled = |(name, cells): (_, Vec<&str>)| (name, Numerals::of(cells));
    cells.into_iter().map(spelled).collect()
}

/// Returns a finding for each column with numbers such as `1,234` whose comma may as well part thousands.
fn unsure_numbers(table: &Lexicon, numerals: &BTreeMap<&str, Numerals>) -> Vec<ReportFinding> {
    let mut unsure: BTreeMap<&str, (u64, &str, f64, usize)> = BTreeMap::new();
    for entry in &table.entries {
        for (name, text) in &entry.attributes {
            let column = numerals
                .get(name.as_str())
                .filter(|it| it.is_ambiguous(text));
            if let Some(number) = column.and_then(|column| column.number(text)) {
                let first = (entry.line, text.trim(), number, 0);
                unsure.entry(name).or_insert(first).3 += 1;
            }
        }
    }
    let finding = |(name, (line, text, number, count)): (&str, (u64, &str, f64, usize))| {
        ReportFinding::from(
            Finding::warning(
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

fn wrong(error: &TableError) -> Error {
    Error::wrong(error.to_string())
        .advise("a lexicon is a table with a header row and a column of glosses")
}

/// Records which entries of the mapping name a column of the table, and returns whether any does.
fn map_columns(job: &mut Job<'_>, table: &Lexicon) -> bool {
    let mut any = false;
    for column in &table.columns {
        if let Some((entry, _)) = job.options.mapping.column(&column.title) {
            job.used.insert(entry.to_owned());
            any = true;
        }
    }
    any
}

type InventoryKey = (Component, Option<String>);

/// The row of a part's inventory, and the value for each spelling in the table.
struct Known {
    row: i64,
    values: BTreeMap<String, String>,
}

/// The signs of the table so far, by gloss; each is looked up once, however many rows share it.
#[derive(Default)]
struct Signs(BTreeMap<String, KnownSign>);

/// A sign of the corpus to which rows of the table add entries.
struct KnownSign {
    id: i64,
    /// Whether one of its tokens is its citation form.
    has_citation: bool,
    /// Its entries from an earlier import of the file at the same path, in reverse order; each belongs to the next row
    /// with the sign's gloss.
    earlier: Vec<TokenRow>,
}

impl Signs {
    /// Returns the sign with a gloss; inserts it if it is missing.
    fn glossed(&mut self, job: &mut Job<'_>, gloss: &str) -> Result<&mut KnownSign> {
        match self.0.entry(composed(gloss).into_owned()) {
            Entry::Occupied(known) => Ok(known.into_mut()),
            Entry::Vacant(new) => Ok(new.insert(KnownSign::load(job, gloss)?)),
        }
    }
}

impl KnownSign {
    fn load(job: &mut Job<'_>, gloss: &str) -> Result<Self> {
        let is_new = signs::find_sign(job.connection, gloss)?.is_none();
        job.count("signs", usize::from(is_new));
        let id = signs::sign_glossed(job.connection, gloss)?;
        let tokens = signs::tokens_of_sign(job.connection, id)?;
        let has_citation = tokens.iter().any(|token| token.citation);
        let mut earlier = Vec::new();
        for token in tokens {
            if is_earlier(job, &token)? {
                earlier.push(token);
            }
        }
        earlier.sort_unstable_by_key(|token| Reverse(token.id));
        Ok(Self {
            id,
            has_citation,
            earlier,
        })
    }
}

/// Reports whether a token is an entry from an earlier import of the file; entries of other files are not.
fn is_earlier(job: &Job<'_>, token: &TokenRow) -> Result<bool> {
    if token.origin != Origin::Lexicon {
        return Ok(false);
    }
    let source: Value = token
        .source
        .as_deref()
        .and_then(|text| serde_json::from_str(text).ok())
        .unwrap_or_default();
    let same = match source["path"].as_str() {
        Some(path) => path == job.place,
        None => source["file"].as_str() == Some(&job.file_name),
    };
    // A sign from a SiGML file is a separate entry.
    let notation = notations::of_token(job.connection, token.id)?;
    Ok(same && notation.is_none_or(|notation| notation.system == "hamnosys"))
}

/// Stores the values that the table uses, unless an inventory of the corpus already has them all and keeps them apart.
fn store_inventories(
    job: &mut Job<'_>,
    table: &Lexicon,
    report: &mut FileReport,
) -> Result<BTreeMap<InventoryKey, Known>> {
    let mut known = BTreeMap::new();
    for used in table.inventories() {
        let part = (used.component, used.feature.clone());
        let same = |inventory: &Inventory| {
            (inventory.component, &inventory.feature) == (used.component, &used.feature)
        };
        let complete = job.inventories.iter().find(|stored| {
            let values = used.values.keys().map(String::as_str);
            same(&stored.inventory) && stored.inventory.keeps_apart(values)
        });
        let (row, inventory) = match complete {
            Some(stored) => {
                let texts = used.values.keys().map(String::as_str);
                report.findings.extend(renamed(&stored.inventory, texts));
                (stored.id, stored.inventory.clone())
            }
            None => {
                let own = own_inventory(&job.stem, &used);
                let mut stored = job.inventories.iter().map(|it| &it.inventory);
                let before = stored.find(|it| it.id == own.id);
                let is_new = before.is_none();
                let inventory = inventories::joined(before, own);
                let row = inventories::store(job.connection, &inventory)?;
                job.count("inventories", usize::from(is_new));
                (row, inventory)
            }
        };
        let meant = |value: &String| Some((value.clone(), inventory.find(value)?.id.clone()));
        let values = used.values.keys().filter_map(meant).collect();
        known.insert(part, Known { row, values });
    }
    Ok(known)
}

/// Returns a finding about the values that have different names in the table and in the inventory.
fn renamed<'t>(
    inventory: &Inventory,
    texts: impl Iterator<Item = &'t str>,
) -> Option<ReportFinding> {
    let renamed = texts.filter_map(|text| {
        let id = &inventory.find(text)?.id;
        (fold(id) != fold(text.trim())).then(|| format!("{} = {id}", text.trim()))
    });
    let renamed: Vec<String> = renamed.collect();
    let shown = renamed.iter().take(SHOWN_NAMES).map(String::as_str);
    let shown = shown.collect::<Vec<_>>().join(", ");
    let more = match renamed.len().saturating_sub(SHOWN_NAMES) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    (!renamed.is_empty()).then(|| {
        ReportFinding::note(format!(
            "the inventory {:?} has other names for values, under which they are stored: {shown}{more}",
            inventory.id
        ))
    })
}

fn own_inventory(stem: &str, used: &lexicon::Inventory) -> Inventory {
    let feature = used
        .feature
        .as_ref()
        .map_or(String::new(), |feature| format!(".{feature}"));
    Inventory {
        id: format!("{stem}/{}{feature}", used.component),
        component: used.component,
        feature: used.feature.clone(),
        version: 1,
        language: None,
        names: BTreeMap::from([(
            "en".to_owned(),
            format!("{}{feature} of {stem}", used.component),
        )]),
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
    job: &mut Job<'_>,
    table: &Lexicon,
    entry: &LexiconEntry,
    (inventories, numerals): (&BTreeMap<InventoryKey, Known>, &BTreeMap<&str, Numerals>),
    signs: &mut Signs,
) -> Result<i64> {
    let connection = job.connection;
    let sign = signs.glossed(job, &entry.gloss)?;
    for (language, text) in &entry.translations {
        signs::add_text(connection, sign.id, language, text)?;
    }
    let known = sign.earlier.pop();
    let is_known = known.is_some();
    let source = Some(cells(job, table, entry).to_string());
    let token = match known {
        Some(token) => {
            let id = token.id;
            if token.source != source {
                signs::update_token(connection, &TokenRow { source, ..token })?;
            }
            id
        }
        None => {
            let row = TokenRow {
                sign_id: sign.id,
                origin: Origin::Lexicon,
                citation: !sign.has_citation,
                source,
                ..TokenRow::default()
            };
            sign.has_citation = true;
            job.count("tokens", 1);
            signs::insert_token(connection, &row)?
        }
    };
    let own: Vec<AttributeRow> = (entry.attributes.iter())
        .map(|(name, text)| AttributeRow {
            name: name.clone(),
            text: text.clone(),
            number: (numerals.get(name.as_str())).and_then(|column| column.number(text)),
        })
        .collect();
    attributes::set(connection, token, &own)?;
    let values: Vec<TokenValueRow> = entry
        .codings
        .iter()
        .map(|coding| value_row(coding, inventories))
        .collect();
    if is_known && !signs::values(connection, token)?.starts_with(&values) {
        job.counts.changed("tokens", 1);
    }
    signs::set_values(connection, token, &values)?;
    Ok(token)
}

fn value_row(coding: &Coding, inventories: &BTreeMap<InventoryKey, Known>) -> TokenValueRow {
    let known = inventories.get(&(coding.component, coding.feature.clone()));
    let value = coding.reading.value().map(|value| {
        let same = known.and_then(|known| known.values.get(value));
        same.cloned().unwrap_or_else(|| value.to_owned())
    });
    let is_value = matches!(coding.reading, Reading::Value(_));
    TokenValueRow {
        hand: coding.hand,
        component: coding.component,
        feature: coding.feature.clone(),
        phase: coding.phase,
        state: ValueState::of(&coding.reading),
        value,
        inventory_id: known.filter(|_| is_value).map(|known| known.row),
        annotation_id: None,
    }
}

/// Returns the cells of a row as in the table, so that nothing is lost.
fn cells(job: &Job<'_>, table: &Lexicon, entry: &LexiconEntry) -> Value {
    let cells: Map<String, Value> = table
        .columns
        .iter()
        .zip(&entry.cells)
        .filter(|(column, cell)| {
            !cell.trim().is_empty() && !matches!(column.meaning, Meaning::Gloss { .. })
        })
        .map(|(column, cell)| (column.title.clone(), Value::from(cell.as_str())))
        .collect();
    json!({ "file": job.file_name, "path": job.place, "line": entry.line, "cells": cells })
}
