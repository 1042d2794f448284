//! `chereme score`: measures the similarity of two pieces of movement.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Corpus, CorpusAddress, ExpressionFunction, ScoreOptions};

use crate::args::CommandLine;
use crate::output::CommandOutput;

/// Measure the similarity of two pieces of movement, and align them
///
/// The score is the distance under dynamic time warping, over placement, movement, orientation and configuration, each
/// in its own scale; 0 is the same movement. Handshapes of hands that nobody captured, whose fingers rest throughout,
/// are not compared; "findings" and "left_out" of `--json` list them.
#[derive(Debug, clap::Args)]
pub(crate) struct ScoreArgs {
    /// The corpus
    corpus: PathBuf,
    /// The first piece: a gloss, token:41 or recording:3
    a: String,
    /// The second piece
    b: String,
    /// Compare expressions of the face phase by phase instead of movement; see `milestones` and `choose`
    #[arg(long)]
    face: bool,
    /// The function of the expressions, if there are several
    #[arg(long, requires = "face")]
    function: Option<String>,
    #[command(flatten)]
    comparing: super::choose_command::PerformanceComparing,
    /// Draw the alignment to a picture (.png)
    #[arg(long, value_name = "FILE", conflicts_with = "face")]
    draw: Option<PathBuf>,
    /// Replace a picture that exists already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &CommandLine, args: &ScoreArgs, output: &mut CommandOutput) -> Result<()> {
    let corpus = cli.open_cli_corpus(&args.corpus)?;
    let (a, b): (CorpusAddress, CorpusAddress) = (args.a.parse()?, args.b.parse()?);
    if args.face {
        return print_face_score(&corpus, [&a, &b], args, output);
    }
    let options = ScoreOptions::default();
    let scored = match &args.draw {
        Some(path) => corpus.draw_alignment([&a, &b], &options, path, args.force)?,
        None => corpus.score_movements(&a, &b, &options)?,
    };
    let score = &scored.score;
    let normalized = score
        .normalized
        .map_or("none".to_owned(), |value| format!("{value:.2}"));
    output.filled_line(
        "distance {n} in all, {mean} for each frame of the two (0: the same movement; each part is in \
         its own scale)",
        &[&format_args!("{:.1}", score.distance), &normalized],
    )?;
    let components: Vec<_> = score.components.iter().collect();
    output.write_item_table(
        &components,
        &[
            ("component", &|(component, _)| component.to_string()),
            ("distance", &|(_, part)| format!("{part:.4}")),
        ],
    )?;
    if let Some(error) = score.max_joint_error_m {
        output.filled_line(
            "largest distance of a joint: {cm} cm",
            &[&format_args!("{:.1}", error * 100.0)],
        )?;
    }
    output.filled_line(
        "alignment: {n}",
        &[&output.format_counted_noun(score.alignment.len() as u64, "pairs of frames")],
    )?;
    output.write_warnings(&scored.findings)?;
    output.set_json_document(scored)
}

fn print_face_score(
    corpus: &Corpus,
    both: [&CorpusAddress; 2],
    args: &ScoreArgs,
    output: &mut CommandOutput,
) -> Result<()> {
    let function = args.function.as_deref().map(ExpressionFunction::from_function_name);
    let score = corpus.score_faces(both, function.as_ref(), &args.comparing.choose_options())?;
    // The ratio of lengths counts as a difference unless it is left out.
    let shown_score = if args.comparing.no_stretch {
        score.unstretched
    } else {
        score.stretched
    };
    output.write_output_line(format!(
        "score {shown_score:.4} (0: alike); without the ratio of lengths {:.4}, ratio {:.3}{}",
        score.unstretched,
        score.stretch,
        if score.partial {
            "; a phase is empty in one of them and left out"
        } else {
            ""
        }
    ))?;
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |decimal| format!("{decimal:.4}"));
    output.write_item_table(
        &score.phases,
        &[
            ("milestones", &|entry| entry.phase.milestone_range_name().to_owned()),
            ("phase", &|entry| entry.phase.expression_phase_name().to_owned()),
            ("frames", &|entry| format!("{} / {}", entry.frames[0], entry.frames[1])),
            ("distance a frame", &|entry| number(entry.normalized)),
            ("path", &|entry| {
                entry.made.map_or(String::new(), |made| made.to_string())
            }),
        ],
    )?;
    output.write_item_table(
        &score.channels,
        &[
            ("channel", &|channel| channel.name.to_owned()),
            ("mean difference", &|channel| format!("{:.4}", channel.difference)),
        ],
    )?;
    output.set_json_document(score)
}
