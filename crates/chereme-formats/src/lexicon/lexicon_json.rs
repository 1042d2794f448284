//! Lexicons as JSON: the same rows and columns in another format.

use crate::hns::holds_symbols;
use crate::table::{MAX_PADDED_CELLS, MAX_TABLE_COLUMNS, TableCells, TableError, TableRow};
use serde_json::{Map, Value};
use std::borrow::Cow;

/// The most bytes of JSON that are read; in memory they take many times as much.
const MAX_JSON_BYTES: usize = 64 << 20;
/// The title of the column for the keys of an object.
const KEY_COLUMN_TITLE: &str = "gloss";
/// The title of the column for a text that is a whole sign.
const TEXT_COLUMN_TITLE: &str = "hamnosys";

/// An object of a lexicon, which is a row of its table.
#[derive(Default)]
struct JsonLexiconEntry {
    /// The gloss, if it is the key of the object.
    key: Option<String>,
    /// The line on which the object begins, if it is known.
    line: Option<u64>,
    object: Map<String, Value>,
}

/// Returns the table that JSON holds: an array of objects, an object of texts or objects by gloss, or JSON Lines of
/// objects.
///
/// Rows are objects and columns their keys, in order of appearance; values other than text are kept as
/// JSON. `None` for bytes that are not JSON, JSON of another shape, or more columns than any table needs.
///
/// # Errors
/// [`TableError::JsonLines`] if a complete JSON value is followed by something that belongs in no JSON Lines.
pub(super) fn read_json_cells(bytes: &[u8]) -> Result<Option<TableCells>, TableError> {
    let Ok(text) = str::from_utf8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)) else {
        return Ok(None);
    };
    if bytes.len() > MAX_JSON_BYTES || !text.trim_start().starts_with(['{', '[']) {
        return Ok(None);
    }
    let rows: Option<Vec<JsonLexiconEntry>> = match serde_json::from_str(text) {
        Ok(Value::Array(all)) => all.into_iter().map(|row| json_lexicon_entry(None, row)).collect(),
        Ok(Value::Object(object)) if is_entry(&object) => Some(vec![JsonLexiconEntry {
            object,
            ..JsonLexiconEntry::default()
        }]),
        Ok(Value::Object(all)) => all
            .into_iter()
            .map(|(key, row)| json_lexicon_entry(Some(key), row))
            .collect(),
        Ok(_) => None,
        Err(_) => json_lines(text)?,
    };
    Ok(rows.and_then(|rows| cells_from_entries(text, rows)))
}

/// Reads JSON Lines: objects after one another. `None` if not even the first value is complete.
fn json_lines(text: &str) -> Result<Option<Vec<JsonLexiconEntry>>, TableError> {
    let mut values = serde_json::Deserializer::from_str(text).into_iter::<Value>();
    let mut rows = Vec::new();
    let (mut counted, mut line) = (0, 1);
    loop {
        let rest = &text[values.byte_offset()..];
        let start = text.len() - rest.trim_start().len();
        line += memchr::memchr_iter(b'\n', &text.as_bytes()[counted..start]).count() as u64;
        counted = start;
        match values.next() {
            None => return Ok(Some(rows)),
            Some(Ok(Value::Object(object))) => rows.push(JsonLexiconEntry {
                key: None,
                line: Some(line),
                object,
            }),
            Some(Ok(_)) => {
                let before = text[..start].rsplit('\n').next().unwrap_or_default();
                return Err(TableError::JsonLines {
                    line,
                    column: before.chars().count() as u64 + 1,
                    what: "no object begins here".to_owned(),
                });
            }
            Some(Err(_)) if rows.is_empty() => return Ok(None),
            Some(Err(error)) => {
                return Err(TableError::JsonLines {
                    line: error.line() as u64,
                    column: error.column() as u64,
                    what: error.to_string(),
                });
            }
        }
    }
}

/// Returns whether an object is one entry, as in JSON Lines of one line, rather than entries by gloss.
fn is_entry(object: &Map<String, Value>) -> bool {
    let gloss = object.get(KEY_COLUMN_TITLE).and_then(Value::as_str);
    gloss.is_some_and(|gloss| !holds_symbols(gloss))
}

/// Returns rows as a table.
fn cells_from_entries(text: &str, rows: Vec<JsonLexiconEntry>) -> Option<TableCells> {
    let mut header: Vec<String> = Vec::new();
    let keyed = rows.iter().any(|row| row.key.is_some());
    if keyed && !rows.iter().any(|row| row.object.contains_key(KEY_COLUMN_TITLE)) {
        header.push(KEY_COLUMN_TITLE.to_owned());
    }
    for title in rows.iter().flat_map(|row| row.object.keys()) {
        if !header.contains(title) {
            header.push(title.clone());
        }
        if header.len() > MAX_TABLE_COLUMNS {
            return None;
        }
    }
    let filled_count: usize = rows.iter().map(|row| row.object.len()).sum();
    if rows.len().saturating_mul(header.len()) > filled_count.saturating_add(MAX_PADDED_CELLS) {
        return None;
    }
    let mut lines = JsonLineFinder { text, at: 0, line: 1 };
    let rows = rows.into_iter().map(|entry| {
        let JsonLexiconEntry { key, line, mut object } = entry;
        if let Some(key) = &key {
            object.entry(KEY_COLUMN_TITLE).or_insert_with(|| key.as_str().into());
        }
        let cells: Vec<String> = (header.iter().map(|title| json_cell_text(object.get(title)))).collect();
        let row_key = key.as_ref().or_else(|| cells.iter().find(|cell| !cell.is_empty()));
        let line = line.unwrap_or_else(|| lines.line_of_text(row_key.map_or("", String::as_str)));
        TableRow { line, cells }
    });
    Some(TableCells {
        header_line: 1,
        rows: rows.collect(),
        header,
        delimiter: b',',
    })
}

/// Returns the row for a value; `None` unless it is an object or a text.
fn json_lexicon_entry(key: Option<String>, value: Value) -> Option<JsonLexiconEntry> {
    let object = match value {
        Value::Object(object) => object,
        Value::String(text) => Map::from_iter([(TEXT_COLUMN_TITLE.to_owned(), text.into())]),
        _ => return None,
    };
    Some(JsonLexiconEntry {
        key,
        line: None,
        object,
    })
}

pub(super) fn json_cell_text(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string(),
    }
}

/// Finds the lines of successive texts.
struct JsonLineFinder<'t> {
    text: &'t str,
    at: usize,
    line: u64,
}

impl JsonLineFinder<'_> {
    /// Returns the line of the next occurrence of `text` in the JSON; the previous line if the text does not occur.
    fn line_of_text(&mut self, text: &str) -> u64 {
        let quoted = serde_json::to_string(text).map_or(Cow::Borrowed(text), Cow::Owned);
        if let Some(found) = self.text[self.at..].find(&*quoted) {
            let passed = &self.text.as_bytes()[self.at..self.at + found];
            self.line += memchr::memchr_iter(b'\n', passed).count() as u64;
            self.at += found + quoted.len();
        }
        self.line
    }
}

#[cfg(test)]
mod tests {
    use crate::lexicon;
    use crate::roles::TierMapping;
    use crate::table::TableError;

    #[test]
    fn json_lines_are_entries_or_refused_with_their_place() {
        let good = [
            "{\"gloss\": \"A\", \"Handshape\": \"U\"}\n{\"gloss\": \"B\", \"Handshape\": \"U\"}\n",
            "\u{feff}{\"gloss\": \"A\"}\r\n{\"n\": 1, \"gloss\": \"B\"}",
            "[{\"gloss\": \"A\"},\n{\"gloss\": \"B\"}]",
        ];
        for text in good {
            let read = lexicon::read_json(text.as_bytes(), &TierMapping::default());
            let (lexicon, _) = read.expect(text).expect("JSON");
            let entries: Vec<(&str, u64)> = (lexicon.entries.iter())
                .map(|it| (it.gloss.as_str(), it.line))
                .collect();
            assert_eq!(entries, [("A", 1), ("B", 2)], "{text}");
        }
        let one = lexicon::read_json(b"{\"gloss\": \"A\", \"Handshape\": \"U\"}", &TierMapping::default());
        let (one, _) = one.expect("read").expect("JSON");
        assert_eq!((one.entries.len(), one.entries[0].codings.len()), (1, 1));
        for (text, place) in [
            ("[\"A\", \"U\"]\n[\"B\", \"S\"]\n", (1, 1)),
            ("{\"gloss\": \"A\"}\n\n  [\"B\"]\n", (3, 3)),
            ("{\"gloss\": \"A\"}\n{\"gloss\": \"B\",}\n", (2, 15)),
            ("{\"gloss\": \"A\"}\n{\"gloss\": \"B\"", (2, 13)),
            ("{\"gloss\": \"A\"}\nB\n", (2, 1)),
        ] {
            match lexicon::read_json(text.as_bytes(), &TierMapping::default()) {
                Err(TableError::JsonLines { line, column, .. }) => {
                    assert_eq!((line, column), place, "{text}");
                }
                other => panic!("{text}: {other:?}"),
            }
        }
        for text in [
            "{\"gloss\": ",
            "gloss,Handshape\nA,U\n",
            "[1, 2]",
            "",
            "[gloss],x\nA,B\n",
        ] {
            let read = lexicon::read_json(text.as_bytes(), &TierMapping::default());
            assert_eq!(read, Ok(None), "{text}");
        }
    }
}
