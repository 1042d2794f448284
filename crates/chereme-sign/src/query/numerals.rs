//! Numbers as tables write them: the meaning of commas, points and blanks, by all cells of a column.

/// The meaning of a mark in the numbers of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NumberMark {
    /// It stands before decimals, or nothing shows its meaning.
    Decimals,
    /// It parts thousands.
    Thousands,
}

/// The spelling of numbers in one column: whether commas and points part thousands.
///
/// ```
/// use chereme_sign::query::NumberSpelling;
///
/// let column = NumberSpelling::from_column_cells(["1,234", "7", "1,000,000"]);
/// assert_eq!(column.parse_cell_number("1,234"), Some(1234.0));
/// assert_eq!(NumberSpelling::from_column_cells(["1,234", "0,5"]).parse_cell_number("1,234"), Some(1.234));
/// assert_eq!(NumberSpelling::from_column_cells(["12 %"]).parse_cell_number("12 %"), Some(12.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NumberSpelling {
    comma: NumberMark,
    point: NumberMark,
    /// Whether a cell shows the meaning of the comma.
    is_comma_known: bool,
}

impl NumberSpelling {
    /// Returns the spelling that the cells of a column show.
    #[must_use]
    pub fn from_column_cells<'t>(cells: impl IntoIterator<Item = &'t str>) -> Self {
        let (mut comma, mut point) = ((false, false), (false, false));
        for cell in cells {
            let text = strip_cell_signs(cell);
            if !is_numeral(&text) {
                continue;
            }
            for (mark, other, shown) in [(',', '.', &mut comma), ('.', ',', &mut point)] {
                let Some((before, after)) = text.rsplit_once(mark) else {
                    continue;
                };
                // Several of one mark can only part thousands; one mark before three digits may be either.
                let several = before.contains(mark);
                match before.contains(other) || after.contains(other) {
                    true => match after.contains(other) {
                        true => shown.1 |= parts_thousands(&text, mark),
                        false => shown.0 |= !several,
                    },
                    false if several => shown.1 |= parts_thousands(&text, mark),
                    false => shown.0 |= !parts_thousands(&text, mark),
                }
            }
        }
        let mark = |(decimals, thousands): (bool, bool)| match thousands && !decimals {
            true => NumberMark::Thousands,
            false => NumberMark::Decimals,
        };
        Self {
            comma: mark(comma),
            point: mark(point),
            // If the point parts thousands, the comma stands before decimals.
            is_comma_known: comma.0 || comma.1 || mark(point) == NumberMark::Thousands,
        }
    }

    /// Returns the number that a cell of the column holds, a percentage without its sign.
    #[must_use]
    pub fn parse_cell_number(&self, cell: &str) -> Option<f64> {
        let mut text = strip_cell_signs(cell);
        for (mark, meaning) in [(',', self.comma), ('.', self.point)] {
            if meaning == NumberMark::Thousands && parts_thousands(&text, mark) {
                text.retain(|c| c != mark);
            }
        }
        super::parse_plain_number(&text)
    }

    /// Returns whether a cell may as well hold a thousand times the [`parse_cell_number`](Self::parse_cell_number): `1,234`, if no cell of the
    /// column shows the meaning of the comma.
    #[must_use]
    pub fn is_ambiguous(&self, cell: &str) -> bool {
        let text = strip_cell_signs(cell);
        !self.is_comma_known && is_numeral(&text) && text.contains(',') && parts_thousands(&text, ',')
    }
}

/// Returns a cell without a sign of percent at its end, and without blanks and apostrophes between groups of three digits.
fn strip_cell_signs(cell: &str) -> String {
    let is_blank = |c: char| matches!(c, ' ' | '\u{a0}' | '\u{2009}' | '\u{202f}' | '\'' | '’');
    let trimmed_cell = cell.trim();
    let cell = trimmed_cell.strip_suffix('%').map_or(trimmed_cell, str::trim_end);
    let integer_part = cell.split([',', '.']).next().unwrap_or(cell);
    let mut groups = integer_part.split(is_blank);
    let first_group = groups.next().unwrap_or_default();
    let first = first_group.trim_start_matches(['-', '+']);
    let is_first = (1..=3).contains(&first.len()) && first.bytes().all(|b| b.is_ascii_digit());
    if is_first && groups.all(is_group) {
        let rest = &cell[integer_part.len()..];
        return integer_part
            .chars()
            .filter(|c| !is_blank(*c))
            .chain(rest.chars())
            .collect();
    }
    cell.to_owned()
}

fn is_group(text: &str) -> bool {
    text.len() == 3 && text.bytes().all(|b| b.is_ascii_digit())
}

/// Returns whether a text is of digits, commas and points, after a sign, and begins with a digit.
fn is_numeral(text: &str) -> bool {
    let text = text.strip_prefix(['-', '+']).unwrap_or(text);
    text.starts_with(|c: char| c.is_ascii_digit()) && text.chars().all(|c| c.is_ascii_digit() || matches!(c, ',' | '.'))
}

/// Returns whether a mark stands before each group of three digits of a whole number that does not begin with 0; the
/// other mark may stand before decimals.
fn parts_thousands(text: &str, mark: char) -> bool {
    let other = if mark == ',' { '.' } else { ',' };
    let text = text.strip_prefix(['-', '+']).unwrap_or(text);
    let (whole, decimals) = text.split_once(other).unwrap_or((text, ""));
    let mut groups = whole.split(mark);
    let first = groups.next().unwrap_or_default();
    (1..=3).contains(&first.len())
        && first.bytes().all(|b| b.is_ascii_digit())
        && !first.starts_with('0')
        && groups.all(is_group)
        && decimals.bytes().all(|b| b.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_of_a_column_show_what_its_marks_mean() {
        for (cells, numbers, ambiguous) in [
            (
                &["1,234", "12,500", "7", "1,000,000"][..],
                &[1234.0, 12500.0, 7.0, 1e6][..],
                0,
            ),
            (&["1,234.5", "1,234"], &[1234.5, 1234.0], 0),
            (&["1.234,5", "1.234", "2,5"], &[1234.5, 1234.0, 2.5], 0),
            (&["1,234", "0,5"], &[1.234, 0.5], 0),
            (&["1,234", "12,5"], &[1.234, 12.5], 0),
            (&["1,234", "7"], &[1.234, 7.0], 1),
            (&["0,234", "-1,5"], &[0.234, -1.5], 0),
            (&["1.234", "7"], &[1.234, 7.0], 0),
            (&["1.000.000", "1.234"], &[1e6, 1234.0], 0),
            (
                &["12 %", "3.5%", "1 234", "1\u{202f}234\u{a0}567,5"],
                &[12.0, 3.5, 1234.0, 1234567.5],
                0,
            ),
            (&["1e3", "-4", "+5", "1'234"], &[1000.0, -4.0, 5.0, 1234.0], 0),
        ] {
            let column = NumberSpelling::from_column_cells(cells.iter().copied());
            let found: Vec<f64> = cells.iter().filter_map(|cell| column.parse_cell_number(cell)).collect();
            assert_eq!(found, numbers, "{cells:?}");
            let unsure = cells.iter().filter(|cell| column.is_ambiguous(cell)).count();
            assert_eq!(unsure, ambiguous, "{cells:?}");
        }
        for text in [
            "", "%", "12 kg", "1 2", "12 34", "a", "1,2,3", "1.2.3", "É 123", "nan", "-",
        ] {
            assert_eq!(
                NumberSpelling::from_column_cells([text]).parse_cell_number(text),
                None,
                "{text:?}"
            );
        }
    }
}
