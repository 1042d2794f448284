//! Findings about comparisons of components: values of the corpus that they matched, or alternatives.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::query::{QueryTest, QueryValue, TestSubject, TextPattern, ValueComparison, WantedValue};
use chereme_sign::text::{fold_text, nearest_candidate};
use chereme_sign::{ComponentField, ComponentReading};

use super::compile::{QueryContext, QueryResult};
use super::probe::IndexProbe;
use super::search_component::ComponentTest;
use super::search_finding::FindingKind;
use super::search_known::{KnownReading, KnownReadings};
use crate::db::stored_search::search_terms::{hands_of, phase_counts};

/// The number of names offered in place of one that matches nothing.
const MAX_OFFERED_NAMES: usize = 20;

/// Reports which values of the corpus each value of a comparison matched.
pub(crate) fn report_matched_values(ask: &QueryContext<'_>, test: &ComponentTest) -> QueryResult<()> {
    let readings = ask.known_component_readings(test.field.component)?;
    for (number, value) in test.comparison.values.iter().enumerate() {
        let kinds = match &value.wanted {
            WantedValue::Steps(_) | WantedValue::Missing(_) => continue,
            WantedValue::Present => not_coded(test, &readings).into_iter().collect(),
            WantedValue::Named(_) | WantedValue::Features(_) => of_value(ask, test, &readings, number, value)?,
        };
        for kind in kinds {
            ask.add_query_finding(single_value_condition(test, value), value.at, kind);
        }
    }
    Ok(())
}

/// Returns the condition for a single value of a comparison.
fn single_value_condition(test: &ComponentTest, value: &QueryValue) -> String {
    let what = TestSubject::Component(
        test.field.clone(),
        ValueComparison {
            operator: test.comparison.operator,
            values: vec![value.clone()],
        },
    );
    QueryTest {
        at: value.at,
        subject_at: value.at,
        what,
    }
    .to_string()
}

fn of_value<'k>(
    ask: &QueryContext<'_>,
    test: &ComponentTest,
    known: &'k KnownReadings,
    number: usize,
    value: &QueryValue,
) -> QueryResult<Vec<FindingKind>> {
    let (mut meant, mut narrower) = (BTreeSet::new(), BTreeSet::new());
    let mut aliases: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (part, accepted) in &test.parts {
        let (Some(values), Some(accepted)) = (known.parts.get(part), accepted.get(number)) else {
            continue;
        };
        let mut add = |folded: &str, alike: &'k [KnownReading]| {
            for known in alike.iter().filter(|reading| is_of(&test.field, reading)) {
                let ComponentReading::Value(text) = &known.reading else {
                    continue;
                };
                if accepted.means_stored_value(text, folded) {
                    meant.insert(text.clone());
                    if accepted.is_alias(folded) {
                        let terms = aliases.entry(text.clone()).or_default();
                        terms.extend(own_terms(&test.field, known));
                    }
                } else if accepted.accepts_stored_value(text, folded) {
                    narrower.insert(text.clone());
                }
            }
        };
        match accepted.listed_accepted_values() {
            Some(listed) => {
                let matching = listed.filter_map(|text| Some((text, values.get(text)?)));
                matching.for_each(|(folded, alike)| add(folded, alike));
            }
            None => values.iter().for_each(|(folded, alike)| add(folded, alike)),
        }
    }
    let literal = match &value.wanted {
        WantedValue::Named(pattern) => pattern.as_literal(),
        _ => None,
    };
    if meant.is_empty() && narrower.is_empty() {
        let why = not_coded(test, known).unwrap_or_else(|| no_match_finding(test, known, literal));
        return Ok(vec![why]);
    }
    let listed = |texts: BTreeSet<String>| texts.into_iter().collect();
    // With a pattern the user expects several values, so that narrower ones are no surprise.
    if literal.is_none() {
        meant.append(&mut narrower);
        return Ok(vec![FindingKind::Matched { values: listed(meant) }]);
    }
    let mut kinds = Vec::new();
    if !aliases.is_empty() {
        let count = |(text, terms): (String, Vec<&str>)| -> QueryResult<(String, usize)> {
            Ok((text, ask.run_index_probe(&IndexProbe::from_reading_terms(terms))?.len()))
        };
        let is_joined = |text: &String| {
            let mut parts = test
                .parts
                .iter()
                .filter_map(|(part, accepted)| Some((part, accepted.get(number)?)));
            parts.any(|(part, accepted)| {
                let is_meant = |other: &String| other != text && accepted.means_stored_value(other, &fold_text(other));
                let mut groups = ask.vocabulary.equal_text_groups(test.field.component, part.as_deref());
                groups.any(|group| group.contains(text) && group.iter().any(is_meant))
            })
        };
        let (joined, by_alias): (BTreeMap<_, _>, BTreeMap<_, _>) =
            aliases.into_iter().partition(|(text, _)| is_joined(text));
        for (field, values) in [(None, joined), (Some(test.field.to_string()), by_alias)] {
            if !values.is_empty() {
                let values = values.into_iter().map(count).collect::<QueryResult<_>>()?;
                kinds.push(FindingKind::Equal { field, values });
            }
        }
    }
    if !narrower.is_empty() {
        kinds.push(FindingKind::Widened {
            values: listed(narrower),
        });
    }
    Ok(kinds)
}

/// Returns the terms of a reading that have the hand and the phase of a field.
fn own_terms<'k>(field: &ComponentField, known: &'k KnownReading) -> impl Iterator<Item = &'k str> {
    let hands = hands_of(field.hand);
    let terms = known.terms.iter();
    let field_terms = terms.filter(move |(hand, phase, _)| hands.contains(hand) && phase_counts(field.phase, phase));
    field_terms.map(|(_, _, term)| term.as_str())
}

/// Returns whether a reading has the hand and the phase of a field.
fn is_of(field: &ComponentField, known: &KnownReading) -> bool {
    own_terms(field, known).next().is_some()
}

/// Returns the finding that no value of a component, or of the named part, is coded.
fn not_coded(test: &ComponentTest, known: &KnownReadings) -> Option<FindingKind> {
    let coded = |part: &Option<String>| {
        let part_values = known.parts.get(part).into_iter();
        let mut values = part_values.flat_map(|values| values.values()).flatten();
        values.any(|reading| reading.reading.reading_value().is_some())
    };
    let none = match &test.field.feature {
        Some(_) => !coded(&test.field.feature),
        None => !known.parts.keys().any(coded),
    };
    none.then(|| FindingKind::NotCoded {
        component: test.field.component,
        part: test.field.feature.clone(),
    })
}

/// Returns the finding for a value that matches nothing although the component is coded, with alternatives.
fn no_match_finding(test: &ComponentTest, known: &KnownReadings, literal: Option<&str>) -> FindingKind {
    let field = &test.field;
    let of_part = |part: &Option<String>| -> Vec<String> {
        let part_values = known.parts.get(part).into_iter();
        let values = part_values.flat_map(|values| values.values()).flatten();
        let field_readings = values.filter(|reading| is_of(field, reading));
        let reading_texts = field_readings.filter_map(|reading| reading.reading.reading_value().map(str::to_owned));
        let texts: BTreeSet<String> = reading_texts.collect();
        texts.into_iter().collect()
    };
    let part_texts = of_part(&field.feature);
    let others = known
        .parts
        .keys()
        .filter(|part| field.feature.is_none() && **part != field.feature);
    let mut conditions = Vec::new();
    for part in others {
        let other = ComponentField {
            feature: part.clone(),
            ..field.clone()
        };
        let values = of_part(part);
        let alike = literal.map_or(Vec::new(), |text| similar_names(text, &values));
        conditions.extend(
            alike
                .iter()
                .map(|value| format!("{other}={}", TextPattern::literal_pattern(value.as_str()))),
        );
    }
    let near = literal.map_or(Vec::new(), |text| similar_names(text, &part_texts));
    let mut names = match (near.is_empty(), conditions.is_empty()) {
        (false, _) => near,
        (true, false) => conditions,
        (true, true) => part_texts.clone(),
    };
    names.truncate(MAX_OFFERED_NAMES);
    let why = if part_texts.is_empty() {
        let parts: Vec<&str> = known.parts.keys().flatten().map(String::as_str).collect();
        match field.hand.is_some() || field.phase.is_some() {
            true => format!("no value of {field} is coded in this corpus"),
            false => format!("only parts of {field} are coded in this corpus: {}", parts.join(", ")),
        }
    } else {
        format!("no token has such a value of {field}")
    };
    FindingKind::CannotMatch { why, names }
}

/// Returns the names that begin with a text, contain it or differ from it by a slip or two, most likely first.
pub(crate) fn similar_names(text: &str, names: &[String]) -> Vec<String> {
    let wanted = fold_text(text);
    let mut similar: Vec<String> = Vec::new();
    similar.extend(nearest_candidate(text, names.iter().map(String::as_str)).map(str::to_owned));
    let words_of = |name: &str| {
        let folded = fold_text(name);
        let mut words = folded.split(|c: char| !c.is_alphanumeric());
        // Short texts are contained in almost every name, so that they must begin it or be a word of it.
        let letters = wanted.chars().count();
        words.any(|word| word == wanted)
            || letters > 1 && folded.starts_with(&wanted)
            || letters > 2 && folded.contains(&wanted)
    };
    let holding = names.iter().filter(|name| words_of(name));
    for name in holding {
        if !similar.contains(name) {
            similar.push(name.clone());
        }
    }
    similar.truncate(MAX_OFFERED_NAMES);
    similar
}
