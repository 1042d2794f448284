//! `chereme new`: creates an empty corpus.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::Corpus;
use serde_json::json;

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Create an empty corpus with the inventories of handshapes, placements, movements and the rest
#[derive(Debug, clap::Args)]
pub(crate) struct NewCorpusArgs {
    /// The file to create, such as lsf.chereme; it must not exist yet
    corpus: PathBuf,
}

pub(super) fn run(cli: &CommandLine, args: &NewCorpusArgs, output: &mut CommandOutput) -> Result<()> {
    let corpus = Corpus::create_corpus(&args.corpus, &cli.history_author())?;
    output.set_json_document(json!({ "corpus": corpus.corpus_file_path() }))?;
    output.filled_line("made {path}", &[&corpus.corpus_file_path().display()])
}
