//! Splits a cell into its values.

use super::Coding;
use chereme_sign::text::fold;
use chereme_sign::{Component, Phase, Reading};

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

/// Adds the values of `cell` to `codings`, each like `whole` with its own phase, feature and reading.
///
/// `A > B > C` is initial, middle and final; `> C` final alone and `A >` initial alone. `a + b` is two
/// simultaneous values, and so is `a, b` if a value is a word: in movement, orientation and changes of
/// configuration, not in handshapes and places.
pub(super) fn split(cell: &str, whole: &Coding, codings: &mut Vec<Coding>) {
    if cell.trim().is_empty() {
        return;
    }
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
