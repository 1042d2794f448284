//! Successive values within one token: `placement=head > chest`.

use std::collections::BTreeSet;

use chereme_sign::Field;
use chereme_sign::query::{Comparison, Operator, QueryError, Value};

use super::compile::{Ask, Asked};
use super::component::ComponentTest;
use super::plan::Plan;
use super::probe::Probe;
use crate::db::search::terms::hands_of;

/// The largest number of positions in time that are tried for one query.
const MOST_PLACES: usize = 24;

/// Returns the plan for the tokens that begin with the first value and then take the other ones, in this order, on one
/// hand.
pub(crate) fn plan(
    ask: &Ask<'_>,
    field: &Field,
    operator: Operator,
    steps: &[Value],
    at: std::ops::Range<usize>,
) -> Asked<Plan> {
    let refused = |message: &str| QueryError {
        at: at.clone(),
        message: message.to_owned(),
        remedy: "write for example placement=head > chest".into(),
        suggestion: None,
    };
    if field.phase.is_some() {
        return Err(refused("successive values have no phase before them").into());
    }
    let tests = steps.iter().map(|step| {
        let comparison = Comparison {
            operator,
            values: vec![step.clone()],
        };
        ComponentTest::new(ask, field, &comparison, at.clone())
    });
    let tests: Vec<ComponentTest> = tests.collect::<Asked<_>>()?;
    tests.iter().try_for_each(|test| test.report(ask))?;
    let known = ask.readings(field.component)?;
    let mut plans = Vec::new();
    for (part, values) in &known.parts {
        let all = values.values().flatten().flat_map(|known| &known.terms);
        let mut places: Vec<u32> = all.filter_map(|(_, phase, _)| place(phase)).collect();
        places.sort_unstable();
        places.dedup();
        places.retain(|place| *place > 0);
        if steps.len() > 3 && places.len() > MOST_PLACES {
            return Err(refused("this component changes too often for so many values").into());
        }
        for hand in hands_of(field.hand) {
            let terms = tests
                .iter()
                .map(|test| test.passing_terms(ask, part, *hand))
                .collect::<Asked<Vec<_>>>()?;
            let first = any(&terms[0], |place| place == 0);
            if let (Some(first), Some(rest)) = (first, chain(&terms[1..], &places)) {
                plans.push(Plan::all(vec![first, rest]));
            }
        }
    }
    Ok(Plan::any(plans))
}

/// Terms with their phases.
pub(crate) type Phased = Vec<(String, String)>;

/// Returns the plan for values at any of the places, each later than the one before it.
fn chain(terms: &[Phased], places: &[u32]) -> Option<Plan> {
    let (step, later) = terms.split_first()?;
    if later.is_empty() {
        let places: BTreeSet<u32> = places.iter().copied().collect();
        return any(step, |place| places.contains(&place));
    }
    let mut plans = Vec::new();
    for (number, at) in places.iter().enumerate() {
        let here = any(step, |place| place == *at);
        let rest = here.is_some().then(|| chain(later, &places[number + 1..]));
        if let (Some(here), Some(Some(rest))) = (here, rest) {
            plans.push(Plan::all(vec![here, rest]));
        }
    }
    (!plans.is_empty()).then(|| Plan::any(plans))
}

fn any(terms: &Phased, wanted: impl Fn(u32) -> bool) -> Option<Plan> {
    let own = terms
        .iter()
        .filter(|(phase, _)| place(phase).is_some_and(&wanted));
    let terms: Vec<&String> = own.map(|(_, term)| term).collect();
    (!terms.is_empty()).then(|| Plan::Index(Probe::readings(terms)))
}

/// Returns the place of a phase among successive values; nothing for the only value of a sign.
fn place(phase: &str) -> Option<u32> {
    match phase {
        "i" => Some(0),
        "f" => Some(u32::MAX),
        _ => phase.strip_prefix('m')?.parse().ok(),
    }
}
