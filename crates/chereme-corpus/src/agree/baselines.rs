//! The simplest ways to cut takes, compared with the first annotator: a segmentation that is not better says nothing.

use chereme_analysis::agreement::span_measures::{SpanComparison, compare_span_lists, divide_evenly, grid_frames};
use chereme_motion::TimeSpan;

use super::BaselineAgreement;
use super::agree_figures::{annotator_units, segment_measures, unit_frames};
use super::agree_tiers::CodedTierPairs;
use crate::Corpus;
use crate::db::stored_recordings;
use crate::detect::ExaminedTake;
use crate::error::CorpusResult;
use crate::progress::ProgressReceiver;

/// The names of the baselines.
const BASELINE_NAMES: [&str; 3] = ["uniform", "speed_minima", "activities"];

/// Returns the figures of all baselines; none if a recording has no movement.
pub(super) fn measure_baselines(
    corpus: &Corpus,
    coded: &CodedTierPairs,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<Vec<BaselineAgreement>> {
    let connection = corpus.store.read_connection();
    let mut compared: [SpanComparison; 3] = Default::default();
    for (done, pair) in coded.pairs.iter().enumerate() {
        progress.report_items(&pair.recording.name, done, coded.pairs.len())?;
        // A baseline over a part of the recordings could not be compared with the figures over all.
        if stored_recordings::body_track(connection, pair.recording.id)?.is_none() {
            return Ok(Vec::new());
        }
        let truth = unit_frames(annotator_units(&pair.continuum).0);
        let baselines = ExaminedTake::open_examined_take(connection, &pair.recording, None)?.cut_into_baselines()?;
        let frames = |spans: &[TimeSpan]| {
            let micros = spans
                .iter()
                .map(|span| [span.span_start_instant(), span.span_end_instant()]);
            let micros = micros.map(|ends| ends.map(|instant| instant.instant_micros()));
            micros.map(|[start, end]| grid_frames(start, end)).collect::<Vec<_>>()
        };
        // The even cut is given the true number of units, so that only its places can be wrong.
        let whole = grid_frames(0, pair.recording.duration_us);
        let cuts = [
            divide_evenly(whole, truth.len()),
            frames(&baselines.speed_minima),
            frames(&baselines.activities),
        ];
        for (all, cut) in compared.iter_mut().zip(&cuts) {
            all.add_span_comparison(&compare_span_lists(&truth, cut));
        }
    }
    let named = BASELINE_NAMES.into_iter().zip(&compared);
    let rows = named.map(|(baseline, all)| BaselineAgreement {
        baseline,
        measures: segment_measures(all)
            .map(|(name, measure)| (name, measure.into()))
            .to_vec(),
    });
    Ok(rows.collect())
}
