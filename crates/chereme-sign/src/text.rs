//! Compares words as people do: without regard to case and accents, and with tolerance for slips.

use std::borrow::Cow;

use unicode_normalization::{UnicodeNormalization, is_nfc};

/// Returns `text` without differences of case, accent, width and typographic punctuation.
///
/// `ÉCOLE` and `école` become `ecole`, `œuf` becomes `oeuf`, curly quotes and long dashes become
/// plain ones. Compatibility forms (`ﬁ`, `²`, full-width letters) become the characters that they stand for.
/// Blanks stay, except that every kind of blank becomes a space. Folding twice changes nothing.
#[must_use]
pub fn fold_text(text: &str) -> String {
    let mut folded = String::with_capacity(text.len());
    for c in text.nfkd().filter(|c| !is_ignored(*c)).flat_map(char::to_lowercase) {
        match plain_letter(c) {
            Some(plain) => folded.push_str(plain),
            None if c.is_whitespace() => folded.push(' '),
            None => folded.push(c),
        }
    }
    folded
}

/// Returns a text with letters and their accents in one character each (Unicode's form NFC), so that texts that look the
/// same are equal: some programs store `É` as one character, others as `E` and an accent.
#[must_use]
pub fn compose_accents(text: &str) -> Cow<'_, str> {
    match is_nfc(text) {
        true => text.into(),
        false => text.nfc().collect::<String>().into(),
    }
}

/// Returns a text with letters and their accents in separate characters (Unicode's form NFD).
#[must_use]
pub fn decompose_accents(text: &str) -> Cow<'_, str> {
    match text.is_ascii() {
        true => text.into(),
        false => text.nfd().collect::<String>().into(),
    }
}

/// Returns whether a decomposed character is an accent or an invisible mark.
///
/// Lists only marks that people leave out in a search; vowel signs of Indic scripts and kana voicing marks
/// distinguish words and stay.
fn is_ignored(c: char) -> bool {
    matches!(c,
        '\u{0300}'..='\u{036F}' | '\u{1AB0}'..='\u{1AFF}' | '\u{1DC0}'..='\u{1DFF}'
        | '\u{20D0}'..='\u{20FF}' | '\u{FE20}'..='\u{FE2F}'
        | '\u{0591}'..='\u{05BD}' | '\u{05BF}' | '\u{05C1}'..='\u{05C2}' | '\u{05C4}'..='\u{05C5}'
        | '\u{064B}'..='\u{065F}' | '\u{0670}'
        | '\u{00AD}' | '\u{200B}'..='\u{200F}' | '\u{2060}' | '\u{FE00}'..='\u{FE0F}' | '\u{FEFF}')
}

/// Returns the plain spelling of a letter or sign that Unicode does not decompose.
fn plain_letter(c: char) -> Option<&'static str> {
    Some(match c {
        'œ' => "oe",
        'æ' => "ae",
        'ß' => "ss",
        'ø' => "o",
        'đ' | 'ð' => "d",
        'ł' => "l",
        'ħ' => "h",
        'ŧ' => "t",
        'ı' => "i",
        'ŋ' => "n",
        'þ' => "th",
        'ς' => "σ",
        '‘' | '’' | '‚' | '‛' | 'ʼ' | '′' => "'",
        '“' | '”' | '„' | '‟' | '«' | '»' => "\"",
        '‐' | '‑' | '‒' | '–' | '—' | '―' | '−' => "-",
        _ => return None,
    })
}

/// Returns the number of slips between two words, or `None` if there are more than `most`.
///
/// A slip is one character added, left out, changed, or exchanged with its neighbour (optimal
/// string alignment). The time taken grows with the longer word times `most`.
#[must_use]
pub fn edit_distance(a: &str, b: &str, most: usize) -> Option<usize> {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    if a.len().abs_diff(b.len()) > most {
        return None;
    }
    // Distances beyond the limit are all alike, so that only a band along the diagonal is computed (Ukkonen).
    let far = most.saturating_add(1);
    let mut before = vec![far; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).map(|j| j.min(far)).collect();
    let mut row = vec![far; b.len() + 1];
    for i in 1..=a.len() {
        let (from, to) = (i.saturating_sub(most).max(1), i.saturating_add(most).min(b.len()));
        row[from - 1] = if from == 1 { i.min(far) } else { far };
        for j in from..=to {
            let changed = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = changed.min(last[j] + 1).min(row[j - 1] + 1);
            // Two exchanged neighbours are one slip.
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(before[j - 2] + 1);
            }
            row[j] = least.min(far);
        }
        if to < b.len() {
            // The next row looks one cell beyond this band, which holds numbers of an earlier row.
            row[to + 1] = far;
        }
        (before, last, row) = (last, row, before);
    }
    Some(last[b.len()]).filter(|distance| *distance <= most)
}

/// Returns the candidate that a person who wrote `word` most likely meant, if one is near enough.
///
/// Both are folded. The limit is one slip for words of up to four characters, two up to eight, three beyond; a
/// candidate that begins with `word` (three characters or more) counts as one slip away. Among equals the first wins.
#[must_use]
pub fn nearest_candidate<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = fold_text(word);
    let length = word.chars().count();
    let most = match length {
        0 => return None,
        1..=4 => 1,
        5..=8 => 2,
        _ => 3,
    };
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let folded = fold_text(candidate);
        let near = best.map_or(most, |(distance, _)| distance);
        let raw_distance = if length >= 3 && folded.len() > word.len() && folded.starts_with(&word) {
            Some(1)
        } else {
            edit_distance(&word, &folded, near)
        };
        // A word of one character has nothing in common with a word one slip away.
        let close_distance = raw_distance.filter(|distance| length > 1 || *distance == 0);
        if let Some(distance) = close_distance
            && best.is_none_or(|(least, _)| distance < least)
        {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Returns the end of a message that offers `nearest`: `; did you mean "placement"?`; empty for `None`.
#[must_use]
pub fn did_you_mean(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |word| format!("; did you mean {word:?}?"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn folding_ignores_case_and_accents_and_keeps_letters() {
        for (text, folded) in [
            ("ÉCOLE", "ecole"),
            ("E\u{301}cole", "ecole"),
            ("ŒUF", "oeuf"),
            ("Straße", "strasse"),
            ("STRAẞE", "strasse"),
            ("İstanbul", "istanbul"),
            ("ﬁn", "fin"),
            ("Ångström", "angstrom"),
            ("AUJOURD’HUI", "aujourd'hui"),
            ("week–end", "week-end"),
            ("a\u{a0}b\tc", "a b c"),
            ("INDEX:1", "index:1"),
            ("ΣΊΣΥΦΟΣ", "σισυφοσ"),
            ("だ", "た\u{3099}"),
            ("", ""),
        ] {
            assert_eq!(fold_text(text), folded, "{text:?}");
        }
    }

    #[test]
    fn folding_every_character_twice_changes_nothing() {
        for c in '\0'..='\u{2FFFF}' {
            let once = fold_text(&c.to_string());
            assert_eq!(fold_text(&once), once, "{:x}", u32::from(c));
        }
    }

    #[test]
    fn edit_distances_are_counted() {
        for (a, b, most, distance) in [
            ("", "", 0, Some(0)),
            ("chat", "chat", 0, Some(0)),
            ("chat", "chats", 1, Some(1)),
            ("palcement", "placement", 1, Some(1)),
            ("kitten", "sitting", 5, Some(3)),
            ("kitten", "sitting", 2, None),
            ("", "abc", 3, Some(3)),
            ("ca", "abc", 3, Some(3)),
            ("été", "ete", 2, Some(2)),
        ] {
            assert_eq!(edit_distance(a, b, most), distance, "{a} {b} {most}");
        }
    }

    #[test]
    fn the_nearest_word_is_suggested() {
        let fields = ["configuration", "placement", "movement", "gloss", "sign", "signer"];
        for (word, meant) in [
            ("confguration", Some("configuration")),
            ("Palcement", Some("placement")),
            ("place", Some("placement")),
            ("glos", Some("gloss")),
            ("signs", Some("sign")),
            ("x", None),
            ("elephant", None),
            ("", None),
        ] {
            assert_eq!(nearest_candidate(word, fields), meant, "{word}");
        }
    }

    fn full_table(a: &[char], b: &[char]) -> usize {
        let mut d = vec![vec![0; b.len() + 1]; a.len() + 1];
        for i in 0..=a.len() {
            for j in 0..=b.len() {
                d[i][j] = match (i, j) {
                    (0, n) | (n, 0) => n,
                    _ => {
                        let changed = d[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                        let least = changed.min(d[i - 1][j] + 1).min(d[i][j - 1] + 1);
                        let swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
                        if swap { least.min(d[i - 2][j - 2] + 1) } else { least }
                    }
                };
            }
        }
        d[a.len()][b.len()]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn the_banded_edit_distance_equals_that_of_the_full_table(
            a in "[abc]{0,9}", b in "[abc]{0,9}", most in 0usize..10
        ) {
            let (x, y): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
            let full = full_table(&x, &y);
            prop_assert_eq!(edit_distance(&a, &b, most), (full <= most).then_some(full));
        }
    }
}
