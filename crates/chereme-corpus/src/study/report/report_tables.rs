//! The report as files: a page, JSON, and tables.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::{GroupComparison, GroupPairComparison, PairTest, QuestionReport, StatsOutcome, StudyReport};
use crate::atomic_write;
use crate::error::{CorpusError, CorpusResult};
use crate::study::study_plan::QuestionKind;
use crate::words::InterfaceLanguage;

/// A table: its titles and rows.
type ReportTable = (Vec<&'static str>, Vec<Vec<String>>);

impl StudyReport {
    /// Writes the report: to a page if the name ends in `.html`, to JSON if it ends in `.json`, else into a folder with
    /// both and the tables `people.csv`, `groups.csv`, `counts.csv`, `tests.csv` and `confusion.csv`. Returns the files.
    ///
    /// # Errors
    /// Fails if the name has another ending, a file cannot be written, or it exists and `force` is not set.
    pub fn write_study_report(
        &self,
        to: &Path,
        force: bool,
        language: InterfaceLanguage,
    ) -> CorpusResult<Vec<PathBuf>> {
        let ending = to
            .extension()
            .map(|extension| extension.to_string_lossy().to_lowercase());
        match ending.as_deref().filter(|_| !to.is_dir()) {
            Some("html" | "htm") => put_report_file(to, force, self.report_page_html(language).as_bytes())?,
            Some("json") => put_report_file(to, force, &self.report_json_bytes()?)?,
            Some(other) => {
                let text = format!("a report cannot be written as .{other}");
                return Err(CorpusError::from_wrong_message(text)
                    .with_error_place(to.display().to_string())
                    .with_advice("give a name that ends in .html or .json, or a folder"));
            }
            None => return self.write_report_folder(to, force, language),
        }
        Ok(vec![to.to_owned()])
    }

    fn write_report_folder(&self, to: &Path, force: bool, language: InterfaceLanguage) -> CorpusResult<Vec<PathBuf>> {
        fs::create_dir_all(to).map_err(|error| CorpusError::from_file_failure(to, error))?;
        let mut files = vec![
            ("report.html", self.report_page_html(language).into_bytes()),
            ("report.json", self.report_json_bytes()?),
        ];
        let tables = [
            ("people.csv", self.people_table()),
            ("groups.csv", self.groups_table()),
            ("counts.csv", self.counts_table()),
            ("tests.csv", self.tests_table()),
            ("confusion.csv", self.confusion_table()),
        ];
        for (name, table) in tables {
            files.push((name, csv_of(&table)?));
        }
        // Nothing is written if a file is there already.
        let mut there = files.iter().map(|(name, _)| to.join(name));
        if let Some(path) = there.find(|path| !force && path.exists()) {
            return Err(CorpusError::from_existing_file(path));
        }
        let mut written = Vec::with_capacity(files.len());
        for (name, bytes) in files {
            let path = to.join(name);
            put_report_file(&path, force, &bytes)?;
            written.push(path);
        }
        Ok(written)
    }

    fn report_json_bytes(&self) -> CorpusResult<Vec<u8>> {
        let fault = |error| CorpusError::from_wrong_message(format!("the report cannot be written: {error}"));
        let mut bytes = serde_json::to_vec_pretty(self).map_err(fault)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    fn people_table(&self) -> ReportTable {
        let people = &self.people;
        let row = |what: &str, detail: &str, recruited: String, analysed: String| {
            vec![what.to_owned(), detail.to_owned(), recruited, analysed]
        };
        let all = row("all", "", people.recruited.to_string(), people.analysed.to_string());
        let mut rows = vec![all];
        for it in &people.excluded {
            let reason_result = serde_json::to_value(&it.reason).map(|value| match value {
                serde_json::Value::String(text) => text,
                other => other.to_string(),
            });
            let reason = reason_result.unwrap_or_default();
            rows.push(row("excluded", &reason, it.count.to_string(), "0".to_owned()));
        }
        for table in &people.profile {
            rows.extend(table.rows.iter().map(|profile_row| {
                let option = profile_row.option.as_deref().unwrap_or_default();
                row(
                    &table.question,
                    option,
                    profile_row.recruited.to_string(),
                    profile_row.analysed.to_string(),
                )
            }));
        }
        (vec!["question", "answer", "recruited", "analysed"], rows)
    }

    fn groups_table(&self) -> ReportTable {
        let mut titles = vec![
            "question",
            "part",
            "item",
            "condition",
            "people",
            "answers",
            "cannot_say",
        ];
        titles.extend(["mean", "sd", "median", "q1", "q3", "whisker_low", "whisker_high"]);
        titles.extend(["right", "share", "share_low", "share_high"]);
        let mut rows = Vec::new();
        for (question, group) in self.report_answer_groups() {
            let item = group.item.clone().unwrap_or_default();
            let mut row = vec![question.name.clone(), group.part.clone(), item, group.condition.clone()];
            row.extend([group.people, group.answers, group.cannot_say].map(|number| number.to_string()));
            let description = group.description.as_ref();
            row.extend([
                optional_exact_number(description.map(|summary| summary.mean)),
                optional_exact_number(description.and_then(|summary| summary.sd)),
                optional_exact_number(description.map(|summary| summary.median)),
                optional_exact_number(description.map(|summary| summary.q1)),
                optional_exact_number(description.map(|summary| summary.q3)),
                optional_exact_number(description.map(|summary| summary.whisker_low)),
                optional_exact_number(description.map(|summary| summary.whisker_high)),
            ]);
            let share = group.recognition;
            row.extend([
                optional_exact_number(share.map(|recognition| recognition.right as f64)),
                optional_exact_number(share.map(|recognition| recognition.share)),
                optional_exact_number(share.map(|recognition| recognition.interval[0])),
                optional_exact_number(share.map(|recognition| recognition.interval[1])),
            ]);
            rows.push(row);
        }
        (titles, rows)
    }

    fn counts_table(&self) -> ReportTable {
        let mut rows = Vec::new();
        for (question, group) in self.report_answer_groups() {
            let answers: Vec<String> = match &question.kind {
                QuestionKind::Scale { low, .. } => {
                    let points = group.counts.iter().zip(*low..);
                    points.map(|(_, point)| point.to_string()).collect()
                }
                QuestionKind::Choice { options } => options.iter().map(|option| option.name.clone()).collect(),
            };
            for (answer, count) in answers.into_iter().zip(&group.counts) {
                let item = group.item.clone().unwrap_or_default();
                let mut row = vec![question.name.clone(), group.part.clone(), item];
                row.extend([group.condition.clone(), answer, count.to_string()]);
                rows.push(row);
            }
        }
        (vec!["question", "part", "item", "condition", "answer", "count"], rows)
    }

    fn report_answer_groups(&self) -> impl Iterator<Item = (&QuestionReport, &super::AnswerGroup)> {
        self.questions.iter().flat_map(|question| {
            let groups = question.conditions.iter().chain(&question.items);
            groups.map(move |group| (question, group))
        })
    }

    fn confusion_table(&self) -> ReportTable {
        let mut rows = Vec::new();
        for question in &self.questions {
            for table in &question.confusions {
                for (right, counts) in table.rows.iter().zip(&table.counts) {
                    for (chosen, count) in table.columns.iter().zip(counts) {
                        let condition = table.condition.clone().unwrap_or_default();
                        let mut row = vec![question.name.clone(), table.part.clone(), condition];
                        row.extend([right.clone(), chosen.clone(), count.to_string()]);
                        rows.push(row);
                    }
                }
            }
        }
        (vec!["question", "part", "condition", "right", "chosen", "count"], rows)
    }

    fn tests_table(&self) -> ReportTable {
        let mut titles = vec!["hypothesis", "question", "part", "side", "first", "second"];
        titles.extend(["pooled_test", "pooled_n_first", "pooled_n_second", "pooled_statistic"]);
        titles.extend(["pooled_method", "pooled_p", "pooled_p_holm"]);
        titles.extend(["people_test", "people_n_first", "people_n_second", "people_statistic"]);
        titles.extend(["people_method", "people_p", "people_p_holm", "mean_difference"]);
        titles.extend(["delta", "a12", "shift", "delta_low", "delta_high", "interval_level"]);
        titles.extend(["bound", "same_low", "same_high", "same", "verdict"]);
        let mut rows = Vec::new();
        for compared in &self.comparisons {
            rows.extend(compared.pairs.iter().map(|pair| pair_row(compared, pair)));
            if let Some(measure) = &compared.measure {
                let mut row = comparison_start_cells(compared, &measure.measure, "");
                let spearman = measure.spearman.found_result();
                row.extend([
                    "spearman".to_owned(),
                    optional_exact_number(spearman.map(|correlation| correlation.n as f64)),
                    String::new(),
                ]);
                row.push(optional_exact_number(
                    spearman.map(|correlation| correlation.coefficient),
                ));
                row.extend([
                    String::new(),
                    optional_exact_number(spearman.and_then(|correlation| correlation.p)),
                ]);
                row.resize(titles.len() - 1, String::new());
                row.push(verdict_cell(compared));
                rows.push(row);
            }
        }
        (titles, rows)
    }
}

fn comparison_start_cells(compared: &GroupComparison, first: &str, second: &str) -> Vec<String> {
    let name = compared.hypothesis.as_ref().map(|hypothesis| hypothesis.name.clone());
    vec![
        name.unwrap_or_default(),
        compared.question.clone(),
        compared.part.clone(),
        json_word(&compared.side),
        first.to_owned(),
        second.to_owned(),
    ]
}

fn pair_row(compared: &GroupComparison, pair: &GroupPairComparison) -> Vec<String> {
    let [first, second] = pair.groups.map(|at| compared.groups[at].label.as_str());
    let mut row = comparison_start_cells(compared, first, second);
    row.extend(test_cells(&pair.pooled));
    row.extend(test_cells(&pair.people));
    row.push(optional_exact_number(pair.mean_difference));
    let effect = pair.effect.found_result();
    let ends = effect.and_then(|estimate| estimate.interval.found_result());
    row.extend([
        optional_exact_number(effect.map(|estimate| estimate.delta)),
        optional_exact_number(effect.map(|estimate| estimate.a12)),
        optional_exact_number(effect.and_then(|estimate| estimate.shift)),
        optional_exact_number(ends.map(|interval| interval.low)),
        optional_exact_number(ends.map(|interval| interval.high)),
        optional_exact_number(ends.map(|interval| interval.level)),
    ]);
    let same = pair.sameness.found_result();
    row.extend([
        optional_exact_number(same.map(|equivalence| equivalence.bound)),
        optional_exact_number(same.map(|equivalence| equivalence.ends.low)),
        optional_exact_number(same.map(|equivalence| equivalence.ends.high)),
        same.map_or_else(
            || missing_reason_cell(&pair.sameness),
            |equivalence| json_word(&equivalence.result),
        ),
        verdict_cell(compared),
    ]);
    row
}

fn verdict_cell(compared: &GroupComparison) -> String {
    let conclusion = compared.conclusion.as_ref();
    conclusion.map_or_else(String::new, |conclusion| json_word(&conclusion.verdict))
}

/// Returns the cells of a test; without one, the reason stands at its name.
fn test_cells(test: &StatsOutcome<PairTest>) -> Vec<String> {
    let StatsOutcome::Found(test) = test else {
        let mut row = vec![String::new(); 7];
        row[0] = missing_reason_cell(test);
        return row;
    };
    vec![
        json_word(&test.test),
        test.n[0].to_string(),
        test.n[1].to_string(),
        optional_exact_number(test.statistic),
        json_word(&test.method),
        exact_number_text(test.p),
        exact_number_text(test.p_holm),
    ]
}

fn missing_reason_cell<T>(outcome: &StatsOutcome<T>) -> String {
    match outcome {
        StatsOutcome::Found(_) => String::new(),
        StatsOutcome::Nothing { why } => json_word(why),
    }
}

/// Returns the word that stands for a value in JSON.
fn json_word(value: &impl Serialize) -> String {
    let value = serde_json::to_value(value).unwrap_or_default();
    value.as_str().unwrap_or_default().to_owned()
}

fn optional_exact_number(value: Option<f64>) -> String {
    value.map_or_else(String::new, exact_number_text)
}

/// Returns a number with all its digits; a small one with an exponent.
fn exact_number_text(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-6 {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

fn csv_of((titles, rows): &ReportTable) -> CorpusResult<Vec<u8>> {
    let fault = |error: csv::Error| CorpusError::from_wrong_message(format!("a table cannot be written: {error}"));
    let mut out = csv::Writer::from_writer(Vec::new());
    out.write_record(titles).map_err(fault)?;
    for row in rows {
        out.write_record(row).map_err(fault)?;
    }
    out.into_inner()
        .map_err(|error| CorpusError::from_wrong_message(format!("a table cannot be written: {error}")))
}

fn put_report_file(to: &Path, force: bool, bytes: &[u8]) -> CorpusResult<()> {
    atomic_write::write_atomically(to, force, |out| {
        out.write_all(bytes)
            .map_err(|error| CorpusError::from_file_failure(to, error))
    })?;
    Ok(())
}
