//! The two files that people read: what the folder is, and the lexicon.

use chereme_motion::Side;

use super::notes::{self, CONFIGURATION};
use super::score::{Sign, Take};

/// Signs that are coded but not recorded.
const LEXICON: &str = include_str!("lexicon.csv");

/// Returns the lexicon.
pub(crate) fn lexicon() -> Vec<u8> {
    LEXICON.as_bytes().to_vec()
}

/// Returns the README with the table of signs.
pub(crate) fn readme<'t>(takes: impl Iterator<Item = &'t Take>) -> Vec<u8> {
    let mut rows = String::new();
    for take in takes {
        let spelt = take
            .signs
            .iter()
            .all(|(_, sign)| sign.gloss.starts_with("DS:"));
        if spelt {
            let last = take.signs.last().map_or("", |(_, sign)| sign.gloss);
            let row = [
                "DS:A".to_owned() + " … " + last,
                "the letters".to_owned(),
                String::new(),
                "high-right".to_owned(),
                "hold (J arc, Z zigzag)".to_owned(),
            ];
            rows += &line(take.stem, &row);
        } else if take.phrase.is_some() {
            let glosses: Vec<&str> = take.signs.iter().map(|(_, sign)| sign.gloss).collect();
            rows += &line(
                take.stem,
                &[
                    glosses.join(" "),
                    "as below".to_owned(),
                    "as below".to_owned(),
                    String::new(),
                    String::new(),
                ],
            );
        } else {
            for (_, sign) in &take.signs {
                rows += &line(take.stem, &coding(sign));
            }
        }
    }
    include_str!("README.in.md")
        .replace("{{signs}}", rows.trim_end())
        .into_bytes()
}

fn line(stem: &str, cells: &[String; 5]) -> String {
    format!("| `{stem}` | {} |\n", cells.join(" | "))
}

fn coding(sign: &Sign) -> [String; 5] {
    let notes = notes::of_sign(sign);
    let said = |tier: usize, side: Side| {
        let mut values: Vec<&str> = notes
            .iter()
            .filter(|note| note.tier == tier && note.side == Some(side))
            .map(|note| note.value)
            .collect();
        values.dedup();
        values.join(" > ")
    };
    let moves = [said(2, Side::Right), said(3, Side::Right)];
    [
        format!("{} ({})", sign.gloss, sign.means[1]),
        said(CONFIGURATION, Side::Right),
        said(CONFIGURATION, Side::Left),
        said(1, Side::Right),
        moves.join(" ").trim().to_owned(),
    ]
}
