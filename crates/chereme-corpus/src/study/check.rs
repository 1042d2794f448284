//! The faults of a plan, found before anybody answers it.

use std::collections::BTreeSet;

use chereme_sign::Remedy;
use chereme_sign::text::{did_you_mean, nearest};

use super::plan::{
    ChoiceOption, Comparison, Expectation, PLAN_FORMAT, PLAN_VERSION, Plan, QuestionKind,
    Selection, Trial,
};
use crate::error::{Error, Result};

/// The largest number of trials, questions or options.
const MOST: usize = 500;
/// The largest number of options of a choice.
const MOST_OPTIONS: usize = 60;
/// The largest number of blocks, and of films that a participant sees.
const MOST_BLOCKS: u32 = 20;
const MOST_SHOWN: usize = 1000;
/// The largest number of answers of a scale: the digits 1 to 9 are its keys.
const MOST_POINTS: i64 = 9;
/// The largest size of a plan's JSON in bytes.
pub(super) const LARGEST: usize = 4 << 20;

/// Reads a plan from JSON, and checks it; `place` is the file.
pub(super) fn read(text: &str, place: &str) -> Result<Plan> {
    let wrong = |message: String| {
        let error = Error::wrong(message).at(place);
        error.advise(Remedy::command(
            "`chereme study show CORPUS NAME --json` prints the plan of a study to begin with",
        ))
    };
    if text.len() > LARGEST {
        return Err(wrong("the plan is too large".to_owned()));
    }
    let text = text.trim_start_matches('\u{feff}');
    let plan: Plan = serde_json::from_str(text)
        .map_err(|error| wrong(format!("the plan cannot be read: {error}")))?;
    check(&plan)?;
    Ok(plan)
}

/// Checks a plan, and reports all its faults at once.
pub(super) fn check(plan: &Plan) -> Result<()> {
    let mut faults = Faults(Vec::new());
    if plan.format != PLAN_FORMAT {
        faults.add("format", format!("the format of a plan is {PLAN_FORMAT:?}"));
    }
    if plan.version != PLAN_VERSION {
        let message = format!(
            "the plan is of version {}; this program reads version {PLAN_VERSION}",
            plan.version
        );
        faults.add("version", message);
    }
    if plan.name.trim().is_empty() || plan.name.trim() != plan.name {
        faults.add("name", "a study needs a name".to_owned());
    }
    if plan.main().next().is_none() {
        faults.add(
            "trials",
            "a study needs at least one trial that is analysed".to_owned(),
        );
    }
    if !(1..=MOST_BLOCKS).contains(&plan.design.blocks) {
        faults.add("design", format!("a design has 1 to {MOST_BLOCKS} blocks"));
    }
    let shown = plan.main().count() * plan.design.blocks as usize;
    if shown > MOST_SHOWN {
        faults.add(
            "design",
            format!("a participant would see {shown} films; {MOST_SHOWN} are the most"),
        );
    }
    questions(plan, &mut faults);
    trials(plan, &mut faults);
    profile(plan, &mut faults);
    hypotheses(plan, &mut faults);
    match faults.0.len() {
        0 => Ok(()),
        1 => Err(faults.0.remove(0)),
        _ => Err(Error::Several { errors: faults.0 }),
    }
}

struct Faults(Vec<Error>);

impl Faults {
    fn add(&mut self, place: impl Into<String>, message: String) {
        self.0.push(Error::wrong(message).at(place));
    }

    /// Reports a name that is not among those that exist.
    fn unknown(&mut self, place: impl Into<String>, kind: &str, name: &str, known: &[&str]) {
        let meant = did_you_mean(nearest(name, known.iter().copied()));
        let message = format!("the plan has no {kind} {name:?}{meant}");
        let error = Error::wrong(message).at(place);
        let list = known.join(", ");
        self.0.push(error.advise(format!("it has: {list}")));
    }
}

fn questions(plan: &Plan, faults: &mut Faults) {
    if plan.questions.is_empty() || plan.questions.len() > MOST {
        faults.add("questions", format!("a study has 1 to {MOST} questions"));
    }
    let parts = plan.parts();
    let mut names = BTreeSet::new();
    for (at, question) in plan.questions.iter().enumerate() {
        let place = format!("questions/{at}");
        if question.name.trim().is_empty() || !names.insert(&question.name) {
            faults.add(
                &place,
                format!("each question needs a name of its own: {:?}", question.name),
            );
        }
        for part in &question.parts {
            if !parts.contains(&part.as_str()) {
                faults.unknown(&place, "part", part, &parts);
            }
        }
        match &question.kind {
            QuestionKind::Scale { low, high, labels } => {
                let points = high.saturating_sub(*low).saturating_add(1);
                if !(2..=MOST_POINTS).contains(&points) {
                    faults.add(&place, format!("a scale has 2 to {MOST_POINTS} answers"));
                }
                if labels.keys().any(|at| !(low..=high).contains(&at)) {
                    faults.add(
                        &place,
                        "a label stands at a number beyond the scale".to_owned(),
                    );
                }
            }
            QuestionKind::Choice { options: list } => options(list, &place, faults),
        }
    }
}

fn options(list: &[ChoiceOption], place: &str, faults: &mut Faults) {
    if !(2..=MOST_OPTIONS).contains(&list.len()) {
        faults.add(place, format!("a choice has 2 to {MOST_OPTIONS} options"));
    }
    let mut names = BTreeSet::new();
    for option in list {
        if option.name.trim().is_empty() || !names.insert(&option.name) {
            faults.add(
                place,
                format!("each option needs a name of its own: {:?}", option.name),
            );
        }
        if let Some(picture) = &option.picture
            && !is_file_name(picture)
        {
            faults.add(
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

fn trials(plan: &Plan, faults: &mut Faults) {
    if plan.trials.len() > MOST {
        faults.add("trials", format!("a study has at most {MOST} trials"));
        return;
    }
    let mut seen = BTreeSet::new();
    for (at, trial) in plan.trials.iter().enumerate() {
        let place = format!("trials/{at}");
        if trial.item.trim().is_empty() || trial.clip.trim().is_empty() {
            faults.add(&place, "a trial needs an item and a clip".to_owned());
        }
        if !seen.insert((&trial.part, &trial.item, &trial.condition, trial.role)) {
            let message = format!(
                "{} stands twice with the condition {:?}; answers could not be told apart",
                trial.item, trial.condition
            );
            faults.add(&place, message);
        }
        if plan.asked(trial).next().is_none() {
            faults.add(&place, format!("nothing is asked about {}", trial.item));
        }
        for (name, right) in &trial.right {
            match plan.question(name).map(|it| &it.kind) {
                Some(QuestionKind::Choice { options }) => {
                    if !options.iter().any(|it| it.name == *right) {
                        let names: Vec<&str> = options.iter().map(|it| it.name.as_str()).collect();
                        faults.unknown(&place, "option", right, &names);
                    }
                }
                Some(QuestionKind::Scale { .. }) => {
                    faults.add(
                        &place,
                        format!("{name:?} is a scale, which has no right answer"),
                    );
                }
                None => {
                    let names: Vec<&str> =
                        plan.questions.iter().map(|it| it.name.as_str()).collect();
                    faults.unknown(&place, "question", name, &names);
                }
            }
        }
        if trial.measures.values().any(|it| !it.is_finite()) {
            faults.add(&place, "a measure is no number".to_owned());
        }
    }
}

fn profile(plan: &Plan, faults: &mut Faults) {
    let mut names = BTreeSet::new();
    for (at, question) in plan.profile.iter().enumerate() {
        let place = format!("profile/{at}");
        if question.name.trim().is_empty() || !names.insert(question.name.as_str()) {
            faults.add(
                &place,
                format!("each question needs a name of its own: {:?}", question.name),
            );
        }
        options(&question.options, &place, faults);
    }
    let Some(filter) = &plan.analysed else {
        return;
    };
    match plan.profile.iter().find(|it| it.name == filter.question) {
        Some(question) => {
            let known: Vec<&str> = question.options.iter().map(|it| it.name.as_str()).collect();
            for option in filter
                .options
                .iter()
                .filter(|it| !known.contains(&it.as_str()))
            {
                faults.unknown("analysed", "option", option, &known);
            }
        }
        None => {
            let known: Vec<&str> = plan.profile.iter().map(|it| it.name.as_str()).collect();
            faults.unknown(
                "analysed",
                "question about the participant",
                &filter.question,
                &known,
            );
        }
    }
}

fn hypotheses(plan: &Plan, faults: &mut Faults) {
    for (at, hypothesis) in plan.hypotheses.iter().enumerate() {
        let place = format!("hypotheses/{at}");
        if plan.question(&hypothesis.question).is_none() {
            let names: Vec<&str> = plan.questions.iter().map(|it| it.name.as_str()).collect();
            faults.unknown(&place, "question", &hypothesis.question, &names);
        }
        if !(hypothesis.alpha > 0.0 && hypothesis.alpha < 1.0) {
            faults.add(&place, "alpha lies between 0 and 1".to_owned());
        }
        if let Expectation::SameWithin(margin) = hypothesis.expects
            && !(margin > 0.0 && margin < 1.0)
        {
            faults.add(
                &place,
                "the largest difference lies between 0 and 1".to_owned(),
            );
        }
        match &hypothesis.compares {
            Comparison::Between(groups) | Comparison::Trend(groups) => {
                if groups.len() < 2 {
                    faults.add(&place, "at least two groups are compared".to_owned());
                }
                let own: Vec<Vec<&Trial>> = groups
                    .iter()
                    .map(|it| selected(plan, &hypothesis.question, it))
                    .collect();
                for (group, _) in groups.iter().zip(&own).filter(|it| it.1.is_empty()) {
                    let names =
                        [&group.parts, &group.items, &group.conditions].map(|it| it.join(" "));
                    let message = format!(
                        "{:?} is asked about no trial among {:?}",
                        hypothesis.question,
                        names.join(" ").trim()
                    );
                    faults.add(&place, message);
                }
                let twice = (1..own.len()).any(|at| own[..at].contains(&own[at]));
                if twice && own.iter().all(|it| !it.is_empty()) {
                    faults.add(&place, "two groups have the same trials".to_owned());
                }
            }
            Comparison::Measure(name) => {
                if !plan.main().any(|it| it.measures.contains_key(name)) {
                    let known: BTreeSet<&str> = plan
                        .trials
                        .iter()
                        .flat_map(|it| it.measures.keys().map(String::as_str))
                        .collect();
                    let known: Vec<&str> = known.into_iter().collect();
                    faults.unknown(&place, "measure", name, &known);
                }
            }
        }
    }
}

/// Returns the analysed trials of a group in which the question is asked.
fn selected<'a>(plan: &'a Plan, question: &str, group: &Selection) -> Vec<&'a Trial> {
    let asked = |it: &&Trial| {
        let holds = group.holds(&it.part, &it.item, &it.condition);
        holds && plan.asked(it).any(|one| one.name == question)
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
        assert!(read(&good, "p.json").is_ok());
        // Editors may begin a file with a mark of its encoding.
        assert!(read(&format!("\u{feff}{good}"), "p.json").is_ok());
        for (groups, message) in [
            (
                r#"[{"parts": ["two"]}, {"parts": ["one"]}]"#,
                "\"q\" is asked about no trial among \"two\"",
            ),
            (
                r#"[{"conditions": ["b", "a"]}, {}]"#,
                "two groups have the same trials",
            ),
        ] {
            let error = read(&text(groups), "p.json").expect_err(message);
            assert!(error.to_string().contains(message), "{error}");
        }
    }
}
