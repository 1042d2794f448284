//! Text to symbols: characters, names, or both mixed.

use std::borrow::Cow;

use super::error::{Finding, HamnosysError};
use super::symbol::{Kind, Symbol};

/// The most symbols of one transcription; the longest known has 104.
pub const MAX_SYMBOLS: usize = 4096;

/// A symbol that the grammar sees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) symbol: Symbol,
    /// Its index among all symbols of the text.
    pub(super) index: u32,
    /// Where it begins in [`Lexed::text`].
    pub(super) start: u32,
}

impl Token {
    pub(super) fn end(&self) -> usize {
        self.start as usize + self.symbol.char().len_utf8()
    }
}

/// A text as symbols.
#[derive(Debug)]
pub(super) struct Lexed<'a> {
    /// The text in characters; what is unknown stays as it is.
    pub(super) text: Cow<'a, str>,
    /// The symbols without blanks, punctuation and all alternatives but the first.
    pub(super) tokens: Vec<Token>,
    /// How many symbols there are in all.
    pub(super) count: usize,
    /// What was left out.
    pub(super) findings: Vec<Finding>,
}

/// Reads symbols; what is unknown is an error, or a finding where `lenient`.
pub(super) fn lex(text: &str, lenient: bool) -> Result<Lexed<'_>, HamnosysError> {
    let text = in_characters(text, lenient)?;
    let mut lexed = Lexed {
        tokens: Vec::with_capacity(text.len() / 3 + 1),
        text,
        count: 0,
        findings: Vec::new(),
    };
    let mut choice = Choice::None;
    let mut opened = None;
    let chars = lexed.text.char_indices().enumerate();
    for (index, (start, character)) in chars {
        lexed.count = index + 1;
        if lexed.count > MAX_SYMBOLS {
            let count = lexed.text.chars().count();
            return Err(HamnosysError::TooLong {
                count,
                limit: MAX_SYMBOLS,
            });
        }
        let Some(symbol) = Symbol::from_char(character) else {
            if character.is_whitespace() {
                continue;
            }
            lexed.findings.push(unknown(index, character));
            continue;
        };
        let kind = symbol.kind();
        match (kind, choice) {
            (Kind::Space | Kind::Version, _) => {}
            (Kind::Punctuation, _) => lexed.findings.push(kept(index, symbol)),
            (Kind::Mime, _) => lexed.findings.push(kept(index, symbol)),
            (Kind::AltBegin, Choice::None) => {
                choice = Choice::First;
                opened = Some((index, symbol));
            }
            (Kind::AltOr, Choice::First) => {
                choice = Choice::Other;
                lexed.findings.push(alternative(index));
            }
            (Kind::AltOr, Choice::Other) => {}
            (Kind::AltEnd, Choice::First | Choice::Other) => choice = Choice::None,
            (Kind::AltBegin | Kind::AltOr | Kind::AltEnd, _) if lenient => {
                lexed.findings.push(kept(index, symbol));
            }
            (Kind::AltBegin | Kind::AltOr | Kind::AltEnd, _) => {
                return Err(HamnosysError::Unexpected {
                    index,
                    symbol,
                    expected: "alternatives as { one | another }, not nested",
                });
            }
            (_, Choice::Other) => {}
            _ => lexed.tokens.push(Token {
                kind,
                symbol,
                index: index as u32,
                start: start as u32,
            }),
        }
    }
    if let (Choice::First | Choice::Other, Some((begin, symbol))) = (choice, opened) {
        if !lenient {
            return Err(HamnosysError::Unclosed {
                index: begin,
                symbol,
                at: lexed.count,
                expected: "hamaltend",
            });
        }
        lexed.findings.push(Finding {
            index: begin,
            message: "the alternatives are not closed".into(),
            remedy: "close them with hamaltend",
            dropped: true,
        });
    }
    Ok(lexed)
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Choice {
    None,
    First,
    Other,
}

/// Returns the text with names turned into characters.
///
/// Names are words of ASCII letters and digits; blanks and commas beside a name only part words.
fn in_characters(text: &str, lenient: bool) -> Result<Cow<'_, str>, HamnosysError> {
    let odd = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '<' || c == '+';
    if !text.contains(odd) && !text.contains(['\u{e0ee}', '\u{e0ef}']) {
        return match text
            .chars()
            .enumerate()
            .find(|(_, c)| Symbol::from_char(*c).is_none() && !c.is_whitespace())
        {
            Some((index, c)) if !lenient => Err(HamnosysError::Unknown {
                index,
                written: c.to_string(),
            }),
            _ => Ok(Cow::Borrowed(text)),
        };
    }
    let mut out = String::with_capacity(text.len());
    let mut count = 0;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word_end = rest
            .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .unwrap_or(rest.len());
        if word_end > 0 {
            match Symbol::from_name(&rest[..word_end]) {
                Some(symbol) => out.push(symbol.char()),
                None if lenient => out.push(char::REPLACEMENT_CHARACTER),
                None => {
                    return Err(HamnosysError::Unknown {
                        index: count,
                        written: rest[..word_end].chars().take(32).collect(),
                    });
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
        match Symbol::from_char(first) {
            Some(symbol) => out.push(symbol.char()),
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
    Ok(Cow::Owned(out))
}

/// Returns the names of a text's symbols, as H-SiGML writes its elements.
///
/// # Errors
/// A character or a name that is no symbol.
pub fn to_names(text: &str) -> Result<Vec<&'static str>, HamnosysError> {
    let text = in_characters(text, false)?;
    Ok(text
        .chars()
        .map(|c| Symbol::from_char(c).map_or("hamspace", Symbol::name))
        .collect())
}

/// Returns the text of symbols given by their names.
///
/// # Errors
/// A name that no symbol has.
pub fn from_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Result<String, HamnosysError> {
    names
        .into_iter()
        .enumerate()
        .map(|(index, name)| {
            Symbol::from_name(name)
                .map(Symbol::char)
                .ok_or_else(|| HamnosysError::Unknown {
                    index,
                    written: name.chars().take(32).collect(),
                })
        })
        .collect()
}

fn unknown(index: usize, character: char) -> Finding {
    let what = if character == char::REPLACEMENT_CHARACTER {
        "a word that is no symbol's name".to_owned()
    } else {
        format!("{character:?}, which HamNoSys 4 does not have")
    };
    Finding {
        index,
        message: what,
        remedy: "write one of its 209 symbols or their names",
        dropped: true,
    }
}

fn kept(index: usize, symbol: Symbol) -> Finding {
    Finding {
        index,
        message: format!("{symbol} is kept in the text but is no part of what the hands do"),
        remedy: "nothing is lost; leave it out to be rid of this finding",
        dropped: true,
    }
}

fn alternative(index: usize) -> Finding {
    Finding {
        index,
        message: "only the first of the alternatives is in the tree".into(),
        remedy: "write another sign for each other alternative",
        dropped: true,
    }
}
