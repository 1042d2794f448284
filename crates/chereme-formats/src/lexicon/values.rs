//! Splits a cell into its values.

use super::Coding;
use crate::finding::Finding;
use chereme_sign::text::fold;
use chereme_sign::{Component, Phase, Reading};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Actions of fingers during a sign; in a handshape column such a word is a change, not a shape.
const CHANGES: [&str; 14] = [
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
const EMPTY: [&str; 13] = [
    "nan", "NaN", "NaT", "NULL", "null", "None", "<NA>", "#N/A", "#REF!", "#VALUE!", "#NAME?",
    "#DIV/0!", "#NUM!",
];

/// Returns whether a piece of a cell is what a program writes for no value. `None` of a movement or a contact is a value:
/// there is no path, or no contact.
fn is_empty(piece: &str, whole: &Coding) -> bool {
    let none =
        whole.component == Component::Movement || whole.feature.as_deref() == Some("contact");
    EMPTY.contains(&piece) && !(piece == "None" && none)
}

/// Returns whether a cell of a component holds a value, rather than nothing, `NA` or `?`.
#[must_use]
pub fn is_value(cell: &str) -> bool {
    let cell = cell.trim();
    !cell.is_empty() && !EMPTY.contains(&cell) && matches!(reading(cell), Reading::Value(_))
}

/// The cells that hold what a program writes for no value: each such text with its number and its first line.
#[derive(Default)]
pub(super) struct EmptyCells(BTreeMap<String, (u64, u64)>);

impl EmptyCells {
    fn count(&mut self, text: &str, line: u64) {
        self.0.entry(text.to_owned()).or_insert((0, line)).0 += 1;
    }

    /// Returns one finding that counts the cells.
    pub(super) fn finding(self) -> Option<Finding> {
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
        Some(Finding::note(first, message).with_remedy(
            "if one of them is a value of the component, write it in another spelling in the table",
        ))
    }
}

/// Returns a cell in which `->`, `→` and other arrows between successive values are written `>`.
fn with_plain_arrows(cell: &str) -> Cow<'_, str> {
    const ARROWS: [&str; 8] = ["-->", "->", "=>", "→", "⟶", "➔", "➜", "⇒"];
    if !ARROWS.iter().any(|arrow| cell.contains(arrow)) {
        return cell.into();
    }
    let plain = |cell: String, arrow: &&str| cell.replace(arrow, " > ");
    ARROWS.iter().fold(cell.to_owned(), plain).into()
}

/// Adds the values of `cell` to `codings`, each like `whole` with its own phase, feature and reading; counts what
/// programs write for no value.
///
/// `A > B > C` is initial, middle and final; `> C` final alone and `A >` initial alone; an arrow is like `>`. `a + b` is two
/// simultaneous values, and so is `a, b` if a value is a word: in movement, orientation and changes of
/// configuration, not in handshapes and places.
pub(super) fn split(
    cell: &str,
    whole: &Coding,
    line: u64,
    codings: &mut Vec<Coding>,
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
            (_, 0) => Some(Phase::Initial),
            (count, n) if n + 1 == count => Some(Phase::Final),
            (_, n) => Some(Phase::Middle(u8::try_from(n).unwrap_or(u8::MAX))),
        };
        for piece in pieces(part, whole) {
            if is_empty(piece, whole) {
                empty.count(piece, line);
                continue;
            }
            let mut coding = Coding {
                phase,
                reading: reading(piece),
                raw: piece.to_owned(),
                ..whole.clone()
            };
            let shape = whole.component == Component::Configuration;
            let changing = CHANGES.contains(&&*fold(piece));
            if shape && whole.feature.is_none() && changing {
                coding.feature = Some("change".to_owned());
            } else if change && parts.len() > 1 && !changing {
                coding.feature = None;
            }
            codings.push(coding);
        }
    }
}

fn pieces<'c>(part: &'c str, whole: &Coding) -> Vec<&'c str> {
    let words = match whole.component {
        Component::Movement | Component::Orientation => true,
        Component::Configuration => whole.feature.as_deref() == Some("change"),
        Component::Placement | Component::NonManual => false,
    };
    let shape = whole.component == Component::Configuration && whole.feature.is_none();
    let ends_in_change = shape
        && part
            .rsplit(',')
            .next()
            .is_some_and(|last| CHANGES.contains(&&*fold(last.trim())));
    let cut = |c: char| c == '+' || (c == ',' && (words || ends_in_change));
    part.split(cut)
        .map(str::trim)
        .filter(|piece| !piece.is_empty())
        .collect()
}

fn reading(piece: &str) -> Reading {
    match &*fold(piece) {
        "-" | "n/a" | "na" | "not applicable" => Reading::NotApplicable,
        "?" | "unclear" | "unknown" => Reading::Unclear,
        _ => Reading::Value(piece.to_owned()),
    }
}
