//! The texts of the pane of studies, and its plans before they are stored, without widgets.

use std::fmt::Display;

use chereme_corpus::study::plan::{
    Comparison, Expectation, Hypothesis, Plan, Question, QuestionKind, Role, Selection, Trial,
    text_in,
};
use chereme_corpus::study::report::{Compared, Group, Pair, Report, numbers};
use chereme_corpus::study::{AnswerRow, StudyOverview};
use chereme_corpus::words::reporting;

use crate::words::{Language, Text, fill, studies as words};

/// Returns what stands below the name of a study.
pub(super) fn about(it: &StudyOverview, language: Language) -> String {
    let plan = &it.plan;
    let values: [(&str, &dyn Display); 5] = [
        ("trials", &plan.trials.len()),
        ("items", &plan.items().len()),
        ("conditions", &plan.conditions().len()),
        ("people", &it.participants),
        ("answers", &it.answers),
    ];
    fill(words::ROW_ABOUT.of(language), &values)
}

/// Returns the possible answers to a question in short.
pub(super) fn answers(question: &Question) -> String {
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => format!("{low}–{high}"),
        QuestionKind::Choice { options } => {
            let names: Vec<&str> = options.iter().map(|it| it.name.as_str()).collect();
            names.join(", ")
        }
    }
}

/// A trial as a row: its name, what stands below it, and its clip.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TrialRow {
    pub(super) name: String,
    pub(super) about: String,
    pub(super) clip: String,
}

/// Returns the trials of a plan as rows.
pub(super) fn trials(plan: &Plan, language: Language) -> Vec<TrialRow> {
    let number = |value: f64| {
        let text = numbers::number(value, 3, language);
        let short = text.trim_end_matches('0').trim_end_matches(['.', ',']);
        short.to_owned()
    };
    let row = |it: &Trial| {
        let mut about = vec![it.clip.clone()];
        if it.role != Role::Main {
            about.push(role(it.role).of(language).to_owned());
        }
        if !it.part.is_empty() {
            about.push(fill(words::OF_PART.of(language), &[("part", &it.part)]));
        }
        for (name, right) in &it.right {
            let values: [(&str, &dyn Display); 2] = [("question", name), ("right", right)];
            about.push(fill(words::RIGHT_IS.of(language), &values));
        }
        for (name, value) in &it.measures {
            let value = number(*value);
            let values: [(&str, &dyn Display); 2] = [("name", name), ("answers", &value)];
            about.push(fill(words::ASKED.of(language), &values));
        }
        TrialRow {
            name: trial_name(&it.item, &it.condition, language),
            about: about.join(" · "),
            clip: it.clip.clone(),
        }
    };
    plan.trials.iter().map(row).collect()
}

/// Returns the name of a trial.
pub(super) fn trial_name(item: &str, condition: &str, language: Language) -> String {
    let values: [(&str, &dyn Display); 2] = [("item", &item), ("condition", &condition)];
    match condition {
        "" => item.to_owned(),
        _ => fill(words::TRIAL.of(language), &values),
    }
}

/// Returns the words for the use of a trial.
pub(super) fn role(role: Role) -> Text {
    match role {
        Role::Training => words::TRAINING,
        Role::Main => words::MAIN,
        Role::Check => words::CHECK,
    }
}

/// Returns an answer as a row: its name, and what stands below it.
pub(super) fn answer(it: &AnswerRow, language: Language) -> (String, String) {
    let answer = reporting::answer_text(it, language);
    let trial = trial_name(&it.item, &it.condition, language);
    let values: [(&str, &dyn Display); 4] = [
        ("code", &it.participant),
        ("trial", &trial),
        ("question", &it.question),
        ("answer", &answer),
    ];
    let name = fill(words::ANSWER_ROW.of(language), &values);
    let mut about = Vec::new();
    if let Some(n) = it.n {
        let values: [(&str, &dyn Display); 2] = [("n", &n), ("block", &it.block)];
        about.push(fill(words::ANSWER_PLACE.of(language), &values));
    }
    if !it.part.is_empty() {
        about.push(fill(words::OF_PART.of(language), &[("part", &it.part)]));
    }
    if it.role != Role::Main {
        about.push(role(it.role).of(language).to_owned());
    }
    match it.right {
        Some(true) => about.push(words::RIGHT_ANSWER.of(language).to_owned()),
        Some(false) => about.push(words::WRONG_ANSWER.of(language).to_owned()),
        None => {}
    }
    if it.plays > 0 || it.ms > 0 {
        let seconds = numbers::number(f64::from(it.ms) / 1000.0, 1, language);
        let values: [(&str, &dyn Display); 2] = [("plays", &it.plays), ("s", &seconds)];
        about.push(fill(words::ANSWER_TIMES.of(language), &values));
    }
    (name, about.join(" · "))
}

/// Returns a place of an error in the words of the window, if it says more than the message: a line, a trial, or a part
/// of a plan.
pub(super) fn place(place: &str, language: Language) -> Option<String> {
    if let Some((file, line)) = place.rsplit_once(", line ") {
        let file = match file {
            "table" => words::TABLE.of(language),
            "map" => words::MAP.of(language),
            other => other,
        };
        let values: [(&str, &dyn Display); 2] = [("file", &file), ("line", &line)];
        return Some(fill(words::PLACE_LINE.of(language), &values));
    }
    if let Some(rest) = place.strip_prefix("trial ") {
        return Some(fill(words::PLACE_TRIAL.of(language), &[("trial", &rest)]));
    }
    let (list, at) = place.split_once('/')?;
    let n = at.parse::<usize>().ok()? + 1;
    let text = match list {
        "trials" => words::PLACE_TRIAL.of(language),
        "questions" => words::QUESTION.of(language),
        "hypotheses" => words::HYPOTHESIS.of(language),
        "profile" => words::PLACE_PROFILE.of(language),
        _ => return None,
    };
    Some(fill(text, &[("n", &n), ("trial", &n)]))
}

/// Returns the answers of a group as a row of a table.
pub(super) fn group(name: String, group: &Group, language: Language) -> Vec<String> {
    let number = |value: Option<f64>, decimals| {
        value.map_or_else(String::new, |it| numbers::number(it, decimals, language))
    };
    let own = group.description.as_ref();
    let share = group.recognition;
    vec![
        name,
        group.answers.to_string(),
        match group.cannot_say {
            0 => String::new(),
            n => n.to_string(),
        },
        number(own.map(|it| it.mean), 3),
        number(own.and_then(|it| it.sd), 3),
        number(own.map(|it| it.median), 1),
        share.map_or_else(String::new, |it| numbers::percent(it.share, language)),
    ]
}

/// Returns a sentence for each correlation of answers with a measure.
pub(super) fn correlations(report: &Report, language: Language) -> Vec<String> {
    let measured = report.comparisons.iter().filter_map(|it| {
        let measure = it.measure.as_ref()?;
        let number = |value: f64| numbers::number(value, 3, language);
        let found = measure.spearman.found();
        let ends = measure.interval.found();
        let interval = ends.map_or_else(
            || "–".to_owned(),
            |it| format!("[{}; {}]", number(it.low), number(it.high)),
        );
        let values: [(&str, &dyn Display); 6] = [
            ("measure", &measure.measure),
            ("question", &it.question),
            ("n", &measure.points.len()),
            (
                "rho",
                &found.map_or_else(|| "–".to_owned(), |it| number(it.coefficient)),
            ),
            (
                "p",
                &found
                    .and_then(|it| it.p)
                    .map_or_else(|| "–".to_owned(), |it| numbers::p(it, language)),
            ),
            ("interval", &interval),
        ];
        Some(fill(words::CORRELATION.of(language), &values))
    });
    measured.collect()
}

/// Returns a hypothesis as a sentence.
pub(super) fn hypothesis(it: &Hypothesis, language: Language) -> String {
    let group = |it: &Selection| {
        let all = it.parts.iter().chain(&it.items).chain(&it.conditions);
        let all: Vec<&str> = all.map(String::as_str).collect();
        match all.is_empty() {
            true => words::ALL_TRIALS.of(language).to_owned(),
            false => all.join(" "),
        }
    };
    let joined = |groups: &[Selection], mark: &str| {
        let groups: Vec<String> = groups.iter().map(group).collect();
        groups.join(mark)
    };
    let expected = match (&it.compares, it.expects) {
        (Comparison::Between(groups), Expectation::Difference) => joined(groups, " ≠ "),
        (Comparison::Between(groups), Expectation::SameWithin(bound)) => {
            let bound = numbers::number(bound, 3, language);
            format!("{} (±{bound})", joined(groups, " ≈ "))
        }
        (Comparison::Trend(groups), _) => joined(groups, " < "),
        (Comparison::Measure(name), _) => fill(words::WITH_MEASURE.of(language), &[("name", name)]),
    };
    let text = text_in(&it.text, language.code()).map(|it| format!(" – {it}"));
    let values: [(&str, &dyn Display); 4] = [
        ("name", &it.name),
        ("question", &it.question),
        ("expected", &expected),
        ("text", &text.unwrap_or_default()),
    ];
    fill(words::HYPOTHESIS_LINE.of(language), &values)
}

/// Returns the comparisons of pairs of conditions, as rows of a table.
pub(super) fn comparisons(report: &Report, language: Language) -> Vec<Vec<String>> {
    let row = |compared: &Compared, pair: &Pair| {
        let question = match compared.part.as_str() {
            "" => compared.question.clone(),
            part => format!("{} ({part})", compared.question),
        };
        let [first, second] = pair.groups.map(|at| compared.groups[at].label.clone());
        let number = |value: f64| numbers::number(value, 3, language);
        let effect = pair.effect.found();
        let ends = effect.and_then(|it| it.interval.found());
        let p = |test: &chereme_corpus::study::report::Outcome<_>| {
            let test: Option<&chereme_corpus::study::report::PairTest> = test.found();
            test.map_or_else(|| "–".to_owned(), |it| numbers::p(it.p_holm, language))
        };
        vec![
            compared
                .hypothesis
                .as_ref()
                .map(|it| it.name.clone())
                .unwrap_or_default(),
            question,
            first,
            second,
            effect.map_or_else(String::new, |it| number(it.delta)),
            ends.map_or_else(String::new, |it| {
                format!("[{}; {}]", number(it.low), number(it.high))
            }),
            p(&pair.pooled),
            p(&pair.people),
        ]
    };
    let of_one = |compared: &Compared| {
        let pairs = compared.pairs.iter();
        pairs.map(|pair| row(compared, pair)).collect::<Vec<_>>()
    };
    report.comparisons.iter().flat_map(of_one).collect()
}

/// Returns a sentence for each conclusion; without conclusions, a sentence with the reason.
pub(super) fn conclusions(report: &Report, language: Language) -> Vec<String> {
    let said = report.comparisons.iter().filter_map(|compared| {
        let (stated, conclusion) = compared
            .hypothesis
            .as_ref()
            .zip(compared.conclusion.as_ref())?;
        let verdict = reporting::verdict(conclusion.verdict).of(language);
        let because = numbers::because(conclusion.because, language);
        let values: [(&str, &dyn Display); 3] = [
            ("name", &stated.name),
            ("verdict", &verdict),
            ("because", &because),
        ];
        Some(fill(reporting::VERDICT_LINE.of(language), &values))
    });
    let said: Vec<String> = said.collect();
    match said.is_empty() {
        true => vec![reporting::NO_HYPOTHESIS.of(language).to_owned()],
        false => said,
    }
}

/// Returns a name for files of a study.
pub(super) fn file_stem(name: &str) -> String {
    let allowed = |letter: char| match letter {
        letter if letter.is_alphanumeric() || "-_ ".contains(letter) => letter,
        _ => '-',
    };
    name.trim().chars().map(allowed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_in_tables_and_plans_are_named_in_words() {
        let of = |text: &str| place(text, Language::French);
        assert_eq!(of("table, line 3").as_deref(), Some("tableau, ligne 3"));
        assert_eq!(of("a.csv, line 12").as_deref(), Some("a.csv, ligne 12"));
        assert_eq!(
            of("trial 2 (BOL, higher)").as_deref(),
            Some("essai 2 (BOL, higher)")
        );
        assert_eq!(of("hypotheses/0").as_deref(), Some("Hypothèse 1"));
        assert_eq!(of("a/b/c"), None);
        assert_eq!(of("name"), None);
    }

    #[test]
    fn names_of_files_hold_no_separators() {
        assert_eq!(file_stem(" a/b:c é "), "a-b-c é");
    }
}
