//! `chereme check`: looks for damage in a corpus, and rebuilds derived data that are wrong.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Result;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Look for damage: database, rows, files and blocks by their hashes, tokens, history, search index
///
/// Reports all damage with its remedy; the exit code is 1 if there is any. Annotations that break the rules of tiers are
/// listed as questions about the data: they came so from a file.
#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// The corpus
    corpus: PathBuf,
    /// Rebuild derived data: tokens that are wrong, and the search index
    #[arg(long)]
    mend: bool,
    /// Take the rows as they are now for right, after a change by another program
    #[arg(long, conflicts_with = "mend")]
    accept: bool,
}

pub(super) fn run(cli: &CommandLine, args: &CheckArgs, output: &mut CommandOutput) -> Result<ExitCode> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    // Rows that were changed by hand are accepted first, or the check would report them again.
    if args.accept {
        corpus.accept_rows()?;
    }
    let report = with_progress_bar(|progress| corpus.check_corpus(args.mend, progress))?;
    let questions = report.questions.len() as u64;
    for fault in report.all_findings() {
        output.write_output_line(format!(
            "{}: {}: {}",
            fault.kind,
            fault.place,
            output.translate_message(&fault.message)
        ))?;
        output.write_remedy(&fault.remedy)?;
    }
    for mended in &report.mended {
        let mended = output.translate_message(mended);
        output.filled_line("mended: {what}", &[&mended])?;
    }
    let checked_parts: Vec<String> = report
        .checked
        .iter()
        .map(|(what, count)| output.format_counted_noun(*count, what))
        .collect();
    let looked = checked_parts.join(", ");
    output.write_output_line(match report.ok {
        true => format!("all is well: looked at {looked}"),
        false => format!("there are faults: looked at {looked}"),
    })?;
    if questions > 0 {
        let count = output.format_counted_noun(questions, "questions");
        output.filled_line("not damage, but against the rules of tiers: {count}", &[&count])?;
    }
    // Scripts ask the exit code whether a corpus is sound.
    let ok = report.ok;
    output.set_json_document(report)?;
    Ok(if ok { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
