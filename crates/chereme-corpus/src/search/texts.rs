//! Words and patterns of words, folded: their form in the index, and the comparison with a text.

use chereme_sign::query::{Expression, Pattern, What};
use chereme_sign::text::{composed, edit_distance, fold};

/// Returns the words of a text: its sequences of letters and digits, folded.
pub(crate) fn words(text: &str) -> Vec<String> {
    fold(text)
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect()
}

/// A pattern for a folded word or whole text: the pieces between wildcards; or a regular expression, and whether it
/// distinguishes case and accents.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Glob {
    segments: Vec<String>,
    expression: Option<(Expression, bool)>,
    /// Whether case and accents count; however a program stores an accent, it is the same.
    exact: bool,
}

impl Glob {
    /// Returns the pattern over a whole text.
    pub(crate) fn whole(pattern: &Pattern) -> Self {
        let segments = pattern.segments().iter().map(|text| fold(text));
        let expression = pattern.expression().cloned();
        Self {
            segments: segments.collect(),
            expression: expression.map(|it| (it, false)),
            exact: false,
        }
    }

    /// Returns the pattern over a whole text that distinguishes case and accents.
    pub(crate) fn exact(pattern: &Pattern) -> Self {
        let segments = pattern.segments().iter();
        let expression = pattern.expression().cloned();
        Self {
            segments: segments.map(|text| composed(text).into_owned()).collect(),
            expression: expression.map(|it| (it, true)),
            exact: true,
        }
    }

    /// Returns a pattern for each word of a pattern over words. A wildcard does not extend over the end of a word, and
    /// a single one at the start or the end is ignored.
    pub(crate) fn words(pattern: &Pattern) -> Vec<Self> {
        let mut found: Vec<Vec<String>> = Vec::new();
        let mut word: Option<Vec<String>> = None;
        for (number, segment) in pattern.segments().iter().enumerate() {
            if number > 0 {
                word.get_or_insert_with(|| vec![String::new()])
                    .push(String::new());
            }
            for c in fold(segment).chars() {
                if c.is_alphanumeric() {
                    let word = word.get_or_insert_with(|| vec![String::new()]);
                    if let Some(last) = word.last_mut() {
                        last.push(c);
                    }
                } else {
                    found.extend(word.take());
                }
            }
        }
        found.extend(word);
        let asks = |word: &Vec<String>| word.iter().any(|segment| !segment.is_empty());
        let first = found.iter().position(asks).unwrap_or(found.len());
        let last = found.iter().rposition(asks).map_or(first, |last| last + 1);
        let words = found[first..last].iter().cloned();
        let glob = |segments| Self {
            segments,
            expression: None,
            exact: false,
        };
        words.map(glob).collect()
    }

    /// Returns the text, if there is no wildcard.
    pub(crate) fn literal(&self) -> Option<&str> {
        match &self.segments[..] {
            [text] => Some(text),
            _ => None,
        }
    }

    /// Returns the prefix of all texts that match.
    pub(crate) fn prefix(&self) -> &str {
        self.segments.first().map_or("", String::as_str)
    }

    /// Returns whether a whole text matches, folded if the pattern is.
    pub(crate) fn matches(&self, text: &str) -> bool {
        match &self.expression {
            Some((expression, true)) => return expression.finds_exactly(text),
            Some((expression, false)) => return expression.finds(text),
            None => {}
        }
        let text = match self.exact {
            true => &*composed(text),
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
        for segment in middle {
            match rest.find(segment.as_str()) {
                Some(found) => rest = &rest[found + segment.len()..],
                None => return false,
            }
        }
        rest.ends_with(last.as_str())
    }

    /// Returns whether a text or its folded form matches: a regular expression may contain accents.
    pub(crate) fn fits(&self, text: &str, folded: &str) -> bool {
        self.matches(folded) || self.expression.is_some() && self.matches(text)
    }

    /// Returns the pattern as a regular expression over one word.
    pub(crate) fn regex(&self) -> String {
        self.segments.join(".*")
    }
}

/// Returns whether one text passes a test of words or slips; other tests accept no text.
pub(crate) fn passes(what: &What, text: &str) -> bool {
    match what {
        What::Words(_, patterns) => {
            let words = words(text);
            patterns.iter().any(|pattern| {
                let wanted = Glob::words(pattern);
                !wanted.is_empty()
                    && words.windows(wanted.len()).any(|run| {
                        run.iter()
                            .zip(&wanted)
                            .all(|(word, glob)| glob.matches(word))
                    })
            })
        }
        What::Fuzzy {
            text: wanted,
            slips,
            ..
        } => {
            let slips = usize::from(*slips);
            let near = |a: &str, b: &str| edit_distance(a, b, slips).is_some();
            let words = words(text);
            let wanted = self::words(wanted);
            !wanted.is_empty()
                && wanted
                    .iter()
                    .all(|wanted| words.iter().any(|word| near(wanted, word)))
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
            let found: Vec<String> = Glob::words(&Pattern::from_glob(pattern))
                .iter()
                .map(Glob::regex)
                .collect();
            assert_eq!(found.join(" "), words, "{pattern}");
        }
    }
}
