//! `chereme delete`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::words::deletion as words;
use chereme_corpus::{Address, DeleteOptions, Deleted, Dependents, Progress};

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Delete recordings and signs with everything that belongs to them
///
/// A recording goes with its tracks, tiers, annotations, tokens and recipe; films next to the corpus stay. A sign goes
/// with its lexicon entries, translations and remarks, and with recordings that were generated for it alone; a sign that
/// loses its last token goes too, unless it has a translation or a remark. All of it is one operation, and `chereme undo`
/// restores it: the file keeps the numbers for that, and does not become smaller.
///
/// If generated signs take movement from a recording, or a sign is annotated in recordings that stay, nothing is deleted
/// without --with-dependents or --keep-dependents.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme delete mine.chereme recording:3 --dry-run
  chereme delete mine.chereme recording:3 recording:\"take 12\"
  chereme delete mine.chereme sign:LIMACE
  chereme delete mine.chereme recording:escargot --with-dependents")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The recordings and signs, such as recording:3 or sign:LIMACE
    #[arg(required = true, value_name = "WHAT")]
    what: Vec<Address>,
    /// Delete also generated signs that take movement from them, and annotations of the signs in recordings that stay
    #[arg(long, conflicts_with = "keep_dependents")]
    with_dependents: bool,
    /// Keep generated signs that take movement from them; their recipes cannot be evaluated again
    #[arg(long)]
    keep_dependents: bool,
    /// Report what would be deleted, and write nothing
    #[arg(long)]
    dry_run: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let options = DeleteOptions {
        dependents: match (args.with_dependents, args.keep_dependents) {
            (true, _) => Dependents::Delete,
            (_, true) => Dependents::Keep,
            _ => Dependents::Refuse,
        },
        dry_run: args.dry_run,
    };
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let done = corpus.delete(&args.what, options, &mut Progress::new(&mut hear))?;
    drop(bar);
    print(&done, options.dependents, output)?;
    output.document(done)
}

fn print(done: &Deleted, dependents: Dependents, output: &mut Output) -> Result<()> {
    let title = match done.dry_run {
        true => words::NOTHING_WRITTEN,
        false => words::DELETED,
    };
    output.text_line(title, &[])?;
    for it in &done.recordings {
        let own = it.belongings;
        let parts = [
            (own.tracks, "tracks"),
            (own.tiers, "tiers"),
            (own.annotations, "annotations"),
            (own.tokens, "tokens"),
        ];
        let parts = parts.map(|(count, noun)| output.counted(count, noun));
        output.line_as_is(&format!(
            "  recording:{} {:?}: {}",
            it.recording,
            it.name,
            parts.join(", ")
        ))?;
    }
    for gloss in &done.signs {
        output.line_as_is(&format!("  sign:{gloss}"))?;
    }
    if done.annotations > 0 {
        output.line_as_is(&format!(
            "  {}",
            output.counted(done.annotations, "annotations")
        ))?;
    }
    if done.dependents.is_empty() || dependents == Dependents::Delete {
        return Ok(());
    }
    let title = match dependents {
        Dependents::Keep => words::KEPT,
        _ => words::PREVENTED_BY,
    };
    output.text_line(title, &[])?;
    for it in &done.dependents {
        output.line_as_is(&format!("  {} {:?}", it.address, it.recording))?;
    }
    Ok(())
}
