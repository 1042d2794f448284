//! Tables of lexicon codings: one sign per row, one component per column.
//!
//! A column's component is guessed from its title (`schema/column_words.json`) or given by a [`Mapping`]. Compound
//! cells are split: `neutral space > head` is two successive values, `S + W` two at once, `>S` a final value alone. Beside
//! a final value of another column a value is the initial one. `-` and `N/A` are not applicable, `?` is unclear. A column of HamNoSys, recognised by its title or its symbols, gives
//! the sign's notation. A table may also come as JSON: an array of objects, an object whose keys are the glosses, JSON
//! Lines, or an export of SLP-AA. The original cells are kept together with their meanings, so that [`write()`]
//! reproduces the table.
//!
//! ```
//! use chereme_formats::lexicon;
//! use chereme_formats::roles::Mapping;
//!
//! let text = b"NL gloss\tEN gloss\tHandshape strong\tLocation\nPET\tCAP\tB\tforehead > head\n";
//! let (lexicon, _) = lexicon::read(text, &Mapping::default())?;
//! let codings: Vec<String> = lexicon.entries[0].codings.iter().map(|it| format!("{}={}", it.field(), it.reading)).collect();
//! assert_eq!(codings, ["dominant.configuration=B", "initial.placement=forehead", "final.placement=head"]);
//! # Ok::<(), chereme_formats::table::TableError>(())
//! ```

mod columns;
mod json;
mod slpaa;
mod values;

use chereme_sign::Remedy;
use columns::Columns;
pub use columns::{Column, Meaning};

use crate::finding::Finding;
use crate::hns::{holds_symbols, mended_finding};
use crate::roles::{Hands, Mapping};
use crate::table::{Cells, Row, TableError, decode, lines_above_titles, listed};
use crate::tally::Findings;
use chereme_sign::hamnosys::{in_plain_symbols, mended};
use chereme_sign::text::{edit_distance, fold};
use chereme_sign::{Component, Field, Phase, Reading};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io;
use values::EmptyCells;
pub use values::is_value;

/// A table of signs with their component values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Lexicon {
    /// The columns in order, with their meanings.
    pub columns: Vec<Column>,
    /// The signs in the order of the table.
    pub entries: Vec<LexiconEntry>,
    /// The character between cells: a tab, comma, semicolon or bar.
    pub delimiter: u8,
}

/// One sign of a lexicon.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LexiconEntry {
    /// The line of the table, counted from 1.
    pub line: u64,
    /// The gloss, blanks at its ends left out.
    pub gloss: String,
    /// Translations and glosses in other languages: the language (empty if unknown) and the text.
    pub translations: Vec<(String, String)>,
    /// The component values of the sign, in the order of the columns; unset cells give no value.
    pub codings: Vec<Coding>,
    /// The sign as HamNoSys, blanks at its ends left out.
    pub notation: Option<String>,
    /// Other information about the sign, as title and cell; empty cells are left out.
    pub attributes: Vec<(String, String)>,
    /// The original cells, one per column.
    pub cells: Vec<String>,
}

/// A component value of a sign, from a cell or a part of one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Coding {
    /// The hand; `None` for a value of the sign as a whole.
    pub hand: Option<Hands>,
    /// The component.
    pub component: Component,
    /// The part of the component, such as `palm` or `direction`.
    pub feature: Option<String>,
    /// The phase: initial, middle or final.
    #[serde(serialize_with = "phase_name")]
    pub phase: Option<Phase>,
    /// The value, or its absence.
    pub reading: Reading,
    /// The part of the cell with the value, as written.
    pub raw: String,
    /// The index of the column, from 0.
    pub column: usize,
}

impl Coding {
    /// Returns the field as queries spell it; a coding of both hands names no hand.
    #[must_use]
    pub fn field(&self) -> Field {
        Field {
            hand: self.hand.and_then(Hands::one),
            component: self.component,
            feature: self.feature.clone(),
            phase: self.phase,
        }
    }
}

fn phase_name<S: serde::Serializer>(phase: &Option<Phase>, out: S) -> Result<S::Ok, S::Error> {
    match phase {
        Some(phase) => out.collect_str(phase),
        None => out.serialize_none(),
    }
}

/// The values that a lexicon uses for one component, or one part of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Inventory {
    /// The component.
    pub component: Component,
    /// The part of it.
    pub feature: Option<String>,
    /// Each value with its number of uses, in alphabetical order.
    pub values: BTreeMap<String, usize>,
}

/// Reads a table of lexicon codings.
///
/// The first row determines the delimiter (tab, comma, semicolon, bar), or a line `sep=;` above it; lines of one cell
/// above the titles are left out with a finding. Quotes, byte-order marks, Windows
/// line ends and UTF-16 are understood; bytes that are not UTF-8 are read as Windows-1252. Rows without a
/// gloss are named by the next column of glosses, or left out, with a finding; findings also name rows of another width, repeated glosses, columns
/// that become attributes and values that look like slips.
///
/// # Errors
/// [`TableError`] if the bytes are not a table or no column is a gloss.
pub fn read(bytes: &[u8], mapping: &Mapping) -> Result<(Lexicon, Vec<Finding>), TableError> {
    let mut findings = Findings::default();
    // Text that only begins as JSON Lines do may be a table.
    let found = slpaa::read(bytes).or_else(|| json::read(bytes).ok().flatten());
    let table = match found {
        Some(table) => table,
        None => {
            let text = decode(bytes, &mut findings)?;
            let above = headings(&text, mapping);
            if above > 0 {
                findings.add("headings above the titles", || left_out(&text, above));
            }
            Cells::read_text(&text, above, false, &mut findings)?
        }
    };
    interpret(table, mapping, findings)
}

/// Returns the meaning of a column with this title, as far as the title says it.
#[must_use]
pub fn meaning_of_title(title: &str) -> Meaning {
    columns::column(title, &Mapping::default()).meaning
}

/// Returns the number of lines above the titles, such as a heading and its date: lines of few cells, if one of the titles
/// below them is that of a gloss.
fn headings(text: &str, mapping: &Mapping) -> u64 {
    const SURE: f64 = 0.9;
    let is_sure = |column: &Column| {
        matches!(column.meaning, Meaning::Gloss { .. }) && column.confidence >= SURE
    };
    let below = |above: u64| {
        let table = Cells::read_text(text, above, false, &mut Findings::default()).ok()?;
        let (lexicon, _) = interpret(table, mapping, Findings::default()).ok()?;
        lexicon.columns.iter().any(is_sure).then_some(above)
    };
    lines_above_titles(text).and_then(below).unwrap_or(0)
}

/// Returns the finding that the lines above the titles were left out.
fn left_out(text: &str, above: u64) -> Finding {
    let lines = text
        .lines()
        .take(usize::try_from(above).unwrap_or(usize::MAX));
    let lines: Vec<&str> = lines
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .collect();
    let (line, texts) = (above + 1, lines.join(" / "));
    Finding::note(
        line,
        format!(
            "the titles of the columns are in line {line}; the text above them was left out: {texts:?}"
        ),
    )
}

/// Reads a lexicon from JSON as [`read`] does; `None` for anything else than JSON of such a form.
///
/// # Errors
/// [`TableError`] if no key is a gloss, or JSON Lines hold anything but an object.
pub fn read_json(
    bytes: &[u8],
    mapping: &Mapping,
) -> Result<Option<(Lexicon, Vec<Finding>)>, TableError> {
    let found = match slpaa::read(bytes) {
        Some(table) => Some(table),
        None => json::read(bytes)?,
    };
    found
        .map(|table| interpret(table, mapping, Findings::default()))
        .transpose()
}

/// Returns the lexicon that a table holds.
fn interpret(
    mut table: Cells,
    mapping: &Mapping,
    mut findings: Findings,
) -> Result<(Lexicon, Vec<Finding>), TableError> {
    without_titles(&mut table, &mut findings);
    let Columns { columns, names } =
        columns::meanings(&table.header, &table.rows, mapping, &mut findings);
    let gloss = *names.first().ok_or_else(|| TableError::Missing {
        found: listed(&table.header),
        needed: "a gloss",
        remedy: "call a column \"gloss\", or name it in a mapping: {\"columns\": {\"NAME\": \"gloss\"}}",
    })?;
    let mut lines: BTreeMap<String, u64> = BTreeMap::new();
    let mut empty = EmptyCells::default();
    let mut entries: Vec<LexiconEntry> = Vec::with_capacity(table.rows.len());
    let mut stand_ins: BTreeMap<usize, (u64, u64)> = BTreeMap::new();
    for row in table.rows {
        let line = row.line;
        let filled = names.iter().find(|at| columns::is_filled(&row, **at));
        let Some(at) = filled.copied() else {
            findings.add("rows without a gloss", || {
                Finding::warning(
                    line,
                    format!("the row has no {}; it was left out", columns[gloss].title),
                )
            });
            continue;
        };
        if at != gloss {
            stand_ins.entry(at).or_insert((0, line)).0 += 1;
        }
        let name = row.cells[at].trim();
        let first = *lines.entry(name.to_owned()).or_insert(line);
        if first != line {
            findings.add("glosses given twice", || {
                Finding::note(
                    line,
                    format!(
                        "the gloss {name:?} stands in line {first} too; this row is kept as another entry of \
                         that sign"
                    ),
                )
                .with_remedy(format!(
                    "if these are two signs, write {:?} and {:?}",
                    format!("{name}-A"),
                    format!("{name}-B")
                ))
            });
        }
        let garbled = |(column, cell): (&Column, &String)| {
            column.meaning == Meaning::Notation && mended(cell).is_some()
        };
        if columns.iter().zip(&row.cells).any(garbled) {
            findings.add("symbols in a wrong encoding", || mended_finding(line));
        }
        entries.push(entry(row, at, &columns, &mut empty));
    }
    for (at, (count, line)) in stand_ins {
        let (title, other) = (&columns[gloss].title, &columns[at].title);
        let message = format!("rows without {title:?} that {other:?} names: {count}");
        findings.push(Finding::note(line, message));
    }
    let lexicon = Lexicon {
        columns,
        entries,
        delimiter: table.delimiter,
    };
    if let Some(finding) = empty.finding() {
        findings.push(finding);
    }
    shapes_of_changes(&lexicon, &mut findings);
    slips(&lexicon, &mut findings);
    Ok((lexicon, findings.finish()))
}

/// Treats a first row that holds HamNoSys as a sign, as in a table without titles.
fn without_titles(table: &mut Cells, findings: &mut Findings) {
    if !table.header.iter().any(|cell| holds_symbols(cell)) {
        return;
    }
    let titles = (1..=table.header.len()).map(|n| format!("column {n}"));
    let cells = std::mem::replace(&mut table.header, titles.collect());
    table.rows.insert(0, Row { line: 1, cells });
    findings.add("no titles", || {
        Finding::warning(
            1,
            "the first row holds HamNoSys: it was taken for a sign, not for titles",
        )
        .with_remedy("write titles above the columns: gloss, hamnosys")
    });
}

/// Writes the original cells of a lexicon as a table.
///
/// # Errors
/// The errors of `out`.
pub fn write(lexicon: &Lexicon, out: impl io::Write) -> io::Result<()> {
    let mut table = csv::WriterBuilder::new()
        .delimiter(lexicon.delimiter)
        .from_writer(out);
    table.write_record(lexicon.columns.iter().map(|column| &column.title))?;
    for entry in &lexicon.entries {
        table.write_record(&entry.cells)?;
    }
    table.flush()
}

impl Lexicon {
    /// Returns the values in use for each component and part of one, so that the table is its own
    /// inventory; values of either hand and of every phase are listed together.
    #[must_use]
    pub fn inventories(&self) -> Vec<Inventory> {
        let mut all: BTreeMap<(Component, Option<&str>), BTreeMap<String, usize>> = BTreeMap::new();
        for coding in self.entries.iter().flat_map(|entry| &entry.codings) {
            if let Some(value) = coding.reading.value() {
                let values = all
                    .entry((coding.component, coding.feature.as_deref()))
                    .or_default();
                *values.entry(value.to_owned()).or_default() += 1;
            }
        }
        all.into_iter()
            .map(|((component, feature), values)| Inventory {
                component,
                feature: feature.map(str::to_owned),
                values,
            })
            .collect()
    }
}

fn entry(row: Row, gloss: usize, columns: &[Column], empty: &mut EmptyCells) -> LexiconEntry {
    let mut entry = LexiconEntry {
        line: row.line,
        gloss: row.cells[gloss].trim().to_owned(),
        translations: Vec::new(),
        codings: Vec::new(),
        notation: None,
        attributes: Vec::new(),
        cells: Vec::new(),
    };
    for (at, (column, cell)) in columns.iter().zip(&row.cells).enumerate() {
        match &column.meaning {
            Meaning::Translation { language } if !["", "-"].contains(&cell.trim()) => {
                let language = language.clone().unwrap_or_default();
                entry.translations.push((language, cell.trim().to_owned()));
            }
            // The blanks of a garbled cell may be parts of symbols.
            Meaning::Notation if !cell.trim().is_empty() && entry.notation.is_none() => {
                entry.notation = Some(in_plain_symbols(cell).trim().to_owned());
            }
            // Signbank writes a dash for what is not set.
            Meaning::Attribute if !["", "-"].contains(&cell.trim()) => {
                entry.attributes.push((column.title.clone(), cell.clone()));
            }
            Meaning::Coding {
                hand,
                component,
                feature,
                phase,
            } => {
                let whole = Coding {
                    hand: *hand,
                    component: *component,
                    feature: feature.clone(),
                    phase: *phase,
                    reading: Reading::Unset,
                    raw: String::new(),
                    column: at,
                };
                values::split(cell, &whole, row.line, &mut entry.codings, empty);
            }
            _ => {}
        }
    }
    begin_before_final(&mut entry.codings);
    entry.cells = row.cells;
    entry
}

/// Makes values without a phase initial where another column gives the same field a final reading, and none an initial
/// one.
fn begin_before_final(codings: &mut [Coding]) {
    let field = |it: &Coding| (it.hand, it.component, it.feature.clone());
    let fields = |phase: Phase| -> Vec<_> {
        let own = codings.iter().filter(|it| it.phase == Some(phase));
        own.map(field).collect()
    };
    let (begun, ended) = (fields(Phase::Initial), fields(Phase::Final));
    if ended.is_empty() {
        return;
    }
    for coding in codings.iter_mut().filter(|it| it.phase.is_none()) {
        let field = field(coding);
        if ended.contains(&field) && !begun.contains(&field) {
            coding.phase = Some(Phase::Initial);
        }
    }
}

/// Reports the handshapes in columns of changes, such as `>S`.
fn shapes_of_changes(lexicon: &Lexicon, findings: &mut Findings) {
    for (at, column) in lexicon.columns.iter().enumerate() {
        let Meaning::Coding {
            feature: Some(feature),
            ..
        } = &column.meaning
        else {
            continue;
        };
        let entries = lexicon.entries.iter().filter_map(|entry| {
            let mut own = entry.codings.iter().filter(|it| it.column == at);
            let shape = own.find(|it| it.feature.as_ref() != Some(feature))?;
            Some((entry, shape))
        });
        let entries: Vec<_> = entries.collect();
        if let Some((entry, shape)) = entries.first() {
            let (title, cell, count) = (&column.title, &entry.cells[at], entries.len());
            let message = format!(
                "cells of {title:?} that name handshapes, such as {cell:?}, were taken for these: {count}"
            );
            findings.push(Finding::note(entry.line, message).with_remedy(format!(
                "search for them as {}={:?}, and for the others as {}.{feature}=*",
                shape.field(),
                shape.raw,
                shape.component
            )));
        }
    }
}

/// Reports rare values that differ from a common one by case or by one letter after the first.
fn slips(lexicon: &Lexicon, findings: &mut Findings) {
    const RARE: usize = 5;
    const MANY: usize = 1000;
    for inventory in lexicon
        .inventories()
        .iter()
        .filter(|it| it.values.len() <= MANY)
    {
        let folded: Vec<(&str, String, usize)> = inventory
            .values
            .iter()
            .map(|(value, uses)| (&**value, fold(value), *uses))
            .collect();
        for (value, plain, count) in folded.iter().filter(|(_, _, count)| *count <= RARE) {
            let common = folded.iter().find(|(other, near, uses)| {
                *uses >= count * 10
                    && other != value
                    && (near == plain || one_letter_off(plain, near))
            });
            let Some((common, _, uses)) = common else {
                continue;
            };
            findings.add("values that may be slips", || {
                let name = Field { hand: None, component: inventory.component, feature: inventory.feature.clone(), phase: None };
                let line = first_line(lexicon, inventory, value);
                Finding::note(line, format!("{name}: {value:?} ({}) and {common:?} ({}) are kept as two values", times(*count), times(*uses)))
                    .with_remedy(Remedy::command(format!("if they are one: chereme inventory CORPUS merge-value INVENTORY {value:?} {common:?}")))
            });
        }
    }
}

fn times(count: usize) -> String {
    match count {
        1 => "once".to_owned(),
        count => format!("{count} times"),
    }
}

/// Returns whether two folded values of six letters or more differ by one letter, which is neither the
/// first nor a digit.
fn one_letter_off(a: &str, b: &str) -> bool {
    let digits = |text: &str| {
        text.chars()
            .filter(char::is_ascii_digit)
            .collect::<String>()
    };
    a.len() >= 6
        && a.len().abs_diff(b.len()) <= 4
        && a.chars().next() == b.chars().next()
        && digits(a) == digits(b)
        && edit_distance(a, b, 1).is_some()
}

fn first_line(lexicon: &Lexicon, inventory: &Inventory, value: &str) -> Option<u64> {
    let uses = |coding: &Coding| {
        coding.component == inventory.component
            && coding.feature == inventory.feature
            && coding.reading.value() == Some(value)
    };
    lexicon
        .entries
        .iter()
        .find(|entry| entry.codings.iter().any(uses))
        .map(|entry| entry.line)
}
