//! `chereme check`: looks for damage in a corpus, and rebuilds derived data that are wrong.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::Progress;

use crate::args::Cli;
use crate::output::{Bar, Output};
use crate::words::Words;

/// Look for damage: database, rows, files and blocks by their hashes, tokens, history, search index
///
/// Reports all damage with its remedy; the exit code is 1 if there is any. Annotations that break the rules of tiers are
/// listed as questions about the data: they came so from a file.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// Rebuild derived data: tokens that are wrong, and the search index
    #[arg(long)]
    mend: bool,
    /// Take the rows as they are now for right, after a change by another program
    #[arg(long, conflicts_with = "mend")]
    accept: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<ExitCode> {
    let mut corpus = cli.open(&args.corpus)?;
    if args.accept {
        corpus.accept_rows()?;
    }
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let report = corpus.check(args.mend, &mut Progress::new(&mut hear))?;
    drop(bar);
    let questions = report.questions.len() as u64;
    for fault in report.findings() {
        output.line(format!(
            "{}: {}: {}",
            fault.kind,
            fault.place,
            output.spoken(&fault.message)
        ))?;
        output.advise(&fault.remedy)?;
    }
    for mended in &report.mended {
        output.line(format!("mended: {}", output.spoken(mended)))?;
    }
    let looked: Vec<String> = report
        .checked
        .iter()
        .map(|(what, count)| output.counted(*count, what))
        .collect();
    let looked = looked.join(", ");
    output.line(match report.ok {
        true => format!("all is well: looked at {looked}"),
        false => format!("there are faults: looked at {looked}"),
    })?;
    if questions > 0 {
        let count = output.counted(questions, "questions");
        output.line(format!(
            "not damage, but against the rules of tiers: {count}"
        ))?;
    }
    let ok = report.ok;
    output.document(report)?;
    Ok(if ok {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// The French words of the command.
pub(super) const WORDS: Words = Words {
    help: &[
        (
            "Look for damage: database, rows, files and blocks by their hashes, tokens, history, search index",
            "Chercher les dégâts : base, lignes, fichiers et blocs par leurs empreintes, occurrences, historique, index de recherche",
        ),
        (
            "Rebuild derived data: tokens that are wrong, and the search index",
            "Reconstruire les données dérivées : les occurrences fausses et l’index de recherche",
        ),
        (
            "Take the rows as they are now for right, after a change by another program",
            "Tenir les lignes pour justes telles qu’elles sont, après une modification par un autre programme",
        ),
        (
            "Reports all damage with its remedy; the exit code is 1 if there is any. Annotations that break the rules of tiers are listed as questions about the data: they came so from a file.",
            "Donne tous les dégâts avec leurs remèdes ; le code de sortie est 1 s’il y en a. Les annotations contraires aux règles des acteurs sont listées comme questions sur les données : elles sont venues ainsi d’un fichier.",
        ),
    ],
    lines: &[
        ("mended: {what}", "réparé : {what}"),
        (
            "not damage, but against the rules of tiers: {count}",
            "pas des dégâts, mais contraires aux règles des acteurs : {count}",
        ),
        (
            "all is well: looked at {list}",
            "tout va bien ; vérifié : {list}",
        ),
        (
            "there are faults: looked at {list}",
            "il y a des défauts ; vérifié : {list}",
        ),
        (
            "the check cannot go on: take a backup, or save what can be read with `chereme export CORPUS all --to FOLDER`",
            "la vérification ne peut pas continuer : prenez une sauvegarde, ou sauvez ce qui se lit avec `chereme export CORPUS all --to DOSSIER`",
        ),
    ],
    titles: &[],
};
