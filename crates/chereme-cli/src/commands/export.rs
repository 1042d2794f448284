//! `chereme export`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{ExportOptions, ExportWhat, Progress, SearchOptions};

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Take things away: movement, annotations, tables, or the whole enriched database
///
/// The ending of --to says the format: .bvh (movement of a recording or token), .eaf (a recording's
/// tiers, for ELAN), .csv or .tsv (tokens with all components), .curves.csv (how much there is of each
/// non-manual, frame by frame), .sigml (notated signs as gestural SiGML),
/// .hsigml (the same as HamNoSys's symbols), .hns or .txt (as HamNoSys text, a sign a line), or none: a
/// folder with the database, a table a file, the recordings, the inventories, checksums and provenance.
/// The same corpus always gives the same bytes.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// What: all, a gloss, token:41, recording:3, tier:12, or query:'right.configuration=U'
    what: String,
    /// Where to
    #[arg(long, value_name = "PATH")]
    to: PathBuf,
    /// Write over a file that is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let what = match args.what.strip_prefix("query:") {
        Some(query) => {
            let options = SearchOptions {
                facets: false,
                ..SearchOptions::default()
            };
            let answer = corpus.search(query, &options)?;
            ExportWhat::Tokens(answer.hits.iter().map(|hit| hit.token).collect())
        }
        None if args.what == "all" => ExportWhat::All,
        None => ExportWhat::Address(args.what.parse()?),
    };
    let options = ExportOptions { force: args.force };
    let mut bar = Bar::new();
    let mut hear = |step: chereme_corpus::Step<'_>| bar.show(step);
    let report = corpus.export(&what, &args.to, &options, &mut Progress::new(&mut hear))?;
    drop(bar);
    match report.files.as_slice() {
        [one] => output.line(format!(
            "wrote {}, {} KB",
            one.path.display(),
            one.bytes.div_ceil(1024)
        ))?,
        files => {
            let bytes: u64 = files.iter().map(|file| file.bytes).sum();
            let megabytes = bytes as f64 / 1e6;
            output.line(format!(
                "wrote {} files, {megabytes:.1} MB, to {}",
                files.len(),
                args.to.display()
            ))?;
        }
    }
    for note in &report.notes {
        output.line(format!("note: {note}"))?;
    }
    output.document(report)
}
