//! Tables of people: a row for each person, with other names and whatever a corpus says of them.

use chereme_sign::query::NumberSpelling;
use chereme_sign::text::fold_text;

use super::{TableCells, TableError, is_gap, join_column_names};
use crate::finding::ImportFinding;
use crate::tally::FindingTally;

/// A row of a table of people.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PersonTableRow {
    /// The line, counted from 1.
    pub line: u64,
    /// The name.
    pub name: String,
    /// Other names.
    pub aliases: Vec<String>,
    /// The dominant hand, as its cell says it.
    pub handedness: Option<String>,
    /// Remarks.
    pub notes: Option<String>,
    /// The cells of the other columns that say something: title, text, and the number that it is.
    pub attributes: Vec<PersonTableCell>,
}

/// A cell that says something of a person.
#[derive(Debug, Clone, PartialEq)]
pub struct PersonTableCell {
    /// The title of its column.
    pub title: String,
    /// Its text.
    pub text: String,
    /// The number that it is, by all cells of its column.
    pub number: Option<f64>,
}

/// The columns that are no attributes.
const NAME_COLUMN_TITLES: [&str; 9] = [
    "name",
    "person",
    "signer",
    "participant",
    "annotator",
    "code",
    "nom",
    "signeur",
    "id",
];
const ALIAS_COLUMN_TITLES: [&str; 6] = [
    "alias",
    "aliases",
    "other name",
    "other names",
    "autre nom",
    "autres noms",
];
const HANDEDNESS_COLUMN_TITLES: [&str; 5] = ["handedness", "dominant hand", "hand", "lateralite", "main dominante"];
const NOTES_COLUMN_TITLES: [&str; 5] = ["notes", "note", "remarks", "remarques", "comment"];

/// Reads a table of people: a column with their names, and any of other names (parted by `;` or `|`), dominant hand and
/// remarks; every other column is an attribute with its title. Empty cells say nothing.
///
/// # Errors
/// [`TableError`] if the bytes are not a table, or no column holds names.
pub fn read_people_table(bytes: &[u8]) -> Result<(Vec<PersonTableRow>, Vec<ImportFinding>), TableError> {
    let mut findings = FindingTally::default();
    let table = TableCells::read_table_cells(bytes, &mut findings)?;
    let titles: Vec<String> = table
        .header
        .iter()
        .map(|title| fold_text(&title.replace(['_', '-'], " ")).trim().to_owned())
        .collect();
    // The first title that fits decides: "name" is one even beside "id".
    let column_titled = |known: &[&str]| {
        known
            .iter()
            .find_map(|word| titles.iter().position(|title| title == word))
    };
    let Some(name_column) = column_titled(&NAME_COLUMN_TITLES) else {
        return Err(TableError::Missing {
            found: join_column_names(&table.header),
            needed: "name",
            remedy: "call the column with the names of people name",
        });
    };
    let alias_column = column_titled(&ALIAS_COLUMN_TITLES);
    let handedness_column = column_titled(&HANDEDNESS_COLUMN_TITLES);
    let notes_column = column_titled(&NOTES_COLUMN_TITLES);
    let known_columns = [Some(name_column), alias_column, handedness_column, notes_column];
    let attribute_columns: Vec<(usize, NumberSpelling)> = (0..table.header.len())
        .filter(|column| !known_columns.contains(&Some(*column)) && !titles[*column].is_empty())
        .map(|column| {
            let cells = table.rows.iter().filter_map(|row| row.cells.get(column));
            (column, NumberSpelling::from_column_cells(cells.map(String::as_str)))
        })
        .collect();
    let mut people = Vec::new();
    for row in &table.rows {
        let cell = |column: usize| {
            let text = row.cells.get(column).map(|cell| cell.trim());
            text.filter(|text| !is_gap(text)).map(str::to_owned)
        };
        let Some(name) = cell(name_column) else {
            // Rows that only pad a sheet say nothing, and are no fault.
            if row.cells.iter().any(|cell| !is_gap(cell)) {
                findings.add_limited_finding("no name", || {
                    ImportFinding::new_warning_finding(row.line, "the row names nobody and was left out")
                });
            }
            continue;
        };
        let aliases = alias_column.and_then(cell).unwrap_or_default();
        let alias_names = aliases.split([';', '|']).map(str::trim);
        people.push(PersonTableRow {
            line: row.line,
            aliases: alias_names
                .filter(|alias| !alias.is_empty() && *alias != name)
                .map(str::to_owned)
                .collect(),
            handedness: handedness_column.and_then(cell),
            notes: notes_column.and_then(cell),
            attributes: attribute_columns
                .iter()
                .filter_map(|(column, spelling)| {
                    let text = cell(*column)?;
                    Some(PersonTableCell {
                        title: table.header[*column].trim().to_owned(),
                        number: spelling.parse_cell_number(&text),
                        text,
                    })
                })
                .collect(),
            name,
        });
    }
    Ok((people, findings.finish_finding_tally()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_people_gives_names_hands_and_attributes() {
        let text = "Code;Other names;Region;Age;Dominant_hand;Notes\n\
                    S07;\"Ada; A.L.\";north;34;left;\n\
                    S08;;;n/a;;met twice\n\
                    ;;south;;;\n";
        let text = text.replace("\"Ada; A.L.\"", "\"Ada|A.L.\"");
        let (people, findings) = read_people_table(text.as_bytes()).expect("a table");
        assert_eq!(people.len(), 2, "{findings:?}");
        assert_eq!(people[0].name, "S07");
        assert_eq!(people[0].aliases, ["Ada", "A.L."]);
        assert_eq!(people[0].handedness.as_deref(), Some("left"));
        let attributes: Vec<_> = people[0]
            .attributes
            .iter()
            .map(|cell| (cell.title.as_str(), cell.text.as_str(), cell.number))
            .collect();
        assert_eq!(attributes, [("Region", "north", None), ("Age", "34", Some(34.0))]);
        assert_eq!(people[1].notes.as_deref(), Some("met twice"));
        assert!(findings.iter().any(|finding| finding.line == Some(4)), "{findings:?}");
    }

    #[test]
    fn a_table_without_names_says_what_it_needs() {
        let error = read_people_table(b"region,age\nnorth,3\n").expect_err("no names");
        assert!(error.to_string().contains("name"), "{error}");
    }
}
