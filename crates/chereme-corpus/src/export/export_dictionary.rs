//! The description of the database in an exported folder, generated from `schema/README.md`.

/// The description of every table and column, with example queries.
const DATABASE_SCHEMA_TEXT: &str = chereme_data::schema_text("README.md");

/// The first section for readers of the database; the sections before it describe the source tree.
const LEFT_OUT_TO: &str = "## At a glance";

/// Returns the data dictionary: tables, columns and conventions, with example queries.
pub(super) fn data_dictionary_text() -> String {
    let start = DATABASE_SCHEMA_TEXT.find(LEFT_OUT_TO).unwrap_or_default();
    format!(
        "# The tables of this corpus\n\nThis page describes every table and column of `corpus.chereme`, which are the files of \
         `tables`, too, and ends with\nexample queries. `queries.sql` holds the same queries, to run as they are:\n\n```\n\
         sqlite3 -readonly corpus.chereme < queries.sql\n```\n\nAny SQLite tool reads the database from version 3.37 on \
         (STRICT tables), and runs the queries from 3.38 on (`->>`).\n\n{}",
        &DATABASE_SCHEMA_TEXT[start..]
    )
}

/// Returns the example queries, each below a comment that describes its result.
pub(super) fn example_queries_text() -> String {
    let mut text = String::from("-- Example queries on corpus.chereme; DICTIONARY.md explains tables and columns.\n");
    let (mut title, mut inside) = ("", false);
    for line in DATABASE_SCHEMA_TEXT.lines() {
        match line {
            "```sql" => {
                text.push_str(&format!("\n-- {title}\n"));
                inside = true;
            }
            "```" => {
                // Without its semicolon a query would run into the next one.
                if inside && !text.ends_with(";\n") {
                    text.insert(text.trim_end().len(), ';');
                }
                inside = false;
            }
            line if inside => {
                text.push_str(line);
                text.push('\n');
            }
            "" => {}
            line => title = line,
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dictionary_describes_tables_and_says_nothing_of_the_source_tree() {
        let text = data_dictionary_text();
        assert!(text.contains("### `annotation`"));
        assert!(!text.contains("tests/stores"));
        assert!(example_queries_text().matches("SELECT").count() > 20);
    }
}
