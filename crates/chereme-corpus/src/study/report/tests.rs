mod published;
mod rules;
mod simulated;

use serde_json::{Value, json};

use super::{ReportOptions, StudyReport, report_of};
use crate::study::study_answers::StudyParticipant;
use crate::study::study_plan::StudyPlan;

fn make_study_report(plan: &StudyPlan, participants: &[StudyParticipant], options: &ReportOptions) -> StudyReport {
    report_of(plan, plan.plan_sha256(), participants, options)
}

/// Returns a plan from the parts that differ between tests.
fn plan_of(trials: &[Value], questions: Value, more: Value) -> StudyPlan {
    let mut plan = json!({
        "format": "chereme-study", "version": 1, "name": "test", "title": {"en": "A test", "fr": "Un essai"},
        "trials": trials, "questions": questions,
    });
    let own = plan.as_object_mut().expect("an object");
    own.extend(more.as_object().expect("an object").clone());
    serde_json::from_value(plan).expect("a plan")
}

fn trial(part: &str, item: &str, condition: &str) -> Value {
    json!({"part": part, "item": item, "condition": condition, "clip": item})
}

fn realism() -> Value {
    let labels = json!({"1": {"en": "not at all", "fr": "pas du tout"}, "5": {"en": "very", "fr": "très"}});
    json!({"name": "realism", "text": {"en": "How natural?"}, "kind": {"scale": {"low": 1, "high": 5, "labels": labels}}})
}

/// Returns a participant who finished, with a level of sign language and answers.
fn person(number: usize, level: &str, answers: &[Value]) -> StudyParticipant {
    let answers: Vec<Value> = answers
        .iter()
        .enumerate()
        .map(|(at, answer)| {
            let mut answer = answer.clone();
            answer["n"] = json!(at + 1);
            answer
        })
        .collect();
    let person = json!({
        "format": "chereme-answers", "version": 1, "study": "test", "plan_sha256": "",
        "participant": format!("p{number:03}"), "profile": {"level": level}, "finished": true, "answers": answers,
    });
    serde_json::from_value(person).expect("a participant")
}

fn rated(part: &str, item: &str, condition: &str, value: i64) -> Value {
    json!({"part": part, "item": item, "condition": condition, "question": "realism", "value": value})
}

fn chosen(part: &str, item: &str, condition: &str, option: &str) -> Value {
    json!({"part": part, "item": item, "condition": condition, "question": "place", "choice": option})
}
