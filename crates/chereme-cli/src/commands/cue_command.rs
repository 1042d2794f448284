//! `chereme cue`: generates the hand of cued speech for a text.

use std::path::PathBuf;

use anyhow::{Result, bail};
use chereme_corpus::recipe::PhaseRule;
use chereme_corpus::{CueOptions, cue_phones_of_file};
use chereme_sign::cue::PhoneAlphabet;

use super::keys_command::SpokenInput;
use crate::args::{CommandLine, NamedChoices};
use crate::output::CommandOutput;

/// Generate cued speech for a text: the cueing hand next to the speaking face, on any body
///
/// Rules of spelling turn French text into phones. With --phones the input itself is phones; --from takes phones, words
/// or sentences and their times from a file with annotations, such as a TextGrid, EAF, XRA or SRT file. With --as the movement is stored as a new sign with tiers for phones,
/// keys, hand and fingers; then the query `cue.shape=5 cue.placement=throat` finds its keys, and `cue=24 meets cue=31`
/// finds pairs of keys.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme cue mine.chereme 'le chat dort' --draw chat.png
  chereme cue mine.chereme 'le chat dort' --signer Anna --as CHAT_DORT --by attina
  chereme cue mine.chereme --from talk.TextGrid --as TALK --explain
  chereme cue mine.chereme 'b=60 O~=200 Z=94 u=178 R=74' --phones sampa --left")]
pub(crate) struct CueArgs {
    /// The corpus
    corpus: PathBuf,
    #[command(flatten)]
    spoken: SpokenInput,
    /// The body that cues: that of a signer (signer:NAME), or the skeleton of a recording (recording:NAME); without it
    /// the program chooses one
    #[arg(long, value_name = "SIGNER")]
    signer: Option<String>,
    /// The rule for the timing of hand and fingers
    #[arg(long, value_parser = PHASE_RULE_CHOICES, default_value = "paper")]
    by: PhaseRule,
    /// The duration of sounds as a multiple of the usual one, from 0.1 to 10; without it 1.6
    #[arg(long, value_name = "FACTOR")]
    pace: Option<f64>,
    /// Cue with the left hand
    #[arg(long)]
    left: bool,
    /// The gloss of the new sign; without it nothing is stored
    #[arg(long = "as", value_name = "GLOSS")]
    gloss: Option<String>,
    /// Explain the movement
    #[arg(long)]
    explain: bool,
    /// Draw the movement to a contact sheet (.png) or an animation (.gif)
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
}

/// The rules for the timing of hand and fingers.
pub(super) const PHASE_RULE_CHOICES: NamedChoices<PhaseRule> = NamedChoices(&[
    ("paper", "", PhaseRule::Paper),
    ("attina", "", PhaseRule::Attina),
    ("sppas", "", PhaseRule::Sppas),
    ("duchnowski", "", PhaseRule::Duchnowski),
    ("measured", "", PhaseRule::Measured),
]);

pub(super) fn run(cli: &CommandLine, args: &CueArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let spoken = &args.spoken;
    let mut findings = Vec::new();
    let (text, reading) = match (&spoken.from, &spoken.text) {
        (Some(path), _) => {
            let mut reading = spoken.spoken_keys_options(args.pace, output)?;
            let (phones, odd) = cue_phones_of_file(path, spoken.tier.as_deref(), &reading)?;
            findings = odd;
            // The file was read into SAMPA, whatever its own alphabet.
            reading.phones = Some(PhoneAlphabet::Sampa);
            reading.dictionary = None;
            (phones, reading)
        }
        (None, Some(text)) => spoken.read_spoken_input(text, args.pace, output)?,
        (None, None) => bail!("there is nothing to cue; write a text, or --from FILE"),
    };
    let options = CueOptions {
        reading,
        signer: args.signer.clone(),
        phase: args.by,
        left: args.left,
    };
    let mut done = corpus.generate_cued_speech(&text, &options, args.gloss.as_deref())?;
    if args.explain {
        output.write_warnings(&findings)?;
    }
    // The explanation prints no warnings, JSON and the usual report do.
    done.report.warnings.append(&mut findings);
    super::recombine_command::print_recombination(&done, args.explain, args.draw.as_deref(), output)
}
