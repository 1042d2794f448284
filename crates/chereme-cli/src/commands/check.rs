//! `chereme check`: looks for damage in a corpus, and rebuilds derived data that are wrong.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;
use chereme_corpus::Progress;

use crate::args::Cli;
use crate::output::{Bar, Output};

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
        let mended = output.spoken(mended);
        output.filled_line("mended: {what}", &[&mended])?;
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
        output.filled_line(
            "not damage, but against the rules of tiers: {count}",
            &[&count],
        )?;
    }
    let ok = report.ok;
    output.document(report)?;
    Ok(if ok {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}
