//! `chereme cue`.

use std::path::PathBuf;

use anyhow::{Result, bail};
use chereme_corpus::recipe::PhaseRule;
use chereme_corpus::{CueOptions, KeysOptions, cue_phones_of_file};
use chereme_sign::cue::Alphabet;
use clap::ValueEnum;

use super::keys::{AlphabetWord, SchwaWord};
use crate::args::Cli;
use crate::output::Output;

/// Cue a text: the hand of cued speech next to the speaking face, on any body
///
/// French text is read by rules of spelling, phones with --phones; --from takes phones and their times from a
/// TextGrid or an EAF file. With --as the movement is stored as a new sign with tiers for phones, keys, hand
/// and fingers: `cue.shape=5 cue.placement=throat` finds its keys, `cue=24 meets cue=31` pairs of them.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme cue mine.chereme 'le chat dort' --draw chat.png
  chereme cue mine.chereme 'le chat dort' --signer Anna --as CHAT_DORT --by attina
  chereme cue mine.chereme --from talk.TextGrid --as TALK --explain
  chereme cue mine.chereme 'b=60 O~=200 Z=94 u=178 R=74' --phones sampa --left")]
pub(crate) struct Args {
    /// The corpus
    corpus: PathBuf,
    /// The text, or the phones separated by blanks (a=120 is a phone of 120 ms)
    #[arg(required_unless_present = "from")]
    text: Option<String>,
    /// Take phones and times from this TextGrid or EAF file
    #[arg(long, value_name = "FILE", conflicts_with = "text")]
    from: Option<PathBuf>,
    /// The tier of phones in that file; else the first that is called as aligners call it
    #[arg(long, value_name = "TIER", requires = "from")]
    tier: Option<String>,
    /// Read the input as phones in this alphabet
    #[arg(long, value_enum, value_name = "ALPHABET")]
    phones: Option<AlphabetWord>,
    /// The code: french or english-us
    #[arg(long, default_value = "french")]
    code: String,
    /// A habit of some cuers, such as schwa-as-eu; may be repeated
    #[arg(long = "variant", value_name = "NAME")]
    variants: Vec<String>,
    /// Leave silent last consonants silent before a vowel
    #[arg(long)]
    no_liaison: bool,
    /// When an e at the end of a word is said
    #[arg(long, value_enum, default_value = "usual")]
    schwa: SchwaWord,
    /// Whose body cues: a signer, or a recording for its skeleton; else the corpus chooses
    #[arg(long, value_name = "SIGNER")]
    signer: Option<String>,
    /// Which rule says when the hand is where
    #[arg(long, value_enum, default_value = "paper")]
    by: RuleWord,
    /// Sounds last FACTOR times as long as usual, from 0.1 to 10; else 1.6
    #[arg(long, value_name = "FACTOR")]
    pace: Option<f64>,
    /// Cue with the left hand
    #[arg(long)]
    left: bool,
    /// The gloss of the new sign; without it nothing is stored
    #[arg(long = "as", value_name = "GLOSS")]
    gloss: Option<String>,
    /// Show how the movement comes about
    #[arg(long)]
    explain: bool,
    /// Draw the movement to a contact sheet (.png) or an animation (.gif)
    #[arg(long, value_name = "FILE")]
    draw: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum RuleWord {
    Paper,
    Attina,
    Sppas,
    Duchnowski,
    Measured,
}

impl From<RuleWord> for PhaseRule {
    fn from(word: RuleWord) -> Self {
        match word {
            RuleWord::Paper => Self::Paper,
            RuleWord::Attina => Self::Attina,
            RuleWord::Sppas => Self::Sppas,
            RuleWord::Duchnowski => Self::Duchnowski,
            RuleWord::Measured => Self::Measured,
        }
    }
}

pub(super) fn run(cli: &Cli, args: &Args, output: &mut Output) -> Result<()> {
    let mut corpus = cli.open(&args.corpus)?;
    let mut reading = KeysOptions {
        code: args.code.clone(),
        phones: args.phones.map(Alphabet::from),
        variants: args.variants.clone(),
        french: chereme_sign::cue::french::Options {
            liaison: !args.no_liaison,
            schwa: args.schwa.into(),
        },
        pace: args.pace,
    };
    let text = match (&args.from, &args.text) {
        (Some(path), _) => {
            let phones = cue_phones_of_file(path, args.tier.as_deref(), &reading)?;
            reading.phones = Some(Alphabet::Sampa);
            phones
        }
        (None, Some(text)) => text.clone(),
        (None, None) => bail!("there is nothing to cue; write a text, or --from FILE"),
    };
    let options = CueOptions {
        reading,
        signer: args.signer.clone(),
        phase: args.by.into(),
        left: args.left,
    };
    let done = corpus.cue(&text, &options, args.gloss.as_deref())?;
    super::recombine::tell(&done, args.explain, args.draw.as_deref(), output)
}
