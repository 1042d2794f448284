//! Tables as people save them: titles, and rows with their lines.

use std::collections::BTreeSet;

use super::fits::shorten_message_text;
use crate::error::{CorpusError, CorpusResult};

/// The largest number of rows, of columns, and of cells.
const MAX_TEXT_TABLE_ROWS: usize = 1_000_000;
const MAX_TEXT_TABLE_COLUMNS: usize = 1000;
const MAX_TEXT_TABLE_CELLS: usize = 10_000_000;

/// A table of text.
pub(super) struct TextTable {
    /// The titles of the columns.
    pub(super) titles: Vec<String>,
    /// The rows that are not empty, each with its line, from 1; at most as many cells as there are titles.
    pub(super) rows: Vec<(u64, Vec<String>)>,
}

/// Reads a table with a row of titles; commas, semicolons or tabs separate its cells.
pub(super) fn read_text_table(text: &str, file: &str) -> CorpusResult<TextTable> {
    let text = text.trim_start_matches('\u{feff}');
    let first = text.lines().next().unwrap_or_default();
    let separators = [b',', b';', b'\t'];
    let count = |byte: &u8| first.bytes().filter(|other| other == byte).count();
    let separator = separators.into_iter().max_by_key(count).unwrap_or(b',');
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .flexible(true)
        .from_reader(text.as_bytes());
    let fault = |error: csv::Error| {
        let line = error.position().map_or(1, csv::Position::line);
        CorpusError::from_wrong_message(format!("the table cannot be read: {error}"))
            .with_error_place(format!("{file}, line {line}"))
    };
    let titles = reader.headers().map_err(fault)?;
    if titles.len() > MAX_TEXT_TABLE_COLUMNS {
        let message = format!("the table has more than {MAX_TEXT_TABLE_COLUMNS} columns");
        return Err(CorpusError::from_wrong_message(message).with_error_place(file));
    }
    let titles: Vec<String> = titles.iter().map(|title| title.trim().to_owned()).collect();
    let mut seen = BTreeSet::new();
    let twice = titles.iter().find(|title| !title.is_empty() && !seen.insert(*title));
    if let Some(title) = twice {
        let message = format!("the table has two columns {:?}", shorten_message_text(title));
        return Err(CorpusError::from_wrong_message(message)
            .with_error_place(file)
            .with_advice("give each column a title of its own"));
    }
    let mut rows = Vec::new();
    let mut cell_count = 0;
    let (mut line, mut counted) = (1, 0);
    for record in reader.records() {
        let record = record.map_err(fault)?;
        // A record's own line is that before its line feed, if a carriage return precedes that.
        let start = record.position().map_or(0, |position| position.byte() as usize);
        let blank = text.as_bytes()[start..].iter();
        let start = start + blank.take_while(|byte| b"\r\n".contains(byte)).count();
        let passed = &text.as_bytes()[counted..start];
        line += passed.iter().filter(|byte| **byte == b'\n').count() as u64;
        counted = start;
        let cells: Vec<String> = record.iter().map(str::to_owned).collect();
        if cells.iter().all(|cell| cell.trim().is_empty()) {
            continue;
        }
        if cells.len() > titles.len() {
            let message = format!(
                "the row has {} cells, and there are {} titles",
                cells.len(),
                titles.len()
            );
            return Err(CorpusError::from_wrong_message(message)
                .with_error_place(format!("{file}, line {line}"))
                .with_advice("put a cell that holds the separator into double quotes"));
        }
        if rows.len() == MAX_TEXT_TABLE_ROWS {
            return Err(
                CorpusError::from_wrong_message(format!("the table has more than {MAX_TEXT_TABLE_ROWS} rows"))
                    .with_error_place(file),
            );
        }
        cell_count += cells.len();
        if cell_count > MAX_TEXT_TABLE_CELLS {
            let message = format!("the table has more than {MAX_TEXT_TABLE_CELLS} cells");
            return Err(CorpusError::from_wrong_message(message).with_error_place(file));
        }
        rows.push((line, cells));
    }
    Ok(TextTable { titles, rows })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_rows_take_no_room_and_odd_titles_are_refused() {
        let read = read_text_table("a,b,c\nx\ny,z\n", "t.csv").expect("read");
        let lengths: Vec<usize> = read.rows.iter().map(|(_, cells)| cells.len()).collect();
        assert_eq!(lengths, [1, 2]);
        for (text, message) in [
            (",".repeat(5000), "the table has more than 1000 columns"),
            ("a,b,a\n1,2,3\n".to_owned(), "the table has two columns \"a\""),
        ] {
            let error = read_text_table(&text, "t.csv").err().expect("refused");
            assert!(error.to_string().contains(message), "{error}");
        }
    }
}
