//! Splits a cell into its values.

use super::ComponentCoding;
use crate::finding::ImportFinding;
use chereme_sign::text::fold_text;
use chereme_sign::{ComponentReading, SignComponent, SignPhase};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Actions of fingers during a sign; in a handshape column such a word is a change, not a shape.
const FINGER_CHANGE_WORDS: [&str; 14] = [
    "closing",
    "opening",
    "wiggle",
    "wiggling",
    "bending",
    "curving",
    "spreading",
    "unspreading",
    "extension",
    "extending",
    "folding",
    "hooking",
    "rubbing",
    "flattening",
];

/// The texts that programs write into a cell without a value: pandas, databases, Python, and Excel with its faults.
const EMPTY_CELL_TEXTS: [&str; 13] = [
    "nan", "NaN", "NaT", "NULL", "null", "None", "<NA>", "#N/A", "#REF!", "#VALUE!", "#NAME?", "#DIV/0!", "#NUM!",
];

/// Returns whether a piece of a cell is what a program writes for no value. `None` of a movement or a contact is a value:
/// there is no path, or no contact.
fn is_empty(piece: &str, whole: &ComponentCoding) -> bool {
    let none = whole.component == SignComponent::Movement || whole.feature.as_deref() == Some("contact");
    EMPTY_CELL_TEXTS.contains(&piece) && !(piece == "None" && none)
}

/// Returns whether a cell of a component holds a value, rather than nothing, `NA` or `?`.
#[must_use]
pub fn is_value(cell: &str) -> bool {
    let cell = cell.trim();
    !cell.is_empty()
        && !EMPTY_CELL_TEXTS.contains(&cell)
        && matches!(reading_of_piece(cell), ComponentReading::Value(_))
}

/// The cells that hold what a program writes for no value: each such text with its number and its first line.
#[derive(Default)]
pub(super) struct EmptyCells(BTreeMap<String, (u64, u64)>);

impl EmptyCells {
    fn count_empty_cell(&mut self, text: &str, line: u64) {
        self.0.entry(text.to_owned()).or_insert((0, line)).0 += 1;
    }

    /// Returns one finding that counts the cells.
    pub(super) fn empty_cells_finding(self) -> Option<ImportFinding> {
        let first = self.0.values().map(|(_, line)| *line).min()?;
        let counted = |(text, (count, _)): (&String, &(u64, u64))| match count {
            1 => format!("{text:?} once"),
            count => format!("{text:?} {count} times"),
        };
        let texts: Vec<String> = self.0.iter().map(counted).collect();
        let message = format!(
            "values that programs write for an empty cell were taken as unset: {}",
            texts.join(", ")
        );
        Some(
            ImportFinding::new_note_finding(first, message)
                .with_remedy("if one of them is a value of the component, write it in another spelling in the table"),
        )
    }
}

/// Returns a cell in which `->`, `→` and other arrows between successive values are written `>`.
fn with_plain_arrows(cell: &str) -> Cow<'_, str> {
    const ARROW_SPELLINGS: [&str; 8] = ["-->", "->", "=>", "→", "⟶", "➔", "➜", "⇒"];
    if !ARROW_SPELLINGS.iter().any(|arrow| cell.contains(arrow)) {
        return cell.into();
    }
    let plain = |cell: String, arrow: &&str| cell.replace(arrow, " > ");
    ARROW_SPELLINGS.iter().fold(cell.to_owned(), plain).into()
}

/// Adds the values of `cell` to `codings`, each like `whole` with its own phase, feature and reading; counts what
/// programs write for no value.
///
/// `A > B > C` is initial, middle and final; `> C` final alone and `A >` initial alone; an arrow is like `>`. `a + b` is two
/// simultaneous values, and so is `a, b` if a value is a word: in movement, orientation and changes of
/// configuration, not in handshapes and places.
pub(super) fn split_cell_codings(
    cell: &str,
    whole: &ComponentCoding,
    line: u64,
    codings: &mut Vec<ComponentCoding>,
    empty: &mut EmptyCells,
) {
    if cell.trim().is_empty() {
        return;
    }
    let cell = &*with_plain_arrows(cell);
    let parts: Vec<&str> = cell.split('>').collect();
    let change = whole.feature.as_deref() == Some("change");
    for (n, part) in parts.iter().enumerate() {
        let phase = match (parts.len(), n) {
            (1, _) => whole.phase,
            (_, 0) => Some(SignPhase::Initial),
            (count, n) if n + 1 == count => Some(SignPhase::Final),
            (_, n) => Some(SignPhase::Middle(u8::try_from(n).unwrap_or(u8::MAX))),
        };
        for piece in split_cell_pieces(part, whole) {
            if is_empty(piece, whole) {
                empty.count_empty_cell(piece, line);
                continue;
            }
            let mut coding = ComponentCoding {
                phase,
                reading: reading_of_piece(piece),
                raw: piece.to_owned(),
                ..whole.clone()
            };
            let shape = whole.component == SignComponent::Configuration;
            let changing = FINGER_CHANGE_WORDS.contains(&&*fold_text(piece));
            if shape && whole.feature.is_none() && changing {
                coding.feature = Some("change".to_owned());
            } else if change && parts.len() > 1 && !changing {
                coding.feature = None;
            }
            codings.push(coding);
        }
    }
}

fn split_cell_pieces<'c>(part: &'c str, whole: &ComponentCoding) -> Vec<&'c str> {
    let words = match whole.component {
        SignComponent::Movement | SignComponent::Orientation => true,
        SignComponent::Configuration => whole.feature.as_deref() == Some("change"),
        SignComponent::Placement | SignComponent::NonManual => false,
    };
    let shape = whole.component == SignComponent::Configuration && whole.feature.is_none();
    let ends_in_change = shape
        && part
            .rsplit(',')
            .next()
            .is_some_and(|last| FINGER_CHANGE_WORDS.contains(&&*fold_text(last.trim())));
    let cut = |c: char| c == '+' || (c == ',' && (words || ends_in_change));
    part.split(cut)
        .map(str::trim)
        .filter(|piece| !piece.is_empty())
        .collect()
}

fn reading_of_piece(piece: &str) -> ComponentReading {
    match &*fold_text(piece) {
        "-" | "n/a" | "na" | "not applicable" => ComponentReading::NotApplicable,
        "?" | "unclear" | "unknown" => ComponentReading::Unclear,
        _ => ComponentReading::Value(piece.to_owned()),
    }
}
