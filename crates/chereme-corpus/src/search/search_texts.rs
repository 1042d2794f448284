//! Words and patterns of words, folded: their form in the index, and the comparison with a text.

use chereme_sign::query::{RegularExpression, TestSubject, TextPattern};
use chereme_sign::text::{compose_accents, edit_distance, fold_text};

/// Returns the words of a text: its sequences of letters and digits, folded.
pub(crate) fn split_folded_words(text: &str) -> Vec<String> {
    fold_text(text)
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect()
}

/// A pattern for a folded word or whole text: the pieces between wildcards; or a regular expression, and whether it
/// distinguishes case and accents.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct TextGlob {
    segments: Vec<String>,
    expression: Option<(RegularExpression, bool)>,
    /// Whether case and accents count; however a program stores an accent, it is the same.
    exact: bool,
}

impl TextGlob {
    /// Returns the pattern over a whole text.
    pub(crate) fn from_whole_pattern(pattern: &TextPattern) -> Self {
        let segments = pattern.pattern_segments().iter().map(|text| fold_text(text));
        let expression = pattern.regular_expression().cloned();
        Self {
            segments: segments.collect(),
            expression: expression.map(|regex| (regex, false)),
            exact: false,
        }
    }

    /// Returns the pattern over a whole text that distinguishes case and accents.
    pub(crate) fn from_exact_pattern(pattern: &TextPattern) -> Self {
        let segments = pattern.pattern_segments().iter();
        let expression = pattern.regular_expression().cloned();
        Self {
            segments: segments.map(|text| compose_accents(text).into_owned()).collect(),
            expression: expression.map(|regex| (regex, true)),
            exact: true,
        }
    }

    /// Returns a pattern for each word of a pattern over words. A wildcard does not extend over the end of a word, and
    /// a single one at the start or the end is ignored.
    pub(crate) fn word_globs(pattern: &TextPattern) -> Vec<Self> {
        let mut word_list: Vec<Vec<String>> = Vec::new();
        let mut word: Option<Vec<String>> = None;
        for (number, segment) in pattern.pattern_segments().iter().enumerate() {
            if number > 0 {
                // An empty segment before or after a wildcard keeps its place, as in `*BO` and `BO*`.
                word.get_or_insert_with(|| vec![String::new()]).push(String::new());
            }
            for c in fold_text(segment).chars() {
                if c.is_alphanumeric() {
                    let word = word.get_or_insert_with(|| vec![String::new()]);
                    if let Some(last) = word.last_mut() {
                        last.push(c);
                    }
                } else {
                    word_list.extend(word.take());
                }
            }
        }
        word_list.extend(word);
        let asks = |word: &Vec<String>| word.iter().any(|segment| !segment.is_empty());
        let first = word_list.iter().position(asks).unwrap_or(word_list.len());
        let last = word_list.iter().rposition(asks).map_or(first, |last| last + 1);
        let words = word_list[first..last].iter().cloned();
        let glob = |segments| Self {
            segments,
            expression: None,
            exact: false,
        };
        words.map(glob).collect()
    }

    /// Returns the text, if there is no wildcard.
    pub(crate) fn literal_text(&self) -> Option<&str> {
        match &self.segments[..] {
            [text] => Some(text),
            _ => None,
        }
    }

    /// Returns the prefix of all texts that match.
    pub(crate) fn literal_prefix(&self) -> &str {
        self.segments.first().map_or("", String::as_str)
    }

    /// Returns whether a whole text matches, folded if the pattern is.
    pub(crate) fn matches_whole_text(&self, text: &str) -> bool {
        match &self.expression {
            Some((expression, true)) => return expression.finds_exactly(text),
            Some((expression, false)) => return expression.is_found_in(text),
            None => {}
        }
        let text = match self.exact {
            true => &*compose_accents(text),
            false => text,
        };
        let Some((last, others)) = self.segments.split_last() else {
            return false;
        };
        let Some((first, middle)) = others.split_first() else {
            return last == text;
        };
        let Some(mut rest) = text.strip_prefix(first.as_str()) else {
            return false;
        };
        // The earliest place leaves the most text to the pieces behind it, so that no other need be tried.
        for segment in middle {
            match rest.find(segment.as_str()) {
                Some(found) => rest = &rest[found + segment.len()..],
                None => return false,
            }
        }
        // The last piece must lie behind all others, which have taken their text away already.
        rest.ends_with(last.as_str())
    }

    /// Returns whether a text or its folded form matches: a regular expression may contain accents.
    pub(crate) fn fits_either_text(&self, text: &str, folded: &str) -> bool {
        self.matches_whole_text(folded) || self.expression.is_some() && self.matches_whole_text(text)
    }

    /// Returns the pattern as a regular expression over one word.
    pub(crate) fn glob_regex(&self) -> String {
        // Words are folded letters and digits, none of which has a meaning in an expression.
        self.segments.join(".*")
    }
}

/// Returns whether one text passes a test of words or slips; other tests accept no text.
pub(crate) fn passes_word_test(what: &TestSubject, text: &str) -> bool {
    match what {
        TestSubject::Words(_, patterns) => {
            let words = split_folded_words(text);
            patterns.iter().any(|pattern| {
                let wanted = TextGlob::word_globs(pattern);
                !wanted.is_empty()
                    && words.windows(wanted.len()).any(|run| {
                        run.iter()
                            .zip(&wanted)
                            .all(|(word, glob)| glob.matches_whole_text(word))
                    })
            })
        }
        TestSubject::Fuzzy {
            text: wanted, slips, ..
        } => {
            let slips = usize::from(*slips);
            let near = |a: &str, b: &str| edit_distance(a, b, slips).is_some();
            let words = split_folded_words(text);
            let wanted = self::split_folded_words(wanted);
            !wanted.is_empty() && wanted.iter().all(|wanted| words.iter().any(|word| near(wanted, word)))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_split_into_words() {
        for (pattern, words) in [
            ("MA*SON", "ma.*son"),
            ("slow ani*", "slow ani.*"),
            ("X(1)*", "x 1"),
            ("*-2H", "2h"),
            ("a * b", "a .* b"),
            ("Été d'hiver", "ete d hiver"),
            ("*", ""),
            ("…", ""),
        ] {
            let found: Vec<String> = TextGlob::word_globs(&TextPattern::from_glob(pattern))
                .iter()
                .map(TextGlob::glob_regex)
                .collect();
            assert_eq!(found.join(" "), words, "{pattern}");
        }
    }
}
