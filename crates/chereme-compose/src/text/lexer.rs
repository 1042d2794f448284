//! Words, quoted words and signs of a recipe's text.

use std::ops::Range;

use crate::error::{Problem, TextError};

/// A token of a recipe's text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token {
    pub(super) kind: Kind,
    /// The word without its quotes, or the query.
    pub(super) text: String,
    /// Its place in the text, in bytes.
    pub(super) at: Range<usize>,
}

/// The kind of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Word,
    Quoted,
    Query,
    Pipe,
    Comma,
    Open,
    Close,
}

const LONGEST: usize = 64 * 1024;

/// Splits `text` into its tokens.
pub(super) fn lex(text: &str) -> Result<Vec<Token>, TextError> {
    if text.len() > LONGEST {
        return Err(fault("", 0, Problem::TooLong(LONGEST)));
    }
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        if c.is_whitespace() {
            at += c.len_utf8();
            continue;
        }
        let (kind, content, end) = match c {
            '|' => (Kind::Pipe, "|".into(), at + 1),
            ',' => (Kind::Comma, ",".into(), at + 1),
            '(' => (Kind::Open, "(".into(), at + 1),
            ')' => (Kind::Close, ")".into(), at + 1),
            '"' => {
                let end = quote_end(text, at)?;
                (Kind::Quoted, unquote(&text[at..end]), end)
            }
            _ => word(text, at)?,
        };
        tokens.push(Token {
            kind,
            text: content,
            at: at..end,
        });
        at = end;
    }
    Ok(tokens)
}

/// Returns an error at byte `at` of `text`.
pub(super) fn fault(text: &str, at: usize, problem: Problem) -> TextError {
    TextError {
        text: text.to_owned(),
        at: text[..at].chars().count(),
        problem,
    }
}

fn word(text: &str, start: usize) -> Result<(Kind, String, usize), TextError> {
    let ends = |c: char| c.is_whitespace() || "|,()\"".contains(c);
    let mut end = text[start..].find(ends).map_or(text.len(), |n| start + n);
    if &text[start..end] == "best" && text[end..].starts_with('(') {
        let close = close_of(text, end)?;
        let query = text[end + 1..close].trim().to_owned();
        return Ok((Kind::Query, query, close + 1));
    }
    if text[start..end].ends_with(':') && text[end..].starts_with('"') {
        end = quote_end(text, end)?;
    }
    Ok((Kind::Word, text[start..end].to_owned(), end))
}

fn quote_end(text: &str, start: usize) -> Result<usize, TextError> {
    let mut escaped = false;
    for (n, c) in text[start..].char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return Ok(start + n + 1),
            _ => {}
        }
    }
    Err(fault(text, start, Problem::Unclosed('"')))
}

fn close_of(text: &str, open: usize) -> Result<usize, TextError> {
    let (mut depth, mut at) = (0usize, open);
    while let Some(c) = text[at..].chars().next() {
        match c {
            '"' => {
                at = quote_end(text, at)?;
                continue;
            }
            '(' => depth += 1,
            ')' if depth == 1 => return Ok(at),
            ')' => depth -= 1,
            _ => {}
        }
        at += c.len_utf8();
    }
    Err(fault(text, open, Problem::Unclosed('(')))
}

fn unquote(quoted: &str) -> String {
    let mut plain = String::with_capacity(quoted.len());
    let mut chars = quoted[1..quoted.len() - 1].chars();
    while let Some(c) = chars.next() {
        plain.extend(if c == '\\' { chars.next() } else { Some(c) });
    }
    plain
}
