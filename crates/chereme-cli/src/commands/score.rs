//! `chereme score`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Address, ScoreOptions};

use crate::args::Cli;
use crate::output::Output;

/// Score how alike two pieces of movement are, with the alignment
///
/// Dynamic time warping over placement, movement, orientation and configuration, each in its own
/// scale; 0 is the same movement.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The first: a gloss, token:41 or recording:3
    a: String,
    /// The second
    b: String,
    /// Draw the alignment to a picture (.png)
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
    /// Write over a picture that is there already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    let (a, b): (Address, Address) = (args.a.parse()?, args.b.parse()?);
    let options = ScoreOptions::default();
    let score = match &args.draw {
        Some(path) => corpus.draw_alignment([&a, &b], &options, path, args.force)?,
        None => corpus.score(&a, &b, &options)?,
    };
    let normalized = score
        .normalized
        .map_or("none".to_owned(), |it| format!("{it:.2}"));
    output.line(format!(
        "distance {:.1} in all, {normalized} for each aligned pair of frames (0: the same movement; each part is in its \
         own scale)",
        score.distance
    ))?;
    let rows: Vec<Vec<String>> = score
        .components
        .iter()
        .map(|(component, part)| vec![component.to_string(), format!("{part:.4}")])
        .collect();
    output.table(&["component", "distance"], &rows)?;
    if let Some(error) = score.max_joint_error_m {
        output.line(format!(
            "largest distance of a joint: {:.1} cm",
            error * 100.0
        ))?;
    }
    output.line(format!(
        "alignment: {}",
        output.counted(score.alignment.len() as u64, "pairs of frames")
    ))?;
    output.document(score)
}
