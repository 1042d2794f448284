//! Comparisons of components.

use std::collections::BTreeSet;

use chereme_sign::query::{Comparison, Operator, QueryError, Value, Wanted, unknown_value};
use chereme_sign::text::nearest;
use chereme_sign::{Component, Field, Reading};

use super::compile::{Ask, Asked};
use super::known::{KnownReading, KnownReadings, Values};
use super::plan::Plan;
use super::probe::Probe;
use super::vocabulary::Accepted;
use super::{findings, steps};
use crate::db::search::terms::{hands_of, phase_counts};

/// A comparison of a component, prepared for evaluation.
///
/// A field without a part means the whole component. If the whole does not know a value, the parts that do are compared
/// (`nonmanual=raised`); `*` and `unset` mean the whole, or all parts if the corpus has no value of the whole. If the field
/// names no hand or phase, every reading of the token counts.
pub(crate) struct ComponentTest {
    pub(crate) field: Field,
    subject_at: std::ops::Range<usize>,
    pub(crate) comparison: Comparison,
    /// For each part, the accepted stored values for each value of the comparison.
    pub(crate) parts: Vec<(Option<String>, Vec<Accepted>)>,
}

impl ComponentTest {
    /// Prepares a comparison.
    ///
    /// # Errors
    /// Fails if neither an inventory nor a token has a value, feature or part; the error has its place in the query.
    pub(crate) fn new(
        ask: &Ask<'_>,
        field: &Field,
        comparison: &Comparison,
        subject_at: std::ops::Range<usize>,
    ) -> Asked<Self> {
        let known = ask.readings(field.component)?;
        let all = all_parts(ask, field, &known, subject_at.clone())?;
        let mut meant: BTreeSet<&Option<String>> = BTreeSet::new();
        let own = comparison.values.iter();
        for value in own.filter(|it| !matches!(it.wanted, Wanted::Steps(_))) {
            meant.extend(parts_meant(ask, field, value, &known, &all)?);
        }
        let accepted = |part: &Option<String>| {
            let values = comparison.values.iter().map(|value| {
                let operator = match comparison.operator {
                    Operator::IsNot => Operator::Is,
                    operator => operator,
                };
                let (of, stored) = ((field.component, part.as_deref()), known.parts.get(part));
                ask.vocabulary.accepted(of, operator, &value.wanted, stored)
            });
            values.collect()
        };
        Ok(Self {
            subject_at: subject_at.clone(),
            field: field.clone(),
            comparison: comparison.clone(),
            parts: meant
                .into_iter()
                .map(|part| (part.clone(), accepted(part)))
                .collect(),
        })
    }

    /// Returns whether a reading of a part passes; `folded` is its value, folded.
    pub(crate) fn accepts(&self, part: Option<&str>, reading: &Reading, folded: &str) -> bool {
        let of_part = self.parts.iter().find(|(own, _)| own.as_deref() == part);
        of_part.is_some_and(|(_, accepted)| self.accepts_by(accepted, reading, folded))
    }

    fn accepts_by(&self, accepted: &[Accepted], reading: &Reading, folded: &str) -> bool {
        self.comparison.accepts(reading, |text, wanted| {
            let values = self.comparison.values.iter().zip(accepted);
            let mut asked =
                values.filter(|(value, _)| std::ptr::eq(&raw const value.wanted, wanted));
            asked.any(|(_, accepted)| accepted.fits(text, folded))
        })
    }

    /// Returns the plan for the tokens that pass, and reports which values of the corpus matched.
    pub(crate) fn plan(&self, ask: &Ask<'_>) -> Asked<Plan> {
        self.report(ask)?;
        let mut plans = vec![self.own_plan(ask)?];
        for value in &self.comparison.values {
            if let Wanted::Steps(steps) = &value.wanted {
                let (operator, at) = (self.comparison.operator, self.subject_at.clone());
                plans.push(steps::plan(ask, &self.field, operator, steps, at)?);
            }
        }
        Ok(Plan::any(plans))
    }

    /// Reports which values of the corpus each value matched.
    pub(crate) fn report(&self, ask: &Ask<'_>) -> Asked<()> {
        findings::report(ask, self)
    }

    /// Returns the terms of a part's passing values on one hand, each with its phase.
    pub(crate) fn passing_terms(
        &self,
        ask: &Ask<'_>,
        part: &Option<String>,
        hand: char,
    ) -> Asked<steps::Phased> {
        let known = ask.readings(self.field.component)?;
        let accepted = self.parts.iter().find(|(own, _)| own == part);
        let (Some(values), Some((_, accepted))) = (known.parts.get(part), accepted) else {
            return Ok(Vec::new());
        };
        let passing = values.iter().flat_map(|(folded, alike)| {
            let passes =
                move |known: &&KnownReading| self.accepts_by(accepted, &known.reading, folded);
            alike.iter().filter(passes)
        });
        let terms = passing.flat_map(|known| &known.terms);
        let own = terms.filter(|(own, ..)| *own == hand);
        Ok(own
            .map(|(_, phase, term)| (phase.clone(), term.clone()))
            .collect())
    }

    fn own_plan(&self, ask: &Ask<'_>) -> Asked<Plan> {
        let known = ask.readings(self.field.component)?;
        let mut passing = Vec::new();
        for (part, accepted) in &self.parts {
            let Some(values) = known.parts.get(part) else {
                continue;
            };
            match self.listed(accepted) {
                Some(listed) => {
                    let found = listed.filter_map(|text| values.get(text));
                    found.flatten().for_each(|known| passing.push(known));
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
        let found = Plan::Index(self.probe(passing));
        if !self.comparison.accepts(&Reading::Unset, |_, _| false) {
            return Ok(found);
        }
        let own = self.parts.iter();
        let coded = own.filter_map(|(part, _)| known.parts.get(part));
        let coded = coded.flat_map(|values| values.values().flatten());
        let absent = Plan::Index(self.probe(coded)).not();
        Ok(Plan::any(vec![found, absent]))
    }

    /// Returns the passing values, folded, if they can be listed without examining each stored value.
    fn listed<'a>(
        &self,
        accepted: &'a [Accepted],
    ) -> Option<impl Iterator<Item = &'a String> + use<'a>> {
        let named = |value: &Value| matches!(value.wanted, Wanted::Named(_) | Wanted::Features(_));
        let plain =
            self.comparison.operator == Operator::Is && self.comparison.values.iter().all(named);
        let lists: Option<Vec<_>> = accepted.iter().map(Accepted::listed).collect();
        let all: BTreeSet<&String> = lists.filter(|_| plain)?.into_iter().flatten().collect();
        Some(all.into_iter())
    }

    fn probe<'a>(&self, readings: impl IntoIterator<Item = &'a KnownReading>) -> Probe {
        let hands = hands_of(self.field.hand);
        let terms = readings.into_iter().flat_map(|known| &known.terms);
        let own = terms.filter(|(hand, phase, _)| {
            hands.contains(hand) && phase_counts(self.field.phase, phase)
        });
        let own: BTreeSet<&str> = own.map(|(_, _, term)| term.as_str()).collect();
        Probe::readings(own)
    }
}

/// Returns the parts of a component that a field may stand for.
fn all_parts(
    ask: &Ask<'_>,
    field: &Field,
    known: &KnownReadings,
    subject_at: std::ops::Range<usize>,
) -> Asked<BTreeSet<Option<String>>> {
    let mut parts = ask.vocabulary.parts(field.component);
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
    Err(QueryError {
        at: subject_at.end.saturating_sub(part.chars().count())..subject_at.end,
        message: format!("{component} has no part {part:?}"),
        remedy: remedy.into(),
        suggestion: nearest(part, names).map(str::to_owned),
    }
    .into())
}

/// Returns the parts that a value belongs to, among all possible ones.
fn parts_meant<'a>(
    ask: &Ask<'_>,
    field: &Field,
    value: &Value,
    known: &KnownReadings,
    all: &'a BTreeSet<Option<String>>,
) -> Asked<Vec<&'a Option<String>>> {
    if let Wanted::Features(features) = &value.wanted {
        for feature in features {
            check_feature(ask, field, feature)?;
        }
    }
    if matches!(value.wanted, Wanted::Present | Wanted::Missing(_)) {
        // Where components have main values, one speaks of these.
        let has_main = known.parts.contains_key(&None);
        let meant = all.iter().filter(|part| part.is_none() || !has_main);
        return Ok(match field.feature {
            Some(_) => all.iter().collect(),
            None => meant.collect(),
        });
    }
    let knows = |part: &&Option<String>| {
        let (of, stored) = ((field.component, part.as_deref()), known.parts.get(*part));
        let accepted = ask
            .vocabulary
            .accepted(of, Operator::Is, &value.wanted, stored);
        accepted.known
            || known
                .parts
                .get(*part)
                .is_some_and(|values| has_value(values, &accepted))
    };
    let found: Vec<&Option<String>> = match all.first() {
        Some(whole @ None) if knows(&whole) => vec![whole],
        _ => all.iter().filter(knows).collect(),
    };
    match &value.wanted {
        _ if !found.is_empty() => Ok(found),
        Wanted::Named(pattern) => match pattern.as_literal() {
            Some(text) => {
                let names = names(ask, field.component, known, all);
                let names = names.iter().map(String::as_str);
                Err(unknown_value(value.at, text, names).into())
            }
            None => Ok(all.iter().collect()),
        },
        _ => Ok(all.iter().collect()),
    }
}

fn has_value(values: &Values, accepted: &Accepted) -> bool {
    match accepted.listed() {
        Some(mut listed) => listed.any(|text| values.contains_key(text)),
        None => values.iter().any(|(folded, alike)| {
            let mut values = alike.iter().filter_map(|known| known.reading.value());
            values.any(|value| accepted.fits(value, folded))
        }),
    }
}

/// Returns the names that would have been accepted, those in use first.
fn names(
    ask: &Ask<'_>,
    component: Component,
    known: &KnownReadings,
    parts: &BTreeSet<Option<String>>,
) -> Vec<String> {
    // The values in use come first, because only these can be found.
    let mut names: Vec<String> = Vec::new();
    for part in parts {
        let values = known.parts.get(part).into_iter();
        let stored = values.flat_map(|values| values.values()).flatten();
        let stored = stored.filter_map(|known| known.reading.value());
        names.extend(stored.map(str::to_owned));
    }
    for part in parts {
        let inventories = ask.vocabulary.of(component, part.as_deref());
        let ids = inventories.flat_map(|inventory| &inventory.values);
        names.extend(ids.map(|value| value.id.clone()));
    }
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    names
}

fn check_feature(
    ask: &Ask<'_>,
    field: &Field,
    feature: &chereme_sign::query::Feature,
) -> Asked<()> {
    let features = ask
        .vocabulary
        .features(field.component, field.feature.as_deref());
    let folded = chereme_sign::text::fold(&feature.name);
    if features
        .iter()
        .any(|name| chereme_sign::text::fold(name) == folded)
    {
        return Ok(());
    }
    let at = feature.at.range();
    let minus = usize::from(at.len() > feature.name.chars().count());
    let known: Vec<&str> = features.iter().copied().collect();
    Err(QueryError {
        at: at.start + minus..at.end,
        message: format!("no value of {field} has a feature {:?}", feature.name),
        remedy: format!("features are: {}", known.join(", ")).into(),
        suggestion: nearest(&feature.name, features.iter().copied()).map(str::to_owned),
    }
    .into())
}
