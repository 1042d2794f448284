//! Frequency tables: the number of tokens found that have each value of one field, or of two.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use chereme_sign::query::{TestSubject, TextField, TokenQuery, WholeTokenProperty};
use chereme_sign::{ComponentField, ComponentReading};
use serde::Serialize;

use super::compile::{QueryContext, QueryFailure, QueryResult};
use super::docs::{self, DocumentList};
use super::probe::{IndexDocument, IndexProbe, IndexTextField, RowField};
use super::search_known::KnownReading;
use super::{compile, search_attributes, search_plan, wrong_query_error};
use crate::Corpus;
use crate::db::stored_search::search_answers::{self, NamedRowKind};
use crate::db::stored_search::search_terms::{TokenProperty, hands_of, phase_counts, reading_term_text};
use crate::error::{CorpusError, CorpusResult};
use crate::progress::ProgressReceiver;

/// The largest number of cells in a cross table.
const MAX_TALLY_CELLS: usize = 1_000_000;

/// The row or column of the tokens that have no value of a field.
pub const NO_VALUE: &str = "unset";
/// The row or column of the tokens for which a field is coded as not applicable.
const NOT_APPLICABLE: &str = "n/a";
/// The row or column of the tokens for which a field is coded as unclear.
const UNCLEAR_TALLY_LABEL: &str = "unclear";

/// Number of tokens for each value of one field, or each pair of values of two fields.
///
/// A token with several values of a field is counted for each of them, as a query for each would match it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValueTally {
    /// The query in its canonical form.
    pub query: String,
    /// How many tokens it finds.
    pub total: usize,
    /// The fields, one or two, by their house names.
    pub fields: Vec<String>,
    /// The values of the second field, the most frequent first; empty if there is one field.
    pub columns: Vec<String>,
    /// A row for each value of the first field, the most frequent first; then those of `n/a` and `unclear`, and
    /// [`NO_VALUE`] last. A value that is spelled like one of these is in quotation marks, as in a query.
    pub rows: Vec<TallyRow>,
}

/// A row of a [`ValueTally`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TallyRow {
    /// The value of the first field.
    pub value: String,
    /// How many tokens have it.
    pub total: usize,
    /// How many of them have each value of the second field.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub counts: Vec<usize>,
}

impl ValueTally {
    /// Adds the counts of another corpus for the same query and fields. Ranges of numbers stay those of each corpus.
    pub fn add_tally(&mut self, other: Self) {
        self.total += other.total;
        let mut counts: BTreeMap<(String, String), usize> = BTreeMap::new();
        let mut totals: [BTreeMap<String, usize>; 2] = Default::default();
        for tally in [&*self, &other] {
            for row in &tally.rows {
                *totals[0].entry(row.value.clone()).or_default() += row.total;
                for (column, count) in tally.columns.iter().zip(&row.counts) {
                    *counts.entry((row.value.clone(), column.clone())).or_default() += count;
                    *totals[1].entry(column.clone()).or_default() += count;
                }
            }
        }
        let [rows, columns] = totals.map(|totals| {
            let mut ordered: Vec<(String, usize)> = totals.into_iter().collect();
            let last = |value: &str| {
                [NOT_APPLICABLE, UNCLEAR_TALLY_LABEL, NO_VALUE]
                    .iter()
                    .position(|word| *word == value)
            };
            // The sort is stable, so that equal counts stay in the order of their names.
            ordered.sort_by_key(|(value, total)| (last(value).map(|place| place + 1), Reverse(*total)));
            ordered
        });
        self.columns = columns.into_iter().map(|(column, _)| column).collect();
        let row = |(value, total): (String, usize)| {
            let count = |column: &String| counts.get(&(value.clone(), column.clone())).copied().unwrap_or(0);
            TallyRow {
                counts: self.columns.iter().map(count).collect(),
                total,
                value,
            }
        };
        self.rows = rows.into_iter().map(row).collect();
    }
}

impl Corpus {
    /// Counts the values of one or two fields among the tokens that a query finds.
    ///
    /// A field is a component (`placement`, `weak.configuration`), `gloss`, or a property such as
    /// `signer`, `origin` or `recording`.
    ///
    /// # Errors
    /// Those of [`search`](Self::search_tokens), [`CorpusError::Wrong`] if a field has no values to count, or the
    /// table would be too large, and [`CorpusError::Stopped`].
    pub fn tally_values(
        &mut self,
        query: &str,
        fields: &[String],
        progress: &mut ProgressReceiver<'_>,
    ) -> CorpusResult<ValueTally> {
        let subject_results = fields.iter().map(|field| parse_tally_subject(field));
        let subjects: Vec<TallySubject> = subject_results.collect::<CorpusResult<_>>()?;
        if subjects.is_empty() || subjects.len() > 2 {
            return Err(
                CorpusError::from_wrong_message("values of one field or of two are counted")
                    .with_advice("name for example placement, or placement and signer"),
            );
        }
        self.evaluate_with_context(query, progress, &mut |ask, query| {
            tally_query_subjects(ask, query, &subjects)
        })
    }
}

/// The subject of a count.
enum TallySubject {
    Component(ComponentField),
    Property(WholeTokenProperty),
    Gloss,
    Attribute(String),
}

impl TallySubject {
    fn tally_subject_name(&self) -> String {
        match self {
            Self::Attribute(name) => name.clone(),
            Self::Component(field) => field.to_string(),
            Self::Property(property) => property.property_name().to_owned(),
            Self::Gloss => TextField::Gloss.text_field_name().to_owned(),
        }
    }
}

fn parse_tally_subject(name: &str) -> CorpusResult<TallySubject> {
    // The query language decides what a field is called, so that the field is read as part of a query.
    let asked = format!("{}=*", name.trim());
    let query = TokenQuery::parse_query(&asked).map_err(|error| {
        // A time compares with times only, and has no values to count.
        match TokenQuery::parse_query(&format!("{}>0s", name.trim())) {
            Ok(_) => uncounted(name),
            Err(_) => wrong_query_error(&asked, &error),
        }
    })?;
    match query.query_tests()[..] {
        [test] => match &test.what {
            TestSubject::Component(field, _) => Ok(TallySubject::Component(field.clone())),
            TestSubject::Property(property, _) => Ok(TallySubject::Property(*property)),
            TestSubject::Whole(TextField::Gloss, _) => Ok(TallySubject::Gloss),
            TestSubject::Attribute(own, _) => Ok(TallySubject::Attribute(own.clone())),
            _ => Err(uncounted(name)),
        },
        _ => Err(uncounted(name)),
    }
}

/// The remedy for a field whose values are not counted.
const COUNTED_FIELDS_REMEDY: &str =
    "count a component such as placement, an attribute, or gloss, signer, recording, origin, hand";

fn uncounted(name: &str) -> CorpusError {
    CorpusError::from_wrong_message(format!("values of {name:?} are not counted"))
        .with_error_place(name)
        .with_advice(COUNTED_FIELDS_REMEDY)
}

fn tally_query_subjects(
    ask: &QueryContext<'_>,
    query: &TokenQuery,
    subjects: &[TallySubject],
) -> QueryResult<ValueTally> {
    let plan = compile::plan_expression(ask, &query.root)?;
    let found = search_plan::evaluate_query_plan(ask, &plan, None)?;
    let mut groups = subjects
        .iter()
        .map(|subject| group_documents_by_value(ask, &found, subject))
        .collect::<QueryResult<Vec<_>>>()?
        .into_iter();
    let rows = groups.next().unwrap_or_default();
    let columns = groups.next().unwrap_or_default();
    if rows.len().saturating_mul(columns.len()) > MAX_TALLY_CELLS {
        let message = format!("the table would have {} rows and {} columns", rows.len(), columns.len());
        let remedy = "count fields of fewer values, or one field";
        return Err(QueryFailure::Other(
            CorpusError::from_wrong_message(message).with_advice(remedy),
        ));
    }
    let mut of_doc: BTreeMap<IndexDocument, Vec<usize>> = BTreeMap::new();
    for (number, (_, docs)) in columns.iter().enumerate() {
        for doc in docs {
            of_doc.entry(*doc).or_default().push(number);
        }
    }
    let row = |(value, docs): (String, DocumentList)| {
        let mut counts = vec![0; columns.len()];
        for number in docs.iter().filter_map(|doc| of_doc.get(doc)).flatten() {
            counts[*number] += 1;
        }
        TallyRow {
            value,
            total: docs.len(),
            counts,
        }
    };
    Ok(ValueTally {
        query: query.to_string(),
        total: found.len(),
        fields: subjects.iter().map(TallySubject::tally_subject_name).collect(),
        rows: rows.into_iter().map(row).collect(),
        columns: columns.into_iter().map(|(value, _)| value).collect(),
    })
}

/// Returns the values of a field with the documents that have each, the most frequent first.
fn group_documents_by_value(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    subject: &TallySubject,
) -> QueryResult<Vec<(String, DocumentList)>> {
    let mut groups = match subject {
        TallySubject::Attribute(name) => return group_documents_by_attribute(ask, found, name),
        TallySubject::Component(field) => of_component(ask, found, field)?,
        TallySubject::Gloss => of_rows(ask, found, RowField::Sign, NamedRowKind::Sign)?,
        TallySubject::Property(property) => match property {
            WholeTokenProperty::Signer => of_rows(ask, found, RowField::Signer, NamedRowKind::Signer)?,
            WholeTokenProperty::Recording => of_rows(ask, found, RowField::Recording, NamedRowKind::Recording)?,
            WholeTokenProperty::Sign => of_rows(ask, found, RowField::Sign, NamedRowKind::Sign)?,
            WholeTokenProperty::Origin => of_mark(ask, found, TokenProperty::Origin)?,
            WholeTokenProperty::Hand => of_mark(ask, found, TokenProperty::Hand)?,
            WholeTokenProperty::Tier => of_mark(ask, found, TokenProperty::Tier)?,
            WholeTokenProperty::Inventory => of_mark(ask, found, TokenProperty::Inventory)?,
            WholeTokenProperty::Lexicon => of_mark(ask, found, TokenProperty::Lexicon)?,
            WholeTokenProperty::Language => of_mark(ask, found, TokenProperty::Language)?,
            WholeTokenProperty::File => of_mark(ask, found, TokenProperty::File)?,
            _ => return Err(QueryFailure::Other(uncounted(property.property_name()))),
        },
    };
    groups.retain(|(_, docs)| !docs.is_empty());
    groups.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then_with(|| a.0.cmp(&b.0)));
    for (value, _) in &mut groups {
        if [NOT_APPLICABLE, UNCLEAR_TALLY_LABEL, NO_VALUE].contains(&value.as_str()) {
            *value = format!("\"{value}\"");
        }
    }
    let mut unset = DocumentList::new();
    if let TallySubject::Component(field) = subject {
        for (name, reading) in [
            (NOT_APPLICABLE, ComponentReading::NotApplicable),
            (UNCLEAR_TALLY_LABEL, ComponentReading::Unclear),
        ] {
            groups.push((name.to_owned(), documents_without_value(ask, found, field, &reading)?));
        }
        unset = documents_without_value(ask, found, field, &ComponentReading::Unset)?;
    }
    let mut all: DocumentList = groups.iter().flat_map(|(_, docs)| docs).copied().collect();
    all.sort_unstable();
    all.dedup();
    // A token may be coded as unset or not be coded at all, which a table does not distinguish.
    unset.extend(docs::subtract_documents(found, &all));
    unset.sort_unstable();
    unset.dedup();
    groups.push((NO_VALUE.to_owned(), unset));
    groups.retain(|(_, docs)| !docs.is_empty());
    Ok(groups)
}

/// The most different numbers that are counted one by one.
const MAX_COUNTED_NUMBERS: usize = 20;

/// Returns the values of an attribute with the documents that have each: texts the most frequent first; numbers in order,
/// in about ten equal ranges if there are more than [`MAX_COUNTED_NUMBERS`].
fn group_documents_by_attribute(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    name: &str,
) -> QueryResult<Vec<(String, DocumentList)>> {
    let attributes = search_attributes::load_token_attributes(ask, name, &[])?;
    let ids = ask.now.open_row_column(RowField::Token)?;
    let mut by_text: BTreeMap<&str, DocumentList> = BTreeMap::new();
    let mut numbered: Vec<(f64, IndexDocument)> = Vec::new();
    let mut unset = DocumentList::new();
    let mut only_numbers = true;
    for doc in found {
        ask.count_examined_row()?;
        let rows = ids.document_number(*doc).and_then(|id| attributes.get(&id));
        let filled = rows.into_iter().flatten().filter(|row| !row.text.trim().is_empty());
        let mut values: Vec<_> = filled.map(|row| (row.text.trim(), row.number)).collect();
        values.sort_by_key(|(text, _)| *text);
        values.dedup_by_key(|(text, _)| *text);
        if values.is_empty() {
            unset.push(*doc);
        }
        for (text, number) in values {
            match number {
                Some(number) => numbered.push((number, *doc)),
                None => only_numbers = false,
            }
            by_text.entry(text).or_default().push(*doc);
        }
    }
    let mut groups = match only_numbers && !numbered.is_empty() {
        true => group_documents_by_number(numbered),
        false => {
            let mut by_size: Vec<(String, DocumentList)> = by_text
                .into_iter()
                .map(|(text, docs)| (text.to_owned(), docs))
                .collect();
            by_size.sort_by(|a, b| b.1.len().cmp(&a.1.len()).then_with(|| a.0.cmp(&b.0)));
            by_size
        }
    };
    if !unset.is_empty() {
        groups.push((NO_VALUE.to_owned(), unset));
    }
    Ok(groups)
}

/// Returns documents by their numbers, in order; in ranges of a round width, each without its upper end, if there are many
/// different numbers.
fn group_documents_by_number(mut numbered: Vec<(f64, IndexDocument)>) -> Vec<(String, DocumentList)> {
    numbered.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
    let different = numbered.chunk_by(|a, b| a.0 == b.0).count();
    let (least, greatest) = (numbered[0].0, numbered[numbered.len() - 1].0);
    let width = round_range_width((greatest - least) / 10.0);
    let range_of = |number: f64| (number / width).floor();
    let same_group = |a: &(f64, IndexDocument), b: &(f64, IndexDocument)| match different > MAX_COUNTED_NUMBERS {
        true => range_of(a.0) == range_of(b.0),
        false => a.0 == b.0,
    };
    let decimals = (-width.log10()).ceil().max(0.0) as usize;
    let groups = numbered.chunk_by(same_group).map(|group| {
        let first = group[0].0;
        let label = match different > MAX_COUNTED_NUMBERS {
            true => {
                let start = range_of(first) * width;
                format!("{start:.decimals$} to {:.decimals$}", start + width)
            }
            false => first.to_string(),
        };
        let mut docs: DocumentList = group.iter().map(|(_, doc)| *doc).collect();
        // A sign with two rows of one range counts once.
        docs.sort_unstable();
        docs.dedup();
        (label, docs)
    });
    groups.collect()
}

/// Returns the least of 1, 2 and 5 times a power of ten that is not below `width`.
fn round_range_width(width: f64) -> f64 {
    let power = 10_f64.powf(width.max(f64::MIN_POSITIVE).log10().floor());
    let factors = [1.0, 2.0, 5.0, 10.0];
    let wide_enough = factors.into_iter().find(|factor| factor * power >= width);
    wide_enough.unwrap_or(10.0) * power
}

fn of_component(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    field: &ComponentField,
) -> QueryResult<Vec<(String, DocumentList)>> {
    let readings = ask.known_component_readings(field.component)?;
    let mut groups = Vec::new();
    let values = readings.parts.get(&field.feature).into_iter();
    for known in values.flat_map(|values| values.values()).flatten() {
        if let ComponentReading::Value(value) = &known.reading {
            groups.push((value.clone(), having(ask, found, field, known)?));
        }
    }
    // Values that are one count as one, under the first of their words that is in use.
    for texts in ask
        .vocabulary
        .equal_text_groups(field.component, field.feature.as_deref())
    {
        let (equal, others): (Vec<_>, Vec<_>) = groups.into_iter().partition(|(value, _)| texts.contains(value));
        groups = others;
        let rank = |value: &String| texts.iter().position(|text| text == value);
        let name = equal
            .iter()
            .filter(|(_, docs)| !docs.is_empty())
            .min_by_key(|(value, _)| rank(value));
        if let Some((name, _)) = name {
            let mut docs: DocumentList = equal.iter().flat_map(|(_, docs)| docs).copied().collect();
            docs.sort_unstable();
            docs.dedup();
            groups.push((name.clone(), docs));
        }
    }
    Ok(groups)
}

/// Returns the documents for which a field is coded as one of the readings without a value.
fn documents_without_value(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    field: &ComponentField,
    reading: &ComponentReading,
) -> QueryResult<DocumentList> {
    let readings = ask.known_component_readings(field.component)?;
    let values = readings.parts.get(&field.feature);
    let alike = values.and_then(|values| values.get(reading_term_text(reading)));
    let known_reading = alike.and_then(|alike| alike.iter().find(|candidate| candidate.reading == *reading));
    known_reading.map_or(Ok(DocumentList::new()), |known| having(ask, found, field, known))
}

/// Returns the documents that have a reading with the hand and the phase of a field.
fn having(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    field: &ComponentField,
    known: &KnownReading,
) -> QueryResult<DocumentList> {
    let hands = hands_of(field.hand);
    let terms = known.terms.iter();
    let field_terms = terms.filter(|(hand, phase, _)| hands.contains(hand) && phase_counts(field.phase, phase));
    let texts: Vec<&str> = field_terms.map(|(_, _, term)| term.as_str()).collect();
    let docs = ask.run_index_probe(&IndexProbe::from_reading_terms(texts))?;
    Ok(docs::intersect_documents(&docs, found))
}

fn of_mark(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    mark: TokenProperty,
) -> QueryResult<Vec<(String, DocumentList)>> {
    let prefix = mark.property_term_prefix();
    let mut groups = Vec::new();
    for term in ask.now.field_terms(IndexTextField::Reading, &prefix, &|_| true)? {
        let docs = ask.run_index_probe(&IndexProbe::from_reading_terms([&term]))?;
        let value = term[prefix.len()..].to_owned();
        groups.push((value, docs::intersect_documents(&docs, found)));
    }
    Ok(groups)
}

fn of_rows(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    field: RowField,
    named: NamedRowKind,
) -> QueryResult<Vec<(String, DocumentList)>> {
    let rows = ask.now.open_row_column(field)?;
    let mut by_row: BTreeMap<i64, DocumentList> = BTreeMap::new();
    for doc in found {
        if let Some(row) = rows.document_number(*doc) {
            by_row.entry(row).or_default().push(*doc);
        }
    }
    // Signs of several lexicons may have one gloss.
    let mut groups: BTreeMap<String, DocumentList> = BTreeMap::new();
    for (row, docs) in by_row {
        let name = search_answers::find_row_name(ask.connection, named, row)?;
        groups.entry(name.unwrap_or_default()).or_default().extend(docs);
    }
    groups.values_mut().for_each(|docs| docs.sort_unstable());
    Ok(groups.into_iter().collect())
}
