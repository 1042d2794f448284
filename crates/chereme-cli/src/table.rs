//! Tables for people, as wide as the terminal.

use std::borrow::Cow;

/// The number of blanks between two columns.
const COLUMN_GAP_BLANKS: usize = 2;
/// The least width of a shortened column.
const MIN_COLUMN_WIDTH: usize = 8;
/// The number of columns that stay however narrow a table is.
const MIN_COLUMN_COUNT: usize = 2;
/// The largest width of the rule below the titles, unless the titles are wider.
const MAX_RULE_WIDTH: usize = 100;

/// A table as lines of text.
pub(crate) struct TerminalTable {
    /// The titles, a rule, and a line for each row.
    pub(crate) lines: Vec<String>,
    /// The titles of the columns for which there was no room.
    pub(crate) left_out: Vec<String>,
}

/// Returns a text as a terminal may show it: control characters, which a terminal obeys, and marks that turn the order of
/// letters around are escaped, such as `\u{1b}`. Line ends and tabs stay if `lines` is set.
pub(crate) fn escape_terminal_text(text: &str, lines: bool) -> Cow<'_, str> {
    let obeyed = |letter: char| match letter {
        '\n' | '\t' => !lines,
        // These marks turn the order of letters around and could hide what a line says.
        '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => true,
        _ => letter.is_control(),
    };
    if !text.contains(obeyed) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 8);
    for letter in text.chars() {
        match obeyed(letter) {
            true => escaped.extend(letter.escape_default()),
            false => escaped.push(letter),
        }
    }
    Cow::Owned(escaped)
}

/// Returns a table: columns as wide as their widest cell, numbers to the right. With a width the widest columns are
/// shortened, with an ellipsis, until the lines fit; if that is not enough, columns without any cell are left out, then
/// the last ones.
pub(crate) fn lay_out_table(header: &[&str], rows: &[Vec<String>], width: Option<usize>) -> TerminalTable {
    // A cell with a line end would break its row.
    let on_a_line = |row: &Vec<String>| {
        row.iter()
            .map(|cell| escape_terminal_text(cell, false).into_owned())
            .collect()
    };
    let rows: &[Vec<String>] = &rows.iter().map(on_a_line).collect::<Vec<_>>();
    let all: Vec<ColumnShape> = (0..header.len())
        .map(|column| ColumnShape::measure_column_shape(header[column], rows, column))
        .collect();
    let mut kept: Vec<usize> = (0..header.len()).collect();
    let mut widths = all.iter().map(|column| column.widest).collect::<Vec<_>>();
    if let Some(width) = width {
        loop {
            let shapes: Vec<&ColumnShape> = kept.iter().map(|at| &all[*at]).collect();
            widths = fit_column_widths(&shapes, width);
            // Two columns at least, even if they are wider than the terminal.
            if total_table_width(&widths) <= width || kept.len() <= MIN_COLUMN_COUNT {
                break;
            }
            // The last empty column goes first, since nothing is lost with it.
            let empty = kept.iter().rposition(|at| all[*at].is_empty);
            kept.remove(empty.unwrap_or(kept.len() - 1));
        }
    }
    let line = |cell: &dyn Fn(usize) -> String| {
        let mut text = String::new();
        for (column, width) in kept.iter().zip(&widths) {
            let cell = shorten_cell(&cell(*column), *width);
            let pad = " ".repeat(width.saturating_sub(cell.chars().count()));
            let (before, after) = if all[*column].is_numeric {
                (pad, String::new())
            } else {
                (String::new(), pad)
            };
            text.push_str(&format!("{before}{cell}{after}{}", " ".repeat(COLUMN_GAP_BLANKS)));
        }
        // Blanks at the end would wrap in a narrow terminal.
        text.trim_end().to_owned()
    };
    let head = line(&|column| header[column].to_owned());
    // The rule of a very wide table would fill lines in a narrower window.
    let rule = "-".repeat(total_table_width(&widths).min(MAX_RULE_WIDTH.max(head.chars().count())));
    let mut lines = vec![head, rule];
    let cell = |row: &Vec<String>, column: usize| row.get(column).cloned().unwrap_or_default();
    lines.extend(rows.iter().map(|row| line(&|column| cell(row, column))));
    let left_out = (0..header.len()).filter(|column| !kept.contains(column));
    TerminalTable {
        lines,
        left_out: left_out.map(|column| header[column].to_owned()).collect(),
    }
}

/// The needs of a column.
struct ColumnShape {
    widest: usize,
    /// The width below which it is not shortened.
    least: usize,
    is_numeric: bool,
    /// Whether no row has a cell in it.
    is_empty: bool,
}

impl ColumnShape {
    fn measure_column_shape(title: &str, rows: &[Vec<String>], column: usize) -> Self {
        let cells = || rows.iter().filter_map(|row| row.get(column));
        let widest = cells().map(|cell| cell.chars().count()).max().unwrap_or(0);
        // Empty cells do not make a column of numbers one of words.
        let number = |cell: &String| cell.is_empty() || cell.parse::<f64>().is_ok();
        let is_numeric = !rows.is_empty() && cells().all(number);
        Self {
            widest: widest.max(title.chars().count()),
            // A shortened number would be another number.
            least: if is_numeric {
                widest.max(MIN_COLUMN_WIDTH)
            } else {
                MIN_COLUMN_WIDTH
            },
            is_numeric,
            is_empty: widest == 0,
        }
    }
}

/// Returns the width of a table's lines.
fn total_table_width(widths: &[usize]) -> usize {
    widths.iter().sum::<usize>() + COLUMN_GAP_BLANKS * widths.len().saturating_sub(1)
}

/// Returns the widths of columns, the widest narrowed until the table fits or all have their least width.
fn fit_column_widths(columns: &[&ColumnShape], width: usize) -> Vec<usize> {
    let mut widths: Vec<usize> = columns.iter().map(|column| column.widest).collect();
    loop {
        let over = total_table_width(&widths).saturating_sub(width);
        let mut loose: Vec<usize> = (0..widths.len())
            .filter(|at| widths[*at] > columns[*at].least)
            .collect();
        // The widest column is narrowed down to the next one, then both together.
        loose.sort_by_key(|at| std::cmp::Reverse(widths[*at]));
        let Some(widest) = loose.first().copied().filter(|_| over > 0) else {
            return widths;
        };
        let next = loose.get(1).map_or(0, |at| widths[*at]);
        let least = columns[widest].least;
        // One letter at least, so that the loop ends.
        let step = (widths[widest] - next.max(least)).max(1).min(over);
        widths[widest] -= step;
    }
}

/// Returns a cell shortened to `width` letters, with an ellipsis as the last one if it was longer.
fn shorten_cell(cell: &str, width: usize) -> String {
    match cell.char_indices().nth(width) {
        Some(_) => {
            let kept: String = cell.chars().take(width.saturating_sub(1)).collect();
            format!("{}…", kept.trim_end())
        }
        None => cell.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows() -> Vec<Vec<String>> {
        let row = |cells: [&str; 3]| cells.map(str::to_owned).to_vec();
        vec![
            row(["1", "BOL", "right.configuration=U placement=neutral movement=straight"]),
            row(["12", "ÊTRE DÉGOÛTÉ", "placement=chin"]),
        ]
    }

    fn lines(header: &[&str], rows: &[Vec<String>], width: Option<usize>) -> Vec<String> {
        lay_out_table(header, rows, width).lines
    }

    #[test]
    fn characters_that_a_terminal_obeys_are_escaped() {
        let cases = [
            ("plain, à é \u{e002}", "plain, à é \u{e002}"),
            ("a\u{1b}[31mb", "a\\u{1b}[31mb"),
            ("\u{9b}2J", "\\u{9b}2J"),
            ("x\u{202e}y", "x\\u{202e}y"),
            ("one\r", "one\\r"),
        ];
        for (text, expected) in cases {
            assert_eq!(escape_terminal_text(text, true), expected);
        }
        assert_eq!(escape_terminal_text("two\nlines", true), "two\nlines");
        let rows = vec![vec!["two\nlines".to_owned()]];
        assert_eq!(lay_out_table(&["name"], &rows, None).lines[2], "two\\nlines");
    }

    #[test]
    fn a_table_is_cut_to_the_width_given() {
        let header = ["token", "gloss", "components"];
        let wide = lines(&header, &rows(), None);
        assert!(wide[2].ends_with("movement=straight"));
        assert_eq!(wide[3], "   12  ÊTRE DÉGOÛTÉ  placement=chin");
        for width in [40, 50, 60] {
            let narrow = lines(&header, &rows(), Some(width));
            assert!(narrow.iter().all(|line| line.chars().count() <= width), "{narrow:#?}");
            assert!(
                narrow[2].ends_with('…') && narrow[3].starts_with("   12"),
                "{narrow:#?}"
            );
        }
        let least = lines(&header, &rows(), Some(3));
        assert!(least[3].contains("ÊTRE DÉ…"), "{least:#?}");
        assert_eq!(lines(&header, &[], Some(22))[0], "token  gloss  compone…");
    }

    #[test]
    fn a_table_with_too_many_columns_leaves_some_out() {
        let header = ["id", "name", "signer", "duration_us", "notes", "licence"];
        let row = ["1", "BOL", "", "1500000", "", "CC0-1.0"].map(str::to_owned);
        let rows = [row.to_vec()];
        for (width, left_out) in [
            (60, &[][..]),
            (36, &["notes"][..]),
            (30, &["signer", "notes"][..]),
            (16, &["signer", "duration_us", "notes", "licence"][..]),
        ] {
            let table = lay_out_table(&header, &rows, Some(width));
            assert_eq!(table.left_out, left_out, "{width}");
            let fits = |line: &String| line.chars().count() <= width;
            assert!(table.lines.iter().all(fits), "{:#?}", table.lines);
            assert!(table.lines[2].contains("BOL"));
        }
        // The number of a narrowed column stays whole.
        let narrow = lines(&header, &rows, Some(36));
        assert!(narrow[0].contains("duration…") && narrow[2].contains("1500000"));
    }
}
