//! Names of tiers and annotations in messages, in place of the numbers of their rows.

use chereme_motion::RecordingInstant;
use rusqlite::Connection;

use crate::db::stored_columns::ValueState;
use crate::db::stored_tiers::{self as rows, AnnotationRow};

/// The first handle for annotations that have no row yet.
pub(crate) const FIRST_FRESH_HANDLE: u64 = 1 << 62;

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

pub(crate) fn annotation_named(connection: &Connection, id: i64) -> Option<String> {
    if id > FIRST_FRESH_HANDLE as i64 {
        return Some("the new annotation".to_owned());
    }
    let row = rows::load_annotation_row(connection, id).ok()?;
    let start_instant = RecordingInstant::from_micros(row.start_us);
    Some(format!("{} at {start_instant}", quoted_value(&row)))
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
