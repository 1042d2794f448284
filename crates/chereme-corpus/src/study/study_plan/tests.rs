use super::*;

/// Returns a plan with trials of these items and conditions, and one question.
pub(in crate::study) fn plan_of(trials: &[(String, String)]) -> StudyPlan {
    let trials: Vec<serde_json::Value> = trials
        .iter()
        .map(|(item, condition)| serde_json::json!({"item": item, "condition": condition, "clip": item}))
        .collect();
    let plan = serde_json::json!({
        "format": PLAN_FORMAT, "version": PLAN_VERSION, "name": "test", "trials": trials,
        "questions": [{"name": "realism", "kind": {"scale": {"low": 1, "high": 5}}}],
    });
    serde_json::from_value(plan).expect("a plan")
}

#[test]
fn numbers_with_many_digits_do_not_change_the_hash_of_a_stored_plan() {
    let reread = |plan: &StudyPlan| -> StudyPlan {
        let json = serde_json::to_string(plan).expect("written");
        serde_json::from_str(&json).expect("read again")
    };
    for n in 1..2_000 {
        let mut plan = plan_of(&[("BOL".into(), "captured".into())]);
        let distance = f64::from(n).sqrt() / 7.0;
        plan.trials[0].measures.insert("distance".into(), distance);
        let plan = plan.with_short_numbers();
        assert_eq!(reread(&plan).plan_sha256(), plan.plan_sha256(), "{distance}");
        let kept = plan.trials[0].measures["distance"];
        assert!((kept / distance - 1.0).abs() < 1e-11, "{distance}");
    }
}

#[test]
fn a_plan_is_unchanged_by_its_json() {
    let text = r#"{"format":"chereme-study","version":1,"name":"places","title":{"en":"Places"},
        "trials":[{"item":"BOL","condition":"captured","clip":"BOL","part":"places","right":{"place":"a"}},
                  {"item":"LSF","condition":"slerp","clip":"spell LSF","role":"training","measures":{"distance":0.5}}],
        "questions":[{"name":"realism","kind":{"scale":{"low":1,"high":5,"labels":{"1":{"en":"not at all"}}}}},
                     {"name":"place","kind":{"choice":{"options":[{"name":"a"},{"name":"b","picture":"b.png"}]}},
                      "after":"second","parts":["places"],"cannot_say":true}],
        "hypotheses":[{"name":"H2","question":"realism",
                       "compares":{"between":[{"conditions":["captured"]},{"conditions":["made"]}]},
                       "expects":{"same-within":0.147},"alpha":0.01},
                      {"name":"H9","question":"realism","compares":{"measure":"distance"}}],
        "exclusions":["unfinished",{"checks-wrong":1}]}"#;
    let plan: StudyPlan = serde_json::from_str(text).expect("read");
    let json = serde_json::to_string(&plan).expect("written");
    let reread_plan: StudyPlan = serde_json::from_str(&json).expect("read again");
    assert_eq!(reread_plan, plan);
    assert_eq!(reread_plan.plan_sha256(), plan.plan_sha256());
    let names = |trial| -> Vec<&str> {
        plan.questions_of_trial(trial)
            .map(|question| question.name.as_str())
            .collect()
    };
    assert_eq!(names(&plan.trials[0]), ["realism", "place"]);
    assert_eq!(names(&plan.trials[1]), ["realism"]);
    assert_eq!(plan.plan_parts(), ["places", ""]);
    assert!(serde_json::from_str::<StudyPlan>(&text.replace("\"after\"", "\"later\"")).is_err());
}
