//! Words, quoted words and signs of a recipe's text.

use std::ops::Range;

use crate::error::{RecipeTextProblem, TextError};

/// A token of a recipe's text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RecipeTextToken {
    pub(super) kind: RecipeTokenKind,
    /// The word without its quotes, or the query.
    pub(super) text: String,
    /// Its place in the text, in bytes.
    pub(super) at: Range<usize>,
}

/// The kind of a token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RecipeTokenKind {
    Word,
    Quoted,
    Query,
    Pipe,
    Comma,
    Open,
    Close,
}

const MAX_RECIPE_TEXT_BYTES: usize = 64 * 1024;

/// Splits `text` into its tokens.
pub(super) fn lex_recipe_text(text: &str) -> Result<Vec<RecipeTextToken>, TextError> {
    if text.len() > MAX_RECIPE_TEXT_BYTES {
        return Err(text_fault_at("", 0, RecipeTextProblem::TooLong(MAX_RECIPE_TEXT_BYTES)));
    }
    let mut tokens = Vec::new();
    let mut byte_offset = 0;
    while let Some(c) = text[byte_offset..].chars().next() {
        if c.is_whitespace() {
            byte_offset += c.len_utf8();
            continue;
        }
        let (kind, content, end) = match c {
            '|' => (RecipeTokenKind::Pipe, "|".into(), byte_offset + 1),
            ',' => (RecipeTokenKind::Comma, ",".into(), byte_offset + 1),
            '(' => (RecipeTokenKind::Open, "(".into(), byte_offset + 1),
            ')' => (RecipeTokenKind::Close, ")".into(), byte_offset + 1),
            '"' => {
                let end = quote_end(text, byte_offset)?;
                (
                    RecipeTokenKind::Quoted,
                    unquote_recipe_text(&text[byte_offset..end]),
                    end,
                )
            }
            _ => lex_recipe_word(text, byte_offset)?,
        };
        tokens.push(RecipeTextToken {
            kind,
            text: content,
            at: byte_offset..end,
        });
        byte_offset = end;
    }
    Ok(tokens)
}

/// Returns an error at byte `at` of `text`.
pub(super) fn text_fault_at(text: &str, at: usize, problem: RecipeTextProblem) -> TextError {
    TextError {
        text: text.to_owned(),
        at: text[..at].chars().count(),
        problem,
    }
}

fn lex_recipe_word(text: &str, start: usize) -> Result<(RecipeTokenKind, String, usize), TextError> {
    let ends = |c: char| c.is_whitespace() || "|,()\"".contains(c);
    let mut end = text[start..].find(ends).map_or(text.len(), |n| start + n);
    if &text[start..end] == "best" && text[end..].starts_with('(') {
        let close = close_of(text, end)?;
        let query = text[end + 1..close].trim().to_owned();
        return Ok((RecipeTokenKind::Query, query, close + 1));
    }
    if text[start..end].ends_with([':', '=']) && text[end..].starts_with('"') {
        end = quote_end(text, end)?;
    }
    Ok((RecipeTokenKind::Word, text[start..end].to_owned(), end))
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
    Err(text_fault_at(text, start, RecipeTextProblem::Unclosed('"')))
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
    Err(text_fault_at(text, open, RecipeTextProblem::Unclosed('(')))
}

pub(super) fn unquote_recipe_text(quoted: &str) -> String {
    let mut plain = String::with_capacity(quoted.len());
    let mut chars = quoted[1..quoted.len() - 1].chars();
    while let Some(c) = chars.next() {
        plain.extend(if c == '\\' { chars.next() } else { Some(c) });
    }
    plain
}
