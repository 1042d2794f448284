//! The table of comparisons with the reference engine.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a program prints its table")]

use std::path::Path;

use chereme_compose::MovementMaterial;

use super::vectors::{VECTOR_GROUPS, VectorDifferences, compare_vectors};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Prints the table of all bodies as Markdown, and the signs of each group that differ most.
pub(crate) fn print_vector_table(file: &Path, bodies: &[(String, MovementMaterial)]) -> Result<()> {
    let tables = bodies.iter().map(|(_, stage)| compare_vectors(file, stage, 1));
    let tables = tables.collect::<Result<Vec<_>>>()?;
    let names: Vec<&str> = bodies.iter().map(|(name, _)| name.as_str()).collect();
    println!("| group | n | {} | tolerance, and its reason |", names.join(" | "));
    println!("|---|--:|{}---|", "--:|".repeat(bodies.len()));
    for (number, group) in VECTOR_GROUPS.iter().enumerate() {
        let rows = tables.iter().map(|table| &table[number]);
        let cells: Vec<String> = rows.clone().map(difference_cell).collect();
        let count = tables[0][number].sorted_differences().len();
        let (tolerance, unit, reason) = (group.tolerance, group.unit, group.reason);
        println!(
            "| {} | {count} | {} | {tolerance} {unit}: {reason} |",
            group.name,
            cells.join(" | ")
        );
        for row in rows {
            let worst = row.sorted_differences().into_iter().rev().take(8);
            let worst: Vec<String> = worst.map(|(key, off)| format!("{key} {off:.2}")).collect();
            eprintln!("{}: {}", group.name, worst.join(", "));
        }
    }
    Ok(())
}

/// Returns the median, the largest difference, and the number within the tolerance.
fn difference_cell(row: &VectorDifferences) -> String {
    let sorted = row.sorted_differences();
    let size = |index: usize| sorted.get(index).map_or(0.0, |(_, off)| *off);
    let digits = if row.group.unit == "°" { 0 } else { 2 };
    let [median, worst] = [size(sorted.len() / 2), size(sorted.len().saturating_sub(1))];
    format!("{median:.digits$} · {worst:.digits$} · {}", row.count_within())
}
