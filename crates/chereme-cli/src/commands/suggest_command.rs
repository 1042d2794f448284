//! `chereme suggest`: suggests new signs that could be composed from a sign.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::MinimalPairPartner;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Suggest new signs that could be composed from a sign
///
/// Lists the signs that differ from it in exactly one field (minimal pairs), each with a recipe if one generates it
/// from the sign, and the values that no sign combines with the rest of its coding.
#[derive(Debug, clap::Args)]
pub(crate) struct SuggestArgs {
    /// The corpus
    corpus: PathBuf,
    /// The sign: a gloss or token:41
    token: String,
    /// Compare it with the signs of other lexicons, too
    #[arg(long)]
    across: bool,
}

/// The number of possible partners that are shown.
const MOST_POSSIBLE: usize = 20;

pub(super) fn run(cli: &CommandLine, args: &SuggestArgs, output: &mut CommandOutput) -> Result<()> {
    let corpus = cli.open_cli_corpus(&args.corpus)?;
    let suggestion = corpus.suggest_new_signs(&args.token.parse()?, args.across)?;
    let coding: Vec<String> = suggestion
        .coding
        .iter()
        .map(|(field, value)| format!("{field}={value}"))
        .collect();
    output.write_output_line(format!(
        "{} (token:{}): {}",
        suggestion.gloss,
        suggestion.token,
        coding.join(" ")
    ))?;
    if suggestion.partners.is_empty() {
        output.write_output_line("no sign differs from it in one component only")?;
    } else {
        print_pair_partners(&suggestion.partners, output)?;
    }
    let shown = &suggestion.possible[..suggestion.possible.len().min(MOST_POSSIBLE)];
    if !shown.is_empty() {
        output.filled_line(
            "possible pairs, in which one sign is not coded for all fields ({n} of {all}):",
            &[&shown.len(), &suggestion.possible.len()],
        )?;
        print_pair_partners(shown, output)?;
    }
    for (field, values) in &suggestion.unused {
        output.filled_line(
            "values of {field} that no sign has with the rest: {list}",
            &[&field, &values.join(", ")],
        )?;
    }
    output.set_json_document(suggestion)
}

fn print_pair_partners(partners: &[MinimalPairPartner], output: &mut CommandOutput) -> Result<()> {
    output.write_item_table(
        partners,
        &[
            ("partner", &|partner| partner.gloss.clone()),
            ("origin", &|partner| partner.origin.record_origin_name().to_owned()),
            ("differs in", &|partner| {
                format!("{}: {} -> {}", partner.field, partner.from, partner.to)
            }),
            ("alike in", &|partner| partner.equal.to_string()),
            ("recipe", &|partner| partner.recipe.clone().unwrap_or_default()),
        ],
    )
}
