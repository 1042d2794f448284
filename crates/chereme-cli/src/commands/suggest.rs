//! `chereme suggest`: suggests new signs that could be composed from a sign.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::Partner;

use crate::args::Cli;
use crate::output::Output;

/// Suggest new signs that could be composed from a sign
///
/// Lists the signs that differ from it in exactly one field (minimal pairs), each with a recipe if one generates it
/// from the sign, and the values that no sign combines with the rest of its coding.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The sign: a gloss or token:41
    token: String,
}

/// The number of possible partners that are shown.
const MOST_POSSIBLE: usize = 20;

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
    let rows = |partners: &[Partner]| -> Vec<Vec<String>> {
        let row = |it: &Partner| {
            let change = format!("{}: {} -> {}", it.field, it.from, it.to);
            let recipe = it.recipe.clone().unwrap_or_default();
            vec![
                it.gloss.clone(),
                it.origin.name().to_owned(),
                change,
                it.equal.to_string(),
                recipe,
            ]
        };
        partners.iter().map(row).collect()
    };
    const TITLES: [&str; 5] = ["partner", "origin", "differs in", "alike in", "recipe"];
    let certain = rows(&found.partners);
    if certain.is_empty() {
        output.line("no sign differs from it in one component only")?;
    } else {
        output.table(&TITLES, &certain)?;
    }
    let shown = &found.possible[..found.possible.len().min(MOST_POSSIBLE)];
    if !shown.is_empty() {
        output.filled_line(
            "possible pairs, in which one sign is not coded for all fields ({n} of {all}):",
            &[&shown.len(), &found.possible.len()],
        )?;
        output.table(&TITLES, &rows(shown))?;
    }
    for (field, values) in &found.unused {
        output.filled_line(
            "values of {field} that no sign has with the rest: {list}",
            &[&field, &values.join(", ")],
        )?;
    }
    output.document(found)
}
