//! The content of the pane of faces, without a window: moments in step, names of sentences, rows of reasons, places of a plot.

use chereme_corpus::{
    ChooseOptions, ExpressionMilestones, ExpressionPhase, FaceScore, FoundExpression, NonmanualOnsets, NumberQuartiles,
    OnsetRow, PerformanceChoice, RankingCriterion,
};
use chereme_motion::{RecordingInstant, TimeSpan};

/// The pause between two loops of an expression, in seconds.
pub(super) const EXPRESSION_LOOP_PAUSE_SECONDS: f64 = 0.4;

/// The channels of the face to compare, as names or beginnings of names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum ComparedChannels {
    /// Head and brows, as in the founding paper.
    #[default]
    Usual,
    /// The head alone.
    Head,
    /// The brows alone.
    Brows,
    /// Head, trunk and every channel of the face.
    All,
}

impl ComparedChannels {
    pub(super) const ALL_COMPARED_CHANNELS: [Self; 4] = [Self::Usual, Self::Head, Self::Brows, Self::All];

    fn compared_channel_names(self) -> Vec<String> {
        let names: &[&str] = match self {
            Self::Usual => &[],
            Self::Head => &["head"],
            Self::Brows => &["brow"],
            Self::All => &["head", "brow", "eye", "gaze", "nose", "jaw", "lip", "mouth", "cheek"],
        };
        names.iter().map(|name| (*name).to_owned()).collect()
    }
}

/// Returns the options of a choice among at most `most` candidates.
pub(super) fn face_choice_options(
    rank: RankingCriterion,
    compared: ComparedChannels,
    stretch: bool,
    most: usize,
) -> ChooseOptions {
    ChooseOptions {
        rank,
        stretch,
        channels: compared.compared_channel_names(),
        limit: most,
        ..ChooseOptions::default()
    }
}

/// Returns the part of a recording that shows an expression: from M1 to M5, but not before the recording's start.
pub(super) fn seen_span(milestones: &ExpressionMilestones) -> TimeSpan {
    let span = milestones.milestone_span();
    TimeSpan::span_between(
        span.span_start_instant().max(RecordingInstant::RECORDING_START),
        span.span_end_instant().max(RecordingInstant::from_micros(1)),
    )
}

/// Returns the time in a loop over the target's expression at `clock`, in seconds; the loop holds its end for a pause.
pub(super) fn loop_moment(target: &ExpressionMilestones, clock: f64) -> f64 {
    let span = target.milestone_span();
    let lasts = span.span_seconds();
    let into = clock
        .rem_euclid((lasts + EXPRESSION_LOOP_PAUSE_SECONDS).max(0.1))
        .min(lasts);
    span.span_start_instant().instant_seconds() + into
}

/// Returns the time within [`seen_span`] of a performance, in seconds, when the target is at `moment` seconds. With
/// `in_step` each phase is aligned with the target's phase; otherwise the performance keeps its own tempo.
pub(super) fn into_span(own: &ExpressionMilestones, target: &ExpressionMilestones, moment: f64, in_step: bool) -> f64 {
    let shown = match in_step {
        true => own.moment_for(target, moment),
        false => Some(
            own.milestone_span().span_start_instant().instant_seconds() + moment
                - target.milestone_span().span_start_instant().instant_seconds(),
        ),
    };
    let span = seen_span(own);
    let shown = shown.unwrap_or(span.span_start_instant().instant_seconds());
    let lasts = span.span_seconds();
    // At its very end a loop would show its beginning.
    (shown - span.span_start_instant().instant_seconds()).clamp(0.0, (lasts - 1e-6).max(0.0))
}

/// Returns the name of a sentence.
pub(super) fn found_sentence_name(it: &FoundExpression) -> String {
    match it.signs.is_empty() {
        true => it.recording.clone(),
        false => format!("{} · {}", it.recording, it.signs.join(" ")),
    }
}

/// Returns the rows that explain a score: for each phase its cost and the difference of each channel; the last row is
/// for all phases together.
pub(super) fn score_reason_rows(score: &FaceScore, channels: usize) -> Vec<(ExpressionPhase, Vec<String>)> {
    let number = |value: Option<f64>| value.map_or("–".to_owned(), |score| format!("{score:.2}"));
    let row = |phase: &chereme_corpus::PhaseScore| {
        let mut cells = vec![number(phase.normalized)];
        cells.extend((0..channels).map(|at| number(phase.channels.get(at).copied())));
        (phase.phase, cells)
    };
    score.phases.iter().map(row).collect()
}

/// Returns the proposed gloss for a sentence with the face of another performance.
pub(super) fn proposed_gloss(choice: &PerformanceChoice, sentence: &str, performer: &str) -> String {
    format!("{sentence}-{}-{performer}", choice.function)
        .to_uppercase()
        .replace(char::is_whitespace, "-")
}

/// The range of a plot of onsets, in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OnsetExtent {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl OnsetExtent {
    /// Returns the range that contains every box, and 0.
    pub(super) fn extent_of_onsets(onsets: &NonmanualOnsets, of: fn(&OnsetRow) -> Option<NumberQuartiles>) -> Self {
        let drawn = onsets.rows.iter().filter_map(of);
        let ends = drawn.flat_map(|quartiles| [quartiles.q1, quartiles.q3]);
        let (low, high) = ends.fold((-0.1_f64, 0.1_f64), |(low, high), end| (low.min(end), high.max(end)));
        Self { low, high }
    }

    /// Returns the position of a number in the range, from 0 to 1.
    pub(super) fn extent_share(self, seconds: f64) -> f32 {
        ((seconds - self.low) / (self.high - self.low)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marks(times: [i64; 5]) -> ExpressionMilestones {
        ExpressionMilestones::of_times(times.map(RecordingInstant::from_millis))
    }

    #[test]
    fn a_loop_holds_its_end_and_candidates_play_in_step_or_at_their_own_tempo() {
        let target = marks([1000, 1200, 1800, 2000, 2400]);
        let slow = marks([0, 400, 1600, 2000, 2800]);
        assert!((loop_moment(&target, 0.5) - 1.5).abs() < 1e-9);
        assert!((loop_moment(&target, 1.5) - 2.4).abs() < 1e-9, "held");
        assert!((loop_moment(&target, 1.8 + 0.3) - 1.3).abs() < 1e-9);
        let into = |moment, in_step| into_span(&slow, &target, moment, in_step);
        assert!((into(1.2, true) - 0.4).abs() < 1e-9, "both at M2");
        assert!((into(1.2, false) - 0.2).abs() < 1e-9);
        assert!(into(2.4, true) < 2.8 && into(2.4, true) > 2.79);
    }

    #[test]
    fn an_expression_is_shown_no_earlier_than_its_recording_begins() {
        let early = marks([-300, 200, 900, 1000, 1500]);
        let span = seen_span(&early);
        assert_eq!(span.span_bounds_micros(), (0, 1_500_000));
        assert_eq!(into_span(&early, &early, -0.3, true), 0.0);
        assert!((into_span(&early, &early, 0.2, true) - 0.2).abs() < 1e-9);
    }
}
