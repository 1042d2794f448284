//! Messages about refused changes, with names of tiers and values of annotations instead of row numbers.

use std::fmt::Write;

use chereme_motion::{Instant, Span};
use chereme_sign::tier::{EditError, Named, Violation};
use rusqlite::Connection;

use super::{signed, span_of};
use crate::db::columns::ValueState;
use crate::db::recordings;
use crate::db::tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{Error, Result};

/// The number of letters of a value that a message shows.
const SHOWN: usize = 40;

/// Returns `message` with names in place of `tier:N` and `annotation:N` outside of quotes.
pub(crate) fn named(connection: &Connection, message: &str) -> String {
    let mut text = String::with_capacity(message.len());
    let (mut quoted, mut rest) = (false, message);
    while let Some(first) = rest.chars().next() {
        let inside = text.ends_with(|c: char| c.is_alphanumeric());
        if !quoted && !inside {
            let name = number(rest, "tier:")
                .and_then(|(id, length)| Some((tier_named(connection, id)?, length)))
                .or_else(|| {
                    let (id, length) = number(rest, "annotation:")?;
                    Some((annotation_named(connection, id)?, length))
                });
            if let Some((name, length)) = name {
                text.push_str(&name);
                rest = &rest[length..];
                continue;
            }
        }
        quoted ^= first == '"';
        text.push(first);
        rest = &rest[first.len_utf8()..];
    }
    text
}

/// Reads `KIND:12` at the start of a text, and returns the number and its length.
fn number(text: &str, kind: &str) -> Option<(i64, usize)> {
    let digits = text.strip_prefix(kind)?;
    let length = digits.bytes().take_while(u8::is_ascii_digit).count();
    let id = digits.get(..length)?.parse().ok()?;
    Some((id, kind.len() + length))
}

fn tier_named(connection: &Connection, id: i64) -> Option<String> {
    let row = rows::tier(connection, id).ok()?;
    Some(format!("the tier {:?}", row.name))
}

fn annotation_named(connection: &Connection, id: i64) -> Option<String> {
    if id > signed(chereme_sign::tier::AnnotationId(super::FRESH)) {
        return Some("the new annotation".to_owned());
    }
    let row = rows::annotation(connection, id).ok()?;
    let at = Instant::from_micros(row.start_us);
    Some(format!("{} at {at}", quoted_value(&row)))
}

/// Returns an annotation as text, for a list of possible ones.
pub(super) fn candidate(connection: &Connection, id: i64) -> String {
    match annotation_named(connection, id) {
        Some(name) => format!("annotation:{id} ({name})"),
        None => format!("annotation:{id}"),
    }
}

/// Returns the value of an annotation in quotes, or the reason for a missing one.
pub(crate) fn quoted_value(row: &AnnotationRow) -> String {
    if row.state != ValueState::Value {
        return format!("an annotation without a value ({})", row.state.name());
    }
    match row.value.char_indices().nth(SHOWN) {
        Some((at, _)) => format!("{:?}", format!("{}…", &row.value[..at])),
        None => format!("{:?}", row.value),
    }
}

/// Returns the error for a refused change of a tier, with possible alternatives.
pub(super) fn refused(connection: &Connection, tier: i64, error: &EditError) -> Result<Error> {
    let row = rows::tier(connection, tier)?;
    let recording = recordings::recording(connection, row.recording_id)?;
    let place = format!("{:?} of {:?}", row.name, recording.name);
    let EditError::Breaks(Violation::Overlap {
        annotation,
        span,
        other,
        ..
    }) = error
    else {
        return Ok(Error::wrong(named(connection, &error.to_string())).at(place));
    };
    let other = rows::annotation(connection, signed(*other))?;
    let what = match annotation {
        Named(Some(id)) if id.0 < super::FRESH => {
            quoted_value(&rows::annotation(connection, signed(*id))?)
        }
        _ => "a new annotation".to_owned(),
    };
    let there = span_of(&other);
    let message = format!(
        "{what} from {} to {} overlaps {} ({} to {}) on the tier {:?} of {:?}",
        span.start(),
        span.end(),
        quoted_value(&other),
        there.start(),
        there.end(),
        row.name,
        recording.name
    );
    let moves = recordings::body_track(connection, recording.id)?.is_some();
    let length = moves.then_some(recording.duration_us);
    let free = free_near(connection, &row, &other, length)?;
    let remedy = if free.is_empty() {
        "no time next to it is free: move or shorten the other one first".to_owned()
    } else {
        format!("free next to it: {}", free.join(", "))
    };
    Ok(Error::wrong(message).at(place).advise(remedy))
}

/// Returns the free times nearest before and after an annotation of a tier.
fn free_near(
    connection: &Connection,
    tier: &TierRow,
    other: &AnnotationRow,
    length: Option<i64>,
) -> Result<Vec<String>> {
    let parent = match other.parent_id.filter(|_| tier.parent_id.is_some()) {
        Some(parent) => Some(span_of(&rows::annotation(connection, parent)?)),
        None => None,
    };
    let from = parent.map_or(0, |span| span.start().micros());
    let to = parent.map(|span| span.end().micros()).or(length);
    let all = rows::annotations(connection, tier.id)?;
    let within = |row: &&AnnotationRow| row.end_us > from && to.is_none_or(|to| row.start_us < to);
    let taken: Vec<Span> = all.iter().filter(within).map(span_of).collect();
    let micros = Instant::from_micros;
    let mut edge = micros(from);
    let (mut before, mut after) = (None, None);
    for span in &taken {
        let gap = (edge, Some(span.start()));
        if edge < span.start() {
            if span.start().micros() <= other.start_us {
                before = Some(gap);
            } else {
                after = after.or(Some(gap));
            }
        }
        edge = edge.max(span.end());
    }
    if to.is_none_or(|to| edge.micros() < to) {
        after = after.or(Some((edge, to.map(micros))));
    }
    let mut free = Vec::new();
    for (start, end) in before.into_iter().chain(after) {
        let mut text = format!("{start} ");
        let _ = match end {
            Some(end) => write!(text, "to {end}"),
            None => write!(text, "and later"),
        };
        free.push(text);
    }
    Ok(free)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_only_after_their_kind() {
        assert_eq!(number("tier:12 x", "tier:"), Some((12, 7)));
        assert_eq!(number("tier:x", "tier:"), None);
        assert_eq!(number("annotation:7", "tier:"), None);
    }
}
