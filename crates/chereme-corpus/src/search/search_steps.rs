//! Successive values within one token: `placement=head > chest`.

use std::collections::BTreeSet;

use chereme_sign::ComponentField;
use chereme_sign::query::{ComparisonOperator, QueryError, QueryValue, ValueComparison};

use super::compile::{QueryContext, QueryResult};
use super::probe::IndexProbe;
use super::search_component::ComponentTest;
use super::search_plan::QueryPlan;
use crate::db::stored_search::search_terms::hands_of;

/// The largest number of positions in time that are tried for one query.
const MOST_PLACES: usize = 24;

/// Returns the plan for the tokens that begin with the first value and then take the other ones, in this order, on one
/// hand.
pub(crate) fn plan_value_steps(
    ask: &QueryContext<'_>,
    field: &ComponentField,
    operator: ComparisonOperator,
    steps: &[QueryValue],
    at: std::ops::Range<usize>,
) -> QueryResult<QueryPlan> {
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
        let comparison = ValueComparison {
            operator,
            values: vec![step.clone()],
        };
        ComponentTest::new(ask, field, &comparison, at.clone())
    });
    let tests: Vec<ComponentTest> = tests.collect::<QueryResult<_>>()?;
    tests.iter().try_for_each(|test| test.report_component_matches(ask))?;
    let readings = ask.known_component_readings(field.component)?;
    let mut plans = Vec::new();
    for (part, values) in &readings.parts {
        let all = values.values().flatten().flat_map(|known| &known.terms);
        let mut places: Vec<u32> = all.filter_map(|(_, phase, _)| step_phase_place(phase)).collect();
        places.sort_unstable();
        places.dedup();
        // Place 0 is the initial value, which only the first step may take.
        places.retain(|place| *place > 0);
        // Plans multiply with each further value between the first and the last.
        if steps.len() > 3 && places.len() > MOST_PLACES {
            return Err(refused("this component changes too often for so many values").into());
        }
        // Successive values are those of one hand; the other hand's must not fill a step.
        for hand in hands_of(field.hand) {
            let terms = tests
                .iter()
                .map(|test| test.passing_terms(ask, part, *hand))
                .collect::<QueryResult<Vec<_>>>()?;
            let first = plan_phased_terms(&terms[0], |place| place == 0);
            if let (Some(first), Some(rest)) = (first, chain_step_plans(&terms[1..], &places)) {
                plans.push(QueryPlan::conjoin_plans(vec![first, rest]));
            }
        }
    }
    Ok(QueryPlan::disjoin_plans(plans))
}

/// Terms with their phases.
pub(crate) type PhasedTerms = Vec<(String, String)>;

/// Returns the plan for values at any of the places, each later than the one before it.
fn chain_step_plans(terms: &[PhasedTerms], places: &[u32]) -> Option<QueryPlan> {
    let (step, later) = terms.split_first()?;
    if later.is_empty() {
        let places: BTreeSet<u32> = places.iter().copied().collect();
        return plan_phased_terms(step, |place| places.contains(&place));
    }
    let mut plans = Vec::new();
    for (number, at) in places.iter().enumerate() {
        let here = plan_phased_terms(step, |place| place == *at);
        let rest = here.is_some().then(|| chain_step_plans(later, &places[number + 1..]));
        if let (Some(here), Some(Some(rest))) = (here, rest) {
            plans.push(QueryPlan::conjoin_plans(vec![here, rest]));
        }
    }
    (!plans.is_empty()).then(|| QueryPlan::disjoin_plans(plans))
}

fn plan_phased_terms(terms: &PhasedTerms, wanted: impl Fn(u32) -> bool) -> Option<QueryPlan> {
    let phase_terms = terms
        .iter()
        .filter(|(phase, _)| step_phase_place(phase).is_some_and(&wanted));
    let terms: Vec<&String> = phase_terms.map(|(_, term)| term).collect();
    (!terms.is_empty()).then(|| QueryPlan::Index(IndexProbe::from_reading_terms(terms)))
}

/// Returns the place of a phase among successive values; nothing for the only value of a sign.
fn step_phase_place(phase: &str) -> Option<u32> {
    match phase {
        "i" => Some(0),
        "f" => Some(u32::MAX),
        _ => phase.strip_prefix('m')?.parse().ok(),
    }
}
