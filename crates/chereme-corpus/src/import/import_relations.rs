//! Relations between signs that columns of a lexicon table state.

use std::collections::{BTreeMap, BTreeSet};

use chereme_formats::lexicon::SignLexicon;
use chereme_sign::text::fold_text;

use super::lexicon::SHOWN_NAMES;
use super::{FileReport, ImportJob};
use crate::db::sign_relations::{self, RelationRow};
use crate::db::{signs, stored_attributes};
use crate::error::CorpusResult;
use crate::report_finding::ReportFinding;

/// The columns of a table that state relations, each with what its cells hold. The cells stay attributes, too.
pub(super) struct RelationColumns {
    columns: Vec<(usize, RelationCells)>,
    /// The stored kind of each relation by its name without hyphens, and whether the name is that of the other end.
    kinds: BTreeMap<String, (String, bool)>,
}

/// The contents of the cells of a column.
enum RelationCells {
    /// Signs with this relation: `BANK; SHORE`.
    Signs(String),
    /// Signs with their relations, as the Signbank writes them: `variant:BANK, seealso:SHORE`.
    Named,
    /// The parts of a compound in order: `HOUSE + ROOF`.
    Parts,
}

/// The titles of columns, without case and anything but letters, whose cells name relations and signs.
const NAMED_RELATION_TITLES: [&str; 2] = ["relationstoothersigns", "relations"];
/// The titles of columns with the parts of compounds.
const COMPOUND_PART_TITLES: [&str; 3] = ["sequentialmorphology", "parts", "compoundof"];

/// Returns the letters of a title or of the name of a relation, in lower case.
fn title_letters(text: &str) -> String {
    fold_text(text).chars().filter(char::is_ascii_alphabetic).collect()
}

impl RelationColumns {
    pub(super) fn find_relation_columns(job: &ImportJob<'_>, table: &SignLexicon) -> CorpusResult<Self> {
        let mut kinds = BTreeMap::new();
        for (kind, inverse) in sign_relations::load_relation_kinds(job.connection)? {
            kinds.insert(title_letters(&inverse), (kind.clone(), inverse != kind));
            kinds.insert(title_letters(&kind), (kind, false));
        }
        let mut columns = Vec::new();
        for (place, column) in table.columns.iter().enumerate() {
            let title = title_letters(&column.title);
            let singular = title.strip_suffix('s').unwrap_or(&title);
            let relation = singular.strip_suffix("of").unwrap_or(singular);
            let named = [&*title, singular, relation]
                .into_iter()
                .find(|name| kinds.contains_key(*name));
            let cells = match named {
                _ if NAMED_RELATION_TITLES.contains(&&*title) => RelationCells::Named,
                _ if COMPOUND_PART_TITLES.contains(&&*title) => RelationCells::Parts,
                // A number in this column keeps entries of one gloss apart.
                Some("homonym") | None => continue,
                Some(name) => RelationCells::Signs(name.to_owned()),
            };
            columns.push((place, cells));
        }
        Ok(Self { columns, kinds })
    }

    /// Stores the relations that the rows state, each row with its token, and removes those that the table stated before.
    pub(super) fn store_table_relations(
        &self,
        job: &ImportJob<'_>,
        table: &SignLexicon,
        tokens: &[i64],
        report: &mut FileReport,
    ) -> CorpusResult<()> {
        if self.columns.is_empty() {
            return Ok(());
        }
        let sign_of = stored_attributes::signs_of_tokens(job.connection, tokens)?;
        let lexicon_of = signs::lexicons_of_signs(job.connection)?;
        let (mut stated, mut missing) = (BTreeSet::new(), BTreeSet::new());
        for (entry, token) in table.entries.iter().zip(tokens) {
            let Some(&sign) = sign_of.get(token) else {
                continue;
            };
            for (place, cells) in &self.columns {
                for (position, relation, gloss) in cells.split_relation_cell(&entry.cells[*place]) {
                    let related = signs::find_sign(job.connection, lexicon_of.get(&sign).copied(), gloss)?;
                    match (self.kinds.get(&relation), related) {
                        (Some((kind, is_inverse)), Some(related)) if related != sign => {
                            let (from, to) = if *is_inverse { (related, sign) } else { (sign, related) };
                            stated.insert(RelationRow {
                                sign: from,
                                kind: kind.clone(),
                                related: to,
                                position,
                                source: Some(job.place.clone()),
                            });
                        }
                        (Some(_), Some(_)) => {}
                        (Some(_), None) => drop(missing.insert(gloss.to_owned())),
                        (None, _) => drop(missing.insert(format!("{relation}:{gloss}"))),
                    }
                }
            }
        }
        for row in sign_relations::load_relations_of_table(job.connection, &job.place)? {
            if !stated.remove(&row) {
                sign_relations::remove_relations(job.connection, row.sign, &row.kind, row.related)?;
            }
        }
        for row in &stated {
            sign_relations::insert_relation(job.connection, row)?;
        }
        if !missing.is_empty() {
            let names: Vec<&str> = missing.iter().take(SHOWN_NAMES).map(String::as_str).collect();
            let (count, names) = (missing.len(), names.join(", "));
            report.findings.push(ReportFinding::finding_warning(
                format!("columns of relations name {count} signs or relations that are not known: {names}"),
                "their cells stay attributes; import the signs, and this table once more",
            ));
        }
        Ok(())
    }
}

impl RelationCells {
    /// Returns the signs of a cell, each with its place and the letters of the relation.
    fn split_relation_cell<'c>(&self, cell: &'c str) -> Vec<(i64, String, &'c str)> {
        let separators: &[char] = match self {
            Self::Parts => &['+'],
            Self::Named | Self::Signs(_) => &[',', ';', '|', '\n'],
        };
        let parts = cell
            .split(separators)
            .map(str::trim)
            .filter(|part| !matches!(*part, "" | "-"));
        let read = |(place, part): (usize, &'c str)| match self {
            Self::Parts => (place as i64 + 1, "compoundof".to_owned(), part),
            Self::Signs(relation) => (1, relation.clone(), part),
            Self::Named => {
                let (relation, gloss) = part.split_once(':').unwrap_or(("seealso", part));
                let relation = match &*title_letters(relation) {
                    "handshapeparadigm" => "paradigm".to_owned(),
                    role @ ("hyponym" | "hypernym") => format!("{role}of"),
                    other => other.to_owned(),
                };
                (1, relation, gloss.trim())
            }
        };
        parts.enumerate().map(read).collect()
    }
}
