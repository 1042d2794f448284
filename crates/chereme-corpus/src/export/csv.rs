//! Exports tokens and annotations as tables.
//!
//! The columns of components have the names of fields in queries. Several values of one field are written in one cell
//! as in lexicons (`chin > chest`, `S + W`), so that importing the table gives the same codings.

use chereme_sign::Phase;
use chereme_sign::tier::Hands;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use ::csv::{Writer, WriterBuilder};
use rusqlite::Connection;

use crate::db::attributes;
use crate::db::columns::ValueState;
use crate::db::notations;
use crate::db::recordings;
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::tiers;
use crate::error::{Error, Result};
use crate::notation;
use crate::progress::{Progress, Step, Unit};
use crate::words::counted;

/// A column of values: component, feature, hand, and the phase if it has a column of its own.
type Column = (
    &'static str,
    Option<String>,
    Option<&'static str>,
    Option<Phase>,
);

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TableForm {
    pub(super) delimiter: u8,
    /// Whether cells that a spreadsheet would take for formulas get an apostrophe before them.
    pub(super) is_spreadsheet_safe: bool,
}

impl TableForm {
    pub(super) fn new(delimiter: u8) -> Self {
        Self {
            delimiter,
            is_spreadsheet_safe: false,
        }
    }
}

const FIXED: [&str; 9] = [
    "token",
    "gloss",
    "recording",
    "start_s",
    "end_s",
    "origin",
    "signer",
    "hand",
    "citation",
];

/// Writes one row for each token, with all its components and its own attributes.
pub(super) fn tokens(
    connection: &Connection,
    tokens: &[i64],
    form: TableForm,
    out: &mut dyn Write,
    notes: &mut Vec<String>,
    progress: &mut Progress<'_>,
) -> Result<()> {
    let signers = signers(connection)?;
    let mut columns: BTreeSet<Column> = BTreeSet::new();
    let mut languages: BTreeMap<String, usize> = BTreeMap::new();
    let mut unclear = 0;
    let mut signs: BTreeSet<i64> = BTreeSet::new();
    let mut notated = false;
    let mut named: Vec<String> = Vec::new();
    for (part, ids) in tokens.chunks(signs::AT_ONCE).enumerate() {
        for values in signs::values_of(connection, ids)?.values() {
            columns.extend(cells(values, &mut unclear).into_keys());
        }
        notated |= notations::any(connection, ids)?;
        for row in attributes::of_tokens(connection, ids)?
            .into_values()
            .flatten()
        {
            if !named.contains(&row.name) {
                named.push(row.name);
            }
        }
        signs.extend(
            signs::tokens(connection, ids)?
                .values()
                .map(|token| token.sign_id),
        );
        report(progress, part * signs::AT_ONCE, tokens.len() * 2)?;
    }
    for sign in &signs {
        for (language, texts) in texts(connection, *sign)? {
            let most = languages.entry(language).or_default();
            *most = texts.len().max(*most);
        }
    }
    if unclear > 0 {
        notes.push(format!(
            "{} with \">\" or \"+\" in it would be read back as several",
            counted(unclear as u64, "values")
        ));
    }
    let mut table = Table::new(form, out);
    let titles = FIXED.iter().map(|title| (*title).to_owned());
    let translations = languages
        .iter()
        .flat_map(|(language, most)| std::iter::repeat_n(translation(language), *most));
    let notation = notated.then(|| "hamnosys".to_owned());
    let titles = titles.chain(translations).chain(notation);
    let titles = titles.chain(columns.iter().map(title));
    let titles: Vec<String> = titles.collect();
    named.retain(|name| !titles.contains(name));
    let titles = titles.into_iter().chain(named.iter().cloned());
    table.write_record(titles)?;
    for (part, ids) in tokens.chunks(signs::AT_ONCE).enumerate() {
        let rows = signs::tokens(connection, ids)?;
        let values = signs::values_of(connection, ids)?;
        let notations = notation::of_tokens(connection, ids)?;
        let own_attributes = attributes::of_tokens(connection, ids)?;
        for id in ids {
            let token = rows
                .get(id)
                .map_or_else(|| signs::token(connection, *id), |row| Ok(row.clone()))?;
            let mut row = fixed(&token, &signers);
            let mut texts = texts(connection, token.sign_id)?;
            for (language, most) in &languages {
                let mut own = texts.remove(language).unwrap_or_default();
                own.resize(*most, String::new());
                row.append(&mut own);
            }
            if notated {
                let own = notations.get(id);
                row.push(own.map_or_else(String::new, |own| own.document.hamnosys().text));
            }
            let mut cells = values
                .get(id)
                .map(|values| cells(values, &mut 0))
                .unwrap_or_default();
            row.extend(
                columns
                    .iter()
                    .map(|column| cells.remove(column).unwrap_or_default()),
            );
            let own = own_attributes.get(id).map_or(&[][..], Vec::as_slice);
            row.extend(named.iter().map(|name| {
                let found = own.iter().find(|it| it.name == *name);
                found.map_or_else(String::new, |it| it.text.clone())
            }));
            table.write_record(row)?;
        }
        report(
            progress,
            tokens.len() + part * signs::AT_ONCE,
            tokens.len() * 2,
        )?;
    }
    table.finish()
}

/// Writes the annotations of a tier as a table of changes; applied unchanged, it leaves the tier as it is.
pub(super) fn annotations(
    connection: &Connection,
    tier: i64,
    form: TableForm,
    out: &mut dyn Write,
) -> Result<()> {
    let tier = tiers::tier(connection, tier)?;
    let recording = recordings::recording(connection, tier.recording_id)?;
    let mut table = Table::new(form, out);
    let titles = [
        "recording",
        "tier",
        "start",
        "end",
        "value",
        "action",
        "id",
        "parent",
    ];
    table.write_record(titles)?;
    let symbolic = tier.stereotype.is_some_and(|it| !it.is_alignable());
    for row in tiers::annotations(connection, tier.id)? {
        let time = |micros| {
            if symbolic {
                String::new()
            } else {
                seconds(Some(micros))
            }
        };
        let value = row.state.missing_text().unwrap_or(&row.value);
        let parent = row
            .parent_id
            .map(|id| format!("annotation:{id}"))
            .unwrap_or_default();
        let id = format!("annotation:{}", row.id);
        let (start, end) = (time(row.start_us), time(row.end_us));
        table.write_record([
            &recording.name,
            &tier.name,
            &start,
            &end,
            value,
            "set",
            &id,
            &parent,
        ])?;
    }
    table.finish()
}

struct Table<'o> {
    writer: Writer<&'o mut dyn Write>,
    is_spreadsheet_safe: bool,
}

impl<'o> Table<'o> {
    fn new(form: TableForm, out: &'o mut dyn Write) -> Self {
        Self {
            writer: WriterBuilder::new()
                .delimiter(form.delimiter)
                .from_writer(out),
            is_spreadsheet_safe: form.is_spreadsheet_safe,
        }
    }

    fn write_record<T: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = T>) -> Result<()> {
        for cell in cells {
            let cell = cell.as_ref();
            let written = match self.is_spreadsheet_safe && is_formula(cell) {
                true => self.writer.write_field(format!("'{cell}")),
                false => self.writer.write_field(cell),
            };
            written.map_err(fault)?;
        }
        self.writer.write_record(None::<&[u8]>).map_err(fault)
    }

    fn finish(mut self) -> Result<()> {
        self.writer.flush().map_err(|error| fault(error.into()))
    }
}

/// Returns whether a spreadsheet may take a cell for a formula; numbers are none.
fn is_formula(cell: &str) -> bool {
    cell.starts_with(['=', '+', '-', '@', '\t', '\r']) && cell.parse::<f64>().is_err()
}

fn fault(error: ::csv::Error) -> Error {
    Error::wrong(format!("the table cannot be written: {error}"))
}

fn report(progress: &mut Progress<'_>, done: usize, total: usize) -> Result<()> {
    progress.report(Step {
        task: "tokens",
        done: done as u64,
        total: Some(total as u64),
        unit: Unit::Items,
    })
}

fn signers(connection: &Connection) -> Result<BTreeMap<i64, String>> {
    let all = recordings::recordings(connection)?.into_iter();
    Ok(all.filter_map(|row| Some((row.id, row.signer?))).collect())
}

fn texts(connection: &Connection, sign: i64) -> Result<BTreeMap<String, Vec<String>>> {
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (language, text) in signs::texts(connection, sign)? {
        texts.entry(language).or_default().push(text);
    }
    Ok(texts)
}

fn translation(language: &str) -> String {
    match language {
        "" => "translation".to_owned(),
        language => format!("translation.{language}"),
    }
}

fn fixed(token: &TokenRow, signers: &BTreeMap<i64, String>) -> Vec<String> {
    let signer = token.recording_id.and_then(|id| signers.get(&id));
    vec![
        token.id.to_string(),
        token.gloss.clone(),
        token.recording.clone().unwrap_or_default(),
        seconds(token.start_us),
        seconds(token.end_us),
        token.origin.name().to_owned(),
        signer.cloned().unwrap_or_default(),
        token.hand.map_or("", Hands::name).to_owned(),
        if token.citation { "yes" } else { "no" }.to_owned(),
    ]
}

/// Returns microseconds as seconds with six decimals.
fn seconds(micros: Option<i64>) -> String {
    let Some(micros) = micros else {
        return String::new();
    };
    let sign = if micros < 0 { "-" } else { "" };
    let micros = micros.unsigned_abs();
    format!("{sign}{}.{:06}", micros / 1_000_000, micros % 1_000_000)
}

fn title((component, feature, hand, phase): &Column) -> String {
    let phase = phase.map_or_else(String::new, |phase| format!("{phase}."));
    let hand = hand
        .as_ref()
        .map(|hand| format!("{hand}."))
        .unwrap_or_default();
    let feature = feature
        .as_ref()
        .map(|feature| format!(".{feature}"))
        .unwrap_or_default();
    // `both` is not a hand in fields and comes first; `right.final` can be read back too.
    format!("{hand}{phase}{component}{feature}")
}

/// Returns the cells of a token; counts values in `unclear` that could not be read back as a single value.
fn cells(values: &[TokenValueRow], unclear: &mut usize) -> BTreeMap<Column, String> {
    let mut fields: BTreeMap<Column, BTreeMap<Option<Phase>, Vec<&str>>> = BTreeMap::new();
    for row in values {
        let field = (
            row.component.name(),
            row.feature.clone(),
            row.hand.map(Hands::name),
            None,
        );
        let text = text(row);
        *unclear += usize::from(text.contains(['>', '+']));
        fields
            .entry(field)
            .or_default()
            .entry(row.phase)
            .or_default()
            .push(text);
    }
    let mut cells = BTreeMap::new();
    for (field, phases) in fields {
        let mixed = phases.len() > 1 && phases.contains_key(&None);
        let change = field.0 == "configuration" && field.1.as_deref() == Some("change");
        if mixed || change {
            for (phase, texts) in phases {
                let (component, feature, hand, _) = field.clone();
                cells.insert((component, feature, hand, phase), texts.join(" + "));
            }
        } else {
            cells.insert(field, compound(&phases));
        }
    }
    cells
}

fn text(row: &TokenValueRow) -> &str {
    match row.state {
        ValueState::Value => row.value.as_deref().unwrap_or_default(),
        ValueState::NotApplicable => "n/a",
        ValueState::Unclear => "?",
        ValueState::Unset => "",
    }
}

/// Returns simultaneous values separated by `+`, or successive ones by `>`, with an empty part for each phase without a
/// value.
pub(crate) fn compound(phases: &BTreeMap<Option<Phase>, Vec<&str>>) -> String {
    if let Some(texts) = phases.get(&None) {
        return texts.join(" + ");
    }
    let middle = |phase: &Option<Phase>| match phase {
        Some(Phase::Middle(place)) => Some(*place),
        _ => None,
    };
    let last = phases.keys().filter_map(middle).max().unwrap_or(0);
    let middles = (1..=last).map(Phase::Middle);
    let order = std::iter::once(Phase::Initial)
        .chain(middles)
        .chain([Phase::Final]);
    let parts: Vec<String> = order
        .map(|place| {
            phases
                .get(&Some(place))
                .map(|texts| texts.join(" + "))
                .unwrap_or_default()
        })
        .collect();
    parts.join(" > ").trim().to_owned()
}
