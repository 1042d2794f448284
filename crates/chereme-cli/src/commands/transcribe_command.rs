//! `chereme transcribe`: writes the movement of a sign as HamNoSys.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::{CorpusAddress, ProgressReceiver, TranscribedFeature};

use crate::args::CommandLine;
use crate::output::{CommandOutput, CommandProgressBar};

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
    let mut bar = CommandProgressBar::new();
    let progress = &mut ProgressReceiver::new(&mut bar);
    let written = if args.store {
        corpus.store_transcription(&address, args.force, progress)?
    } else {
        corpus.transcribe_movement(&address, progress)?
    };
    drop(bar);
    if args.names {
        output.line_as_is(&written.symbols.join(" "))?;
    } else {
        output.line_as_is(&format!("{}: {}", written.gloss, written.hamnosys))?;
        output.line_as_is(&written.symbols.join(" "))?;
        let rows: Vec<Vec<String>> = written.features.iter().map(transcribed_feature_row).collect();
        output.write_titled_table(
            &["feature", "hand", "action", "seconds", "value", "residual", "runner-up"],
            &rows,
        )?;
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

fn micros_to_seconds(micros: i64) -> f64 {
    micros as f64 / 1e6
}

fn transcribed_feature_row(feature: &TranscribedFeature) -> Vec<String> {
    let residual = |residual: f64| format!("{residual:.1}{}", feature.unit.residual_unit_symbol());
    vec![
        feature.feature.feature_kind_name().to_owned(),
        feature
            .hand
            .map_or_else(String::new, |hand| hand.body_side_name().to_owned()),
        feature.action.map_or_else(String::new, |n| n.to_string()),
        format!(
            "{:.2}-{:.2}",
            micros_to_seconds(feature.start_us),
            micros_to_seconds(feature.end_us)
        ),
        feature.value.value.clone(),
        residual(feature.value.residual),
        feature.runner_up.as_ref().map_or_else(String::new, |next| {
            format!("{}, {}", next.value, residual(next.residual))
        }),
    ]
}
