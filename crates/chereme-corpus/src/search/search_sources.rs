//! Conditions on who says a value: `configuration=U{by=anna confidence>0.8}`.

use std::collections::BTreeMap;
use std::ops::Range;

use chereme_sign::query::{AttributeTest, QueryTest, TestSubject, ValueComparison, WantedValue, WholeTokenProperty};
use chereme_sign::text::fold_text;
use chereme_sign::{ComponentField, ComponentReading};

use super::compile::{QueryContext, QueryResult, RequestedName, check_annotator};
use super::probe::{IndexProbe, RowField};
use super::search_component::ComponentTest;
use super::search_plan::QueryPlan;
use crate::db::stored_columns::OpinionStanding;
use crate::db::stored_search::search_answers::{self, SaidValue};
use crate::db::stored_search::search_terms;

/// Returns the plan for tokens with a passing value from one of the sources asked for, whether that value counts or not.
///
/// # Errors
/// Fails if the corpus has no such value or annotator.
pub(super) fn plan_said_value(
    ask: &QueryContext<'_>,
    field: &ComponentField,
    comparison: &ValueComparison,
    sources: &[QueryTest],
    subject_at: Range<usize>,
) -> QueryResult<QueryPlan> {
    // The opinions about this component are read, not those about others in the same query.
    ask.asks_sources.set(true);
    let others_read_opinions = ask.opinions.replace(true);
    let test = ComponentTest::new(ask, field, comparison, subject_at);
    ask.opinions.set(others_read_opinions);
    let test = test?;
    let mut conditions = Vec::with_capacity(sources.len());
    for source in sources {
        let names = match &source.what {
            TestSubject::Property(WholeTokenProperty::By, wanted) => RequestedName::of_comparison(wanted),
            _ => Vec::new(),
        };
        names.iter().try_for_each(|name| check_annotator(ask, name))?;
        conditions.push((source, names));
    }
    let aliases = search_answers::annotator_aliases(ask.connection)?;
    let hands = search_terms::hands_of(field.hand);
    let mut tokens = Vec::new();
    search_answers::visit_said_values(ask.connection, field.component.component_name(), |said| {
        ask.count_examined_row()?;
        let coded = &said.coded;
        let mut codes = search_terms::hand_codes(coded.hand, said.is_left_handed).iter();
        let is_meant = codes.any(|code| hands.contains(code))
            && search_terms::phase_counts(field.phase, &search_terms::phase_code(coded.phase))
            && conditions
                .iter()
                .all(|(source, names)| accepts_source(source, names, &aliases, said));
        if is_meant {
            let reading = search_terms::reading_from_state(coded.state, coded.value);
            let folded = fold_text(coded.value.unwrap_or_default());
            if test.accepts_reading(coded.part, &reading, &folded) {
                tokens.push(said.token);
            }
        }
        Ok(())
    })?;
    tokens.sort_unstable();
    tokens.dedup();
    Ok(QueryPlan::Index(IndexProbe::Rows(RowField::Token, tokens)))
}

/// Returns whether a value comes from the source that a condition, of these names, asks for.
fn accepts_source(
    source: &QueryTest,
    names: &[RequestedName<'_>],
    aliases: &BTreeMap<String, Vec<String>>,
    said: &SaidValue<'_>,
) -> bool {
    match &source.what {
        TestSubject::Attribute(_, wanted @ AttributeTest::Number(..)) => said
            .confidence
            .is_some_and(|number| wanted.accepts_attribute_number(number)),
        TestSubject::Property(WholeTokenProperty::By, wanted) => {
            let reading = said.by.map_or(ComponentReading::Unset, ComponentReading::from);
            let is_named = |name: &str| {
                let other_names = aliases.get(name).into_iter().flatten().map(String::as_str);
                let mut all = std::iter::once(name).chain(other_names);
                all.any(|name| names.iter().any(|wanted| wanted.is_requested_name(name)))
            };
            wanted.comparison_accepts_reading(&reading, |name, _| is_named(name))
        }
        TestSubject::Property(property, wanted) => {
            let asked = match property {
                WholeTokenProperty::Proposed => OpinionStanding::Proposed,
                _ => OpinionStanding::Disputed,
            };
            let word = if said.standing == Some(asked) { "yes" } else { "no" };
            wanted.comparison_accepts_reading(
                &ComponentReading::from(word),
                |word, wanted| matches!(wanted, WantedValue::Named(name) if name.as_literal() == Some(word)),
            )
        }
        _ => false,
    }
}
