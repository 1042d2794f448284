//! Statistics of lexica against closed forms, counts by hand, and computations that take each definition literally.

use std::collections::{BTreeMap, BTreeSet};

use proptest::prelude::*;

use crate::statistics::*;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

/// Returns the entropy as its definition has it: the sum of p log2(1/p).
fn by_definition<K: Ord>(keys: impl IntoIterator<Item = K>) -> f64 {
    let mut counts: BTreeMap<K, f64> = BTreeMap::new();
    for key in keys {
        *counts.entry(key).or_default() += 1.0;
    }
    let n: f64 = counts.values().sum();
    counts.values().map(|c| c / n * (n / c).log2()).sum()
}

/// Entries of a lexicon with three fields.
fn lexicon() -> impl Strategy<Value = Vec<[u32; 3]>> {
    prop::collection::vec([0_u32..4, 0_u32..3, 0_u32..3], 2..40)
}

fn column(rows: &[[u32; 3]], field: usize) -> Vec<u32> {
    rows.iter().map(|row| row[field]).collect()
}

/// Returns the rows without a field.
fn rest(row: &[u32; 3], field: usize) -> Vec<u32> {
    (0..3).filter(|at| *at != field).map(|at| row[at]).collect()
}

#[test]
fn entropy_is_the_number_of_questions() {
    for (keys, bits) in [
        (vec![1, 1, 1, 1], 0.0),
        (vec![1, 2], 1.0),
        (vec![1, 2, 3, 4, 5, 6, 7, 8], 3.0),
        (vec![1, 1, 2, 3], 1.5),
    ] {
        assert_eq!(EqualityClasses::sort_by_keys(keys).class_entropy(), Ok(bits));
    }
    assert_eq!(
        EqualityClasses::sort_by_keys(Vec::<u8>::new()).class_entropy(),
        Err(UndefinedStatistic::Empty)
    );
}

#[test]
fn the_jackknife_of_a_mean_is_its_standard_error() {
    let values = [1.0, 2.0, 4.0, 7.0, 11.0];
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let without: Vec<f64> = (0..values.len())
        .map(|left_out| {
            let others = values.iter().enumerate().filter(|(at, _)| *at != left_out);
            mean(&others.map(|it| *it.1).collect::<Vec<_>>())
        })
        .collect();
    let sd = GroupDescription::describe_values(&values).unwrap().sd.unwrap();
    let half = 1.959_963_984_540_054 * sd / 5_f64.sqrt();
    let [low, high] = jackknife_interval(mean(&values), &without, 0.95).unwrap();
    assert!(near(low, 5.0 - half) && near(high, 5.0 + half));
    assert_eq!(jackknife_interval(1.0, &[1.0], 0.95), Err(UndefinedStatistic::TooFew));
    assert_eq!(
        jackknife_interval(1.0, &[1.0, 1.0], 0.95),
        Err(UndefinedStatistic::NoSpread)
    );
    assert_eq!(
        jackknife_interval(1.0, &[1.0, f64::NAN], 0.95),
        Err(UndefinedStatistic::NotANumber)
    );
    assert_eq!(
        jackknife_interval(1.0, &[1.0, 2.0], 1.0),
        Err(UndefinedStatistic::OutOfRange)
    );
}

#[test]
fn an_association_of_two_by_two_has_a_closed_form() {
    let (a, b, c, d) = (9_usize, 4, 3, 12);
    let cells = [(1, 1, a), (1, 7, b), (5, 1, c), (5, 7, d)];
    let of = |pick: fn(&(u32, u32, usize)) -> u32| -> Vec<u32> {
        let cells = cells.iter();
        cells.flat_map(|it| vec![pick(it); it.2]).collect()
    };
    let found = ValueAssociation::from_field_values(&of(|it| it.0), &of(|it| it.1)).unwrap();
    let [a, b, c, d] = [a, b, c, d].map(|it| it as f64);
    let n = a + b + c + d;
    let chi_square = n * (a * d - b * c).powi(2) / ((a + b) * (c + d) * (a + c) * (b + d));
    assert!(near(found.chi_square, chi_square));
    assert!(near(found.cramers_v().unwrap(), (chi_square / n).sqrt()));
    assert_eq!((found.n, found.rows, found.columns, found.df), (28, 2, 2, 1));
    let one_value = ValueAssociation::from_field_values(&[1, 1, 1], &[1, 2, 3]).unwrap();
    assert_eq!((one_value.bits, one_value.chi_square, one_value.df), (0.0, 0.0, 0));
    assert_eq!(one_value.cramers_v(), Err(UndefinedStatistic::NoSpread));
    assert_eq!(
        ValueAssociation::from_field_values(&[], &[]),
        Err(UndefinedStatistic::Empty)
    );
    assert_eq!(
        ValueAssociation::from_field_values(&[1], &[]),
        Err(UndefinedStatistic::Unequal)
    );
}

#[test]
fn shuffled_values_of_equal_margins_give_the_p_of_an_exact_test() {
    // With a row of half the things the tables as far from the mean are those that are as rare.
    let first: Vec<u32> = (0..20).map(|at| u32::from(at < 10)).collect();
    let second: Vec<u32> = (0..20).map(|at| u32::from(at < 7 || at == 19)).collect();
    let table = [[7, 3], [1, 9]];
    let exact = fisher_exact_test(table).unwrap().p;
    let going = |_| Ok::<(), UndefinedStatistic>(());
    let found = ShuffledAssociation::from_shuffled_values(&first, &second, 20_000, 3, going).unwrap();
    // Three standard errors of a share of 20,000 draws.
    let room = 3.0 * (exact * (1.0 - exact) / 20_000.0).sqrt();
    assert!((found.p_chi_square - exact).abs() < room, "{found:?} {exact}");
    assert!((found.p_bits - exact).abs() < room, "{found:?} {exact}");
    // The expectation of chi-square over all arrangements is n df / (n - 1).
    assert!((found.chi_square - 20.0 / 19.0).abs() < 0.05, "{found:?}");
    assert_eq!(
        ShuffledAssociation::from_shuffled_values(&first, &second, 20_000, 3, going),
        Ok(found)
    );
    assert_ne!(
        ShuffledAssociation::from_shuffled_values(&first, &second, 20_000, 4, going),
        Ok(found)
    );
    let refused = |a: &[u32], samples| ShuffledAssociation::from_shuffled_values(a, &second, samples, 1, going);
    assert_eq!(refused(&first, 0), Err(UndefinedStatistic::TooFew));
    assert_eq!(refused(&[1; 20], 9), Err(UndefinedStatistic::NoSpread));
    let stopped = ShuffledAssociation::from_shuffled_values(&first, &second, 9, 1, |done| match done {
        4 => Err(UndefinedStatistic::TooMany),
        _ => Ok(()),
    });
    assert_eq!(stopped, Err(UndefinedStatistic::TooMany));
}

#[test]
fn a_table_too_large_for_one_piece_is_counted_all_the_same() {
    let many: Vec<u32> = (0..2_100).collect();
    let pairs: Vec<u32> = (0..2_100).map(|at| at / 2).collect();
    let found = ValueAssociation::from_field_values(&many, &many).unwrap();
    assert!(near(found.bits, 2_100_f64.log2()) && near(found.cramers_v().unwrap(), 1.0));
    let found = ValueAssociation::from_field_values(&many, &pairs).unwrap();
    assert!(near(found.bits, 1_050_f64.log2()));
}

#[test]
fn too_many_contrasts_are_refused() {
    let values: Vec<u32> = (0..4_000).collect();
    let rest = EqualityClasses::sort_by_keys(values.iter().map(|_| 0));
    assert_eq!(find_value_contrasts(&rest, &values), Err(UndefinedStatistic::TooMany));
    let same = EqualityClasses::sort_by_keys([0, 0]);
    assert_eq!(find_value_contrasts(&same, &[1, 1]), Err(UndefinedStatistic::NoSpread));
    assert_eq!(find_value_contrasts(&same, &[1]), Err(UndefinedStatistic::Unequal));
    assert_eq!(functional_load(&same, &same), Err(UndefinedStatistic::NoSpread));
}

proptest! {
    #[test]
    fn neighbours_are_those_of_all_comparisons(
        rows in prop::collection::vec(prop::collection::vec(0_u32..3, 5), 0..40),
        most in 0_usize..7,
    ) {
        let counted = count_row_neighbours(&rows, most).unwrap();
        for (place, row) in rows.iter().enumerate() {
            let mut by_distance = vec![0; most.min(5) + 1];
            let mut by_field = [0; 5];
            for (_, other) in rows.iter().enumerate().filter(|(other, _)| *other != place) {
                let differing: Vec<usize> = (0..5).filter(|field| row[*field] != other[*field]).collect();
                if let Some(count) = by_distance.get_mut(differing.len()) {
                    *count += 1;
                }
                if let [field] = differing[..] {
                    by_field[field] += u64::from(most > 0);
                }
            }
            prop_assert_eq!(&counted[place].by_distance, &by_distance);
            prop_assert_eq!(&counted[place].by_field[..], &by_field[..]);
        }
    }

    #[test]
    fn entropy_and_load_are_those_of_the_definitions(rows in lexicon()) {
        let forms = EqualityClasses::sort_by_keys(rows.iter());
        let whole = by_definition(rows.iter());
        prop_assert!(near(forms.class_entropy().unwrap(), whole));
        for field in 0..3 {
            let without = EqualityClasses::sort_by_keys(rows.iter().map(|row| rest(row, field)));
            let less = by_definition(rows.iter().map(|row| rest(row, field)));
            match functional_load(&forms, &without) {
                Ok(load) => {
                    prop_assert!(near(load, (whole - less) / whole));
                    prop_assert!((0.0..=1.0 + 1e-12).contains(&load));
                }
                Err(reason) => prop_assert!(whole < 1e-12 && reason == UndefinedStatistic::NoSpread),
            }
        }
    }

    #[test]
    fn intervals_are_the_jackknife_of_the_definitions(rows in lexicon()) {
        let less_one = |left_out: usize| -> Vec<[u32; 3]> {
            let others = rows.iter().enumerate().filter(|(at, _)| *at != left_out);
            others.map(|(_, row)| *row).collect()
        };
        let load = |rows: &[[u32; 3]]| {
            let without = EqualityClasses::sort_by_keys(rows.iter().map(|row| rest(row, 1)));
            functional_load(&EqualityClasses::sort_by_keys(rows.iter()), &without)
        };
        let entropies: Vec<f64> = (0..rows.len()).map(|it| by_definition(less_one(it))).collect();
        let loads: Result<Vec<f64>, _> = (0..rows.len()).map(|it| load(&less_one(it))).collect();
        let forms = EqualityClasses::sort_by_keys(rows.iter());
        let without = EqualityClasses::sort_by_keys(rows.iter().map(|row| rest(row, 1)));
        let own = forms.entropy_interval(0.9);
        if let (Ok(own), Ok([low, high])) = (own, jackknife_interval(by_definition(&rows), &entropies, 0.9)) {
            // The half width of a jackknife is a difference of nearly equal numbers.
            prop_assert!((own[0] - low.max(0.0)).abs() < 1e-6 && (own[1] - high).abs() < 1e-6);
        }
        let own = functional_load_interval(&forms, &without, 0.9);
        if let (Ok(own), Ok(loads)) = (own, loads) {
            let [low, high] = jackknife_interval(load(&rows).unwrap(), &loads, 0.9).unwrap();
            prop_assert!((own[0] - low.max(0.0)).abs() < 1e-6 && (own[1] - high.min(1.0)).abs() < 1e-6);
        }
    }

    #[test]
    fn a_contrast_is_the_loss_of_joining_two_values(rows in lexicon()) {
        let values = column(&rows, 0);
        let others = EqualityClasses::sort_by_keys(rows.iter().map(|row| rest(row, 0)));
        let whole = by_definition(rows.iter());
        let Ok(found) = find_value_contrasts(&others, &values) else {
            prop_assert!(whole < 1e-12);
            return Ok(());
        };
        let held: BTreeSet<[u32; 2]> = found.iter().map(|it| it.values).collect();
        for a in 0..4 {
            for b in a + 1..4 {
                let joined = rows.iter().map(|row| {
                    let value = if row[0] == b { a } else { row[0] };
                    [value, row[1], row[2]]
                });
                let lost = (whole - by_definition(joined)) / whole;
                let pairs = rows.iter().enumerate().flat_map(|(at, one)| {
                    rows[at + 1..].iter().map(move |other| (one, other))
                });
                let pairs = pairs.filter(|(one, other)| {
                    let both = [one[0].min(other[0]), one[0].max(other[0])];
                    one[1..] == other[1..] && both == [a, b]
                });
                let pairs = pairs.count();
                let own = found.iter().find(|it| it.values == [a, b]);
                prop_assert_eq!(own.map_or(0, |it| it.pairs), pairs);
                prop_assert!(near(own.map_or(0.0, |it| it.load), lost));
                prop_assert_eq!(held.contains(&[a, b]), pairs > 0);
            }
        }
        prop_assert!(found.windows(2).all(|it| it[0].load >= it[1].load));
    }

    #[test]
    fn association_has_no_direction_and_information_is_a_sum_of_entropies(rows in lexicon()) {
        let (x, y) = (column(&rows, 0), column(&rows, 1));
        let (there, back) = (ValueAssociation::from_field_values(&x, &y).unwrap(), ValueAssociation::from_field_values(&y, &x).unwrap());
        prop_assert!(near(there.bits, back.bits) && near(there.chi_square, back.chi_square));
        let joint = by_definition(x.iter().zip(&y));
        prop_assert!(near(there.bits, by_definition(&x) + by_definition(&y) - joint));
        let mut squares = 0.0;
        for a in 0..4 {
            for b in 0..3 {
                let count = |test: &dyn Fn(&(&u32, &u32)) -> bool| {
                    x.iter().zip(&y).filter(|it| test(it)).count() as f64
                };
                let expected = count(&|it| *it.0 == a) * count(&|it| *it.1 == b) / x.len() as f64;
                if expected > 0.0 {
                    squares += (count(&|it| (*it.0, *it.1) == (a, b)) - expected).powi(2) / expected;
                }
            }
        }
        prop_assert!(near(there.chi_square, squares));
        if let Ok(v) = ValueAssociation::from_field_values(&x, &x).unwrap().cramers_v() {
            prop_assert!(near(v, 1.0));
        }
    }
}
