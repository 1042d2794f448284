//! `chereme delete`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::words::deletion as words;
use chereme_corpus::{CorpusAddress, DeleteOptions, DeletionReport, DependentsPolicy};

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

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
pub(crate) struct DeleteArgs {
    /// The corpus
    corpus: PathBuf,
    /// The recordings and signs, such as recording:3 or sign:LIMACE
    #[arg(required = true, value_name = "WHAT")]
    what: Vec<CorpusAddress>,
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

pub(super) fn run(cli: &CommandLine, args: &DeleteArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = DeleteOptions {
        dependents: match (args.with_dependents, args.keep_dependents) {
            (true, _) => DependentsPolicy::Delete,
            (_, true) => DependentsPolicy::Keep,
            _ => DependentsPolicy::Refuse,
        },
        dry_run: args.dry_run,
    };
    let done = with_progress_bar(|progress| corpus.delete_objects(&args.what, options, progress))?;
    print_deleted(&done, options.dependents, output)?;
    output.set_json_document(done)
}

fn print_deleted(done: &DeletionReport, dependents: DependentsPolicy, output: &mut CommandOutput) -> Result<()> {
    let title = match done.dry_run {
        true => words::NOTHING_WRITTEN,
        false => words::DELETED,
    };
    output.text_line(title, &[])?;
    for it in &done.recordings {
        let belongings = it.belongings;
        let part_counts = [
            (belongings.tracks, "tracks"),
            (belongings.tiers, "tiers"),
            (belongings.annotations, "annotations"),
            (belongings.tokens, "tokens"),
        ];
        let parts = part_counts.map(|(count, noun)| output.format_counted_noun(count, noun));
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
            output.format_counted_noun(done.annotations, "annotations")
        ))?;
    }
    if done.dependents.is_empty() || dependents == DependentsPolicy::Delete {
        return Ok(());
    }
    let title = match dependents {
        DependentsPolicy::Keep => words::KEPT,
        _ => words::PREVENTED_BY,
    };
    output.text_line(title, &[])?;
    for it in &done.dependents {
        output.line_as_is(&format!("  {} {:?}", it.address, it.recording))?;
    }
    Ok(())
}
