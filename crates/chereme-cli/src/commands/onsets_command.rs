//! `chereme onsets`: measures when non-manuals begin and end relative to their signs.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{ExpressionFunction, NumberQuartiles};

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

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
pub(crate) struct OnsetsArgs {
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

pub(super) fn run(cli: &CommandLine, args: &OnsetsArgs, output: &mut CommandOutput) -> Result<()> {
    let corpus = cli.open_cli_corpus(&args.corpus)?;
    let function = args.function.as_deref().map(ExpressionFunction::from_function_name);
    let onset_table = with_progress_bar(|progress| corpus.measure_nonmanual_onsets(function.as_ref(), progress))?;
    let text = |quartiles: &NumberQuartiles| {
        format!(
            "{:+.3} ({:+.3} to {:+.3})",
            quartiles.median, quartiles.q1, quartiles.q3
        )
    };
    output.write_item_table(
        &onset_table.rows,
        &[
            ("function", &|row| row.function.to_string()),
            ("channel", &|row| row.channel.to_owned()),
            ("n", &|row| row.n.to_string()),
            ("begins: median (quartiles)", &|row| text(&row.onset_s)),
            ("n of ends", &|row| row.ends.to_string()),
            ("ends: median (quartiles)", &|row| {
                row.offset_s.as_ref().map(text).unwrap_or_default()
            }),
        ],
    )?;
    output.filled_line(
        "expressions: {n}; without a face: {none}",
        &[&onset_table.expressions, &onset_table.without_face],
    )?;
    if onset_table.with_gaps > 0 {
        output.filled_line(
            "expressions during which nothing was measured at times: {n}",
            &[&onset_table.with_gaps],
        )?;
    }
    if onset_table.too_long > 0 {
        output.filled_line(
            "expressions of more than half an hour, which were not examined: {n}; annotate shorter \
             ones",
            &[&onset_table.too_long],
        )?;
    }
    if let Some(path) = &args.draw {
        corpus.draw_onsets(&onset_table, path, args.force)?;
        output.filled_line("drew {path}", &[&path.display()])?;
    }
    output.set_json_document(onset_table)
}
