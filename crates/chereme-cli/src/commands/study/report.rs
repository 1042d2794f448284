//! `chereme study report`: prints and writes the results of a study.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::study::report::{Compared, Pair, Report, numbers};
use chereme_corpus::words::{fill, reporting as w};

use crate::args::Cli;
use crate::output::Output;

/// Report on the answers: people, counts, recognition, comparisons, conclusions
///
/// Conclusions follow the hypotheses of the plan. Without hypotheses all pairs of conditions are compared, and nothing is
/// concluded. Tests are two-sided unless the plan expects a trend. Beside the test of all answers stands one of the means
/// of people, which conclusions follow; intervals come from resampled people. FILE.html is a page with figures, which
/// needs no network; a folder gets the page, the JSON and tables. The same plan and answers give the same bytes.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The name of the study
    name: String,
    /// The page (.html), the document (.json), or a folder for both and tables
    #[arg(long, value_name = "FILE|FOLDER")]
    to: Option<PathBuf>,
    /// Replace files that exist already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let report = cli.open(&args.corpus)?.report_study(&args.name)?;
    match &args.to {
        Some(to) => {
            for file in report.write(to, args.force, output.language())? {
                output.filled_line("report: {path}", &[&file.display()])?;
            }
            conclusions(&report, output)?;
        }
        None => {
            people(&report, output)?;
            groups(&report, output)?;
            comparisons(&report, output)?;
            conclusions(&report, output)?;
        }
    }
    output.document(report)
}

fn people(report: &Report, output: &mut Output) -> Result<()> {
    let people = &report.people;
    output.filled_line(
        "{n} participants answered, {m} are analysed",
        &[&people.recruited, &people.analysed],
    )?;
    for it in &people.excluded {
        let reason = numbers::reason(&it.reason, output.language());
        output.filled_line("  left out: {n}: {why}", &[&it.count, &reason])?;
    }
    Ok(())
}

fn groups(report: &Report, output: &mut Output) -> Result<()> {
    let language = output.language();
    let mut rows = Vec::new();
    for question in &report.questions {
        for group in question.conditions.iter().filter(|it| it.answers > 0) {
            let mut row = vec![
                question.name.clone(),
                group.part.clone(),
                group.condition.clone(),
            ];
            row.push(group.answers.to_string());
            let own = group.description.as_ref();
            let number = |value: Option<f64>, decimals| {
                value.map_or_else(String::new, |it| numbers::number(it, decimals, language))
            };
            row.push(number(own.map(|it| it.mean), 3));
            row.push(number(own.and_then(|it| it.sd), 3));
            row.push(number(own.map(|it| it.median), 1));
            let share = group.recognition;
            row.push(share.map_or_else(String::new, |it| numbers::percent(it.share, language)));
            rows.push(row);
        }
    }
    let titles = [
        "question",
        "part",
        "condition",
        "answers",
        "mean",
        "s.d.",
        "median",
        "right",
    ];
    output.table(&titles, &rows)
}

fn comparisons(report: &Report, output: &mut Output) -> Result<()> {
    // Corrected p stand beside the others if a comparison has several pairs, as on the page.
    let corrects = report.comparisons.iter().any(|it| it.pairs.len() > 1);
    let rows = report.comparisons.iter().flat_map(|compared| {
        let row = |pair: &Pair| pair_row(compared, pair, corrects, output);
        compared.pairs.iter().map(row).collect::<Vec<_>>()
    });
    let rows: Vec<Vec<String>> = rows.collect();
    let mut titles = vec![
        "hypothesis",
        "question",
        "first",
        "second",
        "delta",
        "interval",
        "p, all answers",
        "p (Holm), all answers",
        "p, people",
        "p (Holm), people",
    ];
    titles.retain(|title| corrects || !title.contains("Holm"));
    if rows.is_empty() {
        return Ok(());
    }
    output.table(&titles, &rows)
}

fn pair_row(compared: &Compared, pair: &Pair, corrects: bool, output: &Output) -> Vec<String> {
    let language = output.language();
    let hypothesis = compared.hypothesis.as_ref().map(|it| it.name.clone());
    let question = match compared.part.as_str() {
        "" => compared.question.clone(),
        part => format!("{} ({part})", compared.question),
    };
    let mut row = vec![hypothesis.unwrap_or_default(), question];
    row.extend(pair.groups.map(|at| compared.groups[at].label.clone()));
    let effect = pair.effect.found();
    let number = |value: f64| numbers::number(value, 3, language);
    row.push(effect.map_or_else(String::new, |it| number(it.delta)));
    let ends = effect.and_then(|it| it.interval.found());
    row.push(ends.map_or_else(String::new, |it| {
        format!("[{}; {}]", number(it.low), number(it.high))
    }));
    for test in [&pair.pooled, &pair.people] {
        let shown = |p: Option<f64>| p.map_or_else(|| "-".to_owned(), |p| numbers::p(p, language));
        let found = test.found();
        row.push(shown(found.map(|it| it.p)));
        if corrects {
            row.push(shown(found.map(|it| it.p_holm)));
        }
    }
    row
}

fn conclusions(report: &Report, output: &mut Output) -> Result<()> {
    let language = output.language();
    for compared in &report.comparisons {
        if let Some(measure) = &compared.measure {
            let rho = measure.spearman.found();
            let rho = rho.map_or_else(
                || "-".to_owned(),
                |it| numbers::number(it.coefficient, 3, language),
            );
            output.filled_line(
                "{measure} and {question}: rho {rho}",
                &[&measure.measure, &compared.question, &rho],
            )?;
        }
        if let (Some(stated), Some(conclusion)) = (&compared.hypothesis, &compared.conclusion) {
            let verdict = w::verdict(conclusion.verdict).of(language);
            let because = numbers::because(conclusion.because, language);
            let words = fill(
                w::VERDICT_LINE.of(language),
                &[
                    ("name", &stated.name),
                    ("verdict", &verdict),
                    ("because", &because),
                ],
            );
            output.line_as_is(&words)?;
        }
    }
    if report.comparisons.iter().all(|it| it.hypothesis.is_none()) {
        output.line_as_is(w::NO_HYPOTHESIS.of(language))?;
    }
    Ok(())
}
