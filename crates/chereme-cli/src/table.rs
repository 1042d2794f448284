//! Tables for people, as wide as the terminal.

/// The number of blanks between two columns.
const GAP: usize = 2;
/// The least width of a shortened column of text.
const NARROWEST: usize = 8;
/// The largest width of the rule below the titles, unless the titles are wider.
const RULE: usize = 100;

/// Returns the lines of a table: columns as wide as their widest cell, numbers to the right. With a width the
/// widest columns of text are shortened, with an ellipsis, until the lines fit.
pub(crate) fn lines(header: &[&str], rows: &[Vec<String>], width: Option<usize>) -> Vec<String> {
    let count = |text: &str| text.chars().count();
    let numeric: Vec<bool> = (0..header.len())
        .map(|column| is_numeric(rows, column))
        .collect();
    let mut widths: Vec<usize> = (0..header.len())
        .map(|column| {
            let cells = rows.iter().filter_map(|row| row.get(column));
            let widest = cells.map(|cell| count(cell)).max().unwrap_or(0);
            widest.max(count(header[column]))
        })
        .collect();
    if let Some(width) = width {
        fit(&mut widths, &numeric, width);
    }
    let line = |cells: &mut dyn Iterator<Item = &str>| {
        let mut text = String::new();
        for ((cell, width), numeric) in cells.zip(&widths).zip(&numeric) {
            let cell = shortened(cell, *width);
            let pad = " ".repeat(width.saturating_sub(count(&cell)));
            let (before, after) = if *numeric {
                (pad, String::new())
            } else {
                (String::new(), pad)
            };
            text.push_str(&format!("{before}{cell}{after}{}", " ".repeat(GAP)));
        }
        text.trim_end().to_owned()
    };
    let head = line(&mut header.iter().copied());
    let whole = widths.iter().sum::<usize>() + GAP * widths.len().saturating_sub(1);
    let rule = "-".repeat(whole.min(RULE.max(count(&head))));
    let rows = rows
        .iter()
        .map(|row| line(&mut row.iter().map(String::as_str)));
    let mut lines = vec![head.clone(), rule];
    lines.extend(rows);
    lines
}

fn is_numeric(rows: &[Vec<String>], column: usize) -> bool {
    let mut cells = rows.iter().filter_map(|row| row.get(column)).peekable();
    cells.peek().is_some() && cells.all(|cell| cell.is_empty() || cell.parse::<f64>().is_ok())
}

/// Narrows the widest columns of text until the table fits or all are at their least width.
fn fit(widths: &mut [usize], numeric: &[bool], width: usize) {
    let gaps = GAP * widths.len().saturating_sub(1);
    loop {
        let over = (widths.iter().sum::<usize>() + gaps).saturating_sub(width);
        let mut text: Vec<usize> = (0..widths.len())
            .filter(|at| !numeric[*at] && widths[*at] > NARROWEST)
            .collect();
        text.sort_by_key(|at| std::cmp::Reverse(widths[*at]));
        let Some(widest) = text.first().copied().filter(|_| over > 0) else {
            return;
        };
        let next = text
            .get(1)
            .map_or(NARROWEST, |at| widths[*at])
            .max(NARROWEST);
        let step = (widths[widest] - next).max(1).min(over);
        widths[widest] -= step;
    }
}

/// Returns a cell shortened to `width` letters, with an ellipsis as the last one if it was longer.
fn shortened(cell: &str, width: usize) -> String {
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
            row([
                "1",
                "BOL",
                "right.configuration=U placement=neutral movement=straight",
            ]),
            row(["12", "ÊTRE DÉGOÛTÉ", "placement=chin"]),
        ]
    }

    #[test]
    fn a_table_is_cut_to_the_width_given() {
        let header = ["token", "gloss", "components"];
        let wide = lines(&header, &rows(), None);
        assert!(wide[2].ends_with("movement=straight"));
        assert_eq!(wide[3], "   12  ÊTRE DÉGOÛTÉ  placement=chin");
        for width in [40, 50, 60] {
            let narrow = lines(&header, &rows(), Some(width));
            assert!(
                narrow.iter().all(|line| line.chars().count() <= width),
                "{narrow:#?}"
            );
            assert!(
                narrow[2].ends_with('…') && narrow[3].starts_with("   12"),
                "{narrow:#?}"
            );
        }
        let least = lines(&header, &rows(), Some(3));
        assert!(least[3].contains("ÊTRE DÉ…"), "{least:#?}");
        assert_eq!(lines(&header, &[], Some(20))[0], "token  gloss  compone…");
    }
}
