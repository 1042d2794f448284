//! Temporal relations between spans: ELAN's eleven and Allen's.

use crate::text::{did_you_mean, fold_text, nearest_candidate};
use chereme_motion::{RecordingInstant, TimeSpan};
use std::fmt;
use std::str::FromStr;

/// The temporal relation of a span `a` to a span `b`; spans are half-open.
///
/// The first eleven are those of ELAN's structured search. The others complete the thirteen of Allen (*Maintaining
/// knowledge about temporal intervals*, 1983): ELAN's `OverlapsBegin` and `OverlapsEnd` are two of them, and
/// `Before` and `After` hold two each. Distances are microseconds; a distance below zero counts as zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TimeRelation {
    /// `a` lies wholly in `b`.
    Inside,
    /// Some of `a` lies outside `b`.
    NotInside,
    /// They share an instant.
    Overlaps,
    /// They share no instant.
    NotOverlaps,
    /// `a` starts before `b` and ends inside it: it overlaps only the begin.
    OverlapsBegin,
    /// `a` starts inside `b` and ends after it: it overlaps only the end.
    OverlapsEnd,
    /// `a` lies wholly in `b` with this much added on both sides.
    Around(i64),
    /// `a` lies wholly within this distance of the start of `b`.
    OfBegin(i64),
    /// `a` lies wholly within this distance of the end of `b`.
    OfEnd(i64),
    /// `a` has ended when `b` starts.
    Before,
    /// `a` starts when `b` has ended.
    After,
    /// They have the same start and end.
    Equals,
    /// `a` ends where `b` starts.
    Meets,
    /// `a` starts where `b` ends.
    MetBy,
    /// They start together and `a` ends first.
    Starts,
    /// They start together and `b` ends first.
    StartedBy,
    /// They end together and `b` starts first.
    Finishes,
    /// They end together and `a` starts first.
    FinishedBy,
    /// `b` lies wholly in `a`.
    Covers,
}

impl TimeRelation {
    /// The relations without a distance, by the name that queries use.
    pub const PLAIN_RELATIONS: [(&'static str, Self); 16] = [
        ("overlaps", Self::Overlaps),
        ("not-overlaps", Self::NotOverlaps),
        ("inside", Self::Inside),
        ("not-inside", Self::NotInside),
        ("overlaps-begin", Self::OverlapsBegin),
        ("overlaps-end", Self::OverlapsEnd),
        ("before", Self::Before),
        ("after", Self::After),
        ("equals", Self::Equals),
        ("meets", Self::Meets),
        ("met-by", Self::MetBy),
        ("starts", Self::Starts),
        ("started-by", Self::StartedBy),
        ("finishes", Self::Finishes),
        ("finished-by", Self::FinishedBy),
        ("covers", Self::Covers),
    ];

    /// Returns whether this is a relation of `a` to `b`.
    #[must_use]
    pub fn relation_holds(self, a: TimeSpan, b: TimeSpan) -> bool {
        let (start, end) = (
            a.span_start_instant().cmp(&b.span_start_instant()),
            a.span_end_instant().cmp(&b.span_end_instant()),
        );
        match self {
            Self::Inside => b.has_span_inside(a),
            Self::NotInside => !b.has_span_inside(a),
            Self::Overlaps => a.is_overlapping_span(b),
            Self::NotOverlaps => !a.is_overlapping_span(b),
            Self::OverlapsBegin => start.is_lt() && end.is_lt() && a.is_overlapping_span(b),
            Self::OverlapsEnd => start.is_gt() && end.is_gt() && a.is_overlapping_span(b),
            Self::Around(reach) => widen_span(b.span_start_instant(), b.span_end_instant(), reach).has_span_inside(a),
            Self::OfBegin(reach) => {
                widen_span(b.span_start_instant(), b.span_start_instant(), reach).has_span_inside(a)
            }
            Self::OfEnd(reach) => widen_span(b.span_end_instant(), b.span_end_instant(), reach).has_span_inside(a),
            Self::Before => a.span_end_instant() <= b.span_start_instant(),
            Self::After => b.span_end_instant() <= a.span_start_instant(),
            Self::Equals => a == b,
            Self::Meets => a.span_end_instant() == b.span_start_instant(),
            Self::MetBy => a.span_start_instant() == b.span_end_instant(),
            Self::Starts => start.is_eq() && end.is_lt(),
            Self::StartedBy => start.is_eq() && end.is_gt(),
            Self::Finishes => start.is_gt() && end.is_eq(),
            Self::FinishedBy => start.is_lt() && end.is_eq(),
            Self::Covers => a.has_span_inside(b),
        }
    }
}

fn widen_span(start: RecordingInstant, end: RecordingInstant, reach: i64) -> TimeSpan {
    let reach = reach.max(0);
    TimeSpan::span_between(start.shifted_instant(-reach), end.shifted_instant(reach))
}

impl fmt::Display for TimeRelation {
    /// Writes the name that queries use, such as `overlaps-begin` or `within 0.2s of-end`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (reach, kind) = match self {
            Self::Around(reach) => (reach, "around"),
            Self::OfBegin(reach) => (reach, "of-begin"),
            Self::OfEnd(reach) => (reach, "of-end"),
            plain => {
                let named = Self::PLAIN_RELATIONS.iter().find(|(_, relation)| relation == plain);
                return f.write_str(named.map_or("overlaps", |(name, _)| name));
            }
        };
        let reach = (*reach).max(0);
        let padded_fraction = format!("{:06}", reach % 1_000_000);
        let fraction = padded_fraction.trim_end_matches('0');
        let point = if fraction.is_empty() { "" } else { "." };
        write!(f, "within {}{point}{fraction}s {kind}", reach / 1_000_000)
    }
}

impl FromStr for TimeRelation {
    type Err = RelationError;

    /// Reads a relation as queries and as ELAN name it: `overlaps-begin`, `overlaps only begin`,
    /// `no overlap`, `within 0.2s around`, `within 200 ms of begin`.
    fn from_str(text: &str) -> Result<Self, RelationError> {
        let folded_words = fold_text(text).replace(['-', '_'], " ");
        let words: Vec<&str> = folded_words.split_whitespace().collect();
        if let ["within", rest @ ..] = &words[..] {
            return parse_within_words(rest, text);
        }
        let name_words: Vec<&str> = words
            .into_iter()
            .filter(|word| !["is", "only", "time"].contains(word))
            .map(|word| match word {
                "no" => "not",
                "overlap" => "overlaps",
                "equal" => "equals",
                word => word,
            })
            .collect();
        let name = name_words.join("-");
        let entry = Self::PLAIN_RELATIONS.iter().find(|(plain, _)| *plain == name);
        entry
            .map(|(_, relation)| *relation)
            .ok_or_else(|| RelationError::Unknown {
                text: text.to_owned(),
                nearest: nearest_candidate(&name, Self::PLAIN_RELATIONS.map(|(name, _)| name)).map(str::to_owned),
            })
    }
}

fn parse_within_words(words: &[&str], text: &str) -> Result<TimeRelation, RelationError> {
    let written = || RelationError::Distance { text: text.to_owned() };
    let kind = words
        .iter()
        .position(|word| ["of", "around"].contains(word))
        .ok_or_else(written)?;
    let reach = parse_relation_micros(&words[..kind].concat()).ok_or_else(written)?;
    match &words[kind..] {
        ["around"] => Ok(TimeRelation::Around(reach)),
        ["of", "begin" | "start", ..] => Ok(TimeRelation::OfBegin(reach)),
        ["of", "end", ..] => Ok(TimeRelation::OfEnd(reach)),
        _ => Err(written()),
    }
}

fn parse_relation_micros(text: &str) -> Option<i64> {
    let (number, unit) = match text.strip_suffix("ms") {
        Some(number) => (number, 1e3),
        None => (text.strip_suffix('s')?, 1e6),
    };
    let micros = number.parse::<f64>().ok()? * unit;
    (0.0..9e18).contains(&micros).then_some(micros.round() as i64)
}

/// A text that names no relation.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RelationError {
    /// There is no such relation.
    #[error("there is no relation {text:?}{}", did_you_mean(nearest.as_deref()))]
    Unknown {
        /// The text as written.
        text: String,
        /// The relation nearest to it.
        nearest: Option<String>,
    },
    /// The text after `within` is not a distance and a place.
    #[error("{text:?}: after \"within\" stand a time and a place, such as 0.2s around, 200ms of begin or 1s of end")]
    Distance {
        /// The text as written.
        text: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn span(start: i64, end: i64) -> TimeSpan {
        TimeSpan::from_span_micros(start, end)
    }

    /// Every relation in the order of the table's columns; the distances are 5 microseconds.
    fn columns() -> Vec<TimeRelation> {
        let mut all: Vec<TimeRelation> = TimeRelation::PLAIN_RELATIONS
            .iter()
            .map(|(_, relation)| *relation)
            .collect();
        all.extend([
            TimeRelation::Around(5),
            TimeRelation::OfBegin(5),
            TimeRelation::OfEnd(5),
        ]);
        all
    }

    #[test]
    fn every_relation_over_every_kind_of_pair() {
        let b = span(100, 200);
        for (a, holds) in [
            (span(50, 80), "not-overlaps not-inside before"),
            (span(50, 100), "not-overlaps not-inside before meets"),
            (span(96, 98), "not-overlaps not-inside before around begin"),
            (span(50, 150), "overlaps not-inside overlaps-begin"),
            (span(96, 104), "overlaps not-inside overlaps-begin around begin"),
            (span(100, 150), "overlaps inside starts around"),
            (span(101, 104), "overlaps inside around begin"),
            (span(120, 150), "overlaps inside around"),
            (span(150, 200), "overlaps inside finishes around"),
            (span(197, 199), "overlaps inside around end"),
            (span(100, 200), "overlaps inside equals covers around"),
            (span(50, 200), "overlaps not-inside finished-by covers"),
            (span(100, 250), "overlaps not-inside started-by covers"),
            (span(98, 203), "overlaps not-inside covers around"),
            (span(50, 250), "overlaps not-inside covers"),
            (span(150, 250), "overlaps not-inside overlaps-end"),
            (span(198, 204), "overlaps not-inside overlaps-end around end"),
            (span(200, 250), "not-overlaps not-inside after met-by"),
            (span(202, 204), "not-overlaps not-inside after around end"),
            (span(250, 280), "not-overlaps not-inside after"),
        ] {
            let mut wanted: Vec<&str> = holds.split(' ').collect();
            wanted.sort_unstable();
            let name = |relation: &TimeRelation| match relation {
                TimeRelation::Around(_) => "around".to_owned(),
                TimeRelation::OfBegin(_) => "begin".to_owned(),
                TimeRelation::OfEnd(_) => "end".to_owned(),
                plain => plain.to_string(),
            };
            let found = columns().into_iter().filter(|relation| relation.relation_holds(a, b));
            let mut found: Vec<String> = found.map(|relation| name(&relation)).collect();
            found.sort_unstable();
            assert_eq!(found, wanted, "{a:?}");
        }
    }

    #[test]
    fn names_of_queries_and_of_elan_are_read() {
        for (text, relation) in [
            ("Inside", TimeRelation::Inside),
            ("is inside", TimeRelation::Inside),
            ("not inside", TimeRelation::NotInside),
            ("overlaps only begin time", TimeRelation::OverlapsBegin),
            ("overlaps_only_end", TimeRelation::OverlapsEnd),
            ("no overlap", TimeRelation::NotOverlaps),
            ("before", TimeRelation::Before),
            ("within 0.2s around", TimeRelation::Around(200_000)),
            ("within 200 ms of begin time", TimeRelation::OfBegin(200_000)),
            ("within 1.5s of-end", TimeRelation::OfEnd(1_500_000)),
        ] {
            assert_eq!(text.parse(), Ok(relation), "{text}");
        }
        for relation in columns() {
            assert_eq!(relation.to_string().parse(), Ok(relation));
        }
        for (text, message) in [
            (
                "overlpas",
                r#"there is no relation "overlpas"; did you mean "overlaps"?"#,
            ),
            ("", r#"there is no relation """#),
            (
                "within of begin",
                r#""within of begin": after "within" stand a time and a place, such as 0.2s around, 200ms of begin or 1s of end"#,
            ),
            (
                "within NaNs around",
                r#""within NaNs around": after "within" stand a time and a place, such as 0.2s around, 200ms of begin or 1s of end"#,
            ),
        ] {
            assert_eq!(text.parse::<TimeRelation>().expect_err(text).to_string(), message);
        }
    }

    fn any_span() -> impl Strategy<Value = TimeSpan> {
        (0i64..12, 0i64..12).prop_map(|(a, b)| span(a, b))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn around_no_distance_is_inside(a in any_span(), b in any_span()) {
            prop_assert_eq!(TimeRelation::Around(-1).relation_holds(a, b), TimeRelation::Inside.relation_holds(a, b));
        }
    }
}
