//! The faults of a plan, found before anybody answers it.

use std::collections::BTreeSet;

use chereme_sign::text::{did_you_mean, nearest_candidate};

use super::study_plan::{
    ChoiceOption, ExpectedResult, HypothesisComparison, PLAN_FORMAT, PLAN_VERSION, QuestionKind, StudyPlan, StudyTrial,
    TrialSelection,
};
use crate::error::{CorpusError, CorpusResult};

/// The largest number of trials, questions or options.
const MAX_PLAN_ENTRIES: usize = 500;
/// The largest number of options of a choice.
const MOST_OPTIONS: usize = 60;
/// The largest number of blocks, and of films that a participant sees.
const MOST_BLOCKS: u32 = 20;
const MOST_SHOWN: usize = 1000;
/// The largest number of answers of a scale: the digits 1 to 9 are its keys.
const MOST_POINTS: i64 = 9;
/// The largest size of a plan's JSON in bytes.
pub(super) const MAX_PLAN_BYTES: usize = 4 << 20;

/// Reads a plan from JSON, and checks it; `place` is the file.
pub(super) fn read_study_plan(text: &str, place: &str) -> CorpusResult<StudyPlan> {
    let wrong = |message: String| {
        let error = CorpusError::from_wrong_message(message).with_error_place(place);
        error.with_command_advice("`chereme study show CORPUS NAME --json` prints the plan of a study to begin with")
    };
    if text.len() > MAX_PLAN_BYTES {
        return Err(wrong("the plan is too large".to_owned()));
    }
    let text = text.trim_start_matches('\u{feff}');
    let plan: StudyPlan =
        serde_json::from_str(text).map_err(|error| wrong(format!("the plan cannot be read: {error}")))?;
    check_study_plan(&plan)?;
    Ok(plan)
}

/// Checks a plan, and reports all its faults at once.
pub(super) fn check_study_plan(plan: &StudyPlan) -> CorpusResult<()> {
    let mut faults = PlanFaults(Vec::new());
    if plan.format != PLAN_FORMAT {
        faults.add_fault("format", format!("the format of a plan is {PLAN_FORMAT:?}"));
    }
    if plan.version != PLAN_VERSION {
        let message = format!(
            "the plan is of version {}; this program reads version {PLAN_VERSION}",
            plan.version
        );
        faults.add_fault("version", message);
    }
    if plan.name.trim().is_empty() || plan.name.trim() != plan.name {
        faults.add_fault("name", "a study needs a name".to_owned());
    }
    if plan.main().next().is_none() {
        faults.add_fault("trials", "a study needs at least one trial that is analysed".to_owned());
    }
    if !(1..=MOST_BLOCKS).contains(&plan.design.blocks) {
        faults.add_fault("design", format!("a design has 1 to {MOST_BLOCKS} blocks"));
    }
    let shown = plan.main().count() * plan.design.blocks as usize;
    if shown > MOST_SHOWN {
        faults.add_fault(
            "design",
            format!("a participant would see {shown} films; {MOST_SHOWN} are the most"),
        );
    }
    check_plan_questions(plan, &mut faults);
    check_plan_trials(plan, &mut faults);
    check_plan_profile(plan, &mut faults);
    hypotheses(plan, &mut faults);
    match faults.0.len() {
        0 => Ok(()),
        1 => Err(faults.0.remove(0)),
        _ => Err(CorpusError::from_error_list(faults.0)),
    }
}

struct PlanFaults(Vec<CorpusError>);

impl PlanFaults {
    fn add_fault(&mut self, place: impl Into<String>, message: String) {
        self.0
            .push(CorpusError::from_wrong_message(message).with_error_place(place));
    }

    /// Reports a name that is not among those that exist.
    fn report_unknown_name(&mut self, place: impl Into<String>, kind: &str, name: &str, known: &[&str]) {
        let suggestion = did_you_mean(nearest_candidate(name, known.iter().copied()));
        let message = format!("the plan has no {kind} {name:?}{suggestion}");
        let error = CorpusError::from_wrong_message(message).with_error_place(place);
        let list = known.join(", ");
        self.0.push(error.with_advice(format!("it has: {list}")));
    }
}

fn check_plan_questions(plan: &StudyPlan, faults: &mut PlanFaults) {
    if plan.questions.is_empty() || plan.questions.len() > MAX_PLAN_ENTRIES {
        faults.add_fault("questions", format!("a study has 1 to {MAX_PLAN_ENTRIES} questions"));
    }
    let parts = plan.plan_parts();
    let mut names = BTreeSet::new();
    for (at, question) in plan.questions.iter().enumerate() {
        let place = format!("questions/{at}");
        if question.name.trim().is_empty() || !names.insert(&question.name) {
            faults.add_fault(
                &place,
                format!("each question needs a name of its own: {:?}", question.name),
            );
        }
        for part in &question.parts {
            if !parts.contains(&part.as_str()) {
                faults.report_unknown_name(&place, "part", part, &parts);
            }
        }
        match &question.kind {
            QuestionKind::Scale { low, high, labels } => {
                let points = high.saturating_sub(*low).saturating_add(1);
                if !(2..=MOST_POINTS).contains(&points) {
                    faults.add_fault(&place, format!("a scale has 2 to {MOST_POINTS} answers"));
                }
                if labels.keys().any(|at| !(low..=high).contains(&at)) {
                    faults.add_fault(&place, "a label stands at a number beyond the scale".to_owned());
                }
            }
            QuestionKind::Choice { options: list } => check_choice_options(list, &place, faults),
        }
    }
}

fn check_choice_options(list: &[ChoiceOption], place: &str, faults: &mut PlanFaults) {
    if !(2..=MOST_OPTIONS).contains(&list.len()) {
        faults.add_fault(place, format!("a choice has 2 to {MOST_OPTIONS} options"));
    }
    let mut names = BTreeSet::new();
    for option in list {
        if option.name.trim().is_empty() || !names.insert(&option.name) {
            faults.add_fault(place, format!("each option needs a name of its own: {:?}", option.name));
        }
        if let Some(picture) = &option.picture
            && !is_file_name(picture)
        {
            faults.add_fault(
                place,
                format!("{picture:?} is no name of a picture in the folder media"),
            );
        }
    }
}

/// Returns whether a text is the bare name of a file.
pub(super) fn is_file_name(text: &str) -> bool {
    let plain = |letter: char| letter.is_alphanumeric() || "-_. ".contains(letter);
    !text.is_empty() && !text.starts_with('.') && text.len() < 200 && text.chars().all(plain)
}

fn check_plan_trials(plan: &StudyPlan, faults: &mut PlanFaults) {
    if plan.trials.len() > MAX_PLAN_ENTRIES {
        faults.add_fault("trials", format!("a study has at most {MAX_PLAN_ENTRIES} trials"));
        return;
    }
    let mut seen = BTreeSet::new();
    for (at, trial) in plan.trials.iter().enumerate() {
        let place = format!("trials/{at}");
        if trial.item.trim().is_empty() || trial.clip.trim().is_empty() {
            faults.add_fault(&place, "a trial needs an item and a clip".to_owned());
        }
        if !seen.insert((&trial.part, &trial.item, &trial.condition, trial.role)) {
            let message = format!(
                "{} stands twice with the condition {:?}; answers could not be told apart",
                trial.item, trial.condition
            );
            faults.add_fault(&place, message);
        }
        if plan.questions_of_trial(trial).next().is_none() {
            faults.add_fault(&place, format!("nothing is asked about {}", trial.item));
        }
        for (name, right) in &trial.right {
            match plan.find_plan_question(name).map(|question| &question.kind) {
                Some(QuestionKind::Choice { options }) => {
                    if !options.iter().any(|option| option.name == *right) {
                        let names: Vec<&str> = options.iter().map(|option| option.name.as_str()).collect();
                        faults.report_unknown_name(&place, "option", right, &names);
                    }
                }
                Some(QuestionKind::Scale { .. }) => {
                    faults.add_fault(&place, format!("{name:?} is a scale, which has no right answer"));
                }
                None => {
                    let names: Vec<&str> = plan.questions.iter().map(|question| question.name.as_str()).collect();
                    faults.report_unknown_name(&place, "question", name, &names);
                }
            }
        }
        if trial.measures.values().any(|value| !value.is_finite()) {
            faults.add_fault(&place, "a measure is no number".to_owned());
        }
    }
}

fn check_plan_profile(plan: &StudyPlan, faults: &mut PlanFaults) {
    let mut names = BTreeSet::new();
    for (at, question) in plan.profile.iter().enumerate() {
        let place = format!("profile/{at}");
        if question.name.trim().is_empty() || !names.insert(question.name.as_str()) {
            faults.add_fault(
                &place,
                format!("each question needs a name of its own: {:?}", question.name),
            );
        }
        check_choice_options(&question.options, &place, faults);
    }
    let Some(filter) = &plan.analysed else {
        return;
    };
    match plan.profile.iter().find(|question| question.name == filter.question) {
        Some(question) => {
            let option_names: Vec<&str> = question.options.iter().map(|option| option.name.as_str()).collect();
            for option in filter
                .options
                .iter()
                .filter(|name| !option_names.contains(&name.as_str()))
            {
                faults.report_unknown_name("analysed", "option", option, &option_names);
            }
        }
        None => {
            let question_names: Vec<&str> = plan.profile.iter().map(|question| question.name.as_str()).collect();
            faults.report_unknown_name(
                "analysed",
                "question about the participant",
                &filter.question,
                &question_names,
            );
        }
    }
}

fn hypotheses(plan: &StudyPlan, faults: &mut PlanFaults) {
    for (at, hypothesis) in plan.hypotheses.iter().enumerate() {
        let place = format!("hypotheses/{at}");
        if plan.find_plan_question(&hypothesis.question).is_none() {
            let names: Vec<&str> = plan.questions.iter().map(|question| question.name.as_str()).collect();
            faults.report_unknown_name(&place, "question", &hypothesis.question, &names);
        }
        if !(hypothesis.alpha > 0.0 && hypothesis.alpha < 1.0) {
            faults.add_fault(&place, "alpha lies between 0 and 1".to_owned());
        }
        if let ExpectedResult::SameWithin(margin) = hypothesis.expects
            && !(margin > 0.0 && margin < 1.0)
        {
            faults.add_fault(&place, "the largest difference lies between 0 and 1".to_owned());
        }
        match &hypothesis.compares {
            HypothesisComparison::Between(groups) | HypothesisComparison::Trend(groups) => {
                if groups.len() < 2 {
                    faults.add_fault(&place, "at least two groups are compared".to_owned());
                }
                let group_trials: Vec<Vec<&StudyTrial>> = groups
                    .iter()
                    .map(|group| selected_trials(plan, &hypothesis.question, group))
                    .collect();
                for (group, _) in groups.iter().zip(&group_trials).filter(|pair| pair.1.is_empty()) {
                    let names = [&group.parts, &group.items, &group.conditions].map(|list| list.join(" "));
                    let message = format!(
                        "{:?} is asked about no trial among {:?}",
                        hypothesis.question,
                        names.join(" ").trim()
                    );
                    faults.add_fault(&place, message);
                }
                let twice = (1..group_trials.len()).any(|at| group_trials[..at].contains(&group_trials[at]));
                if twice && group_trials.iter().all(|trials| !trials.is_empty()) {
                    faults.add_fault(&place, "two groups have the same trials".to_owned());
                }
            }
            HypothesisComparison::Measure(name) => {
                if !plan.main().any(|trial| trial.measures.contains_key(name)) {
                    let measure_set: BTreeSet<&str> = plan
                        .trials
                        .iter()
                        .flat_map(|trial| trial.measures.keys().map(String::as_str))
                        .collect();
                    let measure_names: Vec<&str> = measure_set.into_iter().collect();
                    faults.report_unknown_name(&place, "measure", name, &measure_names);
                }
            }
        }
    }
}

/// Returns the analysed trials of a group in which the question is asked.
fn selected_trials<'a>(plan: &'a StudyPlan, question: &str, group: &TrialSelection) -> Vec<&'a StudyTrial> {
    let asked = |trial: &&StudyTrial| {
        let holds = group.holds_trial(&trial.part, &trial.item, &trial.condition);
        holds && plan.questions_of_trial(trial).any(|one| one.name == question)
    };
    plan.main().filter(asked).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_without_answers_and_equal_groups_are_faults_of_a_plan() {
        let text = |groups: &str| {
            format!(
                r#"{{"format": "chereme-study", "version": 1, "name": "x",
                "trials": [{{"item": "A", "condition": "a", "clip": "A", "part": "one"}},
                           {{"item": "A", "condition": "b", "clip": "A", "part": "one"}},
                           {{"item": "A", "condition": "a", "clip": "A", "part": "two"}}],
                "questions": [{{"name": "q", "kind": {{"scale": {{"low": 1, "high": 5}}}}, "parts": ["one"]}},
                              {{"name": "r", "kind": {{"scale": {{"low": 1, "high": 5}}}}}}],
                "hypotheses": [{{"name": "H", "question": "q", "compares": {{"between": {groups}}}}}]}}"#
            )
        };
        let good = text(r#"[{"conditions": ["a"]}, {"conditions": ["b"]}]"#);
        assert!(read_study_plan(&good, "p.json").is_ok());
        // Editors may begin a file with a mark of its encoding.
        assert!(read_study_plan(&format!("\u{feff}{good}"), "p.json").is_ok());
        for (groups, message) in [
            (
                r#"[{"parts": ["two"]}, {"parts": ["one"]}]"#,
                "\"q\" is asked about no trial among \"two\"",
            ),
            (r#"[{"conditions": ["b", "a"]}, {}]"#, "two groups have the same trials"),
        ] {
            let error = read_study_plan(&text(groups), "p.json").expect_err(message);
            assert!(error.to_string().contains(message), "{error}");
        }
    }
}
