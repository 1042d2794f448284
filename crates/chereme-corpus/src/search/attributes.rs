//! Comparisons of attributes, answered from their rows.

use std::collections::BTreeSet;

use chereme_sign::query::{
    AttributeTest, Comparison, Missing, Operator, QueryError, Test, Value, Wanted, number,
};
use chereme_sign::text::{fold, nearest};

use super::compile::{Ask, Asked};
use super::plan::Plan;
use super::probe::{Probe, RowField};
use super::texts::Glob;
use crate::db::attributes::{self, AttributeRow};

/// Returns the plan for the tokens whose attribute passes.
///
/// The name of an attribute is compared without regard to case, accents and characters other than letters and digits.
///
/// # Errors
/// Fails if no entry of the corpus has an attribute of this name.
pub(super) fn plan(ask: &Ask<'_>, test: &Test, name: &str, wanted: &AttributeTest) -> Asked<Plan> {
    let all = attributes::names(ask.connection)?;
    let names: Vec<String> = all
        .iter()
        .filter(|own| key(own) == key(name))
        .cloned()
        .collect();
    if names.is_empty() {
        return Err(unknown(test, name, &all).into());
    }
    let (passing, having) = attributes::tokens_that(ask.connection, &names, |row| match wanted {
        AttributeTest::Number(..) => row.number.is_some_and(|number| wanted.accepts(number)),
        AttributeTest::Value(comparison) => comparison
            .values
            .iter()
            .any(|value| is(row, value, comparison.operator)),
    })?;
    let tokens = |ids: BTreeSet<i64>| {
        let ids = ids.into_iter().collect();
        Plan::Index(Probe::Rows(RowField::Token, ids))
    };
    let comparison = match wanted {
        AttributeTest::Number(..) => return Ok(tokens(passing)),
        AttributeTest::Value(comparison) => comparison,
    };
    let unset = |value: &Value| value.wanted == Wanted::Missing(Missing::Unset);
    let found = match comparison.values.iter().any(unset) {
        true => Plan::any(vec![tokens(passing), tokens(having.clone()).not()]),
        false => tokens(passing),
    };
    Ok(match comparison.operator {
        Operator::IsNot if names_one(comparison) => Plan::all(vec![tokens(having), found.not()]),
        Operator::IsNot => found.not(),
        Operator::Is | Operator::Exactly => found,
    })
}

fn names_one(comparison: &Comparison) -> bool {
    let named = |value: &Value| matches!(value.wanted, Wanted::Named(_));
    comparison.values.iter().any(named)
}

fn is(row: &AttributeRow, value: &Value, operator: Operator) -> bool {
    match &value.wanted {
        Wanted::Present => true,
        Wanted::Missing(_) | Wanted::Features(_) | Wanted::Steps(_) => false,
        Wanted::Named(pattern) if operator == Operator::Exactly => {
            Glob::exact(pattern).matches(row.text.trim())
        }
        Wanted::Named(pattern) => {
            let wanted = pattern.as_literal().and_then(number);
            let equal = wanted
                .zip(row.number)
                .is_some_and(|(one, other)| one == other);
            equal || Glob::whole(pattern).fits(row.text.trim(), &fold(row.text.trim()))
        }
    }
}

fn key(name: &str) -> String {
    fold(name).chars().filter(|c| c.is_alphanumeric()).collect()
}

fn unknown(test: &Test, name: &str, all: &[String]) -> QueryError {
    const NAMED: usize = 12;
    let shown: Vec<&str> = all.iter().take(NAMED).map(String::as_str).collect();
    let remedy = match all.len() {
        0 => "the signs of this corpus have no attributes; columns of a lexicon table that are no components become some".to_owned(),
        count if count > NAMED => {
            format!("the attributes are: {} and {} more", shown.join(", "), count - NAMED)
        }
        _ => format!("the attributes are: {}", shown.join(", ")),
    };
    let fields = ["duration", "start", "end"];
    let known = all.iter().map(String::as_str).chain(fields);
    let meant = nearest(name, known).map(|meant| {
        let plain = meant
            .chars()
            .all(|c| c.is_alphanumeric() || "-_.".contains(c));
        match plain {
            _ if fields.contains(&meant) => meant.to_owned(),
            true => format!("attribute.{meant}"),
            false => format!("attribute({meant:?})"),
        }
    });
    QueryError {
        at: test.subject_at.range(),
        message: format!("there is no field or attribute {name:?}"),
        remedy: remedy.into(),
        suggestion: meant,
    }
}
