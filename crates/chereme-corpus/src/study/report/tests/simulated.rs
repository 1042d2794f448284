//! Simulated answers with known effects lead to the right conclusions.

use chereme_analysis::random::RandomNumbers;
use chereme_analysis::statistics::EquivalenceConclusion;
use serde_json::{Value, json};

use super::{make_study_report, person, plan_of, rated, realism, trial};
use crate::study::report::{HypothesisVerdict, ReportOptions, StudyReport, VerdictReason};
use crate::study::study_answers::StudyParticipant;
use crate::study::study_plan::StudyPlan;
use crate::words::InterfaceLanguage;

/// The items of a simulated study; each is shown in every condition.
const ITEMS: [&str; 4] = ["CAT", "SNAIL", "SLUG", "BOWL"];

/// Simulates people who differ in strictness; each condition moves their answers by its effect, in deviations of the
/// noise. Answers are cut at the ends of a scale of five.
fn simulated(effects: &[(&str, f64)], people: usize, more: Value, seed: u64) -> (StudyPlan, Vec<StudyParticipant>) {
    let mut random = RandomNumbers::new(seed);
    let mut trials = Vec::new();
    for item in ITEMS {
        for (condition, effect) in effects {
            let mut own = trial("", item, condition);
            own["measures"] = json!({"distance": -effect});
            trials.push(own);
        }
    }
    let people = (0..people).map(|number| {
        let strictness = random.random_normal();
        let mut answers = Vec::new();
        for item in ITEMS {
            for (condition, effect) in effects {
                let value = (3.0 + strictness + effect + random.random_normal())
                    .round()
                    .clamp(1.0, 5.0);
                answers.push(rated("", item, condition, value as i64));
            }
        }
        person(number, "good", &answers)
    });
    let people = people.collect();
    (plan_of(&trials, json!([realism()]), more), people)
}

fn quick(plan: &StudyPlan, people: &[StudyParticipant]) -> StudyReport {
    let options = ReportOptions {
        resamples: 500,
        ..ReportOptions::default()
    };
    make_study_report(plan, people, &options)
}

fn hypothesis(name: &str, compares: Value, expects: Value, alpha: f64) -> Value {
    json!({"name": name, "question": "realism", "compares": compares, "expects": expects, "alpha": alpha})
}

fn conditions(names: &[&str]) -> Value {
    names.iter().map(|name| json!({"conditions": [name]})).collect()
}

#[test]
fn conclusions_follow_the_simulated_effects() {
    let effects = [("captured", 0.0), ("twin", 0.0), ("slerp", -0.7), ("linear", -1.5)];
    let pair = |a: &str, b: &str| json!({"between": conditions(&[a, b])});
    let hypotheses = json!([
        hypothesis("differs", pair("captured", "linear"), json!("difference"), 0.01),
        hypothesis("same", pair("captured", "twin"), json!({"same-within": 0.147}), 0.05),
        hypothesis(
            "not the same",
            pair("captured", "linear"),
            json!({"same-within": 0.147}),
            0.05
        ),
        hypothesis("no difference", pair("captured", "twin"), json!("difference"), 0.05),
        hypothesis(
            "rises",
            json!({"trend": conditions(&["linear", "slerp", "captured"])}),
            json!("difference"),
            0.05
        ),
        hypothesis(
            "falls",
            json!({"trend": conditions(&["captured", "slerp", "linear"])}),
            json!("difference"),
            0.05
        ),
        hypothesis(
            "any",
            json!({"between": conditions(&["captured", "twin", "linear"])}),
            json!("difference"),
            0.01
        ),
        hypothesis("follows", json!({"measure": "distance"}), json!("difference"), 0.01),
        hypothesis("empty", pair("captured", "unknown"), json!("difference"), 0.01),
    ]);
    let (plan, people) = simulated(&effects, 150, json!({"hypotheses": hypotheses}), 5);
    let found = quick(&plan, &people);
    let verdicts = found.comparisons.iter().map(|it| {
        let name = it.hypothesis.as_ref().map_or("", |it| it.name.as_str());
        (name, it.conclusion.map(|it| it.verdict))
    });
    let want = [
        ("differs", HypothesisVerdict::Supported),
        ("same", HypothesisVerdict::Supported),
        ("not the same", HypothesisVerdict::NotSupported),
        ("no difference", HypothesisVerdict::NotSupported),
        ("rises", HypothesisVerdict::Supported),
        ("falls", HypothesisVerdict::NotSupported),
        ("any", HypothesisVerdict::Supported),
        ("follows", HypothesisVerdict::Supported),
        ("empty", HypothesisVerdict::Undecided),
    ];
    let want = want.map(|(name, verdict)| (name, Some(verdict)));
    assert_eq!(verdicts.collect::<Vec<_>>(), want);
    let follows = found.comparisons[7].measure.as_ref().expect("a measure");
    assert!(follows.spearman.found_result().expect("rho").coefficient < -0.8);
}

#[test]
fn a_test_that_is_not_significant_with_few_people_decides_nothing() {
    let compares = json!({"between": conditions(&["captured", "slerp"])});
    let hypotheses = json!([
        hypothesis("differs", compares.clone(), json!("difference"), 0.01),
        hypothesis("same", compares, json!({"same-within": 0.147}), 0.01),
    ]);
    let (plan, people) = simulated(
        &[("captured", 0.0), ("slerp", -0.2)],
        8,
        json!({"hypotheses": hypotheses}),
        2,
    );
    for compared in quick(&plan, &people).comparisons {
        let conclusion = compared.conclusion.expect("a conclusion");
        assert_eq!(conclusion.verdict, HypothesisVerdict::Undecided);
        assert_eq!(conclusion.because, VerdictReason::WideInterval);
        let sameness = compared.pairs[0].sameness.found_result().expect("an interval");
        assert_eq!(sameness.result, EquivalenceConclusion::Undecided);
        assert!((sameness.ends.level - 0.98).abs() < 1e-12, "1 - 2 alpha");
    }
}

#[test]
fn without_hypotheses_all_pairs_are_compared_and_nothing_is_concluded() {
    let (plan, people) = simulated(&[("a", 0.0), ("b", 0.3), ("c", 0.6)], 30, json!({}), 3);
    let found = quick(&plan, &people);
    let [compared, follows] = &found.comparisons[..] else {
        panic!("one comparison of conditions, one with a measure")
    };
    let measure = follows.measure.as_ref().expect("a measure");
    assert_eq!((measure.measure.as_str(), measure.points.len()), ("distance", 12));
    assert!(follows.conclusion.is_none());
    let places: Vec<[usize; 2]> = compared.pairs.iter().map(|it| it.groups).collect();
    assert_eq!(places, [[0, 1], [0, 2], [1, 2]]);
    assert!(compared.conclusion.is_none() && !compared.is_one_sided());
    for pair in &compared.pairs {
        let [pooled, people] = [&pair.pooled, &pair.people].map(|it| it.found_result().expect("a test"));
        assert!(pooled.p_holm >= pooled.p && people.p_holm >= people.p);
        let effect = pair.effect.found_result().expect("an effect");
        let ends = effect.interval.found_result().expect("an interval");
        assert!(ends.low <= effect.delta && effect.delta <= ends.high);
    }
    let overall = compared.overall.as_ref().expect("tests of three groups");
    let p = overall.people.found_result().expect("Friedman").p;
    assert!(p < 0.01, "{p}");
}

#[test]
fn plan_and_answers_alone_decide_every_byte() {
    let (plan, people) = simulated(&[("a", 0.0), ("b", 0.5)], 20, json!({}), 4);
    let mut shuffled = people.clone();
    shuffled.reverse();
    let (one, two) = (quick(&plan, &people), quick(&plan, &shuffled));
    let json = |it: &StudyReport| serde_json::to_string(it).expect("JSON");
    assert_eq!(json(&one), json(&two), "the order of import does not count");
    for language in [InterfaceLanguage::English, InterfaceLanguage::French] {
        assert_eq!(one.report_page_html(language), two.report_page_html(language));
    }
    let other = json!({"design": {"seed": 99}});
    let (reseeded, _) = simulated(&[("a", 0.0), ("b", 0.5)], 1, other, 4);
    assert_ne!(
        json(&quick(&reseeded, &people)),
        json(&one),
        "the seed of the plan is used"
    );
}

#[test]
fn the_page_is_whole_and_alone() {
    let odd = "<b>\"&";
    let (plan, people) = simulated(&[("a", 0.0), (odd, 0.5)], 20, json!({}), 4);
    let found = quick(&plan, &people);
    for (language, words) in [
        (
            InterfaceLanguage::English,
            ["<html lang=\"en\">", "How to read this", "median"],
        ),
        (
            InterfaceLanguage::French,
            ["<html lang=\"fr\">", "Comment lire ce rapport", "médiane"],
        ),
    ] {
        let page = found.report_page_html(language);
        for text in words {
            assert!(page.contains(text), "{text}");
        }
        for text in [
            "http:", "https:", "src=", "href=", "url(", "<script", "<b>\"", "NaN", ">inf", "\"inf",
        ] {
            assert!(!page.contains(text), "{text}");
        }
        assert!(page.contains("&lt;b&gt;"), "names are escaped");
        for tag in ["svg", "table", "div", "figure", "details", "text", "p", "tr", "td"] {
            let opened = page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }
    let json = serde_json::to_string(&found).expect("JSON");
    assert!(!json.contains("NaN"));
}
