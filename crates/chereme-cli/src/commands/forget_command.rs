//! `chereme forget`: removes a person from a corpus for good.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{CorpusAddress, CorpusError, ForgottenSigner};

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// The most texts that are shown one by one of those that rows of others hold, too.
const MAX_SHOWN_ROWS: usize = 5;

/// Forget a signer for good: the one operation that cannot be undone
///
/// All recordings of the signer go, with tracks, tiers, annotations, tokens, recipes and numbers, and the signer. So do
/// the whole history of the corpus, its search index, and older versions of the file beside it. Then the file is written
/// again, and its bytes are searched for every hash, identity, name and text that was removed; the report says how many
/// were searched for. Texts that rows of somebody else say, too, such as a gloss, stay and are listed.
///
/// Nothing is forgotten while something else needs it: signs of others made from these recordings, recordings of others
/// with the same movement, recordings that show others, too, studies, and open decisions after a merge. Films beside the corpus, copies elsewhere, exports and
/// publications are files that this program does not know: delete them yourself, and publish again.
///
/// `--json` gives "signer", "dry_run", "recordings", "older_files", "searched" and "still_said", each with "text" and
/// "table".

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme forget mine.chereme signer:S07
  chereme forget mine.chereme signer:S07 --yes")]
pub(crate) struct ForgetArgs {
    /// The corpus
    corpus: PathBuf,
    /// The signer, such as signer:S07
    #[arg(value_name = "WHO")]
    who: CorpusAddress,
    /// Do it; without this the command only says what would go
    #[arg(long)]
    yes: bool,
}

pub(super) fn run(cli: &CommandLine, args: &ForgetArgs, output: &mut CommandOutput) -> Result<()> {
    let CorpusAddress::Signer(signer) = &args.who else {
        return Err(CorpusError::from_wrong_message(format!("{} is no signer", args.who))
            .with_error_place(args.who.to_string())
            .with_command_advice("write signer:NAME; recordings and signs go with `chereme delete`")
            .into());
    };
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let done = with_progress_bar(|progress| corpus.forget_signer(signer, !args.yes, progress))?;
    print_forgotten(&done, output)?;
    output.set_json_document(done)
}

fn print_forgotten(done: &ForgottenSigner, output: &mut CommandOutput) -> Result<()> {
    let count = output.format_counted_noun(done.recordings.len() as u64, "recordings");
    match done.dry_run {
        true => output.filled_line(
            "nothing is written yet; with --yes {signer} goes for good, with {n} and the history:",
            &[&done.signer, &count],
        )?,
        false => output.filled_line(
            "forgotten for good: {signer}, {n} and the history:",
            &[&done.signer, &count],
        )?,
    }
    for name in &done.recordings {
        output.line_as_is(&format!("  recording:{name:?}"))?;
    }
    for path in &done.older_files {
        output.line_as_is(&format!("  {}", path.display()))?;
    }
    for name in &done.searches {
        output.line_as_is(&format!("  search @{name}"))?;
    }
    // Only a file without the person can be searched for traces.
    if done.dry_run {
        return Ok(());
    }
    output.filled_line(
        "proof: {n} hashes, identities, names and texts were searched for in the bytes of the file, and none was found outside of \
         rows of others",
        &[&done.searched],
    )?;
    for said in done.still_said.iter().take(MAX_SHOWN_ROWS) {
        output.filled_line(
            "rows of others say this, too: {text} (table {name})",
            &[&format_args!("{:?}", said.text), &said.table],
        )?;
    }
    if done.still_said.len() > MAX_SHOWN_ROWS {
        let more = done.still_said.len() - MAX_SHOWN_ROWS;
        output.filled_line("{n} more texts stand in rows of others: --json lists them", &[&more])?;
    }
    output.write_note("films beside the corpus, copies, exports and publications are not touched: delete them yourself")
}
