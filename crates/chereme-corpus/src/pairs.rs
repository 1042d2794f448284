//! Minimal pairs: signs that differ in exactly one field of a set.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use chereme_formats::lexicon::{self, Column, LexiconEntry, Meaning};
use chereme_sign::text::{did_you_mean, fold, nearest};
use rusqlite::Connection;
use serde::Serialize;
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};

use crate::Corpus;
use crate::db::{recordings, signs};
use crate::error::{Error, Result};
use crate::suggest;

/// The treatment of an empty cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Empty {
    /// An empty cell is a value like any other: a sign without a weak hand differs from one with it, and two signs
    /// without it are equal there.
    #[default]
    Value,
    /// An empty cell is unknown: a sign with an empty field takes no part.
    Unknown,
}

/// The fields that are compared, and the treatment of empty cells.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PairOptions {
    /// The fields: titles of the columns of an imported lexicon table, whose cells are compared as written; or fields
    /// of queries such as `dominant.configuration`, by which the citation forms of the corpus are compared. One word
    /// such as `S13` may stand for a [set](FIELD_SETS). If empty, all coded fields.
    pub fields: Vec<String>,
    /// The treatment of an empty cell.
    pub empty: Empty,
}

/// Named sets of columns of the Signbank.
pub const FIELD_SETS: [(&str, &[&str]); 5] = [
    (
        "S13",
        &[
            "Handedness",
            "Handshape strong",
            "Handshape change",
            "Handshape weak",
            "Relation between articulators",
            "Location",
            "Contact type",
            "Movement direction",
            "Movement shape",
            "Repeated Movement",
            "Alternating Movement",
            "Relative orientation movement",
            "Relative orientation location",
        ],
    ),
    (
        "F8",
        &[
            "Handedness",
            "Handshape strong",
            "Handshape weak",
            "Handshape change",
            "Location",
            "Movement shape",
            "Movement direction",
            "Repeated Movement",
        ],
    ),
    (
        "F7",
        &[
            "Handedness",
            "Handshape strong",
            "Handshape weak",
            "Location",
            "Contact type",
            "Movement shape",
            "Movement direction",
        ],
    ),
    (
        "F5",
        &[
            "Handedness",
            "Handshape strong",
            "Handshape weak",
            "Location",
            "Movement direction",
        ],
    ),
    (
        "C3",
        &["Handshape strong", "Location", "Movement direction"],
    ),
];

/// The minimal pairs of a corpus.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pairs {
    /// How many pairs there are.
    pub total: usize,
    /// How many signs are in at least one of them.
    pub signs: usize,
    /// How many pairs of signs are equal in all fields.
    pub homonyms: usize,
    /// How many groups of equal signs there are.
    pub homonym_groups: usize,
    /// How many signs are in such a group.
    pub homonym_signs: usize,
    /// How many signs take part.
    pub entries: usize,
    /// The number of different forms among them.
    pub forms: usize,
    /// The number of pairs whose two values are both given; in the others one cell is empty.
    pub certain: usize,
    /// The number of pairs by differing field, most first.
    #[serde(serialize_with = "in_order")]
    pub by_field: Vec<(String, usize)>,
    /// The signs in the largest number of pairs, at most ten; equal numbers are ordered by gloss.
    pub densest: Vec<Dense>,
    /// The SHA-256 of the list: lines `A`, tab, `B`, tab, field, sorted, each ended by a line feed.
    pub sha256: String,
    /// The fields that were compared.
    pub fields: Vec<String>,
    /// The pairs themselves, in the order of the list.
    #[serde(skip)]
    pub list: Vec<Pair>,
}

/// A sign with the number of pairs that it is in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Dense {
    /// Its gloss.
    pub gloss: String,
    /// How many pairs it is in.
    pub pairs: usize,
}

/// Two signs that differ in one field.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Pair {
    /// The gloss that is the lesser of the two.
    pub a: String,
    /// The other gloss.
    pub b: String,
    /// The field in which they differ.
    pub field: String,
}

fn in_order<S: serde::Serializer>(
    counts: &[(String, usize)],
    out: S,
) -> std::result::Result<S::Ok, S::Error> {
    out.collect_map(counts.iter().map(|(field, count)| (field, count)))
}

/// The largest number of listed pairs.
const MOST_PAIRS: usize = 5_000_000;
/// The number of densest signs that are listed.
const DENSEST: usize = 10;

impl Corpus {
    /// Returns the minimal pairs of the corpus: signs that differ in exactly one of the fields.
    ///
    /// # Errors
    /// [`Error::Wrong`] if a field does not exist, or there are more pairs than can be listed.
    pub fn pairs(&self, options: &PairOptions) -> Result<Pairs> {
        let connection = self.store.read();
        let named = match &options.fields[..] {
            [one] => FIELD_SETS.iter().find(|(name, _)| name == one),
            _ => None,
        };
        let fields: Vec<String> = match named {
            Some((_, titles)) => titles.iter().map(|title| (*title).to_owned()).collect(),
            None => options.fields.clone(),
        };
        let table = match of_tables(connection, &fields)? {
            Some(table) => table,
            None => of_citations(self, &fields)?,
        };
        pairs(table, options.empty)
    }
}

/// Signs with their cells, one for each field.
struct Table {
    fields: Vec<String>,
    rows: Vec<(String, Vec<String>)>,
}

/// The entries of one table that the corpus still has: glosses and cells, by the line of the table.
type Standing = BTreeMap<u64, Vec<(String, Map<String, Value>)>>;

/// Returns the entries that the corpus has of each table, by the table's path, or its name if the path is not known.
fn standing(connection: &Connection) -> Result<BTreeMap<String, Standing>> {
    let mut tables: BTreeMap<String, Standing> = BTreeMap::new();
    for token in signs::lexicon_entries(connection)? {
        let source = token.source.as_deref().unwrap_or_default();
        let Ok(mut source) = serde_json::from_str::<Value>(source) else {
            continue;
        };
        let place = source["path"].as_str().or(source["file"].as_str());
        let (Some(place), Some(line)) = (place.map(str::to_owned), source["line"].as_u64()) else {
            continue;
        };
        if let Value::Object(cells) = source["cells"].take() {
            let lines = tables.entry(place).or_default();
            let entries = lines.entry(line).or_default();
            entries.push((token.gloss, cells));
        }
    }
    Ok(tables)
}

/// Returns the gloss that the corpus has now for a row of a table; nothing if the corpus no longer has its sign.
fn standing_gloss(table: &Standing, columns: &[Column], row: &LexiconEntry) -> Option<String> {
    let entries = table.get(&row.line)?;
    let same_cells = |cells: &Map<String, Value>| {
        let filled = columns.iter().zip(&row.cells).filter(|(column, cell)| {
            !cell.trim().is_empty() && !matches!(column.meaning, Meaning::Gloss { .. })
        });
        let own: BTreeMap<&str, &str> = filled
            .map(|(column, cell)| (column.title.as_str(), cell.as_str()))
            .collect();
        own.len() == cells.len()
            && own
                .iter()
                .all(|(title, cell)| cells.get(*title).and_then(Value::as_str) == Some(*cell))
    };
    let named = entries.iter().find(|(gloss, _)| *gloss == row.gloss);
    // A sign that was renamed in the corpus is known by its cells.
    let found = named.or_else(|| entries.iter().find(|(_, cells)| same_cells(cells)))?;
    Some(found.0.clone())
}

/// Returns the rows of the imported tables that have all the columns, if there are such tables: those of the newest
/// version of each table whose signs the corpus still has.
fn of_tables(connection: &Connection, fields: &[String]) -> Result<Option<Table>> {
    let mut rows = Vec::new();
    let mut known: BTreeSet<String> = BTreeSet::new();
    let (mut has_columns, tables) = (false, standing(connection)?);
    for file in recordings::lexicon_files(connection)? {
        let Some(bytes) = recordings::source_bytes(connection, file.id)? else {
            continue;
        };
        let Ok((table, _)) = lexicon::read(&bytes, &Default::default()) else {
            continue;
        };
        let place = |field: &String| {
            let wanted = fold(field.trim());
            let mut titles = table.columns.iter();
            titles.position(|column| fold(column.title.trim()) == wanted)
        };
        known.extend(table.columns.iter().map(|it| it.title.clone()));
        let Some(places) = fields.iter().map(place).collect::<Option<Vec<_>>>() else {
            continue;
        };
        has_columns = true;
        let place = file.path.as_ref().unwrap_or(&file.name);
        let Some(entries) = tables.get(place) else {
            continue;
        };
        rows.extend(table.entries.iter().filter_map(|entry| {
            let gloss = standing_gloss(entries, &table.columns, entry)?;
            let cells = places.iter().map(|at| entry.cells[*at].trim().to_owned());
            Some((gloss, cells.collect()))
        }));
    }
    if !has_columns || fields.is_empty() {
        let title = |field: &&String| field.parse::<chereme_sign::Field>().is_err();
        return match fields.iter().find(title) {
            None => Ok(None),
            Some(field) => {
                let near = did_you_mean(nearest(field, known.iter().map(String::as_str)));
                let titles: Vec<&str> = known.iter().map(String::as_str).collect();
                let text =
                    format!("no imported table has a column {field:?} with the others{near}");
                Err(Error::wrong(text).at(field).advise(format!(
                    "name fields of queries such as dominant.configuration, or columns of one table: {}",
                    titles.join(", ")
                )))
            }
        };
    }
    let fields = fields.to_vec();
    Ok(Some(Table { fields, rows }))
}

/// Returns the codings of the citation forms, by query field.
fn of_citations(corpus: &Corpus, fields: &[String]) -> Result<Table> {
    let connection = corpus.store.read();
    let mut codings = Vec::new();
    for token in signs::citations(connection)? {
        let coding = corpus.coding_of(&token)?;
        if !coding.is_empty() {
            codings.push((token.gloss, coding));
        }
    }
    let coded: BTreeSet<&String> = codings.iter().flat_map(|(_, it)| it.keys()).collect();
    let wanted = |field: &String| -> Result<String> {
        let written = match field.parse::<chereme_sign::Field>() {
            Ok(field) => suggest::coding_name(&field),
            Err(error) => return Err(Error::wrong(error.to_string()).at(field)),
        };
        if coded.contains(&written) {
            return Ok(written);
        }
        let names: Vec<&str> = coded.iter().map(|it| it.as_str()).collect();
        let text = format!("no citation form is coded for {field}");
        Err(Error::wrong(text)
            .at(field)
            .advise(format!("coded are: {}", names.join(", "))))
    };
    let keys: Vec<String> = match fields {
        [] => coded.iter().map(|it| (*it).clone()).collect(),
        some => some.iter().map(wanted).collect::<Result<_>>()?,
    };
    let rows = codings.iter().map(|(gloss, coding)| {
        let cells = keys.iter().map(|key| coding.get(key).cloned());
        (
            gloss.clone(),
            cells.map(Option::unwrap_or_default).collect(),
        )
    });
    Ok(Table {
        rows: rows.collect(),
        fields: keys,
    })
}

/// Returns the minimal pairs of codings, by all fields that one of them has.
pub(crate) fn of_codings(codings: &[(String, BTreeMap<String, String>)]) -> Result<Pairs> {
    let fields: BTreeSet<&String> = codings.iter().flat_map(|(_, it)| it.keys()).collect();
    let cells = |coding: &BTreeMap<String, String>| {
        let cells = fields.iter().map(|field| coding.get(*field).cloned());
        cells.map(Option::unwrap_or_default).collect()
    };
    let rows = codings.iter().filter(|(_, it)| !it.is_empty());
    let table = Table {
        rows: rows.map(|(gloss, it)| (gloss.clone(), cells(it))).collect(),
        fields: fields.iter().map(|it| (*it).clone()).collect(),
    };
    pairs(table, Empty::Value)
}

fn pairs(mut table: Table, empty: Empty) -> Result<Pairs> {
    if empty == Empty::Unknown {
        table
            .rows
            .retain(|(_, cells)| cells.iter().all(|cell| !cell.is_empty()));
    }
    table.rows.sort();
    let cells = numbered(&table.rows);
    let forms = groups(&cells, None);
    let several = || forms.values().filter(|group| group.len() > 1);
    let mut found: Vec<(usize, usize, usize)> = Vec::new();
    let mut by_field = Vec::new();
    let mut certain = 0;
    for (field, name) in table.fields.iter().enumerate() {
        let before = found.len();
        for group in groups(&cells, Some(field)).values() {
            for (at, one) in group.iter().enumerate() {
                for other in &group[at + 1..] {
                    let (a, b) = (cells[*one][field], cells[*other][field]);
                    if a == b {
                        continue;
                    }
                    // The empty cell has the number 0.
                    certain += usize::from(a != 0 && b != 0);
                    found.push((*one, *other, field));
                }
                if found.len() > MOST_PAIRS {
                    let text = format!("there are more than {MOST_PAIRS} pairs");
                    return Err(Error::wrong(text).advise("compare more fields"));
                }
            }
        }
        by_field.push((name.clone(), found.len() - before));
    }
    by_field.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let mut degrees = vec![0; table.rows.len()];
    for (one, other, _) in &found {
        degrees[*one] += 1;
        degrees[*other] += 1;
    }
    let list = listed(&table, &found);
    Ok(Pairs {
        total: found.len(),
        signs: degrees.iter().filter(|degree| **degree > 0).count(),
        homonyms: several().map(|it| it.len() * (it.len() - 1) / 2).sum(),
        homonym_groups: several().count(),
        homonym_signs: several().map(Vec::len).sum(),
        entries: table.rows.len(),
        forms: forms.len(),
        certain,
        by_field,
        densest: densest(&table, &degrees),
        sha256: sha256(&list),
        fields: table.fields,
        list,
    })
}

/// Returns the cells as numbers that are equal if the texts are equal; the empty cell is 0.
fn numbered(rows: &[(String, Vec<String>)]) -> Vec<Vec<u32>> {
    let mut known: BTreeMap<&str, u32> = BTreeMap::from([("", 0)]);
    let mut number = |text| {
        let next = u32::try_from(known.len()).unwrap_or(u32::MAX);
        *known.entry(text).or_insert(next)
    };
    rows.iter()
        .map(|(_, cells)| cells.iter().map(|cell| number(cell.as_str())).collect())
        .collect()
}

/// Returns groups of rows that are equal in all fields, or in all fields but `without`; rows are in order.
fn groups(cells: &[Vec<u32>], without: Option<usize>) -> BTreeMap<Vec<u32>, Vec<usize>> {
    let mut groups: BTreeMap<Vec<u32>, Vec<usize>> = BTreeMap::new();
    for (at, row) in cells.iter().enumerate() {
        let mut key = row.clone();
        if let Some(field) = without {
            key.remove(field);
        }
        groups.entry(key).or_default().push(at);
    }
    groups
}

/// Returns the pairs in the order of their lines; rows are sorted by gloss.
fn listed(table: &Table, found: &[(usize, usize, usize)]) -> Vec<Pair> {
    let pair = |(one, other, field): &(usize, usize, usize)| Pair {
        a: table.rows[*one].0.clone(),
        b: table.rows[*other].0.clone(),
        field: table.fields[*field].clone(),
    };
    let mut list: Vec<Pair> = found.iter().map(pair).collect();
    list.sort_by_cached_key(line);
    list
}

fn line(pair: &Pair) -> String {
    format!("{}\t{}\t{}\n", pair.a, pair.b, pair.field)
}

fn sha256(list: &[Pair]) -> String {
    let mut hash = Sha256::new();
    for pair in list {
        hash.update(line(pair).as_bytes());
    }
    let mut text = String::new();
    for byte in hash.finalize() {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

fn densest(table: &Table, degrees: &[usize]) -> Vec<Dense> {
    let mut all: Vec<(usize, &String)> = degrees
        .iter()
        .zip(&table.rows)
        .map(|(degree, (gloss, _))| (*degree, gloss))
        .filter(|(degree, _)| *degree > 0)
        .collect();
    all.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(b.1)));
    let named = all.into_iter().take(DENSEST);
    named
        .map(|(pairs, gloss)| Dense {
            gloss: gloss.clone(),
            pairs,
        })
        .collect()
}

#[cfg(test)]
mod tests;
