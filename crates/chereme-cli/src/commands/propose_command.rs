//! `chereme propose`: proposes values of components and detections from movement, and accepts proposals.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{
    AcceptanceResult, Corpus, CorpusAddress, DetectOptions, ProposalChoice, ProposalResult, ProposeOptions,
    ProposeScope, ProposedCoding,
};
use chereme_sign::SignComponent;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Propose values of a component from movement, for tokens without a value of it; or run a detector on recordings
///
/// Handshape and palm of each hand are read at their holds, places from the whole sign; all of them are written in the time
/// of a hold, and movements in the time of their acts. The values are written on separate tiers, such as "configuration dominant (proposed)", as
/// annotations of a detector; "moving" says that nothing is held there. They do not count in searches, counts, statistics, recipes and
/// exports of tokens until a person accepts them; the condition `proposed:yes` reads them. A call is one operation, which
/// `undo` takes back. Ctrl-C stops it and leaves the corpus as it was.
///
/// With --detector no transcription runs; it is short for `detect --propose`.
///
/// With --accept, proposals become your own codings on the tiers that you have for that component and hand; empty tiers of
/// proposals are removed. Without numbers all are accepted, or those of a component, --for, --tier and --confidence. With
/// --reject they stay on tiers such as "configuration dominant (rejected)", count nowhere and are not proposed again.
///
/// `--json` gives "tokens" and "annotations", the numbers of those that were written, "unread", the number of tokens
/// whose movement could not be transcribed, "recordings", the names of those with new annotations, "by_confidence", the
/// numbers of annotations for each tenth of confidence, and "codings", the values, each with "token", "gloss", "field",
/// "value", "start_us", "end_us", "confidence", "is_moving" if nothing is held, and "runner_up" in words of notation. With --accept or --reject it gives what `annotate` gives, and "left", the number
/// of proposals for which there is no room. With --detector it gives what `detect` gives.
#[derive(Debug, clap::Args)]
#[command(group = clap::ArgGroup::new("decision").args(["accept", "reject"]), after_help = "\
Examples:
  chereme propose mine.chereme configuration
  chereme propose mine.chereme --for recording:3
  chereme propose mine.chereme --detector signs --for recording:3
  chereme propose mine.chereme --accept 41 42
  chereme propose mine.chereme configuration --for recording:3 --accept --confidence 0.8
  chereme propose mine.chereme --reject 43
  chereme search mine.chereme \"configuration=U proposed:yes\"    (finds proposed codings, too)
  chereme undo mine.chereme                      (takes all of them back)")]
pub(crate) struct ProposeArgs {
    /// The corpus
    corpus: PathBuf,
    /// The component: configuration (or handshape), placement, movement or orientation; without it all four
    component: Option<SignComponent>,
    /// Only for the tokens of this recording, or for this token
    #[arg(long = "for", value_name = "ADDRESS")]
    only: Option<String>,
    /// Run this detector on every recording, or on that of --for
    #[arg(long, value_name = "NAME", value_parser = super::detect_command::list_detector_names(), conflicts_with = "component")]
    detector: Option<String>,
    /// Accept these proposals, by the numbers of their annotations, as codings of your own; without numbers all that the other options name
    #[arg(long, value_name = "NUMBER", conflicts_with = "detector", num_args = 0..)]
    accept: Option<Vec<i64>>,
    /// Reject these proposals, by the numbers of their annotations; without numbers all that the other options name
    #[arg(long, value_name = "NUMBER", conflicts_with = "detector", num_args = 0..)]
    reject: Option<Vec<i64>>,
    /// Accept or reject those of tiers with this name
    #[arg(long, value_name = "NAME", requires = "decision")]
    tier: Vec<String>,
    /// Accept or reject those with this confidence or more, from 0 to 1
    #[arg(long, value_name = "NUMBER", requires = "decision")]
    confidence: Option<f64>,
}

/// The most values that are listed; more are counted.
const MOST_SHOWN_CODINGS: usize = 60;

fn print_proposed_codings(codings: &[ProposedCoding], output: &mut CommandOutput) -> Result<()> {
    let seconds = |micros: i64| micros as f64 / 1e6;
    let moving = output.translate_message("moving");
    output.write_item_table(
        codings,
        &[
            ("gloss", &|coding| coding.gloss.clone()),
            ("field", &|coding| coding.field.clone()),
            ("value", &|coding| coding.proposed.value.clone()),
            ("seconds", &|coding| {
                let times = format!(
                    "{:.2}-{:.2}",
                    seconds(coding.proposed.start_us),
                    seconds(coding.proposed.end_us)
                );
                if coding.proposed.is_moving {
                    format!("{times} ({moving})")
                } else {
                    times
                }
            }),
            ("confidence", &|coding| format!("{:.2}", coding.proposed.confidence)),
            ("runner-up", &|coding| {
                coding.proposed.runner_up.clone().unwrap_or_default()
            }),
        ],
    )
}

/// Accepts or rejects the proposals of these numbers, or without numbers those that the other options name.
fn settle_proposals(
    corpus: &mut Corpus,
    args: &ProposeArgs,
    scope: ProposeScope,
    numbers: &[i64],
    output: &mut CommandOutput,
) -> Result<()> {
    // Numbers and conditions could contradict each other.
    let is_narrowed = args.component.is_some() || args.only.is_some() || !args.tier.is_empty();
    if !numbers.is_empty() && (is_narrowed || args.confidence.is_some()) {
        anyhow::bail!(
            "numbers of annotations name proposals already: leave out the component, --for, --tier and --confidence"
        );
    }
    let choice = ProposalChoice {
        scope,
        tiers: args.tier.clone(),
        components: args.component.into_iter().collect(),
        least_confidence: args.confidence,
    };
    if args.reject.is_some() {
        let numbers = match numbers {
            [] => corpus.find_proposals(&choice)?,
            numbers => numbers.to_vec(),
        };
        let report = with_progress_bar(|progress| corpus.reject_proposals(&numbers, progress))?;
        output.filled_line(
            "{n} rejected",
            &[&output.format_counted_noun(numbers.len() as u64, "annotations")],
        )?;
        return output.set_json_document(AcceptanceResult { report, left: 0 });
    }
    let accepted = match numbers {
        [] => with_progress_bar(|progress| corpus.accept_chosen_proposals(&choice, progress))?,
        numbers => AcceptanceResult {
            report: with_progress_bar(|progress| corpus.accept_proposals(numbers, progress))?,
            left: 0,
        },
    };
    output.filled_line(
        "{n} accepted",
        &[&output.format_counted_noun(accepted.report.added, "annotations")],
    )?;
    if accepted.left > 0 {
        output.filled_line(
            "left, because something else lies in their place: {n}",
            &[&output.format_counted_noun(accepted.left, "annotations")],
        )?;
    }
    output.set_json_document(accepted)
}

pub(super) fn run(cli: &CommandLine, args: &ProposeArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let scope = match &args.only {
        None => ProposeScope::All,
        Some(only) => corpus.propose_scope(&only.parse::<CorpusAddress>()?)?,
    };
    if let Some(numbers) = args.accept.as_ref().or(args.reject.as_ref()) {
        return settle_proposals(&mut corpus, args, scope, numbers, output);
    }
    if let Some(detector) = &args.detector {
        // An older spelling of `detect --propose`.
        let options = DetectOptions::propose_with(detector, scope);
        return super::detect_command::run_and_report_detection(&mut corpus, &options, output);
    }
    let options = ProposeOptions {
        components: match args.component {
            Some(component) => vec![component],
            None => ProposalResult::READABLE_COMPONENTS.to_vec(),
        },
        scope,
    };
    let proposed = with_progress_bar(|progress| corpus.propose_components(&options, progress))?;
    output.filled_line(
        "{annotations} in {recordings}, for {tokens}; {unread} could not be read from movement",
        &[
            &output.format_counted_noun(proposed.annotations, "annotations"),
            &output.format_counted_noun(proposed.recordings.len() as u64, "recordings"),
            &output.format_counted_noun(proposed.tokens, "tokens"),
            &output.format_counted_noun(proposed.unread, "tokens"),
        ],
    )?;
    if (1..=MOST_SHOWN_CODINGS).contains(&proposed.codings.len()) {
        print_proposed_codings(&proposed.codings, output)?;
    }
    if !proposed.by_confidence.is_empty() {
        let counts = proposed.by_confidence.iter().rev();
        let counts: Vec<String> = counts.map(|(tenth, count)| format!("{tenth}: {count}")).collect();
        output.filled_line("by confidence, from: {counts}", &[&counts.join(", ")])?;
    }
    output.write_warnings(&proposed.findings)?;
    if !proposed.uncut.is_empty() {
        output.write_note("`chereme detect CORPUS signs in RECORDING --propose` cuts takes into signs")?;
    }
    output.set_json_document(proposed)
}
