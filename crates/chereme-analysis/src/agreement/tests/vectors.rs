//! The vectors of `agreement_vectors.json`, which ELAN's own classes, DKPro, krippendorff, scikit-learn, statsmodels,
//! irrCAC, segeval and pygamma-agreement computed. They lie beside the folder that `CHEREME_SHARED_DATA` names.

use serde_json::Value;

use super::*;

/// The tolerance of all but rounded figures.
const TOLERANCE: f64 = 1e-9;

/// Returns the cases of a kind; none without the file, which is reported.
fn cases(kind: &str) -> Vec<Value> {
    let Ok(folder) = std::env::var("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA is not set");
        return Vec::new();
    };
    let path = std::path::Path::new(&folder).join("../facts/agreement_vectors.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        eprintln!("skipped: no {}", path.display());
        return Vec::new();
    };
    let json: Value = serde_json::from_str(&text).expect("JSON");
    let all = json["cases"].as_array().expect("cases").iter();
    let found: Vec<Value> = all.filter(|it| it["kind"] == kind).cloned().collect();
    assert!(!found.is_empty(), "no case is of the kind {kind}");
    found
}

/// Compares a figure with the vector's; a vector without a number wants an undefined figure.
fn check(at: &str, found: AgreementMeasure, wanted: &Value, tolerance: f64) {
    match (found, wanted.as_f64()) {
        (Ok(found), Some(wanted)) => {
            assert!((found - wanted).abs() <= tolerance, "{at}: {found}, wanted {wanted}");
        }
        (found, wanted) => assert_eq!(found.is_err(), wanted.is_none(), "{at}: {found:?} {wanted:?}"),
    }
}

#[test]
fn figures_of_items() {
    for case in cases("items") {
        let id = case["id"].as_str().expect("an id");
        let order = case["order"].as_array().expect("an order");
        let place = |value: &Value| order.iter().position(|it| it == value && !it.is_null());
        let coders = case["coders"].as_array().expect("coders");
        let count = coders[0].as_array().expect("values").len();
        let all: Vec<AnnotatedItem> = (0..count)
            .map(|at| coders.iter().map(|values| place(&values[at])).collect())
            .collect();
        let pairs = AgreementCounts::from_value_pairs(&value_pairs(&all));
        let two = coders.len() == 2;
        let complete = all.iter().all(|item| item.iter().all(Option::is_some));
        // Some programs give 1 for one value; here it is undefined.
        let one_value = order.len() < 2;
        for (name, result) in case["results"].as_object().expect("results") {
            let at = format!("{id} {name}");
            let wanted = &result["value"];
            let found = match name.as_str() {
                "raw" if two => pairs.counted_raw_agreement(),
                "cohen_kappa" => pairs.cohen_kappa(),
                "scott_pi" => pairs.scott_pi(),
                "alpha_nominal" => items::krippendorff_alpha(&all, AlphaScale::Nominal),
                "alpha_ordinal" => items::krippendorff_alpha(&all, AlphaScale::Ordinal),
                "alpha_interval" => items::krippendorff_alpha(&all, AlphaScale::Interval),
                "gwet_ac1" if two && complete => pairs.counted_gwet_ac1(),
                // No command offers weighted and Fleiss' kappa, nor these of more than two annotators.
                "raw"
                | "cohen_kappa_linear"
                | "cohen_kappa_quadratic"
                | "fleiss_kappa"
                | "gwet_ac1"
                | "alpha_nominal_other" => continue,
                other => panic!("{other} is not compared"),
            };
            if one_value && name != "raw" {
                assert!(found.is_err(), "{at}: {found:?}");
                continue;
            }
            if id == "items_single_item_diff" && name == "gwet_ac1" {
                // The package divides by the items less 1 for its standard error. By the formula: (0 - 0.5) / 0.5.
                check(&at, found, &serde_json::json!(-1.0), TOLERANCE);
                continue;
            }
            let tolerance = if name == "gwet_ac1" { 5e-6 } else { TOLERANCE };
            check(&at, found, wanted, tolerance);
            if two && name == "alpha_nominal" {
                check(&at, pairs.counted_nominal_alpha(), wanted, TOLERANCE);
            }
        }
    }
}

#[test]
fn alpha_with_distances_of_features() {
    for case in cases("items_features") {
        let features = case["features"].as_object().expect("features");
        let weights = case["weights"].as_object().expect("weights");
        let values: Vec<&String> = features.keys().collect();
        let sum: f64 = weights.values().filter_map(Value::as_f64).sum();
        let distance = |a: usize, b: usize| {
            let differ = |name: &&String| features[values[a]][*name] != features[values[b]][*name];
            let weight = |name: &String| weights[name].as_f64().unwrap_or(0.0);
            weights.keys().filter(differ).map(weight).sum::<f64>() / sum
        };
        let place = |value: &Value| values.iter().position(|it| Some(it.as_str()) == value.as_str());
        let coders = case["coders"].as_array().expect("coders");
        let count = coders[0].as_array().expect("values").len();
        let all: Vec<AnnotatedItem> = (0..count)
            .map(|at| coders.iter().map(|values| place(&values[at])).collect())
            .collect();
        let at = case["id"].as_str().expect("an id");
        let results = &case["results"];
        let found = items::krippendorff_alpha(&all, AlphaScale::Distance(&distance));
        check(at, found, &results["alpha_feature"]["value"], TOLERANCE);
        let nominal = items::krippendorff_alpha(&all, AlphaScale::Nominal);
        check(
            at,
            nominal,
            &results["alpha_nominal_for_comparison"]["value"],
            TOLERANCE,
        );
    }
}

/// A case of tiers: its names, and the units with values as places in `values`.
struct Tiers {
    names: Vec<String>,
    values: Vec<String>,
    continuum: AnnotationContinuum,
}

fn tiers_of(case: &Value) -> Tiers {
    let tiers = case["tiers"].as_object().expect("tiers");
    let units = |tier: &Value| -> Vec<(i64, i64, String)> { serde_json::from_value(tier.clone()).expect("units") };
    let mut values: Vec<String> = tiers.values().flat_map(units).map(|it| it.2).collect();
    values.sort();
    values.dedup();
    let place = |value: &String| values.iter().position(|it| it == value).expect("known");
    let all = tiers.values().map(|tier| {
        units(tier)
            .iter()
            .map(|(start, end, value)| AnnotatedUnit::new(*start, *end, place(value)))
            .collect()
    });
    let extent: (i64, i64) = serde_json::from_value(case["extent_ms"].clone()).expect("an extent");
    let continuum = AnnotationContinuum::new(extent.0..extent.1, all.collect());
    Tiers {
        names: tiers.keys().cloned().collect(),
        values,
        continuum,
    }
}

#[test]
fn tiers_as_in_elan() {
    for case in cases("tiers") {
        let id = case["id"].as_str().expect("an id");
        let all = tiers_of(&case);
        let results = &case["results"];
        let place = |name: &str| all.names.iter().position(|it| it == name).expect("a tier");
        let sides = |key: &str| {
            let (a, b) = key.split_once(',')?;
            Some((
                &all.continuum.annotator_tiers()[place(a)],
                &all.continuum.annotator_tiers()[place(b)],
            ))
        };
        let ratios = results["elan_overlap_extent"].as_object();
        for (key, wanted) in ratios.into_iter().flatten() {
            if let Some((a, b)) = sides(key) {
                let found = matching::overlap_ratio(a, b);
                match wanted["count"].as_u64() {
                    // ELAN drops such a pair; its class gives 0.
                    Some(0) => assert_eq!(found, Err(UndefinedAgreement::BothEmpty), "{id}"),
                    _ => check(&format!("{id} {key} ratio"), found, &wanted["value"], TOLERANCE),
                }
            }
        }
        let tables = results["elan_modified_kappa_60"].as_object();
        for (key, wanted) in tables.into_iter().flatten() {
            let Some((a, b)) = sides(key) else { continue };
            let at = |name: &str| format!("{id} {key} {name}");
            let pairs = matching::match_overlapping_units(a, b, matching::DEFAULT_OVERLAP_SHARE);
            let expected: Vec<(usize, usize)> = serde_json::from_value(wanted["matched_pairs"].clone()).expect("pairs");
            assert_eq!(pairs, expected, "{}", at("pairs"));
            let table =
                HolleReinTable::from_matching_rows(matching::build_matching_rows(a, b, &pairs), all.values.len());
            assert_eq!(Some(table.annotation_total()), wanted["N"].as_f64(), "{}", at("N"));
            let inner = table.matched_pair_counts();
            let raw_of_matched = inner.counted_raw_agreement();
            for (name, found) in [
                ("raw", table.raw_agreement_with_unmatched()),
                ("kappa_incl_unmatched_plain", table.kappa_with_unmatched()),
                ("kappa_max", table.kappa_max()),
                ("chance_ipf", table.chance_ipf()),
                ("kappa_ipf", table.kappa_ipf()),
                ("raw_excl", raw_of_matched),
                ("kappa_excl", inner.cohen_kappa()),
            ] {
                check(&at(name), found, &wanted[name], TOLERANCE);
            }
            for (value, wanted) in wanted["per_value"].as_object().into_iter().flatten() {
                let nth = all.values.iter().position(|it| it == value).expect("a value");
                let found = table.value_two_by_two(nth);
                let cells = [[found.both, found.second], [found.first, found.neither]];
                let cells_wanted: [[f64; 2]; 2] = serde_json::from_value(wanted["table"].clone()).expect("a table");
                assert_eq!(cells, cells_wanted, "{} {value}", at("table"));
                check(&at(value), found.two_by_two_agreement(), &wanted["raw"], TOLERANCE);
                check(&at(value), found.two_by_two_kappa(), &wanted["kappa"], TOLERANCE);
            }
        }
    }
}

#[test]
fn agreement_over_time() {
    for case in cases("tiers") {
        let id = case["id"].as_str().expect("an id");
        let all = tiers_of(&case);
        let results = &case["results"];
        let at = |name: &str| format!("{id} {name}");
        if let Some(wanted) = results.get("alpha_U_2004") {
            check(
                &at("alpha_U"),
                unitizing::alpha_u(&all.continuum),
                &wanted["value"],
                TOLERANCE,
            );
            let found = unitizing::unitizing_disagreements(&all.continuum);
            for (value, wanted) in wanted["per_value"].as_object().into_iter().flatten() {
                let nth = all.values.iter().position(|it| it == value).expect("a value");
                let own = found[&nth];
                check(&at("D_o"), Ok(own.observed), &wanted["D_o"], TOLERANCE);
                check(&at("D_e"), Ok(own.expected), &wanted["D_e"], TOLERANCE);
                check(
                    &at("alpha_U of a value"),
                    own.unitizing_alpha(),
                    &wanted["alpha_U"],
                    TOLERANCE,
                );
            }
        }
        let u = unitizing::u_alpha(&all.continuum);
        for (name, found) in [
            ("u_alpha_2016", u.all),
            ("bar_u_alpha_2016", u.spans),
            ("cu_alpha_limit", u.values),
        ] {
            if let Some(wanted) = results.get(name) {
                check(&at(name), found, &wanted["value"], TOLERANCE);
            }
        }
        let frames = unitizing::measure_frame_agreement(&all.continuum, 10);
        for (name, found) in [
            ("raw", frames.raw),
            ("cohen_kappa", frames.kappa),
            ("alpha_nominal", frames.alpha),
        ] {
            if let Some(wanted) = results.get("frames_10ms").and_then(|it| it.get(name)) {
                check(&at(name), found, &wanted["value"], TOLERANCE);
            }
        }
    }
}

#[test]
fn alignments_of_least_disorder() {
    let costs = AlignmentCosts::default();
    for case in cases("tiers") {
        let id = case["id"].as_str().expect("an id");
        let all = tiers_of(&case);
        let wanted = &case["results"]["gamma"];
        let found = align_continuum(&all.continuum, &costs);
        check(
            id,
            found.clone().map(|it| it.alignment_disorder()),
            &wanted["disorder_exact"],
            TOLERANCE,
        );
        let (Ok(found), Some(groups)) = (found, wanted["alignment"].as_array()) else {
            continue;
        };
        let shown = |group: &Vec<Option<usize>>| -> Vec<Value> {
            let units = group.iter().zip(all.continuum.annotator_tiers());
            let unit = |(at, tier): (&Option<usize>, &Vec<AnnotatedUnit>)| match at {
                Some(at) => {
                    serde_json::json!([tier[*at].start, tier[*at].end, all.values[tier[*at].value]])
                }
                None => Value::Null,
            };
            units.map(unit).collect()
        };
        let mut shown: Vec<String> = found
            .groups
            .iter()
            .map(|it| Value::from(shown(it)).to_string())
            .collect();
        let mut groups: Vec<String> = groups.iter().map(Value::to_string).collect();
        shown.sort();
        groups.sort();
        // Ties: another alignment of the same disorder is as good.
        if shown != groups {
            eprintln!("{id}: another alignment of the same disorder");
        }
        let seeds: Vec<f64> = serde_json::from_value(wanted["gamma_three_seeds_60_samples"].clone()).expect("three");
        if id == "tiers_signs_like" {
            let sampling = GammaSampling {
                samples: 200,
                ..GammaSampling::default()
            };
            let found = measure_gamma_agreement::<UndefinedAgreement>(&[all.continuum], &costs, &sampling, |_| Ok(()))
                .expect("gamma");
            let gamma = found.gamma.expect("defined");
            let low = seeds.iter().copied().fold(f64::INFINITY, f64::min);
            let high = seeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!(low - 0.05 < gamma && gamma < high + 0.05, "{gamma} {seeds:?}");
        }
    }
}

#[test]
fn segmentations() {
    for case in cases("masses") {
        let id = case["id"].as_str().expect("an id");
        let [first, second]: [Vec<usize>; 2] =
            serde_json::from_value(case["masses"].clone()).expect("two segmentations");
        for (name, wanted) in case["results"].as_object().expect("results") {
            let at = format!("{id} {name}");
            let found = match name.as_str() {
                "boundary_similarity_nt2" => segments::boundary_similarity(&first, &second, 2),
                "boundary_similarity_nt3" => segments::boundary_similarity(&first, &second, 3),
                "segmentation_similarity" | "window_diff" | "pk" => continue,
                "edits" => {
                    let found = segments::count_segmentation_edits(&first, &second, 2);
                    if wanted.get("raises").is_none() {
                        let counts = [found.additions, found.transpositions, found.matches];
                        let names = ["additions", "transpositions", "matches"];
                        let expected = names.map(|it| wanted[it].as_u64().expect("a count") as usize);
                        assert_eq!(counts, expected, "{at}");
                    }
                    continue;
                }
                other => panic!("{other} is not compared"),
            };
            check(&at, found, &wanted["value"], TOLERANCE);
        }
    }
}

/// Compares a figure with a list of shares in percent.
fn check_shares(place: &str, figures: &[crate::agreement::span_measures::HitCounts], wanted: &Value) {
    let wanted = wanted.as_array().expect("figures");
    for (counts, wanted) in figures.iter().zip(wanted) {
        let figure = 100.0 * counts.f1_measure().unwrap_or(0.0);
        let wanted = wanted.as_f64().expect("a figure");
        assert!((figure - wanted).abs() < 1e-6, "{place}: {figure}, wanted {wanted}");
    }
}

#[test]
fn figures_of_spans_with_gaps() {
    use crate::agreement::span_measures::compare_span_lists;

    for case in cases("detection") {
        let id = case["id"].as_str().expect("an id");
        let spans = |name: &str| -> Vec<std::ops::Range<i64>> {
            let all = case[name].as_array().expect("spans").iter();
            let frame = |value: &Value| value.as_i64().expect("a frame");
            all.map(|span| frame(&span[0])..frame(&span[1])).collect()
        };
        let compared = compare_span_lists(&spans("gold"), &spans("predicted"));
        let results = &case["results"];
        check_shares(id, &compared.spans, &results["renz_sign"]["F1S"]);
        if results["renz_boundary"].get("F1B").is_some() {
            check_shares(id, &compared.boundaries, &results["renz_boundary"]["F1B"]);
        }
        let means = [compared.mean_span_f1(), compared.mean_boundary_f1()];
        let is_empty = compared.first_count + compared.second_count == 0;
        assert_eq!(means.map(|mean| mean.is_err()), [is_empty; 2], "{id}");
        let overlap = compared.mean_pair_overlap().unwrap_or(0.0);
        // The other program's overlap of disjoint spans is negative.
        let wanted = results["renz_sign"]["mean_iou"].as_f64().unwrap_or(0.0).max(0.0);
        assert!((overlap - wanted).abs() < TOLERANCE, "{id}: {overlap} {wanted}");
        let frames = compared.frame_overlap().unwrap_or(1.0);
        let wanted = results["moryossef"]["iou"].as_f64().expect("a figure");
        assert!((frames - wanted).abs() < TOLERANCE, "{id}: {frames} {wanted}");
        let percent = compared.span_count_ratio().map(|ratio| 100.0 * ratio);
        check(id, percent, &results["moryossef"]["segments_percent"], 1e-6);
    }
}
