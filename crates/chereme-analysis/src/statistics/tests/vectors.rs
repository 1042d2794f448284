//! Every statistic against numbers of scipy, statsmodels and scikit-posthocs.
//!
//! The vectors are not part of the repository: they lie in `facts` next to the folder that `CHEREME_SHARED_DATA` names.

use std::path::Path;

use serde_json::Value;

use crate::statistics::*;

fn vectors(name: &str) -> Option<Value> {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return None;
    };
    let path = Path::new(&folder).join("../facts/stat_vectors.json");
    let text = std::fs::read_to_string(path).expect("the vectors");
    let mut all: Value = serde_json::from_str(&text).expect("vectors");
    Some(all[name].take())
}

fn cases(name: &str) -> Vec<Value> {
    let all = vectors(name);
    all.map_or_else(Vec::new, |all| all.as_array().expect("cases").clone())
}

/// Returns the numbers of a list; the text "nan", a value that was left out, is not among them.
fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().expect("a list").iter();
    all.filter_map(Value::as_f64).collect()
}

fn lists(value: &Value) -> Vec<Vec<f64>> {
    let all = value.as_array().expect("lists").iter();
    all.map(numbers).collect()
}

/// Closed forms agree to 1e-9, relative to the greater of 1e-3 and the number.
#[track_caller]
fn near(own: f64, want: &Value, what: &str) {
    near_by(own, want, 1e-9, what);
}

#[track_caller]
fn near_by(own: f64, want: &Value, tolerance: f64, what: &str) {
    let want = want.as_f64().unwrap_or_else(|| panic!("{what}: {want}"));
    let off = (own - want).abs() / want.abs().max(1e-3);
    assert!(off <= tolerance, "{what}: {own} instead of {want}");
}

const SIDES: [(TestAlternative, &str); 3] = [
    (TestAlternative::TwoSided, "two_sided"),
    (TestAlternative::Less, "less"),
    (TestAlternative::Greater, "greater"),
];

#[test]
fn two_groups() {
    for case in cases("mann_whitney") {
        let name = case["name"].as_str().expect("a name");
        let (x, y) = (numbers(&case["x"]), numbers(&case["y"]));
        let effect = GroupEffect::measure_group_effect(&x, &y).expect(name);
        near(effect.a12, &case["A12"], name);
        near(effect.delta, &case["cliffs_delta"], name);
        near(effect.shift.expect(name), &case["hodges_lehmann_shift"], name);
        for (side, ending) in SIDES {
            let p = |method| mann_whitney(&x, &y, side, Some(method)).map(|it| it.p);
            let continuity = mann_whitney(&x, &y, side, Some(PValueMethod::Continuity)).expect(name);
            near(continuity.u, &case["U1"], name);
            near(continuity.sd, &case["sd_U_tie_corrected"], name);
            let key = |start: &str| case[format!("p_{start}_{ending}")].clone();
            near(continuity.p, &key("asymptotic_continuity"), name);
            match key("asymptotic_plain") {
                Value::Number(want) => near(p(PValueMethod::Normal).expect(name), &want.into(), name),
                _ => assert_eq!(p(PValueMethod::Normal), Err(UndefinedStatistic::NoSpread), "{name}"),
            }
            for exact in ["exact", "permutation", "exact_conditional"] {
                let want = key(exact);
                if !want.is_null() {
                    near(
                        p(PValueMethod::Exact).expect(name),
                        &want,
                        &format!("{name} {exact} {ending}"),
                    );
                }
            }
        }
        let usual = mann_whitney(&x, &y, TestAlternative::TwoSided, None).expect(name);
        let small = x.len() <= 100 && y.len() <= 100;
        assert_eq!(usual.method == PValueMethod::Exact, small, "{name}");
    }
}

#[test]
fn published_comparisons_with_counts_of_the_same_means() {
    let Some(all) = vectors("seed_000_section_7") else {
        return;
    };
    for case in all["pairs"].as_array().expect("pairs") {
        let what = case["what"].as_str().expect("a text");
        let groups: Vec<Vec<f64>> = lists(&case["counts_1_to_5"])
            .iter()
            .map(|counts| {
                let each = counts.iter().zip([1.0, 2.0, 3.0, 4.0, 5.0]);
                let each = each.map(|(n, value)| vec![value; *n as usize]);
                each.flatten().collect()
            })
            .collect();
        for (n, group) in groups.iter().enumerate() {
            let own = GroupDescription::describe_values(group).expect(what);
            near(own.mean, &case["mean"][n], what);
            near(own.sd.expect(what), &case["sd_sample"][n], what);
        }
        let p = |side| mann_whitney(&groups[0], &groups[1], side, Some(PValueMethod::Continuity));
        let two = p(TestAlternative::TwoSided).expect(what);
        near(two.u, &case["U1"], what);
        near(two.p, &case["p_two_sided_continuity"], what);
        let one = [TestAlternative::Less, TestAlternative::Greater].map(|side| p(side).expect(what).p);
        near(one[0].min(one[1]), &case["p_one_sided_continuity"], what);
        if let Some(want) = case.get("p_exact_conditional_two_sided") {
            let exact = mann_whitney(&groups[0], &groups[1], TestAlternative::TwoSided, None);
            near(exact.expect(what).p, want, what);
        }
    }
}

#[test]
fn several_groups() {
    for case in cases("kruskal_wallis") {
        let name = case["name"].as_str().expect("a name");
        let groups = lists(&case["groups"]);
        let groups: Vec<&[f64]> = groups.iter().map(Vec::as_slice).collect();
        let found = kruskal_wallis(&groups);
        if case["H"].as_f64().is_none() {
            assert_eq!(found, Err(UndefinedStatistic::NoSpread), "{name}");
            continue;
        }
        let found = found.expect(name);
        near(found.h, &case["H"], name);
        near(found.p, &case["p"], name);
        near(found.epsilon_squared, &case["epsilon_squared"], name);
        assert_eq!(found.df as u64, case["df"].as_u64().expect("df"), "{name}");
        for (own, want) in found
            .mean_ranks
            .iter()
            .zip(case["mean_ranks"].as_array().expect("ranks"))
        {
            near(*own, want, name);
        }
        let dunn = case["dunn"].as_array().expect("comparisons");
        assert_eq!(found.comparisons.len(), dunn.len(), "{name}");
        for (own, want) in found.comparisons.iter().zip(dunn) {
            near(own.z, &want["z"], name);
            near(own.p, &want["p"], name);
            near(own.p_holm, &want["p_holm"], name);
        }
    }
}

#[test]
fn pairs_of_values() {
    for case in cases("wilcoxon_signed_rank") {
        let name = case["name"].as_str().expect("a name");
        let (x, y) = (numbers(&case["x"]), numbers(&case["y"]));
        let test = |zeros, side, method| wilcoxon_test(&x, &y, zeros, side, Some(method));
        if case["n_nonzero"] == 0 {
            let found = test(ZeroTreatment::Wilcox, TestAlternative::TwoSided, PValueMethod::Exact);
            assert_eq!(found, Err(UndefinedStatistic::NoDifference), "{name}");
            continue;
        }
        for (side, ending) in SIDES {
            let own = |zeros, method| test(zeros, side, method).expect(name);
            let found = own(ZeroTreatment::Wilcox, PValueMethod::Continuity);
            near(found.plus, &case["W_plus"], name);
            near(found.minus, &case["W_minus"], name);
            near(found.rank_biserial, &case["rank_biserial"], name);
            let key = |start: &str| case[format!("p_{start}_{ending}")].clone();
            near(found.p, &key("asymptotic_continuity"), name);
            near(
                own(ZeroTreatment::Wilcox, PValueMethod::Normal).p,
                &key("asymptotic_plain"),
                name,
            );
            near(
                own(ZeroTreatment::Pratt, PValueMethod::Normal).p,
                &key("pratt_asymptotic_plain"),
                name,
            );
            for exact in ["exact", "permutation"] {
                let want = key(exact);
                if !want.is_null() {
                    near(
                        own(ZeroTreatment::Wilcox, PValueMethod::Exact).p,
                        &want,
                        &format!("{name} {exact}"),
                    );
                }
            }
        }
    }
}

#[test]
fn several_conditions_of_the_same_people() {
    for case in cases("friedman") {
        let name = case["name"].as_str().expect("a name");
        let found = friedman_test(&lists(&case["rows"]));
        if case["chi2"].as_f64().is_none() {
            assert_eq!(found, Err(UndefinedStatistic::NoSpread), "{name}");
            continue;
        }
        let found = found.expect(name);
        near(found.chi_squared, &case["chi2"], name);
        near(found.p, &case["p"], name);
        near(found.w, &case["kendall_W"], name);
        for (own, want) in found
            .mean_ranks
            .iter()
            .zip(case["mean_ranks"].as_array().expect("ranks"))
        {
            near(*own, want, name);
        }
        match found.f {
            Some((f, p)) => {
                near(f, &case["iman_davenport_F"], name);
                near(p, &case["iman_davenport_p"], name);
            }
            None => assert_eq!(case["iman_davenport_F"], "inf", "{name}"),
        }
    }
}

#[test]
fn corrections_for_the_number_of_tests() {
    for case in cases("multiple_comparisons") {
        let own = holm_p_values(&numbers(&case["p"]));
        for (own, want) in own.iter().zip(case["holm"].as_array().expect("a list")) {
            near(*own, want, "Holm");
        }
    }
}

#[test]
fn correlations_of_ranks() {
    for case in cases("rank_correlation") {
        let name = case["name"].as_str().expect("a name");
        let (x, y) = (numbers(&case["x"]), numbers(&case["y"]));
        let both = [
            (spearman_correlation(&x, &y), "spearman_rho", "spearman_p_t"),
            (kendall_tau(&x, &y), "kendall_tau_b", "kendall_p"),
        ];
        for (found, coefficient, p) in both {
            if case[coefficient].as_f64().is_none() {
                assert_eq!(found, Err(UndefinedStatistic::NoSpread), "{name}");
                continue;
            }
            let found = found.expect(name);
            near(found.coefficient, &case[coefficient], name);
            match found.p {
                Some(own) => near(own, &case[p], name),
                None => assert_eq!(case[p], "nan", "{name}"),
            }
        }
    }
}

#[test]
fn descriptions_of_groups() {
    for case in cases("descriptives") {
        let own = GroupDescription::describe_values(&numbers(&case["values"])).expect("values");
        let name = case["values"].to_string();
        near(own.mean, &case["mean"], &name);
        match own.sd {
            Some(sd) => near(sd, &case["sd_sample"], &name),
            None => assert_eq!(case["sd_sample"], "nan", "{name}"),
        }
        let found = [own.q1, own.median, own.q3, own.whisker_low, own.whisker_high];
        let keys = ["q1", "median", "q3", "whisker_low", "whisker_high"];
        for (own, key) in found.into_iter().zip(keys) {
            near(own, &case[key], &format!("{key} of {name}"));
        }
        assert_eq!(own.outliers, numbers(&case["outliers"]), "{name}");
    }
}

#[test]
fn intervals_of_given_resamples() {
    let Some(all) = vectors("bootstrap") else {
        return;
    };
    let given = &all["given_resamples"];
    let mut values = numbers(&given["boot"]);
    values.sort_by(f64::total_cmp);
    let resamples = ParticipantResamples {
        estimate: given["theta"].as_f64().expect("a number"),
        values,
        jackknife: numbers(&given["jackknife"]),
        undefined: 0,
    };
    let kinds = [
        (ResampleIntervalRule::Percentile, &given["percentile_95_type7"]),
        (ResampleIntervalRule::Basic, &given["basic_95"]),
        (ResampleIntervalRule::Bca, &given["bca_95"]["interval"]),
    ];
    for (kind, want) in kinds {
        let own = resamples.resample_interval(kind, 0.95).expect("an interval");
        for (own, want) in own.into_iter().zip(want.as_array().expect("two ends")) {
            near(own, want, &format!("{kind:?}"));
        }
    }
    let every = &all["exhaustive_means_of_1_2_4"];
    let resamples = ParticipantResamples {
        estimate: 7.0 / 3.0,
        values: numbers(&every["all_27_means_sorted"]),
        jackknife: vec![],
        undefined: 0,
    };
    let own = resamples
        .resample_interval(ResampleIntervalRule::Percentile, 0.95)
        .expect("an interval");
    for (own, want) in own
        .into_iter()
        .zip(every["percentile_95_type7"].as_array().expect("two ends"))
    {
        near(own, want, "all resamples");
    }
}

#[test]
fn shares_and_their_tests() {
    for case in cases("proportions") {
        let count = |key: &str| case[key].as_u64().expect("a count");
        let own = wilson_interval(count("k"), count("n"), 0.95).expect("an interval");
        for (own, want) in own.into_iter().zip(case["wilson_95"].as_array().expect("two ends")) {
            near(own, want, &case.to_string());
        }
    }
    for case in cases("fisher_2x2") {
        let table: [[u64; 2]; 2] = serde_json::from_value(case["table"].clone()).expect("a table");
        let own = fisher_exact_test(table).expect("a test");
        let want = case["p_two_sided"].as_f64().expect("a number");
        assert!((own.p / want - 1.0).abs() < 1e-9, "{case}: {}", own.p);
        match own.odds_ratio {
            Some(ratio) => near(ratio, &case["odds_ratio"], "odds"),
            None => assert_eq!(case["odds_ratio"], "inf"),
        }
    }
    for case in cases("mcnemar_exact") {
        let count = |key: &str| case[key].as_u64().expect("a count");
        let own = mcnemar_exact_test(count("b"), count("c")).expect("a test");
        near(own, &case["p"], &case.to_string());
    }
}

#[test]
fn models_of_answers() {
    for case in cases("cumulative_link") {
        let name = case["name"].as_str().expect("a name");
        let answers: Vec<i64> = serde_json::from_value(case["y"].clone()).expect("answers");
        let found = ordinal::fit_ordinal_model(&answers, &lists(&case["X"]));
        if case.get("beta").is_none() {
            assert_eq!(found, Err(UndefinedStatistic::Separated), "{name}");
            continue;
        }
        let found = found.expect(name);
        let near = |own, want: &Value| near_by(own, want, 1e-6, name);
        near(found.log_likelihood, &case["loglik"]);
        for (own, want) in found
            .thresholds
            .iter()
            .zip(case["thresholds"].as_array().expect("list"))
        {
            near(*own, want);
        }
        for (n, own) in found.coefficients.iter().enumerate() {
            near(own.estimate, &case["beta"][n]);
            near(own.se, &case["se_beta"][n]);
            near(own.p, &case["p"][n]);
        }
    }
}
