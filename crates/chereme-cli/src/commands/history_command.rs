//! `chereme undo`, `redo` and `log`: the history of a corpus, backwards, forwards and as a list.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::words::history_words as words;
use chereme_corpus::words::{InterfaceLanguage, InterfaceText, fill_text_braces};
use chereme_corpus::{Corpus, OperationDetail, OperationKind, OperationRow};
use serde_json::json;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Undo the last change
///
/// Every change can be undone, also after a restart. If --times is greater than the number of operations, all of them
/// are undone, and the command reports how many; it fails only if there was nothing to undo.
#[derive(Debug, clap::Args)]
pub(crate) struct UndoArgs {
    /// The corpus
    corpus: PathBuf,
    /// How many operations to undo
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = at_least_one)]
    times: usize,
}

/// Redo the change that was undone last
#[derive(Debug, clap::Args)]
pub(crate) struct RedoArgs {
    /// The corpus
    corpus: PathBuf,
    /// How many operations to redo
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = at_least_one)]
    times: usize,
}

/// List the operations, newest first, or show the changes of one of them
///
/// For one operation, or with --changes for each of them, lists every annotation, tier, recording, sign and value that
/// was added, changed or removed: its name, and each field before and after.
#[derive(Debug, clap::Args)]
pub(crate) struct LogArgs {
    /// The corpus
    corpus: PathBuf,
    /// The operation to show in detail, by its number in the list
    #[arg(value_parser = parse_operation_number)]
    operation: Option<i64>,
    /// Show the changes below each operation
    #[arg(long)]
    changes: bool,
    /// List at most N operations, and of each at most N changes
    #[arg(long, default_value_t = 50, value_name = "N")]
    limit: usize,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    let times = text.parse().ok().filter(|times| *times > 0);
    times.ok_or_else(|| "write how many operations, 1 or more".to_owned())
}

fn parse_operation_number(text: &str) -> Result<i64, String> {
    let number = text.trim_start_matches("operation:").parse();
    number.map_err(|_| "write the number of an operation, such as 12".to_owned())
}

pub(super) fn undo_operations(cli: &CommandLine, args: &UndoArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    walk_operations(output, args.times, true, &mut corpus)
}

pub(super) fn redo_operations(cli: &CommandLine, args: &RedoArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    walk_operations(output, args.times, false, &mut corpus)
}

fn walk_operations(output: &mut CommandOutput, times: usize, back: bool, corpus: &mut Corpus) -> Result<()> {
    let left = |corpus: &Corpus| -> Result<usize> {
        let (undo, redo) = corpus.count_undo_steps()?;
        Ok(if back { undo } else { redo })
    };
    let mut operations = Vec::new();
    let language = output.output_language();
    while operations.len() < times.max(1) {
        // The first step is tried in any case, so that the library says why nothing can be undone.
        if !operations.is_empty() && left(corpus)? == 0 {
            let text = if back { words::ALL_UNDONE } else { words::ALL_REDONE };
            let count = output.format_counted_noun(operations.len() as u64, "operations");
            output.text_line(text, &[("count", &count), ("asked", &times)])?;
            break;
        }
        let operation = if back {
            corpus.undo_operation()?
        } else {
            corpus.redo_operation()?
        };
        // People count the operations that they did, not the ones that undo them.
        let target = operation.target.unwrap_or(operation.id);
        let text = if back { words::UNDID } else { words::REDID };
        let what = describe_operation(&operation, language);
        output.text_line(text, &[("id", &target), ("what", &what)])?;
        operations.push(operation);
    }
    let left = left(corpus)?;
    output.set_json_document(json!({ "operations": operations, "left": left }))
}

/// Describes an operation: by its stored name and summary in English, as a sentence in other languages.
fn describe_operation(row: &OperationRow, language: InterfaceLanguage) -> String {
    match language {
        InterfaceLanguage::English => format!("{}: {}", row.name, row.summary),
        InterfaceLanguage::French | InterfaceLanguage::Other(_) => words::operation_sentence(&row.effect, language),
    }
}

pub(super) fn print_operation_log(cli: &CommandLine, args: &LogArgs, output: &mut CommandOutput) -> Result<()> {
    let corpus = cli.open_cli_corpus(&args.corpus)?;
    if let Some(id) = args.operation {
        let detail = corpus.operation_detail(id, args.limit)?;
        let row = &detail.operation;
        let what = describe_operation(row, output.output_language());
        let line = format!("{} {} {}: {what}", row.id, row.at, row.author);
        output.line_as_is(&line)?;
        print_changes(&detail, output)?;
        return output.set_json_document(detail);
    }
    let rows = corpus.operation_log(args.limit)?;
    if args.changes {
        let mut details = Vec::new();
        for row in &rows {
            let detail = corpus.operation_detail(row.id, args.limit)?;
            output.line_as_is(operation_log_cells(row, output).join("  ").trim_end())?;
            print_changes(&detail, output)?;
            details.push(detail);
        }
        return output.set_json_document(json!({ "total": rows.len(), "rows": rows, "details": details }));
    }
    let table: Vec<Vec<String>> = rows.iter().map(|row| operation_log_cells(row, output)).collect();
    let title_words = [words::NUMBER, words::WHEN, words::WHO, words::WHAT, words::CHANGES];
    let mut titles = title_words.map(|text| output.output_text(text)).to_vec();
    // The last column says whether the operation was undone, and has no name.
    titles.push("");
    output.write_titled_table(&titles, &table)?;
    output.set_json_document(json!({ "total": rows.len(), "rows": rows }))
}

fn print_changes(detail: &OperationDetail, output: &mut CommandOutput) -> Result<()> {
    for change in &detail.changes {
        let sentence = chereme_corpus::change_sentence(change, output.output_language());
        output.line_as_is(&format!("  {sentence}"))?;
    }
    let more = detail.total - detail.changes.len() as u64;
    if more > 0 {
        output.filled_line(
            "  and {n}; --limit shows more",
            &[&output.format_counted_noun(more, "changes")],
        )?;
    }
    if detail.total == 0 {
        let tables: Vec<String> = detail
            .tables
            .iter()
            .map(|(table, count)| format!("{count} of {}", table.replace('_', " ")))
            .collect();
        output.filled_line("  rows: {names}", &[&tables.join(", ")])?;
    }
    Ok(())
}

fn operation_log_cells(row: &OperationRow, output: &CommandOutput) -> Vec<String> {
    let about = |text: InterfaceText| {
        let target = row.target.unwrap_or_default();
        fill_text_braces(output.output_text(text), &[("id", &target)])
    };
    let kind = match row.kind {
        OperationKind::Do => String::new(),
        OperationKind::Undo => about(words::UNDO_OF),
        OperationKind::Redo => about(words::REDO_OF),
    };
    vec![
        row.id.to_string(),
        row.at.clone(),
        row.author.clone(),
        format!("{kind}{}", describe_operation(row, output.output_language())),
        row.changes.to_string(),
        if row.stands {
            String::new()
        } else {
            output.output_text(words::UNDONE).to_owned()
        },
    ]
}
