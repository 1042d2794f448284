//! Who is left out, what cannot be computed, and files.

use chereme_analysis::statistics::UndefinedStatistic;
use serde_json::{Value, json};

use super::{chosen, make_study_report, person, plan_of, rated, realism, trial};
use crate::study::report::{ExclusionReason, HypothesisVerdict, ReportOptions, StatsOutcome, TestName, VerdictReason};
use crate::study::study_plan::ExclusionRule;
use crate::words::InterfaceLanguage;

fn options() -> ReportOptions {
    ReportOptions {
        resamples: 100,
        ..ReportOptions::default()
    }
}

#[test]
fn people_are_left_out_by_the_first_rule_that_applies() {
    let mut check = trial("", "STAR", "check");
    check["role"] = json!("check");
    check["right"] = json!({"place": "star"});
    let place = json!({"name": "place", "kind": {"choice": {"options": [{"name": "star"}, {"name": "moon"}]}}});
    let trials = [trial("", "CAT", "a"), trial("", "DOG", "a"), check];
    let plan = plan_of(
        &trials,
        json!([realism(), place]),
        json!({
            "profile": [{"name": "level", "options": [{"name": "beginner"}, {"name": "good"}]}],
            "analysed": {"question": "level", "options": ["good"]},
            "exclusions": ["unfinished", {"checks-wrong": 0}, "one-value"],
        }),
    );
    let answers = |values: [i64; 2], seen: &str| -> Vec<Value> {
        let mut check = chosen("", "STAR", "check", seen);
        check["role"] = json!("check");
        vec![
            rated("", "CAT", "a", values[0]),
            rated("", "DOG", "a", values[1]),
            check,
        ]
    };
    let mut people = vec![
        person(1, "good", &answers([1, 2], "star")),
        person(2, "beginner", &answers([1, 2], "star")),
        person(3, "good", &answers([1, 2], "moon")),
        person(4, "good", &answers([2, 2], "star")),
        person(5, "good", &answers([1, 2], "star")),
        person(6, "good", &answers([4, 2], "star")),
        person(7, "expert", &answers([4, 2], "star")),
    ];
    people[4].finished = false;
    people[5].consent.insert("analysis".to_owned(), false);
    people[6].profile.clear();
    let found = make_study_report(&plan, &people, &options());
    let reasons: Vec<(ExclusionReason, usize)> = found
        .people
        .excluded
        .into_iter()
        .map(|it| (it.reason, it.count))
        .collect();
    let filter = ExclusionReason::Filter {
        question: "level".to_owned(),
    };
    let want = [
        (ExclusionReason::NoConsent, 1),
        (filter, 2),
        (ExclusionReason::Rule(ExclusionRule::Unfinished), 1),
        (ExclusionReason::Rule(ExclusionRule::ChecksWrong(0)), 1),
        (ExclusionReason::Rule(ExclusionRule::OneValue), 1),
    ];
    assert_eq!(reasons, want);
    assert_eq!(found.people.analysed, 1);
    let rows = &found.people.profile[0].rows;
    let rows: Vec<(Option<&str>, usize, usize)> = rows
        .iter()
        .map(|it| (it.option.as_deref(), it.recruited, it.analysed))
        .collect();
    assert_eq!(rows, [(Some("beginner"), 1, 0), (Some("good"), 5, 1), (None, 1, 0)]);
}

#[test]
fn answers_that_cannot_be_compared_say_why() {
    let trials = [trial("", "CAT", "a"), trial("", "CAT", "b")];
    let plan = plan_of(&trials, json!([realism()]), json!({}));
    assert!(
        make_study_report(&plan, &[], &options()).comparisons.is_empty(),
        "nobody answered"
    );
    let same = |number| person(number, "", &[rated("", "CAT", "a", 3), rated("", "CAT", "b", 3)]);
    let found = make_study_report(&plan, &[same(1), same(2), same(3)], &options());
    let pair = &found.comparisons[0].pairs[0];
    assert_eq!(pair.pooled.found_result().expect("a test").p, 1.0);
    let why = StatsOutcome::Nothing {
        why: UndefinedStatistic::NoDifference,
    };
    assert_eq!(pair.people, why);
    let json = serde_json::to_value(&found).expect("JSON");
    assert_eq!(
        json["comparisons"][0]["pairs"][0]["people"],
        json!({"why": "no-difference"})
    );
    let model = &json["questions"][0]["models"][0]["model"];
    assert_eq!(*model, json!({"why": "no-spread"}));
    // Numbers outside the scale are not counted.
    let odd = make_study_report(&plan, &[person(1, "", &[rated("", "CAT", "a", 77)])], &options());
    assert_eq!(odd.questions[0].conditions[0].answers, 0);
    assert_eq!(odd.questions[0].conditions[0].cannot_say, 1);
}

#[test]
fn few_people_or_equal_answers_show_no_sameness() {
    let trials = [trial("", "CAT", "a"), trial("", "CAT", "b")];
    let groups = json!([{"conditions": ["a"]}, {"conditions": ["b"]}]);
    let hypotheses = [json!("difference"), json!({"same-within": 0.3})].map(
        |expects| json!({"name": "H", "question": "realism", "compares": {"between": groups}, "expects": expects}),
    );
    let plan = plan_of(&trials, json!([realism()]), json!({"hypotheses": hypotheses}));
    let people = |count: usize, spread: usize| -> Vec<_> {
        let answers = |n: usize| {
            let value = 3 + i64::from(n.is_multiple_of(4)) * spread as i64;
            let other = value - i64::from(n.is_multiple_of(8)) * spread as i64;
            [rated("", "CAT", "a", value), rated("", "CAT", "b", other)]
        };
        (0..count).map(|n| person(n, "", &answers(n))).collect()
    };
    for (count, spread, verdict, because) in [
        (
            3,
            0,
            HypothesisVerdict::Undecided,
            VerdictReason::NoTest(UndefinedStatistic::TooFew),
        ),
        (
            40,
            0,
            HypothesisVerdict::Undecided,
            VerdictReason::NoTest(UndefinedStatistic::NoSpread),
        ),
        (40, 1, HypothesisVerdict::Supported, VerdictReason::WithinBounds),
    ] {
        let found = make_study_report(&plan, &people(count, spread), &options());
        let same = found.comparisons[1].conclusion.expect("a conclusion");
        assert_eq!((same.verdict, same.because), (verdict, because), "{count} {spread}");
        let other = found.comparisons[0].conclusion.expect("a conclusion");
        assert_ne!(other.verdict, HypothesisVerdict::Supported, "{count} {spread}");
    }
}

#[test]
fn people_of_two_groups_are_compared_with_each_other() {
    let trials = [trial("", "CAT", "a"), trial("", "CAT", "b")];
    let plan = plan_of(&trials, json!([realism()]), json!({}));
    let people: Vec<_> = (0..12)
        .map(|n| {
            let (condition, value) = if n % 2 == 0 { ("a", 1 + n / 6) } else { ("b", 3 + n / 6) };
            person(n as usize, "", &[rated("", "CAT", condition, value)])
        })
        .collect();
    let pair = make_study_report(&plan, &people, &options()).comparisons[0].pairs[0].clone();
    let test = *pair.people.found_result().expect("a test");
    assert_eq!(
        (test.test, test.n, pair.mean_difference),
        (TestName::MannWhitney, [6, 6], None)
    );
}

#[test]
fn one_right_answer_each_is_tested_by_mcnemar() {
    let right = |item: &str, condition: &str| {
        let mut own = trial("", item, condition);
        own["right"] = json!({"place": "x"});
        own
    };
    let place = json!({"name": "place", "kind": {"choice": {"options": [{"name": "x"}, {"name": "y"}]}}});
    let plan = plan_of(&[right("CAT", "a"), right("CAT", "b")], json!([place]), json!({}));
    let people: Vec<_> = (0..10)
        .map(|n| {
            person(
                n,
                "",
                &[
                    chosen("", "CAT", "a", "x"),
                    chosen("", "CAT", "b", if n < 5 { "x" } else { "y" }),
                ],
            )
        })
        .collect();
    let pair = make_study_report(&plan, &people, &options()).comparisons[0].pairs[0].clone();
    let test = *pair.people.found_result().expect("a test");
    assert_eq!(test.test, TestName::Mcnemar);
    assert!((test.p - 2.0 / 32.0).abs() < 1e-12, "five of five in one direction");
    assert_eq!(pair.effect.found_result().expect("an effect").delta, 0.5);
}

#[test]
fn files_are_written_together_and_not_over_others() {
    let trials = [trial("", "CAT", "a"), trial("", "CAT", "b")];
    let plan = plan_of(&trials, json!([realism()]), json!({}));
    let people: Vec<_> = (0..6)
        .map(|n| {
            person(
                n as usize,
                "",
                &[rated("", "CAT", "a", 1 + n % 3), rated("", "CAT", "b", 2 + n % 3)],
            )
        })
        .collect();
    let found = make_study_report(&plan, &people, &options());
    let place = tempfile::tempdir().expect("a folder");
    let folder = place.path().join("report");
    let files = found
        .write_study_report(&folder, false, InterfaceLanguage::English)
        .expect("written");
    assert_eq!(files.len(), 7);
    let groups = std::fs::read_to_string(folder.join("groups.csv")).expect("a table");
    let rows: Vec<&str> = groups.lines().collect();
    assert!(rows[0].starts_with("question,part,item,condition,people,answers,cannot_say,mean,sd"));
    assert_eq!(rows.len(), 1 + 2 + 2, "two conditions, two items");
    assert!(rows[1].starts_with("realism,,,a,6,6,0,2,"), "{}", rows[1]);
    let tests = std::fs::read_to_string(folder.join("tests.csv")).expect("a table");
    let mut table = csv::Reader::from_reader(tests.as_bytes());
    let rows: Vec<csv::StringRecord> = table.records().map(|it| it.expect("a full row")).collect();
    assert_eq!((rows.len(), &rows[0][6], &rows[0][13]), (1, "mann-whitney", "wilcoxon"));
    std::fs::remove_file(folder.join("report.html")).expect("removed");
    assert!(
        found
            .write_study_report(&folder, false, InterfaceLanguage::English)
            .is_err(),
        "nothing is replaced"
    );
    assert!(!folder.join("report.html").exists(), "nor written beside what is there");
    found
        .write_study_report(&folder, true, InterfaceLanguage::English)
        .expect("replaced");
    let page = place.path().join("one.html");
    assert_eq!(
        found
            .write_study_report(&page, false, InterfaceLanguage::French)
            .expect("written"),
        [page]
    );
    let error = found.write_study_report(&place.path().join("one.pdf"), false, InterfaceLanguage::French);
    assert!(error.is_err_and(|it| it.error_remedy().is_some()));
}
