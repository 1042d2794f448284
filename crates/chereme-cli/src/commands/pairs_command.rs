//! `chereme pairs`: counts the minimal pairs of a lexicon.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{EmptyCellTreatment, PairOptions};
use serde_json::json;

use super::lexicon_command::LexiconScopeArgs;
use crate::args::{CommandLine, NamedChoices};
use crate::output::{CommandOutput, with_progress_bar};

/// Count the minimal pairs of a lexicon
///
/// Two signs are a minimal pair if exactly one of the fields differs. Fields are columns of an imported
/// table, whose cells are compared as written, or fields of queries such as dominant.configuration,
/// by which citation forms are compared.
#[derive(Debug, clap::Args)]
pub(crate) struct PairsArgs {
    /// The corpus
    corpus: PathBuf,
    /// The tokens whose signs are compared, as in `chereme search`; without it the citation forms
    query: Vec<String>,
    #[command(flatten)]
    scope: LexiconScopeArgs,
    /// The fields to compare, separated by commas, or a set of Signbank's columns: S13, F8, F7, F5, C3
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    fields: Vec<String>,
    /// The treatment of empty fields
    #[arg(long, value_parser = EMPTY_CELL_CHOICES, default_value = "value")]
    empty: EmptyCellTreatment,
    /// List the pairs
    #[arg(long)]
    list: bool,
}

/// The treatments of empty fields.
pub(super) const EMPTY_CELL_CHOICES: NamedChoices<EmptyCellTreatment> = NamedChoices(&[
    (
        "value",
        "An empty field is a value like any other",
        EmptyCellTreatment::Value,
    ),
    (
        "unknown",
        "An empty field is unknown: signs with an empty field do not count",
        EmptyCellTreatment::Unknown,
    ),
]);

pub(super) fn run(cli: &CommandLine, args: &PairsArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = PairOptions {
        fields: args.fields.clone(),
        empty: args.empty,
        query: (!args.query.is_empty()).then(|| args.query.join(" ")),
        scope: args.scope.lexicon_scope(),
    };
    let pair_report = with_progress_bar(|progress| corpus.minimal_pairs(&options, progress))?;
    output.filled_line(
        "{n} pairs of {signs} signs ({all} compared by {fields}), {certain} of them certain: both \
         values are given",
        &[
            &pair_report.total,
            &pair_report.signs,
            &pair_report.entries,
            &pair_report.fields.join(", "),
            &pair_report.certain,
        ],
    )?;
    output.filled_line(
        "homonyms: {n} pairs in {groups} groups of {signs} signs; {forms} forms",
        &[
            &pair_report.homonyms,
            &pair_report.homonym_groups,
            &pair_report.homonym_signs,
            &pair_report.forms,
        ],
    )?;
    let field_counts = pair_report.by_field.iter();
    let counts: Vec<String> = field_counts.map(|(field, count)| format!("{field} {count}")).collect();
    output.filled_line("by field: {list}", &[&counts.join(", ")])?;
    let densest_signs = pair_report.densest.iter();
    let dense: Vec<String> = densest_signs
        .map(|sign| format!("{} {}", sign.gloss, sign.pairs))
        .collect();
    output.filled_line("in most pairs: {list}", &[&dense.join(", ")])?;
    // The list may have millions of rows, and is part of the document only if it is asked for.
    let mut document = serde_json::to_value(&pair_report)?;
    if args.list {
        output.write_item_table(
            &pair_report.list,
            &[
                ("sign", &|pair| pair.a.clone()),
                ("partner", &|pair| pair.b.clone()),
                ("differs in", &|pair| pair.field.clone()),
            ],
        )?;
        document["pairs"] = json!(pair_report.list);
    }
    output.set_json_document(document)
}
