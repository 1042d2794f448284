//! `chereme pairs`: counts the minimal pairs of a lexicon.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Empty, PairOptions};
use clap::ValueEnum;
use serde_json::json;

use crate::args::Cli;
use crate::output::Output;

/// Count the minimal pairs of a lexicon
///
/// Two signs are a minimal pair if exactly one of the fields differs. Fields are columns of an imported
/// table, whose cells are compared as written, or fields of queries such as dominant.configuration,
/// by which citation forms are compared.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The fields to compare, separated by commas, or a set of Signbank's columns: S13, F8, F7, F5, C3
    #[arg(long, value_name = "A,B,...", value_delimiter = ',')]
    fields: Vec<String>,
    /// The treatment of empty fields
    #[arg(long, value_enum, default_value_t = EmptyWord::Value)]
    empty: EmptyWord,
    /// List the pairs
    #[arg(long)]
    list: bool,
}

/// The treatment of empty fields, as the word for it in an argument.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum EmptyWord {
    /// An empty field is a value like any other
    Value,
    /// An empty field is unknown: signs with an empty field do not count
    Unknown,
}

impl From<EmptyWord> for Empty {
    fn from(word: EmptyWord) -> Self {
        match word {
            EmptyWord::Value => Self::Value,
            EmptyWord::Unknown => Self::Unknown,
        }
    }
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    let found = corpus.pairs(&PairOptions {
        fields: args.fields.clone(),
        empty: args.empty.into(),
    })?;
    output.filled_line(
        "{n} pairs of {signs} signs ({all} compared by {fields}), {certain} of them certain: both \
         values are given",
        &[
            &found.total,
            &found.signs,
            &found.entries,
            &found.fields.join(", "),
            &found.certain,
        ],
    )?;
    output.filled_line(
        "homonyms: {n} pairs in {groups} groups of {signs} signs; {forms} forms",
        &[
            &found.homonyms,
            &found.homonym_groups,
            &found.homonym_signs,
            &found.forms,
        ],
    )?;
    let counts = found.by_field.iter();
    let counts: Vec<String> = counts
        .map(|(field, count)| format!("{field} {count}"))
        .collect();
    output.filled_line("by field: {list}", &[&counts.join(", ")])?;
    let dense = found.densest.iter();
    let dense: Vec<String> = dense
        .map(|it| format!("{} {}", it.gloss, it.pairs))
        .collect();
    output.filled_line("in most pairs: {list}", &[&dense.join(", ")])?;
    let mut document = serde_json::to_value(&found)?;
    if args.list {
        let row = |it: &chereme_corpus::Pair| vec![it.a.clone(), it.b.clone(), it.field.clone()];
        let rows: Vec<Vec<String>> = found.list.iter().map(row).collect();
        output.table(&["sign", "partner", "differs in"], &rows)?;
        document["pairs"] = json!(found.list);
    }
    output.document(document)
}
