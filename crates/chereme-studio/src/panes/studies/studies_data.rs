//! The texts of the pane of studies, and its plans before they are stored, without widgets.

use std::fmt::Display;

use chereme_corpus::study::report::report_words as reporting;
use chereme_corpus::study::report::{AnswerGroup, GroupComparison, GroupPairComparison, StudyReport, report_numbers};
use chereme_corpus::study::study_plan::{
    ExpectedResult, HypothesisComparison, QuestionKind, StudyHypothesis, StudyPlan, StudyQuestion, StudyTrial,
    TrialRole, TrialSelection, text_in,
};
use chereme_corpus::study::{AnswerListRow, StudyOverview};

use crate::words::{InterfaceLanguage, InterfaceText, fill_text_braces, studies_words as words};

/// Returns what stands below the name of a study.
pub(super) fn describe_study_overview(it: &StudyOverview, language: InterfaceLanguage) -> String {
    let plan = &it.plan;
    let values: [(&str, &dyn Display); 5] = [
        ("trials", &plan.trials.len()),
        ("items", &plan.main_items().len()),
        ("conditions", &plan.main_conditions().len()),
        ("people", &it.participants),
        ("answers", &it.answers),
    ];
    fill_text_braces(words::ROW_ABOUT.text_in_language(language), &values)
}

/// Returns the possible answers to a question in short.
pub(super) fn describe_possible_answers(question: &StudyQuestion) -> String {
    match &question.kind {
        QuestionKind::Scale { low, high, .. } => format!("{low}–{high}"),
        QuestionKind::Choice { options } => {
            let names: Vec<&str> = options.iter().map(|option| option.name.as_str()).collect();
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
pub(super) fn trial_rows_from_plan(plan: &StudyPlan, language: InterfaceLanguage) -> Vec<TrialRow> {
    let number = |value: f64| {
        let text = report_numbers::format_report_number(value, 3, language);
        let short = text.trim_end_matches('0').trim_end_matches(['.', ',']);
        short.to_owned()
    };
    let row = |trial: &StudyTrial| {
        let mut about = vec![trial.clip.clone()];
        if trial.role != TrialRole::Main {
            about.push(trial_role_text(trial.role).text_in_language(language).to_owned());
        }
        if !trial.part.is_empty() {
            about.push(fill_text_braces(
                words::OF_PART.text_in_language(language),
                &[("part", &trial.part)],
            ));
        }
        for (name, right) in &trial.right {
            let values: [(&str, &dyn Display); 2] = [("question", name), ("right", right)];
            about.push(fill_text_braces(words::RIGHT_IS.text_in_language(language), &values));
        }
        for (name, value) in &trial.measures {
            let value = number(*value);
            let values: [(&str, &dyn Display); 2] = [("name", name), ("answers", &value)];
            about.push(fill_text_braces(words::ASKED.text_in_language(language), &values));
        }
        TrialRow {
            name: trial_name(&trial.item, &trial.condition, language),
            about: about.join(" · "),
            clip: trial.clip.clone(),
        }
    };
    plan.trials.iter().map(row).collect()
}

/// Returns the name of a trial.
pub(super) fn trial_name(item: &str, condition: &str, language: InterfaceLanguage) -> String {
    let values: [(&str, &dyn Display); 2] = [("item", &item), ("condition", &condition)];
    match condition {
        "" => item.to_owned(),
        _ => fill_text_braces(words::TRIAL.text_in_language(language), &values),
    }
}

/// Returns the words for the use of a trial.
pub(super) fn trial_role_text(role: TrialRole) -> InterfaceText {
    match role {
        TrialRole::Training => words::TRAINING,
        TrialRole::Main => words::MAIN,
        TrialRole::Check => words::CHECK,
    }
}

/// Returns an answer as a row: its name, and what stands below it.
pub(super) fn answer_row_texts(it: &AnswerListRow, language: InterfaceLanguage) -> (String, String) {
    let answer = reporting::answer_text(it, language);
    let trial = trial_name(&it.item, &it.condition, language);
    let values: [(&str, &dyn Display); 4] = [
        ("code", &it.participant),
        ("trial", &trial),
        ("question", &it.question),
        ("answer", &answer),
    ];
    let name = fill_text_braces(words::ANSWER_ROW.text_in_language(language), &values);
    let mut about = Vec::new();
    if let Some(n) = it.n {
        let values: [(&str, &dyn Display); 2] = [("n", &n), ("block", &it.block)];
        about.push(fill_text_braces(
            words::ANSWER_PLACE.text_in_language(language),
            &values,
        ));
    }
    if !it.part.is_empty() {
        about.push(fill_text_braces(
            words::OF_PART.text_in_language(language),
            &[("part", &it.part)],
        ));
    }
    if it.role != TrialRole::Main {
        about.push(trial_role_text(it.role).text_in_language(language).to_owned());
    }
    match it.right {
        Some(true) => about.push(words::RIGHT_ANSWER.text_in_language(language).to_owned()),
        Some(false) => about.push(words::WRONG_ANSWER.text_in_language(language).to_owned()),
        None => {}
    }
    if it.plays > 0 || it.ms > 0 {
        let seconds = report_numbers::format_report_number(f64::from(it.ms) / 1000.0, 1, language);
        let values: [(&str, &dyn Display); 2] = [("plays", &it.plays), ("s", &seconds)];
        about.push(fill_text_braces(
            words::ANSWER_TIMES.text_in_language(language),
            &values,
        ));
    }
    (name, about.join(" · "))
}

/// Returns a place of an error in the words of the window, if it says more than the message: a line, a trial, or a part
/// of a plan.
pub(super) fn describe_error_place(place: &str, language: InterfaceLanguage) -> Option<String> {
    if let Some((file, line)) = place.rsplit_once(", line ") {
        let file = match file {
            "table" => words::TABLE.text_in_language(language),
            "map" => words::MAP.text_in_language(language),
            other => other,
        };
        let values: [(&str, &dyn Display); 2] = [("file", &file), ("line", &line)];
        return Some(fill_text_braces(words::PLACE_LINE.text_in_language(language), &values));
    }
    if let Some(rest) = place.strip_prefix("trial ") {
        return Some(fill_text_braces(
            words::PLACE_TRIAL.text_in_language(language),
            &[("trial", &rest)],
        ));
    }
    let (list, at) = place.split_once('/')?;
    let n = at.parse::<usize>().ok()? + 1;
    let text = match list {
        "trials" => words::PLACE_TRIAL.text_in_language(language),
        "questions" => words::QUESTION.text_in_language(language),
        "hypotheses" => words::HYPOTHESIS.text_in_language(language),
        "profile" => words::PLACE_PROFILE.text_in_language(language),
        _ => return None,
    };
    Some(fill_text_braces(text, &[("n", &n), ("trial", &n)]))
}

/// Returns the answers of a group as a row of a table.
pub(super) fn group_table_row(name: String, group: &AnswerGroup, language: InterfaceLanguage) -> Vec<String> {
    let number = |value: Option<f64>, decimals| {
        value.map_or_else(String::new, |figure| {
            report_numbers::format_report_number(figure, decimals, language)
        })
    };
    let summary = group.description.as_ref();
    let share = group.recognition;
    vec![
        name,
        group.answers.to_string(),
        match group.cannot_say {
            0 => String::new(),
            n => n.to_string(),
        },
        number(summary.map(|it| it.mean), 3),
        number(summary.and_then(|it| it.sd), 3),
        number(summary.map(|it| it.median), 1),
        share.map_or_else(String::new, |share| {
            report_numbers::format_percent(share.share, language)
        }),
    ]
}

/// Returns a sentence for each correlation of answers with a measure.
pub(super) fn correlation_sentences(report: &StudyReport, language: InterfaceLanguage) -> Vec<String> {
    let measured = report.comparisons.iter().filter_map(|comparison| {
        let measure = comparison.measure.as_ref()?;
        let number = |value: f64| report_numbers::format_report_number(value, 3, language);
        let correlation = measure.spearman.found_result();
        let ends = measure.interval.found_result();
        let interval = ends.map_or_else(
            || "–".to_owned(),
            |interval| format!("[{}; {}]", number(interval.low), number(interval.high)),
        );
        let values: [(&str, &dyn Display); 6] = [
            ("measure", &measure.measure),
            ("question", &comparison.question),
            ("n", &measure.points.len()),
            (
                "rho",
                &correlation.map_or_else(|| "–".to_owned(), |it| number(it.coefficient)),
            ),
            (
                "p",
                &correlation.and_then(|it| it.p).map_or_else(
                    || "–".to_owned(),
                    |p_value| report_numbers::format_p_value(p_value, language),
                ),
            ),
            ("interval", &interval),
        ];
        Some(fill_text_braces(words::CORRELATION.text_in_language(language), &values))
    });
    measured.collect()
}

/// Returns a hypothesis as a sentence.
pub(super) fn hypothesis_sentence(it: &StudyHypothesis, language: InterfaceLanguage) -> String {
    let group = |selection: &TrialSelection| {
        let all_names = selection
            .parts
            .iter()
            .chain(&selection.items)
            .chain(&selection.conditions);
        let all: Vec<&str> = all_names.map(String::as_str).collect();
        match all.is_empty() {
            true => words::ALL_TRIALS.text_in_language(language).to_owned(),
            false => all.join(" "),
        }
    };
    let joined = |groups: &[TrialSelection], mark: &str| {
        let groups: Vec<String> = groups.iter().map(group).collect();
        groups.join(mark)
    };
    let expected = match (&it.compares, it.expects) {
        (HypothesisComparison::Between(groups), ExpectedResult::Difference) => joined(groups, " ≠ "),
        (HypothesisComparison::Between(groups), ExpectedResult::SameWithin(bound)) => {
            let bound = report_numbers::format_report_number(bound, 3, language);
            format!("{} (±{bound})", joined(groups, " ≈ "))
        }
        (HypothesisComparison::Trend(groups), _) => joined(groups, " < "),
        (HypothesisComparison::Measure(name), _) => {
            fill_text_braces(words::WITH_MEASURE.text_in_language(language), &[("name", name)])
        }
    };
    let text = text_in(&it.text, language.language_code()).map(|line| format!(" – {line}"));
    let values: [(&str, &dyn Display); 4] = [
        ("name", &it.name),
        ("question", &it.question),
        ("expected", &expected),
        ("text", &text.unwrap_or_default()),
    ];
    fill_text_braces(words::HYPOTHESIS_LINE.text_in_language(language), &values)
}

/// Returns the comparisons of pairs of conditions, as rows of a table.
pub(super) fn comparison_table_rows(report: &StudyReport, language: InterfaceLanguage) -> Vec<Vec<String>> {
    let row = |compared: &GroupComparison, pair: &GroupPairComparison| {
        let question = match compared.part.as_str() {
            "" => compared.question.clone(),
            part => format!("{} ({part})", compared.question),
        };
        let [first, second] = pair.groups.map(|at| compared.groups[at].label.clone());
        let number = |value: f64| report_numbers::format_report_number(value, 3, language);
        let effect = pair.effect.found_result();
        let ends = effect.and_then(|effect| effect.interval.found_result());
        let p = |test: &chereme_corpus::study::report::StatsOutcome<_>| {
            let test: Option<&chereme_corpus::study::report::PairTest> = test.found_result();
            // A test may be undefined, as for groups of one person.
            test.map_or_else(
                || "–".to_owned(),
                |test| report_numbers::format_p_value(test.p_holm, language),
            )
        };
        vec![
            compared
                .hypothesis
                .as_ref()
                .map(|hypothesis| hypothesis.name.clone())
                .unwrap_or_default(),
            question,
            first,
            second,
            effect.map_or_else(String::new, |effect| number(effect.delta)),
            ends.map_or_else(String::new, |interval| {
                format!("[{}; {}]", number(interval.low), number(interval.high))
            }),
            p(&pair.pooled),
            p(&pair.people),
        ]
    };
    let of_one = |compared: &GroupComparison| {
        let pairs = compared.pairs.iter();
        pairs.map(|pair| row(compared, pair)).collect::<Vec<_>>()
    };
    report.comparisons.iter().flat_map(of_one).collect()
}

/// Returns a sentence for each conclusion; without conclusions, a sentence with the reason.
pub(super) fn conclusion_sentences(report: &StudyReport, language: InterfaceLanguage) -> Vec<String> {
    let statements = report.comparisons.iter().filter_map(|compared| {
        let (stated, conclusion) = compared.hypothesis.as_ref().zip(compared.conclusion.as_ref())?;
        let verdict = reporting::verdict_words(conclusion.verdict).text_in_language(language);
        let because = report_numbers::verdict_reason_sentence(conclusion.because, language);
        let values: [(&str, &dyn Display); 3] = [("name", &stated.name), ("verdict", &verdict), ("because", &because)];
        Some(fill_text_braces(
            reporting::VERDICT_LINE.text_in_language(language),
            &values,
        ))
    });
    let sentences: Vec<String> = statements.collect();
    match sentences.is_empty() {
        true => vec![reporting::NO_HYPOTHESIS.text_in_language(language).to_owned()],
        false => sentences,
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
        let of = |text: &str| describe_error_place(text, InterfaceLanguage::French);
        assert_eq!(of("table, line 3").as_deref(), Some("tableau, ligne 3"));
        assert_eq!(of("a.csv, line 12").as_deref(), Some("a.csv, ligne 12"));
        assert_eq!(of("trial 2 (BOL, higher)").as_deref(), Some("essai 2 (BOL, higher)"));
        assert_eq!(of("hypotheses/0").as_deref(), Some("Hypothèse 1"));
        assert_eq!(of("a/b/c"), None);
        assert_eq!(of("name"), None);
    }

    #[test]
    fn names_of_files_hold_no_separators() {
        assert_eq!(file_stem(" a/b:c é "), "a-b-c é");
    }
}
