//! Milestones of an expression of the face: the times at which it begins, changes and ends, relative to the signs that
//! it spans.
//!
//! Five milestones cut an expression into four phases: its onset (M1 to M2), its body in two parts (M2 to M3, M3 to M4)
//! and its offset (M4 to M5). Two performances of one function are compared, and one is mapped to the other's time,
//! phase by phase. Source: the fourth founding paper (facial expressions for animations of American Sign Language),
//! section 3.
//!
//! ```
//! use chereme_motion::{RecordingInstant, TimeSpan};
//! use chereme_sign::milestones::{UTTERANCE_EDGE_MICROS, ExpressionFunction, find_expression_milestones};
//!
//! let sign = |from, to| TimeSpan::span_between(RecordingInstant::from_millis(from), RecordingInstant::from_millis(to));
//! let signs = [sign(0, 400), sign(520, 800), sign(900, 1300), sign(1400, 2100), sign(2260, 2600)];
//! let found = find_expression_milestones(&signs, 1..4, &ExpressionFunction::from_function_name("negation"), UTTERANCE_EDGE_MICROS).expect("signs");
//! assert_eq!(found.to_string(), "0.400s 0.520s 0.900s 2.100s 2.260s");
//! ```

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::sync::LazyLock;

use chereme_motion::{RecordingInstant, TimeSpan};
use serde::{Deserialize, Serialize};

use crate::text::fold_text;

/// The time between an expression and the edge of an utterance, in microseconds.
pub const UTTERANCE_EDGE_MICROS: i64 = 500_000;

/// The grammatical function of an expression of the face in the signs that it spans.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ExpressionFunction(String);

/// The sign at which the body of an expression is cut in two.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum BodyCut {
    /// The second sign: NOT or another negation comes first.
    Second,
    /// The last sign: the question word, the doubled pronoun or the question mark comes last.
    Last,
}

/// The functions that have several names, by name in lower case and without punctuation: `schema/expression_words.json`.
static FUNCTION_NAMES: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let file = chereme_data::schema_text("expression_words.json");
    let file: BTreeMap<String, Vec<String>> =
        serde_json::from_str(file).expect("the shipped table of functions is whole; a test reads it");
    let names = file.into_iter().flat_map(|(function, names)| {
        let pair = move |name| (name, function.clone());
        names.into_iter().map(pair)
    });
    names.collect()
});

impl ExpressionFunction {
    /// Returns the function with that name. `negation`, `wh`, `yn`, `topic`, `conditional` and `rhetorical` have
    /// several names; any other name stands for itself, in lower case and without accents.
    #[must_use]
    pub fn from_function_name(name: &str) -> Self {
        let folded = fold_text(name.trim());
        let plain: String = folded.chars().filter(|letter| letter.is_alphanumeric()).collect();
        Self(FUNCTION_NAMES.get(&plain).cloned().unwrap_or(folded))
    }

    /// Returns its name.
    #[must_use]
    pub fn function_name(&self) -> &str {
        &self.0
    }

    /// Returns whether it is one of the functions with several names; the paper states their rules, or they are cut
    /// like those.
    #[must_use]
    pub fn is_known(&self) -> bool {
        FUNCTION_NAMES.values().any(|function| *function == self.0)
    }

    /// Returns the sign at which its body is cut: the second for negation, the last for all others.
    #[must_use]
    pub fn body_cut(&self) -> BodyCut {
        match &*self.0 {
            "negation" => BodyCut::Second,
            _ => BodyCut::Last,
        }
    }
}

impl fmt::Display for ExpressionFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// The milestones of one expression, on its recording's clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpressionMilestones {
    /// M1: the start of the onset. It may lie before the recording, and after M2 if signs overlap.
    #[serde(rename = "m1_us")]
    pub m1: RecordingInstant,
    /// M2: the start of the first sign.
    #[serde(rename = "m2_us")]
    pub m2: RecordingInstant,
    /// M3: the start of the sign at which the body is cut; `None` if there is one sign, whose body is one phase.
    #[serde(rename = "m3_us")]
    pub m3: Option<RecordingInstant>,
    /// M4: the end of the last sign.
    #[serde(rename = "m4_us")]
    pub m4: RecordingInstant,
    /// M5: the end of the offset. It may lie before M4 if signs overlap.
    #[serde(rename = "m5_us")]
    pub m5: RecordingInstant,
}

impl fmt::Display for ExpressionMilestones {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let m3 = self.m3.map_or("-".to_owned(), |m3| m3.to_string());
        let Self { m1, m2, m4, m5, .. } = self;
        write!(f, "{m1} {m2} {m3} {m4} {m5}")
    }
}

/// A phase of an expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ExpressionPhase {
    /// From M1 to M2.
    Onset,
    /// From M2 to M3: of a negation the first sign, else all signs but the last; empty if there is one sign.
    First,
    /// From M3 to M4: of a negation the other signs, else the last.
    Rest,
    /// From M4 to M5.
    Offset,
}

impl ExpressionPhase {
    /// Every phase in order.
    pub const ALL_EXPRESSION_PHASES: [Self; 4] = [Self::Onset, Self::First, Self::Rest, Self::Offset];

    /// Returns the name: `onset`, `first`, `rest` or `offset`.
    #[must_use]
    pub fn expression_phase_name(self) -> &'static str {
        match self {
            Self::Onset => "onset",
            Self::First => "first",
            Self::Rest => "rest",
            Self::Offset => "offset",
        }
    }

    /// Returns the milestones between which it lies, such as `M1-M2`.
    #[must_use]
    pub fn milestone_range_name(self) -> &'static str {
        match self {
            Self::Onset => "M1-M2",
            Self::First => "M2-M3",
            Self::Rest => "M3-M4",
            Self::Offset => "M4-M5",
        }
    }
}

impl ExpressionMilestones {
    /// Returns the milestones at five times that never decrease.
    #[must_use]
    pub fn of_times([m1, m2, m3, m4, m5]: [RecordingInstant; 5]) -> Self {
        Self {
            m1,
            m2,
            m3: (m3 != m2).then_some(m3),
            m4,
            m5,
        }
    }

    /// Returns five times that never decrease: an onset or offset of negative length, which overlapping signs would
    /// cause, becomes empty, and M3 is M2 if there is only one sign.
    #[must_use]
    pub fn milestone_times(&self) -> [RecordingInstant; 5] {
        let m3 = self.m3.unwrap_or(self.m2).max(self.m2);
        let m4 = self.m4.max(m3);
        [self.m1.min(self.m2), self.m2, m3, m4, self.m5.max(m4)]
    }

    /// Returns the span of each phase; empty ones are empty spans.
    #[must_use]
    pub fn phase_spans(&self) -> [TimeSpan; 4] {
        let times = self.milestone_times();
        std::array::from_fn(|n| TimeSpan::span_between(times[n], times[n + 1]))
    }

    /// Returns the span from M1 to M5.
    #[must_use]
    pub fn milestone_span(&self) -> TimeSpan {
        let phases = self.phase_spans();
        TimeSpan::span_between(phases[0].span_start_instant(), phases[3].span_end_instant())
    }

    /// Returns the span of the signs, from M2 to M4.
    #[must_use]
    pub fn expression_body_span(&self) -> TimeSpan {
        let times = self.milestone_times();
        TimeSpan::span_between(times[1], times[3])
    }

    /// Returns the milestones moved by `micros` microseconds.
    #[must_use]
    pub fn shift_milestones(&self, micros: i64) -> Self {
        Self {
            m1: self.m1.shifted_instant(micros),
            m2: self.m2.shifted_instant(micros),
            m3: self.m3.map(|m3| m3.shifted_instant(micros)),
            m4: self.m4.shifted_instant(micros),
            m5: self.m5.shifted_instant(micros),
        }
    }

    /// Returns the oddities of the milestones, as sentences for people.
    #[must_use]
    pub fn milestone_oddities(&self) -> Vec<String> {
        let mut odd = Vec::new();
        if self.m1 > self.m2 {
            odd.push("the sign before overlaps the first sign, so the onset is empty".to_owned());
        }
        if self.m5 < self.m4 {
            odd.push("the sign after overlaps the last sign, so the offset is empty".to_owned());
        }
        if self.m1 < RecordingInstant::RECORDING_START {
            let before = -self.m1.instant_seconds();
            odd.push(format!(
                "M1 lies {before:.3} s before the recording, where nothing is to be read"
            ));
        }
        odd
    }

    /// Returns the time in this performance, in seconds, that corresponds to a time of a target with other milestones:
    /// each phase is stretched evenly to the target's; `None` before the target's M1 and after its M5.
    ///
    /// If the middle part (from M2 to M4) is a single phase in one of them, it counts as a single phase in the other,
    /// too. A phase that is empty in the target is skipped; a phase that is empty here gives its only time.
    #[must_use]
    pub fn moment_for(&self, target: &Self, seconds: f64) -> Option<f64> {
        let one = self.m3.is_none() || target.m3.is_none();
        let (own, there) = (self.milestone_seconds(one), target.milestone_seconds(one));
        if seconds < there[0] || seconds > there[4] {
            return None;
        }
        if seconds == there[0] {
            return Some(own[0]);
        }
        let phase = (0..4).find(|&n| seconds <= there[n + 1] && there[n + 1] > there[n])?;
        let share = (seconds - there[phase]) / (there[phase + 1] - there[phase]);
        Some(own[phase] + share * (own[phase + 1] - own[phase]))
    }

    /// Returns M1 to M5 in seconds; M3 is M2 if the body counts as one phase.
    fn milestone_seconds(&self, one: bool) -> [f64; 5] {
        let mut times = self.milestone_times();
        if one {
            times[2] = times[1];
        }
        times.map(RecordingInstant::instant_seconds)
    }
}

/// Returns the milestones of an expression over the signs `of` in an utterance, whose `signs` are in order of time.
///
/// M1 is the end of the sign just before them, or `edge` microseconds before them if the utterance begins with them; M5
/// is found in the same way after them. `None` if `of` holds no sign.
#[must_use]
pub fn find_expression_milestones(
    signs: &[TimeSpan],
    of: Range<usize>,
    function: &ExpressionFunction,
    edge: i64,
) -> Option<ExpressionMilestones> {
    let spanned = signs.get(of.clone())?;
    let (first, last) = (spanned.first()?, spanned.last()?);
    let before = of.start.checked_sub(1).map(|at| signs[at].span_end_instant());
    let after = signs.get(of.end).map(|sign| sign.span_start_instant());
    let cut = match function.body_cut() {
        BodyCut::Second => spanned.get(1),
        BodyCut::Last => spanned.get(1..).and_then(<[TimeSpan]>::last),
    };
    Some(ExpressionMilestones {
        m1: before.unwrap_or(first.span_start_instant().shifted_instant(-edge)),
        m2: first.span_start_instant(),
        m3: cut.map(|sign| sign.span_start_instant()),
        m4: last.span_end_instant(),
        m5: after.unwrap_or(last.span_end_instant().shifted_instant(edge)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ms(millis: i64) -> RecordingInstant {
        RecordingInstant::from_millis(millis)
    }

    fn signs(times: &[(i64, i64)]) -> Vec<TimeSpan> {
        times
            .iter()
            .map(|(from, to)| TimeSpan::span_between(ms(*from), ms(*to)))
            .collect()
    }

    fn found(times: &[(i64, i64)], of: Range<usize>, function: &str) -> ExpressionMilestones {
        find_expression_milestones(
            &signs(times),
            of,
            &ExpressionFunction::from_function_name(function),
            UTTERANCE_EDGE_MICROS,
        )
        .expect("signs")
    }

    /// Returns M1 to M5 in milliseconds; a missing M3 as `i64::MIN`.
    fn millis(it: &ExpressionMilestones) -> [i64; 5] {
        let m3 = it.m3.map_or(i64::MIN, RecordingInstant::instant_millis);
        [
            it.m1.instant_millis(),
            it.m2.instant_millis(),
            m3,
            it.m4.instant_millis(),
            it.m5.instant_millis(),
        ]
    }

    #[test]
    fn milestones_follow_the_signs() {
        const NONE: i64 = i64::MIN;
        let four = &[(100, 400), (500, 900), (1000, 1500), (1600, 1900)][..];
        let cases = [
            (four, 0..4, "yn", [-400, 100, 1600, 1900, 2400]),
            (four, 1..3, "wh", [400, 500, 1000, 1500, 1600]),
            (four, 0..3, "negation", [-400, 100, 500, 1500, 1600]),
            (four, 1..4, "Négation", [400, 500, 1000, 1900, 2400]),
            (four, 0..3, "topic", [-400, 100, 1000, 1500, 1600]),
            (four, 2..3, "wh", [900, 1000, NONE, 1500, 1600]),
            (four, 2..3, "neg", [900, 1000, NONE, 1500, 1600]),
            (&[(0, 500), (500, 900)], 1..2, "wh", [500, 500, NONE, 900, 1400]),
            (
                &[(0, 500), (450, 900), (850, 990)],
                1..2,
                "yn",
                [500, 450, NONE, 900, 850],
            ),
        ];
        for (times, of, function, want) in cases {
            assert_eq!(millis(&found(times, of.clone(), function)), want, "{of:?} {function}");
        }
        let none = find_expression_milestones(
            &signs(four),
            4..4,
            &ExpressionFunction::from_function_name("wh"),
            UTTERANCE_EDGE_MICROS,
        );
        assert_eq!(
            (
                none,
                find_expression_milestones(
                    &[],
                    0..1,
                    &ExpressionFunction::from_function_name("wh"),
                    UTTERANCE_EDGE_MICROS
                )
            ),
            (None, None)
        );
    }

    #[test]
    fn overlapping_signs_leave_an_empty_phase_that_is_reported() {
        let it = found(&[(0, 500), (450, 900), (850, 990)], 1..2, "yn");
        let lengths: Vec<i64> = it.phase_spans().iter().map(|span| span.span_micros() / 1000).collect();
        assert_eq!(lengths, [0, 0, 450, 0]);
        assert_eq!(it.milestone_span(), TimeSpan::span_between(ms(450), ms(900)));
        assert_eq!(it.milestone_oddities().len(), 2);
        let early = found(&[(200, 900)], 0..1, "yn");
        assert!(early.milestone_oddities()[0].contains("0.300 s before the recording"));
        assert_eq!(
            found(&[(0, 100), (200, 300), (400, 500)], 1..2, "wh").milestone_oddities(),
            [""; 0]
        );
    }

    #[test]
    fn functions_are_known_by_several_names() {
        for (name, id) in [
            ("WH-question", "wh"),
            ("Yes/No", "yn"),
            ("Neg.", "negation"),
            ("question fermée", "yn"),
            ("Affect", "affect"),
        ] {
            assert_eq!(
                ExpressionFunction::from_function_name(name).function_name(),
                id,
                "{name}"
            );
        }
        assert!(
            ExpressionFunction::from_function_name("topic").is_known()
                && !ExpressionFunction::from_function_name("affect").is_known()
        );
    }

    #[test]
    fn warping_maps_milestones_to_milestones_and_stretches_phases_evenly() {
        let at = |times: [i64; 5]| ExpressionMilestones::of_times(times.map(ms));
        let (own, there) = (at([0, 300, 800, 1000, 1400]), at([100, 200, 1200, 1300, 1900]));
        for (own_at, there_at) in [0.0, 0.3, 0.8, 1.0, 1.4].into_iter().zip([0.1, 0.2, 1.2, 1.3, 1.9]) {
            let moment = own.moment_for(&there, there_at).expect("inside");
            assert!((moment - own_at).abs() < 1e-9, "{there_at}: {moment}");
        }
        let middle = own.moment_for(&there, 0.7).expect("inside");
        assert!((middle - 0.55).abs() < 1e-9, "{middle}");
        assert_eq!(
            (own.moment_for(&there, 0.05), own.moment_for(&there, 1.95)),
            (None, None)
        );
        let no_onset = at([100, 100, 1200, 1300, 1900]);
        assert_eq!(own.moment_for(&no_onset, 0.1), Some(0.0));
        let passed = own.moment_for(&no_onset, 0.1001).expect("inside");
        assert!((passed - 0.3).abs() < 1e-3, "{passed}");
        let (short, long) = (at([0, 200, 200, 600, 700]), at([0, 500, 500, 900, 1000]));
        let half = short.moment_for(&long, 0.7).expect("inside");
        assert!((half - 0.4).abs() < 1e-9, "{half}");
        let held = no_onset.moment_for(&own, 0.15).expect("inside");
        assert!((held - 0.1).abs() < 1e-9, "an onset that is empty here is held");
    }
}
