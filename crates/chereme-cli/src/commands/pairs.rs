//! `chereme pairs`: counts the minimal pairs of a lexicon.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Empty, PairOptions};
use clap::ValueEnum;
use serde_json::json;

use crate::args::Cli;
use crate::output::Output;
use crate::words::Words;

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
    output.line(format!(
        "{} pairs of {} signs ({} compared by {}), {} of them certain: both values are given",
        found.total,
        found.signs,
        found.entries,
        found.fields.join(", "),
        found.certain
    ))?;
    output.line(format!(
        "homonyms: {} pairs in {} groups of {} signs; {} forms",
        found.homonyms, found.homonym_groups, found.homonym_signs, found.forms
    ))?;
    let counts = found.by_field.iter();
    let counts: Vec<String> = counts
        .map(|(field, count)| format!("{field} {count}"))
        .collect();
    output.line(format!("by field: {}", counts.join(", ")))?;
    let dense = found.densest.iter();
    let dense: Vec<String> = dense
        .map(|it| format!("{} {}", it.gloss, it.pairs))
        .collect();
    output.line(format!("in most pairs: {}", dense.join(", ")))?;
    let mut document = serde_json::to_value(&found)?;
    if args.list {
        let row = |it: &chereme_corpus::Pair| vec![it.a.clone(), it.b.clone(), it.field.clone()];
        let rows: Vec<Vec<String>> = found.list.iter().map(row).collect();
        output.table(&["sign", "partner", "differs in"], &rows)?;
        document["pairs"] = json!(found.list);
    }
    output.document(document)
}

/// The French words of the command.
pub(super) const WORDS: Words = Words {
    help: &[
        (
            "Count the minimal pairs of a lexicon",
            "Compter les paires minimales d’un lexique",
        ),
        (
            "The fields to compare, separated by commas, or a set of Signbank's columns: S13, F8, F7, F5, C3",
            "Les champs à comparer, séparés par des virgules, ou un ensemble de colonnes de Signbank : S13, F8, F7, F5, C3",
        ),
        (
            "The treatment of empty fields",
            "Le traitement des champs vides",
        ),
        ("List the pairs", "Énumérer les paires"),
        (
            "Two signs are a minimal pair if exactly one of the fields differs. Fields are columns of an imported table, whose cells are compared as written, or fields of queries such as dominant.configuration, by which citation forms are compared.",
            "Deux signes forment une paire minimale si un seul des champs diffère. Les champs sont les colonnes d’une table importée, dont les cellules sont comparées telles qu’écrites, ou des champs de requête comme dominant.configuration, sur lesquels les formes de citation sont comparées.",
        ),
        (
            "An empty field is a value like any other",
            "Un champ vide est une valeur comme une autre",
        ),
        (
            "An empty field is unknown: signs with an empty field do not count",
            "Un champ vide est inconnu : les signes qui en ont un ne comptent pas",
        ),
    ],
    lines: &[
        (
            "{n} pairs of {signs} signs ({all} compared by {fields}), {certain} of them certain: both values are given",
            "paires : {n}, de {signs} signes ({all} comparés par {fields}), dont certaines : {certain} (les deux valeurs sont données)",
        ),
        (
            "homonyms: {n} pairs in {groups} groups of {signs} signs; {forms} forms",
            "homonymes : paires {n}, groupes {groups}, signes {signs}, formes {forms}",
        ),
        ("by field: {list}", "par champ : {list}"),
        ("in most pairs: {list}", "dans le plus de paires : {list}"),
    ],
    titles: &[],
};
