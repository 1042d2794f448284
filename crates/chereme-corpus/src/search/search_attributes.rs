//! Comparisons of attributes, answered from their rows.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use chereme_sign::query::{
    AttributeTest, CONFIDENCE_NAME, ComparisonOperator, MissingReason, QueryError, QueryTest, QueryValue,
    ValueComparison, WantedValue, parse_plain_number,
};
use chereme_sign::text::{did_you_mean, fold_text, nearest_candidate};

use super::compile::{QueryContext, QueryFailure, QueryResult};
use super::probe::{IndexProbe, RowField};
use super::search_plan::QueryPlan;
use super::search_texts::TextGlob;
use crate::db::stored_attributes::{self, AttributeRow, MEASURE_PREFIX};
use crate::db::stored_search::search_answers;
use crate::error::CorpusError;

/// Returns the plan for the tokens whose attribute passes.
///
/// The name of an attribute is compared without regard to case, accents and characters other than letters and digits. If no
/// sign has an attribute of that name, `confidence` is that of values and opinions.
///
/// # Errors
/// Fails if no entry of the corpus has an attribute of this name.
pub(super) fn plan_attribute_test(
    ask: &QueryContext<'_>,
    test: &QueryTest,
    name: &str,
    wanted: &AttributeTest,
) -> QueryResult<QueryPlan> {
    let all = stored_attributes::list_attribute_names(ask.connection)?;
    let names = meant_attribute_names(&all, name);
    if let (true, CONFIDENCE_NAME, AttributeTest::Number(..)) = (names.is_empty(), name, wanted) {
        let passes = |number| wanted.accepts_attribute_number(number);
        let tokens = search_answers::tokens_of_confidence(ask.connection, &passes)?;
        return Ok(QueryPlan::Index(IndexProbe::Rows(RowField::Token, tokens)));
    }
    if names.is_empty() {
        return Err(unknown_attribute_error(test, name, &all).into());
    }
    let (passing, having) = stored_attributes::tokens_that(ask.connection, &names, |row| match wanted {
        AttributeTest::Number(..) => row.number.is_some_and(|number| wanted.accepts_attribute_number(number)),
        AttributeTest::Value(comparison) => comparison
            .values
            .iter()
            .any(|value| is_attribute_match(row, value, comparison.operator)),
    })?;
    let tokens = |ids: BTreeSet<i64>| {
        let ids = ids.into_iter().collect();
        QueryPlan::Index(IndexProbe::Rows(RowField::Token, ids))
    };
    let comparison = match wanted {
        AttributeTest::Number(..) => return Ok(tokens(passing)),
        AttributeTest::Value(comparison) => comparison,
    };
    let unset = |value: &QueryValue| value.wanted == WantedValue::Missing(MissingReason::Unset);
    // A token without a row of the attribute is unset, too.
    let token_plan = match comparison.values.iter().any(unset) {
        true => QueryPlan::disjoin_plans(vec![tokens(passing), tokens(having.clone()).negate_plan()]),
        false => tokens(passing),
    };
    Ok(match comparison.operator {
        ComparisonOperator::IsNot if names_one(comparison) => {
            QueryPlan::conjoin_plans(vec![tokens(having), token_plan.negate_plan()])
        }
        ComparisonOperator::IsNot => token_plan.negate_plan(),
        ComparisonOperator::Is | ComparisonOperator::Exactly => token_plan,
    })
}

/// Returns the attributes that a name means: those of tables, otherwise the measure of that name.
pub(super) fn meant_attribute_names(all: &[String], name: &str) -> Vec<String> {
    let with_key = |key: &str| -> Vec<String> {
        let named = all.iter().filter(|own| attribute_name_key(own) == key);
        named.cloned().collect()
    };
    let named = with_key(&attribute_name_key(name));
    match named.is_empty() {
        true => with_key(&attribute_name_key(&format!("{MEASURE_PREFIX}{name}"))),
        false => named,
    }
}

/// The values of an attribute by token.
pub(super) type TokenAttributes = BTreeMap<i64, Vec<Rc<AttributeRow>>>;

/// Returns the values of the attribute of this name, by token; `other_words` could have stood there, too.
///
/// # Errors
/// [`CorpusError::Wrong`] if no entry of the corpus has an attribute of this name.
pub(super) fn load_token_attributes(
    ask: &QueryContext<'_>,
    name: &str,
    other_words: &[&str],
) -> QueryResult<TokenAttributes> {
    let all = stored_attributes::list_attribute_names(ask.connection)?;
    let names = meant_attribute_names(&all, name);
    if names.is_empty() {
        let words = all.iter().map(String::as_str).chain(other_words.iter().copied());
        let near = did_you_mean(nearest_candidate(name, words));
        let error = CorpusError::from_wrong_message(format!("there is no field or attribute {name:?}{near}"));
        let advice = match other_words {
            [] => name_attributes(&all),
            words => format!("write {}, or an attribute; {}", words.join(", "), name_attributes(&all)),
        };
        return Err(QueryFailure::Other(error.with_error_place(name).with_advice(advice)));
    }
    Ok(stored_attributes::attributes_by_token(ask.connection, &names)?)
}

pub(super) fn names_one(comparison: &ValueComparison) -> bool {
    let named = |value: &QueryValue| matches!(value.wanted, WantedValue::Named(_));
    comparison.values.iter().any(named)
}

pub(super) fn is_attribute_match(row: &AttributeRow, value: &QueryValue, operator: ComparisonOperator) -> bool {
    match &value.wanted {
        WantedValue::Present => true,
        WantedValue::Missing(_) | WantedValue::Features(_) | WantedValue::Steps(_) => false,
        WantedValue::Named(pattern) if operator == ComparisonOperator::Exactly => {
            TextGlob::from_exact_pattern(pattern).matches_whole_text(row.text.trim())
        }
        WantedValue::Named(pattern) => {
            // `7` and `7.0` are one number, whatever the text in the table.
            let wanted = pattern.as_literal().and_then(parse_plain_number);
            let equal = wanted.zip(row.number).is_some_and(|(one, other)| one == other);
            equal
                || TextGlob::from_whole_pattern(pattern).fits_either_text(row.text.trim(), &fold_text(row.text.trim()))
        }
    }
}

fn attribute_name_key(name: &str) -> String {
    fold_text(name).chars().filter(|c| c.is_alphanumeric()).collect()
}

fn unknown_attribute_error(test: &QueryTest, name: &str, all: &[String]) -> QueryError {
    let fields = ["duration", "start", "end"];
    let known_names = all.iter().map(String::as_str).chain(fields);
    let suggestion = nearest_candidate(name, known_names).map(|meant| {
        let plain = meant.chars().all(|c| c.is_alphanumeric() || "-_.".contains(c));
        match plain {
            _ if fields.contains(&meant) => meant.to_owned(),
            true => format!("attribute.{meant}"),
            false => format!("attribute({meant:?})"),
        }
    });
    QueryError {
        at: test.subject_at.char_range(),
        message: format!("there is no field or attribute {name:?}"),
        remedy: name_attributes(all).into(),
        suggestion,
    }
}

/// Returns the advice that names the attributes of the corpus.
fn name_attributes(all: &[String]) -> String {
    const MAX_NAMED_ATTRIBUTES: usize = 12;
    let shown: Vec<&str> = all.iter().take(MAX_NAMED_ATTRIBUTES).map(String::as_str).collect();
    match all.len() {
        0 => {
            "the signs of this corpus have no attributes; columns of a lexicon table that are no components become some"
                .to_owned()
        }
        count if count > MAX_NAMED_ATTRIBUTES => {
            format!(
                "the attributes are: {} and {} more",
                shown.join(", "),
                count - MAX_NAMED_ATTRIBUTES
            )
        }
        _ => format!("the attributes are: {}", shown.join(", ")),
    }
}
