//! `chereme new`: creates an empty corpus.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::Corpus;
use serde_json::json;

use crate::args::Cli;
use crate::output::Output;

/// Create an empty corpus with the inventories of handshapes, placements, movements and the rest
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The file to create, such as lsf.chereme; it must not exist yet
    corpus: PathBuf,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = Corpus::create(&args.corpus, &cli.author())?;
    output.document(json!({ "corpus": corpus.path() }))?;
    output.filled_line("made {path}", &[&corpus.path().display()])
}
