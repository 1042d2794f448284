//! Reading comparisons: `right.configuration=U`, `gloss:BO*`, `duration<0.8s`, `tier("Gaze")=*`.

use super::lex::{Cursor, WordContext};
use super::tree::{At, Comparison, Operator, Property, Test, TextField, Value, Wanted, What};
use super::values::{filled_word, list, path, value};
use super::words::{self, Simple};
use super::{Pattern, QueryError, attributes, cue, curves, times};
use crate::component::{Component, Field, HandRef, Phase};
use crate::text::nearest;
use std::str::FromStr;

/// Reads a comparison whose field is next; an operator is known to follow it.
pub(super) fn test(cursor: &mut Cursor<'_>) -> Result<Test, QueryError> {
    let subject_at = cursor.bare(WordContext::Term);
    let name = cursor.text(subject_at);
    let what = match words::simple_field(&name) {
        None if cue::is_field(&name) => cue::test(cursor, &name, subject_at)?,
        Some(Simple::Text(field)) => text_test(cursor, field)?,
        Some(Simple::Property(property)) => property_test(cursor, property)?,
        Some(Simple::Time(field)) => What::Time(field, times::time_test(cursor, field)?),
        None if curves::opens(cursor, &name) => What::Curve(curves::test(cursor, &name)?),
        None => match attribute(cursor, &name, subject_at)? {
            Some(what) => what,
            None => {
                let field = component(cursor, subject_at)?;
                What::Component(field, component_comparison(cursor)?)
            }
        },
    };
    Ok(Test {
        at: cursor.at(subject_at.start),
        subject_at,
        what,
    })
}

/// Reads the comparison of an attribute; `None` if the name before it is not one. A name is an attribute if it begins
/// with `attribute.`, or if it is no field and a comparison with numbers follows; after a name that resembles a field, a
/// single number is a value of the field.
fn attribute(cursor: &mut Cursor<'_>, name: &str, at: At) -> Result<Option<What>, QueryError> {
    if let Some(name) = attributes::prefixed(name) {
        return attributes::test(cursor, name.to_owned()).map(Some);
    }
    let Err(no_field) = component(cursor, at) else {
        return Ok(None);
    };
    let is_one =
        attributes::follows(cursor) || no_field.suggestion.is_none() && attributes::equals(cursor);
    if name.contains('.') || !is_one {
        return Ok(None);
    }
    attributes::test(cursor, name.to_owned()).map(Some)
}

/// Reads `("name")` and the comparison after the word `tier`, which is at `at`.
pub(super) fn tier_test(cursor: &mut Cursor<'_>, at: At) -> Result<Test, QueryError> {
    const REMEDY: &str = r#"write for example tier("Mouthing")=ma* or tier("Mouthing")=*"#;
    cursor.skip_blanks();
    let open = cursor.next(1);
    cursor.pos = open.end;
    cursor.skip_blanks();
    let name = cursor.word(WordContext::Value)?;
    if name.at.start == name.at.end || name.pattern.as_literal().is_some_and(str::is_empty) {
        return Err(QueryError::new(
            name.at,
            "the tier's name is missing",
            REMEDY,
        ));
    }
    cursor.skip_blanks();
    if !cursor.eat(')') {
        let remedy = "write ) after the tier's name; a name with blanks needs quotes";
        return Err(QueryError::new(
            open,
            "this parenthesis is not closed",
            remedy,
        ));
    }
    let subject_at = cursor.at(at.start);
    cursor.skip_blanks();
    if cursor.operator().is_none() {
        return Err(QueryError::new(
            cursor.next(0),
            "a comparison should follow the tier",
            REMEDY,
        ));
    }
    let what = What::Tier(name.pattern, comparison(cursor, Colon::Refused)?);
    Ok(Test {
        at: cursor.at(at.start),
        subject_at,
        what,
    })
}

/// Returns the error for an operator that has nothing on its left.
pub(super) fn stray_operator(cursor: &Cursor<'_>) -> QueryError {
    let operator = cursor.operator().unwrap_or_default();
    QueryError::new(
        cursor.next(operator.chars().count()),
        format!("`{operator}` has no field on its left"),
        "write a field before it, such as placement=chin; text with such signs is searched in quotes",
    )
}

/// Checks that a text to search for has at least one letter, digit or non-ASCII character.
pub(super) fn check_searchable(pattern: &Pattern, at: At) -> Result<(), QueryError> {
    let text: String = pattern.segments().concat();
    if pattern.expression().is_some() {
        return Ok(());
    }
    if text.chars().any(|c| c.is_alphanumeric() || !c.is_ascii()) {
        return Ok(());
    }
    let remedy = "write a word or part of one; the empty query finds everything";
    Err(QueryError::new(
        at,
        "there is nothing to search for in this",
        remedy,
    ))
}

/// Checks that a free text can be searched for and is not an operator of another query language, such as `&&`.
pub(super) fn check_term(pattern: &Pattern, at: At) -> Result<(), QueryError> {
    let (remedy, suggestion) = match pattern.as_literal().unwrap_or_default() {
        "|" | "||" => ("one or the other is written with `or`", "or"),
        "&" | "&&" | "+" => ("terms side by side must all hold already", "and"),
        "!" | "-" => ("write a condition that must not hold with `not`", "not"),
        _ => return check_searchable(pattern, at),
    };
    let error = QueryError::new(at, "this sign joins nothing here", remedy);
    Err(error.suggest(Some(suggestion)))
}

/// Returns the component that the word at `at` names.
pub(super) fn component(cursor: &Cursor<'_>, at: At) -> Result<Field, QueryError> {
    let name = cursor.text(at);
    let (mut hand, mut phase, mut start) = (None, None, at.start);
    let mut parts = name.split('.');
    let component = loop {
        let Some(part) = parts.next() else {
            return Err(
                QueryError::new(at, format!("{name:?} names no component"), "")
                    .suggest(Some(format!("{name}.configuration"))),
            );
        };
        let part_at = At {
            start,
            end: start + part.chars().count(),
        };
        start = part_at.end + 1;
        let known = words::part(part);
        if let Ok(component) = Component::from_str(&known) {
            break component;
        }
        let twice = if let Ok(found) = HandRef::from_str(&known) {
            hand.replace((found, part_at)).is_some()
        } else if let Ok(found) = Phase::from_str(&known) {
            phase.replace(found).is_some()
        } else {
            return Err(unknown_field(cursor, part, part_at, at));
        };
        if twice {
            let remedy = "a component has at most one hand and one phase before it";
            return Err(QueryError::new(
                part_at,
                format!("{part:?} is one too many"),
                remedy,
            ));
        }
    };
    let rest = At {
        start: start.min(at.end),
        end: at.end,
    };
    let parts: Vec<&str> = parts.collect();
    if let [hand] = parts[..]
        && let Ok(hand) = HandRef::from_str(&words::part(hand))
    {
        let message = format!("the hand stands before {component}, not after it");
        let before = name
            .rsplit_once('.')
            .map_or(&name[..], |(before, _)| before);
        let meant = format!("{}.{before}", hand.name());
        return Err(QueryError::new(at, message, "").suggest(Some(meant)));
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
    Ok(Field {
        hand: hand.map(|(hand, _)| hand),
        component,
        feature,
        phase,
    })
}

fn feature_name(parts: Vec<&str>, at: At) -> Result<Option<String>, QueryError> {
    let legal = |name: &str| {
        !name.is_empty()
            && name
                .chars()
                .all(|c| c.is_alphanumeric() || "-_".contains(c))
    };
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

fn unknown_field(cursor: &Cursor<'_>, part: &str, at: At, whole: At) -> QueryError {
    if words::simple_field(part).is_some() {
        let remedy = "write configuration, placement, movement, orientation or nonmanual here";
        return QueryError::new(at, format!("{part:?} is no component"), remedy);
    }
    let single = at.range() == whole.range();
    let simple = words::simple_names().filter(|_| single);
    let others = Component::ALL.into_iter().flat_map(Component::names);
    let names = words::part_names().chain(simple).chain(others.copied());
    let known_part = words::component_of_part(&words::part(part)).filter(|_| single);
    if let Some(component) = known_part {
        let message = format!("{part:?} is a part of {component}");
        let meant = format!("{component}.{}", words::part(part));
        return QueryError::new(at, message, "").suggest(Some(meant));
    }
    let meant = nearest(&words::part(part), names);
    let error = QueryError::new(at, format!("there is no field {part:?}"), "");
    let mut ahead = cursor.clone();
    ahead.skip_blanks();
    if meant.is_none()
        && single
        && ahead.operator() == Some(":")
        && part.chars().any(char::is_uppercase)
    {
        let remedy = "a gloss with a colon stands after gloss= or in quotes".to_owned();
        return QueryError {
            remedy: remedy.into(),
            ..error
        }
        .suggest(Some(format!("gloss={part}")));
    }
    let remedy = if meant.is_some() {
        String::new()
    } else {
        let names: Vec<&str> = Component::ALL
            .into_iter()
            .map(Component::name)
            .chain(words::simple_names())
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
    .suggest(meant)
}

/// Whether `field:value` means `field=value`, as in addresses.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Colon {
    Equals,
    Refused,
}

/// Reads a comparison of a component, whose values may follow each other.
fn component_comparison(cursor: &mut Cursor<'_>) -> Result<Comparison, QueryError> {
    let operator = operator(cursor, Colon::Refused)?;
    let values = list(cursor, path)?;
    let steps = |value: &&Value| matches!(value.wanted, Wanted::Steps(_));
    if operator == Operator::IsNot
        && let Some(value) = values.iter().find(steps)
    {
        let message = "successive values are not compared with `!=`";
        let remedy = "write `not` before the comparison: not placement=head > chest";
        return Err(QueryError::new(value.at, message, remedy));
    }
    Ok(Comparison { operator, values })
}

/// Reads the operator and the values of a key.
pub(super) fn comparison_of_key(cursor: &mut Cursor<'_>) -> Result<Comparison, QueryError> {
    comparison(cursor, Colon::Equals)
}

fn comparison(cursor: &mut Cursor<'_>, colon: Colon) -> Result<Comparison, QueryError> {
    Ok(Comparison {
        operator: operator(cursor, colon)?,
        values: list(cursor, value)?,
    })
}

fn operator(cursor: &mut Cursor<'_>, colon: Colon) -> Result<Operator, QueryError> {
    let at = operator_place(cursor);
    Ok(match &cursor.text(at)[..] {
        "=" => Operator::Is,
        "==" => Operator::Exactly,
        "!=" | "≠" => Operator::IsNot,
        ":" if colon == Colon::Equals => Operator::Is,
        found => {
            let meant = if found == "<>" { "!=" } else { "=" };
            let message = format!("`{found}` does not compare values");
            let remedy = "values are compared with =, != or == (this value and none narrower)";
            return Err(QueryError::new(at, message, remedy).suggest(Some(meant)));
        }
    })
}

/// Steps over the next operator and returns its place.
pub(super) fn operator_place(cursor: &mut Cursor<'_>) -> At {
    cursor.skip_blanks();
    let count = cursor
        .operator()
        .map_or(0, |operator| operator.chars().count());
    let at = cursor.next(count);
    cursor.pos = at.end;
    at
}

fn property_test(cursor: &mut Cursor<'_>, property: Property) -> Result<What, QueryError> {
    let mut comparison = comparison(cursor, Colon::Equals)?;
    for value in &mut comparison.values {
        if matches!(value.wanted, Wanted::Features(_)) {
            return Err(no_features(value.at));
        }
        if let Some(fixed) = property.fixed_values() {
            fix(value, property, fixed)?;
        }
    }
    Ok(What::Property(property, comparison))
}

/// Reads the operator and the values after the name of an attribute.
pub(super) fn comparison_of_attribute(cursor: &mut Cursor<'_>) -> Result<Comparison, QueryError> {
    let comparison = comparison(cursor, Colon::Equals)?;
    let mut values = comparison.values.iter();
    match values.find(|value| matches!(value.wanted, Wanted::Features(_))) {
        Some(value) => Err(no_features(value.at)),
        None => Ok(comparison),
    }
}

fn no_features(at: At) -> QueryError {
    QueryError::new(at, "only components have features", "write a name here")
}

/// Replaces a value of a property with fixed values by its canonical spelling.
fn fix(value: &mut Value, property: Property, fixed: &[&str]) -> Result<(), QueryError> {
    let Wanted::Named(pattern) = &value.wanted else {
        return Ok(());
    };
    let text = pattern
        .as_literal()
        .map_or_else(|| pattern.to_string(), str::to_lowercase);
    let hand = HandRef::from_str(&words::part(&text))
        .ok()
        .filter(|_| property == Property::Hand);
    let house = hand
        .map(HandRef::name)
        .or_else(|| fixed.iter().copied().find(|name| *name == text))
        .or_else(|| words::origin(&text).filter(|_| property == Property::Origin));
    let Some(house) = house else {
        let message = format!("{text:?} is no {}", property.name());
        let remedy = format!("known values: {}", fixed.join(", "));
        return Err(QueryError::new(value.at, message, remedy)
            .suggest(nearest(&text, fixed.iter().copied())));
    };
    value.wanted = Wanted::Named(Pattern::literal(house));
    Ok(())
}

fn text_test(cursor: &mut Cursor<'_>, field: TextField) -> Result<What, QueryError> {
    cursor.skip_blanks();
    match cursor.operator() {
        Some(":" | "~") if expression_follows(cursor) => {
            operator_place(cursor);
            Ok(What::Whole(
                field,
                Comparison {
                    operator: Operator::Is,
                    values: list(cursor, value)?,
                },
            ))
        }
        Some(":") => {
            operator_place(cursor);
            let words = list(cursor, |cursor| {
                let word = filled_word(cursor)?;
                check_searchable(&word.pattern, word.at)?;
                Ok(word.pattern)
            })?;
            Ok(What::Words(field, words))
        }
        Some("~") => fuzzy(cursor, field),
        Some(operator @ ("<" | ">" | "<=" | ">=" | "=<" | "=>" | "≤" | "≥")) => {
            Err(QueryError::new(
                cursor.next(operator.chars().count()),
                format!("`{operator}` does not compare texts"),
                "texts are compared with = (whole), : (words in it) or ~ (up to a slip)",
            )
            .suggest(Some("=")))
        }
        _ => {
            let comparison = comparison(cursor, Colon::Refused)?;
            let features = comparison
                .values
                .iter()
                .find(|v| matches!(v.wanted, Wanted::Features(_)));
            features.map_or(Ok(()), |value| Err(no_features(value.at)))?;
            Ok(What::Whole(field, comparison))
        }
    }
}

/// Returns whether the value after the next operator is a regular expression.
fn expression_follows(cursor: &Cursor<'_>) -> bool {
    let mut ahead = cursor.clone();
    operator_place(&mut ahead);
    ahead.skip_blanks();
    ahead.peek() == Some('/')
}

/// Reads `~ESCARGO` or `~ESCARG~2`.
fn fuzzy(cursor: &mut Cursor<'_>, field: TextField) -> Result<What, QueryError> {
    operator_place(cursor);
    cursor.skip_blanks();
    let word = filled_word(cursor)?;
    let Some(text) = word.pattern.as_literal().map(str::to_owned) else {
        let remedy = "write either field:BO* or field~BOL";
        return Err(QueryError::new(
            word.at,
            "wildcards do not go with ~",
            remedy,
        ));
    };
    let (text, count, count_at) = if word.quoted {
        let rest = if cursor.peek() == Some('~') {
            cursor.chunk()
        } else {
            cursor.next(0)
        };
        (
            text,
            cursor.text(rest).strip_prefix('~').map(str::to_owned),
            rest,
        )
    } else {
        match text.rsplit_once('~') {
            Some((name, count)) => {
                let start = word.at.end - count.chars().count() - 1;
                (
                    name.to_owned(),
                    Some(count.to_owned()),
                    At {
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
    check_searchable(&Pattern::literal(&text[..]), word.at)?;
    cursor.boundary()?;
    Ok(What::Fuzzy { field, text, slips })
}
