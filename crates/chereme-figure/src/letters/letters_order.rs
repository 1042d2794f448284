//! The visual order of text that runs left to right and right to left, by the Unicode Bidirectional
//! Algorithm (UAX #9).

use std::ops::Range;

use unicode_bidi::{BidiClass, Level, ParagraphBidiInfo, bidi_class};

/// A part of a line whose characters all run in one direction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextRun {
    /// Its bytes.
    pub range: Range<usize>,
    /// Whether it is read from the right.
    pub from_right: bool,
}

/// Returns whether a part of a text is read from the right.
#[must_use]
pub fn any_from_right(text: &str) -> bool {
    // No character below U+0590 is read from the right.
    text.bytes().any(|byte| byte >= 0xD6)
        && text.chars().any(|c| {
            matches!(
                bidi_class(c),
                BidiClass::R | BidiClass::AL | BidiClass::RLE | BidiClass::RLO | BidiClass::RLI
            )
        })
}

/// Returns the runs of a line in visual order from left to right.
///
/// The line as a whole runs left to right if it has a letter that does: a sentence of the window keeps the direction of
/// its language, even if it begins with an Arabic gloss. A line of right-to-left letters alone runs right to left.
#[must_use]
pub fn visual_text_runs(line: &str) -> Vec<TextRun> {
    if !any_from_right(line) {
        let range = 0..line.len();
        let from_right = false;
        return Vec::from_iter((!line.is_empty()).then_some(TextRun { range, from_right }));
    }
    // One letter from the left is enough: a sentence keeps its direction around a foreign gloss.
    let latin = line.chars().any(|c| bidi_class(c) == BidiClass::L);
    let level = if latin { Level::ltr() } else { Level::rtl() };
    let info = ParagraphBidiInfo::new(line, Some(level));
    let (levels, ranges) = info.visual_runs(0..line.len());
    let run = |range: Range<usize>| TextRun {
        from_right: levels.get(range.start).is_some_and(Level::is_rtl),
        range,
    };
    ranges.into_iter().map(run).collect()
}

/// Returns a bracket as it looks in text read from the right; other characters stay the same.
#[must_use]
pub fn mirror_bracket(letter: char) -> char {
    const BRACKET_PAIRS: [(char, char); 6] = [('(', ')'), ('[', ']'), ('{', '}'), ('<', '>'), ('«', '»'), ('‹', '›')];
    for (open, close) in BRACKET_PAIRS {
        if letter == open {
            return close;
        } else if letter == close {
            return open;
        }
    }
    letter
}

/// Returns whether a character is a letter that is read from the right.
#[must_use]
pub fn reads_from_right(letter: char) -> bool {
    letter >= '\u{590}' && matches!(bidi_class(letter), BidiClass::R | BidiClass::AL)
}

/// Returns whether a character belongs to the one before it: a mark, or an invisible character.
#[must_use]
pub fn hangs_on(letter: char) -> bool {
    matches!(bidi_class(letter), BidiClass::NSM | BidiClass::BN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Writes the runs in visual order, those from the right in angle brackets.
    fn shown(line: &str) -> String {
        let part = |run: &TextRun| match run.from_right {
            true => format!("<{}>", &line[run.range.clone()]),
            false => line[run.range.clone()].to_owned(),
        };
        visual_text_runs(line).iter().map(part).collect()
    }

    #[test]
    fn a_line_is_cut_where_its_direction_changes() {
        for (line, wanted) in [
            ("", ""),
            ("ESCARGOT", "ESCARGOT"),
            ("Ωμέγα Жук 漢字 ไทย", "Ωμέγα Жук 漢字 ไทย"),
            ("كتاب كبير", "<كتاب كبير>"),
            ("שלום", "<שלום>"),
            // A sentence of the window keeps its direction, whatever word begins it.
            ("كتاب is notated.", "<كتاب> is notated."),
            (
                "Only those with كتاب كبير, please",
                "Only those with <كتاب كبير>, please",
            ),
            ("كتاب (2)", "<)>2<كتاب (>"),
        ] {
            assert_eq!(shown(line), wanted, "{line}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(128))]

        #[test]
        fn every_character_stands_in_one_run(line in "[a-z0-9 .,()\u{5d0}-\u{5ea}\u{627}-\u{64a}\u{202a}-\u{202e}\u{2066}-\u{2069}漢\n\u{2029}]{0,24}") {
            let mut all: Vec<Range<usize>> = visual_text_runs(&line).into_iter().map(|run| run.range).collect();
            all.sort_by_key(|range| range.start);
            let mut end = 0;
            for range in all {
                prop_assert_eq!(range.start, end);
                end = range.end;
                prop_assert!(line.is_char_boundary(end));
            }
            prop_assert_eq!(end, line.len());
        }
    }
}
