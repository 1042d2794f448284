//! `chereme keys`: prints the keys of cued speech for a text, and reads texts and phones for other commands.

use std::path::PathBuf;

use anyhow::{Result, bail};
use chereme_corpus::{
    CueKey, KeysOptions, cue_keys, cue_keys_of_file, cue_phones_of_espeak, read_pronunciation_dictionary,
};
use chereme_sign::cue::PhoneAlphabet;
use chereme_sign::cue::french::{PronunciationOptions, SchwaCondition};

use crate::args::{CommandLine, NamedChoices};
use crate::output::CommandOutput;
use crate::streams;

/// Print the keys of cued speech for a text or for phones
///
/// A key is a handshape at a placement: the shape stands for a consonant, the placement for a vowel. Rules of spelling
/// turn French text into phones; `fils{f i l}` says a word as its braces state, and `--dictionary` brings your own
/// pronunciations. Phones in the input are separated by blanks, or written together, as in bɔ̃ʒuʁ; `#` is a pause.
///
/// `--json` gives "code", "words" ("text", "phones"), "keys" ("shape", "placement", "or_placement" if the
/// vowel is uncertain, "phones" in SAMPA, "start_us", "vowel_us", "end_us": null without --pace) and
/// "findings".
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  chereme keys 'le chat dort'
  chereme keys 'b ɔ̃ ʒ u ʁ' --phones ipa
  chereme keys 'bonjour à tous' --pace 1.6 --json
  chereme keys --from talk.TextGrid --tier phones
  chereme keys --from film.srt
  chereme keys 'mes fils{f i l} et mes clefs' --dictionary mine.tsv
  chereme keys 'h aU s' --phones sampa --code english-us")]
pub(crate) struct KeysArgs {
    #[command(flatten)]
    spoken: SpokenInput,
    /// Read the input as text (the default)
    #[arg(long = "text", conflicts_with = "phones")]
    as_text: bool,
    /// Give the keys times: the duration of phones as a multiple of the usual one, from 0.1 to 10; people who cue need
    /// about 1.6
    #[arg(long, value_name = "FACTOR")]
    pace: Option<f64>,
}

/// Options for the text or phones to read.
#[derive(Debug, clap::Args)]
pub(super) struct SpokenInput {
    /// The text, or the phones separated by blanks (a=120 is a phone of 120 ms); - is standard input
    #[arg(required_unless_present = "from")]
    pub(super) text: Option<String>,
    /// Take phones, words or sentences and their times from this file: TextGrid, EAF, XRA, SRT, VTT or another one with
    /// annotations
    #[arg(long, value_name = "FILE", conflicts_with = "text")]
    pub(super) from: Option<PathBuf>,
    /// The tier of that file; without it the first whose name aligners use for phones, else for words, else the only one
    #[arg(long, value_name = "TIER", requires = "from")]
    pub(super) tier: Option<String>,
    /// Read the input as phones in this alphabet
    #[arg(long, value_parser = PHONE_ALPHABET_CHOICES, value_name = "ALPHABET")]
    phones: Option<PhoneAlphabet>,
    /// Take the pronunciation from the program espeak-ng, which must be installed
    #[arg(long, conflicts_with_all = ["from", "phones"])]
    espeak: bool,
    /// The code: french, english-us or english-gb
    #[arg(long, default_value = "french")]
    code: String,
    /// A habit of some cuers, such as schwa-as-eu; may be repeated
    #[arg(long = "variant", value_name = "NAME")]
    variants: Vec<String>,
    /// Say words as this file does: a word and its phones on each line, a dictionary of MFA or SPPAS, or Lexique's table
    #[arg(long, value_name = "FILE", conflicts_with = "espeak")]
    dictionary: Option<PathBuf>,
    /// Keep silent final consonants silent before a vowel
    #[arg(long)]
    no_liaison: bool,
    /// The pronunciation of an e at the end of a word
    #[arg(long, value_parser = SCHWA_CHOICES, default_value = "usual")]
    schwa: SchwaCondition,
}

impl SpokenInput {
    /// Returns the input with the options for reading it; with `--espeak` the input is the program's phones, and `-`
    /// stands for standard input.
    pub(super) fn read_spoken_input(
        &self,
        text: &str,
        pace: Option<f64>,
        output: &mut CommandOutput,
    ) -> Result<(String, KeysOptions)> {
        let mut options = self.spoken_keys_options(pace, output)?;
        let text = match text {
            "-" => streams::read_stdin_text()?,
            text => text.to_owned(),
        };
        if !self.espeak {
            return Ok((text, options));
        }
        let (phones, unknown) = cue_phones_of_espeak(&text, &self.code)?;
        if !unknown.is_empty() {
            let unknown: String = unknown.into_iter().collect();
            output.write_output_line(format!("warning: espeak-ng prints {unknown:?}, which has no key"))?;
        }
        // espeak-ng was asked for the pronunciation, so that the text is phones from here on.
        options.phones = Some(PhoneAlphabet::Ipa);
        Ok((phones, options))
    }

    /// Returns the options, with the user's dictionary; lines of it that cannot be read are reported.
    pub(super) fn spoken_keys_options(&self, pace: Option<f64>, output: &mut CommandOutput) -> Result<KeysOptions> {
        let mut dictionary = None;
        if let Some(path) = &self.dictionary {
            let (read, warning) = read_pronunciation_dictionary(path, &self.code)?;
            if let Some(warning) = warning {
                output.write_warning(&warning)?;
            }
            dictionary = Some(read);
        }
        Ok(KeysOptions {
            code: self.code.clone(),
            phones: self.phones,
            variants: self.variants.clone(),
            french: PronunciationOptions {
                liaison: !self.no_liaison,
                schwa: self.schwa,
            },
            pace,
            dictionary,
        })
    }
}

/// The alphabets of phones.
pub(super) const PHONE_ALPHABET_CHOICES: NamedChoices<PhoneAlphabet> = NamedChoices(&[
    ("sampa", "", PhoneAlphabet::Sampa),
    ("ipa", "", PhoneAlphabet::Ipa),
    ("mfa", "", PhoneAlphabet::Mfa),
]);

/// The pronunciations of an e at the end of a word.
const SCHWA_CHOICES: NamedChoices<SchwaCondition> = NamedChoices(&[
    ("usual", "", SchwaCondition::Usual),
    ("dropped", "", SchwaCondition::Dropped),
    ("said", "", SchwaCondition::Said),
]);

pub(super) fn run(_: &CommandLine, args: &KeysArgs, output: &mut CommandOutput) -> Result<()> {
    let spoken = &args.spoken;
    let keyed_text = match (&spoken.from, &spoken.text) {
        (Some(path), _) => {
            let options = spoken.spoken_keys_options(args.pace, output)?;
            cue_keys_of_file(path, spoken.tier.as_deref(), &options)?
        }
        (None, Some(text)) => {
            let (text, options) = spoken.read_spoken_input(text, args.pace, output)?;
            cue_keys(&text, &options)?
        }
        (None, None) => bail!("there is nothing to read; write a text, or --from FILE"),
    };
    for word in &keyed_text.words {
        output.line_as_is(&format!("{}: {}", word.text, word.phones.join(" ")))?;
    }
    let rows: Vec<Vec<String>> = keyed_text.keys.iter().map(cue_key_row).collect();
    output.write_titled_table(&["shape", "placement", "phones", "seconds"], &rows)?;
    for finding in &keyed_text.findings {
        output.line_as_is(&output.translate_message(finding))?;
    }
    output.set_json_document(keyed_text)
}

fn cue_key_row(key: &CueKey) -> Vec<String> {
    let seconds = |micros: i64| micros as f64 / 1e6;
    let times = key
        .start_us
        .zip(key.end_us)
        .map(|(start, end)| format!("{:.2}-{:.2}", seconds(start), seconds(end)));
    let place = match &key.or_placement {
        Some(other) => format!("{} or {other}", key.placement),
        None => key.placement.clone(),
    };
    vec![
        key.shape.to_string(),
        place,
        key.phones.join(" "),
        times.unwrap_or_default(),
    ]
}
