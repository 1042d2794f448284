//! Findings about comparisons of components: values of the corpus that they matched, or alternatives.

use std::collections::{BTreeMap, BTreeSet};

use chereme_sign::query::{Comparison, Pattern, Test, Value, Wanted, What};
use chereme_sign::text::{fold, nearest};
use chereme_sign::{Field, Reading};

use super::compile::{Ask, Asked};
use super::component::ComponentTest;
use super::finding::FindingKind;
use super::known::{KnownReading, KnownReadings};
use super::probe::Probe;
use crate::db::search::terms::{hands_of, phase_counts};

/// The number of names offered in place of one that matches nothing.
const OFFERED: usize = 20;

/// Reports which values of the corpus each value of a comparison matched.
pub(crate) fn report(ask: &Ask<'_>, test: &ComponentTest) -> Asked<()> {
    let known = ask.readings(test.field.component)?;
    for (number, value) in test.comparison.values.iter().enumerate() {
        let kinds = match &value.wanted {
            Wanted::Steps(_) | Wanted::Missing(_) => continue,
            Wanted::Present => not_coded(test, &known).into_iter().collect(),
            Wanted::Named(_) | Wanted::Features(_) => of_value(ask, test, &known, number, value)?,
        };
        for kind in kinds {
            ask.find(written(test, value), value.at, kind);
        }
    }
    Ok(())
}

/// Returns the condition for a single value of a comparison.
fn written(test: &ComponentTest, value: &Value) -> String {
    let what = What::Component(
        test.field.clone(),
        Comparison {
            operator: test.comparison.operator,
            values: vec![value.clone()],
        },
    );
    Test {
        at: value.at,
        subject_at: value.at,
        what,
    }
    .to_string()
}

fn of_value<'k>(
    ask: &Ask<'_>,
    test: &ComponentTest,
    known: &'k KnownReadings,
    number: usize,
    value: &Value,
) -> Asked<Vec<FindingKind>> {
    let (mut meant, mut narrower) = (BTreeSet::new(), BTreeSet::new());
    let mut aliases: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for (part, accepted) in &test.parts {
        let (Some(values), Some(accepted)) = (known.parts.get(part), accepted.get(number)) else {
            continue;
        };
        let mut add = |folded: &str, alike: &'k [KnownReading]| {
            for known in alike.iter().filter(|it| is_of(&test.field, it)) {
                let Reading::Value(text) = &known.reading else {
                    continue;
                };
                if accepted.means(text, folded) {
                    meant.insert(text.clone());
                    if accepted.is_alias(folded) {
                        let terms = aliases.entry(text.clone()).or_default();
                        terms.extend(own_terms(&test.field, known));
                    }
                } else if accepted.fits(text, folded) {
                    narrower.insert(text.clone());
                }
            }
        };
        match accepted.listed() {
            Some(listed) => {
                let found = listed.filter_map(|text| Some((text, values.get(text)?)));
                found.for_each(|(folded, alike)| add(folded, alike));
            }
            None => values.iter().for_each(|(folded, alike)| add(folded, alike)),
        }
    }
    let literal = match &value.wanted {
        Wanted::Named(pattern) => pattern.as_literal(),
        _ => None,
    };
    if meant.is_empty() && narrower.is_empty() {
        let why = not_coded(test, known).unwrap_or_else(|| nothing(test, known, literal));
        return Ok(vec![why]);
    }
    let listed = |texts: BTreeSet<String>| texts.into_iter().collect();
    if literal.is_none() {
        meant.append(&mut narrower);
        return Ok(vec![FindingKind::Matched {
            values: listed(meant),
        }]);
    }
    let mut kinds = Vec::new();
    if !aliases.is_empty() {
        let count = |(text, terms): (String, Vec<&str>)| -> Asked<(String, usize)> {
            Ok((text, ask.run(&Probe::readings(terms))?.len()))
        };
        kinds.push(FindingKind::Equal {
            field: test.field.to_string(),
            values: aliases.into_iter().map(count).collect::<Asked<_>>()?,
        });
    }
    if !narrower.is_empty() {
        kinds.push(FindingKind::Widened {
            values: listed(narrower),
        });
    }
    Ok(kinds)
}

/// Returns the terms of a reading that have the hand and the phase of a field.
fn own_terms<'k>(field: &Field, known: &'k KnownReading) -> impl Iterator<Item = &'k str> {
    let hands = hands_of(field.hand);
    let terms = known.terms.iter();
    let own = terms
        .filter(move |(hand, phase, _)| hands.contains(hand) && phase_counts(field.phase, phase));
    own.map(|(_, _, term)| term.as_str())
}

/// Returns whether a reading has the hand and the phase of a field.
fn is_of(field: &Field, known: &KnownReading) -> bool {
    own_terms(field, known).next().is_some()
}

/// Returns the finding that no value of a component, or of the named part, is coded.
fn not_coded(test: &ComponentTest, known: &KnownReadings) -> Option<FindingKind> {
    let coded = |part: &Option<String>| {
        let values = known.parts.get(part).into_iter();
        let mut values = values.flat_map(|values| values.values()).flatten();
        values.any(|it| it.reading.value().is_some())
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
fn nothing(test: &ComponentTest, known: &KnownReadings, literal: Option<&str>) -> FindingKind {
    let field = &test.field;
    let of_part = |part: &Option<String>| -> Vec<String> {
        let values = known.parts.get(part).into_iter();
        let values = values.flat_map(|values| values.values()).flatten();
        let own = values.filter(|it| is_of(field, it));
        let texts = own.filter_map(|it| it.reading.value().map(str::to_owned));
        let texts: BTreeSet<String> = texts.collect();
        texts.into_iter().collect()
    };
    let own = of_part(&field.feature);
    let others = known
        .parts
        .keys()
        .filter(|part| field.feature.is_none() && **part != field.feature);
    let mut conditions = Vec::new();
    for part in others {
        let other = Field {
            feature: part.clone(),
            ..field.clone()
        };
        let values = of_part(part);
        let alike = literal.map_or(Vec::new(), |text| like(text, &values));
        conditions.extend(
            alike
                .iter()
                .map(|value| format!("{other}={}", Pattern::literal(value.as_str()))),
        );
    }
    let near = literal.map_or(Vec::new(), |text| like(text, &own));
    let mut names = match (near.is_empty(), conditions.is_empty()) {
        (false, _) => near,
        (true, false) => conditions,
        (true, true) => own.clone(),
    };
    names.truncate(OFFERED);
    let why = if own.is_empty() {
        let parts: Vec<&str> = known.parts.keys().flatten().map(String::as_str).collect();
        match field.hand.is_some() || field.phase.is_some() {
            true => format!("no value of {field} is coded in this corpus"),
            false => format!(
                "only parts of {field} are coded in this corpus: {}",
                parts.join(", ")
            ),
        }
    } else {
        format!("no token has such a value of {field}")
    };
    FindingKind::CannotMatch { why, names }
}

/// Returns the names that begin with a text, contain it or differ from it by a slip or two, most likely first.
pub(crate) fn like(text: &str, names: &[String]) -> Vec<String> {
    let wanted = fold(text);
    let mut found: Vec<String> = Vec::new();
    found.extend(nearest(text, names.iter().map(String::as_str)).map(str::to_owned));
    let words = |name: &str| {
        let folded = fold(name);
        let mut words = folded.split(|c: char| !c.is_alphanumeric());
        let letters = wanted.chars().count();
        words.any(|word| word == wanted)
            || letters > 1 && folded.starts_with(&wanted)
            || letters > 2 && folded.contains(&wanted)
    };
    let holding = names.iter().filter(|name| words(name));
    for name in holding {
        if !found.contains(name) {
            found.push(name.clone());
        }
    }
    found.truncate(OFFERED);
    found
}
