//! `chereme animate`: generates movement from HamNoSys or SiGML on a body of the corpus.

use std::path::PathBuf;

use anyhow::Result;
use chereme_corpus::NotationStaging;

use crate::args::CommandLine;
use crate::output::CommandOutput;
use crate::streams;

/// Synthesise movement from notation: HamNoSys or SiGML, on any body
///
/// The notation is a SiGML file; HamNoSys in quotes, as characters or as names of symbols; a file with lines of
/// HamNoSys (.hns or .txt); or a sign that the corpus holds as notation, such as a gloss or token:41. Several signs are
/// performed one after another, and the hands move straight from one to the next. With --as the movement is stored as a
/// new sign, with its own tiers and its recipe.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme animate ngt.chereme BABYSITTEN --draw babysitten.png
  chereme animate ngt.chereme HALLO VRIEND DANK_JE --as GROET --explain
  chereme animate mine.chereme 'hamflathand hamextfingeru hampalml hamchin hamtouch' --signer Anna
  chereme animate mine.chereme thanks.sigml --signer take1 --as THANKS")]
pub(crate) struct AnimateArgs {
    /// The corpus
    corpus: PathBuf,
    /// The notation: a file, HamNoSys text, or a notated sign; - is SiGML or HamNoSys from standard input
    #[arg(required = true)]
    notation: Vec<String>,
    /// The body that signs: that of a signer (signer:NAME), or the skeleton of a recording (recording:NAME); without it
    /// the program chooses one
    #[arg(long, value_name = "SIGNER")]
    signer: Option<String>,
    /// The size, duration and depth of movements: default; quiet (the default without sway, blinks and other movement
    /// that the notation does not write); measured (every number that at least eight captured signs of the corpus show,
    /// else the default); or a JSON file of your own numbers, as in schema/notation/body_language.json; without the
    /// option measured
    #[arg(long, value_name = "LANGUAGE")]
    language: Option<String>,
    /// The gloss of the new sign; without it nothing is stored
    #[arg(long = "as", value_name = "GLOSS")]
    gloss: Option<String>,
    /// Explain the movement: strokes, residuals, approximations
    #[arg(long)]
    explain: bool,
    /// Draw the movement to a contact sheet (.png), an animation (.gif) or a film (.mp4)
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
}

pub(super) fn run(cli: &CommandLine, args: &AnimateArgs, output: &mut CommandOutput) -> Result<()> {
    let mut corpus = cli.open_cli_corpus(&args.corpus)?;
    let mut notation = args.notation.clone();
    let mut stands = Vec::new();
    for text in notation.iter_mut().filter(|text| *text == "-") {
        // SiGML is read from files; a line of HamNoSys is used directly.
        let read = streams::read_stdin_text()?;
        *text = if read.trim_start().starts_with('<') {
            let stand = streams::stdout_stand_in("stdin", "sigml")?;
            std::fs::write(&stand.path, read)?;
            let path = stand.path.display().to_string();
            stands.push(stand);
            path
        } else {
            read.trim().to_owned()
        };
    }
    let notation: Vec<&str> = notation.iter().map(String::as_str).collect();
    let staging = NotationStaging {
        signer: args.signer.as_deref(),
        language: args.language.as_deref(),
    };
    let done = corpus.animate_notation(&notation, &staging, args.gloss.as_deref())?;
    super::recombine_command::print_recombination(&done, args.explain, args.draw.as_deref(), output)
}
