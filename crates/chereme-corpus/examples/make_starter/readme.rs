//! The two files for readers: the description of the folder, and the lexicon.

use chereme_motion::BodySide;

use super::notes::{CONFIGURATION, DIRECTION, MOVEMENT, Note, PLACEMENT};
use super::takes::Take;

/// Signs that are coded but not recorded.
const LEXICON: &str = include_str!("lexicon.csv");

/// Returns the lexicon.
pub(crate) fn lexicon() -> Vec<u8> {
    LEXICON.as_bytes().to_vec()
}

/// Returns the README with the table of signs and their notation.
pub(crate) fn readme<'t>(takes: impl Iterator<Item = (&'t Take, &'t Vec<Note>)>) -> Vec<u8> {
    let (mut rows, mut notation) = (String::new(), String::new());
    for (take, notes) in takes {
        let glosses: Vec<&str> = take.signs.iter().map(|sign| &*sign.gloss).collect();
        let spelt = glosses.iter().all(|gloss| gloss.starts_with("DS:"));
        if take.phrase.is_some() {
            let cells = [&glosses.join(" "), "as alone", "as alone", "", ""];
            rows += &line(take.stem, &cells.map(str::to_owned));
            continue;
        }
        if spelt {
            let all = [glosses[0], glosses[glosses.len() - 1]].join(" … ");
            let cells = [&all, "the letters", "", "high-right, right", "hold (J arc, Z zigzag)"];
            rows += &line(take.stem, &cells.map(str::to_owned));
        }
        for (n, sign) in take.signs.iter().enumerate() {
            if !spelt {
                rows += &line(take.stem, &coding(&sign.gloss, sign.means[1], n, notes));
            }
            notation += &format!("- {}: `{}`\n", sign.gloss, sign.hamnosys());
        }
    }
    include_str!("README.in.md")
        .replace("{{signs}}", rows.trim_end())
        .replace("{{notation}}", notation.trim_end())
        .into_bytes()
}

fn line(stem: &str, cells: &[String; 5]) -> String {
    format!("| `{stem}` | {} |\n", cells.join(" | "))
}

fn coding(gloss: &str, means: &str, sign: usize, notes: &[Note]) -> [String; 5] {
    let said = |tier: usize, side: BodySide| {
        let mut values: Vec<&str> = notes
            .iter()
            .filter(|note| (note.sign, note.tier, note.side) == (sign, tier, Some(side)))
            .map(|note| &*note.value)
            .collect();
        values.dedup();
        values.join(" > ")
    };
    let moves = [said(MOVEMENT, BodySide::Right), said(DIRECTION, BodySide::Right)];
    [
        format!("{gloss} ({means})"),
        said(CONFIGURATION, BodySide::Right),
        said(CONFIGURATION, BodySide::Left),
        said(PLACEMENT, BodySide::Right),
        moves.join(" ").trim().to_owned(),
    ]
}
