//! Regular expressions in a query: `gloss=/^BO.*/`.

use crate::text::{compose_accents, fold_text};
use regex::{Regex, RegexBuilder};
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};

/// The most characters of a regular expression.
const MAX_CHARS: usize = 1000;
/// The most bytes of a compiled expression.
const MAX_SIZE: usize = 1 << 20;
/// The deepest nesting of groups.
const MAX_GROUP_DEPTH: u32 = 50;

/// A regular expression that may match anywhere in a text; `^` and `$` are the ends of the text.
///
/// Matching takes time in proportion to the text, whatever the expression.
#[derive(Debug, Clone)]
pub struct RegularExpression {
    source: String,
    exact: Regex,
    loose: Regex,
}

impl RegularExpression {
    /// Compiles an expression.
    ///
    /// # Errors
    /// Returns the reason, in one line, if the text is not a regular expression or needs too much memory.
    pub fn new(source: &str) -> Result<Self, String> {
        if source.chars().count() > MAX_CHARS {
            return Err(format!("it is longer than {MAX_CHARS} characters"));
        }
        let build = |loose: bool| {
            RegexBuilder::new(&compose_accents(source))
                .case_insensitive(loose)
                .size_limit(MAX_SIZE)
                .dfa_size_limit(MAX_SIZE)
                .nest_limit(MAX_GROUP_DEPTH)
                .build()
        };
        let reason = |error: regex::Error| match error {
            regex::Error::CompiledTooBig(_) => "it needs too much memory".to_owned(),
            other => {
                let text = other.to_string();
                let last = text.lines().last().unwrap_or_default();
                last.strip_prefix("error: ").unwrap_or(last).to_owned()
            }
        };
        Ok(Self {
            exact: build(false).map_err(reason)?,
            loose: build(true).map_err(reason)?,
            source: source.to_owned(),
        })
    }

    /// Returns the expression as it was written, without the slashes.
    #[must_use]
    pub fn expression_source(&self) -> &str {
        &self.source
    }

    /// Returns whether the expression matches in a text, or in the text without accents, both without regard to case.
    #[must_use]
    pub fn is_found_in(&self, text: &str) -> bool {
        self.loose.is_match(&compose_accents(text)) || self.loose.is_match(&fold_text(text))
    }

    /// Returns whether the expression matches in a text, with regard to case and accents.
    #[must_use]
    pub fn finds_exactly(&self, text: &str) -> bool {
        self.exact.is_match(&compose_accents(text))
    }
}

impl PartialEq for RegularExpression {
    fn eq(&self, other: &Self) -> bool {
        self.source == other.source
    }
}

impl Eq for RegularExpression {}

impl Hash for RegularExpression {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.source.hash(state);
    }
}

impl PartialOrd for RegularExpression {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for RegularExpression {
    fn cmp(&self, other: &Self) -> Ordering {
        self.source.cmp(&other.source)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_expression_is_found_anywhere_unless_it_is_tied() {
        for (source, text, loosely, exactly) in [
            ("^BO", "BOL", true, true),
            ("^bo", "BOL", true, false),
            // With the accents as characters of their own, on either side.
            ("ÉTÉ", "E\u{301}TE\u{301}", true, true),
            ("E\u{301}TE\u{301}$", "L'ÉTÉ", true, true),
            ("^BO", "ABOL", false, false),
            ("BO.*", "ABOL", true, true),
            ("-[0-9]$", "BOL-2", true, true),
            ("^eco", "ÉCOLE", true, false),
            ("^École", "école", true, false),
            ("a|b", "xbx", true, true),
        ] {
            let found = RegularExpression::new(source).expect(source);
            assert_eq!(found.is_found_in(text), loosely, "{source} {text}");
            assert_eq!(found.finds_exactly(text), exactly, "{source} {text}");
        }
    }

    #[test]
    fn hostile_expressions_are_refused_or_answer_soon() {
        for source in ["(", "a{1000}{1000}{1000}", "[", &"(".repeat(400), &"a".repeat(2000)] {
            let reason = RegularExpression::new(source).expect_err("refused");
            assert!(!reason.is_empty() && !reason.contains('\n'), "{reason}");
        }
        let slow_elsewhere = RegularExpression::new("(a*)*(a*)*(a*)*b$").expect("compiled");
        assert!(!slow_elsewhere.is_found_in(&"a".repeat(10_000)));
    }
}
