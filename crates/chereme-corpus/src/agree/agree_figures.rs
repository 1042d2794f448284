//! The measures of all pairs of tiers together, and of each pair.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use chereme_analysis::agreement::agreement_resample::{BootstrapInterval, draw_bootstrap_samples};
use chereme_analysis::agreement::gamma::{AlignmentCosts, GammaAgreement, GammaSampling, measure_gamma_agreement};
use chereme_analysis::agreement::items::{AgreementCounts, AlphaScale, AnnotatedItem, krippendorff_alpha};
use chereme_analysis::agreement::matching::{
    HolleReinRow, HolleReinTable, build_matching_rows, match_overlapping_units, overlap_ratio,
};
use chereme_analysis::agreement::segments::{SegmentationEdits, count_segmentation_edits};
use chereme_analysis::agreement::span_measures::{SpanComparison, compare_span_lists, grid_frames};
use chereme_analysis::agreement::unitizing::{alpha_u, measure_frame_agreement, u_alpha, unitizing_disagreements};
use chereme_analysis::agreement::{AgreementMeasure, AnnotatedUnit, AnnotationContinuum, UndefinedAgreement};
use serde::Serialize;

use super::agree_tiers::{CodedTierPairs, TierPair};
use super::disagreements::{ValueDistances, count_disagreement_kinds, list_disagreements};
use super::{AgreeOptions, AnnotatorAgreement, PairAgreement, UnitCounts};
use crate::error::{CorpusError, CorpusResult};
use crate::face::NumberQuartiles;
use crate::progress::{ProgressReceiver, ProgressStep, ProgressUnit as Amount};

/// The names of all measures, in the order in which they are reported.
///
/// - `kappa_ipf`: modified kappa of Holle and Rein over all units; `raw`, `kappa`, `kappa_max`: the same table's share of
///   agreement, kappa with ordinary chance, and largest kappa; `matched`: share of units with a partner.
/// - `alpha_u`: Krippendorff's alpha of spans and values; `u_alpha`, `u_alpha_spans`, `cu_alpha`: those of 2016.
/// - `gamma`, `gamma_cat`: Mathet's, by alignment; `label_…`: values of matched units alone.
/// - `overlap_a`, `overlap_b`: ELAN's ratio, which depends on the first tier; `frames_…`: 10 ms each, gaps are a value.
/// - `boundaries`: boundary similarity of tiers without gaps, at 40 ms.
/// - `segment_…`: spans on a grid of 40 ms whatever their values, the first tier being the truth: mF1S and mF1B of Renz et al.,
///   F1 of spans that overlap by more than half, IoU of all frames, mean overlap of matched pairs, units of the second for each
///   of the first, and splits and merges for each unit of the first.
pub const MEASURE_NAMES: [&str; 31] = [
    "kappa_ipf",
    "raw",
    "matched",
    "kappa",
    "kappa_max",
    "alpha_u",
    "u_alpha",
    "u_alpha_spans",
    "cu_alpha",
    "gamma",
    "gamma_cat",
    "label_raw",
    "label_kappa",
    "label_pi",
    "label_ac1",
    "label_alpha",
    "label_alpha_features",
    "overlap_a",
    "overlap_b",
    "frames_raw",
    "frames_kappa",
    "frames_alpha",
    "boundaries",
    "segment_mf1s",
    "segment_mf1b",
    "segment_f1",
    "segment_iou",
    "segment_overlap",
    "segment_count",
    "segment_splits",
    "segment_merges",
];

/// The measures that are shown to people who ask for no others.
pub const USUAL_MEASURES: [&str; 5] = ["kappa_ipf", "raw", "matched", "alpha_u", "gamma"];

/// The length of a frame of the measures of frames, in milliseconds.
const MEASURE_FRAME_MS: i64 = 10;
/// The step of boundary similarity in milliseconds, and how many steps apart two boundaries are two.
const BOUNDARY_STEP_MS: i64 = 40;
const NEAR_BOUNDARY_STEPS: usize = 3;
/// From so many recordings on, recordings are drawn for intervals instead of units.
const MIN_DRAWN_RECORDINGS: usize = 10;

/// A measure: its value, or the reason why it has none.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureFigure {
    /// The value.
    pub value: Option<f64>,
    /// The reason why there is no value.
    pub why: Option<String>,
    /// The interval of 95 %.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub interval: Option<FigureInterval>,
}

/// The interval of a measure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FigureInterval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
    /// How many draws it comes from.
    pub draws: usize,
    /// What was drawn: `units`, `recordings`, or the `samples` of gamma's chance, whose interval says nothing about other
    /// recordings.
    pub of: &'static str,
}

impl MeasureFigure {
    /// Returns the value with three decimals, never as -0.000.
    #[must_use]
    pub fn figure_text(&self) -> Option<String> {
        // Adding 0 turns a rounded -0 into 0.
        self.value
            .map(|value| format!("{:.3}", (1e3 * value).round() / 1e3 + 0.0))
    }
}

impl From<AgreementMeasure> for MeasureFigure {
    fn from(measure: AgreementMeasure) -> Self {
        Self {
            value: measure.ok(),
            why: measure.err().map(|reason| reason.to_string()),
            interval: None,
        }
    }
}

pub(super) fn serialize_figures_in_order<S: serde::Serializer>(
    measures: &[(&'static str, MeasureFigure)],
    out: S,
) -> std::result::Result<S::Ok, S::Error> {
    out.collect_map(measures.iter().map(|(name, figure)| (name, figure)))
}

/// The agreement on one value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValueAgreement {
    /// The value.
    pub value: String,
    /// The units of the first with it.
    pub a: u64,
    /// The units of the second with it.
    pub b: u64,
    /// The matched pairs in which both gave it.
    pub both: u64,
    /// The matched pairs in which only one gave it.
    pub other: u64,
    /// The units with it that nobody else has.
    pub alone: u64,
    /// Modified kappa's table of the value against all others: the share of agreement.
    pub raw: MeasureFigure,
    /// Kappa of that table.
    pub kappa: MeasureFigure,
    /// Alpha_U of the value.
    pub alpha_u: MeasureFigure,
}

/// Two values that the annotators gave to matched units.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ValueConfusion {
    /// The value of the first.
    pub a: String,
    /// The value of the second.
    pub b: String,
    /// How often.
    pub count: u64,
    /// The features that only the first value has.
    pub only_a: Vec<String>,
    /// The features that only the second value has.
    pub only_b: Vec<String>,
}

/// The matched units of a pair of tiers.
struct MatchedUnits<'a> {
    first: &'a [AnnotatedUnit],
    second: &'a [AnnotatedUnit],
    pairs: Vec<(usize, usize)>,
    rows: Vec<HolleReinRow>,
}

impl<'a> MatchedUnits<'a> {
    fn match_pair_units(pair: &'a TierPair, share: f64) -> Self {
        let (first, second) = annotator_units(&pair.continuum);
        // The rows of the table hold units without a partner too, so they need the pairs and all units.
        let pairs = match_overlapping_units(first, second, share);
        let rows = build_matching_rows(first, second, &pairs);
        Self {
            first,
            second,
            pairs,
            rows,
        }
    }

    fn matched_unit_counts(&self, left_out: [u64; 2]) -> UnitCounts {
        let all_pairs = self.pairs.iter();
        let equal = all_pairs.filter(|(a, b)| self.first[*a].value == self.second[*b].value);
        let matched = self.pairs.len();
        UnitCounts {
            units_a: self.first.len() as u64,
            units_b: self.second.len() as u64,
            matched: matched as u64,
            equal: equal.count() as u64,
            unmatched_a: (self.first.len() - matched) as u64,
            unmatched_b: (self.second.len() - matched) as u64,
            left_out_a: left_out[0],
            left_out_b: left_out[1],
        }
    }
}

/// Returns the units of the two annotators.
pub(super) fn annotator_units(continuum: &AnnotationContinuum) -> (&[AnnotatedUnit], &[AnnotatedUnit]) {
    match continuum.annotator_tiers() {
        // A continuum without any tier is one in which nobody coded anything.
        [first, second, ..] => (first, second),
        _ => (&[], &[]),
    }
}

/// Returns the agreement over all pairs of tiers, and of each.
pub(super) fn measure_agreement(
    coded: &CodedTierPairs,
    options: &AgreeOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<AnnotatorAgreement> {
    let all: Vec<MatchedUnits<'_>> = coded
        .pairs
        .iter()
        .map(|pair| MatchedUnits::match_pair_units(pair, options.share))
        .collect();
    let mut counts = UnitCounts::default();
    let mut pairs = Vec::new();
    for (pair, matched) in coded.pairs.iter().zip(&all) {
        let pair_counts = matched.matched_unit_counts(pair.left_out);
        counts.add_unit_counts(&pair_counts);
        // A single pair has the measures of all pairs, which are computed once below.
        let measures = match coded.pairs.len() {
            1 => Vec::new(),
            _ => measures_without_gamma(&[pair], std::slice::from_ref(matched), coded, options),
        };
        pairs.push(PairAgreement {
            recording: pair.recording.name.clone(),
            tier_a: pair.a.name.clone(),
            tier_b: pair.b.name.clone(),
            counts: pair_counts,
            measures,
        });
    }
    let every: Vec<&TierPair> = coded.pairs.iter().collect();
    let mut figures = measures_without_gamma(&every, &all, coded, options);
    if let [only] = &mut pairs[..] {
        only.measures.clone_from(&figures);
    }
    // Intervals and gamma are added after the pair has taken its copy, which goes without them.
    add_intervals(&mut figures, &all, coded, options, progress)?;
    add_gamma(&mut figures, coded, options, progress)?;
    // They were added in the order of their computation, and are reported in that of their names.
    let place = |name: &str| MEASURE_NAMES.iter().position(|measure| *measure == name);
    figures.sort_by_key(|(name, _)| place(name));
    let distances = ValueDistances::distances_of_coded(coded);
    let mut findings = coded.findings.clone();
    let list = list_disagreements(coded, &distances, options, &mut findings);
    let moved = |of: fn(&AnnotatedUnit) -> i64| {
        let apart = |matched: &MatchedUnits<'_>| -> Vec<f64> {
            let pairs = matched.pairs.iter();
            pairs
                .map(|(a, b)| (of(&matched.second[*b]) - of(&matched.first[*a])) as f64 / 1000.0)
                .collect()
        };
        NumberQuartiles::quartiles_from_values(all.iter().flat_map(apart).collect())
    };
    if counts.left_out_a + counts.left_out_b > 0 {
        findings.push(format!(
            "annotations without a value are left out: {} of {:?}, {} of {:?}",
            counts.left_out_a, options.a, counts.left_out_b, options.b
        ));
    }
    Ok(AnnotatorAgreement {
        a: options.a.clone(),
        b: options.b.clone(),
        values: if coded.spans_only { 0 } else { coded.values.len() },
        counts_only: counts.are_few() || coded.values.len() < 2,
        counts,
        measures: figures,
        onset_s: moved(|unit| unit.start),
        offset_s: moved(|unit| unit.end),
        by_value: by_value(coded, &all),
        disagreements: count_disagreement_kinds(&list),
        pairs,
        baselines: Vec::new(),
        findings,
        confusion: value_confusions(coded, &all),
        list,
    })
}

/// Returns the measures without gamma and intervals.
fn measures_without_gamma(
    pairs: &[&TierPair],
    all: &[MatchedUnits<'_>],
    coded: &CodedTierPairs,
    options: &AgreeOptions,
) -> Vec<(&'static str, MeasureFigure)> {
    let mut figures: Vec<(&'static str, MeasureFigure)> = Vec::new();
    let mut add = |name: &'static str, measure: AgreementMeasure| {
        if options.wants_measure(name) {
            figures.push((name, measure.into()));
        }
    };
    let table = HolleReinTable::from_matching_rows(
        all.iter().flat_map(|matched| matched.rows.iter().copied()),
        coded.values.len(),
    );
    for (name, measure) in of_table(&table, coded.values.len()) {
        add(name, measure);
    }
    let wants = |names: &[&str]| names.iter().any(|name| options.wants_measure(name));
    if coded.are_handshapes && options.wants_measure("label_alpha_features") {
        let items: Vec<AnnotatedItem> = matched_values(all).map(|(a, b)| vec![Some(a), Some(b)]).collect();
        let distances = ValueDistances::distances_of_coded(coded);
        let distance = |a: usize, b: usize| distances.distance_between_values(a, b);
        add(
            "label_alpha_features",
            krippendorff_alpha(&items, AlphaScale::Distance(&distance)),
        );
    }
    let (mut there, mut back, mut units) = (0.0, 0.0, 0.0);
    if wants(&["overlap_a", "overlap_b"]) {
        for (one, pair) in all.iter().zip(pairs) {
            // The mean over all pairs of tiers, weighted by their units.
            let weight = pair.continuum.annotated_unit_count() as f64;
            if let (Ok(ab), Ok(ba)) = (
                overlap_ratio(one.first, one.second),
                overlap_ratio(one.second, one.first),
            ) {
                there += ab * weight;
                back += ba * weight;
                units += weight;
            }
        }
        // Without any unit there is no weight, and no mean.
        let mean = |sum: f64| match units {
            0.0 => Err(UndefinedAgreement::BothEmpty),
            units => Ok(sum / units),
        };
        add("overlap_a", mean(there));
        add("overlap_b", mean(back));
    }
    // Alpha is a ratio of sums over all recordings, and no mean of the ratios of each.
    let one_by_one: Vec<AnnotationContinuum> = pairs.iter().map(|pair| pair.continuum.clone()).collect();
    let joined = AnnotationContinuum::join_continua(&one_by_one);
    if options.wants_measure("alpha_u") {
        add("alpha_u", alpha_u(&joined));
    }
    if wants(&["u_alpha", "u_alpha_spans", "cu_alpha"]) {
        let family = u_alpha(&joined);
        add("u_alpha", family.all);
        add("u_alpha_spans", family.spans);
        add("cu_alpha", family.values);
    }
    if wants(&["frames_raw", "frames_kappa", "frames_alpha"]) {
        // Without units all frames would be one gap, on which both agree wholly.
        let frame_measures = match joined.annotated_unit_count() {
            0 => None,
            _ => Some(measure_frame_agreement(&joined, MEASURE_FRAME_MS)),
        };
        let empty = Err(UndefinedAgreement::BothEmpty);
        add("frames_raw", frame_measures.map_or(empty, |measured| measured.raw));
        add("frames_kappa", frame_measures.map_or(empty, |measured| measured.kappa));
        add("frames_alpha", frame_measures.map_or(empty, |measured| measured.alpha));
    }
    if options.wants_measure("boundaries") {
        add("boundaries", boundary_similarity_measure(all));
    }
    let mut segment_names = MEASURE_NAMES.iter().filter(|name| name.starts_with(SEGMENT_PREFIX));
    if segment_names.any(|name| options.wants_measure(name)) {
        let mut compared = SpanComparison::default();
        for one in all {
            compared.add_span_comparison(&compare_span_lists(&unit_frames(one.first), &unit_frames(one.second)));
        }
        for (name, measure) in segment_measures(&compared) {
            add(name, measure);
        }
    }
    figures
}

/// The beginning of the names of measures of segments.
pub(super) const SEGMENT_PREFIX: &str = "segment_";

/// Returns the measures of segments, in the order of their names.
pub(super) fn segment_measures(compared: &SpanComparison) -> [(&'static str, AgreementMeasure); 8] {
    let for_each = |count: usize| match compared.first_count {
        0 => Err(UndefinedAgreement::Missing),
        units => Ok(count as f64 / units as f64),
    };
    [
        ("segment_mf1s", compared.mean_span_f1()),
        ("segment_mf1b", compared.mean_boundary_f1()),
        ("segment_f1", compared.half_overlap_f1()),
        ("segment_iou", compared.frame_overlap()),
        ("segment_overlap", compared.mean_pair_overlap()),
        ("segment_count", compared.span_count_ratio()),
        ("segment_splits", for_each(compared.splits)),
        ("segment_merges", for_each(compared.merges)),
    ]
}

/// Returns the spans of units in frames of the grid.
pub(super) fn unit_frames(units: &[AnnotatedUnit]) -> Vec<Range<i64>> {
    let frames = units.iter().map(|unit| grid_frames(unit.start * 1000, unit.end * 1000));
    frames.collect()
}

/// Returns the measures that follow from the table of Holle and Rein; with one value chance explains all.
fn of_table(table: &HolleReinTable, values: usize) -> [(&'static str, AgreementMeasure); 10] {
    let inner: &AgreementCounts = table.matched_pair_counts();
    // With one value, whoever finds a unit gives it that value, so chance explains each agreement.
    let kappa_ipf = match values {
        0 => Err(UndefinedAgreement::BothEmpty),
        1 => Err(UndefinedAgreement::OneValue),
        _ => table.kappa_ipf(),
    };
    let matched = match table.annotation_total() {
        0.0 => Err(UndefinedAgreement::BothEmpty),
        // A matched pair holds two annotations, one of each annotator.
        total => Ok(2.0 * inner.total_pair_count() / total),
    };
    [
        ("kappa_ipf", kappa_ipf),
        ("raw", table.raw_agreement_with_unmatched()),
        ("matched", matched),
        ("kappa", table.kappa_with_unmatched()),
        ("kappa_max", table.kappa_max()),
        ("label_raw", inner.counted_raw_agreement()),
        ("label_kappa", inner.cohen_kappa()),
        ("label_pi", inner.scott_pi()),
        ("label_ac1", inner.counted_gwet_ac1()),
        ("label_alpha", inner.counted_nominal_alpha()),
    ]
}

/// Returns the values of matched units.
fn matched_values(all: &[MatchedUnits<'_>]) -> impl Iterator<Item = (usize, usize)> {
    let pairs = |matched: &MatchedUnits<'_>| -> Vec<(usize, usize)> {
        let pairs = matched.pairs.iter();
        pairs
            .map(|(a, b)| (matched.first[*a].value, matched.second[*b].value))
            .collect()
    };
    all.iter().flat_map(pairs)
}

/// Returns the boundary similarity of tiers whose units follow each other.
fn boundary_similarity_measure(all: &[MatchedUnits<'_>]) -> AgreementMeasure {
    let mut sum = SegmentationEdits::default();
    for one in all
        .iter()
        .filter(|matched| !matched.first.is_empty() || !matched.second.is_empty())
    {
        for units in [one.first, one.second] {
            // A gap shorter than a step vanishes on the grid, and is no gap for this measure.
            let apart = |pair: &[AnnotatedUnit]| pair[1].start - pair[0].end >= BOUNDARY_STEP_MS;
            if units.is_empty() || units.windows(2).any(apart) {
                return Err(UndefinedAgreement::Gaps);
            }
        }
        let start = one.first[0].start.min(one.second[0].start);
        let end = one
            .first
            .iter()
            .chain(one.second)
            .map(|unit| unit.end)
            .max()
            .unwrap_or(start);
        // Half a step is added so that times are rounded to the nearest step, not down.
        let frame = |time: i64| ((time - start + BOUNDARY_STEP_MS / 2) / BOUNDARY_STEP_MS) as usize;
        let masses = |units: &[AnnotatedUnit]| -> Vec<usize> {
            let mut places: Vec<usize> = units.iter().map(|unit| frame(unit.start)).collect();
            // Both segmentations must cover the same extent, so that the later of two first starts is moved
            // to it.
            places[0] = 0;
            places.push(frame(end));
            places.windows(2).map(|pair| pair[1].saturating_sub(pair[0])).collect()
        };
        sum.add_segmentation_edits(&count_segmentation_edits(
            &masses(one.first),
            &masses(one.second),
            NEAR_BOUNDARY_STEPS,
        ));
    }
    sum.boundary_similarity(NEAR_BOUNDARY_STEPS)
}

/// Adds the percentile intervals of the measures of the table: units are drawn again, or recordings if there are many,
/// which gives alpha_U an interval, too.
fn add_intervals(
    figures: &mut [(&'static str, MeasureFigure)],
    all: &[MatchedUnits<'_>],
    coded: &CodedTierPairs,
    options: &AgreeOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let filled: Vec<&MatchedUnits<'_>> = all.iter().filter(|matched| !matched.rows.is_empty()).collect();
    // Units of a recording depend on each other; with few recordings, drawing those says too little.
    let by_recording = filled.len() >= MIN_DRAWN_RECORDINGS;
    let every: Vec<HolleReinRow> = filled.iter().flat_map(|matched| matched.rows.iter().copied()).collect();
    let count = if by_recording { filled.len() } else { every.len() };
    // A single unit or recording gives the same draw each time.
    if count < 2 || options.draws == 0 {
        return Ok(());
    }
    let values = coded.values.len();
    let pairs = coded
        .pairs
        .iter()
        .filter(|pair| pair.continuum.annotated_unit_count() > 0);
    let continua: Vec<&AnnotationContinuum> = pairs.map(|pair| &pair.continuum).collect();
    // Alpha needs the gaps between units, and units that are drawn one by one have no place in time.
    let over_time = by_recording && options.wants_measure("alpha_u");
    let mut drawn: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    let (mut done, mut stopped) = (0_u64, Ok(()));
    draw_bootstrap_samples(count, options.draws, options.seed, |places| {
        if stopped.is_err() {
            return;
        }
        done += 1;
        // A report for each draw would take longer than the draw.
        if done % 64 == 0 {
            stopped = report_agreement_step(progress, "intervals", done, options.draws);
        }
        let table = match by_recording {
            true => {
                let rows = places.iter().flat_map(|at| filled[*at].rows.iter().copied());
                HolleReinTable::from_matching_rows(rows, values)
            }
            false => HolleReinTable::from_matching_rows(places.iter().map(|at| every[*at]), values),
        };
        let alpha = over_time.then(|| {
            let drawn_continua: Vec<AnnotationContinuum> = places.iter().map(|at| continua[*at].clone()).collect();
            ("alpha_u", alpha_u(&AnnotationContinuum::join_continua(&drawn_continua)))
        });
        for (name, measure) in of_table(&table, values).into_iter().chain(alpha) {
            // Draws of a maximum over margins lie below it, so that their percentiles can miss it.
            if let (true, Ok(value)) = (name != "kappa_max", measure) {
                drawn.entry(name).or_default().push(value);
            }
        }
    });
    stopped?;
    for (name, figure) in figures.iter_mut().filter(|(_, it)| it.value.is_some()) {
        let interval = drawn.remove(name).and_then(BootstrapInterval::from_bootstrap_draws);
        let of = if by_recording { "recordings" } else { "units" };
        figure.interval = interval.map(|ends| interval_of(ends, of));
    }
    Ok(())
}

fn interval_of(it: BootstrapInterval, of: &'static str) -> FigureInterval {
    FigureInterval {
        low: it.low,
        high: it.high,
        draws: it.draws,
        of,
    }
}

fn report_agreement_step(progress: &mut ProgressReceiver<'_>, task: &str, done: u64, total: usize) -> CorpusResult<()> {
    progress.report_step(ProgressStep {
        task,
        done,
        total: Some(total as u64),
        unit: Amount::Items,
    })
}

/// The end of the search for gamma: it is undefined, or the user stopped it.
enum GammaHalt {
    Undefined(UndefinedAgreement),
    Failed(CorpusError),
}

impl From<UndefinedAgreement> for GammaHalt {
    fn from(reason: UndefinedAgreement) -> Self {
        Self::Undefined(reason)
    }
}

/// Adds gamma and gamma_cat, if they are asked for.
fn add_gamma(
    figures: &mut Vec<(&'static str, MeasureFigure)>,
    coded: &CodedTierPairs,
    options: &AgreeOptions,
    progress: &mut ProgressReceiver<'_>,
) -> CorpusResult<()> {
    let wanted = ["gamma", "gamma_cat"].map(|name| options.wants_measure(name));
    // Gamma's chance comes from random continua; with none of them there is no gamma.
    if options.samples == 0 || wanted == [false, false] {
        return Ok(());
    }
    let continua: Vec<AnnotationContinuum> = coded.pairs.iter().map(|pair| pair.continuum.clone()).collect();
    let sampling = GammaSampling {
        samples: options.samples,
        precision: None,
        seed: options.seed,
    };
    let hear = |done: usize| {
        report_agreement_step(progress, "random continua", done as u64, options.samples).map_err(GammaHalt::Failed)
    };
    let (measure, categorical, interval) =
        match measure_gamma_agreement(&continua, &AlignmentCosts::default(), &sampling, hear) {
            Ok(GammaAgreement {
                gamma,
                categorical,
                interval,
                ..
            }) => (gamma, categorical, interval),
            Err(GammaHalt::Undefined(reason)) => (Err(reason), Err(reason), None),
            Err(GammaHalt::Failed(error)) => return Err(error),
        };
    let mut gamma_figures = [
        ("gamma", MeasureFigure::from(measure)),
        ("gamma_cat", categorical.into()),
    ];
    // The interval is that of gamma's chance; gamma_cat has none.
    gamma_figures[0].1.interval = interval.map(|ends| interval_of(ends, "samples"));
    let marked_figures = gamma_figures.into_iter().zip(wanted);
    figures.extend(marked_figures.filter(|(_, wanted)| *wanted).map(|(figure, _)| figure));
    Ok(())
}

/// Returns the agreement on each value.
fn by_value(coded: &CodedTierPairs, all: &[MatchedUnits<'_>]) -> Vec<ValueAgreement> {
    if coded.spans_only {
        return Vec::new();
    }
    let table = HolleReinTable::from_matching_rows(
        all.iter().flat_map(|matched| matched.rows.iter().copied()),
        coded.values.len(),
    );
    // The annotators' units of all recordings follow each other on one line, so that alpha has one chance.
    let continua: Vec<AnnotationContinuum> = coded.pairs.iter().map(|pair| pair.continuum.clone()).collect();
    let over_time = unitizing_disagreements(&AnnotationContinuum::join_continua(&continua));
    let mut counts = vec![[0_u64; 5]; coded.values.len()];
    for row in all.iter().flat_map(|matched| &matched.rows) {
        let [a, b, both, other, alone] = [0, 1, 2, 3, 4];
        for (value, side) in [(row.0, a), (row.1, b)] {
            if let Some(value) = value {
                counts[value][side] += 1;
            }
        }
        match *row {
            (Some(one), Some(two)) if one == two => counts[one][both] += 1,
            (Some(one), Some(two)) => {
                counts[one][other] += 1;
                counts[two][other] += 1;
            }
            (Some(only), None) | (None, Some(only)) => counts[only][alone] += 1,
            (None, None) => {}
        }
    }
    let value = |(number, name): (usize, &String)| {
        let [a, b, both, other, alone] = counts[number];
        let value_agreement = table.value_two_by_two(number);
        let alpha_u = over_time
            .get(&number)
            .map_or(Err(UndefinedAgreement::BothEmpty), |disagreement| {
                disagreement.unitizing_alpha()
            });
        ValueAgreement {
            value: name.clone(),
            a,
            b,
            both,
            other,
            alone,
            raw: value_agreement.two_by_two_agreement().into(),
            kappa: value_agreement.two_by_two_kappa().into(),
            alpha_u: alpha_u.into(),
        }
    };
    let mut rows: Vec<ValueAgreement> = coded.values.iter().enumerate().map(value).collect();
    // The most frequent value is first, and names settle ties so that the order never varies.
    rows.sort_by(|x, y| (y.a + y.b).cmp(&(x.a + x.b)).then(x.value.cmp(&y.value)));
    rows
}

/// Returns the pairs of different values of matched units.
fn value_confusions(coded: &CodedTierPairs, all: &[MatchedUnits<'_>]) -> Vec<ValueConfusion> {
    let mut counts: BTreeMap<(usize, usize), u64> = BTreeMap::new();
    for pair in matched_values(all).filter(|(a, b)| a != b) {
        *counts.entry(pair).or_default() += 1;
    }
    let row = |((a, b), count): ((usize, usize), u64)| {
        let less = |own: usize, other: usize| -> Vec<String> {
            let (own, other): (&BTreeSet<String>, _) = (&coded.features[own], &coded.features[other]);
            own.difference(other).cloned().collect()
        };
        ValueConfusion {
            a: coded.values[a].clone(),
            b: coded.values[b].clone(),
            count,
            only_a: less(a, b),
            only_b: less(b, a),
        }
    };
    let mut rows: Vec<ValueConfusion> = counts.into_iter().map(row).collect();
    rows.sort_by(|x, y| y.count.cmp(&x.count).then((&x.a, &x.b).cmp(&(&y.a, &y.b))));
    rows
}
