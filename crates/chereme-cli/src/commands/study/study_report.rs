//! `chereme study report`: prints and writes the results of a study.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::study::report::report_words as w;
use chereme_corpus::study::report::{GroupComparison, GroupPairComparison, StudyReport, report_numbers};
use chereme_corpus::words::fill_text_braces;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Report on the answers: people, counts, recognition, comparisons, conclusions
///
/// Conclusions follow the hypotheses of the plan. Without hypotheses all pairs of conditions are compared, and nothing is
/// concluded. Tests are two-sided unless the plan expects a trend. Beside the test of all answers stands one of the means
/// of people, which conclusions follow; intervals come from resampled people. FILE.html is a page with figures, which
/// needs no network; a folder gets the page, the JSON and tables. The same plan and answers give the same bytes.
#[derive(Debug, clap::Args)]
pub(super) struct StudyReportArgs {
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

pub(super) fn run(cli: &CommandLine, args: &StudyReportArgs, output: &mut CommandOutput) -> Result<()> {
    let report = cli.open_cli_corpus(&args.corpus)?.report_study(&args.name)?;
    match &args.to {
        Some(to) => {
            for file in report.write_study_report(to, args.force, output.output_language())? {
                output.filled_line("report: {path}", &[&file.display()])?;
            }
            print_study_conclusions(&report, output)?;
        }
        None => {
            print_study_people(&report, output)?;
            print_study_groups(&report, output)?;
            print_study_comparisons(&report, output)?;
            print_study_conclusions(&report, output)?;
        }
    }
    output.set_json_document(report)
}

fn print_study_people(report: &StudyReport, output: &mut CommandOutput) -> Result<()> {
    let people = &report.people;
    output.filled_line(
        "{n} participants answered, {m} are analysed",
        &[&people.recruited, &people.analysed],
    )?;
    for it in &people.excluded {
        let reason = report_numbers::exclusion_reason_words(&it.reason, output.output_language());
        output.filled_line("  left out: {n}: {why}", &[&it.count, &reason])?;
    }
    Ok(())
}

fn print_study_groups(report: &StudyReport, output: &mut CommandOutput) -> Result<()> {
    let language = output.output_language();
    let mut rows = Vec::new();
    for question in &report.questions {
        for group in question.conditions.iter().filter(|condition| condition.answers > 0) {
            let mut row = vec![question.name.clone(), group.part.clone(), group.condition.clone()];
            row.push(group.answers.to_string());
            let description = group.description.as_ref();
            let number = |value: Option<f64>, decimals| {
                value.map_or_else(String::new, |figure| {
                    report_numbers::format_report_number(figure, decimals, language)
                })
            };
            row.push(number(description.map(|summary| summary.mean), 3));
            row.push(number(description.and_then(|summary| summary.sd), 3));
            row.push(number(description.map(|summary| summary.median), 1));
            let share = group.recognition;
            row.push(share.map_or_else(String::new, |recognition| {
                report_numbers::format_percent(recognition.share, language)
            }));
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
    output.write_titled_table(&titles, &rows)
}

fn print_study_comparisons(report: &StudyReport, output: &mut CommandOutput) -> Result<()> {
    // Corrected p stand beside the others if a comparison has several pairs, as on the page.
    let corrects = report.comparisons.iter().any(|comparison| comparison.pairs.len() > 1);
    let rows = report.comparisons.iter().flat_map(|compared| {
        let row = |pair: &GroupPairComparison| pair_row(compared, pair, corrects, output);
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
    output.write_titled_table(&titles, &rows)
}

fn pair_row(
    compared: &GroupComparison,
    pair: &GroupPairComparison,
    corrects: bool,
    output: &CommandOutput,
) -> Vec<String> {
    let language = output.output_language();
    let hypothesis = compared.hypothesis.as_ref().map(|hypothesis| hypothesis.name.clone());
    let question = match compared.part.as_str() {
        "" => compared.question.clone(),
        part => format!("{} ({part})", compared.question),
    };
    let mut row = vec![hypothesis.unwrap_or_default(), question];
    row.extend(pair.groups.map(|at| compared.groups[at].label.clone()));
    let effect = pair.effect.found_result();
    let number = |value: f64| report_numbers::format_report_number(value, 3, language);
    row.push(effect.map_or_else(String::new, |size| number(size.delta)));
    let ends = effect.and_then(|size| size.interval.found_result());
    row.push(ends.map_or_else(String::new, |interval| {
        format!("[{}; {}]", number(interval.low), number(interval.high))
    }));
    // Answers of one person are not independent of each other: the test over people says what holds for others.
    for test in [&pair.pooled, &pair.people] {
        let shown = |p: Option<f64>| p.map_or_else(|| "-".to_owned(), |p| report_numbers::format_p_value(p, language));
        let test_result = test.found_result();
        row.push(shown(test_result.map(|outcome| outcome.p)));
        if corrects {
            row.push(shown(test_result.map(|outcome| outcome.p_holm)));
        }
    }
    row
}

fn print_study_conclusions(report: &StudyReport, output: &mut CommandOutput) -> Result<()> {
    let language = output.output_language();
    for compared in &report.comparisons {
        if let Some(measure) = &compared.measure {
            let correlation = measure.spearman.found_result();
            let rho = correlation.map_or_else(
                || "-".to_owned(),
                |value| report_numbers::format_report_number(value.coefficient, 3, language),
            );
            output.filled_line(
                "{measure} and {question}: rho {rho}",
                &[&measure.measure, &compared.question, &rho],
            )?;
        }
        if let (Some(stated), Some(conclusion)) = (&compared.hypothesis, &compared.conclusion) {
            let verdict = w::verdict_words(conclusion.verdict).text_in_language(language);
            let because = report_numbers::verdict_reason_sentence(conclusion.because, language);
            let words = fill_text_braces(
                w::VERDICT_LINE.text_in_language(language),
                &[("name", &stated.name), ("verdict", &verdict), ("because", &because)],
            );
            output.line_as_is(&words)?;
        }
    }
    if report
        .comparisons
        .iter()
        .all(|comparison| comparison.hypothesis.is_none())
    {
        output.line_as_is(w::NO_HYPOTHESIS.text_in_language(language))?;
    }
    Ok(())
}
