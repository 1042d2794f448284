//! The texts of the pane of studies, and its plans before they are stored, without widgets.

use std::fmt::Display;

use chereme_corpus::study::plan::{Design, Order, Plan, Question, QuestionKind};
use chereme_corpus::study::report::{Compared, Group, Pair, Report, numbers};
use chereme_corpus::study::{StudyOverview, StudyRequest, words as split};
use chereme_corpus::words::reporting;

use crate::words::{Language, fill, studies as words};

/// A plan that is being written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) title: String,
    pub(super) items: String,
    /// The names and recipes of conditions; `{}` in a recipe stands for the item.
    pub(super) conditions: Vec<[String; 2]>,
    pub(super) questions: Vec<String>,
    pub(super) scale: i64,
    pub(super) order: Order,
    pub(super) between: bool,
    pub(super) blocks: u32,
}

impl Default for Draft {
    fn default() -> Self {
        Self {
            name: String::new(),
            title: String::new(),
            items: String::new(),
            conditions: vec![["captured".to_owned(), "{}".to_owned()]],
            questions: vec!["realism".to_owned()],
            scale: 5,
            order: Order::default(),
            between: false,
            blocks: 1,
        }
    }
}

impl Draft {
    /// Returns the study in the words of the library.
    pub(super) fn request(&self) -> StudyRequest {
        let filled = |text: &String| !text.trim().is_empty();
        let conditions = self.conditions.iter().filter(|it| it.iter().all(filled));
        let questions = self.questions.iter().filter(|it| filled(it));
        StudyRequest {
            name: self.name.trim().to_owned(),
            title: filled(&self.title).then(|| self.title.trim().to_owned()),
            items: split(&self.items),
            conditions: conditions
                .map(|[name, recipe]| (name.trim().to_owned(), recipe.trim().to_owned()))
                .collect(),
            trials: None,
            questions: questions.map(|it| it.trim().to_owned()).collect(),
            scale: self.scale,
            design: Design {
                order: self.order,
                blocks: self.blocks,
                between: self.between,
                ..Design::default()
            },
        }
    }

    /// Adds an item, unless it is there.
    pub(super) fn add_item(&mut self, item: &str) {
        if split(&self.items).iter().any(|it| it == item) {
            return;
        }
        let quoted = match item.contains(char::is_whitespace) {
            true => format!("\"{item}\""),
            false => item.to_owned(),
        };
        let before = self.items.trim_end();
        self.items = match before.is_empty() {
            true => quoted,
            false => format!("{before} {quoted}"),
        };
    }
}

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

/// A trial as a row: its place in the plan, its name, and its clip.
pub(super) fn trials(plan: &Plan, language: Language) -> Vec<(String, String)> {
    let row = |it: &chereme_corpus::study::plan::Trial| {
        let values: [(&str, &dyn Display); 2] = [("item", &it.item), ("condition", &it.condition)];
        (fill(words::TRIAL.of(language), &values), it.clip.clone())
    };
    plan.trials.iter().map(row).collect()
}

/// Returns the answers to each question in each condition, as rows of a table.
pub(super) fn groups(report: &Report, language: Language) -> Vec<Vec<String>> {
    let row = |name: &str, group: &Group| {
        let number = |value: Option<f64>, decimals| {
            value.map_or_else(String::new, |it| numbers::number(it, decimals, language))
        };
        let own = group.description.as_ref();
        let share = group.recognition;
        vec![
            name.to_owned(),
            group.part.clone(),
            group.condition.clone(),
            group.answers.to_string(),
            number(own.map(|it| it.mean), 3),
            number(own.and_then(|it| it.sd), 3),
            number(own.map(|it| it.median), 1),
            share.map_or_else(String::new, |it| numbers::percent(it.share, language)),
        ]
    };
    let of_question = |question: &chereme_corpus::study::report::QuestionReport| {
        let answered = question.conditions.iter().filter(|it| it.answers > 0);
        answered
            .map(|it| row(&question.name, it))
            .collect::<Vec<_>>()
    };
    report.questions.iter().flat_map(of_question).collect()
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
    fn a_draft_makes_items_times_conditions() {
        let mut draft = Draft {
            name: " places ".to_owned(),
            ..Draft::default()
        };
        for item in ["BOL", "CHAT", "BOL", "WEEK END"] {
            draft.add_item(item);
        }
        assert_eq!(draft.items, "BOL CHAT \"WEEK END\"");
        draft
            .conditions
            .push(["higher".to_owned(), "{} | place both by up 10cm".to_owned()]);
        // A condition without a recipe is not finished.
        draft.conditions.push(["lower".to_owned(), String::new()]);
        draft.questions.push("gloss=items".to_owned());
        let plan = draft.request().plan().expect("a plan");
        assert_eq!((plan.name.as_str(), plan.trials.len()), ("places", 6));
        assert_eq!(plan.questions.len(), 2);
        let rows = trials(&plan, Language::English);
        assert_eq!(
            rows[3],
            (
                "CHAT, higher".to_owned(),
                "CHAT | place both by up 10cm".to_owned()
            )
        );
        assert_eq!(rows[4].1, "\"WEEK END\"");
    }

    #[test]
    fn names_of_files_hold_no_separators() {
        assert_eq!(file_stem(" a/b:c é "), "a-b-c é");
    }
}
