//! `chereme score`: measures the similarity of two pieces of movement.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Address, Corpus, Function, ScoreOptions};

use crate::args::Cli;
use crate::output::Output;

/// Measure the similarity of two pieces of movement, and align them
///
/// The score is the distance under dynamic time warping, over placement, movement, orientation and configuration, each
/// in its own scale; 0 is the same movement. Handshapes of hands that nobody captured, whose fingers rest throughout,
/// are not compared; "findings" and "left_out" of `--json` list them.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
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
    comparing: super::choose::Comparing,
    /// Draw the alignment to a picture (.png)
    #[arg(long, value_name = "FILE", conflicts_with = "face")]
    draw: Option<PathBuf>,
    /// Replace a picture that exists already
    #[arg(long)]
    force: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let corpus = cli.open(&args.corpus)?;
    let (a, b): (Address, Address) = (args.a.parse()?, args.b.parse()?);
    if args.face {
        return faces(&corpus, [&a, &b], args, output);
    }
    let options = ScoreOptions::default();
    let scored = match &args.draw {
        Some(path) => corpus.draw_alignment([&a, &b], &options, path, args.force)?,
        None => corpus.score(&a, &b, &options)?,
    };
    let score = &scored.score;
    let normalized = score
        .normalized
        .map_or("none".to_owned(), |it| format!("{it:.2}"));
    output.filled_line(
        "distance {n} in all, {mean} for each frame of the two (0: the same movement; each part is in \
         its own scale)",
        &[&format_args!("{:.1}", score.distance), &normalized])?;
    let rows: Vec<Vec<String>> = score
        .components
        .iter()
        .map(|(component, part)| vec![component.to_string(), format!("{part:.4}")])
        .collect();
    output.table(&["component", "distance"], &rows)?;
    if let Some(error) = score.max_joint_error_m {
        output.filled_line(
            "largest distance of a joint: {cm} cm",
            &[&format_args!("{:.1}", error * 100.0)],
        )?;
    }
    output.filled_line(
        "alignment: {n}",
        &[&output.counted(score.alignment.len() as u64, "pairs of frames")],
    )?;
    for finding in &scored.findings {
        output.warn(finding)?;
    }
    output.document(scored)
}

fn faces(corpus: &Corpus, both: [&Address; 2], args: &Args, output: &mut Output) -> Result<()> {
    let function = args.function.as_deref().map(Function::of);
    let score = corpus.score_faces(both, function.as_ref(), &args.comparing.options())?;
    let shown_score = if args.comparing.no_stretch {
        score.unstretched
    } else {
        score.stretched
    };
    output.line(format!(
        "score {shown_score:.4} (0: alike); without the ratio of lengths {:.4}, ratio {:.3}{}",
        score.unstretched,
        score.stretch,
        if score.partial {
            "; a phase is empty in one of them and left out"
        } else {
            ""
        }
    ))?;
    let number = |value: Option<f64>| value.map_or("-".to_owned(), |it| format!("{it:.4}"));
    let rows: Vec<Vec<String>> = score
        .phases
        .iter()
        .map(|it| {
            vec![
                it.phase.between().to_owned(),
                it.phase.name().to_owned(),
                format!("{} / {}", it.frames[0], it.frames[1]),
                number(it.normalized),
                it.made.map_or(String::new(), |made| made.to_string()),
            ]
        })
        .collect();
    output.table(
        &["milestones", "phase", "frames", "distance a frame", "path"],
        &rows,
    )?;
    let rows: Vec<Vec<String>> = score
        .channels
        .iter()
        .map(|it| vec![it.name.to_owned(), format!("{:.4}", it.difference)])
        .collect();
    output.table(&["channel", "mean difference"], &rows)?;
    output.document(score)
}
