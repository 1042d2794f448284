//! `chereme milestones`: derives the milestones of expressions of the face from glosses and functions.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{ExpressionFunction, MilestoneOptions};

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Derive the milestones of expressions of the face from glosses and functions, and write them as tiers
///
/// A tier called "function" (or construction, clause type, fonction; any other with --tier) holds an annotation such as
/// wh, yn, negation or topic over the signs of each expression. M1 is the end of the sign before the expression, M2 the
/// start of its first sign, M3 the start of its second sign (negation) or of its last sign (all others), M4 the end of
/// its last sign, and M5 the start of the sign after it. If there is no sign before or after it in the utterance, M1 or
/// M5 lies 500 ms away. The utterance is an annotation of a translation tier if there is one, otherwise the whole
/// recording. An expression over one sign has no M3.
///
/// The phases M1-M2, M2-M3, M3-M4 and M4-M5 are written on a tier such as "milestones wh". The command never changes
/// phases that a person moved or wrote. `undo` takes the last change back.
///
/// `--json` gives "written", "kept", "functions" and "expressions", each with "recording", "address", "function",
/// "signs", "m1_us" to "m5_us" ("m3_us" is null for one sign), "corrected" and "findings".
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme milestones mine.chereme --function wh
  chereme milestones mine.chereme --dry-run          (all functions; nothing is written)
  chereme annotate mine.chereme --in recording:3 set annotation:41 --start 0.4s   (a milestone corrected)")]
pub(crate) struct MilestonesArgs {
    /// The corpus
    corpus: PathBuf,
    /// The function of the expressions: negation, wh, yn, topic, conditional, rhetorical, or another word of the tier;
    /// without it all
    #[arg(long)]
    function: Option<String>,
    /// The tier that names functions; without it those called function, construction, clause type and the like
    #[arg(long, value_name = "NAME")]
    tier: Option<String>,
    /// Only this recording
    #[arg(long, value_name = "RECORDING")]
    recording: Option<String>,
    /// Report the milestones, and write nothing
    #[arg(long)]
    dry_run: bool,
}

pub(super) fn run(cli: &CommandLine, args: &MilestonesArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let options = MilestoneOptions {
        function: args.function.as_deref().map(ExpressionFunction::from_function_name),
        tier: args.tier.clone(),
        recording: args.recording.as_deref().map(str::parse).transpose()?,
        dry_run: args.dry_run,
    };
    let milestone_table = with_progress_bar(|progress| corpus.derive_face_milestones(&options, progress))?;
    let seconds = |at: chereme_corpus::RecordingInstant| format!("{:.3}", at.instant_seconds());
    // An empty table says nothing of why: no tier names functions, or none of this name.
    if milestone_table.expressions.is_empty() {
        let known_functions: Vec<String> = milestone_table
            .functions
            .iter()
            .map(|(name, count)| format!("{name} ({count})"))
            .collect();
        output.write_output_line(match known_functions.is_empty() {
            true => {
                "no tier names functions; annotate wh, yn, negation or topic on a tier called \"function\"".to_owned()
            }
            false => format!("no such expression; the functions are: {}", known_functions.join(", ")),
        })?;
    } else {
        output.write_item_table(
            &milestone_table.expressions,
            &[
                ("recording", &|entry| entry.recording.clone()),
                ("address", &|entry| entry.address.clone()),
                ("function", &|entry| entry.function.to_string()),
                ("signs", &|entry| entry.signs.join(" ")),
                ("M1", &|entry| seconds(entry.milestones.m1)),
                ("M2", &|entry| seconds(entry.milestones.m2)),
                ("M3", &|entry| entry.milestones.m3.map_or("-".to_owned(), seconds)),
                ("M4", &|entry| seconds(entry.milestones.m4)),
                ("M5", &|entry| seconds(entry.milestones.m5)),
                ("findings", &|entry| match entry.corrected {
                    true => "corrected".to_owned(),
                    false => entry.findings.join("; "),
                }),
            ],
        )?;
        output.filled_line(
            "phases written: {n}; expressions that keep corrected milestones: {kept}",
            &[&milestone_table.written, &milestone_table.kept],
        )?;
    }
    output.set_json_document(milestone_table)
}
