//! Tables of lexicon codings: one sign per row, one component per column.
//!
//! A column's component is guessed from its title (`schema/column_words.json`) or given by a [`TierMapping`]. Compound
//! cells are split: `neutral space > head` is two successive values, `S + W` two at once, `>S` a final value alone. Beside
//! a final value of another column a value is the initial one. `-` and `N/A` are not applicable, `?` is unclear. A column of HamNoSys, recognised by its title or its symbols, gives
//! the sign's notation. A table may also come as JSON: an array of objects, an object whose keys are the glosses, JSON
//! Lines, or an export of SLP-AA. The original cells are kept together with their meanings, so that [`write_lexicon()`]
//! reproduces the table.
//!
//! ```
//! use chereme_formats::lexicon;
//! use chereme_formats::roles::TierMapping;
//!
//! let text = b"NL gloss\tEN gloss\tHandshape strong\tLocation\nPET\tCAP\tB\tforehead > head\n";
//! let (lexicon, _) = lexicon::read_lexicon(text, &TierMapping::default())?;
//! let codings: Vec<String> = lexicon.entries[0].codings.iter().map(|it| format!("{}={}", it.coding_field(), it.reading)).collect();
//! assert_eq!(codings, ["dominant.configuration=B", "initial.placement=forehead", "final.placement=head"]);
//! # Ok::<(), chereme_formats::table::TableError>(())
//! ```

mod lexicon_columns;
mod lexicon_json;
mod lexicon_values;
mod slpaa;

use chereme_sign::ErrorRemedy;
use lexicon_columns::LexiconTableColumns;
pub use lexicon_columns::{LexiconColumn, LexiconColumnMeaning, short_language_code};

use crate::finding::ImportFinding;
use crate::hns::{holds_symbols, mended_finding};
use crate::roles::{AnnotatedHands, TierMapping};
use crate::table::{TableCells, TableError, TableRow, decode_table_bytes, join_column_names, lines_above_titles};
use crate::tally::FindingTally;
use chereme_sign::hamnosys::{in_plain_symbols, repair_garbled_symbols};
use chereme_sign::text::{edit_distance, fold_text};
use chereme_sign::{ComponentField, ComponentReading, SignComponent, SignPhase};
use lexicon_values::EmptyCells;
pub use lexicon_values::is_value;
use serde::Serialize;
use std::collections::BTreeMap;
use std::io;

/// A table of signs with their component values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SignLexicon {
    /// The columns in order, with their meanings.
    pub columns: Vec<LexiconColumn>,
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
    pub codings: Vec<ComponentCoding>,
    /// The sign as HamNoSys, blanks at its ends left out.
    pub notation: Option<String>,
    /// Other information about the sign, as title and cell; empty cells are left out.
    pub attributes: Vec<(String, String)>,
    /// The original cells, one per column.
    pub cells: Vec<String>,
}

/// A component value of a sign, from a cell or a part of one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ComponentCoding {
    /// The hand; `None` for a value of the sign as a whole.
    pub hand: Option<AnnotatedHands>,
    /// The component.
    pub component: SignComponent,
    /// The part of the component, such as `palm` or `direction`.
    pub feature: Option<String>,
    /// The phase: initial, middle or final.
    #[serde(serialize_with = "phase_name")]
    pub phase: Option<SignPhase>,
    /// The value, or its absence.
    pub reading: ComponentReading,
    /// The part of the cell with the value, as written.
    pub raw: String,
    /// The index of the column, from 0.
    pub column: usize,
}

impl ComponentCoding {
    /// Returns the field as queries spell it; a coding of both hands names no hand.
    #[must_use]
    pub fn coding_field(&self) -> ComponentField {
        ComponentField {
            hand: self.hand.and_then(AnnotatedHands::single_hand),
            component: self.component,
            feature: self.feature.clone(),
            phase: self.phase,
        }
    }
}

fn phase_name<S: serde::Serializer>(phase: &Option<SignPhase>, out: S) -> Result<S::Ok, S::Error> {
    match phase {
        Some(phase) => out.collect_str(phase),
        None => out.serialize_none(),
    }
}

/// The values that a lexicon uses for one component, or one part of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LexiconInventory {
    /// The component.
    pub component: SignComponent,
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
pub fn read_lexicon(bytes: &[u8], mapping: &TierMapping) -> Result<(SignLexicon, Vec<ImportFinding>), TableError> {
    let mut findings = FindingTally::default();
    // Text that only begins as JSON Lines do may be a table.
    let read_table = slpaa::read_slpaa_cells(bytes).or_else(|| lexicon_json::read_json_cells(bytes).ok().flatten());
    let table = match read_table {
        Some(table) => table,
        None => {
            let text = decode_table_bytes(bytes, &mut findings)?;
            let above = headings(&text, mapping);
            if above > 0 {
                findings.add_limited_finding("headings above the titles", || left_out(&text, above));
            }
            TableCells::read_text_cells(&text, above, false, &mut findings)?
        }
    };
    interpret(table, mapping, findings)
}

/// Returns the meaning of a column with this title, as far as the title says it.
#[must_use]
pub fn meaning_of_title(title: &str) -> LexiconColumnMeaning {
    lexicon_columns::column_from_title(title, &TierMapping::default()).meaning
}

/// Returns the number of lines above the titles, such as a heading and its date: lines of few cells, if one of the titles
/// below them is that of a gloss.
fn headings(text: &str, mapping: &TierMapping) -> u64 {
    const SURE_HEADING_SHARE: f64 = 0.9;
    let is_sure = |column: &LexiconColumn| {
        matches!(column.meaning, LexiconColumnMeaning::Gloss { .. }) && column.confidence >= SURE_HEADING_SHARE
    };
    let below = |above: u64| {
        let table = TableCells::read_text_cells(text, above, false, &mut FindingTally::default()).ok()?;
        let (lexicon, _) = interpret(table, mapping, FindingTally::default()).ok()?;
        lexicon.columns.iter().any(is_sure).then_some(above)
    };
    lines_above_titles(text).and_then(below).unwrap_or(0)
}

/// Returns the finding that the lines above the titles were left out.
fn left_out(text: &str, above: u64) -> ImportFinding {
    let above_lines = text.lines().take(usize::try_from(above).unwrap_or(usize::MAX));
    let lines: Vec<&str> = above_lines.map(str::trim).filter(|line| !line.is_empty()).collect();
    let (line, texts) = (above + 1, lines.join(" / "));
    ImportFinding::new_note_finding(
        line,
        format!("the titles of the columns are in line {line}; the text above them was left out: {texts:?}"),
    )
}

/// Reads a lexicon from JSON as [`read_lexicon`] does; `None` for anything else than JSON of such a form.
///
/// # Errors
/// [`TableError`] if no key is a gloss, or JSON Lines hold anything but an object.
pub fn read_json(bytes: &[u8], mapping: &TierMapping) -> Result<Option<(SignLexicon, Vec<ImportFinding>)>, TableError> {
    let read_table = match slpaa::read_slpaa_cells(bytes) {
        Some(table) => Some(table),
        None => lexicon_json::read_json_cells(bytes)?,
    };
    read_table
        .map(|table| interpret(table, mapping, FindingTally::default()))
        .transpose()
}

/// Returns the lexicon that a table holds.
fn interpret(
    mut table: TableCells,
    mapping: &TierMapping,
    mut findings: FindingTally,
) -> Result<(SignLexicon, Vec<ImportFinding>), TableError> {
    without_titles(&mut table, &mut findings);
    let LexiconTableColumns { columns, names } =
        lexicon_columns::infer_column_meanings(&table.header, &table.rows, mapping, &mut findings);
    let gloss = *names.first().ok_or_else(|| TableError::Missing {
        found: join_column_names(&table.header),
        needed: "a gloss",
        remedy: "call a column \"gloss\", or name it in a mapping: {\"columns\": {\"NAME\": \"gloss\"}}",
    })?;
    let mut empty = EmptyCells::default();
    let mut entries: Vec<LexiconEntry> = Vec::with_capacity(table.rows.len());
    let mut stand_ins: BTreeMap<usize, (u64, u64)> = BTreeMap::new();
    for row in table.rows {
        let line = row.line;
        let filled = names.iter().find(|at| lexicon_columns::is_filled(&row, **at));
        let Some(at) = filled.copied() else {
            findings.add_limited_warning("rows without a gloss", line, || {
                format!("the row has no {}; it was left out", columns[gloss].title)
            });
            continue;
        };
        if at != gloss {
            stand_ins.entry(at).or_insert((0, line)).0 += 1;
        }
        let garbled = |(column, cell): (&LexiconColumn, &String)| {
            column.meaning == LexiconColumnMeaning::Notation && repair_garbled_symbols(cell).is_some()
        };
        if columns.iter().zip(&row.cells).any(garbled) {
            findings.add_limited_finding("symbols in a wrong encoding", || mended_finding(line));
        }
        entries.push(entry_from_row(row, at, &columns, &mut empty));
    }
    for (at, (count, line)) in stand_ins {
        let (title, other) = (&columns[gloss].title, &columns[at].title);
        let message = format!("rows without {title:?} that {other:?} names: {count}");
        findings.push_note_finding(line, message);
    }
    let lexicon = SignLexicon {
        columns,
        entries,
        delimiter: table.delimiter,
    };
    if let Some(finding) = empty.empty_cells_finding() {
        findings.push_counted_finding(finding);
    }
    shapes_of_changes(&lexicon, &mut findings);
    report_value_slips(&lexicon, &mut findings);
    Ok((lexicon, findings.finish_finding_tally()))
}

/// Treats a first row that holds HamNoSys as a sign, as in a table without titles.
fn without_titles(table: &mut TableCells, findings: &mut FindingTally) {
    if !table.header.iter().any(|cell| holds_symbols(cell)) {
        return;
    }
    let titles = (1..=table.header.len()).map(|n| format!("column {n}"));
    let cells = std::mem::replace(&mut table.header, titles.collect());
    table.rows.insert(0, TableRow { line: 1, cells });
    findings.add_limited_finding("no titles", || {
        ImportFinding::new_warning_finding(
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
pub fn write_lexicon(lexicon: &SignLexicon, out: impl io::Write) -> io::Result<()> {
    let mut table = csv::WriterBuilder::new().delimiter(lexicon.delimiter).from_writer(out);
    table.write_record(lexicon.columns.iter().map(|column| &column.title))?;
    for entry in &lexicon.entries {
        table.write_record(&entry.cells)?;
    }
    table.flush()
}

impl SignLexicon {
    /// Returns the values in use for each component and part of one, so that the table is its own
    /// inventory; values of either hand and of every phase are listed together.
    #[must_use]
    pub fn component_inventories(&self) -> Vec<LexiconInventory> {
        let mut all: BTreeMap<(SignComponent, Option<&str>), BTreeMap<String, usize>> = BTreeMap::new();
        for coding in self.entries.iter().flat_map(|entry| &entry.codings) {
            if let Some(value) = coding.reading.reading_value() {
                let values = all.entry((coding.component, coding.feature.as_deref())).or_default();
                *values.entry(value.to_owned()).or_default() += 1;
            }
        }
        all.into_iter()
            .map(|((component, feature), values)| LexiconInventory {
                component,
                feature: feature.map(str::to_owned),
                values,
            })
            .collect()
    }
}

fn entry_from_row(row: TableRow, gloss: usize, columns: &[LexiconColumn], empty: &mut EmptyCells) -> LexiconEntry {
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
            LexiconColumnMeaning::Translation { language } if !["", "-"].contains(&cell.trim()) => {
                let language = language.clone().unwrap_or_default();
                entry.translations.push((language, cell.trim().to_owned()));
            }
            // The blanks of a garbled cell may be parts of symbols.
            LexiconColumnMeaning::Notation if !cell.trim().is_empty() && entry.notation.is_none() => {
                entry.notation = Some(in_plain_symbols(cell).trim().to_owned());
            }
            // Signbank writes a dash for what is not set.
            LexiconColumnMeaning::Attribute if !["", "-"].contains(&cell.trim()) => {
                entry.attributes.push((column.title.clone(), cell.clone()));
            }
            LexiconColumnMeaning::Coding {
                hand,
                component,
                feature,
                phase,
            } => {
                let whole_coding = ComponentCoding {
                    hand: *hand,
                    component: *component,
                    feature: feature.clone(),
                    phase: *phase,
                    reading: ComponentReading::Unset,
                    raw: String::new(),
                    column: at,
                };
                lexicon_values::split_cell_codings(cell, &whole_coding, row.line, &mut entry.codings, empty);
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
fn begin_before_final(codings: &mut [ComponentCoding]) {
    let field = |coding: &ComponentCoding| (coding.hand, coding.component, coding.feature.clone());
    let fields = |phase: SignPhase| -> Vec<_> {
        let phase_codings = codings.iter().filter(|coding| coding.phase == Some(phase));
        phase_codings.map(field).collect()
    };
    let (begun, ended) = (fields(SignPhase::Initial), fields(SignPhase::Final));
    if ended.is_empty() {
        return;
    }
    for coding in codings.iter_mut().filter(|coding| coding.phase.is_none()) {
        let field = field(coding);
        if ended.contains(&field) && !begun.contains(&field) {
            coding.phase = Some(SignPhase::Initial);
        }
    }
}

/// Reports the handshapes in columns of changes, such as `>S`.
fn shapes_of_changes(lexicon: &SignLexicon, findings: &mut FindingTally) {
    for (at, column) in lexicon.columns.iter().enumerate() {
        let LexiconColumnMeaning::Coding {
            feature: Some(feature), ..
        } = &column.meaning
        else {
            continue;
        };
        let entries = lexicon.entries.iter().filter_map(|entry| {
            let mut column_codings = entry.codings.iter().filter(|coding| coding.column == at);
            let shape = column_codings.find(|coding| coding.feature.as_ref() != Some(feature))?;
            Some((entry, shape))
        });
        let entries: Vec<_> = entries.collect();
        if let Some((entry, shape)) = entries.first() {
            let (title, cell, count) = (&column.title, &entry.cells[at], entries.len());
            let message =
                format!("cells of {title:?} that name handshapes, such as {cell:?}, were taken for these: {count}");
            findings.push_counted_finding(
                ImportFinding::new_note_finding(entry.line, message).with_remedy(format!(
                    "search for them as {}={:?}, and for the others as {}.{feature}=*",
                    shape.coding_field(),
                    shape.raw,
                    shape.component
                )),
            );
        }
    }
}

/// Reports rare values that differ from a common one by case or by one letter after the first.
fn report_value_slips(lexicon: &SignLexicon, findings: &mut FindingTally) {
    const MAX_RARE_USES: usize = 5;
    const MAX_CHECKED_VALUES: usize = 1000;
    for inventory in lexicon
        .component_inventories()
        .iter()
        .filter(|inventory| inventory.values.len() <= MAX_CHECKED_VALUES)
    {
        let folded: Vec<(&str, String, usize)> = inventory
            .values
            .iter()
            .map(|(value, uses)| (&**value, fold_text(value), *uses))
            .collect();
        for (value, plain, count) in folded.iter().filter(|(_, _, count)| *count <= MAX_RARE_USES) {
            let common = folded.iter().find(|(other, near, uses)| {
                // A slip is rare beside the value that was meant; two usual values are two values.
                *uses >= count * 10 && other != value && (near == plain || one_letter_off(plain, near))
            });
            let Some((common, _, uses)) = common else {
                continue;
            };
            findings.add_limited_finding("values that may be slips", || {
                let name = ComponentField {
                    hand: None,
                    component: inventory.component,
                    feature: inventory.feature.clone(),
                    phase: None,
                };
                let line = first_line(lexicon, inventory, value);
                ImportFinding::new_note_finding(
                    line,
                    format!(
                        "{name}: {value:?} ({}) and {common:?} ({}) are kept as two values",
                        count_of_times(*count),
                        count_of_times(*uses)
                    ),
                )
                .with_remedy(ErrorRemedy::command_remedy(format!(
                    "if they are one: chereme inventory CORPUS merge-value INVENTORY {value:?} {common:?}"
                )))
            });
        }
    }
}

fn count_of_times(count: usize) -> String {
    match count {
        1 => "once".to_owned(),
        count => format!("{count} times"),
    }
}

/// Returns whether two folded values of six letters or more differ by one letter, which is neither the
/// first nor a digit.
fn one_letter_off(a: &str, b: &str) -> bool {
    let digits = |text: &str| text.chars().filter(char::is_ascii_digit).collect::<String>();
    a.len() >= 6
        && a.len().abs_diff(b.len()) <= 4
        && a.chars().next() == b.chars().next()
        && digits(a) == digits(b)
        && edit_distance(a, b, 1).is_some()
}

fn first_line(lexicon: &SignLexicon, inventory: &LexiconInventory, value: &str) -> Option<u64> {
    let uses = |coding: &ComponentCoding| {
        coding.component == inventory.component
            && coding.feature == inventory.feature
            && coding.reading.reading_value() == Some(value)
    };
    lexicon
        .entries
        .iter()
        .find(|entry| entry.codings.iter().any(uses))
        .map(|entry| entry.line)
}
