//! Repairs HamNoSys that was saved as UTF-8 and read as Latin-1 or Windows-1252, once or twice.

use super::symbol::HamnosysSymbol;

/// The characters of the bytes 0x80 to 0x9F in Windows-1252; the five bytes that it leaves out are Latin-1's.
const WINDOWS_HIGH_CHARS: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}', '\u{90}', '‘', '’',
    '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// The first byte of a symbol of HamNoSys in UTF-8 as Latin-1 shows it, and after a second such reading.
const GARBLED_SYMBOL_TRACES: [char; 3] = ['î', 'ï', 'Ã'];

/// Returns a text with its symbols repaired, if UTF-8 was read as another encoding, once or twice; `None`
/// if it holds no such symbols.
///
/// ```
/// use chereme_sign::hamnosys::repair_garbled_symbols;
///
/// assert_eq!(repair_garbled_symbols("î\u{80}\u{81}î€\u{a0}").as_deref(), Some("\u{e001}\u{e020}"));
/// assert_eq!(repair_garbled_symbols("maître"), None);
/// ```
#[must_use]
pub fn repair_garbled_symbols(text: &str) -> Option<String> {
    if !text.contains(GARBLED_SYMBOL_TRACES) {
        return None;
    }
    let pieces = split_misread_runs(text);
    let symbols = |run: &&str| decode_misread_run(run, holds_symbol);
    pieces.iter().find_map(symbols)?;
    // Symbols next to garbled ones went through the same wrong encoding.
    let mend = |run: &&str| match decode_misread_run(run, holds_symbol).or_else(|| plainest(run)) {
        Some(mended) => mended,
        None => (*run).to_owned(),
    };
    Some(pieces.iter().map(mend).collect())
}

/// Returns whether a text shows traces of garbled symbols that cannot be mended, since parts of them are
/// lost.
#[must_use]
pub fn is_garbled(text: &str) -> bool {
    let trace = |c: char| {
        GARBLED_SYMBOL_TRACES.contains(&c) || c == char::REPLACEMENT_CHARACTER || ('\u{80}'..='\u{9f}').contains(&c)
    };
    match repair_garbled_symbols(text) {
        Some(mended) => mended.contains(trace),
        None => text.contains(trace),
    }
}

/// Returns the leading characters of a text that may be misread bytes above 0x7F; they include a blank at
/// the position of the third byte of a symbol.
fn run(text: &str) -> &str {
    let mut open = 0;
    let taken = |c: char| {
        open = match (c, open) {
            ('î' | 'ï', _) => 3,
            (_, open) if open > 0 => open - 1,
            _ => 0,
        };
        (c == ' ' && open == 1) || (!c.is_ascii() && misread_char_byte(c).is_some())
    };
    let length: usize = text
        .chars()
        .scan(taken, |taken, c| taken(c).then(|| c.len_utf8()))
        .sum();
    &text[..length]
}

fn misread_char_byte(c: char) -> Option<u8> {
    match u8::try_from(c) {
        Ok(byte) => Some(byte),
        Err(_) => WINDOWS_HIGH_CHARS
            .iter()
            .position(|known| *known == c)
            .and_then(|at| u8::try_from(at + 0x80).ok()),
    }
}

/// Splits a text into runs of possibly misread bytes above 0x7F, and the text between them.
fn split_misread_runs(text: &str) -> Vec<&str> {
    let (mut pieces, mut rest) = (Vec::new(), text);
    while let Some(first) = rest.chars().next() {
        let length = match run(rest).len() {
            0 => first.len_utf8(),
            length => length,
        };
        let (piece, after) = rest.split_at(length);
        pieces.push(piece);
        rest = after;
    }
    pieces
}

fn holds_symbol(text: &str) -> bool {
    text.chars().any(|c| HamnosysSymbol::from_char(c).is_some())
}

/// Returns the UTF-8 reading of a run, decoded once or twice until `wanted` accepts it.
fn decode_misread_run(run: &str, wanted: impl Fn(&str) -> bool) -> Option<String> {
    let first = read_again(run)?;
    if wanted(&first) {
        return Some(first);
    }
    read_again(&first).filter(|second| wanted(second))
}

/// Returns the UTF-8 reading of a run, decoded twice if possible.
fn plainest(run: &str) -> Option<String> {
    let first = read_again(run)?;
    Some(read_again(&first).unwrap_or(first))
}

fn read_again(text: &str) -> Option<String> {
    if text.is_ascii() {
        return None;
    }
    let byte = |c| {
        if c == ' ' { Some(0xa0) } else { misread_char_byte(c) }
    };
    let bytes: Vec<u8> = text.chars().map(byte).collect::<Option<_>>()?;
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn as_latin(text: &str) -> String {
        text.bytes().map(char::from).collect()
    }

    fn as_windows(text: &str) -> String {
        let character = |byte: u8| match byte {
            0x80..=0x9f => WINDOWS_HIGH_CHARS[usize::from(byte - 0x80)],
            _ => char::from(byte),
        };
        text.bytes().map(character).collect()
    }

    #[test]
    fn symbols_read_as_another_encoding_once_or_twice_are_mended() {
        for text in [
            "\u{e000}\u{e020}\u{e03c}",
            "A \u{e0e9}\u{e001}, \u{e029}",
            "É\t\u{e0c8}",
            "\u{e0c8} œuf",
        ] {
            for read in [as_latin, as_windows] {
                let (once, twice) = (read(text), read(&read(text)));
                for garbled in [&once, &twice, &as_latin(&as_windows(text))] {
                    assert_eq!(repair_garbled_symbols(garbled).as_deref(), Some(text), "{garbled:?}");
                    assert!(!is_garbled(garbled));
                }
            }
            assert_eq!(repair_garbled_symbols(text), None, "what is whole stays as it is");
        }
        let blank = as_windows("\u{e020}\u{e03c}").replace('\u{a0}', " ");
        assert_eq!(repair_garbled_symbols(&blank).as_deref(), Some("\u{e020}\u{e03c}"));
    }

    #[test]
    fn text_that_lost_bytes_is_garbled_and_plain_words_are_not() {
        for (text, garbled) in [
            ("îîî", true),
            ("î€", true),
            ("\u{fffd}\u{fffd}", true),
            ("hamfist hamextfingeru", false),
            ("\u{e000}\u{e020}", false),
            ("", false),
        ] {
            assert_eq!(is_garbled(text), garbled, "{text:?}");
            assert_eq!(repair_garbled_symbols(text), None, "{text:?}");
        }
        for word in ["maître", "Ãgypten", "ïle", "naïve €"] {
            assert_eq!(repair_garbled_symbols(word), None, "{word}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn any_text_is_accepted(text in "[îïÃ®€\u{80}-\u{a0} \u{e000}-\u{e0ff}a]{0,40}") {
            let _ = (repair_garbled_symbols(&text), is_garbled(&text));
        }
    }
}
