//! Reading times: `0.8s`, `0.5s..1s`.

use super::QueryError;
use super::query_compare::operator_place;
use super::query_lex::QueryCursor;
use super::query_tree::{QueryPlace, TimeField, TimeTest};
use super::query_words;
use crate::text::nearest_candidate;

/// Reads the operator and the time after the name of a time.
pub(super) fn time_test(cursor: &mut QueryCursor<'_>, field: TimeField) -> Result<TimeTest, QueryError> {
    let operator_at = operator_place(cursor);
    let operator = cursor.text_at_place(operator_at);
    cursor.skip_blanks();
    let value_start = cursor.pos;
    match &operator[..] {
        "<" => Ok(TimeTest::Below(parse_unit_time(cursor)?)),
        "<=" | "=<" | "≤" => Ok(TimeTest::AtMost(parse_unit_time(cursor)?)),
        ">" => Ok(TimeTest::Above(parse_unit_time(cursor)?)),
        ">=" | "=>" | "≥" => Ok(TimeTest::AtLeast(parse_unit_time(cursor)?)),
        "=" | "==" => parse_time_bounds(cursor, value_start),
        _ => {
            let name = field.time_field_name();
            let message = format!("`{operator}` does not compare times");
            let remedy = format!("write {name}<0.8s, {name}>=1s or {name}=0.5s..1s; `not` before it for the opposite");
            Err(QueryError::new(operator_at, message, remedy).with_suggestion((operator == ":").then_some("=")))
        }
    }
}

/// Reads `0.5s`, `0.5s..1s`, `0.5s..` or `..1s`.
fn parse_time_bounds(cursor: &mut QueryCursor<'_>, start: usize) -> Result<TimeTest, QueryError> {
    let range_at = cursor.skip_text_chunk();
    let text = cursor.text_at_place(range_at);
    cursor.pos = start;
    let Some((from, to)) = text.split_once("..") else {
        let time = parse_unit_time(cursor)?;
        return Ok(TimeTest::Between(time, time));
    };
    cursor.pos = range_at.end;
    let to_start = range_at.end - to.chars().count();
    let from_at = QueryPlace {
        start,
        end: to_start - 2,
    };
    // `0.5..1s` counts both ends in seconds.
    let unit: String = to.chars().skip_while(|c| !c.is_alphabetic() && *c != 'µ').collect();
    let needs_unit = !unit.is_empty() && from.ends_with(|c: char| c.is_ascii_digit());
    let from = if needs_unit {
        format!("{from}{unit}")
    } else {
        from.to_owned()
    };
    let to_at = QueryPlace {
        start: to_start,
        end: range_at.end,
    };
    match (&from[..], to) {
        ("", "") => Err(missing_time(range_at)),
        ("", to) => Ok(TimeTest::AtMost(parse_time(to, to_at)?)),
        (from, "") => Ok(TimeTest::AtLeast(parse_time(from, from_at)?)),
        (from, to) => match (parse_time(from, from_at)?, parse_time(to, to_at)?) {
            (least, most) if least <= most => Ok(TimeTest::Between(least, most)),
            _ => Err(QueryError::new(
                range_at,
                "this range ends before it starts",
                "the shorter time stands first",
            )
            .with_suggestion(Some(format!("{to}..{from}")))),
        },
    }
}

fn missing_time(at: QueryPlace) -> QueryError {
    QueryError::new(
        at,
        "a time should stand here",
        "write a number with its unit: 0.8s, 800ms or 2min",
    )
}

/// Reads a time with its unit, in microseconds; one blank may stand before the unit.
pub(super) fn parse_unit_time(cursor: &mut QueryCursor<'_>) -> Result<i64, QueryError> {
    let mut time_at = cursor.skip_text_chunk();
    let mut text = cursor.text_at_place(time_at);
    if text.is_empty() {
        return Err(missing_time(time_at));
    }
    if text.contains("..") {
        let remedy = "a range stands after =, as in duration=0.5s..1s";
        return Err(QueryError::new(time_at, "one time should stand here", remedy));
    }
    if text.ends_with(|c: char| c.is_ascii_digit()) {
        let mut ahead = cursor.clone();
        ahead.skip_blanks();
        let unit_at = ahead.skip_text_chunk();
        let unit = ahead.text_at_place(unit_at);
        if query_words::TIME_UNITS.iter().any(|(name, _)| *name == unit) {
            *cursor = ahead;
            time_at = time_at.extend_place_to(unit_at);
            text.push_str(&unit);
        }
    }
    parse_time(&text, time_at)
}

fn parse_time(text: &str, at: QueryPlace) -> Result<i64, QueryError> {
    const PARSE_TIME_REMEDY: &str = "times are counted in s, ms or min";
    let digits = text
        .chars()
        .take_while(|c| c.is_ascii_digit() || *c == '.' || *c == ',')
        .count();
    let (number, unit) = text.split_at(digits);
    let (whole, part) = number.split_once(['.', ',']).unwrap_or((number, ""));
    let numeral = |text: &str| text.chars().all(|c| c.is_ascii_digit());
    if !numeral(whole) || !numeral(part) || whole.len() + part.len() == 0 {
        let message = format!("{text:?} is no time");
        return Err(QueryError::new(
            at,
            message,
            "write a number with its unit: 0.8s, 800ms or 2min",
        ));
    }
    if unit.is_empty() {
        let message = format!("{text:?} has no unit");
        // No sign lasts so many seconds.
        let long = whole.len() > 2;
        let unit = if long { "ms" } else { "s" };
        return Err(QueryError::new(at, message, PARSE_TIME_REMEDY).with_suggestion(Some(format!("{text}{unit}"))));
    }
    let Some((_, micros)) = query_words::TIME_UNITS.iter().find(|(name, _)| *name == unit) else {
        let unit_at = QueryPlace {
            start: at.end - unit.chars().count(),
            end: at.end,
        };
        let near = nearest_candidate(unit, query_words::TIME_UNITS.iter().map(|(name, _)| *name));
        return Err(
            QueryError::new(unit_at, format!("there is no unit of time {unit:?}"), PARSE_TIME_REMEDY)
                .with_suggestion(near),
        );
    };
    if whole.len() > 9 {
        return Err(QueryError::new(
            at,
            "this time is too long",
            "recordings last hours, not years",
        ));
    }
    // At most nine digits of either part fit, times sixty million, with room to spare.
    let part = &part[..part.len().min(9)];
    let value = |digits: &str| {
        digits
            .bytes()
            .fold(0, |value, digit| value * 10 + i64::from(digit - b'0'))
    };
    let scale = 10_i64.pow(part.len() as u32);
    Ok(value(whole) * micros + (value(part) * micros + scale / 2) / scale)
}
