//! Splits text into symbols: characters, names, or both mixed.

use std::borrow::Cow;

use super::error::{HamnosysError, HamnosysFinding};
use super::garbled::repair_garbled_symbols;
use super::symbol::{HamnosysSymbol, SymbolKind};

/// The most symbols of one transcription; the longest known has 104.
pub const MAX_SYMBOLS: usize = 4096;

/// A symbol of the grammar.
#[derive(Debug, Clone, Copy)]
pub(super) struct LexedSymbol {
    pub(super) kind: SymbolKind,
    pub(super) symbol: HamnosysSymbol,
    /// Its index among all symbols of the text.
    pub(super) index: u32,
    /// The byte at which it begins in [`LexedText::text`].
    pub(super) start: u32,
}

impl LexedSymbol {
    pub(super) fn symbol_end(&self) -> usize {
        self.start as usize + self.symbol.symbol_char().len_utf8()
    }
}

/// A text as symbols.
#[derive(Debug)]
pub(super) struct LexedText<'a> {
    /// The text in characters; unknown symbols remain unchanged.
    pub(super) text: Cow<'a, str>,
    /// The symbols without blanks, punctuation and all alternatives but the first.
    pub(super) tokens: Vec<LexedSymbol>,
    /// The total number of symbols.
    pub(super) count: usize,
    /// The symbols left out.
    pub(super) findings: Vec<HamnosysFinding>,
}

/// Reads symbols; an unknown one is an error, or a finding if `lenient`.
pub(super) fn lex_hamnosys(text: &str, lenient: bool) -> Result<LexedText<'_>, HamnosysError> {
    let (text, words) = in_characters(text, lenient)?;
    let mut words = words.into_iter();
    let mut lexed = LexedText {
        tokens: Vec::with_capacity(text.len() / 3 + 1),
        text,
        count: 0,
        findings: Vec::new(),
    };
    let mut choice = AlternativeChoice::None;
    let mut opened = None;
    let chars = lexed.text.char_indices().enumerate();
    for (index, (start, character)) in chars {
        // Counts symbols as a reader of the notation would, those without meaning included.
        lexed.count = index + 1;
        if lexed.count > MAX_SYMBOLS {
            let count = lexed.text.chars().count();
            return Err(HamnosysError::TooLong {
                count,
                limit: MAX_SYMBOLS,
            });
        }
        let Some(symbol) = HamnosysSymbol::from_char(character) else {
            if character.is_whitespace() {
                continue;
            }
            // The names of unknown symbols were kept aside, each with this character in its place.
            let word = (character == char::REPLACEMENT_CHARACTER).then(|| words.next());
            lexed
                .findings
                .push(unknown_symbol_finding(index, character, word.flatten()));
            continue;
        };
        let kind = symbol.symbol_kind();
        match (kind, choice) {
            (SymbolKind::Space | SymbolKind::Version, _) => {}
            (SymbolKind::Punctuation, _) => lexed.findings.push(kept_symbol_finding(index, symbol)),
            (SymbolKind::Mime, _) => lexed.findings.push(kept_symbol_finding(index, symbol)),
            (SymbolKind::AltBegin, AlternativeChoice::None) => {
                choice = AlternativeChoice::First;
                opened = Some((index, symbol));
            }
            (SymbolKind::AltOr, AlternativeChoice::First) => {
                choice = AlternativeChoice::Other;
                lexed.findings.push(alternative(index));
            }
            (SymbolKind::AltOr, AlternativeChoice::Other) => {}
            (SymbolKind::AltEnd, AlternativeChoice::First | AlternativeChoice::Other) => {
                choice = AlternativeChoice::None
            }
            (SymbolKind::AltBegin | SymbolKind::AltOr | SymbolKind::AltEnd, _) if lenient => {
                lexed.findings.push(kept_symbol_finding(index, symbol));
            }
            (SymbolKind::AltBegin | SymbolKind::AltOr | SymbolKind::AltEnd, _) => {
                return Err(HamnosysError::Unexpected {
                    index,
                    symbol,
                    expected: "alternatives as { one | another }, not nested",
                });
            }
            // Of several alternatives the first one is read, as a sign is made in one way only.
            (_, AlternativeChoice::Other) => {}
            _ => lexed.tokens.push(LexedSymbol {
                kind,
                symbol,
                index: index as u32,
                start: start as u32,
            }),
        }
    }
    if let (AlternativeChoice::First | AlternativeChoice::Other, Some((begin, symbol))) = (choice, opened) {
        if !lenient {
            return Err(HamnosysError::Unclosed {
                index: begin,
                symbol,
                at: lexed.count,
                expected: "hamaltend",
            });
        }
        lexed.findings.push(HamnosysFinding {
            index: begin,
            message: "the alternatives are not closed".into(),
            remedy: "close them with hamaltend",
            dropped: true,
        });
    }
    Ok(lexed)
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum AlternativeChoice {
    None,
    First,
    Other,
}

/// A text in characters, and its words that name no symbol, which are replacement characters in the text.
type InCharacters<'a> = (Cow<'a, str>, Vec<String>);

/// Returns the text with names turned into characters.
///
/// Names are words of ASCII letters and digits; blanks and commas next to a name only separate words.
fn in_characters(text: &str, lenient: bool) -> Result<InCharacters<'_>, HamnosysError> {
    match in_plain_symbols(text) {
        Cow::Borrowed(text) => named_in_characters(text, lenient),
        Cow::Owned(text) => {
            let (text, words) = named_in_characters(&text, lenient)?;
            Ok((Cow::Owned(text.into_owned()), words))
        }
    }
}

/// Returns the text with symbols in place of the numbers of their characters, which programs write for
/// characters that they cannot show: `U+E001`, `\uE001`, `&#xE001;`, `0xE001`, or two and more numbers
/// side by side, `E001 E020`; the backslash of TeX before a name is left out. Text that was decoded with
/// the wrong encoding is [`repair_garbled_symbols`].
#[must_use]
pub fn in_plain_symbols(text: &str) -> Cow<'_, str> {
    match repair_garbled_symbols(text) {
        Some(mended) => Cow::Owned(from_numbers(&mended).into_owned()),
        None => from_numbers(text),
    }
}

fn from_numbers(text: &str) -> Cow<'_, str> {
    const NUMBER_ESCAPES: [&str; 6] = ["u+", "\\u{", "\\u", "\\x{", "&#x", "0x"];
    // Most texts have no numbers and are returned as they are; the symbols lie from U+E000 on.
    let begins = |pair: &[u8]| matches!(pair, [b'e' | b'E', b'0'] | [b'0', b'x' | b'X']);
    if !text.contains(['\\', '&', '+']) && !text.as_bytes().windows(2).any(begins) {
        return Cow::Borrowed(text);
    }
    let (mut out, mut changed) = (String::with_capacity(text.len()), false);
    let (mut rest, mut before) = (text, ' ');
    while let Some(first) = rest.chars().next() {
        let escape = NUMBER_ESCAPES.iter().find_map(|escape| {
            let head = rest.get(..escape.len())?;
            let is_escape = head.eq_ignore_ascii_case(escape) && !before.is_ascii_alphanumeric();
            let (symbol, length) = parse_symbol_number(&rest[escape.len()..]).filter(|_| is_escape)?;
            Some((symbol, escape.len() + length))
        });
        let escape = escape.or_else(|| in_decimal(rest));
        let taken = match escape {
            Some((symbol, mut taken)) => {
                out.push(symbol);
                // Escapes of programming languages end in a brace, those of HTML in a semicolon.
                if rest[taken..].starts_with(['}', ';']) {
                    taken += 1;
                }
                taken
            }
            None if !before.is_ascii_alphanumeric() => row_of_numbers(rest, &mut out),
            None => 0,
        };
        if taken > 0 {
            changed = true;
            before = ';';
            rest = &rest[taken..];
            continue;
        }
        let name = |rest: &str| rest.get(..3).is_some_and(|prefix| prefix.eq_ignore_ascii_case("ham"));
        // Macros of LaTeX are names of symbols with a backslash before them.
        if first == '\\' && name(&rest[1..]) {
            changed = true;
            out.push(' ');
        } else {
            out.push(first);
        }
        before = first;
        rest = &rest[first.len_utf8()..];
    }
    if changed { Cow::Owned(out) } else { Cow::Borrowed(text) }
}

/// Returns the symbol whose number, in four hexadecimal digits, begins a text, and the length of the number.
fn parse_symbol_number(text: &str) -> Option<(char, usize)> {
    let zeros = text.len() - text.trim_start_matches('0').len();
    let digits = text.get(zeros..zeros + 4)?;
    let after = text[zeros + 4..].chars().next();
    if after.is_some_and(|c| c.is_ascii_alphanumeric()) || zeros > 4 {
        return None;
    }
    let symbol = char::from_u32(u32::from_str_radix(digits, 16).ok()?)?;
    let is_private = ('\u{e000}'..='\u{e0ff}').contains(&symbol);
    (is_private && HamnosysSymbol::from_char(symbol).is_some()).then_some((symbol, zeros + 4))
}

/// Returns the symbol for a number such as `&#57345` that begins a text, and its length.
fn in_decimal(text: &str) -> Option<(char, usize)> {
    let digits = text.strip_prefix("&#")?.get(..5)?;
    let symbol = char::from_u32(digits.parse().ok()?)?;
    let is_private = ('\u{e000}'..='\u{e0ff}').contains(&symbol);
    (is_private && HamnosysSymbol::from_char(symbol).is_some()).then_some((symbol, 7))
}

/// Appends the symbols of two or more bare numbers that begin a text, and returns their length in the
/// text.
fn row_of_numbers(text: &str, out: &mut String) -> usize {
    let (mut symbols, mut taken) = (String::new(), 0);
    while let Some((symbol, length)) = parse_symbol_number(&text[taken..]) {
        symbols.push(symbol);
        let end = taken + length;
        let gap = text[end..].find(|c: char| !matches!(c, ' ' | ',' | '-'));
        taken = end + gap.unwrap_or(text.len() - end);
    }
    if symbols.chars().count() < 2 {
        return 0;
    }
    out.push_str(&symbols);
    taken
}

fn named_in_characters(text: &str, lenient: bool) -> Result<InCharacters<'_>, HamnosysError> {
    let odd = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '<' || c == '+';
    if !text.contains(odd) && !text.contains(['\u{e0ee}', '\u{e0ef}']) {
        return match text
            .chars()
            .enumerate()
            .find(|(_, c)| HamnosysSymbol::from_char(*c).is_none() && !c.is_whitespace())
        {
            Some((index, c)) if !lenient => Err(HamnosysError::Unknown {
                index,
                written: c.to_string(),
            }),
            _ => Ok((Cow::Borrowed(text), Vec::new())),
        };
    }
    let mut out = String::with_capacity(text.len());
    let (mut count, mut words) = (0, Vec::new());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word_end = rest
            .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .unwrap_or(rest.len());
        if word_end > 0 {
            match HamnosysSymbol::from_symbol_name(&rest[..word_end]) {
                Some(symbol) => out.push(symbol.symbol_char()),
                None => {
                    let written: String = rest[..word_end].chars().take(32).collect();
                    if !lenient {
                        return Err(HamnosysError::Unknown { index: count, written });
                    }
                    words.push(written);
                    out.push(char::REPLACEMENT_CHARACTER);
                }
            }
            count += 1;
            rest = &rest[word_end..];
            continue;
        }
        let gap = rest
            .find(|c: char| !(c.is_whitespace() || c == ','))
            .unwrap_or(rest.len());
        let after = rest[gap..].chars().next();
        let named = |c: Option<char>| c.is_some_and(|c| c.is_ascii_alphanumeric() || c == '_');
        let before = text[..text.len() - rest.len()].chars().next_back();
        if gap > 0 && (named(before) || named(after)) {
            rest = &rest[gap..];
            continue;
        }
        match HamnosysSymbol::from_char(first) {
            Some(symbol) => out.push(symbol.symbol_char()),
            None if first.is_whitespace() => out.push(' '),
            None if lenient => out.push(first),
            None => {
                return Err(HamnosysError::Unknown {
                    index: count,
                    written: first.to_string(),
                });
            }
        }
        count += 1;
        rest = &rest[first.len_utf8()..];
    }
    Ok((Cow::Owned(out), words))
}

/// Returns the names of a text's symbols, as H-SiGML writes its elements.
///
/// # Errors
/// [`HamnosysError`] for a character or a name that is not a symbol.
pub fn to_names(text: &str) -> Result<Vec<&'static str>, HamnosysError> {
    let (text, _) = in_characters(text, false)?;
    Ok(text
        .chars()
        .map(|c| HamnosysSymbol::from_char(c).map_or("hamspace", HamnosysSymbol::symbol_name))
        .collect())
}

/// Returns the symbols of a text, whatever their spelling, and the words and characters that are none.
#[must_use]
pub fn spelled_symbols(text: &str) -> (Vec<HamnosysSymbol>, Vec<String>) {
    let Ok((text, words)) = in_characters(text, true) else {
        return (Vec::new(), vec![text.to_owned()]);
    };
    let (mut symbols, mut odd) = (Vec::new(), words);
    for character in text.chars() {
        match HamnosysSymbol::from_char(character) {
            Some(symbol) => symbols.push(symbol),
            None if character.is_whitespace() || character == char::REPLACEMENT_CHARACTER => {}
            None => odd.push(character.to_string()),
        }
    }
    (symbols, odd)
}

/// Returns the text of symbols given by their names.
///
/// # Errors
/// [`HamnosysError`] for a name that is not a symbol's.
pub fn from_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Result<String, HamnosysError> {
    names
        .into_iter()
        .enumerate()
        .map(|(index, name)| {
            HamnosysSymbol::from_symbol_name(name)
                .map(HamnosysSymbol::symbol_char)
                .ok_or_else(|| HamnosysError::Unknown {
                    index,
                    written: name.chars().take(32).collect(),
                })
        })
        .collect()
}

fn unknown_symbol_finding(index: usize, character: char, word: Option<String>) -> HamnosysFinding {
    let what = match word {
        Some(word) => format!(
            "{word:?}, which is no symbol's name{}",
            super::error::similar_symbol_hint(&word)
        ),
        None => format!("{character:?}, which HamNoSys 4 does not have"),
    };
    HamnosysFinding {
        index,
        message: what,
        remedy: "write one of its 209 symbols or their names",
        dropped: true,
    }
}

fn kept_symbol_finding(index: usize, symbol: HamnosysSymbol) -> HamnosysFinding {
    HamnosysFinding {
        index,
        message: format!("{symbol} is kept in the text but is not part of the hands' movement"),
        remedy: "nothing is lost; leave it out to be rid of this finding",
        dropped: true,
    }
}

fn alternative(index: usize) -> HamnosysFinding {
    HamnosysFinding {
        index,
        message: "only the first of the alternatives is in the tree".into(),
        remedy: "write another sign for each other alternative",
        dropped: true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_characters_and_names_of_tex_are_symbols() {
        let flat_up = "\u{e001}\u{e020}";
        for written in [
            "U+E001 U+E020",
            "u+e001,u+e020",
            "\\uE001\\uE020",
            "\\u{E001}\\u{e020}",
            "&#xE001;&#xE020;",
            "&#57345;&#57376;",
            "0xE001 0x0000e020",
            "E001 E020",
            "E001, E020",
            "E001-E020",
            "\\hamflathand\\hamextfingeru",
        ] {
            let plain = in_plain_symbols(written);
            let names = to_names(&plain).expect(written);
            let symbols: Vec<_> = names.iter().filter(|name| **name != "hamspace").collect();
            let symbols: Vec<_> = symbols.iter().filter(|name| ***name != "hamcomma").collect();
            assert_eq!(symbols, [&&"hamflathand", &&"hamextfingeru"], "{written}");
        }
        for same in [
            flat_up,
            "hamflathand",
            "E001",
            "GATE001 E020",
            "x+1",
            "0x41 &#x41;",
            "E1FF E1FE",
            "\\é",
            "E00",
        ] {
            assert_eq!(in_plain_symbols(same), same);
        }
    }
}
