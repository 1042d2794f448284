//! `chereme detect`: what a detector finds in recordings: signs with the phases of each hand, or actions of the face.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::words::InterfaceLanguage;
use chereme_corpus::{ALL_DETECTORS, AnnotationDetector, Corpus, CutOptions, DetectOptions, DetectionUse};
use clap::builder::PossibleValue;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Cut takes into signs, or run another detector on recordings
///
/// The detector "signs" finds the signs between rests, and the preparation, stroke, hold and retraction of each hand. Several
/// signs without a rest between them are parted by a model that was learned on generated signing; --more and --fewer, or
/// --cost, change how readily it does so. The other detectors are listed below.
///
/// Without --propose and --store the result is shown, and nothing is written. With --propose it is written on tiers such as
/// "gloss (proposed)", where it replaces earlier proposals that nobody has changed; `propose --accept` accepts them. With --store
/// it becomes your own codings, except where something else lies. The gloss of a sign that was found is UNGLOSSED. A call is one
/// operation, which `undo` takes back. Odd frames at the ends of a take are left out.
///
/// `--json` gives "detector", "annotations", the number of those that were written, "recordings", the names of those with new
/// annotations, "unobserved", the number of recordings without the part that the detector examines, "found", the proposals
/// of each recording with tier, times, value, confidence and evidence, and "without", the recordings in which nothing was
/// found, with the reason.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme detect mine.chereme signs
  chereme detect mine.chereme signs in recording:3 --propose
  chereme detect mine.chereme signs in recording:3 --more --propose
  chereme detect mine.chereme signs in \"gloss=BO*\" --store
  chereme propose mine.chereme --for recording:3 --accept --tier gloss
  chereme undo mine.chereme                      (takes all of them back)")]
pub(crate) struct DetectArgs {
    /// The corpus
    corpus: PathBuf,
    /// The detector
    #[arg(value_name = "DETECTOR", value_parser = list_detector_names())]
    detector: String,
    /// Only in this recording or token, or in the recordings of the tokens that a query finds: `in` and its address or query
    #[arg(value_name = "in WHERE", num_args = 0..)]
    place: Vec<String>,
    /// Write what is found on tiers of proposals
    #[arg(long, conflicts_with = "store")]
    propose: bool,
    /// Write what is found as codings of your own
    #[arg(long)]
    store: bool,
    /// Find more signs; twice for still more
    #[arg(long, action = clap::ArgAction::Count, conflicts_with_all = ["fewer", "cost"])]
    more: u8,
    /// Find fewer signs; twice for still fewer
    #[arg(long, action = clap::ArgAction::Count, conflicts_with = "cost")]
    fewer: u8,
    /// The cost of a sign: 4 is usual, 0 gives a quarter too many signs
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    cost: Option<f64>,
}

/// Returns the names of all detectors, each with the annotations that it finds.
pub(super) fn list_detector_names() -> Vec<PossibleValue> {
    let named = |detector: &&dyn AnnotationDetector| {
        PossibleValue::new(detector.detector_name()).help(
            detector
                .detector_description()
                .finds
                .text_in_language(InterfaceLanguage::English),
        )
    };
    ALL_DETECTORS.iter().map(named).collect()
}

impl DetectArgs {
    fn sign_cost(&self) -> Option<f64> {
        let steps = i32::from(self.more) - i32::from(self.fewer);
        self.cost
            .or_else(|| (steps != 0).then(|| CutOptions::with_more_signs(steps).sign_cost))
    }
}

pub(super) fn run(cli: &CommandLine, args: &DetectArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let words = match args.place.as_slice() {
        [first, rest @ ..] if first == "in" => rest,
        all => all,
    };
    let scope = corpus.propose_scope_of_text(&words.join(" "))?;
    let options = DetectOptions {
        detector: args.detector.clone(),
        scope,
        use_as: match (args.propose, args.store) {
            (_, true) => DetectionUse::Coded,
            (true, _) => DetectionUse::Proposed,
            _ => DetectionUse::Shown,
        },
        sign_cost: args.sign_cost(),
    };
    run_and_report_detection(&mut corpus, &options, output)
}

/// Runs a detector, and prints what it finds.
pub(super) fn run_and_report_detection(
    corpus: &mut Corpus,
    options: &DetectOptions,
    output: &mut CommandOutput,
) -> Result<()> {
    let detected = with_progress_bar(|progress| corpus.run_detection(options, progress))?;
    // Only detections that are not stored are listed: the others are read in their tiers.
    if options.use_as == DetectionUse::Shown {
        let seconds = |micros: i64| format!("{:.3}", micros as f64 / 1e6);
        let mut rows = Vec::new();
        for take in &detected.found {
            rows.extend(take.proposals.iter().map(|proposal| {
                vec![
                    take.recording.clone(),
                    proposal.tier.clone(),
                    seconds(proposal.start_us),
                    seconds(proposal.end_us),
                    proposal.value.clone(),
                    format!("{:.2}", proposal.confidence),
                    output.translate_message(&proposal.why),
                ]
            }));
        }
        let titles = ["recording", "tier", "start", "end", "value", "confidence", "rule"];
        output.write_titled_table(&titles, &rows)?;
    } else {
        let form = match options.use_as {
            DetectionUse::Coded => "coded: {annotations} in {recordings}",
            DetectionUse::Shown | DetectionUse::Proposed => "proposed: {annotations} in {recordings}",
        };
        let annotations = output.format_counted_noun(detected.annotations, "annotations");
        let recordings = output.format_counted_noun(detected.recordings.len() as u64, "recordings");
        output.filled_line(form, &[&annotations, &recordings])?;
    }
    for take in &detected.without {
        let why = output.translate_message(&take.why);
        output.filled_line("nothing found in {recording}: {why}", &[&take.recording, &why])?;
    }
    if detected.unobserved > 0 {
        let unobserved = output.format_counted_noun(detected.unobserved, "recordings");
        output.filled_line("nothing to examine in {recordings}", &[&unobserved])?;
    }
    output.set_json_document(detected)
}
