//! `chereme propose`: proposes values of components and detections from movement, and accepts proposals.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{
    ALL_DETECTORS, AnnotationDetector, CorpusAddress, DetectOptions, ProgressReceiver, ProgressStep, ProposalResult,
    ProposeOptions, ProposeScope,
};
use chereme_sign::SignComponent;
use clap::builder::PossibleValue;

use crate::args::CommandLine;
use crate::output::{CommandOutput, CommandProgressBar};

/// Propose values of a component from movement, for tokens without a value of it; or run a detector on recordings
///
/// The movement of each token is transcribed, and the values are written on separate tiers, such as "configuration
/// dominant (proposed)", as annotations of a detector. They never mix with a person's codings. A call is one operation,
/// which `undo` takes back. Ctrl-C stops it and leaves the corpus as it was.
///
/// With --detector no transcription runs: the detector examines whole recordings, and its detections are written on
/// tiers such as "movement.phase right (proposed)", where they replace earlier ones that nobody has changed.
///
/// `--json` gives "tokens" and "annotations", the numbers of those that were written, "unread", the number of tokens
/// whose movement could not be transcribed, and "recordings", the names of those with new annotations. With --detector
/// it gives "detector", "annotations", "recordings", "unobserved", the number of recordings without the part that the
/// detector examines, and "found", the proposals of each recording with tier, times, value, confidence and evidence.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme propose mine.chereme configuration
  chereme propose mine.chereme --for recording:3
  chereme propose mine.chereme --detector strokes --for recording:3
  chereme propose mine.chereme --accept 41 42
  chereme search mine.chereme configuration=U    (finds proposed codings, too)
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
    #[arg(long, value_name = "NAME", value_parser = detectors(), conflicts_with = "component")]
    detector: Option<String>,
    /// Accept these proposals, by the numbers of their annotations, as codings of your own
    #[arg(long, value_name = "NUMBER", conflicts_with_all = ["component", "only", "detector"], num_args = 1..)]
    accept: Vec<i64>,
}

/// Returns the names of all detectors, each with the annotations that it finds.
fn detectors() -> Vec<PossibleValue> {
    let named = |detector: &&dyn AnnotationDetector| {
        PossibleValue::new(detector.detector_name()).help(detector.detector_description().finds.en)
    };
    ALL_DETECTORS.iter().map(named).collect()
}

pub(super) fn run(cli: &CommandLine, args: &ProposeArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let mut bar = CommandProgressBar::new();
    let mut hear = |step: ProgressStep<'_>| bar.show_progress_step(step);
    let mut progress = ProgressReceiver::new(&mut hear);
    if !args.accept.is_empty() {
        let report = corpus.accept_proposals(&args.accept, &mut progress)?;
        drop(bar);
        output.filled_line(
            "{n} accepted",
            &[&output.format_counted_noun(report.added, "annotations")],
        )?;
        return output.set_json_document(report);
    }
    let scope = match &args.only {
        None => ProposeScope::All,
        Some(only) => corpus.propose_scope(&only.parse::<CorpusAddress>()?)?,
    };
    if let Some(detector) = &args.detector {
        let options = DetectOptions {
            detector: detector.clone(),
            scope,
        };
        let detected = corpus.run_detection(&options, &mut progress)?;
        drop(bar);
        output.filled_line(
            "proposed: {annotations} in {recordings}",
            &[
                &output.format_counted_noun(detected.annotations, "annotations"),
                &output.format_counted_noun(detected.recordings.len() as u64, "recordings"),
            ],
        )?;
        if detected.unobserved > 0 {
            let unobserved = output.format_counted_noun(detected.unobserved, "recordings");
            output.filled_line("nothing to examine in {recordings}", &[&unobserved])?;
        }
        return output.set_json_document(detected);
    }
    let options = ProposeOptions {
        components: match args.component {
            Some(component) => vec![component],
            None => ProposalResult::READABLE_COMPONENTS.to_vec(),
        },
        scope,
    };
    let proposed = corpus.propose_components(&options, &mut progress)?;
    drop(bar);
    output.filled_line(
        "{annotations} in {recordings}, for {tokens}; {unread} could not be read from movement",
        &[
            &output.format_counted_noun(proposed.annotations, "annotations"),
            &output.format_counted_noun(proposed.recordings.len() as u64, "recordings"),
            &output.format_counted_noun(proposed.tokens, "tokens"),
            &output.format_counted_noun(proposed.unread, "tokens"),
        ],
    )?;
    for finding in &proposed.findings {
        output.write_warning(finding)?;
    }
    output.set_json_document(proposed)
}
