//! Reading the values on the right of an operator.

use super::lex::{Cursor, Word, WordContext};
use super::tree::{At, Feature, Value, Wanted};
use super::{QueryError, lex, parse, words};

/// Reads one or more items, separated by commas.
pub(super) fn list<T>(
    cursor: &mut Cursor<'_>,
    item: impl Fn(&mut Cursor<'_>) -> Result<T, QueryError>,
) -> Result<Vec<T>, QueryError> {
    let mut items = Vec::new();
    loop {
        let start = cursor.pos;
        cursor.skip_blanks();
        if cursor.pos > start && parse::next_joint(cursor).is_some() {
            return Err(missing_value(cursor));
        }
        items.push(item(cursor)?);
        cursor.boundary()?;
        let mut ahead = cursor.clone();
        ahead.skip_blanks();
        if !ahead.eat(',') {
            return Ok(items);
        }
        *cursor = ahead;
    }
}

fn missing_value(cursor: &Cursor<'_>) -> QueryError {
    let (count, remedy) = match cursor.peek() {
        Some('(') => (
            1,
            "one of several values is written with commas: placement=chest,chin",
        ),
        Some('=') => (1, "a value with = in it is written in quotes"),
        _ if parse::next_joint(cursor).is_some() => (
            cursor.clone().bare(WordContext::Term).range().len(),
            "a value that is a joint is written in quotes",
        ),
        _ => (0, "write a value, * for any, or unset, n/a or unclear"),
    };
    QueryError::new(cursor.next(count), "a value should stand here", remedy)
}

/// Reads a bare or quoted word that is not empty.
pub(super) fn filled_word(cursor: &mut Cursor<'_>) -> Result<Word, QueryError> {
    filled(cursor, WordContext::Value)
}

fn filled(cursor: &mut Cursor<'_>, place: WordContext) -> Result<Word, QueryError> {
    let word = cursor.word(place)?;
    if word.at.start == word.at.end {
        return Err(missing_value(cursor));
    }
    if word
        .pattern
        .as_literal()
        .is_some_and(|text| text.trim().is_empty())
    {
        let remedy = "a field without a value is written =unset, =n/a or =unclear";
        return Err(QueryError::new(word.at, "this value is empty", remedy));
    }
    Ok(word)
}

/// The most values in a sequence such as `a > b > c`.
const MOST_STEPS: usize = 6;

/// Reads one value of a component, or a sequence of several: `head > chest`.
pub(super) fn path(cursor: &mut Cursor<'_>) -> Result<Value, QueryError> {
    const REMEDY: &str =
        "write for example placement=head > chest, placement=head > * or * > chest";
    let first = one(cursor, WordContext::Step)?;
    let start = first.at.start;
    let mut steps = vec![first];
    loop {
        let mut ahead = cursor.clone();
        ahead.skip_blanks();
        if !ahead.eat('>') {
            break;
        }
        ahead.skip_blanks();
        *cursor = ahead;
        steps.push(one(cursor, WordContext::Step)?);
    }
    if steps.len() > MOST_STEPS {
        let message = format!("more than {MOST_STEPS} values follow each other here");
        return Err(QueryError::new(cursor.at(start), message, REMEDY));
    }
    if steps.len() > 1 {
        for step in &steps {
            if matches!(step.wanted, Wanted::Missing(_)) {
                let message = "nothing begins or goes on where no value is";
                return Err(QueryError::new(step.at, message, REMEDY));
            }
        }
        return Ok(Value {
            at: cursor.at(start),
            wanted: Wanted::Steps(steps),
        });
    }
    Ok(steps.remove(0))
}

/// Reads one value of a field.
pub(super) fn value(cursor: &mut Cursor<'_>) -> Result<Value, QueryError> {
    one(cursor, WordContext::Value)
}

fn one(cursor: &mut Cursor<'_>, place: WordContext) -> Result<Value, QueryError> {
    if cursor.peek() == Some('[') {
        return features(cursor);
    }
    let word = filled(cursor, place)?;
    let missing = word
        .pattern
        .as_literal()
        .filter(|_| !word.quoted)
        .and_then(words::missing);
    let wanted = match missing {
        Some(missing) => Wanted::Missing(missing),
        None if word.pattern.matches_everything() => Wanted::Present,
        None => Wanted::Named(word.pattern),
    };
    Ok(Value {
        at: word.at,
        wanted,
    })
}

/// Reads `[index -thumb]`.
fn features(cursor: &mut Cursor<'_>) -> Result<Value, QueryError> {
    let open = cursor.next(1);
    cursor.pos = open.end;
    let mut found = Vec::new();
    let mut not: Option<At> = None;
    loop {
        while cursor.peek().is_some_and(|c| c.is_whitespace() || c == ',') {
            cursor.pos += 1;
        }
        match cursor.peek() {
            None => {
                let remedy = "write ] after the last feature";
                return Err(QueryError::new(open, "this bracket is not closed", remedy));
            }
            Some(']') => break,
            Some(_) => {}
        }
        let feature = feature(cursor)?;
        if feature.name == "not" && !feature.absent && not.is_none() {
            not = Some(feature.at);
        } else if let Some(at) = not.take() {
            found.push(Feature {
                at: at.to(feature.at),
                absent: !feature.absent,
                ..feature
            });
        } else {
            found.push(feature);
        }
    }
    cursor.pos += 1;
    let at = cursor.at(open.start);
    if found.is_empty() || not.is_some() {
        let remedy = "write for example configuration=[index middle -thumb]";
        return Err(QueryError::new(
            at,
            "a feature is missing between the brackets",
            remedy,
        ));
    }
    Ok(Value {
        at,
        wanted: Wanted::Features(found),
    })
}

fn feature(cursor: &mut Cursor<'_>) -> Result<Feature, QueryError> {
    let start = cursor.pos;
    let absent = matches!(cursor.peek(), Some('-' | '−' | '–'));
    cursor.pos += usize::from(absent);
    if !absent {
        cursor.eat('+');
    }
    let name_start = cursor.pos;
    while cursor.peek().is_some_and(is_feature_char) {
        cursor.pos += 1;
    }
    let name = cursor.text(cursor.at(name_start));
    if name.is_empty() || name.starts_with(['-', '−', '–', '+']) {
        let remedy = "features are names between blanks, those that must be absent with a minus: [index -thumb]";
        return Err(QueryError::new(
            cursor.next(1),
            "this is no feature",
            remedy,
        ));
    }
    Ok(Feature {
        at: cursor.at(start),
        name,
        absent,
    })
}

/// Returns whether a feature's name may hold this character.
pub(super) fn is_feature_char(c: char) -> bool {
    !c.is_whitespace() && !lex::is_quote(c) && !matches!(c, ',' | '[' | ']' | '(' | ')' | '*')
}
