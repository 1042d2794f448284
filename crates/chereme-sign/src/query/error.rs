//! The error of a query, with its position.

use super::query_print::write_value;
use super::query_tree::QueryPlace;
use crate::remedy::ErrorRemedy;
use crate::text::nearest_candidate;
use std::fmt;
use std::ops::Range;

/// The most characters of a long query that are shown before the place of the error.
const MAX_LEADING_CHARS: usize = 50;
/// The most characters of a query that are shown.
const MAX_SHOWN_CHARS: usize = 100;

/// An error in a query that cannot be understood or answered, with its place and a correction.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct QueryError {
    /// The characters (not bytes) of the query that are wrong; empty if something is missing.
    pub at: Range<usize>,
    /// The error, in one sentence without a full stop.
    pub message: String,
    /// A correction; may be empty if the suggestion is sufficient.
    pub remedy: ErrorRemedy,
    /// The text to write in place of [`at`](Self::at), if one meaning is most likely.
    pub suggestion: Option<String>,
}

impl QueryError {
    pub(super) fn new(at: QueryPlace, message: impl Into<String>, remedy: impl Into<ErrorRemedy>) -> Self {
        let (message, remedy) = (message.into(), remedy.into());
        Self {
            at: at.char_range(),
            message,
            remedy,
            suggestion: None,
        }
    }

    pub(super) fn with_suggestion(mut self, replacement: Option<impl Into<String>>) -> Self {
        self.suggestion = replacement.map(Into::into);
        self
    }

    /// Returns the message with the suggestion.
    #[must_use]
    pub fn fault_message(&self) -> String {
        match &self.suggestion {
            Some(suggestion) => format!("{}; did you mean {suggestion}?", self.message),
            None => self.message.clone(),
        }
    }

    /// Returns three lines of text: the query, carets under the place, and the message with the suggestion. Of a long
    /// query only the part around the place is drawn.
    ///
    /// `query` is the text that was parsed.
    #[must_use]
    pub fn draw_query_error(&self, query: &str) -> String {
        let chars: Vec<char> = query.chars().collect();
        // Ten more letters are drawn rather than cut, as the sign of the cut takes room too.
        let from = if self.at.start > MAX_LEADING_CHARS + 10 {
            self.at.start.min(chars.len()) - MAX_LEADING_CHARS
        } else {
            0
        };
        let to = chars.len().min(from + MAX_SHOWN_CHARS);
        let mut line = String::new();
        if from > 0 {
            line.push('…');
        }
        line.extend(chars[from..to].iter().map(|c| if c.is_control() { ' ' } else { *c }));
        if to < chars.len() {
            line.push('…');
        }
        let columns = |range: &[char]| range.iter().map(|c| columns_of(*c)).sum::<usize>();
        let start = self.at.start.clamp(from, to);
        let end = self.at.end.clamp(start, to);
        let indent = columns(&chars[from..start]) + usize::from(from > 0);
        // A place at the end of the query is empty and still needs a caret.
        let carets = columns(&chars[start..end]).max(1);
        format!(
            "{line}\n{}{}\n{}",
            " ".repeat(indent),
            "^".repeat(carets),
            self.fault_message()
        )
    }

    /// Returns the query with the suggestion in place of the wrong characters; `None` without a suggestion.
    #[must_use]
    pub fn corrected_query(&self, query: &str) -> Option<String> {
        let suggestion = self.suggestion.as_deref()?;
        let before = query.chars().take(self.at.start);
        let after = query.chars().skip(self.at.end);
        Some(before.chain(suggestion.chars()).chain(after).collect())
    }
}

impl fmt::Display for QueryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "character {}: {}", self.at.start + 1, self.fault_message())?;
        if !self.remedy.is_empty() {
            write!(f, " ({})", self.remedy)?;
        }
        Ok(())
    }
}

/// Returns the error for a value at `at` in a query that is in no inventory.
///
/// `candidates` are the valid names, in the order of offering; the nearest becomes the suggestion, and the message
/// names the first few.
#[must_use]
pub fn unknown_value<'a>(at: QueryPlace, value: &str, candidates: impl IntoIterator<Item = &'a str>) -> QueryError {
    const MAX_NAMED_VALUES: usize = 8;
    let candidates: Vec<&str> = candidates.into_iter().collect();
    let shown = candidates
        .iter()
        .take(MAX_NAMED_VALUES)
        .map(|name| written_query_value(name))
        .collect::<Vec<_>>()
        .join(", ");
    let remedy = match candidates.len() {
        0 => "no values are known for this field".to_owned(),
        1..=MAX_NAMED_VALUES => format!("known values: {shown}"),
        count => format!("known values: {shown} and {} more", count - MAX_NAMED_VALUES),
    };
    let near = nearest_candidate(value, candidates).map(written_query_value);
    QueryError::new(at, format!("the value {value:?} is in no inventory"), remedy).with_suggestion(near)
}

/// Returns a value as a query spells it, in quotes if it needs them.
fn written_query_value(value: &str) -> String {
    let mut text = String::new();
    match write_value(&mut text, &super::TextPattern::literal_pattern(value)) {
        Ok(()) => text,
        Err(_) => value.to_owned(),
    }
}

/// Returns the number of terminal columns of a character, exact enough to place a caret.
fn columns_of(c: char) -> usize {
    match c {
        '\u{0300}'..='\u{036F}' | '\u{200B}'..='\u{200F}' | '\u{FE00}'..='\u{FE0F}' => 0,
        '\u{1100}'..='\u{115F}'
        | '\u{2E80}'..='\u{A4CF}'
        | '\u{AC00}'..='\u{D7A3}'
        | '\u{F900}'..='\u{FAFF}'
        | '\u{FF00}'..='\u{FF60}'
        | '\u{1F300}'..='\u{1FAFF}'
        | '\u{20000}'..='\u{3FFFD}' => 2,
        _ => 1,
    }
}
