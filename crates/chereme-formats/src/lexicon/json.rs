//! Lexicons as JSON: the same rows and columns in another format.

use crate::table::{COLUMNS, Cells, PADDED, Row};
use serde_json::{Map, Value};
use std::borrow::Cow;

/// The most bytes of JSON that are read; in memory they take many times as much.
const BYTES: usize = 64 << 20;
/// The title of the column for the keys of an object.
const KEY: &str = "gloss";
/// The title of the column for a text that is a whole sign.
const TEXT: &str = "hamnosys";

/// Returns the table that JSON holds: an array of objects, or an object of texts or objects by gloss.
///
/// Rows are objects and columns their keys, in order of appearance; values other than text are kept as
/// JSON. `None` for bytes that are not JSON, JSON of another shape, or more columns than any table needs.
pub(super) fn read(bytes: &[u8]) -> Option<Cells> {
    let text = str::from_utf8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)).ok()?;
    if bytes.len() > BYTES || !text.trim_start().starts_with(['{', '[']) {
        return None;
    }
    let rows: Vec<(Option<String>, Map<String, Value>)> = match serde_json::from_str(text).ok()? {
        Value::Array(all) => all
            .into_iter()
            .map(|row| Some((None, object(row)?)))
            .collect(),
        Value::Object(all) => all
            .into_iter()
            .map(|(key, row)| Some((Some(key), object(row)?)))
            .collect(),
        _ => None,
    }?;
    let mut header: Vec<String> = Vec::new();
    let keyed = rows.iter().any(|(key, _)| key.is_some());
    if keyed && !rows.iter().any(|(_, row)| row.contains_key(KEY)) {
        header.push(KEY.to_owned());
    }
    for title in rows.iter().flat_map(|(_, row)| row.keys()) {
        if !header.contains(title) {
            header.push(title.clone());
        }
        if header.len() > COLUMNS {
            return None;
        }
    }
    let held: usize = rows.iter().map(|(_, row)| row.len()).sum();
    if rows.len().saturating_mul(header.len()) > held.saturating_add(PADDED) {
        return None;
    }
    let mut lines = Lines {
        text,
        at: 0,
        line: 1,
    };
    let rows = rows.into_iter().map(|(key, mut row)| {
        if let Some(key) = &key {
            row.entry(KEY).or_insert_with(|| key.as_str().into());
        }
        let cells: Vec<String> = header.iter().map(|title| cell(row.get(title))).collect();
        let known = key
            .as_ref()
            .or_else(|| cells.iter().find(|cell| !cell.is_empty()));
        let line = lines.of(known.map_or("", String::as_str));
        Row { line, cells }
    });
    Some(Cells {
        rows: rows.collect(),
        header,
        delimiter: b',',
    })
}

fn object(value: Value) -> Option<Map<String, Value>> {
    match value {
        Value::Object(object) => Some(object),
        Value::String(text) => Some(Map::from_iter([(TEXT.to_owned(), text.into())])),
        _ => None,
    }
}

pub(super) fn cell(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string(),
    }
}

/// Finds the lines of successive texts.
struct Lines<'t> {
    text: &'t str,
    at: usize,
    line: u64,
}

impl Lines<'_> {
    /// Returns the line of the next occurrence of `text` in the JSON; the previous line if the text does not occur.
    fn of(&mut self, text: &str) -> u64 {
        let quoted = serde_json::to_string(text).map_or(Cow::Borrowed(text), Cow::Owned);
        if let Some(found) = self.text[self.at..].find(&*quoted) {
            let passed = &self.text.as_bytes()[self.at..self.at + found];
            self.line += memchr::memchr_iter(b'\n', passed).count() as u64;
            self.at += found + quoted.len();
        }
        self.line
    }
}
