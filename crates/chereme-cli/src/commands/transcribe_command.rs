//! `chereme transcribe`: writes the movement of a sign as HamNoSys.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{CorpusAddress, TranscribedFeature};
use chereme_motion::BodySide;

use crate::args::CommandLine;
use crate::output::{CommandOutput, with_progress_bar};

/// Transcribe a captured or generated sign in HamNoSys, with the residual of each feature
///
/// The residual is the distance of the movement from its transcription, and the runner-up is the second-best reading.
/// Only a HamNoSys font shows the characters; their names are printed below them, `--names` prints nothing else, and
/// `render TOKEN --to it.svg` draws a stored notation.
///
/// If a sign was generated from notation alone, the program animates its transcription as a check. If its hands move
/// differently, it tries similar movements and other postures. Values that it replaces have two residuals in cm: how far
/// the hands are from the observed ones with the new value and with the old one, on average. It also reads the acts of
/// trunk, head and shoulders, such as body.TF or head.SR in the codes of SiGML. That takes up to a minute; Ctrl-C stops it.
///
/// `--json` gives "gloss", "token", "recording", "start_us", "end_us", the whole as "hamnosys" and "symbols" and as the
/// tree "sign"; "stages", the posture at the beginning and each action with "action", "hand", "start_us", "end_us",
/// "hamnosys", "symbols"; "features", each with "feature", "hand", "action" (null for the posture), "at_us",
/// "start_us", "end_us", "value", "hamnosys", "symbols", "residual", "unit" (deg, cm or share) and "runner_up"
/// ("value", "hamnosys", "symbols", "residual"; null if there is no second reading); "nonmanual", the tiers with acts
/// that were read; "findings". Times are microseconds from the start of the recording.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme transcribe mine.chereme ESCARGOT
  chereme transcribe mine.chereme token:41 --names
  chereme transcribe mine.chereme token:41 --store   (then: export mine.chereme token:41 --to it.sigml)")]
pub(crate) struct TranscribeArgs {
    /// The corpus
    corpus: PathBuf,
    /// The movement to transcribe: a gloss, token:41, or recording:3 if it is short
    token: String,
    /// Write the names of the symbols in place of the table
    #[arg(long)]
    names: bool,
    /// Store the transcription as the token's notation; `undo` takes it back
    #[arg(long)]
    store: bool,
    /// Replace the notation that the token has already
    #[arg(long, requires = "store")]
    force: bool,
}

pub(super) fn run(cli: &CommandLine, args: &TranscribeArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let address: CorpusAddress = args.token.parse()?;
    let written = with_progress_bar(|progress| match args.store {
        true => corpus.store_transcription(&address, args.force, progress),
        false => corpus.transcribe_movement(&address, progress),
    })?;
    if args.names {
        output.line_as_is(&written.symbols.join(" "))?;
    } else {
        output.line_as_is(&format!("{}: {}", written.gloss, written.hamnosys))?;
        output.line_as_is(&written.symbols.join(" "))?;
        print_transcribed_features(&written.features, output)?;
        let act_names = written.nonmanual.acts_by_tier().map(|(_, act)| act.act_curve_name());
        let acts: Vec<String> = act_names.collect();
        if !acts.is_empty() {
            output.line_as_is(&acts.join(" "))?;
        }
        for finding in &written.findings {
            output.line_as_is(&output.translate_message(finding))?;
        }
    }
    output.set_json_document(written)
}

fn print_transcribed_features(features: &[TranscribedFeature], output: &mut CommandOutput) -> Result<()> {
    let seconds = |micros: i64| micros as f64 / 1e6;
    let with_residual =
        |feature: &TranscribedFeature, residual: f64| format!("{residual:.1}{}", feature.unit.residual_unit_symbol());
    let runner_up = |feature: &TranscribedFeature| match &feature.runner_up {
        Some(next) => format!("{}, {}", next.value, with_residual(feature, next.residual)),
        None => String::new(),
    };
    output.write_item_table(
        features,
        &[
            ("feature", &|feature| feature.feature.feature_kind_name().to_owned()),
            ("hand", &|feature| {
                feature.hand.map_or("", BodySide::body_side_name).to_owned()
            }),
            ("action", &|feature| {
                feature.action.map_or_else(String::new, |n| n.to_string())
            }),
            ("seconds", &|feature| {
                format!("{:.2}-{:.2}", seconds(feature.start_us), seconds(feature.end_us))
            }),
            ("value", &|feature| feature.value.value.clone()),
            ("residual", &|feature| with_residual(feature, feature.value.residual)),
            ("runner-up", &runner_up),
        ],
    )
}
