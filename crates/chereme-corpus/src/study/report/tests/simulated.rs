//! Simulated answers with known effects lead to the right conclusions.

use chereme_analysis::random::Random;
use chereme_analysis::statistics::Equivalence;
use serde_json::{Value, json};

use super::{person, plan_of, rated, realism, trial};
use crate::study::answers::Participant;
use crate::study::plan::Plan;
use crate::study::report::{Because, Report, ReportOptions, Verdict, report};
use crate::words::Language;

/// The items of a simulated study; each is shown in every condition.
const ITEMS: [&str; 4] = ["CAT", "SNAIL", "SLUG", "BOWL"];

/// Simulates people who differ in strictness; each condition moves their answers by its effect, in deviations of the
/// noise. Answers are cut at the ends of a scale of five.
fn simulated(
    effects: &[(&str, f64)],
    people: usize,
    more: Value,
    seed: u64,
) -> (Plan, Vec<Participant>) {
    let mut random = Random::new(seed);
    let mut trials = Vec::new();
    for item in ITEMS {
        for (condition, effect) in effects {
            let mut own = trial("", item, condition);
            own["measures"] = json!({"distance": -effect});
            trials.push(own);
        }
    }
    let people = (0..people).map(|number| {
        let strictness = random.normal();
        let mut answers = Vec::new();
        for item in ITEMS {
            for (condition, effect) in effects {
                let value = (3.0 + strictness + effect + random.normal())
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

fn quick(plan: &Plan, people: &[Participant]) -> Report {
    let options = ReportOptions {
        resamples: 500,
        ..ReportOptions::default()
    };
    report(plan, people, &options)
}

fn hypothesis(name: &str, compares: Value, expects: Value, alpha: f64) -> Value {
    json!({"name": name, "question": "realism", "compares": compares, "expects": expects, "alpha": alpha})
}

fn conditions(names: &[&str]) -> Value {
    names
        .iter()
        .map(|name| json!({"conditions": [name]}))
        .collect()
}

#[test]
fn conclusions_follow_the_simulated_effects() {
    let effects = [
        ("captured", 0.0),
        ("twin", 0.0),
        ("slerp", -0.7),
        ("linear", -1.5),
    ];
    let pair = |a: &str, b: &str| json!({"between": conditions(&[a, b])});
    let hypotheses = json!([
        hypothesis(
            "differs",
            pair("captured", "linear"),
            json!("difference"),
            0.01
        ),
        hypothesis(
            "same",
            pair("captured", "twin"),
            json!({"same-within": 0.147}),
            0.05
        ),
        hypothesis(
            "not the same",
            pair("captured", "linear"),
            json!({"same-within": 0.147}),
            0.05
        ),
        hypothesis(
            "no difference",
            pair("captured", "twin"),
            json!("difference"),
            0.05
        ),
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
        hypothesis(
            "follows",
            json!({"measure": "distance"}),
            json!("difference"),
            0.01
        ),
        hypothesis(
            "empty",
            pair("captured", "unknown"),
            json!("difference"),
            0.01
        ),
    ]);
    let (plan, people) = simulated(&effects, 150, json!({"hypotheses": hypotheses}), 5);
    let found = quick(&plan, &people);
    let verdicts = found.comparisons.iter().map(|it| {
        let name = it.hypothesis.as_ref().map_or("", |it| it.name.as_str());
        (name, it.conclusion.map(|it| it.verdict))
    });
    let want = [
        ("differs", Verdict::Supported),
        ("same", Verdict::Supported),
        ("not the same", Verdict::NotSupported),
        ("no difference", Verdict::NotSupported),
        ("rises", Verdict::Supported),
        ("falls", Verdict::NotSupported),
        ("any", Verdict::Supported),
        ("follows", Verdict::Supported),
        ("empty", Verdict::Undecided),
    ];
    let want = want.map(|(name, verdict)| (name, Some(verdict)));
    assert_eq!(verdicts.collect::<Vec<_>>(), want);
    let follows = found.comparisons[7].measure.as_ref().expect("a measure");
    assert!(follows.spearman.found().expect("rho").coefficient < -0.8);
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
        assert_eq!(conclusion.verdict, Verdict::Undecided);
        assert_eq!(conclusion.because, Because::WideInterval);
        let sameness = compared.pairs[0].sameness.found().expect("an interval");
        assert_eq!(sameness.result, Equivalence::Undecided);
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
    assert_eq!(
        (measure.measure.as_str(), measure.points.len()),
        ("distance", 12)
    );
    assert!(follows.conclusion.is_none());
    let places: Vec<[usize; 2]> = compared.pairs.iter().map(|it| it.groups).collect();
    assert_eq!(places, [[0, 1], [0, 2], [1, 2]]);
    assert!(compared.conclusion.is_none() && !compared.is_one_sided());
    for pair in &compared.pairs {
        let [pooled, people] = [&pair.pooled, &pair.people].map(|it| it.found().expect("a test"));
        assert!(pooled.p_holm >= pooled.p && people.p_holm >= people.p);
        let effect = pair.effect.found().expect("an effect");
        let ends = effect.interval.found().expect("an interval");
        assert!(ends.low <= effect.delta && effect.delta <= ends.high);
    }
    let overall = compared.overall.as_ref().expect("tests of three groups");
    let p = overall.people.found().expect("Friedman").p;
    assert!(p < 0.01, "{p}");
}

#[test]
fn plan_and_answers_alone_decide_every_byte() {
    let (plan, people) = simulated(&[("a", 0.0), ("b", 0.5)], 20, json!({}), 4);
    let mut shuffled = people.clone();
    shuffled.reverse();
    let (one, two) = (quick(&plan, &people), quick(&plan, &shuffled));
    let json = |it: &Report| serde_json::to_string(it).expect("JSON");
    assert_eq!(json(&one), json(&two), "the order of import does not count");
    for language in [Language::English, Language::French] {
        assert_eq!(one.page(language), two.page(language));
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
            Language::English,
            ["<html lang=\"en\">", "How to read this", "median"],
        ),
        (
            Language::French,
            ["<html lang=\"fr\">", "Comment lire ce rapport", "médiane"],
        ),
    ] {
        let page = found.page(language);
        for text in words {
            assert!(page.contains(text), "{text}");
        }
        for text in [
            "http:", "https:", "src=", "href=", "url(", "<script", "<b>\"", "NaN", ">inf", "\"inf",
        ] {
            assert!(!page.contains(text), "{text}");
        }
        assert!(page.contains("&lt;b&gt;"), "names are escaped");
        for tag in [
            "svg", "table", "div", "figure", "details", "text", "p", "tr", "td",
        ] {
            let opened = page.matches(&format!("<{tag}>")).count()
                + page.matches(&format!("<{tag} ")).count();
            assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
        }
    }
    let json = serde_json::to_string(&found).expect("JSON");
    assert!(!json.contains("NaN"));
}
