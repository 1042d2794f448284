//! Queries about recordings alone, which find recordings without a token, too.

use std::collections::BTreeSet;

use chereme_sign::query::{
    AttributeTest, ComparisonOperator, MissingReason, QueryExpression, QueryTest, QueryValue, TestSubject, WantedValue,
    WholeTokenProperty,
};
use rusqlite::Connection;

use super::search_attributes::{is_attribute_match, meant_attribute_names, names_one};
use crate::db::people::SIGNER_ATTRIBUTE_PREFIX;
use crate::db::stored_attributes::{self, AttributeRow};
use crate::db::stored_recordings;
use crate::db::stored_search::search_answers::{self, RecordingFact, SaidOfRecordings};
use crate::error::CorpusResult;

/// Returns the recordings that an expression means; `None` if one of its conditions is about tokens, or names what no
/// recording has.
pub(super) fn find_recordings(
    connection: &Connection,
    expression: &QueryExpression,
) -> CorpusResult<Option<BTreeSet<i64>>> {
    let all = || -> CorpusResult<BTreeSet<i64>> {
        let rows = stored_recordings::load_recording_rows(connection)?;
        Ok(rows.into_iter().map(|row| row.id).collect())
    };
    let each = |terms: &[QueryExpression]| -> CorpusResult<Option<Vec<BTreeSet<i64>>>> {
        terms.iter().map(|term| find_recordings(connection, term)).collect()
    };
    Ok(match expression {
        QueryExpression::And(terms) if !terms.is_empty() => each(terms)?.and_then(|found| {
            found
                .into_iter()
                .reduce(|one, other| one.intersection(&other).copied().collect())
        }),
        QueryExpression::Or(terms) => each(terms)?.map(|found| found.into_iter().flatten().collect()),
        QueryExpression::Not(inner) => match find_recordings(connection, inner)? {
            Some(found) => Some(all()?.difference(&found).copied().collect()),
            None => None,
        },
        QueryExpression::Test(test) => match said_of_recordings(connection, test)? {
            Some(said) => {
                let mut passing = all()?;
                passing.retain(|recording| passes_test(test, said.get(recording).map_or(&[], Vec::as_slice)));
                // A name that nothing has may be misspelt, which the search for tokens says.
                Some(passing).filter(|passing| !passing.is_empty())
            }
            None => None,
        },
        _ => None,
    })
}

/// Returns what the corpus says of each recording about the subject of a test; `None` if that is one of tokens.
fn said_of_recordings(connection: &Connection, test: &QueryTest) -> CorpusResult<Option<SaidOfRecordings>> {
    let fact = match &test.what {
        TestSubject::Property(WholeTokenProperty::Recording, _) => RecordingFact::Name,
        TestSubject::Property(WholeTokenProperty::File, _) => RecordingFact::File,
        TestSubject::Property(WholeTokenProperty::Signer, _) => RecordingFact::Signer,
        TestSubject::Attribute(name, _) if name.starts_with(SIGNER_ATTRIBUTE_PREFIX) => RecordingFact::Attribute,
        _ => return Ok(None),
    };
    let mut said = search_answers::load_recording_facts(connection, fact)?;
    if let TestSubject::Attribute(name, _) = &test.what {
        let names = meant_attribute_names(&stored_attributes::list_attribute_names(connection)?, name);
        if names.is_empty() {
            return Ok(None);
        }
        for rows in said.values_mut() {
            rows.retain(|row| names.contains(&row.name));
        }
    }
    Ok(Some(said))
}

/// Returns whether the fields of a recording pass.
fn passes_test(test: &QueryTest, said: &[AttributeRow]) -> bool {
    let comparison = match &test.what {
        TestSubject::Attribute(_, wanted @ AttributeTest::Number(..)) => {
            let mut numbers = said.iter().filter_map(|row| row.number);
            return numbers.any(|number| wanted.accepts_attribute_number(number));
        }
        TestSubject::Attribute(_, AttributeTest::Value(comparison)) | TestSubject::Property(_, comparison) => {
            comparison
        }
        _ => return false,
    };
    let is_met = |value: &QueryValue| match value.wanted {
        WantedValue::Missing(MissingReason::Unset) => said.is_empty(),
        _ => said
            .iter()
            .any(|row| is_attribute_match(row, value, comparison.operator)),
    };
    let is_any_met = comparison.values.iter().any(is_met);
    match comparison.operator {
        // A named value is unlike only what there is.
        ComparisonOperator::IsNot => !(is_any_met || names_one(comparison) && said.is_empty()),
        ComparisonOperator::Is | ComparisonOperator::Exactly => is_any_met,
    }
}
