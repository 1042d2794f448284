//! `chereme undo`, `redo` and `log`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{OperationKind, OperationRow};
use serde_json::json;

use crate::args::Cli;
use crate::output::Output;

/// Take back the newest operation that stands
#[derive(Debug, clap::Args)]
pub(crate) struct UndoArgs {
    /// The corpus
    corpus: PathBuf,
    /// How many operations to take back
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = at_least_one)]
    times: usize,
}

/// Do again what was undone last
#[derive(Debug, clap::Args)]
pub(crate) struct RedoArgs {
    /// The corpus
    corpus: PathBuf,
    /// How many operations to do again
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = at_least_one)]
    times: usize,
}

/// List what was done, newest first
#[derive(Debug, clap::Args)]
pub(crate) struct LogArgs {
    /// The corpus
    corpus: PathBuf,
    /// How many operations to list at most
    #[arg(long, default_value_t = 50, value_name = "N")]
    limit: usize,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    let times = text.parse().ok().filter(|times| *times > 0);
    times.ok_or_else(|| "write how many operations, 1 or more".to_owned())
}

pub(super) fn undo(cli: &Cli, args: &UndoArgs, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    walk(output, args.times, "undone", || Ok(corpus.undo()?))
}

pub(super) fn redo(cli: &Cli, args: &RedoArgs, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    walk(output, args.times, "done again", || Ok(corpus.redo()?))
}

fn walk(
    output: &mut Output,
    times: usize,
    word: &str,
    mut step: impl FnMut() -> Result<OperationRow>,
) -> Result<()> {
    let mut operations = Vec::new();
    for _ in 0..times.max(1) {
        let operation = step()?;
        let target = operation.target.unwrap_or(operation.id);
        let (name, summary) = (&operation.name, &operation.summary);
        output.line(format!("{word}: operation {target}, {name}: {summary}"))?;
        operations.push(operation);
    }
    output.document(json!({ "operations": operations }))
}

pub(super) fn log(cli: &Cli, args: &LogArgs, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    let rows = corpus.log(args.limit)?;
    let table: Vec<Vec<String>> = rows.iter().map(cells).collect();
    output.table(&["id", "when", "who", "what", "changes", ""], &table)?;
    output.document(json!({ "total": rows.len(), "rows": rows }))
}

fn cells(row: &OperationRow) -> Vec<String> {
    let about = |word: &str| format!("{word} of {}: ", row.target.unwrap_or_default());
    let kind = match row.kind {
        OperationKind::Do => String::new(),
        OperationKind::Undo => about("undo"),
        OperationKind::Redo => about("redo"),
    };
    vec![
        row.id.to_string(),
        row.at.clone(),
        row.author.clone(),
        format!("{kind}{}: {}", row.name, row.summary),
        row.changes.to_string(),
        if row.stands {
            String::new()
        } else {
            "undone".to_owned()
        },
    ]
}
