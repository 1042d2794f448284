use proptest::prelude::*;
use serde_json::json;

use super::*;

fn plan(value: serde_json::Value) -> StudyPlan {
    let mut whole = json!({
        "format": "chereme-study", "version": 1, "name": "places",
        "title": {"en": "Places", "fr": "Lieux"},
        "consent": {"purpose": {"en": "why"}, "contact": {}, "kept": {}},
        "profile": [{"name": "level", "options": [{"name": "good"}, {"name": "native"}]}],
        "analysed": {"question": "level", "options": ["native"]},
        "exclusions": ["unfinished", {"checks-wrong": 1}],
    });
    for (name, part) in value.as_object().expect("an object") {
        whole[name] = part.clone();
    }
    serde_json::from_value(whole).expect("a plan")
}

fn crossed_plan() -> StudyPlan {
    let trial = |item: &str, condition: &str, clip: &str| json!({"item": item, "condition": condition, "clip": clip, "right": {"gloss": item}});
    plan(json!({
        "trials": [
            trial("BOL", "captured", "BOL"), trial("BOL", "swapped", "BOL | swap"),
            trial("WEEK END", "captured", "\"WEEK END\""),
            trial("WEEK END", "swapped", "\"WEEK END\" | swap"),
            {"item": "LSF", "condition": "", "clip": "spell LSF", "role": "training", "part": "start",
             "right": {"gloss": "LSF"}}],
        "questions": [
            {"name": "realism", "text": {"en": "Real?"}, "cannot_say": true,
             "kind": {"scale": {"low": 1, "high": 7, "labels": {"1": {"en": "no"}}}}},
            {"name": "low", "kind": {"scale": {"low": -3, "high": 3}}},
            {"name": "gloss", "after": "second", "kind": {"choice": {"options": [
                {"name": "BOL", "picture": "bol.png"}, {"name": "CHAT"}, {"name": "LSF"}, {"name": "WEEK END"}]}}},
            {"name": "where=to", "parts": ["start"], "kind": {"choice": {"options": [{"name": "a"}, {"name": "b"}]}}}],
        "hypotheses": [{"name": "H", "question": "realism", "compares": {"between": [
            {"conditions": ["captured"]}, {"conditions": ["swapped"]}]}}],
    }))
}

#[test]
fn a_plan_of_items_and_conditions_is_the_same_when_it_is_made_again() {
    let plan = crossed_plan();
    let (request, from) = StudyRequest::from_stored_plan(&plan);
    assert_eq!(request.items, ["BOL", "WEEK END"]);
    let conditions = [("captured", "{}"), ("swapped", "{} | swap")];
    let conditions = conditions.map(|(name, recipe)| (name.to_owned(), recipe.to_owned()));
    assert_eq!((request.conditions.as_slice(), from), (&conditions[..], None));
    assert_eq!(
        request.questions,
        ["realism", "low=-3-3", "gloss=items CHAT", "where=to@start=a b"]
    );
    let table = request.trials.as_ref().map(|it| it.0.as_str());
    assert_eq!(
        table,
        Some("item,condition,clip,role,part\nLSF,,spell LSF,training,start\n")
    );
    assert_eq!(request.make_study_plan().expect("a plan"), plan);
}

#[test]
fn a_changed_request_keeps_what_it_does_not_state() {
    let plan = crossed_plan();
    let (mut request, _) = StudyRequest::from_stored_plan(&plan);
    request.items.push("CHAT".to_owned());
    request.questions[0] = "realism=1-5".to_owned();
    request.questions.push("clarity".to_owned());
    let made = request.make_study_plan().expect("a plan");
    assert_eq!(made.trials.len(), plan.trials.len() + 2);
    let realism = &made.questions[0];
    assert_eq!(realism.text["en"], "Real?");
    assert!(realism.cannot_say);
    let QuestionKind::Choice { options } = &made.questions[2].kind else {
        panic!("a choice")
    };
    assert_eq!(options.len(), 4, "CHAT was an option before: {options:?}");
    assert_eq!(options[0].picture.as_deref(), Some("bol.png"));
    assert_eq!((&made.title, &made.profile), (&plan.title, &plan.profile));
    assert_eq!(made.hypotheses, plan.hypotheses);
    request.title = Some("Another".to_owned());
    assert_eq!(request.make_study_plan().expect("a plan").title["fr"], "Another");
}

#[test]
fn distances_are_measured_again_and_other_measures_stay_in_the_table() {
    let with = |measures: [f64; 4], name: &str| {
        let mut plan = crossed_plan();
        for (trial, value) in plan.trials.iter_mut().zip(measures) {
            trial.measures.insert(name.to_owned(), value);
        }
        plan
    };
    let plan = with([0.0, 0.4, 0.0, 0.6], DISTANCE_MEASURE_NAME);
    let (request, from) = StudyRequest::from_stored_plan(&plan);
    assert_eq!(from.as_deref(), Some("captured"));
    assert_eq!(request.items.len(), 2);
    assert!(
        request
            .make_study_plan()
            .expect("a plan")
            .trials
            .iter()
            .all(|it| it.measures.is_empty())
    );
    // No condition has the distance 0 throughout, so that the distances come from elsewhere.
    for plan in [
        with([0.1, 0.4, 0.0, 0.6], DISTANCE_MEASURE_NAME),
        with([1.0; 4], "size"),
    ] {
        let (request, from) = StudyRequest::from_stored_plan(&plan);
        assert_eq!((request.items.len(), from), (0, None));
        assert_eq!(request.make_study_plan().expect("a plan"), plan);
    }
}

#[test]
fn trials_that_no_table_states_are_kept_as_they_are() {
    let mut plan = crossed_plan();
    plan.trials[0].item = " BOL ".to_owned();
    plan.trials[0].measures.insert("clip".to_owned(), 1.0);
    let (request, _) = StudyRequest::from_stored_plan(&plan);
    assert_eq!(request.others, plan.trials);
    assert_eq!(request.make_study_plan().expect("a plan"), plan);
}

proptest! {
    #[test]
    fn every_plan_is_the_same_when_it_is_made_again(
        trials in prop::collection::vec(
            ("[AB ]{1,2}", "[ab]?", "(A|B|AB) ?[|]? ?[a{}\"]{0,3}", 0..3_u8, "[pq]?",
             prop::option::of("[AB]"), prop::option::of(-1.0..1.0_f64)),
            1..8),
        questions in prop::collection::vec(
            ("[a-c=@, ]{1,3}", prop::option::of(prop::collection::vec("[AB \"i]{1,3}|items", 2..4)),
             -2..3_i64, "[pq]?"), 1..4),
    ) {
        let roles = ["training", "main", "check"];
        let trials: Vec<serde_json::Value> = trials.iter().map(|(item, condition, clip, role, part, right, measure)| {
            let mut it = json!({"item": item, "condition": condition, "clip": clip, "part": part,
                                "role": roles[*role as usize]});
            if let Some(right) = right { it["right"] = json!({"a": right}); }
            if let Some(measure) = measure { it["measures"] = json!({"distance": measure}); }
            it
        }).collect();
        let questions: Vec<serde_json::Value> = questions.iter().map(|(name, options, low, part)| {
            let kind = match options {
                Some(names) => json!({"choice": {"options": names.iter().map(|it| json!({"name": it})).collect::<Vec<_>>()}}),
                None => json!({"scale": {"low": low, "high": low + 4}}),
            };
            let parts: Vec<&String> = Some(part).filter(|it| !it.is_empty()).into_iter().collect();
            json!({"name": name, "kind": kind, "parts": parts})
        }).collect();
        let plan = plan(json!({"trials": trials, "questions": questions}));
        let (request, from) = StudyRequest::from_stored_plan(&plan);
        let mut expected = plan.clone();
        if from.is_some() {
            for trial in &mut expected.trials {
                trial.measures.remove(DISTANCE_MEASURE_NAME);
            }
        }
        prop_assert_eq!(request.make_study_plan().expect("a plan"), expected);
    }
}
