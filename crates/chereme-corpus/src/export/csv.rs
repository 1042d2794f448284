//! Exports tokens and annotations as tables.
//!
//! The columns of components have the names of fields in queries. Several values of one field are written in one cell
//! as in lexicons (`chin > chest`, `S + W`), so that importing the table gives the same codings. The signer of a token of a
//! dialogue is the participant of its tier; what is said of signers stands in columns such as `signer.region`, as far as
//! the audience may know it. The columns `disputed` and `proposed` name the fields whose values do not count.

use chereme_sign::SignPhase;
use chereme_sign::tier::AnnotatedHands;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use ::csv::{Writer, WriterBuilder};
use rusqlite::Connection;

use super::ExportJob;
use crate::consent::ConsentAudience;
use crate::db::notations;
use crate::db::people::{self, SIGNER_ATTRIBUTE_PREFIX};
use crate::db::signs::{self, TokenRow, TokenValueRow};
use crate::db::stored_attributes;
use crate::db::stored_columns::ValueState;
use crate::db::stored_recordings;
use crate::db::stored_tiers;
use crate::db::token_marks;
use crate::error::{CorpusError, CorpusResult};
use crate::notation;
use crate::progress::ProgressReceiver;
use crate::tokens::join_phase_values;
use crate::words::format_noun_count;

/// A column of values: component, feature, hand, and the phase if it has a column of its own.
type TokenTableColumn = (&'static str, Option<String>, Option<&'static str>, Option<SignPhase>);

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TableForm {
    pub(super) delimiter: u8,
    /// Whether cells that a spreadsheet would take for formulas get an apostrophe before them.
    pub(super) is_spreadsheet_safe: bool,
    /// The people for whom it is, if it is for others.
    pub(super) audience: Option<ConsentAudience>,
}

impl TableForm {
    pub(super) fn new(delimiter: u8) -> Self {
        Self {
            delimiter,
            is_spreadsheet_safe: false,
            audience: None,
        }
    }
}

const FIXED_TOKEN_COLUMNS: [&str; 13] = [
    "token",
    "gloss",
    "lexicon",
    "recording",
    "start_s",
    "end_s",
    "origin",
    "signer",
    "hand",
    "citation",
    "homonym",
    "disputed",
    "proposed",
];

/// Writes one row for each token, with all its components and its own attributes.
pub(super) fn write_token_csv(job: &mut ExportJob<'_, '_>, tokens: &[i64], form: TableForm) -> CorpusResult<()> {
    let connection = job.connection;
    let mut columns: BTreeSet<TokenTableColumn> = BTreeSet::new();
    let mut languages: BTreeMap<String, usize> = BTreeMap::new();
    let mut unclear = 0;
    let mut signs: BTreeSet<i64> = BTreeSet::new();
    let mut notated = false;
    let mut named: Vec<String> = Vec::new();
    let mut said_of_signers: BTreeMap<i64, BTreeMap<String, String>> = BTreeMap::new();
    // A first pass finds the columns that any token needs, since the titles come before all rows.
    for (part, ids) in tokens.chunks(signs::MAX_ROWS_PER_QUERY).enumerate() {
        for values in signs::values_of(connection, ids)?.values() {
            columns.extend(token_cells_by_column(values, &mut unclear).into_keys());
        }
        notated |= notations::has_any_notation(connection, ids)?;
        for row in stored_attributes::of_tokens(connection, ids)?.into_values().flatten() {
            if !named.contains(&row.name) {
                named.push(row.name);
            }
        }
        for (signer, _) in people::signers_of_tokens(connection, ids)?.into_values() {
            if let Entry::Vacant(unknown) = said_of_signers.entry(signer) {
                unknown.insert(signer_attributes(connection, signer, form.audience)?);
            }
        }
        signs.extend(
            signs::load_token_rows(connection, ids)?
                .values()
                .map(|token| token.sign_id),
        );
        report_csv_progress(job.progress, part * signs::MAX_ROWS_PER_QUERY, tokens.len() * 2)?;
    }
    for sign in &signs {
        for (language, texts) in sign_translations_by_language(connection, *sign)? {
            let most = languages.entry(language).or_default();
            *most = texts.len().max(*most);
        }
    }
    if unclear > 0 {
        job.notes.push(format!(
            "{} with \">\" or \"+\" in it would be read back as several",
            format_noun_count(unclear as u64, "values")
        ));
    }
    let mut table = CsvTableWriter::new(form, job.out);
    let titles = FIXED_TOKEN_COLUMNS.iter().map(|title| (*title).to_owned());
    let translations = languages
        .iter()
        .flat_map(|(language, most)| std::iter::repeat_n(translation_column_title(language), *most));
    let notation = notated.then(|| "hamnosys".to_owned());
    let sign_titles = titles.chain(translations).chain(notation);
    let titles = sign_titles.chain(columns.iter().map(token_column_title));
    let titles: Vec<String> = titles.collect();
    let signer_titles: BTreeSet<&String> = said_of_signers.values().flat_map(BTreeMap::keys).collect();
    named.extend(signer_titles.into_iter().cloned());
    // An attribute of the same title as a column could not be distinguished from it when the table is read back.
    named.retain(|name| !titles.contains(name));
    let titles = titles.into_iter().chain(named.iter().cloned());
    table.write_record(titles)?;
    for (part, ids) in tokens.chunks(signs::MAX_ROWS_PER_QUERY).enumerate() {
        let rows = signs::load_token_rows(connection, ids)?;
        let values = signs::values_of(connection, ids)?;
        let notations = notation::of_tokens(connection, ids)?;
        let own_attributes = stored_attributes::of_tokens(connection, ids)?;
        let signers = people::signers_of_tokens(connection, ids)?;
        let mut marks = token_marks::load_token_marks(connection, ids)?;
        for id in ids {
            let token = rows
                .get(id)
                .map_or_else(|| signs::load_token_row(connection, *id), |row| Ok(row.clone()))?;
            let signer = signers.get(id);
            let said_of_signer = signer.and_then(|(signer, _)| said_of_signers.get(signer));
            let mut row = fixed(&token, signer.map(|(_, name)| name.as_str()));
            row.extend(marks.remove(id).unwrap_or_default());
            let mut texts = sign_translations_by_language(connection, token.sign_id)?;
            for (language, most) in &languages {
                let mut language_texts = texts.remove(language).unwrap_or_default();
                language_texts.resize(*most, String::new());
                row.append(&mut language_texts);
            }
            if notated {
                let sign_notation = notations.get(id);
                row.push(sign_notation.map_or_else(String::new, |own| own.document.hamnosys_text().text));
            }
            let mut cells = values
                .get(id)
                .map(|values| token_cells_by_column(values, &mut 0))
                .unwrap_or_default();
            row.extend(columns.iter().map(|column| cells.remove(column).unwrap_or_default()));
            let token_attributes = own_attributes.get(id).map_or(&[][..], Vec::as_slice);
            row.extend(named.iter().map(|name| {
                let named_attribute = token_attributes.iter().find(|attribute| attribute.name == *name);
                let own_text = named_attribute.map(|attribute| &attribute.text);
                own_text
                    .or(said_of_signer.and_then(|said| said.get(name)))
                    .cloned()
                    .unwrap_or_default()
            }));
            table.write_record(row)?;
        }
        report_csv_progress(
            job.progress,
            tokens.len() + part * signs::MAX_ROWS_PER_QUERY,
            tokens.len() * 2,
        )?;
    }
    table.finish_csv_table()
}

/// Writes the annotations of a tier as a table of changes; applied unchanged, it leaves the tier as it is.
pub(super) fn write_annotation_csv(job: &mut ExportJob<'_, '_>, tier: i64, form: TableForm) -> CorpusResult<()> {
    let connection = job.connection;
    let tier = stored_tiers::load_tier_row(connection, tier)?;
    let recording = stored_recordings::load_recording_row(connection, tier.recording_id)?;
    let mut table = CsvTableWriter::new(form, job.out);
    let titles = ["recording", "tier", "start", "end", "value", "action", "id", "parent"];
    table.write_record(titles)?;
    let symbolic = tier.stereotype.is_some_and(|stereotype| !stereotype.is_alignable());
    for row in stored_tiers::load_tier_annotation_rows(connection, tier.id)? {
        // A symbolic annotation has no time of its own that a table could change.
        let time = |micros| {
            if symbolic {
                String::new()
            } else {
                micros_as_seconds_text(Some(micros))
            }
        };
        let value = row.state.missing_text().unwrap_or(&row.value);
        let parent = row.parent_id.map(|id| format!("annotation:{id}")).unwrap_or_default();
        let id = format!("annotation:{}", row.id);
        let (start, end) = (time(row.start_us), time(row.end_us));
        table.write_record([&recording.name, &tier.name, &start, &end, value, "set", &id, &parent])?;
    }
    table.finish_csv_table()
}

struct CsvTableWriter<'o> {
    writer: Writer<&'o mut dyn Write>,
    is_spreadsheet_safe: bool,
}

impl<'o> CsvTableWriter<'o> {
    fn new(form: TableForm, out: &'o mut dyn Write) -> Self {
        Self {
            writer: WriterBuilder::new().delimiter(form.delimiter).from_writer(out),
            is_spreadsheet_safe: form.is_spreadsheet_safe,
        }
    }

    fn write_record<T: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = T>) -> CorpusResult<()> {
        for cell in cells {
            let cell = cell.as_ref();
            let written = match self.is_spreadsheet_safe && is_formula(cell) {
                true => self.writer.write_field(format!("'{cell}")),
                false => self.writer.write_field(cell),
            };
            written.map_err(csv_write_error)?;
        }
        // An empty record ends the line that the fields were written to.
        self.writer.write_record(None::<&[u8]>).map_err(csv_write_error)
    }

    fn finish_csv_table(mut self) -> CorpusResult<()> {
        self.writer.flush().map_err(|error| csv_write_error(error.into()))
    }
}

/// Returns whether a spreadsheet may take a cell for a formula; numbers are none.
fn is_formula(cell: &str) -> bool {
    cell.starts_with(['=', '+', '-', '@', '\t', '\r']) && cell.parse::<f64>().is_err()
}

fn csv_write_error(error: ::csv::Error) -> CorpusError {
    CorpusError::from_wrong_message(format!("the table cannot be written: {error}"))
}

fn report_csv_progress(progress: &mut ProgressReceiver<'_>, done: usize, total: usize) -> CorpusResult<()> {
    progress.report_items("tokens", done, total)
}

/// Returns what is said of a signer to an audience, by the title of its column.
fn signer_attributes(
    connection: &Connection,
    signer: i64,
    audience: Option<ConsentAudience>,
) -> CorpusResult<BTreeMap<String, String>> {
    let all = people::load_person_attributes(connection, signer)?.into_iter();
    let shown = all.filter(|attribute| audience.is_none_or(|audience| attribute.audience >= audience));
    Ok(shown
        .map(|attribute| (format!("{SIGNER_ATTRIBUTE_PREFIX}{}", attribute.name), attribute.text))
        .collect())
}

fn sign_translations_by_language(connection: &Connection, sign: i64) -> CorpusResult<BTreeMap<String, Vec<String>>> {
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (language, text) in signs::list_sign_translations(connection, sign)? {
        texts.entry(language).or_default().push(text);
    }
    Ok(texts)
}

fn translation_column_title(language: &str) -> String {
    match language {
        "" => "translation".to_owned(),
        language => format!("translation.{language}"),
    }
}

fn fixed(token: &TokenRow, signer: Option<&str>) -> Vec<String> {
    vec![
        token.id.to_string(),
        token.plain_gloss().to_owned(),
        token.lexicon.clone().unwrap_or_default(),
        token.recording.clone().unwrap_or_default(),
        micros_as_seconds_text(token.start_us),
        micros_as_seconds_text(token.end_us),
        token.origin.record_origin_name().to_owned(),
        signer.unwrap_or_default().to_owned(),
        token.hand.map_or("", AnnotatedHands::annotated_hands_name).to_owned(),
        if token.citation { "yes" } else { "no" }.to_owned(),
        token.homonym.map(|number| number.to_string()).unwrap_or_default(),
    ]
}

/// Returns microseconds as seconds with six decimals.
fn micros_as_seconds_text(micros: Option<i64>) -> String {
    let Some(micros) = micros else {
        return String::new();
    };
    let sign = if micros < 0 { "-" } else { "" };
    let micros = micros.unsigned_abs();
    format!("{sign}{}.{:06}", micros / 1_000_000, micros % 1_000_000)
}

fn token_column_title((component, feature, hand, phase): &TokenTableColumn) -> String {
    let phase = phase.map_or_else(String::new, |phase| format!("{phase}."));
    let hand = hand.as_ref().map(|hand| format!("{hand}.")).unwrap_or_default();
    let feature = feature
        .as_ref()
        .map(|feature| format!(".{feature}"))
        .unwrap_or_default();
    // `both` is not a hand in fields and comes first; `right.final` can be read back too.
    format!("{hand}{phase}{component}{feature}")
}

/// Returns the cells of a token; counts values in `unclear` that could not be read back as a single value.
fn token_cells_by_column(values: &[TokenValueRow], unclear: &mut usize) -> BTreeMap<TokenTableColumn, String> {
    let mut fields: BTreeMap<TokenTableColumn, BTreeMap<Option<SignPhase>, Vec<&str>>> = BTreeMap::new();
    for row in values {
        let field = (
            row.component.component_name(),
            row.feature.clone(),
            row.hand.map(AnnotatedHands::annotated_hands_name),
            None,
        );
        let text = token_value_text(row);
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
            // One cell with `>` would lose which of these values has a phase.
            for (phase, texts) in phases {
                let (component, feature, hand, _) = field.clone();
                cells.insert((component, feature, hand, phase), texts.join(" + "));
            }
        } else {
            cells.insert(field, join_phase_values(&phases));
        }
    }
    cells
}

fn token_value_text(row: &TokenValueRow) -> &str {
    match row.state {
        ValueState::Value => row.value.as_deref().unwrap_or_default(),
        ValueState::NotApplicable => "n/a",
        ValueState::Unclear => "?",
        ValueState::Unset => "",
    }
}
