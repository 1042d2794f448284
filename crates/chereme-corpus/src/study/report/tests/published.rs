//! Answers with the sizes, means and deviations of the published studies give their means, deviations and two-sided p.
//!
//! The counts lie in `facts` next to the folder that `CHEREME_SHARED_DATA` names; they are made up to round to the
//! printed numbers, and are not the authors' data.

use std::path::Path;

use serde_json::{Value, json};

use super::{chosen, make_study_report, person, plan_of, rated, realism, trial};
use crate::study::report::{GroupComparison, ReportOptions, TestName};

fn vectors() -> Option<Value> {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return None;
    };
    let path = Path::new(&folder).join("../facts/stat_vectors.json");
    let text = std::fs::read_to_string(path).expect("the vectors");
    let mut all: Value = serde_json::from_str(&text).expect("vectors");
    Some(all["seed_000_section_7"].take())
}

/// Returns each answer of a group of trials: the person, the item and the value.
fn spread(counts: &Value, people: usize) -> Vec<(usize, usize, i64)> {
    let counts = counts.as_array().expect("five counts");
    let values = (1_i64..).zip(counts).flat_map(|(value, count)| {
        let count = usize::try_from(count.as_u64().expect("a count")).expect("a size");
        std::iter::repeat_n(value, count)
    });
    let placed = values.enumerate();
    placed.map(|(at, value)| (at % people, at / people, value)).collect()
}

/// Makes a study with one part for each pair of published groups, and its report.
fn reported(pairs: &[Value], analysed: usize, recruited: usize) -> Vec<GroupComparison> {
    let mut trials = Vec::new();
    let mut answers: Vec<Vec<Value>> = vec![Vec::new(); analysed];
    for (number, pair) in pairs.iter().enumerate() {
        let part = format!("part {number}");
        for (group, condition) in ["first", "second"].into_iter().enumerate() {
            for (who, item, value) in spread(&pair["counts_1_to_5"][group], analysed) {
                let item = format!("{condition} {item}");
                if who == 0 {
                    trials.push(trial(&part, &item, condition));
                }
                answers[who].push(rated(&part, &item, condition, value));
            }
        }
    }
    let plan = plan_of(
        &trials,
        json!([realism()]),
        json!({
            "profile": [{"name": "level", "options": [{"name": "beginner"}, {"name": "good"}]}],
            "analysed": {"question": "level", "options": ["good"]},
        }),
    );
    let mut people: Vec<_> = answers
        .iter()
        .enumerate()
        .map(|(n, own)| person(n, "good", own))
        .collect();
    people.extend((analysed..recruited).map(|n| person(n, "beginner", &answers[0])));
    let options = ReportOptions {
        resamples: 200,
        ..ReportOptions::default()
    };
    let report = make_study_report(&plan, &people, &options);
    assert_eq!((report.people.recruited, report.people.analysed), (recruited, analysed));
    assert_eq!(report.people.excluded[0].count, recruited - analysed);
    report.comparisons
}

#[test]
fn pooled_answers_give_the_published_numbers_two_sided() {
    let Some(all) = vectors() else {
        return;
    };
    let pairs = all["pairs"].as_array().expect("pairs");
    let (of_171, of_39) = pairs.split_at(3);
    let compared = reported(of_171, 57, 75).into_iter().chain(reported(of_39, 39, 53));
    for (compared, want) in compared.zip(pairs) {
        let what = want["what"].as_str().expect("a text");
        let near = |own: f64, key: &Value| {
            let want = key.as_f64().expect("a number");
            assert!(
                (own - want).abs() <= 1e-9 * want.abs(),
                "{what}: {own} instead of {want}"
            );
        };
        for (n, group) in compared.groups.iter().enumerate() {
            let own = group.description.found_result().expect(what);
            near(own.mean, &want["mean"][n]);
            near(own.sd.expect(what), &want["sd_sample"][n]);
            assert_eq!(own.n as u64, want["published"]["n"][n].as_u64().expect("n"), "{what}");
        }
        let pair = &compared.pairs[0];
        let pooled = pair.pooled.found_result().expect(what);
        near(pooled.statistic.expect(what), &want["U1"]);
        near(pair.effect.found_result().expect(what).delta, &want["cliffs_delta"]);
        // Up to 100 answers a group p is exact, which the vectors have for those groups.
        let key = want.get("p_exact_conditional_two_sided");
        near(pooled.p, key.unwrap_or(&want["p_two_sided_continuity"]));
        assert_eq!(
            pair.people.found_result().expect(what).test,
            TestName::Wilcoxon,
            "{what}"
        );
        assert!(!compared.is_one_sided() && compared.conclusion.is_none(), "{what}");
    }
}

#[test]
fn shares_of_recognition_give_the_published_percentages() {
    let Some(all) = vectors() else {
        return;
    };
    let sums = &all["sums_that_the_printed_means_imply"];
    let right = |key: &str| usize::try_from(sums[key].as_u64().expect("a sum")).expect("a size");
    let groups = [
        ("playback", right("recognised playback of 171"), 3),
        ("synthesis", right("recognised synthesis of 285"), 5),
    ];
    let mut trials = Vec::new();
    let mut answers: Vec<Vec<Value>> = vec![Vec::new(); 57];
    for (condition, right, items) in groups {
        for at in 0..57 * items {
            let (who, item) = (at % 57, format!("{condition} {}", at / 57));
            if who == 0 {
                let mut own = trial("", &item, condition);
                own["right"] = json!({"place": "left"});
                trials.push(own);
            }
            let option = if at < right { "left" } else { "right" };
            answers[who].push(chosen("", &item, condition, option));
        }
    }
    let options = json!([{"name": "left"}, {"name": "right"}]);
    let question = json!([{"name": "place", "kind": {"choice": {"options": options}}}]);
    let plan = plan_of(&trials, question, json!({}));
    let people: Vec<_> = answers
        .iter()
        .enumerate()
        .map(|(n, own)| person(n, "good", own))
        .collect();
    let report = make_study_report(&plan, &people, &ReportOptions::default());
    let shares = report.questions[0]
        .conditions
        .iter()
        .map(|it| it.recognition.expect("a share"));
    let shares: Vec<f64> = shares.map(|it| (it.share * 1e4).floor() / 100.0).collect();
    assert_eq!(shares, [63.15, 85.96]);
    let pair = &report.comparisons[0].pairs[0];
    let pooled = pair.pooled.found_result().expect("a test");
    // Fisher's exact p of 108 of 171 against 245 of 285, by scipy.
    assert!((pooled.p / 3.408_364_735_191_808e-8 - 1.0).abs() < 1e-9, "{}", pooled.p);
    let effect = pair.effect.found_result().expect("an effect");
    assert!(
        (effect.delta - (108.0 / 171.0 - 245.0 / 285.0)).abs() < 1e-12,
        "a difference of shares"
    );
    let confusion = &report.questions[0].confusions[1];
    assert_eq!(
        (confusion.condition.as_deref(), &confusion.counts[0][..]),
        (Some("playback"), &[108, 63][..])
    );
}
