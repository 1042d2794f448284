//! Lines and cells of a table of text.

use std::borrow::Cow;

/// The lines of a text, whatever ends them.
pub(super) struct TableTextLines<'t> {
    text: Cow<'t, str>,
    /// Whether the last line has an end.
    pub(super) is_whole: bool,
}

impl<'t> TableTextLines<'t> {
    pub(super) fn from_table_text(text: &'t str) -> Self {
        let is_whole = text.ends_with(['\n', '\r']);
        // Without any LF the lines end with CR alone.
        let text = match text.contains('\n') {
            true => Cow::Borrowed(text),
            false => Cow::Owned(text.replace('\r', "\n")),
        };
        Self { text, is_whole }
    }

    /// Returns the lines with their numbers, counted from 1; lines of nothing but blanks and delimiters are empty.
    pub(super) fn numbered_lines(&self) -> impl Iterator<Item = (u64, &str)> {
        let blank = |letter: char| letter.is_whitespace() || matches!(letter, ',' | ';');
        (1..).zip(self.text.lines()).map(move |(line, text)| {
            let bare = text.trim_start_matches('\u{feff}');
            match bare.trim_matches(blank).is_empty() {
                true => (line, ""),
                false => (line, bare.trim_end_matches('\r')),
            }
        })
    }

    /// Returns the lines from `first` on that hold rows. A line of delimiters alone is a row of gaps if `gaps` says so,
    /// but not at the end.
    pub(super) fn data_row_lines(&self, first: u64, gaps: bool) -> impl Iterator<Item = (u64, &str)> {
        let numbered_lines = (1..).zip(self.text.lines());
        let raw = numbered_lines.skip_while(move |(line, _)| *line < first);
        let mut open: Vec<(u64, &str)> = Vec::new();
        let blank = |letter: char| letter.is_whitespace() || matches!(letter, ',' | ';');
        raw.flat_map(move |(line, text)| {
            let text = text.trim_start_matches('\u{feff}').trim_end_matches('\r');
            let is_blank = text.trim_matches(blank).is_empty();
            if !is_blank || gaps && text.contains(['\t', ',', ';']) {
                open.push((line, text));
            }
            match is_blank {
                true => Vec::new(),
                false => std::mem::take(&mut open),
            }
        })
    }

    /// Returns the lines that are not blank.
    pub(super) fn filled_lines(&self) -> impl Iterator<Item = (u64, &str)> {
        self.numbered_lines().filter(|(_, text)| !text.is_empty())
    }

    /// Returns the first lines that are not blank, without one like `sep=;`.
    pub(super) fn first_filled_lines(&self, count: usize) -> Vec<(u64, &str)> {
        let filled_lines = self.filled_lines();
        // This line names the delimiter for a spreadsheet.
        let filled = filled_lines.filter(|(_, line)| !line.trim_matches('"').starts_with("sep="));
        filled.take(count).collect()
    }
}

/// Returns the delimiter that occurs most often in a line of titles.
pub(super) fn detect_column_delimiter(line: &str) -> char {
    let count = |letter: char| line.matches(letter).count();
    let all = [',', ';', '\t'];
    let most = all.into_iter().max_by_key(|letter| count(*letter));
    most.unwrap_or(',')
}

/// Returns the cells of a line without the blanks and quotation marks around them.
pub(super) fn split_line_cells(line: &str, delimiter: char) -> Vec<&str> {
    let mut cells = Vec::new();
    let mut rest = Some(line);
    while let Some(text) = rest {
        let (cell, after) = match split_quoted_cell(text, delimiter) {
            Some(found) => found,
            None => match text.split_once(delimiter) {
                Some((cell, after)) => (cell, Some(after)),
                None => (text, None),
            },
        };
        cells.push(cell.trim());
        rest = after;
    }
    cells
}

/// Splits off a cell in quotation marks that close before a delimiter or the end of the line.
fn split_quoted_cell(text: &str, delimiter: char) -> Option<(&str, Option<&str>)> {
    let inside = text.trim_start_matches(' ').strip_prefix('"')?;
    let (cell, after) = inside.split_once('"')?;
    let after = after.trim_start_matches(' ');
    match after.strip_prefix(delimiter) {
        Some(after) => Some((cell, Some(after))),
        None => after.is_empty().then_some((cell, None)),
    }
}
