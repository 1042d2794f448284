//! Facets: how often each value of each field occurs among the tokens found.
//!
//! The count of a value is the number of tokens that its condition would leave. Tiers and lexicons may write the
//! hand of one component in several forms: `dominant` in a lexicon, `right` in a recording, no hand at all. A
//! condition for one form finds the others as well, so these values are counted by evaluating the condition.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::Field;
use chereme_sign::query::{Query, facet_condition};
use tantivy::DocAddress;

use super::compile::{self, Ask, Asked};
use super::docs::Numbers;
use super::known::Labels;
use super::plan;
use crate::db::search::answers::{self, Named};
use crate::error::Result;

/// How many values of a field are counted at most, unless more are asked for.
pub const FACET_VALUES: usize = 20;

type Facets = BTreeMap<String, Vec<(String, usize)>>;

/// Returns how many of the documents have each value of each field, at most `most` values of each,
/// and how many values were left out of each.
pub(crate) fn facets(
    ask: &Ask<'_>,
    found: &[DocAddress],
    most: usize,
) -> Asked<(Facets, BTreeMap<String, usize>)> {
    let mut left_out = BTreeMap::new();
    let mut facets = coded_facets(ask, found)?;
    count_forms_of_hands(ask, found, &mut facets)?;
    for (field, values) in &mut facets {
        let left = keep_most_frequent(values, most);
        left_out.insert(field.clone(), left);
    }
    for (facet, field, named) in [
        ("gloss", "sign", Named::Sign),
        ("recording", "recording", Named::Recording),
        ("signer", "signer", Named::Signer),
    ] {
        let (counts, left) = row_facet(ask, found, (field, named), most)?;
        if !counts.is_empty() {
            facets.insert(facet.to_owned(), counts);
            left_out.insert(facet.to_owned(), left);
        }
    }
    left_out.retain(|_, left| *left > 0);
    Ok((facets, left_out))
}

fn row_facet(
    ask: &Ask<'_>,
    found: &[DocAddress],
    (field, named): (&str, Named),
    most: usize,
) -> Result<(Vec<(String, usize)>, usize)> {
    ask.go_on()?;
    let rows = Numbers::rows(ask.searcher, field)?;
    let mut all: Vec<i64> = found.iter().filter_map(|doc| rows.get(*doc)).collect();
    all.sort_unstable();
    let mut counts: Vec<(usize, i64)> = all
        .chunk_by(|a, b| a == b)
        .map(|equal| (equal.len(), equal[0]))
        .collect();
    let all = counts.len();
    let least = all.min(most);
    if least > 0 && counts.len() > least {
        counts.select_nth_unstable_by(least - 1, |a, b| b.0.cmp(&a.0));
        // Values with equal counts differ in name, so all of them stay.
        let bar = counts[least - 1].0;
        counts.retain(|(count, _)| *count >= bar);
    }
    let mut named_counts = Vec::with_capacity(counts.len());
    for (count, row) in counts {
        if let Some(name) = answers::name(ask.connection, named, row)? {
            named_counts.push((name, count));
        }
    }
    keep_most_frequent(&mut named_counts, most);
    let left_out = all - named_counts.len();
    Ok((named_counts, left_out))
}

/// Keeps the most frequent values, in order, and returns how many others there were.
fn keep_most_frequent(counts: &mut Vec<(String, usize)>, most: usize) -> usize {
    counts.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    let left_out = counts.len().saturating_sub(most);
    counts.truncate(most);
    left_out
}

fn coded_facets(ask: &Ask<'_>, found: &[DocAddress]) -> Asked<Facets> {
    let mut counts: BTreeMap<String, BTreeMap<String, usize>> = BTreeMap::new();
    for docs in found.chunk_by(|a, b| a.segment_ord == b.segment_ord) {
        let Some(first) = docs.first() else {
            continue;
        };
        let segment = ask.searcher.segment_reader(first.segment_ord);
        let Some(column) = segment.fast_fields().str("facet")? else {
            continue;
        };
        ask.go_on()?;
        let labels = ask.index.memory().labels(ask.searcher, segment)?;
        for (ordinal, count) in count_ordinals(&column, docs, &labels) {
            let Some((field, value)) = labels.values.get(ordinal) else {
                continue;
            };
            let field = labels.fields.get(*field as usize).cloned();
            let values = counts.entry(field.unwrap_or_default()).or_default();
            *values.entry(value.clone()).or_default() += count;
        }
    }
    let of_field =
        |(field, values): (String, BTreeMap<String, usize>)| (field, values.into_iter().collect());
    Ok(counts.into_iter().map(of_field).collect())
}

fn count_ordinals(
    column: &tantivy::columnar::StrColumn,
    docs: &[DocAddress],
    labels: &Labels,
) -> Vec<(usize, usize)> {
    if docs.len() < 1000 {
        let mut all: Vec<u64> = docs
            .iter()
            .flat_map(|doc| column.term_ords(doc.doc_id))
            .collect();
        all.sort_unstable();
        let equal = all.chunk_by(|a, b| a == b);
        return equal
            .map(|equal| (equal[0] as usize, equal.len()))
            .collect();
    }
    let mut counts = vec![0; labels.values.len()];
    for doc in docs {
        for ordinal in column.term_ords(doc.doc_id) {
            if let Some(count) = counts.get_mut(ordinal as usize) {
                *count += 1;
            }
        }
    }
    counts
        .into_iter()
        .enumerate()
        .filter(|(_, count)| *count > 0)
        .collect()
}

/// Counts again the values of components whose hand is written in several forms.
fn count_forms_of_hands(ask: &Ask<'_>, found: &[DocAddress], facets: &mut Facets) -> Asked<()> {
    let mut forms: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for field in facets.keys() {
        forms
            .entry(without_hand(field))
            .or_default()
            .push(field.clone());
    }
    for fields in forms.into_values().filter(|fields| fields.len() > 1) {
        let values: BTreeSet<String> = fields
            .iter()
            .filter_map(|field| facets.get(field))
            .flatten()
            .map(|(value, _)| value.clone())
            .collect();
        for field in fields {
            let mut counts = Vec::with_capacity(values.len());
            for value in &values {
                ask.go_on()?;
                let count = count_of_condition(ask, found, &field, value)?;
                counts.extend(
                    count
                        .filter(|count| *count > 0)
                        .map(|count| (value.clone(), count)),
                );
            }
            if !counts.is_empty() {
                facets.insert(field, counts);
            }
        }
    }
    Ok(())
}

/// Returns a field as the index spells it, without its hand.
fn without_hand(field: &str) -> String {
    let bare = field.strip_prefix("both.").unwrap_or(field);
    match bare.parse::<Field>() {
        Ok(parsed) => Field {
            hand: None,
            ..parsed
        }
        .to_string(),
        Err(_) => field.to_owned(),
    }
}

fn count_of_condition(
    ask: &Ask<'_>,
    found: &[DocAddress],
    field: &str,
    value: &str,
) -> Asked<Option<usize>> {
    let condition = facet_condition(field, value).and_then(|text| Query::parse(&text).ok());
    let Some(condition) = condition else {
        return Ok(None);
    };
    let (findings, notes) = (ask.findings.take(), ask.notes.take());
    let docs = compile::plan(ask, &condition.root)
        .and_then(|plan| plan::evaluate(ask, &plan, Some(found)));
    // Findings are about the question that was asked.
    ask.findings.replace(findings);
    ask.notes.replace(notes);
    Ok(Some(docs?.len()))
}
