//! `chereme propose`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Progress, Step};
use chereme_sign::Component;

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Propose codings of a component from movement, for tokens that nobody has coded for it
///
/// Each token is transcribed from its movement; its values go onto tiers of their own, called for example
/// "configuration dominant (proposed)", as annotations of a detector. A person's codings stay apart from them. All of it
/// is one operation, which one `undo` takes back. Ctrl-C ends it and leaves the corpus as it was.
///
/// `--json` gives "tokens" and "annotations" written, "unread", the tokens whose movement could not be read, and
/// "recordings", the names of those with new annotations.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme propose mine.chereme configuration
  chereme search mine.chereme configuration=U    (finds proposed codings, too)
  chereme undo mine.chereme                      (takes all of them back)")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The component: configuration (or handshape), placement or movement
    component: Component,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let mut bar = Bar::new();
    let mut hear = |step: Step<'_>| bar.show(step);
    let proposed = corpus.propose_coding(args.component, &mut Progress::new(&mut hear))?;
    drop(bar);
    output.line(format!(
        "{} in {}, for {}; {} could not be read from movement",
        output.counted(proposed.annotations, "annotations"),
        output.counted(proposed.recordings.len() as u64, "recordings"),
        output.counted(proposed.tokens, "tokens"),
        output.counted(proposed.unread, "tokens"),
    ))?;
    output.document(proposed)
}
