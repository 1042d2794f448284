//! Reads bytes as rows of cells: encodings, delimiters, quotes.

use crate::finding::ImportFinding;
use crate::tally::FindingTally;
use crate::windows_1252;
use std::borrow::Cow;

/// The most columns of a table.
pub(crate) const MAX_TABLE_COLUMNS: usize = 4096;
/// The most empty cells that are added to short rows of a table, in all.
pub(crate) const MAX_PADDED_CELLS: usize = 1 << 22;
/// The most cells of a table: with their rows in a corpus they stay below 1.5 GB of memory.
const MAX_TABLE_CELLS: usize = 4_000_000;
/// The most rows of a table.
const MAX_TABLE_ROWS: usize = 1_000_000;
/// The longest cell, in bytes.
const LONGEST_CELL: usize = 1 << 20;
/// A cell with more lines than this gets a warning: a closing quote may be missing.
const MAX_CELL_LINES: usize = 40;

/// The reason why bytes could not be read as a table.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// The file holds no rows.
    #[error("the table is empty; its first row should name the columns")]
    Empty,
    /// The file is not text.
    #[error("line {line}: this is not a table of text; save it as CSV or TSV in UTF-8")]
    NotText {
        /// The line, counted from 1.
        line: u64,
    },
    /// The first row has more columns than any table needs.
    #[error("the first row has {found} columns, more than {limit}")]
    Columns {
        /// The number of columns.
        found: usize,
        /// The limit.
        limit: usize,
    },
    /// Rows lack more cells of the first row's columns than may be added: the first row probably holds no titles.
    #[error(
        "line {line}: the rows up to here lack {lacking} cells of the first row's {width} columns; \
         write one row of titles that fits the others"
    )]
    Ragged {
        /// The line, counted from 1.
        line: u64,
        /// The number of missing cells so far.
        lacking: usize,
        /// The number of columns of the first row.
        width: usize,
    },
    /// The table is larger than tables that are read whole.
    #[error(
        "line {line}: the table has more than {rows} rows or {cells} cells up to here; divide it into several files",
        rows = MAX_TABLE_ROWS,
        cells = MAX_TABLE_CELLS
    )]
    TooLarge {
        /// The line, counted from 1.
        line: u64,
    },
    /// A cell is longer than any value.
    #[error(
        "line {line}: the cell of column {column} has {bytes} bytes, and a value has at most {longest}; look for a quotation mark that is not closed",
        longest = LONGEST_CELL
    )]
    LongCell {
        /// The line, counted from 1.
        line: u64,
        /// The column, counted from 1.
        column: usize,
        /// The length of the cell.
        bytes: usize,
    },
    /// Without a unit, bare numbers would be seconds, and their annotations implausibly long or late.
    #[error(
        "line {line}: from {start} to {end} without a unit would be seconds, and no annotation is so long or so \
         late; if these are milliseconds, call the columns start_ms and end_ms, else start_s and end_s"
    )]
    Implausible {
        /// The line, counted from 1.
        line: u64,
        /// The start as it is written.
        start: String,
        /// The end as it is written.
        end: String,
    },
    /// The times are frames of a recording that the table does not have.
    #[error("line {line}: the times are frames, and a table states no rate; write them in seconds, or as hh:mm:ss.ms")]
    Frames {
        /// The line, counted from 1.
        line: u64,
    },
    /// No row could be read; the fault of the first one.
    #[error("no row could be read; {0}")]
    NoRow(String),
    /// JSON Lines hold something else than an object.
    #[error("line {line}, column {column}: {what}")]
    JsonLines {
        /// The line, counted from 1.
        line: u64,
        /// The column, counted from 1.
        column: u64,
        /// The fault.
        what: String,
    },
    /// A required column is missing.
    #[error("no column of the first row ({found}) is {needed}; {remedy}")]
    Missing {
        /// The columns found, separated by commas.
        found: String,
        /// The missing column.
        needed: &'static str,
        /// A correction.
        remedy: &'static str,
    },
}

/// The most columns that an error lists.
const MOST_LISTED: usize = 12;

/// Returns the names of columns separated by commas; of many columns the first ones, and the number of the others.
pub(crate) fn join_column_names(columns: &[String]) -> String {
    let (first, others) = columns.split_at(columns.len().min(MOST_LISTED));
    match others.len() {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}

/// A row with the line it starts on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct TableRow {
    pub(crate) line: u64,
    pub(crate) cells: Vec<String>,
}

/// A table as cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct TableCells {
    pub(crate) delimiter: u8,
    pub(crate) header: Vec<String>,
    /// The line of the first row.
    pub(crate) header_line: u64,
    pub(crate) rows: Vec<TableRow>,
}

impl TableCells {
    /// Reads a table whose first row names the columns; shorter rows are padded with empty cells, longer
    /// ones are cut to its width. Both are reported, unless only empty cells are cut.
    pub(crate) fn read_table_cells(bytes: &[u8], findings: &mut FindingTally) -> Result<Self, TableError> {
        Self::read_part(bytes, false, findings)
    }

    /// Reads a table like [`Self::read_table_cells`], or the rows in its first bytes if it is `cut`.
    pub(crate) fn read_part(bytes: &[u8], cut: bool, findings: &mut FindingTally) -> Result<Self, TableError> {
        let text = decode_table_bytes(bytes, findings)?;
        Self::read_text_cells(&text, 0, cut, findings)
    }

    /// Reads a table from text like [`Self::read_part`]; its first `above` lines are no part of the table.
    pub(crate) fn read_text_cells(
        text: &str,
        above: u64,
        cut: bool,
        findings: &mut FindingTally,
    ) -> Result<Self, TableError> {
        let mut filled = (1u64..)
            .zip(text.lines())
            .filter(|(line, text)| *line > above && !text.trim().is_empty());
        let (first_line, first) = filled.next().ok_or(TableError::Empty)?;
        // Spreadsheets write their delimiter into a first line `sep=;`.
        let (above, delimiter) = match separator(first) {
            Some(delimiter) => (first_line, delimiter),
            None => (above, sniff(first)),
        };
        let mut header: Option<Vec<String>> = None;
        let mut header_line = 1;
        let mut rows = Vec::new();
        let mut lacking = 0usize;
        let all = super::table_rows::split_table_rows(text, delimiter, cut, MAX_TABLE_CELLS, findings);
        let mut count = 0;
        for TableRow { line, cells } in all {
            count += cells.len();
            if count > MAX_TABLE_CELLS || rows.len() >= MAX_TABLE_ROWS {
                return Err(TableError::TooLarge { line });
            }
            if let Some(column) = cells.iter().position(|cell| cell.len() > LONGEST_CELL) {
                return Err(TableError::LongCell {
                    line,
                    bytes: cells[column].len(),
                    column: column + 1,
                });
            }
            if line <= above || cells.iter().all(|cell| cell.trim().is_empty()) {
                continue;
            }
            match &header {
                None if cells.len() > MAX_TABLE_COLUMNS => {
                    return Err(TableError::Columns {
                        found: cells.len(),
                        limit: MAX_TABLE_COLUMNS,
                    });
                }
                None => {
                    header = Some(cells);
                    header_line = line;
                }
                Some(header) => {
                    let width = header.len();
                    // Each missing cell is filled in, so that a wide header over short rows could fill memory.
                    lacking += width.saturating_sub(cells.len());
                    if lacking > MAX_PADDED_CELLS {
                        return Err(TableError::Ragged { line, lacking, width });
                    }
                    rows.push(fit_row_width(TableRow { line, cells }, width, findings));
                }
            }
        }
        let header = header.ok_or(TableError::Empty)?;
        Ok(Self {
            delimiter,
            header,
            header_line,
            rows,
        })
    }
}

fn fit_row_width(mut row: TableRow, width: usize, findings: &mut FindingTally) -> TableRow {
    let (line, found) = (row.line, row.cells.len());
    if found < width {
        findings.add_limited_note("short rows", line, || {
            format!("the row has {found} cells and the first row {width}; the rest was taken as empty")
        });
        row.cells.resize(width, String::new());
    } else if row.cells[width..].iter().any(|cell| !cell.trim().is_empty()) {
        findings.add_limited_finding("long rows", || {
            ImportFinding::new_warning_finding(
                line,
                format!("the row has {found} cells and the first row {width}; the rest was left out"),
            )
            .with_remedy("put texts that hold the delimiter in quotes, or name the further columns")
        });
    }
    row.cells.truncate(width);
    if row.cells.iter().any(|cell| cell.lines().count() > MAX_CELL_LINES) {
        findings.add_limited_finding("very long cells", || {
            ImportFinding::new_warning_finding(line, format!("a cell of this row has more than {MAX_CELL_LINES} lines"))
                .with_remedy("look for a quotation mark that is not closed")
        });
    }
    row
}

/// Returns the text of a table in UTF-8, in UTF-16 with a byte order mark, or otherwise in Windows-1252.
///
/// # Errors
/// [`TableError`] if the bytes are no text.
pub fn decode_table_text(bytes: &[u8]) -> Result<String, TableError> {
    decode_table_bytes(bytes, &mut FindingTally::default()).map(Cow::into_owned)
}

/// Returns the text of bytes in UTF-8, in UTF-16 with a byte order mark, or otherwise in Windows-1252.
pub(crate) fn decode_table_bytes<'b>(bytes: &'b [u8], findings: &mut FindingTally) -> Result<Cow<'b, str>, TableError> {
    let read_unit: Option<fn([u8; 2]) -> u16> = match bytes {
        [0xff, 0xfe, ..] => Some(u16::from_le_bytes),
        [0xfe, 0xff, ..] => Some(u16::from_be_bytes),
        _ => None,
    };
    if let Some(unit) = read_unit {
        let units = bytes[2..].chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        let text: String = char::decode_utf16(units).map(|c| c.unwrap_or('\u{fffd}')).collect();
        findings.add_limited_note("another encoding", None, || "the text is in UTF-16");
        return printable(text.into());
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match str::from_utf8(bytes) {
        Ok(text) => printable(text.into()),
        Err(error) => {
            let line = table_line_at(bytes, error.valid_up_to());
            // Each byte is a letter in Windows-1252, so that this always reads.
            let western_text: String = bytes
                .iter()
                .map(|byte| windows_1252::decode_windows_byte(*byte))
                .collect();
            let text = printable(western_text.into())?;
            findings.add_limited_finding("another encoding", || {
                ImportFinding::new_warning_finding(
                    line,
                    "the text is not UTF-8; it was read as Windows-1252, so accents may be wrong",
                )
                .with_remedy("save it as UTF-8")
            });
            Ok(text)
        }
    }
}

/// Returns whether a cell of a column of numbers is a gap: empty, or what programs write for a missing number.
pub(crate) fn is_gap(cell: &str) -> bool {
    const GAP_CELL_WORDS: [&str; 10] = [
        "nan",
        "-nan",
        "nan(ind)",
        "-nan(ind)",
        "1.#ind",
        "-1.#ind",
        "1.#qnan",
        "-1.#qnan",
        "na",
        "n/a",
    ];
    cell.is_empty() || GAP_CELL_WORDS.iter().any(|word| cell.eq_ignore_ascii_case(word))
}

fn printable(text: Cow<'_, str>) -> Result<Cow<'_, str>, TableError> {
    let control = |b: &u8| *b < 0x20 && !matches!(b, b'\t' | b'\n' | b'\r' | 0x0b | 0x0c);
    match text.bytes().position(|b| control(&b)) {
        Some(at) => Err(TableError::NotText {
            line: table_line_at(text.as_bytes(), at),
        }),
        None => Ok(text),
    }
}

fn table_line_at(bytes: &[u8], at: usize) -> u64 {
    memchr::memchr_iter(b'\n', &bytes[..at]).count() as u64 + 1
}

/// Returns the delimiter that a line `sep=;` above a table names, as Excel writes it.
fn separator(line: &str) -> Option<u8> {
    let line = line.trim_matches([' ', '"', '\r', '\n']);
    let (word, delimiter) = line.split_at_checked(4)?;
    let named = match delimiter.as_bytes() {
        [named @ (b'\t' | b',' | b';' | b'|')] => *named,
        _ => return None,
    };
    word.eq_ignore_ascii_case("sep=").then_some(named)
}

/// The number of filled lines at the beginning of a table among which its row of titles is looked for.
const TITLE_ROW_SEARCH_LINES: usize = 12;

/// Returns the number of lines above the row of titles, if the lines before it have one filled cell,
/// or at most half as many as the widest.
pub(crate) fn lines_above_titles(text: &str) -> Option<u64> {
    let numbered_lines = (1u64..).zip(text.lines());
    let filled = numbered_lines.filter(|(_, line)| !line.trim().is_empty() && separator(line).is_none());
    let first: Vec<(u64, &str)> = filled.take(TITLE_ROW_SEARCH_LINES).collect();
    let cells = |line: &str, delimiter: u8| {
        let cells = line.split(char::from(delimiter));
        cells.filter(|cell| !cell.trim_matches([' ', '"']).is_empty()).count()
    };
    let (_, widest) = first.iter().max_by_key(|(_, line)| cells(line, sniff(line)))?;
    let delimiter = sniff(widest);
    let widest = cells(widest, delimiter);
    let is_wide = |line: &str| cells(line, delimiter) > (widest / 2).max(1);
    let (line, _) = first.iter().find(|(_, line)| is_wide(line))?;
    (*line > first.first()?.0).then(|| line - 1)
}

/// Returns the delimiter of the first row: tabs if there are several, else the most frequent outside quotes.
fn sniff(line: &str) -> u8 {
    // A value may hold many commas; a row of ELAN has three tabs, and titles between other delimiters have none.
    if memchr::memchr_iter(b'\t', line.as_bytes()).count() >= 3 {
        return b'\t';
    }
    let mut counts = [(b'\t', 0usize), (b',', 0), (b';', 0), (b'|', 0)];
    let mut quoted = false;
    for b in line.bytes() {
        quoted ^= b == b'"';
        for (delimiter, count) in &mut counts {
            *count += usize::from(b == *delimiter && !quoted);
        }
    }
    let most = counts.iter().rev().max_by_key(|(_, count)| *count);
    most.filter(|(_, count)| *count > 0)
        .map_or(b',', |(delimiter, _)| *delimiter)
}
