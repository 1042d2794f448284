//! Compares alignments with cases computed by hand, with exhaustive search over all paths, and with numbers from the
//! field's reference implementation.

use chereme_analysis::dtw::{
    AlignmentWindow, ChannelSeries, CostMethod, DtwAlignment, DtwError, DtwLimits, DtwOptions, DtwPathPolicy,
    LocalDistance, PathObstacle, StepPattern, align_series, dtw_distance, find_nearest_candidates,
};
use proptest::prelude::*;

fn series(values: &[f64]) -> ChannelSeries {
    ChannelSeries::from_columns(&[values]).expect("a series")
}

fn with(pattern: StepPattern, window: AlignmentWindow) -> DtwOptions {
    DtwOptions {
        pattern,
        window,
        ..DtwOptions::default()
    }
}

const PATTERNS: [(&str, StepPattern); 6] = [
    ("symmetric1", StepPattern::Symmetric1),
    ("symmetric2", StepPattern::Symmetric2),
    ("asymmetric", StepPattern::Asymmetric),
    ("symmetricP1", StepPattern::SymmetricP1),
    ("asymmetricP1", StepPattern::AsymmetricP1),
    ("typeIIIc", StepPattern::TypeIiiC),
];

fn pattern(name: &str) -> StepPattern {
    PATTERNS.iter().find(|(n, _)| *n == name).expect("a known pattern").1
}

/// Query, reference, pattern, distance (NaN: no path), normalised distance (NaN: none).
type Case = (&'static [f64], &'static [f64], &'static str, f64, f64);

const NAN: f64 = f64::NAN;

/// Cases short enough to be computed by hand.
const BY_HAND: &[Case] = &[
    // One apart at every frame: three pairs; diagonal steps count twice in symmetric2 (1 + 2 + 2).
    (&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0], "symmetric1", 2.0, NAN),
    (&[4.0, 4.0, 4.0], &[5.0, 5.0, 5.0], "symmetric1", 3.0, NAN),
    (&[4.0, 4.0, 4.0], &[5.0, 5.0, 5.0], "symmetric2", 5.0, 5.0 / 6.0),
    (&[4.0, 4.0, 4.0], &[5.0, 5.0, 5.0], "asymmetric", 3.0, 1.0),
    // A spike in the reference: it is skipped, or aligned with its nearer neighbour (7 - 4 = 3).
    (&[1.0, 4.0], &[1.0, 7.0, 4.0], "asymmetric", 0.0, 0.0),
    (&[1.0, 4.0], &[1.0, 7.0, 4.0], "symmetric1", 3.0, NAN),
    (&[1.0, 4.0], &[1.0, 7.0, 4.0], "symmetric2", 6.0, 6.0 / 5.0),
    // Twice as slow: free for symmetric2, and one frame too many for slopes up to two.
    (&[2.0, 3.0], &[2.0, 2.0, 3.0, 3.0], "symmetric2", 0.0, 0.0),
    (&[2.0, 3.0], &[2.0, 2.0, 3.0, 3.0], "asymmetric", NAN, NAN),
    (&[2.0, 3.0], &[2.0, 2.0, 3.0, 3.0], "symmetricP1", NAN, NAN),
    (&[2.0, 3.0], &[2.0, 2.0, 3.0, 3.0], "typeIIIc", NAN, NAN),
    // Three frames on two: one production each. P1: the middle pair counts twice (symmetric) or a
    // whole frame (asymmetric), and the middle frame meets the last of the reference (distance 4).
    (&[0.0, 6.0, 2.0], &[0.0, 2.0], "symmetricP1", 8.0, 8.0 / 5.0),
    (&[0.0, 6.0, 2.0], &[0.0, 2.0], "asymmetricP1", 4.0, 4.0 / 3.0),
    (&[0.0, 6.0, 2.0], &[0.0, 2.0], "typeIIIc", 4.0, 4.0 / 3.0),
    (&[0.0, 2.0], &[0.0, 6.0, 2.0], "asymmetricP1", 2.0, 1.0),
    (&[0.0, 2.0], &[0.0, 6.0, 2.0], "typeIIIc", 0.0, 0.0),
    // A single frame each.
    (&[3.0], &[1.5], "symmetric2", 1.5, 0.75),
    (&[3.0], &[1.5, 1.0], "asymmetric", NAN, NAN),
];

#[test]
fn cases_worked_out_by_hand() {
    for (query, reference, name, cost, normalized) in BY_HAND {
        let options = with(pattern(name), AlignmentWindow::None);
        let (query, reference) = (series(query), series(reference));
        let found = align_series(&query, &reference, &options);
        let short = dtw_distance(&query, &reference, &options);
        if cost.is_nan() {
            assert!(matches!(found, Err(DtwError::NoPath { .. })), "{name}: {found:?}");
            assert_eq!(found.map(|f| f.cost), short);
            continue;
        }
        let found = found.expect(name).cost;
        assert!((found.distance - cost).abs() < 1e-12, "{name}: {found:?}");
        let norm = found.normalized.unwrap_or(NAN);
        assert_eq!(norm.is_nan(), normalized.is_nan());
        assert!(norm.is_nan() || (norm - normalized).abs() < 1e-12);
        assert_eq!(short.expect(name), found);
    }
}

/// Returns the least cost over all paths that end at `(i, j)`, by recursion on the definition of each pattern; infinite
/// without a path.
fn every_path(d: &dyn Fn(usize, usize) -> f64, name: &str, i: usize, j: usize) -> f64 {
    if (i, j) == (0, 0) {
        return d(0, 0);
    }
    let g = |a: usize, b: usize| {
        if a > i || b > j {
            f64::INFINITY
        } else {
            every_path(d, name, i - a, j - b)
        }
    };
    let l = |a: usize, b: usize| {
        if a > i || b > j { f64::INFINITY } else { d(i - a, j - b) }
    };
    let costs = match name {
        "symmetric1" => vec![g(1, 1) + l(0, 0), g(0, 1) + l(0, 0), g(1, 0) + l(0, 0)],
        "symmetric2" => vec![g(1, 1) + 2.0 * l(0, 0), g(0, 1) + l(0, 0), g(1, 0) + l(0, 0)],
        "asymmetric" => vec![g(1, 0) + l(0, 0), g(1, 1) + l(0, 0), g(1, 2) + l(0, 0)],
        "symmetricP1" => vec![
            g(1, 2) + 2.0 * l(0, 1) + l(0, 0),
            g(1, 1) + 2.0 * l(0, 0),
            g(2, 1) + 2.0 * l(1, 0) + l(0, 0),
        ],
        "asymmetricP1" => vec![
            g(1, 2) + (l(0, 1) + l(0, 0)) / 2.0,
            g(1, 1) + l(0, 0),
            g(2, 1) + l(1, 0) + l(0, 0),
        ],
        _ => vec![
            g(1, 2) + l(0, 0),
            g(1, 1) + l(0, 0),
            g(2, 1) + l(1, 0) + l(0, 0),
            g(2, 2) + l(1, 0) + l(0, 0),
        ],
    };
    costs.into_iter().fold(f64::INFINITY, f64::min)
}

fn rows(frames: std::ops::Range<usize>, channels: usize) -> impl Strategy<Value = Vec<Vec<f64>>> {
    let value = (-40i32..40).prop_map(|v| f64::from(v) / 8.0);
    proptest::collection::vec(proptest::collection::vec(value, channels), frames)
}

fn euclid(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

fn well_formed(found: &DtwAlignment, n: usize, m: usize) -> bool {
    let ends = found.path.first() == Some(&(0, 0)) && found.path.last() == Some(&(n - 1, m - 1));
    let steps = found.path.windows(2).all(|p| {
        let (i, j) = (p[1].0.wrapping_sub(p[0].0), p[1].1.wrapping_sub(p[0].1));
        i <= 2 && j <= 2 && i + j > 0
    });
    ends && steps
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_path_found_is_the_cheapest_of_all_paths(a in rows(1..7, 2), b in rows(1..7, 2)) {
        let (n, m) = (a.len(), b.len());
        let d = |i: usize, j: usize| euclid(&a[i], &b[j]);
        let (query, reference) = (ChannelSeries::from_rows(&a).unwrap(), ChannelSeries::from_rows(&b).unwrap());
        for (name, pattern) in PATTERNS {
            let best = every_path(&d, name, n - 1, m - 1);
            match align_series(&query, &reference, &with(pattern, AlignmentWindow::None)) {
                Ok(found) => {
                    prop_assert!((found.cost.distance - best).abs() < 1e-9, "{}", name);
                    prop_assert!(well_formed(&found, n, m), "{}: {:?}", name, found.path);
                }
                Err(_) => prop_assert!(best.is_infinite(), "{}", name),
            }
        }
    }

    #[test]
    fn the_distance_alone_is_the_same(
        a in rows(1..50, 3), b in rows(1..50, 3), w in 0usize..30, squared: bool
    ) {
        let (query, reference) = (ChannelSeries::from_rows(&a).unwrap(), ChannelSeries::from_rows(&b).unwrap());
        let local = if squared { LocalDistance::SquaredEuclidean } else { LocalDistance::Euclidean };
        for (name, pattern) in PATTERNS {
            for window in [AlignmentWindow::None, AlignmentWindow::SakoeChiba(w), AlignmentWindow::SlantedBand(w)] {
                let options = DtwOptions { local, ..with(pattern, window) };
                let short = dtw_distance(&query, &reference, &options);
                let long = align_series(&query, &reference, &options).map(|found| found.cost);
                prop_assert_eq!(short, long, "{} {:?}", name, window);
            }
        }
    }

    #[test]
    fn symmetric_patterns_give_the_same_distance_in_either_order(a in rows(1..20, 2), b in rows(1..20, 2)) {
        let (a, b) = (ChannelSeries::from_rows(&a).unwrap(), ChannelSeries::from_rows(&b).unwrap());
        for pattern in [StepPattern::Symmetric1, StepPattern::Symmetric2, StepPattern::SymmetricP1] {
            let options = with(pattern, AlignmentWindow::SakoeChiba(6));
            let cost = |a, b| dtw_distance(a, b, &options).map(|cost| cost.distance).ok();
            prop_assert_eq!(cost(&a, &b), cost(&b, &a));
        }
    }

    #[test]
    fn scaling_a_channel_is_scaling_its_values(a in rows(2..9, 2), b in rows(2..9, 2)) {
        let (a, b) = (ChannelSeries::from_rows(&a).unwrap(), ChannelSeries::from_rows(&b).unwrap());
        let scaled = |s: &ChannelSeries, by: f64| s.scale_channels(&[by, 1.0 / 64.0]).unwrap();
        let options = DtwOptions::default();
        let whole = dtw_distance(&a.scale_channels(&[0.5, 0.5]).unwrap(), &b.scale_channels(&[0.5, 0.5]).unwrap(), &options);
        prop_assert_eq!(whole.unwrap().distance, dtw_distance(&a, &b, &options).unwrap().distance * 2.0);
        let loud = dtw_distance(&scaled(&a, 1.0), &scaled(&b, 1.0), &options).unwrap();
        let only = |s: &ChannelSeries| series(s.channel_values(1)).scale_channels(&[1.0 / 64.0]).unwrap();
        prop_assert!(loud.distance >= dtw_distance(&only(&a), &only(&b), &options).unwrap().distance - 1e-9);
    }

    #[test]
    fn the_nearest_candidates_equal_those_of_an_exhaustive_search(
        query in rows(1..20, 2),
        candidates in proptest::collection::vec(rows(1..20, 2), 0..30),
        k in 0usize..6, w in 0usize..12, kind in 0usize..6, window in 0usize..3, squared: bool
    ) {
        let query = ChannelSeries::from_rows(&query).unwrap();
        let mut candidates: Vec<_> =
            candidates.iter().map(|rows| ChannelSeries::from_rows(rows).unwrap()).collect();
        candidates.extend(candidates.first().cloned());
        let options = DtwOptions {
            local: if squared { LocalDistance::SquaredEuclidean } else { LocalDistance::Euclidean },
            ..with(
                PATTERNS[kind].1,
                [AlignmentWindow::None, AlignmentWindow::SakoeChiba(w), AlignmentWindow::SlantedBand(w)][window],
            )
        };
        let mut all: Vec<(f64, usize)> = candidates.iter().enumerate()
            .filter_map(|(i, c)| Some((dtw_distance(&query, c, &options).ok()?.distance, i)))
            .collect();
        let without_path = candidates.len() - all.len();
        all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        all.truncate(k);
        let found = find_nearest_candidates(&query, &candidates, k, &options).unwrap();
        let neighbours: Vec<_> = found.neighbours.iter().map(|n| (n.distance, n.index)).collect();
        prop_assert_eq!(neighbours, all);
        prop_assert_eq!(found.without_path, without_path);
    }

    #[test]
    fn an_open_end_gives_the_best_of_all_end_frames(a in rows(1..8, 1), b in rows(1..12, 1)) {
        let (query, reference) = (ChannelSeries::from_rows(&a).unwrap(), ChannelSeries::from_rows(&b).unwrap());
        for (_, pattern) in &PATTERNS[1..] {
            let open = DtwOptions { open_end: true, ..with(*pattern, AlignmentWindow::None) };
            let best = (1..=b.len())
                .filter_map(|end| {
                    let part = ChannelSeries::from_rows(&b[..end]).unwrap();
                    dtw_distance(&query, &part, &with(*pattern, AlignmentWindow::None)).ok()?.normalized
                })
                .fold(f64::INFINITY, f64::min);
            match align_series(&query, &reference, &open) {
                Ok(found) => prop_assert!((found.cost.normalized.unwrap() - best).abs() < 1e-12),
                Err(_) => prop_assert!(best.is_infinite()),
            }
        }
    }

    #[test]
    fn an_open_begin_and_end_locate_an_excerpt(
        b in rows(8..30, 2), from in 1usize..8, take in 1usize..10
    ) {
        let piece = &b[from.min(b.len() - 1)..(from + take).min(b.len())];
        let (query, reference) = (ChannelSeries::from_rows(piece).unwrap(), ChannelSeries::from_rows(&b).unwrap());
        for pattern in [StepPattern::Asymmetric, StepPattern::AsymmetricP1, StepPattern::TypeIiiC] {
            let options = DtwOptions { open_begin: true, open_end: true, ..with(pattern, AlignmentWindow::None) };
            let found = align_series(&query, &reference, &options).unwrap();
            prop_assert_eq!(found.cost.distance, 0.0);
            for (i, j) in found.path {
                prop_assert_eq!(&piece[i], &b[j]);
            }
        }
    }
}

#[test]
fn equal_steps_are_taken_in_the_order_of_the_pattern() {
    let flat = |n: usize| series(&vec![1.0; n]);
    let path = |pattern, n, m| {
        align_series(&flat(n), &flat(m), &with(pattern, AlignmentWindow::None))
            .unwrap()
            .path
    };
    assert_eq!(path(StepPattern::Symmetric2, 2, 4), [(0, 0), (0, 1), (0, 2), (1, 3)]);
    assert_eq!(path(StepPattern::Symmetric1, 4, 2), [(0, 0), (1, 0), (2, 0), (3, 1)]);
    assert_eq!(path(StepPattern::Asymmetric, 3, 2), [(0, 0), (1, 1), (2, 1)]);
}

#[test]
fn a_pair_without_a_path_is_refused_with_a_remedy_or_adapted_by_policy() {
    let ramp = |n: usize| series(&(0..n).map(|i| i as f64 / (n - 1) as f64).collect::<Vec<_>>());
    let (short, long) = (ramp(30), ramp(45));
    let options = with(StepPattern::Asymmetric, AlignmentWindow::SakoeChiba(10));
    let error = align_series(&short, &long, &options).expect_err("fifteen frames apart");
    let DtwError::NoPath { reason, remedy, .. } = &error else {
        panic!("{error}")
    };
    assert_eq!(*reason, PathObstacle::Window(AlignmentWindow::SakoeChiba(10)));
    assert!(remedy.contains("at least 15 frames"), "{error}");

    let policy = |policy| align_series(&short, &long, &DtwOptions { policy, ..options }).expect("a path");
    let slanted = policy(DtwPathPolicy::SlantedBand);
    assert_eq!(slanted.cost.made, CostMethod::SlantedBand(10));
    let resampled = policy(DtwPathPolicy::Resample);
    assert_eq!(resampled.cost.made, CostMethod::Resampled);
    assert!(resampled.cost.distance < 1e-12 && resampled.path.last() == Some(&(29, 44)));

    let options = DtwOptions {
        policy: DtwPathPolicy::SlantedBand,
        ..with(StepPattern::Asymmetric, AlignmentWindow::None)
    };
    let error = dtw_distance(&ramp(5), &ramp(20), &options).expect_err("four times as long");
    let slope = PathObstacle::Slope(StepPattern::Asymmetric);
    assert!(matches!(error, DtwError::NoPath { reason, .. } if reason == slope));
    let resampled = DtwOptions {
        policy: DtwPathPolicy::Resample,
        ..options
    };
    assert!(dtw_distance(&ramp(5), &ramp(20), &resampled).is_ok_and(|cost| cost.distance < 1e-12));
}

#[test]
fn meaningless_input_is_refused_by_frame_and_channel() {
    let rows = [[0.0, 1.0], [f64::NAN, 1.0]];
    assert!(matches!(
        ChannelSeries::from_rows(&rows),
        Err(DtwError::Value {
            frame: 1,
            channel: 0,
            ..
        })
    ));
    for value in [f64::INFINITY, f64::NEG_INFINITY, 1e200] {
        let found = ChannelSeries::from_columns(&[[0.0, 0.0], [0.0, value]]);
        assert!(matches!(
            found,
            Err(DtwError::Value {
                frame: 1,
                channel: 1,
                ..
            })
        ));
    }
    assert_eq!(ChannelSeries::from_rows::<[f64; 0]>(&[]), Err(DtwError::Empty));
    assert_eq!(ChannelSeries::from_rows::<[f64; 0]>(&[[]]), Err(DtwError::Empty));
    assert_eq!(ChannelSeries::from_columns::<Vec<f64>>(&[]), Err(DtwError::Empty));
    let ragged = ChannelSeries::from_rows(&[vec![0.0, 0.0], vec![0.0]]);
    assert_eq!(
        ragged,
        Err(DtwError::Ragged {
            frame: 1,
            found: 1,
            expected: 2
        })
    );
    let ragged = ChannelSeries::from_columns(&[vec![0.0, 0.0], vec![0.0]]);
    assert_eq!(
        ragged,
        Err(DtwError::Ragged {
            frame: 1,
            found: 1,
            expected: 2
        })
    );
    let two = ChannelSeries::from_rows(&[[0.0, 0.0]]).unwrap();
    let one = series(&[0.0]);
    let channels = DtwError::Channels { query: 2, reference: 1 };
    assert_eq!(align_series(&two, &one, &DtwOptions::default()), Err(channels));
    assert_eq!(
        one.scale_channels(&[0.0]),
        Err(DtwError::Scale { channel: 0, scale: 0.0 })
    );
    assert_eq!(
        one.scale_channels(&[1.0, 1.0]),
        Err(DtwError::Scales { found: 2, channels: 1 })
    );
    let open = DtwOptions {
        open_begin: true,
        ..DtwOptions::default()
    };
    assert!(matches!(
        align_series(&one, &one, &open),
        Err(DtwError::OpenEnd { end: "begin", .. })
    ));
}

#[test]
fn input_that_would_fill_memory_is_refused_with_a_band_that_fits() {
    let hour = series(&vec![0.5; 432_000]);
    let error = align_series(&hour, &hour, &DtwOptions::default()).expect_err("1.9e11 cells");
    assert!(
        error.to_string().contains("slanted band of at most 310 frames"),
        "{error}"
    );
    assert!(matches!(
        dtw_distance(&hour, &hour, &DtwOptions::default()),
        Err(DtwError::TooLarge { .. })
    ));
    let small = DtwLimits { kept: 10, cells: 1000 };
    let options = DtwOptions {
        limits: small,
        ..DtwOptions::default()
    };
    let five = series(&[1.0, 2.0, 3.0, 4.0, 5.0]);
    let error = align_series(&five, &five, &options).expect_err("25 cells");
    assert!(error.to_string().contains("without its path"), "{error}");
    assert!(dtw_distance(&five, &five, &options).is_ok());
}

/// Reads `dtw_vectors.json`, which dtw-python computed, from the folder beside the one that `CHEREME_SHARED_DATA`
/// names.
#[test]
fn every_shared_vector_is_reproduced() {
    let Ok(folder) = std::env::var("CHEREME_SHARED_DATA") else {
        return eprintln!("skipped: CHEREME_SHARED_DATA is not set");
    };
    let path = std::path::Path::new(&folder).join("../facts/dtw_vectors.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        return eprintln!("skipped: no {}", path.display());
    };
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let (mut paths, mut refusals) = (0, 0);
    for case in json["cases"].as_array().expect("cases") {
        let rows =
            |name: &str| -> Vec<Vec<f64>> { serde_json::from_value(case[name].clone()).expect("rows of numbers") };
        let query = ChannelSeries::from_rows(&rows("query")).expect("a series");
        let reference = ChannelSeries::from_rows(&rows("reference")).expect("a series");
        for (spec, expected) in case["results"].as_object().expect("results") {
            let at = format!("{} {spec}", case["label"]);
            let found = align_series(&query, &reference, &options_of(spec));
            let alone = dtw_distance(&query, &reference, &options_of(spec));
            if expected.get("error").is_some() {
                assert!(matches!(found, Err(DtwError::NoPath { .. })), "{at}: {found:?}");
                assert!(matches!(alone, Err(DtwError::NoPath { .. })), "{at}: {alone:?}");
                refusals += 1;
                continue;
            }
            agrees(&found.expect(&at), expected, &at);
            let distance = expected["distance"].as_f64().expect("a number");
            assert!((alone.expect(&at).distance - distance).abs() < 1e-9, "{at}");
            paths += 1;
        }
    }
    assert_eq!((paths, refusals), (239, 51));
}

fn options_of(spec: &str) -> DtwOptions {
    let (name, window) = spec.split_once('_').expect("pattern_window");
    let width = |prefix: &str| window.strip_prefix(prefix).and_then(|w| w.parse().ok());
    let window = match (width("sakoe"), width("slanted")) {
        (Some(w), _) => AlignmentWindow::SakoeChiba(w),
        (_, Some(w)) => AlignmentWindow::SlantedBand(w),
        _ => AlignmentWindow::None,
    };
    with(pattern(name), window)
}

fn agrees(found: &DtwAlignment, expected: &serde_json::Value, at: &str) {
    let distance = expected["distance"].as_f64().expect("a number");
    assert!((found.cost.distance - distance).abs() < 1e-9, "{at}: {found:?}");
    match (found.cost.normalized, expected["normalizedDistance"].as_f64()) {
        (Some(a), Some(b)) => assert!((a - b).abs() < 1e-9, "{at}: {a} {b}"),
        (a, b) => assert_eq!(a, b, "{at}"),
    }
    let index = |name: &str| -> Vec<usize> { serde_json::from_value(expected[name].clone()).expect("indices") };
    let path: Vec<_> = index("index1").into_iter().zip(index("index2")).collect();
    assert_eq!(found.path, path, "{at}");
}
