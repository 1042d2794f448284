//! `chereme suggest`.

use std::path::PathBuf;

use anyhow::Result;

use crate::args::Cli;
use crate::output::Output;

/// List what could be made from a sign
///
/// Signs coded alike but for one component (minimal pairs), a recipe where one leads there, and values
/// that no sign has with the rest of the coding.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The sign: a gloss or token:41
    token: String,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    let found = corpus.suggest(&args.token.parse()?)?;
    let coding: Vec<String> = found
        .coding
        .iter()
        .map(|(field, value)| format!("{field}={value}"))
        .collect();
    output.line(format!(
        "{} (token:{}): {}",
        found.gloss,
        found.token,
        coding.join(" ")
    ))?;
    let rows: Vec<Vec<String>> = found
        .partners
        .iter()
        .map(|it| {
            let change = format!("{}: {} -> {}", it.field, it.from, it.to);
            let recipe = it.recipe.clone().unwrap_or_default();
            vec![
                it.gloss.clone(),
                it.origin.clone(),
                change,
                it.equal.to_string(),
                recipe,
            ]
        })
        .collect();
    if rows.is_empty() {
        output.line("no sign differs from it in one component only")?;
    } else {
        output.table(
            &["partner", "origin", "differs in", "alike in", "recipe"],
            &rows,
        )?;
    }
    for (field, values) in &found.unused {
        output.line(format!(
            "no sign has, with the rest, {field}: {}",
            values.join(", ")
        ))?;
    }
    output.document(found)
}
