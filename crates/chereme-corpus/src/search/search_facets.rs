//! Facets: the number of tokens found that have each value of each field.
//!
//! The count of a value is the number of tokens that would remain under the corresponding condition. Tiers and lexicons
//! may write the hand of one component in several forms: `dominant` in a lexicon, `right` in a recording, or no hand at
//! all. A condition in one form matches the others as well, so these values are counted by evaluating the condition.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::ComponentField;
use chereme_sign::query::{TokenQuery, facet_condition};

use super::compile::{self, QueryContext, QueryResult};
use super::probe::{IndexDocument, RowField};
use super::search_plan;
use crate::db::stored_search::search_answers::{self, NamedRowKind};
use crate::error::CorpusResult;

/// The default limit for the number of counted values of a field.
pub const FACET_VALUES: usize = 20;

type FacetValueCounts = BTreeMap<String, Vec<(String, usize)>>;

/// Returns for each field the number of documents that have each value, with at most `most` values, and the number of
/// values left out.
pub(crate) fn count_document_facets(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    most: usize,
) -> QueryResult<(FacetValueCounts, BTreeMap<String, usize>)> {
    let mut left_out = BTreeMap::new();
    let mut facets = coded_facets(ask, found)?;
    count_forms_of_hands(ask, found, &mut facets)?;
    count_equal_values(ask, found, &mut facets)?;
    for (field, values) in &mut facets {
        let left = keep_most_frequent(values, most);
        left_out.insert(field.clone(), left);
    }
    for (facet, field, named) in [
        ("gloss", RowField::Sign, NamedRowKind::Sign),
        ("recording", RowField::Recording, NamedRowKind::Recording),
        ("signer", RowField::Signer, NamedRowKind::Signer),
    ] {
        let (counts, left) = row_facet(ask, found, field, named, most)?;
        if !counts.is_empty() {
            facets.insert(facet.to_owned(), counts);
            left_out.insert(facet.to_owned(), left);
        }
    }
    left_out.retain(|_, left| *left > 0);
    Ok((facets, left_out))
}

fn row_facet(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    field: RowField,
    named: NamedRowKind,
    most: usize,
) -> CorpusResult<(Vec<(String, usize)>, usize)> {
    ask.go_on()?;
    let rows = ask.now.open_row_column(field)?;
    let mut all: Vec<i64> = found.iter().filter_map(|doc| rows.document_number(*doc)).collect();
    // Sorting numbers and counting runs of them is quicker than a map with millions of entries.
    all.sort_unstable();
    let mut counts: Vec<(usize, i64)> = all
        .chunk_by(|a, b| a == b)
        .map(|equal| (equal.len(), equal[0]))
        .collect();
    let all = counts.len();
    let least = all.min(most);
    // Names are read for the most frequent rows only, as each costs a query.
    if least > 0 && counts.len() > least {
        counts.select_nth_unstable_by(least - 1, |a, b| b.0.cmp(&a.0));
        // Values with equal counts are chosen by name, so all of them are kept here.
        let bar = counts[least - 1].0;
        counts.retain(|(count, _)| *count >= bar);
    }
    let rare = all - counts.len();
    // Signs of several lexicons may have one gloss.
    let mut by_name: BTreeMap<String, usize> = BTreeMap::new();
    for (count, row) in counts {
        if let Some(name) = search_answers::find_row_name(ask.connection, named, row)? {
            *by_name.entry(name).or_default() += count;
        }
    }
    let mut named_counts: Vec<(String, usize)> = by_name.into_iter().collect();
    let left_out = rare + keep_most_frequent(&mut named_counts, most);
    Ok((named_counts, left_out))
}

/// Keeps the most frequent values, in order, and returns the number of others.
fn keep_most_frequent(counts: &mut Vec<(String, usize)>, most: usize) -> usize {
    counts.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    let left_out = counts.len().saturating_sub(most);
    counts.truncate(most);
    left_out
}

fn coded_facets(ask: &QueryContext<'_>, found: &[IndexDocument]) -> QueryResult<FacetValueCounts> {
    let counts = ask.now.count_index_facets(found, &|| ask.go_on())?;
    let of_field = |(field, values): (String, BTreeMap<String, usize>)| (field, values.into_iter().collect());
    Ok(counts.into_iter().map(of_field).collect())
}

/// Counts again the values of components whose hand is written in several forms.
fn count_forms_of_hands(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    facets: &mut FacetValueCounts,
) -> QueryResult<()> {
    let mut forms: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for field in facets.keys() {
        forms.entry(without_hand(field)).or_default().push(field.clone());
    }
    // A hand in one form only is counted by the index already.
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
                counts.extend(count.filter(|count| *count > 0).map(|count| (value.clone(), count)));
            }
            if !counts.is_empty() {
                facets.insert(field, counts);
            }
        }
    }
    Ok(())
}

/// Counts values that are one as one, under the first of their words that was found.
fn count_equal_values(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    facets: &mut FacetValueCounts,
) -> QueryResult<()> {
    for (field, counts) in facets {
        let Ok(parsed) = without_hand(field).parse::<ComponentField>() else {
            continue;
        };
        for texts in ask
            .vocabulary
            .equal_text_groups(parsed.component, parsed.feature.as_deref())
        {
            let mut held = texts
                .iter()
                .filter(|text| counts.iter().any(|(value, _)| value == *text));
            let others: Vec<&String> = match held.next() {
                Some(first) => [first].into_iter().chain(held).collect(),
                None => continue,
            };
            let [first, others @ ..] = others.as_slice() else {
                continue;
            };
            if others.is_empty() {
                continue;
            }
            if let Some(count) = count_of_condition(ask, found, field, first)? {
                counts.retain(|(value, _)| !others.contains(&value));
                let own = counts.iter_mut().find(|(value, _)| value == *first);
                own.into_iter().for_each(|own| own.1 = count);
            }
        }
    }
    Ok(())
}

/// Returns a field in the spelling of the index, without its hand.
fn without_hand(field: &str) -> String {
    // The parser knows no field of both hands, which is a form of facets alone.
    let bare = field.strip_prefix("both.").unwrap_or(field);
    match bare.parse::<ComponentField>() {
        Ok(parsed) => ComponentField { hand: None, ..parsed }.to_string(),
        Err(_) => field.to_owned(),
    }
}

fn count_of_condition(
    ask: &QueryContext<'_>,
    found: &[IndexDocument],
    field: &str,
    value: &str,
) -> QueryResult<Option<usize>> {
    let condition = facet_condition(field, value).and_then(|text| TokenQuery::parse_query(&text).ok());
    let Some(condition) = condition else {
        return Ok(None);
    };
    let (findings, notes) = (ask.findings.take(), ask.notes.take());
    let docs = compile::plan_expression(ask, &condition.root)
        .and_then(|plan| search_plan::evaluate_query_plan(ask, &plan, Some(found)));
    // The findings of the original question are restored.
    ask.findings.replace(findings);
    ask.notes.replace(notes);
    Ok(Some(docs?.len()))
}
