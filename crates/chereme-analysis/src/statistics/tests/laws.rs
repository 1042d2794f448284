//! Laws of the statistics, and cases that can be counted by hand.

use proptest::prelude::*;

use crate::statistics::*;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

fn answers() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec((1_i32..=5).prop_map(f64::from), 1..14)
}

fn rows() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let row = prop::collection::vec((1_i32..=5).prop_map(f64::from), 3);
    prop::collection::vec(row, 2..12)
}

/// Changes values and keeps their order.
fn stretched(values: &[f64]) -> Vec<f64> {
    values.iter().map(|x| x.powi(3) + 2.0 * x - 40.0).collect()
}

/// Returns the exact two-sided p by counting every assignment of the values to two groups.
fn counted_p(first: &[f64], second: &[f64]) -> f64 {
    let all = [first, second].concat();
    let u = |members: u32| {
        let inside = |at: &usize| members >> at & 1 == 1;
        let (own, other): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(inside);
        let pairs = own.iter().flat_map(|i| other.iter().map(|j| (all[*i], all[*j])));
        let wins = pairs.map(|(x, y)| if x > y { 2 } else { usize::from(x == y) });
        wins.sum::<usize>()
    };
    let mean = first.len() * second.len();
    let observed = u((1 << first.len()) - 1).abs_diff(mean);
    let of_size = (0..1_u32 << all.len()).filter(|it| it.count_ones() as usize == first.len());
    let (extreme, count) = of_size.fold((0, 0), |(extreme, count), members| {
        (extreme + usize::from(u(members).abs_diff(mean) >= observed), count + 1)
    });
    extreme as f64 / count as f64
}

proptest! {
    #[test]
    fn swapped_groups_mirror_each_other(x in answers(), y in answers()) {
        let (there, back) = (GroupEffect::measure_group_effect(&x, &y).unwrap(), GroupEffect::measure_group_effect(&y, &x).unwrap());
        prop_assert!(near(there.delta, -back.delta));
        prop_assert_eq!(there.shift.map(|it| -it), back.shift);
        for method in [PValueMethod::Exact, PValueMethod::Continuity] {
            let p = |a: &[f64], b: &[f64], side| mann_whitney(a, b, side, Some(method)).unwrap().p;
            prop_assert!(near(p(&x, &y, TestAlternative::TwoSided), p(&y, &x, TestAlternative::TwoSided)));
            prop_assert!(near(p(&x, &y, TestAlternative::Less), p(&y, &x, TestAlternative::Greater)));
        }
    }

    #[test]
    fn only_the_order_of_values_counts(x in answers(), y in answers()) {
        let test = |a: &[f64], b: &[f64]| mann_whitney(a, b, TestAlternative::TwoSided, None).unwrap();
        prop_assert_eq!(test(&x, &y), test(&stretched(&x), &stretched(&y)));
        let groups = |a: &[f64], b: &[f64]| kruskal_wallis(&[a, b]);
        prop_assert_eq!(groups(&x, &y), groups(&stretched(&x), &stretched(&y)));
        let n = x.len().min(y.len());
        let correlations = |a: &[f64], b: &[f64]| [spearman_correlation(a, b), kendall_tau(a, b)];
        prop_assert_eq!(
            correlations(&x[..n], &y[..n]),
            correlations(&stretched(&x[..n]), &stretched(&y[..n]))
        );
    }

    #[test]
    fn the_order_of_people_does_not_count(rows in rows(), turn in 0_usize..12) {
        let mut turned = rows.clone();
        let length = turned.len();
        turned.rotate_left(turn % length);
        match (friedman_test(&rows), friedman_test(&turned)) {
            (Ok(a), Ok(b)) => prop_assert!(near(a.chi_squared, b.chi_squared) && near(a.p, b.p)),
            (a, b) => prop_assert_eq!(a, b),
        }
        let column = |rows: &[Vec<f64>], n: usize| -> Vec<f64> { rows.iter().map(|row| row[n]).collect() };
        let pairs = |rows: &[Vec<f64>], zeros| {
            wilcoxon_test(&column(rows, 0), &column(rows, 1), zeros, TestAlternative::TwoSided, None)
        };
        for zeros in [ZeroTreatment::Wilcox, ZeroTreatment::Pratt] {
            match (pairs(&rows, zeros), pairs(&turned, zeros)) {
                (Ok(a), Ok(b)) => prop_assert!(near(a.p, b.p) && near(a.plus, b.plus)),
                (a, b) => prop_assert_eq!(a, b),
            }
        }
    }

    #[test]
    fn an_exact_p_counts_every_assignment(
        x in prop::collection::vec((1_i32..=4).prop_map(f64::from), 1..6),
        y in prop::collection::vec((1_i32..=4).prop_map(f64::from), 1..6),
    ) {
        let own = mann_whitney(&x, &y, TestAlternative::TwoSided, Some(PValueMethod::Exact)).unwrap();
        prop_assert!(near(own.p, counted_p(&x, &y)), "{} {}", own.p, counted_p(&x, &y));
    }

    #[test]
    fn the_delta_counts_pairs(x in answers(), y in answers()) {
        let pairs = x.iter().flat_map(|a| y.iter().map(move |b| (a - b).signum() * f64::from(u8::from(a != b))));
        let mean = pairs.sum::<f64>() / (x.len() * y.len()) as f64;
        prop_assert!(near(GroupEffect::measure_group_effect(&x, &y).unwrap().delta, mean));
    }

    #[test]
    fn corrected_p_are_at_least_the_p_and_keep_their_order(p in prop::collection::vec(0.0_f64..=1.0, 0..9)) {
        let corrected = holm_p_values(&p);
        for (i, own) in corrected.iter().enumerate() {
            prop_assert!(*own >= p[i] && *own <= 1.0);
            prop_assert!(p.iter().zip(&corrected).all(|(x, it)| *x > p[i] || it <= own));
        }
    }

    #[test]
    fn a_share_lies_in_its_interval(hits in 0_u64..40, misses in 0_u64..40) {
        prop_assume!(hits + misses > 0);
        let [low, high] = wilson_interval(hits, hits + misses, 0.95).unwrap();
        let share = hits as f64 / (hits + misses) as f64;
        prop_assert!(0.0 <= low && low <= share && share <= high && high <= 1.0);
        let mirrored = wilson_interval(misses, hits + misses, 0.95).unwrap();
        prop_assert!(near(low, 1.0 - mirrored[1]) && near(high, 1.0 - mirrored[0]));
    }

    #[test]
    fn no_values_at_all_and_odd_ones_are_refused(at in 0_usize..3) {
        let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][at];
        prop_assert_eq!(mid_ranks(&[1.0, odd]), Err(UndefinedStatistic::NotANumber));
        prop_assert_eq!(GroupDescription::describe_values(&[]), Err(UndefinedStatistic::Empty));
        prop_assert_eq!(spearman_correlation(&[1.0, 2.0], &[odd, 1.0]), Err(UndefinedStatistic::NotANumber));
        prop_assert_eq!(ordinal::fit_ordinal_model(&[1, 2], &[vec![odd], vec![0.0]]), Err(UndefinedStatistic::NotANumber));
    }
}

#[test]
fn small_tests_are_counted_by_hand() {
    let p = |x: &[f64], y: &[f64], side| mann_whitney(x, y, side, None).unwrap().p;
    assert!(near(
        p(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0], TestAlternative::Less),
        1.0 / 20.0
    ));
    assert!(near(
        p(&[1.0, 2.0, 3.0], &[4.0, 5.0, 6.0], TestAlternative::TwoSided),
        2.0 / 20.0
    ));
    let five = wilcoxon_test(
        &[2.0; 5],
        &[1.0; 5],
        ZeroTreatment::Wilcox,
        TestAlternative::Greater,
        None,
    );
    assert!(
        near(five.unwrap().p, 1.0 / 32.0),
        "every one of five differs, all in one direction"
    );
    assert!(near(
        kendall_tau(&[1.0, 2.0, 3.0], &[1.0, 2.0, 3.0]).unwrap().p.unwrap(),
        2.0 / 6.0
    ));
    assert!(near(fisher_exact_test([[2, 0], [0, 2]]).unwrap().p, 2.0 / 6.0));
    assert!(near(mcnemar_exact_test(0, 4).unwrap(), 2.0 / 16.0));
}

#[test]
fn a_model_of_two_groups_and_two_answers_is_the_odds_ratio() {
    let (mut answers, mut rows) = (Vec::new(), Vec::new());
    for (answer, group, count) in [(1, 0.0, 30), (2, 0.0, 10), (1, 1.0, 15), (2, 1.0, 25)] {
        answers.extend(vec![answer; count]);
        rows.extend(vec![vec![group]; count]);
    }
    let model = ordinal::fit_ordinal_model(&answers, &rows).unwrap();
    let [slope] = model.coefficients[..] else {
        panic!("one column")
    };
    assert!(near(slope.estimate, (25.0_f64 * 30.0 / (15.0 * 10.0)).ln()));
    let variance = 1.0 / 30.0 + 1.0 / 10.0 + 1.0 / 15.0 + 1.0 / 25.0;
    assert!(near(slope.se, f64::sqrt(variance)), "Woolf's standard error");
    assert!(near(model.thresholds[0], 3.0_f64.ln()));
}

#[test]
fn models_without_one_answer_are_refused() {
    let constant = ordinal::fit_ordinal_model(&[1, 2, 3, 1], &vec![vec![1.0]; 4]);
    assert_eq!(constant, Err(UndefinedStatistic::Dependent));
    let twice: Vec<Vec<f64>> = [0.0, 1.0, 0.0, 1.0, 1.0].map(|x| vec![x, 2.0 * x]).to_vec();
    assert_eq!(
        ordinal::fit_ordinal_model(&[1, 2, 2, 1, 3], &twice),
        Err(UndefinedStatistic::Dependent)
    );
    assert_eq!(
        ordinal::fit_ordinal_model(&[2, 2], &[vec![0.0], vec![1.0]]),
        Err(UndefinedStatistic::NoSpread)
    );
    // Items 0 and 1 belong to one condition, items 2 to 4 to the other: their columns add up to the condition's.
    let nested: Vec<Vec<f64>> = (0..200)
        .map(|n| {
            let item = n % 5;
            let column = |own: usize| f64::from(u8::from(own == item));
            let condition = f64::from(u8::from(item > 1));
            vec![condition, column(1), column(2), column(3), column(4)]
        })
        .collect();
    let answers: Vec<i64> = (0..200).map(|n| 1 + (n * n + 3 * n / 7) % 5).collect();
    assert_eq!(
        ordinal::fit_ordinal_model(&answers, &nested),
        Err(UndefinedStatistic::Dependent)
    );
    let apart: Vec<Vec<f64>> = (0..40).map(|n| vec![f64::from(n / 20)]).collect();
    let answers: Vec<i64> = (0..40).map(|n| 1 + n % 2 + 2 * (n / 20)).collect();
    assert_eq!(
        ordinal::fit_ordinal_model(&answers, &apart),
        Err(UndefinedStatistic::Separated)
    );
}

#[test]
fn the_same_seed_gives_the_same_resamples() {
    let values = [1.0, 2.0, 2.0, 3.0, 5.0, 5.0, 4.0];
    let mean = |drawn: &[usize]| -> Result<f64, UndefinedStatistic> {
        Ok(drawn.iter().map(|at| values[*at]).sum::<f64>() / drawn.len() as f64)
    };
    let draw = |seed| ParticipantResamples::draw_participants(values.len(), 2_000, seed, mean).unwrap();
    assert_eq!(draw(7), draw(7));
    assert_ne!(draw(7).values, draw(8).values);
    let own = draw(7);
    // The spread of resampled means is the deviation over n, divided by the root of n.
    let sd = GroupDescription::describe_values(&own.values).unwrap().sd.unwrap();
    let squares: f64 = values.iter().map(|x| (x - own.estimate).powi(2)).sum();
    assert!((sd / (squares / 49.0).sqrt() - 1.0).abs() < 0.05, "{sd}");
    for kind in [
        ResampleIntervalRule::Percentile,
        ResampleIntervalRule::Basic,
        ResampleIntervalRule::Bca,
    ] {
        let [low, high] = own.resample_interval(kind, 0.95).unwrap();
        assert!(low < own.estimate && own.estimate < high);
        let [narrow, less] = own.resample_interval(kind, 0.8).unwrap();
        assert!(low <= narrow && less <= high, "a lower level has a narrower interval");
    }
}

#[test]
fn resamples_without_a_value_are_counted_and_many_of_them_refused() {
    let rare = |drawn: &[usize]| {
        let found = drawn.contains(&0);
        found.then_some(1.0).ok_or(UndefinedStatistic::Empty)
    };
    let own = ParticipantResamples::draw_participants(3, 1_000, 1, rare).unwrap();
    assert!(own.undefined > 200, "{}", own.undefined);
    assert_eq!(
        own.resample_interval(ResampleIntervalRule::Percentile, 0.9),
        Err(UndefinedStatistic::TooFew)
    );
    assert_eq!(
        ParticipantResamples::draw_participants(1, 10, 1, rare),
        Err(UndefinedStatistic::TooFew)
    );
    let same = ParticipantResamples::draw_participants(5, 100, 1, |_| Ok(0.5)).unwrap();
    assert_eq!(
        same.resample_interval(ResampleIntervalRule::Bca, 0.9),
        Err(UndefinedStatistic::NoSpread)
    );
    assert_eq!(
        same.resample_interval(ResampleIntervalRule::Percentile, 0.9),
        Ok([0.5, 0.5])
    );
}

#[test]
fn sameness_needs_a_narrow_interval() {
    assert_eq!(
        conclude_equivalence([-0.1, 0.12], 0.147),
        Ok(EquivalenceConclusion::Equivalent)
    );
    assert_eq!(
        conclude_equivalence([-0.1, 0.2], 0.147),
        Ok(EquivalenceConclusion::Undecided)
    );
    assert_eq!(
        conclude_equivalence([0.2, 0.4], 0.147),
        Ok(EquivalenceConclusion::Relevant)
    );
    assert_eq!(
        conclude_equivalence([-0.4, -0.2], 0.147),
        Ok(EquivalenceConclusion::Relevant)
    );
    assert_eq!(
        conclude_equivalence([0.0, 0.1], 0.0),
        Err(UndefinedStatistic::OutOfRange)
    );
}

#[test]
fn the_largest_exact_test_is_close_to_the_approximate_one() {
    let x: Vec<f64> = (0..100).map(|n| f64::from(n % 7)).collect();
    let y: Vec<f64> = (0..100).map(|n| f64::from((n * n + 3) % 8)).collect();
    let p = |method| mann_whitney(&x, &y, TestAlternative::TwoSided, method).unwrap().p;
    assert!((p(None) - p(Some(PValueMethod::Continuity))).abs() < 2e-3);
    let longer = [x.as_slice(), &[1.0]].concat();
    let refused = mann_whitney(&longer, &y, TestAlternative::TwoSided, Some(PValueMethod::Exact));
    assert_eq!(refused, Err(UndefinedStatistic::TooMany));
}
