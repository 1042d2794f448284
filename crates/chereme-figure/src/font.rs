//! A small bitmap font for labels: five dots wide, drawn for this crate, as data.

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::letters;

/// The width of a character's cell in dots, with the gap after it.
pub(crate) const CELL_WIDTH_DOTS: usize = 6;
/// The height of a character's cell in dots, accents and descenders included.
pub(crate) const CELL_HEIGHT_DOTS: usize = 12;

/// The row of a cell at which capitals and digits begin.
const CAPITAL_TOP_ROW: usize = 3;

/// The characters of the font except accented letters, one a line: seven rows of five dots from the top, the leftmost dot the
/// highest bit. The letters g, j, p, q and y lie two rows lower.
static GLYPH_ROWS: LazyLock<HashMap<char, [u8; 7]>> = LazyLock::new(|| {
    let lines = include_str!("font_glyphs.txt").lines();
    let glyphs = lines.filter_map(|line| {
        let character = line.chars().next()?;
        let numbers = line[character.len_utf8()..].split_whitespace();
        let rows: Vec<u8> = numbers.filter_map(|row| u8::from_str_radix(row, 16).ok()).collect();
        Some((character, rows.try_into().ok()?))
    });
    glyphs.collect()
});

/// Two rows of an accent over a letter; the cedilla's go under it.
const GRAVE_ACCENT: [u8; 2] = [0x08, 0x04];
const ACUTE_ACCENT: [u8; 2] = [0x02, 0x04];
const CIRCUMFLEX_ACCENT: [u8; 2] = [0x04, 0x0A];
const TILDE_ACCENT: [u8; 2] = [0x0D, 0x16];
const DIAERESIS_ACCENT: [u8; 2] = [0x00, 0x0A];
const RING_ACCENT: [u8; 2] = [0x0C, 0x0C];
const CEDILLA_ACCENT: [u8; 2] = [0x04, 0x0C];

/// Accented letters as the letter and its accent.
#[rustfmt::skip]
const ACCENTED_LETTERS: &[(char, char, [u8; 2])] = &[
    ('À', 'A', GRAVE_ACCENT), ('Á', 'A', ACUTE_ACCENT), ('Â', 'A', CIRCUMFLEX_ACCENT), ('Ã', 'A', TILDE_ACCENT), ('Ä', 'A', DIAERESIS_ACCENT), ('Å', 'A', RING_ACCENT),
    ('Ç', 'C', CEDILLA_ACCENT),
    ('È', 'E', GRAVE_ACCENT), ('É', 'E', ACUTE_ACCENT), ('Ê', 'E', CIRCUMFLEX_ACCENT), ('Ë', 'E', DIAERESIS_ACCENT),
    ('Ì', 'I', GRAVE_ACCENT), ('Í', 'I', ACUTE_ACCENT), ('Î', 'I', CIRCUMFLEX_ACCENT), ('Ï', 'I', DIAERESIS_ACCENT),
    ('Ñ', 'N', TILDE_ACCENT),
    ('Ò', 'O', GRAVE_ACCENT), ('Ó', 'O', ACUTE_ACCENT), ('Ô', 'O', CIRCUMFLEX_ACCENT), ('Õ', 'O', TILDE_ACCENT), ('Ö', 'O', DIAERESIS_ACCENT),
    ('Ù', 'U', GRAVE_ACCENT), ('Ú', 'U', ACUTE_ACCENT), ('Û', 'U', CIRCUMFLEX_ACCENT), ('Ü', 'U', DIAERESIS_ACCENT),
    ('Ý', 'Y', ACUTE_ACCENT), ('Ÿ', 'Y', DIAERESIS_ACCENT),
    ('à', 'a', GRAVE_ACCENT), ('á', 'a', ACUTE_ACCENT), ('â', 'a', CIRCUMFLEX_ACCENT), ('ã', 'a', TILDE_ACCENT), ('ä', 'a', DIAERESIS_ACCENT), ('å', 'a', RING_ACCENT),
    ('ç', 'c', CEDILLA_ACCENT),
    ('è', 'e', GRAVE_ACCENT), ('é', 'e', ACUTE_ACCENT), ('ê', 'e', CIRCUMFLEX_ACCENT), ('ë', 'e', DIAERESIS_ACCENT),
    ('ì', 'ı', GRAVE_ACCENT), ('í', 'ı', ACUTE_ACCENT), ('î', 'ı', CIRCUMFLEX_ACCENT), ('ï', 'ı', DIAERESIS_ACCENT),
    ('ñ', 'n', TILDE_ACCENT),
    ('ò', 'o', GRAVE_ACCENT), ('ó', 'o', ACUTE_ACCENT), ('ô', 'o', CIRCUMFLEX_ACCENT), ('õ', 'o', TILDE_ACCENT), ('ö', 'o', DIAERESIS_ACCENT),
    ('ù', 'u', GRAVE_ACCENT), ('ú', 'u', ACUTE_ACCENT), ('û', 'u', CIRCUMFLEX_ACCENT), ('ü', 'u', DIAERESIS_ACCENT),
    ('ý', 'y', ACUTE_ACCENT), ('ÿ', 'y', DIAERESIS_ACCENT),
];

/// The glyph for unknown characters.
const UNKNOWN_GLYPH: [u8; 7] = [0x1F, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1F];

/// Returns whether this font has a character.
pub(crate) fn has_font_glyph(character: char) -> bool {
    ACCENTED_LETTERS.iter().any(|entry| entry.0 == character) || find_known_glyph(character).is_some()
}

/// Returns the width of `text` in dots, without the gap after its last character.
pub(crate) fn text_width_dots(text: &str) -> usize {
    letters::lay_out_line(text).line_width_dots()
}

/// Returns `text` cut to a width of `dots` dots, with an ellipsis at its end if something is left out.
pub(crate) fn fit_text_width(text: &str, dots: usize) -> String {
    // Marks have no width; a text with more marks than letters is not text.
    let most = dots.saturating_mul(2) + 1;
    let beginning = |count: usize| text.chars().take(count).collect::<String>();
    if text.chars().nth(most).is_none() && text_width_dots(text) <= dots {
        return text.to_owned();
    }
    let cut = |count: usize| beginning(count) + "…";
    let (mut low, mut high) = (0, text.chars().take(most).count());
    // Widths grow with the number of characters, so that halving finds the longest that fits.
    while low < high {
        let middle = (low + high).div_ceil(2);
        if text_width_dots(&cut(middle)) <= dots {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    cut(low)
}

/// Calls `dot` with column and row of every dot of `text` on one line.
pub(crate) fn draw_text_dots(text: &str, mut dot: impl FnMut(usize, usize)) {
    for (index, character) in text.chars().enumerate() {
        for (row, bits) in glyph_cell(character).into_iter().enumerate() {
            for column in (0..5).filter(|column| bits & (0x10 >> column) != 0) {
                dot(index * CELL_WIDTH_DOTS + column, row);
            }
        }
    }
}

/// Returns the rows of a character's cell.
fn glyph_cell(character: char) -> [u8; CELL_HEIGHT_DOTS] {
    if let Some(&(_, letter, accent)) = ACCENTED_LETTERS.iter().find(|entry| entry.0 == character) {
        let mut rows = glyph_cell(letter);
        // Accents sit right on the letter: small letters begin two rows lower than capitals.
        let accent_top = match (accent, letter.is_uppercase()) {
            (CEDILLA_ACCENT, _) => CAPITAL_TOP_ROW + 7,
            (_, true) => CAPITAL_TOP_ROW - 3,
            (_, false) => CAPITAL_TOP_ROW - 1,
        };
        rows[accent_top] |= accent[0];
        rows[accent_top + 1] |= accent[1];
        return rows;
    }
    // These letters have their stems below the line.
    let down = usize::from("gpqyj".contains(character)) * 2;
    let mut rows = [0; CELL_HEIGHT_DOTS];
    rows[CAPITAL_TOP_ROW + down..CAPITAL_TOP_ROW + down + 7].copy_from_slice(&glyph(character));
    // The dot of j stays where that of i is, though its stem is lower.
    if character == 'j' {
        rows[CAPITAL_TOP_ROW] = 0x02;
        rows[CAPITAL_TOP_ROW + 1..CAPITAL_TOP_ROW + 3].copy_from_slice(&[0x00, 0x06]);
    }
    rows
}

fn glyph(character: char) -> [u8; 7] {
    find_known_glyph(character).unwrap_or(UNKNOWN_GLYPH)
}

fn find_known_glyph(character: char) -> Option<[u8; 7]> {
    GLYPH_ROWS.get(&character).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_letter_of_latin_1_and_french_has_its_own_form() {
        let letters = ('!'..='~').chain('À'..='ÿ').chain("ŒœŸ«»’…€".chars());
        let mut seen = std::collections::BTreeMap::new();
        for letter in letters {
            let rows = glyph_cell(letter);
            assert_ne!(glyph(letter), [0; 7], "{letter} is empty");
            if !['’', '\''].contains(&letter) {
                let earlier = seen.insert(rows, letter);
                assert_eq!(earlier, None, "{letter} looks like another");
            }
        }
        assert_eq!(glyph('漢'), UNKNOWN_GLYPH);
    }

    #[test]
    fn long_text_is_cut_to_fit() {
        assert_eq!(fit_text_width("ESCARGOT", 47), "ESCARGOT");
        assert_eq!(fit_text_width("ESCARGOT", 46), "ESCARG…");
        assert!(text_width_dots(&fit_text_width("ESCARGOT", 20)) <= 20);
        assert_eq!(fit_text_width("A", 0), "…");
    }
}
