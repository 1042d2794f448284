//! Prints Markdown tables.

/// Returns a table; the first column is to the left, the others are to the right.
pub(crate) fn markdown<R: IntoIterator<Item = String>>(head: &[&str], rows: impl IntoIterator<Item = R>) -> String {
    let mut text = format!("| {} |\n|---|", head.join(" | "));
    text.push_str(&"--:|".repeat(head.len() - 1));
    text.push('\n');
    for row in rows {
        let cells: Vec<String> = row.into_iter().collect();
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    text
}

/// Returns a small number as text that shows its order of magnitude; `0` below a billionth.
pub(crate) fn small(value: f64) -> String {
    if value < 1e-12 {
        "0".into()
    } else {
        format!("{value:.0e}")
    }
}
