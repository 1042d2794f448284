//! The report as files: a page, JSON, and tables.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::{Compared, Outcome, Pair, PairTest, QuestionReport, Report};
use crate::error::{Error, Result};
use crate::picture;
use crate::study::plan::QuestionKind;
use crate::words::Language;

/// A table: its titles and rows.
type Table = (Vec<&'static str>, Vec<Vec<String>>);

impl Report {
    /// Writes the report: to a page if the name ends in `.html`, to JSON if it ends in `.json`, else into a folder with
    /// both and the tables `people.csv`, `groups.csv`, `counts.csv`, `tests.csv` and `confusion.csv`. Returns the files.
    ///
    /// # Errors
    /// Fails if the name has another ending, a file cannot be written, or it exists and `force` is not set.
    pub fn write(&self, to: &Path, force: bool, language: Language) -> Result<Vec<PathBuf>> {
        let ending = to.extension().map(|it| it.to_string_lossy().to_lowercase());
        match ending.as_deref().filter(|_| !to.is_dir()) {
            Some("html" | "htm") => put(to, force, self.page(language).as_bytes())?,
            Some("json") => put(to, force, &self.json()?)?,
            Some(other) => {
                let text = format!("a report cannot be written as .{other}");
                return Err(Error::wrong(text)
                    .at(to.display().to_string())
                    .advise("give a name that ends in .html or .json, or a folder"));
            }
            None => return self.folder(to, force, language),
        }
        Ok(vec![to.to_owned()])
    }

    fn folder(&self, to: &Path, force: bool, language: Language) -> Result<Vec<PathBuf>> {
        fs::create_dir_all(to).map_err(|error| Error::file(to, error))?;
        let mut files = vec![
            ("report.html", self.page(language).into_bytes()),
            ("report.json", self.json()?),
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
            return Err(Error::file(path, std::io::ErrorKind::AlreadyExists.into()));
        }
        let mut written = Vec::with_capacity(files.len());
        for (name, bytes) in files {
            let path = to.join(name);
            put(&path, force, &bytes)?;
            written.push(path);
        }
        Ok(written)
    }

    fn json(&self) -> Result<Vec<u8>> {
        let fault = |error| Error::wrong(format!("the report cannot be written: {error}"));
        let mut bytes = serde_json::to_vec_pretty(self).map_err(fault)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    fn people_table(&self) -> Table {
        let people = &self.people;
        let row = |what: &str, detail: &str, recruited: String, analysed: String| {
            vec![what.to_owned(), detail.to_owned(), recruited, analysed]
        };
        let all = row(
            "all",
            "",
            people.recruited.to_string(),
            people.analysed.to_string(),
        );
        let mut rows = vec![all];
        for it in &people.excluded {
            let reason = serde_json::to_value(&it.reason).map(|it| match it {
                serde_json::Value::String(text) => text,
                other => other.to_string(),
            });
            let reason = reason.unwrap_or_default();
            rows.push(row(
                "excluded",
                &reason,
                it.count.to_string(),
                "0".to_owned(),
            ));
        }
        for table in &people.profile {
            rows.extend(table.rows.iter().map(|it| {
                let option = it.option.as_deref().unwrap_or_default();
                row(
                    &table.question,
                    option,
                    it.recruited.to_string(),
                    it.analysed.to_string(),
                )
            }));
        }
        (vec!["question", "answer", "recruited", "analysed"], rows)
    }

    fn groups_table(&self) -> Table {
        let mut titles = vec![
            "question",
            "part",
            "item",
            "condition",
            "people",
            "answers",
            "cannot_say",
        ];
        titles.extend([
            "mean",
            "sd",
            "median",
            "q1",
            "q3",
            "whisker_low",
            "whisker_high",
        ]);
        titles.extend(["right", "share", "share_low", "share_high"]);
        let mut rows = Vec::new();
        for (question, group) in self.groups() {
            let item = group.item.clone().unwrap_or_default();
            let mut row = vec![
                question.name.clone(),
                group.part.clone(),
                item,
                group.condition.clone(),
            ];
            row.extend([group.people, group.answers, group.cannot_say].map(|it| it.to_string()));
            let own = group.description.as_ref();
            row.extend([
                optional(own.map(|it| it.mean)),
                optional(own.and_then(|it| it.sd)),
                optional(own.map(|it| it.median)),
                optional(own.map(|it| it.q1)),
                optional(own.map(|it| it.q3)),
                optional(own.map(|it| it.whisker_low)),
                optional(own.map(|it| it.whisker_high)),
            ]);
            let share = group.recognition;
            row.extend([
                optional(share.map(|it| it.right as f64)),
                optional(share.map(|it| it.share)),
                optional(share.map(|it| it.interval[0])),
                optional(share.map(|it| it.interval[1])),
            ]);
            rows.push(row);
        }
        (titles, rows)
    }

    fn counts_table(&self) -> Table {
        let mut rows = Vec::new();
        for (question, group) in self.groups() {
            let answers: Vec<String> = match &question.kind {
                QuestionKind::Scale { low, .. } => {
                    let points = group.counts.iter().zip(*low..);
                    points.map(|(_, point)| point.to_string()).collect()
                }
                QuestionKind::Choice { options } => {
                    options.iter().map(|it| it.name.clone()).collect()
                }
            };
            for (answer, count) in answers.into_iter().zip(&group.counts) {
                let item = group.item.clone().unwrap_or_default();
                let mut row = vec![question.name.clone(), group.part.clone(), item];
                row.extend([group.condition.clone(), answer, count.to_string()]);
                rows.push(row);
            }
        }
        (
            vec!["question", "part", "item", "condition", "answer", "count"],
            rows,
        )
    }

    fn groups(&self) -> impl Iterator<Item = (&QuestionReport, &super::Group)> {
        self.questions.iter().flat_map(|question| {
            let groups = question.conditions.iter().chain(&question.items);
            groups.map(move |group| (question, group))
        })
    }

    fn confusion_table(&self) -> Table {
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
        (
            vec!["question", "part", "condition", "right", "chosen", "count"],
            rows,
        )
    }

    fn tests_table(&self) -> Table {
        let mut titles = vec!["hypothesis", "question", "part", "side", "first", "second"];
        titles.extend([
            "pooled_test",
            "pooled_n_first",
            "pooled_n_second",
            "pooled_statistic",
        ]);
        titles.extend(["pooled_method", "pooled_p", "pooled_p_holm"]);
        titles.extend([
            "people_test",
            "people_n_first",
            "people_n_second",
            "people_statistic",
        ]);
        titles.extend([
            "people_method",
            "people_p",
            "people_p_holm",
            "mean_difference",
        ]);
        titles.extend([
            "delta",
            "a12",
            "shift",
            "delta_low",
            "delta_high",
            "interval_level",
        ]);
        titles.extend(["bound", "same_low", "same_high", "same", "verdict"]);
        let mut rows = Vec::new();
        for compared in &self.comparisons {
            rows.extend(compared.pairs.iter().map(|pair| pair_row(compared, pair)));
            if let Some(measure) = &compared.measure {
                let mut row = start(compared, &measure.measure, "");
                let spearman = measure.spearman.found();
                row.extend([
                    "spearman".to_owned(),
                    optional(spearman.map(|it| it.n as f64)),
                    String::new(),
                ]);
                row.push(optional(spearman.map(|it| it.coefficient)));
                row.extend([String::new(), optional(spearman.and_then(|it| it.p))]);
                row.resize(titles.len() - 1, String::new());
                row.push(verdict(compared));
                rows.push(row);
            }
        }
        (titles, rows)
    }
}

fn start(compared: &Compared, first: &str, second: &str) -> Vec<String> {
    let name = compared.hypothesis.as_ref().map(|it| it.name.clone());
    vec![
        name.unwrap_or_default(),
        compared.question.clone(),
        compared.part.clone(),
        word(&compared.side),
        first.to_owned(),
        second.to_owned(),
    ]
}

fn pair_row(compared: &Compared, pair: &Pair) -> Vec<String> {
    let [first, second] = pair.groups.map(|at| compared.groups[at].label.as_str());
    let mut row = start(compared, first, second);
    row.extend(test_cells(&pair.pooled));
    row.extend(test_cells(&pair.people));
    row.push(optional(pair.mean_difference));
    let effect = pair.effect.found();
    let ends = effect.and_then(|it| it.interval.found());
    row.extend([
        optional(effect.map(|it| it.delta)),
        optional(effect.map(|it| it.a12)),
        optional(effect.and_then(|it| it.shift)),
        optional(ends.map(|it| it.low)),
        optional(ends.map(|it| it.high)),
        optional(ends.map(|it| it.level)),
    ]);
    let same = pair.sameness.found();
    row.extend([
        optional(same.map(|it| it.bound)),
        optional(same.map(|it| it.ends.low)),
        optional(same.map(|it| it.ends.high)),
        same.map_or_else(|| why(&pair.sameness), |it| word(&it.result)),
        verdict(compared),
    ]);
    row
}

fn verdict(compared: &Compared) -> String {
    let conclusion = compared.conclusion.as_ref();
    conclusion.map_or_else(String::new, |it| word(&it.verdict))
}

/// Returns the cells of a test; without one, the reason stands at its name.
fn test_cells(test: &Outcome<PairTest>) -> Vec<String> {
    let Outcome::Found(test) = test else {
        let mut row = vec![String::new(); 7];
        row[0] = why(test);
        return row;
    };
    vec![
        word(&test.test),
        test.n[0].to_string(),
        test.n[1].to_string(),
        optional(test.statistic),
        word(&test.method),
        exact(test.p),
        exact(test.p_holm),
    ]
}

fn why<T>(outcome: &Outcome<T>) -> String {
    match outcome {
        Outcome::Found(_) => String::new(),
        Outcome::Nothing { why } => word(why),
    }
}

/// Returns the word that stands for a value in JSON.
fn word(value: &impl Serialize) -> String {
    let value = serde_json::to_value(value).unwrap_or_default();
    value.as_str().unwrap_or_default().to_owned()
}

fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, exact)
}

/// Returns a number with all its digits; a small one with an exponent.
fn exact(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-6 {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

fn csv_of((titles, rows): &Table) -> Result<Vec<u8>> {
    let fault = |error: csv::Error| Error::wrong(format!("a table cannot be written: {error}"));
    let mut out = csv::Writer::from_writer(Vec::new());
    out.write_record(titles).map_err(fault)?;
    for row in rows {
        out.write_record(row).map_err(fault)?;
    }
    out.into_inner()
        .map_err(|error| Error::wrong(format!("a table cannot be written: {error}")))
}

fn put(to: &Path, force: bool, bytes: &[u8]) -> Result<()> {
    picture::write(to, force, |out| {
        out.write_all(bytes).map_err(|error| Error::file(to, error))
    })?;
    Ok(())
}
