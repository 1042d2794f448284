//! Milestones, warps and scores of expressions against vectors of other programs.
//!
//! The vectors are not part of the repository: they lie in `facts` next to the folder that `CHEREME_SHARED_DATA` names.

#![allow(clippy::print_stderr, reason = "a test says that it was skipped")]

use std::path::Path;

use chereme_analysis::phases::{NoPath, PhasedError, PhasedPerformance, PhasedScoreOptions, score_phased_candidate};
use chereme_motion::{RecordingInstant, TimeSpan};
use chereme_sign::milestones::{
    ExpressionFunction, ExpressionMilestones, UTTERANCE_EDGE_MICROS, find_expression_milestones,
};
use serde_json::Value;

fn vectors(name: &str) -> Option<Vec<Value>> {
    let Some(folder) = std::env::var_os("CHEREME_SHARED_DATA") else {
        eprintln!("skipped: CHEREME_SHARED_DATA names no folder");
        return None;
    };
    let path = Path::new(&folder).join("../facts/stat_vectors.json");
    let text = std::fs::read_to_string(path).expect("the vectors");
    let all: Value = serde_json::from_str(&text).expect("vectors");
    Some(all[name].as_array().expect("cases").clone())
}

fn numbers(value: &Value) -> Vec<f64> {
    let all = value.as_array().expect("a list");
    all.iter().map(|it| it.as_f64().expect("a number")).collect()
}

#[test]
fn milestones_equal_those_of_the_test_vectors() {
    for case in vectors("milestones").into_iter().flatten() {
        let millis = |value: &Value| RecordingInstant::from_millis(value.as_i64().expect("milliseconds"));
        let span = |it: &Value| TimeSpan::span_between(millis(&it["begin_ms"]), millis(&it["end_ms"]));
        let glosses = case["glosses"].as_array().expect("glosses");
        let signs: Vec<TimeSpan> = glosses.iter().map(span).collect();
        let at = |name: &str| case[name].as_u64().expect("a place") as usize;
        let function = ExpressionFunction::from_function_name(case["kind"].as_str().expect("a kind"));
        let found = find_expression_milestones(&signs, at("first")..at("last") + 1, &function, UTTERANCE_EDGE_MICROS);
        let it = found.expect("milestones");
        let want = case["milestones_ms"].as_array().expect("five").clone();
        let own = [Some(it.m1), Some(it.m2), it.m3, Some(it.m4), Some(it.m5)];
        let own: Vec<Value> = own.map(|at| at.map(RecordingInstant::instant_millis).into()).to_vec();
        assert_eq!(own, want, "{}", case["name"]);
    }
}

#[test]
fn warps_equal_those_of_the_test_vectors() {
    for case in vectors("phase_warp").into_iter().flatten() {
        let marks = |name: &str| {
            let all: Vec<RecordingInstant> = numbers(&case[name])
                .into_iter()
                .map(|millis| RecordingInstant::from_millis(millis as i64))
                .collect();
            ExpressionMilestones::of_times(all.try_into().expect("five"))
        };
        let (own, target) = (marks("source_milestones_ms"), marks("target_milestones_ms"));
        let times = numbers(&case["target_times_ms"]);
        for (at, want) in times.into_iter().zip(numbers(&case["source_times_ms"])) {
            let found = own.moment_for(&target, at / 1000.0).expect("inside") * 1000.0;
            let name = &case["name"];
            assert!(
                (found - want).abs() <= 1e-9 * want.abs().max(1.0),
                "{name} at {at}: {found} {want}"
            );
        }
    }
}

#[test]
fn scores_equal_those_of_the_test_vectors() {
    for case in vectors("phased_score").into_iter().flatten() {
        let name = case["name"].as_str().expect("a name");
        let phased = |rows: &str, marks: &str, seconds: f64| {
            let rows = case[rows].as_array().expect("rows");
            let row = |it: &Value| it.as_f64().map_or_else(|| numbers(it), |one| vec![one]);
            let rows: Vec<Vec<f64>> = rows.iter().map(row).collect();
            let column = |at: usize| rows.iter().map(|row| row[at]).collect();
            let columns: Vec<Vec<f64>> = (0..rows[0].len()).map(column).collect();
            let marks: Vec<usize> = numbers(&case[marks]).into_iter().map(|it| it as usize).collect();
            PhasedPerformance::new(&columns, marks.try_into().expect("five"), seconds).expect("phases")
        };
        let seconds = |name: &str| case[name].as_f64().expect("milliseconds") / 1000.0;
        let gold = phased("gold", "gold_milestones_frames", 1.0);
        let other = phased("candidate", "candidate_milestones_frames", seconds("c_dur_ms"));
        let refuse = PhasedScoreOptions {
            no_path: NoPath::Refuse,
            ..PhasedScoreOptions::default()
        };
        let found = score_phased_candidate(&gold, &other, seconds("anim_dur_ms"), &refuse);
        let phases = case["phases"].as_array().expect("phases");
        if phases.iter().any(|it| it["no_path"] == true) {
            assert!(matches!(found, Err(PhasedError::Phase { .. })), "{name}");
            continue;
        }
        let found = found.expect("scored");
        for (own, want) in found.phases.iter().zip(phases) {
            for (own, want) in [(own.distance, &want["distance"]), (own.normalized, &want["normalised"])] {
                let want = want.as_f64().expect("a number");
                assert!(
                    (own.expect("a number") - want).abs() <= 1e-9 * want,
                    "{name}: {own:?} {want}"
                );
            }
        }
        let want = case["score"].as_f64().expect("a number");
        assert!(
            (found.score - want).abs() <= 1e-9 * want,
            "{name}: {} {want}",
            found.score
        );
    }
}
