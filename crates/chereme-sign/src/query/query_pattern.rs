//! Words with `*` in them.

use super::RegularExpression;
use crate::text::fold_text;

/// A text in which `*` stands for any characters, none included: `MA*SON`, `BO*`, or just `CHAT`.
///
/// It is stored as the pieces of text between the wildcards, as written. A pattern may also be a [regular
/// expression](RegularExpression), which may match anywhere in a text.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct TextPattern {
    /// At least one; if there are several, only the first and the last may be empty.
    segments: Vec<String>,
    expression: Option<RegularExpression>,
}

impl TextPattern {
    /// Returns the pattern that matches only `text` itself; a `*` in it is a plain character.
    #[must_use]
    pub fn literal_pattern(text: impl Into<String>) -> Self {
        Self {
            segments: vec![text.into()],
            expression: None,
        }
    }

    /// Returns the pattern that matches the texts in which a regular expression is found.
    #[must_use]
    pub fn of_expression(expression: RegularExpression) -> Self {
        Self {
            segments: vec![String::new(), String::new()],
            expression: Some(expression),
        }
    }

    /// Returns the regular expression, if the pattern is one.
    #[must_use]
    pub fn regular_expression(&self) -> Option<&RegularExpression> {
        self.expression.as_ref()
    }

    /// Returns the pattern written as `text`, in which `*` is a wildcard and `\*` a plain star.
    #[must_use]
    pub fn from_glob(text: &str) -> Self {
        let mut marks = Vec::with_capacity(text.len());
        let mut chars = text.chars().peekable();
        while let Some(c) = chars.next() {
            marks.push(match c {
                '\\' if chars.peek() == Some(&'*') => chars.next(),
                '*' => None,
                _ => Some(c),
            });
        }
        Self::from_marks(marks)
    }

    /// Returns the pattern of characters; `None` stands for a wildcard.
    pub(super) fn from_marks(marks: impl IntoIterator<Item = Option<char>>) -> Self {
        let mut segments = vec![String::new()];
        let mut after_wildcard = false;
        for mark in marks {
            match (mark, segments.last_mut()) {
                (Some(c), Some(last)) => last.push(c),
                (None, _) if !after_wildcard => segments.push(String::new()),
                _ => {}
            }
            after_wildcard = mark.is_none();
        }
        Self {
            segments,
            expression: None,
        }
    }

    /// Returns the pieces between the wildcards: `["MA", "SON"]` for `MA*SON`, `["BO", ""]` for `BO*`, one piece if
    /// there is no wildcard, two empty ones for a regular expression.
    #[must_use]
    pub fn pattern_segments(&self) -> &[String] {
        &self.segments
    }

    /// Returns the text if there is no wildcard.
    #[must_use]
    pub fn as_literal(&self) -> Option<&str> {
        match &self.segments[..] {
            [text] => Some(text),
            _ => None,
        }
    }

    /// Returns the text before the wildcard if the only wildcard is at the end.
    #[must_use]
    pub fn as_prefix(&self) -> Option<&str> {
        match &self.segments[..] {
            [prefix, end] if end.is_empty() && self.expression.is_none() => Some(prefix),
            _ => None,
        }
    }

    /// Returns whether every text matches: the pattern is `*` alone.
    #[must_use]
    pub fn matches_everything(&self) -> bool {
        self.as_prefix() == Some("")
    }

    /// Returns whether the whole of `text` fits, without regard to case and accents.
    #[must_use]
    pub fn matches_text(&self, text: &str) -> bool {
        if let Some(expression) = &self.expression {
            return expression.is_found_in(text);
        }
        let text = fold_text(text);
        let Some((last, others)) = self.segments.split_last() else {
            return false;
        };
        let Some((first, middle)) = others.split_first() else {
            return fold_text(last) == text;
        };
        let Some(mut rest) = text.strip_prefix(&fold_text(first)) else {
            return false;
        };
        for segment in middle {
            let segment = fold_text(segment);
            match rest.find(&segment) {
                Some(found) => rest = &rest[found + segment.len()..],
                None => return false,
            }
        }
        rest.ends_with(&fold_text(last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_characters() {
        for (pattern, text, fits) in [
            ("BO*", "BOL", true),
            ("BO*", "bo", true),
            ("BO*", "ABOL", false),
            ("MA*SON", "Maison", true),
            ("MA*SON", "MAISONS", false),
            ("*ais*", "MAISON", true),
            ("a*b*c", "aXXbYYc", true),
            ("a*ab", "ab", false),
            ("É*", "école", true),
            ("CHAT", "chat", true),
            (r"A\*", "A*", true),
            (r"A\*", "AB", false),
            ("*", "", true),
            ("**", "x", true),
        ] {
            assert_eq!(
                TextPattern::from_glob(pattern).matches_text(text),
                fits,
                "{pattern} {text}"
            );
        }
        assert_eq!(TextPattern::from_glob("a**b"), TextPattern::from_glob("a*b"));
        assert_eq!(TextPattern::from_glob("BO*").as_prefix(), Some("BO"));
        assert!(TextPattern::from_glob("***").matches_everything());
    }
}
