//! `chereme check`: looks for damage in a corpus, and rebuilds derived data that are wrong.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::Progress;

use crate::args::Cli;
use crate::output::{Bar, Output};
use crate::words::Words;

/// Look for damage: database, blocks and hashes, tier rules, tokens, history, search index
///
/// Reports every fault with its remedy; the exit code is 1 if there is any.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// Rebuild derived data (tokens, search index) that are wrong
    #[arg(long)]
    mend: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<ExitCode> {
    let mut corpus = cli.open(&args.corpus)?;
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let report = corpus.check(args.mend, &mut Progress::new(&mut hear))?;
    drop(bar);
    for fault in &report.faults {
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
            "Look for damage: database, blocks and hashes, tier rules, tokens, history, search index",
            "Chercher les dégâts : base, blocs et sommes, règles des acteurs, occurrences, historique, index de recherche",
        ),
        (
            "Rebuild derived data (tokens, search index) that are wrong",
            "Reconstruire les données dérivées (occurrences, index de recherche) qui sont fausses",
        ),
        (
            "Reports every fault with its remedy; the exit code is 1 if there is any.",
            "Donne chaque faute avec son remède ; le code de sortie est 1 s’il y en a.",
        ),
    ],
    lines: &[
        ("mended: {what}", "réparé : {what}"),
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
