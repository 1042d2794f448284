//! Reading the values on the right of an operator.

use super::query_lex::{QueryCursor, QueryWord, WordContext};
use super::query_tree::{QueryPlace, QueryValue, ValueFeature, WantedValue};
use super::{QueryError, query_lex, query_parse, query_words};

/// Reads one or more items, separated by commas.
pub(super) fn parse_comma_list<T>(
    cursor: &mut QueryCursor<'_>,
    item: impl Fn(&mut QueryCursor<'_>) -> Result<T, QueryError>,
) -> Result<Vec<T>, QueryError> {
    let mut items = Vec::new();
    loop {
        let start = cursor.pos;
        cursor.skip_blanks();
        if cursor.pos > start && query_parse::next_joint(cursor).is_some() {
            return Err(missing_value(cursor));
        }
        items.push(item(cursor)?);
        cursor.check_word_boundary()?;
        let mut ahead = cursor.clone();
        ahead.skip_blanks();
        if !ahead.eat_char(',') {
            return Ok(items);
        }
        *cursor = ahead;
    }
}

fn missing_value(cursor: &QueryCursor<'_>) -> QueryError {
    let (count, remedy) = match cursor.peek_char() {
        Some('(') => (1, "one of several values is written with commas: placement=chest,chin"),
        Some('=') => (1, "a value with = in it is written in quotes"),
        _ if query_parse::next_joint(cursor).is_some() => (
            cursor.clone().skip_bare_word(WordContext::Term).char_range().len(),
            "a value that is a joint is written in quotes",
        ),
        _ => (0, "write a value, * for any, or unset, n/a or unclear"),
    };
    QueryError::new(cursor.next(count), "a value should stand here", remedy)
}

/// Reads a bare or quoted word that is not empty.
pub(super) fn filled_word(cursor: &mut QueryCursor<'_>) -> Result<QueryWord, QueryError> {
    read_filled_word(cursor, WordContext::Value)
}

fn read_filled_word(cursor: &mut QueryCursor<'_>, place: WordContext) -> Result<QueryWord, QueryError> {
    let word = cursor.read_query_word(place)?;
    if word.at.start == word.at.end {
        return Err(missing_value(cursor));
    }
    if word.pattern.as_literal().is_some_and(|text| text.trim().is_empty()) {
        let remedy = "a field without a value is written =unset, =n/a or =unclear";
        return Err(QueryError::new(word.at, "this value is empty", remedy));
    }
    Ok(word)
}

/// The most values in a sequence such as `a > b > c`.
const MOST_STEPS: usize = 6;

/// Reads one value of a component, or a sequence of several: `head > chest`.
pub(super) fn parse_value_path(cursor: &mut QueryCursor<'_>) -> Result<QueryValue, QueryError> {
    const VALUE_PATH_REMEDY: &str = "write for example placement=head > chest, placement=head > * or * > chest";
    let first = parse_one_value(cursor, WordContext::Step)?;
    let start = first.at.start;
    let mut steps = vec![first];
    loop {
        let mut ahead = cursor.clone();
        ahead.skip_blanks();
        if !ahead.eat_char('>') {
            break;
        }
        ahead.skip_blanks();
        *cursor = ahead;
        steps.push(parse_one_value(cursor, WordContext::Step)?);
    }
    if steps.len() > MOST_STEPS {
        let message = format!("more than {MOST_STEPS} values follow each other here");
        return Err(QueryError::new(cursor.place_since(start), message, VALUE_PATH_REMEDY));
    }
    if steps.len() > 1 {
        // Steps are compared with readings that there are.
        for step in &steps {
            if matches!(step.wanted, WantedValue::Missing(_)) {
                let message = "nothing begins or goes on where no value is";
                return Err(QueryError::new(step.at, message, VALUE_PATH_REMEDY));
            }
        }
        return Ok(QueryValue {
            at: cursor.place_since(start),
            wanted: WantedValue::Steps(steps),
        });
    }
    Ok(steps.remove(0))
}

/// Reads one value of a field.
pub(super) fn parse_field_value(cursor: &mut QueryCursor<'_>) -> Result<QueryValue, QueryError> {
    parse_one_value(cursor, WordContext::Value)
}

fn parse_one_value(cursor: &mut QueryCursor<'_>, place: WordContext) -> Result<QueryValue, QueryError> {
    if cursor.peek_char() == Some('[') {
        return parse_value_features(cursor);
    }
    let word = read_filled_word(cursor, place)?;
    let missing = word
        .pattern
        .as_literal()
        .filter(|_| !word.quoted)
        .and_then(query_words::missing_reason_of);
    let wanted = match missing {
        Some(missing) => WantedValue::Missing(missing),
        None if word.pattern.matches_everything() => WantedValue::Present,
        None => WantedValue::Named(word.pattern),
    };
    Ok(QueryValue { at: word.at, wanted })
}

/// Reads `[index -thumb]`.
fn parse_value_features(cursor: &mut QueryCursor<'_>) -> Result<QueryValue, QueryError> {
    let open = cursor.next(1);
    cursor.pos = open.end;
    let mut parsed_features = Vec::new();
    let mut not: Option<QueryPlace> = None;
    loop {
        while cursor.peek_char().is_some_and(|c| c.is_whitespace() || c == ',') {
            cursor.pos += 1;
        }
        match cursor.peek_char() {
            None => {
                let remedy = "write ] after the last feature";
                return Err(QueryError::new(open, "this bracket is not closed", remedy));
            }
            Some(']') => break,
            Some(_) => {}
        }
        let feature = feature(cursor)?;
        // The word applies to the next feature, as the sign - does.
        if feature.name == "not" && !feature.absent && not.is_none() {
            not = Some(feature.at);
        } else if let Some(at) = not.take() {
            parsed_features.push(ValueFeature {
                at: at.extend_place_to(feature.at),
                absent: !feature.absent,
                ..feature
            });
        } else {
            parsed_features.push(feature);
        }
    }
    cursor.pos += 1;
    let brackets_at = cursor.place_since(open.start);
    if parsed_features.is_empty() || not.is_some() {
        let remedy = "write for example configuration=[index middle -thumb]";
        return Err(QueryError::new(
            brackets_at,
            "a feature is missing between the brackets",
            remedy,
        ));
    }
    Ok(QueryValue {
        at: brackets_at,
        wanted: WantedValue::Features(parsed_features),
    })
}

fn feature(cursor: &mut QueryCursor<'_>) -> Result<ValueFeature, QueryError> {
    let start = cursor.pos;
    let absent = matches!(cursor.peek_char(), Some('-' | '−' | '–'));
    cursor.pos += usize::from(absent);
    if !absent {
        cursor.eat_char('+');
    }
    let name_start = cursor.pos;
    while cursor.peek_char().is_some_and(is_feature_char) {
        cursor.pos += 1;
    }
    let name = cursor.text_at_place(cursor.place_since(name_start));
    if name.is_empty() || name.starts_with(['-', '−', '–', '+']) {
        let remedy = "features are names between blanks, those that must be absent with a minus: [index -thumb]";
        return Err(QueryError::new(cursor.next(1), "this is no feature", remedy));
    }
    Ok(ValueFeature {
        at: cursor.place_since(start),
        name,
        absent,
    })
}

/// Returns whether a feature's name may hold this character.
pub(super) fn is_feature_char(c: char) -> bool {
    !c.is_whitespace() && !query_lex::is_quote(c) && !matches!(c, ',' | '[' | ']' | '(' | ')' | '*')
}
