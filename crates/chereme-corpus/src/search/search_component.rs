//! Comparisons of components.

use std::collections::BTreeSet;

use chereme_sign::query::{ComparisonOperator, QueryError, QueryValue, ValueComparison, WantedValue, unknown_value};
use chereme_sign::text::nearest_candidate;
use chereme_sign::{ComponentField, ComponentReading, SignComponent};

use super::compile::{QueryContext, QueryResult};
use super::probe::IndexProbe;
use super::search_known::{KnownReading, KnownReadings, ReadingsByValue};
use super::search_plan::QueryPlan;
use super::search_vocabulary::AcceptedValues;
use super::{search_findings, search_steps};
use crate::db::stored_search::search_terms::{hands_of, phase_counts};

/// A comparison of a component, prepared for evaluation.
///
/// A field without a part means the whole component. If the whole does not know a value, the parts that do are compared
/// (`nonmanual=raised`); `*` and `unset` mean the whole, or all parts if the corpus has no value of the whole. If the field
/// names no hand or phase, every reading of the token counts.
pub(crate) struct ComponentTest {
    pub(crate) field: ComponentField,
    subject_at: std::ops::Range<usize>,
    pub(crate) comparison: ValueComparison,
    /// For each part, the accepted stored values for each value of the comparison.
    pub(crate) parts: Vec<(Option<String>, Vec<AcceptedValues>)>,
}

impl ComponentTest {
    /// Prepares a comparison.
    ///
    /// # Errors
    /// Fails if neither an inventory nor a token has a value, feature or part; the error has its place in the query.
    pub(crate) fn new(
        ask: &QueryContext<'_>,
        field: &ComponentField,
        comparison: &ValueComparison,
        subject_at: std::ops::Range<usize>,
    ) -> QueryResult<Self> {
        let readings = ask.known_component_readings(field.component)?;
        let all = all_parts(ask, field, &readings, subject_at.clone())?;
        let mut meant_parts: BTreeSet<&Option<String>> = BTreeSet::new();
        let own_values = comparison.values.iter();
        for value in own_values.filter(|value| !matches!(value.wanted, WantedValue::Steps(_))) {
            meant_parts.extend(parts_meant(ask, field, value, &readings, &all)?);
        }
        // `!=` turns the answer round as a whole, so that its values are looked up as those of `=`.
        let accepted = |part: &Option<String>| {
            let values = comparison.values.iter().map(|value| {
                let operator = match comparison.operator {
                    ComparisonOperator::IsNot => ComparisonOperator::Is,
                    operator => operator,
                };
                let (of, stored) = ((field.component, part.as_deref()), readings.parts.get(part));
                ask.vocabulary.find_accepted_values(of, operator, &value.wanted, stored)
            });
            values.collect()
        };
        Ok(Self {
            subject_at: subject_at.clone(),
            field: field.clone(),
            comparison: comparison.clone(),
            parts: meant_parts
                .into_iter()
                .map(|part| (part.clone(), accepted(part)))
                .collect(),
        })
    }

    /// Returns whether a reading of a part passes; `folded` is its value, folded.
    pub(crate) fn accepts_reading(&self, part: Option<&str>, reading: &ComponentReading, folded: &str) -> bool {
        let of_part = self.parts.iter().find(|(own, _)| own.as_deref() == part);
        of_part.is_some_and(|(_, accepted)| self.accepts_by(accepted, reading, folded))
    }

    fn accepts_by(&self, accepted: &[AcceptedValues], reading: &ComponentReading, folded: &str) -> bool {
        self.comparison.comparison_accepts_reading(reading, |text, wanted| {
            let values = self.comparison.values.iter().zip(accepted);
            // The comparison passes its own values on, so that the address says which one is asked.
            let mut asked = values.filter(|(value, _)| std::ptr::eq(&raw const value.wanted, wanted));
            asked.any(|(_, accepted)| accepted.accepts_stored_value(text, folded))
        })
    }

    /// Returns the plan for the tokens that pass, and reports which values of the corpus matched.
    pub(crate) fn plan_component_test(&self, ask: &QueryContext<'_>) -> QueryResult<QueryPlan> {
        self.report_component_matches(ask)?;
        let mut plans = vec![self.own_plan(ask)?];
        for value in &self.comparison.values {
            if let WantedValue::Steps(steps) = &value.wanted {
                let (operator, at) = (self.comparison.operator, self.subject_at.clone());
                plans.push(search_steps::plan_value_steps(ask, &self.field, operator, steps, at)?);
            }
        }
        Ok(QueryPlan::disjoin_plans(plans))
    }

    /// Reports which values of the corpus each value matched.
    pub(crate) fn report_component_matches(&self, ask: &QueryContext<'_>) -> QueryResult<()> {
        search_findings::report_matched_values(ask, self)
    }

    /// Returns the terms of a part's passing values on one hand, each with its phase.
    pub(crate) fn passing_terms(
        &self,
        ask: &QueryContext<'_>,
        part: &Option<String>,
        hand: char,
    ) -> QueryResult<search_steps::PhasedTerms> {
        let readings = ask.known_component_readings(self.field.component)?;
        let accepted = self.parts.iter().find(|(own, _)| own == part);
        let (Some(values), Some((_, accepted))) = (readings.parts.get(part), accepted) else {
            return Ok(Vec::new());
        };
        let passing = values.iter().flat_map(|(folded, alike)| {
            let passes = move |known: &&KnownReading| self.accepts_by(accepted, &known.reading, folded);
            alike.iter().filter(passes)
        });
        let terms = passing.flat_map(|known| &known.terms);
        let hand_terms = terms.filter(|(own, ..)| *own == hand);
        Ok(hand_terms
            .map(|(_, phase, term)| (phase.clone(), term.clone()))
            .collect())
    }

    fn own_plan(&self, ask: &QueryContext<'_>) -> QueryResult<QueryPlan> {
        let readings = ask.known_component_readings(self.field.component)?;
        let mut passing = Vec::new();
        for (part, accepted) in &self.parts {
            let Some(values) = readings.parts.get(part) else {
                continue;
            };
            // Named values are looked up one by one, which is far quicker than a test of each stored value.
            match self.listed_passing_values(accepted) {
                Some(listed) => {
                    let listed_readings = listed.filter_map(|text| values.get(text));
                    listed_readings.flatten().for_each(|known| passing.push(known));
                }
                None => {
                    let all = values.iter();
                    passing.extend(all.flat_map(|(folded, alike)| {
                        alike
                            .iter()
                            .filter(|known| self.accepts_by(accepted, &known.reading, folded))
                    }));
                }
            }
        }
        let passing_plan = QueryPlan::Index(self.probe(passing));
        if !self
            .comparison
            .comparison_accepts_reading(&ComponentReading::Unset, |_, _| false)
        {
            return Ok(passing_plan);
        }
        // A token without any reading of these parts is unset without having a term that says so.
        let own_parts = self.parts.iter();
        let coded_values = own_parts.filter_map(|(part, _)| readings.parts.get(part));
        let coded = coded_values.flat_map(|values| values.values().flatten());
        let absent = QueryPlan::Index(self.probe(coded)).negate_plan();
        Ok(QueryPlan::disjoin_plans(vec![passing_plan, absent]))
    }

    /// Returns the passing values, folded, if they can be listed without examining each stored value.
    fn listed_passing_values<'a>(
        &self,
        accepted: &'a [AcceptedValues],
    ) -> Option<impl Iterator<Item = &'a String> + use<'a>> {
        let named = |value: &QueryValue| matches!(value.wanted, WantedValue::Named(_) | WantedValue::Features(_));
        let plain = self.comparison.operator == ComparisonOperator::Is && self.comparison.values.iter().all(named);
        let lists: Option<Vec<_>> = accepted.iter().map(AcceptedValues::listed_accepted_values).collect();
        let all: BTreeSet<&String> = lists.filter(|_| plain)?.into_iter().flatten().collect();
        Some(all.into_iter())
    }

    fn probe<'a>(&self, readings: impl IntoIterator<Item = &'a KnownReading>) -> IndexProbe {
        let hands = hands_of(self.field.hand);
        let terms = readings.into_iter().flat_map(|known| &known.terms);
        let fitting_terms =
            terms.filter(|(hand, phase, _)| hands.contains(hand) && phase_counts(self.field.phase, phase));
        let term_texts: BTreeSet<&str> = fitting_terms.map(|(_, _, term)| term.as_str()).collect();
        IndexProbe::from_reading_terms(term_texts)
    }
}

/// Returns the parts of a component that a field may stand for.
fn all_parts(
    ask: &QueryContext<'_>,
    field: &ComponentField,
    known: &KnownReadings,
    subject_at: std::ops::Range<usize>,
) -> QueryResult<BTreeSet<Option<String>>> {
    let mut parts = ask.vocabulary.component_inventory_parts(field.component);
    parts.extend(known.parts.keys().cloned());
    let Some(part) = &field.feature else {
        parts.insert(None);
        return Ok(parts);
    };
    if parts.contains(&field.feature) {
        return Ok(BTreeSet::from([field.feature.clone()]));
    }
    let names: Vec<&str> = parts.iter().flatten().map(String::as_str).collect();
    let component = field.component;
    let remedy = if names.is_empty() {
        format!("nothing is known of the parts of {component}")
    } else {
        format!("its parts are: {}", names.join(", "))
    };
    // The place is that of the part alone, which ends the name of the field.
    Err(QueryError {
        at: subject_at.end.saturating_sub(part.chars().count())..subject_at.end,
        message: format!("{component} has no part {part:?}"),
        remedy: remedy.into(),
        suggestion: nearest_candidate(part, names).map(str::to_owned),
    }
    .into())
}

/// Returns the parts that a value belongs to, among all possible ones.
fn parts_meant<'a>(
    ask: &QueryContext<'_>,
    field: &ComponentField,
    value: &QueryValue,
    known: &KnownReadings,
    all: &'a BTreeSet<Option<String>>,
) -> QueryResult<Vec<&'a Option<String>>> {
    if let WantedValue::Features(features) = &value.wanted {
        for feature in features {
            check_feature(ask, field, feature)?;
        }
    }
    if matches!(value.wanted, WantedValue::Present | WantedValue::Missing(_)) {
        // Where components have main values, one speaks of these.
        let has_main = known.parts.contains_key(&None);
        let main_parts = all.iter().filter(|part| part.is_none() || !has_main);
        return Ok(match field.feature {
            Some(_) => all.iter().collect(),
            None => main_parts.collect(),
        });
    }
    let knows = |part: &&Option<String>| {
        let (of, stored) = ((field.component, part.as_deref()), known.parts.get(*part));
        let accepted = ask
            .vocabulary
            .find_accepted_values(of, ComparisonOperator::Is, &value.wanted, stored);
        accepted.known
            || known
                .parts
                .get(*part)
                .is_some_and(|values| has_value(values, &accepted))
    };
    // The component as a whole is first in order; if it knows the value, its parts are not meant.
    let known_parts: Vec<&Option<String>> = match all.first() {
        Some(whole @ None) if knows(&whole) => vec![whole],
        _ => all.iter().filter(knows).collect(),
    };
    match &value.wanted {
        _ if !known_parts.is_empty() => Ok(known_parts),
        WantedValue::Named(pattern) => match pattern.as_literal() {
            Some(text) => {
                let known_names = acceptable_value_names(ask, field.component, known, all);
                let names = known_names.iter().map(String::as_str);
                Err(unknown_value(value.at, text, names).into())
            }
            None => Ok(all.iter().collect()),
        },
        _ => Ok(all.iter().collect()),
    }
}

fn has_value(values: &ReadingsByValue, accepted: &AcceptedValues) -> bool {
    match accepted.listed_accepted_values() {
        Some(mut listed) => listed.any(|text| values.contains_key(text)),
        None => values.iter().any(|(folded, alike)| {
            let mut values = alike.iter().filter_map(|known| known.reading.reading_value());
            values.any(|value| accepted.accepts_stored_value(value, folded))
        }),
    }
}

/// Returns the names that would have been accepted, those in use first.
fn acceptable_value_names(
    ask: &QueryContext<'_>,
    component: SignComponent,
    known: &KnownReadings,
    parts: &BTreeSet<Option<String>>,
) -> Vec<String> {
    // The values in use come first, because only these can be found.
    let mut names: Vec<String> = Vec::new();
    for part in parts {
        let values = known.parts.get(part).into_iter();
        let stored_readings = values.flat_map(|values| values.values()).flatten();
        let stored = stored_readings.filter_map(|known| known.reading.reading_value());
        names.extend(stored.map(str::to_owned));
    }
    for part in parts {
        let inventories = ask.vocabulary.part_inventories(component, part.as_deref());
        let ids = inventories.flat_map(|inventory| &inventory.values);
        names.extend(ids.map(|value| value.id.clone()));
    }
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

fn check_feature(
    ask: &QueryContext<'_>,
    field: &ComponentField,
    feature: &chereme_sign::query::ValueFeature,
) -> QueryResult<()> {
    let features = ask
        .vocabulary
        .component_feature_names(field.component, field.feature.as_deref());
    let folded = chereme_sign::text::fold_text(&feature.name);
    if features
        .iter()
        .any(|name| chereme_sign::text::fold_text(name) == folded)
    {
        return Ok(());
    }
    let feature_range = feature.at.char_range();
    // The place holds the minus before a feature that is not wanted.
    let minus = usize::from(feature_range.len() > feature.name.chars().count());
    let known_features: Vec<&str> = features.iter().copied().collect();
    Err(QueryError {
        at: feature_range.start + minus..feature_range.end,
        message: format!("no value of {field} has a feature {:?}", feature.name),
        remedy: format!("features are: {}", known_features.join(", ")).into(),
        suggestion: nearest_candidate(&feature.name, features.iter().copied()).map(str::to_owned),
    }
    .into())
}
