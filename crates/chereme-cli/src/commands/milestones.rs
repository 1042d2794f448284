//! `chereme milestones`.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{Function, MilestoneOptions, Progress, Step};

use crate::args::Cli;
use crate::output::{Bar, Output};

/// Derive the milestones of expressions of the face from glosses and functions, as tiers
///
/// A tier called "function" (or construction, clause type, fonction; any other with --tier) holds an annotation such as
/// wh, yn, negation or topic over the signs of each expression. M1 is the end of the sign before, M2 the begin of the
/// first sign, M3 the begin of the second sign (negation) or of the last (all others), M4 the end of the last sign and M5
/// the begin of the sign after; 500 ms away at an edge of the utterance, which is an annotation of a translation
/// tier if there is one, else the recording. One sign has no M3.
///
/// The phases M1-M2, M2-M3, M3-M4 and M4-M5 are written on a tier such as "milestones wh". Phases that a person moves or
/// writes stay as they are from then on. `undo` takes the last step back.
///
/// `--json` gives "written", "kept", "functions" and "expressions", each with "recording", "address", "function", "signs",
/// "m1_us" to "m5_us" ("m3_us" is null for one sign), "corrected" and "findings".
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme milestones mine.chereme --function wh
  chereme milestones mine.chereme --dry-run          (all functions; nothing is written)
  chereme annotate mine.chereme --in recording:3 set annotation:41 --start 0.4s   (a milestone corrected)")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The function: negation, wh, yn, topic, conditional, rhetorical, or another word of the tier; else all
    #[arg(long)]
    function: Option<String>,
    /// The tier that names functions; else those called function, construction, clause type and the like
    #[arg(long, value_name = "NAME")]
    tier: Option<String>,
    /// Only this recording
    #[arg(long, value_name = "RECORDING")]
    recording: Option<String>,
    /// Write nothing
    #[arg(long)]
    dry_run: bool,
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let options = MilestoneOptions {
        function: args.function.as_deref().map(Function::of),
        tier: args.tier.clone(),
        recording: args.recording.as_deref().map(str::parse).transpose()?,
        dry_run: args.dry_run,
    };
    let mut bar = Bar::new();
    let mut hear = |step: Step<'_>| bar.show(step);
    let found = corpus.milestones(&options, &mut Progress::new(&mut hear))?;
    drop(bar);
    let seconds = |at: chereme_corpus::Instant| format!("{:.3}", at.seconds());
    let rows: Vec<Vec<String>> = found
        .expressions
        .iter()
        .map(|it| {
            let marks = &it.milestones;
            vec![
                it.recording.clone(),
                it.address.clone(),
                it.function.to_string(),
                it.signs.join(" "),
                seconds(marks.m1),
                seconds(marks.m2),
                marks.m3.map_or("-".to_owned(), seconds),
                seconds(marks.m4),
                seconds(marks.m5),
                if it.corrected {
                    "corrected".to_owned()
                } else {
                    it.findings.join("; ")
                },
            ]
        })
        .collect();
    let titles = [
        "recording",
        "address",
        "function",
        "signs",
        "M1",
        "M2",
        "M3",
        "M4",
        "M5",
        "findings",
    ];
    if rows.is_empty() {
        let known: Vec<String> = found
            .functions
            .iter()
            .map(|(name, count)| format!("{name} ({count})"))
            .collect();
        output.line(match known.is_empty() {
            true => "no tier names functions; annotate wh, yn, negation or topic on a tier called \"function\"".to_owned(),
            false => format!("no such expression; the functions are: {}", known.join(", ")),
        })?;
    } else {
        output.table(&titles, &rows)?;
        output.line(format!(
            "{} phases written; {} expressions keep corrected milestones",
            found.written, found.kept
        ))?;
    }
    output.document(found)
}
