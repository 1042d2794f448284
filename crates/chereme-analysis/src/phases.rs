//! Scores performances phase by phase: the similarity of two expressions of the face, independently of their tempo.
//!
//! Each of the four phases of one performance is aligned with the same phase of the other by dynamic time warping; the
//! costs, each divided by the number of frames in the query's phase, are added and multiplied by the ratio of lengths.
//! Source: the fourth founding paper (facial expressions for animations of American Sign Language), section 5.1,
//! algorithm 1; R's `dtw` with the step pattern `asymmetric` and a Sakoe-Chiba window of 10 frames.
//!
//! ```
//! use chereme_analysis::phases::{PhasedScoreOptions, PhasedPerformance, score_phased_candidate};
//!
//! let gold = PhasedPerformance::new(&[vec![0.0, 1.0, 1.0, 0.5, 0.0, 0.0]], [0, 1, 3, 4, 6], 0.2)?;
//! let slow = PhasedPerformance::new(&[vec![0.0, 0.0, 1.0, 1.0, 1.0, 0.5, 0.0]], [0, 2, 5, 6, 7], 0.25)?;
//! let found = score_phased_candidate(&gold, &slow, 0.2, &PhasedScoreOptions::default())?;
//! assert_eq!(found.score, 0.0, "the same but for its tempo");
//! assert!((found.stretch - 0.8).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use chereme_sign::milestones::ExpressionPhase;
use serde::{Deserialize, Serialize};

use crate::dtw::{self, AlignmentWindow, ChannelSeries, CostMethod, DtwError, DtwPathPolicy, StepPattern};

/// A performance cut into its phases.
#[derive(Debug, Clone, PartialEq)]
pub struct PhasedPerformance {
    phases: [Option<ChannelSeries>; 4],
    frames: [usize; 4],
    seconds: f64,
}

/// The reason why performances cannot be compared phase by phase.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PhasedError {
    /// Milestones decrease or lie beyond the last frame.
    #[error("the milestones {milestones:?} do not cut {frames} frames into phases")]
    Milestones {
        /// The milestones, in frames.
        milestones: [usize; 5],
        /// The number of frames.
        frames: usize,
    },
    /// A length is not a positive number of seconds.
    #[error("{0} is no length in seconds")]
    Length(f64),
    /// A phase cannot be aligned.
    #[error("{}: {cause}", phase.expression_phase_name())]
    Phase {
        /// The phase.
        phase: ExpressionPhase,
        /// The reason.
        cause: DtwError,
    },
    /// The two have no phase in common.
    #[error("the two performances have no phase in common")]
    Nothing,
}

impl PhasedPerformance {
    /// Returns a performance: channels scaled so that 1 means the same difference in all of them, milestones M1 to M5
    /// in frames, and its length in seconds. A frame on a milestone belongs to the phase that begins there.
    ///
    /// # Errors
    /// [`PhasedError::Milestones`], [`PhasedError::Length`], and [`PhasedError::Phase`] if a channel contains an
    /// invalid number.
    pub fn new(channels: &[Vec<f64>], milestones: [usize; 5], seconds: f64) -> Result<Self, PhasedError> {
        let frames = channels.first().map_or(0, Vec::len);
        let ordered = milestones.windows(2).all(|pair| pair[0] <= pair[1]);
        if !ordered || milestones[4] > frames {
            return Err(PhasedError::Milestones { milestones, frames });
        }
        if !(seconds.is_finite() && seconds > 0.0) {
            return Err(PhasedError::Length(seconds));
        }
        let mut phases = [None, None, None, None];
        for (n, phase) in ExpressionPhase::ALL_EXPRESSION_PHASES.into_iter().enumerate() {
            let phase_frames = milestones[n]..milestones[n + 1];
            if phase_frames.is_empty() {
                continue;
            }
            let columns: Vec<&[f64]> = channels
                .iter()
                .map(|column| column.get(phase_frames.clone()).unwrap_or_default())
                .collect();
            let series = ChannelSeries::from_columns(&columns);
            phases[n] = Some(series.map_err(|cause| PhasedError::Phase { phase, cause })?);
        }
        Ok(Self {
            phases,
            frames: std::array::from_fn(|n| milestones[n + 1] - milestones[n]),
            seconds,
        })
    }

    /// Returns its length in seconds.
    #[must_use]
    pub fn phased_seconds(&self) -> f64 {
        self.seconds
    }
}

/// The treatment of a phase whose lengths no path connects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoPath {
    /// The score is refused, as dtw-python and R do.
    Refuse,
    /// The window becomes a slanted band; if the step pattern still forbids a path, the candidate's phase is resampled
    /// to the query's length. [`PhaseScore::made`] reports this.
    #[default]
    Adapt,
}

/// Options of a score.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PhasedScoreOptions {
    /// Half the window's width in frames.
    pub window: usize,
    /// The treatment of a phase without a path.
    pub no_path: NoPath,
    /// The factor of each phase's cost.
    pub weights: [f64; 4],
}

impl Default for PhasedScoreOptions {
    /// A window of 10 frames, a third of a second at 30 frames per second; all phases have equal weight.
    fn default() -> Self {
        Self {
            window: 10,
            no_path: NoPath::default(),
            weights: [1.0; 4],
        }
    }
}

/// The score of two performances.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PhasedScore {
    /// The sum over phases times the ratio of lengths; 0 means equal. It has no upper limit and no unit.
    pub score: f64,
    /// The sum over phases, without the ratio.
    pub unstretched: f64,
    /// The ratio of the target's length to that of the candidate.
    pub stretch: f64,
    /// The absolute value of that ratio's natural logarithm: stretching and compression count alike.
    pub log_stretch: f64,
    /// Whether a phase was left out because one of the two lacks it.
    pub partial: bool,
    /// The phases, in order.
    pub phases: Vec<PhaseScore>,
}

/// The score of two performances in one phase.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PhaseScore {
    /// The phase.
    pub phase: ExpressionPhase,
    /// Frames of the query and of the candidate.
    pub frames: [usize; 2],
    /// The cost of the best alignment; `None` if the phase is empty in one of them.
    pub distance: Option<f64>,
    /// The cost divided by the query's frames; 0 if the phase is empty in both.
    pub normalized: Option<f64>,
    /// How the alignment was computed; `None` without one.
    pub made: Option<CostMethod>,
    /// For each channel the mean difference of aligned frames, in the units of the channels; only on request.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<f64>,
}

/// Returns the score of a candidate against a query whose expression lasts `seconds` in the target.
///
/// # Errors
/// [`PhasedError::Phase`] if channels differ or, by [`NoPath::Refuse`], if no path exists; [`PhasedError::Nothing`];
/// [`PhasedError::Length`].
pub fn score_phased_candidate(
    query: &PhasedPerformance,
    candidate: &PhasedPerformance,
    seconds: f64,
    options: &PhasedScoreOptions,
) -> Result<PhasedScore, PhasedError> {
    compute_phased_score(query, candidate, seconds, options, false)
}

/// Returns the same as [`score_phased_candidate`], with the differences of each channel.
///
/// # Errors
/// As [`score_phased_candidate`].
pub fn explain_phased_score(
    query: &PhasedPerformance,
    candidate: &PhasedPerformance,
    seconds: f64,
    options: &PhasedScoreOptions,
) -> Result<PhasedScore, PhasedError> {
    compute_phased_score(query, candidate, seconds, options, true)
}

fn compute_phased_score(
    query: &PhasedPerformance,
    candidate: &PhasedPerformance,
    seconds: f64,
    options: &PhasedScoreOptions,
    explain: bool,
) -> Result<PhasedScore, PhasedError> {
    if !(seconds.is_finite() && seconds > 0.0) {
        return Err(PhasedError::Length(seconds));
    }
    let mut phases = Vec::with_capacity(4);
    let (mut sum, mut partial, mut compared) = (0.0, false, 0);
    for (n, phase) in ExpressionPhase::ALL_EXPRESSION_PHASES.into_iter().enumerate() {
        let mut phase_score = PhaseScore {
            phase,
            frames: [query.frames[n], candidate.frames[n]],
            distance: None,
            normalized: None,
            made: None,
            channels: Vec::new(),
        };
        match (&query.phases[n], &candidate.phases[n]) {
            (Some(a), Some(b)) => {
                let alignment_result = align_phase_series(a, b, options, explain);
                let aligned = alignment_result.map_err(|cause| PhasedError::Phase { phase, cause })?;
                // The asymmetric pattern counts every frame of the query once.
                let normalized = aligned.distance / a.series_frame_count() as f64;
                sum += options.weights[n] * normalized;
                compared += 1;
                phase_score.distance = Some(aligned.distance);
                phase_score.normalized = Some(normalized);
                phase_score.made = Some(aligned.made);
                phase_score.channels = aligned.channels;
            }
            (None, None) => phase_score.normalized = Some(0.0),
            _ => partial = true,
        }
        phases.push(phase_score);
    }
    if compared == 0 {
        return Err(PhasedError::Nothing);
    }
    let stretch = seconds / candidate.seconds;
    Ok(PhasedScore {
        score: sum * stretch,
        unstretched: sum,
        stretch,
        log_stretch: stretch.ln().abs(),
        partial,
        phases,
    })
}

struct AlignedPhase {
    distance: f64,
    made: CostMethod,
    channels: Vec<f64>,
}

fn align_phase_series(
    query: &ChannelSeries,
    candidate: &ChannelSeries,
    options: &PhasedScoreOptions,
    explain: bool,
) -> Result<AlignedPhase, DtwError> {
    let mut dtw = dtw::DtwOptions {
        pattern: StepPattern::Asymmetric,
        window: AlignmentWindow::SakoeChiba(options.window),
        ..dtw::DtwOptions::default()
    };
    // A band keeps the frames as they are; resampling is the last resort.
    let policies = match options.no_path {
        NoPath::Refuse => &[DtwPathPolicy::Refuse][..],
        NoPath::Adapt => &[DtwPathPolicy::SlantedBand, DtwPathPolicy::Resample],
    };
    let mut last = None;
    for policy in policies {
        dtw.policy = *policy;
        let outcome = match explain {
            true => dtw::align_series(query, candidate, &dtw).map(|alignment| (alignment.cost, alignment.path)),
            false => dtw::dtw_distance(query, candidate, &dtw).map(|cost| (cost, Vec::new())),
        };
        match outcome {
            Ok((cost, path)) => {
                return Ok(AlignedPhase {
                    distance: cost.distance,
                    made: cost.made,
                    channels: match explain {
                        true => channel_differences(query, candidate, &path),
                        false => Vec::new(),
                    },
                });
            }
            Err(error @ DtwError::NoPath { .. }) => last = Some(error),
            Err(error) => return Err(error),
        }
    }
    Err(last.unwrap_or(DtwError::Empty))
}

fn channel_differences(query: &ChannelSeries, candidate: &ChannelSeries, path: &[(usize, usize)]) -> Vec<f64> {
    let mean = |channel: usize| {
        let (a, b) = (query.channel_values(channel), candidate.channel_values(channel));
        let sum: f64 = path.iter().map(|&(i, j)| (a[i] - b[j]).abs()).sum();
        sum / path.len().max(1) as f64
    };
    (0..query.series_channel_count()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(frames: usize, tempo: f64) -> Vec<Vec<f64>> {
        let value = |channel: usize| {
            let at = move |frame: usize| (frame as f64 * tempo * 0.2 + channel as f64).sin();
            (0..frames).map(at).collect()
        };
        (0..3).map(value).collect()
    }

    #[test]
    fn a_performance_scores_zero_with_itself_and_similar_ones_score_lower() {
        let marks = [0, 10, 40, 55, 70];
        let own = PhasedPerformance::new(&wave(70, 1.0), marks, 70.0 / 30.0).expect("phases");
        let near = PhasedPerformance::new(&wave(70, 1.05), marks, 70.0 / 30.0).expect("phases");
        let far = PhasedPerformance::new(&wave(70, 1.9), marks, 70.0 / 30.0).expect("phases");
        let of =
            |other| score_phased_candidate(&own, other, 70.0 / 30.0, &PhasedScoreOptions::default()).expect("scored");
        assert_eq!(of(&own).score, 0.0);
        assert!(of(&near).score < of(&far).score, "{:?}", of(&near));
        let it = explain_phased_score(&own, &far, 70.0 / 30.0, &PhasedScoreOptions::default()).expect("scored");
        assert!((it.score - of(&far).score).abs() < 1e-9);
        assert!(it.phases.iter().all(|phase| phase.channels.len() == 3));
        assert!(it.phases[1].channels.iter().all(|mean| *mean > 0.0));
    }

    /// The expected numbers were computed by a short program that fills the table of the recursion cell by cell.
    #[test]
    fn scores_equal_those_of_the_plain_recursion() {
        let wave = |frames: u32, tempo: f64, shift: f64| -> Vec<Vec<f64>> {
            let value = |channel: u32, frame: u32| {
                let value = (tempo * f64::from(frame) + f64::from(channel) + shift).sin();
                (value * 1000.0).round() / 1000.0
            };
            let column = |channel| (0..frames).map(|frame| value(channel, frame)).collect();
            (0..2).map(column).collect()
        };
        let gold = PhasedPerformance::new(&wave(24, 0.31, 0.0), [0, 5, 14, 19, 24], 0.8).expect("phases");
        let other = PhasedPerformance::new(&wave(27, 0.27, 0.2), [0, 6, 16, 20, 27], 0.9).expect("phases");
        let refuse = PhasedScoreOptions {
            no_path: NoPath::Refuse,
            ..PhasedScoreOptions::default()
        };
        let found = score_phased_candidate(&gold, &other, 0.8, &refuse).expect("scored");
        let want = [
            0.7110492185227757,
            0.9229278133337973,
            0.6963985331701481,
            0.7055101101105855,
        ];
        for (phase, want) in found.phases.iter().zip(want) {
            let distance = phase.distance.expect("a distance");
            assert!((distance - want).abs() < 1e-9, "{distance} {want}");
        }
        assert!((found.score - 0.466790317489394).abs() < 1e-9, "{}", found.score);
    }

    #[test]
    fn phases_empty_in_both_cost_nothing_and_in_one_make_the_score_partial() {
        let whole = PhasedPerformance::new(&wave(30, 1.0), [0, 5, 15, 20, 30], 1.0).expect("phases");
        let one = PhasedPerformance::new(&wave(30, 1.0), [0, 5, 5, 20, 30], 1.0).expect("phases");
        let both = score_phased_candidate(&one, &one, 1.0, &PhasedScoreOptions::default()).expect("scored");
        assert_eq!((both.partial, both.phases[1].normalized), (false, Some(0.0)));
        let half = score_phased_candidate(&whole, &one, 1.0, &PhasedScoreOptions::default()).expect("scored");
        assert_eq!((half.partial, half.phases[1].normalized), (true, None));
        let onset = PhasedPerformance::new(&wave(30, 1.0), [0, 30, 30, 30, 30], 1.0).expect("phases");
        let offset = PhasedPerformance::new(&wave(30, 1.0), [0, 0, 0, 0, 30], 1.0).expect("phases");
        assert_eq!(
            score_phased_candidate(&onset, &offset, 1.0, &PhasedScoreOptions::default()),
            Err(PhasedError::Nothing)
        );
    }

    #[test]
    fn a_phase_without_a_path_is_refused_by_name_or_scored_by_another_method() {
        let long = PhasedPerformance::new(&wave(70, 1.0), [0, 10, 50, 60, 70], 1.0).expect("phases");
        let short = PhasedPerformance::new(&wave(50, 1.0), [0, 10, 30, 40, 50], 1.0).expect("phases");
        let refuse = PhasedScoreOptions {
            no_path: NoPath::Refuse,
            ..PhasedScoreOptions::default()
        };
        let error = score_phased_candidate(&long, &short, 1.0, &refuse).expect_err("no path");
        assert!(error.to_string().starts_with("first: "), "{error}");
        let made = score_phased_candidate(&long, &short, 1.0, &PhasedScoreOptions::default()).expect("scored");
        assert!(
            matches!(made.phases[1].made, Some(CostMethod::SlantedBand(_))),
            "{made:?}"
        );
        let steep = PhasedPerformance::new(&wave(130, 1.0), [0, 10, 110, 120, 130], 1.0).expect("phases");
        let made = score_phased_candidate(&short, &steep, 1.0, &PhasedScoreOptions::default()).expect("scored");
        assert_eq!(made.phases[1].made, Some(CostMethod::Resampled));
    }

    #[test]
    fn invalid_milestones_durations_and_columns_are_refused() {
        let columns = wave(10, 1.0);
        for marks in [[0, 1, 2, 3, 11], [0, 3, 2, 4, 5]] {
            let error = PhasedPerformance::new(&columns, marks, 1.0).expect_err("no phases");
            assert!(matches!(error, PhasedError::Milestones { .. }));
        }
        for seconds in [0.0, -1.0, f64::NAN] {
            assert!(PhasedPerformance::new(&columns, [0, 1, 2, 3, 4], seconds).is_err());
        }
        let gap = vec![vec![f64::NAN; 10]];
        assert!(PhasedPerformance::new(&gap, [0, 1, 2, 3, 4], 1.0).is_err());
        let other = PhasedPerformance::new(&columns[..2], [0, 1, 2, 3, 4], 1.0).expect("phases");
        let own = PhasedPerformance::new(&columns, [0, 1, 2, 3, 4], 1.0).expect("phases");
        assert!(score_phased_candidate(&own, &other, 1.0, &PhasedScoreOptions::default()).is_err());
    }
}
