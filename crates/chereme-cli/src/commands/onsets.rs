//! `chereme onsets`: measures when non-manuals begin and end relative to their signs.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Function, Progress, Quartiles, Step};

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Measure when non-manuals begin and end relative to the signs that they span, for each function
///
/// A channel of the face or head begins when it is halfway from its value half a second before the expression to its
/// most extreme value over the signs, and ends when it is halfway back; one that is not back half a second after M5 has
/// no end. Onsets are in seconds after the start of the first sign (negative: before it), and ends in seconds after the
/// end of the last sign. The functions are those of `milestones`.
///
/// `--json` gives "expressions", "without_face", "with_gaps", "too_long" and "rows", each with "function", "channel",
/// "n", "onset_s" ("q1", "median", "q3"), "ends" and "offset_s", which is null without ends.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme onsets mine.chereme
  chereme onsets mine.chereme --function wh --draw onsets.svg")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The function of the expressions: negation, wh, yn, topic, conditional, rhetorical, or another word of the tier;
    /// without it all
    #[arg(long)]
    function: Option<String>,
    /// Draw medians and quartiles to a picture (.svg)
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
    /// Replace a picture that exists already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    let mut bar = Bar::new();
    let mut hear = |step: Step<'_>| bar.show(step);
    let function = args.function.as_deref().map(Function::of);
    let found = corpus.onsets(function.as_ref(), &mut Progress::new(&mut hear))?;
    drop(bar);
    let text = |it: &Quartiles| format!("{:+.3} ({:+.3} to {:+.3})", it.median, it.q1, it.q3);
    let rows: Vec<Vec<String>> = found
        .rows
        .iter()
        .map(|it| {
            let (onset, offset) = (
                text(&it.onset_s),
                it.offset_s.as_ref().map(text).unwrap_or_default(),
            );
            vec![
                it.function.to_string(),
                it.channel.to_owned(),
                it.n.to_string(),
                onset,
                it.ends.to_string(),
                offset,
            ]
        })
        .collect();
    let titles = [
        "function",
        "channel",
        "n",
        "begins: median (quartiles)",
        "n of ends",
        "ends: median (quartiles)",
    ];
    output.table(&titles, &rows)?;
    output.filled_line(
        "expressions: {n}; without a face: {none}",
        &[&found.expressions, &found.without_face],
    )?;
    if found.with_gaps > 0 {
        output.filled_line(
            "expressions during which nothing was measured at times: {n}",
            &[&found.with_gaps],
        )?;
    }
    if found.too_long > 0 {
        output.filled_line(
            "expressions of more than half an hour, which were not examined: {n}; annotate shorter \
             ones",
            &[&found.too_long],
        )?;
    }
    if let Some(path) = &args.draw {
        corpus.draw_onsets(&found, path, args.force)?;
        output.filled_line("drew {path}", &[&path.display()])?;
    }
    output.document(found)
}
