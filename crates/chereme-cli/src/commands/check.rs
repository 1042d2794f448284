//! `chereme check`: looks for damage in a corpus, and rebuilds derived data that are wrong.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::Progress;

use crate::args::Cli;
use crate::output::{Bar, Output};

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
    let word = if report.ok {
        "all is well"
    } else {
        "there are faults"
    };
    output.line(format!("{word}: looked at {}", looked.join(", ")))?;
    let ok = report.ok;
    output.document(report)?;
    Ok(if ok {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}
