//! Messages about refused changes, with names of tiers and values of annotations instead of row numbers.

use std::fmt::Write;

use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::tier::{EditError, NamedAnnotation, TierViolation};
use rusqlite::Connection;

use super::{annotation_row_id, span_of};
use crate::db::stored_columns::ValueState;
use crate::db::stored_recordings;
use crate::db::stored_tiers::{self as rows, AnnotationRow, TierRow};
use crate::error::{CorpusError, CorpusResult};

/// The number of letters of a value that a message shows.
const MAX_MESSAGE_VALUE_CHARS: usize = 40;

/// Returns `message` with names in place of `tier:N` and `annotation:N` outside of quotes.
pub(crate) fn name_message_ids(connection: &Connection, message: &str) -> String {
    let mut text = String::with_capacity(message.len());
    let (mut quoted, mut rest) = (false, message);
    while let Some(first) = rest.chars().next() {
        let inside = text.ends_with(|c: char| c.is_alphanumeric());
        if !quoted && !inside {
            let name = read_kind_number(rest, "tier:")
                .and_then(|(id, length)| Some((tier_named(connection, id)?, length)))
                .or_else(|| {
                    let (id, length) = read_kind_number(rest, "annotation:")?;
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
fn read_kind_number(text: &str, kind: &str) -> Option<(i64, usize)> {
    let digits = text.strip_prefix(kind)?;
    let length = digits.bytes().take_while(u8::is_ascii_digit).count();
    let id = digits.get(..length)?.parse().ok()?;
    Some((id, kind.len() + length))
}

fn tier_named(connection: &Connection, id: i64) -> Option<String> {
    let row = rows::load_tier_row(connection, id).ok()?;
    Some(format!("the tier {:?}", row.name))
}

fn annotation_named(connection: &Connection, id: i64) -> Option<String> {
    if id > annotation_row_id(chereme_sign::tier::AnnotationId(super::FIRST_FRESH_HANDLE)) {
        return Some("the new annotation".to_owned());
    }
    let row = rows::load_annotation_row(connection, id).ok()?;
    let start_instant = RecordingInstant::from_micros(row.start_us);
    Some(format!("{} at {start_instant}", quoted_value(&row)))
}

/// Returns an annotation as text, for a list of possible ones.
pub(super) fn describe_annotation_candidate(connection: &Connection, id: i64) -> String {
    match annotation_named(connection, id) {
        Some(name) => format!("annotation:{id} ({name})"),
        None => format!("annotation:{id}"),
    }
}

/// Returns the value of an annotation in quotes, or the reason for a missing one.
pub(crate) fn quoted_value(row: &AnnotationRow) -> String {
    if row.state != ValueState::Value {
        return format!("an annotation without a value ({})", row.state.value_state_name());
    }
    match row.value.char_indices().nth(MAX_MESSAGE_VALUE_CHARS) {
        Some((at, _)) => format!("{:?}", format!("{}…", &row.value[..at])),
        None => format!("{:?}", row.value),
    }
}

/// Returns the error for a refused change of a tier, with possible alternatives.
pub(super) fn refused_change_error(connection: &Connection, tier: i64, error: &EditError) -> CorpusResult<CorpusError> {
    let row = rows::load_tier_row(connection, tier)?;
    let recording = stored_recordings::load_recording_row(connection, row.recording_id)?;
    let place = format!("{:?} of {:?}", row.name, recording.name);
    let EditError::Breaks(TierViolation::Overlap {
        annotation,
        span,
        other,
        ..
    }) = error
    else {
        return Ok(
            CorpusError::from_wrong_message(name_message_ids(connection, &error.to_string())).with_error_place(place),
        );
    };
    let other = rows::load_annotation_row(connection, annotation_row_id(*other))?;
    let what = match annotation {
        NamedAnnotation(Some(id)) if id.0 < super::FIRST_FRESH_HANDLE => {
            quoted_value(&rows::load_annotation_row(connection, annotation_row_id(*id))?)
        }
        _ => "a new annotation".to_owned(),
    };
    let there = span_of(&other);
    let message = format!(
        "{what} from {} to {} overlaps {} ({} to {}) on the tier {:?} of {:?}",
        span.span_start_instant(),
        span.span_end_instant(),
        quoted_value(&other),
        there.span_start_instant(),
        there.span_end_instant(),
        row.name,
        recording.name
    );
    let moves = stored_recordings::body_track(connection, recording.id)?.is_some();
    let length = moves.then_some(recording.duration_us);
    let free = free_near(connection, &row, &other, length)?;
    let remedy = if free.is_empty() {
        "no time next to it is free: move or shorten the other one first".to_owned()
    } else {
        format!("free next to it: {}", free.join(", "))
    };
    Ok(CorpusError::from_wrong_message(message)
        .with_error_place(place)
        .with_advice(remedy))
}

/// Returns the free times nearest before and after an annotation of a tier.
fn free_near(
    connection: &Connection,
    tier: &TierRow,
    other: &AnnotationRow,
    length: Option<i64>,
) -> CorpusResult<Vec<String>> {
    let parent = match other.parent_id.filter(|_| tier.parent_id.is_some()) {
        Some(parent) => Some(span_of(&rows::load_annotation_row(connection, parent)?)),
        None => None,
    };
    let from = parent.map_or(0, |span| span.span_start_instant().instant_micros());
    let to = parent.map(|span| span.span_end_instant().instant_micros()).or(length);
    let all = rows::load_tier_annotation_rows(connection, tier.id)?;
    let within = |row: &&AnnotationRow| row.end_us > from && to.is_none_or(|to| row.start_us < to);
    let taken: Vec<TimeSpan> = all.iter().filter(within).map(span_of).collect();
    let micros = RecordingInstant::from_micros;
    let mut edge = micros(from);
    let (mut before, mut after) = (None, None);
    for span in &taken {
        let gap = (edge, Some(span.span_start_instant()));
        if edge < span.span_start_instant() {
            if span.span_start_instant().instant_micros() <= other.start_us {
                before = Some(gap);
            } else {
                after = after.or(Some(gap));
            }
        }
        edge = edge.max(span.span_end_instant());
    }
    if to.is_none_or(|to| edge.instant_micros() < to) {
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
        assert_eq!(read_kind_number("tier:12 x", "tier:"), Some((12, 7)));
        assert_eq!(read_kind_number("tier:x", "tier:"), None);
        assert_eq!(read_kind_number("annotation:7", "tier:"), None);
    }
}
