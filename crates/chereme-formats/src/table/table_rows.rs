//! Splits text at delimiters and line ends into cells, and writes cells that read back unchanged.

use std::borrow::Cow;

use super::table_cells::TableRow;
use crate::tally::FindingTally;

/// Returns the cells of every line between tabs, with the number of the line, counted from 1; lines of blanks are left
/// out.
///
/// A cell in quotation marks may hold tabs and line ends. A mark that does not close before a tab or line end is part
/// of its cell, and so are marks that no spreadsheet would have written.
///
/// ```
/// use chereme_formats::table::tab_rows;
///
/// let rows = tab_rows("G\t\"say \"\"a\"\"\"\nG\t\"open\nG\t\"Aha!\"\n");
/// let values: Vec<&str> = rows.iter().map(|(_, cells)| &*cells[1]).collect();
/// assert_eq!(values, ["say \"a\"", "\"open", "\"Aha!\""]);
/// ```
#[must_use]
pub fn tab_rows(text: &str) -> Vec<(u64, Vec<String>)> {
    let all_rows = split_table_rows(text, b'\t', false, usize::MAX, &mut FindingTally::default()).into_iter();
    let rows = all_rows.filter(|row| row.cells.iter().any(|cell| !cell.trim().is_empty()));
    rows.map(|row| (row.line, row.cells)).collect()
}

/// Writes rows of cells with tabs between them, which [`tab_rows`] reads back unchanged.
///
/// If a cell holds a tab or line end, or begins with a quotation mark, all cells stand in quotation marks except for
/// numbers and times, as in ELAN's export to CSV.
#[must_use]
pub fn write_tab_rows<const COLUMN_COUNT: usize>(rows: &[[Cow<'_, str>; COLUMN_COUNT]]) -> String {
    let needs = |cell: &Cow<'_, str>| cell.starts_with('"') || cell.contains(['\t', '\n', '\r']);
    let quoted = rows.iter().flatten().any(needs);
    let mut text = String::new();
    for row in rows {
        for (at, cell) in row.iter().enumerate() {
            if at > 0 {
                text.push('\t');
            }
            // The first cell of a table shows whether its text is in quotation marks.
            if quoted && (at == 0 || !is_number(cell)) {
                text.push('"');
                text.push_str(&cell.replace('"', "\"\""));
                text.push('"');
            } else {
                text.push_str(cell);
            }
        }
        text.push('\n');
    }
    text
}

/// Reports whether a cell is empty, or a number or a time without a unit.
fn is_number(cell: &str) -> bool {
    let number = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'.' | b':' | b'-');
    cell.bytes().all(number)
}

/// Splits a text into rows; of a text that is `cut` somewhere, a row with a quotation mark that would close beyond
/// ends the table, unless it is the first. No more than `most` cells are read, and the rest of their row.
pub(super) fn split_table_rows(
    text: &str,
    delimiter: u8,
    cut: bool,
    most: usize,
    findings: &mut FindingTally,
) -> Vec<TableRow> {
    let bytes = text.as_bytes();
    // Programs that write tabs mostly write no quotation marks, which are then part of the text.
    let strict = delimiter == b'\t' && !has_quoted_text(text, delimiter);
    let mut rows: Vec<TableRow> = Vec::new();
    let (mut at, mut line, mut count) = (0, 1u64, 0);
    while let Some(&byte) = bytes.get(at) {
        if matches!(byte, b'\n' | b'\r') {
            line += u64::from(byte == b'\n');
            at += 1;
            continue;
        }
        let mut row = TableRow {
            line,
            cells: Vec::new(),
        };
        loop {
            let quoted = find_closing_quote(bytes, at, delimiter);
            if matches!(quoted, QuotedCellEnd::Never) && cut && !rows.is_empty() {
                return rows;
            }
            let place = (row.cells.len(), rows.first().map(|row| row.cells.len()));
            let open = match quoted {
                QuotedCellEnd::Until { end, .. } if strict && spans_rows(text, at..end, place) => None,
                QuotedCellEnd::Until { close, end } => {
                    let inside = &text[at + 1..close];
                    let marks = match strict {
                        true => QuotationMarkOrigin::detect_mark_origin(inside),
                        false => QuotationMarkOrigin::Needed,
                    };
                    (marks != QuotationMarkOrigin::Own).then_some((inside, close, end, marks))
                }
                _ => None,
            };
            let end = match open {
                Some((inside, close, end, marks)) => {
                    if marks == QuotationMarkOrigin::Doubtful {
                        findings.add_limited_note("cells in quotation marks", line, || {
                            format!("the quotation marks around {inside:?} were left out: a spreadsheet writes them")
                        });
                    }
                    line += memchr::memchr_iter(b'\n', inside.as_bytes()).count() as u64;
                    let blanks = &text[close + 1..end];
                    row.cells.push(inside.replace("\"\"", "\"") + blanks);
                    end
                }
                None => {
                    let ends = |byte: &u8| *byte == delimiter || matches!(byte, b'\n' | b'\r');
                    let length = bytes[at..].iter().position(ends);
                    let end = length.map_or(bytes.len(), |length| at + length);
                    let cell = &text[at..end];
                    if cell.starts_with('"') && (cell.len() == 1 || !cell.ends_with('"')) {
                        findings.add_limited_note("open quotation marks", line, || format!("the quotation mark before {:?} closes nowhere at the end of a cell; it was taken as text", text_beginning(&cell[1..])));
                    }
                    row.cells.push(cell.to_owned());
                    end
                }
            };
            at = end;
            if bytes.get(at) != Some(&delimiter) {
                break;
            }
            at += 1;
        }
        count += row.cells.len();
        rows.push(row);
        if count > most {
            break;
        }
    }
    rows
}

/// Returns the first letters of a text.
fn text_beginning(text: &str) -> &str {
    let end = text.char_indices().nth(20).map_or(text.len(), |(at, _)| at);
    &text[..end]
}

/// The end of a cell that may be in quotation marks.
enum QuotedCellEnd {
    /// It begins with no mark, or the next one is within its text.
    No,
    /// No mark closes it.
    Never,
    /// The closing mark, and the end of the cell after it.
    Until { close: usize, end: usize },
}

/// Finds the mark that closes a cell in quotation marks; two marks side by side are one of its text.
fn find_closing_quote(bytes: &[u8], at: usize, delimiter: u8) -> QuotedCellEnd {
    if bytes.get(at) != Some(&b'"') {
        return QuotedCellEnd::No;
    }
    let mut close = at + 1;
    loop {
        let Some(length) = memchr::memchr(b'"', &bytes[close..]) else {
            return QuotedCellEnd::Never;
        };
        close += length;
        if bytes.get(close + 1) != Some(&b'"') {
            break;
        }
        close += 2;
    }
    let rest = &bytes[close + 1..];
    // People write blanks after commas.
    let blank = |byte: &&u8| delimiter != b'\t' && **byte == b' ';
    let blanks = rest.iter().take_while(blank).count();
    match rest.get(blanks) {
        Some(&byte) if byte != delimiter && !matches!(byte, b'\n' | b'\r') => QuotedCellEnd::No,
        _ => QuotedCellEnd::Until {
            close,
            end: close + 1 + blanks,
        },
    }
}

/// Who wrote the quotation marks around a cell of a table whose other text has none.
#[derive(Clone, Copy, PartialEq, Eq)]
enum QuotationMarkOrigin {
    /// A program, since the cell would be another without them.
    Needed,
    /// A spreadsheet, which puts text with commas in marks, or a person.
    Doubtful,
    /// A person: they belong to the text.
    Own,
}

impl QuotationMarkOrigin {
    fn detect_mark_origin(inside: &str) -> Self {
        if inside.is_empty() || inside.contains(['\t', '\n', '\r', '"']) {
            Self::Needed
        } else if inside.contains(',') {
            Self::Doubtful
        } else {
            Self::Own
        }
    }
}

/// Reports whether a table puts all its text in quotation marks: its first cell that is no number shows it.
fn has_quoted_text(text: &str, delimiter: u8) -> bool {
    let text = text.trim_start_matches(['\n', '\r']);
    let first = text.split(['\n', '\r']).next().unwrap_or_default();
    let mut cell_start = 0;
    for cell in first.split(char::from(delimiter)) {
        if !is_number(cell) {
            return matches!(
                find_closing_quote(text.as_bytes(), cell_start, delimiter),
                QuotedCellEnd::Until { .. }
            );
        }
        cell_start += cell.len() + 1;
    }
    false
}

/// Reports whether text in quotation marks would span several rows: each of its lines has as many cells as a row. The
/// `place` is the number of cells before it, and that of the first row.
fn spans_rows(text: &str, cell: std::ops::Range<usize>, place: (usize, Option<usize>)) -> bool {
    let (before, width) = place;
    let tabs = |line: &str| memchr::memchr_iter(b'\t', line.as_bytes()).count();
    let rest = &text[cell.end..];
    let end = cell.end + rest.find(['\n', '\r']).unwrap_or(rest.len());
    let mut lines = text[cell.start..end].split('\n');
    let first = before + lines.next().map_or(0, tabs);
    let fits = match width {
        Some(width) => first + 1 == width,
        None => first >= 3,
    };
    let cell_text = &text[cell];
    let mut others = lines.filter(|line| !line.trim().is_empty()).peekable();
    cell_text.contains('\n') && fits && others.peek().is_some() && others.all(|line| tabs(line) == first)
}
