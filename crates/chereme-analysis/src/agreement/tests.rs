//! Agreement against closed forms, laws, and vectors that other programs computed.

use proptest::prelude::*;

use super::gamma::{AlignmentCosts, GammaSampling, align_continuum, measure_gamma_agreement};
use super::items::{self, AgreementCounts, AlphaScale, AnnotatedItem};
use super::matching::{self, HolleReinTable};
use super::{AgreementMeasure, AnnotatedUnit, AnnotationContinuum, UndefinedAgreement, segments, unitizing};

#[path = "tests/vectors.rs"]
mod vectors;

fn near(found: AgreementMeasure, wanted: f64) {
    let found = found.expect("defined");
    assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
}

fn items(first: &[usize], second: &[usize]) -> Vec<AnnotatedItem> {
    let both = first.iter().zip(second);
    both.map(|(a, b)| vec![Some(*a), Some(*b)]).collect()
}

/// Returns the pairs of two annotators who both gave a value.
fn value_pairs(items: &[AnnotatedItem]) -> Vec<(usize, usize)> {
    let pair = |item: &AnnotatedItem| item[0].zip(item[1]);
    items.iter().filter_map(pair).collect()
}

#[test]
fn kappa_and_alpha_of_a_table_by_hand() {
    // 20 yes-yes, 5 yes-no, 10 no-yes, 15 no-no: raw 0.7; chance 0.5 * 0.6 + 0.5 * 0.4.
    let cells = [(0, 0, 20), (0, 1, 5), (1, 0, 10), (1, 1, 15)];
    let all = cells.iter().flat_map(|(a, b, n)| vec![(*a, *b); *n]);
    let pairs: Vec<(usize, usize)> = all.collect();
    let counts = AgreementCounts::from_value_pairs(&pairs);
    near(counts.counted_raw_agreement(), 0.7);
    near(counts.cohen_kappa(), 0.4);
    // 55 of 100 values are yes.
    let chance = 0.55 * 0.55 + 0.45 * 0.45;
    near(counts.scott_pi(), (0.7 - chance) / (1.0 - chance));
    let chance = 2.0 * 0.55 * 0.45;
    near(counts.counted_gwet_ac1(), (0.7 - chance) / (1.0 - chance));
    let expected = 2.0 * 55.0 * 45.0 / (100.0 * 99.0);
    near(counts.counted_nominal_alpha(), 1.0 - 0.3 / expected);
    let both: Vec<AnnotatedItem> = pairs.iter().map(|(a, b)| vec![Some(*a), Some(*b)]).collect();
    near(
        items::krippendorff_alpha(&both, AlphaScale::Nominal),
        1.0 - 0.3 / expected,
    );
}

#[test]
fn undefined_figures_have_a_reason() {
    let same = items(&[3, 3, 3], &[3, 3, 3]);
    let counts = AgreementCounts::from_value_pairs(&value_pairs(&same));
    near(counts.counted_raw_agreement(), 1.0);
    for undefined in [
        counts.cohen_kappa(),
        counts.scott_pi(),
        counts.counted_gwet_ac1(),
        counts.counted_nominal_alpha(),
        items::krippendorff_alpha(&same, AlphaScale::Interval),
    ] {
        assert_eq!(undefined, Err(UndefinedAgreement::OneValue));
    }
    let apart: Vec<AnnotatedItem> = vec![vec![Some(0), None], vec![None, Some(1)]];
    assert_eq!(
        items::krippendorff_alpha(&apart, AlphaScale::Nominal),
        Err(UndefinedAgreement::NoPair)
    );
    let nothing = AnnotationContinuum::new(0..4000, vec![vec![], vec![]]);
    assert_eq!(unitizing::alpha_u(&nothing), Err(UndefinedAgreement::BothEmpty));
    assert_eq!(unitizing::u_alpha(&nothing).all, Err(UndefinedAgreement::BothEmpty));
    assert_eq!(
        align_continuum(&nothing, &AlignmentCosts::default()),
        Err(UndefinedAgreement::BothEmpty)
    );
    assert_eq!(matching::overlap_ratio(&[], &[]), Err(UndefinedAgreement::BothEmpty));
    assert_eq!(
        HolleReinTable::from_matching_rows([], 0).kappa_ipf(),
        Err(UndefinedAgreement::BothEmpty)
    );
    let none = segments::boundary_similarity(&[15], &[15], 3);
    assert_eq!(none, Err(UndefinedAgreement::NoBoundary));
    assert_eq!(
        UndefinedAgreement::NoPair.to_string(),
        "no item has two values",
        "the reason is a contract"
    );
}

/// Returns units that follow each other, from gaps, lengths and values.
fn tier(parts: &[(i64, i64, usize)]) -> Vec<AnnotatedUnit> {
    let mut end = 0;
    let unit = |(gap, length, value): &(i64, i64, usize)| {
        let start = end + gap;
        end = start + length;
        AnnotatedUnit::new(start, end, *value)
    };
    parts.iter().map(unit).collect()
}

fn tiers(most: usize) -> impl Strategy<Value = Vec<AnnotatedUnit>> {
    proptest::collection::vec((0_i64..300, 40_i64..600, 0_usize..3), 0..most).prop_map(|it| tier(&it))
}

/// Returns every figure of two tiers but ELAN's ratio and gamma.
fn figures(first: &[AnnotatedUnit], second: &[AnnotatedUnit]) -> Vec<AgreementMeasure> {
    let continuum = AnnotationContinuum::new(0..8000, vec![first.to_vec(), second.to_vec()]);
    let pairs = matching::match_overlapping_units(first, second, 0.6);
    let table = HolleReinTable::from_matching_rows(matching::build_matching_rows(first, second, &pairs), 3);
    let frames = unitizing::measure_frame_agreement(&continuum, 10);
    let u = unitizing::u_alpha(&continuum);
    let inner = table.matched_pair_counts();
    vec![
        table.raw_agreement_with_unmatched(),
        table.kappa_with_unmatched(),
        table.kappa_max(),
        inner.cohen_kappa(),
        inner.counted_nominal_alpha(),
        inner.counted_gwet_ac1(),
        frames.raw,
        frames.kappa,
        frames.alpha,
        u.all,
        u.spans,
        u.values,
        unitizing::alpha_u(&continuum),
        align_continuum(&continuum, &AlignmentCosts::default()).map(|it| it.alignment_disorder()),
        table.kappa_ipf(),
    ]
}

fn alike(a: &[AgreementMeasure], b: &[AgreementMeasure]) {
    for (nth, (a, b)) in a.iter().zip(b).enumerate() {
        match (a, b) {
            (Ok(a), Ok(b)) => assert!((a - b).abs() < 1e-9, "{nth}: {a} {b}"),
            _ => assert_eq!(a, b, "{nth}"),
        }
    }
}

/// Returns the least cost over all alignments of two tiers, by trying every one.
fn least(first: &[AnnotatedUnit], second: &[AnnotatedUnit], used: u32, costs: &AlignmentCosts<'_>) -> f64 {
    let Some((unit, rest)) = first.split_first() else {
        return costs.alone * f64::from(second.len() as u32 - used.count_ones());
    };
    let mut best = costs.alone + least(rest, second, used, costs);
    for (at, other) in second.iter().enumerate().filter(|(at, _)| used & (1 << at) == 0) {
        let cost = costs.unit_pair_cost(unit, other) + least(rest, second, used | (1 << at), costs);
        best = best.min(cost);
    }
    best
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn swapping_the_annotators_changes_nothing(a in tiers(9), b in tiers(9)) {
        let (there, mut back) = (figures(&a, &b), figures(&b, &a));
        // Fitting rows before columns leaves the modified kappa a little different after 20 rounds.
        if let (Some(Ok(one)), Some(Ok(other))) = (there.last(), back.last()) {
            prop_assert!((one - other).abs() < 1e-3);
        }
        back.pop();
        alike(&there[..back.len()], &back);
    }

    #[test]
    fn renaming_the_values_changes_nothing(a in tiers(9), b in tiers(9)) {
        let renamed = |units: &[AnnotatedUnit]| -> Vec<AnnotatedUnit> {
            units.iter().map(|it| AnnotatedUnit { value: [2, 0, 1][it.value], ..*it }).collect()
        };
        alike(&figures(&a, &b), &figures(&renamed(&a), &renamed(&b)));
    }

    #[test]
    fn a_copy_agrees_wholly(a in tiers(9)) {
        let all = figures(&a, &a);
        for (nth, found) in all.iter().enumerate().filter(|(nth, _)| *nth != 13) {
            if let Ok(found) = found {
                prop_assert!((found - 1.0).abs() < 1e-9, "{nth}: {found}");
            }
        }
        if let Ok(disorder) = all[13] {
            prop_assert_eq!(disorder, 0.0);
        }
    }

    #[test]
    fn the_assignment_is_the_least_of_all(a in tiers(6), b in tiers(6)) {
        let continuum = AnnotationContinuum::new(0..1, vec![a.clone(), b.clone()]);
        let costs = AlignmentCosts::default();
        if let Ok(found) = align_continuum(&continuum, &costs) {
            let wanted = least(&a, &b, 0, &costs);
            prop_assert!((found.cost - wanted).abs() < 1e-9, "{} {wanted}", found.cost);
            let units: usize = found.groups.iter().flatten().flatten().count();
            prop_assert_eq!(units, a.len() + b.len());
        }
    }

    #[test]
    fn a_silent_third_annotator_adds_the_same_to_every_group(a in tiers(5), b in tiers(5)) {
        let two = AnnotationContinuum::new(0..1, vec![a.clone(), b.clone()]);
        let three = AnnotationContinuum::new(0..1, vec![a, vec![], b]);
        let costs = AlignmentCosts::default();
        if let (Ok(two), Ok(three)) = (align_continuum(&two, &costs), align_continuum(&three, &costs)) {
            // Two of the three pairs of a group have a silent side.
            let least = (two.cost + 2.0 * two.groups.len() as f64) / 3.0;
            prop_assert!(three.cost <= least + 1e-9, "{} {least}", three.cost);
        }
    }

    #[test]
    fn hostile_units_give_numbers_or_reasons(
        a in proptest::collection::vec((any::<i64>(), any::<i64>(), 0_usize..3), 0..6),
        b in proptest::collection::vec((any::<i64>(), any::<i64>(), 0_usize..3), 0..6),
    ) {
        let units = |all: &[(i64, i64, usize)]| all.iter().map(|it| AnnotatedUnit::new(it.0, it.1, it.2)).collect();
        let continuum = AnnotationContinuum::new(i64::MIN..i64::MAX, vec![units(&a), units(&b)]);
        let [first, second] = continuum.annotator_tiers() else { unreachable!() };
        for found in figures(first, second).into_iter().flatten() {
            prop_assert!(found.is_finite(), "{found}");
        }
    }
}

#[test]
fn gamma_is_one_less_the_share_of_chance_and_repeats_by_seed() {
    let parts: Vec<(i64, i64, usize)> = (0..12).map(|it| (80, 300 + 40 * (it % 5), it as usize % 4)).collect();
    let first = tier(&parts);
    let mut second = first.clone();
    second[3].value = 3;
    second[7].start += 90;
    let continuum = [AnnotationContinuum::new(0..6000, vec![first, second])];
    let (costs, sampling) = (AlignmentCosts::default(), GammaSampling::default());
    let run = |sampling: &GammaSampling| {
        measure_gamma_agreement::<UndefinedAgreement>(&continuum, &costs, sampling, |_| Ok(())).expect("gamma")
    };
    let found = run(&sampling);
    near(found.gamma, 1.0 - found.observed / found.expected);
    let aligned = align_continuum(&continuum[0], &costs).expect("aligned");
    assert!((found.observed - aligned.alignment_disorder()).abs() < 1e-12);
    assert_eq!(found, run(&sampling));
    assert_eq!(found.samples, 30);
    let exact = run(&GammaSampling {
        precision: Some(0.02),
        ..sampling
    });
    assert!(exact.samples >= 30);
    let interval = found.interval.expect("an interval");
    let value = found.gamma.expect("gamma");
    assert!(interval.low < value && value < interval.high);
    let turned: Vec<Vec<AnnotatedUnit>> = continuum[0].annotator_tiers().iter().rev().cloned().collect();
    let turned = [AnnotationContinuum::new(0..6000, turned)];
    let other = measure_gamma_agreement::<UndefinedAgreement>(&turned, &costs, &sampling, |_| Ok(())).expect("gamma");
    near(other.gamma, value);
    let stopped = measure_gamma_agreement(&continuum, &costs, &sampling, |_| Err(UndefinedAgreement::TooMany));
    assert_eq!(stopped, Err(UndefinedAgreement::TooMany));
}

#[test]
fn recordings_one_after_another_are_one_continuum() {
    let one = AnnotationContinuum::new(
        1000..3000,
        vec![
            vec![AnnotatedUnit::new(1000, 2000, 0)],
            vec![AnnotatedUnit::new(1100, 2000, 1)],
        ],
    );
    let joined = AnnotationContinuum::join_continua(&[one.clone(), one]);
    assert_eq!((joined.continuum_start(), joined.continuum_end()), (0, 4000));
    assert_eq!(
        joined.annotator_tiers()[1],
        [AnnotatedUnit::new(100, 1000, 1), AnnotatedUnit::new(2100, 3000, 1)]
    );
}

#[test]
fn very_many_overlapping_units_are_refused_and_as_many_in_a_row_are_aligned() {
    let tier = |step: i64| -> Vec<AnnotatedUnit> {
        let unit = |at: i64| AnnotatedUnit::new(at * step, at * step + 10_000, at as usize % 7);
        (0..2100).map(unit).collect()
    };
    let align = |step: i64| {
        let continuum = AnnotationContinuum::new(0..0, vec![tier(step), tier(step)]);
        align_continuum(&continuum, &AlignmentCosts::default()).map(|it| it.groups.len())
    };
    assert_eq!(align(1), Err(UndefinedAgreement::TooMany));
    assert_eq!(align(10_000), Ok(2100));
}

#[test]
fn offsets_splits_and_merges_of_spans_have_signs_and_are_pooled() {
    use crate::agreement::span_measures::{compare_span_lists, divide_evenly, grid_frames};

    let mut all = compare_span_lists(&[0..10, 20..40], &[2..9, 20..29, 31..40]);
    assert_eq!((all.splits, all.merges), (1, 0));
    assert_eq!(
        (all.begin_offsets.clone(), all.end_offsets.clone()),
        (vec![2, 0], vec![-1, -11])
    );
    all.add_span_comparison(&compare_span_lists(&[0..10, 12..20], std::slice::from_ref(&(0..20))));
    assert_eq!(
        (all.splits, all.merges, all.first_count, all.second_count),
        (1, 1, 4, 4)
    );
    assert_eq!(all.span_count_ratio(), Ok(1.0));
    assert_eq!(divide_evenly(0..10, 3), [0..3, 3..6, 6..10]);
    assert_eq!(divide_evenly(0..10, 0), []);
    assert_eq!(grid_frames(19_999, 60_000), 0..2);
    assert_eq!(grid_frames(0, 1), 0..1, "a span has a frame at least");
    let touching = compare_span_lists(&[0..5, 5..9], &[0..5, 6..9]);
    assert_eq!(
        touching.boundaries[0].hits, 3,
        "frames next to each other are one boundary"
    );
}
