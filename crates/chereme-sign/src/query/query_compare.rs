//! Reading comparisons: `right.configuration=U`, `gloss:BO*`, `duration<0.8s`, `tier("Gaze")=*`.

use super::query_lex::{QueryCursor, WordContext};
use super::query_tree::{
    ComparisonOperator, MissingReason, QueryPlace, QueryTest, QueryValue, TestSubject, TextField, ValueComparison,
    WantedValue, WholeTokenProperty,
};
use super::query_values::{filled_word, parse_comma_list, parse_field_value, parse_value_path};
use super::query_words::{self, SimpleField};
use super::{QueryError, TextPattern, query_attributes, query_cue, query_curves, query_notation, query_times};
use crate::component::{ComponentField, HandRef, SignComponent, SignPhase};
use crate::text::nearest_candidate;
use std::str::FromStr;

const VALUE_SOURCE_REMEDY: &str =
    "in braces stand by=, proposed:yes, disputed:yes and confidence>, as in configuration=U{by=anna}";

/// Reads a comparison whose field is next; an operator is known to follow it.
pub(super) fn parse_field_test(cursor: &mut QueryCursor<'_>) -> Result<QueryTest, QueryError> {
    let subject_at = cursor.skip_bare_word(WordContext::Term);
    let name = cursor.text_at_place(subject_at);
    let what = match query_words::simple_field(&name) {
        None if query_cue::is_field(&name) => query_cue::parse_cue_test(cursor, &name, subject_at)?,
        None if name.eq_ignore_ascii_case(query_notation::NOTATION_FIELD) => {
            query_notation::parse_notation_test(cursor)?
        }
        Some(SimpleField::Text(field)) => text_test(cursor, field)?,
        Some(SimpleField::Property(property)) => property_test(cursor, property)?,
        Some(SimpleField::Time(field)) => TestSubject::Time(field, query_times::time_test(cursor, field)?),
        None if query_curves::is_curve_comparison(cursor, &name) => {
            TestSubject::Curve(query_curves::parse_curve_test(cursor, &name)?)
        }
        None => match parse_attribute_comparison(cursor, &name, subject_at)? {
            Some(what) => what,
            None => {
                let field = parse_component_field(cursor, subject_at)?;
                let comparison = component_comparison(cursor)?;
                match cursor.peek_char() {
                    Some('{') => {
                        TestSubject::Said(field, source_comparison(&comparison)?, parse_value_sources(cursor)?)
                    }
                    _ => TestSubject::Component(field, comparison),
                }
            }
        },
    };
    Ok(QueryTest {
        at: cursor.place_since(subject_at.start),
        subject_at,
        what,
    })
}

/// Reads the comparison of an attribute; `None` if the name before it is not one. A name is an attribute if it begins
/// with `attribute.`, or if it is no field and a comparison with numbers follows; after a name that resembles a field, a
/// single number is a value of the field.
fn parse_attribute_comparison(
    cursor: &mut QueryCursor<'_>,
    name: &str,
    at: QueryPlace,
) -> Result<Option<TestSubject>, QueryError> {
    if let Some(name) = query_attributes::attribute_name_of_word(name) {
        return query_attributes::parse_attribute_test(cursor, name).map(Some);
    }
    let Err(no_field) = parse_component_field(cursor, at) else {
        return Ok(None);
    };
    let is_one = query_attributes::is_attribute_comparison(cursor)
        || no_field.suggestion.is_none() && query_attributes::is_single_number_comparison(cursor);
    if name.contains('.') || !is_one {
        return Ok(None);
    }
    query_attributes::parse_attribute_test(cursor, name.to_owned()).map(Some)
}

/// Reads `("name")` and the comparison after the word `tier`, which is at `at`.
pub(super) fn tier_test(cursor: &mut QueryCursor<'_>, at: QueryPlace) -> Result<QueryTest, QueryError> {
    const TIER_TEST_REMEDY: &str = r#"write for example tier("Mouthing")=ma* or tier("Mouthing")=*"#;
    cursor.skip_blanks();
    let open = cursor.next(1);
    cursor.pos = open.end;
    cursor.skip_blanks();
    let name = cursor.read_query_word(WordContext::Value)?;
    if name.at.start == name.at.end || name.pattern.as_literal().is_some_and(str::is_empty) {
        return Err(QueryError::new(name.at, "the tier's name is missing", TIER_TEST_REMEDY));
    }
    cursor.skip_blanks();
    if !cursor.eat_char(')') {
        let remedy = "write ) after the tier's name; a name with blanks needs quotes";
        return Err(QueryError::new(open, "this parenthesis is not closed", remedy));
    }
    let subject_at = cursor.place_since(at.start);
    cursor.skip_blanks();
    if cursor.peek_operator().is_none() {
        return Err(QueryError::new(
            cursor.next(0),
            "a comparison should follow the tier",
            TIER_TEST_REMEDY,
        ));
    }
    let what = TestSubject::Tier(name.pattern, parse_field_comparison(cursor, ColonMeaning::Refused)?);
    Ok(QueryTest {
        at: cursor.place_since(at.start),
        subject_at,
        what,
    })
}

/// Returns the error for an operator that has nothing on its left.
pub(super) fn stray_operator(cursor: &QueryCursor<'_>) -> QueryError {
    let operator = cursor.peek_operator().unwrap_or_default();
    QueryError::new(
        cursor.next(operator.chars().count()),
        format!("`{operator}` has no field on its left"),
        "write a field before it, such as placement=chin; text with such signs is searched in quotes",
    )
}

/// Checks that a text to search for has at least one letter, digit or non-ASCII character.
pub(super) fn check_searchable(pattern: &TextPattern, at: QueryPlace) -> Result<(), QueryError> {
    let text: String = pattern.pattern_segments().concat();
    if pattern.regular_expression().is_some() {
        return Ok(());
    }
    if text.chars().any(|c| c.is_alphanumeric() || !c.is_ascii()) {
        return Ok(());
    }
    let remedy = "write a word or part of one; the empty query finds everything";
    Err(QueryError::new(at, "there is nothing to search for in this", remedy))
}

/// Checks that a free text can be searched for and is not an operator of another query language, such as `&&`.
pub(super) fn check_term(pattern: &TextPattern, at: QueryPlace) -> Result<(), QueryError> {
    let (remedy, suggestion) = match pattern.as_literal().unwrap_or_default() {
        "|" | "||" => ("one or the other is written with `or`", "or"),
        "&" | "&&" | "+" => ("terms side by side must all hold already", "and"),
        "!" | "-" => ("write a condition that must not hold with `not`", "not"),
        _ => return check_searchable(pattern, at),
    };
    let error = QueryError::new(at, "this sign joins nothing here", remedy);
    Err(error.with_suggestion(Some(suggestion)))
}

/// Returns the component that the word at `at` names.
pub(super) fn parse_component_field(cursor: &QueryCursor<'_>, at: QueryPlace) -> Result<ComponentField, QueryError> {
    let name = cursor.text_at_place(at);
    let (mut hand, mut phase, mut start) = (None, None, at.start);
    let mut parts = name.split('.');
    let component = loop {
        let Some(part) = parts.next() else {
            return Err(QueryError::new(at, format!("{name:?} names no component"), "")
                .with_suggestion(Some(format!("{name}.configuration"))));
        };
        let part_at = QueryPlace {
            start,
            end: start + part.chars().count(),
        };
        start = part_at.end + 1;
        // Hand and phase stand before the component, in either order.
        let part_word = query_words::canonical_part_name(part);
        if let Ok(component) = SignComponent::from_str(&part_word) {
            break component;
        }
        let twice = if let Ok(found) = HandRef::from_str(&part_word) {
            hand.replace((found, part_at)).is_some()
        } else if let Ok(found) = SignPhase::from_str(&part_word) {
            phase.replace(found).is_some()
        } else {
            return Err(unknown_field(cursor, part, part_at, at));
        };
        if twice {
            let remedy = "a component has at most one hand and one phase before it";
            return Err(QueryError::new(part_at, format!("{part:?} is one too many"), remedy));
        }
    };
    let rest = QueryPlace {
        start: start.min(at.end),
        end: at.end,
    };
    let parts: Vec<&str> = parts.collect();
    if let [hand] = parts[..]
        && let Ok(hand) = HandRef::from_str(&query_words::canonical_part_name(hand))
    {
        let message = format!("the hand stands before {component}, not after it");
        let before = name.rsplit_once('.').map_or(&name[..], |(before, _)| before);
        let suggestion = format!("{}.{before}", hand.hand_ref_name());
        return Err(QueryError::new(at, message, "").with_suggestion(Some(suggestion)));
    }
    let feature = feature_name(parts, rest)?;
    if let Some((_, hand_at)) = hand.filter(|_| !component.is_manual()) {
        let remedy = "leave the hand out";
        return Err(QueryError::new(
            hand_at,
            "non-manual components belong to no hand",
            remedy,
        ));
    }
    Ok(ComponentField {
        hand: hand.map(|(hand, _)| hand),
        component,
        feature,
        phase,
    })
}

fn feature_name(parts: Vec<&str>, at: QueryPlace) -> Result<Option<String>, QueryError> {
    let legal = |name: &str| !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || "-_".contains(c));
    match &parts[..] {
        [] => Ok(None),
        [feature] if legal(feature) => Ok(Some(feature.to_lowercase())),
        _ => Err(QueryError::new(
            at,
            "after a component stands at most one part of it",
            "write for example orientation.palm or nonmanual.brows",
        )),
    }
}

fn unknown_field(cursor: &QueryCursor<'_>, part: &str, at: QueryPlace, whole: QueryPlace) -> QueryError {
    // A field that is no component has no hand and no phase.
    if query_words::simple_field(part).is_some() {
        let remedy = "write configuration, placement, movement, orientation or nonmanual here";
        return QueryError::new(at, format!("{part:?} is no component"), remedy);
    }
    // Simple fields are suggested only for a word that stands alone.
    let single = at.char_range() == whole.char_range();
    let simple = query_words::simple_names().filter(|_| single);
    let others = SignComponent::ALL_COMPONENTS
        .into_iter()
        .flat_map(SignComponent::component_spellings);
    let names = query_words::part_names().chain(simple).chain(others.copied());
    let known_part = query_words::component_of_part(&query_words::canonical_part_name(part)).filter(|_| single);
    if let Some(component) = known_part {
        let message = format!("{part:?} is a part of {component}");
        let suggestion = format!("{component}.{}", query_words::canonical_part_name(part));
        return QueryError::new(at, message, "").with_suggestion(Some(suggestion));
    }
    let suggestion = nearest_candidate(&query_words::canonical_part_name(part), names);
    let error = QueryError::new(at, format!("there is no field {part:?}"), "");
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    // Glosses of corpora hold colons, as in `PT:PRO1`, and are no fields then.
    if suggestion.is_none() && single && ahead.peek_operator() == Some(":") && part.chars().any(char::is_uppercase) {
        let remedy = "a gloss with a colon stands after gloss= or in quotes".to_owned();
        return QueryError {
            remedy: remedy.into(),
            ..error
        }
        .with_suggestion(Some(format!("gloss={part}")));
    }
    let remedy = if suggestion.is_some() {
        String::new()
    } else {
        let names: Vec<&str> = SignComponent::ALL_COMPONENTS
            .into_iter()
            .map(SignComponent::component_name)
            .chain(query_words::simple_names())
            .collect();
        format!(
            "fields are {}; text with such signs is searched in quotes",
            names.join(", ")
        )
    };
    QueryError {
        remedy: remedy.into(),
        ..error
    }
    .with_suggestion(suggestion)
}

/// Whether `field:value` means `field=value`, as in addresses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ColonMeaning {
    Equals,
    Refused,
}

/// Reads a comparison of a component, whose values may follow each other.
fn component_comparison(cursor: &mut QueryCursor<'_>) -> Result<ValueComparison, QueryError> {
    let operator = parse_query_operator(cursor, ColonMeaning::Refused)?;
    let values = parse_comma_list(cursor, parse_value_path)?;
    let steps = |value: &&QueryValue| matches!(value.wanted, WantedValue::Steps(_));
    if operator == ComparisonOperator::IsNot
        && let Some(value) = values.iter().find(steps)
    {
        let message = "successive values are not compared with `!=`";
        let remedy = "write `not` before the comparison: not placement=head > chest";
        return Err(QueryError::new(value.at, message, remedy));
    }
    Ok(ValueComparison { operator, values })
}

/// Checks that a comparison is one of single values that there are, so that somebody can say them.
fn source_comparison(comparison: &ValueComparison) -> Result<ValueComparison, QueryError> {
    let unsaid = |value: &&QueryValue| {
        matches!(
            value.wanted,
            WantedValue::Missing(MissingReason::Unset) | WantedValue::Steps(_)
        )
    };
    match comparison.values.iter().find(unsaid) {
        Some(value) => Err(QueryError::new(
            value.at,
            "nobody says this of one value",
            VALUE_SOURCE_REMEDY,
        )),
        None => Ok(comparison.clone()),
    }
}

/// Reads the conditions on who says a value: `{by=anna confidence>0.8}`.
fn parse_value_sources(cursor: &mut QueryCursor<'_>) -> Result<Vec<QueryTest>, QueryError> {
    let open = cursor.next(1);
    let Some(mut inside) = cursor.read_braces() else {
        return Err(QueryError::new(
            open,
            "this brace is not closed",
            "write } after the last condition",
        ));
    };
    let mut tests = Vec::new();
    loop {
        inside.skip_blanks();
        let word_at = inside.clone().skip_bare_word(WordContext::Term);
        let mut ahead = inside.clone();
        ahead.pos = word_at.end;
        ahead.skip_blanks();
        if inside.peek_char().is_none() && !tests.is_empty() {
            cursor.check_word_boundary()?;
            return Ok(tests);
        }
        let refused = || QueryError::new(word_at, "this does not say who says so", VALUE_SOURCE_REMEDY);
        if ahead.peek_operator().is_none() || word_at.start == word_at.end {
            return Err(refused());
        }
        let test = parse_field_test(&mut inside)?;
        if !test.asks_for_source() {
            return Err(refused());
        }
        tests.push(test);
    }
}

/// Reads the operator and the values of a key.
pub(super) fn comparison_of_key(cursor: &mut QueryCursor<'_>) -> Result<ValueComparison, QueryError> {
    parse_field_comparison(cursor, ColonMeaning::Equals)
}

fn parse_field_comparison(cursor: &mut QueryCursor<'_>, colon: ColonMeaning) -> Result<ValueComparison, QueryError> {
    Ok(ValueComparison {
        operator: parse_query_operator(cursor, colon)?,
        values: parse_comma_list(cursor, parse_field_value)?,
    })
}

fn parse_query_operator(cursor: &mut QueryCursor<'_>, colon: ColonMeaning) -> Result<ComparisonOperator, QueryError> {
    let operator_at = operator_place(cursor);
    Ok(match &cursor.text_at_place(operator_at)[..] {
        "=" => ComparisonOperator::Is,
        "==" => ComparisonOperator::Exactly,
        "!=" | "≠" => ComparisonOperator::IsNot,
        ":" if colon == ColonMeaning::Equals => ComparisonOperator::Is,
        found => {
            let suggestion = if found == "<>" { "!=" } else { "=" };
            let message = format!("`{found}` does not compare values");
            let remedy = "values are compared with =, != or == (this value and none narrower)";
            return Err(QueryError::new(operator_at, message, remedy).with_suggestion(Some(suggestion)));
        }
    })
}

/// Steps over the next operator and returns its place.
pub(super) fn operator_place(cursor: &mut QueryCursor<'_>) -> QueryPlace {
    cursor.skip_blanks();
    let count = cursor.peek_operator().map_or(0, |operator| operator.chars().count());
    let place = cursor.next(count);
    cursor.pos = place.end;
    place
}

fn property_test(cursor: &mut QueryCursor<'_>, property: WholeTokenProperty) -> Result<TestSubject, QueryError> {
    let mut comparison = parse_field_comparison(cursor, ColonMeaning::Equals)?;
    for value in &mut comparison.values {
        if matches!(value.wanted, WantedValue::Features(_)) {
            return Err(no_features(value.at));
        }
        if let Some(fixed) = property.fixed_values() {
            fix_property_value(value, property, fixed)?;
        }
    }
    Ok(TestSubject::Property(property, comparison))
}

/// Reads the operator and the values after the name of an attribute.
pub(super) fn comparison_of_attribute(cursor: &mut QueryCursor<'_>) -> Result<ValueComparison, QueryError> {
    let comparison = parse_field_comparison(cursor, ColonMeaning::Equals)?;
    let mut values = comparison.values.iter();
    match values.find(|value| matches!(value.wanted, WantedValue::Features(_))) {
        Some(value) => Err(no_features(value.at)),
        None => Ok(comparison),
    }
}

fn no_features(at: QueryPlace) -> QueryError {
    QueryError::new(at, "only components have features", "write a name here")
}

/// Replaces a value of a property with fixed values by its canonical spelling.
fn fix_property_value(value: &mut QueryValue, property: WholeTokenProperty, fixed: &[&str]) -> Result<(), QueryError> {
    let WantedValue::Named(pattern) = &value.wanted else {
        return Ok(());
    };
    let text = pattern
        .as_literal()
        .map_or_else(|| pattern.to_string(), str::to_lowercase);
    let hand = HandRef::from_str(&query_words::canonical_part_name(&text))
        .ok()
        .filter(|_| property == WholeTokenProperty::Hand);
    let house = hand
        .map(HandRef::hand_ref_name)
        .or_else(|| fixed.iter().copied().find(|name| *name == text))
        .or_else(|| query_words::origin_from_word(&text).filter(|_| property == WholeTokenProperty::Origin))
        .or_else(|| query_words::answer_from_word(&text).filter(|answer| fixed.contains(answer)));
    let Some(house) = house else {
        let message = format!("{text:?} is no {}", property.property_name());
        let remedy = format!("known values: {}", fixed.join(", "));
        return Err(
            QueryError::new(value.at, message, remedy).with_suggestion(nearest_candidate(&text, fixed.iter().copied()))
        );
    };
    value.wanted = WantedValue::Named(TextPattern::literal_pattern(house));
    Ok(())
}

fn text_test(cursor: &mut QueryCursor<'_>, field: TextField) -> Result<TestSubject, QueryError> {
    cursor.skip_blanks();
    match cursor.peek_operator() {
        Some(":" | "~") if expression_follows(cursor) => {
            operator_place(cursor);
            Ok(TestSubject::Whole(
                field,
                ValueComparison {
                    operator: ComparisonOperator::Is,
                    values: parse_comma_list(cursor, parse_field_value)?,
                },
            ))
        }
        Some(":") => {
            operator_place(cursor);
            let words = parse_comma_list(cursor, |cursor| {
                let word = filled_word(cursor)?;
                check_searchable(&word.pattern, word.at)?;
                Ok(word.pattern)
            })?;
            Ok(TestSubject::Words(field, words))
        }
        Some("~") => parse_fuzzy_test(cursor, field),
        Some(operator @ ("<" | ">" | "<=" | ">=" | "=<" | "=>" | "≤" | "≥")) => Err(QueryError::new(
            cursor.next(operator.chars().count()),
            format!("`{operator}` does not compare texts"),
            "texts are compared with = (whole), : (words in it) or ~ (up to a slip)",
        )
        .with_suggestion(Some("="))),
        _ => {
            let comparison = parse_field_comparison(cursor, ColonMeaning::Refused)?;
            let features = comparison
                .values
                .iter()
                .find(|v| matches!(v.wanted, WantedValue::Features(_)));
            features.map_or(Ok(()), |value| Err(no_features(value.at)))?;
            Ok(TestSubject::Whole(field, comparison))
        }
    }
}

/// Returns whether the value after the next operator is a regular expression.
fn expression_follows(cursor: &QueryCursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    operator_place(&mut ahead);
    ahead.skip_blanks();
    ahead.peek_char() == Some('/')
}

/// Reads `~ESCARGO` or `~ESCARG~2`.
fn parse_fuzzy_test(cursor: &mut QueryCursor<'_>, field: TextField) -> Result<TestSubject, QueryError> {
    operator_place(cursor);
    cursor.skip_blanks();
    let word = filled_word(cursor)?;
    let Some(text) = word.pattern.as_literal().map(str::to_owned) else {
        let remedy = "write either field:BO* or field~BOL";
        return Err(QueryError::new(word.at, "wildcards do not go with ~", remedy));
    };
    let (text, count, count_at) = if word.quoted {
        let rest = if cursor.peek_char() == Some('~') {
            cursor.skip_text_chunk()
        } else {
            cursor.next(0)
        };
        (
            text,
            cursor.text_at_place(rest).strip_prefix('~').map(str::to_owned),
            rest,
        )
    } else {
        match text.rsplit_once('~') {
            Some((name, count)) => {
                let start = word.at.end - count.chars().count() - 1;
                (
                    name.to_owned(),
                    Some(count.to_owned()),
                    QueryPlace {
                        start,
                        end: word.at.end,
                    },
                )
            }
            None => (text, None, word.at),
        }
    };
    let slips = match count.as_deref() {
        None | Some("1") => 1,
        Some("2") => 2,
        Some(_) => {
            let remedy = "one slip is ~1 or nothing, two are ~2; a ~ inside a text needs quotes";
            return Err(QueryError::new(
                count_at,
                "a text is searched up to one or two slips",
                remedy,
            ));
        }
    };
    check_searchable(&TextPattern::literal_pattern(&text[..]), word.at)?;
    cursor.check_word_boundary()?;
    Ok(TestSubject::Fuzzy { field, text, slips })
}
